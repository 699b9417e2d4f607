/*
   Newton's method with the subspace, for min f(x), c_I(x) >= 0 with linear c_I and an f that is not quadratic,
   such as the strain energy of bodies at finite strain. At each iterate the model
     min 1/2 d^T H d + grad f^T d,  c_I + J d >= 0
   is solved in V as in method.c, until its residual is a given fraction of that of the iterate.
   The step d minimizes the model in V, with multipliers M lambda. Hence grad f^T d = -d^T H d - lambda^T M c_I, and d
   is a descent direction of f + nu sum m max(-c_I, 0) for any nu above the multipliers, however few directions V has.
   The energy of soft rows is part of f; being convex, it falls along d at least in proportion to its fall in the model.
   Since c_I is linear, a feasible point remains feasible for step lengths up to 1. V is used again in the next step;
   for a new H only the products H P are computed again. H is kept if another step with it is expected to end the solve.
*/
#include "subspaceimpl.h"
#include "tao_ipfilter/solver/barrier.h"
#include "tao_ipfilter/solver/constants.h"
#include "tao_ipfilter/solver/kkt.h"
#include "tao_ipfilter/solver/matrices.h"
#include "tao_ipfilter/solver/options.h"
#include "tao_ipfilter/solver/rows.h"
#include "tao_ipfilter/solver/search.h"
#include "tao_ipfilter/solver/terms.h"

/*
   Computes the residual of the model, r = J^T force - grad f - H d, and its norm. r is set to zero on W, where it is
   rounding error.
*/
static PetscErrorCode NewtonModelResidual(Tao tao, Vec d, Vec force, Vec r, PetscReal *norm)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  PetscCall(MatMultAdd(ip->hess->H, d, tao->gradient, r));
  PetscCall(IPTermsSubtractForces(tao, r));
  PetscCall(VecScale(r, -1.0));
  PetscCall(MatMultTransposeAdd(ip->jac->inequality, force, r, r));
  PetscCall(IPFixedZero(tao, r));
  PetscCall(VecISSet(r, IPSubspaceOf(tao)->W, 0.0));
  PetscCall(VecNorm(r, NORM_2, norm));
  PetscFunctionReturn(0);
}

/* Centres the model at the step d */
static PetscErrorCode NewtonCentreModel(Tao tao, const IPBasis *basis, Vec d)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  Vec           gradient, c;

  PetscFunctionBegin;
  PetscCall(IPGetWork(tao, IP_UNKNOWNS, &gradient));
  PetscCall(IPGetWork(tao, IP_INEQUALITIES, &c));
  PetscCall(MatMultAdd(ip->hess->H, d, tao->gradient, gradient));
  PetscCall(IPFixedZero(tao, gradient));
  PetscCall(MatMultAdd(ip->jac->inequality, d, ip->at.c, c));
  PetscCall(IPSubspaceCentre(tao, basis, d, gradient, c));
  PetscCall(IPRestoreWork(tao, IP_INEQUALITIES, &c));
  PetscCall(IPRestoreWork(tao, IP_UNKNOWNS, &gradient));
  PetscFunctionReturn(0);
}

/* Computes the model's minimizer d in V, and the forces of the constraints there */
static PetscErrorCode NewtonMinimizeModel(Tao tao, IPRecycle *recycle, Vec d, Vec force, PetscBool *solved)
{
  PetscFunctionBegin;
  PetscCall(IPSubspaceSolve(tao, &recycle->basis, d, force, solved));
  if (*solved) PetscCall(VecAXPY(d, 1.0, IPSubspaceOf(tao)->centre));
  PetscFunctionReturn(0);
}

/*
   Adds a direction computed from the residual r. If the basis is full, it is compressed first. *added: false if the
   iteration limit of the Krylov method is reached.
*/
static PetscErrorCode NewtonAddDirection(Tao tao, IPRecycle *recycle, Vec d, Vec r, PetscBool *added)
{
  PetscFunctionBegin;
  PetscCall(IPSubspaceAllows(tao, added));
  if (!*added) PetscFunctionReturn(0);
  if (recycle->basis.n == recycle->basis.max) {
    PetscCall(IPSubspaceMakeRoom(tao, &recycle->basis));
    PetscCall(NewtonCentreModel(tao, &recycle->basis, d));
  }
  PetscCall(IPSubspaceExtend(tao, recycle, r, added));
  PetscFunctionReturn(0);
}

