/*
   The contact problem on the subspace with norm terms, friction among them. With w eliminated and f = (lambda, tau), v the motion of all rows,

     v = C f - RZ y - h,   T y + RZ^T f = t,   lambda >= 0, v_n >= 0, lambda v_n = 0,   tau = P(tau - rho v_t), P the projection to |tau| <= b(lambda),

   where R = [J; T], C = R K_WW^-1 R^T and RZ = R K_WW^-1 Q_W. By a semi-smooth Newton method (Alart and Curnier, A mixed formulation for frictional contact
   problems prone to Newton like solution methods, 1991; Hueeber, Stadler and Wohlmuth, A primal-dual active set algorithm for three-dimensional
   contact problems with Coulomb friction, 2008): rows are open or closed, terms stick, v_t = 0, or slip, tau = b d with d along tau - rho v_t. The
   systems are not symmetric: termsystem.c.
*/
#include "ipfilterimpl.h"
#include <petscblaslapack.h>

PetscErrorCode IPTermSetDestroy(IPTermSet *set)
{
  PetscFunctionBegin;
  PetscCall(PetscFree4(set->limit, set->coefficient, set->rho, set->slope));
  PetscCall(PetscFree3(set->closed, set->slips, set->takes));
  PetscCall(PetscFree5(set->theta, set->way, set->dead, set->F, set->Fy));
  PetscCall(IPTermSystemDestroy(&set->system));
  PetscCall(PetscMemzero(set, sizeof(*set)));
  PetscFunctionReturn(0);
}

/* m constraints, all open, and n terms, all sticking, of rows R; K: K_WW */
PetscErrorCode IPTermSetCreate(PetscInt m, PetscInt n, PetscInt kmax, Mat K, Mat R, IPTermSet *set)
{
  const PetscInt all = m + 2 * n;

  PetscFunctionBegin;
  PetscCall(IPTermSetDestroy(set));
  set->m = m;
  set->n = n;
  PetscCall(PetscCalloc4(n, &set->limit, n, &set->coefficient, n, &set->rho, n, &set->slope));
  PetscCall(PetscCalloc3(m, &set->closed, n, &set->slips, all, &set->takes));
  PetscCall(PetscCalloc5(n, &set->theta, 2 * n, &set->way, 2 * n, &set->dead, all, &set->F, kmax, &set->Fy));
  PetscCall(IPTermSystemSetUp(&set->system, m, n, kmax, K, R));
  PetscFunctionReturn(0);
}

static PetscInt TermRow(const IPTermSet *set, PetscInt term)
{
  return set->m + 2 * term;
}

/* Whether a term can have a force now */
static PetscBool TermTakesPart(const IPTermSet *set, PetscInt i)
{
  if (set->limit[i] == 0.0 || set->coefficient[i] == 0.0) return PETSC_FALSE;
  return (PetscBool)(set->coefficient[i] < 0.0 || set->closed[i]);
}

static PetscReal TermGetBound(const IPTermSet *set, const IPReducedSystem *s, PetscInt i)
{
  return IPTermBound(set->limit[i], set->coefficient[i], set->coefficient[i] < 0.0 ? 0.0 : s->lambda[i]);
}

static PetscReal TermSetLargest(PetscInt n, const PetscReal a[])
{
  PetscReal largest = 0.0;

  for (PetscInt i = 0; i < n; i++) largest = PetscMax(largest, PetscAbsReal(a[i]));
  return largest;
}

/* v = C f - RZ y - h, into s->gap, and the size of its terms */
static PetscErrorCode TermSetMotion(IPTermSet *set, const IPReducedSystem *s)
{
  const PetscReal one = 1.0, minus = -1.0;
  PetscBLASInt    m, k, inc = 1;

  PetscFunctionBegin;
  PetscCall(PetscBLASIntCast(s->m, &m));
  PetscCall(PetscBLASIntCast(s->k, &k));
  PetscCall(IPTermSystemApplyCompliance(&set->system, s->lambda, s->gap));
  for (PetscInt i = 0; i < s->m; i++) set->system.v[i] = -s->h[i];
  if (k && m) PetscCallBLAS("BLASgemv", BLASgemv_("N", &m, &k, &minus, s->JZ, &m, s->y, &inc, &one, set->system.v, &inc));
  set->length = PetscMax(s->length, TermSetLargest(s->m, set->system.v));
  for (PetscInt i = 0; i < s->m; i++) s->gap[i] += set->system.v[i];
  PetscFunctionReturn(0);
}

