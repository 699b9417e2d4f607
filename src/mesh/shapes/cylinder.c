/*
   Cylinder, and cone without its tip: a square core around the axis, and four patches between the core and the surface.
   The parameters are a point (a, b) of a square with -2 <= a, b <= 2, and the coordinate along the axis. The core is
   the part with m = max(|a|, |b|) <= 1. A point outside of the core lies in the direction (a, b)/m, and m - 1 is the
   fraction of the distance from the core to the surface.
*/
#include "shapesimpl.h"

#define CYLINDER_CORE 0.45 /* half the width of the core, relative to the radius */

static const char *const faces[] = {"surface", "lmin", "lmax", NULL};

/* Returns the number of vertices of the core in one cross-section. A layer around the core has 4 n[0] vertices. */
static PetscInt CylinderCore(const PetscInt n[3])
{
  return (n[0] + 1) * (n[0] + 1);
}

static PetscErrorCode ShapeSize_Cylinder(MPI_Comm comm, const SceneBody *body, PetscInt64 *ncells,
  PetscInt64 *nvertices)
{
  const SceneTubeArc *tube = &body->tube;
  const PetscInt     *n    = body->cells;

  PetscFunctionBegin;
  SceneCheck(tube->radii[1] > 0, comm, PETSC_ERR_ARG_OUTOFRANGE, body,
    "Body \"%s\": the radius of the %s must be positive, but is %g%s", body->name,
    body->shape == SHAPE_CONE ? "cone" : "cylinder", (double)tube->radii[1],
    body->shape == SHAPE_CONE ? ": use a cone without its tip" : "");
  SceneCheck(tube->radii[0] > 0 || body->shape != SHAPE_CONE, comm, PETSC_ERR_ARG_OUTOFRANGE, body,
    "Body \"%s\": the radius of the cone must be positive, but is %g: use a cone without its tip", body->name,
    (double)tube->radii[0]);
  SceneCheck(tube->extent[0] < tube->extent[1], comm, PETSC_ERR_ARG_OUTOFRANGE, body,
    "Body \"%s\": the extent along the axis must have from < to, but they are %g and %g", body->name,
    (double)tube->extent[0], (double)tube->extent[1]);
  PetscCall(ShapeCheckCount(comm, body, "across the core", n[0]));
  PetscCall(ShapeCheckCount(comm, body, "from the core to the surface", n[1]));
  PetscCall(ShapeCheckCount(comm, body, "along the axis", n[2]));
  for (PetscInt d = 0; d < 3; ++d) PetscCall(ShapeCheckGrading(comm, body, body->grading[d], body->even[d], n[d]));
  SceneCheck(body->grading[0] == 0 || body->grading[0] == 1, comm, PETSC_ERR_ARG_OUTOFRANGE, body,
    "Body \"%s\": the cells of the core are equal, so its grading must be 1, but is %g", body->name,
    (double)body->grading[0]);
  PetscCall(ShapeCheckTotal(comm, body,
    ((PetscReal)CylinderCore(n) + 4 * (PetscReal)n[0] * (PetscReal)n[1]) * ((PetscReal)n[2] + 1)));
  *ncells    = (PetscInt64)n[0] * (n[0] + 4 * n[1]) * n[2];
  *nvertices = ((PetscInt64)CylinderCore(n) + (PetscInt64)4 * n[0] * n[1]) * (n[2] + 1);
  PetscFunctionReturn(0);
}

typedef struct {
  const PetscInt *n;
  PetscInt        side; /* number of the core's side, counterclockwise from 0 at a = 1 */
} CylinderPatch;

/* Computes the lattice point of the core that is i steps along a side */
static void CylinderSide(PetscInt n, PetscInt side, PetscInt i, PetscInt at[2])
{
  at[0] = side == 0 ? n : side == 1 ? n - i : side == 2 ? 0 : i;
  at[1] = side == 0 ? i : side == 1 ? n : side == 2 ? n - i : 0;
}

/* Returns the number of the vertex that is i steps along a side, in a layer (0: on the core's side) of cross-section
   k */
static PetscInt CylinderVertex(const PetscInt n[3], PetscInt layer, PetscInt side, PetscInt i, PetscInt k)
{
  const PetscInt plane = k * (CylinderCore(n) + 4 * n[0] * n[1]);
  PetscInt       at[2];

  if (layer) return plane + CylinderCore(n) + (layer - 1) * 4 * n[0] + (side * n[0] + i) % (4 * n[0]);
  CylinderSide(n[0], side, i, at);
  return plane + at[0] + (n[0] + 1) * at[1];
}

static PetscInt CylinderPatchVertex(const void *context, PetscInt layer, PetscInt i, PetscInt k)
{
  const CylinderPatch *patch = (const CylinderPatch *)context;

  return CylinderVertex(patch->n, layer, patch->side, i, k);
}

static PetscInt CylinderCoreVertex(const void *context, PetscInt i, PetscInt j, PetscInt k)
{
  const PetscInt *n = ((const CylinderPatch *)context)->n;

  return i + (n[0] + 1) * j + k * (CylinderCore(n) + 4 * n[0] * n[1]);
}

