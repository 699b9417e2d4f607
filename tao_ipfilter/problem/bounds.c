/* Treats the variable bounds x_l <= x <= x_u as complementarity pairs */
#include "problemimpl.h"
#include "tao_ipfilter/solver/constants.h"
#include "tao_ipfilter/solver/options.h"
#include "tao_ipfilter/solver/relaxation.h"

/*
   Returns whether an entry of a bound forms a pair: it is finite and the variable is not fixed. other: the opposite
   bound, or NULL.
*/
static inline PetscBool Bounds(PetscScalar bound, const PetscScalar *other)
{
  return (PetscBool)(IPBoundIsFinite(PetscRealPart(bound)) && !(other && IPIsFixed(bound, *other)));
}

/*
   Returns the distance x - b (sign 1) or b - x (sign -1) plus the bound's relaxation. If rounding makes this zero or
   negative, a tiny positive number is returned.
*/
static inline PetscReal Distance(PetscReal x, PetscReal b, PetscReal sign, PetscReal relax)
{
  return PetscMax(sign * (x - b) + relax,
    PetscMax(PETSC_MACHINE_EPSILON * PetscAbsReal(b), PetscSqrtReal(PETSC_MIN_REAL)));
}

/* Computes the distances t = x - x_l (sign +1) or t = x_u - x (sign -1); PETSC_INFINITY where the bound is absent */
static PetscErrorCode BoundDistance(Vec x, Vec bound, Vec other, PetscReal sign, PetscReal relax, Vec t)
{
  const PetscScalar *xa, *ba, *oa = NULL;
  PetscScalar       *ta;
  PetscInt           n;

  PetscFunctionBegin;
  PetscCall(VecGetLocalSize(x, &n));
  PetscCall(VecGetArrayRead(x, &xa));
  PetscCall(VecGetArrayRead(bound, &ba));
  if (other) PetscCall(VecGetArrayRead(other, &oa));
  PetscCall(VecGetArrayWrite(t, &ta));
  for (PetscInt i = 0; i < n; i++)
    ta[i] = Bounds(ba[i], oa ? &oa[i] : NULL) ? Distance(PetscRealPart(xa[i]), PetscRealPart(ba[i]), sign, relax)
                                              : PETSC_INFINITY;
  PetscCall(VecRestoreArrayWrite(t, &ta));
  if (other) PetscCall(VecRestoreArrayRead(other, &oa));
  PetscCall(VecRestoreArrayRead(bound, &ba));
  PetscCall(VecRestoreArrayRead(x, &xa));
  PetscFunctionReturn(0);
}

/* Computes the distances of x from its bounds, into t of the pairs, or into their trial vectors if `trial` */
PetscErrorCode IPBoundsDistance(Tao tao, Vec x, PetscBool trial)
{
  TAO_IPFILTER *ip    = (TAO_IPFILTER *)tao->data;
  IPPair       *lower = &ip->pair[IP_LOWER], *upper = &ip->pair[IP_UPPER];
  PetscReal     relax = ip->relax->unknowns;

  PetscFunctionBegin;
  if (lower->n) PetscCall(BoundDistance(x, tao->XL, tao->XU, lower->sign, relax, trial ? lower->trial : lower->t));
  if (upper->n) PetscCall(BoundDistance(x, tao->XU, tao->XL, upper->sign, relax, trial ? upper->trial : upper->t));
  PetscFunctionReturn(0);
}

/* Counts the entries of a bound vector that form pairs, on all ranks */
static PetscErrorCode BoundCount(Vec bound, Vec other, PetscInt *count)
{
  const PetscScalar *b, *o    = NULL;
  PetscInt           n, local = 0;

  PetscFunctionBegin;
  PetscCall(VecGetLocalSize(bound, &n));
  PetscCall(VecGetArrayRead(bound, &b));
  if (other) PetscCall(VecGetArrayRead(other, &o));
  for (PetscInt i = 0; i < n; i++) local += Bounds(b[i], o ? &o[i] : NULL);
  if (other) PetscCall(VecRestoreArrayRead(other, &o));
  PetscCall(VecRestoreArrayRead(bound, &b));
  PetscCallMPI(MPI_Allreduce(&local, count, 1, MPIU_INT, MPI_SUM, PetscObjectComm((PetscObject)bound)));
  PetscFunctionReturn(0);
}

/*
   Sets up the pairs of the finite bounds. The weight of a bound is the mean of M_s, so that m t z has the same unit in
   all pairs, that of mu.
*/
PetscErrorCode IPBoundsSetUp(Tao tao)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  PetscReal     w  = ip->mi ? ip->pair[IP_SLACK].weight / ip->mi : 1.0;

  PetscFunctionBegin;
  for (PetscInt b = IP_LOWER; b <= IP_UPPER; b++) {
    IPPair  *p     = &ip->pair[b];
    Vec      bound = b == IP_LOWER ? tao->XL : tao->XU;
    PetscInt count = 0;

    if (bound) PetscCall(BoundCount(bound, b == IP_LOWER ? tao->XU : tao->XL, &count));
    if (count && !p->t) PetscCall(IPPairCreate(tao->solution, NULL, b == IP_LOWER ? 1.0 : -1.0, p));
    if (!count) PetscCall(IPPairDestroy(p));
    p->n      = count;
    p->weight = w * count;
    if (count) PetscCall(VecSet(p->w, w));
  }
  PetscFunctionReturn(0);
}

