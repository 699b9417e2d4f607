/*
   Elasticity of the bodies of a mesh: energy, internal force and tangent of hexahedra and tetrahedra.
   Vectors are global vectors of the DM, with 3 components per node. Prescribed rows remain in the tangent. Their rows
   and columns are zero, except for diagonal entries of the size of the stiffness.
*/
#ifndef ELASTICITY_H
#define ELASTICITY_H

#include <petscdmplex.h>
#include <petscmat.h>
#include "material.h"
#include "formulation.h"

typedef struct _n_Elasticity *Elasticity;

/* A largest value, and its undeformed place [length] */
typedef struct {
  PetscReal value, place[3];
} LargestValue;

/* Largest values at the nodes of a body [force/length^2], [length] */
typedef struct {
  LargestValue von_mises, displacement;
} LargestOfBody;

/* Creates the elasticity of a mesh. materials[b] and elements[b] belong to the cells whose label "body" has the
   value b. elements: NULL selects full integration for all bodies. */
PETSC_EXTERN PetscErrorCode ElasticityCreate(DM, PetscInt nbodies, const Material materials[],
  const ElementType elements[], Elasticity *);
/* Sets the rows whose displacement is prescribed: global rows that this rank owns */
PETSC_EXTERN PetscErrorCode ElasticitySetPrescribed(Elasticity, IS rows);
/* Sets the type of the tangent. The option -elasticity_mat_type takes precedence. */
PETSC_EXTERN PetscErrorCode ElasticitySetMatType(Elasticity, MatType);
/* Creates the matrix of the tangent: symmetric, preallocated, filled with zeros, without a near null space. Its type is
   BAIJ unless another type was set. */
PETSC_EXTERN PetscErrorCode ElasticityCreateTangent(Elasticity, Mat *);
/* Attaches the rigid body modes to the tangent as its near null space */
PETSC_EXTERN PetscErrorCode ElasticitySetNearNullSpace(Elasticity, Mat);
/* Assembles the tangent at u. A body with a constant tangent is assembled only once, as long as the matrix is the same
   and unchanged, and the body shares no vertex with a body whose tangent varies. */
PETSC_EXTERN PetscErrorCode ElasticityTangent(Elasticity, Vec u, Mat);
/* Finds whether the tangent of every body is independent of u */
PETSC_EXTERN PetscErrorCode ElasticityIsLinear(Elasticity, PetscBool *);
/* Gets the number of times that a body has been assembled into a tangent */
PETSC_EXTERN PetscErrorCode ElasticityGetAssemblies(Elasticity, PetscInt body, PetscInt *);
/* Computes the energy stored at u [force length]. It is PETSC_INFINITY on every rank if an element is inverted. */
PETSC_EXTERN PetscErrorCode ElasticityEnergy(Elasticity, Vec u, PetscReal *);
/* Computes the internal force dE/du at u in all rows [force]. In prescribed rows it is the reaction. */
PETSC_EXTERN PetscErrorCode ElasticityForce(Elasticity, Vec u, Vec force);
/* Computes excess = mean force - mean of the forces at both ends, for a step between two displacements [force]. The
   mean force conserves energy and momentum. *valid: false if an element is inverted. */
PETSC_EXTERN PetscErrorCode ElasticityExcess(Elasticity, Vec from, Vec to, Vec excess, PetscBool *valid);
/* A pressure as a function of the undeformed position [force/length^2] */
typedef PetscErrorCode (*ElasticityPressure)(void *ctx, const PetscReal x[3], PetscReal *pressure);
/* Adds a dead load to a global vector: the force of a pressure on the undeformed face, -factor times the pressure times
   normal and area [force]. If the pressure is NULL it is 1. */
PETSC_EXTERN PetscErrorCode ElasticityAddPressure(Elasticity, const char face[], PetscReal factor, ElasticityPressure,
  void *ctx, Vec force);
