/*
   Attempts to reach a time: solves the problem with linearized contact, then repeats the solve with an updated
   linearization until the linearized gap agrees with the gap of the deformed faces.
*/
#include "stepimpl.h"
#include <math.h>
#include "src/state/contact_history.h"
#include "src/state/contact_state.h"
#include "src/state/control.h"
#include "src/state/path.h"

/*
   largest force at the end of the contact updates of the proximal term that holds bodies on weak springs, as a fraction
   of the forces of the deformation
*/
#define ATTEMPT_HELD 1e-5

/* contact updates within which the change of the gap must fall to a tenth; otherwise the updates end without success */
#define ATTEMPT_PATIENCE 12

/* cuts of a load step after which an increment is short: forces of the last state are an eighth of those before */
#define ATTEMPT_SHORT 3

/*
   Computes the gap at u for a load step that ends at `time`. The derivative of the gap is computed only if initial
   overlaps follow ramps, since InterferenceAdd() needs it.
*/
static PetscErrorCode AttemptGetGaps(Simulation sim, PetscReal time, Vec u, ContactLinearization *lin)
{
  PetscBool ramps = PETSC_FALSE;

  PetscFunctionBegin;
  for (PetscInt p = 0; p < sim->scene->npairs; ++p)
    ramps = (PetscBool)(ramps || sim->scene->pairs[p].interference_ramp >= 0);
  if (ramps) {
    PetscCall(ContactLinearizeForces(sim->contact, u, lin));
    PetscCall(InterferenceAdd(sim, time, 1.0, *lin));
  } else PetscCall(ContactGetGaps(sim->contact, u, lin));
  PetscFunctionReturn(0);
}

/* Linearizes the gap at u for a load step that ends at `time`. The ramps of initial overlaps are applied.
   anticipates: whether the derivative that ContactUpdateAnticipate() needs is computed too */
static PetscErrorCode AttemptLinearizeGap(Simulation sim, PetscReal time, Vec u, PetscBool anticipates,
  ContactLinearization *lin)
{
  PetscFunctionBegin;
  PetscCall((anticipates ? ContactLinearize : ContactLinearizeForces)(sim->contact, u, lin));
  PetscCall(InterferenceAdd(sim, time, 1.0, *lin));
  PetscFunctionReturn(0);
}

static PetscErrorCode AttemptSolve(StepProblem *p, PetscBool resume, Vec u, StepReport *report, ContactSolution *sol)
{
  const Constraints constraints = SimulationConstraints(p->sim);
  PetscInt          nsolves     = 0;
  PetscBool         again, rescued;

  PetscFunctionBegin;
  p->sim->bolts.nsolves = 0;
  PetscCall(PetscLogEventBegin(SIM_Solve, NULL, NULL, NULL, NULL));
  do {
    if (!nsolves) PetscCall(FollowersForget(p));
    if (!EnergyIsFinite(p->energy)) PetscCall(ReportReason(report, PETSC_FALSE, STEP_INVERTED));
    else if (p->sim->quadratic && !p->J && !p->lower)
      PetscCall(LinearSolve(p, (PetscBool)(resume || nsolves), u, report));
    else if (p->sim->control->penalty > 0.0 && p->J)
      PetscCall(PenaltySolve(p, (PetscBool)(resume || nsolves), u, report, sol));
    else PetscCall(OptimizerSolve(p, (PetscBool)(resume || nsolves), u, report, sol));
    if (report->converged) PetscCall(TiesFollow(&p->sim->ties, u));
    PetscCall(ProximalAdvance(p, u, ++nsolves, report, &again));
    PetscCall(FollowersAdvance(p, u, nsolves, report, &again));
    PetscCall(StepProblemAdvanceBolts(p, u, report, &again));
    PetscCall(FollowersAdvanceMean(p, u, nsolves, report, &again));
    PetscCall(ProximalRescue(p, u, report, &rescued));
    if (rescued) nsolves = 0;
  } while (again || rescued);
  PetscCall(WeakSpringsTest(p, u, report));
  PetscCall(RigidTest(&constraints, (PetscBool)(!p->J || p->sim->scene->contact_updates > 1), u, report));
  report->straightened = 0.0;
  if (report->converged) PetscCall(TiesStraighten(&constraints, u, &report->straightened));
  PetscCall(PetscLogEventEnd(SIM_Solve, NULL, NULL, NULL, NULL));
  PetscFunctionReturn(0);
}

/*
   Measures the gap of the deformed faces at u, and how much it differs from the linearized gap of the solve whose
   solution is u. *is_true: true if the difference is small enough to end the contact updates. report->gap_unconverged:
   true if the difference is too large for a converged load step.
*/
static PetscErrorCode AttemptMeasureGap(const StepProblem *p, Vec u, const ContactSolution *sol,
  ContactLinearization at_u, StepReport *report, PetscBool *is_true)
{
  Simulation sim = p->sim;
  PetscReal  size, held;
  PetscInt   nrows;

  PetscFunctionBegin;
  report->gap_true = NAN;
  PetscCall(VecGetSize(at_u->g, &nrows));
  if (nrows) PetscCall(VecMin(at_u->g, NULL, &report->gap_true));
  PetscCall(ContactHistoryChange(sim->history, at_u, &report->gap_change));
  PetscCall(ContactUpdateMeasureError(sim, u, sol, at_u, report));
  PetscCall(VecNorm(u, NORM_INFINITY, &size));
  *is_true = (PetscBool)(report->update_error <= sim->control->tolerances.gap_change * size);
  report->gap_unconverged =
    (PetscBool)((sim->scene->contact_updates > 1 ? report->update_error : report->gap_change) >
                PetscMax(sim->control->tolerances.gap_change, sim->control->tolerances.gap_unconverged) * size);
  PetscCall(ProximalMeasureHeld(p, u, &held));
  if (held > PetscMax(sim->control->tolerances.optimizer, 1e-10)) *is_true = PETSC_FALSE;
  if (held > ATTEMPT_HELD) report->gap_unconverged = PETSC_TRUE;
  PetscFunctionReturn(0);
}

