/* Solves the systems of system.c by a dense LU factorization where GMRES fails. That happens for soft bodies with
   very different stiffnesses along their motions. C is computed once. Rows that are open or have no friction are left
   out. */
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

/* rows: the n rows whose equation has more than their own force. Of the others the equation is b_f x = r_f, which
   gives x; x of the n rows is 0 */
static PetscErrorCode TermDenseFindCoupled(const IPTermSystem *t, const PetscReal rf[], PetscInt *n, PetscInt rows[],
  PetscReal x[])
{
  PetscFunctionBegin;
  *n = 0;
  for (PetscInt i = 0; i < t->m; i++) {
    const PetscInt    *columns;
    const PetscScalar *values;
    PetscInt           nc;
    PetscReal          own = 0.0, others = 0.0;

    PetscCall(MatGetRow(t->Bv, i, &nc, NULL, &values));
    for (PetscInt c = 0; c < nc; c++) others += PetscAbsScalar(values[c]);
    PetscCall(MatRestoreRow(t->Bv, i, &nc, NULL, &values));
    PetscCall(MatGetRow(t->Bf, i, &nc, &columns, &values));
    for (PetscInt c = 0; c < nc; c++) {
      if (columns[c] == i) own = PetscRealPart(values[c]);
      else others += PetscAbsScalar(values[c]);
    }
    PetscCall(MatRestoreRow(t->Bf, i, &nc, &columns, &values));
    x[i] = 0.0;
    if (others > 0.0) rows[(*n)++] = i;
    else x[i] = rf[i] / own;
  }
  PetscFunctionReturn(0);
}

/* a = B_v a with the rows' scale; a has length m */
static PetscErrorCode TermDenseMultiply(IPTermSystem *t, PetscReal a[])
{
  PetscScalar *z;

  PetscFunctionBegin;
  PetscCall(VecPlaceArray(t->r, a));
  PetscCall(MatMult(t->Bv, t->r, t->z));
  PetscCall(VecResetArray(t->r));
  PetscCall(VecGetArray(t->z, &z));
  for (PetscInt i = 0; i < t->m; i++) a[i] = t->scale[i] * PetscRealPart(z[i]);
  PetscCall(VecRestoreArray(t->z, &z));
  PetscFunctionReturn(0);
}

/* Assembles the scaled matrix of n rows and of the directions; its columns have length n + k */
static PetscErrorCode TermDenseAssemble(IPTermSystem *t, const IPReducedSystem *s, PetscInt n, const PetscInt rows[],
  PetscReal N[])
{
  const PetscInt k = s->k, ld = n + k;
  PetscInt      *place;

  PetscFunctionBegin;
  for (PetscInt j = 0; j < ld; j++) {
    const PetscReal *from   = j < n ? t->C + (size_t)rows[j] * (size_t)t->m : s->JZ + (size_t)(j - n) * (size_t)t->m;
    const PetscReal  factor = j < n ? t->scale[rows[j]] : -1.0;

    for (PetscInt i = 0; i < t->m; i++) t->v[i] = factor * from[i];
    PetscCall(TermDenseMultiply(t, t->v));
    for (PetscInt i = 0; i < n; i++) N[i + (size_t)j * (size_t)ld] = t->v[rows[i]];
    for (PetscInt i = 0; i < k; i++)
      N[n + i + (size_t)j * (size_t)ld] =
        j < n ? factor * s->JZ[rows[j] + (size_t)i * (size_t)t->m] : s->T[i + (j - n) * s->kmax];
  }
  PetscCall(PetscMalloc1(t->m, &place));
  for (PetscInt i = 0; i < t->m; i++) place[i] = -1;
  for (PetscInt i = 0; i < n; i++) place[rows[i]] = i;
  for (PetscInt i = 0; i < n; i++) {
    const PetscInt    *columns;
    const PetscScalar *values;
    PetscInt           nc;

    PetscCall(MatGetRow(t->Bf, rows[i], &nc, &columns, &values));
    for (PetscInt c = 0; c < nc; c++) {
      if (place[columns[c]] >= 0)
        N[i + (size_t)place[columns[c]] * (size_t)ld] +=
          t->scale[rows[i]] * t->scale[columns[c]] * PetscRealPart(values[c]);
    }
    PetscCall(MatRestoreRow(t->Bf, rows[i], &nc, &columns, &values));
  }
  PetscCall(PetscFree(place));
  PetscFunctionReturn(0);
}

