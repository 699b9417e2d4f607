/*
   Creates the vectors with the problem's sizes in TaoSetUp(), creates them anew if the sizes change, and destroys them
*/
#include "driverimpl.h"
#include "tao_ipfilter/solver/linear.h"
#include "tao_ipfilter/solver/method.h"
#include "tao_ipfilter/solver/options.h"
#include "tao_ipfilter/solver/record.h"
#include "tao_ipfilter/solver/rows.h"
#include "tao_ipfilter/solver/search.h"
#include "tao_ipfilter/solver/stiffness.h"

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
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  Vec           c  = tao->constraints_inequality;

  PetscFunctionBegin;
  PetscCall(VecGetSize(c, &ip->mi));
  PetscCall(DuplicateAfresh(c, &tao->DI));
  if (!ip->mi) PetscFunctionReturn(0);
  PetscCheck(tao->jacobian_inequality, PetscObjectComm((PetscObject)tao), PETSC_ERR_ARG_WRONGSTATE,
    "Must call TaoSetJacobianInequalityRoutine() before TaoSolve()");
  PetscCall(DuplicateAfresh(c, &ip->rc));
  PetscCall(DuplicateAfresh(c, &ip->at.lambda));
  PetscCall(DuplicateAfresh(c, &ip->best.lambda));
  PetscCall(DuplicateAfresh(c, &ip->stiff->rho));
  PetscCall(IPPairCreate(c, ip->given->slack_mass, 1.0, &ip->pair[IP_SLACK]));
  PetscFunctionReturn(0);
}

/*
   Counts the equality constraints, which on each rank are the caller's own ones followed by the rows of c_I with equal
   bounds, and creates their multipliers. *layout: a vector with an entry per constraint; NULL if there are none.
*/
static PetscErrorCode SetUpEqualities(Tao tao, Vec *layout)
{
  TAO_IPFILTER *ip  = (TAO_IPFILTER *)tao->data;
  PetscInt      own = 0, local = 0;

  PetscFunctionBegin;
  *layout = NULL;
  if (tao->eq_constrained) {
    PetscCall(VecGetSize(tao->constraints_equality, &own));
    PetscCall(VecGetLocalSize(tao->constraints_equality, &local));
    PetscCall(DuplicateAfresh(tao->constraints_equality, &tao->DE));
  }
  ip->me = own + ip->sides->nall;
  if (!ip->me) PetscFunctionReturn(0);
  PetscCheck(!own || tao->jacobian_equality, PetscObjectComm((PetscObject)tao), PETSC_ERR_ARG_WRONGSTATE,
    "Must call TaoSetJacobianEqualityRoutine() before TaoSolve()");
  PetscCall(VecCreate(PetscObjectComm((PetscObject)tao), layout));
  PetscCall(VecSetSizes(*layout, local + ip->sides->nequal, PETSC_DETERMINE));
  PetscCall(VecSetType(*layout, VECSTANDARD));
  PetscCall(DuplicateAfresh(*layout, &ip->at.y));
  PetscCall(DuplicateAfresh(*layout, &ip->best.y));
  PetscFunctionReturn(0);
}

/* Destroys all data that depend on the problem's sizes, but not what the caller has set */
static PetscErrorCode FreeSizes(Tao tao)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  PetscCall(IPWorkDestroy(ip->work));
  PetscCall(IPIterateDestroy(&ip->at));
  PetscCall(IPIterateDestroy(&ip->best));
  PetscCall(IPIterateDestroy(&ip->trial));
  PetscCall(IPDirectionDestroy(&ip->dir));
  for (PetscInt b = 0; b < IP_NPAIRS; b++) PetscCall(IPPairDestroy(&ip->pair[b]));
  PetscCall(VecDestroy(&ip->rx));
  PetscCall(VecDestroy(&ip->rc));
  PetscCall(VecDestroy(&ip->stiff->rho));
  PetscCall(VecDestroy(&ip->stiff->reach));
  PetscCall(VecDestroy(&ip->stiff->equality_rows));
  PetscCall(VecDestroy(&ip->stiff->hdiag));
  PetscCall(VecDestroy(&ip->search->slow));
  PetscCall(VecDestroy(&ip->lin->residual));
  PetscCall(VecDestroy(&ip->rows->inequality));
  PetscCall(VecDestroy(&ip->rows->equality));
  PetscCall(IPCondensedDestroy(ip->cond));
  PetscCall(IPJacobianDestroy(ip->jac));
  PetscCall(IPHessianDestroy(ip->hess));
  PetscCall(IPAugmentedDestroy(ip->aug));
  PetscCall(IPDirectDestroy(ip->direct));
  if (ip->method->on) PetscCall(ip->method->ops->end(tao));
  ip->method->on = PETSC_FALSE;
  PetscCall(KSPDestroy(&ip->lin->flexible));
  PetscCall(ISDestroy(&ip->fixed));
  PetscCall(IPSidesDestroy(ip->sides));
  PetscFunctionReturn(0);
}

