/* Points of bodies at which forces act. The displacement of a point is interpolated in the cell that contains it. */
#include "loadsimpl.h"
#include <mesh.h>

/* Shares a point that one rank has found. entry: names the point in messages */
static PetscErrorCode BodyPointShare(DM dm, Scene scene, const char what[], const SceneEntry *entry, PetscInt body,
  const PetscReal x[3], const MeshPlace *place, BodyPoint *point)
{
  const PetscReal tolerance = 0.1;
  MPI_Comm        comm      = PetscObjectComm((PetscObject)dm);
  PetscSection    global;
  PetscInt        nodes[MESH_MAX_NODES], offset;
  PetscReal       off = 0.0;

  PetscFunctionBegin;
  if (place->cell >= 0) off = place->distance / place->size;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &off, 1, MPIU_REAL, MPIU_MAX, comm));
  PetscCall(PetscArrayzero(point, 1));
  if (place->cell >= 0) {
    PetscCall(DMGetGlobalSection(dm, &global));
    PetscCall(MeshGetCellNodes(dm, place->cell, &point->n, nodes));
    for (PetscInt a = 0; a < point->n; ++a) {
      PetscCall(PetscSectionGetOffset(global, nodes[a], &offset));
      point->node[a] = (offset < 0 ? -(offset + 1) : offset) / 3;
      point->N[a]    = place->N[a];
    }
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &point->n, 1, MPIU_INT, MPI_SUM, comm));
  SceneCheck(point->n && off <= tolerance, comm, PETSC_ERR_USER_INPUT, entry,
    "%s \"%s\": its point (%g, %g, %g) is outside of its body \"%s\"", what, entry->name, (double)x[0], (double)x[1],
    (double)x[2], scene->bodies[body].name);
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, point->node, MESH_MAX_NODES, MPIU_INT, MPI_SUM, comm));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, point->N, MESH_MAX_NODES, MPIU_REAL, MPIU_SUM, comm));
  PetscFunctionReturn(0);
}

PetscErrorCode BodyPointsLocate(DM dm, Scene scene, const char what[], PetscInt n, const SceneEntry *const entry[],
  const PetscInt body[], const PetscReal x[][3], BodyPoint points[])
{
  MeshPlace *places;

  PetscFunctionBegin;
  PetscCall(PetscMalloc1(n, &places));
  PetscCall(MeshLocate(dm, n, x, body, places));
  for (PetscInt i = 0; i < n; ++i)
    PetscCall(BodyPointShare(dm, scene, what, entry[i], body[i], x[i], &places[i], &points[i]));
  PetscCall(PetscFree(places));
  PetscFunctionReturn(0);
}
