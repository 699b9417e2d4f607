/* Dead loads and lumped mass: integrals of the shape functions over the undeformed geometry */
#include "facesimpl.h"
#include <mesh.h>
#include <rankerror.h>

/* Computes volume[a] = int N_a over a cell */
static void CellVolumes(const CellBasis *basis, PetscReal X[3][CELL_MAX_NODES], PetscReal volume[CELL_MAX_NODES])
{
  PetscReal G[3][CELL_MAX_NODES];

  for (PetscInt a = 0; a < basis->nnodes; ++a) volume[a] = 0;
  for (PetscInt q = 0; q < basis->npoints; ++q) {
    const PetscReal w = CellGradients((int)basis->nnodes, basis, q, X, G);

    for (PetscInt a = 0; a < basis->nnodes; ++a) volume[a] += w * basis->N[q][a];
  }
}

/*
   Computes the lumped masses of a cell's nodes for unit density: int N_a, or, for tetrahedra with 10 nodes, whose
   corner integrals are negative, the cell's volume distributed in proportion to int N_a^2
*/
void CellMasses(const CellBasis *basis, PetscReal X[3][CELL_MAX_NODES], PetscReal mass[CELL_MAX_NODES])
{
  PetscReal G[3][CELL_MAX_NODES], square[CELL_MAX_NODES] = {0}, whole = 0, sum = 0;

  CellVolumes(basis, X, mass);
  if (basis->nnodes != 10) return;
  for (PetscInt q = 0; q < basis->npoints; ++q) {
    const PetscReal w = CellGradients(10, basis, q, X, G);

    for (PetscInt a = 0; a < 10; ++a) square[a] += w * PetscSqr(basis->N[q][a]);
  }
  for (PetscInt a = 0; a < 10; ++a) {
    whole += mass[a];
    sum += square[a];
  }
  for (PetscInt a = 0; a < 10; ++a) mass[a] = whole / sum * square[a];
}

/*
   Adds factor[d] times the cells' `integrals` to a global vector. body: the body whose cells count, or PETSC_DECIDE for
   all.
*/
static PetscErrorCode ElasticityAddVolume(Elasticity e, PetscInt body,
  void (*integrals)(const CellBasis *, PetscReal[3][CELL_MAX_NODES], PetscReal[CELL_MAX_NODES]),
  const PetscReal factor[3], Vec total)
{
  Vec                coordinates, local;
  const PetscScalar *x;
  PetscScalar       *l;

  PetscFunctionBegin;
  PetscCall(MeshGetNodeCoordinates(e->dm, &coordinates));
  PetscCall(DMGetLocalVector(e->dm, &local));
  PetscCall(VecZeroEntries(local));
  PetscCall(VecGetArrayRead(coordinates, &x));
  PetscCall(VecGetArray(local, &l));
  for (PetscInt c = 0; c < e->ncells; ++c) {
    const PetscInt n = e->cellstart[c + 1] - e->cellstart[c], *nodes = e->cellnodes + e->cellstart[c];
    PetscReal      X[3][CELL_MAX_NODES], values[CELL_MAX_NODES];

    if (body != PETSC_DECIDE && body != e->cellbody[c]) continue;
    CellGather(n, nodes, x, X);
    integrals(e->bodies[e->cellbody[c]].basis, X, values);
    for (PetscInt i = 0; i < 3 * n; ++i) l[3 * nodes[i / 3] + i % 3] += factor[i % 3] * values[i / 3];
  }
  PetscCall(VecRestoreArray(local, &l));
  PetscCall(VecRestoreArrayRead(coordinates, &x));
  PetscCall(DMLocalToGlobal(e->dm, local, ADD_VALUES, total));
  PetscCall(DMRestoreLocalVector(e->dm, &local));
  PetscFunctionReturn(0);
}

