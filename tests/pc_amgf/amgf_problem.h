/*
   Model problem of the PCAMGF tests: K = Laplacian on a square grid of nodes, Dirichlet outside, times an SPD block
   C; A = K + J^T D J, where J ties the lower to the upper edge of the grid and D spans many orders. The stiff
   subspace is that of J's nonzero columns.
*/
#ifndef AMGF_PROBLEM_H
#define AMGF_PROBLEM_H

#include <petscamgf.h>

typedef struct {
  PetscInt  n;               /* nodes a side */
  PetscInt  bs;              /* unknowns a node: 1 or 3 */
  PetscReal ax, ay;          /* stiffness along and across the tied edges */
  PetscReal lowest, highest; /* exponents of D, base 10 */
} Problem;

static inline PetscErrorCode ProblemSetDefaults(Problem *p)
{
  PetscFunctionBeginUser;
  p->n       = 12;
  p->bs      = 3;
  p->ax      = 1.0;
  p->ay      = 1.0;
  p->lowest  = 0.0;
  p->highest = 6.0;
  PetscFunctionReturn(0);
}

/* Unknowns and coefficients of row k of J; every second node of the edges is tied */
static inline PetscInt ConstraintRow(const Problem *p, PetscInt k, PetscInt cols[3], PetscScalar vals[3])
{
  const PetscInt lower = 2 * k * p->bs, upper = (p->n * (p->n - 1) + 2 * k) * p->bs;

  cols[0] = lower;
  vals[0] = 1.0;
  cols[1] = upper;
  vals[1] = -1.0;
  cols[2] = upper + 1;
  vals[2] = 0.5;
  return p->bs == 1 ? 2 : 3;
}

static inline PetscInt NumConstraints(const Problem *p)
{
  return (p->n + 1) / 2;
}

/* The blocks of K owned by this rank */
static inline PetscErrorCode AddStiffness(const Problem *p, Mat A)
{
  const PetscScalar C3[9] = {2.0, 0.5, 0.3, 0.5, 2.0, 0.4, 0.3, 0.4, 2.0}, C1[1] = {2.0};
  const PetscInt    steps[5] = {0, -1, 1, -p->n, p->n};
  PetscInt          start, end;

  PetscFunctionBeginUser;
  PetscCall(MatGetOwnershipRange(A, &start, &end));
  for (PetscInt node = start / p->bs; node < end / p->bs; node++) {
    for (PetscInt s = 0; s < 5; s++) {
      const PetscInt other = node + steps[s];
      PetscScalar    block[9];

      if (other < 0 || other >= p->n * p->n || (PetscAbsInt(steps[s]) == 1 && other / p->n != node / p->n)) continue;
      for (PetscInt i = 0; i < p->bs * p->bs; i++)
        block[i] = (p->bs == 3 ? C3[i] : C1[0]) * (s == 0 ? 2.0 * (p->ax + p->ay) : s < 3 ? -p->ax : -p->ay);
      PetscCall(MatSetValuesBlocked(A, 1, &node, 1, &other, block, ADD_VALUES));
    }
  }
  PetscFunctionReturn(0);
}

/* J^T D J by the rank that owns the first column of the row */
static inline PetscErrorCode AddPenalty(const Problem *p, Mat A)
{
  const PetscInt m = NumConstraints(p);
  PetscInt       start, end;

  PetscFunctionBeginUser;
  PetscCall(MatGetOwnershipRange(A, &start, &end));
  for (PetscInt k = 0; k < m; k++) {
    PetscInt        cols[3];
    PetscScalar     vals[3], outer[9];
    const PetscInt  ncols = ConstraintRow(p, k, cols, vals);
    const PetscReal d     = PetscPowReal(10.0, p->lowest + (p->highest - p->lowest) * k / (m - 1));

    if (cols[0] < start || cols[0] >= end) continue;
    for (PetscInt i = 0; i < ncols; i++) {
      for (PetscInt j = 0; j < ncols; j++) outer[i * ncols + j] = d * vals[i] * vals[j];
    }
    PetscCall(MatSetValues(A, ncols, cols, ncols, cols, outer, ADD_VALUES));
  }
  PetscFunctionReturn(0);
}

