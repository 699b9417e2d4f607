/*
   The search direction, with inertia-free regularization (Chiang and Zavala 2016): the direction must show enough
   curvature and the Krylov method must not meet a negative one, else delta M_u is added to the Hessian and grows.
*/
#include "ipfilterimpl.h"

/* d^T W d + max(lambda+^T M (c - s), 0) >= kappa d^T d, with W = H + Sigma + delta M_u on the unknowns and D on the
   slacks. A, which holds J^T D J instead, would lose d^T H d to rounding once D is large. A step that rounding makes of x has no
   curvature to speak of. */
static PetscErrorCode CurvatureTest(Tao tao, PetscBool *passes)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  PetscScalar   dHd, dd, dSd = 0.0;
  PetscReal     curvature, kappa, step, size;

  PetscFunctionBegin;
  PetscCall(VecNorm(ip->dx, NORM_INFINITY, &step));
  PetscCall(VecNorm(tao->solution, NORM_INFINITY, &size));
  *passes = (PetscBool)(step <= IP_TINY_STEP * size);
  if (*passes) PetscFunctionReturn(0);
  PetscCall(MatMult(tao->hessian, ip->dx, ip->xwork2));
  PetscCall(VecDot(ip->dx, ip->xwork2, &dHd));
  PetscCall(VecDot(ip->dx, ip->dx, &dd));
  if (ip->cond.shifted) {
    PetscCall(VecPointwiseMult(ip->xwork2, ip->cond.shift, ip->dx));
    PetscCall(VecDot(ip->dx, ip->xwork2, &dSd));
  }
  curvature = PetscRealPart(dHd) + PetscRealPart(dSd);
  kappa     = ip->kappa_curvature * (ip->scaling == IP_SCALING_NONE ? 1.0 : ip->hscale);
  if (ip->mi) {
    IPPair     *slack = &ip->pair[IP_SLACK];
    PetscScalar sDs, ss, force;

    PetscCall(IPPairGetSigma(slack, ip->cwork));
    PetscCall(VecPointwiseMult(ip->cwork2, slack->dt, slack->dt));
    PetscCall(VecDot(ip->cwork, ip->cwork2, &sDs));
    PetscCall(VecSum(ip->cwork2, &ss));
    PetscCall(VecWAXPY(ip->cwork, 1.0, ip->lambda, ip->dlambda));
    PetscCall(VecPointwiseMult(ip->cwork, ip->cwork, slack->w));
    PetscCall(VecDot(ip->cwork, ip->rc, &force));
    curvature += PetscRealPart(sDs) + PetscMax(PetscRealPart(force), 0.0);
    if (ip->scaling == IP_SCALING_NONE) dd += ss;
  }
  *passes = (PetscBool)(curvature >= kappa * PetscRealPart(dd));
  if (!*passes) PetscCall(PetscInfo(tao, "Curvature %g of the direction is below %g; regularizing\n", (double)curvature, (double)(kappa * PetscRealPart(dd))));
  PetscFunctionReturn(0);
}

/* Whether the whole step would end the solve but for the forces left out of balance: steps of one, well away from the
   boundary, and all products (t + dt)(z + dz) within the tolerance */
static PetscErrorCode WouldFinish(Tao tao, PetscBool *finish)
{
  TAO_IPFILTER   *ip      = (TAO_IPFILTER *)tao->data;
  const PetscReal margin  = 0.9;
  PetscReal       largest = 0.0, alpha = 1.0;

  PetscFunctionBegin;
  for (PetscInt b = 0; b < IP_NPAIRS; b++) {
    IPPair   *p = &ip->pair[b];
    PetscReal product;

    if (!p->n) continue;
    PetscCall(IPPairMaxStep(p->t, p->dt, margin, &alpha));
    PetscCall(IPPairMaxStep(p->z, p->dz, margin, &alpha));
    PetscCall(IPPairStepProducts(p, 1.0, 1.0, &product, NULL));
    largest = PetscMax(largest, product);
  }
  *finish = (PetscBool)(alpha == 1.0 && largest <= ip->tol * ip->scale.product);
  PetscFunctionReturn(0);
}

