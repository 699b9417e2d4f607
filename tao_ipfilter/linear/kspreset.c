/* Calls KSPReset() for any type of KSP. PETSc's flexible CG fails after KSPReset(). */
#include "linearimpl.h"

/* Resets a KSP. Flexible CG is created again, since it would use directions that KSPReset() has destroyed. */
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
