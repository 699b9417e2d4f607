/* The outer iteration. */
#include "ipfilterimpl.h"

/* Objective, constraints and derivatives at the starting point, pushed inside its bounds; *finite is false where one is
   not a number. No derivative is asked for where the objective is not one. */
static PetscErrorCode FirstPoint(Tao tao, PetscBool *finite)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  PetscReal     norm, size = 0.0;
  PetscBool     alone, scaled;

  PetscFunctionBegin;
  *finite = PETSC_FALSE;
  PetscCall(TaoComputeVariableBounds(tao));
  PetscCall(IPFixedSetUp(tao));
  PetscCall(IPScalingReset(tao));
  PetscCall(IPBoundsSetUp(tao));
  PetscCall(IPBoundsPush(tao));
  PetscCall(VecNorm(tao->solution, NORM_INFINITY, &ip->xsize0));
  PetscCall(TaoIsGradientDefined(tao, &alone));
  if (alone) PetscCall(TaoComputeObjective(tao, tao->solution, &ip->f));
  if (alone && IPUndefined(ip->f)) PetscFunctionReturn(0);
  PetscCall(IPEvaluateConstraints(tao, tao->solution, ip->c, ip->ce));
  if (ip->mi) PetscCall(VecSet(ip->lambda, 0.0));
  if (ip->me) PetscCall(VecSet(ip->y, 0.0));
  PetscCall(IPEvaluateDerivatives(tao));
  PetscCall(IPScalingSetUp(tao, &scaled));
  if (scaled) {
    PetscCall(IPEvaluateConstraints(tao, tao->solution, ip->c, ip->ce));
    if (ip->cscale) PetscCall(IPCondensedDestroy(&ip->cond));
    PetscCall(IPEvaluateDerivatives(tao));
  }
  if (ip->mi) {
    PetscCall(VecNorm(ip->c, NORM_INFINITY, &size));
    PetscCall(MatNorm(ip->cond.J, NORM_INFINITY, &ip->jnorm));
  }
  if (ip->me) PetscCall(VecNorm(ip->ce, NORM_INFINITY, &ip->equality0));
  PetscCall(VecNorm(tao->gradient, NORM_2, &norm));
  ip->gradient0 = norm;
  ip->f0        = ip->f;
  ip->length0   = size;
  *finite       = (PetscBool)(!IPUndefined(ip->f) && !IPUndefined(norm) && !IPUndefined(size) && !IPUndefined(ip->equality0));
  PetscFunctionReturn(0);
}

/* A starting point where the gradient vanishes and no constraint is violated is stationary with all multipliers zero. Nothing
   there gives a scale to measure errors by, so it is not left to the iteration to find out. */
static PetscErrorCode TestFirstPoint(Tao tao)
{
  TAO_IPFILTER *ip    = (TAO_IPFILTER *)tao->data;
  PetscReal     least = 0.0;

  PetscFunctionBegin;
  if (ip->mi) PetscCall(VecMin(ip->c, NULL, &least));
  if (ip->gradient0 > 0.0 || ip->equality0 > 0.0 || least < 0.0) PetscFunctionReturn(0);
  if (ip->mi) {
    PetscCall(VecCopy(ip->c, ip->pair[IP_SLACK].t));
    PetscCall(VecSet(ip->pair[IP_SLACK].z, 0.0));
  }
  for (PetscInt b = IP_LOWER; b <= IP_UPPER; b++) {
    if (ip->pair[b].n) PetscCall(VecSet(ip->pair[b].z, 0.0));
  }
  ip->mu = 0.0;
  PetscCall(PetscMemzero(&ip->kkt, sizeof(ip->kkt)));
  PetscCall(IPSetMultipliers(tao));
  PetscCall(IPSetReason(tao, TAO_CONVERGED_GATOL, "converged: the starting point is stationary and violates nothing"));
  PetscFunctionReturn(0);
}

static PetscErrorCode ResetRecord(Tao tao)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  ip->niter_ksp    = ip->most_ksp = 0;
  ip->nsystems     = ip->nfiltered = 0;
  ip->filtered     = ip->filter_forced = ip->linear_failed = PETSC_FALSE;
  ip->ndirect      = 0;
  ip->nerror       = 0;
  ip->equality0    = 0.0;
  ip->free_mu      = (PetscBool)(ip->barrier == IP_BARRIER_MEHROTRA);
  ip->nacceptable  = 0;
  ip->curved       = PETSC_FALSE;
  ip->hold         = 0;
  ip->ntiny        = 0;
  ip->nrestored    = 0;
  ip->relaxed      = 0.0;
  ip->nvanished    = 0;
  ip->least_slack  = PETSC_INFINITY;
  ip->delta        = ip->delta_last = ip->delta_largest = 0.0;
  ip->nregularized = ip->nretried = 0;
  ip->theta0       = -1.0;
  ip->best_error   = PETSC_INFINITY;
  ip->dx_norm      = ip->alpha_primal = ip->alpha_dual = 0.0;
  ip->nls          = 0;
  ip->step_tag     = ' ';
  ip->reason[0]    = '\0';
  tao->ksp_its     = 0;
  tao->ksp_tot_its = 0;
  tao->reason      = TAO_CONTINUE_ITERATING;
  PetscCall(PetscMemzero(&ip->fallbacks, sizeof(ip->fallbacks)));
  PetscCall(IPFilterSetReset(&ip->filter));
  PetscFunctionReturn(0);
}

