/* Starting values of slacks and multipliers. */
#include "ipfilterimpl.h"

#define IP_LEAST_START 1e-10 /* gap of the pairs at the start, as a fraction of the terms of the objective */

/* The given constants: t stays for bounds, s = s0, z = z0, lambda = 0, mu = mu0 */
static PetscErrorCode StartCold(Tao tao)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  ip->mu = ip->opt.mu0 * ip->first.unit;
  if (ip->mi) {
    PetscCall(VecSet(ip->pair[IP_SLACK].t, ip->opt.s0));
    PetscCall(VecSet(ip->pair[IP_SLACK].z, ip->opt.z0 * ip->first.unit));
    PetscCall(VecSet(ip->at.lambda, 0.0));
  }
  PetscFunctionReturn(0);
}

/* Weighted mean of rho q^2: the product length x pressure of the constraints' present values */
static PetscErrorCode MeanProduct(Tao tao, Vec q, PetscReal *mean)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  Vec           q2, weight;
  PetscScalar   sum;

  PetscFunctionBegin;
  PetscCall(IPGetWork(tao, IP_INEQUALITIES, &q2));
  PetscCall(IPGetWork(tao, IP_INEQUALITIES, &weight));
  PetscCall(VecPointwiseMult(q2, q, q));
  PetscCall(VecPointwiseMult(weight, ip->stiff.rho, ip->pair[IP_SLACK].w));
  PetscCall(VecDot(q2, weight, &sum));
  PetscCall(IPRestoreWork(tao, IP_INEQUALITIES, &weight));
  PetscCall(IPRestoreWork(tao, IP_INEQUALITIES, &q2));
  *mean = PetscRealPart(sum) / ip->pair[IP_SLACK].weight;
  PetscFunctionReturn(0);
}

/* Weighted mean of |v| */
static PetscErrorCode MeanMagnitude(Tao tao, Vec v, PetscReal *mean)
{
  IPPair *slack = &((TAO_IPFILTER *)tao->data)->pair[IP_SLACK];
  Vec     wv;

  PetscFunctionBegin;
  PetscCall(IPGetWork(tao, IP_INEQUALITIES, &wv));
  PetscCall(VecPointwiseMult(wv, v, slack->w));
  PetscCall(VecNorm(wv, NORM_1, mean));
  PetscCall(IPRestoreWork(tao, IP_INEQUALITIES, &wv));
  *mean /= slack->weight;
  PetscFunctionReturn(0);
}

/* Without a penalty step, or an objective that resists one, the stiffness is that of multipliers which balance the gradient, over the constraints' mean value */
static PetscErrorCode GradientStiffness(Tao tao)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  PetscReal     gradient, transmitted, length;
  Vec           force;

  PetscFunctionBegin;
  PetscCall(VecNorm(tao->gradient, NORM_2, &gradient));
  PetscCall(IPGetWork(tao, IP_UNKNOWNS, &force));
  PetscCall(MatMultTranspose(ip->jac.inequality, ip->pair[IP_SLACK].w, force));
  PetscCall(VecNorm(force, NORM_2, &transmitted));
  PetscCall(IPRestoreWork(tao, IP_UNKNOWNS, &force));
  PetscCall(MeanMagnitude(tao, ip->at.c, &length));
  if (gradient > 0.0 && transmitted > 0.0 && length > 0.0) PetscCall(VecSet(ip->stiff.rho, gradient / transmitted / length));
  PetscFunctionReturn(0);
}

/* s and z from the constraints' values after the penalty step, centred, with mu a fraction of length x pressure there. Constraints that
   all happen to be active there say nothing: pairs start with a gap that is worth something beside the objective. */
static PetscErrorCode StartPredicted(Tao tao)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  PetscReal     length, pressure, mean, terms;
  PetscBool     moved = PETSC_FALSE;
  Vec           z;

  PetscFunctionBegin;
  if (!ip->stiff.flat) PetscCall(IPPenaltyStep(tao, &moved));
  if (!moved) PetscCall(GradientStiffness(tao));
  PetscCall(IPGetWork(tao, IP_INEQUALITIES, &z));
  PetscCall(IPPenaltyPressure(tao, ip->at.c, z));
  PetscCall(MeanMagnitude(tao, ip->at.c, &length));
  PetscCall(MeanMagnitude(tao, z, &pressure));
  PetscCall(IPRestoreWork(tao, IP_INEQUALITIES, &z));
  PetscCall(MeanProduct(tao, ip->at.c, &mean));
  ip->mu = moved ? ip->opt.mu_start * PetscMax(length * pressure, 1e-3 * mean) : 0.1 * mean;
  PetscCall(IPWorthTerms(tao, &terms));
  ip->mu = PetscMax(ip->mu, IP_LEAST_START * terms / ip->pair[IP_SLACK].weight);
  if (!(ip->mu > 0.0)) ip->mu = ip->opt.mu0;
  PetscCall(IPCentralPair(ip->at.c, ip->stiff.rho, ip->mu, ip->at.s, ip->at.z[IP_SLACK]));
  PetscCall(VecCopy(ip->at.z[IP_SLACK], ip->at.lambda));
  PetscFunctionReturn(0);
}

