/* Inverses of small symmetric matrices, positive definite whatever the matrix is */
#include "blockamgimpl.h"
#include <petscblaslapack.h>

/*
   a = |A|^-1 from the eigenvalues of A. If A is positive definite, this is its inverse. An eigenvalue within rounding
   of zero contributes nothing.
*/
static PetscErrorCode InvertByEigenvalues(PetscBLASInt n, PetscScalar a[])
{
  PetscBLASInt lwork = 8 * n, info;
  PetscReal   *w;
  PetscScalar *work, *v;
  PetscReal    largest = 0.0;

  PetscFunctionBegin;
  PetscCall(PetscMalloc3(n, &w, lwork, &work, n * n, &v));
  PetscCall(PetscArraycpy(v, a, n * n));
  PetscCallBLAS("LAPACKsyev", LAPACKsyev_("V", "L", &n, v, &n, w, work, &lwork, &info));
  PetscCheck(info == 0, PETSC_COMM_SELF, PETSC_ERR_LIB, "LAPACKsyev: error %" PetscBLASInt_FMT, info);
  for (PetscBLASInt k = 0; k < n; k++) largest = PetscMax(largest, PetscAbsReal(w[k]));
  for (PetscBLASInt k = 0; k < n; k++)
    w[k] = PetscAbsReal(w[k]) > n * 100.0 * PETSC_MACHINE_EPSILON * largest ? 1.0 / PetscAbsReal(w[k]) : 0.0;
  for (PetscBLASInt i = 0; i < n; i++) {
    for (PetscBLASInt j = 0; j <= i; j++) {
      PetscScalar s = 0.0;

      for (PetscBLASInt k = 0; k < n; k++) s += v[n * k + i] * w[k] * v[n * k + j];
      a[n * i + j] = a[n * j + i] = s;
    }
  }
  PetscCall(PetscFree3(w, work, v));
  PetscFunctionReturn(0);
}

/*
   Gauss-Jordan without pivoting, for which positive definite matrices need none; returns whether all pivots are well
   above rounding errors
*/
static PetscBool InvertByElimination(PetscInt n, PetscScalar a[], const PetscScalar diagonal[])
{
  for (PetscInt p = 0; p < n; p++) {
    PetscScalar d = a[n * p + p];

    if (!(d > 1e-12 * diagonal[p])) return PETSC_FALSE;
    d            = 1.0 / d;
    a[n * p + p] = 1.0;
    for (PetscInt j = 0; j < n; j++) a[n * p + j] *= d;
    for (PetscInt i = 0; i < n; i++) {
      const PetscScalar f = a[n * i + p];

      if (i == p || f == 0.0) continue;
      a[n * i + p] = 0.0;
      for (PetscInt j = 0; j < n; j++) a[n * i + j] -= f * a[n * p + j];
    }
  }
  return PETSC_TRUE;
}

/*
  BlockInvert_Private - inverts a symmetric n x n matrix in place; the result is |A|^-1 if A is indefinite. Rows and
  columns of zeros stay zero.
*/
PetscErrorCode BlockInvert_Private(PetscInt n, PetscScalar a[])
{
  PetscScalar  few[40], *work = few, *packed, *diagonal;
  PetscInt     m = 0, used[BLOCKAMG_DENSE];
  PetscBLASInt order;

  PetscFunctionBegin;
  for (PetscInt i = 0; i < n; i++) {
    PetscBool zero = PETSC_TRUE;

    for (PetscInt j = 0; j < n && zero; j++) zero = (PetscBool)(a[n * i + j] == 0.0);
    if (!zero) used[m++] = i;
  }
  if (2 * m * m + m > 40) PetscCall(PetscMalloc1(2 * m * m + m, &work));
  packed   = work + m * m;
  diagonal = packed + m * m;
  for (PetscInt i = 0; i < m; i++) {
    for (PetscInt j = 0; j < m; j++) packed[m * i + j] = work[m * i + j] = a[n * used[i] + used[j]];
    diagonal[i] = work[m * i + i];
  }
  if (!InvertByElimination(m, work, diagonal)) {
    PetscCall(PetscBLASIntCast(m, &order));
    PetscCall(PetscArraycpy(work, packed, m * m));
    PetscCall(InvertByEigenvalues(order, work));
  }
  for (PetscInt i = 0; i < m; i++) {
    for (PetscInt j = 0; j < m; j++) a[n * used[i] + used[j]] = work[m * i + j];
  }
  if (work != few) PetscCall(PetscFree(work));
  PetscFunctionReturn(0);
}
