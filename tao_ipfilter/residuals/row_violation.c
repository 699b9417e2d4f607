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
   Returns the size of the rounding errors of a constraint: those of its value and, as large, those of the step that was
   to make it zero
*/
PetscReal IPConstraintRounding(const TAO_IPFILTER *ip)
{
  return 2.0 * ip->first->jacobian * ip->given->rounding;
}

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

/* Computes the size of the terms of each row of c = J x + constant: the larger one of the constant and the sum of
   IPOwnTerms(). largest: as there */
static PetscErrorCode OwnRowSizes(Tao tao, IPSpace space, Mat J, Vec c, Vec sizes, Vec largest)
{
  Vec constant;

  PetscFunctionBegin;
  PetscCall(IPGetWork(tao, space, &constant));
  PetscCall(MatMult(J, tao->solution, constant));
  PetscCall(VecAYPX(constant, -1.0, c));
  PetscCall(VecAbs(constant));
  PetscCall(IPOwnTerms(J, tao->solution, sizes, largest));
  PetscCall(VecPointwiseMax(sizes, sizes, constant));
  PetscCall(IPRestoreWork(tao, space, &constant));
  PetscFunctionReturn(0);
}

/*
   Computes the largest violation relative to the terms of its row. The size of the terms is at least the fraction
   `trace` of what the largest unknown would contribute, and at least the rounding error of `first`, the terms at the
   start.
*/
static PetscErrorCode OwnLargest(Tao tao, IPSpace space, Mat J, Vec c, Vec violation, PetscReal trace, PetscReal first,
  PetscReal *own)
{
  const PetscScalar *v, *t, *most;
  PetscReal          local = 0.0, xsize;
  PetscInt           n;
  Vec                terms, largest;

  PetscFunctionBegin;
  PetscCall(IPGetWork(tao, space, &terms));
  PetscCall(IPGetWork(tao, space, &largest));
  PetscCall(OwnRowSizes(tao, space, J, c, terms, largest));
  PetscCall(VecNorm(tao->solution, NORM_INFINITY, &xsize));
  PetscCall(VecGetLocalSize(c, &n));
  PetscCall(VecGetArrayRead(violation, &v));
  PetscCall(VecGetArrayRead(terms, &t));
  PetscCall(VecGetArrayRead(largest, &most));
  for (PetscInt i = 0; i < n; i++) {
    const PetscReal size =
      PetscMax(PetscMax(PetscRealPart(t[i]), trace * PetscRealPart(most[i]) * xsize), PETSC_MACHINE_EPSILON * first);

    if (v[i] != 0.0) local = PetscMax(local, size > 0.0 ? PetscAbsScalar(v[i]) / size : PETSC_INFINITY);
  }
  PetscCall(VecRestoreArrayRead(largest, &most));
  PetscCall(VecRestoreArrayRead(terms, &t));
  PetscCall(VecRestoreArrayRead(violation, &v));
  PetscCall(IPRestoreWork(tao, space, &largest));
  PetscCall(IPRestoreWork(tao, space, &terms));
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
  const PetscReal trace = 1e-6, rows = PetscMax(PetscMax(first->length, first->jacobian * first->x),
                                  IPConstraintRounding(ip) / (ip->tol * PETSC_MACHINE_EPSILON));
  PetscReal       other = 0.0;
  Vec             v;

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
  const PetscScalar *s, *t;
  PetscReal          local[2] = {0.0, PETSC_NINFINITY}; /* the largest term of active rows; minus the smallest row */
  PetscInt           n;
  Vec                terms;

  PetscFunctionBegin;
  PetscCall(IPGetWork(tao, IP_INEQUALITIES, &terms));
  PetscCall(OwnRowSizes(tao, IP_INEQUALITIES, ip->jac->inequality, ip->at.c, terms, NULL));
  PetscCall(VecGetLocalSize(terms, &n));
  PetscCall(VecGetArrayRead(ip->at.s, &s));
  PetscCall(VecGetArrayRead(terms, &t));
  for (PetscInt i = 0; i < n; i++) {
    if (PetscRealPart(s[i]) <= active * PetscRealPart(t[i])) local[0] = PetscMax(local[0], PetscRealPart(t[i]));
    local[1] = PetscMax(local[1], -PetscRealPart(t[i]));
  }
  PetscCall(VecRestoreArrayRead(terms, &t));
  PetscCall(VecRestoreArrayRead(ip->at.s, &s));
  PetscCall(IPRestoreWork(tao, IP_INEQUALITIES, &terms));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, local, 2, MPIU_REAL, MPIU_MAX, PetscObjectComm((PetscObject)tao)));
  *size = local[0] > 0.0 ? local[0] : (local[1] > PETSC_NINFINITY ? -local[1] : 0.0);
  PetscFunctionReturn(0);
}
