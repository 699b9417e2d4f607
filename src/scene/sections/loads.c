/* forces, tractions and temperatures: keys that are not single values. */
#include "sectionsimpl.h"
#include <petscviewer.h>
#include <string.h>

PetscBool SceneTractionIsForce(const void *entry)
{
  return ((const SceneTraction *)entry)->resultant;
}

PetscBool SceneTractionIsNone(const void *entry)
{
  return (PetscBool)!SceneTractionIsForce(entry);
}

PetscBool SceneForceHides(const void *entry, const char key[])
{
  const SceneTraction *force = entry;

  if (!strcmp(key, "face")) return (PetscBool)(force->body >= 0);
  return (PetscBool)(!strcmp(key, "point") && !force->placed);
}

/* Sets a force at a point of an elastic body. moment: whether the entry has this key */
static PetscErrorCode ForceSetPoint(SceneKeys keys, Scene scene, const char owner[], PetscBool moment,
  SceneTraction *force)
{
  PetscFunctionBegin;
  if (!force->placed || moment)
    PetscCall(SceneKeysError(keys, owner, "body",
      "is \"%s\", which is not rigid: forces on elastic bodies act on a face, or at a point: {body, point, value}",
      scene->bodies[force->body].name));
  PetscCall(PetscFree(force->face));
  PetscCall(PetscStrallocpy(scene->bodies[force->body].name, &force->face));
  PetscFunctionReturn(0);
}

/* Finishes a force, which acts on a face or a rigid body and has a value, a moment or both. */
PetscErrorCode SceneFinishForce(SceneKeys keys, Scene scene, const char owner[], void *entry)
{
  SceneTraction *force = entry;
  PetscBool      turns, body;
  const char    *text;

  PetscFunctionBegin;
  PetscCall(SceneHasKey(keys, owner, "point", &force->placed));
  PetscCall(SceneHasKey(keys, owner, "moment", &turns));
  PetscCall(SceneHasKey(keys, owner, "body", &body));
  PetscCall(SceneKeysGet(keys, (PetscBool)!turns, &text, "%s_value", owner));
  PetscCall(SceneKeysGet(keys, (PetscBool)!body, &text, "%s_face", owner));
  if (body && text) PetscCall(SceneKeysError(keys, owner, NULL, "names a face and a body; give only one of the two"));
  if (force->body >= 0 && scene->bodies[force->body].material.type != MATERIAL_RIGID) {
    PetscCall(ForceSetPoint(keys, scene, owner, turns, force));
    PetscFunctionReturn(0);
  }
  PetscCall(SceneSetWholeBody(keys, scene, owner, "", force->body, &force->face));
  PetscFunctionReturn(0);
}

static PetscErrorCode SceneBodyExpands(const SceneBody *body, PetscBool *expands)
{
  PetscReal A[9];

  PetscFunctionBegin;
  *expands = PETSC_FALSE;
  PetscCall(MaterialGetExpansion(&body->material, A));
  for (int i = 0; i < 9; ++i) *expands = (PetscBool)(*expands || A[i] != 0);
  PetscFunctionReturn(0);
}

/* Checks that bodies with a temperature have a thermal expansion. */
PetscErrorCode SceneValidateTemperatures(MPI_Comm comm, Scene scene)
{
  PetscFunctionBegin;
  for (PetscInt t = 0; t < scene->ntemperatures; ++t) {
    const SceneTemperature *here = &scene->temperatures[t];
    PetscBool               any  = PETSC_FALSE;

    for (PetscInt b = 0; b < scene->nbodies && !any; ++b) {
      if (here->body == PETSC_DECIDE || here->body == b) PetscCall(SceneBodyExpands(&scene->bodies[b], &any));
    }
    SceneRequire(any, here,
      "temperature \"%s\" applies to %s, whose material has no thermal expansion; add one, for example "
      "expansion: 12e-6 (small-strain laws only)",
      here->name, here->body < 0 ? "every body" : scene->bodies[here->body].name);
  }
  PetscFunctionReturn(0);
}
