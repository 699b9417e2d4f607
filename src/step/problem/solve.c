/* Solves the problem of a load step with one linearization of the contact, or without contact */
#include "problemimpl.h"
#include "src/state/control.h"

PetscErrorCode StepProblemSolve(StepProblem *p, PetscBool resume, Vec u, StepReport *report, ContactSolution *sol)
{
  const Constraints constraints = ModelConstraints(p->model);
  PetscInt          nsolves     = 0;
  PetscBool         again, rescued;

  PetscFunctionBegin;
  /*
     A solve of a problem without a solution takes long. At finite strain without friction the bodies may find an
     equilibrium far from the last state, so that nothing is tested before a solve has failed.
  */
  if (p->model->quadratic || p->friction.T) PetscCall(StepProblemForesee(p, report));
  if (p->unsupported) PetscFunctionReturn(0);
  p->model->bolts.nsolves = 0;
  PetscCall(PetscLogEventBegin(SIM_Solve, NULL, NULL, NULL, NULL));
  do {
    if (!nsolves) PetscCall(FollowersForget(p));
    if (!EnergyIsFinite(p->energy)) PetscCall(ReportReason(report, PETSC_FALSE, STEP_INVERTED));
    else if (p->model->quadratic && !p->J && !p->lower)
      PetscCall(LinearSolve(p, (PetscBool)(resume || nsolves), u, report));
    else PetscCall(OptimizerSolve(p, (PetscBool)(resume || nsolves), u, report, sol));
    if (report->converged) PetscCall(TiesFollow(&p->model->ties, u));
    PetscCall(ProximalAdvance(p, u, ++nsolves, report, &again));
    PetscCall(FollowersAdvance(p, u, nsolves, report, &again));
    PetscCall(StepProblemAdvanceBolts(p, u, report, &again));
    PetscCall(FollowersAdvanceMean(p, u, nsolves, report, &again));
    PetscCall(ProximalRescue(p, u, report, &rescued));
    if (rescued) nsolves = 0;
  } while (again || rescued);
  PetscCall(WeakSpringsTest(p, u, report));
  PetscCall(RigidTest(&constraints, (PetscBool)(!p->J || p->model->scene->contact_updates > 1), u, report));
  report->straightened = 0.0;
  if (report->converged) PetscCall(TiesStraighten(&constraints, p->time, u, &report->straightened));
  PetscCall(PetscLogEventEnd(SIM_Solve, NULL, NULL, NULL, NULL));
  PetscFunctionReturn(0);
}
