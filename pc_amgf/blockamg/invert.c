/* Inverses of small symmetric matrices as products W^T W, which remain positive semidefinite in single precision */
#include "blockamgimpl.h"
#include <petscblaslapack.h>

/*
   Computes W = C^-1 with A = C C^T, where C is lower triangular. Returns whether all pivots are well above rounding
   errors; otherwise w is undefined. Rows and columns of zeros remain zero.
*/
static PetscBool RootByElimination(PetscInt n, const PetscScalar a[], PetscScalar w[])
{
  for (PetscInt i = 0; i < n; i++) {
    for (PetscInt j = 0; j <= i; j++) {
      PetscScalar s = a[n * i + j];

      for (PetscInt k = 0; k < j; k++) s -= w[n * i + k] * w[n * j + k];
      if (i == j && (s != 0.0 || a[n * i + i] != 0.0) && !(s > 1e-12 * a[n * i + i])) return PETSC_FALSE;
      if (i > j && w[n * j + j] == 0.0 && s != 0.0) return PETSC_FALSE;
      w[n * i + j] = i == j ? PetscSqrtReal(PetscRealPart(s)) : s == 0.0 ? 0.0 : s / w[n * j + j];
    }
  }
  for (PetscInt i = 0; i < n; i++) { /* entries below row i still belong to C, those above already to W */
    const PetscScalar d = w[n * i + i] == 0.0 ? 0.0 : 1.0 / w[n * i + i];

    for (PetscInt j = 0; j < i; j++) {
      PetscScalar s = 0.0;

      for (PetscInt k = j; k < i; k++) s -= w[n * i + k] * w[n * k + j];
      w[n * i + j] = s * d;
    }
    w[n * i + i] = d;
    for (PetscInt j = i + 1; j < n; j++) w[n * i + j] = 0.0;
  }
  return PETSC_TRUE;
}

/*
   Computes W with W^T W = |A|^-1 from the eigenvalues of A, which may have any sign. Eigenvalues that are zero up to
   rounding contribute nothing.
*/
static PetscErrorCode RootByEigenvalues(PetscBLASInt n, const PetscScalar a[], PetscScalar v[])
{
  PetscBLASInt lwork = 8 * n, info;
  PetscReal   *w, largest = 0.0;
  PetscScalar *work;

  PetscFunctionBegin;
  PetscCall(PetscMalloc2(n, &w, lwork, &work));
  PetscCall(PetscArraycpy(v, a, n * n));
  PetscCallBLAS("LAPACKsyev", LAPACKsyev_("V", "L", &n, v, &n, w, work, &lwork, &info));
  PetscCheck(info == 0, PETSC_COMM_SELF, PETSC_ERR_LIB, "LAPACKsyev: error %" PetscBLASInt_FMT, info);
  for (PetscBLASInt k = 0; k < n; k++) largest = PetscMax(largest, PetscAbsReal(w[k]));
  for (PetscBLASInt k = 0; k < n; k++) { /* row k of v is eigenvector k */
    const PetscReal absolute = PetscAbsReal(w[k]);
    const PetscReal root = absolute > n * 100.0 * PETSC_MACHINE_EPSILON * largest ? 1.0 / PetscSqrtReal(absolute) : 0.0;

    for (PetscBLASInt j = 0; j < n; j++) v[n * k + j] *= root;
  }
  PetscCall(PetscFree2(w, work));
  PetscFunctionReturn(0);
}

/*
   BlockInvertRoot_Private - computes W with W^T W = |A|^-1 for a symmetric n x n matrix A. If A is positive definite,
   this is A^-1.

   Note:
   Rows and columns of zeros remain zero. The product is stored instead of A^-1, since A^-1 rounded to single precision
   may be indefinite if the condition number of A is 1e7 or more.
*/
PetscErrorCode BlockInvertRoot_Private(PetscInt n, const PetscScalar a[], PetscScalar W[])
{
  PetscBLASInt order;

  PetscFunctionBegin;
  if (RootByElimination(n, a, W)) PetscFunctionReturn(0);
  PetscCall(PetscBLASIntCast(n, &order));
  PetscCall(RootByEigenvalues(order, a, W));
  PetscFunctionReturn(0);
}
