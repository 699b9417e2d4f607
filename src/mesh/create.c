/* MeshCreate: level 0 of all bodies on rank 0, distribution, refinement, layout of the unknowns */
#include "mesh_private.h"

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

/* One body at level 0: sizes and faces on all ranks, the grid on rank 0 */
typedef struct {
  PetscInt64 ncells, nvertices;
  PetscInt   nfaces;
  char     **faces;
  ShapeGrid  grid;
} MeshBody;

static PetscErrorCode MeshCheckNames(MPI_Comm comm, PetscInt nbodies, const SceneBody bodies[])
{
  PetscFunctionBegin;
  PetscCheck(nbodies > 0, comm, PETSC_ERR_ARG_OUTOFRANGE, "A mesh needs at least one body, but %" PetscInt_FMT " are given", nbodies);
  for (PetscInt b = 0; b < nbodies; ++b) {
    for (PetscInt c = 0; c < b; ++c) {
      PetscBool same;

      PetscCall(PetscStrcmp(bodies[b].name, bodies[c].name, &same));
      PetscCheck(!same, comm, PETSC_ERR_ARG_WRONG, "Two bodies have the same name \"%s\"", bodies[b].name);
    }
  }
  PetscFunctionReturn(0);
}

static PetscErrorCode MeshCreateBodies(MPI_Comm comm, PetscInt nbodies, const SceneBody bodies[], MeshBody meshes[])
{
  GmshFile    file = {NULL, NULL};
  PetscMPIInt rank;

  PetscFunctionBegin;
  PetscCallMPI(MPI_Comm_rank(comm, &rank));
  for (PetscInt b = 0; b < nbodies; ++b) {
    MeshBody    *mesh = &meshes[b];
    PetscInt64   size[2];
    const Shape *shape;

    PetscCall(ShapeGet(comm, &bodies[b], &shape));
    PetscCall(MeshCheckBody(comm, &bodies[b]));
    PetscCall(MeshGetFaceNames(comm, &bodies[b], &mesh->nfaces, &mesh->faces));
    if (shape) {
      PetscCall(shape->size(comm, &bodies[b], &mesh->ncells, &mesh->nvertices));
      if (rank == 0) PetscCall(shape->create(&bodies[b], &mesh->grid));
    } else {
      PetscCall(GmshFileOpen(comm, &bodies[b], &file));
      PetscCall(GmshFileGetGrid(comm, &file, &bodies[b], &mesh->grid));
      size[0] = mesh->grid.ncells;
      size[1] = mesh->grid.nvertices;
      PetscCallMPI(MPI_Bcast(size, 2, MPIU_INT64, 0, comm));
      mesh->ncells    = size[0];
      mesh->nvertices = size[1];
    }
  }
  PetscCall(GmshFileClose(&file));
  PetscFunctionReturn(0);
}

static PetscErrorCode MeshDestroyBodies(PetscInt nbodies, MeshBody meshes[])
{
  PetscFunctionBegin;
  for (PetscInt b = 0; b < nbodies; ++b) {
    PetscCall(MeshRestoreFaceNames(&meshes[b].nfaces, &meshes[b].faces));
    PetscCall(ShapeGridDestroy(&meshes[b].grid));
  }
  PetscFunctionReturn(0);
}

/* The labels of all faces, on all ranks: those of a face without facets here are empty */
static PetscErrorCode MeshCreateLabels(DM dm, PetscInt nbodies, const SceneBody bodies[], const MeshBody meshes[])
{
  PetscFunctionBegin;
  PetscCall(DMCreateLabel(dm, MESH_BODY_LABEL));
  for (PetscInt b = 0; b < nbodies; ++b) {
    for (PetscInt f = 0; f < meshes[b].nfaces; ++f) {
      char name[PETSC_MAX_PATH_LEN];

      PetscCall(MeshFaceLabelName(bodies[b].name, meshes[b].faces[f], sizeof(name), name));
      PetscCall(DMCreateLabel(dm, name));
    }
  }
  PetscFunctionReturn(0);
}

