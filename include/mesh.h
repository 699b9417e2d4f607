/*
   Meshes: one DMPlex of hexahedra and tetrahedra for all bodies, distributed and refined. Different bodies share no
   points. Labels: the label "body" has the number of the body at each cell. The label "<body>.<face>" of each named
   face has the value 1 at the facets of the face and at their edges and vertices; MeshGetFaceNames() lists the faces of
   a body. Local section: 3 displacement components per node, block size 3, no constrained unknowns. The nodes of a body
   of order 1 are its vertices. Those of a body of order 2 are also its edges and, in hexahedra, its facets and cells.
   The coordinates are those of the undeformed bodies.
*/
#ifndef MESH_H
#define MESH_H

#include <petscdmplex.h>
#include "model.h"

#define MESH_BODY_LABEL "body"
/* name of a part of the boundary of a body from a mesh file; a number follows */
#define MESH_SURFACE         "surface_"
#define MESH_MAX_NODES       27 /* largest number of nodes of a cell */
#define MESH_MAX_FACET_NODES 9
/* Places nearer than this are the same, relative to the size of what they belong to: it is the rounding error of
   coordinates in mesh files, and so of heights and overlaps */
#define MESH_SAME_PLACE 1e-6
/* Edges whose two facets have normals at a larger angle are sharp: they separate surfaces [degrees] */
#define MESH_SHARP_ANGLE 35.0

/* Tetrahedra have 4 or 10 nodes, hexahedra 8 or 27 */
static inline PetscBool MeshIsTetrahedron(PetscInt nnodes)
{
  return (PetscBool)(nnodes == 4 || nnodes == 10);
}

static inline PetscInt MeshOrder(PetscInt nnodes)
{
  return nnodes == 10 || nnodes == 27 ? 2 : 1;
}

static inline PetscInt MeshCorners(PetscInt nnodes)
{
  return MeshIsTetrahedron(nnodes) ? 4 : 8;
}

/* Creates the mesh of all bodies, refined uniformly `refine` times */
PETSC_EXTERN PetscErrorCode MeshCreate(MPI_Comm, PetscInt nbodies, const SceneBody[], PetscInt refine, DM *);
/* The cells that are marked for refinement on each mesh of a sequence. Cells have the numbers that they have on the
   first rank. */
typedef struct {
  PetscInt   n, *count; /* number of meshes; number of marked cells on each mesh */
  PetscInt **cells;
} MeshMarks;
/* Creates the mesh of a scene. It is refined as the scene requires, and then in the marked cells. marks: may be NULL */
PETSC_EXTERN PetscErrorCode MeshCreateScene(MPI_Comm, Scene, const MeshMarks *, DM *);
PETSC_EXTERN PetscErrorCode MeshMarksAdd(DM, const PetscBool marked[], MeshMarks *);
PETSC_EXTERN PetscErrorCode MeshMarksDestroy(MeshMarks *);
/* Gets the means that define hanging vertices, which lie in the middle of an edge or a facet of a coarser cell. The
   row of a hanging vertex has the weights of the vertices whose mean it is. *means: NULL if no vertex hangs */
PETSC_EXTERN PetscErrorCode MeshGetHanging(DM, Mat *means);
PETSC_EXTERN PetscErrorCode MeshCountHanging(DM, PetscInt *n);
/* The same of all nodes that depend on others: hanging vertices, and nodes in the middle of serendipity hexahedra and
   of their sides */
PETSC_EXTERN PetscErrorCode MeshGetDependent(DM, Mat *dependent);
/* Marks the boundary facets of the bodies on this rank */
PETSC_EXTERN PetscErrorCode MeshMarkBoundary(DM, PetscBool boundary[]);
/* Checks the parameters of the shape, or that the mesh file contains the volume; checks the body's parts of faces */
PETSC_EXTERN PetscErrorCode MeshCheckBody(MPI_Comm, const SceneBody *);
/* Names of a body's faces without the body's name: faces of the shape, or physical surfaces of the Gmsh file; then
   its parts of faces */
