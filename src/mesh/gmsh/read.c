/* Reads a Gmsh file of format 2.2, 4.0 or 4.1, and checks every number in it. Words, numbers and blanks are read in the
   same order as by PETSc's reader. */
#include "gmshimpl.h"
#include <petscbt.h>
#include <string.h>

#define GMSH_MAX_TAGS 100

typedef struct {
  GmshStream     in;
  PetscInt       nentities[4];            /* number of entities of each dimension */
  PetscInt      *entities[4];             /* their numbers, sorted */
  PetscInt      *labels[4];               /* positions of their tags */
  PetscInt64     first, nnodes;           /* Node numbers are in [first, first + nnodes). */
  PetscBT        nodes;                   /* which of these numbers exist */
  PetscSegBuffer tags, elements, corners; /* tags, elements and nodes of the mesh that is being read */
  GmshMesh      *mesh;
} GmshReader;

/* Reads and checks the section $MeshFormat */
static PetscBool GmshCheckFormat(GmshReader *reader)
{
  char   words[3][GMSH_WORD], trailing;
  double version;
  int    one = 0;

  if (!GmshGetSection(&reader->in, words[0]) || !GmshExpect(&reader->in, "$MeshFormat", words[0])) return PETSC_FALSE;
  for (int i = 0; i < 3; ++i) {
    if (!GmshGetWord(&reader->in, words[i])) return PETSC_FALSE;
  }
  if (sscanf(words[0], "%lf%c", &version, &trailing) != 1 || (version != 2.2 && version != 4.0 && version != 4.1))
    return GmshWrong(&reader->in, "its format is \"%s\"; supported are 2.2, 4.0 and 4.1", words[0]);
  reader->in.version = (int)(10 * version + 0.5);
  if (strcmp(words[1], "0") && strcmp(words[1], "1"))
    return GmshWrong(&reader->in, "its file type is \"%s\", neither 0 for text nor 1 for binary", words[1]);
  reader->in.binary = words[1][0] == '1' ? PETSC_TRUE : PETSC_FALSE;
  if (strcmp(words[2], "8") && (reader->in.version < 41 || strcmp(words[2], "4")))
    return GmshWrong(&reader->in, "its data size is \"%s\"; supported is 8", words[2]);
  reader->in.width = words[2][0] - '0';
  if (reader->in.binary) {
    if (!GmshGetBytes(&reader->in, 4, &one)) return PETSC_FALSE;
    reader->in.swapped = one == 1 ? PETSC_FALSE : PETSC_TRUE;
    if (one != 1 && one != 1 << 24) return GmshWrong(&reader->in, "its byte order cannot be determined");
  }
  return GmshExpectNext(&reader->in, "$EndMeshFormat");
}

/* Reads and checks the section $PhysicalNames: a count, then a dimension, a tag and a quoted name for each */
static PetscBool GmshCheckNames(GmshReader *reader)
{
  PetscInt64 count = 0;
  char       words[2][GMSH_WORD], name[GMSH_WORD], trailing;
  int        number;

  if (!GmshGetCountWord(&reader->in, "physical names", &count)) return PETSC_FALSE;
  for (PetscInt64 i = 0; i < count; ++i) {
    const char *begin, *end;

    for (int j = 0; j < 2; ++j) {
      if (!GmshGetWord(&reader->in, words[j])) return PETSC_FALSE;
      if (sscanf(words[j], "%d%c", &number, &trailing) != 1)
        return GmshWrong(&reader->in, "a dimension and a tag are expected in $PhysicalNames instead of \"%s\"",
          words[j]);
    }
    if (!fgets(name, sizeof(name), reader->in.file)) return GmshWrong(&reader->in, "it ends too early");
    begin = strchr(name, '"');
    end   = strrchr(name, '"');
    if (!strchr(name, '\n') || begin != name || end == begin || end - begin > 127)
      return GmshWrong(&reader->in,
        "physical name %lld is not a dimension, a tag and a name of at most 126 characters in quotes",
        (long long)i + 1);
  }
  return GmshExpectNext(&reader->in, "$EndPhysicalNames");
}

/* Stores tags. *label: their position among the mesh's tags */
static PetscErrorCode GmshStoreTags(GmshReader *reader, PetscInt64 n, const PetscInt64 tags[], PetscInt *label)
{
  PetscSegBufferCount at;
  PetscInt           *slot;

  PetscFunctionBegin;
  PetscCall(PetscSegBufferGetSize(reader->tags, &at));
  PetscCall(PetscSegBufferGetInts(reader->tags, (PetscInt)n + 1, &slot));
  slot[0] = (PetscInt)n;
  for (PetscInt64 i = 0; i < n; ++i) slot[1 + i] = (PetscInt)tags[i];
  *label = (PetscInt)at;
  PetscFunctionReturn(0);
}

