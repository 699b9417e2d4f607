/*
   The linear systems of Newton's method on the laws of termset.c, for changes of the forces f of all rows R and of y,

     (B_v C + B_f) f - B_v RZ y = r_f,   RZ^T f + T y = r_y,   C = R K_WW^-1 R^T,

   B_v and B_f made of blocks of a constraint and its term, by GMRES: C is applied, K_WW being factored, and no dense matrix is made of it. The preconditioner
   is what the lumped one is to FETI (Farhat and Roux, A method of finite element tearing and interconnecting and its parallel solution algorithm, 1991),

     (B_v C + B_f)^-1 ~ A^-1 (B_v R D K_WW D R^T + B_f) A^-1,   A = B_v R D R^T + B_f,   D = diag(K_WW)^-1,

   exact were R square, and H = T + RZ^T (...)^-1 B_v RZ with it for y. A is sparse, and like a mass matrix: ILU(0) does. The condition number is a small one
   whatever the mesh. Old factors serve other B_v and B_f for as long as GMRES is quick with them.
*/
#include "ipfilterimpl.h"
#include <petscblaslapack.h>

/* What the shells of a solve know */
typedef struct {
  IPTermSystem          *system;
  const IPReducedSystem *s;
} TermSolve;

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
  PetscCall(PetscFree4(t->gives, t->scale, t->f, t->v));
  PetscCall(PetscFree4(t->V, t->ZV, t->H, t->pivots));
  PetscCall(PetscMemzero(t, sizeof(*t)));
  PetscFunctionReturn(0);
}

/* A matrix of all rows with the blocks of a constraint and its term, zeros */
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

/* R D, and G = R D R^T with the blocks in it; what each row gives way by, were its unknowns alone */
static PetscErrorCode TermSystemMakeRows(IPTermSystem *t)
{
  const PetscScalar *a;
  Mat                Rt;
  Vec                d;

  PetscFunctionBegin;
  PetscCall(MatCreateVecs(t->K, &d, NULL));
  PetscCall(MatGetDiagonal(t->K, d));
  PetscCall(VecReciprocal(d));
  PetscCall(MatDuplicate(t->R, MAT_COPY_VALUES, &t->RD));
  PetscCall(MatDiagonalScale(t->RD, NULL, d));
  PetscCall(VecDestroy(&d));
  PetscCall(MatTranspose(t->R, MAT_INITIAL_MATRIX, &Rt));
  PetscCall(MatMatMult(t->RD, Rt, MAT_INITIAL_MATRIX, PETSC_DEFAULT, &t->G));
  PetscCall(MatDestroy(&Rt));
  PetscCall(MatAXPY(t->G, 0.0, t->Bf, DIFFERENT_NONZERO_PATTERN));
  PetscCall(MatGetDiagonal(t->G, t->r));
  PetscCall(VecGetArrayRead(t->r, &a));
  for (PetscInt i = 0; i < t->m; i++) t->gives[i] = PetscRealPart(a[i]);
  PetscCall(VecRestoreArrayRead(t->r, &a));
  PetscFunctionReturn(0);
}

/* L U = K_WW by PETSc's own, which spends little on a solve */
static PetscErrorCode TermSystemFactorStiffness(IPTermSystem *t)
{
  MatFactorInfo info;
  IS            rows, columns;

  PetscFunctionBegin;
  PetscCall(MatFactorInfoInitialize(&info));
  info.fill = 5.0;
  PetscCall(MatGetFactor(t->K, MATSOLVERPETSC, MAT_FACTOR_LU, &t->FK));
  PetscCall(MatGetOrdering(t->K, MATORDERINGND, &rows, &columns));
  PetscCall(MatLUFactorSymbolic(t->FK, t->K, rows, columns, &info));
  PetscCall(MatLUFactorNumeric(t->FK, t->K, &info));
  PetscCall(ISDestroy(&rows));
  PetscCall(ISDestroy(&columns));
  PetscFunctionReturn(0);
}

