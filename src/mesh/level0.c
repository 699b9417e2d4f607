/* The mesh of all bodies at level 0 and its labels, created from the grids on each rank */
#include "meshimpl.h"
#include <petscsf.h>

/* Creates the labels of all faces on all ranks. On a rank without facets of a face the label is empty. */
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

/* Sets the labels of one body's cells and facets on the rank that has its grid */
static PetscErrorCode MeshLabelBody(DM dm, const SceneBody *body, PetscInt number, const MeshBody *mesh,
  PetscInt firstcell, PetscInt firstvertex)
{
  const ShapeGrid *grid = &mesh->grid;

  PetscFunctionBegin;
  for (PetscInt c = 0; c < grid->ncells; ++c) PetscCall(DMSetLabelValue(dm, MESH_BODY_LABEL, firstcell + c, number));
  for (PetscInt q = 0; q < grid->nfacets; ++q) {
    char           name[PETSC_MAX_PATH_LEN];
    PetscInt       corners[4], njoin;
    const PetscInt n = grid->ncorners == 4 ? 3 : 4, *join;

    for (PetscInt a = 0; a < n; ++a) corners[a] = firstvertex + grid->facets[4 * q + a];
    PetscCall(DMPlexGetFullJoin(dm, n, corners, &njoin, &join));
    SceneCheck(njoin == 1, PETSC_COMM_SELF, PETSC_ERR_PLIB, body,
      "Facet %" PetscInt_FMT " of body \"%s\" is not a facet of any cell", q, body->name);
    PetscCall(MeshFaceLabelName(body->name, mesh->faces[grid->facetface[q]], sizeof(name), name));
    PetscCall(DMSetLabelValue(dm, name, join[0], 1));
    PetscCall(DMPlexRestoreJoin(dm, n, corners, &njoin, &join));
  }
  PetscFunctionReturn(0);
}

/* Sets the labels of all bodies on this rank. DMPlex numbers the cells first, then the vertices. */
static PetscErrorCode MeshLabelBodies(DM dm, PetscInt nbodies, const SceneBody bodies[], const MeshBody meshes[],
  PetscInt ncells)
{
  PetscInt vertex = ncells, *first;

  PetscFunctionBegin;
  PetscCall(PetscMalloc1(nbodies, &first));
  PetscCall(MeshGetFirstCells(nbodies, meshes, first));
  for (PetscInt b = 0; b < nbodies; ++b) {
    PetscCall(MeshLabelBody(dm, &bodies[b], b, &meshes[b], first[b], vertex));
    PetscCall(MeshLabelSubfaces(dm, &bodies[b], &meshes[b].grid, vertex));
    vertex += meshes[b].grid.nvertices;
  }
  PetscCall(PetscFree(first));
  PetscFunctionReturn(0);
}

/* Collective. Adds the closure of the facets to every face's label. After distribution and refinement, a rank that has
   a vertex of the face, but none of its facets, then still has the vertex in the label. */
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

/* Creates the cells of all bodies as points of the DMPlex. The vertices are numbered after the cells. */
static PetscErrorCode MeshBuildCells(DM dm, PetscInt nbodies, const MeshBody meshes[], PetscInt ncells,
  PetscInt nvertices)
{
  PetscInt vertex = ncells, *first;

  PetscFunctionBegin;
  PetscCall(PetscMalloc1(nbodies, &first));
  PetscCall(MeshGetFirstCells(nbodies, meshes, first));
  PetscCall(DMPlexSetChart(dm, 0, ncells + nvertices));
  for (PetscInt b = 0; b < nbodies; ++b) {
    for (PetscInt c = 0; c < meshes[b].grid.ncells; ++c)
      PetscCall(DMPlexSetConeSize(dm, first[b] + c, meshes[b].ncorners));
  }
  PetscCall(DMSetUp(dm));
  for (PetscInt b = 0; b < nbodies; ++b) {
    const ShapeGrid *grid  = &meshes[b].grid;
    const PetscInt   n     = meshes[b].ncorners;
    const PetscInt  *order = MeshPlexCorners(n);

    for (PetscInt c = 0; c < grid->ncells; ++c) {
      PetscInt cone[8];

      for (PetscInt a = 0; a < n; ++a) cone[order[a]] = vertex + grid->cells[n * c + a];
      PetscCall(DMPlexSetCone(dm, first[b] + c, cone));
    }
    vertex += grid->nvertices;
  }
  PetscCall(PetscFree(first));
  PetscFunctionReturn(0);
}

