/*
   Rewrites the full keys of a message as a user writes them: bodies_slab_young becomes key "young" of body "slab", and
   dynamics_time_step becomes key "time_step" of dynamics.
*/
#include "formatimpl.h"
#include <string.h>
#include <strings.h>

#define WORD_ENDS " \t\",:;={}()[]"

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
  for (PetscInt i = 0; i < keys->lines.n && !parts->list; ++i) {
    const char  *section = keys->lines.keys[i];
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

/* Appends the parts of a full key to a text. quoted: the message has the word "key" and quotation marks already. */
static PetscErrorCode NestedAppend(const char word[], const NestedParts *parts, PetscBool quoted, size_t size,
  char text[])
{
  char        list[SCENE_KEY_LENGTH], piece[4 * SCENE_KEY_LENGTH] = "";
  const char *entry = word + parts->list + 1, *key = entry + (parts->entry ? parts->entry + 1 : 0);

  PetscFunctionBegin;
  PetscCall(PetscSNPrintf(list, sizeof(list), "%.*s", (int)parts->list, word));
  if (parts->key)
    PetscCall(PetscSNPrintf(piece, sizeof(piece), "%s\"%.*s\" of ", quoted ? "" : "key ", (int)parts->key, key));
  PetscCall(PetscStrlcat(text, piece, size));
  if (parts->entry)
    PetscCall(PetscSNPrintf(piece, sizeof(piece), "%s \"%.*s\"", SceneKindOf(list), (int)parts->entry, entry));
  else PetscCall(PetscSNPrintf(piece, sizeof(piece), "%s", list));
  PetscCall(PetscStrlcat(text, piece, size));
  PetscFunctionReturn(0);
}

PetscErrorCode SceneKeysSayNested(SceneKeys keys, size_t size, char message[])
{
  char        text[2048] = "", plain[2] = "";
  const char *at = message;

  PetscFunctionBegin;
  while (*at) {
    const size_t    before = (size_t)(at - message);
    const PetscBool quoted = (PetscBool)(before >= 5 && !strncmp(at - 5, "key \"", 5));
    const PetscBool starts = (PetscBool)(!before || at[-1] == ' ' || quoted);
    const size_t    length = starts ? strcspn(at, WORD_ENDS) : 0;
    NestedParts     parts;

    if (length && NestedSplit(keys, at, length, &parts)) {
      if (quoted) text[strlen(text) - 1] = 0;
      PetscCall(NestedAppend(at, &parts, quoted, sizeof(text), text));
      at += length + (quoted && at[length] == '"');
    } else {
      plain[0] = *at++;
      PetscCall(PetscStrlcat(text, plain, sizeof(text)));
    }
  }
  PetscCall(PetscStrncpy(message, text, size));
  PetscFunctionReturn(0);
}
