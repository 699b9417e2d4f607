/*
   Compliance of the constraints on their own unknowns W: C = J_W K_WW^-1 J_W^T, with the compliance of the rows
   themselves on its diagonal. Columns are computed when they are
   needed first. All data are on the first rank.
*/
#include "subspaceimpl.h"
#include "pc_amgf/sparse_factors.h"
#include <petscblaslapack.h>

PetscErrorCode IPComplianceDestroy(IPCompliance *c)
{
  PetscFunctionBegin;
  PetscCall(IPComplianceSetRows(c, NULL, 0));
  PetscCall(MatDestroy(&c->F));
  PetscCall(PetscMemzero(c, sizeof(*c)));
  PetscFunctionReturn(0);
}

/*
   Computes the Cholesky factorization of K_WW. *F: factors of a matrix with the same nonzero pattern, or NULL.
   *definite: false if K_WW is not positive definite
*/
static PetscErrorCode ComplianceFactor(Mat K, Mat *F, PetscBool *definite)
{
  MatFactorError error;

  PetscFunctionBegin;
  PetscCall(AMGFSymmetricFactor(K, NULL, F, NULL, &error));
  *definite = (PetscBool)(error == MAT_FACTOR_NOERROR);
  PetscFunctionReturn(0);
}

/*
   Sets up for a sequential K_WW, without constraint rows. c->F: NULL, or factors of a matrix with the same nonzero
   pattern. *definite: false if K_WW is not positive definite.
*/
PetscErrorCode IPComplianceSetUp(IPCompliance *c, Mat K, PetscBool *definite)
{
  Mat F = c->F;

  PetscFunctionBegin;
  c->F = NULL;
  PetscCall(IPComplianceDestroy(c));
  c->F = F;
  PetscCall(ComplianceFactor(K, &c->F, definite));
  PetscCall(MatGetSize(K, &c->n, NULL));
  PetscFunctionReturn(0);
}

/*
   Finds whether K, which is not positive definite, has a clearly negative eigenvalue: it is not positive definite
   either after its diagonal is increased by a small part. K is otherwise singular, or has motions that stresses
   destabilize a little, as rotations of bodies that only contact holds.
*/
PetscErrorCode IPComplianceIsNegative(Mat K, PetscBool *negative)
{
  const PetscReal clearly = 1e-3;
  Mat             shifted, F = NULL;
  Vec             diagonal;
  PetscBool       definite = PETSC_FALSE;

  PetscFunctionBegin;
  PetscCall(MatDuplicate(K, MAT_COPY_VALUES, &shifted));
  PetscCall(MatCreateVecs(K, &diagonal, NULL));
  PetscCall(MatGetDiagonal(K, diagonal));
  PetscCall(VecScale(diagonal, clearly));
  PetscCall(VecAbs(diagonal));
  PetscCall(MatDiagonalSet(shifted, diagonal, ADD_VALUES));
  PetscCall(ComplianceFactor(shifted, &F, &definite));
  *negative = (PetscBool)!definite;
  PetscCall(MatDestroy(&F));
  PetscCall(MatDestroy(&shifted));
  PetscCall(VecDestroy(&diagonal));
  PetscFunctionReturn(0);
}

/* Sets the constraint rows J_W, a sequential matrix to which a reference is taken; NULL: there are none. most: number
   of columns up to which those of K_WW^-1 J_W^T are kept */
PetscErrorCode IPComplianceSetRows(IPCompliance *c, Mat J, PetscInt most)
{
  PetscFunctionBegin;
  PetscCall(MatDestroy(&c->J));
  PetscCall(PetscFree(c->column));
  PetscCall(PetscFree(c->C));
  PetscCall(PetscFree(c->X));
  PetscCall(PetscFree(c->own));
  c->m = c->ncolumns = c->maxcolumns = 0;
  c->most                            = most;
  if (!J) PetscFunctionReturn(0);
  PetscCall(PetscObjectReference((PetscObject)J));
  c->J = J;
  PetscCall(MatGetSize(J, &c->m, NULL));
  PetscCall(PetscMalloc1(c->m, &c->column));
  PetscCall(PetscCalloc1(c->m, &c->own));
  for (PetscInt i = 0; i < c->m; i++) c->column[i] = -1;
  PetscFunctionReturn(0);
}

/* Computes X = K_WW^-1 B for k columns */
PetscErrorCode IPComplianceSolve(IPCompliance *c, PetscInt k, const PetscReal b[], PetscReal x[])
{
  Mat B, X;

  PetscFunctionBegin;
  if (!k) PetscFunctionReturn(0);
  PetscCall(MatCreateSeqDense(PETSC_COMM_SELF, c->n, k, (PetscScalar *)b, &B)); /* B is only read */
  PetscCall(MatCreateSeqDense(PETSC_COMM_SELF, c->n, k, x, &X));
  PetscCall(MatMatSolve(c->F, B, X));
  PetscCall(MatDestroy(&B));
  PetscCall(MatDestroy(&X));
  PetscFunctionReturn(0);
}

