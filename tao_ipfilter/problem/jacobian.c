/*
   The constraint Jacobians used by the iteration: in AIJ format, with scaled rows and zero columns for fixed variables
*/
#include "problemimpl.h"
#include "tao_ipfilter/solver/matrices.h"
#include "tao_ipfilter/solver/rows.h"

PetscErrorCode IPJacobianDestroy(IPJacobian *jac)
{
  PetscFunctionBegin;
  PetscCall(MatDestroy(&jac->inequality));
  PetscCall(MatDestroy(&jac->equality));
  PetscCall(MatDestroy(&jac->converted[0]));
  PetscCall(MatDestroy(&jac->converted[1]));
  PetscCall(PetscMemzero(jac, sizeof(*jac)));
  PetscFunctionReturn(0);
}

/*
   Creates a copy of J with scaled rows and zero columns for fixed variables. If neither applies, *scaled is a reference
   to J.
*/
static PetscErrorCode JacobianScale(Tao tao, Mat J, Vec scale, Mat *scaled)
{
  Vec mask;

  PetscFunctionBegin;
  if (!scale && !((TAO_IPFILTER *)tao->data)->fixed) {
    PetscCall(PetscObjectReference((PetscObject)J));
    *scaled = J;
    PetscFunctionReturn(0);
  }
  PetscCall(MatDuplicate(J, MAT_COPY_VALUES, scaled));
  PetscCall(IPGetWork(tao, IP_UNKNOWNS, &mask));
  PetscCall(VecSet(mask, 1.0));
  PetscCall(IPFixedZero(tao, mask));
  PetscCall(MatDiagonalScale(*scaled, scale, mask));
  PetscCall(IPRestoreWork(tao, IP_UNKNOWNS, &mask));
  PetscFunctionReturn(0);
}

/*
   Gets a Jacobian of the caller in AIJ format: the matrix itself, or *converted. `converted` may be NULL if the matrix
   is AIJ.
*/
static PetscErrorCode JacobianAsAIJ(Mat user, Mat *converted, Mat *J)
{
  PetscBool aij;

  PetscFunctionBegin;
  PetscCall(PetscObjectBaseTypeCompareAny((PetscObject)user, &aij, MATSEQAIJ, MATMPIAIJ, ""));
  if (aij && converted) PetscCall(MatDestroy(converted));
  if (!aij) PetscCall(IPMatrixConvert(user, converted));
  *J = aij ? user : *converted;
  PetscFunctionReturn(0);
}

/*
   Updates *taken, the scaled form of a Jacobian of the caller, unless the Jacobian is unchanged. Nested and shell
   matrices do not tell whether they changed, and their conversion may drop zeros, so that its nonzero pattern may
   change as well.
*/
static PetscErrorCode JacobianTake(Tao tao, Mat user, Vec scale, Mat *converted, Mat *taken, IPStamp *stamp)
{
  PetscObjectState state;
  Mat              J;

  PetscFunctionBegin;
  PetscCall(JacobianAsAIJ(user, converted, &J));
  PetscCall(PetscObjectStateGet((PetscObject)J, &state));
  if (*taken && state == stamp->value_state && stamp->value_id == ((PetscObject)J)->id) PetscFunctionReturn(0);
  PetscCall(MatDestroy(taken));
  stamp->value_state = state;
  stamp->value_id = stamp->pattern_id = ((PetscObject)J)->id;
  PetscCall(MatGetNonzeroState(J, &stamp->pattern_state));
  PetscCall(JacobianScale(tao, J, scale, taken));
  PetscFunctionReturn(0);
}

/*
   Copies n local rows of a matrix, or its first n rows if `rows` is NULL, into consecutive rows of `to` starting at row
   `at`. rows: numbers from the rank's first row.
*/
static PetscErrorCode JacobianCopyRows(Mat from, PetscInt n, const PetscInt rows[], Mat to, PetscInt at)
{
  PetscInt rstart;

  PetscFunctionBegin;
  PetscCall(MatGetOwnershipRange(from, &rstart, NULL));
  for (PetscInt k = 0; k < n; k++) {
    const PetscInt     row = rstart + (rows ? rows[k] : k), target = at + k;
    const PetscInt    *columns;
    const PetscScalar *values;
    PetscInt           nc;

    PetscCall(MatGetRow(from, row, &nc, &columns, &values));
    PetscCall(MatSetValues(to, 1, &target, nc, columns, values, INSERT_VALUES));
    PetscCall(MatRestoreRow(from, row, &nc, &columns, &values));
  }
  PetscFunctionReturn(0);
}

