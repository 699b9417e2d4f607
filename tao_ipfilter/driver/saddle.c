/*
   Leaves stationary points that are not minima. Needed where the linear solver does not notice negative curvature by
   itself.
*/
#include "driverimpl.h"
#include "tao_ipfilter/solver/barrier.h"
#include "tao_ipfilter/solver/linear.h"
#include "tao_ipfilter/solver/matrices.h"
#include "tao_ipfilter/solver/method.h"
#include "tao_ipfilter/solver/options.h"
#include "tao_ipfilter/solver/record.h"
#include "tao_ipfilter/solver/relaxation.h"
#include "tao_ipfilter/solver/terms.h"

/*
   Finds whether the matrix may be indefinite although no solve has reported it. This is possible in five cases:
   - A factorization that the user has chosen solves with any matrix.
   - After a relaxation of constraints the inertia of factors is not tested.
   - The inertia of the filter's factors is tested only here, until a direction of negative curvature has been found.
   - With equality constraints each step tests the inertia, and shifts an indefinite Hessian. At a stationary point the
     shifted step is zero.
   - A Krylov method does not see a direction of negative curvature that is orthogonal to all gradients, by symmetry for
     example. This is tested in small problems, where the test costs little, unless the unknowns have weights M_u: those
     of a body that springs hardly hold have motions that are almost neutral, along which steps would be very long.
*/
static PetscErrorCode SaddleUnknown(Tao tao, PetscBool *unknown)
{
  TAO_IPFILTER  *ip  = (TAO_IPFILTER *)tao->data;
  const PetscInt few = 500;
  PetscInt       n;

  PetscFunctionBegin;
  *unknown = PETSC_FALSE;
  if (ip->hess->products) PetscFunctionReturn(0);
  if (ip->me) {
    *unknown = (PetscBool)(!tao->niter || ip->shift->delta > 0.0);
    PetscFunctionReturn(0);
  }
  PetscCall(PetscObjectTypeCompare((PetscObject)tao->ksp, KSPPREONLY, unknown));
  PetscCall(VecGetSize(tao->solution, &n));
  *unknown =
    (PetscBool)(*unknown || ip->relax->times || (n <= few && !ip->given->primal_mass && !ip->method->constant));
  if (!*unknown && ip->lin->filtered && !ip->bar->curved) PetscCall(IPKrylovIndefinite(tao, unknown));
  PetscFunctionReturn(0);
}

/*
   Tries to leave a point at which the solve is about to end. The ways are a direction of negative curvature, and longer
   steps beyond a point of inflection. The second one is not used for quadratic programs, nor for relaxed constraints,
   which are too curved. *left: whether a better point was found.
*/
PetscErrorCode IPLeaveSaddle(Tao tao, PetscBool *left)
{
  TAO_IPFILTER  *ip   = (TAO_IPFILTER *)tao->data;
  const PetscInt most = 5;
  PetscBool      unknown, found = PETSC_FALSE;

  PetscFunctionBegin;
  *left = PETSC_FALSE;
  if (ip->method->on || ip->terms->n || ip->rec->nsaddles >= most) PetscFunctionReturn(0);
  if (!ip->method->constant && !ip->relax->times) PetscCall(IPLeaveInflection(tao, left));
  if (!*left) {
    PetscCall(SaddleUnknown(tao, &unknown));
    if (unknown) PetscCall(IPNegativeCurvature(tao, &found));
    if (found) PetscCall(IPLeaveStationary(tao, left));
  }
  if (!*left) PetscFunctionReturn(0);
  PetscCall(PetscInfo(tao, "The point is stationary, but not a minimum\n"));
  ip->rec->nsaddles++;
  ip->rec->best_error = ip->rec->best_violation = PETSC_INFINITY;
  PetscFunctionReturn(0);
}
