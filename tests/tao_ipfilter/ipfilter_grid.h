/*
   Obstacle problems on a grid of n x n unknowns, number i + n j at column i and row j: f = 1/2 u^T K u - b^T u +
   constant, with K of five points.

     obstacle   a membrane on [-2, 2]^2 over a ball, with the boundary values of a solution that is known
     torsion    elastic-plastic torsion of a square rod, |u| <= distance from the boundary
     bearing    pressure in a journal bearing, 0 <= u <= 1000: MINPACK-2's, as PETSc's jbearing2
     signorini  a membrane that is held on three sides, and may touch an obstacle with its fourth alone
*/
#ifndef IPFILTER_GRID_H
#define IPFILTER_GRID_H

#include <math.h>
#include <string.h>

enum { GRID_OBSTACLE, GRID_TORSION, GRID_BEARING, GRID_SIGNORINI, GRID_NPROBLEMS };

#define GRID_NONE 1e300 /* no bound */

static const char *const grid_names[GRID_NPROBLEMS] = {"obstacle", "torsion", "bearing", "signorini"};

/* Number of a problem, or -1 */
static inline int GridFind(const char *name)
{
  for (int k = 0; k < GRID_NPROBLEMS; k++)
    if (!strcmp(grid_names[k], name)) return k;
  return -1;
}

/* A ball of radius 1, extended linearly beyond 0.9 of it */
static inline double GridBall(double r)
{
  const double end = 0.9, height = sqrt(1.0 - end * end);

  return r <= end ? sqrt(1.0 - r * r) : height - end / height * (r - end);
}

/* Values on the boundary of the square, of which x and y are coordinates between 0 and 1 */
static inline double GridBoundary(int problem, double x, double y)
{
  return problem == GRID_OBSTACLE ? 0.471519893402112 - 0.680259411891719 * log(4.0 * hypot(x - 0.5, y - 0.5)) : 0.0;
}

/* Coordinates between 0 and 1 of the node in column i and row j, which may be one of the boundary's */
static inline void GridPoint(int problem, int n, int i, int j, double *x, double *y)
{
  *x = (i + 1.0) / (n + 1.0);
  *y = problem == GRID_SIGNORINI ? (double)j / n : (j + 1.0) / (n + 1.0);
}

static inline double GridFilm(double angle)
{
  return pow(1.0 + 0.1 * cos(angle), 3);
}

/* Row of K at (i, j): the diagonal and the neighbours to the west, east, south and north, be they unknowns or not;
   and the load there */
static inline void GridStencil(int problem, int n, int i, int j, double v[5], double *load)
{
  const double pi = 3.14159265358979323846, h = 1.0 / (n + 1.0);

  v[0] = 4.0;
  v[1] = v[2] = v[3] = v[4] = -1.0;
  *load                     = 0.0;
  if (problem == GRID_TORSION) *load = 5.0 * h * h;
  if (problem == GRID_BEARING) {
    const double hx = 2.0 * pi * h, hy = 20.0 * h, here = GridFilm((i + 1) * hx), west = GridFilm(i * hx),
                 east = GridFilm((i + 2) * hx);

    v[1]  = -0.5 * (west + here) * hy / hx;
    v[2]  = -0.5 * (east + here) * hy / hx;
    v[3]  = -(4.0 * here + east + west) / 6.0 * hx / hy;
    v[4]  = v[3];
    v[0]  = -(v[1] + v[2] + v[3] + v[4]);
    *load = 0.1 * hx * hy * sin((i + 1) * hx);
  }
  if (problem == GRID_SIGNORINI) {
    const double ratio = (n + 1.0) / n; /* of the spacings, hy / hx */

    v[1] = v[2] = -ratio * (j ? 1.0 : 0.5);
    v[3]        = j ? -1.0 / ratio : 0.0;
    v[4]        = -1.0 / ratio;
    v[0]        = -(v[1] + v[2] + v[3] + v[4]);
    *load       = -4.0 * h * h * ratio * (j ? 1.0 : 0.5);
  }
}

/* Bounds of the unknown at (i, j); +-GRID_NONE: none */
static inline void GridBounds(int problem, int n, int i, int j, double *lower, double *upper)
{
  double x, y;

  GridPoint(problem, n, i, j, &x, &y);
  *lower = -GRID_NONE;
  *upper = GRID_NONE;
  if (problem == GRID_OBSTACLE) *lower = GridBall(4.0 * hypot(x - 0.5, y - 0.5));
  if (problem == GRID_TORSION) *lower = -(*upper = fmin(fmin(x, 1.0 - x), fmin(y, 1.0 - y)));
  if (problem == GRID_BEARING) {
    *lower = 0.0;
    *upper = 1000.0;
  }
  if (problem == GRID_SIGNORINI && j == 0) *lower = -0.1 - 0.2 * (x - 0.5) * (x - 0.5);
}

/* What the boundary's values add to the load at (i, j) and to the objective */
static inline void GridBoundaryTerms(int problem, int n, int i, int j, const double v[5], double *load,
  double *constant)
{
  const int di[5] = {0, -1, 1, 0, 0}, dj[5] = {0, 0, 0, -1, 1};

  for (int k = 1; k < 5; k++) {
    double x, y, g;

    if (i + di[k] >= 0 && i + di[k] < n && j + dj[k] >= 0 && j + dj[k] < n) continue;
    GridPoint(problem, n, i + di[k], j + dj[k], &x, &y);
    g = GridBoundary(problem, x, y);
    *load -= v[k] * g;
    *constant -= 0.5 * v[k] * g * g;
  }
}

#endif