/*@
  ElasticityLumpedMass - Computes the lumped mass of unit density, by row sums: the integral of each node's shape
  function

  Collective

  Input Parameter:
. e - the context

  Output Parameter:
. mass - new global vector, the same positive value for the 3 components of a node [length^3]

  Level: intermediate

  Notes:
  In tetrahedra of 10 nodes, where row sums are negative at the corners, masses are in proportion to the diagonal of
  the mass matrix.

  References:
  Hinton, Rock and Zienkiewicz, A note on mass lumping and related processes in the finite element method, 1976.

.seealso: `ElasticityCreate()`, `ElasticityAddBodyForce()`
@*/
PetscErrorCode ElasticityLumpedMass(Elasticity e, Vec *mass)
{
  const PetscReal one[3] = {1, 1, 1};

  PetscFunctionBegin;
  PetscCall(DMCreateGlobalVector(e->dm, mass));
  PetscCall(VecZeroEntries(*mass));
  PetscCall(ElasticityAddVolume(e, PETSC_DECIDE, CellMasses, one, *mass));
  PetscFunctionReturn(0);
}

/*@
  ElasticityAddBodyForce - Adds a dead force per reference volume

  Collective

  Input Parameters:
+ e       - the context
. body    - the body, from 0; `PETSC_DECIDE` for every body
- density - the force per reference volume [force/length^3]

  Output Parameter:
. force - global vector; the load is added to it, on all rows, the prescribed ones too [force]

  Level: intermediate

.seealso: `ElasticityAddPressure()`, `ElasticityForce()`
@*/
PetscErrorCode ElasticityAddBodyForce(Elasticity e, PetscInt body, const PetscReal density[3], Vec force)
{
  PetscFunctionBegin;
  PetscCheck(body == PETSC_DECIDE || (body >= 0 && body < e->nbodies), PetscObjectComm((PetscObject)e->dm),
    PETSC_ERR_ARG_OUTOFRANGE, "There is no body %" PetscInt_FMT " among %" PetscInt_FMT, body, e->nbodies);
  PetscCall(ElasticityAddVolume(e, body, CellVolumes, density, force));
  PetscFunctionReturn(0);
}

/*
   Computes area vectors F at the nodes of a facet, from the bilinear facets or triangles into which the nodes divide
   the facet
*/
static void ElasticityPieceNormals(const Facet *facet, PetscReal F[][3])
{
  for (PetscInt a = 0; a < facet->n; ++a) F[a][0] = F[a][1] = F[a][2] = 0;
  for (PetscInt k = 0; k < 4; ++k) {
    const PetscInt quarter[4] = {k, 4 + k, 8, 4 + (k + 3) % 4}, triangle[4] = {k, k < 3 ? 3 + k : 4, 3 + (k + 2) % 3};
    const PetscInt n = facet->n == 9 ? 4 : 3, *node = facet->n == 9 ? quarter : triangle;
    PetscReal      X[4][3], f[4][3];

    for (PetscInt i = 0; i < 3 * n; ++i) X[i / 3][i % 3] = facet->X[node[i / 3]][i % 3];
    FacetNormals(n, X, NULL, f);
    for (PetscInt i = 0; i < 3 * n; ++i) F[node[i / 3]][i % 3] += f[i / 3][i % 3];
  }
}

/* An integral over a face. The integrand is factor times pressure times normal. If `cut`, both are 1: facets of
   order 2 are then divided at their nodes into facets of order 1. */
typedef struct {
  PetscReal          factor;
  PetscBool          cut;
  ElasticityPressure at; /* NULL: 1 */
  void              *ctx;
} FaceNormals;

