#define _XOPEN_SOURCE 700 /* setrlimit() */
static char help[] = "Writes two bodies with known fields; output_fields.py reads them back with h5py: -base NAME.\n\
  -full  no file can grow beyond 2 kB from the second step on\n";

#include <signal.h>
#include <sys/resource.h>
#include <mesh.h>
#include <output.h>

/* The same functions stand in output_fields.py */
static PetscReal Displacement(const PetscReal x[3], PetscInt component, PetscReal time)
{
  return time * (x[component] + 10 * x[(component + 1) % 3]);
}

static PetscErrorCode GetCoordinates(DM dm, PetscInt vertex, PetscReal x[3])
{
  PetscSection       section;
  Vec                coordinates;
  const PetscScalar *values;
  PetscInt           offset;

  PetscFunctionBeginUser;
  PetscCall(DMGetCoordinateSection(dm, &section));
  PetscCall(DMGetCoordinatesLocal(dm, &coordinates));
  PetscCall(PetscSectionGetOffset(section, vertex, &offset));
  PetscCall(VecGetArrayRead(coordinates, &values));
  for (PetscInt d = 0; d < 3; ++d) x[d] = PetscRealPart(values[offset + d]);
  PetscCall(VecRestoreArrayRead(coordinates, &values));
  PetscFunctionReturn(0);
}

static PetscErrorCode SetDisplacement(DM dm, PetscReal time, Vec u)
{
  PetscSection global;
  PetscInt     vstart, vend, offset;
  PetscReal    x[3];

  PetscFunctionBeginUser;
  PetscCall(DMGetGlobalSection(dm, &global));
  PetscCall(DMPlexGetDepthStratum(dm, 0, &vstart, &vend));
  for (PetscInt v = vstart; v < vend; ++v) {
    PetscCall(PetscSectionGetOffset(global, v, &offset));
    if (offset < 0) continue;
    PetscCall(GetCoordinates(dm, v, x));
    for (PetscInt d = 0; d < 3; ++d) PetscCall(VecSetValue(u, offset + d, Displacement(x, d, time), INSERT_VALUES));
  }
  PetscCall(VecAssemblyBegin(u));
  PetscCall(VecAssemblyEnd(u));
  PetscFunctionReturn(0);
}

/* Of each component another multiple of the cell's mean x */
static PetscErrorCode SetStress(DM dm, PetscReal stress[])
{
  PetscInt  cstart, cend, vertices[8];
  PetscReal x[3];

  PetscFunctionBeginUser;
  PetscCall(DMPlexGetHeightStratum(dm, 0, &cstart, &cend));
  for (PetscInt c = cstart; c < cend; ++c) {
    PetscReal mean = 0;

    PetscCall(MeshGetCellVertices(dm, c, vertices));
    for (PetscInt i = 0; i < 8; ++i) {
      PetscCall(GetCoordinates(dm, vertices[i], x));
      mean += x[0] / 8;
    }
    for (PetscInt i = 0; i < 7; ++i) stress[7 * (c - cstart) + i] = (i + 1) * mean;
  }
  PetscFunctionReturn(0);
}

/* Points of the first pair at the owned vertices of the upper body's lower face; at those with y = 0 also one of the
   second pair */
static PetscErrorCode SetContact(DM dm, StepState *state, ContactPoint points[])
{
  IS              is;
  PetscSection    global;
  const PetscInt *vertices;
  PetscInt        n, offset;
  PetscReal       x[3];

  PetscFunctionBeginUser;
  PetscCall(DMGetGlobalSection(dm, &global));
  PetscCall(MeshGetFaceVertices(dm, "upper.zmin", &is));
  PetscCall(ISGetLocalSize(is, &n));
  PetscCall(ISGetIndices(is, &vertices));
  state->npoints = 0;
  for (PetscInt i = 0; i < n; ++i) {
    PetscCall(PetscSectionGetOffset(global, vertices[i], &offset));
    if (offset < 0) continue;
    PetscCall(GetCoordinates(dm, vertices[i], x));
    for (PetscInt repeat = 0; repeat < (x[1] == 0 ? 2 : 1); ++repeat) {
      const PetscReal area = 1.0 + (PetscReal)repeat;

      points[state->npoints++] = (ContactPoint){.pair = repeat,
        .vertex                                       = vertices[i],
        .pressure                                     = area * (1 + x[0]),
        .area                                         = area,
        .gap                                          = repeat - x[0],
        .force                                        = {x[0], 2, area},
        .closed                                       = (PetscBool)(repeat && x[0] > 1)};
    }
  }
  PetscCall(ISRestoreIndices(is, &vertices));
  PetscCall(ISDestroy(&is));
  state->points = points;
  PetscFunctionReturn(0);
}

