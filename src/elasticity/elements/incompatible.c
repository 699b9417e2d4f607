/*
   Incompatible modes, for linear laws and cells of order 1:

     E = min over a of int W(H + sum_m a_m M_m).

   The mode amplitudes a of a cell are condensed. With J the Jacobian at a point and J0 that at the centre, the 12 modes
   are

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

#define MODES 12

typedef struct {
  PetscReal K[MODES][3][CELL_MAX_NODES]; /* second derivatives of the energy by a mode and U[i][a] */
  PetscReal L[MODES][MODES];             /* Cholesky factor of the second derivatives by two modes */
} Incompatibility;

/* cofactor = det J0 J0^(-1); the modes are scaled by det J0 */
static void IncompatibleCentre(PetscReal X[3][CELL_MAX_NODES], PetscReal cofactor[3][3])
{
  PetscReal J[3][3];

  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) {
      J[i][k] = 0;
      for (int a = 0; a < 8; ++a) J[i][k] += 0.125 * (a >> k & 1 ? X[i][a] : -X[i][a]);
    }
  }
  for (int k = 0; k < 3; ++k) {
    const int k1 = (k + 1) % 3, k2 = (k + 2) % 3;

    for (int j = 0; j < 3; ++j)
      cofactor[k][j] = J[(j + 1) % 3][k1] * J[(j + 2) % 3][k2] - J[(j + 1) % 3][k2] * J[(j + 2) % 3][k1];
  }
}

/* The modes as displacement gradients at point q, whose volume is w */
static void IncompatibleModes(const CellBasis *basis, PetscInt q, PetscReal w, PetscReal cofactor[3][3],
  PetscReal M[MODES][9])
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

/* Cholesky factorization in place; the matrix is positive definite, since no combination of modes is a rotation at
   all points */
static void IncompatibleFactor(PetscReal L[MODES][MODES])
{
  for (int m = 0; m < MODES; ++m) {
    for (int n = 0; n <= m; ++n) {
      PetscReal sum = L[m][n];

      for (int k = 0; k < n; ++k) sum -= L[m][k] * L[n][k];
      L[m][n] = m == n ? PetscSqrtReal(sum) : sum / L[n][n];
    }
  }
}

static void IncompatibleSetUp(const CellBasis *basis, const BodyMaterial *m, PetscReal X[3][CELL_MAX_NODES],
  Incompatibility *modes)
{
  PetscReal G[3][CELL_MAX_NODES], M[MODES][9], P[9], cofactor[3][3];

  *modes = (Incompatibility){0};
  IncompatibleCentre(X, cofactor);
  for (PetscInt q = 0; q < basis->npoints; ++q) {
    const PetscReal w = CellGradients(8, basis, q, X, G);

    IncompatibleModes(basis, q, w, cofactor, M);
    for (int k = 0; k < MODES; ++k) {
      (void)m->law->stress(&m->moduli, M[k], P);
      CellForceAdd(8, w, G, P, modes->K[k]);
      for (int l = 0; l <= k; ++l) {
        for (int j = 0; j < 9; ++j) modes->L[k][l] += w * P[j] * M[l][j];
      }
    }
  }
  IncompatibleFactor(modes->L);
}

/* a = -K_aa^(-1) K_au u; returns the energy that the modes remove, a.K_aa a/2 */
static PetscReal IncompatibleSolve(const Incompatibility *modes, PetscReal U[3][CELL_MAX_NODES], PetscReal a[MODES])
{
  PetscReal released = 0;

  for (int k = 0; k < MODES; ++k) {
    a[k] = 0;
    for (int i = 0; i < 3; ++i) {
      for (int b = 0; b < 8; ++b) a[k] -= modes->K[k][i][b] * U[i][b];
    }
    for (int l = 0; l < k; ++l) a[k] -= modes->L[k][l] * a[l];
    a[k] /= modes->L[k][k];
    released += 0.5 * a[k] * a[k];
  }
  for (int k = MODES - 1; k >= 0; --k) {
    for (int l = k + 1; l < MODES; ++l) a[k] -= modes->L[l][k] * a[l];
    a[k] /= modes->L[k][k];
  }
  return released;
}

