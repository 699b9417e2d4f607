/*
   IPOPT beside TAOIPFILTER on the problems of ipfilter_grid.h, with IPOPT's defaults, from 0. Arguments: the problem,
   the unknowns in a row. One line, as `ipfilter_grid -report`. A program of its own, without PETSc: IPOPT brings
   another MUMPS, and another MPI, than PETSc.
*/
#include "../tao_ipfilter/ipfilter_grid.h"
#include "ipopt_run.h"
#include <stdio.h>
#include <stdlib.h>

#define STENCIL 4 /* lower triangle of a row: south-east, south, west, diagonal */

typedef struct {
  RunRecord record;
  int       problem, n;
  double   *v;    /* five entries of K per unknown */
  double   *load; /* b */
  double    constant;
} Grid;

static int Column(int k, int i)
{
  const int di[STENCIL] = {1, 0, -1, 0};

  return i + di[k];
}

static int Row(int k, int j)
{
  const int dj[STENCIL] = {-1, -1, 0, 0};

  return j + dj[k];
}

static int Inside(const Grid *grid, int i, int j)
{
  return i >= 0 && i < grid->n && j >= 0 && j < grid->n;
}

static double Value(const Grid *grid, const double *u, int i, int j)
{
  double x, y;

  if (Inside(grid, i, j)) return u[i + grid->n * j];
  GridPoint(grid->problem, grid->n, i, j, &x, &y);
  return GridBoundary(grid->problem, x, y);
}

/* Where the Hessian's lower triangle has the entry of two neighbours */
static int Entry(const Grid *grid, int i, int j, int ii, int jj)
{
  for (int k = 0; k < STENCIL; k++) {
    if (Column(k, i) == ii && Row(k, j) == jj) return STENCIL * (i + grid->n * j) + k;
    if (Column(k, ii) == i && Row(k, jj) == j) return STENCIL * (ii + grid->n * jj) + k;
  }
  return -1;
}

/* Area; its gradient in g and its Hessian in H, which may be NULL */
static double Surface(const Grid *grid, const double *u, double *g, double *H)
{
  const int n    = grid->n;
  double    area = 0.0;

  for (int j = -1; j <= n; j++)
    for (int i = -1; i <= n; i++)
      for (int side = -1; side <= 1; side += 2) {
        const int ii[3] = {i, i + side, i}, jj[3] = {j, j, j + side};
        double    gradient[3], hessian[3][3];

        if (i + side < -1 || i + side > n || j + side < -1 || j + side > n) continue;
        area += GridTriangle(1.0 / (n + 1.0), Value(grid, u, i, j), Value(grid, u, ii[1], j), Value(grid, u, i, jj[2]),
          gradient, hessian);
        for (int r = 0; r < 3; r++) {
          if (!Inside(grid, ii[r], jj[r])) continue;
          if (g) g[ii[r] + n * jj[r]] += gradient[r];
          for (int s = 0; H && s <= r; s++)
            if (Inside(grid, ii[s], jj[s])) H[Entry(grid, ii[r], jj[r], ii[s], jj[s])] += hessian[r][s];
        }
      }
  return area;
}

/* K u */
static double Product(const Grid *grid, const double *u, int i, int j)
{
  const double *v     = &grid->v[5 * (i + grid->n * j)];
  const int     di[5] = {0, -1, 1, 0, 0}, dj[5] = {0, 0, 0, -1, 1};
  double        sum = 0.0;

  for (int k = 0; k < 5; k++)
    if (Inside(grid, i + di[k], j + dj[k])) sum += v[k] * u[i + di[k] + grid->n * (j + dj[k])];
  return sum;
}

static Bool Objective(Index N, Number *u, Bool fresh, Number *f, UserDataPtr user)
{
  const Grid *grid = user;

  (void)N;
  (void)fresh;
  if (grid->problem == GRID_SURFACE) {
    *f = Surface(grid, u, NULL, NULL);
    return TRUE;
  }
  *f = grid->constant;
  for (int j = 0, k = 0; j < grid->n; j++)
    for (int i = 0; i < grid->n; i++, k++) *f += (0.5 * Product(grid, u, i, j) - grid->load[k]) * u[k];
  return TRUE;
}

static Bool Gradient(Index N, Number *u, Bool fresh, Number *g, UserDataPtr user)
{
  const Grid *grid = user;

  (void)fresh;
  memset(g, 0, (size_t)N * sizeof(*g));
  if (grid->problem == GRID_SURFACE) Surface(grid, u, g, NULL);
  else
    for (int j = 0, k = 0; j < grid->n; j++)
      for (int i = 0; i < grid->n; i++, k++) g[k] = Product(grid, u, i, j) - grid->load[k];
  return TRUE;
}