/*
   Computes the allowed error of linearized rotations. *allowed: a fraction of the largest displacement, but at least 32
   times the rounding error of the coordinates [length]. The fraction is small in time steps, because energy and angular
   momentum depend on the rotations (turn.c).
*/
static PetscErrorCode AttemptGetAllowed(Simulation sim, Vec u, PetscReal *allowed)
{
  const PetscReal part = SimulationIsDynamic(sim) ? 1e-14 : PetscMax(1e-3 * sim->control->tolerances.optimizer, 1e-12);
  PetscReal       size, extent;

  PetscFunctionBegin;
  PetscCall(VecNorm(u, NORM_INFINITY, &size));
  PetscCall(VecNorm(sim->places.x, NORM_INFINITY, &extent));
  *allowed = PetscMax(part * size, 32.0 * PETSC_MACHINE_EPSILON * extent);
  PetscFunctionReturn(0);
}

/*
   Solves a problem without contact. Rotations of rigid bodies that turn freely are linearized again until the
   linearized rotations agree with the finite ones. foreseen: true if u is a forecast on entry.
*/
static PetscErrorCode AttemptBodies(StepProblem *p, PetscBool foreseen, Vec u, StepReport *report, ContactSolution *sol)
{
  const PetscInt most    = 50;
  PetscReal      allowed = 0.0;
  PetscBool      again   = PETSC_FALSE;

  PetscFunctionBegin;
  for (PetscInt k = 0; !k || again; ++k) {
    if (k || foreseen) PetscCall(StepProblemTurn(p, u));
    PetscCall(AttemptSolve(p, (PetscBool)(foreseen || k), u, report, sol));
    PetscCall(AttemptGetAllowed(p->sim, u, &allowed));
    again = (PetscBool)(report->converged && report->straightened > allowed);
    if (k < most || !again) continue;
    PetscCall(ReportReason(report, PETSC_FALSE,
      "the rotations of rigid bodies that turn freely do not converge; use smaller load steps"));
    again = PETSC_FALSE;
  }
  PetscFunctionReturn(0);
}

/*
   Computes the displacement since the linearization. du: u - u_linearized, a new vector; *moved: its largest component
   [length].
*/
static PetscErrorCode AttemptMotion(Vec u_linearized, Vec u, Vec *du, PetscReal *moved)
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
static PetscErrorCode AttemptDeepestGap(Vec gap, PetscReal *deepest)
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
   linearization then replaces sim->solved->linearization.
*/
static PetscErrorCode AttemptFindMissed(const StepProblem *p, Vec u_linearized, Vec u, Vec own, PetscReal *reach,
  PetscBool *missed)
{
  Simulation           sim  = p->sim;
  ContactLinearization wide = NULL;
  PetscReal            moved, least = 0.0, allowed;
  Vec                  du, gap;

  PetscFunctionBegin;
  *missed = PETSC_FALSE;
  PetscCall(AttemptMotion(u_linearized, u, &du, &moved));
  if (2.0 * moved > *reach) { /* each of the two faces may have moved by `moved` */
    *reach = 2.0 * PetscMax(moved, *reach);
    PetscCall(ContactSetReach(sim->contact, *reach, 0.0));
    PetscCall(AttemptLinearizeGap(sim, p->time, u_linearized, PETSC_TRUE, &wide));
    PetscCall(ContactSetReach(sim->contact, 0.0, 0.0));
    PetscCall(VecDuplicate(wide->g, &gap));
    PetscCall(MatMultAdd(wide->J, du, wide->g, gap));
    PetscCall(AttemptDeepestGap(gap, &least));
    PetscCall(AttemptDeepestGap(own, &allowed));
    PetscCall(VecDestroy(&gap));
    *missed = (PetscBool)(least < allowed - PETSC_SQRT_MACHINE_EPSILON * 100.0 * moved);
  }
  PetscCall(VecDestroy(&du));
  if (*missed) {
    if (sim->control->monitor)
      PetscCall(PetscPrintf(sim->comm,
        "Faces beyond the contact search distance penetrated by %g: searched again up to a distance of %g\n",
        -(double)least, (double)*reach));
    PetscCall(ContactLinearizationDestroy(&sim->solved->linearization));
    sim->solved->linearization = wide;
  } else PetscCall(ContactLinearizationDestroy(&wide));
  PetscFunctionReturn(0);
}

