/* Log events of the contact search and of the contact integrals, for -log_view */
#include "geometryimpl.h"

PetscLogEvent CONTACT_Linearize, CONTACT_Search, CONTACT_Integrate;

PetscErrorCode ContactEventsRegister(void)
{
  static PetscBool registered = PETSC_FALSE;
  PetscClassId     classid;

  PetscFunctionBegin;
  if (registered) PetscFunctionReturn(0);
  registered = PETSC_TRUE;
  PetscCall(PetscClassIdRegister("Contact", &classid));
  PetscCall(PetscLogEventRegister("ContactLinear", classid, &CONTACT_Linearize));
  PetscCall(PetscLogEventRegister("ContactSearch", classid, &CONTACT_Search));
  PetscCall(PetscLogEventRegister("ContactIntegr", classid, &CONTACT_Integrate));
  PetscFunctionReturn(0);
}
