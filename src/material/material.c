/* Parameters of materials, and the table of laws */
#include "materialimpl.h"

#define MATERIAL_NAME(name, law, text) text,
const char *const MaterialTypes[] = {MATERIAL_LAWS(MATERIAL_NAME) "MaterialType", "MATERIAL_", NULL};

#define MATERIAL_ENTRY(name, law, text) &MaterialLaw##law,
static const MaterialLaw *const laws[] = {MATERIAL_LAWS(MATERIAL_ENTRY)};

/*
   Gets the moduli of a material's law. moduli: the moduli [force/length^2]; isochoric: moduli of the law without its
   volumetric energy kappa/2 theta^2 [force/length^2], or NULL.
*/
PetscErrorCode MaterialGetModuli(const Material *material, MaterialModuli *moduli, MaterialModuli *isochoric)
{
  const MaterialLaw *law;

  PetscFunctionBegin;
  *moduli = (MaterialModuli){0};
  PetscCall(MaterialGetLaw(material, &law));
  PetscCall(law->moduli(material, moduli));
  moduli->lambda = moduli->bulk - 2 * moduli->mu / 3;
  if (!isochoric) PetscFunctionReturn(0);
  *isochoric        = *moduli;
  isochoric->lambda = -2 * moduli->mu / 3;
  isochoric->bulk   = 0;
  for (int i = 0; i < 9; ++i) isochoric->stiffness[6 * (i / 3) + i % 3] -= moduli->bulk;
  PetscFunctionReturn(0);
}

/*
   Sets an equivalent Young's modulus of a material whose law has other constants, as a measure of its stiffness.
   material: the material; unchanged if its law has a Young's modulus.
*/
PetscErrorCode MaterialSetScale(Material *material)
{
  const MaterialLaw *law;

  PetscFunctionBegin;
  PetscCall(MaterialGetLaw(material, &law));
  if (law->scale) law->scale(material);
  PetscFunctionReturn(0);
}

/*
   Gets the linear thermal expansion of a material in global axes. A: symmetric tensor of expansion, strain per
   temperature [1/temperature].
*/
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
  return laws[material->type]->finite;
}

PetscBool MaterialYields(const Material *material)
{
  return (PetscBool)(laws[material->type]->advance != NULL);
}

/*
   Gets the functions that evaluate a material's energy density, stress and tangent at a point. law: the law, owned by
   the library.
*/
PetscErrorCode MaterialGetLaw(const Material *material, const MaterialLaw **law)
{
  PetscFunctionBegin;
  PetscCheck(material->type >= 0 && (size_t)material->type < PETSC_STATIC_ARRAY_LENGTH(laws), PETSC_COMM_SELF,
    PETSC_ERR_ARG_OUTOFRANGE, "Unknown material type %d", (int)material->type);
  *law = laws[material->type];
  PetscFunctionReturn(0);
}
