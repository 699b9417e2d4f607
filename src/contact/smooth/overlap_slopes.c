/*
   The weighted gap between two smooth surfaces over an overlap, int phi_A (H2 - H1), and the covered area int phi_A. H1
   and H2 are the heights of the surfaces above the plane of the nonmortar facet. The derivatives include everything
   that moves: positions and weights of the quadrature points, the plane, and the patches. A rigid motion changes none
   of the quantities in the plane's own axes. Hence forces computed from these derivatives, and their moments, balance
   up to rounding.
*/
#include "smoothimpl.h"

/* Two lines count as parallel if the sine of the angle between them is smaller. Their intersection would be too
   inaccurate. */
#define PARALLEL 5e-3

/* Two facets in the plane of the nonmortar facet */
typedef struct {
  ContactFrame        frame;
  const ContactPatch *patch[2];                 /* patches of the nonmortar and of the mortar facet */
  PetscReal           p[2][4][2], height[2][4]; /* coordinates of the vertices in the plane, and heights above it
                                                   [length] */
} PlanePair;

/* Derivatives of a quantity with respect to the positions, in the plane's axes, of the facets' vertices and of the
   corners of the overlap */
typedef struct {
  PetscReal p[2][4][2], corner[CONTACT_MAX_CORNERS][2];
} PlaneMotion;

/* Derivatives of one row's weighted gap and of its covered area */
typedef struct {
  PlaneMotion gap, cover;
  PetscReal   height[2][4]; /* derivatives of the gap with respect to the heights of the vertices above the plane */
  PetscReal   turn[3];      /* derivatives of the gap with respect to a rotation of the mortar patch [length^3] */
} PlaneSlopes;

/* A quadrature point on one facet, in the plane's axes. Slopes are derivatives with respect to its position in the
   plane. */
typedef struct {
  PetscReal phi[4], slope[4][2]; /* shape functions and their slopes */
  PetscReal height, tilt[2];     /* height of the smooth surface above the plane, and its slopes */
  PetscReal turn[3];             /* derivatives of the height with respect to a rotation of the patch */
} PlanePoint;

/* Converts derivatives with respect to the parameters xi into derivatives with respect to the position in the plane. J:
   derivative of the position with respect to xi */
static void PlaneGradient(const PetscReal J[2][2], const PetscReal by_xi[2], PetscReal gradient[2])
{
  const PetscReal det = J[0][0] * J[1][1] - J[0][1] * J[1][0];

  gradient[0] = det != 0.0 ? (J[1][1] * by_xi[0] - J[1][0] * by_xi[1]) / det : 0.0;
  gradient[1] = det != 0.0 ? (J[0][0] * by_xi[1] - J[0][1] * by_xi[0]) / det : 0.0;
}

/* Returns the height of the smooth surface of one side (0 nonmortar, 1 mortar) above the plane at the parameters xi
   [length], and computes the shape functions there */
static PetscReal PlanePointHeight(const PlanePair *pair, PetscInt side, const PetscReal xi[2], PetscReal phi[4])
{
  PetscReal height = ContactPatchHeight(pair->patch[side], xi, pair->frame.axis[2], NULL, NULL);

  ContactShape(xi, phi);
  for (PetscInt a = 0; a < 4; ++a) height += phi[a] * pair->height[side][a];
  return height;
}

/* Evaluates a quadrature point with the parameters xi on one side (0 nonmortar, 1 mortar) */
static void PlanePointEvaluate(const PlanePair *pair, PetscInt side, const PetscReal xi[2], PlanePoint *point)
{
  PetscReal dphi[4][2], J[2][2] = {{0}}, by_xi[2];

  ContactShape(xi, point->phi);
  ContactShapeSlopes(xi, dphi);
  point->height = ContactPatchHeight(pair->patch[side], xi, pair->frame.axis[2], by_xi, point->turn);
  for (PetscInt a = 0; a < 4; ++a) {
    point->height += point->phi[a] * pair->height[side][a];
    for (PetscInt k = 0; k < 2; ++k) {
      by_xi[k] += dphi[a][k] * pair->height[side][a];
      for (PetscInt d = 0; d < 2; ++d) J[d][k] += dphi[a][k] * pair->p[side][a][d];
    }
  }
  PlaneGradient(J, by_xi, point->tilt);
  for (PetscInt a = 0; a < 4; ++a) PlaneGradient(J, dphi[a], point->slope[a]);
}

/* Adds the derivatives at one quadrature point to those of row a's weighted gap, and returns the point's part of the
   gap [length^3]. place: derivative of the gap with respect to the point's position in the plane */
