/*
   Solves the systems of system.c by GMRES without forming C, or by factors if GMRES fails. For the convex problem the
   preconditioner is that of cholesky.c, otherwise that of factor.c.
*/
#include "frictionimpl.h"
#include "pc_amgf/mumps.h"
#include <petscblaslapack.h>

/* Context of the shell matrix and of the shell preconditioner */
typedef struct {
  IPTermSystem          *system;
  const IPReducedSystem *s;
  PetscBool              strong; /* the preconditioner is that of cholesky.c */
} TermSolveShell;

/* Adds factor RZ y to a and factor RZ^T f to b; either is skipped if a or b is NULL */
static PetscErrorCode TermSolveCouple(const IPReducedSystem *s, PetscReal factor, const PetscReal y[], PetscReal a[],
  const PetscReal f[], PetscReal b[])
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

/* Multiplies by the system's matrix in scaled rows and columns */
static PetscErrorCode TermSolveMult(Mat shell, Vec in, Vec out)
{
  const PetscReal    one = 1.0, zero = 0.0;
  const PetscScalar *x;
  PetscScalar       *b;
  TermSolveShell    *solve;
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
  PetscCall(TermSolveCouple(solve->s, -1.0, x + t->m, t->v, NULL, NULL));
  if (k)
    PetscCallBLAS("BLASgemv", BLASgemv_("N", &k, &k, &one, solve->s->T, &kmax, x + t->m, &inc, &zero, b + t->m, &inc));
  for (PetscInt j = 0; j < solve->s->k; j++) b[t->m + j] += t->hold * solve->s->G[j] * x[t->m + j];
  PetscCall(TermSolveCouple(solve->s, 1.0, NULL, NULL, t->f, b + t->m));
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

/* Applies the preconditioner: y = H^-1 (r_y - RZ^T P r_f), f = P r_f + V y, where P is that of IPTermFactorApply() */
static PetscErrorCode TermSolvePrecondition(PC pc, Vec in, Vec out)
{
  const PetscReal    one = 1.0;
  const PetscScalar *r;
  PetscScalar       *x;
  TermSolveShell    *solve;
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
  PetscCall(IPTermFactorApply(t, t->f, x));
  PetscCall(PetscArraycpy(x + t->m, r + t->m, k));
  PetscCall(TermSolveCouple(solve->s, -1.0, NULL, NULL, x, x + t->m));
  if (k) PetscCallBLAS("LAPACKgetrs", LAPACKgetrs_("N", &k, &inc, t->H, &k, t->pivots, x + t->m, &k, &info));
  if (k && m) PetscCallBLAS("BLASgemv", BLASgemv_("N", &m, &k, &one, t->V, &m, x + t->m, &inc, &one, x, &inc));
  for (PetscInt i = 0; i < t->m; i++) x[i] /= t->scale[i];
  PetscCall(VecRestoreArrayWrite(out, &x));
  PetscCall(VecRestoreArrayRead(in, &r));
  PetscFunctionReturn(0);
}

/* Applies the preconditioner of cholesky.c in scaled rows and columns */
static PetscErrorCode TermSolvePreconditionStrongly(PC pc, Vec in, Vec out)
{
  const PetscScalar *r;
  PetscScalar       *x;
  TermSolveShell    *solve;
  IPTermSystem      *t;

  PetscFunctionBegin;
  PetscCall(PCShellGetContext(pc, &solve));
  t = solve->system;
  PetscCall(VecGetArrayRead(in, &r));
  PetscCall(VecGetArrayWrite(out, &x));
  for (PetscInt i = 0; i < t->m; i++) x[i] = r[i] / t->scale[i];
  PetscCall(PetscArraycpy(x + t->m, r + t->m, solve->s->k));
  PetscCall(IPTermCholeskyApply(t, solve->s, x, x + t->m));
  for (PetscInt i = 0; i < t->m; i++) x[i] /= t->scale[i];
  PetscCall(VecRestoreArrayWrite(out, &x));
  PetscCall(VecRestoreArrayRead(in, &r));
  PetscFunctionReturn(0);
}

static PetscErrorCode TermSolveCreateKSP(TermSolveShell *solve, PetscReal rtol, PetscInt limit, KSP *ksp)
{
  const PetscInt n = solve->system->m + solve->s->k, restart = 60;
  Mat            shell;
  PC             pc;

  PetscFunctionBegin;
  PetscCall(MatCreateShell(PETSC_COMM_SELF, n, n, n, n, solve, &shell));
  PetscCall(MatShellSetOperation(shell, MATOP_MULT, (AMGFOperation *)TermSolveMult));
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
  PetscCall(PCShellSetApply(pc, solve->strong ? TermSolvePreconditionStrongly : TermSolvePrecondition));
  PetscFunctionReturn(0);
}

/* Solves by GMRES with the present factors and the initial guess x. b: right-hand side. */
static PetscErrorCode TermSolveIterate(TermSolveShell *solve, PetscReal rtol, PetscInt limit, Vec b, Vec x,
  PetscInt *its, PetscBool *converged)
{
  KSPConvergedReason reason;
  KSP                ksp;

  PetscFunctionBegin;
  PetscCall(TermSolveCreateKSP(solve, rtol, limit, &ksp));
  PetscCall(KSPSetInitialGuessNonzero(ksp, PETSC_TRUE));
  PetscCall(KSPSolve(ksp, b, x));
  PetscCall(KSPGetIterationNumber(ksp, its));
  PetscCall(KSPGetConvergedReason(ksp, &reason));
  *converged = (PetscBool)(reason > 0);
  PetscCall(KSPDestroy(&ksp));
  PetscFunctionReturn(0);
}

/* Copies (r_f, r_y), scaled, into the vector b, or from b if `back` */
static PetscErrorCode TermSolveCopy(const IPTermSystem *t, PetscInt k, Vec b, PetscReal rf[], PetscReal ry[],
  PetscBool back)
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

/*
   Overwrites r_f and r_y with the solution by GMRES. *converged: false if the residual was not reduced enough, unless
   `keep` accepts any result. The factors are computed again if GMRES needs many more iterations than with new factors;
   for soft bodies 20 to 30 iterations are normal.
*/
static PetscErrorCode TermSolveGMRES(TermSolveShell *solve, PetscReal rtol, PetscReal rf[], PetscReal ry[],
  PetscBool keep, PetscBool *converged)
{
  IPTermSystem  *t   = solve->system;
  const PetscInt old = PetscMax(20, 2 * t->fresh), slow = PetscMax(12, t->fresh + t->fresh / 2);
  const PetscInt limit = t->quick ? 60 : 120;
  PetscInt       its   = 0;
  PetscBool      fresh, ready;
  Vec            b, x;

  PetscFunctionBegin;
  PetscCall(VecCreateSeq(PETSC_COMM_SELF, t->m + solve->s->k, &b));
  PetscCall(VecDuplicate(b, &x));
  PetscCall(VecZeroEntries(x));
  PetscCall(TermSolveCopy(t, solve->s->k, b, rf, ry, PETSC_FALSE));
  do {
    fresh = (PetscBool)(!t->F || t->stale);
    PetscCall(IPTermFactorPrepare(t, solve->s, &ready));
    if (!ready) break;
    PetscCall(TermSolveIterate(solve, rtol, fresh ? limit : old, b, x, &its, converged));
    t->stale = (PetscBool)(!fresh && its > slow);
    if (fresh) t->fresh = its;
  } while (!fresh && its >= old);
  *converged = (PetscBool)(ready && (*converged || keep));
  if (*converged) PetscCall(TermSolveCopy(t, solve->s->k, x, rf, ry, PETSC_TRUE));
  PetscCall(VecDestroy(&x));
  PetscCall(VecDestroy(&b));
  PetscFunctionReturn(0);
}

/*
   Overwrites r_f and r_y with the solution by GMRES with the preconditioner of cholesky.c. Forces of rows that are open
   are eliminated first, so that they become exactly zero.
*/
static PetscErrorCode TermSolveStrongly(TermSolveShell *solve, PetscReal rtol, PetscReal rf[], PetscReal ry[],
  PetscBool *solved)
{
  IPTermSystem  *t     = solve->system;
  const PetscInt limit = 60;
  PetscInt       n, its, *rows;
  PetscReal     *known;
  Vec            b, x;

  PetscFunctionBegin;
  PetscCall(IPTermCholeskyPrepare(t, solve->s, solved));
  if (!*solved) PetscFunctionReturn(0);
  solve->strong = PETSC_TRUE;
  PetscCall(PetscMalloc2(t->m, &rows, t->m, &known));
  PetscCall(IPTermSystemFindCoupled(t, rf, &n, rows, known));
  PetscCall(IPTermSystemSubtract(t, solve->s, known, rf, ry));
  PetscCall(VecCreateSeq(PETSC_COMM_SELF, t->m + solve->s->k, &b));
  PetscCall(VecDuplicate(b, &x));
  PetscCall(VecZeroEntries(x));
  PetscCall(TermSolveCopy(t, solve->s->k, b, rf, ry, PETSC_FALSE));
  PetscCall(TermSolveIterate(solve, rtol, limit, b, x, &its, solved));
  if (*solved) {
    PetscCall(TermSolveCopy(t, solve->s->k, x, rf, ry, PETSC_TRUE));
    for (PetscInt i = 0; i < t->m; i++) rf[i] += known[i];
  }
  PetscCall(VecDestroy(&x));
  PetscCall(VecDestroy(&b));
  PetscCall(PetscFree2(rows, known));
  PetscFunctionReturn(0);
}

/* Solves by sparse factors if GMRES fails, or by dense ones if MUMPS is not available */
static PetscErrorCode TermSolveByFactors(IPTermSystem *t, const IPReducedSystem *s, PetscReal rf[], PetscReal ry[],
  PetscBool *solved)
{
  PetscFunctionBegin;
  PetscCall(IPTermSparseSolve(t, s, rf, ry, solved));
  if (!*solved && IPTermDenseFits(t)) PetscCall(IPTermDenseSolve(t, s, PETSC_MAX_INT, rf, ry, solved));
  PetscFunctionReturn(0);
}

/*
   Overwrites r_f and r_y with the solution, to the relative residual rtol. Small systems are solved by dense factors;
   large ones by factors only if GMRES has failed. If no factors fit into memory, the result of GMRES is returned.
   *solved: false if there is no solution, or if the user wants to end the solve.
*/
PetscErrorCode IPTermSolve(IPTermSystem *t, const IPReducedSystem *s, PetscReal rtol, PetscReal rf[], PetscReal ry[],
  PetscBool *solved)
{
  const PetscInt small = t->spring ? 1000 : 600; /* springs: W is large, and GMRES converges slowly */
  TermSolveShell solve = {.system = t, .s = s};
  PetscBool      fits, stop;

  PetscFunctionBegin;
  *solved = PETSC_FALSE;
  PetscCall(IPReducedInterrupted(s, &stop));
  if (stop) PetscFunctionReturn(0);
  PetscCall(AMGFMumpsFactors(MATSEQAIJ, MAT_FACTOR_LU, &fits));
  fits = (PetscBool)(fits || IPTermDenseFits(t));
  PetscCall(IPTermDenseSolve(t, s, small, rf, ry, solved));
  if (!*solved && !t->dense && !t->symmetric) PetscCall(TermSolveGMRES(&solve, rtol, rf, ry, (PetscBool)!fits, solved));
  if (!*solved && t->symmetric) PetscCall(TermSolveStrongly(&solve, rtol, rf, ry, solved));
  if (*solved || !fits || t->quick) PetscFunctionReturn(0);
  PetscCall(TermSolveByFactors(t, s, rf, ry, solved));
  t->dense = *solved;
  PetscFunctionReturn(0);
}