/* Sets the labels of one body's cells and facets; only on the rank that has them */
static PetscErrorCode MeshLabelBody(DM dm, const SceneBody *body, PetscInt number, const MeshBody *mesh, PetscInt firstcell, PetscInt firstvertex)
{
  const ShapeGrid *grid = &mesh->grid;

  PetscFunctionBegin;
  for (PetscInt c = 0; c < grid->ncells; ++c) PetscCall(DMSetLabelValue(dm, MESH_BODY_LABEL, firstcell + c, number));
  for (PetscInt q = 0; q < grid->nfacets; ++q) {
    char            name[PETSC_MAX_PATH_LEN];
    PetscInt        corners[4], njoin;
    const PetscInt *join;

    for (PetscInt a = 0; a < 4; ++a) corners[a] = firstvertex + grid->facets[4 * q + a];
    PetscCall(DMPlexGetFullJoin(dm, 4, corners, &njoin, &join));
    PetscCheck(njoin == 1, PETSC_COMM_SELF, PETSC_ERR_PLIB, "Facet %" PetscInt_FMT " of body \"%s\" is not a facet of its mesh", q, body->name);
    PetscCall(MeshFaceLabelName(body->name, mesh->faces[grid->facetface[q]], sizeof(name), name));
    PetscCall(DMSetLabelValue(dm, name, join[0], 1));
    PetscCall(DMPlexRestoreJoin(dm, 4, corners, &njoin, &join));
  }
  PetscFunctionReturn(0);
}

/* Faces that are parts of others, collectively: a part without facets is everybody's error */
static PetscErrorCode MeshLabelParts(DM dm, PetscInt nbodies, const SceneBody bodies[], const MeshBody meshes[], PetscInt ncells)
{
  MPI_Comm    comm   = PetscObjectComm((PetscObject)dm);
  PetscInt    vertex = ncells; /* DMPlex numbers the cells first, then the vertices */
  PetscMPIInt rank;

  PetscFunctionBegin;
  PetscCallMPI(MPI_Comm_rank(comm, &rank));
  for (PetscInt b = 0; b < nbodies; ++b) {
    PetscInt empty = PETSC_DECIDE;

    if (rank == 0) PetscCall(MeshLabelSubfaces(dm, &bodies[b], &meshes[b].grid, vertex, &empty));
    vertex += meshes[b].grid.nvertices;
    PetscCallMPI(MPI_Bcast(&empty, 1, MPIU_INT, 0, comm));
    PetscCheck(empty < 0, comm, PETSC_ERR_USER_INPUT, "The face \"%s.%s\" is empty: no facet of \"%s.%s\" has its centroid within the bounds at refinement level 0", bodies[b].name, bodies[b].subfaces[empty].name, bodies[b].name, bodies[b].subfaces[empty].of);
  }
  PetscFunctionReturn(0);
}

/* Adds the closure of its facets to every face's label, so that after distribution and refinement
   a copy of a vertex on a rank without any of the face's facets knows the face too */
static PetscErrorCode MeshCompleteFaceLabels(DM dm, PetscInt nbodies, const SceneBody bodies[], const MeshBody meshes[])
{
  PetscFunctionBegin;
  for (PetscInt b = 0; b < nbodies; ++b) {
    for (PetscInt f = 0; f < meshes[b].nfaces; ++f) {
      char    name[PETSC_MAX_PATH_LEN];
      DMLabel label;

      PetscCall(MeshFaceLabelName(bodies[b].name, meshes[b].faces[f], sizeof(name), name));
      PetscCall(DMGetLabel(dm, name, &label));
      PetscCall(DMPlexLabelComplete(dm, label));
    }
  }
  PetscFunctionReturn(0);
}

