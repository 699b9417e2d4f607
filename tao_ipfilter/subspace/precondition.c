/*
   The direction d for a residual r: an approximate solution of K d = r. If B is a factorization of K, it is B r.
   Otherwise a few steps of CG, preconditioned by B, compute it, because a step of CG costs less than a direction: it
   needs no reduced problem and no products with the other directions.
*/
#include "subspaceimpl.h"
#include "tao_ipfilter/solver/matrices.h"
#include "tao_ipfilter/solver/record.h"
#include "tao_ipfilter/solver/stiffness.h"
#include "tao_ipfilter/solver/terms.h"

/* Computes z = B r, and q = K z approximately unless q is NULL. *product: r^T B r */
static PetscErrorCode PreconditionApply(Tao tao, IPRecycle *recycle, Vec r, Vec z, Vec q, PetscReal *product)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  PetscBool     amgf;
  PetscScalar   rz;

  PetscFunctionBegin;
  PetscCall(PetscObjectTypeCompare((PetscObject)recycle->pc, PCAMGF, &amgf));
  PetscCall(PetscLogEventBegin(TAO_IPFilterApply, tao, r, z, NULL));
  if (q && amgf && !ip->fixed) PetscCall(PCAMGFApplyProduct(recycle->pc, r, z, q));
  else {
    PetscCall(PCApply(recycle->pc, r, z));
    PetscCall(IPFixedZero(tao, z));
    if (q) PetscCall(MatMult(ip->hess->H, z, q));
  }
  PetscCall(PetscLogEventEnd(TAO_IPFilterApply, tao, r, z, NULL));
  PetscCall(VecDot(r, z, &rz));
  *product = PetscRealPart(rz);
  ip->rec->napplications++;
  ip->rec->ksp_iterations[ip->rec->nksp - 1]++;
  tao->ksp_its++;
  tao->ksp_tot_its++;
  PetscFunctionReturn(0);
}

/*
   Finds whether K is singular up to rounding, or negative, along a preconditioned residual d. Together with the
   constraints K may still be positive, for example for bodies under pressure that are held by contact only. Newton's
   method without norm terms shifts a negative K instead; *singular is then false. energy: d^T K d
*/
static PetscErrorCode PreconditionFindSingular(Tao tao, Vec d, PetscReal energy, PetscBool *singular,
  PetscBool *negative)
{
  TAO_IPFILTER   *ip       = (TAO_IPFILTER *)tao->data;
  const PetscReal rounding = 1e-11;
  PetscScalar     size;
  Vec             work;

  PetscFunctionBegin;
  PetscCall(IPGetWork(tao, IP_UNKNOWNS, &work));
  PetscCall(VecPointwiseMult(work, d, ip->stiff->hdiag));
  PetscCall(VecDot(d, work, &size));
  PetscCall(IPRestoreWork(tao, IP_UNKNOWNS, &work));
  *singular = (PetscBool) !(energy > rounding * PetscRealPart(size));
  *negative = (PetscBool)(energy < -rounding * PetscRealPart(size));
  if (*negative && IPSubspaceOf(tao)->newton && !ip->terms->n) *singular = PETSC_FALSE;
  PetscFunctionReturn(0);
}

/* Computes the energy d^T K d of the preconditioned residual d = B r. product: r^T B r, which is about the energy, but
   positive where K is negative and B is not. first: whether d is the first one of this solve */
static PetscErrorCode PreconditionEnergy(Tao tao, PetscReal product, PetscBool first, Vec d, PetscReal *energy)
{
  PetscScalar dot;
  Vec         Kd;

  PetscFunctionBegin;
  *energy = product;
  if (product > 0.0 && !first) PetscFunctionReturn(0);
  PetscCall(IPGetWork(tao, IP_UNKNOWNS, &Kd));
  PetscCall(MatMult(((TAO_IPFILTER *)tao->data)->hess->H, d, Kd));
  PetscCall(VecDot(d, Kd, &dot));
  PetscCall(IPRestoreWork(tao, IP_UNKNOWNS, &Kd));
  *energy = PetscRealPart(dot);
  PetscFunctionReturn(0);
}

