/* Integrals over faces with one quadrature rule: tractions, areas and moments, springs */
#include "facesimpl.h"

/* The facets of a face on this rank */
typedef struct {
  PetscInt n;
  Facet   *facets;
} Face;

typedef struct {
  PetscReal N[FACET_MAX_NODES], x[3], area; /* values of the shape functions; coordinates [length]; weight x area
                                               [length^2] */
} FacePoint;

#define FACE_POINTS 9

static PetscErrorCode FaceCreate(Elasticity e, const char name[], Face *face)
{
  IS                 facets;
  Vec                coordinates;
  const PetscInt    *f;
  const PetscScalar *x;

  PetscFunctionBegin;
  PetscCall(MeshGetFacets(e->dm, name, &facets));
  PetscCall(MeshGetNodeCoordinates(e->dm, &coordinates));
  PetscCall(ISGetLocalSize(facets, &face->n));
  PetscCall(ISGetIndices(facets, &f));
  PetscCall(VecGetArrayRead(coordinates, &x));
  PetscCall(PetscMalloc1(face->n, &face->facets));
  for (PetscInt i = 0; i < face->n; ++i) PetscCall(FacetGet(e, f[i], x, &face->facets[i]));
  PetscCall(VecRestoreArrayRead(coordinates, &x));
  PetscCall(ISRestoreIndices(facets, &f));
  PetscCall(ISDestroy(&facets));
  PetscFunctionReturn(0);
}

static PetscErrorCode FaceDestroy(Face *face)
{
  PetscFunctionBegin;
  PetscCall(PetscFree(face->facets));
  PetscFunctionReturn(0);
}

/* Computes the 3 x 3 quadrature points of a facet. The rule is exact for plane facets. */
static void FaceGetPoints(const Facet *facet, FacePoint points[FACE_POINTS])
{
  for (int q = 0; q < FACE_POINTS; ++q) {
    PetscReal       Ns[FACET_MAX_NODES], Nt[FACET_MAX_NODES], xs[3] = {0, 0, 0}, xt[3] = {0, 0, 0}, n[3], s, t;
    const PetscReal weight = FacetQuadrature(facet->n, 3, q, &s, &t);

    FacetShape(facet->n, s, t, points[q].N, Ns, Nt);
    for (int d = 0; d < 3; ++d) {
      points[q].x[d] = 0;
      for (PetscInt a = 0; a < facet->n; ++a) {
        points[q].x[d] += points[q].N[a] * facet->X[a][d];
        xs[d] += Ns[a] * facet->X[a][d];
        xt[d] += Nt[a] * facet->X[a][d];
      }
    }
    VectorCross(xs, xt, n);
    points[q].area = weight * VectorNorm(n);
  }
}

/* Adds int N_a f(x) dA to a global vector, where f is the function `field` */
static PetscErrorCode FaceAddField(Elasticity e, const char                             name[],
  void (*field)(const PetscReal x[3], const void *ctx, PetscReal value[3]), const void *ctx, Vec total)
{
  Face         face;
  Vec          local;
  PetscScalar *l;

  PetscFunctionBegin;
  PetscCall(FaceCreate(e, name, &face));
  PetscCall(DMGetLocalVector(e->dm, &local));
  PetscCall(VecZeroEntries(local));
  PetscCall(VecGetArray(local, &l));
  for (PetscInt i = 0; i < face.n; ++i) {
    FacePoint points[FACE_POINTS];

    FaceGetPoints(&face.facets[i], points);
    for (int q = 0; q < FACE_POINTS; ++q) {
      PetscReal value[3];

      field(points[q].x, ctx, value);
      for (PetscInt a = 0; a < face.facets[i].n; ++a) {
        for (int d = 0; d < 3; ++d) l[face.facets[i].offset[a] + d] += points[q].area * points[q].N[a] * value[d];
      }
    }
  }
  PetscCall(VecRestoreArray(local, &l));
  PetscCall(DMLocalToGlobal(e->dm, local, ADD_VALUES, total));
  PetscCall(DMRestoreLocalVector(e->dm, &local));
  PetscCall(FaceDestroy(&face));
  PetscFunctionReturn(0);
}

static void FaceUniform(const PetscReal x[3], const void *ctx, PetscReal value[3])
{
  (void)x;
  for (int d = 0; d < 3; ++d) value[d] = ((const PetscReal *)ctx)[d];
}

/*@
  ElasticityAddFaceField - Adds the integral over a face of each node's shape function times a constant: the load of a
  dead traction, or the stiffness of springs

  Collective

  Input Parameters:
+ e     - the context
. face  - name of the face, "<body>.<face>"
- value - x, y, z per undeformed area

  Output Parameter:
. total - global vector; the integral is added to it, on all rows

  Level: intermediate

.seealso: `ElasticityAddForce()`, `ElasticityAddPressure()`, `ElasticitySetSprings()`
@*/
PetscErrorCode ElasticityAddFaceField(Elasticity e, const char face[], const PetscReal value[3], Vec total)
{
  PetscFunctionBegin;
  PetscCall(FaceAddField(e, face, FaceUniform, value, total));
  PetscFunctionReturn(0);
}

