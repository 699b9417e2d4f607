/* The boundary of a grid, and its regions: the parts between edges at which the normals of the facets make more than a
   given angle */
#include "shapesimpl.h"
#include <stdlib.h>
#include <vector3.h>

int ShapeCompareItems(const void *a, const void *b)
{
  const ShapeItem *x = (const ShapeItem *)a, *y = (const ShapeItem *)b;

  for (int i = 0; i < 4; ++i) {
    if (x->key[i] != y->key[i]) return x->key[i] < y->key[i] ? -1 : 1;
  }
  return 0;
}

static int RegionCompareSides(const void *a, const void *b)
{
  const int order = ShapeCompareItems(a, b);

  return order ? order : (((const ShapeItem *)a)->at < ((const ShapeItem *)b)->at ? -1 : 1);
}

/* Sets the key of a facet with 4 vertices. A triangle repeats its last vertex; its key contains -1 in place of the
   repetition. */
static PetscErrorCode RegionFacetKey(const PetscInt vertex[4], PetscInt at, ShapeItem *key)
{
  PetscFunctionBegin;
  for (PetscInt a = 0; a < 4; ++a) key->key[a] = a == 3 && vertex[3] == vertex[2] ? -1 : vertex[a];
  PetscCall(PetscSortInt(4, key->key));
  key->at = at;
  PetscFunctionReturn(0);
}

/* Returns the number, among the corners of a cell, of vertex a of side s */
static PetscInt RegionSide(PetscInt ncorners, PetscInt s, PetscInt a)
{
  static const PetscInt hexahedron[6][4]  = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1},
     {4, 5, 7, 6}};
  static const PetscInt tetrahedron[4][4] = {{0, 2, 1, 1}, {0, 1, 3, 3}, {1, 2, 3, 3}, {0, 3, 2, 2}};

  return ncorners == 4 ? tetrahedron[s][a] : hexahedron[s][a];
}

/* Reorders the vertices of a facet so that they are counterclockwise seen from outside its cell */
static void RegionTurnOutside(const ShapeGrid *grid, const PetscReal x[], PetscInt cell, PetscInt vertex[4])
{
  PetscReal d[2][3], n[3], out[3];

  for (PetscInt c = 0; c < 3; ++c) {
    d[0][c] = x[3 * vertex[2] + c] - x[3 * vertex[0] + c];
    d[1][c] = x[3 * vertex[3] + c] - x[3 * vertex[1] + c];
    out[c]  = (x[3 * vertex[0] + c] + x[3 * vertex[1] + c] + x[3 * vertex[2] + c]) / 3;
    for (PetscInt a = 0; a < grid->ncorners; ++a)
      out[c] -= x[3 * grid->cells[grid->ncorners * cell + a] + c] / (PetscReal)grid->ncorners;
  }
  VectorCross(d[0], d[1], n);
  if (VectorDot(n, out) >= 0) return;
  if (vertex[2] == vertex[3]) {
    const PetscInt swap = vertex[0];

    vertex[0] = vertex[1];
    vertex[1] = swap;
  } else {
    const PetscInt swap = vertex[1];

    vertex[1] = vertex[3];
    vertex[3] = swap;
  }
}

PetscErrorCode ShapeBoundaryCreate(const ShapeGrid *grid, const PetscReal x[], ShapeBoundary *b)
{
  const PetscInt nsides = grid->ncorners == 4 ? 4 : 6, n = nsides * grid->ncells;
  ShapeItem     *keys;
  PetscInt      *sides;

  PetscFunctionBegin;
  PetscCall(PetscMalloc2(n, &keys, n, &sides));
  for (PetscInt i = 0; i < n; ++i) {
    PetscInt vertex[4];

    for (PetscInt a = 0; a < 4; ++a)
      vertex[a] = grid->cells[grid->ncorners * (i / nsides) + RegionSide(grid->ncorners, i % nsides, a)];
    PetscCall(RegionFacetKey(vertex, i, &keys[i]));
  }
  if (n) qsort(keys, (size_t)n, sizeof(*keys), RegionCompareSides);
  b->n = 0;
  for (PetscInt i = 0; i < n; ++i) {
    const PetscBool before = (PetscBool)(i && !ShapeCompareItems(&keys[i], &keys[i - 1]));
    const PetscBool after  = (PetscBool)(i + 1 < n && !ShapeCompareItems(&keys[i], &keys[i + 1]));

    if (!before && !after) sides[b->n++] = keys[i].at;
  }
  PetscCall(PetscSortInt(b->n, sides)); /* The facets are in the order of the cells. */
  PetscCall(PetscMalloc2(4 * b->n, &b->vertex, b->n, &b->region));
  for (PetscInt f = 0; f < b->n; ++f) {
    const PetscInt cell = sides[f] / nsides;

    for (PetscInt a = 0; a < 4; ++a)
      b->vertex[4 * f + a] = grid->cells[grid->ncorners * cell + RegionSide(grid->ncorners, sides[f] % nsides, a)];
    RegionTurnOutside(grid, x, cell, &b->vertex[4 * f]);
    b->region[f] = f;
  }
  b->nregions = b->n;
  PetscCall(PetscFree2(keys, sides));
  PetscFunctionReturn(0);
}

PetscErrorCode ShapeBoundaryDestroy(ShapeBoundary *b)
{
  PetscFunctionBegin;
  PetscCall(PetscFree2(b->vertex, b->region));
  PetscFunctionReturn(0);
}

void ShapeFacetNormal(const PetscReal x[], const PetscInt vertex[4], PetscReal n[3])
{
  PetscReal d[2][3];

  for (PetscInt c = 0; c < 3; ++c) {
    d[0][c] = x[3 * vertex[2] + c] - x[3 * vertex[0] + c];
    d[1][c] = x[3 * vertex[3] + c] - x[3 * vertex[1] + c];
  }
  VectorCross(d[0], d[1], n);
  (void)VectorScaleToUnit(n);
}

