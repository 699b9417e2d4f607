/*
   One knob: a run is to be as accurate as asked, and no more. Chooses tolerances, linearizations of the gap and the
   refinement of the mesh, and says what was attained.
*/
#ifndef ACCURACY_H
#define ACCURACY_H

#include "step.h"

PETSC_EXTERN PetscErrorCode AccuracySetFromOptions(MPI_Comm, Accuracy *);
/* Tolerances for the next run, in place of those that are there */
PETSC_EXTERN PetscErrorCode AccuracyPlan(Accuracy *, Scene, StepTolerances *);
/* Records a run and the tolerances that it had; where its mesh is too coarse, scene->refine is the next one's and
 *again is true */
PETSC_EXTERN PetscErrorCode AccuracyAssess(Accuracy *, const StepTolerances *, const RunReport *, Scene,
  PetscBool *again);
PETSC_EXTERN PetscErrorCode AccuracyDestroy(Accuracy *);

#endif
