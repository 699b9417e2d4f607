/*
   Forces that depend on the solution.

     Pressures that follow their faces (follower loads): within a solve the load is linear in the displacement. It is
     the value at a centre plus the symmetric part of the derivative at the centre times the displacement from the
     centre, so that the load has a potential. After each solve the centre moves towards the solution, until the
     linearized load agrees with the load at the solution. If the derivative is symmetric, this is Newton's method.

     Internal forces in time steps: the mean of the internal forces of the step (src/elasticity/mean_force.c) is
     evaluated at a displacement that moves towards the solution in the same manner.
*/
#include "problemimpl.h"
#include "src/state/control.h"
#include "src/state/path.h"

static PetscBool FollowersAny(Scene scene)
{
  PetscBool any = PETSC_FALSE;

  for (PetscInt p = 0; p < scene->npressures; ++p) any = (PetscBool)(any || scene->pressures[p].follows);
  return any;
}

/*
   Computes the loads at u. *load: dead loads plus follower loads [force]; slope: derivative of the follower loads
   [force/length]; NULL: not computed.
*/
static PetscErrorCode FollowersGet(const StepProblem *p, Vec u, Vec *load, Mat slope)
{
  const Constraints constraints = ModelConstraints(p->model);

  PetscFunctionBegin;
  PetscCall(DeadLoadsGet(&p->model->loads, p->time, load));
  PetscCall(RigidTurnLoads(&constraints, 1.0, p->time, *load));
  if (!*load) {
    PetscCall(VecDuplicate(u, load));
    PetscCall(VecZeroEntries(*load));
  }
  if (slope) PetscCall(MatZeroEntries(slope));
  for (PetscInt i = 0; i < p->model->scene->npressures; ++i) {
    ScenePressure *pressure = &p->model->scene->pressures[i];
    PetscReal      factor;

    if (!pressure->follows) continue;
    PetscCall(SceneGetFactor(p->model->scene, pressure->ramp, p->time, &factor));
    PetscCall(
      ElasticityAddFollower(p->model->elasticity, pressure->face, factor, PressureAt, pressure, u, *load, slope));
  }
  if (!slope) PetscFunctionReturn(0);
  PetscCall(MatAssemblyBegin(slope, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(slope, MAT_FINAL_ASSEMBLY));
  PetscFunctionReturn(0);
}

/* Computes p->load and its derivative at the centre p->followed. */
static PetscErrorCode FollowersLinearize(StepProblem *p)
{
  PetscFunctionBegin;
  PetscCall(VecDestroy(&p->load));
  PetscCall(FollowersGet(p, p->followed, &p->load, p->model->follows));
  PetscFunctionReturn(0);
}

/* Replaces the dead loads of the problem by the loads linearized at p->base if any pressure follows its face. */
PetscErrorCode FollowersBegin(StepProblem *p)
{
  PetscFunctionBegin;
  if (!FollowersAny(p->model->scene)) PetscFunctionReturn(0);
  if (!p->model->follows) PetscCall(ElasticityCreateTangent(p->model->elasticity, &p->model->follows));
  PetscCall(VecDuplicate(p->base, &p->followed));
  PetscCall(VecCopy(p->base, p->followed));
  PetscCall(FollowersLinearize(p));
  PetscFunctionReturn(0);
}

/* Computes p->load again after the dead loads have changed. */
PetscErrorCode FollowersTurn(StepProblem *p)
{
  PetscFunctionBegin;
  if (p->followed) PetscCall(FollowersLinearize(p));
  PetscFunctionReturn(0);
}

/* Discards the secants of the previous problem, which do not fit a problem with another linearized gap. */
PetscErrorCode FollowersForget(StepProblem *p)
{
  PetscFunctionBegin;
  PetscCall(AndersonDestroy(&p->secants));
  p->secants = (Anderson){0};
  PetscFunctionReturn(0);
}

/*
   Subtracts from *energy and `force` the potential and the force of the part of the follower loads that is linear in u,
   K_f (u - centre). force: may be NULL. The constant part is in p->load.
*/
PetscErrorCode FollowersSubtract(const StepProblem *p, Vec u, PetscReal *energy, Vec force)
{
  PetscFunctionBegin;
  if (p->followed) PetscCall(CentredAdd(-1.0, p->model->follows, NULL, p->followed, u, energy, force));
  PetscFunctionReturn(0);
}

/*
   Ends a solve in which pressures that follow their faces have no equilibrium, because they exceed a limit load: that
   of a balloon, for example. The objective then falls in steps that are shortened, or whose tangent is indefinite.
*/
PetscErrorCode FollowersTestLimit(Tao tao, void *ctx)
{
  StepProblem       *p        = (StepProblem *)ctx;
  const PetscInt     patience = 15;
  PetscInt           its, indefinite;
  PetscReal          f, length;
  PetscBool          poor;
  TaoConvergedReason reason;

  PetscFunctionBegin;
  PetscCall(TaoGetSolutionStatus(tao, &its, &f, NULL, NULL, &length, &reason));
  PetscCall(TaoIPFilterGetRegularizations(tao, &indefinite, NULL, NULL));
  poor = (PetscBool)(indefinite > p->nindefinite || length < 1.0);
  if (!its) p->nfalls = 0;
  else p->nfalls = poor && f < p->last_f ? p->nfalls + 1 : PetscMax(p->nfalls - 1, 0);
  p->nindefinite = indefinite;
  p->last_f      = f;
  if (reason != TAO_CONTINUE_ITERATING || p->nfalls < patience) PetscFunctionReturn(0);
  p->beyond_limit = PETSC_TRUE;
  PetscCall(TaoSetConvergedReason(tao, TAO_DIVERGED_USER));
  PetscFunctionReturn(0);
}

/* Reports that FollowersTestLimit() has ended the solve */
PetscErrorCode FollowersReportLimit(const StepProblem *p, StepReport *report)
{
  PetscFunctionBegin;
  PetscCall(ReportReason(report, PETSC_FALSE,
    "no equilibrium was found at time %g: the pressures that follow their faces seem to exceed a limit load, because "
    "the stiffness stays indefinite while the bodies move on; the last equilibrium is at time %g; prescribe "
    "displacements in place of the pressures to pass the limit",
    (double)p->time, (double)p->state->path->time));
  PetscFunctionReturn(0);
}

/*
   Compares the linearized follower loads with the loads at the solution u. *again: true if they differ, so that another
   solve must follow with the loads linearized at a new centre. Otherwise p->load becomes the load at u. nsolves: number
   of solves so far.
*/
PetscErrorCode FollowersAdvance(StepProblem *p, Vec u, PetscInt nsolves, StepReport *report, PetscBool *again)
{
  const PetscReal tolerance = StepControlRepeats(p->state->control);
  PetscReal       off, size, energy = 0.0;
  PetscBool       damped;
  Vec             linear, load;

  PetscFunctionBegin;
  if (!p->followed || !report->converged) PetscFunctionReturn(0);
  PetscCall(FollowersGet(p, u, &load, NULL));
  PetscCall(VecDuplicate(load, &linear));
  PetscCall(VecCopy(load, linear));
  PetscCall(VecAXPY(linear, -1.0, p->load));
  PetscCall(FollowersSubtract(p, u, &energy, linear));
  PetscCall(PrescribedSet(&p->model->prescribed, 0.0, linear));
  PetscCall(VecNorm(linear, NORM_2, &off));
  PetscCall(VecNorm(load, NORM_2, &size));
  PetscCall(VecDestroy(&linear));
  if (off <= tolerance * size) {
    PetscCall(VecCopy(u, p->followed));
    PetscCall(VecDestroy(&p->load));
    p->load = load;
    PetscFunctionReturn(0);
  }
  PetscCall(VecDestroy(&load));
  if (nsolves < STEP_MAX_REPEATS) {
    PetscCall(AndersonAdvance(&p->secants, off, u, p->followed, &damped));
    *again = PETSC_TRUE;
    PetscCall(FollowersLinearize(p));
  } else
    PetscCall(ReportReason(report, PETSC_FALSE,
      "no equilibrium was found with the pressures that follow their faces; use smaller load steps"));
  PetscFunctionReturn(0);
}

/*
   Chooses the first displacement at which the mean internal force of a time step of the impact scheme is evaluated: the
   path extrapolated with constant accelerations, or with contact the last state.
*/
PetscErrorCode FollowersForesee(StepProblem *p)
{
  PetscFunctionBegin;
  if (!p->model->dynamics.residual || p->model->quadratic) PetscFunctionReturn(0);
  PetscCall(VecDuplicate(p->base, &p->meant));
  if (p->model->contact) PetscCall(VecCopy(p->state->path->u, p->meant));
  else PetscCall(PathContinue(p->model, p->state, p->time, p->meant));
  PetscCall(InertiaSetExcess(p->model, p->state, p->meant));
  PetscFunctionReturn(0);
}

/*
   Compares the mean internal force of the solve with that of a step to the solution u. *again: set to true if another
   solve with another mean internal force must follow. Early contact updates, which are solved inexactly, do not repeat
   the solve.
*/
PetscErrorCode FollowersAdvanceMean(StepProblem *p, Vec u, PetscInt nsolves, StepReport *report, PetscBool *again)
{
  const PetscReal tolerance = 1e-4; /* relative; the error of the energy is of second order in this change */
  const PetscInt  most      = 15;
  PetscReal       size, change;
  PetscBool       damped;

  PetscFunctionBegin;
  if (!p->meant || !report->converged) PetscFunctionReturn(0);
  PetscCall(VecNorm(u, NORM_INFINITY, &size));
  PetscCall(InertiaMeasureExcess(p->model, p->state, u, MEASURE_ROUNDING * p->model->stiffness * size, &change));
  if (change <= tolerance) PetscFunctionReturn(0);
  if (nsolves < most) {
    PetscCall(AndersonAdvance(&p->mean_secants, change, u, p->meant, &damped));
    PetscCall(InertiaSetExcess(p->model, p->state, p->meant));
    *again = (PetscBool)(*again || !p->ended_early);
  } else
    PetscCall(ReportReason(report, PETSC_FALSE,
      "no mean internal force was found that conserves the energy of the time step; use smaller time steps"));
  PetscFunctionReturn(0);
}
