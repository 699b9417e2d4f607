/* Sets up PCBLOCKAMG: hypre's BoomerAMG sets up its hierarchy, which is converted and freed */
#include "pc_amgf/amgfimpl.h"
#include "blockamgimpl.h"
#include "pc_amgf/guard.h"

/* Marks the preconditioner as failed, with an explanation. Collective. */
static PetscErrorCode SetUpFail(PC pc, PCFailedReason reason, const char why[])
{
  PC_BlockAMG *amg = (PC_BlockAMG *)pc->data;

  PetscFunctionBegin;
  PetscCall(PetscStrncpy(amg->why, why, sizeof(amg->why)));
  PetscCheck(!pc->erroriffailure, PetscObjectComm((PetscObject)pc), PETSC_ERR_NOT_CONVERGED, "PCBLOCKAMG: %s", why);
  PetscCall(PetscInfo(pc, "PCBLOCKAMG failed: %s\n", why));
  PetscCall(PCSetFailedReason(pc, reason));
  PetscFunctionReturn(0);
}

/* Finds the first row, over all ranks, whose diagonal entry is zero or not finite; -1 if there is none */
static PetscErrorCode SetUpFindBadRow(Mat A, PetscInt *row)
{
  Vec                diagonal;
  const PetscScalar *d;
  PetscInt           n, start, first = PETSC_MAX_INT;

  PetscFunctionBegin;
  PetscCall(MatCreateVecs(A, &diagonal, NULL));
  PetscCall(MatGetDiagonal(A, diagonal));
  PetscCall(VecGetLocalSize(diagonal, &n));
  PetscCall(VecGetOwnershipRange(diagonal, &start, NULL));
  PetscCall(VecGetArrayRead(diagonal, &d));
  for (PetscInt i = n - 1; i >= 0; i--) {
    if (d[i] == 0.0 || PetscIsInfOrNanScalar(d[i])) first = start + i;
  }
  PetscCall(VecRestoreArrayRead(diagonal, &d));
  PetscCall(VecDestroy(&diagonal));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &first, 1, MPIU_INT, MPI_MIN, PetscObjectComm((PetscObject)A)));
  *row = first == PETSC_MAX_INT ? -1 : first;
  PetscFunctionReturn(0);
}

/*
   Gets the operator in hypre's format, and creates the hierarchy. Its finest level is made of the same copy in format
   AIJ, which is freed before hypre's set-up, since this needs the most memory. *later: the finest level needs no such
   copy and is not yet created.
*/
static PetscErrorCode SetUpConvertOperator(PC pc, Mat *matrix, PetscBool *later)
{
  PC_BlockAMG *amg = (PC_BlockAMG *)pc->data;
  PetscInt     bs;
  Mat          aij;

  PetscFunctionBegin;
  PetscCall(BlockHierarchyCreate_Private(pc->pmat, &amg->h));
  PetscCall(BlockHalfSupports_Private(pc->pmat, later));
  if (*later) PetscCall(BlockHalfConvertToHypre_Private(pc->pmat, matrix));
  else {
    PetscCall(MatGetBlockSize(pc->pmat, &bs));
    PetscCall(BlockConvertToAIJ_Private(pc->pmat, &aij));
    PetscCall(BlockHierarchySetFinest_Private(amg->h, aij, bs));
    PetscCall(BlockConvertToHypre_Private(&aij, bs, matrix));
  }
  PetscFunctionReturn(0);
}

/* Checks that no option has selected another preconditioner of hypre, which has no hierarchy */
static PetscErrorCode SetUpCheckType(PC pc)
{
  PC          hypre = ((PC_BlockAMG *)pc->data)->hypre;
  PetscBool   boomeramg;
  const char *type;

  PetscFunctionBegin;
  PetscCall(PCHYPREGetType(hypre, &type));
  PetscCall(PetscStrcmp(type, "boomeramg", &boomeramg));
  PetscCheck(boomeramg, PetscObjectComm((PetscObject)pc), PETSC_ERR_SUP,
    "PCBLOCKAMG needs the hierarchy of hypre's BoomerAMG, but -pc_hypre_type is %s", type);
  PetscFunctionReturn(0);
}

