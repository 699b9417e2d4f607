/*
   Entrywise operations on complementarity pairs (t, z), of which the barrier terms consist. Where a pair is absent, t
   is PETSC_INFINITY.
*/
#include "problemimpl.h"

/* Sets the weights, which are 1 if `weights` is NULL, and their sum */
PetscErrorCode IPPairSetWeights(Vec weights, IPPair *p)
{
  PetscFunctionBegin;
  if (weights) PetscCall(VecCopy(weights, p->w));
  else PetscCall(VecSet(p->w, 1.0));
  PetscCall(VecSum(p->w, &p->weight));
  PetscFunctionReturn(0);
}

PetscErrorCode IPPairCreate(Vec layout, Vec weights, PetscReal sign, IPPair *p)
{
  PetscFunctionBegin;
  p->sign = sign;
  PetscCall(VecDuplicate(layout, &p->t));
  PetscCall(VecDuplicate(layout, &p->z));
  PetscCall(VecDuplicate(layout, &p->dt));
  PetscCall(VecDuplicate(layout, &p->dz));
  PetscCall(VecDuplicate(layout, &p->target));
  PetscCall(VecDuplicate(layout, &p->trial));
  PetscCall(VecDuplicate(layout, &p->w));
  PetscCall(IPPairSetWeights(weights, p));
  PetscCall(VecSet(p->z, 0.0));
  PetscCall(VecSet(p->dt, 0.0));
  PetscCall(VecSet(p->dz, 0.0));
  PetscCall(VecGetSize(layout, &p->n));
  PetscFunctionReturn(0);
}

PetscErrorCode IPPairDestroy(IPPair *p)
{
  PetscFunctionBegin;
  PetscCall(VecDestroy(&p->t));
  PetscCall(VecDestroy(&p->z));
  PetscCall(VecDestroy(&p->dt));
  PetscCall(VecDestroy(&p->dz));
  PetscCall(VecDestroy(&p->target));
  PetscCall(VecDestroy(&p->trial));
  PetscCall(VecDestroy(&p->w));
  p->n = 0;
  PetscFunctionReturn(0);
}

/* Gets read access to the arrays of n vectors, which have the same layout */
static PetscErrorCode PairRead(PetscInt n, const Vec v[], const PetscScalar *a[])
{
  PetscFunctionBegin;
  for (PetscInt k = 0; k < n; k++) PetscCall(VecGetArrayRead(v[k], &a[k]));
  PetscFunctionReturn(0);
}

static PetscErrorCode PairRestore(PetscInt n, const Vec v[], const PetscScalar *a[])
{
  PetscFunctionBegin;
  for (PetscInt k = 0; k < n; k++) PetscCall(VecRestoreArrayRead(v[k], &a[k]));
  PetscFunctionReturn(0);
}

static inline PetscBool Present(PetscScalar t)
{
  return (PetscBool)(PetscRealPart(t) < PETSC_INFINITY);
}

/*
   Computes target = mu - dt dz from the last direction. The second-order term dt dz is limited to +-corrector_max;
   corrector_max = 0 omits it.
*/
PetscErrorCode IPPairSetTarget(IPPair *p, PetscReal mu, PetscReal corrector_max)
{
  const Vec          v[2] = {p->dt, p->dz};
  const PetscScalar *a[2];
  PetscScalar       *target;
  PetscInt           n;

  PetscFunctionBegin;
  if (!p->n) PetscFunctionReturn(0);
  PetscCall(VecGetLocalSize(p->target, &n));
  PetscCall(PairRead(2, v, a));
  PetscCall(VecGetArrayWrite(p->target, &target));
  for (PetscInt i = 0; i < n; i++)
    target[i] =
      mu -
      (corrector_max > 0.0 ? PetscMax(-corrector_max, PetscMin(corrector_max, PetscRealPart(a[0][i] * a[1][i]))) : 0.0);
  PetscCall(VecRestoreArrayWrite(p->target, &target));
  PetscCall(PairRestore(2, v, a));
  PetscFunctionReturn(0);
}

