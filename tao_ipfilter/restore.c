/*
   Feasibility restoration, where the line search finds no step: Levenberg-Marquardt steps for the violation

     psi(x) = 1/2 sum_i m_i min(c_I,i, 0)^2 + 1/2 w^2 |c_E|^2,

   each the minimum of psi's Gauss-Newton model / zeta + 1/2 d^T (H + delta M_u) d - mu sum log of the distances to bounds. The Hessian as
   metric lets an elastic body follow its surface. Its matrix is the condensed one with D = m/zeta in the violated rows, and
   the augmented one with delta_c = zeta/w^2, so that the solvers of the iteration proper serve here too.
*/
#include "ipfilterimpl.h"

#define IP_RESTORE_MAX    200 /* steps */
#define IP_RESTORE_METRIC 0.1 /* least delta in the metric, in its unit: where the Hessian has no curvature */

/* min(c, 0) */
static PetscErrorCode Negative(Vec c, Vec v)
{
  PetscFunctionBegin;
  PetscCall(VecSet(v, 0.0));
  PetscCall(VecPointwiseMin(v, c, v));
  PetscFunctionReturn(0);
}

/* psi for constraint values c, ce */
static PetscErrorCode SquaredViolation(Tao tao, Vec c, Vec ce, PetscReal *psi)
{
  TAO_IPFILTER *ip  = (TAO_IPFILTER *)tao->data;
  PetscScalar   sum = 0.0;
  PetscReal     equality = 0.0;

  PetscFunctionBegin;
  if (ip->mi) {
    PetscCall(Negative(c, ip->cwork));
    PetscCall(VecPointwiseMult(ip->cwork2, ip->cwork, ip->pair[IP_SLACK].w));
    PetscCall(VecDot(ip->cwork, ip->cwork2, &sum));
  }
  if (ip->me) PetscCall(VecNorm(ce, NORM_2, &equality));
  *psi = 0.5 * (PetscRealPart(sum) + PetscSqr(ip->equality_weight * equality));
  PetscFunctionReturn(0);
}

/* Gradient of psi at the present point */
static PetscErrorCode ViolationGradient(Tao tao, Vec g)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  PetscCall(VecSet(g, 0.0));
  if (ip->mi) {
    PetscCall(Negative(ip->c, ip->cwork));
    PetscCall(VecPointwiseMult(ip->cwork, ip->cwork, ip->pair[IP_SLACK].w));
    PetscCall(MatMultTranspose(ip->cond.J, ip->cwork, g));
  }
  if (ip->me) {
    PetscCall(VecCopy(ip->ce, ip->cetrial));
    PetscCall(VecScale(ip->cetrial, PetscSqr(ip->equality_weight)));
    PetscCall(MatMultTransposeAdd(ip->JE, ip->cetrial, g, g));
  }
  PetscFunctionReturn(0);
}

/* D = m/zeta in the violated rows, 0 in the others */
static PetscErrorCode Assemble(Tao tao)
{
  TAO_IPFILTER      *ip = (TAO_IPFILTER *)tao->data;
  const PetscScalar *c;
  PetscScalar       *d;
  PetscInt           n;

  PetscFunctionBegin;
  if (ip->mi) {
    PetscCall(VecCopy(ip->pair[IP_SLACK].w, ip->rcsoc));
    PetscCall(VecScale(ip->rcsoc, 1.0 / ip->zeta));
    PetscCall(VecGetLocalSize(ip->c, &n));
    PetscCall(VecGetArrayRead(ip->c, &c));
    PetscCall(VecGetArray(ip->rcsoc, &d));
    for (PetscInt i = 0; i < n; i++)
      if (PetscRealPart(c[i]) >= 0.0) d[i] = 0.0;
    PetscCall(VecRestoreArray(ip->rcsoc, &d));
    PetscCall(VecRestoreArrayRead(ip->c, &c));
  }
  ip->delta_c = ip->me ? ip->zeta / PetscSqr(ip->equality_weight) : 0.0;
  PetscCall(IPCondenseMatrix(tao, ip->rcsoc));
  PetscFunctionReturn(0);
}

