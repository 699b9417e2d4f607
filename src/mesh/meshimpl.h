/* Private header of mesh: creates the mesh of all bodies. */
#ifndef MESHIMPL_H
#define MESHIMPL_H

#include "src/mesh/gmsh/gmshimpl.h"
#include "src/mesh/refine/refineimpl.h"

/* faces.c: computes the name of the label of a body's face */
PETSC_INTERN PetscErrorCode MeshFaceLabelName(const char body[], const char face[], size_t length, char name[]);

/*
   subfaces.c: parts of faces. MeshCheckSubfaces() is collective and checks that each part belongs to an existing face.
   MeshLabelSubfaces() is not collective and sets the labels at level 0 on this rank; first: the body's first vertex.
   MeshCheckSubfacesFilled() is collective and reports parts without facets as errors.
*/
PETSC_INTERN PetscErrorCode MeshCheckSubfaces(MPI_Comm, const SceneBody *);
PETSC_INTERN PetscErrorCode MeshLabelSubfaces(DM, const SceneBody *, const ShapeGrid *, PetscInt first);
PETSC_INTERN PetscErrorCode MeshCheckSubfacesFilled(DM, const SceneBody *);

/* point_labels.c: labels of the nodes at which the scene prescribes displacements at points and along edges; used like
   labels of faces */
PETSC_INTERN PetscErrorCode MeshLabelPoints(DM, Scene);

/* rigid_labels.c: creates a label for each rigid body; called after the last refinement */
PETSC_INTERN PetscErrorCode MeshLabelRigid(DM, PetscInt nbodies, const SceneBody[]);

/* body.c: creates the grids of all bodies at level 0 on the first rank */
PETSC_INTERN PetscErrorCode MeshCreateBodies(MPI_Comm, PetscInt nbodies, const SceneBody[], MeshBody[]);
PETSC_INTERN PetscErrorCode MeshDestroyBodies(PetscInt nbodies, MeshBody[]);

/* map.c: maps shape parameters to space. If curved is true, it maps the nodes of bodies whose refinement follows the
   curved shape; otherwise it maps the vertices of the other bodies at level 0. */
PETSC_INTERN PetscErrorCode MeshMapNodes(DM, PetscInt nbodies, const SceneBody[], PetscBool curved);

/* metis.c: partitions a whole graph by METIS, part[v] in [0, nparts); registers the partitioner "metis" */
PETSC_INTERN PetscErrorCode MetisPartitionGraph(PetscInt nparts, PetscInt nv, const PetscInt start[],
  const PetscInt adjacency[], const PetscInt weights[], PetscInt part[]);
PETSC_INTERN PetscErrorCode MeshRegisterPartitioner(void);

/* distribute_level0.c: collective; distributes the grids of the first rank to all ranks */
typedef struct {
  PetscBool    distributed; /* false: all grids are on the first rank */
  PetscInt     n;           /* number of vertices of this rank */
  PetscSFNode *points;      /* [n] owner rank of each vertex, and its point in the owner's mesh of cells and vertices */
} MeshOwners;
PETSC_INTERN PetscErrorCode MeshDistributeGrids(MPI_Comm, PetscInt nbodies, MeshBody[], MeshOwners *);
PETSC_INTERN PetscErrorCode MeshOwnersDestroy(MeshOwners *);

/* level0.c: creates all bodies at level 0 with their labels, on the first rank or distributed */
PETSC_INTERN PetscErrorCode MeshCreateLevel0(MPI_Comm, PetscInt nbodies, const SceneBody[], const MeshBody[],
  const MeshOwners *, DM *);

/* surfaces.c and create.c have public functions only. */

#endif