static PetscReal ElementEnergy_Incompatible(const CellBasis *basis, const BodyMaterial *m,
  PetscReal X[3][CELL_MAX_NODES], PetscReal U[3][CELL_MAX_NODES])
{
  Incompatibility modes;
  PetscReal       a[MODES];

  IncompatibleSetUp(basis, m, X, &modes);
  return ElementFull.energy(basis, m, X, U) - IncompatibleSolve(&modes, U, a);
}

static PetscBool ElementForce_Incompatible(const CellBasis *basis, const BodyMaterial *m,
  PetscReal X[3][CELL_MAX_NODES], PetscReal U[3][CELL_MAX_NODES], PetscReal F[3][CELL_MAX_NODES])
{
  Incompatibility modes;
  PetscReal       a[MODES];

  IncompatibleSetUp(basis, m, X, &modes);
  (void)IncompatibleSolve(&modes, U, a);
  if (!ElementFull.force(basis, m, X, U, F)) return PETSC_FALSE;
  for (int k = 0; k < MODES; ++k) {
    for (int i = 0; i < 3; ++i) {
      for (int b = 0; b < 8; ++b) F[i][b] += a[k] * modes.K[k][i][b];
    }
  }
  return PETSC_TRUE;
}

/* K_uu - (L^(-1) K_au)^T (L^(-1) K_au) */
static PetscBool ElementStiffness_Incompatible(const CellBasis *basis, const BodyMaterial *m,
  PetscReal X[3][CELL_MAX_NODES], PetscReal U[3][CELL_MAX_NODES], PetscScalar K[])
{
  Incompatibility modes;
  PetscReal       row[24];

  IncompatibleSetUp(basis, m, X, &modes);
  if (!ElementFull.stiffness(basis, m, X, U, K)) return PETSC_FALSE;
  for (int k = 0; k < MODES; ++k) {
    for (int r = 0; r < 24; ++r) {
      PetscReal *entry = &modes.K[k][r % 3][r / 3];

      for (int l = 0; l < k; ++l) *entry -= modes.L[k][l] * modes.K[l][r % 3][r / 3];
      *entry /= modes.L[k][k];
      row[r] = *entry;
    }
    for (int r = 0; r < 24; ++r) {
      for (int s = 0; s < 24; ++s) K[24 * r + s] -= row[r] * row[s];
    }
  }
  return PETSC_TRUE;
}

/* the stresses of the modes have zero mean */
static PetscBool ElementCauchy_Incompatible(const CellBasis *basis, const BodyMaterial *m,
  PetscReal X[3][CELL_MAX_NODES], PetscReal U[3][CELL_MAX_NODES], PetscReal sigma[6])
{
  return ElementFull.cauchy(basis, m, X, U, sigma);
}

static void ElementStrains_Incompatible(const CellBasis *basis, const BodyMaterial *m, PetscReal X[3][CELL_MAX_NODES],
  PetscReal U[3][CELL_MAX_NODES], PetscReal w[], PetscReal H[][ELEMENT_STRAINS])
{
  Incompatibility modes;
  PetscReal       a[MODES], M[MODES][9], C[9], cofactor[3][3];

  ElementFull.strains(basis, m, X, U, w, H);
  IncompatibleCentre(X, cofactor);
  IncompatibleSetUp(basis, m, X, &modes);
  (void)IncompatibleSolve(&modes, U, a);
  for (PetscInt q = 0; q < basis->npoints; ++q) {
    IncompatibleModes(basis, q, w[q], cofactor, M);
    for (int k = 0; k < MODES; ++k) {
      for (int j = 0; j < 9; ++j) H[q][j] += a[k] * M[k][j];
    }
    H[q][9] = m->law->dilatation(H[q], C);
  }
}

const Element ElementIncompatible = {
  .nnodes    = 8,
  .energy    = ElementEnergy_Incompatible,
  .force     = ElementForce_Incompatible,
  .stiffness = ElementStiffness_Incompatible,
  .cauchy    = ElementCauchy_Incompatible,
  .strains   = ElementStrains_Incompatible,
};