/* Keeps the iterate of smallest KKT error */
static PetscErrorCode KeepBest(Tao tao)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  if (ip->kkt.error >= ip->best_error) PetscFunctionReturn(0);
  ip->best_error = ip->kkt.error;
  ip->fbest      = ip->f;
  PetscCall(VecCopy(tao->solution, ip->xbest));
  if (ip->me) PetscCall(VecCopy(ip->y, ip->ybest));
  if (ip->mi) {
    PetscCall(VecCopy(ip->pair[IP_SLACK].t, ip->sbest));
    PetscCall(VecCopy(ip->pair[IP_SLACK].z, ip->zbest));
    PetscCall(VecCopy(ip->lambda, ip->lambdabest));
  }
  PetscFunctionReturn(0);
}

/* Returns to the best iterate where the last one is worse */
static PetscErrorCode RestoreBest(Tao tao)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  if (ip->best_error == PETSC_INFINITY || ip->kkt.error <= ip->best_error) PetscFunctionReturn(0);
  PetscCall(VecCopy(ip->xbest, tao->solution));
  ip->f = ip->fbest;
  if (ip->mi) {
    PetscCall(VecCopy(ip->sbest, ip->pair[IP_SLACK].t));
    PetscCall(VecCopy(ip->zbest, ip->pair[IP_SLACK].z));
    PetscCall(VecCopy(ip->lambdabest, ip->lambda));
  }
  if (ip->me) PetscCall(VecCopy(ip->ybest, ip->y));
  PetscCall(IPEvaluateConstraints(tao, tao->solution, ip->c, ip->ce));
  PetscCall(IPBoundsDistance(tao, tao->solution, PETSC_FALSE));
  PetscCall(IPEvaluateDerivatives(tao));
  PetscCall(IPComputeKKT(tao));
  PetscFunctionReturn(0);
}

/* Whether the objective has fallen so far below its first value, against that value and against what a Newton step from
   the start would gain, that it can only be unbounded */
static PetscBool Unbounded(const TAO_IPFILTER *ip)
{
  const PetscReal size = PetscMax(PetscMax(PetscAbsReal(ip->f0), ip->gradient0 * ip->xsize0), PetscSqr(ip->gradient0) / ip->hscale);

  return (PetscBool)(size > 0.0 && ip->f < ip->f0 - ip->unbounded_factor * size);
}

/* Counts steps in a row that rounding makes of x */
static PetscErrorCode CountTinySteps(Tao tao)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  PetscReal     size;

  PetscFunctionBegin;
  PetscCall(VecNorm(tao->solution, NORM_INFINITY, &size));
  ip->ntiny = tao->niter && ip->step_tag != 'R' && ip->dx_norm <= IP_TINY_STEP * size ? ip->ntiny + 1 : 0;
  PetscFunctionReturn(0);
}

/* The KKT error is within the tolerance: converged, unless the multipliers it was measured by run away */
static PetscErrorCode Conclude(Tao tao)
{
  TAO_IPFILTER   *ip    = (TAO_IPFILTER *)tao->data;
  const PetscReal most  = 1e4;
  PetscReal       times = 0.0;

  PetscFunctionBegin;
  PetscCall(IPCancellation(tao, &times));
  if (times <= most) PetscCall(IPSetReason(tao, TAO_CONVERGED_GATOL, "converged: KKT error %g is within %g", (double)ip->kkt.error, (double)ip->tol));
  else PetscCall(IPSetReason(tao, TAO_CONVERGED_STEPTOL, "acceptable: KKT error %g, but by multipliers %g times larger than what they balance: bounded ones may not exist", (double)ip->kkt.error, (double)times));
  PetscFunctionReturn(0);
}

