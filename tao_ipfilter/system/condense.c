/*
   The condensed system. Elimination of slacks and multipliers from the Newton system gives A d = b with
     A = H + Sigma + J^T D J + delta M_u,   D = M_s z/s,
     b = -grad f + J^T (M_s target/s - D (c - s)) + bound terms.
*/
#include "systemimpl.h"
#include "tao_ipfilter/solver/barrier.h"
#include "tao_ipfilter/solver/condensed.h"
#include "tao_ipfilter/solver/factors.h"
#include "tao_ipfilter/solver/matrices.h"
#include "tao_ipfilter/solver/options.h"
#include "tao_ipfilter/solver/record.h"

PetscErrorCode IPCondensedDestroy(IPCondensed *c)
{
  PetscFunctionBegin;
  PetscCall(MatDestroy(&c->A));
  PetscCall(MatDestroy(&c->DJ));
  PetscCall(MatDestroy(&c->JtDJ));
  PetscCall(VecDestroy(&c->shift));
  PetscCall(VecDestroy(&c->hdiag));
  PetscCall(ISDestroy(&c->constrained));
  PetscCall(PetscFree(c->touched));
  PetscCall(IPRowsDestroy(&c->rows));
  PetscCall(PetscMemzero(c, sizeof(*c)));
  PetscFunctionReturn(0);
}

/* Lists the local rows with entries of J^T D J */
static PetscErrorCode TouchedRows(IPCondensed *cond)
{
  PetscInt rstart, rend;

  PetscFunctionBegin;
  PetscCall(PetscFree(cond->touched));
  PetscCall(MatGetOwnershipRange(cond->JtDJ, &rstart, &rend));
  for (PetscInt pass = 0; pass < 2; pass++) {
    if (pass) PetscCall(PetscMalloc1(cond->ntouched, &cond->touched));
    cond->ntouched = 0;
    for (PetscInt i = rstart; i < rend; i++) {
      PetscInt nc;

      PetscCall(MatGetRow(cond->JtDJ, i, &nc, NULL, NULL));
      if (nc) {
        if (pass) cond->touched[cond->ntouched] = i;
        cond->ntouched++;
      }
      PetscCall(MatRestoreRow(cond->JtDJ, i, &nc, NULL, NULL));
    }
  }
  PetscFunctionReturn(0);
}

/* Computes J^T D J and lists its local rows. *changed: its pattern is new. */
static PetscErrorCode UpdateProduct(IPCondensed *cond, PetscBool *changed)
{
  const IPRows *rows = &cond->rows;

  PetscFunctionBegin;
  *changed =
    (PetscBool)(!cond->JtDJ || cond->J_nonzero != rows->stamp.pattern_state || cond->J_id != rows->stamp.pattern_id);
  if (*changed) {
    PetscCall(MatDestroy(&cond->DJ));
    PetscCall(MatDestroy(&cond->JtDJ));
    PetscCall(MatDuplicate(rows->J, MAT_COPY_VALUES, &cond->DJ));
    cond->J_nonzero = rows->stamp.pattern_state;
    cond->J_id      = rows->stamp.pattern_id;
  } else PetscCall(MatCopy(rows->J, cond->DJ, SAME_NONZERO_PATTERN));
  PetscCall(MatDiagonalScale(cond->DJ, rows->D, NULL));
  PetscCall(MatTransposeMatMult(rows->J, cond->DJ, *changed ? MAT_INITIAL_MATRIX : MAT_REUSE_MATRIX, PETSC_DEFAULT,
    &cond->JtDJ));
  if (*changed) PetscCall(TouchedRows(cond));
  PetscFunctionReturn(0);
}

/* Destroys the product J^T D J, and A with it, if no rows are condensed any longer */
static PetscErrorCode DropProduct(IPCondensed *cond)
{
  PetscFunctionBegin;
  if (!cond->JtDJ) PetscFunctionReturn(0);
  PetscCall(MatDestroy(&cond->DJ));
  PetscCall(MatDestroy(&cond->JtDJ));
  PetscCall(MatDestroy(&cond->A));
  PetscCall(ISDestroy(&cond->constrained));
  cond->ntouched = 0;
  PetscFunctionReturn(0);
}

