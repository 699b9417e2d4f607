/* Describes the loads of a scene: prescribed displacements, forces, springs, bolts, temperatures */
#include "sceneimpl.h"
#include <vector3.h>
#include <petscviewer.h>

/* Prints `before` and a vector in parentheses */
static PetscErrorCode DescribeVector(PetscViewer viewer, const char before[], const PetscReal v[3])
{
  PetscFunctionBegin;
  PetscCall(PetscViewerASCIIPrintf(viewer, "%s(%.6g, %.6g, %.6g)", before, (double)v[0], (double)v[1], (double)v[2]));
  PetscFunctionReturn(0);
}

/* Prints the ramp that a load follows, at the end of its line */
static PetscErrorCode DescribeRamp(Scene scene, PetscInt ramp, PetscViewer viewer)
{
  PetscFunctionBegin;
  PetscCall(PetscViewerASCIIPrintf(viewer, ", follows %s\n", scene->ramps[ramp].name));
  PetscFunctionReturn(0);
}

static PetscErrorCode DescribeDisplacement(Scene scene, const SceneDisplacement *d, PetscViewer viewer)
{
  PetscFunctionBegin;
  PetscCall(PetscViewerASCIIPrintf(viewer, "  displacement %s: %s", d->name, d->face));
  for (PetscInt i = 0; i < 3; ++i) {
    if (d->fixed[i] || (SceneIsWholeBody(d->face) && !d->released[i]))
      PetscCall(PetscViewerASCIIPrintf(viewer, ", u%c = %.6g", "xyz"[i], (double)d -> value[i]));
  }
  for (PetscInt i = 0; i < 6; ++i) {
    if (d->released[i])
      PetscCall(PetscViewerASCIIPrintf(viewer, ", free %s %c", i < 3 ? "along" : "about", "xyz"[i % 3]));
  }
  if (d->inclined) PetscCall(DescribeVector(viewer, ", no displacement along ", d->normal));
  if (SceneRotates(d)) {
    PetscCall(DescribeVector(viewer, ", rotated by ", d->rotation));
    PetscCall(DescribeVector(viewer, " degrees about ", d->center));
  }
  PetscCall(DescribeRamp(scene, d->ramp, viewer));
  PetscFunctionReturn(0);
}

static PetscErrorCode DescribeTraction(Scene scene, const SceneTraction *t, PetscViewer viewer)
{
  PetscFunctionBegin;
  PetscCall(PetscViewerASCIIPrintf(viewer, "  %s %s: %s", t->resultant ? "force" : "traction", t->name, t->face));
  PetscCall(DescribeVector(viewer, ", ", t->value));
  if (t->placed) PetscCall(DescribeVector(viewer, ", at ", t->point));
  if (t->resultant) PetscCall(DescribeVector(viewer, ", moment ", t->moment));
  PetscCall(DescribeRamp(scene, t->ramp, viewer));
  PetscFunctionReturn(0);
}

static PetscErrorCode DescribeConnector(Scene scene, const SceneConnector *c, PetscViewer viewer)
{
  PetscFunctionBegin;
  PetscCall(PetscViewerASCIIPrintf(viewer, "  connector %s: %s to %s, ", c->name, scene->bodies[c->body].name,
    c->to < 0 ? "the ground" : scene->bodies[c->to].name));
  if (c->axial) PetscCall(PetscViewerASCIIPrintf(viewer, "stiffness %.6g along the line", (double)c->stiffness));
  else PetscCall(DescribeVector(viewer, "stiffness ", c->value));
  if (c->damping > 0.0) PetscCall(PetscViewerASCIIPrintf(viewer, ", damping %.6g", (double)c->damping));
  PetscCall(PetscViewerASCIIPrintf(viewer, "\n"));
  PetscFunctionReturn(0);
}

static PetscErrorCode DescribeEquation(Scene scene, const SceneEquation *e, PetscViewer viewer)
{
  PetscFunctionBegin;
  PetscCall(PetscViewerASCIIPrintf(viewer, "  equation %s: %s", e->name, scene->bodies[e->body].name));
  PetscCall(DescribeVector(viewer, " times ", e->direction[0]));
  if (e->to >= 0) PetscCall(PetscViewerASCIIPrintf(viewer, ", %s", scene->bodies[e->to].name));
  if (e->to >= 0) PetscCall(DescribeVector(viewer, " times ", e->direction[1]));
  PetscCall(PetscViewerASCIIPrintf(viewer, ", value %.6g, follows %s\n", (double)e->value, scene->ramps[e->ramp].name));
  PetscFunctionReturn(0);
}

