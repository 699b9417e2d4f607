/* Lists of names, each allocated individually */
#include "queryimpl.h"
#include <string.h>

PetscErrorCode NamesDestroy(PetscInt *n, char ***names)
{
  PetscFunctionBegin;
  for (PetscInt f = 0; f < *n; ++f) PetscCall(PetscFree((*names)[f]));
  PetscCall(PetscFree(*names));
  *n = 0;
  PetscFunctionReturn(0);
}

PetscErrorCode NamesJoin(PetscInt n, char *const names[], size_t size, char text[])
{
  PetscFunctionBegin;
  PetscCall(PetscStrncpy(text, n ? "" : "none", size));
  for (PetscInt i = 0; i < n; ++i) {
    const size_t used = strlen(text);

    PetscCall(PetscSNPrintf(text + used, size - used, "%s%s", i ? ", " : "", names[i]));
  }
  PetscFunctionReturn(0);
}
