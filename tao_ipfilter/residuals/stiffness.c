/* Stiffness of the objective, from the diagonal of its Hessian. Units and sizes are derived from it. */
#include "residualsimpl.h"
#include "tao_ipfilter/solver/matrices.h"
#include "tao_ipfilter/solver/stiffness.h"

/*
   Computes the magnitude of the terms of the gradient at x. Rounding errors limit the stationarity residual to a few
   machine epsilons times this size.
*/
PetscErrorCode IPStiffnessTerms(Tao tao, PetscReal *size)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  Vec           terms;

  PetscFunctionBegin;
  PetscCall(IPGetWork(tao, IP_UNKNOWNS, &terms));
  PetscCall(VecPointwiseMult(terms, ip->stiff->hdiag, tao->solution));
  PetscCall(VecNorm(terms, NORM_2, size));
  PetscCall(IPRestoreWork(tao, IP_UNKNOWNS, &terms));
  PetscFunctionReturn(0);
}

/* Computes the mean energy |H_jj| x_j^2 of an unknown */
PetscErrorCode IPStiffnessMeanEnergy(Tao tao, PetscReal *mean)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  Vec           energies;
  PetscScalar   sum;
  PetscInt      n;

  PetscFunctionBegin;
  PetscCall(IPGetWork(tao, IP_UNKNOWNS, &energies));
  PetscCall(VecPointwiseMult(energies, ip->stiff->hdiag, tao->solution));
  PetscCall(VecPointwiseMult(energies, energies, tao->solution));
  PetscCall(VecSum(energies, &sum));
  PetscCall(VecGetSize(energies, &n));
  *mean = PetscRealPart(sum) / n;
  PetscCall(IPRestoreWork(tao, IP_UNKNOWNS, &energies));
  PetscFunctionReturn(0);
}

/* Computes 1/sqrt(H_jj). Entries H_jj below 1e-8 times the largest one are replaced by 1e-8 times the largest one. */
static PetscErrorCode InverseRoots(Vec hdiag, Vec roots)
{
  PetscScalar *h;
  PetscReal    hmax;
  PetscInt     n;

  PetscFunctionBegin;
  PetscCall(VecMax(hdiag, NULL, &hmax));
  if (!(hmax > 0.0)) hmax = 1.0;
  PetscCall(VecCopy(hdiag, roots));
  PetscCall(VecGetLocalSize(roots, &n));
  PetscCall(VecGetArray(roots, &h));
  for (PetscInt j = 0; j < n; j++) h[j] = 1.0 / PetscSqrtReal(PetscMax(PetscRealPart(h[j]), 1e-8 * hmax));
  PetscCall(VecRestoreArray(roots, &h));
  PetscFunctionReturn(0);
}

/* Computes compliance_i = sum_j J_ij^2 / |H_jj| for every row i of J */
PetscErrorCode IPCompliances(Tao tao, Mat J, Vec compliance)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  Mat           scaled;
  Vec           roots;
  PetscScalar  *a;
  PetscInt      rstart, rend;

  PetscFunctionBegin;
  PetscCall(IPGetWork(tao, IP_UNKNOWNS, &roots));
  PetscCall(InverseRoots(ip->stiff->hdiag, roots));
  PetscCall(MatDuplicate(J, MAT_COPY_VALUES, &scaled));
  PetscCall(MatDiagonalScale(scaled, NULL, roots));
  PetscCall(IPRestoreWork(tao, IP_UNKNOWNS, &roots));
  PetscCall(MatGetOwnershipRange(scaled, &rstart, &rend));
  PetscCall(VecGetArrayWrite(compliance, &a));
  for (PetscInt i = rstart; i < rend; i++) {
    const PetscScalar *v;
    PetscInt           nv;
    PetscReal          sum = 0.0;

    PetscCall(MatGetRow(scaled, i, &nv, NULL, &v));
    for (PetscInt k = 0; k < nv; k++) sum += PetscSqr(PetscAbsScalar(v[k]));
    PetscCall(MatRestoreRow(scaled, i, &nv, NULL, &v));
    a[i - rstart] = sum;
  }
  PetscCall(VecRestoreArrayWrite(compliance, &a));
  PetscCall(MatDestroy(&scaled));
  PetscFunctionReturn(0);
}

/*
   Computes rho_i = 1 / (m_i sum_j J_ij^2 / |H_jj|), the pressure that changes constraint i by one unit of length. The
   sum contains the compliances of both sides of a contact; the softer side dominates. A row with very small entries,
   such as a vertex at the edge of an overlap, gets at most 100 times the mean stiffness, so that no scale depends on
   it.
*/
static PetscErrorCode ConstraintStiffness(Tao tao)
{
  TAO_IPFILTER *ip    = (TAO_IPFILTER *)tao->data;
  IPPair       *slack = &ip->pair[IP_SLACK];
  PetscScalar  *rho, sum;
  PetscReal     mean;
  PetscInt      n;

  PetscFunctionBegin;
  PetscCall(IPCompliances(tao, ip->jac->inequality, ip->stiff->rho));
  PetscCall(VecPointwiseMult(ip->stiff->rho, ip->stiff->rho, slack->w));
  PetscCall(VecDot(ip->stiff->rho, slack->w, &sum));
  mean            = PetscRealPart(sum) / slack->weight;
  ip->stiff->mean = mean > 0.0 ? 1.0 / mean : 1.0;
  PetscCall(VecGetLocalSize(ip->stiff->rho, &n));
  PetscCall(VecGetArray(ip->stiff->rho, &rho));
  for (PetscInt i = 0; i < n; i++) rho[i] = mean > 0.0 ? 1.0 / PetscMax(PetscRealPart(rho[i]), 1e-2 * mean) : 1.0;
  PetscCall(VecRestoreArray(ip->stiff->rho, &rho));
  PetscFunctionReturn(0);
}

/* Updates stiff->hdiag, the absolute values of the present Hessian's diagonal */
PetscErrorCode IPStiffnessUpdate(Tao tao)
{
  Vec hdiag = ((TAO_IPFILTER *)tao->data)->stiff->hdiag;

  PetscFunctionBegin;
  PetscCall(IPHessianDiagonal(tao, hdiag));
  PetscCall(VecAbs(hdiag));
  PetscFunctionReturn(0);
}

/* Computes ip->stiff from the Hessian and the Jacobian at the starting point */
PetscErrorCode IPComputeStiffness(Tao tao)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  IPStiffness  *s  = ip->stiff;
  PetscScalar   sum;
  PetscInt      n;

  PetscFunctionBegin;
  PetscCall(IPStiffnessUpdate(tao));
  PetscCall(VecSum(s->hdiag, &sum));
  PetscCall(VecGetSize(s->hdiag, &n));
  s->flat   = (PetscBool) !(PetscRealPart(sum) > 0.0);
  s->hscale = s->flat ? 1.0 : PetscRealPart(sum) / n;
  if (ip->mi) PetscCall(ConstraintStiffness(tao));
  PetscFunctionReturn(0);
}
