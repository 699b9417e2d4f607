/*
   Solves the condensed system by the Krylov method and, if that fails, by one fallback after another. No fallback adds
   a shift to the Hessian, since the failure of a solver does not show negative curvature.
*/
#include "linearimpl.h"
#include "tao_ipfilter/solver/condensed.h"
#include "tao_ipfilter/solver/factors.h"
#include "tao_ipfilter/solver/constants.h"
#include "tao_ipfilter/solver/linear.h"
#include "tao_ipfilter/solver/matrices.h"
#include "tao_ipfilter/solver/options.h"
#include "tao_ipfilter/solver/record.h"

/* Gets the PC of the KSP if it is a PCAMGF; NULL otherwise */
static PetscErrorCode GetAMGF(Tao tao, PC *pc)
{
  PetscBool amgf;

  PetscFunctionBegin;
  PetscCall(KSPGetPC(tao->ksp, pc));
  PetscCall(PetscObjectTypeCompare((PetscObject)*pc, PCAMGF, &amgf));
  if (!amgf) *pc = NULL;
  PetscFunctionReturn(0);
}

/* Fallback: makes PCAMGF rebuild an AMG that belongs to an older matrix. *done: true if there is such an AMG. */
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
  ((TAO_IPFILTER *)tao->data)->rec->fallbacks.amg_rebuilds++;
  PetscFunctionReturn(0);
}

/* Fallback: switches the filter on if the AMG was used alone. *done: whether the filter was switched on. */
static PetscErrorCode SwitchFilterOn(Tao tao, PetscBool *done)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  PC            pc;

  PetscFunctionBegin;
  PetscCall(GetAMGF(tao, &pc));
  *done = (PetscBool)(pc && ip->cond->constrained && !ip->lin->filtered);
  if (!*done) PetscFunctionReturn(0);
  PetscCall(PCAMGFSetFilterActive(pc, PETSC_TRUE));
  ip->lin->filter_forced = ip->lin->filtered = PETSC_TRUE;
  ip->rec->nfiltered++;
  ip->rec->fallbacks.filters++;
  PetscFunctionReturn(0);
}

/*
   Fallback: adds the neighbours of the filtered unknowns to the filter of this matrix, unless the filter would exceed a
   quarter of all unknowns. *done: whether the filter has grown.
*/
static PetscErrorCode EnlargeFilter(Tao tao, PetscBool *done)
{
  TAO_IPFILTER   *ip       = (TAO_IPFILTER *)tao->data;
  const PetscReal fraction = 0.25;
  PetscInt        before, after, n;
  PC              pc;
  IS              wide;

  PetscFunctionBegin;
  PetscCall(GetAMGF(tao, &pc));
  *done = PETSC_FALSE;
  if (!pc || !ip->cond->constrained || !ip->lin->filtered) PetscFunctionReturn(0);
  PetscCall(IPConstrainedGrow(tao, ip->cond->A, ip->cond->constrained, &wide));
  PetscCall(ISGetSize(ip->cond->constrained, &before));
  PetscCall(ISGetSize(wide, &after));
  PetscCall(VecGetSize(tao->solution, &n));
  *done = (PetscBool)(after > before && after <= fraction * n);
  if (*done) {
    PetscCall(PetscObjectCompose((PetscObject)ip->cond->A, PCAMGF_FILTER_KEY, (PetscObject)wide));
    /* makes PCAMGF look up its subspace again */
    PetscCall(PCAMGFSetFilterActive(pc, PETSC_FALSE));
    PetscCall(PCAMGFSetFilterActive(pc, PETSC_TRUE));
    ip->rec->fallbacks.filters++;
  }
  PetscCall(ISDestroy(&wide));
  PetscFunctionReturn(0);
}

/*
   Returns whether the way in which the Krylov method failed suggests, without proof, an indefinite matrix. An iteration
   limit that the caller has set low suggests nothing.
*/
static PetscBool LooksIndefinite(const TAO_IPFILTER *ip)
{
  switch (ip->lin->reason) {
  case KSP_DIVERGED_ITS: return (PetscBool)(ip->lin->limit >= IP_MANY_ITERATIONS);
  case KSP_DIVERGED_INDEFINITE_PC:
  case KSP_DIVERGED_BREAKDOWN:
  case KSP_DIVERGED_DTOL:
  case KSP_DIVERGED_NANORINF: return PETSC_TRUE;
  default: return PETSC_FALSE;
  }
}

/*
   Returns whether the direction reduces the residual tenfold, which is sufficient for an inexact Newton method if all
   fallbacks failed
*/
static PetscBool Coarse(const TAO_IPFILTER *ip)
{
  return (PetscBool)(!IPUndefined(ip->lin->norm) &&
                     ip->lin->norm <= PetscMax(10.0 * ip->lin->target, IP_FORCING_MAX * ip->lin->rhs));
}

/*
   Attempts in the order in which they are made. `prepare` changes the solver and tells whether that was possible; NULL:
   nothing is changed. `solve` then solves the system.
*/
static const struct {
  PetscErrorCode (*prepare)(Tao, PetscBool *);
  PetscErrorCode (*solve)(Tao, Vec, Vec, IPLinearVerdict *);
} attempts[] = {
  {NULL, IPKrylovSolve},
  {RebuildAMG, IPKrylovSolve},
  {SwitchFilterOn, IPKrylovSolve},
  {EnlargeFilter, IPKrylovSolve},
  {NULL, IPDirectSolve},
};

/* Returns whether only MUMPS is used: the user has chosen this, or in the last solves only MUMPS succeeded */
static PetscBool DirectOnly(const TAO_IPFILTER *ip)
{
  const PetscInt in_vain = 2;

  return (PetscBool)(ip->opt->direct_always || ip->lin->ndirect >= in_vain);
}

