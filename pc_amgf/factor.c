/*
   Uses a Cholesky factorization of the operator instead of the AMG, if this is estimated to be faster for the expected
   number of applications. MUMPS computes it. On one rank, if the choice is automatic, the factorization of cholesky/ is
   used: a solve with it takes half the time. The estimate uses the operation counts of the symbolic factorization and
   fixed rates, not measured times, so that repeated runs choose the same solver.
*/
#define _POSIX_C_SOURCE 200809L /* declares clock_gettime() */
#include "amgfimpl.h"
#include "solver_types.h"
#include "mumps.h"
#include <petscblaslapack.h>
#include <time.h>

const char *const PCAMGFFactorUses[] = {"false", "true", "auto", "PCAMGFFactorUse", "PC_AMGF_FACTOR_", NULL};

PetscErrorCode PCAMGFFactorReset_Private(AMGFFactor *f)
{
  PetscFunctionBegin;
  PetscCall(MatDestroy(&f->F));
  f->analysed = (AMGFStamp){.id = 0};
  f->on = f->own = PETSC_FALSE;
  PetscFunctionReturn(0);
}

/*
   Gets the operator in a format that MUMPS can factor by Cholesky; *taken is NULL if there is none. A BAIJ matrix is
   copied to AIJ, and the copy is marked as positive definite. Otherwise *taken is a reference to A.
*/
static PetscErrorCode FactorTakeMatrix(Mat A, Mat *taken)
{
  PetscBool baij, mumps;
  MatType   type;

  PetscFunctionBegin;
  *taken = NULL;
  if (PetscDefined(USE_COMPLEX)) PetscFunctionReturn(0);
  PetscCall(PetscObjectBaseTypeCompareAny((PetscObject)A, &baij, MATSEQBAIJ, MATMPIBAIJ, ""));
  if (baij) {
    PetscCall(MatConvert(A, MATAIJ, MAT_INITIAL_MATRIX, taken));
    PetscCall(MatSetOption(*taken, MAT_SPD, PETSC_TRUE));
  } else {
    PetscCall(PetscObjectReference((PetscObject)A));
    *taken = A;
  }
  PetscCall(MatGetType(*taken, &type));
  PetscCall(AMGFMumpsFactors(type, MAT_FACTOR_CHOLESKY, &mumps));
  if (!mumps) PetscCall(MatDestroy(taken));
  PetscFunctionReturn(0);
}

/* Finds whether the factorization of cholesky/ is tried first: on one rank, if the choice is automatic */
static PetscErrorCode FactorMayBeOwn(PC pc, PetscBool *own)
{
  PetscMPIInt size;

  PetscFunctionBegin;
  PetscCallMPI(MPI_Comm_size(PetscObjectComm((PetscObject)pc), &size));
  PetscCall(PetscObjectBaseTypeCompareAny((PetscObject)pc->pmat, own, MATSEQAIJ, MATSEQBAIJ, MATSEQSBAIJ, ""));
  if (PetscDefined(USE_COMPLEX) || size > 1 || ((PC_AMGF *)pc->data)->factor.use != PC_AMGF_FACTOR_AUTO)
    *own = PETSC_FALSE;
  PetscFunctionReturn(0);
}

/*
   Finds the pattern of the factors of cholesky/, and stores their costs in the PC. They are rounded to single precision
   if they do not fit into the cache.
*/
static PetscErrorCode FactorAnalyseOwn(PC pc)
{
  const PetscReal cached = 1e6; /* entries of factors in double precision that fit into the cache */
  AMGFFactor     *f      = &((PC_AMGF *)pc->data)->factor;
  MatFactorInfo   info;
  PetscBool       single;

  PetscFunctionBegin;
  PetscCall(MatDestroy(&f->F));
  f->own = PETSC_TRUE;
  PetscCall(MatGetFactor(pc->pmat, MATSOLVERAMGF, MAT_FACTOR_CHOLESKY, &f->F));
  PetscCall(MatFactorInfoInitialize(&info));
  PetscCall(MatCholeskyFactorSymbolic(f->F, pc->pmat, NULL, &info));
  PetscCall(MatGetStamp_AMGF(pc->pmat, &f->analysed));
  PetscUseMethod(f->F, AMGF_CHOLESKY_GET_COSTS, (Mat, PetscReal *, PetscReal *, PetscReal *),
    (f->F, &f->flops, &f->entries, &f->memory));
  single = (PetscBool)(f->entries > cached);
  f->memory += f->entries * (single ? sizeof(float) : sizeof(PetscReal));
  PetscUseMethod(f->F, AMGF_CHOLESKY_SET_SINGLE, (Mat, PetscBool), (f->F, single));
  PetscFunctionReturn(0);
}

