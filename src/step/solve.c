/* Solving the problem of a load step: by PCG where it is linear, by TAO where it is not. */
#include "stepimpl.h"
#include <petsctime.h>

static PetscErrorCode SimulationGetKSP(Simulation sim, KSP *ksp)
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
    PetscCall(KSPSetFromOptions(sim->ksp));
    PetscCall(KSPGetTolerances(sim->ksp, &sim->tolerances.linear, NULL, NULL, NULL));
    PetscCall(StiffnessSetModes(sim, sim->ksp, sim->K));
    PetscCall(KSPSetOperators(sim->ksp, sim->K, sim->K));
  }
  *ksp = sim->ksp;
  PetscFunctionReturn(0);
}

static PetscErrorCode KSPGetAMGFCounts(KSP ksp, PCAMGFCounts *counts)
{
  PC        pc;
  PetscBool isamgf;

  PetscFunctionBegin;
  PetscCall(PetscMemzero(counts, sizeof(*counts)));
  PetscCall(KSPGetPC(ksp, &pc));
  PetscCall(PetscObjectTypeCompare((PetscObject)pc, PCAMGF, &isamgf));
  if (isamgf) PetscCall(PCAMGFGetCounts(pc, counts));
  PetscFunctionReturn(0);
}

/* A quadratic step without contact or bounds: one Newton step, K w = -force, is exact */
PetscErrorCode SolveLinear(StepProblem *p, Vec u, StepReport *report)
{
  KSP                ksp = NULL;
  KSPConvergedReason reason;
  PCAMGFCounts       before;
  PetscInt           its;
  PetscReal          residual, scale;
  PetscLogDouble     t0, t1;

  PetscFunctionBegin;
  PetscCall(SimulationGetKSP(p->sim, &ksp));
  PetscCall(KSPGetAMGFCounts(ksp, &before));
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

/* ours: false where -tao_type has chosen another optimizer */
static PetscErrorCode StepCreateTao(StepProblem *p, Tao *tao, PetscBool *ours)
{
  Simulation sim = p->sim;
  KSP        ksp;
  Vec        c;

  PetscFunctionBegin;
  PetscCall(TaoCreate(sim->comm, tao));
  PetscCall(TaoSetType(*tao, TAOIPFILTER));
  if (sim->quadratic) {
    PetscCall(TaoSetObjectiveAndGradient(*tao, NULL, QuadraticObjectiveAndGradient, p));
    PetscCall(TaoSetHessian(*tao, p->K, p->K, StepConstant, p));
  } else {
    PetscCall(TaoSetObjective(*tao, EnergyObjective, p));
    PetscCall(TaoSetObjectiveAndGradient(*tao, NULL, EnergyObjectiveAndGradient, p));
    PetscCall(TaoSetHessian(*tao, p->K, p->K, EnergyHessian, p));
  }
  if (p->J) {
    PetscCall(VecDuplicate(p->g, &c));
    PetscCall(TaoSetInequalityConstraintsRoutine(*tao, c, StepConstraint, p));
    PetscCall(TaoSetJacobianInequalityRoutine(*tao, p->J, p->J, StepConstant, p));
    PetscCall(VecDestroy(&c));
    PetscCall(TaoIPFilterSetSlackMass(*tao, sim->linearization->mass));
  }
  PetscCall(TaoIPFilterSetPrimalMass(*tao, sim->mass));
  PetscCall(TaoSetTolerances(*tao, sim->tolerances.optimizer, PETSC_DEFAULT, PETSC_DEFAULT));
  PetscCall(TaoSetFromOptions(*tao));
  PetscCall(TaoGetTolerances(*tao, &sim->tolerances.optimizer, NULL, NULL));
  PetscCall(PetscObjectTypeCompare((PetscObject)*tao, TAOIPFILTER, ours));
  if (!*ours && !p->lower) PetscCall(StepProblemSetBounds(p, PETSC_INFINITY)); /* PETSc 3.18's TAOPDIPM reads bounds whether there are any or not */
  if (p->lower) PetscCall(TaoSetVariableBounds(*tao, p->lower, p->upper));
  PetscCall(TaoGetKSP(*tao, &ksp));
  PetscCall(StiffnessSetModes(sim, ksp, p->K));
  PetscCall(TaoSetMonitor(*tao, InterruptMonitor, sim, NULL));
  PetscFunctionReturn(0);
}

/* Pressures and slacks of the last solve, where any row had a pressure */
static PetscErrorCode SolveRecallContact(StepProblem *p, PetscReal scale, Tao tao, PetscBool *any)
{
  Vec slack, pressure;

  PetscFunctionBegin;
  PetscCall(VecDuplicate(p->g, &slack));
  PetscCall(VecDuplicate(p->g, &pressure));
  PetscCall(ContactMemoryRecall(&p->sim->memory, p->sim->linearization, scale, slack, pressure, any));
  if (*any) PetscCall(TaoIPFilterSetWarmStart(tao, slack, pressure));
  PetscCall(VecDestroy(&slack));
  PetscCall(VecDestroy(&pressure));
  PetscFunctionReturn(0);
}

/*
   A solve resumes from u when only the gap was linearized again. A new load step starts from the path continued to it
   once there is contact to continue (for proportional loading of linear bodies only the edge of the contact area then
   changes), else from base; either only if no element is turned inside out there.
*/
static PetscErrorCode SolveStart(StepProblem *p, PetscBool resume, Tao tao, Vec u, PetscBool *valid)
{
  Simulation sim   = p->sim;
  PetscReal  f     = 0.0, scale;
  PetscBool  moved = resume;

  PetscFunctionBegin;
  *valid = PETSC_TRUE;
  if (p->J && (resume || sim->warm)) {
    if (resume) scale = 1.0;
    else PetscCall(PathPressureScale(sim, p->time, &scale));
    PetscCall(SolveRecallContact(p, scale, tao, &moved));
  }
  if (resume) PetscFunctionReturn(0);
  if (!p->J) moved = sim->warm;
  if (moved) {
    PetscCall(PathContinue(sim, p->time, u));
    if (!sim->quadratic) PetscCall(ElasticityEnergy(sim->elasticity, u, &f));
    if (EnergyIsFinite(f)) PetscFunctionReturn(0);
  }
  PetscCall(VecCopy(p->base, u));
  if (!sim->quadratic) PetscCall(ElasticityEnergy(sim->elasticity, u, &f));
  *valid = EnergyIsFinite(f);
  PetscFunctionReturn(0);
}

static void SolveAddFallbacks(const TaoIPFilterFallbacks *solve, TaoIPFilterFallbacks *sum)
{
  sum->refinements += solve->refinements;
  sum->amg_rebuilds += solve->amg_rebuilds;
  sum->filters += solve->filters;
  sum->direct += solve->direct;
  sum->failures += solve->failures;
  sum->backward_error = PetscMax(sum->backward_error, solve->backward_error);
}

/* What only our own optimizer tells; another one chosen by -tao_type leaves it at zero, but for its own residual */
static PetscErrorCode SolveReportIPFilter(Tao tao, StepReport *report)
{
  static const PCAMGFCounts none = {0, 0, 0, 0};
  const PetscInt           *its;
  TaoIPFilterFallbacks      fallbacks;
  PetscInt                  n, systems, filtered, indefinite;
  KSP                       ksp;

  PetscFunctionBegin;
  PetscCall(TaoIPFilterGetKSPIterations(tao, &n, &its));
  PetscCall(ReportIterations(report, n, its));
  PetscCall(TaoIPFilterGetFilterUse(tao, &systems, &filtered));
  report->systems += systems;
  report->filtered_systems += filtered;
  PetscCall(TaoIPFilterGetRegularizations(tao, &indefinite, NULL, NULL));
  report->regularizations += indefinite;
  PetscCall(TaoIPFilterGetFallbacks(tao, &fallbacks));
  SolveAddFallbacks(&fallbacks, &report->linear);
  PetscCall(TaoIPFilterGetKKTError(tao, &report->kkt_error, &report->kkt_error_unscaled));
  PetscCall(TaoGetKSP(tao, &ksp));
  if (ksp) PetscCall(ReportPreconditioner(ksp, &none, report));
  PetscFunctionReturn(0);
}

static PetscErrorCode SolveReport(Tao tao, PetscBool ours, Vec u, StepReport *report)
{
  TaoConvergedReason reason;
  const char        *sentence = NULL;
  PetscReal          residual, infeasibility;
  PetscInt           n;

  PetscFunctionBegin;
  PetscCall(TaoGetConvergedReason(tao, &reason));
  if (ours) PetscCall(TaoIPFilterGetReason(tao, &sentence));
  PetscCall(ReportReason(report, (PetscBool)(reason > 0), sentence ? sentence : TaoConvergedReasons[reason]));
  PetscCall(TaoGetIterationNumber(tao, &n));
  report->ip_iterations += n;
  if (ours) PetscCall(SolveReportIPFilter(tao, report));
  else {
    PetscCall(TaoGetSolutionStatus(tao, NULL, NULL, &residual, &infeasibility, NULL, NULL));
    report->kkt_error = report->kkt_error_unscaled = PetscMax(residual, infeasibility);
  }
  PetscCall(TaoComputeObjective(tao, u, &report->potential));
  PetscFunctionReturn(0);
}

static PetscErrorCode SolveKeepContact(StepProblem *p, Tao tao, PetscBool ours, Vec u, ContactSolution *sol)
{
  ContactLinearization lin = p->sim->linearization;
  Vec                  slack = NULL, multipliers;

  PetscFunctionBegin;
  PetscCall(ContactSolutionDestroy(sol));
  PetscCall(VecDuplicate(lin->g, &sol->gap));
  PetscCall(VecDuplicate(lin->g, &sol->pressure));
  PetscCall(StepConstraint(tao, u, sol->gap, p));
  PetscCall(TaoGetDualVariables(tao, NULL, &multipliers));
  PetscCheck(multipliers, p->sim->comm, PETSC_ERR_SUP, "-tao_type gives no multipliers, and so no contact pressures");
  PetscCall(VecPointwiseDivide(sol->pressure, multipliers, lin->mass));
  if (ours) PetscCall(TaoIPFilterGetSlack(tao, &slack));
  PetscCall(ContactMemoryStore(&p->sim->memory, lin, sol, slack ? slack : sol->gap)); /* no rows, or another optimizer: no slacks */
  PetscFunctionReturn(0);
}

/* resume: start from u as it is, with the pressures of the last solve */
PetscErrorCode SolveTao(StepProblem *p, PetscBool resume, Vec u, StepReport *report, ContactSolution *sol)
{
  Simulation     sim = p->sim;
  Tao            tao;
  PetscBool      ours, valid;
  PetscLogDouble t0, t1;

  PetscFunctionBegin;
  PetscCall(StepCreateTao(p, &tao, &ours));
  PetscCall(SolveStart(p, resume, tao, u, &valid));
  if (valid) {
    PetscCall(TaoSetSolution(tao, u));
    PetscCall(PetscTime(&t0));
    PetscCall(TaoSolve(tao));
    PetscCall(PetscTime(&t1));
    report->solve_time += t1 - t0;
    PetscCall(SolveReport(tao, ours, u, report));
    if (sim->interrupted) PetscCall(InterruptReport(sim, report));
    if (p->J && report->converged) PetscCall(SolveKeepContact(p, tao, ours, u, sol));
  } else PetscCall(ReportReason(report, PETSC_FALSE, STEP_INVERTED));
  PetscCall(TaoDestroy(&tao));
  PetscFunctionReturn(0);
}

PetscErrorCode ContactSolutionDestroy(ContactSolution *sol)
{
  PetscFunctionBegin;
  PetscCall(VecDestroy(&sol->pressure));
  PetscCall(VecDestroy(&sol->gap));
  PetscFunctionReturn(0);
}
