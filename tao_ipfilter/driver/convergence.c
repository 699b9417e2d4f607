/* Convergence test: decides when the iteration ends, and with which reason */
#include "driverimpl.h"
#include "tao_ipfilter/solver/barrier.h"
#include "tao_ipfilter/solver/constants.h"
#include "tao_ipfilter/solver/kkt.h"
#include "tao_ipfilter/solver/method.h"
#include "tao_ipfilter/solver/options.h"
#include "tao_ipfilter/solver/record.h"
#include "tao_ipfilter/solver/relaxation.h"
#include "tao_ipfilter/solver/search.h"
#include "tao_ipfilter/solver/sizes.h"
#include "tao_ipfilter/solver/stiffness.h"
#include "tao_ipfilter/solver/terms.h"

/*
   Ends the solve at the start if the gradient is zero and no constraint is violated: the point is then stationary with
   zero multipliers. It is tested before the iteration, since no error scale can be derived from such a point.
*/
PetscErrorCode IPTestFirstPoint(Tao tao)
{
  TAO_IPFILTER *ip        = (TAO_IPFILTER *)tao->data;
  PetscReal     violation = 0.0;

  PetscFunctionBegin;
  if (ip->mi) {
    PetscCall(IPSlackViolation(tao, ip->at.c, ip->rc));
    PetscCall(VecNorm(ip->rc, NORM_INFINITY, &violation));
  }
  if (ip->first->gradient > 0.0 || ip->first->equality > 0.0 || violation > 0.0 || ip->terms->given)
    PetscFunctionReturn(0);
  if (ip->mi) PetscCall(VecCopy(ip->at.c, ip->at.s));
  for (PetscInt b = 0; b < IP_NPAIRS; b++)
    if (ip->at.z[b]) PetscCall(VecSet(ip->at.z[b], 0.0));
  ip->mu = 0.0;
  PetscCall(PetscMemzero(ip->kkt, sizeof(*ip->kkt)));
  PetscCall(IPSetMultipliers(tao));
  PetscCall(
    IPSetReason(tao, TAO_CONVERGED_GATOL, "converged: the starting point is stationary and meets all constraints"));
  PetscFunctionReturn(0);
}

/* Returns whether the violation is significant compared with the constraints' first values, which do not grow with x */
static PetscBool Violated(const TAO_IPFILTER *ip)
{
  const PetscReal small = 1e-3;

  return (PetscBool)(ip->kkt->violation > small);
}

/*
   Returns whether the violation is also at most `limit` relative to the constraints' own terms (row_violation.c). A
   relaxation violates constraints whose terms vanish by more.
*/
static PetscBool OwnMet(const TAO_IPFILTER *ip, PetscReal limit)
{
  return (PetscBool)(ip->kkt->own <= PetscMax(ip->relax->times ? IP_ACCEPTABLE_TOL : limit, ip->tol));
}

/* Returns whether both measures of the KKT error are within the tolerance */
static PetscBool Converged(const TAO_IPFILTER *ip)
{
  return (PetscBool)(IPBothErrors(ip) <= ip->tol && OwnMet(ip, ip->tol));
}

/* Returns whether both measures of the KKT error are within the acceptable tolerance */
PetscBool IPAcceptable(const TAO_IPFILTER *ip)
{
  return (PetscBool)(IPBothErrors(ip) <= IP_ACCEPTABLE_TOL && OwnMet(ip, IP_ACCEPTABLE_TOL));
}

/* Computes the size of the unknowns with which steps are compared: at least a small fraction of the first size */
static PetscErrorCode UnknownsSize(Tao tao, PetscReal *size)
{
  const PetscReal vanishing = 1e-3;

  PetscFunctionBegin;
  PetscCall(VecNorm(tao->solution, NORM_INFINITY, size));
  *size = PetscMax(*size, vanishing * ((TAO_IPFILTER *)tao->data)->first->x);
  PetscFunctionReturn(0);
}

