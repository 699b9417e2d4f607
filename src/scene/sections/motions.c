/* Rigid motions: rotations of faces, and displacements of rigid bodies */
#include "sectionsimpl.h"
#include <petscviewer.h>
#include <string.h>

PetscBool SceneRotates(const SceneDisplacement *d)
{
  return (PetscBool)(d->rotation[0] != 0 || d->rotation[1] != 0 || d->rotation[2] != 0);
}

/* Whether any rotation of a rigid body is free */
PetscBool SceneTurnsFreely(const SceneDisplacement *d)
{
  return (PetscBool)(d->released[3] || d->released[4] || d->released[5]);
}

PetscBool SceneIsWholeBody(const char face[])
{
  const size_t length = strlen(face), end = strlen(SCENE_WHOLE_BODY);

  return (PetscBool)(length > end && !strcmp(face + length - end, SCENE_WHOLE_BODY));
}

/* face: a face, or body: a rigid body, all of it */
PetscErrorCode SceneReadTarget(SceneKeys keys, Scene scene, SceneDisplacement *d)
{
  const char *face, *text;
  char        whole[SCENE_KEY_LENGTH];
  PetscInt    body;

  PetscFunctionBegin;
  PetscCall(SceneKeysGet(keys, PETSC_FALSE, &text, "displacements_%s_body", d->name));
  body = PETSC_DECIDE;
  if (text) PetscCall(SceneReadBodyName(keys, scene, "displacements", d->name, &body));
  PetscCall(SceneReadPoint(keys, scene, body, d));
  PetscCall(
    SceneKeysGet(keys, (PetscBool)(!text && d->at == DISPLACEMENT_FACE), &face, "displacements_%s_face", d->name));
  if (d->at != DISPLACEMENT_FACE) {
    if (body >= 0 && scene->bodies[body].material.type == MATERIAL_RIGID)
      PetscCall(SceneKeysComplain(keys,
        "displacement \"%s\" is at a point or an edge of the rigid body \"%s\", which moves as a whole", d->name,
        text));
    if (face)
      PetscCall(SceneKeysComplain(keys, "displacement \"%s\" names a face and a place; it is one of the two", d->name));
    PetscFunctionReturn(0);
  }
  if (text && face)
    PetscCall(SceneKeysComplain(keys, "displacement \"%s\" names a face and a body; it is one of the two", d->name));
  if (text) {
    if (body >= 0 && scene->bodies[body].material.type != MATERIAL_RIGID)
      PetscCall(SceneKeysComplain(keys,
        "displacements_%s_body is \"%s\", which is not rigid: of an elastic body faces, points and edges are displaced",
        d->name, text));
    PetscCall(PetscSNPrintf(whole, sizeof(whole), "%s" SCENE_WHOLE_BODY, text));
    face     = whole;
    d->moves = PETSC_TRUE;
  }
  PetscCall(PetscStrallocpy(face ? face : "", &d->face));
  PetscFunctionReturn(0);
}

/* Three angles, each a number or the word free */
static PetscErrorCode SceneReadAngles(SceneKeys keys, const char key[], const char text[], SceneDisplacement *d)
{
  char   **words;
  PetscInt n = 3;

  PetscFunctionBegin;
  PetscCall(SceneParseList(keys, key, text, &n, &words));
  for (PetscInt i = 0; i < n; ++i) {
    PetscCall(PetscStrcasecmp(words[i], "free", &d->released[3 + i]));
    if (!d->released[3 + i]) PetscCall(SceneParseReal(keys, key, words[i], &d->rotation[i]));
  }
  if (words) PetscCall(PetscStrToArrayDestroy((int)n, words));
  PetscFunctionReturn(0);
}

/* Which motions of a rigid body are free. A component is prescribed of all of its nodes where neither it nor a
   rotation that changes it is free */
static PetscErrorCode SceneRelease(SceneKeys keys, SceneDisplacement *d)
{
  PetscFunctionBegin;
  if (SceneTurnsFreely(d) && SceneRotates(d))
    PetscCall(SceneKeysComplain(keys,
      "displacement \"%s\" turns a rigid body about one axis and leaves it free about another; where one rotation is "
      "free the others are 0",
      d->name));
  for (PetscInt i = 0; i < 3; ++i) d->released[i] = (PetscBool)!d->fixed[i];
  for (PetscInt i = 0; i < 3; ++i)
    d->fixed[i] = (PetscBool) !(d->released[i] || d->released[3 + (i + 1) % 3] || d->released[3 + (i + 2) % 3]);
  PetscFunctionReturn(0);
}

/* rotation, and the center that it is about */
PetscErrorCode SceneReadRotation(SceneKeys keys, SceneDisplacement *d)
{
  const PetscBool whole = SceneIsWholeBody(d->face);
  const char     *rotation, *center;
  char            key[SCENE_KEY_LENGTH];
  PetscBool       turns;

  PetscFunctionBegin;
  PetscCall(PetscSNPrintf(key, sizeof(key), "displacements_%s_rotation", d->name));
  PetscCall(SceneKeysGet(keys, PETSC_FALSE, &rotation, "%s", key));
  if (rotation) PetscCall(SceneReadAngles(keys, key, rotation, d));
  PetscCall(PetscSNPrintf(key, sizeof(key), "displacements_%s_center", d->name));
  PetscCall(SceneKeysGet(keys, PETSC_FALSE, &center, "%s", key));
  if (center) PetscCall(SceneParseReals(keys, key, center, 3, d->center));
  turns = (PetscBool)(SceneRotates(d) || SceneTurnsFreely(d));
  if (turns) d->moves = PETSC_TRUE;
  if (turns && !center)
    PetscCall(SceneKeysComplain(keys, "displacement \"%s\" has a rotation and no center that it is about", d->name));
  if (center && !turns)
    PetscCall(SceneKeysComplain(keys, "displacement \"%s\" has a center and no rotation about it", d->name));
  if (!whole && SceneTurnsFreely(d))
    PetscCall(SceneKeysComplain(keys,
      "displacement \"%s\" has a rotation that is free, which a rigid body can have, as {body: <body>, ...}, and a "
      "face can not",
      d->name));
  else if (d->moves && !whole && !(d->fixed[0] && d->fixed[1] && d->fixed[2]))
    PetscCall(SceneKeysComplain(keys,
      "displacement \"%s\" is a rigid motion: it prescribes all three components, none is free", d->name));
  if (whole) PetscCall(SceneRelease(keys, d));
  PetscFunctionReturn(0);
}

