/* Is a Gmsh file what it says it is? PETSc's reader trusts the numbers of nodes, elements and entities in it, and a wrong one
   is an address out of bounds there. The walk is PETSc's own: the same words, numbers and blanks in the same order */
#include "meshimpl.h"
#include <petscbt.h>
#include <stdlib.h>
#include <string.h>

#define GMSH_MAX_TAGS 100

/* A quadrilateral of a cell: its nodes in ascending order, and the one across from the first */
typedef struct {
  PetscInt64 nodes[4], across, element;
} GmshFacet;

typedef struct {
  GmshStream in;
  PetscInt   nentities[4], *entities[4]; /* numbers of the entities of each dimension, sorted */
  PetscInt64 first, nnodes;              /* numbers of the nodes lie in [first, first + nnodes) */
  PetscBT    nodes;                      /* those that exist */
  PetscInt64 nfacets, maxfacets;
  GmshFacet *facets; /* quadrilaterals of all cells */
} GmshCheck;

static PetscBool GmshCheckFormat(GmshCheck *check)
{
  char   words[3][GMSH_WORD], rest;
  double version;
  int    one = 0;

  if (!GmshGetSection(&check->in, words[0]) || !GmshExpect(&check->in, "$MeshFormat", words[0])) return PETSC_FALSE;
  for (int i = 0; i < 3; ++i) {
    if (!GmshGetWord(&check->in, words[i])) return PETSC_FALSE;
  }
  if (sscanf(words[0], "%lf%c", &version, &rest) != 1 || (version != 2.2 && version != 4.0 && version != 4.1)) return GmshWrong(&check->in, "its format is \"%s\"; 2.2, 4.0 and 4.1 are read", words[0]);
  check->in.version = (int)(10 * version + 0.5);
  if (strcmp(words[1], "0") && strcmp(words[1], "1")) return GmshWrong(&check->in, "its file type is \"%s\", neither 0 for text nor 1 for binary", words[1]);
  check->in.binary = words[1][0] == '1' ? PETSC_TRUE : PETSC_FALSE;
  if (strcmp(words[2], "8") && (check->in.version < 41 || strcmp(words[2], "4"))) return GmshWrong(&check->in, "its data size is \"%s\"; 8 is read", words[2]);
  check->in.width = words[2][0] - '0';
  if (check->in.binary) {
    if (!GmshGetBytes(&check->in, 4, &one)) return PETSC_FALSE;
    check->in.swapped = one == 1 ? PETSC_FALSE : PETSC_TRUE;
    if (one != 1 && one != 1 << 24) return GmshWrong(&check->in, "the order of its bytes cannot be told");
  }
  return GmshExpectNext(&check->in, "$EndMeshFormat");
}

/* A number, then a dimension, a tag and a name in quotes for each */
static PetscBool GmshCheckNames(GmshCheck *check)
{
  PetscInt64 count = 0;
  char       words[2][GMSH_WORD], name[GMSH_WORD], rest;
  int        number;

  if (!GmshGetCountWord(&check->in, "physical names", &count)) return PETSC_FALSE;
  for (PetscInt64 i = 0; i < count; ++i) {
    const char *begin, *end;

    for (int j = 0; j < 2; ++j) {
      if (!GmshGetWord(&check->in, words[j])) return PETSC_FALSE;
      if (sscanf(words[j], "%d%c", &number, &rest) != 1) return GmshWrong(&check->in, "a dimension and a tag are expected in $PhysicalNames where \"%s\" stands", words[j]);
    }
    if (!fgets(name, sizeof(name), check->in.file)) return GmshWrong(&check->in, "it ends too early");
    begin = strchr(name, '"');
    end   = strrchr(name, '"');
    if (!strchr(name, '\n') || begin != name || end == begin || end - begin > 127) return GmshWrong(&check->in, "physical name %lld is not a dimension, a tag and a name of at most 126 characters in quotes", (long long)i + 1);
  }
  return GmshExpectNext(&check->in, "$EndPhysicalNames");
}

static PetscBool GmshCheckEntity(GmshCheck *check, int dim, PetscInt *entity)
{
  PetscInt64 number = 0, ntags, tag;

  if (!GmshGetNumbers(&check->in, 4, 1, &number) || !GmshGetReals(&check->in, !dim && check->in.version > 40 ? 3 : 6)) return PETSC_FALSE;
  *entity = (PetscInt)number;
  for (int list = 0; list < (dim ? 2 : 1); ++list) { /* physical tags, then what bounds it */
    if (!GmshGetCounts(&check->in, "tags", 1, &ntags)) return PETSC_FALSE;
    if (!list && ntags > 16) return GmshWrong(&check->in, "entity %d of dimension %d has %lld physical tags, more than 16", (int)number, dim, (long long)ntags);
    for (PetscInt64 i = 0; i < ntags; ++i) {
      if (!GmshGetNumbers(&check->in, 4, 1, &tag)) return PETSC_FALSE;
    }
  }
  return PETSC_TRUE;
}

