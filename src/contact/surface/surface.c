/* The facets of a named face. Facets of order 2 are divided into four. The facets are taken from the mesh once; their
   coordinates are updated to the displacement at every contact update. */
#include <mesh.h>
#include "surfaceimpl.h"

/* Computes the global number of a vertex, which may be any node of the mesh. The section has 3 rows per node and
   encodes rows of other ranks as negative numbers. */
static PetscErrorCode SurfaceVertexNode(PetscSection global, PetscInt vertex, PetscInt *node)
{
  PetscInt offset;

  PetscFunctionBegin;
  PetscCall(PetscSectionGetOffset(global, vertex, &offset));
  *node = (offset < 0 ? -(offset + 1) : offset) / 3;
  PetscFunctionReturn(0);
}

/* Copies the values of a local vector with 3 components per node at n vertices to x */
static PetscErrorCode SurfaceGatherVertices(PetscSection section, Vec local, PetscInt n, const PetscInt vertex[],
  PetscReal x[])
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

/* Collective. Finds the body that these facets belong to; ranks without facets get it from the other ranks */
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

/* Divides n facets of the mesh into facets with four or three vertices. Stores the local and the global numbers of
   their vertices. */
static PetscErrorCode SurfaceCut(DM dm, PetscInt n, const PetscInt facet[], ContactSurface *s)
{
  PetscSection global;
  PetscInt     npieces, pieces[MESH_MAX_FACET_PIECES][4];

  PetscFunctionBegin;
  s->nfacets = 0;
  for (PetscInt i = 0; i < n; ++i) {
    PetscCall(MeshGetFacetPieces(dm, facet[i], &npieces, pieces));
    s->nfacets += npieces;
    s->cut = (PetscBool)(npieces > 1);
  }
  PetscCall(PetscMalloc4(4 * s->nfacets, &s->vertex, 4 * s->nfacets, &s->node, 12 * s->nfacets, &s->reference,
    12 * s->nfacets, &s->x));
  PetscCall(DMGetGlobalSection(dm, &global));
  for (PetscInt i = 0, k = 0; i < n; ++i, k += npieces) {
    PetscCall(MeshGetFacetPieces(dm, facet[i], &npieces, pieces));
    PetscCall(PetscArraycpy(&s->vertex[4 * k], pieces[0], 4 * npieces));
  }
  for (PetscInt i = 0; i < 4 * s->nfacets; ++i) PetscCall(SurfaceVertexNode(global, s->vertex[i], &s->node[i]));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &s->cut, 1, MPI_PETSCBOOL, MPI_LOR, PetscObjectComm((PetscObject)dm)));
  PetscFunctionReturn(0);
}

/* Collective. Creates the surface of a face. thickness[body]: mean thickness of every body [length] */
PetscErrorCode ContactSurfaceCreate(DM dm, const char face[], const PetscReal thickness[], ContactSurface *s)
{
  MPI_Comm        comm = PetscObjectComm((PetscObject)dm);
  IS              facets;
  const PetscInt *f;
  PetscInt        n, total;
  PetscReal       mass[4], area = 0.0;
  PetscSection    section;
  Vec             coordinates;

  PetscFunctionBegin;
  PetscCall(PetscStrallocpy(face, &s->name));
  PetscCall(MeshGetFacets(dm, face, &facets));
  PetscCall(ISGetLocalSize(facets, &n));
  PetscCallMPI(MPI_Allreduce(&n, &total, 1, MPIU_INT, MPI_SUM, comm));
  PetscCheck(total > 0, comm, PETSC_ERR_ARG_WRONG, "Face \"%s\" of a contact pair has no facets", face);
  PetscCall(ISGetIndices(facets, &f));
  PetscCall(SurfaceCut(dm, n, f, s));
  PetscCall(SurfaceFindBody(dm, n, f, &s->body));
  s->thickness = thickness[s->body];
  PetscCall(ISRestoreIndices(facets, &f));
  PetscCall(ISDestroy(&facets));
  PetscCall(MeshGetNodeCoordinates(dm, &coordinates));
  PetscCall(DMGetLocalSection(dm, &section));
  PetscCall(SurfaceGatherVertices(section, coordinates, 4 * s->nfacets, s->vertex, s->reference));
  for (PetscInt i = 0; i < s->nfacets; ++i) area += ContactFacetMass(&s->reference[12 * i], mass);
  PetscCallMPI(MPI_Allreduce(&area, &s->area, 1, MPIU_REAL, MPIU_SUM, comm));
  PetscFunctionReturn(0);
}

/* Computes the coordinates x of n vertices, displaced by the local vector ulocal [length] */
PetscErrorCode ContactVerticesDeform(DM dm, Vec ulocal, PetscInt n, const PetscInt vertex[], PetscReal x[])
{
  PetscSection section;
  Vec          coordinates;
  PetscReal   *reference;

  PetscFunctionBegin;
  PetscCall(DMGetLocalSection(dm, &section));
  PetscCall(MeshGetNodeCoordinates(dm, &coordinates));
  PetscCall(PetscMalloc1(3 * n, &reference));
  PetscCall(SurfaceGatherVertices(section, coordinates, n, vertex, reference));
  PetscCall(SurfaceGatherVertices(section, ulocal, n, vertex, x));
  for (PetscInt i = 0; i < 3 * n; ++i) x[i] += reference[i];
  PetscCall(PetscFree(reference));
  PetscFunctionReturn(0);
}

/* Updates the coordinates of the surface's vertices to the local displacement vector ulocal */
PetscErrorCode ContactSurfaceDeform(DM dm, Vec ulocal, ContactSurface *s)
{
  PetscSection section;

  PetscFunctionBegin;
  PetscCall(DMGetLocalSection(dm, &section));
  PetscCall(SurfaceGatherVertices(section, ulocal, 4 * s->nfacets, s->vertex, s->x));
  for (PetscInt i = 0; i < 12 * s->nfacets; ++i) s->x[i] += s->reference[i];
  PetscFunctionReturn(0);
}

/* Scales n vectors to length 1; zero vectors stay zero */
static void SurfaceNormalize(PetscInt n, PetscReal normal[])
{
  for (PetscInt i = 0; i < n; ++i) (void)VectorScaleToUnit(&normal[3 * i]);
}

/*
   Collective. Computes averaged unit normals at the facets' vertices (normal), and at n vertices of the face that this
   rank owns (vertexnormal). The normal of a vertex is the sum of the area vectors of the facets of the face around it,
   on all ranks, scaled to length 1. It is zero if the area vectors cancel; the vertex then has an empty contact row.
   only: which facets count; NULL: all
*/
PetscErrorCode ContactSurfaceNormals(DM dm, const ContactSurface *s, const PetscBool only[], PetscReal normal[],
  PetscInt n, const PetscInt vertex[], PetscReal vertexnormal[])
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

    if ((i % 4 == 3 && s->vertex[i] == s->vertex[i - 1]) || (only && !only[i / 4])) continue;
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
  PetscCall(PetscBTDestroy(&s->rim));
  PetscCall(PetscFree(s->prescribed));
  PetscCall(PetscFree(s->patch));
  PetscCall(PetscFree2(s->rank, s->below));
  PetscFunctionReturn(0);
}