/* There are no forces along dead directions */
static void TermSetRelieve(const IPTermSet *set, const IPReducedSystem *s)
{
  for (PetscInt i = 0; i < set->n; i++) IPTermRemoveDead(&set->dead[2 * i], &s->lambda[TermRow(set, i)]);
}

/* Opens and closes constraints by what the last step made of them: all, or the last of them alone */
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

/* What gives way to a row, or most to the two of a term */
static PetscReal TermSetGivesWay(const IPTermSet *set, PetscInt row)
{
  const PetscReal *gives = set->system.gives;
  const PetscInt   first = row < set->m ? row : set->m + 2 * ((row - set->m) / 2);

  return PetscMax(gives[first], row < set->m ? 0.0 : gives[first + 1]);
}

/* The rows that take part, as far as anything gives way to them: closed constraints, and the terms that can have a force. The others have none. */
static void TermSetList(IPTermSet *set, const IPReducedSystem *s)
{
  const PetscReal rounding = 1e-14; /* of what gives way most: tangents have that of directions that are held */
  PetscReal       largest  = TermSetLargest(s->m, set->system.gives);

  set->na = 0;
  for (PetscInt r = 0; r < s->m; r++) {
    const PetscBool wanted = r < set->m ? set->closed[r] : TermTakesPart(set, (r - set->m) / 2);

    set->takes[r] = (PetscBool)(wanted && TermSetGivesWay(set, r) > (r < set->m ? 0.0 : rounding * largest));
    set->na += set->takes[r];
    if (!set->takes[r]) s->lambda[r] = 0.0;
  }
}

/* Force per length of the rows of a term, from what they give way by themselves */
static void TermSetResistances(IPTermSet *set)
{
  for (PetscInt i = 0; i < set->n; i++) {
    const PetscReal gives = TermSetGivesWay(set, TermRow(set, i));

    set->rho[i] = gives > 0.0 ? 1.0 / gives : 1.0;
  }
}

/* The motion of a term's two rows, without that along a dead direction */
static void TermMotion(const IPTermSet *set, const IPReducedSystem *s, PetscInt i, PetscReal v[2])
{
  for (PetscInt a = 0; a < 2; a++) v[a] = s->gap[TermRow(set, i) + a];
  IPTermRemoveDead(&set->dead[2 * i], v);
}

/* b = tau - rho v of a term; its size */
static PetscReal TermTrial(const IPTermSet *set, const IPReducedSystem *s, PetscInt i, PetscReal b[2])
{
  PetscReal v[2];

  TermMotion(set, s, i, v);
  for (PetscInt a = 0; a < 2; a++) b[a] = s->lambda[TermRow(set, i) + a] - set->rho[i] * v[a];
  return PetscSqrtReal(b[0] * b[0] + b[1] * b[1]);
}

/* Which terms slip; where a constraint has just closed nothing is known of the bound, and its term sticks for a step, or slips the way it goes */
static PetscBool TermSetSlip(IPTermSet *set, const IPReducedSystem *s, PetscBool sticks)
{
  PetscBool changed = PETSC_FALSE;

  for (PetscInt i = 0; i < set->n; i++) {
    PetscReal b[2];
    PetscBool slips;

    if (!set->takes[TermRow(set, i)]) continue;
    slips         = (PetscBool)(TermTrial(set, s, i, b) > TermGetBound(set, s, i) && (!sticks || set->coefficient[i] < 0.0 || s->lambda[i] != 0.0));
    changed       = (PetscBool)(changed || slips != set->slips[i]);
    set->slips[i] = slips;
  }
  return changed;
}

/* Directions of slip, b / |b|, theta = bound / |b| and the bound's slope, where the equations are linearized */
static void TermSetLinearize(IPTermSet *set, const IPReducedSystem *s)
{
  for (PetscInt i = 0; i < set->n; i++) {
    PetscReal b[2], size, bound;

    if (!set->takes[TermRow(set, i)] || !set->slips[i]) continue;
    size          = TermTrial(set, s, i, b);
    bound         = TermGetBound(set, s, i);
    set->theta[i] = bound / size;
    set->slope[i] = set->coefficient[i] < 0.0 || bound >= set->limit[i] ? 0.0 : set->coefficient[i];
    for (PetscInt a = 0; a < 2; a++) set->way[2 * i + a] = b[a] / size;
  }
}

