/* tractions and forces: lists of named dead loads on faces */
#include "sectionsimpl.h"
#include <petscviewer.h>

/* Three numbers of <list>_<name>_<what>; given, or NULL where they are required: whether they are there */
PetscErrorCode SceneReadTriple(SceneKeys keys, const char list[], const char name[], const char what[],
  PetscReal value[3], PetscBool *given)
{
  char        key[SCENE_KEY_LENGTH];
  const char *text;

  PetscFunctionBegin;
  PetscCall(PetscSNPrintf(key, sizeof(key), "%s_%s_%s", list, name, what));
  PetscCall(SceneKeysGet(keys, (PetscBool)!given, &text, "%s", key));
  if (text) PetscCall(SceneParseReals(keys, key, text, 3, value));
  if (given) *given = (PetscBool)(text != NULL);
  PetscFunctionReturn(0);
}

static PetscErrorCode SceneReadFaceName(SceneKeys keys, const char list[], const char name[], char **face)
{
  const char *text;

  PetscFunctionBegin;
  PetscCall(SceneKeysGet(keys, PETSC_TRUE, &text, "%s_%s_face", list, name));
  PetscCall(PetscStrallocpy(text ? text : "", face));
  PetscFunctionReturn(0);
}

PetscErrorCode SceneReadOnFace(SceneKeys keys, const char list[], const char name[], char **face, PetscReal value[3])
{
  PetscFunctionBegin;
  PetscCall(SceneReadFaceName(keys, list, name, face));
  PetscCall(SceneReadTriple(keys, list, name, "value", value, NULL));
  PetscFunctionReturn(0);
}

/* Force, moment or both, and where they act */
static PetscErrorCode SceneReadResultant(SceneKeys keys, SceneTraction *force)
{
  PetscBool turns, pushes;

  PetscFunctionBegin;
  PetscCall(SceneReadTriple(keys, "forces", force->name, "moment", force->moment, &turns));
  PetscCall(SceneReadTriple(keys, "forces", force->name, "value", force->value, turns ? &pushes : NULL));
  PetscCall(SceneReadTriple(keys, "forces", force->name, "point", force->point, &force->placed));
  PetscFunctionReturn(0);
}

/* A force: on a face or on a rigid body */
static PetscErrorCode SceneReadForce(SceneKeys keys, Scene scene, SceneTraction *force)
{
  const char *text, *face;
  char        whole[SCENE_KEY_LENGTH];
  PetscInt    body;

  PetscFunctionBegin;
  PetscCall(SceneKeysGet(keys, PETSC_FALSE, &text, "forces_%s_body", force->name));
  PetscCall(SceneReadBodyName(keys, scene, "forces", force->name, &body));
  PetscCall(SceneReadResultant(keys, force));
  if (!text) {
    PetscCall(SceneReadFaceName(keys, "forces", force->name, &force->face));
    PetscFunctionReturn(0);
  }
  if (body >= 0 && scene->bodies[body].material.type != MATERIAL_RIGID)
    PetscCall(SceneKeysComplain(keys,
      "forces_%s_body is \"%s\", which is not rigid: on an elastic body forces act on faces", force->name, text));
  PetscCall(SceneKeysGet(keys, PETSC_FALSE, &face, "forces_%s_face", force->name));
  if (face)
    PetscCall(SceneKeysComplain(keys, "force \"%s\" names a face and a body; it is one of the two", force->name));
  PetscCall(PetscSNPrintf(whole, sizeof(whole), "%s" SCENE_WHOLE_BODY, text));
  PetscCall(PetscStrallocpy(whole, &force->face));
  PetscFunctionReturn(0);
}

static PetscErrorCode SceneReadTractionList(SceneKeys keys, Scene scene, const char list[], PetscBool resultant)
{
  char   **names;
  PetscInt n;

  PetscFunctionBegin;
  PetscCall(SceneGetNames(keys, list, PETSC_FALSE, &n, &names));
  PetscCall(PetscRealloc((size_t)(scene->ntractions + n) * sizeof(*scene->tractions), &scene->tractions));
  for (PetscInt t = 0; t < n; ++t) {
    SceneTraction *traction = &scene->tractions[scene->ntractions++];

    *traction = (SceneTraction){.name = names[t], .resultant = resultant};
    if (resultant) PetscCall(SceneReadForce(keys, scene, traction));
    else PetscCall(SceneReadOnFace(keys, list, names[t], &traction->face, traction->value));
    PetscCall(SceneReadRampName(keys, scene, list, names[t], &traction->ramp));
  }
  PetscCall(PetscFree(names));
  PetscFunctionReturn(0);
}

PetscErrorCode SceneReadTractions(SceneKeys keys, Scene scene)
{
  PetscFunctionBegin;
  PetscCall(SceneReadTractionList(keys, scene, "tractions", PETSC_FALSE));
  PetscCall(SceneReadTractionList(keys, scene, "forces", PETSC_TRUE));
  PetscFunctionReturn(0);
}

static PetscErrorCode SceneViewTractionList(Scene scene, PetscViewer viewer, PetscBool resultant)
{
  PetscBool first = PETSC_TRUE;

  PetscFunctionBegin;
  for (PetscInt t = 0; t < scene->ntractions; ++t) {
    const SceneTraction *traction = &scene->tractions[t];

    if (traction->resultant != resultant) continue;
    if (first) PetscCall(PetscViewerASCIIPrintf(viewer, "%s:\n", resultant ? "forces" : "tractions"));
    first = PETSC_FALSE;
    PetscCall(PetscViewerASCIIPrintf(viewer, "  - %s: {", traction->name));
    PetscCall(SceneViewTarget(viewer, traction->face));
    PetscCall(PetscViewerASCIIPrintf(viewer, ", value: "));
    PetscCall(SceneViewList(viewer, 3, traction->value));
    if (traction->placed) {
      PetscCall(PetscViewerASCIIPrintf(viewer, ", point: "));
      PetscCall(SceneViewList(viewer, 3, traction->point));
    }
    if (traction->moment[0] != 0 || traction->moment[1] != 0 || traction->moment[2] != 0) {
      PetscCall(PetscViewerASCIIPrintf(viewer, ", moment: "));
      PetscCall(SceneViewList(viewer, 3, traction->moment));
    }
    if (traction->ramp) PetscCall(PetscViewerASCIIPrintf(viewer, ", ramp: %s", scene->ramps[traction->ramp].name));
    PetscCall(PetscViewerASCIIPrintf(viewer, "}\n"));
  }
  PetscFunctionReturn(0);
}

PetscErrorCode SceneViewTractions(Scene scene, PetscViewer viewer)
{
  PetscFunctionBegin;
  PetscCall(SceneViewTractionList(scene, viewer, PETSC_FALSE));
  PetscCall(SceneViewTractionList(scene, viewer, PETSC_TRUE));
  PetscFunctionReturn(0);
}

PetscErrorCode SceneDestroyTractions(Scene scene)
{
  PetscFunctionBegin;
  for (PetscInt t = 0; t < scene->ntractions; ++t) {
    PetscCall(PetscFree(scene->tractions[t].name));
    PetscCall(PetscFree(scene->tractions[t].face));
  }
  PetscCall(PetscFree(scene->tractions));
  PetscFunctionReturn(0);
}
