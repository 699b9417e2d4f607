/*
   Detects solutions without bounded multipliers, at which the KKT error is meaningless because it is measured with the
   multipliers
*/
#include "driverimpl.h"
#include "tao_ipfilter/solver/kkt.h"
#include "tao_ipfilter/solver/options.h"
#include "tao_ipfilter/solver/sizes.h"
#include "tao_ipfilter/solver/stiffness.h"

/*
   Computes the largest force of the present multipliers of equality constraints if each constraint's gradient were as
   large as at the start
*/
static PetscErrorCode DegenerateForceAtStart(Tao tao, PetscReal *force)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  Vec           v;

  PetscFunctionBegin;
  PetscCall(IPGetWork(tao, IP_EQUALITIES, &v));
  PetscCall(VecPointwiseMult(v, ip->at.y, ip->stiff->equality_rows));
  PetscCall(VecNorm(v, NORM_INFINITY, force));
  PetscCall(IPRestoreWork(tao, IP_EQUALITIES, &v));
  PetscFunctionReturn(0);
}

/*
   Returns the larger one of the present and the first magnitude of the objective, with which possible decreases are
   compared
*/
PetscReal IPDegenerateObjective(const TAO_IPFILTER *ip)
{
  return PetscMax(PetscMax(PetscAbsReal(ip->at.f), PetscAbsReal(ip->first->f)), ip->first->gradient * ip->first->x);
}

/*
   Finds whether the last step changed the objective by a negligible fraction of its magnitude. If there are no bounded
   multipliers, only this shows that the iteration has reached the solution.
*/
static PetscErrorCode DegenerateStagnates(Tao tao, PetscBool *stands)
{
  TAO_IPFILTER   *ip    = (TAO_IPFILTER *)tao->data;
  const PetscReal trace = 1e-6;
  PetscScalar     slope;

  PetscFunctionBegin;
  PetscCall(VecDot(tao->gradient, ip->dir.x, &slope));
  *stands = (PetscBool)(tao->niter && PetscAbsScalar(slope) <= trace * IPDegenerateObjective(ip));
  PetscFunctionReturn(0);
}

/*
   Finds whether the Fritz John conditions hold without the objective: the gradients of satisfied equality constraints
   vanish, so that their multipliers grow without limit, and the stationarity residual is small relative to the
   multipliers' forces. Bounds and inequality constraints without an interior have the same effect, and are relaxed
   first.
*/
PetscErrorCode IPDegenerateFritzJohn(Tao tao, PetscBool *holds)
{
  TAO_IPFILTER   *ip   = (TAO_IPFILTER *)tao->data;
  const IPKKT    *k    = ip->kkt;
  const PetscReal huge = 1e6; /* relative to the gradient */
  PetscReal       force, gradient;

  PetscFunctionBegin;
  *holds = PETSC_FALSE;
  if (!ip->me || IPRelaxApplies(ip) || ip->opt->scaling == IP_SCALING_NONE || k->primal > ip->tol ||
      k->violation > ip->tol || k->complementarity > ip->tol)
    PetscFunctionReturn(0);
  PetscCall(DegenerateForceAtStart(tao, &force));
  PetscCall(VecNorm(tao->gradient, NORM_INFINITY, &gradient));
  *holds = (PetscBool)(force > huge * PetscMax(gradient, ip->first->gradient) && k->dual_norm <= ip->tol * force);
  if (*holds) PetscCall(DegenerateStagnates(tao, holds));
  PetscFunctionReturn(0);
}
