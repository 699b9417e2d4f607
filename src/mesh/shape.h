/*
   Shapes: level 0 hexahedral meshes of single bodies, made on one rank.

   The vertices of a mesh are refined in a shape's parameters, where its cells are straight, and mapped to space at the end:
   so refinement follows curved surfaces on every level without any communication. A body whose facets are to
   stay is mapped at level 0.

   A new shape is one file with a Shape, one line in shape.c, and its keys in src/scene/shapes.c.
*/
#ifndef MESH_SHAPE_H
#define MESH_SHAPE_H

#include <mesh.h>

typedef struct {
  PetscInt   ncells, nvertices, nfacets;
  PetscInt  *cells;       /* 8 vertices a cell, tensor order: vertex i + 2 j + 4 k lies at the corner (i, j, k) */
  PetscReal *coordinates; /* 3 parameters a vertex; for a shape without a map, its place [length] */
  PetscInt  *facets;      /* 4 vertices a facet */
  PetscInt  *facetface;   /* index of each facet's face in the names that MeshGetFaceNames() gives */
} ShapeGrid;

typedef struct {
  /* Names of the faces, NULL-terminated */
  const char *const *(*faces)(const SceneBody *);
  /* Collective error if the body's parameters are not valid; number of level 0 cells and vertices */
  PetscErrorCode (*size)(MPI_Comm, const SceneBody *, PetscInt64 *ncells, PetscInt64 *nvertices);
  /* Not collective; fills the grid, whose arrays are the caller's to free with ShapeGridDestroy() */
  PetscErrorCode (*create)(const SceneBody *, ShapeGrid *);
  /* From parameters to places in space; NULL if they are the same. x and the parameters may be one array */
  PetscErrorCode (*map)(const SceneBody *, const PetscReal parameters[3], PetscReal x[3]);
} Shape;

PETSC_INTERN const Shape ShapeBox, ShapeTubeArc, ShapeHalfEllipse, ShapeSphereShell, ShapeSpheroidShell, ShapeBall;

/* The shape of a body; NULL for a body from a file */
PETSC_INTERN PetscErrorCode ShapeGet(MPI_Comm, const SceneBody *, const Shape **);
PETSC_INTERN PetscErrorCode ShapeGridDestroy(ShapeGrid *);

/* A block of n[0] x n[1] x n[2] cells. faces: of the sides at the begin and the end of each direction, or PETSC_DECIDE inside the body */
typedef struct {
  PetscInt    n[3], faces[6];
  const void *context;
  PetscInt (*vertex)(const void *context, PetscInt i, PetscInt j, PetscInt k);
} ShapeBlock;

/* Allocates a grid of blocks and fills all but its coordinates; mirrored: the map turns right-handed cells left-handed */
PETSC_INTERN PetscErrorCode ShapeGridCreate(PetscInt nblocks, const ShapeBlock[], PetscInt nvertices, PetscBool mirrored, ShapeGrid *);
/* Place in [0, 1] of vertex i of n cells, the last `grading` times as large as the first (0: 1): `even` (0: 1) equal ones at the
   fine end, from there on growing geometrically */
PETSC_INTERN PetscReal ShapeGraded(PetscReal grading, PetscInt even, PetscInt n, PetscInt i);
/* Errors: a count that is not positive; a count or total too large; a grading that is not positive, or has more even cells than there are */
PETSC_INTERN PetscErrorCode ShapeCheckCount(MPI_Comm, const SceneBody *, const char what[], PetscInt count);
PETSC_INTERN PetscErrorCode ShapeCheckTotal(MPI_Comm, const SceneBody *, PetscReal nvertices);
PETSC_INTERN PetscErrorCode ShapeCheckGrading(MPI_Comm, const SceneBody *, PetscReal grading, PetscInt even, PetscInt n);

#endif
