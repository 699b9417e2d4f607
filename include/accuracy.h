/*
   One knob: a run is to be as accurate as asked, and no more. Chooses tolerances, linearizations of the gap and the
   refinement of the mesh, and says what was attained.
*/
#ifndef ACCURACY_H
#define ACCURACY_H

#include <report.h>
#include <scene.h>

PETSC_EXTERN PetscErrorCode AccuracySetFromOptions(MPI_Comm, Accuracy *);
/* Tolerances for the next run, as PETSc options; those that the user has given stay */
PETSC_EXTERN PetscErrorCode AccuracyPlan(Accuracy *, Scene);
/* Records a run; where its mesh is too coarse, scene->refine is the next one's and *again is true */
PETSC_EXTERN PetscErrorCode AccuracyAssess(Accuracy *, const RunReport *, Scene, PetscBool *again);
PETSC_EXTERN PetscErrorCode AccuracyDestroy(Accuracy *);

#endif