/*
   Solves with the gap linearized at u_linearized, and repeats the solve with a larger search distance until no face was
   missed.
*/
static PetscErrorCode AttemptLinearized(StepProblem *p, PetscBool resume, Vec u_linearized, Vec u, StepReport *report,
  ContactSolution *sol)
{
  PetscReal reach, depth;
  PetscBool missed = PETSC_FALSE;

  PetscFunctionBegin;
  PetscCall(ContactGetReach(p->sim->contact, &reach, &depth));
  PetscCall(StepProblemTurn(p, u_linearized));
  do {
    PetscCall(StepProblemSetContact(p, p->sim->solved->linearization, u_linearized));
    PetscCall(ProximalLinearize(p, u_linearized));
    if (resume && !p->by_newton) PetscCall(ContactUpdateAnticipate(p, p->sim->solved->linearization));
    PetscCall(AttemptSolve(p, (PetscBool)(resume && !missed), u, report, sol));
    if (report->converged) PetscCall(AttemptFindMissed(p, u_linearized, u, sol->gap, &reach, &missed));
  } while (report->converged && missed);
  PetscFunctionReturn(0);
}

/*
   Reports how much the gap still changes after the last contact update. The load step counts as converged if
   contact_updates is 1, and as failed if more updates were allowed; the vertex where the gap changes most is then
   named. slid: true if contact nodes still slide over the edge of the opposite face.
*/
static PetscErrorCode AttemptReportGapError(Simulation sim, const ContactSolution *sol, ContactLinearization at_u,
  PetscBool slid, StepReport *report)
{
  char            reason[768], place[512] = "";
  const PetscBool single = (PetscBool)(sim->scene->contact_updates == 1);

  PetscFunctionBegin;
  if (!single) PetscCall(ContactUpdateNamePlace(sim, sol, at_u, slid, sizeof(place), place));
  if (single)
    PetscCall(PetscSNPrintf(reason, sizeof(reason),
      "converged with contact_updates: 1; contact gap error up to %g [length]", (double)report->gap_change));
  else if (slid)
    PetscCall(PetscSNPrintf(reason, sizeof(reason),
      "contact did not converge: after %" PetscInt_FMT
      " contact updates contact nodes still slide over the edge of the opposite face%s",
      report->contact_updates, place));
  else
    PetscCall(PetscSNPrintf(reason, sizeof(reason),
      "contact did not converge: after %" PetscInt_FMT
      " contact updates %s still changes by %g, more than %g of the largest displacement%s",
      report->contact_updates,
      report->update_error > report->gap_change ? "the slip or the rotation of the normals" : "the gap",
      (double)report->update_error, (double)sim->control->tolerances.gap_unconverged, place));
  PetscCall(ReportReason(report, single, reason));
  PetscFunctionReturn(0);
}

/*
   Finds vertices that were under pressure in the solve but have no contact row at u. A vertex has no row if it slid
   over the edge of the opposite face; *slid is then true, and another update is needed. A vertex also has no row if it
   lies deeper in the other body than the contact search reaches; the load step has then failed.
*/
static PetscErrorCode AttemptFindLostRows(const StepProblem *p, Vec u_linearized, Vec u, ContactLinearization at_u,
  StepReport *report, PetscBool *slid)
{
  Simulation           sim = p->sim;
  ContactLinearization deep;
  PetscBool           *lost;
  PetscReal            distance, depth, moved, least = 0.0;
  PetscInt             nlost;
  Vec                  du;
  char                 sentence[128];

  PetscFunctionBegin;
  PetscCall(ContactHistoryFindLostRows(sim->history, at_u, &lost, &nlost));
  *slid = (PetscBool)(nlost > 0);
  if (nlost) {
    PetscCall(AttemptMotion(u_linearized, u, &du, &moved));
    PetscCall(VecDestroy(&du));
    PetscCall(ContactGetReach(sim->contact, &distance, &depth));
    PetscCall(ContactSetReach(sim->contact, 0.0, depth + 2.0 * moved));
    PetscCall(AttemptLinearizeGap(sim, p->time, u, PETSC_FALSE, &deep));
    PetscCall(ContactSetReach(sim->contact, 0.0, 0.0));
    PetscCall(ContactHistoryLeastGap(sim->history, lost, deep, &least));
    PetscCall(ContactLinearizationDestroy(&deep));
    PetscCall(PetscSNPrintf(sentence, sizeof(sentence),
      "contact faces penetrate by %g, deeper than the contact search reaches; use smaller load steps", -(double)least));
    if (least < -depth) PetscCall(ReportReason(report, PETSC_FALSE, sentence));
  }
  PetscCall(PetscFree(lost));
  PetscFunctionReturn(0);
}

/* Finds whether any faces of a pair are within the search distance of each other at u. */
static PetscErrorCode AttemptFindMet(Simulation sim, PetscReal time, PetscInt pair, Vec u, PetscBool *met)
{
  ContactLinearization lin;

  PetscFunctionBegin;
  *met = PETSC_FALSE;
  PetscCall(AttemptLinearizeGap(sim, time, u, PETSC_FALSE, &lin));
  for (PetscInt r = 0; r < lin->nlocal; ++r) *met = (PetscBool)(*met || lin->pair[r] == pair);
  PetscCall(ContactLinearizationDestroy(&lin));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, met, 1, MPI_PETSCBOOL, MPI_LOR, sim->comm));
  PetscFunctionReturn(0);
}