/* Of sequential K_WW and R, the rows of m constraints and below them two a term, n terms; with room for so many directions */
PetscErrorCode IPTermSystemSetUp(IPTermSystem *t, PetscInt m, PetscInt n, PetscInt kmax, Mat K, Mat R)
{
  PetscFunctionBegin;
  PetscCall(IPTermSystemDestroy(t));
  PetscCall(PetscObjectReference((PetscObject)K));
  PetscCall(PetscObjectReference((PetscObject)R));
  t->K = K;
  t->R = R;
  t->m = m + 2 * n;
  PetscCall(MatCreateVecs(R, &t->w, &t->r));
  PetscCall(VecDuplicate(t->w, &t->Kw));
  PetscCall(VecDuplicate(t->r, &t->z));
  PetscCall(VecDuplicate(t->r, &t->S));
  PetscCall(PetscMalloc4(t->m, &t->gives, t->m, &t->scale, t->m, &t->f, t->m, &t->v));
  PetscCall(PetscMalloc4((size_t)t->m * (size_t)kmax, &t->V, kmax * kmax, &t->ZV, kmax * kmax, &t->H, kmax, &t->pivots));
  PetscCall(TermSystemCreateBlocks(m, n, &t->Bv));
  PetscCall(TermSystemCreateBlocks(m, n, &t->Bf));
  PetscCall(TermSystemMakeRows(t));
  PetscCall(TermSystemFactorStiffness(t));
  PetscFunctionReturn(0);
}

/* Coefficients of one row: of v and of f, at the rows of its constraint and its term, n <= 3 */
PetscErrorCode IPTermSystemSetRow(IPTermSystem *t, PetscInt row, PetscInt n, const PetscInt columns[], const PetscReal by_v[], const PetscReal by_f[], PetscReal scale)
{
  PetscFunctionBegin;
  PetscCall(MatSetValues(t->Bv, 1, &row, n, columns, by_v, INSERT_VALUES));
  PetscCall(MatSetValues(t->Bf, 1, &row, n, columns, by_f, INSERT_VALUES));
  t->scale[row] = scale;
  PetscFunctionReturn(0);
}

/* The rows are as they are to be */
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

/* Incomplete factors of A in the rows' scale, which makes its diagonal 1 or so: it is as well conditioned as a mass matrix */
static PetscErrorCode TermSystemFactorRows(IPTermSystem *t, PetscBool *factored)
{
  const PetscReal tiny = 1e-12;
  MatFactorInfo   info;
  MatFactorError  error;
  IS              rows, columns;
  PetscScalar    *scale;

  PetscFunctionBegin;
  PetscCall(MatFactorInfoInitialize(&info));
  info.fill        = 1.0;
  info.shifttype   = (PetscReal)MAT_SHIFT_NONZERO;
  info.shiftamount = info.zeropivot = tiny;
  PetscCall(VecGetArrayWrite(t->S, &scale));
  PetscCall(PetscArraycpy(scale, t->scale, t->m));
  PetscCall(VecRestoreArrayWrite(t->S, &scale));
  PetscCall(MatDiagonalScale(t->A, t->S, t->S));
  if (!t->F) {
    PetscCall(MatGetFactor(t->A, MATSOLVERPETSC, MAT_FACTOR_ILU, &t->F));
    PetscCall(MatGetOrdering(t->A, MATORDERINGNATURAL, &rows, &columns));
    PetscCall(MatILUFactorSymbolic(t->F, t->A, rows, columns, &info));
    PetscCall(ISDestroy(&rows));
    PetscCall(ISDestroy(&columns));
  }
  PetscCall(MatLUFactorNumeric(t->F, t->A, &info));
  PetscCall(MatFactorGetError(t->F, &error));
  *factored = (PetscBool)(error == MAT_FACTOR_NOERROR);
  PetscFunctionReturn(0);
}

