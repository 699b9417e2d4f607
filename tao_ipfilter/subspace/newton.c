/*
   Newton's method on the filtered subspace, for min f(x), c_I(x) >= 0 with linear c_I and an f that is not quadratic,
   as the energy of bodies at finite strain. At each iterate the model

     min 1/2 d^T H d + grad f^T d,  c_I + J d >= 0

   is solved on V as method.c solves a quadratic program, to a fraction of the residual. d is the model's
   minimizer on V, with multipliers M lambda, so that grad f^T d = -d^T H d - lambda^T M c_I: a direction of descent
   for f + nu sum m max(-c_I, 0) with nu beyond the multipliers, however few directions V has. c_I being linear, d
   leads from feasible points to feasible ones, at any length up to 1. V outlives the step: with another H only the
   products H P are made anew.
*/
#include "subspaceimpl.h"

/* r = J^T force - grad f - H d without its part on W, which is zero but for rounding, and its norm */
static PetscErrorCode NewtonModelResidual(Tao tao, Vec d, Vec force, Vec r, PetscReal *norm)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  PetscCall(MatMultAdd(ip->hess.H, d, tao->gradient, r));
  PetscCall(IPTermsSubtractForces(tao, r));
  PetscCall(VecScale(r, -1.0));
  PetscCall(MatMultTransposeAdd(ip->jac.inequality, force, r, r));
  PetscCall(IPFixedZero(tao, r));
  PetscCall(VecISSet(r, IPFilteredOf(tao)->W, 0.0));
  PetscCall(VecNorm(r, NORM_2, norm));
  PetscFunctionReturn(0);
}

/* The model is relative to the step d from now on */
static PetscErrorCode NewtonCentreModel(Tao tao, const IPBasis *basis, Vec d)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  Vec           x, gradient, c;

  PetscFunctionBegin;
  PetscCall(IPGetWork(tao, IP_UNKNOWNS, &x));
  if (ip->terms.n) PetscCall(VecWAXPY(x, 1.0, d, tao->solution));
  PetscCall(IPGetWork(tao, IP_UNKNOWNS, &gradient));
  PetscCall(IPGetWork(tao, IP_INEQUALITIES, &c));
  PetscCall(MatMultAdd(ip->hess.H, d, tao->gradient, gradient));
  PetscCall(IPFixedZero(tao, gradient));
  PetscCall(MatMultAdd(ip->jac.inequality, d, ip->at.c, c));
  PetscCall(IPFilteredCentre(tao, basis, x, d, gradient, c));
  PetscCall(IPRestoreWork(tao, IP_INEQUALITIES, &c));
  PetscCall(IPRestoreWork(tao, IP_UNKNOWNS, &gradient));
  PetscCall(IPRestoreWork(tao, IP_UNKNOWNS, &x));
  PetscFunctionReturn(0);
}

/* The model's minimizer d on V, and the forces of the constraints there */
static PetscErrorCode NewtonMinimizeModel(Tao tao, const IPBasis *basis, Vec d, Vec force, PetscBool *solved)
{
  PetscFunctionBegin;
  PetscCall(IPFilteredSolve(tao, basis, d, force, solved));
  if (*solved) PetscCall(VecAXPY(d, 1.0, IPFilteredOf(tao)->centre));
  PetscFunctionReturn(0);
}

/* A further direction, with room made for it where there is none, if the Krylov method's limit allows one */
static PetscErrorCode NewtonAddDirection(Tao tao, IPSubspaceState *kept, Vec d, Vec r, PetscBool *added)
{
  PetscFunctionBegin;
  PetscCall(IPFilteredAllows(tao, added));
  if (!*added) PetscFunctionReturn(0);
  if (kept->basis.n == kept->basis.max) {
    PetscCall(IPFilteredMakeRoom(tao, &kept->basis));
    PetscCall(NewtonCentreModel(tao, &kept->basis, d));
  }
  PetscCall(IPFilteredExtend(tao, kept, r, added));
  PetscFunctionReturn(0);
}

