static char help[] = "Small problems whose solutions are known: Hock and Schittkowski's, degenerate, infeasible, unbounded, badly scaled ones.\n\
  -mode NAME        solver options by their name below, for which steps and evaluations are held\n\
  -problems A,B     some problems only\n\
  -table            a line a problem with all figures, nothing held: for tests/stress/nlp.py\n\
  -print_counts     the rows of tests/ipfilter_nlp_counts.inc anew; `make -f tests/makefile nlp-counts` puts them in place\n\n";

#include "ipfilter_problem.h"
#include "ipfilter_expression.h"
#include "ipfilter_nlp.h"

#define MAXM   16 /* constraints of one kind */
#define NMODES 5

static const struct {
  const char *name, *options, *skip; /* skip: the problem that is not solved; why stands above it */
} modes[NMODES] = {
  {"default", "-tao_max_it 200", ""},
  /* a factorization meets no negative curvature: from its start on the diagonal bilinear2 ends in the saddle, which is stationary */
  {"direct", "-tao_max_it 200 -tao_ipfilter_ksp_type preonly -tao_ipfilter_pc_type lu -tao_ipfilter_pc_factor_mat_solver_type mumps", "bilinear2"},
  /* it runs into a corner from which restoration leads to a local minimum of the violation, and says so */
  {"monotone", "-tao_max_it 200 -tao_ipfilter_barrier monotone", "HS104"},
  {"differences", "-tao_max_it 200 -hessian 0", ""},
  /* dense matrices, whose conversions drop zeros: the same path as in the first mode */
  {"dense", "-tao_max_it 200 -dense_hessian -dense_jacobians", ""},
};

typedef struct {
  PetscInt steps, evaluations;
} Counts;

/* What each problem takes in each mode: the most of one to three ranks */
static const struct {
  const char *name;
  Counts      mode[NMODES];
} expected[] = {
#include "ipfilter_nlp_counts.inc"
};

/* Rounding decides which way this one goes, and one way is twice as long as another: its counts are not held */
static const char erratic[] = "HS108";

/* What another one may take: rounding differs from machine to machine */
static PetscInt Limit(PetscInt count)
{
  return count + count / 4 + 3;
}

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

