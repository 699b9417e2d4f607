/* Computes the stiffness of a cell from the tangents at its points, for all elements */
#include "elementsimpl.h"

void CellSumsClear(PetscInt n, CellSums *S)
{
  for (int i = 0; i < 3; ++i) {
    for (int k = i; k < 3; ++k) {
      for (PetscInt ab = 0; ab < n * n; ++ab) S->of[i][k][ab] = 0;
    }
  }
}

/*
   Computes K_ab = int lambda grad N_a (x) grad N_b + mu grad N_b (x) grad N_a + mu (grad N_a . grad N_b) I, from the
   six integrals S_ij[a][b] = int dN_a/dX_i dN_b/dX_j with i <= j, since S_ji is the transpose of S_ij
*/
static inline void StiffnessIsotropic(const int n, const CellBasis *basis, PetscReal X[3][CELL_MAX_NODES],
  PetscReal lambda, PetscReal mu, PetscScalar K[])
{
  PetscReal G[3][CELL_MAX_NODES];
  CellSums  S;

  CellSumsClear(n, &S);
  for (PetscInt q = 0; q < basis->npoints; ++q) {
    const PetscReal w = CellGradients(n, basis, q, X, G);

    for (int i = 0; i < 3; ++i) {
      for (int j = i; j < 3; ++j) {
        for (int a = 0; a < n; ++a) {
          const PetscReal g = w * G[i][a];

          for (int b = 0; b < n; ++b) S.of[i][j][n * a + b] += g * G[j][b];
        }
      }
    }
  }
  for (int a = 0; a < n; ++a) {
    for (int b = 0; b < n; ++b) {
      const int       ab = n * a + b, ba = n * b + a, width = 3 * n;
      const PetscReal laplacian = mu * (S.of[0][0][ab] + S.of[1][1][ab] + S.of[2][2][ab]);
      PetscScalar    *block     = K + 3 * (width * a + b);

      for (int i = 0; i < 3; ++i) {
        block[width * i + i] = laplacian + (lambda + mu) * S.of[i][i][ab];
        for (int j = i + 1; j < 3; ++j) {
          block[width * i + j] = lambda * S.of[i][j][ab] + mu * S.of[i][j][ba];
          block[width * j + i] = lambda * S.of[i][j][ba] + mu * S.of[i][j][ab];
        }
      }
    }
  }
}

static inline void StiffnessAdd(const int n, const CellBasis *basis, PetscReal w, PetscReal G[3][CELL_MAX_NODES],
  const PetscReal A[81], CellSums *S)
{
  (void)basis;
  for (int i = 0; i < 3; ++i) {
    for (int k = i; k < 3; ++k) {
      PetscReal T[3][CELL_MAX_NODES];

      for (int j = 0; j < 3; ++j) {
        const PetscReal *c = A + 9 * (3 * i + j) + 3 * k;

        for (int b = 0; b < n; ++b) T[j][b] = w * (c[0] * G[0][b] + c[1] * G[1][b] + c[2] * G[2][b]);
      }
      for (int a = 0; a < n; ++a) {
        for (int b = 0; b < n; ++b) S->of[i][k][n * a + b] += G[0][a] * T[0][b] + G[1][a] * T[1][b] + G[2][a] * T[2][b];
      }
    }
  }
}

void CellStiffnessAdd(const CellBasis *basis, PetscReal w, PetscReal G[3][CELL_MAX_NODES], const PetscReal A[81],
  CellSums *S)
{
  CELL_CALL(StiffnessAdd, basis, w, G, A, S);
}

/* Computes the stiffness from the sums, of which only those with i <= k are stored: S[k][i][a][b] = S[i][k][b][a] */
void CellStiffnessFinish(const CellBasis *basis, const CellSums *S, PetscScalar K[])
{
  const PetscInt n = basis->nnodes, width = 3 * n;

  for (PetscInt a = 0; a < n; ++a) {
    for (PetscInt b = 0; b < n; ++b) {
      PetscScalar *block = K + 3 * (width * a + b);

      for (PetscInt i = 0; i < 3; ++i) {
        block[width * i + i] = S->of[i][i][n * a + b];
        for (PetscInt k = i + 1; k < 3; ++k) {
          block[width * i + k] = S->of[i][k][n * a + b];
          block[width * k + i] = S->of[i][k][n * b + a];
        }
      }
    }
  }
}

/* Computes the stiffness for an anisotropic law with the constant tangent A */
static inline void StiffnessAnisotropic(const int n, const CellBasis *basis, PetscReal X[3][CELL_MAX_NODES],
  const PetscReal A[81], PetscScalar K[])
{
  PetscReal G[3][CELL_MAX_NODES];
  CellSums  S;

  CellSumsClear(n, &S);
  for (PetscInt q = 0; q < basis->npoints; ++q) {
    const PetscReal w = CellGradients(n, basis, q, X, G);

    StiffnessAdd(n, basis, w, G, A, &S);
  }
  CellStiffnessFinish(basis, &S, K);
}

void CellStiffnessConstant(const CellBasis *basis, const MaterialLaw *law, const MaterialModuli *m,
  PetscReal X[3][CELL_MAX_NODES], PetscScalar K[])
{
  const PetscReal undeformed[9] = {0};
  PetscReal       A[81];

  if (law->isotropic) CELL_CALL(StiffnessIsotropic, basis, X, m->lambda, m->mu, K);
  else {
    (void)law->tangent(m, undeformed, A);
    CELL_CALL(StiffnessAnisotropic, basis, X, A, K);
  }
}
