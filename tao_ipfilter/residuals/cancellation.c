/*
   Detects forces of constraints that cancel one another, which indicates that the solution has no bounded multipliers
*/
#include "residualsimpl.h"
#include "tao_ipfilter/solver/matrices.h"
#include "tao_ipfilter/solver/sizes.h"

/* Adds |J|^T |M multiplier| to r. weights: the diagonal of M; NULL: M is the identity. */
static PetscErrorCode CancellationAddForces(Tao tao, IPSpace space, Mat J, Vec multiplier, Vec weights, Vec r)
{
  const PetscScalar *z;
  PetscInt           rstart, rend;
  Vec                force;

  PetscFunctionBegin;
  PetscCall(IPGetWork(tao, space, &force));
  PetscCall(VecCopy(multiplier, force));
  if (weights) PetscCall(VecPointwiseMult(force, force, weights));
  PetscCall(MatGetOwnershipRange(J, &rstart, &rend));
  PetscCall(VecGetArrayRead(force, &z));
  for (PetscInt i = rstart; i < rend; i++) {
    const PetscScalar *v;
    const PetscInt    *column;
    PetscInt           n;

    PetscCall(MatGetRow(J, i, &n, &column, &v));
    for (PetscInt k = 0; k < n; k++)
      PetscCall(VecSetValue(r, column[k], PetscAbsScalar(v[k] * z[i - rstart]), ADD_VALUES));
    PetscCall(MatRestoreRow(J, i, &n, &column, &v));
  }
  PetscCall(VecRestoreArrayRead(force, &z));
  PetscCall(IPRestoreWork(tao, space, &force));
  PetscCall(VecAssemblyBegin(r));
  PetscCall(VecAssemblyEnd(r));
  PetscFunctionReturn(0);
}

/*
   Computes, for each unknown, the sum of the magnitudes of all constraints' forces on it, and returns the largest sum
*/
static PetscErrorCode CancellationForce(Tao tao, PetscReal *largest)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  Vec           sum, force;

  PetscFunctionBegin;
  PetscCall(IPGetWork(tao, IP_UNKNOWNS, &sum));
  PetscCall(IPGetWork(tao, IP_UNKNOWNS, &force));
  PetscCall(VecSet(sum, 0.0));
  if (ip->mi)
    PetscCall(
      CancellationAddForces(tao, IP_INEQUALITIES, ip->jac->inequality, ip->at.lambda, ip->pair[IP_SLACK].w, sum));
  if (ip->me) PetscCall(CancellationAddForces(tao, IP_EQUALITIES, ip->jac->equality, ip->at.y, NULL, sum));
  for (PetscInt b = IP_LOWER; b <= IP_UPPER; b++) {
    if (!ip->pair[b].n) continue;
    PetscCall(VecPointwiseMult(force, ip->pair[b].w, ip->pair[b].z));
    PetscCall(VecAXPY(sum, 1.0, force));
  }
  PetscCall(VecNorm(sum, NORM_INFINITY, largest));
  PetscCall(IPRestoreWork(tao, IP_UNKNOWNS, &force));
  PetscCall(IPRestoreWork(tao, IP_UNKNOWNS, &sum));
  PetscFunctionReturn(0);
}

/*
   Computes the ratio of the magnitudes of the constraints' forces to the gradient that they balance; 0 if there is no
   gradient. If the ratio is large, the forces cancel one another. Bounded multipliers may then not exist, and errors
   measured with multipliers are meaningless.
*/
PetscErrorCode IPCancellation(Tao tao, PetscReal *times)
{
  const PetscReal vanishing = 1e-3; /* fraction of the first gradient that replaces a vanishing gradient */
  PetscReal       force, gradient;

  PetscFunctionBegin;
  PetscCall(CancellationForce(tao, &force));
  PetscCall(VecNorm(tao->gradient, NORM_INFINITY, &gradient));
  gradient = PetscMax(gradient, vanishing * ((TAO_IPFILTER *)tao->data)->first->gradient);
  *times   = gradient > 0.0 ? force / gradient : 0.0;
  PetscFunctionReturn(0);
}
