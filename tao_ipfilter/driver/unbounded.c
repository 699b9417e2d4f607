/* Detects an objective that is unbounded below */
#include "driverimpl.h"
#include "tao_ipfilter/solver/barrier.h"
#include "tao_ipfilter/solver/constants.h"
#include "tao_ipfilter/solver/kkt.h"
#include "tao_ipfilter/solver/matrices.h"
#include "tao_ipfilter/solver/record.h"
#include "tao_ipfilter/solver/search.h"
#include "tao_ipfilter/solver/sizes.h"
#include "tao_ipfilter/solver/stiffness.h"
#include "tao_ipfilter/solver/terms.h"

/*
   Returns the decrease of the objective that counts as unbounded. It is a multiple of the objective's first value, or
   of the gain of a Newton step at the start. A linear objective has no such step. If all unknowns are zero at the start
   as well, nothing tells their unit, and 1 is taken for it.
*/
static PetscReal UnboundedFall(const TAO_IPFILTER *ip)
{
  const PetscReal x = ip->stiff->flat && ip->first->x == 0.0 ? 1.0 : ip->first->x;

  return IP_UNBOUNDED_FACTOR * PetscMax(PetscMax(PetscAbsReal(ip->first->f), ip->first->gradient * x),
                                 PetscSqr(ip->first->gradient) / ip->stiff->hscale);
}

/* Finds whether every unknown has two bounds or is fixed, in which case the objective is bounded */
static PetscErrorCode UnboundedHasAllBounds(Tao tao, PetscBool *bounded)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  PetscInt      n, nfixed = 0;

  PetscFunctionBegin;
  PetscCall(VecGetSize(tao->solution, &n));
  if (ip->fixed) {
    PetscInt local;

    PetscCall(ISGetLocalSize(ip->fixed, &local));
    PetscCallMPI(MPI_Allreduce(&local, &nfixed, 1, MPIU_INT, MPI_SUM, PetscObjectComm((PetscObject)tao)));
  }
  *bounded = (PetscBool)(PetscMin(ip->pair[IP_LOWER].n, ip->pair[IP_UPPER].n) + nfixed >= n);
  PetscFunctionReturn(0);
}

/*
   Finds whether the iterate shows an unbounded objective: the objective has fallen far, the point is not nearly
   stationary, and the constraints are satisfied relative to their first values and to their own terms
*/
static PetscErrorCode UnboundedAtIterate(Tao tao, PetscBool *unbounded)
{
  TAO_IPFILTER   *ip   = (TAO_IPFILTER *)tao->data;
  const PetscReal fall = UnboundedFall(ip), small = 1e-3, trace = 1e-6, stationary = 0.1;
  PetscReal       own;

  PetscFunctionBegin;
  *unbounded = (PetscBool)(fall > 0.0 && ip->at.f < ip->first->f - fall && ip->kkt->violation <= small);
  if (!*unbounded) PetscFunctionReturn(0);
  PetscCall(IPOwnViolation(tao, &own));
  *unbounded = (PetscBool)(own <= trace && IPBothErrors(ip) > stationary);
  PetscFunctionReturn(0);
}

#define IP_UNBOUNDED_ROUNDING 1e-9 /* violation that counts as rounding, relative to the terms of a step */

/*
   Finds whether no row is violated by more than rounding beside its own terms, those of J along the step `times` d. The
   terms of other rows, or of the start, may be much larger.
*/
static PetscErrorCode UnboundedRows(Tao tao, IPSpace space, Mat J, Vec d, PetscReal times, Vec violation,
  PetscBool *admitted)
{
  PetscReal most;
  Vec       allowed;

  PetscFunctionBegin;
  PetscCall(IPGetWork(tao, space, &allowed));
  PetscCall(IPOwnTerms(J, d, allowed, NULL));
  PetscCall(VecAbs(violation));
  PetscCall(VecAXPY(violation, -IP_UNBOUNDED_ROUNDING * times, allowed));
  PetscCall(VecMax(violation, NULL, &most));
  PetscCall(IPRestoreWork(tao, space, &allowed));
  if (!(most <= 0.0)) *admitted = PETSC_FALSE;
  PetscFunctionReturn(0);
}

