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

#define AMGF_MUMPS_RELAXATION 20 /* work space beyond MUMPS's estimate [per cent]; MUMPS's own default */

/*
   Increases the work space beyond MUMPS's estimate [per cent]: from 0 to `first`, and then to twice its last value.
   Returns false if it already is 16 times `first`; *relaxation is then unchanged.
*/
static inline PetscBool AMGFMumpsMoreSpace(PetscInt first, PetscInt *relaxation)
{
  const PetscInt last = 16 * first;

  if (*relaxation >= last) return PETSC_FALSE;
  *relaxation = *relaxation ? 2 * *relaxation : first;
  return PETSC_TRUE;
}

/* Finds whether MUMPS can factor matrices of this type. The functions below are for factors of such matrices. */
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

/* Sets an integer control parameter of MUMPS. Does nothing without MUMPS. */
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

/* Gets a global integer result of MUMPS; 0 without MUMPS */
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
