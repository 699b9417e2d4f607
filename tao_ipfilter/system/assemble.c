/*
   Assembles the condensed matrix A = H + ... + J^T D J. A has the type of H, with two exceptions. For a dense H it is
   AIJ. For an SBAIJ H on one process it is BAIJ, unless the preconditioner factors SBAIJ: H then takes half the memory,
   while products with A and hypre use full rows.
   The pattern of A is the union of those of H and J^T J, and A is preallocated for it. While H is unchanged, only rows
   with entries of J^T D J are written again; a constant H is therefore copied once.
*/
#include "systemimpl.h"
#include "tao_ipfilter/solver/condensed.h"
#include "tao_ipfilter/solver/matrices.h"

/*
   Computes the sorted block columns of block row ib of A: those of H and of C = J^T D J (may be NULL), and the diagonal
   block. upper: only columns from the diagonal on.
*/
static PetscErrorCode CondensedRowPattern(Mat H, Mat C, PetscInt ib, PetscInt bs, PetscBool upper, PetscInt *n,
  PetscInt cols[])
{
  PetscFunctionBegin;
  *n           = 0;
  cols[(*n)++] = ib;
  for (PetscInt k = 0; k < bs; k++) {
    for (PetscInt m = 0; m < 2; m++) {
      Mat             B = m ? C : H;
      const PetscInt *c;
      PetscInt        nc, last = -1;

      if (!B) continue;
      PetscCall(MatGetRow(B, ib * bs + k, &nc, &c, NULL));
      for (PetscInt j = 0; j < nc; j++) {
        const PetscInt block = c[j] / bs;

        if (block == last || (upper && block < ib)) continue;
        cols[(*n)++] = last = block;
      }
      PetscCall(MatRestoreRow(B, ib * bs + k, &nc, &c, NULL));
    }
  }
  PetscCall(PetscSortRemoveDupsInt(n, cols));
  PetscFunctionReturn(0);
}

/*
   Computes an upper bound of the number of block columns of a block row: the longest row of H plus the longest row of
   C, times the block size, plus one
*/
static PetscErrorCode CondensedLongestRow(Mat H, Mat C, PetscInt bs, PetscInt *longest)
{
  PetscInt rstart, rend, h = 0, c = 0;

  PetscFunctionBegin;
  PetscCall(MatGetOwnershipRange(H, &rstart, &rend));
  for (PetscInt i = rstart; i < rend; i++) {
    PetscInt nc;

    PetscCall(MatGetRow(H, i, &nc, NULL, NULL));
    h = PetscMax(h, nc);
    PetscCall(MatRestoreRow(H, i, &nc, NULL, NULL));
    if (!C) continue;
    PetscCall(MatGetRow(C, i, &nc, NULL, NULL));
    c = PetscMax(c, nc);
    PetscCall(MatRestoreRow(C, i, &nc, NULL, NULL));
  }
  *longest = bs * (h + c) + 1;
  PetscFunctionReturn(0);
}

/* Counts the blocks of each block row of A: in columns of this rank (dnz), and in columns of other ranks (onz) */
static PetscErrorCode CondensedCountBlocks(Mat H, Mat C, PetscInt bs, PetscBool upper, PetscInt dnz[], PetscInt onz[])
{
  PetscInt rstart, rend, longest = 0, *cols;

  PetscFunctionBegin;
  PetscCall(MatGetOwnershipRange(H, &rstart, &rend));
  if (upper) PetscCall(MatGetRowUpperTriangular(H));
  PetscCall(CondensedLongestRow(H, C, bs, &longest));
  PetscCall(PetscMalloc1(longest, &cols));
  for (PetscInt ib = rstart / bs; ib < rend / bs; ib++) {
    const PetscInt row = ib - rstart / bs;
    PetscInt       nb;

    PetscCall(CondensedRowPattern(H, C, ib, bs, upper, &nb, cols));
    dnz[row] = onz[row] = 0;
    for (PetscInt j = 0; j < nb; j++) {
      if (cols[j] >= rstart / bs && cols[j] < rend / bs) dnz[row]++;
      else onz[row]++;
    }
  }
  PetscCall(PetscFree(cols));
  if (upper) PetscCall(MatRestoreRowUpperTriangular(H));
  PetscFunctionReturn(0);
}