/*
   Reports a face that turned by more than 90 degrees and has lost contact. Such a face may have passed through the
   opposite face on a curved path.
*/
static PetscErrorCode AttemptFindTurned(Simulation sim, PetscReal time, PetscInt p, Vec u, StepReport *report)
{
  const SceneContactPair *pair = &sim->scene->pairs[p];
  PetscBool               before, now;
  char                    sentence[256];

  PetscFunctionBegin;
  PetscCall(AttemptFindMet(sim, time, p, sim->path->u, &before));
  PetscCall(AttemptFindMet(sim, time, p, u, &now));
  if (!before || now) PetscFunctionReturn(0);
  PetscCall(PetscSNPrintf(sentence, sizeof(sentence),
    "contact pair \"%s\": %s or %s turns by more than 90 degrees within the load step, and has no contact after it; "
    "use smaller load steps",
    pair->name, pair->mortar, pair->nonmortar));
  PetscCall(ReportReason(report, PETSC_FALSE, sentence));
  PetscFunctionReturn(0);
}

/*
   Reports faces that passed through each other since the last state and therefore have no contact at u. This is
   possible only if they moved by at least the depth of the contact search.
*/
static PetscErrorCode AttemptFindPassed(Simulation sim, PetscReal time, Vec u, StepReport *report)
{
  PetscBool turned;
  PetscReal moved, reach, depth;
  Vec       du;
  char      sentence[256];

  PetscFunctionBegin;
  if (!report->converged) PetscFunctionReturn(0);
  PetscCall(AttemptMotion(sim->path->u, u, &du, &moved));
  PetscCall(VecDestroy(&du));
  for (PetscInt p = 0; p < sim->scene->npairs && report->converged; ++p) {
    const SceneContactPair *pair = &sim->scene->pairs[p];

    PetscCall(ContactGetPassage(sim->contact, p, moved, sim->path->u, u, &depth, &reach, &turned));
    if (turned && depth <= reach) PetscCall(AttemptFindTurned(sim, time, p, u, report));
    if (depth <= reach) continue;
    if (pair->self)
      PetscCall(PetscSNPrintf(sentence, sizeof(sentence),
        "contact pair \"%s\": %s goes through itself within the load step, by %.3g; use smaller load steps", pair->name,
        pair->self, (double)depth));
    else
      PetscCall(PetscSNPrintf(sentence, sizeof(sentence),
        "contact pair \"%s\": %s and %s go through each other within the load step, by %.3g; use smaller load steps",
        pair->name, pair->mortar, pair->nonmortar, (double)depth));
    PetscCall(ReportReason(report, PETSC_FALSE, sentence));
  }
  PetscFunctionReturn(0);
}

/* Warns that contact updates are damped, but only once in a run. */
static PetscErrorCode AttemptWarnDamped(Simulation sim, const StepReport *report)
{
  PetscInt before = 0;

  PetscFunctionBegin;
  for (PetscInt s = 0; s < sim->report.nsteps; ++s) before += sim->report.steps[s].gap_damped;
  if (!before)
    PetscCall(ReportWarn(sim->comm, &sim->report,
      "load step %" PetscInt_FMT ": contact iterations do not converge; they are damped from now on. Use smaller load "
      "steps, or swap mortar and nonmortar",
      report->step));
  PetscFunctionReturn(0);
}

/*
   Makes u a displacement in which rigid bodies that turn freely are rigid. An extrapolated u does not have this
   property, because a combination of rotations is not a rotation.
*/
static PetscErrorCode AttemptMakeRigid(StepProblem *p, Vec u)
{
  const Constraints constraints = SimulationConstraints(p->sim);
  PetscReal         change;

  PetscFunctionBegin;
  if (!p->sim->rigid.turns) PetscFunctionReturn(0);
  PetscCall(StepProblemTurn(p, u));
  PetscCall(TiesFollow(&p->sim->ties, u));
  PetscCall(TiesStraighten(&constraints, u, &change));
  PetscFunctionReturn(0);
}

/*
   Moves u_linearized to the point at which the gap is linearized next, and linearizes the gap there. at_u: the
   linearization at the solution u on entry, the new linearization on exit.
*/
static PetscErrorCode AttemptNextLinearization(StepProblem *p, ContactUpdateSecants *secants,
  const ContactSolution *sol, Vec u, Vec u_linearized, StepReport *report, ContactLinearization *at_u)
{
  Simulation sim = p->sim;
  PetscBool  damped, at_solution, found = PETSC_FALSE;
  PetscReal  held;
  Vec        next;

  PetscFunctionBegin;
  PetscCall(VecDuplicate(u, &next));
  if (!p->holds_weak) PetscCall(ContactUpdateNewton(p, sol, *at_u, u_linearized, u, next, report, &found));
  PetscCall(ProximalMeasureHeld(p, u, &held)); /* `held` decreases as bodies on weak springs come to rest, whereas
                                                  the change of the gap need not decrease */
  PetscCall(
    ContactUpdateSecantsAdvance(secants, p->holds_weak ? held : report->update_error, u, u_linearized, &damped));
  if (damped && ProximalMayHoldWeak(p)) {
    PetscCall(VecDestroy(&next));
    PetscCall(ReportReason(report, PETSC_FALSE, "bodies on weak springs do not come to rest in contact updates"));
    PetscFunctionReturn(0);
  }
  if (damped) PetscCall(AttemptWarnDamped(sim, report));
  if (damped) PetscCall(FrictionReleaseOpen(p));
  report->gap_damped += damped;
  p->by_newton = (PetscBool)(found && !damped);
  if (p->by_newton) PetscCall(VecCopy(next, u_linearized));
  PetscCall(VecDestroy(&next));
  PetscCall(VecEqual(u, u_linearized, &at_solution));
  PetscCall(ContactLinearizationDestroy(&sim->solved->linearization));
  if (!at_solution || (*at_u)->gaps_only) {
    PetscCall(ContactLinearizationDestroy(at_u));
    PetscCall(AttemptMakeRigid(p, u_linearized));
    PetscCall(AttemptLinearizeGap(sim, p->time, u_linearized, (PetscBool)!p->by_newton, at_u));
  }
  sim->solved->linearization = *at_u;
  *at_u                      = NULL;
  PetscFunctionReturn(0);
}

