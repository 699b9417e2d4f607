/* Creates the optimization problem of one load step: the parts that quadratic and nonlinear energies have in common. */
#include "problemimpl.h"
#include "src/state/control.h"
#include "src/state/path.h"

/*
   Sets p->base, the displacement about which the energy is expanded: the last state with the displacements prescribed
   at p->time. If a free body moves far in a time step, the rounding errors of K (u - base) would be as large as the
   inertia forces; the base is then the extrapolated path.
*/
static PetscErrorCode StepProblemStartBase(StepProblem *p)
{
  PetscBool small = PETSC_FALSE;

  PetscFunctionBegin;
  if (p->model->contact && p->model->quadratic) PetscCall(InertiaIsSmall(p->model, &small));
  if (small) PetscCall(PathContinue(p->model, p->state, p->time, p->base));
  else PetscCall(VecCopy(p->state->path->u, p->base));
  PetscCall(PrescribedApply(&p->model->prescribed, p->time, p->base));
  PetscFunctionReturn(0);
}

/*
   Sets p->base and p->load for rigid bodies that turn freely and are linearized about u. *anew: true if the tangent of
   linear bodies has changed.
*/
static PetscErrorCode StepProblemSetBase(StepProblem *p, Vec u, PetscBool *anew)
{
  const Constraints constraints = ModelConstraints(p->model);

  PetscFunctionBegin;
  PetscCall(StepProblemStartBase(p));
  PetscCall(TiesTurn(&constraints, p->time, p->state->path->u, u, anew));
  PetscCall(TiesFollow(&p->model->ties, p->base));
  PetscCall(VecDestroy(&p->load));
  PetscCall(DeadLoadsGet(&p->model->loads, p->time, &p->load));
  PetscCall(RigidTurnLoads(&constraints, 1.0, p->time, p->load));
  PetscCall(TurnSetForce(&constraints, p->state->path->u, u, p->load, p->pressed, &p->model->dynamics));
  PetscFunctionReturn(0);
}

/* Computes energy and gradient of the quadratic model at p->base, and its tangent if `anew` is true. */
PetscErrorCode StepProblemSetQuadratic(StepProblem *p, PetscBool anew)
{
  const Constraints constraints = ModelConstraints(p->model);
  PetscScalar       work        = 0.0;

  PetscFunctionBegin;
  PetscCall(PetscLogEventBegin(SIM_Assembly, NULL, NULL, NULL, NULL));
  if (anew) PetscCall(TiesTangent(&constraints, p->state->path->u, p->model->K));
  PetscCall(ElasticityEnergy(p->model->elasticity, p->base, &p->energy));
  PetscCall(ElasticityForce(p->model->elasticity, p->base, p->force));
  PetscCall(PetscLogEventEnd(SIM_Assembly, NULL, NULL, NULL, NULL));
  if (p->load) {
    PetscCall(VecDot(p->load, p->base, &work));
    PetscCall(VecAXPY(p->force, -1.0, p->load));
  }
  p->energy -= PetscRealPart(work);
  PetscCall(SchemeAddForce(&p->model->dynamics, p->base, &p->energy, p->force));
  PetscCall(TiesGather(&p->model->ties, p->force));
  PetscCall(ProximalAdd(p, p->base, &p->energy, p->force));
  PetscCall(PrescribedSet(&p->model->prescribed, 0.0, p->force));
  PetscFunctionReturn(0);
}

