/* displacements: a list of named prescribed displacements; faces of boxes */
#include "sceneimpl.h"
#include <string.h>

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
  char      **names;
  const char *text;

  PetscFunctionBegin;
  PetscCall(SceneGetNames(keys, "displacements", PETSC_FALSE, &scene->ndisplacements, &names));
  PetscCall(PetscCalloc1(scene->ndisplacements, &scene->displacements));
  for (PetscInt d = 0; d < scene->ndisplacements; ++d) {
    SceneDisplacement *displacement = &scene->displacements[d];

    displacement->name = names[d];
    PetscCall(SceneKeysGet(keys, PETSC_TRUE, &text, "displacements_%s_face", displacement->name));
    PetscCall(PetscStrallocpy(text ? text : "", &displacement->face));
    PetscCall(SceneReadComponents(keys, displacement));
  }
  PetscCall(PetscFree(names));
  PetscFunctionReturn(0);
}

PetscErrorCode SceneFindFace(Scene scene, const char name[], SceneFace *face, PetscBool *found)
{
  static const char *const sides[] = {"xmin", "xmax", "ymin", "ymax", "zmin", "zmax"};
  const char              *dot     = strchr(name, '.');

  PetscFunctionBegin;
  *found     = PETSC_FALSE;
  face->body = PETSC_DECIDE;
  if (!dot) PetscFunctionReturn(0);
  for (PetscInt b = 0; b < scene->nbodies; ++b) {
    const size_t length = strlen(scene->bodies[b].name);

    if (length == (size_t)(dot - name) && !strncmp(scene->bodies[b].name, name, length)) face->body = b;
  }
  for (PetscInt s = 0; s < 6; ++s) {
    if (strcmp(dot + 1, sides[s])) continue;
    face->axis  = s / 2;
    face->upper = s % 2;
    *found      = face->body >= 0 ? PETSC_TRUE : PETSC_FALSE;
  }
  PetscFunctionReturn(0);
}

PetscErrorCode SceneFaceCorners(Scene scene, SceneFace face, PetscReal corners[4][3])
{
  const SceneBody *body = &scene->bodies[face.body];
  const PetscInt   s = (face.axis + 1) % 3, t = (face.axis + 2) % 3;

  PetscFunctionBegin;
  for (PetscInt c = 0; c < 4; ++c) {
    corners[c][face.axis] = face.upper ? body->upper[face.axis] : body->lower[face.axis];
    corners[c][s]         = c % 2 ? body->upper[s] : body->lower[s];
    corners[c][t]         = c / 2 ? body->upper[t] : body->lower[t];
  }
  PetscFunctionReturn(0);
}
