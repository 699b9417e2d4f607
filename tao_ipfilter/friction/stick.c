/*
   Solves problems whose closed contacts stick (coefficients above IP_TERM_STICKS), if Newton's method fails. Some
   contacts can neither stick nor be open: they are under tension if they stick, and penetrated if they are open. On the
   way to this load they have opened, and closed again at another place. Their terms are therefore released, which means
   that they slide without friction.
*/
#include "frictionimpl.h"

/* Makes the force of a row basic, or its motion. All terms must stick or be free: the pivots are then positive. */
static PetscErrorCode StickMove(IPTableau *p, PetscInt row, PetscBool held)
{
  PetscFunctionBegin;
  if (p->dropped[row] || (p->place[row] >= 0) == held) PetscFunctionReturn(0);
  if (held) PetscCall(IPTableauExchange(p, p->place[row + p->rows], -1 - p->place[row]));
  else PetscCall(IPTableauExchange(p, p->place[row], -1 - p->place[row + p->rows]));
  PetscFunctionReturn(0);
}

/* Lets the term of a constraint stick or be free */
static PetscErrorCode StickHold(IPTableau *p, PetscInt i, PetscBool sticks)
{
  PetscFunctionBegin;
  for (PetscInt a = 0; a < 2 && i < p->n; a++) {
    p->sticks[2 * i + a] = (PetscBool)(sticks && !p->dropped[p->m + 2 * i + a]);
    PetscCall(StickMove(p, p->m + 2 * i + a, p->sticks[2 * i + a]));
  }
  PetscFunctionReturn(0);
}

/* Returns the energy that a basic variable's present value stores: of tension, of penetration, or of shear */
static PetscReal StickEnergy(const IPTableau *p, PetscInt variable)
{
  const PetscInt  row = p->place[variable], partner = variable < p->rows ? variable + p->rows : variable - p->rows;
  const PetscReal pivot = IPTableauColumn(p, -1 - p->place[partner])[row];

  return pivot > 0.0 ? PetscSqr(p->q[row]) / pivot : 0.0;
}

/* Returns the energy that the tension of a closed constraint or the penetration of an open one stores, or 0 */
static PetscReal StickWrong(const IPTableau *p, PetscInt i, PetscReal largest)
{
  const PetscReal rounding = 1e-12, size = p->closed[i] ? largest : p->length * p->scale[i];
  const PetscInt  variable = p->closed[i] ? i : i + p->rows;

  if (p->dropped[i] || p->q[p->place[variable]] > -rounding * size) return 0.0;
  return StickEnergy(p, variable);
}

/* Returns the energy of a term's force if that is more than IP_TERM_STICKS times the force of its constraint, or 0 */
static PetscReal StickExcess(const IPTableau *p, PetscInt i)
{
  PetscReal force = 0.0, energy = 0.0;

  for (PetscInt a = 0; a < 2; a++) {
    if (!p->sticks[2 * i + a]) continue;
    force += PetscSqr(p->q[p->place[p->m + 2 * i + a]]);
    energy += StickEnergy(p, p->m + 2 * i + a);
  }
  return p->closed[i] && PetscSqrtReal(force) <= IP_TERM_STICKS * p->q[p->place[i]] ? 0.0 : energy;
}

/*
   Opens constraints under tension and closes penetrated ones, until there are none. Each time those with the largest
   energy change. All with the same energy change together, so that symmetric bodies remain symmetric. After some
   changes only one constraint changes at a time, because changes of several may return to an earlier state.
   follow: whether the term of a constraint sticks when it closes, and is free when it opens
   ever:   which constraints were closed at any time
   work:   work space, an entry per constraint
   *ended: false if the changes do not end
*/
static PetscErrorCode StickClose(IPTableau *p, PetscBool follow, PetscBool ever[], PetscReal work[], PetscBool *ended)
{
  const PetscInt  most  = 2 * p->m + 20;
  const PetscReal same  = 1.0 - 1e-6;
  PetscReal       worst = 1.0;

  PetscFunctionBegin;
  for (PetscInt k = 0; k < most && worst > 0.0; k++) {
    PetscReal largest = 0.0;
    PetscBool stop;

    PetscCall(IPReducedInterrupted(p->s, &stop));
    if (stop) break;
    worst = 0.0;
    for (PetscInt i = 0; i < p->m; i++)
      if (p->closed[i]) largest = PetscMax(largest, PetscAbsReal(p->q[p->place[i]]));
    for (PetscInt i = 0; i < p->m; i++) {
      work[i] = StickWrong(p, i, largest);
      worst   = PetscMax(worst, work[i]);
    }
    for (PetscInt i = 0; i < p->m && worst > 0.0; i++) {
      if (work[i] < same * worst) continue;
      p->closed[i] = (PetscBool)!p->closed[i];
      ever[i]      = PETSC_TRUE;
      PetscCall(StickMove(p, i, p->closed[i]));
      if (follow) PetscCall(StickHold(p, i, p->closed[i]));
      if (2 * k > most) break;
    }
  }
  *ended = (PetscBool)(worst == 0.0);
  PetscFunctionReturn(0);
}

