/* Describes before the solve what a scene will simulate. */
#include "sceneimpl.h"
#include <mesh.h>
#include <petscbt.h>
#include <petscviewer.h>
#include <string.h>

/* Counts and bounds of a body's mesh on all ranks. */
typedef struct {
  PetscInt  ncells, ntetrahedra, nnodes;
  PetscReal lower[3], upper[3]; /* smallest and largest coordinates of the nodes [length] */
} BodyMesh;

/*
   Adds a cell to the counts and bounds of its body. A node is counted by the rank that owns it; bodies have no common
   nodes. met: nodes that have already been added.
*/
static PetscErrorCode BodyMeshAddCell(DM dm, const PetscScalar x[], PetscInt cell, PetscBT met, BodyMesh *mesh)
{
  PetscInt     n, nodes[MESH_MAX_NODES], first, offset;
  PetscSection global, section;

  PetscFunctionBegin;
  PetscCall(DMPlexGetChart(dm, &first, NULL));
  PetscCall(DMGetGlobalSection(dm, &global));
  PetscCall(DMGetLocalSection(dm, &section));
  PetscCall(MeshGetCellNodes(dm, cell, &n, nodes));
  mesh->ncells++;
  if (MeshIsTetrahedron(n)) mesh->ntetrahedra++;
  for (PetscInt a = 0; a < n; ++a) {
    if (PetscBTLookupSet(met, nodes[a] - first)) continue;
    PetscCall(PetscSectionGetOffset(global, nodes[a], &offset));
    if (offset >= 0) mesh->nnodes++;
    PetscCall(PetscSectionGetOffset(section, nodes[a], &offset));
    for (PetscInt i = 0; i < 3; ++i) {
      mesh->lower[i] = PetscMin(mesh->lower[i], PetscRealPart(x[offset + i]));
      mesh->upper[i] = PetscMax(mesh->upper[i], PetscRealPart(x[offset + i]));
    }
  }
  PetscFunctionReturn(0);
}

/* Sets bounds that are 0 up to rounding errors to 0, so that they are printed as 0. */
static void BodyMeshCleanBounds(BodyMesh *mesh)
{
  for (PetscInt i = 0; i < 3; ++i) {
    const PetscReal tiny = MODEL_ROUNDING * (mesh->upper[i] - mesh->lower[i]);

    if (PetscAbsReal(mesh->lower[i]) < tiny) mesh->lower[i] = 0;
    if (PetscAbsReal(mesh->upper[i]) < tiny) mesh->upper[i] = 0;
  }
}

static PetscErrorCode BodyMeshMeasureAll(DM dm, PetscInt nbodies, BodyMesh meshes[])
{
  MPI_Comm           comm = PetscObjectComm((PetscObject)dm);
  PetscInt           start, end, first, last, body;
  PetscBT            met;
  Vec                coordinates;
  const PetscScalar *x;

  PetscFunctionBegin;
  for (PetscInt b = 0; b < nbodies; ++b)
    meshes[b] = (BodyMesh){0, 0, 0, {PETSC_MAX_REAL, PETSC_MAX_REAL, PETSC_MAX_REAL},
      {PETSC_MIN_REAL, PETSC_MIN_REAL, PETSC_MIN_REAL}};
  PetscCall(DMPlexGetHeightStratum(dm, 0, &start, &end));
  PetscCall(DMPlexGetChart(dm, &first, &last));
  PetscCall(PetscBTCreate(last - first, &met));
  PetscCall(MeshGetNodeCoordinates(dm, &coordinates));
  PetscCall(VecGetArrayRead(coordinates, &x));
  for (PetscInt c = start; c < end; ++c) {
    PetscCall(DMGetLabelValue(dm, MESH_BODY_LABEL, c, &body));
    PetscCall(BodyMeshAddCell(dm, x, c, met, &meshes[body]));
  }
  PetscCall(VecRestoreArrayRead(coordinates, &x));
  PetscCall(PetscBTDestroy(&met));
  for (PetscInt b = 0; b < nbodies; ++b) {
    PetscInt counts[3] = {meshes[b].ncells, meshes[b].nnodes, meshes[b].ntetrahedra};

    PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, counts, 3, MPIU_INT, MPI_SUM, comm));
    meshes[b].ncells      = counts[0];
    meshes[b].nnodes      = counts[1];
    meshes[b].ntetrahedra = counts[2];
    PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, meshes[b].lower, 3, MPIU_REAL, MPIU_MIN, comm));
    PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, meshes[b].upper, 3, MPIU_REAL, MPIU_MAX, comm));
    BodyMeshCleanBounds(&meshes[b]);
  }
  PetscFunctionReturn(0);
}

