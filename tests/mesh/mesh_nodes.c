static char help[] =
  "Nodes of order 2 on curved bodies: volumes of fourth order, the same number of nodes on any number of ranks.\n\n";

#include <scene.h>
#include "../lib/elasticity_problem.h"
#include "../elasticity/elasticity_point.h"

/* Of the bodies of mesh_shapes.yaml, by 4 x 4 x 4 Gauss points of their cells of 27 nodes */
static PetscErrorCode Volumes(DM dm, PetscInt nbodies, PetscReal volume[])
{
  Vec                coordinates;
  const PetscScalar *x;
  PetscInt           start, end;

  PetscFunctionBeginUser;
  PetscCall(PetscArrayzero(volume, nbodies));
  PetscCall(MeshGetNodeCoordinates(dm, &coordinates));
  PetscCall(VecGetArrayRead(coordinates, &x));
  PetscCall(DMPlexGetHeightStratum(dm, 0, &start, &end));
  for (PetscInt c = start; c < end; ++c) {
    PointCell cell;
    PetscInt  body;

    PetscCall(DMGetLabelValue(dm, MESH_BODY_LABEL, c, &body));
    PetscCall(PointCellGet(dm, c, x, &cell));
    PetscCheck(cell.n == 27, PETSC_COMM_SELF, PETSC_ERR_PLIB, "A cell of order 2 has %" PetscInt_FMT " nodes", cell.n);
    for (PetscInt q = 0; q < POINTS * POINTS * POINTS; ++q) {
      Point p = {.weight = 0};

      PetscCall(PointGet(&cell, q, &p));
      volume[body] += p.weight;
    }
  }
  PetscCall(VecRestoreArrayRead(coordinates, &x));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, volume, (PetscMPIInt)nbodies, MPIU_REAL, MPIU_SUM, PETSC_COMM_WORLD));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  Scene      scene;
  char       file[PETSC_MAX_PATH_LEN];
  PetscReal *volume[3];

  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, help));
  PetscCall(PetscOptionsGetString(NULL, NULL, "-scene", file, sizeof(file), NULL));
  PetscCall(SceneLoad(PETSC_COMM_WORLD, file, &scene));
  for (PetscInt b = 0; b < scene->nbodies; ++b) scene->bodies[b].order = 2;
  for (PetscInt level = 0; level < 3; ++level) PetscCall(PetscMalloc1(scene->nbodies, &volume[level]));
  for (PetscInt level = 0; level < 3; ++level) {
    DM       dm;
    Vec      u;
    PetscInt n;

    PetscCall(MeshCreate(PETSC_COMM_WORLD, scene->nbodies, scene->bodies, level, &dm));
    PetscCall(DMCreateGlobalVector(dm, &u));
    PetscCall(VecGetSize(u, &n));
    PetscCall(PetscPrintf(PETSC_COMM_WORLD, "level %" PetscInt_FMT ": %" PetscInt_FMT " unknowns\n", level, n));
    PetscCall(Volumes(dm, scene->nbodies, volume[level]));
    PetscCall(VecDestroy(&u));
    PetscCall(DMDestroy(&dm));
  }
  for (PetscInt b = 0; b < scene->nbodies; ++b) {
    const PetscReal first  = PetscAbsReal(volume[1][b] - volume[0][b]),
                    second = PetscAbsReal(volume[2][b] - volume[1][b]);

    PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%s: ", scene->bodies[b].name));
    if (first < 1e-12 * volume[2][b]) PetscCall(PetscPrintf(PETSC_COMM_WORLD, "volume exact\n"));
    else if (first > 12 * second) PetscCall(PetscPrintf(PETSC_COMM_WORLD, "volume of fourth order\n"));
    else PetscCall(PetscPrintf(PETSC_COMM_WORLD, "volume changes by %g, then by %g\n", (double)first, (double)second));
  }
  for (PetscInt level = 0; level < 3; ++level) PetscCall(PetscFree(volume[level]));
  PetscCall(SceneDestroy(&scene));
  PetscCall(PetscFinalize());
  return 0;
}

/*TEST

   test:
      suffix: shapes
      args: -scene ${AMGF_DIR}/tests/mesh/mesh_shapes.yaml

   test:
      suffix: shapes_long
      nsize: 3
      output_file: output/mesh_nodes_shapes.out
      args: -scene ${AMGF_DIR}/tests/mesh/mesh_shapes.yaml

TEST*/
