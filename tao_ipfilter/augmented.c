/*
   Equality constraints. Their multipliers are not eliminated: the symmetric indefinite system

     [ A    J_E^T    ] [ dx     ]   [  b   ]
     [ J_E  -delta_c ] [ y + dy ] = [ -c_E ]

   is factored by MUMPS as L D L^T. Its inertia must be (n, m_E, 0), else delta grows in A, and delta_c is switched on
   where the system is singular (dependent constraints).
*/
#include "ipfilterimpl.h"

PetscErrorCode IPAugmentedDestroy(IPAugmented *aug)
{
  PetscFunctionBegin;
  PetscCall(KSPDestroy(&aug->ksp));
  PetscCall(MatDestroy(&aug->K));
  PetscCall(MatDestroy(&aug->shift));
  PetscCall(VecDestroy(&aug->rhs));
  PetscCall(VecDestroy(&aug->sol));
  PetscCall(VecDestroy(&aug->sol2));
  PetscCall(VecDestroy(&aug->correction));
  PetscFunctionReturn(0);
}

/* The factorization's KSP, prefix -tao_ipfilter_augmented_, and the diagonal block of delta_c */
static PetscErrorCode CreateAugmented(Tao tao)
{
  TAO_IPFILTER *ip   = (TAO_IPFILTER *)tao->data;
  IPAugmented  *aug  = &ip->aug;
  MPI_Comm      comm = PetscObjectComm((PetscObject)tao);
  PC            pc;
  PetscInt      m;

  PetscFunctionBegin;
  if (aug->ksp) PetscFunctionReturn(0);
  PetscCall(KSPCreate(comm, &aug->ksp));
  PetscCall(PetscObjectIncrementTabLevel((PetscObject)aug->ksp, (PetscObject)tao, 1));
  PetscCall(KSPSetOptionsPrefix(aug->ksp, ((PetscObject)tao)->prefix));
  PetscCall(KSPAppendOptionsPrefix(aug->ksp, "tao_ipfilter_augmented_"));
  PetscCall(KSPSetType(aug->ksp, KSPPREONLY));
  PetscCall(KSPGetPC(aug->ksp, &pc));
  PetscCall(PCSetType(pc, PCCHOLESKY));
  PetscCall(PCFactorSetMatSolverType(pc, MATSOLVERMUMPS));
  PetscCall(KSPSetFromOptions(aug->ksp));
  PetscCall(VecGetLocalSize(ip->ce, &m));
  PetscCall(MatCreateAIJ(comm, m, m, ip->me, ip->me, 1, NULL, 0, NULL, &aug->shift));
  PetscFunctionReturn(0);
}

/* K with A in its first block */
static PetscErrorCode AssembleAugmented(Tao tao, Mat A)
{
  TAO_IPFILTER *ip  = (TAO_IPFILTER *)tao->data;
  IPAugmented  *aug = &ip->aug;
  Mat           blocks[4], nest;

  PetscFunctionBegin;
  PetscCall(VecSet(ip->cetrial, -ip->delta_c));
  PetscCall(MatDiagonalSet(aug->shift, ip->cetrial, INSERT_VALUES));
  PetscCall(MatConvert(A, MATAIJ, MAT_INITIAL_MATRIX, &blocks[0]));
  PetscCall(MatTranspose(ip->JE, MAT_INITIAL_MATRIX, &blocks[1]));
  blocks[2] = ip->JE;
  blocks[3] = aug->shift;
  PetscCall(MatCreateNest(PetscObjectComm((PetscObject)tao), 2, NULL, 2, NULL, blocks, &nest));
  PetscCall(MatDestroy(&aug->K));
  PetscCall(MatConvert(nest, MATAIJ, MAT_INITIAL_MATRIX, &aug->K));
  PetscCall(MatSetOption(aug->K, MAT_SYMMETRIC, PETSC_TRUE));
  PetscCall(MatDestroy(&nest));
  PetscCall(MatDestroy(&blocks[0]));
  PetscCall(MatDestroy(&blocks[1]));
  if (!aug->rhs) {
    PetscCall(MatCreateVecs(aug->K, &aug->sol, &aug->rhs));
    PetscCall(VecDuplicate(aug->rhs, &aug->sol2));
    PetscCall(VecDuplicate(aug->rhs, &aug->correction));
  }
  PetscFunctionReturn(0);
}

