/*
   Computes quadratic cells for a grid of straight hexahedra. Edges on the surface of the grid become arcs that are
   perpendicular to the mean normals at their ends, as in src/contact/smooth. Edges inside stay straight. Edges at which
   the normals of the facets make an angle larger than ARC_FEATURE stay sharp; their curve is determined by the surfaces
   on both sides.
*/
#include "gmshimpl.h"
#include <vector3.h>
#include <stdlib.h>

#define ARC_FEATURE SHAPE_SHARP
#define ARC_FLAT    1e-6 /* heights of arcs that are smaller, relative to the edge, are rounding errors of the file */

/* The boundary facets of a grid, with vertices counterclockwise seen from outside. Corner 4 f + a is vertex a of facet
   f. It also represents the edge from that vertex to the next. */
typedef struct {
  PetscInt         ncorners;
  const PetscInt  *vertex;
  PetscInt        *twin; /* for each corner, the corner that represents the same edge in the neighbouring facet; -1
                            if the edge is sharp or does not have exactly one neighbour */
  const PetscReal *x;    /* 3 coordinates per vertex [length] */
} ArcSurface;

static PetscInt ArcAfter(PetscInt corner)
{
  return corner % 4 == 3 ? corner - 3 : corner + 1;
}

static PetscInt ArcBefore(PetscInt corner)
{
  return corner % 4 ? corner - 1 : corner + 3;
}

/* Computes the edge vector e between the vertices of two corners [length] */
static void ArcEdge(const ArcSurface *s, PetscInt from, PetscInt to, PetscReal e[3])
{
  for (PetscInt d = 0; d < 3; ++d) e[d] = s->x[3 * s->vertex[to] + d] - s->x[3 * s->vertex[from] + d];
}

/* Computes the unit normal of a corner's facet */
static void ArcFacetNormal(const ArcSurface *s, PetscInt corner, PetscReal n[3])
{
  ShapeFacetNormal(s->x, &s->vertex[corner - corner % 4], n);
}

/* Finds the neighbour of each edge. edges: all corners, sorted by the ends of their edges */
static void ArcFindTwins(const ShapeItem edges[], ArcSurface *s)
{
  const PetscReal cosine = PetscCosReal(ARC_FEATURE * PETSC_PI / 180);

  for (PetscInt i = 0; i < s->ncorners; ++i) s->twin[i] = PETSC_DECIDE;
  for (PetscInt i = 0, end; i < s->ncorners; i = end) {
    PetscReal n[3], m[3];

    for (end = i + 1; end < s->ncorners && !ShapeCompareItems(&edges[i], &edges[end]);) ++end;
    if (end - i != 2) continue;
    ArcFacetNormal(s, edges[i].at, n);
    ArcFacetNormal(s, edges[i + 1].at, m);
    if (VectorDot(n, m) < cosine) continue;
    s->twin[edges[i].at]     = edges[i + 1].at;
    s->twin[edges[i + 1].at] = edges[i].at;
  }
}

/* Finds the first (clockwise) and the last corner around a corner's vertex before a sharp edge or a border. Returns
   true if there is neither. */
static PetscBool ArcFan(const ArcSurface *s, PetscInt corner, PetscInt *first, PetscInt *last)
{
  *first = *last = corner;
  while (s->twin[ArcBefore(*last)] >= 0) {
    *last = s->twin[ArcBefore(*last)];
    if (*last == corner) {
      *last = ArcAfter(s->twin[corner]);
      return PETSC_TRUE;
    }
  }
  while (s->twin[*first] >= 0) *first = ArcAfter(s->twin[*first]);
  return PETSC_FALSE;
}

/*
   Computes n, the sum of (e x f) / (e.e f.f) over the corners of the fan around a corner's vertex, scaled to length 1.
   The edges e and f meet at each corner. The normal is exact on spheres and cylinders (N. Max, J. Graphics Tools 4
   (1999)). Returns whether the fan is closed.
*/
static PetscBool ArcFanNormal(const ArcSurface *s, PetscInt corner, PetscInt *first, PetscInt *last, PetscReal n[3])
{
  const PetscBool closed = ArcFan(s, corner, first, last);

  n[0] = n[1] = n[2] = 0;
  for (PetscInt c = *first;; c = s->twin[ArcBefore(c)]) {
    PetscReal e[3], f[3], product[3], weight;

    ArcEdge(s, c, ArcAfter(c), e);
    ArcEdge(s, c, ArcBefore(c), f);
    VectorCross(e, f, product);
    weight = VectorDot(e, e) * VectorDot(f, f);
    for (PetscInt d = 0; weight > 0 && d < 3; ++d) n[d] += product[d] / weight;
    if (c == *last) break;
  }
  (void)VectorScaleToUnit(n);
  return closed;
}

