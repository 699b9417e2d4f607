static char help[] =
  "PCAMGF on operators that change: what is rebuilt, what is kept, when the AMG lags, what a failure looks like.\n\n";

#include "amgf_context.h"

/* A solver that filters the constrained unknowns */
static PetscErrorCode ContextCreateFiltered(Context *c, PetscInt n)
{
  PetscFunctionBeginUser;
  PetscCall(ContextCreate(c, n));
  PetscCall(PCAMGFSetFilterIS(c->pc, c->is));
  PetscFunctionReturn(0);
}

/* Solves, and prints the AMG set-ups so far if the true residual is small */
static PetscErrorCode Solve(Context *c, const char what[])
{
  PCAMGFCounts       counts;
  KSPConvergedReason reason;
  PetscReal          residual, rtol;

  PetscFunctionBeginUser;
  PetscCall(KSPSetOperators(c->ksp, c->A, c->A));
  PetscCall(KSPSolve(c->ksp, c->b, c->x));
  PetscCall(KSPGetConvergedReason(c->ksp, &reason));
  PetscCall(KSPGetTolerances(c->ksp, &rtol, NULL, NULL, NULL));
  PetscCall(PCAMGFGetCounts(c->pc, &counts));
  PetscCall(ProblemResidual(c->A, c->b, c->x, &residual));
  PetscCall(PetscPrintf(c->comm, "  %s: %s, AMG set-ups %" PetscInt_FMT ", filter set-ups %" PetscInt_FMT "\n", what,
    reason > 0 && residual < 1e3 * rtol ? "solved" : "NOT SOLVED", counts.amg_setups, counts.filter_setups));
  PetscFunctionReturn(0);
}

/* Symbolic factorizations since the start of the program */
static PetscErrorCode SymbolicFactorizations(PetscInt *n)
{
  PetscLogEvent      event;
  PetscEventPerfInfo info;

  PetscFunctionBeginUser;
  PetscCall(PetscLogEventGetId("MatCholFctrSym", &event));
  PetscCall(PetscLogEventGetPerfInfo(PETSC_DETERMINE, event, &info));
  *n = info.count;
  PetscFunctionReturn(0);
}

/* A barrier that tightens: only D changes */
static PetscErrorCode CheckPatternReuse(void)
{
  Context  c;
  PetscInt before, after;
  IS       copy;

  PetscFunctionBeginUser;
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "pattern reuse\n"));
  PetscCall(SymbolicFactorizations(&before));
  PetscCall(ContextCreateFiltered(&c, 12));
  for (PetscInt i = 0; i < 4; i++) {
    c.problem.highest = 2.0 + i;
    PetscCall(ProblemFill(&c.problem, PETSC_TRUE, c.A));
    PetscCall(ISDuplicate(c.is, &copy)); /* an equal subspace in a new object */
    PetscCall(PCAMGFSetFilterIS(c.pc, copy));
    PetscCall(ISDestroy(&copy));
    PetscCall(Solve(&c, "new values"));
  }
  PetscCall(Solve(&c, "same values"));
  PetscCall(SymbolicFactorizations(&after));
  PetscCall(PetscPrintf(c.comm, "  symbolic factorizations: %" PetscInt_FMT "\n", after - before));
  PetscCall(ISCreateStride(PETSC_COMM_SELF, 7, 0, 1, &copy));
  PetscCall(PCAMGFSetFilterIS(c.pc, copy));
  PetscCall(PCSetUp(c.pc));
  PetscCall(ISDestroy(&copy));
  PetscCall(SymbolicFactorizations(&before));
  PetscCall(PetscPrintf(c.comm, "  and with another subspace: %" PetscInt_FMT "\n", before - after));
  PetscCall(ContextDestroy(&c));
  PetscFunctionReturn(0);
}

/* Five operators with a fixed lag; they decrease, so that an outdated AMG still has A < 2 B^-1 */
static PetscErrorCode CheckFixedLag(PCAMGFCycle cycle, PetscInt lag)
{
  Context c;

  PetscFunctionBeginUser;
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%s, lag %" PetscInt_FMT "\n", PCAMGFCycles[cycle], lag));
  PetscCall(ContextCreateFiltered(&c, 12));
  PetscCall(PCAMGFSetCycle(c.pc, cycle));
  PetscCall(PCAMGFSetAMGLag(c.pc, lag));
  for (PetscInt i = 0; i < 5; i++) {
    c.problem.ax      = 1.0 - 0.1 * i;
    c.problem.highest = 6.0 - i;
    PetscCall(ProblemFill(&c.problem, PETSC_TRUE, c.A));
    PetscCall(Solve(&c, "operator"));
  }
  PetscCall(ContextDestroy(&c));
  PetscFunctionReturn(0);
}

