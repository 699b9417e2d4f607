/* Catches errors of libraries (hypre) inside a call, so that they do not end the program. */
#include "amgfimpl.h"
#include "guard.h"

/* Error handler: stores errors of libraries and their messages; passes all other errors to the previous handler.
   PETSc calls it at every level of the call stack. */
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

/* Clears hypre's error flag; otherwise every later call would return the error. Looked up at run time, since only
   PETSc is linked with hypre. */
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

/* PCAMGFGuardBegin_Private - call before a guarded call; b: its right-hand side, or NULL. Errors of the call are
   reported by PCAMGFGuardEnd_Private() only */
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
   PCAMGFGuardEnd_Private - call after it. *failed: a library reported an error on this rank; any other error is
   returned
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
