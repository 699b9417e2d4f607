/* Finds the facets on the boundary of the bodies */
#include "queryimpl.h"
#include <petscsf.h>

/*
   Collective. Determines which facets of this rank are on the boundary of a body. boundary: one value per facet, in the
   order of the facets' points. A boundary facet has one cell on this rank, no copy on another rank, and no finer or
   coarser neighbour cell.
*/
PetscErrorCode MeshMarkBoundary(DM dm, PetscBool boundary[])
{
  PetscSF         sf;
  PetscInt        nroots, nleaves, start, end;
  PetscBool       has;
  const PetscInt *leaves, *degree;

  PetscFunctionBegin;
  PetscCall(DMPlexGetHeightStratum(dm, 1, &start, &end));
  PetscCall(DMHasLabel(dm, MESH_INNER_LABEL, &has));
  for (PetscInt f = start; f < end; ++f) {
    PetscInt ncells, inner = -1;

    PetscCall(DMPlexGetSupportSize(dm, f, &ncells));
    if (has && ncells == 1) PetscCall(DMGetLabelValue(dm, MESH_INNER_LABEL, f, &inner));
    boundary[f - start] = (PetscBool)(ncells == 1 && inner < 0);
  }
  PetscCall(DMGetPointSF(dm, &sf));
  PetscCall(PetscSFGetGraph(sf, &nroots, &nleaves, &leaves, NULL));
  if (nroots < 0) PetscFunctionReturn(0);
  PetscCall(PetscSFComputeDegreeBegin(sf, &degree));
  PetscCall(PetscSFComputeDegreeEnd(sf, &degree));
  for (PetscInt f = start; f < end; ++f) {
    if (degree[f]) boundary[f - start] = PETSC_FALSE;
  }
  for (PetscInt i = 0; i < nleaves; ++i) {
    const PetscInt f = leaves ? leaves[i] : i;

    if (f >= start && f < end) boundary[f - start] = PETSC_FALSE;
  }
  PetscFunctionReturn(0);
}
