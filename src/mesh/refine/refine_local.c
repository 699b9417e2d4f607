/* Local refinement of a uniformly refined mesh on the first rank: creates the mesh of the locally refined cells, with
   labels and curves */
#include "refineimpl.h"

/* Computes the number of a facet within its cell: 2 d for the lower end and 2 d + 1 for the upper end along
   parameter d */
static PetscErrorCode LocalGetSide(DM dm, PetscInt cell, PetscInt facet, PetscInt *side)
{
  PetscInt vertices[8], npoints, sum[3] = {0, 0, 0}, *closure = NULL;

  PetscFunctionBegin;
  PetscCall(MeshGetCellVertices(dm, cell, vertices));
  PetscCall(DMPlexGetTransitiveClosure(dm, facet, PETSC_TRUE, &npoints, &closure));
  for (PetscInt p = 0; p < npoints; ++p) {
    for (PetscInt a = 0; a < 8; ++a) {
      for (PetscInt d = 0; d < 3 && vertices[a] == closure[2 * p]; ++d) sum[d] += a >> d & 1;
    }
  }
  PetscCall(DMPlexRestoreTransitiveClosure(dm, facet, PETSC_TRUE, &npoints, &closure));
  *side = 0;
  for (PetscInt d = 0; d < 3; ++d) {
    if (sum[d] % 4 == 0) *side = 2 * d + sum[d] / 4;
  }
  PetscFunctionReturn(0);
}

/* Finds the facet of the original mesh that contains a side of a cell. *facet is -1 if the side is inside an original
   cell. */
static PetscErrorCode LocalGetRootFacet(DM dm, const MeshHexes *hexes, PetscInt cell, PetscInt side, PetscInt *facet)
{
  const PetscInt *place = &hexes->place[4 * cell], *cone;

  PetscFunctionBegin;
  *facet = -1;
  if (place[side / 2] != (side % 2 ? (1 << place[3]) - 1 : 0)) PetscFunctionReturn(0);
  PetscCall(DMPlexGetCone(dm, hexes->root[cell], &cone));
  for (PetscInt i = 0; i < 6; ++i) {
    PetscInt at;

    PetscCall(LocalGetSide(dm, hexes->root[cell], cone[i], &at));
    if (at == side) *facet = cone[i];
  }
  PetscFunctionReturn(0);
}

/* Determines whether DMPlex creates a label itself, so that it must not be copied */
static PetscErrorCode LocalIsBuiltIn(const char label[], PetscBool *builtin)
{
  PetscBool same;

  PetscFunctionBegin;
  PetscCall(PetscStrcmp(label, "depth", builtin));
  PetscCall(PetscStrcmp(label, "celltype", &same));
  *builtin = (PetscBool)(*builtin || same);
  PetscFunctionReturn(0);
}

/* Labels a facet that has one cell. A facet of the boundary gets the labels of the original facet that contains it. A
   facet inside a body lies between a coarser cell and finer cells, and gets the label MESH_INNER_LABEL. */
static PetscErrorCode LocalLabelFacet(DM dm, const MeshHexes *hexes, DM fine, PetscInt facet)
{
  const PetscInt *cells;
  PetscInt        side, root, nlabels, ncells = 0;

  PetscFunctionBegin;
  PetscCall(DMPlexGetSupport(fine, facet, &cells));
  PetscCall(LocalGetSide(fine, cells[0], facet, &side));
  PetscCall(LocalGetRootFacet(dm, hexes, cells[0], side, &root));
  if (root >= 0) PetscCall(DMPlexGetSupportSize(dm, root, &ncells));
  if (ncells != 1) {
    PetscCall(DMSetLabelValue(fine, MESH_INNER_LABEL, facet, 1));
    PetscFunctionReturn(0);
  }
  PetscCall(DMGetNumLabels(dm, &nlabels));
  for (PetscInt l = 0; l < nlabels; ++l) {
    const char *name;
    PetscInt    value;
    PetscBool   builtin;

    PetscCall(DMGetLabelName(dm, l, &name));
    PetscCall(LocalIsBuiltIn(name, &builtin));
    if (builtin) continue;
    PetscCall(DMGetLabelValue(dm, name, root, &value));
    if (value >= 0) PetscCall(DMSetLabelValue(fine, name, facet, value));
  }
  PetscFunctionReturn(0);
}

/* Sets the body label of all cells, and the labels of all facets with one cell */
static PetscErrorCode LocalLabelPoints(DM dm, const MeshHexes *hexes, DM fine)
{
  PetscInt start, end;

  PetscFunctionBegin;
  for (PetscInt c = 0; c < hexes->ncells; ++c) {
    PetscInt body;

    PetscCall(DMGetLabelValue(dm, MESH_BODY_LABEL, hexes->root[c], &body));
    PetscCall(DMSetLabelValue(fine, MESH_BODY_LABEL, c, body));
  }
  PetscCall(DMPlexGetHeightStratum(fine, 1, &start, &end));
  for (PetscInt f = start; f < end; ++f) {
    PetscInt ncells;

    PetscCall(DMPlexGetSupportSize(fine, f, &ncells));
    if (ncells == 1) PetscCall(LocalLabelFacet(dm, hexes, fine, f));
  }
  PetscFunctionReturn(0);
}

