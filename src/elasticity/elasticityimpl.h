/* Private header of elasticity: energy, forces and tangent of all bodies */
#ifndef ELASTICITYIMPL_H
#define ELASTICITYIMPL_H

#include "src/elasticity/faces/facesimpl.h"
#include "src/report/events.h"

/* constant.c: finds the bodies with constant tangent that need not be assembled again */
PETSC_INTERN PetscErrorCode ElasticitySetUpKept(Elasticity);

/* history.c: allocates the history of quadrature points with plastic laws, initially zero */
PETSC_INTERN PetscErrorCode ElasticitySetUpHistory(Elasticity);

/* preallocate.c: allocates all entries of the tangent and sets them to zero */
PETSC_INTERN PetscErrorCode ElasticityPreallocate(Elasticity, Mat);

/* mass.c: adds inertia and damping to the stiffness K of a cell in dynamics */
PETSC_INTERN void CellAddInertia(Elasticity, const CellState *, PetscScalar K[]);

/* tangent.c, assemble.c: only public functions */

#endif
