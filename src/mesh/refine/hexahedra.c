/*
   Hexahedra on one rank, some refined more than others. Refinement divides a cell into eight. Cells with a common side
   or edge differ by at most one refinement. A vertex in the middle of an edge or a side of a coarser cell hangs there.
*/
#include "refineimpl.h"
#include <petsc/private/hashmapij.h>

/* Tables of the vertices in the middle of edges and sides. The key of an edge consists of its two ends, that of a side
   of the two ends of a diagonal. */
struct _n_MeshMiddles {
  PetscHMapIJ edges, sides;
};

/* Lists the corners of a cell around its position i + 3 j + 9 k, whose vertices are at even i, j, k: the vertex itself,
   the ends of an edge, the corners of a side, or all corners. Returns their number. */
static PetscInt HexAround(PetscInt place, PetscInt corners[8])
{
  const PetscInt at[3] = {place % 3, place / 3 % 3, place / 9};
  PetscInt       n     = 0;

  for (PetscInt a = 0; a < 8; ++a) {
    PetscBool around = PETSC_TRUE;

    for (PetscInt d = 0; d < 3; ++d) around = (PetscBool)(around && (at[d] == 1 || at[d] / 2 == (a >> d & 1)));
    if (around) corners[n++] = a;
  }
  return n;
}

/* Lists the vertices around a position of a cell and returns their number */
static PetscInt HexesGetAround(const MeshHexes *hexes, PetscInt cell, PetscInt place, PetscInt around[8])
{
  const PetscInt n = HexAround(place, around);

  for (PetscInt i = 0; i < n; ++i) around[i] = hexes->vertex[8 * cell + around[i]];
  return n;
}

/* Computes the key of a middle vertex: the ends of its edge, or of the diagonal of its side that contains the vertex
   with the smallest number */
static void HexesGetKey(PetscInt n, const PetscInt around[], PetscHashIJKey *key)
{
  PetscInt first = 0;

  for (PetscInt i = 1; i < n; ++i) first = around[i] < around[first] ? i : first;
  key->i = around[first];
  key->j = around[n - 1 - first];
}

/* Finds the vertex in the middle of an edge (n = 2) or of a side (n = 4). *middle is -1 if there is none. */
static PetscErrorCode HexesFindMiddle(const MeshHexes *hexes, PetscInt n, const PetscInt around[], PetscInt *middle)
{
  PetscHashIJKey key;

  PetscFunctionBegin;
  HexesGetKey(n, around, &key);
  PetscCall(PetscHMapIJGet(n == 2 ? hexes->middles->edges : hexes->middles->sides, key, middle));
  PetscFunctionReturn(0);
}

PetscErrorCode MeshHexesCreate(DM dm, MeshHexes *hexes)
{
  PetscInt vstart, vend;

  PetscFunctionBegin;
  PetscCall(PetscMemzero(hexes, sizeof(*hexes)));
  PetscCall(DMPlexGetHeightStratum(dm, 0, NULL, &hexes->ncells));
  PetscCall(DMPlexGetDepthStratum(dm, 0, &vstart, &vend));
  hexes->nvertices = hexes->maxvertices = vend - vstart;
  PetscCall(PetscMalloc1(8 * hexes->ncells, &hexes->vertex));
  PetscCall(PetscMalloc1(hexes->ncells, &hexes->root));
  PetscCall(PetscCalloc1(4 * hexes->ncells, &hexes->place));
  PetscCall(PetscMalloc1(3 * hexes->nvertices, &hexes->x));
  PetscCall(PetscMalloc1(4 * hexes->nvertices, &hexes->parent));
  for (PetscInt c = 0; c < hexes->ncells; ++c) {
    hexes->root[c] = c;
    PetscCall(MeshGetCellVertices(dm, c, &hexes->vertex[8 * c]));
    for (PetscInt a = 0; a < 8; ++a) hexes->vertex[8 * c + a] -= vstart;
  }
  for (PetscInt v = 0; v < hexes->nvertices; ++v) {
    const PetscInt point = vstart + v;

    PetscCall(MeshGetVertexCoordinates(dm, 1, &point, (PetscReal(*)[3]) & hexes->x[3 * v]));
    for (PetscInt i = 0; i < 4; ++i) hexes->parent[4 * v + i] = -1;
  }
  PetscCall(PetscNew(&hexes->middles));
  PetscCall(PetscHMapIJCreate(&hexes->middles->edges));
  PetscCall(PetscHMapIJCreate(&hexes->middles->sides));
  PetscFunctionReturn(0);
}

PetscErrorCode MeshHexesDestroy(MeshHexes *hexes)
{
  PetscFunctionBegin;
  PetscCall(PetscFree(hexes->vertex));
  PetscCall(PetscFree(hexes->root));
  PetscCall(PetscFree(hexes->place));
  PetscCall(PetscFree(hexes->x));
  PetscCall(PetscFree(hexes->placed));
  PetscCall(PetscFree(hexes->parent));
  if (hexes->middles) {
    PetscCall(PetscHMapIJDestroy(&hexes->middles->edges));
    PetscCall(PetscHMapIJDestroy(&hexes->middles->sides));
  }
  PetscCall(PetscFree(hexes->middles));
  PetscFunctionReturn(0);
}

