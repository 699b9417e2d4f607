/* Attempts to reach a time: solves the problem, measures the new state, and accepts or rejects it */
#include "stepimpl.h"
#include "src/state/contact_history.h"
#include "src/state/contact_state.h"
#include "src/state/control.h"
#include "src/state/path.h"

/*
   Computes the allowed error of linearized rotations. *allowed: a fraction of the largest displacement, but at least 32
   times the rounding error of the coordinates [length]. The fraction is small in time steps, because energy and angular
   momentum depend on the rotations (turn.c).
*/
static PetscErrorCode AttemptGetAllowed(Simulation sim, Vec u, PetscReal *allowed)
{
  const PetscReal part = SimulationIsDynamic(sim) ? 1e-14 : PetscMax(1e-3 * sim->control->tolerances.optimizer, 1e-12);
  PetscReal       size, extent;

  PetscFunctionBegin;
  PetscCall(VecNorm(u, NORM_INFINITY, &size));
  PetscCall(VecNorm(sim->places.x, NORM_INFINITY, &extent));
  *allowed = PetscMax(part * size, 32.0 * PETSC_MACHINE_EPSILON * extent);
  PetscFunctionReturn(0);
}

/*
   Returns whether free rotations must be linearized again. error: of the linearized rotations; last: in the previous
   solve. The error does not fall below the rounding error of the linear systems, which depends on the nodes that carry
   the motions and may exceed `allowed`. Therefore an error that no longer falls is accepted below 100 times `allowed`.
*/
static PetscBool AttemptTurnsOn(PetscReal allowed, PetscReal last, PetscReal error)
{
  const PetscBool stagnates = (PetscBool)(error > 0.5 * last && error <= 100.0 * allowed);

  return (PetscBool)(error > allowed && !stagnates);
}

/*
   Solves a problem without contact. Rotations of rigid bodies that turn freely are linearized again until the
   linearized rotations agree with the finite ones. foreseen: true if u is a forecast on entry.
*/
static PetscErrorCode AttemptBodies(StepProblem *p, PetscBool foreseen, Vec u, StepReport *report, ContactSolution *sol)
{
  const PetscInt most    = 50;
  PetscReal      allowed = 0.0, last = PETSC_MAX_REAL;
  PetscBool      again = PETSC_FALSE;

  PetscFunctionBegin;
  for (PetscInt k = 0; !k || again; ++k) {
    if (k || foreseen) PetscCall(StepProblemTurn(p, u));
    PetscCall(StepProblemSolve(p, (PetscBool)(foreseen || k), u, report, sol));
    PetscCall(AttemptGetAllowed(p->sim, u, &allowed));
    again = (PetscBool)(report->converged && AttemptTurnsOn(allowed, last, report->straightened));
    last  = report->straightened;
    if (k < most || !again) continue;
    PetscCall(
      ReportReason(report, PETSC_FALSE, "the free rotations of rigid bodies do not converge; use smaller load steps"));
    again = PETSC_FALSE;
  }
  PetscFunctionReturn(0);
}

static PetscErrorCode AttemptKeepSurface(Simulation sim, const ContactSolution *sol)
{
  const PetscInt     n = sim->solved->linearization->nlocal;
  const PetscScalar *z, *g;

  PetscFunctionBegin;
  PetscCall(PetscFree2(sim->solved->pressure, sim->solved->gap));
  PetscCall(PetscMalloc2(n, &sim->solved->pressure, n, &sim->solved->gap));
  PetscCall(VecGetArrayRead(sol->pressure, &z));
  PetscCall(VecGetArrayRead(sol->gap, &g));
  for (PetscInt i = 0; i < n; ++i) {
    sim->solved->pressure[i] = PetscRealPart(z[i]);
    sim->solved->gap[i]      = PetscRealPart(g[i]);
  }
  PetscCall(VecRestoreArrayRead(sol->gap, &g));
  PetscCall(VecRestoreArrayRead(sol->pressure, &z));
  PetscFunctionReturn(0);
}

