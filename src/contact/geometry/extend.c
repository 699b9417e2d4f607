/* Faces whose borders coincide: the mortar face is continued beyond its border by a small margin. Otherwise the covered
   area would have a kink where the borders cross, and contact updates would not converge there. */
#include "geometryimpl.h"

/* margin, as a fraction of the size of the smaller facet across its border */
#define EXTEND_MARGIN 0.1
/* a segment is beside an edge up to this fraction of the edge's length beyond its ends */
#define EXTEND_BESIDE 1e-3
/* cosine of the angle above which two border edges count as parallel */
#define EXTEND_PARALLEL 0.9

/* An edge of a polygon whose vertices are counterclockwise */
typedef struct {
  PetscReal from[2], out[2]; /* start; unit vector outwards */
  PetscReal length, across;  /* length of the edge; size of the polygon across it */
} PolygonEdge;

static PetscBool PolygonEdgeCreate(PetscInt n, const PetscReal p[][2], PetscInt e, PolygonEdge *edge)
{
  const PetscReal *a = p[e], *b = p[(e + 1) % n], d[2] = {b[0] - a[0], b[1] - a[1]};

  edge->length = PetscSqrtReal(d[0] * d[0] + d[1] * d[1]);
  if (!(edge->length > 0.0)) return PETSC_FALSE;
  for (PetscInt c = 0; c < 2; ++c) edge->from[c] = a[c];
  edge->out[0] = d[1] / edge->length;
  edge->out[1] = -d[0] / edge->length;
  edge->across = PetscAbsReal(ContactPolygonArea(n, p)) / edge->length;
  return PETSC_TRUE;
}

/* How far the segment from p to q reaches beyond the line of an edge, for the part of the segment that lies beside the
   edge. Neighbouring mortar facets get nearly the same value where they meet. *beside: whether any part does */
static PetscReal EdgeOverhang(const PolygonEdge *edge, const PetscReal p[2], const PetscReal q[2], PetscBool *beside)
{
  const PetscReal along[2] = {-edge->out[1], edge->out[0]}, low = -EXTEND_BESIDE * edge->length;
  const PetscReal high = (1.0 + EXTEND_BESIDE) * edge->length;
  PetscReal       s[2] = {0.0, 0.0}, h[2] = {0.0, 0.0}, overhang = PETSC_MIN_REAL;

  for (PetscInt c = 0; c < 2; ++c) {
    s[0] += (p[c] - edge->from[c]) * along[c];
    s[1] += (q[c] - edge->from[c]) * along[c];
    h[0] += (p[c] - edge->from[c]) * edge->out[c];
    h[1] += (q[c] - edge->from[c]) * edge->out[c];
  }
  *beside = (PetscBool)(PetscMin(s[0], s[1]) <= high && PetscMax(s[0], s[1]) >= low);
  for (PetscInt v = 0; v < 2; ++v) {
    const PetscReal t = s[1] != s[0] ? (PetscClipInterval(s[v], low, high) - s[0]) / (s[1] - s[0]) : (PetscReal)v;

    overhang = PetscMax(overhang, h[0] + t * (h[1] - h[0]));
  }
  return overhang;
}

/* How far an edge of the mortar facet is moved outwards: beyond the nonmortar border if both are closer than the
   margin, else not at all. No corner of an overlap lies on a moved edge, so that derivatives need not include it. */
static PetscReal ExtendBy(const PolygonEdge *edge, const PetscReal p1[4][2], PetscInt border1)
{
  PetscReal by = 0.0;

  for (PetscInt e = 0; e < 4; ++e) {
    PolygonEdge other;
    PetscReal   overhang, margin;
    PetscBool   beside;

    if (!(border1 >> e & 1) || !PolygonEdgeCreate(4, p1, e, &other)) continue;
    if (edge->out[0] * other.out[0] + edge->out[1] * other.out[1] < EXTEND_PARALLEL) continue;
    overhang = EdgeOverhang(edge, p1[e], p1[(e + 1) % 4], &beside);
    margin   = EXTEND_MARGIN * PetscMin(edge->across, other.across);
    if (beside && PetscAbsReal(overhang) <= margin) by = PetscMax(by, 2.0 * margin);
  }
  return by;
}

/*
   Moves the border edges of a mortar facet outwards, where the border of the nonmortar facet p1 is near. The
   facet's other edges are continued, so that neighbouring facets still meet. Both are projected to one plane with
   vertices counterclockwise. Bit e of a border: edge e, from vertex e, is on the border of its face. Returns whether
   any edge has moved.
*/
PetscBool ContactExtendBorder(const PetscReal p1[4][2], PetscInt border1, PetscInt border2, PetscReal p2[4][2])
{
  PetscReal shift[4][2] = {{0.0}};
  PetscBool moved       = PETSC_FALSE;

  for (PetscInt e = 0; e < 4; ++e) {
    PolygonEdge edge;
    PetscReal   by;

    if (!(border2 >> e & 1) || !PolygonEdgeCreate(4, (const PetscReal(*)[2])p2, e, &edge)) continue;
    by = ExtendBy(&edge, p1, border1);
    if (by > 0.0) moved = PETSC_TRUE;
    for (PetscInt v = 0; by > 0.0 && v < 2; ++v) {
      const PetscInt  i = (e + v) % 4, inner = (e + 3 * (1 - v) + 2 * v) % 4;
      const PetscReal side[2]  = {p2[i][0] - p2[inner][0], p2[i][1] - p2[inner][1]};
      const PetscReal outwards = side[0] * edge.out[0] + side[1] * edge.out[1];

      for (PetscInt c = 0; outwards > 0.0 && c < 2; ++c) shift[i][c] += by * side[c] / outwards;
    }
  }
  for (PetscInt i = 0; i < 8; ++i) p2[i / 2][i % 2] += shift[i / 2][i % 2];
  return moved;
}
