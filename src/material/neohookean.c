/*
   Compressible neo-Hookean: W = mu/2 (J^(-2/3) I1 - 3) + kappa/2 (J - 1)^2, I1 = tr(F^T F), kappa = lambda + 2 mu/3. W
   is computed from quantities that vanish without deformation (H, theta = J - 1, I1 - 3), so that small strains are
   accurate.
*/
#include "materialimpl.h"
#include <lanes.h>

/* Quantities at as many points as there are lanes */
typedef struct {
  Lanes D[9];  /* cof F - I, with cof F = J F^(-T) */
  Lanes theta; /* J - 1 */
  Lanes i1;    /* I1 - 3 */
  Lanes power; /* J^(-2/3) */
  Lanes less;  /* J^(-2/3) - 1 */
} Kinematics;

/* Computes D = cof F - I with cof F = I + (tr H) I - H^T + cof H, and theta = tr H + tr cof H + det H */
LANES_INLINE void NeoHookeanCofactor(const Lanes H[9], Lanes D[9], Lanes *theta)
{
  const Lanes trace = H[0] + H[4] + H[8];
  Lanes       cofactor[9];

  for (int i = 0; i < 3; ++i) {
    const int i1 = (i + 1) % 3, i2 = (i + 2) % 3;

    for (int j = 0; j < 3; ++j) {
      const int j1 = (j + 1) % 3, j2 = (j + 2) % 3;

      cofactor[3 * i + j] = H[3 * i1 + j1] * H[3 * i2 + j2] - H[3 * i1 + j2] * H[3 * i2 + j1];
      D[3 * i + j]        = cofactor[3 * i + j] - H[3 * j + i];
    }
    D[4 * i] += trace;
  }
  *theta =
    trace + cofactor[0] + cofactor[4] + cofactor[8] + H[0] * cofactor[0] + H[1] * cofactor[1] + H[2] * cofactor[2];
}

/* Returns true if J > 0 or J is NaN at all points; otherwise power and less are not computed */
LANES_INLINE PetscBool NeoHookeanKinematics(const Lanes H[9], Kinematics *k)
{
  Lanes J, c, square = H[0] * H[0];

  NeoHookeanCofactor(H, k->D, &k->theta);
  for (int i = 1; i < 9; ++i) square += H[i] * H[i];
  k->i1 = 2 * (H[0] + H[4] + H[8]) + square;
  if (LanesReach(&k->theta, -1)) return PETSC_FALSE;
  J = 1 + k->theta;
  LanesCubeRoot(&J, &c);
  k->power = 1 / (c * c);
  k->less  = -k->theta * (c + 1) / (c * c + c + 1) * k->power; /* uses 1 - c^2 = -(c^3 - 1) (c + 1)/(c^2 + c + 1) */
  return PETSC_TRUE;
}

/*
   Computes J^(-2/3) I1 - 3, which is of second order in the strain. Let C = I1/3 (I + D) with tr D = 0. Then det(I + D)
   = 1 + q with q = det D - D:D/2, so that J^(-2/3) I1 = 3 (1 + q)^(-1/3). Near q = -1 this loses accuracy; the first
   form, which does not cancel there, is then used.
*/
LANES_INLINE void NeoHookeanIsochoric(const Lanes H[9], const Kinematics *k, Lanes *value)
{
  const Lanes scale = 1 / (1 + k->i1 / 3);
  Lanes       D[9], q, more, r;

  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j)
      D[3 * i + j] = scale * (H[3 * i + j] + H[3 * j + i] + H[i] * H[j] + H[3 + i] * H[3 + j] + H[6 + i] * H[6 + j]);
    D[4 * i] -= scale * k->i1 / 3;
  }
  q = D[0] * (D[4] * D[8] - D[5] * D[7]) - D[1] * (D[3] * D[8] - D[5] * D[6]) + D[2] * (D[3] * D[7] - D[4] * D[6]);
  for (int i = 0; i < 9; ++i) q -= 0.5 * D[i] * D[i];
  more = 1 + q;
  LanesCubeRoot(&more, &r);
  *value = -3 * q / (r * (r * r + r + 1));
  for (int l = 0; l < LANES; ++l) {
    if (LANE(q, l) < -0.5) LANE(*value, l) = LANE(k->i1, l) * LANE(k->power, l) + 3 * LANE(k->less, l);
  }
}

AMGF_CLONES static PetscBool NeoHookeanEnergies(const MaterialModuli *m, const Lanes H[9], Lanes *W)
{
  Kinematics k;
  Lanes      isochoric;

  if (!NeoHookeanKinematics(H, &k)) return PETSC_FALSE;
  NeoHookeanIsochoric(H, &k, &isochoric);
  *W = 0.5 * m->mu * isochoric + 0.5 * m->bulk * k.theta * k.theta;
  return PETSC_TRUE;
}

/*
   Computes P = mu J^(-2/3) (F - I1/3 F^(-T)) + kappa (J - 1) cof F, where J (F - I1/3 F^(-T)) = J H + (J - 1) I - D -
   (I1 - 3)/3 cof F
*/
AMGF_CLONES static PetscBool NeoHookeanStresses(const MaterialModuli *m, const Lanes H[9], Lanes P[9])
{
  Kinematics k;
  Lanes      shear, over, g;

  if (!NeoHookeanKinematics(H, &k)) return PETSC_FALSE;
  shear = m->mu * k.power;
  over  = shear / (1 + k.theta);
  g     = m->bulk * k.theta - over * k.i1 / 3;
  for (int i = 0; i < 9; ++i) P[i] = shear * H[i] + (g - over) * k.D[i];
  for (int i = 0; i < 9; i += 4) P[i] += over * k.theta + g;
  return PETSC_TRUE;
}

