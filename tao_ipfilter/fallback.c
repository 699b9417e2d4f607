/*
   What is left where the Krylov method does not solve the condensed system, in this order: rebuild an AMG that was kept from an older
   matrix; filter, where the constraints were left to the AMG; filter the neighbours of the constraints' unknowns, too; the whole
   matrix by MUMPS, if that fits into memory. None of this shifts the Hessian: a solver that fails is not negative curvature.
*/
#include "ipfilterimpl.h"

/* The PC, if it is a PCAMGF, else NULL */
static PetscErrorCode GetAMGF(Tao tao, PC *pc)
{
  PetscBool amgf;

  PetscFunctionBegin;
  PetscCall(KSPGetPC(tao->ksp, pc));
  PetscCall(PetscObjectTypeCompare((PetscObject)*pc, PCAMGF, &amgf));
  if (!amgf) *pc = NULL;
  PetscFunctionReturn(0);
}

static PetscErrorCode RebuildAMG(Tao tao, PetscBool *done)
{
  PC       pc;
  PetscInt age = 0;

  PetscFunctionBegin;
  PetscCall(GetAMGF(tao, &pc));
  if (pc) PetscCall(PCAMGFGetAMGAge(pc, &age));
  *done = (PetscBool)(age > 0);
  if (!*done) PetscFunctionReturn(0);
  PetscCall(PCReset(pc));
  ((TAO_IPFILTER *)tao->data)->fallbacks.amg_rebuilds++;
  PetscFunctionReturn(0);
}

static PetscErrorCode SwitchFilterOn(Tao tao, PetscBool *done)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  PC            pc;

  PetscFunctionBegin;
  PetscCall(GetAMGF(tao, &pc));
  *done = (PetscBool)(pc && ip->mi && !ip->filtered);
  if (!*done) PetscFunctionReturn(0);
  PetscCall(PCAMGFSetFilterActive(pc, PETSC_TRUE));
  ip->filter_forced = ip->filtered = PETSC_TRUE;
  ip->nfiltered++;
  ip->fallbacks.filters++;
  PetscFunctionReturn(0);
}

/* Takes the neighbours into the subspace of this matrix, as long as that stays a small part of it */
static PetscErrorCode EnlargeFilter(Tao tao, PetscBool *done)
{
  TAO_IPFILTER   *ip   = (TAO_IPFILTER *)tao->data;
  const PetscReal part = 0.25;
  PetscInt        before, after, n;
  PC              pc;
  IS              wide;

  PetscFunctionBegin;
  PetscCall(GetAMGF(tao, &pc));
  *done = PETSC_FALSE;
  if (!pc || !ip->mi || !ip->filtered) PetscFunctionReturn(0);
  PetscCall(IPSubspaceGrow(tao, &wide));
  PetscCall(ISGetSize(ip->cond.filter, &before));
  PetscCall(ISGetSize(wide, &after));
  PetscCall(VecGetSize(tao->solution, &n));
  *done = (PetscBool)(after > before && after <= part * n);
  if (*done) {
    PetscCall(PetscObjectCompose((PetscObject)ip->cond.A, PCAMGF_FILTER_KEY, (PetscObject)wide));
    /* the switch makes it look for its subspace */
    PetscCall(PCAMGFSetFilterActive(pc, PETSC_FALSE));
    PetscCall(PCAMGFSetFilterActive(pc, PETSC_TRUE));
    ip->fallbacks.filters++;
  }
  PetscCall(ISDestroy(&wide));
  PetscFunctionReturn(0);
}

/* Whether the Krylov method is not even tried: by the user's choice, or since its last solves all had to be done by MUMPS */
PetscBool IPFallbackHolds(const TAO_IPFILTER *ip)
{
  const PetscInt most = 2;

  return (PetscBool)(ip->direct_always || ip->ndirect >= most);
}

/* Whether the Krylov method failed as it does on indefinite matrices, where nothing tells for certain. A limit of few iterations is
   the caller's choice and tells nothing. */
static PetscBool LooksIndefinite(const TAO_IPFILTER *ip)
{
  switch (ip->ksp_reason) {
  case KSP_DIVERGED_ITS:
    return (PetscBool)(ip->linear_limit >= IP_MANY_ITERATIONS);
  case KSP_DIVERGED_INDEFINITE_PC:
  case KSP_DIVERGED_BREAKDOWN:
  case KSP_DIVERGED_DTOL:
  case KSP_DIVERGED_NANORINF:
    return PETSC_TRUE;
  default:
    return PETSC_FALSE;
  }
}

/* Where nothing helped, a direction that reduces the residual tenfold is still one for an inexact Newton method */
static PetscBool Coarse(const TAO_IPFILTER *ip)
{
  return (PetscBool)(!IPUndefined(ip->linear_residual) && ip->linear_residual <= PetscMax(10.0 * ip->linear_target, ip->forcing_max * ip->linear_rhs));
}

PetscErrorCode IPLinearNotANumber(Tao tao)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  PetscCall(PetscStrncpy(ip->linear_reason, "the Hessian, a Jacobian or a gradient has an entry that is not a number", sizeof(ip->linear_reason)));
  ip->fallbacks.failures++;
  ip->linear_failed = PETSC_TRUE;
  ip->ksp_reason    = KSP_DIVERGED_NANORINF;
  PetscFunctionReturn(0);
}

/* Solves A d = b otherwise than by the Krylov method that has failed; d is its result */
PetscErrorCode IPFallback(Tao tao, Vec b, Vec d, IPLinearVerdict *verdict)
{
  PetscErrorCode (*const stages[])(Tao, PetscBool *) = {RebuildAMG, SwitchFilterOn, EnlargeFilter};
  TAO_IPFILTER *ip   = (TAO_IPFILTER *)tao->data;
  PetscBool     held = IPFallbackHolds(ip);
  PetscReal     norm;

  PetscFunctionBegin;
  PetscCall(MatNorm(ip->cond.A, NORM_FROBENIUS, &norm));
  if (PetscIsInfOrNanReal(norm) || IPUndefined(ip->linear_rhs)) {
    PetscCall(IPLinearNotANumber(tao));
    PetscFunctionReturn(0);
  }
  for (size_t k = 0; k < PETSC_STATIC_ARRAY_LENGTH(stages) && *verdict == IP_LINEAR_FAILED && !held; k++) {
    PetscBool done;

    PetscCall((*stages[k])(tao, &done));
    if (done) PetscCall(IPKrylovSolve(tao, b, d, verdict));
  }
  if (*verdict != IP_LINEAR_FAILED) PetscFunctionReturn(0);
  PetscCall(IPDirectSolve(tao, b, d, verdict));
  if (*verdict == IP_LINEAR_SOLVED) {
    ip->fallbacks.direct += !ip->direct_always;
    ip->ndirect++;
  } else if (*verdict == IP_LINEAR_FAILED) {
    ip->ndirect = 0;
    if (LooksIndefinite(ip)) *verdict = IP_LINEAR_INDEFINITE;
  }
  if (*verdict != IP_LINEAR_FAILED) PetscFunctionReturn(0);
  if (Coarse(ip)) *verdict = IP_LINEAR_SOLVED;
  else ip->fallbacks.failures++;
  PetscFunctionReturn(0);
}
