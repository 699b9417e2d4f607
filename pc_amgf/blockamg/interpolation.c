/*
   Stores the interpolation from the next coarser level, with rows and columns in the order of the two levels' block
   vectors, and scaled like these
*/
#include "blockamgimpl.h"

/*
   BlockInterpolationCreate_Private - sets level->P. The vectors of the next level are lengthened by the ghosts of the
   interpolation.

   Input Parameters:
   + level - the finer level
   . rows  - rows of the interpolation on this rank; columns are unknowns of the next level
   - next  - the next coarser level
*/
PetscErrorCode BlockInterpolationCreate_Private(BlockLevel *level, const BlockRows *rows, BlockLevel *next)
{
  BlockInterpolation *P     = &level->P;
  const PetscInt      ndiag = rows->n ? rows->ia[rows->n] : 0, noff = rows->n && rows->oia ? rows->oia[rows->n] : 0;
  float              *scale;

  PetscFunctionBegin;
  PetscCheck(ndiag + noff <= 2147483647, PETSC_COMM_SELF, PETSC_ERR_SUP,
    "PCBLOCKAMG: an interpolation has too many entries on one rank, %" PetscInt_FMT ": use more ranks", ndiag + noff);
  PetscCall(PetscCalloc1(4 * level->nb + 1, &P->ptr));
  PetscCall(PetscMalloc1(ndiag + noff, &P->col));
  PetscCall(PetscMalloc1(ndiag + noff, &P->val));
  for (int u = 0; u < level->n; u++)
    P->ptr[level->position[u] + 1] =
      (int)(rows->ia[u + 1] - rows->ia[u] + (rows->oia ? rows->oia[u + 1] - rows->oia[u] : 0));
  for (int i = 0; i < 4 * level->nb; i++) P->ptr[i + 1] += P->ptr[i];
  PetscCall(BlockHaloCreate_Private(rows->columns, rows->nghosts, rows->ghosts, next, &P->halo));
  next->nslots = PetscMax(next->nslots, 4 * next->nb + P->halo.nghosts);
  PetscCall(PetscMalloc1(4 * next->nb + P->halo.nghosts, &scale));
  PetscCall(PetscArraycpy(scale, next->scale, 4 * next->nb));
  PetscCall(BlockHaloFetch_Private(&P->halo, next, scale));
  for (int u = 0; u < level->n; u++) {
    const double inverse = 1.0 / level->scale[level->position[u]];
    int          p       = P->ptr[level->position[u]];

    for (PetscInt k = rows->ia[u]; k < rows->ia[u + 1]; k++, p++) {
      P->col[p] = next->position[rows->ja[k]];
      P->val[p] = (float)(inverse * scale[P->col[p]] * PetscRealPart(rows->a[k]));
    }
    for (PetscInt k = rows->oia ? rows->oia[u] : 0; k < (rows->oia ? rows->oia[u + 1] : 0); k++, p++) {
      P->col[p] = 4 * next->nb + (int)rows->oja[k];
      P->val[p] = (float)(inverse * scale[P->col[p]] * PetscRealPart(rows->oa[k]));
    }
  }
  PetscCall(PetscFree(scale));
  level->bytes += 8.0 * (double)(ndiag + noff) + 16.0 * level->nb;
  PetscFunctionReturn(0);
}

PetscErrorCode BlockInterpolationDestroy_Private(BlockInterpolation *P)
{
  PetscFunctionBegin;
  PetscCall(PetscFree(P->ptr));
  PetscCall(PetscFree(P->col));
  PetscCall(PetscFree(P->val));
  PetscCall(PetscSFDestroy(&P->halo.sf));
  PetscFunctionReturn(0);
}
