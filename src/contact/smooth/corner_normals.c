/* Normals of the smooth surface at the facets' corners: means over the facets about a node, corrected where the
   surface ends */
#include "smoothimpl.h"

/*
  Sum over the corners from first to last of (e x f) / (e.e f.f), e and f the edges that meet there: exact on spheres
  and on cylinders, whatever the lengths (N. Max, Weights for computing vertex normals from facet normals, J. Graphics
  Tools 4 (1999)), scaled to length 1; returns the length before
*/
PetscReal ContactRingFanNormal(const ContactRing *ring, PetscInt first, PetscInt last, PetscReal n[3])
{
  n[0] = n[1] = n[2] = 0.0;
  for (PetscInt corner = first;; corner = ring->twin[ContactCornerBefore(ring, corner)]) {
    PetscReal after[3], before[3], product[3], weight;

    ContactRingEdges(ring, corner, after, before);
    ContactCross(after, before, product);
    weight = ContactDot(after, after) * ContactDot(before, before);
    for (PetscInt c = 0; weight > 0.0 && c < 3; ++c) n[c] += product[c] / weight;
    if (corner == last) break;
  }
  return ContactScaleToUnit(n);
}

/* Mean over all facets about a corner's node that no sharp edge separates */
void ContactRingMeanNormal(const ContactRing *ring, PetscInt corner, PetscReal n[3])
{
  PetscInt first, last;

  (void)ContactRingFan(ring, corner, &first, &last);
  (void)ContactRingFanNormal(ring, first, last, n);
}

/* A corner with one facet only: along both its edges the surface is an arc, whose end normals mirror each other */
static void MendCorner(const ContactRing *ring, PetscInt corner, PetscReal n[3])
{
  PetscReal d[2][3], m[3], G[3], rhs[2], det;

  ContactRingEdges(ring, corner, d[0], d[1]);
  for (PetscInt i = 0; i < 2; ++i) {
    ContactRingMeanNormal(ring, i ? ContactCornerBefore(ring, corner) : ContactCornerAfter(ring, corner), m);
    rhs[i] = -ContactDot(n, d[i]) - ContactDot(m, d[i]);
    G[i]   = ContactDot(d[i], d[i]);
  }
  G[2] = ContactDot(d[0], d[1]);
  det  = G[0] * G[1] - G[2] * G[2];
  if (!(det > CONTACT_FLAT_CORNER * G[0] * G[1])) return;
  for (PetscInt c = 0; c < 3; ++c)
    n[c] += ((G[1] * rhs[0] - G[2] * rhs[1]) * d[0][c] + (G[0] * rhs[1] - G[2] * rhs[0]) * d[1][c]) / det;
}

/* A vertex on the border: along the border the mean is right; across it the surface is an arc along the edges that
   lead inward, by least squares */
static void MendBorder(const ContactRing *ring, PetscInt first, PetscInt last, PetscReal n[3])
{
  PetscReal after[3], before[3], d[3], m[3], along[3], across[3], sum = 0.0, squares = 0.0;

  ContactRingEdges(ring, first, after, d);
  ContactRingEdges(ring, last, d, before);
  for (PetscInt c = 0; c < 3; ++c) along[c] = after[c] - before[c];
  ContactCross(n, along, across);
  (void)ContactScaleToUnit(across);
  for (PetscInt corner = first; corner != last; corner = ring->twin[ContactCornerBefore(ring, corner)]) {
    ContactRingEdges(ring, corner, after, d);
    ContactRingMeanNormal(ring, ContactCornerBefore(ring, corner), m);
    sum -= (ContactDot(n, d) + ContactDot(m, d)) * ContactDot(across, d);
    squares += PetscSqr(ContactDot(across, d));
  }
  if (!(squares > 0.0)) return;
  for (PetscInt c = 0; c < 3; ++c) n[c] += sum / squares * across[c];
}

/* From the unit mean of an open fan of facets to a normal with which the surface ends as an arc; not scaled yet */
void ContactRingMend(const ContactRing *ring, PetscInt first, PetscInt last, PetscReal n[3])
{
  if (first == last) MendCorner(ring, first, n);
  else MendBorder(ring, first, last, n);
}

/* Unit normal at a corner, mean over the facets about its node that no sharp edge separates; zero if they cancel */
void ContactRingNormal(const ContactRing *ring, PetscInt corner, PetscReal n[3])
{
  PetscInt        first, last;
  const PetscBool closed = ContactRingFan(ring, corner, &first, &last);

  (void)ContactRingFanNormal(ring, first, last, n);
  if (closed) return;
  ContactRingMend(ring, first, last, n);
  (void)ContactScaleToUnit(n);
}