/* Computes shift = Sigma of the bounds + delta M_u. *shifted: whether it is not zero. */
static PetscErrorCode UpdateShift(Tao tao, PetscBool *shifted)
{
  TAO_IPFILTER *ip   = (TAO_IPFILTER *)tao->data;
  IPCondensed  *cond = ip->cond;
  Vec           sigma;

  PetscFunctionBegin;
  if (!cond->shift) {
    PetscCall(VecDuplicate(tao->solution, &cond->shift));
    PetscCall(VecDuplicate(tao->solution, &cond->hdiag));
  }
  *shifted = (PetscBool)(ip->shift->delta > 0.0);
  PetscCall(VecSet(cond->shift, 0.0));
  PetscCall(IPGetWork(tao, IP_UNKNOWNS, &sigma));
  for (PetscInt b = IP_LOWER; b <= IP_UPPER; b++) {
    if (!ip->pair[b].n) continue;
    PetscCall(IPPairGetSigma(&ip->pair[b], sigma));
    PetscCall(VecAXPY(cond->shift, 1.0, sigma));
    *shifted = PETSC_TRUE;
  }
  PetscCall(IPRestoreWork(tao, IP_UNKNOWNS, &sigma));
  if (ip->shift->delta > 0.0 && ip->given->primal_mass)
    PetscCall(VecAXPY(cond->shift, ip->shift->delta, ip->given->primal_mass));
  else if (ip->shift->delta > 0.0) PetscCall(VecShift(cond->shift, ip->shift->delta));
  PetscFunctionReturn(0);
}

/* Inserts A's diagonal: that of H plus the shift. If only the last shift was not zero, this restores H's diagonal. */
static PetscErrorCode WriteDiagonal(Tao tao, PetscBool shifted)
{
  TAO_IPFILTER      *ip   = (TAO_IPFILTER *)tao->data;
  IPCondensed       *cond = ip->cond;
  const PetscScalar *d;
  PetscInt           rstart, rend;

  PetscFunctionBegin;
  if (!shifted && !cond->shifted) PetscFunctionReturn(0);
  cond->shifted = shifted;
  PetscCall(MatGetDiagonal(ip->hess->H, cond->hdiag));
  PetscCall(VecAXPY(cond->hdiag, 1.0, cond->shift));
  PetscCall(MatGetOwnershipRange(cond->A, &rstart, &rend));
  PetscCall(VecGetArrayRead(cond->hdiag, &d));
  for (PetscInt i = rstart; i < rend; i++) PetscCall(MatSetValue(cond->A, i, i, d[i - rstart], INSERT_VALUES));
  PetscCall(VecRestoreArrayRead(cond->hdiag, &d));
  PetscFunctionReturn(0);
}

/* Returns whether nothing is added to H, so that A = H */
static PetscBool Unconstrained(const TAO_IPFILTER *ip)
{
  return (PetscBool)(!ip->mi && !ip->prox->condensed && !ip->fixed && !ip->pair[IP_LOWER].n && !ip->pair[IP_UPPER].n &&
                     ip->shift->delta == 0.0);
}

/* Sets A to a reference to H */
static PetscErrorCode TakeHessian(Tao tao)
{
  IPCondensed *cond = ((TAO_IPFILTER *)tao->data)->cond;
  Mat          H    = ((TAO_IPFILTER *)tao->data)->hess->H;

  PetscFunctionBegin;
  PetscCall(PetscObjectReference((PetscObject)H));
  PetscCall(MatDestroy(&cond->A));
  cond->A       = H;
  cond->H_state = 0;
  PetscFunctionReturn(0);
}

