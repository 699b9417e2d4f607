/* Solves the condensed system by the user's Krylov method: tolerance, early end, verdict, and record of iterations. */
#include "linearimpl.h"
#include "tao_ipfilter/solver/barrier.h"
#include "tao_ipfilter/solver/condensed.h"
#include "tao_ipfilter/solver/constants.h"
#include "tao_ipfilter/solver/linear.h"
#include "tao_ipfilter/solver/matrices.h"
#include "tao_ipfilter/solver/options.h"
#include "tao_ipfilter/solver/record.h"
#include "tao_ipfilter/solver/relaxation.h"

/* Context of the convergence test: the KSP's own test, and what is needed to detect stagnation */
typedef struct {
  PetscErrorCode (*test)(KSP, PetscInt, PetscReal, KSPConvergedReason *, void *);
  PetscErrorCode (*destroy)(void *);
  void     *ctx;
  PetscReal close;   /* stagnation is tested only below this residual */
  PetscReal least;   /* the last residual that counted as progress */
  PetscInt  reached; /* and when */
} StallTest;

/* Adds a linear solve with its iterations to the record */
PetscErrorCode IPKrylovRecord(Tao tao, PetscInt its)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  if (ip->rec->nksp == ip->rec->max_nksp) {
    ip->rec->max_nksp = 2 * ip->rec->max_nksp + 32;
    PetscCall(PetscRealloc(ip->rec->max_nksp * sizeof(PetscInt), &ip->rec->ksp_iterations));
  }
  ip->rec->ksp_iterations[ip->rec->nksp++] = its;
  tao->ksp_its += its;
  tao->ksp_tot_its += its;
  PetscFunctionReturn(0);
}

/* Iteration limit of the next solve: ten times the longest successful solve. An indefinite matrix may keep a Krylov
   method busy without a negative product p^T A p; exceeding the limit is taken as a sign of that */
static PetscInt KrylovLimit(const TAO_IPFILTER *ip, PetscInt given)
{
  const PetscInt factor = 10;

  return ip->lin->longest ? PetscMin(given, PetscMax(IP_MANY_ITERATIONS, factor * ip->lin->longest)) : given;
}

/* Convergence test that also ends a solve which gains less than one digit in a number of iterations near the end */
static PetscErrorCode KrylovTestStalled(KSP ksp, PetscInt it, PetscReal norm, KSPConvergedReason *reason, void *ctx)
{
  StallTest      *s        = (StallTest *)ctx;
  const PetscInt  patience = 25;
  const PetscReal gain     = 0.1;

  PetscFunctionBegin;
  PetscCall((*s->test)(ksp, it, norm, reason, s->ctx));
  if (!it || norm <= gain * s->least) {
    s->least   = norm;
    s->reached = it;
  }
  if (*reason == KSP_CONVERGED_ITERATING && norm <= s->close && it - s->reached >= patience)
    *reason = KSP_CONVERGED_ITS;
  PetscFunctionReturn(0);
}

/* IPGuardedSolve() with the test for stagnation */
static PetscErrorCode KrylovUnlessStalled(Tao tao, KSP ksp, Vec b, Vec d, PetscBool *failed)
{
  KSPNormType type;
  StallTest   stall = {.least = 0.0};

  PetscFunctionBegin;
  PetscCall(KSPGetNormType(ksp, &type));
  if (type == KSP_NORM_UNPRECONDITIONED) PetscCall(VecNorm(b, NORM_2, &stall.close));
  stall.close *= IP_CLOSE;
  PetscCall(KSPGetAndClearConvergenceTest(ksp, &stall.test, &stall.ctx, &stall.destroy));
  PetscCall(KSPSetConvergenceTest(ksp, KrylovTestStalled, &stall, NULL));
  PetscCall(IPGuardedSolve(tao, ksp, b, d, failed));
  PetscCall(KSPSetConvergenceTest(ksp, stall.test, stall.ctx, stall.destroy));
  PetscFunctionReturn(0);
}

