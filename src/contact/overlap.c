/* Where two facets face each other: projection, clipping, quadrature points on both */
#include "contactimpl.h"

/*
  Convex parts of a quadrilateral, counterclockwise: itself, or two triangles where a corner is reflex. Where its edges cross
  (two reflex corners, if only by rounding) one of the triangles is clockwise: it is reversed, and counts negatively.
*/
static PetscInt OverlapConvexParts(const PetscReal p[4][2], PetscInt size[2], PetscReal part[2][4][2], PetscReal sign[2])
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
    sign[k] = ContactPolygonArea(size[k], (const PetscReal(*)[2])part[k]) < 0.0 ? -1.0 : 1.0;
    for (PetscInt d = 0; sign[k] < 0.0 && d < 2; ++d) {
      const PetscReal swap = part[k][1][d];

      part[k][1][d] = part[k][2][d];
      part[k][2][d] = swap;
    }
  }
  return reflex < 0 ? 1 : 2;
}

/* Adds the points of the fan of triangles about the polygon's first vertex, with this sign */
static void OverlapAddPolygon(const ContactRule *rule, PetscReal sign, PetscInt n, const PetscReal polygon[][2], const PetscReal p1[4][2], const PetscReal p2[4][2], ContactOverlap *o)
{
  for (PetscInt t = 1; t + 1 < n; ++t) {
    const PetscReal tri[3][2] = {
      {polygon[0][0], polygon[0][1]},
      {polygon[t][0], polygon[t][1]},
      {polygon[t + 1][0], polygon[t + 1][1]},
    };
    const PetscReal area = sign * ContactPolygonArea(3, tri);

    if (area == 0.0) continue;
    o->area += area;
    for (PetscInt q = 0; q < rule->n; ++q) {
      PetscReal y[2] = {0.0, 0.0};

      for (PetscInt v = 0; v < 3; ++v) {
        for (PetscInt d = 0; d < 2; ++d) y[d] += rule->barycentric[q][v] * tri[v][d];
      }
      o->weight[o->n] = area * rule->weight[q];
      ContactInverseMap(p1, y, o->xi1[o->n]);
      ContactInverseMap(p2, y, o->xi2[o->n]);
      ++o->n;
    }
  }
}

/* Height of the mortar facet over the nonmortar one, averaged over the overlap */
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
  Projects both facets to the plane of the nonmortar facet x1 (through its centre, along its mean normal), clips, and
  places the quadrature points. False where the facets do not face each other within the limits or hardly overlap.
*/
PetscBool ContactOverlapFind(const PetscReal x1[12], const PetscReal x2[12], const ContactOverlapLimits *limits, const ContactRule *rule, ContactOverlap *o)
{
  PetscReal    n2[3], p1[4][2], p2[4][2], reversed[4][2], h1[4], h2[4], part[2][4][2], sign[2], smaller, gap;
  PetscInt     size[2], nparts;
  ContactFrame frame;

  o->n    = 0;
  o->area = 0.0;
  if (!ContactFrameCreate(x1, &frame) || !ContactFacetNormal(x2, n2)) return PETSC_FALSE;
  if (n2[0] * frame.axis[2][0] + n2[1] * frame.axis[2][1] + n2[2] * frame.axis[2][2] > limits->cosine) return PETSC_FALSE;
  ContactFrameProject(&frame, x1, p1, h1);
  ContactFrameProject(&frame, x2, p2, h2);
  for (PetscInt a = 0; a < 4; ++a) { /* the mortar facet is seen from inside its body: clockwise */
    reversed[a][0] = p2[3 - a][0];
    reversed[a][1] = p2[3 - a][1];
  }
  smaller = PetscMin(PetscAbsReal(ContactPolygonArea(4, p1)), PetscAbsReal(ContactPolygonArea(4, reversed)));
  nparts  = OverlapConvexParts(p1, size, part, sign);
  for (PetscInt k = 0; k < nparts; ++k) {
    PetscReal      polygon[CONTACT_MAX_POLYGON][2];
    const PetscInt n = ContactClip(4, reversed, size[k], part[k], polygon);

    if (n && PetscAbsReal(ContactPolygonArea(n, polygon)) > limits->overlap_drop * smaller) OverlapAddPolygon(rule, sign[k], n, polygon, p1, p2, o);
  }
  if (!(o->area > 0.0)) return PETSC_FALSE;
  gap = OverlapMeanGap(o, h1, h2);
  return (PetscBool)(gap <= limits->distance && gap >= -limits->depth);
}
