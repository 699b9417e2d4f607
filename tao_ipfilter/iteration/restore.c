/*
   Feasibility restoration, used if the line search finds no step: Levenberg-Marquardt steps that reduce the violation
     psi(x) = 1/2 sum_i m_i v_i^2 + 1/2 w^2 |c_E|^2,  v_i = min(c_I,i, 0), or c_I,i - range beyond an upper side.
   Each step minimizes
     (Gauss-Newton model of psi) / zeta + 1/2 d^T (H + delta M_u) d - mu sum log(distances to bounds).
   With the Hessian as metric, the interior of an elastic body follows its surface. The matrix is the condensed one with
   D = m/zeta in the violated rows, or the augmented one with delta = zeta/w^2, so that the solvers of Newton's method
   can be used.
*/
#include "iterationimpl.h"
#include "tao_ipfilter/solver/barrier.h"
#include "tao_ipfilter/solver/constants.h"
#include "tao_ipfilter/solver/factors.h"
#include "tao_ipfilter/solver/kkt.h"
#include "tao_ipfilter/solver/matrices.h"
#include "tao_ipfilter/solver/record.h"
#include "tao_ipfilter/solver/relaxation.h"
#include "tao_ipfilter/solver/search.h"
#include "tao_ipfilter/solver/sizes.h"
#include "tao_ipfilter/solver/stiffness.h"

#define IP_RESTORE_MAX    200  /* largest number of restoration steps */
#define IP_RESTORE_METRIC 0.1  /* smallest delta of the metric, in its unit; needed for Hessians without curvature */
#define IP_RESTORE_SMALL  1e-3 /* psi may have a minimum if its relative gradient is below this value */
#define IP_RESTORE_LEAST  1e-6 /* psi has a minimum if its relative gradient is below it and psi does not fall */

/* Computes psi of an iterate */
static PetscErrorCode RestoreViolation(Tao tao, const IPIterate *it, PetscReal *psi)
{
  TAO_IPFILTER *ip     = (TAO_IPFILTER *)tao->data;
  PetscReal     square = 0.0, equality = 0.0;
  Vec           violation;

  PetscFunctionBegin;
  if (ip->mi) {
    PetscCall(IPGetWork(tao, IP_INEQUALITIES, &violation));
    PetscCall(IPSlackViolation(tao, it->c, violation));
    PetscCall(IPPairWeightedSquare(tao, violation, &square));
    PetscCall(IPRestoreWork(tao, IP_INEQUALITIES, &violation));
  }
  if (ip->me) PetscCall(VecNorm(it->ce, NORM_2, &equality));
  *psi = 0.5 * (square + PetscSqr(ip->search->equality_weight * equality));
  PetscFunctionReturn(0);
}

/* Computes J^T (weights v) with the violation v of the inequalities at the present point; zero without inequalities */
static PetscErrorCode RestoreForces(Tao tao, Vec weights, Vec forces)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  Vec           force;

  PetscFunctionBegin;
  PetscCall(VecSet(forces, 0.0));
  if (!ip->mi) PetscFunctionReturn(0);
  PetscCall(IPGetWork(tao, IP_INEQUALITIES, &force));
  PetscCall(IPSlackViolation(tao, ip->at.c, force));
  PetscCall(VecPointwiseMult(force, force, weights));
  PetscCall(MatMultTranspose(ip->jac->inequality, force, forces));
  PetscCall(IPRestoreWork(tao, IP_INEQUALITIES, &force));
  PetscFunctionReturn(0);
}

/* Computes the gradient of psi at the present point */
static PetscErrorCode RestoreGradient(Tao tao, Vec g)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  Vec           force;

  PetscFunctionBegin;
  PetscCall(RestoreForces(tao, ip->pair[IP_SLACK].w, g));
  if (ip->me) {
    PetscCall(IPGetWork(tao, IP_EQUALITIES, &force));
    PetscCall(VecAXPBY(force, PetscSqr(ip->search->equality_weight), 0.0, ip->at.ce));
    PetscCall(MatMultTransposeAdd(ip->jac->equality, force, g, g));
    PetscCall(IPRestoreWork(tao, IP_EQUALITIES, &force));
  }
  PetscFunctionReturn(0);
}

