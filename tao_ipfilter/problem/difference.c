/* Computes the Hessian of the Lagrangian by differences of its gradient, if the caller gives none */
#include "problemimpl.h"
#include "tao_ipfilter/solver/rows.h"

/*
   Computes the gradient of f + DE^T c_E - DI^T c_I at x. Afterwards the caller's Jacobian matrices hold the values at
   x.
*/
static PetscErrorCode DifferencedGradient(Tao tao, Vec x, Vec g)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  Vec           force;

  PetscFunctionBegin;
  PetscCall(TaoComputeGradient(tao, x, g));
  if (ip->me > ip->sides->nall) {
    PetscCall(TaoComputeJacobianEquality(tao, x, tao->jacobian_equality, tao->jacobian_equality_pre));
    PetscCall(MatMultTransposeAdd(tao->jacobian_equality, tao->DE, g, g));
  }
  if (ip->mi) {
    PetscCall(TaoComputeJacobianInequality(tao, x, tao->jacobian_inequality, tao->jacobian_inequality_pre));
    PetscCall(IPGetWork(tao, IP_INEQUALITIES, &force));
    PetscCall(VecAXPBY(force, -1.0, 0.0, tao->DI));
    PetscCall(MatMultTransposeAdd(tao->jacobian_inequality, force, g, g));
    PetscCall(IPRestoreWork(tao, IP_INEQUALITIES, &force));
  }
  PetscFunctionReturn(0);
}

/*
   Adds half of column j of the Hessian to column j of H, and half to row j, which makes H symmetric. The column is the
   forward difference of the gradient with the step `step`. g: gradient at x; xj, gj: work vectors.
*/
static PetscErrorCode DifferenceColumn(Tao tao, Vec x, Vec g, PetscInt j, PetscReal step, Vec xj, Vec gj, Mat H)
{
  const PetscScalar *column;
  PetscInt           rstart, rend;

  PetscFunctionBegin;
  PetscCall(VecGetOwnershipRange(x, &rstart, &rend));
  PetscCall(VecCopy(x, xj));
  if (j >= rstart && j < rend) PetscCall(VecSetValue(xj, j, step, ADD_VALUES));
  PetscCall(VecAssemblyBegin(xj));
  PetscCall(VecAssemblyEnd(xj));
  PetscCall(DifferencedGradient(tao, xj, gj));
  PetscCall(VecAXPY(gj, -1.0, g));
  PetscCall(VecScale(gj, 1.0 / step));
  PetscCall(VecGetArrayRead(gj, &column));
  for (PetscInt i = rstart; i < rend; i++) {
    PetscCall(MatSetValue(H, i, j, 0.5 * column[i - rstart], ADD_VALUES));
    PetscCall(MatSetValue(H, j, i, 0.5 * column[i - rstart], ADD_VALUES));
  }
  PetscCall(VecRestoreArrayRead(gj, &column));
  PetscFunctionReturn(0);
}

/* Computes the Hessian of the Lagrangian by forward differences of its gradient, and makes it symmetric */
static PetscErrorCode DifferenceHessian(Tao tao, Vec x, Mat H, Mat Hpre, void *ctx)
{
  Vec       g, xj, gj;
  PetscReal size;
  PetscInt  n;

  PetscFunctionBegin;
  (void)Hpre;
  (void)ctx;
  PetscCall(IPGetWork(tao, IP_UNKNOWNS, &g));
  PetscCall(IPGetWork(tao, IP_UNKNOWNS, &xj));
  PetscCall(IPGetWork(tao, IP_UNKNOWNS, &gj));
  PetscCall(VecNorm(x, NORM_INFINITY, &size));
  PetscCall(VecGetSize(x, &n));
  PetscCall(DifferencedGradient(tao, x, g));
  PetscCall(MatZeroEntries(H));
  for (PetscInt j = 0; j < n; j++)
    PetscCall(DifferenceColumn(tao, x, g, j, PETSC_SQRT_MACHINE_EPSILON * (size > 0.0 ? size : 1.0), xj, gj, H));
  PetscCall(MatAssemblyBegin(H, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(H, MAT_FINAL_ASSEMBLY));
  PetscCall(IPRestoreWork(tao, IP_UNKNOWNS, &gj));
  PetscCall(IPRestoreWork(tao, IP_UNKNOWNS, &xj));
  PetscCall(IPRestoreWork(tao, IP_UNKNOWNS, &g));
  PetscCall(IPEvaluateDerivatives(tao));
  PetscFunctionReturn(0);
}

/* Tells whether the Hessian is computed by differences */
PetscErrorCode IPDifferenceInUse(Tao tao, PetscBool *used)
{
  PetscErrorCode (*hessian)(Tao, Vec, Mat, Mat, void *);

  PetscFunctionBegin;
  PetscCall(TaoGetHessian(tao, NULL, NULL, &hessian, NULL));
  *used = (PetscBool)(hessian == DifferenceHessian);
  PetscFunctionReturn(0);
}

/*
   Makes the Tao compute the Hessian by differences, if TaoSetHessian() was not called. H is a full matrix, suitable for
   small problems only.
*/
PetscErrorCode IPDifferenceHessian(Tao tao)
{
  MPI_Comm comm = PetscObjectComm((PetscObject)tao);
  Mat      H;
  PetscInt n, N;

  PetscFunctionBegin;
  PetscCall(VecGetLocalSize(tao->solution, &n));
  PetscCall(VecGetSize(tao->solution, &N));
  PetscCall(MatCreateAIJ(comm, n, n, N, N, n, NULL, N - n, NULL, &H));
  PetscCall(TaoSetHessian(tao, H, H, DifferenceHessian, NULL));
  PetscCall(MatDestroy(&H));
  PetscFunctionReturn(0);
}
