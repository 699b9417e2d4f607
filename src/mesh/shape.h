/*
   Shapes: level 0 hexahedral meshes of single bodies, made on one rank.

   A new shape is one file with a Shape and one line in shape.c.
*/
#ifndef MESH_SHAPE_H
#define MESH_SHAPE_H

#include <mesh.h>

typedef struct {
  PetscInt   ncells, nvertices, nfacets;
  PetscInt  *cells;       /* 8 vertices a cell, tensor order: vertex i + 2 j + 4 k lies at the corner (i, j, k) */
  PetscReal *coordinates; /* 3 a vertex [length] */
  PetscInt  *facets;      /* 4 vertices a facet */
  PetscInt  *facetface;   /* index in Shape.faces of each facet's face */
} ShapeGrid;

typedef struct {
  const char *const *faces; /* names of the faces, NULL-terminated */
  /* Collective error if the body's parameters are not valid; number of level 0 cells and vertices */
  PetscErrorCode (*size)(MPI_Comm, const SceneBody *, PetscInt64 *ncells, PetscInt64 *nvertices);
  /* Not collective; fills the grid, whose arrays are the caller's to free with ShapeGridDestroy() */
  PetscErrorCode (*create)(const SceneBody *, ShapeGrid *);
} Shape;

PETSC_INTERN const Shape ShapeBox;

PETSC_INTERN PetscErrorCode ShapeGet(MPI_Comm, const SceneBody *, const Shape **);
PETSC_INTERN PetscErrorCode ShapeGridDestroy(ShapeGrid *);

#endif