static PetscErrorCode GmshCheckEntities(GmshCheck *check, PetscBool *sound)
{
  PetscInt64 counts[4];

  PetscFunctionBegin;
  *sound = GmshGetCounts(&check->in, "entities", 4, counts);
  for (int dim = 0; dim < 4 && *sound; ++dim) {
    PetscCall(PetscMalloc1(counts[dim], &check->entities[dim]));
    check->nentities[dim] = (PetscInt)counts[dim];
    for (PetscInt i = 0; i < check->nentities[dim] && *sound; ++i) *sound = GmshCheckEntity(check, dim, &check->entities[dim][i]);
    if (*sound) PetscCall(PetscSortInt(check->nentities[dim], check->entities[dim]));
  }
  if (*sound) *sound = GmshExpectNext(&check->in, "$EndEntities");
  PetscFunctionReturn(0);
}

/* The header of a block of nodes or elements in formats 4, whose entity must exist; last: its third number */
static PetscErrorCode GmshCheckBlock(GmshCheck *check, PetscInt64 *dim, PetscInt64 *last, PetscInt64 *count, PetscBool *sound)
{
  PetscInt64 info[3], entity;
  PetscInt   at = PETSC_DECIDE;

  PetscFunctionBegin;
  *sound = GmshGetNumbers(&check->in, 4, 3, info) && GmshGetCounts(&check->in, "nodes or elements in a block", 1, count) ? PETSC_TRUE : PETSC_FALSE;
  if (!*sound) PetscFunctionReturn(0);
  *dim   = info[check->in.version == 40 ? 1 : 0];
  entity = info[check->in.version == 40 ? 0 : 1];
  *last  = info[2];
  if (*dim >= 0 && *dim <= 3) PetscCall(PetscFindInt((PetscInt)entity, check->nentities[*dim], check->entities[*dim], &at));
  if (at < 0) *sound = GmshWrong(&check->in, "a block is of the entity %lld of dimension %lld, which does not exist", (long long)entity, (long long)*dim);
  PetscFunctionReturn(0);
}

/* Marks a node's number; all numbers are known to lie in the range */
static PetscErrorCode GmshMarkNodes(GmshCheck *check, PetscInt64 n, const PetscInt64 numbers[], PetscBool *sound)
{
  PetscInt64 first = PETSC_MAX_INT, last = 0;

  PetscFunctionBegin;
  for (PetscInt64 i = 0; i < n && *sound; ++i) {
    if (numbers[i] < 1 || numbers[i] >= PETSC_MAX_INT) *sound = GmshWrong(&check->in, "%lld is not the number of a node", (long long)numbers[i]);
    first = PetscMin(first, numbers[i]);
    last  = PetscMax(last, numbers[i]);
  }
  if (!*sound) PetscFunctionReturn(0);
  check->first  = first;
  check->nnodes = last - first + 1;
  if (check->nnodes > 1000000 + 100 * n) *sound = GmshWrong(&check->in, "its %lld nodes have numbers from %lld to %lld; number them anew", (long long)n, (long long)first, (long long)last);
  if (!*sound) PetscFunctionReturn(0);
  PetscCall(PetscBTCreate((PetscInt)check->nnodes, &check->nodes));
  for (PetscInt64 i = 0; i < n && *sound; ++i) {
    if (PetscBTLookupSet(check->nodes, (PetscInt)(numbers[i] - first))) *sound = GmshWrong(&check->in, "the node %lld is given twice", (long long)numbers[i]);
  }
  PetscFunctionReturn(0);
}

static PetscBool GmshGetNodesOfBlock(GmshCheck *check, PetscInt64 n, PetscInt64 numbers[])
{
  if (check->in.version > 40) return GmshGetNumbers(&check->in, check->in.width, n, numbers) && GmshGetReals(&check->in, 3 * n) ? PETSC_TRUE : PETSC_FALSE;
  for (PetscInt64 i = 0; i < n; ++i) {
    if (!GmshGetNumbers(&check->in, 4, 1, &numbers[i]) || !GmshGetReals(&check->in, 3)) return PETSC_FALSE;
  }
  return PETSC_TRUE;
}

