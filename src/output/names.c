/* What the files of an output are called */
#include "outputimpl.h"

PetscErrorCode OutputGetMeshFile(Output output, char file[], size_t length)
{
  PetscFunctionBegin;
  PetscCall(PetscSNPrintf(file, length, "%s.h5", output->base));
  PetscFunctionReturn(0);
}

PetscErrorCode OutputGetStepFile(Output output, PetscInt step, char file[], size_t length)
{
  PetscFunctionBegin;
  PetscCall(PetscSNPrintf(file, length, "%s_%04" PetscInt_FMT ".h5", output->base, step));
  PetscFunctionReturn(0);
}
