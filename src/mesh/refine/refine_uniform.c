/* Uniform refinement: divides every cell into eight */
#include "refineimpl.h"

PetscErrorCode MeshRefine(DM *dm, PetscInt levels)
{
  PetscFunctionBegin;
  for (PetscInt l = 0; l < levels; ++l) {
    DM fine;

    PetscCall(DMPlexSetRefinementUniform(*dm, PETSC_TRUE));
    PetscCall(DMRefine(*dm, PetscObjectComm((PetscObject)*dm), &fine));
    PetscCall(DMDestroy(dm));
    *dm = fine;
  }
  PetscFunctionReturn(0);
}
