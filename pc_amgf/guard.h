/* Catches errors of libraries inside a call, so that they do not end the program */
#ifndef AMGF_GUARD_H
#define AMGF_GUARD_H

#include <petscvec.h>

/* Number of PETSc's events that PCSetUp() opens or pauses */
#define AMGF_GUARD_EVENTS 5

typedef struct {
  char     why[128]; /* message of the library's error */
  Vec      b;        /* right-hand side of the guarded PCApply(), which remains locked for reading if an error
                        interrupts the call; NULL: PCSetUp() is guarded */
  PetscInt nlocks;
  int      depths[AMGF_GUARD_EVENTS]; /* how often these events are open or paused before the guarded PCSetUp() */
} AMGFGuard;

PETSC_INTERN PetscErrorCode PCAMGFGuardBegin_Private(AMGFGuard *, Vec);
PETSC_INTERN PetscErrorCode PCAMGFGuardEnd_Private(AMGFGuard *, PetscErrorCode, PetscBool *);

#endif
