/* The Hessian used by the iteration: the caller's matrix, or its conversion to AIJ */
#include "problemimpl.h"
#include "tao_ipfilter/solver/matrices.h"

PetscErrorCode IPHessianDestroy(IPHessian *hess)
{
  PetscFunctionBegin;
  PetscCall(MatDestroy(&hess->H));
  PetscCall(MatDestroy(&hess->converted));
  PetscCall(VecDestroy(&hess->gradient));
  PetscCall(PetscMemzero(hess, sizeof(*hess)));
  PetscFunctionReturn(0);
}

/* Evaluates the Hessian of the Lagrangian at tao->solution and sets hess->H */
PetscErrorCode IPHessianEvaluate(Tao tao)
{
  IPHessian *hess = ((TAO_IPFILTER *)tao->data)->hess;
  PetscBool  taken;
  Mat        H = tao->hessian;

  PetscFunctionBegin;
  PetscCall(TaoComputeHessian(tao, tao->solution, tao->hessian, tao->hessian_pre));
  PetscCall(PetscObjectBaseTypeCompareAny((PetscObject)H, &taken, MATSEQAIJ, MATMPIAIJ, MATSEQBAIJ, MATMPIBAIJ,
    MATSEQSBAIJ, MATMPISBAIJ, MATSEQDENSE, MATMPIDENSE, ""));
  if (!taken && !hess->products) {
    PetscCall(IPMatrixConvert(H, &hess->converted));
    H = hess->converted;
  }
  PetscCall(PetscObjectReference((PetscObject)H));
  PetscCall(MatDestroy(&hess->H));
  hess->H = H;
  PetscFunctionReturn(0);
}

/* Fills v with 1 and -1 in an irregular pattern that differs from probe to probe */
static PetscErrorCode HessianProbe(Vec v, PetscInt probe)
{
  PetscScalar *a;
  PetscInt     rstart, rend;

  PetscFunctionBegin;
  PetscCall(VecGetOwnershipRange(v, &rstart, &rend));
  PetscCall(VecGetArrayWrite(v, &a));
  for (PetscInt i = rstart; i < rend; i++)
    a[i - rstart] = fmod(PETSC_PHI * (i + 1) * (i + 1 + 7 * probe), 1.0) < 0.5 ? 1.0 : -1.0;
  PetscCall(VecRestoreArrayWrite(v, &a));
  PetscFunctionReturn(0);
}

/*
   Estimates the diagonal of a Hessian that only has products, by the mean of v_i (H v)_i over several vectors v of +1
   and -1. Off-diagonal terms cancel in the mean. The relative error is some tens of per cent. Entries below a
   thousandth of the mean are raised to it.
*/
static PetscErrorCode HessianEstimateDiagonal(Tao tao, Vec diagonal)
{
  TAO_IPFILTER   *ip     = (TAO_IPFILTER *)tao->data;
  const PetscInt  probes = 8;
  const PetscReal least  = 1e-3;
  PetscScalar    *d, sum;
  PetscInt        n, N;
  Vec             v, Hv;

  PetscFunctionBegin;
  PetscCall(IPGetWork(tao, IP_UNKNOWNS, &v));
  PetscCall(IPGetWork(tao, IP_UNKNOWNS, &Hv));
  PetscCall(VecSet(diagonal, 0.0));
  for (PetscInt k = 0; k < probes; k++) {
    PetscCall(HessianProbe(v, k));
    PetscCall(MatMult(ip->hess->H, v, Hv));
    PetscCall(VecPointwiseMult(Hv, Hv, v));
    PetscCall(VecAXPY(diagonal, 1.0 / probes, Hv));
  }
  PetscCall(VecAbs(diagonal));
  PetscCall(VecSum(diagonal, &sum));
  PetscCall(VecGetSize(diagonal, &N));
  PetscCall(VecGetLocalSize(diagonal, &n));
  PetscCall(VecGetArray(diagonal, &d));
  for (PetscInt i = 0; i < n; i++) d[i] = PetscMax(PetscRealPart(d[i]), least * PetscRealPart(sum) / N);
  PetscCall(VecRestoreArray(diagonal, &d));
  PetscCall(IPRestoreWork(tao, IP_UNKNOWNS, &Hv));
  PetscCall(IPRestoreWork(tao, IP_UNKNOWNS, &v));
  PetscFunctionReturn(0);
}

/* Computes the diagonal of the Hessian, or estimates it if the matrix does not provide it */
PetscErrorCode IPHessianDiagonal(Tao tao, Vec diagonal)
{
  IPHessian *hess = ((TAO_IPFILTER *)tao->data)->hess;
  PetscBool  has  = PETSC_TRUE;

  PetscFunctionBegin;
  if (hess->products) PetscCall(MatHasOperation(hess->H, MATOP_GET_DIAGONAL, &has));
  if (has) PetscCall(MatGetDiagonal(hess->H, diagonal));
  else PetscCall(HessianEstimateDiagonal(tao, diagonal));
  PetscFunctionReturn(0);
}
