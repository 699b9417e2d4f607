/* Solving the quadratic model of a load step: by PCG without contact, by TAO with it. */
#include "quadratic.h"
#include <petsctime.h>

/* One Newton step is exact: K w = -force */
PetscErrorCode QuadraticSolveFree(QuadraticModel *q, Vec u, StepReport *report)
{
  KSP                ksp;
  PC                 pc;
  KSPConvergedReason reason;
  PetscReal          f, residual, scale;
  PetscLogDouble     t0, t1;

  PetscFunctionBegin;
  PetscCall(KSPCreate(PetscObjectComm((PetscObject)u), &ksp));
  PetscCall(KSPSetOptionsPrefix(ksp, "elasticity_"));
  PetscCall(KSPSetOperators(ksp, q->K, q->K));
  PetscCall(KSPSetType(ksp, KSPCG));
  PetscCall(KSPSetTolerances(ksp, 1e-10, PETSC_DEFAULT, PETSC_DEFAULT, PETSC_DEFAULT));
  PetscCall(KSPGetPC(ksp, &pc));
  PetscCall(PCSetType(pc, PCAMGF));
  PetscCall(KSPSetFromOptions(ksp));
  PetscCall(PetscTime(&t0));
  PetscCall(KSPSolve(ksp, q->force, q->w));
  PetscCall(PetscTime(&t1));
  PetscCall(VecWAXPY(u, -1.0, q->w, q->base));
  PetscCall(KSPGetConvergedReason(ksp, &reason));
  report->solve_time = t1 - t0;
  report->converged  = (PetscBool)(reason > 0);
  PetscCall(PetscStrallocpy(KSPConvergedReasons[reason], (char **)&report->reason));
  report->nksp       = 1;
  PetscCall(PetscMalloc1(1, &report->ksp_iterations));
  PetscCall(KSPGetIterationNumber(ksp, report->ksp_iterations));
  PetscCall(ReportPreconditioner(ksp, report));
  PetscCall(QuadraticEnergy(q, u, &f));
  PetscCall(VecAXPY(q->Kw, 1.0, q->force));
  PetscCall(VecNorm(q->Kw, NORM_2, &residual));
  PetscCall(VecNorm(q->force, NORM_2, &scale));
  report->energy             = f;
  report->kkt_error_unscaled = residual;
  report->kkt_error          = scale > 0.0 ? residual / scale : residual;
  PetscCall(KSPDestroy(&ksp));
  PetscFunctionReturn(0);
}

/*
   Later steps start from the path of the last two states continued to this step's load, and from pressures scaled with
   it: for proportional loading of linear bodies only the edge of the contact area changes.
*/
static PetscErrorCode ContactStart(Simulation sim, PetscReal load, ContactLinearization lin, Tao tao, Vec u)
{
  const LoadPath *path  = &sim->path;
  const PetscReal span  = path->load - path->previous_load;
  const PetscReal ratio = span != 0.0 ? (load - path->load) / span : 0.0;
  Vec             slack, pressure;
  PetscBool       any;

  PetscFunctionBegin;
  if (!sim->warm) PetscFunctionReturn(0);
  PetscCall(VecDuplicate(lin->g, &slack));
  PetscCall(VecDuplicate(lin->g, &pressure));
  PetscCall(ContactMemoryRecall(&sim->memory, lin, path->load != 0.0 ? load / path->load : 1.0, slack, pressure, &any));
  if (any) {
    PetscCall(VecCopy(path->u, u));
    PetscCall(VecAXPY(u, ratio, path->u));
    PetscCall(VecAXPY(u, -ratio, path->previous_u));
    PetscCall(PrescribedApply(&sim->prescribed, load, u));
    PetscCall(TaoIPFilterSetWarmStart(tao, slack, pressure));
  }
  PetscCall(VecDestroy(&slack));
  PetscCall(VecDestroy(&pressure));
  PetscFunctionReturn(0);
}

