/* The point of a bilinear facet that is closest to a given point */
#include "geometryimpl.h"

#define CLOSEST_MAX_STEPS    50
#define CLOSEST_MAX_HALVINGS 8

/* The vector from the given point to the point (xi, eta) of the facet: r = c0 + c1 xi + c2 eta + c3 xi eta [length] */
typedef struct {
  PetscReal c[4][3];
} ClosestOffset;

/* Computes the vector r from the given point to the facet's point xi, and returns the square of its length */
static PetscReal ClosestEvaluate(const ClosestOffset *o, const PetscReal xi[2], PetscReal r[3])
{
  for (PetscInt d = 0; d < 3; ++d) r[d] = o->c[0][d] + o->c[1][d] * xi[0] + (o->c[2][d] + o->c[3][d] * xi[0]) * xi[1];
  return VectorDot(r, r);
}

/* Sets xi to the start of Newton's method: the nearest of nine points of the facet. One start at the centre is not
   enough, because the distance from a warped facet may have several local minima. Returns the squared distance. */
static PetscReal ClosestStart(const ClosestOffset *o, PetscReal xi[2])
{
  PetscReal best = PETSC_MAX_REAL;

  for (PetscInt i = 0; i < 9; ++i) {
    const PetscReal eta[2] = {2.0 / 3.0 * (PetscReal)(i % 3 - 1), 2.0 / 3.0 * (PetscReal)(i / 3 - 1)};
    PetscReal       r[3];
    const PetscReal f = ClosestEvaluate(o, eta, r);

    if (f < best) {
      best  = f;
      xi[0] = eta[0];
      xi[1] = eta[1];
    }
  }
  return best;
}

/* Computes the tangents t[0] = dr/dxi and t[1] = dr/deta at xi. Each is constant along its own parameter. */
static void ClosestTangents(const ClosestOffset *o, const PetscReal xi[2], PetscReal t[2][3])
{
  for (PetscInt d = 0; d < 3; ++d) {
    t[0][d] = o->c[1][d] + o->c[3][d] * xi[1];
    t[1][d] = o->c[2][d] + o->c[3][d] * xi[0];
  }
}

/* Sets xi[parameter] to the value in [-1, 1] with the least distance, while the other parameter is fixed. Returns the
   squared distance. */
static PetscReal ClosestAlongLine(const ClosestOffset *o, PetscInt parameter, PetscReal xi[2])
{
  PetscReal t[2][3], r[3], length;

  ClosestTangents(o, xi, t);
  length = VectorDot(t[parameter], t[parameter]);
  (void)ClosestEvaluate(o, xi, r);
  if (length > 0.0) xi[parameter] = PetscClipInterval(xi[parameter] - VectorDot(r, t[parameter]) / length, -1.0, 1.0);
  return ClosestEvaluate(o, xi, r);
}

/* Computes the Newton step of half the squared distance at xi. If the Hessian is not positive definite, the step is
   that of the Gauss-Newton method. Returns false if that matrix is singular too. */
static PetscBool ClosestNewtonStep(const ClosestOffset *o, const PetscReal xi[2], PetscReal step[2])
{
  PetscReal r[3], t[2][3], g[2], H[3], det, twist;

  (void)ClosestEvaluate(o, xi, r);
  ClosestTangents(o, xi, t);
  for (PetscInt d = 0; d < 2; ++d) g[d] = VectorDot(r, t[d]);
  H[0]  = VectorDot(t[0], t[0]);
  H[1]  = VectorDot(t[0], t[1]);
  H[2]  = VectorDot(t[1], t[1]);
  twist = VectorDot(r, o->c[3]);
  det   = H[0] * H[2] - PetscSqr(H[1] + twist);
  if (det > 0.0) H[1] += twist;
  else det = H[0] * H[2] - PetscSqr(H[1]);
  if (!(det > 0.0)) return PETSC_FALSE;
  step[0] = (H[1] * g[1] - H[2] * g[0]) / det;
  step[1] = (H[1] * g[0] - H[0] * g[1]) / det;
  return PETSC_TRUE;
}

/* Moves xi by the step, clipped to the facet's edges, and halves the step until the squared distance *f decreases.
   Returns false, with xi and *f unchanged, if no step decreases it. */
static PetscBool ClosestShorten(const ClosestOffset *o, const PetscReal step[2], PetscReal xi[2], PetscReal *f)
{
  PetscReal scale = 1.0;

  for (PetscInt k = 0; k < CLOSEST_MAX_HALVINGS; ++k) {
    PetscReal       r[3];
    const PetscReal next[2] = {PetscClipInterval(xi[0] + scale * step[0], -1.0, 1.0),
      PetscClipInterval(xi[1] + scale * step[1], -1.0, 1.0)};
    const PetscReal fnext   = ClosestEvaluate(o, next, r);

    if (fnext < *f) {
      *f    = fnext;
      xi[0] = next[0];
      xi[1] = next[1];
      return PETSC_TRUE;
    }
    scale *= 0.5;
  }
  return PETSC_FALSE;
}

/* Minimizes the distance over the facet and returns the squared minimum. Where the Newton step gives no decrease, for
   example at an edge, one parameter is minimized after the other. */
static PetscReal ClosestDescend(const ClosestOffset *o, PetscReal xi[2])
{
  PetscReal f = ClosestStart(o, xi);

  for (PetscInt it = 0; it < CLOSEST_MAX_STEPS; ++it) {
    const PetscReal old[2] = {xi[0], xi[1]};
    PetscReal       step[2];

    if (!ClosestNewtonStep(o, xi, step) || !ClosestShorten(o, step, xi, &f)) {
      (void)ClosestAlongLine(o, 0, xi);
      f = ClosestAlongLine(o, 1, xi);
    }
    if (PetscAbsReal(xi[0] - old[0]) + PetscAbsReal(xi[1] - old[1]) < 16.0 * PETSC_MACHINE_EPSILON) break;
  }
  return f;
}

/* Computes the parameters xi and the coordinates y of the point of the facet x that is closest to the point p. Returns
   their distance [length]. */
PetscReal ContactClosestPoint(const PetscReal x[12], const PetscReal p[3], PetscReal xi[2], PetscReal y[3])
{
  ClosestOffset o;
  PetscReal     best, r[3];

  for (PetscInt d = 0; d < 3; ++d) {
    const PetscReal q[4] = {x[d] - p[d], x[3 + d] - p[d], x[6 + d] - p[d], x[9 + d] - p[d]};

    o.c[0][d] = 0.25 * (q[0] + q[1] + q[2] + q[3]);
    o.c[1][d] = 0.25 * (-q[0] + q[1] + q[2] - q[3]);
    o.c[2][d] = 0.25 * (-q[0] - q[1] + q[2] + q[3]);
    o.c[3][d] = 0.25 * (q[0] - q[1] + q[2] - q[3]);
  }
  best = ClosestDescend(&o, xi);
  for (PetscInt e = 0; e < 4;
       /* The descent can stop in a corner that is not the closest point. Edges are straight, so that the closest point
          of each edge is exact. */
       ++e) {
    const PetscReal end    = e % 2 ? 1.0 : -1.0;
    PetscReal       eta[2] = {e < 2 ? 0.0 : end, e < 2 ? end : 0.0};
    const PetscReal f      = ClosestAlongLine(&o, e / 2, eta);

    if (f < best) {
      best  = f;
      xi[0] = eta[0];
      xi[1] = eta[1];
    }
  }
  (void)ClosestEvaluate(&o, xi, r);
  for (PetscInt d = 0; d < 3; ++d) y[d] = p[d] + r[d];
  return PetscSqrtReal(best);
}
