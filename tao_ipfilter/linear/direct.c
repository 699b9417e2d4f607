/*
   Solves with the condensed matrix by MUMPS's factorization L D L^T, if Krylov methods fail. The inertia shows with
   certainty whether the matrix is positive definite. MUMPS's analysis, made once per pattern, estimates the memory
   before the factors are allocated.
*/
#include "linearimpl.h"
#include "tao_ipfilter/solver/condensed.h"
#include "tao_ipfilter/solver/factors.h"
#include "tao_ipfilter/solver/linear.h"
#include "tao_ipfilter/solver/matrices.h"
#include "tao_ipfilter/solver/options.h"
#include "tao_ipfilter/solver/record.h"
#include "pc_amgf/mumps.h"
#include "pc_amgf/sparse_factors.h"

PetscErrorCode IPDirectDestroy(IPDirect *direct)
{
  PetscFunctionBegin;
  PetscCall(MatDestroy(&direct->F));
  PetscCall(MatDestroy(&direct->A));
  direct->system = 0;
  PetscFunctionReturn(0);
}

/*
   Sets direct->A to the matrix A in a format that MUMPS accepts as symmetric (AIJ or SBAIJ); NULL if there is no MUMPS
   for it. If the matrix or its pattern is new, the old factors are destroyed; otherwise their analysis is reused.
*/
static PetscErrorCode DirectTakeMatrix(Mat A, IPDirect *direct)
{
  PetscBool        baij, mumps;
  MatType          type;
  PetscObjectState state;

  PetscFunctionBegin;
  PetscCall(PetscObjectBaseTypeCompareAny((PetscObject)A, &baij, MATSEQBAIJ, MATMPIBAIJ, ""));
  if (!baij || !direct->converted) {
    if (!baij) PetscCall(PetscObjectReference((PetscObject)A));
    PetscCall(MatDestroy(&direct->A));
    direct->A = baij ? NULL : A;
  }
  if (baij) PetscCall(IPMatrixConvert(A, &direct->A));
  direct->converted = baij;
  PetscCall(MatGetType(direct->A, &type));
  PetscCall(AMGFMumpsFactors(type, MAT_FACTOR_CHOLESKY, &mumps));
  if (!mumps) {
    PetscCall(IPDirectDestroy(direct));
    PetscFunctionReturn(0);
  }
  PetscCall(MatSetOption(direct->A, MAT_SYMMETRIC, PETSC_TRUE));
  PetscCall(MatGetNonzeroState(direct->A, &state));
  if (direct->pattern_id != ((PetscObject)direct->A)->id || direct->pattern_state != state)
    PetscCall(MatDestroy(&direct->F));
  direct->pattern_id    = ((PetscObject)direct->A)->id;
  direct->pattern_state = state;
  PetscFunctionReturn(0);
}

/*
   Computes a lower bound of the memory of the factors [1e6 bytes]: half of the matrix. If it exceeds the limit, no
   analysis is made.
*/
static PetscErrorCode DirectLeastMemory(Mat A, PetscReal *memory)
{
  MatInfo info;

  PetscFunctionBegin;
  PetscCall(MatGetInfo(A, MAT_GLOBAL_SUM, &info));
  *memory = 0.5 * info.nz_used * sizeof(PetscScalar) / 1e6;
  PetscFunctionReturn(0);
}

/* Finds whether factors of this size [1e6 bytes] are allowed; if not, ip->lin->why tells the reason */
static PetscErrorCode DirectAllows(TAO_IPFILTER *ip, PetscReal memory, PetscBool *allows)
{
  PetscFunctionBegin;
  *allows = (PetscBool)(memory <= ip->opt->direct_memory);
  if (!*allows)
    PetscCall(PetscSNPrintf(ip->lin->why, sizeof(ip->lin->why),
      "MUMPS would need %g MB for the whole matrix, more than the %g MB allowed", (double)memory,
      (double)ip->opt->direct_memory));
  PetscFunctionReturn(0);
}

