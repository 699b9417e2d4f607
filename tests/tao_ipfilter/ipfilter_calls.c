static char help[] = "TAO's own calls on a TAOIPFILTER: convergence tests, tolerances, multipliers, warm starts, rows "
                     "with two bounds.\n\n";

#include "ipfilter_problem.h"
#include "../lib/attempt.h"
#include <petsccompat.h>

/* min sum (x_i - x_{i-1})^2 / 2 + x_i^2 / 2 - b_i x_i of n unknowns, subject to rows x_i + x_{i+1} within [l_i, u_i],
   to the sum of all x_i = total, and to bounds */
typedef struct {
  QuadraticProgram q; /* J: the rows; g: 0 */
  Mat              sum;
  Vec              total, lower, upper, row_lower, row_upper;
  PetscInt         n, stop_at, ntests;
} Chain;

static PetscErrorCode TotalConstraint(Tao tao, Vec x, Vec c, void *user)
{
  Chain *chain = (Chain *)user;

  PetscFunctionBeginUser;
  (void)tao;
  PetscCall(MatMult(chain->sum, x, c));
  PetscCall(VecAXPY(c, -1.0, chain->total));
  PetscFunctionReturn(0);
}

static PetscErrorCode FillVec(Vec v, PetscReal even, PetscReal odd)
{
  PetscInt lo, hi;

  PetscFunctionBeginUser;
  PetscCall(VecGetOwnershipRange(v, &lo, &hi));
  for (PetscInt i = lo; i < hi; i++) PetscCall(VecSetValue(v, i, i % 2 ? odd : even, INSERT_VALUES));
  PetscCall(VecAssemblyBegin(v));
  PetscCall(VecAssemblyEnd(v));
  PetscFunctionReturn(0);
}