/* Reads an entity. *entity: its number; *label: position of its physical tags */
static PetscErrorCode GmshReadEntity(GmshReader *reader, int dim, PetscInt *entity, PetscInt *label, PetscBool *sound)
{
  PetscInt64 number = 0, ntags = 0, tags[16], bound;

  PetscFunctionBegin;
  *sound = GmshGetNumbers(&reader->in, 4, 1, &number) &&
               GmshGetReals(&reader->in, !dim && reader->in.version > 40 ? 3 : 6, NULL) &&
               GmshGetCounts(&reader->in, "tags", 1, &ntags)
             ? PETSC_TRUE
             : PETSC_FALSE;
  if (*sound && ntags > 16)
    *sound = GmshWrong(&reader->in, "entity %d of dimension %d has %lld physical tags, more than 16", (int)number, dim,
      (long long)ntags);
  if (*sound) *sound = GmshGetNumbers(&reader->in, 4, ntags, tags);
  if (!*sound) PetscFunctionReturn(0);
  *entity = (PetscInt)number;
  PetscCall(GmshStoreTags(reader, ntags, tags, label));
  if (dim) *sound = GmshGetCounts(&reader->in, "tags", 1, &ntags);
  for (PetscInt64 i = 0; dim && *sound && i < ntags; ++i) *sound = GmshGetNumbers(&reader->in, 4, 1, &bound);
  PetscFunctionReturn(0);
}

/* Reads the section $Entities */
static PetscErrorCode GmshReadEntities(GmshReader *reader, PetscBool *sound)
{
  PetscInt64 counts[4];

  PetscFunctionBegin;
  *sound = GmshGetCounts(&reader->in, "entities", 4, counts);
  for (int dim = 0; dim < 4 && *sound; ++dim) {
    PetscCall(PetscMalloc2(counts[dim], &reader->entities[dim], counts[dim], &reader->labels[dim]));
    reader->nentities[dim] = (PetscInt)counts[dim];
    for (PetscInt i = 0; i < reader->nentities[dim] && *sound; ++i)
      PetscCall(GmshReadEntity(reader, dim, &reader->entities[dim][i], &reader->labels[dim][i], sound));
    if (*sound) PetscCall(PetscSortIntWithArray(reader->nentities[dim], reader->entities[dim], reader->labels[dim]));
  }
  if (*sound) *sound = GmshExpectNext(&reader->in, "$EndEntities");
  PetscFunctionReturn(0);
}

/* Reads the header of a block of nodes or elements in formats 4. The entity of the block must exist. *label: position
   of the entity's tags; *last: the third number of the header */
static PetscErrorCode GmshReadBlock(GmshReader *reader, PetscInt64 *dim, PetscInt *label, PetscInt64 *last,
  PetscInt64 *count, PetscBool *sound)
{
  PetscInt64 info[3], entity;
  PetscInt   at = PETSC_DECIDE;

  PetscFunctionBegin;
  *sound =
    GmshGetNumbers(&reader->in, 4, 3, info) && GmshGetCounts(&reader->in, "nodes or elements in a block", 1, count)
      ? PETSC_TRUE
      : PETSC_FALSE;
  if (!*sound) PetscFunctionReturn(0);
  *dim   = info[reader->in.version == 40 ? 1 : 0];
  entity = info[reader->in.version == 40 ? 0 : 1];
  *last  = info[2];
  if (*dim >= 0 && *dim <= 3)
    PetscCall(PetscFindInt((PetscInt)entity, reader->nentities[*dim], reader->entities[*dim], &at));
  if (at < 0)
    *sound = GmshWrong(&reader->in, "a block belongs to the entity %lld of dimension %lld, which does not exist",
      (long long)entity, (long long)*dim);
  else *label = reader->labels[*dim][at];
  PetscFunctionReturn(0);
}

