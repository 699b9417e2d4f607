/* Defaults and options of hypre's BoomerAMG */
#include "amgfimpl.h"

typedef struct {
  const char *name, *value;
} BoomerAMGOption;

/* Sets `full` to "-", the object's options prefix, and the option's name without its "-" */
static PetscErrorCode BoomerAMGOptionName(PetscObject obj, const char name[], char full[], size_t len)
{
  const char *prefix;

  PetscFunctionBegin;
  PetscCall(PetscObjectGetOptionsPrefix(obj, &prefix));
  PetscCall(PetscSNPrintf(full, len, "-%s%s", prefix ? prefix : "", name + 1));
  PetscFunctionReturn(0);
}

/* Sets a default in the options database unless the user has given that option. *set: whether the default was set. */
static PetscErrorCode BoomerAMGSetDefault(PetscObject obj, const BoomerAMGOption *option, PetscBool *set)
{
  PetscOptions options;
  char         full[PETSC_MAX_OPTION_NAME];
  PetscBool    given;

  PetscFunctionBegin;
  PetscCall(PetscObjectGetOptions(obj, &options));
  PetscCall(BoomerAMGOptionName(obj, option->name, full, sizeof(full)));
  PetscCall(PetscOptionsHasName(options, NULL, full, &given));
  *set = given ? PETSC_FALSE : PETSC_TRUE;
  if (*set) PetscCall(PetscOptionsSetValue(options, full, option->value));
  PetscFunctionReturn(0);
}

/*
   Calls the type's own setfromoptions(). PCSetFromOptions() cannot be used here: it also reads -pc_type, which with
   this prefix may be meant for the PC that contains this one.
*/
static PetscErrorCode BoomerAMGReadOptions(PC pc)
{
  PetscFunctionBegin;
  PetscObjectOptionsBegin((PetscObject)pc);
  PetscCall((*pc->ops->setfromoptions)(pc, PetscOptionsObject));
  PetscOptionsEnd();
  PetscFunctionReturn(0);
}

/*
   Reads the options of BoomerAMG with other defaults than hypre's. PCHYPRE has no functions for most parameters.
   Therefore the defaults are put into the options database and removed afterwards.
*/
static PetscErrorCode BoomerAMGSetFromOptions(PC pc, PetscInt n, const BoomerAMGOption defaults[])
{
  PetscBool   *set;
  PetscOptions options;

  PetscFunctionBegin;
  PetscCall(PetscMalloc1(n, &set));
  for (PetscInt i = 0; i < n; i++) PetscCall(BoomerAMGSetDefault((PetscObject)pc, &defaults[i], &set[i]));
  PetscCall(BoomerAMGReadOptions(pc));
  PetscCall(PetscObjectGetOptions((PetscObject)pc, &options));
  for (PetscInt i = 0; i < n; i++) {
    char full[PETSC_MAX_OPTION_NAME];

    if (!set[i]) continue;
    PetscCall(BoomerAMGOptionName((PetscObject)pc, defaults[i].name, full, sizeof(full)));
    PetscCall(PetscOptionsClearValue(options, full));
  }
  PetscCall(PetscFree(set));
  PetscFunctionReturn(0);
}

/*
   PCAMGFConfigureBoomerAMG_Private - sets a PC to hypre's BoomerAMG and reads the options of its prefix except -pc_type

   Input Parameters:
   + amg - the preconditioner
   . bs  - block size of its matrix; 3 for displacements
   - own - hypre's own cycle is used, which needs the norms of the rows for its smoother

   Notes:
   The smoother is one sweep of l1 Gauss-Seidel, forward on the way down and backward on the way up. With it B is
   symmetric and A < 2 B^-1. Coarsening and interpolation are those for three-dimensional problems.

   With a block size > 1 and without nodal coarsening, PCHYPRE coarsens each component of a vector problem separately
   (the unknown approach). For three displacements the threshold of strong couplings is 0.7 instead of 0.25.
*/
PetscErrorCode PCAMGFConfigureBoomerAMG_Private(PC amg, PetscInt bs, PetscBool own)
{
  PetscInt        n = 5;
  PetscBool       all;
  PetscOptions    options;
  BoomerAMGOption defaults[] = {
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
  if (bs == 3) defaults[4].value = "0.7";
  /* PCHYPRE reads relax_type_all before relax_type_down and relax_type_up. The last two defaults are therefore left
     out if the user has set relax_type_all. */
  PetscCall(PetscObjectGetOptions((PetscObject)amg, &options));
  PetscCall(BoomerAMGOptionName((PetscObject)amg, "-pc_hypre_boomeramg_relax_type_all", full, sizeof(full)));
  PetscCall(PetscOptionsHasName(options, NULL, full, &all));
  if (own && !all) n = PETSC_STATIC_ARRAY_LENGTH(defaults);
  PetscCall(PCSetType(amg, PCHYPRE));
  PetscCall(BoomerAMGSetFromOptions(amg, n, defaults));
  PetscFunctionReturn(0);
}
