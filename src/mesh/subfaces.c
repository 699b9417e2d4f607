/* Parts of faces that a body defines by bounds of the coordinates */
#include "meshimpl.h"

/* Collective. Checks that each part belongs to a face that is defined before it, and that its name is new */
PetscErrorCode MeshCheckSubfaces(MPI_Comm comm, const SceneBody *body)
{
  PetscInt n;
  char   **names;

  PetscFunctionBegin;
  PetscCall(MeshGetFaceNames(comm, body, &n, &names));
  for (PetscInt s = 0; s < body->nsubfaces; ++s) {
    const SceneSubface *subface      = &body->subfaces[s];
    PetscBool           known        = PETSC_FALSE, same;
    char                choices[512] = "";

    for (PetscInt f = 0; f < n - body->nsubfaces + s; ++f) {
      PetscCall(PetscStrcmp(names[f], subface->of, &same));
      if (same) known = PETSC_TRUE;
      PetscCall(PetscStrcmp(names[f], subface->name, &same));
      SceneCheck(!same, comm, PETSC_ERR_USER_INPUT, subface, "Body \"%s\" has two faces with the name \"%s\"",
        body->name, subface->name);
    }
    PetscCall(NamesJoin(n - body->nsubfaces + s, names, sizeof(choices), choices));
    SceneCheck(known, comm, PETSC_ERR_USER_INPUT, subface,
      "The face \"%s.%s\" is defined as a part of \"%s.%s\", which does not exist: the faces of %s before it are %s",
      body->name, subface->name, body->name, subface->of, body->name, choices);
  }
  PetscCall(MeshRestoreFaceNames(&n, &names));
  PetscFunctionReturn(0);
}

/* Determines whether the centroid of a facet's corners is within the bounds, up to rounding. The vertices of bodies
   with a map are still parameters here and are mapped first. */
static PetscErrorCode SubfaceHoldsFacet(const SceneBody *body, const SceneSubface *subface, const ShapeGrid *grid,
  PetscInt facet, PetscBool *inside)
{
  const Shape   *shape;
  const PetscInt n = grid->ncorners == 4 ? 3 : 4;
  PetscReal      x[4][3], centroid[3] = {0, 0, 0}, size = 0;

  PetscFunctionBegin;
  PetscCall(ShapeGet(PETSC_COMM_SELF, body, &shape));
  for (PetscInt a = 0; a < n; ++a) {
    const PetscReal *p = grid->coordinates + 3 * grid->facets[4 * facet + a];

    PetscCall(PetscArraycpy(x[a], p, 3));
    if (shape && shape->map) PetscCall(shape->map(body, p, x[a]));
    for (PetscInt d = 0; d < 3; ++d) centroid[d] += x[a][d] / (PetscReal)n;
  }
  for (PetscInt d = 0; d < 3; ++d) size = PetscMax(size, PetscAbsReal(x[0][d] - centroid[d]));
  *inside = PETSC_TRUE;
  for (PetscInt d = 0; d < 3; ++d) {
    if (centroid[d] < subface->lower[d] - 1e-9 * size || centroid[d] > subface->upper[d] + 1e-9 * size)
      *inside = PETSC_FALSE;
  }
  PetscFunctionReturn(0);
}

PetscErrorCode MeshLabelSubfaces(DM dm, const SceneBody *body, const ShapeGrid *grid, PetscInt first)
{
  PetscFunctionBegin;
  for (PetscInt s = 0; s < body->nsubfaces; ++s) {
    const SceneSubface *subface = &body->subfaces[s];
    char                whole[PETSC_MAX_PATH_LEN], name[PETSC_MAX_PATH_LEN];

    PetscCall(MeshFaceLabelName(body->name, subface->of, sizeof(whole), whole));
    PetscCall(MeshFaceLabelName(body->name, subface->name, sizeof(name), name));
    for (PetscInt q = 0; q < grid->nfacets; ++q) {
      PetscInt       corners[4], njoin, value;
      const PetscInt n      = grid->ncorners == 4 ? 3 : 4, *join;
      PetscBool      inside = PETSC_FALSE;

      for (PetscInt a = 0; a < n; ++a) corners[a] = first + grid->facets[4 * q + a];
      PetscCall(DMPlexGetFullJoin(dm, n, corners, &njoin, &join));
      PetscCall(DMGetLabelValue(dm, whole, join[0], &value));
      PetscCall(SubfaceHoldsFacet(body, subface, grid, q, &inside));
      if (value == 1 && inside) PetscCall(DMSetLabelValue(dm, name, join[0], 1));
      PetscCall(DMPlexRestoreJoin(dm, n, corners, &njoin, &join));
    }
  }
  PetscFunctionReturn(0);
}

PetscErrorCode MeshCheckSubfacesFilled(DM dm, const SceneBody *body)
{
  PetscFunctionBegin;
  for (PetscInt s = 0; s < body->nsubfaces; ++s) {
    char     whole[PETSC_MAX_PATH_LEN], name[PETSC_MAX_PATH_LEN];
    PetscInt n;

    PetscCall(MeshFaceLabelName(body->name, body->subfaces[s].of, sizeof(whole), whole));
    PetscCall(MeshFaceLabelName(body->name, body->subfaces[s].name, sizeof(name), name));
    PetscCall(DMGetStratumSize(dm, name, 1, &n));
    PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &n, 1, MPIU_INT, MPI_SUM, PetscObjectComm((PetscObject)dm)));
    SceneCheck(n, PetscObjectComm((PetscObject)dm), PETSC_ERR_USER_INPUT, &body->subfaces[s],
      "The face \"%s\" is empty: no facet of \"%s\" has its centroid within the bounds at refinement level 0", name,
      whole);
  }
  PetscFunctionReturn(0);
}
