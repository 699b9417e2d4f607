/*
   Solves the laws of laws.c by a semi-smooth Newton method (Alart and Curnier, A mixed formulation for frictional
   contact problems prone to Newton like solution methods, 1991; Hueeber, Stadler and Wohlmuth, A primal-dual active set
   algorithm for three-dimensional contact problems with Coulomb friction, 2008). Constraints are open or closed. Terms
   stick, v_t = 0, or slip, tau = b d with d the direction of tau - rho v_t. The linear systems are not symmetric:
   system.c.
*/
#include "frictionimpl.h"

/* Updates which constraints are closed: a closed one opens under tension, an open one closes if penetrated. all: all
   of them, else only the last one that is wrong. Returns whether any changed. */
static PetscBool TermSetClose(IPTermSet *set, const IPReducedSystem *s, PetscBool all)
{
  const PetscReal rounding = 1e-13;
  PetscBool       changed  = PETSC_FALSE;

  for (PetscInt i = set->m - 1; i >= 0 && (all || !changed); i--) {
    const PetscBool closed = (PetscBool)(set->closed[i] ? s->lambda[i] >= 0.0 : s->gap[i] < -rounding * set->length);

    changed        = (PetscBool)(changed || closed != set->closed[i]);
    set->closed[i] = closed;
  }
  return changed;
}

/* Friction bound of a term. If its constraint has just closed, the bound is estimated from the force that would
   remove the penetration if no other row moved. */
static PetscReal TermSetPredictBound(const IPTermSet *set, const IPReducedSystem *s, PetscInt i)
{
  const PetscReal compliance = i < set->m ? set->system.compliance[i] : 0.0;

  if (set->coefficient[i] < 0.0 || s->lambda[i] != 0.0 || compliance <= 0.0) return IPTermLawsBound(set, s, i);
  return IPTermBound(set->limit[i], set->coefficient[i], PetscMax(0.0, -s->gap[i]) / compliance);
}

/* Updates which terms slip; returns whether any changed */
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

/* For slipping terms: the direction b / |b|, theta = bound / |b|, and the derivative of the bound, at which the
   equations are linearized */
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

/* Residuals of the active rows [length]: v of closed and sticking rows, (tau - bound d) / rho of slipping ones.
   Returns the largest. */
static PetscReal TermSetResidual(IPTermSet *set, const IPReducedSystem *s)
{
  PetscReal largest = 0.0;

  for (PetscInt r = 0; r < s->m; r++) {
    PetscInt       a = 0;
    const PetscInt i = IPTermLawsOfRow(set, r, &a);

    set->F[r] = 0.0;
    if (!set->active[r]) continue;
    if (i >= 0 && set->slips[i]) {
      PetscReal       b[2];
      const PetscReal size = IPTermLawsTrial(set, s, i, b);

      set->F[r] = (s->lambda[r] - (size > 0.0 ? IPTermLawsBound(set, s, i) * b[a] / size : 0.0)) / set->rho[i];
    } else if (i >= 0) {
      const PetscReal *dead = &set->dead[2 * i], *tau = &s->lambda[IPTermLawsRow(set, i)];
      PetscReal        v[2];

      IPTermLawsMotion(set, s, i, v);
      set->F[r] = v[a] + dead[a] * (dead[0] * tau[0] + dead[1] * tau[1]) / set->rho[i];
    } else set->F[r] = s->gap[r];
    largest = PetscMax(largest, PetscAbsReal(set->F[r]));
  }
  return largest;
}

/*
   Derivatives of a row's equation. by_v: by the motions of the term's two rows; by_f: by its two forces; by_lambda: by
   the force of its constraint. A closed or sticking row has by_v = 1 at itself.
*/
static void TermSetRow(const IPTermSet *set, PetscInt row, PetscReal by_v[2], PetscReal by_f[2], PetscReal *by_lambda)
{
  PetscInt         a = 0;
  const PetscInt   i = IPTermLawsOfRow(set, row, &a);
  const PetscReal *direction, *dead;

  by_v[0] = by_v[1] = by_f[0] = by_f[1] = *by_lambda = 0.0;
  if (i < 0) {
    by_v[0] = 1.0;
    return;
  }
  direction = &set->direction[2 * i];
  dead      = &set->dead[2 * i];
  for (PetscInt b = 0; b < 2; b++) {
    const PetscReal one = a == b ? 1.0 : 0.0, alive = one - dead[a] * dead[b],
                    across = one - direction[a] * direction[b];

    by_f[b] = set->slips[i] ? (one - set->theta[i] * across) / set->rho[i] : (one - alive) / set->rho[i];
    by_v[b] =
      /* a direction that cannot move is orthogonal to the slip direction */
      set->slips[i] ? set->theta[i] * (across - dead[a] * dead[b]) : alive;
  }
  if (set->slips[i]) *by_lambda = -set->slope[i] * direction[a] / set->rho[i];
}

