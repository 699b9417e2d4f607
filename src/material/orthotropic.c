/*
   Orthotropic linear elasticity: W = e:C:e/2 with three planes of symmetry, whose normals are the material's axes. The
   moduli contain C for the strains xx yy zz 2xy 2yz 2zx in global axes. The volumetric part kappa/2 (tr e)^2 is the
   largest for which the rest of the energy is not negative: kappa = 1/(1:S:1) with S = C^(-1), Reuss's bulk modulus.
*/
#include "materialimpl.h"
#include <vector3.h>

static const int pair[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}};

static PetscBool MaterialCauchy_Orthotropic(const MaterialModuli *m, const PetscReal H[9], PetscReal sigma[6])
{
  const PetscReal strain[6] = {H[0], H[4], H[8], H[1] + H[3], H[5] + H[7], H[6] + H[2]};

  for (int s = 0; s < 6; ++s) {
    sigma[s] = 0;
    for (int t = 0; t < 6; ++t) sigma[s] += m->stiffness[6 * s + t] * strain[t];
  }
  return PETSC_TRUE;
}

static PetscReal MaterialEnergy_Orthotropic(const MaterialModuli *m, const PetscReal H[9])
{
  PetscReal s[6];

  (void)MaterialCauchy_Orthotropic(m, H, s);
  return 0.5 *
         (s[0] * H[0] + s[1] * H[4] + s[2] * H[8] + s[3] * (H[1] + H[3]) + s[4] * (H[5] + H[7]) + s[5] * (H[6] + H[2]));
}

static PetscBool MaterialStress_Orthotropic(const MaterialModuli *m, const PetscReal H[9], PetscReal P[9])
{
  PetscReal s[6];

  (void)MaterialCauchy_Orthotropic(m, H, s);
  for (int t = 0; t < 6; ++t) P[3 * pair[t][0] + pair[t][1]] = P[3 * pair[t][1] + pair[t][0]] = s[t];
  return PETSC_TRUE;
}

static PetscBool MaterialTangent_Orthotropic(const MaterialModuli *m, const PetscReal H[9], PetscReal A[81])
{
  (void)H;
  for (int s = 0; s < 6; ++s) {
    const int ij = 3 * pair[s][0] + pair[s][1], ji = 3 * pair[s][1] + pair[s][0];

    for (int t = 0; t < 6; ++t) {
      const int kl = 3 * pair[t][0] + pair[t][1], lk = 3 * pair[t][1] + pair[t][0];

      A[9 * ij + kl] = A[9 * ij + lk] = A[9 * ji + kl] = A[9 * ji + lk] = m->stiffness[6 * s + t];
    }
  }
  return PETSC_TRUE;
}

/* Computes the material's axes, the rows of R. Returns false if the given axes are parallel. */
PetscBool OrthotropicAxes(const Material *material, PetscReal R[3][3])
{
  static const PetscReal space[2][3] = {{1, 0, 0}, {0, 1, 0}};
  const PetscReal       *given[2];

  for (int k = 0; k < 2; ++k) {
    const PetscReal *a = material->axes[k];

    given[k] = a[0] != 0 || a[1] != 0 || a[2] != 0 ? a : space[k];
  }
  for (int i = 0; i < 3; ++i) R[0][i] = given[0][i];
  VectorCross(given[0], given[1], R[2]);
  for (int k = 0; k < 3; k += 2) {
    const PetscReal length = VectorScaleToUnit(R[k]);

    if (!(length > 0) || PetscIsInfOrNanReal(length)) return PETSC_FALSE;
  }
  VectorCross(R[2], R[0], R[1]);
  return PETSC_TRUE;
}

/*
   Computes C, the inverse of the compliance of normal strains along the material's axes, and `sum`, the sum of all
   entries of that compliance. Returns false if C is not positive definite.
*/
static PetscBool OrthotropicInvert(const Material *material, PetscReal C[3][3], PetscReal *sum)
{
  const PetscReal *E = material->youngs, *nu = material->poissons;
  PetscReal        S[3][3] = {{1 / E[0], -nu[0] / E[0], -nu[2] / E[0]}, {-nu[0] / E[0], 1 / E[1], -nu[1] / E[1]},
           {-nu[2] / E[0], -nu[1] / E[1], 1 / E[2]}};
  PetscReal        det;

  *sum = 0;
  for (int i = 0; i < 9; ++i) *sum += S[i / 3][i % 3];
  det = MatrixInvert(S, C);
  return (PetscBool)(E[0] > 0 && E[1] > 0 && E[2] > 0 && S[0][0] * S[1][1] > S[0][1] * S[0][1] && det > 0);
}

