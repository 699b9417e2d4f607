/* Computes a Newton step of the problem without its bounds, to predict a start between the bounds */
#include "stepimpl.h"
#include "tao_ipfilter/solver/barrier.h"
#include "tao_ipfilter/solver/condensed.h"
#include "tao_ipfilter/solver/options.h"
#include "tao_ipfilter/solver/sizes.h"
#include "tao_ipfilter/solver/stiffness.h"

/*
   Solves for the step to a relative residual of 0.1. *usable: false if the Hessian is not convex along the step, or
   some of its diagonal entries are not positive, so that no AMG can be set up.
*/
static PetscErrorCode FreeSolve(Tao tao, PetscBool *usable)
{
  TAO_IPFILTER   *ip     = (TAO_IPFILTER *)tao->data;
  const PetscReal coarse = 0.1, singular = 1e-8; /* shift, relative to a diagonal entry, for a Hessian that may be
                                                    singular without the bounds */
  PetscScalar     descent;
  PetscReal       norm, least;
  Vec             rhs;

  PetscFunctionBegin;
  PetscCall(IPGetWork(tao, IP_UNKNOWNS, &rhs));
  ip->shift->delta = ip->given->primal_mass ? 0.0 : singular * ip->stiff->hscale;
  PetscCall(IPCondenseMatrix(tao, NULL));
  ip->shift->delta = 0.0;
  PetscCall(MatGetDiagonal(ip->cond->A, rhs));
  PetscCall(VecMin(rhs, NULL, &least));
  if (!(least > 10.0 * singular * ip->stiff->hscale)) {
    PetscCall(IPRestoreWork(tao, IP_UNKNOWNS, &rhs));
    PetscFunctionReturn(0);
  }
  PetscCall(VecAXPBY(rhs, -1.0, 0.0, tao->gradient));
  PetscCall(VecNorm(rhs, NORM_2, &norm));
  PetscCall(VecSet(ip->dir.x, 0.0));
  PetscCall(IPLinearSolve(tao, rhs, ip->dir.x, coarse * norm, usable));
  PetscCall(VecDot(rhs, ip->dir.x, &descent));
  PetscCall(IPRestoreWork(tao, IP_UNKNOWNS, &rhs));
  *usable = (PetscBool)(*usable && PetscRealPart(descent) > 0.0);
  PetscFunctionReturn(0);
}

/*
   Computes the trial point after the step, moved to a distance `margin` inside the bounds, or to a quarter of the
   distance between two bounds if that is less
*/
static PetscErrorCode FreeTrial(Tao tao, PetscReal margin)
{
  TAO_IPFILTER      *ip   = (TAO_IPFILTER *)tao->data;
  const PetscReal    part = 0.25;
  Vec                v[2] = {tao->XL, tao->XU};
  const PetscScalar *b[2] = {NULL, NULL};
  PetscScalar       *x;
  PetscInt           n;

  PetscFunctionBegin;
  PetscCall(VecWAXPY(ip->trial.x, 1.0, ip->dir.x, tao->solution));
  PetscCall(VecGetLocalSize(ip->trial.x, &n));
  for (PetscInt k = 0; k < 2; k++)
    if (v[k]) PetscCall(VecGetArrayRead(v[k], &b[k]));
  PetscCall(VecGetArray(ip->trial.x, &x));
  for (PetscInt i = 0; i < n; i++) {
    const PetscReal l = b[0] ? PetscRealPart(b[0][i]) : PETSC_NINFINITY,
                    u = b[1] ? PetscRealPart(b[1][i]) : PETSC_INFINITY;
    const PetscReal m = PetscMin(margin, part * (u - l));

    if (l > PETSC_NINFINITY) x[i] = PetscMax(PetscRealPart(x[i]), l + m);
    if (u < PETSC_INFINITY) x[i] = PetscMin(PetscRealPart(x[i]), u - m);
  }
  PetscCall(VecRestoreArray(ip->trial.x, &x));
  for (PetscInt k = 0; k < 2; k++)
    if (v[k]) PetscCall(VecRestoreArrayRead(v[k], &b[k]));
  PetscFunctionReturn(0);
}

/*
   Stores the sizes of objective, gradient and unknowns after the step in ip->first, in place of those at the given
   starting point, which may be too large by orders of magnitude.
*/
static PetscErrorCode FreeMeasure(Tao tao)
{
  IPFirst *first = ((TAO_IPFILTER *)tao->data)->first;

  PetscFunctionBegin;
  first->f = ((TAO_IPFILTER *)tao->data)->at.f;
  PetscCall(VecNorm(tao->gradient, NORM_2, &first->gradient));
  PetscCall(VecNorm(tao->solution, NORM_INFINITY, &first->x));
  PetscFunctionReturn(0);
}

/*
   Moves x along the step if that reduces the objective. *energy: mean step times mean gradient at the new point, per
   unknown.
*/
PetscErrorCode IPFreeStep(Tao tao, PetscBool *moved, PetscReal *energy)
{
  TAO_IPFILTER   *ip     = (TAO_IPFILTER *)tao->data;
  const PetscReal margin = 0.1; /* relative to the mean step */
  PetscReal       step, gradient;
  PetscBool       usable = PETSC_FALSE;
  PetscInt        n;

  PetscFunctionBegin;
  *moved = PETSC_FALSE;
  PetscCall(FreeSolve(tao, &usable));
  if (!usable) PetscFunctionReturn(0);
  PetscCall(VecGetSize(ip->dir.x, &n));
  PetscCall(VecNorm(ip->dir.x, NORM_1, &step));
  step /= n;
  PetscCall(FreeTrial(tao, margin * step));
  PetscCall(TaoComputeObjective(tao, ip->trial.x, &ip->trial.f));
  *moved = (PetscBool)(!IPUndefined(ip->trial.f) && ip->trial.f < ip->at.f);
  PetscCall(PetscInfo(tao, "Step without bounds: mean size %g, objective from %g to %g\n", (double)step,
    (double)ip->at.f, (double)ip->trial.f));
  if (!*moved) PetscFunctionReturn(0);
  PetscCall(IPIterateCopyPoint(&ip->trial, &ip->at));
  PetscCall(IPBoundsDistance(tao, tao->solution, PETSC_FALSE));
  PetscCall(IPEvaluateDerivatives(tao));
  PetscCall(FreeMeasure(tao));
  PetscCall(VecNorm(tao->gradient, NORM_1, &gradient));
  *energy = step * gradient / n;
  PetscFunctionReturn(0);
}
