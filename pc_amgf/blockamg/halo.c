/*
   Communication of values of unknowns of other ranks, in single precision: fetched from their owners, or added to the
   owners' values
*/
#include "blockamgimpl.h"

/*
   BlockHaloCreate_Private - creates the communication between the ghosts of a level's vectors and their owners. The
   ghosts are stored behind the positions of the level.

   Input Parameters:
   + layout  - distribution of the level's unknowns
   . nghosts - number of ghosts
   . ghosts  - global numbers of the ghosts, which are unknowns of other ranks
   - level   - the level, with the positions of its unknowns
*/
PetscErrorCode BlockHaloCreate_Private(PetscLayout layout, PetscInt nghosts, const PetscInt ghosts[],
  const BlockLevel *level, BlockHalo *halo)
{
  PetscMPIInt        size;
  PetscSF            numbers;
  const PetscSFNode *owned;
  PetscSFNode       *roots;
  int               *theirs;

  PetscFunctionBegin;
  halo->nghosts = (int)nghosts;
  halo->sf      = NULL;
  PetscCallMPI(MPI_Comm_size(layout->comm, &size));
  if (size == 1) PetscFunctionReturn(0);
  PetscCall(PetscSFCreate(layout->comm, &numbers));
  PetscCall(PetscSFSetGraphLayout(numbers, layout, nghosts, NULL, PETSC_OWN_POINTER, ghosts));
  PetscCall(PetscMalloc1(nghosts, &theirs));
  PetscCall(PetscSFBcastBegin(numbers, MPI_INT, level->position, theirs, MPI_REPLACE));
  PetscCall(PetscSFBcastEnd(numbers, MPI_INT, level->position, theirs, MPI_REPLACE));
  PetscCall(PetscSFGetGraph(numbers, NULL, NULL, NULL, &owned));
  PetscCall(PetscMalloc1(nghosts, &roots));
  for (PetscInt g = 0; g < nghosts; g++) {
    roots[g].rank  = owned[g].rank;
    roots[g].index = theirs[g];
  }
  PetscCall(PetscSFCreate(layout->comm, &halo->sf));
  PetscCall(PetscSFSetGraph(halo->sf, 4 * level->nb, nghosts, NULL, PETSC_OWN_POINTER, roots, PETSC_OWN_POINTER));
  PetscCall(PetscSFSetUp(halo->sf));
  PetscCall(PetscSFDestroy(&numbers));
  PetscCall(PetscFree(theirs));
  PetscFunctionReturn(0);
}

/* BlockHaloFetch_Private - sets the ghosts of x to the values on their owners */
PetscErrorCode BlockHaloFetch_Private(const BlockHalo *halo, const BlockLevel *level, float x[])
{
  PetscFunctionBegin;
  if (!halo->sf) PetscFunctionReturn(0);
  PetscCall(PetscSFBcastBegin(halo->sf, MPI_FLOAT, x, x + 4 * (size_t)level->nb, MPI_REPLACE));
  PetscCall(PetscSFBcastEnd(halo->sf, MPI_FLOAT, x, x + 4 * (size_t)level->nb, MPI_REPLACE));
  PetscFunctionReturn(0);
}

/* BlockHaloAdd_Private - adds the ghosts of x to the values on their owners */
PetscErrorCode BlockHaloAdd_Private(const BlockHalo *halo, const BlockLevel *level, float x[])
{
  PetscFunctionBegin;
  if (!halo->sf) PetscFunctionReturn(0);
  PetscCall(PetscSFReduceBegin(halo->sf, MPI_FLOAT, x + 4 * (size_t)level->nb, x, MPI_SUM));
  PetscCall(PetscSFReduceEnd(halo->sf, MPI_FLOAT, x + 4 * (size_t)level->nb, x, MPI_SUM));
  PetscFunctionReturn(0);
}
