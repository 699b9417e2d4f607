/*
   Data of the subspace method that later solves, of the same Tao or of another, reuse: the preconditioner of
   the Hessian K, and the directions
*/
#include "subspaceimpl.h"
#include "pc_amgf/amgfimpl.h"
#include "tao_ipfilter/solver/barrier.h"
#include "tao_ipfilter/solver/condensed.h"
#include "tao_ipfilter/solver/matrices.h"
#include "tao_ipfilter/solver/options.h"
#include "tao_ipfilter/solver/record.h"
#include "tao_ipfilter/solver/stiffness.h"
#include "tao_ipfilter/solver/terms.h"
#include "tao_ipfilter/solver/work.h"

/* Destroys the data. PCAMGF chooses between AMG and factorization again at its next set-up. */
PetscErrorCode IPRecycleReset(IPRecycle *recycle)
{
  PetscFunctionBegin;
  if (recycle->pc) PetscCall(PCSetReusePreconditioner(recycle->pc, PETSC_FALSE));
  PetscCall(PCDestroy(&recycle->pc));
  PetscCall(IPBasisDestroy(&recycle->basis));
  PetscCall(IPReducedDestroy(&recycle->reduced));
  recycle->K_id = 0;
  recycle->held = recycle->negative = PETSC_FALSE;
  PetscFunctionReturn(0);
}

static PetscErrorCode RecycleDestroy(void *argument)
{
  IPRecycle *recycle = (IPRecycle *)AMGFDestroyed(argument);

  PetscFunctionBegin;
  PetscCall(IPRecycleReset(recycle));
  PetscCall(PetscFree(recycle));
  PetscFunctionReturn(0);
}

/* Gets the data of the Tao, and creates them at the first call */
PetscErrorCode IPRecycleGet(Tao tao, IPRecycle **recycle)
{
  IPSubspace *f = IPSubspaceOf(tao);

  PetscFunctionBegin;
  if (!f->recycle) {
    PetscCall(PetscNew(recycle));
    PetscCall(PetscContainerCreate(PetscObjectComm((PetscObject)tao), &f->recycle));
    PetscCall(PetscContainerSetPointer(f->recycle, *recycle));
    PetscCall(PetscContainerSetCtxDestroy(f->recycle, (PetscCtxDestroyFn *)RecycleDestroy));
  }
  PetscCall(PetscContainerGetPointer(f->recycle, (void **)recycle));
  PetscFunctionReturn(0);
}

/*
   Finds whether the preconditioner reads full rows of K. A factorization and PCBLOCKAMG read the upper triangle only.
*/
static PetscErrorCode RecycleReadsRows(PC pc, PetscBool *rows)
{
  PetscBool amgf, factored, block;
  PC        amg;

  PetscFunctionBegin;
  *rows = PETSC_FALSE;
  PetscCall(PetscObjectTypeCompare((PetscObject)pc, PCAMGF, &amgf));
  if (!amgf) PetscFunctionReturn(0);
  PetscCall(PCAMGFGetFactored(pc, &factored));
  PetscCall(PCAMGFConfigureInner_Private(pc)); /* the type of its AMG depends on the operator */
  PetscCall(PCAMGFGetAMGPC(pc, &amg));
  PetscCall(PetscObjectTypeCompare((PetscObject)amg, PCBLOCKAMG, &block));
  *rows = (PetscBool)(!factored && !block);
  PetscFunctionReturn(0);
}

