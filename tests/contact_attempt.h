/* What should fail: the error's sentence is printed instead of PETSc's trace, and whether every rank had it */
#ifndef CONTACT_ATTEMPT_H
#define CONTACT_ATTEMPT_H

#include <petscsys.h>

static char attempt_message[512];

static inline PetscErrorCode AttemptKeepMessage(MPI_Comm comm, int line, const char *function, const char *file, PetscErrorCode n, PetscErrorType type, const char *message, void *ctx)
{
  (void)comm, (void)line, (void)function, (void)file, (void)ctx;
  if (type == PETSC_ERROR_INITIAL && message) snprintf(attempt_message, sizeof(attempt_message), "%s", message);
  return n;
}

static inline PetscErrorCode AttemptBegin(void)
{
  PetscFunctionBeginUser;
  attempt_message[0] = 0;
  PetscCall(PetscPushErrorHandler(AttemptKeepMessage, NULL));
  PetscFunctionReturn(0);
}

static inline PetscErrorCode AttemptEnd(PetscErrorCode ierr)
{
  PetscMPIInt failed = ierr ? 1 : 0, least, most;

  PetscFunctionBeginUser;
  PetscCall(PetscPopErrorHandler());
  PetscCallMPI(MPI_Allreduce(&failed, &least, 1, MPI_INT, MPI_MIN, PETSC_COMM_WORLD));
  PetscCallMPI(MPI_Allreduce(&failed, &most, 1, MPI_INT, MPI_MAX, PETSC_COMM_WORLD));
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%s%s%s\n", least ? "error on every rank" : most ? "error on some rank" : "no error", most ? ": " : "", attempt_message));
  PetscFunctionReturn(0);
}

#endif
