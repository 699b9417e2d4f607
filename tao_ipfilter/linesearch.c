/*
   Filter line search (Waechter and Biegler 2006, sections 2.3 and 2.4): fraction to the boundary, switching
   condition, Armijo, and second-order correction.
*/
#include "ipfilterimpl.h"

/* theta: c - s in the norm of the weights and c_E, both per unit of their references */
static PetscErrorCode Violation(Tao tao, Vec c, Vec s, Vec ce, PetscReal *theta)
{
  TAO_IPFILTER *ip  = (TAO_IPFILTER *)tao->data;
  PetscScalar   sum = 0.0;
  PetscReal     equality = 0.0;

  PetscFunctionBegin;
  if (ip->mi) {
    PetscCall(VecWAXPY(ip->cwork, -1.0, s, c));
    PetscCall(VecPointwiseMult(ip->cwork2, ip->cwork, ip->pair[IP_SLACK].w));
    PetscCall(VecDot(ip->cwork, ip->cwork2, &sum));
  }
  if (ip->me) PetscCall(VecNorm(ce, NORM_2, &equality));
  *theta = PetscSqrtReal(PetscRealPart(sum) + PetscSqr(equality * ip->equality_weight));
  PetscFunctionReturn(0);
}

/* phi = f - mu sum w log t, with the pairs' t or their trial values */
static PetscErrorCode BarrierFunction(Tao tao, PetscReal f, PetscBool trial, PetscReal *phi)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  *phi = f;
  for (PetscInt b = 0; b < IP_NPAIRS; b++) {
    IPPair   *p = &ip->pair[b];
    PetscReal sum;

    if (!p->n) continue;
    PetscCall(IPPairLogSum(p, trial ? p->trial : p->t, &sum));
    *phi -= ip->mu * sum;
  }
  PetscFunctionReturn(0);
}

/* What rounding makes of phi: a few eps of phi itself and of the terms of a quadratic form with H's diagonal */
static PetscErrorCode ObjectiveRounding(Tao tao)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  PetscScalar   terms;

  PetscFunctionBegin;
  PetscCall(VecPointwiseMult(ip->xwork, ip->hdiag, tao->solution));
  PetscCall(VecDot(ip->xwork, tao->solution, &terms));
  ip->rounding = 10.0 * PETSC_MACHINE_EPSILON * PetscMax(PetscAbsReal(ip->phi), PetscRealPart(terms));
  PetscFunctionReturn(0);
}

/* theta and phi at the current iterate, and theta's limits, which the first iterate sets */
static PetscErrorCode StartSearch(Tao tao)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  if (ip->theta0 < 0.0) {
    PetscReal weight = 0.0;

    for (PetscInt b = 0; b < IP_NPAIRS; b++)
      if (ip->pair[b].n) weight += ip->pair[b].weight;
    ip->theta_ref = ip->phi_ref = ip->equality_weight = 1.0;
    if (ip->scaling == IP_SCALING_PROBLEM) {
      ip->theta_ref       = ip->mi ? ip->scale.length * PetscSqrtReal(ip->pair[IP_SLACK].weight) : ip->scale.equality;
      ip->equality_weight = ip->theta_ref / ip->scale.equality;
      if (weight > 0.0) ip->phi_ref = ip->scale.product * weight;
    }
    PetscCall(Violation(tao, ip->c, ip->pair[IP_SLACK].t, ip->ce, &ip->theta0));
  }
  PetscCall(Violation(tao, ip->c, ip->pair[IP_SLACK].t, ip->ce, &ip->theta));
  PetscCall(BarrierFunction(tao, ip->f, PETSC_FALSE, &ip->phi));
  PetscCall(ObjectiveRounding(tao));
  PetscFunctionReturn(0);
}

/* Slope of the barrier function along the direction */
static PetscErrorCode BarrierSlope(Tao tao, PetscReal *slope)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  PetscScalar   gd;

  PetscFunctionBegin;
  PetscCall(VecDot(tao->gradient, ip->dx, &gd));
  *slope = PetscRealPart(gd);
  for (PetscInt b = 0; b < IP_NPAIRS; b++) {
    PetscReal sum;

    PetscCall(IPPairLogSlope(&ip->pair[b], &sum));
    *slope -= ip->mu * sum;
  }
  PetscFunctionReturn(0);
}