/* Concatenates the coordinates of all bodies' vertices on this rank. The caller frees *coordinates. */
static PetscErrorCode MeshJoinVertices(PetscInt nbodies, const MeshBody meshes[], PetscInt nvertices,
  PetscReal **coordinates)
{
  PetscInt vertex = 0;

  PetscFunctionBegin;
  PetscCall(PetscMalloc1(3 * nvertices, coordinates));
  for (PetscInt b = 0; b < nbodies; ++b) {
    PetscCall(PetscArraycpy(*coordinates + 3 * vertex, meshes[b].grid.coordinates, 3 * meshes[b].grid.nvertices));
    vertex += meshes[b].grid.nvertices;
  }
  PetscFunctionReturn(0);
}

/* Creates the star forest of the vertices that other ranks own */
static PetscErrorCode MeshShareVertices(DM dm, PetscInt ncells, const MeshOwners *owners)
{
  PetscMPIInt  rank;
  PetscInt     n = 0, *leaves;
  PetscSFNode *roots;
  PetscSF      sf;

  PetscFunctionBegin;
  PetscCallMPI(MPI_Comm_rank(PetscObjectComm((PetscObject)dm), &rank));
  PetscCall(PetscMalloc1(owners->n, &leaves));
  PetscCall(PetscMalloc1(owners->n, &roots));
  for (PetscInt v = 0; v < owners->n; ++v) {
    if (owners->points[v].rank == rank) continue;
    leaves[n]  = ncells + v;
    roots[n++] = owners->points[v];
  }
  PetscCall(DMGetPointSF(dm, &sf));
  PetscCall(PetscSFSetGraph(sf, ncells + owners->n, n, leaves, PETSC_OWN_POINTER, roots, PETSC_OWN_POINTER));
  PetscFunctionReturn(0);
}

/* Collective. Creates the level 0 mesh. It is on the first rank only, unless the grids were distributed. */
PetscErrorCode MeshCreateLevel0(MPI_Comm comm, PetscInt nbodies, const SceneBody bodies[], const MeshBody meshes[],
  const MeshOwners *owners, DM *dm)
{
  RankError      error;
  PetscErrorCode ierr;
  PetscInt       ncells = 0, nvertices = 0;
  PetscReal     *coordinates;
  DM             cells;

  PetscFunctionBegin;
  PetscCall(DMCreate(comm, &cells));
  PetscCall(DMSetType(cells, DMPLEX));
  PetscCall(DMSetDimension(cells, 3));
  for (PetscInt b = 0; b < nbodies; ++b) {
    ncells += meshes[b].grid.ncells;
    nvertices += meshes[b].grid.nvertices;
  }
  PetscCall(RankErrorBegin(&error));
  ierr = MeshBuildCells(cells, nbodies, meshes, ncells, nvertices);
  if (!ierr) ierr = MeshJoinVertices(nbodies, meshes, nvertices, &coordinates);
  PetscCall(RankErrorEnd(comm, ierr, &error));
  PetscCheck(!error.code, comm, error.code, "The first rank cannot create the mesh of all bodies at level 0: %s",
    error.message);
  PetscCall(DMPlexSymmetrize(cells));
  PetscCall(DMPlexStratify(cells));
  if (owners->distributed) PetscCall(MeshShareVertices(cells, ncells, owners));
  PetscCall(DMPlexInterpolate(cells, dm));
  PetscCall(DMPlexBuildCoordinatesFromCellList(*dm, 3, coordinates));
  PetscCall(DMDestroy(&cells));
  PetscCall(PetscFree(coordinates));
  PetscCall(MeshCreateLabels(*dm, nbodies, bodies, meshes));
  PetscCall(RankErrorBegin(&error));
  ierr = MeshLabelBodies(*dm, nbodies, bodies, meshes, ncells);
  PetscCall(RankErrorEnd(comm, ierr, &error));
  PetscCheck(!error.code, comm, error.code, "%s", error.message);
  for (PetscInt b = 0; b < nbodies; ++b) PetscCall(MeshCheckSubfacesFilled(*dm, &bodies[b]));
  PetscCall(MeshCompleteFaceLabels(*dm, nbodies, bodies, meshes));
  PetscCall(MeshMapNodes(*dm, nbodies, bodies, PETSC_FALSE));
  PetscCall(MeshCheckCells(*dm, nbodies, bodies, PETSC_FALSE));
  PetscFunctionReturn(0);
}
