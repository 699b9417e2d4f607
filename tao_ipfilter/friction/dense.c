/*
   Solves the systems of system.c by a dense LU factorization, if they are small or GMRES fails. GMRES fails for soft
   bodies that are much stiffer in some motions than in others. A column of C is computed when it is needed first. Rows
   that are open or have no friction are left out.
*/
#include "frictionimpl.h"
#include <petscblaslapack.h>

/* Returns whether C and the factors fit into memory, and their computation takes acceptable time */
PetscBool IPTermDenseFits(const IPTermSystem *t)
{
  const PetscInt limit = 3000;

  return (PetscBool)(t->m <= limit);
}

/* Computes the columns C of n rows: R K_WW^-1 R^T e, by one solve for all of them. X, Y: work matrices of n columns */
static PetscErrorCode TermDenseMakeBlock(IPTermSystem *t, PetscInt n, const PetscInt rows[], Mat X, Mat Y)
{
  PetscScalar *x, *y;
  PetscInt     nw;

  PetscFunctionBegin;
  PetscCall(MatGetSize(X, &nw, NULL));
  PetscCall(MatZeroEntries(X));
  PetscCall(MatDenseGetArray(X, &x));
  for (PetscInt j = 0; j < n; j++) {
    const PetscInt    *columns;
    const PetscScalar *values;
    PetscInt           nc;

    PetscCall(MatGetRow(t->R, rows[j], &nc, &columns, &values));
    for (PetscInt c = 0; c < nc; c++) x[columns[c] + (size_t)j * (size_t)nw] = values[c];
    PetscCall(MatRestoreRow(t->R, rows[j], &nc, &columns, &values));
  }
  PetscCall(MatDenseRestoreArray(X, &x));
  PetscCall(MatMatSolve(t->FK, X, Y));
  PetscCall(MatDenseGetArray(Y, &y));
  for (PetscInt j = 0; j < n; j++) {
    PetscCall(VecPlaceArray(t->w, y + (size_t)j * (size_t)nw));
    PetscCall(VecPlaceArray(t->z, t->C + (size_t)rows[j] * (size_t)t->m));
    PetscCall(MatMult(t->R, t->w, t->z));
    PetscCall(VecResetArray(t->z));
    PetscCall(VecResetArray(t->w));
    t->computed[rows[j]] = PETSC_TRUE;
  }
  PetscCall(MatDenseRestoreArray(Y, &y));
  PetscFunctionReturn(0);
}

/* Computes those columns of C that are missing for the given rows */
static PetscErrorCode TermDenseMakeColumns(IPTermSystem *t, PetscInt n, const PetscInt rows[])
{
  const PetscInt most = 32; /* columns at a time: the work matrices then remain in the cache */
  PetscInt       nw, missing = 0, *list;

  PetscFunctionBegin;
  if (!t->C) {
    PetscCall(PetscMalloc1((size_t)t->m * (size_t)t->m, &t->C));
    PetscCall(PetscCalloc1(t->m, &t->computed));
  }
  PetscCall(PetscMalloc1(n, &list));
  for (PetscInt j = 0; j < n; j++)
    if (!t->computed[rows[j]]) list[missing++] = rows[j];
  PetscCall(MatGetSize(t->K, &nw, NULL));
  for (PetscInt done = 0; done < missing; done += most) {
    const PetscInt k = PetscMin(most, missing - done);
    Mat            X, Y;

    PetscCall(MatCreateSeqDense(PETSC_COMM_SELF, nw, k, NULL, &X));
    PetscCall(MatCreateSeqDense(PETSC_COMM_SELF, nw, k, NULL, &Y));
    PetscCall(TermDenseMakeBlock(t, k, list + done, X, Y));
    PetscCall(MatDestroy(&X));
    PetscCall(MatDestroy(&Y));
  }
  PetscCall(PetscFree(list));
  PetscFunctionReturn(0);
}

