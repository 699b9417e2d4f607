/* Chooses which unknowns of a level form a block, and the order of the blocks */
#include "blockamgimpl.h"

/* BlockOrderNodes_Private - forms blocks of bs (3 or 4) consecutive unknowns */
PetscErrorCode BlockOrderNodes_Private(const BlockRows *rows, PetscInt bs, int position[])
{
  PetscFunctionBegin;
  for (PetscInt u = 0; u < rows->n; u++) position[u] = (int)(4 * (u / bs) + u % bs);
  PetscFunctionReturn(0);
}

/*
   Finds up to three unknowns without a position yet that share the most columns with the unknown `seed`. best[] has -1
   in place of missing ones. mark[j] = seed for the columns j of the seed.
*/
static void GroupFindNeighbours(const BlockRows *rows, PetscInt seed, const int position[], const PetscInt mark[],
  PetscInt best[3])
{
  PetscInt count[3] = {0, 0, 0};

  best[0] = best[1] = best[2] = -1;
  for (PetscInt k = rows->ia[seed]; k < rows->ia[seed + 1]; k++) {
    const PetscInt j = rows->ja[k];
    PetscInt       common, w;

    if (position[j] >= 0) continue;
    common = rows->ia[j] - rows->ia[j + 1];
    for (PetscInt m = rows->ia[j]; m < rows->ia[j + 1]; m++) common += mark[rows->ja[m]] == seed ? 2 : 0;
    for (w = 3; w > 0 && (best[w - 1] < 0 || common > count[w - 1]); w--) {
      if (w == 3) continue;
      best[w]  = best[w - 1];
      count[w] = count[w - 1];
    }
    if (w == 3) continue;
    best[w]  = j;
    count[w] = common;
  }
}

/*
   BlockOrderGroups_Private - forms blocks of up to 4 unknowns that have many columns in common. Each block consists of
   the first unknown without a position and up to three unknowns that share the most columns with it.
*/
PetscErrorCode BlockOrderGroups_Private(const BlockRows *rows, int position[])
{
  PetscInt *mark, best[3];
  int       next = 0;

  PetscFunctionBegin;
  PetscCall(PetscMalloc1(rows->n, &mark));
  for (PetscInt u = 0; u < rows->n; u++) {
    position[u] = -1;
    mark[u]     = -1;
  }
  for (PetscInt seed = 0; seed < rows->n; seed++) {
    if (position[seed] >= 0) continue;
    for (PetscInt k = rows->ia[seed]; k < rows->ia[seed + 1]; k++) mark[rows->ja[k]] = seed;
    position[seed] = next++;
    GroupFindNeighbours(rows, seed, position, mark, best);
    for (PetscInt w = 0; w < 3 && best[w] >= 0; w++) position[best[w]] = next++;
    next = (next + 3) / 4 * 4;
  }
  PetscCall(PetscFree(mark));
  PetscFunctionReturn(0);
}
