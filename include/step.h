/*
   Load stepping: brings elasticity and contact together. Each load step minimizes the elastic energy subject to the
   linearized gap: by TAO, or by one PCG solve where the energy is quadratic and there is neither contact nor a bound.
*/
#ifndef STEP_H
#define STEP_H

#include <petscdmplex.h>
#include "scene.h"
#include "mesh.h"
#include "report.h"
#include "checkpoint.h"

typedef struct _n_Simulation *Simulation;

/* What the solvers of a run are asked for; what an option says wins */
typedef struct {
  PetscReal optimizer;  /* KKT error at which TAO has converged; PETSC_DEFAULT: the optimizer's own */
  PetscReal linear;     /* relative residual of PCG where a load step needs no TAO */
  PetscReal gap_change; /* change of the gap that ends its linearizations, relative to the largest displacement */
  PetscReal gap_untrue; /* the same, beyond which a load step has not converged */
} StepTolerances;

/* What load steps ended with on a mesh: displacement and, of each contact pair, pressures. Begins as zeros */
typedef struct {
  DM       dm;
  PetscInt nsteps, nfields;
  Vec     *fields; /* nsteps x nfields */
} StepForecast;

/* Create, set, SimulationSetFromOptions(), SimulationSetUp(), then the load steps */
PETSC_EXTERN PetscErrorCode SimulationCreate(MPI_Comm, Scene, Simulation *);
PETSC_EXTERN PetscErrorCode SimulationSetTolerances(Simulation, const StepTolerances *);
PETSC_EXTERN PetscErrorCode SimulationGetTolerances(Simulation, StepTolerances *);
PETSC_EXTERN PetscErrorCode SimulationSetMonitor(Simulation, PetscBool);
PETSC_EXTERN PetscErrorCode SimulationSetFields(Simulation, PetscBool nodes, PetscBool points);
PETSC_EXTERN PetscErrorCode SimulationSetFromOptions(Simulation);
PETSC_EXTERN PetscErrorCode SimulationSetMarks(Simulation, const MeshMarks *);
/* Where load steps start, found on another mesh; then what they end with on this one */
PETSC_EXTERN PetscErrorCode SimulationSetForecast(Simulation, StepForecast *);
PETSC_EXTERN PetscErrorCode StepForecastDestroy(StepForecast *);
PETSC_EXTERN PetscErrorCode SimulationSetUp(Simulation);
PETSC_EXTERN PetscErrorCode SimulationGetDM(Simulation, DM *);
PETSC_EXTERN PetscErrorCode SimulationStep(Simulation, PetscInt step, StepState *);
PETSC_EXTERN PetscErrorCode SimulationCatchSignals(void);
/* Cells for the next mesh, by the errors of these load steps: how much it grows, and marks for it */
PETSC_EXTERN PetscErrorCode SimulationPropose(Simulation, PetscReal *growth);
PETSC_EXTERN PetscErrorCode SimulationMark(Simulation, MeshMarks *);
/* The state, to be written; and one to go on from, before any load step: with which step */
PETSC_EXTERN PetscErrorCode SimulationGetCheckpoint(Simulation, Checkpoint *);
PETSC_EXTERN PetscErrorCode SimulationSetCheckpoint(Simulation, Checkpoint, PetscInt *step);
/* How the faces of the contact pairs stand to each other before a run; dm: the scene's mesh */
PETSC_EXTERN PetscErrorCode StepDescribeContact(Scene, DM dm, PetscViewer);
PETSC_EXTERN PetscErrorCode SimulationContactFree(Simulation);
PETSC_EXTERN PetscErrorCode SimulationGetReport(Simulation, RunReport *);
PETSC_EXTERN PetscErrorCode SimulationDestroy(Simulation *);

#endif