/* Returns the first facet of the region of facet f, while regions are being merged. Shortens the path for later
   searches. */
static PetscInt RegionFind(PetscInt parent[], PetscInt f)
{
  while (parent[f] != f) f = parent[f] = parent[parent[f]];
  return f;
}

/* Numbers the regions in the order of their first facets */
static void RegionNumber(ShapeBoundary *b)
{
  b->nregions = 0;
  for (PetscInt f = 0; f < b->n; ++f) b->region[f] = RegionFind(b->region, f);
  for (PetscInt f = 0; f < b->n; ++f) b->region[f] = b->region[f] == f ? -1 - b->nregions++ : b->region[f];
  for (PetscInt f = 0; f < b->n; ++f) b->region[f] = b->region[f] < 0 ? -1 - b->region[f] : b->region[b->region[f]];
}

PetscErrorCode ShapeBoundarySplit(const PetscReal x[], PetscReal degrees, ShapeBoundary *b)
{
  const PetscReal cosine = PetscCosReal(degrees * PETSC_PI / 180);
  ShapeItem      *edges;
  PetscInt        n = 0;

  PetscFunctionBegin;
  PetscCall(PetscCalloc1(4 * b->n, &edges));
  for (PetscInt i = 0; i < 4 * b->n; ++i) {
    const PetscInt from = b->vertex[i], to = b->vertex[i % 4 == 3 ? i - 3 : i + 1];

    if (from == to) continue;
    edges[n].key[0] = PetscMin(from, to);
    edges[n].key[1] = PetscMax(from, to);
    edges[n++].at   = i / 4;
  }
  if (n) qsort(edges, (size_t)n, sizeof(*edges), ShapeCompareItems);
  for (PetscInt i = 0, end; i < n; i = end) {
    PetscReal n1[3], n2[3];

    for (end = i + 1; end < n && !ShapeCompareItems(&edges[i], &edges[end]);) ++end;
    if (end - i != 2) continue;
    ShapeFacetNormal(x, &b->vertex[4 * edges[i].at], n1);
    ShapeFacetNormal(x, &b->vertex[4 * edges[i + 1].at], n2);
    if (VectorDot(n1, n2) >= cosine) {
      const PetscInt one = RegionFind(b->region, edges[i].at), two = RegionFind(b->region, edges[i + 1].at);

      b->region[PetscMax(one, two)] = PetscMin(one, two);
    }
  }
  RegionNumber(b);
  PetscCall(PetscFree(edges));
  PetscFunctionReturn(0);
}

PetscErrorCode ShapeBoundaryMatchFaces(const ShapeBoundary *b, const ShapeGrid *grid, PetscInt nfaces, PetscInt name[])
{
  ShapeItem *keys;
  PetscInt  *count, *facets;

  PetscFunctionBegin;
  PetscCall(PetscMalloc1(b->n, &keys));
  PetscCall(PetscCalloc2(b->nregions, &count, nfaces, &facets));
  for (PetscInt f = 0; f < b->n; ++f) {
    PetscCall(RegionFacetKey(&b->vertex[4 * f], b->region[f], &keys[f]));
    ++count[b->region[f]];
  }
  if (b->n) qsort(keys, (size_t)b->n, sizeof(*keys), ShapeCompareItems);
  for (PetscInt f = 0; f < nfaces; ++f) name[f] = PETSC_DECIDE;
  for (PetscInt q = 0; q < grid->nfacets; ++q) {
    const PetscInt   f = grid->facetface[q];
    ShapeItem        key;
    const ShapeItem *found;

    if (f >= nfaces) continue;
    PetscCall(RegionFacetKey(&grid->facets[4 * q], 0, &key));
    found = (const ShapeItem *)bsearch(&key, keys, (size_t)b->n, sizeof(key), ShapeCompareItems);
    if (!found || (name[f] >= 0 && name[f] != found->at)) name[f] = -2; /* The face has facets on several regions. */
    else if (name[f] == PETSC_DECIDE) name[f] = found->at;
    ++facets[f];
  }
  for (PetscInt f = 0; f < nfaces; ++f) {
    if (name[f] >= 0 && facets[f] != count[name[f]]) name[f] = -2; /* The face is only a part of a region. */
  }
  PetscCall(PetscFree2(count, facets));
  PetscCall(PetscFree(keys));
  PetscFunctionReturn(0);
}

PetscErrorCode ShapeBoundaryUseFaces(const ShapeGrid *grid, PetscInt nfaces, ShapeBoundary *b)
{
  ShapeItem *keys;

  PetscFunctionBegin;
  PetscCall(PetscMalloc1(grid->nfacets, &keys));
  for (PetscInt q = 0; q < grid->nfacets; ++q)
    PetscCall(RegionFacetKey(&grid->facets[4 * q], grid->facetface[q], &keys[q]));
  if (grid->nfacets) qsort(keys, (size_t)grid->nfacets, sizeof(*keys), ShapeCompareItems);
  b->nregions = nfaces;
  for (PetscInt f = 0; f < b->n; ++f) {
    ShapeItem        key;
    const ShapeItem *found;

    PetscCall(RegionFacetKey(&b->vertex[4 * f], 0, &key));
    found = (const ShapeItem *)bsearch(&key, keys, (size_t)grid->nfacets, sizeof(key), ShapeCompareItems);
    PetscCheck(found, PETSC_COMM_SELF, PETSC_ERR_PLIB, "A boundary facet of a shape is on none of its faces");
    b->region[f] = found->at;
  }
  PetscCall(PetscFree(keys));
  PetscFunctionReturn(0);
}
