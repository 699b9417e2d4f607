/* Reads, prints and frees an entry with the rows of the table of keys. */
#include "formatimpl.h"
#include <petscviewer.h>
#include <string.h>

/*
   Returns whether a row applies to this kind of shape or material law. row->of is a list of kinds separated by blanks.
   If `kind` is NULL, only rows without such a list apply.
*/
static PetscBool SceneRowIsOf(const SceneKey *row, const char kind[])
{
  const size_t length = kind ? strlen(kind) : 0;

  if (!row->of || !kind) return (PetscBool)(!row->of && !kind);
  for (const char *at = strstr(row->of, kind); at; at = strstr(at + 1, kind)) {
    if ((at == row->of || at[-1] == ' ') && (!at[length] || at[length] == ' ')) return PETSC_TRUE;
  }
  return PETSC_FALSE;
}

static PetscErrorCode RowCheckRange(SceneKeys keys, const SceneKey *row, const char key[], const char text[],
  const PetscReal value[])
{
  PetscFunctionBegin;
  for (PetscInt i = 0; i < row->n; ++i) {
    if (row->range == SCENE_ABOVE_0 && !(value[i] > 0))
      PetscCall(SceneKeysError(keys, key, NULL, "is %s, which must be above 0", text));
    if (row->range == SCENE_FROM_0 && !(value[i] >= 0))
      PetscCall(SceneKeysError(keys, key, NULL, "is %s, which must not be negative", text));
  }
  PetscFunctionReturn(0);
}

static PetscErrorCode RowRead(SceneKeys keys, Scene scene, const SceneKey *row, const char key[], const char text[],
  void *entry)
{
  void *value = (char *)entry + row->at;

  PetscFunctionBegin;
  switch (row->type) {
  case SCENE_REALS:
    if (row->n == 1) PetscCall(SceneParseReal(keys, key, text, (PetscReal *)value));
    else if (row->range == SCENE_UNBOUNDED) PetscCall(SceneParseBounds(keys, key, text, row->n, (PetscReal *)value));
    else PetscCall(SceneParseReals(keys, key, text, row->n, (PetscReal *)value));
    PetscCall(RowCheckRange(keys, row, key, text, (PetscReal *)value));
    break;
  case SCENE_INTS:
    if (row->n == 1) PetscCall(SceneParseInt(keys, key, text, (PetscInt *)value));
    else PetscCall(SceneParseInts(keys, key, text, row->n, (PetscInt *)value));
    break;
  case SCENE_ANSWER: PetscCall(SceneParseAnswer(keys, key, text, (PetscBool *)value)); break;
  case SCENE_CHOICE: {
    PetscInt choice = *(PetscEnum *)value;

    PetscCall(SceneParseEnum(keys, key, text, row->names, &choice));
    *(PetscEnum *)value = (PetscEnum)choice;
    break;
  }
  case SCENE_AXIS: PetscCall(SceneParseEnum(keys, key, text, row->names, (PetscInt *)value)); break;
  case SCENE_EXPRESSION: PetscCall(SceneCheckExpression(keys, key, text));
  /* fall through */
  case SCENE_TEXT: PetscCall(PetscStrallocpy(text, (char **)value)); break;
  case SCENE_BODY: PetscCall(SceneParseBody(keys, scene, key, text, (PetscInt *)value)); break;
  case SCENE_RAMP: PetscCall(SceneParseRamp(keys, scene, key, text, (PetscInt *)value)); break;
  case SCENE_OWN: PetscCall(row->own->read(keys, scene, key, text, entry)); break;
  case SCENE_SECTION: break;
  }
  PetscFunctionReturn(0);
}

/*
   Reads the rows that apply to `kind`; NULL: the rows that apply to all kinds. owner: prefix of the entry,
   "<list>_<name>", or "" at the top level. A required text that is missing becomes an empty text, so that it is never
   NULL.
*/
PetscErrorCode SceneReadRows(SceneKeys keys, Scene scene, const char owner[], const SceneKey rows[], const char kind[],
  void *entry)
{
  PetscFunctionBegin;
  for (const SceneKey *row = rows; row->name; ++row) {
    const PetscBool required = (PetscBool)(row->need == SCENE_REQUIRED);
    char            key[SCENE_KEY_LENGTH];
    const char     *text;

    if (row->type == SCENE_SECTION || !SceneRowIsOf(row, kind)) continue;
    PetscCall(PetscSNPrintf(key, sizeof(key), "%s%s%s", owner, owner[0] ? "_" : "", row->name));
    PetscCall(SceneKeysGet(keys, required, &text, "%s", key));
    if (text || (required && row->type == SCENE_TEXT))
      PetscCall(RowRead(keys, scene, row, key, text ? text : "", entry));
  }
  PetscFunctionReturn(0);
}

