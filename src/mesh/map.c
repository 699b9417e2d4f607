/* From the shapes' parameters to space, and whether the cells are sound there */
#include "mesh_private.h"
#include <petscbt.h>

PetscErrorCode MeshMapVertices(DM dm, PetscInt nbodies, const SceneBody bodies[], PetscBool curved)
{
  Vec          coordinates;
  PetscSection section;
  PetscScalar *x;
  PetscBT      done;
  PetscInt     cstart, cend, vstart, vend;

  PetscFunctionBegin;
  PetscCall(DMPlexGetHeightStratum(dm, 0, &cstart, &cend));
  PetscCall(DMPlexGetDepthStratum(dm, 0, &vstart, &vend));
  PetscCall(DMGetCoordinatesLocal(dm, &coordinates));
  PetscCall(DMGetCoordinateSection(dm, &section));
  PetscCall(PetscBTCreate(vend - vstart, &done));
  PetscCall(VecGetArray(coordinates, &x));
  for (PetscInt c = cstart; c < cend; ++c) {
    PetscInt     b, vertices[8];
    const Shape *shape;

    PetscCall(DMGetLabelValue(dm, MESH_BODY_LABEL, c, &b));
    PetscCheck(b >= 0 && b < nbodies, PETSC_COMM_SELF, PETSC_ERR_PLIB, "Cell %" PetscInt_FMT " belongs to no body", c);
    PetscCall(ShapeGet(PETSC_COMM_SELF, &bodies[b], &shape));
    if (!shape || !shape->map || bodies[b].curved != curved) continue;
    PetscCall(MeshGetCellVertices(dm, c, vertices));
    for (PetscInt a = 0; a < 8; ++a) {
      PetscInt  offset;
      PetscReal p[3], place[3];

      if (PetscBTLookupSet(done, vertices[a] - vstart)) continue;
      PetscCall(PetscSectionGetOffset(section, vertices[a], &offset));
      for (PetscInt d = 0; d < 3; ++d) p[d] = PetscRealPart(x[offset + d]);
      PetscCall(shape->map(&bodies[b], p, place));
      for (PetscInt d = 0; d < 3; ++d) x[offset + d] = place[d];
    }
  }
  PetscCall(VecRestoreArray(coordinates, &x));
  PetscCall(PetscBTDestroy(&done));
  /* The global coordinates, if they were made, are those from before */
  PetscCall(DMSetCoordinatesLocal(dm, coordinates));
  PetscFunctionReturn(0);
}

/* Smallest of the Jacobian's determinants at the corners, in units of the longest edge cubed */
static PetscReal CellQuality(PetscReal x[8][3])
{
  PetscReal smallest = PETSC_MAX_REAL, longest = 0;

  for (PetscInt a = 0; a < 8; ++a) {
    PetscReal e[3][3], det;

    for (PetscInt k = 0; k < 3; ++k) {
      const PetscInt low = a & ~(1 << k), high = a | 1 << k;
      PetscReal      length = 0;

      for (PetscInt d = 0; d < 3; ++d) {
        e[k][d] = x[high][d] - x[low][d];
        length += PetscSqr(e[k][d]);
      }
      longest = PetscMax(longest, PetscSqrtReal(length));
    }
    det      = e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) - e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) + e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0]);
    smallest = PetscMin(smallest, det);
  }
  return longest > 0 ? smallest / (longest * longest * longest) : 0;
}

/* Raises the first of the bodies that have bad cells; count and place are this rank's, place is of the first bad cell */
static PetscErrorCode ReportBadCells(MPI_Comm comm, PetscInt nbodies, const SceneBody bodies[], const PetscInt count[], PetscReal place[][3])
{
  PetscMPIInt rank;
  PetscInt   *total;

  PetscFunctionBegin;
  PetscCallMPI(MPI_Comm_rank(comm, &rank));
  PetscCall(PetscMalloc1(nbodies, &total));
  PetscCallMPI(MPI_Allreduce(count, total, (PetscMPIInt)nbodies, MPIU_INT, MPI_SUM, comm));
  for (PetscInt b = 0; b < nbodies; ++b) {
    PetscMPIInt owner = count[b] ? rank : PETSC_MPI_INT_MAX, first;
    const char *from  = bodies[b].shape == SHAPE_GMSH ? bodies[b].gmsh.file : "";

    if (!total[b]) continue;
    PetscCallMPI(MPI_Allreduce(&owner, &first, 1, MPI_INT, MPI_MIN, comm));
    PetscCallMPI(MPI_Bcast(place[b], 3, MPIU_REAL, first, comm));
    SETERRQ(comm, PETSC_ERR_USER_INPUT, "Body \"%s\"%s%s has %" PetscInt_FMT " inverted or flat cells, one of them around (%g, %g, %g)", bodies[b].name, *from ? " of " : "", from, total[b], (double)place[b][0], (double)place[b][1], (double)place[b][2]);
  }
  PetscCall(PetscFree(total));
  PetscFunctionReturn(0);
}

PetscErrorCode MeshCheckCells(DM dm, PetscInt nbodies, const SceneBody bodies[])
{
  Vec                coordinates;
  PetscSection       section;
  const PetscScalar *array;
  PetscInt           cstart, cend, *count;
  PetscReal(*place)[3];

  PetscFunctionBegin;
  PetscCall(DMPlexGetHeightStratum(dm, 0, &cstart, &cend));
  PetscCall(DMGetCoordinatesLocal(dm, &coordinates));
  PetscCall(DMGetCoordinateSection(dm, &section));
  PetscCall(PetscCalloc2(nbodies, &count, nbodies, &place));
  PetscCall(VecGetArrayRead(coordinates, &array));
  for (PetscInt c = cstart; c < cend; ++c) {
    PetscInt  b, vertices[8];
    PetscReal x[8][3];

    PetscCall(MeshGetCellVertices(dm, c, vertices));
    for (PetscInt a = 0; a < 8; ++a) {
      PetscInt offset;

      PetscCall(PetscSectionGetOffset(section, vertices[a], &offset));
      for (PetscInt d = 0; d < 3; ++d) x[a][d] = PetscRealPart(array[offset + d]);
    }
    if (CellQuality(x) > 1e-12) continue;
    PetscCall(DMGetLabelValue(dm, MESH_BODY_LABEL, c, &b));
    for (PetscInt a = 0; a < 8 && !count[b]; ++a) {
      for (PetscInt d = 0; d < 3; ++d) place[b][d] += x[a][d] / 8;
    }
    ++count[b];
  }
  PetscCall(VecRestoreArrayRead(coordinates, &array));
  PetscCall(ReportBadCells(PetscObjectComm((PetscObject)dm), nbodies, bodies, count, place));
  PetscCall(PetscFree2(count, place));
  PetscFunctionReturn(0);
}