/* Returns the component along the edge e that n lacks to be the mirror image of the normal at the edge's other end,
   multiplied by the length of e. It is zero for an arc. */
static PetscReal ArcMissing(const ArcSurface *s, PetscInt other, const PetscReal n[3], const PetscReal e[3])
{
  PetscReal m[3];
  PetscInt  first, last;

  (void)ArcFanNormal(s, other, &first, &last, m);
  return -VectorDot(n, e) - VectorDot(m, e);
}

/* Corrects the normal n at a corner whose vertex has a single facet, so that the surface is an arc along both edges */
static void ArcCorrectCorner(const ArcSurface *s, PetscInt corner, PetscReal n[3])
{
  PetscReal e[2][3], missing[2], a, b, c, det;

  ArcEdge(s, corner, ArcAfter(corner), e[0]);
  ArcEdge(s, corner, ArcBefore(corner), e[1]);
  missing[0] = ArcMissing(s, ArcAfter(corner), n, e[0]);
  missing[1] = ArcMissing(s, ArcBefore(corner), n, e[1]);
  a          = VectorDot(e[0], e[0]);
  b          = VectorDot(e[1], e[1]);
  c          = VectorDot(e[0], e[1]);
  det        = a * b - c * c;
  if (!(det > 1e-4 * a * b)) return;
  for (PetscInt d = 0; d < 3; ++d)
    n[d] += ((b * missing[0] - c * missing[1]) * e[0][d] + (a * missing[1] - c * missing[0]) * e[1][d]) / det;
}

/*
   Corrects the normal n where the surface ends. The component along the border is that of the mean normal. The
   component across the border is determined by least squares, so that the surface is an arc along the edges that lead
   away from the border.
*/
static void ArcCorrectBorder(const ArcSurface *s, PetscInt first, PetscInt last, PetscReal n[3])
{
  PetscReal e[3], f[3], along[3], across[3], sum = 0, squares = 0;

  ArcEdge(s, first, ArcAfter(first), e);
  ArcEdge(s, last, ArcBefore(last), f);
  for (PetscInt d = 0; d < 3; ++d) along[d] = e[d] - f[d];
  VectorCross(n, along, across);
  (void)VectorScaleToUnit(across);
  for (PetscInt c = first; c != last; c = s->twin[ArcBefore(c)]) {
    ArcEdge(s, c, ArcBefore(c), f);
    sum += ArcMissing(s, ArcBefore(c), n, f) * VectorDot(across, f);
    squares += PetscSqr(VectorDot(across, f));
  }
  for (PetscInt d = 0; squares > 0 && d < 3; ++d) n[d] += sum / squares * across[d];
}

/* Computes the unit normal at a corner, corrected where the surface ends */
static void ArcNormal(const ArcSurface *s, PetscInt corner, PetscReal n[3])
{
  PetscInt        first, last;
  const PetscBool closed = ArcFanNormal(s, corner, &first, &last, n);

  if (closed) return;
  if (first == last) ArcCorrectCorner(s, corner, n);
  else ArcCorrectBorder(s, first, last, n);
  (void)VectorScaleToUnit(n);
}

/* Returns the height of an arc in the middle of a corner's edge [length], along the mean N of the normals at the edge's
   ends. It is 0 if it is smaller than rounding. */
static PetscReal ArcHeight(const ArcSurface *s, PetscInt corner, PetscReal N[3])
{
  PetscReal n[2][3], e[3], slope[2], height;

  ArcNormal(s, corner, n[0]);
  ArcNormal(s, ArcAfter(corner), n[1]);
  ArcEdge(s, corner, ArcAfter(corner), e);
  for (PetscInt d = 0; d < 3; ++d) N[d] = n[0][d] + n[1][d];
  if (!(VectorDot(N, N) > 1)) return 0;
  (void)VectorScaleToUnit(N);
  for (PetscInt i = 0; i < 2; ++i) slope[i] = -2 * VectorDot(e, n[i]) / (1 + VectorDot(N, n[i]));
  height = (slope[0] - slope[1]) / 8;
  return PetscAbsReal(height) > ARC_FLAT * VectorNorm(e) ? height : 0;
}

/* Computes off, the shortest vector [length] whose components along n1 and n2 are the heights h1 and h2. For almost
   equal normals it is the mean of both heights. */
