/* Ends a run after the current Newton step if SIGINT, SIGTERM or SIGUSR1 is received */
#include "src/state/interrupt.h"
#include <signal.h>
#include "src/state/control.h"

static volatile sig_atomic_t caught = 0;

static void InterruptHandle(int sig)
{
  caught = sig;
  signal(sig, SIG_DFL);
}

/*@C
   SimulationCatchSignals - Makes SIGINT, SIGTERM and SIGUSR1 end a simulation after the current Newton step, with the
   state of the last converged load step

   Not Collective

   Level: intermediate

   Notes:
   A second signal of the same kind ends the program at once. mpiexec forwards SIGUSR1 to the ranks. After SIGINT or
   SIGTERM it sends SIGKILL after about a second, depending on the MPI.

   A signal ends every simulation of the process until this function is called again.

.seealso: `SimulationStep()`
@*/
PetscErrorCode SimulationCatchSignals(void)
{
  static const int signals[] = {SIGINT, SIGTERM, SIGUSR1};

  PetscFunctionBegin;
  caught = 0;
  for (size_t i = 0; i < PETSC_STATIC_ARRAY_LENGTH(signals); ++i)
    PetscCheck(signal(signals[i], InterruptHandle) != SIG_ERR, PETSC_COMM_SELF, PETSC_ERR_SYS,
      "signal() failed for signal %d", signals[i]);
  PetscFunctionReturn(0);
}

/* Finds whether this rank has received a signal, and lets the observer report progress. Not collective */
PetscErrorCode InterruptCaught(void *ctx, PetscBool *stop)
{
  const Simulation sim = (Simulation)ctx;

  PetscFunctionBegin;
  if (sim->state->control->observer.within) PetscCall(sim->state->control->observer.within(sim));
  *stop = caught ? PETSC_TRUE : PETSC_FALSE;
  PetscFunctionReturn(0);
}

/* Collective. *stop: true on all ranks as soon as any rank has received a signal. */
PetscErrorCode InterruptTest(Model model, State state, PetscBool *stop)
{
  int any = (int)caught;

  PetscFunctionBegin;
  if (!state->control->interrupted) {
    PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &any, 1, MPI_INT, MPI_MAX, model->comm));
    state->control->interrupted = any;
  }
  *stop = state->control->interrupted ? PETSC_TRUE : PETSC_FALSE;
  PetscFunctionReturn(0);
}

PetscErrorCode InterruptMonitor(Tao tao, void *ctx)
{
  Simulation         sim = (Simulation)ctx;
  PetscBool          stop;
  TaoConvergedReason reason;

  PetscFunctionBegin;
  PetscCall(TaoGetConvergedReason(tao, &reason));
  if (reason != TAO_CONTINUE_ITERATING) PetscFunctionReturn(0);
  PetscCall(InterruptTest(sim->model, sim->state, &stop));
  if (stop) PetscCall(TaoSetConvergedReason(tao, TAO_DIVERGED_USER));
  PetscFunctionReturn(0);
}

PetscErrorCode InterruptReport(State state, StepReport *report)
{
  PetscFunctionBegin;
  PetscCall(ReportReason(report, PETSC_FALSE, "stopped by signal %s",
    state->control->interrupted == SIGINT    ? "SIGINT"
    : state->control->interrupted == SIGTERM ? "SIGTERM"
                                             : "SIGUSR1"));
  PetscFunctionReturn(0);
}