/* Computes A = H + Sigma + J^T D J + delta M_u, and writes only what has changed */
static PetscErrorCode WriteSum(Tao tao)
{
  TAO_IPFILTER    *ip   = (TAO_IPFILTER *)tao->data;
  IPCondensed     *cond = ip->cond;
  Mat              H    = ip->hess->H;
  PetscObjectState state, nonzero;
  PetscBool        pattern = PETSC_FALSE, values, shifted;

  PetscFunctionBegin;
  PetscCall(PetscObjectStateGet((PetscObject)H, &state));
  PetscCall(MatGetNonzeroState(H, &nonzero));
  if (cond->rows.J) {
    PetscCall(UpdateProduct(cond, &pattern));
    PetscCall(IPConstrainedUpdate(tao));
    PetscCall(IPConstrainedSwitch(tao));
  }
  pattern = (PetscBool)(pattern || !cond->A || cond->A == H || nonzero != cond->H_nonzero ||
                        cond->H_id != ((PetscObject)H)->id);
  values  = (PetscBool)(pattern || state != cond->H_state);
  PetscCall(UpdateShift(tao, &shifted));
  cond->H_state   = state;
  cond->H_nonzero = nonzero;
  cond->H_id      = ((PetscObject)H)->id;
  PetscCall(IPCondensedWriteHessian(tao, pattern, values));
  PetscCall(WriteDiagonal(tao, shifted));
  if (cond->JtDJ) PetscCall(IPCondensedAddProduct(cond));
  PetscCall(MatAssemblyBegin(cond->A, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(cond->A, MAT_FINAL_ASSEMBLY));
  PetscCall(IPFixedMatrix(tao, cond->A));
  if (cond->constrained)
    PetscCall(PetscObjectCompose((PetscObject)cond->A, PCAMGF_FILTER_KEY, (PetscObject)cond->constrained));
  PetscFunctionReturn(0);
}

/* Updates A for a Hessian that only has products */
static PetscErrorCode WriteOperator(Tao tao)
{
  IPCondensed *cond = ((TAO_IPFILTER *)tao->data)->cond;

  PetscFunctionBegin;
  PetscCall(UpdateShift(tao, &cond->shifted));
  PetscCall(IPHessianDiagonal(tao, cond->hdiag));
  PetscCall(VecAXPY(cond->hdiag, 1.0, cond->shift));
  PetscCall(IPOperatorUpdate(tao));
  PetscFunctionReturn(0);
}

/* Assembles A. D: weights of the inequality constraints. */
PetscErrorCode IPCondenseMatrix(Tao tao, Vec D)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  PetscCall(PetscLogEventBegin(TAO_IPFilterCondense, tao, ((TAO_IPFILTER *)tao->data)->hess->H, NULL, NULL));
  ip->rec->nsystems++;
  PetscCall(IPRowsUpdate(tao, D));
  if (!ip->cond->rows.J) PetscCall(DropProduct(ip->cond));
  if (ip->hess->products) PetscCall(WriteOperator(tao));
  else if (Unconstrained(ip)) PetscCall(TakeHessian(tao));
  else PetscCall(WriteSum(tao));
  PetscCall(PetscLogEventEnd(TAO_IPFilterCondense, tao, ((TAO_IPFILTER *)tao->data)->hess->H, NULL, NULL));
  PetscFunctionReturn(0);
}

/*
   Computes the right-hand side b for the pairs' targets and the primal residual rc: c - s, or that of a second-order
   correction
*/
PetscErrorCode IPCondenseRHS(Tao tao, Vec rc, Vec b)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  PetscCall(VecAXPBY(b, -1.0, 0.0, tao->gradient));
  if (ip->mi) {
    Vec pressure, force;

    PetscCall(IPGetWork(tao, IP_INEQUALITIES, &pressure));
    PetscCall(IPGetWork(tao, IP_INEQUALITIES, &force));
    PetscCall(IPSlackSigma(tao, pressure));
    PetscCall(VecPointwiseMult(pressure, pressure, rc));
    PetscCall(IPSlackForce(tao, force));
    PetscCall(VecAYPX(pressure, -1.0, force));
    PetscCall(MatMultTransposeAdd(ip->jac->inequality, pressure, b, b));
    PetscCall(IPRestoreWork(tao, IP_INEQUALITIES, &force));
    PetscCall(IPRestoreWork(tao, IP_INEQUALITIES, &pressure));
  }
  PetscCall(IPBoundsAddForces(tao, b));
  PetscFunctionReturn(0);
}

/*
   Computes the directions of slacks, multipliers and bounds from dx: ds = J dx + rc, lambda + dlambda = target/s -
   (z/s) ds
*/
PetscErrorCode IPBackSubstitute(Tao tao, Vec rc)
{
  TAO_IPFILTER *ip    = (TAO_IPFILTER *)tao->data;
  IPPair       *slack = &ip->pair[IP_SLACK];

  PetscFunctionBegin;
  if (ip->mi) PetscCall(MatMultAdd(ip->jac->inequality, ip->dir.x, rc, slack->dt));
  if (ip->mi) PetscCall(IPSlackDirection(tao));
  PetscCall(IPBoundsDirection(tao));
  for (PetscInt b = IP_LOWER; b <= IP_UPPER; b++) PetscCall(IPPairDualDirection(&ip->pair[b]));
  PetscFunctionReturn(0);
}
