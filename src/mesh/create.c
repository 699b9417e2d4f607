/* MeshCreate: level 0 of all bodies on rank 0, distribution, refinement, layout of the unknowns */
#include "mesh_private.h"
#include "shape.h"

/* Level 0 is refined before it is distributed while it has fewer cells a rank: coarser partitions are badly balanced */
#define MESH_MIN_CELLS_PER_RANK 32

static PetscClassId  MESH_CLASSID;
static PetscLogEvent MESH_Create;

/* Tensor order (x fastest) of DMPlex's hexahedron vertices; DMPlex turns the bottom quadrilateral outward */
const PetscInt MeshHexTensorOrder[8] = {0, 3, 1, 2, 4, 5, 7, 6};

static PetscErrorCode MeshInitializePackage(void)
{
  static PetscBool initialized = PETSC_FALSE;

  PetscFunctionBegin;
  if (initialized) PetscFunctionReturn(0);
  initialized = PETSC_TRUE;
  PetscCall(PetscClassIdRegister("Mesh", &MESH_CLASSID));
  PetscCall(PetscLogEventRegister("MeshCreate", MESH_CLASSID, &MESH_Create));
  PetscCall(MeshRegisterPartitioner());
  PetscFunctionReturn(0);
}

/* Checks all bodies on all ranks; total number of cells and vertices at level 0 */
static PetscErrorCode MeshCheckBodies(MPI_Comm comm, PetscInt nbodies, const SceneBody bodies[], PetscInt64 *ncells, PetscInt64 *nvertices)
{
  PetscFunctionBegin;
  PetscCheck(nbodies > 0, comm, PETSC_ERR_ARG_OUTOFRANGE, "A mesh needs at least one body, but %" PetscInt_FMT " are given", nbodies);
  *ncells    = 0;
  *nvertices = 0;
  for (PetscInt b = 0; b < nbodies; ++b) {
    const Shape *shape;
    PetscInt64   nc, nv;

    for (PetscInt c = 0; c < b; ++c) {
      PetscBool same;

      PetscCall(PetscStrcmp(bodies[b].name, bodies[c].name, &same));
      PetscCheck(!same, comm, PETSC_ERR_ARG_WRONG, "Two bodies have the same name \"%s\"", bodies[b].name);
    }
    PetscCall(ShapeGet(comm, &bodies[b], &shape));
    PetscCall(shape->size(comm, &bodies[b], &nc, &nv));
    *ncells += nc;
    *nvertices += nv;
  }
  PetscCheck(8 * (*nvertices) < PETSC_MAX_INT, comm, PETSC_ERR_ARG_OUTOFRANGE, "The %" PetscInt64_FMT " level 0 vertices are too many for this PETSc's integers", *nvertices);
  PetscFunctionReturn(0);
}

static PetscErrorCode MeshFaceLabelName(const char body[], const char face[], size_t length, char name[])
{
  PetscFunctionBegin;
  PetscCall(PetscSNPrintf(name, length, "%s.%s", body, face));
  PetscFunctionReturn(0);
}

/* Sets the labels of one body's cells and facets; only on the rank that has them */
static PetscErrorCode MeshLabelBody(DM dm, const SceneBody *body, PetscInt number, const ShapeGrid *grid, PetscInt firstcell, PetscInt firstvertex)
{
  const Shape *shape;

  PetscFunctionBegin;
  for (PetscInt c = 0; c < grid->ncells; ++c) PetscCall(DMSetLabelValue(dm, MESH_BODY_LABEL, firstcell + c, number));
  PetscCall(ShapeGet(PETSC_COMM_SELF, body, &shape));
  for (PetscInt q = 0; q < grid->nfacets; ++q) {
    char            name[PETSC_MAX_PATH_LEN];
    PetscInt        corners[4], njoin;
    const PetscInt *join;

    for (PetscInt a = 0; a < 4; ++a) corners[a] = firstvertex + grid->facets[4 * q + a];
    PetscCall(DMPlexGetFullJoin(dm, 4, corners, &njoin, &join));
    PetscCheck(njoin == 1, PETSC_COMM_SELF, PETSC_ERR_PLIB, "Facet %" PetscInt_FMT " of body \"%s\" is not a facet of its mesh", q, body->name);
    PetscCall(MeshFaceLabelName(body->name, shape->faces[grid->facetface[q]], sizeof(name), name));
    PetscCall(DMSetLabelValue(dm, name, join[0], 1));
    PetscCall(DMPlexRestoreJoin(dm, 4, corners, &njoin, &join));
  }
  PetscFunctionReturn(0);
}

/* Adds the closure of its facets to every face's label, so that after distribution and refinement
   a copy of a vertex on a rank without any of the face's facets knows the face too */
