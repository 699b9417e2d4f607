/* What a run goes on from: taken and put back by src/step, written and read by src/output. */
#ifndef CHECKPOINT_H
#define CHECKPOINT_H

#include <petscdmplex.h>
#include "model.h"

/* At the vertices that a rank owns, in the order of the global vectors */
typedef struct {
  char       name[128];
  PetscInt   components;
  PetscReal *values;
} CheckpointField;

typedef struct _n_Checkpoint {
  PetscInt         step;          /* load step that is under way or comes next, from 0 */
  PetscReal        time;          /* of the state; load step k ends at time k */
  PetscReal        previous_time; /* of the state before it */
  PetscReal        increment;     /* of time, that a load step under way was tried with; 0: all that is left of it */
  PetscReal        largest_increment; /* of any displacement so far [length] */
  PetscReal        work;              /* of the forces from outside [force length] */
  PetscReal        contact_work;      /* of those in the contacts where pairs rub [force length] */
  PetscInt         nfields;
  CheckpointField *fields;
} * Checkpoint;

/* What is kept of every contact pair at its vertices */
typedef enum {
  CHECKPOINT_PRESSURE,
  CHECKPOINT_SLACK,
  CHECKPOINT_SHEAR,
  CHECKPOINT_FRICTION,
  CHECKPOINT_SLIP_PATH,
  CHECKPOINT_DISSIPATED,
  CHECKPOINT_PAIR_FIELDS
} CheckpointPairKind;

typedef struct {
  const char *name; /* the pair's follows */
  PetscInt    components;
  PetscBool
    sum; /* over vertices, as a force is: on another mesh it stays where it is, in place of being interpolated */
  PetscBool friction; /* of pairs that have it alone */
} CheckpointPairField;
PETSC_EXTERN const CheckpointPairField CheckpointPairFields[CHECKPOINT_PAIR_FIELDS];
/* kept: whether the pair has this field, and under which name */
PETSC_EXTERN PetscErrorCode CheckpointNamePairField(const SceneContactPair *, CheckpointPairKind, size_t length,
  char name[], PetscBool *kept);

/* A name's length is cut where it is too long for a field */
PETSC_EXTERN PetscErrorCode CheckpointAddField(Checkpoint, const char name[], PetscInt components, PetscInt nvertices,
  PetscReal **values);
PETSC_EXTERN PetscErrorCode CheckpointGetField(Checkpoint, const char name[], const PetscReal **values);
PETSC_EXTERN PetscErrorCode CheckpointCheck(MPI_Comm, Checkpoint);
PETSC_EXTERN PetscErrorCode CheckpointDestroy(Checkpoint *);

/* Writes states of one simulation to one file. Atomically: that which was there stays until the next is safe on the
   disk */
typedef struct _n_CheckpointWriter *CheckpointWriter;

PETSC_EXTERN PetscErrorCode CheckpointWriterCreate(Scene, DM, const char file[], CheckpointWriter *);
PETSC_EXTERN PetscErrorCode CheckpointWriterWrite(CheckpointWriter, Checkpoint);
PETSC_EXTERN PetscErrorCode CheckpointWriterDestroy(CheckpointWriter *);
/* On any mesh of the same bodies. same: its vertices are those of the file in the same order; an error where the file
   is of another scene */
PETSC_EXTERN PetscErrorCode CheckpointRead(Scene, DM, const char file[], Checkpoint *, PetscBool *same);

#endif