/* Marks the numbers of nodes as existing. Checks that they are in range, and that no number is repeated. */
static PetscErrorCode GmshMarkNodes(GmshReader *reader, PetscInt64 n, const PetscInt64 numbers[], PetscBool *sound)
{
  PetscInt64 first = PETSC_MAX_INT, last = 0;

  PetscFunctionBegin;
  for (PetscInt64 i = 0; i < n && *sound; ++i) {
    if (numbers[i] < 1 || numbers[i] >= PETSC_MAX_INT)
      *sound = GmshWrong(&reader->in, "%lld is not the number of a node", (long long)numbers[i]);
    first = PetscMin(first, numbers[i]);
    last  = PetscMax(last, numbers[i]);
  }
  if (!*sound) PetscFunctionReturn(0);
  reader->first  = first;
  reader->nnodes = last - first + 1;
  if (reader->nnodes > 1000000 + 100 * n)
    *sound = GmshWrong(&reader->in, "its %lld nodes have numbers from %lld to %lld: renumber them", (long long)n,
      (long long)first, (long long)last);
  if (!*sound) PetscFunctionReturn(0);
  PetscCall(PetscBTCreate((PetscInt)reader->nnodes, &reader->nodes));
  for (PetscInt64 i = 0; i < n && *sound; ++i) {
    if (PetscBTLookupSet(reader->nodes, (PetscInt)(numbers[i] - first)))
      *sound = GmshWrong(&reader->in, "the node %lld is defined twice", (long long)numbers[i]);
  }
  PetscFunctionReturn(0);
}

/* Reads the nodes of a block: their numbers and coordinates */
static PetscBool GmshGetNodesOfBlock(GmshReader *reader, PetscInt64 n, PetscInt64 numbers[], PetscReal x[])
{
  if (reader->in.version > 40)
    return GmshGetNumbers(&reader->in, reader->in.width, n, numbers) && GmshGetReals(&reader->in, 3 * n, x)
             ? PETSC_TRUE
             : PETSC_FALSE;
  for (PetscInt64 i = 0; i < n; ++i) {
    if (!GmshGetNumbers(&reader->in, 4, 1, &numbers[i]) || !GmshGetReals(&reader->in, 3, &x[3 * i])) return PETSC_FALSE;
  }
  return PETSC_TRUE;
}

/* Stores the numbers of nodes, which have been checked */
static PetscErrorCode GmshStoreNodes(GmshMesh *mesh, PetscInt64 n, const PetscInt64 numbers[])
{
  PetscFunctionBegin;
  PetscCall(PetscMalloc2(n, &mesh->number, n, &mesh->place));
  mesh->nnodes = (PetscInt)n;
  for (PetscInt i = 0; i < mesh->nnodes; ++i) {
    mesh->number[i] = (PetscInt)numbers[i];
    mesh->place[i]  = i;
  }
  PetscCall(PetscSortIntWithArray(mesh->nnodes, mesh->number, mesh->place));
  PetscFunctionReturn(0);
}

/* Reads the number of blocks, and the number of nodes or elements in them. Format 2 has one block. Format 4.1 also
   gives the range of the numbers, on which PETSc relies. */
static PetscErrorCode GmshGetBlocks(GmshReader *reader, const char what[], PetscInt64 *nblocks, PetscInt64 *count,
  PetscInt64 range[2], PetscBool *sound)
{
  PetscInt64 sizes[2];

  PetscFunctionBegin;
  if (reader->in.version < 40) {
    *nblocks = 1;
    *sound   = GmshGetCountWord(&reader->in, what, count);
  } else {
    *sound   = GmshGetCounts(&reader->in, what, 2, sizes) &&
                 (reader->in.version == 40 || GmshGetNumbers(&reader->in, reader->in.width, 2, range))
                 ? PETSC_TRUE
                 : PETSC_FALSE;
    *nblocks = sizes[0];
    *count   = sizes[1];
  }
  if (*sound && !*count) *sound = GmshWrong(&reader->in, "it has no %s", what);
  PetscFunctionReturn(0);
}

