/* Node-to-segment gaps: the distance of each nonmortar vertex from its closest point on the mortar face */
#include "gapsimpl.h"

/* A vertex has no closest point if it lies beside the mortar face by more than this fraction of the facet's size. */
#define BORDER_MARGIN 0.05
/*
   A vertex on the border of the nonmortar face may lie further beside the mortar face: by this fraction of the square
   root of its lumped area. Most of that area still lies over the mortar face. Otherwise vertices that bulge outwards
   where both faces end would lose their rows under pressure.
*/
#define RIM_MARGIN 0.2

/* Returns whether the closest point, with the parameters xi, is on the border of the mortar face */
static PetscBool NodeIsOnBorder(PetscInt border, const PetscReal xi[2])
{
  static const PetscInt vertex[2][2] = {{0, 3}, {1, 2}}; /* vertex[i][j] is at xi = -1 for i = 0 and 1 for i = 1, and
                                                            at eta = -1 for j = 0 and 1 for j = 1 */
  const PetscInt        i = xi[0] >= 1.0, j = xi[1] >= 1.0;

  if (PetscAbsReal(xi[0]) >= 1.0 && PetscAbsReal(xi[1]) >= 1.0)
    return (PetscBool)((border >> (4 + vertex[i][j]) & 1) != 0);
  if (PetscAbsReal(xi[0]) >= 1.0) return (PetscBool)((border >> (i ? 1 : 3) & 1) != 0);
  if (PetscAbsReal(xi[1]) >= 1.0) return (PetscBool)((border >> (j ? 2 : 0) & 1) != 0);
  return PETSC_FALSE;
}

/*
   Returns whether the vertex x lies beside the mortar face. This is so if two conditions hold: the closest point y is
   on the border of the face; and the part of x - y perpendicular to the facet's normal is longer than `margin` [length]
   and longer than BORDER_MARGIN times the facet's size.
*/
static PetscBool NodeIsBesideFace(const ContactCandidates *mortar, const ContactNearest *nearest, const PetscReal x[3],
  PetscReal margin)
{
  const PetscReal *facet = &mortar->x[12 * nearest->facet];
  PetscReal        t1[3], t2[3], n[3], r[3], area = 0.0, height = 0.0, beside = 0.0;

  if (!NodeIsOnBorder(mortar->border[nearest->facet], nearest->xi)) return PETSC_FALSE;
  ContactFacetTangents(facet, nearest->xi, t1, t2);
  VectorCross(t1, t2, n);
  if (ContactFacetIsTriangle(facet)) { /* The first tangent of a triangle is zero at its last vertex. */
    ContactFacetAreaVector(facet, n);
    for (PetscInt c = 0; c < 3; ++c) n[c] *= 0.25;
  }
  for (PetscInt c = 0; c < 3; ++c) {
    r[c] = x[c] - nearest->y[c];
    area += n[c] * n[c]; /* area is the square of a quarter of the facet's area */
    height += n[c] * r[c];
  }
  if (!(area > 0.0)) return PETSC_FALSE;
  for (PetscInt c = 0; c < 3; ++c) beside += PetscSqr(r[c] - height / area * n[c]);
  return (PetscBool)(beside > PetscSqr(PetscMax(margin, BORDER_MARGIN * 2.0 * PetscPowReal(area, 0.25))));
}

/* Enlarges the box to contain the spheres of the search radius about this rank's nonmortar vertices */
static PetscErrorCode ContactBox_Node(Contact contact, PetscInt p, PetscReal box[6])
{
  const ContactRows *rows  = &contact->rows;
  const PetscReal    reach = PetscMax(contact->pairs[p].distance, contact->pairs[p].depth) + contact->pairs[p].bulge;

  PetscFunctionBegin;
  for (PetscInt i = rows->first[p]; i < rows->first[p + 1]; ++i) {
    for (PetscInt c = 0; c < 3; ++c) {
      box[c]     = PetscMin(box[c], rows->x[3 * i + c] - reach);
      box[3 + c] = PetscMax(box[3 + c], rows->x[3 * i + c] + reach);
    }
  }
  PetscFunctionReturn(0);
}

/* The gap of a smooth pair [length], and its derivatives with respect to the coordinates of the vertex and of the
   facet's vertices, if the patch rotates with the facet and keeps its shape */
typedef struct {
  PetscReal gap, doubt, vertex[3], facet[12];
} NodeGap;