static PetscErrorCode CreateChain(PetscInt n, Chain *chain)
{
  PetscInt lo, hi, local;

  PetscFunctionBeginUser;
  *chain = (Chain){.n = n, .stop_at = -1};
  PetscCall(VecCreateMPI(PETSC_COMM_WORLD, PETSC_DECIDE, n, &chain->q.b));
  PetscCall(FillVec(chain->q.b, 2.0, -1.0));
  PetscCall(VecDuplicate(chain->q.b, &chain->lower));
  PetscCall(VecDuplicate(chain->q.b, &chain->upper));
  PetscCall(VecGetOwnershipRange(chain->q.b, &lo, &hi));
  local = hi - lo;
  PetscCall(MatCreateAIJ(PETSC_COMM_WORLD, local, local, n, n, 3, NULL, 2, NULL, &chain->q.H));
  PetscCall(MatCreateAIJ(PETSC_COMM_WORLD, PETSC_DECIDE, local, n - 1, n, 2, NULL, 2, NULL, &chain->q.J));
  PetscCall(MatCreateAIJ(PETSC_COMM_WORLD, PETSC_DECIDE, local, 1, n, local, NULL, n - local, NULL, &chain->sum));
  for (PetscInt i = lo; i < hi; i++) {
    const PetscScalar v[3] = {i == n - 1 ? 2.0 : 3.0, -1.0, 1.0};
    const PetscInt    next = i + 1, before = i - 1;

    PetscCall(MatSetValue(chain->q.H, i, i, i ? v[0] : v[0] - 1.0, INSERT_VALUES));
    if (i) PetscCall(MatSetValues(chain->q.H, 1, &i, 1, &before, &v[1], INSERT_VALUES));
    if (i < n - 1) PetscCall(MatSetValues(chain->q.H, 1, &i, 1, &next, &v[1], INSERT_VALUES));
  }
  PetscCall(MatAssemblyBegin(chain->q.H, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(chain->q.H, MAT_FINAL_ASSEMBLY));
  PetscCall(MatGetOwnershipRange(chain->q.J, &lo, &hi));
  for (PetscInt r = lo; r < hi; r++) {
    const PetscInt    cols[2] = {r, r + 1};
    const PetscScalar v[2]    = {1.0, 1.0};

    PetscCall(MatSetValues(chain->q.J, 1, &r, 2, cols, v, INSERT_VALUES));
  }
  PetscCall(MatAssemblyBegin(chain->q.J, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(chain->q.J, MAT_FINAL_ASSEMBLY));
  PetscCall(MatGetOwnershipRange(chain->sum, &lo, &hi));
  for (PetscInt j = 0; j < n && lo < hi; j++) PetscCall(MatSetValue(chain->sum, 0, j, 1.0, INSERT_VALUES));
  PetscCall(MatAssemblyBegin(chain->sum, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(chain->sum, MAT_FINAL_ASSEMBLY));
  PetscCall(MatCreateVecs(chain->q.J, NULL, &chain->q.g));
  PetscCall(VecSet(chain->q.g, 0.0));
  PetscCall(VecDuplicate(chain->q.g, &chain->row_lower));
  PetscCall(VecDuplicate(chain->q.g, &chain->row_upper));
  PetscCall(MatCreateVecs(chain->sum, NULL, &chain->total));
  PetscCall(VecSet(chain->total, 0.7 * n));
  PetscFunctionReturn(0);
}

static PetscErrorCode DestroyChain(Chain *chain)
{
  PetscFunctionBeginUser;
  PetscCall(ProblemDestroy(&chain->q));
  PetscCall(MatDestroy(&chain->sum));
  PetscCall(VecDestroy(&chain->total));
  PetscCall(VecDestroy(&chain->lower));
  PetscCall(VecDestroy(&chain->upper));
  PetscCall(VecDestroy(&chain->row_lower));
  PetscCall(VecDestroy(&chain->row_upper));
  PetscFunctionReturn(0);
}

/* A solver with what of the constraints is asked for */
static PetscErrorCode CreateChainSolver(Chain *chain, PetscBool rows, PetscBool total, PetscBool bounds, Vec x,
  Tao *tao)
{
  PetscFunctionBeginUser;
  PetscCall(TaoCreate(PETSC_COMM_WORLD, tao));
  PetscCall(TaoSetType(*tao, TAOIPFILTER));
  PetscCall(TaoSetSolution(*tao, x));
  PetscCall(TaoSetObjectiveAndGradient(*tao, NULL, ProblemObjectiveAndGradient, &chain->q));
  PetscCall(TaoSetHessian(*tao, chain->q.H, chain->q.H, ProblemConstant, NULL));
  if (rows) {
    Vec c;

    PetscCall(VecDuplicate(chain->q.g, &c));
    PetscCall(TaoSetInequalityConstraintsRoutine(*tao, c, ProblemConstraints, &chain->q));
    PetscCall(TaoSetJacobianInequalityRoutine(*tao, chain->q.J, chain->q.J, ProblemConstant, NULL));
    PetscCall(VecDestroy(&c));
  }
  if (total) {
    Vec ce;

    PetscCall(VecDuplicate(chain->total, &ce));
    PetscCall(TaoSetEqualityConstraintsRoutine(*tao, ce, TotalConstraint, chain));
    PetscCall(TaoSetJacobianEqualityRoutine(*tao, chain->sum, chain->sum, ProblemConstant, NULL));
    PetscCall(VecDestroy(&ce));
  }
  if (bounds) PetscCall(TaoSetVariableBounds(*tao, chain->lower, chain->upper));
  PetscCall(TaoSetFromOptions(*tao));
  PetscFunctionReturn(0);
}

/* Ends at the iteration asked for, and finds the multipliers and residuals of every iterate at hand */
static PetscErrorCode StopAt(Tao tao, void *user)
{
  Chain    *chain = (Chain *)user;
  PetscInt  its;
  PetscReal f, residual, cnorm;

  PetscFunctionBeginUser;
  chain->ntests++;
  PetscCall(TaoGetSolutionStatus(tao, &its, &f, &residual, &cnorm, NULL, NULL));
  PetscCheck(residual > 0.0 && cnorm == 0.0, PETSC_COMM_WORLD, PETSC_ERR_PLIB,
    "At iteration %" PetscInt_FMT " the test sees objective %g and residual %g", its, (double)f, (double)residual);
  if (its == chain->stop_at) PetscCall(TaoSetConvergedReason(tao, TAO_CONVERGED_USER));
  PetscFunctionReturn(0);
}

/* The same, and the default test */
static PetscErrorCode StopAtOrConverge(Tao tao, void *user)
{
  PetscFunctionBeginUser;
  ((Chain *)user)->ntests++;
  PetscCall(TaoIPFilterDefaultConvergenceTest(tao, NULL));
  PetscFunctionReturn(0);
}

static PetscErrorCode TestConvergenceTests(void)
{
  PetscErrorCode (*const tests[3])(Tao, void *) = {StopAt, StopAtOrConverge, TaoDefaultConvergenceTest};
  const char *const names[3] = {"a test that stops at iteration 3", "one that calls the default", "PETSc's"};

  PetscFunctionBeginUser;
  for (PetscInt k = 0; k < 3; k++) {
    Chain              chain;
    Tao                tao;
    Vec                x;
    PetscInt           its;
    TaoConvergedReason reason;
    PetscReal          error;

    PetscCall(CreateChain(20, &chain));
    chain.stop_at = 3;
    PetscCall(VecSet(chain.lower, 0.2));
    PetscCall(VecSet(chain.upper, PETSC_INFINITY));
    PetscCall(VecDuplicate(chain.q.b, &x));
    PetscCall(CreateChainSolver(&chain, PETSC_FALSE, PETSC_FALSE, PETSC_TRUE, x, &tao));
    PetscCall(TaoSetConvergenceTest(tao, tests[k], &chain));
    PetscCall(TaoSolve(tao));
    PetscCall(TaoGetSolutionStatus(tao, &its, NULL, NULL, NULL, NULL, &reason));
    PetscCall(TaoIPFilterGetKKTError(tao, &error, NULL));
    PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%s: %s, %s\n", names[k], TaoConvergedReasons[reason],
      k == 2 || chain.ntests == its + 1 ? "asked at every iterate" : "not asked at every iterate"));
    if (k == 0 && its != 3) PetscCall(PetscPrintf(PETSC_COMM_WORLD, "  %" PetscInt_FMT " iterations\n", its));
    if (k) PetscCall(ProblemVerdict("  KKT error", error, k == 1 ? 1e-8 : 1e-6));
    PetscCall(VecDestroy(&x));
    PetscCall(TaoDestroy(&tao));
    PetscCall(DestroyChain(&chain));
  }
  PetscFunctionReturn(0);
}

/* Multipliers of bounds: gradient = DL + DU, DL >= 0 >= DU, and zero where the bound is not reached */
static PetscErrorCode TestBoundMultipliers(void)
{
  Chain     chain;
  Tao       tao;
  Vec       x, g, DL, DU, gap;
  PetscReal norm, force, extreme;

  PetscFunctionBeginUser;
  PetscCall(CreateChain(20, &chain));
  PetscCall(FillVec(chain.lower, PETSC_NINFINITY, 0.2));
  PetscCall(FillVec(chain.upper, 0.5, PETSC_INFINITY));
  PetscCall(VecDuplicate(chain.q.b, &x));
  PetscCall(VecDuplicate(x, &g));
  PetscCall(VecDuplicate(x, &DL));
  PetscCall(VecDuplicate(x, &DU));
  PetscCall(VecDuplicate(x, &gap));
  PetscCall(CreateChainSolver(&chain, PETSC_FALSE, PETSC_FALSE, PETSC_TRUE, x, &tao));
  PetscCall(TaoSolve(tao));
  PetscCall(TaoComputeDualVariables(tao, DL, DU));
  PetscCall(MatMult(chain.q.H, x, g));
  PetscCall(VecAXPY(g, -1.0, chain.q.b));
  PetscCall(VecNorm(g, NORM_INFINITY, &force));
  PetscCall(VecAXPY(g, -1.0, DL));
  PetscCall(VecAXPY(g, -1.0, DU));
  PetscCall(VecNorm(g, NORM_INFINITY, &norm));
  PetscCall(ProblemVerdict("bounds: gradient less their multipliers, relative", norm / force, 1e-7));
  PetscCall(VecMin(DL, NULL, &extreme));
  PetscCall(VecMax(DU, NULL, &norm));
  PetscCall(ProblemVerdict("bounds: wrong sign of a multiplier", PetscMax(-extreme, norm), 0.0));
  PetscCall(VecMax(DL, NULL, &extreme));
  PetscCall(VecMin(DU, NULL, &norm));
  PetscCall(
    PetscPrintf(PETSC_COMM_WORLD, "bounds of both kinds press: %s\n", extreme > 0.1 && norm < -0.1 ? "yes" : "no"));
  PetscCall(VecDestroy(&x));
  PetscCall(VecDestroy(&g));
  PetscCall(VecDestroy(&DL));
  PetscCall(VecDestroy(&DU));
  PetscCall(VecDestroy(&gap));
  PetscCall(TaoDestroy(&tao));
  PetscCall(DestroyChain(&chain));
  PetscFunctionReturn(0);
}

/* The slacks and multipliers of a solved problem into the solver of the same problem */
static PetscErrorCode CopyMultipliers(Tao from, Tao to)
{
  Vec s, z;

  PetscFunctionBeginUser;
  PetscCall(TaoIPFilterGetSlack(from, &s));
  PetscCall(TaoIPFilterGetMultiplier(from, &z));
  PetscCall(TaoIPFilterSetWarmStart(to, s, z));
  PetscFunctionReturn(0);
}

/* A solved problem from its own solution, in a new solver: no or one iteration; then with the load changed a little,
   fewer than from cold */
static PetscErrorCode TestWarmStart(void)
{
  Chain              chain;
  Tao                first, again;
  Vec                x, y;
  PetscInt           its[3];
  PetscReal          f[2];
  TaoConvergedReason reason;

  PetscFunctionBeginUser;
  PetscCall(CreateChain(40, &chain));
  PetscCall(FillVec(chain.q.g, 1.2, 0.15));
  PetscCall(VecDuplicate(chain.q.b, &x));
  PetscCall(VecDuplicate(chain.q.b, &y));
  PetscCall(CreateChainSolver(&chain, PETSC_TRUE, PETSC_FALSE, PETSC_FALSE, x, &first));
  PetscCall(TaoSolve(first));
  PetscCall(TaoGetSolutionStatus(first, &its[0], &f[0], NULL, NULL, NULL, NULL));
  PetscCall(VecCopy(x, y));
  PetscCall(CreateChainSolver(&chain, PETSC_TRUE, PETSC_FALSE, PETSC_FALSE, y, &again));
  PetscCall(CopyMultipliers(first, again));
  PetscCall(TaoSolve(again));
  PetscCall(TaoGetSolutionStatus(again, &its[1], &f[1], NULL, NULL, NULL, &reason));
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "warm start: %s\n", TaoConvergedReasons[reason]));
  if (its[1] <= 1) PetscCall(PetscPrintf(PETSC_COMM_WORLD, "  from the solution: no or one iteration\n"));
  else
    PetscCall(PetscPrintf(PETSC_COMM_WORLD,
      "  from the solution: %" PetscInt_FMT " iterations, %" PetscInt_FMT " from zero\n", its[1], its[0]));
  PetscCall(
    ProblemVerdict("  change of the objective, relative", PetscAbsReal(f[1] - f[0]) / PetscAbsReal(f[0]), 1e-7));
  PetscCall(VecScale(chain.q.b, 1.001));
  PetscCall(VecCopy(x, y));
  PetscCall(CopyMultipliers(first, again));
  PetscCall(TaoSolve(again));
  PetscCall(TaoGetSolutionStatus(again, &its[2], NULL, NULL, NULL, NULL, &reason));
  if (reason > 0 && its[2] <= its[0])
    PetscCall(PetscPrintf(PETSC_COMM_WORLD, "  another load: no more iterations than from zero\n"));
  else
    PetscCall(
      PetscPrintf(PETSC_COMM_WORLD, "  another load: %s, %" PetscInt_FMT " iterations, %" PetscInt_FMT " from zero\n",
        TaoConvergedReasons[reason], its[2], its[0]));
  PetscCall(VecDestroy(&x));
  PetscCall(VecDestroy(&y));
  PetscCall(TaoDestroy(&first));
  PetscCall(TaoDestroy(&again));
  PetscCall(DestroyChain(&chain));
  PetscFunctionReturn(0);
}

