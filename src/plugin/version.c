/* Version of the plugin, and how it was compiled */
#include "pc_amgf/amgfimpl.h"

/*@C
  PetscAMGFGetVersion - Gets the release of the plugin that runs, and the PETSc that it was compiled with

  Not Collective

  Input Parameter:
. len - length of `version`; 128 is sufficient

  Output Parameter:
. version - sentence such as "petscamgf 0.1.0, compiled with PETSc 3.18.5, real scalars, 32-bit indices"

  Level: intermediate

  Note:
  `PETSCAMGF_VERSION_MAJOR`, `PETSCAMGF_VERSION_MINOR`, `PETSCAMGF_VERSION_SUBMINOR`, `PETSCAMGF_VERSION_LT()` and
  `PETSCAMGF_VERSION_GE()` say at compile time which release a program is compiled for.

.seealso: `PetscAMGFInitializePackage()`, `PCAMGF`, `TAOIPFILTER`
@*/
PetscErrorCode PetscAMGFGetVersion(char version[], size_t len)
{
  PetscFunctionBegin;
  PetscAssertPointer(version, 1);
  PetscCall(PetscSNPrintf(version, len, "petscamgf %d.%d.%d, compiled with PETSc %d.%d.%d, %s scalars, %d-bit indices",
    PETSCAMGF_VERSION_MAJOR, PETSCAMGF_VERSION_MINOR, PETSCAMGF_VERSION_SUBMINOR, PETSC_VERSION_MAJOR,
    PETSC_VERSION_MINOR, PETSC_VERSION_SUBMINOR, PetscDefined(USE_COMPLEX) ? "complex" : "real",
    8 * (int)sizeof(PetscInt)));
  PetscFunctionReturn(0);
}
