/* contact: keys of a contact pair that are not single values. */
#include "sectionsimpl.h"
#include <petscviewer.h>
#include <string.h>

/* Reads `interference`: true (any overlap is intended), false, or the largest intended overlap [length]. */
static PetscErrorCode InterferenceRead(SceneKeys keys, Scene scene, const char key[], const char text[], void *entry)
{
  SceneContactPair *pair = entry;
  PetscBool         any, none;

  PetscFunctionBegin;
  (void)scene;
  PetscCall(PetscStrcasecmp(text, "true", &any));
  PetscCall(PetscStrcasecmp(text, "false", &none));
  if (any) pair->interference = PETSC_INFINITY;
  if (any || none) PetscFunctionReturn(0);
  PetscCall(SceneParseReal(keys, key, text, &pair->interference));
  if (pair->interference < 0.0)
    PetscCall(SceneKeysError(keys, key, NULL, "is %s; it must be true, false, or the largest intended overlap", text));
  PetscFunctionReturn(0);
}

static PetscBool InterferenceIsShown(const void *entry)
{
  return (PetscBool)(((const SceneContactPair *)entry)->interference > 0.0);
}

static PetscErrorCode InterferenceView(Scene scene, PetscViewer viewer, const void *entry)
{
  const SceneContactPair *pair = entry;

  PetscFunctionBegin;
  (void)scene;
  if (pair->interference >= PETSC_INFINITY) PetscCall(PetscViewerASCIIPrintf(viewer, "true"));
  else PetscCall(SceneViewReal(viewer, pair->interference));
  PetscFunctionReturn(0);
}

const SceneOwn SceneOwnInterference = {InterferenceRead, InterferenceIsShown, InterferenceView, 0};

/*
   Reads `stick`. Call this function after friction and shear_limit have been read, which must not be given together
   with `stick: true`.
*/
static PetscErrorCode StickRead(SceneKeys keys, Scene scene, const char key[], const char text[], void *entry)
{
  SceneContactPair *pair   = entry;
  PetscBool         sticks = PETSC_FALSE;

  PetscFunctionBegin;
  (void)scene;
  PetscCall(SceneParseAnswer(keys, key, text, &sticks));
  if (sticks && (pair->friction > 0.0 || pair->shear_limit < PETSC_INFINITY))
    PetscCall(SceneKeysError(keys, key, NULL, "is true, so that the keys friction and shear_limit are not allowed"));
  if (sticks) pair->friction = PETSC_INFINITY;
  PetscFunctionReturn(0);
}

static PetscBool StickIsShown(const void *entry)
{
  const SceneContactPair *pair = entry;

  return (PetscBool)(pair->friction >= PETSC_INFINITY && pair->shear_limit >= PETSC_INFINITY);
}

static PetscErrorCode StickView(Scene scene, PetscViewer viewer, const void *entry)
{
  PetscFunctionBegin;
  (void)scene;
  (void)entry;
  PetscCall(PetscViewerASCIIPrintf(viewer, "true"));
  PetscFunctionReturn(0);
}

const SceneOwn SceneOwnStick = {StickRead, StickIsShown, StickView, 0};

/*
   Reads a list whose entries are names of bodies or faces, or two of these names joined by a slash. The list is stored
   as a text with commas.
*/
static PetscErrorCode ExceptRead(SceneKeys keys, Scene scene, const char key[], const char text[], void *entry)
{
  SceneContactPair *pair   = entry;
  PetscInt          n      = PETSC_DECIDE;
  size_t            length = 0, used = 0;
  char            **words;

  PetscFunctionBegin;
  (void)scene;
  PetscCall(SceneParseList(keys, key, text, &n, &words));
  for (PetscInt i = 0; i < n; ++i) length += strlen(words[i]) + 1;
  PetscCall(PetscCalloc1(length + 1, &pair->except));
  for (PetscInt i = 0; i < n; used += strlen(words[i++]) + 1)
    (void)snprintf(pair->except + used, length + 1 - used, "%s%s", words[i], i + 1 < n ? "," : "");
  if (words) PetscCall(PetscStrToArrayDestroy((int)n, words));
  PetscFunctionReturn(0);
}

static PetscBool ExceptIsShown(const void *entry)
{
  return (PetscBool)(((const SceneContactPair *)entry)->except != NULL);
}

static PetscErrorCode ExceptView(Scene scene, PetscViewer viewer, const void *entry)
{
  PetscFunctionBegin;
  (void)scene;
  PetscCall(PetscViewerASCIIPrintf(viewer, "[%s]", ((const SceneContactPair *)entry)->except));
  PetscFunctionReturn(0);
}

const SceneOwn SceneOwnExcept = {ExceptRead, ExceptIsShown, ExceptView, 1};

/*
   Returns whether an entry is a rule for contact pairs, because it names no faces: the entry `auto`, or an entry with
   two bodies.
*/
static PetscBool PairIsRule(const SceneContactPair *pair)
{
  return (
    PetscBool)(!pair->mortar || !pair->nonmortar || (!strchr(pair->mortar, '.') && !strchr(pair->nonmortar, '.')));
}

