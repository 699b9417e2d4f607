/*
   The reduced problem: the contact problem in the subspace span{e_i : i in W} + span(P),
     min 1/2 v^T K v + g^T v,  J v + c + compliance x lambda >= 0,  v = E w + P y,
   where lambda are the forces of the constraints, whose own compliance is usually zero, and E has the columns e_i, i in
   W. Its data have the size of the constraints. They are gathered on the first rank, which solves the problem. K_WW is
   factored once as long as W and K are unchanged, with companions (companions.c) if it is singular.
*/
#include "subspaceimpl.h"
#include <petscblaslapack.h>

/* Destroys the data of the constraints, but not the space */
PetscErrorCode IPReducedRelease(IPReduced *r)
{
  IPReducedSystem *s = &r->system;

  PetscFunctionBegin;
  PetscCall(VecScatterDestroy(&r->to_rows));
  PetscCall(VecDestroy(&r->on_rows));
  PetscCall(VecDestroy(&r->scale));
  PetscCall(IPComplianceSetRows(&r->compliance, NULL, 0));
  PetscCall(IPActiveSetDestroy(&r->set));
  PetscCall(PetscFree5(s->JZ, s->h, s->lambda, s->gap, s->y));
  PetscFunctionReturn(0);
}

PetscErrorCode IPReducedDestroy(IPReduced *r)
{
  PetscFunctionBegin;
  PetscCall(IPReducedRelease(r));
  PetscCall(VecScatterDestroy(&r->to_W));
  PetscCall(VecDestroy(&r->on_W));
  PetscCall(ISDestroy(&r->W));
  PetscCall(ISDestroy(&r->own));
  PetscCall(MatDestroy(&r->KWW));
  PetscCall(IPComplianceDestroy(&r->compliance));
  PetscCall(IPCompanionsDestroy(&r->companions));
  PetscCall(PetscFree3(r->system.T, r->system.t, r->system.G));
  PetscCall(PetscFree4(r->Z, r->g, r->x, r->z));
  PetscCall(PetscMemzero(r, sizeof(*r)));
  PetscFunctionReturn(0);
}

/* Factors K_WW, with companions if it is singular. *definite: false if it has a negative eigenvalue. */
static PetscErrorCode ReducedFactorFirst(IPReduced *r, PetscBool *definite)
{
  PetscBool singular = PETSC_FALSE, negative = PETSC_FALSE;

  PetscFunctionBegin;
  PetscCall(IPComplianceSetUp(&r->compliance, r->KWW, definite));
  if (!*definite) PetscCall(IPComplianceIsNegative(r->KWW, &negative));
  if (negative) PetscFunctionReturn(0);
  if (*definite) PetscCall(IPCompanionsAreNeeded(r->KWW, &r->compliance, &singular));
  if (!*definite || singular) PetscCall(IPCompanionsTake(r->KWW, &r->companions));
  if (r->companions.n) PetscCall(IPComplianceSetUp(&r->compliance, r->KWW, definite));
  PetscFunctionReturn(0);
}

static PetscErrorCode ReducedFactor(IPReduced *r, PetscBool *definite)
{
  PetscFunctionBegin;
  *definite = PETSC_FALSE;
  PetscCall(IPReducedBroadcast(r, r->first ? ReducedFactorFirst(r, definite) : (PetscErrorCode)0, definite));
  PetscCallMPI(MPI_Bcast(&r->companions.n, 1, MPIU_INT, 0, PetscObjectComm((PetscObject)r->on_W)));
  PetscFunctionReturn(0);
}

static PetscReal ReducedDot(PetscInt n, const PetscReal a[], const PetscReal b[])
{
  PetscReal sum = 0.0;

  for (PetscInt i = 0; i < n; i++) sum += a[i] * b[i];
  return sum;
}

