/*
   Elasticity, private: the map of src/elasticity. From the hexahedron to the object, every file builds on those before it.
*/
#ifndef ELASTICITYIMPL_H
#define ELASTICITYIMPL_H

#include <elasticity.h>
#include <petscsf.h>

/* hex.c: the trilinear hexahedron on [-1,1]^3. Arrays over vertices come last, of constant length 8, for the compiler to vectorize. */
#define HEX_MAX_POINTS 27

typedef struct {
  PetscInt  npoints;
  PetscReal weight[HEX_MAX_POINTS];
  PetscReal xi[HEX_MAX_POINTS][3];
  PetscReal N[HEX_MAX_POINTS][8];
  PetscReal dN[HEX_MAX_POINTS][3][8]; /* dN/dxi_k */
} HexBasis;

/* Gauss points per axis: 2 or 3 */
PETSC_INTERN PetscErrorCode HexBasisCreate(PetscInt gausspoints, HexBasis *);

/* Gradients G[j][a] = dN_a/dX_j at point q of the cell with vertices X[d][a]; returns weight times det dX/dxi */
static inline PetscReal HexGradients(const HexBasis *basis, PetscInt q, PetscReal X[3][8], PetscReal G[3][8])
{
  const PetscReal(*dN)[8] = basis->dN[q];
  PetscReal J[3][3], C[3][3], det;

  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) {
      PetscReal sum = 0;

      for (int a = 0; a < 8; ++a) sum += X[i][a] * dN[k][a];
      J[i][k] = sum;
    }
  }
  for (int i = 0; i < 3; ++i) {
    const int i1 = (i + 1) % 3, i2 = (i + 2) % 3;

    for (int k = 0; k < 3; ++k) {
      const int k1 = (k + 1) % 3, k2 = (k + 2) % 3;

      C[i][k] = J[i1][k1] * J[i2][k2] - J[i1][k2] * J[i2][k1];
    }
  }
  det = J[0][0] * C[0][0] + J[0][1] * C[0][1] + J[0][2] * C[0][2];
  for (int j = 0; j < 3; ++j) {
    const PetscReal c0 = C[j][0] / det, c1 = C[j][1] / det, c2 = C[j][2] / det;

    for (int a = 0; a < 8; ++a) G[j][a] = c0 * dN[0][a] + c1 * dN[1][a] + c2 * dN[2][a];
  }
  return basis->weight[q] * det;
}

/* H[3 i + j] = du_i/dX_j */
static inline void HexDisplacementGradient(PetscReal U[3][8], PetscReal G[3][8], PetscReal H[9])
{
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      PetscReal sum = 0;

      for (int a = 0; a < 8; ++a) sum += U[i][a] * G[j][a];
      H[3 * i + j] = sum;
    }
  }
}

/* stiffness.c: of a hexahedron, from the tangents at its points; the elements share it */

/* Stiffness of an isotropic law with constant tangent */
PETSC_INTERN void HexStiffnessIsotropic(const HexBasis *, PetscReal X[3][8], PetscReal lambda, PetscReal mu, PetscScalar K[24][24]);
/* Adds w dN_a/dX_j A_ijkl dN_b/dX_l, A symmetric, to S[i][k][a][b], k >= i; then the stiffness from the sum over all points */
PETSC_INTERN void HexStiffnessAdd(PetscReal w, PetscReal G[3][8], const PetscReal A[81], PetscReal S[3][3][8][8]);
PETSC_INTERN void HexStiffnessFinish(PetscReal S[3][3][8][8], PetscScalar K[24][24]);

/* F[i][a] += w P_ij dN_a/dX_j */
static inline void HexForceAdd(PetscReal w, PetscReal G[3][8], const PetscReal P[9], PetscReal F[3][8])
{
  for (int i = 0; i < 3; ++i) {
    const PetscReal p0 = w * P[3 * i], p1 = w * P[3 * i + 1], p2 = w * P[3 * i + 2];

    for (int a = 0; a < 8; ++a) F[i][a] += p0 * G[0][a] + p1 * G[1][a] + p2 * G[2][a];
  }
}

/*
   full.c, bbar.c, incompatible.c: elements, which are how energy, force, stiffness and stress of a cell follow from its law and its vertices.

   A new element is one file with an Element, one line in element.c, and its name in src/scene/formulation.c.
*/
typedef struct {
  const MaterialLaw *law;
  PetscReal          lambda, mu; /* [force/length^2] */
} BodyMaterial;

