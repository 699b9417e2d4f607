/*
   Private header of checkpoints: what reading and writing have in common.
*/
#ifndef CHECKPOINTIMPL_H
#define CHECKPOINTIMPL_H

#include <checkpoint.h>
#include <scene.h>
#include <elasticity.h>
#include "src/output/outputimpl.h"

/* fields.c: a field with all that is known of it; one that is not there is an error */
PETSC_INTERN PetscErrorCode CheckpointFindField(Checkpoint, const char name[], const CheckpointField **);

/* plastic.c: the plastic strains at the quadrature points, and where these are; read in any parts by the ranks */
#define CHECKPOINT_PLASTIC_PLACES      "plastic_places"
#define CHECKPOINT_PLASTIC             "plastic_history"
#define CHECKPOINT_PLASTIC_DEFORMATION "plastic_deformation"
/* 0: no law yields; 1: plastic strains are kept; 2: and plastic deformations */
PETSC_INTERN int            CheckpointPlasticParts(Scene);
PETSC_INTERN PetscErrorCode CheckpointAddPlastic(Scene, Elasticity, Checkpoint);
PETSC_INTERN PetscErrorCode CheckpointGetPlastic(Scene, MPI_Comm, Elasticity, Checkpoint);

/* read.c, write.c: numbers of a checkpoint, stored as attributes of its file; ends with a NULL name */
typedef struct {
  const char *name;
  size_t      offset;
} CheckpointNumberField;

PETSC_INTERN const CheckpointNumberField CheckpointNumbers[];
PETSC_INTERN PetscReal                  *CheckpointNumber(Checkpoint, size_t i);

#endif
