/* Residuals of the optimality conditions, and the scales they are measured by. */
#include "ipfilterimpl.h"

/* r = grad f + J_E^T y - J^T M multiplier - bound multipliers, for multipliers lambda or z of the slacks */
PetscErrorCode IPStationarity(Tao tao, Vec multiplier, Vec r)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  PetscCall(VecCopy(tao->gradient, r));
  if (ip->mi) {
    PetscCall(VecPointwiseMult(ip->cwork, multiplier, ip->pair[IP_SLACK].w));
    PetscCall(VecScale(ip->cwork, -1.0));
    PetscCall(MatMultTransposeAdd(ip->cond.J, ip->cwork, r, r));
  }
  if (ip->me) PetscCall(MatMultTransposeAdd(ip->JE, ip->y, r, r));
  for (PetscInt b = IP_LOWER; b <= IP_UPPER; b++) {
    if (!ip->pair[b].n) continue;
    PetscCall(VecPointwiseMult(ip->xwork2, ip->pair[b].w, ip->pair[b].z));
    PetscCall(VecAXPY(r, b == IP_LOWER ? -1.0 : 1.0, ip->xwork2));
  }
  PetscCall(IPFixedZero(tao, r));
  PetscFunctionReturn(0);
}

/* Size of the terms that make up the gradient at x: rounding keeps the stationarity residual above a few eps times this */
static PetscErrorCode RoundingFloor(Tao tao, PetscReal *floor)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  PetscCall(VecPointwiseMult(ip->xwork2, ip->hdiag, tao->solution));
  PetscCall(VecNorm(ip->xwork2, NORM_2, floor));
  *floor *= 10.0 * PETSC_MACHINE_EPSILON;
  PetscFunctionReturn(0);
}

/* rho_i = 1 / (m_i sum_j J_ij^2 / |H_jj|): the pressure that moves constraint i by one length, from the diagonal of H.
   Its inverse sums the compliances of both sides of a contact, so the softer side decides. A row that hardly moves anything
   (a vertex at the edge of an overlap) counts as no more than 100 times as stiff as the mean: no scale may hang on it. */
PetscErrorCode IPComputeStiffness(Tao tao)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  Mat           scaled;
  PetscScalar  *h, *rho, sum;
  PetscReal     hmax, mean;
  PetscInt      n, rstart, rend;

  PetscFunctionBegin;
  PetscCall(MatGetDiagonal(tao->hessian, ip->hdiag));
  PetscCall(VecAbs(ip->hdiag));
  PetscCall(VecSum(ip->hdiag, &ip->hscale));
  PetscCall(VecGetSize(ip->hdiag, &n));
  ip->hscale = ip->hscale > 0.0 ? ip->hscale / n : 1.0;
  PetscCall(RoundingFloor(tao, &ip->floor0));
  if (!ip->mi) PetscFunctionReturn(0);
  PetscCall(VecMax(ip->hdiag, NULL, &hmax));
  if (!(hmax > 0.0)) hmax = 1.0;
  PetscCall(VecCopy(ip->hdiag, ip->xwork));
  PetscCall(VecGetLocalSize(ip->xwork, &n));
  PetscCall(VecGetArray(ip->xwork, &h));
  for (PetscInt j = 0; j < n; j++) h[j] = 1.0 / PetscSqrtReal(PetscMax(PetscRealPart(h[j]), 1e-8 * hmax));
  PetscCall(VecRestoreArray(ip->xwork, &h));
  PetscCall(MatDuplicate(ip->cond.J, MAT_COPY_VALUES, &scaled));
  PetscCall(MatDiagonalScale(scaled, NULL, ip->xwork));
  PetscCall(MatGetOwnershipRange(scaled, &rstart, &rend));
  PetscCall(VecGetArrayWrite(ip->stiffness, &rho));
  for (PetscInt i = rstart; i < rend; i++) {
    const PetscScalar *v;
    PetscInt           nv;
    PetscReal          compliance = 0.0;

    PetscCall(MatGetRow(scaled, i, &nv, NULL, &v));
    for (PetscInt k = 0; k < nv; k++) compliance += PetscSqr(PetscAbsScalar(v[k]));
    PetscCall(MatRestoreRow(scaled, i, &nv, NULL, &v));
    rho[i - rstart] = compliance;
  }
  PetscCall(VecRestoreArrayWrite(ip->stiffness, &rho));
  PetscCall(MatDestroy(&scaled));
  PetscCall(VecPointwiseMult(ip->stiffness, ip->stiffness, ip->pair[IP_SLACK].w));
  PetscCall(VecDot(ip->stiffness, ip->pair[IP_SLACK].w, &sum));
  mean               = PetscRealPart(sum) / ip->pair[IP_SLACK].weight;
  ip->stiffness_mean = mean > 0.0 ? 1.0 / mean : 1.0;
  PetscCall(VecGetArray(ip->stiffness, &rho));
  for (PetscInt i = 0; i < rend - rstart; i++) rho[i] = mean > 0.0 ? 1.0 / PetscMax(PetscRealPart(rho[i]), 1e-2 * mean) : 1.0;
  PetscCall(VecRestoreArray(ip->stiffness, &rho));
  PetscFunctionReturn(0);
}

