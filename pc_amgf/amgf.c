/* The preconditioner type: life cycle, options, set-up, view */
#include "amgfimpl.h"

static PetscErrorCode ReportFailure(PC pc, PC inner)
{
  PCFailedReason reason;

  PetscFunctionBegin;
  PetscCall(PCGetFailedReason(inner, &reason));
  if (reason) PetscCall(PCSetFailedReason(pc, reason));
  PetscFunctionReturn(0);
}

static PetscErrorCode SetUpFilter(PC pc)
{
  PC_AMGF  *amgf = (PC_AMGF *)pc->data;
  PetscBool same;
  PC        inner;

  PetscFunctionBegin;
  if (!amgf->active) PetscFunctionReturn(0);
  PetscCall(PetscLogEventBegin(PC_AMGF_FltSetUp, pc, 0, 0, 0));
  PetscCall(PCAMGFUpdateSubspace_Private(pc, &same));
  if (amgf->sub.n) {
    PetscCall(PCAMGFUpdateGalerkin_Private(pc, same));
    PetscCall(KSPSetErrorIfNotConverged(amgf->filter, pc->erroriffailure));
    /* a factored matrix of another size cannot be replaced in place */
    if (!same) PetscCall(KSPReset(amgf->filter));
    PetscCall(KSPSetOperators(amgf->filter, amgf->Aw, amgf->Aw));
    PetscCall(KSPSetUp(amgf->filter));
    PetscCall(KSPGetPC(amgf->filter, &inner));
    PetscCall(ReportFailure(pc, inner));
    amgf->counts.filter_setups++;
  } else {
    PetscCall(PCAMGFResetGalerkin_Private(amgf));
    PetscCall(KSPReset(amgf->filter));
  }
  PetscCall(PetscLogEventEnd(PC_AMGF_FltSetUp, pc, 0, 0, 0));
  PetscFunctionReturn(0);
}

static PetscErrorCode SetUpAMG(PC pc)
{
  PC_AMGF  *amgf = (PC_AMGF *)pc->data;
  PetscBool rebuild;

  PetscFunctionBegin;
  PetscCall(PCAMGFLagDecide_Private(pc, &rebuild));
  if (rebuild) {
    PetscCall(PetscLogEventBegin(PC_AMGF_AMGSetUp, pc, 0, 0, 0));
    if (pc->dm) PetscCall(PCSetDM(amgf->amg, pc->dm));
    PetscCall(PCSetErrorIfFailure(amgf->amg, pc->erroriffailure));
    PetscCall(PCSetOperators(amgf->amg, pc->mat, pc->pmat));
    PetscCall(PCSetUseAmat(amgf->amg, pc->useAmat));
    PetscCall(PCSetReusePreconditioner(amgf->amg, PETSC_FALSE));
    PetscCall(PCSetUp(amgf->amg));
    /* PCApply() must not rebuild it behind our back when the operator changes in place */
    PetscCall(PCSetReusePreconditioner(amgf->amg, PETSC_TRUE));
    PetscCall(PetscLogEventEnd(PC_AMGF_AMGSetUp, pc, 0, 0, 0));
    PetscCall(PCAMGFLagRebuilt_Private(pc));
    amgf->counts.amg_setups++;
  }
  PetscCall(ReportFailure(pc, amgf->amg));
  PetscFunctionReturn(0);
}

static PetscErrorCode PCSetUp_AMGF(PC pc)
{
  PC_AMGF *amgf = (PC_AMGF *)pc->data;
  PetscInt M, N;

  PetscFunctionBegin;
  PetscCall(MatGetSize(pc->pmat, &M, &N));
  PetscCheck(M == N, PetscObjectComm((PetscObject)pc), PETSC_ERR_ARG_SIZ, "PCAMGF needs a square operator, not one of %" PetscInt_FMT " rows and %" PetscInt_FMT " columns", M, N);
  PetscCall(PCSetFailedReason(pc, PC_NOERROR));
  PetscCall(PCAMGFConfigureInner_Private(pc));
  PetscCall(SetUpFilter(pc));
  PetscCall(SetUpAMG(pc));
  for (size_t i = 0; i < PETSC_STATIC_ARRAY_LENGTH(amgf->w); i++) {
    if (!amgf->w[i]) PetscCall(MatCreateVecs(pc->pmat, &amgf->w[i], NULL));
  }
  PetscFunctionReturn(0);
}

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
  PetscCall(PCAMGFRemoveFunctions_Private(pc));
  PetscCall(PetscFree(pc->data));
  PetscFunctionReturn(0);
}

