/*
   Recovers displacement gradient and dilatation at the nodes of cells of order 2. In contrast to recovery.c a cell has
   8 samples, at the 2 x 2 x 2 Gauss points where gradients of order 2 are superconvergent (4 samples for a
   tetrahedron). The samples of the cells around a vertex are fitted by a quadratic polynomial. The result is of second
   order, and of higher order on regular meshes.
   A node gets the mean of the polynomials of its cells' vertices that have the highest rank: vertices inside the body
   or, if there are none, those with the most cells. Terms that the samples do not determine are omitted, such as the
   square of the coordinate across a single layer of cells.
*/
#include "recoveryimpl.h"

#define TERMS   10 /* terms of a quadratic polynomial: 1, x, y, z, x^2, y^2, z^2, xy, yz, zx */
#define SAMPLES 8

/* Least-squares fit around a vertex, from the samples of the cells around it */
typedef struct {
  PetscReal A[TERMS][TERMS], b[TERMS][RECOVERED_VALUES]; /* matrix and right-hand side of the fit; b is overwritten by
                                                           the coefficients of the polynomial */
  PetscReal normal[3], area; /* sum of int grad N, which vanishes inside a body; sum of the magnitudes of these
                                vectors */
  PetscReal ncells;
} QuadraticPatch;

typedef struct {
  PetscInt n; /* number of samples, which is also the number of vertices */
  /* coordinates and values of the samples; int grad N of the vertices */
  PetscReal x[SAMPLES][3], s[SAMPLES][RECOVERED_VALUES], B[SAMPLES][3];
} QuadraticCell;

static void QuadraticTerms(const PetscReal d[3], PetscReal t[TERMS])
{
  t[0] = 1;
  for (int i = 0; i < 3; ++i) {
    t[1 + i] = d[i];
    t[4 + i] = d[i] * d[i];
    t[7 + i] = d[i] * d[(i + 1) % 3];
  }
}

/*
   Computes the weights with which values at 3 Gauss points of a line are interpolated to its two superconvergent points
*/
static void QuadraticLine(PetscReal weight[2][3])
{
  const PetscReal gauss = PetscSqrtReal(0.6), at[2] = {-PetscSqrtReal(1. / 3), PetscSqrtReal(1. / 3)};

  for (int s = 0; s < 2; ++s) {
    const PetscReal t = at[s] / gauss;

    weight[s][0] = 0.5 * t * (t - 1);
    weight[s][1] = (1 - t) * (1 + t);
    weight[s][2] = 0.5 * t * (t + 1);
  }
}

/*
   Computes the weights with which values at the quadrature points of a tetrahedron give values at its 4 samples, by a
   linear polynomial of least squares. Sample s is the point at which barycentric coordinate s is 1 - 3 x 0.138 and the
   others are 0.138.
*/
static void QuadraticTetrahedron(const CellBasis *basis, PetscReal weight[SAMPLES][CELL_MAX_POINTS])
{
  const PetscReal place = 0.1381966011250105;

  for (PetscInt q = 0; q < basis->npoints; ++q) {
    const PetscReal *xi = basis->xi[q], l[4] = {1 - xi[0] - xi[1] - xi[2], xi[0], xi[1], xi[2]};

    for (int s = 0; s < 4; ++s) {
      weight[s][q] = -4;
      for (int i = 0; i < 4; ++i) weight[s][q] += 20 * l[i] * (i == s ? 1 - 3 * place : place);
      weight[s][q] *= 6 * basis->weight[q];
    }
  }
}

/* Computes the weights with which values at the quadrature points of a cell give values at its n samples */
static void QuadraticWeights(const CellBasis *basis, PetscInt *n, PetscReal weight[SAMPLES][CELL_MAX_POINTS])
{
  PetscReal line[2][3];

  *n = MeshCorners(basis->nnodes);
  if (*n == 4) {
    QuadraticTetrahedron(basis, weight);
    return;
  }
  if (basis->npoints == SAMPLES) { /* the points are the samples */
    for (int s = 0; s < SAMPLES; ++s) {
      for (int q = 0; q < SAMPLES; ++q) weight[s][q] = s == q;
    }
    return;
  }
  QuadraticLine(line);
  for (PetscInt q = 0; q < basis->npoints; ++q) {
    for (int s = 0; s < SAMPLES; ++s)
      weight[s][q] = line[s & 1][q % 3] * line[s >> 1 & 1][q / 3 % 3] * line[s >> 2][q / 9];
  }
}