/* size, but no more than a limit taken from the start, if there is one: an iterate that runs away must not make its
   residuals look small */
static PetscReal Within(PetscReal size, PetscReal limit)
{
  return limit > 0.0 ? PetscMin(size, limit) : size;
}

/* Fractions of first values that stand in for scales which vanish, and the most an iterate may exceed its first size by */
#define IP_SMALL 1e-3
#define IP_MOST  100.0

/* Lengths and pressures of the inequality constraints. Where every constraint is active from the start, values and
   slacks say nothing: displacements do. Pressures would not: those of infeasible constraints grow without limit. */
static PetscErrorCode InequalityScale(Tao tao, PetscReal xsize)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  IPScale      *s  = &ip->scale;
  PetscReal     c, t;

  PetscFunctionBegin;
  PetscCall(VecNorm(ip->c, NORM_INFINITY, &c));
  PetscCall(VecNorm(ip->pair[IP_SLACK].t, NORM_INFINITY, &t));
  PetscCall(VecNorm(ip->pair[IP_SLACK].z, NORM_INFINITY, &s->pressure));
  s->length   = PetscMax(Within(PetscMax(c, t), IP_MOST * ip->length0), 10.0 * IP_SMALL * PetscMax(ip->length0, ip->jnorm * xsize));
  s->pressure = PetscMax(s->pressure, IP_SMALL * ip->stiffness_mean * s->length);
  s->product  = s->length * s->pressure;
  PetscFunctionReturn(0);
}

/* Scales of the residuals. They follow the problem's units, so that a change of units changes no decision:
   forces against the forces that cancel, constraints against their largest value, products t z against length times
   pressure. Where these vanish, small fractions of first values, and of the stiffness's pressure, take their place. */
PetscErrorCode IPComputeScale(Tao tao)
{
  TAO_IPFILTER   *ip      = (TAO_IPFILTER *)tao->data;
  const PetscBool limited = (PetscBool)(ip->mi || ip->me || ip->pair[IP_LOWER].n || ip->pair[IP_UPPER].n);
  PetscReal       norm, floor, xsize, z;
  IPScale        *s = &ip->scale;

  PetscFunctionBegin;
  *s = (IPScale){1.0, 1.0, 1.0, 1.0, 1.0};
  if (ip->scaling == IP_SCALING_NONE || ip->measure == IP_KKT_MASS) PetscFunctionReturn(0);
  *s = (IPScale){0.0, 0.0, 0.0, 0.0, 0.0};
  PetscCall(VecNorm(tao->gradient, NORM_2, &norm));
  PetscCall(RoundingFloor(tao, &floor));
  s->dual = PetscMax(norm, (limited ? IP_SMALL : 1.0) * ip->gradient0);
  s->dual = PetscMax(s->dual, Within(floor / ip->tol, PetscMax(ip->gradient0, ip->floor0 / ip->tol)));
  PetscCall(VecNorm(tao->solution, NORM_INFINITY, &xsize));
  xsize = PetscMax(Within(xsize, IP_MOST * ip->xsize0), ip->xsize0);
  if (ip->mi) PetscCall(InequalityScale(tao, xsize));
  if (ip->me) {
    PetscCall(MatMult(ip->JE, tao->solution, ip->cetrial));
    PetscCall(VecNorm(ip->cetrial, NORM_INFINITY, &norm));
    s->equality = PetscMax(ip->equality0, norm);
  }
  for (PetscInt b = IP_LOWER; b <= IP_UPPER; b++) {
    if (!ip->pair[b].n) continue;
    PetscCall(VecNorm(ip->pair[b].z, NORM_INFINITY, &z));
    s->product = PetscMax(s->product, xsize * PetscMax(z, IP_SMALL * ip->hscale * xsize));
  }
  if (!(s->dual > 0.0)) s->dual = 1.0;
  if (!(s->length > 0.0)) s->length = 1.0;
  if (!(s->equality > 0.0)) s->equality = 1.0;
  if (!(s->pressure > 0.0)) s->pressure = 1.0;
  if (!(s->product > 0.0)) s->product = 1.0;
  PetscFunctionReturn(0);
}

