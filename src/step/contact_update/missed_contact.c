/* Contact that the search missed: faces beyond its distance, vertices without a row, faces that passed each other */
#include "contact_updateimpl.h"
#include "src/state/contact_history.h"
#include "src/state/contact_state.h"
#include "src/state/control.h"
#include "src/state/path.h"

/*
   Computes the displacement since the linearization. du: u - u_linearized, a new vector; *moved: its largest component
   [length].
*/
static PetscErrorCode MissedMotion(Vec u_linearized, Vec u, Vec *du, PetscReal *moved)
{
  PetscFunctionBegin;
  PetscCall(VecDuplicate(u, du));
  PetscCall(VecWAXPY(*du, -1.0, u_linearized, u));
  PetscCall(VecNorm(*du, NORM_INFINITY, moved));
  PetscFunctionReturn(0);
}

/*
   Finds the largest penetration as a negative gap. *deepest: min(gap, 0) over the rows of all ranks; 0 if no row is
   penetrated or there are no rows [length].
*/
static PetscErrorCode MissedDeepestGap(Vec gap, PetscReal *deepest)
{
  PetscReal least = 0.0;
  PetscInt  nrows;

  PetscFunctionBegin;
  PetscCall(VecGetSize(gap, &nrows));
  if (nrows) PetscCall(VecMin(gap, NULL, &least));
  *deepest = PetscMin(least, 0.0);
  PetscFunctionReturn(0);
}

/*
   Finds faces that were farther apart than the search distance at u_linearized but may have met at u, which is possible
   if the solution moved by more than half of that distance. The search is then repeated with a larger distance *reach.
   own: linearized gap of the present rows at u. *missed: true if a row of the wider search is penetrated at u more
   deeply than any present row (present rows may be penetrated, for example with the penalty method); the wider
   linearization then replaces state->solved->linearization.
*/
PetscErrorCode MissedFind(const StepProblem *p, Vec u_linearized, Vec u, Vec own, PetscReal *reach, PetscBool *missed)
{
  ContactLinearization wide = NULL;
  PetscReal            moved, least = 0.0, allowed;
  Vec                  du, gap;

  PetscFunctionBegin;
  *missed = PETSC_FALSE;
  PetscCall(MissedMotion(u_linearized, u, &du, &moved));
  if (2.0 * moved > *reach) { /* each of the two faces may have moved by `moved` */
    *reach = 2.0 * PetscMax(moved, *reach);
    PetscCall(ContactSetReach(p->model->contact, *reach, 0.0));
    PetscCall(ContactUpdateLinearize(p->model, p->state, p->time, u_linearized, &wide));
    PetscCall(ContactSetReach(p->model->contact, 0.0, 0.0));
    PetscCall(VecDuplicate(wide->g, &gap));
    PetscCall(MatMultAdd(wide->J, du, wide->g, gap));
    PetscCall(MissedDeepestGap(gap, &least));
    PetscCall(MissedDeepestGap(own, &allowed));
    PetscCall(VecDestroy(&gap));
    *missed = (PetscBool)(least < allowed - PETSC_SQRT_MACHINE_EPSILON * 100.0 * moved);
  }
  PetscCall(VecDestroy(&du));
  if (*missed) {
    if (p->state->control->monitor)
      PetscCall(PetscPrintf(p->model->comm,
        "Faces beyond the contact search distance penetrated by %g: searched again up to a distance of %g\n",
        -(double)least, (double)*reach));
    PetscCall(ContactLinearizationDestroy(&p->state->solved->linearization));
    p->state->solved->linearization = wide;
  } else PetscCall(ContactLinearizationDestroy(&wide));
  PetscFunctionReturn(0);
}

