/* When to rebuild the AMG */
#include "amgfimpl.h"

/* additional iterations that are always allowed, because small iteration counts vary */
#define LAG_FREE_ITERATIONS 2

/* Returns the lag: default 1 for bfb, which needs A < 2 B^-1; an old B does not guarantee that. The other cycles are
   positive definite with any B */
PetscInt PCAMGFLagEvery_Private(const PC_AMGF *amgf)
{
  if (amgf->lag.every != AMGF_LAG_UNSET) return amgf->lag.every;
  return amgf->cycle == PC_AMGF_BFB ? 1 : AMGF_LAG_AUTO;
}

/* Largest ratio, on this rank, by which a diagonal entry outside the active subspace has grown or shrunk since the
   AMG was built */
static PetscErrorCode LagDiagonalDrift(PC_AMGF *amgf, Vec diagonal, PetscReal *drift)
{
  PetscInt           n, start, nrows = 0, k = 0;
  const PetscInt    *rows = NULL;
  const PetscScalar *now, *old;

  PetscFunctionBegin;
  *drift = 1.0;
  PetscCall(VecGetLocalSize(diagonal, &n));
  PetscCall(VecGetOwnershipRange(diagonal, &start, NULL));
  if (amgf->active && amgf->sub.rows) {
    PetscCall(ISGetLocalSize(amgf->sub.rows, &nrows));
    PetscCall(ISGetIndices(amgf->sub.rows, &rows));
  }
  PetscCall(VecGetArrayRead(diagonal, &now));
  PetscCall(VecGetArrayRead(amgf->lag.diagonal, &old));
  for (PetscInt i = 0; i < n; i++) {
    if (k < nrows && rows[k] == start + i) k++;
    else if (now[i] != old[i]) {
      const PetscReal a = PetscRealPart(now[i]), b = PetscRealPart(old[i]);

      *drift = PetscMax(*drift, a > 0.0 && b > 0.0 ? PetscMax(a / b, b / a) : PETSC_MAX_REAL);
    }
  }
  PetscCall(VecRestoreArrayRead(amgf->lag.diagonal, &old));
  PetscCall(VecRestoreArrayRead(diagonal, &now));
  if (rows) PetscCall(ISRestoreIndices(amgf->sub.rows, &rows));
  PetscFunctionReturn(0);
}

/* rebuild: the last solve took too many iterations, or the operator has changed outside the filtered subspace */
static PetscErrorCode LagDecideAutomatically(PC pc, PetscBool *rebuild)
{
  PC_AMGF  *amgf = (PC_AMGF *)pc->data;
  Vec       diagonal;
  PetscReal drift;

  PetscFunctionBegin;
  *rebuild = amgf->lag.overdue;
  if (amgf->lag.diagonal) {
    PetscCall(VecDuplicate(amgf->lag.diagonal, &diagonal));
    PetscCall(MatGetDiagonal(pc->pmat, diagonal));
    PetscCall(LagDiagonalDrift(amgf, diagonal, &drift));
    PetscCall(VecDestroy(&diagonal));
    if (drift > AMGF_LAG_RATIO) *rebuild = PETSC_TRUE;
  } else *rebuild = PETSC_TRUE; /* there is nothing to compare with, as automatic lag was set after the AMG was built */
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, rebuild, 1, MPI_PETSCBOOL, MPI_LOR, PetscObjectComm((PetscObject)pc)));
  PetscFunctionReturn(0);
}

/*
   PCAMGFLagDecide_Private - whether this set-up rebuilds the AMG; call with the subspace up to date
*/
PetscErrorCode PCAMGFLagDecide_Private(PC pc, PetscBool *rebuild)
{
  PC_AMGF       *amgf  = (PC_AMGF *)pc->data;
  AMGFLag       *lag   = &amgf->lag;
  const PetscInt every = PCAMGFLagEvery_Private(amgf);
  AMGFStamp      now;
  PetscBool      unchanged;

  PetscFunctionBegin;
  PetscCall(MatGetStamp_AMGF(pc->pmat, &now));
  unchanged = AMGFStampSameValues(&now, &lag->seen);
  lag->seen = now;
  if (!lag->built) *rebuild = PETSC_TRUE;
  else if (unchanged) *rebuild = PETSC_FALSE;
  else {
    lag->age++;
    if (every > 0) *rebuild = (PetscBool)(lag->age >= every);
    else if (every == AMGF_LAG_NEVER) *rebuild = PETSC_FALSE;
    else PetscCall(LagDecideAutomatically(pc, rebuild));
  }
  PetscFunctionReturn(0);
}

/* Sets the solve with which later ones are compared; its = 0: none yet, digits = 0: unknown */
static void LagSetReference(AMGFLag *lag, PetscInt its, PetscReal digits)
{
  lag->its    = its;
  lag->digits = digits;
}

