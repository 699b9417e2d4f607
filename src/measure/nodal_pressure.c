/*
   Computes nodal contact pressures. The pressure of a row is its force divided by the area that the other side covers
   around its vertex. If that area is tiny, both are small and the quotient is inaccurate. Such a vertex passes its
   force and area to the better covered vertices of its facets, in proportion to their areas (agglomeration).
   At an edge of the other side the pressure is singular, and oscillates at the vertices near the edge. Vertices within
   a few facets of partly covered vertices exchange force in proportion to their differences of pressure (smoothing).
   Both steps preserve the sums over a side, keep pressures non-negative, and change nothing elsewhere.
*/
#include "measureimpl.h"

static const PetscReal cover_ratio     = 0.3; /* a vertex passes its values on if its covered area is below this
                                                 fraction of a neighbour's covered area */
static const PetscReal cover_partial   = 0.8; /* a vertex is partly covered if less than this fraction of its area is
                                                 covered */
static const PetscInt  cover_rings     = 4;   /* number of rings of facets around partly covered vertices in which
                                                 pressures are smoothed */
static const PetscInt  cover_exchanges = 3;
static const PetscReal cover_rounding =
  1e-8; /* relative tolerance of these limits, since the fractions of regular meshes may equal them */

/*
   Facets of both faces of a pair, and data of their vertices in the order of local vectors. Facets of order 2 are
   divided at their nodes.
*/
typedef struct {
  PetscInt nfacets, *offset; /* [4 nfacets] offset of each vertex's values */
  Vec      cover; /* per vertex: covered fraction of its area; covered area; sum of the areas to which it passes its
                     values, 0 if to none */
} CoverFacets;

static PetscErrorCode CoverAddFace(DM dm, const char face[], CoverFacets *facets)
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
  PetscCall(PetscRealloc(4 * (facets->nfacets + MESH_MAX_FACET_PIECES * n) * sizeof(PetscInt), &facets->offset));
  for (PetscInt f = 0; f < n; ++f) {
    PetscInt npieces, pieces[MESH_MAX_FACET_PIECES][4];

    PetscCall(MeshGetFacetPieces(dm, points[f], &npieces, pieces));
    for (PetscInt i = 0; i < 4 * npieces; ++i)
      PetscCall(PetscSectionGetOffset(section, pieces[i / 4][i % 4], &facets->offset[4 * facets->nfacets + i]));
    facets->nfacets += npieces;
  }
  PetscCall(ISRestoreIndices(is, &points));
  PetscCall(ISDestroy(&is));
  PetscFunctionReturn(0);
}

/*
   Lets each vertex with a small covered area pass its values to better covered vertices of its facets. out: the values
   that vertices receive. If `carried` is NULL, out[2] is the sum of the receiving vertices' areas.
*/
static PetscErrorCode CoverHandOn(DM dm, const CoverFacets *facets, Vec carried, Vec out)
{
  Vec                local[3]; /* local forms of the global vectors cover, carried and out */
  const PetscScalar *r, *c = NULL;
  PetscScalar       *o;

  PetscFunctionBegin;
  for (PetscInt i = 0; i < 3; ++i) PetscCall(DMGetLocalVector(dm, &local[i]));
  PetscCall(DMGlobalToLocal(dm, facets->cover, INSERT_VALUES, local[0]));
  if (carried) PetscCall(DMGlobalToLocal(dm, carried, INSERT_VALUES, local[1]));
  PetscCall(VecZeroEntries(local[2]));
  PetscCall(VecGetArrayRead(local[0], &r));
  if (carried) PetscCall(VecGetArrayRead(local[1], &c));
  PetscCall(VecGetArray(local[2], &o));
  for (PetscInt f = 0; f < facets->nfacets; ++f) {
    for (PetscInt pair = 0; pair < 16; ++pair) {
      const PetscInt  a = facets->offset[4 * f + pair / 4], b = facets->offset[4 * f + pair % 4];
      const PetscReal own = PetscRealPart(r[a]), area = PetscRealPart(r[b + 1]);

      if (!(own > 0.0) || own >= (1.0 - cover_rounding) * cover_ratio * PetscRealPart(r[b])) continue;
      if (!c) o[a + 2] += area;
      for (PetscInt i = 0; c && i < 3; ++i) o[b + i] += area / r[a + 2] * c[a + i];
    }
  }
  PetscCall(VecRestoreArray(local[2], &o));
  if (carried) PetscCall(VecRestoreArrayRead(local[1], &c));
  PetscCall(VecRestoreArrayRead(local[0], &r));
  PetscCall(VecZeroEntries(out));
  PetscCall(DMLocalToGlobal(dm, local[2], ADD_VALUES, out));
  for (PetscInt i = 0; i < 3; ++i) PetscCall(DMRestoreLocalVector(dm, &local[i]));
  PetscFunctionReturn(0);
}