static PetscErrorCode MeshCompleteFaceLabels(DM dm, PetscInt nbodies, const SceneBody bodies[])
{
  PetscFunctionBegin;
  for (PetscInt b = 0; b < nbodies; ++b) {
    const Shape *shape;

    PetscCall(ShapeGet(PetscObjectComm((PetscObject)dm), &bodies[b], &shape));
    for (PetscInt f = 0; shape->faces[f]; ++f) {
      char    name[PETSC_MAX_PATH_LEN];
      DMLabel label;

      PetscCall(MeshFaceLabelName(bodies[b].name, shape->faces[f], sizeof(name), name));
      PetscCall(DMGetLabel(dm, name, &label));
      PetscCall(DMPlexLabelComplete(dm, label));
    }
  }
  PetscFunctionReturn(0);
}

static PetscErrorCode MeshCreateLabels(DM dm, PetscInt nbodies, const SceneBody bodies[])
{
  PetscFunctionBegin;
  PetscCall(DMCreateLabel(dm, MESH_BODY_LABEL));
  for (PetscInt b = 0; b < nbodies; ++b) {
    const Shape *shape;

    PetscCall(ShapeGet(PetscObjectComm((PetscObject)dm), &bodies[b], &shape));
    for (PetscInt f = 0; shape->faces[f]; ++f) {
      char name[PETSC_MAX_PATH_LEN];

      PetscCall(MeshFaceLabelName(bodies[b].name, shape->faces[f], sizeof(name), name));
      PetscCall(DMCreateLabel(dm, name));
    }
  }
  PetscFunctionReturn(0);
}

/* All bodies at level 0, on rank 0; the other ranks' parts are empty */
static PetscErrorCode MeshCreateLevel0(MPI_Comm comm, PetscInt nbodies, const SceneBody bodies[], PetscInt ncells, PetscInt nvertices, DM *dm)
{
  PetscMPIInt rank;
  PetscInt    nlocal, cell = 0, vertex = 0, *cells;
  PetscReal  *coordinates;
  ShapeGrid  *grids;

  PetscFunctionBegin;
  PetscCallMPI(MPI_Comm_rank(comm, &rank));
  nlocal = rank ? 0 : nbodies;
  if (rank) ncells = nvertices = 0;
  PetscCall(PetscCalloc1(nlocal, &grids));
  PetscCall(PetscMalloc2(8 * ncells, &cells, 3 * nvertices, &coordinates));
  for (PetscInt b = 0; b < nlocal; ++b) {
    const Shape *shape;

    PetscCall(ShapeGet(PETSC_COMM_SELF, &bodies[b], &shape));
    PetscCall(shape->create(&bodies[b], &grids[b]));
    for (PetscInt c = 0; c < grids[b].ncells; ++c) {
      for (PetscInt a = 0; a < 8; ++a) cells[8 * (cell + c) + MeshHexTensorOrder[a]] = vertex + grids[b].cells[8 * c + a];
    }
    PetscCall(PetscArraycpy(coordinates + 3 * vertex, grids[b].coordinates, 3 * grids[b].nvertices));
    cell += grids[b].ncells;
    vertex += grids[b].nvertices;
  }
  PetscCall(DMPlexCreateFromCellListPetsc(comm, 3, ncells, nvertices, 8, PETSC_TRUE, cells, 3, coordinates, dm));
  PetscCall(PetscFree2(cells, coordinates));
  PetscCall(MeshCreateLabels(*dm, nbodies, bodies));
  cell   = 0;
  vertex = ncells; /* DMPlex numbers the cells first, then the vertices */
  for (PetscInt b = 0; b < nlocal; ++b) {
    PetscCall(MeshLabelBody(*dm, &bodies[b], b, &grids[b], cell, vertex));
    cell += grids[b].ncells;
    vertex += grids[b].nvertices;
    PetscCall(ShapeGridDestroy(&grids[b]));
  }
  PetscCall(PetscFree(grids));
  PetscCall(MeshCompleteFaceLabels(*dm, nbodies, bodies));
  PetscFunctionReturn(0);
}

static PetscErrorCode MeshRefine(DM *dm, PetscInt levels)
{
  PetscFunctionBegin;
  for (PetscInt l = 0; l < levels; ++l) {
    DM fine;

    PetscCall(DMPlexSetRefinementUniform(*dm, PETSC_TRUE));
    PetscCall(DMRefine(*dm, PetscObjectComm((PetscObject)*dm), &fine));
    PetscCall(DMDestroy(dm));
    *dm = fine;
  }
  PetscFunctionReturn(0);
}

