/* Tests whether the operator is symmetric: the levels store one triangle of their matrices */
#include "blockamgimpl.h"

/*
   Computes the size of A v - A^T v relative to that of A v, for a vector v that has a component along every
   eigenvector. Both are measured for A scaled to a diagonal of ones, so that units have no influence.
*/
static PetscErrorCode SymmetryMeasure(Mat A, PetscReal *difference)
{
  Vec          scale, v, product, transposed;
  PetscScalar *s, *a;
  PetscReal    size;
  PetscInt     start, end;

  PetscFunctionBegin;
  PetscCall(MatCreateVecs(A, &v, &product));
  PetscCall(VecDuplicate(v, &scale));
  PetscCall(VecDuplicate(v, &transposed));
  PetscCall(MatGetDiagonal(A, scale));
  PetscCall(VecGetOwnershipRange(v, &start, &end));
  PetscCall(VecGetArray(scale, &s));
  PetscCall(VecGetArrayWrite(v, &a));
  for (PetscInt i = 0; i < end - start; i++) {
    s[i] = 1.0 / PetscSqrtReal(PetscAbsScalar(s[i]));
    a[i] = s[i] * PetscSinReal(1.0 + 1.7 * (PetscReal)(start + i));
  }
  PetscCall(VecRestoreArrayWrite(v, &a));
  PetscCall(VecRestoreArray(scale, &s));
  PetscCall(MatMult(A, v, product));
  PetscCall(MatMultTranspose(A, v, transposed));
  PetscCall(VecAXPY(transposed, -1.0, product));
  PetscCall(VecPointwiseMult(product, product, scale));
  PetscCall(VecPointwiseMult(transposed, transposed, scale));
  PetscCall(VecNorm(product, NORM_2, &size));
  PetscCall(VecNorm(transposed, NORM_2, difference));
  if (size > 0.0) *difference /= size;
  PetscCall(VecDestroy(&transposed));
  PetscCall(VecDestroy(&product));
  PetscCall(VecDestroy(&scale));
  PetscCall(VecDestroy(&v));
  PetscFunctionReturn(0);
}

/*
   BlockTestSymmetry_Private - finds whether the operator is symmetric, and stores the answer in the PC_BlockAMG. It is
   tested once for each pattern: rows of prescribed values that keep their columns are part of a pattern. Rounding of
   entries to 16 bits makes differences up to 1e-5 meaningless. The diagonal must not have zeros.
*/
PetscErrorCode BlockTestSymmetry_Private(PC pc)
{
  PC_BlockAMG     *amg      = (PC_BlockAMG *)pc->data;
  const PetscReal  rounding = 1e-5;
  PetscReal        difference;
  PetscObjectState pattern;
  PetscObjectId    id;
  PetscBool        half, known, symmetric;

  PetscFunctionBegin;
  PetscCall(MatGetNonzeroState(pc->pmat, &pattern));
  PetscCall(PetscObjectGetId((PetscObject)pc->pmat, &id));
  if (id == amg->tested && pattern == amg->pattern) PetscFunctionReturn(0);
  amg->tested    = id;
  amg->pattern   = pattern;
  amg->symmetric = PETSC_TRUE;
  PetscCall(PetscObjectTypeCompareAny((PetscObject)pc->pmat, &half, MATSEQSBAIJ, MATMPISBAIJ, ""));
  PetscCall(MatIsSymmetricKnown(pc->pmat, &known, &symmetric));
  if (half || (known && symmetric)) PetscFunctionReturn(0);
  PetscCall(SymmetryMeasure(pc->pmat, &difference));
  amg->symmetric = (PetscBool) !(difference > rounding);
  if (!amg->symmetric)
    PetscCall(PetscInfo(pc, "The operator is not symmetric, by %g of its size: hypre's own cycle is used\n",
      (double)difference));
  PetscFunctionReturn(0);
}