/* Largest steps that keep a fraction 1 - tau of every t and z */
PetscErrorCode IPFractionToBoundary(Tao tao, PetscReal tau, PetscReal *primal, PetscReal *dual)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  *primal = *dual = 1.0;
  for (PetscInt b = 0; b < IP_NPAIRS; b++) {
    IPPair *p = &ip->pair[b];

    if (!p->n) continue;
    PetscCall(IPPairMaxStep(p->t, p->dt, tau, primal));
    PetscCall(IPPairMaxStep(p->z, p->dz, tau, dual));
  }
  PetscFunctionReturn(0);
}

/* theta and phi at x + alpha dx, s + alpha ds; *finite is false where the callbacks gave no number. Outside the domain of
   the objective nothing else is evaluated. */
static PetscErrorCode TrialPoint(Tao tao, PetscReal alpha, PetscReal *theta, PetscReal *phi, PetscBool *finite)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  PetscCall(VecWAXPY(ip->xtrial, alpha, ip->dx, tao->solution));
  PetscCall(IPPairMoveTrial(&ip->pair[IP_SLACK], alpha));
  PetscCall(IPBoundsDistance(tao, ip->xtrial, PETSC_TRUE));
  PetscCall(TaoComputeObjective(tao, ip->xtrial, &ip->ftrial));
  *finite = PETSC_FALSE;
  if (IPUndefined(ip->ftrial)) PetscFunctionReturn(0);
  PetscCall(IPEvaluateConstraints(tao, ip->xtrial, ip->ctrial, ip->cetrial));
  PetscCall(IPMeasureTrial(tao, theta, phi));
  *finite = (PetscBool)(!IPUndefined(*theta) && !IPUndefined(*phi));
  PetscFunctionReturn(0);
}

/* theta and phi of the constraint values, objective and trial vectors at hand */
PetscErrorCode IPMeasureTrial(Tao tao, PetscReal *theta, PetscReal *phi)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  PetscCall(Violation(tao, ip->ctrial, ip->pair[IP_SLACK].trial, ip->cetrial, theta));
  PetscCall(BarrierFunction(tao, ip->ftrial, PETSC_TRUE, phi));
  PetscFunctionReturn(0);
}

/* (-slope)^s_phi alpha > delta theta^s_theta: the step promises more for the objective than for the constraints */
static PetscBool Switching(const TAO_IPFILTER *ip, PetscReal alpha, PetscReal slope)
{
  if (slope >= 0.0) return PETSC_FALSE;
  return (PetscBool)(alpha * PetscPowReal(-slope / ip->phi_ref, ip->s_phi) > ip->delta_switch * PetscPowReal(ip->theta / ip->theta_ref, ip->s_theta));
}

/* Whether (theta, phi) at step alpha is acceptable; *objective tells that Armijo decided */
static PetscErrorCode Acceptable(Tao tao, PetscReal alpha, PetscReal slope, PetscReal theta, PetscReal phi, PetscBool *accepted, PetscBool *objective)
{
  TAO_IPFILTER   *ip    = (TAO_IPFILTER *)tao->data;
  const PetscReal first = ip->scaling == IP_SCALING_NONE ? PetscMax(1.0, ip->theta0) : PetscMax(ip->theta_ref, ip->theta0);
  const PetscReal least = ip->theta_min_fact * first, slack = ip->rounding;
  const PetscBool alone = (PetscBool)(ip->theta <= 0.0); /* no violation that could fall instead */
  const PetscReal most  = ip->scaling == IP_SCALING_NONE ? PETSC_INFINITY : ip->obj_max_inc * PetscMax(PetscAbsReal(ip->phi), ip->phi_ref);

  PetscFunctionBegin;
  *objective = (PetscBool)(alone || (ip->theta <= least && Switching(ip, alpha, slope)));
  if (theta > ip->theta_max_fact * first || phi - ip->phi > most) *accepted = PETSC_FALSE;
  else if (*objective) *accepted = (PetscBool)(phi - ip->phi <= ip->eta_phi * alpha * PetscMin(slope, 0.0) + slack);
  else *accepted = (PetscBool)(theta <= (1.0 - ip->gamma_theta) * ip->theta || phi - ip->phi <= -ip->gamma_phi * (ip->phi_ref / ip->theta_ref) * ip->theta + slack);
  if (*accepted) PetscCall(IPFilterSetAccepts(&ip->filter, theta, phi - slack, accepted));
  PetscFunctionReturn(0);
}

