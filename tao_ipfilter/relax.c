/*
   Constraints without an interior, as x >= 0, y >= 0, -x y >= 0 are: no central path leads to their solutions, and slacks vanish
   before mu does. All inequality constraints are then relaxed, once, to c_I + r >= 0 with r the tolerance times their size (Waechter
   and Biegler 2006, section 3.5, who relax all problems from the start).
*/
#include "ipfilterimpl.h"

/* Slacks moved by r, and pairs put back on the central path: multipliers of vanishing slacks are of no use */
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

/* Relaxes the constraints where a slack has vanished for some steps in a row though the KKT error has not */
PetscErrorCode IPRelax(Tao tao)
{
  TAO_IPFILTER  *ip       = (TAO_IPFILTER *)tao->data;
  const PetscInt patience = 3;
  PetscReal      size;

  PetscFunctionBegin;
  if (!ip->mi || ip->relax.by > 0.0 || ip->bar.free) PetscFunctionReturn(0);
  ip->relax.nvanished = ip->relax.least_slack > IP_LEAST_SLACK * ip->scale.length ? 0 : ip->relax.nvanished + 1;
  if (ip->relax.nvanished < patience) PetscFunctionReturn(0);
  PetscCall(VecNorm(ip->at.c, NORM_INFINITY, &size));
  ip->relax.by = ip->tol * PetscMax(size, ip->first.length);
  PetscCall(PetscInfo(tao, "A slack is %g: no interior; constraints relaxed by %g\n", (double)ip->relax.least_slack, (double)ip->relax.by));
  PetscCall(RelaxCenter(tao, ip->relax.by));
  PetscCall(IPFilterSetReset(&ip->filter));
  ip->rec.best_error = PETSC_INFINITY;
  PetscCall(IPComputeKKT(tao));
  PetscFunctionReturn(0);
}
