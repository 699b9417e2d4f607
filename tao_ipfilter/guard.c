/* An error of a library inside a solver, hypre's say, is a failure of that solver, for which there are remedies: it ends no program. */
#include "ipfilterimpl.h"

/* Takes errors of libraries for itself, with what is said of them; others go the way they went before it was pushed. PETSc calls it at
   every level that an error passes. */
static PetscErrorCode GuardHandleError(MPI_Comm comm, int line, const char *function, const char *file, PetscErrorCode error, PetscErrorType type, const char *message, void *ctx)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)ctx;

  if (error == PETSC_ERR_LIB) {
    if (type == PETSC_ERROR_INITIAL && message) (void)PetscStrncpy(ip->lin.why, message, sizeof(ip->lin.why));
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

/* A new PC of the same type and options in the place of one whose library was interrupted, and which PETSc can neither use again nor
   take apart: that one is left alone, with a reference that nobody gives back */
static PetscErrorCode GuardReplacePC(Tao tao)
{
  KSP         ksp[2] = {tao->ksp, ((TAO_IPFILTER *)tao->data)->lin.flexible};
  PC          broken, fresh;
  PCType      type;
  const char *prefix;

  PetscFunctionBegin;
  PetscCall(KSPGetPC(tao->ksp, &broken));
  PetscCall(PetscObjectReference((PetscObject)broken));
  PetscCall(PCGetType(broken, &type));
  PetscCall(PCGetOptionsPrefix(broken, &prefix));
  PetscCall(PCCreate(PetscObjectComm((PetscObject)tao), &fresh));
  PetscCall(PCSetOptionsPrefix(fresh, prefix));
  PetscCall(PCSetType(fresh, type));
  PetscCall(PCSetFromOptions(fresh));
  for (PetscInt k = 0; k < 2; k++) {
    if (!ksp[k]) continue;
    PetscCall(KSPSetPC(ksp[k], fresh));
    PetscCall(KSPReset(ksp[k]));
  }
  PetscCall(PCDestroy(&fresh));
  PetscFunctionReturn(0);
}

/* KSPSolve(). *failed: a library inside it met an error, which all ranks then did, since the norms it is found by are the same on all;
   x is zero. */
PetscErrorCode IPGuardedSolve(Tao tao, KSP ksp, Vec b, Vec x, PetscBool *failed)
{
  PetscErrorCode error;
  PetscInt       before, after;

  PetscFunctionBegin;
  PetscCall(VecLockGet(b, &before));
  PetscCall(PetscPushErrorHandler(GuardHandleError, tao->data));
  error = KSPSolve(ksp, b, x);
  PetscCall(PetscPopErrorHandler());
  *failed = (PetscBool)(error == PETSC_ERR_LIB);
  if (!*failed) {
    PetscCall(error);
    PetscFunctionReturn(0);
  }
  PetscCall(PetscInfo(tao, "An error inside the linear solver: %s\n", ((TAO_IPFILTER *)tao->data)->lin.why));
  PetscCall(GuardClearHypre());
  PetscCall(VecLockGet(b, &after));
  for (; after > before; after--) PetscCall(VecLockReadPop(b));
  PetscCall(GuardReplacePC(tao));
  PetscCall(VecSet(x, 0.0));
  PetscFunctionReturn(0);
}
