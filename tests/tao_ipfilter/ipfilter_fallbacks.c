static char help[] =
  "Linear solvers that fail: each is seen, another takes its place in order, or the solve ends and says so.\n\n";

#include "ipfilter_problem.h"
#include "ipfilter_separable.h"

/* A string of n masses on springs that stiffen, f = 1/2 x^T K x + 1/4 sum_i c_i x_i^4 + sum_i x_i. Each of the second
   n/20 masses and one of the first hold an obstacle between them: (x_i + x_j)/2 >= -depth. */
typedef struct {
  PetscReal string; /* stiffness of the string, */
  PetscReal rest;   /* of the springs at rest, negative where they buckle, */
  PetscReal rods;   /* and of rods from those to the third n/20, times powers of ten */
  Mat       K, J;
} String;

static const PetscReal depth = 0.3;

/* A spring's fourth-order term and the load. The former differ by orders of magnitude: the stiffness at rest says
   nothing about later */
static void Spring(const void *ctx, PetscInt i, PetscReal x, PetscReal *f, PetscReal *g, PetscReal *h)
{
  const PetscReal c = PetscPowReal(10.0, (PetscReal)(i % 7) - 3.0);

  (void)ctx;
  *f = 0.25 * c * PetscPowReal(x, 4.0) + x;
  *g = c * PetscPowReal(x, 3.0) + 1.0;
  *h = 3.0 * c * PetscSqr(x);
}

static PetscErrorCode Gradient(Tao tao, Vec x, PetscReal *f, Vec g, void *user)
{
  PetscScalar xKx;

  PetscFunctionBeginUser;
  (void)tao;
  PetscCall(MatMult(((String *)user)->K, x, g));
  PetscCall(VecDot(x, g, &xKx));
  *f = 0.5 * PetscRealPart(xKx);
  PetscCall(SeparableAddGradient(Spring, NULL, x, f, g));
  PetscFunctionReturn(0);
}

static PetscErrorCode Hessian(Tao tao, Vec x, Mat H, Mat Hpre, void *user)
{
  PetscFunctionBeginUser;
  (void)tao;
  (void)Hpre;
  PetscCall(MatCopy(((String *)user)->K, H, SAME_NONZERO_PATTERN));
  PetscCall(SeparableAddHessian(Spring, NULL, x, H));
  PetscFunctionReturn(0);
}

static PetscErrorCode Constraints(Tao tao, Vec x, Vec c, void *user)
{
  PetscFunctionBeginUser;
  (void)tao;
  PetscCall(MatMult(((String *)user)->J, x, c));
  PetscCall(VecShift(c, depth));
  PetscFunctionReturn(0);
}

static PetscErrorCode AddSpring(Mat K, PetscInt i, PetscInt j, PetscReal k)
{
  const PetscInt    rows[2] = {i, j};
  const PetscScalar v[4]    = {k, -k, -k, k};

  PetscFunctionBeginUser;
  PetscCall(MatSetValues(K, 2, rows, 2, rows, v, ADD_VALUES));
  PetscFunctionReturn(0);
}

