/* Bodies from Gmsh files: read by PETSc on rank 0, cut out of its mesh volume by volume */
#include "meshimpl.h"
#include <petscviewer.h>

/* On rank 0. PETSc labels cells and facets with their physical tags: in formats 4 these are the tags of their entities, in format 2
   the first of their own, which the number of the entity follows. (Its labels by name would take that for a tag.)
   The options are not the user's, whose own meshes must not change */
static PetscErrorCode GmshReadFile(const char file[], DM *dm)
{
  PetscErrorCode ierr;
  PetscOptions   options;
  char           complaint[256];
  FILE          *stream;
  float          version = 0;

  PetscFunctionBegin;
  PetscCall(GmshCheckFile(file, sizeof(complaint), complaint));
  PetscCheck(!complaint[0], PETSC_COMM_SELF, PETSC_ERR_USER_INPUT, "%s", complaint);
  stream = fopen(file, "r");
  if (stream) {
    if (fscanf(stream, "$MeshFormat %f", &version) != 1) version = 0;
    (void)fclose(stream);
  }
  PetscCall(PetscOptionsCreate(&options));
  PetscCall(PetscOptionsSetValue(options, "-dm_plex_gmsh_multiple_tags", version >= 4 ? "true" : "false"));
  PetscCall(PetscOptionsSetValue(options, "-dm_plex_gmsh_periodic", "false"));
  PetscCall(PetscOptionsPush(options));
  ierr = DMPlexCreateGmshFromFile(PETSC_COMM_SELF, file, PETSC_TRUE, dm);
  PetscCall(PetscOptionsPop());
  PetscCall(PetscOptionsDestroy(&options));
  if (ierr) *dm = NULL;
  PetscCall(ierr);
  PetscFunctionReturn(0);
}

PetscErrorCode GmshFileOpen(MPI_Comm comm, const SceneBody *body, GmshFile *file)
{
  RankError      error;
  PetscErrorCode ierr = 0;
  PetscMPIInt    rank;
  PetscBool      same = PETSC_FALSE;
  PetscInt       dim  = 3;

  PetscFunctionBegin;
  if (file->name) PetscCall(PetscStrcmp(file->name, body->gmsh.file, &same));
  if (same) PetscFunctionReturn(0);
  PetscCall(GmshFileClose(file));
  PetscCallMPI(MPI_Comm_rank(comm, &rank));
  PetscCall(RankErrorBegin(&error));
  if (rank == 0) ierr = GmshReadFile(body->gmsh.file, &file->dm);
  PetscCall(RankErrorEnd(comm, ierr, &error));
  PetscCheck(!error.code, comm, PETSC_ERR_USER_INPUT, "Body \"%s\": %s is not a whole Gmsh mesh of 8-node hexahedra: %s", body->name, body->gmsh.file, error.message);
  if (file->dm) PetscCall(DMGetDimension(file->dm, &dim));
  PetscCallMPI(MPI_Bcast(&dim, 1, MPIU_INT, 0, comm));
  PetscCheck(dim == 3, comm, PETSC_ERR_USER_INPUT, "Body \"%s\": %s is a mesh of dimension %" PetscInt_FMT ", without volumes", body->name, body->gmsh.file, dim);
  file->name = body->gmsh.file;
  PetscFunctionReturn(0);
}

PetscErrorCode GmshFileClose(GmshFile *file)
{
  PetscFunctionBegin;
  PetscCall(DMDestroy(&file->dm));
  file->name = NULL;
  PetscFunctionReturn(0);
}

static PetscErrorCode GmshHasTag(DM dm, const char sets[], PetscInt tag, PetscInt point, PetscBool *has)
{
  DMLabel label;

  PetscFunctionBegin;
  *has = PETSC_FALSE;
  PetscCall(DMGetLabel(dm, sets, &label));
  if (label) PetscCall(DMLabelStratumHasPoint(label, tag, point, has));
  PetscFunctionReturn(0);
}

