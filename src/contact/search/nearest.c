/* Finds the facet nearest to a vertex by branch and bound in the tree of boxes */
#include "searchimpl.h"

/* Returns the squared distance of the point x from a box, 0 if x is inside [length^2] */
static PetscReal NearestBoxDistance(const PetscReal box[6], const PetscReal x[3])
{
  PetscReal sum = 0.0;

  for (PetscInt c = 0; c < 3; ++c) sum += PetscSqr(PetscMax(PetscMax(box[c] - x[c], x[c] - box[3 + c]), 0.0));
  return sum;
}

/* Makes facet f the nearest facet if its normal opposes the vertex's normal and f is nearer than *distance. Of two
   equally near facets the first one stays. */
static void NearestTryFacet(const ContactCandidates *facets, PetscInt f, PetscReal cosine, const PetscReal x[3],
  const PetscReal normal[3], ContactNearestTest test, const void *context, ContactNearest *nearest, PetscReal *distance)
{
  PetscReal n[3], xi[2], y[3], d;

  if (!ContactFacetNormal(&facets->x[12 * f], n)) return;
  if (VectorDot(n, normal) > cosine) return;
  d = ContactClosestPoint(&facets->x[12 * f], x, xi, y);
  if (d > *distance || (d == *distance && nearest->facet >= 0)) return;
  if (test && !test(context, facets, f, xi)) return;
  *distance      = d;
  nearest->facet = f;
  for (PetscInt c = 0; c < 2; ++c) nearest->xi[c] = xi[c];
  for (PetscInt c = 0; c < 3; ++c) nearest->y[c] = y[c];
}

/* Finds the nearest facet within the distance `reach` of the vertex x. Only facets count for which the cosine of the
   angle between their normal and the vertex's normal is at most `cosine`. nearest->facet is -1 if there is none. */
void ContactFindNearest(const ContactTree *t, const ContactCandidates *facets, PetscReal cosine, PetscReal reach,
  const PetscReal x[3], const PetscReal normal[3], ContactNearestTest test, const void *context,
  ContactNearest *nearest)
{
  PetscInt  stack[CONTACT_TREE_DEPTH], depth = 0;
  PetscReal distance = reach;

  nearest->facet = -1;
  if (t->nnodes) stack[depth++] = 0;
  while (depth) {
    const PetscInt         self = stack[--depth];
    const ContactTreeNode *node = &t->node[self];

    if (NearestBoxDistance(node->box, x) > distance * distance) continue;
    /* The nearer child is popped from the stack first. */
    if (node->second) {
      const PetscBool swap =
        (PetscBool)(NearestBoxDistance(t->node[node->second].box, x) < NearestBoxDistance(t->node[self + 1].box, x));

      stack[depth++] = swap ? self + 1 : node->second;
      stack[depth++] = swap ? node->second : self + 1;
      continue;
    }
    for (PetscInt i = node->first; i < node->last; ++i) {
      const PetscInt f = t->order[i];

      if (NearestBoxDistance(&t->box[6 * f], x) <= distance * distance)
        NearestTryFacet(facets, f, cosine, x, normal, test, context, nearest, &distance);
    }
  }
}