/* One KSP solve of A d = b; with adaptive forcing it starts from d and ends at the present target */
static PetscErrorCode KrylovRun(Tao tao, KSP ksp, Vec b, Vec d)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  PetscReal     rtol, abstol, dtol;
  PetscInt      maxits, its;
  PetscBool     guess, direct, failed;

  PetscFunctionBegin;
  PetscCall(KSPSetOperators(ksp, IPQuasiNewtonOperator(ip), ip->cond->A));
  PetscCall(KSPGetInitialGuessNonzero(ksp, &guess));
  PetscCall(KSPGetTolerances(ksp, &rtol, &abstol, &dtol, &maxits));
  PetscCall(PetscObjectTypeCompare((PetscObject)ksp, KSPPREONLY, &direct)); /* PREONLY takes no initial guess */
  ip->lin->limit = maxits;
  if (ip->opt->forcing == IP_FORCING_ADAPTIVE) {
    ip->lin->limit = KrylovLimit(ip, maxits);
    PetscCall(KSPSetInitialGuessNonzero(ksp, direct ? PETSC_FALSE : PETSC_TRUE));
    PetscCall(KSPSetTolerances(ksp, PETSC_MACHINE_EPSILON, ip->lin->target, dtol, ip->lin->limit));
  }
  PetscCall(KrylovUnlessStalled(tao, ksp, b, d, &failed));
  PetscCall(KSPSetTolerances(ksp, rtol, abstol, dtol, maxits));
  PetscCall(KSPSetInitialGuessNonzero(ksp, guess));
  PetscCall(KSPGetIterationNumber(ksp, &its));
  PetscCall(KSPGetConvergedReason(ksp, &ip->lin->reason));
  if (failed) ip->lin->reason = KSP_DIVERGED_PC_FAILED;
  PetscCall(IPKrylovRecord(tao, its));
  ip->lin->its = its;
  PetscFunctionReturn(0);
}

/*
   Computes a correction like KrylovRun(), but with flexible CG. If J^T D J is stiff, rounding errors in PCAMGF's result
   are amplified by these terms. Relative to the residual they are equally large in every step, so the preconditioner is
   not quite linear, and CG's recurrence fails. Flexible CG works, but does not detect negative curvature
*/
static PetscErrorCode KrylovCorrect(Tao tao, Vec r, Vec e)
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
    PetscCall(KrylovRun(tao, tao->ksp, r, e));
    PetscFunctionReturn(0);
  }
  if (!ip->lin->flexible) {
    PetscCall(KSPCreate(PetscObjectComm((PetscObject)tao), &ip->lin->flexible));
    PetscCall(KSPSetType(ip->lin->flexible, KSPFCG));
    PetscCall(KSPFCGSetMmax(ip->lin->flexible, directions));
    PetscCall(KSPFCGSetNprealloc(ip->lin->flexible, directions + 1));
    PetscCall(KSPSetNormType(ip->lin->flexible, KSP_NORM_UNPRECONDITIONED));
  }
  PetscCall(KSPGetPC(tao->ksp, &pc));
  PetscCall(KSPSetPC(ip->lin->flexible, pc));
  PetscCall(KSPGetTolerances(tao->ksp, &rtol, &abstol, &dtol, &maxits));
  PetscCall(KSPSetTolerances(ip->lin->flexible, rtol, abstol, dtol, maxits));
  PetscCall(KrylovRun(tao, ip->lin->flexible, r, e));
  PetscFunctionReturn(0);
}

/* Drops an initial guess whose residual is so large that the KSP would report divergence. The residual may exceed
   that of zero if the filter or the first iterations correct it */
static PetscErrorCode KrylovCheckGuess(Tao tao, Vec b, Vec d)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  PetscReal     size, dtol;

  PetscFunctionBegin;
  PetscCall(VecNorm(d, NORM_INFINITY, &size));
  if (size == 0.0) PetscFunctionReturn(0);
  PetscCall(KSPGetTolerances(tao->ksp, NULL, NULL, &dtol, NULL));
  PetscCall(IPResidualMeasure(tao, b, d));
  if (!(ip->lin->norm < 0.1 * dtol * ip->lin->rhs)) PetscCall(VecSet(d, 0.0));
  PetscFunctionReturn(0);
}

/* zero: whether the PC set-up failed because of a zero pivot, not for another reason */
static PetscErrorCode KrylovZeroPivot(Tao tao, PetscBool *zero)
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