/*
   Chooses the type of A for a Hessian of the type of H. *baij: it stores blocks; *sbaij: it stores the upper triangle
   of blocks.
*/
static PetscErrorCode CondensedChooseType(Mat H, MatType *type, PetscBool *baij, PetscBool *sbaij)
{
  PetscBool aij, dense;

  PetscFunctionBegin;
  PetscCall(PetscObjectBaseTypeCompareAny((PetscObject)H, &aij, MATSEQAIJ, MATMPIAIJ, ""));
  PetscCall(PetscObjectBaseTypeCompareAny((PetscObject)H, baij, MATSEQBAIJ, MATMPIBAIJ, ""));
  PetscCall(PetscObjectBaseTypeCompareAny((PetscObject)H, sbaij, MATSEQSBAIJ, MATMPISBAIJ, ""));
  PetscCall(PetscObjectBaseTypeCompareAny((PetscObject)H, &dense, MATSEQDENSE, MATMPIDENSE, ""));
  PetscCall(MatGetType(H, type));
  PetscCheck(aij || *baij || *sbaij || dense, PetscObjectComm((PetscObject)H), PETSC_ERR_SUP,
    "TAOIPFILTER takes a Hessian of type AIJ, BAIJ, SBAIJ or dense, not %s", *type);
  if (dense) *type = MATAIJ;
  PetscFunctionReturn(0);
}

/* Creates A, preallocated for the union of the patterns of H and C */
static PetscErrorCode CondensedCreate(Mat H, Mat C, Mat *A)
{
  PetscInt     bs = 1, hbs, m, n, M, N, *dnz, *onz;
  PetscBool    baij, sbaij;
  MatType      type;
  MatNullSpace near;

  PetscFunctionBegin;
  PetscCall(CondensedChooseType(H, &type, &baij, &sbaij));
  PetscCall(MatGetBlockSize(H, &hbs));
  if (baij || sbaij) bs = hbs;
  PetscCall(MatGetLocalSize(H, &m, &n));
  PetscCall(MatGetSize(H, &M, &N));
  PetscCall(PetscMalloc2(m / bs, &dnz, m / bs, &onz));
  PetscCall(CondensedCountBlocks(H, C, bs, sbaij, dnz, onz));
  PetscCall(MatCreate(PetscObjectComm((PetscObject)H), A));
  PetscCall(MatSetSizes(*A, m, n, M, N));
  PetscCall(MatSetType(*A, type));
  if (hbs > 1) PetscCall(MatSetBlockSize(*A, hbs));
  if (sbaij) PetscCall(MatXAIJSetPreallocation(*A, bs, NULL, NULL, dnz, onz));
  else if (baij) PetscCall(MatXAIJSetPreallocation(*A, bs, dnz, onz, NULL, NULL));
  else {
    PetscCall(MatSeqAIJSetPreallocation(*A, 0, dnz));
    PetscCall(MatMPIAIJSetPreallocation(*A, 0, dnz, 0, onz));
  }
  PetscCall(PetscFree2(dnz, onz));
  if (sbaij) PetscCall(MatSetOption(*A, MAT_IGNORE_LOWER_TRIANGULAR, PETSC_TRUE));
  PetscCall(MatSetOption(*A, MAT_SYMMETRIC, PETSC_TRUE));
  PetscCall(MatSetOption(*A, MAT_NO_OFF_PROC_ENTRIES, PETSC_TRUE));
  PetscCall(MatGetNearNullSpace(H, &near));
  if (near) PetscCall(MatSetNearNullSpace(*A, near));
  PetscFunctionReturn(0);
}

