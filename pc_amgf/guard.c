/* Catches errors of libraries (hypre) between begin and end of a call, so that they do not end the program. */
#include "amgfimpl.h"
#include "guard.h"

/* Error handler: keeps errors of libraries and their messages, and passes all other errors to the previous handler.
   PETSc calls it at every level that an error passes. */
static PetscErrorCode GuardHandleError(MPI_Comm comm, int line, const char *function, const char *file,
  PetscErrorCode error, PetscErrorType type, const char *message, void *ctx)
{
  AMGFGuard *guard = (AMGFGuard *)ctx;

  if (error == PETSC_ERR_LIB) {
    if (type == PETSC_ERROR_INITIAL && message) (void)PetscStrncpy(guard->why, message, sizeof(guard->why));
    return error;
  }
  (void)PetscPopErrorHandler();
  (void)PetscError(comm, line, function, file, error, type, "%s", message ? message : "");
  (void)PetscPushErrorHandler(GuardHandleError, ctx);
  return error;
}

/* Clears hypre's error flag; otherwise every later call would return the error. PETSc is linked with hypre, this
   library is not. */
static PetscErrorCode GuardClearHypre(void)
{
  union {
    void *symbol;
    int (*call)(void);
  } clear = {NULL};

  PetscFunctionBegin;
  if (PetscDefined(HAVE_HYPRE)) PetscCall(PetscDLSym(NULL, "HYPRE_ClearAllErrors", &clear.symbol));
  if (clear.symbol) (void)clear.call();
  PetscFunctionReturn(0);
}

/* PCAMGFGuardBegin_Private - before a call; b is its right-hand side, or NULL. Errors of the call are passed to
   PCAMGFGuardEnd_Private() only */
PetscErrorCode PCAMGFGuardBegin_Private(AMGFGuard *guard, Vec b)
{
  PetscFunctionBegin;
  guard->why[0] = '\0';
  guard->b      = b;
  if (b) PetscCall(VecLockGet(b, &guard->nlocks));
  PetscCall(PetscPushErrorHandler(GuardHandleError, guard));
  PetscFunctionReturn(0);
}

/*
  PCAMGFGuardEnd_Private - after it: *failed is true, on this rank, where a library met the error; any other error
  goes on
*/
PetscErrorCode PCAMGFGuardEnd_Private(AMGFGuard *guard, PetscErrorCode error, PetscBool *failed)
{
  PetscInt nlocks;

  PetscFunctionBegin;
  PetscCall(PetscPopErrorHandler());
  *failed = (PetscBool)(error == PETSC_ERR_LIB);
  if (!*failed) {
    PetscCall(error);
    PetscFunctionReturn(0);
  }
  PetscCall(GuardClearHypre());
  if (!guard->b) PetscFunctionReturn(0);
  PetscCall(VecLockGet(guard->b, &nlocks));
  for (; nlocks > guard->nlocks; nlocks--) PetscCall(VecLockReadPop(guard->b));
  PetscFunctionReturn(0);
}
