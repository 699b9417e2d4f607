/*
   Solves Newton systems with equality constraints that involve few unknowns, without factoring the whole matrix. The
   weights W are much larger than the stiffness that resists the constraints; PCAMGF can precondition the condensed
   matrix A + J_E^T W J_E. The method of multipliers
     (A + J_E^T W J_E) dx = b - J_E^T (y + W c_E),   y <- y + W (J_E dx + c_E)
   converges to the solution of the augmented system. Each update reduces J_E dx + c_E by the ratio of the two
   stiffnesses. The residual of the forces is that of the condensed system. An update changes the right-hand side only
   in unknowns that PCAMGF solves for exactly, and therefore costs few iterations.
*/
#include "linearimpl.h"
#include "tao_ipfilter/solver/condensed.h"
#include "tao_ipfilter/solver/factors.h"
#include "tao_ipfilter/solver/matrices.h"

/* Computes rhs = b - J_E^T (y + W c_E). y may be NULL for zero. */
static PetscErrorCode ProximalRHS(Tao tao, Vec b, Vec ce, Vec y, Vec rhs)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  Vec           force;

  PetscFunctionBegin;
  PetscCall(IPGetWork(tao, IP_EQUALITIES, &force));
  PetscCall(VecPointwiseMult(force, ip->cond->rows.below, ce));
  if (y) PetscCall(VecAXPY(force, 1.0, y));
  PetscCall(VecScale(force, -1.0));
  PetscCall(MatMultTransposeAdd(ip->jac->equality, force, b, rhs));
  PetscCall(IPRestoreWork(tao, IP_EQUALITIES, &force));
  PetscCall(IPFixedZero(tao, rhs));
  PetscFunctionReturn(0);
}

/*
   Improves dx by (A + J_E^T W J_E)^-1 times the residual, unless the residual already is within twice the target; then
   *done is true. The residual is reduced to a tenth of the target, so that it does not exceed the target after the next
   update of the multipliers.
*/
static PetscErrorCode ProximalCorrect(Tao tao, Vec rhs, Vec dx, PetscReal target, PetscBool *usable, PetscBool *done)
{
  TAO_IPFILTER   *ip    = (TAO_IPFILTER *)tao->data;
  const PetscReal tenth = 0.1;
  PetscReal       left;
  Vec             residual, correction;

  PetscFunctionBegin;
  PetscCall(IPGetWork(tao, IP_UNKNOWNS, &residual));
  PetscCall(IPGetWork(tao, IP_UNKNOWNS, &correction));
  PetscCall(MatMult(ip->cond->A, dx, residual));
  PetscCall(VecAYPX(residual, -1.0, rhs));
  PetscCall(VecNorm(residual, NORM_2, &left));
  *done = (PetscBool)(left <= 2.0 * target);
  if (!*done) {
    PetscCall(VecSet(correction, 0.0));
    PetscCall(IPLinearSolve(tao, residual, correction, tenth * target, usable));
    if (*usable) PetscCall(VecAXPY(dx, 1.0, correction));
    ip->prox->nupdates++;
  }
  PetscCall(IPRestoreWork(tao, IP_UNKNOWNS, &correction));
  PetscCall(IPRestoreWork(tao, IP_UNKNOWNS, &residual));
  PetscFunctionReturn(0);
}

/* Updates the multipliers, y += W (J_E dx + c_E). *left: largest absolute entry of J_E dx + c_E. */
static PetscErrorCode ProximalUpdate(Tao tao, Vec ce, Vec dx, Vec y, PetscReal *left)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  Vec           r;

  PetscFunctionBegin;
  PetscCall(IPGetWork(tao, IP_EQUALITIES, &r));
  PetscCall(MatMultAdd(ip->jac->equality, dx, ce, r));
  PetscCall(VecNorm(r, NORM_INFINITY, left));
  PetscCall(VecPointwiseMult(r, r, ip->cond->rows.below));
  PetscCall(VecAXPY(y, 1.0, r));
  PetscCall(IPRestoreWork(tao, IP_EQUALITIES, &r));
  PetscFunctionReturn(0);
}

