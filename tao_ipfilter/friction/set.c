/*
   Solves the laws of laws.c by a semismooth Newton method (Alart and Curnier, A mixed formulation for frictional
   contact problems prone to Newton like solution methods, 1991; Hueeber, Stadler and Wohlmuth, A primal-dual active set
   algorithm for three-dimensional contact problems with Coulomb friction, 2008). Constraints are open or closed. Terms
   stick, v_t = 0, or slip, tau = b d, where d is the direction of tau - rho v_t. The linear systems, see system.c, are
   not symmetric.
*/
#include "frictionimpl.h"

/*
   Progress of the exchange of constraints: the smallest number of wrong constraints so far, and the number of exchanges
   since then. A constraint is wrong if it is closed under tension, or open with penetration.
*/
typedef struct {
  PetscInt fewest, idle;
} TermSetCount;

/*
   Opens closed constraints under tension and closes open ones with penetration: all of them if `all`, otherwise only
   the last one. Returns the number of wrong constraints.
*/
static PetscInt TermSetClose(IPTermSet *set, const IPReducedSystem *s, PetscBool all)
{
  const PetscReal rounding = 1e-13;
  PetscInt        wrong    = 0;

  for (PetscInt i = set->m - 1; i >= 0; i--) {
    const PetscBool closed = (PetscBool)(set->closed[i] ? s->lambda[i] >= 0.0 : s->gap[i] < -rounding * set->length);

    if (closed == set->closed[i]) continue;
    if (all || !wrong) set->closed[i] = closed;
    wrong++;
  }
  return wrong;
}

/*
   Returns the friction bound of a term. If its constraint has just closed, the bound is estimated from the force that
   would remove the penetration if no other row moved.
*/
static PetscReal TermSetPredictBound(const IPTermSet *set, const IPReducedSystem *s, PetscInt i)
{
  const PetscReal nothing    = s->spring ? 1e-3 : 0.0; /* with springs, forces of open rows are zero to a tolerance */
  const PetscReal compliance = i < set->m ? set->system.compliance[i] : 0.0;

  if (set->coefficient[i] < 0.0 || compliance <= 0.0) return IPTermLawsBound(set, s, i);
  if (PetscAbsReal(s->lambda[i]) > nothing * PetscMax(0.0, -s->gap[i]) / compliance) return IPTermLawsBound(set, s, i);
  return IPTermBound(set->limit[i], set->coefficient[i], PetscMax(0.0, -s->gap[i]) / compliance);
}

/* Updates which terms slip. Returns whether any has changed. */
static PetscBool TermSetSlip(IPTermSet *set, const IPReducedSystem *s)
{
  PetscBool changed = PETSC_FALSE;

  for (PetscInt i = 0; i < set->n; i++) {
    PetscReal b[2];
    PetscBool slips;

    if (!set->active[IPTermLawsRow(set, i)]) continue;
    slips         = (PetscBool)(IPTermLawsTrial(set, s, i, b) > TermSetPredictBound(set, s, i));
    changed       = (PetscBool)(changed || slips != set->slips[i]);
    set->slips[i] = slips;
  }
  return changed;
}

/*
   Computes, for slipping terms with b = tau - rho v, the direction b / |b|, theta = bound / |b|, and the derivative of
   the bound, with which the equations are linearized
*/
static void TermSetLinearize(IPTermSet *set, const IPReducedSystem *s)
{
  for (PetscInt i = 0; i < set->n; i++) {
    PetscReal b[2], size, bound;

    if (!set->active[IPTermLawsRow(set, i)] || !set->slips[i]) continue;
    size          = IPTermLawsTrial(set, s, i, b);
    bound         = IPTermLawsBound(set, s, i);
    set->theta[i] = bound / size;
    set->slope[i] = set->coefficient[i] < 0.0 || bound >= set->limit[i] ? 0.0 : set->coefficient[i];
    for (PetscInt a = 0; a < 2; a++) set->direction[2 * i + a] = b[a] / size;
  }
}

