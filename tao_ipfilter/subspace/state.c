/*
   Data of the filtered subspace method that later solves of one Tao or of several reuse: the preconditioner and the
   directions of K
*/
#include "subspaceimpl.h"
#include "tao_ipfilter/solver/barrier.h"
#include "tao_ipfilter/solver/condensed.h"
#include "tao_ipfilter/solver/matrices.h"
#include "tao_ipfilter/solver/options.h"
#include "tao_ipfilter/solver/record.h"
#include "tao_ipfilter/solver/stiffness.h"
#include "tao_ipfilter/solver/terms.h"

/* Destroys the data. PCAMGF chooses between AMG and factorization again at its next set-up. */
PetscErrorCode IPSubspaceStateReset(IPSubspaceState *kept)
{
  PetscFunctionBegin;
  if (kept->pc) PetscCall(PCSetReusePreconditioner(kept->pc, PETSC_FALSE));
  PetscCall(PCDestroy(&kept->pc));
  PetscCall(IPBasisDestroy(&kept->basis));
  PetscCall(IPReducedDestroy(&kept->reduced));
  kept->K_id     = 0;
  kept->ncurrent = 0;
  kept->expected = 0.0;
  kept->held = kept->negative = PETSC_FALSE;
  PetscFunctionReturn(0);
}

static PetscErrorCode KeptDestroy(void *argument)
{
  IPSubspaceState *kept = (IPSubspaceState *)AMGFDestroyed(argument);

  PetscFunctionBegin;
  PetscCall(IPSubspaceStateReset(kept));
  PetscCall(PetscFree(kept));
  PetscFunctionReturn(0);
}

/* Gets the data of the Tao, and creates them at the first call */
PetscErrorCode IPSubspaceStateGet(Tao tao, IPSubspaceState **kept)
{
  IPFiltered *f = IPFilteredOf(tao);

  PetscFunctionBegin;
  if (!f->kept) {
    PetscCall(PetscNew(kept));
    PetscCall(PetscContainerCreate(PetscObjectComm((PetscObject)tao), &f->kept));
    PetscCall(PetscContainerSetPointer(f->kept, *kept));
    PetscCall(PetscContainerSetCtxDestroy(f->kept, (PetscCtxDestroyFn *)KeptDestroy));
  }
  PetscCall(PetscContainerGetPointer(f->kept, (void **)kept));
  PetscFunctionReturn(0);
}

/*
   Finds whether the preconditioner reads full rows of K. A factorization and PCBLOCKAMG read the upper triangle only.
*/
static PetscErrorCode KeptReadsRows(PC pc, PetscBool *rows)
{
  PetscBool amgf, factored, block;
  PC        amg;

  PetscFunctionBegin;
  *rows = PETSC_FALSE;
  PetscCall(PetscObjectTypeCompare((PetscObject)pc, PCAMGF, &amgf));
  if (!amgf) PetscFunctionReturn(0);
  PetscCall(PCAMGFGetFactored(pc, &factored, NULL));
  PetscCall(PCAMGFGetAMGPC(pc, &amg));
  PetscCall(PetscObjectTypeCompare((PetscObject)amg, PCBLOCKAMG, &block));
  *rows = (PetscBool)(!factored && !block);
  PetscFunctionReturn(0);
}

/*
   Gets K with both triangles if the preconditioner reads full rows and K stores its upper triangle only; otherwise a
   reference to K
*/
static PetscErrorCode KeptGetWhole(PC pc, Mat K, Mat *whole)
{
  MatNullSpace modes;
  PetscBool    half, rows;

  PetscFunctionBegin;
  PetscCall(KeptReadsRows(pc, &rows));
  PetscCall(PetscObjectTypeCompare((PetscObject)K, MATSEQSBAIJ, &half));
  if (half && rows) {
    PetscCall(MatConvert(K, MATBAIJ, MAT_INITIAL_MATRIX, whole));
    PetscCall(MatGetNearNullSpace(K, &modes));
    PetscCall(MatSetNearNullSpace(*whole, modes));
  } else {
    PetscCall(PetscObjectReference((PetscObject)K));
    *whole = K;
  }
  PetscFunctionReturn(0);
}

