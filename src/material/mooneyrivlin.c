/*
   Compressible Mooney-Rivlin: W = c10 (J^(-2/3) I1 - 3) + c01 (J^(-4/3) I2 - 3) + kappa/2 (J - 1)^2, I1 = |F|^2, I2 =
   |cof F|^2.
   Since det cof F = J^2, the second term is the function of the first term evaluated at G = cof F instead of F. It is
   the neo-Hookean law without its volumetric energy, whose functions take G - I. Derivatives follow by the chain rule
   with the tensor cross product (A x B)_ij = e_ikm e_jln A_kl B_mn: dG = F x dF, so that P = Q x F and dP = (dQ/dG : (F
   x dF)) x F + Q x dF with Q = dW/dG.
   References: Mooney, A theory of large elastic deformation, 1940. Rivlin, Large elastic deformations of isotropic
   materials IV, 1948. Bonet, Gil and Ortigosa, On a tensor cross product based formulation of large strain solid
   mechanics, 2016.
*/
#include "materialimpl.h"

/* Gets the moduli of the two neo-Hookean laws, that of F and that of cof F */
static void MooneyRivlinSplit(const MaterialModuli *m, MaterialModuli *first, MaterialModuli *second)
{
  *first  = (MaterialModuli){.mu = m->mu * (1 - m->c01_fraction), .bulk = m->bulk};
  *second = (MaterialModuli){.mu = m->mu * m->c01_fraction};
}

/* Computes the tensor cross product C = A x B */
static void MooneyRivlinCross(const PetscReal A[9], const PetscReal B[9], PetscReal C[9])
{
  for (int i = 0; i < 3; ++i) {
    const int k = (i + 1) % 3, m = (i + 2) % 3;

    for (int j = 0; j < 3; ++j) {
      const int l = (j + 1) % 3, n = (j + 2) % 3;

      C[3 * i + j] = A[3 * k + l] * B[3 * m + n] - A[3 * k + n] * B[3 * m + l] - A[3 * m + l] * B[3 * k + n] +
                     A[3 * m + n] * B[3 * k + l];
    }
  }
}

/* Computes D = cof F - I = tr H I - H^T + H x H/2 */
static void MooneyRivlinCofactor(const PetscReal H[9], PetscReal D[9])
{
  const PetscReal trace = H[0] + H[4] + H[8];

  MooneyRivlinCross(H, H, D);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) D[3 * i + j] = 0.5 * D[3 * i + j] - H[3 * j + i] + (i == j ? trace : 0);
  }
}

static PetscReal MaterialEnergy_MooneyRivlin(const MaterialModuli *m, const PetscReal H[9])
{
  MaterialModuli first, second;
  PetscReal      D[9], energy;

  MooneyRivlinSplit(m, &first, &second);
  energy = MaterialLawNeoHookean.energy(&first, H);
  if (energy >= PETSC_INFINITY) return PETSC_INFINITY;
  MooneyRivlinCofactor(H, D);
  return energy + MaterialLawNeoHookean.energy(&second, D);
}

/* Computes F = I + H, D = cof F - I and Q = dW/dG */
static PetscBool MooneyRivlinDual(const MaterialModuli *second, const PetscReal H[9], PetscReal F[9], PetscReal D[9],
  PetscReal Q[9])
{
  for (int i = 0; i < 9; ++i) F[i] = (i % 4 ? 0 : 1) + H[i];
  MooneyRivlinCofactor(H, D);
  return MaterialLawNeoHookean.stress(second, D, Q);
}

static PetscBool MaterialStress_MooneyRivlin(const MaterialModuli *m, const PetscReal H[9], PetscReal P[9])
{
  MaterialModuli first, second;
  PetscReal      F[9], D[9], Q[9], C[9];

  MooneyRivlinSplit(m, &first, &second);
  if (!MaterialLawNeoHookean.stress(&first, H, P) || !MooneyRivlinDual(&second, H, F, D, Q)) return PETSC_FALSE;
  MooneyRivlinCross(Q, F, C);
  for (int i = 0; i < 9; ++i) P[i] += C[i];
  return PETSC_TRUE;
}

