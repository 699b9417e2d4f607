/*
   Nodes: the points of the mesh that carry a displacement. In a body of order 1 these are its vertices. In a body of
   order 2 hexahedra have 27 nodes, on vertices, edges, facets and cell, in the order i + 3 j + 9 k (vertices: i + 2 j +
   4 k); tetrahedra have 10, on vertices and edges.
*/
#include "queryimpl.h"

#define MESH_PLACES "nodes" /* key of the nodes' coordinates, composed on the mesh if they are not its vertices alone */

/* Creates the section: three components at every vertex; in bodies of order 2 also at every other point of
   hexahedra, and at every edge of tetrahedra; none constrained */
PetscErrorCode MeshSetSection(DM dm, const PetscInt orders[])
{
  PetscSection section;
  PetscInt     pstart, pend, cstart, cend, vstart, vend;

  PetscFunctionBegin;
  PetscCall(DMPlexGetChart(dm, &pstart, &pend));
  PetscCall(DMPlexGetHeightStratum(dm, 0, &cstart, &cend));
  PetscCall(DMPlexGetDepthStratum(dm, 0, &vstart, &vend));
  PetscCall(PetscSectionCreate(PetscObjectComm((PetscObject)dm), &section));
  PetscCall(PetscSectionSetNumFields(section, 1));
  PetscCall(PetscSectionSetFieldName(section, 0, "displacement"));
  PetscCall(PetscSectionSetFieldComponents(section, 0, 3));
  PetscCall(PetscSectionSetChart(section, pstart, pend));
  for (PetscInt v = vstart; v < vend; ++v) PetscCall(PetscSectionSetDof(section, v, 3));
  for (PetscInt c = cstart; c < cend; ++c) {
    PetscInt b, nfacets, npoints, *closure = NULL;

    PetscCall(DMGetLabelValue(dm, MESH_BODY_LABEL, c, &b));
    if (orders[b] < 2) continue;
    PetscCall(DMPlexGetConeSize(dm, c, &nfacets));
    PetscCall(DMPlexGetTransitiveClosure(dm, c, PETSC_TRUE, &npoints, &closure));
    for (PetscInt p = nfacets == 4 ? 1 + nfacets : 0; p < npoints; ++p)
      PetscCall(PetscSectionSetDof(section, closure[2 * p], 3));
    PetscCall(DMPlexRestoreTransitiveClosure(dm, c, PETSC_TRUE, &npoints, &closure));
  }
  for (PetscInt p = pstart; p < pend; ++p) {
    PetscInt n;

    PetscCall(PetscSectionGetDof(section, p, &n));
    if (n) PetscCall(PetscSectionSetFieldDof(section, p, 0, n));
  }
  PetscCall(PetscSectionSetUp(section));
  PetscCall(DMSetLocalSection(dm, section));
  PetscCall(PetscSectionDestroy(&section));
  PetscFunctionReturn(0);
}

/* Index of a vertex among n, or n */
static PetscInt NodesFind(PetscInt n, const PetscInt vertices[], PetscInt vertex)
{
  PetscInt a = 0;

  while (a < n && vertices[a] != vertex) ++a;
  return a;
}

/* Position of an edge, facet or cell in the cell, i + 3 j + 9 k, as the centre of its own vertices. In a tetrahedron
   an edge is in the middle of two vertices; negative: more than two */
static PetscErrorCode NodesFindPlace(DM dm, PetscInt ncorners, const PetscInt vertices[8], PetscInt point,
  PetscInt *place)
{
  PetscInt npoints, n = 0, sum[3] = {0, 0, 0}, ends[2] = {4, -1}, *closure = NULL;

  PetscFunctionBegin;
  PetscCall(DMPlexGetTransitiveClosure(dm, point, PETSC_TRUE, &npoints, &closure));
  for (PetscInt p = 0; p < npoints; ++p) {
    const PetscInt a = NodesFind(ncorners, vertices, closure[2 * p]);

    if (a == ncorners) continue;
    for (PetscInt d = 0; d < 3; ++d) sum[d] += 2 * (a >> d & 1);
    ends[0] = PetscMin(ends[0], a);
    ends[1] = PetscMax(ends[1], a);
    ++n;
  }
  PetscCall(DMPlexRestoreTransitiveClosure(dm, point, PETSC_TRUE, &npoints, &closure));
  *place = sum[0] / n + 3 * (sum[1] / n) + 9 * (sum[2] / n);
  if (ncorners == 8) PetscFunctionReturn(0);
  for (*place = n > 2 ? -1 : 9;
       *place >= 0 && (MeshTetrahedronEnds[*place][0] != ends[0] || MeshTetrahedronEnds[*place][1] != ends[1]);)
    --*place;
  PetscFunctionReturn(0);
}

