/*
   Element with incompatible modes, for laws of small strain and cells of order 1: E = min over a of int W(H + sum_m a_m
   M_m), with the modes M_m of modes.c. The coefficients a are eliminated in the cell. condensed.c treats laws that are
   not linear.
*/
#include "elementsimpl.h"

#define MODES INCOMPATIBLE_MODES

typedef struct {
  PetscReal K[MODES][3][CELL_MAX_NODES]; /* second derivatives of the energy by the coefficient of a mode and by
                                            U[i][a] */
  PetscReal L[MODES][MODES];             /* Cholesky factor of K_aa, the second derivatives by two coefficients of
                                            modes */
} Incompatibility;

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

/* Computes a = -K_aa^(-1) K_au u. Returns the energy by which the modes reduce that of the cell, a.K_aa a/2. */
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

  if (m->law->advance) return CondensedEnergy(basis, m, X, U);
  IncompatibleSetUp(basis, m, X, &modes);
  return ElementFull.energy(basis, m, X, U) - IncompatibleSolve(&modes, U, a);
}

static PetscBool ElementForce_Incompatible(const CellBasis *basis, const BodyMaterial *m,
  PetscReal X[3][CELL_MAX_NODES], PetscReal U[3][CELL_MAX_NODES], PetscReal F[3][CELL_MAX_NODES])
{
  Incompatibility modes;
  PetscReal       a[MODES];

  if (m->law->advance) return CondensedForce(basis, m, X, U, F);
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

/* Computes K = K_uu - (L^(-1) K_au)^T (L^(-1) K_au) */
static PetscBool ElementStiffness_Incompatible(const CellBasis *basis, const BodyMaterial *m,
  PetscReal X[3][CELL_MAX_NODES], PetscReal U[3][CELL_MAX_NODES], PetscReal before[3][CELL_MAX_NODES], PetscScalar K[])
{
  Incompatibility modes;
  PetscReal       row[24];

  if (m->law->advance) return CondensedStiffness(basis, m, X, U, K);
  IncompatibleSetUp(basis, m, X, &modes);
  if (!ElementFull.stiffness(basis, m, X, U, before, K)) return PETSC_FALSE;
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

/* Computes the mean Cauchy stress. For a linear law the stresses of the modes have zero mean and need not be added. */
static PetscBool ElementCauchy_Incompatible(const CellBasis *basis, const BodyMaterial *m,
  PetscReal X[3][CELL_MAX_NODES], PetscReal U[3][CELL_MAX_NODES], PetscReal sigma[6])
{
  return m->law->advance ? CondensedCauchy(basis, m, X, U, sigma) : ElementFull.cauchy(basis, m, X, U, sigma);
}

static void ElementStrains_Incompatible(const CellBasis *basis, const BodyMaterial *m, PetscReal X[3][CELL_MAX_NODES],
  PetscReal U[3][CELL_MAX_NODES], PetscReal w[], PetscReal H[][ELEMENT_STRAINS])
{
  Incompatibility modes;
  PetscReal       a[MODES], M[MODES][9], C[9], cofactor[3][3];

  if (m->law->advance) {
    CondensedStrains(basis, m, X, U, w, H);
    return;
  }
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