/* All bodies at level 0, on rank 0; the other ranks' parts are empty */
static PetscErrorCode MeshCreateLevel0(MPI_Comm comm, PetscInt nbodies, const SceneBody bodies[], const MeshBody meshes[], DM *dm)
{
  PetscInt   ncells = 0, nvertices = 0, cell = 0, vertex = 0, *cells;
  PetscReal *coordinates;

  PetscFunctionBegin;
  for (PetscInt b = 0; b < nbodies; ++b) {
    ncells += meshes[b].grid.ncells;
    nvertices += meshes[b].grid.nvertices;
  }
  PetscCall(PetscMalloc2(8 * ncells, &cells, 3 * nvertices, &coordinates));
  for (PetscInt b = 0; b < nbodies; ++b) {
    const ShapeGrid *grid = &meshes[b].grid;

    for (PetscInt c = 0; c < grid->ncells; ++c) {
      for (PetscInt a = 0; a < 8; ++a) cells[8 * (cell + c) + MeshHexTensorOrder[a]] = vertex + grid->cells[8 * c + a];
    }
    PetscCall(PetscArraycpy(coordinates + 3 * vertex, grid->coordinates, 3 * grid->nvertices));
    cell += grid->ncells;
    vertex += grid->nvertices;
  }
  PetscCall(DMPlexCreateFromCellListPetsc(comm, 3, ncells, nvertices, 8, PETSC_TRUE, cells, 3, coordinates, dm));
  PetscCall(PetscFree2(cells, coordinates));
  PetscCall(MeshCreateLabels(*dm, nbodies, bodies, meshes));
  cell   = 0;
  vertex = ncells; /* DMPlex numbers the cells first, then the vertices */
  for (PetscInt b = 0; b < nbodies; ++b) {
    PetscCall(MeshLabelBody(*dm, &bodies[b], b, &meshes[b], cell, vertex));
    cell += meshes[b].grid.ncells;
    vertex += meshes[b].grid.nvertices;
  }
  PetscCall(MeshLabelParts(*dm, nbodies, bodies, meshes, ncells));
  PetscCall(MeshCompleteFaceLabels(*dm, nbodies, bodies, meshes));
  PetscCall(MeshMapVertices(*dm, nbodies, bodies, PETSC_FALSE));
  PetscCall(MeshCheckCells(*dm, nbodies, bodies, PETSC_FALSE));
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
  The label "body" holds each cell's body number, the label "<body>.<face>" the named face. The mesh is generated on rank 0,
  or read there by PETSc from Gmsh files, and distributed as coarse as its balance allows; refinement is parallel. Refined
  vertices of a curved body lie on its true surfaces, and those inside follow the shape's own map.

  Bodies never share vertices, also where they come from one Gmsh file and touch there.

  It is an error if there are more ranks than cells, and if a cell is inverted or flat.

.seealso: `MeshGetFaceNames()`, `MeshGetFacets()`, `MeshGetFaceVertices()`, `MeshGetFaceDofs()`, `MeshCheckScene()`, `ElasticityCreate()`
@*/
PetscErrorCode MeshCreate(MPI_Comm comm, PetscInt nbodies, const SceneBody bodies[], PetscInt refine, DM *dm)
{
  PetscMPIInt size;
  PetscInt64  ncells = 0, nvertices = 0, finecells;
  PetscInt    before = 0;
  MeshBody   *meshes;

  PetscFunctionBegin;
  PetscCall(MeshInitializePackage());
  PetscCall(PetscLogEventBegin(MESH_Create, 0, 0, 0, 0));
  PetscCall(MeshCheckNames(comm, nbodies, bodies));
  PetscCheck(refine >= 0, comm, PETSC_ERR_ARG_OUTOFRANGE, "The number of refinements must not be negative, but is %" PetscInt_FMT, refine);
  PetscCall(PetscCalloc1(nbodies, &meshes));
  PetscCall(MeshCreateBodies(comm, nbodies, bodies, meshes));
  for (PetscInt b = 0; b < nbodies; ++b) {
    ncells += meshes[b].ncells;
    nvertices += meshes[b].nvertices;
  }
  PetscCheck(8 * nvertices < PETSC_MAX_INT, comm, PETSC_ERR_ARG_OUTOFRANGE, "The %" PetscInt64_FMT " level 0 vertices are too many for this PETSc's integers", nvertices);
  finecells = ncells;
  for (PetscInt l = 0; l < refine; ++l) {
    PetscCheck(finecells <= PETSC_MAX_INT / 8, comm, PETSC_ERR_ARG_OUTOFRANGE, "%" PetscInt_FMT " refinements of %" PetscInt64_FMT " level 0 cells are too many for this PETSc's integers", refine, ncells);
    finecells *= 8;
  }
  PetscCallMPI(MPI_Comm_size(comm, &size));
  PetscCheck(size <= finecells, comm, PETSC_ERR_ARG_OUTOFRANGE, "There are more ranks than cells: %d ranks, and the mesh has %" PetscInt64_FMT, size, finecells);

  PetscCall(MeshCreateLevel0(comm, nbodies, bodies, meshes, dm));
  PetscCall(MeshDestroyBodies(nbodies, meshes));
  PetscCall(PetscFree(meshes));
  if (size > 1) {
    for (PetscInt64 n = ncells; before < refine && n < MESH_MIN_CELLS_PER_RANK * size; n *= 8) ++before;
    PetscCall(MeshRefine(dm, before));
    PetscCall(MeshDistribute(dm));
  }
  PetscCall(MeshRefine(dm, refine - before));
  PetscCall(MeshMapVertices(*dm, nbodies, bodies, PETSC_TRUE));
  PetscCall(MeshCheckCells(*dm, nbodies, bodies, PETSC_TRUE));
  PetscCall(MeshSetSection(*dm));
  PetscCall(PetscObjectSetName((PetscObject)*dm, "mesh"));
  PetscCall(DMViewFromOptions(*dm, NULL, "-dm_view"));
  PetscCall(PetscLogEventEnd(MESH_Create, 0, 0, 0, 0));
  PetscFunctionReturn(0);
}
