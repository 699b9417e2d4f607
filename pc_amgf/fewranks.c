/*
   Solves systems with A_w, the matrix on the filtered subspace, on the first few ranks only. A_w is small: on all ranks
   communication would take longer than arithmetic. The filter's KSP gets a PCSHELL, which sends A_w and the vectors to
   those ranks. The direct solver on those ranks has the options prefix of the filter.
*/
#include "amgfimpl.h"
#include "mumps.h"

/* Moves A_w to the solving ranks: few->A. reuse: only the values have changed. */
static PetscErrorCode FewRanksMoveMatrix(AMGFFewRanks *few, Mat Aw, PetscBool reuse)
{
  const MatReuse call = reuse ? MAT_REUSE_MATRIX : MAT_INITIAL_MATRIX;
  PetscInt       n, first;
  IS             rows;

  PetscFunctionBegin;
  PetscCall(VecGetLocalSize(few->spread, &n));
  PetscCall(VecGetOwnershipRange(few->spread, &first, NULL));
  PetscCall(ISCreateStride(PetscObjectComm((PetscObject)Aw), n, first, 1, &rows));
  PetscCall(MatCreateSubMatrix(Aw, rows, rows, call, &few->gathered));
  PetscCall(ISDestroy(&rows));
  PetscCall(MatMPIAIJGetLocalMat(few->gathered, call, &few->rows));
  if (few->solves) {
    PetscCall(MatCreateMPIMatConcatenateSeqMat(few->comm, few->rows, n, call, &few->A));
    PetscCall(MatSetOption(few->A, PetscDefined(USE_COMPLEX) ? MAT_HERMITIAN : MAT_SPD, PETSC_TRUE));
  }
  PetscFunctionReturn(0);
}

/* Creates the vectors on the solving ranks, and the scatter from vectors of A_w to them */
static PetscErrorCode FewRanksCreateVecs(AMGFFewRanks *few, Mat Aw)
{
  const MPI_Comm comm = PetscObjectComm((PetscObject)Aw);
  PetscInt       n, N, first;
  PetscMPIInt    rank;
  Vec            whole;
  IS             all;

  PetscFunctionBegin;
  PetscCallMPI(MPI_Comm_rank(comm, &rank));
  PetscCall(MatGetSize(Aw, &N, NULL));
  n = few->solves ? N / few->nranks + (rank < N % few->nranks) : 0;
  PetscCall(VecCreateMPI(comm, n, N, &few->spread));
  PetscCall(VecGetOwnershipRange(few->spread, &first, NULL));
  PetscCall(ISCreateStride(comm, n, first, 1, &all));
  PetscCall(MatCreateVecs(Aw, &whole, NULL));
  PetscCall(VecScatterCreate(whole, all, few->spread, all, &few->scatter));
  PetscCall(ISDestroy(&all));
  PetscCall(VecDestroy(&whole));
  if (few->solves) PetscCall(VecCreateMPI(few->comm, n, N, &few->b));
  if (few->solves) PetscCall(VecDuplicate(few->b, &few->x));
  PetscFunctionReturn(0);
}

/* PCAMGFFewRanksReset_Private - frees the solver and its communicator, but not the requested number of ranks */
PetscErrorCode PCAMGFFewRanksReset_Private(AMGFFewRanks *few)
{
  PetscFunctionBegin;
  PetscCall(PCDestroy(&few->pc));
  PetscCall(MatDestroy(&few->A));
  PetscCall(MatDestroy(&few->rows));
  PetscCall(MatDestroy(&few->gathered));
  PetscCall(VecDestroy(&few->spread));
  PetscCall(VecDestroy(&few->b));
  PetscCall(VecDestroy(&few->x));
  PetscCall(VecScatterDestroy(&few->scatter));
  if (few->nranks) PetscCallMPI(MPI_Comm_free(&few->comm));
  few->nranks = 0;
  few->stamp  = (AMGFStamp){.id = 0};
  PetscFunctionReturn(0);
}

