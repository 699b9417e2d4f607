static char help[] =
  "Without a Hessian: a limited-memory approximation, against the same problem with its Hessian.\n\n";

#include "ipfilter_problem.h"

/* f = 1/2 x^T K x - b^T x + 1/4 sum x_i^4, K tridiagonal, subject to x_i <= 0.4 for odd i, and in every tenth row to
   1 - x_i^2 - x_{i+1}^2 >= 0 */
typedef struct {
  QuadraticProgram q;
  Mat              J;
  Vec              c, lower, upper;
  VecScatter       scatter[2]; /* of x_i and of x_{i+1} to the rows */
} Quartic;

static PetscErrorCode QuarticObjective(Tao tao, Vec x, PetscReal *f, Vec g, void *user)
{
  Vec         cube;
  PetscScalar fourth;

  PetscFunctionBeginUser;
  PetscCall(ProblemObjectiveAndGradient(tao, x, f, g, &((Quartic *)user)->q));
  PetscCall(VecDuplicate(x, &cube));
  PetscCall(VecPointwiseMult(cube, x, x));
  PetscCall(VecPointwiseMult(cube, cube, x));
  PetscCall(VecDot(cube, x, &fourth));
  PetscCall(VecAXPY(g, 1.0, cube));
  *f += 0.25 * PetscRealPart(fourth);
  PetscCall(VecDestroy(&cube));
  PetscFunctionReturn(0);
}

static PetscErrorCode QuarticConstraints(Tao tao, Vec x, Vec c, void *user)
{
  Quartic *p = (Quartic *)user;
  Vec      value;

  PetscFunctionBeginUser;
  (void)tao;
  PetscCall(VecDuplicate(c, &value));
  PetscCall(VecSet(c, 1.0));
  for (PetscInt k = 0; k < 2; k++) {
    PetscCall(VecScatterBegin(p->scatter[k], x, value, INSERT_VALUES, SCATTER_FORWARD));
    PetscCall(VecScatterEnd(p->scatter[k], x, value, INSERT_VALUES, SCATTER_FORWARD));
    PetscCall(VecPointwiseMult(value, value, value));
    PetscCall(VecAXPY(c, -1.0, value));
  }
  PetscCall(VecDestroy(&value));
  PetscFunctionReturn(0);
}

