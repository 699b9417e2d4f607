static char help[] = "Bad input to the mesh gives one sentence, the same error on every rank, and no hang.\n\n";

#include "elasticity_problem.h"

static char message[1024];

static PetscErrorCode KeepMessage(MPI_Comm comm, int line, const char *function, const char *file, PetscErrorCode n, PetscErrorType type, const char *text, void *context)
{
  (void)comm;
  (void)line;
  (void)function;
  (void)file;
  (void)context;
  if (type == PETSC_ERROR_INITIAL) (void)PetscStrncpy(message, text, sizeof(message));
  return n;
}

/* Prints the first error of a call, which must be the same on all ranks; ierr comes from the call */
static PetscErrorCode Expect(const char name[], PetscErrorCode ierr)
{
  PetscInt code[2] = {(PetscInt)ierr, -(PetscInt)ierr};

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, code, 2, MPIU_INT, MPI_MAX, PETSC_COMM_WORLD));
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%s\n  %s%s\n", name, ierr ? message : "NO ERROR", code[0] == -code[1] ? "" : " (DIFFERENT ERRORS)"));
  PetscFunctionReturn(0);
}

#define EXPECT(name, call) \
  do { \
    PetscErrorCode expected; \
    PetscCall(PetscPushErrorHandler(KeepMessage, NULL)); \
    expected = call; \
    PetscCall(PetscPopErrorHandler()); \
    PetscCall(Expect(name, expected)); \
  } while (0)

static PetscErrorCode BadBodies(void)
{
  SceneBody bodies[2], bad[2];
  DM        dm;

  PetscFunctionBeginUser;
  PetscCall(ProblemBodies(MATERIAL_LINEAR, bodies));
  EXPECT("no bodies", MeshCreate(PETSC_COMM_WORLD, 0, bodies, 0, &dm));
  EXPECT("refine -1", MeshCreate(PETSC_COMM_WORLD, 2, bodies, -1, &dm));
  EXPECT("refine 40", MeshCreate(PETSC_COMM_WORLD, 2, bodies, 40, &dm));
  PetscCall(PetscArraycpy(bad, bodies, 2));
  bad[1].upper[2] = bad[1].lower[2] - 1;
  EXPECT("negative box", MeshCreate(PETSC_COMM_WORLD, 2, bad, 0, &dm));
  bad[1].upper[2] = (PetscReal)NAN;
  EXPECT("NaN in a corner", MeshCreate(PETSC_COMM_WORLD, 2, bad, 0, &dm));
  PetscCall(PetscArraycpy(bad, bodies, 2));
  bad[0].cells[1] = 0;
  EXPECT("no cells", MeshCreate(PETSC_COMM_WORLD, 2, bad, 0, &dm));
  bad[0].cells[1] = PETSC_MAX_INT;
  EXPECT("too many cells", MeshCreate(PETSC_COMM_WORLD, 2, bad, 0, &dm));
  PetscCall(PetscArraycpy(bad, bodies, 2));
  bad[1].name = bad[0].name;
  EXPECT("one name twice", MeshCreate(PETSC_COMM_WORLD, 2, bad, 0, &dm));
  for (PetscInt d = 0; d < 3; ++d) bad[0].cells[d] = 1;
  EXPECT("one cell (an error where there are more ranks)", MeshCreate(PETSC_COMM_WORLD, 1, bad, 0, &dm));
  PetscFunctionReturn(0);
}

static PetscErrorCode BadQueries(void)
{
  SceneBody  bodies[2];
  Material   materials[2] = {{MATERIAL_LINEAR, 1, 0.3}, {MATERIAL_LINEAR, 1, 0.5}};
  DM         dm;
  IS         is;
  Elasticity e;

  PetscFunctionBeginUser;
  PetscCall(ProblemBodies(MATERIAL_LINEAR, bodies));
  PetscCall(MeshCreate(PETSC_COMM_WORLD, 2, bodies, 0, &dm));
  EXPECT("unknown face", MeshGetFacets(dm, "slab.top", &is));
  EXPECT("unknown body", MeshGetFaceVertices(dm, "slat.zmax", &is));
  EXPECT("component 3", MeshGetFaceDofs(dm, "slab.zmax", 3, &is));
  EXPECT("Poisson's ratio 0.5", ElasticityCreate(dm, 2, materials, NULL, &e));
  materials[1].poisson = 0.3;
  materials[1].young   = 0;
  EXPECT("Young's modulus 0", ElasticityCreate(dm, 2, materials, NULL, &e));
  EXPECT("fewer materials than bodies", ElasticityCreate(dm, 1, materials, NULL, &e));
  PetscCall(DMDestroy(&dm));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, help));
  PetscCall(BadBodies());
  PetscCall(BadQueries());
  PetscCall(PetscFinalize());
  return 0;
}

/*TEST

   test:
      suffix: 1
      nsize: {{2 3}}
      args: -malloc_dump 0
      filter: sed -e "s/cells. . ranks/cells: N ranks/"
      output_file: output/mesh_errors_1.out

TEST*/
