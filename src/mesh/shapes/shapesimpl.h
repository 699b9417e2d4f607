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
   grid.c: level 0 grids of single bodies on one rank: hexahedra, or tetrahedra from a file. Refinement is done in the
   parameters of a shape, where cells are straight, and the vertices are mapped to space at the end. Refinement thus
   follows curved surfaces on every level without communication. A body that keeps its plane facets (`curved` is false)
   is mapped at level 0.
*/
typedef struct {
  PetscInt   ncells, nvertices, nfacets;
  PetscInt   ncorners; /* number of vertices of a cell: 8 for hexahedra, 4 for tetrahedra */
  PetscInt  *cells;    /* [ncorners ncells] vertices of the cells. Those of hexahedra are in tensor order: vertex i + 2
                       j + 4 k is at the corner (i, j, k). */
  PetscReal *coordinates; /* [3 nvertices] parameters of the vertices; coordinates [length] if the shape has no map */
  PetscInt  *facets;      /* [4 nfacets] vertices of the facets; a triangle repeats its last vertex */
  PetscInt  *facetface;   /* [nfacets] index of each facet's face among the names of MeshGetFaceNames() */
  PetscReal *curve;       /* [81 ncells], in tensor order, or [30 ncells] for tetrahedra: nodes of the quadratic cells
                       whose curves refinement follows [length]; NULL: all edges are straight */
} ShapeGrid;

PETSC_INTERN PetscErrorCode ShapeGridDestroy(ShapeGrid *);

/* A block of n[0] x n[1] x n[2] cells. faces: number of the face on the side at the start and at the end of each
   direction; PETSC_DECIDE if the side is inside the body */
typedef struct {
  PetscInt    n[3], faces[6];
  const void *context;
  /* returns the number of the vertex (i, j, k), and sets its parameters p unless p is NULL */
  PetscInt (*vertex)(const SceneBody *, const void *context, PetscInt i, PetscInt j, PetscInt k, PetscReal p[3]);
} ShapeBlock;

/* Creates a grid of blocks. mirrored: whether the map of the shape converts right-handed cells into left-handed ones */
PETSC_INTERN PetscErrorCode ShapeGridCreate(const SceneBody *, PetscInt nblocks, const ShapeBlock[], PetscInt nvertices,
  PetscBool mirrored, ShapeGrid *);
/* Returns the position in [0, 1] of vertex i of n graded cells. The last cell is `grading` times as large as the first
   (0 stands for 1). `even` cells at the fine end are equal (0 stands for 1), and the other cells grow geometrically. */
PETSC_INTERN PetscReal ShapeGraded(PetscReal grading, PetscInt even, PetscInt n, PetscInt i);
/* Returns the position of vertex i between two others, with the numbers of cells and the grading of direction d */
PETSC_INTERN PetscReal ShapeBetween(const SceneBody *, PetscInt d, PetscInt i, PetscReal from, PetscReal to);
/* Computes the point x on the unit circle for a point q on the sides of a square. Along a side the angle is linear. */
PETSC_INTERN void ShapeCircle(const PetscReal q[2], PetscReal x[2]);
/*
   These functions report an error: ShapeCheckCount() if a number of cells is not positive; ShapeCheckTotal() if the
   total number of vertices is too large; ShapeCheckGrading() if a grading is outside its range, or has more even cells
   than cells.
*/
PETSC_INTERN PetscErrorCode ShapeCheckCount(MPI_Comm, const SceneBody *, const char what[], PetscInt count);
PETSC_INTERN PetscErrorCode ShapeCheckTotal(MPI_Comm, const SceneBody *, PetscReal nvertices);
PETSC_INTERN PetscErrorCode ShapeCheckGrading(MPI_Comm, const SceneBody *, PetscReal grading, PetscInt even,
  PetscInt n);

/*
   regions.c: the boundary of a grid on one rank, and its regions.

   - ShapeBoundaryCreate() makes each facet a region of its own; x: 3 coordinates per vertex.
   - ShapeBoundarySplit() merges regions across edges at which the normals of the facets make at most the given angle.
   - ShapeBoundaryUseFaces() makes the faces of a shape the regions.
   - ShapeBoundaryMatchFaces() computes, for each of the first nfaces faces, the number of the region that consists of
     the same facets; it is negative if there is none.
   - ShapeFacetNormal() computes the unit normal of a facet from its diagonals, because a facet need not be plane.
   - ShapeCompareItems() orders items by their vertices, for qsort() and bsearch().
*/
typedef struct {
  PetscInt  n;      /* number of facets */
  PetscInt *vertex; /* [4 n] vertices, counterclockwise seen from outside; a triangle repeats its last vertex */
  PetscInt *region, nregions; /* [n] region of each facet; number of regions */
} ShapeBoundary;
PETSC_INTERN PetscErrorCode ShapeBoundaryCreate(const ShapeGrid *, const PetscReal x[], ShapeBoundary *);
PETSC_INTERN PetscErrorCode ShapeBoundarySplit(const PetscReal x[], PetscReal degrees, ShapeBoundary *);
PETSC_INTERN PetscErrorCode ShapeBoundaryUseFaces(const ShapeGrid *, PetscInt nfaces, ShapeBoundary *);
PETSC_INTERN PetscErrorCode ShapeBoundaryMatchFaces(const ShapeBoundary *, const ShapeGrid *, PetscInt nfaces,
  PetscInt region[]);