/* One factorization, with the given percentage of work space beyond MUMPS's estimate; 0: its own choice */
static PetscErrorCode FactorWithin(IPAugmented *aug, PetscInt relaxation, PCFailedReason *failed)
{
  PC  pc;
  Mat F;

  PetscFunctionBegin;
  PetscCall(KSPReset(aug->ksp));
  PetscCall(KSPSetOperators(aug->ksp, aug->K, aug->K));
  PetscCall(KSPGetPC(aug->ksp, &pc));
  PetscCall(PCFactorSetUpMatSolverType(pc));
  PetscCall(PCFactorGetMatrix(pc, &F));
  PetscCall(MatMumpsSetIcntl(F, 24, 1)); /* detect null pivots, which the inertia counts */
  if (relaxation) PetscCall(MatMumpsSetIcntl(F, 14, relaxation));
  PetscCall(KSPSetUp(aug->ksp));
  PetscCall(PCGetFailedReason(pc, failed));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, failed, 1, MPI_INT, MPI_MAX, PetscObjectComm((PetscObject)aug->ksp)));
  PetscFunctionReturn(0);
}

/* Factors, and tells whether the inertia is that of a minimum and whether the matrix was singular. Where MUMPS fails for want of
   memory, or otherwise, that says nothing about the matrix: ip->linear_failed. */
