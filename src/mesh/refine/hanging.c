/* Hanging vertices are in the middle of an edge or a side of a coarser cell. Their position and displacement are the
   mean of the 2 or 4 vertices of that edge or side, none of which hangs itself. */
#include "refineimpl.h"
#include <petscsf.h>

/* key under which the matrix of means is composed with the mesh; the matrix has one row per node */
#define MESH_HANGING "hanging"

/* Creates the data that are distributed with the mesh: the number of each cell; the number of each vertex; and, if the
   vertex hangs, the numbers of the 2 or 4 vertices of which it is the mean, filled up with -1 */
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

static PetscErrorCode MeshHangingDestroy(MeshHanging *hanging)
{
  PetscFunctionBegin;
  PetscCall(PetscSectionDestroy(&hanging->section));
  PetscCall(PetscFree(hanging->numbers));
  PetscFunctionReturn(0);
}

/* Collective. Distributes the data with the mesh. sf: migration of the mesh's points */
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

/* The vertices that this rank owns, and those of them that hang. Numbers are those of the mesh on the first rank. */
typedef struct {
  PetscInt nowned, *number, *node; /* of the owned vertices: numbers, and global numbers of the nodes */
  PetscInt n, *at, *parent; /* of the owned hanging vertices: global numbers of the nodes, and the numbers of four
                               vertices each, -1 for none */
  PetscInt largest;         /* largest number on all ranks; -1 if there are no vertices */
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

/* Collective. Replaces the numbers of the vertices in `parent` by their global node numbers */
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

/* Collective. Creates the matrix of means: the row of a hanging node has the weights 1/2 or 1/4 */
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

    /* PETSc ignores negative columns. */
    for (PetscInt k = 0; k < 4; ++k)
      PetscCall(MatSetValue(*means, vertices->at[i], vertices->parent[4 * i + k], weight, INSERT_VALUES));
  }
  PetscCall(MatAssemblyBegin(*means, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(*means, MAT_FINAL_ASSEMBLY));
  PetscFunctionReturn(0);
}

/* Collective. Composes the matrix of means with the mesh if any vertex hangs. The unknowns must have been laid out
   before. */
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

/*
   Gets the matrix of means of the hanging vertices, which are in the middle of an edge or a facet of a cell that is
   refined less than its neighbour. means: a square AIJ matrix with one row and one column per node, owned by the mesh.
   The row of a hanging vertex has the weights of the vertices of which it is the mean; none of these hangs. Other rows
   are empty. NULL if no vertex hangs.
*/
PetscErrorCode MeshGetHanging(DM dm, Mat *means)
{
  PetscFunctionBegin;
  PetscCall(PetscObjectQuery((PetscObject)dm, MESH_HANGING, (PetscObject *)means));
  PetscFunctionReturn(0);
}

/* Collective. Counts the hanging vertices of all ranks */
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

/* Sets one component of v at the hanging nodes to the mean of its values at the nodes on which they depend */
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

/* Collective. Sets the positions of hanging vertices to the mean of the vertices on which they depend */
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
