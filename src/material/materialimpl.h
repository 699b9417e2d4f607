/*
   Material, private: the map of src/material.
*/
#ifndef MATERIALIMPL_H
#define MATERIALIMPL_H

#include <material.h>

/* linear.c, neohookean.c, saintvenant.c, mooneyrivlin.c, orthotropic.c, rigid.c: one constitutive law a file;
   material.c lists them */
PETSC_INTERN const MaterialLaw MaterialLawLinear;
PETSC_INTERN const MaterialLaw MaterialLawNeoHookean;
PETSC_INTERN const MaterialLaw MaterialLawSaintVenant;
PETSC_INTERN const MaterialLaw MaterialLawMooneyRivlin;
PETSC_INTERN const MaterialLaw MaterialLawOrthotropic;
PETSC_INTERN const MaterialLaw MaterialLawRigid;

/* orthotropic.c: rows are the material's axes, whether they are three; bulk modulus and stiffness, whether they are
   positive */
PETSC_INTERN PetscBool OrthotropicAxes(const Material *, PetscReal R[3][3]);
PETSC_INTERN PetscBool OrthotropicModuli(const Material *, MaterialModuli *);

#endif