/* Hides the keys `mortar` and `nonmortar` of a pair in contact with itself, because `self` names the same face */
PetscBool ScenePairHides(const void *entry, const char key[])
{
  const SceneContactPair *pair = entry;

  return (PetscBool)(pair->self && (!strcmp(key, "mortar") || !strcmp(key, "nonmortar")));
}

/* Finishes an entry with the key `self`. Both sides of the pair become that face, or the whole boundary of that
   body. */
static PetscErrorCode FinishSelf(SceneKeys keys, Scene scene, const char owner[], SceneContactPair *pair)
{
  PetscBool any, all = PETSC_FALSE;

  PetscFunctionBegin;
  if (pair->mortar || pair->nonmortar)
    PetscCall(SceneKeysError(keys, owner, pair->mortar ? "mortar" : "nonmortar",
      "cannot be combined with self, which is both sides: omit one of the two"));
  PetscCall(PetscStrcasecmp(pair->name, "auto", &any));
  if (any) {
    PetscCall(SceneParseAnswer(keys, "contact_auto_self", pair->self, &all));
    if (!all) PetscCall(PetscFree(pair->self));
  } else PetscCall(SceneContactPairSetSelf(scene->nbodies, scene->bodies, pair));
  PetscFunctionReturn(0);
}

/* Checks which sides of a pair are given, and that only rules have the keys of rules. */
static PetscErrorCode FinishSides(SceneKeys keys, Scene scene, const char owner[], SceneContactPair *pair)
{
  const char *text;
  PetscBool   any;

  PetscFunctionBegin;
  PetscCall(PetscStrcasecmp(pair->name, "auto", &any));
  if (pair->self) PetscCall(FinishSelf(keys, scene, owner, pair));
  if (any && (pair->mortar || pair->nonmortar))
    PetscCall(SceneKeysError(keys, owner, pair->mortar ? "mortar" : "nonmortar",
      "is given, but the entry %s is for all surfaces: give the entry another name", pair->name));
  if (!any && !pair->mortar) PetscCall(SceneKeysGet(keys, PETSC_TRUE, &text, "%s_mortar", owner));
  if (!any && !pair->nonmortar) PetscCall(SceneKeysGet(keys, PETSC_TRUE, &text, "%s_nonmortar", owner));
  if (!any && pair->except) PetscCall(SceneKeysError(keys, owner, "except", "is only for the entry auto of contact"));
  if (pair->tie > 0.0 && !PairIsRule(pair))
    PetscCall(SceneKeysError(keys, owner, "tie",
      "is only for the entry auto of contact, and for pairs of bodies; two faces are tied under ties"));
  PetscFunctionReturn(0);
}

/* Moves the entries that are rules from scene->pairs to scene->rules. */
PetscErrorCode SceneSplitRules(Scene scene)
{
  const PetscInt n = scene->npairs;

  PetscFunctionBegin;
  for (PetscInt p = 0; p < n; ++p) scene->nrules += PairIsRule(&scene->pairs[p]) ? 1 : 0;
  if (!scene->nrules) PetscFunctionReturn(0);
  PetscCall(PetscMalloc1(scene->nrules, &scene->rules));
  scene->nrules = scene->npairs = 0;
  for (PetscInt p = 0; p < n; ++p) {
    if (PairIsRule(&scene->pairs[p])) scene->rules[scene->nrules++] = scene->pairs[p];
    else scene->pairs[scene->npairs++] = scene->pairs[p];
  }
  PetscFunctionReturn(0);
}

/* Prints rules and pairs as one list. */
PetscErrorCode SceneViewPairs(Scene scene, PetscViewer viewer, const SceneList *list)
{
  SceneContactPair *all;

  PetscFunctionBegin;
  PetscCall(PetscMalloc1(scene->nrules + scene->npairs, &all));
  PetscCall(PetscArraycpy(all, scene->rules, scene->nrules));
  PetscCall(PetscArraycpy(all + scene->nrules, scene->pairs, scene->npairs));
  PetscCall(SceneViewEntries(scene, viewer, list, scene->nrules + scene->npairs, all));
  PetscCall(PetscFree(all));
  PetscFunctionReturn(0);
}

/* Checks that a part of a text, `length` characters from `text` on, names a body or a face of a body. */
static PetscErrorCode ValidateSurface(MPI_Comm comm, Scene scene, const SceneContactPair *owner, const char text[],
  size_t length)
{
  char name[SCENE_KEY_LENGTH];

  PetscFunctionBegin;
  PetscCall(PetscStrncpy(name, text, PetscMin(length + 1, sizeof(name))));
  if (!strchr(name, '.')) {
    PetscBool found = PETSC_FALSE;

    for (PetscInt b = 0; b < scene->nbodies; ++b) found = (PetscBool)(found || !strcmp(name, scene->bodies[b].name));
    SceneRequire(found, owner, "contact pair \"%s\" names \"%s\", which is no body of the scene", owner->name, name);
  } else PetscCall(SceneValidateFace(comm, scene, "contact pair", owner, name));
  PetscFunctionReturn(0);
}