/* The step; usable where it descends on the violation or on the bounds' barrier */
static PetscErrorCode Solve(Tao tao, PetscBool *usable)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  PetscReal     norm;
  PetscScalar   descent;

  PetscFunctionBegin;
  PetscCall(VecSet(ip->rhs, 0.0));
  if (ip->mi) {
    PetscCall(VecPointwiseMult(ip->cwork, ip->rcsoc, ip->c));
    PetscCall(VecScale(ip->cwork, -1.0));
    PetscCall(MatMultTranspose(ip->cond.J, ip->cwork, ip->rhs));
  }
  for (PetscInt b = IP_LOWER; b <= IP_UPPER; b++) {
    if (!ip->pair[b].n) continue;
    PetscCall(IPPairGetForce(&ip->pair[b], ip->xwork));
    PetscCall(VecAXPY(ip->rhs, b == IP_LOWER ? 1.0 : -1.0, ip->xwork));
  }
  PetscCall(VecSet(ip->dx, 0.0));
  PetscCall(VecNorm(ip->rhs, NORM_2, &norm));
  if (ip->me) PetscCall(IPAugmentedSolve(tao, ip->rhs, ip->ce, ip->dx, PETSC_TRUE, usable));
  else PetscCall(IPLinearSolve(tao, ip->rhs, ip->dx, 1e-3 * norm, usable));
  if (!*usable) PetscFunctionReturn(0);
  if (ip->me) PetscFunctionReturn(0);
  PetscCall(VecDot(ip->rhs, ip->dx, &descent));
  *usable = (PetscBool)(PetscRealPart(descent) > 0.0);
  PetscFunctionReturn(0);
}

/* Multipliers of bounds back on the central path of the present mu */
static PetscErrorCode CenterBounds(Tao tao)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  PetscCall(IPSetTargets(tao, ip->mu, 0.0));
  for (PetscInt b = IP_LOWER; b <= IP_UPPER; b++) {
    IPPair *p = &ip->pair[b];

    if (!p->n) continue;
    PetscCall(VecSet(p->z, 0.0));
    PetscCall(IPPairDualDirection(p));
    PetscCall(VecCopy(p->dz, p->z));
  }
  PetscFunctionReturn(0);
}

/* Largest step that keeps x inside its bounds */
static PetscErrorCode BoundStep(Tao tao, PetscReal *alpha)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  *alpha = 1.0;
  for (PetscInt b = IP_LOWER; b <= IP_UPPER; b++) {
    IPPair *p = &ip->pair[b];

    if (!p->n) continue;
    PetscCall(VecCopy(ip->dx, p->dt));
    if (b == IP_UPPER) PetscCall(VecScale(p->dt, -1.0));
    PetscCall(IPPairMaxStep(p->t, p->dt, ip->tau_min, alpha));
  }
  PetscFunctionReturn(0);
}

/* Backtracks until psi falls; *psi is its value there, *alpha 0 where it does not */
static PetscErrorCode Search(Tao tao, PetscReal slope, PetscReal *psi, PetscReal *alpha)
{
  TAO_IPFILTER   *ip = (TAO_IPFILTER *)tao->data;
  const PetscReal armijo = 1e-4;
  const PetscInt  most   = 12;

  PetscFunctionBegin;
  PetscCall(BoundStep(tao, alpha));
  for (PetscInt k = 0; k < most; k++, *alpha *= 0.5) {
    PetscReal trial;

    PetscCall(VecWAXPY(ip->xtrial, *alpha, ip->dx, tao->solution));
    PetscCall(TaoComputeObjective(tao, ip->xtrial, &ip->ftrial));
    if (IPUndefined(ip->ftrial)) continue;
    PetscCall(IPEvaluateConstraints(tao, ip->xtrial, ip->ctrial, ip->cetrial));
    PetscCall(SquaredViolation(tao, ip->ctrial, ip->cetrial, &trial));
    if (IPUndefined(trial) || trial > *psi + armijo * *alpha * slope) continue;
    *psi = trial;
    PetscFunctionReturn(0);
  }
  *alpha = 0.0;
  PetscFunctionReturn(0);
}

/* x, its constraint values and derivatives from the trial point */
static PetscErrorCode TakeTrial(Tao tao)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  PetscCall(VecCopy(ip->xtrial, tao->solution));
  if (ip->mi) PetscCall(VecCopy(ip->ctrial, ip->c));
  if (ip->me) PetscCall(VecCopy(ip->cetrial, ip->ce));
  ip->f = ip->ftrial;
  PetscCall(IPBoundsDistance(tao, tao->solution, PETSC_FALSE));
  PetscCall(IPEvaluateDerivatives(tao));
  PetscFunctionReturn(0);
}

