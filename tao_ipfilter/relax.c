/*
   Constraints without an interior, as x >= 0, y >= 0, -x y >= 0 are: no central path leads to their solutions, and slacks vanish
   before mu does. All inequality constraints are then relaxed, once, to c_I + r >= 0 with r the tolerance times their size (Waechter
   and Biegler 2006, section 3.5, who relax all problems from the start).
*/
#include "ipfilterimpl.h"

/* Slacks moved by r, and pairs put back on the central path: multipliers of vanishing slacks are of no use */
static PetscErrorCode Recenter(Tao tao, PetscReal r)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  IPPair       *p  = &ip->pair[IP_SLACK];

  PetscFunctionBegin;
  PetscCall(VecShift(ip->c, r));
  PetscCall(VecShift(p->t, r));
  PetscCall(VecSet(p->dt, 0.0));
  PetscCall(VecSet(p->z, 0.0));
  PetscCall(IPPairSetTarget(p, ip->mu, 0.0));
  PetscCall(IPPairDualDirection(p));
  PetscCall(VecCopy(p->dz, p->z));
  PetscCall(VecCopy(p->z, ip->lambda));
  PetscFunctionReturn(0);
}

/* Relaxes the constraints where a slack has vanished for some steps in a row though the KKT error has not */
PetscErrorCode IPRelax(Tao tao)
{
  TAO_IPFILTER  *ip   = (TAO_IPFILTER *)tao->data;
  const PetscInt most = 3;
  PetscReal      size;

  PetscFunctionBegin;
  if (!ip->mi || ip->relaxed > 0.0 || ip->free_mu) PetscFunctionReturn(0);
  ip->nvanished = ip->least_slack > IP_LEAST_SLACK * ip->scale.length ? 0 : ip->nvanished + 1;
  if (ip->nvanished < most) PetscFunctionReturn(0);
  PetscCall(VecNorm(ip->c, NORM_INFINITY, &size));
  ip->relaxed = ip->tol * PetscMax(size, ip->length0);
  PetscCall(PetscInfo(tao, "A slack is %g: no interior; constraints relaxed by %g\n", (double)ip->least_slack, (double)ip->relaxed));
  PetscCall(Recenter(tao, ip->relaxed));
  PetscCall(IPFilterSetReset(&ip->filter));
  ip->best_error = PETSC_INFINITY;
  PetscCall(IPComputeKKT(tao));
  PetscFunctionReturn(0);
}