/*
   Assembles row i of the scaled dense matrix N. N has n rows of the system, followed by the directions, and columns of
   length n + k. place: position of each of the system's rows among the n, or negative.
*/
static PetscErrorCode TermDenseAssembleRow(IPTermSystem *t, const IPReducedSystem *s, PetscInt n, const PetscInt rows[],
  const PetscInt place[], PetscInt i, PetscReal N[])
{
  const PetscInt     ld = n + s->k, row = rows[i];
  const PetscInt    *columns;
  const PetscScalar *values;
  PetscInt           nc;

  PetscFunctionBegin;
  for (PetscInt j = 0; j < ld; j++) N[i + (size_t)j * (size_t)ld] = 0.0;
  PetscCall(MatGetRow(t->Bv, row, &nc, &columns, &values));
  for (PetscInt c = 0; c < nc; c++) {
    const PetscReal by_v = t->scale[row] * PetscRealPart(values[c]);

    if (by_v == 0.0) continue;
    for (PetscInt j = 0; j < n; j++)
      N[i + (size_t)j * (size_t)ld] += by_v * t->scale[rows[j]] * t->C[columns[c] + (size_t)rows[j] * (size_t)t->m];
    for (PetscInt j = 0; j < s->k; j++)
      N[i + (size_t)(n + j) * (size_t)ld] -= by_v * s->JZ[columns[c] + (size_t)j * (size_t)t->m];
  }
  PetscCall(MatRestoreRow(t->Bv, row, &nc, &columns, &values));
  PetscCall(MatGetRow(t->Bf, row, &nc, &columns, &values));
  for (PetscInt c = 0; c < nc; c++) {
    if (place[columns[c]] >= 0)
      N[i + (size_t)place[columns[c]] * (size_t)ld] += t->scale[row] * t->scale[columns[c]] * PetscRealPart(values[c]);
  }
  PetscCall(MatRestoreRow(t->Bf, row, &nc, &columns, &values));
  PetscFunctionReturn(0);
}

/* Assembles the scaled dense matrix N of n rows and the directions */
static PetscErrorCode TermDenseAssemble(IPTermSystem *t, const IPReducedSystem *s, PetscInt n, const PetscInt rows[],
  PetscReal N[])
{
  const PetscInt ld = n + s->k;
  PetscInt      *place;

  PetscFunctionBegin;
  PetscCall(PetscMalloc1(t->m, &place));
  for (PetscInt i = 0; i < t->m; i++) place[i] = -1;
  for (PetscInt i = 0; i < n; i++) place[rows[i]] = i;
  for (PetscInt i = 0; i < n; i++) PetscCall(TermDenseAssembleRow(t, s, n, rows, place, i, N));
  for (PetscInt i = 0; i < s->k; i++) {
    for (PetscInt j = 0; j < ld; j++)
      N[n + i + (size_t)j * (size_t)ld] =
        j < n ? t->scale[rows[j]] * s->JZ[rows[j] + (size_t)i * (size_t)t->m] : s->T[i + (j - n) * s->kmax];
    N[n + i + (size_t)(n + i) * (size_t)ld] += t->hold * s->G[i];
  }
  PetscCall(PetscFree(place));
  PetscFunctionReturn(0);
}

