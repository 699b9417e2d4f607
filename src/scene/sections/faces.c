/* faces: names of the faces of bodies, and the list `faces` of parts that are cut out of faces. */
#include "sectionsimpl.h"
#include <mesh.h>
#include <petscviewer.h>
#include <string.h>

/*
   Finds the body in a name <body>.<face>. Returns the number of the body; PETSC_DECIDE if there is no such body. *face:
   the part of the name after the dot.
*/
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

/* Returns the body to which a face belongs. face: "<body>.<face>" with a body of the scene. */
const SceneBody *SceneFaceBody(Scene scene, const char face[])
{
  const char *name;

  return &scene->bodies[SceneFindBody(scene, face, &name)];
}

/* Reads the list and adds each entry to its body. */
PetscErrorCode SceneReadFaces(SceneKeys keys, Scene scene, const SceneList *list)
{
  PetscInt      n     = 0;
  SceneSubface *faces = NULL;

  PetscFunctionBegin;
  PetscCall(SceneReadList(keys, scene, list, &n, &faces));
  for (PetscInt f = 0; f < n; ++f) {
    const char    *face;
    const PetscInt b = SceneFindBody(scene, faces[f].of, &face);

    if (b < 0) {
      if (faces[f].of[0])
        PetscCall(SceneKeysError(keys, "faces", faces[f].name,
          "is of \"%s\", a face of an unknown body; faces are written <body>.<face>", faces[f].of));
      PetscCall(PetscFree(faces[f].name));
    } else {
      SceneBody    *body = &scene->bodies[b];
      SceneSubface *own;

      PetscCall(PetscRealloc((body->nsubfaces + 1) * sizeof(*own), &body->subfaces));
      own  = &body->subfaces[body->nsubfaces++];
      *own = faces[f];
      PetscCall(PetscStrallocpy(face, &own->of));
    }
    PetscCall(PetscFree(faces[f].of));
  }
  PetscCall(PetscFree(faces));
  PetscFunctionReturn(0);
}

/* Prints the list with the names of the bodies. */
PetscErrorCode SceneViewFaces(Scene scene, PetscViewer viewer, const SceneList *list)
{
  SceneSubface *faces;
  PetscInt      n = 0, k = 0;

  PetscFunctionBegin;
  for (PetscInt b = 0; b < scene->nbodies; ++b) n += scene->bodies[b].nsubfaces;
  PetscCall(PetscMalloc1(n, &faces));
  for (PetscInt b = 0; b < scene->nbodies; ++b) {
    for (PetscInt s = 0; s < scene->bodies[b].nsubfaces; ++s, ++k) {
      char of[SCENE_KEY_LENGTH];

      faces[k] = scene->bodies[b].subfaces[s];
      PetscCall(PetscSNPrintf(of, sizeof(of), "%s.%s", scene->bodies[b].name, faces[k].of));
      PetscCall(PetscStrallocpy(of, &faces[k].of));
    }
  }
  PetscCall(SceneViewEntries(scene, viewer, list, n, faces));
  for (k = 0; k < n; ++k) PetscCall(PetscFree(faces[k].of));
  PetscCall(PetscFree(faces));
  PetscFunctionReturn(0);
}

/* Describes the names of a body's faces as a text for messages. *found: true if `face` is one of these names. */
static PetscErrorCode FacesDescribe(MPI_Comm comm, SceneBody *body, const char face[], size_t length, char text[],
  PetscBool *found)
{
  char   **names;
  PetscInt n;

  PetscFunctionBegin;
  text[0] = 0;
  *found  = PETSC_FALSE;
  PetscCall(MeshGetFaceNames(comm, body, &n, &names));
  for (PetscInt f = 0; f < n; ++f) {
    const size_t used = strlen(text);
    PetscBool    same;

    PetscCall(PetscStrcmp(names[f], face, &same));
    *found = (PetscBool)(*found || same);
    PetscCall(PetscSNPrintf(text + used, length - used, "%s%s", !f ? "" : f + 1 < n ? ", " : " and ", names[f]));
  }
  PetscCall(MeshRestoreFaceNames(&n, &names));
  if (!text[0]) PetscCall(PetscStrncpy(text, "no named faces", length));
  PetscFunctionReturn(0);
}

/*
   Collective. Checks that a face exists. what, owner: describe the entry that refers to the face, as in displacement
   "bottom".
*/
PetscErrorCode SceneValidateFace(MPI_Comm comm, Scene scene, const char what[], const void *owner, const char name[])
{
  const SceneEntry *entry = owner;
  const char       *face;
  const PetscInt    b = SceneFindBody(scene, name, &face);
  PetscBool         found;
  char              choices[512];

  PetscFunctionBegin;
  for (PetscInt i = 0; i < scene->nbodies; ++i) {
    if (strcmp(name, scene->bodies[i].name)) continue;
    PetscCall(FacesDescribe(comm, &scene->bodies[i], "", sizeof(choices), choices, &found));
    SceneRequire(PETSC_FALSE, entry, "%s \"%s\" names the body \"%s\" where it needs a face; %s has %s", what,
      entry->name, name, name, choices);
  }
  SceneRequire(b >= 0, entry, "%s \"%s\" names the face \"%s\" of an unknown body; faces are written <body>.<face>",
    what, entry->name, name);
  PetscCall(FacesDescribe(comm, &scene->bodies[b], face, sizeof(choices), choices, &found));
  SceneRequire(found, entry, "%s \"%s\" names the face \"%s\", which does not exist; %s has %s", what, entry->name,
    name, scene->bodies[b].name, choices);
  PetscFunctionReturn(0);
}
