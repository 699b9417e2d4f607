static char help[] =
  "Load steps called in a wrong order or out of range, after a signal, and from checkpoints that make no "
  "sense.\n\n";

#include <signal.h>
#include <math.h>
#include <checkpoint.h>
#include <step.h>
#include "../lib/attempt.h"
#include "../lib/scene_text.h"

static const char scene_text[] =
  "bodies:\n  - bar: {lower: [0, 0, 0], upper: [1, 1, 4], cells: [1, 1, 4], young: 1, poisson: 0.3}\n"
  "displacements:\n  - foot: {face: bar.zmin, value: [0, 0, 0]}\n  - top: {face: bar.zmax, value: [0, 0, 0.1]}\n"
  "load: {steps: 3}\n";

static PetscErrorCode CreateSimulation(Scene scene, PetscBool ready, Simulation *sim)
{
  PetscFunctionBeginUser;
  PetscCall(SimulationCreate(PETSC_COMM_WORLD, scene, sim));
  PetscCall(SimulationSetFromOptions(*sim));
  if (ready) PetscCall(SimulationSetUp(*sim));
  PetscFunctionReturn(0);
}

static PetscErrorCode TryStep(Simulation sim, PetscInt step)
{
  PetscErrorCode ierr;
  StepState      state;

  PetscFunctionBeginUser;
  PetscCall(AttemptBegin());
  ierr = SimulationStep(sim, step, &state);
  PetscCall(AttemptEnd());
  PetscCall(AttemptCompareRanks("a load step", ierr));
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "step %" PetscInt_FMT ": ", step));
  PetscCall(AttemptPrint(ierr));
  if (!ierr && !state.report->converged) PetscCall(PetscPrintf(PETSC_COMM_WORLD, "  %s\n", state.report->reason));
  PetscFunctionReturn(0);
}

static PetscErrorCode TestOrder(Scene scene)
{
  const PetscInt steps[] = {-1, 3, 1000000, 1, 0, 0, 2, 1, 2, 2, 3};
  Simulation     sim;
  RunReport      report;

  PetscFunctionBeginUser;
  PetscCall(CreateSimulation(scene, PETSC_FALSE, &sim));
  PetscCall(TryStep(sim, 0));
  PetscCall(SimulationSetUp(sim));
  for (size_t i = 0; i < PETSC_STATIC_ARRAY_LENGTH(steps); ++i) PetscCall(TryStep(sim, steps[i]));
  PetscCall(SimulationGetReport(sim, &report));
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%" PetscInt_FMT " load steps are reported\n", report.nsteps));
  PetscCall(SimulationDestroy(&sim));
  PetscFunctionReturn(0);
}

/* A signal ends simulations until signals are caught anew */
static PetscErrorCode TestSignal(Scene scene)
{
  Simulation  sim;
  PetscMPIInt rank;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(PETSC_COMM_WORLD, &rank));
  for (PetscInt k = 0; k < 3; ++k) {
    PetscCall(CreateSimulation(scene, PETSC_TRUE, &sim));
    if (k != 1) PetscCall(SimulationCatchSignals());
    if (!k && !rank) (void)raise(SIGUSR1);
    PetscCall(TryStep(sim, 0));
    PetscCall(SimulationDestroy(&sim));
  }
  PetscFunctionReturn(0);
}

/* Each of a checkpoint's numbers in turn, after the first load step */
static PetscErrorCode TestCheckpoint(Scene scene)
{
  static const struct {
    const char *what;
    PetscInt    step;
    PetscReal   time, previous, increment;
  } wrong[] = {
    {"as it is", 1, 1, 0, 0},
    {"a negative step", -1, 1, 0, 0},
    {"a step that is not the time's", 2, 1, 0, 0},
    {"a negative time", -1, -1, -2, 0},
    {"no time", 1, NAN, 0, 0},
    {"a time of no end", 1, INFINITY, 0, 0},
    {"a state before it that is later", 1, 1, 2, 0},
    {"a negative increment", 1, 1, 0, -0.5},
    {"at the end", 3, 3, 2, 0},
  };
  Simulation sim;
  Checkpoint checkpoint;
  PetscInt   step;

  PetscFunctionBeginUser;
  PetscCall(CreateSimulation(scene, PETSC_TRUE, &sim));
  PetscCall(TryStep(sim, 0));
  PetscCall(SimulationGetCheckpoint(sim, &checkpoint));
  PetscCall(SimulationDestroy(&sim));
  for (size_t i = 0; i < PETSC_STATIC_ARRAY_LENGTH(wrong); ++i) {
    PetscErrorCode ierr;

    checkpoint->step          = wrong[i].step;
    checkpoint->time          = wrong[i].time;
    checkpoint->previous_time = wrong[i].previous;
    checkpoint->increment     = wrong[i].increment;
    PetscCall(CreateSimulation(scene, PETSC_TRUE, &sim));
    PetscCall(AttemptBegin());
    ierr = SimulationSetCheckpoint(sim, checkpoint, &step);
    PetscCall(AttemptEnd());
    PetscCall(AttemptCompareRanks("a checkpoint", ierr));
    PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%s: ", wrong[i].what));
    PetscCall(AttemptPrint(ierr));
    if (!ierr) PetscCall(TryStep(sim, step));
    PetscCall(SimulationDestroy(&sim));
  }
  PetscCall(CheckpointDestroy(&checkpoint));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  Scene scene;

  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, help));
  PetscCall(SceneLoadText("step_calls.yaml", scene_text, &scene));
  PetscCall(TestOrder(scene));
  PetscCall(TestSignal(scene));
  PetscCall(TestCheckpoint(scene));
  PetscCall(SceneDestroy(&scene));
  PetscCall(PetscFinalize());
  return 0;
}

/*TEST

   test:
      suffix: 1
      nsize: {{1 2}}
      output_file: output/step_calls_1.out

TEST*/
