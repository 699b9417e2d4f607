/* Computes the scales by which residuals are divided */
#include "residualsimpl.h"
#include "tao_ipfilter/solver/matrices.h"
#include "tao_ipfilter/solver/method.h"
#include "tao_ipfilter/solver/options.h"
#include "tao_ipfilter/solver/sizes.h"
#include "tao_ipfilter/solver/stiffness.h"

#define IP_VANISHING 1e-3 /* fraction of a first value that replaces a vanishing scale */
#define IP_AMPLE \
  30.0                   /* a gradient is small if its Newton step moves the unknowns by less than this multiple of
                            the tolerance */
#define IP_RUNAWAY 100.0 /* largest size of an iterate relative to its first size that scales follow */

/*
   Returns `size`, but at most `limit`, a multiple of the size at the start: a diverging iterate must not make its
   residuals look small. A limit that is only rounding error is ignored.
*/
static PetscReal Within(PetscReal size, PetscReal limit)
{
  return limit > PETSC_MACHINE_EPSILON * size ? PetscMin(size, limit) : size;
}

/*
   Computes the length and pressure scales of the inequality constraints from their values and multipliers. If every
   constraint is active from the start, values and slacks are zero; the length is then computed from displacements. The
   multipliers of infeasible constraints grow without limit; therefore the pressure is computed with a limited length.
   If no constraint is active, the pressure is a small fraction of that which would balance the objective's gradient.
   Rows that are empty at the start have no length; slacks that vanish must not become the length.
*/
static PetscErrorCode InequalityScale(Tao tao, PetscReal xsize)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  IPScale      *s  = ip->scale;
  PetscReal     c, t, gradient, upper = 0.0;
  PetscReal     transmitted;

  PetscFunctionBegin;
  transmitted = ip->first->jacobian * ip->pair[IP_SLACK].weight / ip->mi;
  PetscCall(IPSizeWithinReach(tao, ip->at.c, &c));
  PetscCall(IPSizeWithinReach(tao, ip->pair[IP_SLACK].t, &t));
  PetscCall(VecNorm(ip->pair[IP_SLACK].z, NORM_INFINITY, &s->pressure));
  if (ip->pair[IP_CEILING].n) PetscCall(VecNorm(ip->pair[IP_CEILING].z, NORM_INFINITY, &upper));
  s->pressure = PetscMax(s->pressure, upper);
  s->length   = PetscMax(Within(PetscMax(c, t), IP_RUNAWAY * ip->first->length),
      10.0 * IP_VANISHING * PetscMax(ip->first->length, ip->first->jacobian * xsize));
  s->length   = PetscMax(s->length, IPConstraintRounding(ip) / ip->tol);
  if (ip->first->length == 0.0 && ip->first->jacobian == 0.0) s->length = PetscMax(s->length, 1.0);
  s->pressure = PetscMax(s->pressure, IP_VANISHING * ip->stiff->mean * s->length);
  PetscCall(VecNorm(tao->gradient, NORM_INFINITY, &gradient));
  if (transmitted > 0.0) s->balance = gradient / transmitted;
  s->pressure = PetscMax(s->pressure, IP_VANISHING * s->balance);
  s->product  = s->length * s->pressure;
  PetscFunctionReturn(0);
}

/*
   Computes the scale of the equality constraints: their first values, or the terms of their linear parts if these are
   larger
*/
static PetscErrorCode EqualityScale(Tao tao)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  PetscReal     norm;
  Vec           sums;

  PetscFunctionBegin;
  PetscCall(IPGetWork(tao, IP_EQUALITIES, &sums));
  PetscCall(IPOwnTerms(ip->jac->equality, tao->solution, sums, NULL));
  PetscCall(VecNorm(sums, NORM_INFINITY, &norm));
  ip->scale->equality_terms = norm;
  PetscCall(IPRestoreWork(tao, IP_EQUALITIES, &sums));
  ip->scale->equality = PetscMax(ip->first->equality,
    Within(norm, IP_RUNAWAY * PetscMax(ip->first->equality, ip->first->equality_jacobian * ip->first->x)));
  PetscFunctionReturn(0);
}

