/* Dead loads and lumped mass: integrals of the shape functions over the reference geometry */
#include "elasticityimpl.h"
#include <mesh.h>

/* Adds factor[d] times the integral of each shape function over the cells of one body (PETSC_DECIDE: all) to a global vector */
static PetscErrorCode ElasticityAddVolume(Elasticity e, PetscInt body, const PetscReal factor[3], Vec total)
{
  Vec                coordinates, local;
  const PetscScalar *x;
  PetscScalar       *l;

  PetscFunctionBegin;
  PetscCall(DMGetCoordinatesLocal(e->dm, &coordinates));
  PetscCall(DMGetLocalVector(e->dm, &local));
  PetscCall(VecZeroEntries(local));
  PetscCall(VecGetArrayRead(coordinates, &x));
  PetscCall(VecGetArray(local, &l));
  for (PetscInt c = 0; c < e->ncells; ++c) {
    const PetscInt *nodes = e->cellnodes + 8 * c;
    PetscReal       X[3][8], G[3][8], volume[8] = {0};

    if (body != PETSC_DECIDE && body != e->cellbody[c]) continue;
    ElasticityGatherCell(nodes, x, X);
    for (PetscInt q = 0; q < e->basis.npoints; ++q) {
      const PetscReal w = HexGradients(&e->basis, q, X, G);

      for (int a = 0; a < 8; ++a) volume[a] += w * e->basis.N[q][a];
    }
    for (int a = 0; a < 8; ++a) {
      for (int i = 0; i < 3; ++i) l[3 * nodes[a] + i] += factor[i] * volume[a];
    }
  }
  PetscCall(VecRestoreArray(local, &l));
  PetscCall(VecRestoreArrayRead(coordinates, &x));
  PetscCall(DMLocalToGlobal(e->dm, local, ADD_VALUES, total));
  PetscCall(DMRestoreLocalVector(e->dm, &local));
  PetscFunctionReturn(0);
}

/*@
  ElasticityLumpedMass - Computes the row-sum lumped mass of unit density, the integral of each vertex's shape function

  Collective

  Input Parameter:
. elasticity - the context

  Output Parameter:
. mass - new global vector, the same value for the 3 components of a vertex [length^3]

  Level: intermediate

.seealso: `ElasticityCreate()`, `ElasticityAddBodyForce()`
@*/
PetscErrorCode ElasticityLumpedMass(Elasticity e, Vec *mass)
{
  const PetscReal one[3] = {1, 1, 1};

  PetscFunctionBegin;
  PetscCall(DMCreateGlobalVector(e->dm, mass));
  PetscCall(VecZeroEntries(*mass));
  PetscCall(ElasticityAddVolume(e, PETSC_DECIDE, one, *mass));
  PetscFunctionReturn(0);
}

/*@
  ElasticityAddBodyForce - Adds a dead force per reference volume

  Collective

  Input Parameters:
+ elasticity - the context
. body       - the body, from 0; `PETSC_DECIDE` for every body
- density    - the force per reference volume [force/length^3]

  Output Parameter:
. force - global vector; the load is added to it, on all rows, the prescribed ones too [force]

  Level: intermediate

.seealso: `ElasticityAddPressure()`, `ElasticityForce()`
@*/
PetscErrorCode ElasticityAddBodyForce(Elasticity e, PetscInt body, const PetscReal density[3], Vec force)
{
  PetscFunctionBegin;
  PetscCheck(body == PETSC_DECIDE || (body >= 0 && body < e->nbodies), PetscObjectComm((PetscObject)e->dm), PETSC_ERR_ARG_OUTOFRANGE, "There is no body %" PetscInt_FMT " among %" PetscInt_FMT, body, e->nbodies);
  PetscCall(ElasticityAddVolume(e, body, density, force));
  PetscFunctionReturn(0);
}

