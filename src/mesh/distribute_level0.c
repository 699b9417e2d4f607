/*
   Distributes the grids of all bodies from the first rank before a DMPlex is built, which needs several times their
   memory. No rank then holds more than its part of the DMPlex. METIS partitions the cells by their dual graph; each
   part is sent with its vertices, facets and curves.
*/
#include "meshimpl.h"
#include <metis.h>

/* The part for a rank: sizes of each body's grid, its integers and reals one after another, and the vertices' owners */
typedef struct {
  PetscInt   nints, nreals;
  PetscInt  *sizes; /* DEAL_SIZES per body */
  PetscInt  *ints;
  PetscReal *reals;
} DistributePart;

enum { DEAL_CELLS, DEAL_VERTICES, DEAL_FACETS, DEAL_CURVE, DEAL_SIZES };

/* Data of the distribution on the first rank. Cells and vertices are numbered through all bodies */
typedef struct {
  MPI_Comm    comm;
  PetscMPIInt nparts;
  PetscInt    nbodies, ncells, nvertices;
  MeshBody   *meshes;
  PetscInt   *part;      /* part of each cell */
  PetscInt   *count;     /* number of cells of each part */
  PetscInt   *facetpart; /* part of each facet, numbered through all bodies */
  PetscInt   *owner;     /* owner of each vertex: the first part that contains it */
  PetscInt   *place;     /* number of each vertex within its owner */
  PetscInt   *here;      /* number of each vertex within the current part; PETSC_DECIDE: not in it */
} Distribute;

/* Partitions the dual graph (cells that share a facet) by METIS */
static PetscErrorCode DistributePartition(Distribute *deal)
{
  idx_t     ne = (idx_t)deal->ncells, nn = (idx_t)deal->nvertices, common = 3, base = 0, *start, *nodes, *xadj, *adjncy;
  PetscInt *xadjacency, *adjacency, cell = 0, vertex = 0;
  int       status;

  PetscFunctionBegin;
  PetscCheck(deal->ncells <= PETSC_MPI_INT_MAX / 8, PETSC_COMM_SELF, PETSC_ERR_SUP,
    "METIS's integers are too small for %" PetscInt_FMT " cells; read a coarser mesh and refine it", deal->ncells);
  PetscCall(PetscMalloc2(deal->ncells + 1, &start, 8 * deal->ncells, &nodes));
  start[0] = 0;
  for (PetscInt b = 0; b < deal->nbodies; ++b) {
    const ShapeGrid *grid = &deal->meshes[b].grid;

    for (PetscInt c = 0; c < grid->ncells; ++c, ++cell) {
      for (PetscInt a = 0; a < grid->ncorners; ++a)
        nodes[start[cell] + a] = (idx_t)(vertex + grid->cells[grid->ncorners * c + a]);
      start[cell + 1] = start[cell] + (idx_t)grid->ncorners;
    }
    vertex += grid->nvertices;
  }
  status = METIS_MeshToDual(&ne, &nn, start, nodes, &common, &base, &xadj, &adjncy);
  PetscCheck(status == METIS_OK, PETSC_COMM_SELF, PETSC_ERR_LIB,
    "METIS failed with status %d on the dual graph of %" PetscInt_FMT " cells", status, deal->ncells);
  PetscCall(PetscFree2(start, nodes));
  PetscCall(PetscMalloc2(deal->ncells + 1, &xadjacency, xadj[ne], &adjacency));
  for (PetscInt c = 0; c <= deal->ncells; ++c) xadjacency[c] = (PetscInt)xadj[c];
  for (PetscInt e = 0; e < xadjacency[deal->ncells]; ++e) adjacency[e] = (PetscInt)adjncy[e];
  METIS_Free(xadj);
  METIS_Free(adjncy);
  PetscCall(MetisPartitionGraph(deal->nparts, deal->ncells, xadjacency, adjacency, NULL, deal->part));
  PetscCall(PetscFree2(xadjacency, adjacency));
  PetscFunctionReturn(0);
}