/* Factors the matrix; *error: MAT_FACTOR_OUTMEMORY also if the factors may not be so large, see DirectAllows() */
static PetscErrorCode DirectFactorWithin(Tao tao, MatFactorError *error)
{
  static const AMGFSetting settings[] = {
    {"mat_mumps_icntl_6", "0"}, /* the ordering must not depend on values, which change */
    {"mat_mumps_icntl_8", "1"}, /* scale by the diagonal of the matrix to be factored */
    AMGF_COUNT_ALL_PIVOTS, {NULL, NULL}};
  TAO_IPFILTER *ip     = (TAO_IPFILTER *)tao->data;
  PetscReal     memory = ip->opt->direct_memory;
  PetscBool     allows;
  const char   *prefix;
  char          own[PETSC_MAX_OPTION_NAME];

  PetscFunctionBegin;
  PetscCall(TaoGetOptionsPrefix(tao, &prefix));
  PetscCall(PetscSNPrintf(own, sizeof(own), "%stao_ipfilter_direct_", prefix ? prefix : ""));
  PetscCall(AMGFMumpsFactor(ip->direct->A, own, settings, &memory, &ip->direct->F, error));
  PetscCall(PetscInfo(tao, "MUMPS on the whole matrix, %g MB: error %d\n", (double)memory, (int)*error));
  PetscCall(PetscStrncpy(ip->lin->why, "MUMPS failed on the whole matrix", sizeof(ip->lin->why)));
  PetscCall(DirectAllows(ip, memory, &allows));
  PetscFunctionReturn(0);
}

/* Factors the present matrix. *factored: false if that is impossible, with the reason in ip->lin->why. */
static PetscErrorCode DirectFactor(Tao tao, PetscBool *factored, PetscBool *singular)
{
  TAO_IPFILTER  *ip     = (TAO_IPFILTER *)tao->data;
  IPDirect      *direct = ip->direct;
  PetscReal      least  = 0.0;
  MatFactorError error  = MAT_FACTOR_OTHER;
  PetscBool      allows;

  PetscFunctionBegin;
  *factored = *singular = PETSC_FALSE;
  if (ip->hess->products) {
    PetscCall(
      PetscStrncpy(ip->lin->why, "MUMPS cannot factor a Hessian that only provides products", sizeof(ip->lin->why)));
    PetscFunctionReturn(0);
  }
  PetscCall(DirectLeastMemory(ip->cond->A, &least));
  PetscCall(DirectAllows(ip, least, &allows));
  if (!allows) PetscFunctionReturn(0);
  PetscCall(DirectTakeMatrix(ip->cond->A, direct));
  if (direct->A) PetscCall(DirectFactorWithin(tao, &error));
  else
    PetscCall(
      PetscStrncpy(ip->lin->why, "MUMPS, which would factor the whole matrix, is not available", sizeof(ip->lin->why)));
  *factored = (PetscBool)(error == MAT_FACTOR_NOERROR);
  *singular = (PetscBool)(error == MAT_FACTOR_NUMERIC_ZEROPIVOT || error == MAT_FACTOR_STRUCT_ZEROPIVOT);
  if (*factored) {
    direct->system  = ip->rec->nsystems;
    ip->lin->why[0] = '\0';
  } else PetscCall(IPDirectDestroy(direct));
  PetscFunctionReturn(0);
}

static PetscErrorCode DirectApply(Tao tao, Vec r, Vec e)
{
  PetscFunctionBegin;
  PetscCall(MatSolve(((TAO_IPFILTER *)tao->data)->direct->F, r, e));
  PetscFunctionReturn(0);
}

/*
   Solves A d = b by L D L^T with refinement to rounding accuracy. *verdict is IP_LINEAR_FAILED if the factors would
   need too much memory or MUMPS fails.
*/
PetscErrorCode IPDirectSolve(Tao tao, Vec b, Vec d, IPLinearVerdict *verdict)
{
  TAO_IPFILTER *ip       = (TAO_IPFILTER *)tao->data;
  IPDirect     *direct   = ip->direct;
  PetscBool     factored = PETSC_TRUE, singular = PETSC_FALSE;

  PetscFunctionBegin;
  *verdict = IP_LINEAR_FAILED;
  if (!direct->F || direct->system != ip->rec->nsystems) {
    PetscCall(DirectFactor(tao, &factored, &singular));
    if (factored) PetscCall(MatGetInertia(direct->F, &direct->negative, NULL, NULL));
  }
  if (singular || (factored && direct->negative)) *verdict = IP_LINEAR_INDEFINITE;
  if (!factored || direct->negative) PetscFunctionReturn(0);
  PetscCall(DirectApply(tao, b, d));
  PetscCall(IPResidualMeasure(tao, b, d));
  PetscCall(IPResidualRefine(tao, b, d, PETSC_TRUE, DirectApply, KSP_CONVERGED_ITS));
  if (IPResidualReached(ip, KSP_CONVERGED_ITS)) *verdict = IP_LINEAR_SOLVED;
  else
    PetscCall(PetscSNPrintf(ip->lin->why, sizeof(ip->lin->why),
      "MUMPS on the whole matrix leaves a backward error of %g", (double)ip->lin->backward_error));
  PetscFunctionReturn(0);
}