/*
   Chooses finite differences of gradients if TaoSetHessian() was not called. Their matrix is created anew if the sizes
   change.
*/
static PetscErrorCode SetUpHessian(Tao tao)
{
  const PetscInt large = 1000;
  PetscBool      differences;
  PetscInt       n;

  PetscFunctionBegin;
  PetscCall(IPDifferenceInUse(tao, &differences));
  if (tao->hessian && !differences) PetscFunctionReturn(0);
  PetscCall(VecGetSize(tao->solution, &n));
  PetscCheck(n <= large, PetscObjectComm((PetscObject)tao), PETSC_ERR_ARG_WRONGSTATE,
    "TAOIPFILTER needs TaoSetHessian() for a problem with %" PetscInt_FMT
    " unknowns: it computes a Hessian by differences only up to %" PetscInt_FMT " unknowns",
    n, large);
  PetscCall(IPDifferenceHessian(tao));
  PetscFunctionReturn(0);
}

PetscErrorCode TaoSetUp_IPFilter(Tao tao)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  Vec           x  = tao->solution, c, ce;

  PetscFunctionBegin;
  PetscCall(IPGivenCheck(tao));
  PetscCall(FreeSizes(tao));
  ip->mi = ip->me = 0;
  if (!tao->gradient) PetscCall(VecDuplicate(x, &tao->gradient));
  if (tao->ineq_constrained) PetscCall(SetUpInequalities(tao));
  PetscCall(IPSidesSetUp(tao));
  PetscCall(SetUpEqualities(tao, &ce));
  c = ip->mi ? tao->constraints_inequality : NULL;
  PetscCall(IPIterateCreate(NULL, c, ce, &ip->at));
  PetscCall(VecDestroy(&ce));
  PetscCall(DuplicateAfresh(x, &ip->rx));
  PetscCall(DuplicateAfresh(x, &ip->stiff->hdiag));
  PetscCall(DuplicateAfresh(x, &ip->search->slow));
  PetscCall(SetUpHessian(tao));
  PetscFunctionReturn(0);
}

/*
   Creates the vectors that the iteration needs. They are created as late as possible, since the set-up of AMG before
   the first iterate needs the most memory.
*/
PetscErrorCode IPSetUpIteration(Tao tao)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  Vec           x = tao->solution, c = ip->at.c, ce = ip->at.ce;

  PetscFunctionBegin;
  if (ip->dir.x) PetscFunctionReturn(0);
  PetscCall(IPIterateCreate(x, NULL, NULL, &ip->best)); /* constraint values are not stored; they are evaluated again
                                                           if the iteration returns to the best iterate */
  PetscCall(IPIterateCreate(x, c, ce, &ip->trial));
  PetscCall(IPDirectionCreate(x, c, ce, &ip->dir));
  PetscCall(DuplicateAfresh(x, &ip->lin->residual));
  PetscFunctionReturn(0);
}

/* Sets *all to false unless `here` holds on all ranks */
static PetscErrorCode OnAllRanks(Tao tao, PetscBool here, PetscBool *all)
{
  PetscFunctionBegin;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &here, 1, MPI_PETSCBOOL, MPI_LAND, PetscObjectComm((PetscObject)tao)));
  *all = (PetscBool)(*all && here);
  PetscFunctionReturn(0);
}

