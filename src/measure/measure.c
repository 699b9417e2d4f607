/* Measures a state from the elements and the contact rows: forces, gaps, equilibrium, errors */
#include "measureimpl.h"
#include <vector3.h>
#include <math.h>
#include "src/state/contact_history.h"
#include "src/state/contact_state.h"
#include "src/state/results.h"
#include "src/state/run.h"

/*
   Computes the magnitude of the sum of the contact forces on both sides, q = J_full^T M z, relative to the sum of their
   magnitudes. It is zero if action equals reaction.
*/
static PetscErrorCode MeasureActionReaction(const Measured *at, Vec q, StepReport *report)
{
  PetscReal *bodies, sums[4] = {0.0};

  PetscFunctionBegin;
  PetscCall(PetscMalloc1(4 * at->scene->nbodies, &bodies));
  PetscCall(VertexPlacesSumForces(&at->places, q, q, at->scene->nbodies, bodies));
  for (PetscInt k = 0; k < 4 * at->scene->nbodies; ++k) sums[k % 4] += bodies[k];
  report->action_reaction = sums[3] > 0.0 ? VectorNorm(sums) / sums[3] : 0.0;
  PetscCall(PetscFree(bodies));
  PetscFunctionReturn(0);
}

/* Creates *gap, what the laws of contact keep from being negative: the gap plus the depth by which soft pairs yield */
static PetscErrorCode MeasureGetGap(const ContactSolution *sol, Vec *gap)
{
  PetscFunctionBegin;
  PetscCall(VecDuplicate(sol->gap, gap));
  PetscCall(VecCopy(sol->gap, *gap));
  if (sol->yield) PetscCall(VecAXPY(*gap, 1.0, sol->yield));
  PetscFunctionReturn(0);
}

static PetscErrorCode MeasureGap(const ContactSolution *sol, StepReport *report)
{
  Vec       product;
  PetscReal largest;

  PetscFunctionBegin;
  report->gap_min = NAN;
  PetscCall(VecGetSize(sol->gap, &report->constraints));
  if (!report->constraints) PetscFunctionReturn(0);
  PetscCall(VecMin(sol->gap, NULL, &report->gap_min));
  PetscCall(MeasureGetGap(sol, &product));
  PetscCall(VecPointwiseMult(product, product, sol->pressure));
  PetscCall(VecNorm(product, NORM_INFINITY, &largest));
  report->complementarity = largest;
  PetscCall(VecDestroy(&product));
  PetscFunctionReturn(0);
}

/* Adds the squared errors of the cells to those of earlier load steps */
static PetscErrorCode MeasureAddErrors(Model model, RunState *run, PetscReal cells[])
{
  PetscInt cstart, cend;

  PetscFunctionBegin;
  PetscCall(DMPlexGetHeightStratum(model->dm, 0, &cstart, &cend));
  if (!run->adapt.errors) PetscCall(PetscCalloc2(cend - cstart, &run->adapt.errors, cend - cstart, &run->adapt.marked));
  for (PetscInt c = 0; c < cend - cstart; ++c) run->adapt.errors[c] += cells[c];
  PetscCall(PetscFree(cells));
  PetscFunctionReturn(0);
}

/*
   Estimates the discretization error in the energy norm, relative to the energy norm of the displacement.
   report->energy must be set. moves: the bodies only move as a whole, so that their energy is rounding error.
*/
static PetscErrorCode MeasureDiscretization(Model model, Results *results, RunState *run, Vec u, PetscBool moves,
  StepReport *report)
{
  const PetscReal size = moves ? 0.0 : PetscSqrtReal(2.0 * report->energy);
  PetscReal       sum = 0.0, *cells = NULL;

  PetscFunctionBegin;
  PetscCall(PetscFree(report->body_errors));
  PetscCall(PetscMalloc1(model->scene->nbodies, &report->body_errors));
  PetscCall(ResultsRecover(model, results, u, report->body_errors, run->marks ? &cells : NULL, report));
  if (run->marks) PetscCall(MeasureAddErrors(model, run, cells));
  for (PetscInt b = 0; b < model->scene->nbodies; ++b) {
    sum += report->body_errors[b];
    report->body_errors[b] = size > 0.0 ? PetscSqrtReal(report->body_errors[b]) / size : 0.0;
  }
  report->error_estimate = size > 0.0 ? PetscSqrtReal(sum) / size : 0.0;
  PetscFunctionReturn(0);
}

