/*
   The direct solver of the filtered system. A small system is solved on a part of the ranks only (PCTELESCOPE): on all
   ranks communication would take longer than arithmetic.
*/
#include "amgfimpl.h"
#include "mumps.h"

/*
   Sets a PC to a Cholesky factorization. *mumps: whether MUMPS factors the matrix. If PETSc was configured without
   MUMPS, PETSc's own Cholesky is used; in parallel, each rank then factors a copy of the whole matrix. With complex
   scalars LU is used, since MUMPS has no Hermitian Cholesky.
*/
static PetscErrorCode DirectChoose(PC inner, PetscBool *mumps)
{
  const MatFactorType factor = PetscDefined(USE_COMPLEX) ? MAT_FACTOR_LU : MAT_FACTOR_CHOLESKY;
  const PCType        type   = PetscDefined(USE_COMPLEX) ? PCLU : PCCHOLESKY;
  PetscMPIInt         size;

  PetscFunctionBegin;
  PetscCallMPI(MPI_Comm_size(PetscObjectComm((PetscObject)inner), &size));
  PetscCall(AMGFMumpsFactors(size > 1 ? MATMPIAIJ : MATSEQAIJ, factor, mumps));
  if (!*mumps && size > 1) {
    KSP redundant;

    PetscCall(PCSetType(inner, PCREDUNDANT));
    PetscCall(PCRedundantGetKSP(inner, &redundant));
    PetscCall(KSPGetPC(redundant, &inner));
  }
  PetscCall(PCSetType(inner, type));
  if (*mumps) PetscCall(PCFactorSetMatSolverType(inner, MATSOLVERMUMPS));
  PetscFunctionReturn(0);
}

/* PCAMGFDirectBegin_Private - chooses the direct solver of the filtered system for a PC without a type */
PetscErrorCode PCAMGFDirectBegin_Private(PC inner)
{
  PetscOptions options;
  const char  *prefix;
  PetscBool    given, mumps;
  PetscMPIInt  size;

  PetscFunctionBegin;
  PetscCallMPI(MPI_Comm_size(PetscObjectComm((PetscObject)inner), &size));
  PetscCall(PetscObjectGetOptions((PetscObject)inner, &options));
  PetscCall(PCGetOptionsPrefix(inner, &prefix));
  PetscCall(PetscOptionsHasName(options, prefix, "-pc_type", &given));
  PetscCall(DirectChoose(inner, &mumps));
  if (size > 1 && mumps && !given) PetscCall(PCSetType(inner, PCTELESCOPE));
  PetscFunctionReturn(0);
}

/*
   PCAMGFDirectRenew_Private - replaces a PCTELESCOPE by one for a system of another size, since the number of its ranks
   remains that of its first set-up
*/
PetscErrorCode PCAMGFDirectRenew_Private(KSP filter)
{
  PC          inner, fresh;
  PetscBool   telescope;
  const char *prefix;

  PetscFunctionBegin;
  PetscCall(KSPReset(filter));
  PetscCall(KSPGetPC(filter, &inner));
  PetscCall(PetscObjectTypeCompare((PetscObject)inner, PCTELESCOPE, &telescope));
  if (!telescope) PetscFunctionReturn(0);
  PetscCall(PCCreate(PetscObjectComm((PetscObject)filter), &fresh));
  PetscCall(PCGetOptionsPrefix(inner, &prefix));
  PetscCall(PCSetOptionsPrefix(fresh, prefix));
  PetscCall(PCSetType(fresh, PCTELESCOPE));
  PetscCall(KSPSetPC(filter, fresh));
  PetscCall(PCDestroy(&fresh));
  PetscFunctionReturn(0);
}

/* Sets how many times fewer ranks solve: one rank for every 10,000 rows. With fewer rows a rank waits for messages. */
static PetscErrorCode DirectSetRanks(PC telescope, Mat Aw)
{
  const PetscInt rows = 10000;
  PetscInt       n;
  PetscMPIInt    size;

  PetscFunctionBegin;
  PetscCallMPI(MPI_Comm_size(PetscObjectComm((PetscObject)telescope), &size));
  PetscCall(MatGetSize(Aw, &n, NULL));
  PetscCall(PCTelescopeSetReductionFactor(telescope, PetscMax(1, size / (1 + n / rows))));
  PetscCall(PCSetFromOptions(telescope));
  PetscFunctionReturn(0);
}

