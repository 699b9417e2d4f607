/*
   Solves the condensed system by the user's Krylov method: sets tolerances, ends stagnating solves, judges the result,
   and records the iterations
*/
#include "linearimpl.h"
#include "tao_ipfilter/solver/barrier.h"
#include "tao_ipfilter/solver/condensed.h"
#include "tao_ipfilter/solver/constants.h"
#include "tao_ipfilter/solver/linear.h"
#include "tao_ipfilter/solver/matrices.h"
#include "tao_ipfilter/solver/options.h"
#include "tao_ipfilter/solver/record.h"
#include "tao_ipfilter/solver/relaxation.h"
#include <petsc/private/kspimpl.h>

/* Context of the convergence test: the KSP's own test, and data to detect stagnation */
typedef struct {
  PetscErrorCode (*test)(KSP, PetscInt, PetscReal, KSPConvergedReason *, void *);
  PetscErrorCode (*destroy)(void *);
  void     *ctx;
  PetscReal close;   /* residual below which stagnation is tested */
  PetscReal least;   /* residual when the last tenfold reduction was complete */
  PetscInt  reached; /* iteration at which that happened */
} StallTest;

/* Records a linear solve and its number of iterations */
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

/*
   Returns the iteration limit of the next solve: ten times the iterations of the longest successful solve, but not more
   than `given`. With an indefinite matrix a Krylov method may iterate long without meeting p^T A p < 0. Reaching the
   limit is taken as a sign of such a matrix.
*/
static PetscInt KrylovLimit(const TAO_IPFILTER *ip, PetscInt given)
{
  const PetscInt factor = 10;

  return ip->lin->longest ? PetscMin(given, PetscMax(IP_MANY_ITERATIONS, factor * ip->lin->longest)) : given;
}

/*
   Tests convergence by the KSP's own test. In addition it ends a solve that, near its end, did not reduce the residual
   tenfold in 25 iterations.
*/
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

/* Calls IPGuardedSolve() with KrylovTestStalled() as convergence test */
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

/*
   Leaves the choice of the norm to a KSP whose type, such as MINRES, or whose side of the preconditioner does not
   support that of the true residual. IPResidualMeasure() computes it after the solve.
*/
static PetscErrorCode KrylovChooseNorm(KSP ksp)
{
  PetscInt supported = 0;

  PetscFunctionBegin;
  if (ksp->normtype_set != KSP_NORM_UNPRECONDITIONED) PetscFunctionReturn(0);
  for (PetscInt side = 0; side < PC_SIDE_MAX; side++)
    if (ksp->pc_side_set == PC_SIDE_DEFAULT || side == (PetscInt)ksp->pc_side_set)
      supported = PetscMax(supported, ksp->normsupporttable[KSP_NORM_UNPRECONDITIONED][side]);
  if (!supported) PetscCall(KSPSetNormType(ksp, KSP_NORM_DEFAULT));
  PetscFunctionReturn(0);
}

/*
   Sets the tolerances with which the residual reaches ip->lin->target. If the KSP computes another norm than that of
   the true residual, the same reduction of b is asked for.
*/
static PetscErrorCode KrylovSetTolerances(Tao tao, KSP ksp, Vec b, PetscReal dtol)
{
  TAO_IPFILTER   *ip    = (TAO_IPFILTER *)tao->data;
  const PetscReal least = PETSC_MACHINE_EPSILON;
  KSPNormType     type;
  PetscReal       size;

  PetscFunctionBegin;
  PetscCall(KSPGetNormType(ksp, &type));
  if (type == KSP_NORM_UNPRECONDITIONED) PetscCall(KSPSetTolerances(ksp, least, ip->lin->target, dtol, ip->lin->limit));
  else {
    PetscCall(VecNorm(b, NORM_2, &size));
    PetscCall(KSPSetTolerances(ksp, PetscMax(least, PetscMin(ip->lin->target / size, 0.5)), 0.0, dtol, ip->lin->limit));
  }
  PetscFunctionReturn(0);
}