PETSC_EXTERN PetscErrorCode MeshGetFaceNames(MPI_Comm, const SceneBody *, PetscInt *n, char ***names);
PETSC_EXTERN PetscErrorCode MeshRestoreFaceNames(PetscInt *n, char ***names);
/*
   The surfaces of all bodies at refinement level 0, equal on all ranks. The surfaces of a built-in shape are its faces.
   The surfaces of a body from a file are the parts of its boundary between sharp edges; the body gets faces surface_1,
   surface_2, ... for them.
*/
typedef struct {
  PetscInt   n, *surface; /* number of facets, and the surface of each */
  PetscReal *x; /* [12 n] vertices, counterclockwise seen from outside; a triangle repeats its last vertex [length] */
  PetscInt   nsurfaces, *body; /* number of surfaces, and the body of each */
  char     **name;             /* [nsurfaces] "<body>.<face>" */
} MeshSurfaces;
PETSC_EXTERN PetscErrorCode MeshSurfacesCreate(MPI_Comm, PetscInt nbodies, SceneBody[], MeshSurfaces *);
PETSC_EXTERN PetscErrorCode MeshSurfacesDestroy(MeshSurfaces *);
/* Checks that the faces that a scene names have facets, and that every body is held by displacements, springs, ties or
   contact pairs */
PETSC_EXTERN PetscErrorCode MeshCheckScene(DM, Scene);
/* A rotation of a body that nothing resists if the other bodies are held, such as that of a pin about its axis */
typedef struct {
  PetscBool free, any;         /* whether there is one; whether it may be about any axis through the point */
  PetscBool slides;            /* whether nothing resists a translation along the axis either */
  PetscReal axis[3], point[3]; /* unit vector; a point of the axis [length] */
  PetscReal size;              /* half of the largest side of the body's bounding box [length] */
} MeshRotation;
/* Finds the bodies with free rigid body motions, and their rotations without resistance */
PETSC_EXTERN PetscErrorCode MeshGetUnsupported(DM, Scene, PetscBool unsupported[], MeshRotation rotations[]);
/* Gets the facets of a named face on this rank as local DMPlex points, sorted. Each facet is on exactly one rank. */
PETSC_EXTERN PetscErrorCode MeshGetFacets(DM, const char face[], IS *facets);
/* Gets the vertices of a face on this rank (DMPlex points), including those whose facets other ranks own */
PETSC_EXTERN PetscErrorCode MeshGetFaceVertices(DM, const char face[], IS *vertices);
PETSC_EXTERN PetscErrorCode MeshGetCyclicImages(DM, const SceneCyclic *, PetscReal turn[3][3], PetscInt *n,
  PetscInt *nodes[], PetscInt *images[]);
/* Gets the global rows of one displacement component at the nodes of a face that this rank owns */
PETSC_EXTERN PetscErrorCode MeshGetFaceDofs(DM, const char face[], PetscInt component, IS *rows);
/* Gets the 4 vertices of a facet, counterclockwise seen from outside the body. A triangle repeats its last vertex. */
PETSC_EXTERN PetscErrorCode MeshGetFacetVertices(DM, PetscInt facet, PetscInt vertices[4]);
/* Computes twice the area vector of an undeformed facet; and sums of these vectors and of their lengths over all
   ranks */
PETSC_EXTERN void           MeshComputeFacetArea(PetscReal x[4][3], PetscReal area[3]);
PETSC_EXTERN PetscErrorCode MeshSumFacetAreas(DM, IS facets, PetscReal sums[4]);
/* Returns whether these sums are those of a plane face, which are equal */
PETSC_EXTERN PetscBool MeshFacetsArePlane(const PetscReal sums[4]);
/* Gets the 8 vertices of a hexahedron in tensor order, where x varies fastest */
PETSC_EXTERN PetscErrorCode MeshGetCellVertices(DM, PetscInt cell, PetscInt vertices[8]);
PETSC_EXTERN PetscErrorCode MeshGetCellCorners(DM, PetscInt cell, PetscInt *n, PetscInt vertices[8]);
/* Gets the nodes of a facet: 4 or 3 vertices, or for order 2 also the nodes on edges and facet, 9 or 6. Gets the
   nodes of a hexahedron, 8 or 27 in tensor order, or of a tetrahedron, 4 or 10 */