/* Returns the factor by which the force of an inactive row is multiplied in its equation f = 0 [length/force] */
static PetscReal TermSetUnit(const IPTermSet *set, PetscInt row)
{
  const PetscReal compliance = IPTermLawsCompliance(set, row);

  if (row >= set->m) return 1.0 / set->rho[(row - set->m) / 2];
  return compliance > 0.0 ? compliance : 1.0;
}

/*
   Computes the residuals of all rows [length]: the force, converted to a length, of inactive rows; v of closed and
   sticking rows; (tau - bound d) / rho of slipping rows. Returns the largest residual of an active row.
*/
static PetscReal TermSetResidual(IPTermSet *set, const IPReducedSystem *s)
{
  PetscReal largest = 0.0;

  for (PetscInt r = 0; r < s->m; r++) {
    PetscInt       a = 0;
    const PetscInt i = IPTermLawsOfRow(set, r, &a);

    if (!set->active[r]) {
      set->F[r] = s->lambda[r] * TermSetUnit(set, r);
      if (s->spring) largest = PetscMax(largest, PetscAbsReal(set->F[r]));
      continue;
    }
    if (i >= 0 && set->slips[i]) {
      PetscReal       b[2];
      const PetscReal size = IPTermLawsTrial(set, s, i, b);

      set->F[r] = (s->lambda[r] - (size > 0.0 ? IPTermLawsBound(set, s, i) * b[a] / size : 0.0)) / set->rho[i];
    } else if (i >= 0) {
      const PetscReal *rigid = &set->rigid[2 * i], *tau = &s->lambda[IPTermLawsRow(set, i)];
      PetscReal        v[2];

      IPTermLawsMotion(set, s, i, v);
      set->F[r] = v[a] + rigid[a] * (rigid[0] * tau[0] + rigid[1] * tau[1]) / set->rho[i];
    } else set->F[r] = s->gap[r];
    largest = PetscMax(largest, PetscAbsReal(set->F[r]));
  }
  return largest;
}

/*
   Computes the derivatives of a row's equation. by_v: by the motions of the term's two rows; by_f: by the term's two
   forces; by_lambda: by the force of the term's constraint. In a closed or sticking row only the derivative by its own
   motion is not zero; it is 1.
*/
static void TermSetRow(const IPTermSet *set, PetscInt row, PetscReal by_v[2], PetscReal by_f[2], PetscReal *by_lambda)
{
  PetscInt         a = 0;
  const PetscInt   i = IPTermLawsOfRow(set, row, &a);
  const PetscReal *direction, *rigid;

  by_v[0] = by_v[1] = by_f[0] = by_f[1] = *by_lambda = 0.0;
  if (i < 0) {
    by_v[0] = 1.0;
    return;
  }
  direction = &set->direction[2 * i];
  rigid     = &set->rigid[2 * i];
  for (PetscInt b = 0; b < 2; b++) {
    const PetscReal one = a == b ? 1.0 : 0.0, movable = one - rigid[a] * rigid[b],
                    across = one - direction[a] * direction[b];

    by_f[b] = set->slips[i] ? (one - set->theta[i] * across) / set->rho[i] : (one - movable) / set->rho[i];
    by_v[b] =
      /* a direction that cannot move is orthogonal to the slip direction */
      set->slips[i] ? set->theta[i] * (across - rigid[a] * rigid[b]) : movable;
  }
  if (set->slips[i]) *by_lambda = -set->slope[i] * direction[a] / set->rho[i];
}

