/*
   Contact updates: solves the problem with linearized contact, then repeats the solve with an updated linearization
   until the linearized gap agrees with the gap of the deformed faces.
*/
#include "contact_updateimpl.h"
#include <math.h>
#include "src/state/contact_history.h"
#include "src/state/contact_state.h"
#include "src/state/control.h"
#include "src/state/path.h"

/*
   largest force at the end of the contact updates of the proximal term that holds bodies on weak springs, as a fraction
   of the forces of the deformation
*/
#define CONTACT_UPDATES_PROXIMAL 1e-5

/*
   the same force at which contact updates may end, if the term also holds a body in a motion that no contact resists,
   such as that of a pin about its axis: the body then moves a little in each update
*/
#define CONTACT_UPDATES_GLIDING 1e-6

/* contact updates within which the change of the gap must fall to a tenth; otherwise the updates end without success */
#define CONTACT_UPDATES_PATIENCE 12

/* number of cuts after which the increment of a load step counts as short; the undeformed bodies are then tried as the
   solution of a load step with friction to zero load */
#define CONTACT_UPDATES_SHORT 3

/*
   Measures the gap of the deformed faces at u, and how much it differs from the linearized gap of the solve whose
   solution is u. *is_true: true if the difference is small enough to end the contact updates. report->gap_unconverged:
   true if the difference is too large for a converged load step.
*/
static PetscErrorCode ContactUpdatesMeasureGap(StepProblem *p, Vec u, const ContactSolution *sol,
  ContactLinearization at_u, StepReport *report, PetscBool *is_true)
{
  PetscReal size, extent, proximal, law;
  PetscInt  nrows;

  PetscFunctionBegin;
  report->gap_true = NAN;
  PetscCall(VecGetSize(at_u->g, &nrows));
  if (nrows) PetscCall(VecMin(at_u->g, NULL, &report->gap_true));
  PetscCall(ContactHistoryChange(p->state->history, at_u, &report->gap_change));
  PetscCall(ContactUpdateMeasureError(p->model, p->state, u, sol, at_u, report));
  PetscCall(SoftMeasureError(p, p->state->solved->linearization, sol, &law));
  report->update_error = PetscMax(report->update_error, law);
  PetscCall(VecNorm(u, NORM_INFINITY, &size));
  PetscCall(VecNorm(p->model->places.x, NORM_INFINITY, &extent));
  *is_true = (PetscBool)(report->update_error <=
                         PetscMax(p->state->control->tolerances.gap_change * size, STEP_PLACE_ROUNDING * extent));
  report->gap_unconverged =
    (PetscBool)((p->model->scene->contact_updates > 1 ? report->update_error : report->gap_change) >
                PetscMax(
                  PetscMax(p->state->control->tolerances.gap_change, p->state->control->tolerances.gap_unconverged) *
                    size,
                  STEP_PLACE_ROUNDING * extent));
  PetscCall(ProximalMeasure(p, u, &proximal));
  if (proximal > PetscMax(p->state->control->tolerances.optimizer, p->glides ? CONTACT_UPDATES_GLIDING : 1e-10))
    *is_true = PETSC_FALSE;
  if (proximal > CONTACT_UPDATES_PROXIMAL) report->gap_unconverged = PETSC_TRUE;
  PetscFunctionReturn(0);
}