/*
   Lets MUMPS analyse the pattern of A, and stores its estimates in the PC: operations, entries and memory of the
   factors. If the analysis fails, they are infinite.
*/
static PetscErrorCode FactorAnalyse(PC pc, Mat A)
{
  AMGFFactor    *f = &((PC_AMGF *)pc->data)->factor;
  MatFactorInfo  info;
  MatFactorError error;
  const char    *prefix;
  PetscInt       entries, memory;

  PetscFunctionBegin;
  PetscCall(MatDestroy(&f->F));
  f->own = PETSC_FALSE;
  PetscCall(MatGetFactor(A, MATSOLVERMUMPS, MAT_FACTOR_CHOLESKY, &f->F));
  PetscCall(PCGetOptionsPrefix(pc, &prefix));
  PetscCall(MatSetOptionsPrefix(f->F, prefix));
  PetscCall(MatAppendOptionsPrefix(f->F, "amgf_factor_"));
  PetscCall(MatFactorInfoInitialize(&info));
  PetscCall(MatCholeskyFactorSymbolic(f->F, A, NULL, &info));
  PetscCall(MatFactorGetError(f->F, &error));
  PetscCall(MatGetStamp_AMGF(pc->pmat, &f->analysed));
  PetscCall(AMGFMumpsGetRinfog(f->F, 1, &f->flops));
  PetscCall(AMGFMumpsGetInfog(f->F, 20, &entries));
  PetscCall(AMGFMumpsGetInfog(f->F, 17, &memory));
  f->entries =
    entries < 0 ? -1e6 * entries : (PetscReal)entries; /* MUMPS returns counts beyond the integer range as negative
                                                          numbers of millions */
  f->memory = 1e6 * memory;
  if (error) f->flops = f->entries = f->memory = PETSC_INFINITY;
  PetscFunctionReturn(0);
}

/* Returns the CPU time of the calling thread [s], which does not include waiting or other threads */
static PetscReal FactorThreadTime(void)
{
  struct timespec now;

  (void)clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return (PetscReal)now.tv_sec + 1e-9 * (PetscReal)now.tv_nsec;
}

/*
   Determines the rate of a factorization [operations/s]: one of two constants, for an optimized BLAS or for the
   reference BLAS. A matrix product is timed only to tell the two apart; the reference BLAS takes about ten times as
   long.
*/
static PetscErrorCode FactorFindRate(PC pc, PetscReal *rate)
{
  const PetscBLASInt n   = 192;
  const PetscScalar  one = 1.0, zero = 0.0;
  /* rates [operations/s]: threshold between the two kinds of BLAS; rate of an optimized and of the reference BLAS */
  const PetscReal threshold = 4e9, tuned = 2.7e10, reference = 1.2e9;
  PetscScalar    *a, *c;
  PetscReal       best = 0.0;

  PetscFunctionBegin;
  PetscCall(PetscCalloc2(n * n, &a, n * n, &c));
  for (PetscInt k = 0; k < 4; k++) {
    const PetscReal start = FactorThreadTime();

    PetscCallBLAS("BLASgemm", BLASgemm_("N", "T", &n, &n, &n, &one, a, &n, a, &n, &zero, c, &n));
    best = PetscMax(best, 2.0 * n * n * n / PetscMax(FactorThreadTime() - start, 1e-6));
  }
  PetscCall(PetscFree2(a, c));
  *rate = best > threshold ? tuned : reference;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, rate, 1, MPIU_REAL, MPIU_MIN, PetscObjectComm((PetscObject)pc)));
  PetscFunctionReturn(0);
}

