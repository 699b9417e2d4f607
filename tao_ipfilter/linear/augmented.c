/*
   Solves Newton systems with equality constraints, whose multipliers are not eliminated. The symmetric indefinite
   system
     [ A     J_E^T  ] [ dx     ]   [ b              ]
     [ J_E   -delta ] [ y + dy ] = [ -c_E - delta y ]
   is factored by MUMPS as L D L^T. Its inertia must be (n, m_E, 0); otherwise a larger multiple of M_u is added to the
   Hessian. If the system is singular because constraints depend on each other, delta > 0 regularizes it.
*/
#include "linearimpl.h"
#include "tao_ipfilter/solver/condensed.h"
#include "tao_ipfilter/solver/constants.h"
#include "tao_ipfilter/solver/factors.h"
#include "tao_ipfilter/solver/linear.h"
#include "tao_ipfilter/solver/matrices.h"
#include "tao_ipfilter/solver/options.h"
#include "tao_ipfilter/solver/record.h"
#include "tao_ipfilter/solver/sizes.h"
#include "tao_ipfilter/solver/stiffness.h"
#include "pc_amgf/mumps.h"

PetscErrorCode IPAugmentedDestroy(IPAugmented *aug)
{
  PetscFunctionBegin;
  PetscCall(KSPDestroy(&aug->ksp));
  PetscCall(MatDestroy(&aug->K));
  PetscCall(MatDestroy(&aug->shift));
  PetscCall(VecDestroy(&aug->rhs));
  PetscCall(VecDestroy(&aug->sol));
  PetscCall(VecDestroy(&aug->residual));
  PetscCall(VecDestroy(&aug->correction));
  PetscFunctionReturn(0);
}

/* Checks that the PC is a Cholesky factorization. Only its factors tell the inertia. */
static PetscErrorCode AugmentedCheckType(PC pc)
{
  const char *prefix;
  PCType      type;
  PetscBool   cholesky;

  PetscFunctionBegin;
  PetscCall(PetscObjectTypeCompare((PetscObject)pc, PCCHOLESKY, &cholesky));
  PetscCall(PCGetType(pc, &type));
  PetscCall(PCGetOptionsPrefix(pc, &prefix));
  PetscCheck(cholesky, PetscObjectComm((PetscObject)pc), PETSC_ERR_SUP,
    "-%spc_type must be cholesky, not %s: TAOIPFILTER needs the inertia of the augmented system of equality "
    "constraints",
    prefix, type);
  PetscFunctionReturn(0);
}

/* Creates the KSP of the factorization, with the options prefix -tao_ipfilter_augmented_, and the matrix -delta I */
static PetscErrorCode AugmentedCreate(Tao tao)
{
  TAO_IPFILTER *ip   = (TAO_IPFILTER *)tao->data;
  IPAugmented  *aug  = ip->aug;
  MPI_Comm      comm = PetscObjectComm((PetscObject)tao);
  PC            pc;
  PetscInt      m;
  PetscBool     mumps;

  PetscFunctionBegin;
  if (aug->shift) PetscFunctionReturn(0); /* the last to be created */
  PetscCall(KSPDestroy(&aug->ksp));
  PetscCall(AMGFMumpsFactors(MATSEQAIJ, MAT_FACTOR_CHOLESKY, &mumps));
  PetscCheck(mumps, comm, PETSC_ERR_SUP, "TAOIPFILTER needs a PETSc with MUMPS for equality constraints");
  PetscCall(KSPCreate(comm, &aug->ksp));
  PetscCall(PetscObjectIncrementTabLevel((PetscObject)aug->ksp, (PetscObject)tao, 1));
  PetscCall(KSPSetOptionsPrefix(aug->ksp, ((PetscObject)tao)->prefix));
  PetscCall(KSPAppendOptionsPrefix(aug->ksp, "tao_ipfilter_augmented_"));
  PetscCall(KSPSetType(aug->ksp, KSPPREONLY));
  PetscCall(KSPGetPC(aug->ksp, &pc));
  PetscCall(PCSetType(pc, PCCHOLESKY));
  PetscCall(PCFactorSetMatSolverType(pc, MATSOLVERMUMPS));
  PetscCall(KSPSetFromOptions(aug->ksp));
  PetscCall(AugmentedCheckType(pc));
  PetscCall(VecGetLocalSize(ip->at.ce, &m));
  PetscCall(MatCreateAIJ(comm, m, m, ip->me, ip->me, 1, NULL, 0, NULL, &aug->shift));
  PetscFunctionReturn(0);
}