/* Solves the model until its residual is within the target, or no further direction can be added and the residual is
   at least halved; *solved is false if it has no minimum */
static PetscErrorCode NewtonSolveModel(Tao tao, IPSubspaceState *kept, PetscReal target, Vec d, Vec force,
  PetscBool *solved)
{
  const PetscReal enough = 0.5 * ((TAO_IPFILTER *)tao->data)->kkt.dual_norm;
  PetscReal       norm;
  PetscBool       added;
  Vec             r;

  PetscFunctionBegin;
  PetscCall(IPGetWork(tao, IP_UNKNOWNS, &r));
  PetscCall(VecSet(d, 0.0));
  PetscCall(NewtonCentreModel(tao, &kept->basis, d));
  do {
    PetscCall(NewtonMinimizeModel(tao, &kept->basis, d, force, solved));
    if (!*solved) break;
    PetscCall(NewtonModelResidual(tao, d, force, r, &norm));
    if (norm <= target) break;
    PetscCall(NewtonAddDirection(tao, kept, d, r, &added));
    *solved = (PetscBool)(added || norm <= enough);
  } while (added);
  PetscCall(IPRestoreWork(tao, IP_UNKNOWNS, &r));
  PetscFunctionReturn(0);
}

/* sum m max(-c, 0) */
static PetscErrorCode NewtonViolation(Tao tao, Vec c, PetscReal *violation)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  PetscScalar   sum;
  Vec           v;

  PetscFunctionBegin;
  PetscCall(IPGetWork(tao, IP_INEQUALITIES, &v));
  PetscCall(VecSet(v, 0.0));
  PetscCall(VecPointwiseMin(v, v, c));
  PetscCall(VecDot(v, ip->pair[IP_SLACK].w, &sum));
  PetscCall(IPRestoreWork(tao, IP_INEQUALITIES, &v));
  *violation = -PetscRealPart(sum);
  PetscFunctionReturn(0);
}

/* nu: more than the multipliers of the model */
static PetscErrorCode NewtonPenalty(Tao tao, Vec force, PetscReal *nu)
{
  const PetscReal beyond = 2.0;
  Vec             lambda;

  PetscFunctionBegin;
  PetscCall(IPGetWork(tao, IP_INEQUALITIES, &lambda));
  PetscCall(VecPointwiseDivide(lambda, force, ((TAO_IPFILTER *)tao->data)->pair[IP_SLACK].w));
  PetscCall(VecNorm(lambda, NORM_INFINITY, nu));
  PetscCall(IPRestoreWork(tao, IP_INEQUALITIES, &lambda));
  *nu *= beyond;
  PetscFunctionReturn(0);
}

/* Rounding error of f */
static PetscErrorCode NewtonRounding(Tao tao, PetscReal *rounding)
{
  PetscReal mean;
  PetscInt  n;

  PetscFunctionBegin;
  PetscCall(IPStiffnessEnergies(tao, NULL, &mean));
  PetscCall(VecGetSize(tao->solution, &n));
  *rounding = 10.0 * PETSC_MACHINE_EPSILON * PetscMax(n * mean, PetscAbsReal(((TAO_IPFILTER *)tao->data)->at.f));
  PetscFunctionReturn(0);
}

/* The violation that the model has at d: what its solution leaves, where norm terms are solved for to a tolerance */
static PetscErrorCode NewtonModelViolation(Tao tao, Vec d, PetscReal *left)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  Vec           c;

  PetscFunctionBegin;
  PetscCall(IPGetWork(tao, IP_INEQUALITIES, &c));
  PetscCall(MatMultAdd(ip->jac.inequality, d, ip->at.c, c));
  PetscCall(NewtonViolation(tao, c, left));
  PetscCall(IPRestoreWork(tao, IP_INEQUALITIES, &c));
  PetscFunctionReturn(0);
}

