/*
   Prism over a half or a quarter of an ellipse: an O-grid of a core and a ring, extruded along the axis. The parameters
   are u along the depth, v across it, and w from 0 to 1 along the axis. The core is [0, 1] x [-1, 1], or [0, 1]^2 for a
   quarter. A point outside of the core lies in the direction q = (u, v)/m, with m = max(u, |v|), on the core's outline.
   s = m - 1 runs from 0 on the outline to 1 on the arc. The position on the arc is linear in arc length along q.
*/
#include "shapesimpl.h"

typedef struct {
  PetscInt core[2], ring, length; /* numbers of cells: of the core along the depth and across one half, of the ring,
                                     and along the axis */
  PetscInt middle;                /* index, across, of the vertices on the plane of symmetry */
  PetscInt nring, nsection;       /* numbers of vertices on the core's outline and in the cross-section */
} HalfEllipse;

enum { ELLIPSE_FLAT, ELLIPSE_ARC, ELLIPSE_LMIN, ELLIPSE_LMAX, ELLIPSE_SYMMETRY };

static const char *const *ShapeFaces_HalfEllipse(const SceneBody *body)
{
  static const char *const both[]    = {"flat", "arc", "lmin", "lmax", NULL};
  static const char *const quarter[] = {"flat", "arc", "lmin", "lmax", "symmetry", NULL};

  return body->ellipse.half < 0 ? both : quarter;
}

static void EllipseSetUp(const SceneBody *body, HalfEllipse *e)
{
  const PetscInt halves = body->ellipse.half < 0 ? 2 : 1;

  e->core[0]  = body->cells[0];
  e->core[1]  = body->cells[1];
  e->ring     = body->cells[2];
  e->length   = body->layers;
  e->middle   = halves == 2 ? e->core[1] : 0;
  e->nring    = halves * (e->core[0] + e->core[1]) + 1;
  e->nsection = (e->core[0] + 1) * (halves * e->core[1] + 1) + e->ring * e->nring;
}

static PetscErrorCode ShapeSize_HalfEllipse(MPI_Comm comm, const SceneBody *body, PetscInt64 *ncells,
  PetscInt64 *nvertices)
{
  const SceneHalfEllipse *ellipse = &body->ellipse;
  const char *const       what[3] = {"of the core along its depth (patches)", "of the core across one half (patches)",
          "across the ring (patches)"};
  const PetscReal         halves  = ellipse->half < 0 ? 2 : 1;
  HalfEllipse             e;

  PetscFunctionBegin;
  SceneCheck(ellipse->axis >= 0 && ellipse->axis < 3 && ellipse->depth >= 0 && ellipse->depth < 6 && ellipse->half < 6,
    comm, PETSC_ERR_ARG_OUTOFRANGE, body,
    "Body \"%s\": one of the keys axis, depth and half is not a direction such as x or -x", body->name);
  SceneCheck(ellipse->depth % 3 != ellipse->axis, comm, PETSC_ERR_ARG_OUTOFRANGE, body,
    "Body \"%s\": the keys depth and axis both have the direction %c, but must be perpendicular", body->name,
    "xyz"[ellipse->axis]);
  SceneCheck(ellipse->half < 0 || (ellipse->half % 3 != ellipse->axis && ellipse->half % 3 != ellipse->depth % 3), comm,
    PETSC_ERR_ARG_OUTOFRANGE, body,
    "Body \"%s\": the direction of the key half must be perpendicular to those of the keys axis and depth", body->name);
  SceneCheck(ellipse->semi_axes[0] > 0 && ellipse->semi_axes[1] > 0, comm, PETSC_ERR_ARG_OUTOFRANGE, body,
    "Body \"%s\": the semi-axes must be positive, but are %g and %g", body->name, (double)ellipse->semi_axes[0],
    (double)ellipse->semi_axes[1]);
  SceneCheck(ellipse->extent[0] < ellipse->extent[1], comm, PETSC_ERR_ARG_OUTOFRANGE, body,
    "Body \"%s\": the extent along the axis must have from < to, but they are %g and %g", body->name,
    (double)ellipse->extent[0], (double)ellipse->extent[1]);
  for (PetscInt d = 0; d < 3; ++d) {
    PetscCall(ShapeCheckCount(comm, body, what[d], body->cells[d]));
    PetscCall(ShapeCheckGrading(comm, body, body->grading[d], body->even[d], body->cells[d]));
  }
  PetscCall(ShapeCheckCount(comm, body, "along the axis (layers)", body->layers));
  PetscCall(ShapeCheckTotal(comm, body,
    halves * ((PetscReal)body->cells[0] + body->cells[2] + 1) * ((PetscReal)body->cells[1] + body->cells[2] + 1) *
      ((PetscReal)body->layers + 1)));
  EllipseSetUp(body, &e);
  *ncells    = (PetscInt64)e.length * (e.core[0] * (e.middle + e.core[1]) + e.ring * (e.nring - 1));
  *nvertices = (PetscInt64)(e.length + 1) * e.nsection;
  PetscFunctionReturn(0);
}

