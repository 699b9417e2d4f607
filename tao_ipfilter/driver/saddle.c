/* Stationary points that are no minima: where the linear solver does not meet negative curvature by itself. */
#include "driverimpl.h"
#include "tao_ipfilter/solver/matrices.h"
#include "tao_ipfilter/solver/method.h"
#include "tao_ipfilter/solver/record.h"
#include "tao_ipfilter/solver/relaxation.h"
#include "tao_ipfilter/solver/terms.h"

/* Whether nothing has told so far that the matrix is positive definite: a factorization of the caller's choice solves
   with any matrix, and where constraints were relaxed no factorization was asked for its inertia */
static PetscErrorCode SaddleUnknown(Tao tao, PetscBool *unknown)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  *unknown = PETSC_FALSE;
  if (ip->me || ip->hess->products) PetscFunctionReturn(0);
  PetscCall(PetscObjectTypeCompare((PetscObject)tao->ksp, KSPPREONLY, unknown));
  *unknown = (PetscBool)(*unknown || ip->relax->times);
  PetscFunctionReturn(0);
}

/* At a point that is about to end the solve: whether it is left, along a direction of negative curvature, or beyond a
   point of inflection. Relaxed constraints are so curved that the search beyond the point does not apply to them. */
PetscErrorCode IPLeaveSaddle(Tao tao, PetscBool *left)
{
  TAO_IPFILTER  *ip   = (TAO_IPFILTER *)tao->data;
  const PetscInt most = 5;
  PetscBool      unknown, found = PETSC_FALSE;

  PetscFunctionBegin;
  *left = PETSC_FALSE;
  if (ip->method->on || ip->terms->n || ip->rec->nsaddles >= most) PetscFunctionReturn(0);
  if (!ip->method->constant && !ip->relax->times) PetscCall(IPLineSearchBeyond(tao, left));
  if (!*left) {
    PetscCall(SaddleUnknown(tao, &unknown));
    if (unknown) PetscCall(IPNegativeCurvature(tao, &found));
    if (found) PetscCall(IPLineSearchLeave(tao, left));
  }
  if (!*left) PetscFunctionReturn(0);
  PetscCall(PetscInfo(tao, "The point is stationary, but no minimum\n"));
  ip->rec->nsaddles++;
  ip->rec->best_error = ip->rec->best_violation = PETSC_INFINITY;
  PetscFunctionReturn(0);
}
