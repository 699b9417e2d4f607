/* Finds the places of keys in the scene file, with which messages begin. */
#include "formatimpl.h"
#include <string.h>
#include <strings.h>

/* Returns the place of a key, of the last one if it is repeated. NULL: the file does not have it. */
const char *SceneFindPlace(const ScenePlaces *places, const char key[])
{
  for (PetscInt i = places->n; i-- > 0;) {
    if (!strcasecmp(places->keys[i], key)) return places->places[i];
  }
  return NULL;
}

/* The value of a key may come from an option of the same name; the file does not contain the value then. */
static PetscBool PlaceIsOption(const char key[])
{
  char      option[SCENE_KEY_LENGTH + 1];
  PetscBool set = PETSC_FALSE;

  (void)snprintf(option, sizeof(option), "-%s", key);
  (void)PetscOptionsValidKey(option, &set);
  if (set) (void)PetscOptionsHasName(NULL, NULL, option, &set);
  return set;
}

const char *SceneGetPlace(const ScenePlaces *places, const char key[])
{
  char        owner[SCENE_KEY_LENGTH];
  const char *place = SceneFindPlace(places, key);

  if (PlaceIsOption(key)) return places->file;
  (void)snprintf(owner, sizeof(owner), "%s", key);
  for (char *last = strrchr(owner, '_'); !place && last; last = strrchr(owner, '_')) {
    *last = 0;
    place = SceneFindPlace(places, owner);
  }
  return place ? place : places->file;
}

PetscErrorCode SceneDestroyPlaces(ScenePlaces *places)
{
  PetscFunctionBegin;
  for (PetscInt i = 0; i < places->n; ++i) {
    PetscCall(PetscFree(places->keys[i]));
    PetscCall(PetscFree(places->places[i]));
  }
  PetscCall(PetscFree(places->keys));
  PetscCall(PetscFree(places->places));
  PetscCall(PetscFree(places->file));
  places->n = 0;
  PetscFunctionReturn(0);
}
