/* Updates of the gap that go in a circle: the next linearization is made short of the last solution. */
#include "stepimpl.h"

#define DAMPING_PROGRESS 0.9   /* of the least change of the gap so far, which a solution must come below to count as progress */
#define DAMPING_PATIENCE 2     /* solutions in a row without progress, after which the updates are damped */
#define DAMPING_FIRST    0.5   /* of the way from the last linearization to its solution */
#define DAMPING_LEAST    0.125 /* the same, whatever the solutions say */

/* Whether the solution that changed the gap so much is the first or another without progress that calls for damping */
static PetscBool DampingIsDue(GapDamping *d, PetscReal change)
{
  if (d->n == 0 || change < DAMPING_PROGRESS * d->least) {
    d->least  = change;
    d->stalls = 0;
  } else ++d->stalls;
  ++d->n;
  return (PetscBool)(d->factor < 1.0 || d->stalls >= DAMPING_PATIENCE);
}

/* Aitken's factor, from how the way changed since the last one */
static PetscErrorCode DampingFactor(GapDamping *d, Vec way)
{
  Vec         difference;
  PetscScalar product;
  PetscReal   size;

  PetscFunctionBegin;
  if (!d->way) {
    PetscCall(VecDuplicate(way, &d->way));
    d->factor = DAMPING_FIRST;
  } else {
    PetscCall(VecDuplicate(way, &difference));
    PetscCall(VecWAXPY(difference, -1.0, d->way, way));
    PetscCall(VecNorm(difference, NORM_2, &size));
    PetscCall(VecDot(d->way, difference, &product));
    PetscCall(VecDestroy(&difference));
    if (size > 0.0) d->factor = PetscClipInterval(-d->factor * PetscRealPart(product) / PetscSqr(size), DAMPING_LEAST, DAMPING_FIRST);
  }
  PetscCall(VecCopy(way, d->way));
  PetscFunctionReturn(0);
}

/* Moves the point of linearization to the next one: u, or a part of the way to it; change: of the gap, at u */
PetscErrorCode GapDampingAdvance(GapDamping *d, PetscReal change, Vec u, Vec u_linearized, PetscBool *damped)
{
  Vec way;

  PetscFunctionBegin;
  *damped = DampingIsDue(d, change);
  if (*damped) {
    PetscCall(VecDuplicate(u, &way));
    PetscCall(VecWAXPY(way, -1.0, u_linearized, u));
    PetscCall(DampingFactor(d, way));
    PetscCall(VecAXPY(u_linearized, d->factor, way));
    PetscCall(VecDestroy(&way));
  } else PetscCall(VecCopy(u, u_linearized));
  PetscFunctionReturn(0);
}

PetscErrorCode GapDampingDestroy(GapDamping *d)
{
  PetscFunctionBegin;
  PetscCall(VecDestroy(&d->way));
  PetscFunctionReturn(0);
}
