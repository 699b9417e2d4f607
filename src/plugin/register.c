/* Registers PCAMGF and TAOIPFILTER when the plugin is loaded */
#include "pc_amgf/amgfimpl.h"

static PetscBool initialized = PETSC_FALSE;

#if !defined(PETSC_USE_COMPLEX)
  #include "pc_amgf/blockamg/blockamgimpl.h"
PETSC_EXTERN PetscErrorCode TaoCreate_IPFilter(Tao);
#endif
PETSC_EXTERN PetscErrorCode PetscDLLibraryRegister_petscamgf(void);

/*@C
  PetscAMGFInitializePackage - Registers the preconditioner `PCAMGF`, the optimizer `TAOIPFILTER` and their log events

  Logically Collective

  Level: developer

  Notes:
  Called when the shared library is loaded with `-dll_append`. A program linked with the library calls it once
  after `PetscInitialize()`; further calls do nothing.

  It is an error if the PETSc that runs differs in release, or in the size of `PetscInt`, `PetscReal` or `PetscScalar`,
  from the one that the library was compiled with.

  Where PETSc's scalars are complex, the library holds `PCAMGF` alone.

.seealso: `PCAMGF`, `TAOIPFILTER`, `PetscAMGFFinalizePackage()`
@*/
PetscErrorCode PetscAMGFInitializePackage(void)
{
  PetscFunctionBegin;
  if (initialized) PetscFunctionReturn(0);
  PetscCall(PCAMGFCheckLibrary_Private());
  initialized = PETSC_TRUE;
  PetscCall(PCRegister(PCAMGF, PCCreate_AMGF));
#if !defined(PETSC_USE_COMPLEX)
  PetscCall(PCRegister(PCBLOCKAMG, PCCreate_BlockAMG));
  PetscCall(TaoRegister(TAOIPFILTER, TaoCreate_IPFilter));
#endif
  PetscCall(PCAMGFLogRegister_Private());
  PetscCall(PetscRegisterFinalize(PetscAMGFFinalizePackage));
  PetscFunctionReturn(0);
}

/*@C
  PetscAMGFFinalizePackage - Marks the package as not initialized, so that it can be initialized again after another
  `PetscInitialize()`

  Logically Collective

  Level: developer

  Note:
  Called by `PetscFinalize()`; PETSc itself frees the lists of types.

.seealso: `PetscAMGFInitializePackage()`
@*/
PetscErrorCode PetscAMGFFinalizePackage(void)
{
  PetscFunctionBegin;
  initialized = PETSC_FALSE;
  PetscFunctionReturn(0);
}

/*
   PetscDLLibraryRegister_petscamgf - registers the types when PETSc loads the plugin with -dll_append libpetscamgf.so.
   PETSc derives the name of this function from the name of the file.
*/
PetscErrorCode PetscDLLibraryRegister_petscamgf(void)
{
  PetscFunctionBegin;
  PetscCall(PetscAMGFInitializePackage());
  PetscFunctionReturn(0);
}
