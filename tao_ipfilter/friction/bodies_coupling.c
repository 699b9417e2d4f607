/*
   A system in the subspace. The factors have the symmetric blocks S in place of D; GMRES finds the forces e = (D - S) R
   dx of the rest.
*/
#include "subspace_bodies.h"

/* Computes v = (D - S) v for a vector with the entries of contacts */
static PetscErrorCode BodiesMultiplyRest(SubspaceBodies b, Vec v)
{
  PetscScalar *a;
  PetscInt     n;

  PetscFunctionBegin;
  PetscCall(VecGetLocalSize(v, &n));
  PetscCall(VecGetArray(v, &a));
  for (PetscInt i = 0; i < n; i += 3) {
    const PetscReal u[3] = {PetscRealPart(a[i]), PetscRealPart(a[i + 1]), PetscRealPart(a[i + 2])};
    PetscReal       f[3];

    ConeMultiply(&b->rest[3 * i], u, f);
    for (PetscInt r = 0; r < 3; r++) a[i + r] = f[r];
  }
  PetscCall(VecRestoreArray(v, &a));
  PetscFunctionReturn(0);
}

/* Computes w = A_WW^-1 R_W^T forces */
static PetscErrorCode BodiesRespondOnW(SubspaceBodies b, Vec forces, Vec w)
{
  PetscFunctionBegin;
  PetscCall(MatMultTranspose(b->RW, forces, b->load));
  PetscCall(MatSolve(b->F, b->load, w));
  PetscFunctionReturn(0);
}

/* Computes the motion w of W that forces of contacts cause in the subspace, if S stands in place of D */
static PetscErrorCode BodiesRespond(SubspaceBodies b, Vec forces, Vec w)
{
  const IPBasis     *basis = &b->recycle->basis;
  const PetscScalar *a;
  PetscReal         *dy;
  PetscInt           m;

  PetscFunctionBegin;
  PetscCall(BodiesRespondOnW(b, forces, w));
  PetscCall(PetscCalloc1(basis->n, &dy));
  PetscCall(VecGetLocalSize(w, &m));
  PetscCall(VecGetArrayRead(w, &a));
  for (PetscInt j = 0; j < basis->n; j++) dy[j] = -BodiesDot(m, basis->q[j], a);
  PetscCall(VecRestoreArrayRead(w, &a));
  PetscCallMPI(
    MPI_Allreduce(MPI_IN_PLACE, dy, (PetscMPIInt)basis->n, MPIU_REAL, MPIU_SUM, PetscObjectComm((PetscObject)w)));
  PetscCall(BodiesSolveSchur(b, dy, w));
  PetscCall(PetscFree(dy));
  PetscFunctionReturn(0);
}

/* Multiplies by the matrix of GMRES: y = e + (D - S) R w, where the forces e move W by w. Both e and y are scaled. */
static PetscErrorCode BodiesCoupling(Mat matrix, Vec e, Vec y)
{
  SubspaceBodies b;

  PetscFunctionBegin;
  PetscCall(MatShellGetContext(matrix, &b));
  PetscCall(VecCopy(e, y));
  PetscCall(VecPointwiseMult(y, y, b->scale));
  PetscCall(BodiesRespond(b, y, b->on_W));
  PetscCall(MatMult(b->RW, b->on_W, y));
  PetscCall(BodiesMultiplyRest(b, y));
  PetscCall(VecQuotient_AMGF(y, y, b->scale));
  PetscCall(VecAXPY(y, 1.0, e));
  PetscFunctionReturn(0);
}

/* Creates GMRES for the forces e */
PetscErrorCode BodiesCreateCoupling(SubspaceBodies b)
{
  const PetscInt most = 60; /* iterations */
  Mat            matrix;
  PC             none;
  PetscInt       n;

  PetscFunctionBegin;
  PetscCall(VecDuplicate(b->rows, &b->e));
  PetscCall(VecDuplicate(b->rows, &b->off));
  PetscCall(VecDuplicate(b->rows, &b->scale));
  PetscCall(VecGetLocalSize(b->rows, &n));
  PetscCall(MatCreateShell(PetscObjectComm((PetscObject)b->rows), n, n, PETSC_DETERMINE, PETSC_DETERMINE, b, &matrix));
  PetscCall(MatShellSetOperation(matrix, MATOP_MULT, (void (*)(void))BodiesCoupling));
  PetscCall(KSPCreate(PetscObjectComm((PetscObject)b->rows), &b->coupling));
  PetscCall(KSPSetType(b->coupling, KSPGMRES));
  PetscCall(KSPGMRESSetRestart(b->coupling, most));
  PetscCall(KSPSetTolerances(b->coupling, PETSC_DEFAULT, PETSC_DEFAULT, PETSC_DEFAULT, most));
  PetscCall(KSPGetPC(b->coupling, &none));
  PetscCall(PCSetType(none, PCNONE));
  PetscCall(KSPSetOperators(b->coupling, matrix, matrix));
  PetscCall(MatDestroy(&matrix));
  PetscFunctionReturn(0);
}

