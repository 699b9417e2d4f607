/* The graph of a symmetric matrix, and an order of its nodes */
#include "choleskyimpl.h"

PetscErrorCode CholeskyGraphDestroy(CholeskyGraph *g)
{
  PetscFunctionBegin;
  PetscCall(PetscFree2(g->start, g->neighbour));
  PetscFunctionReturn(0);
}

/* Returns the block size of the rows of A in compressed format if all rows of a block have the same columns,
   otherwise 1 */
static PetscInt GraphFindBlock(PetscInt bs, PetscInt rows, const PetscInt ia[], const PetscInt ja[])
{
  for (PetscInt i = 0; i < rows; i++) {
    const PetscInt head = i - i % bs, n = ia[i + 1] - ia[i];

    if (n % bs || n != ia[head + 1] - ia[head]) return 1;
    for (PetscInt k = 0; k < n; k++)
      if (ja[ia[i] + k] != ja[ia[head] + k] || ja[ia[i] + k] % bs != k % bs) return 1;
  }
  return bs;
}

/* Creates the graph of a sequential matrix of type AIJ, BAIJ or SBAIJ with a symmetric pattern. The block size is that
   of A if all rows of a block have the same columns, otherwise 1. */
PetscErrorCode CholeskyGraphCreate(Mat A, CholeskyGraph *g)
{
  PetscInt        rows, bs, step = 1;
  const PetscInt *ia, *ja;
  PetscBool       done, half, blocks;

  PetscFunctionBegin;
  PetscCall(MatGetBlockSize(A, &bs));
  PetscCall(PetscObjectBaseTypeCompare((PetscObject)A, MATSEQSBAIJ, &half));
  PetscCall(PetscObjectBaseTypeCompareAny((PetscObject)A, &blocks, MATSEQBAIJ, MATSEQSBAIJ, ""));
  PetscCall(MatGetRowIJ(A, 0, half, blocks, &rows, &ia, &ja, &done)); /* with blocks: their rows and columns */
  PetscCheck(done, PETSC_COMM_SELF, PETSC_ERR_SUP, "The matrix has no compressed sparse rows: use type aij");
  if (!blocks) step = bs = GraphFindBlock(bs, rows, ia, ja);
  g->block = bs;
  g->n     = rows / step;
  PetscCall(PetscMalloc2(g->n + 1, &g->start, ia[rows] / (step * step), &g->neighbour));
  g->start[0] = 0;
  for (PetscInt i = 0; i < g->n; i++) {
    PetscInt n = g->start[i];

    for (PetscInt k = ia[i * step]; k < ia[i * step + 1]; k += step)
      if (ja[k] / step != i) g->neighbour[n++] = ja[k] / step;
    g->start[i + 1] = n;
  }
  PetscCall(MatRestoreRowIJ(A, 0, half, blocks, &rows, &ia, &ja, &done));
  PetscFunctionReturn(0);
}

/* Finds the best ordering that is registered: METIS's, if PETSc or the program provides it. It halves the operations
   of PETSc's own nested dissection. */
static PetscErrorCode GraphOrderingType(MatOrderingType *type)
{
  PetscErrorCode (*metis)(Mat, MatOrderingType, IS *, IS *);
  PetscFunctionList list;

  PetscFunctionBegin;
  PetscCall(MatGetOrderingList(&list));
  PetscCall(PetscFunctionListFind(list, MATORDERINGMETISND, &metis));
  *type = metis ? MATORDERINGMETISND : MATORDERINGND;
  PetscFunctionReturn(0);
}

/* Orders the nodes by nested dissection. perm[i]: the i-th node */
PetscErrorCode CholeskyGraphOrder(const CholeskyGraph *g, PetscInt perm[])
{
  MatOrderingType type = MATORDERINGND;
  const PetscInt *order;
  PetscInt       *counts;
  PetscScalar    *zeros;
  IS              rows, columns;
  Mat             pattern;

  PetscFunctionBegin;
  PetscCall(PetscMalloc1(g->n, &counts));
  for (PetscInt i = 0; i < g->n; i++) counts[i] = g->start[i + 1] - g->start[i] + 1;
  PetscCall(MatCreateSeqAIJ(PETSC_COMM_SELF, g->n, g->n, 0, counts, &pattern));
  PetscCall(PetscCalloc1(g->start[g->n] + 1, &zeros));
  for (PetscInt i = 0; i < g->n; i++) {
    PetscCall(MatSetValue(pattern, i, i, 0.0, INSERT_VALUES));
    PetscCall(MatSetValues(pattern, 1, &i, counts[i] - 1, g->neighbour + g->start[i], zeros, INSERT_VALUES));
  }
  PetscCall(MatAssemblyBegin(pattern, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(pattern, MAT_FINAL_ASSEMBLY));
  PetscCall(PetscFree(zeros));
  PetscCall(PetscFree(counts));
  PetscCall(GraphOrderingType(&type));
  PetscCall(MatGetOrdering(pattern, type, &rows, &columns));
  PetscCall(ISGetIndices(rows, &order));
  PetscCall(PetscArraycpy(perm, order, g->n));
  PetscCall(ISRestoreIndices(rows, &order));
  PetscCall(ISDestroy(&rows));
  PetscCall(ISDestroy(&columns));
  PetscCall(MatDestroy(&pattern));
  PetscFunctionReturn(0);
}