/*
   Solves the model until its residual is below `target`. If no direction can be added, a residual that is half of the
   iterate's is sufficient. *solved: false if neither is reached, or the model has no minimum.
*/
static PetscErrorCode NewtonSolveModel(Tao tao, IPRecycle *recycle, PetscReal target, Vec d, Vec force,
  PetscBool *solved)
{
  const PetscReal enough = 0.5 * ((TAO_IPFILTER *)tao->data)->kkt->dual_norm;
  PetscReal       norm;
  PetscBool       added;
  Vec             r;

  PetscFunctionBegin;
  PetscCall(IPGetWork(tao, IP_UNKNOWNS, &r));
  PetscCall(VecSet(d, 0.0));
  PetscCall(NewtonCentreModel(tao, &recycle->basis, d));
  do {
    PetscCall(NewtonMinimizeModel(tao, recycle, d, force, solved));
    if (!*solved) break;
    PetscCall(NewtonModelResidual(tao, d, force, r, &norm));
    if (norm <= target) break;
    PetscCall(NewtonAddDirection(tao, recycle, d, r, &added));
    *solved = (PetscBool)(added || norm <= enough);
  } while (added);
  if (*solved) IPSubspaceOf(tao)->promised = norm;
  PetscCall(IPRestoreWork(tao, IP_UNKNOWNS, &r));
  PetscFunctionReturn(0);
}

/* Solves the model by laws until its residual is below `target` and they hold */
static PetscErrorCode NewtonSolveLaws(Tao tao, PetscReal target, Vec d, Vec force, PetscBool *solved)
{
  const PetscReal enough = 1e-6; /* relative violation of the laws: at a larger one, states of contacts are unknown */
  PetscReal       norm = PETSC_INFINITY, violation = PETSC_INFINITY;
  PetscBool       done = PETSC_TRUE;
  Vec             r;

  PetscFunctionBegin;
  PetscCall(IPGetWork(tao, IP_UNKNOWNS, &r));
  PetscCall(IPSubspaceBeginLaws(tao));
  PetscCall(VecZeroEntries(d));
  PetscCall(VecZeroEntries(force));
  while (done && !(norm <= target && violation <= enough)) {
    PetscCall(IPSubspaceStepLaws(tao, 0.5 * target, d, force, &violation, &done));
    PetscCall(NewtonModelResidual(tao, d, force, r, &norm));
  }
  *solved                     = done;
  IPSubspaceOf(tao)->promised = norm;
  PetscCall(IPRestoreWork(tao, IP_UNKNOWNS, &r));
  PetscFunctionReturn(0);
}

/*
   Computes violation = sum m max(-c, 0) over the rigid rows, and the elastic energy = sum min(c, 0)^2 / (2 compliance)
   of the others
*/
static PetscErrorCode NewtonViolation(Tao tao, Vec c, PetscReal *violation, PetscReal *energy)
{
  TAO_IPFILTER      *ip      = (TAO_IPFILTER *)tao->data;
  const Vec          v[3]    = {c, ip->pair[IP_SLACK].w, ip->sides->compliance};
  const PetscInt     nv      = v[2] ? 3 : 2;
  const PetscScalar *a[3]    = {NULL, NULL, NULL};
  PetscReal          sums[2] = {0.0, 0.0};
  PetscInt           n;

  PetscFunctionBegin;
  PetscCall(VecGetLocalSize(c, &n));
  for (PetscInt k = 0; k < nv; k++) PetscCall(VecGetArrayRead(v[k], &a[k]));
  for (PetscInt i = 0; i < n; i++) {
    const PetscReal depth = PetscMax(-PetscRealPart(a[0][i]), 0.0), soft = a[2] ? PetscRealPart(a[2][i]) : 0.0;

    if (soft > 0.0) sums[1] += 0.5 * depth * depth / soft;
    else sums[0] += PetscRealPart(a[1][i]) * depth;
  }
  for (PetscInt k = 0; k < nv; k++) PetscCall(VecRestoreArrayRead(v[k], &a[k]));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sums, 2, MPIU_REAL, MPIU_SUM, PetscObjectComm((PetscObject)tao)));
  *violation = sums[0];
  *energy    = sums[1];
  PetscFunctionReturn(0);
}

