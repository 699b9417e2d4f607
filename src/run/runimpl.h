/* Private header of run: set-up, progress and mesh adaptation around the load steps */
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
PETSC_INTERN PetscErrorCode AdaptMarkContact(Model, State, RunState *);

/* plausible.c */
PETSC_INTERN PetscErrorCode PlausibleTest(Model, RunReport *);

/* figures.c */
PETSC_INTERN PetscErrorCode FiguresCollect(RunReport *);

/* simulation.c, set_up_simulation.c, contact_free.c, adapt.c, accuracy.c: their functions are declared in step.h and
   accuracy.h */

#endif
