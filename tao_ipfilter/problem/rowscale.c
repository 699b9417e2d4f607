/*
   Scales constraints by their gradients at the start: row i becomes d_i c_i. The scale d_i <= 1 limits the largest
   entry of the row's gradient to IP_ROW_RATIO times that of the smallest row, so that rows of similar size remain
   unscaled in any units. The iteration uses scaled rows; multipliers and slacks are scaled back at the end.
*/
#include "problemimpl.h"
#include "tao_ipfilter/solver/constants.h"
#include "tao_ipfilter/solver/matrices.h"
#include "tao_ipfilter/solver/options.h"
#include "tao_ipfilter/solver/rows.h"

#define IP_LEAST_SCALE 1e-20

/* Computes the scales d of the rows of J; *d is NULL if no row exceeds the limit */
static PetscErrorCode RowScale(Mat J, Vec layout, Vec *d)
{
  PetscScalar *a;
  PetscInt     rstart, rend;
  PetscReal    extreme[2] = {PETSC_NINFINITY, PETSC_NINFINITY}; /* minus the smallest row; the largest row */

  PetscFunctionBegin;
  PetscCall(VecDuplicate(layout, d));
  PetscCall(MatGetOwnershipRange(J, &rstart, &rend));
  PetscCall(VecGetArrayWrite(*d, &a));
  for (PetscInt i = rstart; i < rend; i++) {
    const PetscScalar *v;
    PetscInt           nc;
    PetscReal          largest = 0.0;

    PetscCall(MatGetRow(J, i, &nc, NULL, &v));
    for (PetscInt k = 0; k < nc; k++) largest = PetscMax(largest, PetscAbsScalar(v[k]));
    PetscCall(MatRestoreRow(J, i, &nc, NULL, &v));
    a[i - rstart] = largest;
    if (largest > 0.0) extreme[0] = PetscMax(extreme[0], -largest);
    extreme[1] = PetscMax(extreme[1], largest);
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, extreme, 2, MPIU_REAL, MPIU_MAX, PetscObjectComm((PetscObject)J)));
  for (PetscInt i = 0; i < rend - rstart; i++) {
    const PetscReal row = PetscRealPart(a[i]), limit = -IP_ROW_RATIO * extreme[0];

    a[i] = row > limit ? PetscMax(limit / row, IP_LEAST_SCALE) : 1.0;
  }
  PetscCall(VecRestoreArrayWrite(*d, &a));
  if (!(extreme[1] > -IP_ROW_RATIO * extreme[0])) PetscCall(VecDestroy(d));
  PetscFunctionReturn(0);
}

/* Chooses the scales of this solve from the Jacobians at the start. *scaled: whether any row is scaled. */
PetscErrorCode IPRowScaleSetUp(Tao tao, PetscBool *scaled)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  *scaled = PETSC_FALSE;
  if (ip->opt->scaling == IP_SCALING_NONE) PetscFunctionReturn(0);
  if (ip->mi) PetscCall(RowScale(ip->jac->inequality, ip->at.c, &ip->rows->inequality));
  if (ip->me) PetscCall(RowScale(ip->jac->equality, ip->at.ce, &ip->rows->equality));
  *scaled = (PetscBool)(ip->rows->inequality || ip->rows->equality);
  PetscFunctionReturn(0);
}

/* Removes the scales of the last solve. *changed: a Jacobian is still scaled by them. */
PetscErrorCode IPRowScaleReset(Tao tao, PetscBool *changed)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  *changed = (PetscBool)(ip->rows->inequality || ip->rows->equality);
  PetscCall(VecDestroy(&ip->rows->inequality));
  PetscCall(VecDestroy(&ip->rows->equality));
  PetscFunctionReturn(0);
}

/* Scales slacks s and multipliers z of the inequalities from the caller's units, or to the caller's units if `back` */
PetscErrorCode IPRowScalePair(Tao tao, Vec s, Vec z, PetscBool back)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  if (!ip->rows->inequality) PetscFunctionReturn(0);
  if (back) {
    PetscCall(VecQuotient_AMGF(s, s, ip->rows->inequality));
    PetscCall(VecPointwiseMult(z, z, ip->rows->inequality));
  } else {
    PetscCall(VecPointwiseMult(s, s, ip->rows->inequality));
    PetscCall(VecQuotient_AMGF(z, z, ip->rows->inequality));
  }
  PetscFunctionReturn(0);
}

/* Computes the largest absolute entry of a constraint residual r in the caller's units */
PetscErrorCode IPRowScaleNorm(Tao tao, IPSpace space, Vec r, PetscReal *norm)
{
  TAO_IPFILTER *ip    = (TAO_IPFILTER *)tao->data;
  Vec           scale = space == IP_INEQUALITIES ? ip->rows->inequality : ip->rows->equality, unscaled = NULL;

  PetscFunctionBegin;
  if (scale) {
    PetscCall(IPGetWork(tao, space, &unscaled));
    PetscCall(VecQuotient_AMGF(unscaled, r, scale));
  }
  PetscCall(VecNorm(scale ? unscaled : r, NORM_INFINITY, norm));
  PetscCall(IPRestoreWork(tao, space, &unscaled));
  PetscFunctionReturn(0);
}
