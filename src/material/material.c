/* Parameters of materials and the table of laws */
#include "materialimpl.h"

const char *const MaterialTypes[] = {"linear", "neohookean", "saint_venant", "rigid", "MaterialType", "MATERIAL_", NULL};

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

.seealso: `MaterialGetLaw()`
@*/
PetscErrorCode MaterialGetLame(const Material *material, PetscReal *lambda, PetscReal *mu)
{
  const PetscReal E = material->young, nu = material->poisson;

  PetscFunctionBegin;
  PetscCheck(E > 0 && !PetscIsInfOrNanReal(E), PETSC_COMM_SELF, PETSC_ERR_ARG_OUTOFRANGE, "Young's modulus must be positive, but is %g", (double)E);
  PetscCheck(nu > -1 && nu < 0.5, PETSC_COMM_SELF, PETSC_ERR_ARG_OUTOFRANGE, "Poisson's ratio must lie between -1 and 0.5, but is %g", (double)nu);
  *lambda = E * nu / ((1 + nu) * (1 - 2 * nu));
  *mu     = E / (2 * (1 + nu));
  PetscFunctionReturn(0);
}

/*@
  MaterialGetModuli - Gets what a material's law is evaluated with

  Not Collective

  Input Parameter:
. material - the material

  Output Parameters:
+ moduli    - the moduli [force/length^2]
- isochoric - those that leave the law without kappa/2 theta^2, the energy of its dilatation; `NULL` if not wanted [force/length^2]

  Level: developer

.seealso: `MaterialGetLaw()`, `MaterialGetLame()`
@*/
PetscErrorCode MaterialGetModuli(const Material *material, MaterialModuli *moduli, MaterialModuli *isochoric)
{
  PetscFunctionBegin;
  *moduli = (MaterialModuli){0};
  PetscCall(MaterialGetLame(material, &moduli->lambda, &moduli->mu));
  moduli->bulk = moduli->lambda + 2 * moduli->mu / 3;
  if (!isochoric) PetscFunctionReturn(0);
  *isochoric        = *moduli;
  isochoric->lambda = -2 * moduli->mu / 3;
  isochoric->bulk   = 0;
  PetscFunctionReturn(0);
}

PetscBool MaterialIsFinite(const Material *material)
{
  return (PetscBool)(material->type == MATERIAL_NEOHOOKEAN || material->type == MATERIAL_SAINT_VENANT);
}

/*@
  MaterialGetLaw - Gets the functions that evaluate a material's energy density, stress and tangent at a point

  Not Collective

  Input Parameter:
. material - the material

  Output Parameter:
. law - the law, owned by the library

  Level: developer

.seealso: `MaterialGetLame()`
@*/
PetscErrorCode MaterialGetLaw(const Material *material, const MaterialLaw **law)
{
  PetscFunctionBegin;
  switch (material->type) {
  case MATERIAL_LINEAR:
    *law = &MaterialLawLinear;
    break;
  case MATERIAL_NEOHOOKEAN:
    *law = &MaterialLawNeoHookean;
    break;
  case MATERIAL_SAINT_VENANT:
    *law = &MaterialLawSaintVenant;
    break;
  case MATERIAL_RIGID:
    *law = &MaterialLawRigid;
    break;
  default:
    SETERRQ(PETSC_COMM_SELF, PETSC_ERR_ARG_OUTOFRANGE, "Unknown material type %d", (int)material->type);
  }
  PetscFunctionReturn(0);
}
