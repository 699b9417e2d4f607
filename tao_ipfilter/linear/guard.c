/*
   Treats an error of a library inside a linear solver, such as hypre, as a failure of the solver. The program continues
   with the next fallback of linsolve.c.
*/
#include "linearimpl.h"
#include "tao_ipfilter/solver/linear.h"
#include "pc_amgf/guard.h"

/*
   Replaces a PC whose library was interrupted by an error with a new one of the same type and options. PETSc can
   neither reuse nor destroy the old PC. Therefore a reference to it is taken and never released.
*/
static PetscErrorCode GuardReplacePC(Tao tao)
{
  KSP         ksp[2] = {tao->ksp, ((TAO_IPFILTER *)tao->data)->lin->flexible};
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
    PetscCall(IPKSPReset(ksp[k]));
  }
  PetscCall(PCDestroy(&fresh));
  PetscFunctionReturn(0);
}

/*
   Finds whether PCAMGF reports an error of its own solvers, which may have occurred on one rank only. *failed is the
   same on all ranks.
*/
static PetscErrorCode GuardAskPC(KSP ksp, PetscBool *failed)
{
  PC             pc;
  PCFailedReason why;
  PetscBool      amgf;

  PetscFunctionBegin;
  PetscCall(KSPGetPC(ksp, &pc));
  PetscCall(PetscObjectTypeCompare((PetscObject)pc, PCAMGF, &amgf));
  PetscCall(PCGetFailedReason(pc, &why));
  *failed = (PetscBool)(amgf && why == PC_SUBPC_ERROR);
  PetscFunctionReturn(0);
}

/*
   Calls KSPSolve(). *failed: a library inside it reported an error; x is then zero. PCAMGF reports errors of its own
   solvers on all ranks. Any other library error is assumed to occur on all ranks.
*/
PetscErrorCode IPGuardedSolve(Tao tao, KSP ksp, Vec b, Vec x, PetscBool *failed)
{
  TAO_IPFILTER      *ip = (TAO_IPFILTER *)tao->data;
  AMGFGuard          guard;
  KSPConvergedReason reason;
  PetscErrorCode     error;

  PetscFunctionBegin;
  PetscCall(PCAMGFGuardBegin_Private(&guard, b));
  error = KSPSolve(ksp, b, x);
  PetscCall(PCAMGFGuardEnd_Private(&guard, error, failed));
  if (*failed) PetscCall(PetscStrncpy(ip->lin->why, guard.why, sizeof(ip->lin->why)));
  else {
    PetscCall(KSPGetConvergedReason(ksp, &reason));
    if (reason == KSP_DIVERGED_PC_FAILED) PetscCall(GuardAskPC(ksp, failed));
    if (!*failed) PetscFunctionReturn(0);
    PetscCall(PetscStrncpy(ip->lin->why, "an error inside the multigrid", sizeof(ip->lin->why)));
  }
  PetscCall(PetscInfo(tao, "Error inside the linear solver: %s\n", ip->lin->why));
  PetscCall(GuardReplacePC(tao));
  PetscCall(VecSet(x, 0.0));
  PetscFunctionReturn(0);
}
