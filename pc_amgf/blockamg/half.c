/*
   Converts an operator of type SEQSBAIJ in blocks of 3 x 3, which stores the upper triangle, without a copy of both
   triangles: to hypre's format, and to the finest level
*/
#include "blockamgimpl.h"
#include <math.h>

/* The block rows of the upper triangle, in compressed row format. Blocks are stored column by column. */
typedef struct {
  PetscInt        n;
  const PetscInt *ia, *ja;
  PetscScalar    *a;
} HalfRows;

static PetscErrorCode HalfGet(Mat A, HalfRows *rows)
{
  PetscBool done;

  PetscFunctionBegin;
  PetscCall(MatGetRowIJ(A, 0, PETSC_FALSE, PETSC_TRUE, &rows->n, &rows->ia, &rows->ja, &done));
  PetscCheck(done, PETSC_COMM_SELF, PETSC_ERR_SUP, "The rows of a matrix of type SEQSBAIJ cannot be accessed");
  PetscCall(MatSeqSBAIJGetArray(A, &rows->a));
  PetscFunctionReturn(0);
}

static PetscErrorCode HalfRestore(Mat A, HalfRows *rows)
{
  PetscBool done;

  PetscFunctionBegin;
  PetscCall(MatSeqSBAIJRestoreArray(A, &rows->a));
  PetscCall(MatRestoreRowIJ(A, 0, PETSC_FALSE, PETSC_TRUE, &rows->n, &rows->ia, &rows->ja, &done));
  PetscFunctionReturn(0);
}

/* BlockHalfSupports_Private - finds whether the functions of this file can convert the operator */
PetscErrorCode BlockHalfSupports_Private(Mat A, PetscBool *supports)
{
  PetscInt n, bs;

  PetscFunctionBegin;
  PetscCall(PetscObjectTypeCompare((PetscObject)A, MATSEQSBAIJ, supports));
  PetscCall(MatGetLocalSize(A, &n, NULL));
  PetscCall(MatGetBlockSize(A, &bs));
  if (bs != 3 || n <= BLOCKAMG_DENSE) *supports = PETSC_FALSE;
  PetscFunctionReturn(0);
}

/*
   Appends row r of the block v, or of v^T if transposed, to a row of the whole matrix that is filled up to *next.
   column: first column of the block. An entry is left out if it is at most tiny * root[its column] and not on the
   diagonal. If j is NULL the entries are counted only.
*/
static void HalfAppendRow(const PetscScalar v[9], PetscBool transposed, int r, PetscInt row, PetscInt column,
  PetscReal tiny, const PetscReal root[], PetscInt *next, PetscInt j[], PetscScalar a[])
{
  for (int c = 0; c < 3; c++) {
    const PetscScalar value = transposed ? v[3 * r + c] : v[3 * c + r];

    if (PetscAbsScalar(value) <= tiny * root[column + c] && row != column + c) continue;
    if (j) {
      j[*next] = column + c;
      a[*next] = value;
    }
    ++*next;
  }
}

/*
   Copies both triangles to compressed rows. next[u] is where row u begins, and afterwards where it ends. Entries of a
   row are in the order of the columns, since block rows above a row come first.
*/
static void HalfExpand(const HalfRows *rows, const PetscReal root[], PetscInt next[], PetscInt j[], PetscScalar a[])
{
  for (PetscInt i = 0; i < rows->n; i++) {
    for (PetscInt k = rows->ia[i]; k < rows->ia[i + 1]; k++) {
      const PetscScalar *v = rows->a + 9 * k;
      const PetscInt     m = rows->ja[k];

      for (int r = 0; r < 3; r++) {
        const PetscInt row = 3 * i + r, below = 3 * m + r;

        HalfAppendRow(v, PETSC_FALSE, r, row, 3 * m, BLOCKAMG_TINY * root[row], root, &next[row], j, a);
        if (m > i) HalfAppendRow(v, PETSC_TRUE, r, below, 3 * i, BLOCKAMG_TINY * root[below], root, &next[below], j, a);
      }
    }
  }
}

