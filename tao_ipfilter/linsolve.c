/*
   The condensed linear system: Krylov tolerance, true residual, refinement, verdict on the solution, and the record of iterations.

   A solve is judged by its true residual b - A d, not by the Krylov method's estimate. Where it falls short the solve is continued
   from the attained iterate; what then still falls short goes to fallback.c.
*/
#include "ipfilterimpl.h"

#define IP_MAX_REFINEMENTS 3
#define IP_EXACT           (10.0 * PETSC_MACHINE_EPSILON) /* backward error that is not worth reducing */
#define IP_ROUNDING        (50.0 * PETSC_MACHINE_EPSILON) /* backward error that rounding leaves any solver */
#define IP_CLOSE           1e-6                           /* fraction of ||b|| from which on rounding may be what stops a Krylov method */

/* The KSP's own convergence test, and what tells that a run is not worth going on with */
typedef struct {
  PetscErrorCode (*test)(KSP, PetscInt, PetscReal, KSPConvergedReason *, void *);
  PetscErrorCode (*destroy)(void *);
  void     *ctx;
  PetscReal close;   /* residual from which on it is looked at */
  PetscReal least;   /* the last residual that was a progress, */
  PetscInt  reached; /* and when */
} StallTest;

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

/* r = b - A d, its norm, and the backward error: its ratio to the terms it is the difference of. A is positive definite, so that
   diag(A) |d| stands for |A| |d|. */
PetscErrorCode IPMeasureResidual(Tao tao, Vec b, Vec d)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  PetscReal     terms;

  PetscFunctionBegin;
  PetscCall(MatMult(ip->cond.A, d, ip->residual));
  PetscCall(VecAYPX(ip->residual, -1.0, b));
  PetscCall(VecNorm(ip->residual, NORM_2, &ip->linear_residual));
  PetscCall(MatGetDiagonal(ip->cond.A, ip->xwork2));
  PetscCall(VecPointwiseMult(ip->xwork2, ip->xwork2, d));
  PetscCall(VecNorm(ip->xwork2, NORM_2, &terms));
  terms += ip->linear_rhs;
  ip->backward_error = terms > 0.0 ? ip->linear_residual / terms : 0.0;
  PetscFunctionReturn(0);
}

/* Whether the residual is what was asked for, or rounding leaves none smaller. With fixed forcing the KSP's own criterion counts
   instead, unless its result is no direction at all. */
PetscBool IPLinearReached(const TAO_IPFILTER *ip, KSPConvergedReason reason)
{
  if (IPUndefined(ip->linear_residual)) return PETSC_FALSE;
  if (ip->backward_error <= IP_ROUNDING) return PETSC_TRUE;
  if (ip->forcing == IP_FORCING_FIXED) return (PetscBool)(reason > 0 && ip->linear_residual <= ip->forcing_max * ip->linear_rhs);
  return (PetscBool)(ip->linear_residual <= 2.0 * ip->linear_target);
}

/* Whether more was asked for, be it more than rounding leaves */
static PetscBool Missed(const TAO_IPFILTER *ip, KSPConvergedReason reason)
{
  return ip->forcing == IP_FORCING_FIXED ? !IPLinearReached(ip, reason) : (PetscBool)(ip->linear_residual > 2.0 * ip->linear_target);
}

/* Whether going on from the attained iterate may gain what the last run missed: it took its own estimate for the residual, or rounding
   made it meet a product of the wrong sign close to the end */
static PetscBool Refinable(const TAO_IPFILTER *ip, KSPConvergedReason reason)
{
  if (IPUndefined(ip->linear_residual)) return PETSC_FALSE;
  if (reason == KSP_DIVERGED_INDEFINITE_MAT || reason == KSP_DIVERGED_INDEFINITE_PC || reason == KSP_DIVERGED_BREAKDOWN) return (PetscBool)(ip->linear_residual <= IP_CLOSE * ip->linear_rhs);
  return (PetscBool)(reason > 0);
}