/* Finds whether A lacks a diagonal entry on any rank */
static PetscErrorCode AugmentedMissesDiagonal(Mat A, PetscBool *misses)
{
  PetscInt rstart, rend;

  PetscFunctionBegin;
  *misses = PETSC_FALSE;
  PetscCall(MatGetOwnershipRange(A, &rstart, &rend));
  for (PetscInt i = rstart; i < rend && !*misses; i++) {
    PetscInt        n, k = 0;
    const PetscInt *cols;

    PetscCall(MatGetRow(A, i, &n, &cols, NULL));
    while (k < n && cols[k] != i) k++;
    *misses = (PetscBool)(k == n);
    PetscCall(MatRestoreRow(A, i, &n, &cols, NULL));
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, misses, 1, MPI_PETSCBOOL, MPI_LOR, PetscObjectComm((PetscObject)A)));
  PetscFunctionReturn(0);
}

/*
   Copies A to AIJ format and adds missing diagonal entries. PETSc 3.18 on several ranks passes no entry of a row's
   upper triangle to MUMPS if the row has no diagonal entry.
*/
static PetscErrorCode AugmentedFirstBlock(Mat A, Mat *block)
{
  PetscBool missing;
  PetscInt  rstart, rend;

  PetscFunctionBegin;
  PetscCall(MatConvert(A, MATAIJ, MAT_INITIAL_MATRIX, block));
  PetscCall(AugmentedMissesDiagonal(*block, &missing));
  if (!missing) PetscFunctionReturn(0);
  PetscCall(MatSetOption(*block, MAT_NEW_NONZERO_ALLOCATION_ERR, PETSC_FALSE));
  PetscCall(MatGetOwnershipRange(*block, &rstart, &rend));
  for (PetscInt i = rstart; i < rend; i++) PetscCall(MatSetValue(*block, i, i, 0.0, ADD_VALUES));
  PetscCall(MatAssemblyBegin(*block, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(*block, MAT_FINAL_ASSEMBLY));
  PetscFunctionReturn(0);
}

/* Replaces aug->K by *K. If the patterns are equal, only the values are copied, so that MUMPS's analysis is reused. */
static PetscErrorCode AugmentedTake(IPAugmented *aug, Mat *K)
{
  PetscBool same = PETSC_FALSE;

  PetscFunctionBegin;
  if (aug->K) PetscCall(IPMatrixSamePattern(aug->K, *K, &same));
  if (same) {
    PetscCall(MatCopy(*K, aug->K, SAME_NONZERO_PATTERN));
    PetscCall(MatDestroy(K));
    PetscFunctionReturn(0);
  }
  PetscCall(KSPReset(aug->ksp)); /* creates a new factor object, which gets its settings again */
  PetscCall(MatDestroy(&aug->K));
  PetscCall(MatSetOption(*K, MAT_SYMMETRIC, PETSC_TRUE));
  aug->K = *K;
  PetscFunctionReturn(0);
}

/* Assembles K with A as its first block */
static PetscErrorCode AugmentedAssemble(Tao tao, Mat A)
{
  TAO_IPFILTER *ip  = (TAO_IPFILTER *)tao->data;
  IPAugmented  *aug = ip->aug;
  Mat           blocks[4], nest, K;
  Vec           diagonal;

  PetscFunctionBegin;
  PetscCall(IPGetWork(tao, IP_EQUALITIES, &diagonal));
  PetscCall(VecSet(diagonal, -aug->delta));
  PetscCall(MatDiagonalSet(aug->shift, diagonal, INSERT_VALUES));
  PetscCall(IPRestoreWork(tao, IP_EQUALITIES, &diagonal));
  PetscCall(AugmentedFirstBlock(A, &blocks[0]));
  PetscCall(MatTranspose(ip->jac->equality, MAT_INITIAL_MATRIX, &blocks[1]));
  blocks[2] = ip->jac->equality;
  blocks[3] = aug->shift;
  PetscCall(MatCreateNest(PetscObjectComm((PetscObject)tao), 2, NULL, 2, NULL, blocks, &nest));
  PetscCall(MatConvert(nest, MATAIJ, MAT_INITIAL_MATRIX, &K));
  PetscCall(MatDestroy(&nest));
  PetscCall(MatDestroy(&blocks[0]));
  PetscCall(MatDestroy(&blocks[1]));
  PetscCall(AugmentedTake(aug, &K));
  if (!aug->rhs) {
    PetscCall(MatCreateVecs(aug->K, &aug->sol, &aug->rhs));
    PetscCall(VecDuplicate(aug->rhs, &aug->residual));
    PetscCall(VecDuplicate(aug->rhs, &aug->correction));
  }
  PetscFunctionReturn(0);
}

/*
   Sets up the KSP with the ordering "approximate minimum fill", unless the user has chosen one. PETSc reads MUMPS's
   ordering only from the options database.
*/
static PetscErrorCode AugmentedSetUpOrdered(KSP ksp)
{
  PetscOptions options;
  const char  *prefix;
  char         name[PETSC_MAX_OPTION_NAME];
  PetscBool    given;

  PetscFunctionBegin;
  PetscCall(PetscObjectGetOptions((PetscObject)ksp, &options));
  PetscCall(KSPGetOptionsPrefix(ksp, &prefix));
  PetscCall(PetscSNPrintf(name, sizeof(name), "-%smat_mumps_icntl_7", prefix));
  PetscCall(PetscOptionsHasName(options, NULL, name, &given));
  if (!given) PetscCall(PetscOptionsSetValue(options, name, "2"));
  PetscCall(KSPSetUp(ksp));
  if (!given) PetscCall(PetscOptionsClearValue(options, name));
  PetscFunctionReturn(0);
}

/*
   Factors K once. Without METIS, MUMPS would choose the ordering PORD, whose analysis of the zero blocks takes longer
   than some factorizations; the ordering is therefore set. The pivot threshold is as small as IPOPT's, since delayed
   pivots need work space.
*/
static PetscErrorCode AugmentedFactorOnce(IPAugmented *aug, PCFailedReason *failed)
{
  PC          pc;
  Mat         F;
  const char *prefix;

  PetscFunctionBegin;
  PetscCall(PetscObjectStateIncrease((PetscObject)aug->K)); /* makes PETSc factor again, even if only the work space
                                                               has grown */
  PetscCall(KSPSetOperators(aug->ksp, aug->K, aug->K));
  PetscCall(KSPGetPC(aug->ksp, &pc));
  PetscCall(PCGetOptionsPrefix(pc, &prefix));
  PetscCall(MatSetOptionsPrefixFactor(aug->K, prefix)); /* PCSetUp() sets the prefix too late for a factor that already
                                                   exists */
  PetscCall(PCFactorSetUpMatSolverType(pc));
  PetscCall(PCFactorGetMatrix(pc, &F));
  PetscCall(MatFactorClearError(F));
  PetscCall(AMGFMumpsSetIcntl(F, 6, 0)); /* the ordering must not depend on values, which change */
  PetscCall(AMGFMumpsSetIcntl(F, 14, aug->relaxation));
  PetscCall(AMGFMumpsSetIcntl(F, 24, 1)); /* detects null pivots, which count in the inertia */
  PetscCall(AMGFMumpsSetCntl(F, 1, aug->pivot));
  PetscCall(AugmentedSetUpOrdered(aug->ksp));
  PetscCall(PCGetFailedReason(pc, failed));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, failed, 1, MPI_INT, MPI_MAX, PetscObjectComm((PetscObject)aug->ksp)));
  PetscFunctionReturn(0);
}

