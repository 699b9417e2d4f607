/* Private header of recovery: recovered gradients, from which the error estimate and output fields are computed */
#ifndef RECOVERYIMPL_H
#define RECOVERYIMPL_H

#include "src/elasticity/elements/elementsimpl.h"
#include "src/mesh/query/queryimpl.h"

/* Displacement gradient (9 values), dilatation and, for laws of finite strain, the stretch U - 1 (xx yy zz xy yz zx) */
#define RECOVERED_VALUES (ELEMENT_STRAINS + 6)

/* recovery.c: recovered values at a node */
typedef struct {
  PetscReal n; /* number of polynomials that contributed to the value */
  PetscReal value[RECOVERED_VALUES];
} RecoveredNode;

/* Returns the node that is a corner of the cell. Only corners have polynomials. */
static inline PetscInt RecoveryCorner(PetscInt nnodes, PetscInt corner)
{
  return nnodes == 27 ? 2 * (corner & 1) + 6 * (corner >> 1 & 1) + 18 * (corner >> 2) : corner;
}

PETSC_INTERN PetscErrorCode ElasticityCreateNodeSF(Elasticity, PetscSF *);
PETSC_INTERN PetscErrorCode ElasticitySumRecords(PetscSF, size_t n, PetscReal *values);
PETSC_INTERN PetscErrorCode ElasticityRecover(Elasticity, PetscSF, const PetscBool selected[], const PetscScalar x[],
  const PetscScalar u[], RecoveredNode recovered[]);

/* stretch.c: rotation and stretch */
PETSC_INTERN void CellRecovered(const CellState *, PetscInt q, PetscReal s[RECOVERED_VALUES]);
PETSC_INTERN void StretchGetDirection(const PetscReal H[9], const RecoveredNode *, PetscReal direction[9]);
PETSC_INTERN void StretchGetStrain(const BodyMaterial *, const RecoveredNode *, PetscReal strain[ELEMENT_STRAINS]);

/* stress.c: von Mises stress of xx yy zz xy yz zx */
PETSC_INTERN PetscReal StressVonMises(const PetscReal stress[6]);

/* order2.c: recovers gradients at the nodes of cells of order 2 */
PETSC_INTERN PetscErrorCode ElasticityRecoverOrder2(Elasticity, PetscSF, const PetscBool selected[],
  const PetscScalar x[], const PetscScalar u[], RecoveredNode recovered[]);

/* limit.c: limits recovered stresses where the material has yielded */
PETSC_INTERN PetscErrorCode ElasticityLimitRecovered(Elasticity, PetscSF, const PetscBool selected[],
  const PetscScalar x[], const PetscScalar u[], RecoveredNode recovered[]);

/* bodies.c: calls add() for each set of bodies that share no node, with the strains recovered at their nodes */
typedef PetscErrorCode (*RecoveredAdd)(Elasticity, const PetscBool selected[], const PetscScalar x[],
  const PetscScalar u[], const RecoveredNode recovered[], void *ctx);
PETSC_INTERN PetscErrorCode ElasticityRecoverBodies(Elasticity, Vec u, RecoveredAdd add, void *ctx);

/* estimate.c: adds the squared errors of the selected bodies, and of their cells unless NULL [force length] */
typedef struct {
  PetscReal *bodies, *cells;
} EstimateSquares;
PETSC_INTERN PetscErrorCode EstimateAdd(Elasticity, const PetscBool selected[], const PetscScalar x[],
  const PetscScalar u[], const RecoveredNode recovered[], const EstimateSquares *);

/*
   largest.c: the largest value of each class of samples on all ranks, and its place. Classes without samples are
   unchanged.
*/
typedef struct {
  PetscInt  of;    /* number of the class */
  PetscReal value; /* not negative */
  PetscReal place[3];
} LargestSample;
PETSC_INTERN PetscErrorCode LargestFind(MPI_Comm, PetscInt n, const LargestSample[], PetscInt nclasses,
  LargestValue largest[]);

#endif
