/*
   The directions P of the filtered subspace, which later solves reuse. They are zero on the constraints' unknowns W.
   The products Q = K P and the Gram matrix P^T K P are stored with them. A new direction is made K-orthonormal to the
   others. If W changes, the entries on the new W are set to zero, and Q and the Gram matrix are corrected.
*/
#include "subspaceimpl.h"
#include <petscblaslapack.h>

PetscErrorCode IPBasisCreate(PetscInt max, IPBasis *b)
{
  PetscFunctionBegin;
  b->n   = 0;
  b->max = max;
  b->generation++;
  PetscCall(PetscCalloc4(max, &b->p, max, &b->q, max * max, &b->gram, max * max, &b->factor));
  PetscFunctionReturn(0);
}

PetscErrorCode IPBasisDestroy(IPBasis *b)
{
  PetscFunctionBegin;
  for (PetscInt j = 0; j < b->max; j++) {
    PetscCall(VecDestroy(&b->p[j]));
    PetscCall(VecDestroy(&b->q[j]));
  }
  PetscCall(PetscFree4(b->p, b->q, b->gram, b->factor));
  b->n = b->max = 0;
  PetscFunctionReturn(0);
}

/* Replaces h by (P^T K P)^-1 h */
static PetscErrorCode BasisSolve(const IPBasis *b, PetscReal h[])
{
  PetscBLASInt n, ld, one = 1, info;

  PetscFunctionBegin;
  PetscCall(PetscBLASIntCast(b->n, &n));
  PetscCall(PetscBLASIntCast(b->max, &ld));
  PetscCallBLAS("LAPACKpotrs", LAPACKpotrs_("L", &n, &one, b->factor, &ld, h, &ld, &info));
  PetscCheck(!info, PETSC_COMM_SELF, PETSC_ERR_LIB, "LAPACK's potrs returned %d for %d directions", (int)info, (int)n);
  PetscFunctionReturn(0);
}

/*
   Makes d K-orthogonal to P: d -= P h and, unless Kd is NULL, Kd -= Q h, with h = (P^T K P)^-1 Q^T d. *removed: energy
   h^T P^T K P h of the removed part.
*/
static PetscErrorCode BasisProject(const IPBasis *b, Vec d, Vec Kd, PetscReal *removed)
{
  PetscReal *h, *s;

  PetscFunctionBegin;
  *removed = 0.0;
  if (!b->n) PetscFunctionReturn(0);
  PetscCall(PetscMalloc2(b->max, &h, b->max, &s));
  PetscCall(VecMDot(d, b->n, b->q, s));
  PetscCall(PetscArraycpy(h, s, b->n));
  PetscCall(BasisSolve(b, h));
  for (PetscInt j = 0; j < b->n; j++) {
    *removed += h[j] * s[j];
    h[j] = -h[j];
  }
  PetscCall(VecMAXPY(d, b->n, h, b->p));
  if (Kd) PetscCall(VecMAXPY(Kd, b->n, h, b->q));
  PetscCall(PetscFree2(h, s));
  PetscFunctionReturn(0);
}

/* Creates the vectors of direction n if they do not exist, and copies d into it */
static PetscErrorCode BasisTake(IPBasis *b, Vec d)
{
  const PetscInt n = b->n;

  PetscFunctionBegin;
  if (!b->p[n]) PetscCall(VecDuplicate(d, &b->p[n]));
  if (!b->q[n]) PetscCall(VecDuplicate(d, &b->q[n]));
  PetscCall(VecCopy(d, b->p[n]));
  PetscFunctionReturn(0);
}

