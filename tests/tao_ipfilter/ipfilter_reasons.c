static char help[] =
  "Every end of TAOIPFILTER has its reason: infeasible, unbounded, NaN, limits, failed linear solver.\n\n";

#include "ipfilter_problem.h"
#include "ipfilter_separable.h"

typedef enum {
  CASE_SOLVABLE,
  CASE_INFEASIBLE,
  CASE_UNBOUNDED,
  CASE_NAN_START,
  CASE_NAN_AWAY,
  CASE_NAN_HESSIAN,
  CASE_NAN_GRADIENT,
  CASE_NAN_CONSTRAINT,
  CASE_OVERSHOOT,
  NCASES
} Case;

static const char *const case_names[] = {"solvable", "infeasible", "unbounded", "NaN at the start",
  "NaN away from the start", "NaN in the Hessian", "NaN in the gradient", "NaN in a constraint away from the start",
  "overshooting Newton steps"};

/* Separable in the unknowns: solvable and infeasible (x - 3)^2; unbounded -x; NaN away: x - log x, not defined for x
   <= 0; overshoot: sqrt(1 + x^2), where Newton's step is -x (1 + x^2) */
static void Term(const void *ctx, PetscInt i, PetscReal x, PetscReal *f, PetscReal *g, PetscReal *h)
{
  const Case c = *(const Case *)ctx;

  (void)i;
  *f = PetscSqr(x - 3.0);
  *g = 2.0 * (x - 3.0);
  *h = 2.0;
  if (c == CASE_UNBOUNDED) {
    *f = -x;
    *g = -1.0;
    *h = 0.0;
  } else if (c == CASE_NAN_AWAY) {
    *f = x > 0.0 ? x - PetscLogReal(x) : NAN;
    *g = 1.0 - 1.0 / x;
    *h = 1.0 / PetscSqr(x);
  } else if (c == CASE_OVERSHOOT) {
    *f = PetscSqrtReal(1.0 + PetscSqr(x));
    *g = x / *f;
    *h = 1.0 / PetscPowReal(*f, 3.0);
  } else if (c == CASE_NAN_START) *f = NAN;
  else if (c == CASE_NAN_HESSIAN) *h = NAN;
  else if (c == CASE_NAN_GRADIENT && x > 2.0) *g = NAN;
}

static PetscErrorCode ObjectiveAndGradient(Tao tao, Vec x, PetscReal *f, Vec g, void *user)
{
  PetscFunctionBeginUser;
  (void)tao;
  *f = 0.0;
  PetscCall(VecSet(g, 0.0));
  PetscCall(SeparableAddGradient(Term, user, x, f, g));
  PetscFunctionReturn(0);
}

static PetscErrorCode Hessian(Tao tao, Vec x, Mat H, Mat Hpre, void *user)
{
  PetscFunctionBeginUser;
  (void)tao;
  (void)Hpre;
  PetscCall(MatZeroEntries(H));
  PetscCall(SeparableAddHessian(Term, user, x, H));
  PetscFunctionReturn(0);
}

/* c = x_0 - 1, and, infeasible, also -x_0; NaN in a constraint: only its value at the start, x_0 = 0.1, is a number */
static PetscErrorCode Inequality(Tao tao, Vec x, Vec c, void *user)
{
  const Case which = *(const Case *)user;
  Mat        J;
  PetscInt   lo, hi;
  PetscReal  largest;

  PetscFunctionBeginUser;
  PetscCall(PetscObjectQuery((PetscObject)tao, "test_J", (PetscObject *)&J));
  PetscCall(MatMult(J, x, c));
  PetscCall(VecGetOwnershipRange(c, &lo, &hi));
  if (lo == 0 && hi > 0) PetscCall(VecSetValue(c, 0, -1.0, ADD_VALUES));
  PetscCall(VecAssemblyBegin(c));
  PetscCall(VecAssemblyEnd(c));
  PetscCall(VecMax(c, NULL, &largest));
  if (which == CASE_NAN_CONSTRAINT && largest != 0.1 - 1.0) PetscCall(VecSet(c, NAN));
  PetscFunctionReturn(0);
}

