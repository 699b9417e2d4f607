/*
   Extends a mortar face beyond its border by a small margin, where the border of the nonmortar face coincides with it.
   Without this margin the overlap area would have a kink as a function of the displacement where the two borders cross,
   and contact updates would not converge there.
*/
#include "geometryimpl.h"

/* margin by which a border may differ, as a fraction of the size of the smaller facet perpendicular to its border
   edge */
#define EXTEND_MARGIN 0.1
/* a segment counts as beside an edge up to this fraction of the edge's length beyond the edge's ends */
#define EXTEND_BESIDE 1e-3
/* two border edges count as parallel if the cosine of the angle between their outward normals is at least this */
#define EXTEND_PARALLEL 0.9

/* An edge of a polygon whose vertices are counterclockwise */
typedef struct {
  PetscReal from[2], out[2]; /* start, and unit normal that points out of the polygon */
  PetscReal length, across;  /* length of the edge, and size of the polygon perpendicular to the edge [length] */
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

/*
   Returns how far [length] the segment from p to q reaches beyond the line of an edge. Only the part of the segment
   that lies beside the edge counts; *beside says whether there is such a part. Where two neighbouring mortar facets
   meet, they get nearly equal values.
*/
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

/*
   Returns by how much [length] an edge of the mortar facet is moved outwards: 2 margins if an edge of the nonmortar
   border lies within one margin of it, else 0. The moved edge then lies outside the nonmortar facet. No corner of the
   overlap lies on it, so that the derivatives of the overlap need not include its motion.
*/
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
   Moves the border edges of the mortar facet p2 outwards where the border of the nonmortar facet p1 is near. Both
   facets are projected onto one plane, with counterclockwise vertices. The vertices move along the facet's other edges,
   so that neighbouring facets still meet. Bit e of border1 and border2 is set if the edge from vertex e to the next is
   on the border of its face. Returns whether any edge was moved.
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
