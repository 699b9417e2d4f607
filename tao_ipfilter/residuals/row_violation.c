/*
   Measures the violation of each constraint relative to its own present terms. Relative to the size of the constraints
   at a distant start, or to that of other rows, any violation would look small.
*/
#include "residualsimpl.h"
#include "tao_ipfilter/solver/matrices.h"
#include "tao_ipfilter/solver/options.h"
#include "tao_ipfilter/solver/relaxation.h"
#include "tao_ipfilter/solver/sizes.h"

/*
   Computes for every row i of J: sums_i = sum_j |J_ij x_j|, the magnitude of the terms that cancel if the constraint is
   satisfied, and largest_i = max_j |J_ij|. `largest` may be NULL.
*/
PetscErrorCode IPOwnTerms(Mat J, Vec x, Vec sums, Vec largest)
{
  Mat          terms;
  PetscScalar *sum, *most = NULL;
  PetscInt     rstart, rend;

  PetscFunctionBegin;
  PetscCall(MatDuplicate(J, MAT_COPY_VALUES, &terms));
  PetscCall(MatDiagonalScale(terms, NULL, x));
  PetscCall(MatGetOwnershipRange(terms, &rstart, &rend));
  PetscCall(VecGetArrayWrite(sums, &sum));
  if (largest) PetscCall(VecGetArrayWrite(largest, &most));
  for (PetscInt i = 0; i < rend - rstart; i++) {
    const PetscScalar *v;
    PetscInt           n;

    PetscCall(MatGetRow(terms, rstart + i, &n, NULL, &v));
    sum[i] = 0.0;
    for (PetscInt k = 0; k < n; k++) sum[i] += PetscAbsScalar(v[k]);
    PetscCall(MatRestoreRow(terms, rstart + i, &n, NULL, &v));
    if (!most) continue;
    PetscCall(MatGetRow(J, rstart + i, &n, NULL, &v));
    most[i] = 0.0;
    for (PetscInt k = 0; k < n; k++) most[i] = PetscMax(PetscRealPart(most[i]), PetscAbsScalar(v[k]));
    PetscCall(MatRestoreRow(J, rstart + i, &n, NULL, &v));
  }
  if (largest) PetscCall(VecRestoreArrayWrite(largest, &most));
  PetscCall(VecRestoreArrayWrite(sums, &sum));
  PetscCall(MatDestroy(&terms));
  PetscFunctionReturn(0);
}

/*
   Computes the largest violation relative to the terms of its row, namely those of the unknowns and the constant. The
   size of the terms is at least the fraction `trace` of what the largest unknown would contribute, and at least the
   rounding error of `first`, the terms at the start.
*/
static PetscErrorCode OwnLargest(Tao tao, IPSpace space, Mat J, Vec c, Vec violation, PetscReal trace, PetscReal first,
  PetscReal *own)
{
  const PetscScalar *a[5];
  Vec                v[5]  = {c, violation, NULL, NULL, NULL}; /* constraint values, violations, J x, and the results of
                                                         IPOwnTerms() */
  PetscReal          local = 0.0, xsize;
  PetscInt           n;

  PetscFunctionBegin;
  for (PetscInt k = 2; k < 5; k++) PetscCall(IPGetWork(tao, space, &v[k]));
  PetscCall(VecNorm(tao->solution, NORM_INFINITY, &xsize));
  PetscCall(MatMult(J, tao->solution, v[2]));
  PetscCall(IPOwnTerms(J, tao->solution, v[3], v[4]));
  PetscCall(VecGetLocalSize(c, &n));
  for (PetscInt k = 0; k < 5; k++) PetscCall(VecGetArrayRead(v[k], &a[k]));
  for (PetscInt i = 0; i < n; i++) {
    const PetscReal terms = PetscMax(PetscRealPart(a[3][i]), PetscAbsScalar(a[0][i] - a[2][i]));
    const PetscReal size =
      PetscMax(PetscMax(terms, trace * PetscRealPart(a[4][i]) * xsize), PETSC_MACHINE_EPSILON * first);

    if (a[1][i] != 0.0) local = PetscMax(local, size > 0.0 ? PetscAbsScalar(a[1][i]) / size : PETSC_INFINITY);
  }
  for (PetscInt k = 0; k < 5; k++) PetscCall(VecRestoreArrayRead(v[k], &a[k]));
  for (PetscInt k = 4; k >= 2; k--) PetscCall(IPRestoreWork(tao, space, &v[k]));
  PetscCallMPI(MPI_Allreduce(&local, own, 1, MPIU_REAL, MPIU_MAX, PetscObjectComm((PetscObject)tao)));
  PetscFunctionReturn(0);
}

