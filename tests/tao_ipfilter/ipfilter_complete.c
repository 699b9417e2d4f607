static char help[] = "Corners of TAOIPFILTER: nothing to solve, errors and NaN in callbacks, solving again, "
                     "constraints that are redundant or void.\n\n";

#include "ipfilter_problem.h"
#include <petsccompat.h>

/* f = sum_i (k_i/2 x_i^2 - b_i x_i) + stiffness/2 sum_i (x_i - x_{i-1})^2 over n unknowns; constraints J x - g >= 0 */
typedef struct {
  QuadraticProgram q;
  PetscInt calls, fail_at, nan_after; /* calls of the objective, the one that fails, and the last that gives a number */
  PetscBool nan_constraint;           /* the constraint is not a number where x_0 > 1 */
} Corner;

static PetscErrorCode Objective(Tao tao, Vec x, PetscReal *f, Vec g, void *user)
{
  Corner *c = (Corner *)user;

  PetscFunctionBeginUser;
  c->calls++;
  if (c->calls == c->fail_at) PetscFunctionReturn(PETSC_ERR_USER);
  PetscCall(ProblemObjectiveAndGradient(tao, x, f, g, &c->q));
  if (c->calls > c->nan_after) *f = NAN;
  PetscFunctionReturn(0);
}

static PetscErrorCode Constraint(Tao tao, Vec x, Vec v, void *user)
{
  Corner   *c = (Corner *)user;
  PetscReal most;

  PetscFunctionBeginUser;
  PetscCall(ProblemConstraints(tao, x, v, &c->q));
  PetscCall(VecMax(x, NULL, &most));
  if (c->nan_constraint && most > 1.0) PetscCall(VecSet(v, NAN));
  PetscFunctionReturn(0);
}

