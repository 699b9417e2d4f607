/* Uses factors of the operator instead of the AMG: always, or if the operator is small enough */
#include "amgfimpl.h"
#include "sparse_factors.h"

const char *const PCAMGFFactorUses[] = {"false", "true", "auto", "PCAMGFFactorUse", "PC_AMGF_FACTOR_", NULL};

/*
   Number of unknowns up to which `auto` factors the operator. Whole runs of contact of 12,000 to 13,000 unknowns take
   0.8 to 1.2 of the time with AMG, and one of 30,000 unknowns takes 1.4 of it.
*/
#define FACTOR_UNKNOWNS 15000

/*
   Later `auto` factors a larger operator when the AMG has been applied to it so often that a factorization would have
   taken about the same time. That time grows with the square of the fill, the entries of the factor divided by those of
   the operator's upper triangle. Measured are 180 applications for two thin leaves with a fill of 5.0, 110 for a ring
   with 5.7, and 510 for a bolted bracket with 9.3. With the largest fill a run needs twice the memory of the AMG.
   Factors with fewer than FACTOR_ENTRIES entries, 160 MB, are not limited. The fill is found by an analysis.
*/
#define FACTOR_ANALYSE      60  /* applications before the analysis */
#define FACTOR_APPLICATIONS 5.0 /* applications before the factorization, divided by the square of the fill */
#define FACTOR_FILL_MOST    12.0
#define FACTOR_ENTRIES      2e7

PetscErrorCode PCAMGFFactorReset_Private(AMGFFactor *f)
{
  PetscFunctionBegin;
  PetscCall(MatDestroy(&f->F));
  f->analysed = (AMGFStamp){.id = 0};
  f->on = f->failed = f->small = PETSC_FALSE;
  f->fill                      = 0.0;
  PetscFunctionReturn(0);
}

/* PCAMGFFactorIsUsed_Private - finds whether B is a factorization for the present operator */
PetscErrorCode PCAMGFFactorIsUsed_Private(PC pc, PetscBool *used)
{
  const AMGFFactor *f = &((PC_AMGF *)pc->data)->factor;
  PetscInt          n;

  PetscFunctionBegin;
  *used = (PetscBool)(f->use == PC_AMGF_FACTOR_TRUE);
  if (f->use != PC_AMGF_FACTOR_AUTO || f->failed || !pc->pmat || PetscDefined(USE_COMPLEX)) PetscFunctionReturn(0);
  PetscCall(MatGetSize(pc->pmat, &n, NULL));
  *used = (PetscBool)(f->small || n <= FACTOR_UNKNOWNS);
  PetscFunctionReturn(0);
}

/* PCAMGFFactorSetUp_Private - factors the operator; f->failed tells whether that failed */
PetscErrorCode PCAMGFFactorSetUp_Private(PC pc)
{
  PC_AMGF       *amgf = (PC_AMGF *)pc->data;
  AMGFFactor    *f    = &amgf->factor;
  MatFactorError error;
  AMGFStamp      now;
  const char    *prefix;
  char           own[PETSC_MAX_OPTION_NAME];

  PetscFunctionBegin;
  PetscCall(PCReset(amgf->amg));
  PetscCall(MatGetStamp_AMGF(pc->pmat, &now));
  if (!AMGFStampSamePattern(&now, &f->analysed)) PetscCall(MatDestroy(&f->F));
  f->analysed = now;
  PetscCall(PCGetOptionsPrefix(pc, &prefix));
  PetscCall(PetscSNPrintf(own, sizeof(own), "%samgf_factor_", prefix ? prefix : ""));
  PetscCall(AMGFSymmetricFactor(pc->pmat, own, &f->F, &f->negative, &error));
  f->failed = (PetscBool)(error != MAT_FACTOR_NOERROR);
  if (f->failed) PetscCall(MatDestroy(&f->F));
  if (f->failed) PetscCall(PetscInfo(pc, "Factorization instead of the AMG failed with error %d\n", (int)error));
  PetscFunctionReturn(0);
}

PetscErrorCode PCAMGFSetFactor_AMGF(PC pc, PCAMGFFactorUse use)
{
  PC_AMGF  *amgf = (PC_AMGF *)pc->data;
  PetscBool before, after;

  PetscFunctionBegin;
  PetscCheck(use >= PC_AMGF_FACTOR_FALSE && use <= PC_AMGF_FACTOR_AUTO, PetscObjectComm((PetscObject)pc),
    PETSC_ERR_ARG_OUTOFRANGE, "%d is not a value of PCAMGFFactorUse", (int)use);
  PetscCall(PCAMGFFactorIsUsed_Private(pc, &before));
  amgf->factor.use = use;
  PetscCall(PCAMGFFactorIsUsed_Private(pc, &after));
  if (before == after) PetscFunctionReturn(0);
  PetscCall(PCAMGFFactorReset_Private(&amgf->factor));
  amgf->lag.built = PETSC_FALSE;
  pc->setupcalled = 0;
  PetscFunctionReturn(0);
}

