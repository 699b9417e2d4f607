/*
   Shapes of bodies, and their grids at refinement level 0 on one rank.
*/
#ifndef SHAPESIMPL_H
#define SHAPESIMPL_H

#include <mesh.h>
#include <petsccompat.h>
#include <rankerror.h>
#include <stddef.h>

/*
   grid.c: level 0 grids of single bodies on one rank: hexahedra, or tetrahedra from a file. Vertices are refined in a
   shape's parameters, where cells are straight, and mapped to space at the end. Refinement thus follows curved surfaces
   on every level without communication. A body that keeps its facets is mapped at level 0.
*/
typedef struct {
  PetscInt   ncells, nvertices, nfacets;
  PetscInt   ncorners;    /* vertices per cell: 8 for hexahedra, 4 for tetrahedra */
  PetscInt  *cells;       /* ncorners vertices per cell; of hexahedra in tensor order: vertex i + 2 j + 4 k is at the
                       corner (i, j, k) */
  PetscReal *coordinates; /* 3 parameters per vertex; for a shape without a map its coordinates [length] */
  PetscInt  *facets;      /* 4 vertices per facet; a triangle repeats the last one */
  PetscInt  *facetface;   /* index of each facet's face among the names of MeshGetFaceNames() */
  PetscReal *curve; /* 27 (tensor order) or 10 nodes per cell, of the quadratic cell that refinement follows; NULL:
                       straight edges */
} ShapeGrid;

PETSC_INTERN PetscErrorCode ShapeGridDestroy(ShapeGrid *);

/* A block of n[0] x n[1] x n[2] cells. faces: face of the sides at the start and end of each direction;
   PETSC_DECIDE: inside the body */
typedef struct {
  PetscInt    n[3], faces[6];
  const void *context;
  PetscInt (*vertex)(const void *context, PetscInt i, PetscInt j, PetscInt k);
} ShapeBlock;

/* Allocates a grid of blocks and fills all but its coordinates; mirrored: the map turns right-handed cells
   left-handed */
PETSC_INTERN PetscErrorCode ShapeGridCreate(PetscInt nblocks, const ShapeBlock[], PetscInt nvertices,
  PetscBool mirrored, ShapeGrid *);
/* Position in [0, 1] of vertex i of n graded cells. The last cell is `grading` times as large as the first (0: 1).
   `even` (0: 1) cells at the fine end are equal, the others grow geometrically */
PETSC_INTERN PetscReal ShapeGraded(PetscReal grading, PetscInt even, PetscInt n, PetscInt i);
/* The point on the circle of radius 1 for a place on the sides of a square: along a side the angle is linear */
PETSC_INTERN void ShapeCircle(const PetscReal q[2], PetscReal x[2]);
/* Checks: error for a count that is not positive; a count or total that is too large; a grading that is not
   positive, or has more even cells than cells */
PETSC_INTERN PetscErrorCode ShapeCheckCount(MPI_Comm, const SceneBody *, const char what[], PetscInt count);
PETSC_INTERN PetscErrorCode ShapeCheckTotal(MPI_Comm, const SceneBody *, PetscReal nvertices);
PETSC_INTERN PetscErrorCode ShapeCheckGrading(MPI_Comm, const SceneBody *, PetscReal grading, PetscInt even,
  PetscInt n);

/* regions.c: the boundary of a grid on one rank. Create: each facet is a region of its own; x: 3 coordinates per
   vertex. Split: the regions lie between edges at which facets make more than an angle. UseFaces: the regions are the
   faces of a shape. MatchFaces: number of the region that each of the first faces is; negative: it is none */
#define SHAPE_SHARP 35.0 /* degrees; larger angles are edges of the body */
typedef struct {
  PetscInt  n;
  PetscInt *vertex; /* [4 n] counterclockwise seen from outside; a triangle repeats the last one */
  PetscInt *region, nregions;
} ShapeBoundary;
PETSC_INTERN PetscErrorCode ShapeBoundaryCreate(const ShapeGrid *, const PetscReal x[], ShapeBoundary *);
PETSC_INTERN PetscErrorCode ShapeBoundarySplit(const PetscReal x[], PetscReal degrees, ShapeBoundary *);
PETSC_INTERN PetscErrorCode ShapeBoundaryUseFaces(const ShapeGrid *, PetscInt nfaces, ShapeBoundary *);
PETSC_INTERN PetscErrorCode ShapeBoundaryMatchFaces(const ShapeBoundary *, const ShapeGrid *, PetscInt nfaces,
  PetscInt region[]);
