#ifndef ELASTICITY_PRIVATE_H
#define ELASTICITY_PRIVATE_H

#include <elasticity.h>
#include "hex.h"

typedef struct {
  const MaterialLaw *law;
  PetscReal          lambda, mu; /* [force/length^2] */
} BodyMaterial;

struct _n_Elasticity {
  DM             dm;
  char           mattype[64];
  HexBasis       basis;
  PetscInt       nbodies;
  BodyMaterial  *bodies;
  PetscInt       ncells, nnodes; /* of this rank; a node is a vertex, numbered as the local section does */
  PetscInt      *cellnodes;      /* 8 nodes a cell, tensor order */
  PetscInt      *cellbody;
  unsigned char *prescribed; /* a node's bit d is set if its component d is prescribed; NULL if nothing is */
};

PETSC_INTERN PetscLogEvent ELASTICITY_Tangent, ELASTICITY_Force;

/* Allocates all entries of the tangent and sets them to zero */
PETSC_INTERN PetscErrorCode ElasticityPreallocate(Elasticity, Mat);

/* Values of a local vector (3 a node) at a cell's nodes, component by component */
static inline void ElasticityGatherCell(const PetscInt nodes[8], const PetscScalar local[], PetscReal values[3][8])
{
  for (PetscInt a = 0; a < 8; ++a) {
    for (PetscInt d = 0; d < 3; ++d) values[d][a] = PetscRealPart(local[3 * nodes[a] + d]);
  }
}

#endif
