/* Public functions of the subspace method */
#include "subspaceimpl.h"
#include "pc_amgf/functions.h"
#include "tao_ipfilter/solver/options.h"

static PetscErrorCode TaoIPFilterGetSubspace_IPFilter(Tao tao, PetscContainer *space)
{
  IPRecycle *recycle;

  PetscFunctionBegin;
  PetscCall(IPRecycleGet(tao, &recycle));
  *space = IPSubspaceOf(tao)->recycle;
  PetscFunctionReturn(0);
}

/* Gets the recycled data from a container of the caller's */
static PetscErrorCode RecycleOf(PetscContainer space, IPRecycle **recycle)
{
  PetscFunctionBegin;
  PetscCall(PetscContainerGetPointer(space, (void **)recycle));
  PetscCheck(*recycle, PetscObjectComm((PetscObject)space), PETSC_ERR_ARG_WRONG,
    "The container of the subspace is empty: it must come from TaoIPFilterGetSubspace()");
  PetscFunctionReturn(0);
}

/*
   Sets the recycled data. Their preconditioner becomes that of the Krylov method, so that TaoGetKSP() returns the one
   in use. A preconditioner of another type or options prefix is not replaced.
*/
static PetscErrorCode TaoIPFilterSetSubspace_IPFilter(Tao tao, PetscContainer space)
{
  IPSubspace *f = IPSubspaceOf(tao);
  IPRecycle  *recycle;
  const char *own, *theirs;
  PC          pc;
  PetscBool   type, prefix;

  PetscFunctionBegin;
  PetscCall(RecycleOf(space, &recycle));
  PetscCall(PetscObjectReference((PetscObject)space));
  PetscCall(PetscContainerDestroy(&f->recycle));
  f->recycle = space;
  if (!recycle->pc) PetscFunctionReturn(0);
  PetscCall(KSPGetPC(tao->ksp, &pc));
  PetscCall(PetscObjectTypeCompare((PetscObject)pc, ((PetscObject)recycle->pc)->type_name, &type));
  PetscCall(PCGetOptionsPrefix(pc, &own));
  PetscCall(PCGetOptionsPrefix(recycle->pc, &theirs));
  PetscCall(PetscStrcmp(own, theirs, &prefix));
  if (type && prefix) PetscCall(KSPSetPC(tao->ksp, recycle->pc));
  PetscFunctionReturn(0);
}

static PetscErrorCode TaoIPFilterSetModes_IPFilter(Tao tao, Mat modes)
{
  IPGiven *given = ((TAO_IPFILTER *)tao->data)->given;

  PetscFunctionBegin;
  PetscCall(PetscObjectReference((PetscObject)modes));
  PetscCall(MatDestroy(&given->modes));
  given->modes = modes;
  PetscFunctionReturn(0);
}

static PetscErrorCode TaoIPFilterSetInterrupt_IPFilter(Tao tao, PetscErrorCode (*interrupt)(void *, PetscBool *),
  void                                                    *ctx)
{
  IPGiven *given = ((TAO_IPFILTER *)tao->data)->given;

  PetscFunctionBegin;
  given->interrupt     = interrupt;
  given->interrupt_ctx = ctx;
  PetscFunctionReturn(0);
}

static const AMGFFunction functions[] = {
  AMGF_FUNCTION(TaoIPFilterGetSubspace, IPFilter),
  AMGF_FUNCTION(TaoIPFilterSetSubspace, IPFilter),
  AMGF_FUNCTION(TaoIPFilterSetModes, IPFilter),
  AMGF_FUNCTION(TaoIPFilterSetInterrupt, IPFilter),
};

/* Composes the implementations with the Tao, or removes them if `attach` is false */
PetscErrorCode IPSubspaceCompose(Tao tao, PetscBool attach)
{
  PetscFunctionBegin;
  PetscCall(AMGFComposeFunctions((PetscObject)tao, PETSC_STATIC_ARRAY_LENGTH(functions), functions, attach));
  PetscFunctionReturn(0);
}

/*@C
  TaoIPFilterSetSubspace - Sets the preconditioner and the directions of the subspace method to those of
  another solver

  Logically Collective

  Input Parameters:
+ tao   - the `TAOIPFILTER`, after `TaoSetFromOptions()`
- space - preconditioner and directions that `TaoIPFilterGetSubspace()` returned for a solver with the same Hessian;
          referenced, not copied

  Level: advanced

  Notes:
  All later solves with the same Hessian, for any constraints and loads, reuse the preconditioner and the directions. A
  solver reuses its own without this call. If the values of the Hessian have changed, its products with the directions
  are computed again. With another Hessian matrix, or another type of `PC`, the directions are discarded.

  The `PC` of the solver's `KSP` is replaced by that preconditioner, if type and options prefix agree. The counts of
  `PCAMGFGetCounts()` continue.

.seealso: `TAOIPFILTER`, `TaoIPFilterGetSubspace()`
@*/
PetscErrorCode TaoIPFilterSetSubspace(Tao tao, PetscContainer space)
{
  PetscFunctionBegin;
  PetscValidHeaderSpecific(tao, TAO_CLASSID, 1);
  PetscValidHeaderSpecific(space, PETSC_CONTAINER_CLASSID, 2);
  PetscTryMethod(tao, "TaoIPFilterSetSubspace_C", (Tao, PetscContainer), (tao, space));
  PetscFunctionReturn(0);
}

