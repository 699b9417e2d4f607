/*
   Solves the laws of laws.c by Newton's method (set.c), or by exchanges (pivot.c) and Newton's method. Contacts that
   stick are solved by stick.c unless Newton's method keeps all of them closed. If that fails, the coefficients of
   friction are first limited to a small value, for which the path of smoothed laws (path.c) is reliable. The limit is
   then raised in steps that Newton's method can follow, up to the given values. If that fails as well, the convex
   problem with fixed bounds is solved (convex.c).
*/
#include "frictionimpl.h"

/* Copies forces, motions and y to `begin`, or from there if `back` */
static PetscErrorCode ContinuationCopy(IPTermSet *set, const IPReducedSystem *s, PetscReal begin[], PetscBool back)
{
  PetscReal *const a[3] = {s->lambda, s->gap, s->y}, *const b[3] = {begin, begin + s->m, begin + 2 * s->m};
  const PetscInt n[3] = {s->m, s->m, s->k};

  PetscFunctionBegin;
  for (PetscInt i = 0; i < 3; i++) PetscCall(PetscArraycpy(back ? a[i] : b[i], back ? b[i] : a[i], n[i]));
  if (back) PetscCall(IPTermLawsMove(set, s));
  PetscFunctionReturn(0);
}

static void ContinuationLimit(IPTermSet *set, const PetscReal given[], PetscReal most)
{
  for (PetscInt i = 0; i < set->n; i++) set->coefficient[i] = PetscMin(given[i], most);
}

/*
   Solves the problem with the coefficients limited to `most`: follows the path of smoothed laws, then iterates by
   Newton's method
*/
static PetscErrorCode ContinuationBegin(IPTermSet *set, const IPReducedSystem *s, const PetscReal given[],
  PetscReal most, PetscReal first, PetscInt *steps, PetscBool *solved)
{
  const PetscInt limit = 100;

  PetscFunctionBegin;
  ContinuationLimit(set, given, most);
  PetscCall(IPTermPathFollow(set, s, steps, solved));
  if (*solved) PetscCall(IPTermSetIterate(set, s, limit, first, steps, solved));
  PetscFunctionReturn(0);
}

/*
   Raises the limit of the coefficients from `most` to `largest`, by a factor that is smaller after a failure and larger
   after a success
*/
static PetscErrorCode ContinuationRaise(IPTermSet *set, const IPReducedSystem *s, const PetscReal given[],
  PetscReal most, PetscReal largest, PetscReal first, PetscInt *steps, PetscBool *solved)
{
  const PetscInt  limit = 60;
  const PetscReal least = 1.2, fastest = 4.0;
  PetscReal       factor = 2.0, *before;

  PetscFunctionBegin;
  PetscCall(PetscMalloc1(2 * s->m + s->k, &before));
  while (most < largest && factor >= least) {
    PetscCall(ContinuationCopy(set, s, before, PETSC_FALSE));
    ContinuationLimit(set, given, PetscMin(factor * most, largest));
    PetscCall(IPTermSetIterate(set, s, limit, first, steps, solved));
    if (*solved) {
      most   = PetscMin(factor * most, largest);
      factor = PetscMin(1.5 * factor, fastest);
    } else {
      factor = PetscSqrtReal(factor);
      PetscCall(ContinuationCopy(set, s, before, PETSC_TRUE));
      for (PetscInt i = 0; i < set->m; i++) set->closed[i] = (PetscBool)(s->lambda[i] > 0.0);
      PetscCall(IPTermLawsRenew(set, s));
    }
  }
  PetscCall(PetscFree(before));
  PetscFunctionReturn(0);
}