/*
   Makes d, which is zero on W, K-orthonormal to the other directions and appends it. It is projected twice if the first
   projection removed half of its energy. *appended: false if d depends on the other directions up to rounding, or K is
   not positive along it.
*/
PetscErrorCode IPBasisAppend(IPBasis *b, Mat K, Vec d, PetscBool *appended)
{
  const PetscInt  n   = b->n;
  const PetscReal eps = 1e3 * PETSC_MACHINE_EPSILON;
  PetscReal       removed, again = 0.0;
  PetscScalar     energy;

  PetscFunctionBegin;
  PetscCheck(n < b->max, PetscObjectComm((PetscObject)d), PETSC_ERR_PLIB,
    "There is room for %" PetscInt_FMT " directions only", b->max);
  PetscCall(BasisTake(b, d));
  PetscCall(BasisProject(b, b->p[n], NULL, &removed));
  PetscCall(MatMult(K, b->p[n], b->q[n]));
  PetscCall(VecDot(b->p[n], b->q[n], &energy));
  if (PetscRealPart(energy) < removed) {
    PetscCall(BasisProject(b, b->p[n], b->q[n], &again));
    PetscCall(VecDot(b->p[n], b->q[n], &energy));
  }
  *appended = (PetscBool)(PetscRealPart(energy) > eps * removed && !PetscIsInfOrNanReal(PetscRealPart(energy)) &&
                          again <= removed);
  if (!*appended) PetscFunctionReturn(0);
  PetscCall(VecScale(b->p[n], 1.0 / PetscSqrtReal(PetscRealPart(energy))));
  PetscCall(VecScale(b->q[n], 1.0 / PetscSqrtReal(PetscRealPart(energy))));
  for (PetscInt j = 0; j <= n; j++) {
    b->gram[j + n * b->max] = b->gram[n + j * b->max] = j == n ? 1.0 : 0.0;
    b->factor[n + j * b->max]                         = j == n ? 1.0 : 0.0;
  }
  b->n++;
  PetscFunctionReturn(0);
}

/*
   Selects the directions with keep[j], in their order. The vectors of the others remain allocated for new directions.
   The Gram matrix must be factored again.
*/
static PetscErrorCode BasisSelect(IPBasis *b, const PetscBool keep[])
{
  PetscInt n = 0;

  PetscFunctionBegin;
  for (PetscInt j = 0; j < b->n; j++) {
    Vec p = b->p[j], q = b->q[j];

    if (!keep[j]) continue;
    b->p[j] = b->p[n];
    b->q[j] = b->q[n];
    b->p[n] = p;
    b->q[n] = q;
    for (PetscInt i = 0; i < b->n; i++) b->gram[i + n * b->max] = b->gram[i + j * b->max];
    for (PetscInt i = 0; i < b->n; i++) b->gram[n + i * b->max] = b->gram[j + i * b->max];
    n++;
  }
  b->n = n;
  PetscFunctionReturn(0);
}

/*
   Finds the directions that are independent of later ones, by a Cholesky factorization from the newest to the oldest
   direction
*/
static PetscErrorCode BasisFindIndependent(const IPBasis *b, PetscBool keep[])
{
  const PetscReal dependent = 1e-10;
  const PetscInt  n         = b->n;
  PetscReal      *L;

  PetscFunctionBegin;
  PetscCall(PetscCalloc1(n * n, &L));
  for (PetscInt j = n - 1; j >= 0; j--) {
    PetscReal pivot = b->gram[j + j * b->max];

    for (PetscInt k = n - 1; k > j; k--) pivot -= L[j + k * n] * L[j + k * n];
    keep[j] = (PetscBool)(pivot > dependent * b->gram[j + j * b->max]);
    if (!keep[j]) continue;
    for (PetscInt i = j - 1; i >= 0; i--) {
      PetscReal sum = b->gram[i + j * b->max];

      for (PetscInt k = n - 1; k > j; k--) sum -= L[i + k * n] * L[j + k * n];
      L[i + j * n] = sum / PetscSqrtReal(pivot);
    }
  }
  PetscCall(PetscFree(L));
  PetscFunctionReturn(0);
}

/* Factors the Gram matrix after the directions have changed. Directions that depend on later ones are removed first. */
static PetscErrorCode BasisFactor(IPBasis *b)
{
  PetscBool   *keep;
  PetscBLASInt n, ld, info;

  PetscFunctionBegin;
  b->generation++;
  if (!b->n) PetscFunctionReturn(0);
  PetscCall(PetscMalloc1(b->n, &keep));
  PetscCall(BasisFindIndependent(b, keep));
  PetscCall(BasisSelect(b, keep));
  PetscCall(PetscFree(keep));
  PetscCall(PetscArraycpy(b->factor, b->gram, b->max * b->max));
  PetscCall(PetscBLASIntCast(b->n, &n));
  PetscCall(PetscBLASIntCast(b->max, &ld));
  PetscCallBLAS("LAPACKpotrf", LAPACKpotrf_("L", &n, b->factor, &ld, &info));
  if (info) b->n = 0;
  PetscFunctionReturn(0);
}

