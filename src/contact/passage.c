/*
   Finds vertices that pass through the other face of a pair between two states. Vertices and facets move along straight
   lines. The whole path is tested, because a vertex that has passed right through a body has no face in front of it at
   the end.
*/
#include "contactimpl.h"

#define PASSAGE_PARTS  16 /* number of parts of the path; in each, at most one passage through a facet is found */
#define PASSAGE_EVENTS 32 /* largest number of passages of a vertex through facets; more are ignored */

/* A passage of a vertex through a facet, at a time in [0, 1] */
typedef struct {
  PetscReal time;
  PetscInt  direction; /* 1 into the body, -1 out of it */
} PassageEvent;

/* A vertex and the corners of a triangle, at the beginning and at the end of the path */
typedef struct {
  PetscReal x[2][3], corner[2][3][3];
} PassageTriangle;

/* Returns the height of the vertex above the triangle at a time [length]. Computes the barycentric coordinates b of its
   projection onto the triangle. */
static PetscReal PassageHeight(const PassageTriangle *p, PetscReal time, PetscReal b[3])
{
  PetscReal e[3][3], r[3], n[3], cross[3], square;

  for (PetscInt c = 0; c < 3; ++c) {
    PetscReal corner[3];

    for (PetscInt a = 0; a < 3; ++a) corner[a] = p->corner[0][a][c] + time * (p->corner[1][a][c] - p->corner[0][a][c]);
    for (PetscInt a = 0; a < 3; ++a) e[a][c] = corner[(a + 1) % 3] - corner[a];
    r[c] = p->x[0][c] + time * (p->x[1][c] - p->x[0][c]) - corner[0];
  }
  VectorCross(e[0], e[1], n);
  square = VectorDot(n, n);
  if (!(square > 0.0)) return 0.0;
  VectorCross(e[0], r, cross);
  b[2] = VectorDot(n, cross) / square;
  VectorCross(e[2], r, cross);
  b[1] = VectorDot(n, cross) / square;
  b[0] = 1.0 - b[1] - b[2];
  return VectorDot(n, r) / PetscSqrtReal(square);
}

/* Appends the times at which the vertex passes through the triangle, which is moved inwards by `inside` [length] */
static void PassageFindEvents(const PassageTriangle *p, PetscReal inside, PetscInt *n, PassageEvent events[])
{
  const PetscReal edge = 1e-6;
  PetscReal       b[3], before = PassageHeight(p, 0.0, b) + inside;

  for (PetscInt k = 0; k < PASSAGE_PARTS; ++k) {
    PetscReal low = (PetscReal)k / PASSAGE_PARTS, high = (PetscReal)(k + 1) / PASSAGE_PARTS;
    PetscReal after = PassageHeight(p, high, b) + inside;
    PetscBool in    = (PetscBool)(before >= 0.0);

    if (in != (PetscBool)(after >= 0.0)) {
      while (high - low > PETSC_SQRT_MACHINE_EPSILON) {
        const PetscReal middle = 0.5 * (low + high);

        if ((PetscBool)(PassageHeight(p, middle, b) + inside >= 0.0) == in) low = middle;
        else high = middle;
      }
      (void)PassageHeight(p, high, b);
      if (PetscMin(PetscMin(b[0], b[1]), b[2]) > -edge && *n < PASSAGE_EVENTS)
        events[(*n)++] = (PassageEvent){high, in ? 1 : -1};
    }
    before = after;
  }
}

/* Returns how many times more often the vertex enters the body than it leaves it. Passages through facets that share an
   edge, which have equal times, count once. */
static PetscInt PassageCount(PetscInt n, const PassageEvent events[])
{
  const PetscReal same  = 1e-6;
  PetscInt        count = 0;

  for (PetscInt i = 0; i < n; ++i) {
    PetscBool first = PETSC_TRUE;

    for (PetscInt j = 0; j < i; ++j)
      first = (PetscBool)(first && (events[i].direction != events[j].direction ||
                                     PetscAbsReal(events[i].time - events[j].time) > same));
    if (first) count += events[i].direction;
  }
  return count;
}

/* Returns the depth, at the end, of a vertex that has entered the body through the facets and has not left it again
   [length], or 0 if it is outside */
static PetscReal PassageOfVertex(const ContactTree *tree, const ContactCandidates facets[2], PetscReal inside,
  const PetscReal x0[3], const PetscReal x1[3])
{
  PetscInt     stack[CONTACT_TREE_DEPTH], depth = 0, n = 0;
  PetscReal    deepest = 0.0, box[6];
  PassageEvent events[PASSAGE_EVENTS];

  for (PetscInt c = 0; c < 3; ++c) {
    box[c]     = PetscMin(x0[c], x1[c]) - inside;
    box[3 + c] = PetscMax(x0[c], x1[c]) + inside;
  }
  if (tree->nnodes) stack[depth++] = 0;
  while (depth) {
    const PetscInt         self = stack[--depth];
    const ContactTreeNode *node = &tree->node[self];

    if (!ContactBoxesMeet(node->box, box)) continue;
    if (node->second) {
      stack[depth++] = self + 1;
      stack[depth++] = node->second;
      continue;
    }
    for (PetscInt i = node->first; i < node->last; ++i) {
      for (PetscInt half = 0; half < 2; ++half) {
        const PetscInt  corner[3] = {0, half + 1, half + 2}, before = n;
        PassageTriangle p;
        PetscReal       b[3];

        for (PetscInt c = 0; c < 3; ++c) {
          p.x[0][c] = x0[c];
          p.x[1][c] = x1[c];
          for (PetscInt k = 0; k < 6; ++k)
            p.corner[k / 3][k % 3][c] = facets[k / 3].x[12 * tree->order[i] + 3 * corner[k % 3] + c];
        }
        PassageFindEvents(&p, inside, &n, events);
        if (n > before) deepest = PetscMax(deepest, -PassageHeight(&p, 1.0, b));
      }
    }
  }
  return PassageCount(n, events) > 0 ? deepest : 0.0;
}