/* Raises *longest to the number of entries of the longest row on this rank */
static PetscErrorCode JacobianLongestRow(Mat J, PetscInt *longest)
{
  PetscInt rstart, rend;

  PetscFunctionBegin;
  PetscCall(MatGetOwnershipRange(J, &rstart, &rend));
  for (PetscInt i = rstart; i < rend; i++) {
    PetscInt nc;

    PetscCall(MatGetRow(J, i, &nc, NULL, NULL));
    *longest = PetscMax(*longest, nc);
    PetscCall(MatRestoreRow(J, i, &nc, NULL, NULL));
  }
  PetscFunctionReturn(0);
}

/*
   Creates the Jacobian of all equality constraints. On each rank it consists of the caller's equality Jacobian `own`,
   which may be NULL, followed by the rows of the inequality Jacobian `all` that have equal bounds.
*/
static PetscErrorCode JacobianStack(Tao tao, Mat own, Mat all, Mat *stack)
{
  TAO_IPFILTER  *ip    = (TAO_IPFILTER *)tao->data;
  const IPSides *sides = ip->sides;
  PetscInt       nown = 0, m, n, rstart, longest = 0;

  PetscFunctionBegin;
  if (own) PetscCall(MatGetLocalSize(own, &nown, NULL));
  if (own) PetscCall(JacobianLongestRow(own, &longest));
  PetscCall(JacobianLongestRow(all, &longest));
  PetscCall(VecGetLocalSize(ip->at.ce, &m));
  PetscCall(VecGetLocalSize(tao->solution, &n));
  PetscCall(MatCreateAIJ(PetscObjectComm((PetscObject)tao), m, n, PETSC_DETERMINE, PETSC_DETERMINE,
    PetscMin(longest, n), NULL, longest, NULL, stack));
  PetscCall(MatSetOption(*stack, MAT_NO_OFF_PROC_ENTRIES, PETSC_TRUE));
  PetscCall(MatGetOwnershipRange(*stack, &rstart, NULL));
  if (own) PetscCall(JacobianCopyRows(own, nown, NULL, *stack, rstart));
  PetscCall(JacobianCopyRows(all, sides->nequal, sides->equal, *stack, rstart + nown));
  PetscCall(MatAssemblyBegin(*stack, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(*stack, MAT_FINAL_ASSEMBLY));
  PetscFunctionReturn(0);
}

/*
   Updates the Jacobian of all equality constraints if some inequality rows have equal bounds. IPJacobianInequality()
   must have been called before.
*/
static PetscErrorCode JacobianTakeStack(Tao tao)
{
  TAO_IPFILTER *ip  = (TAO_IPFILTER *)tao->data;
  IPJacobian   *jac = ip->jac;
  Mat           own = NULL, fresh, converted = NULL;

  PetscFunctionBegin;
  if (ip->me > ip->sides->nall) PetscCall(JacobianAsAIJ(tao->jacobian_equality, &converted, &own));
  PetscCall(JacobianStack(tao, own, jac->converted[0] ? jac->converted[0] : tao->jacobian_inequality, &fresh));
  PetscCall(IPMatrixKeep(&fresh, &jac->converted[1]));
  PetscCall(MatDestroy(&converted));
  PetscCall(JacobianTake(tao, jac->converted[1], ip->rows->equality, NULL, &jac->equality, &jac->equality_stamp));
  PetscFunctionReturn(0);
}

/* Updates the equality Jacobian at tao->solution. Must be called after IPJacobianInequality(). */
PetscErrorCode IPJacobianEquality(Tao tao)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  if (ip->sides->nall) PetscCall(JacobianTakeStack(tao));
  else
    PetscCall(JacobianTake(tao, tao->jacobian_equality, ip->rows->equality, &ip->jac->converted[1], &ip->jac->equality,
      &ip->jac->equality_stamp));
  PetscFunctionReturn(0);
}

PetscErrorCode IPJacobianInequality(Tao tao)
{
  TAO_IPFILTER *ip    = (TAO_IPFILTER *)tao->data;
  Vec           scale = NULL;

  PetscFunctionBegin;
  if (ip->sides->sign) {
    PetscCall(IPGetWork(tao, IP_INEQUALITIES, &scale));
    if (ip->rows->inequality) PetscCall(VecPointwiseMult(scale, ip->sides->sign, ip->rows->inequality));
    else PetscCall(VecCopy(ip->sides->sign, scale));
  }
  PetscCall(JacobianTake(tao, tao->jacobian_inequality, scale ? scale : ip->rows->inequality, &ip->jac->converted[0],
    &ip->jac->inequality, &ip->jac->inequality_stamp));
  if (scale) PetscCall(IPRestoreWork(tao, IP_INEQUALITIES, &scale));
  PetscFunctionReturn(0);
}
