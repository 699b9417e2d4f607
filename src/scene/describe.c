/* Describes before the solve what a scene will simulate. */
#include "sceneimpl.h"
#include "src/mesh/query/queryimpl.h"
#include <petscbt.h>
#include <petscviewer.h>
#include <string.h>

/* Counts of a body's mesh on all ranks. */
typedef struct {
  PetscInt ncells, ntetrahedra, nnodes;
} BodyMesh;

/*
   Adds a cell to the counts of its body. A node is counted by the rank that owns it; bodies have no common nodes. met:
   nodes that have already been added.
*/
static PetscErrorCode BodyMeshAddCell(DM dm, PetscInt cell, PetscBT met, BodyMesh *mesh)
{
  PetscInt     n, nodes[MESH_MAX_NODES], first, offset;
  PetscSection global;

  PetscFunctionBegin;
  PetscCall(DMPlexGetChart(dm, &first, NULL));
  PetscCall(DMGetGlobalSection(dm, &global));
  PetscCall(MeshGetCellNodes(dm, cell, &n, nodes));
  mesh->ncells++;
  if (MeshIsTetrahedron(n)) mesh->ntetrahedra++;
  for (PetscInt a = 0; a < n; ++a) {
    if (PetscBTLookupSet(met, nodes[a] - first)) continue;
    PetscCall(PetscSectionGetOffset(global, nodes[a], &offset));
    if (offset >= 0) mesh->nnodes++;
  }
  PetscFunctionReturn(0);
}

static PetscErrorCode BodyMeshMeasureAll(DM dm, PetscInt nbodies, BodyMesh meshes[])
{
  PetscInt start, end, first, last, body;
  PetscBT  met;

  PetscFunctionBegin;
  PetscCall(PetscArrayzero(meshes, nbodies));
  PetscCall(DMPlexGetHeightStratum(dm, 0, &start, &end));
  PetscCall(DMPlexGetChart(dm, &first, &last));
  PetscCall(PetscBTCreate(last - first, &met));
  for (PetscInt c = start; c < end; ++c) {
    PetscCall(DMGetLabelValue(dm, MESH_BODY_LABEL, c, &body));
    PetscCall(BodyMeshAddCell(dm, c, met, &meshes[body]));
  }
  PetscCall(PetscBTDestroy(&met));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, meshes, (PetscMPIInt)(3 * nbodies), MPIU_INT, MPI_SUM,
    PetscObjectComm((PetscObject)dm)));
  PetscFunctionReturn(0);
}

/* Collective. Computes the boxes of the bodies; coordinates that are 0 up to rounding errors are 0 */
static PetscErrorCode DescribeGetBoxes(DM dm, PetscInt nbodies, PetscReal boxes[])
{
  PetscFunctionBegin;
  PetscCall(MeshGetBodyBoxes(dm, NULL, nbodies, boxes));
  for (PetscInt i = 0; i < 3 * nbodies; ++i) {
    PetscReal *box = &boxes[6 * (i / 3) + i % 3], tiny = MODEL_ROUNDING * (box[3] - box[0]);

    if (PetscAbsReal(box[0]) < tiny) box[0] = 0.0;
    if (PetscAbsReal(box[3]) < tiny) box[3] = 0.0;
  }
  PetscFunctionReturn(0);
}

/* Order and element of a body. reason: why the element was chosen; NULL if the scene names it. */
typedef struct {
  PetscInt    order;
  ElementType element;
  const char *reason;
} BodyChoice;

static PetscErrorCode DescribeFindChoices(Scene scene, DM dm, BodyChoice choices[])
{
  PetscInt    *nnodes;
  ElementType *elements;
  const char **reasons;

  PetscFunctionBegin;
  PetscCall(PetscMalloc3(scene->nbodies, &nnodes, scene->nbodies, &elements, scene->nbodies, &reasons));
  PetscCall(MeshGetBodyNodes(dm, scene->nbodies, nnodes));
  PetscCall(SceneChooseElements(scene, dm, elements, reasons));
  for (PetscInt b = 0; b < scene->nbodies; ++b)
    choices[b] = (BodyChoice){MeshOrder(nnodes[b]), elements[b], reasons[b]};
  PetscCall(PetscFree3(nnodes, elements, reasons));
  PetscFunctionReturn(0);
}

