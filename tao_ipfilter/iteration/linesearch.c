/*
   Filter line search (Waechter and Biegler 2006, sections 2.3 and 2.4): fraction to the boundary, switching condition,
   Armijo's condition, and second-order correction
*/
#include "iterationimpl.h"
#include "tao_ipfilter/solver/barrier.h"
#include "tao_ipfilter/solver/constants.h"
#include "tao_ipfilter/solver/matrices.h"
#include "tao_ipfilter/solver/options.h"
#include "tao_ipfilter/solver/relaxation.h"
#include "tao_ipfilter/solver/search.h"
#include "tao_ipfilter/solver/sizes.h"
#include "tao_ipfilter/solver/stiffness.h"

/*
   Computes theta and phi at the trial point x + alpha dx, s + alpha ds. *finite: false if the caller's functions
   returned no finite number.
*/
PetscErrorCode IPSearchTrial(Tao tao, PetscReal alpha, PetscReal *theta, PetscReal *phi, PetscBool *finite)
{
  TAO_IPFILTER *ip    = (TAO_IPFILTER *)tao->data;
  IPPair       *slack = &ip->pair[IP_SLACK], *ceiling = &ip->pair[IP_CEILING];

  PetscFunctionBegin;
  PetscCall(VecWAXPY(ip->trial.x, alpha, ip->dir.x, tao->solution));
  if (ip->mi) PetscCall(VecWAXPY(ip->trial.s, alpha, slack->dt, slack->t));
  if (ceiling->n) PetscCall(VecWAXPY(ceiling->trial, alpha, ceiling->dt, ceiling->t));
  PetscCall(IPBoundsDistance(tao, ip->trial.x, PETSC_TRUE));
  PetscCall(TaoComputeObjective(tao, ip->trial.x, &ip->trial.f));
  *finite = PETSC_FALSE;
  if (IPUndefined(ip->trial.f)) PetscFunctionReturn(0);
  PetscCall(IPEvaluateConstraints(tao, ip->trial.x, ip->trial.c, ip->trial.ce));
  PetscCall(IPMeritMeasureTrial(tao, theta, phi));
  *finite = (PetscBool)(!IPUndefined(*theta) && !IPUndefined(*phi));
  ip->search->ndefined += *finite;
  PetscFunctionReturn(0);
}

/*
   Returns whether the switching condition (-slope)^s_phi alpha > delta theta^s_theta holds: the expected decrease of
   the barrier function outweighs the violation
*/
static PetscBool SearchSwitches(const TAO_IPFILTER *ip, PetscReal alpha, PetscReal slope)
{
  if (slope >= 0.0) return PETSC_FALSE;
  return (PetscBool)(alpha * PetscPowReal(-slope / ip->search->phi_ref, IP_S_PHI) >
                     IP_DELTA_SWITCH * PetscPowReal(ip->search->theta / ip->search->theta_ref, IP_S_THETA));
}

/* Returns the violation to which the limits of theta are relative */
static PetscReal SearchFirstViolation(const TAO_IPFILTER *ip)
{
  return PetscMax(ip->opt->scaling == IP_SCALING_NONE ? 1.0 : ip->search->theta_ref, ip->search->theta0);
}

/*
   Finds whether the trial point with (theta, phi) at the step length alpha is acceptable. *objective: whether phi
   decides, either because it falls as the switching condition predicts, or because there is no violation to reduce. In
   this case the old iterate is not added to the filter (Waechter and Biegler 2006, equations (18) to (20)).
*/
static PetscErrorCode SearchAccepts(Tao tao, PetscReal alpha, PetscReal slope, PetscReal theta, PetscReal phi,
  PetscBool *accepted, PetscBool *objective)
{
  TAO_IPFILTER    *ip     = (TAO_IPFILTER *)tao->data;
  IPSearch        *search = ip->search;
  const IPOptions *opt    = ip->opt;
  const PetscReal  first = SearchFirstViolation(ip), change = phi - search->phi;
  const PetscBool  alone    = (PetscBool)(search->theta <= search->theta_rounding);
  const PetscBool  switches = SearchSwitches(ip, alpha, slope);
  const PetscBool  armijo   = (PetscBool)(change <= opt->eta_phi * alpha * PetscMin(slope, 0.0) + search->rounding);

  PetscFunctionBegin;
  *objective = (PetscBool)(alone || (switches && armijo));
  if (theta > IP_THETA_MAX_FACT * first) *accepted = PETSC_FALSE;
  else if (alone || (search->theta <= IP_THETA_MIN_FACT * first && switches)) *accepted = armijo;
  else
    *accepted =
      (PetscBool)(theta <= (1.0 - IP_GAMMA_THETA) * search->theta ||
                  change <= -opt->gamma_phi * (search->phi_ref / search->theta_ref) * search->theta + search->rounding);
  if (*accepted) PetscCall(IPFilterSetAccepts(ip->filter, theta, phi - search->rounding, accepted));
  PetscFunctionReturn(0);
}

