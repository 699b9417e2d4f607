/* Checks that every body is held, and that the faces of the scene have facets */
#include "supportsimpl.h"
#include <string.h>

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

/* Appends to `text` how a body is not held, for example: body "b" is not held against a translation along x. Returns
   whether it is not held. */
static PetscBool SupportDescribe(const char name[], const PetscReal outside[6], char text[], size_t length)
{
  static const char *const modes[] = {"a translation along x", "a translation along y", "a translation along z",
    "a rotation about x", "a rotation about y", "a rotation about z"};
  const PetscInt           freest  = SupportFindFreest(outside);
  PetscInt                 nfree = 0, n = 0;
  size_t                   used = 0;

  if (freest < 0) return PETSC_FALSE;
  for (PetscInt k = 0; k < 6; ++k) nfree += outside[k] > 1 - 1e-6;
  if (nfree == 6) (void)snprintf(text, length, "nothing holds body \"%s\"", name);
  else (void)snprintf(text, length, "body \"%s\" is not held against ", name);
  for (PetscInt k = 0; k < 6 && nfree < 6; ++k) {
    if (nfree ? !(outside[k] > 1 - 1e-6) : k != freest) continue;
    ++n;
    used = strlen(text);
    (void)snprintf(text + used, length - used, "%s%s", n == 1 ? "" : n < nfree ? ", " : " and ", modes[k]);
  }
  return PETSC_TRUE;
}

/* Collective. Reports the bodies that have free modes */
static PetscErrorCode SupportRaise(const Support *support, Scene scene)
{
  const PetscInt most  = 4; /* number of bodies in the message */
  PetscInt       first = PETSC_DECIDE, n = 0;
  char           text[1600] = "", body[400];

  PetscFunctionBegin;
  for (PetscInt b = 0; b < scene->nbodies; ++b) {
    if (!SupportDescribe(scene->bodies[b].name, support->outside[b], body, sizeof(body))) continue;
    if (first < 0) first = b;
    if (n && n < most) PetscCall(PetscStrlcat(text, "; ", sizeof(text)));
    if (n++ < most) PetscCall(PetscStrlcat(text, body, sizeof(text)));
  }
  if (first < 0) PetscFunctionReturn(0);
  (void)snprintf(body, sizeof(body), "; and %" PetscInt_FMT " more bodies", n - most);
  if (n > most) PetscCall(PetscStrlcat(text, body, sizeof(text)));
  SceneCheck(PETSC_FALSE, PetscObjectComm((PetscObject)support->dm), PETSC_ERR_USER_INPUT, &scene->bodies[first],
    "%s: prescribe a displacement, or add springs, a tie or a contact pair", text);
  PetscFunctionReturn(0);
}

/* Collective. Checks that two faces of an entry of the scene, either of which may be NULL, have facets. A surface of a
   Gmsh file has none if it is not on the boundary of the body. */
static PetscErrorCode SupportCheckFacets(DM dm, const char what[], const void *owner, const char first[],
  const char second[])
{
  const SceneEntry *entry   = owner;
  const char *const face[2] = {first, second};

  PetscFunctionBegin;
  for (PetscInt k = 0; k < 2; ++k) {
    IS       facets;
    PetscInt n;

    if (!face[k]) continue;
    PetscCall(MeshGetFacets(dm, face[k], &facets));
    PetscCall(ISGetLocalSize(facets, &n));
    PetscCall(ISDestroy(&facets));
    PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &n, 1, MPIU_INT, MPI_SUM, PetscObjectComm((PetscObject)dm)));
    SceneCheck(n, PetscObjectComm((PetscObject)dm), PETSC_ERR_USER_INPUT, entry,
      "%s \"%s\": the face \"%s\" has no facets, because that surface of the mesh file is not on the boundary of the "
      "body",
      what, entry->name, face[k]);
  }
  PetscFunctionReturn(0);
}

