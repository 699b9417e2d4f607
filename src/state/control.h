#ifndef CONTROL_H
#define CONTROL_H

#include "src/state/stateimpl.h"

/* forecast.c: states at the end of load steps on another mesh, interpolated to this one; empty if there is no
   forecast */
typedef struct {
  StepForecast *found; /* given by the caller; NULL: none */
  StepForecast  here;
  PetscBool     used, failed; /* used by the last attempt; failed in any attempt */
} Forecast;

/* Callbacks while a load step is solved (run/progress.c); any may be NULL */
typedef struct {
  PetscErrorCode (*begin)(Simulation); /* called before a load step */
  PetscErrorCode (*reach)(Simulation); /* called after each converged attempt */
  PetscErrorCode (*optimizer)(Tao, void *);
  PetscErrorCode (*linear)(KSP, PetscInt, PetscReal, void *);
} StepObserver;

/* How load steps are solved, and what has stopped them */
struct _n_StepControl {
  StepTolerances tolerances; /* updated with the solvers' options once these have been read */
  PetscBool      warm;       /* start load steps from the path and pressures of the last ones */
  PetscBool      monitor;    /* print cuts of load steps and contact updates */
  PetscInt       maxcuts;    /* limit of cuts in one load step */
  PetscInt       first_step; /* first load step of this run; not 0 after a restart */
  PetscReal      increment;  /* time increment of the next attempt within the current load step; 0: the rest of it */
  PetscReal      penalty;    /* -contact_penalty: contact stiffness relative to that of the bodies; 0: constraints
                                instead */
  KSP            ksp;        /* for quadratic steps without contact */
  Forecast       forecast;
  StepObserver   observer;
  PetscInt       unheld;      /* consecutive attempts at this load step that contact could not hold */
  char          *cause;       /* reason of the first of these; NULL: none */
  PetscReal      weak_share;  /* stiffness of the proximal term of bodies on weak springs; 0: none is needed */
  int            interrupted; /* the signal that was caught; 0: none */
};

#endif
