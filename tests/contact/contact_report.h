/* What the contact tests share: a verdict on an error, random numbers. */
#ifndef CONTACT_REPORT_H
#define CONTACT_REPORT_H

#include <petscsys.h>

static inline PetscErrorCode Report(const char what[], PetscReal error, PetscReal tolerance)
{
  PetscFunctionBeginUser;
  if (error <= tolerance) PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%s: error below %g\n", what, (double)tolerance));
  else PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%s: error %g exceeds %g\n", what, (double)error, (double)tolerance));
  PetscFunctionReturn(0);
}

static inline PetscReal Random(PetscRandom r, PetscReal low, PetscReal high)
{
  PetscReal x;

  PetscCallAbort(PETSC_COMM_SELF, PetscRandomGetValueReal(r, &x));
  return low + (high - low) * x;
}

#endif
