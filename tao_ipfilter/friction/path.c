/*
   Computes a starting point for Newton's method by path following. It is used where Newton's method fails on the laws
   of laws.c. The laws are smoothed:
     lambda w = m, v_n = w, lambda > 0, w > 0,  r tau = -b(lambda) v_t, r = sqrt(|v_t|^2 + e^2),
   and m and e are reduced to zero, as in an interior point method. The friction law is linearized in this form and not
   after a division by r (Chan, Golub and Mulet, A nonlinear primal-dual method for total variation-based image
   restoration, 1999). This form suits sticking and slipping terms. Rows that are closed at the end of the path are
   closed when Newton's method starts.
*/
#include "frictionimpl.h"

typedef struct {
  PetscInt   n;       /* number of active constraints */
  PetscReal *w;       /* slack w of each constraint [length] */
  PetscReal  product; /* mean of lambda w over the active constraints [energy] */
  PetscReal  m, e;
} TermPath;

/*
   Computes the initial point. All constraints get the same force, chosen such that the forces move the rows by the
   largest gap on average. w is the largest gap.
*/
static PetscErrorCode TermPathBegin(IPTermSet *set, const IPReducedSystem *s, TermPath *path)
{
  PetscReal length = 0.0, moved = 0.0, force;

  PetscFunctionBegin;
  for (PetscInt i = 0; i < set->m; i++) set->closed[i] = PETSC_TRUE;
  PetscCall(PetscArrayzero(s->lambda, s->m));
  PetscCall(IPTermLawsRenew(set, s));
  path->n = 0;
  for (PetscInt i = 0; i < set->m; i++) {
    path->n += set->active[i];
    if (set->active[i]) length = PetscMax(length, PetscAbsReal(s->gap[i]));
    set->F[i] = set->active[i] ? 1.0 : 0.0;
  }
  PetscCall(PetscArrayzero(set->F + set->m, s->m - set->m));
  PetscCall(IPTermSystemApplyCompliance(&set->system, set->F, set->system.v));
  for (PetscInt i = 0; i < set->m; i++) moved += set->active[i] ? set->system.v[i] / path->n : 0.0;
  force = length / moved;
  for (PetscInt i = 0; i < set->m; i++) {
    if (!set->active[i]) continue;
    s->lambda[i] = force;
    path->w[i]   = length;
  }
  PetscCall(IPTermLawsMove(set, s));
  path->product = length * force;
  path->m       = path->product;
  path->e       = length;
  PetscFunctionReturn(0);
}

/* Sets the residual and the coefficients of a constraint's equation */
static PetscErrorCode TermPathSetConstraint(IPTermSet *set, const IPReducedSystem *s, const TermPath *path, PetscInt i)
{
  const PetscReal compliance = set->system.compliance[i], lambda = s->lambda[i], w = path->w[i],
                  size = lambda + (compliance > 0.0 ? w / compliance : 0.0);
  const PetscReal by_v = set->active[i] ? lambda / size : 0.0,
                  by_f = set->active[i] ? w / size : PetscMax(compliance, 1.0);

  PetscFunctionBegin;
  set->F[i] = set->active[i] ? (lambda * s->gap[i] - path->m) / size : 0.0;
  PetscCall(
    IPTermSystemSetRow(&set->system, i, 1, &i, &by_v, &by_f, compliance > 0.0 ? 1.0 / PetscSqrtReal(compliance) : 1.0));
  PetscFunctionReturn(0);
}

/*
   Linearizes component a of the law of term i. by_v: derivatives by the term's two motions; by_f: derivatives by its
   two forces and by the force of its constraint; F: residual.
*/
static void TermPathLinearize(IPTermSet *set, const IPReducedSystem *s, const TermPath *path, PetscInt i, PetscInt a,
  PetscReal by_v[3], PetscReal by_f[3], PetscReal *F)
{
  const PetscReal *rigid = &set->rigid[2 * i], *tau = &s->lambda[IPTermLawsRow(set, i)],
                  bound = IPTermLawsBound(set, s, i), force = PetscSqrtReal(tau[0] * tau[0] + tau[1] * tau[1]);
  const PetscBool sticks = (PetscBool)(bound >= PETSC_INFINITY);
  const PetscReal inside = force > bound ? bound / force : 1.0;
  PetscReal       v[2], r, size;

  IPTermLawsMotion(set, s, i, v);
  r    = PetscSqrtReal(v[0] * v[0] + v[1] * v[1] + path->e * path->e);
  size = bound + set->rho[i] * r;
  for (PetscInt b = 0; b < 2; b++) {
    const PetscReal one = a == b ? 1.0 : 0.0, along_rigid = rigid[a] * rigid[b];

    by_v[b] = sticks ? one - along_rigid : (bound * (one - along_rigid) + inside * tau[a] * v[b] / r) / size;
    by_f[b] = sticks ? along_rigid / set->rho[i] : one * r / size;
  }
  by_f[2] = sticks || set->coefficient[i] < 0.0 || bound >= set->limit[i] ? 0.0 : set->coefficient[i] * v[a] / size;
  *F      = sticks ? v[a] : (r * tau[a] + bound * v[a]) / size;
}

