/* Bodies from Gmsh files: read by PETSc on rank 0, cut out of its mesh volume by volume */
#include "mesh_private.h"
#include <petscviewer.h>
#include <stdio.h>
#include <string.h>

#define GMSH_SENTENCE 1024

static char gmsh_complaint[256];

/* PETSc's reader raises from deep inside, on rank 0 alone; the sentence is kept for ours */
static PetscErrorCode KeepComplaint(MPI_Comm comm, int line, const char *function, const char *file, PetscErrorCode n, PetscErrorType type, const char *message, void *context)
{
  (void)comm, (void)line, (void)function, (void)file, (void)context;
  if (type == PETSC_ERROR_INITIAL && message) (void)PetscStrncpy(gmsh_complaint, message, sizeof(gmsh_complaint));
  return n;
}

/* What rank 0 found wrong is everybody's error */
static PetscErrorCode RaiseSentence(MPI_Comm comm, char sentence[GMSH_SENTENCE])
{
  PetscFunctionBegin;
  PetscCallMPI(MPI_Bcast(sentence, GMSH_SENTENCE, MPI_CHAR, 0, comm));
  PetscCheck(!sentence[0], comm, PETSC_ERR_USER_INPUT, "%s", sentence);
  PetscFunctionReturn(0);
}

/* The names of one dimension from the section $PhysicalNames, joined by new lines as no name can hold one */
static PetscErrorCode ScanPhysicalNames(FILE *stream, PetscInt dim, size_t *length, char **joined)
{
  char      line[PETSC_MAX_PATH_LEN];
  PetscBool within = PETSC_FALSE;
  size_t    size   = 1;

  PetscFunctionBegin;
  PetscCall(PetscCalloc1(1, joined));
  while (fgets(line, sizeof(line), stream) && strncmp(line, "$Nodes", 6) && strncmp(line, "$Entities", 9) && strncmp(line, "$EndPhysicalNames", 17)) {
    char *begin = strchr(line, '"'), *end = strrchr(line, '"');
    int   here;

    if (!strncmp(line, "$PhysicalNames", 14)) within = PETSC_TRUE;
    if (!within || end == begin || sscanf(line, "%d", &here) != 1 || here != dim) continue;
    *end = '\n';
    end[1] = 0;
    PetscCall(PetscRealloc(size + strlen(begin + 1), joined));
    PetscCall(PetscArraycpy(*joined + size - 1, begin + 1, strlen(begin + 1) + 1));
    size += strlen(begin + 1);
  }
  *length = size;
  PetscFunctionReturn(0);
}

PetscErrorCode GmshGetPhysicalNames(MPI_Comm comm, const SceneBody *body, PetscInt dim, PetscInt *n, char ***names)
{
  char        sentence[GMSH_SENTENCE] = "", *joined = NULL, **words;
  PetscMPIInt rank;
  PetscInt64  length = 0;
  int         nwords;

  PetscFunctionBegin;
  PetscCallMPI(MPI_Comm_rank(comm, &rank));
  PetscCheck(body->gmsh.file, comm, PETSC_ERR_ARG_NULL, "Body \"%s\" names no mesh file", body->name);
  if (rank == 0) {
    FILE     *stream;
    size_t    size = 0;
    PetscBool exists;

    PetscCall(PetscTestFile(body->gmsh.file, 'r', &exists));
    stream = exists ? fopen(body->gmsh.file, "r") : NULL;
    if (stream) {
      PetscCall(ScanPhysicalNames(stream, dim, &size, &joined));
      (void)fclose(stream);
      length = (PetscInt64)size;
    } else PetscCall(PetscSNPrintf(sentence, sizeof(sentence), "Body \"%s\": there is no readable mesh file \"%s\"", body->name, body->gmsh.file));
  }
  PetscCall(RaiseSentence(comm, sentence));
  PetscCallMPI(MPI_Bcast(&length, 1, MPIU_INT64, 0, comm));
  if (rank) PetscCall(PetscMalloc1(length, &joined));
  PetscCallMPI(MPI_Bcast(joined, (PetscMPIInt)length, MPI_CHAR, 0, comm));
  PetscCall(PetscStrToArray(joined, '\n', &nwords, &words));
  *n = nwords;
  PetscCall(PetscMalloc1(*n, names));
  for (PetscInt i = 0; i < *n; ++i) PetscCall(PetscStrallocpy(words[i], &(*names)[i]));
  PetscCall(PetscStrToArrayDestroy(nwords, words));
  PetscCall(PetscFree(joined));
  PetscFunctionReturn(0);
}