/*
   Counts consecutive steps that are as small as rounding errors of x. A step that halves the KKT error is not counted:
   it may change small unknowns and slacks beside a large unknown.
*/
static PetscErrorCode CountTinySteps(Tao tao)
{
  TAO_IPFILTER   *ip     = (TAO_IPFILTER *)tao->data;
  const PetscReal useful = 0.5, error = IPBothErrors(ip);
  PetscReal       size;
  PetscBool       tiny;

  PetscFunctionBegin;
  PetscCall(UnknownsSize(tao, &size));
  tiny                = (PetscBool)(tao->niter && ip->search->tag != 'R' && ip->dir.norm <= IP_TINY_STEP * size);
  ip->rec->ntiny      = tiny && error > useful * ip->rec->last_error ? ip->rec->ntiny + 1 : 0;
  ip->rec->last_error = error;
  PetscFunctionReturn(0);
}

/*
   Ends the iteration, since the KKT error is within the tolerance. The reason is `acceptable` or a failure if the
   relaxation of the constraints changes the objective by more than the tolerance.
*/
static PetscErrorCode Converge(Tao tao)
{
  TAO_IPFILTER   *ip          = (TAO_IPFILTER *)tao->data;
  const PetscReal trace       = 1e-3;
  PetscReal       work        = 0.0;
  char            relaxed[64] = "";

  PetscFunctionBegin;
  PetscCall(IPErrorBoundOfRelaxation(tao, &work));
  if (ip->relax->times)
    PetscCall(PetscSNPrintf(relaxed, sizeof(relaxed), ", with constraints relaxed by %g", (double)ip->relax->told));
  if (work > ip->tol) {
    const PetscReal share = IPErrorBoundOfWork(ip, work) / IPDegenerateObjective(ip);

    PetscCall(IPSetReason(tao, share <= trace ? TAO_CONVERGED_STEPTOL : TAO_DIVERGED_USER,
      "%s: KKT error %g%s, because they have no interior; the relaxation changes the objective by %g times the "
      "tolerance",
      share <= trace ? "acceptable" : "no solution", (double)ip->kkt->error, relaxed, (double)(work / ip->tol)));
  } else
    PetscCall(IPSetReason(tao, TAO_CONVERGED_GATOL, "converged: KKT error %g is within %g%s", (double)ip->kkt->error,
      (double)ip->tol, relaxed));
  PetscFunctionReturn(0);
}

/*
   Finds whether the iterate may be far from the solution although the error is small relative to a first value. This is
   the case if the error bound exceeds the present objective, the residuals exceed the tolerance in the caller's units,
   and the last step shows that Newton's method has not converged: it changed the unknowns or the objective noticeably,
   was shortened, or was limited by a shift of the Hessian. In a curved valley all of these occur. After several
   consecutive iterates without a lower objective the answer is no.
*/
static PetscErrorCode ObserveFall(Tao tao)
{
  TAO_IPFILTER   *ip    = (TAO_IPFILTER *)tao->data;
  IPRecord       *rec   = ip->rec;
  const PetscReal trace = 1e-6, rounding = 1e-3 * PETSC_MACHINE_EPSILON, f = ip->at.f;
  const PetscBool shifted  = (PetscBool)(ip->shift->delta > 0.0);
  const PetscInt  patience = 40;
  const PetscReal tol      = Converged(ip) ? ip->tol : IP_ACCEPTABLE_TOL;
  const PetscReal some     = PetscMax(trace * PetscAbsReal(f), rounding * ip->scale->terms);
  const PetscBool open     = (PetscBool)(IPAcceptable(ip) && tao->niter && !ip->method->on &&
                                     !IPErrorBoundWithinPresent(ip, tol) && ip->kkt->unscaled > ip->tol);
  PetscReal       size;
  PetscBool       cut;

  PetscFunctionBegin;
  PetscCall(UnknownsSize(tao, &size));
  cut = (PetscBool)(ip->search->alpha < 1.0 || PetscAbsReal(rec->before - f) > some || ip->dir.norm > trace * size);
  cut = (PetscBool)(shifted || (!rec->ntiny && cut));
  rec->nidle  = open && cut && f > rec->lowest - some ? rec->nidle + 1 : 0;
  rec->falls  = (PetscBool)(open && cut && rec->nidle < patience);
  rec->lowest = rec->nidle ? PetscMin(rec->lowest, f) : f;
  rec->before = f;
  PetscFunctionReturn(0);
}

