/*
   Computes the two merit functions of the line search: theta, the constraint violation, and phi, the barrier function
*/
#include "iterationimpl.h"
#include "tao_ipfilter/solver/constants.h"
#include "tao_ipfilter/solver/options.h"
#include "tao_ipfilter/solver/search.h"
#include "tao_ipfilter/solver/sizes.h"
#include "tao_ipfilter/solver/stiffness.h"

/* Computes theta, the norm of c - s in the weights m and of c_E times equality_weight */
static PetscErrorCode MeritViolation(Tao tao, const IPIterate *it, PetscReal *theta)
{
  TAO_IPFILTER *ip     = (TAO_IPFILTER *)tao->data;
  PetscReal     square = 0.0, equality = 0.0;
  Vec           r;

  PetscFunctionBegin;
  if (ip->mi) {
    PetscCall(IPGetWork(tao, IP_INEQUALITIES, &r));
    PetscCall(VecWAXPY(r, -1.0, it->s, it->c));
    PetscCall(IPPairWeightedSquare(tao, r, &square));
    PetscCall(IPRestoreWork(tao, IP_INEQUALITIES, &r));
  }
  if (ip->me) PetscCall(VecNorm(it->ce, NORM_2, &equality));
  *theta = PetscSqrtReal(square + PetscSqr(equality * ip->search->equality_weight));
  PetscFunctionReturn(0);
}

/* Computes phi = f - mu sum w log t, with t of the pairs, or with their trial values if `trial` */
static PetscErrorCode MeritBarrier(Tao tao, PetscReal f, PetscBool trial, PetscReal *phi)
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

/*
   Estimates the rounding error of phi: a few machine epsilons times the larger one of |phi| and the terms of a
   quadratic form with H's diagonal
*/
static PetscErrorCode MeritRounding(Tao tao)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  PetscScalar   terms;
  Vec           hx;

  PetscFunctionBegin;
  PetscCall(IPGetWork(tao, IP_UNKNOWNS, &hx));
  PetscCall(VecPointwiseMult(hx, ip->stiff->hdiag, tao->solution));
  PetscCall(VecDot(hx, tao->solution, &terms));
  PetscCall(IPRestoreWork(tao, IP_UNKNOWNS, &hx));
  ip->search->rounding = 10.0 * PETSC_MACHINE_EPSILON * PetscMax(PetscAbsReal(ip->search->phi), PetscRealPart(terms));
  PetscFunctionReturn(0);
}

/*
   Estimates the rounding error of theta if all constraints are satisfied: a few machine epsilons times the constraint
   values and the terms that cancel in equality constraints
*/
static PetscErrorCode MeritViolationRounding(Tao tao)
{
  TAO_IPFILTER   *ip       = (TAO_IPFILTER *)tao->data;
  const PetscReal rounding = 10.0 * PETSC_MACHINE_EPSILON;
  PetscReal       square = 0.0, equality = 0.0;
  Vec             near;

  PetscFunctionBegin;
  if (ip->mi) {
    PetscCall(IPGetWork(tao, IP_INEQUALITIES, &near));
    PetscCall(IPValuesWithinReach(tao, ip->at.c, near));
    PetscCall(IPPairWeightedSquare(tao, near, &square));
    PetscCall(IPRestoreWork(tao, IP_INEQUALITIES, &near));
  }
  if (ip->me) equality = ip->search->equality_weight * ip->scale->equality_terms;
  ip->search->theta_rounding = rounding * PetscSqrtReal(square + PetscSqr(equality));
  PetscFunctionReturn(0);
}

/* Sets the units of theta and phi, and theta0, the violation of the first iterate, from which limits are derived */
static PetscErrorCode MeritUnits(Tao tao)
{
  TAO_IPFILTER *ip     = (TAO_IPFILTER *)tao->data;
  IPSearch     *search = ip->search;
  PetscReal     weight = 0.0;

  PetscFunctionBegin;
  for (PetscInt b = 0; b < IP_NPAIRS; b++)
    if (ip->pair[b].n) weight += ip->pair[b].weight;
  search->theta_ref = search->equality_weight = search->phi_ref = 1.0;
  if (ip->opt->scaling == IP_SCALING_PROBLEM) {
    search->theta_ref = ip->mi ? ip->scale->length * PetscSqrtReal(ip->pair[IP_SLACK].weight) : ip->scale->equality;
    search->equality_weight = search->theta_ref / ip->scale->equality;
    if (weight > 0.0) search->phi_ref = ip->scale->product * weight;
  }
  PetscCall(MeritViolation(tao, &ip->at, &search->theta0));
  PetscFunctionReturn(0);
}

/* Computes theta and phi at the current iterate */
PetscErrorCode IPMeritMeasure(Tao tao)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  if (ip->search->theta0 < 0.0) PetscCall(MeritUnits(tao));
  PetscCall(MeritViolation(tao, &ip->at, &ip->search->theta));
  PetscCall(MeritBarrier(tao, ip->at.f, PETSC_FALSE, &ip->search->phi));
  PetscCall(MeritRounding(tao));
  PetscCall(MeritViolationRounding(tao));
  PetscFunctionReturn(0);
}

/* Computes the derivative of the barrier function along the direction */
PetscErrorCode IPMeritSlope(Tao tao, PetscReal *slope)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  PetscScalar   gd;

  PetscFunctionBegin;
  PetscCall(VecDot(tao->gradient, ip->dir.x, &gd));
  *slope = PetscRealPart(gd);
  for (PetscInt b = 0; b < IP_NPAIRS; b++) {
    PetscReal sum;

    PetscCall(IPPairLogSlope(&ip->pair[b], &sum));
    *slope -= ip->mu * sum;
  }
  PetscFunctionReturn(0);
}

/* Computes theta and phi at the trial point, whose function values must have been evaluated */
PetscErrorCode IPMeritMeasureTrial(Tao tao, PetscReal *theta, PetscReal *phi)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  PetscCall(MeritViolation(tao, &ip->trial, theta));
  PetscCall(MeritBarrier(tao, ip->trial.f, PETSC_TRUE, phi));
  PetscFunctionReturn(0);
}

/* Adds the present iterate to the filter, with the margins of sufficient reduction */
PetscErrorCode IPMeritFilterAdd(Tao tao)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  PetscCall(IPFilterSetAdd(ip->filter, (1.0 - IP_GAMMA_THETA) * ip->search->theta,
    ip->search->phi - ip->opt->gamma_phi * (ip->search->phi_ref / ip->search->theta_ref) * ip->search->theta));
  PetscFunctionReturn(0);
}
