/* contact: a list of named pairs of faces */
#include "sectionsimpl.h"

/* true, false, or a length */
static PetscErrorCode SceneReadInterference(SceneKeys keys, Scene scene, SceneContactPair *pair)
{
  char        key[SCENE_KEY_LENGTH];
  const char *text, *ramp;
  PetscBool   any = PETSC_FALSE, none = PETSC_FALSE;

  PetscFunctionBegin;
  pair->interference_ramp = PETSC_DECIDE;
  PetscCall(SceneKeysGet(keys, PETSC_FALSE, &ramp, "contact_%s_ramp", pair->name));
  if (ramp) PetscCall(SceneReadRampName(keys, scene, "contact", pair->name, &pair->interference_ramp));
  PetscCall(PetscSNPrintf(key, sizeof(key), "contact_%s_interference", pair->name));
  PetscCall(SceneKeysGet(keys, PETSC_FALSE, &text, "%s", key));
  if (ramp && !text)
    PetscCall(
      SceneKeysComplain(keys, "contact_%s_ramp is what an interference follows, but %s is missing", pair->name, key));
  if (!text) PetscFunctionReturn(0);
  PetscCall(PetscStrcasecmp(text, "true", &any));
  PetscCall(PetscStrcasecmp(text, "false", &none));
  if (ramp && (any || none))
    PetscCall(
      SceneKeysComplain(keys, "%s is %s; one that follows a ramp is the largest overlap that is meant", key, text));
  if (any) pair->interference = PETSC_INFINITY;
  else if (!none) {
    PetscCall(SceneParseReal(keys, key, text, &pair->interference));
    if (pair->interference < 0.0)
      PetscCall(
        SceneKeysComplain(keys, "%s is %s; it is true, false, or the largest overlap that is meant", key, text));
  }
  PetscFunctionReturn(0);
}

/* A number of a pair that is not negative; *given: the file has it */
static PetscErrorCode SceneReadNotNegative(SceneKeys keys, const char pair[], const char what[], PetscReal *value,
  PetscBool *given)
{
  char        key[SCENE_KEY_LENGTH];
  const char *text;

  PetscFunctionBegin;
  PetscCall(PetscSNPrintf(key, sizeof(key), "contact_%s_%s", pair, what));
  PetscCall(SceneKeysGet(keys, PETSC_FALSE, &text, "%s", key));
  *given = (PetscBool)(text != NULL);
  if (!text) PetscFunctionReturn(0);
  PetscCall(SceneParseReal(keys, key, text, value));
  if (*value < 0.0) PetscCall(SceneKeysComplain(keys, "%s is %s, which must not be negative", key, text));
  PetscFunctionReturn(0);
}

/* Coulomb's coefficient, a limit of the shear, both, or sticking whatever the force */
static PetscErrorCode SceneReadFriction(SceneKeys keys, Scene scene, SceneContactPair *pair)
{
  char        key[SCENE_KEY_LENGTH];
  const char *text;
  PetscBool   coefficient, limit, sticks = PETSC_FALSE;

  PetscFunctionBegin;
  pair->shear_limit   = PETSC_INFINITY;
  pair->friction_ramp = PETSC_DECIDE;
  PetscCall(SceneReadNotNegative(keys, pair->name, "friction", &pair->friction, &coefficient));
  PetscCall(SceneReadNotNegative(keys, pair->name, "shear_limit", &pair->shear_limit, &limit));
  PetscCall(PetscSNPrintf(key, sizeof(key), "contact_%s_stick", pair->name));
  PetscCall(SceneKeysGet(keys, PETSC_FALSE, &text, "%s", key));
  if (text) PetscCall(SceneParseAnswer(keys, key, text, &sticks));
  if (sticks && (coefficient || limit))
    PetscCall(SceneKeysComplain(keys,
      "%s is true: a face that sticks whatever the force has no friction or shear_limit beside it", key));
  if (sticks || (limit && !coefficient)) pair->friction = PETSC_INFINITY;
  PetscCall(SceneKeysGet(keys, PETSC_FALSE, &text, "contact_%s_friction_ramp", pair->name));
  if (!text) PetscFunctionReturn(0);
  PetscCall(PetscSNPrintf(key, sizeof(key), "%s_friction", pair->name));
  PetscCall(SceneReadRampName(keys, scene, "contact", key, &pair->friction_ramp));
  if (!coefficient)
    PetscCall(SceneKeysComplain(keys,
      "contact_%s_friction_ramp is what a coefficient follows, but contact_%s_friction is missing", pair->name,
      pair->name));
  PetscFunctionReturn(0);
}

static PetscErrorCode SceneReadPair(SceneKeys keys, Scene scene, SceneContactPair *pair)
{
  char        key[SCENE_KEY_LENGTH];
  const char *text;
  PetscInt    gap = GAP_MORTAR;

  PetscFunctionBegin;
  PetscCall(SceneKeysGet(keys, PETSC_TRUE, &text, "contact_%s_mortar", pair->name));
  PetscCall(PetscStrallocpy(text ? text : "", &pair->mortar));
  PetscCall(SceneKeysGet(keys, PETSC_TRUE, &text, "contact_%s_nonmortar", pair->name));
  PetscCall(PetscStrallocpy(text ? text : "", &pair->nonmortar));
  PetscCall(PetscSNPrintf(key, sizeof(key), "contact_%s_gap", pair->name));
  PetscCall(SceneKeysGet(keys, PETSC_FALSE, &text, "%s", key));
  if (text) PetscCall(SceneParseEnum(keys, key, text, GapTypes, &gap));
  pair->gap = (GapType)gap;
  PetscCall(PetscSNPrintf(key, sizeof(key), "contact_%s_distance", pair->name));
  PetscCall(SceneKeysGet(keys, PETSC_FALSE, &text, "%s", key));
  if (text) PetscCall(SceneParseReal(keys, key, text, &pair->distance));
  PetscCall(SceneReadInterference(keys, scene, pair));
  PetscCall(SceneReadFriction(keys, scene, pair));
  PetscCall(PetscSNPrintf(key, sizeof(key), "contact_%s_smooth", pair->name));
  PetscCall(SceneKeysGet(keys, PETSC_FALSE, &text, "%s", key));
  pair->smooth = PETSC_TRUE;
  if (text) PetscCall(SceneParseAnswer(keys, key, text, &pair->smooth));
  PetscFunctionReturn(0);
}

PetscErrorCode SceneReadContact(SceneKeys keys, Scene scene)
{
  char **names;

  PetscFunctionBegin;
  PetscCall(SceneGetNames(keys, "contact", PETSC_FALSE, &scene->npairs, &names));
  PetscCall(PetscCalloc1(scene->npairs, &scene->pairs));
  for (PetscInt p = 0; p < scene->npairs; ++p) {
    scene->pairs[p].name = names[p];
    PetscCall(SceneReadPair(keys, scene, &scene->pairs[p]));
  }
  PetscCall(PetscFree(names));
  PetscFunctionReturn(0);
}