/*
   Tells PCAMGF how many applications to expect with K: `left` in this solve, and an estimate for later solves with the
   same K. Has no effect before the first solve.
*/
static PetscErrorCode KeptExpect(Tao tao, IPSubspaceState *kept, PetscReal left)
{
  TAO_IPFILTER   *ip       = (TAO_IPFILTER *)tao->data;
  const PetscReal later    = 0.7,
                  factored = 10.0; /* later: number of applications in a later solve relative to this one; factored:
                                      number of applications in a solve with a factorization */
  const PetscReal n        = ip->rec->napplications + left,
                  solves   = kept->changing ? 0.0 : PetscMax(ip->given->solves_to_come - 1, 0);

  PetscFunctionBegin;
  PetscCall(
    PCAMGFExpect(kept->pc, left + later * n * solves, PetscMin(factored, left) + PetscMin(factored, n) * solves));
  PetscFunctionReturn(0);
}

/* Prints the choice of the linear solver once per solve, not at every Newton step */
static PetscErrorCode KeptSayChoice(Tao tao, PC pc)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  PetscBool     factored;
  const char   *why;

  PetscFunctionBegin;
  PetscCall(PCAMGFGetFactored(pc, &factored, &why));
  if (!ip->opt->monitor || !why[0] || (IPFilteredOf(tao)->newton && (tao->niter || ip->shift->delta > 0.0)))
    PetscFunctionReturn(0);
  PetscCall(PetscPrintf(PetscObjectComm((PetscObject)tao), "Linear solver: %s, %s\n",
    factored ? "direct (MUMPS)" : "CG with AMG", why));
  PetscFunctionReturn(0);
}

/*
   Sets up B, the preconditioner of the Krylov method without filter, from the matrix A. Afterwards the PC refers to K,
   so that A can be destroyed.
*/
static PetscErrorCode KeptSetUpPC(Tao tao, IPSubspaceState *kept, Mat A, Mat K, PetscBool *possible)
{
  PC             pc = kept->pc, amg;
  PetscBool      amgf;
  PCFailedReason failed;

  PetscFunctionBegin;
  PetscCall(PetscObjectTypeCompare((PetscObject)pc, PCAMGF, &amgf));
  if (amgf) PetscCall(PCAMGFSetFilterActive(pc, PETSC_FALSE));
  PetscCall(PCSetReusePreconditioner(pc, PETSC_FALSE));
  PetscCall(PCSetOperators(pc, A, A));
  PetscCall(PCSetUp(pc));
  PetscCall(PCSetReusePreconditioner(pc, PETSC_TRUE));
  if (amgf) {
    PetscCall(PCAMGFGetAMGPC(pc, &amg));
    PetscCall(PCSetOperators(amg, K, K));
    PetscCall(KeptSayChoice(tao, pc));
  }
  PetscCall(PCSetOperators(pc, K, K));
  PetscCall(PCGetFailedReason(pc, &failed));
  *possible = (PetscBool)!failed;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, possible, 1, MPI_PETSCBOOL, MPI_LAND, PetscObjectComm((PetscObject)K)));
  PetscFunctionReturn(0);
}

/*
   Estimates how many applications of the AMG a new K needs. Models of Newton's method need fewer than a quadratic
   program, since they are solved to a larger tolerance. After the first model the number is the mean of the last
   estimate and of the last model's applications. A factorization says nothing about the AMG.
*/
static PetscErrorCode KeptForesee(Tao tao, IPSubspaceState *kept, PetscReal *n)
{
  const PetscReal usual = 35.0, model = 12.0, share = 0.5;
  PetscBool       amgf, factored = PETSC_FALSE;

  PetscFunctionBegin;
  if (kept->expected == 0.0) kept->expected = IPFilteredOf(tao)->newton ? model : usual;
  else if (kept->changing) {
    PetscCall(PetscObjectTypeCompare((PetscObject)kept->pc, PCAMGF, &amgf));
    if (amgf) PetscCall(PCAMGFGetFactored(kept->pc, &factored, NULL));
    if (!factored) kept->expected = (1.0 - share) * kept->expected + share * kept->ncurrent;
  }
  kept->ncurrent = 0;
  *n             = kept->expected;
  PetscFunctionReturn(0);
}

