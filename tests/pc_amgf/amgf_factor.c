static char help[] = "PCAMGF with a factorization of the operator in place of the AMG: by option, by what is said to "
                     "come, and not where it may not be.\n\n";

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
  PetscCall(PCAMGFGetFactored(c->pc, &factored, NULL));
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%s: %s by %s%s\n", what, residual < 1e-7 ? "solved" : "NOT SOLVED",
    factored ? "factorization" : "AMG", its <= 2 ? ", at once" : ""));
  PetscFunctionReturn(0);
}

/* Said to come: too little, too much for the memory allowed, a lot; and after that another operator of the same
   pattern, and the AMG again */
static PetscErrorCode CheckChoice(Mat A)
{
  Context c;

  PetscFunctionBeginUser;
  PetscCall(ContextCreate(A, PC_AMGF_FACTOR_AUTO, &c));
  PetscCall(Solve(&c, "auto, nothing said"));
  PetscCall(PCAMGFExpect(c.pc, 0.0, 1.0));
  PetscCall(Solve(&c, "auto, nothing to come"));
  PetscCall(PetscOptionsSetValue(NULL, "-pc_amgf_factor_share", "0"));
  PetscCall(KSPSetFromOptions(c.ksp));
  PetscCall(PCAMGFExpect(c.pc, 1e6, 1.0));
  PetscCall(Solve(&c, "auto, no memory allowed"));
  PetscCall(PetscOptionsClearValue(NULL, "-pc_amgf_factor_share"));
  PetscCall(PetscOptionsSetValue(NULL, "-pc_amgf_factor_share", "0.4"));
  PetscCall(KSPSetFromOptions(c.ksp));
  PetscCall(PetscOptionsClearValue(NULL, "-pc_amgf_factor_share"));
  PetscCall(PCAMGFExpect(c.pc, 1e6, 1.0));
  PetscCall(Solve(&c, "auto, much to come"));
  PetscCall(MatScale(A, 2.0));
  PetscCall(Solve(&c, "another operator"));
  PetscCall(PCAMGFSetFactor(c.pc, PC_AMGF_FACTOR_FALSE));
  PetscCall(Solve(&c, "false again"));
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
  PetscCall(MatDestroy(&A));
  PetscCall(PetscFinalize());
  return 0;
}

/*TEST

   test:
      suffix: 1
      nsize: {{1 2 3}}
      args: -type {{aij baij}}

TEST*/