static PetscErrorCode Factor(Tao tao, PetscBool *inertia, PetscBool *singular)
{
  TAO_IPFILTER  *ip   = (TAO_IPFILTER *)tao->data;
  IPAugmented   *aug  = &ip->aug;
  const PetscInt most = 320;
  PC             pc;
  PCFailedReason failed = PC_FACTOR_OUTMEMORY;
  Mat            F;
  PetscInt       negative, zero, positive, n;
  PetscReal      norm;

  PetscFunctionBegin;
  *singular = *inertia = PETSC_FALSE;
  PetscCall(MatNorm(aug->K, NORM_INFINITY, &norm));
  if (PetscIsInfOrNanReal(norm)) { /* MUMPS takes none */
    PetscCall(IPLinearNotANumber(tao));
    PetscFunctionReturn(0);
  }
  for (PetscInt relaxation = 0; failed == PC_FACTOR_OUTMEMORY && relaxation <= most; relaxation = relaxation ? 2 * relaxation : 40) PetscCall(FactorWithin(aug, relaxation, &failed));
  *singular = (PetscBool)(failed == PC_FACTOR_NUMERIC_ZEROPIVOT || failed == PC_FACTOR_STRUCT_ZEROPIVOT);
  if (*singular) PetscFunctionReturn(0);
  if (failed != PC_NOERROR) {
    PetscCall(PetscStrncpy(ip->linear_reason, failed == PC_FACTOR_OUTMEMORY ? "MUMPS finds no memory for the augmented system" : "MUMPS failed on the augmented system", sizeof(ip->linear_reason)));
    ip->fallbacks.failures++;
    ip->linear_failed = PETSC_TRUE;
    ip->ksp_reason    = KSP_DIVERGED_PC_FAILED;
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

/* Copies the local parts of (top, bottom) into v, or back */
static PetscErrorCode Join(Vec v, Vec top, Vec bottom, PetscBool back)
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

/* sol += K^-1 (rhs - K sol) while that halves the residual, which is left in sol2 */
static PetscErrorCode Refine(Tao tao)
{
  TAO_IPFILTER   *ip    = (TAO_IPFILTER *)tao->data;
  IPAugmented    *aug   = &ip->aug;
  const PetscInt  most  = 3;
  const PetscReal exact = 1e-14;
  PetscReal       rhs, before = PETSC_INFINITY;

  PetscFunctionBegin;
  PetscCall(VecNorm(aug->rhs, NORM_2, &rhs));
  for (PetscInt k = 0; k <= most; k++) {
    PetscCall(MatMult(aug->K, aug->sol, aug->sol2));
    PetscCall(VecAYPX(aug->sol2, -1.0, aug->rhs));
    PetscCall(VecNorm(aug->sol2, NORM_2, &ip->linear_residual));
    if (!(ip->linear_residual <= before)) {
      PetscCall(VecAXPY(aug->sol, -1.0, aug->correction));
      ip->linear_residual = before;
    }
    if (!(ip->linear_residual > exact * rhs) || !(ip->linear_residual <= 0.5 * before) || k == most) break;
    before = ip->linear_residual;
    PetscCall(KSPSolve(aug->ksp, aug->sol2, aug->correction));
    PetscCall(VecAXPY(aug->sol, 1.0, aug->correction));
    ip->fallbacks.refinements++;
  }
  ip->backward_error           = rhs > 0.0 ? ip->linear_residual / rhs : 0.0;
  ip->fallbacks.backward_error = PetscMax(ip->fallbacks.backward_error, ip->backward_error);
  PetscFunctionReturn(0);
}

/* Solves for dx and the new multipliers with the matrix cond.A; ce is the residual of the equality constraints.
   matrix tells whether A is new since the last call. *usable is false where the inertia is wrong. */
PetscErrorCode IPAugmentedSolve(Tao tao, Vec b, Vec ce, Vec dx, PetscBool matrix, PetscBool *usable)
{
  TAO_IPFILTER      *ip  = (TAO_IPFILTER *)tao->data;
  IPAugmented       *aug = &ip->aug;
  PetscBool          inertia = PETSC_TRUE, singular = PETSC_FALSE;
  KSPConvergedReason reason;

  PetscFunctionBegin;
  PetscCall(PetscLogEventBegin(TAO_IPFilterSolve, tao, b, dx, NULL));
  ip->linear_failed    = PETSC_FALSE;
  ip->linear_reason[0] = '\0';
  PetscCall(VecNorm(b, NORM_2, &ip->linear_rhs));
  PetscCall(CreateAugmented(tao));
  if (matrix) {
    PetscCall(AssembleAugmented(tao, ip->cond.A));
    PetscCall(Factor(tao, &inertia, &singular));
    if (singular && ip->delta_c == 0.0) {
      ip->delta_c = ip->delta_equality;
      PetscCall(AssembleAugmented(tao, ip->cond.A));
      PetscCall(Factor(tao, &inertia, &singular));
    }
  }
  *usable = inertia;
  if (!inertia) {
    PetscCall(PetscLogEventEnd(TAO_IPFilterSolve, tao, b, dx, NULL));
    PetscFunctionReturn(0);
  }
  PetscCall(VecCopy(ce, ip->cetrial));
  PetscCall(VecScale(ip->cetrial, -1.0));
  PetscCall(Join(aug->rhs, b, ip->cetrial, PETSC_FALSE));
  PetscCall(KSPSolve(aug->ksp, aug->rhs, aug->sol));
  PetscCall(KSPGetConvergedReason(aug->ksp, &reason));
  ip->ksp_reason = reason;
  *usable        = (PetscBool)(reason > 0);
  if (*usable) PetscCall(Refine(tao));
  PetscCall(Join(aug->sol, dx, ip->dy, PETSC_TRUE));
  PetscCall(VecAXPY(ip->dy, -1.0, ip->y));
  PetscCall(PetscLogEventEnd(TAO_IPFilterSolve, tao, b, dx, NULL));
  PetscFunctionReturn(0);
}

/* y that brings the stationarity residual nearest to zero: [I J_E^T; J_E 0] (w, y) = -(grad f - ..., 0). Zero where the gradients
   of the constraints are so nearly dependent that it would be huge (Waechter and Biegler 2006, section 3.6). */
PetscErrorCode IPEstimateMultipliers(Tao tao)
{
  TAO_IPFILTER   *ip  = (TAO_IPFILTER *)tao->data;
  const PetscReal most = 1e3;
  Mat             identity;
  PetscBool       inertia, singular;
  PetscReal       y, g, j;
  PetscInt        n, N;

  PetscFunctionBegin;
  PetscCall(CreateAugmented(tao));
  PetscCall(VecSet(ip->y, 0.0));
  PetscCall(IPStationarity(tao, ip->lambda, ip->rx));
  PetscCall(VecGetLocalSize(ip->rx, &n));
  PetscCall(VecGetSize(ip->rx, &N));
  PetscCall(MatCreateConstantDiagonal(PetscObjectComm((PetscObject)tao), n, n, N, N, 1.0, &identity));
  ip->delta_c = 0.0;
  PetscCall(AssembleAugmented(tao, identity));
  PetscCall(MatDestroy(&identity));
  PetscCall(Factor(tao, &inertia, &singular));
  if (!inertia) PetscFunctionReturn(0);
  PetscCall(VecScale(ip->rx, -1.0));
  PetscCall(VecSet(ip->cetrial, 0.0));
  PetscCall(Join(ip->aug.rhs, ip->rx, ip->cetrial, PETSC_FALSE));
  PetscCall(KSPSolve(ip->aug.ksp, ip->aug.rhs, ip->aug.sol));
  PetscCall(Join(ip->aug.sol, ip->rx, ip->y, PETSC_TRUE));
  PetscCall(VecNorm(ip->y, NORM_INFINITY, &y));
  PetscCall(VecNorm(tao->gradient, NORM_INFINITY, &g));
  PetscCall(MatNorm(ip->JE, NORM_INFINITY, &j));
  if (!(y * j <= most * g)) PetscCall(VecSet(ip->y, 0.0));
  PetscFunctionReturn(0);
}
