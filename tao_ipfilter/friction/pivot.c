/*
   Solves the laws of laws.c by pivoting, if Newton's method fails. Each component a of a term has its own law,
     |tau_a| <= b,  b = mu lambda + limit,  v_a = 0 or tau_a = -b sign(v_a).
   The problem is then piecewise linear. It has a solution for every mu if the bodies are held (Haslinger, Approximation
   of the Signorini problem with friction, obeying the Coulomb law, 1983). Its data are changed until the present state
   solves it, and are led back along a line. The solution follows a path of linear pieces, on which the parameter of the
   line may also fall (Lemke, Bimatrix equilibrium points and mathematical programming, 1965; Dirkse and Ferris, The
   PATH solver, 1995). Newton's method starts at the end of the path.
*/
#include "frictionimpl.h"

/* Returns a number between 0.5 and 1.5, which is different at each call but the same in each run */
static PetscReal PivotNext(IPTableau *p)
{
  const PetscInt64 prime = 2147483647, factor = 48271;

  p->seed = p->seed * factor % prime;
  return 0.5 + (PetscReal)p->seed / (PetscReal)prime;
}

/* Changes the sign s of component a of term i. Its force and that of its constraint are both nonbasic or both basic. */
static void PivotTurn(IPTableau *p, PetscInt i, PetscInt a)
{
  const PetscInt force = p->place[p->m + 2 * i + a], normal = i < p->m ? p->place[i] : 0;
  PetscReal      b = 2.0 * p->limit[i];

  p->sign[2 * i + a] = -p->sign[2 * i + a];
  if (force < 0) {
    PetscReal *c = IPTableauColumn(p, -1 - force), *to = p->mu[i] > 0.0 ? IPTableauColumn(p, -1 - normal) : NULL;

    for (PetscInt r = 0; r < p->rows; r++) {
      if (to) to[r] += 2.0 * p->mu[i] * c[r];
      p->q[r] += b * c[r];
      c[r] = -c[r];
    }
    return;
  }
  for (PetscInt j = 0; j <= p->rows; j++) {
    PetscReal *c = IPTableauColumn(p, j);

    c[force] = (p->mu[i] > 0.0 ? 2.0 * p->mu[i] * c[normal] : 0.0) - c[force];
  }
  p->q[force] = (p->mu[i] > 0.0 ? 2.0 * p->mu[i] * p->q[normal] : 0.0) + b - p->q[force];
}

/*
   Changes q such that the present state solves the problem, and no two variables have the same distance from their
   bounds. Sets the column of the parameter: q has its original value where the parameter is 1.
*/
static void PivotBegin(IPTableau *p, PetscBool open)
{
  const PetscReal small = open ? 1e-2 : 1e-5, tangential = 1e-6;
  PetscReal       size = 0.0, *column = IPTableauColumn(p, p->rows);

  for (PetscInt r = 0; r < p->rows; r++) size = PetscMax(size, PetscAbsReal(p->q[r]));
  for (PetscInt r = 0; r < p->rows; r++) column[r] = p->q[r];
  for (PetscInt r = 0; r < p->rows; r++) {
    PetscInt        a;
    const PetscInt  i    = IPTableauTerm(p, r, &a);
    const PetscReal away = small * size * PivotNext(p);

    if (open && i >= 0) p->q[r] = tangential * size * (PivotNext(p) - 1.0);
    if (p->dropped[r]) continue;
    if (i < 0) p->q[r] = (p->q[r] > 0.0 ? p->q[r] : 0.0) + away;
    else if (p->sticks[2 * i + a]) {
      const PetscReal b = p->limit[i] + (p->mu[i] > 0.0 && p->closed[i] ? p->mu[i] * p->q[i] : 0.0);

      p->q[r] = PetscClipInterval(p->q[r], 0.1 * b * PivotNext(p), (2.0 - 0.1 * PivotNext(p)) * b);
    } else if (i >= p->m || p->closed[i]) {
      const PetscReal slip = p->sign[2 * i + a] * p->q[r];

      p->q[r] = p->sign[2 * i + a] * (PetscMax(0.0, slip) + away);
    }
  }
  for (PetscInt r = 0; r < p->rows; r++) column[r] -= p->q[r];
}

/* How far the driving variable may move: what it reaches first */
typedef struct {
  PetscReal most, slope; /* the largest step so far; size of the slope at it */
  PetscInt  row;         /* row of the variable that reaches a bound; PIVOT_ITSELF: the driving variable does */
  PetscBool upper;       /* whether that is its upper bound */
} PivotLimit;

enum { PIVOT_ITSELF = -2 };

static void PivotTry(PivotLimit *limit, PetscInt row, PetscBool upper, PetscReal value, PetscReal slope)
{
  const PetscReal tiny = 1e-11, same = 1e-12;
  PetscReal       step;

  if (slope >= -tiny) return;
  step = PetscMax(value, 0.0) / -slope;
  if (step > limit->most + same * limit->most || (step >= limit->most - same * limit->most && -slope <= limit->slope))
    return;
  *limit = (PivotLimit){.most = step, .slope = -slope, .row = row, .upper = upper};
}

