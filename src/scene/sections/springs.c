/* springs: those between faces and the ground, or other faces; weak_springs */
#include "sectionsimpl.h"
#include <petscviewer.h>
#include <string.h>

/* true, false, or how stiff; a body that is held by more than a hundredth of its own stiffness is not held weakly */
static PetscErrorCode SceneParseWeakSprings(SceneKeys keys, const char text[], PetscReal *stiffness)
{
  PetscBool yes, no;

  PetscFunctionBegin;
  PetscCall(PetscStrcasecmp(text, "true", &yes));
  PetscCall(PetscStrcasecmp(text, "false", &no));
  if (yes) *stiffness = SCENE_WEAK_SPRINGS;
  else if (!no) {
    PetscCall(SceneParseReal(keys, "weak_springs", text, stiffness));
    if (!(*stiffness > 0 && *stiffness <= 0.01))
      PetscCall(SceneKeysComplain(keys,
        "weak_springs is %s; it is true, false, or what they are worth of a body's stiffness, above 0 and at most 0.01",
        text));
  }
  PetscFunctionReturn(0);
}

/* Another face in place of the ground, and how far away it may be */
static PetscErrorCode SceneReadOtherEnd(SceneKeys keys, SceneSpring *spring)
{
  char        key[SCENE_KEY_LENGTH];
  const char *text;

  PetscFunctionBegin;
  PetscCall(SceneKeysGet(keys, PETSC_FALSE, &text, "springs_%s_to", spring->name));
  if (text) PetscCall(PetscStrallocpy(text, &spring->to));
  PetscCall(PetscSNPrintf(key, sizeof(key), "springs_%s_distance", spring->name));
  PetscCall(SceneKeysGet(keys, PETSC_FALSE, &text, "%s", key));
  if (!text) PetscFunctionReturn(0);
  PetscCall(SceneParseReal(keys, key, text, &spring->distance));
  if (!(spring->distance > 0)) PetscCall(SceneKeysComplain(keys, "%s is %s, which must be above 0", key, text));
  else if (!spring->to)
    PetscCall(SceneKeysComplain(keys,
      "%s is how far away the other face of springs may be, and these are to the ground; the key to names one", key));
  PetscFunctionReturn(0);
}

PetscErrorCode SceneReadSprings(SceneKeys keys, Scene scene)
{
  char      **names;
  const char *text;

  PetscFunctionBegin;
  PetscCall(SceneKeysGet(keys, PETSC_FALSE, &text, "weak_springs"));
  if (text) PetscCall(SceneParseWeakSprings(keys, text, &scene->weak_springs));
  PetscCall(SceneGetNames(keys, "springs", PETSC_FALSE, &scene->nsprings, &names));
  PetscCall(PetscCalloc1(scene->nsprings, &scene->springs));
  for (PetscInt s = 0; s < scene->nsprings; ++s) {
    SceneSpring *spring = &scene->springs[s];

    spring->name = names[s];
    PetscCall(SceneReadOnFace(keys, "springs", spring->name, &spring->face, spring->value));
    PetscCall(SceneReadOtherEnd(keys, spring));
    for (PetscInt d = 0; d < 3; ++d) {
      if (spring->value[d] < 0)
        PetscCall(SceneKeysComplain(keys, "springs_%s_value has a stiffness of %g along %c, which must not be negative",
          spring->name, (double)spring->value[d], "xyz"[d]));
    }
    if (spring->value[0] == 0 && spring->value[1] == 0 && spring->value[2] == 0)
      PetscCall(
        SceneKeysComplain(keys, "springs_%s_value is zero along each axis: such springs hold nothing", spring->name));
  }
  PetscCall(PetscFree(names));
  PetscFunctionReturn(0);
}

PetscErrorCode SceneValidateSprings(MPI_Comm comm, const char file[], Scene scene)
{
  PetscFunctionBegin;
  for (PetscInt s = 0; s < scene->nsprings; ++s) {
    const SceneSpring *spring = &scene->springs[s];

    PetscCall(SceneValidateFace(comm, file, scene, "spring", spring->name, spring->face));
    if (!spring->to) continue;
    PetscCall(SceneValidateFace(comm, file, scene, "spring", spring->name, spring->to));
    PetscCheck(strcmp(spring->face, spring->to), comm, PETSC_ERR_USER_INPUT,
      "%s: spring \"%s\" has the same face \"%s\" at both ends", file, spring->name, spring->face);
  }
  PetscFunctionReturn(0);
}

PetscErrorCode SceneViewSprings(Scene scene, PetscViewer viewer)
{
  PetscFunctionBegin;
  if (scene->nsprings) PetscCall(PetscViewerASCIIPrintf(viewer, "springs:\n"));
  for (PetscInt s = 0; s < scene->nsprings; ++s) {
    PetscCall(PetscViewerASCIIPrintf(viewer, "  - %s: {face: %s, ", scene->springs[s].name, scene->springs[s].face));
    if (scene->springs[s].to) PetscCall(PetscViewerASCIIPrintf(viewer, "to: %s, ", scene->springs[s].to));
    if (scene->springs[s].distance > 0) {
      PetscCall(PetscViewerASCIIPrintf(viewer, "distance: "));
      PetscCall(SceneViewReal(viewer, scene->springs[s].distance));
      PetscCall(PetscViewerASCIIPrintf(viewer, ", "));
    }
    PetscCall(PetscViewerASCIIPrintf(viewer, "value: "));
    PetscCall(SceneViewList(viewer, 3, scene->springs[s].value));
    PetscCall(PetscViewerASCIIPrintf(viewer, "}\n"));
  }
  if (scene->weak_springs == SCENE_WEAK_SPRINGS) PetscCall(PetscViewerASCIIPrintf(viewer, "weak_springs: true\n"));
  else if (scene->weak_springs > 0) {
    PetscCall(PetscViewerASCIIPrintf(viewer, "weak_springs: "));
    PetscCall(SceneViewReal(viewer, scene->weak_springs));
    PetscCall(PetscViewerASCIIPrintf(viewer, "\n"));
  }
  PetscFunctionReturn(0);
}

PetscErrorCode SceneDestroySprings(Scene scene)
{
  PetscFunctionBegin;
  for (PetscInt s = 0; s < scene->nsprings; ++s) {
    PetscCall(PetscFree(scene->springs[s].name));
    PetscCall(PetscFree(scene->springs[s].face));
    PetscCall(PetscFree(scene->springs[s].to));
  }
  PetscCall(PetscFree(scene->springs));
  PetscFunctionReturn(0);
}
