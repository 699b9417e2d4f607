/* A static tree of the facets' bounding boxes. It is built in O(N log N) operations, and a search takes O(log N) for
   each facet found. */
#include "searchimpl.h"

#define TREE_LEAF_SIZE 4

/* Returns twice the coordinate of the centre of a facet's box along an axis [length] */
static inline PetscReal TreeCentre(const ContactTree *t, PetscInt facet, PetscInt axis)
{
  return t->box[6 * facet + axis] + t->box[6 * facet + 3 + axis];
}

/* Reorders order[lo..hi] by Hoare's selection so that no facet before position k has a larger centre than one after
   position k */
static void TreeSelectMedian(ContactTree *t, PetscInt axis, PetscInt lo, PetscInt hi, PetscInt k)
{
  while (lo < hi) {
    const PetscReal pivot = TreeCentre(t, t->order[lo + (hi - lo) / 2], axis);
    PetscInt        i = lo, j = hi;

    while (i <= j) {
      while (TreeCentre(t, t->order[i], axis) < pivot) ++i;
      while (TreeCentre(t, t->order[j], axis) > pivot) --j;
      t->work += 2.0;
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

/* Creates the node of the facets order[first] to order[last - 1] and, unless they fit into a leaf, its children. The
   facets are split at the median along the axis along which their centres extend furthest. */
static void TreeBuild(ContactTree *t, PetscInt first, PetscInt last)
{
  const PetscInt   self = t->nnodes++;
  PetscReal        lower[3], upper[3];
  PetscInt         axis = 0;
  ContactTreeNode *node = &t->node[self];

  *node = (ContactTreeNode){.first = first, .last = last, .second = 0};
  t->work += 12.0 * (last - first);
  for (PetscInt c = 0; c < 3; ++c) {
    lower[c] = upper[c] = TreeCentre(t, t->order[first], c);
    node->box[c]        = t->box[6 * t->order[first] + c];
    node->box[3 + c]    = t->box[6 * t->order[first] + 3 + c];
    for (PetscInt i = first + 1; i < last; ++i) {
      const PetscInt f = t->order[i];

      lower[c]         = PetscMin(lower[c], TreeCentre(t, f, c));
      upper[c]         = PetscMax(upper[c], TreeCentre(t, f, c));
      node->box[c]     = PetscMin(node->box[c], t->box[6 * f + c]);
      node->box[3 + c] = PetscMax(node->box[3 + c], t->box[6 * f + 3 + c]);
    }
    if (upper[c] - lower[c] > upper[axis] - lower[axis]) axis = c;
  }
  if (last - first > TREE_LEAF_SIZE) {
    const PetscInt middle = first + (last - first) / 2;

    TreeSelectMedian(t, axis, first, last - 1, middle);
    TreeBuild(t, first, middle);
    t->node[self].second = t->nnodes;
    TreeBuild(t, middle, last);
  }
}

PetscErrorCode ContactTreeCreate(const ContactCandidates *facets, ContactTree *t)
{
  PetscFunctionBegin;
  t->nnodes = 0;
  t->work   = 0.0;
  PetscCall(PetscMalloc3(2 * facets->n, &t->node, facets->n, &t->order, 6 * facets->n, &t->box));
  for (PetscInt f = 0; f < facets->n; ++f) {
    t->order[f] = f;
    ContactFacetBox(&facets->x[12 * f], &t->box[6 * f]);
  }
  if (facets->n) TreeBuild(t, 0, facets->n);
  PetscCall(PetscLogFlops(t->work));
  PetscFunctionReturn(0);
}

PetscErrorCode ContactTreeDestroy(ContactTree *t)
{
  PetscFunctionBegin;
  PetscCall(PetscFree3(t->node, t->order, t->box));
  PetscFunctionReturn(0);
}