/*
   Finds whether the matrix and the right-hand side are free of NaN and infinite entries; otherwise no solver is tried
*/
static PetscErrorCode CheckNumbers(Tao tao, PetscBool *sound)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  PetscReal     norm;

  PetscFunctionBegin;
  if (ip->hess->products) PetscCall(VecNorm(ip->cond->hdiag, NORM_2, &norm));
  else PetscCall(MatNorm(ip->cond->A, NORM_FROBENIUS, &norm));
  *sound = (PetscBool)(!PetscIsInfOrNanReal(norm) && !IPUndefined(ip->lin->rhs));
  if (!*sound) PetscCall(IPResidualNotANumber(tao));
  PetscFunctionReturn(0);
}

/*
   Records the result of MUMPS. If MUMPS failed as well, decides whether the matrix counts as indefinite, or the
   direction is accurate enough.
*/
static PetscErrorCode ConcludeDirect(Tao tao, IPLinearVerdict *verdict)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  if (*verdict == IP_LINEAR_SOLVED) {
    ip->rec->fallbacks.direct += !ip->opt->direct_always;
    ip->lin->ndirect++;
  } else if (*verdict == IP_LINEAR_FAILED) {
    ip->lin->ndirect = 0;
    if (LooksIndefinite(ip)) *verdict = IP_LINEAR_INDEFINITE;
    else if (Coarse(ip)) *verdict = IP_LINEAR_SOLVED;
    else ip->rec->fallbacks.failures++;
  }
  PetscFunctionReturn(0);
}

/*
   Solves a small system by MUMPS, unless the user has chosen another solver: Newton's method is then exact, and its
   factors have the inertia of A. Larger systems are left alone, since factors of the whole matrix may cost too much.
   *verdict is not changed if MUMPS fails or finds the matrix singular.
*/
static PetscErrorCode SolveSmall(Tao tao, Vec b, Vec d, IPLinearVerdict *verdict)
{
  TAO_IPFILTER   *ip     = (TAO_IPFILTER *)tao->data;
  IPLinearVerdict direct = IP_LINEAR_FAILED;
  PetscBool       sound  = PETSC_TRUE, cg;
  PetscInt        n;
  PC              pc;

  PetscFunctionBegin;
  PetscCall(VecGetSize(d, &n));
  PetscCall(GetAMGF(tao, &pc));
  PetscCall(PetscObjectTypeCompare((PetscObject)tao->ksp, KSPCG, &cg));
  if (n > IP_SMALL || !cg || !pc || ip->opt->forcing == IP_FORCING_FIXED || DirectOnly(ip)) PetscFunctionReturn(0);
  PetscCall(CheckNumbers(tao, &sound));
  if (sound) PetscCall(IPDirectSolve(tao, b, d, &direct));
  ip->lin->why[0] = '\0';
  if (direct == IP_LINEAR_SOLVED || (direct == IP_LINEAR_INDEFINITE && ip->direct->F)) *verdict = direct;
  PetscFunctionReturn(0);
}

/*
   Makes the attempts one by one until *verdict is not IP_LINEAR_FAILED. Small systems are solved directly.
*/
static PetscErrorCode MakeAttempts(Tao tao, Vec b, Vec d, IPLinearVerdict *verdict)
{
  TAO_IPFILTER *ip    = (TAO_IPFILTER *)tao->data;
  const size_t  n     = PETSC_STATIC_ARRAY_LENGTH(attempts);
  const size_t  first = DirectOnly(ip) ? n - 1 : 0;
  PetscBool     sound = PETSC_TRUE, possible;

  PetscFunctionBegin;
  PetscCall(SolveSmall(tao, b, d, verdict));
  for (size_t k = first; k < n && *verdict == IP_LINEAR_FAILED; k++) {
    if (k == PetscMax(first, 1)) PetscCall(CheckNumbers(tao, &sound));
    if (!sound) PetscFunctionReturn(0);
    possible = PETSC_TRUE;
    if (attempts[k].prepare) PetscCall((*attempts[k].prepare)(tao, &possible));
    if (possible) PetscCall((*attempts[k].solve)(tao, b, d, verdict));
    if (k == n - 1) PetscCall(ConcludeDirect(tao, verdict));
  }
  PetscFunctionReturn(0);
}

/*
   Solves A d = b with the initial guess d to ||b - A d|| <= target. With fixed forcing the KSP's own tolerances and
   initial guess are used. *usable: false if the matrix is not positive definite, or if no solver gave a usable
   direction. In the second case ip->lin->failed is true, and a shift of the Hessian would not help.
*/
PetscErrorCode IPLinearSolve(Tao tao, Vec b, Vec d, PetscReal target, PetscBool *usable)
{
  TAO_IPFILTER   *ip      = (TAO_IPFILTER *)tao->data;
  IPLinearVerdict verdict = IP_LINEAR_FAILED;

  PetscFunctionBegin;
  PetscCall(PetscLogEventBegin(TAO_IPFilterSolve, tao, b, d, NULL));
  PetscCall(VecNorm(b, NORM_2, &ip->lin->rhs));
  ip->lin->target = target;
  ip->lin->why[0] = '\0';
  PetscCall(MakeAttempts(tao, b, d, &verdict));
  *usable         = (PetscBool)(verdict == IP_LINEAR_SOLVED);
  ip->lin->failed = (PetscBool)(verdict == IP_LINEAR_FAILED);
  if (*usable) ip->rec->fallbacks.backward_error = PetscMax(ip->rec->fallbacks.backward_error, ip->lin->backward_error);
  PetscCall(PetscLogEventEnd(TAO_IPFilterSolve, tao, b, d, NULL));
  PetscFunctionReturn(0);
}
