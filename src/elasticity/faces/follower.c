/* Follower pressures, which act on the deformed area along the deformed normal: their load and its derivative */
#include "facesimpl.h"
#include <mesh.h>
#include <rankerror.h>

/*
   Computes the symmetric part S of the load's derivative by central differences. These are exact, since the load is
   quadratic in the coordinates. P: minus the pressure at the nodes; x: deformed coordinates
*/
static void FollowerSlope(const Facet *facet, const PetscReal P[], PetscReal x[][3], PetscScalar S[])
{
  const PetscInt width = 3 * facet->n;
  PetscReal      step  = 0, plus[FACET_MAX_NODES][3], minus[FACET_MAX_NODES][3];

  for (PetscInt i = 3; i < width; ++i) step = PetscMax(step, PetscAbsReal(facet->X[i / 3][i % 3] - facet->X[0][i % 3]));
  for (PetscInt i = 0; i < width * width; ++i) S[i] = 0;
  for (PetscInt j = 0; j < width; ++j) {
    const PetscReal place = x[j / 3][j % 3];

    x[j / 3][j % 3] = place + step;
    FacetNormals(facet->n, x, P, plus);
    x[j / 3][j % 3] = place - step;
    FacetNormals(facet->n, x, P, minus);
    x[j / 3][j % 3] = place;
    for (PetscInt i = 0; i < width; ++i) {
      const PetscReal half = (plus[i / 3][i % 3] - minus[i / 3][i % 3]) / (4 * step);

      S[width * i + j] += half;
      S[width * j + i] += half;
    }
  }
}

/* Adds S to the matrix, except in rows and columns of prescribed displacements */
static PetscErrorCode FollowerAddSlope(Elasticity e, const Facet *facet, const PetscInt global[], PetscScalar S[],
  Mat slope)
{
  const PetscInt width = 3 * facet->n;
  PetscInt       rows[FACET_MAX_NODES];

  PetscFunctionBegin;
  for (PetscInt i = 0; i < width; ++i) {
    const PetscInt node = facet->offset[i / 3] / 3;

    rows[i / 3] = global[node];
    if (!e->prescribed || !(e->prescribed[node] >> i % 3 & 1)) continue;
    for (PetscInt j = 0; j < width; ++j) S[width * i + j] = S[width * j + i] = 0;
  }
  PetscCall(MatSetValuesBlocked(slope, facet->n, rows, facet->n, rows, S, ADD_VALUES));
  PetscFunctionReturn(0);
}

/* A pressure, factor times `at`, and the state on whose deformed faces it acts */
typedef struct {
  PetscReal          factor;
  ElasticityPressure at; /* NULL: 1 */
  void              *ctx;
  const PetscScalar *x, *u;  /* coordinates and displacements of the nodes, local [length] */
  const PetscInt    *global; /* global numbers of the nodes */
} Follower;

/* Adds the load on n facets of this rank to a local vector, and its derivative to slope unless that is NULL */
static PetscErrorCode FollowerAddFacets(Elasticity e, const Follower *follower, PetscInt n, const PetscInt facets[],
  PetscScalar l[], Mat slope)
{
  PetscFunctionBegin;
  for (PetscInt i = 0; i < n; ++i) {
    Facet       facet;
    PetscReal   now[FACET_MAX_NODES][3], F[FACET_MAX_NODES][3], P[FACET_MAX_NODES];
    PetscScalar S[9 * FACET_MAX_NODES * FACET_MAX_NODES];

    PetscCall(FacetGet(e, facets[i], follower->x, &facet));
    PetscCall(FacetPressures(&facet, follower->factor, follower->at, follower->ctx, P));
    for (PetscInt k = 0; k < 3 * facet.n; ++k)
      now[k / 3][k % 3] = facet.X[k / 3][k % 3] + PetscRealPart(follower->u[facet.offset[k / 3] + k % 3]);
    FacetNormals(facet.n, now, P, F);
    for (PetscInt k = 0; k < 3 * facet.n; ++k) l[facet.offset[k / 3] + k % 3] += F[k / 3][k % 3];
    if (!slope) continue;
    FollowerSlope(&facet, P, now, S);
    PetscCall(FollowerAddSlope(e, &facet, follower->global, S, slope));
  }
  PetscFunctionReturn(0);
}

/*@
  ElasticityAddFollower - Adds the load of a pressure that follows the deformed normal and area of a face, and its
  derivative

  Collective

  Input Parameters:
+ e        - the context
. face     - name of the face, "<body>.<face>"
. factor   - factor of the pressure
. at       - the pressure at an undeformed position, positive pushes on the body [force/length^2]; `NULL`: 1
. ctx      - its context
- u        - displacement, global [length]

  Output Parameters:
+ force - global vector; the load at u is added to it, on all rows [force]
- slope - matrix from `ElasticityCreateTangent()`, to be assembled; the symmetric part of the load's derivative is added
          to it, except in rows and columns of prescribed unknowns; `NULL`: not computed [force/length]

  Level: intermediate

  Notes:
  For a closed surface, or a surface whose edge is fixed or slides on symmetry planes, the whole derivative is
  symmetric.

  References:
  Schweizerhof and Ramm, Displacement dependent pressure loads in nonlinear finite element analyses, 1984.

.seealso: `ElasticityAddPressure()`, `ElasticityTangent()`
@*/
PetscErrorCode ElasticityAddFollower(Elasticity e, const char face[], PetscReal factor, ElasticityPressure at,
  void *ctx, Vec u, Vec force, Mat slope)
{
  ISLocalToGlobalMapping map;
  IS                     facets;
  Vec                    ulocal, local;
  const PetscInt        *f;
  PetscScalar           *l;
  PetscInt               n;
  Follower               follower = {.factor = -factor, .at = at, .ctx = ctx};

  PetscFunctionBegin;
  PetscCall(DMGetLocalToGlobalMapping(e->dm, &map));
  PetscCall(ISLocalToGlobalMappingGetBlockIndices(map, &follower.global));
  PetscCall(MeshGetFacets(e->dm, face, &facets));
  PetscCall(ISGetLocalSize(facets, &n));
  PetscCall(ISGetIndices(facets, &f));
  PetscCall(ElasticityGetLocals(e, u, &ulocal, &follower.u, &follower.x));
  PetscCall(DMGetLocalVector(e->dm, &local));
  PetscCall(VecZeroEntries(local));
  PetscCall(VecGetArray(local, &l));
  RankCall(PetscObjectComm((PetscObject)e->dm), PETSC_TRUE, FollowerAddFacets(e, &follower, n, f, l, slope));
  PetscCall(VecRestoreArray(local, &l));
  PetscCall(DMLocalToGlobal(e->dm, local, ADD_VALUES, force));
  PetscCall(DMRestoreLocalVector(e->dm, &local));
  PetscCall(ElasticityRestoreLocals(e, &ulocal, &follower.u, &follower.x));
  PetscCall(ISRestoreIndices(facets, &f));
  PetscCall(ISDestroy(&facets));
  PetscCall(ISLocalToGlobalMappingRestoreBlockIndices(map, &follower.global));
  PetscFunctionReturn(0);
}
