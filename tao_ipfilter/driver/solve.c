/* The main iteration of TaoSolve() */
#include "driverimpl.h"
#include "tao_ipfilter/solver/barrier.h"
#include "tao_ipfilter/solver/constants.h"
#include "tao_ipfilter/solver/kkt.h"
#include "tao_ipfilter/solver/linear.h"
#include "tao_ipfilter/solver/matrices.h"
#include "tao_ipfilter/solver/method.h"
#include "tao_ipfilter/solver/options.h"
#include "tao_ipfilter/solver/record.h"
#include "tao_ipfilter/solver/relaxation.h"
#include "tao_ipfilter/solver/search.h"
#include "tao_ipfilter/solver/sizes.h"
#include "tao_ipfilter/solver/stiffness.h"
#include "tao_ipfilter/solver/terms.h"

/* Resets the state of the last solve, but keeps what can be reused: matrices, work vectors, memory of the record */
static PetscErrorCode ResetSolve(Tao tao)
{
  TAO_IPFILTER *ip  = (TAO_IPFILTER *)tao->data;
  IPRecord     *rec = ip->rec;

  PetscFunctionBegin;
  *rec             = (IPRecord){.max_nksp = rec->max_nksp,
                .ksp_iterations           = rec->ksp_iterations,
                .best_error               = PETSC_INFINITY,
                .best_violation           = PETSC_INFINITY,
                .lowest                   = PETSC_INFINITY};
  *ip->lin         = (IPLinear){.flexible = ip->lin->flexible, .residual = ip->lin->residual};
  *ip->bar         = (IPBarrier){.free = (PetscBool)(ip->opt->barrier == IP_BARRIER_MEHROTRA)};
  *ip->search      = (IPSearch){.theta0 = -1.0, .tag = ' ', .slow = ip->search->slow};
  *ip->watch       = (IPWatchdog){.left = 0};
  *ip->relax       = (IPRelaxation){.least_slack = PETSC_INFINITY, .least_bound = PETSC_INFINITY};
  *ip->shift       = (IPShift){.delta = 0.0};
  *ip->first       = (IPFirst){.f = 0.0, .energy = -1.0};
  ip->dir.norm     = 0.0;
  tao->ksp_its     = 0;
  tao->ksp_tot_its = 0;
  tao->reason      = TAO_CONTINUE_ITERATING;
  PetscCall(IPFilterSetReset(ip->filter));
  PetscFunctionReturn(0);
}

/*
   Returns whether the present iterate is better than the best one. It is if its violation is smaller, or if both
   violations are within the tolerance and its objective is not larger. If one of the two iterates is acceptable, or the
   objective does not contain all energy, the KKT errors are compared. If both are equally good, the present one is
   better.
*/
static PetscBool BetterThanBest(const TAO_IPFILTER *ip)
{
  const PetscBool acceptable = (PetscBool)(IPBothErrors(ip) <= IP_ACCEPTABLE_TOL);
  const PetscReal violation = PetscMax(ip->kkt->violation, ip->tol), best = PetscMax(ip->rec->best_violation, ip->tol),
                  same = 1.01;

  if (acceptable || ip->rec->best_error <= IP_ACCEPTABLE_TOL)
    return (PetscBool)(acceptable && (ip->rec->falls || IPBothErrors(ip) <= same * ip->rec->best_error));
  if (IPNeedsMethod(ip))
    return (PetscBool)(violation < best || (violation == best && IPBothErrors(ip) <= same * ip->rec->best_error));
  return (PetscBool)(violation < best || (violation == best && ip->at.f <= ip->best.f));
}

/* Stores the current iterate as the best one if it is better */
static PetscErrorCode KeepBest(Tao tao)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  if (!BetterThanBest(ip)) PetscFunctionReturn(0);
  ip->rec->best_error     = IPBothErrors(ip);
  ip->rec->best_violation = ip->kkt->violation;
  ip->rec->best_falls     = ip->rec->falls;
  PetscCall(IPIterateCopy(&ip->at, &ip->best));
  if (ip->terms->n) PetscCall(VecCopy(ip->terms->force, ip->terms->best));
  PetscFunctionReturn(0);
}

