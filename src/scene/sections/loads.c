/* pressures and body_forces: lists of named loads */
#include "sectionsimpl.h"

PetscErrorCode SceneReadPressures(SceneKeys keys, Scene scene)
{
  char        key[SCENE_KEY_LENGTH];
  char      **names;
  const char *text;

  PetscFunctionBegin;
  PetscCall(SceneGetNames(keys, "pressures", PETSC_FALSE, &scene->npressures, &names));
  PetscCall(PetscCalloc1(scene->npressures, &scene->pressures));
  for (PetscInt p = 0; p < scene->npressures; ++p) {
    ScenePressure *pressure = &scene->pressures[p];

    pressure->name = names[p];
    PetscCall(SceneKeysGet(keys, PETSC_TRUE, &text, "pressures_%s_face", pressure->name));
    PetscCall(PetscStrallocpy(text ? text : "", &pressure->face));
    PetscCall(PetscSNPrintf(key, sizeof(key), "pressures_%s_value", pressure->name));
    PetscCall(SceneKeysGet(keys, PETSC_TRUE, &text, "%s", key));
    if (text) PetscCall(SceneParseReal(keys, key, text, &pressure->value));
    PetscCall(PetscSNPrintf(key, sizeof(key), "pressures_%s_follows", pressure->name));
    PetscCall(SceneKeysGet(keys, PETSC_FALSE, &text, "%s", key));
    if (text) PetscCall(SceneParseAnswer(keys, key, text, &pressure->follows));
    PetscCall(SceneReadRampName(keys, scene, "pressures", pressure->name, &pressure->ramp));
  }
  PetscCall(PetscFree(names));
  PetscFunctionReturn(0);
}

PetscErrorCode SceneReadBodyForces(SceneKeys keys, Scene scene)
{
  char        key[SCENE_KEY_LENGTH];
  char      **names;
  const char *text;

  PetscFunctionBegin;
  PetscCall(SceneGetNames(keys, "body_forces", PETSC_FALSE, &scene->nforces, &names));
  PetscCall(PetscCalloc1(scene->nforces, &scene->forces));
  for (PetscInt f = 0; f < scene->nforces; ++f) {
    SceneBodyForce *force = &scene->forces[f];

    force->name = names[f];
    PetscCall(SceneReadBodyName(keys, scene, "body_forces", force->name, &force->body));
    PetscCall(PetscSNPrintf(key, sizeof(key), "body_forces_%s_value", force->name));
    PetscCall(SceneKeysGet(keys, PETSC_TRUE, &text, "%s", key));
    if (text) PetscCall(SceneParseReals(keys, key, text, 3, force->value));
    PetscCall(SceneReadRampName(keys, scene, "body_forces", force->name, &force->ramp));
  }
  PetscCall(PetscFree(names));
  PetscFunctionReturn(0);
}
