/* Constants of isotropic materials: Young's modulus and Poisson's ratio */
#include "materialimpl.h"

const MaterialConstant MaterialConstantsFinite[] = {MATERIAL_YOUNG, MATERIAL_POISSON, MATERIAL_DENSITY, MATERIAL_YIELD,
  {NULL}};
const MaterialConstant MaterialConstantsSmall[]  = {MATERIAL_YOUNG, MATERIAL_POISSON,
   {"expansion", 1, offsetof(Material, expansion), PETSC_FALSE, NULL, NULL, 0, 0}, MATERIAL_DENSITY, MATERIAL_YIELD,
   {NULL}};

/*@
  MaterialGetLame - Gets the Lame parameters of a material, lambda = E nu/((1+nu)(1-2nu)) and mu = E/(2(1+nu))

  Not Collective

  Input Parameter:
. material - the material

  Output Parameters:
+ lambda - first Lame parameter [force/length^2]
- mu     - shear modulus [force/length^2]

  Level: intermediate

  Notes:
  It is an error unless E > 0 and -1 < nu < 1/2, both finite.

.seealso: `ElasticityCreate()`
@*/
PetscErrorCode MaterialGetLame(const Material *material, PetscReal *lambda, PetscReal *mu)
{
  const PetscReal E = material->young, nu = material->poisson;

  PetscFunctionBegin;
  PetscCheck(E > 0 && !PetscIsInfOrNanReal(E), PETSC_COMM_SELF, PETSC_ERR_ARG_OUTOFRANGE,
    "Young's modulus must be positive, but is %g", (double)E);
  PetscCheck(nu > -1 && nu < 0.5, PETSC_COMM_SELF, PETSC_ERR_ARG_OUTOFRANGE,
    "Poisson's ratio must lie between -1 and 0.5, but is %g", (double)nu);
  *lambda = E * nu / ((1 + nu) * (1 - 2 * nu));
  *mu     = E / (2 * (1 + nu));
  PetscFunctionReturn(0);
}

PetscErrorCode MaterialModuliIsotropic(const Material *material, MaterialModuli *moduli)
{
  PetscFunctionBegin;
  PetscCall(MaterialGetLame(material, &moduli->lambda, &moduli->mu));
  moduli->bulk = moduli->lambda + 2 * moduli->mu / 3;
  PetscFunctionReturn(0);
}
