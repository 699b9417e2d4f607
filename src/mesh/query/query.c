/* Queries of a mesh: faces, their vertices and unknowns, and the vertices of cells and facets */
#include "queryimpl.h"
#include <vector3.h>

/*
   Returns the number that each corner of a cell has in the closure of DMPlex. The corners are in tensor order (x
   fastest) for a hexahedron. For a tetrahedron, the edges from the first corner are right-handed. DMPlex lists the
   vertices at the bottom of a cell in the opposite direction.
*/
const PetscInt *MeshPlexCorners(PetscInt ncorners)
{
  static const PetscInt hexahedron[8] = {0, 3, 1, 2, 4, 5, 7, 6}, tetrahedron[4] = {1, 0, 2, 3};

  return ncorners == 4 ? tetrahedron : hexahedron;
}

/* Gets the points of a face label within [start, end) as a sorted index set, which may be empty */
static PetscErrorCode MeshGetFacePoints(DM dm, const char face[], PetscInt start, PetscInt end, IS *points)
{
  PetscBool       has;
  IS              all;
  const PetscInt *p;
  PetscInt        n, first, last;

  PetscFunctionBegin;
  PetscCall(DMHasLabel(dm, face, &has));
  PetscCheck(has, PetscObjectComm((PetscObject)dm), PETSC_ERR_ARG_WRONG, "The mesh has no face \"%s\"", face);
  PetscCall(DMGetStratumIS(dm, face, 1, &all));
  if (!all) {
    PetscCall(ISCreateGeneral(PETSC_COMM_SELF, 0, NULL, PETSC_COPY_VALUES, points));
    PetscFunctionReturn(0);
  }
  PetscCall(ISSort(all));
  PetscCall(ISGetLocalSize(all, &n));
  PetscCall(ISGetIndices(all, &p));
  PetscCall(PetscFindInt(start, n, p, &first));
  PetscCall(PetscFindInt(end, n, p, &last));
  if (first < 0) first = -(first + 1);
  if (last < 0) last = -(last + 1);
  PetscCall(ISCreateGeneral(PETSC_COMM_SELF, last - first, p + first, PETSC_COPY_VALUES, points));
  PetscCall(ISRestoreIndices(all, &p));
  PetscCall(ISDestroy(&all));
  PetscFunctionReturn(0);
}

/*@
  MeshGetFacets - Gets the facets of a named face on this rank

  Collective

  Input Parameters:
+ dm   - the mesh
- face - name of the face, "<body>.<face>"

  Output Parameter:
. facets - the facets as local DMPlex points, sorted; a sequential index set, which may be empty

  Level: intermediate

  Notes:
  Every facet is on exactly one rank. It is an error if the mesh has no face with this name.

.seealso: `MeshCreate()`, `MeshGetFaceVertices()`
@*/
PetscErrorCode MeshGetFacets(DM dm, const char face[], IS *facets)
{
  PetscInt start, end;

  PetscFunctionBegin;
  PetscCall(DMPlexGetHeightStratum(dm, 1, &start, &end));
  PetscCall(MeshGetFacePoints(dm, face, start, end, facets));
  PetscFunctionReturn(0);
}

/*@
  MeshGetFaceVertices - Gets the vertices of a named face on this rank, including those whose facets are on other ranks

  Collective

  Input Parameters:
+ dm   - the mesh
- face - name of the face, "<body>.<face>"

  Output Parameter:
. vertices - the vertices as local DMPlex points, sorted; a sequential index set, which may be empty

  Level: intermediate

.seealso: `MeshCreate()`, `MeshGetFacets()`, `MeshGetFaceDofs()`
@*/
PetscErrorCode MeshGetFaceVertices(DM dm, const char face[], IS *vertices)
{
  PetscInt start, end;

  PetscFunctionBegin;
  PetscCall(DMPlexGetDepthStratum(dm, 0, &start, &end));
  PetscCall(MeshGetFacePoints(dm, face, start, end, vertices));
  PetscFunctionReturn(0);
}

