/* The facets of a named face: taken from the mesh once, deformed at every linearization */
#include <mesh.h>
#include "contactimpl.h"

/* Number of a vertex among those of all ranks; the mesh lays out 3 rows a vertex, owned ones as they are, others encoded */
static PetscErrorCode SurfaceVertexNode(PetscSection global, PetscInt vertex, PetscInt *node)
{
  PetscInt offset;

  PetscFunctionBegin;
  PetscCall(PetscSectionGetOffset(global, vertex, &offset));
  *node = (offset < 0 ? -(offset + 1) : offset) / 3;
  PetscFunctionReturn(0);
}

/* x = values of a local vector of 3 components a vertex at n vertices */
static PetscErrorCode SurfaceGatherVertices(PetscSection section, Vec local, PetscInt n, const PetscInt vertex[], PetscReal x[])
{
  const PetscScalar *a;

  PetscFunctionBegin;
  PetscCall(VecGetArrayRead(local, &a));
  for (PetscInt i = 0; i < n; ++i) {
    PetscInt offset;

    PetscCall(PetscSectionGetOffset(section, vertex[i], &offset));
    for (PetscInt c = 0; c < 3; ++c) x[3 * i + c] = PetscRealPart(a[offset + c]);
  }
  PetscCall(VecRestoreArrayRead(local, &a));
  PetscFunctionReturn(0);
}

/* The body these facets belong to, on all ranks */
static PetscErrorCode SurfaceFindBody(DM dm, PetscInt nfacets, const PetscInt facet[], PetscInt *body)
{
  PetscInt mine = -1;

  PetscFunctionBegin;
  if (nfacets) {
    const PetscInt *cell;

    PetscCall(DMPlexGetSupport(dm, facet[0], &cell));
    PetscCall(DMGetLabelValue(dm, MESH_BODY_LABEL, cell[0], &mine));
  }
  PetscCallMPI(MPI_Allreduce(&mine, body, 1, MPIU_INT, MPI_MAX, PetscObjectComm((PetscObject)dm)));
  PetscFunctionReturn(0);
}

/* Collective. The gap knows of bilinear facets alone */
static PetscErrorCode SurfaceCheckOrder(DM dm, const char face[], PetscInt nfacets, const PetscInt facet[])
{
  PetscInt n = 0, nodes[MESH_MAX_FACET_NODES];

  PetscFunctionBegin;
  if (nfacets) PetscCall(MeshGetFacetNodes(dm, facet[0], &n, nodes));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &n, 1, MPIU_INT, MPI_MAX, PetscObjectComm((PetscObject)dm)));
  PetscCheck(n <= 4, PetscObjectComm((PetscObject)dm), PETSC_ERR_SUP, "Face \"%s\" of a contact pair is of a body of order 2; contact takes bodies of order 1", face);
  PetscFunctionReturn(0);
}

/* Collective. thickness: of every body */
PetscErrorCode ContactSurfaceCreate(DM dm, const char face[], const PetscReal thickness[], ContactSurface *s)
{
  MPI_Comm        comm = PetscObjectComm((PetscObject)dm);
  IS              facets;
  const PetscInt *f;
  PetscInt        total;
  PetscReal       mass[4], area = 0.0;
  PetscSection    global, coordsection;
  Vec             coordinates;

  PetscFunctionBegin;
  PetscCall(PetscStrallocpy(face, &s->name));
  PetscCall(MeshGetFacets(dm, face, &facets));
  PetscCall(ISGetLocalSize(facets, &s->nfacets));
  PetscCallMPI(MPI_Allreduce(&s->nfacets, &total, 1, MPIU_INT, MPI_SUM, comm));
  PetscCheck(total > 0, comm, PETSC_ERR_ARG_WRONG, "Face \"%s\" of a contact pair has no facets", face);
  PetscCall(PetscMalloc4(4 * s->nfacets, &s->vertex, 4 * s->nfacets, &s->node, 12 * s->nfacets, &s->reference, 12 * s->nfacets, &s->x));
  PetscCall(DMGetGlobalSection(dm, &global));
  PetscCall(ISGetIndices(facets, &f));
  PetscCall(SurfaceCheckOrder(dm, face, s->nfacets, f));
  for (PetscInt i = 0; i < s->nfacets; ++i) {
    PetscCall(MeshGetFacetVertices(dm, f[i], &s->vertex[4 * i]));
    for (PetscInt a = 0; a < 4; ++a) PetscCall(SurfaceVertexNode(global, s->vertex[4 * i + a], &s->node[4 * i + a]));
  }
  PetscCall(SurfaceFindBody(dm, s->nfacets, f, &s->body));
  s->thickness = thickness[s->body];
  PetscCall(ISRestoreIndices(facets, &f));
  PetscCall(ISDestroy(&facets));
  PetscCall(DMGetCoordinatesLocal(dm, &coordinates));
  PetscCall(DMGetCoordinateSection(dm, &coordsection));
  PetscCall(SurfaceGatherVertices(coordsection, coordinates, 4 * s->nfacets, s->vertex, s->reference));
  for (PetscInt i = 0; i < s->nfacets; ++i) area += ContactFacetMass(&s->reference[12 * i], mass);
  PetscCallMPI(MPI_Allreduce(&area, &s->area, 1, MPIU_REAL, MPIU_SUM, comm));
  PetscFunctionReturn(0);
}