/* Factors K, and repeats the factorization with more work space as long as MUMPS reports too little */
static PetscErrorCode AugmentedFactorWithin(IPAugmented *aug, PCFailedReason *failed)
{
  const PetscInt  first = 100; /* work space beyond MUMPS's estimate [per cent] */
  const PetscReal pivot = 1e-6;

  PetscFunctionBegin;
  if (!aug->relaxation) (void)AMGFMumpsMoreSpace(first, &aug->relaxation);
  if (aug->pivot == 0.0) aug->pivot = pivot;
  PetscCall(AugmentedFactorOnce(aug, failed));
  while (*failed == PC_FACTOR_OUTMEMORY && AMGFMumpsMoreSpace(first, &aug->relaxation)) {
    PetscCall(KSPReset(aug->ksp)); /* otherwise PETSc would report MUMPS's error as an error of the analysis */
    PetscCall(AugmentedFactorOnce(aug, failed));
  }
  /* A failed factorization must not be reused. */
  if (*failed != PC_NOERROR) PetscCall(KSPReset(aug->ksp));
  PetscFunctionReturn(0);
}

/* Finds whether an entry of K is infinite or NaN, from the row sums. MatNorm() ignores NaN. */
static PetscErrorCode AugmentedUndefined(IPAugmented *aug, PetscBool *undefined)
{
  PetscReal norm;

  PetscFunctionBegin;
  PetscCall(VecSet(aug->correction, 1.0));
  PetscCall(MatMult(aug->K, aug->correction, aug->residual));
  PetscCall(VecNorm(aug->residual, NORM_1, &norm));
  *undefined = (PetscBool)PetscIsInfOrNanReal(norm);
  PetscFunctionReturn(0);
}