/*
   Returns the entry T_sp of the rotation of stresses: sigma_s (global axes) = sum_p T_sp sigma_p (material axes), from
   sigma_ij = R_ai R_bj sigma_ab. Strains are rotated by the transpose.
*/
static PetscReal OrthotropicTurn(PetscReal R[3][3], int s, int p)
{
  const int i = pair[s][0], j = pair[s][1], a = pair[p][0], b = pair[p][1];

  return a == b ? R[a][i] * R[a][j] : R[a][i] * R[b][j] + R[b][i] * R[a][j];
}

/*
   Computes C in global axes, C_ijkl = R_ai R_bj R_ck R_dl C_abcd, and kappa = 1/(1:S:1). Returns false if the constants
   do not define a material.
*/
static PetscBool OrthotropicModuli(const Material *material, MaterialModuli *m)
{
  PetscReal R[3][3], N[3][3], local[6][6] = {{0}}, sum;

  if (!OrthotropicAxes(material, R) || !OrthotropicInvert(material, N, &sum)) return PETSC_FALSE;
  for (int i = 0; i < 3; ++i) {
    if (!(material->shears[i] > 0)) return PETSC_FALSE;
    for (int j = 0; j < 3; ++j) local[i][j] = N[i][j];
    local[3 + i][3 + i] = material->shears[i];
  }
  m->bulk = 1 / sum;
  for (int s = 0; s < 6; ++s) {
    for (int t = 0; t < 6; ++t) {
      PetscReal *C = &m->stiffness[6 * s + t];

      *C = 0;
      for (int p = 0; p < 6; ++p) {
        for (int q = 0; q < 6; ++q) *C += OrthotropicTurn(R, s, p) * local[p][q] * OrthotropicTurn(R, t, q);
      }
    }
  }
  return PETSC_TRUE;
}

static PetscErrorCode MaterialModuli_Orthotropic(const Material *material, MaterialModuli *moduli)
{
  PetscFunctionBegin;
  PetscCheck(OrthotropicModuli(material, moduli), PETSC_COMM_SELF, PETSC_ERR_ARG_OUTOFRANGE,
    "The constants of an orthotropic material give some strain a negative energy, or its two axes are parallel");
  PetscFunctionReturn(0);
}

static void MaterialScale_Orthotropic(Material *material)
{
  material->young = PetscMax(PetscMax(material->youngs[0], material->youngs[1]), material->youngs[2]);
}

static const MaterialConstant constants[] = {
  {"young", 3, offsetof(Material, youngs), PETSC_TRUE, NULL, NULL, 0, 0},
  {"poisson", 3, offsetof(Material, poissons), PETSC_TRUE, NULL, NULL, 0, 0},
  {"shear", 3, offsetof(Material, shears), PETSC_TRUE, NULL, NULL, 0, 0},
  {"first_axis", 3, offsetof(Material, axes[0]), PETSC_FALSE, NULL, NULL, 0, 0},
  {"second_axis", 3, offsetof(Material, axes[1]), PETSC_FALSE, NULL, NULL, 0, 0},
  {"expansion", 3, offsetof(Material, expansion), PETSC_FALSE, NULL, NULL, 0, 0},
  MATERIAL_DENSITY,
  {NULL},
};

const MaterialLaw MaterialLawOrthotropic = {
  .constant   = PETSC_TRUE,
  .energy     = MaterialEnergy_Orthotropic,
  .stress     = MaterialStress_Orthotropic,
  .tangent    = MaterialTangent_Orthotropic,
  .cauchy     = MaterialCauchy_Orthotropic,
  .dilatation = MaterialDilatation_Linear,
  .constants  = constants,
  .moduli     = MaterialModuli_Orthotropic,
  .scale      = MaterialScale_Orthotropic,
};
