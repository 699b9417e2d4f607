/* The rows of a matrix that this rank owns, as compressed rows. Formats other than AIJ are copied. */
#include "blockamgimpl.h"

static PetscErrorCode RowsGetSequential(Mat A, PetscInt *n, const PetscInt **ia, const PetscInt **ja,
  const PetscScalar **a)
{
  PetscBool done;

  PetscFunctionBegin;
  PetscCall(MatGetRowIJ(A, 0, PETSC_FALSE, PETSC_FALSE, n, ia, ja, &done));
  PetscCheck(done, PETSC_COMM_SELF, PETSC_ERR_SUP, "A matrix of type %s has no compressed rows",
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

/*
  BlockConvertToAIJ_Private - a copy of type AIJ, or A itself if it is of that type
*/
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
    /* MatConvert() of a parallel format increases the state of A; unless it is reset, every application would set up
       again */
    PetscCall(PetscObjectStateGet((PetscObject)A, &state));
    PetscCall(MatConvert(A, MATAIJ, MAT_INITIAL_MATRIX, aij));
    PetscCall(PetscObjectStateSet((PetscObject)A, state));
  }
  PetscFunctionReturn(0);
}

/*
  BlockRowsGet_Private - the rows of this rank; collective
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