/*
   Releases terms whose force is too large for the normal force of their constraint. Each time those with the largest
   energy are released. They remain free, even if their constraint closes again, because it has moved while it was open.
   Each release reduces the energy; the releases therefore end. *released: number of terms released.
*/
static PetscErrorCode StickRelease(IPTableau *p, PetscBool ever[], PetscReal work[], PetscInt *released,
  PetscBool *ended)
{
  const PetscReal same = 1.0 - 1e-6;
  PetscReal       worst;

  PetscFunctionBegin;
  *released = 0;
  for (PetscInt i = 0; i < p->n; i++) PetscCall(StickHold(p, i, (PetscBool)(p->closed[i] || ever[i])));
  do {
    PetscCall(StickClose(p, PETSC_FALSE, ever, work, ended));
    worst = 0.0;
    for (PetscInt i = 0; i < p->n && *ended; i++) {
      work[i] = StickExcess(p, i);
      worst   = PetscMax(worst, work[i]);
    }
    for (PetscInt i = 0; i < p->n && worst > 0.0; i++) {
      if (work[i] < same * worst) continue;
      PetscCall(StickHold(p, i, PETSC_FALSE));
      ++*released;
    }
  } while (worst > 0.0);
  PetscFunctionReturn(0);
}

/* Returns whether all terms stick where their constraints are closed, or are free, and C is computed */
PetscBool IPTermStickApplies(const IPTermSet *set, const IPReducedSystem *s)
{
  if (!IPTermDenseIsComplete(&set->system) || s->spring) return PETSC_FALSE;
  for (PetscInt i = 0; i < set->n; i++) {
    if (i >= set->m || set->coefficient[i] < 0.0 || set->limit[i] < PETSC_INFINITY) return PETSC_FALSE;
    if (set->coefficient[i] > 0.0 && set->coefficient[i] < IP_TERM_STICKS) return PETSC_FALSE;
  }
  return PETSC_TRUE;
}

/* Sets up the tableau with terms that stick where their constraints are closed; sigma is then tau */
static PetscErrorCode StickSetUp(const IPTermSet *set, const IPReducedSystem *s, IPTableau *p, PetscBool *made)
{
  PetscFunctionBegin;
  PetscCall(IPTableauCreate(set, p));
  IPTableauChoose(set, s, p);
  for (PetscInt i = 0; i < p->n; i++) {
    p->mu[i] = 0.0;
    for (PetscInt a = 0; a < 2; a++) {
      p->sign[2 * i + a]   = 1.0;
      p->sticks[2 * i + a] = (PetscBool)(!p->dropped[p->m + 2 * i + a] && p->closed[i]);
    }
  }
  PetscCall(IPTableauSetUp(set, s, p, made));
  if (*made) PetscCall(IPTableauEnter(p));
  PetscFunctionReturn(0);
}

/*
   Solves a problem whose closed contacts stick. Contacts are opened and closed first. If this does not end, or a force
   is too large for its constraint, terms are released. The coefficients of friction of all terms that do not stick are
   then set to zero, so that no further contact sticks in later problems of the same load step.
   *found: false if there is no solution. *steps: increased by the number of terms released.
*/
PetscErrorCode IPTermStickSolve(IPTermSet *set, const IPReducedSystem *s, PetscInt *steps, PetscBool *found)
{
  PetscInt   released = 0;
  PetscBool *ever, ended = PETSC_FALSE;
  PetscReal *work;
  IPTableau  p;

  PetscFunctionBegin;
  *found = PETSC_FALSE;
  PetscCall(StickSetUp(set, s, &p, found));
  PetscCall(PetscCalloc2(p.m, &ever, p.m, &work));
  if (*found) PetscCall(StickClose(&p, PETSC_TRUE, ever, work, &ended));
  if (ended) PetscCall(PetscArrayzero(ever, p.m));
  if (*found) PetscCall(StickRelease(&p, ever, work, &released, found));
  for (PetscInt i = 0; i < p.n && *found && released; i++)
    if (!p.sticks[2 * i] && !p.sticks[2 * i + 1]) set->coefficient[i] = 0.0;
  if (*found) PetscCall(IPTableauTake(set, s, &p));
  if (*found) set->nreleased += released;
  *steps += released;
  PetscCall(PetscFree2(ever, work));
  PetscCall(IPTableauDestroy(&p));
  PetscFunctionReturn(0);
}
