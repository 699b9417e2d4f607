/* Octant of a shell, or several octants in one grid, between two ellipsoids that are centred at its corner */
#include "shapesimpl.h"

static PetscErrorCode ShapeSize_SpheroidShell(MPI_Comm comm, const SceneBody *body, PetscInt64 *ncells,
  PetscInt64 *nvertices)
{
  PetscFunctionBegin;
  for (PetscInt d = 0; d < 3; ++d) {
    const PetscReal inner = body->octant.inner_axes[d], outer = body->octant.outer_axes[d];

    SceneCheck(inner > 0 && inner < outer, comm, PETSC_ERR_ARG_OUTOFRANGE, body,
      "Body \"%s\": the semi-axes must be 0 < inner < outer, but along %c they are %g and %g", body->name, "xyz"[d],
      (double)inner, (double)outer);
  }
  PetscCall(OctantSize(comm, body, PETSC_FALSE, ncells, nvertices));
  PetscFunctionReturn(0);
}

static PetscErrorCode ShapeMap_SpheroidShell(const SceneBody *body, const PetscReal p[3], PetscReal x[3])
{
  PetscReal q[3], s, direction[3], place[3];

  PetscFunctionBegin;
  OctantSplit(p, q, &s);
  OctantDirection(q, direction);
  for (PetscInt d = 0; d < 3; ++d)
    place[d] = ((1 - s) * body->octant.inner_axes[d] + s * body->octant.outer_axes[d]) * direction[d];
  OctantPlace(body, place, x);
  PetscFunctionReturn(0);
}

static const ShapeKey keys[] = {
  OCTANT_PLACE_KEYS,
  SHAPE_KEY("inner_semi_axes", KEY_REALS, 3, octant.inner_axes, PETSC_TRUE),
  SHAPE_KEY("outer_semi_axes", KEY_REALS, 3, octant.outer_axes, PETSC_TRUE),
  OCTANT_GRID_KEYS,
  {NULL, KEY_REALS, 0, 0, PETSC_FALSE},
};

const Shape ShapeSpheroidShell = {OctantFaces, ShapeSize_SpheroidShell, OctantCreateShell, ShapeMap_SpheroidShell, keys,
  NULL};
