#ifndef RUN_H
#define RUN_H

#include "src/state/stateimpl.h"

/*
   State of the progress report of a run: the time of the last printed line, and data for the estimate of the remaining
   time. All times are wall clock times [s].
*/
struct _n_Progress {
  PetscReal      every;    /* interval between printed lines; 0: nothing is printed */
  PetscReal      residual; /* first residual of the current linear solve */
  PetscInt       nsteps;   /* number of load steps that this run has solved completely */
  PetscBool      follows;  /* whether another mesh may follow, so that the remaining time is not known */
  PetscBool      whole;    /* true if the current load step was started in this run; false if a restart began within
                              it */
  PetscLogDouble begun, said;
  PetscLogDouble last[4]; /* durations of the last complete load steps (ring buffer) */
};

/*
   Data of adapt.c for runs whose next mesh may be refined. errors: squared error of each cell of this rank, summed over
   the load steps; marked: true for cells to refine.
*/
typedef struct {
  PetscReal *errors;
  PetscBool *marked;
} Adapt;

/* Data of a run that do not belong to a single load step. */
struct _n_RunState {
  Progress         progress;
  const MeshMarks *marks; /* where to mark cells for refinement; NULL: no cells are marked */
  Adapt            adapt;
  RunTimes         start; /* clock and PETSc's event times at the start of the run */
};

#endif
