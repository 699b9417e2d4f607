/*
   Private header of mesh: from the bodies to the mesh of all.
*/
#ifndef MESHIMPL_H
#define MESHIMPL_H

#include "src/mesh/gmsh/gmshimpl.h"
#include "src/mesh/refine/refineimpl.h"

/* faces.c: name of the label of a body's face */
PETSC_INTERN PetscErrorCode MeshFaceLabelName(const char body[], const char face[], size_t length, char name[]);

/* subfaces.c: parts of faces. Check: collective, whether the faces they are cut from exist; Label: not collective,
   labels at level 0 on this rank, first: the body's first vertex; collective: error if a part has no facets */
PETSC_INTERN PetscErrorCode MeshCheckSubfaces(MPI_Comm, const SceneBody *);
PETSC_INTERN PetscErrorCode MeshLabelSubfaces(DM, const SceneBody *, const ShapeGrid *, PetscInt first);
PETSC_INTERN PetscErrorCode MeshCheckSubfacesFilled(DM, const SceneBody *);

/* point_labels.c: labels of the nodes at the scene's points and edges, like those of faces */
PETSC_INTERN PetscErrorCode MeshLabelPoints(DM, Scene);

/* rigid_labels.c: a label for each rigid body, created after the last refinement */
PETSC_INTERN PetscErrorCode MeshLabelRigid(DM, PetscInt nbodies, const SceneBody[]);

/* body.c: bodies at level 0, created on the rank where the shape or file is read */
PETSC_INTERN PetscErrorCode MeshCreateBodies(MPI_Comm, PetscInt nbodies, const SceneBody[], MeshBody[]);
PETSC_INTERN PetscErrorCode MeshDestroyBodies(PetscInt nbodies, MeshBody[]);

/* map.c: maps shape parameters to space: the nodes of bodies with curved refinement; at level 0 the vertices of
   other bodies */
PETSC_INTERN PetscErrorCode MeshMapNodes(DM, PetscInt nbodies, const SceneBody[], PetscBool curved);

/* metis.c: METIS on a whole graph, part[v] in [0, nparts); the partitioner is public */
PETSC_INTERN PetscErrorCode MetisPartitionGraph(PetscInt nparts, PetscInt nv, const PetscInt start[],
  const PetscInt adjacency[], const PetscInt weights[], PetscInt part[]);

/* distribute_level0.c: collective; distributes the grids of rank 0. Owner rank of each vertex, and its point in the
   owner's mesh of cells and vertices */
typedef struct {
  PetscBool    distributed; /* false: everything is on rank 0 */
  PetscInt     n;
  PetscSFNode *points;
} MeshOwners;
PETSC_INTERN PetscErrorCode MeshDistributeGrids(MPI_Comm, PetscInt nbodies, MeshBody[], MeshOwners *);
PETSC_INTERN PetscErrorCode MeshOwnersDestroy(MeshOwners *);

/* level0.c: all bodies at level 0 with their labels, on rank 0 or distributed */
PETSC_INTERN PetscErrorCode MeshCreateLevel0(MPI_Comm, PetscInt nbodies, const SceneBody[], const MeshBody[],
  const MeshOwners *, DM *);

/* boundary.c, create.c, check_supports.c: only public functions */

#endif