/* The hexahedra of the body's volume with their vertices numbered anew; number: new number of each vertex, PETSC_DECIDE without one */
static PetscErrorCode GmshCutVolume(DM dm, const SceneBody *body, PetscInt tag, PetscInt number[], ShapeGrid *grid)
{
  PetscInt           cstart, cend, vstart, vend;
  PetscSection       section;
  Vec                coordinates;
  const PetscScalar *x;

  PetscFunctionBegin;
  PetscCall(DMPlexGetHeightStratum(dm, 0, &cstart, &cend));
  PetscCall(DMPlexGetDepthStratum(dm, 0, &vstart, &vend));
  PetscCall(PetscMalloc1(8 * (cend - cstart), &grid->cells));
  for (PetscInt v = 0; v < vend - vstart; ++v) number[v] = PETSC_DECIDE;
  for (PetscInt c = cstart; c < cend; ++c) {
    DMPolytopeType type;
    PetscInt       vertices[8];
    PetscBool      within;

    PetscCall(GmshHasTag(dm, "Cell Sets", tag, c, &within));
    if (!within) continue;
    PetscCall(DMPlexGetCellType(dm, c, &type));
    PetscCheck(type == DM_POLYTOPE_HEXAHEDRON, PETSC_COMM_SELF, PETSC_ERR_USER_INPUT, "the volume \"%s\" of %s has cells of type %s; only hexahedra with 8 nodes are read", body->gmsh.volume, body->gmsh.file, DMPolytopeTypes[type]);
    PetscCall(MeshGetCellVertices(dm, c, vertices));
    for (PetscInt a = 0; a < 8; ++a) {
      if (number[vertices[a] - vstart] < 0) number[vertices[a] - vstart] = grid->nvertices++;
      grid->cells[8 * grid->ncells + a] = number[vertices[a] - vstart];
    }
    ++grid->ncells;
  }
  PetscCall(DMGetCoordinateSection(dm, &section));
  PetscCall(DMGetCoordinatesLocal(dm, &coordinates));
  PetscCall(VecGetArrayRead(coordinates, &x));
  PetscCall(PetscMalloc1(3 * grid->nvertices, &grid->coordinates));
  for (PetscInt v = vstart; v < vend; ++v) {
    PetscInt offset;

    if (number[v - vstart] < 0) continue;
    PetscCall(PetscSectionGetOffset(section, v, &offset));
    for (PetscInt d = 0; d < 3; ++d) grid->coordinates[3 * number[v - vstart] + d] = PetscRealPart(x[offset + d]);
  }
  PetscCall(VecRestoreArrayRead(coordinates, &x));
  PetscFunctionReturn(0);
}

/* A facet's vertices if it bounds the volume; a facet between two of its cells is inside */
static PetscErrorCode GmshGetBoundingFacet(DM dm, PetscInt volume, PetscInt facet, PetscInt vertices[4], PetscBool *bounds)
{
  const PetscInt *cells;
  PetscInt        ncells, nwithin = 0, npoints, n = 0, vstart, vend, *closure = NULL;

  PetscFunctionBegin;
  *bounds = PETSC_FALSE;
  PetscCall(DMPlexGetSupportSize(dm, facet, &ncells));
  PetscCall(DMPlexGetSupport(dm, facet, &cells));
  for (PetscInt c = 0; c < ncells; ++c) {
    PetscBool within;

    PetscCall(GmshHasTag(dm, "Cell Sets", volume, cells[c], &within));
    if (within) ++nwithin;
  }
  if (nwithin != 1) PetscFunctionReturn(0);
  PetscCall(DMPlexGetDepthStratum(dm, 0, &vstart, &vend));
  PetscCall(DMPlexGetTransitiveClosure(dm, facet, PETSC_TRUE, &npoints, &closure));
  for (PetscInt p = 0; p < npoints && n < 4; ++p) {
    if (closure[2 * p] >= vstart && closure[2 * p] < vend) vertices[n++] = closure[2 * p] - vstart;
  }
  PetscCall(DMPlexRestoreTransitiveClosure(dm, facet, PETSC_TRUE, &npoints, &closure));
  *bounds = PETSC_TRUE;
  PetscFunctionReturn(0);
}

/* A facet may be on several surfaces and is listed once for each */
static PetscErrorCode GmshCutSurfaces(DM dm, PetscInt volume, PetscInt nsurfaces, const PetscInt surfaces[], const PetscInt number[], ShapeGrid *grid)
{
  PetscInt       fstart, fend;
  PetscSegBuffer facets, facetface;

  PetscFunctionBegin;
  PetscCall(DMPlexGetHeightStratum(dm, 1, &fstart, &fend));
  PetscCall(PetscSegBufferCreate(sizeof(PetscInt), 1024, &facets));
  PetscCall(PetscSegBufferCreate(sizeof(PetscInt), 256, &facetface));
  for (PetscInt face = 0; face < nsurfaces; ++face) {
    for (PetscInt f = fstart; f < fend; ++f) {
      PetscInt  vertices[4] = {0}, *slot;
      PetscBool has;

      PetscCall(GmshHasTag(dm, "Face Sets", surfaces[face], f, &has));
      if (has) PetscCall(GmshGetBoundingFacet(dm, volume, f, vertices, &has));
      if (!has) continue;
      PetscCall(PetscSegBufferGetInts(facets, 4, &slot));
      for (PetscInt a = 0; a < 4; ++a) slot[a] = number[vertices[a]];
      PetscCall(PetscSegBufferGetInts(facetface, 1, &slot));
      *slot = face;
      ++grid->nfacets;
    }
  }
  PetscCall(PetscSegBufferExtractAlloc(facets, &grid->facets));
  PetscCall(PetscSegBufferExtractAlloc(facetface, &grid->facetface));
  PetscCall(PetscSegBufferDestroy(&facets));
  PetscCall(PetscSegBufferDestroy(&facetface));
  PetscFunctionReturn(0);
}