/* Assembles one row of the system. A tiny shift of the diagonal makes linearly dependent rows solvable; rows of
   terms are dependent where bodies are held. The residual has no such shift, so the solution is not changed. The
   force of an inactive row is left unchanged. */
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
  } else by_f[a] = 1.0 / (scale * scale);
  PetscCall(IPTermSystemSetRow(&set->system, row, n, columns, by_v, by_f, scale));
  PetscFunctionReturn(0);
}

/* One Newton step from f and y */
static PetscErrorCode TermSetStep(IPTermSet *set, const IPReducedSystem *s, PetscReal rtol, PetscBool *solved)
{
  PetscFunctionBegin;
  TermSetLinearize(set, s);
  for (PetscInt r = 0; r < s->m; r++) PetscCall(TermSetAssembleRow(set, r));
  PetscCall(IPTermSystemAssemble(&set->system));
  PetscCall(IPTermSolve(&set->system, s, rtol, set->F, set->Fy, solved));
  if (!*solved) PetscFunctionReturn(0);
  for (PetscInt r = 0; r < s->m; r++)
    if (set->active[r]) s->lambda[r] -= set->F[r];
  for (PetscInt j = 0; j < s->k; j++) s->y[j] -= set->Fy[j];
  IPTermLawsRelieve(set, s);
  PetscCall(IPTermLawsMove(set, s));
  PetscFunctionReturn(0);
}

/* x := x0 + alpha (x - x0) */
static void TermSetBlend(PetscInt n, PetscReal alpha, const PetscReal x0[], PetscReal x[])
{
  for (PetscInt i = 0; i < n; i++) x[i] = x0[i] + alpha * (x[i] - x0[i]);
}

/* Line search: from the end of a Newton step back towards its start (f, v, y), by halving, to the point of smallest
   violation. directions: norm of the directions' residual at the start. v is linear along the step, so no system is
   solved. */
