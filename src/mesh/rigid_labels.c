/* Rigid bodies: a label for each, like that of a face, with all points that have unknowns and the boundary facets */
#include "meshimpl.h"

/* Labels the points of a cell; boundary: of the facets, from number fstart on */
static PetscErrorCode RigidLabelCell(DM dm, PetscInt cell, PetscInt fstart, PetscInt fend, const PetscBool boundary[],
  DMLabel whole)
{
  PetscInt n, *closure = NULL;

  PetscFunctionBegin;
  PetscCall(DMPlexGetTransitiveClosure(dm, cell, PETSC_TRUE, &n, &closure));
  for (PetscInt i = 0; i < n; ++i) {
    const PetscInt point = closure[2 * i];

    if (point < fstart || point >= fend || boundary[point - fstart]) PetscCall(DMLabelSetValue(whole, point, 1));
  }
  PetscCall(DMPlexRestoreTransitiveClosure(dm, cell, PETSC_TRUE, &n, &closure));
  PetscFunctionReturn(0);
}

/* Call after the last refinement */
PetscErrorCode MeshLabelRigid(DM dm, PetscInt nbodies, const SceneBody bodies[])
{
  DMLabel    body, whole;
  PetscInt   cstart, cend, fstart, fend;
  PetscBool *boundary, any = PETSC_FALSE;
  char       name[256];

  PetscFunctionBegin;
  for (PetscInt b = 0; b < nbodies; ++b) any = (PetscBool)(any || bodies[b].material.type == MATERIAL_RIGID);
  if (!any) PetscFunctionReturn(0);
  PetscCall(DMGetLabel(dm, MESH_BODY_LABEL, &body));
  PetscCall(DMPlexGetHeightStratum(dm, 0, &cstart, &cend));
  PetscCall(DMPlexGetHeightStratum(dm, 1, &fstart, &fend));
  PetscCall(PetscMalloc1(fend - fstart, &boundary));
  PetscCall(MeshMarkBoundary(dm, boundary));
  for (PetscInt b = 0; b < nbodies; ++b) {
    if (bodies[b].material.type != MATERIAL_RIGID) continue;
    PetscCall(PetscSNPrintf(name, sizeof(name), "%s" SCENE_WHOLE_BODY, bodies[b].name));
    PetscCall(DMCreateLabel(dm, name));
    PetscCall(DMGetLabel(dm, name, &whole));
    for (PetscInt c = cstart; c < cend; ++c) {
      PetscInt of;

      PetscCall(DMLabelGetValue(body, c, &of));
      if (of == b) PetscCall(RigidLabelCell(dm, c, fstart, fend, boundary, whole));
    }
  }
  PetscCall(PetscFree(boundary));
  PetscFunctionReturn(0);
}