/* Returns to the best iterate if it is better than the last one. A last iterate that met a convergence test is kept. */
static PetscErrorCode RestoreBest(Tao tao)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  if (ip->rec->best_error == PETSC_INFINITY || BetterThanBest(ip) || IPBothErrors(ip) == ip->rec->best_error)
    PetscFunctionReturn(0);
  if (tao->reason > 0 && tao->reason != TAO_CONVERGED_STEPTOL) PetscFunctionReturn(0);
  PetscCall(IPIterateCopy(&ip->best, &ip->at));
  if (ip->terms->n) PetscCall(VecCopy(ip->terms->best, ip->terms->force));
  PetscCall(IPEvaluateConstraints(tao, tao->solution, ip->at.c, ip->at.ce));
  PetscCall(IPBoundsDistance(tao, tao->solution, PETSC_FALSE));
  PetscCall(IPSlackDistance(tao, ip->at.s, PETSC_FALSE));
  PetscCall(IPEvaluateDerivatives(tao));
  PetscCall(IPComputeKKT(tao));
  PetscFunctionReturn(0);
}

/* Computes the KKT error of the new iterate, records it, and calls the monitors and the convergence test */
static PetscErrorCode AssessIterate(Tao tao)
{
  TAO_IPFILTER *ip   = (TAO_IPFILTER *)tao->data;
  PetscBool     left = PETSC_FALSE;

  PetscFunctionBegin;
  PetscCall(IPComputeKKT(tao));
  PetscCall(IPTestNumbers(tao));
  if (tao->reason == TAO_DIVERGED_NAN) PetscFunctionReturn(0);
  PetscCall(IPObserveStep(tao));
  PetscCall(KeepBest(tao));
  PetscCall(IPSetMultipliers(tao));
  PetscCall(TaoLogConvergenceHistory(tao, ip->at.f, ip->kkt->error, ip->kkt->inf_pr, tao->ksp_tot_its));
  PetscCall(IPMonitor(tao));
  PetscCall(TaoMonitor(tao, tao->niter, ip->at.f, ip->kkt->error, ip->kkt->inf_pr, ip->search->alpha));
  PetscCall(IPTestConvergence(tao));
  if (!ip->rec->nrefined && (tao->reason == TAO_CONVERGED_GATOL || tao->reason == TAO_CONVERGED_STEPTOL))
    PetscCall(IPLeaveSaddle(tao, &left));
  if (left) ip->search->tag = 'R';
  if (left || (tao->reason == TAO_CONVERGED_GATOL && IPRefines(ip))) {
    tao->reason        = TAO_CONTINUE_ITERATING;
    ip->rec->reason[0] = '\0';
    if (!left) PetscCall(IPTestLimits(tao));
  }
  PetscFunctionReturn(0);
}

/* Ends the solve because no solver gave a direction */
static PetscErrorCode EndLinear(Tao tao)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  /* without any direction the residual is the right-hand side */
  const PetscReal residual = IPUndefined(ip->lin->norm) ? ip->lin->rhs : ip->lin->norm;

  PetscFunctionBegin;
  PetscCall(IPSetReason(tao, TAO_DIVERGED_USER, "linear solver failed: %s, ||b - A d|| = %g for ||b|| = %g%s%s",
    KSPConvergedReasons[ip->lin->reason], (double)residual, (double)ip->lin->rhs, ip->lin->why[0] ? "; " : "",
    ip->lin->why));
  PetscFunctionReturn(0);
}

