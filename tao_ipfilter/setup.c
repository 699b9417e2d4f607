/* Memory: vectors of the problem's sizes, made in TaoSetUp(), made anew when the sizes change, and freed. */
#include "ipfilterimpl.h"

static PetscErrorCode DuplicateAfresh(Vec layout, Vec *v)
{
  PetscFunctionBegin;
  PetscCall(VecDestroy(v));
  PetscCall(VecDuplicate(layout, v));
  PetscCall(VecSet(*v, 0.0));
  PetscFunctionReturn(0);
}

static PetscErrorCode SetUpInequalities(Tao tao)
{
  TAO_IPFILTER *ip   = (TAO_IPFILTER *)tao->data;
  MPI_Comm      comm = PetscObjectComm((PetscObject)tao);
  Vec           c    = tao->constraints_inequality;

  PetscFunctionBegin;
  PetscCheck(!tao->IU, comm, PETSC_ERR_SUP, "TAOIPFILTER takes no upper bounds of inequality constraints: state c_I(x) <= u as u - c_I(x) >= 0");
  PetscCall(VecGetSize(c, &ip->mi));
  PetscCall(DuplicateAfresh(c, &tao->DI));
  if (!ip->mi) PetscFunctionReturn(0);
  PetscCheck(tao->jacobian_inequality, comm, PETSC_ERR_ARG_WRONGSTATE, "Must call TaoSetJacobianInequalityRoutine() before TaoSolve()");
  if (ip->given.slack_mass) {
    PetscInt n;

    PetscCall(VecGetSize(ip->given.slack_mass, &n));
    PetscCheck(n == ip->mi, comm, PETSC_ERR_ARG_SIZ, "Slack mass has %" PetscInt_FMT " entries for %" PetscInt_FMT " constraints", n, ip->mi);
  }
  PetscCall(DuplicateAfresh(c, &ip->rc));
  PetscCall(DuplicateAfresh(c, &ip->at.lambda));
  PetscCall(DuplicateAfresh(c, &ip->best.lambda));
  PetscCall(DuplicateAfresh(c, &ip->stiff.rho));
  PetscCall(IPPairCreate(c, ip->given.slack_mass, 1.0, &ip->pair[IP_SLACK]));
  PetscFunctionReturn(0);
}

static PetscErrorCode SetUpEqualities(Tao tao)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  Vec           c  = tao->constraints_equality;

  PetscFunctionBegin;
  PetscCall(VecGetSize(c, &ip->me));
  PetscCall(DuplicateAfresh(c, &tao->DE));
  if (!ip->me) PetscFunctionReturn(0);
  PetscCheck(tao->jacobian_equality, PetscObjectComm((PetscObject)tao), PETSC_ERR_ARG_WRONGSTATE, "Must call TaoSetJacobianEqualityRoutine() before TaoSolve()");
  PetscCall(DuplicateAfresh(c, &ip->at.y));
  PetscCall(DuplicateAfresh(c, &ip->best.y));
  PetscFunctionReturn(0);
}

/* All that has the sizes of the problem; what the caller gave and chose stays */
static PetscErrorCode FreeSizes(Tao tao)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  PetscCall(IPWorkDestroy(&ip->work));
  PetscCall(IPIterateDestroy(&ip->at));
  PetscCall(IPIterateDestroy(&ip->best));
  PetscCall(IPIterateDestroy(&ip->trial));
  PetscCall(IPDirectionDestroy(&ip->dir));
  for (PetscInt b = 0; b < IP_NPAIRS; b++) PetscCall(IPPairDestroy(&ip->pair[b]));
  PetscCall(VecDestroy(&ip->rx));
  PetscCall(VecDestroy(&ip->rc));
  PetscCall(VecDestroy(&ip->stiff.rho));
  PetscCall(VecDestroy(&ip->stiff.hdiag));
  PetscCall(VecDestroy(&ip->lin.residual));
  PetscCall(VecDestroy(&ip->rows.inequality));
  PetscCall(VecDestroy(&ip->rows.equality));
  PetscCall(IPCondensedDestroy(&ip->cond));
  PetscCall(IPJacobianDestroy(&ip->jac));
  PetscCall(IPHessianDestroy(&ip->hess));
  PetscCall(IPAugmentedDestroy(&ip->aug));
  PetscCall(IPDirectDestroy(&ip->direct));
  PetscCall(KSPDestroy(&ip->lin.flexible));
  PetscCall(ISDestroy(&ip->fixed));
  PetscFunctionReturn(0);
}

