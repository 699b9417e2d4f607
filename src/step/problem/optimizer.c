/* Solves load steps that have constraints, or an energy that is not quadratic, by TAO. */
#include "problemimpl.h"
#include <petsctime.h>
#include "src/state/contact_history.h"
#include "src/state/contact_state.h"
#include "src/state/control.h"
#include "src/state/interrupt.h"
#include "src/state/path.h"

/* Adds to the report the counts that only TAOIPFILTER provides. With another -tao_type these counts remain zero. */
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

/* Explains a failed solve: reports the bodies that contact cannot hold, or otherwise a list of likely causes. */
static PetscErrorCode OptimizerDiagnose(StepProblem *p, StepReport *report)
{
  char *unbounded;

  PetscFunctionBegin;
  PetscCall(StepProblemForesee(p, report));
  if (p->unsupported) PetscFunctionReturn(0);
  PetscCall(PetscStrstr(report->reason, "unbounded", &unbounded));
  if (unbounded) PetscCall(ReportReason(report, PETSC_FALSE, "no equilibrium was found: %s", report->reason));
  if (p->friction.T)
    PetscCall(ReportReason(report, PETSC_FALSE,
      "%s; possible causes: friction cannot hold a body, a body tips over, or a large coefficient wedges it",
      report->reason));
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
  PetscCall(ReportReason(report, (PetscBool)(reason > 0), "%s", sentence ? sentence : TaoConvergedReasons[reason]));
  if (reason < 0 && p->flowing) PetscCall(ProximalReportFlow(p, report));
  else if (reason < 0 && p->beyond_limit) PetscCall(FollowersReportLimit(p, report));
  else if (reason < 0 && !p->state->control->interrupted) PetscCall(OptimizerDiagnose(p, report));
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
  ContactLinearization lin   = p->state->solved->linearization;
  Vec                  slack = NULL, multipliers;

  PetscFunctionBegin;
  PetscCall(ContactSolutionCreate(lin->g, sol));
  PetscCall(StepProblemConstraint(tao, u, sol->gap, p));
  PetscCall(TaoGetDualVariables(tao, NULL, &multipliers));
  PetscCheck(multipliers, p->model->comm, PETSC_ERR_SUP,
    "the optimizer of -tao_type gives no multipliers, so contact pressures are unknown");
  PetscCall(VecQuotient_AMGF(sol->pressure, multipliers, lin->mass));
  PetscCall(VecScale(sol->pressure, StepProblemShare(p)));
  PetscCall(SoftKeep(p, lin, sol));
  PetscCall(FrictionKeep(p, tao, u, sol));
  if (ours) PetscCall(TaoIPFilterGetSlack(tao, &slack));
  PetscCall(ContactHistoryStore(p->state->history, lin, sol, slack ? slack : sol->gap,
    p->model->stiffness)); /* `slack` is NULL if there are no rows, or for another optimizer than TAOIPFILTER */
  PetscFunctionReturn(0);
}

/* Stores the subspace of this solve, so that the next solve with the same stiffness can reuse it. */
static PetscErrorCode OptimizerKeepSubspace(State state, Tao tao)
{
  PetscContainer space;

  PetscFunctionBegin;
  PetscCall(TaoIPFilterGetSubspace(tao, &space));
  PetscCall(PetscObjectReference((PetscObject)space));
  PetscCall(PetscContainerDestroy(&state->solved->subspace));
  state->solved->subspace = space;
  PetscFunctionReturn(0);
}

/*
   Gets the counts of the preconditioner before a solve, which are not zero if the subspace comes from earlier solves.
*/
static PetscErrorCode OptimizerGetCounts(Tao tao, PCAMGFCounts *counts)
{
  KSP ksp;

  PetscFunctionBegin;
  PetscCall(PetscMemzero(counts, sizeof(*counts)));
  PetscCall(TaoGetKSP(tao, &ksp));
  if (ksp) PetscCall(ReportGetCounts(ksp, counts));
  PetscFunctionReturn(0);
}

/*
   Solves the problem of a load step with TAO. resume: true if the solve starts from u and from the pressures of the
   last solve.
*/
PetscErrorCode OptimizerSolve(StepProblem *p, PetscBool resume, Vec u, StepReport *report, ContactSolution *sol)
{
  Tao            tao;
  PetscBool      ours, valid;
  PCAMGFCounts   before;
  PetscLogDouble t0, t1;

  PetscFunctionBegin;
  PetscCall(OptimizerCreate(p, &tao, &ours));
  PetscCall(StepProblemStart(p, resume, tao, u, &valid));
  if (valid) {
    PetscCall(TaoSetSolution(tao, u));
    PetscCall(OptimizerGetCounts(tao, &before));
    PetscCall(DMClearGlobalVectors(p->model->dm)); /* frees memory for the set-up of AMG */
    PetscCall(DMClearLocalVectors(p->model->dm));
    PetscCall(PetscTime(&t0));
    PetscCall(TaoSolve(tao));
    PetscCall(PetscTime(&t1));
    report->solve_time += t1 - t0;
    PetscCall(OptimizerReport(p, tao, ours, &before, u, report));
    if (p->state->control->interrupted) PetscCall(InterruptReport(p->state, report));
    if (ours) PetscCall(OptimizerKeepSubspace(p->state, tao));
    if (p->J && report->converged) PetscCall(OptimizerKeepContact(p, tao, ours, u, sol));
  } else PetscCall(ReportReason(report, PETSC_FALSE, STEP_INVERTED));
  PetscCall(TaoDestroy(&tao));
  PetscFunctionReturn(0);
}