/* BlockHalfConvertToHypre_Private - gets a copy of both triangles in hypre's format, without tiny entries */
PetscErrorCode BlockHalfConvertToHypre_Private(Mat A, Mat *hypre)
{
  HalfRows     rows;
  Mat          aij;
  PetscInt     n, *i, *next, *j;
  PetscReal   *root;
  PetscScalar *a;

  PetscFunctionBegin;
  PetscCall(HalfGet(A, &rows));
  n = 3 * rows.n;
  PetscCall(PetscCalloc3(n, &root, n + 1, &i, n, &next));
  for (PetscInt k = 0; k < rows.n; k++) {
    if (rows.ia[k] == rows.ia[k + 1] || rows.ja[rows.ia[k]] != k) continue;
    for (int r = 0; r < 3; r++) root[3 * k + r] = PetscSqrtReal(PetscAbsScalar(rows.a[9 * rows.ia[k] + 4 * r]));
  }
  HalfExpand(&rows, root, next, NULL, NULL);
  for (PetscInt u = 0; u < n; u++) {
    i[u + 1] = i[u] + next[u];
    next[u]  = i[u];
  }
  PetscCall(PetscMalloc2(i[n], &j, i[n], &a));
  HalfExpand(&rows, root, next, j, a);
  PetscCall(HalfRestore(A, &rows));
  PetscCall(MatCreateSeqAIJWithArrays(PetscObjectComm((PetscObject)A), n, n, i, j, a, &aij));
  PetscCall(MatConvert(aij, MATHYPRE, MAT_INITIAL_MATRIX, hypre));
  PetscCall(MatSetBlockSize(*hypre, 3));
  PetscCall(MatDestroy(&aij));
  PetscCall(PetscFree2(j, a));
  PetscCall(PetscFree3(root, i, next));
  PetscFunctionReturn(0);
}

/* Sets the scales of the unknowns and the inverses of the diagonal blocks */
static PetscErrorCode HalfSetDiagonal(const HalfRows *rows, BlockLevel *level, double scale)
{
  PetscFunctionBegin;
  for (int i = 0; i < level->nb; i++) {
    const PetscInt     k         = rows->ia[i];
    const PetscScalar *v         = rows->a + 9 * k;
    PetscScalar        D[16]     = {0.0};
    float             *unknown_s = level->scale + 4 * (size_t)i;

    for (int r = 0; r < 4; r++) unknown_s[r] = 1.0f;
    if (k == rows->ia[i + 1] || rows->ja[k] != i) continue;
    for (int r = 0; r < 3; r++) {
      const PetscReal d = PetscAbsScalar(v[4 * r]) / scale;

      if (d != 0.0) unknown_s[r] = (float)(1.0 / PetscSqrtReal(d));
      for (int c = 0; c < 3; c++) D[3 * r + c] = v[3 * c + r] / scale;
    }
    PetscCall(BlockLevelInvert_Private(level, i, D));
  }
  PetscFunctionReturn(0);
}

/* Marks stiff unknowns */
static PetscErrorCode HalfMarkStiff(const HalfRows *rows, BlockLevel *level)
{
  PetscFunctionBegin;
  for (int i = 0; i < level->nb; i++) {
    for (PetscInt k = rows->ia[i]; k < rows->ia[i + 1]; k++) {
      for (int m = 0; m < 9; m++) {
        const int p = 4 * (int)rows->ja[k] + m / 3, q = 4 * i + m % 3;

        if (BlockDiffersMuch(level, p, q) && rows->a[9 * k + m] != 0.0)
          PetscCall(BlockContrastMark_Private(level, p, q));
      }
    }
  }
  PetscFunctionReturn(0);
}

/* Counts the entries of stiff unknowns in L if next is NULL, and stores them otherwise */
static void HalfVisitContrast(const HalfRows *rows, BlockLevel *level, double scale, int next[])
{
  for (int i = 0; i < level->nb; i++) {
    for (PetscInt k = rows->ia[i]; k < rows->ia[i + 1]; k++) {
      const int below = (int)rows->ja[k];

      for (int m = 0; m < 9 && below != i; m++)
        BlockContrastAdd_Private(level, 4 * below + m / 3, 4 * i + m % 3, PetscRealPart(rows->a[9 * k + m]) / scale,
          next);
    }
  }
}

static PetscErrorCode HalfSetContrast(const HalfRows *rows, BlockLevel *level, double scale)
{
  BlockContrast *contrast = &level->contrast;
  int           *next;

  PetscFunctionBegin;
  PetscCall(HalfMarkStiff(rows, level));
  if (!contrast->stiff) PetscFunctionReturn(0);
  PetscCall(PetscCalloc1(level->nb + 1, &contrast->ptr));
  HalfVisitContrast(rows, level, scale, NULL);
  PetscCall(BlockContrastReserve_Private(contrast, level->nb, &next));
  HalfVisitContrast(rows, level, scale, next);
  PetscCall(PetscFree(next));
  PetscFunctionReturn(0);
}

