/*
   Saint Venant-Kirchhoff: W = lambda/2 (tr E)^2 + mu E:E, E = (H + H^T + H^T H)/2, for large rotations with moderate
   strain. The law softens in compression and is unstable below a stretch of about 0.58.
*/
#include "materialimpl.h"

/* Computes the strain E. Returns det F, which is not accurate for small strains. */
static PetscReal SaintVenantStrain(const PetscReal H[9], PetscReal E[9])
{
  PetscReal F[9];

  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      E[3 * i + j] = 0.5 * (H[3 * i + j] + H[3 * j + i] + H[i] * H[j] + H[3 + i] * H[3 + j] + H[6 + i] * H[6 + j]);
      F[3 * i + j] = H[3 * i + j] + (i == j);
    }
  }
  return F[0] * (F[4] * F[8] - F[5] * F[7]) - F[1] * (F[3] * F[8] - F[5] * F[6]) + F[2] * (F[3] * F[7] - F[4] * F[6]);
}

/* Computes S = lambda tr E I + 2 mu E and J = det F. Returns true if J > 0 or J is NaN. */
static PetscBool SaintVenantStress(const MaterialModuli *m, const PetscReal H[9], PetscReal S[9], PetscReal *J)
{
  PetscReal E[9];

  *J = SaintVenantStrain(H, E);
  if (*J <= 0) return PETSC_FALSE;
  for (int k = 0; k < 9; ++k) S[k] = 2 * m->mu * E[k] + (k % 4 ? 0 : m->lambda * (E[0] + E[4] + E[8]));
  return PETSC_TRUE;
}

static PetscReal MaterialEnergy_SaintVenant(const MaterialModuli *m, const PetscReal H[9])
{
  PetscReal E[9], trace, square = 0;

  if (SaintVenantStrain(H, E) <= 0) return PETSC_INFINITY;
  trace = E[0] + E[4] + E[8];
  for (int k = 0; k < 9; ++k) square += E[k] * E[k];
  return 0.5 * m->lambda * trace * trace + m->mu * square;
}

/* Computes P = F S */
static PetscBool MaterialStress_SaintVenant(const MaterialModuli *m, const PetscReal H[9], PetscReal P[9])
{
  PetscReal S[9], J;

  if (!SaintVenantStress(m, H, S, &J)) return PETSC_FALSE;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j)
      P[3 * i + j] = S[3 * i + j] + H[3 * i] * S[j] + H[3 * i + 1] * S[3 + j] + H[3 * i + 2] * S[6 + j];
  }
  return PETSC_TRUE;
}

/* Computes the tangent from dP_ij = dF_il S_lj + F_il dS_lj with dE = (F^T dF + dF^T F)/2 */
static PetscBool MaterialTangent_SaintVenant(const MaterialModuli *m, const PetscReal H[9], PetscReal A[81])
{
  PetscReal S[9], F[9], B[9], J;

  if (!SaintVenantStress(m, H, S, &J)) return PETSC_FALSE;
  for (int k = 0; k < 9; ++k) F[k] = (k % 4 ? 0 : 1) + H[k];
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k)
      B[3 * i + k] = F[3 * i] * F[3 * k] + F[3 * i + 1] * F[3 * k + 1] + F[3 * i + 2] * F[3 * k + 2];
  }
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      for (int k = 0; k < 3; ++k) {
        for (int l = 0; l < 3; ++l) {
          A[9 * (3 * i + j) + 3 * k + l] = (i == k ? S[3 * j + l] : 0) + m->lambda * F[3 * i + j] * F[3 * k + l] +
                                           m->mu * (F[3 * i + l] * F[3 * k + j] + (j == l ? B[3 * i + k] : 0));
        }
      }
    }
  }
  return PETSC_TRUE;
}

/* Computes sigma = F S F^T / J */
static PetscBool MaterialCauchy_SaintVenant(const MaterialModuli *m, const PetscReal H[9], PetscReal sigma[6])
{
  static const int row[6] = {0, 1, 2, 0, 1, 2}, column[6] = {0, 1, 2, 1, 2, 0};
  PetscReal        S[9], J;

  if (!SaintVenantStress(m, H, S, &J)) return PETSC_FALSE;
  for (int s = 0; s < 6; ++s) {
    sigma[s] = 0;
    for (int k = 0; k < 9; ++k)
      sigma[s] +=
        ((row[s] == k / 3) + H[3 * row[s] + k / 3]) * S[k] * ((column[s] == k % 3) + H[3 * column[s] + k % 3]) / J;
  }
  return PETSC_TRUE;
}

/* Returns theta = tr E, and computes its derivative C */
static PetscReal MaterialDilatation_SaintVenant(const PetscReal H[9], PetscReal C[9])
{
  PetscReal E[9];

  (void)SaintVenantStrain(H, E);
  for (int k = 0; k < 9; ++k) C[k] = (k % 4 ? 0 : 1) + H[k];
  return E[0] + E[4] + E[8];
}

static void MaterialCurvature_SaintVenant(PetscReal pressure, const PetscReal H[9], PetscReal A[81])
{
  (void)H;
  for (int k = 0; k < 9; ++k) A[10 * k] += pressure;
}

const MaterialLaw MaterialLawSaintVenant = {
  .constant   = PETSC_FALSE,
  .energy     = MaterialEnergy_SaintVenant,
  .stress     = MaterialStress_SaintVenant,
  .tangent    = MaterialTangent_SaintVenant,
  .cauchy     = MaterialCauchy_SaintVenant,
  .dilatation = MaterialDilatation_SaintVenant,
  .curvature  = MaterialCurvature_SaintVenant,
  .finite     = PETSC_TRUE,
  .constants  = MaterialConstantsFinite,
  .moduli     = MaterialModuliIsotropic,
};
