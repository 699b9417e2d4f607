static char help[] =
  "What fails on one rank fails on all: one sentence, the same error on every rank, and no hang.\n\n";

#include <scene.h>
#include <mesh.h>
#include <elasticity.h>
#include <output.h>
#include <rankerror.h>
#include "../lib/attempt.h"
#include <string.h>
#include <unistd.h>

/* An error that one rank has alone leaves the others waiting: they are not given longer than this [s] */
#define PATIENCE 200

#define ATTEMPT(name, call) \
  do { \
    PetscErrorCode attempt_error; \
    PetscCall(AttemptBegin()); \
    attempt_error = call; \
    PetscCall(AttemptEnd()); \
    PetscCall(AttemptCompareRanks(name, attempt_error)); \
    PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%s: ", name)); \
    PetscCall(AttemptPrint(attempt_error)); \
  } while (0)

static PetscErrorCode Fail(PetscInt number)
{
  PetscFunctionBeginUser;
  SETERRQ(PETSC_COMM_SELF, PETSC_ERR_USER, "rank %d of those that fail", (int)number);
}

/* Ranks `from` to `to`, counted from the last where negative, fail */
static PetscErrorCode FailOn(PetscInt from, PetscInt to)
{
  RankError      error;
  PetscErrorCode ierr = 0;
  PetscMPIInt    rank, size;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(PETSC_COMM_WORLD, &rank));
  PetscCallMPI(MPI_Comm_size(PETSC_COMM_WORLD, &size));
  if (from < 0) from += size;
  if (to < 0) to += size;
  PetscCall(RankErrorBegin(&error));
  if (rank >= from && rank <= to) ierr = Fail(rank - from);
  PetscCall(RankErrorEnd(PETSC_COMM_WORLD, ierr, &error));
  PetscCheck(!error.code, PETSC_COMM_WORLD, error.code, "%s", error.message);
  PetscFunctionReturn(0);
}

static PetscErrorCode TestRanks(void)
{
  PetscFunctionBeginUser;
  ATTEMPT("no rank fails", FailOn(1, 0));
  ATTEMPT("the first rank fails", FailOn(0, 0));
  ATTEMPT("the last rank fails", FailOn(-1, -1));
  ATTEMPT("all ranks fail", FailOn(0, -1));
  PetscFunctionReturn(0);
}

static PetscErrorCode WriteText(const char file[], const char text[])
{
  PetscMPIInt rank;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(PETSC_COMM_WORLD, &rank));
  if (!rank) {
    FILE *stream = fopen(file, "w");

    PetscCheck(stream && fputs(text, stream) >= 0 && !fclose(stream), PETSC_COMM_SELF, PETSC_ERR_FILE_WRITE,
      "cannot write %s", file);
  }
  PetscCallMPI(MPI_Barrier(PETSC_COMM_WORLD));
  PetscFunctionReturn(0);
}

/* PETSc's reader of YAML files takes this name for one with a variable in it, on the first rank */
static PetscErrorCode TestScene(void)
{
  const char file[] = "${AMGF_NO_SUCH_VARIABLE}.yaml";
  Scene      scene;

  PetscFunctionBeginUser;
  PetscCall(WriteText(file, "problem: rank\n"));
  ATTEMPT("a scene whose name only the first rank reads", SceneLoad(PETSC_COMM_WORLD, file, &scene));
  ATTEMPT("a scene that is a folder", SceneLoad(PETSC_COMM_WORLD, ".", &scene));
  PetscFunctionReturn(0);
}

static PetscErrorCode (*given)(size_t, PetscBool, int, const char[], const char[], void **);
static const char *starved; /* the function that gets no memory */
static PetscMPIInt hungry;  /* on this rank */
static PetscInt    denied;

static PetscErrorCode DenyMemory(size_t n, PetscBool clear, int line, const char function[], const char file[],
  void **result)
{
  PetscMPIInt rank;

  MPI_Comm_rank(PETSC_COMM_WORLD, &rank);
  if (rank != hungry || !function || strcmp(function, starved)) return (*given)(n, clear, line, function, file, result);
  PetscFunctionBeginUser; /* PetscError() takes a function off PETSc's stack */
  ++denied;
  return PetscError(PETSC_COMM_SELF, line, function, file, PETSC_ERR_MEM, PETSC_ERROR_INITIAL, "no memory in %s()",
    function);
}

