/*
   The 12 incompatible modes of a cell of order 1 as displacement gradients. With J the Jacobian at a point and J0 that
   at the centre they are

     M_(3 i + k) = det J0/det J xi_k e_i (x) (row k of J0^(-1)),
     M_(9 + k) = det J0/det J xi_(k + 1) xi_(k + 2) I.

   The first nine are gradients of xi_k^2, which avoid shear locking in bending. The last three are dilatations that a
   trilinear displacement lacks; they avoid locking as Poisson's ratio approaches 1/2. The factor det J0/det J makes int
   M = 0 in cells of any shape, so they pass the patch test.

   References: Taylor, Beresford and Wilson, A non-conforming element for stress analysis, 1976. Simo and Rifai, A class
   of mixed assumed strain methods and the method of incompatible modes, 1990. Simo, Armero and Taylor, Improved
   versions of assumed enhanced strain tri-linear elements for 3D finite deformation problems, 1993.
*/
#include "elementsimpl.h"
#include <vector3.h>

#define MODES INCOMPATIBLE_MODES

/* Computes cofactor = det J0 J0^(-1), with which the modes are scaled by det J0 */
void IncompatibleCentre(PetscReal X[3][CELL_MAX_NODES], PetscReal cofactor[3][3])
{
  PetscReal transposed[3][3] = {{0}};

  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) {
      for (int a = 0; a < 8; ++a) transposed[k][i] += 0.125 * (a >> k & 1 ? X[i][a] : -X[i][a]);
    }
  }
  (void)MatrixCofactors(transposed, cofactor);
}

/* Computes the modes as displacement gradients at point q, whose volume is w */
void IncompatibleModes(const CellBasis *basis, PetscInt q, PetscReal w, PetscReal cofactor[3][3], PetscReal M[MODES][9])
{
  const PetscReal *xi = basis->xi[q], inverse = basis->weight[q] / w;

  for (int m = 0; m < MODES; ++m) {
    for (int j = 0; j < 9; ++j) M[m][j] = 0;
  }
  for (int k = 0; k < 3; ++k) {
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) M[3 * i + k][3 * i + j] = inverse * xi[k] * cofactor[k][j];
      M[9 + k][4 * i] = inverse * xi[(k + 1) % 3] * xi[(k + 2) % 3];
    }
  }
}

/*
   Computes a Cholesky factorization in place. The matrix is positive definite, since no combination of modes is a
   rotation at all points.
*/
void IncompatibleFactor(PetscReal L[MODES][MODES])
{
  for (int n = 0; n < MODES; ++n) {
    const PetscReal root = PetscSqrtReal(L[n][n]), inverse = 1 / root;

    L[n][n] = root;
    for (int m = n + 1; m < MODES; ++m) L[m][n] *= inverse;
    for (int m = n + 1; m < MODES; ++m) {
      for (int k = n + 1; k <= m; ++k) L[m][k] -= L[m][n] * L[k][n];
    }
  }
}