/* Returns the smallest step length worth trying (Waechter and Biegler 2006, equation (23)) */
static PetscReal SearchSmallestStep(const TAO_IPFILTER *ip, PetscReal slope)
{
  const PetscReal theta = ip->search->theta / ip->search->theta_ref, descent = -slope / ip->search->phi_ref;
  PetscReal       least = IP_GAMMA_THETA;

  if (descent > 0.0) least = PetscMin(least, ip->opt->gamma_phi * theta / descent);
  if (descent > 0.0 && ip->search->theta <= IP_THETA_MIN_FACT * SearchFirstViolation(ip))
    least = PetscMin(least, IP_DELTA_SWITCH * PetscPowReal(theta, IP_S_THETA) / PetscPowReal(descent, IP_S_PHI));
  return PetscMax(IP_GAMMA_ALPHA * least, 1e-12);
}

/*
   Moves the iterate to the trial point. The multipliers of the constraints take the step length alpha, those of the
   pairs the step length `dual`. Very small slacks are increased slightly, since otherwise J^T D J would dominate the
   Hessian.
*/
PetscErrorCode IPSearchTakeStep(Tao tao, PetscReal alpha, PetscReal dual)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  PetscCall(IPIterateCopy(&ip->trial, &ip->at));
  for (PetscInt b = 0; b < IP_NPAIRS; b++) {
    IPPair *p = &ip->pair[b];

    if (!p->n) continue;
    if (b != IP_SLACK) PetscCall(VecCopy(p->trial, p->t));
    PetscCall(VecAXPY(p->z, dual, p->dz));
    PetscCall(IPPairSafeguard(p, ip->mu, IP_KAPPA_SIGMA));
  }
  ip->relax->least_bound = PETSC_INFINITY;
  for (PetscInt b = IP_LOWER; b <= IP_UPPER; b++) {
    PetscReal least;

    if (!ip->pair[b].n) continue;
    PetscCall(VecMin(ip->pair[b].t, NULL, &least));
    ip->relax->least_bound = PetscMin(ip->relax->least_bound, least);
  }
  if (ip->mi) {
    PetscCall(VecAXPY(ip->at.lambda, alpha, ip->dir.lambda));
    PetscCall(VecMin(ip->at.s, NULL, &ip->relax->least_slack));
    if (ip->opt->scaling == IP_SCALING_PROBLEM)
      PetscCall(IPPairLift(&ip->pair[IP_SLACK], ip->stiff->rho, ip->scale->length, IP_LEAST_SLACK));
  }
  if (ip->me) PetscCall(VecAXPY(ip->at.y, alpha, ip->dir.y));
  ip->search->alpha      = alpha;
  ip->search->alpha_dual = dual;
  PetscFunctionReturn(0);
}

/*
   Tests whether the constraints are nonlinear. For linear constraints the residuals at the trial point are 1 - alpha
   times the present ones. Sets ip->bar->curved.
*/
static PetscErrorCode SearchTestLinearity(Tao tao, PetscReal alpha)
{
  TAO_IPFILTER   *ip     = (TAO_IPFILTER *)tao->data;
  IPPair         *slack  = &ip->pair[IP_SLACK];
  const PetscReal linear = 1e-2;
  PetscReal       error, change;
  Vec             r;

  PetscFunctionBegin;
  if (ip->bar->curved) PetscFunctionReturn(0);
  if (ip->mi) {
    PetscCall(IPGetWork(tao, IP_INEQUALITIES, &r));
    PetscCall(VecWAXPY(r, -1.0, ip->trial.s, ip->trial.c));
    PetscCall(VecAXPY(r, alpha - 1.0, ip->rc));
    PetscCall(VecNorm(r, NORM_INFINITY, &error));
    PetscCall(VecNorm(slack->dt, NORM_INFINITY, &change));
    PetscCall(IPRestoreWork(tao, IP_INEQUALITIES, &r));
    ip->bar->curved = (PetscBool)(error > linear * alpha * change);
  }
  if (ip->me) {
    PetscCall(IPGetWork(tao, IP_EQUALITIES, &r));
    PetscCall(VecWAXPY(r, alpha - 1.0, ip->at.ce, ip->trial.ce));
    PetscCall(VecNorm(r, NORM_INFINITY, &error));
    PetscCall(IPRestoreWork(tao, IP_EQUALITIES, &r));
    ip->bar->curved = (PetscBool)(ip->bar->curved || error > linear * ip->scale->equality);
  }
  PetscFunctionReturn(0);
}

