/* Magnitudes that residuals are measured by. */
#include "tao_ipfilter/ipfilterimpl.h"

#define IP_VANISHING 1e-3  /* fraction of first values that stands in for scales which vanish */
#define IP_AMPLE     30.0  /* a gradient is small that moves the unknowns by no more than so many times the tolerance */
#define IP_SOFT      1e-8  /* of the largest curvature: less counts as none */
#define IP_RUNAWAY   100.0 /* an iterate counts for no more than so many times its first size */

/* size, but no more than a limit taken from the start, if there is one: an iterate that runs away must not make its
   residuals look small */
static PetscReal Within(PetscReal size, PetscReal limit)
{
  return limit > 0.0 ? PetscMin(size, limit) : size;
}

/* Values of c_I beyond this are out of reach: no unknown that moves as far as can be expected makes them zero, and no
   size hangs on them. PETSC_INFINITY where nothing is known of that. */
PetscReal IPReach(const TAO_IPFILTER *ip, PetscReal xsize)
{
  const PetscReal far = 1e4, reach = PetscMax(ip->first.reach, xsize) * ip->first.jacobian;

  return reach > 0.0 ? far * reach : PETSC_INFINITY;
}

/* Largest entry of a vector in the layout of c_I that is within reach */
PetscErrorCode IPSizeWithinReach(Tao tao, Vec v, PetscReal reach, PetscReal *size)
{
  const PetscScalar *a;
  PetscReal          largest = 0.0;
  PetscInt           n;

  PetscFunctionBegin;
  PetscCall(VecNorm(v, NORM_INFINITY, size));
  if (!(*size > reach)) PetscFunctionReturn(0);
  PetscCall(VecGetLocalSize(v, &n));
  PetscCall(VecGetArrayRead(v, &a));
  for (PetscInt i = 0; i < n; i++)
    if (PetscAbsScalar(a[i]) <= reach) largest = PetscMax(largest, PetscAbsScalar(a[i]));
  PetscCall(VecRestoreArrayRead(v, &a));
  PetscCallMPI(MPI_Allreduce(&largest, size, 1, MPIU_REAL, MPIU_MAX, PetscObjectComm((PetscObject)tao)));
  PetscFunctionReturn(0);
}

/* The entries of v that are within reach; zeros in the place of the others */
PetscErrorCode IPValuesWithinReach(Tao tao, Vec v, Vec near)
{
  PetscReal    xsize, reach;
  PetscScalar *a;
  PetscInt     n;

  PetscFunctionBegin;
  PetscCall(VecNorm(tao->solution, NORM_INFINITY, &xsize));
  reach = IPReach((TAO_IPFILTER *)tao->data, xsize);
  PetscCall(VecCopy(v, near));
  PetscCall(VecGetLocalSize(near, &n));
  PetscCall(VecGetArray(near, &a));
  for (PetscInt i = 0; i < n; i++)
    if (PetscAbsScalar(a[i]) > reach) a[i] = 0.0;
  PetscCall(VecRestoreArray(near, &a));
  PetscFunctionReturn(0);
}

/* How far the unknowns may be expected to move: their size, their Newton steps, each by itself, and the way to
   constraints that are not met; where all of these are zero, the way to the nearest one. With it, what c_I measures
   at the start. */