/* The term of a row, and which of its two it is; negative: a constraint's row */
static PetscInt TermOfRow(const IPTermSet *set, PetscInt row, PetscInt *component)
{
  if (row < set->m) return -1;
  *component = (row - set->m) % 2;
  return (row - set->m) / 2;
}

/* The equations of the rows that take part, lengths: v of closed and sticking rows, (tau - bound d) / rho of slipping ones; largest: of all */
static PetscReal TermSetResidual(IPTermSet *set, const IPReducedSystem *s)
{
  PetscReal largest = 0.0;

  for (PetscInt r = 0; r < s->m; r++) {
    PetscInt       a = 0;
    const PetscInt i = TermOfRow(set, r, &a);

    set->F[r] = 0.0;
    if (!set->takes[r]) continue;
    if (i >= 0 && set->slips[i]) {
      PetscReal       b[2];
      const PetscReal size = TermTrial(set, s, i, b);

      set->F[r] = (s->lambda[r] - (size > 0.0 ? TermGetBound(set, s, i) * b[a] / size : 0.0)) / set->rho[i];
    } else if (i >= 0) {
      const PetscReal *dead = &set->dead[2 * i], *tau = &s->lambda[TermRow(set, i)];
      PetscReal        v[2];

      TermMotion(set, s, i, v);
      set->F[r] = v[a] + dead[a] * (dead[0] * tau[0] + dead[1] * tau[1]) / set->rho[i];
    } else set->F[r] = s->gap[r];
    largest = PetscMax(largest, PetscAbsReal(set->F[r]));
  }
  return largest;
}

/* T y + RZ^T f - t */
static PetscErrorCode TermSetResidualOfDirections(IPTermSet *set, const IPReducedSystem *s)
{
  const PetscReal one = 1.0, minus = -1.0;
  PetscBLASInt    m, k, kmax, inc = 1;

  PetscFunctionBegin;
  if (!s->k) PetscFunctionReturn(0);
  PetscCall(PetscBLASIntCast(s->m, &m));
  PetscCall(PetscBLASIntCast(s->k, &k));
  PetscCall(PetscBLASIntCast(s->kmax, &kmax));
  PetscCall(PetscArraycpy(set->Fy, s->t, s->k));
  PetscCallBLAS("BLASgemv", BLASgemv_("N", &k, &k, &one, s->T, &kmax, s->y, &inc, &minus, set->Fy, &inc));
  PetscCallBLAS("BLASgemv", BLASgemv_("T", &m, &k, &one, s->JZ, &m, s->lambda, &inc, &one, set->Fy, &inc));
  PetscFunctionReturn(0);
}

/*
   The derivative of a row's equation by the v of all rows and by f: coefficients by_v of the two rows of the term, by_f of its two forces and
   of its constraint's. A closed or sticking row has by_v = 1 at itself.
*/
static void TermSetRow(const IPTermSet *set, PetscInt row, PetscReal by_v[2], PetscReal by_f[2], PetscReal *by_lambda)
{
  PetscInt         a   = 0;
  const PetscInt   i   = TermOfRow(set, row, &a);
  const PetscReal *way = &set->way[2 * i], *dead = &set->dead[2 * i];

  by_v[0] = by_v[1] = by_f[0] = by_f[1] = *by_lambda = 0.0;
  if (i < 0) by_v[0] = 1.0;
  for (PetscInt b = 0; i >= 0 && b < 2; b++) {
    const PetscReal one = a == b ? 1.0 : 0.0, alive = one - dead[a] * dead[b], across = one - way[a] * way[b];

    by_f[b] = set->slips[i] ? (one - set->theta[i] * across) / set->rho[i] : (one - alive) / set->rho[i];
    by_v[b] = set->slips[i] ? set->theta[i] * (across - dead[a] * dead[b]) : alive; /* a dead direction is across the way */
  }
  if (i >= 0 && set->slips[i]) *by_lambda = -set->slope[i] * way[a] / set->rho[i];
}

/* One row of the system, its diagonal raised by as little as makes dependent rows no obstacle. Rows of terms depend on one another wherever some of what they
   touch is held: their residuals, to which the diagonal adds nothing, are what counts. A row that takes no part leaves its force as it is. */
