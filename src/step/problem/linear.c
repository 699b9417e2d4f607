/* Solves linear systems: those of load steps without contact by PCG, those of contact updates by GMRES. */
#include "problemimpl.h"
#include <petsctime.h>
#include "src/state/control.h"
#include "src/state/path.h"

/* iterations expected in a solve that is preconditioned by a factorization */
static const PetscReal factored_iterations = 2.0;

/*
   Context of LinearTest(): the KSP's own convergence test, and data for the decision whether a factorization replaces
   AMG.
*/
typedef struct {
  PetscErrorCode (*test)(KSP, PetscInt, PetscReal, KSPConvergedReason *, void *);
  PetscErrorCode (*destroy)(void *);
  void     *ctx;
  PetscReal first; /* initial residual norm */
  PetscInt  later; /* number of later solves with the same matrix */
  PetscBool left;  /* true if the iteration was stopped so that the matrix is factored */
} LinearPatience;

/*
   Calls the KSP's own convergence test. Every ten iterations it also extrapolates the number of remaining iterations,
   and stops the iteration if a factorization is estimated to be cheaper.
*/
static PetscErrorCode LinearTest(KSP ksp, PetscInt it, PetscReal norm, KSPConvergedReason *reason, void *ctx)
{
  LinearPatience *p     = (LinearPatience *)ctx;
  const PetscInt  every = 10;
  PetscReal       rtol, gained, digits, all;
  PetscBool       before, after;
  PC              pc;

  PetscFunctionBegin;
  PetscCall((*p->test)(ksp, it, norm, reason, p->ctx));
  if (!it) p->first = norm;
  if (!it || it % every || *reason || !(norm > 0.0)) PetscFunctionReturn(0);
  PetscCall(KSPGetPC(ksp, &pc));
  PetscCall(KSPGetTolerances(ksp, &rtol, NULL, NULL, NULL));
  gained = PetscMax(PetscLog10Real(p->first / norm), 0.5);
  digits = PetscMax(-PetscLog10Real(rtol), gained);
  all    = (PetscReal)it * digits / gained;
  PetscCall(PCAMGFGetFactored(pc, &before, NULL));
  PetscCall(
    PCAMGFExpect(pc, all - (PetscReal)it + all * (PetscReal)p->later, factored_iterations * (PetscReal)(1 + p->later)));
  PetscCall(PCAMGFGetFactored(pc, &after, NULL));
  p->left = (PetscBool)(after != before);
  if (p->left) *reason = KSP_CONVERGED_ITS;
  PetscFunctionReturn(0);
}

/*
   Solves with a KSP, starting from x if `resume` is true, otherwise from zero. If the iteration stops because a
   factorization is cheaper, a second solve continues from the current iterate. *its: number of iterations of both
   solves.
*/
static PetscErrorCode LinearSolvePatiently(Simulation sim, KSP ksp, PetscBool resume, Vec b, Vec x, PetscInt *its)
{
  LinearPatience patience = {.left = PETSC_FALSE};
  PetscInt       more     = 0;
  PetscBool      amgf;
  PC             pc;

  PetscFunctionBegin;
  PetscCall(KSPGetPC(ksp, &pc));
  PetscCall(PetscObjectTypeCompare((PetscObject)pc, PCAMGF, &amgf));
  PetscCall(PathSolvesToCome(sim, &patience.later));
  patience.later--;
  PetscCall(KSPGetAndClearConvergenceTest(ksp, &patience.test, &patience.ctx, &patience.destroy));
  PetscCall(
    KSPSetConvergenceTest(ksp, amgf ? LinearTest : patience.test, amgf ? (void *)&patience : patience.ctx, NULL));
  PetscCall(KSPSetInitialGuessNonzero(ksp, resume));
  PetscCall(KSPSolve(ksp, b, x));
  PetscCall(KSPSetInitialGuessNonzero(ksp, PETSC_FALSE));
  PetscCall(KSPSetConvergenceTest(ksp, patience.test, patience.ctx, patience.destroy));
  PetscCall(KSPGetIterationNumber(ksp, its));
  if (!patience.left) PetscFunctionReturn(0);
  PetscCall(KSPSetInitialGuessNonzero(ksp, PETSC_TRUE));
  PetscCall(KSPSolve(ksp, b, x));
  PetscCall(KSPSetInitialGuessNonzero(ksp, PETSC_FALSE));
  PetscCall(KSPGetIterationNumber(ksp, &more));
  *its += more;
  PetscFunctionReturn(0);
}

