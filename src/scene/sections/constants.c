/* Constants of a material: which ones its law has, read, viewed, described and checked */
#include "sectionsimpl.h"
#include <petscviewer.h>
#include <stddef.h>

typedef struct {
  const char *name;
  PetscInt    n;  /* numbers */
  size_t      at; /* in a Material */
  PetscBool   required;
} MaterialConstant;

#define MATERIAL_CONSTANT(name, n, member, required) \
  { \
    name, n, offsetof(Material, member), required \
  }

static const MaterialConstant isotropic[] = {
  MATERIAL_CONSTANT("young", 1, young, PETSC_TRUE),
  MATERIAL_CONSTANT("poisson", 1, poisson, PETSC_TRUE),
  MATERIAL_CONSTANT("expansion", 1, expansion, PETSC_FALSE),
};
static const MaterialConstant mooney_rivlin[] = {
  MATERIAL_CONSTANT("c10", 1, c10, PETSC_TRUE),
  MATERIAL_CONSTANT("c01", 1, c01, PETSC_TRUE),
  MATERIAL_CONSTANT("bulk", 1, bulk, PETSC_TRUE),
};
static const MaterialConstant orthotropic[] = {
  MATERIAL_CONSTANT("young", 3, youngs, PETSC_TRUE),
  MATERIAL_CONSTANT("poisson", 3, poissons, PETSC_TRUE),
  MATERIAL_CONSTANT("shear", 3, shears, PETSC_TRUE),
  MATERIAL_CONSTANT("first_axis", 3, axes[0], PETSC_FALSE),
  MATERIAL_CONSTANT("second_axis", 3, axes[1], PETSC_FALSE),
  MATERIAL_CONSTANT("expansion", 3, expansion, PETSC_FALSE),
};

/* Those of a law; small strain alone has an expansion */
static PetscInt MaterialConstants(MaterialType type, const MaterialConstant **constants)
{
  switch (type) {
  case MATERIAL_LINEAR: *constants = isotropic; return 3;
  case MATERIAL_MOONEY_RIVLIN: *constants = mooney_rivlin; return PETSC_STATIC_ARRAY_LENGTH(mooney_rivlin);
  case MATERIAL_ORTHOTROPIC: *constants = orthotropic; return PETSC_STATIC_ARRAY_LENGTH(orthotropic);
  case MATERIAL_RIGID: return 0;
  default: *constants = isotropic; return 2;
  }
}

static PetscReal *MaterialConstantAt(const MaterialConstant *constant, Material *material)
{
  return (PetscReal *)((char *)material + constant->at);
}

static PetscBool MaterialConstantIsSet(const MaterialConstant *constant, const PetscReal value[])
{
  for (PetscInt i = 0; i < constant->n; ++i) {
    if (value[i] != 0) return PETSC_TRUE;
  }
  return constant->required;
}

/* A direction, which cannot be zero; zero stands for one that is not given */
static PetscBool MaterialConstantIsAxis(const MaterialConstant *constant)
{
  return (PetscBool)(constant->at == offsetof(Material, axes[0]) || constant->at == offsetof(Material, axes[1]));
}

/* A law that has no expansion says which have, where one is given */
static PetscErrorCode SceneReadNoExpansion(SceneKeys keys, const char owner[], const Material *material)
{
  const char *text;

  PetscFunctionBegin;
  if (!MaterialIsFinite(material)) PetscFunctionReturn(0);
  PetscCall(SceneKeysGet(keys, PETSC_FALSE, &text, "%s_expansion", owner));
  if (text)
    PetscCall(
      SceneKeysComplain(keys, "%s_expansion is for laws of small strain, linear and orthotropic: %s does not expand",
        owner, MaterialTypes[material->type]));
  PetscFunctionReturn(0);
}

/* <owner>_<constant>, each required unless the material has a name, whose constants it then replaces */
PetscErrorCode SceneReadConstants(SceneKeys keys, const char owner[], PetscBool listed, Material *material)
{
  const MaterialConstant *constants;
  const PetscInt          n = MaterialConstants(material->type, &constants);
  char                    key[SCENE_KEY_LENGTH];
  const char             *text;

  PetscFunctionBegin;
  for (PetscInt i = 0; i < n; ++i) {
    PetscReal *value = MaterialConstantAt(&constants[i], material);

    PetscCall(PetscSNPrintf(key, sizeof(key), "%s_%s", owner, constants[i].name));
    PetscCall(SceneKeysGet(keys, (PetscBool)(constants[i].required && !listed), &text, "%s", key));
    if (text && constants[i].n == 1) PetscCall(SceneParseReal(keys, key, text, value));
    else if (text) PetscCall(SceneParseReals(keys, key, text, constants[i].n, value));
    if (text && MaterialConstantIsAxis(&constants[i]) && !MaterialConstantIsSet(&constants[i], value))
      PetscCall(SceneKeysComplain(keys, "%s is \"%s\", which is no direction", key, text));
  }
  PetscCall(SceneReadNoExpansion(keys, owner, material));
  PetscCall(MaterialSetScale(material));
  PetscFunctionReturn(0);
}