/*
   Computes the force scale, from the forces that cancel in the gradient. If none cancel it is the gradient at the
   start, limited by its present terms, so that a distant start does not make every gradient look small. A gradient
   below ten rounding errors of its terms is meaningless, and without constraints one below a hundred, since a start
   near the solution has a small gradient itself.
*/
static PetscErrorCode DualScale(Tao tao)
{
  TAO_IPFILTER   *ip       = (TAO_IPFILTER *)tao->data;
  const PetscBool limited  = (PetscBool)(ip->mi || ip->me || ip->pair[IP_LOWER].n || ip->pair[IP_UPPER].n);
  const PetscReal rounding = (limited ? 10.0 : 100.0) * PETSC_MACHINE_EPSILON;
  PetscReal       norm, terms, stiffness;
  const PetscReal least = PetscSqr(
    PETSC_MACHINE_EPSILON); /* fraction of the first gradient below which a gradient is small even if the unknowns
                               diverge */
  const PetscReal first = (limited ? IP_VANISHING : 1.0) * ip->first->gradient;

  PetscFunctionBegin;
  PetscCall(VecNorm(tao->gradient, NORM_2, &norm));
  PetscCall(IPStiffnessTerms(tao, &terms));
  PetscCall(VecNorm(ip->stiff->hdiag, NORM_2, &stiffness));
  ip->scale->dual = Within(first, IP_AMPLE * PetscMax(terms, IP_VANISHING * ip->first->x * stiffness));
  if (limited) ip->scale->dual = PetscMax(ip->scale->dual, norm);
  terms           = PetscMax(terms, ip->given->rounding * stiffness / rounding);
  ip->scale->dual = PetscMax(ip->scale->dual, PetscMax(rounding * terms, least * ip->first->gradient) / ip->tol);
  PetscFunctionReturn(0);
}

/*
   Computes the scales of the residuals. They have the problem's units, so that a change of units changes no decision.
   Forces are relative to the forces that cancel, constraints to their largest value, and products t z to length times
   pressure. A scale that vanishes is replaced by a small fraction of a first value, or by the pressure that follows
   from the stiffness.
*/
PetscErrorCode IPComputeScale(Tao tao)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  PetscReal     xsize, z;
  IPScale      *s = ip->scale;

  PetscFunctionBegin;
  *s        = (IPScale){.dual = 1.0, .length = 1.0, .equality = 1.0, .pressure = 1.0, .product = 1.0};
  s->energy = s->present = PETSC_INFINITY;
  if (ip->opt->scaling != IP_SCALING_PROBLEM || ip->opt->measure == IP_KKT_MASS) PetscFunctionReturn(0);
  *s = (IPScale){.dual = 0.0};
  PetscCall(DualScale(tao));
  PetscCall(VecNorm(tao->solution, NORM_INFINITY, &xsize));
  xsize = PetscMax(Within(xsize, IP_RUNAWAY * ip->first->x), ip->first->x);
  if (ip->mi) PetscCall(InequalityScale(tao, xsize));
  if (ip->me) PetscCall(EqualityScale(tao));
  for (PetscInt b = IP_LOWER; b <= IP_UPPER; b++) {
    if (!ip->pair[b].n) continue;
    PetscCall(VecNorm(ip->pair[b].z, NORM_INFINITY, &z));
    s->product = PetscMax(s->product, xsize * PetscMax(z, IP_VANISHING * ip->stiff->hscale * xsize));
  }
  if (!(s->dual > 0.0)) s->dual = 1.0;
  if (!(s->length > 0.0)) s->length = 1.0;
  if (!(s->equality > 0.0)) s->equality = 1.0;
  if (!(s->pressure > 0.0)) s->pressure = 1.0;
  if (!(s->product > 0.0)) s->product = 1.0;
  PetscFunctionReturn(0);
}
