/* Which pairs have a curved face, and the normals of their smooth surfaces at every displacement; pairs of planes cost nothing */
#include "contactimpl.h"

/* A surface stands off its facets by more than this part of an edge, or it is plane but for rounding in its file */
#define CURVED 1e-6

/* The normals at the surface's corners; and how far the patches stand off their facets at most, as a length and as a part of the edges */
static PetscErrorCode PatchSurface(const ContactRing *ring, ContactSurface *s, PetscReal *bulge, PetscReal *curvature)
{
  PetscFunctionBegin;
  *bulge = *curvature = 0.0;
  for (PetscInt f = 0; f < s->nfacets; ++f) {
    const PetscReal *x = &s->x[12 * f];
    PetscReal        a[3], size = 0.0;
    ContactPatch     patch;

    for (PetscInt i = 0; i < 4; ++i) ContactRingNormal(ring, 4 * (ring->own + f) + i, &s->patch[12 * f + 3 * i]);
    ContactFacetAreaVector(x, a);
    for (PetscInt c = 0; c < 3; ++c) size += PetscSqr(a[c]);
    ContactPatchCreate(x, &s->patch[12 * f], &patch);
    *bulge = PetscMax(*bulge, ContactPatchBulge(&patch));
    if (size > 0.0) *curvature = PetscMax(*curvature, ContactPatchBulge(&patch) / PetscSqrtReal(PetscSqrtReal(size)));
  }
  PetscFunctionReturn(0);
}

/* Collective. Rings about both faces; taken away again where both are plane */
static PetscErrorCode SmoothPair(Contact contact, Vec u, ContactPairData *pair)
{
  const PetscReal cosine     = PetscCosReal(contact->feature_angle * PETSC_PI / 180.0);
  ContactSurface *surface[2] = {&pair->mortar, &pair->nonmortar};
  ContactRing    *ring[2]    = {&pair->mortar_ring, &pair->nonmortar_ring};
  PetscReal       largest[4] = {0};

  PetscFunctionBegin;
  for (PetscInt k = 0; k < 2; ++k) {
    ContactSurface undeformed = *surface[k];

    undeformed.x = undeformed.reference;
    PetscCall(ContactRingCreate(contact->comm, u, cosine, surface[k], ring[k]));
    PetscCall(PetscMalloc1(12 * surface[k]->nfacets, &surface[k]->patch));
    undeformed.patch = surface[k]->patch;
    PetscCall(PatchSurface(ring[k], &undeformed, &largest[k], &largest[2 + k]));
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, largest, 4, MPIU_REAL, MPIU_MAX, contact->comm));
  pair->bulge = largest[0] + largest[1];
  for (PetscInt k = 0; k < 2; ++k) surface[k]->patched = (PetscBool)(PetscMax(largest[2], largest[3]) > CURVED);
  PetscFunctionReturn(0);
}

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

/* Collective. The smooth surfaces at a global displacement vector, of the surfaces already deformed; the first time, finds out which pairs have any */
PetscErrorCode ContactSmoothDeform(Contact contact, Vec u)
{
  PetscReal bulge, curvature;

  PetscFunctionBegin;
  for (PetscInt p = 0; p < contact->npairs; ++p) {
    ContactPairData *pair = &contact->pairs[p];

    if (!contact->smoothed && pair->smooth) {
      PetscCall(SmoothPair(contact, u, pair));
      if (!pair->mortar.patched) PetscCall(SharpenPair(pair));
    }
    if (!pair->mortar.patched) continue;
    PetscCall(ContactRingDeform(u, &pair->mortar_ring));
    PetscCall(ContactRingDeform(u, &pair->nonmortar_ring));
    PetscCall(PatchSurface(&pair->mortar_ring, &pair->mortar, &bulge, &curvature));
    PetscCall(PatchSurface(&pair->nonmortar_ring, &pair->nonmortar, &bulge, &curvature));
  }
  contact->smoothed = PETSC_TRUE;
  PetscFunctionReturn(0);
}

/* Forgets which pairs are curved, and their smooth surfaces */
PetscErrorCode ContactSmoothReset(Contact contact)
{
  PetscFunctionBegin;
  for (PetscInt p = 0; p < contact->npairs; ++p) PetscCall(SharpenPair(&contact->pairs[p]));
  contact->smoothed = PETSC_FALSE;
  PetscFunctionReturn(0);
}
