/* The barrier parameter: Fiacco and McCormick's monotone reduction. */
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

/* Chooses mu for the next step and clears the filter where it changed */
PetscErrorCode IPBarrierUpdate(Tao tao)
{
  PetscFunctionBegin;
  PetscCall(Monotone(tao));
  PetscFunctionReturn(0);
}