static PetscErrorCode QuarticJacobian(Tao tao, Vec x, Mat J, Mat pre, void *user)
{
  Vec       twice;
  PetscInt  lo, hi;
  PetscReal one = 1.0;

  PetscFunctionBeginUser;
  (void)tao;
  (void)pre;
  (void)user;
  PetscCall(VecDuplicate(x, &twice));
  PetscCall(VecAXPBY(twice, -2.0, 0.0, x));
  PetscCall(MatGetOwnershipRange(J, &lo, &hi));
  for (PetscInt r = lo; r < hi; r++)
    for (PetscInt k = 0; k < 2; k++) PetscCall(MatSetValue(J, r, 10 * r + k, one, INSERT_VALUES));
  PetscCall(MatAssemblyBegin(J, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(J, MAT_FINAL_ASSEMBLY));
  PetscCall(MatDiagonalScale(J, NULL, twice));
  PetscCall(VecDestroy(&twice));
  PetscFunctionReturn(0);
}

/* K + 3 x^2 + 2 DI of the rows */
static PetscErrorCode QuarticHessian(Tao tao, Vec x, Mat H, Mat pre, void *user)
{
  Quartic *p = (Quartic *)user;
  Vec      d, DI;

  PetscFunctionBeginUser;
  (void)pre;
  PetscCall(MatCopy(p->q.H, H, SAME_NONZERO_PATTERN));
  PetscCall(VecDuplicate(x, &d));
  PetscCall(VecPointwiseMult(d, x, x));
  PetscCall(VecScale(d, 1.5));
  PetscCall(TaoGetDualVariables(tao, NULL, &DI));
  for (PetscInt k = 0; k < 2 && DI; k++) {
    PetscCall(VecScatterBegin(p->scatter[k], DI, d, ADD_VALUES, SCATTER_REVERSE));
    PetscCall(VecScatterEnd(p->scatter[k], DI, d, ADD_VALUES, SCATTER_REVERSE));
  }
  PetscCall(VecScale(d, 2.0));
  PetscCall(MatDiagonalSet(H, d, ADD_VALUES));
  PetscCall(VecDestroy(&d));
  PetscFunctionReturn(0);
}

static PetscErrorCode CreateQuartic(PetscInt n, Quartic *p)
{
  PetscInt lo, hi, local, m;

  PetscFunctionBeginUser;
  *p = (Quartic){.J = NULL};
  PetscCall(VecCreateMPI(PETSC_COMM_WORLD, PETSC_DECIDE, n, &p->q.b));
  PetscCall(VecDuplicate(p->q.b, &p->lower));
  PetscCall(VecDuplicate(p->q.b, &p->upper));
  PetscCall(VecSet(p->lower, PETSC_NINFINITY));
  PetscCall(VecSet(p->upper, PETSC_INFINITY));
  PetscCall(VecGetOwnershipRange(p->q.b, &lo, &hi));
  local = hi - lo;
  PetscCall(MatCreateAIJ(PETSC_COMM_WORLD, local, local, n, n, 3, NULL, 2, NULL, &p->q.H));
  for (PetscInt i = lo; i < hi; i++) {
    PetscCall(MatSetValue(p->q.H, i, i, 3.0, INSERT_VALUES));
    if (i) PetscCall(MatSetValue(p->q.H, i, i - 1, -1.0, INSERT_VALUES));
    if (i < n - 1) PetscCall(MatSetValue(p->q.H, i, i + 1, -1.0, INSERT_VALUES));
    PetscCall(VecSetValue(p->q.b, i, 2.0 + PetscSinReal(0.37 * i), INSERT_VALUES));
    if (i % 2) PetscCall(VecSetValue(p->upper, i, 0.4, INSERT_VALUES));
  }
  PetscCall(MatAssemblyBegin(p->q.H, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(p->q.H, MAT_FINAL_ASSEMBLY));
  PetscCall(VecAssemblyBegin(p->q.b));
  PetscCall(VecAssemblyEnd(p->q.b));
  PetscCall(VecAssemblyBegin(p->upper));
  PetscCall(VecAssemblyEnd(p->upper));
  PetscCall(VecCreateMPI(PETSC_COMM_WORLD, PETSC_DECIDE, n / 10, &p->c));
  PetscCall(VecGetLocalSize(p->c, &m));
  PetscCall(MatCreateAIJ(PETSC_COMM_WORLD, m, local, n / 10, n, 2, NULL, 2, NULL, &p->J));
  PetscCall(VecGetOwnershipRange(p->c, &lo, NULL));
  for (PetscInt k = 0; k < 2; k++) {
    IS from, to;

    PetscCall(ISCreateStride(PETSC_COMM_WORLD, m, 10 * lo + k, 10, &from));
    PetscCall(ISCreateStride(PETSC_COMM_WORLD, m, lo, 1, &to));
    PetscCall(VecScatterCreate(p->q.b, from, p->c, to, &p->scatter[k]));
    PetscCall(ISDestroy(&from));
    PetscCall(ISDestroy(&to));
  }
  PetscFunctionReturn(0);
}

static PetscErrorCode DestroyQuartic(Quartic *p)
{
  PetscFunctionBeginUser;
  PetscCall(ProblemDestroy(&p->q));
  PetscCall(MatDestroy(&p->J));
  PetscCall(VecDestroy(&p->c));
  PetscCall(VecDestroy(&p->lower));
  PetscCall(VecDestroy(&p->upper));
  for (PetscInt k = 0; k < 2; k++) PetscCall(VecScatterDestroy(&p->scatter[k]));
  PetscFunctionReturn(0);
}

static PetscErrorCode Solve(Quartic *p, PetscBool hessian, PetscBool rows, PetscBool bounds, Vec x, PetscReal *f,
  TaoConvergedReason *reason)
{
  Tao tao;
  Mat H;

  PetscFunctionBeginUser;
  PetscCall(VecSet(x, 0.0));
  PetscCall(TaoCreate(PETSC_COMM_WORLD, &tao));
  PetscCall(TaoSetType(tao, TAOIPFILTER));
  PetscCall(TaoSetSolution(tao, x));
  PetscCall(TaoSetObjectiveAndGradient(tao, NULL, QuarticObjective, p));
  if (hessian) {
    PetscCall(MatDuplicate(p->q.H, MAT_COPY_VALUES, &H));
    PetscCall(TaoSetHessian(tao, H, H, QuarticHessian, p));
    PetscCall(MatDestroy(&H));
  }
  if (rows) {
    PetscCall(TaoSetInequalityConstraintsRoutine(tao, p->c, QuarticConstraints, p));
    PetscCall(TaoSetJacobianInequalityRoutine(tao, p->J, p->J, QuarticJacobian, p));
  }
  if (bounds) PetscCall(TaoSetVariableBounds(tao, p->lower, p->upper));
  PetscCall(TaoSetFromOptions(tao));
  PetscCall(TaoSolve(tao));
  PetscCall(TaoSolve(tao)); /* again: nothing of the first solve's steps may be left */
  PetscCall(TaoGetSolutionStatus(tao, NULL, f, NULL, NULL, NULL, reason));
  PetscCall(TaoDestroy(&tao));
  PetscFunctionReturn(0);
}

static PetscErrorCode Test(Quartic *p, PetscBool rows, PetscBool bounds)
{
  Vec                x, reference;
  PetscReal          f, best, size, error;
  TaoConvergedReason reason, exact;

  PetscFunctionBeginUser;
  PetscCall(VecDuplicate(p->q.b, &x));
  PetscCall(VecDuplicate(p->q.b, &reference));
  PetscCall(Solve(p, PETSC_FALSE, rows, bounds, x, &f, &reason));
  PetscCall(Solve(p, PETSC_TRUE, rows, bounds, reference, &best, &exact));
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%s, %s: %s, with the Hessian %s\n", rows ? "rows" : "no rows",
    bounds ? "bounds" : "no bounds", TaoConvergedReasons[reason], TaoConvergedReasons[exact]));
  PetscCall(ProblemVerdict("  objective against that with the Hessian, relative",
    PetscAbsReal(f - best) / PetscAbsReal(best), 1e-7));
  PetscCall(VecNorm(reference, NORM_INFINITY, &size));
  PetscCall(VecAXPY(x, -1.0, reference));
  PetscCall(VecNorm(x, NORM_INFINITY, &error));
  PetscCall(ProblemVerdict("  difference of the solutions, relative", error / size, 1e-3));
  PetscCall(VecDestroy(&x));
  PetscCall(VecDestroy(&reference));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  Quartic  p;
  PetscInt n = 100000;

  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, help));
  PetscCall(PetscAMGFInitializePackage());
  PetscCall(PetscOptionsGetInt(NULL, NULL, "-n", &n, NULL));
  PetscCall(CreateQuartic(n, &p));
  PetscCall(Test(&p, PETSC_FALSE, PETSC_FALSE));
  PetscCall(Test(&p, PETSC_FALSE, PETSC_TRUE));
  PetscCall(Test(&p, PETSC_TRUE, PETSC_TRUE));
  PetscCall(DestroyQuartic(&p));
  PetscCall(PetscFinalize());
  return 0;
}

/*TEST

   testset:
      output_file: output/ipfilter_quasinewton_1.out

      test:
         suffix: ranks
         nsize: {{1 2 3}}
         args: -n 3000

      test:
         suffix: large_long
         nsize: 2

TEST*/
