/* bodies: a list of named bodies, each with its shape, mesh and material */
#include "sectionsimpl.h"

static PetscErrorCode SceneReadElement(SceneKeys keys, SceneBody *body)
{
  char        key[SCENE_KEY_LENGTH];
  const char *text;
  PetscInt    element = ELEMENT_FULL;

  PetscFunctionBegin;
  body->order = body->material.type == MATERIAL_RIGID ? 1 : 0;
  if (body->material.type == MATERIAL_RIGID) PetscFunctionReturn(0);
  PetscCall(PetscSNPrintf(key, sizeof(key), "bodies_%s_element", body->name));
  PetscCall(SceneKeysGet(keys, PETSC_FALSE, &text, "%s", key));
  if (text) PetscCall(SceneParseEnum(keys, key, text, ElementTypes, &element));
  body->element = (ElementType)element;
  PetscCall(PetscSNPrintf(key, sizeof(key), "bodies_%s_order", body->name));
  PetscCall(SceneKeysGet(keys, PETSC_FALSE, &text, "%s", key));
  if (!text) PetscFunctionReturn(0);
  PetscCall(SceneParseInt(keys, key, text, &body->order));
  if (!body->order) PetscCall(SceneKeysComplain(keys, "body \"%s\" has order = 0, which must be 1 or 2", body->name));
  PetscFunctionReturn(0);
}

static PetscErrorCode SceneRefuseOfRigid(SceneKeys keys, const SceneBody *body)
{
  static const char *const elastic[] = {"young", "poisson", "element", "order"};
  const char              *text;

  PetscFunctionBegin;
  for (size_t i = 0; i < PETSC_STATIC_ARRAY_LENGTH(elastic); ++i) {
    PetscCall(SceneKeysGet(keys, PETSC_FALSE, &text, "bodies_%s_%s", body->name, elastic[i]));
    if (text) PetscCall(SceneKeysComplain(keys, "body \"%s\" is rigid, and so has no %s", body->name, elastic[i]));
  }
  PetscFunctionReturn(0);
}

static PetscErrorCode SceneReadMaterial(SceneKeys keys, SceneBody *body)
{
  char        key[SCENE_KEY_LENGTH];
  const char *text;
  PetscBool   listed = PETSC_FALSE;

  PetscFunctionBegin;
  PetscCall(PetscSNPrintf(key, sizeof(key), "bodies_%s_material", body->name));
  PetscCall(SceneKeysGet(keys, PETSC_FALSE, &text, "%s", key));
  if (text) PetscCall(SceneFindMaterial(keys, key, text, &listed, &body->material));
  if (body->material.type == MATERIAL_RIGID) {
    PetscCall(SceneRefuseOfRigid(keys, body));
    PetscFunctionReturn(0);
  }
  PetscCall(PetscSNPrintf(key, sizeof(key), "bodies_%s", body->name));
  PetscCall(SceneReadConstants(keys, key, listed, &body->material));
  PetscFunctionReturn(0);
}

/* Gives a rigid body a stiffness, so that its rows of the matrix are as large as those of the others */
static PetscErrorCode SceneScaleRigid(Scene scene)
{
  PetscReal young = 0;

  PetscFunctionBegin;
  for (PetscInt b = 0; b < scene->nbodies; ++b) young = PetscMax(young, scene->bodies[b].material.young);
  for (PetscInt b = 0; b < scene->nbodies; ++b) {
    if (scene->bodies[b].material.type == MATERIAL_RIGID) scene->bodies[b].material.young = young > 0 ? young : 1;
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
  PetscCall(SceneScaleRigid(scene));
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
  if (*body < 0)
    PetscCall(SceneKeysComplain(keys, "%s_%s_body is \"%s\", which is no body of the scene", list, name, text));
  PetscFunctionReturn(0);
}
