/*
   The directions P of the subspace, which later solves reuse. They are zero on the constraints' unknowns W.
   Directions are stored in single precision. The Gram matrix P^T K P and the rows W of K P are computed in double
   precision from the rounded directions. The reduced problem is therefore exact for the rounded directions.

   Directions are not made orthogonal. They are preconditioned residuals, which are almost K-orthogonal to each other
   if the preconditioner is good. Only a direction that almost depends on the others is made K-orthogonal to them.
*/
#include "subspaceimpl.h"
#include <lanes.h>
#include <math.h>
#include <petscblaslapack.h>

/* Creates an empty basis with room for max directions. like: a vector of the unknowns */
PetscErrorCode IPBasisCreate(PetscInt max, Vec like, IPBasis *b)
{
  PetscFunctionBegin;
  b->n         = 0;
  b->max       = max;
  b->has_modes = PETSC_FALSE;
  b->generation++;
  PetscCall(VecGetLocalSize(like, &b->nlocal));
  PetscCall(PetscCalloc5(max, &b->p, max, &b->size, max, &b->q, max * max, &b->gram, max * max, &b->factor));
  PetscFunctionReturn(0);
}

/* Frees the rows W of K P */
static PetscErrorCode BasisForgetW(IPBasis *b)
{
  PetscFunctionBegin;
  for (PetscInt j = 0; j < b->max; j++) PetscCall(PetscFree(b->q[j]));
  PetscCall(ISDestroy(&b->W));
  PetscFunctionReturn(0);
}

PetscErrorCode IPBasisDestroy(IPBasis *b)
{
  PetscFunctionBegin;
  PetscCall(BasisForgetW(b));
  for (PetscInt j = 0; j < b->max; j++) PetscCall(PetscFree(b->p[j]));
  PetscCall(PetscFree5(b->p, b->size, b->q, b->gram, b->factor));
  PetscCall(VecDestroy(&b->d));
  PetscCall(VecDestroy(&b->Kd));
  b->n = b->max = 0;
  PetscFunctionReturn(0);
}

/* Computes s = P^T v for k directions from number `first` on. Collective. */
PetscErrorCode IPBasisDots(const IPBasis *b, PetscInt first, PetscInt k, Vec v, PetscReal s[])
{
  const PetscScalar *a;

  PetscFunctionBegin;
  PetscCall(VecGetArrayRead(v, &a));
  IPSingleDots(b->nlocal, k, b->p + first, a, s);
  PetscCall(VecRestoreArrayRead(v, &a));
  for (PetscInt j = 0; j < k; j++) s[j] *= b->size[first + j];
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, s, (PetscMPIInt)k, MPIU_REAL, MPIU_SUM, PetscObjectComm((PetscObject)v)));
  PetscFunctionReturn(0);
}

/* Adds P y to v */
PetscErrorCode IPBasisAdd(const IPBasis *b, const PetscReal y[], Vec v)
{
  PetscScalar *a;
  PetscReal   *factors;

  PetscFunctionBegin;
  if (!b->n) PetscFunctionReturn(0);
  PetscCall(PetscMalloc1(b->n, &factors));
  for (PetscInt j = 0; j < b->n; j++) factors[j] = y[j] * b->size[j];
  PetscCall(VecGetArray(v, &a));
  IPSingleCombine(b->nlocal, b->n, factors, b->p, a);
  PetscCall(VecRestoreArray(v, &a));
  PetscCall(PetscFree(factors));
  PetscFunctionReturn(0);
}

/* Copies the rows W of K times direction j to q. The other entries of q are unchanged. */
PetscErrorCode IPBasisGetForces(const IPBasis *b, PetscInt j, Vec q)
{
  const PetscInt *w;
  PetscScalar    *a;
  PetscInt        n, start;

  PetscFunctionBegin;
  PetscCall(ISGetLocalSize(b->W, &n));
  PetscCall(ISGetIndices(b->W, &w));
  PetscCall(VecGetOwnershipRange(q, &start, NULL));
  PetscCall(VecGetArray(q, &a));
  for (PetscInt i = 0; i < n; i++) a[w[i] - start] = b->q[j][i];
  PetscCall(VecRestoreArray(q, &a));
  PetscCall(ISRestoreIndices(b->W, &w));
  PetscFunctionReturn(0);
}

