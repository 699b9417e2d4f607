/* Detection of repeated keys. repeated.c processes the events of libyaml before the text is read. */
#ifndef REPEATED_H
#define REPEATED_H

#include "formatimpl.h"
#include <yaml.h>

/* Mapping or list that has not ended. */
typedef struct {
  PetscBool mapping;
  size_t    length; /* length of the path of its key */
  size_t    line;
  PetscInt  n; /* number of nodes in it so far; in a mapping keys and values are counted */
} RepeatedLevel;

/* Keys that have been read so far. Initialize with zeros. */
typedef struct {
  PetscInt       depth, maxdepth, n, max;
  RepeatedLevel *levels;
  char          *path, **paths;    /* path of the last key, and paths of all keys */
  size_t         length, capacity; /* length of `path`, and its allocated length */
  size_t         line, *lines;     /* line of the last key, and lines of all keys */
} RepeatedKeys;

/* repeated.c: Not collective. Pass each event to RepeatedKeysRead() in turn, then call RepeatedKeysCheck() */
PETSC_INTERN PetscErrorCode RepeatedKeysRead(RepeatedKeys *, const yaml_event_t *);
PETSC_INTERN PetscErrorCode RepeatedKeysCheck(RepeatedKeys *);
PETSC_INTERN PetscErrorCode RepeatedKeysGetPlaces(RepeatedKeys *, const char file[], ScenePlaces *);
PETSC_INTERN PetscErrorCode RepeatedKeysDestroy(RepeatedKeys *);

#endif