/*
   Ends the solve because restoration, or all fallbacks before it, failed. solved: a direction was found; violated:
   constraints are violated; infeasible: the violation has a local minimum.
*/
static PetscErrorCode EndUnrestored(Tao tao, PetscBool solved, PetscBool violated, PetscBool infeasible)
{
  TAO_IPFILTER *ip        = (TAO_IPFILTER *)tao->data;
  PetscBool     unbounded = PETSC_FALSE;
  PetscReal     lowest;

  PetscFunctionBegin;
  PetscCall(IPTestNumbers(tao));
  if (tao->reason == TAO_DIVERGED_NAN) PetscFunctionReturn(0);
  if (solved && !infeasible && !violated) PetscCall(IPTestUnboundedRays(tao, &lowest, &unbounded));
  if (solved && ip->search->ntrials && !ip->search->ndefined)
    PetscCall(IPSetReason(tao, TAO_DIVERGED_NAN,
      "the objective or a constraint is not a number at all points that were tried after iteration %" PetscInt_FMT
      ", at KKT error %g",
      tao->niter, (double)IPBothErrors(ip)));
  else if (infeasible)
    PetscCall(IPSetReason(tao, TAO_DIVERGED_LS_FAILURE,
      "the constraints seem infeasible: their violation has a local minimum of %g", (double)ip->kkt->inf_pr));
  else if (!solved && ip->lin->failed) PetscCall(EndLinear(tao));
  else if (!solved)
    PetscCall(IPSetReason(tao, TAO_DIVERGED_USER,
      "no direction with enough curvature was found with the Hessian shifted by up to %g; last result of the linear "
      "solver: %s",
      (double)ip->shift->delta, KSPConvergedReasons[ip->lin->reason]));
  else if (violated)
    PetscCall(IPSetReason(tao, TAO_DIVERGED_LS_FAILURE, "no step reduces the constraint violation %g any further",
      (double)ip->kkt->inf_pr));
  else if (unbounded) PetscCall(IPSetUnbounded(tao, lowest));
  else
    PetscCall(
      IPSetReason(tao, TAO_DIVERGED_LS_FAILURE, "line search failed at KKT error %g", (double)IPBothErrors(ip)));
  PetscFunctionReturn(0);
}

/* Returns whether constraints are violated by more than the tolerance, relative to all constraints or to the terms of
   one */
static PetscBool StillViolated(const TAO_IPFILTER *ip)
{
  return (PetscBool)(ip->kkt->primal > ip->tol || ip->kkt->own > PetscMax(ip->tol, IP_ACCEPTABLE_TOL));
}

/* Ends the solve if the present iterate is acceptable. solved: a direction was found */
static PetscErrorCode AcceptIfGoodEnough(Tao tao, PetscBool solved)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  if (IPAcceptable(ip) && !ip->rec->falls && IPConstraintsMet(tao) && !(solved && ip->bar->free))
    PetscCall(IPSetReason(tao, TAO_CONVERGED_STEPTOL,
      "acceptable: no step reduces the KKT error %g further; the tolerance is %g", (double)IPBothErrors(ip),
      (double)ip->tol));
  PetscFunctionReturn(0);
}

/*
   Handles a step for which no direction was found (solved: false) or no step length. The fallbacks are, in this order:
   use the monotone rule for mu for some iterations; reduce the violation alone (restoration).
*/
static PetscErrorCode Recover(Tao tao, PetscBool solved)
{
  TAO_IPFILTER   *ip         = (TAO_IPFILTER *)tao->data;
  const PetscInt  iterations = 10;
  const PetscBool violated   = StillViolated(ip);
  PetscBool       ok = PETSC_FALSE, infeasible = PETSC_FALSE;

  PetscFunctionBegin;
  if (!violated) PetscCall(AcceptIfGoodEnough(tao, solved));
  if (tao->reason != TAO_CONTINUE_ITERATING) PetscFunctionReturn(0);
  if (!solved && ip->lin->failed) {
    PetscCall(EndLinear(tao));
    PetscFunctionReturn(0);
  }
  if (ip->bar->free) {
    PetscCall(IPBarrierHold(tao, iterations));
    PetscFunctionReturn(0);
  }
  if (violated) {
    PetscCall(IPMeritMeasure(tao)); /* measured by the line search only if there was a direction */
    PetscCall(IPRestore(tao, &ok, &infeasible));
    if (!ok) PetscCall(IPComputeKKT(tao));
    if (!ok) PetscCall(AcceptIfGoodEnough(tao, solved));
    if (tao->reason != TAO_CONTINUE_ITERATING) PetscFunctionReturn(0);
  }
  if (ok) {
    ip->search->tag = 'R';
    tao->niter++;
  } else PetscCall(EndUnrestored(tao, solved, violated, infeasible));
  PetscFunctionReturn(0);
}

