/* Starting values of slacks and multipliers. */
#include "ipfilterimpl.h"

/* The given constants: t stays for bounds, s = s0, z = z0, lambda = 0, mu = mu0 */
static PetscErrorCode Cold(Tao tao)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  ip->mu = ip->mu0;
  if (ip->mi) {
    PetscCall(VecSet(ip->pair[IP_SLACK].t, ip->s0));
    PetscCall(VecSet(ip->pair[IP_SLACK].z, ip->z0));
    PetscCall(VecSet(ip->lambda, 0.0));
  }
  PetscFunctionReturn(0);
}

/* The point of the central path of one constraint that a penalty of stiffness rho bends: s z = mu and s - q = z/rho */
PetscErrorCode IPCentralPair(Vec q, Vec rho, PetscReal mu, Vec s, Vec z)
{
  const PetscScalar *qa, *ra;
  PetscScalar       *sa, *za;
  PetscInt           n;

  PetscFunctionBegin;
  PetscCall(VecGetLocalSize(q, &n));
  PetscCall(VecGetArrayRead(q, &qa));
  PetscCall(VecGetArrayRead(rho, &ra));
  PetscCall(VecGetArrayWrite(s, &sa));
  PetscCall(VecGetArrayWrite(z, &za));
  for (PetscInt i = 0; i < n; i++) {
    const PetscReal g = PetscRealPart(qa[i]), r = PetscRealPart(ra[i]), root = PetscSqrtReal(g * g + 4.0 * mu / r);

    /* the root that does not cancel, and the other from their product mu/rho */
    if (g >= 0.0) {
      sa[i] = 0.5 * (g + root);
      za[i] = mu / PetscRealPart(sa[i]);
    } else {
      za[i] = 0.5 * r * (root - g);
      sa[i] = mu / PetscRealPart(za[i]);
    }
  }
  PetscCall(VecRestoreArrayWrite(z, &za));
  PetscCall(VecRestoreArrayWrite(s, &sa));
  PetscCall(VecRestoreArrayRead(rho, &ra));
  PetscCall(VecRestoreArrayRead(q, &qa));
  PetscFunctionReturn(0);
}

/* Weighted mean of rho q^2: the product length x pressure of the constraints' present values */
static PetscErrorCode MeanProduct(Tao tao, Vec q, PetscReal *mean)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  PetscScalar   sum;

  PetscFunctionBegin;
  PetscCall(VecPointwiseMult(ip->cwork, q, q));
  PetscCall(VecPointwiseMult(ip->cwork2, ip->stiffness, ip->pair[IP_SLACK].w));
  PetscCall(VecDot(ip->cwork, ip->cwork2, &sum));
  *mean = PetscRealPart(sum) / ip->pair[IP_SLACK].weight;
  PetscFunctionReturn(0);
}

/* Pressures that a penalty of the constraints' stiffness gives at the constraint values c: z = rho max(-c, 0) */
static PetscErrorCode PenaltyPressure(Tao tao, Vec c, Vec z)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  PetscCall(VecSet(z, 0.0));
  PetscCall(VecPointwiseMin(z, c, z));
  PetscCall(VecPointwiseMult(z, z, ip->stiffness));
  PetscCall(VecScale(z, -1.0));
  PetscFunctionReturn(0);
}

/* Weighted sums of |c| and z, divided by the weight: a length and a pressure */
static PetscErrorCode MeanMagnitudes(Tao tao, Vec c, Vec z, PetscReal *length, PetscReal *pressure)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  IPPair       *p  = &ip->pair[IP_SLACK];

  PetscFunctionBegin;
  PetscCall(VecPointwiseMult(ip->cwork2, c, p->w));
  PetscCall(VecNorm(ip->cwork2, NORM_1, length));
  PetscCall(VecPointwiseMult(ip->cwork2, z, p->w));
  PetscCall(VecNorm(ip->cwork2, NORM_1, pressure));
  *length /= p->weight;
  *pressure /= p->weight;
  PetscFunctionReturn(0);
}

/* dx of the penalized problem, until the forces out of balance are a fraction of those the constraints transmit; of no use
   along a direction in which it is not convex */