/* Sets up the preconditioner B for the Hessian K without constraints */
static PetscErrorCode KeptSetUpFree(Tao tao, IPSubspaceState *kept, Mat K, PetscBool *possible)
{
  PetscReal n = 0.0;
  Mat       whole;

  PetscFunctionBegin;
  PetscCall(KeptForesee(tao, kept, &n));
  PetscCall(PCSetOperators(kept->pc, K, K));
  PetscCall(KeptExpect(tao, kept, n));
  PetscCall(KeptGetWhole(kept->pc, K, &whole));
  PetscCall(KeptSetUpPC(tao, kept, whole, K, possible));
  PetscCall(MatDestroy(&whole));
  kept->held = kept->negative = PETSC_FALSE;
  PetscFunctionReturn(0);
}

/* Changes from AMG to a factorization if `left` more applications make that cheaper. The directions remain valid. */
PetscErrorCode IPSubspaceStateReconsider(Tao tao, IPSubspaceState *kept, PetscReal left, PetscBool *possible)
{
  PetscBool amgf, before, after;

  PetscFunctionBegin;
  *possible = PETSC_TRUE;
  PetscCall(PetscObjectTypeCompare((PetscObject)kept->pc, PCAMGF, &amgf));
  if (!amgf || kept->held) PetscFunctionReturn(0);
  PetscCall(PCAMGFGetFactored(kept->pc, &before, NULL));
  PetscCall(KeptExpect(tao, kept, left));
  PetscCall(PCAMGFGetFactored(kept->pc, &after, NULL));
  if (after != before)
    PetscCall(
      KeptSetUpPC(tao, kept, ((TAO_IPFILTER *)tao->data)->hess->H, ((TAO_IPFILTER *)tao->data)->hess->H, possible));
  PetscFunctionReturn(0);
}

/*
   Computes the weights D_t of the norm terms' rows: rho, the stiffness that resists the term, if the term can carry a
   force; otherwise 0
*/
PetscErrorCode IPSubspaceStateStiffnessOfTerms(Tao tao, Vec D)
{
  IPTerms           *terms   = ((TAO_IPFILTER *)tao->data)->terms;
  const Vec          most[2] = {terms->limit, terms->coefficient};
  const PetscScalar *rho;
  PetscScalar       *d;
  PetscInt           n;

  PetscFunctionBegin;
  PetscCall(VecGetLocalSize(terms->rho, &n));
  PetscCall(VecGetArrayRead(terms->rho, &rho));
  PetscCall(VecGetArrayWrite(D, &d));
  for (PetscInt i = 0; i < n; i++) d[2 * i] = d[2 * i + 1] = rho[i];
  for (PetscInt k = 0; k < 2; k++) {
    const PetscScalar *b;

    if (!most[k]) continue;
    PetscCall(VecGetArrayRead(most[k], &b));
    for (PetscInt i = 0; i < n; i++)
      if (b[i] == 0.0) d[2 * i] = d[2 * i + 1] = 0.0;
    PetscCall(VecRestoreArrayRead(most[k], &b));
  }
  PetscCall(VecRestoreArrayWrite(D, &d));
  PetscCall(VecRestoreArrayRead(terms->rho, &rho));
  PetscFunctionReturn(0);
}

/* Computes A = K + J^T D J + T^T D_t T. K contains a shift already. Dt: D_t; NULL without norm terms. */
PetscErrorCode IPSubspaceStateCondense(Tao tao, Vec D, Vec Dt, Mat *A)
{
  TAO_IPFILTER   *ip      = (TAO_IPFILTER *)tao->data;
  const PetscInt  systems = ip->rec->nsystems, filtered = ip->rec->nfiltered;
  const PetscReal delta = ip->shift->delta;

  PetscFunctionBegin;
  ip->cond->rows.given = Dt;
  ip->shift->delta     = 0.0;
  PetscCall(IPCondenseMatrix(tao, D));
  ip->shift->delta     = delta;
  ip->cond->rows.given = NULL;
  ip->rec->nsystems    = systems; /* restores the counts, since this is not a Newton system */
  ip->rec->nfiltered   = filtered;
  *A                   = ip->cond->A;
  ip->cond->A          = NULL;
  PetscFunctionReturn(0);
}

