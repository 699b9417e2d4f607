/*
   The reduced problem: the contact problem in the subspace span{e_i : i in W} + span(P),
     min 1/2 v^T K v + g^T v,  J v + c >= 0,  v = E w + P y,
   where E has the columns e_i, i in W. Its data have the size of the constraints. They are gathered on the first rank,
   which solves the problem. K_WW is factored once as long as W and K are unchanged, with companions (companions.c) if
   it is singular. Each norm term adds two rows.
*/
#include "subspaceimpl.h"
#include "tao_ipfilter/solver/terms.h"
#include <petscblaslapack.h>

/*
   Selection of rows of a matrix A that are gathered on the first rank, restricted to the columns of W. half: A stores
   its upper triangle only.
*/
typedef struct {
  PetscInt        nrows, M;
  const PetscInt *rows, *place; /* local rows of A, and the numbers of these rows in the result, which has M rows */
  PetscInt        nw;
  const PetscInt *w;
  PetscBool       half;
  PetscBool       symmetric; /* zeros are stored as well: ordering codes need a symmetric pattern, and one of two
                                transposed entries may be zero */
} ReducedGather;

/*
   Inserts the entries of one row into S, or, if S is NULL, counts them in the rows of S. If A stores its upper triangle
   only, the transposed entries are inserted too; diagonal blocks are stored completely.
*/
static PetscErrorCode ReducedGatherRow(Mat A, const ReducedGather *g, PetscInt r, PetscInt column[],
  PetscScalar entry[], PetscInt counts[], Mat S)
{
  const PetscInt    *columns, row = g->place[r];
  const PetscScalar *values;
  PetscInt           nc, place, n = 0, nmirror = 0;

  PetscFunctionBegin;
  PetscCall(MatGetRow(A, g->rows[r], &nc, &columns, &values));
  for (PetscInt k = 0; k < nc; k++) {
    PetscCall(PetscFindInt(columns[k], g->nw, g->w, &place));
    if (place < 0 || (values[k] == 0.0 && !g->symmetric) || (g->half && columns[k] < g->rows[r])) continue;
    if (S) {
      column[n] = place;
      entry[n]  = values[k];
    } else if (g->half && place != row) counts[place]++;
    n++;
  }
  PetscCall(MatRestoreRow(A, g->rows[r], &nc, &columns, &values));
  if (S) {
    nmirror = g->half && n && column[0] == row;
    PetscCall(MatSetValues(S, 1, &row, n, column, entry, INSERT_VALUES));
    if (g->half) PetscCall(MatSetValues(S, n - nmirror, column + nmirror, 1, &row, entry + nmirror, INSERT_VALUES));
  } else counts[row] += n;
  PetscFunctionReturn(0);
}

/* Gets the local matrix of the first rank, which has all rows; NULL on the other ranks */
static PetscErrorCode ReducedTakeFirst(Mat all, PetscBool first, Mat *S)
{
  Mat diagonal;

  PetscFunctionBegin;
  *S = NULL;
  PetscCall(MatGetDiagonalBlock(all, &diagonal));
  if (first) {
    PetscCall(PetscObjectReference((PetscObject)diagonal));
    *S = diagonal;
  }
  PetscFunctionReturn(0);
}