/*
   Adds n coordinates to y. Q: their forces on W, one column each. T receives their energies with the earlier
   coordinates and with one another, in columns of length kmax.
*/
static PetscErrorCode ReducedAppendColumns(IPReduced *r, PetscInt n, const PetscReal Q[])
{
  IPReducedSystem *s     = &r->system;
  const PetscReal  minus = -1.0, one = 1.0;
  const PetscInt   k = s->k;
  PetscReal       *Z = &r->Z[(size_t)k * (size_t)r->n], *T = &s->T[k * s->kmax];
  PetscBLASInt     all, nb, nw, ld, inc = 1;

  PetscFunctionBegin;
  for (PetscInt j = 0; j < n; j++) s->G[k + j] = T[k + j + j * s->kmax];
  PetscCall(IPComplianceSolve(&r->compliance, n, Q, Z));
  PetscCall(IPComplianceMultiply(&r->compliance, n, Z, s->JZ + (size_t)k * (size_t)s->m));
  PetscCall(PetscBLASIntCast(k + n, &all));
  PetscCall(PetscBLASIntCast(n, &nb));
  PetscCall(PetscBLASIntCast(r->n, &nw));
  PetscCall(PetscBLASIntCast(s->kmax, &ld));
  /* gemm would copy all of Z for a single column */
  if (n == 1) PetscCallBLAS("BLASgemv", BLASgemv_("T", &nw, &all, &minus, r->Z, &nw, Q, &inc, &one, T, &inc));
  else PetscCallBLAS("BLASgemm", BLASgemm_("T", "N", &all, &nb, &nw, &minus, r->Z, &nw, Q, &nw, &one, T, &ld));
  for (PetscInt j = k; j < k + n; j++) {
    for (PetscInt i = 0; i < j; i++) s->T[j + i * s->kmax] = s->T[i + j * s->kmax];
  }
  s->k += n;
  PetscFunctionReturn(0);
}

static PetscErrorCode ReducedAppendCompanions(IPReduced *r)
{
  const IPCompanions *c = &r->companions;
  IPReducedSystem    *s = &r->system;
  PetscReal          *Q;

  PetscFunctionBegin;
  if (!r->first) s->k = c->n;
  if (!r->first || !c->n) PetscFunctionReturn(0);
  PetscCall(PetscCalloc1((size_t)r->n * (size_t)c->n, &Q));
  for (PetscInt j = 0; j < c->n; j++) {
    Q[c->row[j] + (size_t)j * (size_t)r->n] = -c->spring[j];
    PetscCall(PetscArrayzero(s->T + j * s->kmax, c->n));
    s->T[j + j * s->kmax] = c->spring[j];
  }
  PetscCall(ReducedAppendColumns(r, c->n, Q));
  PetscCall(PetscFree(Q));
  PetscFunctionReturn(0);
}

/* Allocates the system of at most kmax directions and companions */
static PetscErrorCode ReducedAllocate(IPReduced *r, PetscInt kmax)
{
  IPReducedSystem *s = &r->system;

  PetscFunctionBegin;
  s->kmax        = kmax;
  s->ncompanions = r->companions.n;
  s->companion   = r->companions.row;
  PetscCall(PetscMalloc3(kmax * kmax, &s->T, kmax, &s->t, kmax, &s->G));
  PetscCall(PetscMalloc4((size_t)r->n * (size_t)kmax, &r->Z, r->n, &r->g, r->n, &r->x, r->n, &r->z));
  PetscFunctionReturn(0);
}

/* Finds whether two sequential AIJ matrices, which may be NULL, have the same nonzero pattern */
static PetscErrorCode ReducedHaveSamePattern(Mat A, Mat B, PetscBool *same)
{
  const PetscInt *ia, *ja, *ib, *jb;
  PetscInt        n, m;
  PetscBool       done;

  PetscFunctionBegin;
  *same = PETSC_FALSE;
  if (!A || !B) PetscFunctionReturn(0);
  PetscCall(MatGetRowIJ(A, 0, PETSC_FALSE, PETSC_FALSE, &n, &ia, &ja, &done));
  PetscCall(MatGetRowIJ(B, 0, PETSC_FALSE, PETSC_FALSE, &m, &ib, &jb, &done));
  if (n == m) PetscCall(PetscArraycmp(ia, ib, n + 1, same));
  if (*same) PetscCall(PetscArraycmp(ja, jb, ia[n], same));
  PetscCall(MatRestoreRowIJ(B, 0, PETSC_FALSE, PETSC_FALSE, &m, &ib, &jb, &done));
  PetscCall(MatRestoreRowIJ(A, 0, PETSC_FALSE, PETSC_FALSE, &n, &ia, &ja, &done));
  PetscFunctionReturn(0);
}