/* Computes the penalty weight nu, which exceeds all multipliers of the model */
static PetscErrorCode NewtonPenalty(Tao tao, Vec force, PetscReal *nu)
{
  const PetscReal beyond = 2.0;
  Vec             lambda;

  PetscFunctionBegin;
  PetscCall(IPGetWork(tao, IP_INEQUALITIES, &lambda));
  PetscCall(VecQuotient_AMGF(lambda, force, ((TAO_IPFILTER *)tao->data)->pair[IP_SLACK].w));
  PetscCall(VecNorm(lambda, NORM_INFINITY, nu));
  PetscCall(IPRestoreWork(tao, IP_INEQUALITIES, &lambda));
  *nu *= beyond;
  PetscFunctionReturn(0);
}

/* Estimates the rounding error of f */
static PetscErrorCode NewtonRounding(Tao tao, PetscReal *rounding)
{
  PetscReal mean;
  PetscInt  n;

  PetscFunctionBegin;
  PetscCall(IPStiffnessMeanEnergy(tao, &mean));
  PetscCall(VecGetSize(tao->solution, &n));
  *rounding = 10.0 * PETSC_MACHINE_EPSILON * PetscMax(n * mean, PetscAbsReal(((TAO_IPFILTER *)tao->data)->at.f));
  PetscFunctionReturn(0);
}

/* Computes the violation of the model's constraints at d, and the energy of soft rows. The violation is not zero if
   norm terms are solved to a tolerance. */
static PetscErrorCode NewtonModelViolation(Tao tao, Vec d, PetscReal *left, PetscReal *energy)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  Vec           c;

  PetscFunctionBegin;
  PetscCall(IPGetWork(tao, IP_INEQUALITIES, &c));
  PetscCall(MatMultAdd(ip->jac->inequality, d, ip->at.c, c));
  PetscCall(NewtonViolation(tao, c, left, energy));
  PetscCall(IPRestoreWork(tao, IP_INEQUALITIES, &c));
  PetscFunctionReturn(0);
}

/*
   Computes the error in the laws of norm terms at the model's solution x: the sum of b |v| + tau v over the terms,
   which is zero if the laws hold. sum: the sum of b |v|.
*/
static PetscErrorCode NewtonModelSlack(Tao tao, Vec x, PetscReal sum, PetscReal *slack)
{
  IPTerms    *terms = ((TAO_IPFILTER *)tao->data)->terms;
  PetscScalar work;
  Vec         v;

  PetscFunctionBegin;
  *slack = 0.0;
  if (!terms->n) PetscFunctionReturn(0);
  PetscCall(VecDuplicate(terms->t, &v));
  PetscCall(IPTermsValue(tao, x, v));
  PetscCall(VecDot(v, terms->force, &work));
  PetscCall(VecDestroy(&v));
  *slack = PetscMax(0.0, sum + PetscRealPart(work));
  PetscFunctionReturn(0);
}

/* Data of a line search along d. nu: penalty weight; left, slack: the constraint violation and the error in the laws
   of norm terms that the model's own solution has. Both are subtracted from the merit in proportion to the step
   length, since no step can avoid them. */
typedef struct {
  Vec       d, force;
  PetscReal nu, left, slack;
} NewtonLine;

/* Evaluates the penalized objective at the trial point, which is the step alpha d away. The norm terms have the
   weights of the model's multipliers. *merit: infinite if the objective is not defined there */