static PetscErrorCode CreateString(PetscInt n, String *s, Vec *x)
{
  PetscInt lo, hi, m = n / 20, rows, first;

  PetscFunctionBeginUser;
  PetscCall(VecCreateMPI(PETSC_COMM_WORLD, PETSC_DECIDE, n, x));
  PetscCall(VecGetOwnershipRange(*x, &lo, &hi));
  PetscCall(MatCreateAIJ(PETSC_COMM_WORLD, hi - lo, hi - lo, n, n, 5, NULL, 5, NULL, &s->K));
  for (PetscInt i = lo; i < hi; i++) {
    PetscCall(MatSetValue(s->K, i, i, s->rest, ADD_VALUES));
    if (i > 0) PetscCall(AddSpring(s->K, i - 1, i, s->string));
    if (s->rods > 0.0 && i >= m && i < 2 * m)
      PetscCall(AddSpring(s->K, i, i + m, s->rods * PetscPowReal(10.0, (PetscReal)(i % 5))));
  }
  PetscCall(MatAssemblyBegin(s->K, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(s->K, MAT_FINAL_ASSEMBLY));
  rows = PetscMax(0, PetscMin(hi, 2 * m) - PetscMax(lo, m));
  PetscCall(MatCreateAIJ(PETSC_COMM_WORLD, rows, hi - lo, PETSC_DETERMINE, n, 2, NULL, 2, NULL, &s->J));
  PetscCall(MatGetOwnershipRange(s->J, &first, NULL));
  for (PetscInt k = 0; k < rows; k++) {
    const PetscInt    i = PetscMax(lo, m) + k, pair[2] = {i, i - m}, row = first + k;
    const PetscScalar half[2] = {0.5, 0.5};

    PetscCall(MatSetValues(s->J, 1, &row, 2, pair, half, INSERT_VALUES));
  }
  PetscCall(MatAssemblyBegin(s->J, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(s->J, MAT_FINAL_ASSEMBLY));
  PetscFunctionReturn(0);
}

static const char *Said(PetscBool some)
{
  return some ? "some" : "none";
}

static PetscErrorCode Report(Tao tao, const char name[], PetscReal *optimum)
{
  TaoConvergedReason   reason;
  TaoIPFilterFallbacks count;
  PetscReal            f;
  PetscInt             shifted, n, sum = 0;
  const PetscInt      *its;
  const char          *sentence;

  PetscFunctionBeginUser;
  PetscCall(TaoGetSolutionStatus(tao, NULL, &f, NULL, NULL, NULL, &reason));
  PetscCall(TaoIPFilterGetFallbacks(tao, &count));
  PetscCall(TaoIPFilterGetRegularizations(tao, &shifted, NULL, NULL));
  PetscCall(TaoIPFilterGetReason(tao, &sentence));
  PetscCall(TaoIPFilterGetKSPIterations(tao, &n, &its));
  for (PetscInt k = 0; k < n; k++) sum += its[k];
  PetscCall(PetscPrintf(PETSC_COMM_WORLD,
    "%s: %s\n  refined %s, AMG rebuilt %s, larger filter %s, by MUMPS %s, failed %s, Hessian shifted %s\n", name,
    TaoConvergedReasons[reason], Said((PetscBool)(count.refinements > 0)), Said((PetscBool)(count.amg_rebuilds > 0)),
    Said((PetscBool)(count.filters > 0)), Said((PetscBool)(count.direct > 0)), Said((PetscBool)(count.failures > 0)),
    Said((PetscBool)(shifted > 0))));
  if (reason < 0)
    PetscCall(PetscPrintf(PETSC_COMM_WORLD, "  after %s iterations: %.20s...; %.17s\n", sum <= 20 ? "few" : "MANY",
      sentence, strstr(sentence, "; ") ? strstr(sentence, "; ") + 2 : "no more is said"));
  else if (*optimum == PETSC_INFINITY) *optimum = f;
  else
    PetscCall(ProblemVerdict("  objective against that of the first",
      PetscAbsReal(f - *optimum) / PetscAbsReal(*optimum), 1e-7));
  PetscFunctionReturn(0);
}

static PetscErrorCode Test(const char name[], const char text[], PetscReal string, PetscReal rest, PetscReal rods,
  PetscReal *optimum)
{
  String       s = {string, rest, rods, NULL, NULL};
  Vec          x, c;
  Mat          H;
  Tao          tao;
  PetscOptions options;
  PetscReal    own = PETSC_INFINITY;

  PetscFunctionBeginUser;
  PetscCall(PetscOptionsCreate(&options));
  PetscCall(PetscOptionsInsertString(options,
    "-tao_ipfilter_subspace false -tao_ipfilter_amgf_amg_pc_type jacobi -tao_max_it 100"));
  PetscCall(PetscOptionsInsertString(options, text));
  PetscCall(PetscOptionsPush(options));
  PetscCall(CreateString(520, &s, &x));
  PetscCall(MatDuplicate(s.K, MAT_COPY_VALUES, &H));
  PetscCall(MatCreateVecs(s.J, NULL, &c));
  PetscCall(TaoCreate(PETSC_COMM_WORLD, &tao));
  PetscCall(TaoSetType(tao, TAOIPFILTER));
  PetscCall(TaoSetSolution(tao, x));
  PetscCall(TaoSetObjectiveAndGradient(tao, NULL, Gradient, &s));
  PetscCall(TaoSetHessian(tao, H, H, Hessian, &s));
  PetscCall(TaoSetInequalityConstraintsRoutine(tao, c, Constraints, &s));
  PetscCall(TaoSetJacobianInequalityRoutine(tao, s.J, s.J, ProblemConstant, NULL));
  PetscCall(TaoSetFromOptions(tao));
  PetscCall(TaoSolve(tao));
  PetscCall(Report(tao, name, optimum ? optimum : &own));
  PetscCall(TaoDestroy(&tao));
  PetscCall(MatDestroy(&s.K));
  PetscCall(MatDestroy(&s.J));
  PetscCall(MatDestroy(&H));
  PetscCall(VecDestroy(&x));
  PetscCall(VecDestroy(&c));
  PetscCall(PetscOptionsPop());
  PetscCall(PetscOptionsDestroy(&options));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  PetscReal optimum = PETSC_INFINITY, taut = PETSC_INFINITY, stiff = PETSC_INFINITY;

  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, help));
  PetscCall(PetscAMGFInitializePackage());
  PetscCall(Test("no difficulty", "", 0.001, 1.0, 0.0, &optimum));
  PetscCall(Test("preconditioned norm", "-tao_ipfilter_ksp_norm_type preconditioned", 0.001, 1.0, 0.0, &optimum));
  PetscCall(Test("MINRES", "-tao_ipfilter_ksp_type minres", 0.001, 1.0, 0.0, &optimum));
  PetscCall(Test("SYMMLQ", "-tao_ipfilter_ksp_type symmlq", 0.001, 1.0, 0.0, &optimum));
  PetscCall(Test("AMG of the first matrix",
    "-tao_ipfilter_pc_amgf_amg_lag -1 -tao_ipfilter_ksp_max_it 4 -tao_ipfilter_direct_memory 0", 0.001, 1.0, 0.0,
    &optimum));
  PetscCall(
    Test("no filter", "-tao_ipfilter_filter_switch 1e30 -tao_ipfilter_ksp_max_it 5 -tao_ipfilter_direct_memory 0",
      0.001, 1.0, 0.0, &optimum));
  PetscCall(Test("no PC", "-tao_ipfilter_ksp_type preonly -tao_ipfilter_pc_type none", 0.001, 1.0, 0.0, &optimum));
  PetscCall(Test("taut string", "", 1.0, 0.001, 0.0, &taut));
  PetscCall(Test("taut string, one iteration of CG", "-tao_ipfilter_ksp_max_it 1", 1.0, 0.001, 0.0, &taut));
  PetscCall(Test("taut string, one iteration of CG, no memory",
    "-tao_ipfilter_pc_type jacobi -tao_ipfilter_ksp_max_it 1 -tao_ipfilter_direct_memory 0", 1.0, 0.001, 0.0, &taut));
  PetscCall(Test("buckling springs, one iteration of CG", "-tao_ipfilter_pc_type jacobi -tao_ipfilter_ksp_max_it 1",
    0.1, -0.2, 0.0, NULL));
  PetscCall(Test("stiff rods", "-tao_ipfilter_pc_type cholesky -tao_ipfilter_pc_factor_mat_solver_type mumps", 0.001,
    1.0, 10.0, &stiff));
  PetscCall(Test("stiff rods, their ends to be filtered",
    "-tao_ipfilter_filter_switch 0 -tao_ipfilter_ksp_max_it 12 -tao_ipfilter_pc_amgf_amg_lag -1 "
    "-tao_ipfilter_direct_memory 0",
    0.001, 1.0, 10.0, &stiff));
  PetscCall(PetscFinalize());
  return 0;
}

/*TEST

   test:
      suffix: 1
      nsize: {{1 3}}

TEST*/
