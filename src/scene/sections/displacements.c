/*
   displacements: prescribed displacements of faces, of vertices at points and along edges, and of rigid bodies, whose
   rotation can also be free.
*/
#include "sectionsimpl.h"
#include <petscviewer.h>
#include <string.h>

/* Reads three values, each of which is a number or the word `free`. */
static PetscErrorCode ReadThree(SceneKeys keys, const char key[], const char text[], PetscReal value[3],
  PetscBool free[3])
{
  char   **words;
  PetscInt n = 3;

  PetscFunctionBegin;
  PetscCall(SceneParseList(keys, key, text, &n, &words));
  for (PetscInt i = 0; i < n; ++i) {
    PetscCall(PetscStrcasecmp(words[i], "free", &free[i]));
    if (!free[i]) PetscCall(SceneParseReal(keys, key, words[i], &value[i]));
  }
  if (words) PetscCall(PetscStrToArrayDestroy((int)n, words));
  PetscFunctionReturn(0);
}

static PetscErrorCode ViewThree(PetscViewer viewer, const PetscReal value[3], const PetscBool free[3])
{
  PetscFunctionBegin;
  for (PetscInt i = 0; i < 3; ++i) {
    PetscCall(PetscViewerASCIIPrintf(viewer, i ? ", " : "["));
    if (free[i]) PetscCall(PetscViewerASCIIPrintf(viewer, "free"));
    else PetscCall(SceneViewReal(viewer, value[i]));
  }
  PetscCall(PetscViewerASCIIPrintf(viewer, "]"));
  PetscFunctionReturn(0);
}

static PetscErrorCode ComponentsRead(SceneKeys keys, Scene scene, const char key[], const char text[], void *entry)
{
  SceneDisplacement *d       = entry;
  PetscBool          free[3] = {PETSC_TRUE, PETSC_TRUE, PETSC_TRUE};

  PetscFunctionBegin;
  (void)scene;
  PetscCall(ReadThree(keys, key, text, d->value, free));
  for (PetscInt i = 0; i < 3; ++i) d->fixed[i] = (PetscBool)!free[i];
  PetscFunctionReturn(0);
}

static PetscBool ComponentsAreShown(const void *entry)
{
  return (PetscBool)(entry != NULL);
}

static PetscErrorCode ComponentsView(Scene scene, PetscViewer viewer, const void *entry)
{
  const SceneDisplacement *d = entry;
  PetscBool                free[3];

  PetscFunctionBegin;
  (void)scene;
  for (PetscInt i = 0; i < 3; ++i) free[i] = SceneIsWholeBody(d->face) ? d->released[i] : (PetscBool)!d->fixed[i];
  PetscCall(ViewThree(viewer, d->value, free));
  PetscFunctionReturn(0);
}

const SceneOwn SceneOwnComponents = {ComponentsRead, ComponentsAreShown, ComponentsView, 0};

static PetscErrorCode RotationRead(SceneKeys keys, Scene scene, const char key[], const char text[], void *entry)
{
  SceneDisplacement *d = entry;

  PetscFunctionBegin;
  (void)scene;
  PetscCall(ReadThree(keys, key, text, d->rotation, d->released + 3));
  PetscFunctionReturn(0);
}

PetscBool SceneRotates(const SceneDisplacement *d)
{
  return (PetscBool)(d->rotation[0] != 0 || d->rotation[1] != 0 || d->rotation[2] != 0);
}

/* Returns whether any rotation of a rigid body is free. */
PetscBool SceneTurnsFreely(const SceneDisplacement *d)
{
  return (PetscBool)(d->released[3] || d->released[4] || d->released[5]);
}

static PetscBool RotationIsShown(const void *entry)
{
  return (PetscBool)(SceneRotates(entry) || SceneTurnsFreely(entry));
}

