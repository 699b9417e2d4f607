/* Operations on the slacks of c_I, 0 <= s or 0 <= s <= width, which combine their one or two pairs */
#include "problemimpl.h"
#include "tao_ipfilter/solver/options.h"
#include "tao_ipfilter/solver/rows.h"
#include "tao_ipfilter/solver/stiffness.h"

/* Computes D = w z/s, plus w z/t of the upper sides with t = width - s */
PetscErrorCode IPSlackSigma(Tao tao, Vec D)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  Vec           upper;

  PetscFunctionBegin;
  PetscCall(IPPairGetSigma(&ip->pair[IP_SLACK], D));
  if (!ip->pair[IP_CEILING].n) PetscFunctionReturn(0);
  PetscCall(IPGetWork(tao, IP_INEQUALITIES, &upper));
  PetscCall(IPPairGetSigma(&ip->pair[IP_CEILING], upper));
  PetscCall(VecAXPY(D, 1.0, upper));
  PetscCall(IPRestoreWork(tao, IP_INEQUALITIES, &upper));
  PetscFunctionReturn(0);
}

/* Computes force = w target/s, minus w target/t of the upper sides */
PetscErrorCode IPSlackForce(Tao tao, Vec force)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  Vec           upper;

  PetscFunctionBegin;
  PetscCall(IPPairGetForce(&ip->pair[IP_SLACK], force));
  if (!ip->pair[IP_CEILING].n) PetscFunctionReturn(0);
  PetscCall(IPGetWork(tao, IP_INEQUALITIES, &upper));
  PetscCall(IPPairGetForce(&ip->pair[IP_CEILING], upper));
  PetscCall(VecAXPY(force, -1.0, upper));
  PetscCall(IPRestoreWork(tao, IP_INEQUALITIES, &upper));
  PetscFunctionReturn(0);
}

/* Computes the lambda for which the slacks are stationary: z minus the multiplier of the upper side */
PetscErrorCode IPSlackPressure(Tao tao, Vec lambda)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  PetscCall(VecCopy(ip->pair[IP_SLACK].z, lambda));
  if (ip->pair[IP_CEILING].n) PetscCall(VecAXPY(lambda, -1.0, ip->pair[IP_CEILING].z));
  PetscFunctionReturn(0);
}

/*
   Computes the directions of the upper sides from that of the slacks, the pairs' dual directions dz, and from these the
   direction of lambda
*/
PetscErrorCode IPSlackDirection(Tao tao)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  if (ip->pair[IP_CEILING].n) PetscCall(VecAXPBY(ip->pair[IP_CEILING].dt, -1.0, 0.0, ip->pair[IP_SLACK].dt));
  for (PetscInt b = IP_SLACK; b <= IP_CEILING; b++) PetscCall(IPPairDualDirection(&ip->pair[b]));
  PetscCall(VecWAXPY(ip->dir.lambda, 1.0, ip->pair[IP_SLACK].z, ip->pair[IP_SLACK].dz));
  if (ip->pair[IP_CEILING].n) {
    PetscCall(VecAXPY(ip->dir.lambda, -1.0, ip->pair[IP_CEILING].z));
    PetscCall(VecAXPY(ip->dir.lambda, -1.0, ip->pair[IP_CEILING].dz));
  }
  PetscCall(VecAXPY(ip->dir.lambda, -1.0, ip->at.lambda));
  PetscFunctionReturn(0);
}

