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

/*
   Computes the LU factorization of A. MUMPS factors large matrices and those of several ranks. It factors again with
   more work space while its estimate is too small. PETSc factors small matrices of one rank, since MUMPS takes a
   millisecond for any matrix. If PETSc finds a zero pivot, MUMPS factors the matrix. Without MUMPS PETSc factors all.
   *F: NULL, or factors for the same nonzero pattern, whose analysis is used again; NULL on return after an error.
   *relaxation: work space beyond the estimate [per cent], AMGF_MUMPS_RELAXATION at first
*/
static inline PetscErrorCode AMGFMumpsFactorLU(Mat A, PetscInt *relaxation, Mat *F, MatFactorError *error)
{
  const PetscInt small = 500; /* size up to which PETSc is faster; 700: equal */
  MatFactorInfo  info;
  MatType        type;
  PetscMPIInt    size;
  PetscInt       n;
  PetscBool      has, mumps, again;

  PetscFunctionBegin;
  PetscCall(MatGetType(A, &type));
  PetscCall(MatGetSize(A, &n, NULL));
  PetscCallMPI(MPI_Comm_size(PetscObjectComm((PetscObject)A), &size));
  PetscCall(AMGFMumpsFactors(type, MAT_FACTOR_LU, &has));
  PetscCall(MatFactorInfoInitialize(&info));
  mumps = (PetscBool)(has && (size > 1 || n > small));
  do {
    if (!*F) {
      IS rows = NULL, columns = NULL;

      PetscCall(MatGetFactor(A, mumps ? MATSOLVERMUMPS : MATSOLVERPETSC, MAT_FACTOR_LU, F));
      if (mumps) PetscCall(AMGFMumpsSetIcntl(*F, 14, *relaxation));
      else PetscCall(MatGetOrdering(A, MATORDERINGND, &rows, &columns));
      PetscCall(MatLUFactorSymbolic(*F, A, rows, columns, &info));
      PetscCall(ISDestroy(&rows));
      PetscCall(ISDestroy(&columns));
    }
    PetscCall(MatLUFactorNumeric(*F, A, &info));
    PetscCall(MatFactorGetError(*F, error));
    if (*error != MAT_FACTOR_NOERROR) PetscCall(MatDestroy(F)); /* MUMPS cannot use them again */
    again = (PetscBool)(mumps ? *error == MAT_FACTOR_OUTMEMORY && AMGFMumpsMoreSpace(AMGF_MUMPS_RELAXATION, relaxation)
                              : has && *error != MAT_FACTOR_NOERROR);
    mumps = has;
  } while (again);
  PetscFunctionReturn(0);
}

#endif
