/*
   Gets the rows of a matrix that this rank owns in compressed row format. Matrices that are not of type AIJ are copied.
*/
#include "blockamgimpl.h"

static PetscErrorCode RowsGetSequential(Mat A, PetscInt *n, const PetscInt **ia, const PetscInt **ja,
  const PetscScalar **a)
{
  PetscBool done;

  PetscFunctionBegin;
  PetscCall(MatGetRowIJ(A, 0, PETSC_FALSE, PETSC_FALSE, n, ia, ja, &done));
  PetscCheck(done, PETSC_COMM_SELF, PETSC_ERR_SUP, "A matrix of type %s has no compressed sparse rows: use type aij",
    ((PetscObject)A)->type_name);
  PetscCall(MatSeqAIJGetArrayRead(A, a));
  PetscFunctionReturn(0);
}

static PetscErrorCode RowsRestoreSequential(Mat A, PetscInt *n, const PetscInt **ia, const PetscInt **ja,
  const PetscScalar **a)
{
  PetscBool done;

  PetscFunctionBegin;
  PetscCall(MatSeqAIJRestoreArrayRead(A, a));
  PetscCall(MatRestoreRowIJ(A, 0, PETSC_FALSE, PETSC_FALSE, n, ia, ja, &done));
  PetscFunctionReturn(0);
}

/* BlockConvertToAIJ_Private - gets a copy of type AIJ, or a reference to A if A is of that type */
PetscErrorCode BlockConvertToAIJ_Private(Mat A, Mat *aij)
{
  PetscObjectState state;
  PetscBool        is;

  PetscFunctionBegin;
  PetscCall(PetscObjectBaseTypeCompareAny((PetscObject)A, &is, MATSEQAIJ, MATMPIAIJ, ""));
  if (is) {
    PetscCall(PetscObjectReference((PetscObject)A));
    *aij = A;
  } else {
    /* MatConvert() of a parallel matrix increases the object state of A, although A is unchanged. Without a reset,
       every later application would set up the preconditioner again. */
    PetscCall(PetscObjectStateGet((PetscObject)A, &state));
    PetscCall(MatConvert(A, MATAIJ, MAT_INITIAL_MATRIX, aij));
    PetscCall(PetscObjectStateSet((PetscObject)A, state));
  }
  PetscFunctionReturn(0);
}

/*
   BlockRowsGet_Private - gets the rows of this rank, until BlockRowsRestore_Private()

   Collective
*/
PetscErrorCode BlockRowsGet_Private(Mat A, BlockRows *rows)
{
  PetscBool parallel;
  PetscInt  m;

  PetscFunctionBegin;
  PetscCall(PetscMemzero(rows, sizeof(*rows)));
  PetscCall(BlockConvertToAIJ_Private(A, &rows->held));
  PetscCall(PetscObjectBaseTypeCompare((PetscObject)rows->held, MATMPIAIJ, &parallel));
  if (parallel) {
    PetscCall(MatMPIAIJGetSeqAIJ(rows->held, &rows->diag, &rows->off, &rows->ghosts));
    PetscCall(MatGetSize(rows->off, NULL, &rows->nghosts));
    PetscCall(RowsGetSequential(rows->off, &m, &rows->oia, &rows->oja, &rows->oa));
  } else rows->diag = rows->held;
  PetscCall(RowsGetSequential(rows->diag, &rows->n, &rows->ia, &rows->ja, &rows->a));
  PetscCall(MatGetLayouts(rows->held, NULL, &rows->columns));
  PetscFunctionReturn(0);
}

PetscErrorCode BlockRowsRestore_Private(BlockRows *rows)
{
  PetscInt m;

  PetscFunctionBegin;
  PetscCall(RowsRestoreSequential(rows->diag, &rows->n, &rows->ia, &rows->ja, &rows->a));
  if (rows->off) PetscCall(RowsRestoreSequential(rows->off, &m, &rows->oia, &rows->oja, &rows->oa));
  PetscCall(MatDestroy(&rows->held));
  PetscFunctionReturn(0);
}
