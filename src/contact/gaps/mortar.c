/* Mortar integrals of one overlap, and of all overlaps of this rank's nonmortar facets */
#include "gapsimpl.h"
#include "src/contact/self/selfimpl.h"

/* Sums the integrals over the quadrature points of an overlap. The positions on both facets are interpolated from their
   vertices x1 and x2. */
void ContactIntegrate(const ContactOverlap *o, const PetscReal x1[12], const PetscReal x2[12],
  const PetscReal normals[12], PetscReal (*dual)[4], ContactIntegrals *m)
{
  *m = (ContactIntegrals){0};
  for (PetscInt q = 0; q < o->n; ++q) {
    PetscReal phi1[4], psi[4], phi2[4], d[3] = {0, 0, 0};

    ContactShape(o->xi1[q], phi1);
    ContactShape(o->xi2[q], phi2);
    for (PetscInt b = 0; b < 4; ++b) {
      for (PetscInt c = 0; c < 3; ++c) d[c] += phi2[b] * (x2[3 * b + c] - x1[c]) - phi1[b] * (x1[3 * b + c] - x1[c]);
    }
    for (PetscInt a = 0; a < 4; ++a) psi[a] = phi1[a];
    if (dual) ContactDualTransform(dual, 1, psi);
    for (PetscInt a = 0; a < 4; ++a) {
      const PetscReal w = o->weight[q] * psi[a];

      for (PetscInt c = 0; c < 3; ++c) m->gap[a] += w * d[c] * normals[3 * a + c];
      for (PetscInt b = 0; b < 4; ++b) {
        m->D[a][b] += w * phi1[b];
        m->M[a][b] += w * phi2[b];
      }
    }
  }
}

/* A nonmortar facet, and the sums over its overlaps */
typedef struct {
  /* coordinates and normals of the vertices */
  const PetscReal *x, *normal;
  /* global row and global number of each vertex */
  const PetscInt *row, *node;
  PetscReal       gap[4], D[4][4]; /* weighted gaps [length^3], and -int phi_A N1_B [length^2] */
  ContactPatch    patch;           /* smooth surface over the facet; smooth pairs only */
  /* int phi_A over the covered part [length^2], and derivatives; smooth pairs only */
  PetscReal     cover[4], doubt[4]; /* doubt: int phi_A times the uncertainty of the smooth surfaces [length^3] */
  ContactSlopes slopes;
  PetscBool     self;   /* whether the face is in contact with itself */
  PetscReal (*dual)[4]; /* dual functions; NULL if the pair has none, or if too small a part of the facet is covered */
} MortarFacet;

/* Replaces the weighted gaps of an overlap by those between the smooth surfaces, and adds their derivatives */
static PetscErrorCode MortarAddPatch(const ContactRule *rule, const ContactOverlap *overlap,
  const ContactCandidates *mortar, PetscInt k, MortarFacet *facet, PetscReal gap[4], ContactAssembly *assembly)
{
  const PetscBool  sloped = (PetscBool)(assembly->parts != CONTACT_GAPS);
  const PetscReal *x      = &mortar->x[12 * k];
  PetscReal        cover[4], doubt;
  ContactPatch     patch;
  ContactSlopes    slopes;

  PetscFunctionBegin;
  ContactPatchCreate(x, &mortar->patch[12 * k], &patch);
  ContactOverlapSlopes(overlap, rule, facet->x, x, &facet->patch, &patch, gap, cover, sloped ? &facet->slopes : NULL,
    sloped ? &slopes : NULL);
  doubt = ContactPatchDoubt(&facet->patch) + ContactPatchDoubt(&patch);
  for (PetscInt a = 0; a < 4; ++a) facet->doubt[a] += doubt * cover[a];
  if (facet->dual) {
    ContactDualTransform(facet->dual, 1, gap);
    ContactDualTransform(facet->dual, 1, cover);
    if (sloped) ContactDualTransformSlopes(facet->dual, &slopes);
  }
  for (PetscInt a = 0; a < 4; ++a) facet->cover[a] += cover[a];
  if (sloped) PetscCall(ContactAssemblyAddSlopes(assembly, facet->row, &mortar->node[4 * k], &slopes));
  if (sloped && facet->self)
    PetscCall(ContactAssemblyAddSlopes(assembly->mortar, facet->row, &mortar->node[4 * k], &slopes));
  PetscFunctionReturn(0);
}

