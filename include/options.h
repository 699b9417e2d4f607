/* The names of options: which are known, and which known one is nearest to another. Depends on PETSc's options
   database only. */
#ifndef OPTIONS_H
#define OPTIONS_H

#include <petscsys.h>

/* Not collective. The number of letters to change between two names */
PETSC_EXTERN PetscErrorCode OptionsDistance(const char a[], const char b[], size_t *distance);
/* Not collective. The known name with the fewest different letters; "": there is none */
PETSC_EXTERN PetscErrorCode OptionsNearest(PetscInt n, const char *const known[], const char name[],
  const char **nearest);
/* Collective. An error if an option of ours that nothing has read yet has a value of the wrong type */
PETSC_EXTERN PetscErrorCode OptionsCheckValues(MPI_Comm);
/* Collective. An error if an option that nothing has read yet is neither ours nor begins like one of PETSc's */
PETSC_EXTERN PetscErrorCode OptionsCheck(MPI_Comm);

#endif