static inline PetscErrorCode ProblemFill(const Problem *p, PetscBool penalty, Mat A)
{
  PetscFunctionBeginUser;
  PetscCall(MatZeroEntries(A));
  PetscCall(AddStiffness(p, A));
  if (penalty) PetscCall(AddPenalty(p, A));
  PetscCall(MatAssemblyBegin(A, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(A, MAT_FINAL_ASSEMBLY));
  PetscFunctionReturn(0);
}

/* The node blocks are distributed so that, with more ranks than one, some own no stiff unknown */
static inline PetscErrorCode ProblemCreate(MPI_Comm comm, const Problem *p, MatType type, PetscBool penalty, Mat *A)
{
  PetscInt  nodes = PETSC_DECIDE, N = p->n * p->n, *most;
  PetscBool sbaij;

  PetscFunctionBeginUser;
  PetscCall(PetscSplitOwnership(comm, &nodes, &N));
  PetscCall(MatCreate(comm, A));
  PetscCall(MatSetSizes(*A, nodes * p->bs, nodes * p->bs, PETSC_DETERMINE, PETSC_DETERMINE));
  PetscCall(MatSetBlockSize(*A, p->bs));
  PetscCall(MatSetType(*A, type));
  PetscCall(PetscMalloc1(nodes, &most));
  for (PetscInt i = 0; i < nodes; i++) most[i] = 6;
  PetscCall(MatXAIJSetPreallocation(*A, p->bs, most, most, most, most));
  PetscCall(PetscFree(most));
  PetscCall(PetscObjectTypeCompareAny((PetscObject)*A, &sbaij, MATSEQSBAIJ, MATMPISBAIJ, ""));
  if (sbaij) PetscCall(MatSetOption(*A, MAT_IGNORE_LOWER_TRIANGULAR, PETSC_TRUE));
  PetscCall(MatSetOption(*A, MAT_NEW_NONZERO_ALLOCATION_ERR, PETSC_FALSE));
  PetscCall(ProblemFill(p, penalty, *A));
  PetscFunctionReturn(0);
}

/* The stiff unknowns, sorted; each on the rank that owns it, or all of them on every rank with PETSC_COMM_SELF */
static inline PetscErrorCode ProblemCreateFilterIS(const Problem *p, Mat A, MPI_Comm comm, IS *is)
{
  PetscInt    start, end, n = 0, idx[1024];
  PetscMPIInt size;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_size(comm, &size));
  PetscCall(MatGetOwnershipRange(A, &start, &end));
  for (PetscInt k = 0; k < NumConstraints(p); k++) {
    PetscInt       cols[3];
    PetscScalar    vals[3];
    const PetscInt ncols = ConstraintRow(p, k, cols, vals);

    for (PetscInt j = 0; j < ncols; j++) {
      if ((cols[j] >= start && cols[j] < end) || size == 1) idx[n++] = cols[j];
    }
  }
  PetscCall(PetscSortInt(n, idx));
  PetscCall(ISCreateGeneral(comm, n, idx, PETSC_COPY_VALUES, is));
  PetscFunctionReturn(0);
}

/* P = the columns of the identity named by is; with weight != 0, a fraction of each column's row is also put into the
   row after it */