/* Copies direction j to b->d, in double precision */
static PetscErrorCode BasisExpand(IPBasis *b, PetscInt j)
{
  PetscScalar *d;

  PetscFunctionBegin;
  PetscCall(VecZeroEntries(b->d));
  PetscCall(VecGetArray(b->d, &d));
  IPSingleCombine(b->nlocal, 1, &b->size[j], &b->p[j], d);
  PetscCall(VecRestoreArray(b->d, &d));
  PetscFunctionReturn(0);
}

/* Stores v, rounded, as direction j, and copies that direction to b->d. *stored: false if v is zero or not finite */
static PetscErrorCode BasisStore(IPBasis *b, PetscInt j, Vec v, PetscBool *stored)
{
  const PetscScalar *a;

  PetscFunctionBegin;
  PetscCall(VecNorm(v, NORM_INFINITY, &b->size[j]));
  *stored = (PetscBool)(b->size[j] > 0.0 && !PetscIsInfOrNanReal(b->size[j]));
  if (!*stored) PetscFunctionReturn(0);
  if (!b->p[j]) PetscCall(PetscMalloc1(b->nlocal, &b->p[j]));
  PetscCall(VecGetArrayRead(v, &a));
  IPSingleRound(b->nlocal, a, b->size[j], b->p[j]);
  PetscCall(VecRestoreArrayRead(v, &a));
  PetscCall(BasisExpand(b, j));
  PetscFunctionReturn(0);
}

/* Computes b->Kd = K b->d and stores its rows W for direction j */
static PetscErrorCode BasisMultiply(IPBasis *b, Mat K, PetscInt j)
{
  const PetscInt    *w;
  const PetscScalar *a;
  PetscInt           n, start;

  PetscFunctionBegin;
  PetscCall(MatMult(K, b->d, b->Kd));
  PetscCall(ISGetLocalSize(b->W, &n));
  PetscCall(ISGetIndices(b->W, &w));
  PetscCall(VecGetOwnershipRange(b->Kd, &start, NULL));
  if (!b->q[j]) PetscCall(PetscMalloc1(n, &b->q[j]));
  PetscCall(VecGetArrayRead(b->Kd, &a));
  for (PetscInt i = 0; i < n; i++) b->q[j][i] = a[w[i] - start];
  PetscCall(VecRestoreArrayRead(b->Kd, &a));
  PetscCall(ISRestoreIndices(b->W, &w));
  PetscFunctionReturn(0);
}

/*
   Scales direction j to unit energy. energy: its energy before. s: its products P^T K d with the earlier directions,
   which are scaled with it.
*/
static PetscErrorCode BasisScale(IPBasis *b, PetscInt j, PetscReal energy, PetscReal s[])
{
  const PetscReal scale = 1.0 / PetscSqrtReal(energy);
  PetscInt        n;

  PetscFunctionBegin;
  PetscCall(ISGetLocalSize(b->W, &n));
  b->size[j] *= scale;
  for (PetscInt i = 0; i < n; i++) b->q[j][i] *= scale;
  for (PetscInt i = 0; i < j; i++) s[i] *= scale;
  PetscFunctionReturn(0);
}

/*
   Solves L l = s with the Cholesky factor L of the Gram matrix. If s = P^T K d, *square = l^T l is the energy of the
   part of d in the span of P.
*/
static void BasisForward(const IPBasis *b, const PetscReal s[], PetscReal l[], PetscReal *square)
{
  *square = 0.0;
  for (PetscInt j = 0; j < b->n; j++) {
    PetscReal sum = s[j];

    for (PetscInt i = 0; i < j; i++) sum -= b->factor[j + i * b->max] * l[i];
    l[j] = sum / b->factor[j + j * b->max];
    *square += l[j] * l[j];
  }
}

/* Makes v K-orthogonal to P: v -= P (P^T K P)^-1 s, with s = P^T K v. l: L^-1 s, which is overwritten */
static PetscErrorCode BasisProject(const IPBasis *b, PetscReal l[], Vec v)
{
  PetscFunctionBegin;
  for (PetscInt j = b->n - 1; j >= 0; j--) {
    for (PetscInt i = j + 1; i < b->n; i++) l[j] -= b->factor[i + j * b->max] * l[i];
    l[j] /= b->factor[j + j * b->max];
  }
  for (PetscInt j = 0; j < b->n; j++) l[j] = -l[j];
  PetscCall(IPBasisAdd(b, l, v));
  PetscFunctionReturn(0);
}