/*
   Estimates the times of both solvers on this number of ranks [s]. built: whether the AMG is already set up, so that
   its set-up costs nothing. The constants are fitted to runs of elastic bodies with 2,000 to 200,000 unknowns on one
   core; ranks are assumed to share the work equally. An application of either includes the caller's work: a product
   with the operator, the orthogonalization of a direction, and its work for contact, which does not depend on the size.
   The analysis of the factorization is done already.
*/
static PetscErrorCode FactorEstimate(PC pc, PetscBool built, AMGFCosts *costs)
{
  const PC_AMGF    *amgf   = (PC_AMGF *)pc->data;
  const AMGFFactor *f      = &amgf->factor;
  const PetscReal   setup  = 1e-7;                    /* time of the AMG set-up per entry of the matrix [s] */
  const PetscReal   single = 5.5e-10, other = 1e-8;   /* time of one AMG application per entry of the matrix [s]:
                                                           PCBLOCKAMG; BoomerAMG */
  const PetscReal   product = 1.3e-9, contact = 1e-3; /* time of the caller's work [s]: per entry of the matrix;
                                                           per application */
  const PetscReal   cached    = 1e7;                  /* entries beyond which the matrix does not fit into the
                                                           cache: with far more entries the time per entry doubles */
  const PetscReal   factor[2] = {4e-8, 5.5e-9};       /* time per entry of the factors [s], by MUMPS and by */
  const PetscReal   solve[2]  = {3.3e-9, 5e-10};      /* cholesky/: factorization; one solve */
  const PetscReal   held      = 1e7;                  /* the same for the entries of the factors and a solve */
  MatInfo           info;
  PetscReal         rate, caller;
  PetscBool         half, block;

  PetscFunctionBegin;
  PetscCall(MatGetInfo(pc->pmat, MAT_GLOBAL_SUM, &info));
  PetscCall(PetscObjectBaseTypeCompareAny((PetscObject)pc->pmat, &half, MATSEQSBAIJ, MATMPISBAIJ, ""));
  if (half) info.nz_used *= 2.0;
  PetscCall(PetscObjectTypeCompare((PetscObject)amgf->amg, PCBLOCKAMG, &block));
  PetscCall(FactorFindRate(pc, &rate));
  caller        = contact + product * info.nz_used;
  costs->factor = factor[f->own] * f->entries + f->flops / rate;
  costs->solve  = solve[f->own] * f->entries * (1.0 + f->entries / (f->entries + held)) + caller;
  costs->setup  = built ? 0.0 : setup * info.nz_used;
  costs->apply  = (block ? single : other) * info.nz_used * (1.0 + info.nz_used / (info.nz_used + cached)) + caller;
  PetscFunctionReturn(0);
}

/*
   Decides for -pc_amgf_factor auto. *cheaper: the factorization fits into memory, and one factorization with `solves`
   solves takes less time than `applications` applications of the AMG. f->why gets the explanation.
*/
static PetscErrorCode FactorCompare(PC pc, PetscReal applications, PetscReal solves, PetscBool *cheaper)
{
  PC_AMGF    *amgf  = (PC_AMGF *)pc->data;
  AMGFFactor *f     = &amgf->factor;
  AMGFCosts   costs = {0.0, 0.0, 0.0, 0.0};
  PetscReal   factor, amg, available;

  PetscFunctionBegin;
  PetscCall(PCAMGFGetMemory_Private(PetscObjectComm((PetscObject)pc), &available));
  available *= f->fraction;
  PetscCall(FactorEstimate(pc, amgf->lag.built, &costs));
  factor   = costs.factor + solves * costs.solve;
  amg      = costs.setup + applications * costs.apply;
  *cheaper = (PetscBool)(f->memory < available && factor < amg);
  if (f->memory >= available)
    PetscCall(
      PetscSNPrintf(f->why, sizeof(f->why), "a factorization would take %.0f MB, more than %g of the machine's memory",
        (double)(f->memory / 1e6), (double)f->fraction));
  else
    PetscCall(PetscSNPrintf(f->why, sizeof(f->why), "estimated %.2g s instead of %.2g s with %s",
      (double)(*cheaper ? factor : amg), (double)(*cheaper ? amg : factor), *cheaper ? "AMG" : "a factorization"));
  PetscFunctionReturn(0);
}

