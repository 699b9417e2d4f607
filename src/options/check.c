/* Ends a run before it computes anything if an option is misspelt, or has no value or a wrong one */
#include "optionsimpl.h"
#include <stdlib.h>

/*
   Finds the known name nearest to a misspelt one. If that begins with an object's prefix, the options of that object
   are compared.
*/
static PetscErrorCode OptionsGuess(const char name[], size_t length, char guess[])
{
  const char  *known[512], *nearest;
  const size_t prefix = OptionPrefixLength(name);
  PetscInt     n      = 0;

  PetscFunctionBegin;
  for (const char *ours; n < 512 && (ours = OptionGetOurs(n)); ++n) known[n] = ours;
  for (const char *const *usual = OptionsUsual; *usual && n < 512; ++usual) known[n++] = *usual;
  PetscCall(OptionsNearest(n, known, name + prefix, &nearest));
  PetscCall(PetscSNPrintf(guess, length, "%.*s%s", (int)prefix, name, nearest));
  PetscFunctionReturn(0);
}

/* Finds whether PETSc can read the value as one of this kind. NaN is no number: PETSc 3.25 refuses it without the name
   of the option. */
static PetscErrorCode OptionValueIsGood(OptionKind kind, const char value[], PetscBool *good)
{
  PetscErrorCode ierr = 0;
  PetscBool      truth;
  PetscInt       count;
  PetscReal      number;

  PetscFunctionBegin;
  PetscCall(PetscPushErrorHandler(PetscReturnErrorHandler, NULL));
  if (kind == OPTION_SWITCH) ierr = PetscOptionsStringToBool(value, &truth);
  if (kind == OPTION_COUNT) ierr = PetscOptionsStringToInt(value, &count);
  if (kind == OPTION_NUMBER) ierr = PetscOptionsStringToReal(value, &number);
  PetscCall(PetscPopErrorHandler());
  *good = (PetscBool)(!ierr && !(kind == OPTION_NUMBER && PetscIsNanReal(number)));
  PetscFunctionReturn(0);
}

/* Checks that the value is one of the words that the option allows, if it allows a few words only */
static PetscErrorCode OptionCheckChoice(MPI_Comm comm, const char place[], const char name[], const char value[])
{
  const char *const *words;
  char               all[128] = "";
  PetscBool          found    = PETSC_FALSE;

  PetscFunctionBegin;
  if (!OptionGetChoices(name, &words)) PetscFunctionReturn(0);
  for (PetscInt k = 0; words[k] && !found; ++k) {
    PetscCall(PetscStrcasecmp(value, words[k], &found));
    if (k) PetscCall(PetscStrlcat(all, words[k + 1] ? ", " : " or ", sizeof(all)));
    PetscCall(PetscStrlcat(all, words[k], sizeof(all)));
  }
  PetscCheck(found, comm, PETSC_ERR_USER_INPUT, "%s-%s has the value \"%s\", but needs %s", place, name, value, all);
  PetscFunctionReturn(0);
}

static PetscErrorCode OptionCheckValue(MPI_Comm comm, const char place[], const char name[], const char value[])
{
  static const char *const needs[OPTION_KINDS] = {
    [OPTION_SWITCH] = "none, or true or false; a scene file comes first: contact SCENE.yaml [options]",
    [OPTION_COUNT]  = "a whole number",
    [OPTION_NUMBER] = "a number",
    [OPTION_WORD]   = "one",
  };
  const PetscBool missing = (PetscBool)(!value || !value[0]);
  OptionKind      kind;
  PetscBool       good = PETSC_FALSE;

  PetscFunctionBegin;
  if (!OptionGetKind(name, &kind)) PetscFunctionReturn(0);
  PetscCheck(!missing || kind == OPTION_SWITCH, comm, PETSC_ERR_USER_INPUT, "%s-%s has no value, but needs %s", place,
    name, needs[kind]);
  if (missing) PetscFunctionReturn(0);
  PetscCall(OptionValueIsGood(kind, value, &good));
  PetscCheck(good, comm, PETSC_ERR_USER_INPUT, "%s-%s has the value \"%s\", but needs %s", place, name, value,
    needs[kind]);
  PetscCheck(kind != OPTION_COUNT || PetscAbsReal(strtod(value, NULL)) <= PETSC_MAX_INT, comm, PETSC_ERR_USER_INPUT,
    "%s-%s has the value \"%s\", which PETSc's integer type cannot hold", place, name, value);
  PetscCall(OptionCheckChoice(comm, place, name, value));
  PetscFunctionReturn(0);
}