/* Subtracts from r_f and r_y what the known forces x contribute */
static PetscErrorCode TermDenseSubtract(IPTermSystem *t, const IPReducedSystem *s, const PetscReal x[], PetscReal rf[],
  PetscReal ry[])
{
  PetscBool any = PETSC_FALSE;

  PetscFunctionBegin;
  for (PetscInt i = 0; i < t->m; i++) any = (PetscBool)(any || x[i] != 0.0);
  if (!any) PetscFunctionReturn(0);
  PetscCall(PetscArraycpy(t->f, x, t->m));
  PetscCall(IPTermSystemApplyCompliance(t, t->f, t->v));
  PetscCall(TermDenseMultiply(t, t->v));
  for (PetscInt i = 0; i < t->m; i++) {
    rf[i] -= t->v[i] / t->scale[i];
    for (PetscInt j = 0; j < s->k; j++) ry[j] -= s->JZ[i + (size_t)j * (size_t)t->m] * x[i];
  }
  PetscCall(VecPlaceArray(t->r, x));
  PetscCall(VecPlaceArray(t->z, t->v));
  PetscCall(MatMult(t->Bf, t->r, t->z));
  PetscCall(VecResetArray(t->z));
  PetscCall(VecResetArray(t->r));
  for (PetscInt i = 0; i < t->m; i++) rf[i] -= t->v[i];
  PetscFunctionReturn(0);
}

/* Overwrites r_f and r_y with the solution; *solved is false where the matrix is singular */
PetscErrorCode IPTermDenseSolve(IPTermSystem *t, const IPReducedSystem *s, PetscReal rf[], PetscReal ry[],
  PetscBool *solved)
{
  PetscInt     n, *rows;
  PetscReal   *N, *x, *known;
  PetscBLASInt nb, one = 1, info, *pivots;

  PetscFunctionBegin;
  PetscCall(TermDenseMakeCompliance(t));
  PetscCall(PetscMalloc2(t->m, &rows, t->m, &known));
  PetscCall(TermDenseFindCoupled(t, rf, &n, rows, known));
  PetscCall(TermDenseSubtract(t, s, known, rf, ry));
  PetscCall(PetscBLASIntCast(n + s->k, &nb));
  PetscCall(PetscMalloc3((size_t)nb * (size_t)nb, &N, nb, &x, nb, &pivots));
  PetscCall(TermDenseAssemble(t, s, n, rows, N));
  for (PetscInt i = 0; i < n; i++) x[i] = t->scale[rows[i]] * rf[rows[i]];
  PetscCall(PetscArraycpy(x + n, ry, s->k));
  info = 0;
  if (nb) PetscCallBLAS("LAPACKgetrf", LAPACKgetrf_(&nb, &nb, N, &nb, pivots, &info));
  *solved = (PetscBool)!info;
  if (*solved) {
    if (nb) PetscCallBLAS("LAPACKgetrs", LAPACKgetrs_("N", &nb, &one, N, &nb, pivots, x, &nb, &info));
    PetscCall(PetscArraycpy(rf, known, t->m));
    for (PetscInt i = 0; i < n; i++) rf[rows[i]] = t->scale[rows[i]] * x[i];
    PetscCall(PetscArraycpy(ry, x + n, s->k));
  }
  PetscCall(PetscFree3(N, x, pivots));
  PetscCall(PetscFree2(rows, known));
  PetscFunctionReturn(0);
}