static void QuadraticSample(CellState *state, QuadraticCell *cell)
{
  const CellBasis *basis = state->body->basis;
  PetscReal        w[CELL_MAX_POINTS], H[CELL_MAX_POINTS][ELEMENT_STRAINS], G[3][CELL_MAX_NODES],
    weight[SAMPLES][CELL_MAX_POINTS];

  *cell = (QuadraticCell){0};
  QuadraticWeights(basis, &cell->n, weight);
  state->body->element->strains(basis, state->material, state->X, state->U, w, H);
  for (PetscInt q = 0; q < basis->npoints; ++q) {
    PetscReal x[3] = {0, 0, 0}, s[RECOVERED_VALUES] = {0};

    (void)CellGradients((int)state->n, basis, q, state->X, G);
    for (int d = 0; d < 3; ++d) {
      for (PetscInt a = 0; a < state->n; ++a) x[d] += basis->N[q][a] * state->X[d][a];
      for (int c = 0; c < cell->n; ++c) cell->B[c][d] += w[q] * G[d][RecoveryCorner(state->n, c)];
    }
    for (int k = 0; k < ELEMENT_STRAINS; ++k) s[k] = H[q][k];
    CellRecovered(state, q, s);
    for (int i = 0; i < cell->n; ++i) {
      for (int d = 0; d < 3; ++d) cell->x[i][d] += weight[i][q] * x[d];
      for (int k = 0; k < RECOVERED_VALUES; ++k) cell->s[i][k] += weight[i][q] * s[k];
    }
  }
}

static void QuadraticPatchAdd(const QuadraticCell *cell, int corner, const PetscReal at[3], QuadraticPatch *patch)
{
  PetscReal length = 0;

  for (int s = 0; s < cell->n; ++s) {
    const PetscReal d[3] = {cell->x[s][0] - at[0], cell->x[s][1] - at[1], cell->x[s][2] - at[2]};
    PetscReal       t[TERMS];

    QuadraticTerms(d, t);
    for (int i = 0; i < TERMS; ++i) {
      for (int j = 0; j < TERMS; ++j) patch->A[i][j] += t[i] * t[j];
      for (int k = 0; k < RECOVERED_VALUES; ++k) patch->b[i][k] += t[i] * cell->s[s][k];
    }
  }
  for (int d = 0; d < 3; ++d) {
    patch->normal[d] += cell->B[corner][d];
    length += PetscSqr(cell->B[corner][d]);
  }
  patch->area += PetscSqrtReal(length);
  patch->ncells += 1;
}

/*
   Computes a Cholesky factorization of A scaled by its diagonal. scale[i] is zero for terms that depend on earlier ones
   in the samples; these terms are omitted.
*/
static void QuadraticFactor(PetscReal A[TERMS][TERMS], PetscReal scale[TERMS], PetscReal L[TERMS][TERMS])
{
  for (int i = 0; i < TERMS; ++i) {
    scale[i] = A[i][i] > 0 ? 1 / PetscSqrtReal(A[i][i]) : 0;
    for (int j = 0; j <= i; ++j) {
      L[i][j] = scale[i] * A[i][j] * scale[j];
      for (int k = 0; k < j; ++k) L[i][j] -= L[i][k] * L[j][k];
      if (j < i) L[i][j] /= L[j][j];
    }
    if (L[i][i] > PETSC_SQRT_MACHINE_EPSILON) {
      L[i][i] = PetscSqrtReal(L[i][i]);
    } else {
      for (int j = 0; j < i; ++j) L[i][j] = 0;
      L[i][i]  = 1;
      scale[i] = 0;
    }
  }
}

/* Replaces b by the coefficients of the quadratic polynomial, as far as the samples determine them */
static void QuadraticPatchFit(QuadraticPatch *patch)
{
  PetscReal L[TERMS][TERMS], scale[TERMS];

  QuadraticFactor(patch->A, scale, L);
  for (int k = 0; k < RECOVERED_VALUES; ++k) {
    for (int i = 0; i < TERMS; ++i) {
      patch->b[i][k] *= scale[i];
      for (int j = 0; j < i; ++j) patch->b[i][k] -= L[i][j] * patch->b[j][k];
      patch->b[i][k] /= L[i][i];
    }
    for (int i = TERMS - 1; i >= 0; --i) {
      for (int j = i + 1; j < TERMS; ++j) patch->b[i][k] -= L[j][i] * patch->b[j][k];
      patch->b[i][k] /= L[i][i];
    }
    for (int i = 0; i < TERMS; ++i) patch->b[i][k] *= scale[i];
  }
}

