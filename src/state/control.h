#ifndef CONTROL_H
#define CONTROL_H

#include "src/state/stateimpl.h"

/* Callbacks that run/progress.c sets; each may be NULL. */
typedef struct {
  PetscErrorCode (*begin)(Simulation);  /* called before a load step */
  PetscErrorCode (*reach)(Simulation);  /* called after each converged attempt */
  PetscErrorCode (*within)(Simulation); /* called often within iterations; must not communicate */
  PetscErrorCode (*optimizer)(Tao, void *);
  PetscErrorCode (*linear)(KSP, PetscInt, PetscReal, void *);
} StepObserver;

/* Data of controlled time steps within a load step */
typedef struct {
  PetscInt  closed;   /* number of vertices under pressure at the last state */
  PetscInt  rejected; /* number of time steps that were repeated because of their error */
  PetscBool too_long; /* whether the last attempt was such a time step */
  PetscReal error;    /* error of the last attempt */
  PetscReal largest;  /* largest error of the accepted time steps */
  PetscReal shortest; /* length of the shortest accepted time step, as a fraction of the load step */
} TimeStepControl;

/* A failed attempt */
typedef struct {
  char     *reason; /* why it failed; NULL if no attempt has failed */
  PetscBool gap_unconverged;
  PetscInt  unsupported;
} StepFailure;

/* Settings for the solution of load steps, and the reasons for which load steps have failed. */
struct _n_StepControl {
  StepTolerances  tolerances; /* updated with the options of the solvers as soon as these have been read */
  PetscBool       warm;       /* true if load steps start from the extrapolated path and from the pressures of the
                                last load step */
  PetscBool       monitor;    /* true if cuts of load steps and contact updates are printed */
  PetscInt        maxcuts;    /* largest number of cuts in a load step */
  PetscInt        first_step; /* first load step of this run, counted from 0; positive after a restart */
  PetscReal       increment;  /* time increment of the next attempt within the current load step; 0: the rest of the
                                load step */
  TimeStepControl time_step;
  KSP             ksp; /* linear solver for quadratic load steps without contact; NULL until it is needed */
  StepObserver    observer;
  PetscBool       lost_contact; /* true after a warning of a body that has lost contact */
  PetscInt        unsupported;  /* number of consecutive attempts at this load step that failed because contact cannot
                                 hold the loads; a proven failure counts 2 */
  char           *cause;        /* reason for which the first of these attempts failed; NULL if there was none */
  PetscInt        dual_tried;   /* number of the last load step that was tried with dual shape functions, from 1;
                                     0: none */
  StepFailure     failure;      /* the failed attempt that is repeated with them */
  int             interrupted;  /* signal that was caught; 0: none */
};

/* Returns the relative tolerance to which solves are repeated that take a load, a term or a rotation at the solution
   before: a thousandth of the optimizer's, above rounding errors. */
static inline PetscReal StepControlRepeats(const StepControl *control)
{
  return PetscMax(1e-3 * control->tolerances.optimizer, 1e-12);
}

#define STEP_MAX_REPEATS 50 /* largest number of such solves */

/* a few rounding errors of positions, relative to the coordinates */
#define STEP_PLACE_ROUNDING (32.0 * PETSC_MACHINE_EPSILON)

#endif