/*
   Computes the size of J_E dx + c_E that need not be reduced further: it is negligible compared with its terms, or is
   rounding of c_E
*/
static PetscErrorCode ProximalLimit(Tao tao, Vec dx, PetscReal *limit)
{
  TAO_IPFILTER   *ip     = (TAO_IPFILTER *)tao->data;
  const PetscReal little = 1e-12;
  PetscReal       step, size, row;

  PetscFunctionBegin;
  PetscCall(VecNorm(dx, NORM_INFINITY, &step));
  PetscCall(VecNorm(tao->solution, NORM_INFINITY, &size));
  PetscCall(MatNorm(ip->jac->equality, NORM_INFINITY, &row));
  *limit = row * PetscMax(little * step, 4.0 * PETSC_MACHINE_EPSILON * (size + step));
  PetscFunctionReturn(0);
}

/*
   Solves for dx and for the direction dir.y of the multipliers; both hold an initial guess. *exact: false if J_E dx +
   c_E remains too large.
*/
PetscErrorCode IPProximalSolve(Tao tao, Vec b, Vec ce, Vec dx, PetscReal target, PetscBool *usable, PetscBool *exact)
{
  TAO_IPFILTER   *ip    = (TAO_IPFILTER *)tao->data;
  const PetscInt  most  = 20;
  const PetscReal close = 1e3; /* multiple of the limit up to which J_E dx + c_E is attributed to rounding */
  PetscReal       left = PETSC_INFINITY, limit = 0.0;
  Vec             rhs, y;

  PetscFunctionBegin;
  PetscCall(IPGetWork(tao, IP_UNKNOWNS, &rhs));
  PetscCall(IPGetWork(tao, IP_EQUALITIES, &y));
  PetscCall(VecWAXPY(y, 1.0, ip->at.y, ip->dir.y));
  *exact = PETSC_FALSE;
  for (PetscInt k = 0; k < most && !*exact; k++) {
    const PetscReal before = left;

    PetscCall(ProximalRHS(tao, b, ce, y, rhs));
    if (k) PetscCall(ProximalCorrect(tao, rhs, dx, target, usable, exact));
    else PetscCall(IPLinearSolve(tao, rhs, dx, target, usable));
    if (!*usable || *exact) break;
    PetscCall(ProximalUpdate(tao, ce, dx, y, &left));
    PetscCall(ProximalLimit(tao, dx, &limit));
    *exact = (PetscBool)(left <= limit);
    if (!*exact && !(left <= 0.5 * before)) break;
  }
  if (*usable && left <= close * limit) *exact = PETSC_TRUE;
  PetscCall(PetscInfo(tao,
    "Proximal updates leave a residual of %g in the linearized equality constraints; below %g it need not be reduced\n",
    (double)left, (double)limit));
  PetscCall(VecWAXPY(ip->dir.y, -1.0, ip->at.y, y));
  PetscCall(IPRestoreWork(tao, IP_EQUALITIES, &y));
  PetscCall(IPRestoreWork(tao, IP_UNKNOWNS, &rhs));
  PetscFunctionReturn(0);
}

/*
   Solves for dx of a restoration step: one linear solve with the weights of the violation, without updates of the
   multipliers
*/
PetscErrorCode IPProximalRestore(Tao tao, Vec b, Vec ce, Vec dx, PetscBool *usable)
{
  const PetscReal accuracy = 1e-3;
  PetscReal       norm;
  Vec             rhs;

  PetscFunctionBegin;
  PetscCall(IPGetWork(tao, IP_UNKNOWNS, &rhs));
  PetscCall(ProximalRHS(tao, b, ce, NULL, rhs));
  PetscCall(VecNorm(rhs, NORM_2, &norm));
  PetscCall(IPLinearSolve(tao, rhs, dx, accuracy * norm, usable));
  PetscCall(IPRestoreWork(tao, IP_UNKNOWNS, &rhs));
  PetscFunctionReturn(0);
}
