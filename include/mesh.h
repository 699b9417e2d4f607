/*
   Meshes: one DMPlex of hexahedra and tetrahedra for all bodies (disjoint components), distributed and refined.

   Labels: "body" (cells -> index of the body); one label per named face, "<body>.<face>", stratum 1 holding its facets
   and their edges and vertices (MeshGetFaceNames() lists the faces of a body). Local section: 3 displacement components
   per node, interleaved, block size 3, no constrained dofs. The nodes of a body of order 1 are its vertices, those of a
   body of order 2 also its edges, and of hexahedra its facets and cells. Coordinates are the reference geometry.
*/
#ifndef MESH_H
#define MESH_H

#include <petscdmplex.h>
#include "model.h"

#define MESH_BODY_LABEL      "body"
#define MESH_MAX_NODES       27 /* of a cell */
#define MESH_MAX_FACET_NODES 9

/* What the number of a cell's nodes says: tetrahedra have 4 or 10, hexahedra 8 or 27 */
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

/* The mesh of all bodies, refined uniformly `refine` times */
PETSC_EXTERN PetscErrorCode MeshCreate(MPI_Comm, PetscInt nbodies, const SceneBody[], PetscInt refine, DM *);
/* Cells marked for refinement on one mesh after another, as cell numbers on the first rank */
typedef struct {
  PetscInt   n, *count; /* rounds, and the cells of each */
  PetscInt **cells;
} MeshMarks;
/* The mesh of a scene: refined where the scene says so, then where cells are marked; NULL: no cell will be marked */
PETSC_EXTERN PetscErrorCode MeshCreateScene(MPI_Comm, Scene, const MeshMarks *, DM *);
PETSC_EXTERN PetscErrorCode MeshMarksAdd(DM, const PetscBool marked[], MeshMarks *);
PETSC_EXTERN PetscErrorCode MeshMarksDestroy(MeshMarks *);
/* Hanging vertices, in the middle of an edge or a facet of a coarser cell, and the vertices whose mean they are; NULL:
   none */
PETSC_EXTERN PetscErrorCode MeshGetHanging(DM, Mat *means);
PETSC_EXTERN PetscErrorCode MeshCountHanging(DM, PetscInt *n);
/* The facets of this rank that bound the bodies */
PETSC_EXTERN PetscErrorCode MeshMarkBoundary(DM, PetscBool boundary[]);
/* Checks the shape's parameters, or that the mesh file has the volume, and the parts of faces that the body names */
PETSC_EXTERN PetscErrorCode MeshCheckBody(MPI_Comm, const SceneBody *);
/* Names of a body's faces, without the body's name: those of the shape or the physical surfaces of the Gmsh file, then
   the parts of them */
PETSC_EXTERN PetscErrorCode MeshGetFaceNames(MPI_Comm, const SceneBody *, PetscInt *n, char ***names);
PETSC_EXTERN PetscErrorCode MeshRestoreFaceNames(PetscInt *n, char ***names);
/* Checks that the faces of a scene have facets, and that every body is held by displacements or contact */
PETSC_EXTERN PetscErrorCode MeshCheckScene(DM, Scene);
PETSC_EXTERN PetscErrorCode MeshGetUnheld(DM, Scene, PetscBool unheld[]);
/* Named face of a mesh: its facets (each facet is on exactly one rank, overlap 0) as local DMPlex points, sorted */
PETSC_EXTERN PetscErrorCode MeshGetFacets(DM, const char face[], IS *facets);
/* Local vertices (DMPlex points) in the closure of a face, also of facets that other ranks own */
PETSC_EXTERN PetscErrorCode MeshGetFaceVertices(DM, const char face[], IS *vertices);
/* Global rows of the given component of the face's nodes that this rank owns */
PETSC_EXTERN PetscErrorCode MeshGetFaceDofs(DM, const char face[], PetscInt component, IS *rows);
/* The 4 vertices of a facet, counterclockwise seen from outside the body (a triangle repeats the last one). The 8
   vertices of a hexahedron in tensor order, x fastest */
PETSC_EXTERN PetscErrorCode MeshGetFacetVertices(DM, PetscInt facet, PetscInt vertices[4]);
PETSC_EXTERN PetscErrorCode MeshGetCellVertices(DM, PetscInt cell, PetscInt vertices[8]);
/* The nodes of a facet: its 4 vertices, or 9 with edge and facet nodes; of a triangle 3 or 6. The nodes of a
   hexahedron, 8 or 27 in tensor order, or of a tetrahedron, 4 or 10 */
