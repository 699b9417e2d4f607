/* Chooses the times of the load program at which the bodies are tested */
#include "detectimpl.h"

#define TIMES_PER_SIZE 8 /* number of times while the fastest corner moves by the size of the smallest body */
#define TIMES_FINE     8 /* states in which the motion is measured, relative to DETECT_STATES */

/* Computes where the corners of the bodies' boxes are at a time of the load program. *extent: the largest of their
   distances from the undeformed state, if it is larger than before [length] */
static PetscErrorCode TimesMoveBoxes(const DetectModel *model, Scene scene, PetscReal time, PetscReal corner[],
  PetscReal *extent)
{
  DetectMove *moves;

  PetscFunctionBegin;
  PetscCall(PetscMalloc1(scene->nbodies, &moves));
  PetscCall(DetectMoves(model, scene, time, moves));
  for (PetscInt i = 0; i < 8 * scene->nbodies; ++i) {
    const PetscReal *box = &model->box[6 * (i / 8)];
    PetscReal        x[3], *y = &corner[3 * i], way[3];

    for (PetscInt c = 0; c < 3; ++c) x[c] = box[c + (i >> c & 1 ? 3 : 0)];
    DetectMovePoints(&moves[i / 8], 1, x, y);
    for (PetscInt c = 0; c < 3; ++c) way[c] = y[c] - x[c];
    if (moves[i / 8].moves) *extent = PetscMax(*extent, VectorNorm(way));
  }
  PetscCall(PetscFree(moves));
  PetscFunctionReturn(0);
}

/* Returns the largest distance between corners in two states [length] */
static PetscReal TimesStep(PetscInt n, const PetscReal before[], const PetscReal after[])
{
  PetscReal most = 0.0;

  for (PetscInt i = 0; i < n; ++i) {
    const PetscReal way[3] = {after[3 * i] - before[3 * i], after[3 * i + 1] - before[3 * i + 1],
      after[3 * i + 2] - before[3 * i + 2]};

    most = PetscMax(most, VectorNorm(way));
  }
  return most;
}

/* Returns the diagonal of the smallest body [length] */
static PetscReal TimesSmallestBody(const DetectModel *model, PetscInt nbodies)
{
  PetscReal size = PETSC_MAX_REAL;

  for (PetscInt b = 0; b < nbodies; ++b) {
    PetscReal diagonal[3];

    for (PetscInt c = 0; c < 3; ++c) diagonal[c] = model->box[6 * b + 3 + c] - model->box[6 * b + c];
    size = PetscMin(size, VectorNorm(diagonal));
  }
  return size;
}

/* Chooses the times to test, between which the bodies move by equal distances, and the largest motion of a corner of
   the bodies' boxes [length]. The number of times grows with that distance relative to the smallest body. */
PetscErrorCode DetectChooseTimes(const DetectModel *model, Scene scene, PetscReal *extent, PetscInt *nstates,
  PetscReal time[DETECT_STATES])
{
  const PetscInt n = TIMES_FINE * DETECT_STATES, ncorners = 8 * scene->nbodies;
  PetscReal     *corner[2], *path;
  PetscInt       k = 0;

  PetscFunctionBegin;
  *extent = 0.0;
  PetscCall(PetscMalloc3(3 * ncorners, &corner[0], 3 * ncorners, &corner[1], n + 1, &path));
  path[0] = 0.0;
  for (PetscInt i = 0; i <= n; ++i) {
    PetscReal *now = corner[i % 2];

    PetscCall(TimesMoveBoxes(model, scene, (PetscReal)(i * scene->nsteps) / n, now, extent));
    if (i) path[i] = path[i - 1] + TimesStep(ncorners, corner[1 - i % 2], now);
  }
  *nstates = 0;
  if (*extent > 0.0) {
    const PetscReal wanted = 1.0 + TIMES_PER_SIZE * path[n] / TimesSmallestBody(model, scene->nbodies);

    *nstates = PetscMax(2, (PetscInt)PetscMin((PetscReal)DETECT_STATES, wanted));
  }
  for (PetscInt s = 0; s < *nstates; ++s) {
    const PetscReal at = path[n] * (s + 1) / *nstates;

    while (k < n && path[k] < at * (1.0 - 1e-9)) ++k;
    time[s] = (PetscReal)(k * scene->nsteps) / n;
  }
  PetscCall(PetscFree3(corner[0], corner[1], path));
  PetscFunctionReturn(0);
}