/* Prints the mesh of each body, and the element with the reason for which it was chosen */
static PetscErrorCode DescribeBodies(Scene scene, DM dm, PetscViewer viewer)
{
  BodyMesh    *meshes;
  PetscInt     ncells = 0, nnodes = 0, most = 1, *n;
  ElementType *elements;
  const char **reasons;

  PetscFunctionBegin;
  PetscCall(
    PetscMalloc4(scene->nbodies, &meshes, scene->nbodies, &n, scene->nbodies, &elements, scene->nbodies, &reasons));
  PetscCall(MeshGetBodyNodes(dm, scene->nbodies, n));
  PetscCall(SceneChooseElements(scene, dm, elements, reasons));
  PetscCall(BodyMeshMeasureAll(dm, scene->nbodies, meshes));
  PetscCall(PetscViewerASCIIPrintf(viewer, "Bodies, refined %" PetscInt_FMT " times\n", scene->refine));
  for (PetscInt b = 0; b < scene->nbodies; ++b) {
    const BodyMesh *mesh  = &meshes[b];
    const PetscInt  order = MeshOrder(n[b]);

    PetscCall(PetscViewerASCIIPrintf(viewer, "  %s: x %.6g to %.6g, y %.6g to %.6g, z %.6g to %.6g\n",
      scene->bodies[b].name, (double)mesh->lower[0], (double)mesh->upper[0], (double)mesh->lower[1],
      (double)mesh->upper[1], (double)mesh->lower[2], (double)mesh->upper[2]));
    PetscCall(
      PetscViewerASCIIPrintf(viewer, "    %" PetscInt_FMT " %s%s, %" PetscInt_FMT " %s, %" PetscInt_FMT " unknowns",
        mesh->ncells, mesh->ntetrahedra ? "tetrahedra" : "cells", order > 1 ? " of order 2" : "", mesh->nnodes,
        order > 1 ? "nodes" : "vertices", 3 * mesh->nnodes));
    if (scene->bodies[b].material.type != MATERIAL_RIGID)
      PetscCall(PetscViewerASCIIPrintf(viewer, "; element %s", ElementTypes[elements[b]]));
    if (scene->bodies[b].material.type != MATERIAL_RIGID && reasons[b])
      PetscCall(PetscViewerASCIIPrintf(viewer, " (chosen: %s)", reasons[b]));
    PetscCall(PetscViewerASCIIPrintf(viewer, "\n"));
    most = PetscMax(most, order);
    ncells += mesh->ncells;
    nnodes += mesh->nnodes;
  }
  PetscCall(PetscViewerASCIIPrintf(viewer,
    "  total: %" PetscInt_FMT " cells, %" PetscInt_FMT " %s, %" PetscInt_FMT " unknowns\n", ncells, nnodes,
    most > 1 ? "nodes" : "vertices", 3 * nnodes));
  PetscCall(PetscFree4(meshes, n, elements, reasons));
  PetscFunctionReturn(0);
}

/* Collective. Gets the number of a face's facets, and their area, on all ranks */
static PetscErrorCode DescribeMeasureFace(DM dm, const char face[], PetscInt *nfacets, PetscReal *area)
{
  PetscReal sums[4];
  IS        facets;

  PetscFunctionBegin;
  PetscCall(MeshGetFacets(dm, face, &facets));
  PetscCall(ISGetLocalSize(facets, nfacets));
  PetscCall(MeshSumFacetAreas(dm, facets, sums));
  PetscCall(ISDestroy(&facets));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, nfacets, 1, MPIU_INT, MPI_SUM, PetscObjectComm((PetscObject)dm)));
  *area = 0.5 * sums[3];
  PetscFunctionReturn(0);
}

/* Prints a line per body with its faces, sorted by name. Faces are the labels of the DM whose names contain a dot. */
static PetscErrorCode DescribeFaces(DM dm, PetscViewer viewer)
{
  PetscInt     nlabels, n   = 0, nfacets, *order;
  const char **faces, *body = "";
  PetscReal    area;
  size_t       length = 0;

  PetscFunctionBegin;
  PetscCall(DMGetNumLabels(dm, &nlabels));
  PetscCall(PetscMalloc2(nlabels, &faces, nlabels, &order));
  for (PetscInt l = 0; l < nlabels; ++l) {
    PetscCall(DMGetLabelName(dm, l, &faces[n]));
    order[n] = n;
    if (strchr(faces[n], '.')) ++n;
  }
  PetscCall(PetscSortStrWithPermutation(n, faces, order));
  PetscCall(PetscViewerASCIIPrintf(viewer, "Faces, with area and number of facets"));
  for (PetscInt i = 0; i < n; ++i) {
    const char *face = faces[order[i]], *own = strchr(face, '.');

    PetscCall(DescribeMeasureFace(dm, face, &nfacets, &area));
    if (!nfacets) continue;
    if (length != (size_t)(own - face) || strncmp(body, face, length))
      PetscCall(PetscViewerASCIIPrintf(viewer, "\n  %.*s:", (int)(own - face), face));
    else PetscCall(PetscViewerASCIIPrintf(viewer, ","));
    body   = face;
    length = (size_t)(own - face);
    PetscCall(PetscViewerASCIIPrintf(viewer, " %s %.5g (%" PetscInt_FMT ")", own + 1, (double)area, nfacets));
  }
  PetscCall(PetscViewerASCIIPrintf(viewer, "\n"));
  PetscCall(PetscFree2(faces, order));
  PetscFunctionReturn(0);
}