/* Automatic, the default of fbf. The diagonal of K is 4 (ax + ay): with ax + ay fixed the direction of strong
   coupling turns under an unchanged diagonal */
static PetscErrorCode CheckAutomaticLag(void)
{
  Context c;

  PetscFunctionBeginUser;
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "automatic lag\n"));
  PetscCall(ContextCreateFiltered(&c, 24));
  PetscCall(KSPSetTolerances(c.ksp, 1e-2, PETSC_DEFAULT, PETSC_DEFAULT, 2000));
  c.problem.ax = 1.9;
  c.problem.ay = 0.1;
  PetscCall(ProblemFill(&c.problem, PETSC_TRUE, c.A));
  PetscCall(Solve(&c, "first operator"));
  c.problem.highest = 8.0;
  PetscCall(ProblemFill(&c.problem, PETSC_TRUE, c.A));
  PetscCall(Solve(&c, "stiffer on the subspace: kept"));
  PetscCall(KSPSetTolerances(c.ksp, 1e-12, PETSC_DEFAULT, PETSC_DEFAULT, 2000));
  c.problem.highest = 7.0;
  PetscCall(ProblemFill(&c.problem, PETSC_TRUE, c.A));
  PetscCall(Solve(&c, "a tighter tolerance takes more iterations: kept"));
  c.problem.highest = 6.0;
  PetscCall(ProblemFill(&c.problem, PETSC_TRUE, c.A));
  PetscCall(Solve(&c, "so it is still: kept"));
  c.problem.ax = 0.1;
  c.problem.ay = 1.9;
  PetscCall(ProblemFill(&c.problem, PETSC_TRUE, c.A));
  PetscCall(Solve(&c, "coupling turned, not seen on the diagonal: kept"));
  c.problem.highest = 5.0;
  PetscCall(ProblemFill(&c.problem, PETSC_TRUE, c.A));
  PetscCall(Solve(&c, "the last solve was dear: rebuilt"));
  c.problem.ax *= 4.0;
  c.problem.ay *= 4.0;
  PetscCall(ProblemFill(&c.problem, PETSC_TRUE, c.A));
  PetscCall(Solve(&c, "stiffer everywhere: rebuilt"));
  PetscCall(ContextDestroy(&c));
  PetscFunctionReturn(0);
}

/* The filter off for one operator: the AMG alone; then on again, with the symbolic factorization it had */
static PetscErrorCode CheckSwitch(void)
{
  Context      c;
  PC           amg;
  Vec          alone;
  PetscReal    difference;
  PetscInt     before, after;
  PCAMGFCounts counts;

  PetscFunctionBeginUser;
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "switch\n"));
  PetscCall(SymbolicFactorizations(&before));
  PetscCall(ContextCreateFiltered(&c, 12));
  PetscCall(PCAMGFSetFilterActive(c.pc, PETSC_FALSE));
  c.problem.highest = 0.5;
  PetscCall(ProblemFill(&c.problem, PETSC_TRUE, c.A));
  PetscCall(Solve(&c, "off"));
  PetscCall(PCAMGFSetFilterActive(c.pc, PETSC_TRUE));
  PetscCall(Solve(&c, "on, the same values"));
  PetscCall(PCAMGFSetFilterActive(c.pc, PETSC_FALSE));
  c.problem.highest = 0.4;
  PetscCall(ProblemFill(&c.problem, PETSC_TRUE, c.A));
  PetscCall(Solve(&c, "off"));
  PetscCall(VecDuplicate(c.b, &alone));
  PetscCall(PCApply(c.pc, c.b, c.x));
  PetscCall(PCAMGFGetAMGPC(c.pc, &amg));
  PetscCall(PCApply(amg, c.b, alone));
  PetscCall(RelativeDifference(c.x, alone, &difference));
  PetscCall(ReportBound(c.comm, "  off: the AMG's application", difference, 1e-14));
  PetscCall(VecDestroy(&alone));
  PetscCall(PCAMGFSetFilterActive(c.pc, PETSC_TRUE));
  c.problem.highest = 6.0;
  PetscCall(ProblemFill(&c.problem, PETSC_TRUE, c.A));
  PetscCall(Solve(&c, "on"));
  PetscCall(PCAMGFGetCounts(c.pc, &counts));
  PetscCall(SymbolicFactorizations(&after));
  PetscCall(PetscPrintf(c.comm, "  filter solves: %s, symbolic factorizations: %" PetscInt_FMT "\n",
    counts.filter_applies ? "yes" : "none", after - before));
  PetscCall(ContextDestroy(&c));
  PetscFunctionReturn(0);
}

