/* Detects an objective that is unbounded below */
#include "driverimpl.h"
#include "tao_ipfilter/solver/constants.h"
#include "tao_ipfilter/solver/kkt.h"
#include "tao_ipfilter/solver/record.h"
#include "tao_ipfilter/solver/sizes.h"
#include "tao_ipfilter/solver/stiffness.h"

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

/*
   Finds whether the iterate shows an unbounded objective: the objective has fallen far, the unknowns have grown by the
   same factor, and the constraints are satisfied relative to their first values and to their own terms
*/
PetscErrorCode IPTestUnbounded(Tao tao, PetscBool *unbounded)
{
  TAO_IPFILTER   *ip   = (TAO_IPFILTER *)tao->data;
  const PetscReal fall = UnboundedFall(ip), first = ip->first->x, small = 1e-3, trace = 1e-6;
  PetscReal       own, size;

  PetscFunctionBegin;
  *unbounded = (PetscBool)(fall > 0.0 && ip->at.f < ip->first->f - fall && ip->kkt->violation <= small);
  if (!*unbounded) PetscFunctionReturn(0);
  PetscCall(IPOwnViolation(tao, &own));
  PetscCall(VecNorm(tao->solution, NORM_INFINITY, &size));
  *unbounded = (PetscBool)(own <= trace && size > IP_UNBOUNDED_FACTOR * (first > 0.0 ? first : 1.0));
  PetscFunctionReturn(0);
}

/* Ends the solve because the objective is unbounded. The last iterate is kept, which shows it; the best iterate would
   not. */
PetscErrorCode IPSetUnbounded(Tao tao)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  PetscCall(IPSetReason(tao, TAO_DIVERGED_USER, "the objective seems unbounded below: it fell from %g to %g",
    (double)ip->first->f, (double)ip->at.f));
  ip->rec->best_error = PETSC_INFINITY;
  PetscFunctionReturn(0);
}