/* Computes the parameters of all vertices */
static void CylinderPlace(const SceneBody *body, PetscReal x[])
{
  const PetscInt *n = body->cells;

  for (PetscInt k = 0; k <= n[2]; ++k) {
    const PetscReal part  = ShapeGraded(body->grading[2], body->even[2], n[2], k);
    const PetscReal along = (1 - part) * body->tube.extent[0] + part * body->tube.extent[1];

    for (PetscInt i = 0; i < CylinderCore(n); ++i, x += 3) {
      x[0] = -1 + 2 * (PetscReal)(i % (n[0] + 1)) / (PetscReal)n[0];
      x[1] = -1 + 2 * (PetscReal)(i / (n[0] + 1)) / (PetscReal)n[0];
      x[2] = along;
    }
    for (PetscInt i = 0; i < 4 * n[0] * n[1]; ++i, x += 3) {
      const PetscReal m = 1 + ShapeGraded(body->grading[1], body->even[1], n[1], i / (4 * n[0]) + 1);
      PetscInt        at[2];

      CylinderSide(n[0], i % (4 * n[0]) / n[0], i % n[0], at);
      for (PetscInt c = 0; c < 2; ++c) x[c] = m * (-1 + 2 * (PetscReal)at[c] / (PetscReal)n[0]);
      x[2] = along;
    }
  }
}

static PetscErrorCode ShapeCreate_Cylinder(const SceneBody *body, ShapeGrid *grid)
{
  const PetscInt *n = body->cells, nvertices = (CylinderCore(n) + 4 * n[0] * n[1]) * (n[2] + 1);
  ShapeBlock      blocks[5];
  CylinderPatch   patches[4];

  PetscFunctionBegin;
  for (PetscInt side = 0; side < 4; ++side) {
    patches[side] = (CylinderPatch){n, side};
    blocks[side] = (ShapeBlock){{n[1], n[0], n[2]}, {PETSC_DECIDE, 0, PETSC_DECIDE, PETSC_DECIDE, 1, 2}, &patches[side],
      CylinderPatchVertex};
  }
  blocks[4] = (ShapeBlock){{n[0], n[0], n[2]}, {PETSC_DECIDE, PETSC_DECIDE, PETSC_DECIDE, PETSC_DECIDE, 1, 2},
    &patches[0], CylinderCoreVertex};
  PetscCall(ShapeGridCreate(5, blocks, nvertices, PETSC_FALSE, grid));
  CylinderPlace(body, grid->coordinates);
  PetscFunctionReturn(0);
}

static PetscErrorCode ShapeMap_Cylinder(const SceneBody *body, const PetscReal p[3], PetscReal x[3])
{
  const PetscInt  axis = body->tube.axis, s = (axis + 1) % 3, t = (axis + 2) % 3;
  const PetscReal m = PetscMax(PetscAbsReal(p[0]), PetscAbsReal(p[1])), along = p[2];
  const PetscReal part = (along - body->tube.extent[0]) / (body->tube.extent[1] - body->tube.extent[0]);
  const PetscReal radius =
    body->shape == SHAPE_CONE ? (1 - part) * body->tube.radii[0] + part * body->tube.radii[1] : body->tube.radii[1];
  PetscReal place[2] = {CYLINDER_CORE * p[0], CYLINDER_CORE * p[1]}, circle[2];

  PetscFunctionBegin;
  if (m > 1) {
    ShapeCircle(p, circle);
    for (PetscInt c = 0; c < 2; ++c) place[c] = (2 - m) * place[c] / m + (m - 1) * circle[c];
  }
  x[axis] = along;
  x[s]    = body->tube.center[s] + radius * place[0];
  x[t]    = body->tube.center[t] + radius * place[1];
  PetscFunctionReturn(0);
}

#define CYLINDER_PLACE_KEYS \
  SHAPE_KEY("axis", KEY_AXIS, 1, tube.axis, PETSC_TRUE), SHAPE_KEY("center", KEY_REALS, 3, tube.center, PETSC_FALSE)
#define CYLINDER_GRID_KEYS \
  SHAPE_KEY("extent", KEY_REALS, 2, tube.extent, PETSC_TRUE), SHAPE_KEY("cells", KEY_INTS, 3, cells, PETSC_TRUE), \
    SHAPE_KEY("grading", KEY_REALS, 3, grading, PETSC_FALSE), SHAPE_KEY("even", KEY_INTS, 3, even, PETSC_FALSE)

static const ShapeKey cylinder_keys[] = {
  CYLINDER_PLACE_KEYS,
  SHAPE_KEY("radius", KEY_REALS, 1, tube.radii[1], PETSC_TRUE),
  CYLINDER_GRID_KEYS,
  {NULL, KEY_REALS, 0, 0, PETSC_FALSE},
};
static const ShapeKey cone_keys[] = {
  CYLINDER_PLACE_KEYS,
  SHAPE_KEY("radii", KEY_REALS, 2, tube.radii, PETSC_TRUE),
  CYLINDER_GRID_KEYS,
  {NULL, KEY_REALS, 0, 0, PETSC_FALSE},
};

const Shape ShapeCylinder = {NULL, ShapeSize_Cylinder, ShapeCreate_Cylinder, ShapeMap_Cylinder, cylinder_keys, faces};
const Shape ShapeCone     = {NULL, ShapeSize_Cylinder, ShapeCreate_Cylinder, ShapeMap_Cylinder, cone_keys, faces};