static PetscErrorCode QuadraticCreateTao(Simulation sim, QuadraticModel *q, Tao *tao)
{
  Vec c;

  PetscFunctionBegin;
  PetscCall(TaoCreate(sim->comm, tao));
  PetscCall(TaoSetType(*tao, TAOIPFILTER));
  PetscCall(TaoSetObjectiveAndGradient(*tao, NULL, QuadraticObjectiveAndGradient, q));
  PetscCall(TaoSetHessian(*tao, q->K, q->K, QuadraticHessian, q));
  PetscCall(VecDuplicate(q->g, &c));
  PetscCall(TaoSetInequalityConstraintsRoutine(*tao, c, QuadraticConstraint, q));
  PetscCall(TaoSetJacobianInequalityRoutine(*tao, q->J, q->J, QuadraticJacobian, q));
  PetscCall(VecDestroy(&c));
  PetscCall(TaoIPFilterSetSlackMass(*tao, sim->linearization->mass));
  PetscCall(TaoIPFilterSetPrimalMass(*tao, sim->mass));
  PetscCall(TaoSetFromOptions(*tao));
  PetscFunctionReturn(0);
}

static PetscErrorCode ReportTao(Tao tao, StepReport *report)
{
  TaoConvergedReason reason;
  const char        *sentence;
  const PetscInt    *its;
  KSP                ksp;

  PetscFunctionBegin;
  PetscCall(TaoGetConvergedReason(tao, &reason));
  report->converged = (PetscBool)(reason > 0);
  PetscCall(TaoIPFilterGetReason(tao, &sentence));
  PetscCall(PetscStrallocpy(sentence ? sentence : TaoConvergedReasons[reason], (char **)&report->reason));
  PetscCall(TaoGetIterationNumber(tao, &report->ip_iterations));
  PetscCall(TaoIPFilterGetKSPIterations(tao, &report->nksp, &its));
  PetscCall(PetscMalloc1(report->nksp, &report->ksp_iterations));
  PetscCall(PetscArraycpy(report->ksp_iterations, its, report->nksp));
  PetscCall(TaoIPFilterGetKKTError(tao, &report->kkt_error, &report->kkt_error_unscaled));
  PetscCall(TaoGetKSP(tao, &ksp));
  if (ksp) PetscCall(ReportPreconditioner(ksp, report));
  PetscFunctionReturn(0);
}

PetscErrorCode QuadraticSolveContact(Simulation sim, QuadraticModel *q, Vec u, StepReport *report, ContactSolution *sol)
{
  ContactLinearization lin = sim->linearization;
  Tao                  tao;
  Vec                  slack, multipliers;
  PetscLogDouble       t0, t1;

  PetscFunctionBegin;
  PetscCall(QuadraticCreateTao(sim, q, &tao));
  PetscCall(VecCopy(q->base, u));
  PetscCall(ContactStart(sim, report->load, lin, tao, u));
  PetscCall(TaoSetSolution(tao, u));
  PetscCall(PetscTime(&t0));
  PetscCall(TaoSolve(tao));
  PetscCall(PetscTime(&t1));
  report->solve_time = t1 - t0;
  PetscCall(ReportTao(tao, report));
  PetscCall(QuadraticEnergy(q, u, &report->energy));

  PetscCall(VecDuplicate(lin->g, &sol->gap));
  PetscCall(VecDuplicate(lin->g, &sol->pressure));
  PetscCall(QuadraticConstraint(tao, u, sol->gap, q));
  PetscCall(TaoGetDualVariables(tao, NULL, &multipliers));
  PetscCall(VecPointwiseDivide(sol->pressure, multipliers, lin->mass));
  PetscCall(TaoIPFilterGetSlack(tao, &slack));
  PetscCall(ContactMemoryStore(&sim->memory, lin, sol, slack));
  PetscCall(TaoDestroy(&tao));
  PetscFunctionReturn(0);
}
