/*
   The ring: this rank's facets and two layers of facets around them, fetched from any rank. The normals of a smooth
   surface are computed from it. Corner 4 f + a is vertex a of facet f (a triangle has three); it also stands for the
   edge from that vertex to the next. Facets are not neighbours across an edge that is sharper, undeformed, than the
   feature angle: each side has its own normals.
*/
#include "smoothimpl.h"

/* Number of corners of the facet; a triangle stores its last node twice */
static PetscInt RingCountCorners(const ContactRing *ring, PetscInt corner)
{
  const PetscInt *node = &ring->node[4 * (corner / 4)];

  return node[2] == node[3] ? 3 : 4;
}

PetscInt ContactCornerAfter(const ContactRing *ring, PetscInt corner)
{
  return 4 * (corner / 4) + (corner % 4 + 1) % RingCountCorners(ring, corner);
}

PetscInt ContactCornerBefore(const ContactRing *ring, PetscInt corner)
{
  const PetscInt n = RingCountCorners(ring, corner);

  return 4 * (corner / 4) + (corner % 4 + n - 1) % n;
}

/* Whether it is the fourth corner of a triangle, which is not used */
PetscBool ContactCornerIsNone(const ContactRing *ring, PetscInt corner)
{
  return (PetscBool)(corner % 4 >= RingCountCorners(ring, corner));
}

/* First (clockwise) and last corner around a corner's node before a sharp edge or the border; returns true if there
   is neither */
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

/* Computes the position of the image v from its real node and the mirror planes */
void ContactRingReflect(ContactRing *ring, PetscInt v)
{
  const ContactImage *image = &ring->image[v - ring->nreal];

  for (PetscInt c = 0; c < 3; ++c) {
    const PetscReal x = ring->x[3 * image->of + c];

    ring->x[3 * v + c] = image->plane[c] < 0 ? x : 2.0 * ring->x[3 * image->plane[c] + c] - x;
  }
}

/* Collective. Moves the nodes by a global displacement vector */
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

/* Edge vectors from a corner's vertex to the next and to the previous vertex of its facet */
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
  PetscCall(PetscFree(ring->held));
  PetscCall(PetscFree(ring->image));
  PetscCall(PetscFree(ring->reference));
  PetscCall(PetscFree(ring->x));
  PetscCall(VecDestroy(&ring->u));
  PetscCall(VecScatterDestroy(&ring->scatter));
  PetscFunctionReturn(0);
}
