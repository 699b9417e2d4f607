/*
   Solves problems in which each closed contact sticks (coefficient of friction above IP_TERM_STICKS). They may have
   several solutions, and rounding errors decide which of them Newton's method finds. Its solution is therefore used
   only if no contact opens or closes. Otherwise the path of stick_path.c gives the solution.
*/
#include "frictionimpl.h"

/* Returns whether all terms stick where their constraints are closed, or are free, and the path has few rows */
PetscBool IPTermStickApplies(const IPTermSet *set, const IPReducedSystem *s)
{
  const PetscInt most = 1500;

  if (set->system.m > most || s->spring) return PETSC_FALSE;
  for (PetscInt i = 0; i < set->n; i++) {
    if (i >= set->m || set->coefficient[i] < 0.0 || set->limit[i] < PETSC_INFINITY) return PETSC_FALSE;
    if (set->coefficient[i] > 0.0 && set->coefficient[i] < IP_TERM_STICKS) return PETSC_FALSE;
  }
  return PETSC_TRUE;
}

/*
   Gets the start of the path: the motions of open contacts and the forces of closed ones, in the tableau's scale.
*/
static PetscErrorCode StickBegin(const PetscReal force[], const PetscReal motion[], IPStickPath *w)
{
  IPTableau *p = w->p;
  PetscReal *f = w->x, *v = w->x + p->rows;

  PetscFunctionBegin;
  for (PetscInt r = 0; r < p->rows; r++) {
    f[r] = force[r] / p->scale[r];
    v[r] = motion[r] * p->scale[r];
  }
  IPTableauRotate(p, f, 1, PETSC_FALSE);
  IPTableauRotate(p, v, 1, PETSC_FALSE);
  for (PetscInt i = 0; i < p->m; i++) {
    PetscReal tau = 0.0;

    f[i] = p->closed[i] ? PetscMax(f[i], 0.0) : 0.0;
    v[i] = p->closed[i] ? 0.0 : PetscMax(v[i], 0.0);
    for (PetscInt a = 0; a < 2 && i < p->n; a++) tau += PetscSqr(f[p->m + 2 * i + a]);
    for (PetscInt a = 0; a < 2 && i < p->n; a++) {
      const PetscInt row = p->m + 2 * i + a;

      if (!p->closed[i] || p->dropped[row] || PetscSqrtReal(tau) > IP_TERM_STICKS * f[i]) f[row] = 0.0;
      if (p->closed[i] || p->dropped[row]) v[row] = 0.0;
    }
    w->contact[i] = i >= p->n || p->dropped[p->m + 2 * i] ? IP_STICK_FREE
                    : p->closed[i]                        ? IP_STICK_HELD
                                                          : IP_STICK_OPEN;
  }
  PetscFunctionReturn(0);
}

/* Sets up the tableau and the start of the path */
static PetscErrorCode StickSetUp(const IPTermSet *set, const IPReducedSystem *s, const PetscReal force[],
  const PetscReal motion[], IPTableau *p, IPStickPath *w, PetscBool *made)
{
  PetscFunctionBegin;
  PetscCall(IPTableauCreate(set, p));
  IPTableauChoose(set, s, p);
  for (PetscInt i = 0; i < p->n; i++) {
    const PetscReal *rigid = &set->rigid[2 * i];

    p->mu[i] = 0.0;
    if (rigid[0] == 0.0 && rigid[1] == 0.0) p->axis[2 * i] = 1.0;
    if (rigid[0] == 0.0 && rigid[1] == 0.0) p->axis[2 * i + 1] = 0.0;
    for (PetscInt a = 0; a < 2; a++) {
      p->sign[2 * i + a]   = 1.0;
      p->sticks[2 * i + a] = (PetscBool)(!p->dropped[p->m + 2 * i + a] && p->closed[i]);
    }
  }
  PetscCall(IPStickPathCreate(set, p, w));
  PetscCall(IPTableauSetUp(set, s, p, made));
  if (!*made) PetscFunctionReturn(0);
  PetscCall(StickBegin(force, motion, w));
  IPStickPathLoad(w);
  PetscCall(IPTableauEnter(p));
  PetscFunctionReturn(0);
}

/*
   Moves the references of terms that have slid or opened to their present places. Terms that slid too often become
   free. Motions that are rounding errors of the path leave the reference where it was; they may be large if bodies are
   held by contact alone, because the motions of the rows then cancel.
*/
static PetscErrorCode StickRefer(IPTermSet *set, const IPReducedSystem *s, const IPStickPath *w)
{
  const PetscReal  rounding = 1e-7 * set->length;
  const IPTableau *p        = w->p;
  PetscReal       *shift;

  PetscFunctionBegin;
  PetscCall(PetscCalloc1(p->rows, &shift));
  for (PetscInt i = 0; i < p->n; i++) {
    if (w->contact[i] == IP_STICK_FREE) {
      if (set->coefficient[i] > 0.0) set->nreleased++;
      set->coefficient[i] = 0.0;
    } else if (w->moved[i])
      for (PetscInt a = 0; a < 2; a++) shift[p->m + 2 * i + a] = w->x[p->rows + p->m + 2 * i + a];
  }
  IPTableauRotate(p, shift, 1, PETSC_TRUE);
  for (PetscInt r = p->m; r < p->rows; r++) {
    shift[r] /= p->scale[r];
    if (PetscAbsReal(shift[r]) <= rounding) shift[r] = 0.0;
    set->shift[r - p->m] += shift[r];
    s->h[r] += shift[r];
    if (shift[r] != 0.0) set->nreleased++;
  }
  PetscCall(PetscFree(shift));
  PetscFunctionReturn(0);
}

/*
   Follows the path from the begin, where the rows have the given forces and motions, and set->closed tells which
   contacts are closed. Terms that have slid get new references. *found: false if the path does not reach the load, or C
   is not computed. *steps: increased by the number of events
*/
PetscErrorCode IPTermStickSolve(IPTermSet *set, const IPReducedSystem *s, const PetscReal force[],
  const PetscReal motion[], PetscInt *steps, PetscBool *found)
{
  IPTableau   p;
  IPStickPath w;

  PetscFunctionBegin;
  *found = PETSC_FALSE;
  if (!IPTermDenseIsComplete(&set->system)) PetscFunctionReturn(0);
  PetscCall(StickSetUp(set, s, force, motion, &p, &w, found));
  if (*found) PetscCall(IPStickPathFollow(&w, steps, found));
  if (*found) {
    for (PetscInt r = 0; r < p.rows; r++) p.q[r] = w.x[p.basic[r]];
    for (PetscInt i = 0; i < p.m; i++) p.closed[i] = (PetscBool)(p.place[i] >= 0);
    for (PetscInt r = p.m; r < p.rows; r++) p.sticks[r - p.m] = (PetscBool)(p.place[r] >= 0);
    PetscCall(StickRefer(set, s, &w));
    PetscCall(IPTableauTake(set, s, &p));
  }
  PetscCall(IPStickPathDestroy(&w));
  PetscCall(IPTableauDestroy(&p));
  PetscFunctionReturn(0);
}