/*
   Improves d = B r by steps of CG for K d = r. The solution with constraints differs from that of K d = r, so that an
   accurate d is of no use. If a step has reduced the B-norm of the residual to a half, B is good, and one more step is
   the last. product: r^T B r; q: K d on entry, then work. If K is not positive along a direction of CG, d is that
   direction, so that the caller finds this out.
*/
static PetscErrorCode PreconditionImprove(Tao tao, IPRecycle *recycle, PetscReal product, Vec r, Vec d, Vec q)
{
  const PetscReal half = 0.5;
  const PetscInt  most = 5;
  PetscReal       last = product;
  PetscScalar     energy;
  PetscBool       end = PETSC_FALSE;
  Vec             p, s, z, w;

  PetscFunctionBegin;
  PetscCall(IPGetWork(tao, IP_UNKNOWNS, &p));
  PetscCall(IPGetWork(tao, IP_UNKNOWNS, &s));
  PetscCall(IPGetWork(tao, IP_UNKNOWNS, &z));
  PetscCall(IPGetWork(tao, IP_UNKNOWNS, &w));
  PetscCall(VecCopy(d, p));
  PetscCall(VecCopy(r, s));
  PetscCall(VecSet(d, 0.0));
  for (PetscInt k = 1;; k++) {
    PetscCall(VecDot(p, q, &energy));
    if (!(PetscRealPart(energy) > 0.0) || PetscIsInfOrNanReal(PetscRealPart(energy))) {
      PetscCall(VecCopy(p, d));
      break;
    }
    PetscCall(VecAXPY(d, product / energy, p));
    if (end || k == most) break;
    PetscCall(VecAXPY(s, -product / energy, q));
    PetscCall(IPFixedZero(tao, s));
    PetscCall(PreconditionApply(tao, recycle, s, z, w, &product));
    if (!(product > 0.0) || PetscIsInfOrNanReal(product)) break;
    PetscCall(VecAYPX(p, product / last, z));
    PetscCall(VecAYPX(q, product / last, w));
    end  = (PetscBool)(product <= PetscSqr(half) * last);
    last = product;
  }
  PetscCall(IPRestoreWork(tao, IP_UNKNOWNS, &w));
  PetscCall(IPRestoreWork(tao, IP_UNKNOWNS, &z));
  PetscCall(IPRestoreWork(tao, IP_UNKNOWNS, &s));
  PetscCall(IPRestoreWork(tao, IP_UNKNOWNS, &p));
  PetscFunctionReturn(0);
}

/*
   Finds whether steps of CG improve d = B r: not if B is exact, or belongs to another matrix than K. Nor in Newton's
   method, whose models are solved to a large tolerance: steps of CG then go beyond what a model needs.
*/
static PetscErrorCode PreconditionMayImprove(Tao tao, const IPRecycle *recycle, PetscBool *may)
{
  PetscBool amgf, factored = PETSC_FALSE;

  PetscFunctionBegin;
  PetscCall(PetscObjectTypeCompare((PetscObject)recycle->pc, PCAMGF, &amgf));
  if (amgf) PetscCall(PCAMGFGetFactored(recycle->pc, &factored));
  *may = (PetscBool)(!factored && !recycle->held && !IPSubspaceOf(tao)->newton);
  PetscFunctionReturn(0);
}

/*
   Computes the direction d for the residual r, which is zero on W. If K alone is singular along B r, B is set up
   again with the constraints. *definite: false if r^T B r is not positive.
*/
PetscErrorCode IPSubspacePrecondition(Tao tao, IPRecycle *recycle, Vec r, Vec d, PetscBool *definite)
{
  const PetscInt before   = ((TAO_IPFILTER *)tao->data)->rec->napplications;
  PetscBool      singular = PETSC_FALSE, negative = PETSC_FALSE, possible = PETSC_TRUE, improve = PETSC_FALSE;
  PetscReal      product, energy;
  Vec            q;

  PetscFunctionBegin;
  PetscCall(IPRecycleReconsider(tao, recycle, &possible));
  *definite = possible;
  if (!possible) PetscFunctionReturn(0);
  PetscCall(PreconditionMayImprove(tao, recycle, &improve));
  PetscCall(IPGetWork(tao, IP_UNKNOWNS, &q));
  PetscCall(PreconditionApply(tao, recycle, r, d, improve ? q : NULL, &product));
  *definite = (PetscBool)(product > 0.0 && !PetscIsInfOrNanReal(product));
  if (!recycle->held) {
    PetscCall(PreconditionEnergy(tao, product, (PetscBool)!before, d, &energy));
    PetscCall(PreconditionFindSingular(tao, d, energy, &singular, &negative));
  }
  if (singular) {
    PetscCall(IPRecycleHold(tao, recycle, &possible));
    recycle->negative = negative;
    if (possible) PetscCall(PreconditionApply(tao, recycle, r, d, NULL, &product));
    *definite = (PetscBool)(possible && product > 0.0 && !PetscIsInfOrNanReal(product));
  } else if (*definite && improve) PetscCall(PreconditionImprove(tao, recycle, product, r, d, q));
  PetscCall(IPRestoreWork(tao, IP_UNKNOWNS, &q));
  PetscFunctionReturn(0);
}
