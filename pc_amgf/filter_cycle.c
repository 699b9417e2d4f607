/*
   Applies one of the three cycles (bfb, fbf, additive) to a vector.

   Notation: B is one application of the AMG, P the interpolation from the subspace, R = P^H A, A_w = R P, and Q = P
   A_w^-1 P^H. A is Hermitian. The adjoint of a cycle is therefore the same cycle with B^H and Q^H. The transpose of a
   cycle M is M^T r = conj(M^H conj(r)). With real scalars, conj() does nothing.
*/
#include "amgfimpl.h"
#include "guard.h"

/*
   Conjugates x. With real scalars VecConjugate() is not called, because it rejects vectors that are locked for reading.
*/
static PetscErrorCode CycleConjugate(Vec x)
{
  PetscFunctionBegin;
  if (PetscDefined(USE_COMPLEX)) PetscCall(VecConjugate(x));
  PetscFunctionReturn(0);
}

/*
   Applies the AMG: z = B r. If a library reports an error, or if the AMG's set-up failed before, z is set to zero and
   the PC is marked as failed. The error may occur on one rank only, so that nothing collective follows it here; all
   ranks notice it at the KSP's next reduction.
   The case of a failed set-up is needed because KSPs apply the PC before they check it.
*/
static PetscErrorCode CycleGuardAMG(PC pc, Vec r, Vec z)
{
  PC_AMGF       *amgf   = (PC_AMGF *)pc->data;
  PetscBool      failed = (PetscBool)!amgf->lag.built;
  AMGFGuard      guard;
  PetscErrorCode error;
  PetscInt       n;
  PetscScalar   *values;

  PetscFunctionBegin;
  if (!failed) {
    PetscCall(PCAMGFGuardBegin_Private(&guard, r));
    error = PCApply(amgf->amg, r, z);
    PetscCall(PCAMGFGuardEnd_Private(&guard, error, &failed));
    if (!failed) PetscFunctionReturn(0);
    PetscCall(PetscInfo(pc, "An error inside the AMG: %s\n", guard.why));
  }
  PetscCall(PCSetFailedReason(pc, PC_SUBPC_ERROR));
  PetscCall(VecGetLocalSize(z, &n));
  PetscCall(VecGetArrayWrite(z, &values));
  PetscCall(PetscArrayzero(values, n));
  PetscCall(VecRestoreArrayWrite(z, &values));
  PetscFunctionReturn(0);
}

/* Computes z = B r, or z = B^H r if `adjoint` */
static PetscErrorCode CycleApplyAMG(PC pc, PetscBool adjoint, Vec r, Vec z)
{
  PC_AMGF  *amgf = (PC_AMGF *)pc->data;
  PetscBool hypre;

  PetscFunctionBegin;
  amgf->counts.amg_applies++;
  PetscCall(PetscLogEventBegin(PC_AMGF_AMGApply, pc, r, z, 0));
  if (adjoint) {
    /* The transposed cycle of hypre smooths by Jacobi only and skips all other smoothers. B is used instead, since
       PCAMGF requires a symmetric B. */
    PetscCall(PetscObjectTypeCompare((PetscObject)amgf->amg, PCHYPRE, &hypre));
    if (hypre) adjoint = PETSC_FALSE;
  }
  if (amgf->factor.on && !amgf->factor.F) PetscCall(VecSet(z, 0.0)); /* the factorization failed */
  else if (amgf->factor.on) PetscCall(MatSolve(amgf->factor.F, r, z));
  else if (adjoint && amgf->lag.built) {
    PetscCall(CycleConjugate(r));
    PetscCall(PCApplyTranspose(amgf->amg, r, z));
    PetscCall(CycleConjugate(r));
    PetscCall(CycleConjugate(z));
  } else PetscCall(CycleGuardAMG(pc, r, z));
  PetscCall(PetscLogEventEnd(PC_AMGF_AMGApply, pc, r, z, 0));
  PetscFunctionReturn(0);
}

