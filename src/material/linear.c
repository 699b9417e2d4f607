/* Isotropic linear elasticity: W = lambda/2 (tr e)^2 + mu e:e, e = (H + H^T)/2 */
#include "materialimpl.h"

static PetscReal MaterialEnergy_Linear(const MaterialModuli *m, const PetscReal H[9])
{
  const PetscReal trace = H[0] + H[4] + H[8];
  const PetscReal xy = H[1] + H[3], yz = H[5] + H[7], zx = H[2] + H[6];

  return 0.5 * m->lambda * trace * trace +
         m->mu * (H[0] * H[0] + H[4] * H[4] + H[8] * H[8] + 0.5 * (xy * xy + yz * yz + zx * zx));
}

static PetscBool MaterialCauchy_Linear(const MaterialModuli *m, const PetscReal H[9], PetscReal sigma[6])
{
  const PetscReal pressure = m->lambda * (H[0] + H[4] + H[8]);

  sigma[0] = pressure + 2 * m->mu * H[0];
  sigma[1] = pressure + 2 * m->mu * H[4];
  sigma[2] = pressure + 2 * m->mu * H[8];
  sigma[3] = m->mu * (H[1] + H[3]);
  sigma[4] = m->mu * (H[5] + H[7]);
  sigma[5] = m->mu * (H[2] + H[6]);
  return PETSC_TRUE;
}

static PetscBool MaterialStress_Linear(const MaterialModuli *m, const PetscReal H[9], PetscReal P[9])
{
  PetscReal s[6];

  MaterialCauchy_Linear(m, H, s);
  MaterialStressMatrix(s, P);
  return PETSC_TRUE;
}

static PetscBool MaterialTangent_Linear(const MaterialModuli *m, const PetscReal H[9], PetscReal A[81])
{
  (void)H;
  for (int i = 0; i < 81; ++i) A[i] = 0;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      A[9 * (3 * i + i) + 3 * j + j] += m->lambda;
      A[9 * (3 * i + j) + 3 * i + j] += m->mu;
      A[9 * (3 * i + j) + 3 * j + i] += m->mu;
    }
  }
  return PETSC_TRUE;
}

/* Returns the dilatation theta = tr e, and computes its derivative C */
PetscReal MaterialDilatation_Linear(const PetscReal H[9], PetscReal C[9])
{
  for (int i = 0; i < 9; ++i) C[i] = i % 4 ? 0 : 1;
  return H[0] + H[4] + H[8];
}

const MaterialLaw MaterialLawLinear = {
  .constant   = PETSC_TRUE,
  .energy     = MaterialEnergy_Linear,
  .stress     = MaterialStress_Linear,
  .tangent    = MaterialTangent_Linear,
  .cauchy     = MaterialCauchy_Linear,
  .dilatation = MaterialDilatation_Linear,
  .constants  = MaterialConstantsSmall,
  .moduli     = MaterialModuliIsotropic,
};
