/* Queries of an existing mesh: nodes, cells, facets, and the location of points. */
#ifndef QUERYIMPL_H
#define QUERYIMPL_H

#include "src/mesh/shapes/shapesimpl.h"

/* boundary.c: the name of a label. It contains the facets with one cell that are inside a body, between finer and
   coarser cells. */
#define MESH_INNER_LABEL "inner"

/* names.c: lists of names. NamesJoin() joins them by commas to a text, or writes the word none if there are none; the
   text is truncated to size. */
PETSC_INTERN PetscErrorCode NamesDestroy(PetscInt *n, char ***names);
PETSC_INTERN PetscErrorCode NamesJoin(PetscInt n, char *const names[], size_t size, char text[]);

/* gather.c: the values of shared points; the lists of all ranks, on every rank or on the first one */
PETSC_INTERN PetscErrorCode ValuesReduce(PetscSF, MPI_Datatype, MPI_Op, void *values);
PETSC_INTERN PetscErrorCode RecordsGather(MPI_Comm, PetscInt reals, PetscInt *n, void *records);
PETSC_INTERN PetscErrorCode IntegersGather(MPI_Comm, const char what[], PetscInt n, const PetscInt local[],
  PetscMPIInt counts[], PetscMPIInt displs[], PetscInt *total, PetscInt **all);

/* tetrahedron.c: position of a node in the reference tetrahedron */
PETSC_INTERN void MeshTetrahedronPlace(PetscInt node, PetscReal xi[3]);

/* query.c: the number of each corner of a cell in the closure of DMPlex, and the corners of a cell */
PETSC_INTERN const PetscInt *MeshPlexCorners(PetscInt ncorners);

/*
   nodes.c: points that carry displacements. First, their coordinates are those of straight cells between the vertices,
   which may be parameters of a shape. Then they are mapped to space or to curves like the vertices.
   MeshUpdateVertices() copies the coordinates of the vertices back to the DMPlex.
*/
typedef struct {
  PetscSection section;
  Vec          x; /* coordinates [length], or a shape's parameters */
} MeshPlaces;
PETSC_INTERN PetscErrorCode MeshSetSection(DM, PetscInt nbodies, const PetscInt orders[]);
PETSC_INTERN PetscErrorCode MeshCreateNodes(DM, PetscInt nbodies, const PetscInt orders[]);
PETSC_INTERN PetscErrorCode MeshGetPlaces(DM, PetscBool nodes, MeshPlaces *);
PETSC_INTERN PetscErrorCode MeshGetCellPoints(DM, PetscSection, PetscInt cell, PetscInt *n,
  PetscInt points[MESH_MAX_NODES]);
PETSC_INTERN void           MeshPlacesSetStraight(PetscInt ncorners, const PetscReal corners[][3],
            PetscReal places[MESH_MAX_NODES][3]);
PETSC_INTERN PetscErrorCode MeshUpdateVertices(DM);

/*
   quality.c: checks that no cell is inverted or flat. A table contains the derivatives of a cell's shape functions at
   its nodes and, for order 2, at the quadrature points. MeshCheckCells() is collective. If `mapped` is false, it checks
   the vertices of bodies that are already mapped to space; otherwise it checks all nodes of all bodies.
*/
#define MESH_QUALITY_PLACES (2 * MESH_MAX_NODES)
typedef struct {
  PetscInt  nnodes, nplaces;
  PetscReal dN[MESH_QUALITY_PLACES][3][MESH_MAX_NODES];
} MeshQualityTable;
PETSC_INTERN PetscErrorCode MeshQualityTableCreate(PetscInt nnodes, MeshQualityTable *);
PETSC_INTERN PetscReal      MeshCellQuality(const MeshQualityTable *, PetscReal x[][3]);
PETSC_INTERN PetscErrorCode MeshCheckCells(DM, PetscInt nbodies, const SceneBody[], PetscBool mapped);

/*
   corner_normals.c: normals of the smooth surface through facets. Corner 4 f + a is vertex a of facet f.

   - MeshCornerAfter(), MeshCornerBefore(): the next corner of the facet, counterclockwise, and the previous one
   - MeshCornerIsNone(): whether it is the fourth corner of a triangle, which stores its last node twice
   - MeshCornerFan(): the first (clockwise) and the last corner around a node before a sharp edge or the border
   - MeshCornerNormal(): the unit normal; MeshCornerMeanNormal(): without the correction at the border
*/
#define MESH_FLAT_CORNER 1e-4 /* a corner counts as straight if the squared sine of its angle is smaller */
typedef struct {
  PetscInt  *node; /* number of the node at each corner */
  PetscInt  *twin; /* corner that represents the same edge in the neighbouring facet; -1 at a sharp edge or at the
                      border */
  PetscReal *x;    /* 3 coordinates of each node [length] */
} MeshFacets;
PETSC_INTERN PetscInt  MeshCornerAfter(const MeshFacets *, PetscInt corner);
PETSC_INTERN PetscInt  MeshCornerBefore(const MeshFacets *, PetscInt corner);
PETSC_INTERN PetscBool MeshCornerIsNone(const MeshFacets *, PetscInt corner);
PETSC_INTERN PetscBool MeshCornerFan(const MeshFacets *, PetscInt corner, PetscInt *first, PetscInt *last);
PETSC_INTERN void      MeshCornerEdges(const MeshFacets *, PetscInt corner, PetscReal after[3], PetscReal before[3]);
PETSC_INTERN PetscReal MeshCornerFanNormal(const MeshFacets *, PetscInt first, PetscInt last, PetscReal normal[3]);
PETSC_INTERN void      MeshCornerMeanNormal(const MeshFacets *, PetscInt corner, PetscReal normal[3]);
PETSC_INTERN void      MeshCornerCorrectNormal(const MeshFacets *, PetscInt first, PetscInt last, PetscReal normal[3]);
PETSC_INTERN void      MeshCornerNormal(const MeshFacets *, PetscInt corner, PetscReal normal[3]);

/* node_places.c: undeformed coordinates and body of each node that this rank owns, in the order of global vectors */
typedef struct {
  Vec       x;    /* global vector of coordinates [length] */
  PetscInt *body; /* body of each owned node */
} VertexPlaces;

/* A rigid motion by a small rotation w: t + w x (x - center) */
typedef struct {
  PetscReal t[3], w[3], center[3];
} BodyMotion;

PETSC_INTERN PetscErrorCode VertexPlacesCreate(DM, VertexPlaces *);
PETSC_INTERN PetscErrorCode VertexPlacesMove(const VertexPlaces *, Vec u, const BodyMotion motions[], Vec moved);
PETSC_INTERN PetscErrorCode MeshFaceSet(DM, const char face[], PetscInt component, PetscReal value, Vec);
PETSC_INTERN PetscErrorCode NodalMagnitudesMeasure(Vec v, PetscReal *sum, PetscReal *largest);
PETSC_INTERN PetscErrorCode VertexPlacesSum(const VertexPlaces *, Vec v, PetscInt nbodies, PetscReal sums[]);
PETSC_INTERN PetscErrorCode VertexPlacesSumForces(const VertexPlaces *, Vec force, Vec all, PetscInt nbodies,
  PetscReal sums[]);
PETSC_INTERN PetscErrorCode VertexPlacesLargest(const VertexPlaces *, Vec v, PetscInt nbodies, PetscReal largest[]);
PETSC_INTERN PetscErrorCode VertexPlacesDestroy(VertexPlaces *);
PETSC_INTERN PetscErrorCode MeshGetBodyBoxes(DM, Vec u, PetscInt nbodies, PetscReal boxes[]);

#endif
