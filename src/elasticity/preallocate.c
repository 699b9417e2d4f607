/*
   Nonzero pattern of the tangent, from the nodes' adjacency. DMCreateMatrix() would take as long as several assemblies.
*/
#include "elasticityimpl.h"

/* Lists the cells around each local node, in compressed rows */
static PetscErrorCode ElasticityNodeCells(Elasticity e, PetscInt **offsets, PetscInt **cells)
{
  PetscInt *first, *list;

  PetscFunctionBegin;
  PetscCall(PetscCalloc1(e->nnodes + 1, &first));
  PetscCall(PetscMalloc1(e->cellstart[e->ncells], &list));
  for (PetscInt i = 0; i < e->cellstart[e->ncells]; ++i) ++first[e->cellnodes[i]];
  for (PetscInt v = 0, sum = 0; v <= e->nnodes; ++v) {
    sum += first[v];
    first[v] = sum;
  }
  for (PetscInt c = e->ncells - 1; c >= 0; --c) {
    for (PetscInt i = e->cellstart[c]; i < e->cellstart[c + 1]; ++i) list[--first[e->cellnodes[i]]] = c;
  }
  *offsets = first;
  *cells   = list;
  PetscFunctionReturn(0);
}

/* Lists the distinct nodes of the cells around each local node, including the node itself, in compressed rows */
static PetscErrorCode ElasticityNodeAdjacency(Elasticity e, PetscInt **offsets, PetscInt **neighbours)
{
  PetscInt *first = NULL, *cells = NULL, *start, *list = NULL, *seen, n = 0;

  PetscFunctionBegin;
  PetscCall(ElasticityNodeCells(e, &first, &cells));
  PetscCall(PetscMalloc1(e->nnodes, &seen));
  PetscCall(PetscMalloc1(e->nnodes + 1, &start));
  for (PetscInt v = 0; v < e->nnodes; ++v) seen[v] = -1;
  for (PetscInt pass = 0; pass < 2; ++pass) { /* the first pass counts, the second fills */
    if (pass) PetscCall(PetscMalloc1(n, &list));
    n = 0;
    for (PetscInt v = 0; v < e->nnodes; ++v) {
      start[v] = n;
      for (PetscInt i = first[v]; i < first[v + 1]; ++i) {
        for (PetscInt k = e->cellstart[cells[i]]; k < e->cellstart[cells[i] + 1]; ++k) {
          const PetscInt w = e->cellnodes[k];

          if (seen[w] == v + pass * e->nnodes) continue;
          seen[w] = v + pass * e->nnodes;
          if (pass) list[n] = w;
          ++n;
        }
      }
    }
    start[e->nnodes] = n;
  }
  PetscCall(PetscFree(seen));
  PetscCall(PetscFree(first));
  PetscCall(PetscFree(cells));
  *offsets    = start;
  *neighbours = list;
  PetscFunctionReturn(0);
}

/*
   Counts the neighbours of each owned node: those on this rank, those on other ranks, and both again for neighbours
   whose number is not below that of the node. The counts are exact for a node whose cells are all on this rank. For a
   node shared with other ranks the counts of all ranks are added; neighbours on the interface are then counted several
   times, and MatAssemblyEnd() frees the surplus.
*/
static PetscErrorCode ElasticityCountNeighbours(Elasticity e, PetscLayout layout, const PetscInt global[],
  const PetscInt start[], const PetscInt neighbours[], PetscInt nowned, PetscInt *owned[4])
{
  PetscSF   sf;
  PetscInt *local[4], N;

  PetscFunctionBegin;
  PetscCall(PetscCalloc4(e->nnodes, &local[0], e->nnodes, &local[1], e->nnodes, &local[2], e->nnodes, &local[3]));
  for (PetscInt v = 0; v < e->nnodes; ++v) {
    PetscMPIInt owner, neighbourowner;

    PetscCall(PetscLayoutFindOwner(layout, global[v], &owner));
    for (PetscInt i = start[v]; i < start[v + 1]; ++i) {
      const PetscInt w = global[neighbours[i]];
      PetscInt       off;

      PetscCall(PetscLayoutFindOwner(layout, w, &neighbourowner));
      off = owner == neighbourowner ? 0 : 1;
      ++local[off][v];
      if (w >= global[v]) ++local[2 + off][v];
    }
  }
  PetscCall(PetscSFCreate(layout->comm, &sf));
  PetscCall(PetscSFSetGraphLayout(sf, layout, e->nnodes, NULL, PETSC_USE_POINTER, global));
  PetscCall(PetscLayoutGetSize(layout, &N));
  for (PetscInt k = 0; k < 4; ++k) {
    PetscCall(PetscSFReduceBegin(sf, MPIU_INT, local[k], owned[k], MPI_SUM));
    PetscCall(PetscSFReduceEnd(sf, MPIU_INT, local[k], owned[k], MPI_SUM));
    for (PetscInt v = 0; v < nowned; ++v) owned[k][v] = PetscMin(owned[k][v], k % 2 ? N - nowned : nowned);
  }
  PetscCall(PetscSFDestroy(&sf));
  PetscCall(PetscFree4(local[0], local[1], local[2], local[3]));
  PetscFunctionReturn(0);
}