/*
   Factors K. *inertia: K has the inertia of a minimum; *singular: K is singular. If MUMPS fails for lack of memory or
   another reason that tells nothing about the matrix, ip->lin->failed is set.
*/
static PetscErrorCode AugmentedFactor(Tao tao, PetscBool *inertia, PetscBool *singular)
{
  TAO_IPFILTER  *ip  = (TAO_IPFILTER *)tao->data;
  IPAugmented   *aug = ip->aug;
  PC             pc;
  PCFailedReason failed;
  Mat            F;
  PetscInt       negative, zero, positive, n;
  PetscBool      undefined = PETSC_TRUE;

  PetscFunctionBegin;
  *singular = *inertia = PETSC_FALSE;
  PetscCall(AugmentedUndefined(aug, &undefined));
  if (undefined) { /* MUMPS does not accept infinite entries or NaN */
    PetscCall(IPResidualNotANumber(tao));
    PetscFunctionReturn(0);
  }
  PetscCall(AugmentedFactorWithin(aug, &failed));
  *singular = (PetscBool)(failed == PC_FACTOR_NUMERIC_ZEROPIVOT || failed == PC_FACTOR_STRUCT_ZEROPIVOT);
  if (*singular) PetscFunctionReturn(0);
  if (failed != PC_NOERROR) {
    PetscCall(PetscStrncpy(ip->lin->why,
      failed == PC_FACTOR_OUTMEMORY ? "MUMPS has not enough memory for the augmented system"
                                    : "MUMPS failed on the augmented system",
      sizeof(ip->lin->why)));
    ip->rec->fallbacks.failures++;
    ip->lin->failed = PETSC_TRUE;
    ip->lin->reason = KSP_DIVERGED_PC_FAILED;
    PetscFunctionReturn(0);
  }
  PetscCall(KSPGetPC(aug->ksp, &pc));
  PetscCall(PCFactorGetMatrix(pc, &F));
  PetscCall(MatGetInertia(F, &negative, &zero, &positive));
  PetscCall(VecGetSize(tao->solution, &n));
  *singular = (PetscBool)(zero > 0 || negative + positive < n + ip->me);
  *inertia  = (PetscBool)(!*singular && negative == ip->me);
  PetscFunctionReturn(0);
}