/*
   Does one contact update: solves with sim->solved->linearization, then computes the gap at the solution u (*at_u).
   *end: true if no further update is needed, because the gap agrees or the solve failed. *slid: true if vertices under
   pressure have no row at u, so that their gap is not known.
*/
static PetscErrorCode AttemptOnce(StepProblem *p, PetscBool resume, Vec u_linearized, Vec u, StepReport *report,
  ContactSolution *sol, ContactLinearization *at_u, PetscBool *end, PetscBool *slid)
{
  Simulation sim     = p->sim;
  PetscBool  is_true = PETSC_FALSE;

  PetscFunctionBegin;
  *end  = PETSC_TRUE;
  *slid = PETSC_FALSE;
  PetscCall(AttemptLinearized(p, resume, u_linearized, u, report, sol));
  if (report->contact_updates) PetscCall(WeakSpringsTestMotion(p, u_linearized, u, report));
  if (!report->converged) PetscFunctionReturn(0);
  ++report->contact_updates;
  if (report->contact_updates == 1 && (p->friction.T || sim->scene->contact_updates == 1))
    PetscCall(
      AttemptLinearizeGap(sim, p->time, u, PETSC_TRUE, at_u)); /* in this case the gap is linearized next at u */
  else PetscCall(AttemptGetGaps(sim, p->time, u, at_u));
  PetscCall(AttemptFindLostRows(p, u_linearized, u, *at_u, report, slid));
  if (!report->converged) PetscFunctionReturn(0);
  PetscCall(AttemptMeasureGap(p, u, sol, *at_u, report, &is_true));
  *end = (PetscBool)(is_true && !*slid);
  if (sim->control->monitor && sim->scene->contact_updates > 1)
    PetscCall(PetscPrintf(sim->comm,
      "Contact update %" PetscInt_FMT ": error %.3g, penetration %.3g, gap changes by %.3g, normals turn by %.3g, slip "
      "changes by %.3g\n",
      report->contact_updates, (double)report->update_error, (double)PetscMax(0.0, -report->gap_true),
      (double)report->gap_change, (double)report->normals_turn, (double)report->slip_change));
  PetscFunctionReturn(0);
}

/*
   Sets p->tolerance, the relative KKT error to which the next linearized problem is solved; 0: the tolerance of the
   load step. foreseen: u was a forecast; again: the same linearization is solved once more, to a smaller tolerance;
   end: this is the last solve.

     The first update has the tolerance 1e-3, or 1e-4 with friction. Later updates are solved to a tenth of the relative
     change of the gap in the previous update. If this change did not fall to half of the one before, an inexact solve
     may be the cause, and the tolerance is at most a tenth of the previous one.

     The tolerance of the load step is used for the last update, without friction also if the errors of the last two
     updates let expect that the next one is the last, for a start from a forecast, with weak springs (which would carry
     the residual), and if the gap tolerance is near rounding, so that results are reproducible.
*/
static PetscErrorCode AttemptSetTolerance(StepProblem *p, PetscBool foreseen, PetscBool again, PetscBool end, Vec u,
  const StepReport *report)
{
  Simulation      sim   = p->sim;
  const PetscReal first = sim->solved->linearization->slip ? 1e-4 : 1e-3, fraction = 0.1, fair = 0.5,
                  before = p->tolerance, allowed = sim->control->tolerances.gap_change;
  PetscReal size;

  PetscFunctionBegin;
  p->tolerance = 0.0;
  if (end || sim->springs.weak || allowed < PETSC_SQRT_MACHINE_EPSILON ||
      report->contact_updates + 1 >= sim->scene->contact_updates)
    PetscFunctionReturn(0);
  p->tolerance = foreseen ? 0.0 : first;
  if (!report->contact_updates && !again) PetscFunctionReturn(0);
  PetscCall(VecNorm(u, NORM_INFINITY, &size));
  p->tolerance = PetscMin(first, fraction * report->update_error / size);
  if (again) PetscFunctionReturn(0);
  if (report->contact_updates > 1 && report->update_error > fair * p->gap_change)
    p->tolerance = PetscMin(p->tolerance, fraction * before);
  if (report->contact_updates > 1 && !sim->solved->linearization->slip &&
      PetscSqr(report->update_error) <= allowed * size * p->gap_change)
    p->tolerance = 0.0;
  p->gap_change = report->update_error;
  PetscFunctionReturn(0);
}

/*
   Finds whether the linearization that was just solved to p->tolerance must be solved to a smaller tolerance. *again:
   true for the last update, and for the first update if the change of the gap is below the tolerance of the solve.
*/
static PetscErrorCode AttemptEndedEarly(const StepProblem *p, PetscBool end, Vec u, const StepReport *report,
  PetscBool *again)
{
  PetscReal size;

  PetscFunctionBegin;
  PetscCall(VecNorm(u, NORM_INFINITY, &size));
  *again = (PetscBool)(report->converged && p->ended_early &&
                       (end || (report->contact_updates == 1 && report->update_error <= p->tolerance * size)));
  PetscFunctionReturn(0);
}

