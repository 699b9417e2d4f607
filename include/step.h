/* Load stepping with elasticity and contact. Each load step minimizes the energy subject to the linearized gap: by
   TAO, or by one PCG solve if the energy is quadratic and there are neither contact pairs nor bounds. */
#ifndef STEP_H
#define STEP_H

#include <petscdmplex.h>
#include "scene.h"
#include "mesh.h"
#include "report.h"
#include "checkpoint.h"

typedef struct _n_Simulation *Simulation;

/* Tolerances of the solvers of a run; options override them */
typedef struct {
  PetscReal optimizer;       /* KKT error at which TAO has converged; PETSC_DEFAULT: the optimizer's default */
  PetscReal linear;          /* relative residual of PCG for a load step without TAO */
  PetscReal gap_change;      /* change of the gap that ends the contact updates, relative to the largest displacement */
  PetscReal gap_unconverged; /* change of the gap above which a load step is not converged, relative to the largest
                                displacement */
} StepTolerances;

/* Solutions of all load steps on a mesh: displacement, and pressures of each contact pair. Initialize with zeros */
typedef struct {
  DM       dm;
  PetscInt nsteps, nfields;
  Vec     *fields; /* nsteps x nfields */
} StepForecast;

/* Order of calls: create, set, SimulationSetFromOptions(), SimulationSetUp(), load steps */
PETSC_EXTERN PetscErrorCode SimulationCreate(MPI_Comm, Scene, Simulation *);
PETSC_EXTERN PetscErrorCode SimulationSetTolerances(Simulation, const StepTolerances *);
PETSC_EXTERN PetscErrorCode SimulationGetTolerances(Simulation, StepTolerances *);
PETSC_EXTERN PetscErrorCode SimulationSetMonitor(Simulation, PetscBool);
PETSC_EXTERN PetscErrorCode SimulationSetFields(Simulation, PetscBool nodes, PetscBool points);
PETSC_EXTERN PetscErrorCode SimulationSetFromOptions(Simulation);
PETSC_EXTERN PetscErrorCode SimulationSetMarks(Simulation, const MeshMarks *);
/* Sets the solutions, found on another mesh, from which load steps start; afterwards it holds those of this mesh */
PETSC_EXTERN PetscErrorCode SimulationSetForecast(Simulation, StepForecast *);
PETSC_EXTERN PetscErrorCode StepForecastDestroy(StepForecast *);
PETSC_EXTERN PetscErrorCode SimulationSetUp(Simulation);
PETSC_EXTERN PetscErrorCode SimulationGetDM(Simulation, DM *);
PETSC_EXTERN PetscErrorCode SimulationStep(Simulation, PetscInt step, StepState *);
PETSC_EXTERN PetscErrorCode SimulationCatchSignals(void);
/* Propose: selects cells to refine by the errors of these load steps, and how much the mesh would grow. Mark: adds
   them to the marks */
PETSC_EXTERN PetscErrorCode SimulationPropose(Simulation, PetscReal *growth);
PETSC_EXTERN PetscErrorCode SimulationMark(Simulation, MeshMarks *);
/* Gets the state for a checkpoint; sets the state from one before the first load step */
PETSC_EXTERN PetscErrorCode SimulationGetCheckpoint(Simulation, Checkpoint *);
PETSC_EXTERN PetscErrorCode SimulationSetCheckpoint(Simulation, Checkpoint, PetscInt *step);
/* Describes the contact pairs before a run: gaps, overlaps, facet sizes */
PETSC_EXTERN PetscErrorCode StepDescribeContact(Scene, DM dm, PetscViewer);
PETSC_EXTERN PetscErrorCode SimulationContactFree(Simulation);
PETSC_EXTERN PetscErrorCode SimulationGetReport(Simulation, RunReport *);
PETSC_EXTERN PetscErrorCode SimulationDestroy(Simulation *);

#endif
