/* Prepares the starting point: moves it into the bounds, scales the rows, and measures the sizes of the terms there */
#include "driverimpl.h"
#include "tao_ipfilter/solver/constants.h"
#include "tao_ipfilter/solver/matrices.h"
#include "tao_ipfilter/solver/options.h"
#include "tao_ipfilter/solver/sizes.h"
#include "tao_ipfilter/solver/stiffness.h"

/*
   Evaluates objective, constraints and derivatives at the start. *defined: false if the objective is NaN or infinite;
   nothing else is evaluated then.
*/
static PetscErrorCode EvaluateFirst(Tao tao, PetscBool *defined)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  PetscBool     alone;

  PetscFunctionBegin;
  PetscCall(TaoIsGradientDefined(tao, &alone));
  if (alone) PetscCall(TaoComputeObjective(tao, tao->solution, &ip->at.f));
  *defined = (PetscBool) !(alone && IPUndefined(ip->at.f));
  if (!*defined) PetscFunctionReturn(0);
  PetscCall(IPEvaluateConstraints(tao, tao->solution, ip->at.c, ip->at.ce));
  if (ip->mi) PetscCall(VecSet(ip->at.lambda, 0.0));
  if (ip->me) PetscCall(VecSet(ip->at.y, 0.0));
  PetscCall(IPEvaluateDerivatives(tao));
  PetscFunctionReturn(0);
}

/* Destroys matrices that belong to another set of fixed variables or to other row scales */
PetscErrorCode IPForgetSystem(Tao tao)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  PetscCall(IPCondensedDestroy(ip->cond));
  PetscCall(IPJacobianDestroy(ip->jac));
  PetscFunctionReturn(0);
}

/* Chooses the row scales, and evaluates the scaled constraints and derivatives */
static PetscErrorCode ScaleRows(Tao tao)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  PetscBool     scaled;

  PetscFunctionBegin;
  PetscCall(IPRowScaleSetUp(tao, &scaled));
  if (!scaled) PetscFunctionReturn(0);
  PetscCall(IPForgetSystem(tao));
  PetscCall(IPSidesUpdateWidth(tao));
  PetscCall(IPEvaluateConstraints(tao, tao->solution, ip->at.c, ip->at.ce));
  PetscCall(IPEvaluateDerivatives(tao));
  PetscFunctionReturn(0);
}

/* Measures the sizes at the start. *finite: false if one of them is NaN or infinite. */
static PetscErrorCode MeasureFirst(Tao tao, PetscBool *finite)
{
  TAO_IPFILTER *ip    = (TAO_IPFILTER *)tao->data;
  IPFirst      *first = ip->first;
  PetscReal     largest;
  Vec           sums;

  PetscFunctionBegin;
  first->f = ip->at.f;
  PetscCall(VecNorm(tao->gradient, NORM_2, &first->gradient));
  PetscCall(VecNorm(tao->gradient, NORM_INFINITY, &largest));
  first->unit = ip->opt->scaling == IP_SCALING_GRADIENT ? PetscMax(1.0, largest / IP_GRADIENT_MAX) : 1.0;
  if (ip->mi) {
    PetscCall(VecNorm(ip->at.c, NORM_INFINITY, &first->length));
    PetscCall(MatNorm(ip->jac->inequality, NORM_INFINITY, &first->jacobian));
  }
  if (ip->me) {
    PetscCall(VecNorm(ip->at.ce, NORM_INFINITY, &first->equality));
    PetscCall(MatNorm(ip->jac->equality, NORM_INFINITY, &first->equality_jacobian));
    if (!ip->stiff->equality_rows) PetscCall(VecDuplicate(ip->at.ce, &ip->stiff->equality_rows));
    PetscCall(IPGetWork(tao, IP_EQUALITIES, &sums));
    PetscCall(IPOwnTerms(ip->jac->equality, tao->solution, sums, ip->stiff->equality_rows));
    PetscCall(IPRestoreWork(tao, IP_EQUALITIES, &sums));
  }
  *finite = (PetscBool)(!IPUndefined(first->f) && !IPUndefined(first->gradient) && !IPUndefined(first->length) &&
                        !IPUndefined(first->equality));
  PetscFunctionReturn(0);
}

/* Moves the start inside its bounds and evaluates all functions there. *finite: false if a value is NaN or infinite. */
PetscErrorCode IPFirstPoint(Tao tao, PetscBool *finite)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  PetscBool     other_fixed, other_scales;
  PetscReal     size;

  PetscFunctionBegin;
  PetscCall(VecNorm(tao->solution, NORM_INFINITY, &size));
  *finite = (PetscBool)!IPUndefined(size); /* Test this first, since moving x into its bounds would hide a NaN. */
  if (!*finite) PetscFunctionReturn(0);
  PetscCall(TaoComputeVariableBounds(tao));
  PetscCall(IPFixedSetUp(tao, &other_fixed));
  PetscCall(IPRowScaleReset(tao, &other_scales));
  if (other_fixed || other_scales) PetscCall(IPForgetSystem(tao));
  PetscCall(IPSidesSetUpPairs(tao));
  PetscCall(IPSidesUpdateWidth(tao));
  PetscCall(IPBoundsSetUp(tao));
  PetscCall(IPIterateBind(tao));
  PetscCall(IPBoundsPush(tao));
  PetscCall(VecNorm(tao->solution, NORM_INFINITY, &ip->first->x));
  PetscCall(EvaluateFirst(tao, finite));
  if (!*finite) PetscFunctionReturn(0);
  PetscCall(ScaleRows(tao));
  PetscCall(MeasureFirst(tao, finite));
  PetscFunctionReturn(0);
}
