/* One dataset of an HDF5 file, each rank's part in turn */
#include "outputimpl.h"

PetscErrorCode DatasetCreate(MPI_Comm comm, const char name[], PetscInt n, PetscInt components, Vec *field)
{
  PetscFunctionBegin;
  PetscCall(VecCreate(comm, field));
  PetscCall(VecSetSizes(*field, n * components, PETSC_DECIDE));
  PetscCall(VecSetBlockSize(*field, components));
  PetscCall(VecSetType(*field, VECSTANDARD));
  PetscCall(PetscObjectSetName((PetscObject)*field, name));
  PetscFunctionReturn(0);
}

PetscErrorCode DatasetWrite(Vec *field, PetscViewer viewer)
{
  PetscFunctionBegin;
  PetscCall(VecView(*field, viewer));
  PetscCall(VecDestroy(field));
  PetscFunctionReturn(0);
}
