/* Physical names of a Gmsh file, which are read on rank 0 */
#include "gmshimpl.h"
#include "src/files/filesimpl.h"
#include <stdlib.h>
#include <string.h>

/* Returns whether the first section after comments is $MeshFormat, as in every Gmsh file */
static PetscBool GmshIsGmsh(FILE *stream)
{
  char      line[PETSC_MAX_PATH_LEN];
  PetscBool comments = PETSC_FALSE;

  while (fgets(line, sizeof(line), stream)) {
    const char *word = line + strspn(line, " \t\r\n");

    if (!comments && !strncmp(word, "$MeshFormat", 11)) return PETSC_TRUE;
    if (!strncmp(word, "$Comments", 9)) comments = PETSC_TRUE;
    else if (*word && !comments) return PETSC_FALSE;
    if (!strncmp(word, "$EndComments", 12)) comments = PETSC_FALSE;
  }
  return PETSC_FALSE;
}

/* Collects the entries of one dimension in the section $PhysicalNames as lines that consist of tag, blank and name */
static PetscErrorCode GmshScanPhysicalNames(FILE *stream, PetscInt dim, size_t *length, char **entries)
{
  char      line[PETSC_MAX_PATH_LEN], entry[PETSC_MAX_PATH_LEN];
  PetscBool within = PETSC_FALSE;

  PetscFunctionBegin;
  *length = 1;
  PetscCall(PetscCalloc1(*length, entries));
  while (fgets(line, sizeof(line), stream) && strncmp(line, "$Nodes", 6) && strncmp(line, "$Entities", 9) &&
         strncmp(line, "$EndPhysicalNames", 17)) {
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

/* Reads the physical names, on rank 0 */
static PetscErrorCode GmshReadPhysicalNames(const SceneBody *body, PetscInt dim, size_t *length, char **entries)
{
  FILE     *stream;
  PetscBool exists, gmsh;

  PetscFunctionBegin;
  PetscCall(PetscTestFile(GmshPath(body), 'r', &exists));
  stream = exists ? fopen(GmshPath(body), "r") : NULL;
  PetscCheck(stream, PETSC_COMM_SELF, PETSC_ERR_USER_INPUT, "there is no readable mesh file \"%s\"", body->gmsh.file);
  gmsh = GmshIsGmsh(stream);
  if (gmsh) PetscCall(GmshScanPhysicalNames(stream, dim, length, entries));
  (void)fclose(stream);
  PetscCheck(gmsh, PETSC_COMM_SELF, PETSC_ERR_USER_INPUT,
    "%s is not a Gmsh mesh (no $MeshFormat): give a mesh with the ending .msh, .inp, .med, .e, .exo or .vtu; mesh a "
    "geometry such as a STEP file first, for example by gmsh -3",
    body->gmsh.file);
  PetscFunctionReturn(0);
}

/* Collective. Gets the entries of one dimension on all ranks */
static PetscErrorCode GmshGetPhysicalEntries(MPI_Comm comm, const SceneBody *body, PetscInt dim, char **entries)
{
  PetscMPIInt rank;
  PetscInt64  length;
  size_t      size = 1; /* with the zero byte */

  PetscFunctionBegin;
  *entries = NULL;
  PetscCallMPI(MPI_Comm_rank(comm, &rank));
  SceneCheck(body->gmsh.file, comm, PETSC_ERR_ARG_NULL, body, "Body \"%s\" names no mesh file", body->name);
  RankCallFor(comm, rank == 0, GmshReadPhysicalNames(body, dim, &size, entries), "%sBody \"%s\": ", ScenePlace(body),
    body->name);
  length = (PetscInt64)size - 1;
  PetscCall(FileBroadcastText(comm, &length, entries));
  PetscFunctionReturn(0);
}

PetscErrorCode GmshGetPhysicalNames(MPI_Comm comm, const SceneBody *body, PetscInt dim, PetscInt *n, char ***names,
  PetscInt **tags)
{
  char *entries, **words;
  int   nwords;

  PetscFunctionBegin;
  PetscCall(GmshGetPhysicalEntries(comm, body, dim, &entries));
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

/* Collective. Gets the tag of the body's volume */
PetscErrorCode GmshGetVolumeTag(MPI_Comm comm, const SceneBody *body, PetscInt *tag)
{
  char      choices[512], **volumes;
  PetscInt  n, *tags;
  PetscBool any, known = PETSC_FALSE;

  PetscFunctionBegin;
  SceneCheck(body->gmsh.volume, comm, PETSC_ERR_ARG_NULL, body, "Body \"%s\" names no volume of its mesh file",
    body->name);
  PetscCall(GmshGetPhysicalNames(comm, body, 3, &n, &volumes, &tags));
  PetscCall(NamesJoin(n, volumes, sizeof(choices), choices));
  any = (PetscBool)(n > 0);
  for (PetscInt v = 0; v < n && !known; ++v) {
    PetscCall(PetscStrcmp(volumes[v], body->gmsh.volume, &known));
    if (known) *tag = tags[v];
  }
  PetscCall(NamesDestroy(&n, &volumes));
  PetscCall(PetscFree(tags));
  SceneCheck(any, comm, PETSC_ERR_USER_INPUT, body, "Body \"%s\": %s has no physical volumes; define \"%s\" in Gmsh",
    body->name, body->gmsh.file, body->gmsh.volume);
  SceneCheck(known, comm, PETSC_ERR_USER_INPUT, body, "Body \"%s\": %s has no physical volume \"%s\"; it has %s",
    body->name, body->gmsh.file, body->gmsh.volume, choices);
  PetscFunctionReturn(0);
}
