/* The constraints' Jacobians as the iteration sees them: as AIJ, rows scaled, columns of fixed variables zeroed. */
#include "ipfilterimpl.h"

PetscErrorCode IPJacobianDestroy(IPJacobian *jac)
{
  PetscFunctionBegin;
  PetscCall(MatDestroy(&jac->inequality));
  PetscCall(MatDestroy(&jac->equality));
  PetscCall(PetscMemzero(jac, sizeof(*jac)));
  PetscFunctionReturn(0);
}

/* A copy with rows scaled and the columns of fixed variables zeroed, or the Jacobian itself where nothing is to be done */
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

/* A Jacobian as AIJ: itself, or converted */
static PetscErrorCode JacobianTakeAIJ(Mat user, Mat *J)
{
  PetscBool aij;

  PetscFunctionBegin;
  PetscCall(PetscObjectBaseTypeCompareAny((PetscObject)user, &aij, MATSEQAIJ, MATMPIAIJ, ""));
  if (aij) {
    PetscCall(PetscObjectReference((PetscObject)user));
    *J = user;
  } else PetscCall(MatConvert(user, MATAIJ, MAT_INITIAL_MATRIX, J));
  PetscFunctionReturn(0);
}

/* Rows of a matrix of this rank, by their numbers from its first one, or all of them: into another one from the row at on */
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

/* Longest row of this rank */
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

/* The caller's equality Jacobian, if it has one, with the rows of the inequality Jacobian that have equal bounds behind it on each rank */
static PetscErrorCode JacobianStack(Tao tao, Mat own, Mat *stack)
{
  TAO_IPFILTER  *ip    = (TAO_IPFILTER *)tao->data;
  const IPSides *sides = &ip->sides;
  PetscInt       nown = 0, m, n, rstart, longest = 0;
  Mat            rows;

  PetscFunctionBegin;
  PetscCall(JacobianTakeAIJ(tao->jacobian_inequality, &rows));
  if (own) PetscCall(MatGetLocalSize(own, &nown, NULL));
  if (own) PetscCall(JacobianLongestRow(own, &longest));
  PetscCall(JacobianLongestRow(rows, &longest));
  PetscCall(VecGetLocalSize(ip->at.ce, &m));
  PetscCall(VecGetLocalSize(tao->solution, &n));
  PetscCall(MatCreateAIJ(PetscObjectComm((PetscObject)tao), m, n, PETSC_DETERMINE, PETSC_DETERMINE, PetscMin(longest, n), NULL, longest, NULL, stack));
  PetscCall(MatSetOption(*stack, MAT_NO_OFF_PROC_ENTRIES, PETSC_TRUE));
  PetscCall(MatGetOwnershipRange(*stack, &rstart, NULL));
  if (own) PetscCall(JacobianCopyRows(own, nown, NULL, *stack, rstart));
  PetscCall(JacobianCopyRows(rows, sides->nequal, sides->equal, *stack, rstart + nown));
  PetscCall(MatAssemblyBegin(*stack, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(*stack, MAT_FINAL_ASSEMBLY));
  PetscCall(MatDestroy(&rows));
  PetscFunctionReturn(0);
}

/* Takes over the equality Jacobian at tao->solution */
PetscErrorCode IPJacobianEquality(Tao tao)
{
  TAO_IPFILTER *ip  = (TAO_IPFILTER *)tao->data;
  Mat           own = NULL, J;

  PetscFunctionBegin;
  PetscCall(MatDestroy(&ip->jac.equality));
  if (ip->me > ip->sides.nall) PetscCall(JacobianTakeAIJ(tao->jacobian_equality, &own));
  if (ip->sides.nall) {
    PetscCall(JacobianStack(tao, own, &J));
    PetscCall(MatDestroy(&own));
  } else J = own;
  PetscCall(JacobianScale(tao, J, ip->rows.equality, &ip->jac.equality));
  PetscCall(MatDestroy(&J));
  PetscFunctionReturn(0);
}

/* Takes over the inequality Jacobian, unless it is as it was. The stamp of its pattern is the caller's matrix's, or that of what it was
   converted to: a conversion may drop zeros, so that the pattern follows the values. */
PetscErrorCode IPJacobianInequality(Tao tao)
{
  TAO_IPFILTER    *ip   = (TAO_IPFILTER *)tao->data;
  IPJacobian      *jac  = &ip->jac;
  Mat              user = tao->jacobian_inequality, J;
  PetscObjectState state;
  Vec              scale;

  PetscFunctionBegin;
  PetscCall(PetscObjectStateGet((PetscObject)user, &state));
  if (jac->inequality && state == jac->user_state && jac->user_id == ((PetscObject)user)->id) PetscFunctionReturn(0);
  PetscCall(MatDestroy(&jac->inequality));
  PetscCall(JacobianTakeAIJ(user, &J));
  jac->user_state = state;
  jac->user_id    = ((PetscObject)user)->id;
  jac->pattern_id = ((PetscObject)J)->id;
  PetscCall(MatGetNonzeroState(J, &jac->pattern_state));
  if (ip->sides.sign) {
    PetscCall(IPGetWork(tao, IP_INEQUALITIES, &scale));
    if (ip->rows.inequality) PetscCall(VecPointwiseMult(scale, ip->sides.sign, ip->rows.inequality));
    else PetscCall(VecCopy(ip->sides.sign, scale));
    PetscCall(JacobianScale(tao, J, scale, &jac->inequality));
    PetscCall(IPRestoreWork(tao, IP_INEQUALITIES, &scale));
  } else PetscCall(JacobianScale(tao, J, ip->rows.inequality, &jac->inequality));
  PetscCall(MatDestroy(&J));
  PetscFunctionReturn(0);
}