/* Records whether the last step was as small as rounding errors, and whether the objective may still fall noticeably */
PetscErrorCode IPObserveStep(Tao tao)
{
  PetscFunctionBegin;
  PetscCall(CountTinySteps(tao));
  PetscCall(ObserveFall(tao));
  PetscFunctionReturn(0);
}

/*
   Returns whether another iteration is to refine an iterate that has converged. Where the objective has fallen to a
   small fraction of its first value, an error that is negligible relative to the first value may exceed the objective.
   Refinement ends when an iteration does not halve the error bound, and Newton's method has converged. Without a
   complementarity gap it leaves residuals of the size of rounding errors, which no iteration reduces.
*/
PetscBool IPRefines(TAO_IPFILTER *ip)
{
  const PetscInt  most  = 4;
  const PetscReal halve = 0.5, before = ip->rec->last_bound, rounding = 1e-13;
  PetscBool       gap = PETSC_FALSE;

  for (PetscInt b = 0; b < IP_NPAIRS; b++) gap = (PetscBool)(gap || ip->pair[b].n);
  ip->rec->last_bound = ip->kkt->bound;
  if (ip->rec->falls) {
    ip->rec->nrefined = 1;
    return PETSC_TRUE;
  }
  if (ip->method->on || IPErrorBoundRefined(ip) || (!gap && ip->kkt->error <= rounding)) return PETSC_FALSE;
  if (ip->rec->nrefined && ip->kkt->bound > halve * before) return PETSC_FALSE;
  return (PetscBool)(ip->rec->nrefined++ < most);
}

/* If refinement failed after an iterate had converged, gives the best iterate, which is present again, its reason */
PetscErrorCode IPConvergeRefined(Tao tao)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  if (ip->rec->nrefined && !ip->rec->best_falls && tao->reason != TAO_CONVERGED_GATOL && Converged(ip) &&
      IPConstraintsMet(tao))
    PetscCall(Converge(tao));
  PetscFunctionReturn(0);
}

/*
   Finds whether the gradient is zero and no constraint is violated. If so, the multipliers are set to zero, which makes
   the point stationary, and the residuals are computed again.
*/
static PetscErrorCode TestWithoutMultipliers(Tao tao, PetscBool *stationary)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  PetscReal     gradient;

  PetscFunctionBegin;
  PetscCall(VecNorm(tao->gradient, NORM_INFINITY, &gradient));
  *stationary = (PetscBool)(gradient == 0.0 && !ip->terms->n && ip->kkt->primal <= ip->tol && ip->kkt->own <= ip->tol &&
                            !ip->relax->times);
  if (!*stationary) PetscFunctionReturn(0);
  for (PetscInt b = 0; b < IP_NPAIRS; b++)
    if (ip->at.z[b]) PetscCall(VecSet(ip->at.z[b], 0.0));
  if (ip->mi) {
    PetscCall(VecSet(ip->at.lambda, 0.0));
    PetscCall(VecCopy(ip->at.c, ip->at.s));
  }
  if (ip->me) PetscCall(VecSet(ip->at.y, 0.0));
  PetscCall(IPComputeKKT(tao));
  PetscFunctionReturn(0);
}

/* Ends the iteration if a residual or the objective is NaN or infinite */
PetscErrorCode IPTestNumbers(Tao tao)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  if (IPUndefined(ip->kkt->error) || IPUndefined(ip->at.f))
    PetscCall(IPSetReason(tao, TAO_DIVERGED_NAN,
      "the objective or a residual is not a number at iteration %" PetscInt_FMT, tao->niter));
  PetscFunctionReturn(0);
}

