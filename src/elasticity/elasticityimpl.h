/*
   Elasticity, private: energy, forces and tangent of all bodies.
*/
#ifndef ELASTICITYIMPL_H
#define ELASTICITYIMPL_H

#include "src/elasticity/faces/facesimpl.h"

/* constant.c: the bodies whose tangent is constant, and which of them are kept when a tangent is assembled again */
PETSC_INTERN PetscErrorCode ElasticitySetUpKept(Elasticity);

/* preallocate.c: allocates all entries of the tangent and sets them to zero */
PETSC_INTERN PetscErrorCode ElasticityPreallocate(Elasticity, Mat);

/* mass.c: what a cell adds to the tangent in dynamics */
PETSC_INTERN void CellAddInertia(Elasticity, const CellState *, PetscScalar K[]);

/* tangent.c, assemble.c: the matrix and what is put into it, public */

#endif
