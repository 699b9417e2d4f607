/* The normals of all smooth surfaces as functions of the displacement: their global numbers, and the matrix of their
   derivatives */
#include "assemblyimpl.h"

/* Gets the two surfaces of a pair and the rings of facets around them */
static void SmoothNormalsGetSides(ContactPairData *pair, ContactSurface *surface[2], ContactRing *ring[2])
{
  surface[0] = &pair->mortar;
  surface[1] = &pair->nonmortar;
  ring[0]    = &pair->mortar_ring;
  ring[1]    = &pair->nonmortar_ring;
}

/* Collective. Numbers the normals of each rank consecutively, pair by pair and side by side. *first: number of this
   rank's first normal */
static PetscErrorCode SmoothNormalsNumber(Contact contact, PetscInt *first)
{
  PetscInt n = 0, next;

  PetscFunctionBegin;
  for (PetscInt p = 0; p < contact->npairs; ++p) {
    const ContactPairData *pair = &contact->pairs[p];

    if (pair->mortar.patched) n += pair->mortar_ring.nnormals + pair->nonmortar_ring.nnormals;
  }
  contact->smooth.nlocal = n;
  PetscCallMPI(MPI_Scan(&n, &next, 1, MPIU_INT, MPI_SUM, contact->comm));
  *first = next -= n;
  for (PetscInt p = 0; p < contact->npairs; ++p) {
    ContactSurface *surface[2];
    ContactRing    *ring[2];

    SmoothNormalsGetSides(&contact->pairs[p], surface, ring);
    for (PetscInt k = 0; k < 2 && surface[0]->patched; ++k) {
      for (PetscInt i = 0; i < 4 * surface[k]->nfacets; ++i) surface[k]->normal_id[i] = next + ring[k]->normal[i];
      next += ring[k]->nnormals;
    }
  }
  PetscFunctionReturn(0);
}

/* Computes the derivative blocks of all normals of this rank. If their arrays are not allocated, only counts them.
   end[i]: end of the blocks of normal i; NULL if not needed */
static PetscErrorCode SmoothNormalsFill(Contact contact, PetscInt end[])
{
  ContactNormalSlopes *blocks = &contact->smooth.blocks;

  PetscFunctionBegin;
  blocks->n = 0;
  for (PetscInt p = 0; p < contact->npairs; ++p) {
    ContactSurface *surface[2];
    ContactRing    *ring[2];

    SmoothNormalsGetSides(&contact->pairs[p], surface, ring);
    for (PetscInt k = 0; k < 2 && surface[0]->patched; ++k) {
      const PetscInt first = blocks->n;

      for (PetscInt i = 0; i < ring[k]->nnormals; ++i) {
        ContactRingNormalSlopes(ring[k], ring[k]->at[i], blocks);
        if (end) *end++ = blocks->n;
      }
      for (PetscInt b = first; end && b < blocks->n; ++b) blocks->node[b] = ring[k]->global[blocks->node[b]];
    }
  }
  PetscFunctionReturn(0);
}

/* Collective. Creates and preallocates the matrix for blocks whose nodes are known */
static PetscErrorCode SmoothNormalsPreallocate(Contact contact, PetscInt first, const PetscInt end[])
{
  ContactSmoothNormals *smooth = &contact->smooth;
  PetscInt              n, *row, *column, normal = 0;
  Vec                   u;

  PetscFunctionBegin;
  PetscCall(PetscMalloc2(9 * smooth->blocks.n, &row, 9 * smooth->blocks.n, &column));
  for (PetscInt b = 0; b < smooth->blocks.n; ++b) {
    while (b >= end[normal]) ++normal;
    for (PetscInt i = 0; i < 9; ++i) {
      row[9 * b + i]    = 3 * (first + normal) + i / 3;
      column[9 * b + i] = 3 * smooth->blocks.node[b] + i % 3;
    }
  }
  PetscCall(DMGetGlobalVector(contact->dm, &u));
  PetscCall(VecGetLocalSize(u, &n));
  PetscCall(DMRestoreGlobalVector(contact->dm, &u));
  PetscCall(MatCreate(contact->comm, &smooth->slopes));
  PetscCall(MatSetSizes(smooth->slopes, 3 * smooth->nlocal, n, PETSC_DETERMINE, PETSC_DETERMINE));
  PetscCall(MatSetType(smooth->slopes, MATAIJ));
  PetscCall(MatSetPreallocationCOO(smooth->slopes, 9 * smooth->blocks.n, row, column));
  PetscCall(PetscFree2(row, column));
  PetscFunctionReturn(0);
}

/* Collective. Creates the matrix of derivatives. It must be known which pairs are smooth. Does nothing if none is
   smooth. */
PetscErrorCode ContactSmoothNormalsCreate(Contact contact)
{
  ContactSmoothNormals *smooth = &contact->smooth;
  PetscInt              first  = 0, total, *end;

  PetscFunctionBegin;
  PetscCall(SmoothNormalsNumber(contact, &first));
  PetscCallMPI(MPI_Allreduce(&smooth->nlocal, &total, 1, MPIU_INT, MPI_SUM, contact->comm));
  if (!total) PetscFunctionReturn(0);
  PetscCall(SmoothNormalsFill(contact, NULL));
  PetscCall(PetscMalloc2(smooth->blocks.n, &smooth->blocks.node, 9 * smooth->blocks.n, &smooth->blocks.value));
  PetscCall(PetscMalloc1(smooth->nlocal, &end));
  PetscCall(SmoothNormalsFill(contact, end));
  PetscCall(SmoothNormalsPreallocate(contact, first, end));
  PetscCall(PetscFree(end));
  PetscFunctionReturn(0);
}

/* Collective. Updates the derivatives to the displacement of the rings */
PetscErrorCode ContactSmoothNormalsUpdate(Contact contact)
{
  PetscFunctionBegin;
  if (!contact->smooth.slopes) PetscFunctionReturn(0);
  PetscCall(SmoothNormalsFill(contact, NULL));
  PetscCall(MatSetValuesCOO(contact->smooth.slopes, contact->smooth.blocks.value, INSERT_VALUES));
  PetscFunctionReturn(0);
}

PetscErrorCode ContactSmoothNormalsDestroy(Contact contact)
{
  PetscFunctionBegin;
  PetscCall(PetscFree2(contact->smooth.blocks.node, contact->smooth.blocks.value));
  PetscCall(MatDestroy(&contact->smooth.slopes));
  contact->smooth.nlocal = 0;
  PetscFunctionReturn(0);
}
