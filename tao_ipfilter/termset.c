/*
   The contact problem on the subspace with norm terms, friction among them. With w eliminated and f = (lambda, tau), v the motion of all rows,

     v = C f - RZ y - h,   T y + RZ^T f = t,   lambda >= 0, v_n >= 0, lambda v_n = 0,   tau = P(tau - rho v_t), P the projection to |tau| <= b(lambda),

   where R = [J; T], C = R K_WW^-1 R^T and RZ = R K_WW^-1 Q_W. By a semi-smooth Newton method (Alart and Curnier, A mixed formulation for frictional contact
   problems prone to Newton like solution methods, 1991; Hueeber, Stadler and Wohlmuth, A primal-dual active set algorithm for three-dimensional
   contact problems with Coulomb friction, 2008): rows are open or closed, terms stick, v_t = 0, or slip, tau = b d with d along tau - rho v_t. The
   matrix is not symmetric, and of the size of what is closed; its factors serve as long as corrections by them converge.
*/
#include "ipfilterimpl.h"
#include <petscblaslapack.h>

PetscErrorCode IPTermSetDestroy(IPTermSet *set)
{
  PetscFunctionBegin;
  PetscCall(PetscFree4(set->limit, set->coefficient, set->rho, set->slope));
  PetscCall(PetscFree4(set->closed, set->slips, set->rows, set->place));
  PetscCall(PetscFree5(set->theta, set->way, set->dead, set->F, set->pivots));
  PetscCall(PetscFree2(set->Fy, set->directions));
  PetscCall(PetscFree(set->M));
  PetscCall(PetscFree3(set->V, set->Z, set->ZV));
  PetscCall(PetscFree(set->H));
  PetscCall(PetscMemzero(set, sizeof(*set)));
  PetscFunctionReturn(0);
}