/* Returns the parameter of the core's vertex i along the depth (d = 0), or across (d = 1). Across, i counts from the
   plane of symmetry and is negative on one side. */
static PetscReal EllipseCoreParameter(const SceneBody *body, PetscInt d, PetscInt i)
{
  const PetscReal place = ShapeGraded(body->grading[d], body->even[d], body->cells[d], PetscAbsInt(i));

  return i < 0 ? -place : place;
}

static PetscInt EllipseCoreVertex(const SceneBody *body, const void *context, PetscInt i, PetscInt j, PetscInt k,
  PetscReal p[3])
{
  const HalfEllipse *e = (const HalfEllipse *)context;

  if (p) {
    p[0] = EllipseCoreParameter(body, 0, i);
    p[1] = EllipseCoreParameter(body, 1, j - e->middle);
    p[2] = (PetscReal)k / (PetscReal)e->length;
  }
  return k * e->nsection + i + (e->core[0] + 1) * j;
}

/* A vertex of the ring: layer (0: on the core's outline), position `at` on the outline in the direction of growing v,
   cross-section k */
static PetscInt EllipseRingVertex(const SceneBody *body, const HalfEllipse *e, PetscInt layer, PetscInt at, PetscInt k,
  PetscReal p[3])
{
  const PetscInt  below = e->middle ? e->core[0] : 0, across = e->middle + e->core[1];
  const PetscReal m = p ? 1 + ShapeBetween(body, 2, layer, 0, 1) : 0;
  PetscInt        core;

  if (at < below) core = EllipseCoreVertex(body, e, at, 0, k, p);
  else if (at <= below + across) core = EllipseCoreVertex(body, e, e->core[0], at - below, k, p);
  else core = EllipseCoreVertex(body, e, e->core[0] - (at - below - across), across, k, p);
  for (PetscInt d = 0; p && d < 2; ++d) p[d] *= m;
  return layer ? k * e->nsection + (e->core[0] + 1) * (across + 1) + (layer - 1) * e->nring + at : core;
}

/* The vertices of the three blocks of the ring, each right-handed: below, at the crown, above */
static PetscInt EllipseBelowVertex(const SceneBody *body, const void *context, PetscInt i, PetscInt layer, PetscInt k,
  PetscReal p[3])
{
  const HalfEllipse *e = (const HalfEllipse *)context;

  return EllipseRingVertex(body, e, e->ring - layer, i, k, p);
}

static PetscInt EllipseCrownVertex(const SceneBody *body, const void *context, PetscInt layer, PetscInt j, PetscInt k,
  PetscReal p[3])
{
  const HalfEllipse *e = (const HalfEllipse *)context;

  return EllipseRingVertex(body, e, layer, (e->middle ? e->core[0] : 0) + j, k, p);
}

static PetscInt EllipseAboveVertex(const SceneBody *body, const void *context, PetscInt i, PetscInt layer, PetscInt k,
  PetscReal p[3])
{
  const HalfEllipse *e = (const HalfEllipse *)context;

  return EllipseRingVertex(body, e, layer, e->nring - 1 - i, k, p);
}

/* Returns whether the directions depth, across and axis form a left-handed system. The direction across points into the
   half that is modelled, or along its coordinate axis if both halves are modelled. */
static PetscBool EllipseIsMirrored(const SceneBody *body)
{
  const PetscInt depth = body->ellipse.depth, half = body->ellipse.half;
  PetscBool      mirrored = (body->ellipse.axis + 1) % 3 != depth % 3 ? PETSC_TRUE : PETSC_FALSE;

  if (depth >= 3) mirrored = mirrored ? PETSC_FALSE : PETSC_TRUE;
  if (half >= 3) mirrored = mirrored ? PETSC_FALSE : PETSC_TRUE;
  return mirrored;
}