static PetscErrorCode ReducedGatherMatrix(Mat A, const ReducedGather *g, PetscBool first, Mat *S)
{
  PetscInt    *counts, *column;
  PetscScalar *entry;
  Mat          all;

  PetscFunctionBegin;
  PetscCall(PetscCalloc3(g->M, &counts, g->nw, &column, g->nw, &entry));
  if (g->half) PetscCall(MatGetRowUpperTriangular(A));
  for (PetscInt r = 0; r < g->nrows; r++) PetscCall(ReducedGatherRow(A, g, r, column, entry, counts, NULL));
  PetscCallMPI(
    MPI_Allreduce(MPI_IN_PLACE, counts, (PetscMPIInt)g->M, MPIU_INT, MPI_SUM, PetscObjectComm((PetscObject)A)));
  PetscCall(MatCreate(PetscObjectComm((PetscObject)A), &all));
  PetscCall(MatSetSizes(all, first ? g->M : 0, first ? g->nw : 0, g->M, g->nw));
  PetscCall(MatSetType(all, MATAIJ));
  PetscCall(MatXAIJSetPreallocation(all, 1, counts, NULL, NULL, NULL));
  for (PetscInt r = 0; r < g->nrows; r++) PetscCall(ReducedGatherRow(A, g, r, column, entry, counts, all));
  if (g->half) PetscCall(MatRestoreRowUpperTriangular(A));
  PetscCall(MatAssemblyBegin(all, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(all, MAT_FINAL_ASSEMBLY));
  PetscCall(PetscFree3(counts, column, entry));
  PetscCall(ReducedTakeFirst(all, first, S));
  PetscCall(MatDestroy(&all));
  PetscFunctionReturn(0);
}

/* Gathers K_WW. own: local part of W; w: all of W. */
static PetscErrorCode ReducedGatherStiffness(Mat K, IS own, PetscInt nw, const PetscInt w[], PetscBool first, Mat *S)
{
  ReducedGather g = {.M = nw, .nw = nw, .w = w, .symmetric = PETSC_TRUE};
  PetscInt     *place, start;

  PetscFunctionBegin;
  PetscCall(PetscObjectTypeCompareAny((PetscObject)K, &g.half, MATSEQSBAIJ, MATMPISBAIJ, ""));
  PetscCall(ISGetLocalSize(own, &g.nrows));
  PetscCall(ISGetIndices(own, &g.rows));
  PetscCall(PetscMalloc1(g.nrows, &place));
  PetscCallMPI(MPI_Scan(&g.nrows, &start, 1, MPIU_INT, MPI_SUM, PetscObjectComm((PetscObject)K)));
  for (PetscInt r = 0; r < g.nrows; r++) place[r] = start - g.nrows + r;
  g.place = place;
  PetscCall(ReducedGatherMatrix(K, &g, first, S));
  PetscCall(PetscFree(place));
  PetscCall(ISRestoreIndices(own, &g.rows));
  PetscFunctionReturn(0);
}

static PetscErrorCode ReducedGatherRows(Mat J, PetscInt nw, const PetscInt w[], PetscBool first, Mat *S)
{
  ReducedGather g = {.nw = nw, .w = w};
  PetscInt     *rows, start, end;

  PetscFunctionBegin;
  PetscCall(MatGetOwnershipRange(J, &start, &end));
  PetscCall(MatGetSize(J, &g.M, NULL));
  g.nrows = end - start;
  PetscCall(PetscMalloc1(g.nrows, &rows));
  for (PetscInt r = 0; r < g.nrows; r++) rows[r] = start + r;
  g.rows = g.place = rows;
  PetscCall(ReducedGatherMatrix(J, &g, first, S));
  PetscCall(PetscFree(rows));
  PetscFunctionReturn(0);
}

/* Stacks the rows of two sequential matrices */
static PetscErrorCode ReducedStackRows(Mat upper, Mat lower, Mat *both)
{
  const Mat parts[2] = {upper, lower};
  PetscInt  m[2], n, *counts;

  PetscFunctionBegin;
  PetscCall(MatGetSize(upper, &m[0], &n));
  PetscCall(MatGetSize(lower, &m[1], NULL));
  PetscCall(PetscMalloc1(m[0] + m[1], &counts));
  for (PetscInt pass = 0; pass < 2; pass++) {
    if (pass) PetscCall(MatCreateSeqAIJ(PETSC_COMM_SELF, m[0] + m[1], n, 0, counts, both));
    for (PetscInt r = 0; r < m[0] + m[1]; r++) {
      const PetscInt     b = r >= m[0];
      const PetscInt    *columns;
      const PetscScalar *values;
      PetscInt           nc;

      PetscCall(MatGetRow(parts[b], r - b * m[0], &nc, &columns, &values));
      counts[r] = nc;
      if (pass) PetscCall(MatSetValues(*both, 1, &r, nc, columns, values, INSERT_VALUES));
      PetscCall(MatRestoreRow(parts[b], r - b * m[0], &nc, &columns, &values));
    }
  }
  PetscCall(MatAssemblyBegin(*both, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(*both, MAT_FINAL_ASSEMBLY));
  PetscCall(PetscFree(counts));
  PetscFunctionReturn(0);
}

/* Broadcasts the first rank's verdict. An error on the first rank is raised on all ranks. */
static PetscErrorCode ReducedBroadcast(const IPReduced *r, PetscErrorCode error, PetscBool *verdict)
{
  PetscMPIInt said[2] = {(PetscMPIInt)error, (PetscMPIInt)*verdict};

  PetscFunctionBegin;
  PetscCallMPI(MPI_Bcast(said, 2, MPI_INT, 0, PetscObjectComm((PetscObject)r->on_W)));
  PetscCall(error);
  PetscCheck(!said[0], PETSC_COMM_SELF, (PetscErrorCode)said[0],
    "The reduced problem of the filtered subspace failed on the first rank, with error %d", said[0]);
  *verdict = (PetscBool)said[1];
  PetscFunctionReturn(0);
}

/* Raises an error of the first rank on all ranks. error: what a function returned that only the first rank needs */
static PetscErrorCode ReducedAgree(const IPReduced *r, PetscErrorCode error)
{
  PetscBool none = PETSC_FALSE;

  PetscFunctionBegin;
  PetscCall(ReducedBroadcast(r, error, &none));
  PetscFunctionReturn(0);
}

/* Gathers J_W, followed by T_W if there are norm terms */
static PetscErrorCode ReducedGatherJacobian(const IPReduced *r, Mat J, const IPTerms *terms, PetscInt nw,
  const PetscInt w[], Mat *S)
{
  Mat JW, TW;

  PetscFunctionBegin;
  if (!terms->n) {
    PetscCall(ReducedGatherRows(J, nw, w, r->first, S));
    PetscFunctionReturn(0);
  }
  PetscCall(ReducedGatherRows(J, nw, w, r->first, &JW));
  PetscCall(ReducedGatherRows(terms->T, nw, w, r->first, &TW));
  *S = NULL;
  PetscCall(ReducedAgree(r, r->first ? ReducedStackRows(JW, TW, S) : (PetscErrorCode)0));
  PetscCall(MatDestroy(&TW));
  PetscCall(MatDestroy(&JW));
  PetscFunctionReturn(0);
}

/* Destroys the data of the constraints, but not the space */
PetscErrorCode IPReducedRelease(IPReduced *r)
{
  IPReducedSystem *s = &r->system;

  PetscFunctionBegin;
  PetscCall(VecScatterDestroy(&r->to_rows));
  PetscCall(VecDestroy(&r->on_rows));
  PetscCall(VecDestroy(&r->scale));
  PetscCall(VecScatterDestroy(&r->to_terms));
  PetscCall(VecDestroy(&r->on_terms));
  if (r->laws) PetscCall(r->lawsops->destroy(&r->laws));
  PetscCall(IPComplianceSetRows(&r->compliance, NULL, 0));
  PetscCall(IPActiveSetDestroy(&r->set));
  PetscCall(PetscFree5(s->JZ, s->h, s->lambda, s->gap, s->y));
  PetscCall(PetscFree(s->base));
  PetscCall(PetscFree2(s->spring, s->start));
  PetscFunctionReturn(0);
}

PetscErrorCode IPReducedDestroy(IPReduced *r)
{
  PetscFunctionBegin;
  PetscCall(IPReducedRelease(r));
  PetscCall(VecScatterDestroy(&r->to_W));
  PetscCall(VecDestroy(&r->on_W));
  PetscCall(ISDestroy(&r->W));
  PetscCall(MatDestroy(&r->KWW));
  PetscCall(IPComplianceDestroy(&r->compliance));
  PetscCall(IPCompanionsDestroy(&r->companions));
  PetscCall(PetscFree3(r->system.T, r->system.t, r->system.G));
  PetscCall(PetscFree4(r->Z, r->g, r->x, r->z));
  PetscCall(PetscMemzero(r, sizeof(*r)));
  PetscFunctionReturn(0);
}

/* Factors K_WW, with companions if it is singular. *definite: false if it is not positive definite. */
static PetscErrorCode ReducedFactorFirst(IPReduced *r, PetscBool *definite)
{
  PetscBool singular = PETSC_FALSE;

  PetscFunctionBegin;
  PetscCall(IPComplianceSetUp(&r->compliance, r->KWW, definite));
  if (*definite) PetscCall(IPCompanionsAreNeeded(r->KWW, &r->compliance, &singular));
  if (!*definite || singular) PetscCall(IPCompanionsTake(r->KWW, &r->companions));
  if (r->companions.n) PetscCall(IPComplianceSetUp(&r->compliance, r->KWW, definite));
  PetscFunctionReturn(0);
}

static PetscErrorCode ReducedFactor(IPReduced *r, PetscBool *definite)
{
  PetscFunctionBegin;
  *definite = PETSC_FALSE;
  PetscCall(ReducedBroadcast(r, r->first ? ReducedFactorFirst(r, definite) : (PetscErrorCode)0, definite));
  PetscCallMPI(MPI_Bcast(&r->companions.n, 1, MPIU_INT, 0, PetscObjectComm((PetscObject)r->on_W)));
  PetscFunctionReturn(0);
}

/* Gathers the entries of v in the array a of length n on the first rank */
static PetscErrorCode ReducedFetch(VecScatter scatter, Vec v, Vec on_first, PetscInt n, PetscReal a[])
{
  const PetscScalar *values;

  PetscFunctionBegin;
  PetscCall(VecScatterBegin(scatter, v, on_first, INSERT_VALUES, SCATTER_FORWARD));
  PetscCall(VecScatterEnd(scatter, v, on_first, INSERT_VALUES, SCATTER_FORWARD));
  PetscCall(VecGetArrayRead(on_first, &values));
  PetscCall(PetscArraycpy(a, values, n));
  PetscCall(VecRestoreArrayRead(on_first, &values));
  PetscFunctionReturn(0);
}

/* Distributes the array a of the first rank to the entries of v; other entries of v are unchanged */
static PetscErrorCode ReducedSpread(VecScatter scatter, PetscInt n, const PetscReal a[], Vec on_first, Vec v)
{
  PetscScalar *values;

  PetscFunctionBegin;
  PetscCall(VecGetArrayWrite(on_first, &values));
  PetscCall(PetscArraycpy(values, a, n));
  PetscCall(VecRestoreArrayWrite(on_first, &values));
  PetscCall(VecScatterBegin(scatter, on_first, v, INSERT_VALUES, SCATTER_REVERSE));
  PetscCall(VecScatterEnd(scatter, on_first, v, INSERT_VALUES, SCATTER_REVERSE));
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

/* Sets up the space for a new K or W: gathers and factors K_WW */
static PetscErrorCode ReducedSetSpace(IPReduced *r, Mat K, IS W, Vec x, const IPBasis *basis, PetscBool *definite)
{
  PetscMPIInt     rank;
  IS              all, mine, places;
  const PetscInt *w;
  PetscInt        nw;

  PetscFunctionBegin;
  PetscCall(IPReducedDestroy(r));
  PetscCallMPI(MPI_Comm_rank(PetscObjectComm((PetscObject)x), &rank));
  r->first = (PetscBool)!rank;
  PetscCall(PetscObjectReference((PetscObject)W));
  r->W = W;
  PetscCall(ISAllGather(W, &all));
  PetscCall(ISGetSize(all, &nw));
  PetscCall(ISGetIndices(all, &w));
  if (r->first) r->n = nw;
  PetscCall(ReducedGatherStiffness(K, W, nw, w, r->first, &r->KWW));
  PetscCall(ISCreateGeneral(PETSC_COMM_SELF, r->n, w, PETSC_COPY_VALUES, &mine));
  PetscCall(ISRestoreIndices(all, &w));
  PetscCall(ISDestroy(&all));
  PetscCall(VecCreateMPI(PetscObjectComm((PetscObject)x), r->n, PETSC_DETERMINE, &r->on_W));
  PetscCall(ISCreateStride(PETSC_COMM_SELF, r->n, 0, 1, &places));
  PetscCall(VecScatterCreate(x, mine, r->on_W, places, &r->to_W));
  PetscCall(ISDestroy(&places));
  PetscCall(ISDestroy(&mine));
  PetscCall(ReducedFactor(r, definite));
  PetscCall(ReducedAgree(r, ReducedAllocate(r, r->companions.n + basis->max)));
  r->K_id = ((PetscObject)K)->id;
  PetscCall(PetscObjectStateGet((PetscObject)K, &r->K_state));
  PetscFunctionReturn(0);
}

/* Sets up the system's rows on this rank; on all but the first there are none. JW: J_W, followed by T_W */
static PetscErrorCode ReducedSetLocalRows(IPReduced *r, Mat JW, PetscBool *definite)
{
  IPReducedSystem *s = &r->system;

  PetscFunctionBegin;
  s->m = r->m + 2 * r->nterms;
  PetscCall(
    PetscMalloc5((size_t)s->m * (size_t)s->kmax, &s->JZ, s->m, &s->h, s->m, &s->lambda, s->m, &s->gap, s->kmax, &s->y));
  PetscCall(PetscCalloc1(s->m, &s->base));
  PetscCall(PetscArrayzero(s->lambda, s->m));
  PetscCall(PetscArrayzero(s->y, s->kmax));
  if (!r->nterms) PetscCall(IPActiveSetCreate(r->m, &r->set));
  PetscCall(IPComplianceSetRows(&r->compliance, JW, r->nterms ? 0 : s->kmax));
  if (r->first) PetscCall(IPComplianceMultiply(&r->compliance, s->k, r->Z, s->JZ));
  if (!s->k) PetscCall(ReducedAppendCompanions(r));
  if (r->nterms)
    PetscCall(r->lawsops->create(r->m, r->nterms, s->kmax, r->KWW, r->compliance.F, JW, &r->laws, definite));
  PetscFunctionReturn(0);
}

/* Sets up the constraints and norm terms for the present space and its directions */
static PetscErrorCode ReducedSetRows(IPReduced *r, const IPLawsOps *ops, Mat J, const IPTerms *terms, Vec c,
  PetscBool *definite)
{
  IS              all;
  Mat             JW;
  const PetscInt *w;
  PetscInt        nw;

  PetscFunctionBegin;
  PetscCall(IPReducedRelease(r));
  r->lawsops = ops;
  if (r->first) {
    PetscCall(VecGetSize(c, &r->m));
    r->nterms = terms->n;
  }
  PetscCall(ISAllGather(r->W, &all));
  PetscCall(ISGetSize(all, &nw));
  PetscCall(ISGetIndices(all, &w));
  PetscCall(ReducedGatherJacobian(r, J, terms, nw, w, &JW));
  PetscCall(ISRestoreIndices(all, &w));
  PetscCall(ISDestroy(&all));
  PetscCall(VecScatterCreateToZero(c, &r->to_rows, &r->on_rows));
  if (terms->n) PetscCall(VecScatterCreateToZero(terms->t, &r->to_terms, &r->on_terms));
  PetscCall(ReducedBroadcast(r, ReducedSetLocalRows(r, JW, definite), definite));
  PetscCall(MatDestroy(&JW));
  PetscFunctionReturn(0);
}

/* Finds whether the space was set up for this K */
PetscErrorCode IPReducedIsOf(const IPReduced *r, Mat K, PetscBool *same)
{
  PetscObjectState state;

  PetscFunctionBegin;
  PetscCall(PetscObjectStateGet((PetscObject)K, &state));
  *same = (PetscBool)(r->W && r->K_id == ((PetscObject)K)->id && r->K_state == state);
  PetscFunctionReturn(0);
}

/*
   Sets up the reduced problem. The factors of K_WW are reused while K and W are unchanged, and K_WW^-1 Q_W while the
   directions are unchanged. *definite: false if K_WW is not positive definite.
*/
PetscErrorCode IPReducedSetUp(IPReduced *r, const IPLawsOps *ops, Mat K, Mat J, const IPTerms *terms, IS W, Vec x,
  Vec c, const IPBasis *basis, PetscBool *definite)
{
  PetscFunctionBegin;
  PetscCall(IPReducedIsOf(r, K, definite));
  if (*definite) PetscCall(ISEqual(r->W, W, definite));
  if (!*definite) {
    PetscCall(PetscLogEventBegin(TAO_IPFilterFactor, K, NULL, NULL, NULL));
    PetscCall(ReducedSetSpace(r, K, W, x, basis, definite));
    PetscCall(PetscLogEventEnd(TAO_IPFilterFactor, K, NULL, NULL, NULL));
  } else if (r->generation != basis->generation) r->system.k = r->companions.n;
  r->generation = basis->generation;
  if (*definite) PetscCall(ReducedSetRows(r, ops, J, terms, c, definite));
  if (!*definite) PetscCall(IPReducedDestroy(r));
  PetscFunctionReturn(0);
}

/*
   Sets the limits, coefficients and immovable directions of the norm terms. scale: scales of the rows of c_I; NULL: all
   are 1.
*/
PetscErrorCode IPReducedSetTerms(IPReduced *r, const IPTerms *terms, Vec scale)
{
  const Vec  given[2] = {terms->limit, terms->coefficient};
  IPLawsData data     = {0};
  PetscReal *values[2];
  Vec        scaled;

  PetscFunctionBegin;
  if (!terms->n) PetscFunctionReturn(0);
  if (r->laws) PetscCall(r->lawsops->getdata(r->laws, &data));
  PetscCall(ReducedFetch(r->to_terms, terms->rigid, r->on_terms, 2 * r->nterms, data.rigid));
  values[0] = data.limit;
  values[1] = data.coefficient;
  for (PetscInt i = 0; i < r->nterms; i++) {
    data.limit[i]       = PETSC_INFINITY;
    data.coefficient[i] = -1.0;
  }
  for (PetscInt k = 0; k < 2; k++) {
    VecScatter scatter;
    Vec        on_first;

    if (!given[k]) continue;
    PetscCall(VecDuplicate(given[k], &scaled));
    PetscCall(VecCopy(given[k], scaled));
    if (k && scale) PetscCall(VecPointwiseMult(scaled, scaled, scale));
    PetscCall(VecScatterCreateToZero(scaled, &scatter, &on_first));
    PetscCall(ReducedFetch(scatter, scaled, on_first, r->nterms, values[k]));
    PetscCall(VecScatterDestroy(&scatter));
    PetscCall(VecDestroy(&on_first));
    PetscCall(VecDestroy(&scaled));
  }
  PetscFunctionReturn(0);
}

/*
   Sets the stiffness of the springs that K_WW contains: D of the constraints, D_t of the norm terms' rows. The laws
   subtract the springs' forces again, so that the solution does not depend on them.
*/
PetscErrorCode IPReducedSetSprings(IPReduced *r, Vec D, Vec Dt)
{
  IPReducedSystem *s = &r->system;

  PetscFunctionBegin;
  PetscCall(ReducedAgree(r, PetscMalloc2(s->m, &s->spring, s->m, &s->start)));
  PetscCall(ReducedFetch(r->to_rows, D, r->on_rows, r->m, s->spring));
  PetscCall(ReducedFetch(r->to_terms, Dt, r->on_terms, 2 * r->nterms, s->spring + r->m));
  PetscFunctionReturn(0);
}

/*
   Sets the initial active set to the rows whose `guess` is positive, and the initial forces of constraints and norm
   terms
*/
PetscErrorCode IPReducedGuess(IPReduced *r, Vec guess, Vec force, const IPTerms *terms)
{
  IPReducedSystem *s    = &r->system;
  IPLawsData       data = {0};

  PetscFunctionBegin;
  if (r->laws) PetscCall(r->lawsops->getdata(r->laws, &data));
  PetscCall(ReducedFetch(r->to_rows, guess, r->on_rows, r->m, s->gap));
  for (PetscInt i = 0; i < r->m; i++) {
    PetscBool *active = r->laws ? data.closed : r->set.active;

    active[i] = (PetscBool)(s->gap[i] > 0.0);
  }
  r->set.factored = PETSC_FALSE;
  if (r->laws) PetscCall(r->lawsops->restart(r->laws));
  if (!terms->n) PetscFunctionReturn(0);
  PetscCall(ReducedFetch(r->to_rows, force, r->on_rows, r->m, s->lambda));
  PetscCall(ReducedFetch(r->to_terms, terms->force, r->on_terms, 2 * r->nterms, s->lambda + r->m));
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
  if (s->spring) PetscCall(PetscArraycpy(s->start, s->gap, s->m));
  if (r->laws) {
    PetscCall(PetscArraycpy(s->base, s->lambda, s->m));
    PetscCall(IPComplianceSpread(&r->compliance, s->base, r->z));
    for (PetscInt i = 0; i < r->n; i++) r->g[i] -= r->z[i];
  }
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

/*
   Sets the point to which v is relative: its gradient g, P^T g, constraint values c and, with norm terms, their values.
   With norm terms the present forces are subtracted from g.
*/
PetscErrorCode IPReducedCenter(IPReduced *r, Vec gradient, Vec c, Vec value, const PetscReal pg[])
{
  IPReducedSystem *s = &r->system;

  PetscFunctionBegin;
  PetscCall(ReducedFetch(r->to_W, gradient, r->on_W, r->n, r->g));
  PetscCall(ReducedFetch(r->to_rows, c, r->on_rows, r->m, s->gap));
  if (value) PetscCall(ReducedFetch(r->to_terms, value, r->on_terms, 2 * r->nterms, s->gap + r->m));
  PetscCall(ReducedAgree(r, r->first ? ReducedCenterFirst(r, pg) : (PetscErrorCode)0));
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
  PetscCall(ReducedAgree(r, PetscMalloc1((size_t)r->n * (size_t)most, &Q)));
  while (s->k < before + basis->n) {
    const PetscInt k = s->k, n = PetscMin(chunk, before + basis->n - k);

    for (PetscInt j = 0; j < n; j++) {
      PetscReal *T = &s->T[(k + j) * s->kmax];

      PetscCall(IPBasisGetForces(basis, k + j - before, basis->Kd));
      PetscCall(ReducedFetch(r->to_W, basis->Kd, r->on_W, r->n, &Q[(size_t)j * (size_t)r->n]));
      PetscCall(PetscArrayzero(T, before));
      PetscCall(PetscArraycpy(T + before, &basis->gram[(k + j - before) * basis->max], k + n - before));
    }
    PetscCall(ReducedAgree(r, r->first ? ReducedAppendColumns(r, n, Q) : (PetscErrorCode)0));
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
  if (r->laws) PetscCall(r->lawsops->forget(r->laws));
  if (r->first) PetscCall(PetscArrayzero(r->system.y, r->system.kmax));
  PetscFunctionReturn(0);
}

/* Computes w = K_WW^-1 (J_W^T (lambda - base) - g) by a solve */
static PetscErrorCode ReducedRecoverBySolve(IPReduced *r, PetscReal w[])
{
  const IPReducedSystem *s = &r->system;
  PetscReal             *change;

  PetscFunctionBegin;
  PetscCall(PetscMalloc1(s->m, &change));
  for (PetscInt i = 0; i < s->m; i++) change[i] = IPReducedForce(s, i);
  PetscCall(IPComplianceSpread(&r->compliance, change, r->z));
  PetscCall(PetscFree(change));
  for (PetscInt i = 0; i < r->n; i++) r->z[i] -= r->g[i];
  PetscCall(IPComplianceSolve(&r->compliance, 1, r->z, w));
  PetscFunctionReturn(0);
}

/* Computes w = K_WW^-1 (J_W^T (lambda - base) - g - Q_W y) without a solve, from columns that are known. r->x:
   K_WW^-1 g */
static PetscErrorCode ReducedRecoverFirst(IPReduced *r, PetscReal w[])
{
  const IPReducedSystem *s     = &r->system;
  const PetscReal        minus = -1.0, one = 1.0;
  PetscBLASInt           n, k, inc = 1;
  PetscBool              known;

  PetscFunctionBegin;
  PetscCall(IPComplianceExpand(&r->compliance, s->lambda, w, &known)); /* never with norm terms, so that base is zero */
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
  PetscCall(ReducedAgree(r, PetscMalloc1(r->n, &w)));
  PetscCall(ReducedAgree(r, r->first ? ReducedRecoverFirst(r, w) : (PetscErrorCode)0));
  PetscCall(ReducedSpread(r->to_W, r->n, w, r->on_W, v));
  PetscCall(PetscFree(w));
  PetscFunctionReturn(0);
}

static PetscErrorCode ReducedSolveFirst(IPReduced *r, PetscBool *solved)
{
  PetscFunctionBegin;
  if (r->laws) PetscCall(r->lawsops->solve(r->laws, &r->system, r->simply, &r->nsteps, &r->nactive, &r->met, solved));
  else {
    PetscCall(IPActiveSetSolve(&r->set, &r->compliance, &r->system, &r->nsteps, solved));
    r->nactive = r->set.n;
    r->met     = *solved;
  }
  PetscFunctionReturn(0);
}

/*
   Solves the reduced problem. y: coefficients of the directions, on all ranks; v: its entries in W are set to w; force:
   lambda; terms: forces of the norm terms, or NULL. Sets r->nactive, r->nsteps, and r->met, whether the laws hold to
   the requested tolerance.
*/
PetscErrorCode IPReducedSolve(IPReduced *r, PetscReal y[], Vec v, Vec force, Vec terms, PetscBool *solved)
{
  IPReducedSystem *s    = &r->system;
  MPI_Comm         comm = PetscObjectComm((PetscObject)v);
  PetscInt         counts[3];

  PetscFunctionBegin;
  *solved = PETSC_FALSE;
  PetscCall(ReducedBroadcast(r, r->first ? ReducedSolveFirst(r, solved) : (PetscErrorCode)0, solved));
  if (!*solved) PetscFunctionReturn(0);
  PetscCall(ReducedRecover(r, v));
  PetscCall(ReducedSpread(r->to_rows, r->m, s->lambda, r->on_rows, force));
  if (terms) PetscCall(ReducedSpread(r->to_terms, 2 * r->nterms, s->lambda + r->m, r->on_terms, terms));
  PetscCallMPI(MPI_Bcast(s->y, (PetscMPIInt)s->k, MPIU_REAL, 0, comm));
  PetscCall(PetscArraycpy(y, s->y + r->companions.n, s->k - r->companions.n));
  counts[0] = r->nsteps;
  counts[1] = r->nactive;
  counts[2] = r->met;
  PetscCallMPI(MPI_Bcast(counts, 3, MPIU_INT, 0, comm));
  r->nsteps  = counts[0];
  r->nactive = counts[1];
  r->met     = (PetscBool)counts[2];
  PetscFunctionReturn(0);
}

/* Sets the coefficients to zero of the terms that the laws have released */
static PetscErrorCode ReducedRelease(const IPReduced *r, const PetscReal own[], Vec coefficient)
{
  PetscScalar *a;
  VecScatter   scatter;
  Vec          on_first;

  PetscFunctionBegin;
  if (!coefficient) PetscFunctionReturn(0);
  PetscCall(VecScatterCreateToZero(coefficient, &scatter, &on_first));
  PetscCall(VecScatterBegin(scatter, coefficient, on_first, INSERT_VALUES, SCATTER_FORWARD));
  PetscCall(VecScatterEnd(scatter, coefficient, on_first, INSERT_VALUES, SCATTER_FORWARD));
  PetscCall(VecGetArray(on_first, &a));
  for (PetscInt i = 0; r->laws && i < r->nterms; i++) {
    if (own[i] == 0.0) a[i] = 0.0;
  }
  PetscCall(VecRestoreArray(on_first, &a));
  PetscCall(VecScatterBegin(scatter, on_first, coefficient, INSERT_VALUES, SCATTER_REVERSE));
  PetscCall(VecScatterEnd(scatter, on_first, coefficient, INSERT_VALUES, SCATTER_REVERSE));
  PetscCall(VecScatterDestroy(&scatter));
  PetscCall(VecDestroy(&on_first));
  PetscFunctionReturn(0);
}

/* Changes coefficients and references of the norm terms as the laws have done */
PetscErrorCode IPReducedChangeTerms(const IPReduced *r, const IPTerms *terms)
{
  IPLawsData data = {0};
  Vec        shift;

  PetscFunctionBegin;
  if (r->laws) PetscCall(r->lawsops->getdata(r->laws, &data));
  PetscCallMPI(MPI_Bcast(&data.nreleased, 1, MPIU_INT, 0, PetscObjectComm((PetscObject)terms->t)));
  if (!data.nreleased) PetscFunctionReturn(0);
  PetscCall(ReducedRelease(r, data.coefficient, terms->coefficient));
  PetscCall(VecDuplicate(terms->t, &shift));
  PetscCall(ReducedSpread(r->to_terms, 2 * r->nterms, data.shift, r->on_terms, shift));
  PetscCall(VecAXPY(terms->t, -1.0, shift));
  PetscCall(VecDestroy(&shift));
  if (r->laws) PetscCall(PetscArrayzero(data.shift, 2 * r->nterms));
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
   Solves K v - J^T lambda = f in the subspace, with J v = c in the rows that were active at the last solution and
   lambda = 0 in the others. Only the entries of f in W are used. *solved: false if there are no constraints, or if
   there are norm terms.
*/
PetscErrorCode IPReducedSolveActive(IPReduced *r, const IPBasis *basis, Vec f, Vec c, Vec v, Vec force,
  PetscBool *solved)
{
  IPReducedSystem *s = &r->system;

  PetscFunctionBegin;
  *solved =
    (PetscBool)(r->to_rows && !r->to_terms && r->generation == basis->generation && s->k == r->companions.n + basis->n);
  if (!*solved) PetscFunctionReturn(0);
  PetscCall(ReducedFetch(r->to_W, f, r->on_W, r->n, r->g));
  if (r->scale) PetscCall(VecPointwiseMult(force, c, r->scale));
  PetscCall(ReducedFetch(r->to_rows, r->scale ? force : c, r->on_rows, r->m, s->gap));
  PetscCall(ReducedBroadcast(r, r->first ? ReducedSolveActiveFirst(r, solved) : (PetscErrorCode)0, solved));
  if (!*solved) PetscFunctionReturn(0);
  PetscCall(VecZeroEntries(v));
  PetscCall(ReducedRecover(r, v));
  PetscCall(ReducedSpread(r->to_rows, r->m, s->lambda, r->on_rows, force));
  if (r->scale) PetscCall(VecPointwiseMult(force, force, r->scale));
  PetscCallMPI(MPI_Bcast(s->y, (PetscMPIInt)s->k, MPIU_REAL, 0, PetscObjectComm((PetscObject)v)));
  PetscCall(IPBasisAdd(basis, s->y + r->companions.n, v));
  PetscFunctionReturn(0);
}