/* lambda of the isochoric part: kappa = lambda + 2 mu/3 = 0 */
static inline PetscReal IsochoricLambda(const BodyMaterial *m)
{
  return -2 * m->mu / 3;
}

static inline PetscReal BulkModulus(const BodyMaterial *m)
{
  return m->lambda + 2 * m->mu / 3;
}

#define ELEMENT_STRAINS 10

/*
   A cell with vertices X[d][a] displaced by U[d][a]. Where a point of it is turned inside out the energy is PETSC_INFINITY, and
   the others return PETSC_FALSE and what they wrote means nothing.
*/
typedef struct {
  PetscReal (*energy)(const HexBasis *, const BodyMaterial *, PetscReal X[3][8], PetscReal U[3][8]);
  /* Derivative of the energy, F[d][a] */
  PetscBool (*force)(const HexBasis *, const BodyMaterial *, PetscReal X[3][8], PetscReal U[3][8], PetscReal F[3][8]);
  /* Second derivative of the energy, K[3 a + i][3 b + k]; U is not read where the law's tangent is constant */
  PetscBool (*stiffness)(const HexBasis *, const BodyMaterial *, PetscReal X[3][8], PetscReal U[3][8], PetscScalar K[24][24]);
  /* Cauchy stress averaged over the reference cell, xx yy zz xy yz zx */
  PetscBool (*cauchy)(const HexBasis *, const BodyMaterial *, PetscReal X[3][8], PetscReal U[3][8], PetscReal sigma[6]);
  /* Volumes of the points; displacement gradient (9) and dilatation there, those whose energy is the cell's */
  void (*strains)(const HexBasis *, const BodyMaterial *, PetscReal X[3][8], PetscReal U[3][8], PetscReal w[], PetscReal H[][ELEMENT_STRAINS]);
} Element;

PETSC_INTERN const Element ElementFull;
PETSC_INTERN const Element ElementBbar;
PETSC_INTERN const Element ElementIncompatible;

/* element.c: the table of elements */
PETSC_INTERN PetscErrorCode ElementGet(ElementType, const Element **);

/* events.c: PETSc's log events of this folder */
PETSC_INTERN PetscLogEvent  ELASTICITY_Tangent, ELASTICITY_Force, ELASTICITY_Error;
PETSC_INTERN PetscErrorCode ElasticityEventsRegister(void);

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

/* locals.c: local values of a displacement (NULL: zero), and the coordinates */
PETSC_INTERN PetscErrorCode ElasticityGetLocals(Elasticity, Vec u, Vec *local, const PetscScalar **ul, const PetscScalar **x);
PETSC_INTERN PetscErrorCode ElasticityRestoreLocals(Elasticity, Vec *local, const PetscScalar **ul, const PetscScalar **x);

/* Values of a local vector (3 a node) at a cell's nodes, component by component */
static inline void ElasticityGatherCell(const PetscInt nodes[8], const PetscScalar local[], PetscReal values[3][8])
{
  for (PetscInt a = 0; a < 8; ++a) {
    for (PetscInt d = 0; d < 3; ++d) values[d][a] = PetscRealPart(local[3 * nodes[a] + d]);
  }
}

/* force.c, stress.c, loads.c: loops over the cells and facets, all of them public */

/* constant.c: the bodies whose tangent is constant, and which of them are kept when a tangent is assembled again */
PETSC_INTERN PetscErrorCode ElasticitySetUpKept(Elasticity);

/* preallocate.c: allocates all entries of the tangent and sets them to zero */
PETSC_INTERN PetscErrorCode ElasticityPreallocate(Elasticity, Mat);

/* tangent.c, assemble.c: the matrix and what is put into it, public */

/* recovery.c: displacement gradient (9) and dilatation at the nodes */
typedef struct {
  PetscReal n; /* polynomials that were continued to a node on the surface */
  PetscReal value[ELEMENT_STRAINS];
} RecoveredNode;

PETSC_INTERN PetscErrorCode ElasticityCreateNodeSF(Elasticity, PetscSF *);
PETSC_INTERN PetscErrorCode ElasticityRecover(Elasticity, PetscSF, const PetscBool selected[], const PetscScalar x[], const PetscScalar u[], RecoveredNode recovered[]);

/* estimate.c, elasticity.c: the error estimate, and the object's life, public */

#endif
