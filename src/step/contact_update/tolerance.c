/* The tolerance of the solves of contact updates */
#include "contact_updateimpl.h"
#include "src/state/contact_state.h"
#include "src/state/control.h"

/*
   Sets p->tolerance, the relative KKT error to which the next linearized problem is solved; 0: the tolerance of the
   load step. again: the same linearization is solved once more, to a smaller tolerance;
   end: this is the last solve.

     Without friction, the first update has the tolerance 1e-3. Later updates are solved to a tenth of the relative
     change of the gap in the previous update. If this change did not fall to half of the one before, an inexact solve
     may be the cause, and the tolerance is at most a tenth of the previous one.

     With friction, updates converge more slowly, so that accurate solves are of less use. The three numbers are then
     1e-2, 0.3 and a half; but a tenth if the change did not fall at all.

     The tolerance of the load step is used in these cases:
     - for the last update;
     - without friction, if the errors of the last two updates indicate that the next update is the last;
     - with weak springs, which would carry the residual;
     - if the gap tolerance is near rounding, so that results are reproducible.
*/
PetscErrorCode ContactUpdateSetTolerance(StepProblem *p, PetscBool again, PetscBool end, Vec u,
  const StepReport *report)
{
  const PetscBool slip  = (PetscBool) !!p->state->solved->linearization->slip;
  const PetscReal first = slip ? 1e-2 : 1e-3, fraction = slip ? 0.3 : 0.1, slow = slip ? 0.5 : 0.1, strict = 0.1,
                  fair = 0.5, before = p->tolerance, allowed = p->state->control->tolerances.gap_change;
  PetscReal size;

  PetscFunctionBegin;
  p->tolerance = 0.0;
  if (end || p->model->springs.weak || allowed < PETSC_SQRT_MACHINE_EPSILON ||
      report->contact_updates + 1 >= p->model->scene->contact_updates)
    PetscFunctionReturn(0);
  p->tolerance = first;
  if (!report->contact_updates && !again) PetscFunctionReturn(0);
  PetscCall(VecNorm(u, NORM_INFINITY, &size));
  p->tolerance = PetscMin(first, fraction * report->update_error / size);
  if (again) PetscFunctionReturn(0);
  if (report->contact_updates > 1 && report->update_error > fair * p->gap_change)
    p->tolerance = PetscMin(p->tolerance, (report->update_error < p->gap_change ? slow : strict) * before);
  if (report->contact_updates > 1 && !slip && PetscSqr(report->update_error) <= allowed * size * p->gap_change)
    p->tolerance = 0.0;
  p->gap_change = report->update_error;
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