/* Formats 4 count blocks and all that is in them; 4.1 gives also the least and the largest number, which PETSc relies on */
static PetscErrorCode GmshGetBlocks(GmshCheck *check, const char what[], PetscInt64 *nblocks, PetscInt64 *count, PetscInt64 range[2], PetscBool *sound)
{
  PetscInt64 sizes[2];

  PetscFunctionBegin;
  if (check->in.version < 40) {
    *nblocks = 1;
    *sound   = GmshGetCountWord(&check->in, what, count);
  } else {
    *sound   = GmshGetCounts(&check->in, what, 2, sizes) && (check->in.version == 40 || GmshGetNumbers(&check->in, check->in.width, 2, range)) ? PETSC_TRUE : PETSC_FALSE;
    *nblocks = sizes[0];
    *count   = sizes[1];
  }
  if (*sound && !*count) *sound = GmshWrong(&check->in, "it has no %s", what);
  PetscFunctionReturn(0);
}

static PetscErrorCode GmshCheckNodes(GmshCheck *check, PetscBool *sound)
{
  PetscInt64 nblocks, total, n = 0, *numbers, range[2] = {0, PETSC_MAX_INT};

  PetscFunctionBegin;
  PetscCall(GmshGetBlocks(check, "nodes", &nblocks, &total, range, sound));
  if (!*sound) PetscFunctionReturn(0);
  PetscCall(PetscMalloc1(total, &numbers));
  for (PetscInt64 b = 0; b < nblocks && *sound; ++b) {
    PetscInt64 dim, parametric = 0, count = total;

    if (check->in.version >= 40) PetscCall(GmshCheckBlock(check, &dim, &parametric, &count, sound));
    if (*sound && parametric) *sound = GmshWrong(&check->in, "its nodes have parametric coordinates, which are not read");
    if (*sound && n + count > total) *sound = GmshWrong(&check->in, "its blocks have more nodes than the %lld it announces", (long long)total);
    if (*sound) *sound = GmshGetNodesOfBlock(check, count, numbers + n);
    n += count;
  }
  if (*sound && n != total) *sound = GmshWrong(&check->in, "it has %lld nodes, but announces %lld", (long long)n, (long long)total);
  if (*sound) PetscCall(GmshMarkNodes(check, total, numbers, sound));
  if (*sound && (range[0] > check->first || range[1] < check->first + check->nnodes - 1 || (check->in.version > 40 && range[1] - range[0] > 1000000 + 100 * total)))
    *sound = GmshWrong(&check->in, "the numbers of its nodes run from %lld to %lld, but it announces %lld to %lld", (long long)check->first, (long long)(check->first + check->nnodes - 1), (long long)range[0], (long long)range[1]);
  PetscCall(PetscFree(numbers));
  if (*sound) *sound = GmshExpectNext(&check->in, "$EndNodes");
  PetscFunctionReturn(0);
}

/* Dimension and number of nodes of the elements of first order, by Gmsh's number of their type */
static PetscBool GmshGetType(GmshCheck *check, PetscInt64 type, PetscInt64 *dim, PetscInt64 *nnodes)
{
  static const PetscInt64 types[16][2] = {[15] = {0, 1}, [1] = {1, 2}, [2] = {2, 3}, [3] = {2, 4}, [4] = {3, 4}, [5] = {3, 8}, [6] = {3, 6}, [7] = {3, 5}};

  *dim = *nnodes = 0;
  if (type < 1 || type > 15 || !types[type][1]) return GmshWrong(&check->in, "it has elements of Gmsh's type %lld, which are not of first order", (long long)type);
  *dim    = types[type][0];
  *nnodes = types[type][1];
  return PETSC_TRUE;
}

static PetscBool GmshCheckCorners(GmshCheck *check, PetscInt64 element, PetscInt64 n, const PetscInt64 nodes[])
{
  for (PetscInt64 i = 0; i < n; ++i) {
    const PetscInt64 at = nodes[i] - check->first;

    if (at < 0 || at >= check->nnodes || !PetscBTLookup(check->nodes, (PetscInt)at)) return GmshWrong(&check->in, "the element %lld names the node %lld, which does not exist", (long long)element, (long long)nodes[i]);
    for (PetscInt64 j = 0; j < i; ++j) {
      if (nodes[i] == nodes[j]) return GmshWrong(&check->in, "the element %lld names the node %lld twice", (long long)element, (long long)nodes[i]);
    }
  }
  return PETSC_TRUE;
}

