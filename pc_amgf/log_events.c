/* Log events of PCAMGF */
#include "amgfimpl.h"

PetscLogEvent PC_AMGF_AMGSetUp, PC_AMGF_AMGApply, PC_AMGF_FltSetUp, PC_AMGF_FltApply, PC_BLOCKAMG_SetUp,
  PC_BLOCKAMG_Convert, PC_BLOCKAMG_Apply;

PetscErrorCode PCAMGFLogRegister_Private(void)
{
  PetscFunctionBegin;
  PetscCall(PetscLogEventRegister("PCAMGFAMGSetUp", PC_CLASSID, &PC_AMGF_AMGSetUp));
  PetscCall(PetscLogEventRegister("PCAMGFAMGApply", PC_CLASSID, &PC_AMGF_AMGApply));
  PetscCall(PetscLogEventRegister("PCAMGFFltSetUp", PC_CLASSID, &PC_AMGF_FltSetUp));
  PetscCall(PetscLogEventRegister("PCAMGFFltApply", PC_CLASSID, &PC_AMGF_FltApply));
  PetscCall(PetscLogEventRegister("PCBlockAMGSetUp", PC_CLASSID, &PC_BLOCKAMG_SetUp));
  PetscCall(PetscLogEventRegister("PCBlockAMGConv", PC_CLASSID, &PC_BLOCKAMG_Convert));
  PetscCall(PetscLogEventRegister("PCBlockAMGApply", PC_CLASSID, &PC_BLOCKAMG_Apply));
  PetscFunctionReturn(0);
}