/* PCReset(), then an operator of another size */
static PetscErrorCode CheckReset(void)
{
  Context c, d;

  PetscFunctionBeginUser;
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "reset\n"));
  PetscCall(ContextCreateFiltered(&c, 12));
  PetscCall(ContextCreateFiltered(&d, 9));
  PetscCall(Solve(&c, "first size"));
  PetscCall(KSPReset(c.ksp));
  PetscCall(KSPSetOperators(c.ksp, d.A, d.A));
  PetscCall(PCAMGFSetFilterIS(c.pc, d.is));
  PetscCall(KSPDestroy(&d.ksp));
  d.ksp = c.ksp;
  d.pc  = c.pc;
  PetscCall(Solve(&d, "second size"));
  c.ksp = NULL;
  PetscCall(ContextDestroy(&c));
  PetscCall(ContextDestroy(&d));
  PetscFunctionReturn(0);
}

/* Amat and Pmat differ: each way of taking the products gives a symmetric preconditioner */
static PetscErrorCode CheckAmat(void)
{
  Context   c;
  Mat       K;
  PetscReal difference = 0.0;

  PetscFunctionBeginUser;
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "Amat and Pmat\n"));
  PetscCall(PetscOptionsSetValue(NULL, "-amgf_amg_pc_type", PCHYPRE)); /* symmetric to double precision */
  PetscCall(ContextCreateFiltered(&c, 12));
  PetscCall(PCAMGFSetCycle(c.pc, PC_AMGF_BFB));
  c.problem.ax = 1.2;
  PetscCall(ProblemCreate(c.comm, &c.problem, MATAIJ, PETSC_TRUE, &K));
  PetscCall(KSPSetOperators(c.ksp, K, c.A));
  for (PetscInt use = 0; use < 2; use++) {
    PetscCall(PCSetUseAmat(c.pc, use ? PETSC_TRUE : PETSC_FALSE));
    PetscCall(ContextAsymmetry(&c, &difference));
    PetscCall(ReportBound(c.comm, use ? "  products with Amat: symmetric" : "  products with Pmat: symmetric",
      difference, 1e-11));
  }
  PetscCall(MatDestroy(&K));
  PetscCall(ContextDestroy(&c));
  PetscCall(PetscOptionsClearValue(NULL, "-amgf_amg_pc_type"));
  PetscFunctionReturn(0);
}

/* A subspace matrix that is singular: the solve says so and does not end the program; the next good operator is
   solved */
static PetscErrorCode CheckFailure(void)
{
  Context            c;
  Mat                P;
  KSPConvergedReason reason;
  PCFailedReason     failed;
  IS                 twice;
  PetscInt           start, idx[2];

  PetscFunctionBeginUser;
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "failure\n"));
  PetscCall(ContextCreateFiltered(&c, 12));
  PetscCall(MatGetOwnershipRange(c.A, &start, NULL));
  idx[0] = idx[1] = start;
  PetscCall(ISCreateGeneral(c.comm, 2, idx, PETSC_COPY_VALUES, &twice));
  PetscCall(ProblemCreateInterpolation(c.A, twice, 0.0, &P)); /* two equal columns */
  PetscCall(PCAMGFSetFilterInterpolation(c.pc, P));
  PetscCall(KSPSolve(c.ksp, c.b, c.x));
  PetscCall(KSPGetConvergedReason(c.ksp, &reason));
  PetscCall(PCGetFailedReason(c.pc, &failed));
  PetscCall(PetscPrintf(c.comm, "  singular subspace: %s, %s\n", KSPConvergedReasons[reason],
    failed ? "failure reported" : "no failure reported"));
  PetscCall(PCAMGFSetFilterIS(c.pc, c.is));
  PetscCall(ProblemFill(&c.problem, PETSC_TRUE, c.A));
  PetscCall(Solve(&c, "recovered"));
  PetscCall(ISDestroy(&twice));
  PetscCall(MatDestroy(&P));
  PetscCall(ContextDestroy(&c));
  PetscFunctionReturn(0);
}