/* Adds the integrals over the overlap with mortar facet k */
static PetscErrorCode MortarAddOverlap(const ContactRule *rule, const ContactOverlap *overlap, PetscBool smooth,
  const ContactCandidates *mortar, PetscInt k, MortarFacet *facet, ContactAssembly *assembly)
{
  ContactIntegrals m;

  PetscFunctionBegin;
  ContactIntegrate(overlap, facet->x, &mortar->x[12 * k], facet->normal, facet->dual, &m);
  if (smooth) PetscCall(MortarAddPatch(rule, overlap, mortar, k, facet, m.gap, assembly));
  for (PetscInt a = 0; a < 4; ++a) {
    facet->gap[a] += m.gap[a];
    for (PetscInt b = 0; b < 4; ++b) facet->D[a][b] -= m.D[a][b];
    PetscCall(ContactEntriesAdd(&assembly->coupling, facet->row[a], 4, &mortar->node[4 * k], m.M[a]));
    if (facet->self)
      PetscCall(ContactEntriesAdd(&assembly->mortar->coupling, facet->row[a], 4, &mortar->node[4 * k], m.M[a]));
  }
  PetscFunctionReturn(0);
}

/* The overlaps of one nonmortar facet. mortar: for each overlap, the number of the mortar facet among the candidates */
typedef struct {
  PetscInt        n, max, *mortar;
  ContactOverlap *overlap;
} MortarOverlaps;

static PetscErrorCode OverlapsDestroy(MortarOverlaps *list)
{
  PetscFunctionBegin;
  PetscCall(PetscFree2(list->mortar, list->overlap));
  PetscFunctionReturn(0);
}

/*
   Finds the overlaps of nonmortar facet f, if one of them is within the search distance; otherwise the list is empty.
   All overlaps of such a facet count, up to the search distance plus the diameter of the facet. If its farther end were
   left out, the gap would jump when the facet rotates.
*/
static PetscErrorCode OverlapsFind(const ContactOverlapLimits *search, const ContactRule *rule, const ContactSurface *s,
  PetscInt f, const ContactCandidates *mortar, PetscInt nnear, const PetscInt near[], MortarOverlaps *list)
{
  const PetscReal     *x       = &s->x[12 * f];
  ContactOverlapLimits whole   = *search;
  PetscBool            is_near = PETSC_FALSE;
  ContactSelfFacet     self    = {0};

  PetscFunctionBegin;
  whole.distance += ContactFacetDiameter(x);
  if (nnear > list->max) {
    PetscCall(OverlapsDestroy(list));
    list->max = 2 * nnear;
    PetscCall(PetscMalloc2(list->max, &list->mortar, list->max, &list->overlap));
  }
  list->n = 0;
  if (s->self) self = ContactSelfOwn(s, f);
  for (PetscInt k = 0; k < nnear; ++k) {
    if (ContactOverlapFindAtBorder(x, s->border[f], &mortar->x[12 * near[k]], mortar->border[near[k]], &whole, rule,
          &list->overlap[list->n]))
      list->mortar[list->n++] = near[k];
  }
  if (s->self) PetscCall(ContactSelfSelect(&self, mortar, &list->n, list->mortar, list->overlap));
  for (PetscInt k = 0; k < list->n; ++k) is_near = (PetscBool)(is_near || list->overlap[k].gap <= search->distance);
  if (!is_near) list->n = 0;
  PetscFunctionReturn(0);
}

