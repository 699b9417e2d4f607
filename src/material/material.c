/* Parameters of materials and the table of laws */
#include "materialimpl.h"

const char *const MaterialTypes[] = {"linear", "neohookean", "saint_venant", "mooney_rivlin", "orthotropic", "rigid",
  "MaterialType", "MATERIAL_", NULL};

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
  PetscCheck(E > 0 && !PetscIsInfOrNanReal(E), PETSC_COMM_SELF, PETSC_ERR_ARG_OUTOFRANGE,
    "Young's modulus must be positive, but is %g", (double)E);
  PetscCheck(nu > -1 && nu < 0.5, PETSC_COMM_SELF, PETSC_ERR_ARG_OUTOFRANGE,
    "Poisson's ratio must lie between -1 and 0.5, but is %g", (double)nu);
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
- isochoric - those that leave the law without kappa/2 theta^2, the energy of its dilatation; `NULL` if not wanted
              [force/length^2]

  Level: developer

.seealso: `MaterialGetLaw()`, `MaterialGetLame()`
@*/
PetscErrorCode MaterialGetModuli(const Material *material, MaterialModuli *moduli, MaterialModuli *isochoric)
{
  PetscFunctionBegin;
  *moduli = (MaterialModuli){0};
  switch (material->type) {
  case MATERIAL_MOONEY_RIVLIN:
    PetscCheck(material->c10 >= 0 && material->c01 >= 0 && material->c10 + material->c01 > 0 && material->bulk > 0,
      PETSC_COMM_SELF, PETSC_ERR_ARG_OUTOFRANGE,
      "c10 and c01 must not be negative, nor both zero, and the bulk modulus positive, but they are %g, %g and %g",
      (double)material->c10, (double)material->c01, (double)material->bulk);
    moduli->mu    = 2 * (material->c10 + material->c01);
    moduli->share = material->c01 / (material->c10 + material->c01);
    moduli->bulk  = material->bulk;
    break;
  case MATERIAL_ORTHOTROPIC:
    PetscCheck(OrthotropicModuli(material, moduli), PETSC_COMM_SELF, PETSC_ERR_ARG_OUTOFRANGE,
      "No orthotropic material has these constants, or its two axes are parallel");
    break;
  default:
    PetscCall(MaterialGetLame(material, &moduli->lambda, &moduli->mu));
    moduli->bulk = moduli->lambda + 2 * moduli->mu / 3;
  }
  moduli->lambda = moduli->bulk - 2 * moduli->mu / 3;
  if (!isochoric) PetscFunctionReturn(0);
  *isochoric        = *moduli;
  isochoric->lambda = -2 * moduli->mu / 3;
  isochoric->bulk   = 0;
  for (int i = 0; i < 9; ++i) isochoric->stiffness[6 * (i / 3) + i % 3] -= moduli->bulk;
  PetscFunctionReturn(0);
}

/*@
  MaterialSetScale - Sets Young's modulus of a material whose law has other constants, for what asks only how stiff it
  is

  Not Collective

  Input Parameter:
. material - the material; one whose law has a Young's modulus stays as it is

  Level: developer

.seealso: `MaterialGetModuli()`
@*/
PetscErrorCode MaterialSetScale(Material *material)
{
  const PetscReal mu = 2 * (material->c10 + material->c01);

  PetscFunctionBegin;
  if (material->type == MATERIAL_MOONEY_RIVLIN) material->young = 9 * material->bulk * mu / (3 * material->bulk + mu);
  if (material->type == MATERIAL_ORTHOTROPIC)
    material->young = PetscMax(PetscMax(material->youngs[0], material->youngs[1]), material->youngs[2]);
  PetscFunctionReturn(0);
}

/*@
  MaterialGetExpansion - Gets the linear thermal expansion of a material along the axes of space

  Not Collective

  Input Parameter:
. material - the material

  Output Parameter:
. A - the tensor of expansion, symmetric: strain over temperature [1/temperature]

  Level: developer

.seealso: `ElasticitySetTemperature()`
@*/
PetscErrorCode MaterialGetExpansion(const Material *material, PetscReal A[9])
{
  PetscReal R[3][3];

  PetscFunctionBegin;
  for (int i = 0; i < 9; ++i) A[i] = i % 4 ? 0 : material->expansion[0];
  if (material->type != MATERIAL_ORTHOTROPIC) PetscFunctionReturn(0);
  PetscCheck(OrthotropicAxes(material, R), PETSC_COMM_SELF, PETSC_ERR_ARG_OUTOFRANGE,
    "The two axes of an orthotropic material are parallel");
  for (int i = 0; i < 9; ++i) {
    A[i] = 0;
    for (int a = 0; a < 3; ++a) A[i] += R[a][i / 3] * R[a][i % 3] * material->expansion[a];
  }
  PetscFunctionReturn(0);
}

PetscBool MaterialIsFinite(const Material *material)
{
  return (PetscBool)(material->type == MATERIAL_NEOHOOKEAN || material->type == MATERIAL_SAINT_VENANT ||
                     material->type == MATERIAL_MOONEY_RIVLIN);
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
  case MATERIAL_LINEAR: *law = &MaterialLawLinear; break;
  case MATERIAL_NEOHOOKEAN: *law = &MaterialLawNeoHookean; break;
  case MATERIAL_SAINT_VENANT: *law = &MaterialLawSaintVenant; break;
  case MATERIAL_MOONEY_RIVLIN: *law = &MaterialLawMooneyRivlin; break;
  case MATERIAL_ORTHOTROPIC: *law = &MaterialLawOrthotropic; break;
  case MATERIAL_RIGID: *law = &MaterialLawRigid; break;
  default: SETERRQ(PETSC_COMM_SELF, PETSC_ERR_ARG_OUTOFRANGE, "Unknown material type %d", (int)material->type);
  }
  PetscFunctionReturn(0);
}
