/* Computes load steps with elasticity and contact. Each load step minimizes the energy, with the condition that the
   linearized gap is not negative. This is done by TAO, or by one PCG solve if the energy is quadratic and there is
   no contact and no bound. */
#ifndef STEP_H
#define STEP_H

#include <petscdmplex.h>
#include "scene.h"
#include "mesh.h"
#include "report.h"
#include "checkpoint.h"

typedef struct _n_Simulation *Simulation;

/* Tolerances of the solvers in a run. Options take precedence. */
typedef struct {
  PetscReal optimizer;       /* KKT error at which TAO has converged; PETSC_DEFAULT: the optimizer's default */
  PetscReal linear;          /* relative residual of PCG for a load step without TAO */
  PetscReal gap_change;      /* contact updates end when the gap changes by less than this fraction of the largest
                                displacement */
  PetscReal gap_unconverged; /* a load step has not converged if the gap still changes by more than this fraction of
                                the largest displacement */
} StepTolerances;

/* Functions must be called in this order: create, set, SimulationSetFromOptions(), SimulationSetUp(), load steps. */
PETSC_EXTERN PetscErrorCode SimulationCreate(MPI_Comm, Scene, Simulation *);
PETSC_EXTERN PetscErrorCode SimulationSetTolerances(Simulation, const StepTolerances *);
PETSC_EXTERN PetscErrorCode SimulationGetTolerances(Simulation, StepTolerances *);
PETSC_EXTERN PetscErrorCode SimulationSetMonitor(Simulation, PetscBool);
PETSC_EXTERN PetscErrorCode SimulationSetFields(Simulation, PetscBool nodes, PetscBool points);
PETSC_EXTERN PetscErrorCode SimulationSetFromOptions(Simulation);
/* Says that the run may be followed by one on a finer mesh: progress messages do not estimate the remaining time */
PETSC_EXTERN PetscErrorCode SimulationSetMeshFollows(Simulation);
PETSC_EXTERN PetscErrorCode SimulationSetMarks(Simulation, const MeshMarks *);
PETSC_EXTERN PetscErrorCode SimulationSetUp(Simulation);
PETSC_EXTERN PetscErrorCode SimulationCheck(Simulation);
PETSC_EXTERN PetscErrorCode SimulationGetDM(Simulation, DM *);
PETSC_EXTERN PetscErrorCode SimulationStep(Simulation, PetscInt step, StepState *);
PETSC_EXTERN PetscErrorCode SimulationCatchSignals(void);
/* SimulationPropose() selects the cells to be refined, by the errors of these load steps, and computes the growth of
   the mesh. SimulationMark() adds the cells to the marks. */
PETSC_EXTERN PetscErrorCode SimulationPropose(Simulation, PetscReal *growth);
PETSC_EXTERN PetscErrorCode SimulationMark(Simulation, MeshMarks *);
/* Gets the state for a checkpoint, or sets it from a checkpoint before the first load step */
PETSC_EXTERN PetscErrorCode SimulationGetCheckpoint(Simulation, Checkpoint *);
PETSC_EXTERN PetscErrorCode SimulationSetCheckpoint(Simulation, Checkpoint, PetscInt *step);
/* Prints gaps, overlaps and facet sizes of the contact pairs before a run */
PETSC_EXTERN PetscErrorCode StepDescribeContact(Scene, DM dm, PetscViewer);
PETSC_EXTERN PetscErrorCode SimulationContactFree(Simulation);
PETSC_EXTERN PetscErrorCode SimulationGetReport(Simulation, RunReport *);
PETSC_EXTERN PetscErrorCode SimulationDestroy(Simulation *);

#endif
