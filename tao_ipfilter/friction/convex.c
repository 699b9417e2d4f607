/*
   Solves the problem with the laws of laws.c if Newton's method fails. The bounds b are fixed at the values for the
   last forces and updated in rounds (Haslinger, Approximation of the Signorini problem with friction, obeying the
   Coulomb law, 1983). With fixed b the problem is convex. Its augmented Lagrangian (Rockafellar, Augmented Lagrangians
   and applications of the proximal point algorithm in convex programming, 1976) is convex and once differentiable, with
   the forces f = p(v):
     lambda = max(0, lambda' - rho v_n),  tau = P_b(tau' - rho v_t),
   where f' = (lambda', tau') are the multipliers of the last round. Newton's method with a line search finds its
   minimum from any start. The equations of sticking rows are linear.

   A body that no constraint holds at present would move without limit. Springs between the coordinates y and their
   values at the start of the round hold it (Rockafellar calls this the proximal method of multipliers). They exert no
   force at the end, since y no longer changes from round to round. A body that nothing ever presses stays where it is.
*/
#include "frictionimpl.h"

typedef struct {
  PetscReal *multiplier; /* multipliers f' of all rows [force] */
  PetscReal *bound;      /* bounds b of all terms [force] */
  PetscReal *p;          /* forces p(v) of all rows [force] */
  PetscReal *f, *v, *y;  /* forces, motions and coefficients at the start of a Newton step */
  PetscReal *centre;     /* coefficients at the start of the round */
  PetscReal  largest;    /* largest compliance of a row [length/force] */
} TermConvex;

/*
   Returns the penalty stiffness rho of a row, a hundred times the inverse of its compliance [force/length]. Larger
   values need fewer rounds.
*/
static PetscReal ConvexStiffness(const IPTermSet *set, PetscInt row)
{
  const PetscReal times = 100.0;

  return times / IPTermLawsCompliance(set, row);
}

/* Returns whether a row can carry a force: neither its compliance nor its bound is zero */
static PetscBool ConvexIsActive(const IPTermSet *set, const TermConvex *convex, PetscInt row)
{
  const PetscReal rounding = 1e-14, compliance = IPTermLawsCompliance(set, row);

  if (row < set->m) return (PetscBool)(compliance > 0.0);
  return (PetscBool)(compliance > rounding * convex->largest && convex->bound[(row - set->m) / 2] > 0.0);
}

/* Computes b = tau' - rho v of term i, without the component that cannot move. Returns |b|. */
static PetscReal ConvexTrial(const IPTermSet *set, const TermConvex *convex, const PetscReal v[], PetscInt i,
  PetscReal b[2])
{
  const PetscInt  row = IPTermLawsRow(set, i);
  const PetscReal rho = ConvexStiffness(set, row);

  for (PetscInt a = 0; a < 2; a++) b[a] = convex->multiplier[row + a] - rho * v[row + a];
  IPTermRemoveRigid(&set->rigid[2 * i], b);
  return PetscSqrtReal(b[0] * b[0] + b[1] * b[1]);
}

/* Computes the forces p(v) of all rows */
static void ConvexForces(const IPTermSet *set, const TermConvex *convex, const PetscReal v[], PetscReal p[])
{
  for (PetscInt r = 0; r < set->m; r++)
    p[r] = ConvexIsActive(set, convex, r) ? PetscMax(0.0, convex->multiplier[r] - ConvexStiffness(set, r) * v[r]) : 0.0;
  for (PetscInt i = 0; i < set->n; i++) {
    const PetscInt row = IPTermLawsRow(set, i);
    PetscReal      b[2], size, factor;

    p[row] = p[row + 1] = 0.0;
    if (!ConvexIsActive(set, convex, row)) continue;
    size   = ConvexTrial(set, convex, v, i, b);
    factor = size > convex->bound[i] ? convex->bound[i] / size : 1.0;
    for (PetscInt a = 0; a < 2; a++) p[row + a] = factor * b[a];
  }
}