/*
   Adds to the derivatives that the closest point moves on its facet when the vertex or the facet moves. by_xi:
   derivative of the gap with respect to the parameters of the closest point. At an edge or a corner the point does not
   move across the edge.
*/
static void NodeMoveClosest(const PetscReal facet[12], const ContactNearest *nearest, const PetscReal x[3],
  const PetscReal by_xi[2], NodeGap *gap)
{
  PetscReal t[2][3], phi[4], dphi[4][2], r[3], H[3], twist[3], mu[2], det;
  PetscBool moves[2];

  ContactShape(nearest->xi, phi);
  ContactShapeSlopes(nearest->xi, dphi);
  ContactFacetTangents(facet, nearest->xi, t[0], t[1]);
  for (PetscInt c = 0; c < 3; ++c) {
    r[c]     = nearest->y[c] - x[c];
    twist[c] = 0.25 * (facet[c] - facet[3 + c] + facet[6 + c] - facet[9 + c]);
  }
  for (PetscInt d = 0; d < 2; ++d) {
    moves[d] = (PetscBool)(PetscAbsReal(nearest->xi[d]) < 1.0);
    H[2 * d] = moves[d] ? VectorDot(t[d], t[d]) : 1.0;
    mu[d]    = moves[d] ? -by_xi[d] : 0.0;
  }
  H[1] = moves[0] && moves[1] ? VectorDot(t[0], t[1]) + VectorDot(r, twist) : 0.0;
  det  = H[0] * H[2] - H[1] * H[1];
  if (!(det > 0.0)) return;
  mu[0] = (H[2] * mu[0] - H[1] * mu[1]) / det;
  mu[1] = moves[1] ? (-by_xi[1] - H[1] * mu[0]) / H[2] : 0.0;
  for (PetscInt d = 0; d < 2; ++d) {
    for (PetscInt c = 0; c < 3; ++c) gap->vertex[c] -= mu[d] * t[d][c];
    for (PetscInt i = 0; i < 12; ++i) gap->facet[i] += mu[d] * (phi[i / 3] * t[d][i % 3] + dphi[i / 3][d] * r[i % 3]);
  }
}

/*
   Computes the gap of a smooth pair and its derivatives. The gap is the distance of the vertex x from the tangent plane
   of the smooth surface, along the normal of that plane. The plane touches the surface at the parameters of the closest
   point of the facet. If the surface has no normal there, -n is used.
*/
static void NodeMeasure(const PetscReal facet[12], const PetscReal normals[12], const ContactNearest *nearest,
  const PetscReal x[3], const PetscReal n[3], NodeGap *gap)
{
  ContactPatch patch;
  PetscReal    offset[3], normal[3], m[3], r[3], phi[4], dphi[4][2], by_xi[2], by_normal[3], turn[3], length;

  ContactPatchCreate(facet, normals, &patch);
  ContactPatchEvaluate(&patch, nearest->xi, offset, normal);
  for (PetscInt c = 0; c < 3; ++c) m[c] = normal[c];
  length = VectorScaleToUnit(m);
  for (PetscInt c = 0; c < 3; ++c) {
    r[c] = x[c] - nearest->y[c] - offset[c];
    if (!(length > 0.0)) m[c] = -n[c];
  }
  gap->gap   = VectorDot(r, m);
  gap->doubt = ContactPatchDoubt(&patch);
  for (PetscInt c = 0; c < 3; ++c) {
    by_normal[c]   = length > 0.0 ? (r[c] - gap->gap * m[c]) / length : 0.0;
    gap->vertex[c] = m[c];
    m[c]           = -m[c];
  }
  ContactPatchDifferentiate(&patch, nearest->xi, offset, normal, m, by_normal, by_xi, turn);
  ContactFacetTurn(facet, turn, gap->facet);
  ContactShape(nearest->xi, phi);
  ContactShapeSlopes(nearest->xi, dphi);
  for (PetscInt i = 0; i < 12; ++i) {
    gap->facet[i] += phi[i / 3] * m[i % 3];
    for (PetscInt d = 0; d < 2; ++d) by_xi[d] += dphi[i / 3][d] * facet[i] * m[i % 3];
  }
  NodeMoveClosest(facet, nearest, x, by_xi, gap);
}

/* Adds the derivatives of a row of a smooth pair to the assembly. They are multiplied by the row's mass, because the
   assembly divides by it later. */
static PetscErrorCode NodeAddSlopes(PetscInt row, PetscInt vertex, PetscReal mass, const ContactCandidates *mortar,
  PetscInt facet, NodeGap *gap, ContactAssembly *assembly)
{
  PetscFunctionBegin;
  for (PetscInt c = 0; c < 3; ++c) gap->vertex[c] *= mass;
  for (PetscInt i = 0; i < 12; ++i) gap->facet[i] *= mass;
  PetscCall(ContactEntriesAdd(&assembly->rigid, row, 1, &vertex, gap->vertex));
  PetscCall(ContactEntriesAdd(&assembly->rigid, row, 4, &mortar->node[4 * facet], gap->facet));
  PetscFunctionReturn(0);
}