static PetscErrorCode NewtonTry(Tao tao, const NewtonLine *line, PetscReal alpha, PetscReal *merit)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  PetscReal     violation, terms, soft;

  PetscFunctionBegin;
  ip->search->alpha = ip->search->alpha_dual = alpha;
  PetscCall(VecWAXPY(ip->trial.x, alpha, line->d, tao->solution));
  PetscCall(TaoComputeObjective(tao, ip->trial.x, &ip->trial.f));
  *merit = PETSC_INFINITY;
  if (IPUndefined(ip->trial.f)) PetscFunctionReturn(0);
  PetscCall(IPEvaluateConstraints(tao, ip->trial.x, ip->trial.c, ip->trial.ce));
  PetscCall(NewtonViolation(tao, ip->trial.c, &violation, &soft));
  PetscCall(IPTermsSum(tao, ip->trial.x, line->force, &terms));
  *merit = ip->trial.f + soft + line->nu * (violation - alpha * line->left) + terms - alpha * line->slack;
  PetscFunctionReturn(0);
}

/* Returns the step length at which a parabola has its minimum, at most 2 alpha. The parabola has the given slope at
   the start and changes by `change` over the step alpha. */
static PetscReal NewtonInterpolate(PetscReal alpha, PetscReal slope, PetscReal change)
{
  const PetscReal curved = change - alpha * slope;

  return curved > -0.25 * alpha * slope ? -0.5 * slope * alpha * alpha / curved : 2.0 * alpha;
}

/*
   Shortens a step that leads far beyond the minimum along d, which happens where metal begins to yield. The new length
   is that of the minimum of a parabola; this is repeated while the merit falls. merit: value at the full step; before,
   slope: value and slope at the start
*/
static PetscErrorCode NewtonShorten(Tao tao, const NewtonLine *line, PetscReal before, PetscReal slope, PetscReal merit)
{
  TAO_IPFILTER   *ip   = (TAO_IPFILTER *)tao->data;
  const PetscReal well = 0.9, least = 0.1;
  const PetscInt  most = 6;
  PetscReal       trial, alpha = ip->search->alpha, next = NewtonInterpolate(alpha, slope, merit - before);

  PetscFunctionBegin;
  for (PetscInt k = 0; k < most && next < well * alpha; k++) {
    next = PetscMax(next, least * alpha);
    ip->search->ntrials++;
    PetscCall(NewtonTry(tao, line, next, &trial));
    if (!(trial < merit)) {
      PetscCall(NewtonTry(tao, line, alpha, &merit));
      break;
    }
    merit = trial;
    alpha = next;
    next  = NewtonInterpolate(alpha, slope, merit - before);
  }
  PetscFunctionReturn(0);
}

/*
   Line search. Halves the step until the penalized objective falls, and shortens it further if the objective is lower
   before the end of the step. *downhill: false if the objective grows at the start of d, since the model is not convex
   along d; *ok: whether the objective falls
*/
static PetscErrorCode NewtonSearch(Tao tao, Vec d, Vec force, PetscBool *downhill, PetscBool *ok)
{
  TAO_IPFILTER   *ip     = (TAO_IPFILTER *)tao->data;
  const PetscReal armijo = 1e-4, least = 1e-4, noise = 1e3;
  NewtonLine      line = {.d = d, .force = force, .nu = 0.0};
  PetscReal       violation, rounding = 0.0, terms[2], soft[2], slope, before, merit = 0.0;
  PetscScalar     gd;

  PetscFunctionBegin;
  PetscCall(NewtonPenalty(tao, force, &line.nu));
  PetscCall(NewtonRounding(tao, &rounding));
  PetscCall(NewtonViolation(tao, ip->at.c, &violation, &soft[0]));
  PetscCall(NewtonModelViolation(tao, d, &line.left, &soft[1]));
  PetscCall(VecDot(tao->gradient, d, &gd));
  PetscCall(IPTermsSum(tao, tao->solution, force, &terms[0]));
  PetscCall(VecWAXPY(ip->trial.x, 1.0, d, tao->solution));
  PetscCall(IPTermsSum(tao, ip->trial.x, force, &terms[1]));
  PetscCall(NewtonModelSlack(tao, ip->trial.x, terms[1], &line.slack));
  slope               = PetscRealPart(gd) - line.nu * violation + terms[1] - terms[0] - line.slack + soft[1] - soft[0];
  before              = ip->at.f + line.nu * violation + terms[0] + soft[0];
  ip->search->ntrials = 0;
  *ok                 = PETSC_FALSE;
  *downhill           = (PetscBool)(slope < rounding);
  for (PetscReal alpha = 1.0; *downhill && alpha >= least && !*ok; alpha *= 0.5) {
    ip->search->ntrials++;
    PetscCall(NewtonTry(tao, &line, alpha, &merit));
    *ok = (PetscBool)(merit < PETSC_INFINITY && merit <= before + armijo * alpha * slope + rounding);
  }
  if (*ok && -slope * ip->search->alpha > noise * rounding) PetscCall(NewtonShorten(tao, &line, before, slope, merit));
  PetscFunctionReturn(0);
}

