/* Shared by the tests of mesh and elasticity: bodies, vertices moved off the grid, smooth displacement fields */
#ifndef ELASTICITY_PROBLEM_H
#define ELASTICITY_PROBLEM_H

#include <mesh.h>
#include <elasticity.h>
#include <petscksp.h>
#include "../elasticity/elasticity_tetrahedra.h"

/* A box; material, element and all the rest are the caller's to set */
static inline void ProblemBox(char name[], const PetscReal lower[3], const PetscReal upper[3], const PetscInt cells[3],
  SceneBody *body)
{
  *body       = (SceneBody){0};
  body->name  = name;
  body->shape = SHAPE_BOX;
  for (PetscInt d = 0; d < 3; ++d) {
    body->lower[d] = lower[d];
    body->upper[d] = upper[d];
    body->cells[d] = cells[d];
  }
}

/* A slab and a smaller block above it, not touching */
static inline PetscErrorCode ProblemBodies(MaterialType type, SceneBody bodies[2])
{
  static char     slab[] = "slab", block[] = "block";
  const PetscReal lower[2][3] = {{-1, -0.5, -1}, {-0.5, -0.25, 0.2}}, upper[2][3] = {{1, 0.5, 0}, {0, 0.25, 0.7}};
  const PetscInt  cells[2][3]  = {{6, 3, 2}, {2, 2, 2}};
  const Material  materials[2] = {{.type = type, .young = 1, .poisson = 0.3},
     {.type = type, .young = 10, .poisson = 0.1}};

  PetscFunctionBeginUser;
  ProblemBox(slab, lower[0], upper[0], cells[0], &bodies[0]);
  ProblemBox(block, lower[1], upper[1], cells[1], &bodies[1]);
  for (PetscInt b = 0; b < 2; ++b) bodies[b].material = materials[b];
  PetscFunctionReturn(0);
}

/* -material and -element; what is not given stays */
static inline PetscErrorCode ProblemOptions(MaterialType *type, ElementType *element)
{
  PetscEnum m = (PetscEnum)*type, e = (PetscEnum)*element;

  PetscFunctionBeginUser;
  PetscCall(PetscOptionsGetEnum(NULL, NULL, "-material", MaterialTypes, &m, NULL));
  PetscCall(PetscOptionsGetEnum(NULL, NULL, "-element", ElementTypes, &e, NULL));
  *type    = (MaterialType)m;
  *element = (ElementType)e;
  PetscFunctionReturn(0);
}

/* -order of bodies, and -tetrahedra in place of boxes */
static inline PetscErrorCode ProblemSetOrder(PetscInt nbodies, SceneBody bodies[])
{
  PetscInt  order      = 1;
  PetscBool tetrahedra = PETSC_FALSE;

  PetscFunctionBeginUser;
  PetscCall(PetscOptionsGetInt(NULL, NULL, "-order", &order, NULL));
  PetscCall(PetscOptionsGetBool(NULL, NULL, "-tetrahedra", &tetrahedra, NULL));
  for (PetscInt b = 0; b < nbodies; ++b) {
    bodies[b].order = order;
    if (tetrahedra) PetscCall(TetrahedraFromBox(&bodies[b]));
  }
  PetscFunctionReturn(0);
}

/* Moves every node by a rough function of its place, the same on all ranks that share it */
static inline PetscErrorCode ProblemMoveNodes(DM dm, PetscReal distance)
{
  Vec          coordinates;
  PetscScalar *x;
  PetscInt     n;

  PetscFunctionBeginUser;
  PetscCall(MeshGetNodeCoordinates(dm, &coordinates));
  PetscCall(VecGetLocalSize(coordinates, &n));
  PetscCall(VecGetArray(coordinates, &x));
  for (PetscInt i = 0; i < n; i += 3) {
    const PetscReal phase =
      37.1 * PetscRealPart(x[i]) + 91.7 * PetscRealPart(x[i + 1]) + 53.3 * PetscRealPart(x[i + 2]);

    for (PetscInt d = 0; d < 3; ++d) x[i + d] += distance * PetscSinReal((1 + 0.3 * d) * phase + 2 * d);
  }
  PetscCall(VecRestoreArray(coordinates, &x));
  PetscFunctionReturn(0);
}

typedef void (*Field)(const PetscReal x[3], PetscReal u[3]);