/*
   Computes the residual set->F[row] of a row that can carry a force, and its derivatives: by_v by the two motions of
   its term, by_f by the two forces. A constraint uses the first entry only. The slip law is written as |b| tau = bound
   b instead of tau = bound b/|b|, and its derivative is made symmetric. Newton's method then converges from distant
   starts (Chan, Golub and Mulet, A nonlinear primal-dual method for total variation-based image restoration, 1999).
*/
static void ConvexLinearize(IPTermSet *set, const IPReducedSystem *s, const TermConvex *convex, PetscInt row,
  PetscReal by_v[2], PetscReal by_f[2])
{
  const PetscReal  rho = ConvexStiffness(set, row);
  PetscInt         a   = 0;
  const PetscInt   i   = IPTermLawsOfRow(set, row, &a);
  const PetscReal *tau = i < 0 ? NULL : &s->lambda[IPTermLawsRow(set, i)];
  PetscReal        b[2], size, force, inside;

  set->F[row] = (s->lambda[row] - convex->p[row]) / rho;
  by_v[0] = by_v[1] = by_f[0] = by_f[1] = 0.0;
  by_f[a]                               = 1.0 / rho;
  if (i < 0) {
    by_v[0] = convex->p[row] > 0.0 ? 1.0 : 0.0;
    return;
  }
  size   = ConvexTrial(set, convex, s->gap, i, b);
  force  = PetscSqrtReal(tau[0] * tau[0] + tau[1] * tau[1]);
  inside = force > convex->bound[i] ? convex->bound[i] / force : 1.0;
  for (PetscInt c = 0; c < 2; c++) {
    const PetscReal alive = (a == c ? 1.0 : 0.0) - set->rigid[2 * i + a] * set->rigid[2 * i + c];

    by_v[c] = size > convex->bound[i]
                ? (convex->bound[i] * alive - 0.5 * inside * (tau[a] * b[c] + tau[c] * b[a]) / size) / size
                : alive;
  }
}

/*
   Assembles one row of the system. The entry in the column of a term's constraint is zero, since b is fixed. A row that
   cannot carry a force gets the equation f = 0.
*/
static PetscErrorCode ConvexAssembleRow(IPTermSet *set, const IPReducedSystem *s, const TermConvex *convex,
  PetscInt row)
{
  const PetscReal compliance = IPTermLawsCompliance(set, row), unit = compliance > 0.0 ? compliance : 1.0;
  PetscInt        a = 0, n = 0, columns[3];
  const PetscInt  i       = IPTermLawsOfRow(set, row, &a);
  PetscReal       by_v[3] = {0.0, 0.0, 0.0}, by_f[3] = {0.0, 0.0, 0.0};

  PetscFunctionBegin;
  columns[n++] = i < 0 ? row : IPTermLawsRow(set, i);
  if (i >= 0) columns[n++] = IPTermLawsRow(set, i) + 1;
  if (i >= 0 && i < set->m) columns[n++] = i;
  if (ConvexIsActive(set, convex, row)) ConvexLinearize(set, s, convex, row, by_v, by_f);
  else {
    set->F[row] = s->lambda[row] * unit;
    by_f[a]     = unit;
  }
  PetscCall(IPTermSystemSetRow(&set->system, row, n, columns, by_v, by_f, 1.0 / PetscSqrtReal(unit)));
  PetscFunctionReturn(0);
}

static PetscReal ConvexDot(PetscInt n, const PetscReal a[], const PetscReal b[])
{
  PetscReal sum = 0.0;

  for (PetscInt i = 0; i < n; i++) sum += a[i] * b[i];
  return sum;
}

