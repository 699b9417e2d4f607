/* Finds the sides of a Gmsh file's cells by their corners */
#include "gmshimpl.h"
#include <stdlib.h>

/* number of elements per slice. The number of slices is limited, because each slice needs a pass over all elements. */
#define GMSH_SLICE      64
#define GMSH_MAX_SLICES 16

/* The sides of hexahedra, prisms, pyramids and tetrahedra in Gmsh's order of the corners. The table `sides` is indexed
   by the number of corners. */
static const int hexahedron[6][4] = {{0, 1, 2, 3}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6},
  {3, 0, 4, 7}};
static const int prism[3][4] = {{0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}}, pyramid[1][4] = {{0, 1, 2, 3}},
                 tetrahedron[4][4] = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};

static const struct {
  int n, ncorners;
  const int (*corners)[4];
} sides[9] = {[4] = {4, 3, tetrahedron}, [5] = {1, 4, pyramid}, [6] = {3, 4, prism}, [8] = {6, 4, hexahedron}};

/* Returns the facet with these corners */
static GmshFacet GmshFacetOf(int n, const PetscInt64 corners[], PetscInt64 element)
{
  GmshFacet facet = {.nodes = {-1}, .element = element, .across = -1};
  PetscInt *nodes = facet.nodes + 4 - n;
  int       least = 0;

  for (int a = 0; a < n; ++a) {
    int at = a;

    if (corners[a] < corners[least]) least = a;
    for (; at > 0 && nodes[at - 1] > corners[a]; --at) nodes[at] = nodes[at - 1];
    nodes[at] = (PetscInt)corners[a];
  }
  if (n == 4) facet.across = (PetscInt)corners[(least + 2) % 4];
  return facet;
}

void GmshFacetsBegin(GmshFacets *facets, PetscInt nelements)
{
  *facets = (GmshFacets){.nslices = 1 + PetscMin(nelements / GMSH_SLICE, GMSH_MAX_SLICES - 1)};
}

PetscBool GmshFacetsNext(GmshFacets *facets)
{
  facets->n = 0;
  return ++facets->slice < facets->nslices ? PETSC_TRUE : PETSC_FALSE;
}

/* Returns whether a facet with these corners belongs to the present slice */
static PetscBool GmshFacetsHave(const GmshFacets *facets, int n, const PetscInt64 corners[])
{
  PetscInt64 least = corners[0];

  for (int a = 1; a < n; ++a) least = PetscMin(least, corners[a]);
  return ((least < 0 ? -least : least) % facets->nslices) == facets->slice ? PETSC_TRUE : PETSC_FALSE;
}

/* Adds those sides of a cell that belong to the present slice. Elements that are not cells have no sides. */
PetscErrorCode GmshFacetsAdd(const GmshType *type, PetscInt64 element, const PetscInt64 nodes[], GmshFacets *facets)
{
  const int n = type->dim == 3 ? sides[type->ncorners].n : 0;

  PetscFunctionBegin;
  if (facets->n + n > facets->max) {
    facets->max = 2 * facets->max + 64;
    PetscCall(PetscRealloc((size_t)facets->max * sizeof(*facets->list), &facets->list));
  }
  for (int f = 0; f < n; ++f) {
    PetscInt64 corners[4];

    for (int a = 0; a < 4; ++a) corners[a] = nodes[sides[type->ncorners].corners[f][a]];
    if (GmshFacetsHave(facets, sides[type->ncorners].ncorners, corners))
      facets->list[facets->n++] = GmshFacetOf(sides[type->ncorners].ncorners, corners, element);
  }
  PetscFunctionReturn(0);
}

static int GmshCompareFacets(const void *a, const void *b)
{
  const PetscInt *x = ((const GmshFacet *)a)->nodes, *y = ((const GmshFacet *)b)->nodes;

  for (int i = 0; i < 4; ++i) {
    if (x[i] != y[i]) return x[i] < y[i] ? -1 : 1;
  }
  return 0;
}

void GmshFacetsSort(GmshFacets *facets)
{
  if (facets->n) qsort(facets->list, (size_t)facets->n, sizeof(*facets->list), GmshCompareFacets);
}

/* Checks that two cells that share the nodes of a side have the same facet there, and that at most two cells share it.
   The facets must be sorted. */
PetscBool GmshFacetsAgree(const GmshFacets *facets, GmshStream *in)
{
  for (PetscInt64 i = 1; i < facets->n; ++i) {
    const GmshFacet *here = &facets->list[i], *before = here - 1;

    if (GmshCompareFacets(here, before)) continue;
    if (here->across != before->across)
      return GmshWrong(in, "the elements %lld and %lld list the corners of their common facet in different orders",
        (long long)before->element, (long long)here->element);
    if (i > 1 && !GmshCompareFacets(here, here - 2))
      return GmshWrong(in, "the elements %lld, %lld and %lld share one facet, which only two may do",
        (long long)before[-1].element, (long long)before->element, (long long)here->element);
  }
  return PETSC_TRUE;
}

/* Returns whether exactly one facet of the present slice has these corners. A facet that two cells have is inside the
   body. The facets must be sorted. */
PetscBool GmshFacetsBound(const GmshFacets *facets, PetscInt ncorners, const PetscInt64 corners[])
{
  const GmshFacet  wanted = GmshFacetOf((int)ncorners, corners, 0);
  const GmshFacet *end    = facets->list + facets->n, *found;

  if (!GmshFacetsHave(facets, (int)ncorners, corners)) return PETSC_FALSE;
  found = facets->n
            ? (const GmshFacet *)bsearch(&wanted, facets->list, (size_t)facets->n, sizeof(wanted), GmshCompareFacets)
            : NULL;
  if (!found) return PETSC_FALSE;
  if (found > facets->list && !GmshCompareFacets(found - 1, &wanted)) return PETSC_FALSE;
  return found + 1 < end && !GmshCompareFacets(found + 1, &wanted) ? PETSC_FALSE : PETSC_TRUE;
}

PetscErrorCode GmshFacetsDestroy(GmshFacets *facets)
{
  PetscFunctionBegin;
  PetscCall(PetscFree(facets->list));
  facets->n = facets->max = 0;
  PetscFunctionReturn(0);
}