/* k_i = k grow^i, b_i = (-1)^i b grow^i; m constraints x_i >= g, i = 0, 1, ... (row r: unknown r mod n) */
static PetscErrorCode Create(PetscInt n, PetscInt m, PetscReal k, PetscReal b, PetscReal grow, PetscReal stiffness,
  PetscReal g, Corner *c)
{
  PetscInt lo, hi, nlocal;

  PetscFunctionBeginUser;
  *c = (Corner){.fail_at = -1, .nan_after = PETSC_MAX_INT};
  PetscCall(VecCreateMPI(PETSC_COMM_WORLD, PETSC_DECIDE, n, &c->q.b));
  PetscCall(VecGetOwnershipRange(c->q.b, &lo, &hi));
  nlocal = hi - lo;
  PetscCall(MatCreateAIJ(PETSC_COMM_WORLD, nlocal, nlocal, n, n, 3, NULL, 2, NULL, &c->q.H));
  for (PetscInt i = lo; i < hi; i++) {
    const PetscReal power = PetscPowReal(grow, (PetscReal)i);

    PetscCall(MatSetValue(c->q.H, i, i, k * power, ADD_VALUES));
    PetscCall(VecSetValue(c->q.b, i, (i % 2 ? -b : b) * power, INSERT_VALUES));
    if (i > 0) {
      const PetscInt    rows[2] = {i - 1, i};
      const PetscScalar v[4]    = {stiffness, -stiffness, -stiffness, stiffness};

      PetscCall(MatSetValues(c->q.H, 2, rows, 2, rows, v, ADD_VALUES));
    }
  }
  PetscCall(MatAssemblyBegin(c->q.H, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(c->q.H, MAT_FINAL_ASSEMBLY));
  PetscCall(VecAssemblyBegin(c->q.b));
  PetscCall(VecAssemblyEnd(c->q.b));
  PetscCall(MatCreateAIJ(PETSC_COMM_WORLD, PETSC_DECIDE, nlocal, m, n, 1, NULL, 1, NULL, &c->q.J));
  PetscCall(MatGetOwnershipRange(c->q.J, &lo, &hi));
  for (PetscInt r = lo; r < hi && n; r++) PetscCall(MatSetValue(c->q.J, r, r % n, 1.0, INSERT_VALUES));
  PetscCall(MatAssemblyBegin(c->q.J, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(c->q.J, MAT_FINAL_ASSEMBLY));
  PetscCall(MatCreateVecs(c->q.J, NULL, &c->q.g));
  PetscCall(VecSet(c->q.g, g));
  PetscFunctionReturn(0);
}

/* Gives the problem to a Tao, which may have had another one */
static PetscErrorCode Give(Tao tao, Corner *c, PetscBool constrained, Vec *x)
{
  Vec v;

  PetscFunctionBeginUser;
  PetscCall(VecDuplicate(c->q.b, x));
  PetscCall(TaoSetSolution(tao, *x));
  PetscCall(TaoSetObjectiveAndGradient(tao, NULL, Objective, c));
  PetscCall(TaoSetHessian(tao, c->q.H, c->q.H, ProblemConstant, NULL));
  if (!constrained) PetscFunctionReturn(0);
  PetscCall(VecDuplicate(c->q.g, &v));
  PetscCall(TaoSetInequalityConstraintsRoutine(tao, v, Constraint, c));
  PetscCall(TaoSetJacobianInequalityRoutine(tao, c->q.J, c->q.J, ProblemConstant, NULL));
  PetscCall(VecDestroy(&v));
  PetscFunctionReturn(0);
}

static PetscErrorCode CreateTao(Tao *tao)
{
  PetscFunctionBeginUser;
  PetscCall(TaoCreate(PETSC_COMM_WORLD, tao));
  PetscCall(TaoSetType(*tao, TAOIPFILTER));
  PetscCall(TaoSetFromOptions(*tao));
  PetscFunctionReturn(0);
}

/* The reason, the first words of the sentence, and f where there is an optimum */
static PetscErrorCode Report(Tao tao, const char name[])
{
  TaoConvergedReason reason;
  PetscReal          f;
  const char        *sentence;

  PetscFunctionBeginUser;
  PetscCall(TaoGetSolutionStatus(tao, NULL, &f, NULL, NULL, NULL, &reason));
  PetscCall(TaoIPFilterGetReason(tao, &sentence));
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%s: %s, \"%.20s...\"", name, TaoConvergedReasons[reason], sentence));
  if (reason > 0) PetscCall(PetscPrintf(PETSC_COMM_WORLD, ", %.6f", PetscAbsReal(f) < 1e-7 ? 0.0 : (double)f));
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "\n"));
  PetscFunctionReturn(0);
}

static PetscErrorCode Destroy(Corner *c, Vec *x, Tao *tao)
{
  PetscFunctionBeginUser;
  if (tao) PetscCall(TaoDestroy(tao));
  PetscCall(VecDestroy(x));
  PetscCall(ProblemDestroy(&c->q));
  PetscFunctionReturn(0);
}

/* One problem, solved once; fixed: x_0 is held at that value by equal bounds */
static PetscErrorCode Once(const char name[], Corner *c, PetscBool constrained, PetscReal fixed, PetscReal tol)
{
  Tao tao;
  Vec x, bound[2];

  PetscFunctionBeginUser;
  PetscCall(CreateTao(&tao));
  PetscCall(Give(tao, c, constrained, &x));
  if (fixed < PETSC_INFINITY) {
    for (PetscInt k = 0; k < 2; k++) {
      PetscInt lo;

      PetscCall(VecDuplicate(x, &bound[k]));
      PetscCall(VecSet(bound[k], k ? PETSC_INFINITY : PETSC_NINFINITY));
      PetscCall(VecGetOwnershipRange(x, &lo, NULL));
      if (lo == 0) PetscCall(VecSetValue(bound[k], 0, fixed, INSERT_VALUES));
      PetscCall(VecAssemblyBegin(bound[k]));
      PetscCall(VecAssemblyEnd(bound[k]));
    }
    PetscCall(TaoSetVariableBounds(tao, bound[0], bound[1]));
    for (PetscInt k = 0; k < 2; k++) PetscCall(VecDestroy(&bound[k]));
  }
  if (tol > 0.0) PetscCall(TaoSetTolerances(tao, tol, PETSC_DEFAULT, PETSC_DEFAULT));
  PetscCall(TaoSolve(tao));
  PetscCall(Report(tao, name));
  PetscCall(Destroy(c, &x, &tao));
  PetscFunctionReturn(0);
}

