/* Evaluates fields of one mesh at points of another mesh. Each rank has its own points and tests the cells of all
   ranks, one block of cells at a time. */
#include "queryimpl.h"

#define EVALUATE_CELLS 1024 /* number of cells per block */

/* A block of cells of one rank, which is sent to all ranks */
typedef struct {
  PetscInt   nvecs;                                           /* number of vectors: the coordinates, then the fields */
  PetscInt   n, body[EVALUATE_CELLS], nnodes[EVALUATE_CELLS]; /* number of cells; body and number of nodes of each
                                                                 cell */
  PetscReal *values; /* [n][nvecs][MESH_MAX_NODES][3] values of each vector at the nodes of each cell */
} EvaluateBlock;

/* Returns the values of vector `vec` at the nodes of a cell */
static PetscReal *EvaluateBlockValues(const EvaluateBlock *block, PetscInt cell, PetscInt vec)
{
  return &block->values[3 * MESH_MAX_NODES * (block->nvecs * cell + vec)];
}

/* Fills the block with this rank's cells from number `first` on. local: the coordinates, then the fields, as local
   vectors */
static PetscErrorCode EvaluateBlockFill(DM dm, PetscInt first, const Vec local[], EvaluateBlock *block)
{
  PetscSection section;
  DMLabel      label;

  PetscFunctionBegin;
  PetscCall(DMGetLocalSection(dm, &section));
  PetscCall(DMGetLabel(dm, MESH_BODY_LABEL, &label));
  for (PetscInt v = 0; v < block->nvecs; ++v) {
    const PetscScalar *a;

    PetscCall(VecGetArrayRead(local[v], &a));
    for (PetscInt c = 0; c < block->n; ++c) {
      PetscReal *values = EvaluateBlockValues(block, c, v);
      PetscInt   nodes[MESH_MAX_NODES], offset;

      if (!v) PetscCall(DMLabelGetValue(label, first + c, &block->body[c]));
      PetscCall(MeshGetCellNodes(dm, first + c, &block->nnodes[c], nodes));
      for (PetscInt i = 0; i < 3 * block->nnodes[c]; ++i) {
        PetscCall(PetscSectionGetOffset(section, nodes[i / 3], &offset));
        values[i] = PetscRealPart(a[offset + i % 3]);
      }
    }
    PetscCall(VecRestoreArrayRead(local[v], &a));
  }
  PetscFunctionReturn(0);
}

/* Collective. Sends a block from rank `from` to all ranks */
static PetscErrorCode EvaluateBlockSend(MPI_Comm comm, PetscMPIInt from, EvaluateBlock *block)
{
  PetscFunctionBegin;
  PetscCallMPI(MPI_Bcast(&block->n, 1, MPIU_INT, from, comm));
  PetscCallMPI(MPI_Bcast(block->body, (PetscMPIInt)block->n, MPIU_INT, from, comm));
  PetscCallMPI(MPI_Bcast(block->nnodes, (PetscMPIInt)block->n, MPIU_INT, from, comm));
  PetscCallMPI(
    MPI_Bcast(block->values, (PetscMPIInt)(3 * MESH_MAX_NODES * block->nvecs * block->n), MPIU_REAL, from, comm));
  PetscFunctionReturn(0);
}

/* Tests the cells of the block, and evaluates the fields at those points whose nearest position so far is in one of
   these cells. number: number of the block's first cell among the cells of all ranks */
static PetscErrorCode EvaluateBlockUse(const EvaluateBlock *block, PetscInt number, PetscInt npoints,
  MeshLocator locator, PetscReal values[])
{
  const PetscInt   nfields = block->nvecs - 1;
  const MeshPlace *places;

  PetscFunctionBegin;
  for (PetscInt c = 0; c < block->n; ++c)
    PetscCall(MeshLocatorAddCell(locator, number + c, block->body[c], block->nnodes[c],
      (PetscReal(*)[3])EvaluateBlockValues(block, c, 0)));
  PetscCall(MeshLocatorGetPlaces(locator, &places));
  for (PetscInt i = 0; i < npoints; ++i) {
    const MeshPlace *place = &places[i];

    for (PetscInt k = 0; place->cell >= number && k < 3 * nfields; ++k) {
      const PetscReal *field = EvaluateBlockValues(block, place->cell - number, 1 + k / 3);

      values[3 * nfields * i + k] = 0;
      for (PetscInt a = 0; a < place->n; ++a) values[3 * nfields * i + k] += place->N[a] * field[3 * a + k % 3];
    }
  }
  PetscFunctionReturn(0);
}