/*
   Counts attempts that failed because contact cannot hold the loads. If the count is 2, the load step is not cut
   further. A failure counts 2 if it is proven and no prescribed displacement moves, since smaller increments start from
   the same positions. Other failures count 1.
*/
static PetscErrorCode AttemptCountUnsupported(const StepProblem *p, const StepReport *report)
{
  Simulation sim = p->sim;
  PetscBool  still;

  PetscFunctionBegin;
  if (report->converged || (!p->unsupported && !p->moves_on)) {
    sim->control->unsupported = 0;
    PetscFunctionReturn(0);
  }
  PetscCall(VecEqual(p->base, sim->path->u, &still));
  sim->control->unsupported += still && p->unsupported ? 2 : 1;
  if (!sim->control->cause) PetscCall(PetscStrallocpy(report->reason, &sim->control->cause));
  PetscFunctionReturn(0);
}

/*
   Decides whether a controlled time step is accepted. If its error exceeds the tolerance, it is repeated with a shorter
   time step. If contact closes or opens, or if half of the vertices in contact change, the error estimate for motions
   that are not smooth is used. The shortest time steps are always accepted.
*/
static PetscErrorCode AttemptJudgeTimeStep(Simulation sim, PetscReal time, Vec u, StepReport *report)
{
  TimeStepControl *c      = &sim->control->time_step;
  const PetscReal  length = time - sim->path->time, tolerance = sim->scene->dynamics.tolerance;
  PetscInt         closed = 0;
  PetscBool        smooth;
  char             reason[96];

  PetscFunctionBegin;
  c->too_long = PETSC_FALSE;
  if (!(tolerance > 0.0) || !report->converged) PetscFunctionReturn(0);
  if (sim->contact) PetscCall(ContactHistoryCountClosed(sim->history, sim->comm, &closed));
  smooth = (PetscBool)(2 * PetscAbsInt(closed - c->closed) <= PetscMax(closed, c->closed));
  PetscCall(InertiaEstimate(sim, time, smooth, u, &c->error));
  c->too_long = (PetscBool)(c->error > tolerance && length > STEP_SHORTEST);
  if (c->too_long) {
    PetscCall(PetscSNPrintf(reason, sizeof(reason), "the error %.3g of the time step is above the tolerance %g",
      (double)c->error, (double)tolerance));
    PetscCall(ReportReason(report, PETSC_FALSE, reason));
  } else {
    c->closed   = closed;
    c->largest  = PetscMax(c->largest, c->error);
    c->shortest = PetscMin(c->shortest, length);
  }
  PetscFunctionReturn(0);
}

/* Collective. Before the first load step: warns of contact pairs that penetrate or are apart */
static PetscErrorCode AttemptCheckStart(Simulation sim, const StepReport *report)
{
  PetscFunctionBegin;
  if (!sim->contact || sim->path->time > 0.0 || report->cuts || sim->control->forecast.failed) PetscFunctionReturn(0);
  if (!sim->solved->upcoming)
    PetscCall(ContactLinearize(sim->contact, sim->path->u, CONTACT_FORCES, &sim->solved->upcoming));
  PetscCall(ContactCheckDepth(sim->contact));
  PetscCall(StartWarn(sim, sim->solved->upcoming));
  PetscFunctionReturn(0);
}

