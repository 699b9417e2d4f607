/* Quadrature on triangles */
#include "contactimpl.h"

/*
  Radon's 7-point rule, exact for polynomials of degree 5: the product of two bilinear functions on parallelograms has
  degree 4. The weights sum to 1.

  J. Radon, Zur mechanischen Kubatur, Monatshefte fuer Mathematik 52 (1948)
*/
void ContactTriangleRule(PetscReal barycentric[CONTACT_TRIANGLE_POINTS][3], PetscReal weight[CONTACT_TRIANGLE_POINTS])
{
  const PetscReal root = PetscSqrtReal(15.0);

  for (PetscInt c = 0; c < 3; ++c) barycentric[0][c] = 1.0 / 3.0;
  weight[0] = 9.0 / 40.0;
  for (PetscInt orbit = 0; orbit < 2; ++orbit) {
    const PetscReal sign = orbit ? 1.0 : -1.0;
    const PetscReal a    = (6.0 + sign * root) / 21.0;

    for (PetscInt k = 0; k < 3; ++k) {
      const PetscInt q = 1 + 3 * orbit + k;

      for (PetscInt c = 0; c < 3; ++c) barycentric[q][c] = c == k ? 1.0 - 2.0 * a : a;
      weight[q] = (155.0 + sign * root) / 1200.0;
    }
  }
}