/* A number or "auto" */
static PetscErrorCode LagFromString(PC pc, const char string[])
{
  PetscBool automatic;
  PetscInt  lag = AMGF_LAG_AUTO;

  PetscFunctionBegin;
  PetscCall(PetscStrcasecmp(string, "auto", &automatic));
  if (!automatic) {
    char *end;

    lag = (PetscInt)strtol(string, &end, 10);
    PetscCheck(end != string && !*end, PetscObjectComm((PetscObject)pc), PETSC_ERR_ARG_WRONG, "-pc_amgf_amg_lag takes a whole number or auto, not \"%s\"", string);
  }
  PetscCall(PCAMGFSetAMGLag(pc, lag));
  PetscFunctionReturn(0);
}

static PetscErrorCode PCSetFromOptions_AMGF(PC pc, AMGFOptionItems PetscOptionsObject)
{
  PC_AMGF    *amgf = (PC_AMGF *)pc->data;
  PCAMGFCycle cycle;
  PetscReal   detect = amgf->detect;
  char        file[PETSC_MAX_PATH_LEN], lag[32];
  PetscBool   flg;

  PetscFunctionBegin;
  PetscOptionsHeadBegin(PetscOptionsObject, "AMG with filter options");
  PetscCall(PetscOptionsEnum("-pc_amgf_cycle", "Order of AMG (b) and filter (f)", "PCAMGFSetCycle", PCAMGFCycles, (PetscEnum)amgf->cycle, (PetscEnum *)&cycle, &flg));
  if (flg) PetscCall(PCAMGFSetCycle(pc, cycle));
  PetscCall(PetscOptionsString("-pc_amgf_filter_file", "Binary file with the IS of filtered unknowns", "PCAMGFSetFilterIS", amgf->file ? amgf->file : "", file, sizeof(file), &flg));
  if (flg) {
    PetscCall(PetscFree(amgf->file));
    PetscCall(ISDestroy(&amgf->file_is));
    if (file[0]) PetscCall(PetscStrallocpy(file, &amgf->file));
  }
  PetscCall(PetscOptionsReal("-pc_amgf_detect", "Filter unknowns whose diagonal entry exceeds this many times the median; 0: off", "PCAMGF", amgf->detect, &detect, NULL));
  PetscCheck(detect >= 0.0, PetscObjectComm((PetscObject)pc), PETSC_ERR_ARG_OUTOFRANGE, "-pc_amgf_detect must be positive, or 0 for off, not %g", (double)detect);
  amgf->detect = detect;
  PetscCall(PetscOptionsString("-pc_amgf_amg_lag", "Rebuild the AMG every so many changed operators; -1: never; 0 or auto: when the cost grows", "PCAMGFSetAMGLag", amgf->cycle == PC_AMGF_BFB ? "1" : "auto", lag, sizeof(lag), &flg));
  if (flg) PetscCall(LagFromString(pc, lag));
  PetscCall(PetscOptionsReal("-pc_amgf_amg_lag_ratio", "Automatic lag: growth of the cost that calls for a rebuild", "PCAMGFSetAMGLag", amgf->lag.ratio, &amgf->lag.ratio, NULL));
  PetscCheck(amgf->lag.ratio >= 1.0, PetscObjectComm((PetscObject)pc), PETSC_ERR_ARG_OUTOFRANGE, "-pc_amgf_amg_lag_ratio must be at least 1, not %g", (double)amgf->lag.ratio);
  PetscOptionsHeadEnd();
  PetscFunctionReturn(0);
}

