/* The surfaces of all bodies at refinement level 0 */
#include "meshimpl.h"

/* Computes the coordinates of a grid's vertices [length]. The caller frees *x. */
static PetscErrorCode SurfacesPlaceVertices(const SceneBody *body, const ShapeGrid *grid, PetscReal **x)
{
  const Shape *shape;

  PetscFunctionBegin;
  PetscCall(ShapeGet(PETSC_COMM_SELF, body, &shape));
  PetscCall(PetscMalloc1(3 * grid->nvertices, x));
  for (PetscInt v = 0; v < grid->nvertices; ++v) {
    if (shape && shape->map) PetscCall(shape->map(body, grid->coordinates + 3 * v, *x + 3 * v));
    else PetscCall(PetscArraycpy(*x + 3 * v, grid->coordinates + 3 * v, 3));
  }
  PetscFunctionReturn(0);
}

/* Names the regions of a body's boundary. A region that consists of the same facets as a face of the shape or file gets
   the name of that face; others are named "surface_1", "surface_2", ... nfaces: number of faces of the shape or file */
static PetscErrorCode SurfacesName(const SceneBody *body, const MeshBody *mesh, PetscInt nfaces,
  const ShapeBoundary *boundary, MeshSurfaces *s)
{
  PetscInt *region;

  PetscFunctionBegin;
  PetscCall(PetscMalloc1(nfaces, &region));
  PetscCall(ShapeBoundaryMatchFaces(boundary, &mesh->grid, nfaces, region));
  PetscCall(PetscRealloc(sizeof(char *) * (s->nsurfaces + boundary->nregions), &s->name));
  PetscCall(PetscRealloc(sizeof(PetscInt) * (s->nsurfaces + boundary->nregions), &s->body));
  for (PetscInt r = 0; r < boundary->nregions; ++r) {
    char face[PETSC_MAX_PATH_LEN], name[PETSC_MAX_PATH_LEN];

    PetscCall(PetscSNPrintf(face, sizeof(face), MESH_SURFACE "%" PetscInt_FMT, r + 1));
    for (PetscInt f = nfaces - 1; f >= 0; --f) {
      if (region[f] == r) PetscCall(PetscStrncpy(face, mesh->faces[f], sizeof(face)));
    }
    PetscCall(MeshFaceLabelName(body->name, face, sizeof(name), name));
    PetscCall(PetscStrallocpy(name, &s->name[s->nsurfaces++]));
  }
  PetscCall(PetscFree(region));
  PetscFunctionReturn(0);
}

/* Adds the surfaces of a body on the rank that has its grid */
static PetscErrorCode SurfacesAddBody(SceneBody *body, PetscInt number, const MeshBody *mesh, MeshSurfaces *s)
{
  const PetscInt nown = mesh->nfaces - body->nsubfaces - body->gmsh.nsurfaces, first = s->nsurfaces;
  PetscReal     *x;
  ShapeBoundary  boundary;

  PetscFunctionBegin;
  PetscCall(SurfacesPlaceVertices(body, &mesh->grid, &x));
  PetscCall(ShapeBoundaryCreate(&mesh->grid, x, &boundary));
  if (body->shape == SHAPE_GMSH) PetscCall(ShapeBoundarySplit(x, MESH_SHARP_ANGLE, &boundary));
  else PetscCall(ShapeBoundaryUseFaces(&mesh->grid, nown, &boundary));
  PetscCall(SurfacesName(body, mesh, nown, &boundary, s));
  for (PetscInt r = first; r < s->nsurfaces; ++r) s->body[r] = number;
  if (body->shape == SHAPE_GMSH) body->gmsh.nsurfaces = boundary.nregions;
  PetscCall(PetscRealloc(sizeof(PetscInt) * (s->n + boundary.n), &s->surface));
  PetscCall(PetscRealloc(sizeof(PetscReal) * 12 * (s->n + boundary.n), &s->x));
  for (PetscInt f = 0; f < boundary.n; ++f, ++s->n) {
    s->surface[s->n] = first + boundary.region[f];
    for (PetscInt a = 0; a < 4; ++a)
      PetscCall(PetscArraycpy(&s->x[12 * s->n + 3 * a], x + 3 * boundary.vertex[4 * f + a], 3));
  }
  PetscCall(ShapeBoundaryDestroy(&boundary));
  PetscCall(PetscFree(x));
  PetscFunctionReturn(0);
}