/*
   Computes the n x n matrix T such that T^T E T is diagonal with decreasing entries and T^T P^T K P T = I, for the
   first n directions. E (columns of length max) is overwritten.
*/
static PetscErrorCode BasisRotation(const IPBasis *b, PetscInt n, PetscReal E[], PetscReal T[])
{
  PetscReal   *G, *values, *work, size;
  PetscBLASInt nb, ld, type = 1, lwork, info;

  PetscFunctionBegin;
  PetscCall(PetscBLASIntCast(n, &nb));
  PetscCall(PetscBLASIntCast(b->max, &ld));
  PetscCall(PetscMalloc2(b->max * b->max, &G, n, &values));
  PetscCall(PetscArraycpy(G, b->gram, b->max * b->max));
  lwork = -1;
  PetscCallBLAS("LAPACKsygv", LAPACKsygv_(&type, "V", "L", &nb, E, &ld, G, &ld, values, &size, &lwork, &info));
  PetscCall(PetscBLASIntCast((PetscInt)size, &lwork));
  PetscCall(PetscMalloc1(lwork, &work));
  PetscCallBLAS("LAPACKsygv", LAPACKsygv_(&type, "V", "L", &nb, E, &ld, G, &ld, values, work, &lwork, &info));
  PetscCheck(!info, PETSC_COMM_SELF, PETSC_ERR_LIB, "LAPACK's sygv returned %d for %d directions", (int)info, (int)nb);
  for (PetscInt j = 0; j < n; j++) PetscCall(PetscArraycpy(T + j * n, E + (n - 1 - j) * b->max, n));
  PetscCall(PetscFree(work));
  PetscCall(PetscFree2(G, values));
  PetscFunctionReturn(0);
}

/*
   Replaces the first k of n vectors by their combinations with the columns of T (length n). The vectors are processed
   in blocks of entries to save memory.
*/
static PetscErrorCode BasisCombine(PetscInt n, PetscInt k, const PetscReal T[], Vec v[])
{
  const PetscInt  chunk = 128;
  const PetscReal one = 1.0, zero = 0.0;
  PetscBLASInt    nb, kb, rows;
  PetscScalar   **a, *old, *new;
  PetscInt        local;

  PetscFunctionBegin;
  PetscCall(PetscBLASIntCast(n, &nb));
  PetscCall(PetscBLASIntCast(k, &kb));
  PetscCall(VecGetLocalSize(v[0], &local));
  PetscCall(PetscMalloc2(chunk * n, &old, chunk * k, &new));
  PetscCall(VecGetArrays(v, n, &a));
  for (PetscInt start = 0; start < local; start += chunk) {
    PetscCall(PetscBLASIntCast(PetscMin(chunk, local - start), &rows));
    for (PetscInt j = 0; j < n; j++) PetscCall(PetscArraycpy(old + j * rows, a[j] + start, rows));
    PetscCallBLAS("BLASgemm", BLASgemm_("N", "N", &rows, &kb, &nb, &one, old, &rows, T, &nb, &zero, new, &rows));
    for (PetscInt j = 0; j < k; j++) PetscCall(PetscArraycpy(a[j] + start, new + j *rows, rows));
  }
  PetscCall(VecRestoreArrays(v, n, &a));
  PetscCall(PetscFree2(old, new));
  PetscFunctionReturn(0);
}