/*
   Estimates the relative error in energy that the solver leaves. It is the sum of three terms, to first order, divided
   by twice the energy: the duality gap sum m |gap z|; the work of the residual forces; and the work of the pressures on
   the difference between the updated and the linearized gap. moves: the bodies only move, so that there is no energy to
   which an error is relative.
*/
static PetscErrorCode MeasureAlgebraicError(Vec u, Vec residual, const ContactSolution *sol, Vec weighted,
  PetscBool moves, StepReport *report)
{
  PetscScalar work, duality = 0.0;
  PetscReal   press = 0.0;
  Vec         products;

  PetscFunctionBegin;
  report->gap_error = report->algebraic_error = 0.0;
  if (moves) PetscFunctionReturn(0);
  PetscCall(VecDot(u, residual, &work));
  if (weighted) {
    PetscCall(MeasureGetGap(sol, &products));
    PetscCall(VecPointwiseMult(products, weighted, products));
    PetscCall(VecAbs(products));
    PetscCall(VecSum(products, &duality));
    PetscCall(VecDestroy(&products));
    PetscCall(VecNorm(weighted, NORM_1, &press));
  }
  report->gap_error       = press * report->gap_change;
  report->algebraic_error = PetscAbsScalar(duality) + PetscAbsScalar(work) + report->gap_error;
  if (report->energy > 0.0) {
    report->gap_error /= 2.0 * report->energy;
    report->algebraic_error /= 2.0 * report->energy;
  }
  PetscFunctionReturn(0);
}

/*
   Scales the reactions. In the impact scheme they are only a part of the unbalanced forces; the rest is added to
   `applied`, the loads with the forces of inertia. ties and rigid may be NULL.
*/
static PetscErrorCode MeasureShareForces(const Measured *at, Vec force, Vec ties, Vec rigid, Vec applied)
{
  const PetscReal share    = SchemeShare(&at->scene->dynamics);
  const Vec       forces[] = {force, ties, rigid};

  PetscFunctionBegin;
  if (share == 1.0) PetscFunctionReturn(0);
  for (size_t k = 0; k < PETSC_STATIC_ARRAY_LENGTH(forces); ++k) {
    if (!forces[k]) continue;
    PetscCall(VecAXPY(applied, 1.0 - share, forces[k]));
    PetscCall(VecScale(forces[k], share));
  }
  PetscFunctionReturn(0);
}

/* Moves the contact forces that a time step has in addition to those at its end from `force` to `inertia` */
static PetscErrorCode MeasureAddMultipliers(const Measured *at, Vec contact, Vec force, Vec inertia)
{
  const PetscReal more = 1.0 / SchemeShare(&at->scene->dynamics) - 1.0;

  PetscFunctionBegin;
  PetscCall(VecAXPY(force, -more, contact));
  PetscCall(VecAXPY(inertia, more, contact));
  PetscFunctionReturn(0);
}

/* Reports the plastic work separately from the energy, and the largest plastic strain of each body */
static PetscErrorCode MeasurePlastic(Scene scene, Elasticity elasticity, StepReport *report)
{
  PetscReal *largest;

  PetscFunctionBegin;
  PetscCall(PetscMalloc1(scene->nbodies, &largest));
  PetscCall(ElasticityPlasticWork(elasticity, &report->plastic_work, largest));
  report->energy -= report->plastic_work;
  report->plastic_strain = 0.0;
  for (PetscInt b = 0; b < scene->nbodies; ++b) {
    report->bodies[b].plastic_strain = largest[b];
    report->plastic_strain           = PetscMax(report->plastic_strain, largest[b]);
  }
  PetscCall(PetscFree(largest));
  PetscFunctionReturn(0);
}

/*
   Measures the contact pairs. *weighted: forces of the rows; *contact: forces on the bodies; *late: see
   FrictionMeasure()
*/
static PetscErrorCode MeasureContact(Model model, State state, PetscReal time, Vec u, const ContactSolution *sol,
  StepReport *report, Vec *weighted, Vec *contact, PetscReal *late)
{
  const Measured at   = MeasuredAt(model, state, NULL);
  PetscScalar    work = 0.0;

  PetscFunctionBegin;
  PetscCall(MeasureGap(sol, report));
  PetscCall(VecDuplicate(sol->pressure, weighted));
  PetscCall(VecDuplicate(u, contact));
  PetscCall(RowsGetForces(state->solved->linearization, sol, *weighted, *contact));
  if (sol->stored) PetscCall(VecDot(*weighted, sol->stored, &work));
  report->contact_energy = PetscRealPart(work);
  PetscCall(ForcesMeasurePairs(&at, u, *weighted, sol->shear, report));
  PetscCall(FrictionMeasure(model, state, time, u, sol, report, late));
  PetscCall(MeasureActionReaction(&at, *contact, report));
  PetscFunctionReturn(0);
}

