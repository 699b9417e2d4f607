/*
   The smooth surface over a facet: the facet plus the heights of curved edges above its straight edges. An edge between
   vertices with normals n0 and n1 is a cubic curve over its chord d, the straight edge. Its heights are measured in the
   direction of the mean N of the normals. The height at eta in [0, 1] is

     eta (1 - eta) (a0 (1 - eta) - a1 eta),   a = -2 d.n/(1 + N.n).

   The slope a is twice the tangent of half the angle between edge and chord, instead of the tangent of the angle, so
   that the midpoint of an arc is exact. Heights of opposite edges are blended linearly (S. A. Coons 1967; with
   quadratic edges T. Nagata, Computer Aided Geom. Design 22 (2005)). In a triangle the third edge is a point, and the
   height of the first edge is blended quadratically. Quadratic edges then give the quadratic surface.
*/
#include "smoothimpl.h"

/* largest slope of an edge's end relative to its chord. Steeper normals belong to a crumpled face and are
   meaningless. */
#define STEEPEST 0.7
/* An edge stays straight if the sum of its two unit normals is not longer than this: a normal is missing, or the
   normals differ by 119 degrees or more. */
#define LEAST_SUM 1.01

/* Returns whether edge e has two usable normals */
static PetscBool PatchIsBent(const ContactPatch *p, PetscInt e)
{
  const PetscReal *n[2] = {&p->normal[3 * e], &p->normal[3 * ((e + 1) % 4)]};
  PetscReal        N[3];

  for (PetscInt c = 0; c < 3; ++c) N[c] = n[0][c] + n[1][c];
  return (PetscBool)(VectorDot(N, N) > PetscSqr(LEAST_SUM));
}

/* Computes the curve of edge e, from vertex e to the next. The edge is straight if PatchIsBent() is false. */
static void BendEdge(const PetscReal x[12], PetscInt e, ContactPatch *p)
{
  const PetscReal *x0 = &x[3 * e], *x1 = &x[3 * ((e + 1) % 4)],
                  *n[2] = {&p->normal[3 * e], &p->normal[3 * ((e + 1) % 4)]};
  PetscReal *N          = p->direction[e], d[3], length, steepest;

  for (PetscInt c = 0; c < 3; ++c) {
    d[c] = x1[c] - x0[c];
    N[c] = n[0][c] + n[1][c];
  }
  length         = VectorNorm(N);
  steepest       = STEEPEST * VectorNorm(d);
  p->slope[e][0] = p->slope[e][1] = 0.0;
  if (!PatchIsBent(p, e)) return;
  for (PetscInt c = 0; c < 3; ++c) N[c] /= length;
  for (PetscInt i = 0; i < 2; ++i)
    p->slope[e][i] = PetscClipInterval(-2.0 * VectorDot(d, n[i]) / (1.0 + VectorDot(N, n[i])), -steepest, steepest);
}

/* Creates the patch of the facet x. normal: unit normals at its vertices; zero for a missing normal */
void ContactPatchCreate(const PetscReal x[12], const PetscReal normal[12], ContactPatch *p)
{
  p->triangle = ContactFacetIsTriangle(x);
  for (PetscInt i = 0; i < 12; ++i) p->normal[i] = normal[i];
  for (PetscInt e = 0; e < 4; ++e) BendEdge(x, e, p);
}

/* Returns an upper bound of the distance between the patch and the facet [length] */
PetscReal ContactPatchBulge(const ContactPatch *p)
{
  PetscReal bulge = 0.0;

  for (PetscInt e = 0; e < 4; ++e) bulge += 0.25 * PetscMax(PetscAbsReal(p->slope[e][0]), PetscAbsReal(p->slope[e][1]));
  return bulge;
}

/*
   Returns the uncertainty of the patch's height [length]. The slopes at the ends of an arc are opposite. Where the
   curvature changes, for example where a plane meets a fillet, the mean of the facets' normals is not the normal of the
   surface; the sum of the two slopes is the error of one of them, whose height is at most 4/27 of it.
*/
PetscReal ContactPatchDoubt(const ContactPatch *p)
{
  PetscReal sum[4];

  for (PetscInt e = 0; e < 4; ++e) sum[e] = PetscAbsReal(p->slope[e][0] + p->slope[e][1]);
  return 4.0 / 27.0 * (PetscMax(sum[0], sum[2]) + PetscMax(sum[1], sum[3]));
}

/* Computes offset, the vector from the facet's point xi to the patch's point [length], and the normal of the patch
   there, which is not scaled to length 1 */
void ContactPatchEvaluate(const ContactPatch *p, const PetscReal xi[2], PetscReal offset[3], PetscReal normal[3])
{
  const PetscReal s = 0.5 * (1.0 + xi[0]), t = 0.5 * (1.0 + xi[1]), along[4] = {s, t, 1.0 - s, 1.0 - t},
                  blend[4] = {p->triangle ? (1.0 - t) * (1.0 - t) : 1.0 - t, s, t, 1.0 - s};
  PetscReal phi[4];

  ContactShape(xi, phi);
  for (PetscInt c = 0; c < 3; ++c) offset[c] = normal[c] = 0.0;
  for (PetscInt e = 0; e < 4; ++e) {
    const PetscReal eta    = along[e],
                    height = blend[e] * eta * (1.0 - eta) * (p->slope[e][0] * (1.0 - eta) - p->slope[e][1] * eta);

    for (PetscInt c = 0; c < 3; ++c) {
      if (height != 0.0) offset[c] += height * p->direction[e][c];
      normal[c] += phi[e] * p->normal[3 * e + c];
    }
  }
}