/* Returns max(|x|, |bound|). If this is zero, returns `all`, the size of all unknowns; if that is zero too, 1. */
static PetscReal BoundSize(PetscReal x, PetscReal bound, PetscReal all)
{
  const PetscReal size = PetscMax(PetscAbsReal(bound), PetscAbsReal(x));

  return size > 0.0 ? size : (all > 0.0 ? all : 1.0);
}

/*
   Moves x into the interior of its bounds (Waechter and Biegler 2006, section 3.6) and computes the distances.
   The margin is a fraction of the size of the bound or the unknown, see BoundSize(). It is also limited to a fraction
   of the distance between the two bounds, so that a distant bound does not push x away from a near one.
*/
PetscErrorCode IPBoundsPush(Tao tao)
{
  TAO_IPFILTER      *ip   = (TAO_IPFILTER *)tao->data;
  const PetscReal    push = IP_BOUND_PUSH;
  Vec                v[2] = {tao->XL, tao->XU};
  const PetscScalar *b[2] = {NULL, NULL};
  PetscScalar       *x;
  PetscReal          size;
  PetscInt           n;

  PetscFunctionBegin;
  if (!ip->pair[IP_LOWER].n && !ip->pair[IP_UPPER].n) PetscFunctionReturn(0);
  PetscCall(VecNorm(tao->solution, NORM_INFINITY, &size));
  PetscCall(VecGetLocalSize(tao->solution, &n));
  for (PetscInt k = 0; k < 2; k++)
    if (v[k]) PetscCall(VecGetArrayRead(v[k], &b[k]));
  PetscCall(VecGetArray(tao->solution, &x));
  for (PetscInt i = 0; i < n; i++) {
    const PetscReal l    = b[0] ? PetscRealPart(b[0][i]) : PETSC_NINFINITY,
                    u    = b[1] ? PetscRealPart(b[1][i]) : PETSC_INFINITY;
    const PetscBool hasl = IPBoundIsFinite(l), hasu = IPBoundIsFinite(u);
    const PetscReal distance = hasl && hasu ? u - l : PETSC_INFINITY;

    if ((!hasl && !hasu) || IPIsFixed(l, u)) continue;
    if (hasl)
      x[i] = PetscMax(PetscRealPart(x[i]), l + push * PetscMin(distance, BoundSize(PetscRealPart(x[i]), l, size)));
    if (hasu)
      x[i] = PetscMin(PetscRealPart(x[i]), u - push * PetscMin(distance, BoundSize(PetscRealPart(x[i]), u, size)));
  }
  PetscCall(VecRestoreArray(tao->solution, &x));
  for (PetscInt k = 0; k < 2; k++)
    if (v[k]) PetscCall(VecRestoreArrayRead(v[k], &b[k]));
  PetscCall(IPBoundsDistance(tao, tao->solution, PETSC_FALSE));
  PetscFunctionReturn(0);
}

/* Moves x back onto those original bounds that it has passed because they were relaxed */
PetscErrorCode IPBoundsReturn(Tao tao)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  if (ip->pair[IP_LOWER].n) PetscCall(VecPointwiseMax(tao->solution, tao->solution, tao->XL));
  if (ip->pair[IP_UPPER].n) PetscCall(VecPointwiseMin(tao->solution, tao->solution, tao->XU));
  PetscFunctionReturn(0);
}

/* Computes the directions of the distances: dt = dx for lower bounds, dt = -dx for upper bounds */
PetscErrorCode IPBoundsDirection(Tao tao)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  for (PetscInt b = IP_LOWER; b <= IP_UPPER; b++) {
    IPPair *p = &ip->pair[b];

    if (p->n) PetscCall(VecAXPBY(p->dt, p->sign, 0.0, ip->dir.x));
  }
  PetscFunctionReturn(0);
}

/* Adds the forces w target / t of the bounds to v. They point into the interior of the bounds. */
PetscErrorCode IPBoundsAddForces(Tao tao, Vec v)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  Vec           force;

  PetscFunctionBegin;
  PetscCall(IPGetWork(tao, IP_UNKNOWNS, &force));
  for (PetscInt b = IP_LOWER; b <= IP_UPPER; b++) {
    IPPair *p = &ip->pair[b];

    if (!p->n) continue;
    PetscCall(IPPairGetForce(p, force));
    PetscCall(VecAXPY(v, p->sign, force));
  }
  PetscCall(IPRestoreWork(tao, IP_UNKNOWNS, &force));
  PetscFunctionReturn(0);
}

/* Sets the multipliers of the bounds to z = mu / t, the central path for the present mu */
PetscErrorCode IPBoundsCenter(Tao tao)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  for (PetscInt b = IP_LOWER; b <= IP_UPPER; b++) PetscCall(IPPairCenter(&ip->pair[b], ip->mu));
  PetscFunctionReturn(0);
}

/*
   Computes the multipliers of the bounds in TAO's sign convention: the gradient of f + DE^T c_E - DI^T c_I is DL + DU.
   Multipliers of upper bounds are therefore negative.
*/
PetscErrorCode IPBoundsMultipliers(Tao tao, Vec DL, Vec DU)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  for (PetscInt b = IP_LOWER; b <= IP_UPPER; b++) {
    const IPPair *p = &ip->pair[b];
    Vec           D = b == IP_LOWER ? DL : DU;

    if (p->n) {
      PetscCall(VecPointwiseMult(D, p->w, p->z));
      PetscCall(VecScale(D, p->sign));
    } else PetscCall(VecSet(D, 0.0));
  }
  PetscFunctionReturn(0);
}
