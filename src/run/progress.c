/* Prints the progress of a run at intervals: load step, elapsed time, estimated remaining time */
#include "runimpl.h"
#include <petsctime.h>
#include "src/state/control.h"
#include "src/state/path.h"
#include "src/state/run.h"

#define PROGRESS_LENGTH 32
#define PROGRESS_STEPS  ((PetscInt)PETSC_STATIC_ARRAY_LENGTH(((Progress *)NULL)->last))

static PetscErrorCode ProgressDuration(PetscLogDouble seconds, char text[PROGRESS_LENGTH])
{
  const long s = (long)(seconds + 0.5);

  PetscFunctionBegin;
  if (s < 120) PetscCall(PetscSNPrintf(text, PROGRESS_LENGTH, "%ld s", s));
  else if (s < 7200) PetscCall(PetscSNPrintf(text, PROGRESS_LENGTH, "%ld min %ld s", s / 60, s % 60));
  else PetscCall(PetscSNPrintf(text, PROGRESS_LENGTH, "%ld h %ld min", s / 3600, s / 60 % 60));
  PetscFunctionReturn(0);
}

/* Finds whether a progress message is due. The clock of the first rank is used, since this rank prints the message. */
static PetscErrorCode ProgressIsDue(StepControl *control, RunState *run, PetscLogDouble *now, PetscBool *due)
{
  PetscFunctionBegin;
  PetscCall(PetscTime(now));
  *due = (PetscBool)(control->monitor && run->progress.every > 0.0 &&
                     *now - PetscMax(run->progress.said, run->start.total) >= run->progress.every);
  if (*due) run->progress.said = *now;
  PetscFunctionReturn(0);
}

/* Records the duration of a complete load step [s] */
void ProgressRecord(Progress *p, PetscLogDouble duration)
{
  p->last[p->nsteps++ % PROGRESS_STEPS] = duration;
}

/*
   Estimates the remaining time *left [s]. elapsed: time spent in the current load step; later: number of load steps
   after it. The bounds are the durations of the fastest and the slowest of the last load steps. If the slower bound is
   at most three times the faster one, their mean is within a factor of two of both. Otherwise, or if the current step
   takes longer than the earlier ones, or if less than a second is left, returns false, and there is no estimate.
*/
PetscBool ProgressEstimate(const Progress *p, PetscLogDouble elapsed, PetscInt later, PetscLogDouble *left)
{
  PetscLogDouble least = p->last[0], most = p->last[0], low, high;

  for (PetscInt i = 1; i < PetscMin(p->nsteps, PROGRESS_STEPS); ++i) {
    least = PetscMin(least, p->last[i]);
    most  = PetscMax(most, p->last[i]);
  }
  low   = least * (PetscLogDouble)later + PetscMax(least - elapsed, 0.0);
  high  = most * (PetscLogDouble)later + most - elapsed;
  *left = 0.5 * (low + high);
  return (PetscBool)(p->nsteps >= 2 && elapsed <= most && high <= 3.0 * low && *left >= 1.0);
}

/* Prints a progress message. With -accuracy the remaining time is not estimated, since a finer mesh may follow. */
static PetscErrorCode ProgressPrint(Simulation sim, PetscLogDouble now, const char inside[])
{
  const PetscInt nsteps = sim->model->scene->nsteps,
                 step   = PetscMin((PetscInt)PetscFloorReal(sim->state->path->time) + 1, nsteps);
  char            so_far[PROGRESS_LENGTH], to_come[PROGRESS_LENGTH];
  PetscLogDouble  left;
  const PetscBool known =
    (PetscBool)(!sim->run->progress.follows &&
                ProgressEstimate(&sim->run->progress, now - sim->run->progress.begun, nsteps - step, &left));

  PetscFunctionBegin;
  PetscCall(ProgressDuration(now - sim->run->start.total, so_far));
  if (known) PetscCall(ProgressDuration(left, to_come));
  PetscCall(
    PetscPrintf(sim->model->comm, "Progress: load step %" PetscInt_FMT " of %" PetscInt_FMT "%s, %s so far%s%s%s\n",
      step, nsteps, inside, so_far, known ? ", about " : "", known ? to_come : "", known ? " left" : ""));
  PetscFunctionReturn(0);
}