/* Counts the blocks in each row of L, the transposed upper triangle, and finds the unit of each of its rows */
static void HalfSetUnits(const HalfRows *rows, BlockLevel *level, double scale)
{
  for (int i = 0; i < level->nb; i++) {
    for (PetscInt k = rows->ia[i]; k < rows->ia[i + 1]; k++) {
      const PetscScalar *v     = rows->a + 9 * k;
      const size_t       below = 4 * (size_t)rows->ja[k];

      if (rows->ja[k] == i) continue;
      level->ptr[rows->ja[k] + 1]++;
      for (int r = 0; r < 3; r++) {
        for (int c = 0; c < 3; c++) {
          const float value = fabsf(
            (float)(PetscRealPart(v[3 * r + c]) / scale * level->scale[below + r]) * level->scale[4 * (size_t)i + c]);

          if (BlockHasContrast(level, (int)(below + r), 4 * i + c)) continue;
          if (!(value <= level->unit[below + r])) level->unit[below + r] = value; /* NaN if the entry is NaN */
        }
      }
    }
  }
  for (size_t p = 0; p < 4 * (size_t)level->nb; p++) level->unit[p] /= BLOCKAMG_LARGEST;
  for (int i = 0; i < level->nb; i++) level->ptr[i + 1] += level->ptr[i];
}

/* Rounds the blocks to integers. next[i]: the next block of row i of L. */
static void HalfRound(const HalfRows *rows, BlockLevel *level, double scale, int next[])
{
  for (int i = 0; i < level->nb; i++) {
    for (PetscInt k = rows->ia[i]; k < rows->ia[i + 1]; k++) {
      const PetscScalar *v = rows->a + 9 * k;
      const PetscInt     m = rows->ja[k];
      int16_t           *to;

      if (m == i) continue;
      to                    = level->L + 12 * (size_t)next[m];
      level->col[next[m]++] = 4 * i;
      for (int r = 0; r < 3; r++) {
        const double factor = level->scale[4 * m + r] * BlockInverseUnit(level->unit[4 * m + r]) / scale;

        for (int c = 0; c < 3; c++) {
          const float value = (float)(factor * level->scale[4 * (size_t)i + c] * PetscRealPart(v[3 * r + c]));

          to[4 * r + c] = BlockHasContrast(level, 4 * (int)m + r, 4 * i + c) ? 0 : BlockRound(value);
        }
        to[4 * r + 3] = 0;
      }
    }
  }
}

/* BlockHalfSetLevel_Private - stores the operator divided by `scale` as the finest level */
PetscErrorCode BlockHalfSetLevel_Private(BlockLevel *level, Mat A, double scale)
{
  HalfRows rows;
  int     *next;

  PetscFunctionBegin;
  PetscCall(HalfGet(A, &rows));
  PetscCall(BlockLevelCheckSize_Private(3 * rows.n));
  level->n      = (int)(3 * rows.n);
  level->B      = 3;
  level->nb     = (int)rows.n;
  level->nslots = 4 * level->nb;
  PetscCall(PetscMalloc1(level->n, &level->position));
  for (int u = 0; u < level->n; u++) level->position[u] = 4 * (u / 3) + u % 3;
  PetscCall(PetscMalloc1(level->nslots, &level->scale));
  PetscCall(PetscCalloc1(level->nslots, &level->unit));
  PetscCall(PetscCalloc1(12 * (size_t)level->nb, &level->W));
  PetscCall(PetscCalloc1(level->nb + 1, &level->ptr));
  PetscCall(HalfSetDiagonal(&rows, level, scale));
  PetscCall(HalfSetContrast(&rows, level, scale));
  HalfSetUnits(&rows, level, scale);
  PetscCall(PetscMalloc1(level->ptr[level->nb], &level->col));
  PetscCall(PetscMalloc1(12 * (size_t)level->ptr[level->nb] + 4, &level->L));
  PetscCall(PetscArrayzero(level->L + 12 * (size_t)level->ptr[level->nb], 4)); /* as in LevelSetBlocks() */
  PetscCall(PetscMalloc1(level->nb, &next));
  PetscCall(PetscArraycpy(next, level->ptr, level->nb));
  HalfRound(&rows, level, scale, next);
  PetscCall(PetscFree(next));
  PetscCall(PetscFree(level->contrast.stiff));
  PetscCall(BlockLevelCount_Private(level, PetscObjectComm((PetscObject)A),
    18.0 * (double)rows.ia[rows.n] - 9.0 * (double)rows.n));
  for (size_t p = 0; p < 4 * (size_t)level->nb; p++) level->unit[p] /= 65536.0f; /* as in LevelRound() */
  PetscCall(HalfRestore(A, &rows));
  PetscFunctionReturn(0);
}
