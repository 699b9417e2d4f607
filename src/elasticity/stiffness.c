/* Stiffness of a hexahedron from its points' tangents, shared by the elements */
#include "elasticityimpl.h"

/*
   K_ab = int lambda grad N_a (x) grad N_b + mu grad N_b (x) grad N_a + mu (grad N_a . grad N_b) I,
   from the six integrals S_ij[a][b] = int dN_a/dX_i dN_b/dX_j, i <= j, as S_ji is the transpose of S_ij.
*/
void HexStiffnessIsotropic(const HexBasis *basis, PetscReal X[3][8], PetscReal lambda, PetscReal mu, PetscScalar K[24][24])
{
  PetscReal S[3][3][8][8] = {{{{0}}}}, G[3][8];

  for (PetscInt q = 0; q < basis->npoints; ++q) {
    const PetscReal w = HexGradients(basis, q, X, G);

    for (int i = 0; i < 3; ++i) {
      for (int j = i; j < 3; ++j) {
        for (int a = 0; a < 8; ++a) {
          const PetscReal g = w * G[i][a];

          for (int b = 0; b < 8; ++b) S[i][j][a][b] += g * G[j][b];
        }
      }
    }
  }
  for (int a = 0; a < 8; ++a) {
    for (int b = 0; b < 8; ++b) {
      const PetscReal laplacian = mu * (S[0][0][a][b] + S[1][1][a][b] + S[2][2][a][b]);

      for (int i = 0; i < 3; ++i) {
        K[3 * a + i][3 * b + i] = laplacian + (lambda + mu) * S[i][i][a][b];
        for (int j = i + 1; j < 3; ++j) {
          K[3 * a + i][3 * b + j] = lambda * S[i][j][a][b] + mu * S[i][j][b][a];
          K[3 * a + j][3 * b + i] = lambda * S[i][j][b][a] + mu * S[i][j][a][b];
        }
      }
    }
  }
}

void HexStiffnessAdd(PetscReal w, PetscReal G[3][8], const PetscReal A[81], PetscReal S[3][3][8][8])
{
  for (int i = 0; i < 3; ++i) {
    for (int k = i; k < 3; ++k) {
      PetscReal T[3][8];

      for (int j = 0; j < 3; ++j) {
        const PetscReal *c = A + 9 * (3 * i + j) + 3 * k;

        for (int b = 0; b < 8; ++b) T[j][b] = w * (c[0] * G[0][b] + c[1] * G[1][b] + c[2] * G[2][b]);
      }
      for (int a = 0; a < 8; ++a) {
        for (int b = 0; b < 8; ++b) S[i][k][a][b] += G[0][a] * T[0][b] + G[1][a] * T[1][b] + G[2][a] * T[2][b];
      }
    }
  }
}

/* S[k][i][a][b] = S[i][k][b][a] */
void HexStiffnessFinish(PetscReal S[3][3][8][8], PetscScalar K[24][24])
{
  for (int a = 0; a < 8; ++a) {
    for (int b = 0; b < 8; ++b) {
      for (int i = 0; i < 3; ++i) {
        K[3 * a + i][3 * b + i] = S[i][i][a][b];
        for (int k = i + 1; k < 3; ++k) {
          K[3 * a + i][3 * b + k] = S[i][k][a][b];
          K[3 * a + k][3 * b + i] = S[i][k][b][a];
        }
      }
    }
  }
}
