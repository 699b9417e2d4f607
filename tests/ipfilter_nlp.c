static char help[] = "Small problems of Hock and Schittkowski's collection, and a saddle, whose solutions are known.\n\n";

#include <petscamgf.h>

#define MAXN 4 /* unknowns */
#define MAXM 3 /* constraints of one kind */

/* q(x) = 1/2 x^T Q x + a^T x + b with the upper triangle of Q given row by row */
typedef struct {
  PetscReal Q[10], a[MAXN], b;
} Quadratic;

typedef struct {
  const char *name;
  PetscInt    n, mi, me;
  PetscReal   start[MAXN];
  PetscReal   lower[MAXN], upper[MAXN];
  Quadratic   f, ci[MAXM], ce[1];
  PetscReal   optimum;
  PetscReal   solution[MAXN];
} Problem;

#define INF PETSC_INFINITY
#define FREE2 {-INF, -INF}, {INF, INF}
#define FREE4 {-INF, -INF, -INF, -INF}, {INF, INF, INF, INF}

/* The numbers are the collection's. Newton's method left to itself ends in the saddle of the last one. */
static const Problem problems[] = {
  {"HS3",  2, 0, 0, {10, 1}, {-INF, 0}, {INF, INF}, {{2e-5, -2e-5, 2e-5}, {0, 1}, 0}, {{{0}, {0}, 0}}, {{{0}, {0}, 0}}, 0.0, {0, 0}},
  {"HS10", 2, 1, 0, {-10, 10}, FREE2, {{0}, {1, -1}, 0}, {{{-6, 2, -2}, {0}, 1}}, {{{0}, {0}, 0}}, -1.0, {0, 1}},
  {"HS11", 2, 1, 0, {4.9, 0.1}, FREE2, {{2, 0, 2}, {-10, 0}, 0}, {{{-2, 0, 0}, {0, 1}, 0}}, {{{0}, {0}, 0}}, -8.49846422315, {1.2347728, 1.5246638}},
  {"HS12", 2, 1, 0, {0, 0}, FREE2, {{1, -1, 2}, {-7, -7}, 0}, {{{-8, 0, -2}, {0}, 25}}, {{{0}, {0}, 0}}, -30.0, {2, 3}},
  {"HS21", 2, 1, 0, {-1, -1}, {2, -50}, {50, 50}, {{0.02, 0, 2}, {0}, -100}, {{{0}, {10, -1}, -10}}, {{{0}, {0}, 0}}, -99.96, {2, 0}},
  {"HS22", 2, 2, 0, {2, 2}, FREE2, {{2, 0, 2}, {-4, -2}, 5}, {{{0}, {-1, -1}, 2}, {{-2, 0, 0}, {0, 1}, 0}}, {{{0}, {0}, 0}}, 1.0, {1, 1}},
  {"HS28", 3, 0, 1, {-4, 1, 1}, {-INF, -INF, -INF}, {INF, INF, INF}, {{2, 2, 0, 4, 2, 2}, {0}, 0}, {{{0}, {0}, 0}}, {{{0}, {1, 2, 3}, -1}}, 0.0, {0.5, -0.5, 0.5}},
  {"HS35", 3, 1, 0, {0.5, 0.5, 0.5}, {0, 0, 0}, {INF, INF, INF}, {{4, 2, 2, 4, 0, 2}, {-8, -6, -4}, 9}, {{{0}, {-1, -1, -2}, 3}}, {{{0}, {0}, 0}}, 1.0 / 9.0, {4.0 / 3.0, 7.0 / 9.0, 4.0 / 9.0}},
  {"HS43", 4, 3, 0, {0, 0, 0, 0}, FREE4, {{2, 0, 0, 0, 2, 0, 0, 4, 0, 2}, {-5, -5, -21, 7}, 0},
   {{{-2, 0, 0, 0, -2, 0, 0, -2, 0, -2}, {-1, 1, -1, 1}, 8}, {{-2, 0, 0, 0, -4, 0, 0, -2, 0, -4}, {1, 0, 0, 1}, 10}, {{-4, 0, 0, 0, -2, 0, 0, -2, 0, 0}, {-2, 1, 0, 1}, 5}}, {{{0}, {0}, 0}}, -44.0, {0, 1, 2, -1}},
  {"HS76", 4, 3, 0, {0.5, 0.5, 0.5, 0.5}, {0, 0, 0, 0}, {INF, INF, INF, INF}, {{2, 0, -1, 0, 1, 0, 0, 2, 1, 1}, {-1, -3, 1, -1}, 0},
   {{{0}, {-1, -2, -1, -1}, 5}, {{0}, {-3, -1, -2, 1}, 4}, {{0}, {0, 1, 4, 0}, -1.5}}, {{{0}, {0}, 0}}, -4.68181818181818, {3.0 / 11.0, 23.0 / 11.0, 0, 6.0 / 11.0}},
  {"saddle", 2, 0, 0, {0.5, 0.1}, {-1, -1}, {2, 2}, {{-2, 0, 2}, {0}, 0}, {{{0}, {0}, 0}}, {{{0}, {0}, 0}}, -4.0, {2, 0}},
};