/* Inserts explicit zeros at all entries, row by row with ascending columns, so that assembly only adds values */
static PetscErrorCode ElasticityInsertPattern(Elasticity e, Mat A, const PetscInt global[], const PetscInt start[],
  const PetscInt neighbours[])
{
  PetscInt     longest = 0, *columns;
  PetscScalar *zeros;

  PetscFunctionBegin;
  for (PetscInt v = 0; v < e->nnodes; ++v) longest = PetscMax(longest, start[v + 1] - start[v]);
  PetscCall(PetscMalloc1(longest, &columns));
  PetscCall(PetscCalloc1(9 * longest, &zeros));
  for (PetscInt v = 0; v < e->nnodes; ++v) {
    const PetscInt n = start[v + 1] - start[v];

    for (PetscInt i = 0; i < n; ++i) columns[i] = global[neighbours[start[v] + i]];
    PetscCall(PetscSortInt(n, columns));
    PetscCall(MatSetValuesBlocked(A, 1, &global[v], n, columns, zeros, INSERT_VALUES));
  }
  PetscCall(PetscFree(columns));
  PetscCall(PetscFree(zeros));
  PetscCall(MatAssemblyBegin(A, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(A, MAT_FINAL_ASSEMBLY));
  PetscFunctionReturn(0);
}

PetscErrorCode ElasticityPreallocate(Elasticity e, Mat A)
{
  ISLocalToGlobalMapping map;
  PetscLayout            layout;
  const PetscInt        *global;
  PetscInt               nowned, *start = NULL, *neighbours = NULL, *counts[4];
  PetscBool              triangular;

  PetscFunctionBegin;
  PetscCall(DMGetLocalToGlobalMapping(e->dm, &map));
  PetscCall(ISLocalToGlobalMappingGetBlockIndices(map, &global));
  PetscCall(MatGetLocalSize(A, &nowned, NULL));
  nowned /= 3;
  PetscCall(PetscLayoutCreateFromSizes(PetscObjectComm((PetscObject)A), nowned, PETSC_DECIDE, 1, &layout));
  PetscCall(ElasticityNodeAdjacency(e, &start, &neighbours));
  PetscCall(PetscCalloc4(nowned, &counts[0], nowned, &counts[1], nowned, &counts[2], nowned, &counts[3]));
  PetscCall(ElasticityCountNeighbours(e, layout, global, start, neighbours, nowned, counts));
  PetscCall(MatXAIJSetPreallocation(A, 3, counts[0], counts[1], counts[2], counts[3]));
  PetscCall(PetscFree4(counts[0], counts[1], counts[2], counts[3]));
  PetscCall(PetscObjectTypeCompareAny((PetscObject)A, &triangular, MATSEQSBAIJ, MATMPISBAIJ, ""));
  if (triangular) PetscCall(MatSetOption(A, MAT_IGNORE_LOWER_TRIANGULAR, PETSC_TRUE));
  PetscCall(ElasticityInsertPattern(e, A, global, start, neighbours));
  PetscCall(PetscFree(start));
  PetscCall(PetscFree(neighbours));
  PetscCall(PetscLayoutDestroy(&layout));
  PetscCall(ISLocalToGlobalMappingRestoreBlockIndices(map, &global));
  PetscFunctionReturn(0);
}