/*@
  MeshGetFaceDofs - Gets the global rows of one displacement component on a named face

  Collective

  Input Parameters:
+ dm        - the mesh
. face      - name of the face, "<body>.<face>"
- component - 0, 1 or 2

  Output Parameter:
. rows - the global rows that this rank owns, sorted; an index set on the mesh's communicator

  Level: intermediate

.seealso: `MeshGetFaceVertices()`, `ElasticitySetPrescribed()`
@*/
PetscErrorCode MeshGetFaceDofs(DM dm, const char face[], PetscInt component, IS *rows)
{
  MPI_Comm        comm = PetscObjectComm((PetscObject)dm);
  IS              points;
  PetscSection    section;
  const PetscInt *p;
  PetscInt        n, start, end, nowned = 0, *owned;

  PetscFunctionBegin;
  PetscCheck(component >= 0 && component < 3, comm, PETSC_ERR_ARG_OUTOFRANGE,
    "A displacement has components 0, 1 and 2, not %" PetscInt_FMT, component);
  PetscCall(DMGetGlobalSection(dm, &section));
  PetscCall(PetscSectionGetChart(section, &start, &end));
  PetscCall(MeshGetFacePoints(dm, face, start, end, &points));
  PetscCall(ISGetLocalSize(points, &n));
  PetscCall(ISGetIndices(points, &p));
  PetscCall(PetscMalloc1(n, &owned));
  for (PetscInt i = 0; i < n; ++i) {
    PetscInt offset, ncomponents;

    PetscCall(PetscSectionGetDof(section, p[i], &ncomponents));
    PetscCall(PetscSectionGetOffset(section, p[i], &offset));
    if (ncomponents > 0 && offset >= 0) owned[nowned++] = offset + component;
  }
  PetscCall(ISRestoreIndices(points, &p));
  PetscCall(ISDestroy(&points));
  PetscCall(ISCreateGeneral(comm, nowned, owned, PETSC_COPY_VALUES, rows));
  PetscCall(PetscFree(owned));
  PetscCall(ISSort(*rows));
  PetscFunctionReturn(0);
}

/* Gets the vertices of a boundary facet, counterclockwise seen from outside the body. facet: a local DMPlex point with
   one cell; vertices: local DMPlex points, 4 of a quadrilateral; a triangle has its third vertex twice */
PetscErrorCode MeshGetFacetVertices(DM dm, PetscInt facet, PetscInt vertices[4])
{
  const PetscInt *cells, *cone, *orientation;
  PetscInt        ncells, nfacets, ncorners, npoints, vstart, vend, n = 0, sign = 0, *closure = NULL;

  PetscFunctionBegin;
  PetscCall(DMPlexGetSupportSize(dm, facet, &ncells));
  PetscCheck(ncells == 1, PETSC_COMM_SELF, PETSC_ERR_ARG_WRONG,
    "Point %" PetscInt_FMT " is not a boundary facet: it has %" PetscInt_FMT " cells", facet, ncells);
  PetscCall(DMPlexGetSupport(dm, facet, &cells));
  PetscCall(DMPlexGetConeSize(dm, cells[0], &nfacets));
  PetscCall(DMPlexGetCone(dm, cells[0], &cone));
  PetscCall(DMPlexGetConeOrientation(dm, cells[0], &orientation));
  for (PetscInt f = 0; f < nfacets; ++f) {
    if (cone[f] == facet) sign = orientation[f];
  }
  PetscCall(DMPlexGetDepthStratum(dm, 0, &vstart, &vend));
  PetscCall(DMPlexGetConeSize(dm, facet, &ncorners));
  PetscCall(DMPlexGetTransitiveClosure(dm, facet, PETSC_TRUE, &npoints, &closure));
  for (PetscInt p = 0; p < npoints; ++p) {
    const PetscInt q = closure[2 * p];

    /* If the orientation is negative, the cell has the facet's vertices in reverse order. */
    if (q >= vstart && q < vend) {
      vertices[sign < 0 ? ncorners - 1 - n : n] = q;
      ++n;
    }
  }
  PetscCall(DMPlexRestoreTransitiveClosure(dm, facet, PETSC_TRUE, &npoints, &closure));
  if (ncorners == 3) vertices[3] = vertices[2];
  PetscFunctionReturn(0);
}

/* Computes twice the area vector of a facet with the vertices x. It points out of the body. */
void MeshComputeFacetArea(PetscReal x[4][3], PetscReal area[3])
{
  PetscReal d[3], e[3];

  for (PetscInt c = 0; c < 3; ++c) {
    d[c] = x[2][c] - x[0][c];
    e[c] = x[3][c] - x[1][c];
  }
  VectorCross(d, e, area);
}

/* Collective. Adds up twice the area vectors of the ranks' undeformed facets, in sums[0..2], and their lengths, in
   sums[3]. A face is plane if both have the same magnitude. */
