/*
   Scaling of the constraints by their gradients at the start: a row d_i c_i, with d_i so small that its gradient is at most
   row_ratio times the smallest one. Rows of like size stay as they are, whatever the units. All of the iteration sees the
   scaled rows; multipliers and slacks are scaled back on return.
*/
#include "ipfilterimpl.h"

#define IP_LEAST_SCALE 1e-20

/* d = NULL where no row is larger than ratio times the smallest nonzero one */
static PetscErrorCode RowScale(Mat J, Vec layout, PetscReal ratio, Vec *d)
{
  PetscScalar *a;
  PetscInt     rstart, rend;
  PetscReal    extreme[2] = {PETSC_NINFINITY, PETSC_NINFINITY}; /* -smallest and largest row, over all ranks */

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
    const PetscReal row = PetscRealPart(a[i]), most = -ratio * extreme[0];

    a[i] = row > most ? PetscMax(most / row, IP_LEAST_SCALE) : 1.0;
  }
  PetscCall(VecRestoreArrayWrite(*d, &a));
  if (!(extreme[1] > -ratio * extreme[0])) PetscCall(VecDestroy(d));
  PetscFunctionReturn(0);
}

/* Chooses the scales of this solve from the Jacobians just evaluated; tells whether there are any */
PetscErrorCode IPScalingSetUp(Tao tao, PetscBool *scaled)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  *scaled = PETSC_FALSE;
  if (ip->scaling == IP_SCALING_NONE || ip->row_ratio <= 0.0) PetscFunctionReturn(0);
  if (ip->mi) PetscCall(RowScale(ip->cond.J, ip->c, ip->row_ratio, &ip->cscale));
  if (ip->me) PetscCall(RowScale(ip->JE, ip->ce, ip->row_ratio, &ip->cescale));
  *scaled = (PetscBool)(ip->cscale || ip->cescale);
  PetscFunctionReturn(0);
}

/* Forgets the scales of the last solve, and what was condensed with them */
PetscErrorCode IPScalingReset(Tao tao)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  if (ip->cscale) PetscCall(IPCondensedDestroy(&ip->cond));
  PetscCall(VecDestroy(&ip->cscale));
  PetscCall(VecDestroy(&ip->cescale));
  PetscFunctionReturn(0);
}

/* The Jacobian with rows scaled and the columns of fixed variables zeroed: a copy, or the Jacobian itself where nothing is to be done */
PetscErrorCode IPScalingJacobian(Tao tao, Mat J, Vec scale, Mat *scaled)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  if (!scale && !ip->fixed) {
    PetscCall(PetscObjectReference((PetscObject)J));
    *scaled = J;
    PetscFunctionReturn(0);
  }
  PetscCall(MatDuplicate(J, MAT_COPY_VALUES, scaled));
  PetscCall(VecSet(ip->xwork, 1.0));
  PetscCall(IPFixedZero(tao, ip->xwork));
  PetscCall(MatDiagonalScale(*scaled, scale, ip->xwork));
  PetscFunctionReturn(0);
}

/* Slacks and multipliers of a pair of the inequalities from the caller's units, or back to them */
PetscErrorCode IPScalingPair(Tao tao, Vec s, Vec z, PetscBool back)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  if (!ip->cscale) PetscFunctionReturn(0);
  if (back) {
    PetscCall(VecPointwiseDivide(s, s, ip->cscale));
    PetscCall(VecPointwiseMult(z, z, ip->cscale));
  } else {
    PetscCall(VecPointwiseMult(s, s, ip->cscale));
    PetscCall(VecPointwiseDivide(z, z, ip->cscale));
  }
  PetscFunctionReturn(0);
}

/* Largest entry of a residual in the caller's units */
PetscErrorCode IPScalingNorm(Vec r, Vec scale, Vec work, PetscReal *norm)
{
  PetscFunctionBegin;
  if (scale) {
    PetscCall(VecPointwiseDivide(work, r, scale));
    r = work;
  }
  PetscCall(VecNorm(r, NORM_INFINITY, norm));
  PetscFunctionReturn(0);
}
