/* bolts: keys that depend on one another. */
#include "sectionsimpl.h"
#include <string.h>
#include <vector3.h>

PetscBool SceneBoltHides(const void *entry, const char key[])
{
  const SceneBolt *bolt = entry;

  return (PetscBool)(!strcmp(key, "force") ? bolt->shortens : !strcmp(key, "shortening") && !bolt->shortens);
}

PetscErrorCode SceneFinishBolt(SceneKeys keys, Scene scene, const char owner[], void *entry)
{
  SceneBolt  *bolt = entry;
  const char *text;

  PetscFunctionBegin;
  (void)scene;
  PetscCall(SceneKeysGet(keys, PETSC_TRUE, &text, "%s_body", owner));
  PetscCall(SceneHasOneOf(keys, owner, "bolt", "force", "shortening", &bolt->shortens));
  if (bolt->lock < 0)
    PetscCall(SceneKeysError(keys, "%s_lock is %" PetscInt_FMT "; it is the number of a load step", owner, bolt->lock));
  if (bolt->lock && bolt->shortens)
    PetscCall(SceneKeysError(keys, "%s_lock is only for a bolt whose force is given; give shortening a ramp", owner));
  if (VectorNorm(bolt->axis) == 0.0)
    PetscCall(SceneKeysError(keys, "%s_axis is (0, 0, 0), which is no direction", owner));
  PetscFunctionReturn(0);
}

PetscErrorCode SceneValidateBolts(MPI_Comm comm, const char file[], Scene scene)
{
  PetscFunctionBegin;
  for (PetscInt b = 0; b < scene->nbolts; ++b) {
    const SceneBolt *bolt = &scene->bolts[b];

    PetscCheck(scene->bodies[bolt->body].material.type != MATERIAL_RIGID, comm, PETSC_ERR_USER_INPUT,
      "%s: bolt \"%s\": its body \"%s\" is rigid, and has no force in a section", file, bolt->name,
      scene->bodies[bolt->body].name);
    PetscCheck(!SceneIsDynamic(scene), comm, PETSC_ERR_USER_INPUT,
      "%s: bolt \"%s\": pretension is for static analyses, and the scene has dynamics", file, bolt->name);
  }
  PetscFunctionReturn(0);
}
