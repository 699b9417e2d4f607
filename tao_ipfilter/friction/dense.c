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
   Gets the coefficients of row `row` in the equation: at most three of the motions and three of the forces, times the
   row's scale. Entries that are not used are zero.
*/
static PetscErrorCode TermDenseGetRow(Mat B, PetscInt row, PetscReal scale, PetscInt columns[3], PetscReal values[3])
{
  const PetscInt    *at;
  const PetscScalar *a;
  PetscInt           nc;

  PetscFunctionBegin;
  PetscCall(MatGetRow(B, row, &nc, &at, &a));
  for (PetscInt c = 0; c < 3; c++) {
    columns[c] = c < nc ? at[c] : row;
    values[c]  = c < nc ? scale * PetscRealPart(a[c]) : 0.0;
  }
  PetscCall(MatRestoreRow(B, row, &nc, &at, &a));
  PetscFunctionReturn(0);
}

/*
   Assembles the scaled dense matrix N of n rows and the directions, column after column, so that memory is read and
   written in order. by_v: coefficients of the motions at; N has columns of length n + k.
*/
static void TermDenseAssembleMotions(const IPTermSystem *t, const IPReducedSystem *s, PetscInt n, const PetscInt rows[],
  PetscInt at[][3], PetscReal by_v[][3], PetscReal N[])
{
  const PetscInt ld = n + s->k;

  for (PetscInt j = 0; j < ld; j++) {
    const PetscReal *v      = j < n ? t->C + (size_t)rows[j] * (size_t)t->m : s->JZ + (size_t)(j - n) * (size_t)t->m;
    const PetscReal  scale  = j < n ? t->scale[rows[j]] : -1.0;
    PetscReal       *column = N + (size_t)j * (size_t)ld;

    for (PetscInt i = 0; i < n; i++)
      column[i] = scale * (by_v[i][0] * v[at[i][0]] + by_v[i][1] * v[at[i][1]] + by_v[i][2] * v[at[i][2]]);
    for (PetscInt i = 0; i < s->k; i++)
      column[n + i] = j < n ? scale * s->JZ[rows[j] + (size_t)i * (size_t)t->m] : s->T[i + (j - n) * s->kmax];
    if (j >= n) column[j] += t->hold * s->G[j - n];
  }
}

/*
   Assembles the scaled dense matrix N of n rows of the system, followed by the directions
*/
static PetscErrorCode TermDenseAssemble(IPTermSystem *t, const IPReducedSystem *s, PetscInt n, const PetscInt rows[],
  PetscReal N[])
{
  const PetscInt ld = n + s->k;
  PetscInt      *place, (*at)[3];
  PetscReal(*by)[3];

  PetscFunctionBegin;
  PetscCall(PetscMalloc3(t->m, &place, n, &at, n, &by));
  for (PetscInt i = 0; i < t->m; i++) place[i] = -1;
  for (PetscInt i = 0; i < n; i++) place[rows[i]] = i;
  for (PetscInt i = 0; i < n; i++) PetscCall(TermDenseGetRow(t->Bv, rows[i], t->scale[rows[i]], at[i], by[i]));
  TermDenseAssembleMotions(t, s, n, rows, at, by, N);
  for (PetscInt i = 0; i < n; i++) {
    PetscCall(TermDenseGetRow(t->Bf, rows[i], t->scale[rows[i]], at[i], by[i]));
    for (PetscInt c = 0; c < 3; c++) {
      const PetscInt j = place[at[i][c]];

      if (j >= 0) N[i + (size_t)j * (size_t)ld] += t->scale[at[i][c]] * by[i][c];
    }
  }
  PetscCall(PetscFree3(place, at, by));
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
