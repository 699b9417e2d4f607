/*
   Distributes the grids of all bodies from the first rank before a DMPlex is built, because a DMPlex needs several
   times their memory. No rank then holds more than its part of the DMPlex. METIS partitions the dual graph of the
   cells. Each part is sent with its vertices, facets and curves.
*/
#include "meshimpl.h"
#include <metis.h>

/* The part of the mesh for one rank: sizes of each body's part, and all its integers and all its reals in one array
   each */
typedef struct {
  PetscInt   nints, nreals;
  PetscInt  *sizes; /* [PART_SIZES * bodies] sizes of each body's part */
  PetscInt  *ints;  /* vertices' owners, cells and facets, body by body */
  PetscReal *reals; /* coordinates of vertices and curves of cells, body by body */
} DistributePart;

/* what the sizes of a body's part count */
enum { PART_CELLS, PART_VERTICES, PART_FACETS, PART_CURVE, PART_SIZES };

/* Data of the distribution on the first rank. Cells, vertices and facets are numbered consecutively through all
   bodies. */
typedef struct {
  MPI_Comm    comm;
  PetscMPIInt nparts;
  PetscInt    nbodies, ncells, nvertices;
  MeshBody   *meshes;
  PetscInt   *part;      /* [cells] part of each cell */
  PetscInt   *count;     /* [parts] number of cells of each part */
  PetscInt   *facetpart; /* [facets] part of each facet */
  PetscInt   *owner;     /* [vertices] owner of each vertex: the first part that contains it */
  PetscInt   *place;     /* [vertices] number of each vertex within its owner's part */
  PetscInt   *here;      /* [vertices] number of each vertex within the current part; PETSC_DECIDE if it is not in that
                       part */
} Distribute;

/* Partitions the dual graph, in which cells that share a facet are neighbours, by METIS */
static PetscErrorCode DistributePartition(Distribute *dist)
{
  idx_t     ne = (idx_t)dist->ncells, nn = (idx_t)dist->nvertices, common = 3, base = 0, *start, *nodes, *xadj, *adjncy;
  PetscInt *xadjacency, *adjacency, cell = 0, vertex = 0;
  int       status;

  PetscFunctionBegin;
  PetscCheck(dist->ncells <= PETSC_MPI_INT_MAX / 8, PETSC_COMM_SELF, PETSC_ERR_SUP,
    "METIS's integer type is too small for %" PetscInt_FMT " cells: read a coarser mesh and refine it", dist->ncells);
  PetscCall(PetscMalloc2(dist->ncells + 1, &start, 8 * dist->ncells, &nodes));
  start[0] = 0;
  for (PetscInt b = 0; b < dist->nbodies; ++b) {
    const ShapeGrid *grid = &dist->meshes[b].grid;

    for (PetscInt c = 0; c < grid->ncells; ++c, ++cell) {
      for (PetscInt a = 0; a < grid->ncorners; ++a)
        nodes[start[cell] + a] = (idx_t)(vertex + grid->cells[grid->ncorners * c + a]);
      start[cell + 1] = start[cell] + (idx_t)grid->ncorners;
    }
    vertex += grid->nvertices;
  }
  status = METIS_MeshToDual(&ne, &nn, start, nodes, &common, &base, &xadj, &adjncy);
  PetscCheck(status == METIS_OK, PETSC_COMM_SELF, PETSC_ERR_LIB,
    "METIS failed with status %d to create the dual graph of %" PetscInt_FMT " cells", status, dist->ncells);
  PetscCall(PetscFree2(start, nodes));
  PetscCall(PetscMalloc2(dist->ncells + 1, &xadjacency, xadj[ne], &adjacency));
  for (PetscInt c = 0; c <= dist->ncells; ++c) xadjacency[c] = (PetscInt)xadj[c];
  for (PetscInt e = 0; e < xadjacency[dist->ncells]; ++e) adjacency[e] = (PetscInt)adjncy[e];
  METIS_Free(xadj);
  METIS_Free(adjncy);
  PetscCall(MetisPartitionGraph(dist->nparts, dist->ncells, xadjacency, adjacency, NULL, dist->part));
  PetscCall(PetscFree2(xadjacency, adjacency));
  PetscFunctionReturn(0);
}