/* Smallest step worth trying (equation (23) there) */
static PetscReal SmallestStep(const TAO_IPFILTER *ip, PetscReal slope)
{
  const PetscReal theta = ip->theta / ip->theta_ref, descent = -slope / ip->phi_ref;
  PetscReal       least = ip->gamma_theta;

  if (descent > 0.0) {
    least = PetscMin(least, ip->gamma_phi * theta / descent);
    least = PetscMin(least, ip->delta_switch * PetscPowReal(theta, ip->s_theta) / PetscPowReal(descent, ip->s_phi));
  }
  return PetscMax(ip->gamma_alpha * least, 1e-12);
}

/* Takes the accepted step: primal part by alpha, multipliers of the pairs by their own step. A slack so small that J^T D J would drown
   the Hessian in rounding is lifted, by next to nothing. */
static PetscErrorCode TakeStep(Tao tao, PetscReal alpha, PetscReal dual)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  PetscCall(VecCopy(ip->xtrial, tao->solution));
  for (PetscInt b = 0; b < IP_NPAIRS; b++) {
    IPPair *p = &ip->pair[b];

    if (!p->n) continue;
    PetscCall(VecCopy(p->trial, p->t));
    PetscCall(VecAXPY(p->z, dual, p->dz));
    PetscCall(IPPairSafeguard(p, ip->mu, ip->kappa_sigma));
  }
  if (ip->mi) {
    PetscCall(VecCopy(ip->ctrial, ip->c));
    PetscCall(VecAXPY(ip->lambda, alpha, ip->dlambda));
    PetscCall(VecMin(ip->pair[IP_SLACK].t, NULL, &ip->least_slack));
    if (ip->scaling == IP_SCALING_PROBLEM) PetscCall(IPPairLift(&ip->pair[IP_SLACK], ip->stiffness, ip->scale.length, IP_LEAST_SLACK));
  }
  if (ip->me) {
    PetscCall(VecCopy(ip->cetrial, ip->ce));
    PetscCall(VecAXPY(ip->y, alpha, ip->dy));
  }
  ip->f            = ip->ftrial;
  ip->alpha_primal = alpha;
  ip->alpha_dual   = dual;
  PetscFunctionReturn(0);
}

/* Puts the present iterate, with its margins, into the filter */
PetscErrorCode IPFilterAdd(Tao tao)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  PetscCall(IPFilterSetAdd(&ip->filter, (1.0 - ip->gamma_theta) * ip->theta, ip->phi - ip->gamma_phi * (ip->phi_ref / ip->theta_ref) * ip->theta));
  PetscFunctionReturn(0);
}

/* Whether residuals of the constraints at the trial point are other than the 1 - alpha times the present ones that linear
   constraints leave */
static PetscErrorCode TestLinearity(Tao tao, PetscReal alpha)
{
  TAO_IPFILTER   *ip   = (TAO_IPFILTER *)tao->data;
  const PetscReal some = 1e-2;
  PetscReal       error, change;

  PetscFunctionBegin;
  if (ip->curved) PetscFunctionReturn(0);
  if (ip->mi) {
    IPPair *p = &ip->pair[IP_SLACK];

    PetscCall(VecWAXPY(ip->cwork, -1.0, p->trial, ip->ctrial));
    PetscCall(VecAXPY(ip->cwork, alpha - 1.0, ip->rc));
    PetscCall(VecNorm(ip->cwork, NORM_INFINITY, &error));
    PetscCall(VecNorm(p->dt, NORM_INFINITY, &change));
    ip->curved = (PetscBool)(error > some * alpha * change);
  }
  if (ip->me) {
    PetscCall(VecWAXPY(ip->cesoc, alpha - 1.0, ip->ce, ip->cetrial));
    PetscCall(VecNorm(ip->cesoc, NORM_INFINITY, &error));
    ip->curved = (PetscBool)(ip->curved || error > some * ip->scale.equality);
  }
  PetscFunctionReturn(0);
}

/* Takes the step, and puts the iterate left behind into the filter, unless Armijo decided */
static PetscErrorCode Accept(Tao tao, PetscReal alpha, PetscReal dual, PetscBool objective, PetscBool corrected)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  if (!objective) PetscCall(IPFilterAdd(tao));
  ip->step_tag = objective ? (corrected ? 'F' : 'f') : (corrected ? 'H' : 'h');
  PetscCall(TakeStep(tao, alpha, dual));
  PetscFunctionReturn(0);
}