/* Measures everything but the error of the discretization. *moves: whether the bodies only move as a whole, without
   stress */
static PetscErrorCode MeasureForces(Simulation sim, PetscReal time, Vec load, Vec inertia, Vec u,
  const ContactSolution *sol, StepReport *report, PetscBool *moves)
{
  const Measured    at          = MeasuredAt(sim->model, sim->state, NULL);
  const Constraints constraints = ModelConstraints(sim->model);
  Vec               force, ties, rigid, contact = NULL, weighted = NULL, applied = load;
  PetscReal         size, residual, rounding, late = 0.0;

  PetscFunctionBegin;
  PetscCall(VecNorm(u, NORM_INFINITY, &rounding));
  rounding *= MEASURE_ROUNDING * sim->model->stiffness; /* rounding error of the forces on bodies without stress */
  report->force_rounding = rounding;
  PetscCall(ForcesReserve(&at, report));
  PetscCall(VecDuplicate(u, &force));
  PetscCall(ElasticityEnergy(sim->model->elasticity, u, &report->energy));
  PetscCall(MeasurePlastic(sim->model->scene, sim->model->elasticity, report));
  PetscCall(ElasticityForce(sim->model->elasticity, u, force));
  PetscCall(VecNorm(force, NORM_2, &size));
  *moves = (PetscBool)(size <= rounding);
  if (inertia && load) PetscCall(VecAXPY(inertia, 1.0, load));
  if (inertia) applied = inertia; /* the loads together with the forces of inertia */
  if (applied) PetscCall(VecAXPY(force, -1.0, applied));
  if (sol->pressure) {
    PetscCall(MeasureContact(sim->model, sim->state, time, u, sol, report, &weighted, &contact, &late));
    PetscCall(VecAXPY(force, -1.0, contact));
    if (inertia) PetscCall(MeasureAddMultipliers(&at, contact, force, applied));
    if (sim->model->dynamics.turned) PetscCall(VecAXPY(contact, -0.5, sim->model->dynamics.turned));
    if (!sim->state->history->frictional && !inertia) PetscCall(VecDestroy(&contact));
  }
  PetscCall(TiesGetForces(&constraints, force, &ties, &rigid));
  PetscCall(WorkAdd(sim, load, u, force, rigid, &contact, late, report));
  if (inertia) PetscCall(MotionMeasure(sim->model, sim->state, u, report));
  PetscCall(MeasureShareForces(&at, force, ties, rigid, applied));
  PetscCall(ForcesMeasureFaces(sim->model, u, force, ties, rigid, report));
  PetscCall(ForcesMeasureBodies(sim->model, u, applied, ties, rounding, report)); /* needs all forces on faces */
  PetscCall(PrescribedSum(&sim->model->prescribed, force, report->reaction));
  PetscCall(VecDestroy(&ties));
  PetscCall(VecDestroy(&rigid));
  PetscCall(ResultsKeepReaction(sim->results, force));
  PetscCall(PrescribedSet(&sim->model->prescribed, 0.0, force));
  if (sim->results->reaction) PetscCall(VecAXPY(sim->results->reaction, -1.0, force));
  PetscCall(VecNorm(force, NORM_2, &residual));
  report->equilibrium = *moves ? 0.0 : residual / size;
  PetscCall(MeasureAlgebraicError(u, force, sol, weighted, *moves, report));
  PetscCall(VecDestroy(&weighted));
  PetscCall(VecDestroy(&force));
  PetscFunctionReturn(0);
}

/*
   Computes all results of a state from the elements and the contact rows, not from the solver: energy; equilibrium
   residual; reaction = internal - contact - dead force in prescribed rows; at the end of a load step the discretization
   error. inertia: forces of mass and damping on the bodies; NULL in a static analysis.
*/
PetscErrorCode MeasureState(Simulation sim, PetscReal time, Vec load, Vec inertia, Vec u, const ContactSolution *sol,
  StepReport *report)
{
  PetscBool moves = PETSC_FALSE;

  PetscFunctionBegin;
  PetscCall(PetscLogEventBegin(SIM_Forces, NULL, NULL, NULL, NULL));
  PetscCall(MeasureForces(sim, time, load, inertia, u, sol, report, &moves));
  PetscCall(PetscLogEventEnd(SIM_Forces, NULL, NULL, NULL, NULL));
  if (sim->results->estimate && time == (PetscReal)report->step)
    PetscCall(MeasureDiscretization(sim->model, sim->results, sim->run, u, moves, report));
  PetscFunctionReturn(0);
}
