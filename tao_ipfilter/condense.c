/*
   The condensed system. Eliminating slacks and multipliers from Newton's system leaves

     A d = b,   A = H + Sigma + J^T D J + delta M_u,   D = M_s z/s,
     b = -grad f + J^T (M_s target/s - D (c - s)) + bound terms.

   How H and J^T D J get into A: condensedmat.c.
*/
#include "ipfilterimpl.h"

PetscErrorCode IPCondensedDestroy(IPCondensed *c)
{
  PetscFunctionBegin;
  PetscCall(MatDestroy(&c->A));
  PetscCall(MatDestroy(&c->J));
  PetscCall(MatDestroy(&c->DJ));
  PetscCall(MatDestroy(&c->JtDJ));
  PetscCall(VecDestroy(&c->shift));
  PetscCall(VecDestroy(&c->hdiag));
  PetscCall(ISDestroy(&c->filter));
  PetscCall(PetscFree(c->rows));
  PetscCall(PetscMemzero(c, sizeof(*c)));
  PetscFunctionReturn(0);
}

/* Takes over the inequality Jacobian: an AIJ view of it, scaled and without fixed variables, and the filter's unknowns. Keeps the IS while its entries stay. */
PetscErrorCode IPCondenseJacobian(Tao tao)
{
  TAO_IPFILTER    *ip   = (TAO_IPFILTER *)tao->data;
  IPCondensed     *cond = &ip->cond;
  Mat              user = tao->jacobian_inequality;
  PetscObjectState state;
  PetscBool        aij;
  Mat              J;
  IS               filter;

  PetscFunctionBegin;
  PetscCall(PetscObjectStateGet((PetscObject)user, &state));
  if (cond->J && state == cond->J_state && cond->J_id == ((PetscObject)user)->id) PetscFunctionReturn(0);
  cond->J_state = state;
  cond->J_id    = ((PetscObject)user)->id;
  PetscCall(MatGetNonzeroState(user, &cond->J_nonzero));
  PetscCall(PetscObjectBaseTypeCompareAny((PetscObject)user, &aij, MATSEQAIJ, MATMPIAIJ, ""));
  PetscCall(MatDestroy(&cond->J));
  if (aij) {
    PetscCall(PetscObjectReference((PetscObject)user));
    J = user;
  } else PetscCall(MatConvert(user, MATAIJ, MAT_INITIAL_MATRIX, &J));
  PetscCall(IPScalingJacobian(tao, J, ip->cscale, &cond->J));
  PetscCall(MatDestroy(&J));
  PetscCall(IPSubspaceFind(tao, &filter));
  if (cond->filter) {
    PetscBool same;

    PetscCall(ISEqual(filter, cond->filter, &same));
    if (same) {
      PetscCall(ISDestroy(&filter));
      PetscFunctionReturn(0);
    }
    PetscCall(ISDestroy(&cond->filter));
  }
  cond->filter = filter;
  PetscFunctionReturn(0);
}

/* J^T D J and the rows of this rank it touches; *changed tells that its pattern is new */
static PetscErrorCode UpdateProduct(Tao tao, Vec D, PetscBool *changed)
{
  TAO_IPFILTER *ip   = (TAO_IPFILTER *)tao->data;
  IPCondensed  *cond = &ip->cond;
  PetscInt      rstart, rend;

  PetscFunctionBegin;
  *changed = (PetscBool)(!cond->JtDJ || cond->JtDJ_nonzero != cond->J_nonzero || cond->JtDJ_id != cond->J_id);
  if (*changed) {
    PetscCall(MatDestroy(&cond->DJ));
    PetscCall(MatDestroy(&cond->JtDJ));
    PetscCall(MatDuplicate(cond->J, MAT_COPY_VALUES, &cond->DJ));
    cond->JtDJ_nonzero = cond->J_nonzero;
    cond->JtDJ_id      = cond->J_id;
  } else PetscCall(MatCopy(cond->J, cond->DJ, SAME_NONZERO_PATTERN));
  PetscCall(MatDiagonalScale(cond->DJ, D, NULL));
  PetscCall(MatTransposeMatMult(cond->J, cond->DJ, *changed ? MAT_INITIAL_MATRIX : MAT_REUSE_MATRIX, PETSC_DEFAULT, &cond->JtDJ));
  if (!*changed) PetscFunctionReturn(0);
  PetscCall(PetscFree(cond->rows));
  PetscCall(MatGetOwnershipRange(cond->JtDJ, &rstart, &rend));
  for (PetscInt pass = 0; pass < 2; pass++) {
    if (pass) PetscCall(PetscMalloc1(cond->nrows, &cond->rows));
    cond->nrows = 0;
    for (PetscInt i = rstart; i < rend; i++) {
      PetscInt nc;

      PetscCall(MatGetRow(cond->JtDJ, i, &nc, NULL, NULL));
      if (nc) {
        if (pass) cond->rows[cond->nrows] = i;
        cond->nrows++;
      }
      PetscCall(MatRestoreRow(cond->JtDJ, i, &nc, NULL, NULL));
    }
  }
  PetscFunctionReturn(0);
}