/* Counts the cells of each part, and finds the owner of each vertex */
static PetscErrorCode DistributeOwners(Distribute *dist)
{
  PetscInt cell = 0, vertex = 0;

  PetscFunctionBegin;
  PetscCall(PetscArrayzero(dist->count, dist->nparts));
  for (PetscInt v = 0; v < dist->nvertices; ++v) dist->owner[v] = dist->nparts;
  for (PetscInt b = 0; b < dist->nbodies; ++b) {
    const ShapeGrid *grid = &dist->meshes[b].grid;

    for (PetscInt c = 0; c < grid->ncells; ++c, ++cell) {
      ++dist->count[dist->part[cell]];
      for (PetscInt a = 0; a < grid->ncorners; ++a) {
        PetscInt *owner = &dist->owner[vertex + grid->cells[grid->ncorners * c + a]];

        *owner = PetscMin(*owner, dist->part[cell]);
      }
    }
    vertex += grid->nvertices;
  }
  PetscFunctionReturn(0);
}

/* Returns whether cell c has all vertices of the facet */
static PetscBool DistributeCellHas(const ShapeGrid *grid, PetscInt c, const PetscInt facet[4])
{
  for (PetscInt a = 0; a < 4; ++a) {
    PetscBool found = PETSC_FALSE;

    for (PetscInt i = 0; i < grid->ncorners; ++i)
      found = (PetscBool)(found || grid->cells[grid->ncorners * c + i] == facet[a]);
    if (!found) return PETSC_FALSE;
  }
  return PETSC_TRUE;
}

/* Assigns each facet of a body to the part of its cell, which is searched for among the cells at its first vertex.
   firstcell, firstfacet: numbers of the body's first cell and facet */
static PetscErrorCode DistributeFacets(Distribute *dist, const ShapeGrid *grid, PetscInt firstcell, PetscInt firstfacet)
{
  const PetscInt n = grid->ncorners;
  PetscInt      *start, *cells;

  PetscFunctionBegin;
  PetscCall(PetscCalloc1(grid->nvertices + 2, &start));
  PetscCall(PetscMalloc1(n * grid->ncells, &cells));
  for (PetscInt i = 0; i < n * grid->ncells; ++i) ++start[grid->cells[i] + 2];
  for (PetscInt v = 0; v < grid->nvertices; ++v) start[v + 2] += start[v + 1];
  for (PetscInt i = 0; i < n * grid->ncells; ++i) cells[start[grid->cells[i] + 1]++] = i / n;
  for (PetscInt q = 0; q < grid->nfacets; ++q) {
    const PetscInt *facet = grid->facets + 4 * q;

    dist->facetpart[firstfacet + q] = PETSC_DECIDE;
    for (PetscInt i = start[facet[0]]; i < start[facet[0] + 1] && dist->facetpart[firstfacet + q] < 0; ++i) {
      if (DistributeCellHas(grid, cells[i], facet)) dist->facetpart[firstfacet + q] = dist->part[firstcell + cells[i]];
    }
    PetscCheck(dist->facetpart[firstfacet + q] >= 0, PETSC_COMM_SELF, PETSC_ERR_PLIB,
      "Facet %" PetscInt_FMT " belongs to no cell", q);
  }
  PetscCall(PetscFree(start));
  PetscCall(PetscFree(cells));
  PetscFunctionReturn(0);
}