/* |x|^2 - 100 n = 0 */
static PetscErrorCode SphereConstraint(Tao tao, Vec x, Vec c, void *user)
{
  PetscReal norm;

  PetscFunctionBeginUser;
  (void)tao;
  PetscCall(VecNorm(x, NORM_2, &norm));
  PetscCall(VecSet(c, norm * norm - 100.0 * ((Chain *)user)->n));
  PetscFunctionReturn(0);
}

static PetscErrorCode SphereJacobian(Tao tao, Vec x, Mat J, Mat pre, void *user)
{
  Vec         twice;
  PetscScalar one = 1.0;
  PetscInt    lo, hi;

  PetscFunctionBeginUser;
  (void)tao;
  (void)pre;
  PetscCall(VecDuplicate(x, &twice));
  PetscCall(VecAXPBY(twice, 2.0, 0.0, x));
  PetscCall(MatGetOwnershipRange(J, &lo, &hi));
  for (PetscInt j = 0; j < ((Chain *)user)->n && lo < hi; j++)
    PetscCall(MatSetValues(J, 1, &lo, 1, &j, &one, INSERT_VALUES));
  PetscCall(MatAssemblyBegin(J, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(J, MAT_FINAL_ASSEMBLY));
  PetscCall(MatDiagonalScale(J, NULL, twice));
  PetscCall(VecDestroy(&twice));
  PetscFunctionReturn(0);
}

/* H + 2 DE I */
static PetscErrorCode SphereHessian(Tao tao, Vec x, Mat H, Mat pre, void *user)
{
  Vec         DE;
  PetscScalar y;

  PetscFunctionBeginUser;
  (void)x;
  (void)pre;
  PetscCall(TaoGetDualVariables(tao, &DE, NULL));
  PetscCall(VecSum(DE, &y));
  PetscCall(MatCopy(((Chain *)user)->q.H, H, SAME_NONZERO_PATTERN));
  PetscCall(MatShift(H, 2.0 * y));
  PetscFunctionReturn(0);
}

/* Whether what -tao_view prints holds the text */
static PetscErrorCode FindInView(Tao tao, const char what[], PetscBool *found)
{
  PetscViewer viewer;
  char        line[512];
  FILE       *file;

  PetscFunctionBeginUser;
  *found = PETSC_FALSE;
  PetscCall(PetscViewerASCIIOpen(PETSC_COMM_WORLD, "ipfilter_calls.view", &viewer));
  PetscCall(TaoView(tao, viewer));
  PetscCall(PetscViewerDestroy(&viewer));
  PetscCall(PetscFOpen(PETSC_COMM_WORLD, "ipfilter_calls.view", "r", &file));
  while (file && fgets(line, sizeof(line), file)) *found = (PetscBool)(*found || strstr(line, what));
  PetscCall(PetscFClose(PETSC_COMM_WORLD, file));
  PetscCallMPI(MPI_Bcast(found, 1, MPI_PETSCBOOL, 0, PETSC_COMM_WORLD));
  PetscFunctionReturn(0);
}

/* A loose tolerance for all, and a tight one for the constraints: absolute, then relative, then none */
static PetscErrorCode TestConstraintTolerances(void)
{
  const PetscReal   catol[3] = {1e-7, PETSC_DEFAULT, PETSC_DEFAULT}, crtol[3] = {PETSC_DEFAULT, 1e-10, PETSC_DEFAULT};
  const char *const names[3] = {"catol 1e-07", "crtol 1e-10", "neither"};

  PetscFunctionBeginUser;
  for (PetscInt k = 0; k < 3; k++) {
    Chain     chain;
    Tao       tao;
    Mat       H;
    Vec       x, c;
    PetscReal violation;
    PetscBool said;

    PetscCall(CreateChain(20, &chain));
    PetscCall(VecDuplicate(chain.q.b, &x));
    PetscCall(VecSet(x, 7.0));
    PetscCall(CreateChainSolver(&chain, PETSC_FALSE, PETSC_TRUE, PETSC_FALSE, x, &tao));
    PetscCall(VecDuplicate(chain.total, &c));
    PetscCall(MatDuplicate(chain.q.H, MAT_COPY_VALUES, &H));
    PetscCall(TaoSetHessian(tao, H, H, SphereHessian, &chain));
    PetscCall(TaoSetEqualityConstraintsRoutine(tao, c, SphereConstraint, &chain));
    PetscCall(TaoSetJacobianEqualityRoutine(tao, chain.sum, chain.sum, SphereJacobian, &chain));
    PetscCall(TaoSetTolerances(tao, 1e-2, PETSC_DEFAULT, PETSC_DEFAULT));
    PetscCall(TaoSetConstraintTolerances(tao, catol[k], crtol[k]));
    PetscCall(TaoSolve(tao));
    PetscCall(SphereConstraint(tao, x, c, &chain));
    PetscCall(VecNorm(c, NORM_INFINITY, &violation));
    PetscCall(FindInView(tao, names[k], &said));
    PetscCall(PetscPrintf(PETSC_COMM_WORLD, "constraints, %s: violation %s, %s\n", names[k],
      violation <= 1e-7 ? "within 1e-7" : "above", said ? "and it is said" : "of which nothing is said"));
    PetscCall(MatDestroy(&H));
    PetscCall(VecDestroy(&c));
    PetscCall(VecDestroy(&x));
    PetscCall(TaoDestroy(&tao));
    PetscCall(DestroyChain(&chain));
  }
  PetscFunctionReturn(0);
}

/* Bounds of row r by its kind: two sides, an upper one, a lower one, equal ones, none; shift moves them */
static PetscErrorCode FillSides(Chain *chain, PetscInt kinds, PetscReal shift)
{
  const PetscReal lower[5] = {0.9, PETSC_NINFINITY, 1.3, 0.7, PETSC_NINFINITY},
                  upper[5] = {1.0, 0.8, PETSC_INFINITY, 0.7, PETSC_INFINITY};
  PetscInt lo, hi;

  PetscFunctionBeginUser;
  PetscCall(VecGetOwnershipRange(chain->row_lower, &lo, &hi));
  for (PetscInt r = lo; r < hi; r++) {
    PetscCall(VecSetValue(chain->row_lower, r, lower[r % kinds] + shift, INSERT_VALUES));
    PetscCall(VecSetValue(chain->row_upper, r, upper[r % kinds] + shift, INSERT_VALUES));
  }
  PetscCall(VecAssemblyBegin(chain->row_lower));
  PetscCall(VecAssemblyEnd(chain->row_lower));
  PetscCall(VecAssemblyBegin(chain->row_upper));
  PetscCall(VecAssemblyEnd(chain->row_upper));
  PetscFunctionReturn(0);
}

/* Largest violation of the sides, and product of a row's multiplier with the distance from the side that it presses
   on */
static PetscErrorCode MeasureSides(Chain *chain, Vec c, Vec DI, PetscReal measures[2])
{
  const PetscScalar *v, *d, *l, *u;
  PetscInt           n;

  PetscFunctionBeginUser;
  measures[0] = measures[1] = 0.0;
  PetscCall(VecGetLocalSize(c, &n));
  PetscCall(VecGetArrayRead(c, &v));
  PetscCall(VecGetArrayRead(DI, &d));
  PetscCall(VecGetArrayRead(chain->row_lower, &l));
  PetscCall(VecGetArrayRead(chain->row_upper, &u));
  for (PetscInt i = 0; i < n; i++) {
    const PetscReal distance = PetscMin(1.0, PetscRealPart(d[i] > 0.0 ? v[i] - l[i] : u[i] - v[i]));

    measures[0] = PetscMax(measures[0], PetscMax(PetscRealPart(l[i] - v[i]), PetscRealPart(v[i] - u[i])));
    measures[1] = PetscMax(measures[1], PetscAbsScalar(d[i] * distance));
  }
  PetscCall(VecRestoreArrayRead(chain->row_upper, &u));
  PetscCall(VecRestoreArrayRead(chain->row_lower, &l));
  PetscCall(VecRestoreArrayRead(DI, &d));
  PetscCall(VecRestoreArrayRead(c, &v));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, measures, 2, MPIU_REAL, MPIU_MAX, PETSC_COMM_WORLD));
  PetscFunctionReturn(0);
}

