/*
   Material, private: the map of src/material.
*/
#ifndef MATERIALIMPL_H
#define MATERIALIMPL_H

#include <material.h>

/* linear.c, neohookean.c, saintvenant.c: one constitutive law a file; material.c lists them */
PETSC_INTERN const MaterialLaw MaterialLawLinear;
PETSC_INTERN const MaterialLaw MaterialLawNeoHookean;
PETSC_INTERN const MaterialLaw MaterialLawSaintVenant;
PETSC_INTERN const MaterialLaw MaterialLawRigid;

#endif