/*
   Chooses B for the present operator. applications: expected number of AMG applications; solves: expected number of
   solves if B is the factorization. Does nothing unless the choice is automatic and still open.
*/
static PetscErrorCode FactorExpect(PC pc, PetscReal applications, PetscReal solves)
{
  PC_AMGF        *amgf    = (PC_AMGF *)pc->data;
  AMGFFactor     *f       = &amgf->factor;
  const PetscReal largest = 5e5; /* number of unknowns above which the analysis alone takes minutes, and as much
                                    memory as the AMG */
  PetscBool       own;
  AMGFStamp       now;
  PetscInt        n;
  Mat             A;

  PetscFunctionBegin;
  if (f->use != PC_AMGF_FACTOR_AUTO || f->on || f->failed) PetscFunctionReturn(0);
  PetscCall(MatGetSize(pc->pmat, &n, NULL));
  if (n > largest) PetscFunctionReturn(0);
  PetscCall(MatGetStamp_AMGF(pc->pmat, &now));
  if (!AMGFStampSamePattern(&now, &f->analysed)) {
    PetscCall(FactorMayBeOwn(pc, &own));
    if (own) PetscCall(FactorAnalyseOwn(pc));
    else {
      PetscCall(FactorTakeMatrix(pc->pmat, &A));
      if (!A) PetscFunctionReturn(0);
      PetscCall(FactorAnalyse(pc, A));
      PetscCall(MatDestroy(&A));
    }
  }
  PetscCall(FactorCompare(pc, applications, solves, &f->on));
  if (!f->on) PetscCall(MatDestroy(&f->F)); /* only the estimates of the analysis are kept */
  else amgf->lag.built = PETSC_FALSE;
  PetscFunctionReturn(0);
}

/*
   Computes the numerical factorization. While MUMPS reports too little work space, the factorization is repeated with
   more. *error: the same on all ranks.
*/
static PetscErrorCode FactorNumerically(Mat F, Mat A, MatFactorError *error)
{
  PetscInt      relaxation = 0;
  MatFactorInfo info;

  PetscFunctionBegin;
  PetscCall(MatFactorInfoInitialize(&info));
  *error = MAT_FACTOR_OUTMEMORY;
  while (*error == MAT_FACTOR_OUTMEMORY && AMGFMumpsMoreSpace(AMGF_MUMPS_RELAXATION, &relaxation)) {
    PetscCall(AMGFMumpsSetIcntl(F, 14, relaxation));
    PetscCall(MatCholeskyFactorNumeric(F, A, &info));
    PetscCall(MatFactorGetError(F, error));
    PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, error, 1, MPI_INT, MPI_MAX, PetscObjectComm((PetscObject)A)));
  }
  PetscFunctionReturn(0);
}

/* Factors the operator by the factorization of cholesky/. *factored: false if the operator is not positive definite */
static PetscErrorCode FactorOwn(PC pc, PetscBool *factored)
{
  AMGFFactor    *f = &((PC_AMGF *)pc->data)->factor;
  MatFactorError error;
  MatFactorInfo  info;
  AMGFStamp      now;

  PetscFunctionBegin;
  PetscCall(MatGetStamp_AMGF(pc->pmat, &now));
  if (!f->F || !f->own || !AMGFStampSamePattern(&now, &f->analysed)) PetscCall(FactorAnalyseOwn(pc));
  PetscCall(MatFactorInfoInitialize(&info));
  PetscCall(MatCholeskyFactorNumeric(f->F, pc->pmat, &info));
  PetscCall(MatFactorGetError(f->F, &error));
  *factored = (PetscBool)!error;
  if (!*factored) PetscCall(MatDestroy(&f->F));
  f->own = *factored;
  PetscFunctionReturn(0);
}

