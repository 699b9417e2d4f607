/* Penetration of vertices of one face into the other body. Mortar gaps are weighted means. If the nonmortar side is the
   coarser one, they may be zero while vertices of the mortar side penetrate. */
#include "contactimpl.h"
#include "src/contact/self/selfimpl.h"

#define PENETRATION_POINTS 5 /* number of points along each direction of a facet, if points in the facets are tested */

/* Returns the depth of the vertex x below a facet, or below its smooth surface [length]. The depth is 0 if the vertex
   is above the facet, or if its distance beside the facet exceeds its depth. */
static PetscReal PenetrationOfVertex(const ContactCandidates *facets, const ContactNearest *nearest,
  const PetscReal x[3])
{
  const PetscReal *facet = &facets->x[12 * nearest->facet];
  PetscReal        n[3], r[3], offset[3] = {0.0, 0.0, 0.0}, height;

  if (facets->patch) {
    ContactPatch patch;

    ContactPatchCreate(facet, &facets->patch[12 * nearest->facet], &patch);
    ContactPatchEvaluate(&patch, nearest->xi, offset, n);
    if (!(VectorScaleToUnit(n) > 0.0)) return 0.0;
  } else if (!ContactFacetNormal(facet, n)) return 0.0;
  for (PetscInt c = 0; c < 3; ++c) r[c] = x[c] - nearest->y[c] - offset[c];
  height = VectorDot(r, n);
  return height < 0.0 && 2.0 * height * height >= VectorDot(r, r) ? -height : 0.0;
}

/* A vertex of a surface in contact with itself, given by a facet and the number of the corner */
typedef struct {
  ContactSelfFacet facet;
  PetscInt         corner;
} PenetrationVertex;

/* Returns whether the vertex can be in contact with the point xi of a facet; context: a PenetrationVertex */
static PetscBool PenetrationMayMeet(const void *context, const ContactCandidates *facets, PetscInt facet,
  const PetscReal xi[2])
{
  const PenetrationVertex *vertex = context;
  const ContactSelfFacet   other  = ContactSelfCandidate(facets, facet);
  PetscReal                phi[4], y[3] = {0.0, 0.0, 0.0};

  for (PetscInt a = 0; a < 4; ++a) {
    if (other.node[a] == vertex->facet.node[vertex->corner]) return PETSC_FALSE;
  }
  ContactShape(xi, phi);
  for (PetscInt i = 0; i < 12; ++i) y[i % 3] += phi[i / 3] * other.reference[i];
  return (PetscBool)!ContactSelfIsWall(&vertex->facet, &vertex->facet.reference[3 * vertex->corner], &other, y);
}

/* Computes point k of PENETRATION_POINTS^2 points of a facet of `side`, on its smooth surface if it has one */
static void PenetrationPlace(const ContactSurface *side, PetscInt facet, PetscInt k, PetscReal y[3])
{
  const PetscReal *x     = &side->x[12 * facet];
  const PetscReal  xi[2] = {2.0 * (PetscReal)(k % PENETRATION_POINTS) / (PENETRATION_POINTS - 1) - 1.0,
     2.0 * (PetscReal)(k / PENETRATION_POINTS) / (PENETRATION_POINTS - 1) - 1.0};
  PetscReal        phi[4], n[3];

  for (PetscInt c = 0; c < 3; ++c) y[c] = 0.0;
  if (side->patched) {
    ContactPatch patch;

    ContactPatchCreate(x, &side->patch[12 * facet], &patch);
    ContactPatchEvaluate(&patch, xi, y, n);
  }
  ContactShape(xi, phi);
  for (PetscInt i = 0; i < 12; ++i) y[i % 3] += phi[i / 3] * x[i];
}

/* Increases *deepest to the largest depth of points in facet f of `side` [length] */
static void PenetrationOfFacet(PetscReal reach, const ContactSurface *side, PetscInt f, const PetscReal normal[3],
  const ContactTree *tree, const ContactCandidates *facets, PetscReal *deepest)
{
  for (PetscInt k = 0; k < PENETRATION_POINTS * PENETRATION_POINTS; ++k) {
    PetscReal      y[3];
    ContactNearest nearest;

    PenetrationPlace(side, f, k, y);
    ContactFindNearest(tree, facets, CONTACT_NORMAL_COSINE, reach, y, normal, NULL, NULL, &nearest);
    if (nearest.facet >= 0) *deepest = PetscMax(*deepest, PenetrationOfVertex(facets, &nearest, y));
  }
}

/* Increases *deepest to the largest depth of the vertices of facet f of `side` [length] */
static void PenetrationOfCorners(PetscReal reach, const ContactSurface *side, PetscInt f, const PetscReal normal[3],
  const ContactTree *tree, const ContactCandidates *facets, PetscReal *deepest)
{
  for (PetscInt a = 0; a < 4; ++a) {
    const PetscReal  *x = &side->x[12 * f + 3 * a];
    ContactNearest    nearest;
    PenetrationVertex vertex = {.corner = a};

    if (side->self) vertex.facet = ContactSelfOwn(side, f);
    ContactFindNearest(tree, facets, CONTACT_NORMAL_COSINE, reach, x, normal, side->self ? PenetrationMayMeet : NULL,
      &vertex, &nearest);
    if (nearest.facet >= 0) *deepest = PetscMax(*deepest, PenetrationOfVertex(facets, &nearest, x));
  }
}