/* Enlarges the boxes of the tree, which contain the facets at the end of the path, to contain them at the beginning
   too */
static void PassageWiden(const ContactCandidates facets[2], ContactTree *tree)
{
  for (PetscInt k = tree->nnodes - 1; k >= 0; --k) { /* Children have larger numbers than their parents. */
    ContactTreeNode *node = &tree->node[k];

    for (PetscInt c = 0; node->second && c < 3; ++c) {
      node->box[c]     = PetscMin(tree->node[k + 1].box[c], tree->node[node->second].box[c]);
      node->box[3 + c] = PetscMax(tree->node[k + 1].box[3 + c], tree->node[node->second].box[3 + c]);
    }
    for (PetscInt i = node->first; !node->second && i < node->last; ++i) {
      PetscReal box[6];

      ContactFacetBox(&facets[0].x[12 * tree->order[i]], box);
      for (PetscInt c = 0; c < 3; ++c) {
        node->box[c]     = PetscMin(node->box[c], box[c]);
        node->box[3 + c] = PetscMax(node->box[3 + c], box[3 + c]);
      }
    }
  }
}

/* Tests the vertices of one side, which move from x0 to the surface's current coordinates. facets: the facets of the
   other side at the beginning and at the end. *deepest is increased to the largest depth [length]. */
static PetscErrorCode PassageOfSide(const ContactSurface *side, const PetscReal x0[], const ContactCandidates facets[2],
  PetscReal inside, PetscReal *deepest)
{
  ContactTree tree;

  PetscFunctionBegin;
  PetscCall(ContactTreeCreate(&facets[1], &tree));
  PassageWiden(facets, &tree);
  for (PetscInt v = 0; v < 4 * side->nfacets; ++v)
    *deepest = PetscMax(*deepest, PassageOfVertex(&tree, facets, inside, &x0[3 * v], &side->x[3 * v]));
  PetscCall(ContactTreeDestroy(&tree));
  PetscFunctionReturn(0);
}

/* Sets *turned to true if a facet has rotated by more than 90 degrees since its vertices were at x0 */
static void PassageFindTurned(const ContactSurface *side, const PetscReal x0[], PetscBool *turned)
{
  for (PetscInt f = 0; f < side->nfacets; ++f) {
    PetscReal n0[3], n1[3];

    if (!ContactFacetNormal(&x0[12 * f], n0) || !ContactFacetNormal(&side->x[12 * f], n1)) continue;
    if (VectorDot(n0, n1) < 0.0) *turned = PETSC_TRUE;
  }
}

/*
   Collective. Finds vertices of the faces of pair p that have passed through the other face between the global
   displacements u0 and u1, and computes the largest depth.

   - moved: bound of the displacement of a vertex along an axis [length]. Nothing is done if 2 sqrt(3) times this bound
     does not exceed the search depth.
   - depth: depth of the deepest of these vertices at u1 [length]; 0 if there is none
   - reach: search depth of the pair [length]
   - turned: whether a facet of one of the faces has rotated by more than 90 degrees

   Vertices and facets are assumed to move along straight lines. A vertex that leaves the body again does not count.
   Vertices that are inside the other body by less than a tenth of `reach` count as outside.
*/
PetscErrorCode ContactGetPassage(Contact contact, PetscInt p, PetscReal moved, Vec u0, Vec u1, PetscReal *depth,
  PetscReal *reach, PetscBool *turned)
{
  const PetscReal   all[6]  = {PETSC_MIN_REAL, PETSC_MIN_REAL, PETSC_MIN_REAL, PETSC_MAX_REAL, PETSC_MAX_REAL,
       PETSC_MAX_REAL};
  ContactPairData  *pair    = &contact->pairs[p];
  ContactSurface   *side[2] = {&pair->nonmortar, &pair->mortar};
  ContactCandidates facets[2][2];
  PetscReal        *x0[2];

  PetscFunctionBegin;
  *depth  = 0.0;
  *reach  = pair->depth;
  *turned = PETSC_FALSE;
  if (pair->formula || 2.0 * PetscSqrtReal(3.0) * moved <= pair->depth) PetscFunctionReturn(0);
  for (PetscInt k = 0; k < 2; ++k) {
    PetscCall(ContactDeform(contact, k ? u1 : u0));
    for (PetscInt s = 0; s < 2; ++s) {
      PetscCall(ContactExchange(contact->comm, all, side[1 - s], &facets[s][k]));
      if (k) continue;
      PetscCall(PetscMalloc1(12 * side[s]->nfacets, &x0[s]));
      PetscCall(PetscArraycpy(x0[s], side[s]->x, 12 * side[s]->nfacets));
    }
  }
  for (PetscInt s = 0; s < 2; ++s) {
    if (!s || !pair->mortar.self) PetscCall(PassageOfSide(side[s], x0[s], facets[s], 0.1 * pair->depth, depth));
    PassageFindTurned(side[s], x0[s], turned);
    for (PetscInt k = 0; k < 2; ++k) PetscCall(ContactCandidatesDestroy(&facets[s][k]));
    PetscCall(PetscFree(x0[s]));
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, depth, 1, MPIU_REAL, MPIU_MAX, contact->comm));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, turned, 1, MPI_PETSCBOOL, MPI_LOR, contact->comm));
  PetscFunctionReturn(0);
}
