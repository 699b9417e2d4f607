/* Leaves points at which the gradient vanishes, but which are no minimizers, along a direction of negative curvature */
#include "iterationimpl.h"
#include "tao_ipfilter/solver/barrier.h"
#include "tao_ipfilter/solver/constants.h"
#include "tao_ipfilter/solver/matrices.h"
#include "tao_ipfilter/solver/relaxation.h"
#include "tao_ipfilter/solver/search.h"
#include "tao_ipfilter/solver/sizes.h"

/*
   Continues the iteration from the trial point x + alpha dir.x, which is not near the central path. The multipliers are
   therefore moved to it, with mu at least a small fraction of the first mu.
*/
static PetscErrorCode LeaveStartAgain(Tao tao, PetscReal alpha)
{
  TAO_IPFILTER   *ip    = (TAO_IPFILTER *)tao->data;
  const PetscReal trace = 1e-3;

  PetscFunctionBegin;
  PetscCall(IPSearchTakeStep(tao, alpha, 0.0));
  ip->mu = PetscMax(ip->mu, trace * ip->bar->first);
  for (PetscInt b = 0; b < IP_NPAIRS; b++) PetscCall(IPPairCenter(&ip->pair[b], ip->mu));
  if (ip->mi) PetscCall(IPSlackPressure(tao, ip->at.lambda));
  PetscCall(IPFilterSetReset(ip->filter));
  PetscCall(IPEvaluateDerivatives(tao));
  PetscCall(IPComputeKKT(tao));
  PetscFunctionReturn(0);
}

/*
   Computes the directions of slacks and of distances to bounds that follow from dir.x. The multipliers of the
   constraints do not change.
*/
static PetscErrorCode LeaveFollow(Tao tao)
{
  TAO_IPFILTER *ip    = (TAO_IPFILTER *)tao->data;
  IPPair       *slack = &ip->pair[IP_SLACK];

  PetscFunctionBegin;
  PetscCall(IPBoundsDirection(tao));
  if (ip->me) PetscCall(VecSet(ip->dir.y, 0.0));
  if (!ip->mi) PetscFunctionReturn(0);
  PetscCall(MatMult(ip->jac->inequality, ip->dir.x, slack->dt));
  if (ip->pair[IP_CEILING].n) PetscCall(VecAXPBY(ip->pair[IP_CEILING].dt, -1.0, 0.0, slack->dt));
  PetscCall(VecSet(ip->dir.lambda, 0.0));
  PetscFunctionReturn(0);
}

/* Raises the trial point's slacks to the values of their constraints, which curve away from their linearization */
static PetscErrorCode LeaveRaiseSlacks(Tao tao, PetscReal *theta, PetscReal *phi)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  if (!ip->mi) PetscFunctionReturn(0);
  PetscCall(VecPointwiseMax(ip->trial.s, ip->trial.s, ip->trial.c));
  PetscCall(IPSlackKeepInside(tao, ip->trial.s, 1.0 - IP_TAU_MIN));
  PetscCall(IPSlackDistance(tao, ip->trial.s, PETSC_TRUE));
  PetscCall(IPMeritMeasureTrial(tao, theta, phi));
  PetscFunctionReturn(0);
}

#define IP_LEAVE_MET 1e-2 /* largest violation, in units of theta_ref, of a point that leaves the path */