/* Ends the iteration where the KKT error, a limit or the values themselves say so */
static PetscErrorCode TestConvergence(Tao tao)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  const IPKKT  *k  = &ip->kkt;
  PetscInt      nfuncs, most_tiny = 3;

  PetscFunctionBegin;
  PetscCall(TaoGetCurrentFunctionEvaluations(tao, &nfuncs));
  PetscCall(CountTinySteps(tao));
  ip->nacceptable = k->error <= ip->acceptable_tol ? ip->nacceptable + 1 : 0;
  if (IPUndefined(k->error) || IPUndefined(ip->f)) {
    PetscCall(IPSetReason(tao, TAO_DIVERGED_NAN, "the objective or a residual is not a number at iteration %" PetscInt_FMT, tao->niter));
  } else if (k->error <= ip->tol) {
    PetscCall(Conclude(tao));
  } else if (ip->f <= tao->fmin && k->primal <= ip->tol) {
    PetscCall(IPSetReason(tao, TAO_CONVERGED_MINF, "feasible, and the objective %g is below the given minimum %g", (double)ip->f, (double)tao->fmin));
  } else if (Unbounded(ip)) {
    PetscCall(IPSetReason(tao, TAO_DIVERGED_USER, "the objective seems unbounded below: it fell from %g to %g", (double)ip->f0, (double)ip->f));
    ip->best_error = PETSC_INFINITY; /* the last point shows it, no other does */
  } else if (ip->nacceptable >= ip->acceptable_it) {
    PetscCall(IPSetReason(tao, TAO_CONVERGED_STEPTOL, "acceptable: KKT error %g stayed within %g, not within %g", (double)k->error, (double)ip->acceptable_tol, (double)ip->tol));
  } else if (ip->ntiny >= most_tiny) {
    if (k->error <= ip->acceptable_tol) PetscCall(IPSetReason(tao, TAO_CONVERGED_STEPTOL, "acceptable: steps have become as small as rounding at KKT error %g, not within %g", (double)k->error, (double)ip->tol));
    else PetscCall(IPSetReason(tao, TAO_DIVERGED_LS_FAILURE, "steps have become as small as rounding at KKT error %g: multipliers may not exist", (double)k->error));
  } else if (tao->niter >= tao->max_it) {
    PetscCall(IPSetReason(tao, TAO_DIVERGED_MAXITS, "iteration limit %" PetscInt_FMT " reached with KKT error %g", tao->max_it, (double)k->error));
  } else if (tao->max_funcs >= 0 && nfuncs > tao->max_funcs) {
    PetscCall(IPSetReason(tao, TAO_DIVERGED_MAXFCN, "limit of %" PetscInt_FMT " function evaluations reached with KKT error %g", tao->max_funcs, (double)k->error));
  }
  PetscFunctionReturn(0);
}

/* KKT error at the new iterate, its record and the monitors */
static PetscErrorCode AssessIterate(Tao tao)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  PetscCall(IPComputeKKT(tao));
  PetscCall(TestConvergence(tao));
  if (tao->reason == TAO_DIVERGED_NAN) PetscFunctionReturn(0);
  PetscCall(KeepBest(tao));
  PetscCall(IPSetMultipliers(tao));
  PetscCall(TaoLogConvergenceHistory(tao, ip->f, ip->kkt.error, ip->kkt.inf_pr, tao->ksp_tot_its));
  PetscCall(IPMonitor(tao));
  PetscCall(TaoMonitor(tao, tao->niter, ip->f, ip->kkt.error, ip->kkt.inf_pr, ip->alpha_primal));
  PetscFunctionReturn(0);
}

static PetscErrorCode LinearFailure(Tao tao)
{
  TAO_IPFILTER   *ip       = (TAO_IPFILTER *)tao->data;
  const PetscReal residual = IPUndefined(ip->linear_residual) ? ip->linear_rhs : ip->linear_residual; /* no direction, no reduction */

  PetscFunctionBegin;
  PetscCall(IPSetReason(tao, TAO_DIVERGED_USER, "linear solver failed: %s, ||b - A d|| = %g for ||b|| = %g%s%s", KSPConvergedReasons[ip->ksp_reason], (double)residual, (double)ip->linear_rhs, ip->linear_reason[0] ? "; " : "", ip->linear_reason));
  PetscFunctionReturn(0);
}

/* No direction, or no step along it. Mehrotra's choice of mu is given up for a while first; then the violation is
   reduced by itself. */