/* Second-order correction (section 2.4 there): where the first trial point violates the constraints more than the
   iterate, the residuals at both points together give another direction with the same matrix */
static PetscErrorCode SecondOrderCorrection(Tao tao, PetscReal alpha, PetscReal slope, PetscReal theta, PetscReal tau, PetscBool *ok)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  PetscReal     step = alpha, last = theta;

  PetscFunctionBegin;
  *ok = PETSC_FALSE;
  if (theta < ip->theta || !ip->max_soc) PetscFunctionReturn(0);
  PetscCall(IPNeedVec(tao, &ip->dxfirst));
  PetscCall(VecCopy(ip->dx, ip->dxfirst));
  if (ip->mi) PetscCall(VecCopy(ip->rc, ip->rcsoc));
  if (ip->me) PetscCall(VecCopy(ip->ce, ip->cesoc));
  for (PetscInt k = 0; k < ip->max_soc && !*ok; k++) {
    PetscReal phi = 0.0, dual = 1.0;
    PetscBool usable = PETSC_FALSE, finite = PETSC_FALSE, objective = PETSC_FALSE;

    if (ip->mi) {
      PetscCall(VecScale(ip->rcsoc, step));
      PetscCall(VecAXPY(ip->rcsoc, 1.0, ip->ctrial));
      PetscCall(VecAXPY(ip->rcsoc, -1.0, ip->pair[IP_SLACK].trial));
    }
    if (ip->me) PetscCall(VecAYPX(ip->cesoc, step, ip->cetrial));
    PetscCall(IPCorrectDirection(tao, ip->rcsoc, ip->cesoc, &usable));
    if (!usable) break;
    PetscCall(IPFractionToBoundary(tao, tau, &step, &dual));
    PetscCall(TrialPoint(tao, step, &theta, &phi, &finite));
    ip->nls++;
    if (finite) PetscCall(Acceptable(tao, alpha, slope, theta, phi, ok, &objective));
    if (*ok) PetscCall(Accept(tao, step, dual, objective, PETSC_TRUE));
    else if (!finite || theta > ip->kappa_soc * last) break;
    last = theta;
  }
  if (*ok) PetscFunctionReturn(0);
  PetscCall(VecCopy(ip->dxfirst, ip->dx));
  if (ip->me) PetscCall(VecCopy(ip->dyfirst, ip->dy));
  PetscCall(IPBackSubstitute(tao, ip->rc));
  PetscFunctionReturn(0);
}

/* Backtracks along the direction until the filter accepts; *ok is false where no step is acceptable */
PetscErrorCode IPLineSearch(Tao tao, PetscBool *ok)
{
  TAO_IPFILTER   *ip    = (TAO_IPFILTER *)tao->data;
  const PetscReal tau   = PetscMax(ip->tau_min, 1.0 - ip->mu / ip->scale.product);
  PetscReal       alpha = 1.0, dual = 1.0, slope = 0.0, least;

  PetscFunctionBegin;
  PetscCall(StartSearch(tao));
  PetscCall(BarrierSlope(tao, &slope));
  PetscCall(IPFractionToBoundary(tao, tau, &alpha, &dual));
  PetscCall(VecNorm(ip->dx, NORM_INFINITY, &ip->dx_norm));
  least   = SmallestStep(ip, slope);
  ip->nls = 0;
  *ok     = PETSC_FALSE;
  for (; alpha >= least && !*ok; alpha *= 0.5) {
    PetscReal theta = 0.0, phi = 0.0;
    PetscBool finite = PETSC_FALSE, objective = PETSC_FALSE;

    ip->nls++;
    PetscCall(TrialPoint(tao, alpha, &theta, &phi, &finite));
    if (finite) PetscCall(Acceptable(tao, alpha, slope, theta, phi, ok, &objective));
    if (finite && ip->nls == 1) PetscCall(TestLinearity(tao, alpha));
    if (*ok) PetscCall(Accept(tao, alpha, dual, objective, PETSC_FALSE));
    else if (finite && ip->nls == 1) PetscCall(SecondOrderCorrection(tao, alpha, slope, theta, tau, ok));
  }
  PetscFunctionReturn(0);
}
