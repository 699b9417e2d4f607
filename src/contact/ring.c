/*
  The facets about those of this rank, two deep, on whatever ranks they are: what the normals of a smooth surface are taken from.

  A corner is 4 f + a, for vertex a of facet f; it stands for the edge from that vertex to the next as well. Neighbours across an
  edge that is sharper, undeformed, than the feature angle are none: each side of it has normals of its own.
*/
#include "contactimpl.h"

PetscInt ContactCornerAfter(PetscInt corner)
{
  return 4 * (corner / 4) + (corner + 1) % 4;
}

PetscInt ContactCornerBefore(PetscInt corner)
{
  return 4 * (corner / 4) + (corner + 3) % 4;
}

/* Box about this rank's undeformed facets and those next to them; the largest facet of all ranks says how far that is */
static PetscErrorCode RingBox(MPI_Comm comm, const ContactSurface *s, PetscReal box[6])
{
  PetscReal largest = 0.0;

  PetscFunctionBegin;
  for (PetscInt c = 0; c < 3; ++c) {
    box[c]     = PETSC_MAX_REAL;
    box[3 + c] = PETSC_MIN_REAL;
  }
  for (PetscInt f = 0; f < s->nfacets; ++f) {
    PetscReal facet[6];

    ContactFacetBox(&s->reference[12 * f], facet);
    for (PetscInt c = 0; c < 3; ++c) {
      box[c]     = PetscMin(box[c], facet[c]);
      box[3 + c] = PetscMax(box[3 + c], facet[3 + c]);
      largest    = PetscMax(largest, facet[3 + c] - facet[c]);
    }
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPIU_REAL, MPIU_MAX, comm));
  for (PetscInt c = 0; s->nfacets && c < 3; ++c) {
    box[c] -= 1.01 * largest;
    box[3 + c] += 1.01 * largest;
  }
  PetscFunctionReturn(0);
}

/* Where this rank's own facets are among the candidates: together, in their order */
static PetscErrorCode FindOwn(const ContactSurface *s, const ContactCandidates *facets, PetscInt *own)
{
  PetscBool same = PETSC_FALSE;

  PetscFunctionBegin;
  *own = 0;
  if (!s->nfacets) PetscFunctionReturn(0);
  for (PetscInt f = 0; !same && f < facets->n; ++f) {
    PetscCall(PetscArraycmp(&facets->node[4 * f], s->node, 4, &same));
    *own = f;
  }
  PetscCheck(same, PETSC_COMM_SELF, PETSC_ERR_PLIB, "A rank's own facets of face \"%s\" are not about themselves", s->name);
  PetscFunctionReturn(0);
}

/* Numbers the nodes from 0, and gathers them from a displacement */
static PetscErrorCode NumberNodes(Vec u, const ContactCandidates *facets, ContactRing *ring)
{
  PetscInt *node;
  IS        rows;

  PetscFunctionBegin;
  ring->nnodes = 4 * ring->nfacets;
  PetscCall(PetscMalloc1(4 * ring->nfacets, &node));
  PetscCall(PetscArraycpy(node, facets->node, 4 * ring->nfacets));
  PetscCall(PetscSortRemoveDupsInt(&ring->nnodes, node));
  for (PetscInt i = 0; i < 4 * ring->nfacets; ++i) PetscCall(PetscFindInt(facets->node[i], ring->nnodes, node, &ring->node[i]));
  PetscCall(PetscMalloc2(3 * ring->nnodes, &ring->reference, 3 * ring->nnodes, &ring->x));
  for (PetscInt i = 0; i < 12 * ring->nfacets; ++i) ring->reference[3 * ring->node[i / 3] + i % 3] = facets->x[i];
  PetscCall(PetscArraycpy(ring->x, ring->reference, 3 * ring->nnodes));
  PetscCall(ISCreateBlock(PETSC_COMM_SELF, 3, ring->nnodes, node, PETSC_COPY_VALUES, &rows));
  PetscCall(VecCreateSeq(PETSC_COMM_SELF, 3 * ring->nnodes, &ring->u));
  PetscCall(VecScatterCreate(u, rows, ring->u, NULL, &ring->scatter));
  PetscCall(ISDestroy(&rows));
  PetscCall(PetscFree(node));
  PetscFunctionReturn(0);
}

/* The one corner whose edge runs the other way along the same nodes; negative where there is none, or several */
static PetscInt FindTwin(const ContactRing *ring, const PetscInt first[], const PetscInt corner[], PetscInt of)
{
  const PetscInt from = ring->node[ContactCornerAfter(of)], to = ring->node[of];
  PetscInt       twin = -1;

  for (PetscInt i = first[from]; i < first[from + 1]; ++i) {
    if (ring->node[ContactCornerAfter(corner[i])] != to) continue;
    if (twin >= 0) return -1;
    twin = corner[i];
  }
  return twin;
}

