/*
   A way to the laws of laws.c where Newton's method on them finds none: along solutions of smoother ones,

     lambda w = m,  v_n = w,  lambda > 0,  w > 0,     r tau = -b(lambda) v_t,  r = sqrt(|v_t|^2 + e^2),

   for m and e that go to zero, as interior point methods do for the first; the second linearized as it stands, not
   divided by r (Chan, Golub and Mulet, A nonlinear primal-dual method for total variation-based image restoration,
   1999), is as good where a term sticks as where it slips. What is closed in the end is where Newton's method begins.
*/
#include "frictionimpl.h"

typedef struct {
  PetscInt   n;       /* constraints that take part */
  PetscReal *w;       /* of all constraints */
  PetscReal  product; /* mean of lambda w */
  PetscReal  m, e;
} TermPath;

/* The same force for all constraints, such that they move each other as far as they are to be moved; w as large as
   that */
static PetscErrorCode TermPathBegin(IPTermSet *set, const IPReducedSystem *s, TermPath *path)
{
  PetscReal length = 0.0, moved = 0.0, force;

  PetscFunctionBegin;
  for (PetscInt i = 0; i < set->m; i++) set->closed[i] = PETSC_TRUE;
  PetscCall(PetscArrayzero(s->lambda, s->m));
  PetscCall(IPTermLawsRenew(set, s));
  path->n = 0;
  for (PetscInt i = 0; i < set->m; i++) {
    path->n += set->takes[i];
    if (set->takes[i]) length = PetscMax(length, PetscAbsReal(s->gap[i]));
    set->F[i] = set->takes[i] ? 1.0 : 0.0;
  }
  PetscCall(PetscArrayzero(set->F + set->m, s->m - set->m));
  PetscCall(IPTermSystemApplyCompliance(&set->system, set->F, set->system.v));
  for (PetscInt i = 0; i < set->m; i++) moved += set->takes[i] ? set->system.v[i] / path->n : 0.0;
  force = length / moved;
  for (PetscInt i = 0; i < set->m; i++) {
    if (!set->takes[i]) continue;
    s->lambda[i] = force;
    path->w[i]   = length;
  }
  PetscCall(IPTermLawsMove(set, s));
  path->product = length * force;
  path->m       = path->product;
  path->e       = length;
  PetscFunctionReturn(0);
}

/* Equation and coefficients of a constraint */
static PetscErrorCode TermPathSetConstraint(IPTermSet *set, const IPReducedSystem *s, const TermPath *path, PetscInt i)
{
  const PetscReal gives = set->system.gives[i], lambda = s->lambda[i], w = path->w[i],
                  size = lambda + (gives > 0.0 ? w / gives : 0.0);
  const PetscReal by_v = set->takes[i] ? lambda / size : 0.0, by_f = set->takes[i] ? w / size : PetscMax(gives, 1.0);

  PetscFunctionBegin;
  set->F[i] = set->takes[i] ? (lambda * s->gap[i] - path->m) / size : 0.0;
  PetscCall(IPTermSystemSetRow(&set->system, i, 1, &i, &by_v, &by_f, gives > 0.0 ? 1.0 / PetscSqrtReal(gives) : 1.0));
  PetscFunctionReturn(0);
}

/* Of a term: by_v of its two motions; by_f of its two forces and of its constraint's, for component a */
static void TermPathLinearize(IPTermSet *set, const IPReducedSystem *s, const TermPath *path, PetscInt i, PetscInt a,
  PetscReal by_v[3], PetscReal by_f[3], PetscReal *F)
{
  const PetscReal *dead = &set->dead[2 * i], *tau = &s->lambda[IPTermLawsRow(set, i)],
                  bound = IPTermLawsBound(set, s, i), force = PetscSqrtReal(tau[0] * tau[0] + tau[1] * tau[1]);
  const PetscBool sticks = (PetscBool)(bound >= PETSC_INFINITY);
  const PetscReal inside = force > bound ? bound / force : 1.0;
  PetscReal       v[2], r, size;

  IPTermLawsMotion(set, s, i, v);
  r    = PetscSqrtReal(v[0] * v[0] + v[1] * v[1] + path->e * path->e);
  size = bound + set->rho[i] * r;
  for (PetscInt b = 0; b < 2; b++) {
    const PetscReal one = a == b ? 1.0 : 0.0, gone = dead[a] * dead[b];

    by_v[b] = sticks ? one - gone : (bound * (one - gone) + inside * tau[a] * v[b] / r) / size;
    by_f[b] = sticks ? gone / set->rho[i] : one * r / size;
  }
  by_f[2] = sticks || set->coefficient[i] < 0.0 || bound >= set->limit[i] ? 0.0 : set->coefficient[i] * v[a] / size;
  *F      = sticks ? v[a] : (r * tau[a] + bound * v[a]) / size;
}

