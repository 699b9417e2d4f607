/* dynamics: time steps, and the properties of bodies that time steps require. */
#include "sectionsimpl.h"

#define DynamicsRequire(condition, keys, ...) \
  do { \
    if (!(condition)) PetscCall(SceneKeysError(keys, __VA_ARGS__)); \
  } while (0)

/* Checks the values, and that the number of time steps is not too large. */
static PetscErrorCode DynamicsCheck(SceneKeys keys, const SceneDynamics *d)
{
  PetscFunctionBegin;
  DynamicsRequire(d->time_step > 0.0, keys, "dynamics", "time_step", "is %g, which must be above 0",
    (double)d->time_step);
  DynamicsRequire(d->end_time >= d->time_step, keys, "dynamics", "end_time",
    "is %g, which must be at least time_step, %g", (double)d->end_time, (double)d->time_step);
  DynamicsRequire(d->end_time <= (PetscReal)SCENE_MAX_STEPS * d->time_step, keys, "dynamics", "time_step",
    "is %g, which makes more than %d steps up to end_time, %g", (double)d->time_step, SCENE_MAX_STEPS,
    (double)d->end_time);
  DynamicsRequire(d->tolerance >= 0.0 && d->tolerance < 1.0, keys, "dynamics", "tolerance",
    "is %g, which must be above 0 and below 1", (double)d->tolerance);
  DynamicsRequire(d->spectral_radius >= 0.0 && d->spectral_radius <= 1.0, keys, "dynamics", "spectral_radius",
    "is %g, which must lie between 0 and 1", (double)d->spectral_radius);
  DynamicsRequire(d->damping_mass >= 0.0, keys, "dynamics", "damping_mass", "is %g, which must not be negative",
    (double)d->damping_mass);
  DynamicsRequire(d->damping_stiffness >= 0.0, keys, "dynamics", "damping_stiffness",
    "is %g, which must not be negative", (double)d->damping_stiffness);
  PetscFunctionReturn(0);
}

/* Reads the keys of dynamics and sets time steps of equal size, which are not larger than the given time_step. */
PetscErrorCode SceneReadDynamics(SceneKeys keys, Scene scene, const SceneList *list)
{
  SceneDynamics *d   = &scene->dynamics;
  PetscBool      any = PETSC_FALSE, has;

  PetscFunctionBegin;
  for (const SceneKey *row = list->rows; row->name && !any; ++row) {
    PetscCall(SceneHasKey(keys, list->name, row->name, &has));
    any = has;
  }
  if (!any) PetscFunctionReturn(0);
  *d = *(const SceneDynamics *)list->initial;
  PetscCall(SceneReadRows(keys, scene, list->name, list->rows, NULL, d));
  PetscCall(DynamicsCheck(keys, d));
  PetscCall(SceneHasKey(keys, list->name, "spectral_radius", &has));
  DynamicsRequire(!has || d->scheme == SCHEME_GENERALIZED_ALPHA, keys, list->name, "spectral_radius",
    "is only for scheme: generalized_alpha");
  if (keys->error[0])
    d->time_step = d->end_time = 1.0; /* the values are valid, but nothing is simulated after an
                                                           error */
  scene->nsteps = PetscMax(1, (PetscInt)PetscCeilReal(d->end_time / d->time_step * (1.0 - PETSC_SQRT_MACHINE_EPSILON)));
  d->time_step  = d->end_time / (PetscReal)scene->nsteps;
  PetscFunctionReturn(0);
}

PetscErrorCode SceneFinishInertia(SceneKeys keys, Scene scene, const char owner[], const SceneBody *body)
{
  const PetscReal *v = body->velocity, *w = body->spin;

  PetscFunctionBegin;
  DynamicsRequire(body->material.density >= 0.0, keys, owner, NULL, "has density %g, which must be above 0",
    (double)body->material.density);
  if (SceneIsDynamic(scene)) {
    DynamicsRequire(body->material.density > 0.0 || body->material.type == MATERIAL_RIGID, keys, owner, NULL,
      "has no density, which dynamics needs: the key density is missing, or 0");
  } else {
    DynamicsRequire(!(v[0] || v[1] || v[2] || w[0] || w[1] || w[2]), keys, owner, NULL,
      "has an initial velocity, and the scene has no dynamics: add dynamics: {time_step: ..., end_time: ...}");
  }
  PetscFunctionReturn(0);
}
