/* Factors of the bodies' matrix in the subspace: of A_WW, and of the Schur complement C of the directions */
#include "subspace_bodies.h"
#include "pc_amgf/sparse_factors.h"
#include <petscblaslapack.h>

/* Returns the product of two arrays with an entry per unknown of W on this rank */
PetscReal BodiesDot(PetscInt n, const PetscScalar a[], const PetscScalar b[])
{
  PetscReal sum = 0.0;

  for (PetscInt i = 0; i < n; i++) sum += PetscRealPart(a[i] * b[i]);
  return sum;
}

/* Adds the sum of the columns of an array on W, each times its factor, to v */
static PetscErrorCode BodiesAddColumns(PetscInt k, const PetscReal factors[], const PetscScalar X[], Vec v)
{
  PetscScalar *a;
  PetscInt     m;

  PetscFunctionBegin;
  PetscCall(VecGetLocalSize(v, &m));
  PetscCall(VecGetArray(v, &a));
  for (PetscInt j = 0; j < k; j++)
    for (PetscInt i = 0; i < m; i++) a[i] += factors[j] * X[i + (size_t)j * (size_t)m];
  PetscCall(VecRestoreArray(v, &a));
  PetscFunctionReturn(0);
}

/* Solves for the directions: C dy = dy with the Schur complement C, w -= A_WW^-1 Q dy */
PetscErrorCode BodiesSolveSchur(SubspaceBodies b, PetscReal dy[], Vec w)
{
  const PetscInt k = b->recycle->basis.n;
  PetscReal     *minus;
  PetscBLASInt   nk, ld, one = 1, info;

  PetscFunctionBegin;
  if (!k) PetscFunctionReturn(0);
  PetscCall(PetscBLASIntCast(k, &nk));
  PetscCall(PetscBLASIntCast(b->recycle->basis.max, &ld));
  PetscCallBLAS("LAPACKgetrs", LAPACKgetrs_("N", &nk, &one, b->factors, &ld, b->pivots, dy, &nk, &info));
  PetscCall(PetscMalloc1(k, &minus));
  for (PetscInt j = 0; j < k; j++) minus[j] = -dy[j];
  PetscCall(BodiesAddColumns(k, minus, b->X, w));
  PetscCall(PetscFree(minus));
  PetscFunctionReturn(0);
}

/* Finds whether the present factors serve for S. A block of S may differ by a small fraction from the factored one. */
static PetscErrorCode BodiesAreFactored(const SubspaceBodies b, const PetscReal S[], PetscBool *factored)
{
  const PetscReal small = 1e-2; /* GMRES corrects the difference */
  PetscInt        n;

  PetscFunctionBegin;
  *factored = (PetscBool)(b->F != NULL);
  PetscCall(VecGetLocalSize(b->rows, &n));
  for (PetscInt k = 0; k < n && *factored; k++) { /* column k % 3 of the contact k / 3, whose columns differ in size */
    PetscReal change = 0.0, size = 0.0;

    for (PetscInt j = 9 * (k / 3) + k % 3; j < 9 * (k / 3) + 9; j += 3) {
      change = PetscMax(change, PetscAbsReal(S[j] - b->factored[j]));
      size   = PetscMax(size, PetscAbsReal(b->factored[j]));
    }
    *factored = (PetscBool)(change <= small * size);
  }
  PetscCallMPI(
    MPI_Allreduce(MPI_IN_PLACE, factored, 1, MPI_PETSCBOOL, MPI_LAND, PetscObjectComm((PetscObject)b->rows)));
  PetscFunctionReturn(0);
}

/* Sets the scales of the forces of contacts: the square root of each contact's stiffness in the factors */
static PetscErrorCode BodiesSetScales(SubspaceBodies b)
{
  PetscScalar *a;
  PetscInt     n;

  PetscFunctionBegin;
  PetscCall(VecGetLocalSize(b->scale, &n));
  PetscCall(VecGetArrayWrite(b->scale, &a));
  for (PetscInt r = 0; r < n; r++) {
    const PetscReal *S = &b->factored[9 * (r / 3)];

    a[r] = PetscSqrtReal(PetscMax(S[0], PetscMax(S[4], S[8])));
  }
  PetscCall(VecRestoreArrayWrite(b->scale, &a));
  PetscFunctionReturn(0);
}

/* Factors A_WW */
PetscErrorCode BodiesFactor(SubspaceBodies b, const PetscReal S[], PetscBool *factored)
{
  MatFactorError error;
  PetscInt       n, negative;

  PetscFunctionBegin;
  PetscCall(PetscLogEventBegin(TAO_IPFilterReduced, b->tao, NULL, NULL, NULL));
  PetscCall(InterfaceMatrixAssemble(b->A, S));
  PetscCall(AMGFSymmetricFactor(InterfaceMatrixGet(b->A), NULL, &b->F, &negative, &error));
  *factored = (PetscBool)(error == MAT_FACTOR_NOERROR);
  if (!*factored) PetscCall(MatDestroy(&b->F));
  PetscCall(VecGetLocalSize(b->rows, &n));
  PetscCall(PetscArraycpy(b->factored, S, 3 * n));
  PetscCall(BodiesSetScales(b));
  b->nX = 0;
  PetscCall(PetscLogEventEnd(TAO_IPFilterReduced, b->tao, NULL, NULL, NULL));
  PetscFunctionReturn(0);
}