/* r += |J|^T |M multiplier|, M = 1 where it is NULL */
static PetscErrorCode AddAbsoluteForces(Mat J, Vec multiplier, Vec weights, Vec work, Vec r)
{
  const PetscScalar *z;
  PetscInt           rstart, rend;

  PetscFunctionBegin;
  PetscCall(VecCopy(multiplier, work));
  if (weights) PetscCall(VecPointwiseMult(work, work, weights));
  PetscCall(MatGetOwnershipRange(J, &rstart, &rend));
  PetscCall(VecGetArrayRead(work, &z));
  for (PetscInt i = rstart; i < rend; i++) {
    const PetscScalar *v;
    const PetscInt    *column;
    PetscInt           n;

    PetscCall(MatGetRow(J, i, &n, &column, &v));
    for (PetscInt k = 0; k < n; k++) PetscCall(VecSetValue(r, column[k], PetscAbsScalar(v[k] * z[i - rstart]), ADD_VALUES));
    PetscCall(MatRestoreRow(J, i, &n, &column, &v));
  }
  PetscCall(VecRestoreArrayRead(work, &z));
  PetscCall(VecAssemblyBegin(r));
  PetscCall(VecAssemblyEnd(r));
  PetscFunctionReturn(0);
}

/* How many times larger the constraints' forces are than the gradient that they balance together. Large where they cancel one
   another: no bounded multipliers need exist then, and errors measured by multipliers mean nothing. */
PetscErrorCode IPCancellation(Tao tao, PetscReal *times)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  PetscReal     force, gradient;

  PetscFunctionBegin;
  PetscCall(VecSet(ip->xwork, 0.0));
  if (ip->mi) PetscCall(AddAbsoluteForces(ip->cond.J, ip->pair[IP_SLACK].z, ip->pair[IP_SLACK].w, ip->cwork, ip->xwork));
  if (ip->me) PetscCall(AddAbsoluteForces(ip->JE, ip->y, NULL, ip->cetrial, ip->xwork));
  for (PetscInt b = IP_LOWER; b <= IP_UPPER; b++) {
    if (!ip->pair[b].n) continue;
    PetscCall(VecPointwiseMult(ip->xwork2, ip->pair[b].w, ip->pair[b].z));
    PetscCall(VecAXPY(ip->xwork, 1.0, ip->xwork2));
  }
  PetscCall(VecNorm(ip->xwork, NORM_INFINITY, &force));
  PetscCall(VecNorm(tao->gradient, NORM_INFINITY, &gradient));
  gradient = PetscMax(gradient, IP_SMALL * ip->gradient0);
  *times   = gradient > 0.0 ? force / gradient : 0.0;
  PetscFunctionReturn(0);
}

