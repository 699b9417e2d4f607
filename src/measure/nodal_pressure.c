/*
   Computes nodal contact pressures. The pressure of a row is its force divided by the area that the other side covers
   around its vertex. If that area is tiny, both are small and the quotient is inaccurate. Such a vertex passes its
   force and area to the better covered vertices of its facets, in proportion to their areas (agglomeration).
   At an edge of the other side the pressure is singular, and oscillates at the vertices near the edge. Vertices within
   a few facets of partly covered vertices exchange force in proportion to their differences of pressure (smoothing).
   Both steps preserve the sums over a side, keep pressures non-negative, and change nothing elsewhere. Each is the
   product with a matrix between the vertices of the facets.
*/
#include "pair_rows.h"

static const PetscReal cover_ratio     = 0.3; /* a vertex passes its values on if its covered area is below this
                                                 fraction of a neighbour's covered area */
static const PetscReal cover_partial   = 0.8; /* a vertex is partly covered if less than this fraction of its area is
                                                 covered */
static const PetscInt  cover_rings     = 4;   /* number of rings of facets around partly covered vertices in which
                                                 pressures are smoothed */
static const PetscInt  cover_exchanges = 3;
static const PetscReal cover_rounding =
  1e-8; /* relative tolerance of these limits, since the fractions of regular meshes may equal them */

static PetscErrorCode FacetsAddFace(DM dm, const char face[], PairFacets *facets)
{
  PetscSection    section;
  IS              is;
  const PetscInt *points;
  PetscInt        n;

  PetscFunctionBegin;
  PetscCall(DMGetLocalSection(dm, &section));
  PetscCall(MeshGetFacets(dm, face, &is));
  PetscCall(ISGetLocalSize(is, &n));
  PetscCall(ISGetIndices(is, &points));
  PetscCall(PetscRealloc(4 * (facets->n + MESH_MAX_FACET_PIECES * n) * sizeof(PetscInt), &facets->offset));
  for (PetscInt f = 0; f < n; ++f) {
    PetscInt npieces, pieces[MESH_MAX_FACET_PIECES][4];

    PetscCall(MeshGetFacetPieces(dm, points[f], &npieces, pieces));
    for (PetscInt i = 0; i < 4 * npieces; ++i)
      PetscCall(PetscSectionGetOffset(section, pieces[i / 4][i % 4], &facets->offset[4 * facets->n + i]));
    facets->n += npieces;
  }
  PetscCall(ISRestoreIndices(is, &points));
  PetscCall(ISDestroy(&is));
  PetscFunctionReturn(0);
}

PetscErrorCode PairFacetsCreate(MPI_Comm comm, DM dm, const VertexPlaces *places, const SceneContactPair *pair,
  PairFacets *facets)
{
  ISLocalToGlobalMapping map;
  const PetscInt        *global;
  PetscInt              *row, *column, n;

  PetscFunctionBegin;
  *facets = (PairFacets){0};
  PetscCall(FacetsAddFace(dm, pair->nonmortar, facets));
  facets->nnonmortar = facets->n;
  if (!pair->self) PetscCall(FacetsAddFace(dm, pair->mortar, facets));
  PetscCall(PetscMalloc1(16 * facets->n, &facets->value));
  PetscCall(PetscMalloc2(16 * facets->n, &row, 16 * facets->n, &column));
  PetscCall(DMGetLocalToGlobalMapping(dm, &map));
  PetscCall(ISLocalToGlobalMappingGetIndices(map, &global));
  for (PetscInt k = 0; k < 16 * facets->n; ++k) {
    row[k]    = global[facets->offset[k / 4]] / 3;
    column[k] = global[facets->offset[4 * (k / 16) + k % 4]] / 3;
  }
  PetscCall(ISLocalToGlobalMappingRestoreIndices(map, &global));
  PetscCall(VecGetLocalSize(places->x, &n));
  PetscCall(MatCreate(comm, &facets->between));
  PetscCall(MatSetSizes(facets->between, n / 3, n / 3, PETSC_DETERMINE, PETSC_DETERMINE));
  PetscCall(MatSetType(facets->between, MATAIJ));
  PetscCall(MatSetPreallocationCOO(facets->between, 16 * facets->n, row, column));
  PetscCall(PetscFree2(row, column));
  PetscFunctionReturn(0);
}

PetscErrorCode PairFacetsDestroy(PairFacets *facets)
{
  PetscFunctionBegin;
  PetscCall(MatDestroy(&facets->between));
  PetscCall(PetscFree(facets->value));
  PetscCall(PetscFree(facets->offset));
  PetscFunctionReturn(0);
}

/* Sets `between` to the matrix whose product with a vector is, at each node, the sum over the corners of the node's
   facets, of which the first n count */
