/* Public functions of PCAMGF and their implementations, which act on the PC's data only */
#include "amgfimpl.h"
#include "functions.h"

const char *const PCAMGFCycles[] = {"bfb", "fbf", "additive", "PCAMGFCycle", "PC_AMGF_", NULL};

/* Makes the next PCSetUp() look up the subspace again, even if the operator is unchanged */
static void PCAMGFRequestSetUp_Private(PC pc)
{
  pc->setupcalled = 0;
}

static PetscErrorCode PCAMGFSetCycle_AMGF(PC pc, PCAMGFCycle cycle)
{
  PetscFunctionBegin;
  PetscCheck(cycle >= PC_AMGF_BFB && cycle <= PC_AMGF_ADDITIVE, PetscObjectComm((PetscObject)pc),
    PETSC_ERR_ARG_OUTOFRANGE, "Unknown cycle %d", (int)cycle);
  ((PC_AMGF *)pc->data)->cycle = cycle;
  PetscFunctionReturn(0);
}

static PetscErrorCode PCAMGFSetFilterIS_AMGF(PC pc, IS is)
{
  PC_AMGF *amgf = (PC_AMGF *)pc->data;

  PetscFunctionBegin;
  if (is) PetscCall(PetscObjectReference((PetscObject)is));
  PetscCall(ISDestroy(&amgf->set_is));
  PetscCall(MatDestroy(&amgf->set_P));
  amgf->set_is = is;
  PCAMGFRequestSetUp_Private(pc);
  PetscFunctionReturn(0);
}

static PetscErrorCode PCAMGFSetFilterInterpolation_AMGF(PC pc, Mat P)
{
  PC_AMGF *amgf = (PC_AMGF *)pc->data;

  PetscFunctionBegin;
  if (P) PetscCall(PetscObjectReference((PetscObject)P));
  PetscCall(ISDestroy(&amgf->set_is));
  PetscCall(MatDestroy(&amgf->set_P));
  amgf->set_P = P;
  PCAMGFRequestSetUp_Private(pc);
  PetscFunctionReturn(0);
}

static PetscErrorCode PCAMGFGetFilterSize_AMGF(PC pc, PetscInt *n)
{
  PetscFunctionBegin;
  *n = ((PC_AMGF *)pc->data)->sub.n;
  PetscFunctionReturn(0);
}

static PetscErrorCode PCAMGFSetFilterActive_AMGF(PC pc, PetscBool active)
{
  PC_AMGF *amgf = (PC_AMGF *)pc->data;

  PetscFunctionBegin;
  if (active != amgf->active) PCAMGFRequestSetUp_Private(pc);
  amgf->active = active;
  PetscFunctionReturn(0);
}

static PetscErrorCode PCAMGFSetFilterOptional_AMGF(PC pc, PetscBool optional)
{
  PetscFunctionBegin;
  ((PC_AMGF *)pc->data)->optional = optional;
  PetscFunctionReturn(0);
}

static PetscErrorCode PCAMGFSetAMGLag_AMGF(PC pc, PetscInt lag)
{
  PetscFunctionBegin;
  PetscCheck(lag >= AMGF_LAG_NEVER, PetscObjectComm((PetscObject)pc), PETSC_ERR_ARG_OUTOFRANGE,
    "The AMG lag must be -1 (never rebuild), 0 (automatic) or positive, not %" PetscInt_FMT, lag);
  ((PC_AMGF *)pc->data)->lag.every = lag;
  PetscFunctionReturn(0);
}

static PetscErrorCode PCAMGFGetAMGAge_AMGF(PC pc, PetscInt *age)
{
  PetscFunctionBegin;
  *age = ((PC_AMGF *)pc->data)->lag.age;
  PetscFunctionReturn(0);
}

