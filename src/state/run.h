#ifndef RUN_H
#define RUN_H

#include "src/state/stateimpl.h"

/* Progress report of a run: when it last printed, and what the estimate uses; times are wall clock [s] */
struct _n_Progress {
  PetscReal      every;    /* 0: never */
  PetscReal      residual; /* first residual of the current linear solve */
  PetscInt       nsteps;   /* whole load steps finished so far */
  PetscBool      whole;    /* the current load step was started in this run (not restarted within it) */
  PetscLogDouble begun, said;
  PetscLogDouble last[4]; /* durations of the last whole load steps (ring buffer) */
};

/* adapt.c, for runs whose next mesh may be refined: squared errors of this rank's cells, summed over load steps, and
   the cells to refine */
typedef struct {
  PetscReal *errors;
  PetscBool *marked;
} Adapt;

/* The run around the load steps */
struct _n_RunState {
  Progress         progress;
  const MeshMarks *marks; /* NULL: cells are not marked for refinement */
  Adapt            adapt;
  RunTimes         start; /* clock and PETSc's event times at the start of the run */
};

#endif
