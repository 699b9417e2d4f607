/* Computes the stiffness of a cell from the tangents at its points, for all elements */
#include "elementsimpl.h"

/*
   Computes the entries for components i and k of all nodes. Sums for eight nodes a and as many nodes b as there are
   lanes remain in registers. width: number of nodes, rounded up to a multiple of LANES and of 8
*/
LANES_INLINE void StiffnessOfComponents(const int width, const CellBasis *basis, const CellTangents *t, int i, int k,
  PetscReal S[CELL_WIDTH][CELL_WIDTH])
{
  Lanes T[CELL_MAX_POINTS][3][CELL_WIDTH / LANES];

  for (PetscInt q = 0; q < basis->npoints; ++q) {
    for (int j = 0; j < 3; ++j) {
      const Lanes    *A  = t->A[q / LANES] + 9 * (3 * i + j) + 3 * k;
      const PetscReal c0 = LANE(A[0], q % LANES), c1 = LANE(A[1], q % LANES), c2 = LANE(A[2], q % LANES);

      for (int b = 0; b < width / LANES; ++b)
        T[q][j][b] = c0 * LANES_OF(t->G[q][0] + LANES * b) + c1 * LANES_OF(t->G[q][1] + LANES * b) +
                     c2 * LANES_OF(t->G[q][2] + LANES * b);
    }
  }
  for (int a = 0; a < width; a += 8) {
    for (int b = 0; b < width / LANES; ++b) {
      Lanes sum[8] = {};

      for (PetscInt q = 0; q < basis->npoints; ++q) {
        for (int j = 0; j < 3; ++j) {
          for (int r = 0; r < 8; ++r) sum[r] += t->G[q][j][a + r] * T[q][j][b];
        }
      }
      for (int r = 0; r < 8; ++r) LANES_OF(S[a + r] + LANES * b) = sum[r];
    }
  }
}

LANES_INLINE void StiffnessOfCell(const int width, const CellBasis *basis, const CellTangents *t, PetscScalar K[])
{
  const PetscInt n = basis->nnodes, row = 3 * n;

  for (int i = 0; i < 3; ++i) {
    for (int k = i; k < 3; ++k) {
      PetscReal S[CELL_WIDTH][CELL_WIDTH];

      StiffnessOfComponents(width, basis, t, i, k, S);
      for (PetscInt a = 0; a < n; ++a) {
        for (PetscInt b = 0; b < n; ++b) K[row * (3 * a + i) + 3 * b + k] = S[a][b];
      }
      for (PetscInt a = 0; a < n && i < k; ++a) {
        for (PetscInt b = 0; b < n; ++b) K[row * (3 * b + k) + 3 * a + i] = S[a][b];
      }
    }
  }
}

AMGF_CLONES void CellStiffness(const CellBasis *basis, const CellTangents *t, PetscScalar K[])
{
  if (basis->nnodes <= 8) StiffnessOfCell(8, basis, t, K);
  else StiffnessOfCell((int)(basis->nnodes + 7) / 8 * 8, basis, t, K);
}

LANES_INLINE void StiffnessConstant(const int n, const CellBasis *basis, const PetscReal A[81],
  PetscReal X[3][CELL_MAX_NODES], CellTangents *t)
{
  CellPack c;

  for (PetscInt pack = 0; pack < basis->npacks; ++pack) {
    CellPackGradients(n, basis, pack, X, &c);
    CellTangentsSetGradients(n, basis, pack, c.G, t);
    for (int i = 0; i < 81; ++i) t->A[pack][i] = A[i] * c.w;
  }
}

AMGF_CLONES void CellStiffnessConstant(const CellBasis *basis, const MaterialLaw *law, const MaterialModuli *m,
  PetscReal X[3][CELL_MAX_NODES], PetscScalar K[])
{
  const PetscReal undeformed[9] = {0};
  PetscReal       A[81];
  CellTangents    t;

  (void)law->tangent(m, undeformed, A);
  CELL_CALL(StiffnessConstant, basis, A, X, &t);
  CellStiffness(basis, &t, K);
}