/* Neighbours across edges that are not sharp; x: the undeformed facets */
static PetscErrorCode FindTwins(PetscReal cosine, const PetscReal x[], ContactRing *ring)
{
  PetscInt *first, *corner; /* corners at a node */

  PetscFunctionBegin;
  PetscCall(PetscCalloc1(ring->nnodes + 2, &first));
  PetscCall(PetscMalloc1(4 * ring->nfacets, &corner));
  for (PetscInt i = 0; i < 4 * ring->nfacets; ++i) ++first[ring->node[i] + 2];
  for (PetscInt v = 0; v < ring->nnodes; ++v) first[v + 2] += first[v + 1];
  for (PetscInt i = 0; i < 4 * ring->nfacets; ++i) corner[first[ring->node[i] + 1]++] = i;
  for (PetscInt i = 0; i < 4 * ring->nfacets; ++i) {
    const PetscInt twin = FindTwin(ring, first, corner, i);
    PetscReal      n[3], m[3];
    PetscBool      smooth = (PetscBool)(twin >= 0 && FindTwin(ring, first, corner, twin) == i);

    smooth        = (PetscBool)(smooth && ContactFacetNormal(&x[12 * (i / 4)], n) && ContactFacetNormal(&x[12 * (twin / 4)], m));
    ring->twin[i] = smooth && n[0] * m[0] + n[1] * m[1] + n[2] * m[2] >= cosine ? twin : -1;
  }
  PetscCall(PetscFree(first));
  PetscCall(PetscFree(corner));
  PetscFunctionReturn(0);
}

/* Collective. cosine: of the feature angle; u: any displacement */
PetscErrorCode ContactRingCreate(MPI_Comm comm, Vec u, PetscReal cosine, const ContactSurface *s, ContactRing *ring)
{
  ContactSurface    undeformed = *s;
  ContactCandidates facets;
  PetscReal         box[6];

  PetscFunctionBegin;
  undeformed.x = s->reference;
  PetscCall(RingBox(comm, s, box));
  PetscCall(ContactExchange(comm, box, &undeformed, &facets));
  ring->nfacets = facets.n;
  PetscCall(FindOwn(s, &facets, &ring->own));
  PetscCall(PetscMalloc2(4 * facets.n, &ring->node, 4 * facets.n, &ring->twin));
  PetscCall(NumberNodes(u, &facets, ring));
  PetscCall(FindTwins(cosine, facets.x, ring));
  PetscCall(ContactCandidatesDestroy(&facets));
  PetscFunctionReturn(0);
}

/* Collective. Moves the nodes by a global displacement vector */
PetscErrorCode ContactRingDeform(Vec u, ContactRing *ring)
{
  const PetscScalar *a;

  PetscFunctionBegin;
  PetscCall(VecScatterBegin(ring->scatter, u, ring->u, INSERT_VALUES, SCATTER_FORWARD));
  PetscCall(VecScatterEnd(ring->scatter, u, ring->u, INSERT_VALUES, SCATTER_FORWARD));
  PetscCall(VecGetArrayRead(ring->u, &a));
  for (PetscInt i = 0; i < 3 * ring->nnodes; ++i) ring->x[i] = ring->reference[i] + PetscRealPart(a[i]);
  PetscCall(VecRestoreArrayRead(ring->u, &a));
  PetscFunctionReturn(0);
}

/* First corner about a corner's node, clockwise, and the last, as far as no edge is sharp or on the border; true where all around is smooth */
PetscBool ContactRingFan(const ContactRing *ring, PetscInt corner, PetscInt *first, PetscInt *last)
{
  *first = *last = corner;
  while (ring->twin[ContactCornerBefore(*last)] >= 0) {
    *last = ring->twin[ContactCornerBefore(*last)];
    if (*last == corner) {
      *last = ContactCornerAfter(ring->twin[corner]);
      return PETSC_TRUE;
    }
  }
  while (ring->twin[*first] >= 0) *first = ContactCornerAfter(ring->twin[*first]);
  return PETSC_FALSE;
}

/* Coordinates of the ends of the two edges of a facet that meet at a corner, from the corner's own */
void ContactRingEdges(const ContactRing *ring, PetscInt corner, PetscReal after[3], PetscReal before[3])
{
  const PetscReal *x = &ring->x[3 * ring->node[corner]], *y = &ring->x[3 * ring->node[ContactCornerAfter(corner)]], *z = &ring->x[3 * ring->node[ContactCornerBefore(corner)]];

  for (PetscInt c = 0; c < 3; ++c) {
    after[c]  = y[c] - x[c];
    before[c] = z[c] - x[c];
  }
}

PetscErrorCode ContactRingDestroy(ContactRing *ring)
{
  PetscFunctionBegin;
  PetscCall(PetscFree2(ring->node, ring->twin));
  PetscCall(PetscFree2(ring->reference, ring->x));
  PetscCall(VecDestroy(&ring->u));
  PetscCall(VecScatterDestroy(&ring->scatter));
  PetscFunctionReturn(0);
}
