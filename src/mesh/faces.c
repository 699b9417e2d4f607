/* Names of a body's faces, and faces that are parts of other faces */
#include "mesh_private.h"
#include <string.h>

PetscErrorCode MeshFaceLabelName(const char body[], const char face[], size_t length, char name[])
{
  PetscFunctionBegin;
  PetscCall(PetscSNPrintf(name, length, "%s.%s", body, face));
  PetscFunctionReturn(0);
}

/*@C
  MeshGetFaceNames - Gets the names of a body's faces

  Collective

  Input Parameters:
+ comm - communicator
- body - the body, the same on all ranks

  Output Parameters:
+ n     - number of faces
- names - their names, without the body's; to be freed with `MeshRestoreFaceNames()`

  Level: intermediate

  Notes:
  These are the faces of the body's shape, or for a body from a Gmsh file its physical surfaces, then the parts of
  faces that the scene names. Only the head of a Gmsh file is read; a surface of it may have no facet on the body.

.seealso: `MeshCreate()`, `MeshGetFacets()`
@*/
PetscErrorCode MeshGetFaceNames(MPI_Comm comm, const SceneBody *body, PetscInt *n, char ***names)
{
  const Shape       *shape;
  const char *const *own;
  char             **surfaces = NULL;
  PetscInt           nown     = 0;

  PetscFunctionBegin;
  PetscCall(ShapeGet(comm, body, &shape));
  if (shape) {
    own = shape->faces(body);
    while (own[nown]) ++nown;
  } else {
    PetscCall(GmshGetPhysicalNames(comm, body, 2, &nown, &surfaces, NULL));
    own = (const char *const *)surfaces;
  }
  *n = nown + body->nsubfaces;
  PetscCall(PetscMalloc1(*n, names));
  for (PetscInt f = 0; f < nown; ++f) PetscCall(PetscStrallocpy(own[f], &(*names)[f]));
  for (PetscInt f = 0; f < body->nsubfaces; ++f) PetscCall(PetscStrallocpy(body->subfaces[f].name, &(*names)[nown + f]));
  if (surfaces) PetscCall(MeshRestoreFaceNames(&nown, &surfaces));
  PetscFunctionReturn(0);
}

/*@C
  MeshRestoreFaceNames - Frees the names that `MeshGetFaceNames()` gave

  Not Collective

  Input Parameters:
+ n     - number of names, set to 0
- names - the names, set to NULL

  Level: intermediate

.seealso: `MeshGetFaceNames()`
@*/
PetscErrorCode MeshRestoreFaceNames(PetscInt *n, char ***names)
{
  PetscFunctionBegin;
  for (PetscInt f = 0; f < *n; ++f) PetscCall(PetscFree((*names)[f]));
  PetscCall(PetscFree(*names));
  *n = 0;
  PetscFunctionReturn(0);
}

PetscErrorCode MeshListNames(PetscInt n, char *const names[], size_t size, char text[])
{
  PetscFunctionBegin;
  PetscCall(PetscStrncpy(text, n ? "" : "none", size));
  for (PetscInt i = 0; i < n; ++i) {
    const size_t used = strlen(text);

    PetscCall(PetscSNPrintf(text + used, size - used, "%s%s", i ? ", " : "", names[i]));
  }
  PetscFunctionReturn(0);
}

