/* Shared by the tests of TAOIPFILTER: a sum of functions of one unknown each, as a part of an objective */
#ifndef IPFILTER_SEPARABLE_H
#define IPFILTER_SEPARABLE_H

#include <petscmat.h>

/* Value and two derivatives of the function of unknown i at x */
typedef void (*SeparableTerm)(const void *ctx, PetscInt i, PetscReal x, PetscReal *f, PetscReal *g, PetscReal *h);

/* Adds to the objective and to its gradient */
static inline PetscErrorCode SeparableAddGradient(SeparableTerm term, const void *ctx, Vec x, PetscReal *f, Vec g)
{
  const PetscScalar *xa;
  PetscScalar       *ga;
  PetscReal          local = 0.0, sum;
  PetscInt           lo, hi;

  PetscFunctionBeginUser;
  PetscCall(VecGetOwnershipRange(x, &lo, &hi));
  PetscCall(VecGetArrayRead(x, &xa));
  PetscCall(VecGetArray(g, &ga));
  for (PetscInt i = lo; i < hi; i++) {
    PetscReal value, slope, curvature;

    term(ctx, i, PetscRealPart(xa[i - lo]), &value, &slope, &curvature);
    local += value;
    ga[i - lo] += slope;
  }
  PetscCall(VecRestoreArray(g, &ga));
  PetscCall(VecRestoreArrayRead(x, &xa));
  PetscCallMPI(MPI_Allreduce(&local, &sum, 1, MPIU_REAL, MPIU_SUM, PetscObjectComm((PetscObject)x)));
  *f += sum;
  PetscFunctionReturn(0);
}

/* Adds to the diagonal of the Hessian */
static inline PetscErrorCode SeparableAddHessian(SeparableTerm term, const void *ctx, Vec x, Mat H)
{
  const PetscScalar *xa;
  PetscInt           lo, hi;

  PetscFunctionBeginUser;
  PetscCall(VecGetOwnershipRange(x, &lo, &hi));
  PetscCall(VecGetArrayRead(x, &xa));
  for (PetscInt i = lo; i < hi; i++) {
    PetscReal f, g, h;

    term(ctx, i, PetscRealPart(xa[i - lo]), &f, &g, &h);
    PetscCall(MatSetValue(H, i, i, h, ADD_VALUES));
  }
  PetscCall(VecRestoreArrayRead(x, &xa));
  PetscCall(MatAssemblyBegin(H, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(H, MAT_FINAL_ASSEMBLY));
  PetscFunctionReturn(0);
}

#endif