static PetscErrorCode ConstantView(const MaterialConstant *constant, const PetscReal value[], PetscViewer viewer)
{
  PetscFunctionBegin;
  PetscCall(PetscViewerASCIIPrintf(viewer, "%s: ", constant->name));
  PetscCall(PetscViewerASCIIUseTabs(viewer, PETSC_FALSE));
  if (constant->n == 1) PetscCall(SceneViewReal(viewer, *value));
  else PetscCall(SceneViewList(viewer, constant->n, value));
  PetscCall(PetscViewerASCIIPrintf(viewer, "\n"));
  PetscCall(PetscViewerASCIIUseTabs(viewer, PETSC_TRUE));
  PetscFunctionReturn(0);
}

static PetscErrorCode ConstantDescribe(const MaterialConstant *constant, const PetscReal value[], PetscViewer viewer)
{
  const char *name = constant == &isotropic[0] ? "E" : constant == &isotropic[1] ? "nu" : constant->name;

  PetscFunctionBegin;
  PetscCall(PetscViewerASCIIPrintf(viewer, ", %s =", name));
  for (PetscInt k = 0; k < constant->n; ++k) PetscCall(PetscViewerASCIIPrintf(viewer, " %.6g", (double)value[k]));
  PetscFunctionReturn(0);
}

/* Those that are required or not 0 */
static PetscErrorCode ConstantsShow(const Material *material,
  PetscErrorCode (*show)(const MaterialConstant *, const PetscReal[], PetscViewer), PetscViewer viewer)
{
  const MaterialConstant *constants;
  const PetscInt          n    = MaterialConstants(material->type, &constants);
  Material                copy = *material;

  PetscFunctionBegin;
  for (PetscInt i = 0; i < n; ++i) {
    const PetscReal *value = MaterialConstantAt(&constants[i], &copy);

    if (MaterialConstantIsSet(&constants[i], value)) PetscCall(show(&constants[i], value, viewer));
  }
  PetscFunctionReturn(0);
}

/* A line each, as it is read */
PetscErrorCode SceneViewConstants(const Material *material, PetscViewer viewer)
{
  PetscFunctionBegin;
  PetscCall(ConstantsShow(material, ConstantView, viewer));
  PetscFunctionReturn(0);
}

/* In words, within a line */
PetscErrorCode SceneDescribeConstants(const Material *material, PetscViewer viewer)
{
  PetscFunctionBegin;
  PetscCall(ConstantsShow(material, ConstantDescribe, viewer));
  PetscFunctionReturn(0);
}

static PetscErrorCode SceneValidateOrthotropic(MPI_Comm comm, const char file[], const SceneBody *body)
{
  const Material *m = &body->material;
  MaterialModuli  moduli;
  PetscErrorCode  ierr;

  PetscFunctionBegin;
  for (PetscInt i = 0; i < 3; ++i) {
    PetscCheck(m->youngs[i] > 0, comm, PETSC_ERR_USER_INPUT,
      "%s: body \"%s\" has Young's modulus young = %g along axis %" PetscInt_FMT ", which must be above 0", file,
      body->name, (double)m->youngs[i], i + 1);
    PetscCheck(m->shears[i] > 0, comm, PETSC_ERR_USER_INPUT,
      "%s: body \"%s\" has a shear modulus shear = %g, which must be above 0", file, body->name, (double)m->shears[i]);
  }
  PetscCall(PetscPushErrorHandler(PetscReturnErrorHandler, NULL));
  ierr = MaterialGetModuli(m, &moduli, NULL);
  PetscCall(PetscPopErrorHandler());
  PetscCheck(!ierr, comm, PETSC_ERR_USER_INPUT,
    "%s: body \"%s\" is orthotropic with Poisson's ratios %g, %g, %g for the axes 12, 23, 13, with which some strain "
    "has no positive energy, or its first_axis and second_axis are along one line",
    file, body->name, (double)m->poissons[0], (double)m->poissons[1], (double)m->poissons[2]);
  PetscFunctionReturn(0);
}

PetscErrorCode SceneValidateConstants(MPI_Comm comm, const char file[], const SceneBody *body)
{
  const Material *m = &body->material;

  PetscFunctionBegin;
  switch (m->type) {
  case MATERIAL_MOONEY_RIVLIN:
    PetscCheck(m->c10 >= 0 && m->c01 >= 0 && m->c10 + m->c01 > 0, comm, PETSC_ERR_USER_INPUT,
      "%s: body \"%s\" has c10 = %g and c01 = %g, of which none may be negative, or its energy has no lower bound, nor "
      "both be 0",
      file, body->name, (double)m->c10, (double)m->c01);
    PetscCheck(m->bulk > 0, comm, PETSC_ERR_USER_INPUT,
      "%s: body \"%s\" has a bulk modulus bulk = %g, which must be above 0", file, body->name, (double)m->bulk);
    break;
  case MATERIAL_ORTHOTROPIC: PetscCall(SceneValidateOrthotropic(comm, file, body)); break;
  default:
    PetscCheck(m->young > 0, comm, PETSC_ERR_USER_INPUT,
      "%s: body \"%s\" has Young's modulus young = %g, which must be above 0", file, body->name, (double)m->young);
    PetscCheck(m->poisson > -1 && m->poisson < 0.5, comm, PETSC_ERR_USER_INPUT,
      "%s: body \"%s\" has Poisson's ratio poisson = %g, which must lie between -1 and 0.5, both excluded", file,
      body->name, (double)m->poisson);
  }
  PetscFunctionReturn(0);
}
