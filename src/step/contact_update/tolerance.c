/* The tolerance of the solves of contact updates */
#include "contact_updateimpl.h"
#include "src/state/control.h"

/*
   Sets p->tolerance, the relative KKT error to which the next linearized problem is solved; 0: the tolerance of the
   load step. again: the same linearization is solved once more, to a smaller tolerance;
   end: this is the last solve.

     The first update has the tolerance 1e-3. Later updates are solved to a tenth of the relative change of the gap in
     the previous update. This saves a third of the applications of the preconditioner.

     The tolerance of the load step is used in these cases:
     - for the last update;
     - with weak springs, which would carry the residual;
     - if the gap tolerance is near rounding, so that results are reproducible.
*/
PetscErrorCode ContactUpdateSetTolerance(StepProblem *p, PetscBool again, PetscBool end, Vec u,
  const StepReport *report)
{
  const PetscReal first = 1e-3, fraction = 0.1;
  PetscReal       size;

  PetscFunctionBegin;
  p->tolerance = 0.0;
  if (end || p->model->springs.weak || p->state->control->tolerances.gap_change < PETSC_SQRT_MACHINE_EPSILON ||
      report->contact_updates + 1 >= p->model->scene->contact_updates)
    PetscFunctionReturn(0);
  p->tolerance = first;
  if (!report->contact_updates && !again) PetscFunctionReturn(0);
  PetscCall(VecNorm(u, NORM_INFINITY, &size));
  p->tolerance = PetscMin(first, fraction * report->update_error / size);
  if (!again) p->gap_change = report->update_error;
  PetscFunctionReturn(0);
}

/*
   Finds whether the linearization that was just solved to p->tolerance must be solved to a smaller tolerance. *again:
   true for the last update, and for the first update if the change of the gap is below the tolerance of the solve.
*/
PetscErrorCode ContactUpdateEndedEarly(const StepProblem *p, PetscBool end, Vec u, const StepReport *report,
  PetscBool *again)
{
  PetscReal size;

  PetscFunctionBegin;
  PetscCall(VecNorm(u, NORM_INFINITY, &size));
  *again = (PetscBool)(report->converged && p->ended_early &&
                       (end || (report->contact_updates == 1 && report->update_error <= p->tolerance * size)));
  PetscFunctionReturn(0);
}
