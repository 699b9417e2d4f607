/* Shared by the tests of mesh and elasticity: bodies, vertices moved off the grid, smooth displacement fields */
#ifndef ELASTICITY_PROBLEM_H
#define ELASTICITY_PROBLEM_H

#include <mesh.h>
#include <elasticity.h>

/* A slab and a smaller block above it, not touching */
static inline PetscErrorCode ProblemBodies(MaterialType type, SceneBody bodies[2])
{
  static char     slab[] = "slab", block[] = "block";
  const SceneBody two[2] = {
    {slab,  SHAPE_BOX, {-1, -0.5, -1},     {1, 0.5, 0},      {6, 3, 2}, {type, 1, 0.3}},
    {block, SHAPE_BOX, {-0.5, -0.25, 0.2}, {0, 0.25, 0.7}, {2, 2, 2}, {type, 10, 0.1}}
  };

  PetscFunctionBeginUser;
  PetscCall(PetscArraycpy(bodies, two, 2));
  PetscFunctionReturn(0);
}

/* Moves every vertex by a rough function of its place, the same on all ranks that share it */
static inline PetscErrorCode ProblemMoveVertices(DM dm, PetscReal distance)
{
  Vec          coordinates;
  PetscScalar *x;
  PetscInt     n;

  PetscFunctionBeginUser;
  PetscCall(DMGetCoordinatesLocal(dm, &coordinates));
  PetscCall(VecGetLocalSize(coordinates, &n));
  PetscCall(VecGetArray(coordinates, &x));
  for (PetscInt i = 0; i < n; i += 3) {
    const PetscReal phase = 37.1 * PetscRealPart(x[i]) + 91.7 * PetscRealPart(x[i + 1]) + 53.3 * PetscRealPart(x[i + 2]);

    for (PetscInt d = 0; d < 3; ++d) x[i + d] += distance * PetscSinReal((1 + 0.3 * d) * phase + 2 * d);
  }
  PetscCall(VecRestoreArray(coordinates, &x));
  PetscFunctionReturn(0);
}

typedef void (*Field)(const PetscReal x[3], PetscReal u[3]);

/* Vertex values of a displacement field, as a new global vector */
static inline PetscErrorCode ProblemInterpolate(DM dm, Field field, Vec *u)
{
  Vec                coordinates, local;
  const PetscScalar *x;
  PetscScalar       *v;
  PetscInt           n;

  PetscFunctionBeginUser;
  PetscCall(DMCreateGlobalVector(dm, u));
  PetscCall(DMGetCoordinatesLocal(dm, &coordinates));
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

/* Prints whether a figure is within its tolerance, and the figure itself only if it is not */
static inline PetscErrorCode ProblemReport(const char name[], PetscReal value, PetscReal tolerance)
{
  PetscFunctionBeginUser;
  if (value <= tolerance) PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%s: below %g\n", name, (double)tolerance));
  else PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%s: %g, NOT below %g\n", name, (double)value, (double)tolerance));
  PetscFunctionReturn(0);
}

#endif
