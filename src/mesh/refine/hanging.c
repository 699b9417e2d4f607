/* Hanging vertices in the middle of an edge or side of a coarser cell. Their position and displacement are the mean
   of its 2 or 4 vertices, none of which hangs itself. */
#include "refineimpl.h"
#include <petscsf.h>

#define MESH_HANGING "hanging" /* key of the matrix of the means, composed on the mesh; one row per node */

/* Data that are distributed with the mesh: the number of each cell; for each vertex its number and, if it hangs,
   those of up to four others */
PetscErrorCode MeshHangingCreate(const MeshHexes *hexes, DM dm, MeshHanging *hanging)
{
  PetscInt   pstart, pend, n, offset = 0;
  PetscBool *hangs;

  PetscFunctionBegin;
  PetscCall(PetscMalloc1(hexes->nvertices, &hangs));
  PetscCall(MeshHexesFindHanging(hexes, hangs));
  PetscCall(DMPlexGetChart(dm, &pstart, &pend));
  PetscCall(PetscSectionCreate(PetscObjectComm((PetscObject)dm), &hanging->section));
  PetscCall(PetscSectionSetChart(hanging->section, pstart, pend));
  for (PetscInt c = 0; c < hexes->ncells; ++c) PetscCall(PetscSectionSetDof(hanging->section, c, 1));
  for (PetscInt v = 0; v < hexes->nvertices; ++v)
    PetscCall(PetscSectionSetDof(hanging->section, hexes->ncells + v, hangs[v] ? 5 : 1));
  PetscCall(PetscSectionSetUp(hanging->section));
  PetscCall(PetscSectionGetStorageSize(hanging->section, &n));
  PetscCall(PetscMalloc1(n, &hanging->numbers));
  for (PetscInt c = 0; c < hexes->ncells; ++c) hanging->numbers[offset++] = c;
  for (PetscInt v = 0; v < hexes->nvertices; ++v) {
    hanging->numbers[offset++] = v;
    for (PetscInt i = 0; i < 4 && hangs[v]; ++i) hanging->numbers[offset++] = hexes->parent[4 * v + i];
  }
  PetscCall(PetscFree(hangs));
  PetscFunctionReturn(0);
}

PetscErrorCode MeshHangingDestroy(MeshHanging *hanging)
{
  PetscFunctionBegin;
  PetscCall(PetscSectionDestroy(&hanging->section));
  PetscCall(PetscFree(hanging->numbers));
  PetscFunctionReturn(0);
}

PetscErrorCode MeshHangingDistribute(PetscSF sf, DM before, MeshHanging *hanging)
{
  PetscSection section;
  PetscInt    *numbers = NULL;

  PetscFunctionBegin;
  if (!hanging->section) PetscFunctionReturn(0);
  PetscCall(PetscSectionCreate(PetscObjectComm((PetscObject)before), &section));
  PetscCall(DMPlexDistributeData(before, sf, hanging->section, MPIU_INT, hanging->numbers, section, (void **)&numbers));
  PetscCall(MeshHangingDestroy(hanging));
  hanging->section = section;
  hanging->numbers = numbers;
  PetscFunctionReturn(0);
}

/* Vertices of this rank by number: the owned ones, and those of them that hang */
typedef struct {
  PetscInt nowned, *number, *node; /* of owned vertices: numbers and global nodes */
  PetscInt n, *at, *parent;        /* of hanging vertices: global nodes, and four numbers each */
  PetscInt largest;                /* largest number on all ranks; -1: no vertices */
} HangingVertices;

static PetscErrorCode HangingVerticesCreate(DM dm, const MeshHanging *hanging, HangingVertices *vertices)
{
  PetscSection global;
  PetscInt     vstart, vend;

  PetscFunctionBegin;
  PetscCall(PetscMemzero(vertices, sizeof(*vertices)));
  vertices->largest = -1;
  PetscCall(DMGetGlobalSection(dm, &global));
  PetscCall(DMPlexGetDepthStratum(dm, 0, &vstart, &vend));
  PetscCall(PetscMalloc4(vend - vstart, &vertices->number, vend - vstart, &vertices->node, vend - vstart, &vertices->at,
    4 * (vend - vstart), &vertices->parent));
  for (PetscInt v = vstart; v < vend; ++v) {
    PetscInt n, offset, row;

    PetscCall(PetscSectionGetDof(hanging->section, v, &n));
    PetscCall(PetscSectionGetOffset(hanging->section, v, &offset));
    PetscCall(PetscSectionGetOffset(global, v, &row));
    vertices->largest = PetscMax(vertices->largest, hanging->numbers[offset]);
    if (row < 0) continue;
    vertices->number[vertices->nowned] = hanging->numbers[offset];
    vertices->node[vertices->nowned++] = row / 3;
    if (n == 1) continue;
    PetscCall(PetscArraycpy(&vertices->parent[4 * vertices->n], &hanging->numbers[offset + 1], 4));
    vertices->at[vertices->n++] = row / 3;
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &vertices->largest, 1, MPIU_INT, MPI_MAX, PetscObjectComm((PetscObject)dm)));
  PetscFunctionReturn(0);
}

