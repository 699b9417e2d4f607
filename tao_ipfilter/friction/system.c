/*
   The linear systems of Newton's method for the laws of laws.c. The unknowns are the changes of the forces f of all
   rows of R, and of y:
     (B_v C + B_f) f - B_v RZ y = r_f,   RZ^T f + T y = r_y,   C = R K_WW^-1 R^T.
   B_v and B_f consist of one block per constraint and its term. K_WW is factored, and C is applied without being
   formed. solve.c has the solver, factor.c the preconditioner.
*/
#include "frictionimpl.h"

PetscErrorCode IPTermSystemDestroy(IPTermSystem *t)
{
  PetscFunctionBegin;
  PetscCall(MatDestroy(&t->K));
  PetscCall(MatDestroy(&t->R));
  PetscCall(MatDestroy(&t->RD));
  PetscCall(MatDestroy(&t->G));
  PetscCall(MatDestroy(&t->Bv));
  PetscCall(MatDestroy(&t->Bf));
  PetscCall(MatDestroy(&t->Pv));
  PetscCall(MatDestroy(&t->Pf));
  PetscCall(MatDestroy(&t->A));
  PetscCall(MatDestroy(&t->F));
  PetscCall(MatDestroy(&t->FK));
  PetscCall(VecDestroy(&t->r));
  PetscCall(VecDestroy(&t->z));
  PetscCall(VecDestroy(&t->S));
  PetscCall(VecDestroy(&t->w));
  PetscCall(VecDestroy(&t->Kw));
  PetscCall(PetscFree4(t->compliance, t->scale, t->f, t->v));
  PetscCall(PetscFree4(t->V, t->ZV, t->H, t->pivots));
  PetscCall(PetscFree(t->C));
  PetscCall(PetscFree(t->computed));
  PetscCall(IPTermCholeskyDestroy(&t->cholesky));
  PetscCall(PetscMemzero(t, sizeof(*t)));
  PetscFunctionReturn(0);
}

