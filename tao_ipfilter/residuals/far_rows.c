/*
   Finds constraints that are out of reach: no expected change of the unknowns makes them zero. Examples are rows with
   values of 1e8 or 1e10 that users write in place of a missing constraint. Norms of c_I omit them, because any other
   violation would be negligible relative to such values. The expected change of the unknowns also limits the first mu
   (iteration/start.c).
*/
#include "residualsimpl.h"
#include "tao_ipfilter/solver/matrices.h"
#include "tao_ipfilter/solver/sizes.h"
#include "tao_ipfilter/solver/stiffness.h"

#define IP_FAR  1e3  /* a constraint is out of reach if its value exceeds its expected change by this factor */
#define IP_SOFT 1e-8 /* curvatures below this fraction of the largest count as zero */

/*
   Computes the expected change of each unknown: |x_j| plus its own Newton step |g_j| / |H_jj|. Unknowns with negligible
   curvature get |x_j|.
*/
static PetscErrorCode ReachUnknowns(Tao tao, Vec distance)
{
  Vec                hdiag = ((TAO_IPFILTER *)tao->data)->stiff->hdiag;
  const PetscScalar *g, *h;
  PetscScalar       *w;
  PetscReal          hmax;
  PetscInt           n;

  PetscFunctionBegin;
  PetscCall(VecMax(hdiag, NULL, &hmax));
  PetscCall(VecCopy(tao->solution, distance));
  PetscCall(VecAbs(distance));
  PetscCall(VecGetLocalSize(distance, &n));
  PetscCall(VecGetArrayRead(tao->gradient, &g));
  PetscCall(VecGetArrayRead(hdiag, &h));
  PetscCall(VecGetArray(distance, &w));
  for (PetscInt j = 0; j < n; j++)
    if (PetscRealPart(h[j]) > IP_SOFT * hmax) w[j] += PetscAbsScalar(g[j]) / PetscRealPart(h[j]);
  PetscCall(VecRestoreArray(distance, &w));
  PetscCall(VecRestoreArrayRead(hdiag, &h));
  PetscCall(VecRestoreArrayRead(tao->gradient, &g));
  PetscFunctionReturn(0);
}

/*
   Computes the distance to the most violated constraint, and to the nearest of the satisfied constraints (0 if there is
   none). A distance is measured in the unit of the unknowns: the value of the constraint divided by the largest row sum
   of |J|.
*/
static PetscErrorCode ReachViolated(Tao tao, PetscReal *violated, PetscReal *nearest)
{
  TAO_IPFILTER      *ip = (TAO_IPFILTER *)tao->data;
  const PetscScalar *c;
  PetscReal          distance[2] = {0.0, PETSC_NINFINITY}; /* the largest distance; minus the smallest */
  PetscInt           n;

  PetscFunctionBegin;
  *violated = *nearest = 0.0;
  if (ip->first->equality_jacobian > 0.0) *violated = ip->first->equality / ip->first->equality_jacobian;
  if (!(ip->first->jacobian > 0.0)) PetscFunctionReturn(0);
  PetscCall(VecGetLocalSize(ip->at.c, &n));
  PetscCall(VecGetArrayRead(ip->at.c, &c));
  for (PetscInt i = 0; i < n; i++) {
    distance[0] = PetscMax(distance[0], -PetscRealPart(c[i]) / ip->first->jacobian);
    if (PetscRealPart(c[i]) > 0.0) distance[1] = PetscMax(distance[1], -PetscRealPart(c[i]) / ip->first->jacobian);
  }
  PetscCall(VecRestoreArrayRead(ip->at.c, &c));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, distance, 2, MPIU_REAL, MPIU_MAX, PetscObjectComm((PetscObject)tao)));
  *violated = PetscMax(*violated, distance[0]);
  if (distance[1] > PETSC_NINFINITY) *nearest = -distance[1];
  PetscFunctionReturn(0);
}

