/*
   Solves the contact problem in the subspace as a linear complementarity problem in the constraints. After elimination
   of w:
     C lambda - JZ y = h, T y + JZ^T lambda = t in the active rows, lambda >= 0,
     gap = C lambda - JZ y - h >= 0 in the inactive rows,
   where C = J K_WW^-1 J^T, JZ = J K_WW^-1 Q_W and T = P^T K P - Q_W^T K_WW^-1 Q_W. The method is block principal
   pivoting (Portugal, Judice and Vicente, A comparison of block pivoting and interior-point algorithms for linear least
   squares problems with nonnegative variables, 1994). It exchanges all wrong rows at once, as the primal-dual active
   set method does. If that makes no progress, it exchanges single rows. Therefore it terminates.
*/
#include "subspaceimpl.h"
#include <petscblaslapack.h>

PetscErrorCode IPActiveSetDestroy(IPActiveSet *set)
{
  PetscFunctionBegin;
  PetscCall(PetscFree(set->active));
  PetscCall(PetscFree(set->rows));
  PetscCall(PetscFree(set->L));
  PetscCall(PetscFree(set->V));
  PetscCall(PetscFree(set->H));
  PetscCall(PetscFree(set->r));
  PetscCall(PetscMemzero(set, sizeof(*set)));
  PetscFunctionReturn(0);
}

/* Creates the active set of m rows, all inactive */
PetscErrorCode IPActiveSetCreate(PetscInt m, IPActiveSet *set)
{
  PetscFunctionBegin;
  PetscCall(IPActiveSetDestroy(set));
  set->m = m;
  PetscCall(PetscCalloc1(m, &set->active));
  PetscCall(PetscMalloc1(m, &set->rows));
  PetscCall(PetscMalloc1(m, &set->r));
  PetscFunctionReturn(0);
}

/* Lists the rows of the active set, without rows that have no compliance */
static PetscErrorCode ActiveSetList(IPActiveSet *set, IPCompliance *c)
{
  PetscInt n = 0;

  PetscFunctionBegin;
  for (PetscInt i = 0; i < set->m; i++)
    if (set->active[i]) set->rows[n++] = i;
  PetscCall(IPComplianceColumns(c, n, set->rows));
  set->n = 0;
  for (PetscInt k = 0; k < n; k++) {
    const PetscInt i = set->rows[k];

    if (IPComplianceColumn(c, i)[i] > 0.0) set->rows[set->n++] = i;
  }
  PetscFunctionReturn(0);
}

/*
   Computes L L^T = C_AA, with a small addition to the diagonal so that dependent rows can be factored. *factored: false
   if no small addition is sufficient.
*/
static PetscErrorCode ActiveSetFactorRows(IPActiveSet *set, IPCompliance *c, PetscBool *factored)
{
  const PetscReal first = 1e-13, last = 1e-8;
  const size_t    n = (size_t)set->n;
  PetscBLASInt    nb, info = 1;

  PetscFunctionBegin;
  PetscCall(PetscBLASIntCast(set->n, &nb));
  PetscCall(PetscFree(set->L));
  PetscCall(PetscMalloc1(n * n, &set->L));
  for (PetscReal shift = first; info && shift <= last; shift *= 10.0) {
    for (size_t j = 0; j < n; j++) {
      const PetscReal *column = IPComplianceColumn(c, set->rows[j]);

      for (size_t i = 0; i < n; i++) set->L[i + j * n] = column[set->rows[i]];
      set->L[j + j * n] *= 1.0 + shift;
    }
    if (n) PetscCallBLAS("LAPACKpotrf", LAPACKpotrf_("L", &nb, set->L, &nb, &info));
    else info = 0;
  }
  *factored = (PetscBool)!info;
  set->k = set->nfactored = 0;
  PetscFunctionReturn(0);
}

