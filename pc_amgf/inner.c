/* Defaults and options of the inner solvers */
#include "amgfimpl.h"

/* PCGAMG restricts with P^T. For a complex operator B is Hermitian only if P is real, that is, not smoothed */
static PetscErrorCode InnerConfigureGAMG(PC amg)
{
  PetscFunctionBegin;
  PetscCall(PCSetType(amg, PCGAMG));
  if (PetscDefined(USE_COMPLEX)) PetscCall(PCGAMGSetNSmooths(amg, 0));
  PetscCall(PCSetFromOptions(amg));
  PetscFunctionReturn(0);
}

/* BoomerAMG, unless the options name another type */
static PetscErrorCode InnerConfigureHypre(PC pc, PC amg)
{
  PetscInt bs;

  PetscFunctionBegin;
  PetscCall(MatGetBlockSize(pc->pmat, &bs));
  PetscCall(PCAMGFConfigureBoomerAMG_Private(amg, bs));
  PetscCall(PCSetFromOptions(amg));
  PetscFunctionReturn(0);
}

static PetscErrorCode InnerConfigureAMG(PC pc)
{
  PC     amg = ((PC_AMGF *)pc->data)->amg;
  PCType type;

  PetscFunctionBegin;
  PetscCall(PCGetType(amg, &type));
  if (type) PetscCall(PCSetFromOptions(amg));
  else if (PetscDefined(HAVE_HYPRE)) PetscCall(InnerConfigureHypre(pc, amg));
  else PetscCall(InnerConfigureGAMG(amg));
  PetscFunctionReturn(0);
}

/* MUMPS on as many ranks as the size needs; on all ranks if the user chose another solver or PETSc has no MUMPS */
static PetscErrorCode InnerSetFilterSolver(PC pc, PC inner)
{
  PetscOptions options;
  const char  *prefix;
  PetscBool    given, mumps;
  PetscMPIInt  size;

  PetscFunctionBegin;
  PetscCallMPI(MPI_Comm_size(PetscObjectComm((PetscObject)pc), &size));
  PetscCall(PetscObjectGetOptions((PetscObject)inner, &options));
  PetscCall(PCGetOptionsPrefix(inner, &prefix));
  PetscCall(PetscOptionsHasName(options, prefix, "-pc_type", &given));
  PetscCall(PCAMGFSetDirectSolver_Private(inner, &mumps));
  if (size > 1 && mumps && !given) PetscCall(PCAMGFFewRanksBegin_Private(inner, &((PC_AMGF *)pc->data)->few));
  PetscFunctionReturn(0);
}

static PetscErrorCode InnerConfigureFilter(PC pc)
{
  KSP     filter = ((PC_AMGF *)pc->data)->filter;
  PC      inner;
  KSPType ksptype;
  PCType  pctype;

  PetscFunctionBegin;
  PetscCall(KSPGetType(filter, &ksptype));
  if (!ksptype) PetscCall(KSPSetType(filter, KSPPREONLY));
  PetscCall(KSPGetPC(filter, &inner));
  PetscCall(PCGetType(inner, &pctype));
  if (!pctype) PetscCall(InnerSetFilterSolver(pc, inner));
  PetscCall(KSPSetFromOptions(filter));
  PetscFunctionReturn(0);
}

/*
  PCAMGFPrefixInner_Private - gives the inner solvers their prefixes behind that of the preconditioner, which may
  change until the set-up
*/
PetscErrorCode PCAMGFPrefixInner_Private(PC pc)
{
  PC_AMGF    *amgf = (PC_AMGF *)pc->data;
  const char *prefix;

  PetscFunctionBegin;
  PetscCall(PCGetOptionsPrefix(pc, &prefix));
  PetscCall(PCSetOptionsPrefix(amgf->amg, prefix));
  PetscCall(PCAppendOptionsPrefix(amgf->amg, "amgf_amg_"));
  PetscCall(KSPSetOptionsPrefix(amgf->filter, prefix));
  PetscCall(KSPAppendOptionsPrefix(amgf->filter, "amgf_filter_"));
  PetscFunctionReturn(0);
}

/*
  PCAMGFConfigureInner_Private - gives the inner solvers their types and options; needs the operator's block size
*/
PetscErrorCode PCAMGFConfigureInner_Private(PC pc)
{
  PC_AMGF *amgf = (PC_AMGF *)pc->data;

  PetscFunctionBegin;
  if (amgf->configured) PetscFunctionReturn(0);
  PetscCall(PCAMGFPrefixInner_Private(pc));
  PetscCall(InnerConfigureAMG(pc));
  PetscCall(InnerConfigureFilter(pc));
  amgf->configured = PETSC_TRUE;
  PetscFunctionReturn(0);
}