/* The optimality conditions of the chain with the sides as they are: balance of forces, sides, multipliers */
static PetscErrorCode CheckSides(Tao tao, Chain *chain, Vec x)
{
  Vec                g, c, DI;
  PetscReal          norm, measures[2];
  TaoConvergedReason reason;

  PetscFunctionBeginUser;
  PetscCall(TaoGetConvergedReason(tao, &reason));
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "  %s\n", TaoConvergedReasons[reason]));
  PetscCall(TaoGetDualVariables(tao, NULL, &DI));
  PetscCall(VecDuplicate(x, &g));
  PetscCall(VecDuplicate(DI, &c));
  PetscCall(MatMult(chain->q.J, x, c));
  PetscCall(MeasureSides(chain, c, DI, measures));
  PetscCall(MatMult(chain->q.H, x, g));
  PetscCall(VecAXPY(g, -1.0, chain->q.b));
  PetscCall(VecScale(g, -1.0));
  PetscCall(MatMultTransposeAdd(chain->q.J, DI, g, g));
  PetscCall(VecNorm(g, NORM_INFINITY, &norm));
  PetscCall(ProblemVerdict("  forces out of balance", norm, 1e-7));
  PetscCall(ProblemVerdict("  violation", measures[0], 1e-8));
  PetscCall(ProblemVerdict("  multiplier times distance", measures[1], 1e-7));
  PetscCall(VecDestroy(&g));
  PetscCall(VecDestroy(&c));
  PetscFunctionReturn(0);
}

