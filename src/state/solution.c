/* The solution at the contact rows. */
#include "stateimpl.h"
#include "src/state/solution.h"

/* Creates the vectors, in place of existing ones; rows: a vector with the layout of the rows */
PetscErrorCode ContactSolutionCreate(Vec rows, ContactSolution *sol)
{
  PetscFunctionBegin;
  PetscCall(ContactSolutionDestroy(sol));
  PetscCall(VecDuplicate(rows, &sol->gap));
  PetscCall(VecDuplicate(rows, &sol->pressure));
  PetscFunctionReturn(0);
}

PetscErrorCode ContactSolutionDestroy(ContactSolution *sol)
{
  PetscFunctionBegin;
  PetscCall(VecDestroy(&sol->pressure));
  PetscCall(VecDestroy(&sol->gap));
  PetscCall(VecDestroy(&sol->shear));
  PetscCall(VecDestroy(&sol->slip));
  PetscFunctionReturn(0);
}