/* Appends direction n, which is stored, to the Gram matrix and its factor. s, l, square: see BasisForward() */
static void BasisTake(IPBasis *b, const PetscReal s[], const PetscReal l[], PetscReal square)
{
  const PetscInt n = b->n;

  for (PetscInt j = 0; j < n; j++) {
    b->gram[j + n * b->max] = b->gram[n + j * b->max] = s[j];
    b->factor[n + j * b->max]                         = l[j];
  }
  b->gram[n + n * b->max]   = 1.0;
  b->factor[n + n * b->max] = PetscSqrtReal(1.0 - square);
  b->n++;
}

/*
   Scales d, which is zero on W, to unit energy and appends it. If less than 1 % of its energy is outside of the span of
   P, d is first made K-orthogonal to P. *appended: false if d depends on P up to rounding, or K is not positive along
   d. d is overwritten.
*/
PetscErrorCode IPBasisAppend(IPBasis *b, Mat K, Vec d, PetscBool *appended)
{
  const PetscReal independent = 1e-2, eps = 1e3 * PETSC_MACHINE_EPSILON;
  const PetscInt  attempts = 3;
  PetscReal      *s, *l, square = 1.0;
  PetscScalar     energy;
  PetscBool       stored;

  PetscFunctionBegin;
  PetscCheck(b->n < b->max, PetscObjectComm((PetscObject)d), PETSC_ERR_PLIB,
    "The subspace can hold %" PetscInt_FMT " directions, but more were added", b->max);
  *appended = PETSC_FALSE;
  PetscCall(PetscMalloc2(b->max, &s, b->max, &l));
  for (PetscInt k = 0; k < attempts && !*appended; k++) {
    PetscCall(BasisStore(b, b->n, d, &stored));
    if (!stored) break;
    PetscCall(BasisMultiply(b, K, b->n));
    PetscCall(VecDot(b->d, b->Kd, &energy));
    if (!(PetscRealPart(energy) > (k ? eps : 0.0)) || PetscIsInfOrNanReal(PetscRealPart(energy))) break;
    PetscCall(IPBasisDots(b, 0, b->n, b->Kd, s));
    PetscCall(BasisScale(b, b->n, PetscRealPart(energy), s));
    BasisForward(b, s, l, &square);
    *appended = (PetscBool)(square < 1.0 - independent);
    if (*appended) BasisTake(b, s, l, square);
    else {
      PetscCall(VecAXPBY(d, 1.0 / PetscSqrtReal(PetscRealPart(energy)), 0.0, b->d));
      PetscCall(BasisProject(b, l, d));
    }
  }
  PetscCall(PetscFree2(s, l));
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
    float       *p = b->p[j];
    PetscScalar *q = b->q[j];

    if (!keep[j]) continue;
    b->p[j]    = b->p[n];
    b->q[j]    = b->q[n];
    b->p[n]    = p;
    b->q[n]    = q;
    b->size[n] = b->size[j];
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

/* Removes the n oldest directions, which may contain the given motions */
PetscErrorCode IPBasisDropOldest(IPBasis *b, PetscInt n)
{
  PetscBool *keep;

  PetscFunctionBegin;
  if (n <= 0) PetscFunctionReturn(0);
  PetscCall(PetscMalloc1(b->n, &keep));
  for (PetscInt j = 0; j < b->n; j++) keep[j] = (PetscBool)(j >= n);
  PetscCall(BasisSelect(b, keep));
  PetscCall(PetscFree(keep));
  PetscCall(BasisFactor(b));
  b->has_modes = PETSC_FALSE;
  PetscFunctionReturn(0);
}

/*
   Computes the n x n matrix T such that T^T E T is diagonal with decreasing entries and T^T P^T K P T = I, for the
   first n directions: T = L^-T V with the factor L of P^T K P and the eigenvectors V of L^-1 E L^-T. E (lower triangle,
   columns of length max) is overwritten.
*/
static PetscErrorCode BasisRotation(const IPBasis *b, PetscInt n, PetscReal E[], PetscReal T[])
{
  const PetscReal one = 1.0;
  PetscReal      *values, *work, size;
  PetscBLASInt    nb, ld, lwork = -1, info;

  PetscFunctionBegin;
  PetscCall(PetscBLASIntCast(n, &nb));
  PetscCall(PetscBLASIntCast(b->max, &ld));
  for (PetscInt j = 0; j < n; j++)
    for (PetscInt i = 0; i < j; i++) E[i + j * b->max] = E[j + i * b->max];
  PetscCallBLAS("BLAStrsm", BLAStrsm_("L", "L", "N", "N", &nb, &nb, &one, b->factor, &ld, E, &ld));
  PetscCallBLAS("BLAStrsm", BLAStrsm_("R", "L", "T", "N", &nb, &nb, &one, b->factor, &ld, E, &ld));
  PetscCall(PetscMalloc1(n, &values));
  PetscCallBLAS("LAPACKsyev", LAPACKsyev_("V", "L", &nb, E, &ld, values, &size, &lwork, &info));
  PetscCall(PetscBLASIntCast((PetscInt)size, &lwork));
  PetscCall(PetscMalloc1(lwork, &work));
  PetscCallBLAS("LAPACKsyev", LAPACKsyev_("V", "L", &nb, E, &ld, values, work, &lwork, &info));
  PetscCheck(!info, PETSC_COMM_SELF, PETSC_ERR_LIB, "LAPACK's syev returned %d for %d directions", (int)info, (int)nb);
  PetscCallBLAS("BLAStrsm", BLAStrsm_("L", "L", "T", "N", &nb, &nb, &one, b->factor, &ld, E, &ld));
  for (PetscInt j = 0; j < n; j++) PetscCall(PetscArraycpy(T + j * n, E + (n - 1 - j) * b->max, n));
  PetscCall(PetscFree(work));
  PetscCall(PetscFree(values));
  PetscFunctionReturn(0);
}

/*
   Scales the stored entries of the first k directions so that the largest is between 1/2 and 1. Combinations are scaled
   by a bound of their entries, which may be far too large: after many combinations entries would be too small for
   single precision. Factors are powers of 2, so that nothing is rounded.
*/
static PetscErrorCode BasisNormalize(IPBasis *b, PetscInt k)
{
  PetscReal *largest;

  PetscFunctionBegin;
  PetscCall(PetscCalloc1(k, &largest));
  for (PetscInt c = 0; c < k; c++) {
    for (PetscInt i = 0; i < b->nlocal; i++) largest[c] = PetscMax(largest[c], PetscAbsReal(b->p[c][i]));
  }
  PetscCallMPI(
    MPI_Allreduce(MPI_IN_PLACE, largest, (PetscMPIInt)k, MPIU_REAL, MPIU_MAX, PetscObjectComm((PetscObject)b->d)));
  for (PetscInt c = 0; c < k; c++) {
    int   exponent;
    float factor;

    frexp(largest[c], &exponent);
    factor = (float)ldexp(1.0, -exponent);
    for (PetscInt i = 0; i < b->nlocal; i++) b->p[c][i] *= factor;
    b->size[c] /= factor;
  }
  PetscCall(PetscFree(largest));
  PetscFunctionReturn(0);
}

/*
   Replaces the first k of n directions by their combinations with the columns of T (length n). The vectors are
   processed in blocks of entries to save memory.
*/
static PetscErrorCode BasisCombine(IPBasis *b, PetscInt n, PetscInt k, const PetscReal T[])
{
  const PetscInt chunk = 128;
  PetscReal     *size, *factor, *row;
  float        **part;

  PetscFunctionBegin;
  PetscCall(PetscMalloc4(k, &size, n * k, &factor, chunk * k, &row, n, &part));
  for (PetscInt c = 0; c < k; c++) {
    size[c] = 0.0; /* bounds the largest entry */
    for (PetscInt j = 0; j < n; j++) {
      factor[j + c * n] = T[j + c * n] * b->size[j];
      size[c] += PetscAbsReal(factor[j + c * n]);
    }
  }
  for (PetscInt start = 0; start < b->nlocal; start += chunk) {
    const PetscInt rows = PetscMin(chunk, b->nlocal - start);

    for (PetscInt j = 0; j < n; j++) part[j] = b->p[j] + start;
    PetscCall(PetscArrayzero(row, chunk * k));
    for (PetscInt c = 0; c < k; c++) IPSingleCombine(rows, n, factor + c * n, part, row + c * chunk);
    for (PetscInt c = 0; c < k; c++) IPSingleRound(rows, row + c * chunk, size[c], part[c]);
  }
  PetscCall(PetscArraycpy(b->size, size, k));
  PetscCall(PetscFree4(size, factor, row, part));
  PetscCall(BasisNormalize(b, k));
  PetscFunctionReturn(0);
}

/*
   Replaces the rows W of K times the first k of n directions by their combinations with the columns of T, in blocks
   of entries that stay in the cache
*/
static PetscErrorCode BasisCombineForces(IPBasis *b, PetscInt n, PetscInt k, const PetscReal T[])
{
  const PetscInt chunk = 128;
  PetscScalar   *sums;
  PetscInt       nw;

  PetscFunctionBegin;
  PetscCall(ISGetLocalSize(b->W, &nw));
  PetscCall(PetscMalloc1(chunk * k, &sums));
  for (PetscInt start = 0; start < nw; start += chunk) {
    const PetscInt rows = PetscMin(chunk, nw - start);

    PetscCall(PetscArrayzero(sums, chunk * k));
    for (PetscInt c = 0; c < k; c++) {
      for (PetscInt j = 0; j < n; j++) {
        const PetscReal    factor = T[j + c * n];
        const PetscScalar *q      = b->q[j] + start;

        for (PetscInt i = 0; i < rows; i++) sums[c * chunk + i] += factor * q[i];
      }
    }
    for (PetscInt c = 0; c < k; c++) PetscCall(PetscArraycpy(b->q[c] + start, sums + c * chunk, rows));
  }
  PetscCall(PetscFree(sums));
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
  PetscCallMPI(MPI_Bcast(T, (PetscMPIInt)(n * n), MPIU_REAL, 0, PetscObjectComm((PetscObject)b->d)));
  PetscCall(BasisCombine(b, n, best, T));
  PetscCall(BasisCombineForces(b, n, best, T));
  PetscCall(BasisCombineGram(b, n, best, T));
  for (PetscInt j = 0; j < b->n; j++) keep[j] = (PetscBool)(j < best || j >= n);
  PetscCall(BasisSelect(b, keep));
  PetscCall(PetscFree2(T, keep));
  PetscCall(BasisFactor(b));
  PetscFunctionReturn(0);
}

/* Stores the rows W, and the columns of the Gram matrix, of k directions from number `first` on. KD: K times them */
static PetscErrorCode BasisStoreProducts(IPBasis *b, PetscInt first, PetscInt k, const PetscReal *KD)
{
  const PetscInt *w, n = first + k;
  PetscInt        nw, start;
  PetscReal      *s;

  PetscFunctionBegin;
  PetscCall(ISGetLocalSize(b->W, &nw));
  PetscCall(ISGetIndices(b->W, &w));
  PetscCall(VecGetOwnershipRange(b->d, &start, NULL));
  PetscCall(PetscMalloc1(LANES * n, &s));
  IPProductsDots(b->nlocal, n, b->p, KD, s);
  PetscCallMPI(
    MPI_Allreduce(MPI_IN_PLACE, s, (PetscMPIInt)(LANES * n), MPIU_REAL, MPIU_SUM, PetscObjectComm((PetscObject)b->d)));
  for (PetscInt j = first; j < n; j++) {
    if (!b->q[j]) PetscCall(PetscMalloc1(nw, &b->q[j]));
    for (PetscInt i = 0; i < nw; i++) b->q[j][i] = KD[(size_t)(w[i] - start) * LANES + (size_t)(j - first)];
    for (PetscInt i = 0; i <= j; i++)
      b->gram[i + j * b->max] = b->gram[j + i * b->max] = b->size[i] * s[LANES * i + j - first];
  }
  PetscCall(PetscFree(s));
  PetscCall(ISRestoreIndices(b->W, &w));
  PetscFunctionReturn(0);
}

/* Computes the rows of K P that belong to W, and the Gram matrix P^T K P, for as many directions at once as there are
   lanes */
PetscErrorCode IPBasisMultiply(IPBasis *b, Mat K)
{
  PetscReal *D, *KD;

  PetscFunctionBegin;
  PetscCall(PetscMalloc2(LANES * b->nlocal, &D, LANES * b->nlocal, &KD));
  for (PetscInt first = 0; first < b->n; first += LANES) {
    const PetscInt k = PetscMin(LANES, b->n - first);

    IPProductsSpread(b->nlocal, k, b->p + first, b->size + first, D);
    PetscCall(IPProductsMultiply(K, D, b->d, b->Kd, KD));
    PetscCall(BasisStoreProducts(b, first, k, KD));
  }
  PetscCall(PetscFree2(D, KD));
  PetscCall(BasisFactor(b));
  PetscFunctionReturn(0);
}

/* Sets the directions to zero on a set of unknowns. *cut becomes true if an entry of this rank was not zero. */
static PetscErrorCode BasisCut(IPBasis *b, IS set, PetscBool *cut)
{
  const PetscInt *rows;
  PetscInt        n, start;

  PetscFunctionBegin;
  PetscCall(ISGetLocalSize(set, &n));
  PetscCall(ISGetIndices(set, &rows));
  PetscCall(VecGetOwnershipRange(b->d, &start, NULL));
  for (PetscInt j = 0; j < b->n; j++) {
    for (PetscInt i = 0; i < n; i++) {
      *cut                     = (PetscBool)(*cut || b->p[j][rows[i] - start] != 0.0f);
      b->p[j][rows[i] - start] = 0.0f;
    }
  }
  PetscCall(ISRestoreIndices(set, &rows));
  PetscFunctionReturn(0);
}

/* Selects the rows W of K P from those of the previous W. *found: false if W has other unknowns on this rank */
static PetscErrorCode BasisSelectForces(IPBasis *b, IS W, PetscBool *found)
{
  const PetscInt *old, *now;
  PetscInt        nold, nnow, *place;

  PetscFunctionBegin;
  PetscCall(ISGetLocalSize(b->W, &nold));
  PetscCall(ISGetLocalSize(W, &nnow));
  PetscCall(ISGetIndices(b->W, &old));
  PetscCall(ISGetIndices(W, &now));
  PetscCall(PetscMalloc1(nnow, &place));
  for (PetscInt i = 0; i < nnow && *found; i++) {
    PetscCall(PetscFindInt(now[i], nold, old, &place[i]));
    *found = (PetscBool)(place[i] >= 0);
  }
  for (PetscInt j = 0; j < b->n && *found; j++) {
    for (PetscInt i = 0; i < nnow; i++) b->q[j][i] = b->q[j][place[i]]; /* both sets are sorted: place[i] >= i */
  }
  PetscCall(PetscFree(place));
  PetscCall(ISRestoreIndices(W, &now));
  PetscCall(ISRestoreIndices(b->W, &old));
  PetscFunctionReturn(0);
}

/*
   Sets the directions to zero on W and on the unknowns `fixed` (NULL: none). The Gram matrix and the rows W of K P
   are computed again if K is new, if a direction changed, or if W has entries that the W before did not have.
*/
PetscErrorCode IPBasisUpdate(IPBasis *b, Mat K, PetscBool new_K, IS fixed, IS W)
{
  PetscBool valid, same = PETSC_FALSE, cut = PETSC_FALSE;

  PetscFunctionBegin;
  if (!b->d) PetscCall(MatCreateVecs(K, &b->d, &b->Kd));
  if (fixed) PetscCall(BasisCut(b, fixed, &cut));
  PetscCall(BasisCut(b, W, &cut));
  valid = (PetscBool)(!new_K && !cut && b->W);
  if (b->W) PetscCall(ISEqual(b->W, W, &same));
  if (valid && !same) PetscCall(BasisSelectForces(b, W, &valid));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &valid, 1, MPI_PETSCBOOL, MPI_LAND, PetscObjectComm((PetscObject)W)));
  PetscCall(PetscObjectReference((PetscObject)W));
  if (valid) PetscCall(ISDestroy(&b->W));
  else PetscCall(BasisForgetW(b));
  b->W = W;
  if (new_K || !same) b->has_modes = PETSC_FALSE;
  if (!valid && b->n) PetscCall(IPBasisMultiply(b, K));
  PetscFunctionReturn(0);
}
