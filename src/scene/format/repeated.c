/*
   Finds keys that a scene sets twice, of which PETSc would use the last one. Both may be in the same mapping; or one is
   nested and one is joined, as in outer: {radius: 1} and outer_radius: 2. Keys are compared by their paths, which are
   joined like options and contain the numbers of list entries, since two entries with the same name are reported
   elsewhere.
*/
#include "repeated.h"
#include <ctype.h>
#include <string.h>

static PetscErrorCode RepeatedSetPath(RepeatedKeys *keys, size_t length, const char more[])
{
  size_t added;

  PetscFunctionBegin;
  PetscCall(PetscStrlen(more, &added));
  if (length + added + 2 > keys->capacity) {
    keys->capacity = 2 * (length + added + 2);
    PetscCall(PetscRealloc(keys->capacity, &keys->path));
  }
  PetscCall(PetscMemcpy(keys->path + length, more, added + 1));
  keys->length = length + added;
  PetscFunctionReturn(0);
}

/*
   Stores the path of a key. A key whose value is a mapping differs from one with a scalar value. Merge keys, <<, may be
   repeated.
*/
static PetscErrorCode RepeatedRemember(RepeatedKeys *keys, PetscBool mapping)
{
  PetscBool taken;

  PetscFunctionBegin;
  PetscCall(PetscStrendswith(keys->path, "<<", &taken));
  if (taken) PetscFunctionReturn(0);
  if (keys->n == keys->max) {
    keys->max = 2 * keys->max + 64;
    PetscCall(PetscRealloc(keys->max * sizeof(*keys->paths), &keys->paths));
    PetscCall(PetscRealloc(keys->max * sizeof(*keys->lines), &keys->lines));
  }
  if (mapping) PetscCall(RepeatedSetPath(keys, keys->length, "/"));
  keys->lines[keys->n] = keys->line;
  PetscCall(PetscStrallocpy(keys->path, &keys->paths[keys->n++]));
  if (mapping) keys->path[--keys->length] = 0;
  PetscFunctionReturn(0);
}

static PetscErrorCode RepeatedReadKey(RepeatedKeys *keys, const yaml_event_t *event)
{
  const RepeatedLevel *level = &keys->levels[keys->depth - 1];
  const char          *name  = (const char *)event->data.scalar.value;
  size_t               start = level->length;

  PetscFunctionBegin;
  PetscCheck(isalnum((unsigned char)name[0]) || !strcmp(name, "<<"), PETSC_COMM_SELF, PETSC_ERR_USER_INPUT,
    "line %zu: \"%s\" is not a name: a letter, then letters, digits, _ or -", event->start_mark.line + 1, name);
  keys->line = event->start_mark.line + 1;
  if (start) PetscCall(RepeatedSetPath(keys, start++, "_"));
  PetscCall(RepeatedSetPath(keys, start, name));
  PetscCall(PetscStrtolower(keys->path + start));
  PetscFunctionReturn(0);
}

/* Processes the beginning of a node, which is a key, the value of a key, an entry of a list, or the whole document. */
static PetscErrorCode RepeatedBeginNode(RepeatedKeys *keys, const yaml_event_t *event)
{
  RepeatedLevel  *level = keys->depth ? &keys->levels[keys->depth - 1] : NULL;
  const PetscBool leaf  = (PetscBool)(event->type != YAML_MAPPING_START_EVENT);
  char            entry[32];

  PetscFunctionBegin;
  if (!level) PetscFunctionReturn(0);
  if (!level->mapping) {
    PetscCall(PetscSNPrintf(entry, sizeof(entry), "#%" PetscInt_FMT, level->n++));
    PetscCall(RepeatedSetPath(keys, level->length, entry));
  } else if (level->n++ % 2) PetscCall(RepeatedRemember(keys, (PetscBool)!leaf));
  else if (event->type == YAML_SCALAR_EVENT) PetscCall(RepeatedReadKey(keys, event));
  PetscFunctionReturn(0);
}

static PetscErrorCode RepeatedPush(RepeatedKeys *keys, PetscBool mapping, size_t line)
{
  PetscFunctionBegin;
  if (keys->depth == keys->maxdepth) {
    keys->maxdepth = 2 * keys->maxdepth + 16;
    PetscCall(PetscRealloc(keys->maxdepth * sizeof(*keys->levels), &keys->levels));
  }
  keys->levels[keys->depth++] = (RepeatedLevel){.mapping = mapping, .length = keys->length, .line = line};
  PetscFunctionReturn(0);
}