/* Prints what is known of a pair beside its keys: why and where a rule found it, and the mean facet areas of its sides.
   The nonmortar side should have the smaller facets. */
static PetscErrorCode DescribePair(DM dm, const SceneContactPair *pair, PetscViewer viewer)
{
  PetscInt  n[2];
  PetscReal area[2], size[2];

  PetscFunctionBegin;
  PetscCall(PetscViewerASCIIPrintf(viewer, "  %s:", pair->name));
  if (pair->why) {
    PetscCall(
      PetscViewerASCIIPrintf(viewer, " found by a rule; %s is nonmortar because %s;", pair->nonmortar, pair->why));
    if (pair->apart < PETSC_MAX_REAL)
      PetscCall(PetscViewerASCIIPrintf(viewer, " smallest distance at the start %.4g;", (double)pair->apart));
    else PetscCall(PetscViewerASCIIPrintf(viewer, " the faces meet during the run;"));
  }
  PetscCall(DescribeMeasureFace(dm, pair->mortar, &n[0], &area[0]));
  PetscCall(DescribeMeasureFace(dm, pair->nonmortar, &n[1], &area[1]));
  for (PetscInt i = 0; i < 2; ++i) size[i] = n[i] ? area[i] / n[i] : 0.0;
  PetscCall(PetscViewerASCIIPrintf(viewer,
    " facets of mean area %.3g on the mortar side, %.3g on the nonmortar side%s\n", (double)size[0], (double)size[1],
    size[1] > 4.0 * size[0] ? ": the nonmortar side is the coarser one; swap the two sides" : ""));
  PetscFunctionReturn(0);
}

static PetscErrorCode DescribePairs(Scene scene, DM dm, PetscViewer viewer)
{
  PetscInt npairs = 0;

  PetscFunctionBegin;
  for (PetscInt p = 0; p < scene->npairs; ++p) {
    if (scene->pairs[p].self) continue;
    if (!npairs++) PetscCall(PetscViewerASCIIPrintf(viewer, "Contact pairs\n"));
    PetscCall(DescribePair(dm, &scene->pairs[p], viewer));
  }
  PetscFunctionReturn(0);
}

/* Finds the probes; a point outside of all bodies is an error */
static PetscErrorCode DescribeFindProbes(Scene scene, DM dm)
{
  PetscInt   n;
  MeshPlace *places;
  PetscReal(*points)[3];

  PetscFunctionBegin;
  if (!scene->nprobes) PetscFunctionReturn(0);
  PetscCall(MeshLocateProbes(dm, scene, &n, &points, &places));
  PetscCall(PetscFree(points));
  PetscCall(PetscFree(places));
  PetscFunctionReturn(0);
}

/*@C
   SceneDescribe - Prints what a scene will simulate: the scene with the values of all keys, the bodies' meshes, their
   faces, and the sides of contact pairs

   Collective on the viewer

   Input Parameters:
+  scene  - the scene
.  dm     - its mesh, by `MeshCreate()`
-  viewer - an ASCII viewer

   Level: beginner

.seealso: `SceneLoad()`, `SceneView()`
@*/
PetscErrorCode SceneDescribe(Scene scene, DM dm, PetscViewer viewer)
{
  PetscInt nhanging;

  PetscFunctionBegin;
  PetscCall(SceneView(scene, viewer));
  PetscCall(PetscViewerASCIIPrintf(viewer, "\n"));
  PetscCall(DescribeBodies(scene, dm, viewer));
  PetscCall(MeshCountHanging(dm, &nhanging));
  if (nhanging)
    PetscCall(PetscViewerASCIIPrintf(viewer, "  hanging vertices between coarser and finer cells: %" PetscInt_FMT "\n",
      nhanging));
  PetscCall(DescribeFaces(dm, viewer));
  PetscCall(DescribePairs(scene, dm, viewer));
  PetscCall(DescribeFindProbes(scene, dm));
  PetscFunctionReturn(0);
}