static Bool Constraints(Index N, Number *u, Bool fresh, Index m, Number *c, UserDataPtr user)
{
  (void)N;
  (void)u;
  (void)fresh;
  (void)m;
  (void)c;
  (void)user;
  return TRUE;
}

static Bool Jacobian(Index N, Number *u, Bool fresh, Index m, Index nonzeros, Index *row, Index *column, Number *v,
  UserDataPtr user)
{
  (void)N;
  (void)u;
  (void)fresh;
  (void)m;
  (void)nonzeros;
  (void)row;
  (void)column;
  (void)v;
  (void)user;
  return TRUE;
}

/* An entry outside the grid is a zero on the diagonal */
static Bool Hessian(Index N, Number *u, Bool fresh, Number factor, Index m, Number *lambda, Bool fresh_lambda,
  Index nonzeros, Index *row, Index *column, Number *v, UserDataPtr user)
{
  const Grid *grid        = user;
  const int   of[STENCIL] = {0, 3, 1, 0}; /* in the five entries of K */

  (void)fresh;
  (void)m;
  (void)lambda;
  (void)fresh_lambda;
  if (v) memset(v, 0, (size_t)nonzeros * sizeof(*v));
  if (v && grid->problem == GRID_SURFACE) Surface(grid, u, NULL, v);
  for (int e = 0; e < STENCIL * N; e++) {
    const int node = e / STENCIL, k = e % STENCIL, i = node % grid->n, j = node / grid->n,
              inside = Inside(grid, Column(k, i), Row(k, j));

    if (!v) {
      row[e]    = node;
      column[e] = inside ? Column(k, i) + grid->n * Row(k, j) : node;
    } else if (grid->problem == GRID_SURFACE) v[e] *= factor;
    else if (inside && k) v[e] = factor * grid->v[5 * node + of[k]];
  }
  return TRUE;
}

static void Fill(Grid *grid, double *lower, double *upper)
{
  for (int j = 0, k = 0; j < grid->n; j++)
    for (int i = 0; i < grid->n; i++, k++) {
      GridBounds(grid->problem, grid->n, i, j, &lower[k], &upper[k]);
      if (grid->problem == GRID_SURFACE) continue;
      GridStencil(grid->problem, grid->n, i, j, &grid->v[5 * k], &grid->load[k]);
      GridBoundaryTerms(grid->problem, grid->n, i, j, &grid->v[5 * k], &grid->load[k], &grid->constant);
    }
}

int main(int argc, char **argv)
{
  Grid         grid = {.problem = argc > 2 ? GridFind(argv[1]) : -1, .n = argc > 2 ? atoi(argv[2]) : 0};
  const size_t N    = (size_t)grid.n * (size_t)grid.n;
  double      *u = calloc(N, sizeof(*u)), *lower = calloc(N, sizeof(*u)), *upper = calloc(N, sizeof(*u)), f, none = 0.0,
         violation = 0.0, wall, cpu;
  IpoptProblem                 problem;
  enum ApplicationReturnStatus status;

  if (grid.problem < 0 || grid.n < 1) return 1;
  grid.v    = calloc(5 * N, sizeof(*grid.v));
  grid.load = calloc(N, sizeof(*grid.load));
  Fill(&grid, lower, upper);
  problem = CreateIpoptProblem((Index)N, lower, upper, 0, &none, &none, 0, (Index)(STENCIL * N), 0, Objective,
    Constraints, Gradient, Jacobian, Hessian);
  RunPrepare(problem);
  wall   = RunSeconds(CLOCK_MONOTONIC);
  cpu    = RunSeconds(CLOCK_PROCESS_CPUTIME_ID);
  status = IpoptSolve(problem, u, NULL, &f, NULL, NULL, NULL, &grid);
  wall   = RunSeconds(CLOCK_MONOTONIC) - wall;
  cpu    = RunSeconds(CLOCK_PROCESS_CPUTIME_ID) - cpu;
  for (size_t k = 0; k < N; k++) violation = fmax(violation, fmax(lower[k] - u[k], u[k] - upper[k]));
  printf("%s|%s|%.15e|%.1e|%d|0|%.2f|%.2f\n", grid_names[grid.problem],
    status == Solve_Succeeded ? "CONVERGED" : "DIVERGED", f, violation, grid.record.iterations, wall, cpu);
  FreeIpoptProblem(problem);
  return 0;
}