/*
   Solves with the gap linearized at u_linearized, and repeats the solve with a larger search distance until no face was
   missed.
*/
static PetscErrorCode ContactUpdatesSolveLinearized(StepProblem *p, PetscBool resume, Vec u_linearized, Vec u,
  StepReport *report, ContactSolution *sol)
{
  PetscReal reach, depth;
  PetscBool missed = PETSC_FALSE;

  PetscFunctionBegin;
  PetscCall(ContactGetReach(p->model->contact, &reach, &depth));
  do {
    PetscCall(ContactUpdateSetDirections(p));
    PetscCall(StepProblemTurn(p, u_linearized));
    PetscCall(PetscLogEventBegin(CONTACT_Linearize, NULL, NULL, NULL, NULL));
    PetscCall(StepProblemSetContact(p, p->state->solved->linearization, u_linearized));
    PetscCall(ProximalLinearize(p, u_linearized));
    PetscCall(PetscLogEventEnd(CONTACT_Linearize, NULL, NULL, NULL, NULL));
    PetscCall(StepProblemSolve(p, (PetscBool)(resume && !missed), u, report, sol));
    PetscCall(ContactUpdateReportDriven(p, report));
    if (report->converged) PetscCall(ContactUpdateKeepForces(p, sol));
    PetscCall(PetscLogEventBegin(CONTACT_Linearize, NULL, NULL, NULL, NULL));
    if (report->converged) PetscCall(MissedFind(p, u_linearized, u, sol->gap, &reach, &missed));
    PetscCall(PetscLogEventEnd(CONTACT_Linearize, NULL, NULL, NULL, NULL));
  } while (report->converged && missed);
  PetscFunctionReturn(0);
}

/*
   Reports how much the gap still changes after the last contact update. The load step counts as converged if
   contact_updates is 1, and as failed if more updates were allowed; the vertex where the gap changes most is then
   named. slid: true if contact nodes still slide over the edge of the opposite face.
*/
static PetscErrorCode ContactUpdatesReportGapError(Model model, State state, const ContactSolution *sol,
  ContactLinearization at_u, PetscBool slid, StepReport *report)
{
  char            place[512] = "";
  const char      advice[]   = "; use smaller load steps, or swap mortar and nonmortar";
  const PetscBool single     = (PetscBool)(model->scene->contact_updates == 1);

  PetscFunctionBegin;
  if (!single) PetscCall(ContactUpdateNamePlace(model, state, sol, at_u, slid, sizeof(place), place));
  if (single)
    PetscCall(ReportReason(report, PETSC_TRUE, "converged with contact_updates: 1; contact gap error up to %g [length]",
      (double)report->gap_change));
  else if (slid)
    PetscCall(ReportReason(report, PETSC_FALSE,
      "contact did not converge: after %" PetscInt_FMT
      " contact updates contact nodes still slide over the edge of the opposite face%s%s",
      report->contact_updates, place, advice));
  else
    PetscCall(ReportReason(report, PETSC_FALSE,
      "contact did not converge: after %" PetscInt_FMT
      " contact updates %s still changes by %g, more than %g of the largest displacement%s%s",
      report->contact_updates,
      report->update_error > report->gap_change ? "the slip, the rotation of the normals or the pressure of a soft pair"
                                                : "the gap",
      (double)report->update_error, (double)state->control->tolerances.gap_unconverged, place, advice));
  PetscFunctionReturn(0);
}

/*
   Does one contact update: solves with state->solved->linearization, then computes the gap at the solution u (*at_u).
   *end: true if no further update is needed, because the gap agrees or the solve failed. *slid: true if vertices under
   pressure have no row at u, so that their gap is not known.
*/
static PetscErrorCode ContactUpdatesOnce(StepProblem *p, PetscBool resume, Vec u_linearized, Vec u, StepReport *report,
  ContactSolution *sol, ContactLinearization *at_u, PetscBool *end, PetscBool *slid)
{
  PetscBool is_true = PETSC_FALSE;

  PetscFunctionBegin;
  *end  = PETSC_TRUE;
  *slid = PETSC_FALSE;
  PetscCall(ContactUpdatesSolveLinearized(p, resume, u_linearized, u, report, sol));
  if (!report->converged) PetscFunctionReturn(0);
  ++report->contact_updates;
  if (report->contact_updates == 1 && (p->friction.T || p->model->scene->contact_updates == 1))
    PetscCall(ContactUpdateLinearize(p->model, p->state, p->time, u, at_u)); /* the gap is linearized next at u */
  else PetscCall(ContactUpdateGetGaps(p->model, p->state, p->time, u, at_u));
  PetscCall(MissedFindLostRows(p, u_linearized, u, *at_u, report, slid));
  if (!report->converged) PetscFunctionReturn(0);
  PetscCall(ContactUpdatesMeasureGap(p, u, sol, *at_u, report, &is_true));
  *end = (PetscBool)(is_true && !*slid);
  if (p->state->control->monitor && p->model->scene->contact_updates > 1)
    PetscCall(PetscPrintf(p->model->comm,
      "Contact update %" PetscInt_FMT ": error %.3g, penetration %.3g, gap changes by %.3g, normals turn by %.3g, slip "
      "changes by %.3g\n",
      report->contact_updates, (double)report->update_error, (double)PetscMax(0.0, -report->gap_true),
      (double)report->gap_change, (double)report->normals_turn, (double)report->slip_change));
  PetscFunctionReturn(0);
}

