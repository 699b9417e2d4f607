/* TAO callbacks of the quadratic model; the context is a QuadraticModel. */
#ifndef QUADRATIC_H
#define QUADRATIC_H

#include "stepimpl.h"

PETSC_INTERN PetscErrorCode QuadraticEnergy(QuadraticModel *, Vec, PetscReal *);
PETSC_INTERN PetscErrorCode QuadraticObjectiveAndGradient(Tao, Vec, PetscReal *, Vec, void *);
PETSC_INTERN PetscErrorCode QuadraticHessian(Tao, Vec, Mat, Mat, void *);
PETSC_INTERN PetscErrorCode QuadraticConstraint(Tao, Vec, Vec, void *);
PETSC_INTERN PetscErrorCode QuadraticJacobian(Tao, Vec, Mat, Mat, void *);

#endif