/* Computes V = L^-1 JZ_A for new directions */
static PetscErrorCode ActiveSetFactorColumns(IPActiveSet *set, const IPReducedSystem *s)
{
  PetscBLASInt    n, k;
  const PetscReal one   = 1.0;
  const size_t    first = (size_t)set->k * (size_t)set->n;

  PetscFunctionBegin;
  if (!set->k) {
    set->nfactored = 0;
    PetscCall(PetscFree(set->V));
    PetscCall(PetscMalloc1((size_t)set->n * (size_t)s->kmax, &set->V));
  }
  for (PetscInt j = set->k; j < s->k; j++) {
    for (PetscInt i = 0; i < set->n; i++) set->V[i + j * set->n] = s->JZ[set->rows[i] + j * s->m];
  }
  PetscCall(PetscBLASIntCast(set->n, &n));
  PetscCall(PetscBLASIntCast(s->k - set->k, &k));
  if (n && k) PetscCallBLAS("BLAStrsm", BLAStrsm_("L", "L", "N", "N", &n, &k, &one, set->L, &n, set->V + first, &n));
  set->k = s->k;
  PetscFunctionReturn(0);
}

/*
   Factors H = T + V^T V, with a small addition to the diagonal for bodies that no active constraint holds. *factored:
   false if H is indefinite. H has columns of length kmax.
*/
static PetscErrorCode ActiveSetFactorAllDirections(IPActiveSet *set, const IPReducedSystem *s, PetscBool *factored)
{
  const PetscReal first = PetscMax(1e-14, set->least), last = PetscMax(1e-8, set->least), one = 1.0;
  PetscBLASInt    n, k, ld, info = 1;

  PetscFunctionBegin;
  PetscCall(PetscBLASIntCast(set->n, &n));
  PetscCall(PetscBLASIntCast(s->k, &k));
  PetscCall(PetscBLASIntCast(s->kmax, &ld));
  if (!set->H) PetscCall(PetscMalloc1((size_t)s->kmax * (size_t)s->kmax, &set->H));
  for (PetscReal shift = first; info && shift <= last; shift *= 10.0) {
    for (PetscInt j = 0; j < s->k; j++) {
      PetscCall(PetscArraycpy(set->H + j * s->kmax, s->T + j * s->kmax, s->k));
      set->H[j + j * s->kmax] += shift * s->G[j];
    }
    if (n) PetscCallBLAS("BLASsyrk", BLASsyrk_("L", "T", &k, &n, &one, set->V, &n, &one, set->H, &ld));
    PetscCallBLAS("LAPACKpotrf", LAPACKpotrf_("L", &k, set->H, &ld, &info));
    set->shift = shift;
  }
  *factored = (PetscBool)!info;
  PetscFunctionReturn(0);
}

/*
   Adds direction j to the factor of H, which has the j directions before it. *factored: false if its pivot is not
   positive.
*/
static PetscErrorCode ActiveSetFactorDirection(IPActiveSet *set, const IPReducedSystem *s, PetscInt j,
  PetscBool *factored)
{
  const PetscReal one = 1.0;
  PetscReal      *h   = set->H + j * s->kmax; /* column j of H lies above the diagonal, where the factor has nothing */
  PetscReal       pivot;
  PetscBLASInt    n, before, all, ld, inc = 1;

  PetscFunctionBegin;
  PetscCall(PetscBLASIntCast(set->n, &n));
  PetscCall(PetscBLASIntCast(j, &before));
  PetscCall(PetscBLASIntCast(j + 1, &all));
  PetscCall(PetscBLASIntCast(s->kmax, &ld));
  PetscCall(PetscArraycpy(h, s->T + j * s->kmax, j + 1));
  if (n)
    PetscCallBLAS("BLASgemv",
      BLASgemv_("T", &n, &all, &one, set->V, &n, set->V + (size_t)j * (size_t)set->n, &inc, &one, h, &inc));
  if (j) PetscCallBLAS("BLAStrsm", BLAStrsm_("L", "L", "N", "N", &before, &inc, &one, set->H, &ld, h, &ld));
  pivot = h[j] + set->shift * s->G[j];
  for (PetscInt i = 0; i < j; i++) {
    pivot -= h[i] * h[i];
    set->H[j + i * s->kmax] = h[i];
  }
  *factored = (PetscBool)(pivot > set->shift * s->G[j]);
  if (*factored) h[j] = PetscSqrtReal(pivot);
  PetscFunctionReturn(0);
}