/*
   Solves by continuation from a small limit of the coefficients or, if such small friction cannot hold a body, from a
   larger one
*/
static PetscErrorCode ContinuationSolve(IPTermSet *set, const IPReducedSystem *s, PetscReal first, PetscInt *steps,
  PetscBool *solved)
{
  const PetscReal begin[] = {0.3, 2.0};
  PetscReal       largest = 0.0, *given;
  PetscInt        k       = 0;

  PetscFunctionBegin;
  PetscCall(PetscMalloc1(set->n, &given));
  PetscCall(PetscArraycpy(given, set->coefficient, set->n));
  for (PetscInt i = 0; i < set->n; i++) largest = PetscMax(largest, given[i]);
  PetscCall(ContinuationBegin(set, s, given, begin[k], first, steps, solved));
  if (!*solved && begin[k] < largest) PetscCall(ContinuationBegin(set, s, given, begin[++k], first, steps, solved));
  if (*solved) PetscCall(ContinuationRaise(set, s, given, begin[k], largest, first, steps, solved));
  PetscCall(PetscArraycpy(set->coefficient, given, set->n));
  PetscCall(PetscFree(given));
  PetscFunctionReturn(0);
}

/*
   Computes the motions s->gap of all rows for the initial forces s->lambda. If a motion is more than ten times
   set->length, all forces are set to zero, since an initial guess of forces can be far too large for bodies that bend
   easily.
*/
static PetscErrorCode ContinuationStart(IPTermSet *set, const IPReducedSystem *s)
{
  const PetscReal much    = 10.0;
  PetscReal       largest = 0.0;

  PetscFunctionBegin;
  IPTermLawsResist(set);
  if (set->listed) PetscCall(IPTermLawsMove(set, s));
  else PetscCall(IPTermLawsRenew(set, s));
  for (PetscInt r = 0; r < s->m; r++) largest = PetscMax(largest, PetscAbsReal(s->gap[r]));
  if (largest <= much * set->length) PetscFunctionReturn(0);
  PetscCall(PetscArrayzero(s->lambda, s->m));
  if (s->spring) PetscCall(PetscArraycpy(s->gap, s->start, s->m));
  PetscCall(IPTermLawsMove(set, s));
  PetscFunctionReturn(0);
}

/*
   Solves by Newton's method from the start, with compliances that are computed from C instead of estimated. held: each
   row's compliance is that with all other rows held, which suits rows that stick. begin: forces, motions and y at the
   start.
*/
static PetscErrorCode ContinuationMeasured(IPTermSet *set, const IPReducedSystem *s, PetscBool held, PetscReal begin[],
  PetscReal *first, PetscInt *steps, PetscBool *solved)
{
  const PetscInt limit = 60;
  PetscBool      measured;

  PetscFunctionBegin;
  PetscCall(IPTermDenseMeasure(&set->system, held, &measured));
  if (!measured) PetscFunctionReturn(0);
  IPTermLawsResist(set);
  PetscCall(ContinuationCopy(set, s, begin, PETSC_TRUE));
  PetscCall(IPTermSetOff(set, s, first));
  PetscCall(IPTermSetIterate(set, s, limit, *first, steps, solved));
  PetscFunctionReturn(0);
}

/*
   Solves by pivoting, and by Newton's method from its end. The frames of terms that slip are those of the last end, so
   that the laws of their components approach the law of the term.
*/
static PetscErrorCode ContinuationPivot(IPTermSet *set, const IPReducedSystem *s, PetscReal first, PetscInt *steps,
  PetscBool *solved)
{
  const PetscInt limit = 30, tries = 4;
  PetscBool      found = PETSC_FALSE, open = PETSC_FALSE;

  PetscFunctionBegin;
  for (PetscInt k = 0; k < tries && !*solved; k++) {
    PetscCall(IPTermPivotFollow(set, s, open, steps, &found));
    if (!found && open) break;
    open = (PetscBool)!found;
    if (found) PetscCall(IPTermSetIterate(set, s, limit, first, steps, solved));
  }
  PetscFunctionReturn(0);
}

