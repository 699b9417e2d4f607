/* Chooses the initial slacks, multipliers and mu */
#include "iterationimpl.h"
#include "tao_ipfilter/solver/barrier.h"
#include "tao_ipfilter/solver/constants.h"
#include "tao_ipfilter/solver/kkt.h"
#include "tao_ipfilter/solver/matrices.h"
#include "tao_ipfilter/solver/options.h"
#include "tao_ipfilter/solver/sizes.h"
#include "tao_ipfilter/solver/stiffness.h"

#define IP_LEAST_START 1e-10 /* least initial complementarity gap, relative to the terms of the objective */

/* Cold start with given constants: s = s0, z = z0, lambda = 0, mu = mu0. The distances t of bounds are unchanged. */
static PetscErrorCode StartCold(Tao tao)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  ip->mu = ip->opt->mu0;
  if (ip->mi) {
    PetscCall(VecSet(ip->pair[IP_SLACK].t, ip->opt->s0));
    PetscCall(VecSet(ip->pair[IP_SLACK].z, ip->opt->z0));
    PetscCall(IPSlackKeepInside(tao, ip->at.s, 0.5));
    PetscCall(IPSlackCenterUpper(tao, ip->mu));
    PetscCall(VecSet(ip->at.lambda, 0.0));
  }
  PetscFunctionReturn(0);
}

/* Computes the weighted mean of rho q^2 (length x pressure). Rows with q out of reach count as zero. */
static PetscErrorCode MeanProduct(Tao tao, Vec q, PetscReal *mean)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  Vec           q2, weight;
  PetscScalar   sum;

  PetscFunctionBegin;
  PetscCall(IPGetWork(tao, IP_INEQUALITIES, &q2));
  PetscCall(IPGetWork(tao, IP_INEQUALITIES, &weight));
  PetscCall(IPValuesWithinReach(tao, q, q2));
  PetscCall(VecPointwiseMult(q2, q2, q2));
  PetscCall(VecPointwiseMult(weight, ip->stiff->rho, ip->pair[IP_SLACK].w));
  PetscCall(VecDot(q2, weight, &sum));
  PetscCall(IPRestoreWork(tao, IP_INEQUALITIES, &weight));
  PetscCall(IPRestoreWork(tao, IP_INEQUALITIES, &q2));
  *mean = PetscRealPart(sum) / ip->pair[IP_SLACK].weight;
  PetscFunctionReturn(0);
}

/* Computes the weighted mean of |v| */
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

/* Computes the weighted mean of the constraints' absolute values. Rows out of reach count as zero. */
static PetscErrorCode MeanLength(Tao tao, PetscReal *mean)
{
  Vec near;

  PetscFunctionBegin;
  PetscCall(IPGetWork(tao, IP_INEQUALITIES, &near));
  PetscCall(IPValuesWithinReach(tao, ((TAO_IPFILTER *)tao->data)->at.c, near));
  PetscCall(MeanMagnitude(tao, near, mean));
  PetscCall(IPRestoreWork(tao, IP_INEQUALITIES, &near));
  PetscFunctionReturn(0);
}

/*
   Computes the pressure that, equal in all rows, balances the gradient g in the unknowns where g is large: (g, g) /
   (|g|, |J|^T w)
*/
static PetscErrorCode GradientPressure(Tao tao, PetscReal *pressure)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  PetscScalar   gradient, balanced;
  Vec           size, terms;

  PetscFunctionBegin;
  PetscCall(IPGetWork(tao, IP_UNKNOWNS, &size));
  PetscCall(IPGetWork(tao, IP_INEQUALITIES, &terms));
  PetscCall(VecCopy(tao->gradient, size));
  PetscCall(VecAbs(size));
  PetscCall(IPOwnTerms(ip->jac->inequality, size, terms, NULL));
  PetscCall(VecDot(terms, ip->pair[IP_SLACK].w, &balanced));
  PetscCall(VecDot(size, size, &gradient));
  PetscCall(IPRestoreWork(tao, IP_INEQUALITIES, &terms));
  PetscCall(IPRestoreWork(tao, IP_UNKNOWNS, &size));
  *pressure = PetscRealPart(balanced) > 0.0 ? PetscRealPart(gradient / balanced) : 0.0;
  PetscFunctionReturn(0);
}