/* Overwrites r_f and r_y with the solution. *solved: false if the matrix is singular or has more than `most` rows. */
PetscErrorCode IPTermDenseSolve(IPTermSystem *t, const IPReducedSystem *s, PetscInt most, PetscReal rf[],
  PetscReal ry[], PetscBool *solved)
{
  PetscInt     n, *rows;
  PetscReal   *N, *x, *known;
  PetscBLASInt nb, one = 1, info, *pivots;

  PetscFunctionBegin;
  *solved = PETSC_FALSE;
  PetscCall(PetscMalloc2(t->m, &rows, t->m, &known));
  PetscCall(IPTermSystemFindCoupled(t, rf, &n, rows, known));
  if (n + s->k > most) {
    PetscCall(PetscFree2(rows, known));
    PetscFunctionReturn(0);
  }
  PetscCall(TermDenseMakeColumns(t, n, rows));
  PetscCall(IPTermSystemSubtract(t, s, known, rf, ry));
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

/* Returns whether all columns of C are computed */
PetscBool IPTermDenseIsComplete(const IPTermSystem *t)
{
  if (!t->C) return PETSC_FALSE;
  for (PetscInt i = 0; i < t->m; i++)
    if (!t->computed[i]) return PETSC_FALSE;
  return PETSC_TRUE;
}

/*
   Computes the inverse of C + shift I, with rows and columns scaled to a unit diagonal. N (m x m): only the lower
   triangle is set. *inverted: false if C is indefinite because of rounding errors.
*/
static PetscErrorCode TermDenseInvert(const IPTermSystem *t, const PetscReal scale[], PetscReal N[],
  PetscBool *inverted)
{
  const PetscReal shift = 1e-13;
  const size_t    m     = (size_t)t->m;
  PetscBLASInt    mb, info = 0;

  PetscFunctionBegin;
  PetscCall(PetscBLASIntCast(t->m, &mb));
  for (size_t j = 0; j < m; j++) {
    for (size_t i = j; i < m; i++)
      N[i + j * m] = 0.5 * scale[i] * scale[j] * (t->C[i + j * m] + t->C[j + i * m]) + (i == j ? shift : 0.0);
  }
  if (mb) PetscCallBLAS("LAPACKpotrf", LAPACKpotrf_("L", &mb, N, &mb, &info));
  if (mb && !info) PetscCallBLAS("LAPACKpotri", LAPACKpotri_("L", &mb, N, &mb, &info));
  *inverted = (PetscBool)!info;
  PetscFunctionReturn(0);
}

/*
   Replaces each compliance by that of the row with all other rows held, 1 / (C^-1)_ii. For bodies that bend or move as
   a whole this is far smaller than C_ii.
*/
static PetscErrorCode TermDenseCondense(IPTermSystem *t)
{
  const PetscReal least = 1e-12; /* smallest value relative to C_ii that is not rounding error */
  PetscReal      *N, *scale;
  PetscBool       inverted = PETSC_FALSE;

  PetscFunctionBegin;
  PetscCall(PetscMalloc2((size_t)t->m * (size_t)t->m, &N, t->m, &scale));
  for (PetscInt i = 0; i < t->m; i++) scale[i] = t->compliance[i] > 0.0 ? 1.0 / PetscSqrtReal(t->compliance[i]) : 0.0;
  for (PetscInt i = 0; i < t->m; i++) scale[i] = PetscIsInfOrNanReal(scale[i]) ? 0.0 : scale[i];
  PetscCall(TermDenseInvert(t, scale, N, &inverted));
  for (PetscInt i = 0; i < t->m && inverted; i++)
    t->compliance[i] *= PetscClipInterval(1.0 / N[(size_t)i * (size_t)(t->m + 1)], least, 1.0);
  PetscCall(PetscFree2(N, scale));
  PetscFunctionReturn(0);
}

/*
   Sets the compliances of the rows from C: to its diagonal or, if `held`, to the compliances with all other rows held.
   The estimates from the diagonal of K_WW are far too small for bodies that bend. *measured: false if C is too large.
*/
PetscErrorCode IPTermDenseMeasure(IPTermSystem *t, PetscBool held, PetscBool *measured)
{
  const PetscInt most = 1500;
  PetscInt      *rows;

  PetscFunctionBegin;
  *measured = (PetscBool)(t->m <= most);
  if (!*measured) PetscFunctionReturn(0);
  PetscCall(PetscMalloc1(t->m, &rows));
  for (PetscInt i = 0; i < t->m; i++) rows[i] = i;
  PetscCall(TermDenseMakeColumns(t, t->m, rows));
  for (PetscInt i = 0; i < t->m; i++) t->compliance[i] = PetscMax(0.0, t->C[i + (size_t)i * (size_t)t->m]);
  PetscCall(PetscFree(rows));
  if (held) PetscCall(TermDenseCondense(t));
  t->dense = PETSC_TRUE;
  PetscFunctionReturn(0);
}
