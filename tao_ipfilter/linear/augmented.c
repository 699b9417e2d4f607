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
#include "pc_amgf/sparse_factors.h"

PetscErrorCode IPAugmentedDestroy(IPAugmented *aug)
{
  PetscFunctionBegin;
  PetscCall(MatDestroy(&aug->F));
  PetscCall(MatDestroy(&aug->K));
  PetscCall(MatDestroy(&aug->shift));
  PetscCall(VecDestroy(&aug->rhs));
  PetscCall(VecDestroy(&aug->sol));
  PetscCall(VecDestroy(&aug->residual));
  PetscCall(VecDestroy(&aug->correction));
  PetscFunctionReturn(0);
}

/* Creates the matrix -delta I */
static PetscErrorCode AugmentedCreate(Tao tao)
{
  TAO_IPFILTER *ip   = (TAO_IPFILTER *)tao->data;
  IPAugmented  *aug  = ip->aug;
  MPI_Comm      comm = PetscObjectComm((PetscObject)tao);
  PetscInt      m;
  PetscBool     mumps;

  PetscFunctionBegin;
  if (aug->shift) PetscFunctionReturn(0);
  PetscCall(AMGFMumpsFactors(MATSEQAIJ, MAT_FACTOR_CHOLESKY, &mumps));
  PetscCheck(mumps, comm, PETSC_ERR_SUP, "TAOIPFILTER needs a PETSc with MUMPS for equality constraints");
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
  PetscCall(MatDestroy(&aug->F));
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
   Factors K, with the options prefix -tao_ipfilter_augmented_. Without METIS, MUMPS would choose the ordering PORD,
   whose analysis of the zero blocks takes longer than some factorizations. The small pivot threshold is IPOPT's;
   delayed pivots need work space.
*/
static PetscErrorCode AugmentedFactorOnce(Tao tao, MatFactorError *error)
{
  IPAugmented      *aug        = ((TAO_IPFILTER *)tao->data)->aug;
  const AMGFSetting settings[] = {{"mat_mumps_icntl_6", "0"}, /* the ordering must not depend on values, which change */
    {"mat_mumps_icntl_7", "2"},                               /* approximate minimum fill */
    {"mat_mumps_icntl_14", "100"},                            /* work space beyond MUMPS's estimate [per cent] */
    {"mat_mumps_icntl_24", "1"},                              /* detects null pivots, which count in the inertia */
    {"mat_mumps_cntl_1", aug->safe ? "1e-2" : "1e-6"},        /* relative pivot threshold */
    {NULL, NULL}};
  const char       *prefix;
  char              own[PETSC_MAX_OPTION_NAME];

  PetscFunctionBegin;
  PetscCall(TaoGetOptionsPrefix(tao, &prefix));
  PetscCall(PetscSNPrintf(own, sizeof(own), "%stao_ipfilter_augmented_", prefix ? prefix : ""));
  PetscCall(AMGFMumpsFactor(aug->K, own, settings, NULL, &aug->F, error));
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
  MatFactorError error;
  PetscInt       negative, zero, positive, n;
  PetscBool      undefined = PETSC_TRUE;

  PetscFunctionBegin;
  *singular = *inertia = PETSC_FALSE;
  PetscCall(AugmentedUndefined(aug, &undefined));
  if (undefined) { /* MUMPS does not accept infinite entries or NaN */
    PetscCall(IPResidualNotANumber(tao));
    PetscFunctionReturn(0);
  }
  PetscCall(AugmentedFactorOnce(tao, &error));
  *singular = (PetscBool)(error == MAT_FACTOR_NUMERIC_ZEROPIVOT || error == MAT_FACTOR_STRUCT_ZEROPIVOT);
  if (*singular) PetscFunctionReturn(0);
  if (error) {
    PetscCall(PetscStrncpy(ip->lin->why,
      error == MAT_FACTOR_OUTMEMORY ? "MUMPS has not enough memory for the augmented system"
                                    : "MUMPS failed on the augmented system",
      sizeof(ip->lin->why)));
    ip->rec->fallbacks.failures++;
    ip->lin->failed = PETSC_TRUE;
    ip->lin->reason = KSP_DIVERGED_PC_FAILED;
    PetscFunctionReturn(0);
  }
  PetscCall(MatGetInertia(aug->F, &negative, &zero, &positive));
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
    PetscCall(MatSolve(aug->F, aug->residual, aug->correction));
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
  TAO_IPFILTER   *ip     = (TAO_IPFILTER *)tao->data;
  IPAugmented    *aug    = ip->aug;
  const PetscReal coarse = 1e-6;
  MatFactorError  error  = MAT_FACTOR_NOERROR;
  PetscBool       again  = PETSC_FALSE;

  PetscFunctionBegin;
  do {
    if (again) PetscCall(AugmentedFactorOnce(tao, &error));
    *usable         = (PetscBool)!error;
    ip->lin->reason = *usable ? KSP_CONVERGED_ITS : KSP_DIVERGED_PC_FAILED;
    if (*usable) PetscCall(MatSolve(aug->F, aug->rhs, aug->sol));
    if (*usable) PetscCall(AugmentedRefine(tao));
    again = (PetscBool)(*usable && !aug->safe && ip->lin->backward_error > coarse);
    if (again) aug->safe = PETSC_TRUE;
    if (again) PetscCall(MatDestroy(&aug->F)); /* MUMPS reads the threshold before its analysis */
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
  PetscCall(MatSolve(ip->aug->F, ip->aug->rhs, ip->aug->sol));
  PetscCall(AugmentedJoin(ip->aug->sol, ip->rx, ip->at.y, PETSC_TRUE));
  PetscFunctionReturn(0);
}
