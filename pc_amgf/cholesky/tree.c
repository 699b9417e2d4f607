/* The elimination tree: the parent of a column of L is its first row below the diagonal */
#include "choleskyimpl.h"

/* Computes the tree for the order perm. place: inverse of perm; root: work array */
static void TreeFindParents(const CholeskyGraph *g, const PetscInt perm[], const PetscInt place[], PetscInt root[],
  PetscInt parent[])
{
  for (PetscInt j = 0; j < g->n; j++) {
    const PetscInt node = perm[j];

    parent[j] = root[j] = g->n;
    for (PetscInt k = g->start[node]; k < g->start[node + 1]; k++) {
      PetscInt i = place[g->neighbour[k]];

      while (i < j && root[i] != j) { /* root[i]: an ancestor of column i (path compression) */
        const PetscInt next = root[i];

        root[i] = j;
        if (next == g->n) parent[i] = j;
        i = next;
      }
    }
  }
}

/* Numbers the columns in postorder: the descendants of a column come right before it. post[i]: the i-th column */
static PetscErrorCode TreePostorder(PetscInt n, const PetscInt parent[], PetscInt post[])
{
  PetscInt *child, *sibling, *stack, m = 0, depth = 0;

  PetscFunctionBegin;
  PetscCall(PetscMalloc3(n + 1, &child, n, &sibling, n + 1, &stack));
  for (PetscInt j = 0; j <= n; j++) child[j] = -1;
  for (PetscInt j = n - 1; j >= 0; j--) {
    sibling[j]       = child[parent[j]];
    child[parent[j]] = j;
  }
  stack[depth++] = n;
  while (depth) {
    const PetscInt j = stack[depth - 1], next = child[j];

    if (next >= 0) {
      child[j]       = sibling[next];
      stack[depth++] = next;
    } else {
      if (j < n) post[m++] = j;
      depth--;
    }
  }
  PetscCall(PetscFree3(child, sibling, stack));
  PetscFunctionReturn(0);
}

/* Computes the tree, and changes perm to postorder. parent[j]: parent of column j; n: column j has no parent */
PetscErrorCode CholeskyTree(const CholeskyGraph *g, PetscInt perm[], PetscInt parent[])
{
  const PetscInt n = g->n;
  PetscInt      *place, *work, *post;

  PetscFunctionBegin;
  PetscCall(PetscMalloc3(n + 1, &place, n, &work, n, &post));
  for (PetscInt i = 0; i < n; i++) place[perm[i]] = i;
  TreeFindParents(g, perm, place, work, parent);
  PetscCall(TreePostorder(n, parent, post));
  for (PetscInt i = 0; i < n; i++) place[post[i]] = i;
  place[n] = n;
  for (PetscInt i = 0; i < n; i++) work[i] = place[parent[post[i]]];
  PetscCall(PetscArraycpy(parent, work, n));
  for (PetscInt i = 0; i < n; i++) work[i] = perm[post[i]];
  PetscCall(PetscArraycpy(perm, work, n));
  PetscCall(PetscFree3(place, work, post));
  PetscFunctionReturn(0);
}