static PetscErrorCode SurfacesAddBodies(PetscInt nbodies, SceneBody bodies[], const MeshBody meshes[], MeshSurfaces *s)
{
  PetscFunctionBegin;
  for (PetscInt b = 0; b < nbodies; ++b) PetscCall(SurfacesAddBody(&bodies[b], b, &meshes[b], s));
  PetscFunctionReturn(0);
}

/* Collective. Sends the surfaces from the first rank to all ranks */
static PetscErrorCode SurfacesBroadcast(MPI_Comm comm, PetscInt nbodies, SceneBody bodies[], MeshSurfaces *s)
{
  PetscInt    sizes[2] = {s->n, s->nsurfaces};
  PetscMPIInt rank;

  PetscFunctionBegin;
  PetscCallMPI(MPI_Comm_rank(comm, &rank));
  PetscCallMPI(MPI_Bcast(sizes, 2, MPIU_INT, 0, comm));
  if (rank) {
    s->n         = sizes[0];
    s->nsurfaces = sizes[1];
    PetscCall(PetscMalloc1(s->n, &s->surface));
    PetscCall(PetscMalloc1(12 * s->n, &s->x));
    PetscCall(PetscMalloc1(s->nsurfaces, &s->body));
    PetscCall(PetscMalloc1(s->nsurfaces, &s->name));
  }
  PetscCheck(12 * s->n < PETSC_MPI_INT_MAX, comm, PETSC_ERR_SUP,
    "contact: auto has %" PetscInt_FMT " boundary facets at refinement level 0, which are too many: list the pairs",
    s->n);
  PetscCallMPI(MPI_Bcast(s->surface, (PetscMPIInt)s->n, MPIU_INT, 0, comm));
  PetscCallMPI(MPI_Bcast(s->x, (PetscMPIInt)(12 * s->n), MPIU_REAL, 0, comm));
  PetscCallMPI(MPI_Bcast(s->body, (PetscMPIInt)s->nsurfaces, MPIU_INT, 0, comm));
  for (PetscInt i = 0; i < s->nsurfaces; ++i) {
    char name[PETSC_MAX_PATH_LEN];

    if (!rank) PetscCall(PetscStrncpy(name, s->name[i], sizeof(name)));
    PetscCallMPI(MPI_Bcast(name, sizeof(name), MPI_CHAR, 0, comm));
    if (rank) PetscCall(PetscStrallocpy(name, &s->name[i]));
  }
  for (PetscInt b = 0; b < nbodies; ++b) PetscCallMPI(MPI_Bcast(&bodies[b].gmsh.nsurfaces, 1, MPIU_INT, 0, comm));
  PetscFunctionReturn(0);
}

/*
   Collective. Gets the surfaces of all bodies at refinement level 0, equal on all ranks. The caller frees them by
   MeshSurfacesDestroy(). The surfaces of a built-in shape are its faces. The surfaces of a body from a file are the
   parts of its boundary between edges at which the normals of the facets make more than 35 degrees; these bodies get
   additional faces "surface_1", "surface_2", ... If such a part consists of the facets of a face of the file, it has
   the name of that face.
*/
PetscErrorCode MeshSurfacesCreate(MPI_Comm comm, PetscInt nbodies, SceneBody bodies[], MeshSurfaces *surfaces)
{
  MeshBody   *meshes;
  PetscMPIInt rank;

  PetscFunctionBegin;
  PetscCall(PetscMemzero(surfaces, sizeof(*surfaces)));
  PetscCall(PetscCalloc1(nbodies, &meshes));
  PetscCall(MeshCreateBodies(comm, nbodies, bodies, meshes));
  PetscCallMPI(MPI_Comm_rank(comm, &rank));
  RankCall(comm, !rank, SurfacesAddBodies(nbodies, bodies, meshes, surfaces));
  PetscCall(SurfacesBroadcast(comm, nbodies, bodies, surfaces));
  PetscCall(MeshDestroyBodies(nbodies, meshes));
  PetscCall(PetscFree(meshes));
  PetscFunctionReturn(0);
}

/* Frees the surfaces of all bodies */
PetscErrorCode MeshSurfacesDestroy(MeshSurfaces *surfaces)
{
  PetscFunctionBegin;
  for (PetscInt i = 0; i < surfaces->nsurfaces; ++i) PetscCall(PetscFree(surfaces->name[i]));
  PetscCall(PetscFree(surfaces->name));
  PetscCall(PetscFree(surfaces->body));
  PetscCall(PetscFree(surfaces->surface));
  PetscCall(PetscFree(surfaces->x));
  PetscFunctionReturn(0);
}