/*
   Assembles one row of the system. A tiny addition to the diagonal makes linearly dependent rows solvable; rows of
   terms are dependent if bodies are held. The residual has no such addition, so that the solution does not change. The
   force of an inactive row is unchanged.
*/
static PetscErrorCode TermSetAssembleRow(IPTermSet *set, PetscInt row)
{
  const PetscReal shift = 1e-13, terms = 1e-9, compliance = IPTermLawsCompliance(set, row);
  PetscInt        a = 0, n = 0, columns[3];
  const PetscInt  i = IPTermLawsOfRow(set, row, &a);
  PetscReal by_v[3] = {0.0, 0.0, 0.0}, by_f[3] = {0.0, 0.0, 0.0}, scale = i < 0 ? 1.0 : PetscSqrtReal(set->rho[i]);

  PetscFunctionBegin;
  if (i < 0 && compliance > 0.0) scale = 1.0 / PetscSqrtReal(compliance);
  columns[n++] = i < 0 ? row : IPTermLawsRow(set, i);
  if (i >= 0) columns[n++] = IPTermLawsRow(set, i) + 1;
  if (i >= 0 && i < set->m) columns[n++] = i;
  if (set->active[row]) {
    TermSetRow(set, row, by_v, by_f, &by_f[2]);
    by_f[a] += (i < 0 ? shift : terms) * compliance;
  } else by_f[a] = TermSetUnit(set, row);
  PetscCall(IPTermSystemSetRow(&set->system, row, n, columns, by_v, by_f, scale));
  PetscFunctionReturn(0);
}

/* Takes one Newton step from f and y */
static PetscErrorCode TermSetStep(IPTermSet *set, const IPReducedSystem *s, PetscReal rtol, PetscBool *solved)
{
  PetscFunctionBegin;
  TermSetLinearize(set, s);
  for (PetscInt r = 0; r < s->m; r++) PetscCall(TermSetAssembleRow(set, r));
  PetscCall(IPTermSystemAssemble(&set->system));
  PetscCall(IPTermSolve(&set->system, s, rtol, set->F, set->Fy, solved));
  if (!*solved) PetscFunctionReturn(0);
  for (PetscInt r = 0; r < s->m; r++) s->lambda[r] = set->active[r] || s->spring ? s->lambda[r] - set->F[r] : 0.0;
  for (PetscInt j = 0; j < s->k; j++) s->y[j] -= set->Fy[j];
  IPTermLawsRelieve(set, s);
  PetscCall(IPTermLawsMove(set, s));
  PetscFunctionReturn(0);
}

/* Computes x := x0 + alpha (x - x0) */
static void TermSetBlend(PetscInt n, PetscReal alpha, const PetscReal x0[], PetscReal x[])
{
  for (PetscInt i = 0; i < n; i++) x[i] = x0[i] + alpha * (x[i] - x0[i]);
}

/*
   Line search: halves a Newton step from its start (f, v, y) repeatedly and takes the length with the smallest
   violation of the laws. If no length is better than the start, the whole step is taken, since many short steps would
   make no progress. directions: norm of the residual of the subspace directions' equations at the start; it decreases
   linearly along the step. v is linear along the step too, so that no system is solved.
*/
static PetscErrorCode TermSetSearch(IPTermSet *set, const IPReducedSystem *s, const PetscReal f[], const PetscReal v[],
  const PetscReal y[], PetscReal directions)
{
  const IPReducedSystem begin    = {.m = s->m, .lambda = (PetscReal *)f, .gap = (PetscReal *)v};
  const PetscInt        halvings = 8;
  PetscReal             best = 1.0, alpha = 1.0, *trial;
  PetscReal             least = PetscMin(IPTermLawsMerit(set, s), IPTermLawsMerit(set, &begin) + PetscSqr(directions));

  PetscFunctionBegin;
  PetscCall(PetscMalloc1(2 * s->m, &trial));
  for (PetscInt k = 1; k <= halvings; k++) {
    const IPReducedSystem at = {.m = s->m, .lambda = trial, .gap = trial + s->m};
    PetscReal             merit;

    alpha *= 0.5;
    for (PetscInt i = 0; i < s->m; i++) {
      trial[i]        = f[i] + alpha * (s->lambda[i] - f[i]);
      trial[s->m + i] = v[i] + alpha * (s->gap[i] - v[i]);
    }
    merit = IPTermLawsMerit(set, &at) + PetscSqr((1.0 - alpha) * directions);
    if (merit < least) {
      least = merit;
      best  = alpha;
    }
  }
  PetscCall(PetscFree(trial));
  TermSetBlend(s->m, best, f, s->lambda);
  TermSetBlend(s->m, best, v, s->gap);
  TermSetBlend(s->k, best, y, s->y);
  PetscFunctionReturn(0);
}

