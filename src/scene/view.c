/* A scene as the YAML that SceneLoad() reads */
#include "sceneimpl.h"
#include <petscviewer.h>
#include <string.h>

static PetscErrorCode SceneViewBody(Scene scene, PetscViewer viewer, PetscInt b)
{
  const SceneBody *body = &scene->bodies[b];

  PetscFunctionBegin;
  PetscCall(PetscViewerASCIIPrintf(viewer, "- %s:\n", body->name));
  PetscCall(PetscViewerASCIIPushTab(viewer));
  PetscCall(PetscViewerASCIIPushTab(viewer));
  PetscCall(SceneViewShape(body, viewer));
  PetscCall(PetscViewerASCIIPrintf(viewer, "material: %s\n", MaterialTypes[body->material.type]));
  PetscCall(SceneViewConstants(&body->material, viewer));
  if (body->material.type != MATERIAL_RIGID)
    PetscCall(PetscViewerASCIIPrintf(viewer, "element: %s\n", ElementTypes[body->element]));
  if (body->order > 1) PetscCall(PetscViewerASCIIPrintf(viewer, "order: %" PetscInt_FMT "\n", body->order));
  PetscCall(PetscViewerASCIIPopTab(viewer));
  PetscCall(PetscViewerASCIIPopTab(viewer));
  PetscFunctionReturn(0);
}

/* The end of an entry: the ramp it follows if that is not the load itself, and its bracket */
static PetscErrorCode SceneViewRampName(Scene scene, PetscViewer viewer, PetscInt ramp)
{
  PetscFunctionBegin;
  if (ramp) PetscCall(PetscViewerASCIIPrintf(viewer, ", ramp: %s", scene->ramps[ramp].name));
  PetscCall(PetscViewerASCIIPrintf(viewer, "}\n"));
  PetscFunctionReturn(0);
}

static PetscErrorCode SceneViewDisplacement(Scene scene, PetscViewer viewer, PetscInt d)
{
  const SceneDisplacement *displacement = &scene->displacements[d];
  PetscBool                free[3];

  PetscFunctionBegin;
  PetscCall(PetscViewerASCIIPrintf(viewer, "- %s: {", displacement->name));
  PetscCall(PetscViewerASCIIUseTabs(viewer, PETSC_FALSE));
  if (displacement->at != DISPLACEMENT_FACE) PetscCall(SceneViewPoint(scene, viewer, displacement));
  else PetscCall(SceneViewTarget(viewer, displacement->face));
  for (PetscInt i = 0; i < 3; ++i)
    free[i] = SceneIsWholeBody(displacement->face) ? displacement->released[i] : (PetscBool)!displacement->fixed[i];
  PetscCall(PetscViewerASCIIPrintf(viewer, ", value: "));
  PetscCall(SceneViewComponents(viewer, displacement->value, free));
  PetscCall(SceneViewMotion(viewer, displacement));
  PetscCall(SceneViewRampName(scene, viewer, displacement->ramp));
  PetscCall(PetscViewerASCIIUseTabs(viewer, PETSC_TRUE));
  PetscFunctionReturn(0);
}

static PetscErrorCode SceneViewPressure(Scene scene, PetscViewer viewer, PetscInt p)
{
  const ScenePressure *pressure = &scene->pressures[p];

  PetscFunctionBegin;
  PetscCall(PetscViewerASCIIPrintf(viewer, "- %s: {face: %s, value: ", pressure->name, pressure->face));
  PetscCall(PetscViewerASCIIUseTabs(viewer, PETSC_FALSE));
  PetscCall(SceneViewReal(viewer, pressure->value));
  if (pressure->follows) PetscCall(PetscViewerASCIIPrintf(viewer, ", follows: true"));
  PetscCall(SceneViewRampName(scene, viewer, pressure->ramp));
  PetscCall(PetscViewerASCIIUseTabs(viewer, PETSC_TRUE));
  PetscFunctionReturn(0);
}

