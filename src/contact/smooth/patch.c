/*
   The smooth surface through a facet: the facet plus the heights of curved edges over its straight ones. An edge
   between vertices with normals n0 and n1 is a cubic over its chord, the straight edge d. It bends along the mean N of
   the normals. Its height at eta in [0, 1] is

     eta (1 - eta) (a0 (1 - eta) - a1 eta),   a = -2 d.n/(1 + N.n).

   This is twice the tangent of half an angle instead of the tangent of the angle, so that the midpoint of an arc is
   exact. Heights of opposite edges are blended linearly (S. A. Coons 1967; with quadratic edges T. Nagata, Comput.
   Aided Geom. Design 22 (2005)). In a triangle the third edge is a point, and the height of the first edge is blended
   quadratically; quadratic edges then give the quadratic surface.
*/
#include "smoothimpl.h"

/* limit of the slope at an edge's end against its chord; steeper normals belong to a crumpled face and are
   meaningless */
#define STEEPEST 0.7
/* limit of the length of the sum of the two normals: an edge stays straight if a normal is missing or they differ by
   119 degrees or more */
#define LEAST_SUM 1.01

/* Whether edge e has two usable normals */
PetscBool ContactPatchIsBent(const ContactPatch *p, PetscInt e)
{
  const PetscReal *n[2] = {&p->normal[3 * e], &p->normal[3 * ((e + 1) % 4)]};
  PetscReal        N[3];

  for (PetscInt c = 0; c < 3; ++c) N[c] = n[0][c] + n[1][c];
  return (PetscBool)(VectorDot(N, N) > PetscSqr(LEAST_SUM));
}

/* Computes edge e from vertex e to the next; straight if a normal is missing or the two are opposite */
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
  if (!ContactPatchIsBent(p, e)) return;
  for (PetscInt c = 0; c < 3; ++c) N[c] /= length;
  for (PetscInt i = 0; i < 2; ++i)
    p->slope[e][i] = PetscClipInterval(-2.0 * VectorDot(d, n[i]) / (1.0 + VectorDot(N, n[i])), -steepest, steepest);
}

/* Creates the patch of the facet x with these unit normals at its vertices; a zero normal means a missing one */
void ContactPatchCreate(const PetscReal x[12], const PetscReal normal[12], ContactPatch *p)
{
  p->triangle = ContactFacetIsTriangle(x);
  for (PetscInt i = 0; i < 12; ++i) p->normal[i] = normal[i];
  for (PetscInt e = 0; e < 4; ++e) BendEdge(x, e, p);
}

/* Largest distance of the patch from the facet */
PetscReal ContactPatchBulge(const ContactPatch *p)
{
  PetscReal bulge = 0.0;

  for (PetscInt e = 0; e < 4; ++e) bulge += 0.25 * PetscMax(PetscAbsReal(p->slope[e][0]), PetscAbsReal(p->slope[e][1]));
  return bulge;
}

/* offset: position on the patch minus position on the facet at xi; normal: of the patch there */
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
