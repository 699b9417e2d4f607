/* Sets types and options of the inner solvers: the AMG, and the solver of the filtered system */
#include "amgfimpl.h"

/*
   Configures PCGAMG as the AMG. PCGAMG restricts with P^T. For a complex operator B is therefore Hermitian only if P is
   real, that is, without smoothing of P.
*/
static PetscErrorCode InnerConfigureGAMG(PC amg)
{
  PetscFunctionBegin;
  PetscCall(PCSetType(amg, PCGAMG));
  if (PetscDefined(USE_COMPLEX)) PetscCall(PCGAMGSetNSmooths(amg, 0));
  PetscCall(PCSetFromOptions(amg));
  PetscFunctionReturn(0);
}

/* Configures BoomerAMG as the AMG, unless the options name another type */
static PetscErrorCode InnerConfigureHypre(PC pc, PC amg)
{
  PetscInt bs;

  PetscFunctionBegin;
  PetscCall(MatGetBlockSize(pc->pmat, &bs));
  PetscCall(PCAMGFConfigureBoomerAMG_Private(amg, bs, PETSC_TRUE));
  PetscCall(PCSetFromOptions(amg));
  PetscFunctionReturn(0);
}

/*
   Finds whether an option with the AMG's prefix sets its type, or concerns hypre's own cycle, which PCBLOCKAMG does not
   use
*/
static PetscErrorCode InnerAsksForType(PC amg, PetscBool *asks)
{
  static const char *const names[] = {"-pc_type", "-pc_hypre_type", "-pc_hypre_boomeramg_cycle_type",
    "-pc_hypre_boomeramg_max_iter", "-pc_hypre_boomeramg_tol", "-pc_hypre_boomeramg_grid_sweeps_all",
    "-pc_hypre_boomeramg_grid_sweeps_down", "-pc_hypre_boomeramg_grid_sweeps_up",
    "-pc_hypre_boomeramg_grid_sweeps_coarse", "-pc_hypre_boomeramg_smooth_type", "-pc_hypre_boomeramg_relax_type_all",
    "-pc_hypre_boomeramg_relax_type_down", "-pc_hypre_boomeramg_relax_type_up", "-pc_hypre_boomeramg_relax_type_coarse",
    "-pc_hypre_boomeramg_relax_weight_all", "-pc_hypre_boomeramg_relax_weight_level",
    "-pc_hypre_boomeramg_outer_relax_weight_all", "-pc_hypre_boomeramg_outer_relax_weight_level",
    "-pc_hypre_boomeramg_no_CF", "-pc_hypre_boomeramg_print_statistics"};
  PetscOptions             options;
  const char              *prefix;

  PetscFunctionBegin;
  PetscCall(PetscObjectGetOptions((PetscObject)amg, &options));
  PetscCall(PCGetOptionsPrefix(amg, &prefix));
  *asks = PETSC_FALSE;
  for (size_t i = 0; i < PETSC_STATIC_ARRAY_LENGTH(names) && !*asks; i++)
    PetscCall(PetscOptionsHasName(options, prefix, names[i], asks));
  PetscFunctionReturn(0);
}

/* Finds whether PCBLOCKAMG supports the operator's type and no option asks for another AMG */
static PetscErrorCode InnerCanUseBlockAMG(PC pc, PC amg, PetscBool *can_use)
{
  PetscBool asks;

  PetscFunctionBegin;
  *can_use = PETSC_FALSE;
  if (PetscDefined(USE_COMPLEX)) PetscFunctionReturn(0);
  PetscCall(PetscObjectBaseTypeCompareAny((PetscObject)pc->pmat, can_use, MATSEQAIJ, MATMPIAIJ, MATSEQBAIJ, MATMPIBAIJ,
    MATSEQSBAIJ, MATMPISBAIJ, ""));
  PetscCall(InnerAsksForType(amg, &asks));
  if (asks) *can_use = PETSC_FALSE;
  PetscFunctionReturn(0);
}

/*
   PCAMGFSetBlockAMG_Private - selects one of the two default AMGs; does nothing if the user has chosen the AMG

   Input Parameter:
   . block - PETSC_TRUE: PCBLOCKAMG; PETSC_FALSE: BoomerAMG with hypre's own cycle
*/
PetscErrorCode PCAMGFSetBlockAMG_Private(PC pc, PetscBool block)
{
  PC_AMGF  *amgf = (PC_AMGF *)pc->data;
  PetscBool is;

  PetscFunctionBegin;
  if (!amgf->bydefault) PetscFunctionReturn(0);
  PetscCall(PetscObjectTypeCompare((PetscObject)amgf->amg, PCBLOCKAMG, &is));
  if (block && !is) PetscCall(PCSetType(amgf->amg, PCBLOCKAMG));
  else if (!block && is) PetscCall(InnerConfigureHypre(pc, amgf->amg));
  PetscFunctionReturn(0);
}

static PetscErrorCode InnerConfigureAMG(PC pc)
{
  PC_AMGF *amgf = (PC_AMGF *)pc->data;
  PCType   type;

  PetscFunctionBegin;
  PetscCall(PCGetType(amgf->amg, &type));
  if (!type && PetscDefined(HAVE_HYPRE)) PetscCall(InnerCanUseBlockAMG(pc, amgf->amg, &amgf->bydefault));
  if (type) PetscCall(PCSetFromOptions(amgf->amg));
  else if (amgf->bydefault) PetscCall(PCAMGFSetBlockAMG_Private(pc, PETSC_TRUE));
  else if (PetscDefined(HAVE_HYPRE)) PetscCall(InnerConfigureHypre(pc, amgf->amg));
  else PetscCall(InnerConfigureGAMG(amgf->amg));
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
  if (!pctype) PetscCall(PCAMGFDirectBegin_Private(inner));
  PetscCall(KSPSetFromOptions(filter));
  PetscFunctionReturn(0);
}

/*
   PCAMGFPrefixInner_Private - derives the options prefixes of the inner solvers from that of the preconditioner, which
   may change until the set-up
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
   PCAMGFConfigureInner_Private - sets types and options of the inner solvers once; the operator must be known, since
   its block size matters
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