/* Takes a Newton step with line search */
static PetscErrorCode TermSetCarefulStep(IPTermSet *set, const IPReducedSystem *s, PetscReal rtol, PetscBool *solved)
{
  PetscReal *before, directions = 0.0;

  PetscFunctionBegin;
  for (PetscInt j = 0; j < s->k; j++) directions += PetscSqr(set->Fy[j]);
  PetscCall(PetscMalloc1(2 * s->m + s->k, &before));
  PetscCall(PetscArraycpy(before, s->lambda, s->m));
  PetscCall(PetscArraycpy(before + s->m, s->gap, s->m));
  PetscCall(PetscArraycpy(before + 2 * s->m, s->y, s->k));
  PetscCall(TermSetStep(set, s, rtol, solved));
  if (*solved) PetscCall(TermSetSearch(set, s, before, before + s->m, before + 2 * s->m, PetscSqrtReal(directions)));
  PetscCall(PetscFree(before));
  PetscFunctionReturn(0);
}

/* Returns the square root of the sum of the squared residuals, weighted as an energy */
static PetscReal TermSetNorm(const IPTermSet *set, const IPReducedSystem *s)
{
  PetscReal sum = 0.0;

  for (PetscInt r = 0; r < s->m; r++) {
    const PetscReal compliance = IPTermLawsCompliance(set, r);

    if (compliance > 0.0) sum += PetscSqr(set->F[r]) / compliance;
  }
  for (PetscInt j = 0; j < s->k; j++) sum += PetscSqr(set->Fy[j]);
  return PetscSqrtReal(sum);
}

/*
   Updates which constraints are closed and which terms slip. All wrong constraints are exchanged. This may cycle:
   therefore only the last of them is exchanged if their number has not fallen for several steps (Portugal, Judice and
   Vicente, A comparison of block pivoting and interior-point algorithms for linear least squares problems with
   nonnegative variables, 1994). *changed: whether anything changed.
*/
static PetscErrorCode TermSetExchange(IPTermSet *set, const IPReducedSystem *s, TermSetCount *count, PetscBool *changed)
{
  const PetscInt patience = 10;
  PetscInt       wrong;

  PetscFunctionBegin;
  wrong = TermSetClose(set, s, (PetscBool)(count->idle < patience));
  count->idle++;
  if (wrong < count->fewest) {
    count->fewest = wrong;
    count->idle   = 0;
  }
  *changed = (PetscBool)(wrong > 0);
  IPTermLawsList(set, s);
  if (TermSetSlip(set, s)) *changed = PETSC_TRUE;
  PetscFunctionReturn(0);
}

/*
   Computes the square root of the sum of the squared residuals of the laws and of the directions' equations, weighted
   as an energy
*/
PetscErrorCode IPTermSetOff(IPTermSet *set, const IPReducedSystem *s, PetscReal *off)
{
  PetscFunctionBegin;
  PetscCall(IPTermLawsResidualOfDirections(set, s));
  *off = IPTermLawsMerit(set, s);
  for (PetscInt j = 0; j < s->k; j++) *off += PetscSqr(set->Fy[j]);
  *off = PetscSqrtReal(*off);
  PetscFunctionReturn(0);
}

/* A state of the iteration: its residual, f, v and y, and which constraints are closed */
typedef struct {
  PetscReal  off, *values;
  PetscBool *closed;
} TermSetState;

static PetscErrorCode TermSetCopy(IPTermSet *set, const IPReducedSystem *s, TermSetState *state, PetscBool back)
{
  PetscReal     *a[3] = {s->lambda, s->gap, s->y}, *b = state->values;
  const PetscInt n[3] = {s->m, s->m, s->k};

  PetscFunctionBegin;
  for (PetscInt k = 0; k < 3; k++) {
    PetscCall(PetscArraycpy(back ? a[k] : b, back ? b : a[k], n[k]));
    b += n[k];
  }
  PetscCall(PetscArraycpy(back ? set->closed : state->closed, back ? state->closed : set->closed, set->m));
  if (back) IPTermLawsList(set, s);
  PetscFunctionReturn(0);
}