/* Lets hypre set up its hierarchy. *failed: hypre reported an error on some rank. later: see SetUpConvertOperator(). */
static PetscErrorCode SetUpHypre(PC pc, PetscBool *later, PetscBool *failed)
{
  PC_BlockAMG   *amg = (PC_BlockAMG *)pc->data;
  AMGFGuard      guard;
  PetscErrorCode error;
  PetscInt       bs;
  Mat            matrix;
  const char    *prefix;

  PetscFunctionBegin;
  PetscCall(PCCreate(PetscObjectComm((PetscObject)pc), &amg->hypre));
  PetscCall(PetscObjectIncrementTabLevel((PetscObject)amg->hypre, (PetscObject)pc, 1));
  PetscCall(PCGetOptionsPrefix(pc, &prefix));
  PetscCall(PCSetOptionsPrefix(amg->hypre, prefix));
  PetscCall(MatGetBlockSize(pc->pmat, &bs));
  if (amg->symmetric) {
    PetscCall(SetUpConvertOperator(pc, &matrix, later));
    PetscCall(PCSetOperators(amg->hypre, pc->pmat, matrix)); /* the Pmat carries the near null space, which its copy
                                                                  does not */
    PetscCall(MatDestroy(&matrix));
  } else PetscCall(PCSetOperators(amg->hypre, pc->mat, pc->pmat));
  PetscCall(PCAMGFConfigureBoomerAMG_Private(amg->hypre, bs, (PetscBool)!amg->symmetric));
  PetscCall(SetUpCheckType(pc));
  PetscCall(PCAMGFGuardBegin_Private(&guard, NULL));
  error = PCSetUp(amg->hypre);
  PetscCall(PCAMGFGuardEnd_Private(&guard, error, failed));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, failed, 1, MPI_PETSCBOOL, MPI_LOR, PetscObjectComm((PetscObject)pc)));
  if (*failed) PetscCall(PetscInfo(pc, "An error of hypre: %s\n", guard.why));
  PetscFunctionReturn(0);
}

/*
   Converts hypre's hierarchy. hypre's own memory is freed first, so that both hierarchies do not exist at the same
   time. later: the finest level is not yet created.
*/
static PetscErrorCode SetUpConvert(PC pc, PetscBool later)
{
  PC_BlockAMG *amg = (PC_BlockAMG *)pc->data;
  PetscInt     ncoarse, nlevels;
  Mat         *coarse, *interpolations;

  PetscFunctionBegin;
  PetscCall(PetscLogEventBegin(PC_BLOCKAMG_Convert, pc, 0, 0, 0));
  PetscCall(PCGetCoarseOperators(amg->hypre, &ncoarse, &coarse));
  PetscCall(PCGetInterpolations(amg->hypre, &nlevels, &interpolations));
  PetscCall(PCDestroy(&amg->hypre));
  if (later) PetscCall(BlockHierarchySetFinest_Private(amg->h, pc->pmat, 3));
  PetscCall(BlockHierarchyAddLevels_Private(amg->h, nlevels, coarse, interpolations));
  PetscCall(PetscFree(coarse));
  PetscCall(PetscFree(interpolations));
  PetscCall(PetscLogEventEnd(PC_BLOCKAMG_Convert, pc, 0, 0, 0));
  PetscFunctionReturn(0);
}

PetscErrorCode PCSetUp_BlockAMG(PC pc)
{
  PC_BlockAMG *amg = (PC_BlockAMG *)pc->data;
  PetscInt     M, N, row = -1;
  PetscBool    later, failed, finite;
  char         why[160];

  PetscFunctionBegin;
  PetscCall(MatGetSize(pc->pmat, &M, &N));
  PetscCheck(M == N, PetscObjectComm((PetscObject)pc), PETSC_ERR_ARG_SIZ,
    "PCBLOCKAMG needs a square operator, not one of %" PetscInt_FMT " rows and %" PetscInt_FMT " columns", M, N);
  PetscCall(PCSetFailedReason(pc, PC_NOERROR));
  amg->why[0] = '\0';
  PetscCall(PCDestroy(&amg->hypre));
  PetscCall(BlockHierarchyDestroy_Private(&amg->h));
  PetscCall(SetUpFindBadRow(pc->pmat, &row));
  if (row >= 0) {
    PetscCall(PetscSNPrintf(why, sizeof(why),
      "the diagonal entry of row %" PetscInt_FMT " is zero or not finite, so the operator is not positive definite",
      row));
    PetscCall(SetUpFail(pc, PC_FACTOR_NUMERIC_ZEROPIVOT, why));
    PetscFunctionReturn(0);
  }
  PetscCall(BlockTestSymmetry_Private(pc));
  PetscCall(PetscLogEventBegin(PC_BLOCKAMG_SetUp, pc, 0, 0, 0));
  PetscCall(SetUpHypre(pc, &later, &failed));
  PetscCall(PetscLogEventEnd(PC_BLOCKAMG_SetUp, pc, 0, 0, 0));
  if (failed) {
    PetscCall(PCDestroy(&amg->hypre));
    PetscCall(BlockHierarchyDestroy_Private(&amg->h));
    PetscCall(SetUpFail(pc, PC_SUBPC_ERROR, "the set-up of hypre's BoomerAMG failed"));
    PetscFunctionReturn(0);
  }
  if (!amg->symmetric) PetscFunctionReturn(0);
  PetscCall(SetUpConvert(pc, later));
  PetscCall(BlockHierarchyIsFinite_Private(amg->h, &finite));
  if (finite) PetscFunctionReturn(0);
  PetscCall(BlockHierarchyDestroy_Private(&amg->h));
  PetscCall(SetUpFail(pc, PC_FACTOR_OTHER,
    "entries of the operator or of a coarse one differ by a factor of more than 1e30, which single precision cannot "
    "represent"));
  PetscFunctionReturn(0);
}
