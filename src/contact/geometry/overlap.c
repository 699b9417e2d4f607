/* The overlap of two facets: projection onto a plane, clipping, and quadrature points on both facets */
#include "geometryimpl.h"

/* distance from a line that is attributed to rounding and to the tolerance of solves, relative to the length of the
   line */
#define ONE_LINE 1e-6
/* distance of two vertices that is attributed to rounding, relative to the size of the smaller facet */
#define ONE_VERTEX 1e-12

static void OverlapPutPart(const PetscReal p[4][2], PetscInt n, const PetscInt vertex[], PetscReal part[4][2])
{
  for (PetscInt i = 0; i < n; ++i) {
    for (PetscInt d = 0; d < 2; ++d) part[i][d] = p[vertex[i]][d];
  }
}

/*
   Splits a quadrilateral into convex parts with counterclockwise vertices and returns their number. A convex
   quadrilateral or a triangle is one part. A quadrilateral with a reflex corner is two triangles. If its edges cross,
   one of the triangles is clockwise: its vertices are reversed and its sign is -1.
*/
static PetscInt OverlapConvexParts(const PetscReal p[4][2], PetscInt size[2], PetscReal part[2][4][2],
  PetscInt vertex[2][4], PetscReal sign[2])
{
  const PetscBool triangle = (PetscBool)(p[2][0] == p[3][0] && p[2][1] == p[3][1]);
  PetscInt        reflex   = -1;

  for (PetscInt a = 0; a < 4; ++a) {
    const PetscReal *l = p[(a + 3) % 4], *m = p[a], *r = p[(a + 1) % 4];

    if (!triangle && (m[0] - l[0]) * (r[1] - m[1]) - (m[1] - l[1]) * (r[0] - m[0]) < 0.0) reflex = a;
  }
  for (PetscInt k = 0; k < 2; ++k) {
    const PetscInt first = reflex < 0 ? 0 : reflex + 2 * k;

    size[k] = reflex < 0 && !triangle ? 4 : 3;
    for (PetscInt i = 0; i < size[k]; ++i) vertex[k][i] = (first + i) % 4;
    OverlapPutPart(p, size[k], vertex[k], part[k]);
    sign[k] = ContactPolygonArea(size[k], (const PetscReal(*)[2])part[k]) < 0.0 ? -1.0 : 1.0;
    if (sign[k] < 0.0) {
      const PetscInt swap = vertex[k][1];

      vertex[k][1] = vertex[k][2];
      vertex[k][2] = swap;
      OverlapPutPart(p, size[k], vertex[k], part[k]);
    }
  }
  return reflex < 0 ? 1 : 2;
}

/* Returns whether y lies on the line through a and b, up to ONE_LINE */
static PetscBool OverlapIsOnLine(const PetscReal a[2], const PetscReal b[2], const PetscReal y[2])
{
  const PetscReal d[2] = {b[0] - a[0], b[1] - a[1]}, size = d[0] * d[0] + d[1] * d[1];

  return (PetscBool)(PetscAbsReal(d[0] * (y[1] - a[1]) - d[1] * (y[0] - a[0])) <= ONE_LINE * size);
}

/*
   Removes the edges of a polygon that are so short that rounding decides whether they exist. They arise where a vertex
   of one facet lies on an edge of the other facet. The derivatives of the overlap would otherwise depend on rounding.
   size: size of the facets [length]. Returns the number of vertices that remain.
*/
static PetscInt OverlapMergeVertices(PetscInt n, PetscReal size, PetscReal polygon[][2], PetscInt edge[][2])
{
  PetscInt i = 0;

  while (n > 2 && i < n) {
    const PetscInt  next   = (i + 1) % n;
    const PetscReal square = PetscSqr(polygon[next][0] - polygon[i][0]) + PetscSqr(polygon[next][1] - polygon[i][1]);

    if (square > PetscSqr(ONE_VERTEX * size)) {
      ++i;
      continue;
    }
    edge[i][1] = edge[next][1];
    for (PetscInt k = next; k + 1 < n; ++k) {
      for (PetscInt d = 0; d < 2; ++d) {
        polygon[k][d] = polygon[k + 1][d];
        edge[k][d]    = edge[k + 1][d];
      }
    }
    if (!next) i = n; /* The last vertex has replaced the first, and all other vertices have been tested. */
    --n;
  }
  return n;
}

