/*
   Arc of a tube, or a whole tube. The parameters of an arc are the distance from the axis, the angle about the axis,
   and the position along it. For a whole tube the first two parameters are coordinates in the plane of the
   cross-section, in which the cells are straight: circles become regular polygons with a corner at each vertex.
*/
#include "shapesimpl.h"

static PetscBool TubeIsWhole(const SceneBody *body)
{
  return (PetscBool)(body->tube.angles[1] - body->tube.angles[0] == 360);
}

static const char *const *ShapeFaces_TubeArc(const SceneBody *body)
{
  static const char *const arc[]   = {"inner", "outer", "amin", "amax", "lmin", "lmax", NULL};
  static const char *const whole[] = {"inner", "outer", "lmin", "lmax", NULL};

  return TubeIsWhole(body) ? whole : arc;
}

static PetscErrorCode ShapeSize_TubeArc(MPI_Comm comm, const SceneBody *body, PetscInt64 *ncells, PetscInt64 *nvertices)
{
  const SceneTubeArc *tube  = &body->tube;
  const PetscInt     *n     = body->cells;
  const PetscReal     angle = tube->angles[1] - tube->angles[0];

  PetscFunctionBegin;
  SceneCheck(tube->axis >= 0 && tube->axis < 3, comm, PETSC_ERR_ARG_OUTOFRANGE, body,
    "Body \"%s\": the axis of the tube must be 0, 1 or 2, but is %" PetscInt_FMT, body->name, tube->axis);
  SceneCheck(tube->radii[0] > 0 && tube->radii[0] < tube->radii[1], comm, PETSC_ERR_ARG_OUTOFRANGE, body,
    "Body \"%s\": the radii of the tube must be 0 < inner < outer, but are %g and %g", body->name,
    (double)tube->radii[0], (double)tube->radii[1]);
  SceneCheck(angle > 0 && angle <= 360, comm, PETSC_ERR_ARG_OUTOFRANGE, body,
    "Body \"%s\": the arc must be more than 0 and at most 360 degrees, but goes from %g to %g", body->name,
    (double)tube->angles[0], (double)tube->angles[1]);
  SceneCheck(tube->extent[0] < tube->extent[1], comm, PETSC_ERR_ARG_OUTOFRANGE, body,
    "Body \"%s\": the extent along the axis must have from < to, but they are %g and %g", body->name,
    (double)tube->extent[0], (double)tube->extent[1]);
  PetscCall(ShapeCheckCount(comm, body, "radially", n[0]));
  PetscCall(ShapeCheckCount(comm, body, "around the axis", n[1]));
  PetscCall(ShapeCheckCount(comm, body, "along the axis", n[2]));
  for (PetscInt d = 0; d < 3; ++d) PetscCall(ShapeCheckGrading(comm, body, body->grading[d], body->even[d], n[d]));
  SceneCheck(angle < 360 || body->grading[1] == 0 || body->grading[1] == 1, comm, PETSC_ERR_ARG_OUTOFRANGE, body,
    "Body \"%s\": the cells around a whole tube are equal, so its grading around the axis must be 1, but is %g",
    body->name, (double)body->grading[1]);
  SceneCheck(angle / (PetscReal)n[1] < 120, comm, PETSC_ERR_ARG_OUTOFRANGE, body,
    "Body \"%s\": a cell around the axis must have less than 120 degrees, but the arc has %g degrees and its number of "
    "cells is %" PetscInt_FMT,
    body->name, (double)angle, n[1]);
  PetscCall(ShapeCheckTotal(comm, body, ((PetscReal)n[0] + 1) * ((PetscReal)n[1] + 1) * ((PetscReal)n[2] + 1)));
  *ncells    = (PetscInt64)n[0] * n[1] * n[2];
  *nvertices = (PetscInt64)(n[0] + 1) * (TubeIsWhole(body) ? n[1] : n[1] + 1) * (n[2] + 1);
  PetscFunctionReturn(0);
}

/* Converts radius and angle [degrees] of a vertex of a whole tube into coordinates in the plane */
static void TubeToPolygon(PetscReal p[2])
{
  const PetscReal radius = p[0], angle = p[1] * PETSC_PI / 180;

  p[0] = radius * PetscCosReal(angle);
  p[1] = radius * PetscSinReal(angle);
}