/* Updates the Gram matrix after the first n directions were replaced by k orthonormal combinations */
static PetscErrorCode BasisCombineGram(IPBasis *b, PetscInt n, PetscInt k, const PetscReal T[])
{
  PetscReal *old;

  PetscFunctionBegin;
  PetscCall(PetscMalloc1(b->max * b->max, &old));
  PetscCall(PetscArraycpy(old, b->gram, b->max * b->max));
  for (PetscInt j = 0; j < k; j++) {
    for (PetscInt i = 0; i < k; i++) b->gram[i + j * b->max] = i == j ? 1.0 : 0.0;
    for (PetscInt i = n; i < b->n; i++) {
      PetscReal sum = 0.0;

      for (PetscInt l = 0; l < n; l++) sum += T[l + j * n] * old[i + l * b->max];
      b->gram[i + j * b->max] = b->gram[j + i * b->max] = sum;
    }
  }
  PetscCall(PetscFree(old));
  PetscFunctionReturn(0);
}

/*
   Keeps the `last` newest directions, and replaces the others by their `best` combinations with the largest ratios p^T
   E p / p^T K p. E (columns of length max) is overwritten.
*/
PetscErrorCode IPBasisCompress(IPBasis *b, PetscInt best, PetscInt last, PetscReal E[])
{
  const PetscInt n = b->n - last;
  PetscReal     *T;
  PetscBool     *keep;

  PetscFunctionBegin;
  PetscCall(PetscMalloc2(n * n, &T, b->n, &keep));
  PetscCall(BasisRotation(b, n, E, T));
  PetscCallMPI(MPI_Bcast(T, (PetscMPIInt)(n * n), MPIU_REAL, 0, PetscObjectComm((PetscObject)b->p[0])));
  PetscCall(BasisCombine(n, best, T, b->p));
  PetscCall(BasisCombine(n, best, T, b->q));
  PetscCall(BasisCombineGram(b, n, best, T));
  for (PetscInt j = 0; j < b->n; j++) keep[j] = (PetscBool)(j < best || j >= n);
  PetscCall(BasisSelect(b, keep));
  PetscCall(PetscFree2(T, keep));
  PetscCall(BasisFactor(b));
  PetscFunctionReturn(0);
}

/* Computes Q = K P and the Gram matrix for a new K */
PetscErrorCode IPBasisMultiply(IPBasis *b, Mat K)
{
  PetscFunctionBegin;
  for (PetscInt j = 0; j < b->n; j++) {
    PetscCall(MatMult(K, b->p[j], b->q[j]));
    PetscCall(VecMDot(b->q[j], j + 1, b->p, &b->gram[j * b->max]));
    for (PetscInt i = 0; i < j; i++) b->gram[j + i * b->max] = b->gram[i + j * b->max];
  }
  PetscCall(BasisFactor(b));
  PetscFunctionReturn(0);
}

/* Copies the entries of v in n local rows to entries[]. cut: sets them to zero in v. */
static PetscErrorCode BasisEntries(Vec v, PetscInt n, const PetscInt rows[], PetscReal entries[], PetscBool cut)
{
  PetscScalar *a;
  PetscInt     start;

  PetscFunctionBegin;
  PetscCall(VecGetOwnershipRange(v, &start, NULL));
  PetscCall(VecGetArray(v, &a));
  for (PetscInt i = 0; i < n; i++) {
    entries[i] = PetscRealPart(a[rows[i] - start]);
    if (cut) a[rows[i] - start] = 0.0;
  }
  PetscCall(VecRestoreArray(v, &a));
  PetscFunctionReturn(0);
}

/*
   Sets direction j to zero in the given rows: p -= E a, q -= K E a, where E a is its part there. Returns the entries a
   of p, those of the old q, and those of K E a in these rows.
*/
static PetscErrorCode BasisCut(IPBasis *b, Mat K, PetscInt j, PetscInt n, const PetscInt rows[], PetscReal a[],
  PetscReal q[], PetscReal Ka[], Vec work[2])
{
  PetscFunctionBegin;
  PetscCall(VecCopy(b->p[j], work[0]));
  PetscCall(BasisEntries(b->p[j], n, rows, a, PETSC_TRUE));
  PetscCall(BasisEntries(b->q[j], n, rows, q, PETSC_FALSE));
  PetscCall(VecAXPY(work[0], -1.0, b->p[j]));
  PetscCall(MatMult(K, work[0], work[1]));
  PetscCall(BasisEntries(work[1], n, rows, Ka, PETSC_FALSE));
  PetscCall(VecAXPY(b->q[j], -1.0, work[1]));
  PetscFunctionReturn(0);
}

