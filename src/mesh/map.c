/* From the shapes' parameters to space */
#include "meshimpl.h"
#include <petscbt.h>

PetscErrorCode MeshMapVertices(DM dm, PetscInt nbodies, const SceneBody bodies[], PetscBool curved)
{
  Vec          coordinates;
  PetscSection section;
  PetscScalar *x;
  PetscBT      done;
  PetscInt     cstart, cend, vstart, vend;

  PetscFunctionBegin;
  PetscCall(DMPlexGetHeightStratum(dm, 0, &cstart, &cend));
  PetscCall(DMPlexGetDepthStratum(dm, 0, &vstart, &vend));
  PetscCall(DMGetCoordinatesLocal(dm, &coordinates));
  PetscCall(DMGetCoordinateSection(dm, &section));
  PetscCall(PetscBTCreate(vend - vstart, &done));
  PetscCall(VecGetArray(coordinates, &x));
  for (PetscInt c = cstart; c < cend; ++c) {
    PetscInt     b, vertices[8];
    const Shape *shape;

    PetscCall(DMGetLabelValue(dm, MESH_BODY_LABEL, c, &b));
    PetscCheck(b >= 0 && b < nbodies, PETSC_COMM_SELF, PETSC_ERR_PLIB, "Cell %" PetscInt_FMT " belongs to no body", c);
    PetscCall(ShapeGet(PETSC_COMM_SELF, &bodies[b], &shape));
    if (!shape || !shape->map || bodies[b].curved != curved) continue;
    PetscCall(MeshGetCellVertices(dm, c, vertices));
    for (PetscInt a = 0; a < 8; ++a) {
      PetscInt  offset;
      PetscReal p[3], place[3];

      if (PetscBTLookupSet(done, vertices[a] - vstart)) continue;
      PetscCall(PetscSectionGetOffset(section, vertices[a], &offset));
      for (PetscInt d = 0; d < 3; ++d) p[d] = PetscRealPart(x[offset + d]);
      PetscCall(shape->map(&bodies[b], p, place));
      for (PetscInt d = 0; d < 3; ++d) x[offset + d] = place[d];
    }
  }
  PetscCall(VecRestoreArray(coordinates, &x));
  PetscCall(PetscBTDestroy(&done));
  /* The global coordinates, if they were made, are those from before */
  PetscCall(DMSetCoordinatesLocal(dm, coordinates));
  PetscFunctionReturn(0);
}