/* Computes rc = P^H r */
static PetscErrorCode CycleRestrict(PC_AMGF *amgf, Vec r, Vec rc)
{
  PetscFunctionBegin;
  if (amgf->sub.P) PetscCall(MatMultHermitianTranspose(amgf->sub.P, r, rc));
  else PetscCall(VecISCopy(r, amgf->sub.rows, SCATTER_REVERSE, rc));
  PetscFunctionReturn(0);
}

/* Computes z = z + P ec */
static PetscErrorCode CycleProlongAdd(PC_AMGF *amgf, Vec ec, Vec z)
{
  PetscFunctionBegin;
  if (amgf->sub.P) PetscCall(MatMultAdd(amgf->sub.P, ec, z, z));
  else PetscCall(VecISAXPY(z, amgf->sub.rows, 1.0, ec));
  PetscFunctionReturn(0);
}

/* Computes ec = A_w^-1 rc, or ec = A_w^-H rc if `adjoint` */
static PetscErrorCode CycleSolveFilter(PC pc, PetscBool adjoint)
{
  PC_AMGF  *amgf = (PC_AMGF *)pc->data;
  PetscBool telescope;
  PC        inner;

  PetscFunctionBegin;
  amgf->counts.filter_applies++;
  PetscCall(KSPGetPC(amgf->filter, &inner));
  PetscCall(PetscObjectTypeCompare((PetscObject)inner, PCTELESCOPE, &telescope));
  if (telescope) adjoint = PETSC_FALSE; /* PCTELESCOPE has no transpose, and A_w is Hermitian */
  PetscCall(PetscLogEventBegin(PC_AMGF_FltApply, pc, amgf->rc, amgf->ec, 0));
  if (adjoint) {
    PetscCall(CycleConjugate(amgf->rc));
    PetscCall(KSPSolveTranspose(amgf->filter, amgf->rc, amgf->ec));
    PetscCall(CycleConjugate(amgf->rc));
    PetscCall(CycleConjugate(amgf->ec));
  } else PetscCall(KSPSolve(amgf->filter, amgf->rc, amgf->ec));
  PetscCall(KSPCheckSolve(amgf->filter, pc, amgf->ec));
  PetscCall(PetscLogEventEnd(PC_AMGF_FltApply, pc, amgf->rc, amgf->ec, 0));
  PetscFunctionReturn(0);
}

/* Computes r = r - A P ec as r - R^H ec, which needs no product with the whole A */
static PetscErrorCode CycleSubtractFiltered(PC_AMGF *amgf, Vec work, Vec r)
{
  PetscFunctionBegin;
  PetscCall(MatMultHermitianTranspose(amgf->R, amgf->ec, work));
  PetscCall(VecAXPY(r, -1.0, work));
  PetscFunctionReturn(0);
}

/* Applies the cycle bfb, whose error propagation is (I-BA)(I-QA)(I-BA) */
static PetscErrorCode CycleApplyBFB(PC pc, PetscBool adjoint, Vec r, Vec z)
{
  PC_AMGF  *amgf     = (PC_AMGF *)pc->data;
  Vec       residual = amgf->w[0], work = amgf->w[1];
  Mat       A;
  AMGFStamp now;
  PetscBool use_amat;

  PetscFunctionBegin;
  PetscCall(PCGetUseAmat(pc, &use_amat));
  A = use_amat ? pc->mat : pc->pmat;
  PetscCall(MatGetStamp_AMGF(A, &now));
  PetscCall(CycleApplyAMG(pc, adjoint, r, z));
  PetscCall(MatMult(A, z, work));
  PetscCall(VecWAXPY(residual, -1.0, work, r));
  PetscCall(CycleRestrict(amgf, residual, amgf->rc));
  PetscCall(CycleSolveFilter(pc, adjoint));
  PetscCall(CycleProlongAdd(amgf, amgf->ec, z));
  if (AMGFStampSameValues(&now, &amgf->galerkin)) PetscCall(CycleSubtractFiltered(amgf, work, residual));
  else { /* R was computed from another matrix, or from older values. R^H ec would make the cycle unsymmetric. */
    PetscCall(MatMult(A, z, work));
    PetscCall(VecWAXPY(residual, -1.0, work, r));
  }
  PetscCall(CycleApplyAMG(pc, adjoint, residual, work));
  PetscCall(VecAXPY(z, 1.0, work));
  PetscFunctionReturn(0);
}

