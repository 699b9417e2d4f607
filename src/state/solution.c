/* What a solve finds at the contact rows. */
#include "stateimpl.h"

/* In place of what was there; rows: a vector laid out as they are */
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