/*
   Chooses the stiffness rho if there was no penalty step, or the objective has no curvature: the pressure of
   GradientPressure() divided by *length, the constraints' mean value. If that is zero, *length becomes a fraction of
   the mean of the constraints' terms.
*/
static PetscErrorCode GradientStiffness(Tao tao, PetscReal *length)
{
  TAO_IPFILTER   *ip   = (TAO_IPFILTER *)tao->data;
  const PetscReal part = 1e-2;
  Vec             terms;

  PetscFunctionBegin;
  if (!(*length > 0.0)) {
    PetscCall(IPGetWork(tao, IP_INEQUALITIES, &terms));
    PetscCall(IPOwnTerms(ip->jac->inequality, tao->solution, terms, NULL));
    PetscCall(MeanMagnitude(tao, terms, length));
    PetscCall(IPRestoreWork(tao, IP_INEQUALITIES, &terms));
    *length *= part;
  }
  if (ip->first->pressure > 0.0 && *length > 0.0) PetscCall(VecSet(ip->stiff->rho, ip->first->pressure / *length));
  PetscFunctionReturn(0);
}

/*
   Computes the mean product t z of a pair of bounds, if z balances the gradient: the work of the gradient on the way to
   the bounds, divided by the number of bounds. The way ends at the Newton step of the unknown alone if that is shorter.
*/
static PetscErrorCode BoundsWork(Tao tao, PetscReal *mean)
{
  TAO_IPFILTER      *ip     = (TAO_IPFILTER *)tao->data;
  PetscReal          sum[2] = {0.0, 0.0};
  const PetscScalar *g, *h, *t;
  PetscInt           n;

  PetscFunctionBegin;
  PetscCall(VecGetLocalSize(tao->solution, &n));
  PetscCall(VecGetArrayRead(tao->gradient, &g));
  PetscCall(VecGetArrayRead(ip->stiff->hdiag, &h));
  for (PetscInt b = IP_LOWER; b <= IP_UPPER; b++) {
    if (!ip->pair[b].n) continue;
    PetscCall(VecGetArrayRead(ip->pair[b].t, &t));
    for (PetscInt j = 0; j < n; j++) {
      const PetscReal force = PetscMax(ip->pair[b].sign * PetscRealPart(g[j]), 0.0);
      const PetscReal way   = PetscMin(PetscRealPart(t[j]), IPReachOfUnknowns(ip));

      if (PetscRealPart(t[j]) >= PETSC_INFINITY) continue;
      sum[0] += force * (force < PetscRealPart(h[j]) * way ? force / PetscRealPart(h[j]) : way);
      sum[1] += 1.0;
    }
    PetscCall(VecRestoreArrayRead(ip->pair[b].t, &t));
  }
  PetscCall(VecRestoreArrayRead(ip->stiff->hdiag, &h));
  PetscCall(VecRestoreArrayRead(tao->gradient, &g));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sum, 2, MPIU_REAL, MPIU_SUM, PetscObjectComm((PetscObject)tao)));
  *mean = sum[1] > 0.0 ? sum[0] / sum[1] : 0.0;
  PetscFunctionReturn(0);
}