static PetscReal AddPoint(const PlanePoint point[2], PetscInt a, PetscReal weight, PlaneSlopes *by, PetscReal place[2])
{
  const PetscReal gap = point[1].height - point[0].height, share = weight * point[0].phi[a];
  PetscReal       own[2];

  for (PetscInt d = 0; d < 2; ++d) {
    own[d]   = weight * gap * point[0].slope[a][d] - share * point[0].tilt[d];
    place[d] = own[d] + share * point[1].tilt[d];
  }
  for (PetscInt b = 0; b < 4; ++b) {
    by->height[0][b] -= share * point[0].phi[b];
    by->height[1][b] += share * point[1].phi[b];
    for (PetscInt d = 0; d < 2; ++d) {
      by->gap.p[0][b][d] -= point[0].phi[b] * own[d];
      by->gap.p[1][b][d] -= point[1].phi[b] * share * point[1].tilt[d];
    }
  }
  for (PetscInt c = 0; c < 3; ++c) by->turn[c] += share * point[1].turn[c];
  return share * gap;
}

/* Adds the derivatives at one quadrature point to those of row a's covered area, and returns the point's part of the
   area [length^2]. place: derivative with respect to the point's position in the plane */
static PetscReal AddPointCover(const PlanePoint *point, PetscInt a, PetscReal weight, PlaneMotion *by,
  PetscReal place[2])
{
  for (PetscInt d = 0; d < 2; ++d) {
    place[d] = weight * point->slope[a][d];
    for (PetscInt b = 0; b < 4; ++b) by->p[0][b][d] -= point->phi[b] * place[d];
  }
  return weight * point->phi[a];
}

/* Distributes `place`, the derivative with respect to a point of a triangle, to the triangle's corners by its
   barycentric coordinates */
static void AddPlace(const ContactTriangle *triangle, const PetscReal barycentric[3], const PetscReal place[2],
  PlaneMotion *by)
{
  for (PetscInt v = 0; v < 3; ++v) {
    for (PetscInt d = 0; d < 2; ++d) by->corner[triangle->corner[v]][d] += barycentric[v] * place[d];
  }
}

/* Adds the derivative with respect to a triangle's area. mean: the integral over the triangle divided by its area */
static void AddArea(const ContactOverlap *o, const ContactTriangle *triangle, PetscReal mean, PlaneMotion *by)
{
  for (PetscInt v = 0; v < 3; ++v) {
    const PetscReal *from   = o->corner[triangle->corner[(v + 1) % 3]].y,
                    *to     = o->corner[triangle->corner[(v + 2) % 3]].y;
    const PetscReal turn[2] = {from[1] - to[1], to[0] - from[0]}; /* derivative of twice the area */

    for (PetscInt d = 0; d < 2; ++d) by->corner[triangle->corner[v]][d] += 0.5 * triangle->sign * mean * turn[d];
  }
}

/* Adds the points of triangle t and the derivative with respect to its area, which is not zero even if the area is */
static void AddTriangle(const ContactOverlap *o, const ContactRule *rule, PetscInt t, const PlanePair *pair,
  PetscReal gap[4], PetscReal cover[4], PlaneSlopes by[4])
{
  const ContactTriangle *triangle = &o->triangle[t];
  PetscReal              mean[4] = {0}, mean_cover[4] = {0};

  for (PetscInt q = 0; q < rule->n; ++q) {
    const PetscInt k = t * rule->n + q;
    PlanePoint     point[2];

    PlanePointEvaluate(pair, 0, o->xi1[k], &point[0]);
    PlanePointEvaluate(pair, 1, o->xi2[k], &point[1]);
    for (PetscInt a = 0; a < 4; ++a) {
      PetscReal place[2];

      gap[a] += AddPoint(point, a, o->weight[k], &by[a], place);
      AddPlace(triangle, rule->barycentric[q], place, &by[a].gap);
      cover[a] += AddPointCover(&point[0], a, o->weight[k], &by[a].cover, place);
      AddPlace(triangle, rule->barycentric[q], place, &by[a].cover);
      mean[a] += rule->weight[q] * point[0].phi[a] * (point[1].height - point[0].height);
      mean_cover[a] += rule->weight[q] * point[0].phi[a];
    }
  }
  for (PetscInt a = 0; a < 4; ++a) {
    AddArea(o, triangle, mean[a], &by[a].gap);
    AddArea(o, triangle, mean_cover[a], &by[a].cover);
  }
}

/* Distributes `force`, the derivative with respect to a corner that moves with its line k, to the two vertices of that
   line */
static void MoveLine(const PlanePair *pair, const ContactCorner *corner, PetscInt k, const PetscReal force[2],
  PlaneMotion *by)
{
  const PetscInt   from = corner->line[k][0], to = corner->line[k][1];
  const PetscReal *x = pair->p[from / 4][from % 4], *y = pair->p[to / 4][to % 4], d[2] = {y[0] - x[0], y[1] - x[1]};
  const PetscReal  size = d[0] * d[0] + d[1] * d[1],
                  s     = size > 0.0 ? ((corner->y[0] - x[0]) * d[0] + (corner->y[1] - x[1]) * d[1]) / size : 0.5;

  for (PetscInt c = 0; c < 2; ++c) {
    by->p[from / 4][from % 4][c] += (1.0 - s) * force[c];
    by->p[to / 4][to % 4][c] += s * force[c];
  }
}