/* A face, or all of a rigid body */
PetscErrorCode SceneViewTarget(PetscViewer viewer, const char face[])
{
  PetscFunctionBegin;
  if (SceneIsWholeBody(face))
    PetscCall(PetscViewerASCIIPrintf(viewer, "body: %.*s", (int)(strlen(face) - strlen(SCENE_WHOLE_BODY)), face));
  else PetscCall(PetscViewerASCIIPrintf(viewer, "face: %s", face));
  PetscFunctionReturn(0);
}

/* [numbers], or free */
PetscErrorCode SceneViewComponents(PetscViewer viewer, const PetscReal value[3], const PetscBool free[3])
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

PetscErrorCode SceneViewMotion(PetscViewer viewer, const SceneDisplacement *d)
{
  PetscFunctionBegin;
  if (!SceneRotates(d) && !SceneTurnsFreely(d)) PetscFunctionReturn(0);
  PetscCall(PetscViewerASCIIPrintf(viewer, ", rotation: "));
  PetscCall(SceneViewComponents(viewer, d->rotation, d->released + 3));
  PetscCall(PetscViewerASCIIPrintf(viewer, ", center: "));
  PetscCall(SceneViewList(viewer, 3, d->center));
  PetscFunctionReturn(0);
}

/* Two displacements of one face or body: both rigid motions, about one center */
PetscErrorCode SceneValidateMotions(MPI_Comm comm, const char file[], const SceneDisplacement *a,
  const SceneDisplacement *b)
{
  PetscFunctionBegin;
  PetscCheck(a->moves && b->moves, comm, PETSC_ERR_USER_INPUT,
    "%s: displacement \"%s\" is a rigid motion of %s, and \"%s\" displaces the same face", file,
    a->moves ? a->name : b->name, a->face, a->moves ? b->name : a->name);
  for (PetscInt i = 0; i < 6; ++i)
    PetscCheck(a->released[i] == b->released[i], comm, PETSC_ERR_USER_INPUT,
      "%s: displacements \"%s\" and \"%s\" add up to one rigid motion, and the first one %s it %s %c where the other "
      "one does not",
      file, a->name, b->name, a->released[i] ? "frees" : "holds", i < 3 ? "along" : "about", "xyz"[i % 3]);
  for (PetscInt i = 0; i < 3; ++i)
    PetscCheck(!SceneTurnsFreely(a) || a->center[i] == b->center[i], comm, PETSC_ERR_USER_INPUT,
      "%s: displacements \"%s\" and \"%s\" add up to one rigid motion, but rotate about different centers", file,
      a->name, b->name);
  for (PetscInt i = 0; i < 3; ++i)
    PetscCheck(!SceneRotates(a) || !SceneRotates(b) || a->center[i] == b->center[i], comm, PETSC_ERR_USER_INPUT,
      "%s: displacements \"%s\" and \"%s\" add up to one rigid motion, but rotate about different centers", file,
      a->name, b->name);
  PetscFunctionReturn(0);
}

/* Every rigid body is moved as a whole, and nothing else prescribes its displacements */
PetscErrorCode SceneValidateRigid(MPI_Comm comm, const char file[], Scene scene)
{
  PetscInt nrigid = 0;

  PetscFunctionBegin;
  for (PetscInt b = 0; b < scene->nbodies; ++b) {
    const SceneBody *body  = &scene->bodies[b];
    PetscBool        moved = PETSC_FALSE;

    if (body->material.type != MATERIAL_RIGID) continue;
    ++nrigid;
    for (PetscInt d = 0; d < scene->ndisplacements; ++d) {
      const char *face = NULL;

      if (SceneFindBody(scene, scene->displacements[d].face, &face) != b) continue;
      moved = PETSC_TRUE;
      PetscCheck(SceneIsWholeBody(scene->displacements[d].face), comm, PETSC_ERR_USER_INPUT,
        "%s: displacement \"%s\" names the face \"%s\" of a rigid body; a rigid body moves as a whole: - %s: {body: "
        "%s, value: [0, 0, 0]}",
        file, scene->displacements[d].name, scene->displacements[d].face, scene->displacements[d].name, body->name);
    }
    PetscCheck(moved, comm, PETSC_ERR_USER_INPUT,
      "%s: no displacement says how the rigid body \"%s\" moves; add for example displacements: - %s: {body: %s, "
      "value: [0, 0, 0]}",
      file, body->name, body->name, body->name);
  }
  PetscCheck(nrigid < scene->nbodies, comm, PETSC_ERR_USER_INPUT,
    "%s: every body is rigid: there is nothing to compute", file);
  PetscFunctionReturn(0);
}
