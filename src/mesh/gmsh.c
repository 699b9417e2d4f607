/* Bodies from Gmsh files: read by PETSc on rank 0, cut out of its mesh volume by volume */
#include "mesh_private.h"
#include <petscviewer.h>
#include <stdio.h>
#include <stdlib.h>
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

/* The entries of one dimension in the section $PhysicalNames, each as tag, blank, name, new line */
static PetscErrorCode ScanPhysicalNames(FILE *stream, PetscInt dim, size_t *length, char **entries)
{
  char      line[PETSC_MAX_PATH_LEN], entry[PETSC_MAX_PATH_LEN];
  PetscBool within = PETSC_FALSE;

  PetscFunctionBegin;
  *length = 1;
  PetscCall(PetscCalloc1(*length, entries));
  while (fgets(line, sizeof(line), stream) && strncmp(line, "$Nodes", 6) && strncmp(line, "$Entities", 9) && strncmp(line, "$EndPhysicalNames", 17)) {
    char  *begin = strchr(line, '"'), *end = strrchr(line, '"');
    int    here, tag;
    size_t n;

    if (!strncmp(line, "$PhysicalNames", 14)) within = PETSC_TRUE;
    if (!within || end == begin || sscanf(line, "%d %d", &here, &tag) != 2 || here != dim) continue;
    PetscCall(PetscSNPrintf(entry, sizeof(entry), "%d %.*s\n", tag, (int)(end - begin - 1), begin + 1));
    n = strlen(entry);
    PetscCall(PetscRealloc(*length + n, entries));
    PetscCall(PetscArraycpy(*entries + *length - 1, entry, n + 1));
    *length += n;
  }
  PetscFunctionReturn(0);
}

/* The entries of one dimension on all ranks, whoever the file belongs to */
static PetscErrorCode GetPhysicalEntries(MPI_Comm comm, const SceneBody *body, PetscInt dim, char **entries)
{
  char        sentence[GMSH_SENTENCE] = "";
  PetscMPIInt rank;
  PetscInt64  length = 0;

  PetscFunctionBegin;
  *entries = NULL;
  PetscCallMPI(MPI_Comm_rank(comm, &rank));
  PetscCheck(body->gmsh.file, comm, PETSC_ERR_ARG_NULL, "Body \"%s\" names no mesh file", body->name);
  if (rank == 0) {
    FILE     *stream;
    size_t    size = 0;
    PetscBool exists;

    PetscCall(PetscTestFile(body->gmsh.file, 'r', &exists));
    stream = exists ? fopen(body->gmsh.file, "r") : NULL;
    if (stream) {
      PetscCall(ScanPhysicalNames(stream, dim, &size, entries));
      (void)fclose(stream);
      length = (PetscInt64)size;
    } else PetscCall(PetscSNPrintf(sentence, sizeof(sentence), "Body \"%s\": there is no readable mesh file \"%s\"", body->name, body->gmsh.file));
  }
  PetscCall(RaiseSentence(comm, sentence));
  PetscCallMPI(MPI_Bcast(&length, 1, MPIU_INT64, 0, comm));
  if (rank) PetscCall(PetscMalloc1(length, entries));
  PetscCallMPI(MPI_Bcast(*entries, (PetscMPIInt)length, MPI_CHAR, 0, comm));
  PetscFunctionReturn(0);
}

PetscErrorCode GmshGetPhysicalNames(MPI_Comm comm, const SceneBody *body, PetscInt dim, PetscInt *n, char ***names, PetscInt **tags)
{
  char *entries, **words;
  int   nwords;

  PetscFunctionBegin;
  PetscCall(GetPhysicalEntries(comm, body, dim, &entries));
  PetscCall(PetscStrToArray(entries, '\n', &nwords, &words));
  *n = nwords;
  PetscCall(PetscMalloc1(*n, names));
  if (tags) PetscCall(PetscMalloc1(*n, tags));
  for (PetscInt i = 0; i < *n; ++i) {
    char      *end;
    const long tag = strtol(words[i], &end, 10);

    if (tags) (*tags)[i] = (PetscInt)tag;
    PetscCall(PetscStrallocpy(end + 1, &(*names)[i]));
  }
  PetscCall(PetscStrToArrayDestroy(nwords, words));
  PetscCall(PetscFree(entries));
  PetscFunctionReturn(0);
}