/* Returns the fraction of a facet's area that its overlaps cover */
static PetscReal MortarMeasureCover(const PetscReal x[12], const MortarOverlaps *list)
{
  PetscReal    covered = 0.0, corners[4][2], height[4];
  ContactFrame frame;

  if (!ContactFrameCreate(x, &frame)) return 0.0;
  ContactFrameProject(&frame, x, corners, height);
  for (PetscInt k = 0; k < list->n; ++k) covered += list->overlap[k].area;
  return PetscMin(1.0, covered / ContactPolygonArea(4, (const PetscReal(*)[2])corners));
}

/*
   Computes the functions that replace phi_A. Dual functions are defined for a fully covered facet. For a partly covered
   facet they are blended with phi_A, so that they change continuously while the faces slide. Returns false, which means
   phi_A itself, if three quarters of the facet or less are covered.
*/
static PetscBool MortarGetDual(const PetscReal reference[12], PetscReal covered, PetscReal dual[4][4])
{
  const PetscReal least = 0.75;
  const PetscReal part  = (covered - least) / (1.0 - least);

  if (part <= 0.0) return PETSC_FALSE;
  ContactDualFunctions(reference, dual);
  for (PetscInt a = 0; a < 16; ++a)
    dual[a / 4][a % 4] = part * dual[a / 4][a % 4] + (a / 4 == a % 4 ? 1.0 - part : 0.0);
  return PETSC_TRUE;
}

/* Integrates over all overlaps of nonmortar facet f */
static PetscErrorCode MortarAddFacet(const ContactRule *rule, const ContactPairData *pair, PetscInt f,
  const ContactCandidates *mortar, const MortarOverlaps *list, ContactAssembly *assembly)
{
  const PetscBool smooth = pair->nonmortar.patched;
  MortarFacet     facet  = {.x = &pair->nonmortar.x[12 * f],
         .normal               = &pair->normal[12 * f],
         .row                  = &pair->row[4 * f],
         .node                 = &pair->nonmortar.node[4 * f],
         .self                 = pair->nonmortar.self};
  PetscReal       dual[4][4];
  PetscScalar     gap[4], cover[4], doubt[4];

  PetscFunctionBegin;
  if (!list->n) PetscFunctionReturn(0);
  if (ContactPairIsDual(pair)) {
    if (MortarGetDual(&pair->nonmortar.reference[12 * f], MortarMeasureCover(facet.x, list), dual)) facet.dual = dual;
  }
  if (smooth) ContactPatchCreate(facet.x, &pair->nonmortar.patch[12 * f], &facet.patch);
  for (PetscInt k = 0; k < list->n; ++k)
    PetscCall(MortarAddOverlap(rule, &list->overlap[k], smooth, mortar, list->mortar[k], &facet, assembly));
  if (smooth && facet.dual && assembly->parts != CONTACT_GAPS) ContactDualTransformSlopes(facet.dual, &facet.slopes);
  for (PetscInt a = 0; a < 4; ++a) {
    gap[a]   = facet.gap[a];
    cover[a] = facet.cover[a];
    doubt[a] = facet.doubt[a];
    PetscCall(ContactEntriesAdd(&assembly->coupling, facet.row[a], 4, facet.node, facet.D[a]));
  }
  if (smooth && assembly->parts != CONTACT_GAPS)
    PetscCall(ContactAssemblyAddSlopes(assembly, facet.row, facet.node, &facet.slopes));
  PetscCall(VecSetValues(assembly->gap, 4, facet.row, gap, ADD_VALUES));
  PetscCall(VecSetValues(assembly->cover, 4, facet.row, cover, ADD_VALUES));
  PetscCall(VecSetValues(assembly->doubt, 4, facet.row, doubt, ADD_VALUES));
  PetscFunctionReturn(0);
}

/* Enlarges the box to contain the prisms that this rank's nonmortar facets sweep along their normals */
static PetscErrorCode ContactBox_Mortar(Contact contact, PetscInt p, PetscReal box[6])
{
  const ContactPairData *pair = &contact->pairs[p];

  PetscFunctionBegin;
  for (PetscInt f = 0; f < pair->nonmortar.nfacets; ++f) {
    PetscReal swept[6];

    ContactSweptBox(&pair->nonmortar.x[12 * f],
      pair->distance + pair->bulge + ContactFacetDiameter(&pair->nonmortar.x[12 * f]), pair->depth + pair->bulge,
      swept);
    for (PetscInt c = 0; c < 3; ++c) {
      box[c]     = PetscMin(box[c], swept[c]);
      box[3 + c] = PetscMax(box[3 + c], swept[3 + c]);
    }
  }
  PetscFunctionReturn(0);
}

