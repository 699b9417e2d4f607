/*
   Motion of bodies in dynamics as long as nothing touches them: with their initial velocity and spin, and with the
   acceleration by body forces and by forces on their faces. Directions in which a displacement of the body is
   prescribed have no acceleration.
*/
#include "detectimpl.h"
#include <string.h>

#define FALL_POINTS 16 /* points of time at which a force is integrated */

/* Returns the body whose displacement is prescribed, or PETSC_DECIDE if there is none */
PetscInt DetectFindBody(Scene scene, const char face[])
{
  for (PetscInt b = 0; b < scene->nbodies; ++b) {
    const size_t length = strlen(scene->bodies[b].name);

    if (!strncmp(scene->bodies[b].name, face, length) && face[length] == '.') return b;
  }
  return PETSC_DECIDE;
}

/* Computes the shift that a force with a factor of 1 and a mass of 1 has caused until this time [time^2]: the integral
   of (time - s) factor(s) over s. time: in load steps */
static PetscErrorCode FallIntegrate(Scene scene, PetscInt ramp, PetscReal time, PetscReal *shift)
{
  const PetscReal step = time * SceneTimeStep(scene) / FALL_POINTS;

  PetscFunctionBegin;
  *shift = 0.0;
  for (PetscInt k = 0; k < FALL_POINTS; ++k) {
    const PetscReal left = FALL_POINTS - k - 0.5;
    PetscReal       factor;

    PetscCall(SceneGetFactor(scene, ramp, (k + 0.5) / FALL_POINTS * time, &factor));
    *shift += left * step * step * factor;
  }
  PetscFunctionReturn(0);
}

/* Adds the shift by a force on a body. mass: what `force` is divided by */
static void FallAdd(const PetscReal force[3], PetscReal mass, PetscReal shift, DetectMove *move)
{
  for (PetscInt c = 0; c < 3 && mass > 0.0; ++c) move->shift[c] += force[c] / mass * shift;
}

/* Sets to 0 the accelerated motion in directions in which a displacement is prescribed */
static void FallHold(Scene scene, DetectMove moves[])
{
  for (PetscInt i = 0; i < scene->ndisplacements; ++i) {
    const SceneDisplacement *d = &scene->displacements[i];
    const PetscInt           b = d->at == DISPLACEMENT_FACE ? DetectFindBody(scene, d->face) : d->body;

    for (PetscInt c = 0; c < 3 && b >= 0; ++c) {
      if (d->inclined || (d->fixed[c] && !d->released[c])) moves[b].shift[c] = 0.0;
    }
  }
}

/* Shortens the shift to the size of the whole model: nothing is beyond it */
static void FallLimit(PetscReal largest, DetectMove *move)
{
  const PetscReal length = VectorNorm(move->shift);

  for (PetscInt c = 0; c < 3 && length > largest; ++c) move->shift[c] *= largest / length;
}

/* Computes the motions of all bodies at one time [load steps] if nothing is prescribed and nothing touches them */
PetscErrorCode DetectFall(const DetectModel *model, Scene scene, PetscReal time, DetectMove moves[])
{
  const PetscReal elapsed = time * SceneTimeStep(scene);

  PetscFunctionBegin;
  PetscCall(PetscArrayzero(moves, scene->nbodies));
  if (!SceneIsDynamic(scene)) PetscFunctionReturn(0);
  for (PetscInt i = 0; i < scene->nforces; ++i) {
    const SceneBodyForce *f = &scene->forces[i];
    PetscReal             shift;

    PetscCall(FallIntegrate(scene, f->ramp, time, &shift));
    for (PetscInt b = 0; b < scene->nbodies; ++b) {
      if ((f->body == b || f->body == PETSC_DECIDE) && !SceneBodyIsSurface(&scene->bodies[b]))
        FallAdd(f->value, scene->bodies[b].material.density, shift, &moves[b]);
    }
  }
  for (PetscInt i = 0; i < scene->ntractions; ++i) {
    const SceneTraction *t = &scene->tractions[i];
    const PetscInt       b = t->body >= 0 ? t->body : DetectFindBody(scene, t->face);
    PetscReal            shift;

    if (!t->resultant || b < 0) continue;
    PetscCall(FallIntegrate(scene, t->ramp, time, &shift));
    FallAdd(t->value, model->mass[b], shift, &moves[b]);
  }
  FallHold(scene, moves);
  for (PetscInt b = 0; b < scene->nbodies; ++b) {
    DetectMove *move = &moves[b];

    for (PetscInt c = 0; c < 3; ++c) {
      move->shift[c] += elapsed * scene->bodies[b].velocity[c];
      move->rotation[c] = elapsed * scene->bodies[b].spin[c];
      move->center[c]   = 0.5 * (model->box[6 * b + c] + model->box[6 * b + 3 + c]);
    }
    FallLimit(model->size, move);
    move->moves = move->falls = (PetscBool)(VectorNorm(move->shift) > 0.0 || VectorNorm(move->rotation) > 0.0);
  }
  PetscFunctionReturn(0);
}
