/* The hierarchy: BoomerAMG's matrices and interpolations, converted level by level; each is freed at once */
#include "blockamgimpl.h"

/* scale: power of 2 near the largest diagonal entry, so that floats can represent the matrices in any units */
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

/* Number of smoothed levels: those before the first that is small enough for a dense inverse */
static PetscErrorCode HierarchyCountLevels(BlockHierarchy *h, Mat A, PetscInt nlevels, Mat coarse[], PetscBool *dense)
{
  PetscFunctionBegin;
  *dense = PETSC_FALSE;
  for (h->nlevels = 0; h->nlevels < nlevels; h->nlevels++) {
    PetscInt N;

    PetscCall(MatGetSize(h->nlevels ? coarse[nlevels - 1 - h->nlevels] : A, &N, NULL));
    *dense = (PetscBool)(N <= BLOCKAMG_DENSE);
    if (*dense) break;
  }
  PetscFunctionReturn(0);
}

static PetscErrorCode HierarchyConvertLevel(BlockHierarchy *h, int i, Mat A, Mat P)
{
  BlockLevel *level = i < h->nlevels ? &h->levels[i] : &h->bottom,
             *next  = i + 1 < h->nlevels ? &h->levels[i + 1] : &h->bottom;
  BlockRows rows;
  PetscInt  bs = 1;

  PetscFunctionBegin;
  if (i == 0) PetscCall(MatGetBlockSize(A, &bs));
  PetscCall(BlockRowsGet_Private(A, &rows));
  if (i < h->nlevels) PetscCall(BlockLevelSetMatrix_Private(level, &rows, bs, h->scale));
  else PetscCall(BlockDenseCreate_Private(h, &rows));
  PetscCall(BlockRowsRestore_Private(&rows));
  if (!P) PetscFunctionReturn(0);
  PetscCall(BlockRowsGet_Private(P, &rows));
  PetscCall(BlockInterpolationCreate_Private(level, &rows, next));
  PetscCall(BlockRowsRestore_Private(&rows));
  PetscCall(BlockLevelCreateVectors_Private(next));
  PetscFunctionReturn(0);
}

/*
  BlockHierarchyCreate_Private - from what BoomerAMG has set up, which is destroyed

  Input Parameters:
+ A              - the operator
. nlevels        - levels of BoomerAMG, that of A among them
. coarse         - the matrices of the other levels, the coarsest first; NULL afterwards
- interpolations - to each level from the one below, the coarsest first; NULL afterwards
*/
PetscErrorCode BlockHierarchyCreate_Private(Mat A, PetscInt nlevels, Mat coarse[], Mat interpolations[],
  BlockHierarchy **created)
{
  BlockHierarchy *h;
  PetscBool       dense;
  int             last;

  PetscFunctionBegin;
  PetscCall(PetscNew(&h));
  *created = h;
  PetscCall(PetscObjectGetComm((PetscObject)A, &h->comm));
  PetscCallMPI(MPI_Comm_size(h->comm, &h->size));
  PetscCall(HierarchySetScale(h, A));
  PetscCall(HierarchyCountLevels(h, A, nlevels, coarse, &dense));
  PetscCall(PetscCalloc1(h->nlevels, &h->levels));
  last = h->nlevels - (dense ? 0 : 1);
  for (int i = (int)nlevels - 1; i > last; i--) { /* levels below the dense inverse are not used */
    PetscCall(MatDestroy(&coarse[nlevels - 1 - i]));
    PetscCall(MatDestroy(&interpolations[nlevels - 1 - i]));
  }
  for (int i = last; i >= 0; i--) {
    const PetscInt k = nlevels - 1 - i;

    PetscCall(HierarchyConvertLevel(h, i, i ? coarse[k] : A, i < last ? interpolations[k - 1] : NULL));
    if (i) PetscCall(MatDestroy(&coarse[k]));
    if (i < last) PetscCall(MatDestroy(&interpolations[k - 1]));
  }
  PetscCall(BlockLevelCreateVectors_Private(h->nlevels ? &h->levels[0] : &h->bottom));
  PetscFunctionReturn(0);
}

/*
   BlockHierarchyIsFinite_Private - whether all values of the hierarchy are finite in floats, on all ranks
*/
PetscErrorCode BlockHierarchyIsFinite_Private(const BlockHierarchy *h, PetscBool *finite)
{
  float largest = 0.0f, nan = 0.0f; /* 0 times a value that is not finite is NaN */

  PetscFunctionBegin;
  for (int i = 0; i < h->nlevels; i++) {
    const BlockLevel *l = &h->levels[i];

    for (size_t k = 0; k < 4 * (size_t)l->B * l->nb; k++) {
      largest = PetscMax(largest, PetscAbs(l->W[k]));
      nan += 0.0f * l->W[k];
    }
    for (size_t k = 0; k < (size_t)l->B * l->B * l->ptr[l->nb]; k++) nan += 0.0f * l->L[k];
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
  PetscCall(BlockLevelDestroy_Private(&(*h)->bottom));
  PetscCall(BlockDenseDestroy_Private(&(*h)->dense));
  PetscCall(PetscFree(*h));
  PetscFunctionReturn(0);
}
