static char help[] = "Small problems whose solutions are known: Hock and Schittkowski's, degenerate, infeasible, unbounded, badly scaled ones.\n\n";

#include "ipfilter_problem.h"
#include "ipfilter_expression.h"
#include "ipfilter_nlp.h"

#define MAXM 16 /* constraints of one kind */

/* Constraints of one kind; every rank evaluates with the whole x and sets the rows it owns */
typedef struct {
  PetscInt    n, m; /* unknowns, constraints */
  const char *formula[MAXM];
} Constraints;

typedef struct {
  const NLP  *p;
  PetscInt    n;
  Constraints ci, ce;
} Context;

/* The formulas of a list separated by semicolons */
static void Split(const char *list, PetscInt n, Constraints *c)
{
  c->n = n;
  c->m = 0;
  while (*list) {
    c->formula[c->m++] = list;
    list += strcspn(list, ";");
    if (*list) list++;
  }
}

/* Vector of the numbers in text, or bound k (0: lower, 1: upper) of each "lower:upper" in it */
static PetscErrorCode VecFromText(PetscInt n, const char *text, PetscInt k, Vec *v)
{
  PetscInt lo, hi;

  PetscFunctionBeginUser;
  PetscCall(VecCreateMPI(PETSC_COMM_WORLD, PETSC_DECIDE, n, v));
  PetscCall(VecGetOwnershipRange(*v, &lo, &hi));
  for (PetscInt i = 0; i < n; i++) {
    const char *entry, *end;
    char       *stop;
    PetscReal   value;

    while (isspace((unsigned char)*text)) text++;
    entry = text;
    text  = end = entry + strcspn(entry, " ");
    if (k >= 0) {
      const char *colon = *entry ? strchr(entry, ':') : entry;

      if (k) entry = *entry ? colon + 1 : entry;
      else end = colon;
    }
    value = strtod(entry, &stop);
    if (entry == end || stop == entry) value = k == 1 ? PETSC_INFINITY : PETSC_NINFINITY;
    if (i >= lo && i < hi) PetscCall(VecSetValue(*v, i, value, INSERT_VALUES));
  }
  PetscCall(VecAssemblyBegin(*v));
  PetscCall(VecAssemblyEnd(*v));
  PetscFunctionReturn(0);
}

/* All entries of a short vector on every rank */
static PetscErrorCode Gather(Vec v, PetscReal a[])
{
  VecScatter         all;
  Vec                whole;
  PetscInt           n;
  const PetscScalar *w;

  PetscFunctionBeginUser;
  PetscCall(VecScatterCreateToAll(v, &all, &whole));
  PetscCall(VecScatterBegin(all, v, whole, INSERT_VALUES, SCATTER_FORWARD));
  PetscCall(VecScatterEnd(all, v, whole, INSERT_VALUES, SCATTER_FORWARD));
  PetscCall(VecGetSize(whole, &n));
  PetscCall(VecGetArrayRead(whole, &w));
  for (PetscInt i = 0; i < n; i++) a[i] = PetscRealPart(w[i]);
  PetscCall(VecRestoreArrayRead(whole, &w));
  PetscCall(VecScatterDestroy(&all));
  PetscCall(VecDestroy(&whole));
  PetscFunctionReturn(0);
}

static PetscErrorCode ObjectiveAndGradient(Tao tao, Vec x, PetscReal *f, Vec g, void *user)
{
  Context  *ctx = (Context *)user;
  PetscReal a[EXPRESSION_MAX];
  PetscInt  lo, hi;
  Jet       jet;

  PetscFunctionBeginUser;
  (void)tao;
  PetscCall(Gather(x, a));
  jet = ExpressionEvaluate(ctx->p->objective, a, NULL);
  *f  = jet.v;
  PetscCall(VecGetOwnershipRange(x, &lo, &hi));
  for (PetscInt i = lo; i < hi; i++) PetscCall(VecSetValue(g, i, jet.g[i], INSERT_VALUES));
  PetscCall(VecAssemblyBegin(g));
  PetscCall(VecAssemblyEnd(g));
  PetscFunctionReturn(0);
}