/* Coordinates of n vertices moved by a local displacement vector */
PetscErrorCode ContactVerticesDeform(DM dm, Vec ulocal, PetscInt n, const PetscInt vertex[], PetscReal x[])
{
  PetscSection section, coordsection;
  Vec          coordinates;
  PetscReal   *reference;

  PetscFunctionBegin;
  PetscCall(DMGetLocalSection(dm, &section));
  PetscCall(DMGetCoordinatesLocal(dm, &coordinates));
  PetscCall(DMGetCoordinateSection(dm, &coordsection));
  PetscCall(PetscMalloc1(3 * n, &reference));
  PetscCall(SurfaceGatherVertices(coordsection, coordinates, n, vertex, reference));
  PetscCall(SurfaceGatherVertices(section, ulocal, n, vertex, x));
  for (PetscInt i = 0; i < 3 * n; ++i) x[i] += reference[i];
  PetscCall(PetscFree(reference));
  PetscFunctionReturn(0);
}

/* Coordinates of the vertices moved by a local displacement vector */
PetscErrorCode ContactSurfaceDeform(DM dm, Vec ulocal, ContactSurface *s)
{
  PetscSection section;

  PetscFunctionBegin;
  PetscCall(DMGetLocalSection(dm, &section));
  PetscCall(SurfaceGatherVertices(section, ulocal, 4 * s->nfacets, s->vertex, s->x));
  for (PetscInt i = 0; i < 12 * s->nfacets; ++i) s->x[i] += s->reference[i];
  PetscFunctionReturn(0);
}

static void SurfaceNormalize(PetscInt n, PetscReal normal[])
{
  for (PetscInt i = 0; i < n; ++i) {
    PetscReal      *v      = &normal[3 * i];
    const PetscReal length = PetscSqrtReal(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);

    for (PetscInt c = 0; c < 3; ++c) v[c] = length > 0.0 ? v[c] / length : 0.0;
  }
}

/*
  Collective. Averaged unit normals at the facets' vertices, and at n vertices of the face that this rank owns: the sum of
  the area vectors of the face's facets about a vertex, whatever ranks they are on, scaled to length 1. Zero where they
  cancel: such a vertex has no normal, and its row is empty.
*/
PetscErrorCode ContactSurfaceNormals(DM dm, const ContactSurface *s, PetscReal normal[], PetscInt n, const PetscInt vertex[], PetscReal vertexnormal[])
{
  PetscSection section;
  PetscScalar *a;
  Vec          local, global;

  PetscFunctionBegin;
  PetscCall(DMGetLocalSection(dm, &section));
  PetscCall(DMGetLocalVector(dm, &local));
  PetscCall(DMGetGlobalVector(dm, &global));
  PetscCall(VecZeroEntries(local));
  PetscCall(VecZeroEntries(global));
  PetscCall(VecGetArray(local, &a));
  for (PetscInt i = 0; i < 4 * s->nfacets; ++i) {
    PetscReal area[3];
    PetscInt  offset;

    ContactFacetAreaVector(&s->x[12 * (i / 4)], area);
    PetscCall(PetscSectionGetOffset(section, s->vertex[i], &offset));
    for (PetscInt c = 0; c < 3; ++c) a[offset + c] += area[c];
  }
  PetscCall(VecRestoreArray(local, &a));
  PetscCall(DMLocalToGlobal(dm, local, ADD_VALUES, global));
  PetscCall(DMGlobalToLocal(dm, global, INSERT_VALUES, local));
  PetscCall(SurfaceGatherVertices(section, local, 4 * s->nfacets, s->vertex, normal));
  PetscCall(SurfaceGatherVertices(section, local, n, vertex, vertexnormal));
  PetscCall(DMRestoreGlobalVector(dm, &global));
  PetscCall(DMRestoreLocalVector(dm, &local));
  SurfaceNormalize(4 * s->nfacets, normal);
  SurfaceNormalize(n, vertexnormal);
  PetscFunctionReturn(0);
}

PetscErrorCode ContactSurfaceDestroy(ContactSurface *s)
{
  PetscFunctionBegin;
  PetscCall(PetscFree(s->name));
  PetscCall(PetscFree4(s->vertex, s->node, s->reference, s->x));
  PetscCall(PetscFree(s->border));
  PetscCall(PetscFree(s->held));
  PetscCall(PetscFree2(s->patch, s->bend));
  PetscFunctionReturn(0);
}
