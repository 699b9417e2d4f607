static char help[] = "The search for forces that balance the loads ends after a signal.\n\n";

#include <signal.h>
#include "../lib/scene_text.h"
#include "src/measure/measureimpl.h"
#include "src/state/control.h"

/* A block on a floor, whose friction cannot hold it against a force along the floor */
static const char scene_text[] =
  "bodies:\n  - floor: {lower: [-1, -1, -1], upper: [2, 2, 0], cells: [1, 1, 1], material: rigid}\n"
  "  - block: {lower: [0, 0, 0], upper: [1, 1, 1], cells: [2, 2, 2], young: 1, poisson: 0.3}\n"
  "displacements:\n  - hold: {body: floor, value: [0, 0, 0]}\n"
  "tractions:\n  - push: {face: block.zmax, value: [1, 0, -1]}\n"
  "contact:\n  - foot: {mortar: floor.zmax, nonmortar: block.zmin, friction: 0.3}\n";

int main(int argc, char **argv)
{
  Scene       scene;
  Simulation  sim;
  StepReport  report = {.step = 1};
  Vec         force;
  PetscBool   none;
  PetscInt    first, end;
  PetscMPIInt rank;

  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, help));
  PetscCallMPI(MPI_Comm_rank(PETSC_COMM_WORLD, &rank));
  PetscCall(SceneLoadText("equilibrium_signal.yaml", scene_text, &scene));
  PetscCall(SimulationCreate(PETSC_COMM_WORLD, scene, &sim));
  PetscCall(SimulationSetFromOptions(sim));
  PetscCall(SimulationSetUp(sim));
  PetscCall(VecDuplicate(sim->model->places.x, &force));
  PetscCall(VecGetOwnershipRange(force, &first, &end));
  for (PetscInt i = first; i < end; ++i) {
    if (i % 3 != 1) PetscCall(VecSetValue(force, i, i % 3 ? -1.0 : 1.0, INSERT_VALUES));
  }
  PetscCall(VecAssemblyBegin(force));
  PetscCall(VecAssemblyEnd(force));
  PetscCall(SimulationCatchSignals());
  for (PetscInt k = 0; k < 2; ++k) {
    if (k && rank == 0) (void)raise(SIGUSR1);
    PetscCall(EquilibriumDiagnose(sim->model, sim->state, 1.0, force, &report, &none));
    PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%s: %s; signal %s\n", k ? "after a signal" : "without a signal",
      none ? report.reason : "nothing is proven", sim->state->control->interrupted == SIGUSR1 ? "SIGUSR1" : "none"));
  }
  PetscCall(PetscFree(report.reason));
  PetscCall(VecDestroy(&force));
  PetscCall(SimulationDestroy(&sim));
  PetscCall(SceneDestroy(&scene));
  PetscCall(PetscFinalize());
  return 0;
}

/*TEST

   test:
      suffix: 1
      nsize: {{1 3}}
      output_file: output/equilibrium_signal_1.out

TEST*/