/* d += A^-1 (b - A d) by the given solver while that halves the residual; exact: to rounding, whatever was asked for */
PetscErrorCode IPLinearRefine(Tao tao, Vec b, Vec d, PetscBool exact, PetscErrorCode (*solve)(Tao, Vec, Vec), KSPConvergedReason reason)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  for (PetscInt k = 0; k < IP_MAX_REFINEMENTS; k++) {
    const PetscReal before = ip->linear_residual;

    if (!Refinable(ip, reason) || ip->backward_error <= (exact ? IP_EXACT : IP_ROUNDING) || (!exact && !Missed(ip, reason))) break;
    PetscCall(IPNeedVec(tao, &ip->correction));
    PetscCall((*solve)(tao, ip->residual, ip->correction));
    PetscCall(VecAXPY(d, 1.0, ip->correction));
    PetscCall(IPMeasureResidual(tao, b, d));
    ip->fallbacks.refinements++;
    PetscCall(PetscInfo(tao, "Refined from ||b - A d|| = %g to %g, asked for %g\n", (double)before, (double)ip->linear_residual, (double)ip->linear_target));
    if (ip->linear_residual <= 0.5 * before) continue;
    if (!(ip->linear_residual <= before)) {
      PetscCall(VecAXPY(d, -1.0, ip->correction));
      PetscCall(IPMeasureResidual(tao, b, d));
    }
    break;
  }
  PetscFunctionReturn(0);
}

/* Most iterations of the next solve: an indefinite matrix may keep a Krylov method busy for long without showing a
   negative product. Ten times the most that a successful solve has taken is taken as a sign of it. */
static PetscInt IterationLimit(const TAO_IPFILTER *ip, PetscInt given)
{
  const PetscInt factor = 10;

  return ip->most_ksp ? PetscMin(given, PetscMax(IP_MANY_ITERATIONS, factor * ip->most_ksp)) : given;
}

/* Ends a run, too, that gains less than a digit in so many iterations close to the end */
static PetscErrorCode TestStalled(KSP ksp, PetscInt it, PetscReal norm, KSPConvergedReason *reason, void *ctx)
{
  StallTest      *s    = (StallTest *)ctx;
  const PetscInt  most = 25;
  const PetscReal gain = 0.1;

  PetscFunctionBegin;
  PetscCall((*s->test)(ksp, it, norm, reason, s->ctx));
  if (!it || norm <= gain * s->least) {
    s->least   = norm;
    s->reached = it;
  }
  if (*reason == KSP_CONVERGED_ITERATING && norm <= s->close && it - s->reached >= most) *reason = KSP_CONVERGED_ITS;
  PetscFunctionReturn(0);
}

/* KSPSolve() with the test for stalling */
static PetscErrorCode SolveUnlessStalled(KSP ksp, Vec b, Vec d)
{
  KSPNormType type;
  StallTest   stall = {.least = 0.0};

  PetscFunctionBegin;
  PetscCall(KSPGetNormType(ksp, &type));
  if (type == KSP_NORM_UNPRECONDITIONED) PetscCall(VecNorm(b, NORM_2, &stall.close));
  stall.close *= IP_CLOSE;
  PetscCall(KSPGetAndClearConvergenceTest(ksp, &stall.test, &stall.ctx, &stall.destroy));
  PetscCall(KSPSetConvergenceTest(ksp, TestStalled, &stall, NULL));
  PetscCall(KSPSolve(ksp, b, d));
  PetscCall(KSPSetConvergenceTest(ksp, stall.test, stall.ctx, stall.destroy));
  PetscFunctionReturn(0);
}

