/* Bilinear facets: shape functions, area vector, lumped mass, and the inverse of a plane bilinear map */
#include "geometryimpl.h"

static const PetscReal corner[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};

PetscBool ContactFacetIsTriangle(const PetscReal x[12])
{
  return (PetscBool)(x[6] == x[9] && x[7] == x[10] && x[8] == x[11]);
}

void ContactShape(const PetscReal xi[2], PetscReal phi[4])
{
  for (PetscInt a = 0; a < 4; ++a) phi[a] = 0.25 * (1.0 + corner[a][0] * xi[0]) * (1.0 + corner[a][1] * xi[1]);
}

/* Computes the derivatives of the shape functions with respect to both parameters: dphi[a][k] = d phi_a / d xi_k */
void ContactShapeSlopes(const PetscReal xi[2], PetscReal dphi[4][2])
{
  for (PetscInt a = 0; a < 4; ++a) {
    dphi[a][0] = 0.25 * corner[a][0] * (1.0 + corner[a][1] * xi[1]);
    dphi[a][1] = 0.25 * corner[a][1] * (1.0 + corner[a][0] * xi[0]);
  }
}

/* Computes the integral a of the unit normal over the facet [length^2]: half the cross product of the diagonals. This
   is exact for warped facets too. */
void ContactFacetAreaVector(const PetscReal x[12], PetscReal a[3])
{
  PetscReal d1[3], d2[3];

  for (PetscInt c = 0; c < 3; ++c) {
    d1[c] = x[6 + c] - x[c];
    d2[c] = x[9 + c] - x[3 + c];
  }
  VectorCross(d1, d2, a);
  for (PetscInt c = 0; c < 3; ++c) a[c] *= 0.5;
}

/*
   Computes by_x, the derivative of moment . theta with respect to the coordinates of the vertices. theta is the
   rotation vector of the facet [rad], defined by the rotation of its normal and, about the normal, of its first
   diagonal. The facet's area must not be zero.
*/
void ContactFacetTurn(const PetscReal x[12], const PetscReal moment[3], PetscReal by_x[12])
{
  PetscReal d[2][3], by_d[2][3], n[3], q[3], s[3], spin, size;

  for (PetscInt k = 0; k < 2; ++k) {
    for (PetscInt c = 0; c < 3; ++c) d[k][c] = x[6 + 3 * k + c] - x[3 * k + c];
  }
  VectorCross(d[0], d[1], n);
  size = VectorScaleToUnit(n); /* n is now the unit normal, and size is twice the area. */
  VectorCross(moment, n, q);
  VectorCross(d[1], q, by_d[0]);
  VectorCross(q, d[0], by_d[1]);
  VectorCross(n, d[0], s);
  spin = VectorDot(moment, n) / VectorDot(d[0], d[0]);
  for (PetscInt c = 0; c < 3; ++c) {
    by_d[0][c] = by_d[0][c] / size + spin * s[c];
    by_d[1][c] /= size;
  }
  for (PetscInt k = 0; k < 2; ++k) {
    for (PetscInt c = 0; c < 3; ++c) {
      by_x[6 + 3 * k + c] = by_d[k][c];
      by_x[3 * k + c]     = -by_d[k][c];
    }
  }
}

/* Computes the tangents of the facet at xi: t1 = dx/dxi_1 and t2 = dx/dxi_2 [length] */
void ContactFacetTangents(const PetscReal x[12], const PetscReal xi[2], PetscReal t1[3], PetscReal t2[3])
{
  for (PetscInt c = 0; c < 3; ++c) t1[c] = t2[c] = 0.0;
  for (PetscInt a = 0; a < 4; ++a) {
    for (PetscInt c = 0; c < 3; ++c) {
      t1[c] += 0.25 * corner[a][0] * (1.0 + corner[a][1] * xi[1]) * x[3 * a + c];
      t2[c] += 0.25 * corner[a][1] * (1.0 + corner[a][0] * xi[0]) * x[3 * a + c];
    }
  }
}

/* Computes mass[a], the integral of the shape function phi_a over the facet [length^2], exact for plane facets. Returns
   the area of the facet. */
PetscReal ContactFacetMass(const PetscReal x[12], PetscReal mass[4])
{
  const PetscReal g    = 1.0 / PetscSqrtReal(3.0);
  PetscReal       area = 0.0;

  for (PetscInt a = 0; a < 4; ++a) mass[a] = 0.0;
  for (PetscInt q = 0; q < 4; ++q) {
    const PetscReal xi[2] = {g * corner[q][0], g * corner[q][1]};
    PetscReal       phi[4], t1[3], t2[3], n[3], weight;

    ContactShape(xi, phi);
    ContactFacetTangents(x, xi, t1, t2);
    VectorCross(t1, t2, n);
    weight = VectorNorm(n);
    for (PetscInt a = 0; a < 4; ++a) mass[a] += weight * phi[a];
    area += weight;
  }
  return area;
}