static PetscErrorCode OptionCheckName(MPI_Comm comm, const char place[], const char name[])
{
  char guess[PETSC_MAX_OPTION_NAME];

  PetscFunctionBegin;
  if (OptionIsKnown(name)) PetscFunctionReturn(0);
  PetscCall(OptionsGuess(name, sizeof(guess), guess));
  SETERRQ(comm, PETSC_ERR_USER_INPUT, "%sthere is no option -%s; the nearest known one is -%s", place, name, guess);
}

/*@C
   OptionsCheckOne - Raises an error if an option is unknown or has a wrong value

   Collective

   Input Parameters:
+  comm  - the communicator
.  place - with which the message begins, as "FILE: line 3: "
.  name  - the name, without its leading dash
-  value - the value; "" if it has none

   Level: developer

   Error: PETSC_ERR_USER_INPUT

.seealso: `OptionsCheck()`
@*/
PetscErrorCode OptionsCheckOne(MPI_Comm comm, const char place[], const char name[], const char value[])
{
  PetscFunctionBegin;
  PetscCall(OptionCheckName(comm, place, name));
  PetscCall(OptionCheckValue(comm, place, name, value));
  PetscFunctionReturn(0);
}

/*@C
   OptionsCheckValues - Raises an error if an option of this library lacks its value, or its value has the wrong type

   Collective

   Input Parameter:
.  comm - the communicator

   Level: intermediate

   Notes:
   Call it before any option is read: PETSc treats an option without its value as not given, and its error for an
   unreadable value does not name the option. Options that were already read are skipped.

   Error: PETSC_ERR_USER_INPUT, which names option and value.

.seealso: `OptionsCheck()`
@*/
PetscErrorCode OptionsCheckValues(MPI_Comm comm)
{
  char   **names, **values;
  PetscInt n;

  PetscFunctionBegin;
  PetscCall(PetscOptionsLeftGet(NULL, &n, &names, &values));
  for (PetscInt i = 0; i < n; ++i) PetscCall(OptionCheckValue(comm, "", names[i], values[i]));
  PetscCall(PetscOptionsLeftRestore(NULL, &n, &names, &values));
  PetscFunctionReturn(0);
}

/*@C
   OptionsCheck - Raises an error for an unknown option (neither of this library nor with a prefix of PETSc's options),
   and for a wrong value of an option of this library

   Collective

   Input Parameter:
.  comm - the communicator

   Level: intermediate

   Notes:
   Call it once all options are in the database, from the command line, from files, PETSC_OPTIONS or a scene, and before
   they are used. PETSc's options and options of inner solvers cannot be checked beforehand: `-options_left` lists those
   that were never used.

   Errors: PETSC_ERR_USER_INPUT, with the nearest known name.

.seealso: `OptionsCheckValues()`
@*/
PetscErrorCode OptionsCheck(MPI_Comm comm)
{
  char   **names, **values, unknown[PETSC_MAX_OPTION_NAME] = "";
  PetscInt n;

  PetscFunctionBegin;
  PetscCall(PetscOptionsLeftGet(NULL, &n, &names, &values));
  for (PetscInt i = 0; i < n && !unknown[0]; ++i) {
    if (!OptionIsKnown(names[i])) PetscCall(PetscStrncpy(unknown, names[i], sizeof(unknown)));
  }
  PetscCall(PetscOptionsLeftRestore(NULL, &n, &names, &values));
  if (unknown[0]) PetscCall(OptionCheckName(comm, "", unknown));
  PetscCall(OptionsCheckValues(comm));
  PetscFunctionReturn(0);
}