/* Copies the local parts of (top, bottom) into v, or from v if `back` */
static PetscErrorCode AugmentedJoin(Vec v, Vec top, Vec bottom, PetscBool back)
{
  Vec          part[2] = {top, bottom};
  PetscScalar *a, *p;
  PetscInt     offset = 0, n;

  PetscFunctionBegin;
  PetscCall(VecGetArray(v, &a));
  for (PetscInt k = 0; k < 2; k++) {
    PetscCall(VecGetLocalSize(part[k], &n));
    PetscCall(VecGetArray(part[k], &p));
    PetscCall(back ? PetscArraycpy(p, a + offset, n) : PetscArraycpy(a + offset, p, n));
    PetscCall(VecRestoreArray(part[k], &p));
    offset += n;
  }
  PetscCall(VecRestoreArray(v, &a));
  PetscFunctionReturn(0);
}

/*
   Computes residual = rhs - K sol and its norm. *needless: refinement is not needed. This holds if the residual is far
   below what convergence requires, or if it is both far below the present KKT error and negligible compared with the
   right-hand side.
*/
static PetscErrorCode AugmentedMeasure(Tao tao, PetscBool *needless)
{
  TAO_IPFILTER   *ip       = (TAO_IPFILTER *)tao->data;
  IPAugmented    *aug      = ip->aug;
  const PetscReal fraction = 0.01, precise = 1e-8;
  PetscReal       forces, constraints, rhs, asked = fraction * ip->tol;
  Vec             top, bottom;

  PetscFunctionBegin;
  PetscCall(MatMult(aug->K, aug->sol, aug->residual));
  PetscCall(VecAYPX(aug->residual, -1.0, aug->rhs));
  PetscCall(VecNorm(aug->residual, NORM_2, &ip->lin->norm));
  PetscCall(VecNorm(aug->rhs, NORM_2, &rhs));
  if (ip->lin->norm <= precise * rhs && IPBothErrors(ip) <= 1.0)
    asked = PetscMax(asked, PetscSqr(fraction) * IPBothErrors(ip));
  PetscCall(IPGetWork(tao, IP_UNKNOWNS, &top));
  PetscCall(IPGetWork(tao, IP_EQUALITIES, &bottom));
  PetscCall(AugmentedJoin(aug->residual, top, bottom, PETSC_TRUE));
  PetscCall(VecNorm(top, NORM_2, &forces));
  PetscCall(VecNorm(bottom, NORM_INFINITY, &constraints));
  PetscCall(IPRestoreWork(tao, IP_EQUALITIES, &bottom));
  PetscCall(IPRestoreWork(tao, IP_UNKNOWNS, &top));
  *needless = (PetscBool)(forces <= asked * IPErrorBoundForceUnit(ip) && constraints <= asked * ip->scale->equality);
  PetscFunctionReturn(0);
}

