/* Computes the positions of rigid bodies and their rotations since the start */
#include "measureimpl.h"
#include <vector3.h>

static PetscBool RigidPlacesHas(Scene scene, PetscInt body)
{
  return (PetscBool)(scene->bodies[body].material.type == MATERIAL_RIGID);
}

/*
   Changes a rotation vector [degrees] by whole turns about its axis, which mean the same rotation, such that it is
   nearest to that of the last state
*/
static void RigidPlacesUnwind(const PetscReal before[3], PetscReal rotation[3])
{
  const PetscReal turn = 360.0;
  PetscReal       size = 0.0, along = 0.0, axis[3];

  for (PetscInt i = 0; i < 3; ++i) size += PetscSqr(rotation[i]);
  size = PetscSqrtReal(size);
  if (size == 0.0) return;
  for (PetscInt i = 0; i < 3; ++i) axis[i] = rotation[i] / size;
  for (PetscInt i = 0; i < 3; ++i) along += axis[i] * before[i];
  size += turn * PetscFloorReal((along - size) / turn + 0.5);
  for (PetscInt i = 0; i < 3; ++i) rotation[i] = size * axis[i];
}

/*
   Returns the point of a body whose position is reported: the centre of rotation that the scene gives; otherwise the
   reference point of a rigid surface; otherwise the middle of the body
*/
static const PetscReal *RigidPlacesFindPoint(Scene scene, PetscInt body, const BodyPose *pose)
{
  const PetscReal *center = PoseFindCenter(scene, body);

  if (center) return center;
  return SceneBodyIsSurface(&scene->bodies[body]) ? scene->bodies[body].own + SURFACE_POINT : pose->from;
}

/* Reports the displacement of the point `from` of a rigid surface, whose mesh is only a box around it */
static void RigidPlacesReport(const PetscReal from[3], const PetscReal position[3], BodyReport *report)
{
  PetscReal moved[3];

  for (PetscInt i = 0; i < 3; ++i) {
    moved[i]                      = position[i] - from[i];
    report->displacement_place[i] = from[i];
  }
  report->displacement = VectorNorm(moved);
}

/* Computes positions and rotations at the last state */
PetscErrorCode RigidPlacesMeasure(Simulation sim, StepReport *report)
{
  const Bodies       bodies  = ModelBodies(sim->model);
  const RigidReport *before  = report > sim->report.steps ? report[-1].rigid_bodies : NULL;
  const PetscReal    none[3] = {0.0, 0.0, 0.0};
  BodyPose          *poses;
  PetscInt           n = 0;

  PetscFunctionBegin;
  for (PetscInt b = 0; b < sim->model->scene->nbodies; ++b) n += RigidPlacesHas(sim->model->scene, b);
  PetscCall(PetscFree(report->rigid_bodies));
  report->nrigid_bodies = n;
  if (!n) PetscFunctionReturn(0);
  PetscCall(PetscMalloc1(n, &report->rigid_bodies));
  PetscCall(PetscMalloc1(sim->model->scene->nbodies, &poses));
  PetscCall(PosesFind(&bodies, NULL, sim->state->path->u, poses));
  n = 0;
  for (PetscInt b = 0; b < sim->model->scene->nbodies; ++b) {
    RigidReport     *body = &report->rigid_bodies[n];
    const PetscReal *from = RigidPlacesFindPoint(sim->model->scene, b, &poses[b]);

    if (!RigidPlacesHas(sim->model->scene, b)) continue;
    *body = (RigidReport){.name = sim->model->scene->bodies[b].name};
    PosePlace(&poses[b], from, body->position);
    PoseGetVector((const PetscReal(*)[3])poses[b].Q, body->rotation);
    for (PetscInt i = 0; i < 3; ++i) body->rotation[i] *= 180.0 / PETSC_PI;
    RigidPlacesUnwind(before ? before[n].rotation : none, body->rotation);
    if (report->nbodies && SceneBodyIsSurface(&sim->model->scene->bodies[b]))
      RigidPlacesReport(from, body->position, &report->bodies[b]);
    ++n;
  }
  PetscCall(PetscFree(poses));
  PetscFunctionReturn(0);
}
