/*
   solver: a mapping of PETSc options. They are set while the scene exists, unless the command line or an options file
   has set them. Not all PETSc options are known in advance; therefore a misspelt option is reported as unused at the
   end of the run.
*/
#include "sectionsimpl.h"
#include <options.h>

#define SOLVER_PREFIX "solver_"

static PetscErrorCode SceneAddOption(Scene scene, const char place[], const char name[], const char value[])
{
  SceneOption *option;

  PetscFunctionBegin;
  PetscCall(PetscRealloc((size_t)(scene->noptions + 1) * sizeof(*scene->options), &scene->options));
  option        = &scene->options[scene->noptions++];
  option->set   = PETSC_FALSE;
  option->place = place;
  PetscCall(PetscStrallocpy(name, &option->name));
  PetscCall(PetscStrallocpy(value ? value : "", &option->value));
  PetscFunctionReturn(0);
}

PetscErrorCode SceneReadSolver(SceneKeys keys, Scene scene)
{
  const char *text, *name;
  char        option[SCENE_KEY_LENGTH];
  PetscBool   ours, valid;

  PetscFunctionBegin;
  PetscCall(SceneKeysGet(keys, PETSC_FALSE, &text, "solver"));
  if (text && text[0])
    PetscCall(SceneKeysError(keys, "solver", NULL,
      "is \"%s\"; it is a mapping of PETSc options, as solver: {tao_ipfilter_tol: 1e-8}", text));
  for (PetscInt i = 0; i < keys->values.n; ++i) {
    const SceneValue *value = &keys->values.values[i];

    PetscCall(PetscStrncmp(value->key, SOLVER_PREFIX, sizeof(SOLVER_PREFIX) - 1, &ours));
    if (!ours || value->used) continue;
    name = value->key + sizeof(SOLVER_PREFIX) - 1;
    PetscCall(PetscSNPrintf(option, sizeof(option), "-%s", name));
    PetscCall(PetscOptionsValidKey(option, &valid));
    if (!valid) PetscCall(SceneKeysError(keys, "solver", name, "is not the name of an option"));
    PetscCall(SceneAddOption(scene, SceneGetPlace(&keys->places, value->key), name, value->text));
    PetscCall(SceneKeysGet(keys, PETSC_FALSE, &text, "%s", value->key));
  }
  PetscFunctionReturn(0);
}

PetscErrorCode SceneSetOptions(Scene scene)
{
  char      name[SCENE_KEY_LENGTH];
  PetscBool given;

  PetscFunctionBegin;
  for (PetscInt i = 0; i < scene->noptions; ++i) {
    PetscCall(PetscSNPrintf(name, sizeof(name), "-%s", scene->options[i].name));
    PetscCall(PetscOptionsHasName(NULL, NULL, name, &given));
    if (given) continue;
    PetscCall(PetscOptionsSetValue(NULL, name, scene->options[i].value[0] ? scene->options[i].value : NULL));
    scene->options[i].set = PETSC_TRUE;
  }
  PetscFunctionReturn(0);
}

PetscErrorCode SceneDestroyOptions(Scene scene)
{
  char name[SCENE_KEY_LENGTH];

  PetscFunctionBegin;
  for (PetscInt i = 0; i < scene->noptions; ++i) {
    PetscCall(PetscSNPrintf(name, sizeof(name), "-%s", scene->options[i].name));
    if (scene->options[i].set) PetscCall(PetscOptionsClearValue(NULL, name));
    PetscCall(PetscFree(scene->options[i].name));
    PetscCall(PetscFree(scene->options[i].value));
  }
  PetscCall(PetscFree(scene->options));
  PetscFunctionReturn(0);
}

/*@C
   SceneCheckOptions - Raises an error for a solver option of a scene that is unknown or has a wrong value

   Collective

   Input Parameters:
+  comm  - the communicator
-  scene - the scene

   Level: intermediate

   Notes:
   The error names the place of the option in the file. Options that the command line overrides are not checked.

   Error: PETSC_ERR_USER_INPUT

.seealso: `SceneLoad()`, `OptionsCheck()`
@*/
PetscErrorCode SceneCheckOptions(MPI_Comm comm, Scene scene)
{
  PetscFunctionBegin;
  for (PetscInt i = 0; i < scene->noptions; ++i) {
    const SceneOption *option = &scene->options[i];

    if (option->set) PetscCall(OptionsCheckOne(comm, ScenePlace(option), option->name, option->value));
  }
  PetscFunctionReturn(0);
}

/*@C
   SceneReportUnusedOptions - Warns on stderr of every solver option of a scene that was not used

   Collective

   Input Parameters:
+  comm  - the communicator
-  scene - the scene, after its run

   Level: intermediate

   Note:
   Such an option is misspelt, or belongs to a solver that did not run. One that the command line overrides is
   not reported.

.seealso: `SceneLoad()`
@*/
PetscErrorCode SceneReportUnusedOptions(MPI_Comm comm, Scene scene)
{
  PetscBool used;

  PetscFunctionBegin;
  for (PetscInt i = 0; i < scene->noptions; ++i) {
    const SceneOption *option = &scene->options[i];

    if (!option->set) continue;
    PetscCall(PetscOptionsUsed(NULL, option->name, &used));
    if (!used)
      PetscCall(PetscFPrintf(comm, stderr,
        "contact: warning: scene \"%s\": nothing uses the option \"%s\" of solver; it is misspelt, or belongs to a "
        "solver that did not run\n",
        scene->name, option->name));
  }
  PetscFunctionReturn(0);
}