PETSC_EXTERN PetscErrorCode MeshGetFacetNodes(DM, PetscInt facet, PetscInt *n, PetscInt nodes[MESH_MAX_FACET_NODES]);
/* Divides a facet at its nodes into bilinear facets: 1, or 4 if the order is 2. Each has 4 nodes, counterclockwise seen
   from outside; a triangle repeats its last node. */
#define MESH_MAX_FACET_PIECES 4
PETSC_EXTERN PetscErrorCode MeshGetFacetPieces(DM, PetscInt facet, PetscInt *n,
  PetscInt pieces[MESH_MAX_FACET_PIECES][4]);
PETSC_EXTERN PetscErrorCode MeshGetCellNodes(DM, PetscInt cell, PetscInt *n, PetscInt nodes[MESH_MAX_NODES]);
/* The two end vertices of the edge on which each node of a tetrahedron lies; and the values and derivatives of its
   shape functions */
PETSC_EXTERN const PetscInt MeshTetrahedronEnds[10][2];
PETSC_EXTERN void           MeshTetrahedronShape(PetscInt n, const PetscReal xi[3], PetscReal N[],
            PetscReal dN[3][MESH_MAX_NODES]);
/* The integration points of a tetrahedron of 4 or 10 nodes, and their weights */
PETSC_EXTERN void MeshTetrahedronRule(PetscInt nnodes, PetscInt *npoints, PetscReal xi[][3], PetscReal weight[]);
/* Shape functions of a cell with n nodes, and their derivatives, at a point of the reference cube or tetrahedron */
PETSC_EXTERN void MeshCellShape(PetscInt n, const PetscReal xi[3], PetscReal N[], PetscReal dN[3][MESH_MAX_NODES]);
/* Number of nodes of a cell of every body, on all ranks */
PETSC_EXTERN PetscErrorCode MeshGetBodyNodes(DM, PetscInt nbodies, PetscInt nnodes[]);
/* Reference coordinates of all local nodes, as a local vector of the mesh [length] */
PETSC_EXTERN PetscErrorCode MeshGetNodeCoordinates(DM, Vec *);
/* Reference coordinates of local vertices [length] */
PETSC_EXTERN PetscErrorCode MeshGetVertexCoordinates(DM, PetscInt n, const PetscInt vertices[], PetscReal places[][3]);
/* Position of a point in a mesh: the cell that contains it, and the values of the shape functions of the cell's
   nodes there */
typedef struct {
  PetscReal distance; /* distance of the point from the cell [length] */
  PetscReal size;     /* diagonal of the cell's bounding box [length] */
  PetscInt  cell, n;  /* number of the cell; number of its nodes */
  PetscInt  body;     /* body of the cell */
  PetscReal N[MESH_MAX_NODES];
} MeshPlace;

/* Finds the cells that contain given points, among the cells of a DM or any other cells */
typedef struct _n_MeshLocator *MeshLocator;
PETSC_EXTERN PetscErrorCode    MeshLocate(DM, PetscInt n, const PetscReal points[][3], const PetscInt body[],
     MeshPlace places[]);
PETSC_EXTERN PetscErrorCode    MeshLocatorCreate(PetscInt n, const PetscReal points[][3], const PetscInt body[],
     MeshLocator *);
PETSC_EXTERN PetscErrorCode MeshLocatorAddCell(MeshLocator, PetscInt cell, PetscInt body, PetscInt n, PetscReal X[][3]);
PETSC_EXTERN PetscErrorCode MeshLocatorGetPlaces(MeshLocator, const MeshPlace **);
PETSC_EXTERN PetscErrorCode MeshLocatorDestroy(MeshLocator *);
/* Locates the points of a scene's probes. It is an error if a point is outside all bodies. */
PETSC_EXTERN PetscErrorCode MeshLocateProbes(DM, Scene, PetscInt *n, PetscReal (*points[])[3], MeshPlace *places[]);

#endif