/*
   Chooses the number of solving ranks: the number that the user requested, or one more per 10,000 rows. With fewer rows
   per rank, fewer ranks are faster.
*/
static PetscErrorCode FewRanksChoose(const AMGFFewRanks *few, Mat Aw, PetscMPIInt *nranks)
{
  const PetscInt rows_per_rank = 10000;
  PetscInt       N, wanted;
  PetscMPIInt    size;

  PetscFunctionBegin;
  PetscCallMPI(MPI_Comm_size(PetscObjectComm((PetscObject)Aw), &size));
  PetscCall(MatGetSize(Aw, &N, NULL));
  wanted  = few->wanted ? few->wanted : 1 + N / rows_per_rank;
  *nranks = (PetscMPIInt)PetscMin(wanted, size);
  PetscFunctionReturn(0);
}

static PetscErrorCode FewRanksCreate(PC shell, Mat Aw, PetscMPIInt nranks, AMGFFewRanks *few)
{
  const MPI_Comm comm = PetscObjectComm((PetscObject)shell);
  PetscMPIInt    rank, size;
  PetscBool      mumps;
  const char    *prefix;

  PetscFunctionBegin;
  PetscCall(PCAMGFFewRanksReset_Private(few));
  PetscCallMPI(MPI_Comm_rank(comm, &rank));
  PetscCallMPI(MPI_Comm_size(comm, &size));
  few->nranks = nranks;
  few->solves = rank < nranks ? PETSC_TRUE : PETSC_FALSE;
  PetscCallMPI(MPI_Comm_split(comm, few->solves ? 0 : 1, rank, &few->comm));
  if (nranks < size) PetscCall(FewRanksCreateVecs(few, Aw));
  if (!few->solves) PetscFunctionReturn(0);
  PetscCall(PCCreate(nranks < size ? few->comm : comm, &few->pc));
  PetscCall(PetscObjectIncrementTabLevel((PetscObject)few->pc, (PetscObject)shell, 1));
  PetscCall(PCGetOptionsPrefix(shell, &prefix));
  PetscCall(PCSetOptionsPrefix(few->pc, prefix));
  PetscCall(PCAMGFSetDirectSolver_Private(few->pc, &mumps));
  PetscCall(PCSetFromOptions(few->pc));
  PetscFunctionReturn(0);
}

/* Collective. If the solver failed on one of the solving ranks, marks the PC as failed on all ranks. */
static PetscErrorCode FewRanksShareFailure(PC shell, const AMGFFewRanks *few)
{
  PCFailedReason reason = PC_NOERROR;
  int            code;

  PetscFunctionBegin;
  if (few->pc) PetscCall(PCGetFailedReason(few->pc, &reason));
  code = (int)reason;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &code, 1, MPI_INT, MPI_MAX, PetscObjectComm((PetscObject)shell)));
  PetscCheck(!code || !shell->erroriffailure, PetscObjectComm((PetscObject)shell), PETSC_ERR_NOT_CONVERGED,
    "The factorization of the matrix on the filtered subspace failed: %s", PCFailedReasons[code]);
  PetscCall(PCSetFailedReason(shell, (PCFailedReason)code));
  PetscFunctionReturn(0);
}

static PetscErrorCode FewRanksSetUp(PC shell)
{
  AMGFFewRanks *few;
  AMGFStamp     now;
  PetscMPIInt   nranks;
  PetscBool     reuse;
  Mat           Aw;

  PetscFunctionBegin;
  PetscCall(PCShellGetContext(shell, &few));
  PetscCall(PCGetOperators(shell, NULL, &Aw));
  PetscCall(MatGetStamp_AMGF(Aw, &now));
  PetscCall(FewRanksChoose(few, Aw, &nranks));
  reuse = (PetscBool)(nranks == few->nranks && AMGFStampSamePattern(&now, &few->stamp));
  if (!reuse) PetscCall(FewRanksCreate(shell, Aw, nranks, few));
  few->stamp = now;
  if (few->spread) PetscCall(FewRanksMoveMatrix(few, Aw, reuse));
  if (few->pc) {
    PetscCall(PCSetOperators(few->pc, few->spread ? few->A : Aw, few->spread ? few->A : Aw));
    PetscCall(PCSetUp(few->pc));
  }
  PetscCall(FewRanksShareFailure(shell, few));
  PetscFunctionReturn(0);
}