/*
   Creates the problem of the load step to `time`. Energy and gradient at p->base are computed element by element,
   because the tangent has no columns of prescribed rows. The quadratic model uses the tangent at the last state. For
   the nonlinear energy the callbacks of the optimizer assemble the tangent at each iterate.
*/
PetscErrorCode StepProblemCreate(Simulation sim, PetscReal time, StepProblem *p)
{
  const Bodies bodies = ModelBodies(sim->model);
  PetscBool    linear, anew, changed = PETSC_FALSE;

  PetscFunctionBegin;
  PetscCall(PetscMemzero(p, sizeof(*p)));
  p->sim       = sim;
  p->model     = sim->model;
  p->state     = sim->state;
  p->time      = time;
  p->quadratic = sim->model->quadratic;
  PetscCall(PetscObjectReference((PetscObject)sim->model->K));
  p->K = sim->model->K;
  PetscCall(VecDuplicate(sim->state->path->u, &p->base));
  PetscCall(VecDuplicate(sim->state->path->u, &p->w));
  PetscCall(StepProblemSetBase(p, sim->state->path->u, &anew));
  PetscCall(TemperaturesApply(&sim->model->temperatures, time));
  PetscCall(BoltsBegin(&bodies, &sim->model->bolts, time, sim->state->path->u));
  PetscCall(FollowersBegin(p));
  PetscCall(ProximalBegin(p));
  if (ModelIsDynamic(sim->model)) PetscCall(InertiaBegin(sim->model, sim->state, time, &changed));
  PetscCall(FollowersForesee(p));
  if (!sim->model->quadratic) PetscFunctionReturn(0);

  PetscCall(VecDuplicate(sim->state->path->u, &p->force));
  PetscCall(VecDuplicate(sim->state->path->u, &p->Kw));
  PetscCall(ElasticityIsLinear(sim->model->elasticity, &linear));
  PetscCall(StepProblemSetQuadratic(p, (PetscBool)(anew || changed || !linear)));
  PetscFunctionReturn(0);
}

/* Linearizes rigid bodies that turn freely about u, and updates the problem. */
PetscErrorCode StepProblemTurn(StepProblem *p, Vec u)
{
  PetscBool anew;

  PetscFunctionBegin;
  if (!p->model->rigid.turns) PetscFunctionReturn(0);
  PetscCall(StepProblemSetBase(p, u, &anew));
  PetscCall(FollowersTurn(p));
  PetscCall(ProximalTurn(p, u));
  if (p->model->quadratic) PetscCall(StepProblemSetQuadratic(p, (PetscBool)(anew || ModelIsDynamic(p->model))));
  PetscFunctionReturn(0);
}

/*
   Updates the shortenings of the bolts after a solve. *again: set to true if another solve must follow, because the
   shortenings have changed.
*/
PetscErrorCode StepProblemAdvanceBolts(StepProblem *p, Vec u, StepReport *report, PetscBool *again)
{
  const Bodies    bodies    = ModelBodies(p->model);
  const PetscReal tolerance = PetscMax(1e-1 * PetscMax(p->state->control->tolerances.optimizer, p->tolerance), 1e-9);
  PetscBool       changes   = PETSC_FALSE;
  const char     *failed;

  PetscFunctionBegin;
  if (!report->converged || *again) PetscFunctionReturn(0);
  PetscCall(BoltsAdvance(&bodies, &p->model->bolts, tolerance, u, &changes, &failed));
  if (failed) {
    PetscCall(ReportReason(report, PETSC_FALSE,
      "bolt \"%s\" does not reach its force: no part resists it; check supports and contact of the parts it clamps",
      failed));
  }
  if (!changes) PetscFunctionReturn(0);
  *again = (PetscBool)(*again || !p->ended_early);
  if (p->model->quadratic) PetscCall(StepProblemSetQuadratic(p, PETSC_FALSE));
  PetscFunctionReturn(0);
}

/*
   Sets gap and matrix of the linearized contact: c(u) = g + J_full (u - u_linearized) = p->g + p->J (u - base) with
   p->g = g + J_full (base - u_linearized), where g includes the depth of soft rows. p->J is J_full with zero columns
   for prescribed displacements.
*/
PetscErrorCode StepProblemSetContact(StepProblem *p, ContactLinearization lin, Vec u_linearized)
{
  Vec mask;

  PetscFunctionBegin;
  PetscCall(VecDestroy(&p->g));
  PetscCall(MatDestroy(&p->J));
  PetscCall(VecDuplicate(lin->g, &p->g));
  PetscCall(SoftSetUp(p, lin));
  PetscCall(VecWAXPY(p->w, -1.0, u_linearized, p->base));
  PetscCall(MatMultAdd(lin->J, p->w, lin->g, p->g));
  if (p->soft.depth) PetscCall(VecAXPY(p->g, 1.0, p->soft.depth));
  if (p->model->ties.C) PetscCall(MatMatMult(lin->J, p->model->ties.C, MAT_INITIAL_MATRIX, PETSC_DEFAULT, &p->J));
  else PetscCall(MatDuplicate(lin->J, MAT_COPY_VALUES, &p->J));
  PetscCall(VecDuplicate(p->base, &mask));
  PetscCall(VecSet(mask, 1.0));
  PetscCall(PrescribedSet(&p->model->prescribed, 0.0, mask));
  PetscCall(MatDiagonalScale(p->J, NULL, mask));
  PetscCall(FrictionSetUp(p, lin, u_linearized, mask));
  PetscCall(VecDestroy(&mask));
  PetscFunctionReturn(0);
}