/* Assembles the matrix of a restoration step, with D = m/zeta in violated rows and 0 in the others */
static PetscErrorCode RestoreAssemble(Tao tao)
{
  TAO_IPFILTER      *ip = (TAO_IPFILTER *)tao->data;
  Vec                D  = ip->restore->D, violation;
  const PetscScalar *v;
  PetscScalar       *d;
  PetscInt           n;

  PetscFunctionBegin;
  if (ip->mi) {
    PetscCall(VecAXPBY(D, 1.0 / ip->restore->zeta, 0.0, ip->pair[IP_SLACK].w));
    PetscCall(IPGetWork(tao, IP_INEQUALITIES, &violation));
    PetscCall(IPSlackViolation(tao, ip->at.c, violation));
    PetscCall(VecGetLocalSize(violation, &n));
    PetscCall(VecGetArrayRead(violation, &v));
    PetscCall(VecGetArray(D, &d));
    for (PetscInt i = 0; i < n; i++)
      if (PetscRealPart(v[i]) == 0.0) d[i] = 0.0;
    PetscCall(VecRestoreArray(D, &d));
    PetscCall(VecRestoreArrayRead(violation, &v));
    PetscCall(IPRestoreWork(tao, IP_INEQUALITIES, &violation));
  }
  ip->aug->delta    = ip->me ? ip->restore->zeta / PetscSqr(ip->search->equality_weight) : 0.0;
  ip->aug->centered = PETSC_FALSE;
  PetscCall(IPCondenseMatrix(tao, D));
  PetscFunctionReturn(0);
}

/* Computes the right-hand side: the forces -J^T D v of the violation, and those of the bounds */
static PetscErrorCode RestoreRHS(Tao tao, Vec rhs)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  PetscCall(RestoreForces(tao, ip->restore->D, rhs));
  PetscCall(VecScale(rhs, -1.0));
  PetscCall(IPBoundsAddForces(tao, rhs));
  PetscFunctionReturn(0);
}

/* Solves for the step. *usable: whether the step reduces the violation or the barrier function of the bounds. */
static PetscErrorCode RestoreSolve(Tao tao, PetscBool *usable)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  PetscReal     norm;
  PetscScalar   descent;
  Vec           rhs;

  PetscFunctionBegin;
  PetscCall(IPGetWork(tao, IP_UNKNOWNS, &rhs));
  PetscCall(RestoreRHS(tao, rhs));
  PetscCall(VecSet(ip->dir.x, 0.0));
  if (ip->me) PetscCall(IPEqualityRestore(tao, rhs, ip->at.ce, ip->dir.x, usable));
  else {
    PetscCall(VecNorm(rhs, NORM_2, &norm));
    PetscCall(IPLinearSolve(tao, rhs, ip->dir.x, 1e-3 * norm, usable));
    PetscCall(VecDot(rhs, ip->dir.x, &descent));
    *usable = (PetscBool)(*usable && PetscRealPart(descent) > 0.0);
  }
  PetscCall(IPRestoreWork(tao, IP_UNKNOWNS, &rhs));
  PetscFunctionReturn(0);
}