/* Replaces every three entries of a vector by their image */
static inline PetscErrorCode ProblemMapVector(Vec v, Field map)
{
  PetscScalar *a;
  PetscInt     n;

  PetscFunctionBeginUser;
  PetscCall(VecGetLocalSize(v, &n));
  PetscCall(VecGetArray(v, &a));
  for (PetscInt i = 0; i < n; i += 3) {
    const PetscReal x[3] = {PetscRealPart(a[i]), PetscRealPart(a[i + 1]), PetscRealPart(a[i + 2])};
    PetscReal       image[3];

    map(x, image);
    for (PetscInt d = 0; d < 3; ++d) a[i + d] = image[d];
  }
  PetscCall(VecRestoreArray(v, &a));
  PetscFunctionReturn(0);
}

/* Moves every node to its image */
static inline PetscErrorCode ProblemMapNodes(DM dm, Field map)
{
  Vec coordinates;

  PetscFunctionBeginUser;
  PetscCall(MeshGetNodeCoordinates(dm, &coordinates));
  PetscCall(ProblemMapVector(coordinates, map));
  PetscFunctionReturn(0);
}

/* A displacement field at the nodes, as a new global vector */
static inline PetscErrorCode ProblemInterpolate(DM dm, Field field, Vec *u)
{
  Vec                coordinates, local;
  const PetscScalar *x;
  PetscScalar       *v;
  PetscInt           n;

  PetscFunctionBeginUser;
  PetscCall(DMCreateGlobalVector(dm, u));
  PetscCall(MeshGetNodeCoordinates(dm, &coordinates));
  PetscCall(DMGetLocalVector(dm, &local));
  PetscCall(VecGetLocalSize(coordinates, &n));
  PetscCall(VecGetArrayRead(coordinates, &x));
  PetscCall(VecGetArray(local, &v));
  for (PetscInt i = 0; i < n; i += 3) {
    const PetscReal place[3] = {PetscRealPart(x[i]), PetscRealPart(x[i + 1]), PetscRealPart(x[i + 2])};
    PetscReal       value[3];

    field(place, value);
    for (PetscInt d = 0; d < 3; ++d) v[i + d] = value[d];
  }
  PetscCall(VecRestoreArray(local, &v));
  PetscCall(VecRestoreArrayRead(coordinates, &x));
  PetscCall(DMLocalToGlobal(dm, local, INSERT_VALUES, *u));
  PetscCall(DMRestoreLocalVector(dm, &local));
  PetscFunctionReturn(0);
}

/* Prescribes all components on one face */
static inline PetscErrorCode ProblemFixFace(DM dm, const char face[], IS *rows)
{
  IS components[3];

  PetscFunctionBeginUser;
  for (PetscInt d = 0; d < 3; ++d) PetscCall(MeshGetFaceDofs(dm, face, d, &components[d]));
  PetscCall(ISConcatenate(PetscObjectComm((PetscObject)dm), 3, components, rows));
  for (PetscInt d = 0; d < 3; ++d) PetscCall(ISDestroy(&components[d]));
  PetscFunctionReturn(0);
}

/* Newton's method for force(u) = load on the rows that are not prescribed, from u, which holds the prescribed
   displacements; -ksp_ and -pc_ options */
static inline PetscErrorCode ProblemNewton(Elasticity e, IS prescribed, Vec load, Mat K, Vec u)
{
  const PetscReal rtol = 1e-9;
  PetscReal       norm, external, internal;
  KSP             ksp;
  Vec             residual, step;

  PetscFunctionBeginUser;
  PetscCall(VecDuplicate(u, &residual));
  PetscCall(VecDuplicate(u, &step));
  PetscCall(KSPCreate(PetscObjectComm((PetscObject)u), &ksp));
  PetscCall(KSPSetType(ksp, KSPCG));
  PetscCall(KSPSetTolerances(ksp, 1e-9, PETSC_DEFAULT, PETSC_DEFAULT, 10000));
  PetscCall(KSPSetErrorIfNotConverged(ksp, PETSC_TRUE));
  PetscCall(KSPSetFromOptions(ksp));
  PetscCall(VecNorm(load, NORM_2, &external));
  for (PetscInt it = 0;; ++it) {
    PetscCall(ElasticityForce(e, u, residual));
    PetscCall(VecNorm(residual, NORM_2, &internal));
    PetscCall(VecAYPX(residual, -1, load));
    PetscCall(VecISSet(residual, prescribed, 0));
    PetscCall(VecNorm(residual, NORM_2, &norm));
    if (norm <= rtol * PetscMax(external, internal)) break;
    PetscCheck(it < 20, PetscObjectComm((PetscObject)u), PETSC_ERR_NOT_CONVERGED,
      "Newton's method left a residual of %g of the forces", (double)(norm / PetscMax(external, internal)));
    PetscCall(ElasticityTangent(e, u, K));
    PetscCall(KSPSetOperators(ksp, K, K));
    PetscCall(KSPSolve(ksp, residual, step));
    PetscCall(VecAXPY(u, 1, step));
  }
  PetscCall(KSPDestroy(&ksp));
  PetscCall(VecDestroy(&step));
  PetscCall(VecDestroy(&residual));
  PetscFunctionReturn(0);
}

