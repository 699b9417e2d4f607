/* Prints a scene as YAML that SceneLoad() can read. */
#include "sceneimpl.h"
#include <petscviewer.h>
#include <string.h>

/*
   Prints the load program of a ramp, without the braces around it. A static analysis has the factors at the ends of the
   load steps. A dynamic analysis has a table of times and values from time 0 on; the table has one entry if the factor
   is constant.
*/
static PetscErrorCode SceneViewProgram(Scene scene, PetscViewer viewer, const SceneRamp *ramp)
{
  PetscInt   n = 1;
  PetscReal *times, *values;

  PetscFunctionBegin;
  if (!SceneIsDynamic(scene)) {
    PetscCall(PetscViewerASCIIPrintf(viewer, "factors: "));
    PetscCall(SceneViewList(viewer, scene->nsteps, ramp->factor));
    PetscFunctionReturn(0);
  }
  PetscCall(PetscMalloc2(scene->nsteps + 1, &times, scene->nsteps + 1, &values));
  for (PetscInt k = 0; k <= scene->nsteps; ++k) {
    times[k]  = (PetscReal)k * scene->dynamics.time_step;
    values[k] = k ? ramp->factor[k - 1] : ramp->start;
    if (values[k] != values[0]) n = scene->nsteps + 1;
  }
  PetscCall(PetscViewerASCIIPrintf(viewer, "times: "));
  PetscCall(SceneViewList(viewer, n, times));
  PetscCall(PetscViewerASCIIPrintf(viewer, ", values: "));
  PetscCall(SceneViewList(viewer, n, values));
  PetscCall(PetscFree2(times, values));
  PetscFunctionReturn(0);
}

static PetscErrorCode SceneViewRamp(Scene scene, PetscViewer viewer, PetscInt r)
{
  PetscFunctionBegin;
  PetscCall(PetscViewerASCIIPrintf(viewer, "- %s: {", scene->ramps[1 + r].name));
  PetscCall(PetscViewerASCIIUseTabs(viewer, PETSC_FALSE));
  PetscCall(SceneViewProgram(scene, viewer, &scene->ramps[1 + r]));
  PetscCall(PetscViewerASCIIPrintf(viewer, "}\n"));
  PetscCall(PetscViewerASCIIUseTabs(viewer, PETSC_TRUE));
  PetscFunctionReturn(0);
}

/* Prints an option of PETSc. The value is printed in double quotes, because it may contain YAML syntax. */
static PetscErrorCode SceneViewOption(Scene scene, PetscViewer viewer, PetscInt o)
{
  PetscFunctionBegin;
  PetscCall(PetscViewerASCIIPrintf(viewer, "%s: \"", scene->options[o].name));
  PetscCall(PetscViewerASCIIUseTabs(viewer, PETSC_FALSE));
  for (const char *c = scene->options[o].value; *c; ++c)
    PetscCall(PetscViewerASCIIPrintf(viewer, *c == '"' || *c == '\\' ? "\\%c" : "%c", *c));
  PetscCall(PetscViewerASCIIPrintf(viewer, "\"\n"));
  PetscCall(PetscViewerASCIIUseTabs(viewer, PETSC_TRUE));
  PetscFunctionReturn(0);
}

static PetscErrorCode SceneViewNumbered(Scene scene, PetscViewer viewer, const char key[], PetscInt n,
  PetscErrorCode (*view)(Scene, PetscViewer, PetscInt))
{
  PetscFunctionBegin;
  if (!n) PetscFunctionReturn(0);
  PetscCall(PetscViewerASCIIPrintf(viewer, "%s:\n", key));
  PetscCall(PetscViewerASCIIPushTab(viewer));
  for (PetscInt i = 0; i < n; ++i) PetscCall(view(scene, viewer, i));
  PetscCall(PetscViewerASCIIPopTab(viewer));
  PetscFunctionReturn(0);
}

/* Prints the list of the top level that has this name. */
static PetscErrorCode SceneViewSection(Scene scene, PetscViewer viewer, const char name[])
{
  const SceneList *list = SceneFindList(name);

  PetscFunctionBegin;
  if (!strcmp(name, "bodies")) PetscCall(SceneViewBodies(scene, viewer, list));
  else if (!strcmp(name, "faces")) PetscCall(SceneViewFaces(scene, viewer, list));
  else if (!strcmp(name, "load") && SceneIsDynamic(scene)) {
    PetscCall(PetscViewerASCIIPrintf(viewer, "load: {"));
    PetscCall(SceneViewProgram(scene, viewer, &scene->ramps[0]));
    PetscCall(PetscViewerASCIIPrintf(viewer, "}\n"));
  } else if (!strcmp(name, "dynamics") && SceneIsDynamic(scene)) {
    PetscCall(PetscViewerASCIIPrintf(viewer, "dynamics:\n"));
    PetscCall(PetscViewerASCIIPushTab(viewer));
    PetscCall(SceneViewRows(scene, viewer, list->rows, NULL, &scene->dynamics, list->initial));
    PetscCall(PetscViewerASCIIPopTab(viewer));
  } else if (!strcmp(name, "load")) {
    PetscCall(PetscViewerASCIIPrintf(viewer, "load:\n"));
    PetscCall(PetscViewerASCIIPushTab(viewer));
    PetscCall(SceneViewReals(viewer, "factors", scene->nsteps, scene->ramps[0].factor));
    PetscCall(PetscViewerASCIIPopTab(viewer));
  } else if (!strcmp(name, "ramps"))
    PetscCall(SceneViewNumbered(scene, viewer, name, scene->nramps - 1, SceneViewRamp));
  else if (!strcmp(name, "contact")) PetscCall(SceneViewPairs(scene, viewer, list));
  else if (!strcmp(name, "solver")) PetscCall(SceneViewNumbered(scene, viewer, name, scene->noptions, SceneViewOption));
  else if (list && list->entries)
    PetscCall(SceneViewEntries(scene, viewer, list, *(const PetscInt *)((const char *)scene + list->count),
      *(void *const *)((const char *)scene + list->entries)));
  PetscFunctionReturn(0);
}

/*@C
   SceneView - Prints a scene as YAML that can be read again, with all numbers to full precision

   Collective on the viewer

   Input Parameters:
+  scene  - the scene
-  viewer - an ASCII viewer

   Level: beginner

.seealso: `SceneLoad()`
@*/
PetscErrorCode SceneView(Scene scene, PetscViewer viewer)
{
  PetscFunctionBegin;
  for (const SceneKey *row = SceneLists[0].rows; row->name; ++row) {
    if (row->type == SCENE_SECTION) PetscCall(SceneViewSection(scene, viewer, row->name));
    else PetscCall(SceneViewRow(scene, viewer, row, scene, NULL));
  }
  PetscFunctionReturn(0);
}
