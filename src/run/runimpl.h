/*
   A whole analysis, private: what is built, looked at and chosen around the load steps.
*/
#ifndef RUNIMPL_H
#define RUNIMPL_H

#include <accuracy.h>
#include <checkpoint.h>
#include "src/step/stepimpl.h"

/* memory_usage.c */
PETSC_INTERN PetscErrorCode MemoryUsageGet(MPI_Comm, PetscLogDouble *bytes);
PETSC_INTERN PetscErrorCode MemoryUsageGetPeak(MPI_Comm, PetscLogDouble *bytes);

/* progress.c */
PETSC_INTERN PetscErrorCode ProgressObserve(Simulation);
PETSC_INTERN void           ProgressRecord(Progress *, PetscLogDouble duration);
PETSC_INTERN PetscBool ProgressEstimate(const Progress *, PetscLogDouble elapsed, PetscInt later, PetscLogDouble *);

/* adapt_contact.c */
PETSC_INTERN PetscErrorCode AdaptMarkContact(Simulation);

/* effects.c */
PETSC_INTERN PetscErrorCode EffectsCreate(Simulation, RunReport *);
PETSC_INTERN PetscErrorCode EffectsSetTimes(Simulation, RunReport *);

/* simulation.c, setup.c, contact_free.c, adapt.c, and accuracy.c on top of them, have no more than what step.h and
   accuracy.h offer */

#endif
