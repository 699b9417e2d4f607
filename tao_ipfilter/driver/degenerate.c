/* Detects solutions without bounded multipliers. The KKT error, which is measured with the multipliers, is
   meaningless there. */
#include "driverimpl.h"

/* r += |J|^T |M multiplier|; weights NULL: M = 1 */
static PetscErrorCode DegenerateAddForces(Tao tao, IPSpace space, Mat J, Vec multiplier, Vec weights, Vec r)
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

/* Largest sum over the constraints of the magnitudes of their forces on one unknown */
static PetscErrorCode DegenerateForce(Tao tao, PetscReal *largest)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  Vec           sum, force;

  PetscFunctionBegin;
  PetscCall(IPGetWork(tao, IP_UNKNOWNS, &sum));
  PetscCall(IPGetWork(tao, IP_UNKNOWNS, &force));
  PetscCall(VecSet(sum, 0.0));
  if (ip->mi)
    PetscCall(DegenerateAddForces(tao, IP_INEQUALITIES, ip->jac.inequality, ip->at.lambda, ip->pair[IP_SLACK].w, sum));
  if (ip->me) PetscCall(DegenerateAddForces(tao, IP_EQUALITIES, ip->jac.equality, ip->at.y, NULL, sum));
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

/* times: ratio of the magnitudes of the constraints' forces to the gradient that they balance together. If it is
   large, the forces cancel each other: bounded multipliers may not exist, and errors measured with multipliers are
   meaningless */
PetscErrorCode IPDegenerateCancellation(Tao tao, PetscReal *times)
{
  const PetscReal vanishing = 1e-3; /* relative to the first gradient */
  PetscReal       force, gradient;

  PetscFunctionBegin;
  PetscCall(DegenerateForce(tao, &force));
  PetscCall(VecNorm(tao->gradient, NORM_INFINITY, &gradient));
  gradient = PetscMax(gradient, vanishing * ((TAO_IPFILTER *)tao->data)->first.gradient);
  *times   = gradient > 0.0 ? force / gradient : 0.0;
  PetscFunctionReturn(0);
}

/* Largest force of the present multipliers with the constraint gradients of the starting point */
static PetscErrorCode DegenerateForceAtStart(Tao tao, PetscReal *force)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  PetscReal     size;

  PetscFunctionBegin;
  *force = 0.0;
  if (ip->me) {
    PetscCall(VecNorm(ip->at.y, NORM_INFINITY, &size));
    *force = size * ip->first.equality_jacobian;
  }
  PetscFunctionReturn(0);
}

/* Magnitude of the objective, the larger of the present and the first value: the scale for what is left to gain */
PetscReal IPDegenerateObjective(const TAO_IPFILTER *ip)
{
  return PetscMax(PetscMax(PetscAbsReal(ip->at.f), PetscAbsReal(ip->first.f)), ip->first.gradient * ip->first.x);
}

/* stands: whether the last step changed the objective by a negligible part of its magnitude. If multipliers do not
   exist, only this shows that the iteration has reached the solution */
static PetscErrorCode DegenerateStagnates(Tao tao, PetscBool *stands)
{
  TAO_IPFILTER   *ip    = (TAO_IPFILTER *)tao->data;
  const PetscReal trace = 1e-6;
  PetscScalar     slope;

  PetscFunctionBegin;
  PetscCall(VecDot(tao->gradient, ip->dir.x, &slope));
  *stands = (PetscBool)(tao->niter && PetscAbsScalar(slope) <= trace * IPDegenerateObjective(ip));
  PetscFunctionReturn(0);
}

/* Whether the Fritz John conditions hold without the objective: the gradients of satisfied equality constraints
   vanish, so that their multipliers grow without limit, and the stationarity residual is small relative to them */
PetscErrorCode IPDegenerateFritzJohn(Tao tao, PetscBool *holds)
{
  TAO_IPFILTER   *ip   = (TAO_IPFILTER *)tao->data;
  const IPKKT    *k    = &ip->kkt;
  const PetscReal huge = 1e6; /* relative to the gradient */
  PetscReal       force, gradient;

  PetscFunctionBegin;
  *holds = PETSC_FALSE;
  if (!ip->me || ip->opt.scaling == IP_SCALING_NONE || k->primal > ip->tol || k->violation > ip->tol ||
      k->complementarity > ip->tol)
    PetscFunctionReturn(0);
  PetscCall(DegenerateForceAtStart(tao, &force));
  PetscCall(VecNorm(tao->gradient, NORM_INFINITY, &gradient));
  *holds = (PetscBool)(force > huge * PetscMax(gradient, ip->first.gradient) && k->dual_norm <= ip->tol * force);
  if (*holds) PetscCall(DegenerateStagnates(tao, holds));
  PetscFunctionReturn(0);
}
