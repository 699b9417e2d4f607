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

/* Collective. Computes the mean of the positions x of the nodes of each body. centre: 3 numbers per body [length] */
PetscErrorCode VertexPlacesGetCentres(const VertexPlaces *places, Vec x, PetscInt nbodies, PetscReal centre[])
{
  const PetscScalar *a;
  PetscReal         *sum; /* per body: the sum of the positions, and the number of nodes */
  PetscInt           n;

  PetscFunctionBegin;
  PetscCall(PetscCalloc1(4 * nbodies, &sum));
  PetscCall(VecGetLocalSize(x, &n));
  PetscCall(VecGetArrayRead(x, &a));
  for (PetscInt i = 0; i < n; ++i) sum[4 * places->body[i / 3] + i % 3] += PetscRealPart(a[i]);
  for (PetscInt i = 0; i < n; i += 3) sum[4 * places->body[i / 3] + 3] += 1.0;
  PetscCall(VecRestoreArrayRead(x, &a));
  PetscCallMPI(
    MPI_Allreduce(MPI_IN_PLACE, sum, (PetscMPIInt)(4 * nbodies), MPIU_REAL, MPIU_SUM, PetscObjectComm((PetscObject)x)));
  for (PetscInt k = 0; k < 3 * nbodies; ++k) centre[k] = sum[4 * (k / 3) + k % 3] / sum[4 * (k / 3) + 3];
  PetscCall(PetscFree(sum));
  PetscFunctionReturn(0);
}

PetscErrorCode VertexPlacesDestroy(VertexPlaces *places)
{
  PetscFunctionBegin;
  PetscCall(VecDestroy(&places->x));
  PetscCall(PetscFree(places->body));
  PetscFunctionReturn(0);
}
