/*
   Filter line search (Waechter and Biegler 2006, sections 2.3 and 2.4): fraction to the boundary, switching
   condition, Armijo, and second-order correction.
*/
#include "ipfilterimpl.h"

/* theta = ||c - s|| in the norm of the weights; phi = f - mu sum w log t with the pairs' t given by their trial vectors
   where trial is set. A constraint or objective that is not finite makes theta infinite. */
static PetscErrorCode Violation(Tao tao, Vec c, Vec s, PetscReal *theta)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  PetscScalar   sum;

  PetscFunctionBegin;
  *theta = 0.0;
  if (!ip->mi) PetscFunctionReturn(0);
  PetscCall(VecWAXPY(ip->cwork, -1.0, s, c));
  PetscCall(VecPointwiseMult(ip->cwork2, ip->cwork, ip->pair[IP_SLACK].w));
  PetscCall(VecDot(ip->cwork, ip->cwork2, &sum));
  *theta = PetscSqrtReal(PetscRealPart(sum));
  PetscFunctionReturn(0);
}

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
  PetscCall(Violation(tao, ip->c, ip->pair[IP_SLACK].t, &ip->theta));
  PetscCall(BarrierFunction(tao, ip->f, PETSC_FALSE, &ip->phi));
  PetscCall(ObjectiveRounding(tao));
  if (ip->theta0 < 0.0) {
    PetscReal weight = 0.0;

    for (PetscInt b = 0; b < IP_NPAIRS; b++)
      if (ip->pair[b].n) weight += ip->pair[b].weight;
    ip->theta0    = ip->theta;
    ip->theta_ref = ip->phi_ref = 1.0;
    if (ip->scaling == IP_SCALING_PROBLEM) {
      ip->theta_ref = ip->mi ? ip->scale.length * PetscSqrtReal(ip->pair[IP_SLACK].weight) : 1.0;
      ip->phi_ref   = weight > 0.0 ? ip->scale.product * weight : 1.0;
    }
  }
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
static PetscErrorCode FractionToBoundary(Tao tao, PetscReal *primal, PetscReal *dual)
{
  TAO_IPFILTER   *ip  = (TAO_IPFILTER *)tao->data;
  const PetscReal tau = PetscMax(ip->tau_min, 1.0 - ip->mu / ip->scale.product);

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

/* theta and phi at x + alpha dx, s + alpha ds; *finite is false where the callbacks gave no number */
static PetscErrorCode TrialPoint(Tao tao, PetscReal alpha, PetscReal *theta, PetscReal *phi, PetscBool *finite)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  PetscCall(VecWAXPY(ip->xtrial, alpha, ip->dx, tao->solution));
  PetscCall(IPPairMoveTrial(&ip->pair[IP_SLACK], alpha));
  PetscCall(IPBoundsDistance(tao, ip->xtrial, PETSC_TRUE));
  PetscCall(TaoComputeObjective(tao, ip->xtrial, &ip->ftrial));
  *theta = 0.0;
  if (ip->mi) {
    PetscCall(TaoComputeInequalityConstraints(tao, ip->xtrial, ip->ctrial));
    PetscCall(Violation(tao, ip->ctrial, ip->pair[IP_SLACK].trial, theta));
  }
  PetscCall(BarrierFunction(tao, ip->ftrial, PETSC_TRUE, phi));
  *finite = (PetscBool)(!PetscIsInfOrNanReal(*theta) && !PetscIsInfOrNanReal(*phi));
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

  PetscFunctionBegin;
  *objective = (PetscBool)(ip->theta <= least && Switching(ip, alpha, slope));
  if (theta > ip->theta_max_fact * first) *accepted = PETSC_FALSE;
  else if (*objective) *accepted = (PetscBool)(phi - ip->phi <= ip->eta_phi * alpha * slope + slack);
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

/* Takes the accepted step: primal part by alpha, multipliers of the pairs by their own step */
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
  }
  ip->f            = ip->ftrial;
  ip->alpha_primal = alpha;
  ip->alpha_dual   = dual;
  PetscFunctionReturn(0);
}

/* Backtracks along the direction until the filter accepts; *ok is false where no step is acceptable */
PetscErrorCode IPLineSearch(Tao tao, PetscBool *ok)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  PetscReal     alpha = 1.0, dual = 1.0, slope = 0.0, least;

  PetscFunctionBegin;
  PetscCall(StartSearch(tao));
  PetscCall(BarrierSlope(tao, &slope));
  PetscCall(FractionToBoundary(tao, &alpha, &dual));
  PetscCall(VecNorm(ip->dx, NORM_INFINITY, &ip->dx_norm));
  least   = SmallestStep(ip, slope);
  ip->nls = 0;
  *ok     = PETSC_FALSE;
  for (; alpha >= least; alpha *= 0.5) {
    PetscReal theta = 0.0, phi = 0.0;
    PetscBool finite = PETSC_FALSE, accepted = PETSC_FALSE, objective = PETSC_FALSE;

    ip->nls++;
    PetscCall(TrialPoint(tao, alpha, &theta, &phi, &finite));
    if (finite) PetscCall(Acceptable(tao, alpha, slope, theta, phi, &accepted, &objective));
    if (!accepted) continue;
    if (!objective) PetscCall(IPFilterSetAdd(&ip->filter, (1.0 - ip->gamma_theta) * ip->theta, ip->phi - ip->gamma_phi * (ip->phi_ref / ip->theta_ref) * ip->theta));
    ip->step_tag = objective ? 'f' : 'h';
    PetscCall(TakeStep(tao, alpha, dual));
    *ok = PETSC_TRUE;
    break;
  }
  PetscFunctionReturn(0);
}
