/*
   Vertices that go through the other face of a pair between two states. Vertices and facets move on straight lines. The
   whole way is tested, because a vertex that went right through a body has no face in front of it at the end.
*/
#include "contactimpl.h"

#define PASSAGE_PARTS  16 /* of the way, in which a side is looked for */
#define PASSAGE_EVENTS 32 /* times that a vertex goes through a facet: more do not count */

typedef struct {
  PetscReal time;
  PetscInt  direction; /* 1 into the body, -1 out of it */
} PassageEvent;

/* A triangle and a vertex, at the beginning and the end */
typedef struct {
  PetscReal x[2][3], corner[2][3][3];
} PassageTriangle;

/* Height of the vertex above the triangle at a time, and its projection onto the triangle in barycentric
   coordinates b */
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

/* Appends the times at which the vertex goes through the triangle, which is moved inwards by `inside` */
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

/* Number of times that the vertex enters the body minus those that it leaves it. Facets that share an edge count
   once. */
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

/* Depth at the end of a vertex that has entered through the facets and not left again [length]; 0: it is outside */
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

/* Boxes of the whole way in place of those at the end */
static void PassageWiden(const ContactCandidates facets[2], ContactTree *tree)
{
  for (PetscInt k = tree->nnodes - 1; k >= 0; --k) { /* children come behind their parents */
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

/* Tests the vertices of one side, which move from x0 to the surface's present position. facets: of the other side.
   deepest: raised to the largest depth */
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

/* Sets *turned if a facet has turned by more than 90 degrees since its corners were at x0 */
static void PassageFindTurned(const ContactSurface *side, const PetscReal x0[], PetscBool *turned)
{
  for (PetscInt f = 0; f < side->nfacets; ++f) {
    PetscReal n0[3], n1[3];

    if (!ContactFacetNormal(&x0[12 * f], n0) || !ContactFacetNormal(&side->x[12 * f], n1)) continue;
    if (VectorDot(n0, n1) < 0.0) *turned = PETSC_TRUE;
  }
}

/* Collective. Finds vertices of the faces of a pair that passed through the other face between two displacements,
   and the largest depth. p: number of the pair; moved: bound of the displacement of a vertex along an axis; penetration
   deeper than 2 sqrt(3) times this is not found [length]; u0, u1: global displacements before and after [length];
   depth: depth of the deepest vertex at u1 [length]; 0: none passed through; reach: depth to which the contact search
   looks [length]; turned: a facet of one of the faces turned by more than 90 degrees. Vertices and facets are assumed
   to move along straight lines. A vertex that leaves the body again does not count. Vertices less than a tenth of the
   reach inside the other body count as outside. */
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
    PetscCall(PassageOfSide(side[s], x0[s], facets[s], 0.1 * pair->depth, depth));
    PassageFindTurned(side[s], x0[s], turned);
    for (PetscInt k = 0; k < 2; ++k) PetscCall(ContactCandidatesDestroy(&facets[s][k]));
    PetscCall(PetscFree(x0[s]));
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, depth, 1, MPIU_REAL, MPIU_MAX, contact->comm));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, turned, 1, MPI_PETSCBOOL, MPI_LOR, contact->comm));
  PetscFunctionReturn(0);
}
