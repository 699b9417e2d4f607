/*
   Compressible neo-Hookean: W = mu/2 (J^(-2/3) I1 - 3) + kappa/2 (J - 1)^2, I1 = tr(F^T F), kappa = lambda + 2 mu/3. W
   is computed from quantities that vanish without deformation (H, theta = J - 1, I1 - 3), so that small strains are
   accurate.
*/
#include "materialimpl.h"

typedef struct {
  PetscReal D[9];  /* cof F - I, with cof F = J F^(-T) */
  PetscReal theta; /* J - 1 */
  PetscReal i1;    /* I1 - 3 */
  PetscReal power; /* J^(-2/3); set only if J > 0 */
  PetscReal less;  /* J^(-2/3) - 1; set only if J > 0 */
} Kinematics;

/*
   Computes cof F = I + (tr H) I - H^T + cof H and J = 1 + tr H + tr cof H + det H. Returns true if J > 0 or J is NaN.
*/
static inline PetscBool NeoHookeanKinematics(const PetscReal H[9], Kinematics *k)
{
  const PetscReal trace = H[0] + H[4] + H[8];
  PetscReal       cofactor[9], c, square = 0;

  for (int i = 0; i < 3; ++i) {
    const int i1 = (i + 1) % 3, i2 = (i + 2) % 3;

    for (int j = 0; j < 3; ++j) {
      const int j1 = (j + 1) % 3, j2 = (j + 2) % 3;

      cofactor[3 * i + j] = H[3 * i1 + j1] * H[3 * i2 + j2] - H[3 * i1 + j2] * H[3 * i2 + j1];
      k->D[3 * i + j]     = cofactor[3 * i + j] - H[3 * j + i] + (i == j ? trace : 0);
    }
  }
  for (int i = 0; i < 9; ++i) square += H[i] * H[i];
  k->theta =
    trace + cofactor[0] + cofactor[4] + cofactor[8] + H[0] * cofactor[0] + H[1] * cofactor[1] + H[2] * cofactor[2];
  k->i1 = 2 * trace + square;
  if (k->theta <= -1) return PETSC_FALSE;
  c        = PetscCbrtReal(1 + k->theta);
  k->power = 1 / (c * c);
  k->less  = -k->theta * (c + 1) / (c * c + c + 1) * k->power; /* uses 1 - c^2 = -(c^3 - 1) (c + 1)/(c^2 + c + 1) */
  return PETSC_TRUE;
}

/*
   Returns J^(-2/3) I1 - 3, which is of second order in the strain. Let C = I1/3 (I + D) with tr D = 0. Then det(I + D)
   = 1 + q with q = det D - D:D/2, so that J^(-2/3) I1 = 3 (1 + q)^(-1/3). Near q = -1 this loses accuracy; the first
   form, which does not cancel there, is then used.
*/
static PetscReal NeoHookeanIsochoric(const PetscReal H[9], const Kinematics *k)
{
  const PetscReal scale = 1 / (1 + k->i1 / 3);
  PetscReal       D[9], q, r;

  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j)
      D[3 * i + j] = scale * (H[3 * i + j] + H[3 * j + i] + H[i] * H[j] + H[3 + i] * H[3 + j] + H[6 + i] * H[6 + j] -
                               (i == j ? k->i1 / 3 : 0));
  }
  q = D[0] * (D[4] * D[8] - D[5] * D[7]) - D[1] * (D[3] * D[8] - D[5] * D[6]) + D[2] * (D[3] * D[7] - D[4] * D[6]);
  for (int i = 0; i < 9; ++i) q -= 0.5 * D[i] * D[i];
  if (q < -0.5) return k->i1 * k->power + 3 * k->less;
  r = PetscCbrtReal(1 + q);
  return -3 * q / (r * (r * r + r + 1));
}

static PetscReal MaterialEnergy_NeoHookean(const MaterialModuli *m, const PetscReal H[9])
{
  Kinematics k;

  if (!NeoHookeanKinematics(H, &k)) return PETSC_INFINITY;
  return 0.5 * m->mu * NeoHookeanIsochoric(H, &k) + 0.5 * m->bulk * k.theta * k.theta;
}

/*
   Computes P = mu J^(-2/3) (F - I1/3 F^(-T)) + kappa (J - 1) cof F, where J (F - I1/3 F^(-T)) = J H + (J - 1) I - D -
   (I1 - 3)/3 cof F
*/
static inline void NeoHookeanStress(const MaterialModuli *m, const PetscReal H[9], const Kinematics *k, PetscReal P[9])
{
  const PetscReal J = 1 + k->theta, shear = m->mu * k->power, g = m->bulk * k->theta - shear * k->i1 / (3 * J);

  for (int i = 0; i < 9; ++i) {
    const PetscReal unit = i % 4 ? 0 : 1;

    P[i] = shear * (H[i] + (k->theta * unit - k->D[i]) / J) + g * (unit + k->D[i]);
  }
}

