/* Locates the probes of a scene in its mesh */
#include "queryimpl.h"

/* A point that is outside of its cell by less than this fraction of the cell's size counts as being on the curved
   surface between facets. */
static const PetscReal probe_tolerance = 0.1;

/* Reports a point of a probe that is not in its body */
static PetscErrorCode ProbeRaise(DM dm, Scene scene, const SceneProbe *probe, const PetscReal x[3],
  const MeshPlace *place)
{
  const char *what   = probe->line ? "a point of the line" : "the point",
             *body   = probe->body < 0 ? "any body" : scene->bodies[probe->body].name;
  const char *advice = probe->line ? ": end the line before that point, and begin another one after it" : "";
  MPI_Comm    comm   = PetscObjectComm((PetscObject)dm);

  PetscFunctionBegin;
  SceneCheck(place->distance < PETSC_MAX_REAL, comm, PETSC_ERR_USER_INPUT, probe,
    "probe \"%s\": %s, (%g, %g, %g), is not in %s%s", probe->name, what, (double)x[0], (double)x[1], (double)x[2], body,
    advice);
  SETERRQ(comm, PETSC_ERR_USER_INPUT,
    "%s"
    "probe \"%s\": %s, (%g, %g, %g), is not in %s; it is %g outside%s",
    ScenePlace(probe), probe->name, what, (double)x[0], (double)x[1], (double)x[2], body, (double)place->distance,
    advice);
}

/*@C
  MeshLocateProbes - Finds the points of a scene's probes in its mesh

  Collective

  Input Parameters:
+ dm    - the mesh, created by `MeshCreate()`
- scene - the scene

  Output Parameters:
+ n      - number of points of all probes
. points - the coordinates of the points [length]; free them with `PetscFree()`
- places - the positions in cells that `MeshLocate()` finds; free them with `PetscFree()`

  Level: intermediate

  Notes:
  It is an error if a point is outside of its body by more than a tenth of the size of a cell.

.seealso: `MeshCheckScene()`
@*/
PetscErrorCode MeshLocateProbes(DM dm, Scene scene, PetscInt *n, PetscReal (*points[])[3], MeshPlace *places[])
{
  PetscInt *body, k = 0;
  PetscReal size;

  PetscFunctionBegin;
  *n = 0;
  for (PetscInt p = 0; p < scene->nprobes; ++p) *n += scene->probes[p].n;
  PetscCall(PetscMalloc1(*n, points));
  PetscCall(PetscMalloc1(*n, places));
  PetscCall(PetscMalloc1(*n, &body));
  for (PetscInt p = 0; p < scene->nprobes; ++p) {
    const SceneProbe *probe = &scene->probes[p];

    for (PetscInt i = 0; i < probe->n; ++i, ++k) {
      const PetscReal t = probe->line ? (PetscReal)i / (PetscReal)(probe->n - 1) : 0.0;

      for (PetscInt d = 0; d < 3; ++d) (*points)[k][d] = (1 - t) * probe->from[d] + t * probe->to[d];
      body[k] = probe->body;
    }
  }
  PetscCall(MeshLocate(dm, *n, *points, body, *places));
  k = 0;
  for (PetscInt p = 0; p < scene->nprobes; ++p) {
    for (PetscInt i = 0; i < scene->probes[p].n; ++i, ++k) {
      size = (*places)[k].cell >= 0 ? (*places)[k].size : 0.0;
      PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &size, 1, MPIU_REAL, MPIU_MAX, PetscObjectComm((PetscObject)dm)));
      if ((*places)[k].distance > probe_tolerance * size)
        PetscCall(ProbeRaise(dm, scene, &scene->probes[p], (*points)[k], &(*places)[k]));
    }
  }
  PetscCall(PetscFree(body));
  PetscFunctionReturn(0);
}
