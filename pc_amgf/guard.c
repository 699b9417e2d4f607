/* Catches errors of libraries (hypre) during a call, so that they do not end the program */
#include "amgfimpl.h"
#include "guard.h"

/*
   Handles an error. Errors of libraries are recorded with their message and return. All other errors are passed to the
   previous handler. PETSc calls the handler at every level of the call stack.
*/
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

/*
   Clears hypre's error flag. Otherwise every later call to hypre would return this error again. The function is looked
   up at run time, since PETSc is linked with hypre but this library is not.
*/
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
   Records the depths of the events of PCSetUp(), or restores them after an error. PETSc adds one to the depth of an
   event where the event begins, and where it is paused. With -log_sync all ranks wait for one another at events of
   depth zero: a rank with another depth would not join them.
*/
static PetscErrorCode GuardSetUpEvents(AMGFGuard *guard, PetscBool restore)
{
  static const char *const names[AMGF_GUARD_EVENTS] = {"PCSetUp", "PCSetUpOnBlocks", "PCApply", "KSPSetUp", "KSPSolve"};
  PetscBool                logs;

  PetscFunctionBegin;
  PetscCall(PetscLogIsActive(&logs));
  for (int k = 0; logs && k < AMGF_GUARD_EVENTS; k++) {
    PetscLogEvent      event;
    PetscEventPerfInfo now;

    PetscCall(PetscLogEventGetId(names[k], &event));
    PetscCall(PetscLogEventGetPerfInfo(PETSC_DETERMINE, event, &now));
    if (!restore) guard->depths[k] = now.depth;
    for (; now.depth > guard->depths[k]; now.depth--) PetscCall(PetscLogEventDeactivatePop(event));
  }
  PetscFunctionReturn(0);
}

/*
   PCAMGFGuardBegin_Private - catches library errors from here to PCAMGFGuardEnd_Private()

   Input Parameter:
   . b - right-hand side of the guarded PCApply(), or NULL for PCSetUp()
*/
PetscErrorCode PCAMGFGuardBegin_Private(AMGFGuard *guard, Vec b)
{
  PetscFunctionBegin;
  guard->why[0] = '\0';
  guard->b      = b;
  if (b) PetscCall(VecLockGet(b, &guard->nlocks));
  else PetscCall(GuardSetUpEvents(guard, PETSC_FALSE));
  PetscCall(PetscPushErrorHandler(GuardHandleError, guard));
  PetscFunctionReturn(0);
}

/*
   PCAMGFGuardEnd_Private - ends the guard

   Input Parameter:
   . error - error code of the guarded call

   Output Parameter:
   . failed - whether a library reported an error on this rank

   Note:
   Any other error code is returned as an error.
*/
PetscErrorCode PCAMGFGuardEnd_Private(AMGFGuard *guard, PetscErrorCode error, PetscBool *failed)
{
  PetscLogEvent event;
  PetscInt      nlocks;

  PetscFunctionBegin;
  PetscCall(PetscPopErrorHandler());
  *failed = (PetscBool)(error == PETSC_ERR_LIB);
  if (!*failed) {
    PetscCall(error);
    PetscFunctionReturn(0);
  }
  PetscCall(GuardClearHypre());
  if (!guard->b) {
    PetscCall(GuardSetUpEvents(guard, PETSC_TRUE));
    PetscFunctionReturn(0);
  }
  PetscCall(PetscLogEventGetId("PCApply", &event));
  PetscCall(PetscLogEventEnd(event, NULL, NULL, NULL, NULL));
  PetscCall(VecLockGet(guard->b, &nlocks));
  for (; nlocks > guard->nlocks; nlocks--) PetscCall(VecLockReadPop(guard->b));
  PetscFunctionReturn(0);
}
