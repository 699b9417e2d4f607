/* Restraints at the facets of a face */
#include "supportsimpl.h"
#include <vector3.h>

PetscErrorCode SupportGetFace(Support *support, const char name[], SupportFace *face)
{
  MPI_Comm        comm = PetscObjectComm((PetscObject)support->dm);
  const PetscInt *f, *cells;
  PetscInt        n;

  PetscFunctionBegin;
  PetscCall(MeshGetFacets(support->dm, name, &face->facets));
  PetscCall(ISGetLocalSize(face->facets, &n));
  PetscCall(ISGetIndices(face->facets, &f));
  face->body = PETSC_DECIDE;
  if (n) {
    PetscCall(DMPlexGetSupport(support->dm, f[0], &cells));
    PetscCall(DMGetLabelValue(support->dm, MESH_BODY_LABEL, cells[0], &face->body));
  }
  PetscCall(ISRestoreIndices(face->facets, &f));
  PetscCallMPI(MPI_Allreduce(&n, &face->total, 1, MPIU_INT, MPI_SUM, comm));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &face->body, 1, MPIU_INT, MPI_MAX, comm));
  PetscFunctionReturn(0);
}

PetscErrorCode SupportDestroyFace(SupportFace *face)
{
  PetscFunctionBegin;
  PetscCall(ISDestroy(&face->facets));
  PetscFunctionReturn(0);
}

/* Gets the vertices of a facet [length] and its unit normal. The third vertex of a triangle is also its fourth. */
static PetscErrorCode SupportGetFacet(const Support *support, PetscInt facet, PetscReal x[4][3], PetscReal normal[3])
{
  PetscInt vertices[4];

  PetscFunctionBegin;
  PetscCall(MeshGetFacetVertices(support->dm, facet, vertices));
  PetscCall(SupportGetPlaces(support, 4, vertices, x));
  MeshComputeFacetArea(x, normal);
  VectorScaleToUnit(normal);
  PetscFunctionReturn(0);
}

PetscErrorCode SupportAddFacets(Support *support, const SupportFace *face, PetscInt other, const PetscBool along[3],
  const PetscReal normal[3])
{
  static const PetscReal axes[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const PetscInt        *f;
  PetscInt               n;

  PetscFunctionBegin;
  PetscCall(ISGetLocalSize(face->facets, &n));
  PetscCall(ISGetIndices(face->facets, &f));
  for (PetscInt i = 0; i < n; ++i) {
    PetscReal x[4][3], own[3];

    PetscCall(SupportGetFacet(support, f[i], x, own));
    for (PetscInt k = 0; k < 12; ++k) {
      const PetscReal *direction = along ? axes[k % 3] : normal ? normal : own;

      if (along ? !along[k % 3] : k % 3) continue;
      SupportAddMotion(support, face->body, direction, x[k / 3], 1);
      if (other >= 0) SupportAddMotion(support, other, direction, x[k / 3], -1);
      PetscCall(SupportAddRow(support, 1 / (PetscReal)face->total));
    }
  }
  PetscCall(ISRestoreIndices(face->facets, &f));
  PetscFunctionReturn(0);
}

PetscErrorCode SupportMeasureFace(Support *support, const SupportFace *face)
{
  SupportContact *contact = &support->contact[face->body];
  const PetscInt *f;
  PetscInt        n;

  PetscFunctionBegin;
  PetscCall(ISGetLocalSize(face->facets, &n));
  PetscCall(ISGetIndices(face->facets, &f));
  for (PetscInt i = 0; i < n; ++i) {
    PetscReal x[4][3], direction[4][3] = {{0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    PetscBool triangle;

    PetscCall(SupportGetFacet(support, f[i], x, direction[0]));
    triangle = (PetscBool)(x[3][0] == x[2][0] && x[3][1] == x[2][1] && x[3][2] == x[2][2]);
    /* the normal at the centre of a facet of a round face meets its axis */
    for (PetscInt d = 0; d < 3; ++d)
      x[0][d] = (x[0][d] + x[1][d] + x[2][d] + (triangle ? 0 : x[3][d])) / (triangle ? 3 : 4);
    for (PetscInt k = 0; k < 4; ++k) {
      PetscReal row[6] = {0};

      SupportSetRow(support, face->body, direction[k], x[0], 1, row);
      for (PetscInt j = 0; j < 36; ++j)
        (k ? contact->motion : contact->normal)[j] += row[j / 6] * row[j % 6] / (PetscReal)face->total;
    }
  }
  PetscCall(ISRestoreIndices(face->facets, &f));
  PetscFunctionReturn(0);
}