/* Partitions the cells and assigns vertices and facets to the parts */
static PetscErrorCode DistributePrepare(Distribute *dist)
{
  PetscInt nfacets = 0, cell = 0, facet = 0;

  PetscFunctionBegin;
  PetscCallMPI(MPI_Comm_size(dist->comm, &dist->nparts));
  for (PetscInt b = 0; b < dist->nbodies; ++b) {
    dist->ncells += dist->meshes[b].grid.ncells;
    dist->nvertices += dist->meshes[b].grid.nvertices;
    nfacets += dist->meshes[b].grid.nfacets;
  }
  PetscCall(PetscMalloc3(dist->ncells, &dist->part, dist->nparts, &dist->count, nfacets, &dist->facetpart));
  PetscCall(PetscMalloc3(dist->nvertices, &dist->owner, dist->nvertices, &dist->place, dist->nvertices, &dist->here));
  for (PetscInt v = 0; v < dist->nvertices; ++v) dist->here[v] = PETSC_DECIDE;
  PetscCall(DistributePartition(dist));
  PetscCall(DistributeOwners(dist));
  for (PetscInt b = 0; b < dist->nbodies; ++b) {
    PetscCall(DistributeFacets(dist, &dist->meshes[b].grid, cell, facet));
    cell += dist->meshes[b].grid.ncells;
    facet += dist->meshes[b].grid.nfacets;
  }
  for (PetscInt p = 0; p < dist->nparts; ++p) {
    PetscCheck(dist->count[p] <= PETSC_MPI_INT_MAX / 128, PETSC_COMM_SELF, PETSC_ERR_SUP,
      "The part of a rank has %" PetscInt_FMT " cells, which exceeds the size of an MPI message: use more ranks",
      dist->count[p]);
  }
  PetscFunctionReturn(0);
}

/* Numbers the vertices of one body in a part, in their original order. *n: number of vertices that the part has so
   far */
static PetscErrorCode DistributeNumber(Distribute *dist, PetscInt part, const ShapeGrid *grid, PetscInt firstcell,
  PetscInt firstvertex, PetscInt *n)
{
  PetscFunctionBegin;
  for (PetscInt c = 0; c < grid->ncells; ++c) {
    for (PetscInt a = 0; dist->part[firstcell + c] == part && a < grid->ncorners; ++a)
      dist->here[firstvertex + grid->cells[grid->ncorners * c + a]] = 0;
  }
  for (PetscInt v = firstvertex; v < firstvertex + grid->nvertices; ++v) {
    if (dist->here[v] < 0) continue;
    dist->here[v] = (*n)++;
    if (dist->owner[v] == part) dist->place[v] = dist->here[v];
  }
  PetscFunctionReturn(0);
}

/* Appends one body's part to `to`, then resets the numbers of its vertices in `here`. first: numbers of the body's
   first cell, vertex and facet */
static PetscErrorCode DistributePack(Distribute *dist, PetscInt part, const ShapeGrid *grid, const PetscInt first[3],
  PetscInt body, DistributePart *to)
{
  PetscInt *sizes = to->sizes + PART_SIZES * body, base = PETSC_DECIDE;

  PetscFunctionBegin;
  PetscCall(PetscArrayzero(sizes, PART_SIZES));
  sizes[PART_CURVE] = grid->curve ? MeshCurveSize(grid->ncorners) : 0;
  for (PetscInt v = first[1]; v < first[1] + grid->nvertices; ++v) {
    if (dist->here[v] < 0) continue;
    if (base < 0) base = dist->here[v];
    to->ints[to->nints++] = dist->owner[v];
    to->ints[to->nints++] = dist->count[dist->owner[v]] + dist->place[v];
    for (PetscInt d = 0; d < 3; ++d) to->reals[to->nreals++] = grid->coordinates[3 * (v - first[1]) + d];
    ++sizes[PART_VERTICES];
  }
  for (PetscInt c = 0; c < grid->ncells; ++c) {
    if (dist->part[first[0] + c] != part) continue;
    for (PetscInt a = 0; a < grid->ncorners; ++a)
      to->ints[to->nints++] = dist->here[first[1] + grid->cells[grid->ncorners * c + a]] - base;
    for (PetscInt i = 0; i < sizes[PART_CURVE]; ++i) to->reals[to->nreals++] = grid->curve[sizes[PART_CURVE] * c + i];
    ++sizes[PART_CELLS];
  }
  for (PetscInt q = 0; q < grid->nfacets; ++q) {
    if (dist->facetpart[first[2] + q] != part) continue;
    for (PetscInt a = 0; a < 4; ++a) to->ints[to->nints++] = dist->here[first[1] + grid->facets[4 * q + a]] - base;
    to->ints[to->nints++] = grid->facetface[q];
    ++sizes[PART_FACETS];
  }
  for (PetscInt v = first[1]; v < first[1] + grid->nvertices; ++v) dist->here[v] = PETSC_DECIDE;
  PetscFunctionReturn(0);
}

