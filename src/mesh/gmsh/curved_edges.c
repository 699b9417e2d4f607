/*
   Computes quadratic cells for a grid of straight hexahedra. Edges on the surface of the grid become arcs that are
   perpendicular to the mean normals at their ends, as in src/contact/smooth. Edges inside stay straight. Edges at which
   the normals of the facets make an angle larger than ARC_FEATURE stay sharp; their curve is determined by the surfaces
   on both sides.
*/
#include "gmshimpl.h"
#include <vector3.h>
#include <stdlib.h>

#define ARC_FEATURE MESH_SHARP_ANGLE

/* Finds the neighbour of each edge. edges: all corners, sorted by the ends of their edges */
static void ArcFindTwins(PetscInt ncorners, const ShapeItem edges[], MeshFacets *s)
{
  const PetscReal cosine = PetscCosReal(ARC_FEATURE * PETSC_PI / 180);

  for (PetscInt i = 0; i < ncorners; ++i) s->twin[i] = PETSC_DECIDE;
  for (PetscInt i = 0, end; i < ncorners; i = end) {
    PetscReal n[3], m[3];

    for (end = i + 1; end < ncorners && !ShapeCompareItems(&edges[i], &edges[end]);) ++end;
    if (end - i != 2) continue;
    ShapeFacetNormal(s->x, &s->node[edges[i].at / 4 * 4], n);
    ShapeFacetNormal(s->x, &s->node[edges[i + 1].at / 4 * 4], m);
    if (VectorDot(n, m) < cosine) continue;
    s->twin[edges[i].at]     = edges[i + 1].at;
    s->twin[edges[i + 1].at] = edges[i].at;
  }
}

/* Returns the height of an arc in the middle of a corner's edge [length], along the mean N of the normals at the edge's
   ends. It is 0 if it is smaller than rounding. */
static PetscReal ArcHeight(const MeshFacets *s, PetscInt corner, PetscReal N[3])
{
  PetscReal n[2][3], e[3], before[3], slope[2], height;

  MeshCornerNormal(s, corner, n[0]);
  MeshCornerNormal(s, MeshCornerAfter(s, corner), n[1]);
  MeshCornerEdges(s, corner, e, before);
  for (PetscInt d = 0; d < 3; ++d) N[d] = n[0][d] + n[1][d];
  if (!(VectorDot(N, N) > 1)) return 0;
  (void)VectorScaleToUnit(N);
  for (PetscInt i = 0; i < 2; ++i) slope[i] = -2 * VectorDot(e, n[i]) / (1 + VectorDot(N, n[i]));
  height = (slope[0] - slope[1]) / 8;
  return PetscAbsReal(height) > MESH_SAME_PLACE * VectorNorm(e) ? height : 0;
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
static PetscBool ArcBendEdges(const MeshFacets *s, PetscInt ncorners, const ShapeItem edges[], PetscReal off[])
{
  PetscBool bent = PETSC_FALSE;

  for (PetscInt i = 0, end; i < ncorners; i = end) {
    PetscReal h[2], n[2][3];

    for (end = i + 1; end < ncorners && !ShapeCompareItems(&edges[i], &edges[end]);) ++end;
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
  MeshFacets    s = {.x = grid->coordinates};
  PetscInt      ncorners;
  ShapeItem    *edges;
  PetscReal    *off;

  PetscFunctionBegin;
  PetscCall(ShapeBoundaryCreate(grid, s.x, &boundary));
  ncorners = 4 * boundary.n;
  s.node   = boundary.vertex;
  PetscCall(PetscMalloc1(ncorners, &s.twin));
  PetscCall(PetscMalloc2(ncorners, &edges, 3 * ncorners, &off));
  for (PetscInt i = 0; i < ncorners; ++i) edges[i] = ArcEdgeItem(s.node[i], s.node[MeshCornerAfter(&s, i)], i);
  if (ncorners) qsort(edges, (size_t)ncorners, sizeof(*edges), ShapeCompareItems);
  ArcFindTwins(ncorners, edges, &s);
  if (ArcBendEdges(&s, ncorners, edges, off)) {
    PetscCall(PetscMalloc1(81 * grid->ncells, &grid->curve));
    ArcFillCurve(grid, ncorners, edges, off, grid->curve);
  }
  PetscCall(PetscFree2(edges, off));
  PetscCall(PetscFree(s.twin));
  PetscCall(ShapeBoundaryDestroy(&boundary));
  PetscFunctionReturn(0);
}