/*
   Computes the largest violation of all constraints relative to the terms of their rows.
*/
PetscErrorCode IPOwnViolation(Tao tao, PetscReal *own)
{
  TAO_IPFILTER   *ip    = (TAO_IPFILTER *)tao->data;
  const IPFirst  *first = ip->first;
  const PetscReal trace = 1e-6, rounding = trace * PETSC_MACHINE_EPSILON,
                  rows = PetscMax(PetscMax(first->length, first->jacobian * first->x),
                    first->jacobian * ip->given->rounding / rounding);
  PetscReal other      = 0.0;
  Vec       v;

  PetscFunctionBegin;
  *own = 0.0;
  if (ip->mi) {
    PetscCall(IPGetWork(tao, IP_INEQUALITIES, &v));
    PetscCall(IPSlackYield(tao, ip->at.lambda, v));
    PetscCall(IPSlackViolation(tao, v, v));
    PetscCall(OwnLargest(tao, IP_INEQUALITIES, ip->jac->inequality, ip->at.c, v, trace, rows, own));
    PetscCall(IPRestoreWork(tao, IP_INEQUALITIES, &v));
  }
  if (ip->me)
    PetscCall(OwnLargest(tao, IP_EQUALITIES, ip->jac->equality, ip->at.ce, ip->at.ce, trace,
      PetscMax(first->equality, first->equality_jacobian * first->x), &other));
  *own = PetscMax(*own, other);
  PetscFunctionReturn(0);
}

/*
   Computes the largest term of the active inequality constraints, namely those whose slack is negligible relative to
   their terms. If none is active it is the terms of the smallest row; 0 if these vanish.
*/
PetscErrorCode IPOwnActiveSize(Tao tao, PetscReal *size)
{
  TAO_IPFILTER      *ip     = (TAO_IPFILTER *)tao->data;
  const PetscReal    active = 1e-3;
  const PetscScalar *a[4];
  Vec                v[4]     = {ip->at.c, ip->at.s, NULL, NULL}; /* constraint values, slacks, J x, and the sums of
                                                                  IPOwnTerms() */
  PetscReal          local[2] = {0.0, PETSC_NINFINITY}; /* the largest term of active rows; minus the smallest row */
  PetscInt           n;

  PetscFunctionBegin;
  for (PetscInt k = 2; k < 4; k++) PetscCall(IPGetWork(tao, IP_INEQUALITIES, &v[k]));
  PetscCall(MatMult(ip->jac->inequality, tao->solution, v[2]));
  PetscCall(IPOwnTerms(ip->jac->inequality, tao->solution, v[3], NULL));
  PetscCall(VecGetLocalSize(ip->at.c, &n));
  for (PetscInt k = 0; k < 4; k++) PetscCall(VecGetArrayRead(v[k], &a[k]));
  for (PetscInt i = 0; i < n; i++) {
    const PetscReal terms = PetscMax(PetscRealPart(a[3][i]), PetscAbsScalar(a[0][i] - a[2][i]));

    if (PetscRealPart(a[1][i]) <= active * terms) local[0] = PetscMax(local[0], terms);
    local[1] = PetscMax(local[1], -terms);
  }
  for (PetscInt k = 0; k < 4; k++) PetscCall(VecRestoreArrayRead(v[k], &a[k]));
  for (PetscInt k = 3; k >= 2; k--) PetscCall(IPRestoreWork(tao, IP_INEQUALITIES, &v[k]));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, local, 2, MPIU_REAL, MPIU_MAX, PetscObjectComm((PetscObject)tao)));
  *size = local[0] > 0.0 ? local[0] : (local[1] > PETSC_NINFINITY ? -local[1] : 0.0);
  PetscFunctionReturn(0);
}
