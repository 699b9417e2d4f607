/* Names the entries of a list in messages: an entry of bodies is a body. */
#include "formatimpl.h"
#include <string.h>
#include <strings.h>

/* Words for an entry of a list, and the list. The first word of a list is the one that messages use. */
static const char *const kinds[][2] = {{"body", "bodies"}, {"contact pair", "contact"}, {"contact pairs", "contact"},
  {"contact rule", "contact"}, {"displacement", "displacements"}, {"displacements", "displacements"},
  {"pressure", "pressures"}, {"traction", "tractions"}, {"force", "forces"}, {"spring", "springs"}, {"bolt", "bolts"},
  {"connector", "connectors"}, {"tie", "ties"}, {"cyclic symmetry", "cyclic"}, {"temperature", "temperatures"},
  {"refinement", "refinements"}, {"ramp", "ramps"}, {"ramp name", "ramps"}, {"material", "materials"},
  {"material name", "materials"}, {"face", "faces"}, {"symmetry plane", "symmetry"}, {"body force", "body_forces"},
  {"probe", "probes"}};

const char *SceneKindOf(const char list[])
{
  for (size_t k = 0; k < PETSC_STATIC_ARRAY_LENGTH(kinds); ++k) {
    if (!strcasecmp(list, kinds[k][1])) return kinds[k][0];
  }
  return list;
}

/* Returns the list to whose entries the last word before `end` refers, for example bodies for body; NULL: none. */
const char *SceneListOf(const char text[], const char *end)
{
  for (size_t k = 0; k < PETSC_STATIC_ARRAY_LENGTH(kinds); ++k) {
    const size_t length = strlen(kinds[k][0]);
    const char  *at     = end - length;

    if (at >= text && !strncasecmp(at, kinds[k][0], length) && (at == text || at[-1] == ' ')) return kinds[k][1];
  }
  return NULL;
}
