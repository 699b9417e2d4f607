/*
   The shapes of bodies, and their grids at refinement level 0, on one rank.
*/
#ifndef SHAPESIMPL_H
#define SHAPESIMPL_H

#include <mesh.h>
#include <petsccompat.h>
#include <rankerror.h>
#include <stddef.h>

/*
   grid.c: level 0 meshes of single bodies, made on one rank: hexahedra, or tetrahedra where a file has them.

   The vertices of a mesh are refined in a shape's parameters, where its cells are straight, and mapped to space at
   the end: so refinement follows curved surfaces on every level without any communication. A body whose facets are to
   stay is mapped at level 0.
*/
typedef struct {
  PetscInt   ncells, nvertices, nfacets;
  PetscInt   ncorners; /* of a cell: 8 of hexahedra, 4 of tetrahedra */
  PetscInt  *cells; /* ncorners vertices a cell, of hexahedra in tensor order: vertex i + 2 j + 4 k lies at the corner
                         (i, j, k) */
  PetscReal *coordinates; /* 3 parameters a vertex; for a shape without a map, its place [length] */
  PetscInt  *facets;      /* 4 vertices a facet, the last of a triangle's twice */
  PetscInt  *facetface;   /* index of each facet's face in the names that MeshGetFaceNames() gives */
  PetscReal *curve; /* 27 places a cell, tensor order, or 10, of the quadratic cell that refinement follows; NULL: it
                       has straight edges */
} ShapeGrid;

PETSC_INTERN PetscErrorCode ShapeGridDestroy(ShapeGrid *);

/* A block of n[0] x n[1] x n[2] cells. faces: of the sides at the begin and the end of each direction, or
   PETSC_DECIDE inside the body */
typedef struct {
  PetscInt    n[3], faces[6];
  const void *context;
  PetscInt (*vertex)(const void *context, PetscInt i, PetscInt j, PetscInt k);
} ShapeBlock;

/* Allocates a grid of blocks and fills all but its coordinates; mirrored: the map turns right-handed cells
   left-handed */
PETSC_INTERN PetscErrorCode ShapeGridCreate(PetscInt nblocks, const ShapeBlock[], PetscInt nvertices,
  PetscBool mirrored, ShapeGrid *);
/* Place in [0, 1] of vertex i of n cells, the last `grading` times as large as the first (0: 1): `even` (0: 1) equal
   ones at the fine end, from there on growing geometrically */
PETSC_INTERN PetscReal ShapeGraded(PetscReal grading, PetscInt even, PetscInt n, PetscInt i);
/* Errors: a count that is not positive; a count or total too large; a grading that is not positive, or has more even
   cells than there are */
PETSC_INTERN PetscErrorCode ShapeCheckCount(MPI_Comm, const SceneBody *, const char what[], PetscInt count);
PETSC_INTERN PetscErrorCode ShapeCheckTotal(MPI_Comm, const SceneBody *, PetscReal nvertices);
PETSC_INTERN PetscErrorCode ShapeCheckGrading(MPI_Comm, const SceneBody *, PetscReal grading, PetscInt even,
  PetscInt n);

/* The keys of shapes, as scenes have them: values of a SceneBody. An underscore may be nested, as outer: {radius: 1} */
typedef enum { KEY_REALS, KEY_INTS, KEY_AXIS, KEY_DIRECTION, KEY_TEXT } KeyType;

typedef struct {
  const char *name;
  KeyType     type;
  PetscInt    n; /* values */
  size_t      offset;
  PetscBool   required;
} ShapeKey;

#define SHAPE_KEY(name, type, n, field, required) \
  { \
    name, type, n, offsetof(SceneBody, field), required \
  }

