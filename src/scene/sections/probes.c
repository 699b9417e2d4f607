/* probes: points, or lines with a number of points. */
#include "sectionsimpl.h"
#include <string.h>

#define PROBE_MAX_POINTS 1000000

PetscBool SceneProbeHides(const void *entry, const char key[])
{
  const SceneProbe *probe = entry;

  if (!strcmp(key, "body")) return PETSC_FALSE;
  return (PetscBool)(probe->line ? !strcmp(key, "point") : strcmp(key, "point") != 0);
}

PetscErrorCode SceneFinishProbe(SceneKeys keys, Scene scene, const char owner[], void *entry)
{
  SceneProbe *probe = entry;
  PetscBool   point, from, to, count;

  PetscFunctionBegin;
  (void)scene;
  PetscCall(SceneHasKey(keys, owner, "point", &point));
  PetscCall(SceneHasKey(keys, owner, "from", &from));
  PetscCall(SceneHasKey(keys, owner, "to", &to));
  PetscCall(SceneHasKey(keys, owner, "points", &count));
  if (point) {
    if (from || to || count)
      PetscCall(SceneKeysError(keys, owner, NULL, "is a point, which has neither from, to nor points"));
    PetscFunctionReturn(0);
  }
  if (!from || !to || !count)
    PetscCall(SceneKeysError(keys, owner, NULL,
      "is neither a point, {point: [x, y, z]}, nor a line, {from: [x, y, z], to: [x, y, z], points: N}"));
  probe->line = PETSC_TRUE;
  if (probe->n < 2 || probe->n > PROBE_MAX_POINTS) {
    PetscCall(SceneKeysError(keys, owner, "points", "is %" PetscInt_FMT "; a line has from 2 to %d", probe->n,
      PROBE_MAX_POINTS));
    probe->n = 2;
  }
  PetscFunctionReturn(0);
}
