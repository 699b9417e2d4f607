/*
   Queries of an existing mesh: nodes, cells, facets, location of points.
*/
#ifndef QUERYIMPL_H
#define QUERYIMPL_H

#include "src/mesh/shapes/shapesimpl.h"

/* boundary.c */
#define MESH_INNER_LABEL "inner" /* label of facets with one cell that are inside a body (local refinement) */

/* names.c: lists of names; joined by commas, or the word none, truncated to size */
PETSC_INTERN PetscErrorCode NamesDestroy(PetscInt *n, char ***names);
PETSC_INTERN PetscErrorCode NamesJoin(PetscInt n, char *const names[], size_t size, char text[]);

/* tetrahedron.c: position of a node on the reference tetrahedron */
PETSC_INTERN void MeshTetrahedronPlace(PetscInt node, PetscReal xi[3]);

/* query.c: DMPlex's vertex number for each corner of a cell; the corners of a cell */
PETSC_INTERN const PetscInt *MeshPlexCorners(PetscInt ncorners);

/* nodes.c: points that carry displacements. Their positions are first straight between the vertices in a shape's
   parameters, then mapped and curved like the vertices. MeshUpdateVertices() copies the vertices' positions back to
   DMPlex. */
typedef struct {
  PetscSection section;
  Vec          x; /* coordinates [length], or a shape's parameters */
} MeshPlaces;
PETSC_INTERN PetscErrorCode MeshSetSection(DM, const PetscInt orders[]);
PETSC_INTERN PetscErrorCode MeshCreateNodes(DM, PetscInt nbodies, const PetscInt orders[]);
PETSC_INTERN PetscErrorCode MeshGetPlaces(DM, PetscBool nodes, MeshPlaces *);
PETSC_INTERN PetscErrorCode MeshGetCellPoints(DM, PetscSection, PetscInt cell, PetscInt *n,
  PetscInt points[MESH_MAX_NODES]);
PETSC_INTERN void           MeshPlacesSetStraight(PetscInt ncorners, const PetscReal corners[][3],
            PetscReal places[MESH_MAX_NODES][3]);
PETSC_INTERN PetscErrorCode MeshUpdateVertices(DM);

/* quality.c: derivatives of a cell's shape functions at its nodes, then at the quadrature points of order 2; the
   smallest Jacobian determinant there. Collective error if a cell is inverted or flat at a corner; mapped: at any of
   these points, also in bodies that are mapped after refinement */
#define MESH_QUALITY_PLACES (2 * MESH_MAX_NODES)
typedef struct {
  PetscInt  nnodes, nplaces;
  PetscReal dN[MESH_QUALITY_PLACES][3][MESH_MAX_NODES];
} MeshQualityTable;
PETSC_INTERN PetscErrorCode MeshQualityTableCreate(PetscInt nnodes, MeshQualityTable *);
PETSC_INTERN PetscReal      MeshCellQuality(const MeshQualityTable *, PetscReal x[][3]);
PETSC_INTERN PetscErrorCode MeshCheckCells(DM, PetscInt nbodies, const SceneBody[], PetscBool mapped);

/* places.c: undeformed coordinates and body of each owned node, in the order of global vectors */
typedef struct {
  Vec       x;    /* [length] */
  PetscInt *body; /* one per node */
} VertexPlaces;

PETSC_INTERN PetscErrorCode VertexPlacesCreate(DM, VertexPlaces *);
PETSC_INTERN PetscErrorCode VertexPlacesDestroy(VertexPlaces *);

#endif