/* Adds a vertex at the mean position of n vertices */
static PetscErrorCode HexesAddVertex(MeshHexes *hexes, PetscInt n, const PetscInt around[], PetscInt *vertex)
{
  PetscFunctionBegin;
  if (hexes->nvertices == hexes->maxvertices) {
    PetscCheck(hexes->maxvertices < PETSC_MAX_INT / 16, PETSC_COMM_SELF, PETSC_ERR_ARG_OUTOFRANGE,
      "Local refinement creates more than %" PetscInt_FMT " vertices, too many for PETSc's integer type: refine less, "
      "or use PETSc with 64-bit indices",
      hexes->maxvertices);
    hexes->maxvertices = 2 * hexes->maxvertices + 64;
    PetscCall(PetscRealloc(3 * hexes->maxvertices * sizeof(PetscReal), &hexes->x));
    PetscCall(PetscRealloc(4 * hexes->maxvertices * sizeof(PetscInt), &hexes->parent));
  }
  *vertex = hexes->nvertices++;
  for (PetscInt i = 0; i < 4; ++i) hexes->parent[4 * *vertex + i] = n < 8 && i < n ? around[i] : -1;
  for (PetscInt d = 0; d < 3; ++d) {
    hexes->x[3 * *vertex + d] = 0;
    for (PetscInt i = 0; i < n; ++i) hexes->x[3 * *vertex + d] += hexes->x[3 * around[i] + d] / (PetscReal)n;
  }
  PetscFunctionReturn(0);
}

/* Gets the vertex at a position of a cell, and creates it unless a neighbouring cell has created it */
static PetscErrorCode HexesGetVertex(MeshHexes *hexes, PetscInt cell, PetscInt place, PetscInt *vertex)
{
  PetscInt       around[8];
  const PetscInt n = HexesGetAround(hexes, cell, place, around);
  PetscHashIJKey key;

  PetscFunctionBegin;
  *vertex = n == 1 ? around[0] : -1;
  if (n == 2 || n == 4) PetscCall(HexesFindMiddle(hexes, n, around, vertex));
  if (*vertex >= 0) PetscFunctionReturn(0);
  PetscCall(HexesAddVertex(hexes, n, around, vertex));
  if (n == 8) PetscFunctionReturn(0);
  HexesGetKey(n, around, &key);
  PetscCall(PetscHMapIJSet(n == 2 ? hexes->middles->edges : hexes->middles->sides, key, *vertex));
  PetscFunctionReturn(0);
}

/* For each vertex, lists the holders: the cells on whose edges and sides the vertex hangs, in compressed rows. If
   `cells` is NULL, only counts them. */
static PetscErrorCode HexesFindHolders(const MeshHexes *hexes, PetscInt start[], PetscInt cells[])
{
  PetscFunctionBegin;
  for (PetscInt c = 0; c < hexes->ncells; ++c) {
    for (PetscInt place = 0; place < 27; ++place) {
      PetscInt       around[8], middle = -1;
      const PetscInt n = HexesGetAround(hexes, c, place, around);

      if (n == 2 || n == 4) PetscCall(HexesFindMiddle(hexes, n, around, &middle));
      if (middle < 0) continue;
      if (cells) cells[--start[middle]] = c;
      else ++start[middle];
    }
  }
  PetscFunctionReturn(0);
}

/* Allocates and fills the lists of HexesFindHolders() */
static PetscErrorCode HexesCreateHolders(const MeshHexes *hexes, PetscInt **start, PetscInt **holders)
{
  PetscFunctionBegin;
  PetscCall(PetscCalloc1(hexes->nvertices + 1, start));
  PetscCall(HexesFindHolders(hexes, *start, NULL));
  for (PetscInt v = 1; v <= hexes->nvertices; ++v) (*start)[v] += (*start)[v - 1];
  PetscCall(PetscMalloc1((*start)[hexes->nvertices], holders));
  PetscCall(HexesFindHolders(hexes, *start, *holders));
  PetscFunctionReturn(0);
}

/* Marks further cells, so that neighbours differ by at most one level: if a vertex of a marked cell hangs on another
   cell, that cell is marked too */
static PetscErrorCode HexesBalance(const MeshHexes *hexes, PetscBool marked[])
{
  PetscInt *start, *holders, *pending, n = 0;

  PetscFunctionBegin;
  PetscCall(HexesCreateHolders(hexes, &start, &holders));
  PetscCall(PetscMalloc1(hexes->ncells, &pending));
  for (PetscInt c = 0; c < hexes->ncells; ++c) {
    if (marked[c]) pending[n++] = c;
  }
  while (n) {
    const PetscInt *vertex = &hexes->vertex[8 * pending[--n]];

    for (PetscInt a = 0; a < 8; ++a) {
      for (PetscInt i = start[vertex[a]]; i < start[vertex[a] + 1]; ++i) {
        if (marked[holders[i]]) continue;
        marked[holders[i]] = PETSC_TRUE;
        pending[n++]       = holders[i];
      }
    }
  }
  PetscCall(PetscFree(pending));
  PetscCall(PetscFree(holders));
  PetscCall(PetscFree(start));
  PetscFunctionReturn(0);
}