/* Converts a point on a regular polygon into radius and angle [degrees]. Along a side of the polygon the angle is
   linear. */
static void TubeFromPolygon(const SceneBody *body, const PetscReal place[2], PetscReal p[2])
{
  const PetscReal step = 2 * PETSC_PI / (PetscReal)body->cells[1], first = body->tube.angles[0] * PETSC_PI / 180;
  const PetscReal angle  = PetscAtan2Real(place[1], place[0]) - first;
  const PetscReal middle = (PetscFloorReal(angle / step) + 0.5) * step, off = angle - middle;

  p[0] = PetscSqrtReal(PetscSqr(place[0]) + PetscSqr(place[1])) * PetscCosReal(off) / PetscCosReal(0.5 * step);
  p[1] = (first + middle + 0.5 * step * PetscTanReal(off) / PetscTanReal(0.5 * step)) * 180 / PETSC_PI;
}

static PetscInt TubeVertex(const SceneBody *body, PETSC_UNUSED const void *context, PetscInt i, PetscInt j, PetscInt k,
  PetscReal p[3])
{
  const PetscReal *range[3] = {body->tube.radii, body->tube.angles, body->tube.extent};
  const PetscBool  whole    = TubeIsWhole(body);
  const PetscInt  *n = body->cells, around = whole ? n[1] : n[1] + 1, index[3] = {i, j % around, k};

  for (PetscInt d = 0; p && d < 3; ++d) p[d] = ShapeBetween(body, d, index[d], range[d][0], range[d][1]);
  if (p && whole) TubeToPolygon(p);
  return i + (n[0] + 1) * (j % around + around * k);
}

static PetscErrorCode ShapeCreate_TubeArc(const SceneBody *body, ShapeGrid *grid)
{
  const PetscInt  *n     = body->cells;
  const PetscBool  whole = TubeIsWhole(body);
  const ShapeBlock block = {{n[0], n[1], n[2]},
    {0, 1, whole ? PETSC_DECIDE : 2, whole ? PETSC_DECIDE : 3, whole ? 2 : 4, whole ? 3 : 5}, NULL, TubeVertex};

  PetscFunctionBegin;
  PetscCall(ShapeGridCreate(body, 1, &block, (n[0] + 1) * (whole ? n[1] : n[1] + 1) * (n[2] + 1), PETSC_FALSE, grid));
  PetscFunctionReturn(0);
}

static PetscErrorCode ShapeMap_TubeArc(const SceneBody *body, const PetscReal p[3], PetscReal x[3])
{
  const PetscInt axis = body->tube.axis, s = (axis + 1) % 3, t = (axis + 2) % 3;
  PetscReal      radius = p[0], angle = p[1] * PETSC_PI / 180, along = p[2], polar[2];

  PetscFunctionBegin;
  if (TubeIsWhole(body)) {
    TubeFromPolygon(body, p, polar);
    radius = polar[0];
    angle  = polar[1] * PETSC_PI / 180;
  }
  x[axis] = along;
  x[s]    = body->tube.center[s] + radius * PetscCosReal(angle);
  x[t]    = body->tube.center[t] + radius * PetscSinReal(angle);
  PetscFunctionReturn(0);
}

static const ShapeKey keys[] = {
  SHAPE_KEY("axis", KEY_AXIS, 1, tube.axis, PETSC_TRUE),
  SHAPE_KEY("center", KEY_REALS, 3, tube.center, PETSC_FALSE),
  SHAPE_KEY("radii", KEY_REALS, 2, tube.radii, PETSC_TRUE),
  SHAPE_KEY("angles", KEY_REALS, 2, tube.angles, PETSC_TRUE),
  SHAPE_KEY("extent", KEY_REALS, 2, tube.extent, PETSC_TRUE),
  SHAPE_KEY("cells", KEY_INTS, 3, cells, PETSC_TRUE),
  SHAPE_KEY("grading", KEY_REALS, 3, grading, PETSC_FALSE),
  SHAPE_KEY("even", KEY_INTS, 3, even, PETSC_FALSE),
  {NULL, KEY_REALS, 0, 0, PETSC_FALSE},
};

const Shape ShapeTubeArc = {ShapeFaces_TubeArc, ShapeSize_TubeArc, ShapeCreate_TubeArc, ShapeMap_TubeArc, keys, NULL};
