/*
   Queries of meshes, private.
*/
#ifndef QUERYIMPL_H
#define QUERYIMPL_H

#include <mesh.h>
#include <petsccompat.h>

/* places.c: where the nodes that this rank owns are, undeformed, and in which body; in the order of the global
   vectors */
typedef struct {
  Vec       x;    /* [length] */
  PetscInt *body; /* one a node */
} VertexPlaces;

PETSC_INTERN PetscErrorCode VertexPlacesCreate(DM, VertexPlaces *);
PETSC_INTERN PetscErrorCode VertexPlacesDestroy(VertexPlaces *);

#endif