/* Allocates a part with its largest possible size */
static PetscErrorCode DistributePartCreate(const Distribute *dist, PetscInt part, DistributePart *to)
{
  PetscInt facets = 0, facet = 0, curve = 0;

  PetscFunctionBegin;
  for (PetscInt b = 0; b < dist->nbodies; ++b) {
    for (PetscInt q = 0; q < dist->meshes[b].grid.nfacets; ++q, ++facet) facets += dist->facetpart[facet] == part;
    if (dist->meshes[b].grid.curve) curve = MeshCurveSize(8);
  }
  to->nints = to->nreals = 0;
  PetscCall(PetscMalloc3(PART_SIZES * dist->nbodies, &to->sizes, (8 + 2 * 8) * dist->count[part] + 5 * facets,
    &to->ints, (3 * 8 + curve) * dist->count[part], &to->reals));
  PetscFunctionReturn(0);
}

static PetscErrorCode DistributePartDestroy(DistributePart *part)
{
  PetscFunctionBegin;
  PetscCall(PetscFree3(part->sizes, part->ints, part->reals));
  PetscFunctionReturn(0);
}

/* Creates a part and fills it body by body */
static PetscErrorCode DistributeFill(Distribute *dist, PetscInt part, DistributePart *to)
{
  PetscInt first[3] = {0, 0, 0}, n = 0;

  PetscFunctionBegin;
  PetscCall(DistributePartCreate(dist, part, to));
  for (PetscInt b = 0; b < dist->nbodies; ++b) {
    const ShapeGrid *grid = &dist->meshes[b].grid;

    PetscCall(DistributeNumber(dist, part, grid, first[0], first[1], &n));
    PetscCall(DistributePack(dist, part, grid, first, b, to));
    first[0] += grid->ncells;
    first[1] += grid->nvertices;
    first[2] += grid->nfacets;
  }
  PetscFunctionReturn(0);
}

/* Creates the grid of one body from a part. at: positions in the part's integers and reals, which are advanced; owners:
   owner rank of each vertex and its number there */
static PetscErrorCode DistributeUnpack(const DistributePart *part, PetscInt body, PetscInt ncorners, PetscInt at[2],
  ShapeGrid *grid, PetscSFNode owners[])
{
  const PetscInt  *sizes = part->sizes + PART_SIZES * body, curve = sizes[PART_CURVE];
  const PetscInt  *ints  = part->ints + at[0];
  const PetscReal *reals = part->reals + at[1];

  PetscFunctionBegin;
  grid->ncorners  = ncorners;
  grid->ncells    = sizes[PART_CELLS];
  grid->nvertices = sizes[PART_VERTICES];
  grid->nfacets   = sizes[PART_FACETS];
  PetscCall(PetscMalloc1(ncorners * grid->ncells, &grid->cells));
  PetscCall(PetscMalloc1(3 * grid->nvertices, &grid->coordinates));
  PetscCall(PetscMalloc1(4 * grid->nfacets, &grid->facets));
  PetscCall(PetscMalloc1(grid->nfacets, &grid->facetface));
  if (curve) PetscCall(PetscMalloc1(curve * grid->ncells, &grid->curve));
  for (PetscInt v = 0; v < grid->nvertices; ++v, ints += 2) {
    owners[v].rank  = ints[0];
    owners[v].index = ints[1];
  }
  PetscCall(PetscArraycpy(grid->coordinates, reals, 3 * grid->nvertices));
  PetscCall(PetscArraycpy(grid->cells, ints, ncorners * grid->ncells));
  ints += ncorners * grid->ncells;
  reals += 3 * grid->nvertices;
  if (curve) PetscCall(PetscArraycpy(grid->curve, reals, curve * grid->ncells));
  for (PetscInt q = 0; q < grid->nfacets; ++q, ints += 5) {
    PetscCall(PetscArraycpy(grid->facets + 4 * q, ints, 4));
    grid->facetface[q] = ints[4];
  }
  at[0] = (PetscInt)(ints - part->ints);
  at[1] += 3 * grid->nvertices + curve * grid->ncells;
  PetscFunctionReturn(0);
}