/* Whether the edges of a facet have values in a section */
static PetscErrorCode NodesHasEdges(DM dm, PetscSection section, PetscInt facet, PetscBool *has)
{
  const PetscInt *edges;
  PetscInt        first, last, n = 0;

  PetscFunctionBegin;
  PetscCall(DMPlexGetCone(dm, facet, &edges));
  PetscCall(PetscSectionGetChart(section, &first, &last));
  if (edges[0] >= first && edges[0] < last) PetscCall(PetscSectionGetDof(section, edges[0], &n));
  *has = (PetscBool)(n > 0);
  PetscFunctionReturn(0);
}

/* The points of a cell with values in a section: its vertices, or all nodes of order 2 */
PetscErrorCode MeshGetCellPoints(DM dm, PetscSection section, PetscInt cell, PetscInt *n,
  PetscInt points[MESH_MAX_NODES])
{
  PetscInt        vertices[8], ncorners, npoints, *closure = NULL;
  const PetscInt *facets;
  PetscBool       second;

  PetscFunctionBegin;
  PetscCall(DMPlexGetCone(dm, cell, &facets));
  PetscCall(NodesHasEdges(dm, section, facets[0], &second));
  if (!second) {
    PetscCall(MeshGetCellCorners(dm, cell, n, points));
    PetscFunctionReturn(0);
  }
  PetscCall(MeshGetCellCorners(dm, cell, &ncorners, vertices));
  *n = ncorners == 8 ? 27 : 10;
  PetscCall(DMPlexGetTransitiveClosure(dm, cell, PETSC_TRUE, &npoints, &closure));
  for (PetscInt p = 0; p < npoints; ++p) {
    PetscInt place = 0;

    PetscCall(NodesFindPlace(dm, ncorners, vertices, closure[2 * p], &place));
    if (place >= 0) points[place] = closure[2 * p];
  }
  PetscCall(DMPlexRestoreTransitiveClosure(dm, cell, PETSC_TRUE, &npoints, &closure));
  PetscFunctionReturn(0);
}

/* Gets the points of a cell that carry a displacement, of hexahedra in tensor order. cell: the cell, a local DMPlex
   point; n: their number: 8, or 27 in a body of order 2; of a tetrahedron 4, or 10; nodes: local DMPlex points,
   MESH_MAX_NODES at most: vertices, number i + 2 j + 4 k at the corner (i, j, k) of the reference cube; of order 2
   vertices, edges, facets and the cell, number i + 3 j + 9 k at (i, j, k)/2. Of a tetrahedron the vertices, then the
   edges 01, 12, 02, 03, 13 and 23. */
PetscErrorCode MeshGetCellNodes(DM dm, PetscInt cell, PetscInt *n, PetscInt nodes[MESH_MAX_NODES])
{
  PetscSection section;

  PetscFunctionBegin;
  PetscCall(DMGetLocalSection(dm, &section));
  PetscCall(MeshGetCellPoints(dm, section, cell, n, nodes));
  PetscFunctionReturn(0);
}

/* Gets the points of a boundary facet that carry a displacement. facet: the facet, a local DMPlex point with one cell;
   n: their number: 4, or 9 in a body of order 2; of a triangle 3, or 6; nodes: local DMPlex points,
   MESH_MAX_FACET_NODES at most: the vertices counterclockwise seen from outside the body; of order 2 then the edges,
   each between the vertex of its number and the next, and the facet, unless it is a triangle. */
PetscErrorCode MeshGetFacetNodes(DM dm, PetscInt facet, PetscInt *n, PetscInt nodes[MESH_MAX_FACET_NODES])
{
  PetscSection    section;
  const PetscInt *edges, *ends;
  PetscInt        nedges;
  PetscBool       second;

  PetscFunctionBegin;
  PetscCall(DMGetLocalSection(dm, &section));
  PetscCall(NodesHasEdges(dm, section, facet, &second));
  PetscCall(DMPlexGetConeSize(dm, facet, &nedges));
  PetscCall(MeshGetFacetVertices(dm, facet, nodes));
  *n = nedges;
  if (!second) PetscFunctionReturn(0);
  *n = nedges == 4 ? 9 : 6;
  PetscCall(DMPlexGetCone(dm, facet, &edges));
  for (PetscInt e = 0; e < nedges; ++e) {
    PetscInt a, b;

    PetscCall(DMPlexGetCone(dm, edges[e], &ends));
    a                                               = NodesFind(nedges, nodes, ends[0]);
    b                                               = NodesFind(nedges, nodes, ends[1]);
    nodes[nedges + ((a + 1) % nedges == b ? a : b)] = edges[e];
  }
  if (nedges == 4) nodes[8] = facet;
  PetscFunctionReturn(0);
}

