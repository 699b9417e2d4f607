/* Load steps with constraints, or with an energy that is not quadratic: solved by TAO. */
#include "stepimpl.h"
#include <petsctime.h>
#include "src/state/contact_history.h"
#include "src/state/contact_state.h"
#include "src/state/control.h"
#include "src/state/path.h"

/* Marks two options of share/options/pdipm.opts as used. PETSc releases differ in the name of one option; the file
   has both names, and PETSc would report the other one as unused. */
static PetscErrorCode OptimizerKnowBothNames(void)
{
  PetscBool given;

  PetscFunctionBegin;
  PetscCall(PetscOptionsHasName(NULL, NULL, "-tao_pdipm_solve_symmetric_kkt", &given));
  PetscCall(PetscOptionsHasName(NULL, NULL, "-tao_pdipm_symmetric_kkt", &given));
  PetscFunctionReturn(0);
}

/* Sets the tolerance of early contact updates, p->tolerance. It applies only to the filtered subspace method, which
   continues from an inexact solution. The interior point method cannot reuse one. */
static PetscErrorCode OptimizerSetTolerance(StepProblem *p, PetscBool ours, Tao tao)
{
  const char *const uses[] = {"false", "true", "auto"};
  PetscInt          use;
  PetscBool         given, interior;

  PetscFunctionBegin;
  PetscCall(
    PetscOptionsGetEList(NULL, NULL, "-tao_ipfilter_subspace", uses, PETSC_STATIC_ARRAY_LENGTH(uses), &use, &given));
  interior       = (PetscBool)(!ours || (given && !use && !p->friction.T));
  p->ended_early = (PetscBool)(p->tolerance > p->sim->control->tolerances.optimizer && !p->centre && !interior);
  if (p->ended_early) PetscCall(TaoSetTolerances(tao, p->tolerance, PETSC_DEFAULT, PETSC_DEFAULT));
  PetscFunctionReturn(0);
}

/* Creates the optimizer of a load step. ours: false if -tao_type chose another type than ipfilter */
static PetscErrorCode OptimizerCreate(StepProblem *p, Tao *tao, PetscBool *ours)
{
  Simulation sim = p->sim;
  PetscInt   solves;
  KSP        ksp;
  Vec        c;

  PetscFunctionBegin;
  PetscCall(TaoCreate(sim->comm, tao));
  PetscCall(TaoSetType(*tao, TAOIPFILTER));
  if (sim->quadratic) {
    PetscCall(TaoSetObjectiveAndGradient(*tao, NULL, QuadraticObjectiveAndGradient, p));
    PetscCall(TaoSetHessian(*tao, p->K, p->K, StepProblemConstant, p));
  } else {
    PetscCall(TaoSetObjective(*tao, EnergyObjective, p));
    PetscCall(TaoSetObjectiveAndGradient(*tao, NULL, EnergyObjectiveAndGradient, p));
    PetscCall(TaoSetHessian(*tao, p->K, p->K, EnergyHessian, p));
    if (!SimulationIsDynamic(sim)) PetscCall(TaoMonitorSet(*tao, EnergyTestFlow, p, NULL));
  }
  if (p->J) {
    PetscCall(VecDuplicate(p->g, &c));
    PetscCall(TaoSetInequalityConstraintsRoutine(*tao, c, StepProblemConstraint, p));
    PetscCall(TaoSetJacobianInequalityRoutine(*tao, p->J, p->J, StepProblemConstant, p));
    PetscCall(VecDestroy(&c));
    PetscCall(TaoIPFilterSetSlackMass(*tao, sim->solved->linearization->mass));
  }
  PetscCall(TaoIPFilterSetPrimalMass(*tao, sim->mass));
  PetscCall(TaoSetTolerances(*tao, sim->control->tolerances.optimizer, PETSC_DEFAULT, PETSC_DEFAULT));
  PetscCall(TaoSetFromOptions(*tao));
  PetscCall(OptimizerKnowBothNames());
  PetscCall(TaoGetTolerances(*tao, &sim->control->tolerances.optimizer, NULL, NULL));
  PetscCall(PetscObjectTypeCompare((PetscObject)*tao, TAOIPFILTER, ours));
  PetscCall(OptimizerSetTolerance(p, *ours, *tao));
  if (!*ours && !p->lower)
    PetscCall(StepProblemSetBounds(p, PETSC_INFINITY)); /* TAOPDIPM of PETSc 3.18 reads bounds even if there are none */
  if (p->lower) PetscCall(TaoSetVariableBounds(*tao, p->lower, p->upper));
  PetscCall(TaoGetKSP(*tao, &ksp));
  PetscCall(StiffnessSetModes(sim, ksp, p->K));
  if (*ours && sim->solved->subspace) PetscCall(TaoIPFilterSetSubspace(*tao, sim->solved->subspace));
  PetscCheck(*ours || !p->friction.T, sim->comm, PETSC_ERR_SUP,
    "friction needs -tao_type ipfilter; other optimizers do not support it");
  PetscCall(PathSolvesToCome(sim, &solves));
  PetscCall(TaoIPFilterSetSolvesToCome(*tao, solves));
  PetscCall(TaoMonitorSet(*tao, InterruptMonitor, sim, NULL));
  if (sim->control->observer.optimizer) PetscCall(TaoMonitorSet(*tao, sim->control->observer.optimizer, sim, NULL));
  PetscFunctionReturn(0);
}