/* Prints a rigid surface. The mesh has one cell for it, whose place has no meaning. */
static PetscErrorCode DescribeSurface(const SceneBody *body, PetscViewer viewer)
{
  const PetscReal *point = body->own + SURFACE_POINT, *axis = body->own + SURFACE_AXIS;
  const char      *turned = body->shape == SHAPE_RIGID_PLANE ? "normal" : "axis";

  PetscFunctionBegin;
  PetscCall(PetscViewerASCIIPrintf(viewer, "  %s: %s", body->name, BodyShapes[body->shape]));
  if (body->shape != SHAPE_RIGID_STL) {
    PetscCall(
      PetscViewerASCIIPrintf(viewer, " at (%.6g, %.6g, %.6g)", (double)point[0], (double)point[1], (double)point[2]));
    if (body->shape != SHAPE_RIGID_SPHERE)
      PetscCall(PetscViewerASCIIPrintf(viewer, ", %s (%.6g, %.6g, %.6g)", turned, (double)axis[0], (double)axis[1],
        (double)axis[2]));
    if (body->own[SURFACE_RADIUS] > 0.0)
      PetscCall(PetscViewerASCIIPrintf(viewer, ", radius %.6g", (double)body->own[SURFACE_RADIUS]));
  }
  PetscCall(PetscViewerASCIIPrintf(viewer, "\n    rigid\n"));
  PetscCall(SceneDescribeVelocity(body, viewer));
  PetscFunctionReturn(0);
}