/* Finds the first basic variable that reaches a bound as the driving variable moves. limit->row: -1 if none does. */
static void PivotFindLimit(const IPTableau *p, PivotLimit *limit)
{
  const PetscReal *c = IPTableauColumn(p, -1 - p->place[p->driving]);

  *limit = (PivotLimit){.most = PETSC_INFINITY, .row = -1};
  for (PetscInt r = 0; r < p->rows; r++) {
    const PetscInt  variable = p->basic[r], row = variable % p->rows;
    const PetscReal slope = p->direction * c[r];
    PetscInt        a;
    const PetscInt  i = IPTableauTerm(p, row, &a);

    if (variable == 2 * p->rows) {
      PivotTry(limit, r, PETSC_TRUE, 1.0 - p->q[r], -slope);
      PivotTry(limit, r, PETSC_FALSE, p->q[r], slope);
    } else if (p->dropped[row]) continue;
    else if (i < 0) PivotTry(limit, r, PETSC_FALSE, p->q[r], slope);
    else if (variable >= p->rows) {
      if (i >= p->m || p->closed[i] || p->mu[i] == 0.0)
        PivotTry(limit, r, PETSC_FALSE, p->sign[2 * i + a] * p->q[r], p->sign[2 * i + a] * slope);
    } else {
      const PetscInt  normal = i < p->m ? p->place[i] : -1;
      const PetscReal rate   = normal >= 0       ? p->direction * c[normal]
                               : p->driving == i ? p->direction
                                                 : 0.0,
                      bound  = p->limit[i] + (normal >= 0 ? p->mu[i] * p->q[normal] : 0.0);

      PivotTry(limit, r, PETSC_FALSE, p->q[r], slope);
      PivotTry(limit, r, PETSC_TRUE, 2.0 * bound - p->q[r], 2.0 * p->mu[i] * rate - slope);
    }
  }
  if (p->driving >= p->m && p->driving < p->rows) {
    PetscInt        a;
    const PetscInt  i = IPTableauTerm(p, p->driving, &a), normal = p->mu[i] > 0.0 ? p->place[i] : -1;
    const PetscReal rate  = normal >= 0 ? p->mu[i] * p->direction * c[normal] : 0.0,
                    bound = p->limit[i] + (normal >= 0 ? p->mu[i] * p->q[normal] : 0.0);

    PivotTry(limit, PIVOT_ITSELF, PETSC_TRUE, 2.0 * bound, 2.0 * rate - 1.0);
  }
}

/*
   Replaces the driving variable sigma, which has reached its upper bound 2 b, by 2 b - sigma. The term then slips the
   other way.
*/
static PetscErrorCode PivotPass(IPTableau *p)
{
  const PetscInt column = -1 - p->place[p->driving];
  PetscInt       a;
  const PetscInt i = IPTableauTerm(p, p->driving, &a), normal = p->mu[i] > 0.0 ? p->place[i] : -1;
  PetscReal     *c = IPTableauColumn(p, column), *along, by, constant = 2.0 * p->limit[i];

  PetscFunctionBegin;
  PetscCall(PetscMalloc1(p->rows + 1, &along));
  for (PetscInt j = 0; j <= p->rows; j++) along[j] = normal >= 0 ? 2.0 * p->mu[i] * IPTableauColumn(p, j)[normal] : 0.0;
  if (normal >= 0) constant += 2.0 * p->mu[i] * p->q[normal];
  by = 1.0 / (along[column] - 1.0);
  for (PetscInt j = 0; j <= p->rows; j++) along[j] *= by;
  along[column] = 0.0;
  for (PetscInt r = 0; r < p->rows; r++) p->q[r] -= c[r] * by * constant;
  PetscCall(IPTableauSubtract(p, c, along));
  for (PetscInt r = 0; r < p->rows; r++) c[r] *= by;
  PetscCall(PetscFree(along));
  p->sign[2 * i + a]   = -p->sign[2 * i + a];
  p->sticks[2 * i + a] = PETSC_FALSE;
  p->driving += p->rows;
  p->direction = p->sign[2 * i + a];
  PetscFunctionReturn(0);
}

/* A constraint opens only after its term slips. If rounding errors say otherwise, the term's nearer bound is taken. */
static void PivotSlipFirst(const IPTableau *p, PivotLimit *limit)
{
  const PetscInt i = limit->row >= 0 ? p->basic[limit->row] : p->m;

  if (i >= PetscMin(p->m, p->n) || p->mu[i] == 0.0) return;
  for (PetscInt a = 0; a < 2; a++) {
    const PetscInt row = p->place[p->m + 2 * i + a];

    if (!p->sticks[2 * i + a]) continue;
    if (row < 0) limit->row = PIVOT_ITSELF;
    if (row < 0) return;
    limit->upper = (PetscBool)(p->q[row] > p->mu[i] * p->q[limit->row]);
    limit->row   = row;
    return;
  }
}

