/*
   Positions of the bodies under prescribed motions. A body moves with its faces: along each axis by the largest of
   their displacements, and by the first of their rotations. In dynamics, bodies start with their initial velocity, and
   a larger prescribed displacement replaces the motion at that velocity.
*/
#include "detectimpl.h"
#include <string.h>

/* Returns the body whose displacement is prescribed, or PETSC_DECIDE if there is none */
static PetscInt MoveFindBody(Scene scene, const SceneDisplacement *d)
{
  if (d->at != DISPLACEMENT_FACE) return d->body;
  for (PetscInt b = 0; b < scene->nbodies; ++b) {
    const size_t length = strlen(scene->bodies[b].name);

    if (!strncmp(scene->bodies[b].name, d->face, length) && d->face[length] == '.') return b;
  }
  return PETSC_DECIDE;
}

PetscErrorCode DetectMoves(Scene scene, PetscReal time, DetectMove moves[])
{
  PetscFunctionBegin;
  PetscCall(PetscArrayzero(moves, scene->nbodies));
  for (PetscInt b = 0; b < scene->nbodies && SceneIsDynamic(scene); ++b) {
    for (PetscInt c = 0; c < 3; ++c) moves[b].shift[c] = time * SceneTimeStep(scene) * scene->bodies[b].velocity[c];
    moves[b].moves = (PetscBool)(VectorNorm(moves[b].shift) > 0.0);
  }
  for (PetscInt i = 0; i < scene->ndisplacements; ++i) {
    const SceneDisplacement *d     = &scene->displacements[i];
    const PetscInt           b     = MoveFindBody(scene, d);
    const PetscBool          turns = (PetscBool)(VectorNorm(d->rotation) > 0.0);
    PetscReal                factor;

    if (b < 0) continue;
    PetscCall(SceneGetFactor(scene, d->ramp, time, &factor));
    for (PetscInt c = 0; c < 3; ++c) {
      const PetscReal shift = factor * d->value[c];

      if (PetscAbsReal(shift) > PetscAbsReal(moves[b].shift[c])) moves[b].shift[c] = shift;
    }
    if (turns && VectorNorm(moves[b].rotation) == 0.0) {
      for (PetscInt c = 0; c < 3; ++c) {
        moves[b].rotation[c] = factor * d->rotation[c] * PETSC_PI / 180.0;
        moves[b].center[c]   = d->center[c];
      }
    }
    moves[b].moves = (PetscBool)(VectorNorm(moves[b].shift) > 0.0 || VectorNorm(moves[b].rotation) > 0.0);
  }
  PetscFunctionReturn(0);
}

/* Rotates and shifts n points */
void DetectMovePoints(const DetectMove *move, PetscInt n, const PetscReal from[], PetscReal to[])
{
  PetscReal turn[3][3];

  MatrixSetTurn(move->rotation, turn);
  for (PetscInt i = 0; i < n; ++i) {
    PetscReal r[3];

    for (PetscInt k = 0; k < 3; ++k) r[k] = from[3 * i + k] - move->center[k];
    for (PetscInt k = 0; k < 3; ++k) to[3 * i + k] = from[3 * i + k] + move->shift[k] + VectorDot(turn[k], r);
  }
}