/* Equation and coefficients of a term's row; one that takes no part leaves its force as it is */
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
  if (set->takes[row]) {
    TermPathLinearize(set, s, path, i, a, by_v, by_f, &set->F[row]);
    by_f[a] += tiny / set->rho[i];
  } else by_f[a] = 1.0 / set->rho[i];
  PetscCall(IPTermSystemSetRow(&set->system, row, n, columns, by_v, by_f, PetscSqrtReal(set->rho[i])));
  PetscFunctionReturn(0);
}

/* The longest step, 1 at most, that leaves x positive */
static PetscReal TermPathToBoundary(PetscReal x, PetscReal dx, PetscReal alpha)
{
  const PetscReal short_of = 0.995;

  return dx < 0.0 ? PetscMin(alpha, -short_of * x / dx) : alpha;
}

/* A step of Newton's method on the smooth laws; alpha: its length */
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
    if (!set->takes[i]) continue;
    dw[i]  = path->m / s->lambda[i] - path->w[i] + path->w[i] * set->F[i] / s->lambda[i];
    *alpha = TermPathToBoundary(path->w[i], dw[i], *alpha);
    *alpha = TermPathToBoundary(s->lambda[i], -set->F[i], *alpha);
  }
  for (PetscInt i = 0; i < set->m; i++) {
    if (set->takes[i]) path->w[i] += *alpha * dw[i];
  }
  PetscCall(PetscFree(dw));
  for (PetscInt r = 0; r < s->m; r++) {
    if (set->takes[r]) s->lambda[r] -= *alpha * set->F[r];
  }
  for (PetscInt j = 0; j < s->k; j++) s->y[j] -= *alpha * set->Fy[j];
  IPTermLawsRelieve(set, s);
  PetscCall(IPTermLawsMove(set, s));
  PetscFunctionReturn(0);
}

/* The next m and e: the less of the present ones the longer the last step was */
static void TermPathAdvance(const IPTermSet *set, const IPReducedSystem *s, TermPath *path, PetscReal alpha)
{
  const PetscReal fraction = alpha > 0.9 ? 0.1 : alpha > 0.3 ? 0.3 : 0.7;
  PetscReal       force    = 0.0;

  path->product = 0.0;
  for (PetscInt i = 0; i < set->m; i++) {
    if (!set->takes[i]) continue;
    path->product += s->lambda[i] * path->w[i] / path->n;
    force += s->lambda[i] / path->n;
  }
  path->m = fraction * path->product;
  path->e = path->m / force;
}

/* f, v and y at the end of the path, with what is closed there; *followed is false where it has none. *steps: systems
   solved are added. */
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
  *followed = (PetscBool)(path.n > 0);
  for (PetscInt k = 0; *followed && k < limit && path.product > end * first; k++) {
    TermPathAdvance(set, s, &path, alpha);
    PetscCall(TermPathStep(set, s, &path, &alpha, followed));
    (*steps)++;
  }
  for (PetscInt i = 0; i < set->m; i++)
    set->closed[i] = (PetscBool)(set->takes[i] && s->lambda[i] * set->system.gives[i] > path.w[i]);
  PetscCall(IPTermLawsRenew(set, s));
  PetscCall(PetscFree(path.w));
  PetscFunctionReturn(0);
}
