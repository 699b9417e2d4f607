/*
   The mechanics library from C: reads a scene, solves its load steps, asks for what it wants to know.

      press_library PREFIX/share/amgf/scenes/patch_test.yaml

   Output:
      load step 1: converged TRUE, pair 1 presses: TRUE
*/
#include <contact/step.h>

int main(int argc, char **argv)
{
  Scene      scene;
  Simulation simulation;

  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCall(PetscAMGFInitializePackage());
  PetscCheck(argc > 1, PETSC_COMM_WORLD, PETSC_ERR_USER_INPUT,
    "no scene given; usage: press_library SCENE.yaml [options]");
  PetscCall(SceneLoad(PETSC_COMM_WORLD, argv[1], &scene));
  PetscCall(SimulationCreate(PETSC_COMM_WORLD, scene, &simulation));
  PetscCall(SimulationSetFromOptions(simulation));
  PetscCall(SimulationSetUp(simulation));
  for (PetscInt step = 0; step < scene->nsteps; ++step) {
    StepState state;
    PetscReal force = 0.0; /* this rank's vertices of the first pair */

    PetscCall(SimulationStep(simulation, step, &state));
    for (PetscInt i = 0; i < state.npoints; ++i) {
      if (state.points[i].pair == 0) force += state.points[i].pressure * state.points[i].area;
    }
    PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &force, 1, MPIU_REAL, MPIU_SUM, PETSC_COMM_WORLD));
    PetscCall(PetscPrintf(PETSC_COMM_WORLD, "load step %" PetscInt_FMT ": converged %s, pair 1 presses: %s\n", step + 1,
      PetscBools[state.report->converged], PetscBools[force > 0.0]));
  }
  PetscCall(SimulationDestroy(&simulation));
  PetscCall(SceneDestroy(&scene));
  PetscCall(PetscFinalize());
  return 0;
}
