/* Creates a ring: fetches facets from other ranks, numbers nodes, finds neighbours across edges, and numbers normals */
#include "smoothimpl.h"

/* Collective. Computes the box around this rank's undeformed facets, enlarged to contain neighbouring facets. *length:
   size of the largest facet on all ranks [length], by which the box is enlarged */
static PetscErrorCode RingBox(MPI_Comm comm, const ContactSurface *s, PetscReal box[6], PetscReal *length)
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
  *length = largest;
  for (PetscInt c = 0; s->nfacets && c < 3; ++c) {
    box[c] -= 1.01 * largest;
    box[3 + c] += 1.01 * largest;
  }
  PetscFunctionReturn(0);
}

/* Finds this rank's first own facet among the candidates. The own facets are consecutive there. */
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
  PetscCheck(same, PETSC_COMM_SELF, PETSC_ERR_PLIB,
    "A rank does not find its own facets of face \"%s\" in the neighbourhood that it gathered", s->name);
  PetscFunctionReturn(0);
}

/* Collective. Numbers the nodes of the ring from 0, and creates the scatter that gathers their displacements from u */
static PetscErrorCode NumberNodes(Vec u, const ContactCandidates *facets, ContactRing *ring)
{
  PetscInt *global;
  IS        rows;

  PetscFunctionBegin;
  ring->nnodes = 4 * ring->nfacets;
  PetscCall(PetscMalloc1(4 * ring->nfacets, &global));
  PetscCall(PetscArraycpy(global, facets->node, 4 * ring->nfacets));
  PetscCall(PetscSortRemoveDupsInt(&ring->nnodes, global));
  for (PetscInt i = 0; i < 4 * ring->nfacets; ++i)
    PetscCall(PetscFindInt(facets->node[i], ring->nnodes, global, &ring->s.node[i]));
  ring->nreal = ring->nnodes;
  PetscCall(PetscMalloc1(3 * ring->nnodes, &ring->reference));
  PetscCall(PetscMalloc1(3 * ring->nnodes, &ring->s.x));
  PetscCall(PetscCalloc1(ring->nnodes, &ring->prescribed));
  for (PetscInt i = 0; i < 12 * ring->nfacets; ++i) ring->reference[3 * ring->s.node[i / 3] + i % 3] = facets->x[i];
  for (PetscInt i = 0; i < 4 * ring->nfacets; ++i)
    ring->prescribed[ring->s.node[i]] |= facets->border[i / 4] >> 3 * (i % 4) & 7;
  PetscCall(PetscArraycpy(ring->s.x, ring->reference, 3 * ring->nnodes));
  PetscCall(ISCreateBlock(PETSC_COMM_SELF, 3, ring->nnodes, global, PETSC_COPY_VALUES, &rows));
  PetscCall(VecCreateSeq(PETSC_COMM_SELF, 3 * ring->nnodes, &ring->u));
  PetscCall(VecScatterCreate(u, rows, ring->u, NULL, &ring->scatter));
  PetscCall(ISDestroy(&rows));
  PetscCall(PetscFree(global));
  PetscFunctionReturn(0);
}

/* Returns the corner whose edge has the nodes of corner `of` in opposite order. Returns -1 if there is none, or if
   there are several. */
static PetscInt FindTwin(const ContactRing *ring, const PetscInt first[], const PetscInt corner[], PetscInt of)
{
  const PetscInt from = ring->s.node[MeshCornerAfter(&ring->s, of)], to = ring->s.node[of];
  PetscInt       twin = -1;

  for (PetscInt i = first[from]; i < first[from + 1]; ++i) {
    if (ring->s.node[MeshCornerAfter(&ring->s, corner[i])] != to) continue;
    if (twin >= 0) return -1;
    twin = corner[i];
  }
  return twin;
}

/* Computes the unit normal of a facet. Returns false if the facet has no area. */
static PetscBool FacetNormal(const ContactRing *ring, PetscInt f, PetscReal n[3])
{
  PetscReal x[12];

  for (PetscInt i = 0; i < 12; ++i) x[i] = ring->s.x[3 * ring->s.node[4 * f + i / 3] + i % 3];
  return ContactFacetNormal(x, n);
}

/* Finds the neighbouring facets across edges of the undeformed facets that are not sharp. cosine: of the feature
   angle */
