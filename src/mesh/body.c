/* One body at level 0: checks of its parameters, and its grid on the first rank */
#include "meshimpl.h"

/*@
  MeshCheckBody - Checks the parameters of a body's shape, or that the mesh file contains the named volume, and the
  parts of the body's faces

  Collective

  Input Parameters:
+ comm - communicator
- body - the body, the same on all ranks

  Level: intermediate

  Notes:
  An error is raised on all ranks. Only the first sections of a Gmsh file, up to the physical names, are read.

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

/* Collective. Creates the grid of a body with a built-in shape on the first rank. The only error is that memory is
   insufficient. */
static PetscErrorCode MeshCreateGrid(MPI_Comm comm, const SceneBody *body, const Shape *shape, MeshBody *mesh)
{
  PetscMPIInt rank;

  PetscFunctionBegin;
  PetscCall(shape->size(comm, body, &mesh->ncells, &mesh->nvertices));
  mesh->ncorners = 8;
  PetscCallMPI(MPI_Comm_rank(comm, &rank));
  RankCallFor(comm, rank == 0, shape->create(body, &mesh->grid),
    "%sBody \"%s\": the first rank cannot create its %" PetscInt64_FMT " level 0 cells: ", ScenePlace(body), body->name,
    mesh->ncells);
  PetscFunctionReturn(0);
}

/* Collective. Reads the grid of a body from its Gmsh file on the first rank, and sends its sizes to all ranks */
static PetscErrorCode MeshReadGrid(MPI_Comm comm, const SceneBody *body, GmshFile *file, MeshBody *mesh)
{
  PetscInt64 size[4];

  PetscFunctionBegin;
  PetscCall(GmshFileOpen(comm, body, file));
  PetscCall(GmshFileGetGrid(comm, file, body, &mesh->grid));
  size[0] = mesh->grid.ncells;
  size[1] = mesh->grid.nvertices;
  size[2] = mesh->grid.curve ? 1 : 0;
  size[3] = mesh->grid.ncorners;
  PetscCallMPI(MPI_Bcast(size, 4, MPIU_INT64, 0, comm));
  mesh->ncells    = size[0];
  mesh->nvertices = size[1];
  mesh->quadratic = size[2] ? PETSC_TRUE : PETSC_FALSE;
  mesh->ncorners  = (PetscInt)size[3];
  PetscFunctionReturn(0);
}

PetscErrorCode MeshCreateBodies(MPI_Comm comm, PetscInt nbodies, const SceneBody bodies[], MeshBody meshes[])
{
  GmshFile file = {.name = NULL};

  PetscFunctionBegin;
  for (PetscInt b = 0; b < nbodies; ++b) {
    const Shape *shape;

    PetscCall(ShapeGet(comm, &bodies[b], &shape));
    PetscCall(MeshCheckBody(comm, &bodies[b]));
    PetscCall(MeshGetFaceNames(comm, &bodies[b], &meshes[b].nfaces, &meshes[b].faces));
    if (shape) PetscCall(MeshCreateGrid(comm, &bodies[b], shape, &meshes[b]));
    else PetscCall(MeshReadGrid(comm, &bodies[b], &file, &meshes[b]));
    meshes[b].order = bodies[b].order           ? bodies[b].order
                      : meshes[b].ncorners == 4 ? 2
                                                /* The default order of tetrahedra is 2, because straight tetrahedra of
                                                   order 1 are much too stiff. */
                                                : 1;
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