/*
   Predicted start: s and z follow from the constraints' values after a penalty step and are moved to the central path.
   mu is a fraction of length x pressure there. If all constraints happen to be active this mu is zero; the pairs then
   start with a complementarity gap that is noticeable relative to the objective.
*/
static PetscErrorCode StartPredicted(Tao tao)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  PetscReal     length, pressure, mean, terms, bound;
  PetscBool     moved = PETSC_FALSE;
  Vec           z;

  PetscFunctionBegin;
  if (!ip->stiff->flat) PetscCall(IPPenaltyStep(tao, &moved));
  PetscCall(MeanLength(tao, &length));
  PetscCall(GradientPressure(tao, &ip->first->pressure));
  if (moved) {
    PetscCall(IPGetWork(tao, IP_INEQUALITIES, &z));
    PetscCall(IPPenaltyPressure(tao, ip->at.c, z));
    PetscCall(MeanMagnitude(tao, z, &pressure));
    PetscCall(IPRestoreWork(tao, IP_INEQUALITIES, &z));
  } else {
    PetscCall(GradientStiffness(tao, &length));
    pressure = ip->first->pressure;
  }
  PetscCall(MeanProduct(tao, ip->at.c, &mean));
  ip->mu = moved ? IP_PREDICT_MU * PetscMax(length * pressure, 1e-3 * mean) : 0.1 * PetscMax(mean, length * pressure);
  PetscCall(IPErrorBoundTerms(tao, &terms));
  ip->mu = PetscMax(ip->mu, IP_LEAST_START * terms / ip->pair[IP_SLACK].weight);
  PetscCall(BoundsWork(tao, &bound));
  ip->mu = PetscMax(ip->mu, IP_PREDICT_MU * bound);
  if (!(ip->mu > 0.0)) ip->mu = ip->opt->mu0;
  PetscCall(IPSlackCentral(tao, ip->at.c, ip->mu, ip->at.s, ip->at.z[IP_SLACK]));
  PetscCall(IPSlackCenterUpper(tao, ip->mu));
  PetscFunctionReturn(0);
}

/*
   Computes how badly the caller's s and z fit x: the relative force imbalance or |c - s| / |c|, whichever is larger, at
   most 1
*/
static PetscErrorCode WarmMismatch(Tao tao, PetscReal *mismatch)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  PetscReal     force, imbalance, length, difference;

  PetscFunctionBegin;
  PetscCall(IPStationarity(tao, ip->at.lambda, ip->rx));
  PetscCall(VecNorm(tao->gradient, NORM_2, &force));
  PetscCall(VecNorm(ip->rx, NORM_2, &imbalance));
  *mismatch = PetscMin(1.0, force > 0.0 ? imbalance / force : 1.0);
  if (!ip->mi) PetscFunctionReturn(0);
  PetscCall(VecWAXPY(ip->rc, -1.0, ip->at.s, ip->at.c));
  PetscCall(MeanMagnitude(tao, ip->rc, &difference));
  PetscCall(MeanMagnitude(tao, ip->at.c, &length));
  *mismatch = PetscMin(1.0, PetscMax(*mismatch, length > 0.0 ? difference / length : 1.0));
  PetscFunctionReturn(0);
}

/*
   Finds whether the caller's slacks and multipliers almost solve the problem. They are then used unchanged, and mu is
   their mean product.
*/
static PetscErrorCode WarmSolves(Tao tao, PetscBool *solves)
{
  TAO_IPFILTER   *ip      = (TAO_IPFILTER *)tao->data;
  const PetscReal nearly  = 10.0;
  PetscReal       least_s = 1.0, least_z = 1.0, least_upper = 1.0;

  PetscFunctionBegin;
  *solves = PETSC_FALSE;
  if (ip->mi) {
    PetscCall(VecMin(ip->at.s, NULL, &least_s));
    PetscCall(VecMin(ip->at.z[IP_SLACK], NULL, &least_z));
    PetscCall(IPSlackPressure(tao, ip->at.lambda));
  }
  if (ip->me) PetscCall(IPEqualityMultipliers(tao));
  if (ip->pair[IP_CEILING].n) PetscCall(VecMin(ip->pair[IP_CEILING].t, NULL, &least_upper));
  if (!(PetscMin(PetscMin(least_s, least_upper), least_z) > 0.0)) PetscFunctionReturn(0);
  PetscCall(IPBarrierAverage(tao, &ip->mu));
  PetscCall(IPComputeKKT(tao));
  *solves = (PetscBool)(ip->kkt->error <= nearly * ip->tol);
  PetscFunctionReturn(0);
}

