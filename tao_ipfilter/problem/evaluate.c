/* Calls the caller's functions at a point: constraints and derivatives */
#include "problemimpl.h"
#include "tao_ipfilter/solver/relaxation.h"
#include "tao_ipfilter/solver/rows.h"

/* Evaluates c_E at x. ce must already hold the rows of c_I with equal bounds, which IPSidesConstraints() stores. */
static PetscErrorCode EvaluateEquality(Tao tao, Vec x, Vec ce)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  if (!ip->sides->nall) PetscCall(TaoComputeEqualityConstraints(tao, x, ce));
  else if (ip->me > ip->sides->nall) {
    PetscCall(TaoComputeEqualityConstraints(tao, x, tao->constraints_equality));
    PetscCall(IPSidesEquality(tao->constraints_equality, ce, PETSC_FALSE));
  }
  if (ip->rows->equality) PetscCall(VecPointwiseMult(ce, ce, ip->rows->equality));
  PetscFunctionReturn(0);
}

/* Evaluates the scaled constraints c_I, measured from their relaxed bounds, and c_E */
PetscErrorCode IPEvaluateConstraints(Tao tao, Vec x, Vec c, Vec ce)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  if (ip->mi) {
    PetscCall(TaoComputeInequalityConstraints(tao, x, c));
    PetscCall(IPSidesConstraints(tao, c, ce));
    if (ip->rows->inequality) PetscCall(VecPointwiseMult(c, c, ip->rows->inequality));
    if (ip->relax->by > 0.0) PetscCall(VecShift(c, ip->relax->by));
  }
  if (ip->me) PetscCall(EvaluateEquality(tao, x, ce));
  PetscFunctionReturn(0);
}

/*
   Evaluates the gradient and the constraint Jacobians at tao->solution. The objective is computed as well, into
   ip->at.f, if the caller's gradient routine needs it. Entries of fixed variables are set to zero.
*/
PetscErrorCode IPEvaluateDerivatives(Tao tao)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  PetscBool     alone;

  PetscFunctionBegin;
  PetscCall(TaoIsGradientDefined(tao, &alone));
  if (alone) PetscCall(TaoComputeGradient(tao, tao->solution, tao->gradient));
  else PetscCall(TaoComputeObjectiveAndGradient(tao, tao->solution, &ip->at.f, tao->gradient));
  PetscCall(IPFixedZero(tao, tao->gradient));
  if (ip->me > ip->sides->nall)
    PetscCall(TaoComputeJacobianEquality(tao, tao->solution, tao->jacobian_equality, tao->jacobian_equality_pre));
  if (ip->mi)
    PetscCall(TaoComputeJacobianInequality(tao, tao->solution, tao->jacobian_inequality, tao->jacobian_inequality_pre));
  if (ip->mi) PetscCall(IPJacobianInequality(tao));
  if (ip->me) PetscCall(IPJacobianEquality(tao));
  PetscFunctionReturn(0);
}

/*
   Sets tao->DI = M lambda and tao->DE = y in the caller's units. These are the multipliers in f + DE^T c_E - DI^T c_I,
   whose Hessian the caller computes.
*/
PetscErrorCode IPSetMultipliers(Tao tao)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  Vec           y;

  PetscFunctionBegin;
  if (ip->mi) PetscCall(VecPointwiseMult(tao->DI, ip->at.lambda, ip->pair[IP_SLACK].w));
  if (ip->rows->inequality) PetscCall(VecPointwiseMult(tao->DI, tao->DI, ip->rows->inequality));
  PetscCall(IPGetWork(tao, IP_EQUALITIES, &y));
  if (ip->rows->equality) PetscCall(VecPointwiseMult(y, ip->at.y, ip->rows->equality));
  else if (ip->me) PetscCall(VecCopy(ip->at.y, y));
  if (ip->me > ip->sides->nall) PetscCall(IPSidesEquality(tao->DE, y, PETSC_TRUE));
  if (ip->mi) PetscCall(IPSidesMultipliers(tao, y, tao->DI));
  PetscCall(IPRestoreWork(tao, IP_EQUALITIES, &y));
  PetscFunctionReturn(0);
}
