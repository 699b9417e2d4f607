/* Checks that every body is held, and that the faces of the scene have facets */
#include "supportsimpl.h"

/* Selects a free mode of a body for the message: a mode that is entirely free; otherwise a rotation, about an axis that
   is then not known; otherwise a translation. Returns PETSC_DECIDE if no mode is free. */
static PetscInt SupportFindFreest(const PetscReal outside[6])
{
  PetscReal freest = 0;
  PetscInt  mode   = PETSC_DECIDE;

  for (PetscInt k = 0; k < 6; ++k) {
    const PetscReal rank = outside[k] > 1 - 1e-6 ? 2 : outside[k] + (k < 3 ? 0 : 1);

    if (outside[k] <= 2e-6 || rank <= freest + 1e-6) continue;
    freest = rank;
    mode   = k;
  }
  return mode;
}

/* Collective. Reports the first body that has a free mode */
static PetscErrorCode SupportRaise(const Support *support, Scene scene, const PetscReal outside[])
{
  static const char *const modes[] = {"a translation along x", "a translation along y", "a translation along z",
    "a rotation about x", "a rotation about y", "a rotation about z"};
  MPI_Comm                 comm    = PetscObjectComm((PetscObject)support->dm);

  PetscFunctionBegin;
  for (PetscInt b = 0; b < scene->nbodies; ++b) {
    const PetscInt mode  = SupportFindFreest(outside + 6 * b);
    PetscInt       nfree = 0;

    for (PetscInt k = 0; k < 6; ++k) nfree += outside[6 * b + k] > 1 - 1e-6;
    SceneCheck(nfree < 6, comm, PETSC_ERR_USER_INPUT, &scene->bodies[b],
      "nothing holds body \"%s\": prescribe a displacement on one of its faces", scene->bodies[b].name);
    SceneCheck(mode < 0, comm, PETSC_ERR_USER_INPUT, &scene->bodies[b],
      "body \"%s\" is not held against %s: prescribe a displacement, or add springs, a tie or a contact pair",
      scene->bodies[b].name, modes[mode]);
  }
  PetscFunctionReturn(0);
}

/* Collective. Checks that a face has facets. A surface of a Gmsh file has none if it is not on the boundary of the
   body. */
static PetscErrorCode SupportCheckFacets(DM dm, const char what[], const void *owner, const char face[])
{
  const SceneEntry *entry = owner;
  IS                facets;
  PetscInt          n, total;

  PetscFunctionBegin;
  PetscCall(MeshGetFacets(dm, face, &facets));
  PetscCall(ISGetLocalSize(facets, &n));
  PetscCall(ISDestroy(&facets));
  PetscCallMPI(MPI_Allreduce(&n, &total, 1, MPIU_INT, MPI_SUM, PetscObjectComm((PetscObject)dm)));
  SceneCheck(total, PetscObjectComm((PetscObject)dm), PETSC_ERR_USER_INPUT, entry,
    "%s \"%s\": the face \"%s\" has no facets, because that surface of the mesh file is not on the boundary of the "
    "body",
    what, entry->name, face);
  PetscFunctionReturn(0);
}

/* Collective. Finds the bodies with free modes. The first of them is reported as an error, unless the scene has weak
   springs. unsupported: whether each body has a free mode; NULL if not needed */
