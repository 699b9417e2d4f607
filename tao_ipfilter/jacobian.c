/* The constraints' Jacobians as the iteration sees them: as AIJ, rows scaled, columns of fixed variables zeroed. */
#include "ipfilterimpl.h"

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

/* Takes over a Jacobian of the caller's, converted to AIJ if need be, unless it is as it was. A matrix of blocks or of products does not tell whether it
   is, nor does its conversion have a pattern of its own: zeros may be dropped. */
static PetscErrorCode JacobianTake(Tao tao, Mat user, Vec scale, Mat *converted, Mat *taken, IPStamp *stamp)
{
  PetscObjectState state;
  PetscBool        aij;
  Mat              J = user;

  PetscFunctionBegin;
  PetscCall(PetscObjectBaseTypeCompareAny((PetscObject)user, &aij, MATSEQAIJ, MATMPIAIJ, ""));
  if (!aij) {
    PetscCall(IPMatrixConvert(user, converted));
    J = *converted;
  }
  PetscCall(PetscObjectStateGet((PetscObject)J, &state));
  if (*taken && state == stamp->value_state && stamp->value_id == ((PetscObject)J)->id) PetscFunctionReturn(0);
  PetscCall(MatDestroy(taken));
  stamp->value_state = state;
  stamp->value_id = stamp->pattern_id = ((PetscObject)J)->id;
  PetscCall(MatGetNonzeroState(J, &stamp->pattern_state));
  PetscCall(JacobianScale(tao, J, scale, taken));
  PetscFunctionReturn(0);
}

PetscErrorCode IPJacobianEquality(Tao tao)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  PetscCall(JacobianTake(tao, tao->jacobian_equality, ip->rows.equality, &ip->jac.converted[1], &ip->jac.equality, &ip->jac.equality_stamp));
  PetscFunctionReturn(0);
}

PetscErrorCode IPJacobianInequality(Tao tao)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  PetscCall(JacobianTake(tao, tao->jacobian_inequality, ip->rows.inequality, &ip->jac.converted[0], &ip->jac.inequality, &ip->jac.inequality_stamp));
  PetscFunctionReturn(0);
}