/* The quadrilaterals of hexahedra, prisms and pyramids, in the corners' order of Gmsh */
static PetscErrorCode GmshAddFacets(GmshCheck *check, PetscInt64 type, PetscInt64 element, const PetscInt64 nodes[])
{
  static const int hexahedron[6][4] = {{0, 1, 2, 3}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
  static const int prism[3][4] = {{0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}}, pyramid[1][4] = {{0, 1, 2, 3}};
  const int(*quadrilaterals)[4] = type == 5 ? hexahedron : type == 6 ? prism
                                                                     : pyramid;
  const int n                   = type == 5 ? 6 : type == 6 ? 3
                                                : type == 7 ? 1
                                                            : 0;

  PetscFunctionBegin;
  if (check->nfacets + n > check->maxfacets) {
    check->maxfacets = 2 * check->maxfacets + 64;
    PetscCall(PetscRealloc((size_t)check->maxfacets * sizeof(*check->facets), &check->facets));
  }
  for (int f = 0; f < n; ++f) {
    GmshFacet *facet = &check->facets[check->nfacets++];
    int        least = 0;

    for (int a = 0; a < 4; ++a) {
      const PetscInt64 node = nodes[quadrilaterals[f][a]];
      int              at   = a;

      if (node < nodes[quadrilaterals[f][least]]) least = a;
      for (; at > 0 && facet->nodes[at - 1] > node; --at) facet->nodes[at] = facet->nodes[at - 1];
      facet->nodes[at] = node;
    }
    facet->across  = nodes[quadrilaterals[f][(least + 2) % 4]];
    facet->element = element;
  }
  PetscFunctionReturn(0);
}

static int GmshCompareFacets(const void *a, const void *b)
{
  const PetscInt64 *x = ((const GmshFacet *)a)->nodes, *y = ((const GmshFacet *)b)->nodes;

  for (int i = 0; i < 4; ++i) {
    if (x[i] != y[i]) return x[i] < y[i] ? -1 : 1;
  }
  return 0;
}

/* Cells that meet in four nodes must have the same facet there, and no more than two meet */
static PetscBool GmshCheckFacets(GmshCheck *check)
{
  if (check->nfacets) qsort(check->facets, (size_t)check->nfacets, sizeof(*check->facets), GmshCompareFacets);
  for (PetscInt64 i = 1; i < check->nfacets; ++i) {
    const GmshFacet *here = &check->facets[i], *before = here - 1;

    if (GmshCompareFacets(here, before)) continue;
    if (here->across != before->across) return GmshWrong(&check->in, "the elements %lld and %lld have the corners of a facet in orders that do not agree", (long long)before->element, (long long)here->element);
    if (i > 1 && !GmshCompareFacets(here, here - 2)) return GmshWrong(&check->in, "the elements %lld, %lld and %lld have one facet in common", (long long)before[-1].element, (long long)before->element, (long long)here->element);
  }
  return PETSC_TRUE;
}

/* An element of format 2: text has its type and the number of tags in each, binary in the header of a run of them */
static PetscErrorCode GmshCheckElements2(GmshCheck *check, PetscInt64 total, PetscBool *sound)
{
  PetscFunctionBegin;
  for (PetscInt64 c = 0; c < total && *sound;) {
    PetscInt64 head[3] = {0}, type, count, dim, nnodes = 0, numbers[1 + GMSH_MAX_TAGS + 8];

    *sound = GmshGetNumbers(&check->in, 4, 3, head);
    type   = check->in.binary ? head[0] : head[1];
    count  = check->in.binary ? head[1] : 1;
    if (*sound) *sound = GmshGetType(check, type, &dim, &nnodes);
    if (*sound && (head[2] < 0 || head[2] > GMSH_MAX_TAGS)) *sound = GmshWrong(&check->in, "an element has %lld tags", (long long)head[2]);
    if (*sound && (count < 1 || c + count > total)) *sound = GmshWrong(&check->in, "it has more elements than the %lld it announces", (long long)total);
    for (PetscInt64 i = 0; i < count && *sound; ++i, ++c) {
      const PetscInt64 *nodes = numbers + 1 + head[2];

      numbers[0] = head[0];
      *sound     = GmshGetNumbers(&check->in, 4, (check->in.binary ? 1 : 0) + head[2] + nnodes, numbers + (check->in.binary ? 0 : 1)) && GmshCheckCorners(check, numbers[0], nnodes, nodes) ? PETSC_TRUE : PETSC_FALSE;
      if (*sound) PetscCall(GmshAddFacets(check, type, numbers[0], nodes));
    }
  }
  PetscFunctionReturn(0);
}

static PetscErrorCode GmshCheckElements4(GmshCheck *check, PetscInt64 nblocks, PetscInt64 total, PetscBool *sound)
{
  PetscInt64 c = 0;

  PetscFunctionBegin;
  for (PetscInt64 b = 0; b < nblocks && *sound; ++b) {
    PetscInt64 type = 0, dim = 0, typedim = 0, nnodes = 0, count = 0;

    PetscCall(GmshCheckBlock(check, &dim, &type, &count, sound));
    if (*sound) *sound = GmshGetType(check, type, &typedim, &nnodes);
    if (*sound && dim != typedim) *sound = GmshWrong(&check->in, "an entity of dimension %lld has elements of dimension %lld", (long long)dim, (long long)typedim);
    if (*sound && c + count > total) *sound = GmshWrong(&check->in, "its blocks have more elements than the %lld it announces", (long long)total);
    for (PetscInt64 i = 0; i < count && *sound; ++i, ++c) {
      PetscInt64 numbers[1 + 8];

      *sound = GmshGetNumbers(&check->in, check->in.version == 40 ? 4 : check->in.width, 1 + nnodes, numbers) && GmshCheckCorners(check, numbers[0], nnodes, numbers + 1) ? PETSC_TRUE : PETSC_FALSE;
      if (*sound) PetscCall(GmshAddFacets(check, type, numbers[0], numbers + 1));
    }
  }
  if (*sound && c != total) *sound = GmshWrong(&check->in, "it has %lld elements, but announces %lld", (long long)c, (long long)total);
  PetscFunctionReturn(0);
}

static PetscErrorCode GmshCheckElements(GmshCheck *check, PetscBool *sound)
{
  PetscInt64 nblocks, total, range[2];

  PetscFunctionBegin;
  PetscCall(GmshGetBlocks(check, "elements", &nblocks, &total, range, sound));
  if (*sound && check->in.version < 40) PetscCall(GmshCheckElements2(check, total, sound));
  else if (*sound) PetscCall(GmshCheckElements4(check, nblocks, total, sound));
  if (*sound) *sound = GmshCheckFacets(check);
  if (*sound) *sound = GmshExpectNext(&check->in, "$EndElements");
  PetscFunctionReturn(0);
}

static PetscErrorCode GmshCheckSections(GmshCheck *check)
{
  char      word[GMSH_WORD];
  PetscBool sound;

  PetscFunctionBegin;
  sound = GmshCheckFormat(check) && GmshGetSection(&check->in, word) ? PETSC_TRUE : PETSC_FALSE;
  if (sound && !strcmp(word, "$PhysicalNames")) sound = GmshCheckNames(check) && GmshGetSection(&check->in, word) ? PETSC_TRUE : PETSC_FALSE;
  if (sound && check->in.version >= 40) {
    sound = GmshExpect(&check->in, "$Entities", word);
    if (sound) PetscCall(GmshCheckEntities(check, &sound));
    if (sound) sound = GmshGetSection(&check->in, word);
  }
  if (sound) sound = GmshExpect(&check->in, "$Nodes", word);
  if (sound) PetscCall(GmshCheckNodes(check, &sound));
  if (sound) sound = GmshGetSection(&check->in, word) && GmshExpect(&check->in, "$Elements", word) ? PETSC_TRUE : PETSC_FALSE;
  if (sound) PetscCall(GmshCheckElements(check, &sound));
  PetscFunctionReturn(0);
}

PetscErrorCode GmshCheckFile(const char file[], size_t length, char sentence[])
{
  GmshCheck check = {.in = {.sentence = sentence, .length = length}};

  PetscFunctionBegin;
  sentence[0]   = 0;
  check.in.file = fopen(file, "r");
  if (!check.in.file || fseek(check.in.file, 0, SEEK_END)) (void)GmshWrong(&check.in, "it cannot be read");
  else {
    check.in.size = (PetscInt64)ftell(check.in.file);
    rewind(check.in.file);
    PetscCall(GmshCheckSections(&check));
  }
  if (check.in.file) (void)fclose(check.in.file);
  for (int dim = 0; dim < 4; ++dim) PetscCall(PetscFree(check.entities[dim]));
  PetscCall(PetscBTDestroy(&check.nodes));
  PetscCall(PetscFree(check.facets));
  PetscFunctionReturn(0);
}
