/* Reports the error of one rank on all ranks */
#include <rankerror.h>
#include <stdarg.h>
#include <string.h>

/*
   Handles an error: stores the innermost one, which describes the cause best. If memory is exhausted, PETSc 3.18 passes
   the line and the function as error number and message.
*/
static PetscErrorCode RankErrorKeep(MPI_Comm comm, int line, const char *function, const char *file, PetscErrorCode n,
  PetscErrorType type, const char *message, void *ctx)
{
  RankError  *error = (RankError *)ctx;
  const char *text  = message;

  (void)comm, (void)line, (void)file;
  if (type != PETSC_ERROR_INITIAL) return n;
  error->code = function && !strncmp(function, "PetscMalloc", 11) ? PETSC_ERR_MEM : n;
  if (error->code == PETSC_ERR_MEM || !text || !text[0]) (void)PetscErrorMessage(error->code, &text, NULL);
  (void)PetscStrncpy(error->message, text ? text : "unknown error", sizeof(error->message));
  return n;
}

/*
   Begins work that is not collective, and whose failure on one rank must be reported on all ranks. error: stores
   PETSc's errors until RankErrorEnd(); nothing is printed. Ranks without such work call RankErrorEnd() at once, with
   code 0.

     RankErrorBegin(&error);
     if (rank == 0) ierr = ReadFile(file);
     RankErrorEnd(comm, ierr, &error);
     PetscCheck(!error.code, comm, error.code, "%s", error.message);
*/
PetscErrorCode RankErrorBegin(RankError *error)
{
  PetscFunctionBegin;
  error->code       = 0;
  error->message[0] = 0;
  PetscCall(PetscPushErrorHandler(RankErrorKeep, error));
  PetscFunctionReturn(0);
}

/*
   Collective. Ends work that is not collective, and tells every rank whether it failed on some rank. comm:
   communicator; code: error code of the work on this rank, 0 for success or if there was no work; error: code and
   message of the first rank that failed, the same on all ranks; its code is 0 if no rank failed.
*/
PetscErrorCode RankErrorEnd(MPI_Comm comm, PetscErrorCode code, RankError *error)
{
  PetscMPIInt rank, size, first;
  int         shared = code ? (int)(error->code ? error->code : code) : 0;

  PetscFunctionBegin;
  PetscCall(PetscPopErrorHandler());
  PetscCallMPI(MPI_Comm_rank(comm, &rank));
  PetscCallMPI(MPI_Comm_size(comm, &size));
  first = code ? rank : size;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &first, 1, MPI_INT, MPI_MIN, comm));
  if (first < size) {
    PetscCallMPI(MPI_Bcast(&shared, 1, MPI_INT, first, comm));
    PetscCallMPI(MPI_Bcast(error->message, (PetscMPIInt)sizeof(error->message), MPI_CHAR, first, comm));
  }
  error->code = (PetscErrorCode)shared;
  PetscFunctionReturn(0);
}

PetscErrorCode RankErrorRaise(MPI_Comm comm, PetscErrorCode code, RankError *error, const char format[], ...)
{
  char    text[1024];
  va_list args;

  PetscFunctionBegin;
  PetscCall(RankErrorEnd(comm, code, error));
  if (!error->code) PetscFunctionReturn(0);
  va_start(args, format);
  PetscCall(PetscVSNPrintf(text, sizeof(text), format, NULL, args));
  va_end(args);
  SETERRQ(comm, error->code, "%s%s", text, error->message);
}