/*
   Sets up B for K + J^T D J + T^T D_t T. Needed if bodies are held by constraints and norm terms only. D is the
   stiffness of the bodies.
*/
PetscErrorCode IPSubspaceStateHold(Tao tao, IPSubspaceState *kept, PetscBool *possible)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  Vec           D, Dt = NULL;
  Mat           A;

  PetscFunctionBegin;
  PetscCall(
    PetscInfo(tao, "The Hessian is singular: its preconditioner is built from the Hessian and the constraints\n"));
  PetscCall(IPGetWork(tao, IP_INEQUALITIES, &D));
  PetscCall(VecPointwiseMult(D, ip->stiff->rho, ip->pair[IP_SLACK].w));
  if (ip->terms->n) PetscCall(VecDuplicate(ip->terms->t, &Dt));
  if (ip->terms->n) PetscCall(IPSubspaceStateStiffnessOfTerms(tao, Dt));
  PetscCall(IPSubspaceStateCondense(tao, D, Dt, &A));
  PetscCall(VecDestroy(&Dt));
  PetscCall(IPRestoreWork(tao, IP_INEQUALITIES, &D));
  PetscCall(KeptSetUpPC(tao, kept, A, ip->hess->H, possible));
  PetscCall(MatDestroy(&A));
  kept->held = PETSC_TRUE;
  PetscFunctionReturn(0);
}

/*
   Returns the largest number of directions to keep. More directions save applications of the preconditioner, but each
   application then takes longer. Newton's method keeps fewer, since each direction needs a product with every new K.
*/
static PetscInt KeptRoom(Tao tao)
{
  const PetscInt usual = 80, newton = 48, given = ((TAO_IPFILTER *)tao->data)->opt->subspace_max;

  if (given) return given;
  return IPFilteredOf(tao)->newton ? newton : usual;
}

/*
   Updates the data for the present K, constraints and fixed variables. *possible: false if the preconditioner cannot be
   set up.
*/
PetscErrorCode IPSubspaceStateUpdate(Tao tao, IPSubspaceState *kept, PetscBool *possible)
{
  TAO_IPFILTER    *ip = (TAO_IPFILTER *)tao->data;
  Mat              K  = ip->hess->H;
  PC               pc;
  PetscObjectState state;
  const PetscInt   max   = KeptRoom(tao);
  PetscBool        new_K = PETSC_FALSE;

  PetscFunctionBegin;
  *possible = PETSC_TRUE;
  PetscCall(PetscObjectStateGet((PetscObject)K, &state));
  PetscCall(KSPGetPC(tao->ksp, &pc));
  if (kept->K_id != ((PetscObject)K)->id || kept->pc != pc || kept->basis.max != max) {
    PetscCall(IPSubspaceStateReset(kept));
    PetscCall(PetscObjectReference((PetscObject)pc));
    kept->pc = pc;
    PetscCall(IPBasisCreate(max, tao->solution, &kept->basis));
  }
  if (kept->whole && ip->terms->n && IPFilteredOf(tao)->newton) {
    kept->changing = PETSC_TRUE; /* no directions, so that no preconditioner is needed */
  } else if (kept->K_id != ((PetscObject)K)->id || kept->K_state != state) {
    kept->changing = (PetscBool)(kept->K_id == ((PetscObject)K)->id);
    if (!kept->held || kept->negative) PetscCall(KeptSetUpFree(tao, kept, K, possible));
    if (kept->held || !*possible) PetscCall(IPSubspaceStateHold(tao, kept, possible));
    new_K = PETSC_TRUE;
  } else PetscCall(IPSubspaceStateReconsider(tao, kept, kept->napplications, possible));
  kept->K_id    = ((PetscObject)K)->id;
  kept->K_state = state;
  PetscCall(PetscLogEventBegin(TAO_IPFilterDirections, tao, NULL, NULL, NULL));
  PetscCall(IPBasisUpdate(&kept->basis, K, new_K, ip->fixed, IPFilteredOf(tao)->W));
  PetscCall(PetscLogEventEnd(TAO_IPFilterDirections, tao, NULL, NULL, NULL));
  PetscFunctionReturn(0);
}

