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

PetscErrorCode VertexPlacesDestroy(VertexPlaces *places)
{
  PetscFunctionBegin;
  PetscCall(VecDestroy(&places->x));
  PetscCall(PetscFree(places->body));
  PetscFunctionReturn(0);
}