/*
   Attributes those edges of the polygon that lie on edges of both facets to the nonmortar facet. The derivative is then
   the same on either side of such an edge, and an edge between two mortar facets does not end an overlap. nmortar:
   number of edges of the mortar facet; part: the nonmortar part with `size` vertices
*/
static void OverlapShareEdges(PetscInt n, const PetscReal polygon[][2], PetscInt nmortar, PetscInt size,
  const PetscReal part[4][2], PetscInt edge[][2])
{
  for (PetscInt i = 0; i < n; ++i) {
    const PetscInt next = (i + 1) % n;

    for (PetscInt e = 0; edge[i][1] < nmortar && e < size; ++e) {
      const PetscReal *a = part[e], *b = part[(e + 1) % size];

      if (OverlapIsOnLine(a, b, polygon[i]) && OverlapIsOnLine(a, b, polygon[next]))
        edge[i][1] = edge[next][0] = nmortar + e;
    }
  }
}

/* Appends the corners of the polygon to the overlap. vertex: numbers, within the nonmortar facet, of the `size`
   vertices of its clipped part */
static void OverlapKeepCorners(PetscInt n, const PetscReal polygon[][2], PetscInt nmortar, const PetscInt edge[][2],
  PetscInt size, const PetscInt vertex[], ContactOverlap *o)
{
  for (PetscInt i = 0; i < n; ++i) {
    ContactCorner *corner = &o->corner[o->ncorners++];

    for (PetscInt d = 0; d < 2; ++d) corner->y[d] = polygon[i][d];
    for (PetscInt k = 0; k < 2; ++k) {
      const PetscInt e = edge[i][k];

      for (PetscInt v = 0; v < 2; ++v)
        corner->line[k][v] = e < nmortar ? 4 + nmortar - 1 - (e + v) % nmortar : vertex[(e - nmortar + v) % size];
    }
  }
}

/* Returns which of the n vertices vertex[] of the polygon is nearest to y */
static PetscInt OverlapNearestVertex(PetscInt n, const PetscInt vertex[], const PetscReal polygon[][2],
  const PetscReal y[2])
{
  PetscReal least   = PETSC_MAX_REAL;
  PetscInt  nearest = 0;

  for (PetscInt i = 0; i < n; ++i) {
    const PetscReal *p      = polygon[vertex[i]];
    const PetscReal  square = PetscSqr(p[0] - y[0]) + PetscSqr(p[1] - y[1]);

    if (square < least) {
      least   = square;
      nearest = i;
    }
  }
  return nearest;
}

/* What the quadrature points of an overlap are computed from */
typedef struct {
  const ContactRule     *rule;
  const ContactBilinear *map1, *map2; /* the nonmortar and the mortar facet */
  PetscReal              sign;        /* sign of the nonmortar facet's convex part */
  PetscReal              bound;       /* bound of the parameters on the mortar facet */
} OverlapQuadrature;

/* Adds the quadrature points of the triangle of the polygon's vertices v. first: number of the polygon's first corner
   in the overlap */
static void OverlapAddTriangle(const OverlapQuadrature *use, const PetscReal polygon[][2], PetscInt first,
  const PetscInt v[3], ContactOverlap *o)
{
  PetscReal tri[3][2], area;

  for (PetscInt i = 0; i < 3; ++i) {
    for (PetscInt d = 0; d < 2; ++d) tri[i][d] = polygon[v[i]][d];
  }
  area = use->sign * ContactPolygonArea(3, (const PetscReal(*)[2])tri);
  /* Triangles without area are included, because their derivatives need not be zero. */
  o->area += area;
  o->triangle[o->ntriangles++] = (ContactTriangle){{first + v[0], first + v[1], first + v[2]}, use->sign};
  for (PetscInt q = 0; q < use->rule->n; ++q) {
    PetscReal y[2] = {0.0, 0.0};

    for (PetscInt i = 0; i < 3; ++i) {
      for (PetscInt d = 0; d < 2; ++d) y[d] += use->rule->barycentric[q][i] * tri[i][d];
    }
    o->weight[o->n] = area * use->rule->weight[q];
    ContactInverseMap(use->map1, y, 1.0, o->xi1[o->n]);
    ContactInverseMap(use->map2, y, use->bound, o->xi2[o->n]);
    ++o->n;
  }
}

