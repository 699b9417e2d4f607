/* Cells as ParaView shows them: hexahedra of 8 nodes, tetrahedra of 4 or 10. The nodes of a hexahedron of order 2 cut
   it into 8, which have its values of a cell */
#include "outputimpl.h"
#include <mesh.h>

/* Around the bottom, around the top */
static const PetscInt around[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1},
  {0, 1, 1}};

/* The pieces of a cell, as points of the mesh that carry nodes, in VTK's order */
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

/* Those of this rank's cells, and whether those of any rank are others than hexahedra; then the numbers that they are
   written with, a kind before each */
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

/* The dataset that has them */
const char *OutputCellsName(Output output)
{
  return output->mixed ? "mixed_cells" : "cells";
}

/* XDMF's number of the kind of cell that a piece with so many nodes is; the nodes of such a kind, 0: none */
PetscInt OutputPieceKind(PetscInt nnodes)
{
  return nnodes == 4 ? 6 : nnodes == 10 ? 38 : 9;
}

PetscInt OutputKindNodes(PetscInt kind)
{
  return kind == 6 ? 4 : kind == 38 ? 10 : kind == 9 ? 8 : 0;
}
