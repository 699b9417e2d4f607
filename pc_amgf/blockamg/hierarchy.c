/*
   Builds the hierarchy: converts BoomerAMG's matrices and interpolations level by level, and frees each as soon as it
   is converted
*/
#include "blockamgimpl.h"

/*
   Sets h->scale to the power of 2 above the largest diagonal entry, so that floats can represent the matrices in any
   units
*/
static PetscErrorCode HierarchySetScale(BlockHierarchy *h, Mat A)
{
  Vec       diagonal;
  PetscReal largest;
  int       exponent;

  PetscFunctionBegin;
  PetscCall(MatCreateVecs(A, &diagonal, NULL));
  PetscCall(MatGetDiagonal(A, diagonal));
  PetscCall(VecNorm(diagonal, NORM_INFINITY, &largest));
  PetscCall(VecDestroy(&diagonal));
  (void)frexp(largest, &exponent);
  h->scale = ldexp(1.0, exponent);
  PetscFunctionReturn(0);
}

/*
   Sets h->nlevels to the number of smoothed levels: all levels finer than the first one that is small enough for a
   dense inverse. *dense: there is such a level.
*/
static PetscErrorCode HierarchyCountLevels(BlockHierarchy *h, PetscInt nlevels, Mat coarse[], PetscBool *dense)
{
  PetscFunctionBegin;
  *dense = (PetscBool)(h->dense.N > 0);
  if (*dense) PetscFunctionReturn(0);
  for (h->nlevels = 1; h->nlevels < nlevels; h->nlevels++) {
    PetscInt N;

    PetscCall(MatGetSize(coarse[nlevels - 1 - h->nlevels], &N, NULL));
    *dense = (PetscBool)(N <= BLOCKAMG_DENSE);
    if (*dense) break;
  }
  PetscFunctionReturn(0);
}

static PetscErrorCode HierarchyConvertMatrix(BlockHierarchy *h, int i, Mat A, PetscInt bs)
{
  BlockRows rows;

  PetscFunctionBegin;
  PetscCall(BlockRowsGet_Private(A, &rows));
  if (i < h->nlevels) PetscCall(BlockLevelSetMatrix_Private(&h->levels[i], &rows, bs, h->scale));
  else PetscCall(BlockDenseCreate_Private(h, &rows));
  PetscCall(BlockRowsRestore_Private(&rows));
  PetscFunctionReturn(0);
}

static PetscErrorCode HierarchyConvertInterpolation(BlockHierarchy *h, int i, Mat P)
{
  BlockLevel *level = &h->levels[i], *next = i + 1 < h->nlevels ? &h->levels[i + 1] : &h->bottom;
  BlockRows   rows;

  PetscFunctionBegin;
  PetscCall(BlockRowsGet_Private(P, &rows));
  PetscCall(BlockInterpolationCreate_Private(level, &rows, next));
  PetscCall(BlockRowsRestore_Private(&rows));
  PetscCall(BlockLevelCreateVectors_Private(next));
  PetscFunctionReturn(0);
}

/* BlockHierarchyCreate_Private - creates the hierarchy of the operator A without any level */
PetscErrorCode BlockHierarchyCreate_Private(Mat A, BlockHierarchy **created)
{
  BlockHierarchy *h;
  PetscInt        N;

  PetscFunctionBegin;
  PetscCall(PetscNew(&h));
  *created = h;
  PetscCall(PetscObjectGetComm((PetscObject)A, &h->comm));
  PetscCallMPI(MPI_Comm_size(h->comm, &h->size));
  PetscCall(HierarchySetScale(h, A));
  PetscCall(MatGetSize(A, &N, NULL));
  h->nlevels = N > BLOCKAMG_DENSE;
  PetscCall(PetscCalloc1(h->nlevels, &h->levels));
  PetscFunctionReturn(0);
}

/*
   BlockHierarchySetFinest_Private - creates the finest level

   Input Parameters:
   + h  - the hierarchy
   . A  - the operator, of type AIJ or supported by BlockHalfSetLevel_Private()
   - bs - number of consecutive unknowns per node; 1 if that is not known
*/
PetscErrorCode BlockHierarchySetFinest_Private(BlockHierarchy *h, Mat A, PetscInt bs)
{
  PetscBool half;

  PetscFunctionBegin;
  PetscCall(BlockHalfSupports_Private(A, &half));
  if (half) PetscCall(BlockHalfSetLevel_Private(&h->levels[0], A, h->scale));
  else PetscCall(HierarchyConvertMatrix(h, 0, A, bs));
  PetscFunctionReturn(0);
}

