/* Where two facets face each other: projection, clipping, quadrature points on both */
#include "contactimpl.h"

/* Orthonormal frame of the plane through a facet's centre along its mean normal */
typedef struct {
  PetscReal origin[3], t1[3], t2[3], normal[3];
} Frame;

static PetscReal Dot(const PetscReal a[3], const PetscReal b[3])
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static PetscBool FrameCreate(const PetscReal x[12], const PetscReal normal[3], Frame *f)
{
  PetscReal length;

  for (PetscInt c = 0; c < 3; ++c) {
    f->origin[c] = 0.25 * (x[c] + x[3 + c] + x[6 + c] + x[9 + c]);
    f->normal[c] = normal[c];
    f->t1[c]     = x[6 + c] - x[c]; /* a diagonal: in the plane, for the normal is the diagonals' cross product */
  }
  length = PetscSqrtReal(Dot(f->t1, f->t1));
  if (!(length > 0.0)) return PETSC_FALSE;
  for (PetscInt c = 0; c < 3; ++c) f->t1[c] /= length;
  f->t2[0] = normal[1] * f->t1[2] - normal[2] * f->t1[1];
  f->t2[1] = normal[2] * f->t1[0] - normal[0] * f->t1[2];
  f->t2[2] = normal[0] * f->t1[1] - normal[1] * f->t1[0];
  return PETSC_TRUE;
}

/* Plane coordinates of a facet's vertices, and their heights above the plane */
static void Project(const Frame *f, const PetscReal x[12], PetscReal p[4][2], PetscReal height[4])
{
  for (PetscInt a = 0; a < 4; ++a) {
    const PetscReal d[3] = {x[3 * a] - f->origin[0], x[3 * a + 1] - f->origin[1], x[3 * a + 2] - f->origin[2]};

    p[a][0]   = Dot(d, f->t1);
    p[a][1]   = Dot(d, f->t2);
    height[a] = Dot(d, f->normal);
  }
}

static PetscBool UnitNormal(const PetscReal x[12], PetscReal n[3])
{
  PetscReal area;

  ContactFacetAreaVector(x, n);
  area = PetscSqrtReal(Dot(n, n));
  if (!(area > 0.0)) return PETSC_FALSE;
  for (PetscInt c = 0; c < 3; ++c) n[c] /= area;
  return PETSC_TRUE;
}

/* Convex parts of a quadrilateral: itself, or two triangles where a corner is reflex */
static PetscInt ConvexParts(const PetscReal p[4][2], PetscInt size[2], PetscReal part[2][4][2])
{
  PetscInt reflex = -1;

  for (PetscInt a = 0; a < 4; ++a) {
    const PetscReal *l = p[(a + 3) % 4], *m = p[a], *r = p[(a + 1) % 4];

    if ((m[0] - l[0]) * (r[1] - m[1]) - (m[1] - l[1]) * (r[0] - m[0]) < 0.0) reflex = a;
  }
  for (PetscInt k = 0; k < 2; ++k) {
    const PetscInt first = reflex < 0 ? 0 : reflex + 2 * k;

    size[k] = reflex < 0 ? 4 : 3;
    for (PetscInt i = 0; i < size[k]; ++i) {
      part[k][i][0] = p[(first + i) % 4][0];
      part[k][i][1] = p[(first + i) % 4][1];
    }
  }
  return reflex < 0 ? 1 : 2;
}

/* Adds the points of the fan of triangles about the polygon's centroid */
static void AddPolygon(PetscInt n, const PetscReal polygon[][2], const PetscReal p1[4][2], const PetscReal p2[4][2], ContactOverlap *o)
{
  PetscReal barycentric[CONTACT_TRIANGLE_POINTS][3], weight[CONTACT_TRIANGLE_POINTS], centre[2];

  ContactTriangleRule(barycentric, weight);
  ContactPolygonCentroid(n, polygon, centre);
  for (PetscInt t = 0; t < n; ++t) {
    const PetscReal tri[3][2] = {
      {centre[0],                  centre[1]                 },
      {polygon[t][0],              polygon[t][1]             },
      {polygon[(t + 1) % n][0],    polygon[(t + 1) % n][1]   }
    };
    const PetscReal area = ContactPolygonArea(3, tri);

    if (area == 0.0) continue;
    o->area += area;
    for (PetscInt q = 0; q < CONTACT_TRIANGLE_POINTS; ++q) {
      PetscReal y[2] = {0.0, 0.0};

      for (PetscInt v = 0; v < 3; ++v) {
        for (PetscInt d = 0; d < 2; ++d) y[d] += barycentric[q][v] * tri[v][d];
      }
      o->weight[o->n] = area * weight[q];
      ContactInverseMap(p1, y, o->xi1[o->n]);
      ContactInverseMap(p2, y, o->xi2[o->n]);
      ++o->n;
    }
  }
}

/* Height of the mortar facet over the nonmortar one, averaged over the overlap */
static PetscReal MeanGap(const ContactOverlap *o, const PetscReal h1[4], const PetscReal h2[4])
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
  Projects both facets to the plane of the nonmortar facet x1 (through its centre, along its mean normal), clips, and
  places the quadrature points. False where the facets do not face each other within the limits or hardly overlap.
*/
PetscBool ContactOverlapFind(const PetscReal x1[12], const PetscReal x2[12], const ContactOverlapLimits *limits, ContactOverlap *o)
{
  PetscReal n1[3], n2[3], p1[4][2], p2[4][2], reversed[4][2], h1[4], h2[4], part[2][4][2], smaller, gap;
  PetscInt  size[2], nparts;
  Frame     frame;

  o->n    = 0;
  o->area = 0.0;
  if (!UnitNormal(x1, n1) || !UnitNormal(x2, n2)) return PETSC_FALSE;
  if (Dot(n1, n2) > limits->cosine || !FrameCreate(x1, n1, &frame)) return PETSC_FALSE;
  Project(&frame, x1, p1, h1);
  Project(&frame, x2, p2, h2);
  for (PetscInt a = 0; a < 4; ++a) { /* the mortar facet is seen from inside its body: clockwise */
    reversed[a][0] = p2[3 - a][0];
    reversed[a][1] = p2[3 - a][1];
  }
  smaller = PetscMin(ContactPolygonArea(4, p1), ContactPolygonArea(4, reversed));
  nparts  = ConvexParts(p1, size, part);
  for (PetscInt k = 0; k < nparts; ++k) {
    PetscReal      polygon[CONTACT_MAX_POLYGON][2];
    const PetscInt n = ContactClip(4, reversed, size[k], part[k], polygon);

    if (n && ContactPolygonArea(n, polygon) > limits->overlap_drop * smaller) AddPolygon(n, polygon, p1, p2, o);
  }
  if (!(o->area > 0.0)) return PETSC_FALSE;
  gap = MeanGap(o, h1, h2);
  return (PetscBool)(gap <= limits->distance && gap >= -limits->depth);
}
