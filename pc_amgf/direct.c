/* Chooses the direct solver for the matrix on the filtered subspace */
#include "amgfimpl.h"
#include "mumps.h"

/*
   PCAMGFSetDirectSolver_Private - sets a PC to a Cholesky factorization

   Output Parameter:
   . mumps - whether MUMPS factors the matrix

   Notes:
   If PETSc was configured without MUMPS, PETSc's own Cholesky is used. In parallel, each rank then factors a copy of
   the whole matrix. With complex scalars LU is used, since MUMPS has no Hermitian Cholesky.
*/
PetscErrorCode PCAMGFSetDirectSolver_Private(PC inner, PetscBool *mumps)
{
  const MatFactorType factor = PetscDefined(USE_COMPLEX) ? MAT_FACTOR_LU : MAT_FACTOR_CHOLESKY;
  const PCType        type   = PetscDefined(USE_COMPLEX) ? PCLU : PCCHOLESKY;
  PetscMPIInt         size;

  PetscFunctionBegin;
  PetscCallMPI(MPI_Comm_size(PetscObjectComm((PetscObject)inner), &size));
  PetscCall(AMGFMumpsFactors(size > 1 ? MATMPIAIJ : MATSEQAIJ, factor, mumps));
  if (!*mumps && size > 1) {
    KSP redundant;

    PetscCall(PCSetType(inner, PCREDUNDANT));
    PetscCall(PCRedundantGetKSP(inner, &redundant));
    PetscCall(KSPGetPC(redundant, &inner));
  }
  PetscCall(PCSetType(inner, type));
  if (*mumps) PetscCall(PCFactorSetMatSolverType(inner, MATSOLVERMUMPS));
  PetscFunctionReturn(0);
}