/* Factors H. If only a few directions are new, they are added to the factor. *factored: false if H is indefinite. */
static PetscErrorCode ActiveSetFactorDirections(IPActiveSet *set, const IPReducedSystem *s, PetscBool *factored)
{
  const PetscInt few = 4;

  PetscFunctionBegin;
  *factored = (PetscBool)(set->nfactored && s->k - set->nfactored <= few);
  for (PetscInt j = set->nfactored; j < s->k && *factored; j++)
    PetscCall(ActiveSetFactorDirection(set, s, j, factored));
  if (s->k && !*factored) PetscCall(ActiveSetFactorAllDirections(set, s, factored));
  if (!s->k) *factored = PETSC_TRUE;
  set->nfactored = *factored ? s->k : 0;
  PetscFunctionReturn(0);
}

/* Computes y = H^-1 (t - V^T r) and lambda_A = L^-T (V y + r) with r = L^-1 h_A */
static PetscErrorCode ActiveSetBackSubstitute(IPActiveSet *set, const IPReducedSystem *s)
{
  const PetscReal one = 1.0, minus = -1.0;
  PetscBLASInt    n, k, ld, inc = 1, info;

  PetscFunctionBegin;
  PetscCall(PetscBLASIntCast(set->n, &n));
  PetscCall(PetscBLASIntCast(s->k, &k));
  PetscCall(PetscBLASIntCast(s->kmax, &ld));
  for (PetscInt i = 0; i < set->n; i++) set->r[i] = s->h[set->rows[i]];
  if (n) PetscCallBLAS("BLAStrsm", BLAStrsm_("L", "L", "N", "N", &n, &inc, &one, set->L, &n, set->r, &n));
  PetscCall(PetscArraycpy(s->y, s->t, s->k));
  if (n && k) PetscCallBLAS("BLASgemv", BLASgemv_("T", &n, &k, &minus, set->V, &n, set->r, &inc, &one, s->y, &inc));
  if (k) {
    PetscCallBLAS("LAPACKpotrs", LAPACKpotrs_("L", &k, &inc, set->H, &ld, s->y, &k, &info));
    PetscCheck(!info, PETSC_COMM_SELF, PETSC_ERR_LIB, "LAPACK's potrs returned %d for %d directions", (int)info,
      (int)k);
  }
  if (n && k) PetscCallBLAS("BLASgemv", BLASgemv_("N", &n, &k, &one, set->V, &n, s->y, &inc, &one, set->r, &inc));
  if (n) PetscCallBLAS("BLAStrsm", BLAStrsm_("L", "L", "T", "N", &n, &inc, &one, set->L, &n, set->r, &n));
  PetscCall(PetscArrayzero(s->lambda, s->m));
  for (PetscInt i = 0; i < set->n; i++) s->lambda[set->rows[i]] = set->r[i];
  PetscFunctionReturn(0);
}

/* Computes gap = C lambda - JZ y - h */
static PetscErrorCode ActiveSetGap(const IPActiveSet *set, const IPCompliance *c, const IPReducedSystem *s)
{
  const PetscReal one = 1.0, minus = -1.0;
  PetscBLASInt    m, k, inc = 1;

  PetscFunctionBegin;
  PetscCall(PetscBLASIntCast(s->m, &m));
  PetscCall(PetscBLASIntCast(s->k, &k));
  for (PetscInt i = 0; i < s->m; i++) s->gap[i] = -s->h[i];
  if (k) PetscCallBLAS("BLASgemv", BLASgemv_("N", &m, &k, &minus, s->JZ, &m, s->y, &inc, &one, s->gap, &inc));
  for (PetscInt i = 0; i < set->n; i++)
    PetscCallBLAS("BLASaxpy",
      BLASaxpy_(&m, &s->lambda[set->rows[i]], IPComplianceColumn(c, set->rows[i]), &inc, s->gap, &inc));
  PetscFunctionReturn(0);
}