static PetscErrorCode TermSetSearch(IPTermSet *set, const IPReducedSystem *s, const PetscReal f[], const PetscReal v[],
  const PetscReal y[], PetscReal directions)
{
  const PetscInt halvings = 8;
  PetscReal      least = IPTermLawsMerit(set, s), best = 1.0, alpha = 1.0, *trial;

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

/* A Newton step with line search */
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

/* Square root of the squared residuals, weighted as an energy */
static PetscReal TermSetNorm(const IPTermSet *set, const IPReducedSystem *s)
{
  PetscReal sum = 0.0;

  for (PetscInt r = 0; r < s->m; r++) {
    if (set->active[r]) sum += PetscSqr(set->F[r]) / IPTermLawsCompliance(set, r);
  }
  for (PetscInt j = 0; j < s->k; j++) sum += PetscSqr(set->Fy[j]);
  return PetscSqrtReal(sum);
}

/* Updates which constraints are closed and which terms slip. *changed: whether anything changed */
static PetscErrorCode TermSetExchange(IPTermSet *set, const IPReducedSystem *s, PetscBool all, PetscBool *changed)
{
  PetscFunctionBegin;
  *changed = TermSetClose(set, s, all);
  if (*changed) PetscCall(IPTermLawsRenew(set, s));
  if (TermSetSlip(set, s)) *changed = PETSC_TRUE;
  PetscFunctionReturn(0);
}

/* At most `limit` Newton steps. *first: norm of the residual at the start; set if negative. *steps is increased by
   the number of systems solved. */
static PetscErrorCode TermSetIterate(IPTermSet *set, const IPReducedSystem *s, PetscInt limit, PetscReal *first,
  PetscInt *steps, PetscBool *solved)
{
  const PetscInt  cycles = 25;
  const PetscReal exact = 1e-12, rounding = 1e-9, enough = 1e-3, coarse = 1e-1, fine = 1e-10;
  PetscReal       before = PETSC_INFINITY;

  PetscFunctionBegin;
  for (PetscInt k = 0; k < limit; k++) {
    PetscReal largest, norm, rtol;
    PetscBool changed;

    PetscCall(TermSetExchange(set, s, (PetscBool)(k < cycles), &changed));
    largest = TermSetResidual(set, s);
    PetscCall(IPTermLawsResidualOfDirections(set, s));
    norm    = TermSetNorm(set, s);
    *solved = (PetscBool)(k > 0 && !changed && norm <= enough * *first);
    if (k > 0 && (largest <= exact * set->length || (largest <= rounding * set->length && largest > 0.5 * before)) &&
        norm <= 0.1 * *first)
      *solved = PETSC_TRUE;
    if (*solved) PetscFunctionReturn(0);
    if (*first < 0.0) *first = norm;
    before = largest;
    rtol   = changed ? coarse : PetscClipInterval(0.5 * enough * *first / norm, fine, coarse);
    PetscCall(TermSetCarefulStep(set, s, rtol, solved));
    (*steps)++;
    if (!*solved) PetscFunctionReturn(0);
  }
  *solved = PETSC_FALSE;
  PetscFunctionReturn(0);
}

/* Whether any term has so large a coefficient that it sticks under almost any normal force. Its bound then jumps
   between 0 and almost infinite, which a smoothed law cannot follow. */
static PetscBool TermSetSticks(const IPTermSet *set)
{
  const PetscReal large  = 100.0;
  PetscBool       sticks = PETSC_FALSE;

  for (PetscInt i = 0; i < set->n; i++) sticks = (PetscBool)(sticks || set->coefficient[i] >= large);
  return sticks;
}

/* Newton's method from the present state; if that fails, again from the end of a path of smoothed laws (path.c). The
   path is not tried if TermSetSticks(). */
static PetscErrorCode TermSetTry(IPTermSet *set, const IPReducedSystem *s, PetscReal *first, PetscInt *steps,
  PetscBool *solved)
{
  const PetscBool sticks = TermSetSticks(set);
  const PetscInt  soon = sticks ? 12 : 40, limit = 100;

  PetscFunctionBegin;
  PetscCall(TermSetIterate(set, s, soon, first, steps, solved));
  if (*solved || sticks) PetscFunctionReturn(0);
  PetscCall(IPTermPathFollow(set, s, steps, solved));
  if (*solved) PetscCall(TermSetIterate(set, s, limit, first, steps, solved));
  PetscFunctionReturn(0);
}

/* Solves for f (in s->lambda), v (in s->gap) and y, starting from the last ones. The residual is reduced to a small
   fraction of its start, since later directions will change the problem by more. If Newton's method and the path
   fail, convex.c compliance the solution, and set->met tells whether it satisfies the laws. *steps: number of systems
   solved. *solved: false if nothing holds a moving body. */
PetscErrorCode IPTermSetSolve(IPTermSet *set, const IPReducedSystem *s, PetscInt *steps, PetscBool *solved)
{
  PetscReal first = -1.0, *begin;

  PetscFunctionBegin;
  *steps = 0;
  IPTermLawsResist(set);
  if (set->listed) PetscCall(IPTermLawsMove(set, s));
  else PetscCall(IPTermLawsRenew(set, s));
  PetscCall(PetscMalloc1(s->m + s->k, &begin));
  PetscCall(PetscArraycpy(begin, s->lambda, s->m));
  PetscCall(PetscArraycpy(begin + s->m, s->y, s->k));
  PetscCall(TermSetTry(set, s, &first, steps, solved));
  set->met = *solved;
  if (!*solved) {
    PetscCall(PetscArraycpy(s->lambda, begin, s->m));
    PetscCall(PetscArraycpy(s->y, begin + s->m, s->k));
    PetscCall(IPTermConvexSolve(set, s, first, steps, solved));
  }
  PetscCall(PetscFree(begin));
  PetscFunctionReturn(0);
}
