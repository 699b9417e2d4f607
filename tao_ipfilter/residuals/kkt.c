/* Computes the residuals of the optimality conditions */
#include "residualsimpl.h"
#include "tao_ipfilter/solver/constants.h"
#include "tao_ipfilter/solver/kkt.h"
#include "tao_ipfilter/solver/matrices.h"
#include "tao_ipfilter/solver/options.h"
#include "tao_ipfilter/solver/relaxation.h"
#include "tao_ipfilter/solver/sizes.h"

/*
   Computes r = grad f + J_E^T y - J^T M multiplier - bound multipliers - forces of the norm terms. multiplier: lambda
   or z.
*/
PetscErrorCode IPStationarity(Tao tao, Vec multiplier, Vec r)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  Vec           force;

  PetscFunctionBegin;
  PetscCall(VecCopy(tao->gradient, r));
  if (ip->mi) {
    PetscCall(IPGetWork(tao, IP_INEQUALITIES, &force));
    PetscCall(VecPointwiseMult(force, multiplier, ip->pair[IP_SLACK].w));
    PetscCall(VecScale(force, -1.0));
    PetscCall(MatMultTransposeAdd(ip->jac->inequality, force, r, r));
    PetscCall(IPRestoreWork(tao, IP_INEQUALITIES, &force));
  }
  if (ip->me) PetscCall(MatMultTransposeAdd(ip->jac->equality, ip->at.y, r, r));
  PetscCall(IPTermsSubtractForces(tao, r));
  PetscCall(IPGetWork(tao, IP_UNKNOWNS, &force));
  for (PetscInt b = IP_LOWER; b <= IP_UPPER; b++) {
    IPPair *p = &ip->pair[b];

    if (!p->n) continue;
    PetscCall(VecPointwiseMult(force, p->w, p->z));
    PetscCall(VecAXPY(r, -p->sign, force));
  }
  PetscCall(IPRestoreWork(tao, IP_UNKNOWNS, &force));
  PetscCall(IPFixedZero(tao, r));
  PetscFunctionReturn(0);
}

/*
   Computes sum m (lambda - z)^2, the square of the weighted norm of the slacks' stationarity residual; z is that of
   both sides
*/
static PetscErrorCode SlackStationarity(Tao tao, PetscReal *square)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  Vec           difference;

  PetscFunctionBegin;
  *square = 0.0;
  if (!ip->mi) PetscFunctionReturn(0);
  PetscCall(IPGetWork(tao, IP_INEQUALITIES, &difference));
  PetscCall(IPSlackPressure(tao, difference));
  PetscCall(VecAYPX(difference, -1.0, ip->at.lambda));
  PetscCall(IPPairWeightedSquare(tao, difference, square));
  PetscCall(IPRestoreWork(tao, IP_INEQUALITIES, &difference));
  PetscFunctionReturn(0);
}

/* Returns the larger number, or NaN if one of them is NaN. PetscMax() ignores a NaN in its second argument. */
static PetscReal Larger(PetscReal a, PetscReal b)
{
  return a > b || PetscIsNanReal(a) ? a : b;
}

/* Computes sqrt(r_u^T M_u^-1 r_u + r_s^T M_s^-1 r_s) with r_s = M_s (lambda - z) */
static PetscErrorCode DualMassNorm(Tao tao, PetscReal *norm)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  Vec           scaled;
  PetscScalar   uu;
  PetscReal     ss;

  PetscFunctionBegin;
  PetscCall(IPGetWork(tao, IP_UNKNOWNS, &scaled));
  if (ip->given->primal_mass) PetscCall(VecQuotient_AMGF(scaled, ip->rx, ip->given->primal_mass));
  else PetscCall(VecCopy(ip->rx, scaled));
  PetscCall(VecDot(ip->rx, scaled, &uu));
  PetscCall(IPRestoreWork(tao, IP_UNKNOWNS, &scaled));
  PetscCall(SlackStationarity(tao, &ss));
  *norm = PetscSqrtReal(PetscRealPart(uu) + ss);
  PetscFunctionReturn(0);
}

/*
   Computes the size of the stationarity residual: the mass-weighted norm, or the largest of its parts relative to their
   scales
*/
static PetscErrorCode DualError(Tao tao, PetscReal *dual)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  PetscReal     slacks;

  PetscFunctionBegin;
  if (ip->opt->measure == IP_KKT_MASS) {
    PetscCall(DualMassNorm(tao, dual));
    PetscFunctionReturn(0);
  }
  PetscCall(SlackStationarity(tao, &slacks));
  if (ip->mi) slacks = PetscSqrtReal(slacks / ip->pair[IP_SLACK].weight);
  *dual = Larger(slacks / ip->scale->pressure, ip->kkt->dual_norm / ip->scale->dual);
  PetscFunctionReturn(0);
}

/*
   Returns the scale of kkt->violation, by which successive iterates are compared: the constraints' first values, or |J|
   |x| at the start. If both are zero or of the size of rounding errors, the scale is 1.
*/
static PetscReal FirstSize(const TAO_IPFILTER *ip, PetscReal values, PetscReal jacobian, PetscReal now)
{
  PetscReal size = PetscMax(values, jacobian * ip->first->x);

  if (size <= PETSC_MACHINE_EPSILON * now) size = 0.0;
  return ip->opt->scaling == IP_SCALING_PROBLEM && size > 0.0 ? size : 1.0;
}

