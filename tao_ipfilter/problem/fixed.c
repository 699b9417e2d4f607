/*
   Fixed variables, x_l = x_u, keep their value and are removed from the linear system. They have neither a barrier term
   nor a multiplier.
*/
#include "problemimpl.h"
#include "tao_ipfilter/solver/stiffness.h"

/* Returns whether a variable with these bounds is fixed */
PetscBool IPIsFixed(PetscScalar lower, PetscScalar upper)
{
  return (PetscBool)(lower == upper && PetscAbsScalar(lower) < PETSC_INFINITY);
}

/* Raises an error on all ranks for the variable of smallest index whose bounds leave no number between them */
static PetscErrorCode CheckBounds(Tao tao, const PetscScalar l[], const PetscScalar u[])
{
  MPI_Comm  comm      = PetscObjectComm((PetscObject)tao);
  PetscInt  first     = PETSC_MAX_INT, worst, rstart, rend;
  PetscReal bounds[2] = {PETSC_NINFINITY, PETSC_NINFINITY};

  PetscFunctionBegin;
  PetscCall(VecGetOwnershipRange(tao->solution, &rstart, &rend));
  for (PetscInt i = rend - 1; i >= rstart; i--) {
    if (PetscRealPart(l[i - rstart]) > PetscRealPart(u[i - rstart]) || PetscIsNanScalar(l[i - rstart]) ||
        PetscIsNanScalar(u[i - rstart]) || PetscRealPart(l[i - rstart]) >= PETSC_INFINITY ||
        PetscRealPart(u[i - rstart]) <= PETSC_NINFINITY)
      first = i;
  }
  PetscCallMPI(MPI_Allreduce(&first, &worst, 1, MPIU_INT, MPI_MIN, comm));
  if (worst == PETSC_MAX_INT) PetscFunctionReturn(0);
  if (worst >= rstart && worst < rend) {
    bounds[0] = PetscRealPart(l[worst - rstart]);
    bounds[1] = PetscRealPart(u[worst - rstart]);
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, bounds, 2, MPIU_REAL, MPI_MAX, comm));
  SETERRQ(comm, PETSC_ERR_ARG_OUTOFRANGE,
    "Variable %" PetscInt_FMT " has lower bound %g and upper bound %g: there is no number between them", worst,
    (double)bounds[0], (double)bounds[1]);
}

/*
   Sets x to its fixed values and creates the index set of this rank's fixed variables; NULL if no rank has one.
   *changed: the set differs from that of the last solve.
*/
PetscErrorCode IPFixedSetUp(Tao tao, PetscBool *changed)
{
  TAO_IPFILTER      *ip = (TAO_IPFILTER *)tao->data;
  const PetscScalar *l, *u;
  PetscScalar       *x;
  PetscInt           n, rstart, count = 0, total, *idx;
  PetscBool          same  = PETSC_FALSE;
  IS                 fixed = NULL;

  PetscFunctionBegin;
  if (tao->XL && tao->XU) {
    PetscCall(VecGetLocalSize(tao->solution, &n));
    PetscCall(VecGetOwnershipRange(tao->solution, &rstart, NULL));
    PetscCall(VecGetArrayRead(tao->XL, &l));
    PetscCall(VecGetArrayRead(tao->XU, &u));
    PetscCall(CheckBounds(tao, l, u));
    PetscCall(VecGetArray(tao->solution, &x));
    PetscCall(PetscMalloc1(n, &idx));
    for (PetscInt i = 0; i < n; i++) {
      if (!IPIsFixed(l[i], u[i])) continue;
      x[i]         = l[i];
      idx[count++] = rstart + i;
    }
    PetscCall(VecRestoreArray(tao->solution, &x));
    PetscCall(VecRestoreArrayRead(tao->XU, &u));
    PetscCall(VecRestoreArrayRead(tao->XL, &l));
    PetscCallMPI(MPI_Allreduce(&count, &total, 1, MPIU_INT, MPI_SUM, PetscObjectComm((PetscObject)tao)));
    if (total) PetscCall(ISCreateGeneral(PetscObjectComm((PetscObject)tao), count, idx, PETSC_COPY_VALUES, &fixed));
    PetscCall(PetscFree(idx));
  }
  if (fixed && ip->fixed) PetscCall(ISEqual(fixed, ip->fixed, &same));
  *changed = (PetscBool)(!same && (fixed || ip->fixed));
  PetscCall(ISDestroy(&ip->fixed));
  ip->fixed = fixed;
  PetscFunctionReturn(0);
}

/* Sets the entries of fixed variables in v to zero */
PetscErrorCode IPFixedZero(Tao tao, Vec v)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  if (ip->fixed) PetscCall(VecISSet(v, ip->fixed, 0.0));
  PetscFunctionReturn(0);
}

/*
   Removes the fixed variables from A: their rows and columns become zero, and their diagonal entries a typical diagonal
   entry of the Hessian
*/
PetscErrorCode IPFixedMatrix(Tao tao, Mat A)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  PetscBool     sbaij;

  PetscFunctionBegin;
  if (!ip->fixed) PetscFunctionReturn(0);
  PetscCall(PetscObjectTypeCompare((PetscObject)A, MATMPISBAIJ, &sbaij));
  PetscCheck(!sbaij, PetscObjectComm((PetscObject)tao), PETSC_ERR_SUP,
    "Variables with equal bounds need a Hessian of type AIJ or BAIJ on more than one rank, not SBAIJ");
  PetscCall(MatSetOption(A, MAT_KEEP_NONZERO_PATTERN, PETSC_TRUE));
  PetscCall(MatZeroRowsColumnsIS(A, ip->fixed, ip->stiff->hscale, NULL, NULL));
  PetscFunctionReturn(0);
}