static PetscErrorCode MeshDistribute(DM *dm)
{
  PetscPartitioner partitioner;
  DM               distributed;

  PetscFunctionBegin;
  PetscCall(DMPlexGetPartitioner(*dm, &partitioner));
  PetscCall(PetscPartitionerSetType(partitioner, "metis"));
  PetscCall(PetscPartitionerSetFromOptions(partitioner));
  PetscCall(DMPlexDistribute(*dm, 0, NULL, &distributed));
  if (distributed) {
    PetscCall(DMDestroy(dm));
    *dm = distributed;
  }
  PetscFunctionReturn(0);
}

/* Three displacement components a vertex, none constrained */
static PetscErrorCode MeshSetSection(DM dm)
{
  PetscSection section;
  PetscInt     pstart, pend, vstart, vend;

  PetscFunctionBegin;
  PetscCall(DMPlexGetChart(dm, &pstart, &pend));
  PetscCall(DMPlexGetDepthStratum(dm, 0, &vstart, &vend));
  PetscCall(PetscSectionCreate(PetscObjectComm((PetscObject)dm), &section));
  PetscCall(PetscSectionSetNumFields(section, 1));
  PetscCall(PetscSectionSetFieldName(section, 0, "displacement"));
  PetscCall(PetscSectionSetFieldComponents(section, 0, 3));
  PetscCall(PetscSectionSetChart(section, pstart, pend));
  for (PetscInt v = vstart; v < vend; ++v) {
    PetscCall(PetscSectionSetDof(section, v, 3));
    PetscCall(PetscSectionSetFieldDof(section, v, 0, 3));
  }
  PetscCall(PetscSectionSetUp(section));
  PetscCall(DMSetLocalSection(dm, section));
  PetscCall(PetscSectionDestroy(&section));
  PetscFunctionReturn(0);
}

/*@
  MeshCreate - Creates the hexahedral mesh of all bodies: generated, distributed, refined, with the displacements laid out

  Collective

  Input Parameters:
+ comm    - communicator
. nbodies - number of bodies, at least 1
. bodies  - the bodies, the same on all ranks; lengths as the scene gives them
- refine  - number of uniform refinements of level 0, at least 0

  Output Parameter:
. dm - the mesh, a `DMPLEX` with one component a body

  Options Database Keys:
+ -petscpartitioner_type <metis> - partitioner of the level 0 mesh
- -dm_view                       - views the mesh

  Level: beginner

  Notes:
  The label "body" holds each cell's body number, the label "<body>.<face>" the named face. The mesh is generated on rank 0
  and distributed as coarse as its balance allows; refinement is parallel.

  It is an error if there are more ranks than cells.

.seealso: `MeshGetFacets()`, `MeshGetFaceVertices()`, `MeshGetFaceDofs()`, `ElasticityCreate()`
@*/
PetscErrorCode MeshCreate(MPI_Comm comm, PetscInt nbodies, const SceneBody bodies[], PetscInt refine, DM *dm)
{
  PetscMPIInt size;
  PetscInt64  ncells, nvertices, finecells;
  PetscInt    before = 0;

  PetscFunctionBegin;
  PetscCall(MeshInitializePackage());
  PetscCall(PetscLogEventBegin(MESH_Create, 0, 0, 0, 0));
  PetscCall(MeshCheckBodies(comm, nbodies, bodies, &ncells, &nvertices));
  PetscCheck(refine >= 0, comm, PETSC_ERR_ARG_OUTOFRANGE, "The number of refinements must not be negative, but is %" PetscInt_FMT, refine);
  finecells = ncells;
  for (PetscInt l = 0; l < refine; ++l) {
    PetscCheck(finecells <= PETSC_MAX_INT / 8, comm, PETSC_ERR_ARG_OUTOFRANGE, "%" PetscInt_FMT " refinements of %" PetscInt64_FMT " level 0 cells are too many for this PETSc's integers", refine, ncells);
    finecells *= 8;
  }
  PetscCallMPI(MPI_Comm_size(comm, &size));
  PetscCheck(size <= finecells, comm, PETSC_ERR_ARG_OUTOFRANGE, "There are more ranks than cells: %d ranks, and the mesh has %" PetscInt64_FMT, size, finecells);

  PetscCall(MeshCreateLevel0(comm, nbodies, bodies, (PetscInt)ncells, (PetscInt)nvertices, dm));
  if (size > 1) {
    for (PetscInt64 n = ncells; before < refine && n < MESH_MIN_CELLS_PER_RANK * size; n *= 8) ++before;
    PetscCall(MeshRefine(dm, before));
    PetscCall(MeshDistribute(dm));
  }
  PetscCall(MeshRefine(dm, refine - before));
  PetscCall(MeshSetSection(*dm));
  PetscCall(PetscObjectSetName((PetscObject)*dm, "mesh"));
  PetscCall(DMViewFromOptions(*dm, NULL, "-dm_view"));
  PetscCall(PetscLogEventEnd(MESH_Create, 0, 0, 0, 0));
  PetscFunctionReturn(0);
}
