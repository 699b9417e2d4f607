/* Warns of bodies with a law of small strain that are strained or rotated far beyond its range */
#include "measureimpl.h"
#include "src/state/path.h"
#include "src/state/results.h"

#define STRAIN_LIMIT   0.25 /* largest principal strain, in the mean over the body's strain energy */
#define ROTATION_LIMIT 0.25 /* largest rotation angle, in the mean over the body's volume [rad] */

/* Returns whether there are bodies of which no warning has been printed yet */
static PetscBool StrainMayWarn(Scene scene, const PetscBool beyond[])
{
  PetscBool any = PETSC_FALSE;

  for (PetscInt b = 0; b < scene->nbodies; ++b) {
    const Material *material = &scene->bodies[b].material;

    any = (PetscBool)(any || (!beyond[b] && material->type != MATERIAL_RIGID && !MaterialIsFinite(material)));
  }
  return any;
}

/* Collective. Finds whether the strain or rotation of a body may exceed a limit for the first time. If no quadrature
   point exceeds it, the mean does not either. values: work array, two values per body */
static PetscErrorCode StrainMayExceed(Simulation sim, PetscReal values[][2], PetscBool *may)
{
  PetscFunctionBegin;
  *may = PETSC_FALSE;
  PetscCall(ElasticityBoundStrain(sim->elasticity, sim->path->u, values));
  for (PetscInt b = 0; b < sim->scene->nbodies; ++b)
    *may = (PetscBool)(*may || (!sim->results->beyond[b] && sim->scene->bodies[b].material.type != MATERIAL_RIGID &&
                                 (values[b][0] > STRAIN_LIMIT || values[b][1] > ROTATION_LIMIT)));
  PetscFunctionReturn(0);
}

/*
   Measures the last state, and warns once of each body, in the first load step in which it is beyond the range of its
   law. Rigid bodies may rotate. Collective.
*/
PetscErrorCode StrainWarn(Simulation sim, PetscInt step)
{
  Scene scene = sim->scene;
  PetscReal(*values)[2];
  PetscBool may;

  PetscFunctionBegin;
  if (!sim->results->beyond) PetscCall(PetscCalloc1(scene->nbodies, &sim->results->beyond));
  if (!StrainMayWarn(scene, sim->results->beyond)) PetscFunctionReturn(0);
  PetscCall(PetscCalloc1(scene->nbodies, &values));
  PetscCall(StrainMayExceed(sim, values, &may));
  if (may) PetscCall(ElasticityMeasureStrain(sim->elasticity, sim->path->u, values));
  for (PetscInt b = 0; b < scene->nbodies && may; ++b) {
    const PetscBool turned = (PetscBool)(values[b][0] <= STRAIN_LIMIT);

    if (sim->results->beyond[b] || scene->bodies[b].material.type == MATERIAL_RIGID ||
        (turned && values[b][1] <= ROTATION_LIMIT))
      continue;
    sim->results->beyond[b] = PETSC_TRUE;
    PetscCall(ReportWarn(sim->comm, &sim->report,
      "body \"%s\" is %s by %.2g %s on average in load step %" PetscInt_FMT
      ", but its material law is for small strains: its forces have an error of about that size; use material: "
      "neohookean or another finite-strain law",
      scene->bodies[b].name, turned ? "rotated" : "strained",
      (double)(turned ? values[b][1] * 180.0 / PETSC_PI : 100.0 * values[b][0]), turned ? "degrees" : "%", step + 1));
  }
  PetscCall(PetscFree(values));
  PetscFunctionReturn(0);
}
