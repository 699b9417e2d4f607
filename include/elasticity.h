/*
   Elasticity of the bodies of a mesh: energy, internal force and tangent of hexahedra and tetrahedra.
   Vectors are the DM's global vectors (3 components per vertex). Prescribed rows stay in the tangent: rows and
   columns zeroed, diagonal kept at the stiffness's scale.
*/
#ifndef ELASTICITY_H
#define ELASTICITY_H

#include <petscdmplex.h>
#include <petscmat.h>
#include "material.h"
#include "formulation.h"

typedef struct _n_Elasticity *Elasticity;

/* materials[b] and elements[b] belong to the cells whose "body" label is b; elements NULL: full integration */
PETSC_EXTERN PetscErrorCode ElasticityCreate(DM, PetscInt nbodies, const Material materials[],
  const ElementType elements[], Elasticity *);
/* Global rows (owned by this rank) whose displacement is prescribed */
PETSC_EXTERN PetscErrorCode ElasticitySetPrescribed(Elasticity, IS rows);
/* Sets the type of the tangent, unless -elasticity_mat_type is given */
PETSC_EXTERN PetscErrorCode ElasticitySetMatType(Elasticity, MatType);
/* Creates a preallocated symmetric matrix with zero values (BAIJ unless another type was set), without a near null
   space */
PETSC_EXTERN PetscErrorCode ElasticityCreateTangent(Elasticity, Mat *);
PETSC_EXTERN PetscErrorCode ElasticitySetNearNullSpace(Elasticity, Mat);
/* Assembles the tangent. Bodies with a constant tangent are assembled only once, if the matrix is the same and
   unchanged, and they share no vertex with a body whose tangent varies */
PETSC_EXTERN PetscErrorCode ElasticityTangent(Elasticity, Vec u, Mat);
/* Whether no body's tangent depends on u; how many times each body has been assembled into a tangent */
PETSC_EXTERN PetscErrorCode ElasticityIsLinear(Elasticity, PetscBool *);
PETSC_EXTERN PetscErrorCode ElasticityGetAssemblies(Elasticity, PetscInt body, PetscInt *);
/* Energy stored at u [force length]; PETSC_INFINITY on every rank if an element is inverted */
PETSC_EXTERN PetscErrorCode ElasticityEnergy(Elasticity, Vec u, PetscReal *);
/* Internal force dE/du at u on all rows, the prescribed ones too (there it is the reaction) [force] */
PETSC_EXTERN PetscErrorCode ElasticityForce(Elasticity, Vec u, Vec force);
/* By how much the mean force of a step, which keeps energy and momentum, exceeds the mean of the forces at its ends */
PETSC_EXTERN PetscErrorCode ElasticityExcess(Elasticity, Vec from, Vec to, Vec excess, PetscBool *valid);
/* Add dead loads to a global vector [force]: -pressure x reference normal over a face; a force per reference volume
   in a body (PETSC_DECIDE: in every body) */
PETSC_EXTERN PetscErrorCode ElasticityAddPressure(Elasticity, const char face[], PetscReal pressure, Vec force);
/* Adds a follower load: -pressure x deformed normal and area at u; and the symmetric part of its derivative to a
   matrix of ElasticityCreateTangent(), or NULL */
PETSC_EXTERN PetscErrorCode ElasticityAddFollower(Elasticity, const char face[], PetscReal pressure, Vec u, Vec force,
  Mat slope);
PETSC_EXTERN PetscErrorCode ElasticityAddFacetAreas(Elasticity, const char face[], Vec areas);
PETSC_EXTERN PetscErrorCode ElasticityAddBodyForce(Elasticity, PetscInt body, const PetscReal density[3], Vec force);
/* Face field: integral over a face of shape functions times a constant (dead traction, or stiffness per area). Face
   resultant: the load of a linear traction with the given resultants */
PETSC_EXTERN PetscErrorCode ElasticityAddFaceField(Elasticity, const char face[], const PetscReal value[3], Vec total);
PETSC_EXTERN PetscErrorCode ElasticityAddForce(Elasticity, const char face[], const PetscReal resultant[3],
  const PetscReal moment[3], const PetscReal point[3], Vec force);
/* Sets springs: stiffness to the ground for each row (used in energy, force and tangent), and a matrix of springs
   between unknowns (used in energy and force); NULL: none [force/length] */
PETSC_EXTERN PetscErrorCode ElasticitySetSprings(Elasticity, Vec stiffness, Mat between);
/* Sections for the pretension of bolts: cells that the plane through `point` cuts take the displacements of their nodes
   beyond it as larger by shortening x axis, so that the body is stretched. ncells: number of cut cells. Forces of all
   sections at u, positive: tension [force] */