PetscErrorCode PairFacetsJoin(PairFacets *facets, PetscInt n)
{
  PetscFunctionBegin;
  for (PetscInt k = 0; k < 16 * facets->n; ++k) facets->value[k] = k < 16 * n ? 1.0 : 0.0;
  PetscCall(MatSetValuesCOO(facets->between, facets->value, INSERT_VALUES));
  PetscFunctionReturn(0);
}

/* Computes the area of faces around each of their nodes [length^2] */
PetscErrorCode PairFacetsMeasure(Elasticity elasticity, const VertexPlaces *places, PetscInt nfaces,
  const char *const faces[], Vec size)
{
  Vec areas;

  PetscFunctionBegin;
  PetscCall(VecDuplicate(places->x, &areas));
  PetscCall(VecZeroEntries(areas));
  for (PetscInt k = 0; k < nfaces; ++k) PetscCall(ElasticityAddFacetAreas(elasticity, faces[k], areas));
  PetscCall(VecPointwiseMult(areas, areas, areas));
  for (PetscInt c = 0; c < 3; ++c) PetscCall(VecStrideGather(areas, c, size, c ? ADD_VALUES : INSERT_VALUES));
  PetscCall(VecSqrtAbs(size));
  PetscCall(VecDestroy(&areas));
  PetscFunctionReturn(0);
}

/* Creates the local vector of two values per node, which are components 0 and 1 of three */
static PetscErrorCode CoverGetLocal(DM dm, Vec first, Vec second, Vec *local)
{
  Vec both;

  PetscFunctionBegin;
  PetscCall(DMGetGlobalVector(dm, &both));
  PetscCall(DMGetLocalVector(dm, local));
  PetscCall(VecStrideScatter(first, 0, both, INSERT_VALUES));
  PetscCall(VecStrideScatter(second, 1, both, INSERT_VALUES));
  PetscCall(DMGlobalToLocal(dm, both, INSERT_VALUES, *local));
  PetscCall(DMRestoreGlobalVector(dm, &both));
  PetscFunctionReturn(0);
}

/*
   Lets each vertex with a small covered area pass its values to better covered vertices of its facets, until none has
   values to pass on. This terminates, since covered areas only grow. cover: fraction of each vertex's area that is
   covered; values: n vectors, of which the first is the area
*/
static PetscErrorCode CoverAgglomerate(DM dm, PairFacets *facets, Vec cover, PetscInt n, Vec values[])
{
  const PetscScalar *r;
  PetscScalar        left = 1.0;
  Vec                local, sum, keep, part;

  PetscFunctionBegin;
  PetscCall(CoverGetLocal(dm, cover, values[0], &local));
  PetscCall(VecGetArrayRead(local, &r));
  for (PetscInt k = 0; k < 16 * facets->n; ++k) {
    const PetscInt  a = facets->offset[k / 4], b = facets->offset[4 * (k / 16) + k % 4];
    const PetscReal own = PetscRealPart(r[a]);

    facets->value[k] = own > 0.0 && own < (1.0 - cover_rounding) * cover_ratio * PetscRealPart(r[b]) ? r[b + 1] : 0.0;
  }
  PetscCall(VecRestoreArrayRead(local, &r));
  PetscCall(DMRestoreLocalVector(dm, &local));
  PetscCall(MatSetValuesCOO(facets->between, facets->value, INSERT_VALUES));
  PetscCall(VecDuplicate(cover, &sum));
  PetscCall(VecDuplicate(cover, &keep));
  PetscCall(VecDuplicate(cover, &part));
  PetscCall(MatGetRowSum(facets->between, sum)); /* areas to which a vertex passes its values; 0: to none */
  PetscCall(VecQuotient_AMGF(keep, sum, sum));   /* a quotient by 0 is 0 */
  PetscCall(VecScale(keep, -1.0));
  PetscCall(VecShift(keep, 1.0));
  while (PetscRealPart(left) > 0.0) {
    for (PetscInt k = 0; k < n; ++k) {
      PetscCall(VecQuotient_AMGF(part, values[k], sum));
      PetscCall(VecPointwiseMult(values[k], values[k], keep));
      PetscCall(MatMultTransposeAdd(facets->between, part, values[k], values[k]));
    }
    PetscCall(VecQuotient_AMGF(part, values[0], sum));
    PetscCall(VecSum(part, &left));
  }
  PetscCall(VecDestroy(&sum));
  PetscCall(VecDestroy(&keep));
  PetscCall(VecDestroy(&part));
  PetscFunctionReturn(0);
}

/* Sets `edge` to a positive number at partly covered vertices, and then, ring by ring, at all vertices of facets that
   contain such a vertex; and to 0 elsewhere */
