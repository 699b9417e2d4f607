/*
   Checkpoints, private: what the file that is written and read has in common.
*/
#ifndef CHECKPOINTIMPL_H
#define CHECKPOINTIMPL_H

#include <checkpoint.h>
#include <scene.h>
#include "src/output/outputimpl.h"

/* read.c, write.c: numbers of a checkpoint that are attributes of its file; NULL ends them */
typedef struct {
  const char *name;
  size_t      offset;
} CheckpointNumberField;

PETSC_INTERN const CheckpointNumberField CheckpointNumbers[];
PETSC_INTERN PetscReal                  *CheckpointNumber(Checkpoint, size_t i);

#endif
