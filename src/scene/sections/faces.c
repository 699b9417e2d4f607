/* The faces that bodies have, and faces: a list of named ones that are cut out of them */
#include "sectionsimpl.h"
#include <mesh.h>
#include <petscviewer.h>
#include <string.h>

/* The body of a name <body>.<face>, PETSC_DECIDE if there is none; face: what follows the dot */
PetscInt SceneFindBody(Scene scene, const char name[], const char **face)
{
  const char *dot = strchr(name, '.');

  if (!dot) return PETSC_DECIDE;
  *face = dot + 1;
  for (PetscInt b = 0; b < scene->nbodies; ++b) {
    const size_t length = strlen(scene->bodies[b].name);

    if (length == (size_t)(dot - name) && !strncmp(scene->bodies[b].name, name, length)) return b;
  }
  return PETSC_DECIDE;
}

/*@C
   SceneFaceMaterial - The material of the body that a face belongs to

   Not Collective

   Input Parameters:
+  scene - the scene
-  face  - "<body>.<face>" of a body of the scene

   Level: developer

.seealso: `SceneLoad()`
@*/
const Material *SceneFaceMaterial(Scene scene, const char face[])
{
  const char *name;

  return &scene->bodies[SceneFindBody(scene, face, &name)].material;
}

/* A bound, a number or infinite as people or YAML write it */
static PetscErrorCode SceneReadBound(SceneKeys keys, const char key[], const char word[], PetscReal *bound)
{
  static const char *const names[] = {"inf", ".inf", "-inf", "-.inf"};

  PetscFunctionBegin;
  for (size_t i = 0; i < PETSC_STATIC_ARRAY_LENGTH(names); ++i) {
    PetscBool same;

    PetscCall(PetscStrcasecmp(word, names[i], &same));
    if (same) {
      *bound = i < 2 ? PETSC_INFINITY : PETSC_NINFINITY;
      PetscFunctionReturn(0);
    }
  }
  PetscCall(SceneParseReal(keys, key, word, bound));
  PetscFunctionReturn(0);
}

/* Three bounds */
static PetscErrorCode SceneReadBounds(SceneKeys keys, const char name[], const char which[], PetscReal infinite,
  PetscReal bounds[3])
{
  char        key[SCENE_KEY_LENGTH];
  const char *text;
  char      **words;
  PetscInt    n = 3;

  PetscFunctionBegin;
  for (PetscInt d = 0; d < 3; ++d) bounds[d] = infinite;
  PetscCall(PetscSNPrintf(key, sizeof(key), "faces_%s_%s", name, which));
  PetscCall(SceneKeysGet(keys, PETSC_FALSE, &text, "%s", key));
  if (!text) PetscFunctionReturn(0);
  PetscCall(SceneParseList(keys, key, text, &n, &words));
  for (PetscInt d = 0; d < n; ++d) PetscCall(SceneReadBound(keys, key, words[d], &bounds[d]));
  if (words) PetscCall(PetscStrToArrayDestroy((int)n, words));
  PetscFunctionReturn(0);
}

static PetscErrorCode SceneAddSubface(SceneBody *body, SceneSubface *subface)
{
  PetscFunctionBegin;
  PetscCall(PetscRealloc((body->nsubfaces + 1) * sizeof(*subface), &body->subfaces));
  body->subfaces[body->nsubfaces++] = *subface;
  PetscFunctionReturn(0);
}

PetscErrorCode SceneReadFaces(SceneKeys keys, Scene scene)
{
  PetscInt n;
  char   **names;

  PetscFunctionBegin;
  PetscCall(SceneGetNames(keys, "faces", PETSC_FALSE, &n, &names));
  for (PetscInt f = 0; f < n; ++f) {
    const char  *text, *face = "";
    PetscInt     body;
    SceneSubface subface = {NULL, NULL, {0, 0, 0}, {0, 0, 0}};

    PetscCall(SceneKeysGet(keys, PETSC_TRUE, &text, "faces_%s_of", names[f]));
    PetscCall(SceneReadBounds(keys, names[f], "lower", PETSC_NINFINITY, subface.lower));
    PetscCall(SceneReadBounds(keys, names[f], "upper", PETSC_INFINITY, subface.upper));
    body = text ? SceneFindBody(scene, text, &face) : PETSC_DECIDE;
    if (body < 0) {
      if (text)
        PetscCall(SceneKeysComplain(keys,
          "faces_%s_of is \"%s\", a face of an unknown body; faces are written <body>.<face>", names[f], text));
    } else {
      PetscCall(PetscStrallocpy(names[f], &subface.name));
      PetscCall(PetscStrallocpy(face, &subface.of));
      PetscCall(SceneAddSubface(&scene->bodies[body], &subface));
    }
    PetscCall(PetscFree(names[f]));
  }
  PetscCall(PetscFree(names));
  PetscFunctionReturn(0);
}