static PetscErrorCode PCAMGFGetAMGPC_AMGF(PC pc, PC *amg)
{
  PetscFunctionBegin;
  PetscCall(PCAMGFPrefixInner_Private(pc));
  *amg = ((PC_AMGF *)pc->data)->amg;
  PetscFunctionReturn(0);
}

static PetscErrorCode PCAMGFGetFilterKSP_AMGF(PC pc, KSP *ksp)
{
  PetscFunctionBegin;
  PetscCall(PCAMGFPrefixInner_Private(pc));
  *ksp = ((PC_AMGF *)pc->data)->filter;
  PetscFunctionReturn(0);
}

static PetscErrorCode PCAMGFGetCounts_AMGF(PC pc, PCAMGFCounts *counts)
{
  PetscFunctionBegin;
  *counts = ((PC_AMGF *)pc->data)->counts;
  PetscFunctionReturn(0);
}

static const AMGFFunction functions[] = {
  AMGF_FUNCTION(PCAMGFSetCycle, AMGF),
  AMGF_FUNCTION(PCAMGFSetFilterIS, AMGF),
  AMGF_FUNCTION(PCAMGFSetFilterInterpolation, AMGF),
  AMGF_FUNCTION(PCAMGFGetFilterSize, AMGF),
  AMGF_FUNCTION(PCAMGFSetFilterActive, AMGF),
  AMGF_FUNCTION(PCAMGFSetFilterOptional, AMGF),
  AMGF_FUNCTION(PCAMGFSetAMGLag, AMGF),
  AMGF_FUNCTION(PCAMGFGetAMGAge, AMGF),
  AMGF_FUNCTION(PCAMGFGetAMGPC, AMGF),
  AMGF_FUNCTION(PCAMGFGetFilterKSP, AMGF),
  AMGF_FUNCTION(PCAMGFGetFilterPivots, AMGF),
  AMGF_FUNCTION(PCAMGFGetCounts, AMGF),
  AMGF_FUNCTION(PCAMGFSetFactor, AMGF),
  AMGF_FUNCTION(PCAMGFGetFactored, AMGF),
  AMGF_FUNCTION(PCAMGFReconsiderFactor, AMGF),
  AMGF_FUNCTION(PCAMGFApplyProduct, AMGF),
};

/* Composes the implementations of the public functions with the PC, or removes them if `attach` is false */
PetscErrorCode PCAMGFComposeFunctions_Private(PC pc, PetscBool attach)
{
  PetscFunctionBegin;
  PetscCall(AMGFComposeFunctions((PetscObject)pc, PETSC_STATIC_ARRAY_LENGTH(functions), functions, attach));
  PetscFunctionReturn(0);
}

/*@
  PCAMGFSetCycle - Sets the order in which the AMG and the subspace solve are combined

  Logically Collective

  Input Parameters:
+ pc    - the preconditioner
- cycle - `PC_AMGF_BFB`, `PC_AMGF_FBF` (default) or `PC_AMGF_ADDITIVE`

  Options Database Key:
. -pc_amgf_cycle <fbf> - `bfb`, `fbf` or `additive`

  Level: intermediate

  Note:
  `PC_AMGF_BFB` is positive definite only while A < 2 B^-1, which an AMG built from an older operator need not
  satisfy; see `PCAMGFSetAMGLag()`.

.seealso: `PCAMGF`, `PCAMGFCycle`
@*/
PetscErrorCode PCAMGFSetCycle(PC pc, PCAMGFCycle cycle)
{
  PetscFunctionBegin;
  PetscValidHeaderSpecific(pc, PC_CLASSID, 1);
  PetscValidLogicalCollectiveEnum(pc, cycle, 2);
  PetscTryMethod(pc, "PCAMGFSetCycle_C", (PC, PCAMGFCycle), (pc, cycle));
  PetscFunctionReturn(0);
}

