/*
   Constraints without an interior, such as x >= 0, y >= 0, -x y >= 0, have no central path that leads to their
   solutions; slacks vanish before mu does. All inequality constraints are then relaxed to c_I + r >= 0, where r is a
   hundredth of the tolerance times their size. (Waechter and Biegler 2006, section 3.5, relax all problems from the
   start, and by more.)
*/
#include "stepimpl.h"

#define IP_RELAX_FIRST 1e-2 /* first relaxation, as a fraction of the tolerance */
#define IP_RELAX_LARGE 1e4  /* a multiplier is large if it exceeds the one that balances the gradient by this factor */

/* Adds r to the slacks and moves pairs to the central path, because multipliers of vanishing slacks are useless */
static PetscErrorCode RelaxCenter(Tao tao, PetscReal r)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  IPPair       *p  = &ip->pair[IP_SLACK];

  PetscFunctionBegin;
  PetscCall(VecShift(ip->at.c, r));
  PetscCall(VecShift(p->t, r));
  PetscCall(IPPairCenter(p, ip->mu));
  PetscCall(IPSidesUpdateWidth(tao));
  PetscCall(IPSlackCenterUpper(tao, ip->mu));
  PetscFunctionReturn(0);
}

/* Whether the smallest slack is as small as rounding */
static PetscBool RelaxRounding(const TAO_IPFILTER *ip)
{
  return (PetscBool)(ip->relax.least_slack <= IP_LEAST_SLACK * ip->scale.length);
}

/* Whether a slack has vanished: it is as small as rounding; or its multiplier on the central path, at a mu that no
   longer falls, is far larger than what balances the objective's gradient, which does not happen if there is an
   interior. Far from feasible points this can happen temporarily. Without scales the balance is unknown. */
static PetscBool RelaxVanished(const TAO_IPFILTER *ip)
{
  const PetscReal met = 1e-4;

  if (ip->opt.scaling == IP_SCALING_NONE) return RelaxRounding(ip);
  return (PetscBool)(RelaxRounding(ip) ||
                     (ip->kkt.primal <= met && ip->mu > IP_RELAX_LARGE * ip->relax.least_slack * ip->scale.balance));
}

/* Relaxes the constraints by a fraction of the tolerance times their size, which is measured at the first
   relaxation. mu is limited so that the multipliers fit the new width. */
static PetscErrorCode RelaxConstraints(Tao tao, PetscReal fraction)
{
  TAO_IPFILTER   *ip     = (TAO_IPFILTER *)tao->data;
  const PetscReal before = ip->relax.by;

  PetscFunctionBegin;
  if (!ip->relax.times) {
    PetscCall(IPOwnActiveSize(tao, &ip->relax.size));
    ip->relax.size = PetscMax(ip->relax.size, ip->first.length);
    if (!(ip->relax.size > 0.0)) ip->relax.size = ip->scale.length;
  }
  ip->relax.times++;
  ip->relax.by = fraction * ip->tol * ip->relax.size;
  PetscCall(PetscInfo(tao, "A slack is %g: no interior; constraints relaxed by %g\n", (double)ip->relax.least_slack,
    (double)ip->relax.by));
  ip->mu = PetscMax(IPErrorBoundLeastMu(ip), PetscMin(ip->mu, IP_RELAX_LARGE * ip->relax.by * ip->scale.balance));
  PetscCall(RelaxCenter(tao, ip->relax.by - before));
  PetscCall(IPFilterSetReset(&ip->filter));
  ip->rec.best_error = ip->rec.best_violation = PETSC_INFINITY;
  PetscCall(IPComputeKKT(tao));
  PetscFunctionReturn(0);
}

/* Relaxes the constraints if a slack has vanished for several steps although the KKT error has not */
PetscErrorCode IPRelax(Tao tao)
{
  TAO_IPFILTER  *ip       = (TAO_IPFILTER *)tao->data;
  const PetscInt patience = 3;

  PetscFunctionBegin;
  if (!ip->mi || ip->relax.times || ip->bar.free) PetscFunctionReturn(0);
  ip->relax.nvanished = RelaxVanished(ip) ? ip->relax.nvanished + 1 : 0;
  if (ip->relax.nvanished >= patience) PetscCall(RelaxConstraints(tao, IP_RELAX_FIRST));
  PetscFunctionReturn(0);
}

/* Relaxes, if no next step was found, as soon as a slack has vanished; a second time by the full tolerance */
PetscErrorCode IPRelaxInstead(Tao tao, PetscBool *relaxed)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  *relaxed = (PetscBool)(ip->mi && ip->relax.times < 2 && RelaxVanished(ip));
  if (*relaxed) PetscCall(RelaxConstraints(tao, ip->relax.times ? 1.0 : IP_RELAX_FIRST));
  PetscFunctionReturn(0);
}