/*
   Warm start from the caller's s and z. The pairs are moved to the central path such that s - z/rho is unchanged. The
   worse they fit x, the larger is mu.
*/
static PetscErrorCode StartWarm(Tao tao)
{
  TAO_IPFILTER *ip    = (TAO_IPFILTER *)tao->data;
  IPPair       *slack = &ip->pair[IP_SLACK];
  PetscReal     mean, average, mismatch = 1.0;
  PetscBool     solves;
  Vec           q;

  PetscFunctionBegin;
  PetscCall(VecCopy(ip->given->warm_s, slack->t));
  PetscCall(VecCopy(ip->given->warm_z, slack->z));
  PetscCall(IPRowScalePair(tao, slack->t, slack->z, PETSC_FALSE));
  PetscCall(IPSidesTakePairs(tao));
  PetscCall(WarmSolves(tao, &solves));
  if (solves) PetscFunctionReturn(0);
  PetscCall(WarmMismatch(tao, &mismatch));
  PetscCall(IPPairProducts(slack, 0.0, NULL, &average));
  average = PetscMax(average / slack->weight, 0.0);
  PetscCall(IPGetWork(tao, IP_INEQUALITIES, &q));
  PetscCall(VecQuotient_AMGF(q, ip->at.lambda, ip->stiff->rho));
  PetscCall(VecAYPX(q, -1.0, slack->t));
  PetscCall(MeanProduct(tao, q, &mean));
  ip->mu = PetscMax(average, mismatch * IP_WARM_MU * (mean > 0.0 ? mean : 1.0));
  PetscCall(IPSlackCentral(tao, q, ip->mu, slack->t, slack->z));
  PetscCall(IPRestoreWork(tao, IP_INEQUALITIES, &q));
  PetscCall(IPSlackCenterUpper(tao, ip->mu));
  PetscFunctionReturn(0);
}

/*
   Sets the multipliers of the bounds to mu / t. Without inequality constraints mu is chosen as
   well, from the work of the gradient on the way to the bounds.
*/
static PetscErrorCode StartBounds(Tao tao)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  PetscReal     x, mean;

  PetscFunctionBegin;
  if (!ip->mi && ip->opt->scaling == IP_SCALING_PROBLEM && ip->opt->start != IP_START_COLD) {
    PetscCall(VecNorm(tao->solution, NORM_INFINITY, &x));
    PetscCall(BoundsWork(tao, &mean));
    ip->mu = IP_PREDICT_MU * (mean > 0.0 ? mean : ip->stiff->hscale * (x > 0.0 ? x * x : 1.0));
  }
  PetscCall(IPBoundsCenter(tao));
  PetscFunctionReturn(0);
}

/*
   Sets the initial slacks, multipliers and mu. The Hessian at x must be evaluated, since the stiffness of the
   constraints depends on it.
*/
PetscErrorCode IPStartPoint(Tao tao)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  PetscCall(PetscLogEventBegin(TAO_IPFilterStart, tao, NULL, NULL, NULL));
  for (PetscInt b = IP_LOWER; b <= IP_UPPER; b++)
    if (ip->pair[b].n) PetscCall(VecSet(ip->pair[b].z, 0.0));
  if (ip->opt->start == IP_START_COLD || !ip->mi) PetscCall(StartCold(tao));
  else if (ip->opt->start == IP_START_WARM && ip->given->warm_s) PetscCall(StartWarm(tao));
  else PetscCall(StartPredicted(tao));
  PetscCall(StartBounds(tao));
  if (ip->me) PetscCall(IPEqualityMultipliers(tao));
  PetscCall(IPBarrierAverage(tao, &ip->bar->first));
  ip->bar->first = PetscMax(ip->bar->first, ip->mu);
  PetscCall(PetscLogEventEnd(TAO_IPFilterStart, tao, NULL, NULL, NULL));
  PetscFunctionReturn(0);
}