/* Replaces the grids of all bodies by this rank's part of them */
static PetscErrorCode DistributeUseOwnPart(PetscInt nbodies, const DistributePart *part, MeshBody meshes[],
  MeshOwners *owners)
{
  PetscInt at[2] = {0, 0};

  PetscFunctionBegin;
  owners->n = 0;
  for (PetscInt b = 0; b < nbodies; ++b) owners->n += part->sizes[PART_SIZES * b + PART_VERTICES];
  PetscCall(PetscMalloc1(owners->n, &owners->points));
  for (PetscInt b = 0, vertex = 0; b < nbodies; ++b) {
    PetscCall(ShapeGridDestroy(&meshes[b].grid));
    PetscCall(DistributeUnpack(part, b, meshes[b].ncorners, at, &meshes[b].grid, owners->points + vertex));
    vertex += meshes[b].grid.nvertices;
  }
  PetscFunctionReturn(0);
}

/* Returns the numbers of sizes, integers and reals of a part as those of messages; an error if MPI cannot send them */
static PetscErrorCode DistributeCounts(PetscInt nbodies, const PetscInt counts[2], PetscMPIInt n[3])
{
  PetscFunctionBegin;
  PetscCall(PetscMPIIntCast(PART_SIZES * nbodies, &n[0]));
  for (PetscInt k = 0; k < 2; ++k) PetscCall(PetscMPIIntCast(counts[k], &n[1 + k]));
  PetscFunctionReturn(0);
}

/* Sends a part from the first rank to rank `to`, which first reports whether it could allocate the memory. A part
   without sizes means that the transfer has failed. */
static PetscErrorCode DistributeSend(MPI_Comm comm, PetscInt nbodies, const DistributePart *part, PetscMPIInt to)
{
  PetscInt    counts[2] = {part->sizes ? part->nints : PETSC_DECIDE, part->nreals};
  PetscMPIInt has_memory, n[3];

  PetscFunctionBegin;
  PetscCallMPI(MPI_Send(counts, 2, MPIU_INT, to, 0, comm));
  if (!part->sizes) PetscFunctionReturn(0);
  PetscCallMPI(MPI_Recv(&has_memory, 1, MPI_INT, to, 0, comm, MPI_STATUS_IGNORE));
  if (!has_memory) PetscFunctionReturn(0);
  PetscCall(DistributeCounts(nbodies, counts, n));
  PetscCallMPI(MPI_Send(part->sizes, n[0], MPIU_INT, to, 0, comm));
  PetscCallMPI(MPI_Send(part->ints, n[1], MPIU_INT, to, 0, comm));
  PetscCallMPI(MPI_Send(part->reals, n[2], MPIU_REAL, to, 0, comm));
  PetscFunctionReturn(0);
}

