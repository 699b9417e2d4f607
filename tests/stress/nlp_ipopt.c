/*
   IPOPT beside TAOIPFILTER: the problems of a file that nlp.py wrote, from the same formulas and starts, with IPOPT's
   defaults. Arguments: the file, the number of the first problem to solve, and if need be a tolerance. One line a
   problem, as nlp_tao.c. A program of its own, without PETSc's library: IPOPT brings another MUMPS, and another MPI,
   than PETSc.
*/
#include "nlp_read.h"
#include "../tao_ipfilter/ipfilter_expression.h"
#include "ipopt_run.h"

typedef struct {
  RunRecord   record;
  const NLP  *p;
  int         n, mi, m;
  const char *c[FORMULAS_MAX];      /* inequalities, then equalities */
  int         npoints;              /* at which the objective or its gradient was asked for */
  double      last[EXPRESSION_MAX]; /* of them */
} Context;

/* Appends where each formula of a list separated by semicolons begins */
static void Split(const char *list, const char *part[], int *m)
{
  while (*list) {
    part[(*m)++] = list;
    list += strcspn(list, ";");
    if (*list) list++;
  }
}

/* Number k of text, or its bounds "lower:upper" */
static void Read(const char *text, int n, double lower[], double upper[])
{
  for (int i = 0; i < n; i++) {
    const char *colon;
    char       *stop;

    while (isspace((unsigned char)*text)) text++;
    lower[i] = strtod(text, &stop);
    if (!upper) {
      text = stop;
      continue;
    }
    if (!*text || *text == ':') lower[i] = -1e20;
    upper[i] = 1e20;
    colon    = text + strcspn(text, ": ");
    text += strcspn(text, " ");
    if (*colon == ':' && colon + 1 < text) upper[i] = strtod(colon + 1, NULL);
  }
}

static void CountPoint(Context *ctx, const double x[])
{
  const size_t size = (size_t)ctx->n * sizeof(*x);

  if (!ctx->npoints || memcmp(x, ctx->last, size)) ctx->npoints++;
  memcpy(ctx->last, x, size);
}

static Bool Objective(Index n, Number *x, Bool fresh, Number *f, UserDataPtr user)
{
  Context *ctx = user;
  Jet      jet;

  (void)n;
  (void)fresh;
  CountPoint(ctx, x);
  ExpressionEvaluate(ctx->p->objective, x, NULL, &jet);
  *f = jet.v;
  return isfinite(*f) ? TRUE : FALSE;
}

static Bool Gradient(Index n, Number *x, Bool fresh, Number *g, UserDataPtr user)
{
  Context *ctx = user;
  Jet      jet;

  (void)fresh;
  CountPoint(ctx, x);
  ExpressionEvaluate(ctx->p->objective, x, NULL, &jet);
  memcpy(g, jet.g, (size_t)n * sizeof(*g));
  return TRUE;
}

static Bool Constraints(Index n, Number *x, Bool fresh, Index m, Number *c, UserDataPtr user)
{
  Context *ctx = user;

  (void)n;
  (void)fresh;
  for (int i = 0; i < m; i++) {
    Jet jet;

    ExpressionEvaluate(ctx->c[i], x, NULL, &jet);
    c[i] = jet.v;
    if (!isfinite(c[i])) return FALSE;
  }
  return TRUE;
}

static Bool Jacobian(Index n, Number *x, Bool fresh, Index m, Index nonzeros, Index *row, Index *column, Number *v,
  UserDataPtr user)
{
  Context *ctx = user;

  (void)fresh;
  (void)nonzeros;
  for (int i = 0; i < m; i++) {
    Jet jet;

    if (v) ExpressionEvaluate(ctx->c[i], x, NULL, &jet);
    for (int j = 0; j < n; j++) {
      if (v) v[i * n + j] = jet.g[j];
      else {
        row[i * n + j]    = i;
        column[i * n + j] = j;
      }
    }
  }
  return TRUE;
}

/* Lower triangle of the Hessian of factor f + lambda^T c */
static Bool Hessian(Index n, Number *x, Bool fresh, Number factor, Index m, Number *lambda, Bool fresh_lambda,
  Index nonzeros, Index *row, Index *column, Number *v, UserDataPtr user)
{
  Context *ctx = user;
  Jet      sum, jet;

  (void)fresh;
  (void)fresh_lambda;
  (void)nonzeros;
  if (v) {
    JetConstant(0.0, &sum);
    ExpressionEvaluate(ctx->p->objective, x, NULL, &jet);
    JetAdd(&sum, factor, &jet);
    for (int i = 0; i < m; i++) {
      ExpressionEvaluate(ctx->c[i], x, NULL, &jet);
      JetAdd(&sum, lambda[i], &jet);
    }
  }
  for (int i = 0, k = 0; i < n; i++) {
    for (int j = 0; j <= i; j++, k++) {
      if (v) v[k] = sum.h[i][j];
      else {
        row[k]    = i;
        column[k] = j;
      }
    }
  }
  return TRUE;
}

