/*
   Judges linear solves by the true residual of the condensed system instead of a Krylov method's estimate. If the
   residual is too large, iterative refinement continues the solve.
*/
#include "linearimpl.h"
#include "tao_ipfilter/solver/condensed.h"
#include "tao_ipfilter/solver/constants.h"
#include "tao_ipfilter/solver/linear.h"
#include "tao_ipfilter/solver/options.h"
#include "tao_ipfilter/solver/record.h"

#define IP_MAX_REFINEMENTS 3
#define IP_EXACT           (10.0 * PETSC_MACHINE_EPSILON) /* refinement stops below this backward error */
#define IP_ROUNDING        (50.0 * PETSC_MACHINE_EPSILON) /* backward error that rounding may cause in any solver */

/*
   Computes r = b - A d, its norm, and the backward error. The backward error is the norm of r relative to the norm of
   its terms, where |A| |d| is replaced by diag(A) |d| since A is positive definite.
*/
PetscErrorCode IPResidualMeasure(Tao tao, Vec b, Vec d)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  PetscReal     size;
  Vec           terms;

  PetscFunctionBegin;
  PetscCall(MatMult(ip->cond->A, d, ip->lin->residual));
  PetscCall(VecAYPX(ip->lin->residual, -1.0, b));
  PetscCall(VecNorm(ip->lin->residual, NORM_2, &ip->lin->norm));
  PetscCall(IPGetWork(tao, IP_UNKNOWNS, &terms));
  PetscCall(MatGetDiagonal(ip->cond->A, terms));
  PetscCall(VecPointwiseMult(terms, terms, d));
  PetscCall(VecNorm(terms, NORM_2, &size));
  PetscCall(IPRestoreWork(tao, IP_UNKNOWNS, &terms));
  size += ip->lin->rhs;
  ip->lin->backward_error = size > 0.0 ? ip->lin->norm / size : 0.0;
  PetscFunctionReturn(0);
}

/*
   Returns whether the residual meets the target, or is as small as rounding allows. With fixed forcing the KSP's own
   criterion decides, unless the residual is not even reduced tenfold.
*/
PetscBool IPResidualReached(const TAO_IPFILTER *ip, KSPConvergedReason reason)
{
  if (IPUndefined(ip->lin->norm)) return PETSC_FALSE;
  if (ip->lin->backward_error <= IP_ROUNDING) return PETSC_TRUE;
  if (ip->opt->forcing == IP_FORCING_FIXED)
    return (PetscBool)(reason > 0 && ip->lin->norm <= IP_FORCING_MAX * ip->lin->rhs);
  return (PetscBool)(ip->lin->norm <= 2.0 * ip->lin->target);
}

/*
   Returns whether the target was missed. With adaptive forcing, in contrast to IPResidualReached(), a residual that
   rounding keeps above the target counts as missed.
*/
static PetscBool ResidualMissed(const TAO_IPFILTER *ip, KSPConvergedReason reason)
{
  return ip->opt->forcing == IP_FORCING_FIXED ? !IPResidualReached(ip, reason)
                                              : (PetscBool)(ip->lin->norm > 2.0 * ip->lin->target);
}

/*
   Returns whether refinement may help: the last solve ended because its estimate of the residual was small, or a
   product p^T A p got the wrong sign by rounding near the end
*/
static PetscBool ResidualRefinable(const TAO_IPFILTER *ip, KSPConvergedReason reason)
{
  if (IPUndefined(ip->lin->norm)) return PETSC_FALSE;
  if (reason == KSP_DIVERGED_INDEFINITE_MAT || reason == KSP_DIVERGED_INDEFINITE_PC || reason == KSP_DIVERGED_BREAKDOWN)
    return (PetscBool)(ip->lin->norm <= IP_CLOSE * ip->lin->rhs);
  return (PetscBool)(reason > 0);
}

/*
   Refines d iteratively, d += A^-1 (b - A d) with the given solver, as long as that halves the residual and the target
   is missed. exact: refine down to rounding whatever the target is; reason: how the solver ended.
*/
PetscErrorCode IPResidualRefine(Tao tao, Vec b, Vec d, PetscBool exact, PetscErrorCode (*solve)(Tao, Vec, Vec),
  KSPConvergedReason reason)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  Vec           correction;

  PetscFunctionBegin;
  for (PetscInt k = 0; k < IP_MAX_REFINEMENTS; k++) {
    const PetscReal before = ip->lin->norm;

    if (!ResidualRefinable(ip, reason) || ip->lin->backward_error <= (exact ? IP_EXACT : IP_ROUNDING) ||
        (!exact && !ResidualMissed(ip, reason)))
      break;
    PetscCall(IPGetWork(tao, IP_UNKNOWNS, &correction));
    PetscCall((*solve)(tao, ip->lin->residual, correction));
    PetscCall(VecAXPY(d, 1.0, correction));
    PetscCall(IPResidualMeasure(tao, b, d));
    ip->rec->fallbacks.refinements++;
    PetscCall(PetscInfo(tao, "Iterative refinement reduced ||b - A d|| from %g to %g, allowed %g\n", (double)before,
      (double)ip->lin->norm, (double)ip->lin->target));
    if (!(ip->lin->norm <= before)) {
      PetscCall(VecAXPY(d, -1.0, correction));
      PetscCall(IPResidualMeasure(tao, b, d));
    }
    PetscCall(IPRestoreWork(tao, IP_UNKNOWNS, &correction));
    if (!(ip->lin->norm <= 0.5 * before)) break;
  }
  PetscFunctionReturn(0);
}

/* Records a failure that was caused by NaN in the matrix or the right-hand side, not by a solver */
PetscErrorCode IPResidualNotANumber(Tao tao)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  PetscCall(PetscStrncpy(ip->lin->why, "the Hessian, a Jacobian or a gradient has an entry that is not a number",
    sizeof(ip->lin->why)));
  ip->rec->fallbacks.failures++;
  ip->lin->failed = PETSC_TRUE;
  ip->lin->reason = KSP_DIVERGED_NANORINF;
  PetscFunctionReturn(0);
}
