/*
   The condensed matrix for a Hessian that only has products: H + Sigma + J^T D J + delta M_u as a MATSHELL with a
   diagonal
*/
#include "systemimpl.h"
#include "tao_ipfilter/solver/condensed.h"
#include "tao_ipfilter/solver/matrices.h"
#include "tao_ipfilter/solver/stiffness.h"

/* Adds J^T D J x to y */
static PetscErrorCode OperatorAddRows(Tao tao, Vec x, Vec y)
{
  IPRows *rows = &((TAO_IPFILTER *)tao->data)->cond->rows;
  Vec     force;

  PetscFunctionBegin;
  if (!rows->J) PetscFunctionReturn(0);
  PetscCall(VecDuplicate(rows->D, &force));
  PetscCall(MatMult(rows->J, x, force));
  PetscCall(VecPointwiseMult(force, force, rows->D));
  PetscCall(MatMultTransposeAdd(rows->J, force, y, y));
  PetscCall(VecDestroy(&force));
  PetscFunctionReturn(0);
}

/*
   Computes y = A x. Fixed variables are removed: their rows hold only a diagonal entry, of the size of the Hessian's.
*/
static PetscErrorCode OperatorMult(Mat A, Vec x, Vec y)
{
  TAO_IPFILTER *ip;
  Tao           tao;
  Vec           part;

  PetscFunctionBegin;
  PetscCall(MatShellGetContext(A, &tao));
  ip = (TAO_IPFILTER *)tao->data;
  PetscCall(IPGetWork(tao, IP_UNKNOWNS, &part));
  PetscCall(VecCopy(x, part));
  PetscCall(IPFixedZero(tao, part));
  PetscCall(MatMult(ip->hess->H, part, y));
  PetscCall(OperatorAddRows(tao, part, y));
  PetscCall(VecPointwiseMult(part, part, ip->cond->shift));
  PetscCall(VecAXPY(y, 1.0, part));
  if (ip->fixed) {
    PetscCall(IPFixedZero(tao, y));
    PetscCall(VecCopy(x, part));
    PetscCall(IPFixedZero(tao, part));
    PetscCall(VecAYPX(part, -1.0, x));
    PetscCall(VecAXPY(y, ip->stiff->hscale, part));
  }
  PetscCall(IPRestoreWork(tao, IP_UNKNOWNS, &part));
  PetscFunctionReturn(0);
}

/* Adds the diagonal of J^T D J to d */
static PetscErrorCode OperatorAddRowsDiagonal(const IPRows *rows, Vec d)
{
  const PetscScalar *weight;
  PetscInt           rstart, rend;

  PetscFunctionBegin;
  if (!rows->J) PetscFunctionReturn(0);
  PetscCall(MatGetOwnershipRange(rows->J, &rstart, &rend));
  PetscCall(VecGetArrayRead(rows->D, &weight));
  for (PetscInt i = rstart; i < rend; i++) {
    const PetscInt    *c;
    const PetscScalar *v;
    PetscInt           n;

    PetscCall(MatGetRow(rows->J, i, &n, &c, &v));
    for (PetscInt k = 0; k < n; k++) PetscCall(VecSetValue(d, c[k], weight[i - rstart] * v[k] * v[k], ADD_VALUES));
    PetscCall(MatRestoreRow(rows->J, i, &n, &c, &v));
  }
  PetscCall(VecRestoreArrayRead(rows->D, &weight));
  PetscCall(VecAssemblyBegin(d));
  PetscCall(VecAssemblyEnd(d));
  PetscFunctionReturn(0);
}

static PetscErrorCode OperatorGetDiagonal(Mat A, Vec d)
{
  TAO_IPFILTER *ip;
  Tao           tao;

  PetscFunctionBegin;
  PetscCall(MatShellGetContext(A, &tao));
  ip = (TAO_IPFILTER *)tao->data;
  PetscCall(VecCopy(ip->cond->hdiag, d));
  PetscCall(OperatorAddRowsDiagonal(&ip->cond->rows, d));
  if (ip->fixed) PetscCall(VecISSet(d, ip->fixed, ip->stiff->hscale));
  PetscFunctionReturn(0);
}

/*
   Creates cond->A at the first call. The shell uses the present data of the iteration. Later calls therefore only
   increase its object state, so that the preconditioner is updated.
*/
PetscErrorCode IPOperatorUpdate(Tao tao)
{
  IPCondensed *cond = ((TAO_IPFILTER *)tao->data)->cond;
  PetscInt     n, N;

  PetscFunctionBegin;
  PetscCall(VecGetLocalSize(tao->solution, &n));
  PetscCall(VecGetSize(tao->solution, &N));
  if (!cond->A) {
    PetscCall(MatCreateShell(PetscObjectComm((PetscObject)tao), n, n, N, N, tao, &cond->A));
    PetscCall(MatShellSetOperation(cond->A, MATOP_MULT, (AMGFOperation *)OperatorMult));
    PetscCall(MatShellSetOperation(cond->A, MATOP_MULT_TRANSPOSE, (AMGFOperation *)OperatorMult));
    PetscCall(MatShellSetOperation(cond->A, MATOP_GET_DIAGONAL, (AMGFOperation *)OperatorGetDiagonal));
    PetscCall(MatSetOption(cond->A, MAT_SYMMETRIC, PETSC_TRUE));
  }
  PetscCall(PetscObjectStateIncrease((PetscObject)cond->A));
  PetscFunctionReturn(0);
}