/*
   Sets the bounds |u - base| <= increment; an infinite increment gives infinite bounds. Prescribed and tied rows get
   infinite bounds.
*/
PetscErrorCode StepProblemSetBounds(StepProblem *p, PetscReal increment)
{
  PetscFunctionBegin;
  PetscCall(VecDuplicate(p->base, &p->lower));
  PetscCall(VecDuplicate(p->base, &p->upper));
  PetscCall(VecCopy(p->base, p->lower));
  PetscCall(VecCopy(p->base, p->upper));
  PetscCall(VecShift(p->lower, -increment));
  PetscCall(VecShift(p->upper, increment));
  PetscCall(PrescribedSet(&p->model->prescribed, PETSC_NINFINITY, p->lower));
  PetscCall(PrescribedSet(&p->model->prescribed, PETSC_INFINITY, p->upper));
  PetscCall(TiesSet(&p->model->ties, PETSC_NINFINITY, p->lower));
  PetscCall(TiesSet(&p->model->ties, PETSC_INFINITY, p->upper));
  PetscFunctionReturn(0);
}

/*
   Finds, once for each problem, whether contact forces can balance the loads, and reports the bodies that they cannot
   hold. Nothing is tested in a dynamic analysis, where inertia balances any load.
*/
PetscErrorCode StepProblemForesee(StepProblem *p, StepReport *report)
{
  PetscFunctionBegin;
  if (p->foreseen || p->lower || ModelIsDynamic(p->model)) PetscFunctionReturn(0);
  p->foreseen = PETSC_TRUE;
  PetscCall(EquilibriumDiagnose(p->model, p->state, p->time, p->load, report, &p->unsupported));
  PetscFunctionReturn(0);
}

PetscErrorCode StepProblemDestroy(StepProblem *p)
{
  PetscFunctionBegin;
  PetscCall(MatDestroy(&p->K));
  PetscCall(MatDestroy(&p->J));
  PetscCall(VecDestroy(&p->g));
  PetscCall(SoftDestroy(&p->soft));
  PetscCall(VecDestroy(&p->base));
  PetscCall(ProximalEnd(p));
  PetscCall(VecDestroy(&p->followed));
  PetscCall(VecDestroy(&p->meant));
  PetscCall(AndersonDestroy(&p->mean_secants));
  PetscCall(AndersonDestroy(&p->secants));
  PetscCall(VecDestroy(&p->load));
  PetscCall(VecDestroy(&p->force));
  PetscCall(VecDestroy(&p->lower));
  PetscCall(VecDestroy(&p->upper));
  PetscCall(VecDestroy(&p->w));
  PetscCall(VecDestroy(&p->tangent_at));
  PetscCall(VecDestroy(&p->tangent_before));
  PetscCall(VecDestroy(&p->Kw));
  PetscCall(MatDestroy(&p->directions));
  PetscCall(PetscFree(p->direction));
  PetscCall(VecDestroy(&p->pressed));
  PetscCall(FrictionDestroy(&p->friction));
  PetscFunctionReturn(0);
}

PetscErrorCode StepProblemConstraint(Tao tao, Vec u, Vec c, void *ctx)
{
  StepProblem *p = (StepProblem *)ctx;

  PetscFunctionBegin;
  (void)tao;
  PetscCall(VecWAXPY(p->w, -1.0, p->base, u));
  PetscCall(MatMultAdd(p->J, p->w, p->g, c));
  PetscFunctionReturn(0);
}

/*
   Callback for a matrix that is constant. The matrix is not changed, so that the optimizer finds its object state
   unchanged.
*/
PetscErrorCode StepProblemConstant(Tao tao, Vec u, Mat A, Mat Apre, void *ctx)
{
  PetscFunctionBegin;
  (void)tao, (void)u, (void)A, (void)Apre, (void)ctx;
  PetscFunctionReturn(0);
}
