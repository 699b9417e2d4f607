/*
   Load stepping: brings elasticity and contact together. Each load step minimizes the elastic energy subject to the
   linearized gap, by TAO where the scene names a contact pair, by one PCG solve where it does not.
*/
#ifndef STEP_H
#define STEP_H

#include <petscdmplex.h>
#include <scene.h>
#include <report.h>

typedef struct _n_Simulation *Simulation;

PETSC_EXTERN PetscErrorCode SimulationCreate(MPI_Comm, Scene, Simulation *);
PETSC_EXTERN PetscErrorCode SimulationGetDM(Simulation, DM *);
PETSC_EXTERN PetscErrorCode SimulationStep(Simulation, PetscInt step, StepState *);
PETSC_EXTERN PetscErrorCode SimulationCatchSignals(void);
PETSC_EXTERN PetscErrorCode SimulationContactFree(Simulation);
PETSC_EXTERN PetscErrorCode SimulationGetReport(Simulation, RunReport *);
PETSC_EXTERN PetscErrorCode SimulationDestroy(Simulation *);

#endif
