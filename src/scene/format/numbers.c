/* Prints numbers in the form that a scene file requires. */
#include "formatimpl.h"
#include <petscviewer.h>
#include <stdlib.h>

/*
   Prints the shortest decimal number that is read back as the same number. PETSC_INFINITY, a finite number in some
   releases of PETSc, is printed as inf.
*/
PetscErrorCode SceneViewReal(PetscViewer viewer, PetscReal value)
{
  char text[64];

  PetscFunctionBegin;
  if (PetscAbsReal(value) >= PETSC_INFINITY) {
    PetscCall(PetscViewerASCIIPrintf(viewer, value < 0 ? "-inf" : "inf"));
    PetscFunctionReturn(0);
  }
  for (int digits = 6; digits <= 17; ++digits) {
    (void)snprintf(text, sizeof(text), "%.*g", digits, (double)value);
    if ((PetscReal)strtod(text, NULL) == value) break;
  }
  PetscCall(PetscViewerASCIIPrintf(viewer, "%s", text));
  PetscFunctionReturn(0);
}

PetscErrorCode SceneViewList(PetscViewer viewer, PetscInt n, const PetscReal values[])
{
  PetscFunctionBegin;
  PetscCall(PetscViewerASCIIPrintf(viewer, "["));
  for (PetscInt i = 0; i < n; ++i) {
    if (i) PetscCall(PetscViewerASCIIPrintf(viewer, ", "));
    PetscCall(SceneViewReal(viewer, values[i]));
  }
  PetscCall(PetscViewerASCIIPrintf(viewer, "]"));
  PetscFunctionReturn(0);
}

PetscErrorCode SceneViewReals(PetscViewer viewer, const char label[], PetscInt n, const PetscReal values[])
{
  PetscFunctionBegin;
  PetscCall(PetscViewerASCIIPrintf(viewer, "%s: ", label));
  PetscCall(PetscViewerASCIIUseTabs(viewer, PETSC_FALSE));
  PetscCall(SceneViewList(viewer, n, values));
  PetscCall(PetscViewerASCIIPrintf(viewer, "\n"));
  PetscCall(PetscViewerASCIIUseTabs(viewer, PETSC_TRUE));
  PetscFunctionReturn(0);
}