/*
   Computes the Lagrangian at the iterate `at` with the present multipliers, and adds its rounding error to *rounding.
   trial: whether distances to bounds are those of the trial point
*/
static PetscErrorCode LeaveLagrangian(Tao tao, const IPIterate *at, PetscBool trial, PetscReal *lagrangian,
  PetscReal *rounding)
{
  TAO_IPFILTER *ip    = (TAO_IPFILTER *)tao->data;
  PetscReal     terms = PetscAbsReal(at->f), norms[2];
  PetscScalar   product;
  Vec           force;

  PetscFunctionBegin;
  *lagrangian = at->f;
  if (ip->mi) {
    PetscCall(IPGetWork(tao, IP_INEQUALITIES, &force));
    PetscCall(VecPointwiseMult(force, ip->at.lambda, ip->pair[IP_SLACK].w));
    PetscCall(VecDot(force, at->c, &product));
    PetscCall(VecNorm(force, NORM_2, &norms[0]));
    PetscCall(VecNorm(at->c, NORM_2, &norms[1]));
    PetscCall(IPRestoreWork(tao, IP_INEQUALITIES, &force));
    *lagrangian -= PetscRealPart(product);
    terms += norms[0] * norms[1];
  }
  if (ip->me) {
    PetscCall(VecDot(ip->at.y, at->ce, &product));
    PetscCall(VecNorm(ip->at.y, NORM_2, &norms[0]));
    PetscCall(VecNorm(at->ce, NORM_2, &norms[1]));
    *lagrangian += PetscRealPart(product);
    terms += norms[0] * norms[1];
  }
  for (PetscInt b = IP_LOWER; b <= IP_UPPER; b++) {
    const IPPair *p = &ip->pair[b];

    if (!p->n) continue;
    PetscCall(IPGetWork(tao, IP_UNKNOWNS, &force));
    PetscCall(VecPointwiseMult(force, p->z, p->w));
    PetscCall(VecDot(force, trial ? p->trial : p->t, &product));
    PetscCall(IPRestoreWork(tao, IP_UNKNOWNS, &force));
    *lagrangian -= PetscRealPart(product);
    terms += PetscAbsScalar(product);
  }
  *rounding += 10.0 * PETSC_MACHINE_EPSILON * terms;
  PetscFunctionReturn(0);
}

/*
   Leaves a stationary point along dir.x, a direction of negative curvature. The longest step is taken for which the
   barrier function falls and the constraints remain satisfied. With equality constraints, from which the step departs,
   the Lagrangian must fall instead. *left: false if there is none.
*/
PetscErrorCode IPLeaveStationary(Tao tao, PetscBool *left)
{
  TAO_IPFILTER   *ip   = (TAO_IPFILTER *)tao->data;
  const PetscReal part = 0.1, least = 1e-6;
  PetscReal       alpha = 1.0, norm, size, slope, here, rounding = 0.0;

  PetscFunctionBegin;
  *left = PETSC_FALSE;
  PetscCall(VecNorm(ip->dir.x, NORM_INFINITY, &norm));
  PetscCall(VecNorm(tao->solution, NORM_INFINITY, &size));
  size = PetscMax(size, ip->first->x);
  PetscCall(VecScale(ip->dir.x, (size > 0.0 ? part * size : 1.0) / norm));
  PetscCall(LeaveFollow(tao));
  PetscCall(IPMeritMeasure(tao));
  PetscCall(IPMeritSlope(tao, &slope));
  if (slope > 0.0) {
    PetscCall(VecScale(ip->dir.x, -1.0));
    PetscCall(LeaveFollow(tao));
  }
  here = ip->search->phi - ip->search->rounding;
  if (ip->me) PetscCall(LeaveLagrangian(tao, &ip->at, PETSC_FALSE, &here, &rounding));
  PetscCall(IPFractionToBoundary(tao, IP_SLACK, IP_TAU_MIN, &alpha, NULL));
  for (; alpha > least && !*left; alpha *= 0.5) {
    PetscReal theta = 0.0, phi = 0.0;
    PetscBool finite = PETSC_FALSE;

    PetscCall(IPSearchTrial(tao, alpha, &theta, &phi, &finite));
    if (finite) PetscCall(LeaveRaiseSlacks(tao, &theta, &phi));
    if (finite && ip->me) PetscCall(LeaveLagrangian(tao, &ip->trial, PETSC_TRUE, &phi, &rounding));
    *left = (PetscBool)(finite && phi < here - rounding && theta <= IP_LEAVE_MET * ip->search->theta_ref);
    if (*left) PetscCall(LeaveStartAgain(tao, alpha));
  }
  PetscFunctionReturn(0);
}
