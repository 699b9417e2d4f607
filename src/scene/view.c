/* A scene as the YAML that SceneLoad() reads */
#include "sceneimpl.h"
#include <petscviewer.h>
#include <stdlib.h>

/* The shortest decimal that reads back as the same number */
static PetscErrorCode ViewReal(PetscViewer viewer, PetscReal value)
{
  char text[64];

  PetscFunctionBegin;
  for (int digits = 6; digits <= 17; ++digits) {
    (void)snprintf(text, sizeof(text), "%.*g", digits, (double)value);
    if ((PetscReal)strtod(text, NULL) == value) break;
  }
  PetscCall(PetscViewerASCIIPrintf(viewer, "%s", text));
  PetscFunctionReturn(0);
}

static PetscErrorCode ViewReals(PetscViewer viewer, const char label[], PetscInt n, const PetscReal values[])
{
  PetscFunctionBegin;
  PetscCall(PetscViewerASCIIPrintf(viewer, "%s: [", label));
  PetscCall(PetscViewerASCIIUseTabs(viewer, PETSC_FALSE));
  for (PetscInt i = 0; i < n; ++i) {
    if (i) PetscCall(PetscViewerASCIIPrintf(viewer, ", "));
    PetscCall(ViewReal(viewer, values[i]));
  }
  PetscCall(PetscViewerASCIIPrintf(viewer, "]\n"));
  PetscCall(PetscViewerASCIIUseTabs(viewer, PETSC_TRUE));
  PetscFunctionReturn(0);
}

static PetscErrorCode ViewBody(PetscViewer viewer, const SceneBody *body)
{
  const PetscReal constants[] = {body->material.young, body->material.poisson};
  const char     *labels[]    = {"young", "poisson"};

  PetscFunctionBegin;
  PetscCall(PetscViewerASCIIPrintf(viewer, "- %s:\n", body->name));
  PetscCall(PetscViewerASCIIPushTab(viewer));
  PetscCall(PetscViewerASCIIPushTab(viewer));
  PetscCall(PetscViewerASCIIPrintf(viewer, "shape: %s\n", BodyShapes[body->shape]));
  PetscCall(ViewReals(viewer, "lower", 3, body->lower));
  PetscCall(ViewReals(viewer, "upper", 3, body->upper));
  PetscCall(PetscViewerASCIIPrintf(viewer, "cells: [%" PetscInt_FMT ", %" PetscInt_FMT ", %" PetscInt_FMT "]\n", body->cells[0], body->cells[1], body->cells[2]));
  PetscCall(PetscViewerASCIIPrintf(viewer, "material: %s\n", MaterialTypes[body->material.type]));
  for (PetscInt i = 0; i < 2; ++i) {
    PetscCall(PetscViewerASCIIPrintf(viewer, "%s: ", labels[i]));
    PetscCall(PetscViewerASCIIUseTabs(viewer, PETSC_FALSE));
    PetscCall(ViewReal(viewer, constants[i]));
    PetscCall(PetscViewerASCIIPrintf(viewer, "\n"));
    PetscCall(PetscViewerASCIIUseTabs(viewer, PETSC_TRUE));
  }
  PetscCall(PetscViewerASCIIPopTab(viewer));
  PetscCall(PetscViewerASCIIPopTab(viewer));
  PetscFunctionReturn(0);
}

static PetscErrorCode ViewDisplacement(PetscViewer viewer, const SceneDisplacement *displacement)
{
  PetscFunctionBegin;
  PetscCall(PetscViewerASCIIPrintf(viewer, "- %s: {face: %s, value: [", displacement->name, displacement->face));
  PetscCall(PetscViewerASCIIUseTabs(viewer, PETSC_FALSE));
  for (PetscInt i = 0; i < 3; ++i) {
    if (i) PetscCall(PetscViewerASCIIPrintf(viewer, ", "));
    if (displacement->fixed[i]) PetscCall(ViewReal(viewer, displacement->value[i]));
    else PetscCall(PetscViewerASCIIPrintf(viewer, "free"));
  }
  PetscCall(PetscViewerASCIIPrintf(viewer, "]}\n"));
  PetscCall(PetscViewerASCIIUseTabs(viewer, PETSC_TRUE));
  PetscFunctionReturn(0);
}

/*@C
   SceneView - Prints a scene as the YAML it can be read from, every number to full precision

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
  PetscCall(PetscViewerASCIIPrintf(viewer, "problem: %s\nbodies:\n", scene->name));
  PetscCall(PetscViewerASCIIPushTab(viewer));
  for (PetscInt b = 0; b < scene->nbodies; ++b) PetscCall(ViewBody(viewer, &scene->bodies[b]));
  PetscCall(PetscViewerASCIIPopTab(viewer));
  if (scene->ndisplacements) PetscCall(PetscViewerASCIIPrintf(viewer, "displacements:\n"));
  PetscCall(PetscViewerASCIIPushTab(viewer));
  for (PetscInt d = 0; d < scene->ndisplacements; ++d) PetscCall(ViewDisplacement(viewer, &scene->displacements[d]));
  PetscCall(PetscViewerASCIIPopTab(viewer));
  if (scene->npairs) PetscCall(PetscViewerASCIIPrintf(viewer, "contact:\n"));
  PetscCall(PetscViewerASCIIPushTab(viewer));
  for (PetscInt p = 0; p < scene->npairs; ++p) PetscCall(PetscViewerASCIIPrintf(viewer, "- %s: {mortar: %s, nonmortar: %s}\n", scene->pairs[p].name, scene->pairs[p].mortar, scene->pairs[p].nonmortar));
  PetscCall(PetscViewerASCIIPopTab(viewer));
  PetscCall(PetscViewerASCIIPrintf(viewer, "load:\n"));
  PetscCall(PetscViewerASCIIPushTab(viewer));
  PetscCall(ViewReals(viewer, "factors", scene->nsteps, scene->ramps[0].factor));
  PetscCall(PetscViewerASCIIPopTab(viewer));
  PetscCall(PetscViewerASCIIPrintf(viewer, "refine: %" PetscInt_FMT "\n", scene->refine));
  PetscFunctionReturn(0);
}
