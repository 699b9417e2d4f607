/* Reads, prints, describes and checks the constants of material laws. */
#include "sectionsimpl.h"
#include <petscviewer.h>

/* Finds the values of a constant in a material. Returns the number of values. */
static PetscInt MaterialConstantGet(const MaterialConstant *constant, const Material *material, const PetscReal **value)
{
  const char *at = (const char *)material + constant->at;

  *value = constant->n ? (const PetscReal *)at : ((const MaterialList *)at)->value;
  return constant->n ? constant->n : ((const MaterialList *)at)->n;
}

static PetscBool MaterialConstantIsSet(const MaterialConstant *constant, PetscInt n, const PetscReal value[])
{
  for (PetscInt i = 0; i < n; ++i) {
    if (value[i] != 0) return PETSC_TRUE;
  }
  return constant->required;
}

/*
   Returns whether the constant is a direction. A direction must not be zero; a zero vector means that it is not given.
*/
static PetscBool MaterialConstantIsAxis(const MaterialConstant *constant)
{
  return (PetscBool)(constant->at == offsetof(Material, axes[0]) || constant->at == offsetof(Material, axes[1]));
}

/*
   Records an error if a thermal expansion is given for a law without thermal expansion. The message names the laws that
   have one.
*/
static PetscErrorCode SceneReadNoExpansion(SceneKeys keys, const char owner[], const Material *material)
{
  const char *text;

  PetscFunctionBegin;
  if (!MaterialIsFinite(material)) PetscFunctionReturn(0);
  PetscCall(SceneKeysGet(keys, PETSC_FALSE, &text, "%s_expansion", owner));
  if (text)
    PetscCall(SceneKeysError(keys, owner, "expansion",
      "is for laws of small strain, linear and orthotropic: %s does not expand", MaterialTypes[material->type]));
  PetscFunctionReturn(0);
}

/* Reads a list of any number of values up to MATERIAL_LIST. */
static PetscErrorCode SceneReadConstantList(SceneKeys keys, const char key[], const char text[], MaterialList *list)
{
  char **words;

  PetscFunctionBegin;
  list->n = PETSC_DECIDE;
  PetscCall(SceneParseList(keys, key, text, &list->n, &words));
  PetscCall(PetscStrToArrayDestroy((int)list->n, words));
  if (list->n > MATERIAL_LIST) {
    PetscCall(SceneKeysError(keys, key, NULL, "has %" PetscInt_FMT " numbers, which must be at most %d", list->n,
      MATERIAL_LIST));
    list->n = 0;
  } else PetscCall(SceneParseReals(keys, key, text, list->n, list->value));
  PetscFunctionReturn(0);
}

/* Checks the constants of hardening together; elastic laws may have a yield stress. */
static PetscErrorCode SceneCheckHardening(SceneKeys keys, const char owner[], Material *material)
{
  MaterialHardening *h = &material->hardening;
  const char        *key;
  char               why[128];
  PetscBool          has;

  PetscFunctionBegin;
  PetscCall(SceneHasKey(keys, owner, "yield", &has));
  if (!MaterialYields(material) && !has) PetscFunctionReturn(0);
  if (h->stresses.n && h->yield != 0.0 && h->yield != h->stresses.value[0])
    PetscCall(SceneKeysError(keys, owner, "yield", "is %g, but is not the first of yield_stresses, %g: omit it",
      (double)h->yield, (double)h->stresses.value[0]));
  if (h->stresses.n) h->yield = h->stresses.value[0];
  if (!has && h->yield == 0.0)
    PetscCall(
      SceneKeysError(keys, owner, "yield", "is missing; a table of plastic_strains and yield_stresses may replace it"));
  if (!MaterialCheckHardening(h, &key, why, sizeof(why))) PetscCall(SceneKeysError(keys, owner, key, "%s", why));
  PetscFunctionReturn(0);
}

/*
   Reads the constants of a material law from the keys <owner>_<constant>. listed: true if the body names a material;
   constants are then optional and replace those of the named material. Otherwise they are required.
*/
PetscErrorCode SceneReadConstants(SceneKeys keys, const char owner[], PetscBool listed, Material *material)
{
  const MaterialLaw *law;
  char               key[SCENE_KEY_LENGTH];
  const char        *text;

  PetscFunctionBegin;
  PetscCall(MaterialGetLaw(material, &law));
  for (const MaterialConstant *c = law->constants; c->name; ++c) {
    PetscReal *value = (PetscReal *)((char *)material + c->at);

    PetscCall(PetscSNPrintf(key, sizeof(key), "%s_%s", owner, c->name));
    PetscCall(SceneKeysGet(keys, (PetscBool)(c->required && !listed), &text, "%s", key));
    if (text && c->n == 1) PetscCall(SceneParseReal(keys, key, text, value));
    else if (text && !c->n) PetscCall(SceneReadConstantList(keys, key, text, (MaterialList *)value));
    else if (text) PetscCall(SceneParseReals(keys, key, text, c->n, value));
    if (text && MaterialConstantIsAxis(c) && !MaterialConstantIsSet(c, c->n, value))
      PetscCall(SceneKeysError(keys, key, NULL, "is \"%s\", which is no direction", text));
  }
  PetscCall(SceneReadNoExpansion(keys, owner, material));
  PetscCall(SceneCheckHardening(keys, owner, material));
  PetscCall(MaterialSetScale(material));
  PetscFunctionReturn(0);
}