/* Adds the integrals over n facets of this rank to a local vector. x: coordinates of the nodes */
static PetscErrorCode NormalsAddFacets(Elasticity e, const FaceNormals *normals, PetscInt n, const PetscInt facets[],
  const PetscScalar x[], PetscScalar l[])
{
  PetscFunctionBegin;
  for (PetscInt i = 0; i < n; ++i) {
    Facet     facet;
    PetscReal F[FACET_MAX_NODES][3], P[FACET_MAX_NODES];

    PetscCall(FacetGet(e, facets[i], x, &facet));
    PetscCall(FacetPressures(&facet, normals->factor, normals->at, normals->ctx, P));
    if (normals->cut && facet.n > 4) ElasticityPieceNormals(&facet, F);
    else FacetNormals(facet.n, facet.X, P, F);
    for (PetscInt a = 0; a < facet.n; ++a) {
      for (PetscInt d = 0; d < 3; ++d) l[facet.offset[a] + d] += F[a][d];
    }
  }
  PetscFunctionReturn(0);
}

/* Adds integrals over a face to a global vector */
static PetscErrorCode ElasticityAddNormals(Elasticity e, const char face[], const FaceNormals *normals, Vec total)
{
  IS                 facets;
  Vec                coordinates, local;
  const PetscInt    *f;
  const PetscScalar *x;
  PetscScalar       *l;
  PetscInt           n;

  PetscFunctionBegin;
  PetscCall(MeshGetFacets(e->dm, face, &facets));
  PetscCall(MeshGetNodeCoordinates(e->dm, &coordinates));
  PetscCall(DMGetLocalVector(e->dm, &local));
  PetscCall(VecZeroEntries(local));
  PetscCall(VecGetArrayRead(coordinates, &x));
  PetscCall(VecGetArray(local, &l));
  PetscCall(ISGetLocalSize(facets, &n));
  PetscCall(ISGetIndices(facets, &f));
  RankCall(PetscObjectComm((PetscObject)e->dm), PETSC_TRUE, NormalsAddFacets(e, normals, n, f, x, l));
  PetscCall(ISRestoreIndices(facets, &f));
  PetscCall(ISDestroy(&facets));
  PetscCall(VecRestoreArray(local, &l));
  PetscCall(VecRestoreArrayRead(coordinates, &x));
  PetscCall(DMLocalToGlobal(e->dm, local, ADD_VALUES, total));
  PetscCall(DMRestoreLocalVector(e->dm, &local));
  PetscFunctionReturn(0);
}

/*@
  ElasticityAddPressure - Adds the load of a dead pressure on a face, -factor times pressure times the reference normal

  Collective

  Input Parameters:
+ e      - the context
. face   - name of the face, "<body>.<face>"
. factor - factor of the pressure
. at     - the pressure at an undeformed position, positive pushes on the body [force/length^2]; `NULL`: 1
- ctx    - its context

  Output Parameter:
. force - global vector; the load is added to it, on all rows, the prescribed ones too [force]

  Level: intermediate

  Notes:
  The pressure is interpolated between the nodes of the face. The load of a uniform one is exact for the facets of the
  reference geometry, bilinear or biquadratic. A name that is not a face of the mesh is an error, and so is an error of
  `at` on any rank.

.seealso: `ElasticityAddBodyForce()`, `ElasticityForce()`, `MeshGetFacets()`
@*/
PetscErrorCode ElasticityAddPressure(Elasticity e, const char face[], PetscReal factor, ElasticityPressure at,
  void *ctx, Vec force)
{
  const FaceNormals normals = {.factor = -factor, .at = at, .ctx = ctx};

  PetscFunctionBegin;
  PetscCall(ElasticityAddNormals(e, face, &normals, force));
  PetscFunctionReturn(0);
}

/*
   Collective. Adds the nodal area vectors of a face: the integral of each node's bilinear shape function times the
   normal. face: name of the face, "<body>.<face>"; areas: global vector to which they are added [length^2]. Facets of
   order 2 are divided into four at their nodes, as contact does. The areas are therefore positive; integrals of
   quadratic shape functions may be negative.
*/
PetscErrorCode ElasticityAddFacetAreas(Elasticity e, const char face[], Vec areas)
{
  const FaceNormals normals = {.factor = 1, .cut = PETSC_TRUE};

  PetscFunctionBegin;
  PetscCall(ElasticityAddNormals(e, face, &normals, areas));
  PetscFunctionReturn(0);
}