/*
   Shortens the step inside the bounds until psi falls. *psi: its new value; *alpha: step length, 0 if psi does not
   fall. zeta is increased if the step had to be halved, by a larger factor for more than one halving. It is reduced
   after a step of almost full length whose decrease is near the predicted one, half of the slope.
*/
static PetscErrorCode RestoreSearch(Tao tao, PetscReal slope, PetscReal *psi, PetscReal *alpha)
{
  TAO_IPFILTER   *ip     = (TAO_IPFILTER *)tao->data;
  const PetscReal armijo = 1e-4, fair = 0.5, rounding = 10.0 * PETSC_MACHINE_EPSILON * *psi;
  const PetscInt  halvings = 12, max_halvings_of_a_fair_model = 1;

  PetscFunctionBegin;
  *alpha = 1.0;
  PetscCall(IPBoundsDirection(tao));
  PetscCall(IPFractionToBoundary(tao, IP_LOWER, IP_TAU_MIN, alpha, NULL));
  for (PetscInt k = 0; k < halvings; k++, *alpha *= 0.5) {
    PetscReal trial;

    PetscCall(VecWAXPY(ip->trial.x, *alpha, ip->dir.x, tao->solution));
    PetscCall(TaoComputeObjective(tao, ip->trial.x, &ip->trial.f));
    if (IPUndefined(ip->trial.f)) continue;
    PetscCall(IPEvaluateConstraints(tao, ip->trial.x, ip->trial.c, ip->trial.ce));
    PetscCall(RestoreViolation(tao, &ip->trial, &trial));
    if (IPUndefined(trial)) continue;
    ip->search->ndefined++;
    if (trial > *psi + armijo * *alpha * slope) continue;
    if (k > max_halvings_of_a_fair_model) ip->restore->zeta *= 10.0;
    else if (k == 1) ip->restore->zeta *= 3.0;
    else if (*alpha > 0.5 && *psi - trial >= fair * -0.5 * *alpha * slope - rounding) ip->restore->zeta *= 0.1;
    *psi = trial;
    PetscFunctionReturn(0);
  }
  *alpha = 0.0;
  PetscFunctionReturn(0);
}

/* Moves to the trial point and evaluates the derivatives there */
static PetscErrorCode RestoreTakeTrial(Tao tao)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  PetscCall(IPIterateCopyPoint(&ip->trial, &ip->at));
  PetscCall(IPBoundsDistance(tao, tao->solution, PETSC_FALSE));
  PetscCall(IPEvaluateDerivatives(tao));
  PetscFunctionReturn(0);
}

/*
   Chooses slacks for the present x: the constraint's value if that is well inside, and the slack of the central path
   otherwise. The latter is limited such that the violation remains well below theta0.
*/
static PetscErrorCode RestoreChooseSlacks(Tao tao, PetscReal theta0)
{
  TAO_IPFILTER      *ip    = (TAO_IPFILTER *)tao->data;
  const PetscReal    limit = 0.1 * theta0 / PetscSqrtReal(ip->pair[IP_SLACK].weight);
  const PetscScalar *c, *rho;
  PetscScalar       *s;
  PetscInt           n;
  Vec                z;

  PetscFunctionBegin;
  PetscCall(IPGetWork(tao, IP_INEQUALITIES, &z));
  PetscCall(IPSlackCentral(tao, ip->at.c, ip->mu, ip->trial.s, z));
  PetscCall(IPRestoreWork(tao, IP_INEQUALITIES, &z));
  PetscCall(VecGetLocalSize(ip->at.c, &n));
  PetscCall(VecGetArrayRead(ip->at.c, &c));
  PetscCall(VecGetArrayRead(ip->stiff->rho, &rho));
  PetscCall(VecGetArray(ip->trial.s, &s));
  for (PetscInt i = 0; i < n; i++) {
    const PetscReal central = PetscMin(limit, PetscSqrtReal(ip->mu / PetscRealPart(rho[i])));

    if (PetscRealPart(c[i]) >= 0.1 * central) s[i] = c[i];
    else s[i] = PetscMin(PetscRealPart(s[i]), central);
  }
  PetscCall(VecRestoreArray(ip->trial.s, &s));
  PetscCall(VecRestoreArrayRead(ip->stiff->rho, &rho));
  PetscCall(VecRestoreArrayRead(ip->at.c, &c));
  PetscFunctionReturn(0);
}

