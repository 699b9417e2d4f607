/*
   MUMPS where PETSc was configured with it. PETSc declares MatMumps*() in either case, but a library without MUMPS
   does not define them: one call left unguarded, and nothing links. Compile with -DAMGF_WITHOUT_MUMPS to be as a
   PETSc without MUMPS would make it.
*/
#ifndef AMGF_MUMPS_H
#define AMGF_MUMPS_H

#include <petscmat.h>

#if defined(PETSC_HAVE_MUMPS) && !defined(AMGF_WITHOUT_MUMPS)
  #define AMGF_HAVE_MUMPS 1
#endif

#define AMGF_MUMPS_RELAXATION 20 /* per cent of work space beyond MUMPS's estimate: its own default */

/* Work space beyond the estimate, which may be too small: `first` per cent where there is none yet, else twice what
   did not suffice; false where that was 16 times the first */
static inline PetscBool AMGFMumpsMoreSpace(PetscInt first, PetscInt *relaxation)
{
  const PetscInt last = 16 * first;

  if (*relaxation >= last) return PETSC_FALSE;
  *relaxation = *relaxation ? 2 * *relaxation : first;
  return PETSC_TRUE;
}

/* Whether MUMPS factors matrices of a type; everything below is for those it does */
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

/* Without MUMPS no matrix is a factor of it, so there is nothing to control */
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

/* Without MUMPS nothing was factored, and 0 is what it would say of that */
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