/*
   Returns the derivative of the augmented Lagrangian along the Newton step, at the fraction alpha of the step. Fy:
   residuals of the directions' equations at the start of the step; dFy: their change over the full step; trial: work
   space.
*/
static PetscReal ConvexSlope(const IPTermSet *set, const IPReducedSystem *s, const TermConvex *convex,
  const PetscReal Fy[], const PetscReal dFy[], PetscReal alpha, PetscReal trial[])
{
  PetscReal slope = 0.0, *p = trial + s->m;

  for (PetscInt r = 0; r < s->m; r++) trial[r] = convex->v[r] + alpha * (s->gap[r] - convex->v[r]);
  ConvexForces(set, convex, trial, p);
  for (PetscInt r = 0; r < s->m; r++)
    slope += (s->gap[r] - convex->v[r]) * (convex->f[r] + alpha * (s->lambda[r] - convex->f[r]) - p[r]);
  for (PetscInt j = 0; j < s->k; j++) slope += (s->y[j] - convex->y[j]) * (Fy[j] + alpha * dFy[j]);
  return slope;
}

/*
   Returns the largest fraction of the step that moves no row by more than 100 times set->length. This limits the step
   of bodies that nothing holds at present.
*/
static PetscReal ConvexFarthest(const IPTermSet *set, const IPReducedSystem *s, const TermConvex *convex)
{
  const PetscReal much    = 100.0;
  PetscReal       largest = 0.0;

  for (PetscInt r = 0; r < s->m; r++) largest = PetscMax(largest, PetscAbsReal(s->gap[r] - convex->v[r]));
  return largest > much * set->length ? much * set->length / largest : 1.0;
}

/* Computes the residual set->Fy of the directions' equations, with the forces that hold y at its centre */
static PetscErrorCode ConvexResidualOfDirections(IPTermSet *set, const IPReducedSystem *s, const TermConvex *convex)
{
  PetscFunctionBegin;
  PetscCall(IPTermLawsResidualOfDirections(set, s));
  for (PetscInt j = 0; j < s->k; j++) set->Fy[j] += set->system.hold * s->G[j] * (s->y[j] - convex->centre[j]);
  PetscFunctionReturn(0);
}

/*
   Moves the state to the minimum of the augmented Lagrangian along the Newton step, at the fraction *alpha. *fell:
   minus the derivative at the start of the step.
*/
static PetscErrorCode ConvexSearch(IPTermSet *set, const IPReducedSystem *s, const TermConvex *convex, PetscReal Fy[],
  PetscReal *fell, PetscReal *alpha)
{
  const PetscInt  bisections = 30;
  const PetscReal flat       = 1e-2;
  PetscReal      *trial, low = 0.0, high = ConvexFarthest(set, s, convex), end;

  PetscFunctionBegin;
  PetscCall(PetscMalloc1(2 * s->m, &trial));
  PetscCall(ConvexResidualOfDirections(set, s, convex));
  for (PetscInt j = 0; j < s->k; j++) set->Fy[j] -= Fy[j];
  *fell  = -ConvexSlope(set, s, convex, Fy, set->Fy, 0.0, trial);
  end    = ConvexSlope(set, s, convex, Fy, set->Fy, high, trial);
  *alpha = high;
  for (PetscInt k = 0; k < bisections && end > flat * *fell; k++) {
    PetscReal slope;

    *alpha = 0.5 * (low + high);
    slope  = ConvexSlope(set, s, convex, Fy, set->Fy, *alpha, trial);
    if (PetscAbsReal(slope) <= flat * *fell) break;
    if (slope > 0.0) high = *alpha;
    else low = *alpha;
  }
  for (PetscInt r = 0; r < s->m && *alpha < 1.0; r++) {
    s->lambda[r] = convex->f[r] + *alpha * (s->lambda[r] - convex->f[r]);
    s->gap[r]    = convex->v[r] + *alpha * (s->gap[r] - convex->v[r]);
  }
  for (PetscInt j = 0; j < s->k && *alpha < 1.0; j++) s->y[j] = convex->y[j] + *alpha * (s->y[j] - convex->y[j]);
  PetscCall(PetscFree(trial));
  PetscFunctionReturn(0);
}

