/* A load step that is a linear system: PCG. */
#include "stepimpl.h"
#include <petsctime.h>

static PetscErrorCode LinearGetKSP(Simulation sim, KSP *ksp)
{
  PC pc;

  PetscFunctionBegin;
  if (!sim->ksp) {
    PetscCall(KSPCreate(sim->comm, &sim->ksp));
    PetscCall(KSPSetOptionsPrefix(sim->ksp, "elasticity_"));
    PetscCall(KSPSetType(sim->ksp, KSPCG));
    PetscCall(KSPSetTolerances(sim->ksp, sim->tolerances.linear, PETSC_DEFAULT, PETSC_DEFAULT, PETSC_DEFAULT));
    PetscCall(KSPGetPC(sim->ksp, &pc));
    PetscCall(PCSetType(pc, PCAMGF));
    PetscCall(PCAMGFSetFilterOptional(pc, PETSC_TRUE));
    PetscCall(KSPSetFromOptions(sim->ksp));
    PetscCall(KSPGetTolerances(sim->ksp, &sim->tolerances.linear, NULL, NULL, NULL));
    PetscCall(StiffnessSetModes(sim, sim->ksp, sim->K));
    PetscCall(KSPSetOperators(sim->ksp, sim->K, sim->K));
  }
  *ksp = sim->ksp;
  PetscFunctionReturn(0);
}

/* A quadratic step without contact or bounds: one Newton step, K w = -force, is exact */
PetscErrorCode LinearSolve(StepProblem *p, Vec u, StepReport *report)
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
  PetscCall(KSPSolve(ksp, p->force, p->w));
  PetscCall(PetscTime(&t1));
  report->solve_time += t1 - t0;
  PetscCall(VecWAXPY(u, -1.0, p->w, p->base));
  PetscCall(KSPGetConvergedReason(ksp, &reason));
  PetscCall(ReportReason(report, (PetscBool)(reason > 0), KSPConvergedReasons[reason]));
  PetscCall(KSPGetIterationNumber(ksp, &its));
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
