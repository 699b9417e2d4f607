/* contact: keys of a contact pair that are not single values */
#include "sectionsimpl.h"
#include <petscviewer.h>

/* Reads true, false, or a length */
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
    PetscCall(SceneKeysError(keys, "%s is %s; it is true, false, or the largest overlap that is meant", key, text));
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

/* Reads `stick`; called after friction and shear_limit, which it excludes */
static PetscErrorCode StickRead(SceneKeys keys, Scene scene, const char key[], const char text[], void *entry)
{
  SceneContactPair *pair   = entry;
  PetscBool         sticks = PETSC_FALSE;

  PetscFunctionBegin;
  (void)scene;
  PetscCall(SceneParseAnswer(keys, key, text, &sticks));
  if (sticks && (pair->friction > 0.0 || pair->shear_limit < PETSC_INFINITY))
    PetscCall(SceneKeysError(keys,
      "%s is true: a face that sticks whatever the force has no friction or shear_limit beside it", key));
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

/* Finishes a pair: its ramps must exist; a shear limit without a coefficient holds for any normal force */
PetscErrorCode SceneFinishPair(SceneKeys keys, Scene scene, const char owner[], void *entry)
{
  SceneContactPair *pair = entry;
  PetscBool         interference, coefficient, limit;

  PetscFunctionBegin;
  (void)scene;
  PetscCall(SceneHasKey(keys, owner, "interference", &interference));
  PetscCall(SceneHasKey(keys, owner, "friction", &coefficient));
  PetscCall(SceneHasKey(keys, owner, "shear_limit", &limit));
  if (pair->interference_ramp >= 0 && !interference)
    PetscCall(
      SceneKeysError(keys, "%s_ramp is what an interference follows, but %s_interference is missing", owner, owner));
  if (pair->interference_ramp >= 0 && interference &&
      (pair->interference >= PETSC_INFINITY || pair->interference == 0.0))
    PetscCall(SceneKeysError(keys,
      "%s_interference is true, false or 0; with a ramp it must be the largest intended overlap", owner));
  if (pair->friction_ramp >= 0 && !coefficient)
    PetscCall(
      SceneKeysError(keys, "%s_friction_ramp is what a coefficient follows, but %s_friction is missing", owner, owner));
  if (limit && !coefficient) pair->friction = PETSC_INFINITY;
  PetscFunctionReturn(0);
}
