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

/* The entries of this rank's rows that are kept: in columns of this rank, and of other ranks, with global numbers */
typedef struct {
  PetscInt    *i, *j, *oi, *oj;
  PetscScalar *a, *oa;
} OperatorKept;

/*
   Copies the entries in columns of other ranks, all of them: the diagonal entries of these columns are not known here.
   MATMPIAIJ needs them in global numbers.
*/
static PetscErrorCode OperatorCopyOffRank(const BlockRows *rows, OperatorKept *kept)
{
  const PetscInt n = rows->n ? rows->oia[rows->n] : 0; /* a rank without rows may have no arrays */

  PetscFunctionBegin;
  PetscCall(PetscMalloc3(rows->n + 1, &kept->oi, n, &kept->oj, n, &kept->oa));
  kept->oi[0] = 0;
  if (rows->n) PetscCall(PetscArraycpy(kept->oi, rows->oia, rows->n + 1));
  PetscCall(PetscArraycpy(kept->oa, rows->oa, n));
  for (PetscInt k = 0; k < n; k++) kept->oj[k] = rows->ghosts[rows->oja[k]];
  PetscFunctionReturn(0);
}

/* Copies the entries that are not tiny. kept->i is NULL if less than a tenth of them is tiny, over all ranks. */
static PetscErrorCode OperatorDropTiny(Mat A, OperatorKept *kept)
{
  BlockRows      rows;
  PetscReal     *root;
  PetscLogDouble count[2];

  PetscFunctionBegin;
  PetscCall(BlockRowsGet_Private(A, &rows));
  PetscCall(OperatorGetRoots(&rows, &root));
  PetscCall(PetscMalloc1(rows.n + 1, &kept->i));
  OperatorKeep(&rows, root, kept->i, NULL, NULL);
  count[0] = (double)kept->i[rows.n];
  count[1] = rows.n ? (double)rows.ia[rows.n] : 0.0;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, count, 2, MPI_DOUBLE, MPI_SUM, PetscObjectComm((PetscObject)A)));
  if (count[0] > 0.9 * count[1]) PetscCall(PetscFree(kept->i));
  else {
    PetscCall(PetscMalloc2(kept->i[rows.n], &kept->j, kept->i[rows.n], &kept->a));
    OperatorKeep(&rows, root, kept->i, kept->j, kept->a);
    if (rows.off) PetscCall(OperatorCopyOffRank(&rows, kept));
  }
  PetscCall(PetscFree(root));
  PetscCall(BlockRowsRestore_Private(&rows));
  PetscFunctionReturn(0);
}

/* Replaces A by a matrix of the kept entries, which refers to their arrays */
static PetscErrorCode OperatorReplace(Mat *A, const OperatorKept *kept)
{
  MPI_Comm comm = PetscObjectComm((PetscObject)*A);
  PetscInt m, n, M, N;

  PetscFunctionBegin;
  PetscCall(MatGetLocalSize(*A, &m, &n));
  PetscCall(MatGetSize(*A, &M, &N));
  PetscCall(PetscCommDuplicate(comm, &comm, NULL)); /* A may be the last object that holds it */
  PetscCall(MatDestroy(A));
  if (kept->oi)
    PetscCall(
      MatCreateMPIAIJWithSplitArrays(comm, m, n, M, N, kept->i, kept->j, kept->a, kept->oi, kept->oj, kept->oa, A));
  else PetscCall(MatCreateSeqAIJWithArrays(comm, m, n, kept->i, kept->j, kept->a, A));
  PetscCall(PetscCommDestroy(&comm));
  PetscFunctionReturn(0);
}

/*
   BlockConvertToHypre_Private - gets a copy in hypre's format without tiny entries in columns of the same rank

   Input Parameters:
   + A  - the operator, of type AIJ; it is destroyed, which frees its memory unless the caller has another reference
   - bs - its block size

   Output Parameter:
   . hypre - the copy
*/
PetscErrorCode BlockConvertToHypre_Private(Mat *A, PetscInt bs, Mat *hypre)
{
  OperatorKept kept = {NULL, NULL, NULL, NULL, NULL, NULL};

  PetscFunctionBegin;
  PetscCall(OperatorDropTiny(*A, &kept));
  if (kept.i) PetscCall(OperatorReplace(A, &kept));
  PetscCall(MatConvert(*A, MATHYPRE, MAT_INITIAL_MATRIX, hypre));
  PetscCall(MatSetBlockSize(*hypre, bs));
  PetscCall(MatDestroy(A));
  PetscCall(PetscFree3(kept.oi, kept.oj, kept.oa));
  PetscCall(PetscFree2(kept.j, kept.a));
  PetscCall(PetscFree(kept.i));
  PetscFunctionReturn(0);
}
