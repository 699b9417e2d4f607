/* Extracts a few rows of a large symmetric matrix of any format as an AIJ matrix */
#include "amgfimpl.h"
#include <petsc/private/hashmapi.h>

/* Inserts rows of A into R. Only for formats that store full rows: AIJ and BAIJ. */
static PetscErrorCode RowsInsertFull(Mat A, PetscInt n, const PetscInt rows[], Mat R)
{
  PetscInt first;

  PetscFunctionBegin;
  PetscCall(MatGetOwnershipRange(R, &first, NULL));
  for (PetscInt k = 0; k < n; k++) {
    PetscInt           ncols, row = first + k;
    const PetscInt    *cols;
    const PetscScalar *vals;

    PetscCall(MatGetRow(A, rows[k], &ncols, &cols, &vals));
    PetscCall(MatSetValues(R, 1, &row, ncols, cols, vals, INSERT_VALUES));
    PetscCall(MatRestoreRow(A, rows[k], &ncols, &cols, &vals));
  }
  PetscFunctionReturn(0);
}

/* Creates a map, on every rank, from a row of A to the row of R that holds it, for all requested rows */
static PetscErrorCode RowsCreateMap(IS rows, PetscHMapI *map)
{
  IS              all;
  PetscInt        n;
  const PetscInt *idx;

  PetscFunctionBegin;
  PetscCall(PetscHMapICreate(map));
  PetscCall(ISAllGather(rows, &all));
  PetscCall(ISGetLocalSize(all, &n));
  PetscCall(ISGetIndices(all, &idx));
  for (PetscInt k = 0; k < n; k++) PetscCall(PetscHMapISet(*map, idx[k], k));
  PetscCall(ISRestoreIndices(all, &idx));
  PetscCall(ISDestroy(&all));
  PetscFunctionReturn(0);
}

/*
   Inserts rows of an SBAIJ matrix into R. SBAIJ stores the upper triangle only, so that the part of a requested row
   left of the diagonal is spread over the rows above. Every row is therefore visited. Let k(i) be the row of R that
   holds row i of A. An entry (i,j) with i <= j becomes the entries (k(i),j) and (k(j),i), as far as k(i) and k(j)
   exist.
*/
static PetscErrorCode RowsInsertUpperTriangle(Mat A, IS rows, Mat R)
{
  PetscHMapI map;
  PetscInt   start, end;

  PetscFunctionBegin;
  PetscCall(RowsCreateMap(rows, &map));
  PetscCall(MatGetOwnershipRange(A, &start, &end));
  PetscCall(MatGetRowUpperTriangular(A));
  for (PetscInt i = start; i < end; i++) {
    PetscInt           ncols, ki, kj;
    const PetscInt    *cols;
    const PetscScalar *vals;

    PetscCall(PetscHMapIGet(map, i, &ki));
    PetscCall(MatGetRow(A, i, &ncols, &cols, &vals));
    for (PetscInt c = 0; c < ncols; c++) {
      if (cols[c] < i) continue; /* entries below the diagonal inside a diagonal block are repetitions */
      if (ki >= 0) PetscCall(MatSetValue(R, ki, cols[c], vals[c], INSERT_VALUES));
      if (cols[c] == i) continue;
      PetscCall(PetscHMapIGet(map, cols[c], &kj));
      if (kj >= 0) PetscCall(MatSetValue(R, kj, i, vals[c], INSERT_VALUES));
    }
    PetscCall(MatRestoreRow(A, i, &ncols, &cols, &vals));
  }
  PetscCall(MatRestoreRowUpperTriangular(A));
  PetscCall(PetscHMapIDestroy(&map));
  PetscFunctionReturn(0);
}

static PetscErrorCode RowsInsert(Mat A, IS rows, Mat R)
{
  PetscBool upper;

  PetscFunctionBegin;
  PetscCall(PetscObjectTypeCompareAny((PetscObject)A, &upper, MATSEQSBAIJ, MATMPISBAIJ, MATSBAIJ, ""));
  if (upper) {
    PetscCheck(!PetscDefined(USE_COMPLEX), PetscObjectComm((PetscObject)A), PETSC_ERR_SUP,
      "SBAIJ matrices are not supported with complex scalars: use AIJ or BAIJ");
    PetscCall(RowsInsertUpperTriangle(A, rows, R));
  } else {
    PetscInt        n;
    const PetscInt *idx;

    PetscCall(ISGetLocalSize(rows, &n));
    PetscCall(ISGetIndices(rows, &idx));
    PetscCall(RowsInsertFull(A, n, idx, R));
    PetscCall(ISRestoreIndices(rows, &idx));
  }
  PetscCall(MatAssemblyBegin(R, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(R, MAT_FINAL_ASSEMBLY));
  PetscFunctionReturn(0);
}

/* Creates an AIJ matrix with exactly the nonzero pattern of the requested rows */
static PetscErrorCode RowsCreateMatrix(Mat A, IS rows, Mat *R)
{
  MPI_Comm comm;
  Mat      pattern;
  PetscInt m, n, N;

  PetscFunctionBegin;
  PetscCall(PetscObjectGetComm((PetscObject)A, &comm));
  PetscCall(ISGetLocalSize(rows, &m));
  PetscCall(MatGetLocalSize(A, NULL, &n));
  PetscCall(MatGetSize(A, NULL, &N));
  PetscCall(MatCreate(comm, &pattern));
  PetscCall(MatSetSizes(pattern, m, n, PETSC_DETERMINE, N));
  PetscCall(MatSetType(pattern, MATPREALLOCATOR));
  PetscCall(MatSetUp(pattern));
  PetscCall(RowsInsert(A, rows, pattern));
  PetscCall(MatCreate(comm, R));
  PetscCall(MatSetSizes(*R, m, n, PETSC_DETERMINE, N));
  PetscCall(MatSetType(*R, MATAIJ));
  PetscCall(MatPreallocatorPreallocate(pattern, PETSC_TRUE, *R));
  PetscCall(MatSetOption(*R, MAT_NEW_NONZERO_LOCATION_ERR, PETSC_TRUE));
  PetscCall(MatDestroy(&pattern));
  PetscFunctionReturn(0);
}

/*
   MatGetThinRows_AMGF - extracts rows of a symmetric matrix

   Input Parameters:
   + A     - symmetric matrix (n x n) of any format with MatGetRow()
   . rows  - rows of A, each on the rank that owns it, sorted, without repetition
   - reuse - *R was created by this function from the same rows and the same nonzero pattern: only its values are
   replaced

   Output Parameter:
   . R - AIJ matrix; row k is the k-th requested row, columns are those of A

   Note:
   MatCreateSubMatrix() would be sufficient for AIJ. For BAIJ and SBAIJ it accepts whole blocks only.
*/
PetscErrorCode MatGetThinRows_AMGF(Mat A, IS rows, PetscBool reuse, Mat *R)
{
  PetscBool has;

  PetscFunctionBegin;
  PetscCall(MatHasOperation(A, MATOP_GET_ROW, &has));
  PetscCheck(has, PetscObjectComm((PetscObject)A), PETSC_ERR_SUP,
    "PCAMGF needs an assembled operator (AIJ, BAIJ or SBAIJ), not one of type %s", ((PetscObject)A)->type_name);
  if (!reuse) PetscCall(RowsCreateMatrix(A, rows, R));
  PetscCall(RowsInsert(A, rows, *R));
  PetscFunctionReturn(0);
}