/* Moves z to the central path for the present t: z = mu / t */
PetscErrorCode IPPairCenter(IPPair *p, PetscReal mu)
{
  const PetscScalar *t;
  PetscScalar       *z;
  PetscInt           n;

  PetscFunctionBegin;
  if (!p->n) PetscFunctionReturn(0);
  PetscCall(VecSet(p->target, mu));
  PetscCall(VecGetLocalSize(p->t, &n));
  PetscCall(VecGetArrayRead(p->t, &t));
  PetscCall(VecGetArrayWrite(p->z, &z));
  for (PetscInt i = 0; i < n; i++) z[i] = Present(t[i]) ? mu / t[i] : 0.0;
  PetscCall(VecRestoreArrayWrite(p->z, &z));
  PetscCall(VecRestoreArrayRead(p->t, &t));
  PetscFunctionReturn(0);
}

/* Computes out = w v / t; 0 where the pair is absent */
static PetscErrorCode PairWeighedByDistance(const IPPair *p, Vec v, Vec out)
{
  const Vec          vectors[3] = {p->w, v, p->t};
  const PetscScalar *a[3];
  PetscScalar       *x;
  PetscInt           n;

  PetscFunctionBegin;
  PetscCall(VecGetLocalSize(out, &n));
  PetscCall(PairRead(3, vectors, a));
  PetscCall(VecGetArrayWrite(out, &x));
  for (PetscInt i = 0; i < n; i++) x[i] = Present(a[2][i]) ? a[0][i] * a[1][i] / a[2][i] : 0.0;
  PetscCall(VecRestoreArrayWrite(out, &x));
  PetscCall(PairRestore(3, vectors, a));
  PetscFunctionReturn(0);
}

/* Computes sigma = w z / t; 0 where the pair is absent */
PetscErrorCode IPPairGetSigma(const IPPair *p, Vec sigma)
{
  PetscFunctionBegin;
  PetscCall(PairWeighedByDistance(p, p->z, sigma));
  PetscFunctionReturn(0);
}

/* Computes force = w target / t; 0 where the pair is absent */
PetscErrorCode IPPairGetForce(const IPPair *p, Vec force)
{
  PetscFunctionBegin;
  PetscCall(PairWeighedByDistance(p, p->target, force));
  PetscFunctionReturn(0);
}

/* Computes dz = target/t - z - (z/t) dt; 0 where the pair is absent */
PetscErrorCode IPPairDualDirection(IPPair *p)
{
  const Vec          v[4] = {p->t, p->z, p->dt, p->target};
  const PetscScalar *a[4];
  PetscScalar       *dz;
  PetscInt           n;

  PetscFunctionBegin;
  if (!p->n) PetscFunctionReturn(0);
  PetscCall(VecGetLocalSize(p->t, &n));
  PetscCall(PairRead(4, v, a));
  PetscCall(VecGetArrayWrite(p->dz, &dz));
  for (PetscInt i = 0; i < n; i++) dz[i] = Present(a[0][i]) ? (a[3][i] - a[1][i] * a[2][i]) / a[0][i] - a[1][i] : 0.0;
  PetscCall(VecRestoreArrayWrite(p->dz, &dz));
  PetscCall(PairRestore(4, v, a));
  PetscFunctionReturn(0);
}

/* Reduces *alpha to the largest value with v + alpha dv >= (1 - tau) v, for v > 0, on all ranks */
static PetscErrorCode PairMaxStep(Vec v, Vec dv, PetscReal tau, PetscReal *alpha)
{
  const Vec          vv[2] = {v, dv};
  const PetscScalar *a[2];
  PetscReal          local = *alpha;
  PetscInt           n;

  PetscFunctionBegin;
  PetscCall(VecGetLocalSize(v, &n));
  PetscCall(PairRead(2, vv, a));
  for (PetscInt i = 0; i < n; i++) {
    if (PetscRealPart(a[1][i]) < 0.0 && Present(a[0][i]))
      local = PetscMin(local, -tau * PetscRealPart(a[0][i]) / PetscRealPart(a[1][i]));
  }
  PetscCall(PairRestore(2, vv, a));
  PetscCallMPI(MPI_Allreduce(&local, alpha, 1, MPIU_REAL, MPIU_MIN, PetscObjectComm((PetscObject)v)));
  PetscFunctionReturn(0);
}