static void ArcMeet(PetscReal h1, const PetscReal n1[3], PetscReal h2, const PetscReal n2[3], PetscReal off[3])
{
  const PetscReal c = VectorDot(n1, n2), det = 1 - c * c;

  for (PetscInt d = 0; d < 3; ++d)
    off[d] = det > 0.03 ? ((h1 - c * h2) * n1[d] + (h2 - c * h1) * n2[d]) / det : (h1 * n1[d] + h2 * n2[d]) / 2;
}

/* Computes for each edge of the surface, in the order of `edges`, the vector `off` by which its middle is moved
   [length]. Equal edges store it at the first of them. Returns whether any edge is curved. */
static PetscBool ArcBendEdges(const ArcSurface *s, const ShapeItem edges[], PetscReal off[])
{
  PetscBool bent = PETSC_FALSE;

  for (PetscInt i = 0, end; i < s->ncorners; i = end) {
    PetscReal h[2], n[2][3];

    for (end = i + 1; end < s->ncorners && !ShapeCompareItems(&edges[i], &edges[end]);) ++end;
    off[3 * i] = off[3 * i + 1] = off[3 * i + 2] = 0;
    if (end - i != 2) continue;
    for (PetscInt k = 0; k < 2; ++k) h[k] = ArcHeight(s, edges[i + k].at, n[k]);
    ArcMeet(h[0], n[0], h[1], n[1], &off[3 * i]);
    if (h[0] != 0 || h[1] != 0) bent = PETSC_TRUE;
  }
  return bent;
}

static ShapeItem ArcEdgeItem(PetscInt a, PetscInt b, PetscInt at)
{
  const ShapeItem item = {{PetscMin(a, b), PetscMax(a, b), 0, 0}, at};

  return item;
}

/* Computes the quadratic cells: middles of edges on the surface are moved by `off` */
static void ArcFillCurve(const ShapeGrid *grid, PetscInt nedges, const ShapeItem edges[], const PetscReal off[],
  PetscReal curve[])
{
  for (PetscInt c = 0; c < grid->ncells; ++c) {
    PetscReal x[20][3];

    for (PetscInt a = 0; a < 20; ++a) {
      const PetscInt *ends = GmshHexahedronEnds[a], from = grid->cells[8 * c + ends[0]],
                     to     = grid->cells[8 * c + ends[1]];
      const ShapeItem  key  = ArcEdgeItem(from, to, 0);
      const ShapeItem *edge = (const ShapeItem *)bsearch(&key, edges, (size_t)nedges, sizeof(key), ShapeCompareItems);

      while (edge && edge > edges && !ShapeCompareItems(edge - 1, edge)) --edge;
      for (PetscInt d = 0; d < 3; ++d)
        x[a][d] = (grid->coordinates[3 * from + d] + grid->coordinates[3 * to + d]) / 2 +
                  (edge ? off[3 * (edge - edges) + d] : 0);
    }
    (void)GmshGetCurve(20, (const PetscReal(*)[3])x, curve + 81 * c);
  }
}

/* Sets the grid's curve, unless all its edges are straight */
PetscErrorCode ShapeGridProject(ShapeGrid *grid)
{
  ShapeBoundary boundary;
  ArcSurface    s = {.x = grid->coordinates};
  ShapeItem    *edges;
  PetscReal    *off;

  PetscFunctionBegin;
  PetscCall(ShapeBoundaryCreate(grid, s.x, &boundary));
  s.ncorners = 4 * boundary.n;
  s.vertex   = boundary.vertex;
  PetscCall(PetscMalloc1(s.ncorners, &s.twin));
  PetscCall(PetscMalloc2(s.ncorners, &edges, 3 * s.ncorners, &off));
  for (PetscInt i = 0; i < s.ncorners; ++i) edges[i] = ArcEdgeItem(s.vertex[i], s.vertex[ArcAfter(i)], i);
  if (s.ncorners) qsort(edges, (size_t)s.ncorners, sizeof(*edges), ShapeCompareItems);
  ArcFindTwins(edges, &s);
  if (ArcBendEdges(&s, edges, off)) {
    PetscCall(PetscMalloc1(81 * grid->ncells, &grid->curve));
    ArcFillCurve(grid, s.ncorners, edges, off, grid->curve);
  }
  PetscCall(PetscFree2(edges, off));
  PetscCall(PetscFree(s.twin));
  PetscCall(ShapeBoundaryDestroy(&boundary));
  PetscFunctionReturn(0);
}
