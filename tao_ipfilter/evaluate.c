/* The caller's functions at a point: constraints, derivatives, and a Hessian by differences where none is given. */
#include "ipfilterimpl.h"

/* Largest problem whose Hessian is differenced column by column */
#define IP_FD_MAX 1000

/* c_I - I_l with the lower bounds of TaoSetInequalityBounds(), and c_E, scaled; c_I relaxed */
PetscErrorCode IPEvaluateConstraints(Tao tao, Vec x, Vec c, Vec ce)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  if (ip->mi) {
    PetscCall(TaoComputeInequalityConstraints(tao, x, c));
    if (tao->IL) PetscCall(VecAXPY(c, -1.0, tao->IL));
    if (ip->cscale) PetscCall(VecPointwiseMult(c, c, ip->cscale));
    if (ip->relaxed > 0.0) PetscCall(VecShift(c, ip->relaxed));
  }
  if (ip->me) PetscCall(TaoComputeEqualityConstraints(tao, x, ce));
  if (ip->cescale) PetscCall(VecPointwiseMult(ce, ce, ip->cescale));
  PetscFunctionReturn(0);
}

/* Gradient and constraint Jacobians at tao->solution, whose objective is in ip->f. Fixed variables have none. */
PetscErrorCode IPEvaluateDerivatives(Tao tao)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  PetscBool     alone;

  PetscFunctionBegin;
  PetscCall(TaoIsGradientDefined(tao, &alone));
  if (alone) PetscCall(TaoComputeGradient(tao, tao->solution, tao->gradient));
  else PetscCall(TaoComputeObjectiveAndGradient(tao, tao->solution, &ip->f, tao->gradient));
  PetscCall(IPFixedZero(tao, tao->gradient));
  if (ip->me) {
    PetscCall(TaoComputeJacobianEquality(tao, tao->solution, tao->jacobian_equality, tao->jacobian_equality_pre));
    PetscCall(MatDestroy(&ip->JE));
    PetscCall(IPScalingJacobian(tao, tao->jacobian_equality, ip->cescale, &ip->JE));
  }
  if (ip->mi) {
    PetscCall(TaoComputeJacobianInequality(tao, tao->solution, tao->jacobian_inequality, tao->jacobian_inequality_pre));
    PetscCall(IPCondenseJacobian(tao));
  }
  PetscFunctionReturn(0);
}

/* tao->DI = M lambda and tao->DE = y, scaled back: the multipliers of f + DE^T c_E - DI^T c_I, whose Hessian is asked for */
PetscErrorCode IPSetMultipliers(Tao tao)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  if (ip->mi) PetscCall(VecPointwiseMult(tao->DI, ip->lambda, ip->pair[IP_SLACK].w));
  if (ip->cscale) PetscCall(VecPointwiseMult(tao->DI, tao->DI, ip->cscale));
  if (ip->me) PetscCall(VecCopy(ip->y, tao->DE));
  if (ip->cescale) PetscCall(VecPointwiseMult(tao->DE, tao->DE, ip->cescale));
  PetscFunctionReturn(0);
}

/* Gradient of f + DE^T c_E - DI^T c_I at x. Leaves the Jacobians at x. */
static PetscErrorCode LagrangianGradient(Tao tao, Vec x, Vec g)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  PetscCall(TaoComputeGradient(tao, x, g));
  if (ip->me) {
    PetscCall(TaoComputeJacobianEquality(tao, x, tao->jacobian_equality, tao->jacobian_equality_pre));
    PetscCall(MatMultTransposeAdd(tao->jacobian_equality, tao->DE, g, g));
  }
  if (ip->mi) {
    PetscCall(TaoComputeJacobianInequality(tao, x, tao->jacobian_inequality, tao->jacobian_inequality_pre));
    PetscCall(VecCopy(tao->DI, ip->cwork));
    PetscCall(VecScale(ip->cwork, -1.0));
    PetscCall(MatMultTransposeAdd(tao->jacobian_inequality, ip->cwork, g, g));
  }
  PetscFunctionReturn(0);
}

/* Column j of the Hessian by a forward difference, as row j of H */
static PetscErrorCode DifferenceColumn(Tao tao, Vec x, Vec g, PetscInt j, PetscReal step, Mat H)
{
  TAO_IPFILTER      *ip = (TAO_IPFILTER *)tao->data;
  const PetscScalar *column;
  PetscInt           rstart, rend;

  PetscFunctionBegin;
  PetscCall(VecGetOwnershipRange(x, &rstart, &rend));
  PetscCall(VecCopy(x, ip->xtrial));
  if (j >= rstart && j < rend) PetscCall(VecSetValue(ip->xtrial, j, step, ADD_VALUES));
  PetscCall(VecAssemblyBegin(ip->xtrial));
  PetscCall(VecAssemblyEnd(ip->xtrial));
  PetscCall(LagrangianGradient(tao, ip->xtrial, ip->xwork));
  PetscCall(VecAXPY(ip->xwork, -1.0, g));
  PetscCall(VecScale(ip->xwork, 1.0 / step));
  PetscCall(VecGetArrayRead(ip->xwork, &column));
  for (PetscInt i = rstart; i < rend; i++) {
    PetscCall(MatSetValue(H, i, j, 0.5 * column[i - rstart], ADD_VALUES));
    PetscCall(MatSetValue(H, j, i, 0.5 * column[i - rstart], ADD_VALUES));
  }
  PetscCall(VecRestoreArrayRead(ip->xwork, &column));
  PetscFunctionReturn(0);
}

/* Hessian of the Lagrangian by forward differences of its gradient, made symmetric */
static PetscErrorCode HessianFD(Tao tao, Vec x, Mat H, Mat Hpre, void *ctx)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  PetscReal     size;
  PetscInt      n;

  PetscFunctionBegin;
  (void)Hpre;
  (void)ctx;
  PetscCall(VecNorm(x, NORM_INFINITY, &size));
  PetscCall(VecGetSize(x, &n));
  PetscCall(LagrangianGradient(tao, x, ip->xwork2));
  PetscCall(MatZeroEntries(H));
  for (PetscInt j = 0; j < n; j++) PetscCall(DifferenceColumn(tao, x, ip->xwork2, j, PETSC_SQRT_MACHINE_EPSILON * (size > 0.0 ? size : 1.0), H));
  PetscCall(MatAssemblyBegin(H, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(H, MAT_FINAL_ASSEMBLY));
  PetscCall(IPEvaluateDerivatives(tao));
  PetscFunctionReturn(0);
}

/* Without TaoSetHessian(): a full matrix filled by differences, for small problems */
PetscErrorCode IPHessianCreateFD(Tao tao)
{
  MPI_Comm comm = PetscObjectComm((PetscObject)tao);
  Mat      H;
  PetscInt n, N;

  PetscFunctionBegin;
  PetscCall(VecGetLocalSize(tao->solution, &n));
  PetscCall(VecGetSize(tao->solution, &N));
  PetscCheck(N <= IP_FD_MAX, comm, PETSC_ERR_ARG_WRONGSTATE, "TAOIPFILTER needs TaoSetHessian(): with %" PetscInt_FMT " unknowns, more than %d, it does not difference gradients", N, IP_FD_MAX);
  PetscCall(MatCreateAIJ(comm, n, n, N, N, n, NULL, N - n, NULL, &H));
  PetscCall(TaoSetHessian(tao, H, H, HessianFD, NULL));
  PetscCall(MatDestroy(&H));
  PetscFunctionReturn(0);
}
