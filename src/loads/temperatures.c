/* Temperatures of the scene, by ramp, as linear functions in the cells */
#include "loadsimpl.h"
#include <rankerror.h>

/* Evaluates the formula of a temperature at the position x */
static PetscErrorCode TemperatureAt(void *ctx, const PetscReal x[3], PetscReal *value)
{
  const SceneTemperature *here = (const SceneTemperature *)ctx;

  PetscFunctionBegin;
  PetscCall(SceneEvaluatePlace(here, "Temperature", here->value, x, value));
  PetscFunctionReturn(0);
}

/* Fits linear functions in the cells to the formulas of all temperatures */
static PetscErrorCode TemperaturesFit(Scene scene, Elasticity elasticity, Temperatures *temperatures)
{
  PetscFunctionBegin;
  for (PetscInt t = 0; t < scene->ntemperatures; ++t) {
    SceneTemperature *here = &scene->temperatures[t];
    PetscReal       **fits = &temperatures->fits[here->ramp];

    if (!*fits) PetscCall(PetscCalloc1(temperatures->n + 1, fits));
    PetscCall(ElasticityFitTemperature(elasticity, here->body, TemperatureAt, here, *fits));
  }
  PetscFunctionReturn(0);
}

PetscErrorCode TemperaturesCreate(Scene scene, Elasticity elasticity, MPI_Comm comm, Temperatures *temperatures)
{
  PetscFunctionBegin;
  *temperatures = (Temperatures){.comm = comm, .scene = scene, .elasticity = elasticity};
  if (!scene->ntemperatures) PetscFunctionReturn(0);
  PetscCall(ElasticityGetCellCount(elasticity, &temperatures->n));
  temperatures->n *= 4;
  PetscCall(PetscCalloc2(scene->nramps, &temperatures->fits, temperatures->n + 1, &temperatures->now));
  RankCall(comm, PETSC_TRUE, TemperaturesFit(scene, elasticity, temperatures));
  PetscFunctionReturn(0);
}

/* Sets the temperature at a time, which then applies to energies, forces and stresses */
PetscErrorCode TemperaturesApply(Temperatures *temperatures, PetscReal time)
{
  Scene scene = temperatures->scene;

  PetscFunctionBegin;
  if (!temperatures->now) PetscFunctionReturn(0);
  PetscCall(PetscArrayzero(temperatures->now, temperatures->n));
  for (PetscInt r = 0; r < scene->nramps; ++r) {
    PetscReal factor;

    if (!temperatures->fits[r]) continue;
    PetscCall(SceneGetFactor(scene, r, time, &factor));
    for (PetscInt i = 0; i < temperatures->n; ++i) temperatures->now[i] += factor * temperatures->fits[r][i];
  }
  PetscCall(ElasticitySetTemperature(temperatures->elasticity, temperatures->now));
  PetscFunctionReturn(0);
}

/* Collective. Computes the largest magnitude of a coefficient over all cells, at the time that was applied last */
PetscErrorCode TemperaturesGetLargest(const Temperatures *temperatures, PetscReal *size)
{
  PetscFunctionBegin;
  *size = 0;
  if (!temperatures->now) PetscFunctionReturn(0);
  for (PetscInt i = 0; i < temperatures->n; ++i) *size = PetscMax(*size, PetscAbsReal(temperatures->now[i]));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, size, 1, MPIU_REAL, MPIU_MAX, temperatures->comm));
  PetscFunctionReturn(0);
}

PetscErrorCode TemperaturesDestroy(Temperatures *temperatures)
{
  PetscFunctionBegin;
  if (!temperatures->now) PetscFunctionReturn(0);
  for (PetscInt r = 0; r < temperatures->scene->nramps; ++r) PetscCall(PetscFree(temperatures->fits[r]));
  PetscCall(PetscFree2(temperatures->fits, temperatures->now));
  PetscFunctionReturn(0);
}
