/*
   Recovered gradients: error estimate, and output fields.
*/
#ifndef RECOVERYIMPL_H
#define RECOVERYIMPL_H

#include "src/elasticity/elements/elementsimpl.h"

/* recovery.c: displacement gradient (9) and dilatation at the nodes */
typedef struct {
  PetscReal n; /* number of polynomials that contributed to a surface node */
  PetscReal value[ELEMENT_STRAINS];
} RecoveredNode;

/* Corner nodes of a cell, whose polynomials are used at its other nodes */
static inline PetscInt RecoveryCorner(PetscInt nnodes, PetscInt corner)
{
  return nnodes == 27 ? 2 * (corner & 1) + 6 * (corner >> 1 & 1) + 18 * (corner >> 2) : corner;
}

PETSC_INTERN PetscErrorCode ElasticityCreateNodeSF(Elasticity, PetscSF *);
PETSC_INTERN PetscErrorCode ElasticitySumRecords(PetscSF, size_t n, PetscReal *values);
PETSC_INTERN PetscErrorCode ElasticityRecover(Elasticity, PetscSF, const PetscBool selected[], const PetscScalar x[],
  const PetscScalar u[], RecoveredNode recovered[]);

/* order2.c */
PETSC_INTERN PetscErrorCode ElasticityRecoverOrder2(Elasticity, PetscSF, const PetscBool selected[],
  const PetscScalar x[], const PetscScalar u[], RecoveredNode recovered[]);

/* estimate.c: recovery of as many remaining bodies as possible at once; the error estimate is public */
PETSC_INTERN PetscErrorCode ElasticityRecoverNext(Elasticity, PetscSF, const PetscScalar x[], const PetscScalar u[],
  PetscBool remaining[], PetscBool selected[], RecoveredNode recovered[], PetscBool *more);

#endif
