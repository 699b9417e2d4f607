/*
   Warm start from the caller's multipliers of bounds and equality constraints. A problem that is already solved then
   ends at once.
*/
#include "iterationimpl.h"
#include "tao_ipfilter/solver/options.h"
#include "tao_ipfilter/solver/rows.h"
#include "tao_ipfilter/solver/stiffness.h"

/* Sets the pairs' multipliers of the bounds to the caller's, divided by the weights */
PetscErrorCode IPWarmSetBounds(Tao tao)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  for (PetscInt b = IP_LOWER; b <= IP_UPPER; b++) {
    IPPair *p     = &ip->pair[b];
    Vec     given = b == IP_LOWER ? ip->given->warm_lower : ip->given->warm_upper;

    if (!p->n || !given) continue;
    PetscCall(VecPointwiseDivide(p->z, given, p->w));
    PetscCall(VecAbs(p->z));
  }
  PetscFunctionReturn(0);
}

/*
   Returns whether the caller has given multipliers of all equality constraints, including those of rows with equal
   bounds
*/
PetscBool IPWarmEquality(const TAO_IPFILTER *ip)
{
  const PetscBool own = (PetscBool)(ip->me > ip->sides->nall);

  return (PetscBool)(ip->me && ip->opt->start == IP_START_WARM && (!own || ip->given->warm_y) &&
                     (!ip->sides->nall || ip->given->warm_s));
}

/* Sets the multipliers of the equality constraints to those that the caller has given, if any */
PetscErrorCode IPWarmSetEquality(Tao tao)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  if (ip->me > ip->sides->nall) PetscCall(IPSidesEquality(ip->given->warm_y, ip->at.y, PETSC_FALSE));
  if (ip->sides->nall) PetscCall(IPSidesTakeEquality(tao, ip->given->warm_z, ip->at.y));
  if (ip->rows->equality) PetscCall(VecPointwiseDivide(ip->at.y, ip->at.y, ip->rows->equality));
  PetscFunctionReturn(0);
}

/* Computes the mean distance to the bounds times the mean multiplier, over all bounds */
PetscErrorCode IPWarmMeanProduct(Tao tao, PetscReal *mean)
{
  TAO_IPFILTER *ip     = (TAO_IPFILTER *)tao->data;
  PetscReal     sum[2] = {0.0, 0.0}, count = 0.0;

  PetscFunctionBegin;
  for (PetscInt b = IP_LOWER; b <= IP_UPPER; b++) {
    const IPPair      *p = &ip->pair[b];
    const PetscScalar *t, *z;
    PetscInt           n;

    if (!p->n) continue;
    count += p->n;
    PetscCall(VecGetLocalSize(p->t, &n));
    PetscCall(VecGetArrayRead(p->t, &t));
    PetscCall(VecGetArrayRead(p->z, &z));
    for (PetscInt i = 0; i < n; i++) {
      if (PetscRealPart(t[i]) >= PETSC_INFINITY) continue;
      sum[0] += PetscRealPart(t[i]);
      sum[1] += PetscRealPart(z[i]);
    }
    PetscCall(VecRestoreArrayRead(p->z, &z));
    PetscCall(VecRestoreArrayRead(p->t, &t));
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sum, 2, MPIU_REAL, MPIU_SUM, PetscObjectComm((PetscObject)tao)));
  *mean = count > 0.0 ? sum[0] / count * (sum[1] / count) : 0.0;
  PetscFunctionReturn(0);
}

/*
   Moves pairs with a product far below mu to the central path. If z is large relative to the stiffness of the Hessian,
   z is unchanged and x moves; otherwise z changes. *moved: whether an x has moved on this rank.
*/
static PetscErrorCode WarmCenterPairs(Tao tao, IPPair *p, PetscReal mu, PetscBool *moved)
{
  const PetscReal    least = 1e-2;
  const PetscScalar *rho, *w;
  PetscScalar       *x, *t, *z;
  PetscInt           n;

  PetscFunctionBegin;
  PetscCall(VecGetLocalSize(p->t, &n));
  PetscCall(VecGetArrayRead(((TAO_IPFILTER *)tao->data)->stiff->hdiag, &rho));
  PetscCall(VecGetArrayRead(p->w, &w));
  PetscCall(VecGetArray(tao->solution, &x));
  PetscCall(VecGetArray(p->t, &t));
  PetscCall(VecGetArray(p->z, &z));
  for (PetscInt i = 0; i < n; i++) {
    const PetscReal stiffness = PetscRealPart(rho[i] / w[i]), before = PetscRealPart(t[i]);

    if (before >= PETSC_INFINITY || before * PetscRealPart(z[i]) >= least * mu) continue;
    if (PetscRealPart(z[i]) < PetscSqrtReal(mu * stiffness)) {
      if (before * before * stiffness < mu) t[i] = PetscSqrtReal(mu / stiffness);
      z[i] = mu / t[i];
    } else t[i] = mu / z[i];
    x[i] += p->sign * (t[i] - before);
    *moved = (PetscBool)(*moved || t[i] != before);
  }
  PetscCall(VecRestoreArray(p->z, &z));
  PetscCall(VecRestoreArray(p->t, &t));
  PetscCall(VecRestoreArray(tao->solution, &x));
  PetscCall(VecRestoreArrayRead(p->w, &w));
  PetscCall(VecRestoreArrayRead(((TAO_IPFILTER *)tao->data)->stiff->hdiag, &rho));
  PetscFunctionReturn(0);
}

/*
   Moves the pairs of all bounds to the central path, see WarmCenterPairs(). If x has moved, objective, constraints and
   derivatives are evaluated again.
*/
PetscErrorCode IPWarmCenterBounds(Tao tao)
{
  TAO_IPFILTER *ip    = (TAO_IPFILTER *)tao->data;
  PetscBool     moved = PETSC_FALSE;

  PetscFunctionBegin;
  for (PetscInt b = IP_LOWER; b <= IP_UPPER; b++)
    if (ip->pair[b].n) PetscCall(WarmCenterPairs(tao, &ip->pair[b], ip->mu, &moved));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &moved, 1, MPI_PETSCBOOL, MPI_LOR, PetscObjectComm((PetscObject)tao)));
  if (!moved) PetscFunctionReturn(0);
  PetscCall(IPBoundsDistance(tao, tao->solution, PETSC_FALSE));
  PetscCall(TaoComputeObjective(tao, tao->solution, &ip->at.f));
  PetscCall(IPEvaluateConstraints(tao, tao->solution, ip->at.c, ip->at.ce));
  PetscCall(IPEvaluateDerivatives(tao));
  PetscFunctionReturn(0);
}
