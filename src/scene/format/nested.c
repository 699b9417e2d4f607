/*
   Rewrites full keys as a user writes them: bodies_slab_young becomes key "young" of body "slab", and
   dynamics_time_step becomes key "time_step" of dynamics.
*/
#include "formatimpl.h"
#include <string.h>
#include <strings.h>

/* Parts of a full key: its list or section, the entry of the list, and the key. */
typedef struct {
  size_t list, entry, key; /* lengths; entry is 0 for a section */
} NestedParts;

/* Returns whether `word` begins with `part`, and the word ends there or goes on with _ */
static PetscBool NestedBegins(const char word[], size_t length, const char part[], size_t n)
{
  return (PetscBool)(n && n <= length && !strncasecmp(word, part, n) && (n == length || word[n] == '_'));
}

/* Finds the longest name in a list of names, separated by commas, with which a word begins; 0: none. */
static size_t NestedFindName(const char word[], size_t length, const char names[])
{
  size_t longest = 0;

  for (const char *name = names; *name; name += *name == ',') {
    const size_t n = strcspn(name, ",");

    if (n > longest && NestedBegins(word, length, name, n)) longest = n;
    name += n;
  }
  return longest;
}

/* Returns whether a word is a key of the top level, such as contact_updates. */
static PetscBool NestedIsTop(SceneKeys keys, const char word[], size_t length)
{
  for (const SceneKey *row = keys->top; row && row->name; ++row) {
    if (strlen(row->name) == length && !strncasecmp(word, row->name, length)) return PETSC_TRUE;
  }
  return PETSC_FALSE;
}

/* Splits a full key into its parts. Returns false if the word is not a full key. */
static PetscBool NestedSplit(SceneKeys keys, const char word[], size_t length, NestedParts *parts)
{
  *parts = (NestedParts){0};
  if (NestedIsTop(keys, word, length)) return PETSC_FALSE;
  for (PetscInt i = 0; i < keys->values.n; ++i) {
    const char  *list = keys->values.values[i].key;
    const size_t n    = strlen(list);
    size_t       name;

    if (n <= parts->list || n + 1 >= length || !NestedBegins(word, length, list, n)) continue;
    name = NestedFindName(word + n + 1, length - n - 1, keys->values.values[i].text);
    if (name) *parts = (NestedParts){n, name, length - n - 1 - name};
  }
  for (PetscInt i = 0; i < keys->places.n && !parts->list; ++i) {
    const char  *section = keys->places.keys[i];
    const size_t n       = strlen(section);

    if (!strchr(section, '_') && n + 1 < length && NestedBegins(word, length, section, n))
      *parts = (NestedParts){n, 0, length - n};
  }
  if (parts->key) --parts->key; /* the _ before it */
  return (PetscBool)(parts->list != 0);
}

/* Returns the last part of a full key: young of bodies_slab_young. A word that is no full key is returned itself. */
const char *SceneKeyOf(SceneKeys keys, const char word[])
{
  NestedParts parts;

  return NestedSplit(keys, word, strlen(word), &parts) ? word + strlen(word) - parts.key : word;
}

/* Returns the word for an entry of a list: body for bodies. */
static const char *NestedKindOf(const char list[])
{
  static const char *const kinds[][2] = {{"bodies", "body"}, {"contact", "contact pair"}, {"cyclic", "cyclic symmetry"},
    {"symmetry", "symmetry plane"}, {"body_forces", "body force"}, {"displacements", "displacement"},
    {"pressures", "pressure"}, {"tractions", "traction"}, {"forces", "force"}, {"springs", "spring"}, {"bolts", "bolt"},
    {"connectors", "connector"}, {"equations", "equation"}, {"ties", "tie"}, {"temperatures", "temperature"},
    {"refinements", "refinement"}, {"ramps", "ramp"}, {"materials", "material"}, {"faces", "face"},
    {"probes", "probe"}};

  for (size_t k = 0; k < PETSC_STATIC_ARRAY_LENGTH(kinds); ++k) {
    if (!strcasecmp(list, kinds[k][0])) return kinds[k][1];
  }
  return list;
}

void SceneKeysSay(SceneKeys keys, const char word[], PetscBool bare, size_t size, char text[])
{
  char        list[SCENE_KEY_LENGTH], key[2 * SCENE_KEY_LENGTH] = "";
  NestedParts parts;

  if (!NestedSplit(keys, word, strlen(word), &parts)) {
    (void)snprintf(text, size, bare ? "%s" : "key \"%s\"", word);
    return;
  }
  (void)snprintf(list, sizeof(list), "%.*s", (int)parts.list, word);
  if (parts.key) (void)snprintf(key, sizeof(key), "key \"%s\" of ", word + strlen(word) - parts.key);
  if (parts.entry)
    (void)snprintf(text, size, "%s%s \"%.*s\"", key, NestedKindOf(list), (int)parts.entry, word + parts.list + 1);
  else (void)snprintf(text, size, "%s%s", key, list);
}
