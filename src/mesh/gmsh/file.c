/* Bodies from Gmsh files: the file is read on rank 0, and the volume of each body is extracted there */
#include "gmshimpl.h"
#include <petscbt.h>

/* Gmsh's number of each corner i + 2 j + 4 k of a hexahedron, indexed by the number of corners. Tetrahedra have the
   same order in Gmsh. */
static const PetscInt corner_at[9][8] = {[4] = {0, 1, 2, 3}, [8] = {0, 1, 3, 2, 4, 5, 7, 6}};

/* Reads the file, on rank 0 only */
static PetscErrorCode GmshReadFile(const char file[], GmshMesh *mesh)
{
  char message[256];

  PetscFunctionBegin;
  PetscCall(GmshMeshRead(file, mesh, sizeof(message), message));
  PetscCheck(!message[0], PETSC_COMM_SELF, PETSC_ERR_USER_INPUT, "%s", message);
  PetscFunctionReturn(0);
}

PetscErrorCode GmshFileOpen(MPI_Comm comm, const SceneBody *body, GmshFile *file)
{
  RankError      error;
  PetscErrorCode ierr = 0;
  PetscMPIInt    rank;
  PetscBool      same = PETSC_FALSE;
  PetscInt       dim;

  PetscFunctionBegin;
  if (file->name) PetscCall(PetscStrcmp(file->name, GmshPath(body), &same));
  if (same) PetscFunctionReturn(0);
  PetscCall(GmshFileClose(file));
  PetscCallMPI(MPI_Comm_rank(comm, &rank));
  PetscCall(RankErrorBegin(&error));
  if (rank == 0) ierr = GmshReadFile(GmshPath(body), &file->mesh);
  PetscCall(RankErrorEnd(comm, ierr, &error));
  SceneCheck(!error.code, comm, PETSC_ERR_USER_INPUT, body, "Body \"%s\": %s is not a complete Gmsh mesh: %s",
    body->name, body->gmsh.file, error.message);
  dim = file->mesh.dim;
  PetscCallMPI(MPI_Bcast(&dim, 1, MPIU_INT, 0, comm));
  SceneCheck(dim == 3, comm, PETSC_ERR_USER_INPUT, body,
    "Body \"%s\": %s is a mesh of dimension %" PetscInt_FMT ", without volumes", body->name, body->gmsh.file, dim);
  file->name = GmshPath(body);
  PetscFunctionReturn(0);
}

PetscErrorCode GmshFileClose(GmshFile *file)
{
  PetscFunctionBegin;
  PetscCall(GmshMeshDestroy(&file->mesh));
  file->name = NULL;
  PetscFunctionReturn(0);
}

/* Returns whether the element is a cell of the volume with this tag */
static PetscBool GmshIsWithin(const GmshMesh *mesh, const GmshElement *element, PetscInt volume)
{
  return element->type->dim == 3 && GmshMeshHasTag(mesh, element, volume) ? PETSC_TRUE : PETSC_FALSE;
}

/* Checks that the cells of a volume are hexahedra or tetrahedra, and that all are of one kind. before: type of the
   cells before, or NULL */
static PetscErrorCode GmshCheckType(const SceneBody *body, const GmshType *type, const GmshType *before)
{
  PetscFunctionBegin;
  PetscCheck(type->ncorners == 8 || type->ncorners == 4, PETSC_COMM_SELF, PETSC_ERR_USER_INPUT,
    "the volume \"%s\" of %s has cells of type %s; only hexahedra with 8, 20 or 27 nodes and tetrahedra with 4 or 10 "
    "are read",
    body->gmsh.volume, body->gmsh.file, type->name);
  PetscCheck(!before || type->ncorners == before->ncorners, PETSC_COMM_SELF, PETSC_ERR_USER_INPUT,
    "the volume \"%s\" of %s has cells of the types %s and %s, but all cells of a volume must have one type: define "
    "two physical volumes, and tie them",
    body->gmsh.volume, body->gmsh.file, before->name, type->name);
  PetscFunctionReturn(0);
}

/* Extracts the cells of the body's volume and numbers their vertices. number[i]: new number of the node with position
   i; PETSC_DECIDE if it is no vertex of the volume */
