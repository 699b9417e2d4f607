/*
   Regularizes the Hessian without using the inertia (Chiang and Zavala 2016). If the direction has too little
   curvature, or the Krylov method meets negative curvature, delta M_u with a growing delta is added to the Hessian.
*/
#include "iterationimpl.h"
#include "tao_ipfilter/solver/barrier.h"
#include "tao_ipfilter/solver/condensed.h"
#include "tao_ipfilter/solver/constants.h"
#include "tao_ipfilter/solver/factors.h"
#include "tao_ipfilter/solver/linear.h"
#include "tao_ipfilter/solver/options.h"
#include "tao_ipfilter/solver/record.h"
#include "tao_ipfilter/solver/stiffness.h"

/*
   Returns the next delta. The first delta of a step is that of the last regularized step, reduced. Later ones grow,
   with a larger factor as long as no delta has been successful in this solve.
*/
static PetscReal NextDelta(const TAO_IPFILTER *ip, PetscReal unit)
{
  if (ip->shift->delta == 0.0)
    return ip->shift->last > 0.0 ? PetscMax(IP_DELTA_SHRINK * ip->shift->last, PETSC_MACHINE_EPSILON * unit)
                                 : IP_DELTA_FIRST * unit;
  return (ip->shift->last > 0.0 ? IP_DELTA_GROW : IP_DELTA_GROW_FIRST) * ip->shift->delta;
}

/* Computes the unit of delta: a typical diagonal entry of H divided by a typical mass */
static PetscErrorCode DeltaUnit(Tao tao, PetscReal *unit)
{
  TAO_IPFILTER *ip   = (TAO_IPFILTER *)tao->data;
  PetscScalar   mass = 1.0;
  PetscInt      n    = 1;

  PetscFunctionBegin;
  *unit = 1.0;
  if (ip->opt->scaling == IP_SCALING_NONE) PetscFunctionReturn(0);
  if (ip->given->primal_mass) {
    PetscCall(VecSum(ip->given->primal_mass, &mass));
    PetscCall(VecGetSize(ip->given->primal_mass, &n));
  }
  *unit = ip->stiff->hscale / (PetscRealPart(mass) / n);
  PetscFunctionReturn(0);
}

/* Sets delta to its next value */
PetscErrorCode IPRegularizeMore(Tao tao)
{
  TAO_IPFILTER *ip   = (TAO_IPFILTER *)tao->data;
  PetscReal     unit = 1.0;

  PetscFunctionBegin;
  PetscCall(DeltaUnit(tao, &unit));
  ip->shift->delta = NextDelta(ip, unit);
  ip->rec->nretried++;
  PetscFunctionReturn(0);
}

/* Records that a step was taken with delta */
void IPRegularized(TAO_IPFILTER *ip)
{
  if (ip->shift->delta == 0.0) return;
  ip->shift->last        = ip->shift->delta;
  ip->rec->delta_largest = PetscMax(ip->rec->delta_largest, ip->shift->delta);
  ip->rec->nregularized++;
  ip->bar->curved = PETSC_TRUE;
}

/*
   Computes the smallest shift for which all diagonal entries of A are positive; negative if no shift is needed. With a
   smaller shift A is not positive definite, and no AMG can be set up. NaN in the matrix is recorded as a failure.
*/
static PetscErrorCode LeastDelta(Tao tao, PetscReal *least)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  Vec           diagonal;
  PetscReal     smallest, size;

  PetscFunctionBegin;
  PetscCall(IPGetWork(tao, IP_UNKNOWNS, &diagonal));
  PetscCall(MatGetDiagonal(ip->cond->A, diagonal));
  PetscCall(VecNorm(diagonal, NORM_2, &size));
  if (PetscIsInfOrNanReal(size)) PetscCall(IPResidualNotANumber(tao));
  if (ip->given->primal_mass) PetscCall(VecQuotient_AMGF(diagonal, diagonal, ip->given->primal_mass));
  PetscCall(VecMin(diagonal, NULL, &smallest));
  PetscCall(IPRestoreWork(tao, IP_UNKNOWNS, &diagonal));
  *least = ip->shift->delta - smallest;
  PetscFunctionReturn(0);
}

/*
   Calls assemble() and solve() with increasing delta until the solution is usable, and returns in *ok whether it is.
   first: initial delta in its unit. If a solver fails the loop ends, since a larger delta would not help.
*/
PetscErrorCode IPRegularize(Tao tao, PetscReal          first, PetscErrorCode (*assemble)(Tao),
  PetscErrorCode (*solve)(Tao, PetscBool *), PetscBool *ok)
{
  TAO_IPFILTER *ip   = (TAO_IPFILTER *)tao->data;
  PetscReal     unit = 1.0, least = PETSC_NINFINITY;

  PetscFunctionBegin;
  PetscCall(DeltaUnit(tao, &unit));
  *ok              = PETSC_FALSE;
  ip->shift->delta = first * unit;
  ip->lin->failed  = PETSC_FALSE;
  while (ip->shift->delta <= ip->opt->delta_max * unit) {
    PetscCall((*assemble)(tao));
    if (least == PETSC_NINFINITY && (!ip->me || ip->prox->condensed)) PetscCall(LeastDelta(tao, &least));
    if (ip->lin->failed) break;
    if (ip->shift->delta > least) {
      PetscCall((*solve)(tao, ok));
      if (*ok || ip->lin->failed) break;
      ip->rec->nretried++;
    }
    do ip->shift->delta = NextDelta(ip, unit);
    while (ip->shift->delta <= least);
  }
  PetscFunctionReturn(0);
}
