/*
   Mesh, private: from the bodies to the mesh of them all.
*/
#ifndef MESHIMPL_H
#define MESHIMPL_H

#include "src/mesh/gmsh/gmshimpl.h"
#include "src/mesh/refine/refineimpl.h"

/* faces.c: name of the label of a body's face */
PETSC_INTERN PetscErrorCode MeshFaceLabelName(const char body[], const char face[], size_t length, char name[]);

/* subfaces.c: whether those that the body names are of its faces; their labels at level 0, not collective, of this
   rank's part of the body, first: the first vertex; collective: an error if one has no facets on any rank */
PETSC_INTERN PetscErrorCode MeshCheckSubfaces(MPI_Comm, const SceneBody *);
PETSC_INTERN PetscErrorCode MeshLabelSubfaces(DM, const SceneBody *, const ShapeGrid *, PetscInt first);
PETSC_INTERN PetscErrorCode MeshCheckSubfacesFilled(DM, const SceneBody *);

/* point_labels.c: labels of the nodes at the scene's points and edges, as faces have them */
PETSC_INTERN PetscErrorCode MeshLabelPoints(DM, Scene);

/* rigid_labels.c: a label of all that moves with a rigid body, after the last refinement */
PETSC_INTERN PetscErrorCode MeshLabelRigid(DM, PetscInt nbodies, const SceneBody[]);

/* body.c: one body at level 0, made where its shape or file is read */
PETSC_INTERN PetscErrorCode MeshCreateBodies(MPI_Comm, PetscInt nbodies, const SceneBody[], MeshBody[]);
PETSC_INTERN PetscErrorCode MeshDestroyBodies(PetscInt nbodies, MeshBody[]);

/* map.c: from the shapes' parameters to space: the nodes of bodies with curved refinement, or at level 0 the vertices
   of those without */
PETSC_INTERN PetscErrorCode MeshMapNodes(DM, PetscInt nbodies, const SceneBody[], PetscBool curved);

/* metis.c: METIS on a whole graph, part[v] in [0, nparts); and the partitioner, public */
PETSC_INTERN PetscErrorCode MetisPartitionGraph(PetscInt nparts, PetscInt nv, const PetscInt start[],
  const PetscInt adjacency[], const PetscInt weights[], PetscInt part[]);

/* distribute_level0.c: collective; the grids on rank 0 become those of all ranks, each a part. Which rank owns each
   vertex here, as which point of a mesh of cells and vertices */
typedef struct {
  PetscBool    distributed; /* else all is on rank 0 */
  PetscInt     n;
  PetscSFNode *points;
} MeshOwners;
PETSC_INTERN PetscErrorCode MeshDistributeGrids(MPI_Comm, PetscInt nbodies, MeshBody[], MeshOwners *);
PETSC_INTERN PetscErrorCode MeshOwnersDestroy(MeshOwners *);

/* level0.c: all bodies at level 0 with their labels, on rank 0 or distributed */
PETSC_INTERN PetscErrorCode MeshCreateLevel0(MPI_Comm, PetscInt nbodies, const SceneBody[], const MeshBody[],
  const MeshOwners *, DM *);

/* boundary.c, create.c, check_supports.c: MeshCreate(), and whether the scene holds its bodies, public */

#endif