/* Computes x = A_w^-1 r (or A_w^-T r). apply: PCApply() or PCApplyTranspose(). */
static PetscErrorCode FewRanksSolve(PC shell, PetscErrorCode (*apply)(PC, Vec, Vec), Vec r, Vec x)
{
  AMGFFewRanks *few;
  PetscScalar  *array;

  PetscFunctionBegin;
  PetscCall(PCShellGetContext(shell, &few));
  if (!few->spread) {
    PetscCall(apply(few->pc, r, x));
    PetscFunctionReturn(0);
  }
  PetscCall(VecScatterBegin(few->scatter, r, few->spread, INSERT_VALUES, SCATTER_FORWARD));
  PetscCall(VecScatterEnd(few->scatter, r, few->spread, INSERT_VALUES, SCATTER_FORWARD));
  if (few->solves) {
    PetscCall(VecGetArray(few->spread, &array));
    PetscCall(VecPlaceArray(few->b, array));
    PetscCall(apply(few->pc, few->b, few->x));
    PetscCall(VecCopy(few->x, few->b));
    PetscCall(VecResetArray(few->b));
    PetscCall(VecRestoreArray(few->spread, &array));
  }
  PetscCall(VecScatterBegin(few->scatter, few->spread, x, INSERT_VALUES, SCATTER_REVERSE));
  PetscCall(VecScatterEnd(few->scatter, few->spread, x, INSERT_VALUES, SCATTER_REVERSE));
  PetscFunctionReturn(0);
}

static PetscErrorCode FewRanksApply(PC shell, Vec r, Vec x)
{
  PetscFunctionBegin;
  PetscCall(FewRanksSolve(shell, PCApply, r, x));
  PetscFunctionReturn(0);
}

static PetscErrorCode FewRanksApplyTranspose(PC shell, Vec r, Vec x)
{
  PetscFunctionBegin;
  PetscCall(FewRanksSolve(shell, PCApplyTranspose, r, x));
  PetscFunctionReturn(0);
}

static PetscErrorCode FewRanksView(PC shell, PetscViewer viewer)
{
  AMGFFewRanks *few;
  PetscViewer   sub;

  PetscFunctionBegin;
  PetscCall(PCShellGetContext(shell, &few));
  if (!few->nranks) PetscFunctionReturn(0);
  PetscCall(PetscViewerASCIIPrintf(viewer, "  ranks that solve: %d\n", few->nranks));
  PetscCall(PetscViewerGetSubViewer(viewer, few->comm, &sub));
  if (few->pc) PetscCall(PCView(few->pc, sub));
  PetscCall(PetscViewerRestoreSubViewer(viewer, few->comm, &sub));
  PetscFunctionReturn(0);
}

/* PCAMGFFewRanksBegin_Private - configures a PC that has no type yet to solve on the first few ranks */
PetscErrorCode PCAMGFFewRanksBegin_Private(PC pc, AMGFFewRanks *few)
{
  PetscFunctionBegin;
  PetscCall(PCSetType(pc, PCSHELL));
  PetscCall(PCShellSetName(pc, "the filtered system on the first few ranks"));
  PetscCall(PCShellSetContext(pc, few));
  PetscCall(PCShellSetSetUp(pc, FewRanksSetUp));
  PetscCall(PCShellSetApply(pc, FewRanksApply));
  PetscCall(PCShellSetApplyTranspose(pc, FewRanksApplyTranspose));
  PetscCall(PCShellSetView(pc, FewRanksView));
  PetscFunctionReturn(0);
}