/*
   BlockHierarchyAddLevels_Private - adds the coarser levels from the matrices of BoomerAMG, which are destroyed

   Input Parameters:
   + h              - the hierarchy, with its finest level
   . nlevels        - number of levels of BoomerAMG, including the finest one
   . coarse         - matrices of the other levels, the coarsest first; NULL afterwards
   - interpolations - interpolation to each level from the next coarser one, the coarsest first; NULL afterwards
*/
PetscErrorCode BlockHierarchyAddLevels_Private(BlockHierarchy *h, PetscInt nlevels, Mat coarse[], Mat interpolations[])
{
  PetscBool dense;
  int       last, fine = h->nlevels;

  PetscFunctionBegin;
  PetscCall(HierarchyCountLevels(h, nlevels, coarse, &dense));
  PetscCall(PetscRealloc((size_t)h->nlevels * sizeof(*h->levels), &h->levels));
  PetscCall(PetscArrayzero(h->levels + fine, h->nlevels - fine));
  last = h->nlevels - (dense ? 0 : 1);
  for (int i = (int)nlevels - 1; i > last; i--) { /* levels coarser than the one with the dense inverse are not used */
    PetscCall(MatDestroy(&coarse[nlevels - 1 - i]));
    PetscCall(MatDestroy(&interpolations[nlevels - 1 - i]));
  }
  for (int i = last; i >= 0; i--) {
    const PetscInt k = nlevels - 1 - i;

    if (i) {
      PetscCall(HierarchyConvertMatrix(h, i, coarse[k], 1));
      PetscCall(MatDestroy(&coarse[k]));
    }
    if (i < last) {
      PetscCall(HierarchyConvertInterpolation(h, i, interpolations[k - 1]));
      PetscCall(MatDestroy(&interpolations[k - 1]));
    }
  }
  PetscCall(BlockLevelCreateVectors_Private(h->nlevels ? &h->levels[0] : &h->bottom));
  PetscFunctionReturn(0);
}

/*
   BlockHierarchyIsFinite_Private - finds whether all values of the hierarchy are finite in single precision, on all
   ranks
*/
PetscErrorCode BlockHierarchyIsFinite_Private(const BlockHierarchy *h, PetscBool *finite)
{
  float largest = 0.0f, nan = 0.0f; /* nan: sum of 0 times each value, which is NaN if a value is not finite */

  PetscFunctionBegin;
  for (int i = 0; i < h->nlevels; i++) {
    const BlockLevel *l = &h->levels[i];

    for (size_t k = 0; k < 4 * (size_t)l->B * l->nb; k++) {
      largest = PetscMax(largest, PetscAbs(l->W[k]));
      nan += 0.0f * l->W[k];
    }
    for (size_t k = 0; k < 4 * (size_t)l->nb; k++) {
      largest = PetscMax(largest, l->scale[k]);
      nan += 0.0f * (l->unit[k] + l->scale[k]);
    }
    for (int k = 0; l->contrast.ptr && k < l->contrast.ptr[l->nb]; k++) nan += 0.0f * l->contrast.entries[k].value;
  }
  for (size_t k = 0; k < (size_t)h->dense.N * h->dense.N; k++) nan += 0.0f * h->dense.W[k];
  *finite = (PetscBool)(nan == 0.0f && largest < 1e15f);
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, finite, 1, MPI_PETSCBOOL, MPI_LAND, h->comm));
  PetscFunctionReturn(0);
}

PetscErrorCode BlockHierarchyDestroy_Private(BlockHierarchy **h)
{
  PetscFunctionBegin;
  if (!*h) PetscFunctionReturn(0);
  for (int i = 0; i < (*h)->nlevels; i++) PetscCall(BlockLevelDestroy_Private(&(*h)->levels[i]));
  PetscCall(PetscFree((*h)->levels));
  PetscCall(PetscFree((*h)->before));
  PetscCall(BlockLevelDestroy_Private(&(*h)->bottom));
  PetscCall(BlockDenseDestroy_Private(&(*h)->dense));
  PetscCall(PetscFree(*h));
  PetscFunctionReturn(0);
}
