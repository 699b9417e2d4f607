/* Errors of libraries inside a call, hypre's say, that are to end no program: taken between begin and end. */
#include "amgfimpl.h"
#include "guard.h"

/* Takes errors of libraries for itself, with what is said of them; others go the way they went before it was pushed.
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

/* hypre remembers an error, and every later call would return it. PETSc is linked with hypre, this library is not. */
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

/*
  PCAMGFGuardBegin_Private - before a call, with the right-hand side b where it has one, else NULL, whose error goes
  to PCAMGFGuardEnd_Private() and nowhere else
*/
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
