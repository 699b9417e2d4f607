/* How far the stiffnesses of an operator's rows are apart */
#include "amgfimpl.h"

/*
   A x - D x with a vector of no zeros: exactly zero in rows that are coupled to no other, such as those of prescribed
   values
*/
static PetscErrorCode ContrastFindCoupling(Mat A, Vec diagonal, Vec *coupling)
{
  Vec          x;
  PetscInt     start, end;
  PetscScalar *entries;

  PetscFunctionBegin;
  PetscCall(MatCreateVecs(A, &x, coupling));
  PetscCall(VecGetOwnershipRange(x, &start, &end));
  PetscCall(VecGetArrayWrite(x, &entries));
  for (PetscInt i = start; i < end; i++) {
    const PetscReal golden = 0.6180339887498949 * (PetscReal)i;

    entries[i - start] = 1.0 + golden - PetscFloorReal(golden);
  }
  PetscCall(VecRestoreArrayWrite(x, &entries));
  PetscCall(MatMult(A, x, *coupling));
  PetscCall(VecPointwiseMult(x, x, diagonal));
  PetscCall(VecAXPY(*coupling, -1.0, x));
  PetscCall(VecDestroy(&x));
  PetscFunctionReturn(0);
}

/* The largest of the entries, and of their inverses; on this rank */
static PetscErrorCode ContrastFindRange(Vec diagonal, Vec coupling, PetscReal range[2])
{
  PetscInt           n;
  const PetscScalar *d, *c = NULL;

  PetscFunctionBegin;
  range[0] = range[1] = 0.0;
  PetscCall(VecGetLocalSize(diagonal, &n));
  PetscCall(VecGetArrayRead(diagonal, &d));
  if (coupling) PetscCall(VecGetArrayRead(coupling, &c));
  for (PetscInt i = 0; i < n; i++) {
    const PetscReal entry = PetscRealPart(d[i]);

    if (!(entry > 0.0) || (c && c[i] == 0.0)) continue;
    range[0] = PetscMax(range[0], entry);
    range[1] = PetscMax(range[1], 1.0 / entry);
  }
  if (coupling) PetscCall(VecRestoreArrayRead(coupling, &c));
  PetscCall(VecRestoreArrayRead(diagonal, &d));
  PetscFunctionReturn(0);
}

/*
  PCAMGFFindContrast_Private - the largest over the smallest positive diagonal entry

  Input Parameters:
+ A       - the operator
- coupled - whether rows that are coupled to no other are left out, which takes a product with the operator
*/
PetscErrorCode PCAMGFFindContrast_Private(Mat A, PetscBool coupled, PetscReal *contrast)
{
  Vec       diagonal, coupling = NULL;
  PetscReal range[2];

  PetscFunctionBegin;
  PetscCall(MatCreateVecs(A, &diagonal, NULL));
  PetscCall(MatGetDiagonal(A, diagonal));
  if (coupled) PetscCall(ContrastFindCoupling(A, diagonal, &coupling));
  PetscCall(ContrastFindRange(diagonal, coupling, range));
  PetscCall(VecDestroy(&coupling));
  PetscCall(VecDestroy(&diagonal));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, range, 2, MPIU_REAL, MPIU_MAX, PetscObjectComm((PetscObject)A)));
  *contrast = range[0] * range[1];
  PetscFunctionReturn(0);
}