/* Rows with bounds of all kinds, or of the first ones; then again from the solution, with other bounds, and with
   bounds that are all equal */
static PetscErrorCode TestSides(PetscInt kinds, const char name[])
{
  Chain    chain;
  Tao      tao;
  Vec      x;
  PetscInt its;

  PetscFunctionBeginUser;
  PetscCall(CreateChain(31, &chain));
  PetscCall(VecDuplicate(chain.q.b, &x));
  PetscCall(FillSides(&chain, kinds, 0.0));
  PetscCall(CreateChainSolver(&chain, PETSC_TRUE, PETSC_FALSE, PETSC_FALSE, x, &tao));
  PetscCall(TaoSetInequalityBounds(tao, chain.row_lower, chain.row_upper));
  PetscCall(TaoSolve(tao));
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "rows with %s\n", name));
  PetscCall(CheckSides(tao, &chain, x));
  PetscCall(CopyMultipliers(tao, tao));
  PetscCall(TaoSolve(tao));
  PetscCall(TaoGetIterationNumber(tao, &its));
  if (its <= 1) PetscCall(PetscPrintf(PETSC_COMM_WORLD, "  from the solution: no or one iteration\n"));
  else PetscCall(PetscPrintf(PETSC_COMM_WORLD, "  from the solution: %" PetscInt_FMT " iterations\n", its));
  PetscCall(TaoIPFilterSetWarmStart(tao, NULL, NULL));
  PetscCall(FillSides(&chain, kinds, 0.1));
  PetscCall(TaoSolve(tao));
  PetscCall(CheckSides(tao, &chain, x));
  PetscCall(FillSides(&chain, 1, 0.05));
  PetscCall(VecCopy(chain.row_lower, chain.row_upper));
  PetscCall(TaoSolve(tao));
  PetscCall(CheckSides(tao, &chain, x));
  PetscCall(VecDestroy(&x));
  PetscCall(TaoDestroy(&tao));
  PetscCall(DestroyChain(&chain));
  PetscFunctionReturn(0);
}

/* A lower bound above its upper one */
static PetscErrorCode TestCrossedSides(void)
{
  Chain          chain;
  Tao            tao;
  Vec            x;
  PetscErrorCode ierr;

  PetscFunctionBeginUser;
  PetscCall(CreateChain(31, &chain));
  PetscCall(VecDuplicate(chain.q.b, &x));
  PetscCall(VecSet(chain.row_lower, 2.0));
  PetscCall(VecSet(chain.row_upper, 1.0));
  PetscCall(CreateChainSolver(&chain, PETSC_TRUE, PETSC_FALSE, PETSC_FALSE, x, &tao));
  PetscCall(TaoSetInequalityBounds(tao, chain.row_lower, chain.row_upper));
  PetscCall(AttemptBegin());
  ierr = TaoSolve(tao);
  PetscCall(AttemptEnd());
  PetscCall(AttemptCompareRanks("crossed sides", ierr));
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "crossed sides: %s\n", ierr ? attempt_sentence : "no error"));
  PetscCall(TaoDestroy(&tao));
  PetscCall(VecDestroy(&x));
  PetscCall(DestroyChain(&chain));
  PetscFunctionReturn(0);
}

typedef PetscErrorCode (*Setter)(Tao, Vec);

static PetscErrorCode SetLower(Tao tao, Vec v)
{
  PetscFunctionBeginUser;
  PetscCall(TaoSetVariableBounds(tao, v, NULL));
  PetscFunctionReturn(0);
}

static PetscErrorCode SetUpper(Tao tao, Vec v)
{
  PetscFunctionBeginUser;
  PetscCall(TaoSetVariableBounds(tao, NULL, v));
  PetscFunctionReturn(0);
}

static PetscErrorCode SetRows(Tao tao, Vec v)
{
  PetscFunctionBeginUser;
  PetscCall(TaoSetInequalityBounds(tao, v, v));
  PetscFunctionReturn(0);
}

static PetscErrorCode SetPairs(Tao tao, Vec v)
{
  PetscFunctionBeginUser;
  PetscCall(TaoIPFilterSetWarmStart(tao, v, v));
  PetscFunctionReturn(0);
}