/* Sets the entries of A in the pattern of C to zero, for the given rows */
static PetscErrorCode CondensedZeroTouched(Mat A, Mat C, PetscInt nrows, const PetscInt rows[])
{
  PetscScalar *zeros = NULL;
  PetscInt     nz    = 0;

  PetscFunctionBegin;
  for (PetscInt r = 0; r < nrows; r++) {
    const PetscInt *c;
    PetscInt        nc;

    PetscCall(MatGetRow(C, rows[r], &nc, &c, NULL));
    if (nc > nz) {
      nz = 2 * nc;
      PetscCall(PetscFree(zeros));
      PetscCall(PetscCalloc1(nz, &zeros));
    }
    PetscCall(MatSetValues(A, 1, &rows[r], nc, c, zeros, INSERT_VALUES));
    PetscCall(MatRestoreRow(C, rows[r], &nc, &c, NULL));
  }
  PetscCall(PetscFree(zeros));
  PetscFunctionReturn(0);
}

/* Finds whether H stores its upper triangle only while A needs full rows */
static PetscErrorCode HessianUnfolds(Tao tao, Mat H, PetscBool *unfolds)
{
  PC        pc;
  PetscBool half, factored;

  PetscFunctionBegin;
  *unfolds = PETSC_FALSE;
  PetscCall(PetscObjectTypeCompare((PetscObject)H, MATSEQSBAIJ, &half));
  PetscCall(KSPGetPC(tao->ksp, &pc));
  PetscCall(PetscObjectTypeCompareAny((PetscObject)pc, &factored, PCCHOLESKY, PCICC, ""));
  *unfolds = (PetscBool)(half && !factored);
  PetscFunctionReturn(0);
}

/*
   Sets (INSERT_VALUES) or adds (ADD_VALUES) one row of H to A. mirrored: H is an upper triangle; the row is inserted as
   a column too. Entries left of the diagonal are inserted by the row that holds them, if that row is written too.
*/
static PetscErrorCode SetRow(Mat A, Mat H, PetscInt row, PetscBool mirrored, InsertMode mode)
{
  const PetscInt    *c;
  const PetscScalar *v;
  PetscInt           nc;

  PetscFunctionBegin;
  PetscCall(MatGetRow(H, row, &nc, &c, &v));
  PetscCall(MatSetValues(A, 1, &row, nc, c, v, mode));
  if (mirrored) PetscCall(MatSetValues(A, nc, c, 1, &row, v, mode));
  PetscCall(MatRestoreRow(H, row, &nc, &c, &v));
  PetscFunctionReturn(0);
}

/*
   Copies a BAIJ matrix by block rows. The scalar rows of a block row, one after the other, have the format of
   MatSetValuesBlocked().
*/
static PetscErrorCode CopyBlocked(Mat A, Mat H, PetscInt bs)
{
  PetscScalar *values = NULL;
  PetscInt    *blocks = NULL;
  PetscInt     rstart, rend, max = 0;

  PetscFunctionBegin;
  PetscCall(MatGetOwnershipRange(H, &rstart, &rend));
  for (PetscInt row = rstart; row < rend; row++) {
    const PetscInt    *c;
    const PetscScalar *v;
    PetscInt           nc;

    PetscCall(MatGetRow(H, row, &nc, &c, &v));
    if (nc > max) {
      PetscCheck(row % bs == 0, PETSC_COMM_SELF, PETSC_ERR_PLIB, "The rows of a block row have different lengths");
      max = 2 * nc;
      PetscCall(PetscFree2(values, blocks));
      PetscCall(PetscMalloc2(bs * max, &values, max / bs + 1, &blocks));
    }
    PetscCall(PetscArraycpy(values + (row % bs) * nc, v, nc));
    const PetscInt nb = nc / bs, ib = row / bs;
    for (PetscInt j = 0; j < nb; j++) blocks[j] = c[j * bs] / bs;
    PetscCall(MatRestoreRow(H, row, &nc, &c, &v));
    if (row % bs == bs - 1) PetscCall(MatSetValuesBlocked(A, 1, &ib, nb, blocks, values, INSERT_VALUES));
  }
  PetscCall(PetscFree2(values, blocks));
  PetscFunctionReturn(0);
}

