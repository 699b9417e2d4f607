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

/* Takes over the equality Jacobian at tao->solution */
PetscErrorCode IPJacobianEquality(Tao tao)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  Mat           J;

  PetscFunctionBegin;
  PetscCall(MatDestroy(&ip->jac.equality));
  PetscCall(JacobianTakeAIJ(tao->jacobian_equality, &J));
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

  PetscFunctionBegin;
  PetscCall(PetscObjectStateGet((PetscObject)user, &state));
  if (jac->inequality && state == jac->user_state && jac->user_id == ((PetscObject)user)->id) PetscFunctionReturn(0);
  PetscCall(MatDestroy(&jac->inequality));
  PetscCall(JacobianTakeAIJ(user, &J));
  jac->user_state = state;
  jac->user_id    = ((PetscObject)user)->id;
  jac->pattern_id = ((PetscObject)J)->id;
  PetscCall(MatGetNonzeroState(J, &jac->pattern_state));
  PetscCall(JacobianScale(tao, J, ip->rows.inequality, &jac->inequality));
  PetscCall(MatDestroy(&J));
  PetscFunctionReturn(0);
}
