/*
   IPOPT beside TAOIPFILTER: the problems of tests/ipfilter_nlp.h, from the same formulas and starts, with IPOPT's defaults.
   One line a problem: name, IPOPT's status, objective, violation, iterations, evaluations of f and of its gradient.
   A program of its own, without PETSc's library: IPOPT brings another MUMPS, and another MPI, than PETSc.
*/
#include "../ipfilter_expression.h"
#include "../ipfilter_nlp.h"
#include <IpStdCInterface.h>

#define MAXM 32

typedef struct {
  const NLP  *p;
  int         n, mi, m;
  const char *c[MAXM]; /* inequalities, then equalities */
  int         iterations, evaluations;
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

static Bool Objective(Index n, Number *x, Bool fresh, Number *f, UserDataPtr user)
{
  Context *ctx = user;

  (void)n;
  (void)fresh;
  ctx->evaluations++;
  *f = ExpressionEvaluate(ctx->p->objective, x, NULL).v;
  return isfinite(*f) ? TRUE : FALSE;
}

static Bool Gradient(Index n, Number *x, Bool fresh, Number *g, UserDataPtr user)
{
  Context *ctx = user;
  Jet      jet = ExpressionEvaluate(ctx->p->objective, x, NULL);

  (void)fresh;
  ctx->evaluations++;
  memcpy(g, jet.g, (size_t)n * sizeof(*g));
  return TRUE;
}

static Bool Constraints(Index n, Number *x, Bool fresh, Index m, Number *c, UserDataPtr user)
{
  Context *ctx = user;

  (void)n;
  (void)fresh;
  for (int i = 0; i < m; i++) {
    c[i] = ExpressionEvaluate(ctx->c[i], x, NULL).v;
    if (!isfinite(c[i])) return FALSE;
  }
  return TRUE;
}

static Bool Jacobian(Index n, Number *x, Bool fresh, Index m, Index nonzeros, Index *row, Index *column, Number *v, UserDataPtr user)
{
  Context *ctx = user;

  (void)fresh;
  (void)nonzeros;
  for (int i = 0; i < m; i++) {
    Jet jet;

    if (v) jet = ExpressionEvaluate(ctx->c[i], x, NULL);
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
static Bool Hessian(Index n, Number *x, Bool fresh, Number factor, Index m, Number *lambda, Bool fresh_lambda, Index nonzeros, Index *row, Index *column, Number *v, UserDataPtr user)
{
  Context *ctx = user;
  Jet      sum = JetConstant(0.0);

  (void)fresh;
  (void)fresh_lambda;
  (void)nonzeros;
  if (v) {
    Jet f = ExpressionEvaluate(ctx->p->objective, x, NULL);

    sum = JetAdd(&sum, factor, &f);
    for (int i = 0; i < m; i++) {
      Jet c = ExpressionEvaluate(ctx->c[i], x, NULL);

      sum = JetAdd(&sum, lambda[i], &c);
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

static Bool Count(Index mode, Index iteration, Number f, Number inf_pr, Number inf_du, Number mu, Number d_norm, Number regularization, Number alpha_du, Number alpha_pr, Index trials, UserDataPtr user)
{
  (void)mode;
  (void)f;
  (void)inf_pr;
  (void)inf_du;
  (void)mu;
  (void)d_norm;
  (void)regularization;
  (void)alpha_du;
  (void)alpha_pr;
  (void)trials;
  ((Context *)user)->iterations = iteration;
  return TRUE;
}

static const char *Name(enum ApplicationReturnStatus status)
{
  switch (status) {
  case Solve_Succeeded:
    return "solved";
  case Solved_To_Acceptable_Level:
    return "acceptable";
  case Infeasible_Problem_Detected:
    return "infeasible";
  case Diverging_Iterates:
    return "diverging";
  case Feasible_Point_Found:
    return "feasible point";
  case Search_Direction_Becomes_Too_Small:
    return "step too small";
  case Maximum_Iterations_Exceeded:
    return "iteration limit";
  case Restoration_Failed:
    return "restoration failed";
  case Error_In_Step_Computation:
    return "no step computed";
  case Not_Enough_Degrees_Of_Freedom:
    return "too few unknowns";
  case Invalid_Number_Detected:
    return "not a number";
  default:
    return "other failure";
  }
}

static double Violation(const Context *ctx, const double x[], const double lower[], const double upper[])
{
  double violation = 0.0;

  for (int i = 0; i < ctx->n; i++) violation = fmax(violation, fmax(lower[i] - x[i], x[i] - upper[i]));
  for (int i = 0; i < ctx->m; i++) {
    const double c = ExpressionEvaluate(ctx->c[i], x, NULL).v;

    violation = fmax(violation, i < ctx->mi ? -c : fabs(c));
  }
  return violation;
}

static int Solve(const NLP *p, int limit)
{
  Context                      ctx = {.p = p};
  double                       x[EXPRESSION_MAX], lower[EXPRESSION_MAX], upper[EXPRESSION_MAX], least[MAXM], most[MAXM], f = 0.0;
  IpoptProblem                 problem;
  enum ApplicationReturnStatus status;

  Split(p->inequalities, ctx.c, &ctx.m);
  ctx.mi = ctx.m;
  Split(p->equalities, ctx.c, &ctx.m);
  for (const char *s = p->start; *s; s++) ctx.n += !isspace((unsigned char)s[0]) && (isspace((unsigned char)s[1]) || !s[1]);
  Read(p->start, ctx.n, x, NULL);
  Read(p->bounds, ctx.n, lower, upper);
  for (int i = 0; i < ctx.m; i++) {
    least[i] = 0.0;
    most[i]  = i < ctx.mi ? 2e19 : 0.0;
  }
  problem = CreateIpoptProblem(ctx.n, lower, upper, ctx.m, least, most, ctx.m * ctx.n, ctx.n * (ctx.n + 1) / 2, 0, Objective, Constraints, Gradient, Jacobian, Hessian);
  if (!problem) return 1;
  AddIpoptIntOption(problem, "print_level", 0);
  AddIpoptStrOption(problem, "sb", "yes");
  AddIpoptIntOption(problem, "max_iter", limit);
  SetIntermediateCallback(problem, Count);
  status = IpoptSolve(problem, x, NULL, &f, NULL, NULL, NULL, &ctx);
  FreeIpoptProblem(problem);
  f = ExpressionEvaluate(p->objective, x, NULL).v;
  printf("%s|%s|%.12e|%.1e|%d|%d\n", p->name, Name(status), f, Violation(&ctx, x, lower, upper), ctx.iterations, ctx.evaluations);
  return 0;
}

int main(int argc, char **argv)
{
  const int limit  = argc > 1 ? atoi(argv[1]) : 500;
  int       failed = 0;

  for (size_t k = 0; k < sizeof(problems) / sizeof(problems[0]); k++) failed |= Solve(&problems[k], limit);
  return failed;
}
