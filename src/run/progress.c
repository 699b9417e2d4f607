/* How far a run is, now and then: load step, time so far, what is left. */
#include "runimpl.h"
#include <petsctime.h>

#define PROGRESS_LENGTH 32

static PetscErrorCode ProgressDuration(PetscLogDouble seconds, char text[PROGRESS_LENGTH])
{
  const long s = (long)(seconds + 0.5);

  PetscFunctionBegin;
  if (s < 120) PetscCall(PetscSNPrintf(text, PROGRESS_LENGTH, "%ld s", s));
  else if (s < 7200) PetscCall(PetscSNPrintf(text, PROGRESS_LENGTH, "%ld min %ld s", s / 60, s % 60));
  else PetscCall(PetscSNPrintf(text, PROGRESS_LENGTH, "%ld h %ld min", s / 3600, s / 60 % 60));
  PetscFunctionReturn(0);
}

/* Is it time? Of the first rank's clock, which is the one that speaks */
static PetscErrorCode ProgressIsDue(Simulation sim, PetscLogDouble *now, PetscBool *due)
{
  PetscFunctionBegin;
  PetscCall(PetscTime(now));
  *due = (PetscBool)(sim->monitor && sim->progress.every > 0.0 &&
                     *now - PetscMax(sim->progress.said, sim->start.total) >= sim->progress.every);
  if (*due) sim->progress.said = *now;
  PetscFunctionReturn(0);
}

/* At the rate of the load steps so far, the one under way for as long as a whole one at most; negative: none is done */
static PetscLogDouble ProgressLeft(Simulation sim, PetscLogDouble now)
{
  const Progress      *p    = &sim->progress;
  const PetscReal      time = sim->path.time, done = time - p->first, all = (PetscReal)sim->scene->nsteps;
  const PetscLogDouble rate = done > 0.0 ? (p->reached - p->begun) / done : 0.0;

  return done > 0.0
           ? PetscMax(rate * (all - time) - (now - p->reached), rate * PetscMax(all - PetscFloorReal(time) - 1.0, 0.0))
           : -1.0;
}

static PetscErrorCode ProgressSay(Simulation sim, PetscLogDouble now, const char inside[])
{
  const PetscLogDouble left = ProgressLeft(sim, now);
  char                 so_far[PROGRESS_LENGTH], to_come[PROGRESS_LENGTH];

  PetscFunctionBegin;
  PetscCall(ProgressDuration(now - sim->start.total, so_far));
  PetscCall(ProgressDuration(PetscMax(left, 0.0), to_come));
  PetscCall(PetscPrintf(sim->comm, "Progress: load step %" PetscInt_FMT " of %" PetscInt_FMT "%s, %s so far%s%s%s\n",
    PetscMin((PetscInt)PetscFloorReal(sim->path.time) + 1, sim->scene->nsteps), sim->scene->nsteps, inside, so_far,
    left < 0.0 ? "" : ", about ", left < 0.0 ? "" : to_come, left < 0.0 ? "" : " left"));
  PetscFunctionReturn(0);
}

/* Before a load step */
static PetscErrorCode ProgressBegin(Simulation sim)
{
  Progress *p = &sim->progress;

  PetscFunctionBegin;
  if (p->begun > 0.0) PetscFunctionReturn(0);
  PetscCall(PetscTime(&p->begun));
  p->reached = p->begun;
  p->first   = sim->path.time;
  PetscFunctionReturn(0);
}

/* The state has moved on */
static PetscErrorCode ProgressReach(Simulation sim)
{
  char           inside[48] = "";
  PetscBool      due;
  PetscLogDouble now;

  PetscFunctionBegin;
  PetscCall(ProgressIsDue(sim, &now, &due));
  sim->progress.reached = now;
  if (!due || sim->path.time >= (PetscReal)sim->scene->nsteps) PetscFunctionReturn(0);
  if (sim->path.time > PetscFloorReal(sim->path.time))
    PetscCall(PetscSNPrintf(inside, sizeof(inside), " from time %g", (double)sim->path.time));
  PetscCall(ProgressSay(sim, now, inside));
  PetscFunctionReturn(0);
}

/* In the midst of a solve; goal: the error with which it ends */
static PetscErrorCode ProgressIterate(Simulation sim, PetscInt iteration, PetscReal error, PetscReal goal)
{
  char           inside[96];
  PetscBool      due;
  PetscLogDouble now;

  PetscFunctionBegin;
  PetscCall(ProgressIsDue(sim, &now, &due));
  if (!due) PetscFunctionReturn(0);
  PetscCall(PetscSNPrintf(inside, sizeof(inside), ", iteration %" PetscInt_FMT " with an error of %.1e, %.0e ends it",
    iteration, (double)error, (double)goal));
  PetscCall(ProgressSay(sim, now, inside));
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
  if (!iteration) sim->progress.residual = norm;
  PetscCall(KSPGetTolerances(ksp, &goal, NULL, NULL, NULL));
  PetscCall(ProgressIterate(sim, iteration, norm > 0.0 ? norm / sim->progress.residual : 0.0, goal));
  PetscFunctionReturn(0);
}

PetscErrorCode ProgressObserve(Simulation sim)
{
  PetscFunctionBegin;
  sim->progress = (Progress){.every = 10.0};
  sim->observer = (StepObserver){ProgressBegin, ProgressReach, ProgressMonitorOptimizer, ProgressMonitorLinear};
  PetscFunctionReturn(0);
}