/* Removes the numbers of entries from a path, which messages do not contain. */
static void RepeatedStrip(char path[])
{
  char *to = path;

  for (const char *from = path; *from && *from != '/'; ++from) {
    if (*from == '#') {
      while (isdigit((unsigned char)from[1])) ++from;
    } else *to++ = *from;
  }
  *to = 0;
}

/* Raises an error unless a list entry consists of one name with its contents. */
static PetscErrorCode RepeatedCheckEntry(const RepeatedKeys *keys)
{
  const RepeatedLevel *level = &keys->levels[keys->depth - 1];
  char                 list[256];

  PetscFunctionBegin;
  if (keys->depth < 2 || !level->mapping || level[-1].mapping || level->n <= 2) PetscFunctionReturn(0);
  PetscCall(PetscStrncpy(list, keys->path, PetscMin(level[-1].length + 1, sizeof(list))));
  RepeatedStrip(list);
  SETERRQ(PETSC_COMM_SELF, PETSC_ERR_USER_INPUT,
    "line %zu: this entry of %s has %" PetscInt_FMT
    " keys on one level, but must have one, its name, with the other keys below it: - name: {key: value, ...}",
    level->line, list, level->n / 2);
}

PetscErrorCode RepeatedKeysRead(RepeatedKeys *keys, const yaml_event_t *event)
{
  const PetscBool mapping = (PetscBool)(event->type == YAML_MAPPING_START_EVENT),
                  list    = (PetscBool)(event->type == YAML_SEQUENCE_START_EVENT);

  PetscFunctionBegin;
  if (mapping || list || event->type == YAML_SCALAR_EVENT || event->type == YAML_ALIAS_EVENT)
    PetscCall(RepeatedBeginNode(keys, event));
  if (mapping || list) PetscCall(RepeatedPush(keys, mapping, event->start_mark.line + 1));
  if (event->type == YAML_MAPPING_END_EVENT) PetscCall(RepeatedCheckEntry(keys));
  if (event->type == YAML_MAPPING_END_EVENT || event->type == YAML_SEQUENCE_END_EVENT) --keys->depth;
  PetscFunctionReturn(0);
}

/* Raises an error for the first repeated key. Call this function after the last event. */
PetscErrorCode RepeatedKeysCheck(RepeatedKeys *keys)
{
  PetscInt *order;

  PetscFunctionBegin;
  PetscCall(PetscMalloc1(keys->n, &order));
  for (PetscInt i = 0; i < keys->n; ++i) order[i] = i;
  PetscCall(PetscSortStrWithPermutation(keys->n, (const char **)keys->paths, order));
  for (PetscInt i = 1; i < keys->n; ++i) {
    const PetscInt a = PetscMin(order[i - 1], order[i]), b = PetscMax(order[i - 1], order[i]);
    PetscBool      same;

    PetscCall(PetscStrcmp(keys->paths[a], keys->paths[b], &same));
    if (same) RepeatedStrip(keys->paths[a]);
    PetscCheck(!same, PETSC_COMM_SELF, PETSC_ERR_USER_INPUT, "line %zu: the key \"%s\" is already in line %zu",
      keys->lines[b], keys->paths[a], keys->lines[a]);
  }
  PetscCall(PetscFree(order));
  PetscFunctionReturn(0);
}

/* Moves the keys, in the form that messages use, to the caller, with their places. Call this after the last event. */
PetscErrorCode RepeatedKeysGetPlaces(RepeatedKeys *keys, const char file[], ScenePlaces *places)
{
  const size_t length = strlen(file) + 32;

  PetscFunctionBegin;
  PetscCall(PetscMalloc1(keys->n, &places->places));
  for (PetscInt i = 0; i < keys->n; ++i) {
    RepeatedStrip(keys->paths[i]);
    PetscCall(PetscMalloc1(length, &places->places[i]));
    PetscCall(PetscSNPrintf(places->places[i], length, "%s: line %zu: ", file, keys->lines[i]));
  }
  PetscCall(PetscMalloc1(length, &places->file));
  PetscCall(PetscSNPrintf(places->file, length, "%s: ", file));
  places->n    = keys->n;
  places->keys = keys->paths;
  keys->n      = 0;
  keys->paths  = NULL;
  PetscFunctionReturn(0);
}

PetscErrorCode RepeatedKeysDestroy(RepeatedKeys *keys)
{
  PetscFunctionBegin;
  for (PetscInt i = 0; i < keys->n; ++i) PetscCall(PetscFree(keys->paths[i]));
  PetscCall(PetscFree(keys->paths));
  PetscCall(PetscFree(keys->lines));
  PetscCall(PetscFree(keys->levels));
  PetscCall(PetscFree(keys->path));
  PetscFunctionReturn(0);
}