/* Halves the step until the penalized objective falls, norm terms with the weights of the model's multipliers
   included, and without the violation that the model has in proportion to the step; *ok is false where it does not,
   or the model is not convex along d */
static PetscErrorCode NewtonSearch(Tao tao, Vec d, Vec force, PetscBool *ok)
{
  TAO_IPFILTER   *ip     = (TAO_IPFILTER *)tao->data;
  const PetscReal armijo = 1e-4, least = 1e-4;
  PetscReal       nu = 0.0, violation, left, rounding = 0.0, terms[2], slope, alpha;
  PetscScalar     gd;

  PetscFunctionBegin;
  PetscCall(NewtonPenalty(tao, force, &nu));
  PetscCall(NewtonRounding(tao, &rounding));
  PetscCall(NewtonViolation(tao, ip->at.c, &violation));
  PetscCall(NewtonModelViolation(tao, d, &left));
  PetscCall(VecDot(tao->gradient, d, &gd));
  PetscCall(IPTermsSum(tao, tao->solution, force, &terms[0]));
  PetscCall(VecWAXPY(ip->trial.x, 1.0, d, tao->solution));
  PetscCall(IPTermsSum(tao, ip->trial.x, force, &terms[1]));
  slope              = PetscRealPart(gd) - nu * violation + terms[1] - terms[0];
  ip->search.ntrials = 0;
  *ok                = PETSC_FALSE;
  for (alpha = 1.0; slope < rounding && alpha >= least && !*ok; alpha *= 0.5) {
    PetscReal rest;

    ip->search.ntrials++;
    ip->search.alpha = ip->search.alpha_dual = alpha;
    PetscCall(VecWAXPY(ip->trial.x, alpha, d, tao->solution));
    PetscCall(TaoComputeObjective(tao, ip->trial.x, &ip->trial.f));
    if (IPUndefined(ip->trial.f)) continue;
    PetscCall(IPEvaluateConstraints(tao, ip->trial.x, ip->trial.c, ip->trial.ce));
    PetscCall(NewtonViolation(tao, ip->trial.c, &rest));
    PetscCall(IPTermsSum(tao, ip->trial.x, force, &terms[1]));
    *ok = (PetscBool)(ip->trial.f + nu * (rest - alpha * left) + terms[1] <=
                      ip->at.f + nu * violation + terms[0] + armijo * alpha * slope + rounding);
  }
  PetscFunctionReturn(0);
}

/* Takes the step that was found, and the same fraction of the multipliers' step */
static PetscErrorCode NewtonAccept(Tao tao, Vec d, Vec force)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  Vec           old;

  PetscFunctionBegin;
  PetscCall(IPGetWork(tao, IP_INEQUALITIES, &old));
  PetscCall(VecPointwiseMult(old, ip->pair[IP_SLACK].z, ip->pair[IP_SLACK].w));
  PetscCall(VecAXPBY(force, 1.0 - ip->search.alpha, ip->search.alpha, old));
  PetscCall(IPRestoreWork(tao, IP_INEQUALITIES, &old));
  if (ip->terms.n) PetscCall(VecAXPBY(ip->terms.force, 1.0 - ip->search.alpha, ip->search.alpha, ip->terms.last));
  PetscCall(IPIterateCopyPoint(&ip->trial, &ip->at));
  PetscCall(IPFilteredSetPairs(tao, force));
  PetscCall(VecNorm(d, NORM_INFINITY, &ip->dir.norm));
  ip->search.tag = 'f';
  PetscCall(IPEvaluateDerivatives(tao));
  PetscFunctionReturn(0);
}

/* Target for the model's residual: a fraction of the present one that decreases towards the end, as Newton's method
   then converges faster; at least what convergence requires */