/* The factors of A for the present B_v and B_f, which are kept beside them; *factored is false where A is singular */
static PetscErrorCode TermSystemFactor(IPTermSystem *t, PetscBool *factored)
{
  PetscFunctionBegin;
  PetscCall(MatDestroy(&t->Pv));
  PetscCall(MatDestroy(&t->Pf));
  PetscCall(MatDuplicate(t->Bv, MAT_COPY_VALUES, &t->Pv));
  PetscCall(MatDuplicate(t->Bf, MAT_COPY_VALUES, &t->Pf));
  if (t->A) PetscCall(MatMatMult(t->Bv, t->G, MAT_REUSE_MATRIX, PETSC_DEFAULT, &t->A));
  else PetscCall(MatMatMult(t->Bv, t->G, MAT_INITIAL_MATRIX, PETSC_DEFAULT, &t->A));
  PetscCall(MatAXPY(t->A, 1.0, t->Bf, SUBSET_NONZERO_PATTERN));
  PetscCall(TermSystemFactorRows(t, factored));
  t->k     = 0;
  t->stale = (PetscBool) !*factored;
  PetscFunctionReturn(0);
}

/* z = A^-1 r; r is overwritten */
static PetscErrorCode TermSystemDivide(IPTermSystem *t, Vec r, Vec z)
{
  PetscFunctionBegin;
  PetscCall(VecPointwiseMult(r, r, t->S));
  PetscCall(MatSolve(t->F, r, z));
  PetscCall(VecPointwiseMult(z, z, t->S));
  PetscFunctionReturn(0);
}

/* z = A^-1 (P_v R D K_WW D R^T + P_f) A^-1 r; r is overwritten */
static PetscErrorCode TermSystemPrecondition(IPTermSystem *t, Vec r, Vec z)
{
  PetscFunctionBegin;
  PetscCall(TermSystemDivide(t, r, z));
  PetscCall(MatMultTranspose(t->RD, z, t->w));
  PetscCall(MatMult(t->K, t->w, t->Kw));
  PetscCall(MatMult(t->Pf, z, r));
  PetscCall(MatMult(t->RD, t->Kw, z));
  PetscCall(MatMultAdd(t->Pv, z, r, r));
  PetscCall(TermSystemDivide(t, r, z));
  PetscFunctionReturn(0);
}

/* z = the same of an array r of the rows' length */
static PetscErrorCode TermSystemPreconditionArray(IPTermSystem *t, const PetscReal r[], PetscReal z[])
{
  PetscScalar *a;

  PetscFunctionBegin;
  PetscCall(VecGetArrayWrite(t->r, &a));
  PetscCall(PetscArraycpy(a, r, t->m));
  PetscCall(VecRestoreArrayWrite(t->r, &a));
  PetscCall(VecPlaceArray(t->z, z));
  PetscCall(TermSystemPrecondition(t, t->r, t->z));
  PetscCall(VecResetArray(t->z));
  PetscFunctionReturn(0);
}

/* V = (...)^-1 P_v RZ, the columns that are new, and ZV = RZ^T V with them */
static PetscErrorCode TermSystemAppend(IPTermSystem *t, const IPReducedSystem *s)
{
  const PetscReal one = 1.0, zero = 0.0;
  const size_t    m = (size_t)t->m, old = (size_t)t->k;
  PetscBLASInt    mb, k, before, added, ld;

  PetscFunctionBegin;
  PetscCall(PetscBLASIntCast(t->m, &mb));
  PetscCall(PetscBLASIntCast(s->k, &k));
  PetscCall(PetscBLASIntCast(t->k, &before));
  PetscCall(PetscBLASIntCast(s->kmax, &ld));
  added = k - before;
  for (; t->k < s->k; t->k++) {
    PetscCall(VecPlaceArray(t->r, s->JZ + (size_t)t->k * m));
    PetscCall(VecPlaceArray(t->z, t->v));
    PetscCall(MatMult(t->Pv, t->r, t->z));
    PetscCall(VecResetArray(t->z));
    PetscCall(VecResetArray(t->r));
    PetscCall(TermSystemPreconditionArray(t, t->v, t->V + (size_t)t->k * m));
  }
  if (!added || !mb) PetscFunctionReturn(0);
  PetscCallBLAS("BLASgemm", BLASgemm_("T", "N", &k, &added, &mb, &one, s->JZ, &mb, t->V + old * m, &mb, &zero, t->ZV + old * (size_t)s->kmax, &ld));
  if (before) PetscCallBLAS("BLASgemm", BLASgemm_("T", "N", &added, &before, &mb, &one, s->JZ + old * m, &mb, t->V, &mb, &zero, t->ZV + old, &ld));
  PetscFunctionReturn(0);
}

