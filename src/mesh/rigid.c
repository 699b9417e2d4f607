/* Rigid bodies: a label for each, as for a face, of all points that have unknowns and the facets of the boundary */
#include "meshimpl.h"
#include <petscsf.h>

static PetscErrorCode RigidLabelCell(DM dm, PetscInt cell, DMLabel whole)
{
  PetscInt n, fstart, fend, *closure = NULL;

  PetscFunctionBegin;
  PetscCall(DMPlexGetHeightStratum(dm, 1, &fstart, &fend));
  PetscCall(DMPlexGetTransitiveClosure(dm, cell, PETSC_TRUE, &n, &closure));
  for (PetscInt i = 0; i < n; ++i) {
    const PetscInt point  = closure[2 * i];
    PetscInt       ncells = 1;

    if (point >= fstart && point < fend) PetscCall(DMPlexGetSupportSize(dm, point, &ncells));
    if (ncells == 1) PetscCall(DMLabelSetValue(whole, point, 1));
  }
  PetscCall(DMPlexRestoreTransitiveClosure(dm, cell, PETSC_TRUE, &n, &closure));
  PetscFunctionReturn(0);
}

/* A facet that other ranks have a cell of is none of the boundary */
static PetscErrorCode RigidClearShared(DM dm, DMLabel whole)
{
  PetscSF         sf;
  const PetscInt *degree, *leaves;
  PetscInt        nroots, nleaves, fstart, fend;

  PetscFunctionBegin;
  PetscCall(DMPlexGetHeightStratum(dm, 1, &fstart, &fend));
  PetscCall(DMGetPointSF(dm, &sf));
  PetscCall(PetscSFGetGraph(sf, &nroots, &nleaves, &leaves, NULL));
  if (nroots < 0) PetscFunctionReturn(0);
  PetscCall(PetscSFComputeDegreeBegin(sf, &degree));
  PetscCall(PetscSFComputeDegreeEnd(sf, &degree));
  for (PetscInt f = fstart; f < fend; ++f) {
    if (degree[f]) PetscCall(DMLabelClearValue(whole, f, 1));
  }
  for (PetscInt i = 0; i < nleaves; ++i) {
    const PetscInt point = leaves ? leaves[i] : i;

    if (point >= fstart && point < fend) PetscCall(DMLabelClearValue(whole, point, 1));
  }
  PetscFunctionReturn(0);
}

/* After the last refinement */
PetscErrorCode MeshLabelRigid(DM dm, PetscInt nbodies, const SceneBody bodies[])
{
  DMLabel  body, whole;
  PetscInt cstart, cend;
  char     name[256];

  PetscFunctionBegin;
  PetscCall(DMGetLabel(dm, MESH_BODY_LABEL, &body));
  PetscCall(DMPlexGetHeightStratum(dm, 0, &cstart, &cend));
  for (PetscInt b = 0; b < nbodies; ++b) {
    if (bodies[b].material.type != MATERIAL_RIGID) continue;
    PetscCall(PetscSNPrintf(name, sizeof(name), "%s" SCENE_WHOLE_BODY, bodies[b].name));
    PetscCall(DMCreateLabel(dm, name));
    PetscCall(DMGetLabel(dm, name, &whole));
    for (PetscInt c = cstart; c < cend; ++c) {
      PetscInt of;

      PetscCall(DMLabelGetValue(body, c, &of));
      if (of == b) PetscCall(RigidLabelCell(dm, c, whole));
    }
    PetscCall(RigidClearShared(dm, whole));
  }
  PetscFunctionReturn(0);
}
