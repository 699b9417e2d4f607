/* One constitutive law a file; material.c lists them */
#ifndef MATERIAL_LAWS_H
#define MATERIAL_LAWS_H

#include <material.h>

PETSC_INTERN const MaterialLaw MaterialLawLinear;
PETSC_INTERN const MaterialLaw MaterialLawNeoHookean;

#endif