static PetscReal NewtonTarget(const TAO_IPFILTER *ip)
{
  const PetscReal largest = 0.1, smallest = 1e-3;
  const PetscReal fraction = PetscClipInterval(PetscSqrtReal(IPBothErrors(ip)), smallest, largest);

  return PetscMax(fraction * ip->kkt.dual_norm, ip->opt.forcing_last * ip->tol * IPErrorBoundForceUnit(ip));
}

/* The Hessian at the present point, with delta M_u added */
static PetscErrorCode NewtonEvaluateHessian(Tao tao)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  Vec           shift;

  PetscFunctionBegin;
  PetscCall(IPHessianEvaluate(tao));
  PetscCall(IPStiffnessUpdate(tao));
  if (ip->shift.delta == 0.0) PetscFunctionReturn(0);
  PetscCall(IPGetWork(tao, IP_UNKNOWNS, &shift));
  if (ip->given.primal_mass) PetscCall(VecCopy(ip->given.primal_mass, shift));
  else PetscCall(VecSet(shift, 1.0));
  PetscCall(VecScale(shift, ip->shift.delta));
  PetscCall(MatDiagonalSet(ip->hess.H, shift, ADD_VALUES));
  PetscCall(IPRestoreWork(tao, IP_UNKNOWNS, &shift));
  PetscFunctionReturn(0);
}

/* The step d of the present point's model. The Hessian is shifted until the model is convex; *found is false if no
   small shift helps. At the first point the model is already there */
static PetscErrorCode NewtonFindStep(Tao tao, IPSubspaceState *kept, Vec d, Vec force, PetscBool *found)
{
  TAO_IPFILTER   *ip     = (TAO_IPFILTER *)tao->data;
  const PetscInt  shifts = 6;
  const PetscReal target = NewtonTarget(ip);

  PetscFunctionBegin;
  *found          = PETSC_TRUE;
  ip->shift.delta = 0.0;
  if (ip->terms.n) PetscCall(VecCopy(ip->terms.force, ip->terms.last));
  for (PetscInt k = 0; k <= shifts; k++) {
    if (k) PetscCall(IPRegularizeMore(tao));
    if (k || tao->niter) {
      PetscCall(NewtonEvaluateHessian(tao));
      PetscCall(IPSubspaceStateUpdate(tao, kept, found));
      if (*found) PetscCall(IPFilteredSetUp(tao, kept, found));
    }
    if (*found) PetscCall(NewtonSolveModel(tao, kept, target, d, force, found));
    if (*found) break;
  }
  if (*found) IPRegularized(ip);
  PetscFunctionReturn(0);
}

/* One Newton step; *done is false if the model or the line search gives none, or steps no longer help */
PetscErrorCode IPNewtonSubspaceStep(Tao tao, PetscBool *done)
{
  TAO_IPFILTER    *ip       = (TAO_IPFILTER *)tao->data;
  const PetscInt   patience = 20;
  IPSubspaceState *kept;
  Vec              d, force;

  PetscFunctionBegin;
  tao->ksp_its = 0;
  if (tao->niter) PetscCall(IPKrylovRecord(tao, 0));
  PetscCall(IPSubspaceStateGet(tao, &kept));
  PetscCall(IPGetWork(tao, IP_UNKNOWNS, &d));
  PetscCall(IPGetWork(tao, IP_INEQUALITIES, &force));
  *done = IPFilteredProgresses(IPFilteredOf(tao), IPBothErrors(ip), patience);
  if (*done) PetscCall(NewtonFindStep(tao, kept, d, force, done));
  if (*done) PetscCall(NewtonSearch(tao, d, force, done));
  if (*done) PetscCall(NewtonAccept(tao, d, force));
  PetscCall(IPRestoreWork(tao, IP_INEQUALITIES, &force));
  PetscCall(IPRestoreWork(tao, IP_UNKNOWNS, &d));
  if (*done) tao->niter++;
  else PetscCall(IPSubspaceStateReset(kept));
  PetscFunctionReturn(0);
}
