/* Chooses which unknowns of a level form a block, and the order of the blocks */
#include "blockamgimpl.h"

/* BlockOrderNodes_Private - forms blocks of bs (3 or 4) consecutive unknowns */
PetscErrorCode BlockOrderNodes_Private(const BlockRows *rows, PetscInt bs, int position[])
{
  PetscFunctionBegin;
  for (PetscInt u = 0; u < rows->n; u++) position[u] = (int)(4 * (u / bs) + u % bs);
  PetscFunctionReturn(0);
}

/* Number of unknowns that are compared in detail before one enters a block */
#define ORDER_CANDIDATES 8

/* Candidates are chosen by one column in so many, in a quarter of the time of a choice by all columns */
#define ORDER_STEP 4

/* Marks the columns of unknown u as columns of the block that begins with `seed` */
static void GroupMark(const BlockRows *rows, PetscInt u, PetscInt seed, PetscInt mark[])
{
  for (PetscInt k = rows->ia[u]; k < rows->ia[u + 1]; k++) mark[rows->ja[k]] = seed;
}

/*
   Returns twice the number of columns that unknown j shares with the marked ones, minus the number of its columns,
   estimated from every `step`-th column
*/
static PetscInt GroupShared(const BlockRows *rows, PetscInt j, PetscInt seed, const PetscInt mark[], PetscInt step)
{
  PetscInt shared = rows->ia[j] - rows->ia[j + 1];

  for (PetscInt m = rows->ia[j]; m < rows->ia[j + 1]; m += step) shared += mark[rows->ja[m]] == seed ? 2 * step : 0;
  return shared;
}

/*
   Finds the unknowns without a position, among those coupled with `seed`, that share the most columns with it. Returns
   their number, at most ORDER_CANDIDATES.
*/
static int GroupFindCandidates(const BlockRows *rows, PetscInt seed, const int position[], const PetscInt mark[],
  PetscInt candidates[])
{
  PetscInt shared[ORDER_CANDIDATES];
  int      n = 0;

  for (PetscInt k = rows->ia[seed]; k < rows->ia[seed + 1]; k++) {
    const PetscInt j = rows->ja[k];
    PetscInt       s;
    int            w;

    if (position[j] >= 0) continue;
    s = GroupShared(rows, j, seed, mark, ORDER_STEP);
    if (n == ORDER_CANDIDATES && s <= shared[n - 1]) continue;
    if (n < ORDER_CANDIDATES) n++;
    for (w = n - 1; w > 0 && s > shared[w - 1]; w--) {
      candidates[w] = candidates[w - 1];
      shared[w]     = shared[w - 1];
    }
    candidates[w] = j;
    shared[w]     = s;
  }
  return n;
}

/* Finds the candidate without a position that shares the most columns with the block; -1 if there is none */
static PetscInt GroupFindBest(const BlockRows *rows, PetscInt seed, const int position[], const PetscInt mark[], int n,
  const PetscInt candidates[])
{
  PetscInt best = -1, most = 0;

  for (int w = 0; w < n; w++) {
    PetscInt shared;

    if (position[candidates[w]] >= 0) continue;
    shared = GroupShared(rows, candidates[w], seed, mark, 1);
    if (best >= 0 && shared <= most) continue;
    best = candidates[w];
    most = shared;
  }
  return best;
}

/*
   BlockOrderGroups_Private - forms blocks of up to 4 unknowns that have many columns in common. Each block begins with
   the first unknown without a position. Up to three more follow, each the one that shares the most columns with those
   before it.
*/
PetscErrorCode BlockOrderGroups_Private(const BlockRows *rows, int position[])
{
  PetscInt *mark, candidates[ORDER_CANDIDATES];
  int       next = 0;

  PetscFunctionBegin;
  PetscCall(PetscMalloc1(rows->n, &mark));
  for (PetscInt u = 0; u < rows->n; u++) {
    position[u] = -1;
    mark[u]     = -1;
  }
  for (PetscInt seed = 0; seed < rows->n; seed++) {
    int      n;
    PetscInt u;

    if (position[seed] >= 0) continue;
    position[seed] = next++;
    GroupMark(rows, seed, seed, mark);
    n = GroupFindCandidates(rows, seed, position, mark, candidates);
    u = n ? candidates[0] : -1;
    for (int w = 0; w < 3 && u >= 0; w++) {
      position[u] = next++;
      if (w == 2) break;
      GroupMark(rows, u, seed, mark);
      u = GroupFindBest(rows, seed, position, mark, n, candidates);
    }
    next = (next + 3) / 4 * 4;
  }
  PetscCall(PetscFree(mark));
  PetscFunctionReturn(0);
}
