/* The state from which a run is restarted. src/run gets and sets it; src/checkpoint writes and reads it. */
#ifndef CHECKPOINT_H
#define CHECKPOINT_H

#include <petscdmplex.h>
#include "model.h"

/* A field: values at the vertices that a rank owns, in the order of global vectors, or n records of another kind */
typedef struct {
  char       name[128];
  PetscInt   n, components;
  PetscReal *values;
} CheckpointField;

typedef struct _n_Checkpoint {
  PetscInt         step;          /* load step in progress, or the next one; counted from 0 */
  PetscReal        time;          /* time of the state; load step k ends at time k */
  PetscReal        previous_time; /* time of the state before the last one */
  PetscReal        increment;     /* time increment to be tried next within the load step in progress; 0: the rest of
                                     the load step */
  PetscReal        largest_increment; /* largest increment of any displacement component in a load step so far
                                         [length] */
  PetscReal        work;              /* work of the external forces [force length] */
  PetscReal        dual_gaps;         /* 1 if pairs with gap: auto use dual shape functions, else 0 */
  PetscReal        contact_work;      /* work taken up by contact pairs with friction [force length] */
  PetscReal        largest_speed;     /* largest norm of the velocity so far, with the mass; only in dynamics with
                                         controlled time steps */
  PetscReal        damping_work;      /* energy that damping has dissipated; only in dynamics [force length] */
  PetscReal       *shortening;        /* of each bolt [length] */
  PetscInt         nfields;
  CheckpointField *fields;
} * Checkpoint;

/* Contact history: the fields that are stored for every contact pair at its vertices */
typedef enum {
  CHECKPOINT_PRESSURE,
  CHECKPOINT_SLACK,
  CHECKPOINT_SHEAR,
  CHECKPOINT_FRICTION,
  CHECKPOINT_BOUND,
  CHECKPOINT_SLIP_PATH,
  CHECKPOINT_DISSIPATED,
  CHECKPOINT_PAIR_FIELDS
} CheckpointPairKind;

typedef struct {
  const char *name; /* NULL: the field has the name of its contact pair */
  PetscInt    components;
  PetscBool   sum;      /* the values are sums over vertices, like forces; on another mesh they are transferred from
                           node to node, not interpolated */
  PetscBool   friction; /* only pairs with friction have the field */
} CheckpointPairField;
PETSC_EXTERN const CheckpointPairField CheckpointPairFields[CHECKPOINT_PAIR_FIELDS];
/* Gets the name of a field of a contact pair. *kept: whether the pair has this field */
PETSC_EXTERN PetscErrorCode CheckpointNamePairField(const SceneContactPair *, CheckpointPairKind, size_t length,
  char name[], PetscBool *kept);

/* Adds a field to a checkpoint. Names longer than the space for them are truncated. */
PETSC_EXTERN PetscErrorCode CheckpointAddField(Checkpoint, const char name[], PetscInt components, PetscInt nvertices,
  PetscReal **values);
PETSC_EXTERN PetscErrorCode CheckpointGetField(Checkpoint, const char name[], const PetscReal **values);
PETSC_EXTERN PetscErrorCode CheckpointCheck(MPI_Comm, Checkpoint);
PETSC_EXTERN PetscErrorCode CheckpointDestroy(Checkpoint *);

/* Writes the states of one simulation to one file. The previous file remains until the new one is completely on
   disk. */
typedef struct _n_CheckpointWriter *CheckpointWriter;

PETSC_EXTERN PetscErrorCode CheckpointWriterCreate(Scene, DM, const char file[], CheckpointWriter *);
PETSC_EXTERN PetscErrorCode CheckpointWriterWrite(CheckpointWriter, Checkpoint);
PETSC_EXTERN PetscErrorCode CheckpointWriterDestroy(CheckpointWriter *);
/* Reads a state onto any mesh of the same bodies. *same: whether the vertices are those of the file in the same
   order. It is an error if the file belongs to another scene. */
PETSC_EXTERN PetscErrorCode CheckpointRead(Scene, DM, const char file[], Checkpoint *, PetscBool *same);

#endif