/* On rank 0. PETSc's options are set on the viewer alone, so that the user's own meshes do not change */
static PetscErrorCode ReadFile(const char file[], DM *dm)
{
  PetscErrorCode ierr;
  PetscOptions   options;

  PetscFunctionBegin;
  PetscCall(PetscOptionsCreate(&options));
  PetscCall(PetscOptionsSetValue(options, "-dm_plex_gmsh_use_regions", "true"));
  PetscCall(PetscOptionsPush(options));
  gmsh_complaint[0] = 0;
  PetscCall(PetscPushErrorHandler(KeepComplaint, NULL));
  ierr = DMPlexCreateGmshFromFile(PETSC_COMM_SELF, file, PETSC_TRUE, dm);
  PetscCall(PetscPopErrorHandler());
  PetscCall(PetscOptionsPop());
  PetscCall(PetscOptionsDestroy(&options));
  if (ierr) *dm = NULL;
  PetscFunctionReturn(0);
}

/* A mesh of second order has coordinates on its edges */
static PetscErrorCode IsLinear(DM dm, PetscBool *linear)
{
  PetscSection section;
  PetscInt     estart, eend, pstart, pend, dof = 0;

  PetscFunctionBegin;
  PetscCall(DMGetCoordinateSection(dm, &section));
  PetscCall(DMPlexGetDepthStratum(dm, 1, &estart, &eend));
  PetscCall(PetscSectionGetChart(section, &pstart, &pend));
  if (eend > estart && estart >= pstart && estart < pend) PetscCall(PetscSectionGetDof(section, estart, &dof));
  *linear = dof ? PETSC_FALSE : PETSC_TRUE;
  PetscFunctionReturn(0);
}