/* Collective. Copies the labels of the original mesh, and labels the facets inside bodies that have one cell */
static PetscErrorCode LocalLabel(DM dm, const MeshHexes *hexes, DM fine)
{
  PetscInt nlabels;

  PetscFunctionBegin;
  PetscCall(DMGetNumLabels(dm, &nlabels));
  PetscCall(DMCreateLabel(fine, MESH_INNER_LABEL));
  for (PetscInt pass = 0; pass < 2; ++pass) {
    for (PetscInt l = 0; l < nlabels; ++l) {
      const char *name;
      DMLabel     label;
      PetscBool   builtin, body;

      PetscCall(DMGetLabelName(dm, l, &name));
      PetscCall(LocalIsBuiltIn(name, &builtin));
      PetscCall(PetscStrcmp(name, MESH_BODY_LABEL, &body));
      if (builtin) continue;
      if (!pass) PetscCall(DMCreateLabel(fine, name));
      PetscCall(DMGetLabel(fine, name, &label));
      if (pass && !body) PetscCall(DMPlexLabelComplete(fine, label));
    }
    if (!pass) PetscCall(LocalLabelPoints(dm, hexes, fine));
  }
  PetscFunctionReturn(0);
}

/* Collective. Creates the mesh of the refined cells on the first rank */
static PetscErrorCode LocalCreateMesh(DM dm, const MeshHexes *hexes, DM *fine)
{
  const PetscInt *order = MeshPlexCorners(8);
  PetscInt       *cells;

  PetscFunctionBegin;
  PetscCall(PetscMalloc1(8 * hexes->ncells, &cells));
  for (PetscInt c = 0; c < hexes->ncells; ++c) {
    for (PetscInt a = 0; a < 8; ++a) cells[8 * c + order[a]] = hexes->vertex[8 * c + a];
  }
  PetscCall(DMPlexCreateFromCellListPetsc(PetscObjectComm((PetscObject)dm), 3, hexes->ncells, hexes->nvertices, 8,
    PETSC_TRUE, cells, 3, hexes->x, fine));
  PetscCall(PetscFree(cells));
  PetscFunctionReturn(0);
}

/* Collective. Refines the mesh on the first rank locally, with its curves, and creates the data of hanging vertices */
PetscErrorCode MeshRefineLocally(const MeshLocalRefinement *local, const SceneBody bodies[], DM *dm, MeshCurves *curves,
  MeshHanging *hanging)
{
  MPI_Comm       comm = PetscObjectComm((PetscObject)*dm);
  RankError      error;
  PetscErrorCode ierr;
  PetscMPIInt    rank;
  MeshHexes      hexes;
  DM             fine;

  PetscFunctionBegin;
  PetscCallMPI(MPI_Comm_rank(comm, &rank));
  for (PetscInt z = 0; z < local->nzones; ++z) {
    for (PetscInt k = 0; k < 2 && local->zones[z].face[k]; ++k) {
      PetscBool has;

      PetscCall(DMHasLabel(*dm, local->zones[z].face[k], &has));
      SceneCheck(has, comm, PETSC_ERR_USER_INPUT, &local->zones[z], "refinement \"%s\": there is no face \"%s\"",
        local->zones[z].name, local->zones[z].face[k]);
    }
  }
  PetscCall(RankErrorBegin(&error));
  ierr = MeshHexesCreate(*dm, &hexes);
  if (!ierr && rank == 0) ierr = MeshHexesRefineZones(*dm, bodies, local->nzones, local->zones, &hexes);
  if (!ierr && rank == 0) ierr = MeshHexesRefineInverted(*dm, bodies, curves, &hexes);
  if (!ierr && rank == 0 && local->marks) ierr = MeshHexesRefineMarks(local->marks, *dm, bodies, curves, &hexes);
  PetscCall(RankErrorEnd(comm, ierr, &error));
  PetscCheck(!error.code, comm, error.code, "%s", error.message);
  PetscCall(LocalCreateMesh(*dm, &hexes, &fine));
  PetscCall(LocalLabel(*dm, &hexes, fine));
  PetscCall(MeshCurvesCutOut(&hexes, fine, curves));
  PetscCall(MeshHangingCreate(&hexes, fine, hanging));
  PetscCall(MeshHexesDestroy(&hexes));
  PetscCall(DMDestroy(dm));
  *dm = fine;
  PetscFunctionReturn(0);
}
