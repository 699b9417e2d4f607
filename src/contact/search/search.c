/* Finds the mortar facets that may face a nonmortar facet, along its normal */
#include "searchimpl.h"

/*
   The prism that a nonmortar facet sweeps along its normal. Below the facet it ends at the search depth. Above the
   facet it ends at the search distance plus the facet's diameter, because a facet that is partly within the search
   distance is integrated as a whole. In contrast, a sphere of that radius would contain more facets the finer the mesh
   is.
*/
typedef struct {
  ContactFrame frame;
  PetscReal    low[3], high[3]; /* bounds in the frame's coordinates [length] */
  /* axis-aligned box that contains the prism */
  PetscReal box[6];
} Prism;

/* Creates the prism of the facet x. Returns false if the facet has no area. */
static PetscBool PrismCreate(const PetscReal x[12], PetscReal distance, PetscReal depth, Prism *p)
{
  PetscReal y[4][2], h[4];

  if (!ContactFrameCreate(x, &p->frame)) return PETSC_FALSE;
  distance += ContactFacetDiameter(x);
  ContactSweptBox(x, distance, depth, p->box);
  ContactFrameProject(&p->frame, x, y, h);
  for (PetscInt d = 0; d < 2; ++d) {
    p->low[d]  = PetscMin(PetscMin(y[0][d], y[1][d]), PetscMin(y[2][d], y[3][d]));
    p->high[d] = PetscMax(PetscMax(y[0][d], y[1][d]), PetscMax(y[2][d], y[3][d]));
  }
  p->low[2]  = PetscMin(PetscMin(h[0], h[1]), PetscMin(h[2], h[3])) - depth;
  p->high[2] = PetscMax(PetscMax(h[0], h[1]), PetscMax(h[2], h[3])) + distance;
  return PETSC_TRUE;
}

/* Returns false if one of the coordinate axes, or one of the prism's axes, separates prism and box */
static PetscBool PrismMeetsBox(const Prism *p, const PetscReal box[6])
{
  if (!ContactBoxesMeet(p->box, box)) return PETSC_FALSE;
  for (PetscInt a = 0; a < 3; ++a) {
    const PetscReal *axis   = p->frame.axis[a];
    PetscReal        centre = 0.0, radius = 0.0;

    for (PetscInt c = 0; c < 3; ++c) {
      centre += axis[c] * (0.5 * (box[c] + box[3 + c]) - p->frame.origin[c]);
      radius += PetscAbsReal(axis[c]) * 0.5 * (box[3 + c] - box[c]);
    }
    if (centre + radius < p->low[a] || centre - radius > p->high[a]) return PETSC_FALSE;
  }
  return PETSC_TRUE;
}

/* Counts the facets whose boxes meet the prism. Stores their numbers in `found` unless it is NULL. The number of boxes
   that were tested is added to *tested. */
static PetscInt SearchTree(const ContactTree *t, const Prism *prism, PetscInt found[], PetscInt *tested)
{
  PetscInt stack[CONTACT_TREE_DEPTH], depth = 0, n = 0;

  if (t->nnodes) stack[depth++] = 0;
  while (depth) {
    const PetscInt         self = stack[--depth];
    const ContactTreeNode *node = &t->node[self];

    ++*tested;
    if (!PrismMeetsBox(prism, node->box)) continue;
    if (node->second) {
      stack[depth++] = node->second;
      stack[depth++] = self + 1;
      continue;
    }
    *tested += node->last - node->first;
    for (PetscInt i = node->first; i < node->last; ++i) {
      if (!PrismMeetsBox(prism, &t->box[6 * t->order[i]])) continue;
      if (found) found[n] = t->order[i];
      ++n;
    }
  }
  return n;
}

/* Lists, for each of this rank's nonmortar facets, the mortar facets along its normal within the search distance and
   depth [length] */
PetscErrorCode ContactSearch(const ContactSurface *s, PetscReal distance, PetscReal depth,
  const ContactCandidates *mortar, ContactNear *near)
{
  ContactTree tree;
  Prism       prism;
  PetscInt    tested = 0;

  PetscFunctionBegin;
  PetscCall(ContactTreeCreate(mortar, &tree));
  PetscCall(PetscMalloc1(s->nfacets + 1, &near->offset));
  near->offset[0] = 0;
  near->facet     = NULL;
  for (PetscInt pass = 0; pass < 2; ++pass) {
    for (PetscInt f = 0; f < s->nfacets; ++f) {
      const PetscBool has = PrismCreate(&s->x[12 * f], distance, depth, &prism);
      const PetscInt  n   = has ? SearchTree(&tree, &prism, pass ? near->facet + near->offset[f] : NULL, &tested) : 0;

      near->offset[f + 1] = near->offset[f] + n;
    }
    if (!pass) PetscCall(PetscMalloc1(near->offset[s->nfacets], &near->facet));
  }
  PetscCall(PetscLogFlops(6.0 * tested));
  PetscCall(ContactTreeDestroy(&tree));
  PetscFunctionReturn(0);
}

PetscErrorCode ContactNearDestroy(ContactNear *near)
{
  PetscFunctionBegin;
  PetscCall(PetscFree(near->offset));
  PetscCall(PetscFree(near->facet));
  PetscFunctionReturn(0);
}
