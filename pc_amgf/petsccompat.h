/* What differs between PETSc releases, and nothing else. Base: 3.18; newest compiled against: the main branch of August 2026 (3.25). */
#ifndef PETSCCOMPAT_H
#define PETSCCOMPAT_H

#include <petscsys.h>

#if PETSC_VERSION_LT(3, 20, 0)
  #define PetscAssertPointer(pointer, argument) PetscValidPointer(pointer, argument)
#endif

/* PetscOptionItems became a pointer */
#if PETSC_VERSION_LT(3, 23, 0)
typedef PetscOptionItems *AMGFOptionItems;
#else
typedef PetscOptionItems AMGFOptionItems;
#endif

/* PetscBool became C's bool */
#if PETSC_VERSION_LT(3, 24, 0)
  #define MPI_PETSCBOOL MPIU_BOOL
#else
  #define MPI_PETSCBOOL MPI_C_BOOL
#endif

/* A vector that tells the solver which asked for it of a failure */
#if PETSC_VERSION_LT(3, 22, 0)
  #define VecFlag(vector, failed) ((failed) ? VecSetInf(vector) : (PetscErrorCode)0)
#endif

/* What a shell matrix's operation is passed as */
#if PETSC_VERSION_LT(3, 24, 0)
typedef void AMGFOperation(void);
#else
typedef PetscErrorCodeFn AMGFOperation;
#endif

/* Defaults of a type that do not overrule the user's values */
#if PETSC_VERSION_LT(3, 22, 0)
  #define PetscObjectParameterSetDefault(object, name, value) \
    do { \
      if (!(object)->name##_changed) (object)->name = (value); \
    } while (0)
#endif

#endif
