/*
   Private header of elasticity: energy, forces and tangent of all bodies.
*/
#ifndef ELASTICITYIMPL_H
#define ELASTICITYIMPL_H

#include "src/elasticity/faces/facesimpl.h"

/* constant.c: bodies with constant tangent, and which of them are kept in a new assembly */
PETSC_INTERN PetscErrorCode ElasticitySetUpKept(Elasticity);

/* history.c: allocates the history of points with plasticity, initially zero */
PETSC_INTERN PetscErrorCode ElasticitySetUpHistory(Elasticity);

/* preallocate.c: allocates all entries of the tangent and sets them to zero */
PETSC_INTERN PetscErrorCode ElasticityPreallocate(Elasticity, Mat);

/* mass.c: what a cell adds to the tangent in dynamics */
PETSC_INTERN void CellAddInertia(Elasticity, const CellState *, PetscScalar K[]);

/* tangent.c, assemble.c: only public functions */

#endif