/* Finds whether the filter accepts the present x with suitable slacks, and the violation is clearly below theta0 */
static PetscErrorCode RestoreAccepts(Tao tao, PetscReal theta0, PetscBool *accepted)
{
  TAO_IPFILTER   *ip        = (TAO_IPFILTER *)tao->data;
  const PetscReal reduction = 0.9;
  PetscReal       theta, phi;

  PetscFunctionBegin;
  if (ip->mi) {
    PetscCall(RestoreChooseSlacks(tao, theta0));
    PetscCall(IPSlackKeepInside(tao, ip->trial.s, 1e-3));
    PetscCall(IPSlackDistance(tao, ip->trial.s, PETSC_TRUE));
  }
  PetscCall(IPIterateCopyPoint(&ip->at, &ip->trial));
  PetscCall(IPBoundsDistance(tao, tao->solution, PETSC_TRUE));
  PetscCall(IPMeritMeasureTrial(tao, &theta, &phi));
  *accepted = (PetscBool)(theta <= reduction * theta0);
  if (*accepted) PetscCall(IPFilterSetAccepts(ip->filter, theta, phi, accepted));
  PetscFunctionReturn(0);
}

/* Sets the slacks and multipliers with which the interior point iteration continues */
static PetscErrorCode RestoreLeave(Tao tao)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  if (ip->mi) {
    PetscCall(VecCopy(ip->trial.s, ip->at.s));
    PetscCall(IPPairCenter(&ip->pair[IP_SLACK], ip->mu));
    PetscCall(IPSlackCenterUpper(tao, ip->mu));
  }
  if (ip->me) PetscCall(IPEqualityMultipliers(tao));
  ip->bar->nerrors       = 0;
  ip->relax->least_slack = ip->relax->least_bound = PETSC_INFINITY;
  PetscFunctionReturn(0);
}

/* Computes the size of the Hessian relative to that at the start. Multipliers that grow without limit enlarge it. */
static PetscErrorCode RestoreMetricGrowth(Tao tao, PetscReal *growth)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  PetscReal     size;
  PetscInt      n;
  Vec           diagonal;

  PetscFunctionBegin;
  PetscCall(IPGetWork(tao, IP_UNKNOWNS, &diagonal));
  PetscCall(IPHessianDiagonal(tao, diagonal));
  PetscCall(VecNorm(diagonal, NORM_1, &size));
  PetscCall(VecGetSize(diagonal, &n));
  PetscCall(IPRestoreWork(tao, IP_UNKNOWNS, &diagonal));
  *growth = PetscMax(size / n / ip->stiff->hscale, 1.0);
  PetscFunctionReturn(0);
}

/*
   Chooses the initial zeta such that the metric and the model of the violation are of equal size, using the stiffness
   of the constraints
*/
static PetscErrorCode RestoreFirstZeta(Tao tao)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  PetscReal     rho, growth = 1.0;

  PetscFunctionBegin;
  if (ip->mi) {
    PetscCall(VecMax(ip->stiff->rho, NULL, &rho));
    ip->restore->zeta = 1.0 / rho;
  } else ip->restore->zeta = PetscSqr(ip->search->equality_weight * ip->scale->equality) / ip->scale->product;
  PetscCall(RestoreMetricGrowth(tao, &growth));
  ip->restore->zeta /= growth;
  PetscFunctionReturn(0);
}

/*
   Sets those entries of psi's gradient to zero for which a bound stops the descent before psi changes by more than
   max_change
*/
static PetscErrorCode RestoreProject(Vec gradient, const IPPair *p, PetscReal max_change)
{
  const PetscScalar *t;
  PetscScalar       *g;
  PetscInt           n;

  PetscFunctionBegin;
  if (!p->n) PetscFunctionReturn(0);
  PetscCall(VecGetLocalSize(gradient, &n));
  PetscCall(VecGetArrayRead(p->t, &t));
  PetscCall(VecGetArray(gradient, &g));
  for (PetscInt i = 0; i < n; i++)
    if (p->sign * PetscRealPart(g[i]) > 0.0 && PetscRealPart(t[i]) * PetscAbsScalar(g[i]) <= max_change) g[i] = 0.0;
  PetscCall(VecRestoreArray(gradient, &g));
  PetscCall(VecRestoreArrayRead(p->t, &t));
  PetscFunctionReturn(0);
}