/*
   Returns the solver of load steps without contact: CG preconditioned by AMG, or by a factorization if it is estimated
   to be cheaper for the remaining load steps.
*/
static PetscErrorCode LinearGetKSP(Simulation sim, KSP *ksp)
{
  const PetscReal usual = 35.0; /* iterations expected with AMG, before the first solve */
  PetscInt        solves, its = 0;
  PC              pc;

  PetscFunctionBegin;
  if (!sim->control->ksp) {
    PetscCall(KSPCreate(sim->comm, &sim->control->ksp));
    PetscCall(KSPSetOptionsPrefix(sim->control->ksp, "elasticity_"));
    PetscCall(KSPSetType(sim->control->ksp, KSPCG));
    PetscCall(KSPSetTolerances(sim->control->ksp, sim->control->tolerances.linear, PETSC_DEFAULT, PETSC_DEFAULT,
      PETSC_DEFAULT));
    PetscCall(KSPGetPC(sim->control->ksp, &pc));
    PetscCall(PCSetType(pc, PCAMGF));
    PetscCall(PCAMGFSetFilterOptional(pc, PETSC_TRUE));
    PetscCall(PCAMGFSetFactor(pc, PC_AMGF_FACTOR_AUTO));
    PetscCall(KSPSetFromOptions(sim->control->ksp));
    PetscCall(KSPGetTolerances(sim->control->ksp, &sim->control->tolerances.linear, NULL, NULL, NULL));
    PetscCall(StiffnessSetModes(sim, sim->control->ksp, sim->K));
    PetscCall(KSPSetOperators(sim->control->ksp, sim->K, sim->K));
    if (sim->control->observer.linear)
      PetscCall(KSPMonitorSet(sim->control->ksp, sim->control->observer.linear, sim, NULL));
  } else PetscCall(KSPGetIterationNumber(sim->control->ksp, &its));
  PetscCall(KSPGetPC(sim->control->ksp, &pc));
  PetscCall(PathSolvesToCome(sim, &solves));
  PetscCall(
    PCAMGFExpect(pc, (PetscReal)solves * (its ? (PetscReal)its : usual), factored_iterations * (PetscReal)solves));
  *ksp = sim->control->ksp;
  PetscFunctionReturn(0);
}

/*
   Solves a quadratic load step without contact or bounds, for which one Newton step, K w = -force, is exact. resume:
   true if CG starts from u.
*/
PetscErrorCode LinearSolve(StepProblem *p, PetscBool resume, Vec u, StepReport *report)
{
  KSP                ksp = NULL;
  KSPConvergedReason reason;
  PCAMGFCounts       before;
  PetscInt           its;
  PetscReal          residual, scale;
  PetscLogDouble     t0, t1;

  PetscFunctionBegin;
  PetscCall(LinearGetKSP(p->sim, &ksp));
  PetscCall(ReportGetCounts(ksp, &before));
  PetscCall(PetscTime(&t0));
  if (SimulationIsDynamic(p->sim) && !resume) {
    PetscCall(PathContinue(p->sim, p->time, u));
    resume = PETSC_TRUE;
  }
  if (resume) PetscCall(VecWAXPY(p->w, -1.0, u, p->base));
  PetscCall(LinearSolvePatiently(p->sim, ksp, resume, p->force, p->w, &its));
  PetscCall(PetscTime(&t1));
  report->solve_time += t1 - t0;
  PetscCall(VecWAXPY(u, -1.0, p->w, p->base));
  PetscCall(KSPGetConvergedReason(ksp, &reason));
  PetscCall(ReportReason(report, (PetscBool)(reason > 0), KSPConvergedReasons[reason]));
  PetscCall(ReportIterations(report, 1, &its));
  PetscCall(ReportPreconditioner(ksp, &before, report));
  PetscCall(QuadraticEnergy(p, u, &report->potential));
  PetscCall(VecAXPY(p->Kw, 1.0, p->force));
  PetscCall(VecNorm(p->Kw, NORM_2, &residual));
  PetscCall(VecNorm(p->force, NORM_2, &scale));
  report->kkt_error_unscaled = residual;
  report->kkt_error          = scale > 0.0 ? residual / scale : residual;
  PetscFunctionReturn(0);
}

/*
   Solves A x = b by GMRES without a preconditioner, from x = 0. multiply: function for the product with the shell
   matrix A, whose context is `context`; rtol: relative tolerance; most: largest number of iterations; *found: true if
   GMRES converged.
*/
PetscErrorCode MatrixFreeSolve(Vec b, Vec x, void *context, PetscErrorCode (*multiply)(Mat, Vec, Vec), PetscReal rtol,
  PetscInt most, PetscBool *found)
{
  const MPI_Comm     comm = PetscObjectComm((PetscObject)b);
  Mat                shell;
  KSP                ksp;
  PC                 pc;
  KSPConvergedReason reason;
  PetscInt           n;

  PetscFunctionBegin;
  PetscCall(VecGetLocalSize(b, &n));
  PetscCall(MatCreateShell(comm, n, n, PETSC_DETERMINE, PETSC_DETERMINE, context, &shell));
  PetscCall(MatShellSetOperation(shell, MATOP_MULT, (AMGFOperation *)multiply));
  PetscCall(KSPCreate(comm, &ksp));
  PetscCall(KSPSetType(ksp, KSPGMRES));
  PetscCall(KSPGMRESSetRestart(ksp, most));
  PetscCall(KSPGetPC(ksp, &pc));
  PetscCall(PCSetType(pc, PCNONE));
  PetscCall(KSPSetOperators(ksp, shell, shell));
  PetscCall(KSPSetTolerances(ksp, rtol, PETSC_DEFAULT, PETSC_DEFAULT, most));
  PetscCall(KSPSolve(ksp, b, x));
  PetscCall(KSPGetConvergedReason(ksp, &reason));
  *found = (PetscBool)(reason > 0);
  PetscCall(KSPDestroy(&ksp));
  PetscCall(MatDestroy(&shell));
  PetscFunctionReturn(0);
}
