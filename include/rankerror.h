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

/*
   Collective. Does `work`, a call that is not collective, on the ranks where `here` is true; an error on any rank is
   raised on all. The message of RankCallFor() begins with a text.
*/
#define RankCallFor(comm, here, work, ...) \
  do { \
    RankError      rank_error; \
    PetscErrorCode rank_code = 0; \
    PetscCall(RankErrorBegin(&rank_error)); \
    if (here) rank_code = work; \
    PetscCall(RankErrorRaise(comm, rank_code, &rank_error, __VA_ARGS__)); \
  } while (0)
#define RankCall(comm, here, work) RankCallFor(comm, here, work, "%s", "")
/* RankErrorEnd(), which then raises the error, with a text before its message */
PETSC_EXTERN PetscErrorCode RankErrorRaise(MPI_Comm, PetscErrorCode code, RankError *, const char format[], ...)
  PETSC_ATTRIBUTE_FORMAT(4, 5);

#endif