/* On the first rank, or on the last */
static PetscErrorCode CreateStarved(const SceneBody *body, const char function[], PetscBool last)
{
  DM             dm;
  PetscErrorCode ierr;
  PetscMPIInt    size;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_size(PETSC_COMM_WORLD, &size));
  hungry        = last ? size - 1 : 0;
  denied        = 0;
  starved       = function;
  given         = PetscTrMalloc;
  PetscTrMalloc = DenyMemory;
  ierr          = MeshCreate(PETSC_COMM_WORLD, 1, body, 0, &dm);
  PetscTrMalloc = given;
  PetscCallMPI(MPI_Bcast(&denied, 1, MPIU_INT, hungry, PETSC_COMM_WORLD));
  PetscCheck(denied, PETSC_COMM_WORLD, PETSC_ERR_PLIB, "%s() asked for no memory", function);
  PetscCall(ierr);
  PetscFunctionReturn(0);
}

/* Whatever the first rank makes alone may need more memory than it has */
static PetscErrorCode TestMemory(void)
{
  static char     box[] = "box", ball[] = "ball", blocks[] = "blocks", file[] = "error_rank.msh", volume[] = "bar";
  const SceneBody bodies[] = {{.name = box, .upper = {1, 1, 1}, .cells = {4, 4, 4}},
    {.name    = ball,
      .shape  = SHAPE_BALL,
      .curved = PETSC_TRUE,
      .cells  = {2, 2, 2},
      .layers = 2,
      .octant = {.outer = {.radius = 1}}},
    {.name = blocks, .shape = SHAPE_GMSH, .gmsh = {.file = file, .volume = volume}}};
  const struct {
    const char *what, *function;
    PetscInt    body;
  } work[] = {{"the grid of a box", "ShapeGridCreate", 0}, {"the mesh of all bodies", "MeshJoinVertices", 0},
    {"the partition", "MetisPartitionGraph", 0}, {"the vertices of a ball", "OctantNumberSurface", 1},
    {"the names of a Gmsh file", "GmshScanPhysicalNames", 2}, {"the nodes of a Gmsh file", "GmshCheckNodes", 2},
    {"the cells of a Gmsh body", "GmshCutVolume", 2}, {"the vertices of a Gmsh body", "GmshCheckVertices", 2}};

  PetscFunctionBeginUser;
  PetscCall(
    WriteText(file, "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n3 1 \"bar\"\n$EndPhysicalNames\n"
                    "$Nodes\n8\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n5 0 0 1\n6 1 0 1\n7 1 1 1\n8 0 1 1\n$EndNodes\n"
                    "$Elements\n1\n1 5 2 1 1 1 2 3 4 5 6 7 8\n$EndElements\n"));
  for (size_t i = 0; i < PETSC_STATIC_ARRAY_LENGTH(work); ++i)
    ATTEMPT(work[i].what, CreateStarved(&bodies[work[i].body], work[i].function, PETSC_FALSE));
  PetscFunctionReturn(0);
}

/* As many cubes as it takes for a file to be distributed to three ranks */
static PetscErrorCode WriteBricks(const char file[])
{
  enum { N = 5 };
  char  *text, *at;
  size_t room = 64 * (N + 1) * (N + 1) * (N + 1) + 64 * N * N * N + 256;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(room, &text));
  at =
    text + sprintf(text,
             "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n3 1 \"bricks\"\n$EndPhysicalNames\n$Nodes\n%d\n",
             (N + 1) * (N + 1) * (N + 1));
  for (int v = 0; v < (N + 1) * (N + 1) * (N + 1); ++v)
    at += sprintf(at, "%d %d %d %d\n", v + 1, v % (N + 1), v / (N + 1) % (N + 1), v / ((N + 1) * (N + 1)));
  at += sprintf(at, "$EndNodes\n$Elements\n%d\n", N * N * N);
  for (int c = 0; c < N * N * N; ++c) {
    const int v = 1 + c % N + (N + 1) * (c / N % N) + (N + 1) * (N + 1) * (c / (N * N)), up = (N + 1) * (N + 1);

    at += sprintf(at, "%d 5 2 1 1 %d %d %d %d %d %d %d %d\n", c + 1, v, v + 1, v + N + 2, v + N + 1, v + up, v + up + 1,
      v + up + N + 2, v + up + N + 1);
  }
  (void)sprintf(at, "$EndElements\n");
  PetscCall(WriteText(file, text));
  PetscCall(PetscFree(text));
  PetscFunctionReturn(0);
}

/* The parts of a file's mesh go out one after another: who sends and who takes may want memory */
static PetscErrorCode TestDeal(void)
{
  static char     bricks[] = "bricks", file[] = "error_rank_bricks.msh";
  const SceneBody body = {.name = bricks, .shape = SHAPE_GMSH, .gmsh = {.file = file, .volume = bricks}};

  PetscFunctionBeginUser;
  PetscCall(WriteBricks(file));
  ATTEMPT("the parts of a mesh", CreateStarved(&body, "DistributePartition", PETSC_FALSE));
  ATTEMPT("a part on the first rank", CreateStarved(&body, "DistributePartCreate", PETSC_FALSE));
  ATTEMPT("a part on the last rank", CreateStarved(&body, "DistributeReceive", PETSC_TRUE));
  ATTEMPT("the grid of a part on the last rank", CreateStarved(&body, "DistributeUnpack", PETSC_TRUE));
  PetscFunctionReturn(0);
}

