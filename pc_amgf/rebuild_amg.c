/* Decides when the AMG is rebuilt */
#include "amgfimpl.h"

/* Number of iterations beyond the ratio that do not cause a rebuild, because small iteration counts vary anyway */
#define LAG_FREE_ITERATIONS 2

/*
   Returns the lag that the user has set, or the default of the cycle. The cycle bfb needs A < 2 B^-1, which an AMG of
   an older operator does not guarantee; its default is a rebuild for every operator. The other cycles are positive
   definite with any positive definite B; their default is the automatic lag.
*/
PetscInt PCAMGFLagEvery_Private(const PC_AMGF *amgf)
{
  if (amgf->lag.every != AMGF_LAG_UNSET) return amgf->lag.every;
  return amgf->cycle == PC_AMGF_BFB ? 1 : AMGF_LAG_AUTO;
}

/*
   Computes the largest ratio, on this rank, by which a diagonal entry has grown or shrunk since the AMG was built.
   Filtered unknowns are left out. An entry that changed and is not positive counts as PETSC_MAX_REAL.
*/
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

/*
   Decides by the automatic rule: *rebuild is true on all ranks if the last solve took too many iterations, or if the
   diagonal has changed too much outside the filtered subspace
*/
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
  } else
    *rebuild = PETSC_TRUE; /* without a stored diagonal there is nothing to compare with: the automatic lag was
                                   set after the AMG was built */
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, rebuild, 1, MPI_PETSCBOOL, MPI_LOR, PetscObjectComm((PetscObject)pc)));
  PetscFunctionReturn(0);
}

/* PCAMGFLagDecide_Private - decides whether this set-up rebuilds the AMG; the subspace must be up to date */
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

/*
   Sets the reference solve, with which later solves are compared. its: 0 if there is none yet; digits: 0 if the
   residual reduction is unknown.
*/
static void LagSetReference(AMGFLag *lag, PetscInt its, PetscReal digits)
{
  lag->its    = its;
  lag->digits = digits;
}

/* PCAMGFLagRebuilt_Private - records that the AMG was just built from the present operator */
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

/*
   Makes the KSP record its initial residual norm. If the user does not record a residual history, a history of one
   entry is set.
*/
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

/*
   Computes the number of decimal digits by which the last solve reduced its residual; 0 if unknown. first: entry of the
   residual history that holds the initial residual norm.
*/
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
   Returns whether the last solve took too many iterations. The iterations per digit of residual reduction are compared
   with those of the reference solve, since tolerances differ between solves (inexact Newton). If a reduction is
   unknown, the iterations are compared.
   The first digits take fewer iterations than later ones. A reference solve of few digits is therefore replaced by the
   first solve of more than twice as many digits, unless that solve was far more expensive per digit.
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
  /* A solve may fail because of the AMG even if the AMG was built from this operator, for example if the operator is
     indefinite. The AMG is rebuilt for the next operator. The exception is a failed preconditioner whose AMG is up
     to date: then the filtered system caused the failure. */
  if (reason < 0) lag->overdue = (PetscBool)(lag->age > 0 || reason != KSP_DIVERGED_PC_FAILED);
  else if (its > 0 && lag->its == 0) LagSetReference(lag, its, digits);
  else if (its > 0 && lag->age > 0) lag->overdue = LagTooManyIterations(lag, its, digits);
  PetscFunctionReturn(0);
}
