static char help[] =
  "PCAMGF after an operator, a subspace or an option has changed: failed factorizations, new values of "
  "an interpolation, transposes, products, and options that are refused.\n\n";

#include "amgf_context.h"
#include "../lib/attempt.h"

static PetscErrorCode Solve(Context *c, const char what[])
{
  KSPConvergedReason reason;
  PetscReal          residual = 1.0;

  PetscFunctionBeginUser;
  PetscCall(KSPSetOperators(c->ksp, c->A, c->A));
  PetscCall(KSPSolve(c->ksp, c->b, c->x));
  PetscCall(KSPGetConvergedReason(c->ksp, &reason));
  if (reason > 0) PetscCall(ProblemResidual(c->A, c->b, c->x, &residual));
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%s: %s\n", what,
    reason > 0 && residual < 1e-7 ? "solved" : KSPConvergedReasons[reason]));
  PetscFunctionReturn(0);
}

/* An operator of zeros between two good ones: its factorization fails, and the next one does not */
static PetscErrorCode CheckZeros(PetscBool factor)
{
  Context     c;
  PetscViewer viewer;

  PetscFunctionBeginUser;
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "zeros, %s\n", factor ? "factorization" : "filter"));
  PetscCall(ContextCreate(&c, 12));
  if (factor) {
    PetscCall(PCAMGFSetFilterOptional(c.pc, PETSC_TRUE));
    PetscCall(PCAMGFSetFactor(c.pc, PC_AMGF_FACTOR_TRUE));
  } else PetscCall(PCAMGFSetFilterIS(c.pc, c.is));
  PetscCall(Solve(&c, "  good"));
  PetscCall(MatZeroEntries(c.A));
  PetscCall(Solve(&c, "  zero"));
  PetscCall(ProblemFill(&c.problem, PETSC_TRUE, c.A));
  PetscCall(Solve(&c, "  good again"));
  if (factor) {
    PetscCall(PetscViewerASCIIOpen(PETSC_COMM_WORLD, "view.txt", &viewer));
    PetscCall(KSPView(c.ksp, viewer));
    PetscCall(PetscViewerDestroy(&viewer));
  }
  PetscCall(ContextDestroy(&c));
  PetscFunctionReturn(0);
}

/* Iterations after the values of an interpolation have changed: those of a new solver */
static PetscErrorCode CheckInterpolation(void)
{
  Context  c;
  Mat      P;
  PetscInt before, after;

  PetscFunctionBeginUser;
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "interpolation with new values\n"));
  PetscCall(ContextCreate(&c, 12));
  PetscCall(ProblemCreateInterpolation(c.A, c.is, 0.1, &P));
  PetscCall(PCAMGFSetFilterInterpolation(c.pc, P));
  PetscCall(Solve(&c, "  first"));
  PetscCall(KSPGetIterationNumber(c.ksp, &before));
  PetscCall(MatScale(P, 1000.0));
  PetscCall(Solve(&c, "  the same, scaled"));
  PetscCall(KSPGetIterationNumber(c.ksp, &after));
  PetscCall(ReportBound(PETSC_COMM_WORLD, "  additional iterations, at most 1", (PetscReal)(after - before), 1.0));
  PetscCall(MatDestroy(&P));
  PetscCall(ContextDestroy(&c));
  PetscFunctionReturn(0);
}

/* The cycle bfb with an operator that is newer than the preconditioner; a subspace composed after the set-up, seen by
   the transpose as well */
static PetscErrorCode CheckOlder(void)
{
  Context   c;
  PetscReal difference = 0.0;

  PetscFunctionBeginUser;
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "older set-up\n"));
  PetscCall(PetscOptionsSetValue(NULL, "-amgf_amg_pc_type", PCHYPRE)); /* symmetric to double precision */
  PetscCall(ContextCreate(&c, 12));
  PetscCall(PCAMGFSetCycle(c.pc, PC_AMGF_BFB));
  PetscCall(PCAMGFSetFilterIS(c.pc, c.is));
  PetscCall(Solve(&c, "  first"));
  PetscCall(PCSetReusePreconditioner(c.pc, PETSC_TRUE));
  c.problem.highest += 0.3;
  PetscCall(ProblemFill(&c.problem, PETSC_TRUE, c.A));
  PetscCall(ContextAsymmetry(&c, &difference));
  PetscCall(ReportBound(PETSC_COMM_WORLD, "  symmetric with new values", difference, 1e-11));
  PetscCall(ContextDestroy(&c));

  PetscCall(ContextCreate(&c, 12));
  PetscCall(PCAMGFSetFilterOptional(c.pc, PETSC_TRUE));
  PetscCall(PCSetUp(c.pc));
  PetscCall(PetscObjectCompose((PetscObject)c.A, PCAMGF_FILTER_KEY, (PetscObject)c.is));
  PetscCall(PCApplyTranspose(c.pc, c.b, c.x));
  PetscCall(PCApply(c.pc, c.b, c.y));
  PetscCall(RelativeDifference(c.x, c.y, &difference));
  PetscCall(ReportBound(PETSC_COMM_WORLD, "  transpose with a composed subspace", difference, 1e-11));
  PetscCall(ContextDestroy(&c));
  PetscCall(PetscOptionsClearValue(NULL, "-amgf_amg_pc_type"));
  PetscFunctionReturn(0);
}

