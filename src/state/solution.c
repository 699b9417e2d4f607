/* Creates and destroys the solution at the contact rows. */
#include "stateimpl.h"
#include "src/state/solution.h"

/*
   Creates the vectors of a solution; existing vectors are destroyed first. rows: a vector with one entry per contact
   row.
*/
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
  PetscCall(VecDestroy(&sol->yield));
  PetscCall(VecDestroy(&sol->stored));
  PetscCall(VecDestroy(&sol->shear));
  PetscCall(VecDestroy(&sol->slip));
  PetscFunctionReturn(0);
}
