/* Normals of the smooth surface at the facets' corners: means over the facets around a node, with a correction at the
   border of the surface */
#include "smoothimpl.h"

/*
   Computes n, the sum of (e x f) / (e.e f.f) over the corners from `first` to `last`, scaled to length 1. The edges e
   and f meet at the corner. The normal is exact on spheres and cylinders for any edge lengths (N. Max, Weights for
   computing vertex normals from facet normals, J. Graphics Tools 4 (1999)). Returns the length before scaling.
*/
PetscReal ContactRingFanNormal(const ContactRing *ring, PetscInt first, PetscInt last, PetscReal n[3])
{
  n[0] = n[1] = n[2] = 0.0;
  for (PetscInt corner = first;; corner = ring->twin[ContactCornerBefore(ring, corner)]) {
    PetscReal after[3], before[3], product[3], weight;

    ContactRingEdges(ring, corner, after, before);
    VectorCross(after, before, product);
    weight = VectorDot(after, after) * VectorDot(before, before);
    for (PetscInt c = 0; weight > 0.0 && c < 3; ++c) n[c] += product[c] / weight;
    if (corner == last) break;
  }
  return VectorScaleToUnit(n);
}

/* Computes the mean normal n over those facets around a corner's node that are not separated by a sharp edge */
void ContactRingMeanNormal(const ContactRing *ring, PetscInt corner, PetscReal n[3])
{
  PetscInt first, last;

  (void)ContactRingFan(ring, corner, &first, &last);
  (void)ContactRingFanNormal(ring, first, last, n);
}

/* Corrects the normal n at a node that only one facet has. Along both edges of the facet the surface is continued as an
   arc: the normals at the two ends of an arc are mirror images. */
static void CorrectCorner(const ContactRing *ring, PetscInt corner, PetscReal n[3])
{
  PetscReal d[2][3], m[3], G[3], rhs[2], det;

  ContactRingEdges(ring, corner, d[0], d[1]);
  for (PetscInt i = 0; i < 2; ++i) {
    ContactRingMeanNormal(ring, i ? ContactCornerBefore(ring, corner) : ContactCornerAfter(ring, corner), m);
    rhs[i] = -VectorDot(n, d[i]) - VectorDot(m, d[i]);
    G[i]   = VectorDot(d[i], d[i]);
  }
  G[2] = VectorDot(d[0], d[1]);
  det  = G[0] * G[1] - G[2] * G[2];
  if (!(det > CONTACT_FLAT_CORNER * G[0] * G[1])) return;
  for (PetscInt c = 0; c < 3; ++c)
    n[c] += ((G[1] * rhs[0] - G[2] * rhs[1]) * d[0][c] + (G[0] * rhs[1] - G[2] * rhs[0]) * d[1][c]) / det;
}

/*
   Corrects the normal n of a node on the border. The component along the border is that of the mean normal. The
   component across the border is determined by least squares, so that the surface continues as an arc along the edges
   that lead away from the border.
*/
static void CorrectBorder(const ContactRing *ring, PetscInt first, PetscInt last, PetscReal n[3])
{
  PetscReal after[3], before[3], d[3], m[3], along[3], across[3], sum = 0.0, squares = 0.0;

  ContactRingEdges(ring, first, after, d);
  ContactRingEdges(ring, last, d, before);
  for (PetscInt c = 0; c < 3; ++c) along[c] = after[c] - before[c];
  VectorCross(n, along, across);
  (void)VectorScaleToUnit(across);
  for (PetscInt corner = first; corner != last; corner = ring->twin[ContactCornerBefore(ring, corner)]) {
    ContactRingEdges(ring, corner, after, d);
    ContactRingMeanNormal(ring, ContactCornerBefore(ring, corner), m);
    sum -= (VectorDot(n, d) + VectorDot(m, d)) * VectorDot(across, d);
    squares += PetscSqr(VectorDot(across, d));
  }
  if (!(squares > 0.0)) return;
  for (PetscInt c = 0; c < 3; ++c) n[c] += sum / squares * across[c];
}

/* Corrects the mean unit normal n at the node of an open fan of corners so that the surface ends as an arc. The result
   has not length 1. */
void ContactRingCorrectNormal(const ContactRing *ring, PetscInt first, PetscInt last, PetscReal n[3])
{
  if (first == last) CorrectCorner(ring, first, n);
  else CorrectBorder(ring, first, last, n);
}

/* Computes the unit normal at a corner: the mean over the facets around its node that are not separated by a sharp
   edge, corrected at the border. The normal is zero if the contributions cancel. */
void ContactRingNormal(const ContactRing *ring, PetscInt corner, PetscReal n[3])
{
  PetscInt        first, last;
  const PetscBool closed = ContactRingFan(ring, corner, &first, &last);

  (void)ContactRingFanNormal(ring, first, last, n);
  if (closed) return;
  ContactRingCorrectNormal(ring, first, last, n);
  (void)VectorScaleToUnit(n);
}
