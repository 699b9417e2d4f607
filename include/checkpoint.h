/* The state from which a run is restarted. src/run gets and sets it; src/checkpoint writes and reads it. */
#ifndef CHECKPOINT_H
#define CHECKPOINT_H

#include <petscdmplex.h>
#include "model.h"

/* A field of values at the vertices that a rank owns, in the order of global vectors, or of n records of another
   kind */
typedef struct {
  char       name[128];
  PetscInt   n, components;
  PetscReal *values;
} CheckpointField;

typedef struct _n_Checkpoint {
  PetscInt         step;          /* load step in progress, or the next one; from 0 */
  PetscReal        time;          /* time of the state; load step k ends at time k */
  PetscReal        previous_time; /* time of the last state but one */
  PetscReal        increment;     /* time increment that a load step in progress tries; 0: the rest of the load step */
  PetscReal        largest_increment; /* of any displacement so far [length] */
  PetscReal        work;              /* work of the external forces [force length] */
  PetscReal        contact_work;      /* work taken up by contact pairs with friction [force length] */
  PetscReal        largest_speed;     /* in dynamics with controlled time steps, so far: a norm by mass */
  PetscReal        damping_work;      /* in dynamics: work taken up by damping [force length] */
  PetscReal       *shortening;        /* of each bolt [length] */
  PetscInt         nfields;
  CheckpointField *fields;
} * Checkpoint;

/* Contact history: what is kept of every contact pair at its vertices */
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
  const char *name; /* NULL: field of the contact pairs, named after the pair */
  PetscInt    components;
  PetscBool   sum;      /* a sum over vertices, like a force: on another mesh it is transferred, not interpolated */
  PetscBool   friction; /* only for pairs with friction */
} CheckpointPairField;
PETSC_EXTERN const CheckpointPairField CheckpointPairFields[CHECKPOINT_PAIR_FIELDS];
/* kept: whether the pair has this field; and the name of the field */
PETSC_EXTERN PetscErrorCode CheckpointNamePairField(const SceneContactPair *, CheckpointPairKind, size_t length,
  char name[], PetscBool *kept);

/* Name of a field in the file; too long names are cut */
PETSC_EXTERN PetscErrorCode CheckpointAddField(Checkpoint, const char name[], PetscInt components, PetscInt nvertices,
  PetscReal **values);
PETSC_EXTERN PetscErrorCode CheckpointGetField(Checkpoint, const char name[], const PetscReal **values);
PETSC_EXTERN PetscErrorCode CheckpointCheck(MPI_Comm, Checkpoint);
PETSC_EXTERN PetscErrorCode CheckpointDestroy(Checkpoint *);

/* Writes states of one simulation to one file. The old file stays until the new one is safely on disk */
typedef struct _n_CheckpointWriter *CheckpointWriter;

PETSC_EXTERN PetscErrorCode CheckpointWriterCreate(Scene, DM, const char file[], CheckpointWriter *);
PETSC_EXTERN PetscErrorCode CheckpointWriterWrite(CheckpointWriter, Checkpoint);
PETSC_EXTERN PetscErrorCode CheckpointWriterDestroy(CheckpointWriter *);
/* Reads a state onto any mesh of the same bodies. same: its vertices are those of the file in the same order. An error
   if the file belongs to another scene */
PETSC_EXTERN PetscErrorCode CheckpointRead(Scene, DM, const char file[], Checkpoint *, PetscBool *same);

#endif