/* A problem on a communicator: every rank evaluates with the whole x and sets the rows it owns */
typedef struct {
  const Problem *p;
  VecScatter     all;
  Vec            whole;
} Context;

static PetscReal Second(const Quadratic *q, PetscInt n, PetscInt i, PetscInt j)
{
  const PetscInt r = PetscMin(i, j), c = PetscMax(i, j);

  return q->Q[r * n - r * (r - 1) / 2 + c - r];
}

static PetscReal Value(const Quadratic *q, PetscInt n, const PetscScalar x[])
{
  PetscReal v = q->b;

  for (PetscInt i = 0; i < n; i++) {
    v += q->a[i] * PetscRealPart(x[i]);
    for (PetscInt j = 0; j < n; j++) v += 0.5 * Second(q, n, i, j) * PetscRealPart(x[i] * x[j]);
  }
  return v;
}

static PetscReal First(const Quadratic *q, PetscInt n, const PetscScalar x[], PetscInt i)
{
  PetscReal v = q->a[i];

  for (PetscInt j = 0; j < n; j++) v += Second(q, n, i, j) * PetscRealPart(x[j]);
  return v;
}

static PetscErrorCode Gather(Context *ctx, Vec x, const PetscScalar *a[])
{
  PetscFunctionBeginUser;
  PetscCall(VecScatterBegin(ctx->all, x, ctx->whole, INSERT_VALUES, SCATTER_FORWARD));
  PetscCall(VecScatterEnd(ctx->all, x, ctx->whole, INSERT_VALUES, SCATTER_FORWARD));
  PetscCall(VecGetArrayRead(ctx->whole, a));
  PetscFunctionReturn(0);
}

static PetscErrorCode ObjectiveAndGradient(Tao tao, Vec x, PetscReal *f, Vec g, void *user)
{
  Context           *ctx = (Context *)user;
  const PetscScalar *a;
  PetscInt           lo, hi;

  PetscFunctionBeginUser;
  (void)tao;
  PetscCall(Gather(ctx, x, &a));
  *f = Value(&ctx->p->f, ctx->p->n, a);
  PetscCall(VecGetOwnershipRange(x, &lo, &hi));
  for (PetscInt i = lo; i < hi; i++) PetscCall(VecSetValue(g, i, First(&ctx->p->f, ctx->p->n, a, i), INSERT_VALUES));
  PetscCall(VecRestoreArrayRead(ctx->whole, &a));
  PetscCall(VecAssemblyBegin(g));
  PetscCall(VecAssemblyEnd(g));
  PetscFunctionReturn(0);
}

static PetscErrorCode Constraints(Context *ctx, const Quadratic q[], Vec x, Vec c)
{
  const PetscScalar *a;
  PetscInt           lo, hi;

  PetscFunctionBeginUser;
  PetscCall(Gather(ctx, x, &a));
  PetscCall(VecGetOwnershipRange(c, &lo, &hi));
  for (PetscInt i = lo; i < hi; i++) PetscCall(VecSetValue(c, i, Value(&q[i], ctx->p->n, a), INSERT_VALUES));
  PetscCall(VecRestoreArrayRead(ctx->whole, &a));
  PetscCall(VecAssemblyBegin(c));
  PetscCall(VecAssemblyEnd(c));
  PetscFunctionReturn(0);
}