static PetscErrorCode TermSetAssembleRow(IPTermSet *set, PetscInt row)
{
  const PetscReal shift = 1e-13, terms = 1e-9, gives = TermSetGivesWay(set, row);
  PetscInt        a = 0, n = 0, columns[3];
  const PetscInt  i       = TermOfRow(set, row, &a);
  PetscReal       by_v[3] = {0.0, 0.0, 0.0}, by_f[3] = {0.0, 0.0, 0.0}, scale = i < 0 ? 1.0 : PetscSqrtReal(set->rho[i]);

  PetscFunctionBegin;
  if (i < 0 && gives > 0.0) scale = 1.0 / PetscSqrtReal(gives);
  columns[n++] = i < 0 ? row : TermRow(set, i);
  if (i >= 0) columns[n++] = TermRow(set, i) + 1;
  if (i >= 0 && i < set->m) columns[n++] = i;
  if (set->takes[row]) {
    TermSetRow(set, row, by_v, by_f, &by_f[2]);
    by_f[a] += (i < 0 ? shift : terms) * gives;
  } else by_f[a] = 1.0 / (scale * scale);
  PetscCall(IPTermSystemSetRow(&set->system, row, n, columns, by_v, by_f, scale));
  PetscFunctionReturn(0);
}

/* One step of Newton's method from f and y */
static PetscErrorCode TermSetStep(IPTermSet *set, const IPReducedSystem *s, PetscReal rtol, PetscBool *solved)
{
  PetscFunctionBegin;
  TermSetLinearize(set, s);
  for (PetscInt r = 0; r < s->m; r++) PetscCall(TermSetAssembleRow(set, r));
  PetscCall(IPTermSystemAssemble(&set->system));
  PetscCall(IPTermSystemSolve(&set->system, s, rtol, set->F, set->Fy, solved));
  if (!*solved) PetscFunctionReturn(0);
  for (PetscInt r = 0; r < s->m; r++)
    if (set->takes[r]) s->lambda[r] -= set->F[r];
  for (PetscInt j = 0; j < s->k; j++) s->y[j] -= set->Fy[j];
  TermSetRelieve(set, s);
  PetscCall(TermSetMotion(set, s));
  PetscFunctionReturn(0);
}

/* How far f and v are from the laws, lengths: the sum of squares over all rows, constraints by min(lambda / rho, v), terms by |tau - P(tau - rho v)| / rho */
static PetscReal TermSetMerit(const IPTermSet *set, const IPReducedSystem *s)
{
  PetscReal merit = 0.0;

  for (PetscInt i = 0; i < set->m; i++) {
    if (set->takes[i]) merit += PetscSqr(PetscMin(s->lambda[i] * set->system.gives[i], s->gap[i]));
    else merit += PetscSqr(PetscMin(0.0, s->gap[i]));
  }
  for (PetscInt i = 0; i < set->n; i++) {
    PetscReal v[2];

    if (!set->takes[TermRow(set, i)]) continue;
    TermMotion(set, s, i, v);
    merit += PetscSqr(IPTermViolation(&s->lambda[TermRow(set, i)], v, set->rho[i], TermGetBound(set, s, i)));
  }
  return merit;
}

/* x := x0 + alpha (x - x0) */
static void TermSetBlend(PetscInt n, PetscReal alpha, const PetscReal x0[], PetscReal x[])
{
  for (PetscInt i = 0; i < n; i++) x[i] = x0[i] + alpha * (x[i] - x0[i]);
}

