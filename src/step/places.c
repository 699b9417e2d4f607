/* Where the vertices that this rank owns are, undeformed, and in which body. */
#include "stepimpl.h"

/* Of every vertex that this rank owns; it has a cell of each */
static PetscErrorCode VertexPlacesFindBodies(DM dm, PetscSection global, PetscInt rstart, PetscInt body[])
{
  DMLabel  label;
  PetscInt cstart, cend;

  PetscFunctionBegin;
  PetscCall(DMGetLabel(dm, MESH_BODY_LABEL, &label));
  PetscCall(DMPlexGetHeightStratum(dm, 0, &cstart, &cend));
  for (PetscInt c = cstart; c < cend; ++c) {
    PetscInt b, vertices[8];

    PetscCall(DMLabelGetValue(label, c, &b));
    PetscCall(MeshGetCellVertices(dm, c, vertices));
    for (PetscInt i = 0; i < 8; ++i) {
      PetscInt offset;

      PetscCall(PetscSectionGetOffset(global, vertices[i], &offset));
      if (offset >= 0) body[(offset - rstart) / 3] = b;
    }
  }
  PetscFunctionReturn(0);
}

PetscErrorCode VertexPlacesCreate(DM dm, VertexPlaces *places)
{
  PetscSection global;
  PetscScalar *x;
  PetscInt     n, rstart, vstart, vend;

  PetscFunctionBegin;
  PetscCall(DMCreateGlobalVector(dm, &places->x));
  PetscCall(VecGetLocalSize(places->x, &n));
  PetscCall(VecGetOwnershipRange(places->x, &rstart, NULL));
  PetscCall(PetscCalloc1(n / 3, &places->body));
  PetscCall(DMGetGlobalSection(dm, &global));
  PetscCall(DMPlexGetDepthStratum(dm, 0, &vstart, &vend));
  PetscCall(VecGetArray(places->x, &x));
  for (PetscInt v = vstart; v < vend; ++v) {
    PetscInt  offset;
    PetscReal place[1][3];

    PetscCall(PetscSectionGetOffset(global, v, &offset));
    if (offset < 0) continue;
    PetscCall(MeshGetVertexCoordinates(dm, 1, &v, place));
    for (PetscInt c = 0; c < 3; ++c) x[offset - rstart + c] = place[0][c];
  }
  PetscCall(VecRestoreArray(places->x, &x));
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