PETSC_INTERN PetscErrorCode ShapeBoundaryDestroy(ShapeBoundary *);
PETSC_INTERN void           ShapeFacetNormal(const PetscReal x[], const PetscInt vertex[4], PetscReal n[3]);

/* An item, with the number `at`, that is identified by up to four vertices in ascending order */
typedef struct {
  PetscInt key[4], at;
} ShapeItem;
PETSC_INTERN int ShapeCompareItems(const void *, const void *);

/* Keys of shapes in scenes. They set fields of a SceneBody. A key with an underscore may be written nested, as in
   outer: {radius: 1}. */
typedef enum {
  KEY_REALS,
  KEY_INTS,
  KEY_AXIS,
  KEY_DIRECTION,
  KEY_TEXT,
  KEY_LIST /* a list of at most n real numbers, preceded by their number */
} KeyType;

typedef struct {
  const char *name;
  KeyType     type;
  PetscInt    n;      /* number of values */
  size_t      offset; /* offset of the field in SceneBody */
  PetscBool   required;
} ShapeKey;

#define SHAPE_KEY(name, type, n, field, required) \
  { \
    name, type, n, offsetof(SceneBody, field), required \
  }

/* The shapes, each in its own file. A new shape is one file with a Shape, and one line in model.h. */
typedef struct {
  /* Returns the names of the faces, terminated by NULL. NULL: they are `names` for every body of the shape. */
  const char *const *(*faces)(const SceneBody *);
  /* Collective. Reports an error if the body's parameters are invalid. Computes the numbers of level 0 cells and
     vertices. */
  PetscErrorCode (*size)(MPI_Comm, const SceneBody *, PetscInt64 *ncells, PetscInt64 *nvertices);
  /* Not collective. Creates the grid. The caller frees it by ShapeGridDestroy(). */
  PetscErrorCode (*create)(const SceneBody *, ShapeGrid *);
  /* Maps parameters to coordinates [length]. x and parameters may be one array. NULL if parameters are coordinates. */
  PetscErrorCode (*map)(const SceneBody *, const PetscReal parameters[3], PetscReal x[3]);
  const ShapeKey    *keys; /* the last key has no name */
  const char *const *names;
} Shape;

#define SHAPE_DECLARE(name, shape, text) PETSC_INTERN const Shape Shape##shape;
BODY_SHAPES(SHAPE_DECLARE)
#undef SHAPE_DECLARE

/*
   octant.c: octants of shells and balls as O-grids; one grid may have one, two, four or eight octants. The parameters p
   are points of the cube [0, 2]^3, whose corner 0 is at the octant's corner. The patches are the three far sides of the
   cube [0, 1]^3, extruded to the larger cube. With m the largest component of p, the point q = p/m on a far side gives
   a direction. The position through the shell is s = m - 1, which is 0 at the inner and 1 at the outer surface. Shells
   have no cells in [0, 1]^3; a ball has its core there. Along an axis with octants on both sides of the corner, the
   parameters are negative on one side.
*/
/* Keys that every octant has: its position and its numbers of cells */
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
PETSC_INTERN PetscErrorCode     OctantCreateShell(const SceneBody *, ShapeGrid *);
/* Splits parameters p outside of the core into the point q on the far sides of the unit cube, and s */
PETSC_INTERN void OctantSplit(const PetscReal p[3], PetscReal q[3], PetscReal *s);
/* Computes the unit vector in the direction of a point q on the far sides. Equal steps along the cube's edges give
   equal angles. */
PETSC_INTERN void OctantDirection(const PetscReal q[3], PetscReal direction[3]);
/* Computes the coordinates x of a point that is given relative to the octant's corner [length]. Components along axes
   with one octant are >= 0. */
PETSC_INTERN void OctantPlace(const SceneBody *, const PetscReal relative[3], PetscReal x[3]);

/* shape.c: gets the shape of a body; NULL for a body from a file */
PETSC_INTERN PetscErrorCode ShapeGet(MPI_Comm, const SceneBody *, const Shape **);

/* body.c: one body at level 0. All fields are known on all ranks, except the grid, which is on the first rank. */
typedef struct {
  PetscInt64 ncells, nvertices;
  PetscInt   ncorners, order; /* vertices of a cell; order of the elements, which is that of the scene or the default
                                 for the type of the cells */
  PetscInt   nfaces;
  char     **faces;     /* names of the faces */
  PetscBool  quadratic; /* whether the grid has curved edges */
  ShapeGrid  grid;
} MeshBody;

/* grid.c: computes the number of each body's first cell in the mesh of all bodies. Tetrahedra come before hexahedra, as
   DMPlex requires. */
PETSC_INTERN PetscErrorCode MeshGetFirstCells(PetscInt nbodies, const MeshBody[], PetscInt first[]);

#endif
