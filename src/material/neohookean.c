/* Compressible neo-Hookean: W = mu/2 (J^(-2/3) tr(F^T F) - 3) + kappa/2 (J - 1)^2, kappa = lambda + 2 mu/3 */
#include "laws.h"

/* F = I + H, its cofactors C = J F^(-T), J = det F, tr(F^T F) */
static void NeoHookeanKinematics(const PetscReal H[9], PetscReal F[9], PetscReal C[9], PetscReal *J, PetscReal *I1)
{
  for (int i = 0; i < 9; ++i) F[i] = H[i] + (i % 4 == 0);
  for (int i = 0; i < 3; ++i) {
    const int i1 = (i + 1) % 3, i2 = (i + 2) % 3;

    for (int j = 0; j < 3; ++j) {
      const int j1 = (j + 1) % 3, j2 = (j + 2) % 3;

      C[3 * i + j] = F[3 * i1 + j1] * F[3 * i2 + j2] - F[3 * i1 + j2] * F[3 * i2 + j1];
    }
  }
  *J  = F[0] * C[0] + F[1] * C[1] + F[2] * C[2];
  *I1 = 0;
  for (int i = 0; i < 9; ++i) *I1 += F[i] * F[i];
}

static PetscReal MaterialEnergy_NeoHookean(PetscReal lambda, PetscReal mu, const PetscReal H[9])
{
  PetscReal F[9], C[9], J, I1;

  NeoHookeanKinematics(H, F, C, &J, &I1);
  if (J <= 0) return PETSC_INFINITY;
  return 0.5 * mu * (PetscPowReal(J, -2. / 3.) * I1 - 3) + 0.5 * (lambda + 2 * mu / 3) * (J - 1) * (J - 1);
}

/* P = mu J^(-2/3) (F - I1/3 G) + kappa (J - 1) J G, G = F^(-T) */
static void MaterialStress_NeoHookean(PetscReal lambda, PetscReal mu, const PetscReal H[9], PetscReal P[9])
{
  PetscReal F[9], C[9], J, I1, m, g;

  NeoHookeanKinematics(H, F, C, &J, &I1);
  m = mu * PetscPowReal(J, -2. / 3.);
  g = (lambda + 2 * mu / 3) * (J - 1) - m * I1 / (3 * J);
  for (int i = 0; i < 9; ++i) P[i] = m * F[i] + g * C[i];
}

/* From dJ = J G:dF, dI1 = 2 F:dF and dG_iJ = -G_iL G_kJ dF_kL */
static void MaterialTangent_NeoHookean(PetscReal lambda, PetscReal mu, const PetscReal H[9], PetscReal A[81])
{
  const PetscReal kappa = lambda + 2 * mu / 3;
  PetscReal       F[9], G[9], J, I1, m;

  NeoHookeanKinematics(H, F, G, &J, &I1);
  for (int i = 0; i < 9; ++i) G[i] /= J;
  m = mu * PetscPowReal(J, -2. / 3.);
  for (int p = 0; p < 9; ++p) {
    for (int q = 0; q < 9; ++q) {
      const PetscReal crossed = G[p / 3 * 3 + q % 3] * G[q / 3 * 3 + p % 3];

      A[9 * p + q] = m * ((p == q) - 2. / 3. * (F[p] * G[q] + G[p] * F[q]) + I1 * (2. / 9. * G[p] * G[q] + crossed / 3)) + kappa * ((2 * J - 1) * J * G[p] * G[q] - (J - 1) * J * crossed);
    }
  }
}

/* sigma = P F^T / J */
static void MaterialCauchy_NeoHookean(PetscReal lambda, PetscReal mu, const PetscReal H[9], PetscReal sigma[6])
{
  static const int row[6] = {0, 1, 2, 0, 1, 2}, column[6] = {0, 1, 2, 1, 2, 0};
  PetscReal        F[9], C[9], P[9], J, I1;

  NeoHookeanKinematics(H, F, C, &J, &I1);
  MaterialStress_NeoHookean(lambda, mu, H, P);
  for (int s = 0; s < 6; ++s) {
    const PetscReal *p = P + 3 * row[s], *f = F + 3 * column[s];

    sigma[s] = (p[0] * f[0] + p[1] * f[1] + p[2] * f[2]) / J;
  }
}

const MaterialLaw MaterialLawNeoHookean = {PETSC_FALSE, MaterialEnergy_NeoHookean, MaterialStress_NeoHookean, MaterialTangent_NeoHookean, MaterialCauchy_NeoHookean};
