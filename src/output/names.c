/* Determines the names of the files of an output. */
#include "outputimpl.h"
#include <string.h>

/* Stops with an error if `base` is the name of a folder, since a file name must begin with other characters. */
PetscErrorCode OutputCheckBase(MPI_Comm comm, const char base[])
{
  const char     *slash = strrchr(base, '/'), *last = slash ? slash + 1 : base;
  const PetscBool named = (PetscBool)(last[0] && strcmp(last, ".") && strcmp(last, ".."));

  PetscFunctionBegin;
  PetscCheck(named, comm, PETSC_ERR_FILE_OPEN,
    "\"%s\" is a folder; -output needs the beginning of the files' names, for example results/press", base);
  PetscFunctionReturn(0);
}

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