/*
   Cuts off those vertices of the polygon that lie on the line between their neighbours, each with the triangle of the
   three, whose quadrature points are added. Where edges of the two facets coincide, rounding decides whether and where
   they intersect; such vertices must not determine the large triangles. left: numbers of the vertices that remain.
   Returns their number.
*/
static PetscInt OverlapCutCollinear(const OverlapQuadrature *use, PetscInt n, const PetscReal polygon[][2],
  PetscInt first, PetscInt left[], ContactOverlap *o)
{
  for (PetscInt i = 0; i < n; ++i) left[i] = i;
  for (PetscInt i = 0; i < n && n > 3;) {
    const PetscInt v[3] = {left[(i + n - 1) % n], left[i], left[(i + 1) % n]};

    if (OverlapIsOnLine(polygon[v[0]], polygon[v[2]], polygon[v[1]])) {
      OverlapAddTriangle(use, polygon, first, v, o);
      for (PetscInt k = i; k + 1 < n; ++k) left[k] = left[k + 1];
      --n;
    } else ++i;
  }
  return n;
}

/*
   Adds the quadrature points of a polygon, which is divided into triangles. They connect one vertex, the apex, with the
   edges of the polygon. The apex is the vertex nearest to a nonmortar vertex, because rounding decides which vertex of
   the polygon comes first. The error of the quadrature would otherwise depend on rounding, and contact updates would
   not converge.
*/
static void OverlapAddPolygon(const OverlapQuadrature *use, PetscInt nvertices, const PetscReal polygon[][2],
  PetscInt first, ContactOverlap *o)
{
  PetscInt       left[CONTACT_MAX_POLYGON];
  const PetscInt n    = OverlapCutCollinear(use, nvertices, polygon, first, left, o);
  const PetscInt apex = OverlapNearestVertex(n, left, polygon, use->map1->q[0]);

  for (PetscInt t = 1; t + 1 < n; ++t) {
    const PetscInt v[3] = {left[apex], left[(apex + t) % n], left[(apex + t + 1) % n]};

    OverlapAddTriangle(use, polygon, first, v, o);
  }
}

/* Returns the mean height of the mortar facet above the nonmortar facet over the overlap [length] */
static PetscReal OverlapMeanGap(const ContactOverlap *o, const PetscReal h1[4], const PetscReal h2[4])
{
  PetscReal gap = 0.0;

  for (PetscInt q = 0; q < o->n; ++q) {
    PetscReal phi1[4], phi2[4];

    ContactShape(o->xi1[q], phi1);
    ContactShape(o->xi2[q], phi2);
    for (PetscInt a = 0; a < 4; ++a) gap += o->weight[q] * (phi2[a] * h2[a] - phi1[a] * h1[a]);
  }
  return gap / o->area;
}

/*
   Stores the vertices of the mortar facet, projected onto the plane, in counterclockwise order. They are clockwise in
   p2, because the mortar facet is seen from inside its body. If both facets have edges on the borders of their faces,
   the mortar facet may be extended a little beyond its border. Returns whether it was. Triangles are never extended.
*/
static PetscBool OverlapPutMortar(const PetscReal p1[4][2], PetscInt border1, PetscInt nmortar,
  const PetscReal p2[4][2], PetscInt border2, PetscReal reversed[4][2])
{
  PetscInt border = 0;

  for (PetscInt a = 0; a < nmortar; ++a) {
    for (PetscInt d = 0; d < 2; ++d) reversed[a][d] = p2[nmortar - 1 - a][d];
  }
  if (nmortar < 4 || !(border1 & 15) || !(border2 & 15)) return PETSC_FALSE;
  /* The edge e of the reversed facet is the edge from vertex 3 - e to vertex 2 - e of the mortar facet. */
  for (PetscInt e = 0; e < 4; ++e) border |= (border2 >> (6 - e) % 4 & 1) << e;
  return ContactExtendBorder(p1, border1, border, reversed);
}

