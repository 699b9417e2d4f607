/*
   The tableau: the equations v = C f - RZ y - h of laws.c, without y, solved for one variable of each row. Its columns
   are the other variables, which are zero, and a parameter. An exchange of two variables costs as much as a product
   with C, so that many states of few contacts can be tried.
   Variables are numbered: the forces of all rows, the motions of all rows, the parameter. Each term has a frame of its
   own, whose first axis is the direction of slip. Each component a of a term has its own bound, |tau_a| <= b with
   b = mu lambda + limit. With s the sign of v_a in slip, sigma_a = s tau_a + b takes the place of tau_a: it is zero in
   slip, and from 0 to 2 b in stick.
*/
#include "frictionimpl.h"
#include <petscblaslapack.h>

PetscErrorCode IPTableauDestroy(IPTableau *p)
{
  PetscFunctionBegin;
  PetscCall(PetscFree3(p->A, p->q, p->scale));
  PetscCall(PetscFree3(p->basic, p->others, p->place));
  PetscCall(PetscFree4(p->axis, p->mu, p->limit, p->sign));
  PetscCall(PetscFree3(p->sticks, p->closed, p->dropped));
  PetscFunctionReturn(0);
}

PetscErrorCode IPTableauCreate(const IPTermSet *set, IPTableau *p)
{
  const size_t rows = (size_t)set->system.m;

  PetscFunctionBegin;
  *p = (IPTableau){.m = set->m, .n = set->n, .rows = set->system.m, .driving = -1, .seed = 1};
  PetscCall(PetscCalloc3(rows * (rows + 1), &p->A, rows, &p->q, rows, &p->scale));
  PetscCall(PetscCalloc3(rows, &p->basic, rows + 1, &p->others, 2 * rows + 1, &p->place));
  PetscCall(PetscCalloc4(2 * p->n, &p->axis, p->n, &p->mu, p->n, &p->limit, 2 * p->n, &p->sign));
  PetscCall(PetscCalloc3(2 * p->n, &p->sticks, p->m, &p->closed, rows, &p->dropped));
  PetscFunctionReturn(0);
}

/* Subtracts c along^T from A. along: an entry per column */
PetscErrorCode IPTableauSubtract(IPTableau *p, const PetscReal c[], const PetscReal along[])
{
  const PetscReal minus = -1.0, one = 1.0;
  PetscBLASInt    n, k, inc = 1;

  PetscFunctionBegin;
  PetscCall(PetscBLASIntCast(p->rows, &n));
  k = n + 1;
  PetscCallBLAS("BLASgemm", BLASgemm_("N", "N", &n, &k, &inc, &minus, c, &n, along, &inc, &one, p->A, &n));
  PetscFunctionReturn(0);
}

/* Exchanges the basic variable of a row and the nonbasic variable of a column */
PetscErrorCode IPTableauExchange(IPTableau *p, PetscInt row, PetscInt column)
{
  const PetscReal by     = 1.0 / IPTableauColumn(p, column)[row];
  const PetscInt  enters = p->others[column], leaves = p->basic[row];
  PetscReal      *c = IPTableauColumn(p, column), *along;

  PetscFunctionBegin;
  PetscCall(PetscMalloc1(p->rows + 1, &along));
  for (PetscInt j = 0; j <= p->rows; j++) {
    along[j]                   = IPTableauColumn(p, j)[row] * by;
    IPTableauColumn(p, j)[row] = 0.0;
  }
  along[column] = 0.0;
  PetscCall(IPTableauSubtract(p, c, along));
  for (PetscInt i = 0; i < p->rows; i++)
    if (i != row) p->q[i] -= c[i] * by * p->q[row];
  p->q[row] *= -by;
  for (PetscInt i = 0; i < p->rows; i++) c[i] *= by;
  for (PetscInt j = 0; j <= p->rows; j++) IPTableauColumn(p, j)[row] = -along[j];
  c[row] = by;
  PetscCall(PetscFree(along));
  p->basic[row]     = enters;
  p->others[column] = leaves;
  p->place[enters]  = row;
  p->place[leaves]  = -1 - column;
  PetscFunctionReturn(0);
}