/*
   Tries whether the undeformed bodies are the solution of a load step to zero load. vanishes: whether a solve has led
   to u = 0 up to rounding. *rests: true if they are; sim->solved->linearization and *at_u are then linearizations at
   u = 0.
*/
static PetscErrorCode AttemptUndeformed(StepProblem *p, PetscBool vanishes, Vec u, StepReport *report,
  ContactSolution *sol, ContactLinearization *at_u, PetscBool *rests)
{
  Simulation           sim = p->sim;
  ContactLinearization undeformed;
  PetscBool            due, is_true;

  PetscFunctionBegin;
  *rests = PETSC_FALSE;
  PetscCall(ZeroLoadStepIsDue(p, vanishes, &due));
  if (!due) PetscFunctionReturn(0);
  PetscCall(VecZeroEntries(u));
  PetscCall(AttemptLinearizeGap(sim, p->time, u, PETSC_FALSE, &undeformed));
  PetscCall(ZeroLoadStepSolve(p, undeformed, u, report, sol, rests));
  if (*rests) {
    PetscCall(ContactLinearizationDestroy(&sim->solved->linearization));
    sim->solved->linearization = undeformed;
    PetscCall(ContactLinearizationDestroy(at_u));
    PetscCall(AttemptLinearizeGap(sim, p->time, u, PETSC_FALSE, at_u));
    PetscCall(AttemptMeasureGap(p, u, sol, *at_u, report, &is_true));
    report->gap_change = report->normals_turn = report->slip_change = report->update_error = 0.0;
    report->gap_unconverged                                                                = PETSC_FALSE;
    report->contact_updates                                                                = 1;
  } else PetscCall(ContactLinearizationDestroy(&undeformed));
  PetscFunctionReturn(0);
}

/*
   Finds whether the elastic energy at u is zero up to rounding, compared with those of the last state and of earlier
   load steps, at the end of a load step with friction to zero load. *rested: whether that of the last state was zero,
   too
*/
static PetscErrorCode AttemptVanishes(const StepProblem *p, Vec u, PetscBool *vanishes, PetscBool *rested)
{
  const StepReport *steps     = p->sim->report.steps;
  const PetscReal   vanishing = 1e-7;
  PetscReal         energy, before, largest;

  PetscFunctionBegin;
  *vanishes = *rested = PETSC_FALSE;
  if (p->friction.T) PetscCall(ZeroLoadStepIsDue(p, PETSC_TRUE, vanishes));
  if (!*vanishes) PetscFunctionReturn(0);
  PetscCall(ElasticityEnergy(p->sim->elasticity, u, &energy));
  PetscCall(ElasticityEnergy(p->sim->elasticity, p->sim->path->u, &before));
  largest = before;
  for (PetscInt s = 0; s + 1 < p->sim->report.nsteps; ++s) largest = PetscMax(largest, steps[s].energy);
  *vanishes = (PetscBool)(energy <= vanishing * largest);
  *rested   = (PetscBool)(before <= vanishing * largest);
  PetscFunctionReturn(0);
}

/*
   Sets sim->solved->linearization, and creates *u_linearized, the displacement of this linearization. It is u if u is a
   forecast; an extrapolation of the path if the gap may be linearized again; otherwise the last state. The last state
   is always used in the first load step, after a cut and with friction, because with friction the errors that the
   tolerance allows would add up over the load steps.
*/
static PetscErrorCode AttemptBegin(StepProblem *p, PetscBool foreseen, Vec u, const StepReport *report,
  Vec *u_linearized)
{
  Simulation sim       = p->sim;
  PetscBool  continues = (PetscBool)(sim->path->time > 0.0 && sim->scene->contact_updates > 1 && !report->cuts);

  PetscFunctionBegin;
  for (PetscInt k = 0; k < sim->scene->npairs; ++k)
    if (SceneContactPairHasFriction(&sim->scene->pairs[k])) continues = PETSC_FALSE;
  PetscCall(VecDuplicate(u, u_linearized));
  PetscCall(VecCopy(foreseen ? u : sim->path->u, *u_linearized));
  if (foreseen || continues) {
    if (!foreseen) PetscCall(PathContinue(sim, p->time, *u_linearized));
    PetscCall(AttemptMakeRigid(p, *u_linearized));
    PetscCall(ContactLinearizationDestroy(&sim->solved->upcoming));
  }
  if (!sim->solved->upcoming)
    PetscCall(
      (foreseen ? ContactLinearize : ContactLinearizeForces)(sim->contact, *u_linearized, &sim->solved->upcoming));
  sim->solved->linearization = sim->solved->upcoming;
  sim->solved->upcoming      = NULL;
  PetscCall(InterferenceAdd(sim, p->time, 1.0, sim->solved->linearization));
  PetscFunctionReturn(0);
}

