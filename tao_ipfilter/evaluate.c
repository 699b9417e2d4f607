/* The caller's functions at a point: constraints and derivatives. */
#include "ipfilterimpl.h"

/* c_I - I_l with the lower bounds of TaoSetInequalityBounds(), and c_E, scaled; c_I relaxed */
PetscErrorCode IPEvaluateConstraints(Tao tao, Vec x, Vec c, Vec ce)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  if (ip->mi) {
    PetscCall(TaoComputeInequalityConstraints(tao, x, c));
    if (tao->IL) PetscCall(VecAXPY(c, -1.0, tao->IL));
    if (ip->rows.inequality) PetscCall(VecPointwiseMult(c, c, ip->rows.inequality));
    if (ip->relax.by > 0.0) PetscCall(VecShift(c, ip->relax.by));
  }
  if (ip->me) PetscCall(TaoComputeEqualityConstraints(tao, x, ce));
  if (ip->rows.equality) PetscCall(VecPointwiseMult(ce, ce, ip->rows.equality));
  PetscFunctionReturn(0);
}

/* Gradient and constraint Jacobians at tao->solution, whose objective is in ip->at.f. Fixed variables have none. */
PetscErrorCode IPEvaluateDerivatives(Tao tao)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  PetscBool     alone;

  PetscFunctionBegin;
  PetscCall(TaoIsGradientDefined(tao, &alone));
  if (alone) PetscCall(TaoComputeGradient(tao, tao->solution, tao->gradient));
  else PetscCall(TaoComputeObjectiveAndGradient(tao, tao->solution, &ip->at.f, tao->gradient));
  PetscCall(IPFixedZero(tao, tao->gradient));
  if (ip->me) {
    PetscCall(TaoComputeJacobianEquality(tao, tao->solution, tao->jacobian_equality, tao->jacobian_equality_pre));
    PetscCall(IPJacobianEquality(tao));
  }
  if (ip->mi) {
    PetscCall(TaoComputeJacobianInequality(tao, tao->solution, tao->jacobian_inequality, tao->jacobian_inequality_pre));
    PetscCall(IPJacobianInequality(tao));
  }
  PetscFunctionReturn(0);
}

/* tao->DI = M lambda and tao->DE = y, scaled back: the multipliers of f + DE^T c_E - DI^T c_I, whose Hessian is asked for */
PetscErrorCode IPSetMultipliers(Tao tao)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  if (ip->mi) PetscCall(VecPointwiseMult(tao->DI, ip->at.lambda, ip->pair[IP_SLACK].w));
  if (ip->rows.inequality) PetscCall(VecPointwiseMult(tao->DI, tao->DI, ip->rows.inequality));
  if (ip->me) PetscCall(VecCopy(ip->at.y, tao->DE));
  if (ip->rows.equality) PetscCall(VecPointwiseMult(tao->DE, tao->DE, ip->rows.equality));
  PetscFunctionReturn(0);
}