/* Chooses the frames and the state of all terms from the present forces and motions */
void IPTableauChoose(const IPTermSet *set, const IPReducedSystem *s, IPTableau *p)
{
  for (PetscInt i = 0; i < p->m; i++) {
    p->dropped[i] = (PetscBool) !(set->system.compliance[i] > 0.0);
    p->closed[i]  = (PetscBool)(set->closed[i] && !p->dropped[i]);
  }
  for (PetscInt i = 0; i < p->n; i++) {
    const PetscInt   row   = IPTermLawsRow(set, i);
    const PetscReal *rigid = &set->rigid[2 * i];
    PetscReal        b[2], size = IPTermLawsTrial(set, s, i, b);
    const PetscBool  tresca = (PetscBool)(set->coefficient[i] < 0.0),
                    held    = (PetscBool)(rigid[0] != 0.0 || rigid[1] != 0.0),
                    none    = (PetscBool)(set->limit[i] == 0.0 || set->coefficient[i] == 0.0 ||
                                       (!tresca && (i >= p->m || p->dropped[i])));
    const PetscBool slips   = (PetscBool)(size > IPTermLawsBound(set, s, i) && (tresca || p->closed[i]));

    p->mu[i]           = tresca ? 0.0 : set->coefficient[i];
    p->limit[i]        = tresca ? set->limit[i] : 0.0;
    p->axis[2 * i]     = held ? rigid[1] : slips ? b[0] / size : 1.0;
    p->axis[2 * i + 1] = held ? -rigid[0] : slips ? b[1] / size : 0.0;
    for (PetscInt a = 0; a < 2; a++) {
      p->dropped[row + a]  = (PetscBool)(none || (held && a) || !(IPTermLawsCompliance(set, row) > 0.0));
      p->sticks[2 * i + a] = (PetscBool)(!p->dropped[row + a] && (tresca || p->closed[i]) && (!slips || (a && !held)));
      p->sign[2 * i + a]   = a || p->axis[2 * i] * b[0] + p->axis[2 * i + 1] * b[1] <= 0.0 ? 1.0 : -1.0;
    }
  }
}

/* Turns the two entries of each term of an array with an entry per row into its frame, or back */
void IPTableauRotate(const IPTableau *p, PetscReal f[], size_t stride, PetscBool back)
{
  for (PetscInt i = 0; i < p->n; i++) {
    PetscReal      *x = &f[(size_t)(p->m + 2 * i) * stride], *y = x + stride;
    const PetscReal c = p->axis[2 * i], d = back ? -p->axis[2 * i + 1] : p->axis[2 * i + 1], first = *x;

    *x = c * first + d * *y;
    *y = c * *y - d * first;
  }
}

/*
   Factors T. If only contact holds a body, T is singular; its diagonal is therefore increased slightly. The solution
   changes slightly too, which does no harm, because Newton's method only starts from it.
*/
static PetscErrorCode TableauFactorDirections(const IPReducedSystem *s, PetscReal T[], PetscBool *factored)
{
  const PetscReal raise = 1e-9;
  PetscBLASInt    k, info = 0;

  PetscFunctionBegin;
  PetscCall(PetscBLASIntCast(s->k, &k));
  for (PetscInt j = 0; j < s->k; j++)
    for (PetscInt i = 0; i < s->k; i++) T[i + j * s->k] = s->T[i + j * s->kmax] + (i == j ? raise * s->G[j] : 0.0);
  if (k) PetscCallBLAS("LAPACKpotrf", LAPACKpotrf_("L", &k, T, &k, &info));
  *factored = (PetscBool)!info;
  PetscFunctionReturn(0);
}

/* Computes A = C + RZ T^-1 RZ^T and q = v for f = 0 */
static PetscErrorCode TableauMakeCompliance(const IPTermSet *set, const IPReducedSystem *s, IPTableau *p,
  PetscBool *made)
{
  const PetscReal one = 1.0, minus = -1.0;
  const size_t    m = (size_t)s->m, k = (size_t)s->k;
  PetscReal      *T, *X, *y, *f;
  PetscBLASInt    mb, kb, inc = 1;

  PetscFunctionBegin;
  PetscCall(PetscBLASIntCast(s->m, &mb));
  PetscCall(PetscBLASIntCast(s->k, &kb));
  PetscCall(PetscMalloc4(k * k, &T, k * m, &X, k, &y, m, &f));
  for (size_t i = 0; i < m; i++) {
    for (size_t j = 0; j < k; j++) X[j + i * k] = s->JZ[i + j * m];
    p->q[i] = -s->h[i];
    f[i]    = -s->base[i];
  }
  PetscCall(PetscArraycpy(y, s->t, k));
  PetscCall(PetscArraycpy(p->A, set->system.C, m * m));
  PetscCall(TableauFactorDirections(s, T, made));
  if (k && *made) {
    PetscCallBLAS("BLAStrsm", BLAStrsm_("L", "L", "N", "N", &kb, &mb, &one, T, &kb, X, &kb));
    PetscCallBLAS("BLASgemm", BLASgemm_("T", "N", &mb, &mb, &kb, &one, X, &kb, X, &kb, &one, p->A, &mb));
    PetscCallBLAS("BLAStrsm", BLAStrsm_("L", "L", "N", "N", &kb, &inc, &one, T, &kb, y, &kb));
    PetscCallBLAS("BLASgemv", BLASgemv_("T", &kb, &mb, &minus, X, &kb, y, &inc, &one, p->q, &inc));
  }
  PetscCallBLAS("BLASgemv", BLASgemv_("N", &mb, &mb, &one, p->A, &mb, f, &inc, &one, p->q, &inc));
  PetscCall(PetscFree4(T, X, y, f));
  PetscFunctionReturn(0);
}

