/*
   Dual shape functions for pairs with gap: auto. With mortar gaps the contact force of a row acts at the centre of its
   shape function. No resultant then reaches the edge of a coarse face, and a vertex at the edge may penetrate while its
   neighbours lift off. Dual functions have neither defect. If an attempt at a load step fails, it is therefore repeated
   with them. If that succeeds, they are used until the end of the run.
*/
#include "stepimpl.h"
#include "src/state/contact_history.h"
#include "src/state/contact_state.h"
#include "src/state/control.h"
#include "src/state/path.h"

/* Sets the functions. What the optimizer has kept of the other problem, such as directions, is destroyed */
static PetscErrorCode DualGapsSet(Model model, State state, PetscBool dual, PetscBool *changed)
{
  PetscFunctionBegin;
  PetscCall(ContactSetDual(model->contact, dual ? CONTACT_DUAL_AUTO : CONTACT_DUAL_NONE, changed));
  if (!*changed) PetscFunctionReturn(0);
  PetscCall(ContactLinearizationDestroy(&state->solved->upcoming));
  PetscCall(PetscContainerDestroy(&state->solved->subspace));
  PetscFunctionReturn(0);
}

/* Goes back to the usual functions after an attempt with dual ones failed too, whose first reason is then reported */
static PetscErrorCode DualGapsUndo(Model model, State state, StepReport *report)
{
  StepFailure *failure = &state->control->failure;
  PetscBool    changed;

  PetscFunctionBegin;
  PetscCall(DualGapsSet(model, state, PETSC_FALSE, &changed));
  state->control->unsupported = failure->unsupported;
  report->gap_unconverged     = failure->gap_unconverged;
  if (!state->control->interrupted) PetscCall(ReportReason(report, PETSC_FALSE, "%s", failure->reason));
  PetscCall(PetscFree(failure->reason));
  PetscFunctionReturn(0);
}

/*
   Collective. Decides, after an attempt has failed, whether the same time is attempted again with dual functions. This
   is done once in a load step, if there is friction or if a body moves on; but not if it is proved that no contact
   forces hold the loads.
*/
PetscErrorCode DualGapsTry(Model model, State state, StepReport *report, PetscBool *again)
{
  StepControl *control = state->control;
  StepFailure *failure = &control->failure;

  PetscFunctionBegin;
  *again = PETSC_FALSE;
  if (failure->reason) {
    PetscCall(DualGapsUndo(model, state, report));
    PetscFunctionReturn(0);
  }
  if (!model->contact || control->interrupted || control->dual_tried == report->step) PetscFunctionReturn(0);
  if (control->unsupported ? control->unsupported > 1 : !state->history->frictional) PetscFunctionReturn(0);
  PetscCall(DualGapsSet(model, state, PETSC_TRUE, again));
  if (!*again) PetscFunctionReturn(0);
  control->dual_tried      = report->step;
  failure->unsupported     = control->unsupported;
  failure->gap_unconverged = report->gap_unconverged;
  PetscCall(PetscStrallocpy(report->reason, &failure->reason));
  if (control->monitor)
    PetscCall(PetscPrintf(model->comm, "Load step %" PetscInt_FMT " attempted again with gap: dual: %s\n", report->step,
      report->reason));
  PetscFunctionReturn(0);
}

/* Warns if the attempt that succeeded is the first one with dual functions */
PetscErrorCode DualGapsAccept(Simulation sim, const StepReport *report)
{
  StepFailure *failure = &sim->state->control->failure;

  PetscFunctionBegin;
  if (!failure->reason) PetscFunctionReturn(0);
  PetscCall(PetscFree(failure->reason));
  PetscCall(ReportWarn(sim->model->comm, &sim->report, NULL,
    "load step %" PetscInt_FMT ": contact pairs have gap: dual from now on, because no equilibrium was found with "
    "gap: mortar, whose pressures cannot act at the edge of a coarse face",
    report->step));
  PetscFunctionReturn(0);
}
