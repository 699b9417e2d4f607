/* Computes the matrices R = P^H A (few rows) and A_w = P^H A P. With real scalars P^H is P^T. */
#include "amgfimpl.h"

/* Computes R and A_w if P selects unknowns: R consists of rows of A, and A_w of columns of R */
static PetscErrorCode GalerkinFromRows(PC pc, PetscBool reuse)
{
  PC_AMGF *amgf = (PC_AMGF *)pc->data;
  IS       all;
  PetscInt start, end;

  PetscFunctionBegin;
  PetscCall(MatGetThinRows_AMGF(pc->pmat, amgf->sub.rows, reuse, &amgf->R));
  PetscCall(MatGetOwnershipRange(amgf->R, &start, &end));
  PetscCall(ISCreateStride(PetscObjectComm((PetscObject)pc), end - start, start, 1, &all));
  PetscCall(MatCreateSubMatrix(amgf->R, all, amgf->sub.rows, reuse ? MAT_REUSE_MATRIX : MAT_INITIAL_MATRIX, &amgf->Aw));
  PetscCall(ISDestroy(&all));
  PetscFunctionReturn(0);
}

/* Computes R and A_w for a general P. Let S be the rows in which P is nonzero; then P^H A = P_S^H A_S. */
static PetscErrorCode GalerkinFromInterpolation(PC pc, PetscBool reuse)
{
  PC_AMGF       *amgf = (PC_AMGF *)pc->data;
  const MatReuse call = reuse ? MAT_REUSE_MATRIX : MAT_INITIAL_MATRIX;

  PetscFunctionBegin;
  PetscCall(MatGetThinRows_AMGF(pc->pmat, amgf->sub.rows, reuse, &amgf->rowsA));
  PetscCall(MatCreateSubMatrix(amgf->sub.P, amgf->sub.rows, NULL, call, &amgf->rowsP));
  PetscCall(MatConjugate(amgf->rowsP));
  PetscCall(MatTransposeMatMult(amgf->rowsP, amgf->rowsA, call, PETSC_DEFAULT, &amgf->R));
  PetscCall(MatMatMult(amgf->R, amgf->sub.P, call, PETSC_DEFAULT, &amgf->Aw));
  PetscFunctionReturn(0);
}

PetscErrorCode PCAMGFResetGalerkin_Private(PC_AMGF *amgf)
{
  PetscFunctionBegin;
  PetscCall(MatDestroy(&amgf->rowsA));
  PetscCall(MatDestroy(&amgf->rowsP));
  PetscCall(MatDestroy(&amgf->R));
  PetscCall(MatDestroy(&amgf->Aw));
  PetscCall(VecDestroy(&amgf->rc));
  PetscCall(VecDestroy(&amgf->ec));
  PetscCall(VecDestroy(&amgf->wc));
  PetscFunctionReturn(0);
}

/*
   Updates R and A_w for the present matrix pc->pmat. same: true if the subspace is unchanged since the last update, so
   that the nonzero patterns can be reused
*/
PetscErrorCode PCAMGFUpdateGalerkin_Private(PC pc, PetscBool same)
{
  PC_AMGF  *amgf = (PC_AMGF *)pc->data;
  AMGFStamp now;
  PetscBool reuse;

  PetscFunctionBegin;
  PetscCall(MatGetStamp_AMGF(pc->pmat, &now));
  reuse          = (PetscBool)(same && amgf->Aw && AMGFStampSamePattern(&now, &amgf->galerkin));
  amgf->galerkin = now;
  if (!reuse) PetscCall(PCAMGFResetGalerkin_Private(amgf));
  if (amgf->sub.P) PetscCall(GalerkinFromInterpolation(pc, reuse));
  else PetscCall(GalerkinFromRows(pc, reuse));
  /* With this option the matrix is factored without pivoting. MAT_SPD is not set for complex scalars, because for PETSc
     it implies symmetry, which a complex Hermitian matrix does not have. */
  PetscCall(MatSetOption(amgf->Aw, PetscDefined(USE_COMPLEX) ? MAT_HERMITIAN : MAT_SPD, PETSC_TRUE));
  if (!amgf->rc) {
    PetscCall(MatCreateVecs(amgf->Aw, &amgf->ec, &amgf->rc));
    PetscCall(VecDuplicate(amgf->rc, &amgf->wc));
  }
  PetscFunctionReturn(0);
}
