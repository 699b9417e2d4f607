/* Creates and destroys the preconditioner PCAMGF, and contains its manual page. */
#include "amgfimpl.h"

static PetscErrorCode PCReset_AMGF(PC pc)
{
  PC_AMGF *amgf = (PC_AMGF *)pc->data;

  PetscFunctionBegin;
  PetscCall(PCReset(amgf->amg));
  PetscCall(PCSetReusePreconditioner(amgf->amg, PETSC_FALSE));
  PetscCall(KSPReset(amgf->filter));
  PetscCall(PCAMGFResetGalerkin_Private(amgf));
  PetscCall(PCAMGFResetSubspace_Private(amgf));
  PetscCall(PCAMGFLagReset_Private(&amgf->lag));
  PetscCall(PCAMGFFactorReset_Private(&amgf->factor));
  PetscCall(ISDestroy(&amgf->file_is));
  PetscCall(ISDestroy(&amgf->detected_is));
  for (size_t i = 0; i < PETSC_STATIC_ARRAY_LENGTH(amgf->w); i++) PetscCall(VecDestroy(&amgf->w[i]));
  PetscFunctionReturn(0);
}

static PetscErrorCode PCDestroy_AMGF(PC pc)
{
  PC_AMGF *amgf = (PC_AMGF *)pc->data;

  PetscFunctionBegin;
  PetscCall(PCReset_AMGF(pc));
  PetscCall(PCDestroy(&amgf->amg));
  PetscCall(KSPDestroy(&amgf->filter));
  PetscCall(ISDestroy(&amgf->set_is));
  PetscCall(MatDestroy(&amgf->set_P));
  PetscCall(PetscFree(amgf->file));
  PetscCall(PCAMGFComposeFunctions_Private(pc, PETSC_FALSE));
  PetscCall(PetscFree(pc->data));
  PetscFunctionReturn(0);
}