/* No two vertices are at one place: sorted along a direction in which hardly any vertices of a regular mesh coincide */
static PetscErrorCode GmshCheckVertices(const SceneBody *body, const ShapeGrid *grid)
{
  static const PetscReal direction[3] = {0.5773, 0.6180, 0.5342};
  const PetscReal       *x            = grid->coordinates;
  PetscReal              lower[3] = {PETSC_MAX_REAL, PETSC_MAX_REAL, PETSC_MAX_REAL}, upper[3] = {PETSC_MIN_REAL, PETSC_MIN_REAL, PETSC_MIN_REAL}, near = 0, *along;
  PetscInt              *order;

  PetscFunctionBegin;
  PetscCall(PetscMalloc2(grid->nvertices, &along, grid->nvertices, &order));
  for (PetscInt v = 0; v < grid->nvertices; ++v) {
    along[v] = 0;
    order[v] = v;
    for (PetscInt d = 0; d < 3; ++d) {
      lower[d] = PetscMin(lower[d], x[3 * v + d]);
      upper[d] = PetscMax(upper[d], x[3 * v + d]);
      along[v] += direction[d] * x[3 * v + d];
    }
  }
  for (PetscInt d = 0; d < 3; ++d) near = PetscMax(near, 1e-9 * (upper[d] - lower[d]));
  PetscCall(PetscSortRealWithArrayInt(grid->nvertices, along, order));
  for (PetscInt i = 0; i < grid->nvertices; ++i) {
    for (PetscInt j = i + 1; j < grid->nvertices && along[j] - along[i] <= 2 * near; ++j) {
      const PetscReal *a = x + 3 * order[i], *b = x + 3 * order[j];

      PetscCheck(PetscAbsReal(a[0] - b[0]) > near || PetscAbsReal(a[1] - b[1]) > near || PetscAbsReal(a[2] - b[2]) > near, PETSC_COMM_SELF, PETSC_ERR_USER_INPUT, "the volume \"%s\" of %s has two nodes at one place, (%g, %g, %g), so its cells do not hang together there", body->gmsh.volume, body->gmsh.file, (double)a[0], (double)a[1], (double)a[2]);
    }
  }
  PetscCall(PetscFree2(along, order));
  PetscFunctionReturn(0);
}

/* On rank 0; volume: its tag */
static PetscErrorCode GmshCutBody(DM dm, const SceneBody *body, PetscInt volume, PetscInt nsurfaces, const PetscInt surfaces[], ShapeGrid *grid)
{
  PetscInt vstart, vend, *number;

  PetscFunctionBegin;
  PetscCall(DMPlexGetDepthStratum(dm, 0, &vstart, &vend));
  PetscCall(PetscMalloc1(vend - vstart, &number));
  PetscCall(GmshCutVolume(dm, body, volume, number, grid));
  PetscCheck(grid->ncells, PETSC_COMM_SELF, PETSC_ERR_USER_INPUT, "the volume \"%s\" of %s has no cells", body->gmsh.volume, body->gmsh.file);
  PetscCall(GmshCutSurfaces(dm, volume, nsurfaces, surfaces, number, grid));
  PetscCall(GmshCheckVertices(body, grid));
  PetscCall(PetscFree(number));
  PetscFunctionReturn(0);
}

PetscErrorCode GmshFileGetGrid(MPI_Comm comm, GmshFile *file, const SceneBody *body, ShapeGrid *grid)
{
  RankError      error;
  PetscErrorCode ierr = 0;
  PetscInt       n, volume, *tags;
  char         **surfaces;

  PetscFunctionBegin;
  PetscCall(GmshGetVolumeTag(comm, body, &volume));
  PetscCall(GmshGetPhysicalNames(comm, body, 2, &n, &surfaces, &tags));
  PetscCall(RankErrorBegin(&error));
  if (file->dm) ierr = GmshCutBody(file->dm, body, volume, n, tags, grid);
  PetscCall(RankErrorEnd(comm, ierr, &error));
  PetscCheck(!error.code, comm, error.code, "Body \"%s\": %s", body->name, error.message);
  PetscCall(NamesDestroy(&n, &surfaces));
  PetscCall(PetscFree(tags));
  PetscFunctionReturn(0);
}