PETSC_INTERN PetscErrorCode ShapeBoundaryDestroy(ShapeBoundary *);

/* Keys of shapes in scenes: values of a SceneBody. A key with an underscore may be nested, as outer: {radius: 1} */
typedef enum {
  KEY_REALS,
  KEY_INTS,
  KEY_AXIS,
  KEY_DIRECTION,
  KEY_TEXT,
  KEY_LIST /* reals: their number, then at most n */
} KeyType;

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
   box.c, tube_arc.c, ..., rigid_surface.c: the shapes. A new shape is a file with a
   Shape, and a line in model.h.
*/
typedef struct {
  /* Names of the faces, NULL-terminated */
  const char *const *(*faces)(const SceneBody *);
  /* Collective error if the body's parameters are invalid; otherwise number of level 0 cells and vertices */
  PetscErrorCode (*size)(MPI_Comm, const SceneBody *, PetscInt64 *ncells, PetscInt64 *nvertices);
  /* Not collective; fills the grid. The caller frees it by ShapeGridDestroy() */
  PetscErrorCode (*create)(const SceneBody *, ShapeGrid *);
  /* Maps parameters to coordinates; NULL if they are the same. x and the parameters may be the same array */
  PetscErrorCode (*map)(const SceneBody *, const PetscReal parameters[3], PetscReal x[3]);
  const ShapeKey *keys; /* ends with a key without name */
} Shape;

#define SHAPE_DECLARE(name, shape, text) PETSC_INTERN const Shape Shape##shape;
BODY_SHAPES(SHAPE_DECLARE)
#undef SHAPE_DECLARE

/*
   octant.c: octants of shells and balls as O-grids, or two, four or eight of them in one. The parameters are a cube
   [0, 1]^3 with one corner at the octant's corner; its three far sides (the patches) are extruded to the cube [0, 2]^3.
   With m the largest component of p, the point q = p/m on a far side gives a direction, and s = m - 1 the position
   through the shell, 0 at its inner and 1 at its outer surface. Shells have no cells in [0, 1]^3; a ball has its core
   there. Along an axis of which both sides are modelled, parameters are negative on one of them.
*/
/* Keys of every octant: position and division */
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
/* Splits parameters outside of the core into q on the far sides of the unit cube, and s */
PETSC_INTERN void OctantSplit(const PetscReal p[3], PetscReal q[3], PetscReal *s);
/* Unit vector of a point on the far sides; equal steps along the cube's edges are equal angles */
PETSC_INTERN void OctantDirection(const PetscReal q[3], PetscReal direction[3]);
/* Coordinates of a point that is given relative to the corner, with components >= 0 along axes of one side */
PETSC_INTERN void OctantPlace(const SceneBody *, const PetscReal relative[3], PetscReal x[3]);

/* shape.c: the shape of a body; NULL for a body from a file */
PETSC_INTERN PetscErrorCode ShapeGet(MPI_Comm, const SceneBody *, const Shape **);

/* body.c: one body at level 0; sizes and faces on all ranks, the grid on rank 0 */
typedef struct {
  PetscInt64 ncells, nvertices;
  PetscInt   ncorners, order; /* order: the requested one, or that which suits its cells */
  PetscInt   nfaces;
  char     **faces;
  PetscBool  quadratic; /* its grid has curved edges */
  ShapeGrid  grid;
} MeshBody;

/* grid.c: first cell of each body in the mesh of all; tetrahedra before hexahedra, as DMPlex requires */
PETSC_INTERN PetscErrorCode MeshGetFirstCells(PetscInt nbodies, const MeshBody[], PetscInt first[]);

#endif
