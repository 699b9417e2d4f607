/* The condensed linear system: Krylov tolerance, verdict on the solution, and the record of iterations. */
#include "ipfilterimpl.h"

static PetscErrorCode RecordIterations(Tao tao, PetscInt its)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  if (ip->niter_ksp == ip->max_ksp) {
    ip->max_ksp = 2 * ip->max_ksp + 32;
    PetscCall(PetscRealloc(ip->max_ksp * sizeof(PetscInt), &ip->ksp_iterations));
  }
  ip->ksp_iterations[ip->niter_ksp++] = its;
  tao->ksp_its += its;
  tao->ksp_tot_its += its;
  PetscFunctionReturn(0);
}

/* ||b - A d||, not the Krylov method's estimate of it */
static PetscErrorCode TrueResidual(Tao tao, Vec b, Vec d, PetscReal *norm)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  PetscCall(MatMult(ip->cond.A, d, ip->xwork2));
  PetscCall(VecAYPX(ip->xwork2, -1.0, b));
  PetscCall(VecNorm(ip->xwork2, NORM_2, norm));
  PetscFunctionReturn(0);
}

/* Drops a guess so bad that the KSP would take it for divergence. Its residual may well exceed b's: what the filter or the
   first iterations correct does no harm. */
static PetscErrorCode CheckGuess(Tao tao, Vec b, Vec d, PetscReal bnorm, PetscReal dtol)
{
  PetscReal residual, size;

  PetscFunctionBegin;
  PetscCall(VecNorm(d, NORM_INFINITY, &size));
  if (size == 0.0) PetscFunctionReturn(0);
  PetscCall(TrueResidual(tao, b, d, &residual));
  if (!(residual < 0.1 * dtol * bnorm)) PetscCall(VecSet(d, 0.0));
  PetscFunctionReturn(0);
}

/* Whether a direction that the KSP did not call converged may be used all the same. Rounding, too, makes CG meet a
   negative product; a residual within reach of the target settles that the direction solves the system. */
static PetscBool Usable(const TAO_IPFILTER *ip, KSPConvergedReason reason, PetscReal target, PetscReal bnorm)
{
  if (PetscIsInfOrNanReal(ip->linear_residual)) return PETSC_FALSE;
  if (reason > 0) return PETSC_TRUE;
  if (reason == KSP_DIVERGED_PC_FAILED) return PETSC_FALSE;
  if (reason == KSP_DIVERGED_ITS || reason == KSP_DIVERGED_BREAKDOWN) return (PetscBool)(ip->linear_residual <= PetscMax(target, ip->forcing_max * bnorm));
  return (PetscBool)(ip->linear_residual <= 10.0 * target);
}

/* Most iterations of the next solve: an indefinite matrix may keep a Krylov method busy for long without showing a
   negative product. Ten times the most that a successful solve has taken is taken as a sign of it. */
static PetscInt IterationLimit(const TAO_IPFILTER *ip, PetscInt given)
{
  const PetscInt least = 500, factor = 10;

  return ip->most_ksp ? PetscMin(given, PetscMax(least, factor * ip->most_ksp)) : given;
}

/*
  Solves A d = b from the guess d, to ||b - A d|| <= target; with fixed forcing the KSP's own tolerances and guess hold.
  *usable is false where the direction is not worth having, the matrix is not positive definite, or the preconditioner
  failed.
*/
PetscErrorCode IPLinearSolve(Tao tao, Vec b, Vec d, PetscReal target, PetscBool *usable)
{
  TAO_IPFILTER      *ip   = (TAO_IPFILTER *)tao->data;
  KSPConvergedReason reason;
  PetscReal          rtol, abstol, dtol, bnorm;
  PetscInt           maxits, its;
  PetscBool          guess, direct;

  PetscFunctionBegin;
  PetscCall(PetscLogEventBegin(TAO_IPFilterSolve, tao, b, d, NULL));
  PetscCall(KSPSetOperators(tao->ksp, ip->cond.A, ip->cond.A));
  PetscCall(KSPGetInitialGuessNonzero(tao->ksp, &guess));
  PetscCall(KSPGetTolerances(tao->ksp, &rtol, &abstol, &dtol, &maxits));
  PetscCall(PetscObjectTypeCompare((PetscObject)tao->ksp, KSPPREONLY, &direct)); /* takes no guess */
  PetscCall(VecNorm(b, NORM_2, &bnorm));
  if (ip->forcing == IP_FORCING_ADAPTIVE) {
    PetscCall(CheckGuess(tao, b, d, bnorm, dtol));
    PetscCall(KSPSetInitialGuessNonzero(tao->ksp, direct ? PETSC_FALSE : PETSC_TRUE));
    PetscCall(KSPSetTolerances(tao->ksp, PETSC_MACHINE_EPSILON, target, dtol, IterationLimit(ip, maxits)));
  }
  PetscCall(KSPSolve(tao->ksp, b, d));
  PetscCall(KSPSetTolerances(tao->ksp, rtol, abstol, dtol, maxits));
  PetscCall(KSPSetInitialGuessNonzero(tao->ksp, guess));
  PetscCall(KSPGetConvergedReason(tao->ksp, &reason));
  PetscCall(KSPGetIterationNumber(tao->ksp, &its));
  PetscCall(RecordIterations(tao, its));
  PetscCall(TrueResidual(tao, b, d, &ip->linear_residual));
  *usable = Usable(ip, reason, target, bnorm);
  if (*usable) ip->most_ksp = PetscMax(ip->most_ksp, its);
  if (reason < 0) PetscCall(PetscInfo(tao, "Linear solver stopped with %s after %" PetscInt_FMT " iterations, ||b - A d|| = %g, ||b|| = %g\n", KSPConvergedReasons[reason], its, (double)ip->linear_residual, (double)bnorm));
  /* a factorization that failed is not to be reused */
  if (reason == KSP_DIVERGED_PC_FAILED) PetscCall(KSPReset(tao->ksp));
  ip->ksp_reason = reason;
  PetscCall(PetscLogEventEnd(TAO_IPFilterSolve, tao, b, d, NULL));
  PetscFunctionReturn(0);
}