/*
   Computes the expected change of each constraint from that of its own unknowns. If its own unknowns are not expected
   to change, those of all unknowns are used. The result is at least the violation.
*/
static PetscErrorCode ReachRows(Tao tao, Vec distance)
{
  TAO_IPFILTER      *ip = (TAO_IPFILTER *)tao->data;
  const PetscScalar *c;
  PetscScalar       *r;
  PetscInt           n;

  PetscFunctionBegin;
  PetscCall(VecDuplicate(ip->at.c, &ip->stiff->reach));
  PetscCall(IPOwnTerms(ip->jac->inequality, distance, ip->stiff->reach, NULL));
  PetscCall(VecGetLocalSize(ip->at.c, &n));
  PetscCall(VecGetArrayRead(ip->at.c, &c));
  PetscCall(VecGetArray(ip->stiff->reach, &r));
  for (PetscInt i = 0; i < n; i++) {
    if (r[i] == 0.0) r[i] = ip->first->jacobian * ip->first->reach;
    r[i] = PetscMax(PetscRealPart(r[i]), -PetscRealPart(c[i]));
  }
  PetscCall(VecRestoreArray(ip->stiff->reach, &r));
  PetscCall(VecRestoreArrayRead(ip->at.c, &c));
  PetscFunctionReturn(0);
}

/* Computes at the starting point the expected change of unknowns and constraints, and the size of c_I */
PetscErrorCode IPMeasureReach(Tao tao)
{
  TAO_IPFILTER *ip    = (TAO_IPFILTER *)tao->data;
  IPFirst      *first = ip->first;
  PetscReal     largest, violated, nearest;
  Vec           distance;

  PetscFunctionBegin;
  PetscCall(VecDestroy(&ip->stiff->reach));
  PetscCall(IPGetWork(tao, IP_UNKNOWNS, &distance));
  PetscCall(ReachUnknowns(tao, distance));
  PetscCall(VecNorm(distance, NORM_INFINITY, &largest));
  PetscCall(ReachViolated(tao, &violated, &nearest));
  first->reach = PetscMax(largest, violated);
  if (first->reach == 0.0) first->reach = nearest;
  if (first->jacobian > 0.0 && first->reach > 0.0 && first->reach < PETSC_INFINITY) PetscCall(ReachRows(tao, distance));
  PetscCall(IPRestoreWork(tao, IP_UNKNOWNS, &distance));
  if (!ip->stiff->reach) PetscFunctionReturn(0);
  PetscCall(VecNorm(ip->at.c, NORM_INFINITY, &largest));
  PetscCall(IPSizeWithinReach(tao, ip->at.c, &first->length));
  if (first->length == 0.0 && largest > 0.0) first->length = first->jacobian * first->reach;
  PetscFunctionReturn(0);
}

/* Returns the largest expected change of an unknown, including the safety factor IP_FAR; infinite if unknown */
PetscReal IPReachOfUnknowns(const TAO_IPFILTER *ip)
{
  return ip->first->reach > 0.0 ? IP_FAR * ip->first->reach : PETSC_INFINITY;
}

/* Copies v (layout of c_I) to `near`, with zeros for the rows out of reach. The reach grows with x. */
PetscErrorCode IPValuesWithinReach(Tao tao, Vec v, Vec near)
{
  TAO_IPFILTER      *ip      = (TAO_IPFILTER *)tao->data;
  const PetscReal    runaway = 100.0;
  PetscReal          xsize, far;
  const PetscScalar *r;
  PetscScalar       *a;
  PetscInt           n;

  PetscFunctionBegin;
  PetscCall(VecCopy(v, near));
  if (!ip->stiff->reach) PetscFunctionReturn(0);
  PetscCall(VecNorm(tao->solution, NORM_INFINITY, &xsize));
  far = IP_FAR * PetscClipInterval(xsize / ip->first->reach, 1.0, runaway);
  PetscCall(VecGetLocalSize(near, &n));
  PetscCall(VecGetArrayRead(ip->stiff->reach, &r));
  PetscCall(VecGetArray(near, &a));
  for (PetscInt i = 0; i < n; i++)
    if (PetscAbsScalar(a[i]) > far * PetscRealPart(r[i])) a[i] = 0.0;
  PetscCall(VecRestoreArray(near, &a));
  PetscCall(VecRestoreArrayRead(ip->stiff->reach, &r));
  PetscFunctionReturn(0);
}

/* Computes the largest absolute entry of v within reach */
PetscErrorCode IPSizeWithinReach(Tao tao, Vec v, PetscReal *size)
{
  Vec near;

  PetscFunctionBegin;
  PetscCall(IPGetWork(tao, IP_INEQUALITIES, &near));
  PetscCall(IPValuesWithinReach(tao, v, near));
  PetscCall(VecNorm(near, NORM_INFINITY, size));
  PetscCall(IPRestoreWork(tao, IP_INEQUALITIES, &near));
  PetscFunctionReturn(0);
}
