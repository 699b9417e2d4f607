/* Shared by the tests of contact: meshes of boxes, bent as wanted, and displacements of their bodies */
#ifndef CONTACT_PROBLEM_H
#define CONTACT_PROBLEM_H

#include <mesh.h>
#include <contact.h>
#include "../contact/contact_report.h"
#include "../elasticity/elasticity_tetrahedra.h"

typedef struct {
  char      name[16];
  PetscReal lower[3], upper[3];
  PetscInt  cells[3];
} Box;

/* The last of the boxes are of tetrahedra of order 1, six a cell */
static inline PetscErrorCode CreateMixedBoxes(MPI_Comm comm, PetscInt n, Box boxes[], PetscInt ntetrahedra,
  PetscInt refine, DM *dm)
{
  SceneBody *body;

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(n, &body));
  for (PetscInt b = 0; b < n; ++b) {
    body[b].name  = boxes[b].name;
    body[b].shape = SHAPE_BOX;
    for (PetscInt d = 0; d < 3; ++d) {
      body[b].lower[d] = boxes[b].lower[d];
      body[b].upper[d] = boxes[b].upper[d];
      body[b].cells[d] = boxes[b].cells[d];
    }
    body[b].order = 1;
    if (b >= n - ntetrahedra) PetscCall(TetrahedraFromBox(&body[b]));
  }
  PetscCall(MeshCreate(comm, n, body, refine, dm));
  PetscCall(PetscFree(body));
  PetscFunctionReturn(0);
}

static inline PetscErrorCode CreateBoxes(MPI_Comm comm, PetscInt n, Box boxes[], PetscInt refine, DM *dm)
{
  PetscFunctionBeginUser;
  PetscCall(CreateMixedBoxes(comm, n, boxes, 0, refine, dm));
  PetscFunctionReturn(0);
}

/* A vector at the reference place x of a body's vertex */
typedef void (*Field)(const PetscReal x[3], PetscInt body, const void *ctx, PetscReal v[3]);

/* Values of the field at this rank's vertices, in a local vector of the given section */
static inline PetscErrorCode SetLocalField(DM dm, Field field, const void *ctx, PetscSection section, Vec local)
{
  Vec          reference, coordinates;
  PetscScalar *x, *a;
  PetscInt     start, end;
  PetscSection coordsection;

  PetscFunctionBeginUser;
  PetscCall(DMGetCoordinatesLocal(dm, &reference));
  PetscCall(VecDuplicate(reference, &coordinates)); /* local may be the coordinates themselves */
  PetscCall(VecCopy(reference, coordinates));
  PetscCall(DMGetCoordinateSection(dm, &coordsection));
  PetscCall(VecGetArray(coordinates, &x));
  PetscCall(VecGetArray(local, &a));
  PetscCall(DMPlexGetHeightStratum(dm, 0, &start, &end));
  for (PetscInt c = start; c < end; ++c) {
    PetscInt n, vertex[MESH_MAX_NODES], body;

    PetscCall(DMGetLabelValue(dm, MESH_BODY_LABEL, c, &body));
    PetscCall(MeshGetCellNodes(dm, c, &n, vertex));
    for (PetscInt i = 0; i < n; ++i) {
      PetscInt  from, to;
      PetscReal y[3], v[3];

      PetscCall(PetscSectionGetOffset(coordsection, vertex[i], &from));
      PetscCall(PetscSectionGetOffset(section, vertex[i], &to));
      for (PetscInt d = 0; d < 3; ++d) y[d] = PetscRealPart(x[from + d]);
      (*field)(y, body, ctx, v);
      for (PetscInt d = 0; d < 3; ++d) a[to + d] = v[d];
    }
  }
  PetscCall(VecRestoreArray(local, &a));
  PetscCall(VecRestoreArray(coordinates, &x));
  PetscCall(VecDestroy(&coordinates));
  PetscFunctionReturn(0);
}

/* A displacement: the global vector of the field's values */
static inline PetscErrorCode SetField(DM dm, Field field, const void *ctx, Vec u)
{
  Vec          local;
  PetscSection section;

  PetscFunctionBeginUser;
  PetscCall(DMGetLocalVector(dm, &local));
  PetscCall(DMGetLocalSection(dm, &section));
  PetscCall(SetLocalField(dm, field, ctx, section, local));
  PetscCall(DMLocalToGlobal(dm, local, INSERT_VALUES, u));
  PetscCall(DMRestoreLocalVector(dm, &local));
  PetscFunctionReturn(0);
}

/* Puts the vertices where the field says */
static inline PetscErrorCode SetPlaces(DM dm, Field place, const void *ctx)
{
  Vec          coordinates;
  PetscSection section;

  PetscFunctionBeginUser;
  PetscCall(DMGetCoordinatesLocal(dm, &coordinates));
  PetscCall(DMGetCoordinateSection(dm, &section));
  PetscCall(SetLocalField(dm, place, ctx, section, coordinates));
  PetscFunctionReturn(0);
}

/* Grows *error to max |v - value| over the rows of a pair (all pairs if negative) */
static inline PetscErrorCode Deviation(ContactLinearization lin, Vec v, PetscInt pair, PetscReal value,
  PetscReal *error)
{
  const PetscScalar *a;

  PetscFunctionBeginUser;
  PetscCall(VecGetArrayRead(v, &a));
  for (PetscInt i = 0; i < lin->nlocal; ++i) {
    if (pair < 0 || lin->pair[i] == pair) *error = PetscMax(*error, PetscAbsScalar(a[i] - value));
  }
  PetscCall(VecRestoreArrayRead(v, &a));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, error, 1, MPIU_REAL, MPIU_MAX, PetscObjectComm((PetscObject)v)));
  PetscFunctionReturn(0);
}

/* Rows of a pair on all ranks */
static inline PetscErrorCode CountPairRows(ContactLinearization lin, PetscInt pair, PetscInt *n)
{
  PetscFunctionBeginUser;
  *n = 0;
  for (PetscInt i = 0; i < lin->nlocal; ++i) *n += lin->pair[i] == pair;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, n, 1, MPIU_INT, MPI_SUM, PetscObjectComm((PetscObject)lin->g)));
  PetscFunctionReturn(0);
}

#endif