static PetscErrorCode ShapeCreate_HalfEllipse(const SceneBody *body, ShapeGrid *grid)
{
  HalfEllipse e;

  PetscFunctionBegin;
  EllipseSetUp(body, &e);
  {
    const PetscInt   across   = e.middle + e.core[1];
    const PetscInt   symmetry = e.middle ? PETSC_DECIDE : ELLIPSE_SYMMETRY;
    const ShapeBlock blocks[] = {
      {{e.core[0], across, e.length}, {ELLIPSE_FLAT, PETSC_DECIDE, symmetry, PETSC_DECIDE, ELLIPSE_LMIN, ELLIPSE_LMAX},
        &e, EllipseCoreVertex},
      {{e.ring, across, e.length}, {PETSC_DECIDE, ELLIPSE_ARC, symmetry, PETSC_DECIDE, ELLIPSE_LMIN, ELLIPSE_LMAX}, &e,
        EllipseCrownVertex},
      {{e.core[0], e.ring, e.length},
        {ELLIPSE_FLAT, PETSC_DECIDE, PETSC_DECIDE, ELLIPSE_ARC, ELLIPSE_LMIN, ELLIPSE_LMAX}, &e, EllipseAboveVertex},
      {{e.core[0], e.ring, e.length},
        {ELLIPSE_FLAT, PETSC_DECIDE, ELLIPSE_ARC, PETSC_DECIDE, ELLIPSE_LMIN, ELLIPSE_LMAX}, &e, EllipseBelowVertex},
    };

    PetscCall(
      ShapeGridCreate(body, e.middle ? 4 : 3, blocks, (e.length + 1) * e.nsection, EllipseIsMirrored(body), grid));
  }
  PetscFunctionReturn(0);
}

/*
   Returns the length of the arc from the crown to an angle on the auxiliary circle [length]. The quadrature with 4
   panels of 8 Gauss points is exact up to rounding if the ratio of the semi-axes is at most about 5. For larger ratios
   the result is still monotone, and the arc is divided into slightly unequal parts.
*/
static PetscReal EllipseArcLength(const PetscReal semi_axes[2], PetscReal angle)
{
  static const PetscReal point[4]  = {0.1834346424956498, 0.5255324099163290, 0.7966664774136267, 0.9602898564975363};
  static const PetscReal weight[4] = {0.3626837833783620, 0.3137066458778873, 0.2223810344533745, 0.1012285362903763};
  const PetscReal        h         = angle / 4;
  PetscReal              length    = 0;

  for (PetscInt panel = 0; panel < 4; ++panel) {
    for (PetscInt q = 0; q < 8; ++q) {
      const PetscReal t = h * (panel + (q < 4 ? 1 - point[q] : 1 + point[q - 4]) / 2);

      length += weight[q % 4] * h / 2 *
                PetscSqrtReal(PetscSqr(semi_axes[0] * PetscSinReal(t)) + PetscSqr(semi_axes[1] * PetscCosReal(t)));
    }
  }
  return length;
}

/* Computes the point (depth, across) of the quarter arc at a fraction of its length from the crown [length] */
static void EllipseArcPoint(const PetscReal semi_axes[2], PetscReal fraction, PetscReal point[2])
{
  const PetscReal target = fraction * EllipseArcLength(semi_axes, PETSC_PI / 2);
  PetscReal       low = 0, high = PETSC_PI / 2, angle = fraction * PETSC_PI / 2;

  /* Newton's method is combined with bisection. */
  for (PetscInt i = 0; i < 50; ++i) {
    const PetscReal excess = EllipseArcLength(semi_axes, angle) - target;
    const PetscReal slope =
      PetscSqrtReal(PetscSqr(semi_axes[0] * PetscSinReal(angle)) + PetscSqr(semi_axes[1] * PetscCosReal(angle)));
    const PetscReal next = angle - excess / slope;

    if (PetscAbsReal(excess) <= 4 * PETSC_MACHINE_EPSILON * target) break;
    if (excess > 0) high = angle;
    else low = angle;
    angle = next > low && next < high ? next : (low + high) / 2;
  }
  point[0] = fraction == 1 ? 0 : semi_axes[0] * PetscCosReal(angle);
  point[1] = fraction == 0 ? 0 : semi_axes[1] * PetscSinReal(angle);
}

