/* Mortar integrals of a pair of facets, and of all pairs of this rank's nonmortar facets */
#include "contactimpl.h"

/* All sums over the points of the overlap; coordinates of both facets interpolated there */
void ContactIntegrate(const ContactOverlap *o, const PetscReal x1[12], const PetscReal x2[12], const PetscReal normals[12], ContactIntegrals *m)
{
  *m = (ContactIntegrals){0};
  for (PetscInt q = 0; q < o->n; ++q) {
    PetscReal phi1[4], phi2[4], d[3] = {0, 0, 0};

    ContactShape(o->xi1[q], phi1);
    ContactShape(o->xi2[q], phi2);
    for (PetscInt b = 0; b < 4; ++b) {
      for (PetscInt c = 0; c < 3; ++c) d[c] += phi2[b] * (x2[3 * b + c] - x1[c]) - phi1[b] * (x1[3 * b + c] - x1[c]);
    }
    for (PetscInt a = 0; a < 4; ++a) {
      const PetscReal w = o->weight[q] * phi1[a];

      for (PetscInt c = 0; c < 3; ++c) m->gap[a] += w * d[c] * normals[3 * a + c];
      for (PetscInt b = 0; b < 4; ++b) {
        m->D[a][b] += w * phi1[b];
        m->M[a][b] += w * phi2[b];
      }
    }
  }
}

/* Adds to int phi_A gap what the two smooth surfaces stand off their facets, along the normal that the facets are projected along */
void ContactIntegratePatches(const ContactOverlap *o, const PetscReal x1[12], const ContactPatch *patch1, const ContactPatch *patch2, const PetscReal normals[12], PetscReal gap[4])
{
  PetscReal n1[3], cosine[4];

  if (!ContactFacetNormal(x1, n1)) return;
  for (PetscInt a = 0; a < 4; ++a) cosine[a] = n1[0] * normals[3 * a] + n1[1] * normals[3 * a + 1] + n1[2] * normals[3 * a + 2];
  for (PetscInt q = 0; q < o->n; ++q) {
    PetscReal phi[4], r[3], n[3], height;

    ContactPatchEvaluate(patch2, o->xi2[q], r, n);
    height = ContactPatchDistance(r, n, n1);
    ContactPatchEvaluate(patch1, o->xi1[q], r, n);
    height -= ContactPatchDistance(r, n, n1);
    ContactShape(o->xi1[q], phi);
    for (PetscInt a = 0; a < 4; ++a) gap[a] += o->weight[q] * phi[a] * height * cosine[a];
  }
}

/* One nonmortar facet against the candidates near it; normal: at its vertices */
static PetscErrorCode MortarAddFacet(const ContactOverlapLimits *limits, const ContactRule *rule, const ContactPairData *pair, PetscInt f, const PetscReal normal[12], const ContactCandidates *mortar, PetscInt nnear, const PetscInt near[], ContactAssembly *assembly, PetscInt *noverlaps)
{
  const PetscReal *x1      = &pair->nonmortar.x[12 * f];
  const PetscInt  *row     = &pair->row[4 * f];
  PetscReal        D[4][4] = {{0}};
  PetscScalar      gap[4]  = {0};
  PetscInt         n       = 0;
  ContactOverlap   overlap;
  ContactIntegrals m;
  ContactPatch     patch1, patch2;

  PetscFunctionBegin;
  if (pair->nonmortar.patched) ContactPatchCreate(x1, &pair->nonmortar.patch[12 * f], &patch1);
  for (PetscInt k = 0; k < nnear; ++k) {
    const PetscReal *x2 = &mortar->x[12 * near[k]];

    if (!ContactOverlapFind(x1, x2, limits, rule, &overlap)) continue;
    ContactIntegrate(&overlap, x1, x2, normal, &m);
    if (pair->nonmortar.patched) {
      ContactPatchCreate(x2, &mortar->patch[12 * near[k]], &patch2);
      ContactIntegratePatches(&overlap, x1, &patch1, &patch2, normal, m.gap);
    }
    ++n;
    for (PetscInt a = 0; a < 4; ++a) {
      gap[a] += m.gap[a];
      for (PetscInt b = 0; b < 4; ++b) D[a][b] -= m.D[a][b];
      PetscCall(ContactAssemblyAdd(assembly, row[a], 4, &mortar->node[4 * near[k]], m.M[a], &normal[3 * a]));
    }
  }
  if (n) {
    for (PetscInt a = 0; a < 4; ++a) PetscCall(ContactAssemblyAdd(assembly, row[a], 4, &pair->nonmortar.node[4 * f], D[a], &normal[3 * a]));
    PetscCall(VecSetValues(assembly->gap, 4, row, gap, ADD_VALUES));
  }
  *noverlaps += n;
  PetscFunctionReturn(0);
}

/* Box about what this rank's nonmortar facets sweep along their normals */
static PetscErrorCode ContactBox_Mortar(Contact contact, PetscInt p, PetscReal box[6])
{
  const ContactPairData *pair = &contact->pairs[p];

  PetscFunctionBegin;
  for (PetscInt f = 0; f < pair->nonmortar.nfacets; ++f) {
    PetscReal swept[6];

    ContactSweptBox(&pair->nonmortar.x[12 * f], pair->distance + pair->bulge, pair->depth + pair->bulge, swept);
    for (PetscInt c = 0; c < 3; ++c) {
      box[c]     = PetscMin(box[c], swept[c]);
      box[3 + c] = PetscMax(box[3 + c], swept[3 + c]);
    }
  }
  PetscFunctionReturn(0);
}

static PetscErrorCode ContactAdd_Mortar(Contact contact, PetscInt p, const ContactCandidates *mortar, ContactAssembly *assembly)
{
  ContactPairData           *pair   = &contact->pairs[p];
  const ContactOverlapLimits limits = {contact->reach_depth > 0.0 ? 0.0 : contact->cosine, contact->overlap_drop, pair->distance + pair->bulge, pair->depth + pair->bulge};
  ContactNear                near;

  PetscFunctionBegin;
  PetscCall(PetscLogEventBegin(CONTACT_Search, NULL, NULL, NULL, NULL));
  PetscCall(ContactSearch(&pair->nonmortar, limits.distance, limits.depth, mortar, &near));
  PetscCall(PetscLogEventEnd(CONTACT_Search, NULL, NULL, NULL, NULL));
  PetscCall(PetscLogEventBegin(CONTACT_Integrate, NULL, NULL, NULL, NULL));
  for (PetscInt f = 0; f < pair->nonmortar.nfacets; ++f) {
    const PetscInt first = near.offset[f], n = near.offset[f + 1] - first;
    PetscReal      normal[12];

    if (!n) continue;
    PetscCall(PetscArraycpy(normal, &pair->normal[12 * f], 12));
    for (PetscInt a = 0; contact->normals == CONTACT_NORMALS_FACET && a < 4; ++a) (void)ContactFacetNormal(&pair->nonmortar.x[12 * f], &normal[3 * a]);
    PetscCall(MortarAddFacet(&limits, &contact->rule, pair, f, normal, mortar, n, near.facet + first, assembly, &pair->nfacing));
  }
  PetscCall(PetscLogEventEnd(CONTACT_Integrate, NULL, NULL, NULL, NULL));
  PetscCall(ContactNearDestroy(&near));
  PetscFunctionReturn(0);
}

const ContactGapOps ContactGapMortar = {ContactBox_Mortar, ContactAdd_Mortar};
