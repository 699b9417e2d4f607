/* probes: a list of named points and lines at which results are wanted */
#include "sectionsimpl.h"
#include <petscviewer.h>

#define PROBE_MAX_POINTS 1000000

/* Three coordinates of a key that may be missing */
static PetscErrorCode SceneReadPlace(SceneKeys keys, const char name[], const char which[], PetscReal place[3],
  PetscBool *given)
{
  char        key[SCENE_KEY_LENGTH];
  const char *text;

  PetscFunctionBegin;
  PetscCall(PetscSNPrintf(key, sizeof(key), "probes_%s_%s", name, which));
  PetscCall(SceneKeysGet(keys, PETSC_FALSE, &text, "%s", key));
  *given = text ? PETSC_TRUE : PETSC_FALSE;
  if (text) PetscCall(SceneParseReals(keys, key, text, 3, place));
  PetscFunctionReturn(0);
}

static PetscErrorCode SceneReadProbe(SceneKeys keys, Scene scene, SceneProbe *probe)
{
  char        key[SCENE_KEY_LENGTH];
  const char *count;
  PetscBool   point, from, to;

  PetscFunctionBegin;
  PetscCall(SceneReadPlace(keys, probe->name, "point", probe->from, &point));
  PetscCall(SceneReadPlace(keys, probe->name, "from", probe->from, &from));
  PetscCall(SceneReadPlace(keys, probe->name, "to", probe->to, &to));
  PetscCall(PetscSNPrintf(key, sizeof(key), "probes_%s_points", probe->name));
  PetscCall(SceneKeysGet(keys, PETSC_FALSE, &count, "%s", key));
  PetscCall(SceneReadBodyName(keys, scene, "probes", probe->name, &probe->body));
  probe->n = 1;
  if (point) {
    if (from || to || count)
      PetscCall(SceneKeysComplain(keys, "probes_%s is a point, which has neither from, to nor points", probe->name));
    PetscFunctionReturn(0);
  }
  if (!from || !to || !count) {
    PetscCall(SceneKeysComplain(keys,
      "probes_%s is neither a point, {point: [x, y, z]}, nor a line, {from: [x, y, z], to: [x, y, z], points: N}",
      probe->name));
    PetscFunctionReturn(0);
  }
  probe->line = PETSC_TRUE;
  PetscCall(SceneParseInt(keys, key, count, &probe->n));
  if (probe->n < 2 || probe->n > PROBE_MAX_POINTS) {
    PetscCall(SceneKeysComplain(keys, "%s is %s; a line has from 2 to %d", key, count, PROBE_MAX_POINTS));
    probe->n = 2;
  }
  PetscFunctionReturn(0);
}

PetscErrorCode SceneReadProbes(SceneKeys keys, Scene scene)
{
  char **names;

  PetscFunctionBegin;
  PetscCall(SceneGetNames(keys, "probes", PETSC_FALSE, &scene->nprobes, &names));
  PetscCall(PetscCalloc1(scene->nprobes, &scene->probes));
  for (PetscInt p = 0; p < scene->nprobes; ++p) {
    scene->probes[p].name = names[p];
    PetscCall(SceneReadProbe(keys, scene, &scene->probes[p]));
  }
  PetscCall(PetscFree(names));
  PetscFunctionReturn(0);
}

PetscErrorCode SceneViewProbe(Scene scene, PetscViewer viewer, PetscInt p)
{
  const SceneProbe *probe = &scene->probes[p];

  PetscFunctionBegin;
  PetscCall(PetscViewerASCIIPrintf(viewer, "- %s: {%s: ", probe->name, probe->line ? "from" : "point"));
  PetscCall(PetscViewerASCIIUseTabs(viewer, PETSC_FALSE));
  PetscCall(SceneViewList(viewer, 3, probe->from));
  if (probe->line) {
    PetscCall(PetscViewerASCIIPrintf(viewer, ", to: "));
    PetscCall(SceneViewList(viewer, 3, probe->to));
    PetscCall(PetscViewerASCIIPrintf(viewer, ", points: %" PetscInt_FMT, probe->n));
  }
  if (probe->body >= 0) PetscCall(PetscViewerASCIIPrintf(viewer, ", body: %s", scene->bodies[probe->body].name));
  PetscCall(PetscViewerASCIIPrintf(viewer, "}\n"));
  PetscCall(PetscViewerASCIIUseTabs(viewer, PETSC_TRUE));
  PetscFunctionReturn(0);
}

PetscErrorCode SceneDestroyProbes(Scene scene)
{
  PetscFunctionBegin;
  for (PetscInt p = 0; p < scene->nprobes; ++p) PetscCall(PetscFree(scene->probes[p].name));
  PetscCall(PetscFree(scene->probes));
  PetscFunctionReturn(0);
}