/* Creates the scatter of the entries W of a vector like x to the first rank */
static PetscErrorCode ReducedSetScatter(IPReduced *r, IS W, Vec x)
{
  IS              all, mine, places;
  const PetscInt *w;

  PetscFunctionBegin;
  PetscCall(ISAllGather(W, &all));
  PetscCall(ISGetIndices(all, &w));
  PetscCall(ISCreateGeneral(PETSC_COMM_SELF, r->n, w, PETSC_COPY_VALUES, &mine));
  PetscCall(ISRestoreIndices(all, &w));
  PetscCall(VecCreateMPI(PetscObjectComm((PetscObject)x), r->n, PETSC_DETERMINE, &r->on_W));
  PetscCall(ISCreateStride(PETSC_COMM_SELF, r->n, 0, 1, &places));
  PetscCall(VecScatterCreate(x, mine, r->on_W, places, &r->to_W));
  PetscCall(ISDestroy(&places));
  PetscCall(ISDestroy(&mine));
  PetscCall(ISDestroy(&all));
  PetscFunctionReturn(0);
}

/* Sets up the space for a new K or W: gathers and factors K_WW. own: the rows of K that belong to W */
static PetscErrorCode ReducedSetSpace(IPReduced *r, Mat K, IS own, IS W, Vec x, const IPBasis *basis,
  PetscBool *definite)
{
  PetscMPIInt rank;
  PetscInt    nw;
  PetscBool   same;
  Mat         former = r->KWW, factors = r->compliance.F;

  PetscFunctionBegin;
  PetscCall(PetscObjectReference((PetscObject)former));
  PetscCall(PetscObjectReference((PetscObject)factors));
  PetscCall(IPReducedDestroy(r));
  PetscCallMPI(MPI_Comm_rank(PetscObjectComm((PetscObject)x), &rank));
  r->first = (PetscBool)!rank;
  PetscCall(PetscObjectReference((PetscObject)W));
  r->W = W;
  PetscCall(PetscObjectReference((PetscObject)own));
  r->own = own;
  PetscCall(ISGetSize(own, &nw));
  if (r->first) r->n = nw;
  PetscCall(IPGatherStiffness(K, own, PETSC_TRUE, &r->KWW));
  PetscCall(ReducedSetScatter(r, W, x));
  PetscCall(ReducedHaveSamePattern(former, r->KWW, &same));
  if (same) r->compliance.F = factors;
  else PetscCall(MatDestroy(&factors));
  PetscCall(MatDestroy(&former));
  PetscCall(ReducedFactor(r, definite));
  PetscCall(IPReducedAgree(r, ReducedAllocate(r, r->companions.n + basis->max)));
  r->K_id = ((PetscObject)K)->id;
  PetscCall(PetscObjectStateGet((PetscObject)K, &r->K_state));
  PetscFunctionReturn(0);
}

/* Sets up the system's rows on this rank; on all but the first there are none. JW: J_W */
static PetscErrorCode ReducedSetLocalRows(IPReduced *r, Mat JW)
{
  IPReducedSystem *s = &r->system;

  PetscFunctionBegin;
  s->m = r->m;
  PetscCall(
    PetscMalloc5((size_t)s->m * (size_t)s->kmax, &s->JZ, s->m, &s->h, s->m, &s->lambda, s->m, &s->gap, s->kmax, &s->y));
  PetscCall(PetscArrayzero(s->lambda, s->m));
  PetscCall(PetscArrayzero(s->y, s->kmax));
  PetscCall(IPActiveSetCreate(r->m, &r->set));
  PetscCall(IPComplianceSetRows(&r->compliance, JW, s->kmax));
  if (r->first) PetscCall(IPComplianceMultiply(&r->compliance, s->k, r->Z, s->JZ));
  if (!s->k) PetscCall(ReducedAppendCompanions(r));
  PetscFunctionReturn(0);
}