/* Inserts all of H into A */
static PetscErrorCode CondensedCopyHessian(Mat A, Mat H)
{
  PetscInt  rstart, rend, bs;
  PetscBool baij, sbaij;

  PetscFunctionBegin;
  PetscCall(PetscObjectBaseTypeCompareAny((PetscObject)H, &baij, MATSEQBAIJ, MATMPIBAIJ, ""));
  PetscCall(PetscObjectBaseTypeCompareAny((PetscObject)H, &sbaij, MATSEQSBAIJ, MATMPISBAIJ, ""));
  PetscCall(MatGetOwnershipRange(H, &rstart, &rend));
  if (baij) {
    PetscCall(MatGetBlockSize(H, &bs));
    PetscCall(CopyBlocked(A, H, bs));
    PetscFunctionReturn(0);
  }
  if (sbaij) PetscCall(MatGetRowUpperTriangular(H));
  for (PetscInt i = rstart; i < rend; i++) PetscCall(SetRow(A, H, i, PETSC_FALSE, INSERT_VALUES));
  if (sbaij) PetscCall(MatRestoreRowUpperTriangular(H));
  PetscFunctionReturn(0);
}

/* Inserts those rows of H into A in which J^T D J has entries. unfolds: H stores its upper triangle only. */
static PetscErrorCode CondensedRestoreTouched(IPCondensed *cond, Mat H, PetscBool unfolds)
{
  PetscBool sbaij;

  PetscFunctionBegin;
  PetscCall(PetscObjectBaseTypeCompareAny((PetscObject)H, &sbaij, MATSEQSBAIJ, MATMPISBAIJ, ""));
  if (sbaij) PetscCall(MatGetRowUpperTriangular(H));
  for (PetscInt r = 0; r < cond->ntouched; r++) PetscCall(SetRow(cond->A, H, cond->touched[r], unfolds, INSERT_VALUES));
  if (sbaij) PetscCall(MatRestoreRowUpperTriangular(H));
  PetscFunctionReturn(0);
}

/*
   Inserts H into A: all of it if the pattern or the values are new; otherwise only the rows that were changed by J^T D
   J
*/
PetscErrorCode IPCondensedWriteHessian(Tao tao, PetscBool pattern, PetscBool values)
{
  IPCondensed *cond = ((TAO_IPFILTER *)tao->data)->cond;
  Mat          H    = ((TAO_IPFILTER *)tao->data)->hess->H;
  MatNullSpace near;
  PetscBool    unfolds = PETSC_FALSE;

  PetscFunctionBegin;
  PetscCall(HessianUnfolds(tao, H, &unfolds));
  if (unfolds && values) {
    PetscCall(MatConvert(((TAO_IPFILTER *)tao->data)->hess->H, MATSEQBAIJ, MAT_INITIAL_MATRIX, &H));
    PetscCall(MatGetNearNullSpace(((TAO_IPFILTER *)tao->data)->hess->H, &near));
    if (near) PetscCall(MatSetNearNullSpace(H, near));
  } else PetscCall(PetscObjectReference((PetscObject)H));
  if (pattern) {
    PetscCall(MatDestroy(&cond->A));
    PetscCall(CondensedCreate(H, cond->JtDJ, &cond->A));
    cond->shifted = PETSC_FALSE;
  }
  if (cond->JtDJ) PetscCall(CondensedZeroTouched(cond->A, cond->JtDJ, cond->ntouched, cond->touched));
  if (values) PetscCall(CondensedCopyHessian(cond->A, H));
  else PetscCall(CondensedRestoreTouched(cond, H, unfolds));
  PetscCall(MatDestroy(&H));
  PetscFunctionReturn(0);
}

/* Adds J^T D J to A, after entries were inserted into A */
PetscErrorCode IPCondensedAddProduct(IPCondensed *cond)
{
  PetscFunctionBegin;
  PetscCall(MatAssemblyBegin(cond->A, MAT_FLUSH_ASSEMBLY));
  PetscCall(MatAssemblyEnd(cond->A, MAT_FLUSH_ASSEMBLY));
  for (PetscInt r = 0; r < cond->ntouched; r++)
    PetscCall(SetRow(cond->A, cond->JtDJ, cond->touched[r], PETSC_FALSE, ADD_VALUES));
  PetscFunctionReturn(0);
}