/* As on a full disk, writes fail */
static PetscErrorCode FillDisk(void)
{
  const struct rlimit limit = {2048, 2048};

  PetscFunctionBeginUser;
  (void)signal(SIGXFSZ, SIG_IGN);
  PetscCheck(!setrlimit(RLIMIT_FSIZE, &limit), PETSC_COMM_SELF, PETSC_ERR_SYS, "setrlimit");
  PetscFunctionReturn(0);
}

static PetscErrorCode WriteSteps(DM dm, Output output, PetscBool full)
{
  Vec           u;
  PetscInt      cstart, cend, vstart, vend;
  PetscReal    *stress;
  PairReport    pairs[] = {{.name = "first"}, {.name = "second"}};
  ContactPoint *points;
  StepReport    report = {.step = 0, .npairs = 2, .pairs = pairs};
  StepState     state  = {.report = &report};

  PetscFunctionBeginUser;
  PetscCall(DMPlexGetHeightStratum(dm, 0, &cstart, &cend));
  PetscCall(DMPlexGetDepthStratum(dm, 0, &vstart, &vend));
  PetscCall(DMCreateGlobalVector(dm, &u));
  PetscCall(PetscMalloc2(7 * (cend - cstart), &stress, 2 * (vend - vstart), &points));
  PetscCall(SetStress(dm, stress));
  PetscCall(SetContact(dm, &state, points));
  for (PetscInt step = 1; step <= 2; ++step) {
    if (full && step == 2) PetscCall(FillDisk());
    report.step        = step;
    report.time        = 0.5 * (PetscReal)step;
    state.displacement = u;
    state.stress       = stress;
    PetscCall(SetDisplacement(dm, report.time, u));
    PetscCall(OutputWrite(output, &state));
  }
  PetscCall(PetscFree2(stress, points));
  PetscCall(VecDestroy(&u));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  SceneBody bodies[] = {
    {.name = (char *)"lower", .shape = SHAPE_BOX, .lower = {0, 0, 0}, .upper = {3, 2, 1}, .cells = {3, 2, 1}},
    {.name = (char *)"upper", .shape = SHAPE_BOX, .lower = {1, 0, 1}, .upper = {2, 1, 2}, .cells = {2, 2, 2}},
  };
  const char *const names[]                  = {"lower", "upper <&\">"};
  char              base[PETSC_MAX_PATH_LEN] = "results";
  DM                dm;
  Output            output;
  PetscBool         full = PETSC_FALSE;

  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, help));
  PetscCall(PetscOptionsGetString(NULL, NULL, "-base", base, sizeof(base), NULL));
  PetscCall(PetscOptionsGetBool(NULL, NULL, "-full", &full, NULL));
  PetscCall(MeshCreate(PETSC_COMM_WORLD, 2, bodies, 1, &dm));
  PetscCall(OutputCreate(dm, 2, names, NULL, base, &output));
  PetscCall(WriteSteps(dm, output, full));
  PetscCall(OutputDestroy(&output));
  PetscCall(OutputDestroy(&output));
  PetscCall(DMDestroy(&dm));
  PetscCall(PetscFinalize());
  return 0;
}

/*TEST

  testset:
    nsize: {{1 2 3}}

    test:
      suffix: 1
      filter: (cat; ${PYTHON} ${AMGF_DIR}/tests/output/output_fields.py results)
      output_file: output/output_fields_1.out

    test:
      suffix: unwritable
      args: -base nowhere/results
      filter: Error: grep -o "cannot write .*" | sort -u
      output_file: output/output_fields_unwritable.out

  test:
    suffix: full
    args: -base full -full
    filter: Error: (grep -o "cannot write [^?]*?" | sort -u; ${PYTHON} ${AMGF_DIR}/tests/output/output_fields.py full)

TEST*/
