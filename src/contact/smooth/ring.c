/*
   The ring consists of this rank's facets and of two layers of facets around them, fetched from any rank. The normals
   of a smooth surface are computed from it. Corner 4 f + a is vertex a of facet f; a triangle has three corners. A
   corner also represents the edge from its vertex to the next. Two facets are not neighbours across an edge if the
   angle between their undeformed normals exceeds the feature angle. Each side of such a sharp edge has its own normals.
*/
#include "smoothimpl.h"

/* Computes the position of the mirror image v from its real node and the mirror planes */
void ContactRingReflect(ContactRing *ring, PetscInt v)
{
  const ContactImage *image = &ring->image[v - ring->nreal];

  for (PetscInt c = 0; c < 3; ++c) {
    const PetscReal x = ring->s.x[3 * image->of + c];

    ring->s.x[3 * v + c] = image->plane[c] < 0 ? x : 2.0 * ring->s.x[3 * image->plane[c] + c] - x;
  }
}

/* Collective. Moves the nodes to the global displacement vector u */
PetscErrorCode ContactRingDeform(Vec u, ContactRing *ring)
{
  const PetscScalar *a;

  PetscFunctionBegin;
  PetscCall(VecScatterBegin(ring->scatter, u, ring->u, INSERT_VALUES, SCATTER_FORWARD));
  PetscCall(VecScatterEnd(ring->scatter, u, ring->u, INSERT_VALUES, SCATTER_FORWARD));
  PetscCall(VecGetArrayRead(ring->u, &a));
  for (PetscInt i = 0; i < 3 * ring->nreal; ++i) ring->s.x[i] = ring->reference[i] + PetscRealPart(a[i]);
  for (PetscInt v = ring->nreal; v < ring->nnodes; ++v) ContactRingReflect(ring, v);
  PetscCall(VecRestoreArrayRead(ring->u, &a));
  PetscFunctionReturn(0);
}

PetscErrorCode ContactRingDestroy(ContactRing *ring)
{
  PetscFunctionBegin;
  PetscCall(PetscFree(ring->s.node));
  PetscCall(PetscFree(ring->s.twin));
  PetscCall(PetscFree2(ring->normal, ring->at));
  PetscCall(PetscFree(ring->prescribed));
  PetscCall(PetscFree(ring->image));
  PetscCall(PetscFree(ring->reference));
  PetscCall(PetscFree(ring->s.x));
  PetscCall(VecDestroy(&ring->u));
  PetscCall(VecScatterDestroy(&ring->scatter));
  PetscFunctionReturn(0);
}
