/*
   Divides the reactions at nodes among the faces. Each prescribed component of a face, and each inclined symmetry
   plane, is a constraint along a unit vector d. Its force at a node is (d.m) d. The vector m solves G m = r, where r is
   the reaction at the node, and G is the sum of d d^T over the constraints of the node. Of all forces whose sum is r,
   these have the smallest squares: equal constraints have equal shares, and the others are those of statics.
*/
#include "constraintsimpl.h"
#include <vector3.h>

/* Counts the faces that prescribe each row of this rank */
static PetscErrorCode FaceForcesCount(const Constraints *constraints, PetscInt rstart, PetscInt sharers[])
{
  PetscFunctionBegin;
  for (PetscInt i = 0; i < constraints->bodies.scene->ndisplacements; ++i) {
    const SceneDisplacement *d = &constraints->bodies.scene->displacements[i];

    for (PetscInt c = 0; c < 3; ++c) {
      IS              is;
      const PetscInt *rows;
      PetscInt        n;

      if (!d->fixed[c]) continue;
      PetscCall(MeshGetFaceDofs(constraints->bodies.dm, d->face, c, &is));
      PetscCall(ISGetLocalSize(is, &n));
      PetscCall(ISGetIndices(is, &rows));
      for (PetscInt k = 0; k < n; ++k) ++sharers[rows[k] - rstart];
      PetscCall(ISRestoreIndices(is, &rows));
      PetscCall(ISDestroy(&is));
    }
  }
  PetscFunctionReturn(0);
}

/* Adds (sign) q q^T to A */
static void FaceForcesAddProduct(const PetscReal q[3], PetscReal sign, PetscReal A[3][3])
{
  for (PetscInt k = 0; k < 9; ++k) A[k / 3][k % 3] += sign * q[k / 3] * q[k % 3];
}

/* Sums d d^T over the inclined planes at each node of this rank. *planes is NULL if there are none. */
static PetscErrorCode FaceForcesSumPlanes(const Constraints *constraints, PetscInt rstart, PetscInt nnodes,
  PetscReal (**planes)[3][3])
{
  PetscFunctionBegin;
  *planes = NULL;
  for (PetscInt i = 0; i < constraints->bodies.scene->ndisplacements; ++i) {
    const SceneDisplacement *d = &constraints->bodies.scene->displacements[i];
    PetscReal                normal[3];
    IS                       is;
    const PetscInt          *rows;
    PetscInt                 n;

    if (!d->inclined) continue;
    if (!*planes) PetscCall(PetscCalloc1(nnodes, planes));
    PetscCall(PetscArraycpy(normal, d->normal, 3));
    VectorScaleToUnit(normal);
    PetscCall(MeshGetFaceDofs(constraints->bodies.dm, d->face, 0, &is));
    PetscCall(ISGetLocalSize(is, &n));
    PetscCall(ISGetIndices(is, &rows));
    for (PetscInt k = 0; k < n; ++k) FaceForcesAddProduct(normal, 1.0, (*planes)[(rows[k] - rstart) / 3]);
    PetscCall(ISRestoreIndices(is, &rows));
    PetscCall(ISDestroy(&is));
  }
  PetscFunctionReturn(0);
}

/* Computes the shortest m with A m = p, where p is the part of r in the range of A. A: symmetric, no negative
   eigenvalues */