/* Creates the data from covered areas and from the areas of the whole faces */
static PetscErrorCode CoverCreate(Simulation sim, const SceneContactPair *pair, Vec carried, CoverFacets *facets)
{
  Vec                whole;
  const PetscScalar *c, *w;
  PetscScalar       *r;
  PetscInt           n;

  PetscFunctionBegin;
  *facets = (CoverFacets){0};
  PetscCall(CoverAddFace(sim->dm, pair->nonmortar, facets));
  if (!pair->self) PetscCall(CoverAddFace(sim->dm, pair->mortar, facets));
  PetscCall(VecDuplicate(carried, &whole));
  PetscCall(VecZeroEntries(whole));
  PetscCall(ElasticityAddFacetAreas(sim->elasticity, pair->nonmortar, whole));
  if (!pair->self) PetscCall(ElasticityAddFacetAreas(sim->elasticity, pair->mortar, whole));
  PetscCall(VecDuplicate(carried, &facets->cover));
  PetscCall(VecZeroEntries(facets->cover));
  PetscCall(VecGetLocalSize(carried, &n));
  PetscCall(VecGetArrayRead(carried, &c));
  PetscCall(VecGetArrayRead(whole, &w));
  PetscCall(VecGetArray(facets->cover, &r));
  for (PetscInt i = 0; i < n; i += 3) {
    const PetscReal size = PetscSqrtReal(
      PetscSqr(PetscRealPart(w[i])) + PetscSqr(PetscRealPart(w[i + 1])) + PetscSqr(PetscRealPart(w[i + 2])));

    if (!(size > 0.0)) continue;
    r[i]     = c[i] / size;
    r[i + 1] = c[i];
  }
  PetscCall(VecRestoreArray(facets->cover, &r));
  PetscCall(VecRestoreArrayRead(whole, &w));
  PetscCall(VecRestoreArrayRead(carried, &c));
  PetscCall(CoverHandOn(sim->dm, facets, NULL, whole));
  PetscCall(VecAXPY(facets->cover, 1.0, whole));
  PetscCall(VecDestroy(&whole));
  PetscFunctionReturn(0);
}

/*
   Ends one round in which vertices at the edge of the covered area have given their values to neighbours. A vertex that
   gives its values away keeps only those that it receives; at other vertices the received values are added. *left: area
   at the vertices that give their values away, which the next round must move.
*/
static PetscErrorCode CoverTake(const CoverFacets *facets, Vec gain, Vec carried, PetscReal *left)
{
  const PetscScalar *g, *r;
  PetscScalar       *c;
  PetscInt           n;

  PetscFunctionBegin;
  *left = 0.0;
  PetscCall(VecGetLocalSize(carried, &n));
  PetscCall(VecGetArrayRead(gain, &g));
  PetscCall(VecGetArrayRead(facets->cover, &r));
  PetscCall(VecGetArray(carried, &c));
  for (PetscInt i = 0; i < n; i += 3) {
    const PetscBool hands_on = (PetscBool)(PetscRealPart(r[i + 2]) > 0.0);

    for (PetscInt k = i; k < i + 3; ++k) c[k] = hands_on ? g[k] : c[k] + g[k];
    if (hands_on) *left += PetscRealPart(c[i]);
  }
  PetscCall(VecRestoreArray(carried, &c));
  PetscCall(VecRestoreArrayRead(facets->cover, &r));
  PetscCall(VecRestoreArrayRead(gain, &g));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, left, 1, MPIU_REAL, MPIU_SUM, PetscObjectComm((PetscObject)carried)));
  PetscFunctionReturn(0);
}

/*
   Lets vertices pass their values on until none has values to pass on. This terminates, since covered areas only grow.
*/
static PetscErrorCode CoverAgglomerate(DM dm, const CoverFacets *facets, Vec gain, Vec carried)
{
  PetscReal left = 1.0;

  PetscFunctionBegin;
  while (left > 0.0) {
    PetscCall(CoverHandOn(dm, facets, carried, gain));
    PetscCall(CoverTake(facets, gain, carried, &left));
  }
  PetscFunctionReturn(0);
}