/* Returns whether the residuals are rounding errors, or are small and no longer decrease */
static PetscBool TermSetIsExact(const IPTermSet *set, PetscReal largest, PetscReal before)
{
  const PetscReal exact = 1e-12, rounding = 1e-9;

  return (PetscBool)(largest <= exact * set->length || (largest <= rounding * set->length && largest > 0.5 * before));
}

/*
   Iterates by Newton's method from the present state until the residual is a small fraction of `first`. The state with
   the smallest residual is stored in `state`. The iteration ends early if for several steps neither the residual was
   halved nor the number of wrong constraints fell.
*/
static PetscErrorCode TermSetNewton(IPTermSet *set, const IPReducedSystem *s, PetscInt limit, PetscReal first,
  TermSetState *state, PetscInt *steps, PetscBool *solved)
{
  const PetscInt  patience = 15;
  const PetscReal enough = 1e-3, coarse = 1e-1, fine = 1e-10, far = 1e4;
  PetscReal       before = PETSC_INFINITY, halved = PETSC_INFINITY;
  PetscInt        futile = 0;
  TermSetCount    count  = {.fewest = set->m + 1};

  PetscFunctionBegin;
  for (PetscInt k = 0; k <= limit && futile <= patience; k++) {
    PetscReal largest, off = 0.0;
    PetscBool changed;

    PetscCall(IPTermSetOff(set, s, &off));
    *solved =
      (PetscBool)(off <= (k > 0 ? PetscMax(enough * first, IPTermLawsRounding(set, s)) : IPTermLawsRounding(set, s)));
    if (off < state->off) {
      state->off = off;
      PetscCall(TermSetCopy(set, s, state, PETSC_FALSE));
    }
    if (*solved || k == limit || (off > far * first && set->convex_next)) PetscFunctionReturn(0);
    PetscCall(TermSetExchange(set, s, &count, &changed));
    largest = TermSetResidual(set, s);
    *solved = (PetscBool)(k > 0 && off <= 0.1 * first && TermSetIsExact(set, largest, before));
    if (*solved) PetscFunctionReturn(0);
    before = largest;
    PetscCall(TermSetCarefulStep(set, s,
      changed ? coarse : PetscClipInterval(0.5 * enough * first / TermSetNorm(set, s), fine, coarse), solved));
    (*steps)++;
    if (!*solved) PetscFunctionReturn(0);
    *solved = PETSC_FALSE;
    futile  = off <= 0.5 * halved || !count.idle ? 0 : futile + 1;
    if (off <= 0.5 * halved) halved = off;
  }
  PetscFunctionReturn(0);
}

/*
   Takes at most `limit` Newton steps. If they do not reduce the residual to a small fraction of `first` (of its initial
   value if negative), the state with the smallest residual is restored. *steps is increased by the number of systems
   solved.
*/
PetscErrorCode IPTermSetIterate(IPTermSet *set, const IPReducedSystem *s, PetscInt limit, PetscReal first,
  PetscInt *steps, PetscBool *solved)
{
  TermSetState state = {.off = PETSC_INFINITY};

  PetscFunctionBegin;
  *solved = PETSC_FALSE;
  if (first < 0.0) PetscCall(IPTermSetOff(set, s, &first));
  PetscCall(PetscMalloc1(2 * s->m + s->k, &state.values));
  PetscCall(PetscMalloc1(set->m, &state.closed));
  PetscCall(TermSetNewton(set, s, limit, first, &state, steps, solved));
  if (!*solved && state.off < PETSC_INFINITY) PetscCall(TermSetCopy(set, s, &state, PETSC_TRUE));
  PetscCall(PetscFree(state.closed));
  PetscCall(PetscFree(state.values));
  PetscFunctionReturn(0);
}