static PetscErrorCode ViewLag(PC_AMGF *amgf, PetscViewer viewer)
{
  const PetscInt every = PCAMGFLagEvery_Private(amgf), age = amgf->lag.age;

  PetscFunctionBegin;
  if (every > 0) PetscCall(PetscViewerASCIIPrintf(viewer, "  AMG rebuilt every %" PetscInt_FMT " changed operators; age: %" PetscInt_FMT "\n", every, age));
  else if (every == AMGF_LAG_NEVER) PetscCall(PetscViewerASCIIPrintf(viewer, "  AMG never rebuilt; age: %" PetscInt_FMT " changed operators\n", age));
  else PetscCall(PetscViewerASCIIPrintf(viewer, "  AMG rebuilt automatically, ratio %g; age: %" PetscInt_FMT " changed operators\n", (double)amgf->lag.ratio, age));
  PetscFunctionReturn(0);
}

static PetscErrorCode ViewFilter(PC pc, PetscViewer viewer)
{
  static const char *const sources[] = {"none given", "set by call", "composed on the operator", "from a file", "detected"};
  PC_AMGF                 *amgf      = (PC_AMGF *)pc->data;

  PetscFunctionBegin;
  if (!pc->setupcalled) {
    PetscCall(PetscViewerASCIIPrintf(viewer, "  filter: not yet set up\n"));
    PetscFunctionReturn(0);
  }
  if (!amgf->active) PetscCall(PetscViewerASCIIPrintf(viewer, "  filter: switched off, the AMG alone; last dimension %" PetscInt_FMT "\n", amgf->sub.n));
  else PetscCall(PetscViewerASCIIPrintf(viewer, "  filter: %s, dimension %" PetscInt_FMT "%s\n", sources[amgf->sub.source], amgf->sub.n, amgf->sub.n ? "" : ", the AMG alone"));
  if (amgf->sub.source == AMGF_SOURCE_FILE) PetscCall(PetscViewerASCIIPrintf(viewer, "  filter file: %s\n", amgf->file));
  if (amgf->sub.source == AMGF_SOURCE_DETECT) PetscCall(PetscViewerASCIIPrintf(viewer, "  detection: diagonal entries above %g times the median\n", (double)amgf->detect));
  PetscFunctionReturn(0);
}

static PetscErrorCode PCView_AMGF(PC pc, PetscViewer viewer)
{
  PC_AMGF            *amgf   = (PC_AMGF *)pc->data;
  const PCAMGFCounts *counts = &amgf->counts;
  PetscBool           ascii;

  PetscFunctionBegin;
  PetscCall(PetscObjectTypeCompare((PetscObject)viewer, PETSCVIEWERASCII, &ascii));
  if (!ascii) PetscFunctionReturn(0);
  PetscCall(PetscViewerASCIIPrintf(viewer, "  cycle: %s\n", PCAMGFCycles[amgf->cycle]));
  PetscCall(ViewFilter(pc, viewer));
  PetscCall(ViewLag(amgf, viewer));
  PetscCall(PetscViewerASCIIPrintf(viewer, "  so far: %" PetscInt_FMT " AMG set-ups, %" PetscInt_FMT " AMG applications, %" PetscInt_FMT " filter set-ups, %" PetscInt_FMT " filter solves\n", counts->amg_setups, counts->amg_applies, counts->filter_setups, counts->filter_applies));
  PetscCall(PetscViewerASCIIPrintf(viewer, "  AMG:\n"));
  PetscCall(PetscViewerASCIIPushTab(viewer));
  PetscCall(PCView(amgf->amg, viewer));
  PetscCall(PetscViewerASCIIPopTab(viewer));
  if (amgf->active && amgf->sub.n) {
    PetscCall(PetscViewerASCIIPrintf(viewer, "  filter solver:\n"));
    PetscCall(PetscViewerASCIIPushTab(viewer));
    PetscCall(KSPView(amgf->filter, viewer));
    PetscCall(PetscViewerASCIIPopTab(viewer));
  }
  PetscFunctionReturn(0);
}