static PetscErrorCode PenaltySolve(Tao tao, PetscBool *usable)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  PetscReal     target;

  PetscFunctionBegin;
  PetscCall(VecPointwiseMult(ip->cwork, ip->stiffness, ip->pair[IP_SLACK].w));
  PetscCall(IPCondenseMatrix(tao, ip->cwork));
  PetscCall(PenaltyPressure(tao, ip->c, ip->cwork));
  PetscCall(VecPointwiseMult(ip->cwork, ip->cwork, ip->pair[IP_SLACK].w));
  PetscCall(VecCopy(tao->gradient, ip->rhs));
  PetscCall(VecScale(ip->rhs, -1.0));
  PetscCall(MatMultTransposeAdd(ip->cond.J, ip->cwork, ip->rhs, ip->rhs));
  PetscCall(VecNorm(ip->rhs, NORM_2, &target));
  PetscCall(VecSet(ip->dx, 0.0));
  *usable = (PetscBool)(target > 0.0);
  for (PetscInt pass = 0; pass < 3 && *usable; pass++) {
    PetscReal force;

    target *= ip->forcing_start;
    PetscCall(IPLinearSolve(tao, ip->rhs, ip->dx, target, usable));
    PetscCall(MatMultAdd(ip->cond.J, ip->dx, ip->c, ip->ctrial));
    PetscCall(PenaltyPressure(tao, ip->ctrial, ip->cwork));
    PetscCall(VecPointwiseMult(ip->cwork, ip->cwork, ip->pair[IP_SLACK].w));
    PetscCall(MatMultTranspose(ip->cond.J, ip->cwork, ip->xwork));
    PetscCall(VecNorm(ip->xwork, NORM_2, &force));
    if (ip->linear_residual <= ip->forcing_start * force || force == 0.0) break;
    target = force;
  }
  if (*usable) {
    PetscScalar curvature;
    PetscReal   size;

    PetscCall(MatMult(ip->cond.A, ip->dx, ip->xwork));
    PetscCall(VecDot(ip->dx, ip->xwork, &curvature));
    PetscCall(VecNorm(ip->dx, NORM_2, &size));
    *usable = (PetscBool)(PetscRealPart(curvature) > 1e-8 * ip->hscale * PetscSqr(size));
  }
  PetscFunctionReturn(0);
}

/* The penalized objective f + 1/2 sum m rho min(c, 0)^2 at x, whose f goes into ftrial and constraint values into c */
static PetscErrorCode PenaltyObjective(Tao tao, Vec x, Vec c, PetscReal *value)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  PetscScalar   penalty;

  PetscFunctionBegin;
  PetscCall(TaoComputeObjective(tao, x, &ip->ftrial));
  *value = ip->ftrial;
  if (IPUndefined(*value)) PetscFunctionReturn(0);
  PetscCall(IPEvaluateConstraints(tao, x, c, ip->cetrial));
  PetscCall(PenaltyPressure(tao, c, ip->cwork));
  PetscCall(VecPointwiseMult(ip->cwork, ip->cwork, ip->pair[IP_SLACK].w));
  PetscCall(VecDot(ip->cwork, c, &penalty));
  *value -= 0.5 * PetscRealPart(penalty);
  PetscFunctionReturn(0);
}

/* Whether objective and constraints at x + alpha dx, at hand, are those of their models from x: for a quadratic program always */
static PetscErrorCode ModelsHold(Tao tao, PetscReal alpha, PetscBool *hold)
{
  TAO_IPFILTER   *ip   = (TAO_IPFILTER *)tao->data;
  const PetscReal some = 0.1;
  PetscScalar     gd, dHd;
  PetscReal       change, error, f;

  PetscFunctionBegin;
  PetscCall(MatMult(tao->hessian, ip->dx, ip->xwork));
  PetscCall(VecDot(ip->xwork, ip->dx, &dHd));
  PetscCall(VecDot(tao->gradient, ip->dx, &gd));
  f = alpha * (PetscRealPart(gd) + 0.5 * alpha * PetscRealPart(dHd));
  PetscCall(MatMult(ip->cond.J, ip->dx, ip->cwork));
  PetscCall(VecScale(ip->cwork, alpha));
  PetscCall(VecNorm(ip->cwork, NORM_2, &change));
  PetscCall(VecAXPY(ip->cwork, 1.0, ip->c));
  PetscCall(VecAXPY(ip->cwork, -1.0, ip->ctrial));
  PetscCall(VecNorm(ip->cwork, NORM_2, &error));
  *hold = (PetscBool)(error <= some * change && PetscAbsReal(ip->f + f - ip->ftrial) <= some * (alpha * PetscAbsScalar(gd) + alpha * alpha * PetscAbsScalar(dHd)));
  PetscFunctionReturn(0);
}