/*@
  PCAMGFSetFilterIS - Sets the unknowns that are solved exactly

  Logically Collective

  Input Parameters:
+ pc - the preconditioner
- is - global row numbers of the operator; NULL removes the set of an earlier call

  Options Database Keys:
+ -pc_amgf_filter_file <file> - binary file that `ISLoad()` reads the set from at the first `PCSetUp()`; by default none
- -pc_amgf_detect <0>         - at every set-up, the unknowns whose diagonal entry exceeds this many times the median
                                of the positive diagonal entries; 0: off

  Level: intermediate

  Notes:
  The set is the union over all ranks. Entries may repeat, need no order, and may be rows of other ranks. The
  communicator of `is` is therefore the operator's or `PETSC_COMM_SELF`. `is` is referenced, not copied. A row number
  outside the operator is an error of `PCSetUp()`.

  The set takes precedence over an object composed on the operator, then a file, then detection. It replaces a
  `Mat` set by `PCAMGFSetFilterInterpolation()`.

  If the set of unknowns and the operator's nonzero pattern do not change, the symbolic factorization is reused.

.seealso: `PCAMGF`, `PCAMGFSetFilterInterpolation()`, `PCAMGFGetFilterSize()`
@*/
PetscErrorCode PCAMGFSetFilterIS(PC pc, IS is)
{
  PetscFunctionBegin;
  PetscValidHeaderSpecific(pc, PC_CLASSID, 1);
  if (is) PetscValidHeaderSpecific(is, IS_CLASSID, 2);
  PetscTryMethod(pc, "PCAMGFSetFilterIS_C", (PC, IS), (pc, is));
  PetscFunctionReturn(0);
}

/*@
  PCAMGFSetFilterInterpolation - Sets the subspace that is solved exactly as the range of a matrix

  Logically Collective

  Input Parameters:
+ pc - the preconditioner
- P  - matrix (n x n_c) of full column rank with the row layout of the operator; NULL removes that of an earlier call

  Level: intermediate

  Notes:
  `P` is referenced, not copied; a matrix of another type than `MATAIJ` is converted. Work and memory grow with the
  number of rows in which `P` is nonzero.

  `P` takes precedence over an object composed on the operator, then a file, then detection. It replaces an `IS` set by
  `PCAMGFSetFilterIS()`.

.seealso: `PCAMGF`, `PCAMGFSetFilterIS()`, `PCAMGFGetFilterSize()`
@*/
PetscErrorCode PCAMGFSetFilterInterpolation(PC pc, Mat P)
{
  PetscFunctionBegin;
  PetscValidHeaderSpecific(pc, PC_CLASSID, 1);
  if (P) PetscValidHeaderSpecific(P, MAT_CLASSID, 2);
  PetscTryMethod(pc, "PCAMGFSetFilterInterpolation_C", (PC, Mat), (pc, P));
  PetscFunctionReturn(0);
}

/*@
  PCAMGFGetFilterSize - Gets the global dimension n_c of the subspace that is solved exactly

  Not Collective

  Input Parameter:
. pc - the preconditioner, of type `PCAMGF`

  Output Parameter:
. n - dimension at the last `PCSetUp()` with the filter on; 0 before it, and if there is no subspace

  Level: intermediate

.seealso: `PCAMGF`, `PCAMGFSetFilterIS()`, `PCAMGFSetFilterInterpolation()`
@*/
PetscErrorCode PCAMGFGetFilterSize(PC pc, PetscInt *n)
{
  PetscFunctionBegin;
  PetscValidHeaderSpecific(pc, PC_CLASSID, 1);
  PetscAssertPointer(n, 2);
  PetscUseMethod(pc, "PCAMGFGetFilterSize_C", (PC, PetscInt *), (pc, n));
  PetscFunctionReturn(0);
}

