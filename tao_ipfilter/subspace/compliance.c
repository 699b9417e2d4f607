/* Compliance of the constraints on their own unknowns W: C = J_W K_WW^-1 J_W^T. Columns are computed on demand. All
   data are on the first rank. */
#include "subspaceimpl.h"
#include "pc_amgf/mumps.h"

PetscErrorCode IPComplianceDestroy(IPCompliance *c)
{
  PetscFunctionBegin;
  PetscCall(MatDestroy(&c->F));
  PetscCall(MatDestroy(&c->J));
  PetscCall(VecDestroy(&c->b));
  PetscCall(VecDestroy(&c->x));
  PetscCall(PetscFree(c->column));
  PetscCall(PetscFree(c->C));
  PetscCall(PetscMemzero(c, sizeof(*c)));
  PetscFunctionReturn(0);
}

/* Whether a factorization has no negative pivot. Cholesky factorizations of indefinite matrices succeed as L D L^T,
   without an error. */
static PetscErrorCode CompliancePositive(Mat F, PetscBool *positive)
{
  PetscInt negative;

  PetscFunctionBegin;
  PetscCall(MatGetInertia(F, &negative, NULL, NULL));
  *positive = (PetscBool)(negative == 0);
  PetscFunctionReturn(0);
}

/* Cholesky factorization of K_WW by MUMPS, or by PETSc in SBAIJ format, which counts pivots. *definite: false if
   K_WW is not positive definite */
static PetscErrorCode ComplianceFactor(Mat K, Mat *F, PetscBool *definite)
{
  MatFactorError error;
  MatFactorInfo  info;
  PetscBool      mumps;
  IS             rows = NULL, columns = NULL;
  Mat            A;

  PetscFunctionBegin;
  PetscCall(MatSetOption(K, MAT_SPD, PETSC_TRUE));
  PetscCall(AMGFMumpsFactors(MATSEQAIJ, MAT_FACTOR_CHOLESKY, &mumps));
  if (mumps) {
    PetscCall(PetscObjectReference((PetscObject)K));
    A = K;
  } else PetscCall(MatConvert(K, MATSEQSBAIJ, MAT_INITIAL_MATRIX, &A));
  PetscCall(MatGetFactor(A, mumps ? MATSOLVERMUMPS : MATSOLVERPETSC, MAT_FACTOR_CHOLESKY, F));
  PetscCall(MatFactorInfoInitialize(&info));
  if (!mumps) PetscCall(MatGetOrdering(A, MATORDERINGNATURAL, &rows, &columns));
  PetscCall(MatCholeskyFactorSymbolic(*F, A, rows, &info));
  PetscCall(MatCholeskyFactorNumeric(*F, A, &info));
  PetscCall(ISDestroy(&rows));
  PetscCall(ISDestroy(&columns));
  PetscCall(MatDestroy(&A));
  PetscCall(MatFactorGetError(*F, &error));
  *definite = (PetscBool)(error == MAT_FACTOR_NOERROR);
  if (*definite) PetscCall(CompliancePositive(*F, definite));
  PetscFunctionReturn(0);
}

/* Sets up for sequential K_WW and J_W; J_W is referenced. *definite: false if K_WW is not positive definite */
PetscErrorCode IPComplianceSetUp(IPCompliance *c, Mat K, Mat J, PetscBool *definite)
{
  PetscFunctionBegin;
  PetscCall(IPComplianceDestroy(c));
  PetscCall(ComplianceFactor(K, &c->F, definite));
  PetscCall(PetscObjectReference((PetscObject)J));
  c->J = J;
  PetscCall(MatGetSize(J, &c->m, &c->n));
  PetscCall(MatCreateVecs(K, &c->x, &c->b));
  PetscCall(PetscMalloc1(c->m, &c->column));
  for (PetscInt i = 0; i < c->m; i++) c->column[i] = -1;
  PetscFunctionReturn(0);
}

/* x = K_WW^-1 b */
PetscErrorCode IPComplianceSolve(IPCompliance *c, const PetscReal b[], PetscReal x[])
{
  PetscFunctionBegin;
  PetscCall(VecPlaceArray(c->b, b));
  PetscCall(VecPlaceArray(c->x, x));
  PetscCall(MatSolve(c->F, c->b, c->x));
  PetscCall(VecResetArray(c->x));
  PetscCall(VecResetArray(c->b));
  PetscFunctionReturn(0);
}

/* y = J_W x, or y = J_W^T x if transposed */
PetscErrorCode IPComplianceMultiply(IPCompliance *c, PetscBool transposed, const PetscReal x[], PetscReal y[])
{
  Vec vx, vy;

  PetscFunctionBegin;
  PetscCall(VecCreateSeqWithArray(PETSC_COMM_SELF, 1, transposed ? c->m : c->n, x, &vx));
  PetscCall(VecCreateSeqWithArray(PETSC_COMM_SELF, 1, transposed ? c->n : c->m, y, &vy));
  if (transposed) PetscCall(MatMultTranspose(c->J, vx, vy));
  else PetscCall(MatMult(c->J, vx, vy));
  PetscCall(VecDestroy(&vx));
  PetscCall(VecDestroy(&vy));
  PetscFunctionReturn(0);
}

/* Computes the columns of the given rows and appends them */
static PetscErrorCode ComplianceAppend(IPCompliance *c, PetscInt n, const PetscInt rows[])
{
  Mat          B, X;
  PetscScalar *b;

  PetscFunctionBegin;
  PetscCall(MatCreateSeqDense(PETSC_COMM_SELF, c->n, n, NULL, &B));
  PetscCall(MatDuplicate(B, MAT_DO_NOT_COPY_VALUES, &X));
  PetscCall(MatDenseGetArrayWrite(B, &b));
  PetscCall(PetscArrayzero(b, c->n * n));
  for (PetscInt k = 0; k < n; k++) {
    const PetscScalar *v;
    const PetscInt    *columns;
    PetscInt           nc;

    PetscCall(MatGetRow(c->J, rows[k], &nc, &columns, &v));
    for (PetscInt j = 0; j < nc; j++) b[columns[j] + k * c->n] = v[j];
    PetscCall(MatRestoreRow(c->J, rows[k], &nc, &columns, &v));
  }
  PetscCall(MatDenseRestoreArrayWrite(B, &b));
  PetscCall(MatMatSolve(c->F, B, X));
  PetscCall(MatDenseGetArray(X, &b));
  for (PetscInt k = 0; k < n; k++) {
    PetscCall(IPComplianceMultiply(c, PETSC_FALSE, b + k * c->n, c->C + (size_t)c->ncolumns * (size_t)c->m));
    c->column[rows[k]] = c->ncolumns++;
  }
  PetscCall(MatDenseRestoreArray(X, &b));
  PetscCall(MatDestroy(&B));
  PetscCall(MatDestroy(&X));
  PetscFunctionReturn(0);
}

/* Computes those columns of the given rows that are missing */
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
  }
  for (PetscInt k = 0; k < nmissing; k += chunk)
    PetscCall(ComplianceAppend(c, PetscMin(chunk, nmissing - k), missing + k));
  PetscCall(PetscFree(missing));
  PetscFunctionReturn(0);
}
