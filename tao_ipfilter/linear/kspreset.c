/* KSPReset() for any KSP; PETSc's flexible CG fails after KSPReset(). */
#include "linearimpl.h"

/* Flexible CG would use directions that no longer exist, so it is created again */
PetscErrorCode IPKSPReset(KSP ksp)
{
  PetscBool flexible;
  PetscInt  directions, preallocated;

  PetscFunctionBegin;
  PetscCall(KSPReset(ksp));
  PetscCall(PetscObjectTypeCompare((PetscObject)ksp, KSPFCG, &flexible));
  if (!flexible) PetscFunctionReturn(0);
  PetscCall(KSPFCGGetMmax(ksp, &directions));
  PetscCall(KSPFCGGetNprealloc(ksp, &preallocated));
  PetscCall(KSPSetType(ksp, KSPCG));
  PetscCall(KSPSetType(ksp, KSPFCG));
  PetscCall(KSPFCGSetMmax(ksp, directions));
  PetscCall(KSPFCGSetNprealloc(ksp, preallocated));
  PetscFunctionReturn(0);
}