/* Collective. Increases *deepest to the largest depth of the vertices of `side` below `other` [length]. within: whether
   points in the facets count, too */
static PetscErrorCode PenetrationOfSide(Contact contact, PetscReal reach, PetscBool within, const ContactSurface *side,
  const ContactSurface *other, PetscReal *deepest)
{
  PetscReal box[6] = {PETSC_MAX_REAL, PETSC_MAX_REAL, PETSC_MAX_REAL, PETSC_MIN_REAL, PETSC_MIN_REAL, PETSC_MIN_REAL};
  ContactCandidates facets;
  ContactTree       tree;

  PetscFunctionBegin;
  for (PetscInt i = 0; i < 12 * side->nfacets; ++i) {
    box[i % 3]     = PetscMin(box[i % 3], side->x[i] - reach);
    box[3 + i % 3] = PetscMax(box[3 + i % 3], side->x[i] + reach);
  }
  PetscCall(ContactExchange(contact->comm, box, other, &facets));
  PetscCall(ContactTreeCreate(&facets, &tree));
  for (PetscInt f = 0; f < side->nfacets; ++f) {
    PetscReal n[3];

    if (!ContactFacetNormal(&side->x[12 * f], n)) continue;
    PenetrationOfCorners(reach, side, f, n, &tree, &facets, deepest);
    if (within && !side->self) PenetrationOfFacet(reach, side, f, n, &tree, &facets, deepest);
  }
  PetscCall(ContactTreeDestroy(&tree));
  PetscCall(ContactCandidatesDestroy(&facets));
  PetscFunctionReturn(0);
}

/* Increases *deepest to the largest depth of this rank's vertices below a rigid surface [length]. within: whether
   points in the facets count, too */
static void PenetrationOfFormula(Contact contact, PetscInt p, PetscBool within, PetscReal *deepest)
{
  const ContactPairData *pair = &contact->pairs[p];
  const ContactRows     *rows = &contact->rows;
  PetscReal              gradient[3], weight[4], y[3];

  for (PetscInt i = rows->first[p]; i < rows->first[p + 1]; ++i)
    *deepest = PetscMax(*deepest, -ContactSurfaceDistance(pair, &rows->x[3 * i], gradient, weight));
  for (PetscInt f = 0; within && f < pair->nonmortar.nfacets; ++f) {
    for (PetscInt k = 0; k < PENETRATION_POINTS * PENETRATION_POINTS; ++k) {
      PenetrationPlace(&pair->nonmortar, f, k, y);
      *deepest = PetscMax(*deepest, -ContactSurfaceDistance(pair, y, gradient, weight));
    }
  }
}

/*
   Collective. Computes how deep the vertices of each pair's faces penetrate the other face at the global displacement
   u.

   - depth: for each pair, the largest penetration of a vertex of either face [length]; 0 if no vertex penetrates
   - rounding: for each pair, the uncertainty of the depth [length]. It is a tenth of the distance between smooth
     surfaces and facets, and 0 for plane faces.

   - within: pairs for which points in the facets count as well as vertices. Without a vertex inside the other body, two
     convex surfaces may penetrate where edges cross. This costs several times as much.

   The gap of a mortar pair is a mean, weighted by the shape function of a nonmortar vertex. Here the depth of each
   single vertex of both sides is measured along the normal of the other face. Smooth pairs are measured between the
   smooth surfaces. A vertex that does not project onto the other face has no depth.
*/
PetscErrorCode ContactGetPenetration(Contact contact, Vec u, const PetscBool within[], PetscReal depth[],
  PetscReal rounding[])
{
  PetscFunctionBegin;
  PetscCall(ContactDeform(contact, u));
  for (PetscInt p = 0; p < contact->npairs; ++p) {
    const ContactPairData *pair  = &contact->pairs[p];
    const PetscReal        reach = pair->depth + pair->bulge;

    depth[p]    = 0.0;
    rounding[p] = 0.1 * pair->bulge;
    if (pair->formula) {
      PenetrationOfFormula(contact, p, within[p], &depth[p]);
      continue;
    }
    PetscCall(PenetrationOfSide(contact, reach, within[p], &pair->nonmortar, &pair->mortar, &depth[p]));
    if (!pair->mortar.self)
      PetscCall(PenetrationOfSide(contact, reach, within[p], &pair->mortar, &pair->nonmortar, &depth[p]));
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, depth, (PetscMPIInt)contact->npairs, MPIU_REAL, MPIU_MAX, contact->comm));
  PetscFunctionReturn(0);
}