/* One body of elements, held on prescribed rows, under dead loads */
typedef struct {
  DM         dm;
  Elasticity e;
  IS         rows;
  Mat        K;
  Vec        u, load; /* zero at first */
} ProblemBody;

/* Takes over dm and rows */
static inline PetscErrorCode ProblemBodyCreate(DM dm, const Material *material, ElementType element, IS rows,
  ProblemBody *body)
{
  PetscFunctionBeginUser;
  body->dm   = dm;
  body->rows = rows;
  PetscCall(ElasticityCreate(dm, 1, material, &element, &body->e));
  PetscCall(ElasticitySetPrescribed(body->e, rows));
  PetscCall(ElasticityCreateTangent(body->e, &body->K));
  PetscCall(ElasticitySetNearNullSpace(body->e, body->K));
  PetscCall(DMCreateGlobalVector(dm, &body->u));
  PetscCall(VecDuplicate(body->u, &body->load));
  PetscCall(VecZeroEntries(body->u));
  PetscCall(VecZeroEntries(body->load));
  PetscFunctionReturn(0);
}

static inline PetscErrorCode ProblemBodyDestroy(ProblemBody *body)
{
  PetscFunctionBeginUser;
  PetscCall(VecDestroy(&body->load));
  PetscCall(VecDestroy(&body->u));
  PetscCall(MatDestroy(&body->K));
  PetscCall(ISDestroy(&body->rows));
  PetscCall(ElasticityDestroy(&body->e));
  PetscCall(DMDestroy(&body->dm));
  PetscFunctionReturn(0);
}

/* Prints whether a figure is within its tolerance, and the figure itself only if it is not */
static inline PetscErrorCode ProblemReport(const char name[], PetscReal value, PetscReal tolerance)
{
  PetscFunctionBeginUser;
  if (value <= tolerance) PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%s: below %g\n", name, (double)tolerance));
  else PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%s: %g, NOT below %g\n", name, (double)value, (double)tolerance));
  PetscFunctionReturn(0);
}

/* Central differences with step h along a direction d: the force against the energy, and the tangent K at u against
   the force */
static inline PetscErrorCode ProblemCheckDifferences(Elasticity e, Vec u, Vec d, Mat K, PetscReal h,
  PetscReal force_tolerance, PetscReal tangent_tolerance)
{
  Vec         f, w, Kd;
  PetscReal   forward, backward, slope, norm, scale;
  PetscScalar work;

  PetscFunctionBeginUser;
  PetscCall(VecDuplicate(u, &f));
  PetscCall(VecDuplicate(u, &w));
  PetscCall(VecDuplicate(u, &Kd));
  PetscCall(ElasticityForce(e, u, f));
  PetscCall(VecDot(f, d, &work));
  PetscCall(MatMult(K, d, Kd));
  PetscCall(VecNorm(Kd, NORM_2, &scale));
  PetscCall(VecWAXPY(w, h, d, u));
  PetscCall(ElasticityEnergy(e, w, &forward));
  PetscCall(ElasticityForce(e, w, f));
  PetscCall(VecAXPY(Kd, -1 / (2 * h), f));
  PetscCall(VecWAXPY(w, -h, d, u));
  PetscCall(ElasticityEnergy(e, w, &backward));
  PetscCall(ElasticityForce(e, w, f));
  PetscCall(VecAXPY(Kd, 1 / (2 * h), f));
  PetscCall(VecNorm(Kd, NORM_2, &norm));
  slope = (forward - backward) / (2 * h);
  PetscCall(ProblemReport("force against differences of the energy, relative",
    PetscAbsReal(slope - PetscRealPart(work)) / PetscAbsReal(slope), force_tolerance));
  PetscCall(ProblemReport("tangent against differences of the force, relative", norm / scale, tangent_tolerance));
  PetscCall(VecDestroy(&Kd));
  PetscCall(VecDestroy(&w));
  PetscCall(VecDestroy(&f));
  PetscFunctionReturn(0);
}

#endif