static void FaceForcesSolve(PetscReal A[3][3], const PetscReal r[3], PetscReal m[3], PetscReal p[3])
{
  const PetscReal rounding = 1e-12; /* planes whose directions differ by 1e-6 count as equal */
  PetscReal       rest[3][3], regular[3][3];

  for (PetscInt k = 0; k < 9; ++k) {
    rest[k / 3][k % 3]    = A[k / 3][k % 3];
    regular[k / 3][k % 3] = A[k / 3][k % 3] + (k / 3 == k % 3);
  }
  for (PetscInt c = 0; c < 3; ++c) p[c] = 0.0;
  for (PetscInt rank = 0; rank < 3; ++rank) {
    PetscInt  largest = 0;
    PetscReal q[3];

    for (PetscInt k = 1; k < 3; ++k)
      if (VectorNorm(rest[k]) > VectorNorm(rest[largest])) largest = k;
    for (PetscInt c = 0; c < 3; ++c) q[c] = rest[largest][c];
    if (!(VectorScaleToUnit(q) > rounding)) break;
    FaceForcesAddProduct(q, -1.0, regular);
    for (PetscInt k = 0; k < 3; ++k) {
      const PetscReal along = VectorDot(rest[k], q);

      for (PetscInt c = 0; c < 3; ++c) rest[k][c] -= along * q[c];
    }
    for (PetscInt c = 0; c < 3; ++c) p[c] += VectorDot(q, r) * q[c];
  }
  MatrixSolve(regular, p, m);
}

/* Computes m of a node on inclined planes. ties: on entry the forces of its dependent displacements, on exit without
   those of the planes; reaction: forces in prescribed rows; sharers: number of faces that prescribe each of its rows */
static void FaceForcesDivideNode(PetscReal planes[3][3], const PetscInt sharers[3], const PetscScalar reaction[3],
  PetscScalar ties[3], PetscScalar m[3])
{
  PetscReal all[3][3], t[3], p[3], x[3];

  for (PetscInt c = 0; c < 3; ++c) t[c] = PetscRealPart(ties[c]);
  FaceForcesSolve(planes, t, x, p);
  for (PetscInt k = 0; k < 9; ++k) all[k / 3][k % 3] = planes[k / 3][k % 3];
  for (PetscInt c = 0; c < 3; ++c) {
    ties[c] -= p[c];
    all[c][c] += (PetscReal)sharers[c];
    if (sharers[c]) p[c] += PetscRealPart(reaction[c]);
  }
  FaceForcesSolve(all, p, x, t);
  for (PetscInt c = 0; c < 3; ++c) m[c] = x[c];
}

/*
   Computes m in a new vector. reaction: forces in prescribed rows; ties: on entry the forces of dependent displacements
   on the bodies, on exit without those of inclined planes; NULL if there are none
*/
PetscErrorCode FaceForcesDivide(const Constraints *constraints, Vec reaction, Vec ties, Vec *m)
{
  PetscInt n, rstart, *sharers;
  PetscReal(*planes)[3][3];
  const PetscScalar *r;
  PetscScalar       *a, *t;

  PetscFunctionBegin;
  PetscCall(VecDuplicate(reaction, m));
  PetscCall(VecGetLocalSize(reaction, &n));
  PetscCall(VecGetOwnershipRange(reaction, &rstart, NULL));
  PetscCall(PetscCalloc1(n, &sharers));
  PetscCall(FaceForcesCount(constraints, rstart, sharers));
  PetscCall(FaceForcesSumPlanes(constraints, rstart, n / 3, &planes));
  PetscCall(VecGetArrayRead(reaction, &r));
  PetscCall(VecGetArray(*m, &a));
  for (PetscInt i = 0; i < n; ++i) a[i] = sharers[i] ? r[i] / (PetscReal)sharers[i] : 0.0;
  if (planes) {
    PetscCall(VecGetArray(ties, &t));
    for (PetscInt v = 0; v < n / 3; ++v) {
      const PetscInt i = 3 * v;

      if (planes[v][0][0] + planes[v][1][1] + planes[v][2][2] > 0.0)
        FaceForcesDivideNode(planes[v], &sharers[i], &r[i], &t[i], &a[i]);
    }
    PetscCall(VecRestoreArray(ties, &t));
  }
  PetscCall(VecRestoreArray(*m, &a));
  PetscCall(VecRestoreArrayRead(reaction, &r));
  PetscCall(PetscFree(planes));
  PetscCall(PetscFree(sharers));
  PetscFunctionReturn(0);
}