/*
   Tests whether the undeformed bodies are the solution of a load step to zero load. vanishes: whether a solve has led
   to u = 0 up to rounding. *rests: true if they are; state->solved->linearization and *at_u are then linearizations at
   u = 0.
*/
static PetscErrorCode ContactUpdatesUndeformed(StepProblem *p, PetscBool vanishes, Vec u, StepReport *report,
  ContactSolution *sol, ContactLinearization *at_u, PetscBool *rests)
{
  ContactLinearization undeformed;
  PetscBool            due, is_true;

  PetscFunctionBegin;
  *rests = PETSC_FALSE;
  PetscCall(ZeroLoadStepIsDue(p, vanishes, &due));
  if (!due) PetscFunctionReturn(0);
  PetscCall(VecZeroEntries(u));
  PetscCall(ContactUpdateLinearize(p->model, p->state, p->time, u, &undeformed));
  PetscCall(ZeroLoadStepSolve(p, undeformed, u, report, sol, rests));
  if (*rests) {
    PetscCall(ContactLinearizationDestroy(&p->state->solved->linearization));
    p->state->solved->linearization = undeformed;
    PetscCall(ContactLinearizationDestroy(at_u));
    PetscCall(ContactUpdateLinearize(p->model, p->state, p->time, u, at_u));
    PetscCall(ContactUpdatesMeasureGap(p, u, sol, *at_u, report, &is_true));
    report->gap_change = report->normals_turn = report->slip_change = report->update_error = 0.0;
    report->gap_unconverged                                                                = PETSC_FALSE;
    report->contact_updates                                                                = 1;
  } else PetscCall(ContactLinearizationDestroy(&undeformed));
  PetscFunctionReturn(0);
}

/*
   For a load step with friction to zero load, finds whether the elastic energy at u vanishes up to rounding, compared
   with the energies of the last state and of earlier load steps. *rested: whether that of the last state vanished, too
*/
static PetscErrorCode ContactUpdatesVanish(const StepProblem *p, Vec u, PetscBool *vanishes, PetscBool *rested)
{
  const StepReport *steps     = p->sim->report.steps;
  const PetscReal   vanishing = 1e-7;
  PetscReal         energy, before, largest;

  PetscFunctionBegin;
  *vanishes = *rested = PETSC_FALSE;
  if (p->friction.T) PetscCall(ZeroLoadStepIsDue(p, PETSC_TRUE, vanishes));
  if (!*vanishes) PetscFunctionReturn(0);
  PetscCall(ElasticityEnergy(p->model->elasticity, u, &energy));
  PetscCall(ElasticityEnergy(p->model->elasticity, p->state->path->u, &before));
  largest = before;
  for (PetscInt s = 0; s + 1 < p->sim->report.nsteps; ++s) largest = PetscMax(largest, steps[s].energy);
  *vanishes = (PetscBool)(energy <= vanishing * largest);
  *rested   = (PetscBool)(before <= vanishing * largest);
  PetscFunctionReturn(0);
}