/*
   Sets ip->rc = c_I - s, with the compliance of rows. *primal: largest violation of the constraints and of the laws of
   norm terms, relative to their scales; *largest: largest violation of the constraints in the caller's units.
*/
static PetscErrorCode PrimalError(Tao tao, PetscReal *primal, PetscReal *largest)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  PetscReal     norm;

  PetscFunctionBegin;
  *primal = *largest = ip->kkt->violation = 0.0;
  if (ip->mi) {
    PetscCall(IPSlackYield(tao, ip->at.lambda, ip->rc));
    PetscCall(IPSlackViolation(tao, ip->rc, ip->rc));
    PetscCall(VecNorm(ip->rc, NORM_INFINITY, &norm));
    ip->kkt->violation = norm / FirstSize(ip, ip->first->length, ip->first->jacobian, ip->scale->length);
    PetscCall(IPSlackYield(tao, ip->at.lambda, ip->rc));
    PetscCall(VecAXPY(ip->rc, -1.0, ip->pair[IP_SLACK].t));
    PetscCall(VecNorm(ip->rc, NORM_INFINITY, &norm));
    *primal = norm / ip->scale->length;
    PetscCall(IPRowScaleNorm(tao, IP_INEQUALITIES, ip->rc, largest));
  }
  if (ip->me) {
    PetscCall(VecNorm(ip->at.ce, NORM_INFINITY, &norm));
    *primal            = Larger(*primal, norm / ip->scale->equality);
    ip->kkt->violation = Larger(ip->kkt->violation,
      norm / FirstSize(ip, ip->first->equality, ip->first->equality_jacobian, ip->scale->equality));
    PetscCall(IPRowScaleNorm(tao, IP_EQUALITIES, ip->at.ce, &norm));
    *largest = Larger(*largest, norm);
  }
  PetscCall(IPTermsViolation(tao, &norm));
  *primal  = Larger(*primal, norm / ip->scale->length);
  *largest = Larger(*largest, norm);
  PetscFunctionReturn(0);
}

/* Returns the larger one of the two measures of the KKT error, kkt->error and kkt->work */
PetscReal IPBothErrors(const TAO_IPFILTER *ip)
{
  return Larger(ip->kkt->error, ip->kkt->work);
}

/*
   Sets kkt->own, the violation relative to the constraints' own terms, if the violation has almost converged; otherwise
   it is infinite. It is zero, that is, not used, unless residuals are relative to the problem's scales.
*/
static PetscErrorCode OwnNearEnd(Tao tao)
{
  TAO_IPFILTER   *ip   = (TAO_IPFILTER *)tao->data;
  const PetscReal near = PetscMax(ip->tol, IP_ACCEPTABLE_TOL);

  PetscFunctionBegin;
  ip->kkt->own = 0.0;
  if (ip->opt->scaling != IP_SCALING_PROBLEM || ip->opt->measure == IP_KKT_MASS) PetscFunctionReturn(0);
  if (ip->kkt->inf_pr == 0.0 && !ip->relax->times) PetscFunctionReturn(0);
  if (ip->kkt->primal <= near) PetscCall(IPOwnViolation(tao, &ip->kkt->own));
  else ip->kkt->own = PETSC_INFINITY;
  PetscFunctionReturn(0);
}

/* Computes residuals, scales and errors at the current iterate: ip->rx, ip->rc, ip->scale and ip->kkt */
PetscErrorCode IPComputeKKT(Tao tao)
{
  TAO_IPFILTER *ip       = (TAO_IPFILTER *)tao->data;
  IPKKT        *k        = ip->kkt;
  PetscReal     products = 0.0, deviation = 0.0;

  PetscFunctionBegin;
  PetscCall(IPComputeScale(tao));
  if (ip->opt->measure == IP_KKT_RELATIVE) PetscCall(IPErrorBoundEnergy(tao, &ip->scale->energy, &ip->scale->present));
  PetscCall(IPStationarity(tao, ip->at.lambda, ip->rx));
  PetscCall(VecNorm(ip->rx, NORM_2, &k->dual_norm));
  PetscCall(VecNorm(ip->rx, NORM_INFINITY, &k->inf_du));
  PetscCall(DualError(tao, &k->dual));
  PetscCall(PrimalError(tao, &k->primal, &k->inf_pr));
  for (PetscInt b = 0; b < IP_NPAIRS; b++) {
    PetscReal zero, central;

    PetscCall(IPPairProducts(&ip->pair[b], 0.0, &zero, NULL));
    PetscCall(IPPairProducts(&ip->pair[b], ip->mu, &central, NULL));
    products  = Larger(products, zero);
    deviation = Larger(deviation, central);
  }
  k->inf_compl       = products;
  k->complementarity = products / ip->scale->product;
  k->centrality      = deviation / ip->scale->product;
  k->error           = Larger(Larger(k->dual, k->primal), k->complementarity);
  PetscCall(IPErrorBoundOfResiduals(tao));
  PetscCall(OwnNearEnd(tao));
  k->unscaled = Larger(Larger(k->inf_du, k->inf_pr), products);
  PetscFunctionReturn(0);
}
