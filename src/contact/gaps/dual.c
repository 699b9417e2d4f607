/*
   The dual functions of a facet: psi_A = sum_B dual_AB phi_B, where int psi_A phi_B is int phi_A for A = B, and 0
   otherwise (B. I. Wohlmuth, SIAM J. Numer. Anal. 38 (2000)). With dual functions the contact force of a row acts at
   its own nonmortar vertex only, and near it on the mortar side. Therefore a resultant force can act at the edge of a
   face. On a parallelogram the dual functions are products of 2 phi_1 - phi_2 along the edges. On a triangle, whose
   last vertex is stored twice, they are 3 phi_1 - phi_2 - phi_3.
*/
#include "gapsimpl.h"
#include <vector3.h>

/* Computes mass[a][b] = int phi_a phi_b with 3 x 3 Gauss points [length^2] */
static void DualMass(const PetscReal x[12], PetscReal mass[4][4])
{
  const PetscReal point[3]  = {-0.7745966692414834, 0.0, 0.7745966692414834};
  const PetscReal weight[3] = {5.0 / 9.0, 8.0 / 9.0, 5.0 / 9.0};

  for (PetscInt a = 0; a < 16; ++a) mass[a / 4][a % 4] = 0.0;
  for (PetscInt q = 0; q < 9; ++q) {
    const PetscReal xi[2] = {point[q / 3], point[q % 3]};
    PetscReal       phi[4], t1[3], t2[3], n[3], w;

    ContactShape(xi, phi);
    ContactFacetTangents(x, xi, t1, t2);
    VectorCross(t1, t2, n);
    w = weight[q / 3] * weight[q % 3] * VectorNorm(n);
    for (PetscInt a = 0; a < 16; ++a) mass[a / 4][a % 4] += w * phi[a / 4] * phi[a % 4];
  }
}

/* Computes dual = diag(lumped mass) mass^-1. The matrix of a triangle does not depend on its shape. */
void ContactDualFunctions(const PetscReal x[12], PetscReal dual[4][4])
{
  static const PetscReal triangle[4][4] = {{3, -1, -1, -1}, {-1, 3, -1, -1}, {-0.5, -0.5, 3, 0}, {-0.5, -0.5, 0, 3}};
  PetscReal              lumped[4]      = {0.0, 0.0, 0.0, 0.0};

  if (ContactFacetIsTriangle(x)) {
    for (PetscInt a = 0; a < 16; ++a) dual[a / 4][a % 4] = triangle[a / 4][a % 4];
    return;
  }
  DualMass(x, dual);
  for (PetscInt a = 0; a < 16; ++a) lumped[a / 4] += dual[a / 4][a % 4];
  (void)MatrixInvertInPlace(4, 4, &dual[0][0]);
  for (PetscInt a = 0; a < 16; ++a) dual[a / 4][a % 4] *= lumped[a / 4];
}

/* Multiplies n values of each of the four functions by the matrix dual: values[A * n + i] = sum_B dual_AB values[B * n
   + i] */
void ContactDualTransform(PetscReal (*dual)[4], PetscInt n, PetscReal values[])
{
  for (PetscInt i = 0; i < n; ++i) {
    const PetscReal v[4] = {values[i], values[n + i], values[2 * n + i], values[3 * n + i]};

    for (PetscInt a = 0; a < 4; ++a)
      values[a * n + i] = dual[a][0] * v[0] + dual[a][1] * v[1] + dual[a][2] * v[2] + dual[a][3] * v[3];
  }
}

/* Transforms the derivatives of the four rows of a facet from phi_A to the dual functions */
void ContactDualTransformSlopes(PetscReal (*dual)[4], ContactSlopes *slopes)
{
  ContactDualTransform(dual, 12, &slopes->rigid[0][0]);
  ContactDualTransform(dual, 12, &slopes->cover[0][0]);
}
