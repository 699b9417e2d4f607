/* Reads the words of a scene's units, for example "mm, N, MPa" */
#include "modelimpl.h"
#include <string.h>

typedef struct {
  const char *word;
  UnitKind    kind;
  PetscReal   si;
} UnitWord;

static const UnitWord units[] = {
  {"m", UNIT_LENGTH, 1.0},
  {"dm", UNIT_LENGTH, 1e-1},
  {"cm", UNIT_LENGTH, 1e-2},
  {"mm", UNIT_LENGTH, 1e-3},
  {"um", UNIT_LENGTH, 1e-6},
  {"nm", UNIT_LENGTH, 1e-9},
  {"in", UNIT_LENGTH, 0.0254},
  {"mN", UNIT_FORCE, 1e-3},
  {"N", UNIT_FORCE, 1.0},
  {"kN", UNIT_FORCE, 1e3},
  {"MN", UNIT_FORCE, 1e6},
  {"lbf", UNIT_FORCE, 4.4482216152605},
  {"Pa", UNIT_STRESS, 1.0},
  {"kPa", UNIT_STRESS, 1e3},
  {"MPa", UNIT_STRESS, 1e6},
  {"N/mm^2", UNIT_STRESS, 1e6},
  {"GPa", UNIT_STRESS, 1e9},
  {"psi", UNIT_STRESS, 6894.757293168},
  {"ms", UNIT_TIME, 1e-3},
  {"s", UNIT_TIME, 1.0},
  {NULL, UNIT_LENGTH, 0.0},
};

/*@C
   UnitsFind - Finds the unit of a kind among the words of a scene's units

   Not Collective

   Input Parameters:
+  text - the units, for example "mm, N, MPa"; NULL: none
-  kind - length, force, stress or time

   Output Parameter:
.  si - the unit in m, N, Pa or s; 0 if there is none. May be NULL

   Returns:
   the word, or "" if the text has no known unit of this kind

   Level: intermediate

.seealso: `SceneLoad()`
@*/
const char *UnitsFind(const char text[], UnitKind kind, PetscReal *si)
{
  if (si) *si = 0.0;
  for (const char *word = text; word && *word;) {
    const size_t length = strcspn(word, ", ;");

    for (const UnitWord *unit = units; unit->word; ++unit) {
      if (unit->kind != kind || strlen(unit->word) != length || strncmp(unit->word, word, length)) continue;
      if (si) *si = unit->si;
      return unit->word;
    }
    word += length;
    word += strspn(word, ", ;");
  }
  return "";
}
