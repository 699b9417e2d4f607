/* One body at level 0: whether its parameters are sound, and its grid */
#include "meshimpl.h"

/*@
  MeshCheckBody - Checks the parameters of a body's shape, or that its mesh file has its volume, and the parts of its faces

  Collective

  Input Parameters:
+ comm - communicator
- body - the body, the same on all ranks

  Level: intermediate

  Notes:
  Raises an error on all ranks if something is wrong. Of a Gmsh file only the head is read.

.seealso: `MeshCreate()`, `MeshGetFaceNames()`
@*/
PetscErrorCode MeshCheckBody(MPI_Comm comm, const SceneBody *body)
{
  const Shape *shape;
  PetscInt64   ncells, nvertices;
  PetscInt     tag;

  PetscFunctionBegin;
  PetscCall(ShapeGet(comm, body, &shape));
  if (shape) PetscCall(shape->size(comm, body, &ncells, &nvertices));
  else PetscCall(GmshGetVolumeTag(comm, body, &tag));
  PetscCall(MeshCheckSubfaces(comm, body));
  PetscFunctionReturn(0);
}

PetscErrorCode MeshCreateBodies(MPI_Comm comm, PetscInt nbodies, const SceneBody bodies[], MeshBody meshes[])
{
  GmshFile    file = {NULL, NULL};
  PetscMPIInt rank;

  PetscFunctionBegin;
  PetscCallMPI(MPI_Comm_rank(comm, &rank));
  for (PetscInt b = 0; b < nbodies; ++b) {
    MeshBody    *mesh = &meshes[b];
    PetscInt64   size[2];
    const Shape *shape;

    PetscCall(ShapeGet(comm, &bodies[b], &shape));
    PetscCall(MeshCheckBody(comm, &bodies[b]));
    PetscCall(MeshGetFaceNames(comm, &bodies[b], &mesh->nfaces, &mesh->faces));
    if (shape) {
      PetscCall(shape->size(comm, &bodies[b], &mesh->ncells, &mesh->nvertices));
      if (rank == 0) PetscCall(shape->create(&bodies[b], &mesh->grid));
    } else {
      PetscCall(GmshFileOpen(comm, &bodies[b], &file));
      PetscCall(GmshFileGetGrid(comm, &file, &bodies[b], &mesh->grid));
      size[0] = mesh->grid.ncells;
      size[1] = mesh->grid.nvertices;
      PetscCallMPI(MPI_Bcast(size, 2, MPIU_INT64, 0, comm));
      mesh->ncells    = size[0];
      mesh->nvertices = size[1];
    }
  }
  PetscCall(GmshFileClose(&file));
  PetscFunctionReturn(0);
}

PetscErrorCode MeshDestroyBodies(PetscInt nbodies, MeshBody meshes[])
{
  PetscFunctionBegin;
  for (PetscInt b = 0; b < nbodies; ++b) {
    PetscCall(MeshRestoreFaceNames(&meshes[b].nfaces, &meshes[b].faces));
    PetscCall(ShapeGridDestroy(&meshes[b].grid));
  }
  PetscFunctionReturn(0);
}