/*
   Sets *same to false unless v, created in TaoSetUp(), has as many local entries as `model` plus `more`, on all ranks.
   v and model may be NULL for no entries.
*/
static PetscErrorCode SameLayout(Tao tao, Vec v, Vec model, PetscInt more, PetscBool *same)
{
  PetscInt local[2] = {0, 0};

  PetscFunctionBegin;
  if (v) PetscCall(VecGetLocalSize(v, &local[0]));
  if (model) PetscCall(VecGetLocalSize(model, &local[1]));
  PetscCall(OnAllRanks(tao, (PetscBool)(local[0] == local[1] + more), same));
  PetscFunctionReturn(0);
}

/*
   Classifies the rows of c_I by their present bounds. If any row is or was not of the form c >= 0, data derived from
   the Jacobian are destroyed.
*/
static PetscErrorCode SetUpSides(Tao tao)
{
  TAO_IPFILTER *ip  = (TAO_IPFILTER *)tao->data;
  PetscBool     had = (PetscBool)(ip->sides->sign != NULL);

  PetscFunctionBegin;
  PetscCall(IPSidesSetUp(tao));
  if (!had && !ip->sides->sign) PetscFunctionReturn(0);
  PetscCall(IPCondensedDestroy(ip->cond));
  PetscCall(IPJacobianDestroy(ip->jac));
  PetscFunctionReturn(0);
}

/*
   Resets the Krylov solver if its preconditioner was set up for another number of unknowns: it may be that of another
   solver, from TaoIPFilterSetSubspace()
*/
static PetscErrorCode FitPreconditioner(Tao tao)
{
  PC        pc;
  PetscBool set, fits = PETSC_TRUE;
  PetscInt  rows, n;
  Mat       A;

  PetscFunctionBegin;
  PetscCall(KSPGetPC(tao->ksp, &pc));
  PetscCall(PCGetOperatorsSet(pc, &set, NULL));
  if (!set) PetscFunctionReturn(0);
  PetscCall(PCGetOperators(pc, &A, NULL));
  PetscCall(MatGetLocalSize(A, &rows, NULL));
  PetscCall(VecGetLocalSize(tao->solution, &n));
  PetscCall(OnAllRanks(tao, (PetscBool)(rows == n), &fits));
  if (!fits) PetscCall(IPKSPReset(tao->ksp));
  PetscFunctionReturn(0);
}

/* Sets up the solver again if the caller has replaced the solution or the constraints by vectors of another size */
PetscErrorCode IPSetUpSizes(Tao tao)
{
  TAO_IPFILTER *ip   = (TAO_IPFILTER *)tao->data;
  PetscBool     same = PETSC_TRUE;

  PetscFunctionBegin;
  PetscCall(IPGivenCheck(tao));
  PetscCall(SetUpSides(tao));
  PetscCall(FitPreconditioner(tao));
  PetscCall(SameLayout(tao, ip->rx, tao->solution, 0, &same));
  PetscCall(SameLayout(tao, ip->at.c, tao->ineq_constrained ? tao->constraints_inequality : NULL, 0, &same));
  PetscCall(
    SameLayout(tao, ip->at.ce, tao->eq_constrained ? tao->constraints_equality : NULL, ip->sides->nequal, &same));
  if (same) PetscFunctionReturn(0);
  PetscCall(VecDestroy(&tao->gradient));
  PetscCall(IPKSPReset(tao->ksp));
  PetscCall(TaoSetUp_IPFilter(tao));
  PetscFunctionReturn(0);
}

PetscErrorCode TaoDestroy_IPFilter(Tao tao)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;

  PetscFunctionBegin;
  PetscCall(FreeSizes(tao));
  if (ip->method->ops) PetscCall(ip->method->ops->destroy(tao));
  PetscCall(VecDestroy(&ip->given->slack_mass));
  PetscCall(VecDestroy(&ip->given->primal_mass));
  PetscCall(VecDestroy(&ip->given->compliance));
  PetscCall(MatDestroy(&ip->given->modes));
  PetscCall(VecDestroy(&ip->given->warm_s));
  PetscCall(VecDestroy(&ip->given->warm_z));
  PetscCall(IPTermsDestroy(ip->terms));
  PetscCall(IPFilterSetDestroy(ip->filter));
  PetscCall(PetscFree(ip->rec->ksp_iterations));
  PetscCall(KSPDestroy(&tao->ksp));
  PetscCall(PetscFree(tao->data));
  PetscFunctionReturn(0);
}
