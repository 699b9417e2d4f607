/* ties: a list of pairs of faces that are joined */
#include "sectionsimpl.h"
#include <petscviewer.h>
#include <string.h>

PetscErrorCode SceneReadTies(SceneKeys keys, Scene scene)
{
  char        key[SCENE_KEY_LENGTH];
  char      **names;
  const char *text;

  PetscFunctionBegin;
  PetscCall(SceneGetNames(keys, "ties", PETSC_FALSE, &scene->nties, &names));
  PetscCall(PetscCalloc1(scene->nties, &scene->ties));
  for (PetscInt t = 0; t < scene->nties; ++t) {
    SceneTie *tie = &scene->ties[t];

    tie->name = names[t];
    PetscCall(SceneKeysGet(keys, PETSC_TRUE, &text, "ties_%s_mortar", tie->name));
    PetscCall(PetscStrallocpy(text ? text : "", &tie->mortar));
    PetscCall(SceneKeysGet(keys, PETSC_TRUE, &text, "ties_%s_nonmortar", tie->name));
    PetscCall(PetscStrallocpy(text ? text : "", &tie->nonmortar));
    PetscCall(PetscSNPrintf(key, sizeof(key), "ties_%s_distance", tie->name));
    PetscCall(SceneKeysGet(keys, PETSC_FALSE, &text, "%s", key));
    if (text) {
      PetscCall(SceneParseReal(keys, key, text, &tie->distance));
      if (!(tie->distance > 0)) PetscCall(SceneKeysComplain(keys, "%s is %s, which must be above 0", key, text));
    }
  }
  PetscCall(PetscFree(names));
  PetscFunctionReturn(0);
}

PetscErrorCode SceneViewTie(Scene scene, PetscViewer viewer, PetscInt t)
{
  const SceneTie *tie = &scene->ties[t];

  PetscFunctionBegin;
  PetscCall(PetscViewerASCIIPrintf(viewer, "- %s: {mortar: %s, nonmortar: %s", tie->name, tie->mortar, tie->nonmortar));
  PetscCall(PetscViewerASCIIUseTabs(viewer, PETSC_FALSE));
  if (tie->distance > 0) {
    PetscCall(PetscViewerASCIIPrintf(viewer, ", distance: "));
    PetscCall(SceneViewReal(viewer, tie->distance));
  }
  PetscCall(PetscViewerASCIIPrintf(viewer, "}\n"));
  PetscCall(PetscViewerASCIIUseTabs(viewer, PETSC_TRUE));
  PetscFunctionReturn(0);
}

PetscErrorCode SceneValidateTies(MPI_Comm comm, const char file[], Scene scene)
{
  PetscFunctionBegin;
  for (PetscInt t = 0; t < scene->nties; ++t) {
    const SceneTie *tie  = &scene->ties[t];
    const char     *face = NULL;
    PetscInt        nonmortar;

    PetscCall(SceneValidateFace(comm, file, scene, "tie", tie->name, tie->mortar));
    PetscCall(SceneValidateFace(comm, file, scene, "tie", tie->name, tie->nonmortar));
    nonmortar = SceneFindBody(scene, tie->nonmortar, &face);
    PetscCheck(strcmp(tie->mortar, tie->nonmortar), comm, PETSC_ERR_USER_INPUT,
      "%s: tie \"%s\" has the same face \"%s\" on both sides", file, tie->name, tie->mortar);
    PetscCheck(scene->bodies[nonmortar].material.type != MATERIAL_RIGID, comm, PETSC_ERR_USER_INPUT,
      "%s: tie \"%s\" has a face of the rigid body \"%s\" as its nonmortar face; swap the two", file, tie->name,
      scene->bodies[nonmortar].name);
  }
  PetscFunctionReturn(0);
}

PetscErrorCode SceneDestroyTies(Scene scene)
{
  PetscFunctionBegin;
  for (PetscInt t = 0; t < scene->nties; ++t) {
    PetscCall(PetscFree(scene->ties[t].name));
    PetscCall(PetscFree(scene->ties[t].mortar));
    PetscCall(PetscFree(scene->ties[t].nonmortar));
  }
  PetscCall(PetscFree(scene->ties));
  PetscFunctionReturn(0);
}