static PetscBool MaterialStress_NeoHookean(const MaterialModuli *m, const PetscReal H[9], PetscReal P[9])
{
  Kinematics k;

  if (!NeoHookeanKinematics(H, &k)) return PETSC_FALSE;
  NeoHookeanStress(m, H, &k, P);
  return PETSC_TRUE;
}

/* Computes the tangent, with G = F^(-T), from dJ = J G:dF, dI1 = 2 F:dF and dG_iJ = -G_iL G_kJ dF_kL */
static PetscBool MaterialTangent_NeoHookean(const MaterialModuli *m, const PetscReal H[9], PetscReal A[81])
{
  Kinematics k;
  PetscReal  F[9], G[9], J, unit, dyad, mixed, crossed;

  if (!NeoHookeanKinematics(H, &k)) return PETSC_FALSE;
  J       = 1 + k.theta;
  unit    = m->mu * k.power;
  mixed   = -2. / 3. * unit;
  dyad    = 2. / 9. * unit * (3 + k.i1) + m->bulk * (2 * J - 1) * J;
  crossed = unit * (3 + k.i1) / 3 - m->bulk * k.theta * J;
  for (int i = 0; i < 9; ++i) {
    F[i] = (i % 4 ? 0 : 1) + H[i];
    G[i] = ((i % 4 ? 0 : 1) + k.D[i]) / J;
  }
  for (int p = 0; p < 9; ++p) {
    for (int q = p; q < 9; ++q) {
      A[9 * p + q] = mixed * (F[p] * G[q] + G[p] * F[q]) + dyad * G[p] * G[q] +
                     crossed * G[p / 3 * 3 + q % 3] * G[q / 3 * 3 + p % 3];
      A[9 * q + p] = A[9 * p + q];
    }
    A[10 * p] += unit;
  }
  return PETSC_TRUE;
}

/* Computes sigma = P F^T / J */
static PetscBool MaterialCauchy_NeoHookean(const MaterialModuli *m, const PetscReal H[9], PetscReal sigma[6])
{
  static const int row[6] = {0, 1, 2, 0, 1, 2}, column[6] = {0, 1, 2, 1, 2, 0};
  Kinematics       k;
  PetscReal        P[9];

  if (!NeoHookeanKinematics(H, &k)) return PETSC_FALSE;
  NeoHookeanStress(m, H, &k, P);
  for (int s = 0; s < 6; ++s) {
    const PetscReal *p = P + 3 * row[s], *h = H + 3 * column[s];

    sigma[s] = (p[column[s]] + p[0] * h[0] + p[1] * h[1] + p[2] * h[2]) / (1 + k.theta);
  }
  return PETSC_TRUE;
}

/* Returns the dilatation theta = J - 1, and computes its derivative C */
PetscReal MaterialDilatation_NeoHookean(const PetscReal H[9], PetscReal C[9])
{
  Kinematics k;

  (void)NeoHookeanKinematics(H, &k);
  for (int i = 0; i < 9; ++i) C[i] = (i % 4 ? 0 : 1) + k.D[i];
  return k.theta;
}

/*
   Adds pressure x d2J/dF_ij dF_kl to A, where d2J/dF_ij dF_kl = e_ikm e_jln F_mn is zero unless i, k, m and j, l, n are
   permutations
*/
void MaterialCurvature_NeoHookean(PetscReal pressure, const PetscReal H[9], PetscReal A[81])
{
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      for (int di = 1; di < 3; ++di) {
        for (int dj = 1; dj < 3; ++dj) {
          const int k = (i + di) % 3, l = (j + dj) % 3, m = 3 - i - k, n = 3 - j - l;

          A[9 * (3 * i + j) + 3 * k + l] += (di == dj ? pressure : -pressure) * ((m == n) + H[3 * m + n]);
        }
      }
    }
  }
}

const MaterialLaw MaterialLawNeoHookean = {
  .constant   = PETSC_FALSE,
  .isotropic  = PETSC_FALSE,
  .energy     = MaterialEnergy_NeoHookean,
  .stress     = MaterialStress_NeoHookean,
  .tangent    = MaterialTangent_NeoHookean,
  .cauchy     = MaterialCauchy_NeoHookean,
  .dilatation = MaterialDilatation_NeoHookean,
  .curvature  = MaterialCurvature_NeoHookean,
  .finite     = PETSC_TRUE,
  .constants  = MaterialConstantsFinite,
  .moduli     = MaterialModuliIsotropic,
};