/* Solves for lambda, y and gap with the present active set */
PetscErrorCode IPActiveSetSolveRows(IPActiveSet *set, IPCompliance *c, const IPReducedSystem *s, PetscBool *solved)
{
  PetscFunctionBegin;
  *solved = PETSC_TRUE;
  if (!set->factored) {
    PetscCall(ActiveSetList(set, c));
    PetscCall(ActiveSetFactorRows(set, c, solved));
    if (!*solved) PetscFunctionReturn(0);
    set->factored = PETSC_TRUE;
  }
  PetscCall(ActiveSetFactorColumns(set, s));
  PetscCall(ActiveSetFactorDirections(set, s, solved));
  if (!*solved) PetscFunctionReturn(0);
  PetscCall(ActiveSetBackSubstitute(set, s));
  PetscCall(ActiveSetGap(set, c, s));
  PetscFunctionReturn(0);
}

/*
   Returns whether a row is in the wrong set: an active row with a tensile force, or an inactive one with a penetration
   beyond rounding
*/
static PetscBool ActiveSetMisplaced(const IPActiveSet *set, const IPReducedSystem *s, PetscInt i)
{
  const PetscReal rounding = 1e-13;

  return (PetscBool)(set->active[i] ? s->lambda[i] < 0.0 : s->gap[i] < -rounding * s->length);
}

/* Exchanges all rows that are in the wrong set */
static void ActiveSetExchange(IPActiveSet *set, const IPReducedSystem *s)
{
  for (PetscInt i = 0; i < set->m; i++)
    if (ActiveSetMisplaced(set, s, i)) set->active[i] = (PetscBool)!set->active[i];
  set->factored = PETSC_FALSE;
}

/*
   Moves the forces x towards those of the present active set, as far as they remain compressive, and removes the rows
   whose force has vanished. Returns the fraction of the way.
*/
static PetscReal ActiveSetMove(IPActiveSet *set, const IPReducedSystem *s, PetscReal x[])
{
  PetscReal alpha = 1.0;

  for (PetscInt i = 0; i < set->m; i++)
    if (set->active[i] && s->lambda[i] < 0.0) alpha = PetscMin(alpha, x[i] / (x[i] - s->lambda[i]));
  for (PetscInt i = 0; i < set->m; i++) {
    if (!set->active[i]) continue;
    set->active[i] = (PetscBool)(s->lambda[i] >= 0.0 || x[i] > alpha * (x[i] - s->lambda[i]));
    x[i]           = set->active[i] ? x[i] + alpha * (s->lambda[i] - x[i]) : 0.0;
  }
  return alpha;
}

/* Activates the row with the largest penetration. Returns whether there is one. */
static PetscBool ActiveSetAddWorst(IPActiveSet *set, const IPReducedSystem *s)
{
  PetscInt worst = -1;

  for (PetscInt i = 0; i < set->m; i++)
    if (!set->active[i] && ActiveSetMisplaced(set, s, i) && (worst < 0 || s->gap[i] < s->gap[worst])) worst = i;
  if (worst >= 0) set->active[worst] = PETSC_TRUE;
  return (PetscBool)(worst >= 0);
}

