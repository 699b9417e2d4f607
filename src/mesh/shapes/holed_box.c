/*
   Box with a round hole through it. The axis of the hole is inside of the box, or on a side or an edge of the box; the
   body then has a half or a quarter of the hole. The parameters are a point (a, b) of a square with -2 <= a, b <= 2,
   and the coordinate along the axis. With m = max(|a|, |b|), the point is in the direction (a, b)/m. The hole is at m =
   1, and m - 1 is the fraction of the distance from the hole to the sides of the box.
*/
#include "shapesimpl.h"

typedef struct {
  PetscInt n, layers;    /* numbers of cells along an eighth of a turn, and from the hole to the sides */
  PetscInt first, count; /* first eighth of a turn in the box, and number of eighths */
  PetscInt around;       /* number of vertices around the hole in one layer */
  PetscInt eighth;       /* the eighth of a turn that a block of the grid fills */
} HoledBox;

/* Returns the distance from the hole's axis to the side at the lower (end = 0) or upper (end = 1) end of axis d; 0 if
   the axis is on that side [length] */
static PetscReal HoledReach(const SceneBody *body, PetscInt d, PetscInt end)
{
  const PetscReal reach = end ? body->upper[d] - body->tube.center[d] : body->tube.center[d] - body->lower[d];

  return reach > PETSC_SQRT_MACHINE_EPSILON * (body->upper[d] - body->lower[d]) ? reach : 0;
}

/* Determines which eighths of a turn the box has */
static HoledBox HoledSetUp(const SceneBody *body)
{
  const PetscInt s = (body->tube.axis + 1) % 3, t = (body->tube.axis + 2) % 3;
  HoledBox       h = {.n = body->cells[1], .layers = body->cells[0]};
  PetscBool      has[4]; /* which quadrants around the hole's axis the box has */

  for (PetscInt q = 0; q < 4; ++q)
    has[q] = (PetscBool)(HoledReach(body, s, q == 0 || q == 3) > 0 && HoledReach(body, t, q < 2) > 0);
  for (PetscInt q = 0; q < 4; ++q) {
    h.count += 2 * has[q];
    if (has[q] && !has[(q + 3) % 4]) h.first = 2 * q;
  }
  h.around = h.count * h.n + (h.count < 8);
  return h;
}

static const char *const faces[] = {"xmin", "xmax", "ymin", "ymax", "zmin", "zmax", "hole", NULL};

/* Checks the radius and the position of the hole */
static PetscErrorCode HoledCheckPlace(MPI_Comm comm, const SceneBody *body)
{
  const PetscReal radius = body->tube.radii[1];

  PetscFunctionBegin;
  SceneCheck(radius > 0, comm, PETSC_ERR_ARG_OUTOFRANGE, body,
    "Body \"%s\": the radius of the hole must be positive, but is %g", body->name, (double)radius);
  for (PetscInt d = 0; d < 3; ++d) {
    SceneCheck(body->lower[d] < body->upper[d] && !PetscIsInfOrNanReal(body->upper[d] - body->lower[d]), comm,
      PETSC_ERR_ARG_OUTOFRANGE, body,
      "Body \"%s\": the box must have lower < upper along each axis, but along %c they are %g and %g", body->name,
      "xyz"[d], (double)body -> lower[d], (double)body -> upper[d]);
    for (PetscInt end = 0; end < 2 && d != body->tube.axis; ++end) {
      const PetscReal reach = HoledReach(body, d, end);

      SceneCheck(reach == 0 || reach > radius, comm, PETSC_ERR_ARG_OUTOFRANGE, body,
        "Body \"%s\": the hole of radius %g must be inside of the box, or its axis must be on a side or an edge of the "
        "box, but the axis is %g from the side %c%s",
        body->name, (double)radius, (double)reach, "xyz"[d], end ? "max" : "min");
    }
    SceneCheck(d == body->tube.axis ||
                 (body->tube.center[d] >= body->lower[d] && body->tube.center[d] <= body->upper[d]),
      comm, PETSC_ERR_ARG_OUTOFRANGE, body, "Body \"%s\": the axis of the hole is outside of the box along %c, at %g",
      body->name, "xyz"[d], (double)body -> tube.center[d]);
  }
  PetscFunctionReturn(0);
}

static PetscErrorCode ShapeSize_HoledBox(MPI_Comm comm, const SceneBody *body, PetscInt64 *ncells,
  PetscInt64 *nvertices)
{
  const PetscInt *n = body->cells;
  HoledBox        h;

  PetscFunctionBegin;
  PetscCall(HoledCheckPlace(comm, body));
  PetscCall(ShapeCheckCount(comm, body, "from the hole to the sides", n[0]));
  PetscCall(ShapeCheckCount(comm, body, "along an eighth of the hole", n[1]));
  PetscCall(ShapeCheckCount(comm, body, "along the hole", n[2]));
  for (PetscInt d = 0; d < 3; ++d) PetscCall(ShapeCheckGrading(comm, body, body->grading[d], body->even[d], n[d]));
  SceneCheck(body->grading[1] == 0 || body->grading[1] == 1, comm, PETSC_ERR_ARG_OUTOFRANGE, body,
    "Body \"%s\": the cells around the hole are equal, so their grading must be 1, but is %g", body->name,
    (double)body->grading[1]);
  PetscCall(ShapeCheckTotal(comm, body, (8 * (PetscReal)n[1] + 1) * ((PetscReal)n[0] + 1) * ((PetscReal)n[2] + 1)));
  h          = HoledSetUp(body);
  *ncells    = (PetscInt64)h.count * n[1] * n[0] * n[2];
  *nvertices = (PetscInt64)h.around * (n[0] + 1) * (n[2] + 1);
  PetscFunctionReturn(0);
}