static PetscErrorCode FindTwins(PetscReal cosine, ContactRing *ring)
{
  PetscInt *first, *corner; /* [first[v], first[v + 1]) is the range of node v's corners in `corner` */

  PetscFunctionBegin;
  PetscCall(PetscFree(ring->s.twin));
  PetscCall(PetscMalloc1(4 * ring->nfacets, &ring->s.twin));
  PetscCall(PetscCalloc1(ring->nnodes + 2, &first));
  PetscCall(PetscMalloc1(4 * ring->nfacets, &corner));
  for (PetscInt i = 0; i < 4 * ring->nfacets; ++i) first[ring->s.node[i] + 2] += !MeshCornerIsNone(&ring->s, i);
  for (PetscInt v = 0; v < ring->nnodes; ++v) first[v + 2] += first[v + 1];
  for (PetscInt i = 0; i < 4 * ring->nfacets; ++i) {
    if (!MeshCornerIsNone(&ring->s, i)) corner[first[ring->s.node[i] + 1]++] = i;
  }
  for (PetscInt i = 0; i < 4 * ring->nfacets; ++i) {
    const PetscInt twin = MeshCornerIsNone(&ring->s, i) ? -1 : FindTwin(ring, first, corner, i);
    PetscReal      n[3], m[3];
    PetscBool      smooth = (PetscBool)(twin >= 0 && FindTwin(ring, first, corner, twin) == i);

    smooth          = (PetscBool)(smooth && FacetNormal(ring, i / 4, n) && FacetNormal(ring, twin / 4, m));
    ring->s.twin[i] = smooth && VectorDot(n, m) >= cosine ? twin : -1;
  }
  PetscCall(PetscFree(first));
  PetscCall(PetscFree(corner));
  PetscFunctionReturn(0);
}

/* Numbers the normals at the corners of the facets that this rank owns, from 0. The corners of a fan share one normal,
   computed at its first corner. */
static PetscErrorCode NumberNormals(ContactRing *ring, PetscInt nown)
{
  PetscInt *number; /* number of a fan's normal, stored at the first corner of an open fan or at the lowest corner of
                       a closed fan; -1: none yet */

  PetscFunctionBegin;
  ring->nnormals = 0;
  PetscCall(PetscMalloc1(4 * ring->nfacets, &number));
  for (PetscInt i = 0; i < 4 * ring->nfacets; ++i) number[i] = -1;
  PetscCall(PetscMalloc2(4 * nown, &ring->normal, 4 * nown, &ring->at));
  for (PetscInt i = 0; i < 4 * nown; ++i) {
    const PetscInt corner = 4 * ring->own + i;
    PetscInt       first, last;

    if (MeshCornerIsNone(&ring->s, corner)) {
      ring->normal[i] = ring->normal[i - 1];
      continue;
    }
    if (MeshCornerFan(&ring->s, corner, &first, &last)) {
      for (PetscInt k = ring->s.twin[MeshCornerBefore(&ring->s, corner)]; k != corner;
           k          = ring->s.twin[MeshCornerBefore(&ring->s, k)])
        first = PetscMin(first, k);
    }
    if (number[first] < 0) {
      ring->at[ring->nnormals] = corner;
      number[first]            = ring->nnormals++;
    }
    ring->normal[i] = number[first];
  }
  PetscCall(PetscFree(number));
  PetscFunctionReturn(0);
}

/* Collective. Creates the ring. cosine: of the feature angle; u: any displacement vector of the mesh */
PetscErrorCode ContactRingCreate(MPI_Comm comm, Vec u, PetscReal cosine, const ContactSurface *s, ContactRing *ring)
{
  ContactSurface    undeformed = *s;
  ContactCandidates facets;
  PetscReal         box[6], length = 0.0;

  PetscFunctionBegin;
  undeformed.x        = s->reference;
  undeformed.border   = s->prescribed;
  undeformed.bordered = PETSC_TRUE;
  PetscCall(RingBox(comm, s, box, &length));
  PetscCall(ContactExchange(comm, box, &undeformed, &facets));
  ring->nfacets = facets.n;
  PetscCall(FindOwn(s, &facets, &ring->own));
  PetscCall(PetscMalloc1(4 * facets.n, &ring->s.node));
  PetscCall(NumberNodes(u, &facets, ring));
  PetscCall(FindTwins(cosine, ring));
  PetscCall(ContactRingAddImages(comm, length, s->nfacets, ring));
  PetscCall(FindTwins(cosine, ring));
  PetscCall(NumberNormals(ring, s->nfacets));
  PetscCall(ContactCandidatesDestroy(&facets));
  PetscFunctionReturn(0);
}