/* A part is of a face that comes before it, and its name is not taken */
static PetscErrorCode CheckSubfaces(MPI_Comm comm, const SceneBody *body)
{
  PetscInt n;
  char   **names;

  PetscFunctionBegin;
  PetscCall(MeshGetFaceNames(comm, body, &n, &names));
  for (PetscInt s = 0; s < body->nsubfaces; ++s) {
    const SceneSubface *part  = &body->subfaces[s];
    PetscBool           known = PETSC_FALSE, same;
    char                choices[512] = "";

    for (PetscInt f = 0; f < n - body->nsubfaces + s; ++f) {
      PetscCall(PetscStrcmp(names[f], part->of, &same));
      if (same) known = PETSC_TRUE;
      PetscCall(PetscStrcmp(names[f], part->name, &same));
      PetscCheck(!same, comm, PETSC_ERR_USER_INPUT, "Body \"%s\" has two faces of the name \"%s\"", body->name, part->name);
    }
    PetscCall(MeshListNames(n - body->nsubfaces + s, names, sizeof(choices), choices));
    PetscCheck(known, comm, PETSC_ERR_USER_INPUT, "The face \"%s.%s\" is to be part of \"%s.%s\", which does not exist; before it, %s has: %s", body->name, part->name, body->name, part->of, body->name, choices);
  }
  PetscCall(MeshRestoreFaceNames(&n, &names));
  PetscFunctionReturn(0);
}

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

  PetscFunctionBegin;
  PetscCall(ShapeGet(comm, body, &shape));
  if (shape) PetscCall(shape->size(comm, body, &ncells, &nvertices));
  else PetscCall(GmshCheckVolume(comm, body));
  PetscCall(CheckSubfaces(comm, body));
  PetscFunctionReturn(0);
}

/* Is the centroid of a facet's corners within the bounds, or on them but for rounding? Where the body is curved, its vertices
   are still parameters */
static PetscErrorCode FacetIsInside(const SceneBody *body, const SceneSubface *part, const ShapeGrid *grid, PetscInt facet, PetscBool *inside)
{
  const Shape *shape;
  PetscReal    x[4][3], centroid[3] = {0, 0, 0}, size = 0;

  PetscFunctionBegin;
  PetscCall(ShapeGet(PETSC_COMM_SELF, body, &shape));
  for (PetscInt a = 0; a < 4; ++a) {
    const PetscReal *p = grid->coordinates + 3 * grid->facets[4 * facet + a];

    PetscCall(PetscArraycpy(x[a], p, 3));
    if (shape && shape->map) PetscCall(shape->map(body, p, x[a]));
    for (PetscInt d = 0; d < 3; ++d) centroid[d] += x[a][d] / 4;
  }
  for (PetscInt d = 0; d < 3; ++d) size = PetscMax(size, PetscAbsReal(x[0][d] - centroid[d]));
  *inside = PETSC_TRUE;
  for (PetscInt d = 0; d < 3; ++d) {
    if (centroid[d] < part->lower[d] - 1e-9 * size || centroid[d] > part->upper[d] + 1e-9 * size) *inside = PETSC_FALSE;
  }
  PetscFunctionReturn(0);
}

PetscErrorCode MeshLabelSubfaces(DM dm, const SceneBody *body, const ShapeGrid *grid, PetscInt first, PetscInt *empty)
{
  PetscFunctionBegin;
  *empty = PETSC_DECIDE;
  for (PetscInt s = 0; s < body->nsubfaces; ++s) {
    const SceneSubface *part = &body->subfaces[s];
    char                whole[PETSC_MAX_PATH_LEN], name[PETSC_MAX_PATH_LEN];
    PetscInt            nselected = 0;

    PetscCall(MeshFaceLabelName(body->name, part->of, sizeof(whole), whole));
    PetscCall(MeshFaceLabelName(body->name, part->name, sizeof(name), name));
    for (PetscInt q = 0; q < grid->nfacets; ++q) {
      PetscInt        corners[4], njoin, value;
      const PetscInt *join;
      PetscBool       inside = PETSC_FALSE;

      for (PetscInt a = 0; a < 4; ++a) corners[a] = first + grid->facets[4 * q + a];
      PetscCall(DMPlexGetFullJoin(dm, 4, corners, &njoin, &join));
      PetscCall(DMGetLabelValue(dm, whole, join[0], &value));
      PetscCall(FacetIsInside(body, part, grid, q, &inside));
      if (value == 1 && inside) {
        PetscCall(DMSetLabelValue(dm, name, join[0], 1));
        ++nselected;
      }
      PetscCall(DMPlexRestoreJoin(dm, 4, corners, &njoin, &join));
    }
    if (!nselected && *empty < 0) *empty = s;
  }
  PetscFunctionReturn(0);
}