static PetscErrorCode CoverFindEdge(PairFacets *facets, Vec cover, Vec edge)
{
  const PetscScalar *r;
  PetscScalar       *e;
  PetscInt           n;
  Vec                ring;

  PetscFunctionBegin;
  PetscCall(VecGetLocalSize(cover, &n));
  PetscCall(VecGetArrayRead(cover, &r));
  PetscCall(VecGetArrayWrite(edge, &e));
  for (PetscInt i = 0; i < n; ++i)
    e[i] = PetscRealPart(r[i]) > 0.0 && PetscRealPart(r[i]) < (1.0 - cover_rounding) * cover_partial ? 1.0 : 0.0;
  PetscCall(VecRestoreArrayWrite(edge, &e));
  PetscCall(VecRestoreArrayRead(cover, &r));
  PetscCall(PairFacetsJoin(facets, facets->n));
  PetscCall(VecDuplicate(edge, &ring));
  for (PetscInt k = 1; k < cover_rings; ++k) {
    PetscCall(MatMult(facets->between, edge, ring));
    PetscCall(VecCopy(ring, edge));
  }
  PetscCall(VecDestroy(&ring));
  PetscFunctionReturn(0);
}

/*
   Sets `between` to the matrix of the exchanges of force between the vertices of facets near the edge, per pressure:
   the off-diagonal entries of each facet's mass matrix times the difference of the pressures
*/
static PetscErrorCode CoverCouple(DM dm, PairFacets *facets, Vec edge, Vec area)
{
  const PetscScalar *r;
  Vec                local;

  PetscFunctionBegin;
  PetscCall(CoverGetLocal(dm, edge, area, &local));
  PetscCall(PetscArrayzero(facets->value, 16 * facets->n));
  PetscCall(VecGetArrayRead(local, &r));
  for (PetscInt f = 0; f < facets->n; ++f) {
    const PetscInt *v = &facets->offset[4 * f], n = v[2] == v[3] ? 3 : 4; /* a triangle repeats its last vertex */
    PetscScalar    *value = &facets->value[16 * f];

    if (!(PetscRealPart(r[v[0]] + r[v[1]] + r[v[2]] + r[v[3]]) > 0.0)) continue;
    for (PetscInt k = 0; k < 16; ++k) {
      const PetscInt  a = k / 4, b = k % 4;
      const PetscReal part = n == 3 ? 1.0 / 24.0 : (a + b) % 2 ? 1.0 / 18.0 : 1.0 / 36.0;

      if (a >= n || b >= n || a == b) continue;
      value[k] = part * PetscMax(PetscMin(PetscRealPart(r[v[a] + 1]), PetscRealPart(r[v[b] + 1])), 0.0);
      value[5 * a] -= value[k];
    }
  }
  PetscCall(VecRestoreArrayRead(local, &r));
  PetscCall(DMRestoreLocalVector(dm, &local));
  PetscCall(MatSetValuesCOO(facets->between, facets->value, INSERT_VALUES));
  PetscFunctionReturn(0);
}

/*
   Agglomerates and smooths values of a pair's vertices. Collective.

   values: n vectors of sums over the covered area of each vertex; the first is this area
   smooth: of each vector, whether it is smoothed
*/
PetscErrorCode NodalPressureEvenOut(DM dm, Elasticity elasticity, const VertexPlaces *places,
  const SceneContactPair *pair, PairFacets *facets, PetscInt n, Vec values[], const PetscBool smooth[])
{
  const char *const faces[2] = {pair->nonmortar, pair->mortar};
  Vec               cover, edge, mean;

  PetscFunctionBegin;
  PetscCall(VecDuplicate(values[0], &cover));
  PetscCall(VecDuplicate(values[0], &edge));
  PetscCall(VecDuplicate(values[0], &mean));
  PetscCall(PairFacetsMeasure(elasticity, places, pair->self ? 1 : 2, faces, cover));
  PetscCall(VecQuotient_AMGF(cover, values[0], cover)); /* 0 at vertices without facets */
  PetscCall(CoverAgglomerate(dm, facets, cover, n, values));
  PetscCall(CoverFindEdge(facets, cover, edge));
  PetscCall(CoverCouple(dm, facets, edge, values[0]));
  for (PetscInt k = 0; k < n * cover_exchanges; ++k) {
    if (!smooth[k % n]) continue;
    PetscCall(VecQuotient_AMGF(mean, values[k % n], values[0]));
    PetscCall(MatMultAdd(facets->between, mean, values[k % n], values[k % n]));
  }
  PetscCall(VecDestroy(&cover));
  PetscCall(VecDestroy(&edge));
  PetscCall(VecDestroy(&mean));
  PetscFunctionReturn(0);
}