/* Creates a zero matrix with a block for each constraint and its term */
static PetscErrorCode TermSystemCreateBlocks(PetscInt m, PetscInt n, Mat *B)
{
  const PetscScalar zeros[9] = {0.0};

  PetscFunctionBegin;
  PetscCall(MatCreateSeqAIJ(PETSC_COMM_SELF, m + 2 * n, m + 2 * n, 3, NULL, B));
  for (PetscInt i = 0; i < PetscMax(m, n); i++) {
    const PetscInt rows[3] = {i, m + 2 * i, m + 2 * i + 1}, first = i < m ? 0 : 1, last = i < n ? 3 : 1;

    PetscCall(MatSetValues(*B, last - first, rows + first, last - first, rows + first, zeros, INSERT_VALUES));
  }
  PetscCall(MatAssemblyBegin(*B, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(*B, MAT_FINAL_ASSEMBLY));
  PetscFunctionReturn(0);
}

/* Gets the inverse of the diagonal of K_WW. The caller destroys it. */
static PetscErrorCode TermSystemInvertDiagonal(const IPTermSystem *t, Vec *d)
{
  PetscFunctionBegin;
  PetscCall(MatCreateVecs(t->K, d, NULL));
  PetscCall(MatGetDiagonal(t->K, *d));
  PetscCall(VecReciprocal(*d));
  PetscFunctionReturn(0);
}

/* Computes the estimated compliances of all rows, diag(R D R^T) */
static PetscErrorCode TermSystemEstimateCompliance(IPTermSystem *t)
{
  const PetscScalar *d;
  Vec                inverse;

  PetscFunctionBegin;
  PetscCall(TermSystemInvertDiagonal(t, &inverse));
  PetscCall(VecGetArrayRead(inverse, &d));
  for (PetscInt i = 0; i < t->m; i++) {
    const PetscInt    *columns;
    const PetscScalar *values;
    PetscInt           nc;

    t->compliance[i] = 0.0;
    PetscCall(MatGetRow(t->R, i, &nc, &columns, &values));
    for (PetscInt c = 0; c < nc; c++)
      t->compliance[i] += PetscSqr(PetscRealPart(values[c])) * PetscRealPart(d[columns[c]]);
    PetscCall(MatRestoreRow(t->R, i, &nc, &columns, &values));
  }
  PetscCall(VecRestoreArrayRead(inverse, &d));
  PetscCall(VecDestroy(&inverse));
  PetscFunctionReturn(0);
}

/* Computes R D and G = R D R^T, with the nonzero pattern of the blocks included */
PetscErrorCode IPTermSystemMakeRows(IPTermSystem *t)
{
  Mat Rt, pattern;
  Vec d;

  PetscFunctionBegin;
  PetscCall(TermSystemInvertDiagonal(t, &d));
  PetscCall(MatDuplicate(t->R, MAT_COPY_VALUES, &t->RD));
  PetscCall(MatDiagonalScale(t->RD, NULL, d));
  PetscCall(VecDestroy(&d));
  PetscCall(MatTranspose(t->R, MAT_INITIAL_MATRIX, &Rt));
  PetscCall(MatMatMult(t->RD, Rt, MAT_INITIAL_MATRIX, PETSC_DEFAULT, &t->G));
  PetscCall(MatDestroy(&Rt));
  PetscCall(MatDuplicate(t->Bf, MAT_DO_NOT_COPY_VALUES, &pattern));
  PetscCall(MatAXPY(t->G, 1.0, pattern, DIFFERENT_NONZERO_PATTERN));
  PetscCall(MatDestroy(&pattern));
  PetscFunctionReturn(0);
}

/*
   Computes L U = K_WW by PETSc's LU, whose solves have little overhead. Large K_WW use the factors that exist already.
   *definite: whether all pivots are positive.
*/
static PetscErrorCode TermSystemFactorStiffness(IPTermSystem *t, Mat factors, PetscBool *definite)
{
  const PetscInt large = 1000;
  MatFactorInfo  info;
  MatFactorError error;
  IS             rows, columns;
  PetscReal      least = 0.0;
  PetscInt       n;

  PetscFunctionBegin;
  PetscCall(MatGetSize(t->K, &n, NULL));
  if (n >= large) {
    PetscCall(PetscObjectReference((PetscObject)factors));
    t->FK     = factors;
    *definite = PETSC_TRUE;
    PetscFunctionReturn(0);
  }
  PetscCall(MatFactorInfoInitialize(&info));
  info.fill = 5.0;
  PetscCall(MatGetFactor(t->K, MATSOLVERPETSC, MAT_FACTOR_LU, &t->FK));
  PetscCall(MatGetOrdering(t->K, MATORDERINGND, &rows, &columns));
  PetscCall(MatLUFactorSymbolic(t->FK, t->K, rows, columns, &info));
  PetscCall(MatLUFactorNumeric(t->FK, t->K, &info));
  PetscCall(MatFactorGetError(t->FK, &error));
  if (!error) {
    PetscCall(MatGetDiagonal(t->FK, t->w));
    PetscCall(VecMin(t->w, NULL, &least));
  }
  *definite = (PetscBool)(!error && !(least < 0.0));
  PetscCall(ISDestroy(&rows));
  PetscCall(ISDestroy(&columns));
  PetscFunctionReturn(0);
}

/*
   Sets up the system for the sequential matrices K = K_WW and R. R has m rows of constraints, followed by two rows for
   each of n terms. kmax: largest number of directions. factors: of K_WW, which are positive definite. *definite: false
   if K_WW is not positive definite after all.
*/
PetscErrorCode IPTermSystemSetUp(IPTermSystem *t, PetscInt m, PetscInt n, PetscInt kmax, Mat K, Mat factors, Mat R,
  PetscBool *definite)
{
  PetscFunctionBegin;
  PetscCall(IPTermSystemDestroy(t));
  PetscCall(PetscObjectReference((PetscObject)K));
  PetscCall(PetscObjectReference((PetscObject)R));
  t->K            = K;
  t->R            = R;
  t->m            = m + 2 * n;
  t->nconstraints = m;
  t->nterms       = n;
  PetscCall(MatCreateVecs(R, &t->w, &t->r));
  PetscCall(VecDuplicate(t->w, &t->Kw));
  PetscCall(VecDuplicate(t->r, &t->z));
  PetscCall(VecDuplicate(t->r, &t->S));
  PetscCall(PetscMalloc4(t->m, &t->compliance, t->m, &t->scale, t->m, &t->f, t->m, &t->v));
  PetscCall(
    PetscMalloc4((size_t)t->m * (size_t)kmax, &t->V, kmax * kmax, &t->ZV, kmax * kmax, &t->H, kmax, &t->pivots));
  PetscCall(TermSystemCreateBlocks(m, n, &t->Bv));
  PetscCall(TermSystemCreateBlocks(m, n, &t->Bf));
  PetscCall(TermSystemEstimateCompliance(t));
  PetscCall(TermSystemFactorStiffness(t, factors, definite));
  PetscFunctionReturn(0);
}

/*
   Sets the coefficients by_v and by_f of one row, in the n <= 3 columns of its constraint and its term, and the row's
   scale. With springs D in K_WW the unknowns of the system are changes of f + D v, of which f is f + D v - D v.
*/
PetscErrorCode IPTermSystemSetRow(IPTermSystem *t, PetscInt row, PetscInt n, const PetscInt columns[],
  const PetscReal by_v[], const PetscReal by_f[], PetscReal scale)
{
  PetscReal v[3];

  PetscFunctionBegin;
  for (PetscInt c = 0; c < n; c++) v[c] = by_v[c] - (t->spring ? by_f[c] * t->spring[columns[c]] : 0.0);
  PetscCall(MatSetValues(t->Bv, 1, &row, n, columns, v, INSERT_VALUES));
  PetscCall(MatSetValues(t->Bf, 1, &row, n, columns, by_f, INSERT_VALUES));
  t->scale[row] = scale;
  PetscFunctionReturn(0);
}

/* Assembles B_v and B_f after all rows have been set */
PetscErrorCode IPTermSystemAssemble(IPTermSystem *t)
{
  const Mat B[2] = {t->Bv, t->Bf};

  PetscFunctionBegin;
  for (PetscInt k = 0; k < 2; k++) {
    PetscCall(MatAssemblyBegin(B[k], MAT_FINAL_ASSEMBLY));
    PetscCall(MatAssemblyEnd(B[k], MAT_FINAL_ASSEMBLY));
  }
  PetscFunctionReturn(0);
}

/* Computes v = C f */
PetscErrorCode IPTermSystemApplyCompliance(IPTermSystem *t, const PetscReal f[], PetscReal v[])
{
  PetscFunctionBegin;
  PetscCall(VecPlaceArray(t->r, f));
  PetscCall(MatMultTranspose(t->R, t->r, t->w));
  PetscCall(VecResetArray(t->r));
  PetscCall(MatSolve(t->FK, t->w, t->Kw));
  PetscCall(VecPlaceArray(t->z, v));
  PetscCall(MatMult(t->R, t->Kw, t->z));
  PetscCall(VecResetArray(t->z));
  PetscFunctionReturn(0);
}

/*
   Finds the n rows whose equation contains more than their own force. The equation of any other row is b_f x = r_f,
   which gives its force x. x is zero in the n rows.
*/
PetscErrorCode IPTermSystemFindCoupled(const IPTermSystem *t, const PetscReal rf[], PetscInt *n, PetscInt rows[],
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

/* Computes a = scale B_v a for an array a with an entry per row */
PetscErrorCode IPTermSystemMultiplyMotions(IPTermSystem *t, PetscReal a[])
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

/* Subtracts the contribution of the known forces x from r_f and r_y */
PetscErrorCode IPTermSystemSubtract(IPTermSystem *t, const IPReducedSystem *s, const PetscReal x[], PetscReal rf[],
  PetscReal ry[])
{
  PetscBool any = PETSC_FALSE;

  PetscFunctionBegin;
  for (PetscInt i = 0; i < t->m; i++) any = (PetscBool)(any || x[i] != 0.0);
  if (!any) PetscFunctionReturn(0);
  PetscCall(PetscArraycpy(t->f, x, t->m));
  PetscCall(IPTermSystemApplyCompliance(t, t->f, t->v));
  PetscCall(IPTermSystemMultiplyMotions(t, t->v));
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
