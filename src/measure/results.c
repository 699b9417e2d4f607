/* Computes fields for probes and files: stress at the nodes and at the quadrature points, strain energy */
#include "measureimpl.h"
#include "src/elasticity/recovery/recoveryimpl.h"
#include <math.h>
#include "src/state/results.h"

/* Completes a stress: stress, von Mises stress, principal values */
PetscErrorCode ResultsComplete(const PetscReal stress[6], PetscReal values[STRESS_VALUES])
{
  PetscFunctionBegin;
  PetscCall(PetscArraycpy(values, stress, 6));
  values[6] = StressVonMises(stress);
  PetscCall(ElasticityPrincipal(stress, values + 7));
  PetscFunctionReturn(0);
}

/* Copies the values of the owned nodes in the order of global vectors */
static PetscErrorCode ResultsPickOwned(Simulation sim)
{
  Results     *results = sim->results;
  PetscSection local, global;
  PetscInt     pstart, pend, rstart, n;

  PetscFunctionBegin;
  PetscCall(VecGetLocalSize(sim->state->path->u, &n));
  PetscCall(VecGetOwnershipRange(sim->state->path->u, &rstart, NULL));
  PetscCall(PetscMalloc1(STRESS_VALUES * (n / 3) + 1, &results->nodal));
  PetscCall(DMGetLocalSection(sim->model->dm, &local));
  PetscCall(DMGetGlobalSection(sim->model->dm, &global));
  PetscCall(PetscSectionGetChart(local, &pstart, &pend));
  for (PetscInt v = pstart; v < pend; ++v) {
    PetscInt from, to, ndofs;

    PetscCall(PetscSectionGetDof(local, v, &ndofs));
    PetscCall(PetscSectionGetOffset(global, v, &to));
    if (!ndofs || to < 0) continue;
    PetscCall(PetscSectionGetOffset(local, v, &from));
    PetscCall(
      ResultsComplete(results->recovered + 6 * (from / 3), results->nodal + STRESS_VALUES * ((to - rstart) / 3)));
  }
  PetscFunctionReturn(0);
}

/* Copies the largest values of a body to its report */
static PetscErrorCode ResultsReportBody(const Material *material, const LargestOfBody *largest, BodyReport *report)
{
  const PetscBool rigid = (PetscBool)(material->type == MATERIAL_RIGID);

  PetscFunctionBegin;
  report->displacement = largest->displacement.value;
  report->von_mises    = rigid ? NAN : largest->von_mises.value;
  for (PetscInt d = 0; d < 3; ++d) {
    report->displacement_place[d] = largest->displacement.place[d];
    report->von_mises_place[d]    = rigid ? NAN : largest->von_mises.place[d];
  }
  report->safety = NAN;
  if (material->hardening.yield > 0.0 && report->von_mises > 0.0)
    report->safety = material->hardening.yield / report->von_mises;
  if (report->plastic_strain > 0.0) report->safety = PetscMin(report->safety, 1.0);
  PetscFunctionReturn(0);
}

/* Copies the forces on the nodes to results->reaction if fields are requested */
PetscErrorCode ResultsKeepReaction(Results *results, Vec force)
{
  PetscFunctionBegin;
  if (!results->nodes) PetscFunctionReturn(0);
  if (!results->reaction) PetscCall(VecDuplicate(force, &results->reaction));
  PetscCall(VecCopy(force, results->reaction));
  PetscFunctionReturn(0);
}

/*
   Collective. Recovers the stress at the nodes, unless this was done, and reports the largest values of each body.
   errors, cells: see ElasticityRecoverStress(); NULL: no errors are estimated
*/
PetscErrorCode ResultsRecover(Model model, Results *results, Vec u, PetscReal errors[], PetscReal *cells[],
  StepReport *report)
{
  LargestOfBody *largest;

  PetscFunctionBegin;
  if (results->recovered) PetscFunctionReturn(0);
  PetscCall(PetscCalloc1(model->scene->nbodies, &largest));
  PetscCall(ElasticityRecoverStress(model->elasticity, u, &results->recovered, largest, errors, cells));
  for (PetscInt b = 0; b < report->nbodies; ++b)
    PetscCall(ResultsReportBody(&model->scene->bodies[b].material, &largest[b], &report->bodies[b]));
  PetscCall(PetscFree(largest));
  PetscFunctionReturn(0);
}

/* Computes the requested fields at the last state */
PetscErrorCode ResultsMeasure(Simulation sim, StepReport *report)
{
  Results *results = sim->results;

  PetscFunctionBegin;
  PetscCall(ElasticityCellPlastic(sim->model->elasticity, &results->plastic));
  PetscCall(PetscLogEventBegin(SIM_Results, NULL, NULL, NULL, NULL));
  PetscCall(ResultsRecover(sim->model, sim->results, sim->state->path->u, NULL, NULL, report));
  if (results->nodes) {
    PetscCall(ResultsPickOwned(sim));
    PetscCall(ElasticityCellEnergy(sim->model->elasticity, sim->state->path->u, &results->density));
  }
  if (results->points)
    PetscCall(ElasticityPointStress(sim->model->elasticity, sim->state->path->u, &results->npoints, &results->places,
      &results->point_stress));
  PetscCall(PetscLogEventEnd(SIM_Results, NULL, NULL, NULL, NULL));
  PetscFunctionReturn(0);
}

PetscErrorCode ResultsFree(Results *results)
{
  PetscFunctionBegin;
  PetscCall(PetscFree(results->recovered));
  PetscCall(PetscFree(results->plastic));
  PetscCall(PetscFree(results->nodal));
  PetscCall(PetscFree(results->density));
  PetscCall(PetscFree(results->places));
  PetscCall(PetscFree(results->point_stress));
  PetscCall(VecDestroy(&results->reaction));
  PetscFunctionReturn(0);
}