/*
   Finds vertices that were under pressure in the solve but have no contact row at u. A vertex has no row if it slid
   over the edge of the opposite face; *slid is then true, and another update is needed. A vertex also has no row if it
   lies deeper in the other body than the contact search reaches; the load step has then failed.
*/
PetscErrorCode MissedFindLostRows(const StepProblem *p, Vec u_linearized, Vec u, ContactLinearization at_u,
  StepReport *report, PetscBool *slid)
{
  ContactLinearization deep;
  PetscBool           *lost;
  PetscReal            distance, depth, moved, least = 0.0;
  PetscInt             nlost;
  Vec                  du;

  PetscFunctionBegin;
  PetscCall(ContactHistoryFindLostRows(p->state->history, at_u, &lost, &nlost));
  *slid = (PetscBool)(nlost > 0);
  if (nlost) {
    PetscCall(MissedMotion(u_linearized, u, &du, &moved));
    PetscCall(VecDestroy(&du));
    PetscCall(ContactGetReach(p->model->contact, &distance, &depth));
    PetscCall(ContactSetReach(p->model->contact, 0.0, depth + 2.0 * moved));
    PetscCall(ContactUpdateLinearize(p->model, p->state, p->time, u, &deep));
    PetscCall(ContactSetReach(p->model->contact, 0.0, 0.0));
    PetscCall(ContactHistoryLeastGap(p->state->history, lost, deep, &least));
    PetscCall(ContactLinearizationDestroy(&deep));
    if (least < -depth)
      PetscCall(ReportReason(report, PETSC_FALSE,
        "contact faces penetrate by %g, deeper than the contact search reaches; use smaller load steps",
        -(double)least));
  }
  PetscCall(PetscFree(lost));
  PetscFunctionReturn(0);
}

/* Finds whether any faces of a pair are within the search distance of each other at u. */
static PetscErrorCode MissedFindMet(Model model, State state, PetscReal time, PetscInt pair, Vec u, PetscBool *met)
{
  ContactLinearization lin;

  PetscFunctionBegin;
  *met = PETSC_FALSE;
  PetscCall(ContactUpdateLinearize(model, state, time, u, &lin));
  for (PetscInt r = 0; r < lin->nlocal; ++r) *met = (PetscBool)(*met || lin->pair[r] == pair);
  PetscCall(ContactLinearizationDestroy(&lin));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, met, 1, MPI_PETSCBOOL, MPI_LOR, model->comm));
  PetscFunctionReturn(0);
}

/*
   Reports a face that turned by more than 90 degrees and has lost contact. Such a face may have passed through the
   opposite face on a curved path.
*/
static PetscErrorCode MissedFindTurned(Model model, State state, PetscReal time, PetscInt p, Vec u, StepReport *report)
{
  const SceneContactPair *pair = &model->scene->pairs[p];
  PetscBool               before, now;

  PetscFunctionBegin;
  PetscCall(MissedFindMet(model, state, time, p, state->path->u, &before));
  PetscCall(MissedFindMet(model, state, time, p, u, &now));
  if (!before || now) PetscFunctionReturn(0);
  PetscCall(ReportReason(report, PETSC_FALSE,
    "contact pair \"%s\": %s or %s turns by more than 90 degrees within the load step, and has no contact after it; "
    "use smaller load steps",
    pair->name, pair->mortar, pair->nonmortar));
  PetscFunctionReturn(0);
}

/*
   Reports faces that passed through each other since the last state and therefore have no contact at u. This is
   possible only if they moved by at least the depth of the contact search.
*/
PetscErrorCode MissedFindPassed(Model model, State state, PetscReal time, Vec u, StepReport *report)
{
  PetscBool turned;
  PetscReal moved, reach, depth;
  Vec       du;

  PetscFunctionBegin;
  if (!report->converged) PetscFunctionReturn(0);
  PetscCall(MissedMotion(state->path->u, u, &du, &moved));
  PetscCall(VecDestroy(&du));
  for (PetscInt p = 0; p < model->scene->npairs && report->converged; ++p) {
    const SceneContactPair *pair = &model->scene->pairs[p];

    PetscCall(ContactGetPassage(model->contact, p, moved, state->path->u, u, &depth, &reach, &turned));
    if (turned && depth <= reach) PetscCall(MissedFindTurned(model, state, time, p, u, report));
    if (depth <= reach) continue;
    if (pair->self)
      PetscCall(ReportReason(report, PETSC_FALSE,
        "contact pair \"%s\": %s passes through itself by %.3g within the load step; use smaller load steps",
        pair->name, pair->self, (double)depth));
    else
      PetscCall(ReportReason(report, PETSC_FALSE,
        "contact pair \"%s\": %s and %s pass through each other by %.3g within the load step; use smaller load steps",
        pair->name, pair->mortar, pair->nonmortar, (double)depth));
  }
  PetscFunctionReturn(0);
}
