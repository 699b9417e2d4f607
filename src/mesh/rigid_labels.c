/* Creates labels of whole bodies, used like those of faces. The label of a rigid body contains all points that carry
   unknowns, and the boundary facets. The label of a body in contact with itself contains the boundary facets and their
   points. */
#include "meshimpl.h"

/* Adds the points of a cell to the label `whole`. Facets, which are numbered from fstart to fend, are added only if
   they are on the boundary. */
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

/* Collective. Labels the boundary facets of a body that is not rigid, and their points, also points whose facets are on
   other ranks */
static PetscErrorCode RigidLabelBoundary(DM dm, DMLabel body, PetscInt number, const PetscBool boundary[],
  DMLabel whole)
{
  PetscInt cstart, cend, fstart, npoints, *mark;
  PetscSF  sf;

  PetscFunctionBegin;
  PetscCall(DMPlexGetHeightStratum(dm, 0, &cstart, &cend));
  PetscCall(DMPlexGetHeightStratum(dm, 1, &fstart, NULL));
  PetscCall(DMPlexGetChart(dm, NULL, &npoints));
  PetscCall(PetscCalloc1(npoints, &mark));
  for (PetscInt c = cstart; c < cend; ++c) {
    const PetscInt *facets;
    PetscInt        of, nfacets;

    PetscCall(DMLabelGetValue(body, c, &of));
    PetscCall(DMPlexGetConeSize(dm, c, &nfacets));
    PetscCall(DMPlexGetCone(dm, c, &facets));
    for (PetscInt f = 0; of == number && f < nfacets; ++f) {
      PetscInt n, *closure = NULL;

      if (!boundary[facets[f] - fstart]) continue;
      PetscCall(DMPlexGetTransitiveClosure(dm, facets[f], PETSC_TRUE, &n, &closure));
      for (PetscInt i = 0; i < n; ++i) mark[closure[2 * i]] = 1;
      PetscCall(DMPlexRestoreTransitiveClosure(dm, facets[f], PETSC_TRUE, &n, &closure));
    }
  }
  PetscCall(DMGetPointSF(dm, &sf));
  PetscCall(ValuesReduce(sf, MPIU_INT, MPI_MAX, mark));
  for (PetscInt p = 0; p < npoints; ++p) {
    if (mark[p]) PetscCall(DMLabelSetValue(whole, p, 1));
  }
  PetscCall(PetscFree(mark));
  PetscFunctionReturn(0);
}

/* Creates the labels. They must be created after the last refinement. */
PetscErrorCode MeshLabelRigid(DM dm, PetscInt nbodies, const SceneBody bodies[])
{
  DMLabel    body, whole;
  PetscInt   cstart, cend, fstart, fend;
  PetscBool *boundary, any = PETSC_FALSE;
  char       name[256];

  PetscFunctionBegin;
  for (PetscInt b = 0; b < nbodies; ++b)
    any = (PetscBool)(any || bodies[b].whole || bodies[b].material.type == MATERIAL_RIGID);
  if (!any) PetscFunctionReturn(0);
  PetscCall(DMGetLabel(dm, MESH_BODY_LABEL, &body));
  PetscCall(DMPlexGetHeightStratum(dm, 0, &cstart, &cend));
  PetscCall(DMPlexGetHeightStratum(dm, 1, &fstart, &fend));
  PetscCall(PetscMalloc1(fend - fstart, &boundary));
  PetscCall(MeshMarkBoundary(dm, boundary));
  for (PetscInt b = 0; b < nbodies; ++b) {
    if (!bodies[b].whole && bodies[b].material.type != MATERIAL_RIGID) continue;
    PetscCall(PetscSNPrintf(name, sizeof(name), "%s" SCENE_WHOLE_BODY, bodies[b].name));
    PetscCall(DMCreateLabel(dm, name));
    PetscCall(DMGetLabel(dm, name, &whole));
    if (bodies[b].whole) PetscCall(RigidLabelBoundary(dm, body, b, boundary, whole));
    for (PetscInt c = cstart; c < cend && !bodies[b].whole; ++c) {
      PetscInt of;

      PetscCall(DMLabelGetValue(body, c, &of));
      if (of == b) PetscCall(RigidLabelCell(dm, c, fstart, fend, boundary, whole));
    }
  }
  PetscCall(PetscFree(boundary));
  PetscFunctionReturn(0);
}