/* drowned: whether J^T D J is so much larger than the Hessian that rounding may have changed the signs of pivots */
static PetscErrorCode KrylovDrowned(Tao tao, PetscBool *drowned)
{
  TAO_IPFILTER   *ip    = (TAO_IPFILTER *)tao->data;
  const PetscReal ratio = 1e10;
  PetscReal       a, h;
  PetscBool       has;
  Vec             diagonal;

  PetscFunctionBegin;
  *drowned = PETSC_TRUE;
  PetscCall(MatHasOperation(ip->hess->H, MATOP_NORM, &has));
  if (!has) PetscFunctionReturn(0);
  PetscCall(IPGetWork(tao, IP_UNKNOWNS, &diagonal));
  PetscCall(MatGetDiagonal(ip->cond->A, diagonal));
  PetscCall(VecNorm(diagonal, NORM_INFINITY, &a));
  PetscCall(IPRestoreWork(tao, IP_UNKNOWNS, &diagonal));
  PetscCall(MatNorm(ip->hess->H, NORM_FROBENIUS, &h));
  *drowned = (PetscBool) !(a <= ratio * h);
  PetscFunctionReturn(0);
}

/* indefinite: whether factors of A, or of the filter's matrix (a principal submatrix), have negative pivots. A
   Krylov method with few iterations might not detect this */
PetscErrorCode IPKrylovIndefinite(Tao tao, PetscBool *indefinite)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  PetscInt      negative;
  PetscBool     amgf, factored, drowned;
  PC            pc;

  PetscFunctionBegin;
  *indefinite = PETSC_FALSE;
  PetscCall(KSPGetPC(tao->ksp, &pc));
  PetscCall(PetscObjectTypeCompare((PetscObject)pc, PCAMGF, &amgf));
  if (!amgf) PetscFunctionReturn(0);
  PetscCall(PCAMGFGetFactored(pc, &factored, NULL));
  if (!factored && !ip->lin->filtered) PetscFunctionReturn(0);
  PetscCall(KrylovDrowned(tao, &drowned));
  if (drowned) PetscFunctionReturn(0);
  PetscCall(PCAMGFGetFilterPivots(pc, &negative));
  *indefinite = (PetscBool)(negative > 0);
  PetscFunctionReturn(0);
}

/* Solves A d = b by the KSP, with refinement */
PetscErrorCode IPKrylovSolve(Tao tao, Vec b, Vec d, IPLinearVerdict *verdict)
{
  TAO_IPFILTER      *ip = (TAO_IPFILTER *)tao->data;
  KSPConvergedReason reason;
  PetscInt           its;
  PetscBool          direct, indefinite = PETSC_FALSE, zero = PETSC_FALSE;

  PetscFunctionBegin;
  if (ip->opt->forcing == IP_FORCING_ADAPTIVE) PetscCall(KrylovCheckGuess(tao, b, d));
  PetscCall(KrylovRun(tao, tao->ksp, b, d));
  reason = ip->lin->reason;
  its    = ip->lin->its;
  PetscCall(IPResidualMeasure(tao, b, d));
  PetscCall(PetscObjectTypeCompare((PetscObject)tao->ksp, KSPPREONLY, &direct));
  PetscCall(IPResidualRefine(tao, b, d, direct, KrylovCorrect, reason));
  ip->lin->reason = reason;
  ip->lin->its    = its;
  if (reason == KSP_DIVERGED_PC_FAILED) PetscCall(KrylovZeroPivot(tao, &zero));
  /* tested only if the problem has shown that it is not convex, and its constraints have an interior */
  if (ip->lin->filtered && ip->bar->curved && !ip->relax->times) PetscCall(IPKrylovIndefinite(tao, &indefinite));
  if (indefinite) *verdict = IP_LINEAR_INDEFINITE;
  else if (IPResidualReached(ip, reason)) *verdict = IP_LINEAR_SOLVED;
  else *verdict = reason == KSP_DIVERGED_INDEFINITE_MAT || zero ? IP_LINEAR_INDEFINITE : IP_LINEAR_FAILED;
  if (*verdict == IP_LINEAR_SOLVED) {
    ip->lin->longest = PetscMax(ip->lin->longest, its);
    ip->lin->ndirect = 0;
  } else
    PetscCall(PetscInfo(tao,
      "Linear solver stopped with %s after %" PetscInt_FMT " iterations, ||b - A d|| = %g, asked for %g, ||b|| = %g\n",
      KSPConvergedReasons[reason], its, (double)ip->lin->norm, (double)ip->lin->target, (double)ip->lin->rhs));
  /* a failed factorization must not be reused */
  if (reason == KSP_DIVERGED_PC_FAILED) PetscCall(IPKSPReset(tao->ksp));
  PetscFunctionReturn(0);
}