/* Replaces the numbers of parents by their global nodes */
static PetscErrorCode HangingFindParents(MPI_Comm comm, HangingVertices *vertices)
{
  PetscLayout layout;
  PetscSF     sf;
  PetscInt   *node, n = 0, nroots, *wanted, *found;

  PetscFunctionBegin;
  PetscCall(PetscLayoutCreateFromSizes(comm, PETSC_DECIDE, vertices->largest + 1, 1, &layout));
  PetscCall(PetscLayoutGetLocalSize(layout, &nroots));
  PetscCall(PetscMalloc3(nroots, &node, 4 * vertices->n, &wanted, 4 * vertices->n, &found));
  PetscCall(PetscSFCreate(comm, &sf));
  PetscCall(PetscSFSetGraphLayout(sf, layout, vertices->nowned, NULL, PETSC_COPY_VALUES, vertices->number));
  PetscCall(PetscSFReduceBegin(sf, MPIU_INT, vertices->node, node, MPI_REPLACE));
  PetscCall(PetscSFReduceEnd(sf, MPIU_INT, vertices->node, node, MPI_REPLACE));
  for (PetscInt i = 0; i < 4 * vertices->n; ++i) {
    if (vertices->parent[i] >= 0) wanted[n++] = vertices->parent[i];
  }
  PetscCall(PetscSFSetGraphLayout(sf, layout, n, NULL, PETSC_COPY_VALUES, wanted));
  PetscCall(PetscSFBcastBegin(sf, MPIU_INT, node, found, MPI_REPLACE));
  PetscCall(PetscSFBcastEnd(sf, MPIU_INT, node, found, MPI_REPLACE));
  n = 0;
  for (PetscInt i = 0; i < 4 * vertices->n; ++i) {
    if (vertices->parent[i] >= 0) vertices->parent[i] = found[n++];
  }
  PetscCall(PetscSFDestroy(&sf));
  PetscCall(PetscFree3(node, wanted, found));
  PetscCall(PetscLayoutDestroy(&layout));
  PetscFunctionReturn(0);
}

