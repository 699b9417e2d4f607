/*
   Normals of the smooth surface through facets, at the facets' corners: means over the facets around a node, with a
   correction at the border. Corner 4 f + a is vertex a of facet f; a triangle has three corners. A corner
   also represents the edge from its vertex to the next.
*/
#include "queryimpl.h"
#include <vector3.h>

/* Returns the number of corners of a corner's facet. A triangle stores its last node twice. */
static PetscInt CornerCount(const MeshFacets *s, PetscInt corner)
{
  const PetscInt *node = &s->node[4 * (corner / 4)];

  return node[2] == node[3] ? 3 : 4;
}

/* Returns the next corner of the facet, counterclockwise */
PetscInt MeshCornerAfter(const MeshFacets *s, PetscInt corner)
{
  return 4 * (corner / 4) + (corner % 4 + 1) % CornerCount(s, corner);
}

/* Returns the previous corner of the facet */
PetscInt MeshCornerBefore(const MeshFacets *s, PetscInt corner)
{
  const PetscInt n = CornerCount(s, corner);

  return 4 * (corner / 4) + (corner % 4 + n - 1) % n;
}

/* Returns whether a corner is the fourth corner of a triangle, which is not used */
PetscBool MeshCornerIsNone(const MeshFacets *s, PetscInt corner)
{
  return (PetscBool)(corner % 4 >= CornerCount(s, corner));
}

/* Finds the first (clockwise) and the last corner around a corner's node before a sharp edge or the border. Returns
   true if there is neither, so that the corners form a closed fan. */
PetscBool MeshCornerFan(const MeshFacets *s, PetscInt corner, PetscInt *first, PetscInt *last)
{
  *first = *last = corner;
  while (s->twin[MeshCornerBefore(s, *last)] >= 0) {
    *last = s->twin[MeshCornerBefore(s, *last)];
    if (*last == corner) {
      *last = MeshCornerAfter(s, s->twin[corner]);
      return PETSC_TRUE;
    }
  }
  while (s->twin[*first] >= 0) *first = MeshCornerAfter(s, s->twin[*first]);
  return PETSC_FALSE;
}

/* Computes the edge vectors from a corner's vertex to the next and to the previous vertex of its facet [length] */
void MeshCornerEdges(const MeshFacets *s, PetscInt corner, PetscReal after[3], PetscReal before[3])
{
  const PetscReal *x = &s->x[3 * s->node[corner]], *y = &s->x[3 * s->node[MeshCornerAfter(s, corner)]],
                  *z = &s->x[3 * s->node[MeshCornerBefore(s, corner)]];

  for (PetscInt c = 0; c < 3; ++c) {
    after[c]  = y[c] - x[c];
    before[c] = z[c] - x[c];
  }
}

/*
   Computes n, the sum of (e x f) / (e.e f.f) over the corners from `first` to `last`, scaled to length 1. The edges e
   and f meet at the corner. The normal is exact on spheres and cylinders for any edge lengths (N. Max, Weights for
   computing vertex normals from facet normals, J. Graphics Tools 4 (1999)). Returns the length before scaling.
*/
PetscReal MeshCornerFanNormal(const MeshFacets *s, PetscInt first, PetscInt last, PetscReal n[3])
{
  n[0] = n[1] = n[2] = 0.0;
  for (PetscInt corner = first;; corner = s->twin[MeshCornerBefore(s, corner)]) {
    PetscReal after[3], before[3], product[3], weight;

    MeshCornerEdges(s, corner, after, before);
    VectorCross(after, before, product);
    weight = VectorDot(after, after) * VectorDot(before, before);
    for (PetscInt c = 0; weight > 0.0 && c < 3; ++c) n[c] += product[c] / weight;
    if (corner == last) break;
  }
  return VectorScaleToUnit(n);
}

/* Computes the mean normal n over those facets around a corner's node that are not separated by a sharp edge */
void MeshCornerMeanNormal(const MeshFacets *s, PetscInt corner, PetscReal n[3])
{
  PetscInt first, last;

  (void)MeshCornerFan(s, corner, &first, &last);
  (void)MeshCornerFanNormal(s, first, last, n);
}

/* Corrects the normal n at a node that only one facet has. Along both edges of the facet the surface is continued as an
   arc: the normals at the two ends of an arc are mirror images. */
static void CorrectCorner(const MeshFacets *s, PetscInt corner, PetscReal n[3])
{
  PetscReal d[2][3], m[3], G[3], rhs[2], det;

  MeshCornerEdges(s, corner, d[0], d[1]);
  for (PetscInt i = 0; i < 2; ++i) {
    MeshCornerMeanNormal(s, i ? MeshCornerBefore(s, corner) : MeshCornerAfter(s, corner), m);
    rhs[i] = -VectorDot(n, d[i]) - VectorDot(m, d[i]);
    G[i]   = VectorDot(d[i], d[i]);
  }
  G[2] = VectorDot(d[0], d[1]);
  det  = G[0] * G[1] - G[2] * G[2];
  if (!(det > MESH_FLAT_CORNER * G[0] * G[1])) return;
  for (PetscInt c = 0; c < 3; ++c)
    n[c] += ((G[1] * rhs[0] - G[2] * rhs[1]) * d[0][c] + (G[0] * rhs[1] - G[2] * rhs[0]) * d[1][c]) / det;
}

/*
   Corrects the normal n of a node on the border. The component along the border is that of the mean normal. The
   component across the border is determined by least squares, so that the surface continues as an arc along the edges
   that lead away from the border.
*/
static void CorrectBorder(const MeshFacets *s, PetscInt first, PetscInt last, PetscReal n[3])
{
  PetscReal after[3], before[3], d[3], m[3], along[3], across[3], sum = 0.0, squares = 0.0;

  MeshCornerEdges(s, first, after, d);
  MeshCornerEdges(s, last, d, before);
  for (PetscInt c = 0; c < 3; ++c) along[c] = after[c] - before[c];
  VectorCross(n, along, across);
  (void)VectorScaleToUnit(across);
  for (PetscInt corner = first; corner != last; corner = s->twin[MeshCornerBefore(s, corner)]) {
    MeshCornerEdges(s, corner, after, d);
    MeshCornerMeanNormal(s, MeshCornerBefore(s, corner), m);
    sum -= (VectorDot(n, d) + VectorDot(m, d)) * VectorDot(across, d);
    squares += PetscSqr(VectorDot(across, d));
  }
  if (!(squares > 0.0)) return;
  for (PetscInt c = 0; c < 3; ++c) n[c] += sum / squares * across[c];
}

/* Corrects the mean unit normal n at the node of an open fan of corners so that the surface ends as an arc. The result
   has not length 1. */
void MeshCornerCorrectNormal(const MeshFacets *s, PetscInt first, PetscInt last, PetscReal n[3])
{
  if (first == last) CorrectCorner(s, first, n);
  else CorrectBorder(s, first, last, n);
}

/* Computes the unit normal at a corner: the mean over the facets around its node that are not separated by a sharp
   edge, corrected at the border. The normal is zero if the contributions cancel. */
void MeshCornerNormal(const MeshFacets *s, PetscInt corner, PetscReal n[3])
{
  PetscInt        first, last;
  const PetscBool closed = MeshCornerFan(s, corner, &first, &last);

  (void)MeshCornerFanNormal(s, first, last, n);
  if (closed) return;
  MeshCornerCorrectNormal(s, first, last, n);
  (void)VectorScaleToUnit(n);
}