/* Starts the clock before a load step. After a restart the first load step may be partly complete. */
static PetscErrorCode ProgressBegin(Simulation sim)
{
  PetscFunctionBegin;
  PetscCall(PetscTime(&sim->run->progress.begun));
  sim->run->progress.whole = (PetscBool)(sim->state->path->time == PetscFloorReal(sim->state->path->time));
  PetscFunctionReturn(0);
}

/* Prints a progress message after a converged attempt if one is due */
static PetscErrorCode ProgressReach(Simulation sim)
{
  const PetscBool end        = (PetscBool)(sim->state->path->time == PetscFloorReal(sim->state->path->time));
  char            inside[48] = "";
  PetscBool       due;
  PetscLogDouble  now;

  PetscFunctionBegin;
  PetscCall(ProgressIsDue(sim->state->control, sim->run, &now, &due));
  if (end && sim->run->progress.whole) ProgressRecord(&sim->run->progress, now - sim->run->progress.begun);
  if (end) sim->run->progress.begun = now;
  if (!due || sim->state->path->time >= (PetscReal)sim->model->scene->nsteps) PetscFunctionReturn(0);
  if (!end) PetscCall(PetscSNPrintf(inside, sizeof(inside), " from time %g", (double)sim->state->path->time));
  PetscCall(ProgressPrint(sim, now, inside));
  PetscFunctionReturn(0);
}

/* Prints a progress message during a solve if one is due. goal: the error at which the solve ends. */
static PetscErrorCode ProgressIterate(Simulation sim, PetscInt iteration, PetscReal error, PetscReal goal)
{
  char           inside[96];
  PetscBool      due;
  PetscLogDouble now;

  PetscFunctionBegin;
  PetscCall(ProgressIsDue(sim->state->control, sim->run, &now, &due));
  if (!due) PetscFunctionReturn(0);
  PetscCall(PetscSNPrintf(inside, sizeof(inside), ", iteration %" PetscInt_FMT " with an error of %.1e (ends at %.0e)",
    iteration, (double)error, (double)goal));
  PetscCall(ProgressPrint(sim, now, inside));
  PetscFunctionReturn(0);
}

/* Prints a progress message within an iteration if one is due */
static PetscErrorCode ProgressWithin(Simulation sim)
{
  PetscBool      due;
  PetscLogDouble now;

  PetscFunctionBegin;
  PetscCall(ProgressIsDue(sim->state->control, sim->run, &now, &due));
  if (due) PetscCall(ProgressPrint(sim, now, ""));
  PetscFunctionReturn(0);
}

static PetscErrorCode ProgressMonitorOptimizer(Tao tao, void *ctx)
{
  Simulation sim = (Simulation)ctx;
  PetscInt   iteration;
  PetscReal  error, goal;

  PetscFunctionBegin;
  PetscCall(TaoGetSolutionStatus(tao, &iteration, NULL, &error, NULL, NULL, NULL));
  PetscCall(TaoGetTolerances(tao, &goal, NULL, NULL));
  PetscCall(ProgressIterate(sim, iteration, error, goal));
  PetscFunctionReturn(0);
}

static PetscErrorCode ProgressMonitorLinear(KSP ksp, PetscInt iteration, PetscReal norm, void *ctx)
{
  Simulation sim = (Simulation)ctx;
  PetscReal  goal;

  PetscFunctionBegin;
  if (!iteration) sim->run->progress.residual = norm;
  PetscCall(KSPGetTolerances(ksp, &goal, NULL, NULL, NULL));
  PetscCall(ProgressIterate(sim, iteration, norm > 0.0 ? norm / sim->run->progress.residual : 0.0, goal));
  PetscFunctionReturn(0);
}

PetscErrorCode ProgressObserve(Simulation sim)
{
  PetscFunctionBegin;
  sim->run->progress = (Progress){.every = 10.0};
  sim->state->control->observer =
    (StepObserver){ProgressBegin, ProgressReach, ProgressWithin, ProgressMonitorOptimizer, ProgressMonitorLinear};
  PetscFunctionReturn(0);
}
