static char help[] = "The matrix of ties has room for its entries and no more.\n\n";

#include "src/state/stateimpl.h"
#include <step.h>
#include "../lib/scene_text.h"

static const char scene_text[] =
  "bodies:\n  - low: {lower: [0, 0, 0], upper: [1, 1, 1], cells: [6, 6, 6], young: 1, poisson: 0.3}\n"
  "  - top: {lower: [0, 0, 1], upper: [1, 1, 2], cells: [7, 7, 7], young: 1, poisson: 0.3}\n"
  "displacements:\n  - foot: {face: low.zmin, value: [0, 0, 0]}\n"
  "ties:\n  - glue: {mortar: low.zmax, nonmortar: top.zmin}\n";

int main(int argc, char **argv)
{
  Scene      scene;
  Simulation sim;
  MatInfo    info;
  PetscInt   rows;

  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, help));
  PetscCall(SceneLoadText("ties_memory.yaml", scene_text, &scene));
  PetscCall(SimulationCreate(PETSC_COMM_WORLD, scene, &sim));
  PetscCall(SimulationSetUp(sim));
  PetscCall(MatGetSize(sim->model->ties.C, &rows, NULL));
  PetscCall(MatGetInfo(sim->model->ties.C, MAT_GLOBAL_SUM, &info));
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "entries reserved: %s than one a row more than there are\n",
    info.nz_allocated <= info.nz_used + rows ? "no more" : "MORE"));
  if (info.nz_allocated > info.nz_used + rows)
    PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%g for %g\n", info.nz_allocated, info.nz_used));
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "allocations while they were set: %g\n", info.mallocs));
  PetscCall(SimulationDestroy(&sim));
  PetscCall(SceneDestroy(&scene));
  PetscCall(PetscFinalize());
  return 0;
}

/*TEST

   test:
      suffix: 1
      nsize: {{1 3}}
      output_file: output/ties_memory_1.out

TEST*/