/* Computes Y = J_W X for k columns */
PetscErrorCode IPComplianceMultiply(IPCompliance *c, PetscInt k, const PetscReal x[], PetscReal y[])
{
  Vec vx, vy;

  PetscFunctionBegin;
  PetscCall(VecCreateSeqWithArray(PETSC_COMM_SELF, 1, c->n, NULL, &vx));
  PetscCall(VecCreateSeqWithArray(PETSC_COMM_SELF, 1, c->m, NULL, &vy));
  for (PetscInt j = 0; j < k; j++) {
    PetscCall(VecPlaceArray(vx, x + (size_t)j * (size_t)c->n));
    PetscCall(VecPlaceArray(vy, y + (size_t)j * (size_t)c->m));
    PetscCall(MatMult(c->J, vx, vy));
    PetscCall(VecResetArray(vx));
    PetscCall(VecResetArray(vy));
  }
  PetscCall(VecDestroy(&vx));
  PetscCall(VecDestroy(&vy));
  PetscFunctionReturn(0);
}

/* Computes y = J_W^T x */
PetscErrorCode IPComplianceSpread(IPCompliance *c, const PetscReal x[], PetscReal y[])
{
  Vec vx, vy;

  PetscFunctionBegin;
  PetscCall(VecCreateSeqWithArray(PETSC_COMM_SELF, 1, c->m, x, &vx));
  PetscCall(VecCreateSeqWithArray(PETSC_COMM_SELF, 1, c->n, y, &vy));
  PetscCall(MatMultTranspose(c->J, vx, vy));
  PetscCall(VecDestroy(&vx));
  PetscCall(VecDestroy(&vy));
  PetscFunctionReturn(0);
}

/* Computes the columns of C for the given rows, and appends them */
static PetscErrorCode ComplianceAppend(IPCompliance *c, PetscInt n, const PetscInt rows[])
{
  PetscReal *b, *x = c->X + (size_t)c->ncolumns * (size_t)c->n;

  PetscFunctionBegin;
  PetscCall(PetscCalloc1((size_t)c->n * (size_t)n, &b));
  if (!c->most) PetscCall(PetscMalloc1((size_t)c->n * (size_t)n, &x));
  for (PetscInt k = 0; k < n; k++) {
    const PetscScalar *v;
    const PetscInt    *columns;
    PetscInt           nc;

    PetscCall(MatGetRow(c->J, rows[k], &nc, &columns, &v));
    for (PetscInt j = 0; j < nc; j++) b[columns[j] + k * c->n] = PetscRealPart(v[j]);
    PetscCall(MatRestoreRow(c->J, rows[k], &nc, &columns, &v));
  }
  PetscCall(IPComplianceSolve(c, n, b, x));
  PetscCall(IPComplianceMultiply(c, n, x, c->C + (size_t)c->ncolumns * (size_t)c->m));
  for (PetscInt k = 0; k < n; k++) {
    c->column[rows[k]] = c->ncolumns++;
    IPComplianceColumn(c, rows[k])[rows[k]] += c->own[rows[k]];
  }
  PetscCall(PetscFree(b));
  if (!c->most) PetscCall(PetscFree(x));
  PetscFunctionReturn(0);
}

/* Computes those columns of C that are missing for the given rows */
PetscErrorCode IPComplianceColumns(IPCompliance *c, PetscInt n, const PetscInt rows[])
{
  const PetscInt chunk = 64;
  PetscInt      *missing, nmissing = 0;

  PetscFunctionBegin;
  PetscCall(PetscMalloc1(n, &missing));
  for (PetscInt k = 0; k < n; k++)
    if (c->column[rows[k]] < 0) missing[nmissing++] = rows[k];
  if (c->ncolumns + nmissing > c->maxcolumns) {
    c->maxcolumns = PetscMin(c->m, c->ncolumns + 2 * nmissing);
    PetscCall(PetscRealloc((size_t)c->maxcolumns * (size_t)c->m * sizeof(PetscReal), &c->C));
    if (c->ncolumns + nmissing > c->most) {
      c->most = 0;
      PetscCall(PetscFree(c->X));
    } else PetscCall(PetscRealloc((size_t)c->maxcolumns * (size_t)c->n * sizeof(PetscReal), &c->X));
  }
  for (PetscInt k = 0; k < nmissing; k += chunk)
    PetscCall(ComplianceAppend(c, PetscMin(chunk, nmissing - k), missing + k));
  PetscCall(PetscFree(missing));
  PetscFunctionReturn(0);
}

/* x = K_WW^-1 J_W^T lambda, where lambda is zero in rows whose columns are not known. known: false if the columns are
   not kept, because there are too many */
PetscErrorCode IPComplianceExpand(const IPCompliance *c, const PetscReal lambda[], PetscReal x[], PetscBool *known)
{
  const PetscReal one = 1.0, zero = 0.0;
  PetscBLASInt    n, k, inc = 1;
  PetscReal      *a;

  PetscFunctionBegin;
  *known = (PetscBool)(c->most > 0);
  if (!*known) PetscFunctionReturn(0);
  PetscCall(PetscCalloc1(c->ncolumns, &a));
  for (PetscInt i = 0; i < c->m; i++)
    if (c->column[i] >= 0) a[c->column[i]] = lambda[i];
  PetscCall(PetscBLASIntCast(c->n, &n));
  PetscCall(PetscBLASIntCast(c->ncolumns, &k));
  PetscCall(PetscArrayzero(x, c->n));
  if (k) PetscCallBLAS("BLASgemv", BLASgemv_("N", &n, &k, &one, c->X, &n, a, &inc, &zero, x, &inc));
  PetscCall(PetscFree(a));
  PetscFunctionReturn(0);
}
