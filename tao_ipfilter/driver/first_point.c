/* Prepares the starting point: moves it into the bounds, scales the rows, and measures the sizes of the terms there */
#include "driverimpl.h"
#include "tao_ipfilter/solver/constants.h"
#include "tao_ipfilter/solver/matrices.h"
#include "tao_ipfilter/solver/options.h"
#include "tao_ipfilter/solver/sizes.h"
#include "tao_ipfilter/solver/stiffness.h"
#include "tao_ipfilter/solver/terms.h"

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
  Vec           sums;

  PetscFunctionBegin;
  first->f = ip->at.f;
  PetscCall(VecNorm(tao->gradient, NORM_2, &first->gradient));
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

/* Finds whether the gradient of a violated row of J is zero. violation: of the rows */
static PetscErrorCode RowVanishes(Tao tao, IPSpace space, Mat J, Vec violation, PetscBool *vanishes)
{
  const PetscScalar *v, *g;
  PetscInt           n;
  PetscBool          found = PETSC_FALSE;
  Vec                sums, largest;

  PetscFunctionBegin;
  PetscCall(IPGetWork(tao, space, &sums));
  PetscCall(IPGetWork(tao, space, &largest));
  PetscCall(IPOwnTerms(J, tao->solution, sums, largest));
  PetscCall(VecGetLocalSize(violation, &n));
  PetscCall(VecGetArrayRead(violation, &v));
  PetscCall(VecGetArrayRead(largest, &g));
  for (PetscInt i = 0; i < n; i++) found = (PetscBool)(found || (v[i] != 0.0 && g[i] == 0.0));
  PetscCall(VecRestoreArrayRead(largest, &g));
  PetscCall(VecRestoreArrayRead(violation, &v));
  PetscCall(IPRestoreWork(tao, space, &largest));
  PetscCall(IPRestoreWork(tao, space, &sums));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &found, 1, MPI_PETSCBOOL, MPI_LOR, PetscObjectComm((PetscObject)tao)));
  *vanishes = (PetscBool)(*vanishes || found);
  PetscFunctionReturn(0);
}

/*
   Finds whether first derivatives do not tell where to go from the start: the gradient is zero, although the objective
   is concave along an unknown, or that of a violated constraint is zero
*/
static PetscErrorCode FirstIsCritical(Tao tao, PetscBool *critical)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  PetscReal     least;
  Vec           v;

  PetscFunctionBegin;
  *critical = PETSC_FALSE;
  if (ip->terms->given) PetscFunctionReturn(0);
  if (ip->mi) {
    PetscCall(IPGetWork(tao, IP_INEQUALITIES, &v));
    PetscCall(IPSlackViolation(tao, ip->at.c, v));
    PetscCall(RowVanishes(tao, IP_INEQUALITIES, ip->jac->inequality, v, critical));
    PetscCall(IPRestoreWork(tao, IP_INEQUALITIES, &v));
  }
  if (ip->me) PetscCall(RowVanishes(tao, IP_EQUALITIES, ip->jac->equality, ip->at.ce, critical));
  if (*critical || ip->first->gradient > 0.0) PetscFunctionReturn(0);
  PetscCall(IPSetMultipliers(tao));
  PetscCall(IPHessianEvaluate(tao));
  PetscCall(IPGetWork(tao, IP_UNKNOWNS, &v));
  PetscCall(IPHessianDiagonal(tao, v));
  PetscCall(VecMin(v, NULL, &least));
  PetscCall(IPRestoreWork(tao, IP_UNKNOWNS, &v));
  *critical = (PetscBool)(least < 0.0);
  PetscFunctionReturn(0);
}

/* Moves every unknown by a small and different amount */
static PetscErrorCode LeaveFirst(Tao tao)
{
  const PetscReal part = 1e-2;
  PetscScalar    *x;
  PetscInt        first, last;

  PetscFunctionBegin;
  PetscCall(VecGetOwnershipRange(tao->solution, &first, &last));
  PetscCall(VecGetArray(tao->solution, &x));
  for (PetscInt j = first; j < last; j++)
    x[j - first] += part * PetscMax(1.0, PetscAbsScalar(x[j - first])) * (1.0 + PetscSinReal((PetscReal)j) / 2.0);
  PetscCall(VecRestoreArray(tao->solution, &x));
  PetscFunctionReturn(0);
}

/* Moves the start inside its bounds and evaluates all functions there. *finite: false if a value is NaN or infinite. */
static PetscErrorCode TakeFirst(Tao tao, PetscBool *finite)
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
  if (ip->mi) PetscCall(IPPairSetWeights(ip->given->slack_mass, &ip->pair[IP_SLACK]));
  PetscCall(IPSidesSetUpPairs(tao));
  PetscCall(IPSidesUpdateWidth(tao));
  PetscCall(IPBoundsSetUp(tao));
  PetscCall(IPIterateBind(tao));
  PetscCall(IPBoundsPush(tao));
  PetscCall(VecNorm(tao->solution, NORM_INFINITY, &ip->first->x));
  PetscCall(EvaluateFirst(tao, finite));
  if (!*finite) PetscFunctionReturn(0);
  PetscCall(ScaleRows(tao));
  PetscCall(IPSlackSetCompliance(tao));
  PetscCall(MeasureFirst(tao, finite));
  PetscFunctionReturn(0);
}

/*
   Takes the start, or, if first derivatives do not tell where to go from there, a point beside it. *finite: false if a
   value is NaN or infinite.
*/
PetscErrorCode IPFirstPoint(Tao tao, PetscBool *finite)
{
  PetscBool critical;

  PetscFunctionBegin;
  PetscCall(TakeFirst(tao, finite));
  if (!*finite) PetscFunctionReturn(0);
  PetscCall(FirstIsCritical(tao, &critical));
  if (!critical) PetscFunctionReturn(0);
  PetscCall(PetscInfo(tao, "The start is a critical point: the solve begins beside it\n"));
  PetscCall(LeaveFirst(tao));
  PetscCall(TakeFirst(tao, finite));
  PetscFunctionReturn(0);
}
