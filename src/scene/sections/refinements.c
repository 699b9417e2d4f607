/* refinements: a list of places where cells are refined more often than elsewhere */
#include "sectionsimpl.h"
#include <petscviewer.h>
#include <string.h>

#define REFINEMENT_MAX_LEVELS 20

/* A value of an entry that may be missing */
static PetscErrorCode RefinementGet(SceneKeys keys, const SceneRefinement *refinement, const char what[],
  char key[SCENE_KEY_LENGTH], const char **text)
{
  PetscFunctionBegin;
  PetscCall(PetscSNPrintf(key, SCENE_KEY_LENGTH, "refinements_%s_%s", refinement->name, what));
  PetscCall(SceneKeysGet(keys, PETSC_FALSE, text, "%s", key));
  PetscFunctionReturn(0);
}

/* A contact pair, both of whose faces are meant, or a face */
static PetscErrorCode RefinementSetFaces(SceneKeys keys, Scene scene, const char key[], const char near[],
  SceneRefinement *refinement)
{
  const char *face;

  PetscFunctionBegin;
  for (PetscInt p = 0; p < scene->npairs; ++p) {
    if (strcmp(scene->pairs[p].name, near)) continue;
    PetscCall(PetscStrallocpy(scene->pairs[p].mortar, &refinement->face[0]));
    PetscCall(PetscStrallocpy(scene->pairs[p].nonmortar, &refinement->face[1]));
    PetscFunctionReturn(0);
  }
  refinement->body = SceneFindBody(scene, near, &face);
  if (refinement->body < 0)
    PetscCall(
      SceneKeysComplain(keys, "%s is %s, which is neither a contact pair nor a face, <body>.<face>", key, near));
  else PetscCall(PetscStrallocpy(near, &refinement->face[0]));
  PetscFunctionReturn(0);
}

static PetscErrorCode RefinementReadBox(SceneKeys keys, Scene scene, SceneRefinement *refinement)
{
  char        key[SCENE_KEY_LENGTH];
  const char *text;

  PetscFunctionBegin;
  for (PetscInt end = 0; end < 2; ++end) {
    PetscCall(RefinementGet(keys, refinement, end ? "upper" : "lower", key, &text));
    if (text) PetscCall(SceneParseReals(keys, key, text, 3, end ? refinement->upper : refinement->lower));
    else
      PetscCall(SceneKeysComplain(keys,
        "refinements_%s says neither near: <contact pair or face> nor both corners of a box, lower: [x, y, z] and "
        "upper: [x, y, z]",
        refinement->name));
  }
  for (PetscInt d = 0; d < 3; ++d) {
    if (!(refinement->lower[d] <= refinement->upper[d]))
      PetscCall(SceneKeysComplain(keys, "refinements_%s has lower above upper along %c: %g and %g", refinement->name,
        "xyz"[d], (double)refinement -> lower[d], (double)refinement -> upper[d]));
  }
  PetscCall(SceneReadBodyName(keys, scene, "refinements", refinement->name, &refinement->body));
  PetscFunctionReturn(0);
}

static PetscErrorCode RefinementRead(SceneKeys keys, Scene scene, SceneRefinement *refinement)
{
  char        key[SCENE_KEY_LENGTH];
  const char *text;

  PetscFunctionBegin;
  refinement->body   = PETSC_DECIDE;
  refinement->levels = 1;
  PetscCall(RefinementGet(keys, refinement, "near", key, &text));
  if (text) PetscCall(RefinementSetFaces(keys, scene, key, text, refinement));
  else PetscCall(RefinementReadBox(keys, scene, refinement));
  PetscCall(RefinementGet(keys, refinement, "levels", key, &text));
  if (text) PetscCall(SceneParseInt(keys, key, text, &refinement->levels));
  if (refinement->levels < 1 || refinement->levels > REFINEMENT_MAX_LEVELS)
    PetscCall(SceneKeysComplain(keys, "%s is %" PetscInt_FMT "; it is a number from 1 to %d", key, refinement->levels,
      REFINEMENT_MAX_LEVELS));
  PetscCall(RefinementGet(keys, refinement, "distance", key, &text));
  if (text) PetscCall(SceneParseReal(keys, key, text, &refinement->distance));
  if (refinement->distance < 0) PetscCall(SceneKeysComplain(keys, "%s is %s, which must not be negative", key, text));
  PetscFunctionReturn(0);
}

