/* Private header of faces: integrals over faces, loads and springs */
#ifndef FACESIMPL_H
#define FACESIMPL_H

#include "src/elasticity/elements/elementsimpl.h"

/*
   springs.c: adds the contributions of this rank; `all`: those of all bodies, otherwise only those of bodies that are
   assembled again
*/
PETSC_INTERN PetscErrorCode SpringsAddEnergy(Elasticity, Vec u, PetscReal *energy);
PETSC_INTERN PetscErrorCode SpringsAddForce(Elasticity, Vec u, Vec force);
PETSC_INTERN PetscErrorCode SpringsAddTangent(Elasticity, PetscBool all, const PetscInt global[], Mat);

/* loads.c: computes the lumped masses of a cell's nodes for unit density, none of which is negative */
PETSC_INTERN void CellMasses(const CellBasis *, PetscReal X[3][CELL_MAX_NODES], PetscReal mass[CELL_MAX_NODES]);

/*
   facet.c: a facet of a face with 4 or 9 nodes, or a triangle with 3 or 6; offsets of its nodes in local vectors, and
   their coordinates. Shape functions are defined on [0,1]^2, or on the half of it with s + t <= 1.
*/
#define FACET_MAX_NODES MESH_MAX_FACET_NODES

typedef struct {
  PetscInt  n, offset[FACET_MAX_NODES];
  PetscReal X[FACET_MAX_NODES][3];
} Facet;

PETSC_INTERN void FacetNormals(PetscInt n, PetscReal X[][3], const PetscReal P[], PetscReal F[][3]);
PETSC_INTERN void FacetShape(PetscInt n, PetscReal s, PetscReal t, PetscReal N[], PetscReal Ns[], PetscReal Nt[]);
/*
   Gets parameters s, t and weight (the returned value) of quadrature point q of a facet with n nodes, with 2 or 3 Gauss
   points per direction
*/
PETSC_INTERN PetscReal      FacetQuadrature(PetscInt n, PetscInt gausspoints, PetscInt q, PetscReal *s, PetscReal *t);
PETSC_INTERN PetscErrorCode FacetGet(Elasticity, PetscInt point, const PetscScalar x[], Facet *);
PETSC_INTERN PetscErrorCode FacetPressures(const Facet *, PetscReal factor, ElasticityPressure, void *ctx,
  PetscReal P[]);

#endif