/* How it ended, in the words of nlp.py */
static const char *Ending(enum ApplicationReturnStatus status)
{
  if (status == Solve_Succeeded) return "converged";
  if (status == Solved_To_Acceptable_Level) return "acceptable";
  if (status == Infeasible_Problem_Detected) return "infeasible";
  return status == Diverging_Iterates ? "unbounded" : "failed";
}

static const char *Name(enum ApplicationReturnStatus status)
{
  switch (status) {
  case Solve_Succeeded: return "solved";
  case Solved_To_Acceptable_Level: return "acceptable";
  case Infeasible_Problem_Detected: return "infeasible";
  case Diverging_Iterates: return "diverging";
  case Feasible_Point_Found: return "feasible point";
  case Search_Direction_Becomes_Too_Small: return "step too small";
  case Maximum_Iterations_Exceeded: return "iteration limit";
  case Restoration_Failed: return "restoration failed";
  case Error_In_Step_Computation: return "no step computed";
  case Not_Enough_Degrees_Of_Freedom: return "too few unknowns";
  case Invalid_Number_Detected: return "not a number";
  default: return "other failure";
  }
}

/* Largest violation of bounds and constraints, relative to the bounds and to the rows of the Jacobian where those are
   above 1 */
static double Violation(const Context *ctx, const double x[], const double lower[], const double upper[])
{
  double violation = 0.0;

  for (int i = 0; i < ctx->n; i++) {
    const double bound = lower[i] > x[i] ? lower[i] : upper[i];

    violation = fmax(violation, fmax(lower[i] - x[i], x[i] - upper[i]) / fmax(1.0, fabs(bound)));
  }
  for (int i = 0; i < ctx->m; i++) {
    Jet    jet;
    double size = 1.0;

    ExpressionEvaluate(ctx->c[i], x, NULL, &jet);
    for (int j = 0; j < ctx->n; j++) size = fmax(size, fabs(jet.g[j]));
    violation = isfinite(jet.v) ? fmax(violation, (i < ctx->mi ? -jet.v : fabs(jet.v)) / size) : INFINITY;
  }
  return violation;
}

/* f: at x */
static void Report(Context *ctx, enum ApplicationReturnStatus status, const double x[], const double lower[],
  const double upper[], double seconds)
{
  Jet f;

  ExpressionEvaluate(ctx->p->objective, x, NULL, &f);
  printf("%s|%s|%.12e|%.1e|%d|%d|%.5f|%s\n", ctx->p->name, Ending(status), f.v, Violation(ctx, x, lower, upper),
    ctx->record.iterations, ctx->npoints, seconds, Name(status));
  fflush(stdout);
}

static IpoptProblem CreateProblem(Context *ctx, double lower[], double upper[], double tolerance)
{
  double       least[FORMULAS_MAX], most[FORMULAS_MAX];
  IpoptProblem problem;

  for (int i = 0; i < ctx->m; i++) {
    least[i] = 0.0;
    most[i]  = i < ctx->mi ? 2e19 : 0.0;
  }
  problem = CreateIpoptProblem(ctx->n, lower, upper, ctx->m, least, most, ctx->m * ctx->n, ctx->n * (ctx->n + 1) / 2, 0,
    Objective, Constraints, Gradient, Jacobian, Hessian);
  RunPrepare(problem);
  if (tolerance > 0.0) {
    AddIpoptNumOption(problem, "tol", tolerance);
    AddIpoptNumOption(problem, "bound_relax_factor", 0.0);
  }
  return problem;
}

static void Solve(const NLP *p, double tolerance)
{
  Context                      ctx = {.p = p};
  double                       x[EXPRESSION_MAX], lower[EXPRESSION_MAX], upper[EXPRESSION_MAX], f, begin;
  IpoptProblem                 problem;
  enum ApplicationReturnStatus status;

  Split(p->inequalities, ctx.c, &ctx.m);
  ctx.mi = ctx.m;
  Split(p->equalities, ctx.c, &ctx.m);
  for (const char *s = p->start; *s; s++)
    ctx.n += !isspace((unsigned char)s[0]) && (isspace((unsigned char)s[1]) || !s[1]);
  Read(p->start, ctx.n, x, NULL);
  Read(p->bounds, ctx.n, lower, upper);
  problem = CreateProblem(&ctx, lower, upper, tolerance);
  begin   = RunSeconds(CLOCK_MONOTONIC);
  status  = IpoptSolve(problem, x, NULL, &f, NULL, NULL, NULL, &ctx);
  Report(&ctx, status, x, lower, upper, RunSeconds(CLOCK_MONOTONIC) - begin);
  FreeIpoptProblem(problem);
}

int main(int argc, char **argv)
{
  FILE        *file      = argc > 1 ? fopen(argv[1], "r") : NULL;
  const int    first     = argc > 2 ? atoi(argv[2]) : 0;
  const double tolerance = argc > 3 ? strtod(argv[3], NULL) : 0.0;
  NLP          p;

  if (!file) return 1;
  for (int k = 0; NLPRead(file, &p); k++) {
    if (k >= first) Solve(&p, tolerance);
    NLPFree(&p);
  }
  NLPFree(&p);
  fclose(file);
  return 0;
}