static PetscErrorCode GmshCutVolume(const GmshMesh *mesh, const SceneBody *body, PetscInt volume, PetscInt number[],
  ShapeGrid *grid)
{
  const GmshType *type = NULL;

  PetscFunctionBegin;
  PetscCall(PetscMalloc1(8 * mesh->nelements, &grid->cells));
  for (PetscInt v = 0; v < mesh->nnodes; ++v) number[v] = PETSC_DECIDE;
  for (PetscInt e = 0; e < mesh->nelements; ++e) {
    const GmshElement *element = &mesh->elements[e];

    if (!GmshIsWithin(mesh, element, volume)) continue;
    PetscCall(GmshCheckType(body, element->type, type));
    type           = element->type;
    grid->ncorners = (PetscInt)type->ncorners;
    for (PetscInt a = 0; a < grid->ncorners; ++a) {
      PetscInt place;

      PetscCall(GmshMeshFindNode(mesh, mesh->nodes[element->first + corner_at[grid->ncorners][a]], &place));
      if (number[place] < 0) number[place] = grid->nvertices++;
      grid->cells[grid->ncorners * grid->ncells + a] = number[place];
    }
    ++grid->ncells;
  }
  PetscFunctionReturn(0);
}

/* Extracts the coordinates of the vertices */
static PetscErrorCode GmshCutCoordinates(const GmshMesh *mesh, const PetscInt number[], ShapeGrid *grid)
{
  PetscFunctionBegin;
  PetscCall(PetscMalloc1(3 * grid->nvertices, &grid->coordinates));
  for (PetscInt v = 0; v < mesh->nnodes; ++v) {
    if (number[v] >= 0) PetscCall(PetscArraycpy(grid->coordinates + 3 * number[v], mesh->x + 3 * v, 3));
  }
  PetscFunctionReturn(0);
}

/* Extracts the curves of second-order cells, unless all edges are straight. *quadratic: whether the cells are of second
   order */
static PetscErrorCode GmshCutCurve(const GmshMesh *mesh, PetscInt volume, PetscBool *quadratic, ShapeGrid *grid)
{
  const PetscInt ncoordinates = grid->ncorners == 4 ? 30 : 81;
  PetscReal      bulge = 0, size = 0;
  PetscInt       c = 0;

  PetscFunctionBegin;
  *quadratic = PETSC_FALSE;
  for (PetscInt v = 3; v < 3 * grid->nvertices; ++v)
    size = PetscMax(size, PetscAbsReal(grid->coordinates[v] - grid->coordinates[v % 3]));
  for (PetscInt e = 0; e < mesh->nelements; ++e) {
    if (GmshIsWithin(mesh, &mesh->elements[e], volume) &&
        mesh->elements[e].type->nnodes > mesh->elements[e].type->ncorners)
      *quadratic = PETSC_TRUE;
  }
  if (!*quadratic) PetscFunctionReturn(0);
  PetscCall(PetscMalloc1(ncoordinates * grid->ncells, &grid->curve));
  for (PetscInt e = 0; e < mesh->nelements; ++e) {
    const GmshElement *element = &mesh->elements[e];
    PetscReal          x[GMSH_MAX_NODES][3], off;

    if (!GmshIsWithin(mesh, element, volume)) continue;
    for (PetscInt a = 0; a < element->type->nnodes; ++a) {
      PetscInt place;

      PetscCall(GmshMeshFindNode(mesh, mesh->nodes[element->first + a], &place));
      PetscCall(PetscArraycpy(x[a], mesh->x + 3 * place, 3));
    }
    off   = GmshGetCurve((PetscInt)element->type->nnodes, (const PetscReal(*)[3])x, grid->curve + ncoordinates * c);
    bulge = PetscMax(bulge, off);
    ++c;
  }
  if (bulge <= PETSC_SQRT_MACHINE_EPSILON * size) PetscCall(PetscFree(grid->curve));
  PetscFunctionReturn(0);
}

/* Gets the corners of an element of a surface. A triangle repeats its last corner. */
static void GmshGetCorners(const GmshMesh *mesh, const GmshElement *element, PetscInt64 corners[4])
{
  for (PetscInt a = 0; a < 4; ++a) corners[a] = mesh->nodes[element->first + PetscMin(a, element->type->ncorners - 1)];
}

