/* Direct solver of the filtered matrix */
#include "amgfimpl.h"
#include "mumps.h"

/*
  PCAMGFSetDirectSolver_Private - Cholesky: by MUMPS if PETSc has it, else PETSc's own, the matrix gathered on every
  rank. PETSc has no Hermitian Cholesky by MUMPS, so complex numbers take LU.

  Output Parameter:
. mumps - whether it is by MUMPS
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
