/* Octant of a ball, or several octants in one grid: a core, which is the image of a cube, and three patches between the
   core and the sphere */
#include "shapesimpl.h"

static PetscErrorCode ShapeSize_Ball(MPI_Comm comm, const SceneBody *body, PetscInt64 *ncells, PetscInt64 *nvertices)
{
  PetscFunctionBegin;
  SceneCheck(body->octant.outer.radius > 0, comm, PETSC_ERR_ARG_OUTOFRANGE, body,
    "Body \"%s\": the radius of the ball must be positive, but is %g", body->name, (double)body->octant.outer.radius);
  PetscCall(OctantSize(comm, body, PETSC_TRUE, ncells, nvertices));
  PetscFunctionReturn(0);
}

static PetscErrorCode ShapeCreate_Ball(const SceneBody *body, ShapeGrid *grid)
{
  PetscFunctionBegin;
  PetscCall(OctantCreate(body, PETSC_TRUE, grid));
  PetscFunctionReturn(0);
}

/*
   Maps the unit cube by a trilinear map to the core of a ball of radius 1. The core's corners on an axis, in a
   coordinate plane and inside the octant are at 0.5, 0.6 and 0.62 of the radius. This keeps the angles of the cells
   away from 0 and 180 degrees.
*/
static void BallCore(const PetscReal p[3], PetscReal x[3])
{
  static const PetscReal component[4] = {0, 0.5, 0.424, 0.358}; /* the coordinates of a corner, indexed by the number
                                                                   of its coordinates that are not 0 */

  x[0] = x[1] = x[2] = 0;
  for (PetscInt corner = 0; corner < 8; ++corner) {
    const PetscInt at[3]  = {corner & 1, corner >> 1 & 1, corner >> 2};
    PetscReal      weight = 1;

    for (PetscInt d = 0; d < 3; ++d) weight *= at[d] ? PetscAbsReal(p[d]) : 1 - PetscAbsReal(p[d]);
    for (PetscInt d = 0; d < 3; ++d)
      x[d] += weight * component[at[0] + at[1] + at[2]] * (PetscReal)(p[d] < 0 ? -at[d] : at[d]);
  }
}

static PetscErrorCode ShapeMap_Ball(const SceneBody *body, const PetscReal p[3], PetscReal x[3])
{
  const PetscReal radius = body->octant.outer.radius;
  PetscReal       place[3];

  PetscFunctionBegin;
  if (PetscMax(PetscAbsReal(p[0]), PetscMax(PetscAbsReal(p[1]), PetscAbsReal(p[2]))) <= 1) BallCore(p, place);
  else {
    PetscReal q[3], s, direction[3];

    OctantSplit(p, q, &s);
    OctantDirection(q, direction);
    BallCore(q, place);
    for (PetscInt d = 0; d < 3; ++d) place[d] = (1 - s) * place[d] + s * direction[d];
  }
  for (PetscInt d = 0; d < 3; ++d) place[d] *= radius;
  OctantPlace(body, place, x);
  PetscFunctionReturn(0);
}

static const ShapeKey keys[] = {
  OCTANT_PLACE_KEYS,
  SHAPE_KEY("radius", KEY_REALS, 1, octant.outer.radius, PETSC_TRUE),
  OCTANT_GRID_KEYS,
  {NULL, KEY_REALS, 0, 0, PETSC_FALSE},
};

const Shape ShapeBall = {OctantFaces, ShapeSize_Ball, ShapeCreate_Ball, ShapeMap_Ball, keys, NULL};
