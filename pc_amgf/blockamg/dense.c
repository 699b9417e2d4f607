/* Solves the coarsest level by its dense inverse A^-1 = W^T W. Every rank holds all of W. */
#include "blockamgimpl.h"

/* Gathers the whole matrix, divided by h->scale, in full[] (N x N) on each rank */
static PetscErrorCode DenseGather(const BlockHierarchy *h, const BlockRows *rows, PetscScalar full[])
{
  const PetscInt N = h->dense.N, first = rows->columns->rstart;

  PetscFunctionBegin;
  for (PetscInt u = 0; u < rows->n; u++) {
    for (PetscInt k = rows->ia[u]; k < rows->ia[u + 1]; k++)
      full[N * (first + u) + first + rows->ja[k]] = rows->a[k] / h->scale;
    for (PetscInt k = rows->oia ? rows->oia[u] : 0; k < (rows->oia ? rows->oia[u + 1] : 0); k++)
      full[N * (first + u) + rows->ghosts[rows->oja[k]]] = rows->oa[k] / h->scale;
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, full, (PetscMPIInt)(N * N), MPIU_SCALAR, MPIU_SUM, h->comm));
  PetscFunctionReturn(0);
}

/*
   BlockDenseCreate_Private - creates the coarsest level and its inverse. The position of an unknown is its local
   number.
*/
PetscErrorCode BlockDenseCreate_Private(BlockHierarchy *h, const BlockRows *rows)
{
  BlockDense  *dense = &h->dense;
  BlockLevel  *level = &h->bottom;
  PetscScalar *full, *W;
  size_t       entries;

  PetscFunctionBegin;
  dense->N     = (int)rows->columns->N;
  dense->first = (int)rows->columns->rstart;
  level->n     = (int)rows->n;
  level->B     = 4;
  level->nb    = (level->n + 3) / 4;
  PetscCall(PetscMalloc1(level->n, &level->position));
  for (int u = 0; u < level->n; u++) level->position[u] = u;
  level->nslots = 4 * level->nb;
  PetscCall(PetscMalloc1(level->nslots, &level->scale));
  for (int p = 0; p < level->nslots; p++) level->scale[p] = 1.0f;
  PetscCall(PetscMalloc2(h->size, &dense->counts, h->size, &dense->starts));
  for (PetscMPIInt r = 0; r < h->size; r++) {
    dense->starts[r] = (PetscMPIInt)rows->columns->range[r];
    dense->counts[r] = (PetscMPIInt)(rows->columns->range[r + 1] - rows->columns->range[r]);
  }
  entries = (size_t)dense->N * dense->N;
  PetscCall(PetscMalloc1(entries, &W));
  PetscCall(PetscCalloc1(entries, &full));
  PetscCall(DenseGather(h, rows, full));
  PetscCall(BlockInvertRoot_Private(dense->N, full, W));
  PetscCall(PetscMalloc1(entries, &dense->W));
  PetscCall(PetscCalloc1(dense->N, &dense->b));
  for (size_t k = 0; k < entries; k++) dense->W[k] = (float)PetscRealPart(W[k]);
  PetscCall(PetscFree(full));
  PetscCall(PetscFree(W));
  level->unknowns = dense->N;
  level->entries = level->blocks = (double)entries;
  level->bytes                   = 4.0 * (double)entries * h->size;
  PetscFunctionReturn(0);
}

/* BlockDenseSolve_Private - computes x = W^T W b on the coarsest level */
PetscErrorCode BlockDenseSolve_Private(BlockHierarchy *h)
{
  const BlockDense *dense = &h->dense;
  const float      *b     = h->bottom.b;

  PetscFunctionBegin;
  if (h->size > 1) {
    PetscCallMPI(
      MPI_Allgatherv(h->bottom.b, h->bottom.n, MPI_FLOAT, dense->b, dense->counts, dense->starts, MPI_FLOAT, h->comm));
    b = dense->b;
  }
  BlockDenseMultiply_Private(dense->N, dense->W, b, dense->first, h->bottom.n, h->bottom.x);
  PetscFunctionReturn(0);
}

PetscErrorCode BlockDenseDestroy_Private(BlockDense *dense)
{
  PetscFunctionBegin;
  PetscCall(PetscFree(dense->W));
  PetscCall(PetscFree(dense->b));
  PetscCall(PetscFree2(dense->counts, dense->starts));
  PetscFunctionReturn(0);
}
