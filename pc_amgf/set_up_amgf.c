/*
   Sets up the inner solvers, the subspace, R and A_w, the factorization of A_w, and B (the AMG, or the factorization of
   the operator) if B is due
*/
#include "amgfimpl.h"
#include "guard.h"

static PetscErrorCode SetUpCheckInner(PC pc, PC inner)
{
  PCFailedReason reason;

  PetscFunctionBegin;
  PetscCall(PCGetFailedReason(inner, &reason));
  if (reason) PetscCall(PCSetFailedReason(pc, reason));
  PetscFunctionReturn(0);
}

/*
   Prints a warning, once, if there is no filter. Without it the preconditioner still works but takes more iterations,
   so that the user would not notice a forgotten filter.
*/
static PetscErrorCode SetUpWarn(PC pc)
{
  PC_AMGF         *amgf   = (PC_AMGF *)pc->data;
  const AMGFSource source = amgf->sub.source;

  PetscFunctionBegin;
  if (amgf->sub.n || amgf->optional || amgf->warned || (source != AMGF_SOURCE_NONE && source != AMGF_SOURCE_DETECT))
    PetscFunctionReturn(0);
  amgf->warned = PETSC_TRUE;
  if (source == AMGF_SOURCE_DETECT)
    PetscCall(PetscFPrintf(PetscObjectComm((PetscObject)pc), PETSC_STDERR,
      "Warning: PCAMGF runs without a filter: no diagonal entry exceeds %g times the median, see -pc_amgf_detect\n",
      (double)amgf->detect));
  else
    PetscCall(PetscFPrintf(PetscObjectComm((PetscObject)pc), PETSC_STDERR,
      "Warning: PCAMGF runs without a filter, because none was named: compose an IS or a Mat on the matrix under "
      "\"%s\", or see -pc_amgf_filter_file, -pc_amgf_detect\n",
      PCAMGF_FILTER_KEY));
  PetscFunctionReturn(0);
}

/* Sets up the solver of the filtered system. After a failure MUMPS does not factor again. A solver whose last set-up
   failed is therefore reset first. same: the filtered system has the same rows as before */
static PetscErrorCode SetUpFilterSolver(PC pc, PetscBool same)
{
  PC_AMGF       *amgf = (PC_AMGF *)pc->data;
  PCFailedReason last;
  PetscBool      renew;
  PC             inner;

  PetscFunctionBegin;
  PetscCall(KSPSetErrorIfNotConverged(amgf->filter, pc->erroriffailure));
  PetscCall(KSPGetPC(amgf->filter, &inner));
  PetscCall(PCGetFailedReason(inner, &last));
  renew = (PetscBool)(!same || last); /* a matrix of another size needs new factors, too */
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &renew, 1, MPI_PETSCBOOL, MPI_LOR, PetscObjectComm((PetscObject)pc)));
  if (renew) PetscCall(PCAMGFDirectRenew_Private(amgf->filter));
  PetscCall(PCAMGFDirectSetUp_Private(amgf->filter, amgf->Aw));
  PetscCall(KSPGetPC(amgf->filter, &inner));
  PetscCall(SetUpCheckInner(pc, inner));
  PetscFunctionReturn(0);
}

static PetscErrorCode SetUpFilter(PC pc)
{
  PC_AMGF  *amgf = (PC_AMGF *)pc->data;
  PetscBool same;

  PetscFunctionBegin;
  if (!amgf->active) PetscFunctionReturn(0);
  PetscCall(PetscLogEventBegin(PC_AMGF_FltSetUp, pc, 0, 0, 0));
  PetscCall(PCAMGFUpdateSubspace_Private(pc, &same));
  if (amgf->sub.n) {
    PetscCall(PCAMGFUpdateGalerkin_Private(pc, same));
    PetscCall(SetUpFilterSolver(pc, same));
    amgf->counts.filter_setups++;
  } else {
    PetscCall(SetUpWarn(pc));
    PetscCall(PCAMGFResetGalerkin_Private(amgf));
    PetscCall(KSPReset(amgf->filter));
  }
  PetscCall(PetscLogEventEnd(PC_AMGF_FltSetUp, pc, 0, 0, 0));
  PetscFunctionReturn(0);
}

/*
   Sets up the AMG. A library error, e.g. because of a zero row, may occur on one rank only, and every later call to the
   library would report it again. If one occurs, *failed is true on all ranks and the AMG is reset.
*/
static PetscErrorCode SetUpGuardAMG(PC pc, PetscBool *failed)
{
  PC_AMGF       *amgf = (PC_AMGF *)pc->data;
  AMGFGuard      guard;
  PetscErrorCode error;

  PetscFunctionBegin;
  PetscCall(PCAMGFGuardBegin_Private(&guard, NULL));
  error = PCSetUp(amgf->amg);
  PetscCall(PCAMGFGuardEnd_Private(&guard, error, failed));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, failed, 1, MPI_PETSCBOOL, MPI_LOR, PetscObjectComm((PetscObject)pc)));
  if (!*failed) PetscFunctionReturn(0);
  PetscCheck(!pc->erroriffailure, PetscObjectComm((PetscObject)pc), PETSC_ERR_NOT_CONVERGED,
    "The set-up of the AMG failed: %s", guard.why);
  PetscCall(PetscInfo(pc, "Error in the set-up of the AMG: %s\n", guard.why));
  PetscCall(PCReset(amgf->amg));
  PetscFunctionReturn(0);
}