static inline PetscErrorCode ProblemCreateInterpolation(Mat A, IS is, PetscScalar weight, Mat *P)
{
  PetscInt        n, nloc, N, first;
  const PetscInt *idx;

  PetscFunctionBeginUser;
  PetscCall(ISGetLocalSize(is, &n));
  PetscCall(MatGetLocalSize(A, &nloc, NULL));
  PetscCall(MatGetSize(A, &N, NULL));
  PetscCall(MatCreate(PetscObjectComm((PetscObject)A), P));
  PetscCall(MatSetSizes(*P, nloc, n, PETSC_DETERMINE, PETSC_DETERMINE));
  PetscCall(MatSetType(*P, MATAIJ));
  PetscCall(MatSeqAIJSetPreallocation(*P, 2, NULL));
  PetscCall(MatMPIAIJSetPreallocation(*P, 2, NULL, 2, NULL));
  PetscCall(MatGetOwnershipRangeColumn(*P, &first, NULL));
  PetscCall(ISGetIndices(is, &idx));
  for (PetscInt k = 0; k < n; k++) {
    PetscCall(MatSetValue(*P, idx[k], first + k, 1.0, ADD_VALUES));
    if (weight != 0.0) PetscCall(MatSetValue(*P, (idx[k] + 1) % N, first + k, weight, ADD_VALUES));
  }
  PetscCall(ISRestoreIndices(is, &idx));
  PetscCall(MatAssemblyBegin(*P, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(*P, MAT_FINAL_ASSEMBLY));
  PetscFunctionReturn(0);
}

/* A vector that depends on the row number alone, not on the number of ranks */
static inline PetscErrorCode FillVector(Vec x, PetscReal seed)
{
  PetscInt start, end;

  PetscFunctionBeginUser;
  PetscCall(VecGetOwnershipRange(x, &start, &end));
  for (PetscInt i = start; i < end; i++)
    PetscCall(VecSetValue(x, i, PetscSinReal(seed + 12.9898 * i) + 0.3 * PetscCosReal(seed * i), INSERT_VALUES));
  PetscCall(VecAssemblyBegin(x));
  PetscCall(VecAssemblyEnd(x));
  PetscFunctionReturn(0);
}

static inline PetscErrorCode RelativeDifference(Vec x, Vec y, PetscReal *difference)
{
  Vec       d;
  PetscReal norm;

  PetscFunctionBeginUser;
  PetscCall(VecDuplicate(x, &d));
  PetscCall(VecWAXPY(d, -1.0, x, y));
  PetscCall(VecNorm(d, NORM_2, difference));
  PetscCall(VecNorm(y, NORM_2, &norm));
  *difference /= norm;
  PetscCall(VecDestroy(&d));
  PetscFunctionReturn(0);
}

/* CG with PCAMGF; P: the matrix of the preconditioner */
static inline PetscErrorCode ProblemCreateSolver(Mat A, Mat P, KSP *ksp, PC *pc)
{
  PetscFunctionBeginUser;
  PetscCall(KSPCreate(PetscObjectComm((PetscObject)P), ksp));
  PetscCall(KSPSetType(*ksp, KSPCG));
  PetscCall(KSPSetOperators(*ksp, A, P));
  PetscCall(KSPGetPC(*ksp, pc));
  PetscCall(PCSetType(*pc, PCAMGF));
  PetscFunctionReturn(0);
}

/* |b - A x| / |b| */
static inline PetscErrorCode ProblemResidual(Mat A, Vec b, Vec x, PetscReal *residual)
{
  Vec product;

  PetscFunctionBeginUser;
  PetscCall(VecDuplicate(b, &product));
  PetscCall(MatMult(A, x, product));
  PetscCall(RelativeDifference(product, b, residual));
  PetscCall(VecDestroy(&product));
  PetscFunctionReturn(0);
}

/* One line of expected output: passes, or says by how much it does not */
static inline PetscErrorCode ReportBound(MPI_Comm comm, const char what[], PetscReal value, PetscReal bound)
{
  PetscFunctionBeginUser;
  if (value <= bound) PetscCall(PetscPrintf(comm, "%s: ok\n", what));
  else PetscCall(PetscPrintf(comm, "%s: %g exceeds %g\n", what, (double)value, (double)bound));
  PetscFunctionReturn(0);
}

#endif