/* Slacks for the present x: the constraint's value where that is well inside, else the slack of the central path */
static PetscErrorCode ChooseSlacks(Tao tao)
{
  TAO_IPFILTER      *ip = (TAO_IPFILTER *)tao->data;
  IPPair            *p  = &ip->pair[IP_SLACK];
  const PetscScalar *c, *rho;
  PetscScalar       *s;
  PetscInt           n;

  PetscFunctionBegin;
  PetscCall(IPCentralPair(ip->c, ip->stiffness, ip->mu, p->trial, ip->cwork));
  PetscCall(VecGetLocalSize(ip->c, &n));
  PetscCall(VecGetArrayRead(ip->c, &c));
  PetscCall(VecGetArrayRead(ip->stiffness, &rho));
  PetscCall(VecGetArray(p->trial, &s));
  for (PetscInt i = 0; i < n; i++) {
    const PetscReal central = PetscSqrtReal(ip->mu / PetscRealPart(rho[i]));

    if (PetscRealPart(c[i]) >= 0.1 * central) s[i] = c[i];
    else s[i] = PetscMin(PetscRealPart(s[i]), central);
  }
  PetscCall(VecRestoreArray(p->trial, &s));
  PetscCall(VecRestoreArrayRead(ip->stiffness, &rho));
  PetscCall(VecRestoreArrayRead(ip->c, &c));
  PetscFunctionReturn(0);
}

/* Whether the filter accepts the present x with slacks that belong to it, at clearly less violation than at the start */
static PetscErrorCode Acceptable(Tao tao, PetscReal theta0, PetscBool *accepted)
{
  TAO_IPFILTER   *ip        = (TAO_IPFILTER *)tao->data;
  const PetscReal reduction = 0.9;
  PetscReal       theta, phi;

  PetscFunctionBegin;
  if (ip->mi) {
    PetscCall(ChooseSlacks(tao));
    PetscCall(VecCopy(ip->c, ip->ctrial));
  }
  if (ip->me) PetscCall(VecCopy(ip->ce, ip->cetrial));
  PetscCall(IPBoundsDistance(tao, tao->solution, PETSC_TRUE));
  ip->ftrial = ip->f;
  PetscCall(IPMeasureTrial(tao, &theta, &phi));
  *accepted = (PetscBool)(theta <= reduction * theta0);
  if (*accepted) PetscCall(IPFilterSetAccepts(&ip->filter, theta, phi, accepted));
  PetscFunctionReturn(0);
}

/* Slacks and multipliers to go on from */
static PetscErrorCode Leave(Tao tao)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  if (ip->mi) {
    IPPair *p = &ip->pair[IP_SLACK];

    PetscCall(VecCopy(p->trial, p->t));
    PetscCall(VecSet(p->dt, 0.0));
    PetscCall(VecSet(p->z, 0.0));
    PetscCall(IPPairSetTarget(p, ip->mu, 0.0));
    PetscCall(IPPairDualDirection(p));
    PetscCall(VecCopy(p->dz, p->z));
    PetscCall(VecCopy(p->z, ip->lambda));
  }
  if (ip->me) PetscCall(IPEstimateMultipliers(tao));
  ip->nerror      = 0;
  ip->least_slack = PETSC_INFINITY;
  PetscFunctionReturn(0);
}

/* zeta at which the metric and the violation's model weigh alike, from the stiffness of the constraints */
static PetscErrorCode FirstZeta(Tao tao)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  PetscReal     rho;

  PetscFunctionBegin;
  if (ip->mi) {
    PetscCall(VecMax(ip->stiffness, NULL, &rho));
    ip->zeta = 1.0 / rho;
  } else ip->zeta = PetscSqr(ip->equality_weight * ip->scale.equality) / ip->scale.product;
  PetscFunctionReturn(0);
}

/* Zeroes the entries of a gradient whose descent a bound close by stops */
static PetscErrorCode Project(Vec gradient, const IPPair *p, PetscReal sign, PetscReal close)
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
    if (PetscRealPart(t[i]) <= close && sign * PetscRealPart(g[i]) > 0.0) g[i] = 0.0;
  PetscCall(VecRestoreArray(gradient, &g));
  PetscCall(VecRestoreArrayRead(p->t, &t));
  PetscFunctionReturn(0);
}

/* |J^T r| / (|J| |r|), without what bounds stop, with the constraints' gradients J at the start of the restoration: 0 where psi is
   stationary */
static PetscErrorCode RelativeGradient(Tao tao, Vec gradient, PetscReal size, PetscReal psi, PetscReal *relative)
{
  TAO_IPFILTER   *ip    = (TAO_IPFILTER *)tao->data;
  const PetscReal close = 1e-4;
  PetscReal       x;

  PetscFunctionBegin;
  PetscCall(VecNorm(tao->solution, NORM_INFINITY, &x));
  PetscCall(Project(gradient, &ip->pair[IP_LOWER], 1.0, close * x));
  PetscCall(Project(gradient, &ip->pair[IP_UPPER], -1.0, close * x));
  PetscCall(IPFixedZero(tao, gradient));
  PetscCall(VecNorm(gradient, NORM_2, relative));
  *relative = size > 0.0 && psi > 0.0 ? *relative / (size * PetscSqrtReal(2.0 * psi)) : 0.0;
  PetscFunctionReturn(0);
}