static PetscErrorCode SceneViewBodyForce(Scene scene, PetscViewer viewer, PetscInt f)
{
  const SceneBodyForce *force = &scene->forces[f];

  PetscFunctionBegin;
  PetscCall(PetscViewerASCIIPrintf(viewer, "- %s: {", force->name));
  PetscCall(PetscViewerASCIIUseTabs(viewer, PETSC_FALSE));
  if (force->body >= 0) PetscCall(PetscViewerASCIIPrintf(viewer, "body: %s, ", scene->bodies[force->body].name));
  PetscCall(PetscViewerASCIIPrintf(viewer, "value: "));
  PetscCall(SceneViewList(viewer, 3, force->value));
  PetscCall(SceneViewRampName(scene, viewer, force->ramp));
  PetscCall(PetscViewerASCIIUseTabs(viewer, PETSC_TRUE));
  PetscFunctionReturn(0);
}

static PetscErrorCode SceneViewFriction(Scene scene, PetscViewer viewer, const SceneContactPair *pair)
{
  PetscFunctionBegin;
  if (pair->friction >= PETSC_INFINITY && pair->shear_limit >= PETSC_INFINITY)
    PetscCall(PetscViewerASCIIPrintf(viewer, ", stick: true"));
  else if (pair->friction > 0.0 && pair->friction < PETSC_INFINITY) {
    PetscCall(PetscViewerASCIIPrintf(viewer, ", friction: "));
    PetscCall(SceneViewReal(viewer, pair->friction));
    if (pair->friction_ramp >= 0)
      PetscCall(PetscViewerASCIIPrintf(viewer, ", friction_ramp: %s", scene->ramps[pair->friction_ramp].name));
  }
  if (pair->shear_limit < PETSC_INFINITY) {
    PetscCall(PetscViewerASCIIPrintf(viewer, ", shear_limit: "));
    PetscCall(SceneViewReal(viewer, pair->shear_limit));
  }
  PetscFunctionReturn(0);
}

static PetscErrorCode SceneViewPair(Scene scene, PetscViewer viewer, PetscInt p)
{
  const SceneContactPair *pair = &scene->pairs[p];

  PetscFunctionBegin;
  PetscCall(PetscViewerASCIIPrintf(viewer, "- %s: {mortar: %s, nonmortar: %s, gap: %s", pair->name, pair->mortar,
    pair->nonmortar, GapTypes[pair->gap]));
  PetscCall(PetscViewerASCIIUseTabs(viewer, PETSC_FALSE));
  if (pair->distance > 0) {
    PetscCall(PetscViewerASCIIPrintf(viewer, ", distance: "));
    PetscCall(SceneViewReal(viewer, pair->distance));
  }
  if (pair->interference >= PETSC_INFINITY) PetscCall(PetscViewerASCIIPrintf(viewer, ", interference: true"));
  else if (pair->interference > 0) {
    PetscCall(PetscViewerASCIIPrintf(viewer, ", interference: "));
    PetscCall(SceneViewReal(viewer, pair->interference));
    if (pair->interference_ramp >= 0)
      PetscCall(PetscViewerASCIIPrintf(viewer, ", ramp: %s", scene->ramps[pair->interference_ramp].name));
  }
  PetscCall(SceneViewFriction(scene, viewer, pair));
  if (!pair->smooth) PetscCall(PetscViewerASCIIPrintf(viewer, ", smooth: false"));
  PetscCall(PetscViewerASCIIPrintf(viewer, "}\n"));
  PetscCall(PetscViewerASCIIUseTabs(viewer, PETSC_TRUE));
  PetscFunctionReturn(0);
}

static PetscErrorCode SceneViewRamp(Scene scene, PetscViewer viewer, PetscInt r)
{
  PetscFunctionBegin;
  PetscCall(PetscViewerASCIIPrintf(viewer, "- %s: {factors: ", scene->ramps[1 + r].name));
  PetscCall(PetscViewerASCIIUseTabs(viewer, PETSC_FALSE));
  PetscCall(SceneViewList(viewer, scene->nsteps, scene->ramps[1 + r].factor));
  PetscCall(PetscViewerASCIIPrintf(viewer, "}\n"));
  PetscCall(PetscViewerASCIIUseTabs(viewer, PETSC_TRUE));
  PetscFunctionReturn(0);
}

/* In double quotes: a value may hold what YAML takes for its own */
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