/* One run of the KSP for A d = b, with adaptive forcing from the guess d to the present target */
static PetscErrorCode RunKSP(Tao tao, KSP ksp, Vec b, Vec d)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  PetscReal     rtol, abstol, dtol;
  PetscInt      maxits, its;
  PetscBool     guess, direct;

  PetscFunctionBegin;
  PetscCall(KSPSetOperators(ksp, ip->cond.A, ip->cond.A));
  PetscCall(KSPGetInitialGuessNonzero(ksp, &guess));
  PetscCall(KSPGetTolerances(ksp, &rtol, &abstol, &dtol, &maxits));
  PetscCall(PetscObjectTypeCompare((PetscObject)ksp, KSPPREONLY, &direct)); /* takes no guess */
  ip->linear_limit = maxits;
  if (ip->forcing == IP_FORCING_ADAPTIVE) {
    ip->linear_limit = IterationLimit(ip, maxits);
    PetscCall(KSPSetInitialGuessNonzero(ksp, direct ? PETSC_FALSE : PETSC_TRUE));
    PetscCall(KSPSetTolerances(ksp, PETSC_MACHINE_EPSILON, ip->linear_target, dtol, ip->linear_limit));
  }
  PetscCall(SolveUnlessStalled(ksp, b, d));
  PetscCall(KSPSetTolerances(ksp, rtol, abstol, dtol, maxits));
  PetscCall(KSPSetInitialGuessNonzero(ksp, guess));
  PetscCall(KSPGetIterationNumber(ksp, &its));
  PetscCall(KSPGetConvergedReason(ksp, &ip->ksp_reason));
  PetscCall(RecordIterations(tao, its));
  ip->ksp_last = its;
  PetscFunctionReturn(0);
}

/*
  The same for a correction, by flexible CG in place of CG. Where J^T D J is stiff, what PCAMGF returns carries rounding errors that these
  terms make large: relative to the residual they are the same at every step, so that the preconditioner is not quite linear. CG's
  recurrence does not bear that; flexible CG does, but is blind to negative curvature.
*/
static PetscErrorCode Correct(Tao tao, Vec r, Vec e)
{
  TAO_IPFILTER  *ip         = (TAO_IPFILTER *)tao->data;
  const PetscInt directions = 3;
  PetscReal      rtol, abstol, dtol;
  PetscInt       maxits;
  PetscBool      cg;
  PC             pc;

  PetscFunctionBegin;
  PetscCall(VecSet(e, 0.0));
  PetscCall(PetscObjectTypeCompare((PetscObject)tao->ksp, KSPCG, &cg));
  if (!cg) {
    PetscCall(RunKSP(tao, tao->ksp, r, e));
    PetscFunctionReturn(0);
  }
  if (!ip->flexible) {
    PetscCall(KSPCreate(PetscObjectComm((PetscObject)tao), &ip->flexible));
    PetscCall(KSPSetType(ip->flexible, KSPFCG));
    PetscCall(KSPFCGSetMmax(ip->flexible, directions));
    PetscCall(KSPFCGSetNprealloc(ip->flexible, directions + 1));
    PetscCall(KSPSetNormType(ip->flexible, KSP_NORM_UNPRECONDITIONED));
  }
  PetscCall(KSPGetPC(tao->ksp, &pc));
  PetscCall(KSPSetPC(ip->flexible, pc));
  PetscCall(KSPGetTolerances(tao->ksp, &rtol, &abstol, &dtol, &maxits));
  PetscCall(KSPSetTolerances(ip->flexible, rtol, abstol, dtol, maxits));
  PetscCall(RunKSP(tao, ip->flexible, r, e));
  PetscFunctionReturn(0);
}

/* Drops a guess so bad that the KSP would take it for divergence. Its residual may well exceed b's: what the filter or the
   first iterations correct does no harm. */
static PetscErrorCode CheckGuess(Tao tao, Vec b, Vec d)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  PetscReal     size, dtol;

  PetscFunctionBegin;
  PetscCall(VecNorm(d, NORM_INFINITY, &size));
  if (size == 0.0) PetscFunctionReturn(0);
  PetscCall(KSPGetTolerances(tao->ksp, NULL, NULL, &dtol, NULL));
  PetscCall(IPMeasureResidual(tao, b, d));
  if (!(ip->linear_residual < 0.1 * dtol * ip->linear_rhs)) PetscCall(VecSet(d, 0.0));
  PetscFunctionReturn(0);
}

