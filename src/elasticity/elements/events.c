/* Log events of elasticity */
#include "elementsimpl.h"

PetscLogEvent ELASTICITY_Tangent, ELASTICITY_Force, ELASTICITY_Error;

PetscErrorCode ElasticityEventsRegister(void)
{
  static PetscBool registered = PETSC_FALSE;
  PetscClassId     classid;

  PetscFunctionBegin;
  if (registered) PetscFunctionReturn(0);
  registered = PETSC_TRUE;
  PetscCall(PetscClassIdRegister("Elasticity", &classid));
  PetscCall(PetscLogEventRegister("ElastTangent", classid, &ELASTICITY_Tangent));
  PetscCall(PetscLogEventRegister("ElastForce", classid, &ELASTICITY_Force));
  PetscCall(PetscLogEventRegister("ElastError", classid, &ELASTICITY_Error));
  PetscFunctionReturn(0);
}