PETSC_EXTERN PetscErrorCode ElasticityAddSection(Elasticity, PetscInt body, const PetscReal point[3],
  const PetscReal axis[3], PetscInt *ncells);
PETSC_EXTERN PetscErrorCode ElasticitySetShortening(Elasticity, PetscInt section, PetscReal shortening);
PETSC_EXTERN PetscErrorCode ElasticityGetSectionForces(Elasticity, Vec u, PetscReal force[]);
/* Temperatures of bodies that expand, linear in each cell: 4 values per local cell (value at its centre, gradient).
   They can be fitted to a function of space, and set; NULL: none */
PETSC_EXTERN PetscErrorCode ElasticityGetCellCount(Elasticity, PetscInt *ncells);
PETSC_EXTERN PetscErrorCode ElasticityFitTemperature(Elasticity, PetscInt                 body,
  PetscErrorCode (*temperature)(void *ctx, const PetscReal x[3], PetscReal *value), void *ctx, PetscReal fits[]);
PETSC_EXTERN PetscErrorCode ElasticitySetTemperature(Elasticity, const PetscReal fits[]);
/* Lumped mass: integral of each node's shape function; if one is negative, the scaled integral of its square. One
   value for each of the 3 components [length^3] */
PETSC_EXTERN PetscErrorCode ElasticityLumpedMass(Elasticity, Vec *);
/* Mass of the bodies in dynamics: what it is made of, its matrix, and its part of tangents to come */
PETSC_EXTERN PetscErrorCode ElasticitySetMass(Elasticity, const PetscReal density[], PetscBool consistent, Vec light);
PETSC_EXTERN PetscErrorCode ElasticityCreateMass(Elasticity, Mat *);
PETSC_EXTERN PetscErrorCode ElasticitySetInertia(Elasticity, PetscReal inertia, PetscReal viscosity,
  PetscBool *changed);
/* Cauchy stress averaged over each cell: xx yy zz xy yz zx and von Mises, 7 values per local cell [force/length^2] */
/* For each body with a small-strain law: largest principal strain, and rotation */
PETSC_EXTERN PetscErrorCode ElasticityBoundStrain(Elasticity, Vec u, PetscReal bounds[][2]);
PETSC_EXTERN PetscErrorCode ElasticityMeasureStrain(Elasticity, Vec u, PetscReal values[][2]);
PETSC_EXTERN PetscErrorCode ElasticityCellStress(Elasticity, Vec u, PetscReal *stress[]);
/* Output fields: recovered stress at the nodes of the local section, stress at quadrature points, strain energy per
   volume of cells */
PETSC_EXTERN PetscErrorCode ElasticityNodalStress(Elasticity, Vec u, PetscReal *stress[]);
PETSC_EXTERN PetscErrorCode ElasticityPointStress(Elasticity, Vec u, PetscInt *npoints, PetscReal *places[],
  PetscReal *stress[]);
PETSC_EXTERN PetscErrorCode ElasticityCellEnergy(Elasticity, Vec u, PetscReal *density[]);
/* Principal values of a stress xx yy zz xy yz zx, largest first */
PETSC_EXTERN PetscErrorCode ElasticityPrincipal(const PetscReal stress[6], PetscReal principal[3]);
/* Estimated squared discretization error in the energy norm: of each body, and of each local cell unless cells is
   NULL [force length] */
PETSC_EXTERN PetscErrorCode ElasticityEstimateError(Elasticity, Vec u, PetscReal bodies[], PetscReal *cells[]);
/* Of laws with a history: makes that at u the one of the last state of equilibrium. Whether any point has one;
   plastic work, and of each body the largest equivalent plastic strain; plastic strain (xx yy zz xy yz zx) and its
   equivalent, means over local cells; the points themselves */
PETSC_EXTERN PetscErrorCode ElasticityCommit(Elasticity, Vec u);
PETSC_EXTERN PetscErrorCode ElasticityHasYielded(Elasticity, PetscBool *);
PETSC_EXTERN void           ElasticitySetSecant(Elasticity, PetscReal share);
PETSC_EXTERN PetscErrorCode ElasticityPlasticWork(Elasticity, PetscReal *work, PetscReal largest[]);
PETSC_EXTERN PetscErrorCode ElasticityPlasticFlow(Elasticity, Vec u, PetscReal *stored, PetscReal *work,
  PetscInt *body);
PETSC_EXTERN PetscErrorCode ElasticityCellPlastic(Elasticity, PetscReal *strain[]);
PETSC_EXTERN PetscErrorCode ElasticityGetHistory(Elasticity, PetscInt *npoints, PetscReal *places[],
  PetscReal *history[]);
PETSC_EXTERN PetscErrorCode ElasticityDestroy(Elasticity *);

#endif