/* Gets the four-node facets into which the nodes of a boundary facet divide it. facet: the facet, a local DMPlex point
   with one cell; n: their number: 1, the facet itself, or 4 in a body of order 2; pieces: the nodes of each, local
   DMPlex points, counterclockwise seen from outside the body; of order 2 vertex, edge, facet, edge. Triangles have
   their last node twice; those of order 2 are cut into vertex, edge, edge, and the three edges. */
PetscErrorCode MeshGetFacetPieces(DM dm, PetscInt facet, PetscInt *n, PetscInt pieces[MESH_MAX_FACET_PIECES][4])
{
  PetscInt nnodes, nodes[MESH_MAX_FACET_NODES];

  PetscFunctionBegin;
  PetscCall(MeshGetFacetNodes(dm, facet, &nnodes, nodes));
  *n = nnodes > 4 ? 4 : 1;
  for (PetscInt a = 0; a < 4; ++a) {
    const PetscInt quarter[4]  = {nodes[a], nodes[4 + a], nodes[8], nodes[4 + (a + 3) % 4]};
    const PetscInt triangle[4] = {nodes[a < 3 ? a : 3], nodes[a < 3 ? 3 + a : 4], nodes[3 + (a + 2) % 3],
      nodes[3 + (a + 2) % 3]};

    if (nnodes <= 4) pieces[0][a] = nodes[a];
    else PetscCall(PetscArraycpy(pieces[a], nnodes == 9 ? quarter : triangle, 4));
  }
  PetscFunctionReturn(0);
}

/* Gets the reference coordinates of all nodes of this rank. dm: mesh from MeshCreate(); places: local vector laid out
   as the displacements are, 3 coordinates a node [length]; the mesh's own. If no body has order 2, it is the vector of
   the vertices' coordinates. */
PetscErrorCode MeshGetNodeCoordinates(DM dm, Vec *places)
{
  PetscFunctionBegin;
  PetscCall(PetscObjectQuery((PetscObject)dm, MESH_PLACES, (PetscObject *)places));
  if (!*places) PetscCall(DMGetCoordinatesLocal(dm, places));
  PetscFunctionReturn(0);
}

/*@
  MeshGetBodyNodes - Gets the number of nodes of a cell of every body

  Collective

  Input Parameters:
+ dm      - mesh from `MeshCreate()`
- nbodies - number of bodies

  Output Parameter:
. nnodes - for each body, on all ranks: 8 or 27 of hexahedra of order 1 or 2, 4 or 10 of tetrahedra; all cells of a
           body have as many

  Level: intermediate

.seealso: `MeshCreate()`
@*/
PetscErrorCode MeshGetBodyNodes(DM dm, PetscInt nbodies, PetscInt nnodes[])
{
  PetscInt cstart, cend, unknown = nbodies;

  PetscFunctionBegin;
  PetscCall(PetscArrayzero(nnodes, nbodies));
  PetscCall(DMPlexGetHeightStratum(dm, 0, &cstart, &cend));
  for (PetscInt c = cstart; c < cend && unknown; ++c) {
    PetscInt b, n, nodes[MESH_MAX_NODES];

    PetscCall(DMGetLabelValue(dm, MESH_BODY_LABEL, c, &b));
    if (b < 0 || b >= nbodies || nnodes[b]) continue;
    PetscCall(MeshGetCellNodes(dm, c, &n, nodes));
    nnodes[b] = n;
    --unknown;
  }
  PetscCallMPI(
    MPI_Allreduce(MPI_IN_PLACE, nnodes, (PetscMPIInt)nbodies, MPIU_INT, MPI_MAX, PetscObjectComm((PetscObject)dm)));
  PetscFunctionReturn(0);
}

/* Coordinates and section of all nodes if the mesh has them, or of its vertices */
PetscErrorCode MeshGetPlaces(DM dm, PetscBool nodes, MeshPlaces *places)
{
  PetscFunctionBegin;
  if (nodes) {
    PetscCall(DMGetLocalSection(dm, &places->section));
    PetscCall(MeshGetNodeCoordinates(dm, &places->x));
  } else {
    PetscCall(DMGetCoordinateSection(dm, &places->section));
    PetscCall(DMGetCoordinatesLocal(dm, &places->x));
  }
  PetscFunctionReturn(0);
}