/* Adds a follower load at u: the same on the deformed area along the deformed normal. Adds the symmetric part of the
   load's derivative to `slope`, a matrix of ElasticityCreateTangent(), unless it is NULL. */
PETSC_EXTERN PetscErrorCode ElasticityAddFollower(Elasticity, const char face[], PetscReal factor, ElasticityPressure,
  void *ctx, Vec u, Vec force, Mat slope);
/* Adds the area vector of each node of a face to a global vector [length^2] */
PETSC_EXTERN PetscErrorCode ElasticityAddFacetAreas(Elasticity, const char face[], Vec areas);
/* Adds a dead load to a global vector: a force per undeformed volume in a body, or in every body if `body` is
   PETSC_DECIDE */
PETSC_EXTERN PetscErrorCode ElasticityAddBodyForce(Elasticity, PetscInt body, const PetscReal density[3], Vec force);
/* Adds the integrals of the nodes' shape functions over a face, times `value`, to a global vector. value: a
   traction, or a stiffness per area. */
PETSC_EXTERN PetscErrorCode ElasticityAddFaceField(Elasticity, const char face[], const PetscReal value[3], Vec total);
/* Adds a dead load to a global vector: the traction that is linear over the face and has this resultant, and this
   moment about `point` */
PETSC_EXTERN PetscErrorCode ElasticityAddForce(Elasticity, const char face[], const PetscReal resultant[3],
  const PetscReal moment[3], const PetscReal point[3], Vec force);
/* Sets springs [force/length]; NULL: none. stiffness: springs to the ground, one value per row, which count in energy,
   force and tangent. between: matrix of springs between unknowns, which count in energy and force only. */
PETSC_EXTERN PetscErrorCode ElasticitySetSprings(Elasticity, Vec stiffness, Mat between);
/* Adds a section through a body for the pretension of a bolt: the plane through `point` with the normal `axis`.
   Cells cut by the plane are stretched, as if their nodes beyond the plane were moved further by shortening x axis.
   *ncells: number of cut cells. */
PETSC_EXTERN PetscErrorCode ElasticityAddSection(Elasticity, PetscInt body, const PetscReal point[3],
  const PetscReal axis[3], PetscInt *ncells);
/* Sets the shortening of a section [length] */
PETSC_EXTERN PetscErrorCode ElasticitySetShortening(Elasticity, PetscInt section, PetscReal shortening);
/* Computes the forces in all sections at u; tension is positive [force] */
PETSC_EXTERN PetscErrorCode ElasticityGetSectionForces(Elasticity, Vec u, PetscReal force[]);
/* Gets the number of cells on this rank */
PETSC_EXTERN PetscErrorCode ElasticityGetCellCount(Elasticity, PetscInt *ncells);
/* Approximates a temperature field in the cells of a body by linear functions: 4 values per local cell, the value at
   the cell's centre and the gradient */
PETSC_EXTERN PetscErrorCode ElasticityFitTemperature(Elasticity, PetscInt                 body,
  PetscErrorCode (*temperature)(void *ctx, const PetscReal x[3], PetscReal *value), void *ctx, PetscReal fits[]);
/* Sets the temperatures of the bodies that expand, in the form of ElasticityFitTemperature(); NULL: no temperatures */
PETSC_EXTERN PetscErrorCode ElasticitySetTemperature(Elasticity, const PetscReal fits[]);
/* Computes the lumped mass for unit density [length^3]: the integral of each node's shape function, or a scaled
   integral of its square in cells where an integral is negative. Each of the 3 components of a node has this value. */
PETSC_EXTERN PetscErrorCode ElasticityLumpedMass(Elasticity, Vec *);
/* Sets the mass of the bodies in dynamics: density of each body, and whether their mass matrix is consistent instead of
   lumped. light: 1 at nodes that have no mass; NULL: all nodes have mass. */
