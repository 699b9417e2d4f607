/*
   Cells for ParaView are hexahedra with 8 nodes or tetrahedra with 4 or 10 nodes. A hexahedron of order 2 has 27 nodes
   and is written as 8 hexahedra, which all have the cell values of the original cell.
*/
#include "outputimpl.h"
#include <mesh.h>

/*
   positions of the nodes of a hexahedron in the order of VTK: first the nodes around the bottom face, then those around
   the top face
*/
static const PetscInt around[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1},
  {0, 1, 1}};

/* Returns the body of a cell if it is a rigid surface, for which the cell stands; negative otherwise */
PetscErrorCode OutputGetTool(Output output, PetscInt cell, PetscInt *body)
{
  DMLabel label;

  PetscFunctionBegin;
  *body = PETSC_DECIDE;
  if (!output->hides) PetscFunctionReturn(0);
  PetscCall(DMGetLabel(output->dm, MESH_BODY_LABEL, &label));
  PetscCall(DMLabelGetValue(label, cell, body));
  if (!output->surfaces[*body]) *body = PETSC_DECIDE;
  PetscFunctionReturn(0);
}

/*
   Divides a cell into the pieces that are written. pieces->nodes: mesh points of the nodes of each piece in the order
   of VTK.
*/
PetscErrorCode OutputGetPieces(Output output, PetscInt cell, OutputPieces *pieces)
{
  PetscInt nnodes, nodes[MESH_MAX_NODES], width, tool;

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
  PetscCall(OutputGetTool(output, cell, &tool));
  if (tool >= 0) pieces->n = 0;
  PetscFunctionReturn(0);
}

/*
   Counts the pieces of this rank's cells and the integers that describe the pieces, and finds whether any rank has
   other cells than hexahedra (output->mixed). In a mixed mesh the kind of each piece precedes its nodes, which takes
   one more integer per piece.
*/
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
  PetscCallMPI(MPI_Allreduce(&output->ncellslocal, &output->ncells, 1, MPIU_INT, MPI_SUM, output->comm));
  PetscFunctionReturn(0);
}

/* Returns the name of the dataset that contains the cells. */
const char *OutputCellsName(Output output)
{
  return output->mixed ? "mixed_cells" : "cells";
}

/*
   OutputPieceKind() returns the number with which XDMF denotes a cell of `nnodes` nodes. OutputKindNodes() returns the
   number of nodes of a cell of this kind; 0: the kind is unknown.
*/
PetscInt OutputPieceKind(PetscInt nnodes)
{
  return nnodes == 4 ? 6 : nnodes == 10 ? 38 : 9;
}

PetscInt OutputKindNodes(PetscInt kind)
{
  return kind == 6 ? 4 : kind == 38 ? 10 : kind == 9 ? 8 : 0;
}