static PetscErrorCode RotationView(Scene scene, PetscViewer viewer, const void *entry)
{
  const SceneDisplacement *d = entry;

  PetscFunctionBegin;
  (void)scene;
  PetscCall(ViewThree(viewer, d->rotation, d->released + 3));
  PetscFunctionReturn(0);
}

const SceneOwn SceneOwnRotation = {RotationRead, RotationIsShown, RotationView, 0};

PetscBool SceneDisplacementIsPlane(const void *entry)
{
  return ((const SceneDisplacement *)entry)->inclined;
}

PetscBool SceneDisplacementIsListed(const void *entry)
{
  return (PetscBool)!SceneDisplacementIsPlane(entry);
}

PetscBool SceneDisplacementHides(const void *entry, const char key[])
{
  const SceneDisplacement *d = entry;

  if (!strcmp(key, "face")) return (PetscBool)(d->at != DISPLACEMENT_FACE || SceneIsWholeBody(d->face));
  if (!strcmp(key, "point")) return (PetscBool)(d->at != DISPLACEMENT_POINT);
  if (!strcmp(key, "from") || !strcmp(key, "to")) return (PetscBool)(d->at != DISPLACEMENT_EDGE);
  return (PetscBool)(!strcmp(key, "center") && !RotationIsShown(d));
}

PetscBool SceneIsWholeBody(const char face[])
{
  const size_t length = strlen(face), end = strlen(SCENE_WHOLE_BODY);

  return (PetscBool)(length > end && !strcmp(face + length - end, SCENE_WHOLE_BODY));
}

/*
   Sets *face to the name of the whole body if a rigid body is given. body: number of the body; negative: not given.
   why: reason for the error message if the body is elastic.
*/
PetscErrorCode SceneSetWholeBody(SceneKeys keys, Scene scene, const char owner[], const char why[], PetscInt body,
  char **face)
{
  char whole[SCENE_KEY_LENGTH];

  PetscFunctionBegin;
  if (body < 0) {
    if (!*face) PetscCall(PetscStrallocpy("", face));
    PetscFunctionReturn(0);
  }
  if (scene->bodies[body].material.type != MATERIAL_RIGID)
    PetscCall(SceneKeysError(keys, owner, "body", "is \"%s\", which is not rigid: %s", scene->bodies[body].name, why));
  PetscCall(PetscFree(*face));
  PetscCall(PetscSNPrintf(whole, sizeof(whole), "%s" SCENE_WHOLE_BODY, scene->bodies[body].name));
  PetscCall(PetscStrallocpy(whole, face));
  PetscFunctionReturn(0);
}

/*
   Sets a displacement at a point or along an edge of an elastic body, from the key `point` or the keys `from` and `to`.
   The name of the face is generated. point: true for a point.
*/
static PetscErrorCode DisplacementSetPlace(SceneKeys keys, Scene scene, const char owner[], PetscBool point,
  SceneDisplacement *d)
{
  PetscBool from, to, face;
  char      name[SCENE_KEY_LENGTH];

  PetscFunctionBegin;
  PetscCall(SceneHasKey(keys, owner, "from", &from));
  PetscCall(SceneHasKey(keys, owner, "to", &to));
  PetscCall(SceneHasKey(keys, owner, "face", &face));
  if (point ? from || to : !from || !to)
    PetscCall(SceneKeysError(keys, owner, NULL,
      "is either at a point, {body, point: [x, y, z]}, or along an edge, {body, from: [x, y, z], "
      "to: [x, y, z]}"));
  if (d->body < 0)
    PetscCall(SceneKeysError(keys, owner, NULL, "is at a point or along an edge, but the key body is missing"));
  else if (scene->bodies[d->body].material.type == MATERIAL_RIGID)
    PetscCall(SceneKeysError(keys, owner, NULL,
      "is at a point or an edge of the rigid body \"%s\", which moves as a whole: use the key body "
      "alone",
      scene->bodies[d->body].name));
  if (face) PetscCall(SceneKeysError(keys, owner, NULL, "has a face, and a point or an edge; give only one of them"));
  d->at = point ? DISPLACEMENT_POINT : DISPLACEMENT_EDGE;
  if (point) PetscCall(PetscArraycpy(d->to, d->from, 3));
  PetscCall(PetscFree(d->face));
  PetscCall(PetscSNPrintf(name, sizeof(name), "%s.@%s", d->body < 0 ? "" : scene->bodies[d->body].name, d->name));
  PetscCall(PetscStrallocpy(name, &d->face));
  PetscFunctionReturn(0);
}

