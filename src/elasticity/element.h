/*
   Elements: how energy, force, stiffness and stress of a cell follow from its law and its vertices.

   A new element is one file with an Element and one line in element.c.
*/
#ifndef ELASTICITY_ELEMENT_H
#define ELASTICITY_ELEMENT_H

#include <formulation.h>
#include <material.h>
#include "hex.h"

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
  PetscBool mean_dilatation; /* the law's dilatation enters by its mean over the cell */
} Element;

PETSC_INTERN const Element ElementFull;
PETSC_INTERN const Element ElementBbar;

PETSC_INTERN PetscErrorCode ElementGet(ElementType, const Element **);

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

#endif
