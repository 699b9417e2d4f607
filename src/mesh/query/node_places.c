/* Undeformed coordinates and bodies of the nodes that this rank owns. */
#include "queryimpl.h"

/* Determines the body of each owned node. This rank has a cell of every node that it owns. */
static PetscErrorCode VertexPlacesFindBodies(DM dm, PetscSection global, PetscInt rstart, PetscInt body[])
{
  DMLabel  label;
  PetscInt cstart, cend;

  PetscFunctionBegin;
  PetscCall(DMGetLabel(dm, MESH_BODY_LABEL, &label));
  PetscCall(DMPlexGetHeightStratum(dm, 0, &cstart, &cend));
  for (PetscInt c = cstart; c < cend; ++c) {
    PetscInt b, n, nodes[MESH_MAX_NODES];

    PetscCall(DMLabelGetValue(label, c, &b));
    PetscCall(MeshGetCellNodes(dm, c, &n, nodes));
    for (PetscInt i = 0; i < n; ++i) {
      PetscInt offset;

      PetscCall(PetscSectionGetOffset(global, nodes[i], &offset));
      if (offset >= 0) body[(offset - rstart) / 3] = b;
    }
  }
  PetscFunctionReturn(0);
}

PetscErrorCode VertexPlacesCreate(DM dm, VertexPlaces *places)
{
  PetscSection global;
  Vec          coordinates;
  PetscInt     n, rstart;

  PetscFunctionBegin;
  PetscCall(DMCreateGlobalVector(dm, &places->x));
  PetscCall(VecGetLocalSize(places->x, &n));
  PetscCall(VecGetOwnershipRange(places->x, &rstart, NULL));
  PetscCall(PetscCalloc1(n / 3, &places->body));
  PetscCall(DMGetGlobalSection(dm, &global));
  PetscCall(MeshGetNodeCoordinates(dm, &coordinates));
  PetscCall(DMLocalToGlobal(dm, coordinates, INSERT_VALUES, places->x));
  PetscCall(VertexPlacesFindBodies(dm, global, rstart, places->body));
  PetscFunctionReturn(0);
}

/* Computes the displacement of each node by the motion of its body. u: displacement before; NULL: none */
PetscErrorCode VertexPlacesMove(const VertexPlaces *places, Vec u, const BodyMotion motions[], Vec moved)
{
  const PetscScalar *x, *a = NULL;
  PetscScalar       *v;
  PetscInt           n;

  PetscFunctionBegin;
  PetscCall(VecGetLocalSize(moved, &n));
  PetscCall(VecGetArrayRead(places->x, &x));
  if (u) PetscCall(VecGetArrayRead(u, &a));
  PetscCall(VecGetArrayWrite(moved, &v));
  for (PetscInt i = 0; i < n; ++i) {
    const BodyMotion *m = &motions[places->body[i / 3]];
    const PetscInt    c = i % 3, next = (c + 1) % 3, last = (c + 2) % 3, of[2] = {i - c + next, i - c + last};
    const PetscReal   arm[2] = {PetscRealPart(x[of[0]] + (a ? a[of[0]] : 0.0)) - m->center[next],
        PetscRealPart(x[of[1]] + (a ? a[of[1]] : 0.0)) - m->center[last]};

    v[i] = m->t[c] + m->w[next] * arm[1] - m->w[last] * arm[0];
  }
  PetscCall(VecRestoreArrayWrite(moved, &v));
  if (u) PetscCall(VecRestoreArrayRead(u, &a));
  PetscCall(VecRestoreArrayRead(places->x, &x));
  PetscFunctionReturn(0);
}

/* Collective. Computes the bounding boxes of the bodies at the displacement u (NULL: undeformed): boxes[6 b + 0..2] is
   the lower corner of body b, boxes[6 b + 3..5] the upper one [length] */
PetscErrorCode MeshGetBodyBoxes(DM dm, Vec u, PetscInt nbodies, PetscReal boxes[])
{
  VertexPlaces       places;
  const PetscScalar *x;
  PetscInt           n;

  PetscFunctionBegin;
  PetscCall(VertexPlacesCreate(dm, &places));
  if (u) PetscCall(VecAXPY(places.x, 1.0, u));
  PetscCall(VecGetLocalSize(places.x, &n));
  PetscCall(VecGetArrayRead(places.x, &x));
  for (PetscInt k = 0; k < 6 * nbodies; ++k) boxes[k] = PETSC_MIN_REAL;
  for (PetscInt i = 0; i < n; ++i) { /* lower corners are negative at first, so that one maximum reduces both */
    PetscReal *box = &boxes[6 * places.body[i / 3] + i % 3];

    box[0] = PetscMax(box[0], -PetscRealPart(x[i]));
    box[3] = PetscMax(box[3], PetscRealPart(x[i]));
  }
  PetscCall(VecRestoreArrayRead(places.x, &x));
  PetscCall(VertexPlacesDestroy(&places));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, boxes, (PetscMPIInt)(6 * nbodies), MPIU_REAL, MPIU_MAX,
    PetscObjectComm((PetscObject)dm)));
  for (PetscInt k = 0; k < 3 * nbodies; ++k) boxes[6 * (k / 3) + k % 3] *= -1.0;
  PetscFunctionReturn(0);
}

