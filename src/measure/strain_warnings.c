/* Warns of bodies with a law of small strain that are strained or rotated far beyond its range, and finds those that
   are turned inside out */
#include "measureimpl.h"
#include "src/state/results.h"

#define STRAIN_LIMIT   0.25 /* largest principal strain, in the mean over the body's strain energy */
#define ROTATION_LIMIT 0.25 /* largest rotation angle, in the mean over the body's volume [rad] */
#define INVERTED_LIMIT 0.1  /* largest share of the body's volume that may be inverted, as it is at singular edges */

/* Returns whether a body has a law of small strain */
static PetscBool StrainApplies(Scene scene, PetscInt b)
{
  const Material *material = &scene->bodies[b].material;

  return (PetscBool)(material->type != MATERIAL_RIGID && !MaterialIsFinite(material));
}

/* Collective. Finds whether a body may be inverted, or may exceed a limit for which no warning has been printed. The
   test is the largest value at quadrature points, which bounds the mean. warned: bodies with a printed warning */
static PetscErrorCode StrainMayExceed(const Measured *at, const PetscBool warned[], PetscBool *may)
{
  Scene     scene = at->scene;
  PetscBool any   = PETSC_FALSE;
  PetscReal(*bounds)[2];

  PetscFunctionBegin;
  *may = PETSC_FALSE;
  for (PetscInt b = 0; b < scene->nbodies; ++b) any = (PetscBool)(any || StrainApplies(scene, b));
  if (!any) PetscFunctionReturn(0);
  PetscCall(PetscCalloc1(scene->nbodies, &bounds));
  PetscCall(ElasticityBoundStrain(at->elasticity, at->u, bounds));
  for (PetscInt b = 0; b < scene->nbodies; ++b)
    *may = (PetscBool)(*may || (StrainApplies(scene, b) &&
                                 (bounds[b][0] >= 1.0 ||
                                   (!warned[b] && (bounds[b][0] > STRAIN_LIMIT || bounds[b][1] > ROTATION_LIMIT)))));
  PetscCall(PetscFree(bounds));
  PetscFunctionReturn(0);
}

/* Fails the load step if a body is turned inside out. inverted: share of its volume */
static PetscErrorCode StrainRefuse(const Measured *at, PetscInt b, PetscReal inverted, StepReport *report)
{
  PetscFunctionBegin;
  PetscCall(ReportReason(report, PETSC_FALSE,
    "body \"%s\" is turned inside out: %.3g %% of its volume is compressed to a thickness below zero, which its "
    "material law for small strains does not prevent; use material: neohookean or another finite-strain law, or "
    "smaller loads",
    at->scene->bodies[b].name, 100.0 * (double)inverted));
  ReportFailRun(at->report, report, RUN_FAILED);
  PetscFunctionReturn(0);
}

/*
   Measures the last state. Fails the load step if a body is turned inside out. Warns once of each body, in the first
   load step in which it is beyond the range of its law. Rigid bodies may rotate. Collective.
*/
PetscErrorCode StrainTest(Simulation sim, StepReport *report)
{
  const Measured at    = SimulationMeasured(sim);
  Scene          scene = sim->model->scene;
  PetscReal(*values)[3];
  PetscBool may;

  PetscFunctionBegin;
  if (!sim->results->beyond) PetscCall(PetscCalloc1(scene->nbodies, &sim->results->beyond));
  PetscCall(StrainMayExceed(&at, sim->results->beyond, &may));
  if (!may) PetscFunctionReturn(0);
  PetscCall(PetscCalloc1(scene->nbodies, &values));
  PetscCall(ElasticityMeasureStrain(sim->model->elasticity, sim->state->path->u, values));
  for (PetscInt b = 0; b < scene->nbodies; ++b) {
    const PetscBool turned = (PetscBool)(values[b][0] <= STRAIN_LIMIT);

    if (!StrainApplies(scene, b)) continue;
    if (report->converged && values[b][2] > INVERTED_LIMIT) PetscCall(StrainRefuse(&at, b, values[b][2], report));
    if (sim->results->beyond[b] || (turned && values[b][1] <= ROTATION_LIMIT)) continue;
    sim->results->beyond[b] = PETSC_TRUE;
    PetscCall(ReportWarn(sim->model->comm, &sim->report, scene->bodies[b].place,
      "body \"%s\" is %s by %.3g %s on average in load step %" PetscInt_FMT ", but its material law is for small "
      "strains: its forces have an error of about that size; use material: neohookean or another finite-strain law",
      scene->bodies[b].name, turned ? "rotated" : "strained",
      (double)(turned ? values[b][1] * 180.0 / PETSC_PI : 100.0 * values[b][0]), turned ? "degrees" : "%",
      report->step));
  }
  PetscCall(PetscFree(values));
  PetscFunctionReturn(0);
}