/* Counts the cells of each part, and finds the first part that contains each vertex */
static PetscErrorCode DistributeOwners(Distribute *deal)
{
  PetscInt cell = 0, vertex = 0;

  PetscFunctionBegin;
  PetscCall(PetscArrayzero(deal->count, deal->nparts));
  for (PetscInt v = 0; v < deal->nvertices; ++v) deal->owner[v] = deal->nparts;
  for (PetscInt b = 0; b < deal->nbodies; ++b) {
    const ShapeGrid *grid = &deal->meshes[b].grid;

    for (PetscInt c = 0; c < grid->ncells; ++c, ++cell) {
      ++deal->count[deal->part[cell]];
      for (PetscInt a = 0; a < grid->ncorners; ++a) {
        PetscInt *owner = &deal->owner[vertex + grid->cells[grid->ncorners * c + a]];

        *owner = PetscMin(*owner, deal->part[cell]);
      }
    }
    vertex += grid->nvertices;
  }
  PetscFunctionReturn(0);
}

/* Whether the cell has all vertices of the facet */
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

/* Assigns each facet to the part of its cell, searched among the cells at its first vertex; firstcell, firstfacet:
   offsets of the body */
static PetscErrorCode DistributeFacets(Distribute *deal, const ShapeGrid *grid, PetscInt firstcell, PetscInt firstfacet)
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

    deal->facetpart[firstfacet + q] = PETSC_DECIDE;
    for (PetscInt i = start[facet[0]]; i < start[facet[0] + 1] && deal->facetpart[firstfacet + q] < 0; ++i) {
      if (DistributeCellHas(grid, cells[i], facet)) deal->facetpart[firstfacet + q] = deal->part[firstcell + cells[i]];
    }
    PetscCheck(deal->facetpart[firstfacet + q] >= 0, PETSC_COMM_SELF, PETSC_ERR_PLIB,
      "Facet %" PetscInt_FMT " belongs to no cell", q);
  }
  PetscCall(PetscFree(start));
  PetscCall(PetscFree(cells));
  PetscFunctionReturn(0);
}

static PetscErrorCode DistributePrepare(Distribute *deal)
{
  PetscInt nfacets = 0, cell = 0, facet = 0;

  PetscFunctionBegin;
  PetscCallMPI(MPI_Comm_size(deal->comm, &deal->nparts));
  for (PetscInt b = 0; b < deal->nbodies; ++b) {
    deal->ncells += deal->meshes[b].grid.ncells;
    deal->nvertices += deal->meshes[b].grid.nvertices;
    nfacets += deal->meshes[b].grid.nfacets;
  }
  PetscCall(PetscMalloc3(deal->ncells, &deal->part, deal->nparts, &deal->count, nfacets, &deal->facetpart));
  PetscCall(PetscMalloc3(deal->nvertices, &deal->owner, deal->nvertices, &deal->place, deal->nvertices, &deal->here));
  for (PetscInt v = 0; v < deal->nvertices; ++v) deal->here[v] = PETSC_DECIDE;
  PetscCall(DistributePartition(deal));
  PetscCall(DistributeOwners(deal));
  for (PetscInt b = 0; b < deal->nbodies; ++b) {
    PetscCall(DistributeFacets(deal, &deal->meshes[b].grid, cell, facet));
    cell += deal->meshes[b].grid.ncells;
    facet += deal->meshes[b].grid.nfacets;
  }
  for (PetscInt p = 0; p < deal->nparts; ++p) {
    PetscCheck(deal->count[p] <= PETSC_MPI_INT_MAX / 128, PETSC_COMM_SELF, PETSC_ERR_SUP,
      "A rank's part of %" PetscInt_FMT " cells is more than a message takes; use more ranks", deal->count[p]);
  }
  PetscFunctionReturn(0);
}