static PetscErrorCode ConstantView(const MaterialConstant *constant, PetscInt n, const PetscReal value[],
  PetscViewer viewer)
{
  PetscFunctionBegin;
  PetscCall(PetscViewerASCIIPrintf(viewer, "%s: ", constant->name));
  PetscCall(PetscViewerASCIIUseTabs(viewer, PETSC_FALSE));
  if (constant->n == 1) PetscCall(SceneViewReal(viewer, *value));
  else PetscCall(SceneViewList(viewer, n, value));
  PetscCall(PetscViewerASCIIPrintf(viewer, "\n"));
  PetscCall(PetscViewerASCIIUseTabs(viewer, PETSC_TRUE));
  PetscFunctionReturn(0);
}

static PetscErrorCode ConstantDescribe(const MaterialConstant *constant, PetscInt n, const PetscReal value[],
  PetscViewer viewer)
{
  const char *name = constant->symbol ? constant->symbol : constant->name;

  PetscFunctionBegin;
  PetscCall(PetscViewerASCIIPrintf(viewer, ", %s =", name));
  for (PetscInt k = 0; k < n; ++k) PetscCall(PetscViewerASCIIPrintf(viewer, " %.6g", (double)value[k]));
  PetscFunctionReturn(0);
}

/* Calls `show` for each constant that is required or not 0. */
static PetscErrorCode ConstantsShow(const Material *material,
  PetscErrorCode (*show)(const MaterialConstant *, PetscInt, const PetscReal[], PetscViewer), PetscViewer viewer)
{
  const MaterialLaw *law;

  PetscFunctionBegin;
  PetscCall(MaterialGetLaw(material, &law));
  for (const MaterialConstant *c = law->constants; c->name; ++c) {
    const PetscReal *value;
    const PetscInt   n = MaterialConstantGet(c, material, &value);

    if (MaterialConstantIsSet(c, n, value)) PetscCall(show(c, n, value, viewer));
  }
  PetscFunctionReturn(0);
}

/* Prints the constants as YAML, one per line. */
PetscErrorCode SceneViewConstants(const Material *material, PetscViewer viewer)
{
  PetscFunctionBegin;
  PetscCall(ConstantsShow(material, ConstantView, viewer));
  PetscFunctionReturn(0);
}

/* Describes the constants within a line. */
PetscErrorCode SceneDescribeConstants(const Material *material, PetscViewer viewer)
{
  PetscFunctionBegin;
  PetscCall(ConstantsShow(material, ConstantDescribe, viewer));
  PetscFunctionReturn(0);
}

static PetscErrorCode SceneValidateOrthotropic(MPI_Comm comm, const SceneBody *body)
{
  const Material *m = &body->material;
  MaterialModuli  moduli;
  PetscErrorCode  ierr;

  PetscFunctionBegin;
  for (PetscInt i = 0; i < 3; ++i) {
    SceneRequire(m->youngs[i] > 0, body,
      "body \"%s\" has Young's modulus young = %g along axis %" PetscInt_FMT ", which must be above 0", body->name,
      (double)m->youngs[i], i + 1);
    SceneRequire(m->shears[i] > 0, body, "body \"%s\" has a shear modulus shear = %g, which must be above 0",
      body->name, (double)m->shears[i]);
  }
  PetscCall(PetscPushErrorHandler(PetscReturnErrorHandler, NULL));
  ierr = MaterialGetModuli(m, &moduli, NULL);
  PetscCall(PetscPopErrorHandler());
  SceneRequire(!ierr, body,
    "body \"%s\" is orthotropic with Poisson's ratios %g, %g, %g for the axes 12, 23, 13, for which some strain "
    "has no positive energy, or its first_axis and second_axis are parallel",
    body->name, (double)m->poissons[0], (double)m->poissons[1], (double)m->poissons[2]);
  PetscFunctionReturn(0);
}

/* Checks that a constant lies within the bounds of its law. */
static PetscErrorCode ConstantValidate(MPI_Comm comm, const SceneBody *body, const MaterialConstant *c)
{
  const PetscReal *value;
  const PetscInt   n     = MaterialConstantGet(c, &body->material, &value);
  const char      *label = c->label ? c->label : c->name;
  char             lower[32], upper[32];

  PetscFunctionBegin;
  (void)snprintf(lower, sizeof(lower), "%g", (double)c->lower); /* snprintf() is used because PETSc's formatting
                                                                   would print 0. for 0 */
  (void)snprintf(upper, sizeof(upper), "%g", (double)c->upper);
  for (PetscInt i = 0; i < n && c->lower < c->upper; ++i) {
    SceneRequire(value[i] > c->lower || c->upper < PETSC_INFINITY, body,
      "body \"%s\" has %s %s = %g, which must be above %s", body->name, label, c->name, (double)value[i], lower);
    SceneRequire(value[i] > c->lower && value[i] < c->upper, body,
      "body \"%s\" has %s %s = %g, which must lie between %s and %s, both excluded", body->name, label, c->name,
      (double)value[i], lower, upper);
  }
  PetscFunctionReturn(0);
}

PetscErrorCode SceneValidateConstants(MPI_Comm comm, const SceneBody *body)
{
  const Material    *m = &body->material;
  const MaterialLaw *law;

  PetscFunctionBegin;
  if (m->type == MATERIAL_MOONEY_RIVLIN)
    SceneRequire(m->c10 >= 0 && m->c01 >= 0 && m->c10 + m->c01 > 0, body,
      "body \"%s\" has c10 = %g and c01 = %g, but neither may be negative, and not both may be 0", body->name,
      (double)m->c10, (double)m->c01);
  if (m->type == MATERIAL_ORTHOTROPIC) PetscCall(SceneValidateOrthotropic(comm, body));
  PetscCall(MaterialGetLaw(m, &law));
  for (const MaterialConstant *c = law->constants; c->name; ++c) PetscCall(ConstantValidate(comm, body, c));
  PetscFunctionReturn(0);
}
