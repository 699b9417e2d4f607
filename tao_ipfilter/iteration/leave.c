/*
   Leaves points at which the gradient vanishes, but which are no minimizers: along a direction of negative curvature,
   or through a point of inflection of the barrier function or of the Lagrangian
*/
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

/*
   Computes the longest step along dir.x, whose largest entry is `norm`: a fraction of the size of the unknowns, within
   the bounds
*/
static PetscErrorCode LeaveLongestStep(Tao tao, PetscReal norm, PetscReal *longest)
{
  TAO_IPFILTER   *ip   = (TAO_IPFILTER *)tao->data;
  const PetscReal part = 0.1;
  PetscReal       size;

  PetscFunctionBegin;
  PetscCall(VecNorm(tao->solution, NORM_INFINITY, &size));
  *longest = part * PetscMax(size, ip->first->x) / norm;
  PetscCall(IPFractionToBoundary(tao, IP_SLACK, IP_TAU_MIN, longest, NULL));
  PetscFunctionReturn(0);
}

/*
   Computes the trial point at the step length alpha, and there the Lagrangian or the barrier function. Adds the
   rounding error of the Lagrangian to *rounding. *feasible: whether the point has finite values and satisfies the
   constraints
*/
static PetscErrorCode LeaveTrial(Tao tao, PetscReal alpha, PetscBool lagrangian, PetscReal *value, PetscReal *rounding,
  PetscBool *feasible)
{
  TAO_IPFILTER *ip    = (TAO_IPFILTER *)tao->data;
  PetscReal     theta = 0.0;

  PetscFunctionBegin;
  PetscCall(IPSearchTrial(tao, alpha, &theta, value, feasible));
  if (*feasible && lagrangian) {
    PetscCall(LeaveRaiseSlacks(tao, &theta, value));
    PetscCall(LeaveLagrangian(tao, &ip->trial, PETSC_TRUE, value, rounding));
  }
  if (theta > IP_LEAVE_MET * ip->search->theta_ref) *feasible = PETSC_FALSE;
  PetscFunctionReturn(0);
}

/*
   Tests longer and longer steps along dir.x, up to the length `longest`, as long as the Lagrangian or the barrier
   function does not rise. The solve continues from the last one if the decrease is clear: much larger than the rounding
   error and than slope times the step length. The Lagrangian must not rise up to `longest`. With constraints the first
   step of a clear decrease of the barrier function is taken, since longer ones violate them.
   *left: whether the solve continues.
*/
static PetscErrorCode LeaveGrowingSteps(Tao tao, PetscBool lagrangian, PetscReal longest, PetscReal slope,
  PetscBool *left)
{
  TAO_IPFILTER   *ip     = (TAO_IPFILTER *)tao->data;
  const PetscReal growth = 10.0, clear = 1e3;
  const PetscBool earliest = (PetscBool)(!lagrangian && (ip->mi || ip->me));
  PetscReal       here = ip->search->phi, rounding = lagrangian ? 0.0 : ip->search->rounding, lowest, last = 0.0, value;
  PetscBool       falls = PETSC_TRUE;

  PetscFunctionBegin;
  if (lagrangian) PetscCall(LeaveLagrangian(tao, &ip->at, PETSC_FALSE, &here, &rounding));
  lowest = here;
  for (PetscReal alpha = PetscMin(2.0, longest); falls && last < longest && !(*left && earliest);
       alpha           = PetscMin(growth * alpha, longest)) {
    PetscCall(LeaveTrial(tao, alpha, lagrangian, &value, &rounding, &falls));
    if (falls && value > lowest + rounding) falls = PETSC_FALSE;
    if (!falls) break;
    last   = alpha;
    lowest = PetscMin(lowest, value);
    *left  = (PetscBool)(here - lowest > clear * PetscMax(rounding, last * slope));
  }
  if (lagrangian && !falls) *left = PETSC_FALSE;
  if (!*left) PetscFunctionReturn(0);
  if (!falls) PetscCall(LeaveTrial(tao, last, lagrangian, &value, &rounding, &falls));
  PetscCall(LeaveStartAgain(tao, last));
  PetscFunctionReturn(0);
}

/*
   Tries to leave a point of inflection of the Lagrangian along the last direction in which the iteration converged only
   linearly. If constraints are curved, the barrier function need not decrease along this direction.
*/
static PetscErrorCode LeaveLagrangianInflection(Tao tao, PetscBool *left)
{
  TAO_IPFILTER *ip    = (TAO_IPFILTER *)tao->data;
  IPPair       *slack = &ip->pair[IP_SLACK], *ceiling = &ip->pair[IP_CEILING];
  PetscReal     longest, norm;
  PetscScalar   slope;

  PetscFunctionBegin;
  PetscCall(VecCopy(ip->search->slow, ip->dir.x));
  PetscCall(VecDot(ip->rx, ip->dir.x, &slope));
  PetscCall(VecNorm(ip->dir.x, NORM_INFINITY, &norm));
  PetscCall(LeaveFollow(tao));
  if (ip->mi) PetscCall(VecSet(slack->dt, 0.0));
  if (ceiling->n) PetscCall(VecSet(ceiling->dt, 0.0));
  PetscCall(IPMeritMeasure(tao));
  PetscCall(LeaveLongestStep(tao, norm, &longest));
  PetscCall(LeaveGrowingSteps(tao, PETSC_TRUE, longest, PetscAbsScalar(slope), left));
  PetscFunctionReturn(0);
}

/*
   Tries to leave a point of inflection of the barrier function along the last direction. At such a point Newton's
   method converges only linearly, or with a shift that shortens its steps.
*/
static PetscErrorCode LeaveBarrierInflection(Tao tao, PetscBool *left)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  PetscReal     longest;

  PetscFunctionBegin;
  if (!(ip->dir.norm > 0.0) || !(IPSearchIsLinear(ip) || ip->shift->delta > 0.0)) PetscFunctionReturn(0);
  PetscCall(LeaveFollow(tao));
  PetscCall(IPMeritMeasure(tao));
  PetscCall(LeaveLongestStep(tao, ip->dir.norm, &longest));
  if (longest >= 1.0) PetscCall(LeaveGrowingSteps(tao, PETSC_FALSE, longest, 0.0, left));
  PetscFunctionReturn(0);
}

/* Tries to leave a point of inflection of the barrier function or of the Lagrangian. *left: whether it succeeds */
PetscErrorCode IPLeaveInflection(Tao tao, PetscBool *left)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  *left = PETSC_FALSE;
  PetscCall(LeaveBarrierInflection(tao, left));
  if (!*left && (ip->mi || ip->me) && ip->search->slows) PetscCall(LeaveLagrangianInflection(tao, left));
  PetscFunctionReturn(0);
}
