/*
   The multifrontal method. Each supernode has a dense matrix, its front: the sum of its entries of the matrix and of
   the updates of its children in the tree. The columns of the supernode are eliminated from the front. What remains is
   the update, which is added to the front of the parent.
*/
#include "choleskyimpl.h"
#include <petscblaslapack.h>

/* The updates that have not been added to a parent's front yet, in the order of the supernodes */
typedef struct {
  PetscInt    n, *supernode;
  PetscReal **update;
} NumericStack;

/* Adds the entries of A in the columns of supernode s. at: place of each row in the front */
static void NumericAddMatrix(const Cholesky *c, PetscInt s, const PetscInt ia[], const PetscInt ja[],
  const PetscScalar a[], const PetscInt at[], PetscReal L[])
{
  const PetscInt m = CholeskyRows(c, s);

  for (PetscInt j = c->first[s]; j < c->first[s + 1]; j++) {
    const PetscInt row    = c->perm[j];
    PetscReal     *column = L + (size_t)(j - c->first[s]) * (size_t)m;

    for (PetscInt k = ia[row]; k < ia[row + 1]; k++) {
      const PetscInt i = c->place[ja[k]];

      if (i >= j) column[at[i]] += PetscRealPart(a[k]);
    }
  }
}

/* Adds the update of a child to the front of s: to the columns of s in L, and to the rest U */
static void NumericAddUpdate(const Cholesky *c, PetscInt s, PetscInt child, const PetscInt at[],
  const PetscReal update[], PetscReal L[], PetscReal U[])
{
  const PetscInt  m = CholeskyRows(c, s), columns = CholeskyColumns(c, s), rest = m - columns;
  const PetscInt  own = CholeskyColumns(c, child), n = CholeskyRows(c, child) - own;
  const PetscInt *row = c->row + c->start[child] + own;

  for (PetscInt j = 0; j < n; j++) {
    const PetscInt   to   = at[row[j]];
    const PetscReal *from = update + (size_t)j * (size_t)n;
    PetscReal *column = to < columns ? L + (size_t)to * (size_t)m : U + (size_t)(to - columns) * (size_t)rest - columns;

    for (PetscInt i = j; i < n; i++) column[at[row[i]]] += from[i];
  }
}

/* Eliminates the columns of s: L L^T of its own rows, the rows below, and the update U. *positive: false if a pivot is
   not positive, whose row and value are then stored */
static PetscErrorCode NumericEliminate(Cholesky *c, PetscInt s, PetscReal L[], PetscReal U[], PetscBool *positive)
{
  const PetscReal one = 1.0, minus = -1.0;
  PetscBLASInt    m, columns, rest, info;

  PetscFunctionBegin;
  PetscCall(PetscBLASIntCast(CholeskyRows(c, s), &m));
  PetscCall(PetscBLASIntCast(CholeskyColumns(c, s), &columns));
  rest = m - columns;
  PetscCallBLAS("LAPACKpotrf", LAPACKpotrf_("L", &columns, L, &m, &info));
  *positive = (PetscBool)!info;
  if (info > 0) {
    c->failed = c->perm[c->first[s] + info - 1];
    c->pivot  = L[(size_t)(info - 1) * (size_t)(m + 1)];
  }
  if (info || !rest) PetscFunctionReturn(0);
  PetscCallBLAS("BLAStrsm", BLAStrsm_("R", "L", "T", "N", &rest, &columns, &one, L, &m, L + columns, &m));
  PetscCallBLAS("BLASsyrk", BLASsyrk_("L", "N", &rest, &columns, &minus, L + columns, &m, &one, U, &rest));
  PetscFunctionReturn(0);
}