/*
   Computes |J^T r| / (|J| |r|) without the components that bounds stop; 0 if psi is stationary. size: |J| at the start
   of the restoration.
*/
static PetscErrorCode RestoreRelativeGradient(Tao tao, PetscReal size, PetscReal psi, PetscReal *relative)
{
  TAO_IPFILTER   *ip       = (TAO_IPFILTER *)tao->data;
  const PetscReal fraction = 1e-4;
  Vec             gradient;

  PetscFunctionBegin;
  PetscCall(IPGetWork(tao, IP_UNKNOWNS, &gradient));
  PetscCall(RestoreGradient(tao, gradient));
  PetscCall(RestoreProject(gradient, &ip->pair[IP_LOWER], fraction * psi));
  PetscCall(RestoreProject(gradient, &ip->pair[IP_UPPER], fraction * psi));
  PetscCall(IPFixedZero(tao, gradient));
  PetscCall(VecNorm(gradient, NORM_2, relative));
  PetscCall(IPRestoreWork(tao, IP_UNKNOWNS, &gradient));
  *relative = size > 0.0 && psi > 0.0 ? *relative / (size * PetscSqrtReal(2.0 * psi)) : 0.0;
  PetscFunctionReturn(0);
}

/* Computes |J| in the weights of psi, at the present point or at the start of the solve, whichever is larger */
static PetscErrorCode RestoreJacobianSize(Tao tao, PetscReal *size)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  PetscReal     w = 0.0, j = 0.0;

  PetscFunctionBegin;
  if (ip->mi) {
    PetscCall(VecMax(ip->pair[IP_SLACK].w, NULL, &w));
    PetscCall(MatNorm(ip->jac->inequality, NORM_FROBENIUS, &j));
    j = PetscMax(j, ip->first->jacobian);
  }
  *size = PetscSqrtReal(w) * j;
  if (ip->me) {
    PetscCall(MatNorm(ip->jac->equality, NORM_FROBENIUS, &j));
    j = PetscMax(j, ip->first->equality_jacobian);
    *size += ip->search->equality_weight * j;
  }
  PetscFunctionReturn(0);
}

/* Computes the derivative of psi along dx */
static PetscErrorCode RestoreSlope(Tao tao, PetscReal *slope)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  Vec           gradient;
  PetscScalar   gd;

  PetscFunctionBegin;
  PetscCall(IPGetWork(tao, IP_UNKNOWNS, &gradient));
  PetscCall(RestoreGradient(tao, gradient));
  PetscCall(VecDot(gradient, ip->dir.x, &gd));
  PetscCall(IPRestoreWork(tao, IP_UNKNOWNS, &gradient));
  *slope = PetscRealPart(gd);
  PetscFunctionReturn(0);
}

/*
   Makes one restoration step and updates psi. *alpha: its length; *gradient: relative gradient before the step;
   *descent: false if the barrier function of the bounds makes the step increase the violation.
*/
static PetscErrorCode RestoreStep(Tao tao, PetscReal size, PetscReal *psi, PetscReal *alpha, PetscReal *gradient,
  PetscBool *descent)
{
  const PetscReal stationary = 1e-12;
  PetscBool       usable     = PETSC_FALSE;
  PetscReal       slope      = 0.0;

  PetscFunctionBegin;
  *alpha   = 0.0;
  *descent = PETSC_TRUE;
  PetscCall(RestoreRelativeGradient(tao, size, *psi, gradient));
  if (*gradient <= stationary) PetscFunctionReturn(0);
  PetscCall(IPBoundsCenter(tao));
  PetscCall(IPRegularize(tao, IP_RESTORE_METRIC, RestoreAssemble, RestoreSolve, &usable));
  if (!usable) PetscFunctionReturn(0);
  PetscCall(RestoreSlope(tao, &slope));
  *descent = (PetscBool)(slope < 0.0);
  if (*descent) PetscCall(RestoreSearch(tao, slope, psi, alpha));
  PetscFunctionReturn(0);
}