/* Finds the fill of the present operator's factor; infinite if the factor is too large */
static PetscErrorCode FactorFindFill(PC pc, AMGFFactor *f)
{
  MatInfo  info;
  PetscInt n;

  PetscFunctionBegin;
  PetscCall(MatDestroy(&f->F));
  PetscCall(MatGetStamp_AMGF(pc->pmat, &f->analysed));
  PetscCall(AMGFSymmetricFill(pc->pmat, NULL, &f->F, &f->fill));
  PetscCall(PetscInfo(pc, "The factor has %g times the entries of the operator's triangle\n", (double)f->fill));
  PetscCall(MatGetInfo(pc->pmat, MAT_GLOBAL_SUM, &info));
  PetscCall(MatGetSize(pc->pmat, &n, NULL));
  if (f->fill <= FACTOR_FILL_MOST || 0.5 * (info.nz_used + n) * f->fill <= FACTOR_ENTRIES) PetscFunctionReturn(0);
  f->fill = PETSC_INFINITY;
  PetscCall(MatDestroy(&f->F));
  PetscFunctionReturn(0);
}

PetscErrorCode PCAMGFReconsiderFactor_AMGF(PC pc, PetscBool *changed)
{
  PC_AMGF       *amgf = (PC_AMGF *)pc->data;
  AMGFFactor    *f    = &amgf->factor;
  const PetscInt n    = amgf->counts.amg_applies - f->applies;

  PetscFunctionBegin;
  *changed = PETSC_FALSE;
  if (f->use != PC_AMGF_FACTOR_AUTO || f->on || f->failed || n < FACTOR_ANALYSE) PetscFunctionReturn(0);
  if (f->fill == 0.0) PetscCall(FactorFindFill(pc, f));
  *changed = f->small = (PetscBool)((PetscReal)n >= FACTOR_APPLICATIONS * PetscSqr(f->fill));
  if (!*changed) PetscFunctionReturn(0);
  amgf->lag.built = PETSC_FALSE;
  pc->setupcalled = 0;
  PetscFunctionReturn(0);
}

PetscErrorCode PCAMGFGetFactored_AMGF(PC pc, PetscBool *factored)
{
  PetscFunctionBegin;
  PetscCall(PCAMGFFactorIsUsed_Private(pc, factored));
  PetscFunctionReturn(0);
}

/*@
  PCAMGFSetFactor - Sets whether a Cholesky factorization of the operator replaces the AMG

  Logically Collective

  Input Parameters:
+ pc  - the preconditioner
- use - `PC_AMGF_FACTOR_FALSE` (default), `PC_AMGF_FACTOR_TRUE` or `PC_AMGF_FACTOR_AUTO`

  Options Database Key:
. -pc_amgf_factor <false> - `false`, `true` or `auto`

  Level: intermediate

  Notes:
  Real scalars only. On one rank CHOLMOD computes the factors, if PETSc has it. MUMPS computes them on several ranks,
  and if the operator is not positive definite. If the factorization fails, the set-up of the preconditioner fails. With
  `auto` the AMG is used then.

  With `auto` the choice depends on the number of unknowns alone. A program that knows how often an operator is used can
  choose better: a factorization takes longer than the set-up of the AMG, and an application takes less time.

.seealso: `PCAMGF`, `PCAMGFFactorUse`, `PCAMGFGetFactored()`
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
  PCAMGFReconsiderFactor - Lets `PC_AMGF_FACTOR_AUTO` replace the AMG by a factorization, if it has been applied to the
  present operator often, and the factors are small

  Collective

  Input Parameter:
. pc - the preconditioner

  Output Parameter:
. changed - whether the next `PCSetUp()` computes a factorization

  Level: advanced

  Notes:
  Call it between solves: a Krylov method needs the same preconditioner in all of its iterations. The AMG must have been
  applied to this operator 60 times if the factors have eight times as many entries as its upper triangle, and more
  often for larger factors. Factors of more than 160 MB may have twelve times as many entries. Thin and plane bodies
  have small factors, and the AMG is slow for thin cells. On one rank only, if PETSc has CHOLMOD.

.seealso: `PCAMGF`, `PCAMGFSetFactor()`, `PCAMGFGetFactored()`
@*/
PetscErrorCode PCAMGFReconsiderFactor(PC pc, PetscBool *changed)
{
  PetscFunctionBegin;
  PetscValidHeaderSpecific(pc, PC_CLASSID, 1);
  PetscAssertPointer(changed, 2);
  *changed = PETSC_FALSE;
  PetscTryMethod(pc, "PCAMGFReconsiderFactor_C", (PC, PetscBool *), (pc, changed));
  PetscFunctionReturn(0);
}

/*@
  PCAMGFGetFactored - Gets whether a factorization replaces the AMG

  Not Collective

  Input Parameter:
. pc - the preconditioner, of type `PCAMGF`

  Output Parameter:
. factored - whether a factorization is used for the present operator

  Level: intermediate

.seealso: `PCAMGF`, `PCAMGFSetFactor()`
@*/
PetscErrorCode PCAMGFGetFactored(PC pc, PetscBool *factored)
{
  PetscFunctionBegin;
  PetscValidHeaderSpecific(pc, PC_CLASSID, 1);
  PetscAssertPointer(factored, 2);
  PetscUseMethod(pc, "PCAMGFGetFactored_C", (PC, PetscBool *), (pc, factored));
  PetscFunctionReturn(0);
}
