#ifndef ELASTICITY_PRIVATE_H
#define ELASTICITY_PRIVATE_H

#include <elasticity.h>
#include <petscsf.h>
#include "element.h"

typedef struct {
  BodyMaterial   material;
  const Element *element;
  PetscBool      kept;       /* constant tangent, and no vertex shared with a body that is assembled again */
  PetscInt       assemblies; /* into any tangent */
} Body;

/* The last tangent assembled, as it was left: a matrix of another id or state is assembled completely */
typedef struct {
  PetscObjectId    id; /* 0: none */
  PetscObjectState state;
} AssembledTangent;

struct _n_Elasticity {
  DM               dm;
  char             mattype[64];
  PetscBool        mattype_given; /* by an option */
  HexBasis         basis;
  PetscInt         nbodies;
  Body            *bodies;
  PetscInt         ncells, nnodes; /* of this rank; a node is a vertex, numbered as the local section does */
  PetscInt        *cellnodes;      /* 8 nodes a cell, tensor order */
  PetscInt        *cellbody;
  unsigned char   *prescribed; /* a node's bit d is set if its component d is prescribed; NULL if nothing is */
  AssembledTangent assembled;
};

PETSC_INTERN PetscLogEvent ELASTICITY_Tangent, ELASTICITY_Force, ELASTICITY_Error;

/* Local values of a displacement (NULL: zero), and the coordinates */
PETSC_INTERN PetscErrorCode ElasticityGetLocals(Elasticity, Vec u, Vec *local, const PetscScalar **ul, const PetscScalar **x);
PETSC_INTERN PetscErrorCode ElasticityRestoreLocals(Elasticity, Vec *local, const PetscScalar **ul, const PetscScalar **x);

/* Sets which bodies are kept when a tangent is assembled again */
PETSC_INTERN PetscErrorCode ElasticitySetUpKept(Elasticity);

/* Allocates all entries of the tangent and sets them to zero */
PETSC_INTERN PetscErrorCode ElasticityPreallocate(Elasticity, Mat);

/* What is recovered at a node: displacement gradient (9) and dilatation */
#define ELASTICITY_RECOVERED 10

typedef struct {
  PetscReal n; /* polynomials that were continued to a node on the surface */
  PetscReal value[ELASTICITY_RECOVERED];
} RecoveredNode;

PETSC_INTERN PetscErrorCode ElasticityCreateNodeSF(Elasticity, PetscSF *);
PETSC_INTERN PetscErrorCode ElasticityRecover(Elasticity, PetscSF, const PetscBool selected[], const PetscScalar x[], const PetscScalar u[], RecoveredNode recovered[]);

/* Values of a local vector (3 a node) at a cell's nodes, component by component */
static inline void ElasticityGatherCell(const PetscInt nodes[8], const PetscScalar local[], PetscReal values[3][8])
{
  for (PetscInt a = 0; a < 8; ++a) {
    for (PetscInt d = 0; d < 3; ++d) values[d][a] = PetscRealPart(local[3 * nodes[a] + d]);
  }
}

#endif
