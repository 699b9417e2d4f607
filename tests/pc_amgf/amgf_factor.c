static char help[] = "PCAMGF with a factorization of the operator in place of the AMG.\n\n";

#include "amgf_problem.h"

typedef struct {
  Mat A;
  Vec b, x;
  KSP ksp;
  PC  pc;
} Context;

static PetscErrorCode ContextCreate(Mat A, PCAMGFFactorUse use, Context *c)
{
  PetscFunctionBeginUser;
  c->A = A;
  PetscCall(MatCreateVecs(A, &c->x, &c->b));
  PetscCall(FillVector(c->b, 0.8));
  PetscCall(ProblemCreateSolver(A, A, &c->ksp, &c->pc));
  PetscCall(KSPSetTolerances(c->ksp, 1e-10, PETSC_DEFAULT, PETSC_DEFAULT, 2000));
  PetscCall(PCAMGFSetFilterOptional(c->pc, PETSC_TRUE));
  PetscCall(PCAMGFSetFactor(c->pc, use));
  PetscCall(KSPSetFromOptions(c->ksp));
  PetscFunctionReturn(0);
}

static PetscErrorCode ContextDestroy(Context *c)
{
  PetscFunctionBeginUser;
  PetscCall(KSPDestroy(&c->ksp));
  PetscCall(VecDestroy(&c->b));
  PetscCall(VecDestroy(&c->x));
  PetscFunctionReturn(0);
}

/* Solves, and prints by what, whether in an iteration or two, and whether the residual is small */
static PetscErrorCode Solve(Context *c, const char what[])
{
  PetscReal residual;
  PetscInt  its;
  PetscBool factored;

  PetscFunctionBeginUser;
  PetscCall(VecSet(c->x, 0.0));
  PetscCall(KSPSolve(c->ksp, c->b, c->x));
  PetscCall(KSPGetIterationNumber(c->ksp, &its));
  PetscCall(ProblemResidual(c->A, c->b, c->x, &residual));
  PetscCall(PCAMGFGetFactored(c->pc, &factored));
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%s: %s by %s%s\n", what, residual < 1e-7 ? "solved" : "NOT SOLVED",
    factored ? "factorization" : "AMG", its <= 2 ? ", at once" : ""));
  PetscFunctionReturn(0);
}

/* A small operator; after that another one of the same pattern, and the AMG again */
static PetscErrorCode CheckChoice(Mat A)
{
  Context c;

  PetscFunctionBeginUser;
  PetscCall(ContextCreate(A, PC_AMGF_FACTOR_AUTO, &c));
  PetscCall(Solve(&c, "auto, small"));
  PetscCall(MatScale(A, 2.0));
  PetscCall(Solve(&c, "another operator"));
  PetscCall(PCAMGFSetFactor(c.pc, PC_AMGF_FACTOR_FALSE));
  PetscCall(Solve(&c, "false again"));
  PetscCall(ContextDestroy(&c));
  PetscFunctionReturn(0);
}

/*
   Operators with 0, 1 and 2 negative eigenvalues, one after the other in the same solver. The factors count them; B is
   indefinite then, and solves nevertheless.
*/
static PetscErrorCode CheckIndefinite(Mat A)
{
  Context           c;
  PetscInt          rstart, rend, negative;
  const PetscInt    rows[]   = {3, 77};
  const PetscScalar values[] = {-1e3, -1e3};

  PetscFunctionBeginUser;
  PetscCall(ContextCreate(A, PC_AMGF_FACTOR_TRUE, &c));
  PetscCall(KSPSetType(c.ksp, KSPGMRES));
  PetscCall(MatGetOwnershipRange(A, &rstart, &rend));
  for (PetscInt k = 0; k <= 2; k++) {
    if (k && rows[k - 1] >= rstart && rows[k - 1] < rend)
      PetscCall(MatSetValues(A, 1, &rows[k - 1], 1, &rows[k - 1], &values[k - 1], INSERT_VALUES));
    PetscCall(MatAssemblyBegin(A, MAT_FINAL_ASSEMBLY));
    PetscCall(MatAssemblyEnd(A, MAT_FINAL_ASSEMBLY));
    PetscCall(Solve(&c, "indefinite"));
    PetscCall(PCAMGFGetFilterPivots(c.pc, &negative));
    PetscCall(PetscPrintf(PETSC_COMM_WORLD, "  negative pivots: %" PetscInt_FMT "\n", negative));
  }
  PetscCall(ContextDestroy(&c));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  Problem problem;
  Mat     A;
  Context c;
  char    type[32] = MATAIJ;

  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, help));
  PetscCall(PetscAMGFInitializePackage());
  PetscCall(PetscOptionsGetString(NULL, NULL, "-type", type, sizeof(type), NULL));
  PetscCall(ProblemSetDefaults(&problem));
  problem.n = 12; /* more unknowns than PCBLOCKAMG solves for at once */
  PetscCall(ProblemCreate(PETSC_COMM_WORLD, &problem, type, PETSC_TRUE, &A));
  PetscCall(ContextCreate(A, PC_AMGF_FACTOR_FALSE, &c));
  PetscCall(Solve(&c, "false"));
  PetscCall(ContextDestroy(&c));
  PetscCall(ContextCreate(A, PC_AMGF_FACTOR_TRUE, &c));
  PetscCall(Solve(&c, "true"));
  PetscCall(ContextDestroy(&c));
  PetscCall(CheckChoice(A));
  PetscCall(CheckIndefinite(A));
  PetscCall(MatDestroy(&A));
  PetscCall(PetscFinalize());
  return 0;
}

/*TEST

   test:
      suffix: 1
      nsize: {{1 2 3}}
      args: -type {{aij baij sbaij}}

TEST*/