/* Computes the sum of w log t over the pairs that are present */
PetscErrorCode IPPairLogSum(const IPPair *p, Vec t, PetscReal *sum)
{
  const Vec          v[2] = {p->w, t};
  const PetscScalar *a[2];
  PetscReal          local = 0.0;
  PetscInt           n;

  PetscFunctionBegin;
  *sum = 0.0;
  if (!p->n) PetscFunctionReturn(0);
  PetscCall(VecGetLocalSize(t, &n));
  PetscCall(PairRead(2, v, a));
  for (PetscInt i = 0; i < n; i++)
    if (Present(a[1][i])) local += PetscRealPart(a[0][i]) * PetscLogReal(PetscRealPart(a[1][i]));
  PetscCall(PairRestore(2, v, a));
  PetscCallMPI(MPI_Allreduce(&local, sum, 1, MPIU_REAL, MPIU_SUM, PetscObjectComm((PetscObject)t)));
  PetscFunctionReturn(0);
}

/* Computes slope = sum w dt / t, the derivative of the sum of logarithms along the direction */
PetscErrorCode IPPairLogSlope(const IPPair *p, PetscReal *slope)
{
  const Vec          v[3] = {p->w, p->dt, p->t};
  const PetscScalar *a[3];
  PetscReal          local = 0.0;
  PetscInt           n;

  PetscFunctionBegin;
  *slope = 0.0;
  if (!p->n) PetscFunctionReturn(0);
  PetscCall(VecGetLocalSize(p->t, &n));
  PetscCall(PairRead(3, v, a));
  for (PetscInt i = 0; i < n; i++)
    if (Present(a[2][i])) local += PetscRealPart(a[0][i] * a[1][i] / a[2][i]);
  PetscCall(PairRestore(3, v, a));
  PetscCallMPI(MPI_Allreduce(&local, slope, 1, MPIU_REAL, MPIU_SUM, PetscObjectComm((PetscObject)p->t)));
  PetscFunctionReturn(0);
}

/* Computes the largest |t z - mu| and the sum of w t z. Either output may be NULL. */
PetscErrorCode IPPairProducts(const IPPair *p, PetscReal mu, PetscReal *deviation, PetscReal *sum)
{
  const Vec          v[3] = {p->w, p->t, p->z};
  const PetscScalar *a[3];
  PetscReal          dev = 0.0, total = 0.0;
  PetscInt           n;
  MPI_Comm           comm;

  PetscFunctionBegin;
  if (deviation) *deviation = 0.0;
  if (sum) *sum = 0.0;
  if (!p->n) PetscFunctionReturn(0);
  PetscCall(VecGetLocalSize(p->t, &n));
  PetscCall(PairRead(3, v, a));
  for (PetscInt i = 0; i < n; i++) {
    if (!Present(a[1][i])) continue;
    const PetscReal tz = PetscRealPart(a[1][i] * a[2][i]);
    dev                = PetscMax(dev, PetscAbsReal(tz - mu));
    total += PetscRealPart(a[0][i]) * tz;
  }
  PetscCall(PairRestore(3, v, a));
  PetscCall(PetscObjectGetComm((PetscObject)p->t, &comm));
  if (deviation) PetscCallMPI(MPI_Allreduce(&dev, deviation, 1, MPIU_REAL, MPIU_MAX, comm));
  if (sum) PetscCallMPI(MPI_Allreduce(&total, sum, 1, MPIU_REAL, MPIU_SUM, comm));
  PetscFunctionReturn(0);
}

/*
   Computes the largest product (t + alpha_t dt)(z + alpha_z dz), and the sum of w times the products. Either output may
   be NULL.
*/
PetscErrorCode IPPairStepProducts(const IPPair *p, PetscReal alpha_t, PetscReal alpha_z, PetscReal *largest,
  PetscReal *sum)
{
  const Vec          v[5] = {p->w, p->t, p->dt, p->z, p->dz};
  const PetscScalar *a[5];
  PetscReal          local = 0.0, total = 0.0;
  PetscInt           n;
  MPI_Comm           comm;

  PetscFunctionBegin;
  if (largest) *largest = 0.0;
  if (sum) *sum = 0.0;
  if (!p->n) PetscFunctionReturn(0);
  PetscCall(VecGetLocalSize(p->t, &n));
  PetscCall(PairRead(5, v, a));
  for (PetscInt i = 0; i < n; i++) {
    if (!Present(a[1][i])) continue;
    const PetscReal tz = PetscRealPart((a[1][i] + alpha_t * a[2][i]) * (a[3][i] + alpha_z * a[4][i]));
    local              = PetscMax(local, tz);
    total += PetscRealPart(a[0][i]) * tz;
  }
  PetscCall(PairRestore(5, v, a));
  PetscCall(PetscObjectGetComm((PetscObject)p->t, &comm));
  if (largest) PetscCallMPI(MPI_Allreduce(&local, largest, 1, MPIU_REAL, MPIU_MAX, comm));
  if (sum) PetscCallMPI(MPI_Allreduce(&total, sum, 1, MPIU_REAL, MPIU_SUM, comm));
  PetscFunctionReturn(0);
}