/* The PC could not be set up because the matrix has a pivot of zero, not because something else failed */
static PetscErrorCode ZeroPivot(Tao tao, PetscBool *zero)
{
  PC             pc;
  PCFailedReason failed;

  PetscFunctionBegin;
  PetscCall(KSPGetPC(tao->ksp, &pc));
  PetscCall(PCGetFailedReason(pc, &failed));
  *zero = (PetscBool)(failed == PC_FACTOR_NUMERIC_ZEROPIVOT || failed == PC_FACTOR_STRUCT_ZEROPIVOT);
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, zero, 1, MPI_PETSCBOOL, MPI_LOR, PetscObjectComm((PetscObject)tao)));
  PetscFunctionReturn(0);
}

/* A d = b by the KSP, refined */
PetscErrorCode IPKrylovSolve(Tao tao, Vec b, Vec d, IPLinearVerdict *verdict)
{
  TAO_IPFILTER      *ip = (TAO_IPFILTER *)tao->data;
  KSPConvergedReason reason;
  PetscInt           its;
  PetscBool          direct, zero = PETSC_FALSE;

  PetscFunctionBegin;
  if (ip->forcing == IP_FORCING_ADAPTIVE) PetscCall(CheckGuess(tao, b, d));
  PetscCall(RunKSP(tao, tao->ksp, b, d));
  reason = ip->ksp_reason;
  its    = ip->ksp_last;
  PetscCall(IPMeasureResidual(tao, b, d));
  PetscCall(PetscObjectTypeCompare((PetscObject)tao->ksp, KSPPREONLY, &direct));
  PetscCall(IPLinearRefine(tao, b, d, direct, Correct, reason));
  ip->ksp_reason = reason;
  ip->ksp_last   = its;
  if (reason == KSP_DIVERGED_PC_FAILED) PetscCall(ZeroPivot(tao, &zero));
  if (IPLinearReached(ip, reason)) *verdict = IP_LINEAR_SOLVED;
  else *verdict = reason == KSP_DIVERGED_INDEFINITE_MAT || zero ? IP_LINEAR_INDEFINITE : IP_LINEAR_FAILED;
  if (*verdict == IP_LINEAR_SOLVED) {
    ip->most_ksp = PetscMax(ip->most_ksp, its);
    ip->ndirect  = 0;
  } else PetscCall(PetscInfo(tao, "Linear solver stopped with %s after %" PetscInt_FMT " iterations, ||b - A d|| = %g, asked for %g, ||b|| = %g\n", KSPConvergedReasons[reason], its, (double)ip->linear_residual, (double)ip->linear_target, (double)ip->linear_rhs));
  /* a factorization that failed is not to be reused */
  if (reason == KSP_DIVERGED_PC_FAILED) PetscCall(KSPReset(tao->ksp));
  PetscFunctionReturn(0);
}

/*
  Solves A d = b from the guess d, to ||b - A d|| <= target; with fixed forcing the KSP's own tolerances and guess hold.
  *usable is false where the matrix is not positive definite, and where no solver gave a direction worth having: ip->linear_failed
  tells that, which no shift of the Hessian cures.
*/
PetscErrorCode IPLinearSolve(Tao tao, Vec b, Vec d, PetscReal target, PetscBool *usable)
{
  TAO_IPFILTER   *ip      = (TAO_IPFILTER *)tao->data;
  IPLinearVerdict verdict = IP_LINEAR_FAILED;

  PetscFunctionBegin;
  PetscCall(PetscLogEventBegin(TAO_IPFilterSolve, tao, b, d, NULL));
  PetscCall(VecNorm(b, NORM_2, &ip->linear_rhs));
  ip->linear_target    = target;
  ip->linear_reason[0] = '\0';
  if (!IPFallbackHolds(ip)) PetscCall(IPKrylovSolve(tao, b, d, &verdict));
  if (verdict == IP_LINEAR_FAILED) PetscCall(IPFallback(tao, b, d, &verdict));
  *usable           = (PetscBool)(verdict == IP_LINEAR_SOLVED);
  ip->linear_failed = (PetscBool)(verdict == IP_LINEAR_FAILED);
  if (*usable) ip->fallbacks.backward_error = PetscMax(ip->fallbacks.backward_error, ip->backward_error);
  PetscCall(PetscLogEventEnd(TAO_IPFilterSolve, tao, b, d, NULL));
  PetscFunctionReturn(0);
}