/* Vectors of another layout than what they belong to, before the first solve and after one */
static PetscErrorCode TestLayouts(void)
{
  const Setter setters[] = {TaoIPFilterSetSlackMass, TaoIPFilterSetPrimalMass, SetLower, SetUpper, SetRows, SetPairs};
  Chain        chain;
  Vec          x, other;

  PetscFunctionBeginUser;
  PetscCall(CreateChain(20, &chain));
  PetscCall(VecDuplicate(chain.q.b, &x));
  PetscCall(VecCreateMPI(PETSC_COMM_WORLD, PETSC_DECIDE, 2 * chain.n, &other));
  PetscCall(VecSet(other, 1.0));
  for (PetscInt k = 0; k < 2 * (PetscInt)PETSC_STATIC_ARRAY_LENGTH(setters); k++) {
    PetscErrorCode ierr;
    Tao            tao;

    PetscCall(CreateChainSolver(&chain, PETSC_TRUE, PETSC_TRUE, PETSC_FALSE, x, &tao));
    if (k % 2) PetscCall(TaoSolve(tao));
    PetscCall(setters[k / 2](tao, other));
    PetscCall(AttemptBegin());
    ierr = TaoSolve(tao);
    PetscCall(AttemptEnd());
    PetscCall(AttemptCompareRanks("layouts", ierr));
    attempt_sentence[strcspn(attempt_sentence, ":")] = '\0';
    PetscCall(PetscPrintf(PETSC_COMM_WORLD, "another layout%s: %s\n", k % 2 ? ", after a solve" : "",
      ierr == PETSC_ERR_ARG_SIZ ? attempt_sentence : "NOT REFUSED"));
    PetscCall(TaoDestroy(&tao));
  }
  PetscCall(VecDestroy(&other));
  PetscCall(VecDestroy(&x));
  PetscCall(DestroyChain(&chain));
  PetscFunctionReturn(0);
}

/* Solves, and compares the multipliers z with DI / m */
static PetscErrorCode SolveWithMass(Tao tao, PetscReal m, const char name[])
{
  Vec       z, DI, difference;
  PetscReal norm, size;

  PetscFunctionBeginUser;
  PetscCall(TaoSolve(tao));
  PetscCall(TaoIPFilterGetMultiplier(tao, &z));
  PetscCall(TaoGetDualVariables(tao, NULL, &DI));
  PetscCall(VecDuplicate(z, &difference));
  PetscCall(VecWAXPY(difference, -1.0 / m, DI, z));
  PetscCall(VecNorm(difference, NORM_INFINITY, &norm));
  PetscCall(VecNorm(z, NORM_INFINITY, &size));
  PetscCall(ProblemVerdict(name, norm / size, 1e-6));
  PetscCall(VecDestroy(&difference));
  PetscFunctionReturn(0);
}

/* A slack mass that is set, changed and removed between solves, of rows with one bound or two */
static PetscErrorCode TestSlackMass(PetscBool two)
{
  Chain chain;
  Tao   tao;
  Vec   x, mass;

  PetscFunctionBeginUser;
  PetscCall(CreateChain(20, &chain));
  PetscCall(FillVec(chain.q.g, 1.2, 0.15));
  PetscCall(VecDuplicate(chain.q.b, &x));
  PetscCall(VecDuplicate(chain.q.g, &mass));
  PetscCall(VecSet(mass, 2.0));
  PetscCall(CreateChainSolver(&chain, PETSC_TRUE, PETSC_FALSE, PETSC_FALSE, x, &tao));
  if (two) PetscCall(FillSides(&chain, 2, -1.0));
  if (two) PetscCall(TaoSetInequalityBounds(tao, chain.row_lower, chain.row_upper));
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "multipliers of rows with %s\n", two ? "two sides" : "one side"));
  PetscCall(SolveWithMass(tao, 1.0, "  no mass"));
  PetscCall(TaoIPFilterSetSlackMass(tao, mass));
  PetscCall(SolveWithMass(tao, 2.0, "  mass 2"));
  PetscCall(VecSet(mass, 5.0));
  PetscCall(SolveWithMass(tao, 5.0, "  mass 5"));
  PetscCall(TaoIPFilterSetSlackMass(tao, NULL));
  PetscCall(SolveWithMass(tao, 1.0, "  no mass again"));
  PetscCall(VecDestroy(&mass));
  PetscCall(VecDestroy(&x));
  PetscCall(TaoDestroy(&tao));
  PetscCall(DestroyChain(&chain));
  PetscFunctionReturn(0);
}

/* One solver without TaoSetHessian() for several numbers of unknowns, of which the last is too large for differences;
   then it gets a Hessian, which takes one step */
static PetscErrorCode TestOwnHessian(void)
{
  const PetscInt sizes[] = {8, 12, 5, 1500};
  PetscInt       its;
  Chain          chain;
  Tao            tao;
  Vec            x;

  PetscFunctionBeginUser;
  PetscCall(TaoCreate(PETSC_COMM_WORLD, &tao));
  PetscCall(TaoSetType(tao, TAOIPFILTER));
  for (size_t k = 0; k < PETSC_STATIC_ARRAY_LENGTH(sizes); k++) {
    PetscReal residual;

    PetscCall(CreateChain(sizes[k], &chain));
    PetscCall(VecDuplicate(chain.q.b, &x));
    PetscCall(TaoSetSolution(tao, x));
    PetscCall(TaoSetObjectiveAndGradient(tao, NULL, ProblemObjectiveAndGradient, &chain.q));
    PetscCall(AttemptBegin());
    (void)TaoSolve(tao);
    PetscCall(AttemptEnd());
    PetscCall(PetscPrintf(PETSC_COMM_WORLD, "no Hessian, %" PetscInt_FMT " unknowns: %s\n", sizes[k],
      attempt_sentence[0] ? attempt_sentence : "solved"));
    if (k + 1 == PETSC_STATIC_ARRAY_LENGTH(sizes)) {
      PetscCall(TaoSetHessian(tao, chain.q.H, chain.q.H, ProblemConstant, NULL));
      PetscCall(TaoSolve(tao));
      PetscCall(TaoGetIterationNumber(tao, &its));
      PetscCall(PetscPrintf(PETSC_COMM_WORLD, "then a Hessian: %s\n", its == 1 ? "one step" : "MORE THAN ONE STEP"));
    }
    PetscCall(MatMult(chain.q.H, x, chain.lower));
    PetscCall(VecAXPY(chain.lower, -1.0, chain.q.b));
    PetscCall(VecNorm(chain.lower, NORM_2, &residual));
    PetscCall(ProblemVerdict("  residual", residual, 1e-6));
    PetscCall(VecDestroy(&x));
    PetscCall(DestroyChain(&chain));
  }
  PetscCall(TaoDestroy(&tao));
  PetscFunctionReturn(0);
}