/* F[a][d] = int N_a n dA of a bilinear facet, n dA = dX/ds x dX/dt; of degree 2 in s and in t, so 2 x 2 Gauss points are exact */
static void ElasticityFacetNormals(PetscReal X[4][3], PetscReal F[4][3])
{
  const PetscReal gauss[2] = {0.5 - PetscSqrtReal(3) / 6, 0.5 + PetscSqrtReal(3) / 6};

  for (int a = 0; a < 4; ++a) F[a][0] = F[a][1] = F[a][2] = 0;
  for (int q = 0; q < 4; ++q) {
    const PetscReal s = gauss[q & 1], t = gauss[q >> 1];
    const PetscReal N[4] = {(1 - s) * (1 - t), s * (1 - t), s * t, (1 - s) * t}, Ns[4] = {t - 1, 1 - t, t, -t}, Nt[4] = {s - 1, -s, s, 1 - s};
    PetscReal       xs[3] = {0, 0, 0}, xt[3] = {0, 0, 0};

    for (int a = 0; a < 4; ++a) {
      for (int d = 0; d < 3; ++d) {
        xs[d] += Ns[a] * X[a][d];
        xt[d] += Nt[a] * X[a][d];
      }
    }
    for (int a = 0; a < 4; ++a) {
      for (int d = 0; d < 3; ++d) F[a][d] += 0.25 * N[a] * (xs[(d + 1) % 3] * xt[(d + 2) % 3] - xs[(d + 2) % 3] * xt[(d + 1) % 3]);
    }
  }
}

/*@
  ElasticityAddPressure - Adds the load of a dead pressure on a face, -pressure times the reference normal

  Collective

  Input Parameters:
+ elasticity - the context
. face       - name of the face, "<body>.<face>"
- pressure   - positive pushes on the body [force/length^2]

  Output Parameter:
. force - global vector; the load is added to it, on all rows, the prescribed ones too [force]

  Level: intermediate

  Notes:
  The load is integrated exactly over the bilinear facets of the reference geometry. A name that is not a face of the mesh is an
  error.

.seealso: `ElasticityAddBodyForce()`, `ElasticityForce()`, `MeshGetFacets()`
@*/
PetscErrorCode ElasticityAddPressure(Elasticity e, const char face[], PetscReal pressure, Vec force)
{
  IS                 facets;
  PetscSection       section;
  Vec                coordinates, local;
  const PetscInt    *f;
  const PetscScalar *x;
  PetscScalar       *l;
  PetscInt           n;

  PetscFunctionBegin;
  PetscCall(MeshGetFacets(e->dm, face, &facets));
  PetscCall(DMGetLocalSection(e->dm, &section));
  PetscCall(DMGetCoordinatesLocal(e->dm, &coordinates));
  PetscCall(DMGetLocalVector(e->dm, &local));
  PetscCall(VecZeroEntries(local));
  PetscCall(VecGetArrayRead(coordinates, &x));
  PetscCall(VecGetArray(local, &l));
  PetscCall(ISGetLocalSize(facets, &n));
  PetscCall(ISGetIndices(facets, &f));
  for (PetscInt i = 0; i < n; ++i) {
    PetscInt  vertices[4], offset[4];
    PetscReal X[4][3], F[4][3];

    PetscCall(MeshGetFacetVertices(e->dm, f[i], vertices));
    for (PetscInt a = 0; a < 4; ++a) {
      PetscCall(PetscSectionGetOffset(section, vertices[a], &offset[a]));
      for (PetscInt d = 0; d < 3; ++d) X[a][d] = PetscRealPart(x[offset[a] + d]);
    }
    ElasticityFacetNormals(X, F);
    for (PetscInt a = 0; a < 4; ++a) {
      for (PetscInt d = 0; d < 3; ++d) l[offset[a] + d] -= pressure * F[a][d];
    }
  }
  PetscCall(ISRestoreIndices(facets, &f));
  PetscCall(ISDestroy(&facets));
  PetscCall(VecRestoreArray(local, &l));
  PetscCall(VecRestoreArrayRead(coordinates, &x));
  PetscCall(DMLocalToGlobal(e->dm, local, ADD_VALUES, force));
  PetscCall(DMRestoreLocalVector(e->dm, &local));
  PetscFunctionReturn(0);
}