/*
   Accepts the step. The old iterate is added to the filter unless `objective`, that is, unless phi decided. corrected:
   the step is a second-order correction.
*/
static PetscErrorCode SearchAccept(Tao tao, PetscReal alpha, PetscReal dual, PetscBool objective, PetscBool corrected)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  if (!objective) PetscCall(IPMeritFilterAdd(tao));
  ip->search->tag = objective ? (corrected ? 'F' : 'f') : (corrected ? 'H' : 'h');
  PetscCall(IPSearchTakeStep(tao, alpha, dual));
  PetscFunctionReturn(0);
}

/*
   Tries second-order corrections. Each solves for a new direction, with the residuals rc and ce plus those of the last
   trial point. *ok: whether a correction was accepted.
*/
static PetscErrorCode SearchCorrections(Tao tao, PetscReal alpha, PetscReal slope, PetscReal theta, PetscReal tau,
  Vec rc, Vec ce, PetscBool *ok)
{
  TAO_IPFILTER *ip   = (TAO_IPFILTER *)tao->data;
  PetscReal     step = alpha, last = theta;

  PetscFunctionBegin;
  for (PetscInt k = 0; k < ip->opt->max_soc && !*ok; k++) {
    PetscReal phi = 0.0, dual = 1.0;
    PetscBool usable = PETSC_FALSE, finite = PETSC_FALSE, objective = PETSC_FALSE;

    if (ip->mi) {
      PetscCall(VecScale(rc, step));
      PetscCall(VecAXPY(rc, 1.0, ip->trial.c));
      PetscCall(VecAXPY(rc, -1.0, ip->trial.s));
    }
    if (ip->me) PetscCall(VecAYPX(ce, step, ip->trial.ce));
    PetscCall(IPCorrectDirection(tao, rc, ce, &usable));
    if (!usable) break;
    step = 1.0;
    PetscCall(IPFractionToBoundary(tao, IP_SLACK, tau, &step, &dual));
    PetscCall(IPSearchTrial(tao, step, &theta, &phi, &finite));
    ip->search->ntrials++;
    if (finite) PetscCall(SearchAccepts(tao, alpha, slope, theta, phi, ok, &objective));
    if (*ok) PetscCall(SearchAccept(tao, step, dual, objective, PETSC_TRUE));
    else if (!finite || theta > IP_KAPPA_SOC * last) break;
    last = theta;
  }
  PetscFunctionReturn(0);
}

/*
   Tries second-order corrections (Waechter and Biegler 2006, section 2.4) if the first trial point increases the
   violation. If none is accepted, the direction is restored.
*/
static PetscErrorCode SearchCorrect(Tao tao, PetscReal alpha, PetscReal slope, PetscReal theta, PetscReal tau,
  PetscBool *ok)
{
  TAO_IPFILTER *ip    = (TAO_IPFILTER *)tao->data;
  IPDirection   first = {.norm = 0.0};
  Vec           rc, ce;

  PetscFunctionBegin;
  *ok = PETSC_FALSE;
  if (theta < ip->search->theta || !ip->opt->max_soc) PetscFunctionReturn(0);
  PetscCall(IPGetWork(tao, IP_UNKNOWNS, &first.x));
  PetscCall(IPGetWork(tao, IP_EQUALITIES, &first.y));
  PetscCall(IPGetWork(tao, IP_INEQUALITIES, &rc));
  PetscCall(IPGetWork(tao, IP_EQUALITIES, &ce));
  PetscCall(IPDirectionCopy(&ip->dir, &first));
  if (ip->mi) PetscCall(VecCopy(ip->rc, rc));
  if (ip->me) PetscCall(VecCopy(ip->at.ce, ce));
  PetscCall(SearchCorrections(tao, alpha, slope, theta, tau, rc, ce, ok));
  if (!*ok) {
    PetscCall(IPDirectionCopy(&first, &ip->dir));
    PetscCall(IPBackSubstitute(tao, ip->rc));
  }
  PetscCall(IPRestoreWork(tao, IP_EQUALITIES, &ce));
  PetscCall(IPRestoreWork(tao, IP_INEQUALITIES, &rc));
  PetscCall(IPRestoreWork(tao, IP_EQUALITIES, &first.y));
  PetscCall(IPRestoreWork(tao, IP_UNKNOWNS, &first.x));
  PetscFunctionReturn(0);
}