/* Receives this rank's part from the first rank */
static PetscErrorCode DistributeReceive(MPI_Comm comm, PetscInt nbodies, DistributePart *part)
{
  PetscErrorCode ierr;
  PetscInt       counts[2];
  PetscMPIInt    has_memory, n[3];

  PetscFunctionBegin;
  PetscCallMPI(MPI_Recv(counts, 2, MPIU_INT, 0, 0, comm, MPI_STATUS_IGNORE));
  if (counts[0] < 0) PetscFunctionReturn(0);
  part->nints  = counts[0];
  part->nreals = counts[1];
  ierr         = PetscMalloc3(PART_SIZES * nbodies, &part->sizes, counts[0], &part->ints, counts[1], &part->reals);
  has_memory   = !ierr;
  PetscCallMPI(MPI_Send(&has_memory, 1, MPI_INT, 0, 0, comm));
  PetscCall(ierr);
  PetscCall(DistributeCounts(nbodies, counts, n));
  PetscCallMPI(MPI_Recv(part->sizes, n[0], MPIU_INT, 0, 0, comm, MPI_STATUS_IGNORE));
  PetscCallMPI(MPI_Recv(part->ints, n[1], MPIU_INT, 0, 0, comm, MPI_STATUS_IGNORE));
  PetscCallMPI(MPI_Recv(part->reals, n[2], MPIU_REAL, 0, 0, comm, MPI_STATUS_IGNORE));
  PetscFunctionReturn(0);
}

/* Creates and sends all parts; the first rank keeps its own. If a part cannot be created, the remaining ranks receive a
   part without sizes, because they wait for a message. */
static PetscErrorCode DistributeSendAll(Distribute *dist, DistributePart *own)
{
  PetscErrorCode ierr;

  PetscFunctionBegin;
  ierr = DistributeFill(dist, 0, own);
  for (PetscMPIInt p = 1; p < dist->nparts; ++p) {
    DistributePart part = {.sizes = NULL};

    if (!ierr) ierr = DistributeFill(dist, p, &part);
    if (ierr) PetscCall(DistributePartDestroy(&part));
    PetscCall(DistributeSend(dist->comm, dist->nbodies, &part, p));
    PetscCall(DistributePartDestroy(&part));
  }
  PetscCall(ierr);
  PetscFunctionReturn(0);
}

/* Exchanges the parts. Ranks may fail independently: their errors are raised on all ranks afterwards. */
static PetscErrorCode DistributeExchange(Distribute *dist, MeshOwners *owners)
{
  DistributePart part = {.sizes = NULL};
  PetscMPIInt    rank;

  PetscFunctionBegin;
  PetscCallMPI(MPI_Comm_rank(dist->comm, &rank));
  if (rank) PetscCall(DistributeReceive(dist->comm, dist->nbodies, &part));
  else PetscCall(DistributeSendAll(dist, &part));
  if (part.sizes) PetscCall(DistributeUseOwnPart(dist->nbodies, &part, dist->meshes, owners));
  PetscCall(DistributePartDestroy(&part));
  PetscFunctionReturn(0);
}

PetscErrorCode MeshDistributeGrids(MPI_Comm comm, PetscInt nbodies, MeshBody meshes[], MeshOwners *owners)
{
  Distribute  dist = {.comm = comm, .nbodies = nbodies, .meshes = meshes};
  PetscMPIInt rank;

  PetscFunctionBegin;
  PetscCallMPI(MPI_Comm_rank(comm, &rank));
  RankCallFor(comm, !rank, DistributePrepare(&dist), "The first rank cannot partition the mesh of all bodies: ");
  RankCallFor(comm, PETSC_TRUE, DistributeExchange(&dist, owners),
    "The mesh of all bodies cannot be distributed to the ranks: ");
  PetscCall(PetscFree3(dist.part, dist.count, dist.facetpart));
  PetscCall(PetscFree3(dist.owner, dist.place, dist.here));
  PetscFunctionReturn(0);
}

PetscErrorCode MeshOwnersDestroy(MeshOwners *owners)
{
  PetscFunctionBegin;
  PetscCall(PetscFree(owners->points));
  owners->n = 0;
  PetscFunctionReturn(0);
}