/* Solves the convex problem from the begin. If that succeeds, later solves for the same rows begin with it. */
static PetscErrorCode ContinuationConvex(IPTermSet *set, const IPReducedSystem *s, PetscReal begin[], PetscReal first,
  PetscInt *steps, PetscBool *solved)
{
  PetscFunctionBegin;
  PetscCall(ContinuationCopy(set, s, begin, PETSC_TRUE));
  PetscCall(IPTermConvexSolve(set, s, first, steps, solved));
  *solved     = (PetscBool)(*solved && set->met);
  set->convex = *solved;
  PetscFunctionReturn(0);
}

/*
   Solves after Newton's method has failed: by Newton's method with computed compliances, by continuation, or by the
   convex problem, which is the first choice for many rows. If the convex problem only makes progress, this is
   sufficient, since the reduced problem is then solved again from there; the other methods cost a hundred times as
   much, and fail mostly. begin: forces, motions and y at the start.
*/
static PetscErrorCode ContinuationFallBack(IPTermSet *set, const IPReducedSystem *s, PetscReal begin[], PetscReal first,
  PetscInt *steps, PetscBool *solved)
{
  const PetscReal progress = 0.9; /* residual that is sufficient, relative to that at the start */
  PetscReal       off      = PETSC_INFINITY;

  PetscFunctionBegin;
  if (set->convex_next) PetscCall(ContinuationConvex(set, s, begin, first, steps, solved));
  if (set->convex_next && !*solved) PetscCall(IPTermSetOff(set, s, &off));
  if (off <= progress * first) *solved = PETSC_TRUE;
  if (*solved || (set->convex_next && set->slides)) PetscFunctionReturn(0);
  PetscCall(ContinuationMeasured(set, s, PETSC_TRUE, begin, &first, steps, solved));
  if (!*solved) PetscCall(ContinuationPivot(set, s, first, steps, solved));
  if (!*solved) PetscCall(ContinuationMeasured(set, s, PETSC_FALSE, begin, &first, steps, solved));
  if (!*solved) PetscCall(ContinuationSolve(set, s, first, steps, solved));
  set->met = *solved;
  if (*solved) PetscFunctionReturn(0);
  PetscCall(ContinuationCopy(set, s, begin, PETSC_TRUE));
  PetscCall(IPTermConvexSolve(set, s, first, steps, solved));
  PetscFunctionReturn(0);
}

/* Returns whether the same contacts are closed as before, and all of them stick */
static PetscBool ContinuationKept(const IPTermSet *set, const PetscBool before[])
{
  for (PetscInt i = 0; i < set->m; i++) {
    if (before[i] != set->closed[i]) return PETSC_FALSE;
    if (i < set->n && set->active[IPTermLawsRow(set, i)] && set->slips[i]) return PETSC_FALSE;
  }
  return PETSC_TRUE;
}

/*
   Returns whether a contact is closed at the begin of the path. A contact that touches, and whose force is at most a
   guess, is closed if it has not slid; otherwise it is about to close, and sticks where it is.
*/
static PetscBool ContinuationCloses(const IPTermSet *set, const IPReducedSystem *s, const PetscReal motion[],
  PetscInt i)
{
  const PetscReal touch = 1e-9, slid = 1e-6;
  const PetscInt  row = i < set->n ? IPTermLawsRow(set, i) : 0;

  if (motion[i] > touch * set->length) return set->closed[i];
  if (i >= set->n || (set->closed[i] && !s->guessed)) return PETSC_TRUE;
  return (PetscBool)(PetscMax(PetscAbsReal(motion[row]), PetscAbsReal(motion[row + 1])) <= slid * set->length);
}