/*
   Gets K with both triangles if the preconditioner reads full rows and K stores its upper triangle only; otherwise a
   reference to K
*/
static PetscErrorCode RecycleGetWhole(PC pc, Mat K, Mat *whole)
{
  MatNullSpace modes;
  PetscBool    half, rows;

  PetscFunctionBegin;
  PetscCall(RecycleReadsRows(pc, &rows));
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

/* Prints the choice of the linear solver once per solve, not at every Newton step */
static PetscErrorCode RecycleSayChoice(Tao tao, PC pc)
{
  TAO_IPFILTER *ip = (TAO_IPFILTER *)tao->data;
  PetscBool     factored;

  PetscFunctionBegin;
  PetscCall(PCAMGFGetFactored(pc, &factored));
  if (!ip->opt->monitor || (IPSubspaceOf(tao)->newton && (tao->niter || ip->shift->delta > 0.0)))
    PetscFunctionReturn(0);
  PetscCall(PetscPrintf(PetscObjectComm((PetscObject)tao), "Linear solver: %s\n",
    factored ? "direct (Cholesky)" : "CG with AMG"));
  PetscFunctionReturn(0);
}

/*
   Sets up B, the preconditioner of the Krylov method without filter, from the matrix A. Afterwards the PC refers to K,
   so that A can be destroyed.
*/
static PetscErrorCode RecycleSetUpPC(Tao tao, IPRecycle *recycle, Mat A, Mat K, PetscBool *possible)
{
  PC             pc = recycle->pc, amg;
  PetscBool      amgf;
  PCFailedReason failed;

  PetscFunctionBegin;
  PetscCall(PetscObjectTypeCompare((PetscObject)pc, PCAMGF, &amgf));
  if (amgf) PetscCall(PCAMGFSetFilterActive(pc, PETSC_FALSE));
  PetscCall(PCSetReusePreconditioner(pc, PETSC_FALSE));
  PetscCall(PCSetOperators(pc, A, A));
  PetscCall(IPWorkTrim(((TAO_IPFILTER *)tao->data)->work)); /* the set-up of AMG needs the most memory */
  PetscCall(PCSetUp(pc));
  PetscCall(PCSetReusePreconditioner(pc, PETSC_TRUE));
  if (amgf) {
    PetscCall(PCAMGFGetAMGPC(pc, &amg));
    PetscCall(PCSetOperators(amg, K, K));
    PetscCall(RecycleSayChoice(tao, pc));
  }
  PetscCall(PCSetOperators(pc, K, K));
  PetscCall(PCGetFailedReason(pc, &failed));
  *possible = (PetscBool)!failed;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, possible, 1, MPI_PETSCBOOL, MPI_LAND, PetscObjectComm((PetscObject)K)));
  PetscFunctionReturn(0);
}

/* Sets up the preconditioner B for the Hessian K without constraints */
static PetscErrorCode RecycleSetUpFree(Tao tao, IPRecycle *recycle, Mat K, PetscBool *possible)
{
  Mat whole;

  PetscFunctionBegin;
  PetscCall(PCSetOperators(recycle->pc, K, K));
  PetscCall(RecycleGetWhole(recycle->pc, K, &whole));
  PetscCall(RecycleSetUpPC(tao, recycle, whole, K, possible));
  PetscCall(MatDestroy(&whole));
  recycle->held = recycle->negative = PETSC_FALSE;
  PetscFunctionReturn(0);
}

/* Replaces an AMG that is slow for K by a factorization, if that is small. The directions remain valid. */
PetscErrorCode IPRecycleReconsider(Tao tao, IPRecycle *recycle, PetscBool *possible)
{
  const Mat K = ((TAO_IPFILTER *)tao->data)->hess->H;
  PetscBool amgf, changed = PETSC_FALSE;

  PetscFunctionBegin;
  *possible = PETSC_TRUE;
  PetscCall(PetscObjectTypeCompare((PetscObject)recycle->pc, PCAMGF, &amgf));
  if (amgf && !recycle->held) PetscCall(PCAMGFReconsiderFactor(recycle->pc, &changed));
  if (changed) PetscCall(RecycleSetUpPC(tao, recycle, K, K, possible));
  PetscFunctionReturn(0);
}

/*
   Computes the weights D_t of the norm terms' rows: rho, the stiffness that resists the term, if the term can carry a
   force; otherwise 0
*/
PetscErrorCode IPRecycleStiffnessOfTerms(Tao tao, Vec D)
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
PetscErrorCode IPRecycleCondense(Tao tao, Vec D, Vec Dt, Mat *A)
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
PetscErrorCode IPRecycleHold(Tao tao, IPRecycle *recycle, PetscBool *possible)
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
  if (ip->terms->n) PetscCall(IPRecycleStiffnessOfTerms(tao, Dt));
  PetscCall(IPRecycleCondense(tao, D, Dt, &A));
  PetscCall(VecDestroy(&Dt));
  PetscCall(IPRestoreWork(tao, IP_INEQUALITIES, &D));
  PetscCall(RecycleSetUpPC(tao, recycle, A, ip->hess->H, possible));
  PetscCall(MatDestroy(&A));
  recycle->held = PETSC_TRUE;
  PetscFunctionReturn(0);
}