/* Diagonal of A: that of H plus Sigma of the bounds plus delta M_u. A second shift of zero restores H's diagonal. */
static PetscErrorCode WriteDiagonal(Tao tao)
{
  TAO_IPFILTER      *ip   = (TAO_IPFILTER *)tao->data;
  IPCondensed       *cond = &ip->cond;
  const PetscScalar *d;
  PetscInt           rstart, rend;
  PetscBool          shifted = (PetscBool)(ip->delta > 0.0);

  PetscFunctionBegin;
  PetscCall(VecSet(cond->shift, 0.0));
  for (PetscInt b = IP_LOWER; b <= IP_UPPER; b++) {
    if (!ip->pair[b].n) continue;
    PetscCall(IPPairGetSigma(&ip->pair[b], ip->xwork));
    PetscCall(VecAXPY(cond->shift, 1.0, ip->xwork));
    shifted = PETSC_TRUE;
  }
  if (ip->delta > 0.0 && ip->primal_mass) PetscCall(VecAXPY(cond->shift, ip->delta, ip->primal_mass));
  else if (ip->delta > 0.0) PetscCall(VecShift(cond->shift, ip->delta));
  if (!shifted && !cond->shifted) PetscFunctionReturn(0);
  cond->shifted = shifted;
  PetscCall(MatGetDiagonal(tao->hessian, cond->hdiag));
  PetscCall(VecAXPY(cond->hdiag, 1.0, cond->shift));
  PetscCall(MatGetOwnershipRange(cond->A, &rstart, &rend));
  PetscCall(VecGetArrayRead(cond->hdiag, &d));
  for (PetscInt i = rstart; i < rend; i++) PetscCall(MatSetValue(cond->A, i, i, d[i - rstart], INSERT_VALUES));
  PetscCall(VecRestoreArrayRead(cond->hdiag, &d));
  PetscFunctionReturn(0);
}

/* Whether nothing is ever added to H */
static PetscBool Unconstrained(const TAO_IPFILTER *ip)
{
  return (PetscBool)(!ip->mi && !ip->fixed && !ip->pair[IP_LOWER].n && !ip->pair[IP_UPPER].n && ip->delta == 0.0);
}