/*
   Computes the distances t = width - s of the slacks from their upper sides, into t of the pair, or into its trial
   vector if `trial`. Distances that rounding made zero or negative are set to a tiny positive number.
*/
PetscErrorCode IPSlackDistance(Tao tao, Vec s, PetscBool trial)
{
  TAO_IPFILTER      *ip      = (TAO_IPFILTER *)tao->data;
  IPPair            *ceiling = &ip->pair[IP_CEILING];
  const PetscScalar *width, *slack;
  PetscScalar       *t;
  PetscInt           n;

  PetscFunctionBegin;
  if (!ceiling->n) PetscFunctionReturn(0);
  PetscCall(VecGetLocalSize(s, &n));
  PetscCall(VecGetArrayRead(ip->sides->width, &width));
  PetscCall(VecGetArrayRead(s, &slack));
  PetscCall(VecGetArrayWrite(trial ? ceiling->trial : ceiling->t, &t));
  for (PetscInt i = 0; i < n; i++)
    t[i] = PetscRealPart(width[i]) < PETSC_INFINITY
             ? PetscMax(PetscRealPart(width[i] - slack[i]), PETSC_MACHINE_EPSILON * PetscRealPart(width[i]))
             : PETSC_INFINITY;
  PetscCall(VecRestoreArrayWrite(trial ? ceiling->trial : ceiling->t, &t));
  PetscCall(VecRestoreArrayRead(s, &slack));
  PetscCall(VecRestoreArrayRead(ip->sides->width, &width));
  PetscFunctionReturn(0);
}

/* Sets the compliance of the scaled rows, by which their values grow per force */
PetscErrorCode IPSlackSetCompliance(Tao tao)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  PetscCall(VecDestroy(&ip->sides->compliance));
  if (!ip->given->compliance || !ip->mi) PetscFunctionReturn(0);
  PetscCall(VecDuplicate(ip->at.c, &ip->sides->compliance));
  PetscCall(VecQuotient_AMGF(ip->sides->compliance, ip->given->compliance, ip->pair[IP_SLACK].w));
  for (PetscInt k = 0; k < 2 && ip->rows->inequality; k++)
    PetscCall(VecPointwiseMult(ip->sides->compliance, ip->sides->compliance, ip->rows->inequality));
  PetscFunctionReturn(0);
}

/* Computes v = c_I + compliance x force with the force M x multiplier, which is what must not be negative */
PetscErrorCode IPSlackYield(Tao tao, Vec multiplier, Vec v)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  if (ip->sides->compliance) {
    PetscCall(VecPointwiseMult(v, multiplier, ip->pair[IP_SLACK].w));
    PetscCall(VecPointwiseMult(v, v, ip->sides->compliance));
    PetscCall(VecAXPY(v, 1.0, ip->at.c));
  } else PetscCall(VecCopy(ip->at.c, v));
  PetscFunctionReturn(0);
}

/* Computes the violation v = min(c, 0) + max(c - width, 0); NaN where c is NaN. v may be c. */
PetscErrorCode IPSlackViolation(Tao tao, Vec c, Vec v)
{
  TAO_IPFILTER      *ip = (TAO_IPFILTER *)tao->data;
  const PetscScalar *width;
  PetscScalar       *out;
  PetscInt           n;

  PetscFunctionBegin;
  if (c != v) PetscCall(VecCopy(c, v));
  PetscCall(VecGetLocalSize(v, &n));
  PetscCall(VecGetArray(v, &out));
  if (ip->sides->width) PetscCall(VecGetArrayRead(ip->sides->width, &width));
  for (PetscInt i = 0; i < n; i++) {
    PetscReal above = 0.0;

    if (ip->sides->width && PetscRealPart(width[i]) < PETSC_INFINITY)
      above = PetscMax(PetscRealPart(out[i] - width[i]), 0.0);
    out[i] = PetscMin(0.0, PetscRealPart(out[i])) + above; /* in this order PetscMin() returns NaN for a NaN */
  }
  if (ip->sides->width) PetscCall(VecRestoreArrayRead(ip->sides->width, &width));
  PetscCall(VecRestoreArray(v, &out));
  PetscFunctionReturn(0);
}