/* Returns the gap along the normal n from the vertex x to the closest point of a facet [length] */
static PetscReal NodeFacetGap(const ContactNearest *nearest, const PetscReal x[3], const PetscReal n[3])
{
  const PetscReal r[3] = {nearest->y[0] - x[0], nearest->y[1] - x[1], nearest->y[2] - x[2]};

  return VectorDot(r, n);
}

/* Adds the gap of vertex i and its couplings to the assembly: N2_B(xi) for the mortar vertices and -1 for the vertex.
   They are multiplied by the row's mass, because the assembly divides by it later. */
static PetscErrorCode NodeAddVertex(Contact contact, PetscInt i, PetscInt row, PetscReal mass,
  const ContactCandidates *mortar, const ContactNearest *nearest, NodeGap *gap, ContactAssembly *assembly)
{
  const PetscScalar weighted = mass * gap->gap;
  PetscSection      global;
  PetscInt          offset;
  PetscReal         value[4];

  PetscFunctionBegin;
  ContactShape(nearest->xi, value);
  for (PetscInt b = 0; b < 4; ++b) value[b] *= mass;
  PetscCall(ContactEntriesAdd(&assembly->coupling, row, 4, &mortar->node[4 * nearest->facet], value));
  PetscCall(DMGetGlobalSection(contact->dm, &global));
  PetscCall(PetscSectionGetOffset(global, contact->rows.vertex[i], &offset));
  offset /= 3;
  value[0] = -mass;
  PetscCall(ContactEntriesAdd(&assembly->coupling, row, 1, &offset, value));
  if (mortar->patch && assembly->parts != CONTACT_GAPS)
    PetscCall(NodeAddSlopes(row, offset, mass, mortar, nearest->facet, gap, assembly));
  PetscCall(VecSetValue(assembly->gap, row, weighted, ADD_VALUES));
  PetscCall(VecSetValue(assembly->doubt, row, mass * gap->doubt, ADD_VALUES));
  PetscFunctionReturn(0);
}

static PetscErrorCode ContactAdd_Node(Contact contact, PetscInt p, const ContactCandidates *mortar,
  ContactAssembly *assembly)
{
  ContactPairData   *pair  = &contact->pairs[p];
  const ContactRows *rows  = &contact->rows;
  const PetscReal    reach = PetscMax(pair->distance, pair->depth) + pair->bulge;
  const PetscScalar *mass;
  PetscInt           rstart;
  ContactTree        tree;

  PetscFunctionBegin;
  PetscCall(PetscLogEventBegin(CONTACT_Search, NULL, NULL, NULL, NULL));
  PetscCall(ContactTreeCreate(mortar, &tree));
  PetscCall(VecGetOwnershipRange(rows->mass, &rstart, NULL));
  PetscCall(VecGetArrayRead(rows->mass, &mass));
  for (PetscInt i = rows->first[p]; i < rows->first[p + 1]; ++i) {
    const PetscReal *x = &rows->x[3 * i], *n = &rows->normal[3 * i];
    const PetscBool  rim    = (PetscBool)(PetscBTLookup(pair->nonmortar.rim, rows->vertex[i]) != 0);
    const PetscReal  margin = rim ? RIM_MARGIN * PetscSqrtReal(PetscRealPart(mass[i])) : 0.0;
    ContactNearest   nearest;
    NodeGap          gap;

    ContactFindNearest(&tree, mortar, CONTACT_NORMAL_COSINE, reach, x, n, NULL, NULL, &nearest);
    if (nearest.facet < 0 || NodeIsBesideFace(mortar, &nearest, x, margin)) continue;
    if (pair->mortar.patched)
      NodeMeasure(&mortar->x[12 * nearest.facet], &mortar->patch[12 * nearest.facet], &nearest, x, n, &gap);
    else {
      gap.gap   = NodeFacetGap(&nearest, x, n);
      gap.doubt = 0.0;
    }
    if (gap.gap > pair->distance || gap.gap < -pair->depth) continue;
    PetscCall(NodeAddVertex(contact, i, rstart + i, PetscRealPart(mass[i]), mortar, &nearest, &gap, assembly));
  }
  PetscCall(VecRestoreArrayRead(rows->mass, &mass));
  PetscCall(ContactTreeDestroy(&tree));
  PetscCall(PetscLogEventEnd(CONTACT_Search, NULL, NULL, NULL, NULL));
  PetscFunctionReturn(0);
}

const ContactGapOps ContactGapNode = {ContactBox_Node, ContactAdd_Node};
