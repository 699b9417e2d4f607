/* A misspelt option ends a run before it computes. */
#include "optionsimpl.h"

/* The name that may have been meant; behind the prefixes of an object that of one of its options */
static PetscErrorCode OptionsGuess(const char name[], size_t length, char guess[])
{
  const char  *known[512], *nearest;
  const size_t prefix = OptionPrefixLength(name);
  PetscInt     n      = 0;

  PetscFunctionBegin;
  for (const char *const *ours = OptionsOurs; *ours && n < 512; ++ours) known[n++] = *ours;
  for (const char *const *usual = OptionsUsual; *usual && n < 512; ++usual) known[n++] = *usual;
  PetscCall(OptionsNearest(n, known, name + prefix, &nearest));
  PetscCall(PetscSNPrintf(guess, length, "%.*s%s", (int)prefix, name, nearest));
  PetscFunctionReturn(0);
}

/*@C
   OptionsCheck - Raises an error for an option that nothing will ask for: one that is neither ours nor begins as
   those of PETSc do

   Collective

   Input Parameter:
.  comm - the communicator

   Level: intermediate

   Notes:
   Call it once all options are in the database, from the command line, from files, PETSC_OPTIONS or a scene,
   and before they are used. PETSc's own options, and those of our solvers' inner ones, cannot be known beforehand:
   `-options_left` tells which of them nothing asked for.

   Errors: PETSC_ERR_USER_INPUT, with the nearest known name.

.seealso: `OptionsNearest()`
@*/
PetscErrorCode OptionsCheck(MPI_Comm comm)
{
  char   **names, **values, unknown[PETSC_MAX_OPTION_NAME] = "", guess[PETSC_MAX_OPTION_NAME];
  PetscInt n;

  PetscFunctionBegin;
  PetscCall(PetscOptionsLeftGet(NULL, &n, &names, &values));
  for (PetscInt i = 0; i < n && !unknown[0]; ++i) {
    if (!OptionIsKnown(names[i])) PetscCall(PetscStrncpy(unknown, names[i], sizeof(unknown)));
  }
  PetscCall(PetscOptionsLeftRestore(NULL, &n, &names, &values));
  if (unknown[0]) {
    PetscCall(OptionsGuess(unknown, sizeof(guess), guess));
    SETERRQ(comm, PETSC_ERR_USER_INPUT, "there is no option -%s; the nearest known one is -%s", unknown, guess);
  }
  PetscFunctionReturn(0);
}
