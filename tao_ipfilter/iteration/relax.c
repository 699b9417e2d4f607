/*
   Relaxes constraints whose feasible set has no interior, such as x >= 0, y >= 0, -x y >= 0. No central path leads to
   the solutions of such problems, and slacks vanish before mu does. All inequality constraints are then relaxed to c_I
   + r >= 0 and, if there are equality constraints, all bounds as well. r is a hundredth of the tolerance times the size
   of the constraints. (Waechter and Biegler 2006, section 3.5, relax all problems from the start, and by more.)
*/
#include "iterationimpl.h"
#include "tao_ipfilter/solver/barrier.h"
#include "tao_ipfilter/solver/constants.h"
#include "tao_ipfilter/solver/kkt.h"
#include "tao_ipfilter/solver/options.h"
#include "tao_ipfilter/solver/record.h"
#include "tao_ipfilter/solver/relaxation.h"
#include "tao_ipfilter/solver/search.h"
#include "tao_ipfilter/solver/sizes.h"

#define IP_RELAX_PART  1e-2 /* relaxation, as a fraction of the tolerance */
#define IP_RELAX_LARGE 1e4  /* a multiplier is large if it exceeds the one that balances the gradient by this factor */

/*
   Adds r to constraints and slacks, and moves the multipliers to the central path, since multipliers of vanishing
   slacks are useless
*/
static PetscErrorCode RelaxCenter(Tao tao, PetscReal r)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  IPPair       *p  = &ip->pair[IP_SLACK];

  PetscFunctionBegin;
  if (ip->mi) {
    PetscCall(VecShift(ip->at.c, r));
    PetscCall(VecShift(p->t, r));
    PetscCall(IPPairCenter(p, ip->mu));
    PetscCall(IPSidesUpdateWidth(tao));
    PetscCall(IPSlackCenterUpper(tao, ip->mu));
  }
  if (ip->relax->unknowns > 0.0) {
    PetscCall(IPBoundsDistance(tao, tao->solution, PETSC_FALSE));
    PetscCall(IPBoundsCenter(tao));
  }
  PetscFunctionReturn(0);
}

/* Returns the multiplier of one constraint that balances the objective's gradient, now or at the start */
static PetscReal RelaxBalance(const TAO_IPFILTER *ip)
{
  return PetscMax(ip->scale->balance, ip->first->pressure);
}

/*
   Finds whether the constraints have no interior. There are two signs. First, mu does not fall, and the multiplier of a
   slack on the central path is too large compared with the one that balances the gradient of the objective. Second, the
   multiplier of a bound is that large, and cancels the multiplier of an equality constraint.
   At infeasible points these signs occur temporarily; such points are excluded. Neither can be used where the objective
   is constant, since no multiplier is too large beside a gradient of zero, nor without scales.
*/
static PetscErrorCode RelaxVanished(Tao tao, PetscBool *vanished)
{
  TAO_IPFILTER   *ip  = (TAO_IPFILTER *)tao->data;
  const PetscReal met = 1e-4;
  PetscReal       gradient, times;

  PetscFunctionBegin;
  *vanished = PETSC_FALSE;
  PetscCall(VecNorm(tao->gradient, NORM_INFINITY, &gradient));
  if (ip->first->gradient == 0.0 && gradient == 0.0) PetscFunctionReturn(0);
  if (ip->opt->scaling == IP_SCALING_NONE || ip->kkt->primal > met) PetscFunctionReturn(0);
  if (ip->mi) *vanished = (PetscBool)(ip->mu > IP_RELAX_LARGE * ip->relax->least_slack * RelaxBalance(ip));
  if (*vanished || !ip->me) PetscFunctionReturn(0);
  if (!(ip->mu > IP_RELAX_LARGE * ip->relax->least_bound * gradient)) PetscFunctionReturn(0);
  PetscCall(IPCancellation(tao, &times));
  *vanished = (PetscBool)(times > IP_RELAX_LARGE);
  PetscFunctionReturn(0);
}

