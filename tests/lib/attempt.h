/* Shared by the tests of what must fail: the error's sentence is kept instead of PETSc's trace, and compared between
   ranks */
#ifndef ATTEMPT_H
#define ATTEMPT_H

#include <petscsys.h>

static char attempt_sentence[2048];

static inline PetscErrorCode AttemptKeepSentence(MPI_Comm comm, int line, const char *function, const char *file,
  PetscErrorCode n, PetscErrorType type, const char *message, void *ctx)
{
  (void)comm, (void)line, (void)function, (void)file, (void)ctx;
  if (type == PETSC_ERROR_INITIAL && message) (void)PetscStrncpy(attempt_sentence, message, sizeof(attempt_sentence));
  return n;
}

static inline PetscErrorCode AttemptBegin(void)
{
  PetscFunctionBeginUser;
  attempt_sentence[0] = 0;
  PetscCall(PetscPushErrorHandler(AttemptKeepSentence, NULL));
  PetscFunctionReturn(0);
}

static inline PetscErrorCode AttemptEnd(void)
{
  PetscFunctionBeginUser;
  PetscCall(PetscPopErrorHandler());
  PetscFunctionReturn(0);
}

/* Every rank must have the same error, or none, and say the same of it */
static inline PetscErrorCode AttemptCompareRanks(const char name[], PetscErrorCode ierr)
{
  PetscMPIInt codes[2] = {(PetscMPIInt)ierr, -(PetscMPIInt)ierr}, most[2];
  char        first[sizeof(attempt_sentence)];
  PetscBool   same;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Allreduce(codes, most, 2, MPI_INT, MPI_MAX, PETSC_COMM_WORLD));
  PetscCheck(most[0] == -most[1], PETSC_COMM_WORLD, PETSC_ERR_PLIB, "%s: ranks end with different errors", name);
  PetscCall(PetscArraycpy(first, attempt_sentence, sizeof(first)));
  PetscCallMPI(MPI_Bcast(first, (PetscMPIInt)sizeof(first), MPI_CHAR, 0, PETSC_COMM_WORLD));
  PetscCall(PetscStrcmp(first, attempt_sentence, &same));
  PetscCheck(same, PETSC_COMM_SELF, PETSC_ERR_PLIB, "%s: ranks say different things: %s", name, attempt_sentence);
  PetscFunctionReturn(0);
}

/* Prints the sentence, and which ranks had an error */
static inline PetscErrorCode AttemptPrint(PetscErrorCode ierr)
{
  PetscMPIInt failed = ierr ? 1 : 0, least, most;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Allreduce(&failed, &least, 1, MPI_INT, MPI_MIN, PETSC_COMM_WORLD));
  PetscCallMPI(MPI_Allreduce(&failed, &most, 1, MPI_INT, MPI_MAX, PETSC_COMM_WORLD));
  if (most)
    PetscCall(PetscPrintf(PETSC_COMM_WORLD, "error on %s rank: %s\n", least ? "every" : "some", attempt_sentence));
  else PetscCall(PetscPrintf(PETSC_COMM_WORLD, "no error\n"));
  PetscFunctionReturn(0);
}

#endif