/* |J| in the weights of psi */
static PetscErrorCode JacobianSize(Tao tao, PetscReal *size)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  PetscReal     w = 0.0, j = 0.0;

  PetscFunctionBegin;
  if (ip->mi) {
    PetscCall(VecMax(ip->pair[IP_SLACK].w, NULL, &w));
    PetscCall(MatNorm(ip->cond.J, NORM_FROBENIUS, &j));
  }
  *size = PetscSqrtReal(w) * j;
  if (ip->me) {
    PetscCall(MatNorm(ip->JE, NORM_FROBENIUS, &j));
    *size += ip->equality_weight * j;
  }
  PetscFunctionReturn(0);
}

/* One step of the restoration: psi is updated; *alpha is the step's length, *gradient the relative gradient before it. *descent is false
   where the bounds' barrier turns the step away from less violation. */
static PetscErrorCode RestoreStep(Tao tao, PetscReal size, PetscReal *psi, PetscReal *alpha, PetscReal *gradient, PetscBool *descent)
{
  TAO_IPFILTER   *ip     = (TAO_IPFILTER *)tao->data;
  const PetscReal little = 1e-12;
  PetscBool       usable = PETSC_FALSE;
  PetscScalar     slope;

  PetscFunctionBegin;
  *alpha   = 0.0;
  *descent = PETSC_TRUE;
  PetscCall(ViolationGradient(tao, ip->xwork));
  PetscCall(RelativeGradient(tao, ip->xwork, size, *psi, gradient));
  if (*gradient <= little) PetscFunctionReturn(0);
  PetscCall(CenterBounds(tao));
  PetscCall(IPRegularize(tao, IP_RESTORE_METRIC, Assemble, Solve, &usable));
  if (!usable) PetscFunctionReturn(0);
  PetscCall(ViolationGradient(tao, ip->xwork));
  PetscCall(VecDot(ip->xwork, ip->dx, &slope));
  *descent = (PetscBool)(PetscRealPart(slope) < 0.0);
  if (*descent) PetscCall(Search(tao, PetscRealPart(slope), psi, alpha));
  PetscFunctionReturn(0);
}

/*
  Reduces the violation until the filter accepts the point. *ok is false where that was not reached; *infeasible then tells whether
  because the violation has a minimum that is not zero: it falls no longer, and its gradient, which may fall for longer, is small but
  for what bounds stop.
*/
PetscErrorCode IPRestore(Tao tao, PetscBool *ok, PetscBool *infeasible)
{
  TAO_IPFILTER   *ip      = (TAO_IPFILTER *)tao->data;
  const PetscReal theta0  = ip->theta, still = 1e-8, small = 1e-3, falling = 0.9;
  const PetscInt  most    = 15;
  PetscReal       psi, size = 0.0, gradient = 1.0, least = PETSC_INFINITY;
  PetscInt        idle = 0;

  PetscFunctionBegin;
  PetscCall(IPFilterAdd(tao));
  *ok = PETSC_FALSE;
  ip->nrestored++;
  PetscCall(FirstZeta(tao));
  PetscCall(JacobianSize(tao, &size));
  PetscCall(SquaredViolation(tao, ip->c, ip->ce, &psi));
  PetscCall(Acceptable(tao, theta0, ok)); /* slacks far from the constraints' values may be all that is wrong */
  for (PetscInt k = 0; k < IP_RESTORE_MAX && !*ok && idle < most; k++) {
    const PetscReal before  = psi;
    PetscReal       alpha   = 0.0;
    PetscBool       descent = PETSC_TRUE;

    PetscCall(RestoreStep(tao, size, &psi, &alpha, &gradient, &descent));
    PetscCall(PetscInfo(tao, "Restoration %" PetscInt_FMT ": violation %g, gradient %g, step %g, zeta %g\n", k, (double)PetscSqrtReal(2.0 * psi), (double)gradient, (double)alpha, (double)ip->zeta));
    if (psi < (1.0 - still) * before) {
      idle  = 0;
      least = PETSC_INFINITY;
    }
    if (psi >= (1.0 - still) * before && (gradient <= small || gradient > falling * least)) idle++;
    least = PetscMin(least, gradient);
    ip->zeta *= alpha > 0.5 || !descent ? 0.1 : (alpha > 0.0 ? 1.0 : 10.0);
    if (alpha == 0.0) continue;
    PetscCall(TakeTrial(tao));
    PetscCall(Acceptable(tao, theta0, ok));
  }
  *infeasible = (PetscBool)(!*ok && idle >= most && least <= small && PetscSqrtReal(2.0 * psi) > 1e-6 * ip->theta_ref);
  PetscCall(CenterBounds(tao));
  if (*ok) PetscCall(Leave(tao));
  PetscFunctionReturn(0);
}
