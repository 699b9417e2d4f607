/* displacements: a list of named prescribed displacements */
#include "sectionsimpl.h"

/* value: three entries, each a displacement or the word free */
static PetscErrorCode SceneReadComponents(SceneKeys keys, SceneDisplacement *displacement)
{
  char        key[SCENE_KEY_LENGTH];
  const char *text;
  char      **words;
  PetscInt    n = 3;

  PetscFunctionBegin;
  PetscCall(PetscSNPrintf(key, sizeof(key), "displacements_%s_value", displacement->name));
  PetscCall(SceneKeysGet(keys, PETSC_TRUE, &text, "%s", key));
  if (!text) PetscFunctionReturn(0);
  PetscCall(SceneParseList(keys, key, text, &n, &words));
  for (PetscInt i = 0; i < n; ++i) {
    PetscBool free;

    PetscCall(PetscStrcasecmp(words[i], "free", &free));
    displacement->fixed[i] = free ? PETSC_FALSE : PETSC_TRUE;
    if (!free) PetscCall(SceneParseReal(keys, key, words[i], &displacement->value[i]));
  }
  if (words) PetscCall(PetscStrToArrayDestroy((int)n, words));
  PetscFunctionReturn(0);
}

PetscErrorCode SceneReadDisplacements(SceneKeys keys, Scene scene)
{
  char **names;

  PetscFunctionBegin;
  PetscCall(SceneGetNames(keys, "displacements", PETSC_FALSE, &scene->ndisplacements, &names));
  PetscCall(PetscCalloc1(scene->ndisplacements, &scene->displacements));
  for (PetscInt d = 0; d < scene->ndisplacements; ++d) {
    SceneDisplacement *displacement = &scene->displacements[d];

    displacement->name = names[d];
    PetscCall(SceneReadTarget(keys, scene, displacement));
    PetscCall(SceneReadComponents(keys, displacement));
    PetscCall(SceneReadRotation(keys, displacement));
    PetscCall(SceneReadRampName(keys, scene, "displacements", displacement->name, &displacement->ramp));
  }
  PetscCall(PetscFree(names));
  PetscFunctionReturn(0);
}