/*
   Returns whether the tolerances of TaoSetConstraintTolerances() are met: catol for the largest violation, crtol for
   the relative one. As everywhere in TAO, 0 means that there is no tolerance.
*/
PetscBool IPConstraintsMet(Tao tao)
{
  const IPKKT *k = ((TAO_IPFILTER *)tao->data)->kkt;

  return (PetscBool)((k->inf_pr <= tao->catol || tao->catol == 0.0) && (k->primal <= tao->crtol || tao->crtol == 0.0));
}

/*@C
  TaoIPFilterDefaultConvergenceTest - Default convergence test of `TAOIPFILTER`

  Collective

  Input Parameters:
+ tao - the `TAOIPFILTER`
- ctx - unused

  Level: advanced

  Notes:
  Converged, with `TAO_CONVERGED_GATOL`, means that the KKT error is at most gatol of `TaoSetTolerances()`, and that the
  violation of the constraints is within the tolerances of `TaoSetConstraintTolerances()`, if these were set. The test
  also ends a solve that makes no further progress. `TaoSetConvergenceTest()` replaces it; the caller's own test may
  call this function.

  Independently of the test, the solve ends if a residual or the objective is NaN, if steps are as small as rounding
  errors, and at the limits of `TaoSetMaximumIterations()` and `TaoSetMaximumFunctionEvaluations()`.

.seealso: `TAOIPFILTER`, `TaoSetConvergenceTest()`, `TaoSetTolerances()`, `TaoSetConstraintTolerances()`,
          `TaoIPFilterGetReason()`
@*/
PetscErrorCode TaoIPFilterDefaultConvergenceTest(Tao tao, void *ctx)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  const IPKKT  *k  = ip->kkt;
  PetscBool     own, stationary = PETSC_FALSE, fritz_john, unbounded;
  PetscReal     lowest, fmin;

  PetscFunctionBegin;
  (void)ctx;
  PetscValidHeaderSpecific(tao, TAO_CLASSID, 1);
  PetscCall(PetscObjectTypeCompare((PetscObject)tao, TAOIPFILTER, &own));
  PetscCheck(own, PetscObjectComm((PetscObject)tao), PETSC_ERR_ARG_WRONG,
    "The convergence test of TAOIPFILTER cannot be used by a solver of type %s", ((PetscObject)tao)->type_name);
  PetscCall(TaoGetFunctionLowerBound(tao, &fmin));
  if (!Converged(ip)) PetscCall(TestWithoutMultipliers(tao, &stationary));
  PetscCall(IPDegenerateFritzJohn(tao, &fritz_john));
  PetscCall(IPTestUnbounded(tao, &lowest, &unbounded));
  if (stationary) {
    PetscCall(IPSetReason(tao, TAO_CONVERGED_GATOL,
      "converged: the gradient of the objective is zero, and the constraints are met"));
  } else if (Converged(ip) && IPConstraintsMet(tao)) {
    PetscCall(Converge(tao));
  } else if (fritz_john && OwnMet(ip, IP_ACCEPTABLE_TOL) && IPConstraintsMet(tao)) {
    const PetscBool acceptable = (PetscBool)(IPBothErrors(ip) <= IP_ACCEPTABLE_TOL);

    PetscCall(IPSetReason(tao, acceptable ? TAO_CONVERGED_STEPTOL : TAO_DIVERGED_USER,
      "%s: KKT error %g; gradients of the constraints vanish where the constraints are met, and the multipliers grow "
      "without limit: bounded multipliers may not exist",
      acceptable ? "acceptable" : "no multipliers", (double)IPBothErrors(ip)));
  } else if (ip->at.f <= fmin && k->primal <= ip->tol) {
    PetscCall(IPSetReason(tao, TAO_CONVERGED_MINF,
      "converged: the point is feasible and its objective %g is below the given minimum %g", (double)ip->at.f,
      (double)fmin));
  } else if (unbounded) {
    PetscCall(IPSetUnbounded(tao, lowest));
  } else if (ip->rec->nacceptable >= IP_ACCEPTABLE_IT && IPConstraintsMet(tao)) {
    PetscCall(IPSetReason(tao, TAO_CONVERGED_STEPTOL,
      "acceptable: KKT error %g stayed below %g, but did not reach the tolerance %g", (double)IPBothErrors(ip),
      (double)IP_ACCEPTABLE_TOL, (double)ip->tol));
  }
  PetscFunctionReturn(0);
}

