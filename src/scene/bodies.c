/* bodies: a list of named bodies, each with its shape, mesh and material */
#include "sceneimpl.h"

const char *const BodyShapes[] = {"box", "BodyShape", "SHAPE_", NULL};

static PetscErrorCode SceneReadBox(SceneKeys keys, SceneBody *body)
{
  char        key[SCENE_KEY_LENGTH];
  const char *text;
  const struct {
    const char *name;
    PetscReal  *corner;
  } corners[] = {
    {"lower", body->lower},
    {"upper", body->upper}
  };

  PetscFunctionBegin;
  for (size_t i = 0; i < PETSC_STATIC_ARRAY_LENGTH(corners); ++i) {
    PetscCall(PetscSNPrintf(key, sizeof(key), "bodies_%s_%s", body->name, corners[i].name));
    PetscCall(SceneKeysGet(keys, PETSC_TRUE, &text, "%s", key));
    if (text) PetscCall(SceneParseReals(keys, key, text, 3, corners[i].corner));
  }
  PetscCall(PetscSNPrintf(key, sizeof(key), "bodies_%s_cells", body->name));
  PetscCall(SceneKeysGet(keys, PETSC_TRUE, &text, "%s", key));
  if (text) PetscCall(SceneParseInts(keys, key, text, 3, body->cells));
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
    {"young",   &body->material.young  },
    {"poisson", &body->material.poisson}
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
  char      **names;
  char        key[SCENE_KEY_LENGTH];
  const char *text;

  PetscFunctionBegin;
  PetscCall(SceneGetNames(keys, "bodies", PETSC_TRUE, &scene->nbodies, &names));
  PetscCall(PetscCalloc1(scene->nbodies, &scene->bodies));
  for (PetscInt b = 0; b < scene->nbodies; ++b) {
    SceneBody *body  = &scene->bodies[b];
    PetscInt   shape = SHAPE_BOX;

    body->name = names[b];
    PetscCall(PetscSNPrintf(key, sizeof(key), "bodies_%s_shape", body->name));
    PetscCall(SceneKeysGet(keys, PETSC_FALSE, &text, "%s", key));
    if (text) PetscCall(SceneParseEnum(keys, key, text, BodyShapes, &shape));
    body->shape = (BodyShape)shape;
    PetscCall(SceneReadBox(keys, body));
    PetscCall(SceneReadMaterial(keys, body));
  }
  PetscCall(PetscFree(names));
  PetscFunctionReturn(0);
}
