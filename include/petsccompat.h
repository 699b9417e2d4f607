/* Differences between PETSc releases, and nothing else. Oldest release: 3.18; newest compiled against: the main
   branch of August 2026 (3.25). */
#ifndef PETSCCOMPAT_H
#define PETSCCOMPAT_H

#include <petscvec.h>

#if PETSC_VERSION_LT(3, 20, 0)
  #define PetscAssertPointer(pointer, argument) PetscValidPointer(pointer, argument)
  #define VecFilter(vector, tolerance)          VecChop(vector, tolerance)
#endif

/* w = x / y, and 0 where y is 0: VecPointwiseDivide() of newer releases takes 0 / 0 for 1. w may be x or y */
#if PETSC_VERSION_LT(3, 26, 0)
  #define VecQuotient_AMGF(w, x, y) VecPointwiseDivide(w, x, y)
#else
static inline PetscErrorCode VecQuotient_AMGF(Vec w, Vec x, Vec y)
{
  const PetscScalar *numerator, *divisor;
  PetscScalar       *quotient;
  PetscInt           n;

  PetscFunctionBegin;
  PetscCall(VecGetLocalSize(w, &n));
  PetscCall(VecGetArray(w, &quotient));
  PetscCall(VecGetArrayRead(x, &numerator));
  PetscCall(VecGetArrayRead(y, &divisor));
  for (PetscInt i = 0; i < n; ++i) quotient[i] = divisor[i] == 0.0 ? 0.0 : numerator[i] / divisor[i];
  PetscCall(VecRestoreArrayRead(y, &divisor));
  PetscCall(VecRestoreArrayRead(x, &numerator));
  PetscCall(VecRestoreArray(w, &quotient));
  PetscFunctionReturn(0);
}
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

/* Argument of a destructor: the context (old), or a pointer to it (new) */
#if PETSC_VERSION_LT(3, 23, 0)
typedef PetscErrorCode PetscCtxDestroyFn(void *);
  #define PetscContainerSetCtxDestroy(container, destroy) PetscContainerSetUserDestroy(container, destroy)
  #define AMGFDestroyed(argument)                         (argument)
#else
  #define AMGFDestroyed(argument) (*(void **)(argument))
#endif

/* Marks a vector so that the solver which asked for it sees a failure */
#if PETSC_VERSION_LT(3, 22, 0)
  #define VecFlag(vector, failed) ((failed) ? VecSetInf(vector) : (PetscErrorCode)0)
#endif

/* The type of a shell matrix's operation */
#if PETSC_VERSION_LT(3, 24, 0)
typedef void AMGFOperation(void);
#else
typedef PetscErrorCodeFn AMGFOperation;
#endif

/* Sets defaults of a type that do not override the user's values */
#if PETSC_VERSION_LT(3, 22, 0)
  #define PetscObjectParameterSetDefault(object, name, value) \
    do { \
      if (!(object)->name##_changed) (object)->name = (value); \
    } while (0)
#endif

/* Functions that were renamed, each with the first release of the new name; older releases use the old name */
#if PETSC_VERSION_LT(3, 21, 0)
  #define TaoMonitorSet(tao, monitor, context, destroy) TaoSetMonitor(tao, monitor, context, destroy)
#endif
#if PETSC_VERSION_LT(3, 23, 0)
typedef size_t PetscSegBufferCount;
#else
typedef PetscCount       PetscSegBufferCount;
#endif
#if PETSC_VERSION_LT(3, 25, 0)
  #define SNES_DIVERGED_FUNCTION_NANORINF SNES_DIVERGED_FNORM_NAN
#endif
#if PETSC_VERSION_LT(3, 26, 0)
  #define AMGF_LINESEARCH_NONE SNESLINESEARCHBASIC
#else
  #define AMGF_LINESEARCH_NONE SNESLINESEARCHNONE
#endif

/* Newer releases pass edge weights to a partitioner; our meshes have none */
#if PETSC_VERSION_LT(3, 21, 0)
  #define AMGF_EDGE_SECTION
#else
  #define AMGF_EDGE_SECTION PETSC_UNUSED PetscSection edgesection,
#endif

#endif
