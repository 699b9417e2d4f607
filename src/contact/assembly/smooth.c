/*
   Determines which pairs have a curved face, and computes the normals of their smooth surfaces at each displacement.
   Pairs of plane faces need no smooth surface. Nor do plane faces of order 2: a smooth surface would overshoot beside
   an edge of the other body, where they bend sharply.
*/
#include "assemblyimpl.h"

/* Computes the normals at the vertices of the surface's facets. *bulge: largest distance of the patches from their
   facets [length]; *curvature: largest ratio of that distance to the size of the facet */
static PetscErrorCode PatchSurface(const ContactRing *ring, ContactSurface *s, PetscReal *bulge, PetscReal *curvature)
{
  PetscReal *normal;

  PetscFunctionBegin;
  *bulge = *curvature = 0.0;
  PetscCall(PetscMalloc1(3 * ring->nnormals, &normal));
  for (PetscInt i = 0; i < ring->nnormals; ++i) MeshCornerNormal(&ring->s, ring->at[i], &normal[3 * i]);
  for (PetscInt f = 0; f < s->nfacets; ++f) {
    const PetscReal *x = &s->x[12 * f];
    PetscReal        a[3], size = 0.0;
    ContactPatch     patch;

    for (PetscInt i = 0; i < 12; ++i) s->patch[12 * f + i] = normal[3 * ring->normal[4 * f + i / 3] + i % 3];
    ContactFacetAreaVector(x, a);
    for (PetscInt c = 0; c < 3; ++c) size += PetscSqr(a[c]);
    ContactPatchCreate(x, &s->patch[12 * f], &patch);
    *bulge = PetscMax(*bulge, ContactPatchBulge(&patch));
    if (size > 0.0) *curvature = PetscMax(*curvature, ContactPatchBulge(&patch) / PetscSqrtReal(PetscSqrtReal(size)));
  }
  PetscCall(PetscFree(normal));
  PetscFunctionReturn(0);
}

/* Collective. Creates the rings of facets around both faces. Sets `patched` of both faces to whether one of them is
   curved in the undeformed state. */
static PetscErrorCode SmoothPair(Contact contact, Vec u, ContactPairData *pair)
{
  const PetscReal cosine     = PetscCosReal(MESH_SHARP_ANGLE * PETSC_PI / 180.0);
  ContactSurface *surface[2] = {&pair->mortar, &pair->nonmortar};
  ContactRing    *ring[2]    = {&pair->mortar_ring, &pair->nonmortar_ring};
  PetscReal       largest[4] = {0};

  PetscFunctionBegin;
  for (PetscInt k = 0; k < 2; ++k) {
    ContactSurface undeformed = *surface[k];

    undeformed.x = undeformed.reference;
    PetscCall(ContactSurfaceFindPrescribed(contact->dm, contact->ndisplacements, contact->displacements, surface[k]));
    PetscCall(ContactRingCreate(contact->comm, u, cosine, surface[k], ring[k]));
    PetscCall(PetscMalloc1(12 * surface[k]->nfacets, &surface[k]->patch));
    undeformed.patch = surface[k]->patch;
    PetscCall(PatchSurface(ring[k], &undeformed, &largest[k], &largest[2 + k]));
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, largest, 4, MPIU_REAL, MPIU_MAX, contact->comm));
  pair->bulge = largest[0] + largest[1];
  /* smaller distances between the smooth surface and a facet, relative to the facet, are rounding errors */
  for (PetscInt k = 0; k < 2; ++k)
    surface[k]->patched = (PetscBool)(PetscMax(largest[2], largest[3]) > MESH_SAME_PLACE);
  PetscFunctionReturn(0);
}

/* Discards the smooth surfaces of a pair */
static PetscErrorCode SharpenPair(ContactPairData *pair)
{
  PetscFunctionBegin;
  PetscCall(ContactRingDestroy(&pair->mortar_ring));
  PetscCall(ContactRingDestroy(&pair->nonmortar_ring));
  PetscCall(PetscFree(pair->mortar.patch));
  PetscCall(PetscFree(pair->nonmortar.patch));
  pair->bulge          = 0.0;
  pair->mortar.patched = pair->nonmortar.patched = PETSC_FALSE;
  PetscFunctionReturn(0);
}

/* Collective. Determines once which pairs are smooth. u: any displacement vector of the mesh */
PetscErrorCode ContactSmoothFind(Contact contact, Vec u)
{
  PetscFunctionBegin;
  for (PetscInt p = 0; p < contact->npairs && !contact->smoothed; ++p) {
    ContactPairData *pair = &contact->pairs[p];

    if (!pair->smooth) continue;
    PetscCall(SmoothPair(contact, u, pair));
    if (!pair->mortar.patched) PetscCall(SharpenPair(pair));
    contact->smooth = (PetscBool)(contact->smooth || pair->mortar.patched);
  }
  contact->smoothed = PETSC_TRUE;
  PetscFunctionReturn(0);
}

/* Collective. Computes the smooth surfaces at the displacement u, to which the surfaces have been deformed before */
PetscErrorCode ContactSmoothDeform(Contact contact, Vec u)
{
  PetscReal bulge, curvature;

  PetscFunctionBegin;
  for (PetscInt p = 0; p < contact->npairs; ++p) {
    ContactPairData *pair = &contact->pairs[p];

    if (!pair->mortar.patched) continue;
    PetscCall(ContactRingDeform(u, &pair->mortar_ring));
    PetscCall(ContactRingDeform(u, &pair->nonmortar_ring));
    PetscCall(PatchSurface(&pair->mortar_ring, &pair->mortar, &bulge, &curvature));
    PetscCall(PatchSurface(&pair->nonmortar_ring, &pair->nonmortar, &bulge, &curvature));
  }
  PetscFunctionReturn(0);
}

/* Discards all smooth surfaces, so that ContactSmoothFind() determines again which pairs are smooth */
PetscErrorCode ContactSmoothReset(Contact contact)
{
  PetscFunctionBegin;
  for (PetscInt p = 0; p < contact->npairs; ++p) PetscCall(SharpenPair(&contact->pairs[p]));
  contact->smooth = contact->smoothed = PETSC_FALSE;
  PetscFunctionReturn(0);
}