/*
   Applies the cycle fbf, whose error propagation is (I-QA)(I-BA)(I-QA). Let r_1 be the residual after the first Q, and
   y = B r_1. The second Q restricts P^H (r_1 - A y) = P^H r_1 - R y. The term P^H r_1 vanishes only if A_w is solved
   exactly.
*/
static PetscErrorCode CycleApplyFBF(PC pc, PetscBool adjoint, Vec r, Vec z)
{
  PC_AMGF *amgf     = (PC_AMGF *)pc->data;
  Vec      residual = amgf->w[0], work = amgf->w[1];

  PetscFunctionBegin;
  PetscCall(VecCopy(r, residual));
  PetscCall(CycleRestrict(amgf, residual, amgf->rc));
  PetscCall(CycleSolveFilter(pc, adjoint));
  PetscCall(CycleSubtractFiltered(amgf, work, residual));
  PetscCall(CycleApplyAMG(pc, adjoint, residual, z));
  PetscCall(MatMult(amgf->R, z, amgf->wc));
  PetscCall(CycleProlongAdd(amgf, amgf->ec, z));
  PetscCall(CycleRestrict(amgf, residual, amgf->rc));
  PetscCall(VecAXPY(amgf->rc, -1.0, amgf->wc));
  PetscCall(CycleSolveFilter(pc, adjoint));
  PetscCall(CycleProlongAdd(amgf, amgf->ec, z));
  PetscFunctionReturn(0);
}

/* Applies the additive cycle B + Q */
static PetscErrorCode CycleApplyAdditive(PC pc, PetscBool adjoint, Vec r, Vec z)
{
  PC_AMGF *amgf = (PC_AMGF *)pc->data;

  PetscFunctionBegin;
  PetscCall(CycleApplyAMG(pc, adjoint, r, z));
  PetscCall(CycleRestrict(amgf, r, amgf->rc));
  PetscCall(CycleSolveFilter(pc, adjoint));
  PetscCall(CycleProlongAdd(amgf, amgf->ec, z));
  PetscFunctionReturn(0);
}

static PetscErrorCode CycleApplyChosen(PC pc, PetscBool adjoint, Vec r, Vec z)
{
  PC_AMGF *amgf = (PC_AMGF *)pc->data;

  PetscFunctionBegin;
  if (!amgf->active || !amgf->sub.n) PetscCall(CycleApplyAMG(pc, adjoint, r, z));
  else if (amgf->cycle == PC_AMGF_BFB) PetscCall(CycleApplyBFB(pc, adjoint, r, z));
  else if (amgf->cycle == PC_AMGF_FBF) PetscCall(CycleApplyFBF(pc, adjoint, r, z));
  else PetscCall(CycleApplyAdditive(pc, adjoint, r, z));
  PetscFunctionReturn(0);
}

/* Applies the cycle or its adjoint. The set-up is repeated if the subspace has changed since. */
static PetscErrorCode CycleApply(PC pc, PetscBool adjoint, Vec r, Vec z)
{
  PetscBool stale;

  PetscFunctionBegin;
  PetscCall(PCAMGFSubspaceIsStale_Private(pc, &stale));
  if (stale) PetscCall(PCSetUp_AMGF(pc));
  PetscCall(CycleApplyChosen(pc, adjoint, r, z));
  PetscFunctionReturn(0);
}