/* A library that meets an error on the last rank alone, in call `at` */
static PetscErrorCode Break(PC pc, PetscInt at)
{
  PetscInt   *ncalls;
  PetscMPIInt rank, size;

  PetscFunctionBeginUser;
  PetscCall(PCShellGetContext(pc, &ncalls));
  PetscCallMPI(MPI_Comm_rank(PETSC_COMM_WORLD, &rank));
  PetscCallMPI(MPI_Comm_size(PETSC_COMM_WORLD, &size));
  PetscCheck(++*ncalls != at || rank < size - 1, PETSC_COMM_SELF, PETSC_ERR_LIB, "the library's own error");
  PetscFunctionReturn(0);
}

/* Copies r to z without VecCopy(): with -log_sync each rank waits there for all others, and the rank that fails never
   calls it */
static PetscErrorCode ApplyBroken(PC pc, Vec r, Vec z)
{
  const PetscScalar *from;
  PetscScalar       *to;
  PetscInt           n;

  PetscFunctionBeginUser;
  PetscCall(Break(pc, 3));
  PetscCall(VecGetLocalSize(r, &n));
  PetscCall(VecGetArrayRead(r, &from));
  PetscCall(VecGetArrayWrite(z, &to));
  PetscCall(PetscArraycpy(to, from, n));
  PetscCall(VecRestoreArrayWrite(z, &to));
  PetscCall(VecRestoreArrayRead(r, &from));
  PetscFunctionReturn(0);
}

static PetscErrorCode SetUpBroken(PC pc)
{
  PetscFunctionBeginUser;
  PetscCall(Break(pc, 1));
  PetscFunctionReturn(0);
}

static PetscErrorCode ApplyIdentity(PC pc, Vec r, Vec z)
{
  PetscFunctionBeginUser;
  (void)pc;
  PetscCall(VecCopy(r, z));
  PetscFunctionReturn(0);
}

/*
   An error inside the AMG that one rank has alone ends the solve on all of them; nobody waits. After an error in the
   set-up it begins anew with the next operator.
*/
static PetscErrorCode CheckError(const char where[], PetscErrorCode (*setup)(PC), PetscErrorCode (*apply)(PC, Vec, Vec))
{
  Context            c;
  PC                 amg;
  PetscInt           ncalls = 0;
  KSPConvergedReason reason;

  PetscFunctionBeginUser;
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "an error %son one rank\n", where));
  PetscCall(ContextCreateFiltered(&c, 12));
  PetscCall(PCAMGFGetAMGPC(c.pc, &amg));
  PetscCall(PCSetType(amg, PCSHELL));
  PetscCall(PCShellSetContext(amg, &ncalls));
  if (setup) PetscCall(PCShellSetSetUp(amg, setup));
  PetscCall(PCShellSetApply(amg, apply));
  PetscCall(KSPSolve(c.ksp, c.b, c.x));
  PetscCall(KSPGetConvergedReason(c.ksp, &reason));
  PetscCall(PetscPrintf(c.comm, "  first operator: %s\n", KSPConvergedReasons[reason]));
  PetscCall(ProblemFill(&c.problem, PETSC_TRUE, c.A));
  PetscCall(Solve(&c, "recovered"));
  PetscCall(ContextDestroy(&c));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, help));
  PetscCall(PetscAMGFInitializePackage());
  PetscCall(MatInitializePackage());
  PetscCall(PetscLogDefaultBegin());
  PetscCall(CheckPatternReuse());
  PetscCall(CheckFixedLag(PC_AMGF_BFB, 1));
  PetscCall(CheckFixedLag(PC_AMGF_BFB, 3));
  PetscCall(CheckFixedLag(PC_AMGF_FBF, -1));
  PetscCall(CheckAutomaticLag());
  PetscCall(CheckSwitch());
  PetscCall(CheckReset());
  PetscCall(CheckAmat());
  PetscCall(CheckFailure());
  PetscCall(CheckError("", NULL, ApplyBroken));
  PetscCall(CheckError("in the set-up ", SetUpBroken, ApplyIdentity));
  PetscCall(PetscFinalize());
  return 0;
}

/*TEST

   test:
      suffix: 1
      nsize: {{1 5 2 3}}

   # ranks wait for one another at the events of PETSc's log
   test:
      suffix: log_sync
      nsize: 2
      args: -log_sync
      output_file: output/amgf_reuse_1.out

TEST*/