/*
   Exchanges the variable of limit->row, which has reached its bound, for the driving variable. The next driving
   variable is its partner: the motion of the same row if it is a force, or the force if it is a motion.
*/
static PetscErrorCode PivotCross(IPTableau *p, const PivotLimit *limit)
{
  const PetscInt   variable = p->basic[limit->row], row = variable % p->rows;
  const PetscReal  step = p->direction * limit->most;
  const PetscReal *c    = IPTableauColumn(p, -1 - p->place[p->driving]);
  PetscInt         a;
  const PetscInt   i = IPTableauTerm(p, row, &a);

  PetscFunctionBegin;
  if (i < 0 && variable >= p->rows) { /* closes: it slips as it moves now */
    for (PetscInt b = 0; b < 2 && row < p->n; b++) {
      const PetscInt other = p->m + 2 * row + b, at = p->place[p->rows + other];

      if (!p->dropped[other] && at >= 0 && p->sign[2 * row + b] * (p->q[at] + step * c[at]) < 0.0) PivotTurn(p, row, b);
    }
  }
  if (i >= 0 && variable < p->rows && limit->upper) PivotTurn(p, i, a);
  PetscCall(IPTableauExchange(p, limit->row, -1 - p->place[p->driving]));
  p->driving   = variable < p->rows ? variable + p->rows : variable - p->rows;
  p->direction = 1.0;
  if (i < 0) p->closed[row] = (PetscBool)(variable >= p->rows);
  else {
    p->sticks[2 * i + a] = (PetscBool)(variable >= p->rows);
    if (variable < p->rows) p->direction = p->sign[2 * i + a];
  }
  PetscFunctionReturn(0);
}

/* Returns whether the path ends where the driving variable reaches a limit: the parameter is 1 there */
static PetscBool PivotEnds(const IPTableau *p, PivotLimit *limit)
{
  const PetscInt parameter = 2 * p->rows;

  if (p->driving != parameter) return (PetscBool)(limit->row >= 0 && p->basic[limit->row] == parameter && limit->upper);
  if (limit->most < 1.0) return PETSC_FALSE;
  limit->most = 1.0;
  return PETSC_TRUE;
}

/* Follows the path from its begin. *reached: whether the parameter reaches 1. */
static PetscErrorCode PivotFollow(IPTableau *p, PetscInt *steps, PetscBool *reached)
{
  const PetscInt most  = 4 * p->rows + 100;
  PivotLimit     limit = {.row = -1};

  PetscFunctionBegin;
  *reached     = PETSC_FALSE;
  p->driving   = 2 * p->rows;
  p->direction = 1.0;
  for (PetscInt k = 0; k < most; k++) {
    PetscBool stop;

    PetscCall(IPReducedInterrupted(p->s, &stop));
    if (stop) break;
    PivotFindLimit(p, &limit);
    *reached = PivotEnds(p, &limit);
    if (*reached || limit.row == -1 || (limit.row >= 0 && p->basic[limit.row] == 2 * p->rows)) break;
    PivotSlipFirst(p, &limit);
    if (limit.row == PIVOT_ITSELF) PetscCall(PivotPass(p));
    else PetscCall(PivotCross(p, &limit));
    (*steps)++;
  }
  if (*reached) {
    const PetscReal *c = IPTableauColumn(p, -1 - p->place[p->driving]);

    p->last = p->direction * limit.most;
    for (PetscInt r = 0; r < p->rows; r++) p->q[r] += p->last * c[r];
  }
  PetscFunctionReturn(0);
}

/* Returns whether the bound of a term is infinite whatever the force of its constraint; this file has no such terms */
static PetscBool PivotIsEndless(const IPTermSet *set)
{
  for (PetscInt i = 0; i < set->n; i++)
    if (set->coefficient[i] < 0.0 && set->limit[i] >= PETSC_INFINITY) return PETSC_TRUE;
  return PETSC_FALSE;
}

/*
   Follows a path to a solution in which each component of friction obeys its own law. open: the path begins with data
   for which all constraints are open and all forces are zero; this is their only solution. Otherwise it begins with
   data for which the present state is a solution; there may be others. *found: false if the path does not reach a
   solution, or C is not computed. *steps: increased by the number of exchanges.
*/
PetscErrorCode IPTermPivotFollow(IPTermSet *set, const IPReducedSystem *s, PetscBool open, PetscInt *steps,
  PetscBool *found)
{
  IPTableau p;

  PetscFunctionBegin;
  *found = PETSC_FALSE;
  if (!IPTermDenseIsComplete(&set->system) || s->spring || PivotIsEndless(set)) PetscFunctionReturn(0);
  PetscCall(IPTableauCreate(set, &p));
  for (PetscInt i = 0; i < set->m && open; i++) set->closed[i] = PETSC_FALSE;
  IPTableauChoose(set, s, &p);
  PetscCall(IPTableauSetUp(set, s, &p, found));
  if (*found) PetscCall(IPTableauEnter(&p));
  if (*found) PivotBegin(&p, open);
  if (*found) PetscCall(PivotFollow(&p, steps, found));
  if (*found) PetscCall(IPTableauTake(set, s, &p));
  PetscCall(IPTableauDestroy(&p));
  PetscFunctionReturn(0);
}
