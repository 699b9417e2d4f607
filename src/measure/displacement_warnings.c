/* Names prescribed displacements that no body can follow, after a load step that failed. */
#include "measureimpl.h"
#include <vector3.h>

/* Collective. Gets the height along a direction, a unit vector, of the box of an undeformed body */
static PetscErrorCode DisplacementGetHeight(const Measured *at, const SceneBody *body, const PetscReal along[3],
  PetscReal *height)
{
  const PetscInt b = (PetscInt)(body - at->scene->bodies);
  PetscReal     *boxes;

  PetscFunctionBegin;
  PetscCall(PetscMalloc1(6 * at->scene->nbodies, &boxes));
  PetscCall(MeshGetBodyBoxes(at->dm, NULL, at->scene->nbodies, boxes));
  *height = 0.0;
  for (PetscInt i = 0; i < 3; ++i) *height += PetscAbsReal(along[i]) * (boxes[6 * b + 3 + i] - boxes[6 * b + i]);
  PetscCall(PetscFree(boxes));
  PetscFunctionReturn(0);
}

/* Warns of a displacement that is more than twice the height of an elastic body on which the displaced one presses */
static PetscErrorCode DisplacementTest(const Measured *at, const SceneDisplacement *here, const SceneBody *moved,
  const SceneBody *pressed, PetscReal time)
{
  PetscReal along[3], motion, factor, height = 0.0;

  PetscFunctionBegin;
  if (pressed == moved || pressed->material.type == MATERIAL_RIGID) PetscFunctionReturn(0);
  for (PetscInt i = 0; i < 3; ++i) along[i] = here->fixed[i] ? here->value[i] : 0.0;
  motion = VectorNorm(along);
  if (here->inclined || motion == 0.0) PetscFunctionReturn(0);
  for (PetscInt i = 0; i < 3; ++i) along[i] /= motion;
  PetscCall(SceneGetFactor(at->scene, here->ramp, time, &factor));
  PetscCall(DisplacementGetHeight(at, pressed, along, &height));
  motion *= PetscAbsReal(factor);
  if (motion > 2.0 * height)
    PetscCall(ReportWarn(at->comm, at->report, here->place,
      "displacement \"%s\" moves body \"%s\" by %.3g, %.2g times the height of body \"%s\", on which it presses: is it "
      "meant?",
      here->name, moved->name, (double)motion, (double)(motion / height), pressed->name));
  PetscFunctionReturn(0);
}

/* Collective. Warns of displacements much larger than the bodies that they press, if the load step has failed */
PetscErrorCode DisplacementWarn(Simulation sim, const StepReport *report)
{
  const Measured at    = SimulationMeasured(sim);
  Scene          scene = at.scene;

  PetscFunctionBegin;
  if (report->converged) PetscFunctionReturn(0);
  for (PetscInt d = 0; d < scene->ndisplacements; ++d) {
    const SceneDisplacement *here = &scene->displacements[d];
    const SceneBody         *moved =
      here->at == DISPLACEMENT_FACE ? SceneFaceBody(scene, here->face) : &scene->bodies[here->body];

    for (PetscInt p = 0; p < scene->npairs; ++p) {
      const SceneBody *sides[2] = {SceneFaceBody(scene, scene->pairs[p].mortar),
        SceneFaceBody(scene, scene->pairs[p].nonmortar)};

      for (PetscInt s = 0; s < 2; ++s) {
        if (sides[s] == moved) PetscCall(DisplacementTest(&at, here, moved, sides[1 - s], (PetscReal)report->step));
      }
    }
  }
  PetscFunctionReturn(0);
}
