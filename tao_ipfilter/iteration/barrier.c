/* Chooses the barrier parameter: Fiacco and McCormick's monotone rule, or Mehrotra's rule from the affine step */
#include "iterationimpl.h"
#include "tao_ipfilter/solver/barrier.h"
#include "tao_ipfilter/solver/constants.h"
#include "tao_ipfilter/solver/kkt.h"
#include "tao_ipfilter/solver/options.h"
#include "tao_ipfilter/solver/search.h"
#include "tao_ipfilter/solver/sizes.h"

/* Computes the weighted mean of t z over all pairs */
PetscErrorCode IPBarrierAverage(Tao tao, PetscReal *average)
{
  TAO_IPFILTER *ip    = (TAO_IPFILTER *)tao->data;
  PetscReal     total = 0.0, weight = 0.0;

  PetscFunctionBegin;
  for (PetscInt b = 0; b < IP_NPAIRS; b++) {
    PetscReal sum;

    PetscCall(IPPairProducts(&ip->pair[b], 0.0, NULL, &sum));
    total += sum;
    if (ip->pair[b].n) weight += ip->pair[b].weight;
  }
  *average = weight > 0.0 ? total / weight : 0.0;
  PetscFunctionReturn(0);
}

/*
   Returns whether the barrier problem is solved well enough to reduce mu. With the relative measure the forces need to
   balance only to a few per cent, which is also the accuracy of the linear solves.
*/
static PetscBool BarrierSolved(const TAO_IPFILTER *ip, PetscReal mu)
{
  const IPKKT    *k       = ip->kkt;
  const PetscReal limit   = IP_KAPPA_EPSILON * mu,
                  balance = ip->opt->measure == IP_KKT_MASS ? limit : PetscMax(limit, IP_KAPPA_DUAL);

  return (PetscBool)(k->centrality <= limit && k->primal <= PetscMax(limit, ip->tol) && k->dual <= balance);
}

/*
   Reduces mu by the monotone rule: mu+ = max(least mu, min(kappa_mu mu, mu^theta_mu)), with mu in units of
   scale->product. The rule is repeated as long as the new barrier problem is already solved well enough.
*/
static PetscErrorCode BarrierMonotone(Tao tao)
{
  TAO_IPFILTER  *ip    = (TAO_IPFILTER *)tao->data;
  const PetscInt limit = tao->niter ? IP_MU_REDUCTIONS : ip->opt->max_mu_first;

  PetscFunctionBegin;
  for (PetscInt k = 0; k < limit; k++) {
    const PetscReal unit = ip->scale->product, mu = ip->mu / unit;
    const PetscReal next =
      PetscMax(IPErrorBoundLeastMu(ip) / unit, PetscMin(IP_KAPPA_MU * mu, PetscPowReal(mu, IP_THETA_MU)));

    if (!BarrierSolved(ip, mu) || next >= mu) break;
    ip->mu = next * unit;
    PetscCall(IPFilterSetReset(ip->filter));
    PetscCall(IPComputeKKT(tao));
  }
  PetscFunctionReturn(0);
}

/*
   Chooses mu by Mehrotra's rule: mu = sigma times the mean product t z. sigma is the cube of the fraction of the mean
   product that remains after an affine step (mu = 0). The second-order term is limited to a hundred times the mean
   product.
*/
PetscErrorCode IPBarrierFromAffine(Tao tao)
{
  TAO_IPFILTER *ip    = (TAO_IPFILTER *)tao->data;
  PetscReal     after = 0.0, before = 0.0, primal = 1.0, dual = 1.0, sigma;

  PetscFunctionBegin;
  PetscCall(IPFractionToBoundary(tao, IP_SLACK, 1.0, &primal, &dual));
  for (PetscInt b = 0; b < IP_NPAIRS; b++) {
    PetscReal now, next;

    PetscCall(IPPairProducts(&ip->pair[b], 0.0, NULL, &now));
    PetscCall(IPPairStepProducts(&ip->pair[b], primal, dual, NULL, &next));
    before += now;
    after += next;
  }
  ip->bar->corrector_max = 0.0;
  if (!(before > 0.0)) PetscFunctionReturn(0);
  sigma = PetscMin(PetscPowReal(PetscMax(after, 0.0) / before, 3.0), 1.0);
  PetscCall(IPBarrierAverage(tao, &before));
  ip->bar->corrector_max = 100.0 * before;
  ip->mu                 = PetscMax(sigma * before, IPErrorBoundLeastMu(ip));
  PetscCall(IPFilterSetReset(ip->filter));
  PetscFunctionReturn(0);
}

/*
   Returns whether the KKT error is below the largest of the last iterates with Mehrotra's rule. If so, it replaces the
   oldest of these errors (Nocedal, Waechter and Waltz 2009, section 4).
*/
static PetscBool BarrierProgresses(TAO_IPFILTER *ip)
{
  const PetscInt length = (PetscInt)PETSC_STATIC_ARRAY_LENGTH(ip->bar->errors);
  PetscReal      worst  = 0.0;

  for (PetscInt k = 0; k < PetscMin(ip->bar->nerrors, length); k++) worst = PetscMax(worst, ip->bar->errors[k]);
  if (ip->bar->nerrors >= length && ip->kkt->error > IP_KAPPA_PROGRESS * worst) return PETSC_FALSE;
  ip->bar->errors[ip->bar->nerrors++ % length] = ip->kkt->error;
  return PETSC_TRUE;
}

/*
   Changes from Mehrotra's rule to the monotone rule. The new mu is near the present mean product, but at most a few
   times the mean at the start.
*/
static PetscErrorCode BarrierTurnMonotone(Tao tao)
{
  TAO_IPFILTER   *ip     = (TAO_IPFILTER *)tao->data;
  const PetscReal growth = 3.0;

  PetscFunctionBegin;
  ip->bar->free = PETSC_FALSE;
  PetscCall(IPBarrierAverage(tao, &ip->mu));
  ip->mu = PetscMax(PetscMin(0.8 * ip->mu, growth * ip->bar->first), IPErrorBoundLeastMu(ip));
  PetscCall(IPFilterSetReset(ip->filter));
  PetscCall(IPComputeKKT(tao));
  PetscFunctionReturn(0);
}

/* Changes to the monotone rule for at least this many iterations */
PetscErrorCode IPBarrierHold(Tao tao, PetscInt iterations)
{
  PetscFunctionBegin;
  ((TAO_IPFILTER *)tao->data)->bar->hold = iterations;
  PetscCall(BarrierTurnMonotone(tao));
  PetscFunctionReturn(0);
}

/*
   Chooses mu for the next step, and clears the filter if mu changed. Mehrotra's rule suits convex objectives with
   linear constraints, for which the affine step predicts mu. The monotone rule is used for other problems, and while
   the KKT error does not fall.
*/
PetscErrorCode IPBarrierUpdate(Tao tao)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  PetscBool     was_free;

  PetscFunctionBegin;
  if (ip->opt->barrier == IP_BARRIER_MONOTONE) {
    PetscCall(BarrierMonotone(tao));
    PetscFunctionReturn(0);
  }
  was_free      = ip->bar->free;
  ip->bar->free = (PetscBool)(BarrierProgresses(ip) && ip->bar->hold == 0 && !ip->bar->curved);
  if (ip->bar->hold > 0) ip->bar->hold--;
  if (ip->bar->free) PetscFunctionReturn(0);
  if (was_free) PetscCall(BarrierTurnMonotone(tao));
  else PetscCall(BarrierMonotone(tao));
  PetscFunctionReturn(0);
}