/* Sets up the constraints for the present space and its directions. compliance: that of the rows, or NULL */
static PetscErrorCode ReducedSetRows(IPReduced *r, Mat J, Vec compliance, Vec c)
{
  IS              all;
  Mat             JW;
  const PetscInt *w;
  PetscInt        nw;

  PetscFunctionBegin;
  PetscCall(IPReducedRelease(r));
  if (r->first) PetscCall(VecGetSize(c, &r->m));
  PetscCall(ISAllGather(r->own, &all));
  PetscCall(ISGetSize(all, &nw));
  PetscCall(ISGetIndices(all, &w));
  PetscCall(IPGatherRows(J, nw, w, r->first, &JW));
  PetscCall(ISRestoreIndices(all, &w));
  PetscCall(ISDestroy(&all));
  PetscCall(VecScatterCreateToZero(c, &r->to_rows, &r->on_rows));
  PetscCall(IPReducedAgree(r, ReducedSetLocalRows(r, JW)));
  if (compliance) PetscCall(IPReducedFetch(r->to_rows, compliance, r->on_rows, r->m, r->compliance.own));
  PetscCall(MatDestroy(&JW));
  PetscFunctionReturn(0);
}

/* Finds whether the space was set up for this K */
static PetscErrorCode ReducedIsOf(const IPReduced *r, Mat K, PetscBool *same)
{
  PetscObjectState state;

  PetscFunctionBegin;
  PetscCall(PetscObjectStateGet((PetscObject)K, &state));
  *same = (PetscBool)(r->W && r->K_id == ((PetscObject)K)->id && r->K_state == state);
  PetscFunctionReturn(0);
}

/*
   Sets up the reduced problem. The factors of K_WW are reused while K and W are unchanged, and K_WW^-1 Q_W while the
   directions are unchanged. compliance: change of the rows' values per force; NULL: none; own: the rows of K, and
   columns of J, that belong to W: W itself, or the numbers in W if K and J have only these. *definite: false if K_WW is
   not positive definite.
*/
PetscErrorCode IPReducedSetUp(IPReduced *r, Mat K, Mat J, Vec compliance, IS own, IS W, Vec x, Vec c,
  const IPBasis *basis, PetscBool *definite)
{
  PetscFunctionBegin;
  PetscCall(ReducedIsOf(r, K, definite));
  if (*definite) PetscCall(ISEqual(r->W, W, definite));
  if (!*definite) {
    PetscCall(PetscLogEventBegin(TAO_IPFilterFactor, K, NULL, NULL, NULL));
    PetscCall(ReducedSetSpace(r, K, own, W, x, basis, definite));
    PetscCall(PetscLogEventEnd(TAO_IPFilterFactor, K, NULL, NULL, NULL));
  } else if (r->generation != basis->generation) r->system.k = r->companions.n;
  r->generation = basis->generation;
  if (*definite) PetscCall(ReducedSetRows(r, J, compliance, c));
  if (!*definite) PetscCall(IPReducedDestroy(r));
  PetscFunctionReturn(0);
}

/* Sets the initial active set: the rows whose `guess` is positive */
PetscErrorCode IPReducedGuess(IPReduced *r, Vec guess)
{
  PetscFunctionBegin;
  PetscCall(IPReducedFetch(r->to_rows, guess, r->on_rows, r->m, r->system.gap));
  for (PetscInt i = 0; i < r->m; i++) r->set.active[i] = (PetscBool)(r->system.gap[i] > 0.0);
  r->set.factored = PETSC_FALSE;
  PetscFunctionReturn(0);
}

/* Computes the load t of coordinate j of y */
static void ReducedLoad(IPReduced *r, PetscInt j, const PetscReal pg[])
{
  r->system.t[j] = ReducedDot(r->n, &r->Z[(size_t)j * (size_t)r->n], r->g);
  if (j >= r->companions.n) r->system.t[j] -= pg[j - r->companions.n];
}

