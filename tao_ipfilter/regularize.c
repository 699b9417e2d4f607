/*
   The search direction, with inertia-free regularization (Chiang and Zavala 2016): the direction must show enough
   curvature and the Krylov method must not meet a negative one, else delta M_u is added to the Hessian and grows.
*/
#include "ipfilterimpl.h"

/* d^T W d + max(lambda+^T M (c - s), 0) >= kappa d^T d, with W = H + Sigma over unknowns and slacks */
static PetscErrorCode CurvatureTest(Tao tao, PetscBool *passes)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  PetscScalar   dAd, dd, sd;
  PetscReal     curvature, kappa;

  PetscFunctionBegin;
  PetscCall(MatMult(ip->cond.A, ip->dx, ip->xwork2));
  PetscCall(VecDot(ip->dx, ip->xwork2, &dAd));
  PetscCall(VecDot(ip->dx, ip->dx, &dd));
  curvature = PetscRealPart(dAd);
  kappa     = ip->kappa_curvature * (ip->scaling == IP_SCALING_NONE ? 1.0 : ip->hscale);
  if (ip->mi) {
    IPPair     *slack = &ip->pair[IP_SLACK];
    PetscScalar jdj, sds, force;

    /* A holds J^T D J; W holds D on the slacks instead */
    PetscCall(IPPairGetSigma(slack, ip->cwork));
    PetscCall(MatMult(ip->cond.J, ip->dx, ip->cwork2));
    PetscCall(VecPointwiseMult(ip->cwork2, ip->cwork2, ip->cwork2));
    PetscCall(VecDot(ip->cwork, ip->cwork2, &jdj));
    PetscCall(VecPointwiseMult(ip->cwork2, slack->dt, slack->dt));
    PetscCall(VecDot(ip->cwork, ip->cwork2, &sds));
    PetscCall(VecWAXPY(ip->cwork, 1.0, ip->lambda, ip->dlambda));
    PetscCall(VecPointwiseMult(ip->cwork, ip->cwork, slack->w));
    PetscCall(VecDot(ip->cwork, ip->rc, &force));
    PetscCall(VecDot(slack->dt, slack->dt, &sd));
    curvature += PetscRealPart(sds) - PetscRealPart(jdj) + PetscMax(PetscRealPart(force), 0.0);
    if (ip->scaling == IP_SCALING_NONE) dd += sd;
  }
  *passes = (PetscBool)(curvature >= kappa * PetscRealPart(dd));
  if (!*passes) PetscCall(PetscInfo(tao, "Curvature %g of the direction is below %g; regularizing\n", (double)curvature, (double)(kappa * PetscRealPart(dd))));
  PetscFunctionReturn(0);
}

/* Whether the whole step would end the solve but for the forces left out of balance: steps of one, and all products
   (t + dt)(z + dz) within the tolerance */
static PetscErrorCode WouldFinish(Tao tao, PetscBool *finish)
{
  TAO_IPFILTER *ip      = (TAO_IPFILTER *)tao->data;
  PetscReal     largest = 0.0, alpha = 1.0;

  PetscFunctionBegin;
  for (PetscInt b = 0; b < IP_NPAIRS; b++) {
    IPPair   *p = &ip->pair[b];
    PetscReal product;

    if (!p->n) continue;
    PetscCall(IPPairMaxStep(p->t, p->dt, ip->tau_min, &alpha));
    PetscCall(IPPairMaxStep(p->z, p->dz, ip->tau_min, &alpha));
    PetscCall(IPPairStepProducts(p, 1.0, 1.0, &product, NULL));
    largest = PetscMax(largest, product);
  }
  *finish = (PetscBool)(alpha == 1.0 && largest <= ip->tol * ip->scale.product);
  PetscFunctionReturn(0);
}

/* Solves the condensed system for the present targets. While mu falls the forces need balance only to a few percent,
   so that the multipliers are right to a few percent; the step that would finish is continued to what convergence asks. */
static PetscErrorCode SolveDirection(Tao tao, PetscBool *usable)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  PetscReal     target = PetscMin(ip->forcing_max * ip->scale.dual, ip->forcing_reduce * ip->kkt.dual_norm);
  PetscBool     finish = PETSC_FALSE;

  PetscFunctionBegin;
  PetscCall(IPLinearSolve(tao, ip->rhs, ip->dx, PetscMax(target, ip->forcing_last * ip->tol * ip->scale.dual), usable));
  if (!*usable) PetscFunctionReturn(0);
  PetscCall(IPBackSubstitute(tao, ip->rc));
  if (ip->forcing == IP_FORCING_FIXED) PetscFunctionReturn(0);
  PetscCall(WouldFinish(tao, &finish));
  if (!finish) PetscFunctionReturn(0);
  PetscCall(IPLinearSolve(tao, ip->rhs, ip->dx, ip->forcing_last * ip->tol * ip->scale.dual, usable));
  if (*usable) PetscCall(IPBackSubstitute(tao, ip->rc));
  PetscFunctionReturn(0);
}

/* Assembles the system with the present delta and solves it */
static PetscErrorCode SolveOnce(Tao tao, PetscBool *usable)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  if (ip->mi) PetscCall(IPPairGetSigma(&ip->pair[IP_SLACK], ip->cwork));
  PetscCall(IPCondenseMatrix(tao, ip->cwork));
  for (PetscInt b = 0; b < IP_NPAIRS; b++) PetscCall(IPPairSetTarget(&ip->pair[b], ip->mu, PETSC_FALSE));
  PetscCall(IPCondenseRHS(tao, ip->rc, ip->rhs));
  PetscCall(VecSet(ip->dx, 0.0));
  PetscCall(SolveDirection(tao, usable));
  PetscFunctionReturn(0);
}

/* First delta after none: the last one shrunk; else grown, faster while none has worked yet */
static PetscReal NextDelta(const TAO_IPFILTER *ip, PetscReal unit)
{
  if (ip->delta == 0.0) return ip->delta_last > 0.0 ? PetscMax(ip->delta_shrink * ip->delta_last, PETSC_MACHINE_EPSILON * unit) : ip->delta_first * unit;
  return (ip->delta_last > 0.0 ? ip->delta_grow : ip->delta_grow_first) * ip->delta;
}

PetscErrorCode IPComputeDirection(Tao tao, PetscBool *ok)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  PetscReal     unit = 1.0, mass = 1.0;

  PetscFunctionBegin;
  if (ip->scaling == IP_SCALING_PROBLEM) {
    PetscInt n;

    if (ip->primal_mass) {
      PetscCall(VecSum(ip->primal_mass, &mass));
      PetscCall(VecGetSize(ip->primal_mass, &n));
      mass /= n;
    }
    unit = ip->hscale / mass;
  }
  ip->delta = 0.0;
  while (ip->delta <= ip->delta_max * unit) {
    PetscBool usable, passes = PETSC_FALSE;

    PetscCall(SolveOnce(tao, &usable));
    if (usable) PetscCall(CurvatureTest(tao, &passes));
    if (passes) {
      if (ip->delta > 0.0) ip->delta_last = ip->delta;
      *ok = PETSC_TRUE;
      PetscFunctionReturn(0);
    }
    ip->delta = NextDelta(ip, unit);
  }
  *ok = PETSC_FALSE;
  PetscFunctionReturn(0);
}
