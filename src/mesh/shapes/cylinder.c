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

/* Computes the lattice point of the core that is i steps along a side */
static void CylinderSide(PetscInt n, PetscInt side, PetscInt i, PetscInt at[2])
{
  at[0] = side == 0 ? n : side == 1 ? n - i : side == 2 ? 0 : i;
  at[1] = side == 0 ? i : side == 1 ? n : side == 2 ? n - i : 0;
}

/* The vertex (a, b) of the core */
static PetscInt CylinderCoreVertex(const SceneBody *body, PETSC_UNUSED const void *context, PetscInt a, PetscInt b,
  PetscInt k, PetscReal p[3])
{
  const PetscInt *n = body->cells;

  if (p) {
    p[0] = -1 + 2 * (PetscReal)a / (PetscReal)n[0];
    p[1] = -1 + 2 * (PetscReal)b / (PetscReal)n[0];
    p[2] = ShapeBetween(body, 2, k, body->tube.extent[0], body->tube.extent[1]);
  }
  return a + (n[0] + 1) * b + k * (CylinderCore(n) + 4 * n[0] * n[1]);
}

/* The vertex that is i steps along a side, in a layer (0: on the core's side) of cross-section k */
static PetscInt CylinderPatchVertex(const SceneBody *body, const void *context, PetscInt layer, PetscInt i, PetscInt k,
  PetscReal p[3])
{
  const PetscInt *n = body->cells, side = *(const PetscInt *)context;
  const PetscReal m = p ? 1 + ShapeBetween(body, 1, layer, 0, 1) : 0;
  PetscInt        at[2], core;

  CylinderSide(n[0], side, i, at);
  core = CylinderCoreVertex(body, NULL, at[0], at[1], k, p);
  for (PetscInt c = 0; p && c < 2; ++c) p[c] *= m;
  if (!layer) return core;
  return k * (CylinderCore(n) + 4 * n[0] * n[1]) + CylinderCore(n) + (layer - 1) * 4 * n[0] +
         (side * n[0] + i) % (4 * n[0]);
}

static PetscErrorCode ShapeCreate_Cylinder(const SceneBody *body, ShapeGrid *grid)
{
  static const PetscInt sides[4] = {0, 1, 2, 3}; /* of the core, counterclockwise from a = 1 */
  const PetscInt       *n        = body->cells;
  ShapeBlock            blocks[5];

  PetscFunctionBegin;
  for (PetscInt side = 0; side < 4; ++side)
    blocks[side] = (ShapeBlock){{n[1], n[0], n[2]}, {PETSC_DECIDE, 0, PETSC_DECIDE, PETSC_DECIDE, 1, 2}, &sides[side],
      CylinderPatchVertex};
  blocks[4] = (ShapeBlock){{n[0], n[0], n[2]}, {PETSC_DECIDE, PETSC_DECIDE, PETSC_DECIDE, PETSC_DECIDE, 1, 2}, NULL,
    CylinderCoreVertex};
  PetscCall(ShapeGridCreate(body, 5, blocks, (CylinderCore(n) + 4 * n[0] * n[1]) * (n[2] + 1), PETSC_FALSE, grid));
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
