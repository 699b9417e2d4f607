/*
   Private header of checkpoints: what reading and writing have in common.
*/
#ifndef CHECKPOINTIMPL_H
#define CHECKPOINTIMPL_H

#include <checkpoint.h>
#include <scene.h>
#include "src/output/outputimpl.h"

/* read.c, write.c: numbers of a checkpoint, stored as attributes of its file; ends with a NULL name */
typedef struct {
  const char *name;
  size_t      offset;
} CheckpointNumberField;

PETSC_INTERN const CheckpointNumberField CheckpointNumbers[];
PETSC_INTERN PetscReal                  *CheckpointNumber(Checkpoint, size_t i);

#endif