/* Checks an entry with the key `self`: a pair in contact with itself */
PetscErrorCode SceneValidateSelf(MPI_Comm comm, Scene scene, const SceneContactPair *pair)
{
  const char     *face;
  const PetscBool whole = (PetscBool)!strchr(pair->self, '.');
  PetscInt        body;

  PetscFunctionBegin;
  PetscCall(ValidateSurface(comm, scene, pair, pair->self, strlen(pair->self)));
  body = SceneFindBody(scene, pair->mortar, &face);
  SceneRequire(scene->bodies[body].material.type != MATERIAL_RIGID, pair,
    "contact pair \"%s\" with self: %s: the body \"%s\" is rigid and cannot come into contact with itself", pair->name,
    pair->self, scene->bodies[body].name);
  SceneRequire(pair->gap != GAP_NODE, pair,
    "contact pair \"%s\" with self: %s cannot have gap: node, which needs two different faces; use gap: mortar or "
    "gap: dual",
    pair->name, pair->self);
  SceneRequire(pair->interference == 0.0, pair,
    "contact pair \"%s\" with self: %s cannot have an interference, because the surface must not overlap itself at "
    "the start; name the two faces that overlap as mortar and nonmortar",
    pair->name, pair->self);
  for (PetscInt c = 0; c < scene->ncyclic; ++c)
    SceneRequire(SceneFindBody(scene, scene->cyclic[c].from, &face) != body, pair,
      "contact pair \"%s\" with self: %s: the body is a sector of cyclic symmetry \"%s\": name two faces as "
      "mortar and nonmortar",
      pair->name, pair->self, scene->cyclic[c].name);
  for (PetscInt p = 0; p < scene->npairs; ++p) {
    const SceneContactPair *other  = &scene->pairs[p];
    const PetscBool         within = (PetscBool)(other != pair && SceneFindBody(scene, other->mortar, &face) == body &&
                                         SceneFindBody(scene, other->nonmortar, &face) == body);

    SceneRequire(!within || !whole, pair,
      "contact pair \"%s\" with self: %s is the whole surface of the body, which includes the faces of contact "
      "pair \"%s\": omit one of the pairs",
      pair->name, pair->self, other->name);
  }
  PetscFunctionReturn(0);
}

PetscErrorCode SceneValidateRules(MPI_Comm comm, Scene scene)
{
  PetscFunctionBegin;
  for (PetscInt r = 0; r < scene->nrules; ++r) {
    const SceneContactPair *rule = &scene->rules[r];

    if (rule->mortar) {
      PetscCall(ValidateSurface(comm, scene, rule, rule->mortar, strlen(rule->mortar)));
      PetscCall(ValidateSurface(comm, scene, rule, rule->nonmortar, strlen(rule->nonmortar)));
      SceneRequire(strcmp(rule->mortar, rule->nonmortar), rule,
        "contact pair \"%s\" has the same body \"%s\" on both sides", rule->name, rule->mortar);
    }
    for (const char *at = rule->except; at && *at;) {
      const size_t length = strcspn(at, ",/");

      PetscCall(ValidateSurface(comm, scene, rule, at, length));
      at += length + (at[length] != 0);
    }
  }
  PetscFunctionReturn(0);
}

/*
   Finishes a pair: checks that the values to which ramps are applied are given. A shear limit without a coefficient of
   friction holds for any normal force.
*/
PetscErrorCode SceneFinishPair(SceneKeys keys, Scene scene, const char owner[], void *entry)
{
  SceneContactPair *pair = entry;
  PetscBool         interference, coefficient, limit;

  PetscFunctionBegin;
  PetscCall(FinishSides(keys, scene, owner, pair));
  PetscCall(SceneHasKey(keys, owner, "interference", &interference));
  PetscCall(SceneHasKey(keys, owner, "friction", &coefficient));
  PetscCall(SceneHasKey(keys, owner, "shear_limit", &limit));
  if (pair->interference_ramp >= 0 && !interference)
    PetscCall(
      SceneKeysError(keys, owner, "ramp", "is the ramp of an interference, but the key interference is missing"));
  if (pair->interference_ramp >= 0 && interference &&
      (pair->interference >= PETSC_INFINITY || pair->interference == 0.0))
    PetscCall(SceneKeysError(keys, owner, "interference",
      "must be the largest intended overlap if it has a ramp; it is true, false or 0"));
  if (pair->friction_ramp >= 0 && !coefficient)
    PetscCall(
      SceneKeysError(keys, owner, "friction_ramp", "is the ramp of a coefficient, but the key friction is missing"));
  if (limit && !coefficient) pair->friction = PETSC_INFINITY;
  PetscFunctionReturn(0);
}
