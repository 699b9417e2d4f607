/* Private header of material: one law per file; material.c has their table */
#ifndef MATERIALIMPL_H
#define MATERIALIMPL_H

#include <material.h>
#include <stddef.h>

#define MATERIAL_LAW(name, law, text) PETSC_INTERN const MaterialLaw MaterialLaw##law;
MATERIAL_LAWS(MATERIAL_LAW)
#undef MATERIAL_LAW

/* Functions of a law that other laws share: of linear.c, neohookean.c and j2.c */
PETSC_INTERN PetscReal      MaterialDilatation_Linear(const PetscReal H[9], PetscReal C[9]);
PETSC_INTERN PetscReal      MaterialDilatation_NeoHookean(const PetscReal H[9], PetscReal C[9]);
PETSC_INTERN void           MaterialDilatations_NeoHookean(const Lanes H[9], Lanes C[9], Lanes *theta);
PETSC_INTERN void           MaterialCurvature_NeoHookean(PetscReal pressure, const PetscReal H[9], PetscReal A[81]);
PETSC_INTERN PetscReal      MaterialWork_J2(const MaterialModuli *, const PetscReal history[MATERIAL_HISTORY]);
PETSC_INTERN PetscErrorCode MaterialModuli_J2(const Material *, MaterialModuli *);

/*
   isotropic.c: the constants Young's modulus, Poisson's ratio, thermal expansion and density, and the moduli that
   follow from them
*/
#define MATERIAL_YOUNG \
  { \
    "young", 1, offsetof(Material, young), PETSC_TRUE, "Young's modulus", "E", 0, PETSC_INFINITY \
  }
#define MATERIAL_POISSON \
  { \
    "poisson", 1, offsetof(Material, poisson), PETSC_TRUE, "Poisson's ratio", "nu", -1, 0.5 \
  }
#define MATERIAL_DENSITY \
  { \
    "density", 1, offsetof(Material, density), PETSC_FALSE, NULL, "rho", 0, 0 \
  }
PETSC_INTERN const MaterialConstant MaterialConstantsFinite[], MaterialConstantsSmall[];
PETSC_INTERN PetscErrorCode         MaterialModuliIsotropic(const Material *, MaterialModuli *);

/* Rows for a MaterialHardening in the tables of the constants of laws */
#define MATERIAL_HARDENING_NUMBER(name, member) \
  { \
    name, 1, offsetof(Material, hardening.member), PETSC_FALSE, NULL, NULL, 0, 0 \
  }
#define MATERIAL_YIELD MATERIAL_HARDENING_NUMBER("yield", yield)
#define MATERIAL_HARDENING \
  MATERIAL_YIELD, MATERIAL_HARDENING_NUMBER("hardening", modulus), MATERIAL_HARDENING_NUMBER("kinematic", kinematic), \
    MATERIAL_HARDENING_NUMBER("saturation", saturation), MATERIAL_HARDENING_NUMBER("saturation_rate", rate), \
    {"plastic_strains", 0, offsetof(Material, hardening.strains), PETSC_FALSE, NULL, NULL, 0, 0}, \
  { \
    "yield_stresses", 0, offsetof(Material, hardening.stresses), PETSC_FALSE, NULL, NULL, 0, 0 \
  }

/* logarithmic.c: the logarithmic strain E = 1/2 ln C for the displacement gradient H */
typedef struct {
  PetscReal c[3], V[3][3]; /* eigenvalues of C - I; their eigenvectors, in columns */
  PetscReal E[9];
} Logarithmic;
/*
   LogarithmicEigen() computes the eigenvalues c and, in columns, the eigenvectors V of a symmetric matrix.
   LogarithmicCompose() computes the matrix with these eigenvalues and eigenvectors.
*/
PETSC_INTERN void LogarithmicEigen(const PetscReal M[9], PetscReal c[3], PetscReal V[3][3]);
PETSC_INTERN void LogarithmicCompose(const PetscReal c[3], PetscReal V[3][3], PetscReal M[9]);
/* Computes the logarithmic strain. Returns false if F is singular. */
PETSC_INTERN PetscBool LogarithmicStrain(const PetscReal H[9], Logarithmic *);
/*
   LogarithmicStress() computes P = dW/dF of an energy with T = dW/dE. LogarithmicTangent() computes A = dP/dF from T
   and from D = d2W/dE dE, which it overwrites.
*/
PETSC_INTERN void LogarithmicStress(Logarithmic *, const PetscReal H[9], const PetscReal T[9], PetscReal P[9]);
PETSC_INTERN void LogarithmicTangent(Logarithmic *, const PetscReal H[9], const PetscReal T[9], PetscReal D[81],
  PetscReal A[81]);

/* orthotropic.c: computes the material's axes, the rows of R; returns false if the given axes are parallel */
PETSC_INTERN PetscBool OrthotropicAxes(const Material *, PetscReal R[3][3]);

/* Stores the stress xx yy zz xy yz zx as a matrix */
static inline void MaterialStressMatrix(const PetscReal s[6], PetscReal P[9])
{
  P[0] = s[0];
  P[4] = s[1];
  P[8] = s[2];
  P[1] = P[3] = s[3];
  P[5] = P[7] = s[4];
  P[2] = P[6] = s[5];
}

#endif