/*
   Sets the residual and the coefficients of a term's row. An inactive row gets an equation that does not change its
   force.
*/
static PetscErrorCode TermPathSetTerm(IPTermSet *set, const IPReducedSystem *s, const TermPath *path, PetscInt row)
{
  const PetscReal tiny = 1e-9;
  PetscInt        a = 0, n = 0, columns[3];
  const PetscInt  i       = IPTermLawsOfRow(set, row, &a);
  PetscReal       by_v[3] = {0.0, 0.0, 0.0}, by_f[3] = {0.0, 0.0, 0.0};

  PetscFunctionBegin;
  columns[n++] = IPTermLawsRow(set, i);
  columns[n++] = IPTermLawsRow(set, i) + 1;
  if (i < set->m) columns[n++] = i;
  set->F[row] = 0.0;
  if (set->active[row]) {
    TermPathLinearize(set, s, path, i, a, by_v, by_f, &set->F[row]);
    by_f[a] += tiny / set->rho[i];
  } else by_f[a] = 1.0 / set->rho[i];
  PetscCall(IPTermSystemSetRow(&set->system, row, n, columns, by_v, by_f, PetscSqrtReal(set->rho[i])));
  PetscFunctionReturn(0);
}

/* Returns the largest step up to alpha for which x + step dx remains positive, with a safety factor */
static PetscReal TermPathToBoundary(PetscReal x, PetscReal dx, PetscReal alpha)
{
  const PetscReal short_of = 0.995;

  return dx < 0.0 ? PetscMin(alpha, -short_of * x / dx) : alpha;
}

/*
   Takes a Newton step for the smoothed laws. *alpha: the fraction of the step for which lambda and w remain positive.
*/
static PetscErrorCode TermPathStep(IPTermSet *set, const IPReducedSystem *s, TermPath *path, PetscReal *alpha,
  PetscBool *solved)
{
  const PetscReal rtol = 1e-6;
  PetscReal      *dw;

  PetscFunctionBegin;
  for (PetscInt i = 0; i < set->m; i++) PetscCall(TermPathSetConstraint(set, s, path, i));
  for (PetscInt r = set->m; r < s->m; r++) PetscCall(TermPathSetTerm(set, s, path, r));
  PetscCall(IPTermSystemAssemble(&set->system));
  PetscCall(IPTermLawsResidualOfDirections(set, s));
  set->system.stale = PETSC_TRUE;
  PetscCall(IPTermSolve(&set->system, s, rtol, set->F, set->Fy, solved));
  if (!*solved) PetscFunctionReturn(0);
  PetscCall(PetscMalloc1(set->m, &dw));
  *alpha = 1.0;
  for (PetscInt i = 0; i < set->m; i++) {
    if (!set->active[i]) continue;
    dw[i]  = path->m / s->lambda[i] - path->w[i] + path->w[i] * set->F[i] / s->lambda[i];
    *alpha = TermPathToBoundary(path->w[i], dw[i], *alpha);
    *alpha = TermPathToBoundary(s->lambda[i], -set->F[i], *alpha);
  }
  for (PetscInt i = 0; i < set->m; i++) {
    if (set->active[i]) path->w[i] += *alpha * dw[i];
  }
  PetscCall(PetscFree(dw));
  for (PetscInt r = 0; r < s->m; r++) {
    if (set->active[r]) s->lambda[r] -= *alpha * set->F[r];
  }
  for (PetscInt j = 0; j < s->k; j++) s->y[j] -= *alpha * set->Fy[j];
  IPTermLawsRelieve(set, s);
  PetscCall(IPTermLawsMove(set, s));
  PetscFunctionReturn(0);
}

/* Reduces m and e, by a smaller factor after a longer step alpha */
static void TermPathAdvance(const IPTermSet *set, const IPReducedSystem *s, TermPath *path, PetscReal alpha)
{
  const PetscReal fraction = alpha > 0.9 ? 0.1 : alpha > 0.3 ? 0.3 : 0.7;
  PetscReal       force    = 0.0;

  path->product = 0.0;
  for (PetscInt i = 0; i < set->m; i++) {
    if (!set->active[i]) continue;
    path->product += s->lambda[i] * path->w[i] / path->n;
    force += s->lambda[i] / path->n;
  }
  path->m = fraction * path->product;
  path->e = path->m / force;
}

/*
   Follows the path to its end, and sets f, v, y, and which rows are closed there. *followed: false if a system could
   not be solved or no constraint is active. *steps is increased by the number of systems solved.
*/
PetscErrorCode IPTermPathFollow(IPTermSet *set, const IPReducedSystem *s, PetscInt *steps, PetscBool *followed)
{
  const PetscInt  limit = 100;
  const PetscReal end   = 1e-16;
  PetscReal       first, alpha = 0.5;
  TermPath        path;

  PetscFunctionBegin;
  PetscCall(PetscCalloc1(set->m, &path.w));
  PetscCall(TermPathBegin(set, s, &path));
  first     = path.product;
  *followed = (PetscBool)(path.n > 0 && !s->spring); /* springs: K_WW alone may be indefinite */
  for (PetscInt k = 0; *followed && k < limit && path.product > end * first; k++) {
    TermPathAdvance(set, s, &path, alpha);
    PetscCall(TermPathStep(set, s, &path, &alpha, followed));
    (*steps)++;
  }
  for (PetscInt i = 0; i < set->m; i++)
    set->closed[i] = (PetscBool)(set->active[i] && s->lambda[i] * set->system.compliance[i] > path.w[i]);
  PetscCall(IPTermLawsRenew(set, s));
  PetscCall(PetscFree(path.w));
  PetscFunctionReturn(0);
}
