/*
   Wrappers for MUMPS if PETSc was configured with it. PETSc always declares MatMumps*(), but a library without MUMPS
   does not define them, so an unguarded call would not link. Compile with -DAMGF_WITHOUT_MUMPS to test this.
*/
#ifndef AMGF_MUMPS_H
#define AMGF_MUMPS_H

#include <petscmat.h>

#if defined(PETSC_HAVE_MUMPS) && !defined(AMGF_WITHOUT_MUMPS)
  #define AMGF_HAVE_MUMPS 1
#endif

#define AMGF_MUMPS_RELAXATION 20 /* per cent of work space beyond MUMPS's estimate: its own default */

/* Increases the work space [per cent beyond MUMPS's estimate]: `first` initially, then twice the last value. Returns
   false when 16 times `first` was not enough */
static inline PetscBool AMGFMumpsMoreSpace(PetscInt first, PetscInt *relaxation)
{
  const PetscInt last = 16 * first;

  if (*relaxation >= last) return PETSC_FALSE;
  *relaxation = *relaxation ? 2 * *relaxation : first;
  return PETSC_TRUE;
}

/* factors: whether MUMPS factors matrices of this type; the functions below are for those types */
static inline PetscErrorCode AMGFMumpsFactors(MatType type, MatFactorType factor, PetscBool *factors)
{
  PetscFunctionBegin;
  *factors = PETSC_FALSE;
#if defined(AMGF_HAVE_MUMPS)
  PetscCall(MatSolverTypeGet(MATSOLVERMUMPS, type, factor, NULL, factors, NULL));
#else
  (void)type;
  (void)factor;
#endif
  PetscFunctionReturn(0);
}

/* Without MUMPS this does nothing */
static inline PetscErrorCode AMGFMumpsSetIcntl(Mat F, PetscInt icntl, PetscInt value)
{
  PetscFunctionBegin;
#if defined(AMGF_HAVE_MUMPS)
  PetscCall(MatMumpsSetIcntl(F, icntl, value));
#else
  (void)F;
  (void)icntl;
  (void)value;
#endif
  PetscFunctionReturn(0);
}

static inline PetscErrorCode AMGFMumpsSetCntl(Mat F, PetscInt cntl, PetscReal value)
{
  PetscFunctionBegin;
#if defined(AMGF_HAVE_MUMPS)
  PetscCall(MatMumpsSetCntl(F, cntl, value));
#else
  (void)F;
  (void)cntl;
  (void)value;
#endif
  PetscFunctionReturn(0);
}

/* Without MUMPS the value is 0 */
static inline PetscErrorCode AMGFMumpsGetInfog(Mat F, PetscInt infog, PetscInt *value)
{
  PetscFunctionBegin;
#if defined(AMGF_HAVE_MUMPS)
  PetscCall(MatMumpsGetInfog(F, infog, value));
#else
  (void)F;
  (void)infog;
  *value = 0;
#endif
  PetscFunctionReturn(0);
}

static inline PetscErrorCode AMGFMumpsGetRinfog(Mat F, PetscInt rinfog, PetscReal *value)
{
  PetscFunctionBegin;
#if defined(AMGF_HAVE_MUMPS)
  PetscCall(MatMumpsGetRinfog(F, rinfog, value));
#else
  (void)F;
  (void)rinfog;
  *value = 0.0;
#endif
  PetscFunctionReturn(0);
}

#endif
