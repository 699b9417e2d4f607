/*
   Forward and backward substitution for several right-hand sides, with columns of length n in the order of L.
   Supernodes whose right-hand sides are zero are skipped in the forward substitution: for loads on few unknowns it
   visits only their ancestors in the tree.
*/
#include "choleskyimpl.h"
#include <petscblaslapack.h>

static PetscBool SubstituteIsZero(PetscInt n, PetscInt columns, PetscInt k, const PetscReal x[])
{
  for (PetscInt c = 0; c < k; c++)
    for (PetscInt j = 0; j < columns; j++)
      if (x[j + (size_t)c * (size_t)n] != 0.0) return PETSC_FALSE;
  return PETSC_TRUE;
}

/* Solves L x = b; x is b on entry. work: k times the largest number of rows of a supernode */
PetscErrorCode CholeskyForward(const Cholesky *c, PetscInt k, PetscReal x[], PetscReal work[])
{
  const PetscReal one = 1.0, zero = 0.0;
  PetscBLASInt    n, m, columns, rest, nk;

  PetscFunctionBegin;
  PetscCall(PetscBLASIntCast(c->n, &n));
  PetscCall(PetscBLASIntCast(k, &nk));
  for (PetscInt s = 0; s < c->nsuper; s++) {
    const PetscReal *L   = c->L + c->entry[s];
    const PetscInt  *row = c->row + c->start[s] + CholeskyColumns(c, s);
    PetscReal       *own = x + c->first[s];

    if (SubstituteIsZero(c->n, CholeskyColumns(c, s), k, own)) continue;
    m       = (PetscBLASInt)CholeskyRows(c, s);
    columns = (PetscBLASInt)CholeskyColumns(c, s);
    rest    = m - columns;
    PetscCallBLAS("BLAStrsm", BLAStrsm_("L", "L", "N", "N", &columns, &nk, &one, L, &m, own, &n));
    if (!rest) continue;
    PetscCallBLAS("BLASgemm",
      BLASgemm_("N", "N", &rest, &nk, &columns, &one, L + columns, &m, own, &n, &zero, work, &rest));
    for (PetscInt v = 0; v < k; v++) {
      PetscReal       *to   = x + (size_t)v * (size_t)c->n;
      const PetscReal *from = work + (size_t)v * (size_t)rest;

      for (PetscInt i = 0; i < rest; i++) to[row[i]] -= from[i];
    }
  }
  PetscFunctionReturn(0);
}

/* Solves L^T x = b; x is b on entry. work: as above */
PetscErrorCode CholeskyBackward(const Cholesky *c, PetscInt k, PetscReal x[], PetscReal work[])
{
  const PetscReal one = 1.0, minus = -1.0;
  PetscBLASInt    n, m, columns, rest, nk;

  PetscFunctionBegin;
  PetscCall(PetscBLASIntCast(c->n, &n));
  PetscCall(PetscBLASIntCast(k, &nk));
  for (PetscInt s = c->nsuper - 1; s >= 0; s--) {
    const PetscReal *L   = c->L + c->entry[s];
    const PetscInt  *row = c->row + c->start[s] + CholeskyColumns(c, s);
    PetscReal       *own = x + c->first[s];

    m       = (PetscBLASInt)CholeskyRows(c, s);
    columns = (PetscBLASInt)CholeskyColumns(c, s);
    rest    = m - columns;
    for (PetscInt v = 0; v < k; v++) {
      const PetscReal *from = x + (size_t)v * (size_t)c->n;
      PetscReal       *to   = work + (size_t)v * (size_t)rest;

      for (PetscInt i = 0; i < rest; i++) to[i] = from[row[i]];
    }
    if (rest)
      PetscCallBLAS("BLASgemm",
        BLASgemm_("T", "N", &columns, &nk, &rest, &minus, L + columns, &m, work, &rest, &one, own, &n));
    PetscCallBLAS("BLAStrsm", BLAStrsm_("L", "L", "T", "N", &columns, &nk, &one, L, &m, own, &n));
  }
  PetscFunctionReturn(0);
}
