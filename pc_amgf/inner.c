/* Defaults and options of the inner solvers */
#include "amgfimpl.h"

typedef struct {
  const char *name, *value;
} InnerOption;

/* "-name" with the object's prefix */
static PetscErrorCode InnerOptionName(PetscObject obj, const char name[], char full[], size_t len)
{
  const char *prefix;

  PetscFunctionBegin;
  PetscCall(PetscObjectGetOptionsPrefix(obj, &prefix));
  PetscCall(PetscSNPrintf(full, len, "-%s%s", prefix ? prefix : "", name + 1));
  PetscFunctionReturn(0);
}

/* Puts an option into the data base unless the user has; *set says whether */
static PetscErrorCode InnerSetDefault(PetscObject obj, const InnerOption *option, PetscBool *set)
{
  PetscOptions options;
  char         full[PETSC_MAX_OPTION_NAME];
  PetscBool    given;

  PetscFunctionBegin;
  PetscCall(PetscObjectGetOptions(obj, &options));
  PetscCall(InnerOptionName(obj, option->name, full, sizeof(full)));
  PetscCall(PetscOptionsHasName(options, NULL, full, &given));
  *set = given ? PETSC_FALSE : PETSC_TRUE;
  if (*set) PetscCall(PetscOptionsSetValue(options, full, option->value));
  PetscFunctionReturn(0);
}

/* PCHYPRE has no calls for most parameters, so its defaults pass through the options data base and are taken out again */
static PetscErrorCode InnerSetFromOptions(PC pc, PetscInt n, const InnerOption defaults[])
{
  PetscBool   *set;
  PetscOptions options;

  PetscFunctionBegin;
  PetscCall(PetscMalloc1(n, &set));
  for (PetscInt i = 0; i < n; i++) PetscCall(InnerSetDefault((PetscObject)pc, &defaults[i], &set[i]));
  PetscCall(PCSetFromOptions(pc));
  PetscCall(PetscObjectGetOptions((PetscObject)pc, &options));
  for (PetscInt i = 0; i < n; i++) {
    char full[PETSC_MAX_OPTION_NAME];

    if (!set[i]) continue;
    PetscCall(InnerOptionName((PetscObject)pc, defaults[i].name, full, sizeof(full)));
    PetscCall(PetscOptionsClearValue(options, full));
  }
  PetscCall(PetscFree(set));
  PetscFunctionReturn(0);
}

/*
  BoomerAMG: one sweep of l1 Gauss-Seidel, forward down and backward up, which makes B symmetric and A < 2 B^-1; coarsening and interpolation for
  three-dimensional problems. Vector problems are coarsened function by function (the unknown approach), which PCHYPRE does by itself
  for a block size > 1 as long as nodal coarsening is off; a larger strength threshold suits three displacements.
*/
static PetscErrorCode InnerConfigureBoomerAMG(PC pc, PC amg)
{
  PetscInt     bs, n = 5;
  PetscBool    all;
  PetscOptions options;
  InnerOption  defaults[] = {
     {"-pc_hypre_boomeramg_coarsen_type", "HMIS"},
     {"-pc_hypre_boomeramg_interp_type", "ext+i"},
     {"-pc_hypre_boomeramg_P_max", "4"},
     {"-pc_hypre_boomeramg_agg_nl", "0"},
     {"-pc_hypre_boomeramg_strong_threshold", "0.25"},
     {"-pc_hypre_boomeramg_relax_type_down", "l1-Gauss-Seidel"},
     {"-pc_hypre_boomeramg_relax_type_up", "backward-l1-Gauss-Seidel"},
  };
  char full[PETSC_MAX_OPTION_NAME];

  PetscFunctionBegin;
  PetscCall(MatGetBlockSize(pc->pmat, &bs));
  if (bs == 3) defaults[4].value = "0.7";
  /* PCHYPRE reads relax_type_all before _down and _up: a user's choice for all must not be overruled */
  PetscCall(PetscObjectGetOptions((PetscObject)amg, &options));
  PetscCall(InnerOptionName((PetscObject)amg, "-pc_hypre_boomeramg_relax_type_all", full, sizeof(full)));
  PetscCall(PetscOptionsHasName(options, NULL, full, &all));
  if (!all) n = PETSC_STATIC_ARRAY_LENGTH(defaults);
  PetscCall(PCSetType(amg, PCHYPRE));
  PetscCall(InnerSetFromOptions(amg, n, defaults));
  PetscFunctionReturn(0);
}

/* PCGAMG restricts with P^T: of a complex operator that makes a Hermitian B for as long as P is real, which it is unless it is smoothed */
static PetscErrorCode InnerConfigureGAMG(PC amg)
{
  PetscFunctionBegin;
  PetscCall(PCSetType(amg, PCGAMG));
  if (PetscDefined(USE_COMPLEX)) PetscCall(PCGAMGSetNSmooths(amg, 0));
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
  else if (PetscDefined(HAVE_HYPRE)) PetscCall(InnerConfigureBoomerAMG(pc, amg));
  else PetscCall(InnerConfigureGAMG(amg));
  PetscFunctionReturn(0);
}

/* By MUMPS, as many ranks as its size asks for; all where the user chose another solver, or PETSc has no MUMPS */
static PetscErrorCode InnerSetFilterSolver(PC pc, PC inner)
{
  PetscOptions options;
  char         full[PETSC_MAX_OPTION_NAME];
  PetscBool    given, mumps;
  PetscMPIInt  size;

  PetscFunctionBegin;
  PetscCallMPI(MPI_Comm_size(PetscObjectComm((PetscObject)pc), &size));
  PetscCall(PetscObjectGetOptions((PetscObject)inner, &options));
  PetscCall(InnerOptionName((PetscObject)inner, "-pc_type", full, sizeof(full)));
  PetscCall(PetscOptionsHasName(options, NULL, full, &given));
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
  PCAMGFPrefixInner_Private - gives the inner solvers their prefixes behind that of the preconditioner, which may change until the set-up
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
