/* Cells for ParaView: hexahedra with 8 nodes, tetrahedra with 4 or 10. The nodes of a hexahedron of order 2 divide
   it into 8, which all get its cell values */
#include "outputimpl.h"
#include <mesh.h>

/* VTK's order: around the bottom, then around the top */
static const PetscInt around[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1},
  {0, 1, 1}};

/* Divides a cell into pieces, as mesh points with nodes, in VTK's order */
PetscErrorCode OutputGetPieces(Output output, PetscInt cell, OutputPieces *pieces)
{
  PetscInt nnodes, nodes[MESH_MAX_NODES], width;

  PetscFunctionBegin;
  PetscCall(MeshGetCellNodes(output->dm, cell, &nnodes, nodes));
  pieces->n      = nnodes == 27 ? 8 : 1;
  pieces->nnodes = MeshIsTetrahedron(nnodes) ? nnodes : 8;
  width          = nnodes == 27 ? 3 : 2;
  if (MeshIsTetrahedron(nnodes)) PetscCall(PetscArraycpy(pieces->nodes[0], nodes, nnodes));
  for (PetscInt p = 0; pieces->nnodes == 8 && p < pieces->n; ++p) {
    for (PetscInt i = 0; i < 8; ++i)
      pieces->nodes[p][i] =
        nodes[(p & 1) + around[i][0] + width * ((p >> 1 & 1) + around[i][1] + width * ((p >> 2) + around[i][2]))];
  }
  PetscFunctionReturn(0);
}

/* Counts the pieces of this rank's cells, whether there are other cells than hexahedra on any rank, and the integers
   needed to describe them (for mixed cells a kind before each) */
PetscErrorCode OutputCountPieces(Output output)
{
  PetscInt     cstart, cend, total = 0;
  OutputPieces pieces;

  PetscFunctionBegin;
  output->ncellslocal = 0;
  output->mixed       = PETSC_FALSE;
  PetscCall(DMPlexGetHeightStratum(output->dm, 0, &cstart, &cend));
  for (PetscInt c = cstart; c < cend; ++c) {
    PetscCall(OutputGetPieces(output, c, &pieces));
    output->ncellslocal += pieces.n;
    total += pieces.n * (1 + pieces.nnodes);
    if (pieces.nnodes != 8) output->mixed = PETSC_TRUE;
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &output->mixed, 1, MPI_PETSCBOOL, MPI_LOR, output->comm));
  output->nindiceslocal = output->mixed ? total : 8 * output->ncellslocal;
  PetscCallMPI(MPI_Allreduce(&output->nindiceslocal, &output->nindices, 1, MPIU_INT, MPI_SUM, output->comm));
  PetscFunctionReturn(0);
}

/* Name of the dataset of cells */
const char *OutputCellsName(Output output)
{
  return output->mixed ? "mixed_cells" : "cells";
}

/* Kind: XDMF's number for a piece with this many nodes. Nodes: number of nodes of a kind, 0: unknown */
PetscInt OutputPieceKind(PetscInt nnodes)
{
  return nnodes == 4 ? 6 : nnodes == 10 ? 38 : 9;
}

PetscInt OutputKindNodes(PetscInt kind)
{
  return kind == 6 ? 4 : kind == 38 ? 10 : kind == 9 ? 8 : 0;
}
