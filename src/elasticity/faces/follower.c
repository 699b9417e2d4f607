/* Follower pressures, which act on the deformed area along the deformed normal: their load and its derivative */
#include "facesimpl.h"
#include <mesh.h>

/* Computes the nodal forces of -pressure n on the deformed facet. x: deformed coordinates. */
static void FollowerLoad(const Facet *facet, PetscReal pressure, PetscReal x[][3], PetscReal F[][3])
{
  FacetNormals(facet->n, x, F);
  for (PetscInt i = 0; i < 3 * facet->n; ++i) F[i / 3][i % 3] *= -pressure;
}

/*
   Computes the symmetric part S of the load's derivative by central differences. These are exact, since the load is
   quadratic in the coordinates.
*/
static void FollowerSlope(const Facet *facet, PetscReal pressure, PetscReal x[][3], PetscScalar S[])
{
  const PetscInt width = 3 * facet->n;
  PetscReal      step  = 0, plus[FACET_MAX_NODES][3], minus[FACET_MAX_NODES][3];

  for (PetscInt i = 3; i < width; ++i) step = PetscMax(step, PetscAbsReal(facet->X[i / 3][i % 3] - facet->X[0][i % 3]));
  for (PetscInt i = 0; i < width * width; ++i) S[i] = 0;
  for (PetscInt j = 0; j < width; ++j) {
    const PetscReal place = x[j / 3][j % 3];

    x[j / 3][j % 3] = place + step;
    FollowerLoad(facet, pressure, x, plus);
    x[j / 3][j % 3] = place - step;
    FollowerLoad(facet, pressure, x, minus);
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

/*@
  ElasticityAddFollower - Adds the load of a pressure that follows the deformed normal and area of a face, and its
  derivative

  Collective

  Input Parameters:
+ e        - the context
. face     - name of the face, "<body>.<face>"
. pressure - positive pushes on the body [force/length^2]
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
PetscErrorCode ElasticityAddFollower(Elasticity e, const char face[], PetscReal pressure, Vec u, Vec force, Mat slope)
{
  ISLocalToGlobalMapping map;
  IS                     facets;
  Vec                    ulocal, local;
  const PetscInt        *f, *global;
  const PetscScalar     *x, *ul;
  PetscScalar           *l;
  PetscInt               n;

  PetscFunctionBegin;
  PetscCall(DMGetLocalToGlobalMapping(e->dm, &map));
  PetscCall(ISLocalToGlobalMappingGetBlockIndices(map, &global));
  PetscCall(MeshGetFacets(e->dm, face, &facets));
  PetscCall(ISGetLocalSize(facets, &n));
  PetscCall(ISGetIndices(facets, &f));
  PetscCall(ElasticityGetLocals(e, u, &ulocal, &ul, &x));
  PetscCall(DMGetLocalVector(e->dm, &local));
  PetscCall(VecZeroEntries(local));
  PetscCall(VecGetArray(local, &l));
  for (PetscInt i = 0; i < n; ++i) {
    Facet       facet;
    PetscReal   now[FACET_MAX_NODES][3], F[FACET_MAX_NODES][3];
    PetscScalar S[9 * FACET_MAX_NODES * FACET_MAX_NODES];

    PetscCall(FacetGet(e, f[i], x, &facet));
    for (PetscInt k = 0; k < 3 * facet.n; ++k)
      now[k / 3][k % 3] = facet.X[k / 3][k % 3] + PetscRealPart(ul[facet.offset[k / 3] + k % 3]);
    FollowerLoad(&facet, pressure, now, F);
    for (PetscInt k = 0; k < 3 * facet.n; ++k) l[facet.offset[k / 3] + k % 3] += F[k / 3][k % 3];
    if (!slope) continue;
    FollowerSlope(&facet, pressure, now, S);
    PetscCall(FollowerAddSlope(e, &facet, global, S, slope));
  }
  PetscCall(VecRestoreArray(local, &l));
  PetscCall(DMLocalToGlobal(e->dm, local, ADD_VALUES, force));
  PetscCall(DMRestoreLocalVector(e->dm, &local));
  PetscCall(ElasticityRestoreLocals(e, &ulocal, &ul, &x));
  PetscCall(ISRestoreIndices(facets, &f));
  PetscCall(ISDestroy(&facets));
  PetscCall(ISLocalToGlobalMappingRestoreBlockIndices(map, &global));
  PetscFunctionReturn(0);
}