PetscErrorCode MeshSumFacetAreas(DM dm, IS facets, PetscReal sums[4])
{
  const PetscInt *f;
  PetscInt        n;

  PetscFunctionBegin;
  PetscCall(PetscArrayzero(sums, 4));
  PetscCall(ISGetLocalSize(facets, &n));
  PetscCall(ISGetIndices(facets, &f));
  for (PetscInt i = 0; i < n; ++i) {
    PetscInt  vertices[4];
    PetscReal x[4][3], area[3];

    PetscCall(MeshGetFacetVertices(dm, f[i], vertices));
    PetscCall(MeshGetVertexCoordinates(dm, 4, vertices, x));
    MeshComputeFacetArea(x, area);
    for (PetscInt c = 0; c < 3; ++c) sums[c] += area[c];
    sums[3] += VectorNorm(area);
  }
  PetscCall(ISRestoreIndices(facets, &f));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sums, 4, MPIU_REAL, MPIU_SUM, PetscObjectComm((PetscObject)dm)));
  PetscFunctionReturn(0);
}

PetscBool MeshFacetsArePlane(const PetscReal sums[4])
{
  const PetscReal rounding = 1e-10; /* normals that differ by 1e-5 are those of one plane */

  return (PetscBool)(VectorNorm(sums) >= (1.0 - rounding) * sums[3]);
}

/* Gets the 8 vertices of a hexahedron in tensor order. cell, vertices: local DMPlex points; vertex i + 2 j + 4 k is at
   the corner (i, j, k) of the reference cube */
PetscErrorCode MeshGetCellVertices(DM dm, PetscInt cell, PetscInt vertices[8])
{
  PetscInt n;

  PetscFunctionBegin;
  PetscCall(MeshGetCellCorners(dm, cell, &n, vertices));
  PetscCheck(n == 8, PETSC_COMM_SELF, PETSC_ERR_ARG_WRONG, "Point %" PetscInt_FMT " is not a hexahedron", cell);
  PetscFunctionReturn(0);
}

/* Gets the 8 vertices of a hexahedron in tensor order, or the 4 vertices of a tetrahedron */
PetscErrorCode MeshGetCellCorners(DM dm, PetscInt cell, PetscInt *ncorners, PetscInt vertices[8])
{
  PetscInt        npoints, vstart, vend, n = 0, plex[8], *closure = NULL;
  const PetscInt *order;

  PetscFunctionBegin;
  PetscCall(DMPlexGetDepthStratum(dm, 0, &vstart, &vend));
  PetscCall(DMPlexGetTransitiveClosure(dm, cell, PETSC_TRUE, &npoints, &closure));
  for (PetscInt p = 0; p < npoints && n < 8; ++p) {
    const PetscInt q = closure[2 * p];

    if (q >= vstart && q < vend) plex[n++] = q;
  }
  PetscCall(DMPlexRestoreTransitiveClosure(dm, cell, PETSC_TRUE, &npoints, &closure));
  PetscCheck(n == 8 || n == 4, PETSC_COMM_SELF, PETSC_ERR_ARG_WRONG,
    "Point %" PetscInt_FMT " is neither a hexahedron nor a tetrahedron", cell);
  order = MeshPlexCorners(n);
  for (PetscInt a = 0; a < n; ++a) vertices[a] = plex[order[a]];
  *ncorners = n;
  PetscFunctionReturn(0);
}

/* Gets the undeformed coordinates of n vertices. vertices: local DMPlex points; places: 3 coordinates per vertex
   [length] */
PetscErrorCode MeshGetVertexCoordinates(DM dm, PetscInt n, const PetscInt vertices[], PetscReal places[][3])
{
  Vec                coordinates;
  PetscSection       section;
  const PetscScalar *x;

  PetscFunctionBegin;
  PetscCall(DMGetCoordinatesLocal(dm, &coordinates));
  PetscCall(DMGetCoordinateSection(dm, &section));
  PetscCall(VecGetArrayRead(coordinates, &x));
  for (PetscInt i = 0; i < n; ++i) {
    PetscInt offset;

    PetscCall(PetscSectionGetOffset(section, vertices[i], &offset));
    for (PetscInt d = 0; d < 3; ++d) places[i][d] = PetscRealPart(x[offset + d]);
  }
  PetscCall(VecRestoreArrayRead(coordinates, &x));
  PetscFunctionReturn(0);
}
