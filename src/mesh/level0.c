/* The mesh of all bodies at level 0, on rank 0, and its labels */
#include "meshimpl.h"

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

/* Sets the labels of all bodies; DMPlex numbers the cells first, then the vertices */
static PetscErrorCode MeshLabelBodies(DM dm, PetscInt nbodies, const SceneBody bodies[], const MeshBody meshes[], PetscInt ncells)
{
  PetscInt cell = 0, vertex = ncells;

  PetscFunctionBegin;
  for (PetscInt b = 0; b < nbodies; ++b) {
    PetscCall(MeshLabelBody(dm, &bodies[b], b, &meshes[b], cell, vertex));
    PetscCall(MeshLabelSubfaces(dm, &bodies[b], &meshes[b].grid, vertex));
    cell += meshes[b].grid.ncells;
    vertex += meshes[b].grid.nvertices;
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

/* The grids of all bodies in one, the cells' vertices in the order of DMPlex; cells and coordinates: for PetscFree2() */
static PetscErrorCode MeshJoinGrids(PetscInt nbodies, const MeshBody meshes[], PetscInt *ncells, PetscInt *nvertices, PetscInt **cells, PetscReal **coordinates)
{
  PetscInt cell = 0, vertex = 0;

  PetscFunctionBegin;
  for (PetscInt b = 0; b < nbodies; ++b) {
    *ncells += meshes[b].grid.ncells;
    *nvertices += meshes[b].grid.nvertices;
  }
  PetscCall(PetscMalloc2(8 * *ncells, cells, 3 * *nvertices, coordinates));
  for (PetscInt b = 0; b < nbodies; ++b) {
    const ShapeGrid *grid = &meshes[b].grid;

    for (PetscInt c = 0; c < grid->ncells; ++c) {
      for (PetscInt a = 0; a < 8; ++a) (*cells)[8 * (cell + c) + MeshHexTensorOrder[a]] = vertex + grid->cells[8 * c + a];
    }
    PetscCall(PetscArraycpy(*coordinates + 3 * vertex, grid->coordinates, 3 * grid->nvertices));
    cell += grid->ncells;
    vertex += grid->nvertices;
  }
  PetscFunctionReturn(0);
}

/* All bodies at level 0, on rank 0; the other ranks' parts are empty */
PetscErrorCode MeshCreateLevel0(MPI_Comm comm, PetscInt nbodies, const SceneBody bodies[], const MeshBody meshes[], DM *dm)
{
  RankError      error;
  PetscErrorCode ierr;
  PetscMPIInt    rank;
  PetscInt       ncells = 0, nvertices = 0, *cells;
  PetscReal     *coordinates;

  PetscFunctionBegin;
  PetscCallMPI(MPI_Comm_rank(comm, &rank));
  PetscCall(RankErrorBegin(&error));
  ierr = MeshJoinGrids(nbodies, meshes, &ncells, &nvertices, &cells, &coordinates);
  PetscCall(RankErrorEnd(comm, ierr, &error));
  PetscCheck(!error.code, comm, error.code, "The first rank cannot make the mesh of all bodies at level 0: %s", error.message);
  PetscCall(DMPlexCreateFromCellListPetsc(comm, 3, ncells, nvertices, 8, PETSC_TRUE, cells, 3, coordinates, dm));
  PetscCall(PetscFree2(cells, coordinates));
  PetscCall(MeshCreateLabels(*dm, nbodies, bodies, meshes));
  PetscCall(RankErrorBegin(&error));
  if (rank == 0) ierr = MeshLabelBodies(*dm, nbodies, bodies, meshes, ncells);
  PetscCall(RankErrorEnd(comm, ierr, &error));
  PetscCheck(!error.code, comm, error.code, "%s", error.message);
  PetscCall(MeshCompleteFaceLabels(*dm, nbodies, bodies, meshes));
  PetscCall(MeshMapNodes(*dm, nbodies, bodies, PETSC_FALSE));
  PetscCall(MeshCheckCells(*dm, nbodies, bodies, PETSC_FALSE));
  PetscFunctionReturn(0);
}
