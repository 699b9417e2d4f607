/* Rigid surfaces given by a formula: distance of a point, and the cube whose corners carry the rigid motion */
#include "modelimpl.h"
#include <vector3.h>

/* Unit vectors, the last one along the axis of the surface */
static void SurfaceFrame(const SceneBody *body, PetscReal frame[3][3])
{
  PetscInt least = 0;

  for (PetscInt c = 0; c < 3; ++c) frame[2][c] = body->own[SURFACE_AXIS + c];
  if (!(VectorScaleToUnit(frame[2]) > 0.0)) frame[2][2] = 1.0;
  for (PetscInt c = 1; c < 3; ++c) {
    if (PetscAbsReal(frame[2][c]) < PetscAbsReal(frame[2][least])) least = c;
  }
  for (PetscInt c = 0; c < 3; ++c) frame[0][c] = (c == least ? 1.0 : 0.0) - frame[2][least] * frame[2][c];
  (void)VectorScaleToUnit(frame[0]);
  VectorCross(frame[2], frame[0], frame[1]);
}

void SceneSurfaceGetCube(const SceneBody *body, SceneSurfaceCube *cube)
{
  const PetscReal radius = body->own[SURFACE_RADIUS], given = body->own[SURFACE_SIZE];
  PetscReal       middle = 0.0; /* of the cube, along the axis */

  SurfaceFrame(body, cube->edge);
  cube->size = given > 0.0 ? given : 1.0;
  if (body->shape == SHAPE_RIGID_SPHERE) cube->size = 2.0 * radius / PetscSqrtReal(3.0);
  if (body->shape == SHAPE_RIGID_CYLINDER) cube->size = PetscSqrtReal(2.0) * radius;
  if (body->shape == SHAPE_RIGID_TORUS) cube->size = body->own[SURFACE_SECTION];
  if (body->shape == SHAPE_RIGID_PLANE) middle = -0.5 * cube->size;
  if (body->shape == SHAPE_RIGID_CONE) middle = 1.5 * cube->size;
  for (PetscInt c = 0; c < 3; ++c) {
    cube->corner[c] = body->own[SURFACE_POINT + c] + middle * cube->edge[2][c];
    for (PetscInt i = 0; i < 3; ++i) cube->corner[c] -= 0.5 * cube->size * cube->edge[i][c];
  }
}

/* Distance and gradient in the half plane through the axis and a point: coordinates across and along the axis */
static PetscReal SurfaceProfile(const SceneBody *body, PetscReal across, PetscReal along, PetscReal slope[2])
{
  const PetscReal radius = body->own[SURFACE_RADIUS], angle = body->own[SURFACE_ANGLE] * PETSC_PI / 180.0;
  PetscReal       from = 0.0, length, less = 0.0; /* distance from a point across the axis, and what is taken off */

  slope[0] = slope[1] = 0.0;
  switch (body->shape) {
  case SHAPE_RIGID_PLANE: slope[1] = 1.0; return along;
  case SHAPE_RIGID_CYLINDER: slope[0] = 1.0; return across - radius;
  case SHAPE_RIGID_SPHERE: less = radius; break;
  case SHAPE_RIGID_TORUS:
    from = radius;
    less = body->own[SURFACE_SECTION];
    break;
  default: /* a cone, unless its tip is the nearest point */
    if (along * PetscCosReal(angle) + across * PetscSinReal(angle) < 0.0) break;
    slope[0] = PetscCosReal(angle);
    slope[1] = -PetscSinReal(angle);
    return across * slope[0] + along * slope[1];
  }
  length = PetscSqrtReal(PetscSqr(across - from) + PetscSqr(along));
  if (length > 0.0) {
    slope[0] = (across - from) / length;
    slope[1] = along / length;
  }
  return length - less;
}

PetscReal SceneSurfaceDistance(const SceneBody *body, const PetscReal x[3], PetscReal gradient[3])
{
  PetscReal frame[3][3], r[3], slope[2], distance, across, along;

  SurfaceFrame(body, frame);
  for (PetscInt c = 0; c < 3; ++c) r[c] = x[c] - body->own[SURFACE_POINT + c];
  along = VectorDot(r, frame[2]);
  for (PetscInt c = 0; c < 3; ++c) r[c] -= along * frame[2][c];
  across = VectorNorm(r);
  if (across <= PETSC_SQRT_MACHINE_EPSILON * PetscAbsReal(along)) across = 0.0;
  distance = SurfaceProfile(body, across, along, slope);
  for (PetscInt c = 0; c < 3; ++c)
    gradient[c] = slope[1] * frame[2][c] + (across > 0.0 ? slope[0] * r[c] / across : 0.0);
  return distance;
}