/* Computes what follows from the forces r->g and the gaps s->gap: compliances, and loads of the directions */
static PetscErrorCode ReducedCenterFirst(IPReduced *r, const PetscReal pg[])
{
  IPReducedSystem *s = &r->system;

  PetscFunctionBegin;
  PetscCall(IPComplianceSolve(&r->compliance, 1, r->g, r->x));
  PetscCall(IPComplianceMultiply(&r->compliance, 1, r->x, s->h));
  s->length = 0.0;
  for (PetscInt i = 0; i < s->m; i++) {
    s->h[i] -= s->gap[i];
    s->length = PetscMax(s->length, PetscMax(PetscAbsReal(s->gap[i]), PetscAbsReal(s->h[i])));
  }
  PetscCall(PetscArrayzero(s->y, s->kmax));
  for (PetscInt j = 0; j < s->k; j++) ReducedLoad(r, j, pg);
  PetscFunctionReturn(0);
}

/* Sets the point to which v is relative: its gradient g, P^T g, and constraint values c */
PetscErrorCode IPReducedCenter(IPReduced *r, Vec gradient, Vec c, const PetscReal pg[])
{
  PetscFunctionBegin;
  PetscCall(IPReducedFetch(r->to_W, gradient, r->on_W, r->n, r->g));
  PetscCall(IPReducedFetch(r->to_rows, c, r->on_rows, r->m, r->system.gap));
  PetscCall(IPReducedAgree(r, r->first ? ReducedCenterFirst(r, pg) : (PetscErrorCode)0));
  PetscFunctionReturn(0);
}

/* Adds the directions of the basis that the reduced problem does not have yet. pg: P^T g of all directions. */
PetscErrorCode IPReducedAppend(IPReduced *r, const IPBasis *basis, const PetscReal pg[])
{
  IPReducedSystem *s      = &r->system;
  const PetscInt   before = r->companions.n, chunk = 64, most = PetscMin(chunk, before + basis->n - s->k);
  PetscReal       *Q;

  PetscFunctionBegin;
  if (most <= 0) PetscFunctionReturn(0);
  PetscCall(IPReducedAgree(r, PetscMalloc1((size_t)r->n * (size_t)most, &Q)));
  while (s->k < before + basis->n) {
    const PetscInt k = s->k, n = PetscMin(chunk, before + basis->n - k);

    for (PetscInt j = 0; j < n; j++) {
      PetscReal *T = &s->T[(k + j) * s->kmax];

      PetscCall(IPBasisGetForces(basis, k + j - before, basis->Kd));
      PetscCall(IPReducedFetch(r->to_W, basis->Kd, r->on_W, r->n, &Q[(size_t)j * (size_t)r->n]));
      PetscCall(PetscArrayzero(T, before));
      PetscCall(PetscArraycpy(T + before, &basis->gram[(k + j - before) * basis->max], k + n - before));
    }
    PetscCall(IPReducedAgree(r, r->first ? ReducedAppendColumns(r, n, Q) : (PetscErrorCode)0));
    if (!r->first) s->k += n;
    for (PetscInt j = k; j < k + n && r->first; j++) ReducedLoad(r, j, pg);
  }
  PetscCall(PetscFree(Q));
  PetscFunctionReturn(0);
}

/*
   Computes E = Q_W^T K_WW^-1 Q_W on all ranks, in columns of the basis's maximal length. E_jj is the part of a
   direction's energy that is released if the unknowns W move freely.
*/
PetscErrorCode IPReducedCoupling(const IPReduced *r, const IPBasis *basis, PetscReal E[])
{
  const IPReducedSystem *s      = &r->system;
  const PetscInt         before = r->companions.n, n = basis->max * basis->max;

  PetscFunctionBegin;
  PetscCall(PetscArrayzero(E, n));
  if (r->first) {
    for (PetscInt j = 0; j < basis->n; j++) {
      for (PetscInt i = 0; i < basis->n; i++)
        E[i + j * basis->max] = basis->gram[i + j * basis->max] - s->T[before + i + (before + j) * s->kmax];
    }
  }
  PetscCallMPI(MPI_Bcast(E, (PetscMPIInt)n, MPIU_REAL, 0, PetscObjectComm((PetscObject)r->on_W)));
  PetscFunctionReturn(0);
}

