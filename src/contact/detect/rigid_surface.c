/* Rigid surfaces without facets, at one time of the load program */
#include "detectimpl.h"

PetscBool DetectFacesRigidSurface(const DetectState *state, PetscInt tool, const PetscReal x[3],
  const PetscReal normal[3], PetscReal *distance)
{
  const MeshSurfaces *s    = &state->model->surfaces;
  const PetscInt      body = s->body[s->surface[state->model->tool[tool]]];
  const DetectMove   *move = &state->moves[body];
  DetectMove          back = {.rotation = {-move->rotation[0], -move->rotation[1], -move->rotation[2]}};
  PetscReal           there[3], along[3], gradient[3];

  DetectMovePoints(&back, 1, normal, along); /* The normal and the point are moved to the undeformed position of the
                                                rigid body. */
  for (PetscInt c = 0; c < 3; ++c) {
    back.center[c] = move->center[c] + move->shift[c];
    back.shift[c]  = -move->shift[c];
  }
  DetectMovePoints(&back, 1, x, there);
  *distance = SceneSurfaceDistance(&state->model->bodies[body], there, gradient);
  return (PetscBool)(VectorDot(along, gradient) <= CONTACT_NORMAL_COSINE);
}