PetscErrorCode IPMeasureReach(Tao tao)
{
  TAO_IPFILTER      *ip    = (TAO_IPFILTER *)tao->data;
  IPFirst           *first = &ip->first;
  const PetscScalar *g, *h, *c;
  PetscReal          way[2] = {0.0, PETSC_NINFINITY}, hmax; /* the largest, and - the least positive c_I */
  PetscInt           n;

  PetscFunctionBegin;
  first->reach = 0.0;
  if (!ip->mi || !(first->jacobian > 0.0)) PetscFunctionReturn(0);
  PetscCall(VecMax(ip->stiff.hdiag, NULL, &hmax));
  PetscCall(VecGetLocalSize(tao->gradient, &n));
  PetscCall(VecGetArrayRead(tao->gradient, &g));
  PetscCall(VecGetArrayRead(ip->stiff.hdiag, &h));
  for (PetscInt j = 0; j < n; j++)
    if (PetscRealPart(h[j]) > IP_SOFT * hmax) way[0] = PetscMax(way[0], PetscAbsScalar(g[j]) / PetscRealPart(h[j]));
  PetscCall(VecRestoreArrayRead(ip->stiff.hdiag, &h));
  PetscCall(VecRestoreArrayRead(tao->gradient, &g));
  PetscCall(VecGetLocalSize(ip->at.c, &n));
  PetscCall(VecGetArrayRead(ip->at.c, &c));
  for (PetscInt i = 0; i < n; i++) {
    const PetscReal ci = PetscRealPart(c[i]);

    way[0] = PetscMax(way[0], -ci / first->jacobian);
    if (ci > 0.0) way[1] = PetscMax(way[1], -ci / first->jacobian);
  }
  PetscCall(VecRestoreArrayRead(ip->at.c, &c));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, way, 2, MPIU_REAL, MPIU_MAX, PetscObjectComm((PetscObject)tao)));
  if (first->equality_jacobian > 0.0) way[0] = PetscMax(way[0], first->equality / first->equality_jacobian);
  first->reach = PetscMax(first->x, way[0]);
  if (first->reach == 0.0 && way[1] > PETSC_NINFINITY) first->reach = -way[1];
  if (!(first->length > IPReach(ip, first->x))) PetscFunctionReturn(0);
  PetscCall(IPSizeWithinReach(tao, ip->at.c, IPReach(ip, first->x), &first->length));
  if (first->length == 0.0) first->length = first->jacobian * first->reach;
  PetscFunctionReturn(0);
}

/* Lengths and pressures of the inequality constraints. Where every constraint is active from the start, values and
   slacks say nothing: displacements do. Pressures would not: those of infeasible constraints grow without limit.
   Where none is active, a small fraction of the pressure that would balance the objective's gradient is one that
   matters. */
static PetscErrorCode InequalityScale(Tao tao, PetscReal xsize)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  IPScale      *s  = &ip->scale;
  PetscReal     c, t, gradient, upper = 0.0, transmitted = ip->first.jacobian * ip->pair[IP_SLACK].weight / ip->mi;

  PetscFunctionBegin;
  PetscCall(IPSizeWithinReach(tao, ip->at.c, IPReach(ip, xsize), &c));
  PetscCall(IPSizeWithinReach(tao, ip->pair[IP_SLACK].t, IPReach(ip, xsize), &t));
  PetscCall(VecNorm(ip->pair[IP_SLACK].z, NORM_INFINITY, &s->pressure));
  if (ip->pair[IP_CEILING].n) PetscCall(VecNorm(ip->pair[IP_CEILING].z, NORM_INFINITY, &upper));
  s->pressure = PetscMax(s->pressure, upper);
  s->length   = PetscMax(Within(PetscMax(c, t), IP_RUNAWAY * ip->first.length),
      10.0 * IP_VANISHING * PetscMax(ip->first.length, ip->first.jacobian * xsize));
  s->pressure = PetscMax(s->pressure, IP_VANISHING * ip->stiff.mean * s->length);
  PetscCall(VecNorm(tao->gradient, NORM_INFINITY, &gradient));
  if (transmitted > 0.0) s->balance = gradient / transmitted;
  s->pressure = PetscMax(s->pressure, IP_VANISHING * s->balance);
  s->product  = s->length * s->pressure;
  PetscFunctionReturn(0);
}

/* Values of the equality constraints: the first, or the terms of their linear parts */
static PetscErrorCode EqualityScale(Tao tao)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  PetscReal     norm;
  Vec           sums;

  PetscFunctionBegin;
  PetscCall(IPGetWork(tao, IP_EQUALITIES, &sums));
  PetscCall(IPOwnTerms(tao, ip->jac.equality, sums, NULL));
  PetscCall(VecNorm(sums, NORM_INFINITY, &norm));
  ip->scale.equality_terms = norm;
  PetscCall(IPRestoreWork(tao, IP_EQUALITIES, &sums));
  ip->scale.equality = PetscMax(ip->first.equality,
    Within(norm, IP_RUNAWAY * PetscMax(ip->first.equality, ip->first.equality_jacobian * ip->first.x)));
  PetscFunctionReturn(0);
}