/*@
  PCAMGFSetFilterActive - Switches the subspace solve off or on; without it only the AMG is applied

  Logically Collective

  Input Parameters:
+ pc     - the preconditioner
- active - `PETSC_FALSE`: the preconditioner is the AMG alone; `PETSC_TRUE` (default): the cycle of `PCAMGFSetCycle()`

  Level: intermediate

  Notes:
  Some operators need no filter. While it is off, the subspace is not determined, set up or solved.
  Earlier set-ups are kept: when the filter is switched on again and subspace and nonzero pattern have not changed, the
  symbolic factorization is reused.

  `PCAMGFGetFilterSize()` gives the dimension of the last set-up with the filter on.

.seealso: `PCAMGF`, `PCAMGFSetFilterIS()`, `PCAMGFGetFilterSize()`, `PCAMGFGetCounts()`
@*/
PetscErrorCode PCAMGFSetFilterActive(PC pc, PetscBool active)
{
  PetscFunctionBegin;
  PetscValidHeaderSpecific(pc, PC_CLASSID, 1);
  PetscValidLogicalCollectiveBool(pc, active, 2);
  PetscTryMethod(pc, "PCAMGFSetFilterActive_C", (PC, PetscBool), (pc, active));
  PetscFunctionReturn(0);
}

/*@
  PCAMGFSetFilterOptional - Sets whether a set-up without a subspace is intended

  Logically Collective

  Input Parameters:
+ pc       - the preconditioner
- optional - `PETSC_FALSE` (default): the first set-up without a given or detected subspace prints a warning to the
             standard error stream; `PETSC_TRUE`: no warning

  Level: intermediate

  Note:
  This is for programs that use `PCAMGF` for operators with and without a stiff part. There is never a warning for a
  subspace that was given but is empty.

.seealso: `PCAMGF`, `PCAMGFSetFilterIS()`, `PCAMGFSetFilterActive()`
@*/
PetscErrorCode PCAMGFSetFilterOptional(PC pc, PetscBool optional)
{
  PetscFunctionBegin;
  PetscValidHeaderSpecific(pc, PC_CLASSID, 1);
  PetscValidLogicalCollectiveBool(pc, optional, 2);
  PetscTryMethod(pc, "PCAMGFSetFilterOptional_C", (PC, PetscBool), (pc, optional));
  PetscFunctionReturn(0);
}

/*@
  PCAMGFSetAMGLag - Sets how often the AMG is rebuilt when the operator changes

  Logically Collective

  Input Parameters:
+ pc  - the preconditioner
- lag - n > 0: at every n-th changed operator; -1: never again; 0: automatically

  Options Database Key:
. -pc_amgf_amg_lag <auto> - the lag; `auto` is 0; the cycle `bfb` has the default 1

  Level: intermediate

  Notes:
  The subspace solve always follows the operator. Default: 1 for `PC_AMGF_BFB`, which an outdated AMG can make
  indefinite; automatic for the other cycles.

  With automatic lag the AMG is rebuilt for the next changed operator if one of these has happened since it was built:
  a solve has failed; the Krylov iterations for the same residual reduction exceed 1.5 times those of the reference by
  more than two; a diagonal entry of the operator outside the subspace has changed by more than a factor of 1.5.

  The iterations are those of the `KSP` that owns the preconditioner. The reference is its first solve after the AMG was
  built. If the residual is not known, the total number of iterations is compared.

.seealso: `PCAMGF`, `PCAMGFSetCycle()`, `PCAMGFGetCounts()`
@*/
PetscErrorCode PCAMGFSetAMGLag(PC pc, PetscInt lag)
{
  PetscFunctionBegin;
  PetscValidHeaderSpecific(pc, PC_CLASSID, 1);
  PetscValidLogicalCollectiveInt(pc, lag, 2);
  PetscTryMethod(pc, "PCAMGFSetAMGLag_C", (PC, PetscInt), (pc, lag));
  PetscFunctionReturn(0);
}

