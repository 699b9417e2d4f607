/*
   Integrals over faces, loads and springs.
*/
#ifndef FACESIMPL_H
#define FACESIMPL_H

#include "src/elasticity/elements/elementsimpl.h"

/* springs.c: contributions on this rank, for all bodies or those that are assembled again */
PETSC_INTERN PetscErrorCode SpringsAddEnergy(Elasticity, Vec u, PetscReal *energy);
PETSC_INTERN PetscErrorCode SpringsAddForce(Elasticity, Vec u, Vec force);
PETSC_INTERN PetscErrorCode SpringsAddTangent(Elasticity, PetscBool all, const PetscInt global[], Mat);

/* loads.c: lumped masses of a cell's nodes, of unit density, none negative */
PETSC_INTERN void CellMasses(const CellBasis *, PetscReal X[3][CELL_MAX_NODES], PetscReal mass[CELL_MAX_NODES]);

/* facet.c: a facet of a face: 4 or 9 nodes, or a triangle with 3 or 6; offsets in local vectors, coordinates, shape
   functions on [0,1]^2 or half of it */
#define FACET_MAX_NODES MESH_MAX_FACET_NODES

typedef struct {
  PetscInt  n, offset[FACET_MAX_NODES];
  PetscReal X[FACET_MAX_NODES][3];
} Facet;

PETSC_INTERN void FacetNormals(PetscInt n, PetscReal X[][3], PetscReal F[][3]);
PETSC_INTERN void FacetShape(PetscInt n, PetscReal s, PetscReal t, PetscReal N[], PetscReal Ns[], PetscReal Nt[]);
/* Quadrature of a facet with n nodes, 2 or 3 Gauss points per direction: parameters and weight of point q */
PETSC_INTERN PetscReal      FacetQuadrature(PetscInt n, PetscInt gausspoints, PetscInt q, PetscReal *s, PetscReal *t);
PETSC_INTERN PetscErrorCode FacetGet(Elasticity, PetscInt point, const PetscScalar x[], Facet *);

#endif