/* PCAMGFFactorSetUp_Private - factors the operator; f->failed tells whether that failed */
PetscErrorCode PCAMGFFactorSetUp_Private(PC pc)
{
  PC_AMGF       *amgf  = (PC_AMGF *)pc->data;
  AMGFFactor    *f     = &amgf->factor;
  MatFactorError error = MAT_FACTOR_OTHER;
  PetscBool      own   = PETSC_FALSE;
  AMGFStamp      now;
  Mat            A;

  PetscFunctionBegin;
  PetscCall(PCReset(amgf->amg));
  PetscCall(FactorMayBeOwn(pc, &own));
  if (own) PetscCall(FactorOwn(pc, &own));
  f->failed = PETSC_FALSE;
  if (own) PetscFunctionReturn(0);
  PetscCall(FactorTakeMatrix(pc->pmat, &A));
  PetscCheck(A, PetscObjectComm((PetscObject)pc), PETSC_ERR_SUP,
    "-pc_amgf_factor needs real scalars, MUMPS, and an operator of type AIJ, BAIJ or SBAIJ");
  PetscCall(MatGetStamp_AMGF(pc->pmat, &now));
  if (!f->F || f->own || !AMGFStampSamePattern(&now, &f->analysed)) PetscCall(FactorAnalyse(pc, A));
  if (f->flops < PETSC_INFINITY) PetscCall(FactorNumerically(f->F, A, &error));
  PetscCall(PetscInfo(pc, "Cholesky factorization instead of the AMG failed with error %d\n", (int)error));
  f->failed = (PetscBool)(error != MAT_FACTOR_NOERROR);
  if (f->failed) PetscCall(MatDestroy(&f->F)); /* MUMPS does not factor again after it has failed */
  PetscCall(MatDestroy(&A));
  PetscFunctionReturn(0);
}

PetscErrorCode PCAMGFSetFactor_AMGF(PC pc, PCAMGFFactorUse use)
{
  AMGFFactor *f = &((PC_AMGF *)pc->data)->factor;

  PetscFunctionBegin;
  PetscCheck(use >= PC_AMGF_FACTOR_FALSE && use <= PC_AMGF_FACTOR_AUTO, PetscObjectComm((PetscObject)pc),
    PETSC_ERR_ARG_OUTOFRANGE, "%d is not a value of PCAMGFFactorUse", (int)use);
  if (use != PC_AMGF_FACTOR_AUTO) f->why[0] = '\0';
  if (f->on && use == PC_AMGF_FACTOR_FALSE) {
    PetscCall(PCAMGFFactorReset_Private(f));
    ((PC_AMGF *)pc->data)->lag.built = PETSC_FALSE;
  }
  if (use != f->use) pc->setupcalled = 0;
  f->use = use;
  PetscFunctionReturn(0);
}

PetscErrorCode PCAMGFExpect_AMGF(PC pc, PetscReal applications, PetscReal solves)
{
  AMGFFactor     *f  = &((PC_AMGF *)pc->data)->factor;
  const PetscBool on = f->on;

  PetscFunctionBegin;
  PetscCheck(pc->pmat, PetscObjectComm((PetscObject)pc), PETSC_ERR_ORDER,
    "Call PCSetOperators() or KSPSetOperators() before PCAMGFExpect(), which estimates the time of a factorization");
  PetscCheck(applications >= 0.0 && solves >= 0.0, PetscObjectComm((PetscObject)pc), PETSC_ERR_ARG_OUTOFRANGE,
    "The expected numbers of applications must not be negative: %g and %g", (double)applications, (double)solves);
  PetscCall(PCAMGFConfigureInner_Private(pc)); /* The costs depend on which AMG would be used. */
  PetscCall(FactorExpect(pc, applications, solves));
  if (f->on != on) pc->setupcalled = 0;
  PetscFunctionReturn(0);
}

PetscErrorCode PCAMGFGetFactored_AMGF(PC pc, PetscBool *factored, const char *why[])
{
  AMGFFactor *f = &((PC_AMGF *)pc->data)->factor;

  PetscFunctionBegin;
  *factored = f->on;
  if (why) *why = f->why;
  PetscFunctionReturn(0);
}