/* The sentence, but of NaN only that it is refused: PETSc 3.25 does so itself */
static PetscErrorCode PrintRefusal(const char option[], const char value[], PetscErrorCode ierr)
{
  PetscFunctionBeginUser;
  if (strcmp(value, "nan")) PetscCall(AttemptPrint(ierr));
  else PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%s nan: %s\n", option, ierr ? "refused" : "NO ERROR"));
  PetscFunctionReturn(0);
}

/* Options with values that they cannot have */
static PetscErrorCode TestOptionRanges(void)
{
  static const struct {
    const char *name, *value;
  } wrong[] = {
    {"-tao_ipfilter_slack_init", "0"},
    {"-tao_ipfilter_slack_init", "-1"},
    {"-tao_ipfilter_proximal", "0"},
    {"-tao_ipfilter_proximal", "-1"},
    {"-tao_ipfilter_mu_init", "nan"},
    {"-tao_ipfilter_dual_init", "0"},
    {"-tao_ipfilter_gamma_phi", "-1"},
    {"-tao_ipfilter_eta_phi", "2"},
    {"-tao_ipfilter_delta_max", "0"},
    {"-tao_ipfilter_filter_switch", "-1"},
    {"-tao_ipfilter_direct_memory", "-1"},
    {"-tao_ipfilter_max_soc", "-3"},
    {"-tao_ipfilter_mu_reductions_first", "-1"},
  };

  PetscFunctionBeginUser;
  for (size_t k = 0; k < PETSC_STATIC_ARRAY_LENGTH(wrong); k++) {
    Tao            tao;
    PetscErrorCode ierr;

    PetscCall(PetscOptionsSetValue(NULL, wrong[k].name, wrong[k].value));
    PetscCall(TaoCreate(PETSC_COMM_WORLD, &tao));
    PetscCall(TaoSetType(tao, TAOIPFILTER));
    PetscCall(AttemptBegin());
    ierr = TaoSetFromOptions(tao);
    PetscCall(AttemptEnd());
    PetscCall(AttemptCompareRanks(wrong[k].name, ierr));
    PetscCall(PrintRefusal(wrong[k].name, wrong[k].value, ierr));
    PetscCall(TaoDestroy(&tao));
    PetscCall(PetscOptionsClearValue(NULL, wrong[k].name));
  }
  PetscFunctionReturn(0);
}

/* Tests that no solve begins with a tolerance that is infinite or not a number, or with constraints of
   TaoSetConstraintsRoutine(), which the solver does not use */
static PetscErrorCode TestRefusedProblems(void)
{
  const char *const nans[] = {"-tao_gatol", "-tao_catol"};

  PetscFunctionBeginUser;
  for (PetscInt k = 0; k < 5; k++) {
    Chain          chain;
    Tao            tao;
    Vec            x;
    PetscErrorCode ierr = 0;

    PetscCall(CreateChain(8, &chain));
    PetscCall(VecDuplicate(chain.q.b, &x));
    PetscCall(CreateChainSolver(&chain, PETSC_TRUE, PETSC_FALSE, PETSC_FALSE, x, &tao));
    if (k == 2) PetscCall(TaoSetTolerances(tao, INFINITY, PETSC_DEFAULT, PETSC_DEFAULT));
    if (k == 3) PetscCall(TaoSetConstraintTolerances(tao, INFINITY, PETSC_DEFAULT));
    if (k == 4) PetscCall(TaoSetConstraintsRoutine(tao, x, TotalConstraint, NULL));
    if (k < 2) PetscCall(PetscOptionsSetValue(NULL, nans[k], "nan"));
    PetscCall(AttemptBegin());
    if (k < 2) ierr = TaoSetFromOptions(tao);
    if (!ierr) ierr = TaoSolve(tao);
    PetscCall(AttemptEnd());
    if (k < 2) PetscCall(PetscOptionsClearValue(NULL, nans[k]));
    PetscCall(AttemptCompareRanks("refused problems", ierr));
    PetscCall(PrintRefusal(k < 2 ? nans[k] : "", k < 2 ? "nan" : "", ierr));
    PetscCall(VecDestroy(&x));
    PetscCall(TaoDestroy(&tao));
    PetscCall(DestroyChain(&chain));
  }
  PetscFunctionReturn(0);
}

/* An options prefix that is set after the type */
static PetscErrorCode TestPrefix(void)
{
  Tao         tao;
  KSP         ksp;
  const char *prefix;
  PetscBool   gmres;

  PetscFunctionBeginUser;
  PetscCall(PetscOptionsSetValue(NULL, "-own_tao_ipfilter_ksp_type", "gmres"));
  PetscCall(TaoCreate(PETSC_COMM_WORLD, &tao));
  PetscCall(TaoSetType(tao, TAOIPFILTER));
  PetscCall(TaoSetOptionsPrefix(tao, "own_"));
  PetscCall(TaoSetFromOptions(tao));
  PetscCall(TaoGetKSP(tao, &ksp));
  PetscCall(KSPGetOptionsPrefix(ksp, &prefix));
  PetscCall(PetscObjectTypeCompare((PetscObject)ksp, KSPGMRES, &gmres));
  PetscCall(
    PetscPrintf(PETSC_COMM_WORLD, "prefix of the KSP: %s, its option is %s\n", prefix, gmres ? "read" : "NOT READ"));
  PetscCall(TaoDestroy(&tao));
  PetscCall(PetscOptionsClearValue(NULL, "-own_tao_ipfilter_ksp_type"));
  PetscFunctionReturn(0);
}

/* A Hessian with an entry that is not a number, without and with equality constraints */
static PetscErrorCode TestUndefinedHessian(PetscBool total)
{
  Chain       chain;
  Tao         tao;
  Mat         H;
  Vec         x;
  PetscInt    lo, hi;
  const char *sentence;

  PetscFunctionBeginUser;
  PetscCall(CreateChain(20, &chain));
  PetscCall(VecDuplicate(chain.q.b, &x));
  PetscCall(CreateChainSolver(&chain, PETSC_FALSE, total, PETSC_FALSE, x, &tao));
  PetscCall(MatDuplicate(chain.q.H, MAT_COPY_VALUES, &H));
  PetscCall(MatGetOwnershipRange(H, &lo, &hi));
  if (lo <= 7 && hi > 7) PetscCall(MatSetValue(H, 7, 7, NAN, INSERT_VALUES));
  PetscCall(MatAssemblyBegin(H, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(H, MAT_FINAL_ASSEMBLY));
  PetscCall(TaoSetHessian(tao, H, H, ProblemConstant, NULL));
  PetscCall(TaoSolve(tao));
  PetscCall(TaoIPFilterGetReason(tao, &sentence));
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "NaN in the Hessian%s: %s\n", total ? ", equality" : "",
    strstr(sentence, "not a number") ? "it is said" : sentence));
  PetscCall(MatDestroy(&H));
  PetscCall(VecDestroy(&x));
  PetscCall(TaoDestroy(&tao));
  PetscCall(DestroyChain(&chain));
  PetscFunctionReturn(0);
}