/* Finds whether the trial point, at the end of the step `times` d, satisfies bounds and constraints up to rounding */
static PetscErrorCode UnboundedAdmits(Tao tao, Vec d, PetscReal times, PetscBool *admitted)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  PetscReal     least, norm;
  Vec           violation;

  PetscFunctionBegin;
  *admitted = PETSC_TRUE;
  PetscCall(VecNorm(d, NORM_INFINITY, &norm));
  PetscCall(IPBoundsDistance(tao, ip->trial.x, PETSC_TRUE));
  for (PetscInt b = IP_LOWER; b <= IP_UPPER; b++) {
    if (!ip->pair[b].n) continue;
    PetscCall(VecMin(ip->pair[b].trial, NULL, &least));
    if (!(least >= -IP_UNBOUNDED_ROUNDING * times * norm)) *admitted = PETSC_FALSE;
  }
  PetscCall(IPEvaluateConstraints(tao, ip->trial.x, ip->trial.c, ip->trial.ce));
  if (ip->mi) {
    PetscCall(IPGetWork(tao, IP_INEQUALITIES, &violation));
    PetscCall(IPSlackViolation(tao, ip->trial.c, violation));
    PetscCall(UnboundedRows(tao, IP_INEQUALITIES, ip->jac->inequality, d, times, violation, admitted));
    PetscCall(IPRestoreWork(tao, IP_INEQUALITIES, &violation));
  }
  if (ip->me) PetscCall(UnboundedRows(tao, IP_EQUALITIES, ip->jac->equality, d, times, ip->trial.ce, admitted));
  PetscFunctionReturn(0);
}

/*
   Finds whether the objective falls by UnboundedFall() from the iterate along a multiple of the direction d, at the end
   of which bounds and constraints are satisfied. slope: derivative of the objective along d. *f: objective at that
   point.
*/
static PetscErrorCode UnboundedAlong(Tao tao, Vec d, PetscReal slope, PetscReal *f, PetscBool *unbounded)
{
  TAO_IPFILTER   *ip    = (TAO_IPFILTER *)tao->data;
  const PetscReal fall  = UnboundedFall(ip);
  PetscReal       times = 2.0 * fall / -slope;

  PetscFunctionBegin;
  PetscCall(VecWAXPY(ip->trial.x, times, d, tao->solution));
  PetscCall(TaoComputeObjective(tao, ip->trial.x, f));
  *unbounded = (PetscBool)(!IPUndefined(*f) && *f < ip->at.f - fall);
  if (*unbounded) PetscCall(UnboundedAdmits(tao, d, times, unbounded));
  PetscFunctionReturn(0);
}

/* Ends the solve because the objective is unbounded. The last iterate is kept: it, or the last step from it, shows that
   the objective is unbounded; the best iterate would not show it. lowest: lowest value found */
PetscErrorCode IPSetUnbounded(Tao tao, PetscReal lowest)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  PetscCall(IPSetReason(tao, TAO_DIVERGED_USER, "the objective seems unbounded below: it fell from %g to %g",
    (double)ip->first->f, (double)lowest));
  ip->rec->best_error = PETSC_INFINITY;
  PetscFunctionReturn(0);
}

/*
   Finds whether the objective is unbounded along the last direction, or along the ray from the origin through the
   iterate. *f: lowest value found.
*/
PetscErrorCode IPTestUnboundedRays(Tao tao, PetscReal *f, PetscBool *unbounded)
{
  TAO_IPFILTER *ip   = (TAO_IPFILTER *)tao->data;
  const Vec     d[2] = {ip->dir.x, tao->solution};
  PetscBool     bounded;

  PetscFunctionBegin;
  *unbounded = PETSC_FALSE;
  PetscCall(UnboundedHasAllBounds(tao, &bounded));
  if (bounded || ip->terms->n || !(UnboundedFall(ip) > 0.0)) PetscFunctionReturn(0);
  for (PetscInt k = 0; k < 2 && !*unbounded; ++k) {
    PetscScalar slope;

    PetscCall(VecDot(tao->gradient, d[k], &slope));
    if (PetscRealPart(slope) < 0.0) PetscCall(UnboundedAlong(tao, d[k], PetscRealPart(slope), f, unbounded));
  }
  PetscFunctionReturn(0);
}

/* Finds whether the objective has fallen far, and the unknowns have grown by the same factor, or a ray shows that it
   falls further */
PetscErrorCode IPTestUnbounded(Tao tao, PetscReal *f, PetscBool *unbounded)
{
  const PetscReal first = ((TAO_IPFILTER *)tao->data)->first->x;
  PetscReal       size;

  PetscFunctionBegin;
  *f = ((TAO_IPFILTER *)tao->data)->at.f;
  PetscCall(UnboundedAtIterate(tao, unbounded));
  if (!*unbounded) PetscFunctionReturn(0);
  PetscCall(VecNorm(tao->solution, NORM_INFINITY, &size));
  *unbounded = (PetscBool)(size > IP_UNBOUNDED_FACTOR * (first > 0.0 ? first : 1.0));
  if (!*unbounded) PetscCall(IPTestUnboundedRays(tao, f, unbounded));
  PetscFunctionReturn(0);
}