PetscErrorCode PCApply_AMGF(PC pc, Vec r, Vec z)
{
  PCFailedReason reason;

  PetscFunctionBegin;
  PetscCall(CycleApply(pc, PETSC_FALSE, r, z));
  PetscCall(PCGetFailedReason(pc, &reason));
  PetscCall(VecFlag(z, reason)); /* makes the KSP look at the reason of the failure */
  PetscFunctionReturn(0);
}

PetscErrorCode PCApplyTranspose_AMGF(PC pc, Vec r, Vec z)
{
  Vec conjugate = r;

  PetscFunctionBegin;
  if (PetscDefined(USE_COMPLEX)) {
    PetscCall(VecDuplicate(r, &conjugate));
    PetscCall(VecCopy(r, conjugate));
    PetscCall(VecConjugate(conjugate));
  }
  PetscCall(CycleApply(pc, PETSC_TRUE, conjugate, z));
  PetscCall(CycleConjugate(z));
  if (PetscDefined(USE_COMPLEX)) PetscCall(VecDestroy(&conjugate));
  PetscFunctionReturn(0);
}

/* Finds the function by which the AMG computes B r and A B r at once; NULL if it has none, or if A is not the matrix
   from which the AMG was built */
static PetscErrorCode CycleFindProduct(PC pc, PetscErrorCode (**apply)(PC, Vec, Vec, Vec))
{
  PC_AMGF *amgf = (PC_AMGF *)pc->data;

  PetscFunctionBegin;
  *apply = NULL;
  if (amgf->factor.on || !amgf->lag.built || amgf->lag.age || (amgf->active && amgf->sub.n) || pc->mat != pc->pmat)
    PetscFunctionReturn(0);
  PetscCall(PetscObjectQueryFunction((PetscObject)amgf->amg, "PCBlockAMGApplyProduct_C", apply));
  PetscFunctionReturn(0);
}

PetscErrorCode PCAMGFApplyProduct_AMGF(PC pc, Vec r, Vec z, Vec product)
{
  PC_AMGF *amgf = (PC_AMGF *)pc->data;
  PetscErrorCode (*apply)(PC, Vec, Vec, Vec);

  PetscFunctionBegin;
  PetscCall(CycleFindProduct(pc, &apply));
  if (!apply) {
    PetscCall(PCApply(pc, r, z));
    PetscCall(MatMult(pc->mat, z, product));
    PetscFunctionReturn(0);
  }
  amgf->counts.amg_applies++;
  PetscCall(PetscLogEventBegin(PC_AMGF_AMGApply, pc, r, z, 0));
  PetscCall((*apply)(amgf->amg, r, z, product));
  PetscCall(PetscLogEventEnd(PC_AMGF_AMGApply, pc, r, z, 0));
  PetscFunctionReturn(0);
}

/*@
  PCAMGFApplyProduct - Applies the preconditioner, and multiplies the result by the operator

  Collective

  Input Parameters:
+ pc - the preconditioner, of type `PCAMGF`, which is set up
- r  - the vector to which it is applied

  Output Parameters:
+ z       - the result
- product - the operator times z

  Level: advanced

  Note:
  `PCBLOCKAMG` without a subspace computes the product from its own entries of the operator, which have 16 bits. This
  takes a fraction of the time of `MatMult()`. The difference r - product is accurate to 2 to 4 digits. This suffices
  for a few steps of a Krylov method, but not for a residual that decides on convergence.

.seealso: `PCAMGF`, `PCBLOCKAMG`, `PCApply()`
@*/
PetscErrorCode PCAMGFApplyProduct(PC pc, Vec r, Vec z, Vec product)
{
  PetscFunctionBegin;
  PetscValidHeaderSpecific(pc, PC_CLASSID, 1);
  PetscValidHeaderSpecific(r, VEC_CLASSID, 2);
  PetscValidHeaderSpecific(z, VEC_CLASSID, 3);
  PetscValidHeaderSpecific(product, VEC_CLASSID, 4);
  PetscUseMethod(pc, "PCAMGFApplyProduct_C", (PC, Vec, Vec, Vec), (pc, r, z, product));
  PetscFunctionReturn(0);
}
