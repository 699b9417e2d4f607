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
    PetscCall(SceneKeysError(keys, owner, "lock", "is %" PetscInt_FMT "; it is the number of a load step", bolt->lock));
  if (bolt->lock && bolt->shortens)
    PetscCall(SceneKeysError(keys, owner, "lock", "is only for a bolt whose force is given; give shortening a ramp"));
  if (VectorNorm(bolt->axis) == 0.0)
    PetscCall(SceneKeysError(keys, owner, "axis", "is (0, 0, 0), which is no direction"));
  PetscFunctionReturn(0);
}

PetscErrorCode SceneValidateBolts(MPI_Comm comm, Scene scene)
{
  PetscFunctionBegin;
  for (PetscInt b = 0; b < scene->nbolts; ++b) {
    const SceneBolt *bolt = &scene->bolts[b];

    SceneRequire(scene->bodies[bolt->body].material.type != MATERIAL_RIGID, bolt,
      "bolt \"%s\": its body \"%s\" is rigid, and has no force in a section", bolt->name,
      scene->bodies[bolt->body].name);
    SceneRequire(!SceneIsDynamic(scene), bolt,
      "bolt \"%s\": pretension is for static analyses, and the scene has dynamics", bolt->name);
  }
  PetscFunctionReturn(0);
}
