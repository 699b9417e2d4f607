/* refinements: zones near faces or in a box, in which cells are refined further. */
#include "sectionsimpl.h"
#include <petscviewer.h>
#include <string.h>

#define REFINEMENT_MAX_LEVELS 20

/* Reads the name of a face, or of a contact pair, which denotes both of its faces. */
static PetscErrorCode NearRead(SceneKeys keys, Scene scene, const char key[], const char text[], void *entry)
{
  SceneRefinement *refinement = entry;
  const char      *face;

  PetscFunctionBegin;
  for (PetscInt p = 0; p < scene->npairs; ++p) {
    if (strcmp(scene->pairs[p].name, text)) continue;
    if (scene->pairs[p].self && !strchr(scene->pairs[p].self, '.'))
      PetscCall(SceneKeysError(keys, key, NULL,
        "is %s, the contact of the whole surface of %s with itself: name a face, or a box", text,
        scene->pairs[p].self));
    PetscCall(PetscStrallocpy(scene->pairs[p].mortar, &refinement->face[0]));
    PetscCall(PetscStrallocpy(scene->pairs[p].nonmortar, &refinement->face[1]));
    PetscFunctionReturn(0);
  }
  PetscCall(PetscStrallocpy(text, &refinement->face[0]));
  if (SceneFindBody(scene, text, &face) < 0)
    PetscCall(
      SceneKeysError(keys, key, NULL, "is %s, which is neither a contact pair nor a face, <body>.<face>", text));
  PetscFunctionReturn(0);
}

static PetscBool NearIsShown(const void *entry)
{
  return (PetscBool)(((const SceneRefinement *)entry)->face[0] != NULL);
}

/* Prints the name of a face, or of the contact pair to which both faces belong. */
static PetscErrorCode NearView(Scene scene, PetscViewer viewer, const void *entry)
{
  char *const *face = ((const SceneRefinement *)entry)->face;
  const char  *near = face[0];

  PetscFunctionBegin;
  for (PetscInt p = 0; face[1] && p < scene->npairs; ++p) {
    if (!strcmp(scene->pairs[p].mortar, face[0]) && !strcmp(scene->pairs[p].nonmortar, face[1]))
      near = scene->pairs[p].name;
  }
  PetscCall(PetscViewerASCIIPrintf(viewer, "%s", near));
  PetscFunctionReturn(0);
}

const SceneOwn SceneOwnNear = {NearRead, NearIsShown, NearView, 2};

/* Returns whether a key is not printed: the keys of a box are not printed for a zone near a face. */
PetscBool SceneRefinementHides(const void *entry, const char key[])
{
  return (PetscBool)(NearIsShown(entry) && (!strcmp(key, "lower") || !strcmp(key, "upper") || !strcmp(key, "body")));
}

PetscErrorCode SceneFinishRefinement(SceneKeys keys, Scene scene, const char owner[], void *entry)
{
  SceneRefinement *r = entry;
  PetscBool        lower, upper;
  const char      *face;

  PetscFunctionBegin;
  PetscCall(SceneHasKey(keys, owner, "lower", &lower));
  PetscCall(SceneHasKey(keys, owner, "upper", &upper));
  if (!r->face[0] && !(lower && upper))
    PetscCall(SceneKeysError(keys, owner, NULL,
      "has neither near: <contact pair or face> nor both corners of a box, lower: [x, y, z] and upper: [x, y, z]"));
  for (PetscInt d = 0; d < 3 && !r->face[0]; ++d) {
    if (!(r->lower[d] <= r->upper[d]))
      PetscCall(SceneKeysError(keys, owner, NULL, "has lower above upper along %c: %g and %g", "xyz"[d],
        (double)r -> lower[d], (double)r -> upper[d]));
  }
  if (r->face[0] && !r->face[1]) r->body = SceneFindBody(scene, r->face[0], &face);
  if (r->levels < 1 || r->levels > REFINEMENT_MAX_LEVELS)
    PetscCall(SceneKeysError(keys, owner, "levels", "is %" PetscInt_FMT "; it is a number from 1 to %d", r->levels,
      REFINEMENT_MAX_LEVELS));
  PetscFunctionReturn(0);
}

PetscErrorCode SceneValidateRefinements(MPI_Comm comm, Scene scene)
{
  PetscFunctionBegin;
  for (PetscInt r = 0; r < scene->nrefinements; ++r) {
    const SceneRefinement *refinement = &scene->refinements[r];

    for (PetscInt k = 0; k < 2 && refinement->face[k]; ++k)
      PetscCall(SceneValidateFace(comm, scene, "refinement", refinement, refinement->face[k]));
    SceneRequire(refinement->body < 0 || scene->bodies[refinement->body].order < 2, refinement,
      "refinement \"%s\" is of body \"%s\", which has order %" PetscInt_FMT
      ": only hexahedra of order 1 are refined locally",
      refinement->name, scene->bodies[refinement->body].name, scene->bodies[refinement->body].order);
  }
  PetscFunctionReturn(0);
}
