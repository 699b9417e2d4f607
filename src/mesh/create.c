/* Creates the mesh: level 0, distribution, refinement, and layout of the unknowns */
#include "meshimpl.h"
#include "src/report/events.h"
#include <petscsf.h>

/* Level 0 is refined before it is distributed, until each rank gets at least this number of cells. Coarser partitions
   are badly balanced. */
#define MESH_MIN_CELLS_PER_RANK 32

static PetscErrorCode MeshInitializePackage(void)
{
  static PetscBool initialized = PETSC_FALSE;

  PetscFunctionBegin;
  if (initialized) PetscFunctionReturn(0);
  initialized = PETSC_TRUE;
  PetscCall(EventsRegister());
  PetscCall(MeshRegisterPartitioner());
  PetscFunctionReturn(0);
}

/* Checks that there are bodies, and that no two have the same name */
static PetscErrorCode MeshCheckNames(MPI_Comm comm, PetscInt nbodies, const SceneBody bodies[])
{
  PetscFunctionBegin;
  PetscCheck(nbodies > 0, comm, PETSC_ERR_ARG_OUTOFRANGE,
    "A mesh needs at least one body, but the number of bodies is %" PetscInt_FMT, nbodies);
  for (PetscInt b = 0; b < nbodies; ++b) {
    for (PetscInt c = 0; c < b; ++c) {
      PetscBool same;

      PetscCall(PetscStrcmp(bodies[b].name, bodies[c].name, &same));
      PetscCheck(!same, comm, PETSC_ERR_ARG_WRONG, "Two bodies have the same name \"%s\"", bodies[b].name);
    }
  }
  PetscFunctionReturn(0);
}

/* Collective. Distributes the mesh, with its curves and hanging vertices, by the partitioner */
static PetscErrorCode MeshDistribute(DM *dm, MeshCurves *curves, MeshHanging *hanging)
{
  PetscPartitioner partitioner;
  DM               distributed;
  PetscSF          migration;

  PetscFunctionBegin;
  PetscCall(DMPlexGetPartitioner(*dm, &partitioner));
  PetscCall(PetscPartitionerSetType(partitioner, "metis"));
  PetscCall(PetscPartitionerSetFromOptions(partitioner));
  PetscCall(DMPlexDistribute(*dm, 0, &migration, &distributed));
  if (distributed) {
    PetscCall(MeshCurvesDistribute(migration, distributed, curves));
    PetscCall(MeshHangingDistribute(migration, *dm, hanging));
    PetscCall(PetscSFDestroy(&migration));
    PetscCall(DMDestroy(dm));
    *dm = distributed;
  }
  PetscFunctionReturn(0);
}

/* Collective. Checks the numbers of cells and vertices after refinement against PETSc's integer type. *ncells: number
   of cells at level 0 */
static PetscErrorCode MeshCheckSize(MPI_Comm comm, PetscInt nbodies, const MeshBody meshes[], PetscInt refine,
  PetscInt64 *ncells)
{
  PetscInt64 nvertices = 0, finecells;

  PetscFunctionBegin;
  *ncells = 0;
  for (PetscInt b = 0; b < nbodies; ++b) {
    *ncells += meshes[b].ncells;
    nvertices += meshes[b].nvertices;
  }
  PetscCheck(8 * nvertices < PETSC_MAX_INT, comm, PETSC_ERR_ARG_OUTOFRANGE,
    "The %" PetscInt64_FMT " level 0 vertices are too many for PETSc's integer type: use a coarser mesh, or PETSc with "
    "64-bit indices",
    nvertices);
  finecells = *ncells;
  for (PetscInt l = 0; l < refine; ++l) {
    PetscCheck(finecells <= PETSC_MAX_INT / 8, comm, PETSC_ERR_ARG_OUTOFRANGE,
      "%" PetscInt_FMT " refinements of %" PetscInt64_FMT " level 0 cells are too many for PETSc's integer type: "
      "refine less often, or use PETSc with 64-bit indices",
      refine, *ncells);
    finecells *= 8;
  }
  PetscFunctionReturn(0);
}

