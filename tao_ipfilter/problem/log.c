/* Log events of TAOIPFILTER */
#include "problemimpl.h"

PetscLogEvent TAO_IPFilterStart, TAO_IPFilterCondense, TAO_IPFilterSolve, TAO_IPFilterApply, TAO_IPFilterDirections,
  TAO_IPFilterReduced, TAO_IPFilterFactor;

static PetscBool registered = PETSC_FALSE;

/* Forgets the registered events, which PETSc frees in PetscFinalize() */
static PetscErrorCode LogFinalize(void)
{
  PetscFunctionBegin;
  registered = PETSC_FALSE;
  PetscFunctionReturn(0);
}

PetscErrorCode IPLogRegister(void)
{
  PetscFunctionBegin;
  if (registered) PetscFunctionReturn(0);
  PetscCall(PetscLogEventRegister("TaoIPFltStart", TAO_CLASSID, &TAO_IPFilterStart));
  PetscCall(PetscLogEventRegister("TaoIPFltCondens", TAO_CLASSID, &TAO_IPFilterCondense));
  PetscCall(PetscLogEventRegister("TaoIPFltSolve", TAO_CLASSID, &TAO_IPFilterSolve));
  PetscCall(PetscLogEventRegister("TaoIPFltApply", TAO_CLASSID, &TAO_IPFilterApply));
  PetscCall(PetscLogEventRegister("TaoIPFltDirect", TAO_CLASSID, &TAO_IPFilterDirections));
  PetscCall(PetscLogEventRegister("TaoIPFltReduced", TAO_CLASSID, &TAO_IPFilterReduced));
  PetscCall(PetscLogEventRegister("TaoIPFltFactor", TAO_CLASSID, &TAO_IPFilterFactor));
  PetscCall(PetscRegisterFinalize(LogFinalize));
  registered = PETSC_TRUE;
  PetscFunctionReturn(0);
}
