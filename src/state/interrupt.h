/* Private header of interrupt.c: signals that end a run */
#ifndef INTERRUPT_H
#define INTERRUPT_H

#include "src/state/stateimpl.h"

PETSC_INTERN PetscErrorCode InterruptTest(Model, State, PetscBool *);
PETSC_INTERN PetscErrorCode InterruptCaught(void *ctx, PetscBool *stop);
PETSC_INTERN PetscErrorCode InterruptMonitor(Tao, void *);
PETSC_INTERN PetscErrorCode InterruptReport(State, StepReport *);

#endif