/* Collective. Processes the cells of all ranks in turn */
static PetscErrorCode EvaluateAll(DM dm, const Vec local[], EvaluateBlock *block, PetscInt npoints, MeshLocator locator,
  PetscReal values[])
{
  MPI_Comm    comm = PetscObjectComm((PetscObject)dm);
  PetscMPIInt rank, size;
  PetscInt    cstart, cend, number = 0;

  PetscFunctionBegin;
  PetscCallMPI(MPI_Comm_rank(comm, &rank));
  PetscCallMPI(MPI_Comm_size(comm, &size));
  PetscCall(DMPlexGetHeightStratum(dm, 0, &cstart, &cend));
  for (PetscMPIInt from = 0; from < size; ++from) {
    PetscInt ncells = cend - cstart;

    PetscCallMPI(MPI_Bcast(&ncells, 1, MPIU_INT, from, comm));
    for (PetscInt first = 0; first < ncells; first += EVALUATE_CELLS) {
      block->n = PetscMin(EVALUATE_CELLS, ncells - first);
      if (rank == from) PetscCall(EvaluateBlockFill(dm, cstart + first, local, block));
      PetscCall(EvaluateBlockSend(comm, from, block));
      PetscCall(EvaluateBlockUse(block, number, npoints, locator, values));
      number += block->n;
    }
  }
  PetscFunctionReturn(0);
}

/*
   Collective. Evaluates fields of a mesh at points of the undeformed bodies. Each rank has its own points.

   - fields: nfields global vectors of the mesh
   - points: the npoints points of this rank [length]
   - body: the body in which each point is searched for; PETSC_DECIDE: any body
   - values: [npoints][nfields][3] values of the fields; zeros if no cell is near a point
   - missing: number of points, on all ranks, without a cell near

   A point on a curved surface may lie outside the facets. It gets the values at the nearest position in a neighbouring
   cell.
*/
PetscErrorCode MeshEvaluate(DM dm, PetscInt nfields, const Vec fields[], PetscInt npoints, const PetscReal points[][3],
  const PetscInt body[], PetscReal values[], PetscInt *missing)
{
  EvaluateBlock    block = {.nvecs = 1 + nfields};
  MeshLocator      locator;
  const MeshPlace *places;
  Vec             *local;

  PetscFunctionBegin;
  PetscCall(PetscMalloc2(block.nvecs, &local, 3 * MESH_MAX_NODES * block.nvecs * EVALUATE_CELLS, &block.values));
  PetscCall(MeshGetNodeCoordinates(dm, &local[0]));
  for (PetscInt f = 0; f < nfields; ++f) {
    PetscCall(DMGetLocalVector(dm, &local[1 + f]));
    PetscCall(DMGlobalToLocal(dm, fields[f], INSERT_VALUES, local[1 + f]));
  }
  PetscCall(PetscArrayzero(values, 3 * nfields * npoints));
  PetscCall(MeshLocatorCreate(npoints, points, body, &locator));
  PetscCall(EvaluateAll(dm, local, &block, npoints, locator, values));
  PetscCall(MeshLocatorGetPlaces(locator, &places));
  *missing = 0;
  for (PetscInt i = 0; i < npoints; ++i) *missing += places[i].cell < 0;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, missing, 1, MPIU_INT, MPI_SUM, PetscObjectComm((PetscObject)dm)));
  PetscCall(MeshLocatorDestroy(&locator));
  for (PetscInt f = 0; f < nfields; ++f) PetscCall(DMRestoreLocalVector(dm, &local[1 + f]));
  PetscCall(PetscFree2(local, block.values));
  PetscFunctionReturn(0);
}
