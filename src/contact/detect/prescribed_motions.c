/*
   Positions of the bodies under prescribed motions. A body moves with its faces: along each axis by the largest of
   their displacements, and by the first of their rotations. In dynamics a larger prescribed motion replaces that of the
   body in free flight.
*/
#include "detectimpl.h"

PetscErrorCode DetectMoves(const DetectModel *model, Scene scene, PetscReal time, DetectMove moves[])
{
  PetscFunctionBegin;
  PetscCall(DetectFall(model, scene, time, moves));
  for (PetscInt i = 0; i < scene->ndisplacements; ++i) {
    const SceneDisplacement *d     = &scene->displacements[i];
    const PetscInt           b     = d->at == DISPLACEMENT_FACE ? DetectFindBody(scene, d->face) : d->body;
    const PetscBool          turns = (PetscBool)(VectorNorm(d->rotation) > 0.0);
    PetscReal                factor;

    if (b < 0) continue;
    PetscCall(SceneGetFactor(scene, d->ramp, time, &factor));
    for (PetscInt c = 0; c < 3; ++c) {
      const PetscReal shift = factor * d->value[c];

      if (PetscAbsReal(shift) > PetscAbsReal(moves[b].shift[c])) moves[b].shift[c] = shift;
    }
    if (turns && (moves[b].falls || VectorNorm(moves[b].rotation) == 0.0)) {
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
