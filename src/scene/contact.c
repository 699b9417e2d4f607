/* contact: a list of named pairs of faces */
#include "sceneimpl.h"

PetscErrorCode SceneReadContact(SceneKeys keys, Scene scene)
{
  char      **names;
  const char *text;

  PetscFunctionBegin;
  PetscCall(SceneGetNames(keys, "contact", PETSC_FALSE, &scene->npairs, &names));
  PetscCall(PetscCalloc1(scene->npairs, &scene->pairs));
  for (PetscInt p = 0; p < scene->npairs; ++p) {
    SceneContactPair *pair = &scene->pairs[p];

    pair->name = names[p];
    PetscCall(SceneKeysGet(keys, PETSC_TRUE, &text, "contact_%s_mortar", pair->name));
    PetscCall(PetscStrallocpy(text ? text : "", &pair->mortar));
    PetscCall(SceneKeysGet(keys, PETSC_TRUE, &text, "contact_%s_nonmortar", pair->name));
    PetscCall(PetscStrallocpy(text ? text : "", &pair->nonmortar));
  }
  PetscCall(PetscFree(names));
  PetscFunctionReturn(0);
}