/* Limits z to the interval [1/kappa, kappa] mu/t (Waechter and Biegler 2006, equation (16)) */
PetscErrorCode IPPairSafeguard(IPPair *p, PetscReal mu, PetscReal kappa)
{
  const PetscScalar *t;
  PetscScalar       *z;
  PetscInt           n;

  PetscFunctionBegin;
  if (!p->n) PetscFunctionReturn(0);
  PetscCall(VecGetLocalSize(p->t, &n));
  PetscCall(VecGetArrayRead(p->t, &t));
  PetscCall(VecGetArray(p->z, &z));
  for (PetscInt i = 0; i < n; i++) {
    if (!Present(t[i])) continue;
    const PetscReal central = mu / PetscRealPart(t[i]);
    z[i]                    = PetscMax(PetscMin(PetscRealPart(z[i]), kappa * central), central / kappa);
  }
  PetscCall(VecRestoreArray(p->z, &z));
  PetscCall(VecRestoreArrayRead(p->t, &t));
  PetscFunctionReturn(0);
}

/* Raises t to at least `least` times min(z / rho, length) */
PetscErrorCode IPPairLift(IPPair *p, Vec rho, PetscReal length, PetscReal least)
{
  const Vec          v[2] = {p->z, rho};
  const PetscScalar *a[2];
  PetscScalar       *t;
  PetscInt           n;

  PetscFunctionBegin;
  PetscCall(VecGetLocalSize(p->t, &n));
  PetscCall(PairRead(2, v, a));
  PetscCall(VecGetArray(p->t, &t));
  for (PetscInt i = 0; i < n; i++)
    t[i] = PetscMax(PetscRealPart(t[i]), least * PetscMin(length, PetscRealPart(a[0][i] / a[1][i])));
  PetscCall(VecRestoreArray(p->t, &t));
  PetscCall(PairRestore(2, v, a));
  PetscFunctionReturn(0);
}

/* Computes the sum of w v^2 with the weights w of the inequality constraints */
PetscErrorCode IPPairWeightedSquare(Tao tao, Vec v, PetscReal *square)
{
  Vec         wv;
  PetscScalar sum;

  PetscFunctionBegin;
  PetscCall(IPGetWork(tao, IP_INEQUALITIES, &wv));
  PetscCall(VecPointwiseMult(wv, v, ((TAO_IPFILTER *)tao->data)->pair[IP_SLACK].w));
  PetscCall(VecDot(v, wv, &sum));
  PetscCall(IPRestoreWork(tao, IP_INEQUALITIES, &wv));
  *square = PetscRealPart(sum);
  PetscFunctionReturn(0);
}

/*
   Reduces the step lengths such that every t and z retains at least the fraction 1 - tau of its value. first: the first
   block of pairs to which this applies; primal, dual: step lengths of t and z; dual may be NULL.
*/
PetscErrorCode IPFractionToBoundary(Tao tao, PetscInt first, PetscReal tau, PetscReal *primal, PetscReal *dual)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  for (PetscInt b = first; b < IP_NPAIRS; b++) {
    IPPair *p = &ip->pair[b];

    if (!p->n) continue;
    PetscCall(PairMaxStep(p->t, p->dt, tau, primal));
    if (dual) PetscCall(PairMaxStep(p->z, p->dz, tau, dual));
  }
  PetscFunctionReturn(0);
}

/*
   Computes the point (s, z) of the central path if a row with value q is resisted by a penalty of stiffness rho: s z =
   mu and s - q = z/rho
*/
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

    /* Compute the root that does not suffer from cancellation, and the other one from their product mu/rho. */
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
