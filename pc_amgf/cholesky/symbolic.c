/* Order of the unknowns, and the rows of the supernodes */
#include "choleskyimpl.h"
#include <petscamgf.h>

/* Supernodes of nodes: first[], and the rows of each, its own columns included */
typedef struct {
  PetscInt n, *first, *nrows, **row;
} NodeBlocks;

PetscErrorCode CholeskyDestroy(Cholesky *c)
{
  PetscFunctionBegin;
  PetscCall(PetscFree2(c->perm, c->place));
  PetscCall(PetscFree4(c->first, c->parent, c->start, c->entry));
  PetscCall(PetscFree(c->row));
  PetscCall(PetscFree(c->L));
  PetscCall(PetscFree(c->rounded));
  PetscCall(PetscMemzero(c, sizeof(*c)));
  PetscFunctionReturn(0);
}

static PetscErrorCode NodeBlocksDestroy(NodeBlocks *b)
{
  PetscFunctionBegin;
  for (PetscInt s = 0; s < b->n; s++) PetscCall(PetscFree(b->row[s]));
  PetscCall(PetscFree3(b->first, b->nrows, b->row));
  PetscFunctionReturn(0);
}

/*
   Finds the rows of column j: those of the matrix, and those of the children of j in the tree. mark[i] = j for these
   rows; list: the rows after j, in ascending order
*/
static PetscErrorCode SymbolicMerge(const CholeskyGraph *g, PetscInt j, PetscInt node, const PetscInt place[],
  PetscInt nchildren, PetscInt *const child[], const PetscInt nchild[], PetscInt mark[], PetscInt list[], PetscInt *n)
{
  PetscFunctionBegin;
  *n      = 0;
  mark[j] = j;
  for (PetscInt k = g->start[node]; k < g->start[node + 1]; k++) {
    const PetscInt i = place[g->neighbour[k]];

    if (i < j || mark[i] == j) continue;
    mark[i]      = j;
    list[(*n)++] = i;
  }
  for (PetscInt c = 0; c < nchildren; c++) {
    for (PetscInt k = 0; k < nchild[c]; k++) {
      const PetscInt i = child[c][k];

      if (mark[i] == j) continue;
      mark[i]      = j;
      list[(*n)++] = i;
    }
  }
  PetscCall(PetscSortInt(*n, list));
  PetscFunctionReturn(0);
}

/* Computes the rows below the diagonal of each column of L: rows[j] are the nrows[j] rows of column j */
static PetscErrorCode SymbolicColumns(const CholeskyGraph *g, const PetscInt perm[], const PetscInt parent[],
  PetscInt *rows[], PetscInt nrows[])
{
  const PetscInt n = g->n;
  PetscInt      *place, *mark, *list, *nchild, *head, *next, **child;

  PetscFunctionBegin;
  PetscCall(PetscMalloc7(n, &place, n, &mark, n, &list, n, &nchild, n + 1, &head, n, &next, n, &child));
  for (PetscInt i = 0; i < n; i++) place[perm[i]] = i;
  for (PetscInt i = 0; i < n; i++) mark[i] = -1;
  for (PetscInt i = 0; i <= n; i++) head[i] = -1;
  for (PetscInt j = 0; j < n; j++) {
    PetscInt m = 0;

    for (PetscInt c = head[j]; c >= 0; c = next[c]) {
      child[m]    = rows[c];
      nchild[m++] = nrows[c];
    }
    PetscCall(SymbolicMerge(g, j, perm[j], place, m, child, nchild, mark, list, &nrows[j]));
    PetscCall(PetscMalloc1(nrows[j], &rows[j]));
    PetscCall(PetscArraycpy(rows[j], list, nrows[j]));
    next[j]         = head[parent[j]];
    head[parent[j]] = j;
  }
  PetscCall(PetscFree7(place, mark, list, nchild, head, next, child));
  PetscFunctionReturn(0);
}

/*
   Returns whether a supernode is merged with the next one: it must be its child, and few zeros may be added, as in
   CHOLMOD. before, own: numbers of columns of the supernode and of the next one; below, other: numbers of rows below
   the own columns of both
*/
static PetscBool SymbolicMayMerge(PetscInt before, PetscInt below, PetscInt own, PetscInt other)
{
  const PetscReal columns = (PetscReal)(before + own), rows = columns + (PetscReal)other;
  const PetscReal all   = columns * rows - 0.5 * columns * columns;
  const PetscReal zeros = (PetscReal)before * (PetscReal)(own + other - below);

  return (PetscBool)(columns <= 8.0 || zeros <= 0.05 * all || (columns <= 24.0 && zeros <= 0.4 * all) ||
                     (columns <= 48.0 && zeros <= 0.1 * all));
}

/* Divides the columns into supernodes, and frees the rows of single columns. */
static PetscErrorCode SymbolicBlocks(PetscInt n, PetscInt block, const PetscInt parent[], PetscInt *rows[],
  const PetscInt nrows[], NodeBlocks *b)
{
  PetscFunctionBegin;
  PetscCall(PetscMalloc3(n + 1, &b->first, n, &b->nrows, n, &b->row));
  b->n        = 0;
  b->first[0] = 0;
  for (PetscInt j = 0; j < n; j++) { /* [first[n], j] is the supernode so far, with the rows of j below it */
    const PetscInt columns = j + 1 - b->first[b->n];
    PetscInt      *row;

    if (j + 1 < n && parent[j] == j + 1 &&
        SymbolicMayMerge(block * columns, block * nrows[j], block, block * nrows[j + 1]))
      continue;
    PetscCall(PetscMalloc1(columns + nrows[j], &row));
    for (PetscInt i = 0; i < columns; i++) row[i] = b->first[b->n] + i;
    PetscCall(PetscArraycpy(row + columns, rows[j], nrows[j]));
    b->row[b->n]     = row;
    b->nrows[b->n++] = columns + nrows[j];
    b->first[b->n]   = j + 1;
  }
  PetscFunctionReturn(0);
}