/* L U = H = T + RZ^T V, its diagonal raised by as little as a body needs that nothing holds; *factored is false where H is singular */
static PetscErrorCode TermSystemFactorDirections(IPTermSystem *t, const IPReducedSystem *s, PetscBool *factored)
{
  const PetscReal shift = 1e-14;
  PetscBLASInt    k, info;

  PetscFunctionBegin;
  *factored = PETSC_TRUE;
  if (!s->k) PetscFunctionReturn(0);
  for (PetscInt j = 0; j < s->k; j++) {
    for (PetscInt i = 0; i < s->k; i++) t->H[i + j * s->k] = s->T[i + j * s->kmax] + t->ZV[i + j * s->kmax];
    t->H[j + j * s->k] += shift * s->G[j + j * s->kmax];
  }
  PetscCall(PetscBLASIntCast(s->k, &k));
  PetscCallBLAS("LAPACKgetrf", LAPACKgetrf_(&k, &k, t->H, &k, t->pivots, &info));
  *factored = (PetscBool)!info;
  PetscFunctionReturn(0);
}

/* a += factor RZ y, and b += RZ^T f, each where it is wanted */
static PetscErrorCode TermSystemCouple(const IPReducedSystem *s, PetscReal factor, const PetscReal y[], PetscReal a[], const PetscReal f[], PetscReal b[])
{
  const PetscReal one = 1.0;
  PetscBLASInt    m, k, inc = 1;

  PetscFunctionBegin;
  PetscCall(PetscBLASIntCast(s->m, &m));
  PetscCall(PetscBLASIntCast(s->k, &k));
  if (!m || !k) PetscFunctionReturn(0);
  if (a) PetscCallBLAS("BLASgemv", BLASgemv_("N", &m, &k, &factor, s->JZ, &m, y, &inc, &one, a, &inc));
  if (b) PetscCallBLAS("BLASgemv", BLASgemv_("T", &m, &k, &factor, s->JZ, &m, f, &inc, &one, b, &inc));
  PetscFunctionReturn(0);
}

/* v = C f */
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

/* The system's matrix, in rows and columns that are roots of energies */
static PetscErrorCode TermSystemMult(Mat shell, Vec in, Vec out)
{
  const PetscReal    one = 1.0, zero = 0.0;
  const PetscScalar *x;
  PetscScalar       *b;
  TermSolve         *solve;
  IPTermSystem      *t;
  PetscBLASInt       k, kmax, inc = 1;

  PetscFunctionBegin;
  PetscCall(MatShellGetContext(shell, &solve));
  t = solve->system;
  PetscCall(PetscBLASIntCast(solve->s->k, &k));
  PetscCall(PetscBLASIntCast(solve->s->kmax, &kmax));
  PetscCall(VecGetArrayRead(in, &x));
  PetscCall(VecGetArrayWrite(out, &b));
  for (PetscInt i = 0; i < t->m; i++) t->f[i] = t->scale[i] * PetscRealPart(x[i]);
  PetscCall(IPTermSystemApplyCompliance(t, t->f, t->v));
  PetscCall(TermSystemCouple(solve->s, -1.0, x + t->m, t->v, NULL, NULL));
  if (k) PetscCallBLAS("BLASgemv", BLASgemv_("N", &k, &k, &one, solve->s->T, &kmax, x + t->m, &inc, &zero, b + t->m, &inc));
  PetscCall(TermSystemCouple(solve->s, 1.0, NULL, NULL, t->f, b + t->m));
  PetscCall(VecPlaceArray(t->r, t->v));
  PetscCall(VecPlaceArray(t->z, b));
  PetscCall(MatMult(t->Bv, t->r, t->z));
  PetscCall(VecResetArray(t->r));
  PetscCall(VecPlaceArray(t->r, t->f));
  PetscCall(MatMultAdd(t->Bf, t->r, t->z, t->z));
  PetscCall(VecResetArray(t->r));
  PetscCall(VecResetArray(t->z));
  for (PetscInt i = 0; i < t->m; i++) b[i] *= t->scale[i];
  PetscCall(VecRestoreArrayWrite(out, &b));
  PetscCall(VecRestoreArrayRead(in, &x));
  PetscFunctionReturn(0);
}

