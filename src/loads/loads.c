/* Dead loads: pressures, tractions, forces and body forces of the scene, summed by ramp */
#include "loadsimpl.h"

/* Gets the load vector of a ramp, and creates it if it does not exist */
static PetscErrorCode DeadLoadsGetRamp(DM dm, DeadLoads *loads, PetscInt ramp, Vec *force)
{
  PetscFunctionBegin;
  if (!loads->force[ramp]) {
    PetscCall(DMCreateGlobalVector(dm, &loads->force[ramp]));
    PetscCall(VecZeroEntries(loads->force[ramp]));
  }
  *force = loads->force[ramp];
  PetscFunctionReturn(0);
}

/* Adds the forces at points of elastic bodies */
static PetscErrorCode DeadLoadsAddPoints(Scene scene, DM dm, DeadLoads *loads)
{
  const SceneEntry **entry;
  BodyPoint         *place;
  PetscReal(*x)[3];
  PetscInt *body, n = 0, start, end;
  Vec       force;

  PetscFunctionBegin;
  PetscCall(PetscMalloc4(scene->ntractions, &entry, scene->ntractions, &place, scene->ntractions, &x, scene->ntractions,
    &body));
  for (PetscInt i = 0; i < scene->ntractions; ++i) {
    const SceneTraction *point = &scene->tractions[i];

    if (!SceneForceIsAtPoint(scene, point)) continue;
    entry[n] = (const SceneEntry *)point;
    body[n]  = point->body;
    PetscCall(PetscArraycpy(x[n++], point->point, 3));
  }
  if (n) PetscCall(BodyPointsLocate(dm, scene, "force", n, entry, body, x, place));
  for (PetscInt i = 0; i < n; ++i) {
    const SceneTraction *point = (const SceneTraction *)entry[i];

    PetscCall(DeadLoadsGetRamp(dm, loads, point->ramp, &force));
    PetscCall(VecGetOwnershipRange(force, &start, &end));
    for (PetscInt k = 0; k < 3 * place[i].n; ++k) {
      const PetscInt row = 3 * place[i].node[k / 3] + k % 3;

      if (row < start || row >= end) continue;
      PetscCall(VecSetValue(force, row, point->value[k % 3] * place[i].N[k / 3], ADD_VALUES));
    }
    PetscCall(VecAssemblyBegin(force));
    PetscCall(VecAssemblyEnd(force));
  }
  PetscCall(PetscFree4(entry, place, x, body));
  PetscFunctionReturn(0);
}

/* Evaluates the formula of a pressure at the position x. ctx: the ScenePressure */
PetscErrorCode PressureAt(void *ctx, const PetscReal x[3], PetscReal *value)
{
  const ScenePressure *here = (const ScenePressure *)ctx;

  PetscFunctionBegin;
  PetscCall(SceneEvaluatePlace(here, "Pressure", here->value, x, value));
  PetscFunctionReturn(0);
}

PetscErrorCode DeadLoadsCreate(Scene scene, DM dm, Elasticity elasticity, DeadLoads *loads)
{
  Vec force;

  PetscFunctionBegin;
  loads->scene = scene;
  loads->force = NULL;
  if (!scene->npressures && !scene->nforces && !scene->ntractions) PetscFunctionReturn(0);
  PetscCall(PetscCalloc1(scene->nramps, &loads->force));
  for (PetscInt i = 0; i < scene->npressures; ++i) {
    ScenePressure *pressure = &scene->pressures[i];

    if (pressure->follows) continue;
    PetscCall(DeadLoadsGetRamp(dm, loads, pressure->ramp, &force));
    PetscCall(ElasticityAddPressure(elasticity, pressure->face, 1.0, PressureAt, pressure, force));
  }
  for (PetscInt i = 0; i < scene->ntractions; ++i) {
    const SceneTraction *traction = &scene->tractions[i];

    if (SceneForceIsAtPoint(scene, traction)) continue;
    PetscCall(DeadLoadsGetRamp(dm, loads, traction->ramp, &force));
    if (traction->resultant)
      PetscCall(ElasticityAddForce(elasticity, traction->face, traction->value, traction->moment,
        traction->placed ? traction->point : NULL, force));
    else PetscCall(ElasticityAddFaceField(elasticity, traction->face, traction->value, force));
  }
  PetscCall(DeadLoadsAddPoints(scene, dm, loads));
  for (PetscInt i = 0; i < scene->nforces; ++i) {
    const SceneBodyForce *density = &scene->forces[i];
    const PetscInt        first   = density->body < 0 ? 0 : density->body;
    const PetscInt        end     = density->body < 0 ? scene->nbodies : first + 1;

    PetscCall(DeadLoadsGetRamp(dm, loads, density->ramp, &force));
    for (PetscInt b = first; b < end; ++b) {
      if (SceneBodyIsSurface(&scene->bodies[b])) continue; /* its cells are for pictures: it has no volume */
      PetscCall(ElasticityAddBodyForce(elasticity, b, density->value, force));
    }
  }
  PetscFunctionReturn(0);
}

/* Computes the dead load at a time, as a new vector; NULL if there is none */
PetscErrorCode DeadLoadsGet(const DeadLoads *loads, PetscReal time, Vec *force)
{
  PetscFunctionBegin;
  *force = NULL;
  if (!loads->force) PetscFunctionReturn(0);
  for (PetscInt r = 0; r < loads->scene->nramps; ++r) {
    PetscReal factor;

    if (!loads->force[r]) continue;
    if (!*force) {
      PetscCall(VecDuplicate(loads->force[r], force));
      PetscCall(VecZeroEntries(*force));
    }
    PetscCall(SceneGetFactor(loads->scene, r, time, &factor));
    PetscCall(VecAXPY(*force, factor, loads->force[r]));
  }
  PetscFunctionReturn(0);
}

PetscErrorCode DeadLoadsDestroy(DeadLoads *loads)
{
  PetscFunctionBegin;
  if (!loads->force) PetscFunctionReturn(0);
  for (PetscInt r = 0; r < loads->scene->nramps; ++r) PetscCall(VecDestroy(&loads->force[r]));
  PetscCall(PetscFree(loads->force));
  PetscFunctionReturn(0);
}
