/*
   Octant of a shell, or several octants in one grid, between two spheres that need not be concentric. A third sphere,
   the cap, may cut the outer surface. Each surface is intersected by rays from the octant's corner, so that points in
   coordinate planes stay there.
*/
#include "shapesimpl.h"

/* Returns the distance from the octant's corner, which is inside the sphere, to the sphere along a direction
   [length] */
static PetscReal SphereDistance(const SceneBody *body, const SceneSphere *sphere, const PetscReal direction[3])
{
  PetscReal along = 0, square = 0;

  for (PetscInt d = 0; d < 3; ++d) {
    const PetscReal c = (sphere->center[d] - body->octant.corner[d]) * (body->octant.signs[d] < 0 ? -1 : 1);

    along += c * direction[d];
    square += c * c;
  }
  return along + PetscSqrtReal(along * along + sphere->radius * sphere->radius - square);
}

/* Computes the distances from the octant's corner to the inner and to the outer surface along a direction [length] */
static void ShellDistances(const SceneBody *body, const PetscReal direction[3], PetscReal *inner, PetscReal *outer)
{
  *inner = SphereDistance(body, &body->octant.inner, direction);
  *outer = SphereDistance(body, &body->octant.outer, direction);
  if (body->octant.cap.radius > 0) *outer = PetscMin(*outer, SphereDistance(body, &body->octant.cap, direction));
}

/* Checks that the octant's corner is inside a sphere */
static PetscErrorCode ShellCheckCorner(MPI_Comm comm, const SceneBody *body, const char what[],
  const SceneSphere *sphere)
{
  PetscReal square = 0;

  PetscFunctionBegin;
  SceneCheck(sphere->radius > 0, comm, PETSC_ERR_ARG_OUTOFRANGE, body,
    "Body \"%s\": the radius of the %s sphere must be positive, but is %g", body->name, what, (double)sphere->radius);
  for (PetscInt d = 0; d < 3; ++d) square += PetscSqr(sphere->center[d] - body->octant.corner[d]);
  SceneCheck(square < PetscSqr(sphere->radius), comm, PETSC_ERR_ARG_OUTOFRANGE, body,
    "Body \"%s\": the octant's corner must lie inside of the %s sphere, but is %g away from its center, and the radius "
    "is %g",
    body->name, what, (double)PetscSqrtReal(square), (double)sphere->radius);
  PetscFunctionReturn(0);
}

static PetscErrorCode ShapeSize_SphereShell(MPI_Comm comm, const SceneBody *body, PetscInt64 *ncells,
  PetscInt64 *nvertices)
{
  const PetscInt samples = 8; /* number of test directions along an edge of the cube of parameters */

  PetscFunctionBegin;
  SceneCheck(body->octant.cap.radius >= 0, comm, PETSC_ERR_ARG_OUTOFRANGE, body,
    "Body \"%s\": the radius of the cap must be positive, or 0 for none, but is %g", body->name,
    (double)body->octant.cap.radius);
  PetscCall(ShellCheckCorner(comm, body, "inner", &body->octant.inner));
  PetscCall(ShellCheckCorner(comm, body, "outer", &body->octant.outer));
  if (body->octant.cap.radius > 0) PetscCall(ShellCheckCorner(comm, body, "cap", &body->octant.cap));
  for (PetscInt i = 0; i < 8 * 3 * PetscSqr(samples + 1); ++i) {
    const PetscInt column = i / 24 % (samples + 1), row = i / 24 / (samples + 1), side = i / 3 % 8;
    PetscReal      q[3], direction[3], inner, outer;

    q[i % 3]       = 1;
    q[(i + 1) % 3] = (PetscReal)column / samples;
    q[(i + 2) % 3] = (PetscReal)row / samples;
    for (PetscInt d = 0; d < 3; ++d) q[d] *= body->octant.signs[d] == OCTANT_BOTH && side >> d & 1 ? -1 : 1;
    OctantDirection(q, direction);
    ShellDistances(body, direction, &inner, &outer);
    SceneCheck(inner < outer, comm, PETSC_ERR_ARG_OUTOFRANGE, body,
      "Body \"%s\": the inner surface must lie inside of the outer one, but in the direction (%g, %g, %g) they are %g "
      "and %g away from the corner",
      body->name, (double)direction[0], (double)direction[1], (double)direction[2], (double)inner, (double)outer);
  }
  PetscCall(OctantSize(comm, body, PETSC_FALSE, ncells, nvertices));
  PetscFunctionReturn(0);
}

static PetscErrorCode ShapeMap_SphereShell(const SceneBody *body, const PetscReal p[3], PetscReal x[3])
{
  PetscReal q[3], s, direction[3], inner, outer, place[3];

  PetscFunctionBegin;
  OctantSplit(p, q, &s);
  OctantDirection(q, direction);
  ShellDistances(body, direction, &inner, &outer);
  for (PetscInt d = 0; d < 3; ++d) place[d] = ((1 - s) * inner + s * outer) * direction[d];
  OctantPlace(body, place, x);
  PetscFunctionReturn(0);
}

static const ShapeKey keys[] = {
  OCTANT_PLACE_KEYS,
  SHAPE_KEY("inner_radius", KEY_REALS, 1, octant.inner.radius, PETSC_TRUE),
  SHAPE_KEY("inner_center", KEY_REALS, 3, octant.inner.center, PETSC_FALSE),
  SHAPE_KEY("outer_radius", KEY_REALS, 1, octant.outer.radius, PETSC_TRUE),
  SHAPE_KEY("outer_center", KEY_REALS, 3, octant.outer.center, PETSC_FALSE),
  SHAPE_KEY("cap_radius", KEY_REALS, 1, octant.cap.radius, PETSC_FALSE),
  SHAPE_KEY("cap_center", KEY_REALS, 3, octant.cap.center, PETSC_FALSE),
  OCTANT_GRID_KEYS,
  {NULL, KEY_REALS, 0, 0, PETSC_FALSE},
};

const Shape ShapeSphereShell = {OctantFaces, ShapeSize_SphereShell, OctantCreateShell, ShapeMap_SphereShell, keys,
  NULL};