/* Moves x along the solution of the penalized problem, as far as its bounds allow and where that reduces the penalized
   objective; *moved is false where it does not, where the problem's models do not reach so far, or where equality constraints
   stand against it */
static PetscErrorCode PenaltyStep(Tao tao, PetscBool *moved)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  PetscReal     before, after, alpha = 1.0;
  PetscBool     usable = PETSC_FALSE;

  PetscFunctionBegin;
  *moved = PETSC_FALSE;
  if (ip->me) PetscFunctionReturn(0);
  PetscCall(PenaltySolve(tao, &usable));
  if (!usable) PetscFunctionReturn(0);
  for (PetscInt b = IP_LOWER; b <= IP_UPPER; b++) {
    IPPair *p = &ip->pair[b];

    if (!p->n) continue;
    PetscCall(VecCopy(ip->dx, p->dt));
    if (b == IP_UPPER) PetscCall(VecScale(p->dt, -1.0));
    PetscCall(IPPairMaxStep(p->t, p->dt, 0.9, &alpha));
  }
  PetscCall(PenaltyObjective(tao, tao->solution, ip->ctrial, &before));
  for (PetscInt k = 0; k < 4 && !*moved; k++, alpha *= 0.5) {
    PetscCall(VecWAXPY(ip->xtrial, alpha, ip->dx, tao->solution));
    PetscCall(PenaltyObjective(tao, ip->xtrial, ip->ctrial, &after));
    *moved = (PetscBool)(!IPUndefined(after) && after <= before);
    if (*moved) PetscCall(ModelsHold(tao, alpha, moved));
  }
  if (!*moved) PetscFunctionReturn(0);
  PetscCall(VecCopy(ip->xtrial, tao->solution));
  PetscCall(VecCopy(ip->ctrial, ip->c));
  ip->f = ip->ftrial;
  PetscCall(IPBoundsDistance(tao, tao->solution, PETSC_FALSE));
  PetscCall(IPEvaluateDerivatives(tao));
  PetscFunctionReturn(0);
}

/* Without a penalty step the stiffness is that of multipliers which balance the gradient, over the constraints' mean value */
static PetscErrorCode GradientStiffness(Tao tao)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  PetscReal     gradient, transmitted, length, unused;

  PetscFunctionBegin;
  PetscCall(VecNorm(tao->gradient, NORM_2, &gradient));
  PetscCall(MatMultTranspose(ip->cond.J, ip->pair[IP_SLACK].w, ip->xwork));
  PetscCall(VecNorm(ip->xwork, NORM_2, &transmitted));
  PetscCall(MeanMagnitudes(tao, ip->c, ip->c, &length, &unused));
  if (gradient > 0.0 && transmitted > 0.0 && length > 0.0) PetscCall(VecSet(ip->stiffness, gradient / transmitted / length));
  PetscFunctionReturn(0);
}

/* s and z from the constraints' values after the penalty step, centred, with mu a fraction of length x pressure there */
static PetscErrorCode Predict(Tao tao)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  PetscReal     length, pressure, mean;
  PetscBool     moved = PETSC_FALSE;

  PetscFunctionBegin;
  PetscCall(PenaltyStep(tao, &moved));
  if (!moved) PetscCall(GradientStiffness(tao));
  PetscCall(PenaltyPressure(tao, ip->c, ip->cwork));
  PetscCall(MeanMagnitudes(tao, ip->c, ip->cwork, &length, &pressure));
  PetscCall(MeanProduct(tao, ip->c, &mean));
  ip->mu = moved ? ip->mu_start * PetscMax(length * pressure, 1e-3 * mean) : 0.1 * mean;
  if (!(ip->mu > 0.0)) ip->mu = ip->mu0;
  PetscCall(IPCentralPair(ip->c, ip->stiffness, ip->mu, ip->pair[IP_SLACK].t, ip->pair[IP_SLACK].z));
  PetscCall(VecCopy(ip->pair[IP_SLACK].z, ip->lambda));
  PetscFunctionReturn(0);
}