/* An error of the third call of the objective comes back from TaoSolve() as it is */
static PetscErrorCode CallbackError(void)
{
  Corner         c;
  Tao            tao;
  Vec            x;
  PetscErrorCode error;

  PetscFunctionBeginUser;
  PetscCall(Create(4, 2, 1.0, 1.0, 1.0, 1.0, 0.0, &c));
  c.fail_at = 3;
  PetscCall(CreateTao(&tao));
  PetscCall(Give(tao, &c, PETSC_TRUE, &x));
  PetscCall(PetscPushErrorHandler(PetscReturnErrorHandler, NULL));
  error = TaoSolve(tao);
  PetscCall(PetscPopErrorHandler());
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "error in a callback: %s\n",
    error == PETSC_ERR_USER ? "the caller gets it" : "LOST"));
  PetscCall(Destroy(&c, &x, &tao));
  PetscFunctionReturn(0);
}

/* One Tao for a problem twice, then for larger and smaller ones, with and without constraints */
static PetscErrorCode Again(void)
{
  const PetscInt n[4] = {4, 4, 9, 3}, m[4] = {2, 2, 5, 1};
  Corner         c[4];
  Vec            x[4];
  Tao            tao;

  PetscFunctionBeginUser;
  PetscCall(CreateTao(&tao));
  for (PetscInt k = 0; k < 4; k++) {
    char name[32];

    PetscCall(Create(n[k], m[k], 1.0, -1.0, 1.0, 1.0, 0.5, &c[k]));
    PetscCall(Give(tao, &c[k], PETSC_TRUE, &x[k]));
    PetscCall(TaoSolve(tao));
    PetscCall(PetscSNPrintf(name, sizeof(name), "%" PetscInt_FMT " unknowns, again", n[k]));
    PetscCall(Report(tao, name));
  }
  PetscCall(TaoDestroy(&tao));
  for (PetscInt k = 0; k < 4; k++) PetscCall(Destroy(&c[k], &x[k], NULL));
  PetscFunctionReturn(0);
}

/* Unknowns whose stiffness spans 12 orders, pressed against constraints or drawn from them, to the end of double
   precision: z/s spans 30 */