/*
   Marks the vertices near partly covered ones. The vector `edge` has three values per vertex, of which the first is set
   to a positive number: at partly covered vertices, and then, ring by ring, at all vertices of facets that contain a
   marked vertex
*/
static PetscErrorCode CoverFindEdge(DM dm, const CoverFacets *facets, Vec edge)
{
  const PetscScalar *r, *e;
  PetscScalar       *o;
  PetscInt           n;
  Vec                local[2];

  PetscFunctionBegin;
  PetscCall(VecZeroEntries(edge));
  PetscCall(VecGetLocalSize(edge, &n));
  PetscCall(VecGetArrayRead(facets->cover, &r));
  PetscCall(VecGetArray(edge, &o));
  for (PetscInt i = 0; i < n; i += 3)
    o[i] = PetscRealPart(r[i]) > 0.0 && PetscRealPart(r[i]) < (1.0 - cover_rounding) * cover_partial ? 1.0 : 0.0;
  PetscCall(VecRestoreArray(edge, &o));
  PetscCall(VecRestoreArrayRead(facets->cover, &r));
  for (PetscInt i = 0; i < 2; ++i) PetscCall(DMGetLocalVector(dm, &local[i]));
  for (PetscInt ring = 1; ring < cover_rings; ++ring) {
    PetscCall(DMGlobalToLocal(dm, edge, INSERT_VALUES, local[0]));
    PetscCall(VecZeroEntries(local[1]));
    PetscCall(VecGetArrayRead(local[0], &e));
    PetscCall(VecGetArray(local[1], &o));
    for (PetscInt f = 0; f < facets->nfacets; ++f) {
      const PetscInt *v = &facets->offset[4 * f];

      for (PetscInt a = 0; a < 4; ++a) o[v[a]] += e[v[0]] + e[v[1]] + e[v[2]] + e[v[3]];
    }
    PetscCall(VecRestoreArray(local[1], &o));
    PetscCall(VecRestoreArrayRead(local[0], &e));
    PetscCall(DMLocalToGlobal(dm, local[1], ADD_VALUES, edge));
  }
  for (PetscInt i = 0; i < 2; ++i) PetscCall(DMRestoreLocalVector(dm, &local[i]));
  PetscFunctionReturn(0);
}

/* Returns the number of vertices of a facet. A triangle repeats its last vertex. */
static PetscInt CoverCountVertices(const PetscInt v[4])
{
  return v[2] == v[3] ? 3 : 4;
}

/*
   Exchanges force between the vertices of a facet: the off-diagonal entries of its mass matrix times the differences of
   their pressures
*/
static void CoverExchangeFacet(const PetscInt v[4], const PetscScalar c[], PetscScalar gain[])
{
  const PetscInt n = CoverCountVertices(v);

  for (PetscInt a = 0; a < n; ++a) {
    for (PetscInt b = a + 1; b < n; ++b) {
      const PetscReal area_a = PetscRealPart(c[v[a]]), area_b = PetscRealPart(c[v[b]]),
                      part = n == 3       ? 1.0 / 24.0
                             : b - a == 2 ? 1.0 / 36.0
                                          : 1.0 / 18.0;
      PetscReal flow;

      if (!(area_a > 0.0 && area_b > 0.0)) continue;
      flow = part * PetscMin(area_a, area_b) * PetscRealPart(c[v[b] + 1] / area_b - c[v[a] + 1] / area_a);
      gain[v[a] + 1] += flow;
      gain[v[b] + 1] -= flow;
    }
  }
}

static PetscErrorCode CoverExchange(DM dm, const CoverFacets *facets, Vec edge, Vec carried)
{
  Vec                local[3]; /* local vectors of edge, carried, gain */
  const PetscScalar *e, *c;
  PetscScalar       *gain;

  PetscFunctionBegin;
  for (PetscInt i = 0; i < 3; ++i) PetscCall(DMGetLocalVector(dm, &local[i]));
  PetscCall(DMGlobalToLocal(dm, edge, INSERT_VALUES, local[0]));
  PetscCall(DMGlobalToLocal(dm, carried, INSERT_VALUES, local[1]));
  PetscCall(VecZeroEntries(local[2]));
  PetscCall(VecGetArrayRead(local[0], &e));
  PetscCall(VecGetArrayRead(local[1], &c));
  PetscCall(VecGetArray(local[2], &gain));
  for (PetscInt f = 0; f < facets->nfacets; ++f) {
    const PetscInt *v = &facets->offset[4 * f];

    if (PetscRealPart(e[v[0]] + e[v[1]] + e[v[2]] + e[v[3]]) > 0.0) CoverExchangeFacet(v, c, gain);
  }
  PetscCall(VecRestoreArray(local[2], &gain));
  PetscCall(VecRestoreArrayRead(local[1], &c));
  PetscCall(VecRestoreArrayRead(local[0], &e));
  PetscCall(DMLocalToGlobal(dm, local[2], ADD_VALUES, carried));
  for (PetscInt i = 0; i < 3; ++i) PetscCall(DMRestoreLocalVector(dm, &local[i]));
  PetscFunctionReturn(0);
}

/* Agglomerates and smooths the values of a pair's vertices. Collective. */
PetscErrorCode NodalPressureEvenOut(Simulation sim, const SceneContactPair *pair, Vec carried)
{
  CoverFacets facets;
  Vec         work;

  PetscFunctionBegin;
  PetscCall(CoverCreate(sim, pair, carried, &facets));
  PetscCall(VecDuplicate(carried, &work));
  PetscCall(CoverAgglomerate(sim->dm, &facets, work, carried));
  PetscCall(CoverFindEdge(sim->dm, &facets, work));
  for (PetscInt k = 0; k < cover_exchanges; ++k) PetscCall(CoverExchange(sim->dm, &facets, work, carried));
  PetscCall(VecDestroy(&work));
  PetscCall(VecDestroy(&facets.cover));
  PetscCall(PetscFree(facets.offset));
  PetscFunctionReturn(0);
}