/*
   Corrects the Gram matrix after p -= E a: G_ij - a_i^T q_j - a_j^T q_i + a_i^T K a_j, from the entries in n local rows
*/
static PetscErrorCode BasisCorrectGram(IPBasis *b, PetscInt n, const PetscReal a[], const PetscReal q[],
  const PetscReal Ka[])
{
  PetscReal *change;

  PetscFunctionBegin;
  PetscCall(PetscCalloc1(b->n * b->n, &change));
  for (PetscInt j = 0; j < b->n; j++) {
    for (PetscInt i = 0; i < b->n; i++) {
      for (PetscInt k = 0; k < n; k++)
        change[i + j * b->n] += a[k + i * n] * (Ka[k + j * n] - q[k + j * n]) - a[k + j * n] * q[k + i * n];
    }
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, change, (PetscMPIInt)(b->n * b->n), MPIU_REAL, MPIU_SUM,
    PetscObjectComm((PetscObject)b->p[0])));
  for (PetscInt j = 0; j < b->n; j++) {
    for (PetscInt i = 0; i < b->n; i++) b->gram[i + j * b->max] += 0.5 * (change[i + j * b->n] + change[j + i * b->n]);
  }
  PetscCall(PetscFree(change));
  PetscFunctionReturn(0);
}

/* Finds the local rows of W in which some direction is not zero. *all: number of these rows on all ranks. */
static PetscErrorCode BasisFindRows(const IPBasis *b, IS W, PetscInt *n, PetscInt **rows, PetscInt *all)
{
  const PetscInt *w;
  PetscInt        nw, start;
  PetscBool      *touched;

  PetscFunctionBegin;
  PetscCall(ISGetLocalSize(W, &nw));
  PetscCall(ISGetIndices(W, &w));
  PetscCall(PetscCalloc1(nw, &touched));
  PetscCall(PetscMalloc1(nw, rows));
  PetscCall(VecGetOwnershipRange(b->p[0], &start, NULL));
  for (PetscInt j = 0; j < b->n; j++) {
    const PetscScalar *p;

    PetscCall(VecGetArrayRead(b->p[j], &p));
    for (PetscInt i = 0; i < nw; i++) touched[i] = (PetscBool)(touched[i] || p[w[i] - start] != 0.0);
    PetscCall(VecRestoreArrayRead(b->p[j], &p));
  }
  *n = 0;
  for (PetscInt i = 0; i < nw; i++)
    if (touched[i]) (*rows)[(*n)++] = w[i];
  PetscCallMPI(MPI_Allreduce(n, all, 1, MPIU_INT, MPI_SUM, PetscObjectComm((PetscObject)W)));
  PetscCall(PetscFree(touched));
  PetscCall(ISRestoreIndices(W, &w));
  PetscFunctionReturn(0);
}

/* Sets the directions to zero on W, and updates Q and the Gram matrix */
PetscErrorCode IPBasisRestrict(IPBasis *b, Mat K, IS W)
{
  PetscInt   n, all, *rows;
  PetscReal *a, *q, *Ka;
  Vec        work[2];

  PetscFunctionBegin;
  if (!b->n) PetscFunctionReturn(0);
  PetscCall(BasisFindRows(b, W, &n, &rows, &all));
  if (!all) {
    PetscCall(PetscFree(rows));
    PetscFunctionReturn(0);
  }
  PetscCall(PetscMalloc3(n * b->n, &a, n * b->n, &q, n * b->n, &Ka));
  for (PetscInt k = 0; k < 2; k++) PetscCall(VecDuplicate(b->p[0], &work[k]));
  for (PetscInt j = 0; j < b->n; j++) PetscCall(BasisCut(b, K, j, n, rows, &a[j * n], &q[j * n], &Ka[j * n], work));
  for (PetscInt k = 0; k < 2; k++) PetscCall(VecDestroy(&work[k]));
  PetscCall(BasisCorrectGram(b, n, a, q, Ka));
  PetscCall(PetscFree3(a, q, Ka));
  PetscCall(PetscFree(rows));
  PetscCall(BasisFactor(b));
  PetscFunctionReturn(0);
}