/*
   Estimates the multipliers of equality constraints again if their forces are much larger than the gradient that they
   balance. This happens for constraints that cannot be satisfied; the multipliers would dominate the Hessian.
*/
static PetscErrorCode RenewMultipliers(Tao tao)
{
  TAO_IPFILTER   *ip   = (TAO_IPFILTER *)tao->data;
  const PetscReal huge = 1e8;
  PetscReal       force, gradient;
  Vec             v;

  PetscFunctionBegin;
  if (!ip->me) PetscFunctionReturn(0);
  PetscCall(IPGetWork(tao, IP_UNKNOWNS, &v));
  PetscCall(MatMultTranspose(ip->jac->equality, ip->at.y, v));
  PetscCall(VecNorm(v, NORM_2, &force));
  PetscCall(IPRestoreWork(tao, IP_UNKNOWNS, &v));
  PetscCall(VecNorm(tao->gradient, NORM_2, &gradient));
  if (force <= huge * PetscMax(gradient, ip->first->gradient)) PetscFunctionReturn(0);
  PetscCall(IPEqualityMultipliers(tao));
  PetscCall(IPSetMultipliers(tao));
  PetscCall(IPComputeKKT(tao));
  PetscFunctionReturn(0);
}

/*
   Reduces the violation alone if many consecutive steps were shortened to a small fraction and constraints are still
   violated
*/
static PetscErrorCode RestoreIfCut(Tao tao)
{
  TAO_IPFILTER  *ip       = (TAO_IPFILTER *)tao->data;
  const PetscInt patience = 11; /* one more than that of the watchdog, which comes first */
  PetscBool      ok, infeasible;

  PetscFunctionBegin;
  if (ip->search->ncut < patience) PetscFunctionReturn(0);
  ip->search->ncut = 0;
  PetscCall(IPComputeKKT(tao));
  if (!StillViolated(ip)) PetscFunctionReturn(0);
  PetscCall(IPWatchdogEnd(ip->watch));
  PetscCall(IPMeritMeasure(tao));
  PetscCall(IPRestore(tao, &ok, &infeasible));
  if (ok) ip->search->tag = 'R';
  else {
    PetscCall(IPComputeKKT(tao));
    PetscCall(EndUnrestored(tao, PETSC_TRUE, PETSC_TRUE, infeasible));
  }
  PetscFunctionReturn(0);
}

/* Takes one Newton step: Hessian, barrier parameter, direction, line search, derivatives at the new point */
static PetscErrorCode TakeNewtonStep(Tao tao)
{
  PetscBool solved = PETSC_FALSE, ok = PETSC_FALSE;

  PetscFunctionBegin;
  tao->ksp_its = 0;
  PetscCall(RenewMultipliers(tao));
  PetscCall(IPRelax(tao));
  PetscCall(IPBarrierUpdate(tao));
  PetscCall(IPHessianEvaluate(tao));
  PetscCall(IPStiffnessUpdate(tao));
  PetscCall(IPComputeDirection(tao, &solved));
  if (solved) PetscCall(IPLineSearch(tao, &ok));
  if (!ok) PetscCall(IPWatchdogReturn(tao, &ok));
  if (!ok) {
    PetscCall(Recover(tao, solved));
    PetscFunctionReturn(0);
  }
  tao->niter++;
  PetscCall(IPEvaluateDerivatives(tao));
  PetscCall(RestoreIfCut(tao));
  PetscFunctionReturn(0);
}

/* Ends the alternative method (see IPMethodOps) if it is in use */
static PetscErrorCode EndMethod(Tao tao)
{
  IPMethod *method = ((TAO_IPFILTER *)tao->data)->method;

  PetscFunctionBegin;
  if (method->on) PetscCall(method->ops->end(tao));
  method->on = PETSC_FALSE;
  PetscFunctionReturn(0);
}

/* Begins the alternative method if it can solve the problem */
static PetscErrorCode BeginMethod(Tao tao)
{
  IPMethod *method = ((TAO_IPFILTER *)tao->data)->method;
  PetscBool applies;

  PetscFunctionBegin;
  if (!method->ops) PetscFunctionReturn(0);
  PetscCall(method->ops->applies(tao, &applies));
  if (applies) PetscCall(method->ops->begin(tao, &method->on));
  else PetscCall(method->ops->forget(tao));
  PetscFunctionReturn(0);
}