/* Sets D, and factors A_WW unless its factors are almost the present ones */
PetscErrorCode BodiesPrepare(void *data, const PetscReal D[], const PetscReal S[], PetscBool *prepared)
{
  const SubspaceBodies b = (SubspaceBodies)data;
  PetscInt             n;

  PetscFunctionBegin;
  PetscCall(BodiesAreFactored(b, S, prepared));
  if (!*prepared) PetscCall(BodiesFactor(b, S, prepared));
  PetscCall(VecGetLocalSize(b->rows, &n));
  b->coupled = PETSC_FALSE;
  for (PetscInt j = 0; j < 3 * n; j++) {
    b->rest[j] = D[j] - b->factored[j];
    b->coupled = (PetscBool)(b->coupled || b->rest[j] != 0.0);
  }
  PetscCallMPI(
    MPI_Allreduce(MPI_IN_PLACE, &b->coupled, 1, MPI_PETSCBOOL, MPI_LOR, PetscObjectComm((PetscObject)b->rows)));
  PetscFunctionReturn(0);
}

/* Creates a dense matrix with n columns and a row for each unknown of W. columns: the entries on this rank */
static PetscErrorCode BodiesDense(SubspaceBodies b, PetscInt n, PetscScalar columns[], Mat *dense)
{
  PetscInt m, M;

  PetscFunctionBegin;
  PetscCall(VecGetLocalSize(b->on_W, &m));
  PetscCall(VecGetSize(b->on_W, &M));
  PetscCall(MatCreateDense(PetscObjectComm((PetscObject)b->on_W), m, PETSC_DECIDE, M, n, columns, dense));
  PetscFunctionReturn(0);
}

/* Computes the columns of A_WW^-1 Q that are missing */
static PetscErrorCode BodiesSolveDirections(SubspaceBodies b)
{
  const IPBasis *basis = &b->recycle->basis;
  PetscInt       m, n;
  PetscScalar   *Q;
  Mat            dense[2];

  PetscFunctionBegin;
  if (b->generation != basis->generation) b->nX = 0;
  b->generation = basis->generation;
  n             = basis->n - b->nX;
  if (!n) PetscFunctionReturn(0);
  PetscCall(VecGetLocalSize(b->on_W, &m));
  PetscCall(PetscMalloc1((size_t)m * (size_t)n, &Q));
  for (PetscInt j = 0; j < n; j++) PetscCall(PetscArraycpy(Q + j * m, basis->q[b->nX + j], m));
  PetscCall(BodiesDense(b, n, Q, &dense[0]));
  PetscCall(BodiesDense(b, n, b->X + (size_t)m * (size_t)b->nX, &dense[1]));
  PetscCall(MatMatSolve(b->F, dense[0], dense[1]));
  PetscCall(MatDestroy(&dense[0]));
  PetscCall(MatDestroy(&dense[1]));
  PetscCall(PetscFree(Q));
  PetscFunctionReturn(0);
}

/* Computes the missing rows and columns of the Schur complement C = P^T K P - Q^T A_WW^-1 Q, and its factors */
PetscErrorCode BodiesFactorDirections(SubspaceBodies b, PetscBool *factored)
{
  const IPBasis *basis = &b->recycle->basis;
  const PetscInt k = basis->n, old = b->generation == basis->generation ? b->nX : 0;
  PetscInt       m, count          = 0;
  PetscReal     *sums;
  PetscBLASInt   nk, ld, info = 0;

  PetscFunctionBegin;
  *factored = PETSC_TRUE;
  PetscCall(BodiesSolveDirections(b));
  PetscCall(VecGetLocalSize(b->on_W, &m));
  PetscCall(PetscMalloc1(k * k - old * old, &sums));
  for (PetscInt j = 0; j < k; j++)
    for (PetscInt i = j < old ? old : 0; i < k; i++)
      sums[count++] = BodiesDot(m, basis->q[i], b->X + (size_t)j * (size_t)m);
  PetscCallMPI(
    MPI_Allreduce(MPI_IN_PLACE, sums, (PetscMPIInt)count, MPIU_REAL, MPIU_SUM, PetscObjectComm((PetscObject)b->on_W)));
  count = 0;
  for (PetscInt j = 0; j < k; j++)
    for (PetscInt i = j < old ? old : 0; i < k; i++)
      b->schur[i + j * basis->max] = basis->gram[i + j * basis->max] - sums[count++];
  PetscCall(PetscFree(sums));
  b->nX = k;
  if (!k) PetscFunctionReturn(0);
  for (PetscInt j = 0; j < k; j++) PetscCall(PetscArraycpy(b->factors + j * basis->max, b->schur + j * basis->max, k));
  PetscCall(PetscBLASIntCast(k, &nk));
  PetscCall(PetscBLASIntCast(basis->max, &ld));
  PetscCallBLAS("LAPACKgetrf", LAPACKgetrf_(&nk, &nk, b->factors, &ld, b->pivots, &info));
  *factored = (PetscBool)!info;
  PetscFunctionReturn(0);
}