/* What the solver tells of a solve */
static PetscErrorCode PrintStatus(Tao tao, const char name[])
{
  PetscReal   figures[5];
  PetscInt    known = 0;
  const char *sentence;

  PetscFunctionBeginUser;
  PetscCall(TaoGetSolutionStatus(tao, NULL, &figures[0], &figures[1], &figures[2], NULL, NULL));
  PetscCall(TaoIPFilterGetKKTError(tao, &figures[3], &figures[4]));
  PetscCall(TaoIPFilterGetReason(tao, &sentence));
  for (PetscInt k = 0; k < 5; k++) known += !PetscIsNanReal(figures[k]);
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%s: %" PetscInt_FMT " figures, \"%.9s\"\n", name, known, sentence));
  PetscFunctionReturn(0);
}

/* After a solve with a result, a start that is not a number, and an error: they have no figures of the first */
static PetscErrorCode TestStatus(void)
{
  Chain          chain;
  Tao            tao;
  Vec            x, other;
  PetscErrorCode ierr;

  PetscFunctionBeginUser;
  PetscCall(CreateChain(20, &chain));
  PetscCall(VecDuplicate(chain.q.b, &x));
  PetscCall(CreateChainSolver(&chain, PETSC_TRUE, PETSC_FALSE, PETSC_FALSE, x, &tao));
  PetscCall(TaoSolve(tao));
  PetscCall(PrintStatus(tao, "status of a solve"));
  PetscCall(VecSet(x, NAN));
  PetscCall(TaoSolve(tao));
  PetscCall(PrintStatus(tao, "status of a start with NaN"));
  PetscCall(VecSet(x, 0.0));
  PetscCall(TaoSolve(tao));
  PetscCall(PrintStatus(tao, "status of a solve"));
  PetscCall(VecCreateMPI(PETSC_COMM_WORLD, PETSC_DECIDE, 2 * chain.n, &other));
  PetscCall(VecSet(other, 1.0));
  PetscCall(TaoIPFilterSetPrimalMass(tao, other));
  PetscCall(AttemptBegin());
  ierr = TaoSolve(tao);
  PetscCall(AttemptEnd());
  PetscCall(AttemptCompareRanks("status", ierr));
  PetscCall(TaoIPFilterSetPrimalMass(tao, NULL));
  PetscCall(PrintStatus(tao, "status of an error"));
  PetscCall(VecDestroy(&other));
  PetscCall(VecDestroy(&x));
  PetscCall(TaoDestroy(&tao));
  PetscCall(DestroyChain(&chain));
  PetscFunctionReturn(0);
}

/* A tolerance far below rounding errors ends a solve as 0 does */
static PetscErrorCode TestTinyTolerance(PetscReal gatol)
{
  Chain              chain;
  Tao                tao;
  Vec                x;
  TaoConvergedReason reason;
  const char        *sentence;

  PetscFunctionBeginUser;
  PetscCall(CreateChain(20, &chain));
  PetscCall(FillVec(chain.q.g, 1.2, 0.15));
  PetscCall(VecDuplicate(chain.q.b, &x));
  PetscCall(CreateChainSolver(&chain, PETSC_TRUE, PETSC_FALSE, PETSC_FALSE, x, &tao));
  PetscCall(TaoSetTolerances(tao, gatol, PETSC_DEFAULT, PETSC_DEFAULT));
  PetscCall(PetscOptionsSetValue(NULL, "-tao_ipfilter_subspace", "false"));
  PetscCall(TaoSetFromOptions(tao));
  PetscCall(TaoSolve(tao));
  PetscCall(TaoGetConvergedReason(tao, &reason));
  PetscCall(TaoIPFilterGetReason(tao, &sentence));
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "tolerance %g: %s\n", (double)gatol, reason > 0 ? "solved" : sentence));
  PetscCall(PetscOptionsClearValue(NULL, "-tao_ipfilter_subspace"));
  PetscCall(VecDestroy(&x));
  PetscCall(TaoDestroy(&tao));
  PetscCall(DestroyChain(&chain));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  PetscBool refused;

  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, help));
  PetscCall(PetscAMGFInitializePackage());
  PetscCall(PetscOptionsHasName(NULL, NULL, "-refused", &refused));
  if (refused) {
    PetscCall(TestOptionRanges());
    PetscCall(TestRefusedProblems());
    PetscCall(PetscFinalize());
    return 0;
  }
  PetscCall(TestConvergenceTests());
  PetscCall(TestConstraintTolerances());
  PetscCall(TestBoundMultipliers());
  PetscCall(TestWarmStart());
  PetscCall(TestSides(1, "two sides"));
  PetscCall(TestSides(2, "two sides or an upper one"));
  PetscCall(TestSides(5, "bounds of all kinds"));
  PetscCall(TestCrossedSides());
  PetscCall(TestLayouts());
  PetscCall(TestSlackMass(PETSC_FALSE));
  PetscCall(TestSlackMass(PETSC_TRUE));
  PetscCall(TestOwnHessian());
  PetscCall(TestPrefix());
  PetscCall(TestUndefinedHessian(PETSC_FALSE));
  PetscCall(TestUndefinedHessian(PETSC_TRUE));
  PetscCall(TestStatus());
  PetscCall(TestTinyTolerance(0.0));
  PetscCall(TestTinyTolerance(1e-50));
  PetscCall(PetscFinalize());
  return 0;
}

/*TEST

   test:
      suffix: 1
      nsize: {{1 2 3}}

   # what an error leaves allocated is no leak
   test:
      suffix: refused
      nsize: {{1 3}}
      args: -refused -malloc_dump 0

TEST*/
