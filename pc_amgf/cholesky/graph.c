/* The graph of a symmetric matrix, and an order of its nodes */
#include "choleskyimpl.h"

PetscErrorCode CholeskyGraphDestroy(CholeskyGraph *g)
{
  PetscFunctionBegin;
  PetscCall(PetscFree2(g->start, g->neighbour));
  PetscFunctionReturn(0);
}

/* Creates the graph of a sequential AIJ matrix with a symmetric pattern. The block size is that of A if all rows of a
   block have the same columns, otherwise 1. */
PetscErrorCode CholeskyGraphCreate(Mat A, CholeskyGraph *g)
{
  PetscInt        rows, bs;
  const PetscInt *ia, *ja;
  PetscBool       done;

  PetscFunctionBegin;
  PetscCall(MatGetBlockSize(A, &bs));
  PetscCall(MatGetRowIJ(A, 0, PETSC_FALSE, PETSC_FALSE, &rows, &ia, &ja, &done));
  PetscCheck(done, PETSC_COMM_SELF, PETSC_ERR_SUP, "The matrix has no compressed sparse rows: use type aij");
  for (PetscInt i = 0; i < rows && bs > 1; i++) {
    const PetscInt head = i - i % bs, n = ia[i + 1] - ia[i];

    if (n % bs || n != ia[head + 1] - ia[head]) bs = 1;
    for (PetscInt k = 0; k < n && bs > 1; k++)
      if (ja[ia[i] + k] != ja[ia[head] + k] || ja[ia[i] + k] % bs != k % bs) bs = 1;
  }
  g->block = bs;
  g->n     = rows / bs;
  PetscCall(PetscMalloc2(g->n + 1, &g->start, ia[rows] / (bs * bs), &g->neighbour));
  g->start[0] = 0;
  for (PetscInt i = 0; i < g->n; i++) {
    PetscInt n = g->start[i];

    for (PetscInt k = ia[i * bs]; k < ia[i * bs + 1]; k += bs)
      if (ja[k] / bs != i) g->neighbour[n++] = ja[k] / bs;
    g->start[i + 1] = n;
  }
  PetscCall(MatRestoreRowIJ(A, 0, PETSC_FALSE, PETSC_FALSE, &rows, &ia, &ja, &done));
  PetscFunctionReturn(0);
}

/* Orders the nodes by nested dissection. perm[i]: the i-th node */
PetscErrorCode CholeskyGraphOrder(const CholeskyGraph *g, PetscInt perm[])
{
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
  PetscCall(MatGetOrdering(pattern, MATORDERINGND, &rows, &columns));
  PetscCall(ISGetIndices(rows, &order));
  PetscCall(PetscArraycpy(perm, order, g->n));
  PetscCall(ISRestoreIndices(rows, &order));
  PetscCall(ISDestroy(&rows));
  PetscCall(ISDestroy(&columns));
  PetscCall(MatDestroy(&pattern));
  PetscFunctionReturn(0);
}
