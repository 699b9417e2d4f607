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

/*
   BlockContrastAdd_Private - counts an entry of L, or stores it, if one of its unknowns is stiff

   Input Parameters:
   + level - the level, with its stiff unknowns marked
   . p, q  - positions of the row and of the column
   . value - the entry divided by the scale of the hierarchy
   - next  - the next free entry of each block row; NULL to count
*/
void BlockContrastAdd_Private(BlockLevel *level, int p, int q, double value, int next[])
{
  BlockContrast *contrast = &level->contrast;

  if (value == 0.0 || !BlockHasContrast(level, p, q)) return;
  if (next)
    contrast->entries[next[p / 4]++] = (BlockEntry){p, q, (float)((double)level->scale[p] * level->scale[q] * value)};
  else contrast->ptr[p / 4 + 1]++;
}

/*
   BlockContrastReserve_Private - reserves memory for the entries that were counted. *next is the first entry of each
   block row. The caller destroys it.
*/
PetscErrorCode BlockContrastReserve_Private(BlockContrast *contrast, int nb, int **next)
{
  PetscFunctionBegin;
  for (int i = 0; i < nb; i++) contrast->ptr[i + 1] += contrast->ptr[i];
  PetscCall(PetscMalloc1(contrast->ptr[nb], &contrast->entries));
  PetscCall(PetscMalloc1(nb, next));
  PetscCall(PetscArraycpy(*next, contrast->ptr, nb));
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

/* Counts the entries of stiff unknowns in L if next is NULL, and stores them otherwise */
static void ContrastVisit(BlockLevel *level, const BlockRows *rows, double scale, int next[])
{
  for (PetscInt u = 0; u < rows->n; u++) {
    const int p = level->position[u];

    for (PetscInt k = rows->ia[u]; k < rows->ia[u + 1]; k++) {
      const int q = level->position[rows->ja[k]];

      if (q / 4 < p / 4) BlockContrastAdd_Private(level, p, q, PetscRealPart(rows->a[k]) / scale, next);
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
  PetscCall(BlockContrastReserve_Private(contrast, level->nb, &next));
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
