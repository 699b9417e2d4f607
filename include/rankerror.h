/* Makes an error on one rank an error on all. Work that is not collective and may fail on some ranks only (the first
   rank reads a file, or a rank has no memory) is placed between RankErrorBegin() and RankErrorEnd(). */
#ifndef RANKERROR_H
#define RANKERROR_H

#include <petscsys.h>

typedef struct {
  PetscErrorCode code;          /* 0: no rank failed */
  char           message[1024]; /* the message of the first rank that failed */
} RankError;

/* From here on PETSc stores errors in the RankError instead of printing them */
PETSC_EXTERN PetscErrorCode RankErrorBegin(RankError *);
/* Collective. code: the return value of the work on this rank. Afterwards the RankError is the same on every rank */
PETSC_EXTERN PetscErrorCode RankErrorEnd(MPI_Comm, PetscErrorCode code, RankError *);

#endif
