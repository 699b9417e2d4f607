/* Creates an output that has a mesh but no files yet. */
#include "outputimpl.h"

/* Counts nodes and cells of the mesh. Nodes have the numbers of the DM's global vectors. */
static PetscErrorCode OutputCount(Output output)
{
  Vec      global;
  PetscInt n, N, start;

  PetscFunctionBegin;
  PetscCall(DMGetGlobalVector(output->dm, &global));
  PetscCall(VecGetLocalSize(global, &n));
  PetscCall(VecGetSize(global, &N));
  PetscCall(VecGetOwnershipRange(global, &start, NULL));
  PetscCall(DMRestoreGlobalVector(output->dm, &global));
  output->nowned    = n / 3;
  output->nvertices = N / 3;
  output->first     = start / 3;
  PetscCall(OutputCountPieces(output));
  PetscFunctionReturn(0);
}

PetscErrorCode OutputCreateMesh(DM dm, Output *output)
{
  PetscFunctionBegin;
  PetscCall(PetscNew(output));
  PetscCall(PetscObjectGetComm((PetscObject)dm, &(*output)->comm));
  PetscCall(PetscObjectReference((PetscObject)dm));
  (*output)->dm   = dm;
  (*output)->lock = -1;
  PetscCall(OutputCount(*output));
  PetscFunctionReturn(0);
}