/*@
  PCAMGFSetFactor - Sets whether a Cholesky factorization of the operator replaces the AMG

  Logically Collective

  Input Parameters:
+ pc  - the preconditioner
- use - `PC_AMGF_FACTOR_FALSE` (default), `PC_AMGF_FACTOR_TRUE` or `PC_AMGF_FACTOR_AUTO`

  Options Database Keys:
+ -pc_amgf_factor <false>     - `false`, `true` or `auto`
- -pc_amgf_factor_share <0.4> - auto: largest fraction of the memory of the ranks' machines (or of the limit of their
                                control groups) that the factors may need, as estimated by MUMPS

  Level: intermediate

  Notes:
  Real scalars only. If the factorization fails, the set-up of the preconditioner fails. With `auto` the AMG is used
  until `PCAMGFExpect()` gives the number of applications.

.seealso: `PCAMGF`, `PCAMGFFactorUse`, `PCAMGFExpect()`, `PCAMGFGetFactored()`
@*/
PetscErrorCode PCAMGFSetFactor(PC pc, PCAMGFFactorUse use)
{
  PetscFunctionBegin;
  PetscValidHeaderSpecific(pc, PC_CLASSID, 1);
  PetscValidLogicalCollectiveEnum(pc, use, 2);
  PetscTryMethod(pc, "PCAMGFSetFactor_C", (PC, PCAMGFFactorUse), (pc, use));
  PetscFunctionReturn(0);
}

/*@
  PCAMGFExpect - Sets how often the preconditioner of the present operator will be applied, so that
  `PC_AMGF_FACTOR_AUTO` can choose

  Collective

  Input Parameters:
+ pc           - the preconditioner, with its operators
. applications - expected number of applications, if the AMG is used
- solves       - expected number of applications, if the factorization is used

  Level: advanced

  Notes:
  MUMPS computes the factorization, but on one rank with `PC_AMGF_FACTOR_AUTO` the factorization of pc_amgf/cholesky.
  The cost of the factorization is estimated from its symbolic part, which gives floating-point operations, entries and
  memory. The cost of the AMG is estimated from the number of entries of the operator.

  Call this function before the first `PCSetUp()`, and again if the expected numbers change. The next `PCSetUp()` may
  then replace the AMG by a factorization. A factorization is not replaced by the AMG as long as the nonzero pattern of
  the operator stays the same. Operators of more than 500,000 unknowns always use the AMG.

.seealso: `PCAMGF`, `PCAMGFSetFactor()`, `PCAMGFGetFactored()`
@*/
PetscErrorCode PCAMGFExpect(PC pc, PetscReal applications, PetscReal solves)
{
  PetscFunctionBegin;
  PetscValidHeaderSpecific(pc, PC_CLASSID, 1);
  PetscValidLogicalCollectiveReal(pc, applications, 2);
  PetscValidLogicalCollectiveReal(pc, solves, 3);
  PetscTryMethod(pc, "PCAMGFExpect_C", (PC, PetscReal, PetscReal), (pc, applications, solves));
  PetscFunctionReturn(0);
}

/*@C
  PCAMGFGetFactored - Gets whether a factorization replaces the AMG

  Not Collective

  Input Parameter:
. pc - the preconditioner, of type `PCAMGF`

  Output Parameters:
+ factored - whether a factorization is used
- why      - one sentence on the last automatic choice, owned by `pc`; empty if there was none; may be NULL

  Level: intermediate

.seealso: `PCAMGF`, `PCAMGFSetFactor()`, `PCAMGFExpect()`
@*/
PetscErrorCode PCAMGFGetFactored(PC pc, PetscBool *factored, const char *why[])
{
  PetscFunctionBegin;
  PetscValidHeaderSpecific(pc, PC_CLASSID, 1);
  PetscAssertPointer(factored, 2);
  PetscUseMethod(pc, "PCAMGFGetFactored_C", (PC, PetscBool *, const char **), (pc, factored, why));
  PetscFunctionReturn(0);
}