/* m = 1 or 2 rows on the first rank */
static PetscErrorCode CreateJacobian(PetscInt m, Vec x, Mat *J)
{
  PetscMPIInt rank;
  PetscInt    n;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(PETSC_COMM_WORLD, &rank));
  PetscCall(VecGetLocalSize(x, &n));
  PetscCall(MatCreateAIJ(PETSC_COMM_WORLD, rank ? 0 : m, n, m, PETSC_DETERMINE, 1, NULL, 1, NULL, J));
  for (PetscInt i = 0; i < m && !rank; i++) PetscCall(MatSetValue(*J, i, 0, i ? -1.0 : 1.0, INSERT_VALUES));
  PetscCall(MatAssemblyBegin(*J, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(*J, MAT_FINAL_ASSEMBLY));
  PetscFunctionReturn(0);
}

static PetscErrorCode Run(Case which, PetscInt max_it, PetscInt max_funcs, const char name[])
{
  Vec                x, c;
  Mat                H, J;
  Tao                tao;
  PetscInt           n;
  PetscReal          f;
  TaoConvergedReason reason;
  const char        *sentence;
  char               first[18];

  PetscFunctionBeginUser;
  PetscCall(VecCreateMPI(PETSC_COMM_WORLD, PETSC_DECIDE, 4, &x));
  PetscCall(VecSet(x, which == CASE_OVERSHOOT ? 30.0 : 0.1));
  PetscCall(VecGetLocalSize(x, &n));
  PetscCall(MatCreateAIJ(PETSC_COMM_WORLD, n, n, 4, 4, 1, NULL, 0, NULL, &H));
  PetscCall(CreateJacobian(which == CASE_INFEASIBLE ? 2 : 1, x, &J));
  PetscCall(MatCreateVecs(J, NULL, &c));
  PetscCall(TaoCreate(PETSC_COMM_WORLD, &tao));
  PetscCall(TaoSetType(tao, TAOIPFILTER));
  PetscCall(PetscObjectCompose((PetscObject)tao, "test_J", (PetscObject)J));
  PetscCall(TaoSetSolution(tao, x));
  PetscCall(TaoSetObjectiveAndGradient(tao, NULL, ObjectiveAndGradient, &which));
  PetscCall(TaoSetHessian(tao, H, H, Hessian, &which));
  PetscCall(TaoSetInequalityConstraintsRoutine(tao, c, Inequality, &which));
  PetscCall(TaoSetJacobianInequalityRoutine(tao, J, J, ProblemConstant, NULL));
  if (max_it >= 0) PetscCall(TaoSetMaximumIterations(tao, max_it));
  if (max_funcs >= 0) PetscCall(TaoSetMaximumFunctionEvaluations(tao, max_funcs));
  PetscCall(TaoSetFromOptions(tao));
  PetscCall(TaoSolve(tao));
  PetscCall(TaoGetSolutionStatus(tao, NULL, &f, NULL, NULL, NULL, &reason));
  PetscCall(TaoIPFilterGetReason(tao, &sentence));
  PetscCall(PetscStrncpy(first, sentence, sizeof(first)));
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%s: %s, \"%s...\"\n", name, TaoConvergedReasons[reason], first));
  if (reason > 0) PetscCall(PetscPrintf(PETSC_COMM_WORLD, "  objective %.6f\n", (double)f));
  PetscCall(TaoDestroy(&tao));
  PetscCall(MatDestroy(&H));
  PetscCall(MatDestroy(&J));
  PetscCall(VecDestroy(&x));
  PetscCall(VecDestroy(&c));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, help));
  PetscCall(PetscAMGFInitializePackage());
  for (PetscInt k = 0; k < NCASES; k++) PetscCall(Run((Case)k, -1, -1, case_names[k]));
  PetscCall(Run(CASE_SOLVABLE, 2, -1, "two iterations"));
  PetscCall(Run(CASE_SOLVABLE, -1, 3, "three evaluations"));
  PetscCall(PetscFinalize());
  return 0;
}

/*TEST

   test:
      suffix: 1
      nsize: {{1 2 3}}
      args: -tao_ipfilter_pc_type jacobi

TEST*/