PetscErrorCode PCAMGFSetFilterRanks_AMGF(PC pc, PetscInt n)
{
  AMGFFewRanks *few = &((PC_AMGF *)pc->data)->few;

  PetscFunctionBegin;
  PetscCheck(n >= 0, PetscObjectComm((PetscObject)pc), PETSC_ERR_ARG_OUTOFRANGE,
    "-pc_amgf_filter_ranks must be positive, or 0 for as many as the size asks for, not %" PetscInt_FMT, n);
  few->wanted = n;
  PetscFunctionReturn(0);
}

PetscErrorCode PCAMGFGetFilterPivots_AMGF(PC pc, PetscInt *negative)
{
  PC_AMGF      *amgf   = (PC_AMGF *)pc->data;
  PetscBool     known  = PETSC_FALSE;
  MatSolverType solver = NULL;
  Mat           F;
  PC            inner;

  PetscFunctionBegin;
  *negative = -1;
  if (amgf->factor.on && amgf->factor.F) {
    *negative = 0; /* factors of cholesky/ exist of positive definite operators only */
    if (!amgf->factor.own) PetscCall(AMGFMumpsGetInfog(amgf->factor.F, 12, negative));
    PetscFunctionReturn(0);
  }
  PetscCall(KSPGetPC(amgf->filter, &inner));
  if (amgf->few.nranks) inner = amgf->few.pc;
  if (inner && amgf->Aw) PetscCall(PetscObjectTypeCompare((PetscObject)inner, PCCHOLESKY, &known));
  if (known) PetscCall(PCFactorGetMatSolverType(inner, &solver));
  if (known) PetscCall(PetscStrcmp(solver, MATSOLVERMUMPS, &known));
  if (known) {
    PetscCall(PCFactorGetMatrix(inner, &F));
    PetscCall(AMGFMumpsGetInfog(F, 12, negative));
  }
  PetscCallMPI(MPI_Bcast(negative, 1, MPIU_INT, 0, PetscObjectComm((PetscObject)pc)));
  PetscFunctionReturn(0);
}

/*@
  PCAMGFSetFilterRanks - Sets how many ranks solve the system with P^T A P

  Logically Collective

  Input Parameters:
+ pc - the preconditioner
- n  - number of ranks: the first n, or all if there are fewer; 0 (default): one for every 10,000 rows

  Options Database Key:
. -pc_amgf_filter_ranks <0> - number of ranks

  Level: advanced

  Notes:
  Applies to the default solver, a factorization by MUMPS. A solver that the user chose, with `-amgf_filter_pc_type` or
  on its `KSP`, uses all ranks. Factors of a few thousand rows need little work: on many ranks the messages would
  dominate the time.

.seealso: `PCAMGF`, `PCAMGFGetFilterKSP()`, `PCAMGFGetFilterSize()`
@*/
PetscErrorCode PCAMGFSetFilterRanks(PC pc, PetscInt n)
{
  PetscFunctionBegin;
  PetscValidHeaderSpecific(pc, PC_CLASSID, 1);
  PetscValidLogicalCollectiveInt(pc, n, 2);
  PetscTryMethod(pc, "PCAMGFSetFilterRanks_C", (PC, PetscInt), (pc, n));
  PetscFunctionReturn(0);
}

/*@
  PCAMGFGetFilterPivots - Gets the number of negative pivots in the factors of P^T A P

  Collective

  Input Parameter:
. pc - the preconditioner, of type `PCAMGF`, after its set-up

  Output Parameter:
. negative - number of negative pivots, equal to the number of negative eigenvalues of the matrix; -1: not known, since
             the matrix was not factored by Cholesky with MUMPS

  Level: advanced

  Note:
  If a factorization of the operator replaces the AMG (`PCAMGFSetFactor()`), the number is that of the operator.

.seealso: `PCAMGF`, `PCAMGFGetFilterKSP()`
@*/
PetscErrorCode PCAMGFGetFilterPivots(PC pc, PetscInt *negative)
{
  PetscFunctionBegin;
  PetscValidHeaderSpecific(pc, PC_CLASSID, 1);
  PetscAssertPointer(negative, 2);
  PetscUseMethod(pc, "PCAMGFGetFilterPivots_C", (PC, PetscInt *), (pc, negative));
  PetscFunctionReturn(0);
}
