/* springs and weak_springs: keys that are not single values. */
#include "sectionsimpl.h"
#include <petscviewer.h>
#include <string.h>

/*
   Reads `weak_springs`: true, false, or the relative stiffness. It must be at most 0.01, since stiffer springs would
   not be weak.
*/
static PetscErrorCode WeakSpringsRead(SceneKeys keys, Scene scene, const char key[], const char text[], void *entry)
{
  PetscReal *stiffness = &scene->weak_springs;
  PetscBool  yes, no;

  PetscFunctionBegin;
  (void)entry;
  PetscCall(PetscStrcasecmp(text, "true", &yes));
  PetscCall(PetscStrcasecmp(text, "false", &no));
  if (yes) *stiffness = MODEL_WEAK_SPRINGS;
  if (yes || no) PetscFunctionReturn(0);
  PetscCall(SceneParseReal(keys, key, text, stiffness));
  if (!(*stiffness > 0 && *stiffness <= 0.01))
    PetscCall(SceneKeysError(keys, key, NULL,
      "is %s; it must be true, false, or a fraction of the softest body's stiffness, above 0 and at most 0.01", text));
  PetscFunctionReturn(0);
}

static PetscBool WeakSpringsAreShown(const void *entry)
{
  return (PetscBool)(((const struct _n_Scene *)entry)->weak_springs > 0);
}

static PetscErrorCode WeakSpringsView(Scene scene, PetscViewer viewer, const void *entry)
{
  PetscFunctionBegin;
  (void)entry;
  if (scene->weak_springs == MODEL_WEAK_SPRINGS) PetscCall(PetscViewerASCIIPrintf(viewer, "true"));
  else PetscCall(SceneViewReal(viewer, scene->weak_springs));
  PetscFunctionReturn(0);
}

const SceneOwn SceneOwnWeakSprings = {WeakSpringsRead, WeakSpringsAreShown, WeakSpringsView, 0};

PetscErrorCode SceneFinishSpring(SceneKeys keys, Scene scene, const char owner[], void *entry)
{
  SceneSpring *spring = entry;

  PetscFunctionBegin;
  (void)scene;
  if (spring->distance > 0 && !spring->to)
    PetscCall(SceneKeysError(keys, owner, "distance",
      "is for springs between two faces, but these are to the ground: name the other face by the key to"));
  for (PetscInt d = 0; d < 3; ++d) {
    if (spring->value[d] < 0)
      PetscCall(SceneKeysError(keys, owner, "value", "has a stiffness of %g along %c, which must not be negative",
        (double)spring->value[d], "xyz"[d]));
  }
  if (spring->value[0] == 0 && spring->value[1] == 0 && spring->value[2] == 0)
    PetscCall(SceneKeysError(keys, owner, "value", "is zero along each axis: such springs hold nothing"));
  PetscFunctionReturn(0);
}

PetscErrorCode SceneValidateSprings(MPI_Comm comm, Scene scene)
{
  PetscFunctionBegin;
  for (PetscInt s = 0; s < scene->nsprings; ++s) {
    const SceneSpring *spring = &scene->springs[s];

    PetscCall(SceneValidateFace(comm, scene, "spring", spring, spring->face));
    if (!spring->to) continue;
    PetscCall(SceneValidateFace(comm, scene, "spring", spring, spring->to));
    SceneRequire(strcmp(spring->face, spring->to), spring, "spring \"%s\" has the same face \"%s\" at both ends",
      spring->name, spring->face);
  }
  PetscFunctionReturn(0);
}
