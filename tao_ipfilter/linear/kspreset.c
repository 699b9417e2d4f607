/* KSPReset() for any KSP, as PETSc's flexible CG does not bear it. */
#include "linearimpl.h"

/* Flexible CG would go on with directions that are no longer there: it is made anew */
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