/*
   Computes the amounts of relaxation: `fraction` of the tolerance times the size of the constraints at the first
   relaxation, and times the size of the unknowns for bounds. The size of the constraints is that of the active ones,
   but their terms may vanish at the solution. It is at least their first size, limited by the terms of the largest
   unknown, since rows that never act may be huge.
*/
static PetscErrorCode RelaxChoose(Tao tao)
{
  TAO_IPFILTER   *ip    = (TAO_IPFILTER *)tao->data;
  const PetscReal terms = 10.0;
  PetscReal       size;
  Vec             r;

  PetscFunctionBegin;
  if (ip->mi) {
    PetscCall(IPOwnActiveSize(tao, &ip->relax->size));
    PetscCall(VecNorm(tao->solution, NORM_INFINITY, &size));
    size            = terms * ip->first->jacobian * PetscMax(size, ip->first->x);
    ip->relax->size = PetscMax(ip->relax->size, PetscMin(ip->first->length, size));
    if (!(ip->relax->size > 0.0)) ip->relax->size = PetscMax(ip->first->length, ip->scale->length);
  }
  ip->relax->by = ip->relax->told = IP_RELAX_PART * ip->tol * ip->relax->size;
  if (ip->mi) {
    PetscCall(IPGetWork(tao, IP_INEQUALITIES, &r));
    PetscCall(VecSet(r, ip->relax->by));
    PetscCall(IPRowScaleNorm(tao, IP_INEQUALITIES, r, &ip->relax->told));
    PetscCall(IPRestoreWork(tao, IP_INEQUALITIES, &r));
  }
  if (ip->me && (ip->pair[IP_LOWER].n || ip->pair[IP_UPPER].n)) {
    PetscCall(VecNorm(tao->solution, NORM_INFINITY, &size));
    ip->relax->unknowns = IP_RELAX_PART * ip->tol * size;
    ip->relax->told     = PetscMax(ip->relax->told, ip->relax->unknowns);
  }
  ip->relax->times++;
  PetscFunctionReturn(0);
}

/*
   Relaxes constraints and bounds by `fraction` of the tolerance times their size. Reduces mu such that large
   multipliers of the relaxed constraints are still possible.
*/
static PetscErrorCode RelaxConstraints(Tao tao)
{
  TAO_IPFILTER *ip    = (TAO_IPFILTER *)tao->data;
  PetscReal     limit = PETSC_INFINITY, gradient;

  PetscFunctionBegin;
  PetscCall(IPWatchdogEnd(ip->watch));
  PetscCall(RelaxChoose(tao));
  PetscCall(PetscInfo(tao, "No interior: constraints relaxed by %g\n", (double)ip->relax->told));
  if (ip->mi) limit = ip->relax->by * ip->scale->balance;
  if (ip->relax->unknowns > 0.0) {
    PetscCall(VecNorm(tao->gradient, NORM_INFINITY, &gradient));
    limit = PetscMin(limit, ip->relax->unknowns * gradient);
  }
  ip->mu = PetscMax(IPErrorBoundLeastMu(ip), PetscMin(ip->mu, IP_RELAX_LARGE * limit));
  PetscCall(RelaxCenter(tao, ip->relax->by));
  PetscCall(IPFilterSetReset(ip->filter));
  ip->rec->best_error = ip->rec->best_violation = PETSC_INFINITY;
  PetscCall(IPComputeKKT(tao));
  PetscFunctionReturn(0);
}

/* Returns whether the problem has constraints that may lack an interior and have not been relaxed */
PetscBool IPRelaxApplies(const TAO_IPFILTER *ip)
{
  return (PetscBool)(!ip->relax->times && (ip->mi || (ip->me && (ip->pair[IP_LOWER].n || ip->pair[IP_UPPER].n))));
}

/* Relaxes the constraints if RelaxVanished() has been true for several consecutive iterates */
PetscErrorCode IPRelax(Tao tao)
{
  TAO_IPFILTER  *ip       = (TAO_IPFILTER *)tao->data;
  const PetscInt patience = 3;
  PetscBool      vanished;

  PetscFunctionBegin;
  if (!IPRelaxApplies(ip) || ip->bar->free) PetscFunctionReturn(0);
  PetscCall(RelaxVanished(tao, &vanished));
  ip->relax->nvanished = vanished ? ip->relax->nvanished + 1 : 0;
  if (ip->relax->nvanished >= patience) PetscCall(RelaxConstraints(tao));
  PetscFunctionReturn(0);
}