/* Collective. Computes the vertex normals of a surface in contact with itself, as means over the facets with
   overlaps. Other facets around a vertex are not used, because they lie beyond an edge or on the mortar side. meets:
   whether a facet has overlaps */
static PetscErrorCode MortarSelfNormals(Contact contact, PetscInt p, const ContactOverlapLimits *limits,
  const ContactCandidates *mortar, const ContactNear *near, MortarOverlaps *list, PetscBool meets[])
{
  ContactPairData *pair  = &contact->pairs[p];
  ContactRows     *rows  = &contact->rows;
  const PetscInt   first = rows->first[p], n = rows->first[p + 1] - first;

  PetscFunctionBegin;
  for (PetscInt f = 0; f < pair->nonmortar.nfacets; ++f) {
    const PetscInt begin = near->offset[f];

    PetscCall(OverlapsFind(limits, &contact->rule[pair->nonmortar.patched], &pair->nonmortar, f, mortar,
      near->offset[f + 1] - begin, near->facet + begin, list));
    meets[f] = (PetscBool)(list->n > 0);
  }
  PetscCall(ContactSurfaceNormals(contact->dm, &pair->nonmortar, meets, pair->normal, n, rows->vertex + first,
    rows->normal + 3 * first));
  PetscFunctionReturn(0);
}

static PetscErrorCode ContactAdd_Mortar(Contact contact, PetscInt p, const ContactCandidates *mortar,
  ContactAssembly *assembly)
{
  ContactPairData           *pair   = &contact->pairs[p];
  const ContactRule         *rule   = &contact->rule[pair->nonmortar.patched];
  const ContactOverlapLimits limits = {contact->reach_depth > 0.0 ? 0.0 : CONTACT_NORMAL_COSINE, CONTACT_OVERLAP_DROP,
    pair->distance + pair->bulge, pair->depth + pair->bulge};
  MortarOverlaps             list   = {0, 0, NULL, NULL};
  PetscBool                 *meets  = NULL;
  ContactNear                near;

  PetscFunctionBegin;
  PetscCall(PetscLogEventBegin(CONTACT_Search, NULL, NULL, NULL, NULL));
  PetscCall(ContactSearch(&pair->nonmortar, limits.distance, limits.depth, mortar, &near));
  PetscCall(PetscLogEventEnd(CONTACT_Search, NULL, NULL, NULL, NULL));
  PetscCall(PetscLogEventBegin(CONTACT_Integrate, NULL, NULL, NULL, NULL));
  if (pair->nonmortar.self) {
    PetscCall(PetscMalloc1(pair->nonmortar.nfacets, &meets));
    PetscCall(MortarSelfNormals(contact, p, &limits, mortar, &near, &list, meets));
  }
  for (PetscInt f = 0; f < pair->nonmortar.nfacets; ++f) {
    const PetscInt first = near.offset[f], n = near.offset[f + 1] - first;

    if (!n || (meets && !meets[f])) continue;
    PetscCall(OverlapsFind(&limits, rule, &pair->nonmortar, f, mortar, n, near.facet + first, &list));
    PetscCall(MortarAddFacet(rule, pair, f, mortar, &list, assembly));
  }
  PetscCall(OverlapsDestroy(&list));
  PetscCall(PetscFree(meets));
  PetscCall(PetscLogEventEnd(CONTACT_Integrate, NULL, NULL, NULL, NULL));
  PetscCall(ContactNearDestroy(&near));
  PetscFunctionReturn(0);
}

const ContactGapOps ContactGapMortar = {ContactBox_Mortar, ContactAdd_Mortar};