/* Computes the loads P^T rhs - Q^T dw0 of the directions that are new in this solve */
static PetscErrorCode BodiesLoadDirections(SubspaceBodies b)
{
  const IPBasis     *basis = &b->recycle->basis;
  const PetscInt     first = b->nloads, n = basis->n - first;
  const PetscScalar *w;
  PetscInt           m;
  PetscReal         *sums;

  PetscFunctionBegin;
  if (n <= 0) PetscFunctionReturn(0);
  PetscCall(PetscMalloc1(n, &sums));
  PetscCall(VecGetLocalSize(b->dw0, &m));
  PetscCall(VecGetArrayRead(b->dw0, &w));
  for (PetscInt j = 0; j < n; j++) sums[j] = BodiesDot(m, basis->q[first + j], w);
  PetscCall(VecRestoreArrayRead(b->dw0, &w));
  PetscCallMPI(
    MPI_Allreduce(MPI_IN_PLACE, sums, (PetscMPIInt)n, MPIU_REAL, MPIU_SUM, PetscObjectComm((PetscObject)b->dx)));
  PetscCall(IPBasisDots(basis, first, n, b->rhs, b->loads + first));
  for (PetscInt j = 0; j < n; j++) b->loads[first + j] -= sums[j];
  PetscCall(PetscFree(sums));
  b->nloads = basis->n;
  PetscFunctionReturn(0);
}

/*
   Computes dx = base + (dw, dy) with dw0 = A_WW^-1 rhs_W, C dy = P^T rhs - Q^T dw0, dw = dw0 - A_WW^-1 Q dy
*/
static PetscErrorCode BodiesSolveInSubspace(SubspaceBodies b)
{
  const IPBasis *basis = &b->recycle->basis;

  PetscFunctionBegin;
  PetscCall(VecCopy(b->dw0, b->load));
  PetscCall(VecCopy(b->base, b->dx));
  PetscCall(BodiesLoadDirections(b));
  PetscCall(PetscArraycpy(b->dy, b->loads, basis->n));
  PetscCall(BodiesSolveSchur(b, b->dy, b->load));
  PetscCall(IPBasisAdd(basis, b->dy, b->dx));
  PetscCall(VecISAXPY(b->dx, b->W, 1.0, b->load));
  PetscFunctionReturn(0);
}

/*
   Solves in the subspace. With the forces e, dx is that of the symmetric matrix for the load without R^T e. Then e is
   corrected until it differs from (D - S) R dx by at most `error` [2-norm of scaled forces]. If rounding does not allow
   that, e is corrected as far as rounding allows.
*/
PetscErrorCode BodiesSolveCoupled(SubspaceBodies b, PetscReal error, PetscBool *solved)
{
  const PetscReal least = 1e-3 * CONTACT_WEAK, /* of e, which contains the forces of weak springs */
    enough              = 1e-2; /* after many iterations: Newton's method and the cones correct what is left */
  PetscReal size, off;

  PetscFunctionBegin;
  PetscCall(BodiesSolveInSubspace(b));
  if (!b->coupled) PetscFunctionReturn(0);
  PetscCall(MatMult(b->R, b->dx, b->rows));
  PetscCall(BodiesMultiplyRest(b, b->rows));
  PetscCall(VecQuotient_AMGF(b->rows, b->rows, b->scale));
  PetscCall(VecNorm(b->rows, NORM_2, &size));
  PetscCall(VecAXPY(b->rows, -1.0, b->e));
  PetscCall(VecNorm(b->rows, NORM_2, &off));
  *solved = (PetscBool)!PetscIsInfOrNanReal(off);
  error   = PetscMax(least * size, error);
  if (!*solved || off <= error) PetscFunctionReturn(0);
  PetscCall(KSPSetTolerances(b->coupling, PETSC_SMALL, error, PETSC_DEFAULT, PETSC_DEFAULT));
  PetscCall(KSPSolve(b->coupling, b->rows, b->off));
  PetscCall(KSPGetResidualNorm(b->coupling, &off));
  *solved = (PetscBool)(off <= PetscMax(error, enough * size));
  PetscCall(VecAXPY(b->e, 1.0, b->off));
  PetscCall(VecPointwiseMult(b->off, b->off, b->scale));
  PetscCall(BodiesRespondOnW(b, b->off, b->on_W));
  PetscCall(VecAXPY(b->dw0, -1.0, b->on_W));
  b->nloads = 0;
  PetscCall(BodiesSolveInSubspace(b));
  PetscFunctionReturn(0);
}