static PetscErrorCode SupportFindUnsupported(DM dm, Scene scene, PetscBool unsupported[])
{
  const PetscInt nlinks =
    scene->ndisplacements + scene->nsprings + scene->nconnectors + scene->npairs + scene->nties + scene->ncyclic;
  Support    support = {.dm = dm, .nbodies = scene->nbodies, .n = 6 * scene->nbodies};
  PetscReal *outside;

  PetscFunctionBegin;
  PetscCall(PetscCalloc5(scene->nbodies, &support.center, scene->nbodies, &support.size, nlinks, &support.links, nlinks,
    &support.gram, support.n, &outside));
  PetscCall(SupportMeasureBodies(&support));
  PetscCall(SupportAddScene(&support, scene));
  PetscCall(SupportGetFree(&support, outside));
  for (PetscInt k = 0; unsupported && k < support.n; ++k)
    unsupported[k / 6] = (PetscBool)(unsupported[k / 6] || outside[k] > 2e-6);
  if (!scene->weak_springs) PetscCall(SupportRaise(&support, scene, outside));
  PetscCall(PetscFree5(support.center, support.size, support.links, support.gram, outside));
  PetscFunctionReturn(0);
}

/*
   Collective. Finds the bodies that have free rigid body motions. dm: the mesh, created by `MeshCreate()`;
   *unsupported: one value per body: whether any of its rigid body motions is free.
*/
PetscErrorCode MeshGetUnsupported(DM dm, Scene scene, PetscBool unsupported[])
{
  PetscFunctionBegin;
  PetscCall(PetscArrayzero(unsupported, scene->nbodies));
  PetscCall(SupportFindUnsupported(dm, scene, unsupported));
  PetscFunctionReturn(0);
}

/*@
  MeshCheckScene - Checks that the faces that a scene names have facets, and that every body is supported

  Collective

  Input Parameters:
+ dm    - the mesh, created by `MeshCreate()`
- scene - the scene

  Level: intermediate

  Notes:
  A body is supported if none of its rigid body motions is free. Contact pairs are assumed closed.

.seealso: `MeshCreate()`, `SceneLoad()`
@*/
PetscErrorCode MeshCheckScene(DM dm, Scene scene)
{
  PetscFunctionBegin;
  PetscCall(MeshLabelPoints(dm, scene));
  for (PetscInt d = 0; d < scene->ndisplacements; ++d) {
    if (scene->displacements[d].at == DISPLACEMENT_FACE)
      PetscCall(SupportCheckFacets(dm, "Displacement", &scene->displacements[d], scene->displacements[d].face));
  }
  for (PetscInt p = 0; p < scene->npressures; ++p)
    PetscCall(SupportCheckFacets(dm, "Pressure", &scene->pressures[p], scene->pressures[p].face));
  for (PetscInt t = 0; t < scene->ntractions; ++t)
    PetscCall(SupportCheckFacets(dm, "Load", &scene->tractions[t], scene->tractions[t].face));
  for (PetscInt s = 0; s < scene->nsprings; ++s) {
    PetscCall(SupportCheckFacets(dm, "Spring", &scene->springs[s], scene->springs[s].face));
    if (scene->springs[s].to) PetscCall(SupportCheckFacets(dm, "Spring", &scene->springs[s], scene->springs[s].to));
  }
  for (PetscInt p = 0; p < scene->npairs; ++p) {
    PetscCall(SupportCheckFacets(dm, "Contact pair", &scene->pairs[p], scene->pairs[p].mortar));
    PetscCall(SupportCheckFacets(dm, "Contact pair", &scene->pairs[p], scene->pairs[p].nonmortar));
  }
  for (PetscInt t = 0; t < scene->nties; ++t) {
    PetscCall(SupportCheckFacets(dm, "Tie", &scene->ties[t], scene->ties[t].mortar));
    PetscCall(SupportCheckFacets(dm, "Tie", &scene->ties[t], scene->ties[t].nonmortar));
  }
  for (PetscInt k = 0; k < scene->ncyclic; ++k) {
    PetscCall(SupportCheckFacets(dm, "Cyclic symmetry", &scene->cyclic[k], scene->cyclic[k].from));
    PetscCall(SupportCheckFacets(dm, "Cyclic symmetry", &scene->cyclic[k], scene->cyclic[k].to));
  }
  if (!SceneIsDynamic(scene)) PetscCall(SupportFindUnsupported(dm, scene, NULL));
  PetscFunctionReturn(0);
}