/*
   Measures the new state and makes it the last one of sim->path, which takes u. *at_u: the linearization at u, which
   the next load step takes
*/
static PetscErrorCode AttemptAccept(StepProblem *p, Vec *u, ContactSolution *sol, ContactLinearization *at_u,
  StepReport *report)
{
  Simulation sim = p->sim;
  Vec        inertia;

  PetscFunctionBegin;
  PetscCall(PetscLogEventBegin(SIM_Forces, NULL, NULL, NULL, NULL));
  PetscCall(InertiaGetForce(sim, *u, &inertia));
  PetscCall(ElasticityCommit(sim->elasticity, *u));
  PetscCall(InertiaAdvance(sim, p->time, *u));
  PetscCall(PetscLogEventEnd(SIM_Forces, NULL, NULL, NULL, NULL));
  PetscCall(MeasureState(sim, p->time, p->load, inertia, *u, sol, report));
  PetscCall(VecDestroy(&inertia));
  PetscCall(SchemeRelease(sim->path->contact, &sim->dynamics)); /* MeasureState() has set these contact forces */
  if (sim->contact) PetscCall(AttemptKeepSurface(sim, sol));
  if (sim->contact) PetscCall(FrictionSettle(sim, p->time, *u, sol));
  PetscCall(PathAdvance(sim->path, p->time, u));
  PetscCall(ContactLinearizationDestroy(&sim->solved->upcoming));
  /* if only the gap was computed, the next load step must linearize again */
  if (*at_u && (*at_u)->gaps_only) PetscCall(ContactLinearizationDestroy(at_u));
  sim->solved->upcoming = *at_u;
  if (*at_u) PetscCall(InterferenceAdd(sim, p->time, -1.0, sim->solved->upcoming));
  *at_u = NULL;
  PetscFunctionReturn(0);
}

/*
   Attempts to advance the state to `time`. After success sim->path, sim->solved->linearization, pressures and gaps are
   those of the new state. After a failure they are unchanged.
*/
PetscErrorCode SimulationAttempt(Simulation sim, PetscReal time, StepReport *report)
{
  const PetscInt       first = sim->scene->displacement_bounds;
  StepProblem          p;
  ContactSolution      sol  = {.gap = NULL};
  ContactLinearization last = sim->solved->linearization, at_u = NULL;
  PetscBool            foreseen;
  Vec                  u;

  PetscFunctionBegin;
  PetscCall(AttemptCheckStart(sim, report));
  PetscCall(PetscLogEventBegin(SIM_Assembly, NULL, NULL, NULL, NULL));
  PetscCall(StepProblemCreate(sim, time, &p));
  PetscCall(PetscLogEventEnd(SIM_Assembly, NULL, NULL, NULL, NULL));
  PetscCall(VecDuplicate(sim->path->u, &u));
  if (first && time > (PetscReal)(first - 1) && sim->path->largest_increment > 0.0)
    PetscCall(StepProblemSetBounds(&p, sim->path->largest_increment));
  PetscCall(ForecastGet(&p, u, &foreseen));
  if (sim->contact) {
    PetscCall(ContactUpdatesSolve(&p, foreseen, u, report, &sol, &at_u));
    PetscCall(PetscLogEventBegin(SIM_Forces, NULL, NULL, NULL, NULL));
    PetscCall(LostContactSettle(&p, last, u, &sol, &at_u, report));
    PetscCall(MissedFindPassed(sim, time, u, report));
    PetscCall(PetscLogEventEnd(SIM_Forces, NULL, NULL, NULL, NULL));
  } else PetscCall(AttemptBodies(&p, foreseen, u, report, &sol));
  PetscCall(AttemptCountUnsupported(&p, report));
  PetscCall(AttemptJudgeTimeStep(sim, time, u, report));
  if (report->converged) {
    PetscCall(AttemptAccept(&p, &u, &sol, &at_u, report));
    PetscCall(ContactLinearizationDestroy(&last));
  } else if (sim->contact) {
    PetscCall(ContactLinearizationDestroy(&sim->solved->linearization));
    sim->solved->linearization = last;
  }
  PetscCall(ContactLinearizationDestroy(&at_u));
  PetscCall(VecDestroy(&u));
  PetscCall(ContactSolutionDestroy(&sol));
  PetscCall(StepProblemDestroy(&p));
  PetscFunctionReturn(0);
}