/* Forces: those that cancel in the gradient; where none do, what the gradient was at the start, but no more than its
   terms are now, lest a start far off make every gradient look small. Below ten roundings of its terms no gradient is
   of any meaning. */
static PetscErrorCode DualScale(Tao tao)
{
  TAO_IPFILTER   *ip       = (TAO_IPFILTER *)tao->data;
  const PetscBool limited  = (PetscBool)(ip->mi || ip->me || ip->pair[IP_LOWER].n || ip->pair[IP_UPPER].n);
  const PetscReal rounding = 10.0 * PETSC_MACHINE_EPSILON;
  PetscReal       norm, terms, stiffness;
  const PetscReal least = PetscSqr(
    PETSC_MACHINE_EPSILON); /* of the first gradient: smaller ones are no gain, be it that the unknowns run off */
  const PetscReal first = (limited ? IP_VANISHING : 1.0) * ip->first.gradient;

  PetscFunctionBegin;
  PetscCall(VecNorm(tao->gradient, NORM_2, &norm));
  PetscCall(IPStiffnessTerms(tao, &terms));
  PetscCall(VecNorm(ip->stiff.hdiag, NORM_2, &stiffness));
  ip->scale.dual = Within(first, IP_AMPLE * PetscMax(terms, IP_VANISHING * ip->first.x * stiffness));
  if (limited) ip->scale.dual = PetscMax(ip->scale.dual, norm);
  ip->scale.dual = PetscMax(ip->scale.dual, PetscMax(rounding * terms, least * ip->first.gradient) / ip->tol);
  PetscFunctionReturn(0);
}

/* An absolute limit as it was given, or what the scaling has */
PetscReal IPAbsoluteTolerance(const TAO_IPFILTER *ip, PetscReal given, PetscReal by_gradients)
{
  if (given >= 0.0) return given;
  return ip->opt.scaling == IP_SCALING_GRADIENT ? by_gradients : PETSC_INFINITY;
}

/* Scales of the residuals. They follow the problem's units, so that a change of units changes no decision:
   forces against the forces that cancel, constraints against their largest value, products t z against length times
   pressure. Where these vanish, small fractions of first values, and of the stiffness's pressure, take their place. */
PetscErrorCode IPComputeScale(Tao tao)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  PetscReal     xsize, z;
  IPScale      *s = &ip->scale;

  PetscFunctionBegin;
  *s         = (IPScale){.dual = ip->first.unit, .length = 1.0, .equality = 1.0, .pressure = ip->first.unit};
  s->product = ip->first.unit;
  s->energy  = PETSC_INFINITY;
  if (ip->opt.scaling != IP_SCALING_PROBLEM || ip->opt.measure == IP_KKT_MASS) PetscFunctionReturn(0);
  *s = (IPScale){.dual = 0.0};
  PetscCall(DualScale(tao));
  PetscCall(VecNorm(tao->solution, NORM_INFINITY, &xsize));
  xsize = PetscMax(Within(xsize, IP_RUNAWAY * ip->first.x), ip->first.x);
  if (ip->mi) PetscCall(InequalityScale(tao, xsize));
  if (ip->me) PetscCall(EqualityScale(tao));
  for (PetscInt b = IP_LOWER; b <= IP_UPPER; b++) {
    if (!ip->pair[b].n) continue;
    PetscCall(VecNorm(ip->pair[b].z, NORM_INFINITY, &z));
    s->product = PetscMax(s->product, xsize * PetscMax(z, IP_VANISHING * ip->stiff.hscale * xsize));
  }
  if (!(s->dual > 0.0)) s->dual = 1.0;
  if (!(s->length > 0.0)) s->length = 1.0;
  if (!(s->equality > 0.0)) s->equality = 1.0;
  if (!(s->pressure > 0.0)) s->pressure = 1.0;
  if (!(s->product > 0.0)) s->product = 1.0;
  PetscFunctionReturn(0);
}