static PetscBool QuadraticPatchIsInside(const QuadraticPatch *patch)
{
  return (PetscBool)(VectorNorm(patch->normal) <= PETSC_SQRT_MACHINE_EPSILON * patch->area);
}

/*
   Returns the rank of a vertex's polynomial at a node. The rank is highest for vertices inside the body and otherwise
   increases with the number of cells; it is higher by one if the node is the vertex itself.
*/
static PetscInt QuadraticRank(const QuadraticPatch *patch, PetscBool itself)
{
  return 2 * (QuadraticPatchIsInside(patch) ? 100 : (PetscInt)patch->ncells) + (itself ? 1 : 0);
}

static void QuadraticNodeAdd(const QuadraticPatch *patch, const PetscReal d[3], RecoveredNode *node)
{
  PetscReal t[TERMS];

  QuadraticTerms(d, t);
  node->n += 1;
  for (int k = 0; k < RECOVERED_VALUES; ++k) {
    for (int i = 0; i < TERMS; ++i) node->value[k] += t[i] * patch->b[i][k];
  }
}

/*
   Raises rank[] at the nodes of a cell to the highest rank of its vertices' polynomials. If `sums` is not NULL, adds
   the polynomials of that rank to sums[] instead.
*/
static void QuadraticContinue(const CellState *state, const PetscInt number[], const QuadraticPatch patches[],
  PetscInt rank[], RecoveredNode sums[])
{
  for (PetscInt a = 0; a < state->n; ++a) {
    const PetscInt node = state->nodes[a];

    for (int c = 0; c < MeshCorners(state->n); ++c) {
      const PetscInt        b     = RecoveryCorner(state->n, c);
      const QuadraticPatch *patch = &patches[number[state->nodes[b]]];
      const PetscReal       d[3]  = {state->X[0][a] - state->X[0][b], state->X[1][a] - state->X[1][b],
               state->X[2][a] - state->X[2][b]};

      if (!sums) rank[node] = PetscMax(rank[node], QuadraticRank(patch, (PetscBool)(a == b)));
      else if (rank[node] == QuadraticRank(patch, (PetscBool)(a == b))) QuadraticNodeAdd(patch, d, &sums[node]);
    }
  }
}

/*
   Numbers the vertices of cells of order 2, with -1 for other nodes, and creates their star forest from that of the
   nodes
*/
static PetscErrorCode QuadraticNumber(Elasticity e, PetscSF nodes, PetscInt number[], PetscInt *n, PetscSF *vertices)
{
  PetscInt           nleaves, nshared = 0, *theirs, *leaf;
  const PetscInt    *local;
  const PetscSFNode *remote;
  PetscSFNode       *root;

  PetscFunctionBegin;
  *n = 0;
  for (PetscInt v = 0; v < e->nnodes; ++v) number[v] = -1;
  for (PetscInt c = 0; c < e->ncells; ++c) {
    const PetscInt nnodes = e->cellstart[c + 1] - e->cellstart[c];

    for (int k = 0; MeshOrder(nnodes) == 2 && k < MeshCorners(nnodes); ++k) {
      PetscInt *v = &number[e->cellnodes[e->cellstart[c] + RecoveryCorner(nnodes, k)]];

      if (*v < 0) *v = (*n)++;
    }
  }
  PetscCall(PetscMalloc1(e->nnodes, &theirs));
  PetscCall(PetscArraycpy(theirs, number, e->nnodes));
  PetscCall(PetscSFBcastBegin(nodes, MPIU_INT, number, theirs, MPI_REPLACE));
  PetscCall(PetscSFBcastEnd(nodes, MPIU_INT, number, theirs, MPI_REPLACE));
  PetscCall(PetscSFGetGraph(nodes, NULL, &nleaves, &local, &remote));
  PetscCall(PetscMalloc1(nleaves, &leaf));
  PetscCall(PetscMalloc1(nleaves, &root));
  for (PetscInt i = 0; i < nleaves; ++i) {
    const PetscInt v = local ? local[i] : i;

    if (number[v] < 0) continue;
    leaf[nshared]   = number[v];
    root[nshared++] = (PetscSFNode){.rank = remote[i].rank, .index = theirs[v]};
  }
  PetscCall(PetscSFCreate(PetscObjectComm((PetscObject)e->dm), vertices));
  PetscCall(PetscSFSetGraph(*vertices, *n, nshared, leaf, PETSC_OWN_POINTER, root, PETSC_OWN_POINTER));
  PetscCall(PetscFree(theirs));
  PetscFunctionReturn(0);
}

