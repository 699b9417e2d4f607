/* Which mortar facets may face a nonmortar facet: a static tree of bounding boxes, O(N log N) */
#include "contactimpl.h"

#define LEAF_SIZE 4
#define MAX_DEPTH 128 /* of a median split of any number of facets PetscInt can hold */

/* Depth-first: the first child of a node follows it */
typedef struct {
  PetscReal box[6];      /* lower corner, upper corner */
  PetscInt  first, last; /* facets of a leaf: order[first] to order[last - 1] */
  PetscInt  second;      /* the second child; 0 in a leaf */
} TreeNode;

typedef struct {
  PetscInt   nnodes;
  TreeNode  *node;
  PetscInt  *order;
  PetscReal *box; /* [6 n] of the facets */
} Tree;

/*
  What a nonmortar facet sweeps along its normal, from the depth below it to the distance above it. Only along the normal:
  a ball of that radius would hold more and more facets as the mesh is refined.
*/
typedef struct {
  ContactFrame frame;
  PetscReal    low[3], high[3]; /* in the frame */
  PetscReal    box[6];
} Prism;

void ContactFacetBox(const PetscReal x[12], PetscReal box[6])
{
  for (PetscInt c = 0; c < 3; ++c) {
    box[c]     = PetscMin(PetscMin(x[c], x[3 + c]), PetscMin(x[6 + c], x[9 + c]));
    box[3 + c] = PetscMax(PetscMax(x[c], x[3 + c]), PetscMax(x[6 + c], x[9 + c]));
  }
}

/* Box about what a facet sweeps along its normal; its own box where it has no normal */
void ContactSweptBox(const PetscReal x[12], PetscReal distance, PetscReal depth, PetscReal box[6])
{
  PetscReal n[3];

  ContactFacetBox(x, box);
  if (!ContactFacetNormal(x, n)) return;
  for (PetscInt c = 0; c < 3; ++c) {
    box[c] += PetscMin(n[c] * distance, -n[c] * depth);
    box[3 + c] += PetscMax(n[c] * distance, -n[c] * depth);
  }
}

PetscBool ContactBoxesMeet(const PetscReal a[6], const PetscReal b[6])
{
  for (PetscInt c = 0; c < 3; ++c) {
    if (a[c] > b[3 + c] || b[c] > a[3 + c]) return PETSC_FALSE;
  }
  return PETSC_TRUE;
}