/* Computes the tangent column by column, for dF = e_k (x) e_l */
static PetscBool MaterialTangent_MooneyRivlin(const MaterialModuli *m, const PetscReal H[9], PetscReal A[81])
{
  MaterialModuli first, second;
  PetscReal      F[9], D[9], Q[9], B[81];

  MooneyRivlinSplit(m, &first, &second);
  if (!MaterialLawNeoHookean.tangent(&first, H, A) || !MooneyRivlinDual(&second, H, F, D, Q)) return PETSC_FALSE;
  (void)MaterialLawNeoHookean.tangent(&second, D, B);
  for (int q = 0; q < 9; ++q) {
    PetscReal dF[9] = {0}, dG[9], dQ[9] = {0}, moved[9], turned[9];

    dF[q] = 1;
    MooneyRivlinCross(F, dF, dG);
    for (int p = 0; p < 9; ++p) {
      for (int r = 0; r < 9; ++r) dQ[p] += B[9 * p + r] * dG[r];
    }
    MooneyRivlinCross(dQ, F, moved);
    MooneyRivlinCross(Q, dF, turned);
    for (int p = 0; p < 9; ++p) A[9 * p + q] += moved[p] + turned[p];
  }
  return PETSC_TRUE;
}

/* Computes sigma = P F^T / J */
static PetscBool MaterialCauchy_MooneyRivlin(const MaterialModuli *m, const PetscReal H[9], PetscReal sigma[6])
{
  static const int row[6] = {0, 1, 2, 0, 1, 2}, column[6] = {0, 1, 2, 1, 2, 0};
  PetscReal        P[9], C[9], J;

  if (!MaterialStress_MooneyRivlin(m, H, P)) return PETSC_FALSE;
  J = 1 + MaterialLawNeoHookean.dilatation(H, C);
  for (int s = 0; s < 6; ++s) {
    const PetscReal *p = P + 3 * row[s], *h = H + 3 * column[s];

    sigma[s] = (p[column[s]] + p[0] * h[0] + p[1] * h[1] + p[2] * h[2]) / J;
  }
  return PETSC_TRUE;
}

static PetscErrorCode MaterialModuli_MooneyRivlin(const Material *material, MaterialModuli *moduli)
{
  PetscFunctionBegin;
  PetscCheck(material->c10 >= 0 && material->c01 >= 0 && material->c10 + material->c01 > 0 && material->bulk > 0,
    PETSC_COMM_SELF, PETSC_ERR_ARG_OUTOFRANGE,
    "c10 and c01 must not be negative, nor both zero, and the bulk modulus positive, but they are %g, %g and %g",
    (double)material->c10, (double)material->c01, (double)material->bulk);
  moduli->mu           = 2 * (material->c10 + material->c01);
  moduli->c01_fraction = material->c01 / (material->c10 + material->c01);
  moduli->bulk         = material->bulk;
  PetscFunctionReturn(0);
}

static void MaterialScale_MooneyRivlin(Material *material)
{
  const PetscReal mu = 2 * (material->c10 + material->c01);

  material->young = 9 * material->bulk * mu / (3 * material->bulk + mu);
}

static const MaterialConstant constants[] = {
  {"c10", 1, offsetof(Material, c10), PETSC_TRUE, NULL, NULL, 0, 0},
  {"c01", 1, offsetof(Material, c01), PETSC_TRUE, NULL, NULL, 0, 0},
  {"bulk", 1, offsetof(Material, bulk), PETSC_TRUE, "a bulk modulus", NULL, 0, PETSC_INFINITY},
  MATERIAL_DENSITY,
  {NULL},
};

const MaterialLaw MaterialLawMooneyRivlin = {
  .constant    = PETSC_FALSE,
  .energy      = MaterialEnergy_MooneyRivlin,
  .stress      = MaterialStress_MooneyRivlin,
  .tangent     = MaterialTangent_MooneyRivlin,
  .cauchy      = MaterialCauchy_MooneyRivlin,
  .dilatation  = MaterialDilatation_NeoHookean,
  .dilatations = MaterialDilatations_NeoHookean,
  .curvature   = MaterialCurvature_NeoHookean,
  .finite      = PETSC_TRUE,
  .constants   = constants,
  .moduli      = MaterialModuli_MooneyRivlin,
  .scale       = MaterialScale_MooneyRivlin,
};