/*
   PCAMGFLagRebuilt_Private - call after the AMG was built from the present operator
*/
PetscErrorCode PCAMGFLagRebuilt_Private(PC pc)
{
  PC_AMGF *amgf = (PC_AMGF *)pc->data;
  AMGFLag *lag  = &amgf->lag;

  PetscFunctionBegin;
  lag->built   = PETSC_TRUE;
  lag->age     = 0;
  lag->overdue = PETSC_FALSE;
  LagSetReference(lag, 0, 0.0);
  if (PCAMGFLagEvery_Private(amgf) == AMGF_LAG_AUTO) {
    if (!lag->diagonal) PetscCall(MatCreateVecs(pc->pmat, &lag->diagonal, NULL));
    PetscCall(MatGetDiagonal(pc->pmat, lag->diagonal));
  } else PetscCall(VecDestroy(&lag->diagonal));
  PetscFunctionReturn(0);
}

PetscErrorCode PCAMGFLagReset_Private(AMGFLag *lag)
{
  PetscFunctionBegin;
  PetscCall(VecDestroy(&lag->diagonal));
  lag->built   = PETSC_FALSE;
  lag->overdue = PETSC_FALSE;
  LagSetReference(lag, 0, 0.0);
  lag->age = 0;
  PetscFunctionReturn(0);
}

/* Makes KSP record the initial residual: a history of one entry, unless the user keeps a history */
PetscErrorCode PCPreSolve_AMGF(PC pc, KSP ksp, Vec b, Vec x)
{
  PC_AMGF         *amgf = (PC_AMGF *)pc->data;
  const PetscReal *history;

  PetscFunctionBegin;
  (void)b;
  (void)x;
  if (PCAMGFLagEvery_Private(amgf) != AMGF_LAG_AUTO) PetscFunctionReturn(0);
  PetscCall(KSPGetResidualHistory(ksp, &history, &amgf->lag.history));
  if (!history) {
    PetscCall(KSPSetResidualHistory(ksp, NULL, 1, PETSC_TRUE));
    amgf->lag.history = 0;
  }
  PetscFunctionReturn(0);
}

/* Number of digits by which the last solve reduced its residual; 0: unknown */
static PetscErrorCode LagGetDigits(KSP ksp, PetscInt first, PetscReal *digits)
{
  const PetscReal *history;
  PetscInt         n;
  PetscReal        last;

  PetscFunctionBegin;
  *digits = 0.0;
  PetscCall(KSPGetResidualHistory(ksp, &history, &n));
  if (!history || n <= first) PetscFunctionReturn(0);
  PetscCall(KSPGetResidualNorm(ksp, &last));
  if (last > 0.0 && history[first] > last) *digits = PetscLog10Real(history[first] / last);
  PetscFunctionReturn(0);
}

/*
   Tolerances vary from solve to solve (inexact Newton). Therefore iterations per digit of residual reduction are
   compared with those of the first solve after the last rebuild; iterations alone if the residual is unknown. The
   first digits are cheap: a reference of few digits is replaced by the first solve of many, unless that one is much
   more expensive.
*/
static PetscBool LagTooManyIterations(AMGFLag *lag, PetscInt its, PetscReal digits)
{
  const PetscBool perdigit = (PetscBool)(lag->digits > 0.0 && digits > 0.0);
  const PetscReal allowed  = AMGF_LAG_RATIO * lag->its * (perdigit ? digits / lag->digits : 1.0);

  if (its <= allowed + LAG_FREE_ITERATIONS) return PETSC_FALSE;
  if (perdigit && digits > 2.0 * lag->digits && its <= AMGF_LAG_RATIO * allowed + LAG_FREE_ITERATIONS) {
    LagSetReference(lag, its, digits);
    return PETSC_FALSE;
  }
  return PETSC_TRUE;
}

PetscErrorCode PCPostSolve_AMGF(PC pc, KSP ksp, Vec b, Vec x)
{
  AMGFLag           *lag = &((PC_AMGF *)pc->data)->lag;
  KSPConvergedReason reason;
  PetscInt           its;
  PetscReal          digits;

  PetscFunctionBegin;
  (void)b;
  (void)x;
  if (PCAMGFLagEvery_Private((PC_AMGF *)pc->data) != AMGF_LAG_AUTO) PetscFunctionReturn(0);
  PetscCall(KSPGetConvergedReason(ksp, &reason));
  PetscCall(KSPGetIterationNumber(ksp, &its));
  PetscCall(LagGetDigits(ksp, lag->history, &digits));
  /* the solve failed: the AMG may be the cause even if it was built from this operator, for example because the
     operator is not definite. Rebuilds for the next operator, unless the subspace failed */
  if (reason < 0) lag->overdue = (PetscBool)(lag->age > 0 || reason != KSP_DIVERGED_PC_FAILED);
  else if (its > 0 && lag->its == 0) LagSetReference(lag, its, digits);
  else if (its > 0 && lag->age > 0) lag->overdue = LagTooManyIterations(lag, its, digits);
  PetscFunctionReturn(0);
}
