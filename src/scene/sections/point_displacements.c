/* Displacements at points and along edges of bodies */
#include "sectionsimpl.h"
#include <petscviewer.h>

/* point, or from and to, of an elastic body: a name of its own stands for a face */
PetscErrorCode SceneReadPoint(SceneKeys keys, Scene scene, PetscInt body, SceneDisplacement *d)
{
  const struct {
    const char *name;
    PetscReal  *place;
  } places[] = {
    {"point", d->from},
    {"from", d->from},
    {"to", d->to},
  };
  const char *text[3];
  char        key[SCENE_KEY_LENGTH];

  PetscFunctionBegin;
  for (PetscInt i = 0; i < 3; ++i) {
    PetscCall(PetscSNPrintf(key, sizeof(key), "displacements_%s_%s", d->name, places[i].name));
    PetscCall(SceneKeysGet(keys, PETSC_FALSE, &text[i], "%s", key));
    if (text[i]) PetscCall(SceneParseReals(keys, key, text[i], 3, places[i].place));
  }
  if (!text[0] && !text[1] && !text[2]) PetscFunctionReturn(0);
  if (text[0] ? text[1] || text[2] : !text[1] || !text[2])
    PetscCall(SceneKeysComplain(keys,
      "displacement \"%s\" is either at a point, {body, point: [x, y, z]}, or along an edge, {body, from: [x, y, z], "
      "to: [x, y, z]}",
      d->name));
  if (body == PETSC_DECIDE)
    PetscCall(SceneKeysComplain(keys,
      "displacement \"%s\" is at a point or along an edge of no body; the key body says of which", d->name));
  d->at   = text[0] ? DISPLACEMENT_POINT : DISPLACEMENT_EDGE;
  d->body = body;
  if (text[0]) PetscCall(PetscArraycpy(d->to, d->from, 3));
  PetscCall(PetscSNPrintf(key, sizeof(key), "%s.@%s", body < 0 ? "" : scene->bodies[body].name, d->name));
  PetscCall(PetscStrallocpy(key, &d->face));
  PetscFunctionReturn(0);
}

PetscErrorCode SceneViewPoint(Scene scene, PetscViewer viewer, const SceneDisplacement *d)
{
  PetscFunctionBegin;
  PetscCall(PetscViewerASCIIPrintf(viewer, "body: %s, %s: ", scene->bodies[d->body].name,
    d->at == DISPLACEMENT_POINT ? "point" : "from"));
  PetscCall(SceneViewList(viewer, 3, d->from));
  if (d->at == DISPLACEMENT_EDGE) {
    PetscCall(PetscViewerASCIIPrintf(viewer, ", to: "));
    PetscCall(SceneViewList(viewer, 3, d->to));
  }
  PetscFunctionReturn(0);
}
