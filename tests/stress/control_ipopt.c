/*
   IPOPT beside TAOIPFILTER on distributed control: the problem of tests/tao_ipfilter/ipfilter_control.c. IPOPT has
   its defaults.
   Arguments: points in each direction, alpha, and if need be the bound of the state. A program of its own, as
   nlp_ipopt.c.
*/
#include "ipopt_run.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

typedef struct {
  RunRecord record;
  int       n;
  double    h, alpha;
} Grid;

static const double source = 3.0;

static double Wanted(const Grid *g, int i, int j)
{
  return sin(M_PI * (i + 1) * g->h) * sin(M_PI * (j + 1) * g->h);
}

static Bool Objective(Index n, Number *x, Bool fresh, Number *f, UserDataPtr user)
{
  const Grid *g = user;

  (void)n;
  (void)fresh;
  *f = 0.0;
  for (int j = 0; j < g->n; j++) {
    for (int i = 0; i < g->n; i++) {
      const double y = x[2 * (j * g->n + i)], u = x[2 * (j * g->n + i) + 1];

      *f += g->h * g->h * (0.5 * y * y - y * Wanted(g, i, j) + 0.5 * g->alpha * u * u);
    }
  }
  return TRUE;
}

static Bool Gradient(Index n, Number *x, Bool fresh, Number *gradient, UserDataPtr user)
{
  const Grid *g = user;

  (void)n;
  (void)fresh;
  for (int j = 0; j < g->n; j++) {
    for (int i = 0; i < g->n; i++) {
      const int k = 2 * (j * g->n + i);

      gradient[k]     = g->h * g->h * (x[k] - Wanted(g, i, j));
      gradient[k + 1] = g->h * g->h * g->alpha * x[k + 1];
    }
  }
  return TRUE;
}

static int Inside(const Grid *g, int i, int j)
{
  return i >= 0 && j >= 0 && i < g->n && j < g->n;
}

/* Row k of the equation: columns and coefficients, the state's own, the control's, the neighbours' */
static int Row(const Grid *g, int k, int column[], double v[])
{
  const int di[4] = {-1, 1, 0, 0}, dj[4] = {0, 0, -1, 1}, i = k % g->n, j = k / g->n;
  int       count = 2;

  column[0] = 2 * k;
  v[0]      = 4.0;
  column[1] = 2 * k + 1;
  v[1]      = -g->h * g->h;
  for (int d = 0; d < 4; d++) {
    if (!Inside(g, i + di[d], j + dj[d])) continue;
    column[count] = 2 * (k + di[d] + dj[d] * g->n);
    v[count++]    = -1.0;
  }
  return count;
}

static Bool Constraints(Index n, Number *x, Bool fresh, Index m, Number *c, UserDataPtr user)
{
  const Grid *g = user;

  (void)n;
  (void)fresh;
  for (int k = 0; k < m; k++) {
    int       column[6];
    double    v[6];
    const int count = Row(g, k, column, v);

    c[k] = -g->h * g->h * source;
    for (int l = 0; l < count; l++) c[k] += v[l] * x[column[l]];
  }
  return TRUE;
}

static Bool Jacobian(Index n, Number *x, Bool fresh, Index m, Index nonzeros, Index *row, Index *column, Number *value,
  UserDataPtr user)
{
  int at = 0;

  (void)n;
  (void)x;
  (void)fresh;
  (void)nonzeros;
  for (int k = 0; k < m; k++) {
    int       c[6];
    double    v[6];
    const int count = Row(user, k, c, v);

    for (int l = 0; l < count; l++, at++) {
      if (value) value[at] = v[l];
      else {
        row[at]    = k;
        column[at] = c[l];
      }
    }
  }
  return TRUE;
}

static Bool Hessian(Index n, Number *x, Bool fresh, Number factor, Index m, Number *lambda, Bool fresh_lambda,
  Index nonzeros, Index *row, Index *column, Number *value, UserDataPtr user)
{
  const Grid *g = user;

  (void)x;
  (void)fresh;
  (void)m;
  (void)lambda;
  (void)fresh_lambda;
  (void)nonzeros;
  for (int k = 0; k < n; k++) {
    if (value) value[k] = factor * g->h * g->h * (k % 2 ? g->alpha : 1.0);
    else row[k] = column[k] = k;
  }
  return TRUE;
}

int main(int argc, char **argv)
{
  Grid         g         = {.n = argc > 1 ? atoi(argv[1]) : 32, .alpha = argc > 2 ? atof(argv[2]) : 1e-4};
  const double state_max = argc > 3 ? atof(argv[3]) : 2e19;
  const int    points = g.n * g.n, nonzeros = 2 * points + 4 * g.n * (g.n - 1);
  double      *x = calloc(2 * points, sizeof(*x)), *lower = calloc(2 * points, sizeof(*x)),
         *upper = calloc(2 * points, sizeof(*x)), *zero = calloc(points, sizeof(*x)), f, begin;
  IpoptProblem                 problem;
  enum ApplicationReturnStatus status;

  g.h = 1.0 / (g.n + 1);
  for (int k = 0; k < 2 * points; k++) {
    lower[k] = -2e19;
    upper[k] = k % 2 ? 2e19 : state_max;
  }
  begin   = RunSeconds(CLOCK_PROCESS_CPUTIME_ID);
  problem = CreateIpoptProblem(2 * points, lower, upper, points, zero, zero, nonzeros, 2 * points, 0, Objective,
    Constraints, Gradient, Jacobian, Hessian);
  RunPrepare(problem);
  AddIpoptIntOption(problem, "print_level", argc > 4 ? atoi(argv[4]) : 0);
  status = IpoptSolve(problem, x, NULL, &f, NULL, NULL, NULL, &g);
  printf("%d x %d: objective %.10e, %d steps, %.2f s of CPU; IPOPT's status %d\n", g.n, g.n, f, g.record.iterations,
    RunSeconds(CLOCK_PROCESS_CPUTIME_ID) - begin, (int)status);
  FreeIpoptProblem(problem);
  free(x), free(lower), free(upper), free(zero);
  return status == Solve_Succeeded ? 0 : 1;
}