PetscErrorCode TaoSetUp_IPFilter(Tao tao)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  Vec           x  = tao->solution, c, ce;

  PetscFunctionBegin;
  PetscCall(FreeSizes(tao));
  ip->mi = ip->me = 0;
  if (!tao->gradient) PetscCall(VecDuplicate(x, &tao->gradient));
  if (tao->ineq_constrained) PetscCall(SetUpInequalities(tao));
  if (tao->eq_constrained) PetscCall(SetUpEqualities(tao));
  c  = ip->mi ? tao->constraints_inequality : NULL;
  ce = ip->me ? tao->constraints_equality : NULL;
  PetscCall(IPIterateCreate(NULL, c, ce, &ip->at));
  PetscCall(IPIterateCreate(x, NULL, NULL, &ip->best)); /* the constraints are evaluated anew on return to it */
  PetscCall(IPIterateCreate(x, c, ce, &ip->trial));
  PetscCall(IPDirectionCreate(x, c, ce, &ip->dir));
  PetscCall(DuplicateAfresh(x, &ip->rx));
  PetscCall(DuplicateAfresh(x, &ip->stiff.hdiag));
  PetscCall(DuplicateAfresh(x, &ip->lin.residual));
  if (!tao->hessian) PetscCall(IPDifferenceHessian(tao));
  PetscFunctionReturn(0);
}

/* Whether v, made in TaoSetUp(), still is laid out as its model; there is none where n is 0 */
static PetscErrorCode SameLayout(Vec v, Vec model, PetscInt n, PetscBool *same)
{
  PetscInt  size = 0, local[2] = {0, 0};
  PetscBool equal;

  PetscFunctionBegin;
  if (model) PetscCall(VecGetSize(model, &size));
  equal = (PetscBool)(size == n);
  if (equal && n) {
    PetscCall(VecGetLocalSize(v, &local[0]));
    PetscCall(VecGetLocalSize(model, &local[1]));
    equal = (PetscBool)(local[0] == local[1]);
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &equal, 1, MPI_PETSCBOOL, MPI_LAND, PetscObjectComm((PetscObject)model)));
  *same = (PetscBool)(*same && equal);
  PetscFunctionReturn(0);
}

/* Sets up again where the caller has replaced the solution or the constraints by others of another size since */
PetscErrorCode IPSetUpSizes(Tao tao)
{
  TAO_IPFILTER *ip   = (TAO_IPFILTER *)tao->data;
  PetscBool     same = PETSC_TRUE;
  PetscInt      n;

  PetscFunctionBegin;
  PetscCall(VecGetSize(ip->rx, &n));
  PetscCall(SameLayout(ip->rx, tao->solution, n, &same));
  if (tao->ineq_constrained) PetscCall(SameLayout(ip->at.c, tao->constraints_inequality, ip->mi, &same));
  if (tao->eq_constrained) PetscCall(SameLayout(ip->at.ce, tao->constraints_equality, ip->me, &same));
  if (same) PetscFunctionReturn(0);
  PetscCall(VecDestroy(&tao->gradient));
  PetscCall(KSPReset(tao->ksp));
  PetscCall(TaoSetUp_IPFilter(tao));
  PetscFunctionReturn(0);
}

PetscErrorCode TaoDestroy_IPFilter(Tao tao)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  PetscCall(FreeSizes(tao));
  PetscCall(VecDestroy(&ip->given.slack_mass));
  PetscCall(VecDestroy(&ip->given.primal_mass));
  PetscCall(VecDestroy(&ip->given.warm_s));
  PetscCall(VecDestroy(&ip->given.warm_z));
  PetscCall(IPFilterSetDestroy(&ip->filter));
  PetscCall(PetscFree(ip->rec.ksp_iterations));
  PetscCall(KSPDestroy(&tao->ksp));
  PetscCall(PetscFree(tao->data));
  PetscFunctionReturn(0);
}