/*
   Makes restoration steps until the filter accepts the point (*ok), or the violation no longer falls (*stuck). *least:
   smallest relative gradient since psi last fell; it may still fall while psi does not.
*/
static PetscErrorCode RestoreIterate(Tao tao, PetscReal theta0, PetscReal *psi, PetscBool *ok, PetscBool *stuck,
  PetscReal *least)
{
  TAO_IPFILTER   *ip        = (TAO_IPFILTER *)tao->data;
  const PetscReal no_change = 1e-8, falling = 0.9;
  const PetscInt  patience = 10;
  PetscReal       size = 0.0, gradient = 1.0;
  PetscInt        idle = 0;

  PetscFunctionBegin;
  *least = PETSC_INFINITY;
  PetscCall(RestoreJacobianSize(tao, &size));
  for (PetscInt k = 0; k < IP_RESTORE_MAX && !*ok && idle < patience; k++) {
    const PetscReal before  = *psi;
    PetscReal       alpha   = 0.0;
    PetscBool       descent = PETSC_TRUE, falls;

    PetscCall(RestoreStep(tao, size, psi, &alpha, &gradient, &descent));
    PetscCall(PetscInfo(tao, "Restoration %" PetscInt_FMT ": violation %g, gradient %g, step %g, zeta %g\n", k,
      (double)PetscSqrtReal(2.0 * *psi), (double)gradient, (double)alpha, (double)ip->restore->zeta));
    falls = (PetscBool)(*psi < (1.0 - no_change) * before);
    if (falls) {
      idle   = 0;
      *least = PETSC_INFINITY;
    } else if (gradient <= IP_RESTORE_LEAST) idle = patience;
    else if (gradient <= IP_RESTORE_SMALL || gradient > falling * *least) idle++;
    *least = PetscMin(*least, gradient);
    if (alpha == 0.0) ip->restore->zeta *= descent ? 10.0 : 0.1;
    if (alpha == 0.0) continue;
    PetscCall(RestoreTakeTrial(tao));
    PetscCall(RestoreAccepts(tao, theta0, ok));
  }
  *stuck = (PetscBool)(idle >= patience);
  PetscFunctionReturn(0);
}

/*
   Reduces the violation until the filter accepts the point. *ok: whether it does. *infeasible: if not, whether the
   violation has a local minimum that is not zero, that is, it no longer falls and its projected gradient is small.
*/
PetscErrorCode IPRestore(Tao tao, PetscBool *ok, PetscBool *infeasible)
{
  TAO_IPFILTER *ip     = (TAO_IPFILTER *)tao->data;
  PetscReal     theta0 = ip->search->theta, psi, least = 0.0;
  PetscBool     stuck = PETSC_FALSE;

  PetscFunctionBegin;
  PetscCall(IPMeritFilterAdd(tao));
  *ok = PETSC_FALSE;
  ip->rec->nrestored++;
  PetscCall(RestoreFirstZeta(tao));
  PetscCall(RestoreViolation(tao, &ip->at, &psi));
  PetscCall(IPGetWork(tao, IP_INEQUALITIES, &ip->restore->D));
  PetscCall(RestoreAccepts(tao, theta0, ok)); /* It is possible that only the slacks are far from the constraints'
                                                 values. */
  PetscCall(RestoreIterate(tao, theta0, &psi, ok, &stuck, &least));
  PetscCall(IPRestoreWork(tao, IP_INEQUALITIES, &ip->restore->D));
  *infeasible = (PetscBool)(!*ok && stuck && least <= IP_RESTORE_SMALL &&
                            (PetscSqrtReal(2.0 * psi) > 1e-6 * ip->search->theta_ref ||
                              (!ip->relax->times && ip->kkt->own > 1e-6))); /* terms of relaxed rows may vanish */
  PetscCall(IPBoundsCenter(tao));
  if (*ok) PetscCall(RestoreLeave(tao));
  PetscFunctionReturn(0);
}
