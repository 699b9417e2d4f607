/*
   Private header of material: one law per file; material.c has their table.
*/
#ifndef MATERIALIMPL_H
#define MATERIALIMPL_H

#include <material.h>
#include <stddef.h>

#define MATERIAL_LAW(name, law, text) PETSC_INTERN const MaterialLaw MaterialLaw##law;
MATERIAL_LAWS(MATERIAL_LAW)
#undef MATERIAL_LAW

/* isotropic.c: constants Young's modulus, Poisson's ratio and thermal expansion; moduli from these */
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

/* orthotropic.c: rows of R are the material's axes; false if they are not independent */
PETSC_INTERN PetscBool OrthotropicAxes(const Material *, PetscReal R[3][3]);

#endif
