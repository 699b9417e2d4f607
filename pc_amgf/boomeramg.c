/* Defaults and options of hypre's BoomerAMG */
#include "amgfimpl.h"

typedef struct {
  const char *name, *value;
} BoomerAMGOption;

/* "-name" with the object's prefix */
static PetscErrorCode BoomerAMGOptionName(PetscObject obj, const char name[], char full[], size_t len)
{
  const char *prefix;

  PetscFunctionBegin;
  PetscCall(PetscObjectGetOptionsPrefix(obj, &prefix));
  PetscCall(PetscSNPrintf(full, len, "-%s%s", prefix ? prefix : "", name + 1));
  PetscFunctionReturn(0);
}

/* Sets an option in the database unless the user has set it; *set: whether it was set here */
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

/* PCSetFromOptions() without -pc_type, because the prefix may be that of the PC that holds this one */
static PetscErrorCode BoomerAMGReadOptions(PC pc)
{
  PetscFunctionBegin;
  PetscObjectOptionsBegin((PetscObject)pc);
  PetscCall((*pc->ops->setfromoptions)(pc, PetscOptionsObject));
  PetscOptionsEnd();
  PetscFunctionReturn(0);
}

/* Sets defaults in the options database and removes them afterwards, since PCHYPRE has no functions for most
   parameters */
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
  PCAMGFConfigureBoomerAMG_Private - makes a PC hypre's BoomerAMG for a matrix of block size bs, with the options of
  its prefix except -pc_type

  One sweep of l1 Gauss-Seidel, forward down and backward up, which makes B symmetric and A < 2 B^-1; coarsening and
  interpolation for three-dimensional problems. Vector problems are coarsened function by function (the unknown
  approach), which PCHYPRE does by itself for a block size > 1 as long as nodal coarsening is off; a larger strength
  threshold suits three displacements.
*/
PetscErrorCode PCAMGFConfigureBoomerAMG_Private(PC amg, PetscInt bs)
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
  /* PCHYPRE reads relax_type_all before _down and _up: a user's choice for all must not be overridden */
  PetscCall(PetscObjectGetOptions((PetscObject)amg, &options));
  PetscCall(BoomerAMGOptionName((PetscObject)amg, "-pc_hypre_boomeramg_relax_type_all", full, sizeof(full)));
  PetscCall(PetscOptionsHasName(options, NULL, full, &all));
  if (!all) n = PETSC_STATIC_ARRAY_LENGTH(defaults);
  PetscCall(PCSetType(amg, PCHYPRE));
  PetscCall(BoomerAMGSetFromOptions(amg, n, defaults));
  PetscFunctionReturn(0);
}