/*
   Takes one Newton step on the augmented Lagrangian. *fell: minus its derivative along the step at the start [energy];
   *alpha: fraction of the step that was taken.
*/
static PetscErrorCode ConvexStep(IPTermSet *set, const IPReducedSystem *s, TermConvex *convex, PetscReal rtol,
  PetscReal *fell, PetscReal *alpha, PetscBool *solved)
{
  PetscReal *Fy;

  PetscFunctionBegin;
  ConvexForces(set, convex, s->gap, convex->p);
  for (PetscInt r = 0; r < s->m; r++) PetscCall(ConvexAssembleRow(set, s, convex, r));
  PetscCall(IPTermSystemAssemble(&set->system));
  PetscCall(ConvexResidualOfDirections(set, s, convex));
  PetscCall(PetscMalloc1(s->k, &Fy));
  PetscCall(PetscArraycpy(Fy, set->Fy, s->k));
  PetscCall(PetscArraycpy(convex->f, s->lambda, s->m));
  PetscCall(PetscArraycpy(convex->v, s->gap, s->m));
  PetscCall(PetscArraycpy(convex->y, s->y, s->k));
  PetscCall(IPTermSolve(&set->system, s, rtol, set->F, set->Fy, solved));
  if (*solved) {
    for (PetscInt r = 0; r < s->m; r++) s->lambda[r] -= set->F[r];
    for (PetscInt j = 0; j < s->k; j++) s->y[j] -= set->Fy[j];
    PetscCall(IPTermLawsMove(set, s));
    PetscCall(ConvexSearch(set, s, convex, Fy, fell, alpha));
  }
  PetscCall(PetscFree(Fy));
  PetscFunctionReturn(0);
}

/*
   Minimizes the augmented Lagrangian until a step is predicted to gain less than `energy`. *solved: false if the
   Lagrangian is not convex, or is unbounded below.
*/
static PetscErrorCode ConvexMinimize(IPTermSet *set, const IPReducedSystem *s, TermConvex *convex, PetscReal energy,
  PetscInt *steps, PetscBool *solved)
{
  const PetscInt  limit = 40;
  const PetscReal rtol = 1e-6, rounding = 1e-6, exact = 1e-12;
  PetscReal       fell = PETSC_INFINITY, most = 0.0, alpha = 1.0;

  PetscFunctionBegin;
  for (PetscInt k = 0; k < limit; k++) {
    PetscCall(ConvexStep(set, s, convex, rtol, &fell, &alpha, solved));
    (*steps)++;
    *solved = (PetscBool)(*solved && fell >= -PetscMax(energy, rounding * most));
    if (!*solved) PetscFunctionReturn(0);
    most = PetscMax(most, fell);
    if (fell <= energy) break;
  }
  *solved = (PetscBool)(fell <= PetscMax(energy, exact * most));
  PetscFunctionReturn(0);
}

/*
   Sets the bounds b from the multipliers. At the beginning, if there are no forces yet, all terms stick. late:
   bounds of terms with a very large coefficient are not increased any more, since such a row might alternate between
   stick and open without end.
*/
static void ConvexSetBounds(const IPTermSet *set, TermConvex *convex, PetscBool begin, PetscBool late)
{
  const PetscReal large = 100.0;
  PetscBool       known = PETSC_FALSE;

  for (PetscInt i = 0; i < set->m; i++) known = (PetscBool)(known || convex->multiplier[i] > 0.0);
  for (PetscInt i = 0; i < set->n; i++) {
    const PetscReal force = set->coefficient[i] < 0.0 ? 0.0 : convex->multiplier[i];
    const PetscReal bound = known || !begin || set->coefficient[i] < 0.0
                              ? IPTermBound(set->limit[i], set->coefficient[i], force)
                            : set->coefficient[i] == 0.0 ? 0.0
                                                         : set->limit[i];

    convex->bound[i] = late && set->coefficient[i] >= large ? PetscMin(bound, convex->bound[i]) : bound;
  }
}

