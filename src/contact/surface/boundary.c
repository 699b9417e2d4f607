/* The boundary of all bodies: mean thickness, and solid angles for tests whether a point is inside */
#include <mesh.h>
#include "surfaceimpl.h"

/* Collective. Counts the bodies on all ranks */
static PetscErrorCode BoundaryCountBodies(DM dm, PetscInt *nbodies)
{
  MPI_Comm comm = PetscObjectComm((PetscObject)dm);
  DMLabel  label;
  IS       values;
  PetscInt last = -1;

  PetscFunctionBegin;
  PetscCall(DMGetLabel(dm, MESH_BODY_LABEL, &label));
  PetscCheck(label, comm, PETSC_ERR_ARG_WRONG, "The mesh has no label \"%s\"", MESH_BODY_LABEL);
  PetscCall(DMLabelGetValueIS(label, &values));
  PetscCall(ISGetMinMax(values, NULL, &last));
  PetscCall(ISDestroy(&values));
  PetscCallMPI(MPI_Allreduce(&last, nbodies, 1, MPIU_INT, MPI_MAX, comm));
  *nbodies = PetscMax(*nbodies, -1) + 1;
  PetscFunctionReturn(0);
}

/* Collective. Collects the boundary facets of the bodies on this rank */
PetscErrorCode ContactBoundaryCreate(DM dm, ContactBoundary *b)
{
  PetscInt   start, end;
  PetscBool *boundary;

  PetscFunctionBegin;
  b->comm = PetscObjectComm((PetscObject)dm);
  b->n    = 0;
  PetscCall(BoundaryCountBodies(dm, &b->nbodies));
  PetscCall(DMPlexGetHeightStratum(dm, 1, &start, &end));
  PetscCall(PetscMalloc1(end - start, &boundary));
  PetscCall(MeshMarkBoundary(dm, boundary));
  for (PetscInt f = start; f < end; ++f) b->n += boundary[f - start];
  PetscCall(PetscMalloc3(b->n, &b->body, 4 * b->n, &b->vertex, 12 * b->n, &b->x));
  b->n = 0;
  for (PetscInt f = start; f < end; ++f) {
    const PetscInt *cell;
    PetscInt       *vertex = &b->vertex[4 * b->n], body;

    if (!boundary[f - start]) continue;
    PetscCall(DMPlexGetSupport(dm, f, &cell));
    PetscCall(DMGetLabelValue(dm, MESH_BODY_LABEL, cell[0], &body));
    if (body < 0) continue;
    PetscCall(MeshGetFacetVertices(dm, f, vertex));
    PetscCall(MeshGetVertexCoordinates(dm, 4, vertex, (PetscReal(*)[3]) & b->x[12 * b->n]));
    b->body[b->n++] = body;
  }
  PetscCall(PetscFree(boundary));
  PetscFunctionReturn(0);
}

PetscErrorCode ContactBoundaryDestroy(ContactBoundary *b)
{
  PetscFunctionBegin;
  PetscCall(PetscFree3(b->body, b->vertex, b->x));
  PetscFunctionReturn(0);
}

/* Collective. Moves the facets' vertices to the global displacement u */
PetscErrorCode ContactBoundaryDeform(DM dm, Vec u, ContactBoundary *b)
{
  Vec local;

  PetscFunctionBegin;
  PetscCall(DMGetLocalVector(dm, &local));
  PetscCall(VecZeroEntries(local));
  PetscCall(DMGlobalToLocal(dm, u, INSERT_VALUES, local));
  PetscCall(ContactVerticesDeform(dm, local, 4 * b->n, b->vertex, b->x));
  PetscCall(DMRestoreLocalVector(dm, &local));
  PetscFunctionReturn(0);
}

/* Collective. Computes the mean thickness of each body [length]: 2 volume / boundary area, where 3 volume = int x.n dA.
   For a thin plate or shell this is its thickness. For a compact body it is smaller than any width of the body. */
PetscErrorCode ContactBoundaryThickness(const ContactBoundary *b, PetscReal thickness[])
{
  PetscReal *volume = thickness, *area;

  PetscFunctionBegin;
  PetscCall(PetscCalloc1(b->nbodies, &area));
  PetscCall(PetscArrayzero(volume, b->nbodies));
  for (PetscInt f = 0; f < b->n; ++f) {
    const PetscReal *x = &b->x[12 * f];
    PetscReal        n[3], mass[4];

    area[b->body[f]] += ContactFacetMass(x, mass);
    ContactFacetAreaVector(x, n);
    for (PetscInt c = 0; c < 3; ++c) volume[b->body[f]] += n[c] * (x[c] + x[3 + c] + x[6 + c] + x[9 + c]) / 12.0;
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, volume, (PetscMPIInt)b->nbodies, MPIU_REAL, MPIU_SUM, b->comm));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, area, (PetscMPIInt)b->nbodies, MPIU_REAL, MPIU_SUM, b->comm));
  for (PetscInt k = 0; k < b->nbodies; ++k) thickness[k] = area[k] > 0.0 ? 2.0 * volume[k] / area[k] : 0.0;
  PetscCall(PetscFree(area));
  PetscFunctionReturn(0);
}

/* Returns the solid angle of the triangle p, q, r as seen from the origin, positive if the origin is on the back of the
   triangle (Van Oosterom and Strackee 1983) */
static PetscReal BoundaryTriangleAngle(const PetscReal p[3], const PetscReal q[3], const PetscReal r[3])
{
  const PetscReal pp = VectorNorm(p), qq = VectorNorm(q), rr = VectorNorm(r);
  PetscReal       across[3];

  VectorCross(q, r, across);
  return 2.0 * PetscAtan2Real(VectorDot(p, across),
                 pp * qq * rr + VectorDot(p, q) * rr + VectorDot(q, r) * pp + VectorDot(r, p) * qq);
}

/* Returns this rank's part of the solid angle of a body's boundary as seen from the point `from`. The sum over all
   ranks is 4 pi if the point is inside the body, and 0 if it is outside. */
PetscReal ContactBoundarySolidAngle(const ContactBoundary *b, PetscInt body, const PetscReal from[3])
{
  PetscReal sum = 0.0;

  for (PetscInt f = 0; f < b->n; ++f) {
    PetscReal x[4][3];

    if (b->body[f] != body) continue;
    for (PetscInt i = 0; i < 12; ++i) x[i / 3][i % 3] = b->x[12 * f + i] - from[i % 3];
    sum += BoundaryTriangleAngle(x[0], x[1], x[2]) + BoundaryTriangleAngle(x[0], x[2], x[3]);
  }
  return sum;
}