/* After the contact pairs */
PetscErrorCode SceneReadRefinements(SceneKeys keys, Scene scene)
{
  char **names;

  PetscFunctionBegin;
  PetscCall(SceneGetNames(keys, "refinements", PETSC_FALSE, &scene->nrefinements, &names));
  PetscCall(PetscCalloc1(scene->nrefinements, &scene->refinements));
  for (PetscInt r = 0; r < scene->nrefinements; ++r) {
    scene->refinements[r].name = names[r];
    PetscCall(RefinementRead(keys, scene, &scene->refinements[r]));
  }
  PetscCall(PetscFree(names));
  PetscFunctionReturn(0);
}

/* What an entry is near: a face, or the contact pair that has both */
static const char *RefinementNear(Scene scene, const SceneRefinement *refinement)
{
  for (PetscInt p = 0; refinement->face[1] && p < scene->npairs; ++p) {
    if (!strcmp(scene->pairs[p].mortar, refinement->face[0]) && !strcmp(scene->pairs[p].nonmortar, refinement->face[1]))
      return scene->pairs[p].name;
  }
  return refinement->face[0];
}

PetscErrorCode SceneViewRefinement(Scene scene, PetscViewer viewer, PetscInt r)
{
  const SceneRefinement *refinement = &scene->refinements[r];

  PetscFunctionBegin;
  PetscCall(PetscViewerASCIIPrintf(viewer, "- %s: {", refinement->name));
  PetscCall(PetscViewerASCIIUseTabs(viewer, PETSC_FALSE));
  if (refinement->face[0]) PetscCall(PetscViewerASCIIPrintf(viewer, "near: %s", RefinementNear(scene, refinement)));
  else {
    PetscCall(PetscViewerASCIIPrintf(viewer, "lower: "));
    PetscCall(SceneViewList(viewer, 3, refinement->lower));
    PetscCall(PetscViewerASCIIPrintf(viewer, ", upper: "));
    PetscCall(SceneViewList(viewer, 3, refinement->upper));
    if (refinement->body >= 0)
      PetscCall(PetscViewerASCIIPrintf(viewer, ", body: %s", scene->bodies[refinement->body].name));
  }
  PetscCall(PetscViewerASCIIPrintf(viewer, ", levels: %" PetscInt_FMT ", distance: ", refinement->levels));
  PetscCall(SceneViewReal(viewer, refinement->distance));
  PetscCall(PetscViewerASCIIPrintf(viewer, "}\n"));
  PetscCall(PetscViewerASCIIUseTabs(viewer, PETSC_TRUE));
  PetscFunctionReturn(0);
}

PetscErrorCode SceneValidateRefinements(MPI_Comm comm, const char file[], Scene scene)
{
  PetscFunctionBegin;
  for (PetscInt r = 0; r < scene->nrefinements; ++r) {
    const SceneRefinement *refinement = &scene->refinements[r];

    for (PetscInt k = 0; k < 2 && refinement->face[k]; ++k)
      PetscCall(SceneValidateFace(comm, file, scene, "refinement", refinement->name, refinement->face[k]));
    PetscCheck(refinement->body < 0 || scene->bodies[refinement->body].order < 2, comm, PETSC_ERR_USER_INPUT,
      "%s: refinement \"%s\" is of body \"%s\", which has order %" PetscInt_FMT
      ": only hexahedra of order 1 are refined locally",
      file, refinement->name, scene->bodies[refinement->body].name, scene->bodies[refinement->body].order);
  }
  PetscFunctionReturn(0);
}

PetscErrorCode SceneDestroyRefinements(Scene scene)
{
  PetscFunctionBegin;
  for (PetscInt r = 0; r < scene->nrefinements; ++r) {
    PetscCall(PetscFree(scene->refinements[r].name));
    for (PetscInt k = 0; k < 2; ++k) PetscCall(PetscFree(scene->refinements[r].face[k]));
  }
  PetscCall(PetscFree(scene->refinements));
  PetscFunctionReturn(0);
}