/*
   Finds the overlap of the nonmortar facet x1 and the mortar facet x2. Projects both onto the plane through the centre
   of x1 perpendicular to its mean normal, clips one by the other, and places quadrature points. Returns false if the
   facets do not overlap within the limits. border1 and border2: bits of the edges on the border of a face, as in
   ContactSurface
*/
PetscBool ContactOverlapFindAtBorder(const PetscReal x1[12], PetscInt border1, const PetscReal x2[12], PetscInt border2,
  const ContactOverlapLimits *limits, const ContactRule *rule, ContactOverlap *o)
{
  const PetscInt    nmortar = ContactFacetIsTriangle(x2) ? 3 : 4;
  PetscReal         n2[3], p1[4][2], p2[4][2], reversed[4][2], h1[4], h2[4], part[2][4][2], sign[2], smaller;
  PetscInt          size[2], vertex[2][4], nparts;
  ContactFrame      frame;
  ContactBilinear   map[2];
  OverlapQuadrature use = {.rule = rule, .map1 = &map[0], .map2 = &map[1], .bound = 1.0};

  o->n = o->ncorners = o->ntriangles = 0;
  o->area                            = 0.0;
  if (!ContactFrameCreate(x1, &frame) || !ContactFacetNormal(x2, n2)) return PETSC_FALSE;
  if (n2[0] * frame.axis[2][0] + n2[1] * frame.axis[2][1] + n2[2] * frame.axis[2][2] > limits->cosine)
    return PETSC_FALSE;
  ContactFrameProject(&frame, x1, p1, h1);
  ContactFrameProject(&frame, x2, p2, h2);
  if (OverlapPutMortar((const PetscReal(*)[2])p1, border1, nmortar, (const PetscReal(*)[2])p2, border2, reversed))
    use.bound = 1.5; /* an edge moves by at most a fifth of the facet's size: parameters on a rectangle are below 1.4 */
  smaller = PetscMin(PetscAbsReal(ContactPolygonArea(4, p1)), PetscAbsReal(ContactPolygonArea(nmortar, reversed)));
  nparts  = OverlapConvexParts(p1, size, part, vertex, sign);
  ContactBilinearCreate(p1, &map[0]);
  ContactBilinearCreate(p2, &map[1]);
  for (PetscInt k = 0; k < nparts; ++k) {
    PetscReal polygon[CONTACT_MAX_POLYGON][2];
    PetscInt  edge[CONTACT_MAX_POLYGON][2];
    PetscInt  n = ContactClip(nmortar, reversed, size[k], part[k], polygon, edge);

    n = OverlapMergeVertices(n, PetscSqrtReal(smaller), polygon, edge);
    if (n < 3 || !(PetscAbsReal(ContactPolygonArea(n, polygon)) > limits->overlap_drop * smaller)) continue;
    OverlapShareEdges(n, polygon, nmortar, size[k], part[k], edge);
    OverlapKeepCorners(n, polygon, nmortar, edge, size[k], vertex[k], o);
    use.sign = sign[k];
    OverlapAddPolygon(&use, n, (const PetscReal(*)[2])polygon, o->ncorners - n, o);
  }
  if (!(o->area > 0.0)) return PETSC_FALSE;
  o->gap = OverlapMeanGap(o, h1, h2);
  return (PetscBool)(o->gap <= limits->distance && o->gap >= -limits->depth);
}

/* Finds the overlap of two facets without extending the mortar facet beyond the border of its face */
PetscBool ContactOverlapFind(const PetscReal x1[12], const PetscReal x2[12], const ContactOverlapLimits *limits,
  const ContactRule *rule, ContactOverlap *o)
{
  return ContactOverlapFindAtBorder(x1, 0, x2, 0, limits, rule, o);
}