/* Marks the elements of surfaces that are a side of exactly one cell of the volume */
static PetscErrorCode GmshFindBoundary(const GmshMesh *mesh, PetscInt volume, PetscInt ncorners, PetscBT boundary)
{
  GmshFacets facets;

  PetscFunctionBegin;
  GmshFacetsBegin(&facets, mesh->nelements);
  do {
    PetscInt64 corners[8];

    for (PetscInt e = 0; e < mesh->nelements; ++e) {
      const GmshElement *element = &mesh->elements[e];

      if (!GmshIsWithin(mesh, element, volume)) continue;
      for (PetscInt a = 0; a < element->type->ncorners; ++a) corners[a] = mesh->nodes[element->first + a];
      PetscCall(GmshFacetsAdd(element->type, element->number, corners, &facets));
    }
    GmshFacetsSort(&facets);
    for (PetscInt e = 0; e < mesh->nelements; ++e) {
      const GmshElement *element = &mesh->elements[e];

      if (element->type->dim != 2 || element->type->ncorners != ncorners) continue;
      GmshGetCorners(mesh, element, corners);
      if (GmshFacetsBound(&facets, ncorners, corners)) PetscCall(PetscBTSet(boundary, e));
    }
  } while (GmshFacetsNext(&facets));
  PetscCall(GmshFacetsDestroy(&facets));
  PetscFunctionReturn(0);
}

/* Extracts the facets of the surfaces with these tags. A facet that belongs to several surfaces is listed for each. */
static PetscErrorCode GmshCutSurfaces(const GmshMesh *mesh, PetscInt volume, PetscInt nsurfaces,
  const PetscInt surfaces[], const PetscInt number[], ShapeGrid *grid)
{
  const PetscInt ncorners = grid->ncorners == 4 ? 3 : 4;
  PetscSegBuffer vertices, facetface;
  PetscBT        boundary;

  PetscFunctionBegin;
  PetscCall(PetscBTCreate(mesh->nelements, &boundary));
  PetscCall(GmshFindBoundary(mesh, volume, ncorners, boundary));
  PetscCall(PetscSegBufferCreate(sizeof(PetscInt), 1024, &vertices));
  PetscCall(PetscSegBufferCreate(sizeof(PetscInt), 256, &facetface));
  for (PetscInt face = 0; face < nsurfaces; ++face) {
    for (PetscInt e = 0; e < mesh->nelements; ++e) {
      const GmshElement *element = &mesh->elements[e];
      PetscInt64         corners[4];
      PetscInt          *slot;

      if (!PetscBTLookup(boundary, e) || !GmshMeshHasTag(mesh, element, surfaces[face])) continue;
      GmshGetCorners(mesh, element, corners);
      PetscCall(PetscSegBufferGetInts(vertices, 4, &slot));
      for (PetscInt a = 0; a < 4; ++a) {
        PetscInt place;

        PetscCall(GmshMeshFindNode(mesh, (PetscInt)corners[a], &place));
        slot[a] = number[place];
      }
      PetscCall(PetscSegBufferGetInts(facetface, 1, &slot));
      *slot = face;
      ++grid->nfacets;
    }
  }
  PetscCall(PetscBTDestroy(&boundary));
  PetscCall(PetscSegBufferExtractAlloc(vertices, &grid->facets));
  PetscCall(PetscSegBufferExtractAlloc(facetface, &grid->facetface));
  PetscCall(PetscSegBufferDestroy(&vertices));
  PetscCall(PetscSegBufferDestroy(&facetface));
  PetscFunctionReturn(0);
}

/* Checks that no two vertices have the same position. Sorts the vertices along a direction in which hardly any vertices
   of a regular mesh have equal coordinates. */
static PetscErrorCode GmshCheckVertices(const SceneBody *body, const ShapeGrid *grid)
{
  static const PetscReal direction[3] = {0.5773, 0.6180, 0.5342};
  const PetscReal       *x            = grid->coordinates;
  PetscReal              lower[3]     = {PETSC_MAX_REAL, PETSC_MAX_REAL, PETSC_MAX_REAL},
            upper[3] = {PETSC_MIN_REAL, PETSC_MIN_REAL, PETSC_MIN_REAL}, near = 0, *along;
  PetscInt *order;

  PetscFunctionBegin;
  PetscCall(PetscMalloc2(grid->nvertices, &along, grid->nvertices, &order));
  for (PetscInt v = 0; v < grid->nvertices; ++v) {
    along[v] = 0;
    order[v] = v;
    for (PetscInt d = 0; d < 3; ++d) {
      lower[d] = PetscMin(lower[d], x[3 * v + d]);
      upper[d] = PetscMax(upper[d], x[3 * v + d]);
      along[v] += direction[d] * x[3 * v + d];
    }
  }
  for (PetscInt d = 0; d < 3; ++d) near = PetscMax(near, 1e-9 * (upper[d] - lower[d]));
  PetscCall(PetscSortRealWithArrayInt(grid->nvertices, along, order));
  for (PetscInt i = 0; i < grid->nvertices; ++i) {
    for (PetscInt j = i + 1; j < grid->nvertices && along[j] - along[i] <= 2 * near; ++j) {
      const PetscReal *a = x + 3 * order[i], *b = x + 3 * order[j];

      PetscCheck(PetscAbsReal(a[0] - b[0]) > near || PetscAbsReal(a[1] - b[1]) > near ||
                   PetscAbsReal(a[2] - b[2]) > near,
        PETSC_COMM_SELF, PETSC_ERR_USER_INPUT,
        "the volume \"%s\" of %s has two nodes with the position (%g, %g, %g), so that its cells are not connected "
        "there: merge the nodes in the mesh file if the cells are joined; if they are separate bodies that touch, make "
        "a body of each connected part, which contact-mesh -check lists as NAME.part_1, NAME.part_2, ...",
        body->gmsh.volume, body->gmsh.file, (double)a[0], (double)a[1], (double)a[2]);
    }
  }
  PetscCall(PetscFree2(along, order));
  PetscFunctionReturn(0);
}

