/* Names of options: which are known, and which known name is nearest to a given one. Depends only on PETSc's options
   database. */
#ifndef OPTIONS_H
#define OPTIONS_H

#include <petscsys.h>

/* Not collective. Number of letters by which two names differ */
PETSC_EXTERN PetscErrorCode OptionsDistance(const char a[], const char b[], size_t *distance);
/* Not collective. The known name with the fewest different letters; "" if there is none */
PETSC_EXTERN PetscErrorCode OptionsNearest(PetscInt n, const char *const known[], const char name[],
  const char **nearest);
/* Collective. Error if an option of ours that has not been read yet has a value of the wrong type */
PETSC_EXTERN PetscErrorCode OptionsCheckValues(MPI_Comm);
/* Collective. Error if an option that has not been read yet is neither ours nor has a prefix of PETSc's */
PETSC_EXTERN PetscErrorCode OptionsCheck(MPI_Comm);

#endif
