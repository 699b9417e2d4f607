/* Names of a body's faces */
#include "meshimpl.h"

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
- names - their names without the name of the body; free them with `MeshRestoreFaceNames()`

  Level: intermediate

  Notes:
  These are the faces of the body's shape, or the physical surfaces of its Gmsh file, followed by the parts of
  faces that the scene defines. Only the first sections of a Gmsh file are read, so that a surface may turn out to have
  no facet on the body.

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
    own = shape->faces ? shape->faces(body) : shape->names;
    while (own[nown]) ++nown;
  } else {
    PetscCall(GmshGetPhysicalNames(comm, body, 2, &nown, &surfaces, NULL));
    own = (const char *const *)surfaces;
  }
  *n = nown + body->gmsh.nsurfaces + body->nsubfaces;
  PetscCall(PetscMalloc1(*n, names));
  for (PetscInt f = 0; f < nown; ++f) PetscCall(PetscStrallocpy(own[f], &(*names)[f]));
  for (PetscInt f = 0; f < body->gmsh.nsurfaces; ++f, ++nown) {
    char name[32];

    PetscCall(PetscSNPrintf(name, sizeof(name), MESH_SURFACE "%" PetscInt_FMT, f + 1));
    PetscCall(PetscStrallocpy(name, &(*names)[nown]));
  }
  for (PetscInt f = 0; f < body->nsubfaces; ++f)
    PetscCall(PetscStrallocpy(body->subfaces[f].name, &(*names)[nown + f]));
  nown -= body->gmsh.nsurfaces;
  if (surfaces) PetscCall(NamesDestroy(&nown, &surfaces));
  PetscFunctionReturn(0);
}

/*@C
  MeshRestoreFaceNames - Frees the names that `MeshGetFaceNames()` returned

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
  PetscCall(NamesDestroy(n, names));
  PetscFunctionReturn(0);
}
