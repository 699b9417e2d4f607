/*
   Watchdog (Chamberlain, Powell, Lemarechal and Pedersen 1982; implemented as in IPOPT, Waechter and Biegler 2006,
   section 3.2). If the line search has shortened many consecutive steps, a few steps are taken without a test, as long
   as the bounds allow. If one of the new points is acceptable compared with the iterate at which these steps began, the
   iteration continues from it. Otherwise the iteration returns to that iterate, and more shortened steps are needed
   before the next attempt.
*/
#include "iterationimpl.h"
#include "tao_ipfilter/solver/barrier.h"
#include "tao_ipfilter/solver/search.h"

#define IP_WATCHDOG_PATIENCE 10 /* number of consecutive shortened steps before the first attempt */
#define IP_WATCHDOG_STEPS    3  /* number of steps that are accepted without a test in an attempt */

/* Creates a vector like `from`; nothing if `from` is NULL */
static PetscErrorCode WatchdogDuplicate(Vec from, Vec *to)
{
  PetscFunctionBegin;
  if (from) PetscCall(VecDuplicate(from, to));
  PetscFunctionReturn(0);
}

static PetscErrorCode WatchdogKeep(const IPIterate *at, IPIterate *kept)
{
  PetscFunctionBegin;
  PetscCall(WatchdogDuplicate(at->x, &kept->x));
  PetscCall(WatchdogDuplicate(at->c, &kept->c));
  PetscCall(WatchdogDuplicate(at->ce, &kept->ce));
  PetscCall(WatchdogDuplicate(at->s, &kept->s));
  PetscCall(WatchdogDuplicate(at->lambda, &kept->lambda));
  PetscCall(WatchdogDuplicate(at->y, &kept->y));
  for (PetscInt b = 0; b < IP_NPAIRS; b++) PetscCall(WatchdogDuplicate(at->z[b], &kept->z[b]));
  PetscCall(IPIterateCopy(at, kept));
  PetscFunctionReturn(0);
}

/* Ends the steps without a test, if there are any. The iteration continues from the present iterate. */
PetscErrorCode IPWatchdogEnd(IPWatchdog *watch)
{
  PetscFunctionBegin;
  PetscCall(IPIterateDestroy(&watch->from));
  watch->left = watch->nshort = 0;
  PetscFunctionReturn(0);
}

/*
   Begins the steps without a test if enough consecutive steps were shortened; ends them if mu has changed. alpha:
   length of the first of these steps; slope: derivative of the barrier function along it.
*/
PetscErrorCode IPWatchdogBegin(Tao tao, PetscReal alpha, PetscReal slope)
{
  TAO_IPFILTER *ip    = (TAO_IPFILTER *)tao->data;
  IPWatchdog   *watch = ip->watch;

  PetscFunctionBegin;
  if (watch->left && watch->mu != ip->mu) PetscCall(IPWatchdogEnd(watch));
  if (watch->left || ip->bar->free) PetscFunctionReturn(0);
  if (!watch->patience) watch->patience = IP_WATCHDOG_PATIENCE;
  if (watch->nshort < watch->patience) PetscFunctionReturn(0);
  PetscCall(WatchdogKeep(&ip->at, &watch->from));
  watch->left  = IP_WATCHDOG_STEPS;
  watch->mu    = ip->mu;
  watch->theta = ip->search->theta;
  watch->phi   = ip->search->phi;
  watch->slope = slope;
  watch->alpha = alpha;
  PetscFunctionReturn(0);
}

/* Returns to the iterate at which the steps without a test began. *returned: false if there are no such steps. */
PetscErrorCode IPWatchdogReturn(Tao tao, PetscBool *returned)
{
  TAO_IPFILTER *ip    = (TAO_IPFILTER *)tao->data;
  IPWatchdog   *watch = ip->watch;

  PetscFunctionBegin;
  *returned = (PetscBool)(watch->left > 0);
  if (!*returned) PetscFunctionReturn(0);
  PetscCall(IPIterateCopy(&watch->from, &ip->at));
  PetscCall(IPBoundsDistance(tao, tao->solution, PETSC_FALSE));
  if (ip->mi) PetscCall(IPSlackDistance(tao, ip->at.s, PETSC_FALSE));
  PetscCall(IPWatchdogEnd(watch));
  watch->patience *= 2;
  ip->search->alpha = ip->search->alpha_dual = 0.0;
  ip->search->tag                            = 'w';
  PetscFunctionReturn(0);
}