/* Reads and checks the section $Nodes */
static PetscErrorCode GmshCheckNodes(GmshReader *reader, PetscBool *sound)
{
  PetscInt64 nblocks, total, n = 0, *numbers, range[2] = {0, PETSC_MAX_INT};

  PetscFunctionBegin;
  PetscCall(GmshGetBlocks(reader, "nodes", &nblocks, &total, range, sound));
  if (!*sound) PetscFunctionReturn(0);
  PetscCall(PetscMalloc1(total, &numbers));
  PetscCall(PetscMalloc1(3 * total, &reader->mesh->x));
  for (PetscInt64 b = 0; b < nblocks && *sound; ++b) {
    PetscInt64 dim, parametric = 0, count = total;
    PetscInt   label;

    if (reader->in.version >= 40) PetscCall(GmshReadBlock(reader, &dim, &label, &parametric, &count, sound));
    if (*sound && parametric)
      *sound = GmshWrong(&reader->in, "its nodes have parametric coordinates, which are not read");
    if (*sound && n + count > total)
      *sound = GmshWrong(&reader->in, "its blocks have more nodes than the %lld it announces", (long long)total);
    if (*sound) *sound = GmshGetNodesOfBlock(reader, count, numbers + n, reader->mesh->x + 3 * n);
    n += count;
  }
  if (*sound && n != total)
    *sound = GmshWrong(&reader->in, "it has %lld nodes, but announces %lld", (long long)n, (long long)total);
  if (*sound) PetscCall(GmshMarkNodes(reader, total, numbers, sound));
  if (*sound && (range[0] > reader->first || range[1] < reader->first + reader->nnodes - 1 ||
                  (reader->in.version > 40 && range[1] - range[0] > 1000000 + 100 * total)))
    *sound = GmshWrong(&reader->in, "the numbers of its nodes run from %lld to %lld, but it announces %lld to %lld",
      (long long)reader->first, (long long)(reader->first + reader->nnodes - 1), (long long)range[0],
      (long long)range[1]);
  if (*sound) PetscCall(GmshStoreNodes(reader->mesh, total, numbers));
  PetscCall(PetscFree(numbers));
  if (*sound) *sound = GmshExpectNext(&reader->in, "$EndNodes");
  PetscFunctionReturn(0);
}

static PetscBool GmshReadType(GmshReader *reader, PetscInt64 number, const GmshType **type)
{
  *type = GmshGetType(number);
  return *type ? PETSC_TRUE
               : GmshWrong(&reader->in,
                   "it has elements of Gmsh's type %lld, which are neither of first nor of second order",
                   (long long)number);
}

/* Checks that the nodes of an element exist, and that none is repeated */
static PetscBool GmshCheckElement(GmshReader *reader, PetscInt64 element, PetscInt64 n, const PetscInt64 nodes[])
{
  for (PetscInt64 i = 0; i < n; ++i) {
    const PetscInt64 at = nodes[i] - reader->first;

    if (at < 0 || at >= reader->nnodes || !PetscBTLookup(reader->nodes, (PetscInt)at))
      return GmshWrong(&reader->in, "the element %lld names the node %lld, which does not exist", (long long)element,
        (long long)nodes[i]);
    for (PetscInt64 j = 0; j < i; ++j) {
      if (nodes[i] == nodes[j])
        return GmshWrong(&reader->in, "the element %lld names the node %lld twice", (long long)element,
          (long long)nodes[i]);
    }
  }
  return PETSC_TRUE;
}

/* Stores an element. label: position of its tags */
static PetscErrorCode GmshStoreElement(GmshReader *reader, const GmshType *type, PetscInt label, PetscInt64 number,
  const PetscInt64 nodes[])
{
  GmshElement        *element;
  PetscSegBufferCount first;
  PetscInt           *slot;

  PetscFunctionBegin;
  PetscCall(PetscSegBufferGetSize(reader->corners, &first));
  PetscCall(PetscSegBufferGet(reader->elements, 1, &element));
  *element = (GmshElement){.type = type, .label = label, .first = (PetscInt)first, .number = number};
  PetscCall(PetscSegBufferGetInts(reader->corners, (PetscInt)type->nnodes, &slot));
  for (PetscInt64 i = 0; i < type->nnodes; ++i) slot[i] = (PetscInt)nodes[i];
  reader->mesh->dim = PetscMax(reader->mesh->dim, (PetscInt)type->dim);
  ++reader->mesh->nelements;
  PetscFunctionReturn(0);
}

/* Reads the elements of format 2. Text files give the type and the number of tags for each element; binary files give
   them for several successive elements. The first tag is the physical one. */