/* Computes the point q at i/n of one eighth of the outline of the square max(|a|, |b|) = 1 */
static void HoledSquare(PetscInt eighth, PetscInt i, PetscInt n, PetscReal q[2])
{
  static const PetscInt corners[9][2] = {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}, {1, 0}};

  for (PetscInt c = 0; c < 2; ++c)
    q[c] =
      ((PetscReal)(n - i) * (PetscReal)corners[eighth % 8][c] + (PetscReal)i * (PetscReal)corners[eighth % 8 + 1][c]) /
      (PetscReal)n;
}

/* The vertex i cells along the block's eighth of a turn */
static PetscInt HoledVertex(const SceneBody *body, const void *context, PetscInt layer, PetscInt i, PetscInt k,
  PetscReal p[3])
{
  const HoledBox *h    = (const HoledBox *)context;
  const PetscInt  axis = body->tube.axis, at = (h->eighth - h->first) * h->n + i;
  const PetscReal m = p ? 1 + ShapeBetween(body, 0, layer, 0, 1) : 0;
  PetscReal       q[2];

  if (p) {
    HoledSquare(h->eighth, i, h->n, q);
    p[0] = m * q[0];
    p[1] = m * q[1];
    p[2] = ShapeBetween(body, 2, k, body->lower[axis], body->upper[axis]);
  }
  return at % h->around + h->around * (layer + (h->layers + 1) * k);
}

/* Returns the number of the box's side in the direction of 0, 2, 4 or 6 eighths of a turn */
static PetscInt HoledSide(const SceneBody *body, PetscInt eighths)
{
  const PetscInt quarter = eighths / 2 % 4, axis = (body->tube.axis + 1 + quarter % 2) % 3;

  return 2 * axis + (quarter < 2);
}

static PetscErrorCode ShapeCreate_HoledBox(const SceneBody *body, ShapeGrid *grid)
{
  const PetscInt length = body->cells[2], axis = body->tube.axis;
  HoledBox       h = HoledSetUp(body), parts[8];
  ShapeBlock     blocks[8];

  PetscFunctionBegin;
  for (PetscInt b = 0; b < h.count; ++b) {
    const PetscInt eighth = h.first + b, first = h.count < 8 && b == 0, last = h.count < 8 && b == h.count - 1;

    parts[b]        = h;
    parts[b].eighth = eighth;
    /* The planes that cut the hole are also sides of the box: one is a quarter of a turn before the first eighth, the
       other a quarter after the last eighth. */
    blocks[b] = (ShapeBlock){{h.layers, h.n, length},
      {6, HoledSide(body, eighth + eighth % 2), first ? HoledSide(body, eighth + 6) : PETSC_DECIDE,
        last ? HoledSide(body, eighth + 3) : PETSC_DECIDE, 2 * axis, 2 * axis + 1},
      &parts[b], HoledVertex};
  }
  PetscCall(ShapeGridCreate(body, h.count, blocks, h.around * (h.layers + 1) * (length + 1), PETSC_FALSE, grid));
  PetscFunctionReturn(0);
}

static PetscErrorCode ShapeMap_HoledBox(const SceneBody *body, const PetscReal p[3], PetscReal x[3])
{
  const PetscInt  axis = body->tube.axis;
  const PetscReal m = PetscMax(PetscAbsReal(p[0]), PetscAbsReal(p[1])), along = p[2];
  const PetscReal q[2] = {p[0] / m, p[1] / m};
  PetscReal       circle[2];

  PetscFunctionBegin;
  ShapeCircle(q, circle);
  x[axis] = along;
  for (PetscInt c = 0; c < 2; ++c) {
    const PetscInt d = (axis + 1 + c) % 3;

    x[d] =
      body->tube.center[d] + (2 - m) * body->tube.radii[1] * circle[c] + (m - 1) * q[c] * HoledReach(body, d, q[c] > 0);
  }
  PetscFunctionReturn(0);
}

static const ShapeKey keys[] = {
  SHAPE_KEY("lower", KEY_REALS, 3, lower, PETSC_TRUE),
  SHAPE_KEY("upper", KEY_REALS, 3, upper, PETSC_TRUE),
  SHAPE_KEY("axis", KEY_AXIS, 1, tube.axis, PETSC_TRUE),
  SHAPE_KEY("center", KEY_REALS, 3, tube.center, PETSC_FALSE),
  SHAPE_KEY("radius", KEY_REALS, 1, tube.radii[1], PETSC_TRUE),
  SHAPE_KEY("cells", KEY_INTS, 3, cells, PETSC_TRUE),
  SHAPE_KEY("grading", KEY_REALS, 3, grading, PETSC_FALSE),
  SHAPE_KEY("even", KEY_INTS, 3, even, PETSC_FALSE),
  {NULL, KEY_REALS, 0, 0, PETSC_FALSE},
};

const Shape ShapeHoledBox = {NULL, ShapeSize_HoledBox, ShapeCreate_HoledBox, ShapeMap_HoledBox, keys, faces};