/* Takes the step that the line search found, and the same fraction of the change of the multipliers */
static PetscErrorCode NewtonAccept(Tao tao, Vec d, Vec force)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  Vec           old;

  PetscFunctionBegin;
  PetscCall(IPGetWork(tao, IP_INEQUALITIES, &old));
  PetscCall(VecPointwiseMult(old, ip->pair[IP_SLACK].z, ip->pair[IP_SLACK].w));
  PetscCall(VecAXPBY(force, 1.0 - ip->search->alpha, ip->search->alpha, old));
  PetscCall(IPRestoreWork(tao, IP_INEQUALITIES, &old));
  if (ip->terms->n) PetscCall(VecAXPBY(ip->terms->force, 1.0 - ip->search->alpha, ip->search->alpha, ip->terms->last));
  PetscCall(IPIterateCopyPoint(&ip->trial, &ip->at));
  PetscCall(IPSubspaceSetPairs(tao, force));
  PetscCall(VecNorm(d, NORM_INFINITY, &ip->dir.norm));
  ip->search->tag = 'f';
  PetscCall(IPEvaluateDerivatives(tao));
  PetscFunctionReturn(0);
}

/* Returns the relative error of the residual that the last model predicted; 0: there is no last model */
static PetscReal NewtonMisprediction(const TAO_IPFILTER *ip, const IPSubspace *f)
{
  const PetscReal alpha = ip->search->alpha, expected = (1.0 - alpha) * f->residual + alpha * f->promised;

  return f->residual > 0.0 ? PetscAbsReal(ip->kkt->dual_norm - expected) / f->residual : 0.0;
}

/* Returns the fraction of the present residual that a model may leave. Near the solution it is small, so that Newton's
   method converges fast. */
static PetscReal NewtonForcing(const TAO_IPFILTER *ip)
{
  const PetscReal largest = 0.1, smallest = 1e-3;

  return PetscClipInterval(PetscSqrtReal(IPBothErrors(ip)), smallest, largest);
}

/*
   Computes the tolerance for the model's residual. If the last model predicted the residual badly, as where metal
   begins to yield, it is that fraction of the residual by which the prediction was wrong (Eisenstat and Walker 1996).
   The tolerance is never smaller than convergence requires.
*/
static PetscReal NewtonTarget(const TAO_IPFILTER *ip, const IPSubspace *f)
{
  const PetscReal loose    = 0.3;
  const PetscReal fraction = PetscMax(NewtonForcing(ip), PetscMin(loose, NewtonMisprediction(ip, f)));

  return PetscMax(fraction * ip->kkt->dual_norm, IP_FORCING_LAST * ip->tol * IPErrorBoundForceUnit(ip));
}

/* Returns whether the last model's Hessian serves the next model: the error that it made in the residual is so small
   that a second step with it reaches the tolerance */
static PetscBool NewtonKeepsHessian(const TAO_IPFILTER *ip, const IPSubspace *f)
{
  return (PetscBool)(f->residual > 0.0 && ip->shift->delta == 0.0 &&
                     NewtonMisprediction(ip, f) * IPBothErrors(ip) <= ip->tol);
}

/* Evaluates the Hessian at the present point and adds delta M_u */
static PetscErrorCode NewtonEvaluateHessian(Tao tao)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  Vec           shift;

  PetscFunctionBegin;
  PetscCall(IPHessianEvaluate(tao));
  PetscCall(IPStiffnessUpdate(tao));
  if (ip->shift->delta == 0.0) PetscFunctionReturn(0);
  PetscCall(IPGetWork(tao, IP_UNKNOWNS, &shift));
  if (ip->given->primal_mass) PetscCall(VecCopy(ip->given->primal_mass, shift));
  else PetscCall(VecSet(shift, 1.0));
  PetscCall(VecScale(shift, ip->shift->delta));
  PetscCall(MatDiagonalSet(ip->hess->H, shift, ADD_VALUES));
  PetscCall(IPRestoreWork(tao, IP_UNKNOWNS, &shift));
  PetscFunctionReturn(0);
}

