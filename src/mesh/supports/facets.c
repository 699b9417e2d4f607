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

/* Gets the vertices of a facet [length] and its unit normal. centres: the first vertex is replaced by the centre. The
   third vertex of a triangle is also its fourth. */
static PetscErrorCode SupportGetFacet(DM dm, PetscInt facet, PetscBool centres, PetscReal x[4][3], PetscReal normal[3])
{
  PetscInt  vertices[4];
  PetscReal last;

  PetscFunctionBegin;
  PetscCall(MeshGetFacetVertices(dm, facet, vertices));
  PetscCall(MeshGetVertexCoordinates(dm, 4, vertices, x));
  MeshComputeFacetArea(x, normal);
  VectorScaleToUnit(normal);
  last = vertices[3] == vertices[2] ? 0 : 1;
  for (PetscInt d = 0; centres && d < 3; ++d) x[0][d] = (x[0][d] + x[1][d] + x[2][d] + last * x[3][d]) / (3 + last);
  PetscFunctionReturn(0);
}

PetscErrorCode SupportAddFacets(Support *support, const SupportFace *face, PetscInt other, const PetscBool along[3],
  const PetscReal normal[3], PetscBool centres)
{
  static const PetscReal axes[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const PetscInt        *f, npoints = centres ? 1 : 4;
  PetscInt               n;

  PetscFunctionBegin;
  PetscCall(ISGetLocalSize(face->facets, &n));
  PetscCall(ISGetIndices(face->facets, &f));
  for (PetscInt i = 0; i < n; ++i) {
    PetscReal x[4][3], own[3];

    PetscCall(SupportGetFacet(support->dm, f[i], centres, x, own));
    if (support->pair) SupportMeasureMotion(support, x[0], 1 / (PetscReal)face->total);
    for (PetscInt k = 0; k < 3 * npoints; ++k) {
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
