/* The preconditioner type PCBLOCKAMG: manual page, creation, destruction */
#include "blockamgimpl.h"

static PetscErrorCode PCReset_BlockAMG(PC pc)
{
  PC_BlockAMG *amg = (PC_BlockAMG *)pc->data;

  PetscFunctionBegin;
  PetscCall(PCDestroy(&amg->hypre));
  PetscCall(BlockHierarchyDestroy_Private(&amg->h));
  amg->why[0] = '\0';
  PetscFunctionReturn(0);
}

static PetscErrorCode PCDestroy_BlockAMG(PC pc)
{
  PetscFunctionBegin;
  PetscCall(PetscObjectComposeFunction((PetscObject)pc, "PCBlockAMGApplyProduct_C", NULL));
  PetscCall(PCReset_BlockAMG(pc));
  PetscCall(PetscFree(pc->data));
  PetscFunctionReturn(0);
}

/*MC
   PCBLOCKAMG - A fast V-cycle on the hierarchy of hypre's BoomerAMG, in dense blocks of 16-bit numbers

   Options Database Keys:
.  -pc_hypre_boomeramg_ - options of `PCHYPRE` for the set-up; those of hypre's own cycle have no effect

   Level: intermediate

   Notes:
   For real symmetric positive definite operators of type AIJ, BAIJ or SBAIJ, on any number of ranks. PETSc must have
   hypre.

   hypre sets up the matrices and interpolations, with the defaults that `PCAMGF` documents. It gets the operator
   without the entries below 1e-13 sqrt(a_ii a_jj), which are rounding errors; entries in columns of other ranks are
   kept. The levels are converted one after the other, and hypre's copy is freed. Each level is scaled to a diagonal
   of ones. It holds the strictly lower triangle L of A = L + D + L^T, and the inverses of the diagonal blocks in
   single precision: blocks of 3 x 3 on the finest level where the block size of the matrix is a multiple of 3, else
   of 4 x 4. An entry of L is a 16-bit integer times a unit for its row. Of two coupled unknowns whose diagonal
   entries differ by a factor of more than 4096, the stiffer one has its entries of L in single precision. The cycle
   has one forward Gauss-Seidel sweep down and one backward sweep up. A row of L is used for both the sweep and the
   residual while it is in the cache, so a cycle reads half of every matrix twice. Levels of at most 256 unknowns are
   solved by a dense inverse.

   With several ranks each rank sweeps over its own rows. Let a be the sum of the absolute entries of a row in columns
   of other ranks, and g the excess of its diagonal entry over the other absolute entries of its diagonal block. Then
   max(a/4, (a - 0.9 g)/2) is added to the diagonal entry.

   The preconditioner is symmetric to the rounding errors of single precision, and positive definite. `KSPCG` with it
   attains the same residuals as with one in double precision. Pipelined methods, such as `KSPPIPECG` and `KSPGROPPCG`,
   do not: they replace applications by recurrences, which hold for a linear preconditioner only, and this one is linear
   to 1e-7. Use `PCHYPRE` with them. Matrices and vectors are scaled by powers of 2, so units have no influence. If
   coupled rows differ in stiffness by a factor of 1e7, the contribution of the soft rows is lost in rounding: use
   `PCHYPRE` for such operators. Only the lower triangle is used on each rank. An
   operator that is not symmetric, such as one whose rows of prescribed values keep their columns, is found once for
   each pattern; hypre's own cycle is used for it.

   For an indefinite operator, negative eigenvalues of diagonal blocks are replaced by their absolute values: `KSPCG`
   then ends with `KSP_DIVERGED_INDEFINITE_MAT`, or with `KSP_DIVERGED_NANORINF` if the cycle diverges beyond the range
   of single precision. A diagonal entry of zero, or one that is not finite, makes the set-up fail:
   `KSP_DIVERGED_PC_FAILED`, or an error under `-ksp_error_if_not_converged`.

.seealso: `PCAMGF`, `PCHYPRE`, `PCGAMG`, `KSPCG`
M*/
PetscErrorCode PCCreate_BlockAMG(PC pc)
{
  PC_BlockAMG *amg;

  PetscFunctionBegin;
  PetscCheck(PetscDefined(HAVE_HYPRE), PetscObjectComm((PetscObject)pc), PETSC_ERR_SUP,
    "PCBLOCKAMG needs a PETSc with hypre, which sets up its hierarchy");
  PetscCall(PetscNew(&amg));
  pc->data                = amg;
  pc->ops->setup          = PCSetUp_BlockAMG;
  pc->ops->apply          = PCApply_BlockAMG;
  pc->ops->applytranspose = PCApplyTranspose_BlockAMG;
  pc->ops->view           = PCView_BlockAMG;
  pc->ops->reset          = PCReset_BlockAMG;
  pc->ops->destroy        = PCDestroy_BlockAMG;
  PetscCall(PetscObjectComposeFunction((PetscObject)pc, "PCBlockAMGApplyProduct_C", PCBlockAMGApplyProduct_BlockAMG));
  PetscFunctionReturn(0);
}