/* sqrt(r_u^T M_u^-1 r_u + r_s^T M_s^-1 r_s), with r_s = M_s (lambda - z) */
static PetscErrorCode DualMassNorm(Tao tao, PetscReal *norm)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  PetscScalar   uu, ss = 0.0;

  PetscFunctionBegin;
  if (ip->primal_mass) PetscCall(VecPointwiseDivide(ip->xwork2, ip->rx, ip->primal_mass));
  else PetscCall(VecCopy(ip->rx, ip->xwork2));
  PetscCall(VecDot(ip->rx, ip->xwork2, &uu));
  if (ip->mi) {
    PetscCall(VecWAXPY(ip->cwork, -1.0, ip->pair[IP_SLACK].z, ip->lambda));
    PetscCall(VecPointwiseMult(ip->cwork2, ip->cwork, ip->pair[IP_SLACK].w));
    PetscCall(VecDot(ip->cwork, ip->cwork2, &ss));
  }
  *norm = PetscSqrtReal(PetscRealPart(uu) + PetscRealPart(ss));
  PetscFunctionReturn(0);
}

/* ||lambda - z|| in the norm of the weights, per unit weight: the stationarity residual of the slacks */
static PetscErrorCode SlackStationarity(Tao tao, PetscReal *norm)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  PetscScalar   ss;

  PetscFunctionBegin;
  *norm = 0.0;
  if (!ip->mi) PetscFunctionReturn(0);
  PetscCall(VecWAXPY(ip->cwork, -1.0, ip->pair[IP_SLACK].z, ip->lambda));
  PetscCall(VecPointwiseMult(ip->cwork2, ip->cwork, ip->pair[IP_SLACK].w));
  PetscCall(VecDot(ip->cwork, ip->cwork2, &ss));
  *norm = PetscSqrtReal(PetscRealPart(ss) / ip->pair[IP_SLACK].weight);
  PetscFunctionReturn(0);
}

/* Residuals and errors at the current iterate: fills ip->rx, ip->rc, ip->scale and ip->kkt */
PetscErrorCode IPComputeKKT(Tao tao)
{
  TAO_IPFILTER *ip  = (TAO_IPFILTER *)tao->data;
  IPKKT        *k   = &ip->kkt;
  PetscReal     products = 0.0, deviation = 0.0;

  PetscFunctionBegin;
  PetscCall(IPComputeScale(tao));
  PetscCall(IPStationarity(tao, ip->lambda, ip->rx));
  PetscCall(VecNorm(ip->rx, NORM_2, &k->dual_norm));
  PetscCall(VecNorm(ip->rx, NORM_INFINITY, &k->inf_du));
  k->inf_pr = k->primal = 0.0;
  if (ip->mi) {
    PetscCall(VecWAXPY(ip->rc, -1.0, ip->pair[IP_SLACK].t, ip->c));
    PetscCall(VecNorm(ip->rc, NORM_INFINITY, &k->primal));
    k->primal /= ip->scale.length;
    PetscCall(IPScalingNorm(ip->rc, ip->cscale, ip->cwork, &k->inf_pr));
  }
  if (ip->me) {
    PetscReal equality;

    PetscCall(VecNorm(ip->ce, NORM_INFINITY, &equality));
    k->primal = PetscMax(k->primal, equality / ip->scale.equality);
    PetscCall(IPScalingNorm(ip->ce, ip->cescale, ip->cetrial, &equality));
    k->inf_pr = PetscMax(k->inf_pr, equality);
  }
  for (PetscInt b = 0; b < IP_NPAIRS; b++) {
    PetscReal zero, central;

    PetscCall(IPPairProducts(&ip->pair[b], 0.0, &zero, NULL));
    PetscCall(IPPairProducts(&ip->pair[b], ip->mu, &central, NULL));
    products  = PetscMax(products, zero);
    deviation = PetscMax(deviation, central);
  }
  if (ip->measure == IP_KKT_MASS) PetscCall(DualMassNorm(tao, &k->dual));
  else {
    PetscCall(SlackStationarity(tao, &k->dual));
    k->dual = PetscMax(k->dual / ip->scale.pressure, k->dual_norm / ip->scale.dual);
  }
  k->complementarity = products / ip->scale.product;
  k->centrality      = deviation / ip->scale.product;
  k->error           = PetscMax(PetscMax(k->dual, k->primal), k->complementarity);
  k->barrier         = PetscMax(PetscMax(k->dual, k->primal), k->centrality);
  k->unscaled        = PetscMax(PetscMax(k->inf_du, k->inf_pr), products);
  PetscFunctionReturn(0);
}