/* Finds whether the file has this key of an entry. */
PetscErrorCode SceneHasKey(SceneKeys keys, const char owner[], const char name[], PetscBool *has)
{
  const char *text;

  PetscFunctionBegin;
  PetscCall(SceneKeysGet(keys, PETSC_FALSE, &text, "%s_%s", owner, name));
  *has = (PetscBool)(text != NULL);
  PetscFunctionReturn(0);
}

/* Records an error unless an entry has exactly one of two keys. kind: what the entry is, for the message. */
PetscErrorCode SceneHasOneOf(SceneKeys keys, const char owner[], const char kind[], const char first[],
  const char second[], PetscBool *has_second)
{
  PetscBool has_first = PETSC_FALSE;

  PetscFunctionBegin;
  PetscCall(SceneHasKey(keys, owner, first, &has_first));
  PetscCall(SceneHasKey(keys, owner, second, has_second));
  if (has_first && *has_second)
    PetscCall(SceneKeysError(keys, owner, NULL, "has %s and %s; a %s has one of the two", first, second, kind));
  if (!has_first && !*has_second)
    PetscCall(SceneKeysError(keys, owner, NULL, "has neither %s nor %s; a %s has one of the two", first, second, kind));
  PetscFunctionReturn(0);
}

/*
   Reads the entries of a list and appends them to *entries. Each entry is first set to the initial value of the list
   and gets its name.
*/
PetscErrorCode SceneReadList(SceneKeys keys, Scene scene, const SceneList *list, PetscInt *n, void *entries)
{
  PetscInt nnames;
  char   **names;

  PetscFunctionBegin;
  PetscCall(SceneGetNames(keys, list->name, list->required, &nnames, &names));
  PetscCall(PetscRealloc((size_t)(*n + nnames) * list->size, entries));
  for (PetscInt i = 0; i < nnames; ++i) {
    char  owner[SCENE_KEY_LENGTH];
    char *entry = *(char **)entries + (size_t)(*n)++ * list->size;

    PetscCall(PetscMemzero(entry, list->size));
    if (list->initial) PetscCall(PetscMemcpy(entry, list->initial, list->size));
    PetscCall(PetscSNPrintf(owner, sizeof(owner), "%s_%s", list->name, names[i]));
    ((SceneEntry *)entry)->name  = names[i];
    ((SceneEntry *)entry)->place = SceneGetPlace(&keys->places, owner);
    PetscCall(SceneReadRows(keys, scene, owner, list->rows, NULL, entry));
    keys->list = list;
    if (list->finish) PetscCall(list->finish(keys, scene, owner, entry));
  }
  PetscCall(PetscFree(names));
  PetscFunctionReturn(0);
}

static PetscBool RowIsText(const SceneKey *row)
{
  return (PetscBool)(row->type == SCENE_TEXT || row->type == SCENE_EXPRESSION);
}

static size_t RowSize(const SceneKey *row)
{
  switch (row->type) {
  case SCENE_REALS: return row->n * sizeof(PetscReal);
  case SCENE_CHOICE:
  case SCENE_ANSWER: return sizeof(PetscEnum);
  default: return row->n * sizeof(PetscInt);
  }
}

/*
   Returns whether a value is printed. A value that is equal to the initial value is not printed unless the row is
   SCENE_SHOWN or SCENE_REQUIRED.
*/
static PetscBool RowIsShown(const SceneKey *row, const void *entry, const void *initial)
{
  const char *value = (const char *)entry + row->at;

  if (row->type == SCENE_SECTION) return PETSC_FALSE;
  if (row->type == SCENE_OWN) return row->own->shown(entry);
  if (RowIsText(row)) return (PetscBool)(*(char *const *)value != NULL);
  if (row->type == SCENE_BODY) return (PetscBool)(*(const PetscInt *)value >= 0);
  if (row->need != SCENE_OPTIONAL) return PETSC_TRUE;
  if (row->type == SCENE_REALS && row->n == 1 && *(const PetscReal *)value >= PETSC_INFINITY) return PETSC_FALSE;
  if (initial) return (PetscBool)(memcmp(value, (const char *)initial + row->at, RowSize(row)) != 0);
  for (size_t i = 0; i < RowSize(row); ++i) {
    if (value[i]) return PETSC_TRUE;
  }
  return PETSC_FALSE;
}