/* The traction t(x) = a + b x (x - center) */
typedef struct {
  PetscReal a[3], b[3], center[3];
} FaceTraction;

static void FaceTwisted(const PetscReal x[3], const void *ctx, PetscReal value[3])
{
  const FaceTraction *t    = (const FaceTraction *)ctx;
  const PetscReal     r[3] = {x[0] - t->center[0], x[1] - t->center[1], x[2] - t->center[2]};

  for (int d = 0; d < 3; ++d) value[d] = t->a[d];
  VectorAddCross(t->b, r, value);
}

/*
   Computes area, first moments int r dA, and second moments int r r^T dA (xx yy zz xy yz zx) of a face, where r is the
   position relative to the point `about`
*/
static PetscErrorCode FaceMeasure(Elasticity e, const char name[], const PetscReal about[3], PetscReal sums[10])
{
  static const int row[6] = {0, 1, 2, 0, 1, 2}, column[6] = {0, 1, 2, 1, 2, 0};
  Face             face;

  PetscFunctionBegin;
  for (int k = 0; k < 10; ++k) sums[k] = 0;
  PetscCall(FaceCreate(e, name, &face));
  for (PetscInt i = 0; i < face.n; ++i) {
    FacePoint points[FACE_POINTS];

    FaceGetPoints(&face.facets[i], points);
    for (int q = 0; q < FACE_POINTS; ++q) {
      PetscReal r[3];

      for (int d = 0; d < 3; ++d) r[d] = points[q].x[d] - about[d];
      sums[0] += points[q].area;
      for (int d = 0; d < 3; ++d) sums[1 + d] += points[q].area * r[d];
      for (int k = 0; k < 6; ++k) sums[4 + k] += points[q].area * r[row[k]] * r[column[k]];
    }
  }
  PetscCall(FaceDestroy(&face));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sums, 10, MPIU_REAL, MPIU_SUM, PetscObjectComm((PetscObject)e->dm)));
  PetscFunctionReturn(0);
}

/*
   Solves int r x (b x r) dA = moment for b. s: second moments of the face. Returns false if the moments are singular.
*/
static PetscBool FaceSolveMoment(const PetscReal s[6], const PetscReal moment[3], PetscReal b[3])
{
  PetscReal inertia[3][3], size;

  MatrixSetInertia(s, inertia);
  size = inertia[0][0] + inertia[1][1] + inertia[2][2];
  return (PetscBool)(MatrixSolve(inertia, moment, b) > 1e-12 * size * size * size);
}

/*@
  ElasticityAddForce - Adds a dead load on a face: the linear traction with a given resultant force and moment

  Collective

  Input Parameters:
+ e         - the context
. face      - name of the face, "<body>.<face>"
. resultant - the force [force]
. moment    - the moment about the point where the force acts [force length]
- point     - that point; `NULL`: the face's centroid [length]

  Output Parameter:
. force - global vector; the load is added to it, on all rows, the prescribed ones too [force]

  Level: intermediate

  Notes:
  The traction is a + b x (x - centroid) per undeformed area: uniform for a force, linear for a moment.

.seealso: `ElasticityAddFaceField()`, `ElasticityAddPressure()`
@*/
PetscErrorCode ElasticityAddForce(Elasticity e, const char face[], const PetscReal resultant[3],
  const PetscReal moment[3], const PetscReal point[3], Vec force)
{
  FaceTraction t = {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}};
  PetscReal    sums[10], arm[3] = {0, 0, 0}, about[3];
  PetscBool    solved;

  PetscFunctionBegin;
  PetscCall(FaceMeasure(e, face, t.center, sums));
  for (int d = 0; d < 3; ++d) t.center[d] = sums[1 + d] / sums[0];
  PetscCall(FaceMeasure(e, face, t.center, sums));
  for (int d = 0; d < 3; ++d) t.a[d] = resultant[d] / sums[0];
  for (int d = 0; point && d < 3; ++d) arm[d] = point[d] - t.center[d];
  PetscCall(PetscArraycpy(about, moment, 3));
  VectorAddCross(arm, resultant, about);
  solved = FaceSolveMoment(sums + 4, about, t.b);
  PetscCheck(solved, PetscObjectComm((PetscObject)e->dm), PETSC_ERR_ARG_WRONG,
    "The face \"%s\" is too slender to carry a moment: apply the moment to a larger face", face);
  PetscCall(FaceAddField(e, face, FaceTwisted, &t, force));
  PetscFunctionReturn(0);
}