/*
   Solves A d = b with the KSP once. With adaptive forcing d is the initial guess, and the solve ends at
   ip->lin->target.
*/
static PetscErrorCode KrylovRun(Tao tao, KSP ksp, Vec b, Vec d)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  PetscReal     rtol, abstol, dtol;
  PetscInt      maxits, its;
  PetscBool     guess, direct, failed;

  PetscFunctionBegin;
  PetscCall(KrylovChooseNorm(ksp));
  PetscCall(KSPSetOperators(ksp, ip->cond->A, ip->cond->A));
  PetscCall(KSPGetInitialGuessNonzero(ksp, &guess));
  PetscCall(KSPGetTolerances(ksp, &rtol, &abstol, &dtol, &maxits));
  PetscCall(PetscObjectTypeCompare((PetscObject)ksp, KSPPREONLY, &direct)); /* PREONLY accepts no initial guess */
  ip->lin->limit = maxits;
  if (ip->opt->forcing == IP_FORCING_ADAPTIVE) {
    ip->lin->limit = KrylovLimit(ip, maxits);
    PetscCall(KSPSetInitialGuessNonzero(ksp, direct ? PETSC_FALSE : PETSC_TRUE));
    PetscCall(KrylovSetTolerances(tao, ksp, b, dtol));
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
   Solves A e = r for a correction e, like KrylovRun() but with flexible CG in place of CG. If J^T D J is stiff, it
   amplifies rounding errors in the result of PCAMGF. These errors do not decrease relative to the residual. The
   preconditioner is then not exactly linear, and the recurrence of CG fails. Flexible CG works, but does not detect
   negative curvature.
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

/*
   Sets the initial guess d to zero if its residual is so large that the KSP would report divergence. A guess with a
   larger residual than zero has is allowed, since the filter or the first iterations may correct it.
*/
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

/* Finds whether the set-up of the PC failed because of a zero pivot on any rank */
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

/* Finds whether J^T D J is so much larger than the Hessian that rounding may have changed the signs of pivots */
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

/*
   Finds whether the factors of A, or of the matrix on PCAMGF's filtered subspace, have negative pivots. The latter
   matrix is a principal submatrix of A. A Krylov method that converges in few iterations might not notice an indefinite
   matrix.
*/
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
  PetscCall(PCAMGFGetFactored(pc, &factored));
  if (!factored && !ip->lin->filtered) PetscFunctionReturn(0);
  PetscCall(KrylovDrowned(tao, &drowned));
  if (drowned) PetscFunctionReturn(0);
  PetscCall(PCAMGFGetFilterPivots(pc, &negative));
  *indefinite = (PetscBool)(negative > 0);
  PetscFunctionReturn(0);
}

/* Solves A d = b by the KSP, with iterative refinement, and judges the result */
PetscErrorCode IPKrylovSolve(Tao tao, Vec b, Vec d, IPLinearVerdict *verdict)
{
  TAO_IPFILTER      *ip = (TAO_IPFILTER *)tao->data;
  KSPConvergedReason reason;
  PetscInt           its;
  PetscBool          direct, zero = PETSC_FALSE;

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
  if (IPResidualReached(ip, reason)) *verdict = IP_LINEAR_SOLVED;
  else *verdict = reason == KSP_DIVERGED_INDEFINITE_MAT || zero ? IP_LINEAR_INDEFINITE : IP_LINEAR_FAILED;
  if (*verdict == IP_LINEAR_SOLVED) {
    ip->lin->longest = PetscMax(ip->lin->longest, its);
    ip->lin->ndirect = 0;
  } else
    PetscCall(PetscInfo(tao,
      "Linear solver stopped with %s after %" PetscInt_FMT " iterations, ||b - A d|| = %g, allowed %g, ||b|| = %g\n",
      KSPConvergedReasons[reason], its, (double)ip->lin->norm, (double)ip->lin->target, (double)ip->lin->rhs));
  /* A failed factorization must not be reused. */
  if (reason == KSP_DIVERGED_PC_FAILED) PetscCall(IPKSPReset(tao->ksp));
  PetscFunctionReturn(0);
}
