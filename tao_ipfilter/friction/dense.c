/* Solves the systems of system.c by a dense LU factorization where GMRES fails. That happens for soft bodies with
   very different stiffnesses along their motions. C is computed once. */
#include "frictionimpl.h"
#include <petscblaslapack.h>

/* Whether C and the factors fit into memory and take acceptable time */
PetscBool IPTermDenseFits(const IPTermSystem *t)
{
  const PetscInt limit = 3000;

  return (PetscBool)(t->m <= limit);
}

static PetscErrorCode TermDenseMakeCompliance(IPTermSystem *t)
{
  PetscFunctionBegin;
  if (t->C) PetscFunctionReturn(0);
  PetscCall(PetscMalloc1((size_t)t->m * (size_t)t->m, &t->C));
  PetscCall(PetscArrayzero(t->f, t->m));
  for (PetscInt j = 0; j < t->m; j++) {
    t->f[j] = 1.0;
    PetscCall(IPTermSystemApplyCompliance(t, t->f, t->C + (size_t)j * (size_t)t->m));
    t->f[j] = 0.0;
  }
  PetscFunctionReturn(0);
}

/* N += factor B_v columns, with rows scaled by the rows' scale and columns by `scale`; columns have length m */
static PetscErrorCode TermDenseMultiply(IPTermSystem *t, PetscInt n, const PetscReal columns[], PetscReal factor,
  const PetscReal scale[], PetscInt ld, PetscReal N[])
{
  PetscFunctionBegin;
  for (PetscInt j = 0; j < n; j++) {
    PetscReal *column = N + (size_t)j * (size_t)ld;

    PetscCall(VecPlaceArray(t->r, columns + (size_t)j * (size_t)t->m));
    PetscCall(VecPlaceArray(t->z, column));
    PetscCall(MatMult(t->Bv, t->r, t->z));
    PetscCall(VecResetArray(t->z));
    PetscCall(VecResetArray(t->r));
    for (PetscInt i = 0; i < t->m; i++) column[i] *= factor * t->scale[i] * (scale ? scale[j] : 1.0);
  }
  PetscFunctionReturn(0);
}

/* Assembles the scaled matrix; its columns have length m + k */
static PetscErrorCode TermDenseAssemble(IPTermSystem *t, const IPReducedSystem *s, PetscReal N[])
{
  const PetscInt m = t->m, k = s->k, ld = m + k;

  PetscFunctionBegin;
  PetscCall(TermDenseMultiply(t, m, t->C, 1.0, t->scale, ld, N));
  PetscCall(TermDenseMultiply(t, k, s->JZ, -1.0, NULL, ld, N + (size_t)m * (size_t)ld));
  for (PetscInt i = 0; i < m; i++) {
    const PetscInt    *columns;
    const PetscScalar *values;
    PetscInt           nc;

    PetscCall(MatGetRow(t->Bf, i, &nc, &columns, &values));
    for (PetscInt c = 0; c < nc; c++)
      N[i + (size_t)columns[c] * (size_t)ld] += t->scale[i] * t->scale[columns[c]] * PetscRealPart(values[c]);
    PetscCall(MatRestoreRow(t->Bf, i, &nc, &columns, &values));
    for (PetscInt j = 0; j < k; j++) N[m + j + (size_t)i * (size_t)ld] = t->scale[i] * s->JZ[i + (size_t)j * (size_t)m];
  }
  for (PetscInt j = 0; j < k; j++)
    PetscCall(PetscArraycpy(N + m + (size_t)(m + j) * (size_t)ld, s->T + j * s->kmax, k));
  PetscFunctionReturn(0);
}

/* Overwrites r_f and r_y with the solution. *solved: false if the matrix is singular */
PetscErrorCode IPTermDenseSolve(IPTermSystem *t, const IPReducedSystem *s, PetscReal rf[], PetscReal ry[],
  PetscBool *solved)
{
  const PetscInt m = t->m, k = s->k;
  PetscReal     *N, *x;
  PetscBLASInt   n, one = 1, info, *pivots;

  PetscFunctionBegin;
  PetscCall(TermDenseMakeCompliance(t));
  PetscCall(PetscBLASIntCast(m + k, &n));
  PetscCall(PetscMalloc3((size_t)n * (size_t)n, &N, n, &x, n, &pivots));
  PetscCall(TermDenseAssemble(t, s, N));
  for (PetscInt i = 0; i < m; i++) x[i] = t->scale[i] * rf[i];
  PetscCall(PetscArraycpy(x + m, ry, k));
  PetscCallBLAS("LAPACKgetrf", LAPACKgetrf_(&n, &n, N, &n, pivots, &info));
  *solved = (PetscBool)!info;
  if (*solved) {
    PetscCallBLAS("LAPACKgetrs", LAPACKgetrs_("N", &n, &one, N, &n, pivots, x, &n, &info));
    for (PetscInt i = 0; i < m; i++) rf[i] = t->scale[i] * x[i];
    PetscCall(PetscArraycpy(ry, x + m, k));
  }
  PetscCall(PetscFree3(N, x, pivots));
  PetscFunctionReturn(0);
}