/*
   Updates the contact until the gap agrees, a solve fails or contact_updates is reached. On exit u is a solution of the
   problem with sim->solved->linearization, and *at_u is the linearization at u. foreseen: true if u is a forecast on
   entry.
*/
static PetscErrorCode AttemptContact(StepProblem *p, PetscBool foreseen, Vec u, StepReport *report,
  ContactSolution *sol, ContactLinearization *at_u)
{
  Simulation           sim     = p->sim;
  ContactUpdateSecants secants = {0};
  PetscBool            end = PETSC_FALSE, slid = PETSC_FALSE, again = PETSC_FALSE, last = PETSC_FALSE;
  PetscBool            vanishes, vanished = PETSC_FALSE, rested = PETSC_FALSE;
  PetscReal            held;
  Vec                  u_linearized;

  PetscFunctionBegin;
  report->contact_updates = 0;
  report->gap_unconverged = PETSC_FALSE;
  p->by_newton            = PETSC_FALSE;
  PetscCall(PetscArrayzero(sim->history->released, sim->history->npairs * sim->history->nowned));
  PetscCall(AttemptBegin(p, foreseen, u, report, &u_linearized));
  PetscCall(AttemptUndeformed(p, PETSC_FALSE, u, report, sol, at_u, &end));
  while (!end) {
    PetscCall(AttemptSetTolerance(p, foreseen, again, last, u, report));
    PetscCall(AttemptOnce(p, (PetscBool)(foreseen || again || report->contact_updates > 0), u_linearized, u, report,
      sol, at_u, &end, &slid));
    PetscCall(AttemptVanishes(p, u, &vanishes, &rested));
    vanished = (PetscBool)(vanished || vanishes);
    PetscCall(AttemptEndedEarly(p, end, u, report, &again));
    last = (PetscBool)(again && end);
    if (again) {
      end = PETSC_FALSE;
      --report->contact_updates;
      PetscCall(ContactLinearizationDestroy(at_u));
      continue;
    }
    if (end || report->contact_updates == sim->scene->contact_updates) break;
    if (report->gap_unconverged && secants.n >= ATTEMPT_PATIENCE && secants.least > 0.1 * secants.first) break;
    PetscCall(AttemptNextLinearization(p, &secants, sol, u, u_linearized, report, at_u));
    if (!report->converged) break;
  }
  /*
     Relative to forces of the size of rounding errors, residuals are meaningless. Bodies that friction holds without
     load keep a deformation, which a long increment may miss.
  */
  if (!report->converged && vanished && (rested || report->cuts >= ATTEMPT_SHORT) && !sim->control->interrupted)
    PetscCall(AttemptUndeformed(p, PETSC_TRUE, u, report, sol, at_u, &end));
  PetscCall(VecDestroy(&u_linearized));
  PetscCall(ContactUpdateSecantsDestroy(&secants));
  report->gap_unconverged =
    (PetscBool)(report->converged && (report->gap_unconverged || (slid && sim->scene->contact_updates > 1)));
  if (report->gap_unconverged) {
    PetscCall(AttemptReportGapError(sim, sol, *at_u, slid, report));
    PetscCall(ProximalMeasureHeld(p, u, &held));
    if (held > ATTEMPT_HELD) {
      PetscCall(WeakSpringsReportMotion(p, p->centre, u, report));
      report->gap_unconverged = PETSC_FALSE; /* the gap is not the reason of the failure: there is no equilibrium */
    }
  }
  PetscFunctionReturn(0);
}

static PetscErrorCode AttemptKeepSurface(Simulation sim, const ContactSolution *sol)
{
  const PetscInt     n = sim->solved->linearization->nlocal;
  const PetscScalar *z, *g;

  PetscFunctionBegin;
  PetscCall(PetscFree2(sim->solved->pressure, sim->solved->gap));
  PetscCall(PetscMalloc2(n, &sim->solved->pressure, n, &sim->solved->gap));
  PetscCall(VecGetArrayRead(sol->pressure, &z));
  PetscCall(VecGetArrayRead(sol->gap, &g));
  for (PetscInt i = 0; i < n; ++i) {
    sim->solved->pressure[i] = PetscRealPart(z[i]);
    sim->solved->gap[i]      = PetscRealPart(g[i]);
  }
  PetscCall(VecRestoreArrayRead(sol->gap, &g));
  PetscCall(VecRestoreArrayRead(sol->pressure, &z));
  PetscFunctionReturn(0);
}

/*
   Counts attempts that failed because contact cannot hold the loads. If the count is 2, the load step is not cut
   further. A failure counts 2 if it is proven and no prescribed displacement moves, since smaller increments start from
   the same positions. Other failures count 1.
*/
static PetscErrorCode AttemptCountUnheld(const StepProblem *p, const StepReport *report)
{
  Simulation sim = p->sim;
  PetscBool  still;

  PetscFunctionBegin;
  if (report->converged || (!p->unheld && !p->moves_on)) {
    sim->control->unheld = 0;
    PetscFunctionReturn(0);
  }
  PetscCall(VecEqual(p->base, sim->path->u, &still));
  sim->control->unheld += still && p->unheld ? 2 : 1;
  if (!sim->control->cause) PetscCall(PetscStrallocpy(report->reason, &sim->control->cause));
  PetscFunctionReturn(0);
}