/* Maps parameters (u, v) with v >= 0 to (depth, across) [length] */
static void EllipseSectionMap(const SceneBody *body, const PetscReal uv[2], PetscReal place[2])
{
  const PetscReal *a       = body->ellipse.semi_axes;
  const PetscReal  ring    = body->cells[2];
  const PetscReal  total   = (PetscReal)(body->cells[0] + body->cells[1]);
  const PetscReal  edge[2] = {body->cells[0] / (body->cells[0] + ring),
     body->cells[1] / (body->cells[1] + ring)}; /* size of the core; cells on the symmetry lines are then equal */
  const PetscReal  m = PetscMax(uv[0], uv[1]), scale = PetscMax(m, 1);
  const PetscReal  q[2] = {uv[0] / scale, uv[1] / scale};
  PetscReal        corner[2], arc[2];

  EllipseArcPoint(a, body->cells[1] / total, corner);
  /* The core is bilinear. Its corner is the corner of the arc, scaled by the mean relative size of the core. */
  for (PetscInt d = 0; d < 2; ++d) corner[d] *= (edge[0] + edge[1]) / 2;
  place[0] = q[0] * (1 - q[1]) * edge[0] * a[0] + q[0] * q[1] * corner[0];
  place[1] = q[1] * (1 - q[0]) * edge[1] * a[1] + q[0] * q[1] * corner[1];
  if (m <= 1) return;
  EllipseArcPoint(a, (q[1] < 1 ? q[1] * body->cells[1] : body->cells[1] + (1 - q[0]) * body->cells[0]) / total, arc);
  for (PetscInt d = 0; d < 2; ++d) place[d] = (2 - m) * place[d] + (m - 1) * arc[d];
}

static PetscErrorCode ShapeMap_HalfEllipse(const SceneBody *body, const PetscReal p[3], PetscReal x[3])
{
  const SceneHalfEllipse *e     = &body->ellipse;
  const PetscInt          depth = e->depth % 3, across = 3 - depth - e->axis;
  const PetscReal         uv[2] = {p[0], PetscAbsReal(p[1])}, w = p[2];
  const PetscReal         side = (p[1] < 0 ? -1 : 1) * (e->half >= 3 ? -1 : 1);
  PetscReal               place[2];

  PetscFunctionBegin;
  EllipseSectionMap(body, uv, place);
  x[depth]   = e->center[depth] + (e->depth >= 3 ? -place[0] : place[0]);
  x[across]  = e->center[across] + side * place[1];
  x[e->axis] = (1 - w) * e->extent[0] + w * e->extent[1];
  PetscFunctionReturn(0);
}

static const ShapeKey keys[] = {
  SHAPE_KEY("axis", KEY_AXIS, 1, ellipse.axis, PETSC_TRUE),
  SHAPE_KEY("depth", KEY_DIRECTION, 1, ellipse.depth, PETSC_TRUE),
  SHAPE_KEY("half", KEY_DIRECTION, 1, ellipse.half, PETSC_FALSE),
  SHAPE_KEY("center", KEY_REALS, 3, ellipse.center, PETSC_FALSE),
  SHAPE_KEY("semi_axes", KEY_REALS, 2, ellipse.semi_axes, PETSC_TRUE),
  SHAPE_KEY("extent", KEY_REALS, 2, ellipse.extent, PETSC_TRUE),
  SHAPE_KEY("patches", KEY_INTS, 3, cells, PETSC_TRUE),
  SHAPE_KEY("grading", KEY_REALS, 3, grading, PETSC_FALSE),
  SHAPE_KEY("even", KEY_INTS, 3, even, PETSC_FALSE),
  SHAPE_KEY("layers", KEY_INTS, 1, layers, PETSC_TRUE),
  {NULL, KEY_REALS, 0, 0, PETSC_FALSE},
};

const Shape ShapeHalfEllipse = {ShapeFaces_HalfEllipse, ShapeSize_HalfEllipse, ShapeCreate_HalfEllipse,
  ShapeMap_HalfEllipse, keys, NULL};