PETSC_EXTERN PetscErrorCode ElasticitySetMass(Elasticity, const PetscReal density[], PetscBool consistent, Vec light);
/* Creates the mass matrix */
PETSC_EXTERN PetscErrorCode ElasticityCreateMass(Elasticity, Mat *);
/* Makes later tangents (1 + viscosity) stiffness + inertia mass. *changed: whether the factors have changed. */
PETSC_EXTERN PetscErrorCode ElasticitySetInertia(Elasticity, PetscReal inertia, PetscReal viscosity,
  PetscBool *changed);
/* Computes for each body with a law of small strain an upper bound of its principal strains, and of its rotation
   angle [rad] */
PETSC_EXTERN PetscErrorCode ElasticityBoundStrain(Elasticity, Vec u, PetscReal bounds[][2]);
/* Computes for each body with a law of small strain the mean of the largest principal strain, the mean rotation
   angle [rad], and the share of its volume that is inverted */
PETSC_EXTERN PetscErrorCode ElasticityMeasureStrain(Elasticity, Vec u, PetscReal values[][3]);
/* Computes the mean Cauchy stress of each local cell, 7 values: xx yy zz xy yz zx and von Mises [force/length^2] */
PETSC_EXTERN PetscErrorCode ElasticityCellStress(Elasticity, Vec u, PetscReal *stress[]);
/* Computes the stress at the quadrature points of this rank, and the undeformed positions of these points */
PETSC_EXTERN PetscErrorCode ElasticityPointStress(Elasticity, Vec u, PetscInt *npoints, PetscReal *places[],
  PetscReal *stress[]);
/* Computes the mean strain energy per undeformed volume of each local cell [force/length^2] */
PETSC_EXTERN PetscErrorCode ElasticityCellEnergy(Elasticity, Vec u, PetscReal *density[]);
/* Computes the principal values of a stress xx yy zz xy yz zx, the largest first */
PETSC_EXTERN PetscErrorCode ElasticityPrincipal(const PetscReal stress[6], PetscReal principal[3]);
/* Recovers the stress at the nodes. Gets the stress itself (6 values per node of the local section), the largest values
   of each body, the square of the discretization error in the energy norm of each body and of each local cell
   [force length]. NULL: not wanted. */
PETSC_EXTERN PetscErrorCode ElasticityRecoverStress(Elasticity, Vec u, PetscReal *stress[], LargestOfBody largest[],
  PetscReal errors[], PetscReal *cells[]);
/* Stores the plastic strains at u, a state of equilibrium, as those from which the next load step starts */
PETSC_EXTERN PetscErrorCode ElasticityCommit(Elasticity, Vec u);
/* Finds whether any point has a plastic strain */
PETSC_EXTERN PetscErrorCode ElasticityHasYielded(Elasticity, PetscBool *);
/* Sets the displacement from which the pressure in later tangents is linearized; NULL: none */
PETSC_EXTERN void ElasticitySetPressureBase(Elasticity, Vec before);
/* Gets the plastic work since the start [force length], and the largest equivalent plastic strain of each body */
PETSC_EXTERN PetscErrorCode ElasticityPlasticWork(Elasticity, PetscReal *work, PetscReal largest[]);
/* Computes, for a trial displacement u, the elastic energy, the plastic work since the last equilibrium in bodies
   that have a collapse load, and the body with most of this work */
PETSC_EXTERN PetscErrorCode ElasticityPlasticFlow(Elasticity, Vec u, PetscReal *stored, PetscReal *work,
  PetscInt *body);
/* Computes the mean plastic strain of each local cell, 7 values: xx yy zz xy yz zx and the equivalent plastic strain */
PETSC_EXTERN PetscErrorCode ElasticityCellPlastic(Elasticity, PetscReal *strain[]);
/* Gets the quadrature points of laws with plastic strains, and access to the plastic strains, for checkpoints */
PETSC_EXTERN PetscErrorCode ElasticityGetHistory(Elasticity, PetscInt *npoints, PetscReal *places[],
  PetscReal *history[]);
PETSC_EXTERN PetscErrorCode ElasticityDestroy(Elasticity *);

#endif
