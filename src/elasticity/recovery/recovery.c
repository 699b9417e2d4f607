/*
   Recovers displacement gradient, dilatation and stretch at the vertices by superconvergent patches. The averages of
   the cells around a vertex, located at the cells' centroids, are fitted by a linear polynomial. All cells around a
   vertex on the surface are on one side of it; such a vertex gets the mean of the polynomials of the interior vertices
   of its cells. The result is of second order up to the surface. A flat body with one layer of cells has no interior
   vertex; its polynomials do not vary across the layer. Vertices without any polynomial get the mean of their cells.
   References: Zienkiewicz and Zhu, The superconvergent patch recovery and a posteriori error estimates, parts 1 and 2,
   1992.
*/
#include "recoveryimpl.h"

/* Sums over the cells around a node. Positions are relative to the node. */
typedef struct {
  PetscReal n, d[3], dd[6]; /* number of cells; sums of positions; sums of the products xx yy zz xy yz zx of
                               positions */
  PetscReal s[RECOVERED_VALUES], ds[3][RECOVERED_VALUES]; /* sums of values; sums of positions times values */
  PetscReal normal[3], area; /* sum of int grad N, which vanishes inside a body; sum of the magnitudes of these
                                vectors */
} NodeSums;

/* PATCH_FLAT: a vertex of a flat layer of cells, unless it is on the edge of the layer */
typedef enum { PATCH_NONE, PATCH_FLAT, PATCH_INSIDE } PatchKind;

typedef struct {
  PatchKind kind;
  PetscReal value[RECOVERED_VALUES], slope[3][RECOVERED_VALUES]; /* value and derivatives at the node */
} NodePolynomial;

typedef union {
  NodeSums       sums;
  NodePolynomial polynomial;
} NodePatch;

typedef struct {
  PetscReal x[3];                /* centroid */
  PetscReal s[RECOVERED_VALUES]; /* means of the elastic values over the cell */
  PetscReal B[3][8];             /* integrals of the gradients of the shape functions over the cell */
} CellSample;

static void CellSampleAverages(CellState *state, CellSample *cell)
{
  const CellBasis   *basis = state->body->basis;
  const MaterialLaw *law   = state->body->material.law;
  PetscReal          G[3][CELL_MAX_NODES], C[9], volume = 0;

  *cell = (CellSample){0};
  for (PetscInt q = 0; q < basis->npoints; ++q) {
    const PetscReal w                   = CellGradients((int)state->n, basis, q, state->X, G);
    PetscReal       s[RECOVERED_VALUES] = {0};

    CellDisplacementGradient((int)state->n, state->U, G, s);
    s[9] = law->dilatation(s, C);
    CellRecovered(state, q, s);
    volume += w;
    for (int k = 0; k < RECOVERED_VALUES; ++k) cell->s[k] += w * s[k];
    for (int d = 0; d < 3; ++d) {
      for (PetscInt a = 0; a < state->n; ++a) {
        cell->x[d] += w * basis->N[q][a] * state->X[d][a];
        cell->B[d][a] += w * G[d][a];
      }
    }
  }
  for (int k = 0; k < RECOVERED_VALUES; ++k) cell->s[k] /= volume;
  for (int d = 0; d < 3; ++d) cell->x[d] /= volume;
}

static void NodeSumsAdd(NodeSums *sums, PetscReal X[3][CELL_MAX_NODES], int a, const CellSample *cell)
{
  static const int row[6] = {0, 1, 2, 0, 1, 2}, column[6] = {0, 1, 2, 1, 2, 0};
  const PetscReal  d[3] = {cell->x[0] - X[0][a], cell->x[1] - X[1][a], cell->x[2] - X[2][a]};

  sums->n += 1;
  for (int k = 0; k < 6; ++k) sums->dd[k] += d[row[k]] * d[column[k]];
  for (int k = 0; k < RECOVERED_VALUES; ++k) sums->s[k] += cell->s[k];
  for (int i = 0; i < 3; ++i) {
    sums->d[i] += d[i];
    sums->normal[i] += cell->B[i][a];
    for (int k = 0; k < RECOVERED_VALUES; ++k) sums->ds[i][k] += d[i] * cell->s[k];
  }
  sums->area += PetscSqrtReal(PetscSqr(cell->B[0][a]) + PetscSqr(cell->B[1][a]) + PetscSqr(cell->B[2][a]));
}