/* PCAMGFApplyProduct() multiplies by the Amat, not by the Pmat */
static PetscErrorCode CheckProduct(void)
{
  Context   c;
  Mat       twice;
  Vec       product;
  PetscReal difference = 0.0;

  PetscFunctionBeginUser;
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "product\n"));
  PetscCall(ContextCreate(&c, 12));
  PetscCall(PCAMGFSetFilterOptional(c.pc, PETSC_TRUE));
  PetscCall(MatDuplicate(c.A, MAT_COPY_VALUES, &twice));
  PetscCall(MatScale(twice, 2.0));
  PetscCall(PCSetOperators(c.pc, twice, c.A));
  PetscCall(PCSetUp(c.pc));
  PetscCall(VecDuplicate(c.b, &product));
  PetscCall(PCAMGFApplyProduct(c.pc, c.b, c.x, product));
  PetscCall(MatMult(twice, c.x, c.y));
  PetscCall(RelativeDifference(product, c.y, &difference));
  PetscCall(ReportBound(PETSC_COMM_WORLD, "  that with the Amat", difference, 1e-2));
  PetscCall(VecDestroy(&product));
  PetscCall(MatDestroy(&twice));
  PetscCall(ContextDestroy(&c));
  PetscFunctionReturn(0);
}

/* What must be refused, with one sentence. name, value: an option, or NULL; row: a filtered row, or 0 */
static PetscErrorCode CheckRefused(const char what[], const char name[], const char value[], PetscInt row)
{
  Context        c;
  PetscErrorCode ierr = 0;
  IS             is;

  PetscFunctionBeginUser;
  PetscCall(ContextCreate(&c, 12));
  PetscCall(PCAMGFSetFilterOptional(c.pc, PETSC_TRUE));
  if (name) PetscCall(PetscOptionsSetValue(NULL, name, value));
  PetscCall(ISCreateGeneral(PETSC_COMM_WORLD, row ? 1 : 0, &row, PETSC_COPY_VALUES, &is));
  if (row) PetscCall(PCAMGFSetFilterIS(c.pc, is));
  PetscCall(AttemptBegin());
  ierr = PCSetFromOptions(c.pc);
  if (!ierr) ierr = PCSetUp(c.pc);
  PetscCall(AttemptEnd());
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%s: ", what));
  PetscCall(AttemptPrint(ierr));
  if (name) PetscCall(PetscOptionsClearValue(NULL, name));
  PetscCall(ISDestroy(&is));
  PetscCall(ContextDestroy(&c));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, help));
  PetscCall(PetscAMGFInitializePackage());
  PetscCall(CheckZeros(PETSC_FALSE));
  PetscCall(CheckZeros(PETSC_TRUE));
  PetscCall(CheckInterpolation());
  PetscCall(CheckOlder());
  PetscCall(CheckProduct());
  PetscCall(CheckRefused("smallest integer as a row", NULL, NULL, -2147483647 - 1));
  PetscCall(CheckRefused("lag below -1", "-pc_amgf_amg_lag", "-2", 0));
  PetscCall(CheckRefused("lag beyond integers", "-pc_amgf_amg_lag", "99999999999999999999", 0));
  PetscCall(PetscOptionsSetValue(NULL, "-amgf_amg_pc_type", PCBLOCKAMG));
  PetscCall(CheckRefused("hypre without a hierarchy", "-amgf_amg_pc_hypre_type", "euclid", 0));
  PetscCall(PetscFinalize());
  return 0;
}

/*TEST

   test:
      suffix: 1
      nsize: {{1 2 3}}
      args: -malloc_dump 0

TEST*/
