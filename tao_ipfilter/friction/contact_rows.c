/* The rows R of contacts: three for each, from those of constraints and of norm terms */
#include "subspace_bodies.h"

/* Copies a row of J or T to row 3 i + a of R, or counts its entries */
static PetscErrorCode BodiesCopyRow(Mat from, PetscInt row, Mat R, PetscInt to, PetscInt *count)
{
  const PetscInt    *columns;
  const PetscScalar *values;
  PetscInt           n;

  PetscFunctionBegin;
  PetscCall(MatGetRow(from, row, &n, &columns, &values));
  *count = n;
  if (R) PetscCall(MatSetValues(R, 1, &to, n, columns, values, INSERT_VALUES));
  PetscCall(MatRestoreRow(from, row, &n, &columns, &values));
  PetscFunctionReturn(0);
}

/*
   Creates a matrix with m rows on this rank, which are rows of two matrices with the same columns. source[i]: number of
   row i among the rows of `first` on this rank, then those of `second`; negative: the row is empty
*/
static PetscErrorCode BodiesCombineRows(Mat first, Mat second, PetscInt m, const PetscInt source[], Mat *combined)
{
  PetscInt nfirst, columns, start[2], to = 0, *counts;

  PetscFunctionBegin;
  PetscCall(MatGetLocalSize(first, &nfirst, &columns));
  PetscCall(MatGetOwnershipRange(first, &start[0], NULL));
  PetscCall(MatGetOwnershipRange(second, &start[1], NULL));
  PetscCall(PetscCalloc1(m, &counts));
  *combined = NULL;
  for (PetscInt pass = 0; pass < 2; pass++) {
    if (pass) {
      PetscCall(IPMatrixCreate(PetscObjectComm((PetscObject)first), m, columns, counts, combined));
      PetscCall(MatGetOwnershipRange(*combined, &to, NULL));
    }
    for (PetscInt i = 0; i < m; i++) {
      const PetscBool in_first = (PetscBool)(source[i] < nfirst);
      const PetscInt  row      = in_first ? start[0] + source[i] : start[1] + source[i] - nfirst;

      if (source[i] >= 0) PetscCall(BodiesCopyRow(in_first ? first : second, row, *combined, to + i, &counts[i]));
    }
  }
  PetscCall(MatAssemblyBegin(*combined, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(*combined, MAT_FINAL_ASSEMBLY));
  PetscCall(PetscFree(counts));
  PetscFunctionReturn(0);
}

/* Creates R from the rows of constraints J and of norm terms T. n: number of contacts on this rank */
PetscErrorCode BodiesCreateRows(Mat J, Mat T, PetscInt n, Mat *R)
{
  PetscInt mJ, mT, *source;

  PetscFunctionBegin;
  PetscCall(MatGetLocalSize(J, &mJ, NULL));
  PetscCall(MatGetLocalSize(T, &mT, NULL));
  PetscCall(PetscMalloc1(3 * n, &source));
  for (PetscInt i = 0; i < n; i++) {
    source[3 * i] = i < mJ ? i : -1;
    for (PetscInt a = 0; a < 2; a++) source[3 * i + 1 + a] = 2 * i < mT ? mJ + 2 * i + a : -1;
  }
  PetscCall(BodiesCombineRows(J, T, 3 * n, source, R));
  PetscCall(PetscFree(source));
  PetscFunctionReturn(0);
}
