/* Finds stiff rows of the operator by their diagonal entries, and measures the contrast between stiff and soft rows */
#include "amgfimpl.h"

/* Returns whether the diagonal entry d is positive and finite */
static PetscBool DetectCounts(PetscScalar d)
{
  return (PetscBool)(PetscRealPart(d) > 0.0 && PetscRealPart(d) <= PETSC_MAX_REAL);
}

/*
   Computes the median of the positive finite diagonal entries of all ranks with a relative error of 0.1 %, by bisection
   on their logarithms. Only integer counts are summed over the ranks, so the result does not depend on the partition.
   If no entry is positive and finite, *median is PETSC_MAX_REAL.
*/
static PetscErrorCode DetectMedian(MPI_Comm comm, PetscInt n, const PetscScalar d[], PetscReal *median)
{
  PetscReal range[2] = {PETSC_MIN_REAL, PETSC_MIN_REAL}; /* -log of the smallest entry; log of the largest */
  PetscInt  count    = 0;

  PetscFunctionBegin;
  for (PetscInt i = 0; i < n; i++) {
    if (!DetectCounts(d[i])) continue;
    range[0] = PetscMax(range[0], -PetscLogReal(PetscRealPart(d[i])));
    range[1] = PetscMax(range[1], PetscLogReal(PetscRealPart(d[i])));
    count++;
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, range, 2, MPIU_REAL, MPIU_MAX, comm));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &count, 1, MPIU_INT, MPI_SUM, comm));
  PetscReal low = -range[0], high = range[1];
  while (count && high - low > 1e-3) {
    const PetscReal middle = 0.5 * (low + high), value = PetscExpReal(middle);
    PetscInt        below = 0;

    for (PetscInt i = 0; i < n; i++) below += (DetectCounts(d[i]) && PetscRealPart(d[i]) <= value);
    PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &below, 1, MPIU_INT, MPI_SUM, comm));
    if (below >= count - count / 2) high = middle;
    else low = middle;
  }
  *median = count ? PetscExpReal(high) : PETSC_MAX_REAL;
  PetscFunctionReturn(0);
}

/*
   PCAMGFDetectRows_Private - finds the owned rows of A whose diagonal entry exceeds `ratio` times the median of the
   positive diagonal entries
*/
PetscErrorCode PCAMGFDetectRows_Private(Mat A, PetscReal ratio, IS *rows)
{
  MPI_Comm           comm;
  Vec                diagonal;
  PetscInt           n, start, k = 0, *idx;
  PetscReal          median;
  const PetscScalar *d;

  PetscFunctionBegin;
  PetscCall(PetscObjectGetComm((PetscObject)A, &comm));
  PetscCall(MatCreateVecs(A, &diagonal, NULL));
  PetscCall(MatGetDiagonal(A, diagonal));
  PetscCall(VecGetLocalSize(diagonal, &n));
  PetscCall(VecGetOwnershipRange(diagonal, &start, NULL));
  PetscCall(VecGetArrayRead(diagonal, &d));
  PetscCall(DetectMedian(comm, n, d, &median));
  PetscCall(PetscMalloc1(n, &idx));
  for (PetscInt i = 0; i < n; i++) {
    if (PetscRealPart(d[i]) > ratio * median) idx[k++] = start + i;
  }
  PetscCall(VecRestoreArrayRead(diagonal, &d));
  PetscCall(VecDestroy(&diagonal));
  PetscCall(ISCreateGeneral(comm, k, idx, PETSC_COPY_VALUES, rows));
  PetscCall(PetscFree(idx));
  PetscFunctionReturn(0);
}

/*
   Computes coupling = A x - D x, where D is the diagonal of A and x a vector of irregular nonzero entries. The result
   is exactly zero in rows without off-diagonal entries, such as those of prescribed values.
*/
static PetscErrorCode ContrastFindCoupling(Mat A, Vec diagonal, Vec *coupling)
{
  Vec          x;
  PetscInt     start, end;
  PetscScalar *entries;

  PetscFunctionBegin;
  PetscCall(MatCreateVecs(A, &x, coupling));
  PetscCall(VecGetOwnershipRange(x, &start, &end));
  PetscCall(VecGetArrayWrite(x, &entries));
  for (PetscInt i = start; i < end; i++) {
    const PetscReal multiple = PETSC_PHI * (PetscReal)i;

    entries[i - start] = 1.0 + multiple - PetscFloorReal(multiple);
  }
  PetscCall(VecRestoreArrayWrite(x, &entries));
  PetscCall(MatMult(A, x, *coupling));
  PetscCall(VecPointwiseMult(x, x, diagonal));
  PetscCall(VecAXPY(*coupling, -1.0, x));
  PetscCall(VecDestroy(&x));
  PetscFunctionReturn(0);
}

/*
   Computes the largest positive diagonal entry (range[0]) and the largest inverse of one (range[1]) on this rank. Rows
   with coupling = 0 are left out. coupling: see ContrastFindCoupling(), or NULL.
*/
static PetscErrorCode ContrastFindRange(Vec diagonal, Vec coupling, PetscReal range[2])
{
  PetscInt           n;
  const PetscScalar *d, *c = NULL;

  PetscFunctionBegin;
  range[0] = range[1] = 0.0;
  PetscCall(VecGetLocalSize(diagonal, &n));
  PetscCall(VecGetArrayRead(diagonal, &d));
  if (coupling) PetscCall(VecGetArrayRead(coupling, &c));
  for (PetscInt i = 0; i < n; i++) {
    const PetscReal entry = PetscRealPart(d[i]);

    if (!(entry > 0.0) || (c && c[i] == 0.0)) continue;
    range[0] = PetscMax(range[0], entry);
    range[1] = PetscMax(range[1], 1.0 / entry);
  }
  if (coupling) PetscCall(VecRestoreArrayRead(coupling, &c));
  PetscCall(VecRestoreArrayRead(diagonal, &d));
  PetscFunctionReturn(0);
}

/*
   PCAMGFFindContrast_Private - computes the ratio of the largest to the smallest positive diagonal entry

   Input Parameters:
   + A       - the operator
   - coupled - whether rows without off-diagonal entries are left out, which costs one product with the operator
*/
PetscErrorCode PCAMGFFindContrast_Private(Mat A, PetscBool coupled, PetscReal *contrast)
{
  Vec       diagonal, coupling = NULL;
  PetscReal range[2];

  PetscFunctionBegin;
  PetscCall(MatCreateVecs(A, &diagonal, NULL));
  PetscCall(MatGetDiagonal(A, diagonal));
  if (coupled) PetscCall(ContrastFindCoupling(A, diagonal, &coupling));
  PetscCall(ContrastFindRange(diagonal, coupling, range));
  PetscCall(VecDestroy(&coupling));
  PetscCall(VecDestroy(&diagonal));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, range, 2, MPIU_REAL, MPIU_MAX, PetscObjectComm((PetscObject)A)));
  *contrast = range[0] * range[1];
  PetscFunctionReturn(0);
}