PETSC_EXTERN PetscErrorCode MeshGetFacetNodes(DM, PetscInt facet, PetscInt *n, PetscInt nodes[MESH_MAX_FACET_NODES]);
/* Cuts a facet by its nodes into bilinear facets: 1, or 4 of order 2. Each has 4 nodes, counterclockwise seen from
   outside; a triangle repeats the last one */
#define MESH_MAX_FACET_PIECES 4
PETSC_EXTERN PetscErrorCode MeshGetFacetPieces(DM, PetscInt facet, PetscInt *n,
  PetscInt pieces[MESH_MAX_FACET_PIECES][4]);
PETSC_EXTERN PetscErrorCode MeshGetCellNodes(DM, PetscInt cell, PetscInt *n, PetscInt nodes[MESH_MAX_NODES]);
/* The two corners that each node of a tetrahedron lies between; values and derivatives of its shape functions */
PETSC_EXTERN const PetscInt MeshTetrahedronEnds[10][2];
PETSC_EXTERN void           MeshTetrahedronShape(PetscInt n, const PetscReal xi[3], PetscReal N[],
            PetscReal dN[3][MESH_MAX_NODES]);
/* The integration points of a tetrahedron of 4 or 10 nodes, and their weights */
PETSC_EXTERN void MeshTetrahedronRule(PetscInt nnodes, PetscInt *npoints, PetscReal xi[][3], PetscReal weight[]);
/* The shape functions of n nodes at a place of the reference cube, or tetrahedron, and their derivatives */
PETSC_EXTERN void MeshCellShape(PetscInt n, const PetscReal xi[3], PetscReal N[], PetscReal dN[3][MESH_MAX_NODES]);
/* The order of every body on all ranks: the requested one, or that of its cells */
PETSC_EXTERN PetscErrorCode MeshGetOrders(DM, PetscInt nbodies, PetscInt orders[]);
/* Reference coordinates of all local nodes, as a local vector of the mesh [length] */
PETSC_EXTERN PetscErrorCode MeshGetNodeCoordinates(DM, Vec *);
/* Reference coordinates of local vertices [length] */
PETSC_EXTERN PetscErrorCode MeshGetVertexCoordinates(DM, PetscInt n, const PetscInt vertices[], PetscReal places[][3]);
/* The place of a point in a mesh: a cell, and the values of its nodes' shape functions there, in the order of the
   nodes */
typedef struct {
  PetscReal distance; /* of the point from the cell [length] */
  PetscReal size;     /* of the cell: diagonal of its box [length] */
  PetscInt  cell, n;  /* nodes of the cell */
  PetscInt  body;     /* that the cell is of */
  PetscReal N[MESH_MAX_NODES];
} MeshPlace;

/* Fields of a mesh, global vectors, at points of this rank: nfields x 3 values a point; missing: points of all ranks
   that no cell is near */
PETSC_EXTERN PetscErrorCode MeshEvaluate(DM, PetscInt nfields, const Vec fields[], PetscInt npoints,
  const PetscReal points[][3], const PetscInt body[], PetscReal values[], PetscInt *missing);

/* In which cells of a mesh are points? Of any cells, which need not be those of a DM */
typedef struct _n_MeshLocator *MeshLocator;
PETSC_EXTERN PetscErrorCode    MeshLocate(DM, PetscInt n, const PetscReal points[][3], const PetscInt body[],
     MeshPlace places[]);
PETSC_EXTERN PetscErrorCode    MeshLocatorCreate(PetscInt n, const PetscReal points[][3], const PetscInt body[],
     MeshLocator *);
PETSC_EXTERN PetscErrorCode MeshLocatorAddCell(MeshLocator, PetscInt cell, PetscInt body, PetscInt n, PetscReal X[][3]);
PETSC_EXTERN PetscErrorCode MeshLocatorGetPlaces(MeshLocator, const MeshPlace **);
PETSC_EXTERN PetscErrorCode MeshLocatorDestroy(MeshLocator *);
/* The points of a scene's probes; an error where one is in no body */
PETSC_EXTERN PetscErrorCode MeshLocateProbes(DM, Scene, PetscInt *n, PetscReal (*points[])[3], MeshPlace *places[]);
/* PETSCPARTITIONER type "metis" */
PETSC_EXTERN PetscErrorCode MeshRegisterPartitioner(void);

#endif