static PetscErrorCode DescribeBodies(Scene scene, DM dm, const BodyChoice choices[], PetscViewer viewer)
{
  BodyMesh  *meshes;
  PetscReal *boxes;
  PetscInt   ncells = 0, nnodes = 0, order = 1;

  PetscFunctionBegin;
  PetscCall(PetscMalloc2(scene->nbodies, &meshes, 6 * scene->nbodies, &boxes));
  PetscCall(BodyMeshMeasureAll(dm, scene->nbodies, meshes));
  PetscCall(DescribeGetBoxes(dm, scene->nbodies, boxes));
  PetscCall(PetscViewerASCIIPrintf(viewer, "Bodies, refined %" PetscInt_FMT " times\n", scene->refine));
  for (PetscInt b = 0; b < scene->nbodies; ++b) {
    const SceneBody *body = &scene->bodies[b];
    const BodyMesh  *mesh = &meshes[b];
    const PetscReal *box  = &boxes[6 * b];

    ncells += mesh->ncells;
    nnodes += mesh->nnodes;
    if (SceneBodyIsSurface(body)) {
      PetscCall(DescribeSurface(body, viewer));
      continue;
    }
    PetscCall(PetscViewerASCIIPrintf(viewer, "  %s: %s, x %.6g to %.6g, y %.6g to %.6g, z %.6g to %.6g\n", body->name,
      BodyShapes[body->shape], (double)box[0], (double)box[3], (double)box[1], (double)box[4], (double)box[2],
      (double)box[5]));
    if (body->material.type == MATERIAL_RIGID) PetscCall(PetscViewerASCIIPrintf(viewer, "    rigid\n"));
    else {
      PetscCall(PetscViewerASCIIPrintf(viewer, "    material %s%s%s%s", body->material_name ? body->material_name : "",
        body->material_name ? " (" : "", MaterialTypes[body->material.type], body->material_name ? ")" : ""));
      PetscCall(SceneDescribeConstants(&body->material, viewer));
      PetscCall(PetscViewerASCIIPrintf(viewer, "; element %s", ElementTypes[choices[b].element]));
      if (choices[b].reason) PetscCall(PetscViewerASCIIPrintf(viewer, " (chosen: %s)", choices[b].reason));
      PetscCall(PetscViewerASCIIPrintf(viewer, "\n"));
    }
    PetscCall(
      PetscViewerASCIIPrintf(viewer, "    %" PetscInt_FMT " %s%s, %" PetscInt_FMT " %s, %" PetscInt_FMT " unknowns\n",
        mesh->ncells, mesh->ntetrahedra ? "tetrahedra" : "cells", choices[b].order > 1 ? " of order 2" : "",
        mesh->nnodes, choices[b].order > 1 ? "nodes" : "vertices", 3 * mesh->nnodes));
    PetscCall(SceneDescribeVelocity(body, viewer));
    order = PetscMax(order, choices[b].order);
  }
  PetscCall(PetscViewerASCIIPrintf(viewer,
    "  total: %" PetscInt_FMT " cells, %" PetscInt_FMT " %s, %" PetscInt_FMT " unknowns\n", ncells, nnodes,
    order > 1 ? "nodes" : "vertices", 3 * nnodes));
  PetscCall(PetscFree2(meshes, boxes));
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

/*
   Prints a line per body with its faces, sorted by name. Faces are the labels of the DM whose names contain a dot.
   Those of rigid surfaces are left out, since a formula stands for their facets.
*/
static PetscErrorCode DescribeFaces(Scene scene, DM dm, PetscViewer viewer)
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
    if (strchr(faces[n], '.') && !SceneBodyIsSurface(SceneFaceBody(scene, faces[n]))) ++n;
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

/* Prints the mean facet areas of both sides of a pair. The nonmortar side should have the smaller facets. */
static PetscErrorCode DescribeSides(Scene scene, DM dm, const SceneContactPair *pair, PetscViewer viewer)
{
  const PetscBool formula = SceneBodyIsSurface(SceneFaceBody(scene, pair->mortar));
  PetscInt        n[2];
  PetscReal       area[2], size[2];

  PetscFunctionBegin;
  PetscCall(DescribeMeasureFace(dm, pair->mortar, &n[0], &area[0]));
  PetscCall(DescribeMeasureFace(dm, pair->nonmortar, &n[1], &area[1]));
  for (PetscInt i = 0; i < 2; ++i) size[i] = n[i] ? area[i] / n[i] : 0.0;
  if (formula)
    PetscCall(PetscViewerASCIIPrintf(viewer, "    facets of mean area %.3g on the nonmortar side\n", (double)size[1]));
  else
    PetscCall(PetscViewerASCIIPrintf(viewer,
      "    facets of mean area %.3g on the mortar side, %.3g on the nonmortar side%s\n", (double)size[0],
      (double)size[1], size[1] > 4.0 * size[0] ? ": the nonmortar side is the coarser one; swap the two sides" : ""));
  PetscFunctionReturn(0);
}

/* Prints friction, stiffness and interference of a pair */
static PetscErrorCode DescribeLaw(Scene scene, const SceneContactPair *pair, PetscViewer viewer)
{
  const PetscBool sticks = (PetscBool)(pair->friction == PETSC_INFINITY);

  PetscFunctionBegin;
  if (!SceneContactPairHasFriction(pair)) PetscCall(PetscViewerASCIIPrintf(viewer, "    without friction"));
  else if (sticks && pair->shear_limit == PETSC_INFINITY) PetscCall(PetscViewerASCIIPrintf(viewer, "    sticks"));
  else if (!sticks) PetscCall(PetscViewerASCIIPrintf(viewer, "    friction %.6g", (double)pair->friction));
  else PetscCall(PetscViewerASCIIPrintf(viewer, "    friction"));
  if (pair->friction_ramp >= 0)
    PetscCall(PetscViewerASCIIPrintf(viewer, " times %s", scene->ramps[pair->friction_ramp].name));
  if (SceneContactPairHasFriction(pair) && pair->shear_limit < PETSC_INFINITY)
    PetscCall(PetscViewerASCIIPrintf(viewer, ", at most %.6g per area", (double)pair->shear_limit));
  if (pair->stiffness > 0.0)
    PetscCall(PetscViewerASCIIPrintf(viewer, "; soft: pressure %.6g times depth", (double)pair->stiffness));
  if (pair->exponential[1] > 0.0)
    PetscCall(PetscViewerASCIIPrintf(viewer, "; soft: pressure %.6g at no gap, a hundredth at the gap %.6g",
      (double)pair->exponential[1], (double)pair->exponential[0]));
  if (pair->interference == PETSC_INFINITY) PetscCall(PetscViewerASCIIPrintf(viewer, "; interference: any"));
  else if (pair->interference > 0.0)
    PetscCall(PetscViewerASCIIPrintf(viewer, "; interference of at most %.6g", (double)pair->interference));
  if (pair->interference_ramp >= 0)
    PetscCall(PetscViewerASCIIPrintf(viewer, ", follows %s", scene->ramps[pair->interference_ramp].name));
  PetscCall(PetscViewerASCIIPrintf(viewer, "%s\n", pair->smooth ? "" : "; facets are not smoothed"));
  PetscFunctionReturn(0);
}

static PetscErrorCode DescribePairs(Scene scene, DM dm, PetscViewer viewer)
{
  PetscFunctionBegin;
  if (scene->npairs) PetscCall(PetscViewerASCIIPrintf(viewer, "Contact pairs\n"));
  for (PetscInt p = 0; p < scene->npairs; ++p) {
    const SceneContactPair *here = &scene->pairs[p];

    if (here->self)
      PetscCall(PetscViewerASCIIPrintf(viewer, "  %s: %s in contact with itself, gap %s, ", here->name, here->self,
        GapTypes[here->gap]));
    else
      PetscCall(PetscViewerASCIIPrintf(viewer, "  %s: mortar %s, nonmortar %s, gap %s, ", here->name, here->mortar,
        here->nonmortar, GapTypes[here->gap]));
    if (here->distance > 0) PetscCall(PetscViewerASCIIPrintf(viewer, "facets within %.6g\n", (double)here->distance));
    else
      PetscCall(
        PetscViewerASCIIPrintf(viewer, "facets are paired within a distance that depends on the size of the faces\n"));
    if (here->why && !here->self) {
      PetscCall(PetscViewerASCIIPrintf(viewer, "    found by a rule; %s is nonmortar because %s; ", here->nonmortar,
        here->why));
      if (here->apart < PETSC_MAX_REAL)
        PetscCall(PetscViewerASCIIPrintf(viewer, "smallest distance at the start %.4g\n", (double)here->apart));
      else PetscCall(PetscViewerASCIIPrintf(viewer, "the faces meet during the run\n"));
    }
    PetscCall(DescribeLaw(scene, here, viewer));
    if (!here->self) PetscCall(DescribeSides(scene, dm, here, viewer));
  }
  PetscFunctionReturn(0);
}

static PetscErrorCode DescribeTies(Scene scene, PetscViewer viewer)
{
  PetscFunctionBegin;
  if (scene->nties) PetscCall(PetscViewerASCIIPrintf(viewer, "Ties\n"));
  for (PetscInt t = 0; t < scene->nties; ++t)
    PetscCall(PetscViewerASCIIPrintf(viewer, "  %s: nonmortar %s to mortar %s\n", scene->ties[t].name,
      scene->ties[t].nonmortar, scene->ties[t].mortar));
  if (scene->ncyclic) PetscCall(PetscViewerASCIIPrintf(viewer, "Cyclic symmetry\n"));
  for (PetscInt k = 0; k < scene->ncyclic; ++k)
    PetscCall(PetscViewerASCIIPrintf(viewer, "  %s: from %s to %s\n", scene->cyclic[k].name, scene->cyclic[k].from,
      scene->cyclic[k].to));
  PetscFunctionReturn(0);
}

/* Prints where cells are refined locally, and the number of hanging vertices between coarser and finer cells. */
static PetscErrorCode DescribeRefinements(Scene scene, DM dm, PetscViewer viewer)
{
  PetscInt nhanging;

  PetscFunctionBegin;
  if (!scene->nrefinements) PetscFunctionReturn(0);
  PetscCall(PetscViewerASCIIPrintf(viewer, "Refinements\n"));
  for (PetscInt r = 0; r < scene->nrefinements; ++r) {
    const SceneRefinement *here = &scene->refinements[r];
    const char            *both = here->face[1] ? " and " : "";

    PetscCall(PetscViewerASCIIPrintf(viewer, "  %s: %" PetscInt_FMT " levels within %.6g of ", here->name, here->levels,
      (double)here->distance));
    if (here->face[0])
      PetscCall(PetscViewerASCIIPrintf(viewer, "%s%s%s\n", here->face[0], both, here->face[1] ? here->face[1] : ""));
    else
      PetscCall(PetscViewerASCIIPrintf(viewer, "a box, x %.6g to %.6g, y %.6g to %.6g, z %.6g to %.6g\n",
        (double)here->lower[0], (double)here->upper[0], (double)here->lower[1], (double)here->upper[1],
        (double)here->lower[2], (double)here->upper[2]));
  }
  PetscCall(MeshCountHanging(dm, &nhanging));
  PetscCall(PetscViewerASCIIPrintf(viewer, "  hanging vertices between coarser and finer cells: %" PetscInt_FMT "\n",
    nhanging));
  PetscFunctionReturn(0);
}

/* Prints the probes. A point outside of all bodies is an error. */
static PetscErrorCode DescribeProbes(Scene scene, DM dm, PetscViewer viewer)
{
  PetscInt   n;
  MeshPlace *places;
  PetscReal(*points)[3];

  PetscFunctionBegin;
  if (!scene->nprobes) PetscFunctionReturn(0);
  PetscCall(MeshLocateProbes(dm, scene, &n, &points, &places));
  PetscCall(PetscFree(points));
  PetscCall(PetscFree(places));
  PetscCall(PetscViewerASCIIPrintf(viewer, "Probes\n"));
  for (PetscInt p = 0; p < scene->nprobes; ++p) {
    const SceneProbe *here = &scene->probes[p];

    PetscCall(PetscViewerASCIIPrintf(viewer, "  %s: (%.6g, %.6g, %.6g)", here->name, (double)here->from[0],
      (double)here->from[1], (double)here->from[2]));
    if (here->line)
      PetscCall(PetscViewerASCIIPrintf(viewer, " to (%.6g, %.6g, %.6g), %" PetscInt_FMT " points", (double)here->to[0],
        (double)here->to[1], (double)here->to[2], here->n));
    PetscCall(
      PetscViewerASCIIPrintf(viewer, ", in %s\n", here->body < 0 ? "any body" : scene->bodies[here->body].name));
  }
  PetscFunctionReturn(0);
}

#define DESCRIBE_ROWS 20 /* largest number of rows of the load program */

/* Returns whether a load step's factors are not on the straight lines through those of the steps before and after */
static PetscBool DescribeIsCorner(Scene scene, PetscInt step)
{
  if (step == 0 || step + 1 == scene->nsteps) return PETSC_TRUE;
  for (PetscInt r = 0; r < scene->nramps; ++r) {
    const PetscReal *factor = scene->ramps[r].factor + step;
    const PetscReal  size   = PetscAbsReal(factor[-1]) + PetscAbsReal(factor[0]) + PetscAbsReal(factor[1]);

    if (PetscAbsReal(factor[-1] - 2.0 * factor[0] + factor[1]) > 1e-9 * size) return PETSC_TRUE;
  }
  return PETSC_FALSE;
}

/*
   Prints the load program with a row per load step and a column per ramp. Rows between which all factors are linear are
   left out. If more than DESCRIBE_ROWS remain, rows are picked at equal intervals.
*/
static PetscErrorCode DescribeSteps(Scene scene, PetscViewer viewer)
{
  PetscInt ncorners = 0, every;

  PetscFunctionBegin;
  for (PetscInt i = 0; i < scene->nsteps; ++i) ncorners += DescribeIsCorner(scene, i);
  every = ncorners > DESCRIBE_ROWS ? (scene->nsteps + DESCRIBE_ROWS - 1) / DESCRIBE_ROWS : 0;
  PetscCall(
    PetscViewerASCIIPrintf(viewer, "Load steps: %" PetscInt_FMT "; factors at their ends%s\n  step", scene->nsteps,
      every                      ? "; some of them"
      : ncorners < scene->nsteps ? "; linear between the rows"
                                 : ""));
  for (PetscInt r = 0; r < scene->nramps; ++r) PetscCall(PetscViewerASCIIPrintf(viewer, " %12s", scene->ramps[r].name));
  PetscCall(PetscViewerASCIIPrintf(viewer, "\n"));
  for (PetscInt i = 0; i < scene->nsteps; ++i) {
    if (every ? (i + 1) % every && i + 1 < scene->nsteps : !DescribeIsCorner(scene, i)) continue;
    PetscCall(PetscViewerASCIIPrintf(viewer, "  %4" PetscInt_FMT, i + 1));
    for (PetscInt r = 0; r < scene->nramps; ++r)
      PetscCall(PetscViewerASCIIPrintf(viewer, " %12.6g", (double)scene->ramps[r].factor[i]));
    PetscCall(PetscViewerASCIIPrintf(viewer, "\n"));
  }
  PetscFunctionReturn(0);
}

/* Prints the time integration of a dynamic analysis */
static PetscErrorCode DescribeDynamics(Scene scene, PetscViewer viewer)
{
  const SceneDynamics *d = &scene->dynamics;

  PetscFunctionBegin;
  if (!SceneIsDynamic(scene)) PetscFunctionReturn(0);
  PetscCall(
    PetscViewerASCIIPrintf(viewer, "Dynamics\n  scheme %s, %" PetscInt_FMT " time steps of %.6g, end time %.6g, ",
      DynamicsSchemes[d->scheme], scene->nsteps, (double)d->time_step, (double)d->end_time));
  if (d->tolerance > 0.0) PetscCall(PetscViewerASCIIPrintf(viewer, "controlled to %.3g, ", (double)d->tolerance));
  if (d->scheme == SCHEME_GENERALIZED_ALPHA)
    PetscCall(PetscViewerASCIIPrintf(viewer, "spectral radius %.6g, ", (double)d->spectral_radius));
  PetscCall(PetscViewerASCIIPrintf(viewer, "mass %s", MassTypes[d->mass]));
  if (d->damping_mass > 0.0 || d->damping_stiffness > 0.0)
    PetscCall(PetscViewerASCIIPrintf(viewer, ", damping %.6g of the mass and %.6g of the stiffness",
      (double)d->damping_mass, (double)d->damping_stiffness));
  PetscCall(PetscViewerASCIIPrintf(viewer, "\n"));
  PetscFunctionReturn(0);
}

typedef enum { USES_FINITE_STRAIN, USES_BBAR, USES_INCOMPATIBLE, USES_ORDER2 } BodyEffect;

static PetscBool DescribeUses(BodyEffect effect, const SceneBody *body, const BodyChoice *choice)
{
  if (effect == USES_FINITE_STRAIN) return MaterialIsFinite(&body->material);
  if (effect == USES_ORDER2) return (PetscBool)(choice->order > 1);
  return (PetscBool)(choice->element == (effect == USES_BBAR ? ELEMENT_BBAR : ELEMENT_INCOMPATIBLE));
}

/* Names of the effects that are off, for one line */
typedef struct {
  char text[512];
} DescribeOff;

static PetscErrorCode DescribeAddOff(DescribeOff *off, const char effect[])
{
  PetscFunctionBegin;
  if (off->text[0]) PetscCall(PetscStrlcat(off->text, ", ", sizeof(off->text)));
  PetscCall(PetscStrlcat(off->text, effect, sizeof(off->text)));
  PetscFunctionReturn(0);
}

/* Prints the bodies that use an effect, for example: on, in slab, block. If there are none, the effect is off. */
static PetscErrorCode DescribeBodyEffect(Scene scene, PetscViewer viewer, const char name[], BodyEffect effect,
  const BodyChoice choices[], DescribeOff *off)
{
  PetscBool on = PETSC_FALSE;

  PetscFunctionBegin;
  for (PetscInt b = 0; b < scene->nbodies; ++b) {
    if (!DescribeUses(effect, &scene->bodies[b], &choices[b])) continue;
    if (!on) PetscCall(PetscViewerASCIIPrintf(viewer, "  %-24son, in ", name));
    PetscCall(PetscViewerASCIIPrintf(viewer, "%s%s", on ? ", " : "", scene->bodies[b].name));
    on = PETSC_TRUE;
  }
  if (on) PetscCall(PetscViewerASCIIPrintf(viewer, "\n"));
  else PetscCall(DescribeAddOff(off, name));
  PetscFunctionReturn(0);
}

static PetscErrorCode DescribeListEffect(PetscViewer viewer, const char effect[], PetscInt n, DescribeOff *off)
{
  PetscFunctionBegin;
  if (n) PetscCall(PetscViewerASCIIPrintf(viewer, "  %-24son, %" PetscInt_FMT "\n", effect, n));
  else PetscCall(DescribeAddOff(off, effect));
  PetscFunctionReturn(0);
}

static PetscErrorCode DescribeEffects(Scene scene, const BodyChoice choices[], PetscViewer viewer)
{
  PetscInt    rubbing = 0;
  PetscBool   finite  = PETSC_FALSE;
  DescribeOff off     = {""};

  PetscFunctionBegin;
  for (PetscInt b = 0; b < scene->nbodies; ++b)
    if (MaterialIsFinite(&scene->bodies[b].material)) finite = PETSC_TRUE;
  PetscCall(PetscViewerASCIIPrintf(viewer, "Effects\n"));
  PetscCall(DescribeListEffect(viewer, "contact pairs", scene->npairs, &off));
  if (scene->npairs)
    PetscCall(PetscViewerASCIIPrintf(viewer, "  %-24sat most %" PetscInt_FMT " per load step\n", "contact updates",
      scene->contact_updates));
  for (PetscInt p = 0; p < scene->npairs; ++p) rubbing += SceneContactPairHasFriction(&scene->pairs[p]);
  PetscCall(DescribeListEffect(viewer, "friction", rubbing, &off));
  if (scene->npairs)
    PetscCall(
      PetscViewerASCIIPrintf(viewer, "  %-24son, if the constraints are stiff enough to need it\n", "AMG filter"));
  PetscCall(DescribeBodyEffect(scene, viewer, "finite strain", USES_FINITE_STRAIN, choices, &off));
  if (finite)
    PetscCall(PetscViewerASCIIPrintf(viewer, "  %-24s%s\n", "model of a load step", StepModels[scene->model]));
  PetscCall(DescribeBodyEffect(scene, viewer, "mean dilatation", USES_BBAR, choices, &off));
  PetscCall(DescribeBodyEffect(scene, viewer, "incompatible modes", USES_INCOMPATIBLE, choices, &off));
  PetscCall(DescribeBodyEffect(scene, viewer, "order 2", USES_ORDER2, choices, &off));
  PetscCall(DescribeListEffect(viewer, "pressures", scene->npressures, &off));
  PetscCall(DescribeListEffect(viewer, "body forces", scene->nforces, &off));
  if (scene->displacement_bounds)
    PetscCall(PetscViewerASCIIPrintf(viewer, "  %-24son, from load step %" PetscInt_FMT "\n", "displacement bounds",
      scene->displacement_bounds));
  else PetscCall(DescribeAddOff(&off, "displacement bounds"));
  PetscCall(PetscViewerASCIIPrintf(viewer, "  off: %s\n", off.text));
  for (PetscInt o = 0; o < scene->noptions; ++o)
    PetscCall(PetscViewerASCIIPrintf(viewer, "%s  -%s %s%s\n", o ? "" : "Solver options\n", scene->options[o].name,
      scene->options[o].value, scene->options[o].set ? "" : " (the command line or an options file takes precedence)"));
  PetscFunctionReturn(0);
}

/*@C
   SceneDescribe - Prints what a scene will simulate: bodies and their meshes, faces, loads, contact pairs, steps and
   ramps, and the effects that are on and off

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
  BodyChoice *choices;

  PetscFunctionBegin;
  PetscCall(PetscViewerASCIIPrintf(viewer, "Scene %s\n", scene->name));
  if (scene->units) PetscCall(PetscViewerASCIIPrintf(viewer, "Units %s\n", scene->units));
  PetscCall(PetscMalloc1(scene->nbodies, &choices));
  PetscCall(DescribeFindChoices(scene, dm, choices));
  PetscCall(DescribeBodies(scene, dm, choices, viewer));
  PetscCall(DescribeFaces(scene, dm, viewer));
  PetscCall(SceneDescribeLoads(scene, viewer));
  PetscCall(DescribePairs(scene, dm, viewer));
  PetscCall(DescribeTies(scene, viewer));
  PetscCall(DescribeRefinements(scene, dm, viewer));
  PetscCall(DescribeProbes(scene, dm, viewer));
  PetscCall(DescribeSteps(scene, viewer));
  PetscCall(DescribeDynamics(scene, viewer));
  PetscCall(DescribeEffects(scene, choices, viewer));
  PetscCall(PetscFree(choices));
  PetscFunctionReturn(0);
}
