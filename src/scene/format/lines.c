/*
   Finds the lines of the scene file for messages. A message names a key, or an entry of a list by its kind and name.
   The line is found from these words, so that functions which write messages need not know the line.
*/
#include "formatimpl.h"
#include <string.h>
#include <strings.h>

/* Returns the line of a key. If the key is repeated, the last line is returned; 0: not known. */
static size_t LineOfKey(const SceneKeyLines *lines, const char key[])
{
  for (PetscInt i = lines->n; i-- > 0;) {
    if (!strcasecmp(lines->keys[i], key)) return lines->lines[i];
  }
  return 0;
}

size_t SceneKeysGetLine(SceneKeys keys, const char key[])
{
  return LineOfKey(&keys->lines, key);
}

/*
   Returns the line of a key, or otherwise that of the entry or list to which the key belongs: bodies_slab for
   bodies_slab_young. The text `key` is shortened.
*/
static size_t LineOfOwner(const SceneKeyLines *lines, char key[])
{
  size_t line = LineOfKey(lines, key);

  for (char *last = strrchr(key, '_'); !line && last; last = strrchr(key, '_')) {
    *last = 0;
    line  = LineOfKey(lines, key);
  }
  return line;
}

/* Copies the text before `end` to `key` if it fits; otherwise `key` becomes empty. */
static void LineCopy(const char text[], const char *end, char key[SCENE_KEY_LENGTH])
{
  const size_t length = (size_t)(end - text);

  key[0] = 0;
  if (length < SCENE_KEY_LENGTH) (void)snprintf(key, SCENE_KEY_LENGTH, "%.*s", (int)length, text);
}

/*
   Returns the line of the first named entry in a message, such as body "slab"; 0: not known. *list: whether the quoted
   word is the name of an entry; name: the quoted word, which may be shortened.
*/
static size_t LineOfEntry(const SceneKeyLines *lines, const char message[], PetscBool *list,
  char name[SCENE_KEY_LENGTH])
{
  const char *quote = strchr(message, '"'), *end = quote ? strchr(quote + 1, '"') : NULL;
  const char *kind = end && quote > message ? SceneListOf(message, quote - 1) : NULL;
  char        entry[2 * SCENE_KEY_LENGTH];

  *list   = (PetscBool)(kind != NULL);
  name[0] = 0;
  if (end) LineCopy(quote + 1, end, name);
  (void)snprintf(entry, sizeof(entry), "%s_%s", kind ? kind : "", name);
  return kind ? LineOfKey(lines, entry) : 0;
}

/*
   Finds the line of the file that a message is about. *line: 0 if it is not known, or if the value does not come from
   the file. The function looks for a named entry, such as body "slab"; if there is none, for the key with which the
   message begins; and last for the quoted word, as in: the key "bodies" is missing.
*/
static PetscErrorCode LineOfMessage(SceneKeys keys, const char message[], size_t *line)
{
  char      key[SCENE_KEY_LENGTH], name[SCENE_KEY_LENGTH], option[2 * SCENE_KEY_LENGTH];
  PetscBool set, list;

  PetscFunctionBegin;
  *line = 0;
  LineCopy(message, message + strcspn(message, " ,:"), key);
  (void)snprintf(option, sizeof(option), "-%s", key);
  PetscCall(PetscOptionsValidKey(option, &set));
  if (set) PetscCall(PetscOptionsHasName(NULL, NULL, option, &set));
  if (set) PetscFunctionReturn(0);
  *line = LineOfEntry(&keys->lines, message, &list, name);
  if (!list && key[0]) *line = LineOfOwner(&keys->lines, key);
  /* a symmetry plane is called displacement "symmetry_slab_xmin" */
  if (!*line && name[0]) *line = LineOfOwner(&keys->lines, name);
  PetscFunctionReturn(0);
}

PetscErrorCode SceneKeysAddLine(SceneKeys keys, size_t size, char message[])
{
  char   copy[1024];
  size_t line = 0;

  PetscFunctionBegin;
  PetscCall(LineOfMessage(keys, message, &line));
  if (!line) PetscFunctionReturn(0);
  PetscCall(PetscStrncpy(copy, message, sizeof(copy)));
  (void)snprintf(message, size, "line %zu: %.990s", line, copy);
  PetscFunctionReturn(0);
}

PetscErrorCode SceneKeysRaise(SceneKeys keys, const RankError *error)
{
  const size_t length = strlen(keys->file);
  const char  *text   = error->message;
  char         message[sizeof(error->message) + 32];

  PetscFunctionBegin;
  if (!error->code) PetscFunctionReturn(0);
  PetscCheck(error->code == PETSC_ERR_USER_INPUT || error->code == PETSC_ERR_FILE_OPEN ||
               error->code == PETSC_ERR_FILE_READ,
    keys->comm, error->code, "%s", text);
  if (!strncmp(text, keys->file, length) && !strncmp(text + length, ": ", 2)) text += length + 2;
  PetscCall(PetscStrncpy(message, text, sizeof(message)));
  PetscCall(SceneKeysAddLine(keys, sizeof(message), message));
  PetscCall(SceneKeysSayNested(keys, sizeof(message), message));
  SETERRQ(keys->comm, error->code, "%s: %s", keys->file, message);
}

size_t SceneLinesFind(const SceneKeyLines *lines, const char message[])
{
  char            name[SCENE_KEY_LENGTH];
  PetscBool       list;
  const size_t    line     = LineOfEntry(lines, message, &list, name);
  const PetscBool symmetry = (PetscBool)(list && !strncmp(name, "symmetry_", 9));

  return line || !symmetry ? line : LineOfOwner(lines, name);
}

PetscErrorCode SceneDestroyLines(SceneKeyLines *lines)
{
  PetscFunctionBegin;
  for (PetscInt i = 0; i < lines->n; ++i) PetscCall(PetscFree(lines->keys[i]));
  PetscCall(PetscFree(lines->keys));
  PetscCall(PetscFree(lines->lines));
  lines->n = 0;
  PetscFunctionReturn(0);
}