/*
   Collective. Creates level 0. Large meshes from files are partitioned before the DMPlex is built. Meshes of built-in
   shapes, and meshes for which the options name a partitioner, are not. Frees the bodies' grids. may: whether
   partitioning before the DMPlex is built is allowed
*/
static PetscErrorCode MeshCreateParted(MPI_Comm comm, PetscInt nbodies, const SceneBody bodies[], MeshBody meshes[],
  PetscBool may, PetscBool *distributed, MeshCurves *curves, DM *dm)
{
  PetscInt64  ncells = 0;
  PetscBool   chosen, file = PETSC_FALSE;
  PetscMPIInt size;
  MeshOwners  owners = {.n = 0, .points = NULL};

  PetscFunctionBegin;
  PetscCallMPI(MPI_Comm_size(comm, &size));
  PetscCall(PetscOptionsHasName(NULL, NULL, "-petscpartitioner_type", &chosen));
  for (PetscInt b = 0; b < nbodies; ++b) {
    file = (PetscBool)(file || bodies[b].shape == SHAPE_GMSH);
    ncells += meshes[b].ncells;
  }
  *distributed = owners.distributed =
    (PetscBool)(may && file && !chosen && size > 1 && ncells >= MESH_MIN_CELLS_PER_RANK * size);
  if (owners.distributed) PetscCall(MeshDistributeGrids(comm, nbodies, meshes, &owners));
  PetscCall(MeshCreateLevel0(comm, nbodies, bodies, meshes, &owners, dm));
  PetscCall(MeshOwnersDestroy(&owners));
  PetscCall(MeshCurvesCreate(*dm, nbodies, meshes, curves));
  PetscCall(MeshDestroyBodies(nbodies, meshes));
  PetscFunctionReturn(0);
}

/* Replaces the labels by copies, since labels keep the memory of the hash tables from which they were made */
static PetscErrorCode MeshTrimLabels(DM dm)
{
  PetscInt n;

  PetscFunctionBegin;
  PetscCall(DMGetNumLabels(dm, &n));
  for (PetscInt i = 0; i < n; ++i) {
    DMLabel label, copy;

    PetscCall(DMGetLabelByNum(dm, i, &label));
    PetscCall(DMLabelDuplicate(label, &copy));
    PetscCall(DMSetLabel(dm, copy));
    PetscCall(DMLabelDestroy(&copy));
  }
  PetscFunctionReturn(0);
}

/* Collective. Creates labels, layout and nodes of the distributed and refined mesh, and moves the nodes to the surfaces
   of curved bodies. refine: number of refinements since the mesh had the cells of `curves` */
static PetscErrorCode MeshFinish(PetscInt nbodies, const SceneBody bodies[], const PetscInt orders[], PetscInt refine,
  MeshCurves *curves, MeshHanging *hanging, DM dm)
{
  PetscFunctionBegin;
  PetscCall(MeshLabelRigid(dm, nbodies, bodies));
  PetscCall(MeshSetSection(dm, nbodies, orders));
  PetscCall(MeshCreateNodes(dm, nbodies, orders));
  PetscCall(MeshMapNodes(dm, nbodies, bodies, PETSC_TRUE));
  PetscCall(MeshCurvesApply(curves, refine, dm, PETSC_TRUE));
  PetscCall(MeshCurvesDestroy(curves));
  PetscCall(MeshHangingFinish(dm, hanging));
  PetscCall(MeshHangingPlace(dm));
  PetscCall(MeshSerendipityFinish(dm, nbodies, bodies));
  PetscCall(MeshUpdateVertices(dm));
  PetscCall(MeshCheckCells(dm, nbodies, bodies, PETSC_TRUE));
  PetscCall(MeshTrimLabels(dm));
  PetscFunctionReturn(0);
}

/* Collective. Creates the mesh and refines it uniformly. Local refinement follows, if there is any, before the mesh is
   distributed. */
static PetscErrorCode MeshCreateRefined(MPI_Comm comm, PetscInt nbodies, const SceneBody bodies[], PetscInt refine,
  const MeshLocalRefinement *local, DM *dm)
{
  PetscMPIInt size;
  PetscInt64  ncells = 0;
  PetscInt    before = 0, *orders;
  MeshBody   *meshes;
  MeshCurves  curves;
  MeshHanging hanging     = {NULL, NULL};
  PetscBool   distributed = PETSC_FALSE, locally = (PetscBool)(local->nzones || local->marks);

  PetscFunctionBegin;
  PetscCall(MeshInitializePackage());
  PetscCall(PetscLogEventBegin(MESH_Create, 0, 0, 0, 0));
  PetscCall(MeshCheckNames(comm, nbodies, bodies));
  PetscCheck(refine >= 0, comm, PETSC_ERR_ARG_OUTOFRANGE,
    "The number of refinements must not be negative, but is %" PetscInt_FMT, refine);
  PetscCall(PetscCalloc1(nbodies, &meshes));
  PetscCall(PetscMalloc1(nbodies, &orders));
  PetscCall(MeshCreateBodies(comm, nbodies, bodies, meshes));
  PetscCall(MeshCheckSize(comm, nbodies, meshes, refine, &ncells));
  for (PetscInt b = 0; b < nbodies; ++b) {
    orders[b] = meshes[b].order;
    SceneCheck(!locally || meshes[b].ncorners == 8, comm, PETSC_ERR_SUP, &bodies[b],
      "Body \"%s\" has tetrahedra, but local refinement needs hexahedra: use uniform refinement, or a finer mesh in "
      "the file",
      bodies[b].name);
  }
  PetscCallMPI(MPI_Comm_size(comm, &size));

  PetscCall(MeshCreateParted(comm, nbodies, bodies, meshes, (PetscBool)!locally, &distributed, &curves, dm));
  PetscCall(PetscFree(meshes));
  if (locally) before = refine;
  else if (size > 1) {
    for (PetscInt64 n = ncells; before < refine && n < MESH_MIN_CELLS_PER_RANK * size; n *= 8) ++before;
  }
  if (before) {
    PetscCall(MeshRefine(dm, before));
    PetscCall(MeshCurvesApply(&curves, before, *dm, PETSC_FALSE));
    PetscCall(MeshCurvesRefine(before, *dm, &curves));
  }
  if (locally) PetscCall(MeshRefineLocally(local, bodies, dm, &curves, &hanging));
  if (size > 1 && !distributed) PetscCall(MeshDistribute(dm, &curves, &hanging));
  PetscCall(MeshRefine(dm, refine - before));
  PetscCall(MeshFinish(nbodies, bodies, orders, refine - before, &curves, &hanging, *dm));
  PetscCall(PetscFree(orders));
  PetscCall(PetscObjectSetName((PetscObject)*dm, "mesh"));
  PetscCall(DMViewFromOptions(*dm, NULL, "-dm_view"));
  PetscCall(PetscLogEventEnd(MESH_Create, 0, 0, 0, 0));
  PetscFunctionReturn(0);
}

