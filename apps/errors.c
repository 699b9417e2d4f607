/* What happens after an error, and after a crash */
#define _POSIX_C_SOURCE 200809L /* declares dprintf() */
#include "appsimpl.h"
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>

/*
   Returns the kind of end of a run to which a PETSc error code belongs. Most errors are caused by the input. The codes
   listed here are caused by the machine or by the program.
*/
static RunEnd AppClassifyError(PetscErrorCode n)
{
  static const PetscErrorCode faults[] = {PETSC_ERR_MEM, PETSC_ERR_PLIB, PETSC_ERR_LIB, PETSC_ERR_SIG, PETSC_ERR_MEMC,
    PETSC_ERR_ARG_CORRUPT, PETSC_ERR_ARG_NULL, PETSC_ERR_POINTER, PETSC_ERR_ORDER, PETSC_ERR_MPI, PETSC_ERR_SYS};

  if (n == PETSC_ERR_FILE_WRITE) return RUN_OUTPUT_LOST;
  for (size_t i = 0; i < PETSC_STATIC_ARRAY_LENGTH(faults); ++i) {
    if (n == faults[i]) return RUN_BROKEN;
  }
  return RUN_REFUSED;
}

/*
   Handles an error of PETSc. A collective error returns through all callers on every rank and is printed once, as one
   sentence or as PETSc's traceback. An error that occurs on one rank only ends the other ranks.
*/
PetscErrorCode AppHandleError(MPI_Comm comm, int line, const char *function, const char *file, PetscErrorCode n,
  PetscErrorType type, const char *message, void *ctx)
{
  AppError   *error = (AppError *)ctx;
  const char *text  = message;
  PetscMPIInt rank, size, world;

  if (type == PETSC_ERROR_INITIAL) {
    MPI_Comm_rank(comm, &rank);
    MPI_Comm_size(comm, &size);
    MPI_Comm_size(PETSC_COMM_WORLD, &world);
    error->silent = (PetscBool)(rank > 0);
    error->alone  = (PetscBool)(size < world);
    error->end    = (int)AppClassifyError(n);
    if (!message || !message[0]) PetscErrorMessage(n, &text, NULL);
    (void)PetscStrncpy(error->sentence, text ? text : "unknown", sizeof(error->sentence));
    if (!error->silent && !error->traceback) fprintf(stderr, "contact: error: %s\n", error->sentence);
    fflush(stderr);
    if (error->alone && !error->traceback) MPI_Abort(PETSC_COMM_WORLD, error->end);
  }
  return error->traceback && !error->silent
           ? PetscTraceBackErrorHandler(comm, line, function, file, n, type, message, NULL)
           : n;
}

/*
   Silences HDF5 while MPI ends. HDF5 then closes its files; if it could not write one, it prints pages of errors and
   crashes. The exit code of the program remains `end`.
*/
static int app_end;

static void AppLeaveAtOnce(int sig)
{
  (void)sig;
  _Exit(app_end);
}

static void AppLeaveFiles(int end)
{
  fflush(NULL);
  app_end = end;
  signal(SIGSEGV, AppLeaveAtOnce);
  signal(SIGABRT, AppLeaveAtOnce);
  if (!freopen("/dev/null", "w", stdout) || !freopen("/dev/null", "w", stderr)) _Exit(end);
}

/*
   Ends the program after an error has returned through all callers. If the error is collective, every rank calls this
   function. If some ranks do not call it within ten seconds, they may never do so; MPI_Abort() then ends them. Objects
   are not destroyed. Therefore MPI_Finalize() is called instead of PetscFinalize(), which would report them.
*/
void AppLeave(const AppError *error)
{
  const double start = MPI_Wtime(), patience = error->alone ? 0.0 : 10.0; /* time to wait for other ranks [s] */
  MPI_Request  request;
  PetscMPIInt  rank;
  int          all = 0;

  MPI_Ibarrier(error->meeting, &request);
  do {
    MPI_Test(&request, &all, MPI_STATUS_IGNORE);
    if (!all) (void)PetscSleep(0.01);
  } while (!all && MPI_Wtime() - start < patience);
  if (!all) {
    MPI_Comm_rank(error->meeting, &rank);
    fprintf(stderr, "contact: error on rank %d only: %s\n", rank, error->sentence);
    fflush(NULL);
    MPI_Abort(PETSC_COMM_WORLD, error->end);
  }
  if (error->end == RUN_OUTPUT_LOST) AppLeaveFiles(error->end);
  MPI_Finalize();
  fflush(NULL);
  _Exit(error->end);
}

/*
   Handles a crash of the program or of a library: prints one sentence and ends the other ranks. PETSc's handler would
   print a page, and use its own exit code.
*/
PetscErrorCode AppCrash(int sig, void *ctx)
{
  const PetscBool fault =
    (PetscBool)(sig == SIGSEGV || sig == SIGBUS || sig == SIGFPE || sig == SIGILL || sig == SIGABRT);
  PetscMPIInt size;

  if (!fault || ((AppError *)ctx)->traceback) return PetscSignalHandlerDefault(sig, NULL);
  dprintf(((AppError *)ctx)->said,
    "contact: error: the program crashed (signal %d), because of an error in the program or in a library: please "
    "report it with the scene; -traceback prints details\n",
    sig);
  MPI_Comm_size(PETSC_COMM_WORLD, &size);
  if (size > 1) MPI_Abort(PETSC_COMM_WORLD, RUN_BROKEN);
  _Exit(RUN_BROKEN);
}