/* ||b - A d|| asked for: a few percent of the forces in balance, and always less than the imbalance there was; no less than last */
static PetscReal ForcingTarget(const TAO_IPFILTER *ip, PetscReal last)
{
  const PetscReal loose = PetscMin(ip->forcing_max * ip->scale.dual, ip->forcing_reduce * ip->kkt.dual_norm);

  return PetscMax(loose, last);
}

/* The direction for the residuals rc, ce and the pairs' targets, from the guess in dx. While mu falls the forces need
   balance only to a few percent, so that the multipliers are right to a few percent; a step that would finish is
   continued to what convergence asks for. matrix tells that A is new. */
static PetscErrorCode SolveDirection(Tao tao, Vec rc, Vec ce, PetscBool matrix, PetscBool *usable)
{
  TAO_IPFILTER   *ip     = (TAO_IPFILTER *)tao->data;
  const PetscReal last   = ip->forcing_last * ip->tol * ip->scale.dual;
  PetscBool       finish = PETSC_FALSE;

  PetscFunctionBegin;
  PetscCall(IPCondenseRHS(tao, rc, ip->rhs));
  if (ip->me) PetscCall(IPAugmentedSolve(tao, ip->rhs, ce, ip->dx, matrix, usable));
  else PetscCall(IPLinearSolve(tao, ip->rhs, ip->dx, ForcingTarget(ip, last), usable));
  if (!*usable) PetscFunctionReturn(0);
  PetscCall(IPBackSubstitute(tao, rc));
  if (ip->me || ip->forcing == IP_FORCING_FIXED || ip->linear_residual <= last) PetscFunctionReturn(0);
  PetscCall(WouldFinish(tao, &finish));
  if (!finish) PetscFunctionReturn(0);
  PetscCall(IPLinearSolve(tao, ip->rhs, ip->dx, last, usable));
  if (*usable) PetscCall(IPBackSubstitute(tao, rc));
  PetscFunctionReturn(0);
}

PetscErrorCode IPSetTargets(Tao tao, PetscReal mu, PetscReal most)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  for (PetscInt b = 0; b < IP_NPAIRS; b++) PetscCall(IPPairSetTarget(&ip->pair[b], mu, most));
  PetscFunctionReturn(0);
}

/* The matrix with the present delta */
static PetscErrorCode AssembleSystem(Tao tao)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  if (ip->mi) PetscCall(IPPairGetSigma(&ip->pair[IP_SLACK], ip->cwork));
  PetscCall(IPCondenseMatrix(tao, ip->cwork));
  PetscFunctionReturn(0);
}

/* Solves the system; in Mehrotra's method first for mu = 0, whose step chooses mu and gives the second-order term and the
   guess of the direction proper. */
static PetscErrorCode SolveSystem(Tao tao, PetscBool *usable)
{
  TAO_IPFILTER *ip     = (TAO_IPFILTER *)tao->data;
  PetscBool     matrix = PETSC_TRUE;

  PetscFunctionBegin;
  PetscCall(VecSet(ip->dx, 0.0));
  if (ip->free_mu) {
    PetscCall(IPSetTargets(tao, 0.0, 0.0));
    PetscCall(SolveDirection(tao, ip->rc, ip->ce, PETSC_TRUE, usable));
    if (!*usable) PetscFunctionReturn(0);
    PetscCall(IPBarrierFromAffine(tao));
    matrix = PETSC_FALSE;
  }
  PetscCall(IPSetTargets(tao, ip->mu, ip->free_mu ? ip->corrector_max : 0.0));
  PetscCall(SolveDirection(tao, ip->rc, ip->ce, matrix, usable));
  PetscFunctionReturn(0);
}

/* Another direction with the matrix of the last one, for the residuals of a second-order correction */
PetscErrorCode IPCorrectDirection(Tao tao, Vec rc, Vec ce, PetscBool *usable)
{
  PetscFunctionBegin;
  PetscCall(SolveDirection(tao, rc, ce, PETSC_FALSE, usable));
  PetscFunctionReturn(0);
}

/* First delta after none: the last one shrunk; else grown, faster while none has worked yet */
static PetscReal NextDelta(const TAO_IPFILTER *ip, PetscReal unit)
{
  if (ip->delta == 0.0) return ip->delta_last > 0.0 ? PetscMax(ip->delta_shrink * ip->delta_last, PETSC_MACHINE_EPSILON * unit) : ip->delta_first * unit;
  return (ip->delta_last > 0.0 ? ip->delta_grow : ip->delta_grow_first) * ip->delta;
}