/* Collective. Reports the bodies with free modes as an error. Contact pairs are assumed closed. */
static PetscErrorCode SupportCheckBodies(DM dm, Scene scene)
{
  Support  support;
  Mat      motions;
  PetscInt n;

  PetscFunctionBegin;
  PetscCall(SupportCreate(dm, scene, NULL, SUPPORT_SLIDING, &support));
  PetscCall(SupportFindFree(&support, &n, &motions));
  PetscCall(SupportRaise(&support, scene));
  PetscCall(MatDestroy(&motions));
  PetscCall(SupportDestroy(&support));
  PetscFunctionReturn(0);
}

/*@
  MeshGetUnsupported - Finds the bodies that have free rigid body motions

  Collective

  Input Parameters:
+ dm    - the mesh, created by `MeshCreate()`
- scene - the scene

  Output Parameters:
+ unsupported - one value per body: whether any of its rigid body motions is free
- rotations   - of each body, a rotation that nothing resists if the other bodies are held

  Level: intermediate

  Note:
  Without weak springs only bodies with such a rotation count as unsupported, and `MeshCheckScene()` rejects all others.

.seealso: `MeshCheckScene()`
@*/
PetscErrorCode MeshGetUnsupported(DM dm, Scene scene, PetscBool unsupported[], MeshRotation rotations[])
{
  Support  support;
  Mat      motions = NULL;
  PetscInt n;

  PetscFunctionBegin;
  PetscCall(SupportCreate(dm, scene, NULL, SUPPORT_SLIDING, &support));
  PetscCall(SupportFindGliding(&support, unsupported, rotations));
  if (scene->weak_springs) PetscCall(SupportFindFree(&support, &n, &motions));
  for (PetscInt b = 0; b < scene->nbodies; ++b) {
    if (!scene->weak_springs)
      unsupported[b] = (PetscBool)(rotations[b].free && scene->bodies[b].material.type != MATERIAL_RIGID);
    else unsupported[b] = (PetscBool)(unsupported[b] || SupportFindFreest(support.outside[b]) >= 0);
  }
  PetscCall(MatDestroy(&motions));
  PetscCall(SupportDestroy(&support));
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
  for (PetscInt d = 0; d < scene->ndisplacements; ++d)
    PetscCall(SupportCheckFacets(dm, "Displacement", &scene->displacements[d],
      scene->displacements[d].at == DISPLACEMENT_FACE ? scene->displacements[d].face : NULL, NULL));
  for (PetscInt p = 0; p < scene->npressures; ++p)
    PetscCall(SupportCheckFacets(dm, "Pressure", &scene->pressures[p], scene->pressures[p].face, NULL));
  for (PetscInt t = 0; t < scene->ntractions; ++t)
    PetscCall(SupportCheckFacets(dm, "Load", &scene->tractions[t],
      SceneForceIsAtPoint(scene, &scene->tractions[t]) ? NULL : scene->tractions[t].face, NULL));
  for (PetscInt s = 0; s < scene->nsprings; ++s)
    PetscCall(SupportCheckFacets(dm, "Spring", &scene->springs[s], scene->springs[s].face, scene->springs[s].to));
  for (PetscInt p = 0; p < scene->npairs; ++p)
    PetscCall(
      SupportCheckFacets(dm, "Contact pair", &scene->pairs[p], scene->pairs[p].mortar, scene->pairs[p].nonmortar));
  for (PetscInt t = 0; t < scene->nties; ++t)
    PetscCall(SupportCheckFacets(dm, "Tie", &scene->ties[t], scene->ties[t].mortar, scene->ties[t].nonmortar));
  for (PetscInt k = 0; k < scene->ncyclic; ++k)
    PetscCall(SupportCheckFacets(dm, "Cyclic symmetry", &scene->cyclic[k], scene->cyclic[k].from, scene->cyclic[k].to));
  if (!SceneIsDynamic(scene) && !scene->weak_springs) PetscCall(SupportCheckBodies(dm, scene));
  PetscFunctionReturn(0);
}
