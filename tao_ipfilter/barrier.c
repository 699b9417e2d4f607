/* The barrier parameter: Fiacco and McCormick's monotone reduction, or Mehrotra's choice from the affine step. */
#include "ipfilterimpl.h"

/* Weighted mean of t z over all pairs */
PetscErrorCode IPBarrierAverage(Tao tao, PetscReal *average)
{
  TAO_IPFILTER *ip     = (TAO_IPFILTER *)tao->data;
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

/* Whether the barrier problem is solved well enough to reduce mu. In the relative measure the forces need balance only
   to the percents that the linear solves aim at: pairs, not forces, follow mu. */
static PetscBool Solved(const TAO_IPFILTER *ip, PetscReal mu)
{
  const IPKKT    *k    = &ip->kkt;
  const PetscReal most = ip->kappa_epsilon * mu;

  if (ip->measure == IP_KKT_MASS) return (PetscBool)(k->barrier <= most);
  return (PetscBool)(k->centrality <= most && k->primal <= most && k->dual <= PetscMax(most, ip->kappa_dual));
}

/* mu+ = max(tol/10, min(kappa_mu mu, mu^theta_mu)), mu in units of the scale of products */
static PetscErrorCode Monotone(Tao tao)
{
  TAO_IPFILTER  *ip    = (TAO_IPFILTER *)tao->data;
  const PetscInt most  = tao->niter ? ip->max_mu_later : ip->max_mu_first;

  PetscFunctionBegin;
  for (PetscInt k = 0; k < most; k++) {
    const PetscReal unit = ip->scale.product, mu = ip->mu / unit;
    const PetscReal next = PetscMax(ip->tol / 10.0, PetscMin(ip->kappa_mu * mu, PetscPowReal(mu, ip->theta_mu)));

    if (!Solved(ip, mu) || next >= mu) break;
    ip->mu = next * unit;
    PetscCall(IPFilterSetReset(&ip->filter));
    PetscCall(IPComputeKKT(tao));
  }
  PetscFunctionReturn(0);
}

/* Mehrotra's choice: mu = sigma times the mean product, sigma the cube of what a step towards mu = 0 leaves of it.
   The second-order term counts for no more than the mean product. */
PetscErrorCode IPBarrierFromAffine(Tao tao)
{
  TAO_IPFILTER *ip    = (TAO_IPFILTER *)tao->data;
  PetscReal     after = 0.0, before = 0.0, primal = 1.0, dual = 1.0, sigma;

  PetscFunctionBegin;
  PetscCall(IPFractionToBoundary(tao, 1.0, &primal, &dual));
  for (PetscInt b = 0; b < IP_NPAIRS; b++) {
    PetscReal now, next;

    PetscCall(IPPairProducts(&ip->pair[b], 0.0, NULL, &now));
    PetscCall(IPPairStepProducts(&ip->pair[b], primal, dual, NULL, &next));
    before += now;
    after += next;
  }
  ip->corrector_max = 0.0;
  if (!(before > 0.0)) PetscFunctionReturn(0);
  sigma = PetscMin(PetscPowReal(PetscMax(after, 0.0) / before, 3.0), 1.0);
  PetscCall(IPBarrierAverage(tao, &before));
  ip->corrector_max = 100.0 * before;
  ip->mu            = PetscMax(sigma * before, ip->tol / 10.0 * ip->scale.product);
  PetscCall(IPFilterSetReset(&ip->filter));
  PetscFunctionReturn(0);
}

/* Whether the KKT error is below the worst of the last iterates in free mode, which it then replaces there
   (Nocedal, Waechter and Waltz 2009, section 4) */
static PetscBool Progress(TAO_IPFILTER *ip)
{
  const PetscInt length = (PetscInt)PETSC_STATIC_ARRAY_LENGTH(ip->error_history);
  PetscReal      worst  = 0.0;

  for (PetscInt k = 0; k < PetscMin(ip->nerror, length); k++) worst = PetscMax(worst, ip->error_history[k]);
  if (ip->nerror >= length && ip->kkt.error > ip->kappa_progress * worst) return PETSC_FALSE;
  ip->error_history[ip->nerror++ % length] = ip->kkt.error;
  return PETSC_TRUE;
}

/* Leaves Mehrotra's method for the monotone one, with a mu near the present products */
static PetscErrorCode Hold(Tao tao)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  ip->free_mu = PETSC_FALSE;
  PetscCall(IPBarrierAverage(tao, &ip->mu));
  ip->mu = PetscMax(0.8 * ip->mu, ip->tol / 10.0 * ip->scale.product);
  PetscCall(IPFilterSetReset(&ip->filter));
  PetscCall(IPComputeKKT(tao));
  PetscFunctionReturn(0);
}

/* The same for some iterations at least, whatever progress there is */
PetscErrorCode IPBarrierHold(Tao tao, PetscInt iterations)
{
  PetscFunctionBegin;
  ((TAO_IPFILTER *)tao->data)->hold = iterations;
  PetscCall(Hold(tao));
  PetscFunctionReturn(0);
}

/* Chooses mu for the next step and clears the filter where it changed. Mehrotra's method is one for convex objectives and linear
   constraints, whose affine step tells what mu can become: it is left for the monotone one where they show themselves as
   something else, and while the KKT error does not fall. */
PetscErrorCode IPBarrierUpdate(Tao tao)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  PetscBool     was_free;

  PetscFunctionBegin;
  if (ip->barrier == IP_BARRIER_MONOTONE) {
    PetscCall(Monotone(tao));
    PetscFunctionReturn(0);
  }
  was_free    = ip->free_mu;
  ip->free_mu = (PetscBool)(Progress(ip) && ip->hold == 0 && !ip->curved);
  if (ip->hold > 0) ip->hold--;
  if (ip->free_mu) PetscFunctionReturn(0);
  if (was_free) PetscCall(Hold(tao));
  else PetscCall(Monotone(tao));
  PetscFunctionReturn(0);
}