/* Scales forces and motions: the rows of a contact such that the largest diagonal entry of C is 1 */
static void TableauScale(const IPTermSet *set, IPTableau *p)
{
  const size_t m = (size_t)p->rows;

  p->length = set->length;
  for (PetscInt r = 0; r < p->rows; r++) p->scale[r] = PetscAbsReal(set->system.C[(size_t)r * (m + 1)]);
  for (PetscInt i = 0; i < p->n; i++) {
    const PetscInt row   = p->m + 2 * i;
    PetscReal      large = PetscMax(p->scale[row], p->scale[row + 1]);

    if (i < p->m) large = p->scale[i] = PetscMax(large, p->scale[i]);
    p->scale[row] = p->scale[row + 1] = large;
  }
  for (PetscInt r = 0; r < p->rows; r++) p->scale[r] = p->scale[r] > 0.0 ? 1.0 / PetscSqrtReal(p->scale[r]) : 1.0;
  for (PetscInt j = 0; j < p->rows; j++) {
    for (PetscInt i = 0; i < p->rows; i++) IPTableauColumn(p, j)[i] *= p->scale[i] * p->scale[j];
    p->q[j] *= p->scale[j];
  }
  for (PetscInt i = 0; i < p->n; i++) p->limit[i] /= p->scale[p->m + 2 * i];
}

/* Sets up the tableau with all motions basic: frames, scales, and sigma in place of tau */
PetscErrorCode IPTableauSetUp(const IPTermSet *set, const IPReducedSystem *s, IPTableau *p, PetscBool *made)
{
  PetscFunctionBegin;
  p->s = s;
  PetscCall(TableauMakeCompliance(set, s, p, made));
  if (!*made) PetscFunctionReturn(0);
  for (PetscInt j = 0; j < p->rows; j++) IPTableauRotate(p, IPTableauColumn(p, j), 1, PETSC_FALSE);
  for (PetscInt j = 0; j < p->rows; j++) IPTableauRotate(p, p->A + j, (size_t)p->rows, PETSC_FALSE);
  IPTableauRotate(p, p->q, 1, PETSC_FALSE);
  TableauScale(set, p);
  for (PetscInt r = 0; r < p->rows; r++) {
    p->basic[r]           = p->rows + r;
    p->place[p->rows + r] = r;
    p->others[r]          = r;
    p->place[r]           = -1 - r;
  }
  p->others[p->rows]    = 2 * p->rows;
  p->place[2 * p->rows] = -1 - p->rows;
  for (PetscInt r = p->m; r < p->rows; r++) {
    PetscInt        a;
    const PetscInt  i    = IPTableauTerm(p, r, &a);
    const PetscReal sign = p->sign[2 * i + a];

    if (p->dropped[r]) continue;
    for (PetscInt j = 0; j < p->rows; j++) {
      PetscReal *c = &IPTableauColumn(p, r)[j];

      if (p->mu[i] > 0.0) IPTableauColumn(p, i)[j] -= sign * p->mu[i] * *c;
      p->q[j] -= sign * p->limit[i] * *c;
      *c *= sign;
    }
  }
  PetscFunctionReturn(0);
}

/* Returns whether a row's force is to be basic at the begin: the constraint is closed, the component sticks */
static PetscBool TableauIsWanted(const IPTableau *p, PetscInt row)
{
  PetscInt       a;
  const PetscInt i = IPTableauTerm(p, row, &a);

  if (i < 0) return p->closed[row];
  return (PetscBool)(p->sticks[2 * i + a] && (p->mu[i] == 0.0 || p->place[i] >= 0));
}

