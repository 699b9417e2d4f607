/*
   A watchdog (Chamberlain, Powell, Lemarechal and Pedersen 1982; in IPOPT's implementation, Waechter and Biegler 2006,
   section 3.2). Where the line search has shortened many steps in a row, steps as long as the bounds allow are taken
   without test. If one of them is acceptable compared with the iterate at which that began, the iteration goes on from
   there. Otherwise it returns to that iterate, and the watchdog waits longer before it tries again.
*/
#include "stepimpl.h"
#include "tao_ipfilter/solver/barrier.h"
#include "tao_ipfilter/solver/quasinewton.h"
#include "tao_ipfilter/solver/search.h"

#define IP_WATCHDOG_PATIENCE 10 /* shortened steps in a row, at first */
#define IP_WATCHDOG_STEPS    3  /* steps without test */

/* Vectors like those of the other iterate; NULL where that has none */
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

/* Ends the steps without test, if there are any; the iteration goes on from the present iterate */
PetscErrorCode IPWatchdogEnd(IPWatchdog *watch)
{
  PetscFunctionBegin;
  PetscCall(IPIterateDestroy(&watch->from));
  watch->left = watch->nshort = 0;
  PetscFunctionReturn(0);
}

/* Begins steps without test if enough steps have been shortened; ends them if mu has changed. alpha: length of the
   first one; slope: derivative of the barrier function along it */
PetscErrorCode IPWatchdogBegin(Tao tao, PetscReal alpha, PetscReal slope)
{
  TAO_IPFILTER *ip    = (TAO_IPFILTER *)tao->data;
  IPWatchdog   *watch = ip->watch;

  PetscFunctionBegin;
  if (watch->left && watch->mu != ip->mu) PetscCall(IPWatchdogEnd(watch));
  if (watch->left || ip->bar->free || ip->qn->B) PetscFunctionReturn(0);
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

/* Returns to the iterate at which the steps without test began; *returned: whether there were any */
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