/* Marks the cells on which vertices of the marked cells hang, in place of the marked cells. *any: whether there are
   such cells */
PetscErrorCode MeshHexesMarkHolders(const MeshHexes *hexes, PetscBool marked[], PetscBool *any)
{
  PetscInt  *start, *holders;
  PetscBool *of;

  PetscFunctionBegin;
  *any = PETSC_FALSE;
  PetscCall(HexesCreateHolders(hexes, &start, &holders));
  PetscCall(PetscMalloc1(hexes->ncells, &of));
  PetscCall(PetscArraycpy(of, marked, hexes->ncells));
  PetscCall(PetscArrayzero(marked, hexes->ncells));
  for (PetscInt i = 0; i < 8 * hexes->ncells; ++i) {
    const PetscInt v = hexes->vertex[i];

    for (PetscInt k = start[v]; of[i / 8] && k < start[v + 1]; ++k) *any = marked[holders[k]] = PETSC_TRUE;
  }
  PetscCall(PetscFree(of));
  PetscCall(PetscFree(holders));
  PetscCall(PetscFree(start));
  PetscFunctionReturn(0);
}

/* Divides a cell into eight parts, which are stored from index `to` on in the new lists */
static PetscErrorCode HexesSplit(MeshHexes *hexes, PetscInt cell, PetscInt to, PetscInt vertex[], PetscInt root[],
  PetscInt place[])
{
  PetscInt lattice[27];

  PetscFunctionBegin;
  for (PetscInt i = 0; i < 27; ++i) PetscCall(HexesGetVertex(hexes, cell, i, &lattice[i]));
  for (PetscInt k = 0; k < 8; ++k) {
    const PetscInt corner = (k & 1) + 3 * (k >> 1 & 1) + 9 * (k >> 2);

    root[to + k]            = hexes->root[cell];
    place[4 * (to + k) + 3] = hexes->place[4 * cell + 3] + 1;
    for (PetscInt d = 0; d < 3; ++d) place[4 * (to + k) + d] = 2 * hexes->place[4 * cell + d] + (k >> d & 1);
    for (PetscInt a = 0; a < 8; ++a)
      vertex[8 * (to + k) + a] = lattice[corner + (a & 1) + 3 * (a >> 1 & 1) + 9 * (a >> 2)];
  }
  PetscFunctionReturn(0);
}

/* Refines the marked cells, and further cells so that neighbours differ by at most one level */
PetscErrorCode MeshHexesRefine(MeshHexes *hexes, PetscBool marked[])
{
  PetscInt n = 0, *vertex, *root, *place;

  PetscFunctionBegin;
  PetscCall(HexesBalance(hexes, marked));
  for (PetscInt c = 0; c < hexes->ncells; ++c) {
    PetscCheck(n < PETSC_MAX_INT / 64, PETSC_COMM_SELF, PETSC_ERR_ARG_OUTOFRANGE,
      "Local refinement creates more than %" PetscInt_FMT " cells, too many for PETSc's integer type: refine less, or "
      "use PETSc with 64-bit indices",
      n);
    n += marked[c] ? 8 : 1;
  }
  PetscCall(PetscMalloc1(8 * n, &vertex));
  PetscCall(PetscMalloc1(n, &root));
  PetscCall(PetscMalloc1(4 * n, &place));
  n = 0;
  for (PetscInt c = 0; c < hexes->ncells; ++c) {
    if (marked[c]) PetscCall(HexesSplit(hexes, c, n, vertex, root, place));
    else {
      root[n] = hexes->root[c];
      PetscCall(PetscArraycpy(&vertex[8 * n], &hexes->vertex[8 * c], 8));
      PetscCall(PetscArraycpy(&place[4 * n], &hexes->place[4 * c], 4));
    }
    n += marked[c] ? 8 : 1;
  }
  PetscCall(PetscFree(hexes->vertex));
  PetscCall(PetscFree(hexes->root));
  PetscCall(PetscFree(hexes->place));
  hexes->ncells = n;
  hexes->vertex = vertex;
  hexes->root   = root;
  hexes->place  = place;
  PetscFunctionReturn(0);
}

/* Determines which vertices hang */
PetscErrorCode MeshHexesFindHanging(const MeshHexes *hexes, PetscBool hangs[])
{
  PetscInt *count;

  PetscFunctionBegin;
  PetscCall(PetscCalloc1(hexes->nvertices + 1, &count));
  PetscCall(HexesFindHolders(hexes, count, NULL));
  for (PetscInt v = 0; v < hexes->nvertices; ++v) hangs[v] = (PetscBool)(count[v] > 0);
  PetscCall(PetscFree(count));
  PetscFunctionReturn(0);
}