static PetscErrorCode Jacobian(Context *ctx, const Quadratic q[], Vec x, Mat J)
{
  const PetscScalar *a;
  PetscInt           lo, hi;

  PetscFunctionBeginUser;
  PetscCall(Gather(ctx, x, &a));
  PetscCall(MatGetOwnershipRange(J, &lo, &hi));
  for (PetscInt i = lo; i < hi; i++)
    for (PetscInt j = 0; j < ctx->p->n; j++) PetscCall(MatSetValue(J, i, j, First(&q[i], ctx->p->n, a, j), INSERT_VALUES));
  PetscCall(VecRestoreArrayRead(ctx->whole, &a));
  PetscCall(MatAssemblyBegin(J, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(J, MAT_FINAL_ASSEMBLY));
  PetscFunctionReturn(0);
}

static PetscErrorCode Inequality(Tao tao, Vec x, Vec c, void *user)
{
  PetscFunctionBeginUser;
  (void)tao;
  PetscCall(Constraints((Context *)user, ((Context *)user)->p->ci, x, c));
  PetscFunctionReturn(0);
}

static PetscErrorCode Equality(Tao tao, Vec x, Vec c, void *user)
{
  PetscFunctionBeginUser;
  (void)tao;
  PetscCall(Constraints((Context *)user, ((Context *)user)->p->ce, x, c));
  PetscFunctionReturn(0);
}

static PetscErrorCode InequalityJacobian(Tao tao, Vec x, Mat J, Mat Jpre, void *user)
{
  PetscFunctionBeginUser;
  (void)tao;
  (void)Jpre;
  PetscCall(Jacobian((Context *)user, ((Context *)user)->p->ci, x, J));
  PetscFunctionReturn(0);
}

static PetscErrorCode EqualityJacobian(Tao tao, Vec x, Mat J, Mat Jpre, void *user)
{
  PetscFunctionBeginUser;
  (void)tao;
  (void)Jpre;
  PetscCall(Jacobian((Context *)user, ((Context *)user)->p->ce, x, J));
  PetscFunctionReturn(0);
}

/* Hessian of f + DE^T c_E - DI^T c_I: quadratic functions, so it depends on the multipliers alone */
static PetscErrorCode Hessian(Tao tao, Vec x, Mat H, Mat Hpre, void *user)
{
  Context       *ctx = (Context *)user;
  const Problem *p   = ctx->p;
  Vec            dual[2];
  PetscReal      weight[2][MAXM] = {{0}, {0}};
  PetscInt       lo, hi;

  PetscFunctionBeginUser;
  (void)x;
  (void)Hpre;
  PetscCall(TaoGetDualVariables(tao, &dual[0], &dual[1]));
  for (PetscInt k = 0; k < 2; k++) {
    const PetscInt     m = k ? p->mi : p->me;
    VecScatter         all;
    Vec                whole;
    const PetscScalar *a;

    if (!m) continue;
    PetscCall(VecScatterCreateToAll(dual[k], &all, &whole));
    PetscCall(VecScatterBegin(all, dual[k], whole, INSERT_VALUES, SCATTER_FORWARD));
    PetscCall(VecScatterEnd(all, dual[k], whole, INSERT_VALUES, SCATTER_FORWARD));
    PetscCall(VecGetArrayRead(whole, &a));
    for (PetscInt i = 0; i < m; i++) weight[k][i] = k ? -PetscRealPart(a[i]) : PetscRealPart(a[i]);
    PetscCall(VecRestoreArrayRead(whole, &a));
    PetscCall(VecScatterDestroy(&all));
    PetscCall(VecDestroy(&whole));
  }
  PetscCall(MatGetOwnershipRange(H, &lo, &hi));
  for (PetscInt i = lo; i < hi; i++) {
    for (PetscInt j = 0; j < p->n; j++) {
      PetscReal v = Second(&p->f, p->n, i, j);

      for (PetscInt c = 0; c < p->me; c++) v += weight[0][c] * Second(&p->ce[c], p->n, i, j);
      for (PetscInt c = 0; c < p->mi; c++) v += weight[1][c] * Second(&p->ci[c], p->n, i, j);
      PetscCall(MatSetValue(H, i, j, v, INSERT_VALUES));
    }
  }
  PetscCall(MatAssemblyBegin(H, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(H, MAT_FINAL_ASSEMBLY));
  PetscFunctionReturn(0);
}

static PetscErrorCode VecFromArray(PetscInt n, const PetscReal a[], Vec *v)
{
  PetscInt lo, hi;

  PetscFunctionBeginUser;
  PetscCall(VecCreate(PETSC_COMM_WORLD, v));
  PetscCall(VecSetSizes(*v, PETSC_DECIDE, n));
  PetscCall(VecSetFromOptions(*v));
  PetscCall(VecGetOwnershipRange(*v, &lo, &hi));
  for (PetscInt i = lo; i < hi; i++) PetscCall(VecSetValue(*v, i, a ? a[i] : 0.0, INSERT_VALUES));
  PetscCall(VecAssemblyBegin(*v));
  PetscCall(VecAssemblyEnd(*v));
  PetscFunctionReturn(0);
}

static PetscErrorCode DenseAIJ(Vec rows, Vec cols, Mat *A)
{
  PetscInt m, n, M, N;

  PetscFunctionBeginUser;
  PetscCall(VecGetLocalSize(rows, &m));
  PetscCall(VecGetSize(rows, &M));
  PetscCall(VecGetLocalSize(cols, &n));
  PetscCall(VecGetSize(cols, &N));
  PetscCall(MatCreateAIJ(PETSC_COMM_WORLD, m, n, M, N, N, NULL, N, NULL, A));
  PetscFunctionReturn(0);
}

/* Stationarity of the returned point and multipliers in the components that are not at a bound, and the sign of DI */
static PetscErrorCode CheckMultipliers(Tao tao, Context *ctx, Vec x, Mat Ji, Mat Je, PetscReal *worst)
{
  const Problem     *p = ctx->p;
  Vec                g, DE, DI;
  const PetscScalar *ga, *xa;
  PetscReal          f, local = 0.0, least;
  PetscInt           lo, hi;

  PetscFunctionBeginUser;
  PetscCall(VecDuplicate(x, &g));
  PetscCall(ObjectiveAndGradient(tao, x, &f, g, ctx));
  PetscCall(TaoGetDualVariables(tao, &DE, &DI));
  if (p->me) PetscCall(MatMultTransposeAdd(Je, DE, g, g));
  if (p->mi) {
    PetscCall(VecMin(DI, NULL, &least));
    local = PetscMax(local, -least);
    PetscCall(VecScale(g, -1.0));
    PetscCall(MatMultTransposeAdd(Ji, DI, g, g));
  }
  PetscCall(VecGetOwnershipRange(x, &lo, &hi));
  PetscCall(VecGetArrayRead(g, &ga));
  PetscCall(VecGetArrayRead(x, &xa));
  for (PetscInt i = lo; i < hi; i++) {
    const PetscReal v = PetscRealPart(xa[i - lo]);

    if (v - p->lower[i] > 1e-4 && p->upper[i] - v > 1e-4) local = PetscMax(local, PetscAbsScalar(ga[i - lo]));
  }
  PetscCall(VecRestoreArrayRead(x, &xa));
  PetscCall(VecRestoreArrayRead(g, &ga));
  PetscCall(VecDestroy(&g));
  PetscCallMPI(MPI_Allreduce(&local, worst, 1, MPIU_REAL, MPIU_MAX, PETSC_COMM_WORLD));
  PetscFunctionReturn(0);
}

static PetscErrorCode Report(Tao tao, Context *ctx, Vec x, Mat Ji, Mat Je)
{
  const Problem     *p = ctx->p;
  Vec                exact;
  PetscReal          f, ferror, xerror, stationarity;
  TaoConvergedReason reason;
  const char        *sentence;

  PetscFunctionBeginUser;
  PetscCall(TaoGetSolutionStatus(tao, NULL, &f, NULL, NULL, NULL, &reason));
  PetscCall(TaoIPFilterGetReason(tao, &sentence));
  PetscCall(VecFromArray(p->n, p->solution, &exact));
  PetscCall(VecAXPY(exact, -1.0, x));
  PetscCall(VecNorm(exact, NORM_INFINITY, &xerror));
  PetscCall(VecDestroy(&exact));
  ferror = PetscAbsReal(f - p->optimum) / PetscMax(1.0, PetscAbsReal(p->optimum));
  PetscCall(CheckMultipliers(tao, ctx, x, Ji, Je, &stationarity));
  if (reason == TAO_CONVERGED_GATOL && ferror < 1e-7 && xerror < 1e-3 && stationarity < 1e-5) PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%-6s solved\n", p->name));
  else PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%-6s %s: objective error %g, solution error %g, stationarity %g; %s\n", p->name, TaoConvergedReasons[reason], (double)ferror, (double)xerror, (double)stationarity, sentence));
  PetscFunctionReturn(0);
}

static PetscErrorCode Solve(const Problem *p, PetscBool second)
{
  Context ctx = {p, NULL, NULL};
  Vec     x, xl, xu, ci, ce;
  Mat     H, Ji, Je;
  Tao     tao;

  PetscFunctionBeginUser;
  PetscCall(VecFromArray(p->n, p->start, &x));
  PetscCall(VecFromArray(p->n, p->lower, &xl));
  PetscCall(VecFromArray(p->n, p->upper, &xu));
  PetscCall(VecFromArray(p->mi, NULL, &ci));
  PetscCall(VecFromArray(p->me, NULL, &ce));
  PetscCall(DenseAIJ(x, x, &H));
  PetscCall(DenseAIJ(ci, x, &Ji));
  PetscCall(DenseAIJ(ce, x, &Je));
  PetscCall(VecScatterCreateToAll(x, &ctx.all, &ctx.whole));
  PetscCall(TaoCreate(PETSC_COMM_WORLD, &tao));
  PetscCall(TaoSetType(tao, TAOIPFILTER));
  PetscCall(TaoSetSolution(tao, x));
  PetscCall(TaoSetVariableBounds(tao, xl, xu));
  PetscCall(TaoSetObjectiveAndGradient(tao, NULL, ObjectiveAndGradient, &ctx));
  if (second) PetscCall(TaoSetHessian(tao, H, H, Hessian, &ctx));
  if (p->mi) {
    PetscCall(TaoSetInequalityConstraintsRoutine(tao, ci, Inequality, &ctx));
    PetscCall(TaoSetJacobianInequalityRoutine(tao, Ji, Ji, InequalityJacobian, &ctx));
  }
  if (p->me) {
    PetscCall(TaoSetEqualityConstraintsRoutine(tao, ce, Equality, &ctx));
    PetscCall(TaoSetJacobianEqualityRoutine(tao, Je, Je, EqualityJacobian, &ctx));
  }
  PetscCall(TaoSetFromOptions(tao));
  PetscCall(TaoSolve(tao));
  PetscCall(Report(tao, &ctx, x, Ji, Je));
  PetscCall(TaoDestroy(&tao));
  PetscCall(VecScatterDestroy(&ctx.all));
  PetscCall(VecDestroy(&ctx.whole));
  PetscCall(MatDestroy(&H));
  PetscCall(MatDestroy(&Ji));
  PetscCall(MatDestroy(&Je));
  PetscCall(VecDestroy(&x));
  PetscCall(VecDestroy(&xl));
  PetscCall(VecDestroy(&xu));
  PetscCall(VecDestroy(&ci));
  PetscCall(VecDestroy(&ce));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  PetscBool second = PETSC_TRUE, match;
  char      only[16] = "";

  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, help));
  PetscCall(PetscAMGFInitializePackage());
  PetscCall(PetscOptionsGetBool(NULL, NULL, "-hessian", &second, NULL));
  PetscCall(PetscOptionsGetString(NULL, NULL, "-problem", only, sizeof(only), NULL));
  for (size_t k = 0; k < PETSC_STATIC_ARRAY_LENGTH(problems); k++) {
    PetscCall(PetscStrcmp(only, problems[k].name, &match));
    if (!only[0] || match) PetscCall(Solve(&problems[k], second));
  }
  PetscCall(PetscFinalize());
  return 0;
}

/*TEST

   testset:
      output_file: output/ipfilter_nlp_1.out
      nsize: {{1 2 3}}

      test:
         suffix: monotone
         args: -tao_ipfilter_barrier monotone

      test:
         suffix: mehrotra
         args: -tao_ipfilter_barrier mehrotra

      test:
         suffix: direct
         args: -tao_ipfilter_ksp_type preonly -tao_ipfilter_pc_type lu -tao_ipfilter_pc_factor_mat_solver_type mumps

      test:
         suffix: differences
         args: -hessian 0

TEST*/
