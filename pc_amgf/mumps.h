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

/* Control parameters and results of MUMPS. Without MUMPS the parameters are ignored, and the results are 0. */
#if defined(AMGF_HAVE_MUMPS)
  #define AMGFMumpsSetIcntl MatMumpsSetIcntl
  #define AMGFMumpsGetIcntl MatMumpsGetIcntl
  #define AMGFMumpsGetInfog MatMumpsGetInfog
#else
  #define AMGFMumpsSetIcntl(F, icntl, value) ((void)(F), (void)(icntl), (void)(value), 0)
  #define AMGFMumpsGetIcntl(F, icntl, value) ((void)(F), (void)(icntl), *(value) = 0, 0)
  #define AMGFMumpsGetInfog(F, infog, value) ((void)(F), (void)(infog), *(value) = 0, 0)
#endif

#endif