/* m constraints, all open, and n terms, all sticking */
PetscErrorCode IPTermSetCreate(PetscInt m, PetscInt n, PetscInt kmax, IPTermSet *set)
{
  const PetscInt all = m + 2 * n;

  PetscFunctionBegin;
  PetscCall(IPTermSetDestroy(set));
  set->m = m;
  set->n = n;
  PetscCall(PetscCalloc4(n, &set->limit, n, &set->coefficient, n, &set->rho, n, &set->slope));
  PetscCall(PetscCalloc4(m, &set->closed, n, &set->slips, all, &set->rows, all, &set->place));
  PetscCall(PetscCalloc5(n, &set->theta, 2 * n, &set->way, 2 * n, &set->dead, all, &set->F, all, &set->pivots));
  PetscCall(PetscMalloc2(kmax, &set->Fy, kmax, &set->directions));
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
static PetscErrorCode TermSetMotion(IPTermSet *set, const IPCompliance *c, const IPReducedSystem *s)
{
  const PetscReal one = 1.0, minus = -1.0;
  PetscBLASInt    m, k, inc = 1;

  PetscFunctionBegin;
  PetscCall(PetscBLASIntCast(s->m, &m));
  PetscCall(PetscBLASIntCast(s->k, &k));
  for (PetscInt i = 0; i < s->m; i++) s->gap[i] = -s->h[i];
  if (k) PetscCallBLAS("BLASgemv", BLASgemv_("N", &m, &k, &minus, s->JZ, &m, s->y, &inc, &one, s->gap, &inc));
  set->length = PetscMax(s->length, TermSetLargest(s->m, s->gap));
  for (PetscInt a = 0; a < set->na; a++) {
    if (s->lambda[set->rows[a]] != 0.0) PetscCallBLAS("BLASaxpy", BLASaxpy_(&m, &s->lambda[set->rows[a]], IPComplianceColumn(c, set->rows[a]), &inc, s->gap, &inc));
  }
  PetscFunctionReturn(0);
}

/* There are no forces along dead directions */
static void TermSetRelieve(const IPTermSet *set, const IPReducedSystem *s)
{
  for (PetscInt i = 0; i < set->n; i++) {
    const PetscReal *dead  = &set->dead[2 * i];
    PetscReal       *tau   = &s->lambda[TermRow(set, i)];
    const PetscReal  along = dead[0] * tau[0] + dead[1] * tau[1];

    for (PetscInt a = 0; a < 2; a++) tau[a] -= along * dead[a];
  }
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
static PetscReal TermSetGivesWay(const IPTermSet *set, const IPCompliance *c, PetscInt row)
{
  const PetscInt first = row < set->m ? row : set->m + 2 * ((row - set->m) / 2);

  return PetscMax(IPComplianceColumn(c, first)[first], row < set->m ? 0.0 : IPComplianceColumn(c, first + 1)[first + 1]);
}

/* The rows that take part, as far as anything gives way to them: closed constraints, and the terms that can have a force */
static PetscErrorCode TermSetList(IPTermSet *set, IPCompliance *c, const IPReducedSystem *s)
{
  const PetscReal rounding = 1e-14; /* of what gives way most: tangents have that of directions that are held */
  PetscReal       most     = 0.0;
  PetscInt        n        = 0;

  PetscFunctionBegin;
  for (PetscInt i = 0; i < set->m; i++)
    if (set->closed[i]) set->rows[n++] = i;
  for (PetscInt i = 0; i < set->n; i++) {
    for (PetscInt a = 0; a < 2 && TermTakesPart(set, i); a++) set->rows[n++] = TermRow(set, i) + a;
  }
  PetscCall(IPComplianceColumns(c, n, set->rows));
  for (PetscInt k = 0; k < n; k++) most = PetscMax(most, TermSetGivesWay(set, c, set->rows[k]));
  set->na = 0;
  for (PetscInt r = 0; r < s->m; r++) set->place[r] = -1;
  for (PetscInt k = 0; k < n; k++) {
    const PetscInt r = set->rows[k];

    if (TermSetGivesWay(set, c, r) <= (r < set->m ? 0.0 : rounding * most)) continue;
    set->place[r]        = set->na;
    set->rows[set->na++] = r;
  }
  for (PetscInt r = 0; r < s->m; r++)
    if (set->place[r] < 0) s->lambda[r] = 0.0;
  PetscFunctionReturn(0);
}

/* Force per length of the rows of a term, from what they give way by themselves */
static void TermSetResistances(IPTermSet *set, const IPCompliance *c)
{
  for (PetscInt i = 0; i < set->n; i++) {
    const PetscInt r = TermRow(set, i);
    PetscReal      larger;

    if (set->place[r] < 0) continue;
    larger      = PetscMax(IPComplianceColumn(c, r)[r], IPComplianceColumn(c, r + 1)[r + 1]);
    set->rho[i] = 1.0 / larger;
  }
}

/* The motion of a term's two rows, without that along a dead direction */
static void TermMotion(const IPTermSet *set, const IPReducedSystem *s, PetscInt i, PetscReal v[2])
{
  const PetscReal *dead = &set->dead[2 * i], *gap = &s->gap[TermRow(set, i)], along = dead[0] * gap[0] + dead[1] * gap[1];

  for (PetscInt a = 0; a < 2; a++) v[a] = gap[a] - along * dead[a];
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

    if (set->place[TermRow(set, i)] < 0) continue;
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

    if (set->place[TermRow(set, i)] < 0 || !set->slips[i]) continue;
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

  for (PetscInt k = 0; k < set->na; k++) {
    const PetscInt r = set->rows[k];
    PetscInt       a = 0;
    const PetscInt i = TermOfRow(set, r, &a);

    if (i >= 0 && set->slips[i]) {
      PetscReal       b[2];
      const PetscReal size = TermTrial(set, s, i, b);

      set->F[k] = (s->lambda[r] - (size > 0.0 ? TermGetBound(set, s, i) * b[a] / size : 0.0)) / set->rho[i];
    } else if (i >= 0) {
      const PetscReal *dead = &set->dead[2 * i], *tau = &s->lambda[TermRow(set, i)];
      PetscReal        v[2];

      TermMotion(set, s, i, v);
      set->F[k] = v[a] + dead[a] * (dead[0] * tau[0] + dead[1] * tau[1]) / set->rho[i];
    } else set->F[k] = s->gap[r];
    largest = PetscMax(largest, PetscAbsReal(set->F[k]));
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

/* M, column by column of C: what its rows take of v; then of f */
static PetscErrorCode TermSetFill(IPTermSet *set, const IPCompliance *c)
{
  const size_t n = (size_t)set->na;
  PetscReal   *by_v, *by_f;
  PetscInt    *first, *second;

  PetscFunctionBegin;
  PetscCall(PetscMalloc4(2 * n, &by_v, 3 * n, &by_f, n, &first, n, &second));
  for (size_t k = 0; k < n; k++) {
    PetscInt       a = 0;
    const PetscInt i = TermOfRow(set, set->rows[k], &a);

    TermSetRow(set, set->rows[k], &by_v[2 * k], &by_f[3 * k], &by_f[3 * k + 2]);
    first[k] = second[k] = i < 0 ? set->rows[k] : TermRow(set, i);
    if (i >= 0) second[k]++;
  }
  for (size_t j = 0; j < n; j++) {
    const PetscReal *column = IPComplianceColumn(c, set->rows[j]);
    PetscReal       *M      = set->M + j * n;

    for (size_t k = 0; k < n; k++) M[k] = by_v[2 * k] * column[first[k]] + by_v[2 * k + 1] * column[second[k]];
  }
  for (size_t k = 0; k < n; k++) {
    PetscInt       a = 0;
    const PetscInt i = TermOfRow(set, set->rows[k], &a);

    for (PetscInt b = 0; i >= 0 && b < 2; b++) set->M[k + (size_t)set->place[first[k] + b] * n] += by_f[3 * k + b];
    if (i >= 0 && by_f[3 * k + 2] != 0.0 && set->place[i] >= 0) set->M[k + (size_t)set->place[i] * n] += by_f[3 * k + 2];
  }
  PetscCall(PetscFree4(by_v, by_f, first, second));
  PetscFunctionReturn(0);
}

/* L U = M, the diagonal raised by as little as makes dependent rows no obstacle; *factored is false where no small number does. Rows of terms depend on one another
   wherever some of what they touch is held: their residuals, to which the diagonal adds nothing, are what counts. */
static PetscErrorCode TermSetFactor(IPTermSet *set, const IPCompliance *c, const IPReducedSystem *s, PetscBool *factored)
{
  const PetscReal first = 1e-13, last = 1e-8, terms = 1e-9;
  PetscBLASInt    n, info = 1;

  PetscFunctionBegin;
  TermSetLinearize(set, s);
  PetscCall(PetscBLASIntCast(set->na, &n));
  PetscCall(PetscFree(set->M));
  PetscCall(PetscMalloc1((size_t)set->na * (size_t)set->na, &set->M));
  for (PetscReal shift = first; info && shift <= last; shift *= 10.0) {
    PetscCall(TermSetFill(set, c));
    for (PetscInt k = 0; k < set->na; k++) set->M[(size_t)k * (size_t)(set->na + 1)] += (set->rows[k] < set->m ? shift : PetscMax(shift, terms)) * IPComplianceColumn(c, set->rows[k])[set->rows[k]];
    if (n) PetscCallBLAS("LAPACKgetrf", LAPACKgetrf_(&n, &n, set->M, &n, set->pivots, &info));
    else info = 0;
  }
  *factored     = (PetscBool)!info;
  set->k        = 0;
  set->factored = *factored;
  PetscFunctionReturn(0);
}

/* x := M^-1 x of so many columns */
static PetscErrorCode TermSetDivide(const IPTermSet *set, PetscInt columns, PetscReal x[])
{
  PetscBLASInt n, k, info;

  PetscFunctionBegin;
  PetscCall(PetscBLASIntCast(set->na, &n));
  PetscCall(PetscBLASIntCast(columns, &k));
  if (!n || !k) PetscFunctionReturn(0);
  PetscCallBLAS("LAPACKgetrs", LAPACKgetrs_("N", &n, &k, set->M, &n, set->pivots, x, &n, &info));
  PetscCheck(!info, PETSC_COMM_SELF, PETSC_ERR_LIB, "LAPACK's getrs said %d of %d rows", (int)info, (int)n);
  PetscFunctionReturn(0);
}

/* Z^T V, Z the rows of RZ that take part: the columns of new directions, then their rows */
static PetscErrorCode TermSetCouple(IPTermSet *set, const IPReducedSystem *s)
{
  const PetscReal one = 1.0, zero = 0.0;
  const size_t    n = (size_t)set->na, old = (size_t)set->k;
  PetscBLASInt    m, k, before, added, ld;

  PetscFunctionBegin;
  PetscCall(PetscBLASIntCast(set->na, &m));
  PetscCall(PetscBLASIntCast(s->k, &k));
  PetscCall(PetscBLASIntCast(set->k, &before));
  PetscCall(PetscBLASIntCast(s->kmax, &ld));
  added = k - before;
  if (!m) PetscCall(PetscArrayzero(set->ZV, s->kmax * s->kmax));
  if (!m || !added) PetscFunctionReturn(0);
  PetscCallBLAS("BLASgemm", BLASgemm_("T", "N", &k, &added, &m, &one, set->Z, &m, set->V + old * n, &m, &zero, set->ZV + old * (size_t)s->kmax, &ld));
  if (before) PetscCallBLAS("BLASgemm", BLASgemm_("T", "N", &added, &before, &m, &one, set->Z + old * n, &m, set->V, &m, &zero, set->ZV + old, &ld));
  PetscFunctionReturn(0);
}

/* V = M^-1 B, B the derivative of the rows' equations by -y: the columns that are new */
static PetscErrorCode TermSetAppend(IPTermSet *set, const IPReducedSystem *s)
{
  const size_t n = (size_t)set->na;

  PetscFunctionBegin;
  if (!set->k) {
    PetscCall(PetscFree3(set->V, set->Z, set->ZV));
    PetscCall(PetscMalloc3(n * (size_t)s->kmax, &set->V, n * (size_t)s->kmax, &set->Z, s->kmax * s->kmax, &set->ZV));
  }
  for (PetscInt r = 0; r < set->na; r++) {
    PetscReal      by_v[2], by_f[2], by_lambda;
    PetscInt       a = 0;
    const PetscInt i = TermOfRow(set, set->rows[r], &a), first = i < 0 ? set->rows[r] : TermRow(set, i);

    TermSetRow(set, set->rows[r], by_v, by_f, &by_lambda);
    for (PetscInt j = set->k; j < s->k; j++) {
      const PetscReal *RZ = &s->JZ[(size_t)j * (size_t)s->m];

      set->V[(size_t)r + (size_t)j * n] = by_v[0] * RZ[first] + (i < 0 ? 0.0 : by_v[1] * RZ[first + 1]);
      set->Z[(size_t)r + (size_t)j * n] = RZ[set->rows[r]];
    }
  }
  PetscCall(TermSetDivide(set, s->k - set->k, set->V + (size_t)set->k * n));
  PetscCall(TermSetCouple(set, s));
  set->k = s->k;
  PetscFunctionReturn(0);
}

/* L U = H = T + RZ^T V, its diagonal raised by as little as a body needs that nothing holds; *factored is false where H is singular */
static PetscErrorCode TermSetFactorDirections(IPTermSet *set, const IPReducedSystem *s, PetscBool *factored)
{
  const PetscReal shift = 1e-14;
  PetscBLASInt    k, info;

  PetscFunctionBegin;
  *factored = PETSC_TRUE;
  if (!s->k) PetscFunctionReturn(0);
  PetscCall(PetscFree(set->H));
  PetscCall(PetscMalloc1((size_t)s->k * (size_t)s->k, &set->H));
  for (PetscInt j = 0; j < s->k; j++) {
    for (PetscInt i = 0; i < s->k; i++) set->H[i + j * s->k] = s->T[i + j * s->kmax] + set->ZV[i + j * s->kmax];
    set->H[j + j * s->k] += shift * s->G[j + j * s->kmax];
  }
  PetscCall(PetscBLASIntCast(s->k, &k));
  PetscCallBLAS("LAPACKgetrf", LAPACKgetrf_(&k, &k, set->H, &k, set->directions, &info));
  *factored = (PetscBool)!info;
  PetscFunctionReturn(0);
}

/* dy = -H^-1 (F_y - RZ^T M^-1 F), df = V dy - M^-1 F, added to y and f */
static PetscErrorCode TermSetCorrect(IPTermSet *set, const IPReducedSystem *s)
{
  PetscBLASInt k, one = 1, info;

  PetscFunctionBegin;
  PetscCall(PetscBLASIntCast(s->k, &k));
  PetscCall(TermSetDivide(set, 1, set->F));
  for (PetscInt j = 0; j < s->k; j++) {
    const PetscReal *Z = &set->Z[(size_t)j * (size_t)set->na];

    for (PetscInt r = 0; r < set->na; r++) set->Fy[j] -= Z[r] * set->F[r];
  }
  if (k) PetscCallBLAS("LAPACKgetrs", LAPACKgetrs_("N", &k, &one, set->H, &k, set->directions, set->Fy, &k, &info));
  for (PetscInt r = 0; r < set->na; r++) s->lambda[set->rows[r]] -= set->F[r];
  for (PetscInt j = 0; j < s->k; j++) {
    s->y[j] -= set->Fy[j];
    for (PetscInt r = 0; r < set->na; r++) s->lambda[set->rows[r]] -= set->V[(size_t)r + (size_t)j * (size_t)set->na] * set->Fy[j];
  }
  PetscFunctionReturn(0);
}

/* How far f and v are from the laws, lengths: the sum of squares over all rows, constraints by min(lambda / rho, v), terms by |tau - P(tau - rho v)| / rho */
static PetscReal TermSetMerit(const IPTermSet *set, const IPCompliance *c, const IPReducedSystem *s)
{
  PetscReal merit = 0.0;

  for (PetscInt i = 0; i < set->m; i++) {
    if (set->place[i] >= 0) merit += PetscSqr(PetscMin(s->lambda[i] * IPComplianceColumn(c, i)[i], s->gap[i]));
    else merit += PetscSqr(PetscMin(0.0, s->gap[i]));
  }
  for (PetscInt i = 0; i < set->n; i++) {
    PetscReal v[2];

    if (set->place[TermRow(set, i)] < 0) continue;
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
static PetscErrorCode TermSetSearch(IPTermSet *set, const IPCompliance *c, const IPReducedSystem *s, const PetscReal f[], const PetscReal v[], const PetscReal y[])
{
  const PetscInt halvings = 8;
  PetscReal      least = TermSetMerit(set, c, s), best = 1.0, alpha = 1.0, *trial;

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
    merit = TermSetMerit(set, c, &at);
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

/* One step of Newton's method from f and y, with new factors where the old ones do not serve */
static PetscErrorCode TermSetStep(IPTermSet *set, IPCompliance *c, const IPReducedSystem *s, PetscBool *solved)
{
  PetscFunctionBegin;
  *solved = PETSC_TRUE;
  if (!set->factored) PetscCall(TermSetFactor(set, c, s, solved));
  if (!*solved) PetscFunctionReturn(0);
  PetscCall(TermSetAppend(set, s));
  PetscCall(TermSetFactorDirections(set, s, solved));
  if (!*solved) PetscFunctionReturn(0);
  PetscCall(TermSetResidualOfDirections(set, s));
  PetscCall(TermSetCorrect(set, s));
  TermSetRelieve(set, s);
  PetscCall(TermSetMotion(set, c, s));
  PetscFunctionReturn(0);
}

/* The same, and as far along it as it leads to the laws */
static PetscErrorCode TermSetCarefulStep(IPTermSet *set, IPCompliance *c, const IPReducedSystem *s, PetscBool *solved)
{
  PetscReal *before;

  PetscFunctionBegin;
  PetscCall(PetscMalloc1(2 * s->m + s->k, &before));
  PetscCall(PetscArraycpy(before, s->lambda, s->m));
  PetscCall(PetscArraycpy(before + s->m, s->gap, s->m));
  PetscCall(PetscArraycpy(before + 2 * s->m, s->y, s->k));
  PetscCall(TermSetStep(set, c, s, solved));
  if (*solved) PetscCall(TermSetSearch(set, c, s, before, before + s->m, before + 2 * s->m));
  PetscCall(PetscFree(before));
  PetscFunctionReturn(0);
}

/* The rows that take part at f and y, and their v */
static PetscErrorCode TermSetRenew(IPTermSet *set, IPCompliance *c, const IPReducedSystem *s)
{
  PetscFunctionBegin;
  PetscCall(TermSetList(set, c, s));
  TermSetRelieve(set, s);
  PetscCall(TermSetMotion(set, c, s));
  TermSetResistances(set, c);
  set->factored = PETSC_FALSE;
  PetscFunctionReturn(0);
}

/* f (in s->lambda), v (in s->gap) and y, from the last ones; *steps: systems solved; *solved is false where Newton's method has no end.
   Where v and f are right but for rounding, it does not matter what rounding takes them for. */
PetscErrorCode IPTermSetSolve(IPTermSet *set, IPCompliance *c, const IPReducedSystem *s, PetscInt *steps, PetscBool *solved)
{
  const PetscInt  limit = 400, stuck = 15, cycles = 40;
  const PetscReal exact = 1e-12, rounding = 1e-9, serves = 0.1;
  PetscReal       before = PETSC_INFINITY;

  PetscFunctionBegin;
  if (set->factored) PetscCall(TermSetMotion(set, c, s));
  else PetscCall(TermSetRenew(set, c, s));
  for (*steps = 0; *steps < limit; (*steps)++) {
    PetscReal largest;

    if (TermSetClose(set, s, (PetscBool)(*steps < cycles))) PetscCall(TermSetRenew(set, c, s));
    if (TermSetSlip(set, s, (PetscBool)(*steps < stuck))) set->factored = PETSC_FALSE;
    largest = TermSetResidual(set, s);
    *solved = (PetscBool)(*steps > 0 && (largest <= exact * set->length || (largest <= rounding * set->length && largest > 0.5 * before)));
    if (*solved) PetscFunctionReturn(0);
    if (largest > serves * before) set->factored = PETSC_FALSE;
    before = largest;
    if (*steps < stuck) PetscCall(TermSetStep(set, c, s, solved));
    else PetscCall(TermSetCarefulStep(set, c, s, solved));
    if (!*solved) PetscFunctionReturn(0);
  }
  *solved = PETSC_FALSE;
  PetscFunctionReturn(0);
}