/* Improves sol by iterative refinement, sol += K^-1 (rhs - K sol), as long as that is needed and halves the residual */
static PetscErrorCode AugmentedRefine(Tao tao)
{
  TAO_IPFILTER   *ip    = (TAO_IPFILTER *)tao->data;
  IPAugmented    *aug   = ip->aug;
  const PetscInt  limit = 3;
  const PetscReal exact = 1e-12;
  PetscReal       rhs, before = PETSC_INFINITY;
  PetscBool       needless;

  PetscFunctionBegin;
  PetscCall(VecNorm(aug->rhs, NORM_2, &rhs));
  for (PetscInt k = 0; k <= limit; k++) {
    PetscCall(AugmentedMeasure(tao, &needless));
    if (!(ip->lin->norm <= before)) {
      PetscCall(VecAXPY(aug->sol, -1.0, aug->correction));
      ip->lin->norm = before;
    }
    if (needless || !(ip->lin->norm > exact * rhs) || !(ip->lin->norm <= 0.5 * before) || k == limit) break;
    before = ip->lin->norm;
    PetscCall(KSPSolve(aug->ksp, aug->residual, aug->correction));
    PetscCall(VecAXPY(aug->sol, 1.0, aug->correction));
    ip->rec->fallbacks.refinements++;
  }
  ip->lin->backward_error           = rhs > 0.0 ? ip->lin->norm / rhs : 0.0;
  ip->rec->fallbacks.backward_error = PetscMax(ip->rec->fallbacks.backward_error, ip->lin->backward_error);
  PetscFunctionReturn(0);
}

/* Computes the unit of delta: a typical diagonal entry of J_E A^-1 J_E^T */
static PetscErrorCode AugmentedUnit(Tao tao, PetscReal *unit)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  PetscReal     norm;

  PetscFunctionBegin;
  *unit = 1.0;
  if (ip->opt->scaling == IP_SCALING_NONE) PetscFunctionReturn(0);
  PetscCall(MatNorm(ip->jac->equality, NORM_FROBENIUS, &norm));
  if (norm > 0.0) *unit = PetscSqr(norm) / ip->me / ip->stiff->hscale;
  PetscFunctionReturn(0);
}

/* Assembles and factors K. If K is singular, delta is set and K is assembled and factored again. */
static PetscErrorCode AugmentedFactorRegular(Tao tao, PetscBool *inertia)
{
  TAO_IPFILTER *ip       = (TAO_IPFILTER *)tao->data;
  PetscBool     singular = PETSC_FALSE;
  PetscReal     unit;

  PetscFunctionBegin;
  PetscCall(AugmentedAssemble(tao, ip->cond->A));
  PetscCall(AugmentedFactor(tao, inertia, &singular));
  if (!singular || ip->aug->delta != 0.0) PetscFunctionReturn(0);
  PetscCall(AugmentedUnit(tao, &unit));
  ip->aug->delta    = IP_DELTA_EQUALITY * unit;
  ip->aug->centered = PETSC_TRUE;
  PetscCall(AugmentedAssemble(tao, ip->cond->A));
  PetscCall(AugmentedFactor(tao, inertia, &singular));
  PetscFunctionReturn(0);
}

/*
   Solves K sol = rhs with iterative refinement. If the residual remains too large, K is factored again with a larger
   pivot threshold.
*/
static PetscErrorCode AugmentedSolveRefined(Tao tao, PetscBool *usable)
{
  TAO_IPFILTER   *ip   = (TAO_IPFILTER *)tao->data;
  IPAugmented    *aug  = ip->aug;
  const PetscReal safe = 1e-2, coarse = 1e-6;
  PCFailedReason  failed = PC_NOERROR;
  PetscBool       again  = PETSC_FALSE;

  PetscFunctionBegin;
  do {
    if (again) PetscCall(AugmentedFactorWithin(aug, &failed));
    if (failed == PC_NOERROR) {
      PetscCall(KSPSolve(aug->ksp, aug->rhs, aug->sol));
      PetscCall(KSPGetConvergedReason(aug->ksp, &ip->lin->reason));
    } else ip->lin->reason = KSP_DIVERGED_PC_FAILED;
    *usable = (PetscBool)(ip->lin->reason > 0);
    if (*usable) PetscCall(AugmentedRefine(tao));
    again = (PetscBool)(*usable && aug->pivot < safe && ip->lin->backward_error > coarse);
    if (again) aug->pivot = safe;
  } while (again);
  PetscFunctionReturn(0);
}