static PetscErrorCode QuadraticFitPatches(Elasticity e, PetscSF sf, const PetscBool selected[], const PetscScalar x[],
  const PetscScalar u[], const PetscInt number[], PetscInt n, QuadraticPatch patches[])
{
  PetscFunctionBegin;
  for (PetscInt c = 0; c < e->ncells; ++c) {
    CellState     state;
    QuadraticCell cell;

    if (!selected[e->cellbody[c]] || MeshOrder(e->cellstart[c + 1] - e->cellstart[c]) != 2) continue;
    ElasticityGetCell(e, c, x, u, &state);
    QuadraticSample(&state, &cell);
    for (int k = 0; k < cell.n; ++k) {
      const PetscInt  a     = RecoveryCorner(state.n, k);
      const PetscReal at[3] = {state.X[0][a], state.X[1][a], state.X[2][a]};

      QuadraticPatchAdd(&cell, k, at, &patches[number[state.nodes[a]]]);
    }
  }
  PetscCall(ElasticitySumRecords(sf, sizeof(QuadraticPatch) / sizeof(PetscReal), (PetscReal *)patches));
  for (PetscInt v = 0; v < n; ++v) QuadraticPatchFit(&patches[v]);
  PetscFunctionReturn(0);
}

/* Sums and counts the polynomials of highest rank at every node of the selected bodies' cells of order 2 */
static PetscErrorCode QuadraticSum(Elasticity e, PetscSF nodes, const PetscBool selected[], const PetscScalar x[],
  const PetscScalar u[], const PetscInt number[], const QuadraticPatch patches[], RecoveredNode sums[])
{
  PetscInt *rank;

  PetscFunctionBegin;
  PetscCall(PetscCalloc1(e->nnodes, &rank));
  for (PetscInt pass = 0; pass < 2; ++pass) {
    for (PetscInt c = 0; c < e->ncells; ++c) {
      CellState state;

      if (!selected[e->cellbody[c]] || MeshOrder(e->cellstart[c + 1] - e->cellstart[c]) != 2) continue;
      ElasticityGetCell(e, c, x, u, &state);
      QuadraticContinue(&state, number, patches, rank, pass ? sums : NULL);
    }
    if (pass) break;
    PetscCall(ValuesReduce(nodes, MPIU_INT, MPI_MAX, rank));
  }
  PetscCall(PetscFree(rank));
  PetscCall(ElasticitySumRecords(nodes, sizeof(RecoveredNode) / sizeof(PetscReal), (PetscReal *)sums));
  PetscFunctionReturn(0);
}

/* Sets recovered[] at the nodes of the selected bodies' cells of order 2. Values at other nodes are unchanged. */
PetscErrorCode ElasticityRecoverOrder2(Elasticity e, PetscSF nodes, const PetscBool selected[], const PetscScalar x[],
  const PetscScalar u[], RecoveredNode recovered[])
{
  QuadraticPatch *patches;
  RecoveredNode  *sums;
  PetscInt       *number, n;
  PetscSF         vertices;

  PetscFunctionBegin;
  PetscCall(PetscMalloc1(e->nnodes, &number));
  PetscCall(QuadraticNumber(e, nodes, number, &n, &vertices));
  PetscCall(PetscCalloc1(n, &patches));
  PetscCall(PetscCalloc1(e->nnodes, &sums));
  PetscCall(QuadraticFitPatches(e, vertices, selected, x, u, number, n, patches));
  PetscCall(QuadraticSum(e, nodes, selected, x, u, number, patches, sums));
  for (PetscInt v = 0; v < e->nnodes; ++v) {
    for (int k = 0; sums[v].n > 0 && k < RECOVERED_VALUES; ++k) recovered[v].value[k] = sums[v].value[k] / sums[v].n;
  }
  PetscCall(PetscFree(sums));
  PetscCall(PetscFree(patches));
  PetscCall(PetscFree(number));
  PetscCall(PetscSFDestroy(&vertices));
  PetscFunctionReturn(0);
}