/*
   box.c, tube_arc.c, half_ellipse.c, sphere_shell.c, spheroid_shell.c, ball.c: the shapes.

   A new shape is one file with a Shape, and one line in model.h.
*/
typedef struct {
  /* Names of the faces, NULL-terminated */
  const char *const *(*faces)(const SceneBody *);
  /* Collective error if the body's parameters are not valid; number of level 0 cells and vertices */
  PetscErrorCode (*size)(MPI_Comm, const SceneBody *, PetscInt64 *ncells, PetscInt64 *nvertices);
  /* Not collective; fills the grid, whose arrays are the caller's to free with ShapeGridDestroy() */
  PetscErrorCode (*create)(const SceneBody *, ShapeGrid *);
  /* From parameters to places in space; NULL if they are the same. x and the parameters may be one array */
  PetscErrorCode (*map)(const SceneBody *, const PetscReal parameters[3], PetscReal x[3]);
  const ShapeKey *keys; /* the last one has no name */
} Shape;

#define SHAPE_DECLARE(name, shape, text) PETSC_INTERN const Shape Shape##shape;
BODY_SHAPES(SHAPE_DECLARE)
#undef SHAPE_DECLARE

/*
   octant.c: octants of shells and balls as O-grids.

   Parameters: a cube [0, 1]^3 with a corner at the octant's corner, whose three far sides (the patches) are extruded
   to the cube [0, 2]^3: there, with m the largest component, the point q = p/m of a far side gives a direction and s
   = m - 1 the place across the shell, 0 at its inner and 1 at its outer surface. Shells have no cells in [0, 1]^3, a
   ball has its core there.
*/
/* What every octant has: where it is, and how it is divided */
#define OCTANT_PLACE_KEYS \
  SHAPE_KEY("center", KEY_REALS, 3, octant.corner, PETSC_FALSE), \
    SHAPE_KEY("octant", KEY_INTS, 3, octant.signs, PETSC_FALSE)
#define OCTANT_GRID_KEYS \
  SHAPE_KEY("patches", KEY_INTS, 3, cells, PETSC_TRUE), SHAPE_KEY("layers", KEY_INTS, 1, layers, PETSC_TRUE), \
    SHAPE_KEY("grading", KEY_REALS, 3, grading, PETSC_FALSE), SHAPE_KEY("even", KEY_INTS, 3, even, PETSC_FALSE), \
    SHAPE_KEY("layer_grading", KEY_REALS, 1, octant.layer_grading, PETSC_FALSE), \
    SHAPE_KEY("layer_even", KEY_INTS, 1, octant.layer_even, PETSC_FALSE)

PETSC_INTERN const char *const *OctantFaces(const SceneBody *);
PETSC_INTERN PetscErrorCode     OctantSize(MPI_Comm, const SceneBody *, PetscBool core, PetscInt64 *ncells,
      PetscInt64 *nvertices);
PETSC_INTERN PetscErrorCode     OctantCreate(const SceneBody *, PetscBool core, ShapeGrid *);
/* q on the far sides of the unit cube and s, from parameters outside of the core */
PETSC_INTERN void OctantSplit(const PetscReal p[3], PetscReal q[3], PetscReal *s);
/* Unit vector of a point of the far sides, all components >= 0; equal steps along the cube's edges are equal angles */
PETSC_INTERN void OctantDirection(const PetscReal q[3], PetscReal direction[3]);
/* Place of a point given relative to the corner, all components >= 0 */
PETSC_INTERN void OctantPlace(const SceneBody *, const PetscReal relative[3], PetscReal x[3]);

/* shape.c: the shape of a body; NULL for a body from a file */
PETSC_INTERN PetscErrorCode ShapeGet(MPI_Comm, const SceneBody *, const Shape **);

/* body.c: one body at level 0, sizes and faces on all ranks, the grid on rank 0 */
typedef struct {
  PetscInt64 ncells, nvertices;
  PetscInt   ncorners, order; /* of its cells; what it asks for, or what suits them */
  PetscInt   nfaces;
  char     **faces;
  PetscBool  quadratic; /* its grid has a curve */
  ShapeGrid  grid;
} MeshBody;

/* grid.c: the first cell of each body in one mesh of all, tetrahedra before hexahedra as DMPlex wants them */
PETSC_INTERN PetscErrorCode MeshGetFirstCells(PetscInt nbodies, const MeshBody[], PetscInt first[]);

#endif