/* The 27 nodes of a straight cell from its corners (trilinear), or the 10 of a tetrahedron */
void MeshPlacesSetStraight(PetscInt ncorners, const PetscReal corners[][3], PetscReal places[MESH_MAX_NODES][3])
{
  for (PetscInt i = 0; ncorners == 4 && i < 30; ++i)
    places[i / 3][i % 3] =
      0.5 * (corners[MeshTetrahedronEnds[i / 3][0]][i % 3] + corners[MeshTetrahedronEnds[i / 3][1]][i % 3]);
  for (PetscInt i = 0; ncorners == 8 && i < 27; ++i) {
    const PetscReal at[3] = {0.5 * (PetscReal)(i % 3), 0.5 * (PetscReal)(i / 3 % 3), 0.5 * (PetscReal)(i / 9)};

    places[i][0] = places[i][1] = places[i][2] = 0;
    for (PetscInt a = 0; a < 8; ++a) {
      PetscReal weight = 1;

      for (PetscInt d = 0; d < 3; ++d) weight *= a >> d & 1 ? at[d] : 1 - at[d];
      for (PetscInt d = 0; d < 3; ++d) places[i][d] += weight * corners[a][d];
    }
  }
}

static PetscErrorCode NodesFillCells(DM dm, PetscScalar x[])
{
  PetscSection section;
  PetscInt     cstart, cend;

  PetscFunctionBegin;
  PetscCall(DMGetLocalSection(dm, &section));
  PetscCall(DMPlexGetHeightStratum(dm, 0, &cstart, &cend));
  for (PetscInt c = cstart; c < cend; ++c) {
    PetscInt  n, ncorners, nodes[MESH_MAX_NODES], vertices[8];
    PetscReal corners[8][3], places[MESH_MAX_NODES][3];

    PetscCall(MeshGetCellNodes(dm, c, &n, nodes));
    PetscCall(MeshGetCellCorners(dm, c, &ncorners, vertices));
    PetscCall(MeshGetVertexCoordinates(dm, ncorners, vertices, corners));
    if (n > ncorners) MeshPlacesSetStraight(ncorners, (const PetscReal(*)[3])corners, places);
    for (PetscInt a = 0; a < n; ++a) {
      const PetscReal *place = n > ncorners ? places[a] : corners[a];
      PetscInt         offset;

      PetscCall(PetscSectionGetOffset(section, nodes[a], &offset));
      for (PetscInt d = 0; d < 3; ++d) x[offset + d] = place[d];
    }
  }
  PetscFunctionReturn(0);
}

/* copies to a plain vector, because a vector of the mesh would reference the mesh that holds it */
PetscErrorCode MeshCreateNodes(DM dm, PetscInt nbodies, const PetscInt orders[])
{
  PetscSection section;
  Vec          places;
  PetscScalar *x;
  PetscInt     n;
  PetscBool    any = PETSC_FALSE;

  PetscFunctionBegin;
  for (PetscInt b = 0; b < nbodies; ++b) any = (PetscBool)(any || orders[b] > 1);
  if (!any) PetscFunctionReturn(0);
  /* Copies the vertices' coordinates from the nodes', after these were moved */
  PetscCall(DMGetLocalSection(dm, &section));
  PetscCall(PetscSectionGetStorageSize(section, &n));
  PetscCall(VecCreateSeq(PETSC_COMM_SELF, n, &places));
  PetscCall(VecSetBlockSize(places, 3));
  PetscCall(VecGetArray(places, &x));
  PetscCall(NodesFillCells(dm, x));
  PetscCall(VecRestoreArray(places, &x));
  PetscCall(PetscObjectCompose((PetscObject)dm, MESH_PLACES, (PetscObject)places));
  PetscCall(VecDestroy(&places));
  PetscFunctionReturn(0);
}

/* the global coordinates, if they exist, are out of date */
PetscErrorCode MeshUpdateVertices(DM dm)
{
  MeshPlaces         from, to;
  const PetscScalar *x;
  PetscScalar       *y;
  PetscInt           vstart, vend;

  PetscFunctionBegin;
  PetscCall(MeshGetPlaces(dm, PETSC_TRUE, &from));
  PetscCall(MeshGetPlaces(dm, PETSC_FALSE, &to));
  if (from.x != to.x) {
    PetscCall(DMPlexGetDepthStratum(dm, 0, &vstart, &vend));
    PetscCall(VecGetArrayRead(from.x, &x));
    PetscCall(VecGetArray(to.x, &y));
    for (PetscInt v = vstart; v < vend; ++v) {
      PetscInt i, j;

      PetscCall(PetscSectionGetOffset(from.section, v, &i));
      PetscCall(PetscSectionGetOffset(to.section, v, &j));
      for (PetscInt d = 0; d < 3; ++d) y[j + d] = x[i + d];
    }
    PetscCall(VecRestoreArray(to.x, &y));
    PetscCall(VecRestoreArrayRead(from.x, &x));
  }
  /* Updates the global coordinates, if they exist, which are still those from before */
  PetscCall(DMSetCoordinatesLocal(dm, to.x));
  PetscFunctionReturn(0);
}
