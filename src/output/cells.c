/* Cells as ParaView shows them: hexahedra of 8 nodes. The nodes of a cell of order 2 cut it into 8, which have its values of a cell */
#include "outputimpl.h"
#include <mesh.h>

/* Around the bottom, around the top */
static const PetscInt around[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};

/* The n hexahedra of a cell, as points of the mesh that carry nodes, in VTK's order */
PetscErrorCode OutputGetPieces(Output output, PetscInt cell, PetscInt *n, PetscInt pieces[8][8])
{
  PetscInt nnodes, nodes[MESH_MAX_NODES], width;

  PetscFunctionBegin;
  PetscCall(MeshGetCellNodes(output->dm, cell, &nnodes, nodes));
  *n    = nnodes == 27 ? 8 : 1;
  width = nnodes == 27 ? 3 : 2;
  for (PetscInt p = 0; p < *n; ++p) {
    for (PetscInt i = 0; i < 8; ++i) pieces[p][i] = nodes[(p & 1) + around[i][0] + width * ((p >> 1 & 1) + around[i][1] + width * ((p >> 2) + around[i][2]))];
  }
  PetscFunctionReturn(0);
}

/* Those of this rank's cells */
PetscErrorCode OutputCountPieces(Output output, PetscInt *npieces)
{
  PetscInt cstart, cend;

  PetscFunctionBegin;
  *npieces = 0;
  PetscCall(DMPlexGetHeightStratum(output->dm, 0, &cstart, &cend));
  for (PetscInt c = cstart; c < cend; ++c) {
    PetscInt n, pieces[8][8];

    PetscCall(OutputGetPieces(output, c, &n, pieces));
    *npieces += n;
  }
  PetscFunctionReturn(0);
}