/*
   Ends the iteration if a limit of iterations or evaluations is reached, or if several steps were as small as rounding
   errors
*/
PetscErrorCode IPTestLimits(Tao tao)
{
  TAO_IPFILTER   *ip       = (TAO_IPFILTER *)tao->data;
  const IPKKT    *k        = ip->kkt;
  const PetscReal error    = IPBothErrors(ip);
  const PetscInt  max_tiny = 3;
  PetscInt        nfuncs, max_it, max_funcs;

  PetscFunctionBegin;
  PetscCall(TaoGetMaximumIterations(tao, &max_it));
  PetscCall(TaoGetMaximumFunctionEvaluations(tao, &max_funcs));
  PetscCall(TaoGetCurrentFunctionEvaluations(tao, &nfuncs));
  if (ip->rec->ntiny >= max_tiny) {
    if (!IPConstraintsMet(tao))
      PetscCall(IPSetReason(tao, TAO_DIVERGED_LS_FAILURE,
        "steps are as small as rounding errors at KKT error %g, but the constraint violation %g (relative %g) exceeds "
        "catol %g or crtol %g",
        (double)error, (double)k->inf_pr, (double)k->primal, (double)tao->catol, (double)tao->crtol));
    else if (IPAcceptable(ip) && !ip->rec->falls)
      PetscCall(IPSetReason(tao, TAO_CONVERGED_STEPTOL,
        "acceptable: steps are as small as rounding errors at KKT error %g; the tolerance is %g", (double)error,
        (double)ip->tol));
    else if (Violated(ip))
      PetscCall(IPSetReason(tao, TAO_DIVERGED_LS_FAILURE,
        "steps are as small as rounding errors at constraint violation %g", (double)k->inf_pr));
    else
      PetscCall(IPSetReason(tao, TAO_DIVERGED_LS_FAILURE,
        "steps are as small as rounding errors at KKT error %g: multipliers may not exist", (double)error));
  } else if (tao->niter - ip->rec->ndirections >= max_it) {
    PetscCall(IPSetReason(tao, TAO_DIVERGED_MAXITS, "iteration limit %" PetscInt_FMT " reached with KKT error %g",
      max_it, (double)error));
  } else if (max_funcs >= 0 && nfuncs > max_funcs) {
    PetscCall(IPSetReason(tao, TAO_DIVERGED_MAXFCN,
      "limit of %" PetscInt_FMT " function evaluations reached with KKT error %g", max_funcs, (double)error));
  }
  PetscFunctionReturn(0);
}

/* Calls the convergence test (the caller's or the default one), and then tests the limits */
PetscErrorCode IPTestConvergence(Tao tao)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  ip->rec->nacceptable = IPAcceptable(ip) && !ip->rec->falls ? ip->rec->nacceptable + 1 : 0;
  PetscUseTypeMethod(tao, convergencetest, tao->cnvP);
  if (tao->reason == TAO_CONTINUE_ITERATING) PetscCall(IPTestLimits(tao));
  else if (!ip->rec->reason[0])
    PetscCall(
      IPSetReason(tao, tao->reason, "the test set by TaoSetConvergenceTest() ended the solve with %s, at KKT error %g",
        TaoConvergedReasons[tao->reason], (double)ip->kkt->error));
  PetscFunctionReturn(0);
}