PetscErrorCode GmshFileOpen(MPI_Comm comm, const SceneBody *body, GmshFile *file)
{
  char        sentence[GMSH_SENTENCE] = "";
  PetscMPIInt rank;
  PetscBool   same = PETSC_FALSE, linear = PETSC_TRUE;
  PetscInt    dim;

  PetscFunctionBegin;
  if (file->name) PetscCall(PetscStrcmp(file->name, body->gmsh.file, &same));
  if (same) PetscFunctionReturn(0);
  PetscCall(GmshFileClose(file));
  PetscCallMPI(MPI_Comm_rank(comm, &rank));
  if (rank == 0) {
    PetscCall(ReadFile(body->gmsh.file, &file->dm));
    if (!file->dm) PetscCall(PetscSNPrintf(sentence, sizeof(sentence), "Body \"%s\": %s is not a whole Gmsh mesh of 8-node hexahedra: %s", body->name, body->gmsh.file, gmsh_complaint[0] ? gmsh_complaint : "it cannot be read"));
    else {
      PetscCall(DMGetDimension(file->dm, &dim));
      PetscCall(IsLinear(file->dm, &linear));
      if (dim != 3) PetscCall(PetscSNPrintf(sentence, sizeof(sentence), "Body \"%s\": %s is a mesh of dimension %" PetscInt_FMT ", without volumes", body->name, body->gmsh.file, dim));
      else if (!linear) PetscCall(PetscSNPrintf(sentence, sizeof(sentence), "Body \"%s\": the cells of %s are not of first order; only hexahedra with 8 nodes are read", body->name, body->gmsh.file));
    }
  }
  PetscCall(RaiseSentence(comm, sentence));
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

/* The hexahedra of the body's volume with their vertices numbered anew; number: new number of each vertex, PETSC_DECIDE without one */
static PetscErrorCode CutVolume(DM dm, const SceneBody *body, DMLabel volume, PetscInt number[], ShapeGrid *grid, char sentence[GMSH_SENTENCE])
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
  for (PetscInt c = cstart; c < cend && !sentence[0]; ++c) {
    DMPolytopeType type;
    PetscInt       value, vertices[8];

    PetscCall(DMLabelGetValue(volume, c, &value));
    if (value < 0) continue;
    PetscCall(DMPlexGetCellType(dm, c, &type));
    if (type != DM_POLYTOPE_HEXAHEDRON) PetscCall(PetscSNPrintf(sentence, GMSH_SENTENCE, "Body \"%s\": the volume \"%s\" of %s has cells of type %s; only hexahedra with 8 nodes are read", body->name, body->gmsh.volume, body->gmsh.file, DMPolytopeTypes[type]));
    else {
      PetscCall(MeshGetCellVertices(dm, c, vertices));
      for (PetscInt a = 0; a < 8; ++a) {
        if (number[vertices[a] - vstart] < 0) number[vertices[a] - vstart] = grid->nvertices++;
        grid->cells[8 * grid->ncells + a] = number[vertices[a] - vstart];
      }
      ++grid->ncells;
    }
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
static PetscErrorCode GetBoundingFacet(DM dm, DMLabel volume, PetscInt facet, PetscInt vertices[4], PetscBool *bounds)
{
  const PetscInt *cells;
  PetscInt        ncells, nwithin = 0, npoints, n = 0, vstart, vend, *closure = NULL;

  PetscFunctionBegin;
  *bounds = PETSC_FALSE;
  PetscCall(DMPlexGetSupportSize(dm, facet, &ncells));
  PetscCall(DMPlexGetSupport(dm, facet, &cells));
  for (PetscInt c = 0; c < ncells; ++c) {
    PetscInt value;

    PetscCall(DMLabelGetValue(volume, cells[c], &value));
    if (value >= 0) ++nwithin;
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
static PetscErrorCode CutSurfaces(DM dm, DMLabel volume, PetscInt nfaces, char *const faces[], const PetscInt number[], ShapeGrid *grid)
{
  PetscInt       fstart, fend, nmax = 0;
  PetscSegBuffer facets, facetface;

  PetscFunctionBegin;
  PetscCall(DMPlexGetHeightStratum(dm, 1, &fstart, &fend));
  PetscCall(PetscSegBufferCreate(4 * sizeof(PetscInt), 256, &facets));
  PetscCall(PetscSegBufferCreate(sizeof(PetscInt), 256, &facetface));
  for (PetscInt face = 0; face < nfaces; ++face) {
    DMLabel surface;

    PetscCall(DMGetLabel(dm, faces[face], &surface));
    for (PetscInt f = fstart; f < fend && surface; ++f) {
      PetscInt  value, vertices[4], *slot;
      PetscBool bounds;

      PetscCall(DMLabelGetValue(surface, f, &value));
      if (value < 0) continue;
      PetscCall(GetBoundingFacet(dm, volume, f, vertices, &bounds));
      if (!bounds) continue;
      PetscCall(PetscSegBufferGetInts(facets, 1, &slot));
      for (PetscInt a = 0; a < 4; ++a) slot[a] = number[vertices[a]];
      PetscCall(PetscSegBufferGetInts(facetface, 1, &slot));
      *slot = face;
      ++nmax;
    }
  }
  grid->nfacets = nmax;
  PetscCall(PetscSegBufferExtractAlloc(facets, &grid->facets));
  PetscCall(PetscSegBufferExtractAlloc(facetface, &grid->facetface));
  PetscCall(PetscSegBufferDestroy(&facets));
  PetscCall(PetscSegBufferDestroy(&facetface));
  PetscFunctionReturn(0);
}

/* Two vertices at one place: sorted along a direction in which hardly any vertices of a regular mesh coincide */
static PetscErrorCode FindDuplicate(const SceneBody *body, const ShapeGrid *grid, char sentence[GMSH_SENTENCE])
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
  for (PetscInt i = 0; i < grid->nvertices && !sentence[0]; ++i) {
    for (PetscInt j = i + 1; j < grid->nvertices && along[j] - along[i] <= 2 * near; ++j) {
      const PetscReal *a = x + 3 * order[i], *b = x + 3 * order[j];

      if (PetscAbsReal(a[0] - b[0]) > near || PetscAbsReal(a[1] - b[1]) > near || PetscAbsReal(a[2] - b[2]) > near) continue;
      PetscCall(PetscSNPrintf(sentence, GMSH_SENTENCE, "Body \"%s\": the volume \"%s\" of %s has two nodes at one place, (%g, %g, %g), so its cells do not hang together there", body->name, body->gmsh.volume, body->gmsh.file, (double)a[0], (double)a[1], (double)a[2]));
      break;
    }
  }
  PetscCall(PetscFree2(along, order));
  PetscFunctionReturn(0);
}

static PetscErrorCode CutBody(DM dm, const SceneBody *body, PetscInt nfaces, char *const faces[], ShapeGrid *grid, char sentence[GMSH_SENTENCE])
{
  DMLabel  volume;
  PetscInt vstart, vend, *number;

  PetscFunctionBegin;
  PetscCall(DMGetLabel(dm, body->gmsh.volume, &volume));
  if (volume) {
    PetscCall(DMPlexGetDepthStratum(dm, 0, &vstart, &vend));
    PetscCall(PetscMalloc1(vend - vstart, &number));
    PetscCall(CutVolume(dm, body, volume, number, grid, sentence));
    if (!sentence[0]) PetscCall(CutSurfaces(dm, volume, nfaces, faces, number, grid));
    PetscCall(PetscFree(number));
  }
  if (!sentence[0] && !grid->ncells) PetscCall(PetscSNPrintf(sentence, GMSH_SENTENCE, "Body \"%s\": the volume \"%s\" of %s has no cells", body->name, body->gmsh.volume, body->gmsh.file));
  if (!sentence[0]) PetscCall(FindDuplicate(body, grid, sentence));
  PetscFunctionReturn(0);
}

PetscErrorCode GmshCheckVolume(MPI_Comm comm, const SceneBody *body)
{
  char      choices[GMSH_SENTENCE / 2] = "", **volumes;
  PetscInt  nvolumes;
  PetscBool known = PETSC_FALSE;

  PetscFunctionBegin;
  PetscCheck(body->gmsh.volume, comm, PETSC_ERR_ARG_NULL, "Body \"%s\" names no volume of its mesh file", body->name);
  PetscCall(GmshGetPhysicalNames(comm, body, 3, &nvolumes, &volumes));
  for (PetscInt v = 0; v < nvolumes; ++v) {
    PetscBool same;

    PetscCall(PetscStrcmp(volumes[v], body->gmsh.volume, &same));
    if (same) known = PETSC_TRUE;
  }
  PetscCall(MeshListNames(nvolumes, volumes, sizeof(choices), choices));
  PetscCall(MeshRestoreFaceNames(&nvolumes, &volumes));
  PetscCheck(known, comm, PETSC_ERR_USER_INPUT, "Body \"%s\": %s has no physical volume \"%s\"; it has: %s", body->name, body->gmsh.file, body->gmsh.volume, choices);
  PetscFunctionReturn(0);
}

PetscErrorCode GmshFileGetGrid(MPI_Comm comm, GmshFile *file, const SceneBody *body, PetscInt nfaces, char *const faces[], ShapeGrid *grid)
{
  char sentence[GMSH_SENTENCE] = "";

  PetscFunctionBegin;
  if (file->dm) PetscCall(CutBody(file->dm, body, nfaces, faces, grid, sentence));
  PetscCall(RaiseSentence(comm, sentence));
  PetscFunctionReturn(0);
}