/*
   Computes the inverse of the scatter matrix of the cells' centroids. If these lie in a plane whose normal is n, slopes
   along n become zero. Returns what the inverse is good for.
*/
static PatchKind NodeSumsInvertScatter(const NodeSums *sums, const PetscReal mean[3], PetscReal inverse[3][3])
{
  static const int component[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};
  const PetscBool  inside          = (PetscBool)(VectorNorm(sums->normal) <= PETSC_SQRT_MACHINE_EPSILON * sums->area);
  PetscReal        scatter[3][3], n[3], across = 0, trace = 0, det;

  for (int i = 0; i < 3; ++i) n[i] = sums->normal[i];
  (void)VectorScaleToUnit(n);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      scatter[i][j] = sums->dd[component[i][j]] - sums->n * mean[i] * mean[j];
      across += n[i] * scatter[i][j] * n[j];
    }
    trace += scatter[i][i];
  }
  if (!inside && across > PETSC_SQRT_MACHINE_EPSILON * trace) return PATCH_NONE;
  for (int i = 0; !inside && i < 9; ++i) scatter[i / 3][i % 3] += trace * n[i / 3] * n[i % 3];
  det = MatrixInvert(scatter, inverse);
  if (det <= PETSC_SQRT_MACHINE_EPSILON * scatter[0][0] * scatter[1][1] * scatter[2][2]) return PATCH_NONE;
  return inside ? PATCH_INSIDE : PATCH_FLAT;
}

/* Fits a linear polynomial of least squares around a node. Nodes without one get the mean of their cells. */
static void NodePolynomialFit(const NodeSums *sums, NodePolynomial *p)
{
  const PetscReal mean[3] = {sums->d[0] / sums->n, sums->d[1] / sums->n, sums->d[2] / sums->n};
  PetscReal       inverse[3][3];

  p->kind = NodeSumsInvertScatter(sums, mean, inverse);
  for (int k = 0; k < RECOVERED_VALUES; ++k) p->value[k] = sums->s[k] / sums->n;
  if (p->kind == PATCH_NONE) return;
  for (int k = 0; k < RECOVERED_VALUES; ++k) {
    const PetscReal average = sums->s[k] / sums->n;
    PetscReal       c[3];

    for (int j = 0; j < 3; ++j) c[j] = sums->ds[j][k] - mean[j] * sums->s[k];
    for (int i = 0; i < 3; ++i) p->slope[i][k] = inverse[i][0] * c[0] + inverse[i][1] * c[1] + inverse[i][2] * c[2];
    p->value[k] = average - p->slope[0][k] * mean[0] - p->slope[1][k] * mean[1] - p->slope[2][k] * mean[2];
  }
}

static void NodePatchFit(NodePatch *patch)
{
  const NodeSums sums = patch->sums;

  if (sums.n > 0) NodePolynomialFit(&sums, &patch->polynomial);
  else patch->polynomial.kind = PATCH_NONE;
}

/* Creates the star forest whose roots are local nodes and whose leaves are local nodes that other ranks own */
PetscErrorCode ElasticityCreateNodeSF(Elasticity e, PetscSF *nodes)
{
  MPI_Comm           comm = PetscObjectComm((PetscObject)e->dm);
  PetscMPIInt        size;
  PetscSection       section;
  PetscSF            points, dofs;
  PetscInt          *offsets, nleaves = 0, n = 0, *leaf = NULL;
  const PetscInt    *local;
  const PetscSFNode *remote;
  PetscSFNode       *root = NULL;

  PetscFunctionBegin;
  PetscCall(PetscSFCreate(comm, nodes));
  PetscCallMPI(MPI_Comm_size(comm, &size));
  if (size > 1) {
    PetscCall(DMGetLocalSection(e->dm, &section));
    PetscCall(DMGetPointSF(e->dm, &points));
    PetscCall(PetscSFCreateRemoteOffsets(points, section, section, &offsets));
    PetscCall(PetscSFCreateSectionSF(points, section, offsets, section, &dofs));
    PetscCall(PetscFree(offsets));
    PetscCall(PetscSFGetGraph(dofs, NULL, &nleaves, &local, &remote));
    PetscCall(PetscMalloc1(nleaves / 3, &leaf));
    PetscCall(PetscMalloc1(nleaves / 3, &root));
    for (PetscInt i = 0; i < nleaves; ++i) {
      const PetscInt dof = local ? local[i] : i;

      if (dof % 3) continue;
      leaf[n]   = dof / 3;
      root[n++] = (PetscSFNode){.rank = remote[i].rank, .index = remote[i].index / 3};
    }
    PetscCall(PetscSFDestroy(&dofs));
  }
  PetscCall(PetscSFSetGraph(*nodes, e->nnodes, n, leaf, PETSC_OWN_POINTER, root, PETSC_OWN_POINTER));
  PetscFunctionReturn(0);
}