/*
   Decides whether a controlled time step is accepted. If its error exceeds the tolerance, it is repeated with a shorter
   time step. If contact closes or opens, or if half of the vertices in contact change, the error estimate for motions
   that are not smooth is used. The shortest time steps are always accepted.
*/
static PetscErrorCode AttemptJudgeTimeStep(Simulation sim, PetscReal time, Vec u, StepReport *report)
{
  TimeStepControl *c      = &sim->control->time_step;
  const PetscReal  length = time - sim->path->time, tolerance = sim->scene->dynamics.tolerance;
  PetscInt         closed = 0;
  PetscBool        smooth;
  char             reason[96];

  PetscFunctionBegin;
  c->too_long = PETSC_FALSE;
  if (!(tolerance > 0.0) || !report->converged) PetscFunctionReturn(0);
  if (sim->contact) PetscCall(ContactHistoryCountClosed(sim->history, sim->comm, &closed));
  smooth = (PetscBool)(2 * PetscAbsInt(closed - c->closed) <= PetscMax(closed, c->closed));
  PetscCall(InertiaEstimate(sim, time, smooth, u, &c->error));
  c->too_long = (PetscBool)(c->error > tolerance && length > STEP_SHORTEST);
  if (c->too_long) {
    PetscCall(PetscSNPrintf(reason, sizeof(reason), "the error %.3g of the time step is above the tolerance %g",
      (double)c->error, (double)tolerance));
    PetscCall(ReportReason(report, PETSC_FALSE, reason));
  } else {
    c->closed   = closed;
    c->largest  = PetscMax(c->largest, c->error);
    c->shortest = PetscMin(c->shortest, length);
  }
  PetscFunctionReturn(0);
}

/*
   Attempts to advance the state to `time`. After success sim->path, sim->solved->linearization, pressures and gaps are
   those of the new state. After a failure they are unchanged.
*/
PetscErrorCode SimulationAttempt(Simulation sim, PetscReal time, StepReport *report)
{
  const PetscInt       first = sim->scene->displacement_bounds;
  StepProblem          p;
  ContactSolution      sol  = {.gap = NULL};
  ContactLinearization good = sim->solved->linearization, at_u = NULL;
  PetscBool            foreseen;
  Vec                  u, inertia;

  PetscFunctionBegin;
  if (sim->contact && sim->path->time == 0.0 && !report->cuts && !sim->control->forecast.failed) {
    if (!sim->solved->upcoming) PetscCall(ContactLinearizeForces(sim->contact, sim->path->u, &sim->solved->upcoming));
    PetscCall(ContactCheckDepth(sim->contact, sim->solved->upcoming));
    PetscCall(StartWarn(sim, sim->solved->upcoming));
  }
  PetscCall(PetscLogEventBegin(SIM_Assembly, NULL, NULL, NULL, NULL));
  PetscCall(StepProblemCreate(sim, time, &p));
  PetscCall(PetscLogEventEnd(SIM_Assembly, NULL, NULL, NULL, NULL));
  PetscCall(VecDuplicate(sim->path->u, &u));
  if (first && time > (PetscReal)(first - 1) && sim->path->largest_increment > 0.0)
    PetscCall(StepProblemSetBounds(&p, sim->path->largest_increment));
  PetscCall(ForecastGet(&p, u, &foreseen));
  if (sim->contact) {
    PetscCall(AttemptContact(&p, foreseen, u, report, &sol, &at_u));
    while (!report->converged && ProximalMayHoldWeak(&p)) {
      PetscCall(ContactLinearizationDestroy(&at_u));
      PetscCall(ContactLinearizationDestroy(&sim->solved->linearization));
      PetscCall(ProximalHoldWeak(&p, u));
      PetscCall(AttemptContact(&p, PETSC_FALSE, u, report, &sol, &at_u));
    }
    PetscCall(PetscLogEventBegin(SIM_Forces, NULL, NULL, NULL, NULL));
    PetscCall(AttemptFindPassed(sim, time, u, report));
    PetscCall(PetscLogEventEnd(SIM_Forces, NULL, NULL, NULL, NULL));
  } else PetscCall(AttemptBodies(&p, foreseen, u, report, &sol));

  PetscCall(AttemptCountUnheld(&p, report));
  PetscCall(AttemptJudgeTimeStep(sim, time, u, report));
  if (report->converged) {
    PetscCall(PetscLogEventBegin(SIM_Forces, NULL, NULL, NULL, NULL));
    PetscCall(InertiaGetForce(sim, u, &inertia));
    PetscCall(ElasticityCommit(sim->elasticity, u));
    PetscCall(InertiaAdvance(sim, time, u));
    PetscCall(PetscLogEventEnd(SIM_Forces, NULL, NULL, NULL, NULL));
    PetscCall(MeasureState(p.sim, p.time, p.load, inertia, u, &sol, report));
    PetscCall(VecDestroy(&inertia));
    if (sim->contact) PetscCall(AttemptKeepSurface(sim, &sol));
    if (sim->contact) PetscCall(FrictionSettle(sim, time, u, &sol));
    PetscCall(PathAdvance(sim->path, time, &u));
    PetscCall(ContactLinearizationDestroy(&good));
    PetscCall(ContactLinearizationDestroy(&sim->solved->upcoming));
    /* if only the gap was computed, the next load step must linearize again */
    if (at_u && at_u->gaps_only) PetscCall(ContactLinearizationDestroy(&at_u));
    sim->solved->upcoming = at_u;
    if (at_u) PetscCall(InterferenceAdd(sim, time, -1.0, sim->solved->upcoming));
  } else if (sim->contact) {
    PetscCall(ContactLinearizationDestroy(&sim->solved->linearization));
    sim->solved->linearization = good;
    PetscCall(ContactLinearizationDestroy(&at_u));
  }
  PetscCall(VecDestroy(&u));
  PetscCall(ContactSolutionDestroy(&sol));
  PetscCall(StepProblemDestroy(&p));
  PetscFunctionReturn(0);
}
