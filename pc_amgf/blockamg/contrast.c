/*
   Entries of L in the rows and columns of stiff unknowns, in single precision. Rounded to 16 bits, these entries would
   have errors as large as the soft entries that they are coupled with.
*/
#include "blockamgimpl.h"

/* BlockContrastMark_Private - marks the stiffer one of the unknowns, or ghosts, at positions p and q */
PetscErrorCode BlockContrastMark_Private(BlockLevel *level, int p, int q)
{
  PetscFunctionBegin;
  if (!level->contrast.stiff) PetscCall(PetscCalloc1(level->nslots, &level->contrast.stiff));
  level->contrast.stiff[level->scale[p] < level->scale[q] ? p : q] = 1;
  PetscFunctionReturn(0);
}

/* BlockContrastSetCounts_Private - reserves memory, where ptr[i + 1] is the number of entries of block row i */
PetscErrorCode BlockContrastSetCounts_Private(BlockContrast *contrast, int nb)
{
  PetscFunctionBegin;
  for (int i = 0; i < nb; i++) contrast->ptr[i + 1] += contrast->ptr[i];
  PetscCall(PetscMalloc1(contrast->ptr[nb], &contrast->entries));
  PetscFunctionReturn(0);
}

/* Marks stiff unknowns */
static PetscErrorCode ContrastMarkAll(BlockLevel *level, const BlockRows *rows)
{
  PetscFunctionBegin;
  for (PetscInt u = 0; u < rows->n; u++) {
    const int p = level->position[u];

    for (PetscInt k = rows->ia[u]; k < rows->ia[u + 1]; k++) {
      const int q = level->position[rows->ja[k]];

      if (BlockDiffersMuch(level, p, q) && rows->a[k] != 0.0) PetscCall(BlockContrastMark_Private(level, p, q));
    }
    for (PetscInt k = rows->oia ? rows->oia[u] : 0; k < (rows->oia ? rows->oia[u + 1] : 0); k++) {
      const int q = 4 * level->nb + (int)rows->oja[k];

      if (BlockDiffersMuch(level, p, q) && rows->oa[k] != 0.0) PetscCall(BlockContrastMark_Private(level, p, q));
    }
  }
  PetscFunctionReturn(0);
}

/* Counts the entries of stiff unknowns in each block row of L, or stores them if next[] has the start of each row */
static void ContrastVisit(BlockLevel *level, const BlockRows *rows, double scale, int next[])
{
  for (PetscInt u = 0; u < rows->n; u++) {
    const int p = level->position[u];

    for (PetscInt k = rows->ia[u]; k < rows->ia[u + 1]; k++) {
      const int    q    = level->position[rows->ja[k]];
      const double left = level->scale[p] / scale;

      if (q / 4 >= p / 4 || rows->a[k] == 0.0 || !BlockHasContrast(level, p, q)) continue;
      if (next)
        level->contrast.entries[next[p / 4]++] =
          (BlockEntry){p, q, (float)(left * level->scale[q] * PetscRealPart(rows->a[k]))};
      else level->contrast.ptr[p / 4 + 1]++;
    }
  }
}

/* BlockContrastSet_Private - marks stiff unknowns of the level, and stores their entries of L divided by `scale` */
PetscErrorCode BlockContrastSet_Private(BlockLevel *level, const BlockRows *rows, double scale)
{
  BlockContrast *contrast = &level->contrast;
  int           *next;

  PetscFunctionBegin;
  PetscCall(ContrastMarkAll(level, rows));
  if (!contrast->stiff) PetscFunctionReturn(0);
  PetscCall(PetscCalloc1(level->nb + 1, &contrast->ptr));
  ContrastVisit(level, rows, scale, NULL);
  PetscCall(BlockContrastSetCounts_Private(contrast, level->nb));
  PetscCall(PetscMalloc1(level->nb, &next));
  PetscCall(PetscArraycpy(next, contrast->ptr, level->nb));
  ContrastVisit(level, rows, scale, next);
  PetscCall(PetscFree(next));
  PetscFunctionReturn(0);
}

/* BlockContrastMultiplyRow_Private - adds the product of the entries of block row i with x to y[4] */
void BlockContrastMultiplyRow_Private(const BlockContrast *contrast, int i, const float x[], float y[])
{
  for (int k = contrast->ptr[i]; k < contrast->ptr[i + 1]; k++) {
    const BlockEntry *e = &contrast->entries[k];

    y[e->row - 4 * i] += e->value * x[e->col];
  }
}

/* BlockContrastTransposeRow_Private - adds the product of the transposed block row i with x to t */
void BlockContrastTransposeRow_Private(const BlockContrast *contrast, int i, const float x[], float t[])
{
  for (int k = contrast->ptr[i]; k < contrast->ptr[i + 1]; k++) {
    const BlockEntry *e = &contrast->entries[k];

    t[e->col] += e->value * x[e->row];
  }
}

PetscErrorCode BlockContrastDestroy_Private(BlockContrast *contrast)
{
  PetscFunctionBegin;
  PetscCall(PetscFree(contrast->stiff));
  PetscCall(PetscFree(contrast->ptr));
  PetscCall(PetscFree(contrast->entries));
  PetscFunctionReturn(0);
}