/*
   Takes a step of the watchdog, if it is active: the longest step that the bounds allow, without a test. The new point
   is compared with the iterate at which the watchdog began. *taken: whether such a step was taken, or the iteration
   returned to that iterate.
*/
static PetscErrorCode SearchWatched(Tao tao, PetscReal alpha, PetscReal slope, PetscReal dual, PetscBool *taken)
{
  TAO_IPFILTER *ip    = (TAO_IPFILTER *)tao->data;
  IPWatchdog   *watch = ip->watch;
  PetscReal     theta = 0.0, phi = 0.0;
  PetscBool     finite = PETSC_FALSE, accepted = PETSC_FALSE, objective = PETSC_FALSE;

  PetscFunctionBegin;
  PetscCall(IPWatchdogBegin(tao, alpha, slope));
  *taken = (PetscBool)(watch->left > 0);
  if (!*taken) PetscFunctionReturn(0);
  ip->search->theta   = watch->theta;
  ip->search->phi     = watch->phi;
  ip->search->ntrials = 1;
  PetscCall(IPSearchTrial(tao, alpha, &theta, &phi, &finite));
  if (finite) PetscCall(SearchAccepts(tao, watch->alpha, watch->slope, theta, phi, &accepted, &objective));
  if (accepted) {
    PetscCall(SearchAccept(tao, alpha, dual, objective, PETSC_FALSE));
    PetscCall(IPWatchdogEnd(watch));
  } else if (finite && watch->left > 1) {
    PetscCall(IPSearchTakeStep(tao, alpha, dual));
    ip->search->tag = 'w';
    watch->left--;
  } else PetscCall(IPWatchdogReturn(tao, taken));
  PetscFunctionReturn(0);
}

/*
   Returns whether the Newton steps shrink by a constant factor only (linear convergence). This happens if gradient and
   curvature vanish at the same point.
*/
PetscBool IPSearchIsLinear(const TAO_IPFILTER *ip)
{
  const PetscReal quadratic = 0.2;

  return (
    PetscBool)(ip->search->alpha == 1.0 && ip->search->tag != 'R' && ip->dir.norm > quadratic * ip->search->before);
}

/* If Newton's method converges only linearly, stores the direction of the step in ip->search->slow. Does nothing if the
   step has length zero. */
static PetscErrorCode SearchKeepSlow(Tao tao)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  if (!(ip->dir.norm > 0.0)) PetscFunctionReturn(0);
  ip->search->slows = IPSearchIsLinear(ip);
  if (ip->search->slows) PetscCall(VecCopy(ip->dir.x, ip->search->slow));
  PetscFunctionReturn(0);
}

/*
   Shortens the step along the direction until the filter accepts the trial point. The longest step inside the bounds is
   always tried, since it may be short. *ok: false if no step is acceptable.
*/
PetscErrorCode IPLineSearch(Tao tao, PetscBool *ok)
{
  TAO_IPFILTER   *ip  = (TAO_IPFILTER *)tao->data;
  const PetscReal tau = PetscMax(IP_TAU_MIN, 1.0 - ip->mu / ip->scale->product), small = 0.05;
  PetscReal       alpha = 1.0, dual = 1.0, slope = 0.0, least, longest;

  PetscFunctionBegin;
  PetscCall(IPMeritMeasure(tao));
  PetscCall(IPMeritSlope(tao, &slope));
  PetscCall(IPFractionToBoundary(tao, IP_SLACK, tau, &alpha, &dual));
  longest            = alpha;
  ip->search->before = ip->dir.norm;
  PetscCall(VecNorm(ip->dir.x, NORM_INFINITY, &ip->dir.norm));
  least               = SearchSmallestStep(ip, slope);
  ip->search->ntrials = ip->search->ndefined = 0;
  *ok                                        = PETSC_FALSE;
  PetscCall(SearchWatched(tao, alpha, slope, dual, ok));
  if (*ok) PetscFunctionReturn(0);
  for (; (alpha >= least || !ip->search->ntrials) && !*ok; alpha *= 0.5) {
    PetscReal theta = 0.0, phi = 0.0;
    PetscBool finite = PETSC_FALSE, objective = PETSC_FALSE;

    ip->search->ntrials++;
    PetscCall(IPSearchTrial(tao, alpha, &theta, &phi, &finite));
    if (finite) PetscCall(SearchAccepts(tao, alpha, slope, theta, phi, ok, &objective));
    if (finite && ip->search->ntrials == 1) PetscCall(SearchTestLinearity(tao, alpha));
    if (*ok) PetscCall(SearchAccept(tao, alpha, dual, objective, PETSC_FALSE));
    else if (finite && ip->search->ntrials == 1) PetscCall(SearchCorrect(tao, alpha, slope, theta, tau, ok));
  }
  if (*ok) PetscCall(SearchKeepSlow(tao));
  ip->search->ncut  = *ok && ip->search->alpha < small ? ip->search->ncut + 1 : 0;
  ip->watch->nshort = *ok && ip->search->alpha < longest ? ip->watch->nshort + 1 : 0;
  PetscFunctionReturn(0);
}