static PetscErrorCode Recover(Tao tao, PetscBool solved)
{
  TAO_IPFILTER   *ip = (TAO_IPFILTER *)tao->data;
  const PetscInt  hold = 10;
  const PetscBool violated = (PetscBool)(ip->kkt.primal > PetscMax(100.0 * ip->tol, 1e-6));
  PetscBool       ok = PETSC_FALSE, infeasible = PETSC_FALSE;

  PetscFunctionBegin;
  if (ip->kkt.error <= ip->acceptable_tol) {
    PetscCall(IPSetReason(tao, TAO_CONVERGED_STEPTOL, "acceptable: no step reduces the KKT error %g further; %g was asked for", (double)ip->kkt.error, (double)ip->tol));
    PetscFunctionReturn(0);
  }
  if (!solved && ip->linear_failed) {
    PetscCall(LinearFailure(tao));
    PetscFunctionReturn(0);
  }
  if (ip->free_mu) {
    PetscCall(IPBarrierHold(tao, hold));
    PetscFunctionReturn(0);
  }
  if (violated && ip->theta0 >= 0.0) {
    PetscCall(IPRestore(tao, &ok, &infeasible));
    if (!ok) PetscCall(IPComputeKKT(tao));
  }
  if (ok) {
    ip->step_tag = 'R';
    tao->niter++;
  } else if (infeasible) PetscCall(IPSetReason(tao, TAO_DIVERGED_LS_FAILURE, "the constraints seem infeasible: their violation has a minimum, of %g", (double)ip->kkt.inf_pr));
  else if (!solved && ip->linear_failed) PetscCall(LinearFailure(tao));
  else if (!solved) PetscCall(IPSetReason(tao, TAO_DIVERGED_USER, "no direction of sufficient curvature, with the Hessian shifted by up to %g; the linear solver's last word: %s", (double)ip->delta, KSPConvergedReasons[ip->ksp_reason]));
  else if (violated) PetscCall(IPSetReason(tao, TAO_DIVERGED_LS_FAILURE, "no step reduces the constraint violation %g", (double)ip->kkt.inf_pr));
  else PetscCall(IPSetReason(tao, TAO_DIVERGED_LS_FAILURE, "line search failed at KKT error %g", (double)ip->kkt.error));
  PetscFunctionReturn(0);
}

/* One Newton step: Hessian, barrier parameter, direction, line search, derivatives at the new point */
static PetscErrorCode Step(Tao tao)
{
  PetscBool solved = PETSC_FALSE, ok = PETSC_FALSE;

  PetscFunctionBegin;
  tao->ksp_its = 0;
  PetscCall(IPRelax(tao));
  PetscCall(IPBarrierUpdate(tao));
  PetscCall(TaoComputeHessian(tao, tao->solution, tao->hessian, tao->hessian_pre));
  PetscCall(IPComputeDirection(tao, &solved));
  if (solved) PetscCall(IPLineSearch(tao, &ok));
  if (!ok) {
    PetscCall(Recover(tao, solved));
    PetscFunctionReturn(0);
  }
  tao->niter++;
  PetscCall(IPEvaluateDerivatives(tao));
  PetscFunctionReturn(0);
}

PetscErrorCode TaoSolve_IPFilter(Tao tao)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  PetscBool     finite = PETSC_FALSE;

  PetscFunctionBegin;
  PetscCall(IPSetUpSizes(tao));
  ip->tol = tao->gatol > 0.0 ? tao->gatol : PETSC_MACHINE_EPSILON; /* PETSc's 0 asks for as much as there is */
  PetscCall(ResetRecord(tao));
  PetscCall(FirstPoint(tao, &finite));
  if (!finite) {
    PetscCall(IPSetReason(tao, TAO_DIVERGED_NAN, "the objective, its gradient or a constraint is not a number at the starting point"));
    PetscFunctionReturn(0);
  }
  PetscCall(IPSetMultipliers(tao));
  PetscCall(TestFirstPoint(tao));
  if (tao->reason == TAO_CONTINUE_ITERATING) {
    PetscCall(TaoComputeHessian(tao, tao->solution, tao->hessian, tao->hessian_pre));
    PetscCall(IPComputeStiffness(tao));
    PetscCall(IPStartPoint(tao));
    PetscCall(AssessIterate(tao));
  }
  while (tao->reason == TAO_CONTINUE_ITERATING) {
    PetscTryTypeMethod(tao, update, tao->niter, tao->user_update);
    PetscCall(Step(tao));
    if (tao->reason == TAO_CONTINUE_ITERATING) PetscCall(AssessIterate(tao));
  }
  PetscCall(IPDirectDestroy(&ip->direct));
  PetscCall(RestoreBest(tao));
  PetscCall(IPSetMultipliers(tao));
  if (ip->mi) PetscCall(IPScalingPair(tao, ip->pair[IP_SLACK].t, ip->pair[IP_SLACK].z, PETSC_TRUE));
  tao->fc       = ip->f;
  tao->residual = ip->kkt.error;
  tao->cnorm    = ip->kkt.inf_pr;
  PetscFunctionReturn(0);
}
