/* Wedge: a prism over a triangle. Lines from the centre of the triangle to the middles of its sides divide the triangle
   into three quadrilaterals, one at each corner, with n x n cells each. */
#include "shapesimpl.h"

/* index of the corners' coordinates in `own` of SceneBody: two numbers for each corner, in the plane perpendicular to
   the axis */
#define WEDGE_CORNERS 0

static const char *const faces[] = {"side1", "side2", "side3", "lmin", "lmax", NULL};

/* Returns twice the area of the triangle [length^2]; negative if the corners are clockwise about the axis */
static PetscReal WedgeArea(const SceneBody *body)
{
  const PetscReal *c = body->own + WEDGE_CORNERS;

  return (c[2] - c[0]) * (c[5] - c[1]) - (c[4] - c[0]) * (c[3] - c[1]);
}

static PetscErrorCode ShapeSize_Wedge(MPI_Comm comm, const SceneBody *body, PetscInt64 *ncells, PetscInt64 *nvertices)
{
  const PetscInt *n       = body->cells;
  PetscReal       longest = 0;

  PetscFunctionBegin;
  for (PetscInt side = 0; side < 3; ++side) {
    const PetscReal *a = body->own + WEDGE_CORNERS + 2 * side, *b = body->own + WEDGE_CORNERS + 2 * ((side + 1) % 3);

    longest = PetscMax(longest, PetscSqr(b[0] - a[0]) + PetscSqr(b[1] - a[1]));
  }
  SceneCheck(PetscAbsReal(WedgeArea(body)) > 1e-6 * longest, comm, PETSC_ERR_ARG_OUTOFRANGE, body,
    "Body \"%s\": the three corners of a wedge must not lie on a line", body->name);
  SceneCheck(body->tube.extent[0] < body->tube.extent[1], comm, PETSC_ERR_ARG_OUTOFRANGE, body,
    "Body \"%s\": the extent along the axis must have from < to, but they are %g and %g", body->name,
    (double)body->tube.extent[0], (double)body->tube.extent[1]);
  PetscCall(ShapeCheckCount(comm, body, "along half of a side", n[0]));
  PetscCall(ShapeCheckCount(comm, body, "along the axis", n[1]));
  PetscCall(ShapeCheckTotal(comm, body, 3 * PetscSqr((PetscReal)n[0] + 1) * ((PetscReal)n[1] + 1)));
  *ncells    = (PetscInt64)3 * n[0] * n[0] * n[1];
  *nvertices = (1 + (PetscInt64)3 * n[0] * (n[0] + 1)) * (n[1] + 1);
  PetscFunctionReturn(0);
}

typedef struct {
  PetscInt n, corner; /* number of cells along half of a side; number of the corner */
} WedgeBlock;

/*
   Returns the number of a vertex in a cross-section. The centre has number 0. For each corner, the vertices follow that
   are not on the line to the middle of the next side. i counts cells towards the middle of the side after the corner, j
   towards the middle of the side before it; both are 0 at the centre.
*/
static PetscInt WedgeSection(PetscInt n, PetscInt corner, PetscInt i, PetscInt j)
{
  if (!i && !j) return 0;
  if (!i) return WedgeSection(n, (corner + 2) % 3, j, 0);
  return 1 + corner * n * (n + 1) + (i - 1) * (n + 1) + j;
}

/* Computes the point at the fractions a and b of the way from the centre to the middles of the sides after and before a
   corner */
static void WedgePlace(const SceneBody *body, PetscInt corner, PetscReal a, PetscReal b, PetscReal place[2])
{
  const PetscReal *c = body->own + WEDGE_CORNERS, *at = c + 2 * corner, *next = c + 2 * ((corner + 1) % 3),
                  *last = c + 2 * ((corner + 2) % 3);

  for (PetscInt d = 0; d < 2; ++d)
    place[d] = (1 - a) * (1 - b) * (c[d] + c[2 + d] + c[4 + d]) / 3 + a * (1 - b) * (at[d] + next[d]) / 2 +
               (1 - a) * b * (at[d] + last[d]) / 2 + a * b * at[d];
}

static PetscInt WedgeVertex(const SceneBody *body, const void *context, PetscInt i, PetscInt j, PetscInt k,
  PetscReal x[3])
{
  const WedgeBlock *b    = (const WedgeBlock *)context;
  const PetscInt    axis = body->tube.axis;
  const PetscReal   part = (PetscReal)k / (PetscReal)body->cells[1];
  PetscReal         place[2];

  if (x) {
    WedgePlace(body, b->corner, (PetscReal)i / (PetscReal)b->n, (PetscReal)j / (PetscReal)b->n, place);
    x[(axis + 1) % 3] = place[0];
    x[(axis + 2) % 3] = place[1];
    x[axis]           = (1 - part) * body->tube.extent[0] + part * body->tube.extent[1];
  }
  return WedgeSection(b->n, b->corner, i, j) + k * (1 + 3 * b->n * (b->n + 1));
}

static PetscErrorCode ShapeCreate_Wedge(const SceneBody *body, ShapeGrid *grid)
{
  const PetscInt n = body->cells[0], length = body->cells[1], section = 1 + 3 * n * (n + 1);
  WedgeBlock     corners[3];
  ShapeBlock     blocks[3];

  PetscFunctionBegin;
  for (PetscInt c = 0; c < 3; ++c) {
    corners[c] = (WedgeBlock){n, c};
    blocks[c] =
      (ShapeBlock){{n, n, length}, {PETSC_DECIDE, c, PETSC_DECIDE, (c + 2) % 3, 3, 4}, &corners[c], WedgeVertex};
  }
  PetscCall(ShapeGridCreate(body, 3, blocks, section * (length + 1), (PetscBool)(WedgeArea(body) > 0), grid));
  PetscFunctionReturn(0);
}

static const ShapeKey keys[] = {
  SHAPE_KEY("axis", KEY_AXIS, 1, tube.axis, PETSC_TRUE),
  SHAPE_KEY("corners", KEY_REALS, 6, own[WEDGE_CORNERS], PETSC_TRUE),
  SHAPE_KEY("extent", KEY_REALS, 2, tube.extent, PETSC_TRUE),
  SHAPE_KEY("side_cells", KEY_INTS, 1, cells[0], PETSC_TRUE),
  SHAPE_KEY("length_cells", KEY_INTS, 1, cells[1], PETSC_TRUE),
  {NULL, KEY_REALS, 0, 0, PETSC_FALSE},
};

const Shape ShapeWedge = {NULL, ShapeSize_Wedge, ShapeCreate_Wedge, NULL, keys, faces};