/* Makes the forces of the closed constraints, or of the sticking rows, basic: the row with the largest pivot first */
static PetscErrorCode TableauEnter(IPTableau *p, PetscInt first, PetscInt end)
{
  const PetscReal tiny = 1e-10;

  PetscFunctionBegin;
  for (;;) {
    PetscReal largest = tiny;
    PetscInt  row     = -1;

    for (PetscInt r = first; r < end; r++) {
      const PetscBool wanted = TableauIsWanted(p, r);

      if (!wanted || p->place[r] >= 0) continue;
      if (PetscAbsReal(IPTableauColumn(p, r)[r]) <= largest) continue;
      largest = PetscAbsReal(IPTableauColumn(p, r)[r]);
      row     = r;
    }
    if (row < 0) break;
    PetscCall(IPTableauExchange(p, row, row));
  }
  PetscFunctionReturn(0);
}

/* Makes the forces of closed and of sticking rows basic */
PetscErrorCode IPTableauEnter(IPTableau *p)
{
  PetscFunctionBegin;
  PetscCall(TableauEnter(p, 0, p->m));
  PetscCall(TableauEnter(p, p->m, p->rows));
  for (PetscInt r = 0; r < p->m; r++) p->closed[r] = (PetscBool)(p->place[r] >= 0);
  for (PetscInt r = p->m; r < p->rows; r++) p->sticks[r - p->m] = (PetscBool)(p->place[r] >= 0);
  PetscFunctionReturn(0);
}

/* Computes y from the forces: T y = t - RZ^T (f - base) */
static PetscErrorCode TableauTakeDirections(IPTermSet *set, const IPReducedSystem *s)
{
  const PetscReal one = 1.0, minus = -1.0;
  PetscReal      *T;
  PetscBLASInt    m, k, inc = 1, info;
  PetscBool       factored;

  PetscFunctionBegin;
  if (!s->k) PetscFunctionReturn(0);
  PetscCall(PetscBLASIntCast(s->m, &m));
  PetscCall(PetscBLASIntCast(s->k, &k));
  PetscCall(PetscMalloc1((size_t)s->k * (size_t)s->k, &T));
  PetscCall(TableauFactorDirections(s, T, &factored));
  PetscCall(PetscArraycpy(s->y, s->t, s->k));
  for (PetscInt i = 0; i < s->m; i++) set->system.f[i] = s->lambda[i] - s->base[i];
  PetscCallBLAS("BLASgemv", BLASgemv_("T", &m, &k, &minus, s->JZ, &m, set->system.f, &inc, &one, s->y, &inc));
  PetscCallBLAS("LAPACKpotrs", LAPACKpotrs_("L", &k, &inc, T, &k, s->y, &k, &info));
  PetscCall(PetscFree(T));
  PetscFunctionReturn(0);
}

/* Sets forces, motions, y and states to those of the tableau, with the value p->last of the driving variable */
PetscErrorCode IPTableauTake(IPTermSet *set, const IPReducedSystem *s, const IPTableau *p)
{
  PetscFunctionBegin;
  for (PetscInt r = 0; r < p->rows; r++)
    s->lambda[r] = p->place[r] >= 0 ? p->q[p->place[r]] : p->driving == r ? p->last : 0.0;
  for (PetscInt r = p->m; r < p->rows; r++) {
    PetscInt        a;
    const PetscInt  i = IPTableauTerm(p, r, &a);
    const PetscReal b = p->limit[i] + (p->mu[i] > 0.0 ? p->mu[i] * s->lambda[i] : 0.0);

    s->lambda[r] = p->dropped[r] ? 0.0 : p->sign[2 * i + a] * (s->lambda[r] - b);
  }
  for (PetscInt i = 0; i < p->n; i++)
    set->slips[i] = (PetscBool) !(p->sticks[2 * i] && (p->sticks[2 * i + 1] || p->dropped[p->m + 2 * i + 1]));
  for (PetscInt r = 0; r < p->rows; r++) s->lambda[r] *= p->scale[r];
  IPTableauRotate(p, s->lambda, 1, PETSC_TRUE);
  PetscCall(PetscArraycpy(set->closed, p->closed, p->m));
  PetscCall(TableauTakeDirections(set, s));
  IPTermLawsList(set, s);
  IPTermLawsRelieve(set, s);
  PetscCall(IPTermLawsMove(set, s));
  PetscFunctionReturn(0);
}
