/* Catches errors of libraries inside a call, so that they do not end the program */
#ifndef AMGF_GUARD_H
#define AMGF_GUARD_H

#include <petscvec.h>

typedef struct {
  char     why[128]; /* what was said of the error */
  Vec      b;        /* the call's right-hand side, which an interrupted call leaves locked; NULL: it has none */
  PetscInt nlocks;
} AMGFGuard;

PETSC_INTERN PetscErrorCode PCAMGFGuardBegin_Private(AMGFGuard *, Vec);
PETSC_INTERN PetscErrorCode PCAMGFGuardEnd_Private(AMGFGuard *, PetscErrorCode, PetscBool *);

#endif