/* How far the caller's s and z are from belonging to x: the larger of the forces out of balance, relative, and of
   |c - s| against |c|, but no more than 1 */
static PetscErrorCode WarmMismatch(Tao tao, PetscReal *mismatch)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  PetscReal     force, imbalance, length, difference;

  PetscFunctionBegin;
  PetscCall(IPStationarity(tao, ip->at.z[IP_SLACK], ip->rx));
  PetscCall(VecNorm(tao->gradient, NORM_2, &force));
  PetscCall(VecNorm(ip->rx, NORM_2, &imbalance));
  PetscCall(VecWAXPY(ip->rc, -1.0, ip->at.s, ip->at.c));
  PetscCall(MeanMagnitude(tao, ip->rc, &difference));
  PetscCall(MeanMagnitude(tao, ip->at.c, &length));
  *mismatch = PetscMin(1.0, PetscMax(force > 0.0 ? imbalance / force : 1.0, length > 0.0 ? difference / length : 1.0));
  PetscFunctionReturn(0);
}

/* The caller's s and z, moved away from the boundary: s - z/rho is kept, the pair is centred, farther from the boundary
   the less they belong to x */
static PetscErrorCode StartWarm(Tao tao)
{
  TAO_IPFILTER *ip    = (TAO_IPFILTER *)tao->data;
  IPPair       *slack = &ip->pair[IP_SLACK];
  PetscReal     mean, average, mismatch = 1.0;
  Vec           q;

  PetscFunctionBegin;
  PetscCall(VecCopy(ip->given.warm_s, slack->t));
  PetscCall(VecCopy(ip->given.warm_z, slack->z));
  PetscCall(IPRowScalePair(tao, slack->t, slack->z, PETSC_FALSE));
  PetscCall(WarmMismatch(tao, &mismatch));
  PetscCall(IPPairProducts(slack, 0.0, NULL, &average));
  average = PetscMax(average / slack->weight, 0.0);
  PetscCall(IPGetWork(tao, IP_INEQUALITIES, &q));
  PetscCall(VecPointwiseDivide(q, slack->z, ip->stiff.rho));
  PetscCall(VecAYPX(q, -1.0, slack->t));
  PetscCall(MeanProduct(tao, q, &mean));
  ip->mu = PetscMax(average, mismatch * ip->opt.mu_warm * (mean > 0.0 ? mean : 1.0));
  PetscCall(IPCentralPair(q, ip->stiff.rho, ip->mu, slack->t, slack->z));
  PetscCall(IPRestoreWork(tao, IP_INEQUALITIES, &q));
  PetscCall(VecCopy(slack->z, ip->at.lambda));
  PetscFunctionReturn(0);
}

/* Fills slacks, multipliers and mu. The Hessian at x is needed for the stiffness of the constraints. */
PetscErrorCode IPStartPoint(Tao tao)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  PetscCall(PetscLogEventBegin(TAO_IPFilterStart, tao, NULL, NULL, NULL));
  for (PetscInt b = IP_LOWER; b <= IP_UPPER; b++)
    if (ip->pair[b].n) PetscCall(VecSet(ip->pair[b].z, 0.0));
  if (ip->opt.start == IP_START_COLD || !ip->mi) PetscCall(StartCold(tao));
  else if (ip->opt.start == IP_START_WARM && ip->given.warm_s) PetscCall(StartWarm(tao));
  else PetscCall(StartPredicted(tao));
  if (!ip->mi && ip->opt.scaling == IP_SCALING_PROBLEM) {
    PetscReal x, mean;

    PetscCall(VecNorm(tao->solution, NORM_INFINITY, &x));
    PetscCall(IPStiffnessEnergies(tao, NULL, &mean));
    ip->mu = ip->opt.mu_start * (mean > 0.0 ? mean : ip->stiff.hscale * (x > 0.0 ? x * x : 1.0));
  }
  PetscCall(IPBoundsCenter(tao));
  if (ip->me) PetscCall(IPEstimateMultipliers(tao));
  PetscCall(PetscLogEventEnd(TAO_IPFilterStart, tao, NULL, NULL, NULL));
  PetscFunctionReturn(0);
}