/* Extracts the grid of a body, on rank 0. volume: tag of its volume */
static PetscErrorCode GmshCutBody(const GmshMesh *mesh, const SceneBody *body, PetscInt volume, PetscInt nsurfaces,
  const PetscInt surfaces[], ShapeGrid *grid)
{
  PetscInt *number;
  PetscBool quadratic;

  PetscFunctionBegin;
  PetscCall(PetscMalloc1(mesh->nnodes, &number));
  PetscCall(GmshCutVolume(mesh, body, volume, number, grid));
  PetscCheck(grid->ncells, PETSC_COMM_SELF, PETSC_ERR_USER_INPUT, "the volume \"%s\" of %s has no cells",
    body->gmsh.volume, body->gmsh.file);
  PetscCall(GmshCutCoordinates(mesh, number, grid));
  if (body->curved) {
    PetscCall(GmshCutCurve(mesh, volume, &quadratic, grid));
    if (!quadratic && grid->ncorners == 8) PetscCall(ShapeGridProject(grid));
  }
  PetscCall(GmshCutSurfaces(mesh, volume, nsurfaces, surfaces, number, grid));
  PetscCall(GmshCheckVertices(body, grid));
  PetscCall(PetscFree(number));
  PetscFunctionReturn(0);
}

/* Adds the parts of the boundary between sharp edges as faces, after the n faces that the file names; on rank 0 */
static PetscErrorCode GmshAddSurfaces(PetscInt n, ShapeGrid *grid)
{
  ShapeBoundary boundary;

  PetscFunctionBegin;
  PetscCall(ShapeBoundaryCreate(grid, grid->coordinates, &boundary));
  PetscCall(ShapeBoundarySplit(grid->coordinates, MESH_SHARP_ANGLE, &boundary));
  PetscCall(PetscRealloc(sizeof(PetscInt) * 4 * (grid->nfacets + boundary.n), &grid->facets));
  PetscCall(PetscRealloc(sizeof(PetscInt) * (grid->nfacets + boundary.n), &grid->facetface));
  PetscCall(PetscArraycpy(grid->facets + 4 * grid->nfacets, boundary.vertex, 4 * boundary.n));
  for (PetscInt f = 0; f < boundary.n; ++f) grid->facetface[grid->nfacets++] = n + boundary.region[f];
  PetscCall(ShapeBoundaryDestroy(&boundary));
  PetscFunctionReturn(0);
}

PetscErrorCode GmshFileGetGrid(MPI_Comm comm, GmshFile *file, const SceneBody *body, ShapeGrid *grid)
{
  RankError      error;
  PetscErrorCode ierr = 0;
  PetscInt       n, volume, *tags;
  char         **surfaces;

  PetscFunctionBegin;
  PetscCall(GmshGetVolumeTag(comm, body, &volume));
  PetscCall(GmshGetPhysicalNames(comm, body, 2, &n, &surfaces, &tags));
  PetscCall(RankErrorBegin(&error));
  if (file->mesh.nelements) ierr = GmshCutBody(&file->mesh, body, volume, n, tags, grid);
  if (!ierr && file->mesh.nelements && body->gmsh.nsurfaces) ierr = GmshAddSurfaces(n, grid);
  PetscCall(RankErrorEnd(comm, ierr, &error));
  SceneCheck(!error.code, comm, error.code, body, "Body \"%s\": %s", body->name, error.message);
  PetscCall(NamesDestroy(&n, &surfaces));
  PetscCall(PetscFree(tags));
  PetscFunctionReturn(0);
}