/* y = H^-1 (r_y - RZ^T P r_f), f = P r_f + V y */
static PetscErrorCode TermSystemApplyPC(PC pc, Vec in, Vec out)
{
  const PetscReal    one = 1.0;
  const PetscScalar *r;
  PetscScalar       *x;
  TermSolve         *solve;
  IPTermSystem      *t;
  PetscBLASInt       m, k, inc = 1, info;

  PetscFunctionBegin;
  PetscCall(PCShellGetContext(pc, &solve));
  t = solve->system;
  PetscCall(PetscBLASIntCast(t->m, &m));
  PetscCall(PetscBLASIntCast(solve->s->k, &k));
  PetscCall(VecGetArrayRead(in, &r));
  PetscCall(VecGetArrayWrite(out, &x));
  for (PetscInt i = 0; i < t->m; i++) t->f[i] = PetscRealPart(r[i]) / t->scale[i];
  PetscCall(TermSystemPreconditionArray(t, t->f, x));
  PetscCall(PetscArraycpy(x + t->m, r + t->m, k));
  PetscCall(TermSystemCouple(solve->s, -1.0, NULL, NULL, x, x + t->m));
  if (k) PetscCallBLAS("LAPACKgetrs", LAPACKgetrs_("N", &k, &inc, t->H, &k, t->pivots, x + t->m, &k, &info));
  if (k && m) PetscCallBLAS("BLASgemv", BLASgemv_("N", &m, &k, &one, t->V, &m, x + t->m, &inc, &one, x, &inc));
  for (PetscInt i = 0; i < t->m; i++) x[i] /= t->scale[i];
  PetscCall(VecRestoreArrayWrite(out, &x));
  PetscCall(VecRestoreArrayRead(in, &r));
  PetscFunctionReturn(0);
}

static PetscErrorCode TermSystemCreateKSP(TermSolve *solve, PetscReal rtol, PetscInt limit, KSP *ksp)
{
  const PetscInt n = solve->system->m + solve->s->k, restart = 60;
  Mat            shell;
  PC             pc;

  PetscFunctionBegin;
  PetscCall(MatCreateShell(PETSC_COMM_SELF, n, n, n, n, solve, &shell));
  PetscCall(MatShellSetOperation(shell, MATOP_MULT, (void (*)(void))TermSystemMult));
  PetscCall(KSPCreate(PETSC_COMM_SELF, ksp));
  PetscCall(KSPSetOptionsPrefix(*ksp, "tao_ipfilter_terms_"));
  PetscCall(KSPSetOperators(*ksp, shell, shell));
  PetscCall(MatDestroy(&shell));
  PetscCall(KSPSetType(*ksp, KSPGMRES));
  PetscCall(KSPGMRESSetRestart(*ksp, restart));
  PetscCall(KSPSetPCSide(*ksp, PC_RIGHT));
  PetscCall(KSPSetTolerances(*ksp, rtol, 0.0, PETSC_DEFAULT, limit));
  PetscCall(KSPGetPC(*ksp, &pc));
  PetscCall(PCSetType(pc, PCSHELL));
  PetscCall(PCShellSetContext(pc, solve));
  PetscCall(PCShellSetApply(pc, TermSystemApplyPC));
  PetscFunctionReturn(0);
}

