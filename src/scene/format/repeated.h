/* Detection of repeated keys: repeated.c processes the events of libyaml before the text is read */
#ifndef REPEATED_H
#define REPEATED_H

#include "formatimpl.h"
#include <yaml.h>

/* An open mapping or list */
typedef struct {
  PetscBool mapping;
  size_t    length; /* length of the path of its key */
  size_t    line;
  PetscInt  n; /* nodes in it so far; in a mapping keys and values */
} RepeatedLevel;

/* Initialize with zeros */
typedef struct {
  PetscInt       depth, maxdepth, n, max;
  RepeatedLevel *levels;
  char          *path, **paths; /* path of the last key; paths of all keys */
  size_t         length, room;  /* of the path, and allocated length */
  size_t         line, *lines;  /* line of the last key; lines of all keys */
} RepeatedKeys;

/* repeated.c. Not collective: process every event in turn, then check for repeated keys */
PETSC_INTERN PetscErrorCode RepeatedKeysRead(RepeatedKeys *, const yaml_event_t *);
PETSC_INTERN PetscErrorCode RepeatedKeysCheck(RepeatedKeys *);
PETSC_INTERN void           RepeatedKeysGetLines(RepeatedKeys *, SceneKeyLines *);
PETSC_INTERN PetscErrorCode RepeatedKeysDestroy(RepeatedKeys *);

#endif