/* Sums records of n real numbers over the ranks that share a node. All these ranks get the sum. */
PetscErrorCode ElasticitySumRecords(PetscSF sf, size_t n, PetscReal *values)
{
  MPI_Datatype record;

  PetscFunctionBegin;
  PetscCallMPI(MPI_Type_contiguous((PetscMPIInt)n, MPIU_REAL, &record));
  PetscCallMPI(MPI_Type_commit(&record));
  PetscCall(ValuesReduce(sf, record, MPIU_SUM, values));
  PetscCallMPI(MPI_Type_free(&record));
  PetscFunctionReturn(0);
}

static PetscErrorCode ElasticityFitPatches(Elasticity e, PetscSF sf, const PetscBool selected[], const PetscScalar x[],
  const PetscScalar u[], NodePatch patches[])
{
  PetscFunctionBegin;
  for (PetscInt c = 0; c < e->ncells; ++c) {
    CellState  state;
    CellSample cell;

    if (!selected[e->cellbody[c]] || MeshOrder(e->cellstart[c + 1] - e->cellstart[c]) != 1) continue;
    ElasticityGetCell(e, c, x, u, &state);
    CellSampleAverages(&state, &cell);
    for (int a = 0; a < state.n; ++a) NodeSumsAdd(&patches[state.nodes[a]].sums, state.X, a, &cell);
  }
  PetscCall(ElasticitySumRecords(sf, sizeof(NodePatch) / sizeof(PetscReal), (PetscReal *)patches));
  for (PetscInt v = 0; v < e->nnodes; ++v) NodePatchFit(&patches[v]);
  PetscFunctionReturn(0);
}

/* Adds the best polynomials of a cell's vertices, evaluated at the cell's other nodes, to recovered[] */
static void CellContinue(const NodePatch patches[], PetscInt n, const PetscInt nodes[], PetscReal X[3][CELL_MAX_NODES],
  RecoveredNode recovered[])
{
  PatchKind best = PATCH_NONE;

  for (int a = 0; a < n; ++a) best = PetscMax(best, patches[nodes[a]].polynomial.kind);
  for (int a = 0; a < n; ++a) {
    RecoveredNode *r = &recovered[nodes[a]];

    if (patches[nodes[a]].polynomial.kind == best) continue;
    for (int b = 0; b < n; ++b) {
      const NodePolynomial *p    = &patches[nodes[b]].polynomial;
      const PetscReal       d[3] = {X[0][a] - X[0][b], X[1][a] - X[1][b], X[2][a] - X[2][b]};

      if (p->kind != best) continue;
      r->n += 1;
      for (int k = 0; k < RECOVERED_VALUES; ++k)
        r->value[k] += p->value[k] + p->slope[0][k] * d[0] + p->slope[1][k] * d[1] + p->slope[2][k] * d[2];
    }
  }
}

/*
   Sets recovered[] at the nodes of the selected bodies' cells of order 1. recovered[] must be zero initially, and no
   two of these bodies may share a node.
*/
PetscErrorCode ElasticityRecover(Elasticity e, PetscSF sf, const PetscBool selected[], const PetscScalar x[],
  const PetscScalar u[], RecoveredNode recovered[])
{
  NodePatch *patches;

  PetscFunctionBegin;
  PetscCall(PetscCalloc1(e->nnodes, &patches));
  PetscCall(ElasticityFitPatches(e, sf, selected, x, u, patches));
  for (PetscInt c = 0; c < e->ncells; ++c) {
    CellState state;

    if (!selected[e->cellbody[c]] || MeshOrder(e->cellstart[c + 1] - e->cellstart[c]) != 1) continue;
    ElasticityGetCell(e, c, x, u, &state);
    CellContinue(patches, state.n, state.nodes, state.X, recovered);
  }
  PetscCall(ElasticitySumRecords(sf, sizeof(RecoveredNode) / sizeof(PetscReal), (PetscReal *)recovered));
  for (PetscInt v = 0; v < e->nnodes; ++v) {
    const PetscReal n = recovered[v].n;

    for (int k = 0; k < RECOVERED_VALUES; ++k)
      recovered[v].value[k] = n > 0 ? recovered[v].value[k] / n : patches[v].polynomial.value[k];
  }
  PetscCall(PetscFree(patches));
  PetscFunctionReturn(0);
}