/* Distributes `force`, the derivative with respect to a corner, to the vertices of the two lines that intersect there.
   If the lines are almost parallel, the corner moves with the line of the nonmortar facet. */
static void MoveCorner(const PlanePair *pair, const ContactCorner *corner, const PetscReal force[2], PlaneMotion *by)
{
  PetscReal normal[2][2], along[2][2], staying[2], sine, stays;

  if (corner->line[0][0] == corner->line[1][0] && corner->line[0][1] == corner->line[1][1]) {
    MoveLine(pair, corner, 0, force, by);
    return;
  }
  for (PetscInt k = 0; k < 2; ++k) {
    const PetscInt   from = corner->line[k][0], to = corner->line[k][1];
    const PetscReal *x = pair->p[from / 4][from % 4], *y = pair->p[to / 4][to % 4];
    PetscReal        length;

    if (corner->line[0][0] / 4 == corner->line[1][0] / 4 &&
        (from == corner->line[1 - k][0] || from == corner->line[1 - k][1])) {
      /* Both lines belong to the same facet, so that the corner is their common vertex. */
      for (PetscInt c = 0; c < 2; ++c) by->p[from / 4][from % 4][c] += force[c];
      return;
    }
    for (PetscInt c = 0; c < 2; ++c) along[k][c] = y[c] - x[c];
    length = PetscSqrtReal(PetscSqr(along[k][0]) + PetscSqr(along[k][1]));
    for (PetscInt c = 0; length > 0.0 && c < 2; ++c) along[k][c] /= length;
    normal[k][0] = -along[k][1];
    normal[k][1] = along[k][0];
  }
  sine  = normal[0][0] * along[1][0] + normal[0][1] * along[1][1];
  stays = 1.0 / (1.0 + PetscPowRealInt(sine / PARALLEL, 8));
  for (PetscInt c = 0; c < 2; ++c) staying[c] = stays * force[c];
  MoveLine(pair, corner, corner->line[0][0] < 4 ? 0 : 1, staying, by);
  for (PetscInt k = 0; sine != 0.0 && k < 2; ++k) {
    const PetscReal part =
                      (1.0 - stays) * (along[1 - k][0] * force[0] + along[1 - k][1] * force[1]) / (k ? -sine : sine),
                    pushed[2] = {part * normal[k][0], part * normal[k][1]};

    MoveLine(pair, corner, k, pushed, by);
  }
}

/* Converts derivatives in the plane's axes into derivatives by_x with respect to the vertices of one facet. height:
   derivatives with respect to the heights above the plane; NULL: zero */
static void LeavePlane(const PlanePair *pair, const PetscReal p[4][2], const PetscReal *height, PetscReal by_x[12])
{
  const PetscReal(*axis)[3] = pair->frame.axis;

  for (PetscInt i = 0; i < 12; ++i) {
    const PetscInt b = i / 3, c = i % 3;

    by_x[i] = p[b][0] * axis[0][c] + p[b][1] * axis[1][c] + (height ? height[b] * axis[2][c] : 0.0);
  }
}

/* Adds to `moment` the moment of the derivatives by_x, taken as forces on the vertices x, about the plane's origin */
static void AddMoment(const ContactFrame *frame, const PetscReal x[12], const PetscReal by_x[12], PetscReal moment[3])
{
  for (PetscInt b = 0; b < 4; ++b) {
    const PetscReal r[3] = {x[3 * b] - frame->origin[0], x[3 * b + 1] - frame->origin[1],
      x[3 * b + 2] - frame->origin[2]};
    PetscReal       m[3];

    VectorCross(r, &by_x[3 * b], m);
    for (PetscInt c = 0; c < 3; ++c) moment[c] += m[c];
  }
}

/* Adds the derivatives of row a's weighted gap. The plane rotates with the nonmortar facet and its patch. Quantities
   that were held fixed in the plane's axes therefore rotate too, which adds a moment. */