static PetscErrorCode SceneViewEntries(Scene scene, PetscViewer viewer, const char key[], PetscInt n,
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

static PetscErrorCode SceneViewPlane(Scene scene, PetscViewer viewer, PetscInt d)
{
  PetscFunctionBegin;
  PetscCall(PetscViewerASCIIPrintf(viewer, "- %s: {face: %s, normal: ", scene->displacements[d].name,
    scene->displacements[d].face));
  PetscCall(PetscViewerASCIIUseTabs(viewer, PETSC_FALSE));
  PetscCall(SceneViewList(viewer, 3, scene->displacements[d].normal));
  PetscCall(PetscViewerASCIIPrintf(viewer, "}\n"));
  PetscCall(PetscViewerASCIIUseTabs(viewer, PETSC_TRUE));
  PetscFunctionReturn(0);
}

/* Those that are symmetry planes along no axis, or those that are not */
static PetscErrorCode SceneViewDisplacements(Scene scene, PetscViewer viewer, const char key[], PetscBool inclined,
  PetscErrorCode (*view)(Scene, PetscViewer, PetscInt))
{
  PetscBool any = PETSC_FALSE;

  PetscFunctionBegin;
  for (PetscInt d = 0; d < scene->ndisplacements; ++d) {
    if (scene->displacements[d].inclined != inclined) continue;
    if (!any) PetscCall(PetscViewerASCIIPrintf(viewer, "%s:\n", key));
    any = PETSC_TRUE;
    PetscCall(PetscViewerASCIIPushTab(viewer));
    PetscCall(view(scene, viewer, d));
    PetscCall(PetscViewerASCIIPopTab(viewer));
  }
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
  PetscCall(PetscViewerASCIIPrintf(viewer, "problem: %s\n", scene->name));
  if (scene->units) PetscCall(PetscViewerASCIIPrintf(viewer, "units: %s\n", scene->units));
  PetscCall(SceneViewEntries(scene, viewer, "bodies", scene->nbodies, SceneViewBody));
  PetscCall(SceneViewFaces(scene, viewer));
  PetscCall(SceneViewDisplacements(scene, viewer, "displacements", PETSC_FALSE, SceneViewDisplacement));
  PetscCall(SceneViewDisplacements(scene, viewer, "symmetry", PETSC_TRUE, SceneViewPlane));
  PetscCall(SceneViewEntries(scene, viewer, "pressures", scene->npressures, SceneViewPressure));
  PetscCall(SceneViewTractions(scene, viewer));
  PetscCall(SceneViewSprings(scene, viewer));
  PetscCall(SceneViewTemperatures(scene, viewer));
  PetscCall(SceneViewEntries(scene, viewer, "body_forces", scene->nforces, SceneViewBodyForce));
  PetscCall(SceneViewEntries(scene, viewer, "contact", scene->npairs, SceneViewPair));
  PetscCall(SceneViewEntries(scene, viewer, "ties", scene->nties, SceneViewTie));
  PetscCall(SceneViewEntries(scene, viewer, "refinements", scene->nrefinements, SceneViewRefinement));
  PetscCall(SceneViewEntries(scene, viewer, "probes", scene->nprobes, SceneViewProbe));
  PetscCall(PetscViewerASCIIPrintf(viewer, "load:\n"));
  PetscCall(PetscViewerASCIIPushTab(viewer));
  PetscCall(SceneViewReals(viewer, "factors", scene->nsteps, scene->ramps[0].factor));
  PetscCall(PetscViewerASCIIPopTab(viewer));
  PetscCall(SceneViewEntries(scene, viewer, "ramps", scene->nramps - 1, SceneViewRamp));
  PetscCall(PetscViewerASCIIPrintf(viewer, "refine: %" PetscInt_FMT "\n", scene->refine));
  PetscCall(PetscViewerASCIIPrintf(viewer, "model: %s\n", StepModels[scene->model]));
  PetscCall(PetscViewerASCIIPrintf(viewer, "contact_updates: %" PetscInt_FMT "\n", scene->contact_updates));
  if (scene->displacement_bounds)
    PetscCall(PetscViewerASCIIPrintf(viewer, "displacement_bounds: %" PetscInt_FMT "\n", scene->displacement_bounds));
  PetscCall(SceneViewEntries(scene, viewer, "solver", scene->noptions, SceneViewOption));
  PetscFunctionReturn(0);
}