/* x: the solution of the system with b on the right, from x on, by the factors there are */
static PetscErrorCode TermSystemIterate(TermSolve *solve, PetscReal rtol, PetscInt limit, Vec b, Vec x, PetscInt *its)
{
  KSP ksp;

  PetscFunctionBegin;
  PetscCall(TermSystemCreateKSP(solve, rtol, limit, &ksp));
  PetscCall(KSPSetInitialGuessNonzero(ksp, PETSC_TRUE));
  PetscCall(KSPSolve(ksp, b, x));
  PetscCall(KSPGetIterationNumber(ksp, its));
  PetscCall(KSPDestroy(&ksp));
  PetscFunctionReturn(0);
}

/* What GMRES needs beside the rows: factors where there are none that serve, and what belongs to new directions */
static PetscErrorCode TermSystemPrepare(IPTermSystem *t, const IPReducedSystem *s, PetscBool *ready)
{
  const PetscInt before = t->k;

  PetscFunctionBegin;
  *ready = PETSC_TRUE;
  if (!t->F || t->stale) PetscCall(TermSystemFactor(t, ready));
  if (!*ready) PetscFunctionReturn(0);
  PetscCall(TermSystemAppend(t, s));
  if (!t->k || t->k != before) PetscCall(TermSystemFactorDirections(t, s, ready));
  PetscFunctionReturn(0);
}

/* b = (r_f, r_y), or back, with the rows' scale */
static PetscErrorCode TermSystemCopy(const IPTermSystem *t, PetscInt k, Vec b, PetscReal rf[], PetscReal ry[], PetscBool back)
{
  PetscScalar *a;

  PetscFunctionBegin;
  PetscCall(VecGetArray(b, &a));
  for (PetscInt i = 0; i < t->m; i++) {
    if (back) rf[i] = t->scale[i] * PetscRealPart(a[i]);
    else a[i] = t->scale[i] * rf[i];
  }
  if (back) PetscCall(PetscArraycpy(ry, a + t->m, k));
  else PetscCall(PetscArraycpy(a + t->m, ry, k));
  PetscCall(VecRestoreArray(b, &a));
  PetscFunctionReturn(0);
}

/* Overwrites r_f and r_y with the solution to a relative residual; *solved is false where there is none. Old factors have so many iterations, then there are new ones. */
PetscErrorCode IPTermSystemSolve(IPTermSystem *t, const IPReducedSystem *s, PetscReal rtol, PetscReal rf[], PetscReal ry[], PetscBool *solved)
{
  const PetscInt old = 20, slow = 12, limit = 120;
  TermSolve      solve = {.system = t, .s = s};
  PetscInt       its   = 0;
  PetscBool      fresh;
  Vec            b, x;

  PetscFunctionBegin;
  PetscCall(VecCreateSeq(PETSC_COMM_SELF, t->m + s->k, &b));
  PetscCall(VecDuplicate(b, &x));
  PetscCall(VecZeroEntries(x));
  PetscCall(TermSystemCopy(t, s->k, b, rf, ry, PETSC_FALSE));
  do {
    fresh = (PetscBool)(!t->F || t->stale);
    PetscCall(TermSystemPrepare(t, s, solved));
    if (!*solved) break;
    PetscCall(TermSystemIterate(&solve, rtol, fresh ? limit : old, b, x, &its));
    t->stale = (PetscBool)(!fresh && its > slow);
  } while (!fresh && its >= old);
  PetscCall(TermSystemCopy(t, s->k, x, rf, ry, PETSC_TRUE));
  PetscCall(VecDestroy(&x));
  PetscCall(VecDestroy(&b));
  PetscFunctionReturn(0);
}