static PetscBool PrismCreate(const PetscReal x[12], PetscReal distance, PetscReal depth, Prism *p)
{
  PetscReal y[4][2], h[4];

  if (!ContactFrameCreate(x, &p->frame)) return PETSC_FALSE;
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

/* False where one of the coordinate axes or the prism's axes separates the two */
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

/* Twice the centre of a facet's box along an axis */
static inline PetscReal Centre(const Tree *t, PetscInt facet, PetscInt axis)
{
  return t->box[6 * facet + axis] + t->box[6 * facet + 3 + axis];
}

/* Hoare's selection: orders order[lo..hi] so that nothing before position k has a larger centre than anything after it */
static void SelectMedian(Tree *t, PetscInt axis, PetscInt lo, PetscInt hi, PetscInt k)
{
  while (lo < hi) {
    const PetscReal pivot = Centre(t, t->order[lo + (hi - lo) / 2], axis);
    PetscInt        i = lo, j = hi;

    while (i <= j) {
      while (Centre(t, t->order[i], axis) < pivot) ++i;
      while (Centre(t, t->order[j], axis) > pivot) --j;
      if (i <= j) {
        const PetscInt swap = t->order[i];

        t->order[i++] = t->order[j];
        t->order[j--] = swap;
      }
    }
    if (k <= j) hi = j;
    else if (k >= i) lo = i;
    else return;
  }
}

static void TreeBuild(Tree *t, PetscInt first, PetscInt last)
{
  const PetscInt self = t->nnodes++;
  PetscReal      lower[3], upper[3];
  PetscInt       axis = 0;
  TreeNode      *node = &t->node[self];

  *node = (TreeNode){.first = first, .last = last, .second = 0};
  for (PetscInt c = 0; c < 3; ++c) {
    lower[c] = upper[c] = Centre(t, t->order[first], c);
    node->box[c]        = t->box[6 * t->order[first] + c];
    node->box[3 + c]    = t->box[6 * t->order[first] + 3 + c];
    for (PetscInt i = first + 1; i < last; ++i) {
      const PetscInt f = t->order[i];

      lower[c]         = PetscMin(lower[c], Centre(t, f, c));
      upper[c]         = PetscMax(upper[c], Centre(t, f, c));
      node->box[c]     = PetscMin(node->box[c], t->box[6 * f + c]);
      node->box[3 + c] = PetscMax(node->box[3 + c], t->box[6 * f + 3 + c]);
    }
    if (upper[c] - lower[c] > upper[axis] - lower[axis]) axis = c;
  }
  if (last - first > LEAF_SIZE) {
    const PetscInt middle = first + (last - first) / 2;

    SelectMedian(t, axis, first, last - 1, middle);
    TreeBuild(t, first, middle);
    t->node[self].second = t->nnodes;
    TreeBuild(t, middle, last);
  }
}

static PetscErrorCode TreeCreate(const ContactCandidates *facets, Tree *t)
{
  PetscFunctionBegin;
  t->nnodes = 0;
  PetscCall(PetscMalloc3(2 * facets->n, &t->node, facets->n, &t->order, 6 * facets->n, &t->box));
  for (PetscInt f = 0; f < facets->n; ++f) {
    t->order[f] = f;
    ContactFacetBox(&facets->x[12 * f], &t->box[6 * f]);
  }
  if (facets->n) TreeBuild(t, 0, facets->n);
  PetscFunctionReturn(0);
}

/* Number of facets whose boxes meet the prism; those are put into found unless it is NULL */
static PetscInt TreeQuery(const Tree *t, const Prism *prism, PetscInt found[])
{
  PetscInt stack[MAX_DEPTH], depth = 0, n = 0;

  if (t->nnodes) stack[depth++] = 0;
  while (depth) {
    const PetscInt  self = stack[--depth];
    const TreeNode *node = &t->node[self];

    if (!PrismMeetsBox(prism, node->box)) continue;
    if (node->second) {
      stack[depth++] = node->second;
      stack[depth++] = self + 1;
      continue;
    }
    for (PetscInt i = node->first; i < node->last; ++i) {
      if (!PrismMeetsBox(prism, &t->box[6 * t->order[i]])) continue;
      if (found) found[n] = t->order[i];
      ++n;
    }
  }
  return n;
}

/* For each of this rank's nonmortar facets, the candidates that may lie along its normal within the search distances */
PetscErrorCode ContactSearch(const ContactPairData *pair, const ContactCandidates *mortar, ContactNear *near)
{
  const ContactSurface *s = &pair->nonmortar;
  Tree                  tree;
  Prism                 prism;

  PetscFunctionBegin;
  PetscCall(TreeCreate(mortar, &tree));
  PetscCall(PetscMalloc1(s->nfacets + 1, &near->offset));
  near->offset[0] = 0;
  near->facet     = NULL;
  for (PetscInt pass = 0; pass < 2; ++pass) {
    for (PetscInt f = 0; f < s->nfacets; ++f) {
      const PetscBool has = PrismCreate(&s->x[12 * f], pair->distance, pair->depth, &prism);
      const PetscInt  n   = has ? TreeQuery(&tree, &prism, pass ? near->facet + near->offset[f] : NULL) : 0;

      near->offset[f + 1] = near->offset[f] + n;
    }
    if (!pass) PetscCall(PetscMalloc1(near->offset[s->nfacets], &near->facet));
  }
  PetscCall(PetscFree3(tree.node, tree.order, tree.box));
  PetscFunctionReturn(0);
}

PetscErrorCode ContactNearDestroy(ContactNear *near)
{
  PetscFunctionBegin;
  PetscCall(PetscFree(near->offset));
  PetscCall(PetscFree(near->facet));
  PetscFunctionReturn(0);
}