/* Numbers the vertices of one body's cells in a part, in their original order; n: number in the part so far */
static PetscErrorCode DistributeNumber(Distribute *deal, PetscInt part, const ShapeGrid *grid, PetscInt firstcell,
  PetscInt firstvertex, PetscInt *n)
{
  PetscFunctionBegin;
  for (PetscInt c = 0; c < grid->ncells; ++c) {
    for (PetscInt a = 0; deal->part[firstcell + c] == part && a < grid->ncorners; ++a)
      deal->here[firstvertex + grid->cells[grid->ncorners * c + a]] = 0;
  }
  for (PetscInt v = firstvertex; v < firstvertex + grid->nvertices; ++v) {
    if (deal->here[v] < 0) continue;
    deal->here[v] = (*n)++;
    if (deal->owner[v] == part) deal->place[v] = deal->here[v];
  }
  PetscFunctionReturn(0);
}

/* Appends one body's part to the data of a part; then resets the numbers of its vertices */
static PetscErrorCode DistributePack(Distribute *deal, PetscInt part, const ShapeGrid *grid, const PetscInt first[3],
  PetscInt body, DistributePart *to)
{
  PetscInt *sizes = to->sizes + DEAL_SIZES * body, base = PETSC_DECIDE;

  PetscFunctionBegin;
  PetscCall(PetscArrayzero(sizes, DEAL_SIZES));
  sizes[DEAL_CURVE] = grid->curve ? MeshCurveSize(grid->ncorners) : 0;
  for (PetscInt v = first[1]; v < first[1] + grid->nvertices; ++v) {
    if (deal->here[v] < 0) continue;
    if (base < 0) base = deal->here[v];
    to->ints[to->nints++] = deal->owner[v];
    to->ints[to->nints++] = deal->count[deal->owner[v]] + deal->place[v];
    for (PetscInt d = 0; d < 3; ++d) to->reals[to->nreals++] = grid->coordinates[3 * (v - first[1]) + d];
    ++sizes[DEAL_VERTICES];
  }
  for (PetscInt c = 0; c < grid->ncells; ++c) {
    if (deal->part[first[0] + c] != part) continue;
    for (PetscInt a = 0; a < grid->ncorners; ++a)
      to->ints[to->nints++] = deal->here[first[1] + grid->cells[grid->ncorners * c + a]] - base;
    for (PetscInt i = 0; i < sizes[DEAL_CURVE]; ++i) to->reals[to->nreals++] = grid->curve[sizes[DEAL_CURVE] * c + i];
    ++sizes[DEAL_CELLS];
  }
  for (PetscInt q = 0; q < grid->nfacets; ++q) {
    if (deal->facetpart[first[2] + q] != part) continue;
    for (PetscInt a = 0; a < 4; ++a) to->ints[to->nints++] = deal->here[first[1] + grid->facets[4 * q + a]] - base;
    to->ints[to->nints++] = grid->facetface[q];
    ++sizes[DEAL_FACETS];
  }
  for (PetscInt v = first[1]; v < first[1] + grid->nvertices; ++v) deal->here[v] = PETSC_DECIDE;
  PetscFunctionReturn(0);
}

/* Allocates a part with its largest possible size */
static PetscErrorCode DistributePartCreate(const Distribute *deal, PetscInt part, DistributePart *to)
{
  PetscInt facets = 0, facet = 0, curve = 0;

  PetscFunctionBegin;
  for (PetscInt b = 0; b < deal->nbodies; ++b) {
    for (PetscInt q = 0; q < deal->meshes[b].grid.nfacets; ++q, ++facet) facets += deal->facetpart[facet] == part;
    if (deal->meshes[b].grid.curve) curve = MeshCurveSize(8);
  }
  to->nints = to->nreals = 0;
  PetscCall(PetscMalloc3(DEAL_SIZES * deal->nbodies, &to->sizes, (8 + 2 * 8) * deal->count[part] + 5 * facets,
    &to->ints, (3 * 8 + curve) * deal->count[part], &to->reals));
  PetscFunctionReturn(0);
}

static PetscErrorCode DistributePartDestroy(DistributePart *part)
{
  PetscFunctionBegin;
  PetscCall(PetscFree3(part->sizes, part->ints, part->reals));
  PetscFunctionReturn(0);
}