static PetscErrorCode RowView(Scene scene, PetscViewer viewer, const SceneKey *row, const void *entry)
{
  const void     *value = (const char *)entry + row->at;
  const PetscInt *n     = (const PetscInt *)value;

  PetscFunctionBegin;
  switch (row->type) {
  case SCENE_REALS:
    if (row->n == 1) PetscCall(SceneViewReal(viewer, *(const PetscReal *)value));
    else PetscCall(SceneViewList(viewer, row->n, (const PetscReal *)value));
    break;
  case SCENE_INTS:
    for (PetscInt i = 0; i < row->n; ++i)
      PetscCall(PetscViewerASCIIPrintf(viewer, "%s%" PetscInt_FMT "%s",
        row->n == 1 ? ""
        : i         ? ", "
                    : "[",
        n[i], row->n > 1 && i == row->n - 1 ? "]" : ""));
    break;
  case SCENE_ANSWER: PetscCall(PetscViewerASCIIPrintf(viewer, *(const PetscBool *)value ? "true" : "false")); break;
  case SCENE_CHOICE: PetscCall(PetscViewerASCIIPrintf(viewer, "%s", row->names[*(const PetscEnum *)value])); break;
  case SCENE_AXIS: PetscCall(PetscViewerASCIIPrintf(viewer, "%s", row->names[*n])); break;
  case SCENE_TEXT: PetscCall(PetscViewerASCIIPrintf(viewer, "%s", *(char *const *)value)); break;
  case SCENE_EXPRESSION: PetscCall(PetscViewerASCIIPrintf(viewer, "\"%s\"", *(char *const *)value)); break;
  case SCENE_BODY: PetscCall(PetscViewerASCIIPrintf(viewer, "%s", scene->bodies[*n].name)); break;
  case SCENE_RAMP: PetscCall(PetscViewerASCIIPrintf(viewer, "%s", scene->ramps[*n].name)); break;
  case SCENE_OWN: PetscCall(row->own->view(scene, viewer, entry)); break;
  case SCENE_SECTION: break;
  }
  PetscFunctionReturn(0);
}

/* Prints a row if its value is to be printed. */
PetscErrorCode SceneViewRow(Scene scene, PetscViewer viewer, const SceneKey *row, const void *entry,
  const void *initial)
{
  PetscFunctionBegin;
  if (!RowIsShown(row, entry, initial)) PetscFunctionReturn(0);
  PetscCall(PetscViewerASCIIPrintf(viewer, "%s: ", row->name));
  PetscCall(PetscViewerASCIIUseTabs(viewer, PETSC_FALSE));
  PetscCall(RowView(scene, viewer, row, entry));
  PetscCall(PetscViewerASCIIPrintf(viewer, "\n"));
  PetscCall(PetscViewerASCIIUseTabs(viewer, PETSC_TRUE));
  PetscFunctionReturn(0);
}

/* Prints the rows that apply to `kind`. */
PetscErrorCode SceneViewRows(Scene scene, PetscViewer viewer, const SceneKey rows[], const char kind[],
  const void *entry, const void *initial)
{
  PetscFunctionBegin;
  for (const SceneKey *row = rows; row->name; ++row) {
    if (SceneRowIsOf(row, kind)) PetscCall(SceneViewRow(scene, viewer, row, entry, initial));
  }
  PetscFunctionReturn(0);
}

static PetscErrorCode EntryView(Scene scene, PetscViewer viewer, const SceneList *list, const void *entry)
{
  const char *between = "";

  PetscFunctionBegin;
  PetscCall(PetscViewerASCIIPrintf(viewer, "- %s: {", *(char *const *)entry));
  PetscCall(PetscViewerASCIIUseTabs(viewer, PETSC_FALSE));
  for (const SceneKey *row = list->rows; row->name; ++row) {
    if (!RowIsShown(row, entry, list->initial) || (list->hides && list->hides(entry, row->name))) continue;
    PetscCall(PetscViewerASCIIPrintf(viewer, "%s%s: ", between, row->name));
    PetscCall(RowView(scene, viewer, row, entry));
    between = ", ";
  }
  PetscCall(PetscViewerASCIIPrintf(viewer, "}\n"));
  PetscCall(PetscViewerASCIIUseTabs(viewer, PETSC_TRUE));
  PetscFunctionReturn(0);
}

/* Prints the entries that belong to the list, under the name of the list. */
PetscErrorCode SceneViewEntries(Scene scene, PetscViewer viewer, const SceneList *list, PetscInt n, const void *entries)
{
  PetscBool any = PETSC_FALSE;

  PetscFunctionBegin;
  for (PetscInt i = 0; i < n; ++i) {
    const void *entry = (const char *)entries + (size_t)i * list->size;

    if (list->holds && !list->holds(entry)) continue;
    if (!any) PetscCall(PetscViewerASCIIPrintf(viewer, "%s:\n", list->name));
    any = PETSC_TRUE;
    PetscCall(PetscViewerASCIIPushTab(viewer));
    PetscCall(EntryView(scene, viewer, list, entry));
    PetscCall(PetscViewerASCIIPopTab(viewer));
  }
  PetscFunctionReturn(0);
}

/* Frees the texts that were allocated for the rows, including the name of an entry. */
PetscErrorCode SceneFreeRows(const SceneKey rows[], void *entry)
{
  PetscFunctionBegin;
  for (const SceneKey *row = rows; row->name; ++row) {
    char         **text = (char **)((char *)entry + row->at);
    const PetscInt n    = RowIsText(row) ? 1 : row->type == SCENE_OWN ? row->own->ntexts : 0;

    for (PetscInt i = 0; i < n; ++i) PetscCall(PetscFree(text[i]));
  }
  PetscFunctionReturn(0);
}