static PetscErrorCode EvaluateConstraints(Tao tao, Vec x, Vec c, void *user)
{
  const Constraints *constraints = (const Constraints *)user;
  PetscReal          a[EXPRESSION_MAX];
  PetscInt           lo, hi;

  PetscFunctionBeginUser;
  (void)tao;
  PetscCall(Gather(x, a));
  PetscCall(VecGetOwnershipRange(c, &lo, &hi));
  for (PetscInt i = lo; i < hi; i++) PetscCall(VecSetValue(c, i, ExpressionEvaluate(constraints->formula[i], a, NULL).v, INSERT_VALUES));
  PetscCall(VecAssemblyBegin(c));
  PetscCall(VecAssemblyEnd(c));
  PetscFunctionReturn(0);
}

static PetscErrorCode EvaluateJacobian(Tao tao, Vec x, Mat J, Mat Jpre, void *user)
{
  const Constraints *constraints = (const Constraints *)user;
  PetscReal          a[EXPRESSION_MAX];
  PetscInt           lo, hi;

  PetscFunctionBeginUser;
  (void)tao;
  (void)Jpre;
  PetscCall(Gather(x, a));
  PetscCall(MatGetOwnershipRange(J, &lo, &hi));
  for (PetscInt i = lo; i < hi; i++) {
    Jet jet = ExpressionEvaluate(constraints->formula[i], a, NULL);

    for (PetscInt j = 0; j < constraints->n; j++) PetscCall(MatSetValue(J, i, j, jet.g[j], INSERT_VALUES));
  }
  PetscCall(MatAssemblyBegin(J, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(J, MAT_FINAL_ASSEMBLY));
  PetscFunctionReturn(0);
}

/* Adds the Hessians of the constraints times their multipliers */
static PetscErrorCode AddConstraints(const Constraints *c, const PetscReal x[], PetscReal sign, Vec multipliers, Jet *sum)
{
  PetscReal y[MAXM];

  PetscFunctionBeginUser;
  if (!c->m) PetscFunctionReturn(0);
  PetscCall(Gather(multipliers, y));
  for (PetscInt i = 0; i < c->m; i++) {
    Jet jet = ExpressionEvaluate(c->formula[i], x, NULL);

    *sum = JetAdd(sum, sign * y[i], &jet);
  }
  PetscFunctionReturn(0);
}

/* Hessian of f + DE^T c_E - DI^T c_I */
static PetscErrorCode Hessian(Tao tao, Vec x, Mat H, Mat Hpre, void *user)
{
  Context  *ctx = (Context *)user;
  Vec       DE, DI;
  PetscReal a[EXPRESSION_MAX];
  PetscInt  lo, hi;
  Jet       sum;

  PetscFunctionBeginUser;
  (void)Hpre;
  PetscCall(TaoGetDualVariables(tao, &DE, &DI));
  PetscCall(Gather(x, a));
  sum = ExpressionEvaluate(ctx->p->objective, a, NULL);
  PetscCall(AddConstraints(&ctx->ce, a, 1.0, DE, &sum));
  PetscCall(AddConstraints(&ctx->ci, a, -1.0, DI, &sum));
  PetscCall(MatGetOwnershipRange(H, &lo, &hi));
  for (PetscInt i = lo; i < hi; i++)
    for (PetscInt j = 0; j < ctx->n; j++) PetscCall(MatSetValue(H, i, j, sum.h[i][j], INSERT_VALUES));
  PetscCall(MatAssemblyBegin(H, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(H, MAT_FINAL_ASSEMBLY));
  PetscFunctionReturn(0);
}

/* Full pattern, rows laid out as r, columns as c */
static PetscErrorCode DenseAIJ(Vec r, Vec c, Mat *A)
{
  PetscInt m, n, M, N;

  PetscFunctionBeginUser;
  PetscCall(VecGetLocalSize(r, &m));
  PetscCall(VecGetLocalSize(c, &n));
  PetscCall(VecGetSize(r, &M));
  PetscCall(VecGetSize(c, &N));
  PetscCall(MatCreateAIJ(PETSC_COMM_WORLD, m, n, M, N, n, NULL, N - n, NULL, A));
  PetscFunctionReturn(0);
}

/* Largest violation of constraints and bounds, evaluated here */
static PetscErrorCode Violation(Context *ctx, Vec x, Vec xl, Vec xu, PetscReal *violation)
{
  PetscReal a[EXPRESSION_MAX], l[EXPRESSION_MAX], u[EXPRESSION_MAX];

  PetscFunctionBeginUser;
  *violation = 0.0;
  PetscCall(Gather(xl, l));
  PetscCall(Gather(xu, u));
  PetscCall(Gather(x, a));
  for (PetscInt i = 0; i < ctx->n; i++) *violation = PetscMax(*violation, PetscMax(l[i] - a[i], a[i] - u[i]));
  for (PetscInt i = 0; i < ctx->ce.m; i++) *violation = PetscMax(*violation, PetscAbsReal(ExpressionEvaluate(ctx->ce.formula[i], a, NULL).v));
  for (PetscInt i = 0; i < ctx->ci.m; i++) *violation = PetscMax(*violation, -ExpressionEvaluate(ctx->ci.formula[i], a, NULL).v);
  PetscFunctionReturn(0);
}

/* Distance of f from an optimum, relative but for the smallest */
static PetscReal RelativeError(PetscReal f, PetscReal optimum)
{
  const PetscReal size = PetscAbsReal(optimum);

  return PetscAbsReal(f - optimum) / PetscMax(size, size > 0.0 ? PetscMin(1.0, 1e3 * size) : 1.0);
}

/* The least distance of f from the known minima */
static PetscReal ObjectiveError(const NLP *p, PetscReal f)
{
  PetscReal   error = RelativeError(f, p->optimum);
  const char *s     = p->others ? p->others : "";
  char       *end;

  for (PetscReal other = strtod(s, &end); end != s; s = end, other = strtod(s, &end)) error = PetscMin(error, RelativeError(f, other));
  return error;
}

/* Without multipliers: no optimum, or one that is called acceptable; "converged" only where it is one */
static PetscBool DegenerateIsGood(TaoConvergedReason reason, const char *sentence, PetscReal error, PetscReal violation)
{
  if (reason < 0) return (PetscBool)!strstr(sentence, "infeasible");
  return (PetscBool)(violation < 1e-6 && error < (reason == TAO_CONVERGED_STEPTOL ? 1e-3 : 1e-6));
}

/* What is to be seen: the known optimum at a feasible point; or that there is none */
static PetscErrorCode Report(Tao tao, Context *ctx, Vec x, Vec xl, Vec xu, PetscBool table)
{
  static const char *const verdicts[] = {"solved", "nothing wrong", "said to be infeasible", "said to be unbounded"};
  const NLP         *p = ctx->p;
  PetscReal          f, error, violation;
  PetscInt           its, nfuncs;
  PetscBool          good;
  TaoConvergedReason reason;
  const char        *sentence;

  PetscFunctionBeginUser;
  PetscCall(TaoGetSolutionStatus(tao, &its, &f, NULL, NULL, NULL, &reason));
  PetscCall(TaoGetCurrentFunctionEvaluations(tao, &nfuncs));
  PetscCall(TaoIPFilterGetReason(tao, &sentence));
  PetscCall(Violation(ctx, x, xl, xu, &violation));
  error = ObjectiveError(p, f);
  if (p->end == NLP_SOLVED) good = (PetscBool)(reason > 0 && error < 1e-6 && violation < 1e-6);
  else if (p->end == NLP_DEGENERATE) good = DegenerateIsGood(reason, sentence, error, violation);
  else if (p->end == NLP_INFEASIBLE) good = (PetscBool)(reason < 0 && strstr(sentence, "infeasible"));
  else good = (PetscBool)(reason < 0 && strstr(sentence, "unbounded"));
  if (table) PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%-12s %s %-24s f %16.9e error %8.1e violation %8.1e steps %4" PetscInt_FMT " evaluations %4" PetscInt_FMT "  %s\n", p->name, good ? "good" : "BAD ", TaoConvergedReasons[reason], (double)f, (double)error, (double)violation, its, nfuncs, sentence));
  else if (good) PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%s: %s\n", p->name, verdicts[p->end]));
  else PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%s: NOT AS EXPECTED: %s, objective %.9e, error %g, violation %g; %s\n", p->name, TaoConvergedReasons[reason], (double)f, (double)error, (double)violation, sentence));
  PetscFunctionReturn(0);
}

static PetscErrorCode Solve(const NLP *p, PetscBool second, PetscBool table)
{
  Context ctx = {.p = p};
  Vec     x, xl, xu, ci, ce;
  Mat     H, Ji, Je;
  Tao     tao;

  PetscFunctionBeginUser;
  for (const char *s = p->start; *s; s++) ctx.n += !isspace((unsigned char)s[0]) && (isspace((unsigned char)s[1]) || !s[1]);
  Split(p->inequalities, ctx.n, &ctx.ci);
  Split(p->equalities, ctx.n, &ctx.ce);
  PetscCall(VecFromText(ctx.n, p->start, -1, &x));
  PetscCall(VecFromText(ctx.n, p->bounds, 0, &xl));
  PetscCall(VecFromText(ctx.n, p->bounds, 1, &xu));
  PetscCall(VecCreateMPI(PETSC_COMM_WORLD, PETSC_DECIDE, ctx.ci.m, &ci));
  PetscCall(VecCreateMPI(PETSC_COMM_WORLD, PETSC_DECIDE, ctx.ce.m, &ce));
  PetscCall(DenseAIJ(x, x, &H));
  PetscCall(DenseAIJ(ci, x, &Ji));
  PetscCall(DenseAIJ(ce, x, &Je));
  PetscCall(TaoCreate(PETSC_COMM_WORLD, &tao));
  PetscCall(TaoSetType(tao, TAOIPFILTER));
  PetscCall(TaoSetSolution(tao, x));
  PetscCall(TaoSetVariableBounds(tao, xl, xu));
  PetscCall(TaoSetObjectiveAndGradient(tao, NULL, ObjectiveAndGradient, &ctx));
  if (second) PetscCall(TaoSetHessian(tao, H, H, Hessian, &ctx));
  if (ctx.ci.m) {
    PetscCall(TaoSetInequalityConstraintsRoutine(tao, ci, EvaluateConstraints, &ctx.ci));
    PetscCall(TaoSetJacobianInequalityRoutine(tao, Ji, Ji, EvaluateJacobian, &ctx.ci));
  }
  if (ctx.ce.m) {
    PetscCall(TaoSetEqualityConstraintsRoutine(tao, ce, EvaluateConstraints, &ctx.ce));
    PetscCall(TaoSetJacobianEqualityRoutine(tao, Je, Je, EvaluateJacobian, &ctx.ce));
  }
  PetscCall(TaoSetFromOptions(tao));
  PetscCall(TaoSolve(tao));
  PetscCall(Report(tao, &ctx, x, xl, xu, table));
  PetscCall(TaoDestroy(&tao));
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
  PetscBool second = PETSC_TRUE, table = PETSC_FALSE, only = PETSC_FALSE;
  char     *names[8];
  PetscInt  nonly = (PetscInt)PETSC_STATIC_ARRAY_LENGTH(names), nskip = nonly;

  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, help));
  PetscCall(PetscAMGFInitializePackage());
  PetscCall(PetscOptionsGetBool(NULL, NULL, "-hessian", &second, NULL));
  PetscCall(PetscOptionsGetBool(NULL, NULL, "-table", &table, NULL));
  PetscCall(PetscOptionsGetStringArray(NULL, NULL, "-problems", names, &nonly, &only));
  if (!only) PetscCall(PetscOptionsGetStringArray(NULL, NULL, "-skip", names, &nskip, NULL));
  for (size_t k = 0; k < PETSC_STATIC_ARRAY_LENGTH(problems); k++) {
    PetscBool named = PETSC_FALSE;

    for (PetscInt i = 0; i < (only ? nonly : nskip) && !named; i++) PetscCall(PetscStrcmp(names[i], problems[k].name, &named));
    if (named == only) PetscCall(Solve(&problems[k], second, table));
  }
  for (PetscInt i = 0; i < (only ? nonly : nskip); i++) PetscCall(PetscFree(names[i]));
  PetscCall(PetscFinalize());
  return 0;
}

/*TEST

   testset:
      args: -tao_max_it 200

      test:
         suffix: 1
         nsize: {{1 2}}

      # a factorization meets no negative curvature: from its start on the diagonal bilinear2 ends in the saddle, which is stationary
      test:
         suffix: direct
         args: -tao_ipfilter_ksp_type preonly -tao_ipfilter_pc_type lu -tao_ipfilter_pc_factor_mat_solver_type mumps -skip bilinear2

      # HS104: the monotone mode runs into a corner from which restoration leads to a local minimum of the violation, and says so
      test:
         suffix: monotone
         args: -tao_ipfilter_barrier monotone -skip HS104

      test:
         suffix: differences
         args: -hessian 0

TEST*/