static PetscErrorCode GmshReadElements2(GmshReader *reader, PetscInt64 total, PetscBool *sound)
{
  PetscFunctionBegin;
  for (PetscInt64 c = 0; c < total && *sound;) {
    PetscInt64      head[3] = {0}, count, numbers[1 + GMSH_MAX_TAGS + GMSH_MAX_NODES];
    const GmshType *type    = NULL;

    *sound = GmshGetNumbers(&reader->in, 4, 3, head);
    count  = reader->in.binary ? head[1] : 1;
    if (*sound) *sound = GmshReadType(reader, reader->in.binary ? head[0] : head[1], &type);
    if (*sound && (head[2] < 0 || head[2] > GMSH_MAX_TAGS))
      *sound = GmshWrong(&reader->in, "an element has %lld tags", (long long)head[2]);
    if (*sound && (count < 1 || c + count > total))
      *sound = GmshWrong(&reader->in, "it has more elements than the %lld it announces", (long long)total);
    for (PetscInt64 i = 0; i < count && *sound; ++i, ++c) {
      const PetscInt64 *nodes = numbers + 1 + head[2];
      PetscInt          label;

      numbers[0] = head[0];
      *sound     = GmshGetNumbers(&reader->in, 4, (reader->in.binary ? 1 : 0) + head[2] + type->nnodes,
                     numbers + (reader->in.binary ? 0 : 1)) &&
                   GmshCheckElement(reader, numbers[0], type->nnodes, nodes)
                     ? PETSC_TRUE
                     : PETSC_FALSE;
      if (!*sound) break;
      PetscCall(GmshStoreTags(reader, PetscMin(1, head[2]), numbers + 1, &label));
      PetscCall(GmshStoreElement(reader, type, label, numbers[0], nodes));
    }
  }
  PetscFunctionReturn(0);
}

/* Reads the elements of formats 4 */
static PetscErrorCode GmshReadElements4(GmshReader *reader, PetscInt64 nblocks, PetscInt64 total, PetscBool *sound)
{
  PetscInt64 c = 0;

  PetscFunctionBegin;
  for (PetscInt64 b = 0; b < nblocks && *sound; ++b) {
    PetscInt64      dim = 0, number = 0, count = 0;
    PetscInt        label = 0;
    const GmshType *type  = NULL;

    PetscCall(GmshReadBlock(reader, &dim, &label, &number, &count, sound));
    if (*sound) *sound = GmshReadType(reader, number, &type);
    if (*sound && dim != type->dim)
      *sound = GmshWrong(&reader->in, "an entity of dimension %lld has elements of dimension %lld", (long long)dim,
        (long long)type->dim);
    if (*sound && c + count > total)
      *sound = GmshWrong(&reader->in, "its blocks have more elements than the %lld it announces", (long long)total);
    for (PetscInt64 i = 0; i < count && *sound; ++i, ++c) {
      PetscInt64 numbers[1 + GMSH_MAX_NODES];

      *sound =
        GmshGetNumbers(&reader->in, reader->in.version == 40 ? 4 : reader->in.width, 1 + type->nnodes, numbers) &&
            GmshCheckElement(reader, numbers[0], type->nnodes, numbers + 1)
          ? PETSC_TRUE
          : PETSC_FALSE;
      if (*sound) PetscCall(GmshStoreElement(reader, type, label, numbers[0], numbers + 1));
    }
  }
  if (*sound && c != total)
    *sound = GmshWrong(&reader->in, "it has %lld elements, but announces %lld", (long long)c, (long long)total);
  PetscFunctionReturn(0);
}

static PetscErrorCode GmshReadElements(GmshReader *reader, PetscBool *sound)
{
  PetscInt64 nblocks, total, range[2];

  PetscFunctionBegin;
  PetscCall(GmshGetBlocks(reader, "elements", &nblocks, &total, range, sound));
  if (*sound && reader->in.version < 40) PetscCall(GmshReadElements2(reader, total, sound));
  else if (*sound) PetscCall(GmshReadElements4(reader, nblocks, total, sound));
  if (*sound) *sound = GmshExpectNext(&reader->in, "$EndElements");
  PetscFunctionReturn(0);
}

/* Reads all sections of the file */
static PetscErrorCode GmshReadSections(GmshReader *reader)
{
  char      word[GMSH_WORD];
  PetscBool sound;

  PetscFunctionBegin;
  sound = GmshCheckFormat(reader) && GmshGetSection(&reader->in, word) ? PETSC_TRUE : PETSC_FALSE;
  if (sound && !strcmp(word, "$PhysicalNames"))
    sound = GmshCheckNames(reader) && GmshGetSection(&reader->in, word) ? PETSC_TRUE : PETSC_FALSE;
  if (sound && reader->in.version >= 40) {
    sound = GmshExpect(&reader->in, "$Entities", word);
    if (sound) PetscCall(GmshReadEntities(reader, &sound));
    if (sound) sound = GmshGetSection(&reader->in, word);
  }
  if (sound) sound = GmshExpect(&reader->in, "$Nodes", word);
  if (sound) PetscCall(GmshCheckNodes(reader, &sound));
  if (sound)
    sound = GmshGetSection(&reader->in, word) && GmshExpect(&reader->in, "$Elements", word) ? PETSC_TRUE : PETSC_FALSE;
  if (sound) PetscCall(GmshReadElements(reader, &sound));
  PetscFunctionReturn(0);
}

