/* bodies: a list of named bodies, each with its shape, mesh and material */
#include "sceneimpl.h"

static PetscErrorCode SceneReadElement(SceneKeys keys, SceneBody *body)
{
  char        key[SCENE_KEY_LENGTH];
  const char *text;
  PetscInt    element = ELEMENT_FULL;

  PetscFunctionBegin;
  PetscCall(PetscSNPrintf(key, sizeof(key), "bodies_%s_element", body->name));
  PetscCall(SceneKeysGet(keys, PETSC_FALSE, &text, "%s", key));
  if (text) PetscCall(SceneParseEnum(keys, key, text, ElementTypes, &element));
  body->element = (ElementType)element;
  body->order   = 1;
  PetscCall(PetscSNPrintf(key, sizeof(key), "bodies_%s_order", body->name));
  PetscCall(SceneKeysGet(keys, PETSC_FALSE, &text, "%s", key));
  if (text) PetscCall(SceneParseInt(keys, key, text, &body->order));
  PetscFunctionReturn(0);
}

static PetscErrorCode SceneReadMaterial(SceneKeys keys, SceneBody *body)
{
  char        key[SCENE_KEY_LENGTH];
  const char *text;
  PetscInt    type = MATERIAL_LINEAR;
  const struct {
    const char *name;
    PetscReal  *value;
  } constants[] = {
    {"young", &body->material.young},
    {"poisson", &body->material.poisson},
  };

  PetscFunctionBegin;
  PetscCall(PetscSNPrintf(key, sizeof(key), "bodies_%s_material", body->name));
  PetscCall(SceneKeysGet(keys, PETSC_FALSE, &text, "%s", key));
  if (text) PetscCall(SceneParseEnum(keys, key, text, MaterialTypes, &type));
  body->material.type = (MaterialType)type;
  for (size_t i = 0; i < PETSC_STATIC_ARRAY_LENGTH(constants); ++i) {
    PetscCall(PetscSNPrintf(key, sizeof(key), "bodies_%s_%s", body->name, constants[i].name));
    PetscCall(SceneKeysGet(keys, PETSC_TRUE, &text, "%s", key));
    if (text) PetscCall(SceneParseReal(keys, key, text, constants[i].value));
  }
  PetscFunctionReturn(0);
}

PetscErrorCode SceneReadBodies(SceneKeys keys, Scene scene)
{
  char **names;

  PetscFunctionBegin;
  PetscCall(SceneGetNames(keys, "bodies", PETSC_TRUE, &scene->nbodies, &names));
  PetscCall(PetscCalloc1(scene->nbodies, &scene->bodies));
  for (PetscInt b = 0; b < scene->nbodies; ++b) {
    SceneBody *body = &scene->bodies[b];

    body->name = names[b];
    PetscCall(SceneReadShape(keys, body));
    PetscCall(SceneReadMaterial(keys, body));
    PetscCall(SceneReadElement(keys, body));
  }
  PetscCall(PetscFree(names));
  PetscFunctionReturn(0);
}

/* The body that <list>_<name> names by its key body; PETSC_DECIDE, any or every one, where it names none */
PetscErrorCode SceneReadBodyName(SceneKeys keys, Scene scene, const char list[], const char name[], PetscInt *body)
{
  const char *text;
  PetscBool   same;

  PetscFunctionBegin;
  *body = PETSC_DECIDE;
  PetscCall(SceneKeysGet(keys, PETSC_FALSE, &text, "%s_%s_body", list, name));
  if (!text) PetscFunctionReturn(0);
  for (PetscInt b = 0; b < scene->nbodies; ++b) {
    PetscCall(PetscStrcmp(text, scene->bodies[b].name, &same));
    if (same) *body = b;
  }
  if (*body < 0) PetscCall(SceneKeysComplain(keys, "%s_%s_body is \"%s\", which is no body of the scene", list, name, text));
  PetscFunctionReturn(0);
}