/* Factors on this rank, one of those that solve. *reason: of a failure */
static PetscErrorCode DirectFactorHere(KSP solver, PetscBool first, PCFailedReason *reason)
{
  PC           pc;
  PetscOptions options;
  const char  *prefix;
  PetscBool    given, mumps;
  Mat          Aw;

  PetscFunctionBegin;
  PetscCall(KSPGetPC(solver, &pc));
  PetscCall(PetscObjectGetOptions((PetscObject)pc, &options));
  PetscCall(PCGetOptionsPrefix(pc, &prefix));
  PetscCall(PetscOptionsHasName(options, prefix, "-pc_type", &given));
  if (first && !given) PetscCall(DirectChoose(pc, &mumps));
  PetscCall(KSPGetOperators(solver, NULL, &Aw));
  PetscCall(
    MatSetOption(Aw, PetscDefined(USE_COMPLEX) ? MAT_HERMITIAN : MAT_SPD, PETSC_TRUE)); /* not copied with A_w */
  PetscCall(
    KSPSetErrorIfNotConverged(solver, PETSC_FALSE)); /* an error on these ranks alone would let the others wait */
  PetscCall(KSPSetUp(solver));
  PetscCall(PCGetFailedReason(pc, reason));
  PetscFunctionReturn(0);
}

/*
   PCAMGFDirectSetUp_Private - sets up the solver of the filtered system. If it failed on one of the ranks that solve,
   its PC is marked as failed on all ranks.
*/
PetscErrorCode PCAMGFDirectSetUp_Private(KSP filter, Mat Aw)
{
  PCFailedReason reason = PC_NOERROR;
  PetscBool      telescope, first;
  int            code;
  KSP            solver;
  PC             inner;

  PetscFunctionBegin;
  PetscCall(KSPGetPC(filter, &inner));
  PetscCall(PetscObjectTypeCompare((PetscObject)inner, PCTELESCOPE, &telescope));
  PetscCall(KSPSetOperators(filter, Aw, Aw));
  first = (PetscBool)!inner->setupcalled;
  if (telescope && first) PetscCall(DirectSetRanks(inner, Aw));
  PetscCall(KSPSetUp(filter));
  if (!telescope) PetscFunctionReturn(0);
  PetscCall(PCTelescopeGetKSP(inner, &solver));
  if (solver) PetscCall(DirectFactorHere(solver, first, &reason));
  code = (int)reason;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &code, 1, MPI_INT, MPI_MAX, PetscObjectComm((PetscObject)filter)));
  PetscCheck(!code || !inner->erroriffailure, PetscObjectComm((PetscObject)filter), PETSC_ERR_NOT_CONVERGED,
    "The factorization of the matrix on the filtered subspace failed: %s", PCFailedReasons[code]);
  PetscCall(PCSetFailedReason(inner, (PCFailedReason)code));
  PetscFunctionReturn(0);
}

PetscErrorCode PCAMGFGetFilterPivots_AMGF(PC pc, PetscInt *negative)
{
  PC_AMGF      *amgf   = (PC_AMGF *)pc->data;
  PetscBool     known  = PETSC_FALSE, telescope;
  MatSolverType solver = NULL;
  KSP           ksp    = amgf->filter;
  Mat           F;
  PC            inner;

  PetscFunctionBegin;
  *negative = -1;
  if (amgf->factor.on && amgf->factor.F) {
    *negative = amgf->factor.negative;
    PetscFunctionReturn(0);
  }
  PetscCall(KSPGetPC(ksp, &inner));
  PetscCall(PetscObjectTypeCompare((PetscObject)inner, PCTELESCOPE, &telescope));
  if (telescope) PetscCall(PCTelescopeGetKSP(inner, &ksp));
  if (ksp && amgf->Aw) {
    PetscCall(KSPGetPC(ksp, &inner));
    PetscCall(PetscObjectTypeCompare((PetscObject)inner, PCCHOLESKY, &known));
  }
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