/* Checks the facets of all cells, slice by slice */
static PetscErrorCode GmshCheckFacets(const GmshMesh *mesh, GmshStream *in)
{
  GmshFacets facets;
  PetscBool  agree;

  PetscFunctionBegin;
  GmshFacetsBegin(&facets, mesh->nelements);
  do {
    for (PetscInt e = 0; e < mesh->nelements; ++e) {
      const GmshElement *element = &mesh->elements[e];
      PetscInt64         corners[8];

      for (PetscInt a = 0; a < PetscMin(8, element->type->ncorners); ++a) corners[a] = mesh->nodes[element->first + a];
      PetscCall(GmshFacetsAdd(element->type, element->number, corners, &facets));
    }
    GmshFacetsSort(&facets);
    agree = GmshFacetsAgree(&facets, in);
  } while (agree && GmshFacetsNext(&facets));
  PetscCall(GmshFacetsDestroy(&facets));
  PetscFunctionReturn(0);
}

PetscErrorCode GmshMeshRead(const char file[], GmshMesh *mesh, size_t length, char sentence[])
{
  GmshReader reader = {.in = {.sentence = sentence, .length = length}, .mesh = mesh};

  PetscFunctionBegin;
  sentence[0] = 0;
  PetscCall(PetscSegBufferCreate(sizeof(PetscInt), 1024, &reader.tags));
  PetscCall(PetscSegBufferCreate(sizeof(PetscInt), 1024, &reader.corners));
  PetscCall(PetscSegBufferCreate(sizeof(GmshElement), 256, &reader.elements));
  reader.in.file = fopen(file, "r");
  if (!reader.in.file || fseek(reader.in.file, 0, SEEK_END)) (void)GmshWrong(&reader.in, "it cannot be read");
  else {
    reader.in.size = (PetscInt64)ftell(reader.in.file);
    rewind(reader.in.file);
    PetscCall(GmshReadSections(&reader));
  }
  if (reader.in.file) (void)fclose(reader.in.file);
  PetscCall(PetscSegBufferExtractAlloc(reader.tags, &mesh->tags));
  PetscCall(PetscSegBufferExtractAlloc(reader.corners, &mesh->nodes));
  PetscCall(PetscSegBufferExtractAlloc(reader.elements, &mesh->elements));
  PetscCall(PetscSegBufferDestroy(&reader.tags));
  PetscCall(PetscSegBufferDestroy(&reader.corners));
  PetscCall(PetscSegBufferDestroy(&reader.elements));
  for (int dim = 0; dim < 4; ++dim) PetscCall(PetscFree2(reader.entities[dim], reader.labels[dim]));
  PetscCall(PetscBTDestroy(&reader.nodes));
  if (!sentence[0]) PetscCall(GmshCheckFacets(mesh, &reader.in));
  PetscFunctionReturn(0);
}

PetscErrorCode GmshMeshDestroy(GmshMesh *mesh)
{
  PetscFunctionBegin;
  PetscCall(PetscFree2(mesh->number, mesh->place));
  PetscCall(PetscFree(mesh->x));
  PetscCall(PetscFree(mesh->tags));
  PetscCall(PetscFree(mesh->nodes));
  PetscCall(PetscFree(mesh->elements));
  PetscCall(PetscMemzero(mesh, sizeof(*mesh)));
  PetscFunctionReturn(0);
}

/* Returns whether `tag` is one of the element's physical tags */
PetscBool GmshMeshHasTag(const GmshMesh *mesh, const GmshElement *element, PetscInt tag)
{
  const PetscInt *tags = mesh->tags + element->label;

  for (PetscInt i = 0; i < tags[0]; ++i) {
    if (tags[1 + i] == tag) return PETSC_TRUE;
  }
  return PETSC_FALSE;
}

/* Gets the position among the coordinates of the node with this number, which must exist */
PetscErrorCode GmshMeshFindNode(const GmshMesh *mesh, PetscInt number, PetscInt *place)
{
  PetscInt at;

  PetscFunctionBegin;
  PetscCall(PetscFindInt(number, mesh->nnodes, mesh->number, &at));
  *place = mesh->place[at];
  PetscFunctionReturn(0);
}