/*MC
   PCAMGF - algebraic multigrid with a filter: a small subspace is solved exactly, the rest is left to the AMG

   Options Database Keys:
+  -pc_amgf_cycle <fbf>           - `bfb`, `fbf` or `additive`, see `PCAMGFCycle`
.  -pc_amgf_filter_file <file>    - binary file with the `IS` of filtered unknowns
.  -pc_amgf_detect <ratio>        - filter the unknowns whose diagonal entry exceeds this ratio times the median of the positive diagonal entries
.  -pc_amgf_amg_lag <n or auto>   - rebuild the AMG at every n-th changed operator, -1: never, `auto`: when the cost grows; see `PCAMGFSetAMGLag()`
.  -pc_amgf_amg_lag_ratio <1.5>   - growth that calls for a rebuild
.  -amgf_amg_pc_type <hypre>      - the AMG, B; any symmetric `PC`, with all of its options under the prefix `amgf_amg_`
-  -amgf_filter_pc_type <cholesky> - the solver of the filtered system, with all of its options under the prefix `amgf_filter_`

   Level: intermediate

   Notes:
   For symmetric positive definite A (n x n) that multigrid handles well but for a subspace of small dimension n_c, the range of P: contact or penalty rows,
   interface conditions, inclusions of high contrast. With Q = P (P^T A P)^-1 P^T the error is multiplied by (I-BA)(I-QA)(I-BA) in `bfb`, by
   (I-QA)(I-BA)(I-QA) in `fbf`; `additive` is B + Q.

   If A < omega B^-1 with omega < 2, and beta bounds the condition number of BA for the operator without its stiff part, the condition number of `bfb` is at most
   2 (beta + 2 + omega)/(2 - omega). The default AMG has omega = 1. `fbf` and `additive` need no omega: they are positive definite with any positive definite B.

   The subspace, first that is given: `PCAMGFSetFilterIS()` or `PCAMGFSetFilterInterpolation()`; an `IS` or `Mat` composed on the Pmat under "amgf_filter" before the
   set-up; `-pc_amgf_filter_file`; `-pc_amgf_detect`. Without any, or if it is empty, the preconditioner is B.

   The default AMG is BoomerAMG, where PETSc has hypre, with HMIS coarsening, ext+i interpolation of at most 4 entries a row, no aggressive level, one sweep of
   l1 Gauss-Seidel, forward down and backward up, strength threshold 0.25, or 0.7 for block size 3; else `PCGAMG`. The default filter solver is
   `KSPPREONLY` with Cholesky by MUMPS, or by PETSc if MUMPS is missing. What the user sets wins.

   The filter, and the product of A with its corrections, use the rows of the Pmat. The product with the whole matrix in `bfb` uses the Pmat too, unless `PCSetUseAmat()`.

   If the subspace and the nonzero pattern of the operator stay, new values are filled into the old structures and the symbolic factorization is kept.

   The operator may be AIJ, BAIJ or (real scalars) SBAIJ, on any number of ranks, as far as the AMG takes them (`PCHYPRE` takes all three, `PCGAMG` AIJ only).

   The transpose uses the transpose of B, except for BoomerAMG, whose transposed cycle lacks most smoothers: there B is taken to be symmetric.

   If an inner set-up fails, the owner `KSP` ends with `KSP_DIVERGED_PC_FAILED`, or with an error under `-ksp_error_if_not_converged`.

   References:
.  * - S. Petrides, T. Hartland, Tz. Kolev, C. S. Lee, M. Puso, J. Solberg, E. B. Chin, J. Wang, C. Petra, AMG with filtering: an efficient preconditioner for
   interior point methods in large-scale contact mechanics optimization, arXiv:2505.18576, 2025.

.seealso: `PCAMGFSetCycle()`, `PCAMGFSetFilterIS()`, `PCAMGFSetFilterInterpolation()`, `PCAMGFSetAMGLag()`, `PCAMGFSetFilterActive()`, `PCAMGFGetFilterSize()`, `PCAMGFGetAMGPC()`,
          `PCAMGFGetFilterKSP()`, `PCAMGFGetCounts()`, `PCCOMPOSITE`, `PCDEFLATION`
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
  amgf->lag.ratio = 1.5;
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
  PetscCall(PCAMGFComposeFunctions_Private(pc));
  PetscFunctionReturn(0);
}
