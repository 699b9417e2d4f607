/* Maps the parameters of the shapes' vertices to space */
#include "meshimpl.h"
#include <petscbt.h>

PetscErrorCode MeshMapNodes(DM dm, PetscInt nbodies, const SceneBody bodies[], PetscBool curved)
{
  MeshPlaces   places;
  PetscScalar *x;
  PetscBT      done;
  PetscInt     cstart, cend, pstart, pend;

  PetscFunctionBegin;
  PetscCall(DMPlexGetHeightStratum(dm, 0, &cstart, &cend));
  PetscCall(DMPlexGetChart(dm, &pstart, &pend));
  PetscCall(MeshGetPlaces(dm, curved, &places));
  PetscCall(PetscBTCreate(pend - pstart, &done));
  PetscCall(VecGetArray(places.x, &x));
  for (PetscInt c = cstart; c < cend; ++c) {
    PetscInt     b, n, nodes[MESH_MAX_NODES];
    const Shape *shape;

    PetscCall(DMGetLabelValue(dm, MESH_BODY_LABEL, c, &b));
    PetscCheck(b >= 0 && b < nbodies, PETSC_COMM_SELF, PETSC_ERR_PLIB, "Cell %" PetscInt_FMT " belongs to no body", c);
    PetscCall(ShapeGet(PETSC_COMM_SELF, &bodies[b], &shape));
    if (!shape || !shape->map || bodies[b].curved != curved) continue;
    PetscCall(MeshGetCellPoints(dm, places.section, c, &n, nodes));
    for (PetscInt a = 0; a < n; ++a) {
      PetscInt  offset;
      PetscReal p[3], place[3];

      if (PetscBTLookupSet(done, nodes[a] - pstart)) continue;
      PetscCall(PetscSectionGetOffset(places.section, nodes[a], &offset));
      for (PetscInt d = 0; d < 3; ++d) p[d] = PetscRealPart(x[offset + d]);
      PetscCall(shape->map(&bodies[b], p, place));
      for (PetscInt d = 0; d < 3; ++d) x[offset + d] = place[d];
    }
  }
  PetscCall(VecRestoreArray(places.x, &x));
  PetscCall(PetscBTDestroy(&done));
  /* The global coordinates, if they exist, are not updated here. */
  if (!curved) PetscCall(DMSetCoordinatesLocal(dm, places.x));
  PetscFunctionReturn(0);
}
