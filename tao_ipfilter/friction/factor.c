/*
   Preconditioner of the systems of system.c. It is similar to the lumped preconditioner of FETI (Farhat and Roux, A
   method of finite element tearing and interconnecting and its parallel solution algorithm, 1991):
     (B_v C + B_f)^-1 ~ A^-1 (B_v R D K_WW D R^T + B_f) A^-1,  A = B_v R D R^T + B_f,  D = diag(K_WW)^-1,
   which would be exact for a square R. The Schur complement for y is H = T + RZ^T (...)^-1 B_v RZ. A is sparse and as
   well conditioned as a mass matrix; ILU(0) is therefore sufficient for it. The condition number of the preconditioned
   system is small on every mesh. The factors are used for later B_v and B_f as long as GMRES converges fast.
*/
#include "frictionimpl.h"
#include <petscblaslapack.h>

/* Computes ILU(0) of A, with rows and columns scaled to a diagonal of about 1 */
static PetscErrorCode TermFactorRows(IPTermSystem *t, PetscBool *factored)
{
  const PetscReal tiny = 1e-12;
  MatFactorInfo   info;
  MatFactorError  error;
  IS              rows, columns;
  PetscScalar    *scale;

  PetscFunctionBegin;
  PetscCall(MatFactorInfoInitialize(&info));
  info.fill        = 1.0;
  info.shifttype   = (PetscReal)MAT_SHIFT_NONZERO;
  info.shiftamount = info.zeropivot = tiny;
  PetscCall(VecGetArrayWrite(t->S, &scale));
  PetscCall(PetscArraycpy(scale, t->scale, t->m));
  PetscCall(VecRestoreArrayWrite(t->S, &scale));
  PetscCall(MatDiagonalScale(t->A, t->S, t->S));
  if (!t->F) {
    PetscCall(MatGetFactor(t->A, MATSOLVERPETSC, MAT_FACTOR_ILU, &t->F));
    PetscCall(MatGetOrdering(t->A, MATORDERINGNATURAL, &rows, &columns));
    PetscCall(MatILUFactorSymbolic(t->F, t->A, rows, columns, &info));
    PetscCall(ISDestroy(&rows));
    PetscCall(ISDestroy(&columns));
  }
  PetscCall(MatLUFactorNumeric(t->F, t->A, &info));
  PetscCall(MatFactorGetError(t->F, &error));
  *factored = (PetscBool)(error == MAT_FACTOR_NOERROR);
  PetscFunctionReturn(0);
}

/* Factors A for the present B_v and B_f, and stores copies of these. *factored: false if A is singular. */
static PetscErrorCode TermFactorAll(IPTermSystem *t, PetscBool *factored)
{
  PetscFunctionBegin;
  if (!t->G) PetscCall(IPTermSystemMakeRows(t));
  PetscCall(MatDestroy(&t->Pv));
  PetscCall(MatDestroy(&t->Pf));
  PetscCall(MatDuplicate(t->Bv, MAT_COPY_VALUES, &t->Pv));
  PetscCall(MatDuplicate(t->Bf, MAT_COPY_VALUES, &t->Pf));
  if (t->A) PetscCall(MatMatMult(t->Bv, t->G, MAT_REUSE_MATRIX, PETSC_DEFAULT, &t->A));
  else PetscCall(MatMatMult(t->Bv, t->G, MAT_INITIAL_MATRIX, PETSC_DEFAULT, &t->A));
  PetscCall(MatAXPY(t->A, 1.0, t->Bf, SUBSET_NONZERO_PATTERN));
  PetscCall(TermFactorRows(t, factored));
  t->k     = 0;
  t->stale = (PetscBool) !*factored;
  PetscFunctionReturn(0);
}

/* Computes z = A^-1 r; r is overwritten */
static PetscErrorCode TermFactorDivide(IPTermSystem *t, Vec r, Vec z)
{
  PetscFunctionBegin;
  PetscCall(VecPointwiseMult(r, r, t->S));
  PetscCall(MatSolve(t->F, r, z));
  PetscCall(VecPointwiseMult(z, z, t->S));
  PetscFunctionReturn(0);
}

/* Computes z = A^-1 (P_v R D K_WW D R^T + P_f) A^-1 r; r is overwritten */
static PetscErrorCode TermFactorPrecondition(IPTermSystem *t, Vec r, Vec z)
{
  PetscFunctionBegin;
  PetscCall(TermFactorDivide(t, r, z));
  PetscCall(MatMultTranspose(t->RD, z, t->w));
  PetscCall(MatMult(t->K, t->w, t->Kw));
  PetscCall(MatMult(t->Pf, z, r));
  PetscCall(MatMult(t->RD, t->Kw, z));
  PetscCall(MatMultAdd(t->Pv, z, r, r));
  PetscCall(TermFactorDivide(t, r, z));
  PetscFunctionReturn(0);
}