/*@C
  TaoIPFilterGetSubspace - Gets the preconditioner and the directions that the subspace method reuses in later
  solves

  Collective

  Input Parameter:
. tao - the `TAOIPFILTER`

  Output Parameter:
. space - preconditioner and directions, owned by `tao`; call `PetscObjectReference()` if it must outlive the solver

  Options Database Keys:
+ -tao_ipfilter_subspace <auto> (false,true,auto) - use the subspace method instead of the interior point
                                                    method
- -tao_ipfilter_subspace_max <0>                   - largest number of directions, which are stored in single precision;
                                                     0: 80, or 48 if the objective is not quadratic

  Level: advanced

.seealso: `TAOIPFILTER`, `TaoIPFilterSetSubspace()`
@*/
PetscErrorCode TaoIPFilterGetSubspace(Tao tao, PetscContainer *space)
{
  PetscFunctionBegin;
  PetscValidHeaderSpecific(tao, TAO_CLASSID, 1);
  PetscAssertPointer(space, 2);
  PetscUseMethod(tao, "TaoIPFilterGetSubspace_C", (Tao, PetscContainer *), (tao, space));
  PetscFunctionReturn(0);
}

/*@
  TaoIPFilterSetModes - Sets motions that the Hessian hardly resists, such as rigid body modes of bodies on weak springs

  Collective

  Input Parameters:
+ tao   - the `TAOIPFILTER`
- modes - matrix with one motion per column; `NULL`: none; referenced, not copied

  Level: advanced

  Notes:
  Multigrid converges slowly for such motions. The subspace method adds them to its search space, unless its
  preconditioner is a factorization or the objective is not quadratic. The other methods ignore them.

  Each motion takes a product with the Hessian and as much memory as a direction.

.seealso: `TAOIPFILTER`, `TaoIPFilterSetSubspace()`, `MatSetNearNullSpace()`
@*/
PetscErrorCode TaoIPFilterSetModes(Tao tao, Mat modes)
{
  PetscFunctionBegin;
  PetscValidHeaderSpecific(tao, TAO_CLASSID, 1);
  if (modes) PetscValidHeaderSpecific(modes, MAT_CLASSID, 2);
  PetscTryMethod(tao, "TaoIPFilterSetModes_C", (Tao, Mat), (tao, modes));
  PetscFunctionReturn(0);
}

/*
   Adds a direction computed from the forces `left`, which the solution in the subspace leaves unbalanced outside W.
   *extended: false if there is no room, or the preconditioner is not positive definite.
*/
static PetscErrorCode RecycleExtend(IPRecycle *recycle, Mat K, Vec left, PetscBool *extended)
{
  PetscReal  *pg;
  PetscScalar energy;
  Vec         d;

  PetscFunctionBegin;
  *extended = (PetscBool)(recycle->basis.n < recycle->basis.max);
  if (!*extended) PetscFunctionReturn(0);
  PetscCall(VecDuplicate(left, &d));
  PetscCall(PetscLogEventBegin(TAO_IPFilterApply, left, d, NULL, NULL));
  PetscCall(PCApply(recycle->pc, left, d));
  PetscCall(PetscLogEventEnd(TAO_IPFilterApply, left, d, NULL, NULL));
  PetscCall(VecDot(left, d, &energy));
  *extended = (PetscBool)(PetscRealPart(energy) > 0.0 && !PetscIsInfOrNanReal(PetscRealPart(energy)));
  PetscCall(VecISSet(d, recycle->reduced.W, 0.0));
  PetscCall(PetscLogEventBegin(TAO_IPFilterDirections, d, NULL, NULL, NULL));
  if (*extended) PetscCall(IPBasisAppend(&recycle->basis, K, d, extended));
  PetscCall(PetscLogEventEnd(TAO_IPFilterDirections, d, NULL, NULL, NULL));
  PetscCall(VecDestroy(&d));
  if (!*extended) PetscFunctionReturn(0);
  PetscCall(PetscCalloc1(recycle->basis.max, &pg));
  PetscCall(IPReducedAppend(&recycle->reduced, &recycle->basis, pg));
  PetscCall(PetscFree(pg));
  PetscFunctionReturn(0);
}