/* How far the caller's s and z are from belonging to x: the larger of the forces out of balance, relative, and of
   |c - s| against |c|, but no more than 1 */
static PetscErrorCode WarmMismatch(Tao tao, PetscReal *mismatch)
{
  TAO_IPFILTER *ip    = (TAO_IPFILTER *)tao->data;
  IPPair       *slack = &ip->pair[IP_SLACK];
  PetscReal     force, imbalance, length, difference, unused;

  PetscFunctionBegin;
  PetscCall(IPStationarity(tao, slack->z, ip->rx));
  PetscCall(VecNorm(tao->gradient, NORM_2, &force));
  PetscCall(VecNorm(ip->rx, NORM_2, &imbalance));
  PetscCall(VecWAXPY(ip->rc, -1.0, slack->t, ip->c));
  PetscCall(MeanMagnitudes(tao, ip->rc, ip->rc, &difference, &unused));
  PetscCall(MeanMagnitudes(tao, ip->c, ip->c, &length, &unused));
  *mismatch = PetscMin(1.0, PetscMax(force > 0.0 ? imbalance / force : 1.0, length > 0.0 ? difference / length : 1.0));
  PetscFunctionReturn(0);
}

/* The caller's s and z, moved away from the boundary: s - z/rho is kept, the pair is centred, farther from the boundary
   the less they belong to x */
static PetscErrorCode Warm(Tao tao)
{
  TAO_IPFILTER *ip    = (TAO_IPFILTER *)tao->data;
  IPPair       *slack = &ip->pair[IP_SLACK];
  PetscReal     mean, average, mismatch = 1.0;

  PetscFunctionBegin;
  PetscCall(VecCopy(ip->warm_s, slack->t));
  PetscCall(VecCopy(ip->warm_z, slack->z));
  PetscCall(IPScalingPair(tao, slack->t, slack->z, PETSC_FALSE));
  PetscCall(WarmMismatch(tao, &mismatch));
  PetscCall(IPPairProducts(slack, 0.0, NULL, &average));
  average = PetscMax(average / slack->weight, 0.0);
  PetscCall(VecPointwiseDivide(ip->ctrial, slack->z, ip->stiffness));
  PetscCall(VecAYPX(ip->ctrial, -1.0, slack->t));
  PetscCall(MeanProduct(tao, ip->ctrial, &mean));
  ip->mu = PetscMax(average, mismatch * ip->mu_warm * (mean > 0.0 ? mean : 1.0));
  PetscCall(IPCentralPair(ip->ctrial, ip->stiffness, ip->mu, slack->t, slack->z));
  PetscCall(VecCopy(slack->z, ip->lambda));
  PetscFunctionReturn(0);
}

/* Fills slacks, multipliers and mu. The Hessian at x is needed for the stiffness of the constraints. */
PetscErrorCode IPStartPoint(Tao tao)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  PetscCall(PetscLogEventBegin(TAO_IPFilterStart, tao, NULL, NULL, NULL));
  for (PetscInt b = IP_LOWER; b <= IP_UPPER; b++)
    if (ip->pair[b].n) PetscCall(VecSet(ip->pair[b].z, 0.0));
  if (ip->start == IP_START_COLD || !ip->mi) PetscCall(Cold(tao));
  else if (ip->start == IP_START_WARM && ip->warm_s) PetscCall(Warm(tao));
  else PetscCall(Predict(tao));
  if (!ip->mi && ip->scaling == IP_SCALING_PROBLEM) {
    PetscReal x;

    PetscCall(VecNorm(tao->solution, NORM_INFINITY, &x));
    ip->mu = ip->mu_start * ip->hscale * (x > 0.0 ? x * x : 1.0);
  }
  for (PetscInt b = IP_LOWER; b <= IP_UPPER; b++) {
    IPPair *p = &ip->pair[b];

    if (!p->n) continue;
    PetscCall(IPPairSetTarget(p, ip->mu, 0.0));
    PetscCall(IPPairDualDirection(p));
    PetscCall(VecCopy(p->dz, p->z));
  }
  if (ip->me) PetscCall(IPEstimateMultipliers(tao));
  PetscCall(PetscLogEventEnd(TAO_IPFilterStart, tao, NULL, NULL, NULL));
  PetscFunctionReturn(0);
}