/* Applies the preconditioner of TermFactorPrecondition() to an array r with an entry per row */
PetscErrorCode IPTermFactorApply(IPTermSystem *t, const PetscReal r[], PetscReal z[])
{
  PetscScalar *a;

  PetscFunctionBegin;
  PetscCall(VecGetArrayWrite(t->r, &a));
  PetscCall(PetscArraycpy(a, r, t->m));
  PetscCall(VecRestoreArrayWrite(t->r, &a));
  PetscCall(VecPlaceArray(t->z, z));
  PetscCall(TermFactorPrecondition(t, t->r, t->z));
  PetscCall(VecResetArray(t->z));
  PetscFunctionReturn(0);
}

/* Computes V = (...)^-1 P_v RZ for new directions, and ZV = RZ^T V, where (...)^-1 is the preconditioner */
static PetscErrorCode TermFactorAppend(IPTermSystem *t, const IPReducedSystem *s)
{
  const PetscReal one = 1.0, zero = 0.0;
  const size_t    m = (size_t)t->m, old = (size_t)t->k;
  PetscBLASInt    mb, k, before, added, ld;

  PetscFunctionBegin;
  PetscCall(PetscBLASIntCast(t->m, &mb));
  PetscCall(PetscBLASIntCast(s->k, &k));
  PetscCall(PetscBLASIntCast(t->k, &before));
  PetscCall(PetscBLASIntCast(s->kmax, &ld));
  added = k - before;
  for (; t->k < s->k; t->k++) {
    PetscCall(VecPlaceArray(t->r, s->JZ + (size_t)t->k * m));
    PetscCall(VecPlaceArray(t->z, t->v));
    PetscCall(MatMult(t->Pv, t->r, t->z));
    PetscCall(VecResetArray(t->z));
    PetscCall(VecResetArray(t->r));
    PetscCall(IPTermFactorApply(t, t->v, t->V + (size_t)t->k * m));
  }
  if (!added || !mb) PetscFunctionReturn(0);
  PetscCallBLAS("BLASgemm", BLASgemm_("T", "N", &k, &added, &mb, &one, s->JZ, &mb, t->V + old * m, &mb, &zero,
                              t->ZV + old * (size_t)s->kmax, &ld));
  if (before)
    PetscCallBLAS("BLASgemm",
      BLASgemm_("T", "N", &added, &before, &mb, &one, s->JZ + old * m, &mb, t->V, &mb, &zero, t->ZV + old, &ld));
  PetscFunctionReturn(0);
}

/*
   Computes the factorization L U = H = T + RZ^T V. The diagonal is raised slightly for bodies that no active row holds.
   *factored: false if H is singular.
*/
static PetscErrorCode TermFactorDirections(IPTermSystem *t, const IPReducedSystem *s, PetscBool *factored)
{
  const PetscReal shift = 1e-14;
  PetscBLASInt    k, info;

  PetscFunctionBegin;
  *factored = PETSC_TRUE;
  if (!s->k) PetscFunctionReturn(0);
  for (PetscInt j = 0; j < s->k; j++) {
    for (PetscInt i = 0; i < s->k; i++) t->H[i + j * s->k] = s->T[i + j * s->kmax] + t->ZV[i + j * s->kmax];
    t->H[j + j * s->k] += (shift + t->hold) * s->G[j];
  }
  PetscCall(PetscBLASIntCast(s->k, &k));
  PetscCallBLAS("LAPACKgetrf", LAPACKgetrf_(&k, &k, t->H, &k, t->pivots, &info));
  *factored = (PetscBool)!info;
  PetscFunctionReturn(0);
}

/*
   Prepares the preconditioner: factors A again if the factors cannot be used, and adds the columns of new directions.
   *ready: false if a matrix is singular.
*/
PetscErrorCode IPTermFactorPrepare(IPTermSystem *t, const IPReducedSystem *s, PetscBool *ready)
{
  const PetscInt before = t->k;

  PetscFunctionBegin;
  *ready = PETSC_TRUE;
  if (!t->F || t->stale) PetscCall(TermFactorAll(t, ready));
  if (!*ready) PetscFunctionReturn(0);
  PetscCall(TermFactorAppend(t, s));
  if (!t->k || t->k != before) PetscCall(TermFactorDirections(t, s, ready));
  PetscFunctionReturn(0);
}