/*
   Adds and removes single rows such that the energy of the forces falls in each step. The first rows are those that are
   active and compressed. *solved: false if a row cannot be added although it penetrates, which is a rounding error, or
   after too many steps
*/
static PetscErrorCode ActiveSetDescend(IPActiveSet *set, IPCompliance *c, const IPReducedSystem *s, PetscInt *steps,
  PetscBool *solved)
{
  const PetscInt limit = set->m; /* up to half as many were needed in 60 stacks of beams and in leaf springs */
  PetscBool      more  = PETSC_TRUE;
  PetscReal     *x, fraction = 1.0;

  PetscFunctionBegin;
  PetscCall(PetscMalloc1(set->m, &x));
  for (PetscInt i = 0; i < set->m; i++) {
    x[i]           = set->active[i] ? PetscMax(s->lambda[i], 0.0) : 0.0;
    set->active[i] = (PetscBool)(x[i] > 0.0);
  }
  *solved = PETSC_TRUE;
  for (PetscInt k = 0; more && *solved; k++) {
    set->factored = PETSC_FALSE;
    ++*steps;
    PetscCall(IPActiveSetSolveRows(set, c, s, solved));
    if (!*solved) break;
    fraction = ActiveSetMove(set, s, x);
    if (fraction == 1.0) more = ActiveSetAddWorst(set, s);
    *solved = (PetscBool)(fraction > 0.0 && k < limit);
  }
  PetscCall(PetscFree(x));
  PetscFunctionReturn(0);
}

/*
   Exchanges rows until none is in the wrong set, starting from the last active set. All wrong rows are exchanged while
   their number falls; that is fast, but may cycle. *steps: increased by the number of systems solved. *solved: false if
   the active set keeps changing.
*/
static PetscErrorCode ActiveSetExchangeAll(IPActiveSet *set, IPCompliance *c, const IPReducedSystem *s, PetscInt *steps,
  PetscBool *solved)
{
  const PetscInt patience = 5;
  PetscInt       least = PETSC_MAX_INT, left = patience;

  PetscFunctionBegin;
  for (;;) {
    PetscInt misplaced = 0;

    ++*steps;
    PetscCall(IPActiveSetSolveRows(set, c, s, solved));
    if (!*solved) PetscFunctionReturn(0);
    for (PetscInt i = 0; i < set->m; i++) misplaced += ActiveSetMisplaced(set, s, i);
    if (!misplaced) PetscFunctionReturn(0);
    left  = misplaced < least ? patience : left - 1;
    least = PetscMin(least, misplaced);
    if (left < 0) break;
    ActiveSetExchange(set, s);
  }
  PetscCall(ActiveSetDescend(set, c, s, steps, solved));
  PetscFunctionReturn(0);
}

/*
   Solves with additional stiffness, which decreases to zero. Each problem starts from the last active set. Bodies that
   almost nothing but constraints holds would otherwise move far if too few rows are active, which exchanges many rows.
*/
static PetscErrorCode ActiveSetSoften(IPActiveSet *set, IPCompliance *c, const IPReducedSystem *s, PetscInt *steps,
  PetscBool *solved)
{
  const PetscReal first = 0.1, last = 1e-9;

  PetscFunctionBegin;
  *solved = PETSC_TRUE;
  for (PetscReal least = first; *solved && least > last; least *= 0.1) {
    set->least     = least;
    set->nfactored = 0;
    PetscCall(ActiveSetExchangeAll(set, c, s, steps, solved));
  }
  set->least     = 0.0;
  set->nfactored = 0;
  if (*solved) PetscCall(ActiveSetExchangeAll(set, c, s, steps, solved));
  PetscFunctionReturn(0);
}

/*
   Solves the contact problem for lambda, gap and y, starting from the last active set. *steps: number of systems
   solved. *solved: false if the active set keeps changing.
*/
PetscErrorCode IPActiveSetSolve(IPActiveSet *set, IPCompliance *c, const IPReducedSystem *s, PetscInt *steps,
  PetscBool *solved)
{
  PetscBool *first;

  PetscFunctionBegin;
  *steps = 0;
  PetscCall(PetscMalloc1(set->m, &first));
  PetscCall(PetscArraycpy(first, set->active, set->m));
  PetscCall(ActiveSetExchangeAll(set, c, s, steps, solved));
  if (!*solved && s->soft) {
    PetscCall(PetscArraycpy(set->active, first, set->m));
    set->factored = PETSC_FALSE;
    PetscCall(ActiveSetSoften(set, c, s, steps, solved));
  }
  PetscCall(PetscFree(first));
  PetscFunctionReturn(0);
}