static PetscErrorCode DistributeFill(Distribute *deal, PetscInt part, DistributePart *to)
{
  PetscInt first[3] = {0, 0, 0}, n = 0;

  PetscFunctionBegin;
  PetscCall(DistributePartCreate(deal, part, to));
  for (PetscInt b = 0; b < deal->nbodies; ++b) {
    const ShapeGrid *grid = &deal->meshes[b].grid;

    PetscCall(DistributeNumber(deal, part, grid, first[0], first[1], &n));
    PetscCall(DistributePack(deal, part, grid, first, b, to));
    first[0] += grid->ncells;
    first[1] += grid->nvertices;
    first[2] += grid->nfacets;
  }
  PetscFunctionReturn(0);
}

/* Extracts the grid of one body from a part; at: positions already read */
static PetscErrorCode DistributeUnpack(const DistributePart *part, PetscInt body, PetscInt ncorners, PetscInt at[2],
  ShapeGrid *grid, PetscSFNode owners[])
{
  const PetscInt  *sizes = part->sizes + DEAL_SIZES * body, curve = sizes[DEAL_CURVE];
  const PetscInt  *ints  = part->ints + at[0];
  const PetscReal *reals = part->reals + at[1];

  PetscFunctionBegin;
  grid->ncorners  = ncorners;
  grid->ncells    = sizes[DEAL_CELLS];
  grid->nvertices = sizes[DEAL_VERTICES];
  grid->nfacets   = sizes[DEAL_FACETS];
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

/* Replaces the grids by this rank's part */
static PetscErrorCode DistributeTake(PetscInt nbodies, const DistributePart *part, MeshBody meshes[],
  MeshOwners *owners)
{
  PetscInt at[2] = {0, 0};

  PetscFunctionBegin;
  owners->n = 0;
  for (PetscInt b = 0; b < nbodies; ++b) owners->n += part->sizes[DEAL_SIZES * b + DEAL_VERTICES];
  PetscCall(PetscMalloc1(owners->n, &owners->points));
  for (PetscInt b = 0, vertex = 0; b < nbodies; ++b) {
    PetscCall(ShapeGridDestroy(&meshes[b].grid));
    PetscCall(DistributeUnpack(part, b, meshes[b].ncorners, at, &meshes[b].grid, owners->points + vertex));
    vertex += meshes[b].grid.nvertices;
  }
  PetscFunctionReturn(0);
}

/* Sends a part from the first rank to another, which first reports whether it has memory. A part of size zero ends
   the transfer */
static PetscErrorCode DistributeSend(MPI_Comm comm, PetscInt nbodies, const DistributePart *part, PetscMPIInt to)
{
  PetscInt    counts[2] = {part->sizes ? part->nints : PETSC_DECIDE, part->nreals};
  PetscMPIInt room;

  PetscFunctionBegin;
  PetscCallMPI(MPI_Send(counts, 2, MPIU_INT, to, 0, comm));
  if (!part->sizes) PetscFunctionReturn(0);
  PetscCallMPI(MPI_Recv(&room, 1, MPI_INT, to, 0, comm, MPI_STATUS_IGNORE));
  if (!room) PetscFunctionReturn(0);
  PetscCallMPI(MPI_Send(part->sizes, (PetscMPIInt)(DEAL_SIZES * nbodies), MPIU_INT, to, 0, comm));
  PetscCallMPI(MPI_Send(part->ints, (PetscMPIInt)counts[0], MPIU_INT, to, 0, comm));
  PetscCallMPI(MPI_Send(part->reals, (PetscMPIInt)counts[1], MPIU_REAL, to, 0, comm));
  PetscFunctionReturn(0);
}

static PetscErrorCode DistributeReceive(MPI_Comm comm, PetscInt nbodies, DistributePart *part)
{
  PetscErrorCode ierr;
  PetscInt       counts[2];
  PetscMPIInt    room;

  PetscFunctionBegin;
  PetscCallMPI(MPI_Recv(counts, 2, MPIU_INT, 0, 0, comm, MPI_STATUS_IGNORE));
  if (counts[0] < 0) PetscFunctionReturn(0);
  part->nints  = counts[0];
  part->nreals = counts[1];
  ierr         = PetscMalloc3(DEAL_SIZES * nbodies, &part->sizes, counts[0], &part->ints, counts[1], &part->reals);
  room         = !ierr;
  PetscCallMPI(MPI_Send(&room, 1, MPI_INT, 0, 0, comm));
  PetscCall(ierr);
  PetscCallMPI(MPI_Recv(part->sizes, (PetscMPIInt)(DEAL_SIZES * nbodies), MPIU_INT, 0, 0, comm, MPI_STATUS_IGNORE));
  PetscCallMPI(MPI_Recv(part->ints, (PetscMPIInt)counts[0], MPIU_INT, 0, 0, comm, MPI_STATUS_IGNORE));
  PetscCallMPI(MPI_Recv(part->reals, (PetscMPIInt)counts[1], MPIU_REAL, 0, 0, comm, MPI_STATUS_IGNORE));
  PetscFunctionReturn(0);
}

/* Sends all parts; the first rank keeps its own. If a part cannot be created, the remaining ranks get empty parts,
   because they wait for a message */
static PetscErrorCode DistributeSendAll(Distribute *deal, DistributePart *own)
{
  PetscErrorCode ierr;

  PetscFunctionBegin;
  ierr = DistributeFill(deal, 0, own);
  for (PetscMPIInt p = 1; p < deal->nparts; ++p) {
    DistributePart part = {.sizes = NULL};

    if (!ierr) ierr = DistributeFill(deal, p, &part);
    if (ierr) PetscCall(DistributePartDestroy(&part));
    PetscCall(DistributeSend(deal->comm, deal->nbodies, &part, p));
    PetscCall(DistributePartDestroy(&part));
  }
  PetscCall(ierr);
  PetscFunctionReturn(0);
}

/* The exchange on every rank, not collective except for its messages. Errors are raised on all ranks afterwards */
static PetscErrorCode DistributeExchange(Distribute *deal, MeshOwners *owners)
{
  DistributePart part = {.sizes = NULL};
  PetscMPIInt    rank;

  PetscFunctionBegin;
  PetscCallMPI(MPI_Comm_rank(deal->comm, &rank));
  if (rank) PetscCall(DistributeReceive(deal->comm, deal->nbodies, &part));
  else PetscCall(DistributeSendAll(deal, &part));
  if (part.sizes) PetscCall(DistributeTake(deal->nbodies, &part, deal->meshes, owners));
  PetscCall(DistributePartDestroy(&part));
  PetscFunctionReturn(0);
}

PetscErrorCode MeshDistributeGrids(MPI_Comm comm, PetscInt nbodies, MeshBody meshes[], MeshOwners *owners)
{
  Distribute     deal = {.comm = comm, .nbodies = nbodies, .meshes = meshes};
  RankError      error;
  PetscErrorCode ierr = 0;
  PetscMPIInt    rank;

  PetscFunctionBegin;
  PetscCallMPI(MPI_Comm_rank(comm, &rank));
  PetscCall(RankErrorBegin(&error));
  if (!rank) ierr = DistributePrepare(&deal);
  PetscCall(RankErrorEnd(comm, ierr, &error));
  PetscCheck(!error.code, comm, error.code, "The first rank cannot partition the mesh of all bodies: %s",
    error.message);
  PetscCall(RankErrorBegin(&error));
  ierr = DistributeExchange(&deal, owners);
  PetscCall(RankErrorEnd(comm, ierr, &error));
  PetscCheck(!error.code, comm, error.code, "The mesh of all bodies cannot be distributed to the ranks: %s",
    error.message);
  PetscCall(PetscFree3(deal.part, deal.count, deal.facetpart));
  PetscCall(PetscFree3(deal.owner, deal.place, deal.here));
  PetscFunctionReturn(0);
}

PetscErrorCode MeshOwnersDestroy(MeshOwners *owners)
{
  PetscFunctionBegin;
  PetscCall(PetscFree(owners->points));
  owners->n = 0;
  PetscFunctionReturn(0);
}