/*@
  PCAMGFGetAMGAge - Gets the number of changed operators for which the AMG was used since it was built

  Not Collective

  Input Parameter:
. pc - the preconditioner, of type `PCAMGF`

  Output Parameter:
. age - 0: it was built from the present operator

  Level: advanced

.seealso: `PCAMGF`, `PCAMGFSetAMGLag()`
@*/
PetscErrorCode PCAMGFGetAMGAge(PC pc, PetscInt *age)
{
  PetscFunctionBegin;
  PetscValidHeaderSpecific(pc, PC_CLASSID, 1);
  PetscAssertPointer(age, 2);
  PetscUseMethod(pc, "PCAMGFGetAMGAge_C", (PC, PetscInt *), (pc, age));
  PetscFunctionReturn(0);
}

/*@
  PCAMGFGetAMGPC - Gets the inner preconditioner B

  Not Collective

  Input Parameter:
. pc - the preconditioner, of type `PCAMGF`

  Output Parameter:
. amg - the inner preconditioner; do not destroy it

  Options Database Key:
. -amgf_amg_pc_type <blockamg> - type of the inner preconditioner; the manual page of `PCAMGF` lists the cases with
                                 another default

  Level: advanced

  Note:
  If the caller sets a type, `PCAMGF` chooses neither type nor parameters of the inner preconditioner. Its options, with
  the prefix `-amgf_amg_`, are read at the first `PCSetUp()`.

.seealso: `PCAMGF`, `PCBLOCKAMG`, `PCAMGFGetFilterKSP()`
@*/
PetscErrorCode PCAMGFGetAMGPC(PC pc, PC *amg)
{
  PetscFunctionBegin;
  PetscValidHeaderSpecific(pc, PC_CLASSID, 1);
  PetscAssertPointer(amg, 2);
  PetscUseMethod(pc, "PCAMGFGetAMGPC_C", (PC, PC *), (pc, amg));
  PetscFunctionReturn(0);
}

/*@
  PCAMGFGetFilterKSP - Gets the solver of the system with P^T A P

  Not Collective

  Input Parameter:
. pc - the preconditioner, of type `PCAMGF`

  Output Parameter:
. ksp - the solver; do not destroy it

  Options Database Keys:
+ -amgf_filter_ksp_type <preonly> - type of the solver
- -amgf_filter_pc_type <cholesky> - type of its preconditioner; `lu` is the default with complex scalars

  Level: advanced

  Note:
  The default is `KSPPREONLY` with Cholesky, or with LU if scalars are complex. A type that the caller sets is kept. The
  options, with the prefix `-amgf_filter_`, are read at the first `PCSetUp()`.

.seealso: `PCAMGF`, `PCAMGFGetAMGPC()`
@*/
PetscErrorCode PCAMGFGetFilterKSP(PC pc, KSP *ksp)
{
  PetscFunctionBegin;
  PetscValidHeaderSpecific(pc, PC_CLASSID, 1);
  PetscAssertPointer(ksp, 2);
  PetscUseMethod(pc, "PCAMGFGetFilterKSP_C", (PC, KSP *), (pc, ksp));
  PetscFunctionReturn(0);
}

/*@
  PCAMGFGetCounts - Gets the numbers of set-ups and applications since the preconditioner was created

  Not Collective

  Input Parameter:
. pc - the preconditioner, of type `PCAMGF`

  Output Parameter:
. counts - numbers of set-ups and applications of the AMG and of the subspace solver

  Level: intermediate

  Note:
  `PCReset()` does not clear them.

.seealso: `PCAMGF`, `PCAMGFCounts`
@*/
PetscErrorCode PCAMGFGetCounts(PC pc, PCAMGFCounts *counts)
{
  PetscFunctionBegin;
  PetscValidHeaderSpecific(pc, PC_CLASSID, 1);
  PetscAssertPointer(counts, 2);
  PetscUseMethod(pc, "PCAMGFGetCounts_C", (PC, PCAMGFCounts *), (pc, counts));
  PetscFunctionReturn(0);
}