/* Computes the sum of the squared residuals of the laws and of the directions' equations, weighted as an energy */
static PetscErrorCode ConvexOff(IPTermSet *set, const IPReducedSystem *s, PetscReal *energy)
{
  PetscFunctionBegin;
  PetscCall(IPTermLawsResidualOfDirections(set, s));
  *energy = IPTermLawsMerit(set, s) + ConvexDot(s->k, set->Fy, set->Fy);
  PetscFunctionReturn(0);
}

/* Marks constraints with positive force as closed, and updates the list of active rows */
static void ConvexMarkClosed(IPTermSet *set, const IPReducedSystem *s)
{
  for (PetscInt i = 0; i < set->m; i++) set->closed[i] = (PetscBool)(s->lambda[i] > 0.0);
  IPTermLawsList(set, s);
}

/*
   Computes f, v and y whose residual is a small fraction of `first` (the square root of an energy). If the largest
   number of rounds is reached, the residual may be larger. Forces and motions are in equilibrium in either case.
   *solved: false if nothing holds a moving body. *steps is increased by the number of systems solved.
*/
PetscErrorCode IPTermConvexSolve(IPTermSet *set, const IPReducedSystem *s, PetscReal first, PetscInt *steps,
  PetscBool *solved)
{
  const PetscInt  rounds = 20;
  const PetscReal enough = 1e-3, fine = 1e-2, fair = 0.5;
  const PetscReal hold   = 1e-6; /* relative to the stiffness of the bodies; rounding errors limit smaller values */
  const PetscReal most   = 0.9;  /* share of the springs' forces in the residual that shows a body without support */
  const PetscReal wanted = PetscSqr(PetscMax(enough * first, IPTermLawsRounding(set, s)));
  PetscReal       off = PETSC_INFINITY, least = PETSC_INFINITY;
  PetscBool       late = PETSC_FALSE, end = PETSC_FALSE;
  TermConvex      convex = {.largest = 0.0};

  PetscFunctionBegin;
  PetscCall(PetscMalloc3(s->m, &convex.multiplier, set->n, &convex.bound, s->m, &convex.p));
  PetscCall(PetscMalloc4(s->m, &convex.f, s->m, &convex.v, s->k, &convex.y, s->k, &convex.centre));
  for (PetscInt r = 0; r < s->m; r++) convex.largest = PetscMax(convex.largest, set->system.compliance[r]);
  for (PetscInt i = 0; i < set->m; i++) s->lambda[i] = PetscMax(s->lambda[i], 0.0);
  PetscCall(IPTermLawsMove(set, s));
  *solved               = PETSC_TRUE;
  set->system.symmetric = set->convex_next;
  set->system.hold      = hold;
  for (PetscInt k = 0; k < rounds && *solved && !end; k++) {
    if (k) ConvexForces(set, &convex, s->gap, convex.p);
    PetscCall(PetscArraycpy(convex.multiplier, k ? convex.p : s->lambda, s->m));
    ConvexSetBounds(set, &convex, (PetscBool)!k, late);
    PetscCall(PetscArraycpy(convex.centre, s->y, s->k));
    PetscCall(ConvexMinimize(set, s, &convex, fine * PetscMax(wanted, k ? off : 0.0), steps, solved));
    ConvexMarkClosed(set, s);
    PetscCall(ConvexOff(set, s, &off));
    if (off <= wanted) *solved = PETSC_TRUE;
    end   = (PetscBool)(off <= wanted || (late && off > fair * least));
    late  = (PetscBool)(late || (k > 1 && off > fair * least));
    least = PetscMin(least, off);
  }
  set->met              = (PetscBool)(off <= wanted);
  set->slides           = (PetscBool)(!set->met && ConvexDot(s->k, set->Fy, set->Fy) > most * off);
  set->system.hold      = 0.0;
  set->system.symmetric = PETSC_FALSE;
  PetscCall(PetscFree3(convex.multiplier, convex.bound, convex.p));
  PetscCall(PetscFree4(convex.f, convex.v, convex.y, convex.centre));
  PetscFunctionReturn(0);
}