/* Passes the pressures of the last solve, times scale, and its slacks to the optimizer as a start. any: whether any
   row had a pressure */
static PetscErrorCode OptimizerRecallContact(StepProblem *p, PetscReal scale, Tao tao, PetscBool *any)
{
  Vec slack, pressure;

  PetscFunctionBegin;
  PetscCall(VecDuplicate(p->g, &slack));
  PetscCall(VecDuplicate(p->g, &pressure));
  PetscCall(ContactHistoryRecall(p->sim->history, p->sim->solved->linearization, scale / StepProblemShare(p), slack,
    pressure, any));
  if (*any) PetscCall(TaoIPFilterSetWarmStart(tao, slack, pressure));
  PetscCall(VecDestroy(&slack));
  PetscCall(VecDestroy(&pressure));
  PetscFunctionReturn(0);
}

/*
   Sets the start u. With `resume` u stays as it is. A new load step starts from the extrapolated path if the last step
   had contact pressures, else from base. The extrapolation is used only if its energy is finite. valid: false if an
   element is inverted at base
*/
static PetscErrorCode OptimizerStart(StepProblem *p, PetscBool resume, Tao tao, Vec u, PetscBool *valid)
{
  Simulation sim = p->sim;
  PetscReal  f = 0.0, scale = 0.0;
  PetscBool  moved = (PetscBool)(resume || SimulationIsDynamic(sim));

  PetscFunctionBegin;
  *valid = PETSC_TRUE;
  if (p->J && (resume || sim->control->warm)) {
    if (resume) scale = 1.0;
    else PetscCall(PathPressureScale(sim, p->time, &scale));
    PetscCall(OptimizerRecallContact(p, scale, tao, &moved));
  }
  if (p->J) PetscCall(FrictionGive(p, tao, moved ? scale : 0.0));
  if (resume) PetscFunctionReturn(0);
  if (!p->J) moved = sim->control->warm;
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

/* Adds to the report what only TAOIPFILTER counts. With another -tao_type these counts stay zero. */
static PetscErrorCode OptimizerReportOurs(Tao tao, const PCAMGFCounts *before, StepReport *report)
{
  const PetscInt      *its;
  TaoIPFilterFallbacks fallbacks;
  PetscInt             n, systems, filtered, indefinite;
  KSP                  ksp;

  PetscFunctionBegin;
  PetscCall(TaoIPFilterGetKSPIterations(tao, &n, &its));
  PetscCall(ReportIterations(report, n, its));
  PetscCall(TaoIPFilterGetFilterUse(tao, &systems, &filtered));
  report->systems += systems;
  report->filtered_systems += filtered;
  PetscCall(TaoIPFilterGetRegularizations(tao, &indefinite, NULL, NULL));
  report->regularizations += indefinite;
  PetscCall(TaoIPFilterGetFallbacks(tao, &fallbacks));
  PetscCall(ReportFallbacks(report, &fallbacks));
  PetscCall(TaoIPFilterGetKKTError(tao, &report->kkt_error, &report->kkt_error_unscaled));
  PetscCall(TaoGetKSP(tao, &ksp));
  if (ksp) PetscCall(ReportPreconditioner(ksp, before, report));
  PetscFunctionReturn(0);
}

/* Appends the likely causes of a failed solve with friction to the reason */
static PetscErrorCode OptimizerSuspectFriction(StepReport *report)
{
  char reason[512];

  PetscFunctionBegin;
  PetscCall(PetscSNPrintf(reason, sizeof(reason),
    "%s; possible causes: friction cannot hold a body, a body tips over, or a large coefficient wedges it",
    report->reason));
  PetscCall(ReportReason(report, PETSC_FALSE, reason));
  PetscFunctionReturn(0);
}

/* Whether contact forces can balance the loads; in dynamics inertia balances the rest. With friction this is tested
   before a solve, because a solve without a solution takes long */
static PetscErrorCode OptimizerForesee(StepProblem *p, StepReport *report)
{
  PetscFunctionBegin;
  if (!p->lower && !SimulationIsDynamic(p->sim))
    PetscCall(EquilibriumDiagnose(p->sim, p->time, p->load, report, &p->unheld));
  PetscFunctionReturn(0);
}

/* Explains a failed solve: names the bodies that contact cannot hold, or else lists likely causes */
static PetscErrorCode OptimizerDiagnose(StepProblem *p, StepReport *report)
{
  char  reason[512];
  char *unbounded;

  PetscFunctionBegin;
  if (!p->friction.T) PetscCall(OptimizerForesee(p, report));
  if (p->unheld) PetscFunctionReturn(0);
  PetscCall(PetscStrstr(report->reason, "unbounded", &unbounded));
  if (unbounded) {
    PetscCall(PetscSNPrintf(reason, sizeof(reason), "no equilibrium was found: %s", report->reason));
    PetscCall(ReportReason(report, PETSC_FALSE, reason));
  }
  if (p->friction.T) PetscCall(OptimizerSuspectFriction(report));
  PetscFunctionReturn(0);
}

static PetscErrorCode OptimizerReportFlow(const StepProblem *p, StepReport *report)
{
  char reason[512];

  PetscFunctionBegin;
  PetscCall(PetscSNPrintf(reason, sizeof(reason),
    "no equilibrium exists at time %g: body \"%s\" flows plastically, for the load is beyond the collapse load; the "
    "last "
    "equilibrium is at time %g",
    (double)p->time, p->flowing, (double)p->sim->path->time));
  PetscCall(ReportReason(report, PETSC_FALSE, reason));
  PetscFunctionReturn(0);
}

static PetscErrorCode OptimizerReport(StepProblem *p, Tao tao, PetscBool ours, const PCAMGFCounts *before, Vec u,
  StepReport *report)
{
  TaoConvergedReason reason;
  const char        *sentence = NULL;
  PetscReal          residual, infeasibility;
  PetscInt           n;

  PetscFunctionBegin;
  PetscCall(TaoGetConvergedReason(tao, &reason));
  if (ours) PetscCall(TaoIPFilterGetReason(tao, &sentence));
  PetscCall(ReportReason(report, (PetscBool)(reason > 0), sentence ? sentence : TaoConvergedReasons[reason]));
  if (reason < 0 && p->flowing) PetscCall(OptimizerReportFlow(p, report));
  else if (reason < 0 && !p->sim->control->interrupted) PetscCall(OptimizerDiagnose(p, report));
  PetscCall(TaoGetIterationNumber(tao, &n));
  report->ip_iterations += n;
  if (ours) PetscCall(OptimizerReportOurs(tao, before, report));
  else {
    PetscCall(TaoGetSolutionStatus(tao, NULL, NULL, &residual, &infeasibility, NULL, NULL));
    report->kkt_error = report->kkt_error_unscaled = PetscMax(residual, infeasibility);
  }
  PetscCall(TaoComputeObjective(tao, u, &report->potential));
  PetscFunctionReturn(0);
}

static PetscErrorCode OptimizerKeepContact(StepProblem *p, Tao tao, PetscBool ours, Vec u, ContactSolution *sol)
{
  ContactLinearization lin   = p->sim->solved->linearization;
  Vec                  slack = NULL, multipliers;

  PetscFunctionBegin;
  PetscCall(ContactSolutionCreate(lin->g, sol));
  PetscCall(StepProblemConstraint(tao, u, sol->gap, p));
  PetscCall(TaoGetDualVariables(tao, NULL, &multipliers));
  PetscCheck(multipliers, p->sim->comm, PETSC_ERR_SUP,
    "the optimizer of -tao_type gives no multipliers, so contact pressures are unknown");
  PetscCall(VecPointwiseDivide(sol->pressure, multipliers, lin->mass));
  PetscCall(VecScale(sol->pressure, StepProblemShare(p)));
  PetscCall(FrictionKeep(p, tao, u, sol));
  if (ours) PetscCall(TaoIPFilterGetSlack(tao, &slack));
  PetscCall(ContactHistoryStore(p->sim->history, lin, sol, slack ? slack : sol->gap,
    p->sim->stiffness)); /* NULL without rows; only TAOIPFILTER has slacks */
  PetscFunctionReturn(0);
}

/* Keeps the subspace of this solve for the next solve with the same stiffness */
static PetscErrorCode OptimizerKeepSubspace(Simulation sim, Tao tao)
{
  PetscContainer space;

  PetscFunctionBegin;
  PetscCall(TaoIPFilterGetSubspace(tao, &space));
  PetscCall(PetscObjectReference((PetscObject)space));
  PetscCall(PetscContainerDestroy(&sim->solved->subspace));
  sim->solved->subspace = space;
  PetscFunctionReturn(0);
}

/* Counts of the preconditioner before this solve; the subspace may come from earlier solves */
static PetscErrorCode OptimizerGetCounts(Tao tao, PCAMGFCounts *counts)
{
  KSP ksp;

  PetscFunctionBegin;
  PetscCall(PetscMemzero(counts, sizeof(*counts)));
  PetscCall(TaoGetKSP(tao, &ksp));
  if (ksp) PetscCall(ReportGetCounts(ksp, counts));
  PetscFunctionReturn(0);
}

/* resume: start from u as it is, with the pressures of the last solve */
PetscErrorCode OptimizerSolve(StepProblem *p, PetscBool resume, Vec u, StepReport *report, ContactSolution *sol)
{
  Simulation     sim = p->sim;
  Tao            tao;
  PetscBool      ours, valid;
  PCAMGFCounts   before;
  PetscLogDouble t0, t1;

  PetscFunctionBegin;
  if (p->friction.T && !resume) PetscCall(OptimizerForesee(p, report));
  if (p->unheld) PetscFunctionReturn(0);
  PetscCall(OptimizerCreate(p, &tao, &ours));
  PetscCall(OptimizerStart(p, resume, tao, u, &valid));
  if (valid) {
    PetscCall(TaoSetSolution(tao, u));
    PetscCall(OptimizerGetCounts(tao, &before));
    PetscCall(PetscTime(&t0));
    PetscCall(TaoSolve(tao));
    PetscCall(PetscTime(&t1));
    report->solve_time += t1 - t0;
    PetscCall(OptimizerReport(p, tao, ours, &before, u, report));
    if (sim->control->interrupted) PetscCall(InterruptReport(sim, report));
    if (ours) PetscCall(OptimizerKeepSubspace(sim, tao));
    if (p->J && report->converged) PetscCall(OptimizerKeepContact(p, tao, ours, u, sol));
  } else PetscCall(ReportReason(report, PETSC_FALSE, STEP_INVERTED));
  PetscCall(TaoDestroy(&tao));
  PetscFunctionReturn(0);
}