/* Back along the last step, from where f, v and y were, to the best of some points on it: v is linear */
static PetscErrorCode TermSetSearch(IPTermSet *set, const IPReducedSystem *s, const PetscReal f[], const PetscReal v[], const PetscReal y[])
{
  const PetscInt halvings = 8;
  PetscReal      least = TermSetMerit(set, s), best = 1.0, alpha = 1.0, *trial;

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
    merit = TermSetMerit(set, &at);
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

/* The same, and as far along it as it leads to the laws */
static PetscErrorCode TermSetCarefulStep(IPTermSet *set, const IPReducedSystem *s, PetscReal rtol, PetscBool *solved)
{
  PetscReal *before;

  PetscFunctionBegin;
  PetscCall(PetscMalloc1(2 * s->m + s->k, &before));
  PetscCall(PetscArraycpy(before, s->lambda, s->m));
  PetscCall(PetscArraycpy(before + s->m, s->gap, s->m));
  PetscCall(PetscArraycpy(before + 2 * s->m, s->y, s->k));
  PetscCall(TermSetStep(set, s, rtol, solved));
  if (*solved) PetscCall(TermSetSearch(set, s, before, before + s->m, before + 2 * s->m));
  PetscCall(PetscFree(before));
  PetscFunctionReturn(0);
}

/* The rows that take part at f and y, and their v */
static PetscErrorCode TermSetRenew(IPTermSet *set, const IPReducedSystem *s)
{
  PetscFunctionBegin;
  TermSetList(set, s);
  TermSetRelieve(set, s);
  PetscCall(TermSetMotion(set, s));
  set->listed = PETSC_TRUE;
  PetscFunctionReturn(0);
}

/* How long ago the laws have last been met better than ever before, in steps */
static PetscInt TermSetFutile(const IPTermSet *set, const IPReducedSystem *s, PetscReal *least, PetscInt futile)
{
  const PetscReal merit = TermSetMerit(set, s);

  if (!(merit < *least)) return futile + 1;
  *least = merit;
  return 0;
}

/* The root of the energy that the residuals stand for */
static PetscReal TermSetNorm(const IPTermSet *set, const IPReducedSystem *s)
{
  PetscReal sum = 0.0;

  for (PetscInt r = 0; r < s->m; r++) {
    if (set->takes[r]) sum += PetscSqr(set->F[r]) / TermSetGivesWay(set, r);
  }
  for (PetscInt j = 0; j < s->k; j++) sum += PetscSqr(set->Fy[j]);
  return PetscSqrtReal(sum);
}

/* Opens, closes, and tells what slips; *changed: whether anything is not what it was */
static PetscErrorCode TermSetExchange(IPTermSet *set, const IPReducedSystem *s, PetscBool all, PetscBool sticks, PetscBool *changed)
{
  PetscFunctionBegin;
  *changed = TermSetClose(set, s, all);
  if (*changed) PetscCall(TermSetRenew(set, s));
  if (TermSetSlip(set, s, sticks)) *changed = PETSC_TRUE;
  PetscFunctionReturn(0);
}

/* f (in s->lambda), v (in s->gap) and y, from the last ones, to a small part of what the laws and the directions are off by there, as the directions to come
   leave much more; *steps: systems solved; *solved is false where Newton's method has no end. Where v and f are right but for rounding, it does not matter
   what rounding takes them for. */
PetscErrorCode IPTermSetSolve(IPTermSet *set, const IPReducedSystem *s, PetscInt *steps, PetscBool *solved)
{
  const PetscInt  limit = 400, patience = 3, stuck = 4, cycles = 25;
  const PetscReal exact = 1e-12, rounding = 1e-9, enough = 1e-3, coarse = 1e-2, fine = 1e-10;
  PetscReal       before = PETSC_INFINITY, least = PETSC_INFINITY, first = 0.0;
  PetscInt        futile = 0, careful = 0;

  PetscFunctionBegin;
  TermSetResistances(set);
  if (set->listed) PetscCall(TermSetMotion(set, s));
  else PetscCall(TermSetRenew(set, s));
  for (*steps = 0; *steps < limit; (*steps)++) {
    PetscReal largest, norm, rtol;
    PetscBool changed;

    PetscCall(TermSetExchange(set, s, (PetscBool)(careful < cycles), (PetscBool)(careful < stuck), &changed));
    largest = TermSetResidual(set, s);
    PetscCall(TermSetResidualOfDirections(set, s));
    norm    = TermSetNorm(set, s);
    *solved = (PetscBool)(*steps > 0 && !changed && norm <= enough * first);
    if (*steps > 0 && (largest <= exact * set->length || (largest <= rounding * set->length && largest > 0.5 * before)) && norm <= 0.1 * first) *solved = PETSC_TRUE;
    if (*solved) PetscFunctionReturn(0);
    first  = PetscMax(norm, first);
    before = largest;
    if (*steps) futile = TermSetFutile(set, s, &least, futile);
    rtol = changed ? coarse : PetscClipInterval(0.5 * enough * first / norm, fine, coarse);
    if (futile < patience && !careful) PetscCall(TermSetStep(set, s, rtol, solved));
    else {
      PetscCall(TermSetCarefulStep(set, s, rtol, solved));
      careful++;
    }
    if (!*solved) PetscFunctionReturn(0);
  }
  *solved = PETSC_FALSE;
  PetscFunctionReturn(0);
}
