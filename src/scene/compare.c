/* Compares a scene with the text of another one, ignoring what may change between two runs of the same simulation. */
#define _POSIX_C_SOURCE 200809L /* open_memstream() */
#include "sceneimpl.h"
#include <petscviewer.h>
#include <stdlib.h>
#include <string.h>

/* Top level keys that may differ: they concern how a simulation continues, and how it is solved */
static const char *const free_keys[] = {"problem", "units", "probes", "load", "ramps", "refine", "refinements", "model",
  "contact_updates", "displacement_bounds", "solver"};

/* Gets the scene as text, as SceneView() prints it. text: the text, to be freed with PetscFree(). */
PetscErrorCode SceneGetText(Scene scene, char **text)
{
  PetscViewer viewer;
  char       *buffer = NULL;
  size_t      length = 0;
  FILE       *stream = open_memstream(&buffer, &length);

  PetscFunctionBegin;
  PetscCheck(stream, PETSC_COMM_SELF, PETSC_ERR_MEM, "not enough memory for the text of a scene");
  PetscCall(PetscViewerASCIIOpenWithFILE(PETSC_COMM_SELF, stream, &viewer));
  PetscCall(SceneView(scene, viewer));
  PetscCall(PetscViewerDestroy(&viewer));
  (void)fclose(stream);
  PetscCall(PetscStrallocpy(buffer, text));
  free(buffer);
  PetscFunctionReturn(0);
}

typedef struct {
  const char *next;                           /* start of the next line */
  char        line[512], top[64], entry[128]; /* the current line; the list and the entry that contain it */
} SceneLines;

/* Advances to the next line that is compared; false at the end */
static PetscBool SceneLinesAdvance(SceneLines *lines)
{
  while (*lines->next) {
    const size_t length = strcspn(lines->next, "\n"), indent = strspn(lines->next, " "),
                 kept = PetscMin(length, sizeof(lines->line) - 1);
    PetscBool counts  = PETSC_TRUE;

    memcpy(lines->line, lines->next, kept);
    lines->line[kept] = 0;
    lines->next += length + (lines->next[length] == '\n');
    if (!indent) {
      (void)snprintf(lines->top, sizeof(lines->top), "%.*s",
        (int)PetscMin(strcspn(lines->line, ":"), sizeof(lines->top) - 1), lines->line);
      lines->entry[0] = 0;
    } else if (lines->line[indent] == '-')
      (void)snprintf(lines->entry, sizeof(lines->entry), " %.*s",
        (int)PetscMin(strcspn(lines->line + indent + 2, ":"), sizeof(lines->entry) - 2), lines->line + indent + 2);
    for (size_t i = 0; i < PETSC_STATIC_ARRAY_LENGTH(free_keys); ++i)
      counts = (PetscBool)(counts && strcmp(lines->top, free_keys[i]));
    if (counts) return PETSC_TRUE;
  }
  return PETSC_FALSE;
}

static const char *SceneLinesSay(const SceneLines *lines, PetscBool there)
{
  return there ? lines->line + strspn(lines->line, " ") : "nothing";
}

/* Compares a scene with the text of another one from SceneGetText(). length: of difference; difference: the first
   difference in words; "" where there is none. Load programs, refinement, probes, model and options are not compared.
   */
PetscErrorCode SceneCompare(Scene scene, const char text[], char difference[], size_t length)
{
  SceneLines here = {.line = ""}, there = {.line = ""};
  char      *own;
  PetscBool  more[2], same = PETSC_TRUE;

  PetscFunctionBegin;
  PetscCall(SceneGetText(scene, &own));
  here.next     = own;
  there.next    = text;
  difference[0] = 0;
  do {
    more[0] = SceneLinesAdvance(&here);
    more[1] = SceneLinesAdvance(&there);
    same    = (PetscBool)(more[0] == more[1] && (!more[0] || !strcmp(here.line, there.line)));
  } while (same && more[0]);
  if (!same) {
    const SceneLines *where = more[0] ? &here : &there;

    PetscCall(PetscSNPrintf(difference, length, "%s%s: the scene has %s where it had %s", where->top, where->entry,
      SceneLinesSay(&here, more[0]), SceneLinesSay(&there, more[1])));
  }
  PetscCall(PetscFree(own));
  PetscFunctionReturn(0);
}
