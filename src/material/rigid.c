/*
   Rigid bodies: all displacements are prescribed; energy and stress are zero. The tangent only provides rows of the
   matrix, of which the diagonal remains; its size is that of the assigned Young's modulus.
*/
#include "materialimpl.h"

static PetscReal MaterialEnergy_Rigid(const MaterialModuli *m, const PetscReal H[9])
{
  (void)m, (void)H;
  return 0;
}

static PetscBool MaterialStress_Rigid(const MaterialModuli *m, const PetscReal H[9], PetscReal P[9])
{
  (void)m, (void)H;
  for (int i = 0; i < 9; ++i) P[i] = 0;
  return PETSC_TRUE;
}

static PetscBool MaterialTangent_Rigid(const MaterialModuli *m, const PetscReal H[9], PetscReal A[81])
{
  (void)H;
  for (int i = 0; i < 81; ++i) A[i] = i % 10 ? 0 : m->mu;
  return PETSC_TRUE;
}

static PetscBool MaterialCauchy_Rigid(const MaterialModuli *m, const PetscReal H[9], PetscReal sigma[6])
{
  (void)m, (void)H;
  for (int i = 0; i < 6; ++i) sigma[i] = 0;
  return PETSC_TRUE;
}

static PetscReal MaterialDilatation_Rigid(const PetscReal H[9], PetscReal C[9])
{
  (void)H;
  for (int i = 0; i < 9; ++i) C[i] = 0;
  return 0;
}

static const MaterialConstant constants[] = {MATERIAL_DENSITY, {NULL}};

const MaterialLaw MaterialLawRigid = {
  .constant   = PETSC_TRUE,
  .energy     = MaterialEnergy_Rigid,
  .stress     = MaterialStress_Rigid,
  .tangent    = MaterialTangent_Rigid,
  .cauchy     = MaterialCauchy_Rigid,
  .dilatation = MaterialDilatation_Rigid,
  .constants  = constants,
  .moduli     = MaterialModuliIsotropic,
};
