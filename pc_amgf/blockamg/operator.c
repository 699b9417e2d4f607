/*
   Converts the operator to hypre's format without entries that are zero up to rounding. On uniform meshes two fifths of
   the entries of a stiffness matrix are such: sums that cancel.
*/
#include "blockamgimpl.h"

/* Creates the square roots of the absolute diagonal entries */
static PetscErrorCode OperatorGetRoots(const BlockRows *rows, PetscReal **root)
{
  PetscFunctionBegin;
  PetscCall(PetscCalloc1(rows->n, root));
  for (PetscInt u = 0; u < rows->n; u++) {
    for (PetscInt k = rows->ia[u]; k < rows->ia[u + 1]; k++) {
      if (rows->ja[k] == u) (*root)[u] = PetscSqrtReal(PetscAbsScalar(rows->a[k]));
    }
  }
  PetscFunctionReturn(0);
}

/*
   Copies the entries that are not tiny, and the diagonal, to a[] and their columns to j[]; counts them if j is NULL.
   i[]: the start of each row.
*/
static void OperatorKeep(const BlockRows *rows, const PetscReal root[], PetscInt i[], PetscInt j[], PetscScalar a[])
{
  PetscInt n = 0;

  i[0] = 0;
  for (PetscInt u = 0; u < rows->n; u++) {
    const PetscReal tiny = BLOCKAMG_TINY * root[u];

    for (PetscInt k = rows->ia[u]; k < rows->ia[u + 1]; k++) {
      if (PetscAbsScalar(rows->a[k]) <= tiny * root[rows->ja[k]] && rows->ja[k] != u) continue;
      if (j) {
        j[n] = rows->ja[k];
        a[n] = rows->a[k];
      }
      n++;
    }
    i[u + 1] = n;
  }
}

/* Copies the entries of a matrix of type SEQAIJ that are not tiny. i is NULL if less than a tenth of them is tiny. */
static PetscErrorCode OperatorDropTiny(Mat A, PetscInt **i, PetscInt **j, PetscScalar **a)
{
  BlockRows  rows;
  PetscReal *root;

  PetscFunctionBegin;
  PetscCall(BlockRowsGet_Private(A, &rows));
  PetscCall(OperatorGetRoots(&rows, &root));
  PetscCall(PetscMalloc1(rows.n + 1, i));
  OperatorKeep(&rows, root, *i, NULL, NULL);
  if ((*i)[rows.n] > 0.9 * (PetscReal)rows.ia[rows.n]) PetscCall(PetscFree(*i));
  else {
    PetscCall(PetscMalloc1((*i)[rows.n], j));
    PetscCall(PetscMalloc1((*i)[rows.n], a));
    OperatorKeep(&rows, root, *i, *j, *a);
  }
  PetscCall(PetscFree(root));
  PetscCall(BlockRowsRestore_Private(&rows));
  PetscFunctionReturn(0);
}

/*
   BlockConvertToHypre_Private - gets a copy in hypre's format, on one rank without tiny entries

   Input Parameters:
   + A  - the operator, of type AIJ; it is destroyed, which frees its memory unless the caller has another reference
   - bs - its block size

   Output Parameter:
   . hypre - the copy
*/
PetscErrorCode BlockConvertToHypre_Private(Mat *A, PetscInt bs, Mat *hypre)
{
  MPI_Comm     comm;
  PetscInt     n, *i = NULL, *j = NULL;
  PetscScalar *a = NULL;
  PetscBool    sequential;

  PetscFunctionBegin;
  PetscCall(PetscObjectBaseTypeCompare((PetscObject)*A, MATSEQAIJ, &sequential));
  if (sequential) PetscCall(OperatorDropTiny(*A, &i, &j, &a));
  if (i) {
    PetscCall(MatGetLocalSize(*A, &n, NULL));
    PetscCall(PetscObjectGetComm((PetscObject)*A, &comm));
    PetscCall(MatDestroy(A));
    PetscCall(MatCreateSeqAIJWithArrays(comm, n, n, i, j, a, A));
  }
  PetscCall(MatConvert(*A, MATHYPRE, MAT_INITIAL_MATRIX, hypre));
  PetscCall(MatSetBlockSize(*hypre, bs));
  PetscCall(MatDestroy(A));
  PetscCall(PetscFree(i));
  PetscCall(PetscFree(j));
  PetscCall(PetscFree(a));
  PetscFunctionReturn(0);
}