/*
   Computes the Newton step d, and the part of it that the line search takes. The Hessian is shifted until the model is
   convex. Laws do not find out whether it is: the model may have a second solution far away, where the objective is
   larger, for example if only friction resists a motion in which the Hessian is indefinite. Then the Hessian is
   shifted, too. *found: false if no
   moderate shift is sufficient, or the line search fails. At the first point the set-up of the model has already been
   tried.
*/
static PetscErrorCode NewtonFindStep(Tao tao, IPRecycle *recycle, Vec d, Vec force, PetscBool *found)
{
  TAO_IPFILTER   *ip     = (TAO_IPFILTER *)tao->data;
  const PetscInt  shifts = 6;
  const PetscReal target = NewtonTarget(ip, IPSubspaceOf(tao));
  const PetscBool ready =
    (PetscBool)(tao->niter ? NewtonKeepsHessian(ip, IPSubspaceOf(tao)) : IPSubspaceOf(tao)->ready);

  PetscFunctionBegin;
  *found           = (PetscBool)(tao->niter || ready);
  ip->shift->delta = 0.0;
  if (ip->terms->n) PetscCall(VecCopy(ip->terms->force, ip->terms->last));
  for (PetscInt k = 0; k <= shifts; k++) {
    PetscBool convex = *found, downhill;

    if (k) PetscCall(IPRegularizeMore(tao));
    if (k || (tao->niter && !ready)) {
      if (k && ip->terms->n) PetscCall(VecCopy(ip->terms->last, ip->terms->force));
      PetscCall(NewtonEvaluateHessian(tao));
      PetscCall(IPRecycleUpdate(tao, recycle, &convex));
      if (convex) PetscCall(IPSubspaceSetUp(tao, recycle, &convex));
    }
    if (convex && IPSubspaceOf(tao)->by_laws) PetscCall(NewtonSolveLaws(tao, target, d, force, &convex));
    else if (convex) PetscCall(NewtonSolveModel(tao, recycle, target, d, force, &convex));
    *found = convex;
    if (!convex) continue;
    PetscCall(NewtonSearch(tao, d, force, &downhill, found));
    if (downhill || !IPSubspaceOf(tao)->by_laws) break;
  }
  if (*found) IPRegularized(ip);
  if (*found) IPSubspaceOf(tao)->residual = ip->kkt->dual_norm;
  PetscFunctionReturn(0);
}

/* Takes one Newton step. *done: false if the model or the line search fails, or the steps make no more progress. */
PetscErrorCode IPNewtonSubspaceStep(Tao tao, PetscBool *done)
{
  TAO_IPFILTER  *ip       = (TAO_IPFILTER *)tao->data;
  const PetscInt patience = 20;
  IPRecycle     *recycle;
  Vec            d, force;

  PetscFunctionBegin;
  tao->ksp_its = 0;
  if (tao->niter) PetscCall(IPKrylovRecord(tao, 0));
  PetscCall(IPRecycleGet(tao, &recycle));
  PetscCall(IPGetWork(tao, IP_UNKNOWNS, &d));
  PetscCall(IPGetWork(tao, IP_INEQUALITIES, &force));
  *done = IPSubspaceProgresses(IPSubspaceOf(tao), IPBothErrors(ip), patience);
  if (*done) PetscCall(NewtonFindStep(tao, recycle, d, force, done));
  if (*done) PetscCall(NewtonAccept(tao, d, force));
  PetscCall(IPRestoreWork(tao, IP_INEQUALITIES, &force));
  PetscCall(IPRestoreWork(tao, IP_UNKNOWNS, &d));
  if (*done) tao->niter++;
  else PetscCall(IPRecycleReset(recycle));
  PetscFunctionReturn(0);
}