/*
   Assembles the front of s, which takes the updates of its children from the stack, and eliminates its columns. L: zero
   on entry
*/
static PetscErrorCode NumericSupernode(Cholesky *c, PetscInt s, const PetscInt ia[], const PetscInt ja[],
  const PetscScalar a[], PetscInt at[], PetscReal L[], NumericStack *stack, PetscBool *positive)
{
  const PetscInt  m = CholeskyRows(c, s), rest = m - CholeskyColumns(c, s);
  const PetscInt *row = c->row + c->start[s];
  PetscReal      *U;

  PetscFunctionBegin;
  for (PetscInt i = 0; i < m; i++) at[row[i]] = i;
  PetscCall(PetscCalloc1((size_t)rest * (size_t)rest, &U));
  NumericAddMatrix(c, s, ia, ja, a, at, L);
  while (stack->n && c->parent[stack->supernode[stack->n - 1]] == s) {
    stack->n--;
    NumericAddUpdate(c, s, stack->supernode[stack->n], at, stack->update[stack->n], L, U);
    PetscCall(PetscFree(stack->update[stack->n]));
  }
  PetscCall(NumericEliminate(c, s, L, U, positive));
  stack->supernode[stack->n] = s;
  stack->update[stack->n++]  = U;
  PetscFunctionReturn(0);
}

/* Rounds the supernode s to single precision; its columns in L become zero */
static void NumericRound(Cholesky *c, PetscInt s, PetscReal L[])
{
  const PetscReal least = 1e-30; /* smaller numbers become zero: denormal numbers are slow */
  float          *to    = c->rounded + c->entry[s];
  const size_t    n     = c->entry[s + 1] - c->entry[s];

  for (size_t i = 0; i < n; i++) {
    to[i] = PetscAbsReal(L[i]) > least ? (float)L[i] : 0.0f;
    L[i]  = 0.0;
  }
}

/* Returns the largest number of entries of a supernode */
static size_t NumericLargest(const Cholesky *c)
{
  size_t largest = 0;

  for (PetscInt s = 0; s < c->nsuper; s++) largest = PetscMax(largest, c->entry[s + 1] - c->entry[s]);
  return largest;
}

/* Computes L for a sequential AIJ matrix. *positive: false if it is not positive definite; L is then not computed */
PetscErrorCode CholeskyNumeric(Mat A, Cholesky *c, PetscBool *positive)
{
  NumericStack       stack = {.n = 0};
  const PetscInt    *ia, *ja;
  const PetscScalar *a;
  PetscReal         *L;
  PetscInt           n, *at;
  PetscBool          done;

  PetscFunctionBegin;
  *positive = PETSC_TRUE;
  PetscCall(PetscFree(c->L));
  PetscCall(PetscFree(c->rounded));
  PetscCall(PetscCalloc1(c->single ? NumericLargest(c) : c->entry[c->nsuper], &L));
  if (c->single) PetscCall(PetscMalloc1(c->entry[c->nsuper], &c->rounded));
  PetscCall(PetscMalloc3(c->n, &at, c->nsuper, &stack.supernode, c->nsuper, &stack.update));
  PetscCall(MatGetRowIJ(A, 0, PETSC_FALSE, PETSC_FALSE, &n, &ia, &ja, &done));
  PetscCall(MatSeqAIJGetArrayRead(A, &a));
  for (PetscInt s = 0; s < c->nsuper && *positive; s++) {
    PetscCall(NumericSupernode(c, s, ia, ja, a, at, c->single ? L : L + c->entry[s], &stack, positive));
    if (c->single) NumericRound(c, s, L);
  }
  PetscCall(MatSeqAIJRestoreArrayRead(A, &a));
  PetscCall(MatRestoreRowIJ(A, 0, PETSC_FALSE, PETSC_FALSE, &n, &ia, &ja, &done));
  for (PetscInt k = 0; k < stack.n; k++) PetscCall(PetscFree(stack.update[k]));
  PetscCall(PetscFree3(at, stack.supernode, stack.update));
  if (c->single || !*positive) PetscCall(PetscFree(L));
  c->L = L;
  if (!*positive) PetscCall(PetscFree(c->rounded));
  PetscFunctionReturn(0);
}