/*
   Computes the largest number of directions to keep, with room for the given motions. More directions save
   applications of the preconditioner, but each application then takes longer. Newton's method keeps fewer, since each
   direction needs a product with every new K.
*/
static PetscErrorCode RecycleGetRoom(Tao tao, PetscInt *room)
{
  const PetscInt usual = 80, newton = 48, given = ((TAO_IPFILTER *)tao->data)->opt->subspace_max;
  PetscInt       nmodes;

  PetscFunctionBegin;
  PetscCall(IPModesGetNumber(tao, &nmodes));
  *room = nmodes + (given ? given : IPSubspaceOf(tao)->newton ? newton : usual);
  PetscFunctionReturn(0);
}

/*
   Lets PCAMGF factor a small K, unless an option says otherwise. Most solves with K follow each other, while the
   interior point method has another matrix for each solve.
*/
static PetscErrorCode RecycleAllowFactor(PC pc)
{
  PetscBool amgf;

  PetscFunctionBegin;
  PetscCall(PetscObjectTypeCompare((PetscObject)pc, PCAMGF, &amgf));
  if (!amgf) PetscFunctionReturn(0);
  PetscCall(PCAMGFSetFactor(pc, PC_AMGF_FACTOR_AUTO));
  PetscCall(PCSetFromOptions(pc));
  PetscFunctionReturn(0);
}

/* Finds whether the directions are those of this K */
PetscErrorCode IPRecycleIsOf(const IPRecycle *recycle, Mat K, PetscBool *same)
{
  PetscObjectState state;

  PetscFunctionBegin;
  PetscCall(PetscObjectStateGet((PetscObject)K, &state));
  *same = (PetscBool)(recycle->K_id == ((PetscObject)K)->id && recycle->K_state == state);
  PetscFunctionReturn(0);
}

/*
   Updates the data for the present K, constraints and fixed variables. *possible: false if the preconditioner cannot be
   set up.
*/
PetscErrorCode IPRecycleUpdate(Tao tao, IPRecycle *recycle, PetscBool *possible)
{
  TAO_IPFILTER    *ip = (TAO_IPFILTER *)tao->data;
  Mat              K  = ip->hess->H;
  PC               pc;
  PetscObjectState state;
  PetscInt         max  = 0;
  PetscBool        same = PETSC_FALSE;

  PetscFunctionBegin;
  *possible = PETSC_TRUE;
  PetscCall(PetscObjectStateGet((PetscObject)K, &state));
  PetscCall(KSPGetPC(tao->ksp, &pc));
  PetscCall(RecycleGetRoom(tao, &max));
  if (recycle->K_id != ((PetscObject)K)->id || recycle->pc != pc || recycle->basis.max != max) {
    PetscCall(IPRecycleReset(recycle));
    PetscCall(PetscObjectReference((PetscObject)pc));
    recycle->pc = pc;
    PetscCall(RecycleAllowFactor(pc));
    PetscCall(IPBasisCreate(max, tao->solution, &recycle->basis));
  }
  PetscCall(IPRecycleIsOf(recycle, K, &same));
  if (!same) {
    if (!recycle->held || recycle->negative) PetscCall(RecycleSetUpFree(tao, recycle, K, possible));
    if (recycle->held || !*possible) PetscCall(IPRecycleHold(tao, recycle, possible));
  }
  recycle->K_id    = ((PetscObject)K)->id;
  recycle->K_state = state;
  PetscCall(PetscLogEventBegin(TAO_IPFilterDirections, tao, NULL, NULL, NULL));
  PetscCall(IPBasisUpdate(&recycle->basis, K, (PetscBool)!same, ip->fixed, IPSubspaceOf(tao)->W));
  PetscCall(IPModesAppend(tao, recycle));
  PetscCall(PetscLogEventEnd(TAO_IPFilterDirections, tao, NULL, NULL, NULL));
  PetscFunctionReturn(0);
}