static void AddRow(const PlanePair *pair, PetscInt a, const PetscReal *const x[2], const PlaneSlopes *by,
  ContactSlopes *nonmortar, ContactSlopes *mortar)
{
  ContactSlopes *const to[2]     = {nonmortar, mortar};
  PetscReal            moment[3] = {0, 0, 0}, back[3], tilt[12];

  for (PetscInt side = 0; side < 2; ++side) {
    PetscReal by_x[12];

    LeavePlane(pair, by->gap.p[side], by->height[side], by_x);
    AddMoment(&pair->frame, x[side], by_x, moment);
    for (PetscInt i = 0; i < 12; ++i) to[side]->rigid[a][i] += by_x[i];
  }
  ContactFacetTurn(x[1], by->turn, tilt);
  for (PetscInt i = 0; i < 12; ++i) mortar->rigid[a][i] += tilt[i];
  for (PetscInt c = 0; c < 3; ++c) back[c] = -moment[c] - by->turn[c];
  ContactFacetTurn(x[0], back, tilt);
  for (PetscInt i = 0; i < 12; ++i) nonmortar->rigid[a][i] += tilt[i];
}

/* Adds the derivatives of row a's covered area */
static void AddRowCover(const PlanePair *pair, PetscInt a, const PetscReal *const x[2], const PlaneMotion *by,
  ContactSlopes *nonmortar, ContactSlopes *mortar)
{
  ContactSlopes *const to[2]     = {nonmortar, mortar};
  PetscReal            moment[3] = {0, 0, 0}, by_x[12], tilt[12];

  for (PetscInt side = 0; side < 2; ++side) {
    LeavePlane(pair, by->p[side], NULL, by_x);
    AddMoment(&pair->frame, x[side], by_x, moment);
    for (PetscInt i = 0; i < 12; ++i) to[side]->cover[a][i] += by_x[i];
  }
  for (PetscInt c = 0; c < 3; ++c) moment[c] = -moment[c];
  ContactFacetTurn(x[0], moment, tilt);
  for (PetscInt i = 0; i < 12; ++i) nonmortar->cover[a][i] += tilt[i];
}

/* Adds the gap and the covered area of the four rows, without derivatives */
static void AddGaps(const ContactOverlap *o, const PlanePair *pair, PetscReal gap[4], PetscReal cover[4])
{
  for (PetscInt k = 0; k < o->n; ++k) {
    PetscReal       phi[2][4];
    const PetscReal below = PlanePointHeight(pair, 0, o->xi1[k], phi[0]),
                    above = PlanePointHeight(pair, 1, o->xi2[k], phi[1]);

    for (PetscInt a = 0; a < 4; ++a) {
      gap[a] += o->weight[k] * phi[0][a] * (above - below);
      cover[a] += o->weight[k] * phi[0][a];
    }
  }
}

/* The same with derivatives */
static void AddSlopes(const ContactOverlap *o, const ContactRule *rule, const PlanePair *pair,
  const PetscReal *const x[2], PetscReal gap[4], PetscReal cover[4], ContactSlopes *nonmortar, ContactSlopes *mortar)
{
  PlaneSlopes by[4] = {{.height = {{0}}}};

  for (PetscInt t = 0; t < o->ntriangles; ++t) AddTriangle(o, rule, t, pair, gap, cover, by);
  for (PetscInt a = 0; a < 4; ++a) {
    for (PetscInt k = 0; k < o->ncorners; ++k) {
      MoveCorner(pair, &o->corner[k], by[a].gap.corner[k], &by[a].gap);
      MoveCorner(pair, &o->corner[k], by[a].cover.corner[k], &by[a].cover);
    }
    AddRow(pair, a, x, &by[a], nonmortar, mortar);
    AddRowCover(pair, a, x, &by[a].cover, nonmortar, mortar);
  }
}

/*
   Computes gap[A] = int phi_A (H2 - H1) [length^3] and cover[A] = int phi_A [length^2] over the overlap of x1 and x2
   that ContactOverlapFind() has found. The derivatives with respect to the mortar facet are stored in `mortar`; those
   with respect to the nonmortar facet are added to `nonmortar`. If both are NULL, no derivatives are computed.
*/
void ContactOverlapSlopes(const ContactOverlap *o, const ContactRule *rule, const PetscReal x1[12],
  const PetscReal x2[12], const ContactPatch *patch1, const ContactPatch *patch2, PetscReal gap[4], PetscReal cover[4],
  ContactSlopes *nonmortar, ContactSlopes *mortar)
{
  const PetscReal *const x[2] = {x1, x2};
  const ContactSlopes    none = {.rigid = {{0}}};
  PlanePair              pair = {.patch = {patch1, patch2}};

  for (PetscInt a = 0; a < 4; ++a) gap[a] = cover[a] = 0.0;
  if (mortar) *mortar = none;
  if (!ContactFrameCreate(x1, &pair.frame)) return;
  ContactFrameProject(&pair.frame, x1, pair.p[0], pair.height[0]);
  ContactFrameProject(&pair.frame, x2, pair.p[1], pair.height[1]);
  if (mortar) AddSlopes(o, rule, &pair, x, gap, cover, nonmortar, mortar);
  else AddGaps(o, &pair, gap, cover);
}
