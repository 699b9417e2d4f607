/* The names of options: which are known, and which known one is nearest to another. Knows no more than PETSc's
   options database. */
#ifndef OPTIONS_H
#define OPTIONS_H

#include <petscsys.h>

/* Not collective. The known name with the fewest letters to change; "" of none */
PETSC_EXTERN PetscErrorCode OptionsDistance(const char a[], const char b[], size_t *distance);
PETSC_EXTERN PetscErrorCode OptionsNearest(PetscInt n, const char *const known[], const char name[],
  const char **nearest);
/* Collective. An error where an option of ours has a value, not asked for so far, of another kind than it needs */
PETSC_EXTERN PetscErrorCode OptionsCheckValues(MPI_Comm);
/* Collective. An error where the options database has a name, not asked for so far, that is neither ours nor of
   PETSc's kinds */
PETSC_EXTERN PetscErrorCode OptionsCheck(MPI_Comm);

#endif
