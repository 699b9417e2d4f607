/*
   The trilinear hexahedron on [-1,1]^3. Arrays over vertices come last, of constant length 8, for the compiler to vectorize.
*/
#ifndef ELASTICITY_HEX_H
#define ELASTICITY_HEX_H

#include <petscsys.h>

#define HEX_MAX_POINTS 27

typedef struct {
  PetscInt  npoints;
  PetscReal weight[HEX_MAX_POINTS];
  PetscReal N[HEX_MAX_POINTS][8];
  PetscReal dN[HEX_MAX_POINTS][3][8]; /* dN/dxi_k */
} HexBasis;

/* Gauss points per axis: 2 or 3 */
PETSC_INTERN PetscErrorCode HexBasisCreate(PetscInt gausspoints, HexBasis *);

/* Gradients G[j][a] = dN_a/dX_j at point q of the cell with vertices X[d][a]; returns weight times det dX/dxi */
static inline PetscReal HexGradients(const HexBasis *basis, PetscInt q, PetscReal X[3][8], PetscReal G[3][8])
{
  const PetscReal(*dN)[8] = basis->dN[q];
  PetscReal J[3][3], C[3][3], det;

  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) {
      PetscReal sum = 0;

      for (int a = 0; a < 8; ++a) sum += X[i][a] * dN[k][a];
      J[i][k] = sum;
    }
  }
  for (int i = 0; i < 3; ++i) {
    const int i1 = (i + 1) % 3, i2 = (i + 2) % 3;

    for (int k = 0; k < 3; ++k) {
      const int k1 = (k + 1) % 3, k2 = (k + 2) % 3;

      C[i][k] = J[i1][k1] * J[i2][k2] - J[i1][k2] * J[i2][k1];
    }
  }
  det = J[0][0] * C[0][0] + J[0][1] * C[0][1] + J[0][2] * C[0][2];
  for (int j = 0; j < 3; ++j) {
    const PetscReal c0 = C[j][0] / det, c1 = C[j][1] / det, c2 = C[j][2] / det;

    for (int a = 0; a < 8; ++a) G[j][a] = c0 * dN[0][a] + c1 * dN[1][a] + c2 * dN[2][a];
  }
  return basis->weight[q] * det;
}

/* H[3 i + j] = du_i/dX_j */
static inline void HexDisplacementGradient(PetscReal U[3][8], PetscReal G[3][8], PetscReal H[9])
{
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      PetscReal sum = 0;

      for (int a = 0; a < 8; ++a) sum += U[i][a] * G[j][a];
      H[3 * i + j] = sum;
    }
  }
}

#endif