/* Computes the residual left = -K v outside W. *part: norm of `left` relative to that of K v. */
static PetscErrorCode RecycleForceLeft(const IPRecycle *recycle, Mat K, Vec v, Vec left, PetscReal *part)
{
  PetscReal all, off;

  PetscFunctionBegin;
  PetscCall(MatMult(K, v, left));
  PetscCall(VecScale(left, -1.0));
  PetscCall(VecNorm(left, NORM_2, &all));
  PetscCall(VecISSet(left, recycle->reduced.W, 0.0));
  PetscCall(VecNorm(left, NORM_2, &off));
  *part = off > 0.0 ? off / all : 0.0;
  PetscFunctionReturn(0);
}

/*@C
  TaoIPFilterSolveActive - Solves a system with the Hessian and the active constraints of the last solution, by the
  subspace method

  Collective

  Input Parameters:
+ space - preconditioner and directions, from `TaoIPFilterGetSubspace()` after `TaoSolve()`
. f     - right-hand side of the unknowns; its entries outside the unknowns of the constraints and their neighbours are
          ignored
. c     - right-hand side of the constraints; its entries in constraints that are not active are ignored
. most  - largest number of applications of the preconditioner
- rtol  - residual at which the iteration stops, relative to the norm of H x

  Output Parameters:
+ x      - solution of H x - J^T lambda = f, J_A x = c_A on the subspace
. lambda - multipliers; zero in constraints that are not active
. n      - number of applications of the preconditioner
- solved - `PETSC_FALSE`: no constraint is active, or the last solve did not end with the subspace method; x
           and lambda are not set

  Level: developer

  Note:
  J, the active set A and the factors are those of the last solve. Later solves reuse the directions that are added. A
  caller with nonlinear constraints can compute by this function, to first order, how the solution of a linearized
  problem depends on the linearization.

.seealso: `TAOIPFILTER`, `TaoIPFilterGetSubspace()`
@*/
PetscErrorCode TaoIPFilterSolveActive(PetscContainer space, Vec f, Vec c, PetscInt most, PetscReal rtol, Vec x,
  Vec lambda, PetscInt *n, PetscBool *solved)
{
  IPRecycle *recycle;
  PetscReal  part     = 0.0;
  PetscBool  extended = PETSC_TRUE;
  Vec        left;
  Mat        K;

  PetscFunctionBegin;
  PetscValidHeaderSpecific(space, PETSC_CONTAINER_CLASSID, 1);
  PetscValidHeaderSpecific(f, VEC_CLASSID, 2);
  PetscValidHeaderSpecific(c, VEC_CLASSID, 3);
  PetscValidHeaderSpecific(x, VEC_CLASSID, 6);
  PetscValidHeaderSpecific(lambda, VEC_CLASSID, 7);
  PetscAssertPointer(n, 8);
  PetscAssertPointer(solved, 9);
  *n = 0;
  PetscCall(RecycleOf(space, &recycle));
  PetscCall(IPReducedSolveActive(&recycle->reduced, &recycle->basis, f, c, x, lambda, solved));
  if (!*solved || !recycle->pc) PetscFunctionReturn(0);
  PetscCall(PCGetOperators(recycle->pc, &K, NULL));
  PetscCall(VecDuplicate(x, &left));
  while (*n < most && extended && *solved) {
    PetscCall(RecycleForceLeft(recycle, K, x, left, &part));
    if (part <= rtol) break;
    PetscCall(RecycleExtend(recycle, K, left, &extended));
    ++*n;
    if (extended) PetscCall(IPReducedSolveActive(&recycle->reduced, &recycle->basis, f, c, x, lambda, solved));
  }
  PetscCall(VecDestroy(&left));
  PetscFunctionReturn(0);
}

/*@C
  TaoIPFilterSetInterrupt - Sets a function that reports whether the user wants to end the solve

  Logically Collective

  Input Parameters:
+ tao       - the `TAOIPFILTER`
. interrupt - the function; `NULL`: none
- ctx       - its context

  Calling sequence of interrupt:
+ ctx  - the context
- stop - set to `PETSC_TRUE` if the solve should end

  Level: advanced

  Notes:
  A single iteration may solve many linear systems and compute many directions. The function is called before each
  system of norm terms and before each direction. It is called on every rank, and must not communicate. If *stop is
  true on any rank, the iteration ends without a solution. A test set by `TaoSetConvergenceTest()`, or a monitor, must
  then end the solve.

.seealso: `TAOIPFILTER`, `TaoIPFilterSetNormTerms()`
@*/
PetscErrorCode TaoIPFilterSetInterrupt(Tao tao, PetscErrorCode (*interrupt)(void *ctx, PetscBool *stop), void *ctx)
{
  PetscFunctionBegin;
  PetscValidHeaderSpecific(tao, TAO_CLASSID, 1);
  PetscTryMethod(tao, "TaoIPFilterSetInterrupt_C", (Tao, PetscErrorCode(*)(void *, PetscBool *), void *),
    (tao, interrupt, ctx));
  PetscFunctionReturn(0);
}
