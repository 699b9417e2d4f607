/*
   The ring consists of this rank's facets and of two layers of facets around them, fetched from any rank. The normals
   of a smooth surface are computed from it. Corner 4 f + a is vertex a of facet f; a triangle has three corners. A
   corner also represents the edge from its vertex to the next. Two facets are not neighbours across an edge if the
   angle between their undeformed normals exceeds the feature angle. Each side of such a sharp edge has its own normals.
*/
#include "smoothimpl.h"

/* Returns the number of corners of a corner's facet. A triangle stores its last node twice. */
static PetscInt RingCountCorners(const ContactRing *ring, PetscInt corner)
{
  const PetscInt *node = &ring->node[4 * (corner / 4)];

  return node[2] == node[3] ? 3 : 4;
}

/* Returns the next corner of the facet, counterclockwise */
PetscInt ContactCornerAfter(const ContactRing *ring, PetscInt corner)
{
  return 4 * (corner / 4) + (corner % 4 + 1) % RingCountCorners(ring, corner);
}

/* Returns the previous corner of the facet */
PetscInt ContactCornerBefore(const ContactRing *ring, PetscInt corner)
{
  const PetscInt n = RingCountCorners(ring, corner);

  return 4 * (corner / 4) + (corner % 4 + n - 1) % n;
}

/* Returns whether a corner is the fourth corner of a triangle, which is not used */
PetscBool ContactCornerIsNone(const ContactRing *ring, PetscInt corner)
{
  return (PetscBool)(corner % 4 >= RingCountCorners(ring, corner));
}

/* Finds the first (clockwise) and the last corner around a corner's node before a sharp edge or the border. Returns
   true if there is neither, so that the corners form a closed fan. */
PetscBool ContactRingFan(const ContactRing *ring, PetscInt corner, PetscInt *first, PetscInt *last)
{
  *first = *last = corner;
  while (ring->twin[ContactCornerBefore(ring, *last)] >= 0) {
    *last = ring->twin[ContactCornerBefore(ring, *last)];
    if (*last == corner) {
      *last = ContactCornerAfter(ring, ring->twin[corner]);
      return PETSC_TRUE;
    }
  }
  while (ring->twin[*first] >= 0) *first = ContactCornerAfter(ring, ring->twin[*first]);
  return PETSC_FALSE;
}

/* Computes the position of the mirror image v from its real node and the mirror planes */
void ContactRingReflect(ContactRing *ring, PetscInt v)
{
  const ContactImage *image = &ring->image[v - ring->nreal];

  for (PetscInt c = 0; c < 3; ++c) {
    const PetscReal x = ring->x[3 * image->of + c];

    ring->x[3 * v + c] = image->plane[c] < 0 ? x : 2.0 * ring->x[3 * image->plane[c] + c] - x;
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
  for (PetscInt i = 0; i < 3 * ring->nreal; ++i) ring->x[i] = ring->reference[i] + PetscRealPart(a[i]);
  for (PetscInt v = ring->nreal; v < ring->nnodes; ++v) ContactRingReflect(ring, v);
  PetscCall(VecRestoreArrayRead(ring->u, &a));
  PetscFunctionReturn(0);
}

/* Computes the edge vectors from a corner's vertex to the next and to the previous vertex of its facet [length] */
void ContactRingEdges(const ContactRing *ring, PetscInt corner, PetscReal after[3], PetscReal before[3])
{
  const PetscReal *x = &ring->x[3 * ring->node[corner]],
                  *y = &ring->x[3 * ring->node[ContactCornerAfter(ring, corner)]],
                  *z = &ring->x[3 * ring->node[ContactCornerBefore(ring, corner)]];

  for (PetscInt c = 0; c < 3; ++c) {
    after[c]  = y[c] - x[c];
    before[c] = z[c] - x[c];
  }
}

PetscErrorCode ContactRingDestroy(ContactRing *ring)
{
  PetscFunctionBegin;
  PetscCall(PetscFree(ring->node));
  PetscCall(PetscFree(ring->twin));
  PetscCall(PetscFree2(ring->normal, ring->at));
  PetscCall(PetscFree(ring->global));
  PetscCall(PetscFree(ring->prescribed));
  PetscCall(PetscFree(ring->image));
  PetscCall(PetscFree(ring->reference));
  PetscCall(PetscFree(ring->x));
  PetscCall(VecDestroy(&ring->u));
  PetscCall(VecScatterDestroy(&ring->scatter));
  PetscFunctionReturn(0);
}