/*
   Returns the solution s of rho (s - q) = mu/s - mu/(width - s) between 0 and width, by bisection. The left minus the
   right side rises monotonically from -infinity to infinity.
*/
static PetscReal CentralBetween(PetscReal q, PetscReal rho, PetscReal mu, PetscReal width)
{
  const PetscInt halvings = 100;
  PetscReal      low = 0.0, high = width;

  for (PetscInt k = 0; k < halvings; k++) {
    const PetscReal s = 0.5 * (low + high);

    if (rho * (s - q) - mu / s + mu / (width - s) > 0.0) high = s;
    else low = s;
  }
  return PetscMin(PetscMax(0.5 * (low + high), PETSC_MACHINE_EPSILON * width), (1.0 - PETSC_MACHINE_EPSILON) * width);
}

/*
   Computes the point of the central path for the rows' stiffness, see IPCentralPair(), also for slacks with two sides
*/
PetscErrorCode IPSlackCentral(Tao tao, Vec q, PetscReal mu, Vec s, Vec z)
{
  TAO_IPFILTER      *ip = (TAO_IPFILTER *)tao->data;
  const PetscScalar *qa, *rho, *width;
  PetscScalar       *sa, *za;
  PetscInt           n;

  PetscFunctionBegin;
  PetscCall(IPCentralPair(q, ip->stiff->rho, mu, s, z));
  if (!ip->sides->width) PetscFunctionReturn(0);
  PetscCall(VecGetLocalSize(s, &n));
  PetscCall(VecGetArrayRead(q, &qa));
  PetscCall(VecGetArrayRead(ip->stiff->rho, &rho));
  PetscCall(VecGetArrayRead(ip->sides->width, &width));
  PetscCall(VecGetArray(s, &sa));
  PetscCall(VecGetArray(z, &za));
  for (PetscInt i = 0; i < n; i++) {
    if (PetscRealPart(width[i]) >= PETSC_INFINITY) continue;
    sa[i] = CentralBetween(PetscRealPart(qa[i]), PetscRealPart(rho[i]), mu, PetscRealPart(width[i]));
    za[i] = mu / sa[i];
  }
  PetscCall(VecRestoreArray(z, &za));
  PetscCall(VecRestoreArray(s, &sa));
  PetscCall(VecRestoreArrayRead(ip->sides->width, &width));
  PetscCall(VecRestoreArrayRead(ip->stiff->rho, &rho));
  PetscCall(VecRestoreArrayRead(q, &qa));
  PetscFunctionReturn(0);
}

/* Moves slacks that are closer to their upper side than `fraction` times the width, or beyond it, to that distance */
PetscErrorCode IPSlackKeepInside(Tao tao, Vec s, PetscReal fraction)
{
  TAO_IPFILTER      *ip = (TAO_IPFILTER *)tao->data;
  const PetscScalar *width;
  PetscScalar       *sa;
  PetscInt           n;

  PetscFunctionBegin;
  if (!ip->sides->width) PetscFunctionReturn(0);
  PetscCall(VecGetLocalSize(s, &n));
  PetscCall(VecGetArrayRead(ip->sides->width, &width));
  PetscCall(VecGetArray(s, &sa));
  for (PetscInt i = 0; i < n; i++)
    if (PetscRealPart(width[i]) < PETSC_INFINITY)
      sa[i] = PetscMin(PetscRealPart(sa[i]), (1.0 - fraction) * PetscRealPart(width[i]));
  PetscCall(VecRestoreArray(s, &sa));
  PetscCall(VecRestoreArrayRead(ip->sides->width, &width));
  PetscFunctionReturn(0);
}

/* Moves the multipliers of the upper sides to the central path of mu for the present slacks, and computes lambda */
PetscErrorCode IPSlackCenterUpper(Tao tao, PetscReal mu)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  PetscCall(IPSlackDistance(tao, ip->at.s, PETSC_FALSE));
  PetscCall(IPPairCenter(&ip->pair[IP_CEILING], mu));
  PetscCall(IPSlackPressure(tao, ip->at.lambda));
  PetscFunctionReturn(0);
}
