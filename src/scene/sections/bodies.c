/* bodies: shape, material and element of each body. */
#include "sectionsimpl.h"
#include <petscviewer.h>
#include <string.h>

static PetscErrorCode SceneRefuseOfRigid(SceneKeys keys, const char owner[])
{
  static const char *const elastic[] = {"young", "poisson", "element", "order", "serendipity"};
  PetscBool                has;

  PetscFunctionBegin;
  for (size_t i = 0; i < PETSC_STATIC_ARRAY_LENGTH(elastic); ++i) {
    PetscCall(SceneHasKey(keys, owner, elastic[i], &has));
    if (has) PetscCall(SceneKeysError(keys, owner, NULL, "is rigid, and so has no %s", elastic[i]));
  }
  PetscFunctionReturn(0);
}

PetscErrorCode SceneFinishBody(SceneKeys keys, Scene scene, const char owner[], void *entry)
{
  SceneBody  *body   = entry;
  PetscBool   listed = PETSC_FALSE;
  char        key[SCENE_KEY_LENGTH];
  const char *text;

  PetscFunctionBegin;
  PetscCall(SceneReadShape(keys, owner, body));
  PetscCall(PetscSNPrintf(key, sizeof(key), "%s_material", owner));
  PetscCall(SceneKeysGet(keys, PETSC_FALSE, &text, "%s", key));
  if (text) PetscCall(SceneFindMaterial(keys, key, text, &listed, &body->material));
  else if (SceneBodyIsSurface(body)) body->material.type = MATERIAL_RIGID;
  if (listed) PetscCall(PetscStrallocpy(text, &body->material_name));
  if (body->material.type == MATERIAL_RIGID) {
    body->order = 1;
    PetscCall(SceneRefuseOfRigid(keys, owner));
    PetscCall(SceneReadConstants(keys, owner, listed, &body->material));
    PetscCall(SceneFinishInertia(keys, scene, owner, body));
    PetscFunctionReturn(0);
  }
  PetscCall(SceneReadConstants(keys, owner, listed, &body->material));
  PetscCall(SceneFinishInertia(keys, scene, owner, body));
  PetscCall(SceneReadRows(keys, scene, owner, keys->list->rows, "elastic", body));
  PetscCall(SceneHasKey(keys, owner, "order", &listed));
  if (listed && !body->order) PetscCall(SceneKeysError(keys, owner, NULL, "has order = 0, which must be 1 or 2"));
  if (body->serendipity && body->order != 2)
    PetscCall(SceneKeysError(keys, owner, NULL, "has serendipity: true, which needs order: 2"));
  if (body->element == ELEMENT_REDUCED && !body->serendipity)
    PetscCall(SceneKeysError(keys, owner, NULL, "has element: reduced, which needs serendipity: true"));
  PetscFunctionReturn(0);
}

/*
   Gives rigid bodies the largest Young's modulus of all bodies, so that the matrix rows of rigid bodies have entries of
   similar size as other rows.
*/
PetscErrorCode SceneScaleRigid(Scene scene)
{
  PetscReal young = 0;

  PetscFunctionBegin;
  for (PetscInt b = 0; b < scene->nbodies; ++b) young = PetscMax(young, scene->bodies[b].material.young);
  for (PetscInt b = 0; b < scene->nbodies; ++b) {
    if (scene->bodies[b].material.type == MATERIAL_RIGID) scene->bodies[b].material.young = young > 0 ? young : 1;
  }
  PetscFunctionReturn(0);
}

static PetscErrorCode SceneViewBody(Scene scene, PetscViewer viewer, const SceneList *list, const SceneBody *body)
{
  PetscFunctionBegin;
  PetscCall(PetscViewerASCIIPrintf(viewer, "- %s:\n", body->name));
  PetscCall(PetscViewerASCIIPushTab(viewer));
  PetscCall(PetscViewerASCIIPushTab(viewer));
  PetscCall(SceneViewShape(body, viewer));
  PetscCall(PetscViewerASCIIPrintf(viewer, "material: %s\n", MaterialTypes[body->material.type]));
  PetscCall(SceneViewConstants(&body->material, viewer));
  if (body->material.type != MATERIAL_RIGID)
    PetscCall(SceneViewRows(scene, viewer, list->rows, "elastic", body, list->initial));
  PetscCall(SceneViewRows(scene, viewer, list->rows, NULL, body, list->initial));
  PetscCall(PetscViewerASCIIPopTab(viewer));
  PetscCall(PetscViewerASCIIPopTab(viewer));
  PetscFunctionReturn(0);
}

PetscErrorCode SceneViewBodies(Scene scene, PetscViewer viewer, const SceneList *list)
{
  PetscFunctionBegin;
  PetscCall(PetscViewerASCIIPrintf(viewer, "bodies:\n"));
  PetscCall(PetscViewerASCIIPushTab(viewer));
  for (PetscInt b = 0; b < scene->nbodies; ++b) PetscCall(SceneViewBody(scene, viewer, list, &scene->bodies[b]));
  PetscCall(PetscViewerASCIIPopTab(viewer));
  PetscFunctionReturn(0);
}