/*MC
   PCAMGF - Algebraic multigrid with filtering: an exact solve on a small subspace, and an AMG on the whole space

   Options Database Keys:
+  -pc_amgf_cycle <fbf>             - `bfb`, `fbf` or `additive`, see `PCAMGFCycle`
.  -pc_amgf_filter_file <file>      - binary file with the `IS` of filtered unknowns; by default none
.  -pc_amgf_detect <0>              - filter the unknowns whose diagonal entry exceeds this many times the median of
                                      the positive diagonal entries; 0: off
.  -pc_amgf_amg_lag <auto>          - n: rebuild the AMG at every n-th changed operator; -1: never; 0 or `auto`: when
                                      the cost grows; the cycle `bfb` has the default 1
.  -amgf_amg_pc_type <blockamg>     - the AMG, B; any symmetric `PC`, with all of its options under the prefix
                                      `amgf_amg_`; `hypre`: BoomerAMG with its own cycle
.  -amgf_filter_ksp_type <preonly>  - the Krylov method of the filtered system, with all of its options under the
                                      prefix `amgf_filter_`
.  -amgf_filter_pc_type <cholesky>  - its preconditioner, the direct solver; `lu` with complex scalars; `telescope` on
                                      several ranks
-  -pc_amgf_factor <false>          - `true`: B is a Cholesky factorization of the operator, with the options prefix
                                      `amgf_factor_`; `auto`: if the operator is small, see `PCAMGFSetFactor()`

   Level: intermediate

   Notes:
   The preconditioner is for symmetric (or complex Hermitian) positive definite A (n x n) for which multigrid converges
   well except on a subspace of small dimension n_c, the range of P. Examples: contact or penalty rows, interface
   conditions, inclusions of high contrast. Let Q = P (P^T A P)^-1 P^T. The error is multiplied by
   (I-BA)(I-QA)(I-BA) in `bfb`, and by (I-QA)(I-BA)(I-QA) in `fbf`. `additive` is B + Q. With complex scalars, P^T
   stands for the conjugate transpose.

   Let A < omega B^-1 with omega < 2, and let beta bound the condition number of BA for the operator without its stiff
   part. Then the condition number of `bfb` is at most 2 (beta + 2 + omega)/(2 - omega). The default AMG has omega = 1,
   to the rounding errors of its precision. `fbf` and `additive` need no omega: they are positive definite with any
   positive definite B.

   The subspace is the first of these that is given: `PCAMGFSetFilterIS()` or `PCAMGFSetFilterInterpolation()`; an `IS`
   or `Mat` composed on the Pmat under "amgf_filter" (if it is composed after the set-up, the next application uses it);
   `-pc_amgf_filter_file`; `-pc_amgf_detect`. Without a subspace, or if it is empty, the preconditioner is B. If no
   subspace was given or detected, one warning is printed; `PCAMGFSetFilterOptional()` turns it off.

   If PETSc has hypre, the default AMG has the hierarchy of hypre's BoomerAMG: HMIS coarsening, ext+i interpolation of
   at most 4 entries per row, no aggressive level, strength threshold 0.25, or 0.7 for block size 3. Its V-cycle has one
   sweep of Gauss-Seidel, forward on the way down and backward on the way up. With real scalars and an operator of type
   AIJ, BAIJ or SBAIJ this is `PCBLOCKAMG`, in single precision. hypre's own cycle, in double precision and with l1
   Gauss-Seidel, is used instead in four cases: with other matrix types; if positive diagonal entries of coupled rows
   differ by a factor of more than 1e7 (`bfb`: 1e4), which is too large for single precision; with
   `-amgf_amg_pc_type hypre`, for example because the Krylov method is pipelined; and if an option of hypre's own cycle
   is given, for example `-amgf_amg_pc_hypre_boomeramg_relax_type_all`.

   Without hypre the default AMG is `PCGAMG`. With complex scalars its interpolation is not smoothed: the restriction of
   `PCGAMG` is the transpose without conjugation, and B would not be Hermitian.

   The default filter solver is `KSPPREONLY` with a Cholesky factorization by MUMPS, or LU with complex scalars. On
   several ranks it is inside a `PCTELESCOPE`, so that one rank for every 10,000 rows solves; the options of the
   factorization then have the prefix `amgf_filter_telescope_`. If PETSc has no MUMPS, its own factorization is used, on
   several ranks redundantly on every rank (`PCREDUNDANT`). Options set by the user take precedence.

   The filter, and the product of A with its corrections, use the rows of the Pmat. The product with the whole matrix
   in `bfb` uses the Pmat too, unless `PCSetUseAmat()`.

   If the subspace and the nonzero pattern of the operator do not change, matrices and symbolic factorization are
   reused.

   The operator may be AIJ, BAIJ or (real scalars) SBAIJ, on any number of ranks, if the AMG supports the type
   (`PCHYPRE` supports all three, `PCGAMG` AIJ only).

   `PCApplyTranspose()` uses the transpose of B. For BoomerAMG, whose transposed cycle does not support most smoothers,
   B is assumed to be symmetric.

   If an inner set-up fails, the owner `KSP` ends with `KSP_DIVERGED_PC_FAILED`, or with an error under
   `-ksp_error_if_not_converged`.

   References:
.  * - S. Petrides, T. Hartland, Tz. Kolev, C. S. Lee, M. Puso, J. Solberg, E. B. Chin, J. Wang, C. Petra, AMG with
         filtering: an efficient preconditioner for interior point methods in large-scale contact mechanics
         optimization, arXiv:2505.18576, 2025.

.seealso: `PCAMGFSetCycle()`, `PCAMGFSetFilterIS()`, `PCAMGFSetFilterInterpolation()`, `PCAMGFSetAMGLag()`,
          `PCAMGFSetFilterActive()`, `PCAMGFSetFilterOptional()`, `PCAMGFGetFilterSize()`, `PCAMGFGetAMGPC()`,
          `PCAMGFGetFilterKSP()`, `PCAMGFGetFilterPivots()`, `PCAMGFGetCounts()`,
          `PCAMGFSetFactor()`, `PCAMGFGetFactored()`, `PCAMGFReconsiderFactor()`, `PCAMGFGetAMGAge()`, `PCBLOCKAMG`,
          `PCCOMPOSITE`, `PCDEFLATION`
M*/
PetscErrorCode PCCreate_AMGF(PC pc)
{
  PC_AMGF *amgf;

  PetscFunctionBegin;
  PetscCall(PetscNew(&amgf));
  pc->data        = amgf;
  amgf->cycle     = PC_AMGF_FBF;
  amgf->active    = PETSC_TRUE;
  amgf->lag.every = AMGF_LAG_UNSET;
  PetscCall(PCCreate(PetscObjectComm((PetscObject)pc), &amgf->amg));
  PetscCall(PetscObjectIncrementTabLevel((PetscObject)amgf->amg, (PetscObject)pc, 1));
  PetscCall(KSPCreate(PetscObjectComm((PetscObject)pc), &amgf->filter));
  PetscCall(PetscObjectIncrementTabLevel((PetscObject)amgf->filter, (PetscObject)pc, 1));

  pc->ops->setup          = PCSetUp_AMGF;
  pc->ops->apply          = PCApply_AMGF;
  pc->ops->applytranspose = PCApplyTranspose_AMGF;
  pc->ops->presolve       = PCPreSolve_AMGF;
  pc->ops->postsolve      = PCPostSolve_AMGF;
  pc->ops->setfromoptions = PCSetFromOptions_AMGF;
  pc->ops->view           = PCView_AMGF;
  pc->ops->reset          = PCReset_AMGF;
  pc->ops->destroy        = PCDestroy_AMGF;
  PetscCall(PCAMGFComposeFunctions_Private(pc, PETSC_TRUE));
  PetscFunctionReturn(0);
}