/* Replaces the directions by the present ones of the basis. The active set remains. */
PetscErrorCode IPReducedForget(IPReduced *r, const IPBasis *basis)
{
  PetscFunctionBegin;
  r->generation = basis->generation;
  r->system.k   = r->companions.n;
  r->set.k      = 0;
  if (r->first) PetscCall(PetscArrayzero(r->system.y, r->system.kmax));
  PetscFunctionReturn(0);
}

/* Computes w = K_WW^-1 (J_W^T lambda - g) by a solve */
static PetscErrorCode ReducedRecoverBySolve(IPReduced *r, PetscReal w[])
{
  PetscFunctionBegin;
  PetscCall(IPComplianceSpread(&r->compliance, r->system.lambda, r->z));
  for (PetscInt i = 0; i < r->n; i++) r->z[i] -= r->g[i];
  PetscCall(IPComplianceSolve(&r->compliance, 1, r->z, w));
  PetscFunctionReturn(0);
}

/*
   Computes w = K_WW^-1 (J_W^T lambda - g - Q_W y), from columns of K_WW^-1 J_W^T if they are known. r->x: K_WW^-1 g
*/
static PetscErrorCode ReducedRecoverFirst(IPReduced *r, PetscReal w[])
{
  const IPReducedSystem *s     = &r->system;
  const PetscReal        minus = -1.0, one = 1.0;
  PetscBLASInt           n, k, inc = 1;
  PetscBool              known;

  PetscFunctionBegin;
  PetscCall(IPComplianceExpand(&r->compliance, s->lambda, w, &known));
  if (known)
    for (PetscInt i = 0; i < r->n; i++) w[i] -= r->x[i];
  else PetscCall(ReducedRecoverBySolve(r, w));
  PetscCall(PetscBLASIntCast(r->n, &n));
  PetscCall(PetscBLASIntCast(s->k, &k));
  if (k) PetscCallBLAS("BLASgemv", BLASgemv_("N", &n, &k, &minus, r->Z, &n, s->y, &inc, &one, w, &inc));
  PetscFunctionReturn(0);
}

/* Collective. Sets the entries of v in W to w */
static PetscErrorCode ReducedRecover(IPReduced *r, Vec v)
{
  PetscReal *w;

  PetscFunctionBegin;
  PetscCall(IPReducedAgree(r, PetscMalloc1(r->n, &w)));
  PetscCall(IPReducedAgree(r, r->first ? ReducedRecoverFirst(r, w) : (PetscErrorCode)0));
  PetscCall(IPReducedSpread(r->to_W, r->n, w, r->on_W, v));
  PetscCall(PetscFree(w));
  PetscFunctionReturn(0);
}

static PetscErrorCode ReducedSolveFirst(IPReduced *r, PetscBool *solved)
{
  PetscFunctionBegin;
  PetscCall(IPActiveSetSolve(&r->set, &r->compliance, &r->system, &r->nsteps, solved));
  r->nactive = r->set.n;
  PetscFunctionReturn(0);
}