/*
   Finds which motions of a rigid body are free. A component is prescribed at all nodes only if neither this component
   nor a rotation that changes it is free.
*/
static PetscErrorCode DisplacementRelease(SceneKeys keys, const char owner[], SceneDisplacement *d)
{
  PetscFunctionBegin;
  if (SceneTurnsFreely(d) && SceneRotates(d))
    PetscCall(SceneKeysError(keys, owner, NULL,
      "prescribes one rotation of a rigid body while another one is free; if one rotation is free, "
      "the others must be 0 or free"));
  for (PetscInt i = 0; i < 3; ++i) d->released[i] = (PetscBool)!d->fixed[i];
  for (PetscInt i = 0; i < 3; ++i)
    d->fixed[i] = (PetscBool) !(d->released[i] || d->released[3 + (i + 1) % 3] || d->released[3 + (i + 2) % 3]);
  PetscFunctionReturn(0);
}

/* rotation: whether the entry has this key, whose value may be 0 */
static PetscErrorCode DisplacementSetMotion(SceneKeys keys, const char owner[], PetscBool center, PetscBool rotation,
  SceneDisplacement *d)
{
  const PetscBool whole = SceneIsWholeBody(d->face), turns = RotationIsShown(d);

  PetscFunctionBegin;
  d->moves = (PetscBool)(whole || turns);
  if (turns && !center) PetscCall(SceneKeysError(keys, owner, NULL, "has a rotation, but no center"));
  if (center && !rotation) PetscCall(SceneKeysError(keys, owner, NULL, "has a center, but no rotation"));
  if (!whole && SceneTurnsFreely(d))
    PetscCall(SceneKeysError(keys, owner, NULL,
      "has a free rotation, which only a rigid body can have, as {body: <body>, ...}"));
  else if (d->moves && !whole && !(d->fixed[0] && d->fixed[1] && d->fixed[2]))
    PetscCall(SceneKeysError(keys, owner, NULL, "has a rotation, so that no component of its value may be free"));
  if (whole) PetscCall(DisplacementRelease(keys, owner, d));
  PetscFunctionReturn(0);
}

PetscErrorCode SceneFinishDisplacement(SceneKeys keys, Scene scene, const char owner[], void *entry)
{
  SceneDisplacement *d = entry;
  PetscBool          point, from, to, body, center, rotation;
  const char        *face;

  PetscFunctionBegin;
  PetscCall(SceneHasKey(keys, owner, "point", &point));
  PetscCall(SceneHasKey(keys, owner, "from", &from));
  PetscCall(SceneHasKey(keys, owner, "to", &to));
  PetscCall(SceneHasKey(keys, owner, "body", &body));
  PetscCall(SceneHasKey(keys, owner, "center", &center));
  PetscCall(SceneHasKey(keys, owner, "rotation", &rotation));
  if (point || from || to) PetscCall(DisplacementSetPlace(keys, scene, owner, point, d));
  else {
    PetscCall(SceneKeysGet(keys, (PetscBool)!body, &face, "%s_face", owner));
    if (body && face) PetscCall(SceneKeysError(keys, owner, NULL, "names a face and a body; give only one of the two"));
    PetscCall(SceneSetWholeBody(keys, scene, owner,
      "displacements of an elastic body are prescribed at a face, a point or an edge", d->body, &d->face));
  }
  PetscCall(DisplacementSetMotion(keys, owner, center, rotation, d));
  PetscFunctionReturn(0);
}