/* As SceneReadBounds() sets it: PETSC_INFINITY is a finite number in some releases */
static PetscBool SceneBoundIsInfinite(PetscReal bound)
{
  return PetscAbsReal(bound) >= PETSC_INFINITY ? PETSC_TRUE : PETSC_FALSE;
}

/* A bound that is infinite all over is not shown */
static PetscErrorCode SceneViewBounds(PetscViewer viewer, const char which[], const PetscReal bounds[3])
{
  PetscFunctionBegin;
  if (SceneBoundIsInfinite(bounds[0]) && SceneBoundIsInfinite(bounds[1]) && SceneBoundIsInfinite(bounds[2]))
    PetscFunctionReturn(0);
  PetscCall(PetscViewerASCIIPrintf(viewer, ", %s: [", which));
  for (PetscInt d = 0; d < 3; ++d) {
    if (d) PetscCall(PetscViewerASCIIPrintf(viewer, ", "));
    if (SceneBoundIsInfinite(bounds[d])) PetscCall(PetscViewerASCIIPrintf(viewer, bounds[d] < 0 ? "-inf" : "inf"));
    else PetscCall(SceneViewReal(viewer, bounds[d]));
  }
  PetscCall(PetscViewerASCIIPrintf(viewer, "]"));
  PetscFunctionReturn(0);
}

PetscErrorCode SceneViewFaces(Scene scene, PetscViewer viewer)
{
  PetscInt n = 0;

  PetscFunctionBegin;
  for (PetscInt b = 0; b < scene->nbodies; ++b) n += scene->bodies[b].nsubfaces;
  if (!n) PetscFunctionReturn(0);
  PetscCall(PetscViewerASCIIPrintf(viewer, "faces:\n"));
  PetscCall(PetscViewerASCIIPushTab(viewer));
  for (PetscInt b = 0; b < scene->nbodies; ++b) {
    for (PetscInt s = 0; s < scene->bodies[b].nsubfaces; ++s) {
      const SceneSubface *subface = &scene->bodies[b].subfaces[s];

      PetscCall(PetscViewerASCIIPrintf(viewer, "- %s: {of: %s.%s", subface->name, scene->bodies[b].name, subface->of));
      PetscCall(PetscViewerASCIIUseTabs(viewer, PETSC_FALSE));
      PetscCall(SceneViewBounds(viewer, "lower", subface->lower));
      PetscCall(SceneViewBounds(viewer, "upper", subface->upper));
      PetscCall(PetscViewerASCIIPrintf(viewer, "}\n"));
      PetscCall(PetscViewerASCIIUseTabs(viewer, PETSC_TRUE));
    }
  }
  PetscCall(PetscViewerASCIIPopTab(viewer));
  PetscFunctionReturn(0);
}

/* what and owner name the thing that refers to the face, as in: displacement "bottom" */
PetscErrorCode SceneValidateFace(MPI_Comm comm, const char file[], Scene scene, const char what[], const char owner[],
  const char name[])
{
  const char    *face;
  const PetscInt b = SceneFindBody(scene, name, &face);
  PetscBool      same, found = PETSC_FALSE;
  char           choices[512] = "", **names;
  PetscInt       n;
  size_t         used;

  PetscFunctionBegin;
  PetscCheck(b >= 0, comm, PETSC_ERR_USER_INPUT,
    "%s: %s \"%s\" names the face \"%s\" of an unknown body; faces are written <body>.<face>", file, what, owner, name);
  PetscCall(MeshGetFaceNames(comm, &scene->bodies[b], &n, &names));
  for (PetscInt f = 0; f < n; ++f) {
    PetscCall(PetscStrcmp(names[f], face, &same));
    if (same) found = PETSC_TRUE;
    used = strlen(choices);
    PetscCall(PetscSNPrintf(choices + used, sizeof(choices) - used, "%s%s",
      !f          ? ""
      : f + 1 < n ? ", "
                  : " and ",
      names[f]));
  }
  PetscCall(MeshRestoreFaceNames(&n, &names));
  PetscCheck(found, comm, PETSC_ERR_USER_INPUT, "%s: %s \"%s\" names the face \"%s\", which does not exist; %s has %s",
    file, what, owner, name, scene->bodies[b].name, choices[0] ? choices : "no named faces");
  PetscFunctionReturn(0);
}