static PetscErrorCode Span(void)
{
  Corner    c;
  Tao       tao;
  Vec       x, s, z, exact;
  PetscReal least, most, error, size;

  PetscFunctionBeginUser;
  PetscCall(Create(13, 13, 1e-6, 1e-6, 10.0, 0.0, 0.0, &c));
  PetscCall(CreateTao(&tao));
  PetscCall(Give(tao, &c, PETSC_TRUE, &x));
  PetscCall(PetscOptionsSetValue(NULL, "-tao_ipfilter_tol", "1e-15"));
  PetscCall(TaoSetFromOptions(tao));
  PetscCall(PetscOptionsClearValue(NULL, "-tao_ipfilter_tol"));
  PetscCall(TaoSolve(tao));
  PetscCall(TaoIPFilterGetSlack(tao, &s));
  PetscCall(TaoIPFilterGetMultiplier(tao, &z));
  PetscCall(VecDuplicate(x, &exact));
  PetscCall(VecQuotient_AMGF(exact, z, s));
  PetscCall(VecMin(exact, NULL, &least));
  PetscCall(VecMax(exact, NULL, &most));
  PetscCall(VecSet(exact, 0.0));
  for (PetscInt i = 0; i < 13; i += 2) PetscCall(VecSetValue(exact, i, 1.0, INSERT_VALUES));
  PetscCall(VecAssemblyBegin(exact));
  PetscCall(VecAssemblyEnd(exact));
  PetscCall(VecNorm(exact, NORM_INFINITY, &size));
  PetscCall(VecAXPY(exact, -1.0, x));
  PetscCall(VecNorm(exact, NORM_INFINITY, &error));
  PetscCall(Report(tao, "D over 30 orders"));
  PetscCall(ProblemVerdict("  1e30 over its span", 1e30 * least / most, 1.0));
  PetscCall(ProblemVerdict("  difference from the solution, relative", error / size, 1e-3));
  PetscCall(VecDestroy(&exact));
  PetscCall(Destroy(&c, &x, &tao));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  const PetscReal none = PETSC_INFINITY;
  Corner          c;

  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, help));
  PetscCall(PetscAMGFInitializePackage());
  PetscCall(Create(0, 0, 1.0, 1.0, 1.0, 1.0, 0.0, &c));
  PetscCall(Once("no unknowns", &c, PETSC_FALSE, none, 0.0));
  PetscCall(Create(4, 0, 1.0, 1.0, 1.0, 1.0, 0.0, &c));
  PetscCall(Once("no constraints", &c, PETSC_FALSE, none, 0.0));
  PetscCall(Create(4, 0, 1.0, 1.0, 1.0, 1.0, 0.0, &c));
  PetscCall(Once("constraints that are none", &c, PETSC_TRUE, none, 0.0));
  PetscCall(Create(4, 2, 1.0, -1.0, 1.0, 1.0, 0.5, &c));
  PetscCall(Once("to 1e-17", &c, PETSC_TRUE, none, 1e-17));
  PetscCall(Create(4, 3, 1.0, 3.0, 1.0, 1.0, -4.0, &c));
  c.nan_constraint = PETSC_TRUE;
  PetscCall(Once("NaN in a constraint beyond 1", &c, PETSC_TRUE, none, 0.0));
  PetscCall(Create(4, 2, 1.0, -1.0, 1.0, 1.0, 0.5, &c));
  c.nan_after = 2;
  PetscCall(Once("NaN from the third call on", &c, PETSC_TRUE, none, 0.0));
  PetscCall(CallbackError());
  PetscCall(Again());
  PetscCall(Create(3, 9, 1.0, -1.0, 1.0, 1.0, 0.5, &c));
  PetscCall(Once("every constraint three times", &c, PETSC_TRUE, none, 0.0));
  PetscCall(Create(3, 3, 0.0, -1.0, 1.0, 1.0, 0.5, &c));
  PetscCall(Once("held by constraints alone", &c, PETSC_TRUE, none, 0.0));
  PetscCall(Create(3, 1, 1.0, 1.0, 1.0, 1.0, 0.5, &c));
  PetscCall(Once("a constraint on a fixed unknown, redundant", &c, PETSC_TRUE, 2.0, 0.0));
  PetscCall(Create(3, 1, 1.0, 1.0, 1.0, 1.0, 0.5, &c));
  PetscCall(Once("a constraint on a fixed unknown, violated", &c, PETSC_TRUE, -2.0, 0.0));
  PetscCall(Span());
  PetscCall(PetscFinalize());
  return 0;
}

/*TEST

   testset:
      output_file: output/ipfilter_complete_1.out
      args: -tao_ipfilter_pc_type jacobi
      # a callback that fails leaves PETSc's objects as they are
      args: -malloc_dump 0

      test:
         suffix: ranks
         nsize: {{1 2}}

      test:
         suffix: direct
         args: -tao_ipfilter_direct

      test:
         suffix: flexible
         args: -tao_ipfilter_subspace false -tao_ipfilter_ksp_type fcg

TEST*/