/* Creates the matrix of means, in the rows of hanging nodes */
static PetscErrorCode HangingCreateMeans(DM dm, const HangingVertices *vertices, Mat *means)
{
  PetscInt n;
  Vec      u;

  PetscFunctionBegin;
  PetscCall(DMGetGlobalVector(dm, &u));
  PetscCall(VecGetLocalSize(u, &n));
  PetscCall(DMRestoreGlobalVector(dm, &u));
  PetscCall(MatCreateAIJ(PetscObjectComm((PetscObject)dm), n / 3, n / 3, PETSC_DETERMINE, PETSC_DETERMINE, 4, NULL, 4,
    NULL, means));
  for (PetscInt i = 0; i < vertices->n; ++i) {
    const PetscReal weight = vertices->parent[4 * i + 2] < 0 ? 0.5 : 0.25;

    for (PetscInt k = 0; k < 4; ++k)
      PetscCall(MatSetValue(*means, vertices->at[i], vertices->parent[4 * i + k], weight,
        INSERT_VALUES)); /* PETSc ignores negative columns */
  }
  PetscCall(MatAssemblyBegin(*means, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(*means, MAT_FINAL_ASSEMBLY));
  PetscFunctionReturn(0);
}

/* Composes the matrix of means on the mesh, if any vertex hangs; call after the layout of the unknowns */
PetscErrorCode MeshHangingFinish(DM dm, MeshHanging *hanging)
{
  MPI_Comm        comm = PetscObjectComm((PetscObject)dm);
  HangingVertices vertices;
  PetscInt        total;
  Mat             means;

  PetscFunctionBegin;
  if (!hanging->section) PetscFunctionReturn(0);
  PetscCall(HangingVerticesCreate(dm, hanging, &vertices));
  PetscCallMPI(MPI_Allreduce(&vertices.n, &total, 1, MPIU_INT, MPI_SUM, comm));
  if (total) {
    PetscCall(HangingFindParents(comm, &vertices));
    PetscCall(HangingCreateMeans(dm, &vertices, &means));
    PetscCall(PetscObjectCompose((PetscObject)dm, MESH_HANGING, (PetscObject)means));
    PetscCall(MatDestroy(&means));
  }
  PetscCall(PetscFree4(vertices.number, vertices.node, vertices.at, vertices.parent));
  PetscCall(MeshNumberCells(dm, hanging));
  PetscCall(MeshHangingDestroy(hanging));
  PetscFunctionReturn(0);
}

/* Gets the hanging vertices: those in the middle of an edge or a facet of a cell that is refined less than its
   neighbour. dm: mesh from MeshCreateScene(); means: a square matrix of all nodes, AIJ, whose rows at hanging vertices
   hold the weights of those that they are the mean of, none of which hangs; the others are empty. The mesh's own; NULL
   where no vertex hangs. */
PetscErrorCode MeshGetHanging(DM dm, Mat *means)
{
  PetscFunctionBegin;
  PetscCall(PetscObjectQuery((PetscObject)dm, MESH_HANGING, (PetscObject *)means));
  PetscFunctionReturn(0);
}

/* Collective. Counts the hanging vertices of all ranks. dm: mesh from MeshCreateScene(); n: their number. */
PetscErrorCode MeshCountHanging(DM dm, PetscInt *n)
{
  PetscInt start = 0, end = 0;
  Mat      means;

  PetscFunctionBegin;
  *n = 0;
  PetscCall(MeshGetHanging(dm, &means));
  if (means) PetscCall(MatGetOwnershipRange(means, &start, &end));
  for (PetscInt i = start; i < end; ++i) {
    PetscInt length;

    PetscCall(MatGetRow(means, i, &length, NULL, NULL));
    *n += length > 0;
    PetscCall(MatRestoreRow(means, i, &length, NULL, NULL));
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, n, 1, MPIU_INT, MPI_SUM, PetscObjectComm((PetscObject)dm)));
  PetscFunctionReturn(0);
}

/* Sets one component of v at the hanging nodes to the mean at their neighbours */
static PetscErrorCode HangingSetMeans(Mat means, PetscInt component, Vec v)
{
  Vec                from, to;
  const PetscScalar *a;
  PetscInt           start, end;

  PetscFunctionBegin;
  PetscCall(MatCreateVecs(means, &from, &to));
  PetscCall(VecStrideGather(v, component, from, INSERT_VALUES));
  PetscCall(MatMult(means, from, to));
  PetscCall(MatGetOwnershipRange(means, &start, &end));
  PetscCall(VecGetArrayRead(to, &a));
  for (PetscInt i = start; i < end; ++i) {
    PetscInt n;

    PetscCall(MatGetRow(means, i, &n, NULL, NULL));
    if (n) PetscCall(VecSetValue(v, 3 * i + component, a[i - start], INSERT_VALUES));
    PetscCall(MatRestoreRow(means, i, &n, NULL, NULL));
  }
  PetscCall(VecRestoreArrayRead(to, &a));
  PetscCall(VecAssemblyBegin(v));
  PetscCall(VecAssemblyEnd(v));
  PetscCall(VecDestroy(&from));
  PetscCall(VecDestroy(&to));
  PetscFunctionReturn(0);
}

/* Sets the positions of hanging vertices from those of the others */
PetscErrorCode MeshHangingPlace(DM dm)
{
  Mat means;
  Vec places, x;

  PetscFunctionBegin;
  PetscCall(MeshGetHanging(dm, &means));
  if (!means) PetscFunctionReturn(0);
  PetscCall(MeshGetNodeCoordinates(dm, &places));
  PetscCall(DMGetGlobalVector(dm, &x));
  PetscCall(DMLocalToGlobal(dm, places, INSERT_VALUES, x));
  for (PetscInt d = 0; d < 3; ++d) PetscCall(HangingSetMeans(means, d, x));
  PetscCall(DMGlobalToLocal(dm, x, INSERT_VALUES, places));
  PetscCall(DMRestoreGlobalVector(dm, &x));
  PetscFunctionReturn(0);
}
