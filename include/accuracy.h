/* Option -accuracy: reaches the requested accuracy with as few unknowns as possible. Chooses tolerances, the number
   of contact updates and the mesh refinement, and reports the accuracy that was reached. */
#ifndef ACCURACY_H
#define ACCURACY_H

#include "step.h"

PETSC_EXTERN PetscErrorCode AccuracySetFromOptions(MPI_Comm, Accuracy *);
/* Sets the tolerances of the next run */
PETSC_EXTERN PetscErrorCode AccuracyPlan(Accuracy *, Scene, StepTolerances *);
/* Records a run and its tolerances. If the mesh was too coarse, sets scene->refine for the next run, and sets
   `again` to true */
PETSC_EXTERN PetscErrorCode AccuracyAssess(Accuracy *, const StepTolerances *, const RunReport *, Scene,
  PetscBool *again);
PETSC_EXTERN PetscErrorCode AccuracyDestroy(Accuracy *);

#endif