/*
   Changes to the interior point method, since the alternative method made no more progress. The start is the best
   iterate, with its multipliers.
*/
static PetscErrorCode LeaveMethod(Tao tao)
{
  TAO_IPFILTER *ip    = (TAO_IPFILTER *)tao->data;
  const IPGiven given = *ip->given;
  Vec           s = NULL, z = NULL;

  PetscFunctionBegin;
  PetscCall(PetscInfo(tao, "The %s makes no more progress at KKT error %g: the interior point method continues\n",
    ip->method->ops->name, (double)ip->rec->best_error));
  PetscCall(EndMethod(tao));
  ip->rec->fallbacks.subspaces++;
  PetscCall(RestoreBest(tao));
  if (ip->rec->best_error < PETSC_INFINITY && ip->method->multipliers) {
    PetscCall(VecDuplicate(ip->best.s, &s));
    PetscCall(VecDuplicate(ip->best.s, &z));
    PetscCall(VecCopy(ip->best.s, s));
    PetscCall(VecCopy(ip->best.z[IP_SLACK], z));
    PetscCall(IPRowScalePair(tao, s, z, PETSC_TRUE));
    ip->given->warm_s = s;
    ip->given->warm_z = z;
  }
  PetscCall(IPStartPoint(tao));
  *ip->given = given;
  PetscCall(VecDestroy(&s));
  PetscCall(VecDestroy(&z));
  PetscFunctionReturn(0);
}

/* Ends the solve of a problem that only the alternative method can solve, since it cannot begin or makes no progress */
static PetscErrorCode EndMethodOnly(Tao tao)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  if (ip->rec->best_error <= IP_ACCEPTABLE_TOL)
    PetscCall(IPSetReason(tao, TAO_CONVERGED_STEPTOL,
      "acceptable: nothing reduces the KKT error %g further; the tolerance is %g", (double)ip->rec->best_error,
      (double)ip->tol));
  else if (!ip->method->on)
    PetscCall(IPSetReason(tao, TAO_DIVERGED_USER,
      "%s: the method \"%s\", which alone solves such problems, does not begin. It requires a problem without equality "
      "constraints and bounds, constraints that involve few unknowns, and a Hessian that is positive definite on these",
      ip->terms->n ? "friction" : "constraints with compliance", ip->method->ops->name));
  else if (ip->terms->n)
    PetscCall(IPSetReason(tao, TAO_DIVERGED_USER,
      "friction: no equilibrium with stick and slip consistent everywhere was found (KKT error %g)",
      (double)ip->rec->best_error));
  else
    PetscCall(IPSetReason(tao, TAO_DIVERGED_USER,
      "constraints with compliance: no step reduces the KKT error %g further; the tolerance is %g",
      (double)ip->rec->best_error, (double)ip->tol));
  PetscFunctionReturn(0);
}

/* Takes one step of the method in use */
static PetscErrorCode TakeStep(Tao tao)
{
  TAO_IPFILTER *ip   = (TAO_IPFILTER *)tao->data;
  PetscBool     done = PETSC_FALSE;

  PetscFunctionBegin;
  if (ip->method->on) {
    PetscCall(ip->method->ops->step(tao, &done));
    if (!done && IPNeedsMethod(ip)) PetscCall(EndMethodOnly(tao));
    else if (!done) PetscCall(LeaveMethod(tao));
  } else PetscCall(TakeNewtonStep(tao));
  PetscFunctionReturn(0);
}

/* Gets the object states of the caller's Hessian and inequality Jacobian; 0 if there is none */
static PetscErrorCode GetStates(Tao tao, PetscObjectState states[2])
{
  PetscFunctionBegin;
  states[0] = states[1] = 0;
  PetscCall(PetscObjectStateGet((PetscObject)tao->hessian, &states[0]));
  if (((TAO_IPFILTER *)tao->data)->mi)
    PetscCall(PetscObjectStateGet((PetscObject)tao->jacobian_inequality, &states[1]));
  PetscFunctionReturn(0);
}