/* Computes the tangent, with G = F^(-T), from dJ = J G:dF, dI1 = 2 F:dF and dG_iJ = -G_iL G_kJ dF_kL */
AMGF_CLONES static PetscBool NeoHookeanTangents(const MaterialModuli *m, const Lanes H[9], Lanes A[81])
{
  Kinematics k;
  Lanes      F[9], G[9], J, unit, dyad, mixed, crossed;

  if (!NeoHookeanKinematics(H, &k)) return PETSC_FALSE;
  J       = 1 + k.theta;
  unit    = m->mu * k.power;
  mixed   = -2. / 3. * unit;
  dyad    = 2. / 9. * unit * (3 + k.i1) + m->bulk * (2 * J - 1) * J;
  crossed = unit * (3 + k.i1) / 3 - m->bulk * k.theta * J;
  for (int i = 0; i < 9; ++i) {
    F[i] = H[i] + (i % 4 ? 0 : 1);
    G[i] = (k.D[i] + (i % 4 ? 0 : 1)) / J;
  }
  for (int p = 0; p < 9; ++p) {
    const Lanes withF = mixed * G[p], withG = mixed * F[p] + dyad * G[p];

    for (int q = p; q < 9; ++q)
      A[9 * p + q] = A[9 * q + p] = withF * F[q] + withG * G[q] + crossed * G[p / 3 * 3 + q % 3] * G[q / 3 * 3 + p % 3];
    A[10 * p] += unit;
  }
  return PETSC_TRUE;
}

/* Sets all lanes to the same point */
static void NeoHookeanSpread(const PetscReal H[9], Lanes h[9])
{
  for (int i = 0; i < 9; ++i) h[i] = (Lanes){0} + H[i];
}

static PetscReal MaterialEnergy_NeoHookean(const MaterialModuli *m, const PetscReal H[9])
{
  Lanes h[9], W;

  NeoHookeanSpread(H, h);
  return NeoHookeanEnergies(m, h, &W) ? LANE(W, 0) : PETSC_INFINITY;
}

/* Computes n values at one point by the function of all lanes */
LANES_INLINE PetscBool NeoHookeanAtOne(PetscBool (*all)(const MaterialModuli *, const Lanes[9], Lanes[]), int n,
  const MaterialModuli *m, const PetscReal H[9], PetscReal values[])
{
  Lanes h[9], v[81];

  NeoHookeanSpread(H, h);
  if (!all(m, h, v)) return PETSC_FALSE;
  for (int i = 0; i < n; ++i) values[i] = LANE(v[i], 0);
  return PETSC_TRUE;
}

static PetscBool MaterialStress_NeoHookean(const MaterialModuli *m, const PetscReal H[9], PetscReal P[9])
{
  return NeoHookeanAtOne(NeoHookeanStresses, 9, m, H, P);
}

static PetscBool MaterialTangent_NeoHookean(const MaterialModuli *m, const PetscReal H[9], PetscReal A[81])
{
  return NeoHookeanAtOne(NeoHookeanTangents, 81, m, H, A);
}

/* Computes the dilatation theta = J - 1 and its derivative C */
AMGF_CLONES void MaterialDilatations_NeoHookean(const Lanes H[9], Lanes C[9], Lanes *theta)
{
  NeoHookeanCofactor(H, C, theta);
  for (int i = 0; i < 9; i += 4) C[i] += 1;
}

PetscReal MaterialDilatation_NeoHookean(const PetscReal H[9], PetscReal C[9])
{
  Lanes h[9], D[9], theta;

  NeoHookeanSpread(H, h);
  MaterialDilatations_NeoHookean(h, D, &theta);
  for (int i = 0; i < 9; ++i) C[i] = LANE(D[i], 0);
  return LANE(theta, 0);
}

/* Computes sigma = P F^T / J */
static PetscBool MaterialCauchy_NeoHookean(const MaterialModuli *m, const PetscReal H[9], PetscReal sigma[6])
{
  static const int row[6] = {0, 1, 2, 0, 1, 2}, column[6] = {0, 1, 2, 1, 2, 0};
  PetscReal        P[9], C[9], J;

  if (!MaterialStress_NeoHookean(m, H, P)) return PETSC_FALSE;
  J = 1 + MaterialDilatation_NeoHookean(H, C);
  for (int s = 0; s < 6; ++s) {
    const PetscReal *p = P + 3 * row[s], *h = H + 3 * column[s];

    sigma[s] = (p[column[s]] + p[0] * h[0] + p[1] * h[1] + p[2] * h[2]) / J;
  }
  return PETSC_TRUE;
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
  .constant    = PETSC_FALSE,
  .energy      = MaterialEnergy_NeoHookean,
  .stress      = MaterialStress_NeoHookean,
  .tangent     = MaterialTangent_NeoHookean,
  .energies    = NeoHookeanEnergies,
  .stresses    = NeoHookeanStresses,
  .tangents    = NeoHookeanTangents,
  .cauchy      = MaterialCauchy_NeoHookean,
  .dilatation  = MaterialDilatation_NeoHookean,
  .dilatations = MaterialDilatations_NeoHookean,
  .curvature   = MaterialCurvature_NeoHookean,
  .finite      = PETSC_TRUE,
  .constants   = MaterialConstantsFinite,
  .moduli      = MaterialModuliIsotropic,
};