/*@
  MeshCreate - Creates the mesh of all bodies, which consists of hexahedra and tetrahedra, distributes and refines it,
  and lays out the displacements

  Collective

  Input Parameters:
+ comm    - communicator
. nbodies - number of bodies, at least 1
. bodies  - the bodies, equal on all ranks
- refine  - number of uniform refinements of level 0, at least 0

  Output Parameter:
. dm - the mesh, a `DMPLEX` with one connected component per body

  Options Database Keys:
+ -petscpartitioner_type <metis> - partitioner of the level 0 mesh
- -dm_view                       - views the mesh

  Level: beginner

  Notes:
  The label "body" contains the body number of each cell. The label "<body>.<face>" contains the facets of a
  named face, and their closure. Level 0 is created on rank 0, or read there from Gmsh files. It is refined there until
  each rank gets enough cells for a balanced partition, and then distributed; refinement continues in parallel. Large
  meshes of scenes with Gmsh files are distributed before any rank creates a `DMPLEX` of them. New vertices of a curved
  body lie on its exact surfaces, and vertices inside follow the map of the shape. New vertices of a body from a Gmsh
  file of second order follow its quadratic cells. If the file is of first order, they follow arcs that are
  perpendicular to the mean normals of the facets around the vertices.

  Bodies never share vertices, even if they come from one Gmsh file and touch there. A body whose order is 0 gets order
  1 if it consists of hexahedra, and order 2 if it consists of tetrahedra.

  If there are more ranks than cells, the last ranks own nothing. It is an error if the memory of the first rank is
  insufficient for level 0, or if a cell is inverted or flat.

.seealso: `MeshGetFaceNames()`, `MeshGetFacets()`, `MeshGetFaceVertices()`, `MeshGetFaceDofs()`, `MeshCheckScene()`,
          `ElasticityCreate()`
@*/
PetscErrorCode MeshCreate(MPI_Comm comm, PetscInt nbodies, const SceneBody bodies[], PetscInt refine, DM *dm)
{
  const MeshLocalRefinement none = {0, NULL, NULL};

  PetscFunctionBegin;
  PetscCall(MeshCreateRefined(comm, nbodies, bodies, refine, &none, dm));
  PetscFunctionReturn(0);
}

/*@
  MeshCreateScene - Creates the mesh of a scene, with the uniform and the local refinements that the scene asks for

  Collective

  Input Parameters:
+ comm  - communicator
. scene - the scene, the same on all ranks
- marks - cells marked on earlier meshes, which are refined after the zones of the scene; `NULL`: none

  Output Parameter:
. dm - the mesh, a `DMPLEX` with one connected component per body

  Level: beginner

  Notes:
  Local refinement divides a cell into eight. It follows the uniform refinements and is done on the first rank, before
  the mesh is distributed. Neighbours of finer cells are refined too, until neighbours differ by at most one refinement.
  Hanging vertices, between coarser and finer cells, are nodes of the mesh. The position of a hanging vertex is the mean
  of the vertices that `MeshGetHanging()` gives, even if the body is curved.

.seealso: `MeshCreate()`, `MeshCheckScene()`
@*/
PetscErrorCode MeshCreateScene(MPI_Comm comm, Scene scene, const MeshMarks *marks, DM *dm)
{
  const MeshLocalRefinement local = {scene->nrefinements, scene->refinements, marks};

  PetscFunctionBegin;
  PetscCall(MeshCreateRefined(comm, scene->nbodies, scene->bodies, scene->refine, &local, dm));
  PetscFunctionReturn(0);
}
