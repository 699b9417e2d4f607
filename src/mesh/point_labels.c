/* Labels of the nodes at points and edges with prescribed displacements. They are used like the labels of faces. */
#include "meshimpl.h"

/* Returns the distance of the position x from a point or an edge [length] */
static PetscReal PointLabelDistance(const SceneDisplacement *point, const PetscReal x[3])
{
  PetscReal along = 0.0, square = 0.0, distance = 0.0;

  for (PetscInt d = 0; d < 3; ++d) {
    along += (x[d] - point->from[d]) * (point->to[d] - point->from[d]);
    square += PetscSqr(point->to[d] - point->from[d]);
  }
  along = square > 0.0 ? PetscMin(PetscMax(along / square, 0.0), 1.0) : 0.0;
  for (PetscInt d = 0; d < 3; ++d)
    distance += PetscSqr(x[d] - point->from[d] - along * (point->to[d] - point->from[d]));
  return PetscSqrtReal(distance);
}

/* Labels the nodes at a point or an edge. nearest: distance [length] and position of the nearest node of the body on
   this rank */
static PetscErrorCode PointLabelLabel(DM dm, const SceneDisplacement *point, PetscReal tolerance, PetscReal nearest[4])
{
  DMLabel            body, label;
  PetscSection       section;
  Vec                coordinates;
  const PetscScalar *x;
  PetscInt           cstart, cend;

  PetscFunctionBegin;
  nearest[0] = PETSC_MAX_REAL;
  PetscCall(DMCreateLabel(dm, point->face));
  PetscCall(DMGetLabel(dm, point->face, &label));
  PetscCall(DMGetLabel(dm, MESH_BODY_LABEL, &body));
  PetscCall(DMGetLocalSection(dm, &section));
  PetscCall(MeshGetNodeCoordinates(dm, &coordinates));
  PetscCall(VecGetArrayRead(coordinates, &x));
  PetscCall(DMPlexGetHeightStratum(dm, 0, &cstart, &cend));
  for (PetscInt c = cstart; c < cend; ++c) {
    PetscInt of, n, nodes[MESH_MAX_NODES];

    PetscCall(DMLabelGetValue(body, c, &of));
    if (of != point->body) continue;
    PetscCall(MeshGetCellNodes(dm, c, &n, nodes));
    for (PetscInt i = 0; i < n; ++i) {
      PetscInt  offset;
      PetscReal place[3], distance;

      PetscCall(PetscSectionGetOffset(section, nodes[i], &offset));
      for (PetscInt d = 0; d < 3; ++d) place[d] = PetscRealPart(x[offset + d]);
      distance = PointLabelDistance(point, place);
      if (distance <= tolerance) PetscCall(DMLabelSetValue(label, nodes[i], 1));
      if (distance >= nearest[0]) continue;
      nearest[0] = distance;
      PetscCall(PetscArraycpy(nearest + 1, place, 3));
    }
  }
  PetscCall(VecRestoreArrayRead(coordinates, &x));
  PetscFunctionReturn(0);
}

/* Collective. Replaces `nearest` by that of the rank with the smallest distance */
static PetscErrorCode PointLabelFindNearest(MPI_Comm comm, PetscReal nearest[4])
{
  PetscReal   least = nearest[0];
  PetscMPIInt rank, owner;

  PetscFunctionBegin;
  PetscCallMPI(MPI_Comm_rank(comm, &rank));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &least, 1, MPIU_REAL, MPIU_MIN, comm));
  owner = nearest[0] == least ? rank : PETSC_MPI_INT_MAX;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &owner, 1, MPI_INT, MPI_MIN, comm));
  PetscCallMPI(MPI_Bcast(nearest, 4, MPIU_REAL, owner, comm));
  PetscFunctionReturn(0);
}

/* Collective. Labels the nodes at all points and edges with prescribed displacements, once per mesh. It is an error if
   there is no node at a point or an edge. */
PetscErrorCode MeshLabelPoints(DM dm, Scene scene)
{
  MPI_Comm  comm = PetscObjectComm((PetscObject)dm);
  PetscReal lower[3], upper[3], size = 0.0, nearest[4];

  PetscFunctionBegin;
  PetscCall(DMGetBoundingBox(dm, lower, upper));
  for (PetscInt d = 0; d < 3; ++d) size = PetscMax(size, upper[d] - lower[d]);
  for (PetscInt k = 0; k < scene->ndisplacements; ++k) {
    const SceneDisplacement *point = &scene->displacements[k];
    PetscBool                has;

    if (point->at == DISPLACEMENT_FACE) continue;
    PetscCall(DMHasLabel(dm, point->face, &has));
    if (has) continue;
    PetscCall(PointLabelLabel(dm, point, MESH_SAME_PLACE * size, nearest));
    PetscCall(PointLabelFindNearest(comm, nearest));
    SceneCheck(nearest[0] <= MESH_SAME_PLACE * size, comm, PETSC_ERR_USER_INPUT, point,
      "displacement \"%s\": body \"%s\" has no node at that point or edge: the nearest node is at (%g, %g, %g)",
      point->name, scene->bodies[point->body].name, (double)nearest[1], (double)nearest[2], (double)nearest[3]);
  }
  PetscFunctionReturn(0);
}