/*
   Solves the reduced problem. y: coefficients of the directions, on all ranks; v: its entries in W are set to w; force:
   lambda. Sets r->nactive and r->nsteps.
*/
PetscErrorCode IPReducedSolve(IPReduced *r, PetscReal y[], Vec v, Vec force, PetscBool *solved)
{
  IPReducedSystem *s    = &r->system;
  MPI_Comm         comm = PetscObjectComm((PetscObject)v);
  PetscInt         counts[2];

  PetscFunctionBegin;
  *solved = PETSC_FALSE;
  PetscCall(IPReducedBroadcast(r, r->first ? ReducedSolveFirst(r, solved) : (PetscErrorCode)0, solved));
  if (!*solved) PetscFunctionReturn(0);
  PetscCall(ReducedRecover(r, v));
  PetscCall(IPReducedSpread(r->to_rows, r->m, s->lambda, r->on_rows, force));
  PetscCallMPI(MPI_Bcast(s->y, (PetscMPIInt)s->k, MPIU_REAL, 0, comm));
  PetscCall(PetscArraycpy(y, s->y + r->companions.n, s->k - r->companions.n));
  counts[0] = r->nsteps;
  counts[1] = r->nactive;
  PetscCallMPI(MPI_Bcast(counts, 2, MPIU_INT, 0, comm));
  r->nsteps  = counts[0];
  r->nactive = counts[1];
  PetscFunctionReturn(0);
}

/*
   Solves for y and lambda with the present active set, for the forces r->g on W and the required motions s->gap of the
   rows
*/
static PetscErrorCode ReducedSolveActiveFirst(IPReduced *r, PetscBool *solved)
{
  IPReducedSystem *s = &r->system;

  PetscFunctionBegin;
  for (PetscInt i = 0; i < r->n; i++) r->g[i] = -r->g[i];
  PetscCall(IPComplianceSolve(&r->compliance, 1, r->g, r->x));
  PetscCall(IPComplianceMultiply(&r->compliance, 1, r->x, s->h));
  for (PetscInt i = 0; i < s->m; i++) s->h[i] += s->gap[i];
  for (PetscInt j = 0; j < s->k; j++) s->t[j] = ReducedDot(r->n, &r->Z[(size_t)j * (size_t)r->n], r->g);
  PetscCall(IPActiveSetSolveRows(&r->set, &r->compliance, s, solved));
  PetscFunctionReturn(0);
}

/*
   Sets the row scales d of the constraints. The problem is then that with the rows d J and the multipliers lambda / d.
   NULL: all scales are 1.
*/
PetscErrorCode IPReducedScale(IPReduced *r, Vec scale)
{
  PetscFunctionBegin;
  PetscCall(PetscObjectReference((PetscObject)scale));
  PetscCall(VecDestroy(&r->scale));
  r->scale = scale;
  PetscFunctionReturn(0);
}

/*
   Solves K v - J^T lambda = f in the subspace, with J v + compliance x lambda = c in the rows that were active at the
   last solution and lambda = 0 in the others. Only the entries of f in W are used. *solved: false if there are no
   constraints.
*/
PetscErrorCode IPReducedSolveActive(IPReduced *r, const IPBasis *basis, Vec f, Vec c, Vec v, Vec force,
  PetscBool *solved)
{
  IPReducedSystem *s = &r->system;

  PetscFunctionBegin;
  *solved = (PetscBool)(r->to_rows && r->generation == basis->generation && s->k == r->companions.n + basis->n);
  if (!*solved) PetscFunctionReturn(0);
  PetscCall(IPReducedFetch(r->to_W, f, r->on_W, r->n, r->g));
  if (r->scale) PetscCall(VecPointwiseMult(force, c, r->scale));
  PetscCall(IPReducedFetch(r->to_rows, r->scale ? force : c, r->on_rows, r->m, s->gap));
  PetscCall(IPReducedBroadcast(r, r->first ? ReducedSolveActiveFirst(r, solved) : (PetscErrorCode)0, solved));
  if (!*solved) PetscFunctionReturn(0);
  PetscCall(VecZeroEntries(v));
  PetscCall(ReducedRecover(r, v));
  PetscCall(IPReducedSpread(r->to_rows, r->m, s->lambda, r->on_rows, force));
  if (r->scale) PetscCall(VecPointwiseMult(force, force, r->scale));
  PetscCallMPI(MPI_Bcast(s->y, (PetscMPIInt)s->k, MPIU_REAL, 0, PetscObjectComm((PetscObject)v)));
  PetscCall(IPBasisAdd(basis, s->y + r->companions.n, v));
  PetscFunctionReturn(0);
}