/* The unit of delta: typical diagonal entry of H over typical mass */
static PetscErrorCode DeltaUnit(Tao tao, PetscReal *unit)
{
  TAO_IPFILTER *ip   = (TAO_IPFILTER *)tao->data;
  PetscReal     mass = 1.0;
  PetscInt      n;

  PetscFunctionBegin;
  *unit = 1.0;
  if (ip->scaling == IP_SCALING_NONE) PetscFunctionReturn(0);
  if (ip->primal_mass) {
    PetscCall(VecSum(ip->primal_mass, &mass));
    PetscCall(VecGetSize(ip->primal_mass, &n));
    mass /= n;
  }
  *unit = ip->hscale / mass;
  PetscFunctionReturn(0);
}

/* The shift at and below which A has a diagonal entry that is not positive, and so is not positive definite: nothing to solve
   there, and nothing that an AMG could be built from. Negative where the Hessian needs none for that. A matrix with an entry that is
   not a number is a failure. */
static PetscErrorCode LeastDelta(Tao tao, PetscReal *least)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  PetscReal     smallest, size;

  PetscFunctionBegin;
  PetscCall(MatGetDiagonal(ip->cond.A, ip->xwork));
  PetscCall(VecNorm(ip->xwork, NORM_2, &size));
  if (PetscIsInfOrNanReal(size)) PetscCall(IPLinearNotANumber(tao));
  if (ip->primal_mass) PetscCall(VecPointwiseDivide(ip->xwork, ip->xwork, ip->primal_mass));
  PetscCall(VecMin(ip->xwork, NULL, &smallest));
  *least = ip->delta - smallest;
  PetscFunctionReturn(0);
}

/* Solves with delta raised, from first times its unit on, until the caller's solve calls its solution usable, and tells
   whether that was reached. A solver that fails is not helped by a larger delta. */
PetscErrorCode IPRegularize(Tao tao, PetscReal first, PetscErrorCode (*assemble)(Tao), PetscErrorCode (*solve)(Tao, PetscBool *), PetscBool *ok)
{
  TAO_IPFILTER *ip   = (TAO_IPFILTER *)tao->data;
  PetscReal     unit = 1.0, least = PETSC_NINFINITY;

  PetscFunctionBegin;
  PetscCall(DeltaUnit(tao, &unit));
  *ok               = PETSC_FALSE;
  ip->delta         = first * unit;
  ip->linear_failed = PETSC_FALSE;
  while (ip->delta <= ip->delta_max * unit) {
    PetscCall((*assemble)(tao));
    if (least == PETSC_NINFINITY && !ip->me) PetscCall(LeastDelta(tao, &least));
    if (ip->linear_failed) break;
    if (ip->delta > least) {
      PetscCall((*solve)(tao, ok));
      if (*ok || ip->linear_failed) break;
      ip->nretried++;
    }
    do ip->delta = NextDelta(ip, unit);
    while (ip->delta <= least);
  }
  PetscFunctionReturn(0);
}

/* The Newton direction, whose curvature (or, with equality constraints, whose matrix's inertia) is in order */
static PetscErrorCode SolveNewton(Tao tao, PetscBool *usable)
{
  PetscFunctionBegin;
  PetscCall(SolveSystem(tao, usable));
  if (*usable && !((TAO_IPFILTER *)tao->data)->me) PetscCall(CurvatureTest(tao, usable));
  PetscFunctionReturn(0);
}

PetscErrorCode IPComputeDirection(Tao tao, PetscBool *ok)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  ip->delta_c = 0.0;
  PetscCall(IPRegularize(tao, 0.0, AssembleSystem, SolveNewton, ok));
  if (!*ok || ip->delta == 0.0) PetscFunctionReturn(0);
  ip->delta_last    = ip->delta;
  ip->delta_largest = PetscMax(ip->delta_largest, ip->delta);
  ip->nregularized++;
  ip->curved = PETSC_TRUE;
  PetscFunctionReturn(0);
}
