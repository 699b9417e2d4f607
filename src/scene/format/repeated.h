/* Keys that stand twice in the text of a scene: what repeated.c asks of the events of libyaml, which has them before
   PETSc reads the text */
#ifndef REPEATED_H
#define REPEATED_H

#include "formatimpl.h"
#include <yaml.h>

/* A mapping or a list that is open */
typedef struct {
  PetscBool mapping;
  size_t    length; /* of the path of its key */
  size_t    line;
  PetscInt  n; /* nodes in it so far; of a mapping keys and values */
} RepeatedLevel;

/* Begins as zeros */
typedef struct {
  PetscInt       depth, maxdepth, n, max;
  RepeatedLevel *levels;
  char          *path, **paths; /* of the last key; of all */
  size_t         length, room;  /* of the path, and what was allocated */
  size_t         line, *lines;  /* of the last key; of all */
} RepeatedKeys;

/* repeated.c. Not collective: every event in turn, then an error if a key stands twice */
PETSC_INTERN PetscErrorCode RepeatedKeysRead(RepeatedKeys *, const yaml_event_t *);
PETSC_INTERN PetscErrorCode RepeatedKeysCheck(RepeatedKeys *);
PETSC_INTERN void           RepeatedKeysGetLines(RepeatedKeys *, SceneKeyLines *);
PETSC_INTERN PetscErrorCode RepeatedKeysDestroy(RepeatedKeys *);

#endif