/* Finds the supernodes for the order perm, which is changed (see CholeskyTree()) */
static PetscErrorCode SymbolicFind(const CholeskyGraph *g, PetscInt perm[], NodeBlocks *b)
{
  PetscInt *parent, *nrows, **rows;

  PetscFunctionBegin;
  PetscCall(PetscMalloc3(g->n, &parent, g->n, &nrows, g->n, &rows));
  PetscCall(CholeskyTree(g, perm, parent));
  PetscCall(SymbolicColumns(g, perm, parent, rows, nrows));
  PetscCall(SymbolicBlocks(g->n, g->block, parent, rows, nrows, b));
  for (PetscInt j = 0; j < g->n; j++) PetscCall(PetscFree(rows[j]));
  PetscCall(PetscFree3(parent, nrows, rows));
  PetscFunctionReturn(0);
}

/* Expands the supernodes of nodes to unknowns */
static PetscErrorCode SymbolicExpand(const CholeskyGraph *g, const PetscInt perm[], const NodeBlocks *b, Cholesky *c)
{
  const PetscInt bs = g->block;
  PetscInt      *of;

  PetscFunctionBegin;
  c->n      = g->n * bs;
  c->nsuper = b->n;
  c->flops  = 0.0;
  PetscCall(PetscMalloc2(c->n, &c->perm, c->n, &c->place));
  PetscCall(PetscMalloc4(b->n + 1, &c->first, b->n, &c->parent, b->n + 1, &c->start, b->n + 1, &c->entry));
  for (PetscInt i = 0; i < c->n; i++) c->perm[i] = perm[i / bs] * bs + i % bs;
  for (PetscInt i = 0; i < c->n; i++) c->place[c->perm[i]] = i;
  c->start[0] = c->entry[0] = 0;
  for (PetscInt s = 0; s < b->n; s++) {
    const size_t rows = (size_t)(bs * b->nrows[s]), columns = (size_t)(bs * (b->first[s + 1] - b->first[s]));

    c->tallest      = PetscMax(c->tallest, (PetscInt)rows);
    c->start[s + 1] = c->start[s] + rows;
    c->entry[s + 1] = c->entry[s] + rows * columns;
    c->flops +=
      (PetscReal)columns * ((PetscReal)rows * (PetscReal)(rows - columns) + PetscSqr((PetscReal)columns) / 3.0);
  }
  PetscCall(PetscMalloc1(c->start[b->n], &c->row));
  PetscCall(PetscMalloc1(g->n, &of));
  for (PetscInt s = 0; s < b->n; s++) {
    for (PetscInt k = 0; k < bs * b->nrows[s]; k++) c->row[c->start[s] + (size_t)k] = b->row[s][k / bs] * bs + k % bs;
    for (PetscInt j = b->first[s]; j < b->first[s + 1]; j++) of[j] = s;
  }
  for (PetscInt s = 0; s <= b->n; s++) c->first[s] = b->first[s] * bs;
  for (PetscInt s = 0; s < b->n; s++) {
    const PetscInt columns = b->first[s + 1] - b->first[s];

    c->parent[s] = columns < b->nrows[s] ? of[b->row[s][columns]] : b->n;
  }
  PetscCall(PetscFree(of));
  PetscFunctionReturn(0);
}

/* Orders the nodes by their coordinates if they are composed with A, otherwise by the graph alone */
static PetscErrorCode SymbolicOrder(Mat A, const CholeskyGraph *g, PetscInt perm[])
{
  PetscObject        given;
  const PetscScalar *x;
  PetscInt           n;

  PetscFunctionBegin;
  PetscCall(PetscObjectQuery((PetscObject)A, PCAMGF_COORDINATES_KEY, &given));
  if (given && g->block == 3) {
    PetscCall(VecGetLocalSize((Vec)given, &n));
    PetscCheck(n == 3 * g->n, PETSC_COMM_SELF, PETSC_ERR_ARG_SIZ,
      "The matrix has %" PetscInt_FMT " nodes, but %" PetscInt_FMT " coordinates are composed with it", g->n, n);
    PetscCall(VecGetArrayRead((Vec)given, &x));
    PetscCall(CholeskyDissect(g, x, perm));
    PetscCall(VecRestoreArrayRead((Vec)given, &x));
  } else PetscCall(CholeskyGraphOrder(g, perm));
  PetscFunctionReturn(0);
}

/* Orders the unknowns by nested dissection, and finds the supernodes */
PetscErrorCode CholeskySymbolic(Mat A, Cholesky *c)
{
  CholeskyGraph g;
  NodeBlocks    blocks;
  PetscInt     *perm;

  PetscFunctionBegin;
  PetscCall(CholeskyDestroy(c));
  PetscCall(CholeskyGraphCreate(A, &g));
  PetscCall(PetscMalloc1(g.n, &perm));
  PetscCall(SymbolicOrder(A, &g, perm));
  PetscCall(SymbolicFind(&g, perm, &blocks));
  PetscCall(SymbolicExpand(&g, perm, &blocks, c));
  PetscCall(NodeBlocksDestroy(&blocks));
  PetscCall(PetscFree(perm));
  PetscCall(CholeskyGraphDestroy(&g));
  PetscFunctionReturn(0);
}