/* Returns the length of the longer diagonal [length]. A triangle has its fourth vertex equal to the third; the result
   is then the longer of the two edges that meet there. */
PetscReal ContactFacetDiameter(const PetscReal x[12])
{
  PetscReal square[2] = {0.0, 0.0};

  for (PetscInt c = 0; c < 3; ++c) {
    square[0] += PetscSqr(x[6 + c] - x[c]);
    square[1] += PetscSqr(x[9 + c] - x[3 + c]);
  }
  return PetscSqrtReal(PetscMax(square[0], square[1]));
}

/* Computes the parameters xi of the point y of a plane triangle. xi[1] is 1 at its last vertex, and xi is clipped to
   [-1, 1]. */
static void FacetInverseTriangle(const PetscReal q[4][2], const PetscReal y[2], PetscReal xi[2])
{
  const PetscReal e[2] = {q[1][0] - q[0][0], q[1][1] - q[0][1]}, f[2] = {q[2][0] - q[0][0], q[2][1] - q[0][1]},
                  r[2] = {y[0] - q[0][0], y[1] - q[0][1]};
  const PetscReal det = e[0] * f[1] - e[1] * f[0], second = det != 0.0 ? (r[0] * f[1] - r[1] * f[0]) / det : 0.0,
                  third = det != 0.0 ? (e[0] * r[1] - e[1] * r[0]) / det : 0.0;

  xi[0] = third < 1.0 ? PetscClipInterval(2.0 * second / (1.0 - third) - 1.0, -1.0, 1.0) : 0.0;
  xi[1] = PetscClipInterval(2.0 * third - 1.0, -1.0, 1.0);
}

/* Prepares ContactInverseMap() for a plane facet with the vertices q */
void ContactBilinearCreate(const PetscReal q[4][2], ContactBilinear *map)
{
  map->triangle = (PetscBool)(q[2][0] == q[3][0] && q[2][1] == q[3][1]);
  for (PetscInt d = 0; d < 2; ++d) {
    for (PetscInt a = 0; a < 4; ++a) map->q[a][d] = q[a][d];
    map->c[0][d] = 0.25 * (q[0][d] + q[1][d] + q[2][d] + q[3][d]);
    map->c[1][d] = 0.25 * (-q[0][d] + q[1][d] + q[2][d] - q[3][d]);
    map->c[2][d] = 0.25 * (-q[0][d] - q[1][d] + q[2][d] + q[3][d]);
    map->c[3][d] = 0.25 * (q[0][d] - q[1][d] + q[2][d] - q[3][d]);
  }
}

/*
   Computes the parameters xi of the point y of a plane facet. For a quadrilateral Newton's method solves the bilinear
   map; one step suffices for a parallelogram. After a step below 1e-9 the error is rounding error, since convergence is
   quadratic. The result is clipped to [-bound, bound] for a quadrilateral and to [-1, 1] for a triangle, because
   rounding may place y slightly outside, and because the map may be degenerate.
*/
void ContactInverseMap(const ContactBilinear *map, const PetscReal y[2], PetscReal bound, PetscReal xi[2])
{
  const PetscReal(*c)[2] = map->c, small = 1e-9;

  if (map->triangle) {
    FacetInverseTriangle(map->q, y, xi);
    return;
  }
  xi[0] = xi[1] = 0.0;
  for (PetscInt it = 0; it < 25; ++it) {
    PetscReal r[2], J[2][2], det, step[2];

    for (PetscInt d = 0; d < 2; ++d) {
      r[d]    = y[d] - (c[0][d] + c[1][d] * xi[0] + c[2][d] * xi[1] + c[3][d] * xi[0] * xi[1]);
      J[d][0] = c[1][d] + c[3][d] * xi[1];
      J[d][1] = c[2][d] + c[3][d] * xi[0];
    }
    det = J[0][0] * J[1][1] - J[0][1] * J[1][0];
    if (det == 0.0) break;
    det     = 1.0 / det;
    step[0] = (J[1][1] * r[0] - J[0][1] * r[1]) * det;
    step[1] = (J[0][0] * r[1] - J[1][0] * r[0]) * det;
    for (PetscInt d = 0; d < 2; ++d) xi[d] = PetscClipInterval(xi[d] + step[d], -bound, bound);
    if (PetscAbsReal(step[0]) + PetscAbsReal(step[1]) < small) break;
  }
}
