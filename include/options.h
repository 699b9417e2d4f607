/* Names of options: which are known, and which known name is nearest to a given one. Depends only on PETSc's options
   database. */
#ifndef OPTIONS_H
#define OPTIONS_H

#include <petscsys.h>

/* Not collective. Returns the number of letters to insert, delete or replace to change one name into the other */
PETSC_EXTERN PetscErrorCode OptionsDistance(const char a[], const char b[], size_t *distance);
/* Not collective. Finds the known name that is most similar to a misspelt one; "" if there are no names */
PETSC_EXTERN PetscErrorCode OptionsNearest(PetscInt n, const char *const known[], const char name[],
  const char **nearest);
/* Collective. It is an error if an option is neither one of ours nor begins like an option of PETSc, or if it is one of
   ours and its value has the wrong type. place: with which the message begins */
PETSC_EXTERN PetscErrorCode OptionsCheckOne(MPI_Comm, const char place[], const char name[], const char value[]);
/* Collective. It is an error if an option of ours that has not been read yet has a value of the wrong type. */
PETSC_EXTERN PetscErrorCode OptionsCheckValues(MPI_Comm);
/* Collective. It is an error if an option that has not been read yet is neither one of ours nor begins like an
   option of PETSc. */
PETSC_EXTERN PetscErrorCode OptionsCheck(MPI_Comm);

#endif
