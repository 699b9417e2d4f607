/* How thick the bodies behind a face are: contact never looks through a body */
#include <mesh.h>
#include <petscsf.h>
#include "contactimpl.h"

/* Marks the facets that bound the bodies: one cell here, and no copy on another rank */
static PetscErrorCode MarkBoundary(DM dm, PetscInt start, PetscInt end, PetscBool boundary[])
{
  PetscSF         sf;
  PetscInt        nroots, nleaves;
  const PetscInt *leaves, *degree;

  PetscFunctionBegin;
  for (PetscInt f = start; f < end; ++f) {
    PetscInt ncells;

    PetscCall(DMPlexGetSupportSize(dm, f, &ncells));
    boundary[f - start] = (PetscBool)(ncells == 1);
  }
  PetscCall(DMGetPointSF(dm, &sf));
  PetscCall(PetscSFGetGraph(sf, &nroots, &nleaves, &leaves, NULL));
  if (nroots < 0) PetscFunctionReturn(0);
  PetscCall(PetscSFComputeDegreeBegin(sf, &degree));
  PetscCall(PetscSFComputeDegreeEnd(sf, &degree));
  for (PetscInt f = start; f < end; ++f) {
    if (degree[f]) boundary[f - start] = PETSC_FALSE;
  }
  for (PetscInt i = 0; i < nleaves; ++i) {
    const PetscInt f = leaves ? leaves[i] : i;

    if (f >= start && f < end) boundary[f - start] = PETSC_FALSE;
  }
  PetscFunctionReturn(0);
}

/* volume and area of every body from its boundary: 3 V = int x.n */
static PetscErrorCode BodySizes(DM dm, PetscInt nbodies, PetscReal volume[], PetscReal area[])
{
  MPI_Comm           comm = PetscObjectComm((PetscObject)dm);
  PetscInt           start, end;
  PetscBool         *boundary;
  Vec                coordinates;
  PetscSection       section;
  const PetscScalar *a;

  PetscFunctionBegin;
  PetscCall(DMPlexGetHeightStratum(dm, 1, &start, &end));
  PetscCall(PetscMalloc1(end - start, &boundary));
  PetscCall(MarkBoundary(dm, start, end, boundary));
  PetscCall(DMGetCoordinatesLocal(dm, &coordinates));
  PetscCall(DMGetCoordinateSection(dm, &section));
  PetscCall(VecGetArrayRead(coordinates, &a));
  PetscCall(PetscArrayzero(volume, nbodies));
  PetscCall(PetscArrayzero(area, nbodies));
  for (PetscInt f = start; f < end; ++f) {
    const PetscInt *cell;
    PetscInt        vertex[4], body;
    PetscReal       x[12], n[3], mass[4];

    if (!boundary[f - start]) continue;
    PetscCall(DMPlexGetSupport(dm, f, &cell));
    PetscCall(DMGetLabelValue(dm, MESH_BODY_LABEL, cell[0], &body));
    if (body < 0) continue;
    PetscCall(MeshGetFacetVertices(dm, f, vertex));
    for (PetscInt i = 0; i < 4; ++i) {
      PetscInt offset;

      PetscCall(PetscSectionGetOffset(section, vertex[i], &offset));
      for (PetscInt c = 0; c < 3; ++c) x[3 * i + c] = PetscRealPart(a[offset + c]);
    }
    area[body] += ContactFacetMass(x, mass);
    ContactFacetAreaVector(x, n);
    for (PetscInt c = 0; c < 3; ++c) volume[body] += n[c] * (x[c] + x[3 + c] + x[6 + c] + x[9 + c]) / 12.0;
  }
  PetscCall(VecRestoreArrayRead(coordinates, &a));
  PetscCall(PetscFree(boundary));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, volume, (PetscMPIInt)nbodies, MPIU_REAL, MPIU_SUM, comm));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, area, (PetscMPIInt)nbodies, MPIU_REAL, MPIU_SUM, comm));
  PetscFunctionReturn(0);
}

/*
  Collective. Mean thickness of every body: twice its volume by the area of its boundary, the thickness of a thin plate or
  shell, and less than any width of a compact body.
*/
PetscErrorCode ContactBodyThickness(DM dm, PetscInt *nbodies, PetscReal *thickness[])
{
  MPI_Comm   comm = PetscObjectComm((PetscObject)dm);
  DMLabel    label;
  IS         values;
  PetscInt   last = -1;
  PetscReal *area;

  PetscFunctionBegin;
  PetscCall(DMGetLabel(dm, MESH_BODY_LABEL, &label));
  PetscCheck(label, comm, PETSC_ERR_ARG_WRONG, "The mesh has no label \"%s\"", MESH_BODY_LABEL);
  PetscCall(DMLabelGetValueIS(label, &values));
  PetscCall(ISGetMinMax(values, NULL, &last));
  PetscCall(ISDestroy(&values));
  PetscCallMPI(MPI_Allreduce(&last, nbodies, 1, MPIU_INT, MPI_MAX, comm));
  *nbodies = PetscMax(*nbodies, -1) + 1;
  PetscCall(PetscMalloc1(*nbodies, thickness));
  PetscCall(PetscMalloc1(*nbodies, &area));
  PetscCall(BodySizes(dm, *nbodies, *thickness, area));
  for (PetscInt b = 0; b < *nbodies; ++b) (*thickness)[b] *= area[b] > 0.0 ? 2.0 / area[b] : 0.0;
  PetscCall(PetscFree(area));
  PetscFunctionReturn(0);
}
