/* Solves linear systems: those of load steps without contact by PCG, those of contact updates by GMRES. */
#include "problemimpl.h"
#include <petsctime.h>
#include "src/state/control.h"
#include "src/state/path.h"

/* Creates the solver of load steps without contact: CG preconditioned by AMG, or by a factorization */
static PetscErrorCode LinearCreateKSP(Model model, State state, KSP *ksp)
{
  PC pc;

  PetscFunctionBegin;
  PetscCall(KSPCreate(model->comm, ksp));
  PetscCall(KSPSetOptionsPrefix(*ksp, "elasticity_"));
  PetscCall(KSPSetType(*ksp, KSPCG));
  PetscCall(KSPSetTolerances(*ksp, state->control->tolerances.linear, PETSC_DEFAULT, PETSC_DEFAULT, PETSC_DEFAULT));
  PetscCall(KSPGetPC(*ksp, &pc));
  PetscCall(PCSetType(pc, PCAMGF));
  PetscCall(PCAMGFSetFilterOptional(pc, PETSC_TRUE));
  PetscCall(PCAMGFSetFactor(pc, PC_AMGF_FACTOR_AUTO));
  PetscCall(KSPSetFromOptions(*ksp));
  PetscCall(StiffnessSetModes(model, *ksp, model->K));
  PetscCall(KSPSetOperators(*ksp, model->K, model->K));
  PetscFunctionReturn(0);
}

/* Returns the solver of load steps without contact. If its AMG was slow for earlier ones, it may factor the matrix. */
static PetscErrorCode LinearGetKSP(Simulation sim, KSP *ksp)
{
  PetscBool changed;
  PC        pc;

  PetscFunctionBegin;
  if (!sim->state->control->ksp) {
    PetscCall(LinearCreateKSP(sim->model, sim->state, &sim->state->control->ksp));
    PetscCall(KSPGetTolerances(sim->state->control->ksp, &sim->state->control->tolerances.linear, NULL, NULL, NULL));
    if (sim->state->control->observer.linear)
      PetscCall(KSPMonitorSet(sim->state->control->ksp, sim->state->control->observer.linear, sim, NULL));
  }
  PetscCall(KSPGetPC(sim->state->control->ksp, &pc));
  PetscCall(PCAMGFReconsiderFactor(pc, &changed));
  *ksp = sim->state->control->ksp;
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
  if (ModelIsDynamic(p->model) && !resume) {
    PetscCall(PathContinue(p->model, p->state, p->time, u));
    resume = PETSC_TRUE;
  }
  if (resume) PetscCall(StepProblemUntie(p, u));
  if (resume) PetscCall(VecWAXPY(p->w, -1.0, u, p->base));
  PetscCall(KSPSetInitialGuessNonzero(ksp, resume));
  PetscCall(KSPSolve(ksp, p->force, p->w));
  PetscCall(KSPSetInitialGuessNonzero(ksp, PETSC_FALSE));
  PetscCall(KSPGetIterationNumber(ksp, &its));
  PetscCall(PetscTime(&t1));
  report->solve_time += t1 - t0;
  PetscCall(VecWAXPY(u, -1.0, p->w, p->base));
  PetscCall(KSPGetConvergedReason(ksp, &reason));
  PetscCall(ReportReason(report, (PetscBool)(reason > 0), "%s", KSPConvergedReasons[reason]));
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