static PetscErrorCode TaoIPFilterGetSubspace_IPFilter(Tao tao, PetscContainer *space)
{
  IPSubspaceState *kept;

  PetscFunctionBegin;
  PetscCall(IPSubspaceStateGet(tao, &kept));
  *space = IPFilteredOf(tao)->kept;
  PetscFunctionReturn(0);
}

/*
   Sets the reused data. Their preconditioner becomes that of the Krylov method, so that TaoGetKSP() shows the one in
   use. A preconditioner of another type or prefix is not replaced.
*/
static PetscErrorCode TaoIPFilterSetSubspace_IPFilter(Tao tao, PetscContainer space)
{
  IPFiltered      *f = IPFilteredOf(tao);
  IPSubspaceState *kept;
  const char      *own, *theirs;
  PC               pc;
  PetscBool        type, prefix;

  PetscFunctionBegin;
  PetscCall(PetscObjectReference((PetscObject)space));
  PetscCall(PetscContainerDestroy(&f->kept));
  f->kept = space;
  PetscCall(PetscContainerGetPointer(space, (void **)&kept));
  if (!kept->pc) PetscFunctionReturn(0);
  PetscCall(KSPGetPC(tao->ksp, &pc));
  PetscCall(PetscObjectTypeCompare((PetscObject)pc, ((PetscObject)kept->pc)->type_name, &type));
  PetscCall(PCGetOptionsPrefix(pc, &own));
  PetscCall(PCGetOptionsPrefix(kept->pc, &theirs));
  PetscCall(PetscStrcmp(own, theirs, &prefix));
  if (type && prefix) PetscCall(KSPSetPC(tao->ksp, kept->pc));
  PetscFunctionReturn(0);
}