/* Sets one component of a global vector at the nodes of a face to a number */
PetscErrorCode MeshFaceSet(DM dm, const char face[], PetscInt component, PetscReal value, Vec v)
{
  IS dofs;

  PetscFunctionBegin;
  PetscCall(MeshGetFaceDofs(dm, face, component, &dofs));
  PetscCall(VecISSet(v, dofs, value));
  PetscCall(ISDestroy(&dofs));
  PetscFunctionReturn(0);
}

/* Collective. Computes the magnitude of a vector at each node of all bodies, and returns the sum and the largest of the
   magnitudes. largest may be NULL. */
PetscErrorCode NodalMagnitudesMeasure(Vec v, PetscReal *sum, PetscReal *largest)
{
  const MPI_Comm     comm = PetscObjectComm((PetscObject)v);
  const PetscScalar *a;
  PetscReal          most = 0.0;
  PetscInt           n;

  PetscFunctionBegin;
  *sum = 0.0;
  PetscCall(VecGetLocalSize(v, &n));
  PetscCall(VecGetArrayRead(v, &a));
  for (PetscInt i = 0; i < n; i += 3) {
    const PetscReal size = PetscSqrtReal(
      PetscSqr(PetscRealPart(a[i])) + PetscSqr(PetscRealPart(a[i + 1])) + PetscSqr(PetscRealPart(a[i + 2])));

    *sum += size;
    most = PetscMax(most, size);
  }
  PetscCall(VecRestoreArrayRead(v, &a));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sum, 1, MPIU_REAL, MPIU_SUM, comm));
  if (largest) PetscCallMPI(MPI_Allreduce(&most, largest, 1, MPIU_REAL, MPIU_MAX, comm));
  PetscFunctionReturn(0);
}

/* Collective. Computes the sum of a vector over the nodes of each body, 3 numbers per body */
PetscErrorCode VertexPlacesSum(const VertexPlaces *places, Vec v, PetscInt nbodies, PetscReal sums[])
{
  const PetscScalar *a;
  PetscInt           n;

  PetscFunctionBegin;
  PetscCall(PetscArrayzero(sums, 3 * nbodies));
  PetscCall(VecGetLocalSize(v, &n));
  PetscCall(VecGetArrayRead(v, &a));
  for (PetscInt i = 0; i < n; ++i) sums[3 * places->body[i / 3] + i % 3] += PetscRealPart(a[i]);
  PetscCall(VecRestoreArrayRead(v, &a));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sums, (PetscMPIInt)(3 * nbodies), MPIU_REAL, MPIU_SUM,
    PetscObjectComm((PetscObject)v)));
  PetscFunctionReturn(0);
}

/* Collective. Computes four numbers per body: the resultant of the nodal forces `force`, and the sum of the magnitudes
   of the nodal forces `all` [force] */
PetscErrorCode VertexPlacesSumForces(const VertexPlaces *places, Vec force, Vec all, PetscInt nbodies, PetscReal sums[])
{
  const PetscScalar *f, *a;
  PetscInt           n;

  PetscFunctionBegin;
  PetscCall(PetscArrayzero(sums, 4 * nbodies));
  PetscCall(VecGetLocalSize(force, &n));
  PetscCall(VecGetArrayRead(force, &f));
  PetscCall(VecGetArrayRead(all, &a));
  for (PetscInt i = 0; i < n; i += 3) {
    PetscReal *body = &sums[4 * places->body[i / 3]], square = 0.0;

    for (PetscInt d = 0; d < 3; ++d) {
      body[d] += PetscRealPart(f[i + d]);
      square += PetscSqr(PetscRealPart(a[i + d]));
    }
    body[3] += PetscSqrtReal(square);
  }
  PetscCall(VecRestoreArrayRead(all, &a));
  PetscCall(VecRestoreArrayRead(force, &f));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sums, (PetscMPIInt)(4 * nbodies), MPIU_REAL, MPIU_SUM,
    PetscObjectComm((PetscObject)force)));
  PetscFunctionReturn(0);
}

/* Collective. Computes the largest magnitude of an entry of a vector at the nodes of each body */
PetscErrorCode VertexPlacesLargest(const VertexPlaces *places, Vec v, PetscInt nbodies, PetscReal largest[])
{
  const PetscScalar *a;
  PetscInt           n;

  PetscFunctionBegin;
  PetscCall(PetscArrayzero(largest, nbodies));
  PetscCall(VecGetLocalSize(v, &n));
  PetscCall(VecGetArrayRead(v, &a));
  for (PetscInt i = 0; i < n; ++i)
    largest[places->body[i / 3]] = PetscMax(largest[places->body[i / 3]], PetscAbsScalar(a[i]));
  PetscCall(VecRestoreArrayRead(v, &a));
  PetscCallMPI(
    MPI_Allreduce(MPI_IN_PLACE, largest, (PetscMPIInt)nbodies, MPIU_REAL, MPIU_MAX, PetscObjectComm((PetscObject)v)));
  PetscFunctionReturn(0);
}

PetscErrorCode VertexPlacesDestroy(VertexPlaces *places)
{
  PetscFunctionBegin;
  PetscCall(VecDestroy(&places->x));
  PetscCall(PetscFree(places->body));
  PetscFunctionReturn(0);
}
