/*
   What fails on one rank fails on all: work that is not collective, and may fail on some ranks only (the first one
   reads a file, or has no memory for what it makes), stands between RankErrorBegin() and RankErrorEnd().
*/
#ifndef RANKERROR_H
#define RANKERROR_H

#include <petscsys.h>

typedef struct {
  PetscErrorCode code;          /* 0: no rank failed */
  char           message[1024]; /* what the first rank that failed said of it */
} RankError;

/* PETSc's errors are kept in the RankError from here on, and not printed */
PETSC_EXTERN PetscErrorCode RankErrorBegin(RankError *);
/* Collective. code: what the work on this rank returned; the RankError is the same on every rank then */
PETSC_EXTERN PetscErrorCode RankErrorEnd(MPI_Comm, PetscErrorCode code, RankError *);

#endif