/* One prism, on the first rank */
static PetscErrorCode TestPrism(void)
{
  const PetscInt  cell[6]  = {0, 1, 2, 3, 4, 5};
  const PetscReal x[18]    = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 0, 1, 1};
  const Material  material = {.type = MATERIAL_LINEAR, .young = 1.0, .poisson = 0.3};
  PetscInt        pstart, pend, vstart, vend;
  PetscSection    section;
  Elasticity      elasticity;
  PetscMPIInt     rank;
  DM              dm;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(PETSC_COMM_WORLD, &rank));
  PetscCall(
    DMPlexCreateFromCellListPetsc(PETSC_COMM_WORLD, 3, rank ? 0 : 1, rank ? 0 : 6, 6, PETSC_TRUE, cell, 3, x, &dm));
  PetscCall(DMCreateLabel(dm, MESH_BODY_LABEL));
  if (!rank) PetscCall(DMSetLabelValue(dm, MESH_BODY_LABEL, 0, 0));
  PetscCall(DMPlexGetChart(dm, &pstart, &pend));
  PetscCall(DMPlexGetDepthStratum(dm, 0, &vstart, &vend));
  PetscCall(PetscSectionCreate(PETSC_COMM_WORLD, &section));
  PetscCall(PetscSectionSetChart(section, pstart, pend));
  for (PetscInt v = vstart; v < vend; ++v) PetscCall(PetscSectionSetDof(section, v, 3));
  PetscCall(PetscSectionSetUp(section));
  PetscCall(DMSetLocalSection(dm, section));
  PetscCall(PetscSectionDestroy(&section));
  ATTEMPT("a prism on the first rank", ElasticityCreate(dm, 1, &material, NULL, &elasticity));
  PetscCall(DMDestroy(&dm));
  PetscFunctionReturn(0);
}

/* The first rank has a point of contact at a vertex that is not its own: of those shared by ranks the last one owns
   each */
static PetscErrorCode TestRow(void)
{
  static char       name[]  = "box";
  const SceneBody   body    = {.name = name, .upper = {1, 1, 1}, .cells = {4, 4, 4}};
  const char *const names[] = {name};
  StepReport        report  = {.step = 1};
  StepState         state   = {.report = &report};
  ContactPoint      point   = {.area = 1.0};
  PetscInt          cstart, cend, vstart, vend, foreign = PETSC_DECIDE, offset;
  PetscReal        *stress;
  PetscSection      global;
  PetscMPIInt       rank;
  Output            output;
  Vec               u;
  DM                dm;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(PETSC_COMM_WORLD, &rank));
  PetscCall(MeshCreate(PETSC_COMM_WORLD, 1, &body, 0, &dm));
  PetscCall(OutputCreate(dm, 1, names, NULL, "error_rank", &output));
  PetscCall(DMPlexGetHeightStratum(dm, 0, &cstart, &cend));
  PetscCall(DMPlexGetDepthStratum(dm, 0, &vstart, &vend));
  PetscCall(DMGetGlobalSection(dm, &global));
  for (PetscInt v = vstart; v < vend; ++v) {
    PetscCall(PetscSectionGetOffset(global, v, &offset));
    if (offset < 0) foreign = v;
  }
  PetscCheck(rank || foreign >= 0, PETSC_COMM_SELF, PETSC_ERR_PLIB, "The first rank owns all its vertices");
  PetscCall(DMCreateGlobalVector(dm, &u));
  PetscCall(VecZeroEntries(u));
  PetscCall(PetscCalloc1(7 * (cend - cstart), &stress));
  state.displacement = u;
  state.stress       = stress;
  point.vertex       = foreign;
  state.points       = &point;
  state.npoints      = rank ? 0 : 1;
  ATTEMPT("a point of contact of the first rank", OutputWrite(output, &state));
  PetscCall(OutputDestroy(&output));
  PetscCall(PetscFree(stress));
  PetscCall(VecDestroy(&u));
  PetscCall(DMDestroy(&dm));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, help));
  (void)alarm(PATIENCE);
  PetscCall(TestRanks());
  PetscCall(TestScene());
  PetscCall(TestMemory());
  PetscCall(TestDeal());
  PetscCall(TestPrism());
  PetscCall(TestRow());
  PetscCall(PetscFinalize());
  return 0;
}

/*TEST

   test:
      suffix: 1
      nsize: {{2 3}}
      args: -malloc_dump 0
      filter: sed -e "s/into . parts/into N parts/"
      output_file: output/error_rank_1.out

TEST*/
