/*
   Compares a scene with the text of another scene. What may differ between two runs of the same simulation is ignored.
*/
#define _POSIX_C_SOURCE 200809L /* for open_memstream() */
#include "sceneimpl.h"
#include <petscviewer.h>
#include <stdlib.h>
#include <string.h>

/* Keys of the top level that may differ, since they determine how a simulation continues and how it is solved. So may
   the end time of `dynamics`. */
static const char *const free_keys[] = {"problem", "units", "probes", "load", "ramps", "refine", "refinements", "model",
  "contact_updates", "displacement_bounds", "solver"};

/* Gets the scene as text, as SceneView() prints it. *text: the text, which the caller frees with PetscFree(). */
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
  const char *next;                           /* beginning of the next line */
  char        line[512], top[64], entry[128]; /* line: the current line; top: key of the top level, and entry: name
                                                 of the list entry, that contain this line */
} SceneLines;

/* Advances to the next line that is compared. Returns false at the end of the text. */
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
    if (!strcmp(lines->top, "dynamics") && !strncmp(lines->line + indent, "end_time:", 9)) counts = PETSC_FALSE;
    if (counts) return PETSC_TRUE;
  }
  return PETSC_FALSE;
}

static const char *SceneLinesSay(const SceneLines *lines, PetscBool there)
{
  return there ? lines->line + strspn(lines->line, " ") : "nothing";
}

/*
   Compares a scene with the text of another scene, which SceneGetText() has returned. difference: description of the
   first difference; "" if there is none; length: size of `difference`. Load programs, end times, refinement, probes,
   model and solver options are not compared.
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

    PetscCall(PetscSNPrintf(difference, length, "%s%s: the scene has %s, the checkpoint %s", where->top, where->entry,
      SceneLinesSay(&here, more[0]), SceneLinesSay(&there, more[1])));
  }
  PetscCall(PetscFree(own));
  PetscFunctionReturn(0);
}