/*
   Solves if contacts stick: by Newton's method if no contact opens, closes or slides, and by the path of stick_path.c
   if one does. force, motion: forces and motions of the rows at the begin of the path; begin: forces, motions and y
   with which Newton's method starts
*/
static PetscErrorCode ContinuationStick(IPTermSet *set, const IPReducedSystem *s, PetscBool simply,
  const PetscReal force[], const PetscReal motion[], PetscReal begin[], PetscReal *first, PetscInt *steps,
  PetscBool *solved)
{
  const PetscInt limit = 12;
  PetscBool     *closed, measured, found = PETSC_FALSE;

  PetscFunctionBegin;
  PetscCall(PetscMalloc1(set->m, &closed));
  for (PetscInt i = 0; i < set->m; i++) closed[i] = set->closed[i] = ContinuationCloses(set, s, motion, i);
  PetscCall(IPTermSetIterate(set, s, limit, *first, steps, solved));
  *solved = (PetscBool)(*solved && ContinuationKept(set, closed));
  if (!*solved && !simply) PetscCall(IPTermDenseMeasure(&set->system, PETSC_TRUE, &measured));
  if (!*solved && !simply) {
    IPTermLawsResist(set);
    PetscCall(ContinuationCopy(set, s, begin, PETSC_TRUE));
    PetscCall(IPTermSetOff(set, s, first));
    PetscCall(PetscArraycpy(set->closed, closed, set->m));
    PetscCall(IPTermStickSolve(set, s, force, motion, steps, &found));
    if (found) PetscCall(IPTermSetIterate(set, s, limit, *first, steps, solved));
  }
  PetscCall(PetscFree(closed));
  PetscFunctionReturn(0);
}

/*
   Solves for the forces f (in s->lambda), the motions v (in s->gap) and y, starting from their last values. The
   residual is reduced to a small fraction of its initial value only, since later directions change the problem by more.
   set->met tells whether that was reached. simply: only Newton's method is used, since W can be extended if it fails.
   *steps: number of systems solved. *solved: false if nothing holds a moving body.
*/
PetscErrorCode IPTermSetSolve(IPTermSet *set, const IPReducedSystem *s, PetscBool simply, PetscInt *steps,
  PetscBool *solved)
{
  const PetscInt  limit = 60, few = 400; /* largest number of rows for which compliances are computed before W is
                                           extended */
  const PetscInt  many = 400; /* number of rows above which dense matrices of all rows cost more than sparse systems of
                                the convex problem */
  const PetscBool sticks = IPTermStickApplies(set, s);
  PetscReal       first, *begin, *before;

  PetscFunctionBegin;
  *steps             = 0;
  set->system.spring = s->spring;
  set->convex_next   = (PetscBool)(set->system.m > many);
  PetscCall(PetscMalloc2(2 * s->m + s->k, &begin, 2 * s->m, &before));
  PetscCall(PetscArraycpy(before, s->lambda, s->m));
  if (s->guessed) PetscCall(PetscArrayzero(before, set->m));
  PetscCall(PetscArraycpy(before + s->m, s->gap, s->m));
  PetscCall(ContinuationStart(set, s));
  PetscCall(IPTermSetOff(set, s, &first));
  PetscCall(ContinuationCopy(set, s, begin, PETSC_FALSE));
  *solved = PETSC_FALSE;
  if (sticks) PetscCall(ContinuationStick(set, s, simply, before, before + s->m, begin, &first, steps, solved));
  if (!sticks && set->convex) PetscCall(ContinuationConvex(set, s, begin, first, steps, solved));
  set->system.quick = set->convex_next;
  if (!sticks && !*solved) PetscCall(IPTermSetIterate(set, s, limit, first, steps, solved));
  set->system.quick = PETSC_FALSE;
  if (!sticks && !*solved && simply && set->system.m <= few)
    PetscCall(ContinuationMeasured(set, s, PETSC_TRUE, begin, &first, steps, solved));
  set->met = *solved;
  if (!*solved && !simply) PetscCall(ContinuationFallBack(set, s, begin, first, steps, solved));
  PetscCall(PetscFree2(begin, before));
  for (PetscInt r = 0; r < s->m && s->spring; r++) s->lambda[r] = set->active[r] ? s->lambda[r] : 0.0;
  PetscFunctionReturn(0);
}
