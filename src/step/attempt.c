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
static PetscErrorCode AttemptGetAllowed(Model model, State state, Vec u, PetscReal *allowed)
{
  const PetscReal part = ModelIsDynamic(model) ? 1e-14 : StepControlRepeats(state->control);
  PetscReal       size, extent;

  PetscFunctionBegin;
  PetscCall(VecNorm(u, NORM_INFINITY, &size));
  PetscCall(VecNorm(model->places.x, NORM_INFINITY, &extent));
  *allowed = PetscMax(part * size, STEP_PLACE_ROUNDING * extent);
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
   linearized rotations agree with the finite ones.
*/
static PetscErrorCode AttemptBodies(StepProblem *p, Vec u, StepReport *report, ContactSolution *sol)
{
  PetscReal allowed = 0.0, last = PETSC_MAX_REAL;
  PetscBool again = PETSC_FALSE;

  PetscFunctionBegin;
  for (PetscInt k = 0; !k || again; ++k) {
    if (k) PetscCall(StepProblemTurn(p, u));
    PetscCall(StepProblemSolve(p, (PetscBool)(k > 0), u, report, sol));
    PetscCall(AttemptGetAllowed(p->model, p->state, u, &allowed));
    again = (PetscBool)(report->converged && AttemptTurnsOn(allowed, last, report->straightened));
    last  = report->straightened;
    if (k < STEP_MAX_REPEATS || !again) continue;
    PetscCall(
      ReportReason(report, PETSC_FALSE, "the free rotations of rigid bodies do not converge; use smaller load steps"));
    again = PETSC_FALSE;
  }
  PetscFunctionReturn(0);
}

/*
   Counts attempts that failed because contact cannot hold the loads. If the count is 2, the load step is not cut
   further. A failure counts 2 if it is proven and no prescribed displacement moves, since smaller increments start from
   the same positions. Other failures count 1.
*/
static PetscErrorCode AttemptCountUnsupported(const StepProblem *p, const StepReport *report)
{
  PetscBool still;

  PetscFunctionBegin;
  if (report->converged || (!p->unsupported && !p->moves_on)) {
    p->state->control->unsupported = 0;
    PetscFunctionReturn(0);
  }
  PetscCall(VecEqual(p->base, p->state->path->u, &still));
  p->state->control->unsupported += still && p->unsupported ? 2 : 1;
  if (!p->state->control->cause) PetscCall(PetscStrallocpy(report->reason, &p->state->control->cause));
  PetscFunctionReturn(0);
}

/*
   Decides whether a controlled time step is accepted. If its error exceeds the tolerance, it is repeated with a shorter
   time step. If contact closes or opens, or if half of the vertices in contact change, the error estimate for motions
   that are not smooth is used. The shortest time steps are always accepted.
*/
static PetscErrorCode AttemptJudgeTimeStep(Model model, State state, PetscReal time, Vec u, StepReport *report)
{
  TimeStepControl *c      = &state->control->time_step;
  const PetscReal  length = time - state->path->time, tolerance = model->scene->dynamics.tolerance;
  PetscInt         closed = 0;
  PetscBool        smooth;

  PetscFunctionBegin;
  c->too_long = PETSC_FALSE;
  if (!(tolerance > 0.0) || !report->converged) PetscFunctionReturn(0);
  if (model->contact) PetscCall(ContactHistoryCountClosed(state->history, model->comm, &closed));
  smooth = (PetscBool)(2 * PetscAbsInt(closed - c->closed) <= PetscMax(closed, c->closed));
  PetscCall(InertiaEstimate(model, state, time, smooth, u, &c->error));
  c->too_long = (PetscBool)(c->error > tolerance && length > STEP_SHORTEST);
  if (c->too_long) {
    PetscCall(ReportReason(report, PETSC_FALSE, "the error %.3g of the time step is above the tolerance %g",
      (double)c->error, (double)tolerance));
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
  if (!sim->model->contact || sim->state->path->time > 0.0 || report->cuts) PetscFunctionReturn(0);
  if (!sim->state->solved->upcoming)
    PetscCall(
      ContactLinearize(sim->model->contact, sim->state->path->u, CONTACT_FORCES, &sim->state->solved->upcoming));
  PetscCall(ContactCheckDepth(sim->model->contact));
  PetscCall(StartWarn(sim, sim->state->solved->upcoming));
  PetscFunctionReturn(0);
}

/*
   Measures the new state and makes it the last one of state->path, which takes u; state->solved takes `sol`. *at_u: the
   linearization at u, which the next load step takes
*/
static PetscErrorCode AttemptAccept(StepProblem *p, Vec *u, ContactSolution *sol, ContactLinearization *at_u,
  StepReport *report)
{
  Simulation sim = p->sim;
  Vec        inertia;

  PetscFunctionBegin;
  PetscCall(PetscLogEventBegin(SIM_Forces, NULL, NULL, NULL, NULL));
  PetscCall(InertiaGetForce(p->model, *u, &inertia));
  PetscCall(ElasticityCommit(p->model->elasticity, *u));
  PetscCall(InertiaAdvance(p->model, p->state, p->time, *u));
  PetscCall(PetscLogEventEnd(SIM_Forces, NULL, NULL, NULL, NULL));
  PetscCall(MeasureState(sim, p->time, p->load, inertia, *u, sol, report));
  PetscCall(VecDestroy(&inertia));
  if (p->model->contact) PetscCall(FrictionSettle(p->model, p->state, p->time, *u, sol));
  PetscCall(ContactSolutionDestroy(&p->state->solved->solution));
  p->state->solved->solution = *sol;
  *sol                       = (ContactSolution){.gap = NULL};
  PetscCall(PathAdvance(p->state->path, p->time, u));
  PetscCall(ContactLinearizationDestroy(&p->state->solved->upcoming));
  /* if only the gap was computed, the next load step must linearize again */
  if (*at_u && (*at_u)->gaps_only) PetscCall(ContactLinearizationDestroy(at_u));
  p->state->solved->upcoming = *at_u;
  if (*at_u) PetscCall(InterferenceAdd(p->model, p->state, p->time, -1.0, p->state->solved->upcoming));
  *at_u = NULL;
  PetscFunctionReturn(0);
}

/*
   Attempts to advance the state to `time`. After success state->path, state->solved->linearization, pressures and gaps
   are those of the new state. After a failure they are unchanged.
*/
PetscErrorCode SimulationAttempt(Simulation sim, PetscReal time, StepReport *report)
{
  const PetscInt       first = sim->model->scene->displacement_bounds;
  StepProblem          p;
  ContactSolution      sol  = {.gap = NULL};
  ContactLinearization last = sim->state->solved->linearization, at_u = NULL;
  Vec                  u;

  PetscFunctionBegin;
  PetscCall(AttemptCheckStart(sim, report));
  PetscCall(PetscLogEventBegin(SIM_Assembly, NULL, NULL, NULL, NULL));
  PetscCall(StepProblemCreate(sim, time, &p));
  PetscCall(PetscLogEventEnd(SIM_Assembly, NULL, NULL, NULL, NULL));
  PetscCall(VecDuplicate(sim->state->path->u, &u));
  if (first && time > (PetscReal)(first - 1) && sim->state->path->largest_increment > 0.0)
    PetscCall(StepProblemSetBounds(&p, sim->state->path->largest_increment));
  if (sim->model->contact) {
    PetscCall(ContactUpdatesSolve(&p, u, report, &sol, &at_u));
    PetscCall(PetscLogEventBegin(SIM_Forces, NULL, NULL, NULL, NULL));
    PetscCall(LostContactSettle(&p, last, u, &sol, &at_u, report));
    PetscCall(MissedFindPassed(sim->model, sim->state, time, u, report));
    PetscCall(PetscLogEventEnd(SIM_Forces, NULL, NULL, NULL, NULL));
  } else PetscCall(AttemptBodies(&p, u, report, &sol));
  PetscCall(AttemptCountUnsupported(&p, report));
  PetscCall(AttemptJudgeTimeStep(sim->model, sim->state, time, u, report));
  if (report->converged) {
    PetscCall(AttemptAccept(&p, &u, &sol, &at_u, report));
    PetscCall(ContactLinearizationDestroy(&last));
  } else if (sim->model->contact) {
    PetscCall(ContactLinearizationDestroy(&sim->state->solved->linearization));
    sim->state->solved->linearization = last;
  }
  PetscCall(ContactLinearizationDestroy(&at_u));
  PetscCall(VecDestroy(&u));
  PetscCall(ContactSolutionDestroy(&sol));
  PetscCall(StepProblemDestroy(&p));
  PetscFunctionReturn(0);
}
