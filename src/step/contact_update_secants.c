/*
   Where the gap is linearized next. Linearized at x it leads to the solution G(x); where x = G(x) it is true. To go
   on at G(x) each time leaves out what the gap's second derivatives do to the forces: soft motions then come to rest
   slowly, or go in a circle. Secants of the last ways f = G(x) - x foresee it: the next x is that combination of the
   last solutions whose ways make up the shortest one (D. G. Anderson, J. ACM 12 (1965)). Where the gap gets no truer
   nonetheless, as between faces with kinks, x goes there by half.
*/
#include "stepimpl.h"

#define SECANTS_PROGRESS \
  0.9 /* of the least change of the gap so far, which a solution must come below to count as progress */
#define SECANTS_PATIENCE \
  2 /* solutions in a row without progress, after which the next linearization is made short of where it would be */
#define SECANTS_SHORT     0.5  /* of the way there */
#define SECANTS_DEPENDENT 1e-2 /* part of a secant off the newer ones, below which it says nothing of its own */

/* Whether this is the last of so many solutions without progress */
static PetscBool SecantsStall(ContactUpdateSecants *s, PetscReal change)
{
  if (s->n == 0 || change < SECANTS_PROGRESS * s->least) {
    s->least  = change;
    s->stalls = 0;
  } else ++s->stalls;
  return (PetscBool)(s->stalls >= SECANTS_PATIENCE);
}

/* The secant from the last solution to u becomes the newest one, in the place of the oldest */
static PetscErrorCode SecantsRecord(ContactUpdateSecants *s, Vec u, Vec way)
{
  Vec *swap[2] = {s->ways, s->solutions}, now[2] = {way, u}, before[2] = {s->way, s->u};

  PetscFunctionBegin;
  for (PetscInt k = 0; k < 2; ++k) {
    Vec newest = swap[k][GAP_SECANTS - 1];

    for (PetscInt i = GAP_SECANTS - 1; i > 0; --i) swap[k][i] = swap[k][i - 1];
    if (!newest) PetscCall(VecDuplicate(u, &newest));
    swap[k][0] = newest;
    PetscCall(VecWAXPY(newest, -1.0, before[k], now[k]));
  }
  PetscFunctionReturn(0);
}

/* Takes off the way f what the secants have of it, and off x what solutions change along them */
static PetscErrorCode SecantsApply(const ContactUpdateSecants *s, Vec f, Vec x)
{
  Vec         way[GAP_SECANTS], solution[GAP_SECANTS];
  PetscScalar product;
  PetscReal   whole, own;
  PetscInt    n = 0;

  PetscFunctionBegin;
  for (PetscInt i = 0; i < GAP_SECANTS && s->ways[i]; ++i) {
    PetscCall(VecDuplicate(x, &way[n]));
    PetscCall(VecDuplicate(x, &solution[n]));
    PetscCall(VecCopy(s->ways[i], way[n]));
    PetscCall(VecCopy(s->solutions[i], solution[n]));
    PetscCall(VecNorm(way[n], NORM_2, &whole));
    for (PetscInt k = 0; k < n; ++k) {
      PetscCall(VecDot(way[n], way[k], &product));
      PetscCall(VecAXPY(way[n], -product, way[k]));
      PetscCall(VecAXPY(solution[n], -product, solution[k]));
    }
    PetscCall(VecNorm(way[n], NORM_2, &own));
    if (own > SECANTS_DEPENDENT * whole) {
      PetscCall(VecScale(way[n], 1.0 / own));
      PetscCall(VecScale(solution[n], 1.0 / own));
      PetscCall(VecDot(f, way[n], &product));
      PetscCall(VecAXPY(x, -product, solution[n]));
      ++n;
    } else {
      PetscCall(VecDestroy(&way[n]));
      PetscCall(VecDestroy(&solution[n]));
    }
  }
  for (PetscInt k = 0; k < n; ++k) {
    PetscCall(VecDestroy(&way[k]));
    PetscCall(VecDestroy(&solution[k]));
  }
  PetscFunctionReturn(0);
}

/* Moves the point of linearization on from where it led to u, whose true gap is off the linearized one by change;
   damped: it is made short of where it would be */
PetscErrorCode ContactUpdateSecantsAdvance(ContactUpdateSecants *s, PetscReal change, Vec u, Vec u_linearized,
  PetscBool *damped)
{
  Vec way, next;

  PetscFunctionBegin;
  *damped = SecantsStall(s, change);
  PetscCall(VecDuplicate(u, &way));
  PetscCall(VecDuplicate(u, &next));
  PetscCall(VecWAXPY(way, -1.0, u_linearized, u));
  PetscCall(VecCopy(u, next));
  if (s->n > 0) PetscCall(SecantsRecord(s, u, way));
  PetscCall(SecantsApply(s, way, next));
  PetscCall(VecAXPBY(u_linearized, *damped ? SECANTS_SHORT : 1.0, *damped ? 1.0 - SECANTS_SHORT : 0.0, next));
  PetscCall(VecDestroy(&next));
  PetscCall(VecDestroy(&s->way));
  if (!s->u) PetscCall(VecDuplicate(u, &s->u));
  PetscCall(VecCopy(u, s->u));
  s->way = way;
  ++s->n;
  PetscFunctionReturn(0);
}

PetscErrorCode ContactUpdateSecantsDestroy(ContactUpdateSecants *s)
{
  PetscFunctionBegin;
  for (PetscInt i = 0; i < GAP_SECANTS; ++i) {
    PetscCall(VecDestroy(&s->ways[i]));
    PetscCall(VecDestroy(&s->solutions[i]));
  }
  PetscCall(VecDestroy(&s->way));
  PetscCall(VecDestroy(&s->u));
  PetscFunctionReturn(0);
}