/* Prints springs on faces, springs between points, equations and bolts */
static PetscErrorCode DescribeJoints(Scene scene, PetscViewer viewer)
{
  PetscFunctionBegin;
  for (PetscInt s = 0; s < scene->nsprings; ++s) {
    const SceneSpring *here = &scene->springs[s];

    PetscCall(PetscViewerASCIIPrintf(viewer, "  springs %s: %s%s%s", here->name, here->face, here->to ? " to " : "",
      here->to ? here->to : ""));
    PetscCall(DescribeVector(viewer, ", stiffness ", here->value));
    PetscCall(PetscViewerASCIIPrintf(viewer, " per area\n"));
  }
  for (PetscInt c = 0; c < scene->nconnectors; ++c) PetscCall(DescribeConnector(scene, &scene->connectors[c], viewer));
  for (PetscInt e = 0; e < scene->nequations; ++e) PetscCall(DescribeEquation(scene, &scene->equations[e], viewer));
  for (PetscInt b = 0; b < scene->nbolts; ++b) {
    const SceneBolt *here = &scene->bolts[b];

    PetscCall(PetscViewerASCIIPrintf(viewer, "  bolt %s: %s, %s %.6g, follows %s", here->name,
      scene->bodies[here->body].name, here->shortens ? "shortened by" : "tension",
      (double)(here->shortens ? here->shortening : here->force), scene->ramps[here->ramp].name));
    if (here->lock) PetscCall(PetscViewerASCIIPrintf(viewer, ", locked after load step %" PetscInt_FMT, here->lock));
    PetscCall(PetscViewerASCIIPrintf(viewer, "\n"));
  }
  PetscFunctionReturn(0);
}

/* Prints the velocities of a body at time 0, unless they are 0 */
PetscErrorCode SceneDescribeVelocity(const SceneBody *body, PetscViewer viewer)
{
  const PetscBool moves = (PetscBool)(VectorNorm(body->velocity) > 0.0),
                  turns = (PetscBool)(VectorNorm(body->spin) > 0.0);

  PetscFunctionBegin;
  if (moves) PetscCall(DescribeVector(viewer, "    initial velocity ", body->velocity));
  if (turns)
    PetscCall(DescribeVector(viewer, moves ? ", angular velocity " : "    initial angular velocity ", body->spin));
  if (moves || turns) PetscCall(PetscViewerASCIIPrintf(viewer, "\n"));
  PetscFunctionReturn(0);
}

PetscErrorCode SceneDescribeLoads(Scene scene, PetscViewer viewer)
{
  PetscFunctionBegin;
  PetscCall(PetscViewerASCIIPrintf(viewer, "Loads, at factor 1\n"));
  for (PetscInt d = 0; d < scene->ndisplacements; ++d)
    PetscCall(DescribeDisplacement(scene, &scene->displacements[d], viewer));
  for (PetscInt p = 0; p < scene->npressures; ++p) {
    const ScenePressure *here = &scene->pressures[p];

    PetscCall(PetscViewerASCIIPrintf(viewer, "  pressure %s: %s, %s%s", here->name, here->face, here->value,
      here->follows ? " on the deformed face" : ""));
    PetscCall(DescribeRamp(scene, here->ramp, viewer));
  }
  for (PetscInt t = 0; t < scene->ntractions; ++t) PetscCall(DescribeTraction(scene, &scene->tractions[t], viewer));
  PetscCall(DescribeJoints(scene, viewer));
  for (PetscInt f = 0; f < scene->nforces; ++f) {
    const SceneBodyForce *here = &scene->forces[f];

    PetscCall(PetscViewerASCIIPrintf(viewer, "  body force %s: %s", here->name,
      here->body < 0 ? "every body" : scene->bodies[here->body].name));
    PetscCall(DescribeVector(viewer, ", ", here->value));
    PetscCall(DescribeRamp(scene, here->ramp, viewer));
  }
  for (PetscInt t = 0; t < scene->ntemperatures; ++t) {
    const SceneTemperature *here = &scene->temperatures[t];

    PetscCall(PetscViewerASCIIPrintf(viewer, "  temperature %s: %s, %s", here->name,
      here->body < 0 ? "every body that expands" : scene->bodies[here->body].name, here->value));
    PetscCall(DescribeRamp(scene, here->ramp, viewer));
  }
  PetscFunctionReturn(0);
}
