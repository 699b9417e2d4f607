/* Prints the table of keys. */
#include "sceneimpl.h"
#include <petscviewer.h>
#include <string.h>

/* Describes the type of a key in words, for example: three numbers [L]. */
static PetscErrorCode KeyDescribeType(const SceneKey *row, char type[], size_t length)
{
  static const char *const counts[] = {"", "a ", "two ", "three "};
  const char              *what     = row->type == SCENE_REALS ? "number" : "whole number";

  PetscFunctionBegin;
  type[0] = 0;
  if (row->type == SCENE_REALS || row->type == SCENE_INTS)
    PetscCall(PetscSNPrintf(type, length, "%s%s%s%s", counts[row->n], what, row->n > 1 ? "s" : "",
      row->range == SCENE_ABOVE_0     ? " above 0"
      : row->range == SCENE_FROM_0    ? ", not negative"
      : row->range == SCENE_UNBOUNDED ? " or `inf`"
                                      : ""));
  else if (row->type == SCENE_ANSWER) PetscCall(PetscStrncpy(type, "`true` or `false`", length));
  else if (row->type == SCENE_TEXT) PetscCall(PetscStrncpy(type, "a text", length));
  else if (row->type == SCENE_EXPRESSION) PetscCall(PetscStrncpy(type, "an expression", length));
  else if (row->type == SCENE_BODY) PetscCall(PetscStrncpy(type, "a body's name", length));
  else if (row->type == SCENE_RAMP) PetscCall(PetscStrncpy(type, "a ramp's name", length));
  else if (row->type == SCENE_OWN) PetscCall(PetscStrncpy(type, "see meaning", length));
  for (PetscInt i = 0; (row->type == SCENE_CHOICE || row->type == SCENE_AXIS) && row->names[i + 2]; ++i) {
    PetscCall(PetscStrlcat(type, i ? ", `" : "`", length));
    PetscCall(PetscStrlcat(type, row->names[i], length));
    PetscCall(PetscStrlcat(type, "`", length));
  }
  if (!row->unit[0]) PetscFunctionReturn(0);
  PetscCall(PetscStrlcat(type, " [", length));
  PetscCall(PetscStrlcat(type, row->unit, length));
  PetscCall(PetscStrlcat(type, "]", length));
  PetscFunctionReturn(0);
}

static PetscErrorCode KeyView(const SceneKey *row, PetscViewer viewer)
{
  char type[256], of[256] = "";

  PetscFunctionBegin;
  PetscCall(KeyDescribeType(row, type, sizeof(type)));
  for (const char *c = row->of ? row->of : ""; *c; ++c) {
    const size_t length = strlen(of);

    (void)snprintf(of + length, sizeof(of) - length, *c == ' ' ? ", " : "%c", *c);
  }
  PetscCall(PetscViewerASCIIPrintf(viewer, "| `%s` | %s | %s | %s | %s |\n", row->name, of, type, row->help,
    row->otherwise[0] || row->need != SCENE_REQUIRED ? row->otherwise : "required"));
  PetscFunctionReturn(0);
}

/*@C
   SceneViewKeys - Prints the keys of the scene file, list by list, as tables of Markdown

   Collective on the viewer

   Input Parameter:
.  viewer - an ASCII viewer

   Level: intermediate

   Note:
   share/scenes/README.md has these tables. Units: F a force, L a length, T a time, M a mass.

.seealso: `SceneLoad()`
@*/
PetscErrorCode SceneViewKeys(PetscViewer viewer)
{
  PetscFunctionBegin;
  for (const SceneList *list = SceneLists; list->name; ++list) {
    PetscCall(PetscViewerASCIIPrintf(viewer,
      "%s### Keys: %s\n\n| key | of | type | meaning | default |\n| --- | --- | --- | --- | --- |\n",
      list == SceneLists ? "" : "\n", list->name[0] ? list->name : "top level"));
    for (const SceneKey *row = list->rows; row->name; ++row) PetscCall(KeyView(row, viewer));
  }
  PetscCall(SceneViewConstantKeys(viewer));
  PetscCall(SceneViewShapeKeys(viewer));
  PetscFunctionReturn(0);
}