/*
   Selects PCBLOCKAMG (single precision) if the contrast of the diagonal entries is small enough, and BoomerAMG
   otherwise.
   Rounding a stiff row to single precision changes the operator by 6e-8 of the row's entries. This must be small
   compared with soft rows: at a contrast of 1e9, CG with PCBLOCKAMG does not converge.
   The limit for the cycle bfb is lower, since bfb needs A < 2 B^-1. With stiff ties, for which A < B^-1 in exact
   arithmetic, a contrast of 1e4 gives A < 1.001 B^-1, and a contrast of 1e5 gives A < 1.6 B^-1.
*/
static PetscErrorCode SetUpChooseAMG(PC pc)
{
  const PC_AMGF  *amgf    = (PC_AMGF *)pc->data;
  const PetscReal largest = amgf->cycle == PC_AMGF_BFB ? 1e4 : 1e7;
  PetscReal       contrast;

  PetscFunctionBegin;
  if (!amgf->bydefault) PetscFunctionReturn(0);
  PetscCall(PCAMGFFindContrast_Private(pc->pmat, PETSC_FALSE, &contrast));
  if (contrast > largest) PetscCall(PCAMGFFindContrast_Private(pc->pmat, PETSC_TRUE, &contrast));
  PetscCall(PCAMGFSetBlockAMG_Private(pc, (PetscBool)(contrast <= largest)));
  PetscFunctionReturn(0);
}

static PetscErrorCode SetUpAMG(PC pc, PetscBool *failed)
{
  PC_AMGF  *amgf = (PC_AMGF *)pc->data;
  DM        dm;
  PetscBool use_amat;

  PetscFunctionBegin;
  PetscCall(SetUpChooseAMG(pc));
  PetscCall(PCGetDM(pc, &dm));
  if (dm) PetscCall(PCSetDM(amgf->amg, dm));
  PetscCall(PCGetUseAmat(pc, &use_amat));
  PetscCall(PCSetErrorIfFailure(amgf->amg, pc->erroriffailure));
  PetscCall(PCSetOperators(amgf->amg, pc->mat, pc->pmat));
  PetscCall(PCSetUseAmat(amgf->amg, use_amat));
  PetscCall(PCSetReusePreconditioner(amgf->amg, PETSC_FALSE));
  PetscCall(SetUpGuardAMG(pc, failed));
  /* PCApply() must not rebuild the AMG when the values of the operator change. */
  PetscCall(PCSetReusePreconditioner(amgf->amg, PETSC_TRUE));
  PetscFunctionReturn(0);
}

/* Sets up B if the lag requires it, and reports a failure of B in the PC's failed reason */
static PetscErrorCode SetUpWhole(PC pc)
{
  PC_AMGF    *amgf   = (PC_AMGF *)pc->data;
  AMGFFactor *factor = &amgf->factor;
  PetscBool   rebuild, broken = PETSC_FALSE;

  PetscFunctionBegin;
  PetscCall(PCAMGFLagDecide_Private(pc, &rebuild));
  if (rebuild) {
    PetscCall(PetscLogEventBegin(PC_AMGF_AMGSetUp, pc, 0, 0, 0));
    factor->failed  = PETSC_FALSE;
    factor->applies = amgf->counts.amg_applies;
    PetscCall(PCAMGFFactorIsUsed_Private(pc, &factor->on));
    if (factor->on) PetscCall(PCAMGFFactorSetUp_Private(pc));
    PetscCall(PCAMGFFactorIsUsed_Private(pc, &factor->on));
    if (!factor->on) PetscCall(SetUpAMG(pc, &broken));
    PetscCall(PetscLogEventEnd(PC_AMGF_AMGSetUp, pc, 0, 0, 0));
    if (broken) PetscCall(PCAMGFLagReset_Private(&amgf->lag));
    else PetscCall(PCAMGFLagRebuilt_Private(pc));
    amgf->counts.amg_setups++;
  }
  if (broken) PetscCall(PCSetFailedReason(pc, PC_SUBPC_ERROR));
  else if (!factor->on) PetscCall(SetUpCheckInner(pc, amgf->amg));
  else if (factor->failed) PetscCall(PCSetFailedReason(pc, PC_FACTOR_OTHER));
  PetscFunctionReturn(0);
}

PetscErrorCode PCSetUp_AMGF(PC pc)
{
  PC_AMGF  *amgf = (PC_AMGF *)pc->data;
  PetscInt  M, N;
  PetscBool has;

  PetscFunctionBegin;
  PetscCall(MatGetSize(pc->pmat, &M, &N));
  PetscCheck(M == N, PetscObjectComm((PetscObject)pc), PETSC_ERR_ARG_SIZ,
    "PCAMGF needs a square operator, not one of %" PetscInt_FMT " rows and %" PetscInt_FMT " columns", M, N);
  PetscCall(MatHasOperation(pc->pmat, MATOP_GET_DIAGONAL, &has));
  PetscCheck(has, PetscObjectComm((PetscObject)pc), PETSC_ERR_SUP,
    "PCAMGF needs the operator's entries, but an operator of type %s has none: pass a matrix that has them as the "
    "second one to KSPSetOperators()",
    ((PetscObject)pc->pmat)->type_name);
  PetscCall(PCSetFailedReason(pc, PC_NOERROR));
  PetscCall(PCAMGFConfigureInner_Private(pc));
  PetscCall(SetUpFilter(pc));
  PetscCall(SetUpWhole(pc));
  for (size_t i = 0; i < PETSC_STATIC_ARRAY_LENGTH(amgf->w); i++) {
    if (!amgf->w[i]) PetscCall(MatCreateVecs(pc->pmat, &amgf->w[i], NULL));
  }
  PetscFunctionReturn(0);
}