/* What came of it */
typedef struct {
  PetscBool          good; /* as the problem says it ends */
  TaoConvergedReason reason;
  const char        *sentence;
  PetscReal          f, error, violation;
  Counts             counts;
} Outcome;

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
static PetscErrorCode VecFromText(MPI_Comm comm, PetscInt n, const char *text, PetscInt k, Vec *v)
{
  PetscInt lo, hi;

  PetscFunctionBeginUser;
  PetscCall(VecCreateMPI(comm, PETSC_DECIDE, n, v));
  PetscCall(VecGetOwnershipRange(*v, &lo, &hi));
  for (PetscInt i = 0; i < n; i++) {
    const char *entry, *end;
    char       *stop;
    PetscReal   value;

    while (isspace((unsigned char)*text)) text++;
    entry = text;
    text = end = entry + strcspn(entry, " ");
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

/* Full pattern, rows laid out as r, columns as c: AIJ, or dense where an option says so */
static PetscErrorCode CreateFull(Vec r, Vec c, const char option[], Mat *A)
{
  PetscInt  m, n, M, N;
  PetscBool dense = PETSC_FALSE;

  PetscFunctionBeginUser;
  PetscCall(PetscOptionsGetBool(NULL, NULL, option, &dense, NULL));
  PetscCall(VecGetLocalSize(r, &m));
  PetscCall(VecGetLocalSize(c, &n));
  PetscCall(VecGetSize(r, &M));
  PetscCall(VecGetSize(c, &N));
  if (dense) PetscCall(MatCreateDense(PetscObjectComm((PetscObject)r), m, n, M, N, NULL, A));
  else PetscCall(MatCreateAIJ(PetscObjectComm((PetscObject)r), m, n, M, N, n, NULL, N - n, NULL, A));
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

/* The known optimum at a feasible point; or it is said that there is none */
static PetscErrorCode Judge(Tao tao, Context *ctx, Vec x, Vec xl, Vec xu, Outcome *o)
{
  const NLP *p = ctx->p;

  PetscFunctionBeginUser;
  PetscCall(TaoGetSolutionStatus(tao, &o->counts.steps, &o->f, NULL, NULL, NULL, &o->reason));
  PetscCall(TaoGetCurrentFunctionEvaluations(tao, &o->counts.evaluations));
  PetscCall(TaoIPFilterGetReason(tao, &o->sentence));
  PetscCall(Violation(ctx, x, xl, xu, &o->violation));
  o->error = ObjectiveError(p, o->f);
  if (p->end == NLP_SOLVED) o->good = (PetscBool)(o->reason > 0 && o->error < 1e-6 && o->violation < 1e-6);
  else if (p->end == NLP_DEGENERATE) o->good = DegenerateIsGood(o->reason, o->sentence, o->error, o->violation);
  else if (p->end == NLP_INFEASIBLE) o->good = (PetscBool)(o->reason < 0 && strstr(o->sentence, "infeasible"));
  else o->good = (PetscBool)(o->reason < 0 && strstr(o->sentence, "unbounded"));
  PetscFunctionReturn(0);
}

/* The most that a problem may take in a mode, or anything where mode is negative */
static PetscErrorCode GetLimits(const NLP *p, PetscInt mode, Counts *most)
{
  PetscBool same;

  PetscFunctionBeginUser;
  *most = (Counts){PETSC_MAX_INT, PETSC_MAX_INT};
  PetscCall(PetscStrcmp(p->name, erratic, &same));
  if (mode < 0 || same) PetscFunctionReturn(0);
  for (size_t k = 0; k < PETSC_STATIC_ARRAY_LENGTH(expected) && !same; k++) {
    *most = (Counts){Limit(expected[k].mode[mode].steps), Limit(expected[k].mode[mode].evaluations)};
    PetscCall(PetscStrcmp(expected[k].name, p->name, &same));
  }
  PetscCheck(same, PETSC_COMM_WORLD, PETSC_ERR_PLIB, "%s has no counts: make -f tests/makefile nlp-counts", p->name);
  PetscFunctionReturn(0);
}

/* mode: whose counts are held, or negative */
static PetscErrorCode ReportVerdict(const NLP *p, PetscInt mode, const Outcome *o)
{
  static const char *const verdicts[] = {"solved", "nothing wrong", "said to be infeasible", "said to be unbounded"};
  Counts                   most;

  PetscFunctionBeginUser;
  PetscCall(GetLimits(p, mode, &most));
  if (!o->good) PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%s: NOT AS EXPECTED: %s, objective %.9e, error %g, violation %g; %s\n", p->name, TaoConvergedReasons[o->reason], (double)o->f, (double)o->error, (double)o->violation, o->sentence));
  else if (o->counts.steps > most.steps || o->counts.evaluations > most.evaluations)
    PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%s: %s, IN MORE THAN %" PetscInt_FMT " steps or %" PetscInt_FMT " evaluations: %" PetscInt_FMT " and %" PetscInt_FMT "\n", p->name, verdicts[p->end], most.steps, most.evaluations, o->counts.steps, o->counts.evaluations));
  else PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%s: %s\n", p->name, verdicts[p->end]));
  PetscFunctionReturn(0);
}

static PetscErrorCode ReportRow(const NLP *p, const Outcome *o)
{
  PetscFunctionBeginUser;
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%-12s %s %-24s f %16.9e error %8.1e violation %8.1e steps %4" PetscInt_FMT " evaluations %4" PetscInt_FMT "  %s\n", p->name, o->good ? "good" : "BAD ", TaoConvergedReasons[o->reason], (double)o->f, (double)o->error, (double)o->violation, o->counts.steps, o->counts.evaluations, o->sentence));
  PetscFunctionReturn(0);
}

static PetscErrorCode SetProblem(Tao tao, Context *ctx, Vec ci, Vec ce, Mat H, Mat Ji, Mat Je)
{
  PetscBool second = PETSC_TRUE;

  PetscFunctionBeginUser;
  PetscCall(PetscOptionsGetBool(NULL, NULL, "-hessian", &second, NULL));
  PetscCall(TaoSetObjectiveAndGradient(tao, NULL, ObjectiveAndGradient, ctx));
  if (second) PetscCall(TaoSetHessian(tao, H, H, Hessian, ctx));
  if (ctx->ci.m) {
    PetscCall(TaoSetInequalityConstraintsRoutine(tao, ci, EvaluateConstraints, &ctx->ci));
    PetscCall(TaoSetJacobianInequalityRoutine(tao, Ji, Ji, EvaluateJacobian, &ctx->ci));
  }
  if (ctx->ce.m) {
    PetscCall(TaoSetEqualityConstraintsRoutine(tao, ce, EvaluateConstraints, &ctx->ce));
    PetscCall(TaoSetJacobianEqualityRoutine(tao, Je, Je, EvaluateJacobian, &ctx->ce));
  }
  PetscFunctionReturn(0);
}

/* tao: the solver after it, which has the sentence */
static PetscErrorCode Solve(MPI_Comm comm, const NLP *p, Outcome *outcome, Tao *tao)
{
  Context ctx = {.p = p};
  Vec     x, xl, xu, ci, ce;
  Mat     H, Ji, Je;

  PetscFunctionBeginUser;
  for (const char *s = p->start; *s; s++) ctx.n += !isspace((unsigned char)s[0]) && (isspace((unsigned char)s[1]) || !s[1]);
  Split(p->inequalities, ctx.n, &ctx.ci);
  Split(p->equalities, ctx.n, &ctx.ce);
  PetscCall(VecFromText(comm, ctx.n, p->start, -1, &x));
  PetscCall(VecFromText(comm, ctx.n, p->bounds, 0, &xl));
  PetscCall(VecFromText(comm, ctx.n, p->bounds, 1, &xu));
  PetscCall(VecCreateMPI(comm, PETSC_DECIDE, ctx.ci.m, &ci));
  PetscCall(VecCreateMPI(comm, PETSC_DECIDE, ctx.ce.m, &ce));
  PetscCall(CreateFull(x, x, "-dense_hessian", &H));
  PetscCall(CreateFull(ci, x, "-dense_jacobians", &Ji));
  PetscCall(CreateFull(ce, x, "-dense_jacobians", &Je));
  PetscCall(TaoCreate(comm, tao));
  PetscCall(TaoSetType(*tao, TAOIPFILTER));
  PetscCall(TaoSetSolution(*tao, x));
  PetscCall(TaoSetVariableBounds(*tao, xl, xu));
  PetscCall(SetProblem(*tao, &ctx, ci, ce, H, Ji, Je));
  PetscCall(TaoSetFromOptions(*tao));
  PetscCall(TaoSolve(*tao));
  PetscCall(Judge(*tao, &ctx, x, xl, xu, outcome));
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

static PetscErrorCode PushMode(PetscInt mode, PetscOptions *options)
{
  PetscFunctionBeginUser;
  PetscCall(PetscOptionsCreate(options));
  PetscCall(PetscOptionsInsertString(*options, modes[mode].options));
  PetscCall(PetscOptionsPush(*options));
  PetscFunctionReturn(0);
}

static PetscErrorCode PopMode(PetscOptions *options)
{
  PetscFunctionBeginUser;
  PetscCall(PetscOptionsPop());
  PetscCall(PetscOptionsDestroy(options));
  PetscFunctionReturn(0);
}

/* The most that a problem takes in a mode on the first rank, on the first two, and so on: with each, sums are rounded in another way */
static PetscErrorCode Measure(const NLP *p, PetscInt mode, Counts *most)
{
  PetscMPIInt  size, rank;
  PetscOptions options;

  PetscFunctionBeginUser;
  *most = (Counts){0, 0};
  PetscCallMPI(MPI_Comm_size(PETSC_COMM_WORLD, &size));
  PetscCallMPI(MPI_Comm_rank(PETSC_COMM_WORLD, &rank));
  PetscCall(PushMode(mode, &options));
  for (PetscMPIInt n = 1; n <= size; n++) {
    MPI_Comm comm;
    Outcome  outcome;
    Tao      tao;

    PetscCallMPI(MPI_Comm_split(PETSC_COMM_WORLD, rank < n ? 0 : MPI_UNDEFINED, rank, &comm));
    if (comm == MPI_COMM_NULL) continue;
    PetscCall(Solve(comm, p, &outcome, &tao));
    PetscCall(TaoDestroy(&tao));
    PetscCallMPI(MPI_Comm_free(&comm));
    most->steps       = PetscMax(most->steps, outcome.counts.steps);
    most->evaluations = PetscMax(most->evaluations, outcome.counts.evaluations);
  }
  PetscCall(PopMode(&options));
  PetscFunctionReturn(0);
}

static PetscErrorCode PrintCounts(void)
{
  PetscFunctionBeginUser;
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "/* {steps, evaluations}; `make -f tests/makefile nlp-counts` makes this file anew.\n  "));
  for (PetscInt mode = 0; mode < NMODES; mode++) PetscCall(PetscPrintf(PETSC_COMM_WORLD, " %s%s", modes[mode].name, mode + 1 < NMODES ? "," : " */\n"));
  for (size_t k = 0; k < PETSC_STATIC_ARRAY_LENGTH(problems); k++) {
    PetscCall(PetscPrintf(PETSC_COMM_WORLD, "  {\"%s\", {", problems[k].name));
    for (PetscInt mode = 0; mode < NMODES; mode++) {
      Counts most;

      PetscCall(Measure(&problems[k], mode, &most));
      PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%s{%" PetscInt_FMT ", %" PetscInt_FMT "}", mode ? ", " : "", most.steps, most.evaluations));
    }
    PetscCall(PetscPrintf(PETSC_COMM_WORLD, "}},\n"));
  }
  PetscFunctionReturn(0);
}

/* Whether a problem is to be solved: it is named, or none is and the mode does not skip it */
static PetscErrorCode Wanted(const NLP *p, PetscInt mode, PetscInt nonly, char *const only[], PetscBool *wanted)
{
  PetscFunctionBeginUser;
  *wanted = PETSC_FALSE;
  for (PetscInt i = 0; i < nonly && !*wanted; i++) PetscCall(PetscStrcmp(only[i], p->name, wanted));
  if (!nonly) {
    PetscBool skipped = PETSC_FALSE;

    if (mode >= 0) PetscCall(PetscStrcmp(modes[mode].skip, p->name, &skipped));
    *wanted = skipped ? PETSC_FALSE : PETSC_TRUE;
  }
  PetscFunctionReturn(0);
}

/* mode: negative for the options of the command line */
static PetscErrorCode SolveAll(PetscInt mode, PetscBool table)
{
  char        *only[8];
  PetscInt     nonly = (PetscInt)PETSC_STATIC_ARRAY_LENGTH(only);
  PetscOptions options;

  PetscFunctionBeginUser;
  PetscCall(PetscOptionsGetStringArray(NULL, NULL, "-problems", only, &nonly, NULL));
  if (mode >= 0) PetscCall(PushMode(mode, &options));
  for (size_t k = 0; k < PETSC_STATIC_ARRAY_LENGTH(problems); k++) {
    Outcome   outcome;
    Tao       tao;
    PetscBool wanted;

    PetscCall(Wanted(&problems[k], mode, nonly, only, &wanted));
    if (!wanted) continue;
    PetscCall(Solve(PETSC_COMM_WORLD, &problems[k], &outcome, &tao));
    if (table) PetscCall(ReportRow(&problems[k], &outcome));
    else PetscCall(ReportVerdict(&problems[k], mode, &outcome));
    PetscCall(TaoDestroy(&tao));
  }
  if (mode >= 0) PetscCall(PopMode(&options));
  for (PetscInt i = 0; i < nonly; i++) PetscCall(PetscFree(only[i]));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  const char *names[NMODES];
  PetscInt    mode  = -1;
  PetscBool   table = PETSC_FALSE, print = PETSC_FALSE, given;

  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, help));
  PetscCall(PetscAMGFInitializePackage());
  for (PetscInt i = 0; i < NMODES; i++) names[i] = modes[i].name;
  PetscCall(PetscOptionsGetEList(NULL, NULL, "-mode", names, NMODES, &mode, &given));
  PetscCall(PetscOptionsGetBool(NULL, NULL, "-table", &table, NULL));
  PetscCall(PetscOptionsGetBool(NULL, NULL, "-print_counts", &print, NULL));
  if (print) PetscCall(PrintCounts());
  else PetscCall(SolveAll(given ? mode : -1, table));
  PetscCall(PetscFinalize());
  return 0;
}

/*TEST

   test:
      suffix: 1
      nsize: {{1 2}}
      args: -mode default

   test:
      suffix: direct
      args: -mode direct

   test:
      suffix: monotone
      args: -mode monotone

   test:
      suffix: differences
      args: -mode differences

   # where no direction is found, the restoration starts from the violation of the present iterate, not of the last line search
   test:
      suffix: no_direction
      args: -problems circles,HS31 -tao_ipfilter_delta_max 1e-10

   # c = x y - 1 has one nonzero in its Jacobian at the start, two later
   test:
      suffix: dense_jacobian
      args: -problems hyperbola -dense_jacobians

   test:
      suffix: dense
      nsize: {{1 2}}
      args: -mode dense

TEST*/