static PetscErrorCode TaoIPFilterSetSolvesToCome_IPFilter(Tao tao, PetscInt n)
{
  PetscFunctionBegin;
  PetscCheck(n >= 1, PetscObjectComm((PetscObject)tao), PETSC_ERR_ARG_OUTOFRANGE,
    "The number of solves to come must be at least 1, but is %" PetscInt_FMT, n);
  ((TAO_IPFILTER *)tao->data)->given->solves_to_come = n;
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

/* Composes the implementations with the Tao, or removes them if `attach` is false */
PetscErrorCode IPSubspaceStateCompose(Tao tao, PetscBool attach)
{
  PetscObject o = (PetscObject)tao;

  PetscFunctionBegin;
  PetscCall(PetscObjectComposeFunction(o, "TaoIPFilterGetSubspace_C", attach ? TaoIPFilterGetSubspace_IPFilter : NULL));
  PetscCall(PetscObjectComposeFunction(o, "TaoIPFilterSetSubspace_C", attach ? TaoIPFilterSetSubspace_IPFilter : NULL));
  PetscCall(
    PetscObjectComposeFunction(o, "TaoIPFilterSetSolvesToCome_C", attach ? TaoIPFilterSetSolvesToCome_IPFilter : NULL));
  PetscCall(
    PetscObjectComposeFunction(o, "TaoIPFilterSetInterrupt_C", attach ? TaoIPFilterSetInterrupt_IPFilter : NULL));
  PetscFunctionReturn(0);
}

/*@C
  TaoIPFilterSetSubspace - Sets the preconditioner and directions of the filtered subspace method, from another solver

  Logically Collective

  Input Parameters:
+ tao   - the `TAOIPFILTER`, after `TaoSetFromOptions()`
- space - the result of `TaoIPFilterGetSubspace()` of a solver with the same Hessian

  Level: advanced

  Notes:
  With `-tao_ipfilter_subspace` the preconditioner of the Hessian and the computed directions are reused in all later
  solves with that Hessian, for any constraints and loads: automatically in later calls of `TaoSolve()` on the same
  solver, by this call on another solver. If the values of the Hessian have changed, its products with the directions
  are computed again. With another Hessian matrix, or another type of `PC`, the directions are discarded.

  The `PC` of the solver's `KSP` is replaced by that preconditioner; its `PCAMGFGetCounts()` continue from their values.

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
  TaoIPFilterGetSubspace - Gets the preconditioner and directions that the filtered subspace method keeps for later
  solves

  Not Collective

  Input Parameter:
. tao - the `TAOIPFILTER`

  Output Parameter:
. space - preconditioner and directions, owned by `tao`: reference it if it is needed after the solver is destroyed

  Options Database Keys:
+ -tao_ipfilter_subspace <auto> (false,true,auto) - the filtered subspace method in place of the interior point method
- -tao_ipfilter_subspace_max <0>                   - directions that it keeps, in single precision; 0: 80, or 48
                                                     where the objective is not quadratic

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
  TaoIPFilterSetSolvesToCome - Sets the expected number of solves with the same Hessian, by which the filtered subspace
  method chooses its preconditioner

  Logically Collective

  Input Parameters:
+ tao - the `TAOIPFILTER`
- n   - their number, the next one included; 1 without this call

  Level: advanced

  Note:
  A factorization of the Hessian becomes cheaper than the AMG if there are many solves: see `PCAMGFSetFactor()`, whose
  setting is `PC_AMGF_FACTOR_AUTO` here unless `-tao_ipfilter_pc_amgf_factor` is given.

.seealso: `TAOIPFILTER`, `TaoIPFilterSetSubspace()`, `PCAMGFExpect()`
@*/
PetscErrorCode TaoIPFilterSetSolvesToCome(Tao tao, PetscInt n)
{
  PetscFunctionBegin;
  PetscValidHeaderSpecific(tao, TAO_CLASSID, 1);
  PetscValidLogicalCollectiveInt(tao, n, 2);
  PetscTryMethod(tao, "TaoIPFilterSetSolvesToCome_C", (Tao, PetscInt), (tao, n));
  PetscFunctionReturn(0);
}

/*
   Adds a direction computed from the forces `left`, which the solution in the subspace leaves unbalanced outside W.
   *extended: false if there is no room, or the preconditioner is not positive definite.
*/
static PetscErrorCode KeptExtend(IPSubspaceState *kept, Mat K, Vec left, PetscBool *extended)
{
  PetscReal  *pg;
  PetscScalar energy;
  Vec         d;

  PetscFunctionBegin;
  *extended = (PetscBool)(kept->basis.n < kept->basis.max);
  if (!*extended) PetscFunctionReturn(0);
  PetscCall(VecDuplicate(left, &d));
  PetscCall(PetscLogEventBegin(TAO_IPFilterApply, left, d, NULL, NULL));
  PetscCall(PCApply(kept->pc, left, d));
  PetscCall(PetscLogEventEnd(TAO_IPFilterApply, left, d, NULL, NULL));
  PetscCall(VecDot(left, d, &energy));
  *extended = (PetscBool)(PetscRealPart(energy) > 0.0 && !PetscIsInfOrNanReal(PetscRealPart(energy)));
  PetscCall(VecISSet(d, kept->reduced.W, 0.0));
  PetscCall(PetscLogEventBegin(TAO_IPFilterDirections, d, NULL, NULL, NULL));
  if (*extended) PetscCall(IPBasisAppend(&kept->basis, K, d, extended));
  PetscCall(PetscLogEventEnd(TAO_IPFilterDirections, d, NULL, NULL, NULL));
  PetscCall(VecDestroy(&d));
  if (!*extended) PetscFunctionReturn(0);
  PetscCall(PetscCalloc1(kept->basis.max, &pg));
  PetscCall(IPReducedAppend(&kept->reduced, &kept->basis, pg));
  PetscCall(PetscFree(pg));
  PetscFunctionReturn(0);
}

/* Computes left = -K v outside W. *part: norm of `left` relative to that of K v. */
static PetscErrorCode KeptForceLeft(const IPSubspaceState *kept, Mat K, Vec v, Vec left, PetscReal *part)
{
  PetscReal all, off;

  PetscFunctionBegin;
  PetscCall(MatMult(K, v, left));
  PetscCall(VecScale(left, -1.0));
  PetscCall(VecNorm(left, NORM_2, &all));
  PetscCall(VecISSet(left, kept->reduced.W, 0.0));
  PetscCall(VecNorm(left, NORM_2, &off));
  *part = off > 0.0 ? off / all : 0.0;
  PetscFunctionReturn(0);
}

/*@C
  TaoIPFilterSolveActive - Solves a system with the Hessian and the active constraints of the last solution, by the
  filtered subspace method

  Collective

  Input Parameters:
+ space - the result of `TaoIPFilterGetSubspace()` after `TaoSolve()`
. f     - right-hand side of the unknowns; only unknowns of constraints and their neighbours count
. c     - right-hand side of the constraints; only active ones count
. most  - the preconditioner may be applied so often
- rtol  - residual to reach, relative to the forces on the constraints' unknowns

  Output Parameters:
+ x      - solution of H x - J^T lambda = f, J_A x = c_A on the subspace
. lambda - its multipliers, zero in constraints that are not active
. n      - applications of the preconditioner
- solved - false: there are none, or the last solve did not end with the method; x and lambda are not set

  Level: developer

  Note:
  J, the active set and the factors are those of the last solve. Directions that are added stay for later solves. A
  caller whose constraints are not linear finds by it, to first order, how solutions of linearized problems depend on
  the linearization.

.seealso: `TAOIPFILTER`, `TaoIPFilterGetSubspace()`
@*/
PetscErrorCode TaoIPFilterSolveActive(PetscContainer space, Vec f, Vec c, PetscInt most, PetscReal rtol, Vec x,
  Vec lambda, PetscInt *n, PetscBool *solved)
{
  IPSubspaceState *kept;
  PetscReal        part     = 0.0;
  PetscBool        extended = PETSC_TRUE;
  Vec              left;
  Mat              K;

  PetscFunctionBegin;
  PetscValidHeaderSpecific(space, PETSC_CONTAINER_CLASSID, 1);
  PetscValidHeaderSpecific(f, VEC_CLASSID, 2);
  PetscValidHeaderSpecific(c, VEC_CLASSID, 3);
  PetscValidHeaderSpecific(x, VEC_CLASSID, 6);
  PetscValidHeaderSpecific(lambda, VEC_CLASSID, 7);
  PetscAssertPointer(n, 8);
  PetscAssertPointer(solved, 9);
  *n = 0;
  PetscCall(PetscContainerGetPointer(space, (void **)&kept));
  PetscCall(IPReducedSolveActive(&kept->reduced, &kept->basis, f, c, x, lambda, solved));
  if (!*solved || !kept->pc) PetscFunctionReturn(0);
  PetscCall(PCGetOperators(kept->pc, &K, NULL));
  PetscCall(VecDuplicate(x, &left));
  while (*n < most && extended && *solved) {
    PetscCall(KeptForceLeft(kept, K, x, left, &part));
    if (part <= rtol) break;
    PetscCall(KeptExtend(kept, K, left, &extended));
    ++*n;
    if (extended) PetscCall(IPReducedSolveActive(&kept->reduced, &kept->basis, f, c, x, lambda, solved));
  }
  PetscCall(VecDestroy(&left));
  PetscFunctionReturn(0);
}

/*@C
  TaoIPFilterSetInterrupt - Sets a function that tells whether the user wants to end the solve

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
  The function is called on the first rank only, between the linear systems of a reduced problem with norm terms, which
  can be many in a single iteration. It must not communicate. If *stop is true, the reduced problem ends without a
  solution. A test set by `TaoSetConvergenceTest()`, or a monitor, must then end the solve.

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
