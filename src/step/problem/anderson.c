/*
   Anderson acceleration of a fixed-point iteration x <- G(x), for contact updates, follower loads and mean internal
   forces (D. G. Anderson, J. ACM 12 (1965)). In contact updates G(x) is the solution of the problem with the gap
   linearized at x; the gap agrees at a fixed point. The simple iteration omits the second derivatives of the gap, so
   that soft motions converge slowly or cycle. The next x is the combination of the last solutions with the smallest
   combined residual f = G(x) - x. If the change of the gap stops decreasing, as between faces with kinks, only half the
   step to the new x is done.
*/
#include "problemimpl.h"

#define ANDERSON_PROGRESS \
  0.9 /* a solution makes progress if its gap change is below this multiple of the smallest one so far */
#define ANDERSON_PATIENCE 2   /* solutions in a row without progress, after which steps are damped */
#define ANDERSON_SHORT    0.5 /* damping factor of the step to the next x */
#define ANDERSON_DEPENDENT \
  1e-2 /* a secant is dropped if its part orthogonal to the newer secants is smaller than
                                  this fraction of it */

/*
   Returns whether ANDERSON_PATIENCE consecutive solutions, including the present one, made no progress. change: change
   of the gap of the present solution [length].
*/
static PetscBool AndersonStall(Anderson *s, PetscReal change)
{
  if (s->n == 0) s->first = change;
  if (s->n == 0 || change < ANDERSON_PROGRESS * s->least) {
    s->least  = change;
    s->stalls = 0;
  } else ++s->stalls;
  return (PetscBool)(s->stalls >= ANDERSON_PATIENCE);
}

/*
   Stores the differences of the solution u and of the residual from the previous ones. They replace the oldest pair of
   differences.
*/
static PetscErrorCode AndersonRecord(Anderson *s, Vec u, Vec residual)
{
  Vec *swap[2] = {s->residuals, s->solutions}, now[2] = {residual, u}, before[2] = {s->residual, s->u};

  PetscFunctionBegin;
  for (PetscInt k = 0; k < 2; ++k) {
    Vec newest = swap[k][ANDERSON_DEPTH - 1];

    for (PetscInt i = ANDERSON_DEPTH - 1; i > 0; --i) swap[k][i] = swap[k][i - 1];
    if (!newest) PetscCall(VecDuplicate(u, &newest));
    swap[k][0] = newest;
    PetscCall(VecWAXPY(newest, -1.0, before[k], now[k]));
  }
  PetscFunctionReturn(0);
}

/*
   Applies the Anderson update: removes from the residual f its components along the stored residual differences, and
   applies the corresponding changes of the solution to x. The differences are orthonormalized first, beginning with the
   newest.
*/
static PetscErrorCode AndersonApply(const Anderson *s, Vec f, Vec x)
{
  Vec         residual[ANDERSON_DEPTH], solution[ANDERSON_DEPTH];
  PetscScalar product;
  PetscReal   whole, own;
  PetscInt    n = 0;

  PetscFunctionBegin;
  for (PetscInt i = 0; i < ANDERSON_DEPTH && s->residuals[i]; ++i) {
    PetscCall(VecDuplicate(x, &residual[n]));
    PetscCall(VecDuplicate(x, &solution[n]));
    PetscCall(VecCopy(s->residuals[i], residual[n]));
    PetscCall(VecCopy(s->solutions[i], solution[n]));
    PetscCall(VecNorm(residual[n], NORM_2, &whole));
    for (PetscInt k = 0; k < n; ++k) {
      PetscCall(VecDot(residual[n], residual[k], &product));
      PetscCall(VecAXPY(residual[n], -product, residual[k]));
      PetscCall(VecAXPY(solution[n], -product, solution[k]));
    }
    PetscCall(VecNorm(residual[n], NORM_2, &own));
    if (own > ANDERSON_DEPENDENT * whole) {
      PetscCall(VecScale(residual[n], 1.0 / own));
      PetscCall(VecScale(solution[n], 1.0 / own));
      PetscCall(VecDot(f, residual[n], &product));
      PetscCall(VecAXPY(x, -product, solution[n]));
      ++n;
    } else {
      PetscCall(VecDestroy(&residual[n]));
      PetscCall(VecDestroy(&solution[n]));
    }
  }
  for (PetscInt k = 0; k < n; ++k) {
    PetscCall(VecDestroy(&residual[k]));
    PetscCall(VecDestroy(&solution[k]));
  }
  PetscFunctionReturn(0);
}

/*
   Moves u_linearized to the next point of linearization. u: solution found with u_linearized; change: measure of its
   residual, for contact the change of the gap [length]; *damped: true if only half of the step was taken.
*/
PetscErrorCode AndersonAdvance(Anderson *s, PetscReal change, Vec u, Vec u_linearized, PetscBool *damped)
{
  Vec residual, next;

  PetscFunctionBegin;
  *damped = AndersonStall(s, change);
  PetscCall(VecDuplicate(u, &residual));
  PetscCall(VecDuplicate(u, &next));
  PetscCall(VecWAXPY(residual, -1.0, u_linearized, u));
  PetscCall(VecCopy(u, next));
  if (s->n > 0) PetscCall(AndersonRecord(s, u, residual));
  PetscCall(AndersonApply(s, residual, next));
  PetscCall(VecAXPBY(u_linearized, *damped ? ANDERSON_SHORT : 1.0, *damped ? 1.0 - ANDERSON_SHORT : 0.0, next));
  PetscCall(VecDestroy(&next));
  PetscCall(VecDestroy(&s->residual));
  if (!s->u) PetscCall(VecDuplicate(u, &s->u));
  PetscCall(VecCopy(u, s->u));
  s->residual = residual;
  ++s->n;
  PetscFunctionReturn(0);
}

PetscErrorCode AndersonDestroy(Anderson *s)
{
  PetscFunctionBegin;
  for (PetscInt i = 0; i < ANDERSON_DEPTH; ++i) {
    PetscCall(VecDestroy(&s->residuals[i]));
    PetscCall(VecDestroy(&s->solutions[i]));
  }
  PetscCall(VecDestroy(&s->residual));
  PetscCall(VecDestroy(&s->u));
  PetscFunctionReturn(0);
}