/*
   Evaluates the starting point. The solve ends there if a value is NaN or infinite (*finite: false), or if the point is
   stationary.
*/
static PetscErrorCode BeginSolve(Tao tao, PetscBool *finite)
{
  TAO_IPFILTER    *ip = (TAO_IPFILTER *)tao->data;
  PetscObjectState before[2], after[2];

  PetscFunctionBegin;
  PetscCall(GetStates(tao, before));
  PetscCall(IPFirstPoint(tao, finite));
  if (!*finite) {
    PetscCall(IPSetReason(tao, TAO_DIVERGED_NAN,
      "the objective, its gradient, a constraint or an unknown is not a number at the starting point"));
    PetscFunctionReturn(0);
  }
  PetscCall(IPSetMultipliers(tao));
  PetscCall(IPTestFirstPoint(tao));
  if (tao->reason != TAO_CONTINUE_ITERATING) PetscFunctionReturn(0);
  PetscCall(IPHessianEvaluate(tao));
  PetscCall(GetStates(tao, after));
  ip->method->linear   = (PetscBool)(before[1] == after[1]);
  ip->method->constant = (PetscBool)(before[0] == after[0] && before[1] == after[1]);
  PetscCall(IPComputeStiffness(tao));
  PetscCall(IPMeasureReach(tao));
  PetscCall(IPEqualityChoose(tao));
  PetscCheck(!ip->terms->n || ip->laws, PetscObjectComm((PetscObject)tao), PETSC_ERR_SUP,
    "norm terms are not available: this library was built without the folder tao_ipfilter/friction");
  PetscCall(IPTermsSetUp(tao));
  PetscCall(IPTermsResistance(tao));
  PetscCall(BeginMethod(tao));
  if (!ip->method->on && IPNeedsMethod(ip)) {
    PetscCall(EndMethodOnly(tao));
    PetscFunctionReturn(0);
  }
  PetscCall(IPSetUpIteration(tao));
  if (!ip->method->on) PetscCall(IPStartPoint(tao));
  PetscCall(AssessIterate(tao));
  PetscFunctionReturn(0);
}

/* Returns to the best iterate, and converts slacks and multipliers to the caller's units */
static PetscErrorCode EndSolve(Tao tao)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  PetscCall(IPDirectDestroy(ip->direct));
  PetscCall(IPWatchdogEnd(ip->watch));
  PetscCall(EndMethod(tao));
  PetscCall(RestoreBest(tao));
  PetscCall(IPConvergeRefined(tao));
  PetscCall(IPTermsSetUnmoved(tao));
  if (ip->relax->unknowns > 0.0) {
    PetscCall(IPBoundsReturn(tao));
    PetscCall(TaoComputeObjective(tao, tao->solution, &ip->at.f));
  }
  PetscCall(IPSetMultipliers(tao));
  if (ip->mi) PetscCall(IPRowScalePair(tao, ip->at.s, ip->at.z[IP_SLACK], PETSC_TRUE));
  if (ip->mi) PetscCall(IPSidesReturnPairs(tao));
  tao->fc       = ip->at.f;
  tao->residual = ip->kkt->error;
  tao->cnorm    = ip->kkt->inf_pr;
  PetscFunctionReturn(0);
}

/*
   Returns the limit of the KKT error. TAO's tolerance 0 means the best accuracy possible: the machine precision, below
   which a dimensionless error has no meaning.
*/
static PetscReal Tolerance(Tao tao)
{
  const IPOptions *opt           = ((TAO_IPFILTER *)tao->data)->opt;
  const PetscBool  dimensionless = (PetscBool)(opt->scaling == IP_SCALING_PROBLEM && opt->measure == IP_KKT_RELATIVE);

  return dimensionless || !(tao->gatol > 0.0) ? PetscMax(tao->gatol, PETSC_MACHINE_EPSILON) : tao->gatol;
}

/* Sets the figures of the previous solve to NaN, and removes its reason. A solve that ends with an error, or starts at
   a point with NaN, would otherwise report them. */
static void ForgetFigures(Tao tao)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  tao->fc = tao->residual = tao->cnorm = NAN;
  ip->kkt->error = ip->kkt->unscaled = NAN;
  ip->rec->reason[0]                 = '\0';
}

PetscErrorCode TaoSolve_IPFilter(Tao tao)
{
  TAO_IPFILTER *ip     = (TAO_IPFILTER *)tao->data;
  PetscBool     finite = PETSC_TRUE, other_operator;

  PetscFunctionBegin;
  ForgetFigures(tao);
  PetscCall(IPSetUpSizes(tao));
  PetscCall(IPMatricesCheck(tao, &other_operator));
  if (other_operator) PetscCall(IPForgetSystem(tao));
  ip->tol = Tolerance(tao);
  PetscCall(ResetSolve(tao));
  PetscCall(BeginSolve(tao, &finite));
  if (!finite) PetscFunctionReturn(0);
  while (tao->reason == TAO_CONTINUE_ITERATING) {
    PetscTryTypeMethod(tao, update, tao->niter, tao->user_update);
    PetscCall(TakeStep(tao));
    if (tao->reason == TAO_CONTINUE_ITERATING) PetscCall(AssessIterate(tao));
  }
  PetscCall(EndSolve(tao));
  PetscFunctionReturn(0);
}
