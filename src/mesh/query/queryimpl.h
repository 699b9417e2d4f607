/*
   What is asked of a mesh that is there: nodes, cells, facets, points in it.
*/
#ifndef QUERYIMPL_H
#define QUERYIMPL_H

#include "src/mesh/shapes/shapesimpl.h"

/* boundary.c */
#define MESH_INNER_LABEL "inner" /* of facets inside a body that have one cell */

/* names.c: lists of names; joined with commas, or the word none, cut off at size */
PETSC_INTERN PetscErrorCode NamesDestroy(PetscInt *n, char ***names);
PETSC_INTERN PetscErrorCode NamesJoin(PetscInt n, char *const names[], size_t size, char text[]);

/* tetrahedron.c: the place of a node on the reference tetrahedron; and what is public */
PETSC_INTERN void MeshTetrahedronPlace(PetscInt node, PetscReal xi[3]);

/* query.c: number within DMPlex's cell of so many corners of the vertex at each corner; the corners of a cell; and
   what is public */
PETSC_INTERN const PetscInt *MeshPlexCorners(PetscInt ncorners);
PETSC_INTERN PetscErrorCode  MeshGetCellCorners(DM, PetscInt cell, PetscInt *n, PetscInt vertices[8]);

/* nodes.c: the points that carry displacements. Their places are first straight between the vertices in a shape's
   parameters, then mapped and bent like the vertices. MeshUpdateVertices() copies the vertices' places back to DMPlex.
   */
typedef struct {
  PetscSection section;
  Vec          x; /* [length], or a shape's parameters */
} MeshPlaces;
PETSC_INTERN PetscErrorCode MeshSetSection(DM, const PetscInt orders[]);
PETSC_INTERN PetscErrorCode MeshCreateNodes(DM, PetscInt nbodies, const PetscInt orders[]);
PETSC_INTERN PetscErrorCode MeshGetPlaces(DM, PetscBool nodes, MeshPlaces *);
PETSC_INTERN PetscErrorCode MeshGetCellPoints(DM, PetscSection, PetscInt cell, PetscInt *n,
  PetscInt points[MESH_MAX_NODES]);
PETSC_INTERN void           MeshPlacesSetStraight(PetscInt ncorners, const PetscReal corners[][3],
            PetscReal places[MESH_MAX_NODES][3]);
PETSC_INTERN PetscErrorCode MeshUpdateVertices(DM);

/* quality.c: the slopes of a cell's shape functions at its nodes, which come first, and at the integration points of
   order 2; the smallest of the Jacobian's determinants there. Collective error if a cell is inverted or flat at one
   of its corners; mapped: at one of these places, also in bodies that are mapped after refinement */
#define MESH_QUALITY_PLACES (2 * MESH_MAX_NODES)
typedef struct {
  PetscInt  nnodes, nplaces;
  PetscReal dN[MESH_QUALITY_PLACES][3][MESH_MAX_NODES];
} MeshQualityTable;
PETSC_INTERN PetscErrorCode MeshQualityTableCreate(PetscInt nnodes, MeshQualityTable *);
PETSC_INTERN PetscReal      MeshCellQuality(const MeshQualityTable *, PetscReal x[][3]);
PETSC_INTERN PetscErrorCode MeshCheckCells(DM, PetscInt nbodies, const SceneBody[], PetscBool mapped);

/* places.c: where the nodes that this rank owns are, undeformed, and in which body; in the order of the global
   vectors */
typedef struct {
  Vec       x;    /* [length] */
  PetscInt *body; /* one a node */
} VertexPlaces;

PETSC_INTERN PetscErrorCode VertexPlacesCreate(DM, VertexPlaces *);
PETSC_INTERN PetscErrorCode VertexPlacesDestroy(VertexPlaces *);

#endif
