/* What depends on the unknowns W of the subspace, and the forces of contacts on all unknowns */
#include "subspace_bodies.h"
#include "tao_ipfilter/solver/stiffness.h"

/* Extracts R_W and K_WW, and creates A_WW */
static PetscErrorCode BodiesCreateMatrices(SubspaceBodies b)
{
  PetscInt start, end;
  IS       all;
  Mat      KWW;

  PetscFunctionBegin;
  PetscCall(MatGetOwnershipRange(b->R, &start, &end));
  PetscCall(ISCreateStride(PetscObjectComm((PetscObject)b->R), end - start, start, 1, &all));
  PetscCall(MatCreateSubMatrix(b->R, all, b->W, MAT_INITIAL_MATRIX, &b->RW));
  PetscCall(ISDestroy(&all));
  PetscCall(IPGatherStiffness(b->K, b->W, PETSC_FALSE, &KWW));
  PetscCall(InterfaceMatrixCreate(b->RW, KWW, &b->A));
  PetscCall(MatDestroy(&KWW));
  PetscFunctionReturn(0);
}

/* Destroys what depends on W */
PetscErrorCode BodiesDestroySpace(SubspaceBodies b)
{
  Mat *const matrices[] = {&b->RW, &b->F, &b->JW};
  Vec *const vectors[]  = {&b->on_W, &b->dw0, &b->load, &b->rows, &b->e, &b->off, &b->scale};

  PetscFunctionBegin;
  for (size_t k = 0; k < PETSC_STATIC_ARRAY_LENGTH(matrices); k++) PetscCall(MatDestroy(matrices[k]));
  for (size_t k = 0; k < PETSC_STATIC_ARRAY_LENGTH(vectors); k++) PetscCall(VecDestroy(vectors[k]));
  PetscCall(InterfaceMatrixDestroy(&b->A));
  PetscCall(ISDestroy(&b->W));
  PetscCall(ISDestroy(&b->places));
  PetscCall(IPReducedDestroy(&b->normal));
  PetscCall(KSPDestroy(&b->coupling));
  PetscCall(PetscFree6(b->X, b->schur, b->factors, b->dy, b->loads, b->pivots));
  PetscFunctionReturn(0);
}

/* Creates what depends on W, the unknowns of the contacts and perhaps others */
PetscErrorCode BodiesCreateSpace(SubspaceBodies b, IS W)
{
  const PetscInt max = b->recycle->basis.max;
  PetscInt       nw;

  PetscFunctionBegin;
  PetscCall(PetscObjectReference((PetscObject)W));
  b->W = W;
  PetscCall(BodiesCreateMatrices(b));
  PetscCall(MatCreateVecs(b->RW, &b->on_W, &b->rows));
  PetscCall(VecDuplicate(b->on_W, &b->dw0));
  PetscCall(VecDuplicate(b->on_W, &b->load));
  PetscCall(VecGetLocalSize(b->on_W, &nw));
  PetscCall(BodiesCreateCoupling(b));
  PetscCall(PetscMalloc6((size_t)nw * (size_t)max, &b->X, max * max, &b->schur, max * max, &b->factors, max, &b->dy,
    max, &b->loads, max, &b->pivots));
  PetscFunctionReturn(0);
}

/* Computes y = R^T f, or y += R^T f */
PetscErrorCode BodiesSpread(SubspaceBodies b, const PetscReal f[], PetscBool add, Vec y)
{
  PetscScalar *a;
  PetscInt     n;

  PetscFunctionBegin;
  PetscCall(VecGetLocalSize(b->rows, &n));
  PetscCall(VecGetArrayWrite(b->rows, &a));
  PetscCall(PetscArraycpy(a, f, n));
  PetscCall(VecRestoreArrayWrite(b->rows, &a));
  if (add) PetscCall(MatMultTransposeAdd(b->R, b->rows, y, y));
  else PetscCall(MatMultTranspose(b->R, b->rows, y));
  PetscFunctionReturn(0);
}

/* Returns the largest entry of v, where each is divided by the square root of K's diagonal entry */
PetscErrorCode BodiesSize(SubspaceBodies b, Vec v, PetscReal *size)
{
  const PetscScalar *a, *d;
  PetscInt           n;
  PetscReal          largest  = 0.0;
  const Vec          diagonal = ((TAO_IPFILTER *)b->tao->data)->stiff->hdiag;

  PetscFunctionBegin;
  PetscCall(VecGetLocalSize(v, &n));
  PetscCall(VecGetArrayRead(v, &a));
  PetscCall(VecGetArrayRead(diagonal, &d));
  for (PetscInt i = 0; i < n; i++)
    if (PetscAbsScalar(d[i]) > 0.0) largest = PetscMax(largest, PetscSqr(PetscAbsScalar(a[i])) / PetscAbsScalar(d[i]));
  PetscCall(VecRestoreArrayRead(diagonal, &d));
  PetscCall(VecRestoreArrayRead(v, &a));
  PetscCallMPI(MPI_Allreduce(&largest, size, 1, MPIU_REAL, MPIU_MAX, PetscObjectComm((PetscObject)v)));
  *size = PetscSqrtReal(*size);
  PetscFunctionReturn(0);
}