/*
   Ends the contact updates: reports whether the linearized and the actual gap agree. slid: whether friction still
   changed; linearization: that at u
*/
static PetscErrorCode ContactUpdatesReport(StepProblem *p, PetscBool slid, ContactLinearization linearization, Vec u,
  const ContactSolution *sol, StepReport *report)
{
  PetscReal proximal;

  PetscFunctionBegin;
  report->gap_unconverged =
    (PetscBool)(report->converged && (report->gap_unconverged || (slid && p->model->scene->contact_updates > 1)));
  if (!report->gap_unconverged) PetscFunctionReturn(0);
  PetscCall(ContactUpdatesReportGapError(p->model, p->state, sol, linearization, slid, report));
  PetscCall(ProximalMeasure(p, u, &proximal));
  if (proximal <= CONTACT_UPDATES_PROXIMAL) PetscFunctionReturn(0);
  PetscCall(WeakSpringsReportMotion(p, p->centre, u, report));
  report->gap_unconverged = PETSC_FALSE; /* the gap is not the reason of the failure: there is no equilibrium */
  PetscFunctionReturn(0);
}

/*
   Updates the contact until the gap agrees, a solve fails or contact_updates is reached. On exit u is a solution of the
   problem with state->solved->linearization, and *at_u is the linearization at u.
*/
PetscErrorCode ContactUpdatesSolve(StepProblem *p, Vec u, StepReport *report, ContactSolution *sol,
  ContactLinearization *at_u)
{
  Anderson  secants = {0};
  PetscBool end = PETSC_FALSE, slid = PETSC_FALSE, again = PETSC_FALSE, last = PETSC_FALSE;
  PetscBool vanishes, vanished = PETSC_FALSE, rested = PETSC_FALSE;
  Vec       u_linearized;

  PetscFunctionBegin;
  report->contact_updates = 0;
  report->gap_unconverged = PETSC_FALSE;
  p->by_newton            = PETSC_FALSE;
  PetscCall(FrictionRestart(p));
  PetscCall(ContactUpdateBegin(p, u, report, &u_linearized));
  PetscCall(ContactUpdatesUndeformed(p, PETSC_FALSE, u, report, sol, at_u, &end));
  while (!end) {
    PetscCall(ContactUpdateSetTolerance(p, again, last, u, report));
    PetscCall(ContactUpdatesOnce(p, (PetscBool)(again || report->contact_updates > 0), u_linearized, u, report, sol,
      at_u, &end, &slid));
    PetscCall(ContactUpdatesVanish(p, u, &vanishes, &rested));
    vanished = (PetscBool)(vanished || vanishes);
    PetscCall(ContactUpdateEndedEarly(p, end, u, report, &again));
    last = (PetscBool)(again && end);
    if (again) {
      end = PETSC_FALSE;
      --report->contact_updates;
      PetscCall(ContactLinearizationDestroy(at_u));
      continue;
    }
    if (end || report->contact_updates == p->model->scene->contact_updates) break;
    if (report->gap_unconverged && secants.n >= CONTACT_UPDATES_PATIENCE && secants.least > 0.1 * secants.first) break;
    PetscCall(ContactUpdateNext(p, &secants, sol, u, u_linearized, report, at_u));
    if (!report->converged) break;
  }
  /*
     If all forces are rounding errors, residuals relative to them are meaningless, and the undeformed bodies are tried
     as the solution. With friction this is done only if the last state was undeformed or the increment is short:
     friction may hold bodies in a deformed state without load, and a long increment may miss that state.
  */
  if (!report->converged && vanished && (rested || report->cuts >= CONTACT_UPDATES_SHORT) &&
      !p->state->control->interrupted)
    PetscCall(ContactUpdatesUndeformed(p, PETSC_TRUE, u, report, sol, at_u, &end));
  PetscCall(VecDestroy(&u_linearized));
  PetscCall(AndersonDestroy(&secants));
  PetscCall(ContactUpdatesReport(p, slid, *at_u, u, sol, report));
  PetscFunctionReturn(0);
}