/* On rank 0. PETSc labels cells and facets with their physical tags: in formats 4 these are the tags of their entities, in format 2
   the first of their own, which the number of the entity follows. (Its labels by name would take that for a tag.)
   The options are not the user's, whose own meshes must not change */
static PetscErrorCode ReadFile(const char file[], DM *dm)
{
  PetscErrorCode ierr;
  PetscOptions   options;
  FILE          *stream = fopen(file, "r");
  float          version = 0;

  PetscFunctionBegin;
  if (stream) {
    if (fscanf(stream, "$MeshFormat %f", &version) != 1) version = 0;
    (void)fclose(stream);
  }
  PetscCall(PetscOptionsCreate(&options));
  PetscCall(PetscOptionsSetValue(options, "-dm_plex_gmsh_multiple_tags", version >= 4 ? "true" : "false"));
  PetscCall(PetscOptionsSetValue(options, "-dm_plex_gmsh_periodic", "false"));
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

PetscErrorCode GmshFileOpen(MPI_Comm comm, const SceneBody *body, GmshFile *file)
{
  char        sentence[GMSH_SENTENCE] = "";
  PetscMPIInt rank;
  PetscBool   same = PETSC_FALSE;
  PetscInt    dim;

  PetscFunctionBegin;
  if (file->name) PetscCall(PetscStrcmp(file->name, body->gmsh.file, &same));
  if (same) PetscFunctionReturn(0);
  PetscCall(GmshFileClose(file));
  PetscCallMPI(MPI_Comm_rank(comm, &rank));
  if (rank == 0) {
    PetscCall(GmshCheckFile(body->gmsh.file, sizeof(gmsh_complaint), gmsh_complaint));
    if (!gmsh_complaint[0]) PetscCall(ReadFile(body->gmsh.file, &file->dm));
    if (!file->dm) PetscCall(PetscSNPrintf(sentence, sizeof(sentence), "Body \"%s\": %s is not a whole Gmsh mesh of 8-node hexahedra: %s", body->name, body->gmsh.file, gmsh_complaint[0] ? gmsh_complaint : "it cannot be read"));
    else {
      PetscCall(DMGetDimension(file->dm, &dim));
      if (dim != 3) PetscCall(PetscSNPrintf(sentence, sizeof(sentence), "Body \"%s\": %s is a mesh of dimension %" PetscInt_FMT ", without volumes", body->name, body->gmsh.file, dim));
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

static PetscErrorCode HasTag(DM dm, const char sets[], PetscInt tag, PetscInt point, PetscBool *has)
{
  DMLabel label;

  PetscFunctionBegin;
  *has = PETSC_FALSE;
  PetscCall(DMGetLabel(dm, sets, &label));
  if (label) PetscCall(DMLabelStratumHasPoint(label, tag, point, has));
  PetscFunctionReturn(0);
}

/* The hexahedra of the body's volume with their vertices numbered anew; number: new number of each vertex, PETSC_DECIDE without one */
static PetscErrorCode CutVolume(DM dm, const SceneBody *body, PetscInt tag, PetscInt number[], ShapeGrid *grid, char sentence[GMSH_SENTENCE])
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
    PetscInt       vertices[8];
    PetscBool      within;

    PetscCall(HasTag(dm, "Cell Sets", tag, c, &within));
    if (!within) continue;
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
static PetscErrorCode GetBoundingFacet(DM dm, PetscInt volume, PetscInt facet, PetscInt vertices[4], PetscBool *bounds)
{
  const PetscInt *cells;
  PetscInt        ncells, nwithin = 0, npoints, n = 0, vstart, vend, *closure = NULL;

  PetscFunctionBegin;
  *bounds = PETSC_FALSE;
  PetscCall(DMPlexGetSupportSize(dm, facet, &ncells));
  PetscCall(DMPlexGetSupport(dm, facet, &cells));
  for (PetscInt c = 0; c < ncells; ++c) {
    PetscBool within;

    PetscCall(HasTag(dm, "Cell Sets", volume, cells[c], &within));
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
static PetscErrorCode CutSurfaces(DM dm, PetscInt volume, PetscInt nsurfaces, const PetscInt surfaces[], const PetscInt number[], ShapeGrid *grid)
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

      PetscCall(HasTag(dm, "Face Sets", surfaces[face], f, &has));
      if (has) PetscCall(GetBoundingFacet(dm, volume, f, vertices, &has));
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

/* On rank 0; volume: its tag */
static PetscErrorCode CutBody(DM dm, const SceneBody *body, PetscInt volume, PetscInt nsurfaces, const PetscInt surfaces[], ShapeGrid *grid, char sentence[GMSH_SENTENCE])
{
  PetscInt vstart, vend, *number;

  PetscFunctionBegin;
  PetscCall(DMPlexGetDepthStratum(dm, 0, &vstart, &vend));
  PetscCall(PetscMalloc1(vend - vstart, &number));
  PetscCall(CutVolume(dm, body, volume, number, grid, sentence));
  if (!sentence[0] && !grid->ncells) PetscCall(PetscSNPrintf(sentence, GMSH_SENTENCE, "Body \"%s\": the volume \"%s\" of %s has no cells", body->name, body->gmsh.volume, body->gmsh.file));
  if (!sentence[0]) PetscCall(CutSurfaces(dm, volume, nsurfaces, surfaces, number, grid));
  if (!sentence[0]) PetscCall(FindDuplicate(body, grid, sentence));
  PetscCall(PetscFree(number));
  PetscFunctionReturn(0);
}

/* The tag of the body's volume */
static PetscErrorCode GetVolumeTag(MPI_Comm comm, const SceneBody *body, PetscInt *tag)
{
  char      choices[GMSH_SENTENCE / 2], **volumes;
  PetscInt  n, *tags;
  PetscBool known = PETSC_FALSE;

  PetscFunctionBegin;
  PetscCheck(body->gmsh.volume, comm, PETSC_ERR_ARG_NULL, "Body \"%s\" names no volume of its mesh file", body->name);
  PetscCall(GmshGetPhysicalNames(comm, body, 3, &n, &volumes, &tags));
  PetscCall(MeshListNames(n, volumes, sizeof(choices), choices));
  for (PetscInt v = 0; v < n && !known; ++v) {
    PetscCall(PetscStrcmp(volumes[v], body->gmsh.volume, &known));
    if (known) *tag = tags[v];
  }
  PetscCall(MeshRestoreFaceNames(&n, &volumes));
  PetscCall(PetscFree(tags));
  PetscCheck(known, comm, PETSC_ERR_USER_INPUT, "Body \"%s\": %s has no physical volume \"%s\"; it has: %s", body->name, body->gmsh.file, body->gmsh.volume, choices);
  PetscFunctionReturn(0);
}

PetscErrorCode GmshCheckVolume(MPI_Comm comm, const SceneBody *body)
{
  PetscInt tag;

  PetscFunctionBegin;
  PetscCall(GetVolumeTag(comm, body, &tag));
  PetscFunctionReturn(0);
}

PetscErrorCode GmshFileGetGrid(MPI_Comm comm, GmshFile *file, const SceneBody *body, ShapeGrid *grid)
{
  char     sentence[GMSH_SENTENCE] = "", **surfaces;
  PetscInt n, volume, *tags;

  PetscFunctionBegin;
  PetscCall(GetVolumeTag(comm, body, &volume));
  PetscCall(GmshGetPhysicalNames(comm, body, 2, &n, &surfaces, &tags));
  if (file->dm) PetscCall(CutBody(file->dm, body, volume, n, tags, grid, sentence));
  PetscCall(RaiseSentence(comm, sentence));
  PetscCall(MeshRestoreFaceNames(&n, &surfaces));
  PetscCall(PetscFree(tags));
  PetscFunctionReturn(0);
}