/* Assembles A = H + Sigma + J^T D J + delta M_u for the given D */
PetscErrorCode IPCondenseMatrix(Tao tao, Vec D)
{
  TAO_IPFILTER    *ip   = (TAO_IPFILTER *)tao->data;
  IPCondensed     *cond = &ip->cond;
  Mat              H    = tao->hessian;
  PetscObjectState state, nonzero;
  PetscBool        pattern = PETSC_FALSE, all;

  PetscFunctionBegin;
  PetscCall(PetscLogEventBegin(TAO_IPFilterCondense, tao, H, NULL, NULL));
  ip->nsystems++;
  PetscCall(PetscObjectStateGet((PetscObject)H, &state));
  PetscCall(MatGetNonzeroState(H, &nonzero));
  if (Unconstrained(ip)) {
    PetscCall(PetscObjectReference((PetscObject)H));
    PetscCall(MatDestroy(&cond->A));
    cond->A       = H;
    cond->H_state = 0;
    PetscCall(PetscLogEventEnd(TAO_IPFilterCondense, tao, H, NULL, NULL));
    PetscFunctionReturn(0);
  }
  if (ip->mi) {
    PetscCall(UpdateProduct(tao, D, &pattern));
    PetscCall(IPSubspaceSwitch(tao));
  }
  pattern = (PetscBool)(pattern || !cond->A || cond->A == H || nonzero != cond->H_nonzero || cond->H_id != ((PetscObject)H)->id);
  all     = (PetscBool)(pattern || state != cond->H_state);
  if (!cond->shift) {
    PetscCall(VecDuplicate(tao->solution, &cond->shift));
    PetscCall(VecDuplicate(tao->solution, &cond->hdiag));
  }
  cond->H_state   = state;
  cond->H_nonzero = nonzero;
  cond->H_id      = ((PetscObject)H)->id;
  PetscCall(IPCondensedWriteHessian(tao, pattern, all));
  PetscCall(WriteDiagonal(tao));
  if (cond->JtDJ) PetscCall(IPCondensedAddProduct(cond));
  PetscCall(MatAssemblyBegin(cond->A, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(cond->A, MAT_FINAL_ASSEMBLY));
  PetscCall(IPFixedMatrix(tao, cond->A));
  if (cond->filter) PetscCall(PetscObjectCompose((PetscObject)cond->A, PCAMGF_FILTER_KEY, (PetscObject)cond->filter));
  PetscCall(PetscLogEventEnd(TAO_IPFilterCondense, tao, H, NULL, NULL));
  PetscFunctionReturn(0);
}

/* b for the primal residual rc (c - s, or that of a second-order correction) and the pairs' targets */
PetscErrorCode IPCondenseRHS(Tao tao, Vec rc, Vec b)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  PetscCall(VecCopy(tao->gradient, b));
  PetscCall(VecScale(b, -1.0));
  if (ip->mi) {
    PetscCall(IPPairGetSigma(&ip->pair[IP_SLACK], ip->cwork));
    PetscCall(VecPointwiseMult(ip->cwork, ip->cwork, rc));
    PetscCall(IPPairGetForce(&ip->pair[IP_SLACK], ip->cwork2));
    PetscCall(VecAYPX(ip->cwork, -1.0, ip->cwork2));
    PetscCall(MatMultTransposeAdd(ip->cond.J, ip->cwork, b, b));
  }
  for (PetscInt k = IP_LOWER; k <= IP_UPPER; k++) {
    if (!ip->pair[k].n) continue;
    PetscCall(IPPairGetForce(&ip->pair[k], ip->xwork));
    PetscCall(VecAXPY(b, k == IP_LOWER ? 1.0 : -1.0, ip->xwork));
  }
  PetscFunctionReturn(0);
}

/* Slack, multiplier and bound directions from dx: ds = J dx + rc, lambda + dlambda = target/s - (z/s) ds */
PetscErrorCode IPBackSubstitute(Tao tao, Vec rc)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  if (ip->mi) {
    IPPair *slack = &ip->pair[IP_SLACK];

    PetscCall(MatMultAdd(ip->cond.J, ip->dx, rc, slack->dt));
    PetscCall(IPPairDualDirection(slack));
    PetscCall(VecWAXPY(ip->dlambda, 1.0, slack->z, slack->dz));
    PetscCall(VecAXPY(ip->dlambda, -1.0, ip->lambda));
  }
  for (PetscInt b = IP_LOWER; b <= IP_UPPER; b++) {
    IPPair *p = &ip->pair[b];

    if (!p->n) continue;
    PetscCall(VecCopy(ip->dx, p->dt));
    if (b == IP_UPPER) PetscCall(VecScale(p->dt, -1.0));
    PetscCall(IPPairDualDirection(p));
  }
  PetscFunctionReturn(0);
}