/*
   Solves K (top, bottom) = (b, -ce) with iterative refinement. If the regularization is centered at the present
   multipliers, it has no effect at a solution.
*/
static PetscErrorCode AugmentedApply(Tao tao, Vec b, Vec ce, Vec top, Vec bottom, PetscBool *usable)
{
  TAO_IPFILTER *ip  = (TAO_IPFILTER *)tao->data;
  IPAugmented  *aug = ip->aug;
  Vec           negative;

  PetscFunctionBegin;
  PetscCall(IPGetWork(tao, IP_EQUALITIES, &negative));
  PetscCall(VecAXPBY(negative, -1.0, 0.0, ce));
  if (aug->centered) PetscCall(VecAXPY(negative, -aug->delta, ip->at.y));
  PetscCall(AugmentedJoin(aug->rhs, b, negative, PETSC_FALSE));
  PetscCall(IPRestoreWork(tao, IP_EQUALITIES, &negative));
  PetscCall(AugmentedSolveRefined(tao, usable));
  PetscCall(AugmentedJoin(aug->sol, top, bottom, PETSC_TRUE));
  PetscFunctionReturn(0);
}

/*
   Solves for dx and the new multipliers, ip->dir.y, with the matrix cond->A. ce: residual of the equality constraints;
   matrix: whether A is new since the last call; *usable: false if the inertia is wrong or the solver failed.
*/
PetscErrorCode IPAugmentedSolve(Tao tao, Vec b, Vec ce, Vec dx, PetscBool matrix, PetscBool *usable)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  PetscCall(PetscLogEventBegin(TAO_IPFilterSolve, tao, b, dx, NULL));
  ip->lin->failed = PETSC_FALSE;
  ip->lin->why[0] = '\0';
  PetscCall(VecNorm(b, NORM_2, &ip->lin->rhs));
  PetscCall(AugmentedCreate(tao));
  *usable = PETSC_TRUE;
  if (matrix) PetscCall(AugmentedFactorRegular(tao, usable));
  if (*usable) {
    PetscCall(AugmentedApply(tao, b, ce, dx, ip->dir.y, usable));
    PetscCall(VecAXPY(ip->dir.y, -1.0, ip->at.y));
  }
  PetscCall(PetscLogEventEnd(TAO_IPFilterSolve, tao, b, dx, NULL));
  PetscFunctionReturn(0);
}

/*
   Estimates the multipliers y by least squares of the stationarity residual r, from the system [I J_E^T; J_E 0] (w, y)
   = (-r, 0). If this is singular, y = 0.
*/
PetscErrorCode IPAugmentedMultipliers(Tao tao)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  Mat           identity;
  PetscBool     inertia, singular;
  PetscInt      n, N;

  PetscFunctionBegin;
  PetscCall(AugmentedCreate(tao));
  PetscCall(VecSet(ip->at.y, 0.0));
  PetscCall(IPStationarity(tao, ip->at.lambda, ip->rx));
  PetscCall(VecGetLocalSize(ip->rx, &n));
  PetscCall(VecGetSize(ip->rx, &N));
  PetscCall(MatCreateConstantDiagonal(PetscObjectComm((PetscObject)tao), n, n, N, N, 1.0, &identity));
  ip->aug->delta    = 0.0;
  ip->aug->centered = PETSC_FALSE;
  PetscCall(AugmentedAssemble(tao, identity));
  PetscCall(MatDestroy(&identity));
  PetscCall(AugmentedFactor(tao, &inertia, &singular));
  if (!inertia) PetscFunctionReturn(0);
  PetscCall(VecScale(ip->rx, -1.0));
  PetscCall(AugmentedJoin(ip->aug->rhs, ip->rx, ip->at.y, PETSC_FALSE));
  PetscCall(KSPSolve(ip->aug->ksp, ip->aug->rhs, ip->aug->sol));
  PetscCall(AugmentedJoin(ip->aug->sol, ip->rx, ip->at.y, PETSC_TRUE));
  PetscFunctionReturn(0);
}
