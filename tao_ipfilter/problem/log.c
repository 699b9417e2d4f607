/* Events of -log_view. */
#include "problemimpl.h"

PetscLogEvent TAO_IPFilterStart, TAO_IPFilterCondense, TAO_IPFilterSolve, TAO_IPFilterApply, TAO_IPFilterAppend,
  TAO_IPFilterReduced;

static PetscBool registered = PETSC_FALSE;

/* Resets the events, which end with PetscFinalize() */
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
  PetscCall(PetscLogEventRegister("TaoIPFltAppend", TAO_CLASSID, &TAO_IPFilterAppend));
  PetscCall(PetscLogEventRegister("TaoIPFltReduced", TAO_CLASSID, &TAO_IPFilterReduced));
  PetscCall(PetscRegisterFinalize(LogFinalize));
  registered = PETSC_TRUE;
  PetscFunctionReturn(0);
}
